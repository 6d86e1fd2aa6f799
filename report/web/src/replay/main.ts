// The 3D replay: a world as the run's data describe it, drawn by three.js whenever something in it changed.

import * as THREE from "three";
import {OrbitControls} from "three/examples/jsm/controls/OrbitControls.js";
import type {Pose} from "../run/data";
import {Band, ground, type Colours} from "./floor";
import {Robot} from "./robot";
import type {Replay, ReplayRun, ReplayScene, View} from "./types";

// Without graphics hardware a picture takes long: fewer dots then, so that it moves all the same.
const RATIOS = [1.5, 1, 0.75, 0.5];
const SLOW_ms = 18.5;
const SLIDES = 0.02;  // share of the time, from which a wheel is drawn as sliding
const NAMES = ["page", "floor", "grid", "ink", "cw", "ccw", "bump", "accent", "muted", "bad"] as const;

function coloursOf(element: Element): Colours {
  const style = getComputedStyle(element);
  const of = (name: string) => new THREE.Color(style.getPropertyValue(`--${name === "floor" ? "card" : name === "grid" ? "line" : name}`).trim());
  return Object.fromEntries(NAMES.map((name) => [name, of(name)])) as unknown as Colours;
}

const between = (a: number, b: number, share: number): number => a + (b - a) * share;

/// Between two poses, round the shorter way.
function poseAt(poses: Pose[], index: number): Pose {
  const i = Math.max(0, Math.min(Math.floor(index), poses.length - 2));
  const [p, q, share] = [poses[i], poses[Math.min(i + 1, poses.length - 1)], Math.min(1, index - i)];
  const turn = Math.atan2(Math.sin(q[2] - p[2]), Math.cos(q[2] - p[2]));
  return [between(p[0], q[0], share), between(p[1], q[1], share), p[2] + share * turn];
}

// Smooth edges cost a processor four times the work.
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

class Stage implements Replay {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly world = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(45, 1, 0.02, 200);
  private readonly controls: OrbitControls;
  private readonly robot: Robot;
  private readonly tilted = new THREE.Group();  // the floor and all on it
  private colours: Colours;
  private current!: ReplayRun;
  private number = 0;
  private index = 0;
  private parts: THREE.Object3D[] = [];
  private shadows: {robot: Robot; poses: Pose[]; trail: Band}[] = [];
  private trail!: Band;
  private discs: THREE.Mesh[] = [];
  private mode: View = "whole";
  private withGhosts = true;
  private changed = true;
  private quality = 1;
  private slow = 0;
  private drawn_ms = 0;
  private readonly ghostModels = new Map<string, Robot>();

