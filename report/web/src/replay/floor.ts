// What lies on the floor: grid, the square that was asked for, cables, patches, which way it falls.

import * as THREE from "three";
import type {ReplayRun, ReplayScene} from "./types";

export interface Colours {
  page: THREE.Color;
  floor: THREE.Color;
  grid: THREE.Color;
  ink: THREE.Color;
  cw: THREE.Color;
  ccw: THREE.Color;
  bump: THREE.Color;
  accent: THREE.Color;
  muted: THREE.Color;
  bad: THREE.Color;
}

const flat = (material: THREE.MaterialParameters & {color: THREE.Color}): THREE.Material =>
    new THREE.MeshBasicMaterial({polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1, ...material});

/// A band on the floor along points, with a colour at each.
export class Band {
  readonly mesh: THREE.Mesh;
  private readonly count: number;

  constructor(points: number[][], width: number, height: number, colourAt: (i: number) => THREE.Color) {
    const [positions, colours, index]: number[][] = [[], [], []];
    this.count = points.length;
    points.forEach(([x, y], i) => {
      const [a, b] = [points[Math.max(0, i - 1)], points[Math.min(points.length - 1, i + 1)]];
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
      const [nx, ny] = [-(b[1] - a[1]) / length * width / 2, (b[0] - a[0]) / length * width / 2];
      positions.push(x + nx, y + ny, height, x - nx, y - ny, height);
      const c = colourAt(i);
      colours.push(c.r, c.g, c.b, c.r, c.g, c.b);
      if (i > 0) index.push(2 * i - 2, 2 * i - 1, 2 * i, 2 * i - 1, 2 * i + 1, 2 * i);
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
    geometry.setIndex(index);
    this.mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({vertexColors: true, side: THREE.DoubleSide}));
    this.mesh.frustumCulled = false;
  }

  /// Only so far.
  until(index: number): void {
    this.mesh.geometry.setDrawRange(0, 6 * Math.max(0, Math.min(this.count - 1, Math.floor(index))));
  }
}

export function ground(run: ReplayRun, scene: ReplayScene, c: Colours): THREE.Group {
  const group = new THREE.Group();
  const all = [...run.poses, ...run.ghosts.flatMap((g) => g.poses)];
  const reach = Math.ceil(Math.max(2, ...all.map((p) => Math.max(Math.abs(p[0]), Math.abs(p[1])))) + 2);
  const plane = new THREE.Mesh(new THREE.PlaneGeometry(2 * reach, 2 * reach), new THREE.MeshBasicMaterial({color: c.floor}));
  plane.position.z = -0.003;
  const lines = new THREE.GridHelper(2 * reach, 2 * reach, c.ink, c.grid);
  lines.rotation.x = Math.PI / 2;
  lines.position.z = -0.001;
  group.add(plane, lines);
  if (scene.side_m) group.add(courseOf(run, scene.side_m, c));
  for (const p of scene.floor?.patches ?? []) {
    const disc = new THREE.Mesh(new THREE.CircleGeometry(p.radius_m, 48), flat({color: c.bump, transparent: true, opacity: 0.35}));
    disc.position.set(p.x_m, p.y_m, 0.001);
    group.add(disc);
  }
  for (const cable of run.cables) {
    const across = cable.direction_rad ?? Math.PI / 2;
    const rod = new THREE.Mesh(new THREE.CylinderGeometry(cable.height_m / 2, cable.height_m / 2, cable.length_m ?? 0.08, 12), new THREE.MeshLambertMaterial({color: c.bump}));
    rod.position.set(cable.x_m, cable.y_m, cable.height_m / 2);
    rod.rotation.z = across - Math.PI / 2;
    group.add(rod);
  }
  if (scene.floor?.slope_rad) {
    const down = scene.floor.downhill_rad ?? 0;
    group.add(new THREE.ArrowHelper(new THREE.Vector3(Math.cos(down), Math.sin(down), 0), new THREE.Vector3(0, 0, 0.02), 1, c.accent.getHex(), 0.25, 0.15));
  }
  return group;
}

// The square from the start pose on, to the side that the run turns to.
function courseOf(run: ReplayRun, side: number, c: Colours): THREE.Object3D {
  const [x, y, theta] = run.poses[0];
  const s = run.direction === "cw" ? -side : side;
  const corners = [[0, 0], [side, 0], [side, s], [0, s], [0, 0]].map(([u, v]) => [
    x + u * Math.cos(theta) - v * Math.sin(theta), y + u * Math.sin(theta) + v * Math.cos(theta)]);
  const points = corners.slice(1).flatMap((to, i) => [corners[i], to]).map(([u, v]) => new THREE.Vector3(u, v, 0.001));
  return new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({color: c.muted}));
}