  constructor(private readonly canvas: HTMLCanvasElement, private readonly scene: ReplayScene) {
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: !drawsInSoftware()});
    this.quality = (window.devicePixelRatio || 1) > 1 ? 0 : 1;
    this.renderer.setPixelRatio(RATIOS[this.quality]);
    this.camera.up.set(0, 0, 1);
    this.colours = coloursOf(canvas);
    this.robot = new Robot(scene.robot);
    const sun = new THREE.DirectionalLight(0xffffff, 2.2);
    sun.position.set(-3, -4, 8);
    this.world.add(new THREE.HemisphereLight(0xffffff, 0x8890a0, 1.6), sun, this.tilted);
    this.tilted.add(this.robot.object);
    const {slope_rad: slope = 0, downhill_rad: down = 0} = scene.floor ?? {};
    if (slope) this.tilted.quaternion.setFromAxisAngle(new THREE.Vector3(-Math.sin(down), Math.cos(down), 0), slope);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableZoom = false;  // the wheel scrolls the page, until the picture was clicked
    this.controls.maxPolarAngle = Math.PI / 2 - 0.02;
    this.controls.addEventListener("change", () => (this.changed = true));
    canvas.addEventListener("focus", () => (this.controls.enableZoom = true));
    canvas.addEventListener("blur", () => (this.controls.enableZoom = false));
    this.recolour();
  }

  recolour(): void {
    this.colours = coloursOf(this.canvas);
    this.world.background = this.colours.page;
    this.ghostModels.clear();
    this.run(this.number);
  }

  run(number: number): void {
    this.number = number;
    this.current = this.scene.runs[number];
    for (const part of this.parts) this.tilted.remove(part);
    const c = this.colours;
    const own = this.current.direction === "ccw" ? c.ccw : c.cw;
    const width = Math.max(0.012, this.robot.wheelbase * 0.06);
    const slides = (i: number) => [4, 5].some((k) => (this.current.wheels?.[i]?.[k] ?? 0) > SLIDES);
    this.trail = new Band(this.current.poses, width, 0.004, (i) => (slides(i) ? c.bad : own));
    this.shadows = this.current.ghosts.map((ghost) => {
      const colour = new THREE.Color(getComputedStyle(this.canvas).getPropertyValue(ghost.colour).trim());
      const robot = this.ghostModels.get(ghost.name) ?? this.robot.ghost(colour);
      this.ghostModels.set(ghost.name, robot);
      return {robot, poses: ghost.poses, trail: new Band(ghost.poses, width * 0.5, 0.003, () => colour)};
    });
    this.discs = [0, 1].map(() => new THREE.Mesh(new THREE.RingGeometry(this.robot.radius * 0.75, this.robot.radius * 1.1, 32), new THREE.MeshBasicMaterial()));
    this.parts = [ground(this.current, this.scene, c), this.trail.mesh, ...this.shadows.flatMap((s) => [s.robot.object, s.trail.mesh]), ...this.discs];
    this.tilted.add(...this.parts);
    this.at(Math.min(this.index, this.current.poses.length - 1));
    this.view(this.mode);
  }

  at(index: number): void {
    const before = this.robot.object.position.clone();
    this.index = index;
    const pose = poseAt(this.current.poses, index);
    this.robot.place(pose);
    this.trail.until(index);
    for (const s of this.shadows) {
      s.robot.place(poseAt(s.poses, index));
      s.trail.until(index);
      s.robot.object.visible = s.trail.mesh.visible = this.withGhosts;
    }
    this.showWheels(index, pose);
    if (this.mode === "follow") {
      const moved = this.robot.object.position.clone().sub(before);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
    }
    this.changed = true;
  }

  // Turned as they were; a ring under each tells its load by colour, and sliding in red.
  private showWheels(index: number, [x, y, theta]: Pose): void {
    const rows = this.current.wheels;
    this.discs.forEach((disc) => (disc.visible = !!rows));
    if (!rows) return;
    const i = Math.max(0, Math.min(Math.floor(index), rows.length - 2));
    const [p, q] = [rows[i], rows[Math.min(i + 1, rows.length - 1)]];
    const now = p.map((v, k) => between(v, q[k], Math.min(1, index - i)));
    this.robot.turn(now[0], now[1]);
    const most = (this.scene.robot.weight_n || 1) / 2;
    this.discs.forEach((disc, w) => {
      const side = (w === 0 ? 1 : -1) * this.robot.wheelbase / 2;
      disc.position.set(x - side * Math.sin(theta), y + side * Math.cos(theta), 0.006);
      disc.visible = now.length > 2;
      const colour = (disc.material as THREE.MeshBasicMaterial).color;
      if ((q[4 + w] ?? 0) > SLIDES) colour.copy(this.colours.bad);
      else colour.copy(this.colours.grid).lerp(this.colours.accent, Math.min(1, Math.max(0, (now[2 + w] ?? 0) / most)));
    });
  }

  view(mode: View): void {
    this.mode = mode;
    const [x, y, theta] = poseAt(this.current.poses, this.index);
    const box = new THREE.Box2();
    for (const p of [...this.current.poses, ...this.current.ghosts.flatMap((g) => g.poses)]) box.expandByPoint(new THREE.Vector2(p[0], p[1]));
    const centre = box.getCenter(new THREE.Vector2());
    const half = box.getSize(new THREE.Vector2()).multiplyScalar(0.5).addScalar(this.robot.wheelbase * 1.5);
    const tan = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    const distance = 1.12 * Math.max(half.y / tan * (mode === "above" ? 1 : 0.8), half.x / tan / this.camera.aspect);
    if (mode === "follow") {
      const back = Math.max(0.5, this.robot.wheelbase * 4.5);
      this.controls.target.set(x, y, this.robot.radius);
      this.camera.position.set(x - back * Math.cos(theta) + 0.35 * back * Math.sin(theta), y - back * Math.sin(theta) - 0.35 * back * Math.cos(theta), back * 0.6);
    } else {
      this.controls.target.set(centre.x, centre.y, 0);
      // Not exactly from above: the turn about the upright axis would be undefined.
      const [up, aside] = mode === "above" ? [1.02, 0.001] : [0.75, 0.8];
      this.camera.position.set(centre.x, centre.y - aside * distance * 1.05, up * distance);
    }
    this.controls.update();
    this.changed = true;
  }

  ghosts(shown: boolean): void {
    this.withGhosts = shown;
    this.at(this.index);
  }

  draw(): void {
    if (!this.changed) return;
    this.changed = false;
    this.adapt(performance.now());
    this.renderer.render(this.world, this.camera);
    this.canvas.dataset.frames = String(Number(this.canvas.dataset.frames ?? 0) + 1);
  }

  resize(width: number, height: number): void {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.view(this.mode);
  }

  // Several slow pictures one after the other; one alone is chance.
  private adapt(now_ms: number): void {
    const passed_ms = now_ms - this.drawn_ms;
    this.drawn_ms = now_ms;
    if (passed_ms > 1000) return;  // it stood still meanwhile
    this.slow = passed_ms > SLOW_ms ? this.slow + 1 : Math.max(0, this.slow - 1);
    if (this.slow < 12 || this.quality + 1 >= RATIOS.length) return;
    this.slow = 0;
    this.renderer.setPixelRatio(RATIOS[++this.quality]);
  }

  pose(): Pose {
    return this.robot.pose();
  }

  wheelAngles(): [number, number] {
    return this.robot.angles();
  }
}

window.umbsimReplay = (canvas, scene) => new Stage(canvas, scene);
