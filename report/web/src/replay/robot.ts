// The robot from its URDF: primitives, and the meshes that came with the page; wheels that turn.

import * as THREE from "three";
import {ColladaLoader} from "three/examples/jsm/loaders/ColladaLoader.js";
import {STLLoader} from "three/examples/jsm/loaders/STLLoader.js";
import URDFLoader, {type URDFJoint, type URDFRobot} from "urdf-loader";
import type {Figures, Pose} from "../run/data";

const bytesOf = (base64: string): Uint8Array => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

function meshOf(name: string, base64: string, material: THREE.Material): THREE.Object3D | null {
  const bytes = bytesOf(base64);
  if (/\.stl$/i.test(name)) return new THREE.Mesh(new STLLoader().parse(bytes.buffer as ArrayBuffer), material);
  const text = new TextDecoder().decode(bytes).replace(/<library_images[\s\S]*?<\/library_images>/g, "");
  return new ColladaLoader().parse(text, "")?.scene ?? null;
}

// Nothing is fetched: textures are left out, and meshes come from the page or not at all.
function urdfOf(text: string): Document {
  const urdf = new DOMParser().parseFromString(text, "application/xml");
  urdf.querySelectorAll("texture").forEach((texture) => texture.remove());
  return urdf;
}

export class Robot {
  /// Origin on the floor below the axle's middle, x forward, z up.
  readonly object = new THREE.Group();
  readonly radius: number;
  readonly wheelbase: number;
  private readonly wheels: {joint: URDFJoint; sense: number}[] = [];

  constructor(private readonly scene: Figures) {
    this.radius = scene.wheel_radius_m || 0.05;
    const urdf = this.load();
    urdf.updateMatrixWorld(true);
    const joints = [scene.left_joint, scene.right_joint].map((name) => urdf.joints[name]);
    const [left, right] = joints.map((joint) => joint.getWorldPosition(new THREE.Vector3()));
    const middle = left.clone().add(right).multiplyScalar(0.5);
    const across = left.clone().sub(right);
    this.wheelbase = across.length();
    across.normalize();
    const forward = across.clone().cross(new THREE.Vector3(0, 0, 1)).normalize();
    joints.forEach((joint) => {
      const axis = joint.axis.clone().applyQuaternion(joint.getWorldQuaternion(new THREE.Quaternion()));
      this.wheels.push({joint, sense: Math.sign(axis.dot(across)) || 1});
      joint.add(this.spoke(joint.axis));
    });
    const upright = new THREE.Group();
    urdf.position.set(-middle.x, -middle.y, this.radius - middle.z);
    upright.rotation.z = -Math.atan2(forward.y, forward.x);
    upright.add(urdf);
    this.object.add(upright);
    this.object.add(this.arrow());
  }

  private load(): URDFRobot {
    const loader = new URDFLoader();
    loader.parseCollision = true;
    loader.packages = (name: string) => `package://${name}`;
    loader.loadMeshCb = (path, _manager, material, done) => {
      const base64 = this.scene.meshes?.[path];
      const mesh = base64 ? meshOf(path, base64, material) : null;
      done((mesh ?? new THREE.Group()) as THREE.Object3D);
    };
    const robot = loader.parse(urdfOf(this.scene.urdf));
    const wheels = [this.scene.left_joint, this.scene.right_joint].map((name) => robot.joints[name]);
    // The file gives no colour: the body is grey, tyres are dark.
    robot.traverse((part: THREE.Object3D) => {
      const colour = ((part as THREE.Mesh).material as THREE.MeshPhongMaterial | undefined)?.color;
      if (colour?.getHex() !== 0xffffff) return;
      let wheel = false;
      part.traverseAncestors((above) => (wheel ||= wheels.includes(above as URDFJoint)));
      (part as THREE.Mesh).material = new THREE.MeshLambertMaterial({color: wheel ? 0x2c323c : 0x6f86a3});
    });
    // Collision shapes stand in where a link shows nothing.
    robot.traverse((part: THREE.Object3D) => {
      const shape = part as THREE.Object3D & {isURDFCollider?: boolean};
      if (!shape.isURDFCollider) return;
      const seen = shape.parent!.children.some((c) => (c as {isURDFVisual?: boolean}).isURDFVisual && hasMesh(c));
      shape.visible = !seen;
    });
    return robot;
  }

  // A bright bar on the wheel, so that one sees it turn.
  private spoke(axis: THREE.Vector3): THREE.Object3D {
    const bar = new THREE.Mesh(new THREE.BoxGeometry(this.radius * 0.24, this.radius * 0.9, this.radius * 1.9),
                               new THREE.MeshLambertMaterial({color: 0xf2c230}));
    bar.scale.y = Math.min(1, 0.055 / (this.radius * 0.9));
    bar.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis.clone().normalize());
    return bar;
  }

  // Which way is forward.
  private arrow(): THREE.Object3D {
    const size = Math.max(this.radius, this.wheelbase / 4);
    const cone = new THREE.Mesh(new THREE.ConeGeometry(size * 0.35, size, 16), new THREE.MeshLambertMaterial({color: 0xf2c230}));
    cone.rotation.z = -Math.PI / 2;
    const top = new THREE.Box3().setFromObject(this.object).max.z;
    cone.position.set(size * 0.6, 0, Number.isFinite(top) ? top + size * 0.3 : this.radius * 3);
    return cone;
  }

  place([x, y, theta]: Pose): void {
    this.object.position.set(x, y, this.object.position.z);
    this.object.rotation.z = theta;
  }

  turn(left: number, right: number): void {
    [left, right].forEach((angle, i) => this.wheels[i].joint.setJointValue(angle * this.wheels[i].sense));
  }

  angles(): [number, number] {
    return this.wheels.map((w) => (w.joint.angle as number) * w.sense) as [number, number];
  }

  /// Read back from the scene.
  pose(): Pose {
    this.object.updateMatrixWorld(true);
    const local = this.object.parent ? this.object.matrix : this.object.matrixWorld;
    const e = local.elements;
    return [e[12], e[13], Math.atan2(e[1], e[0])];
  }

  /// The same robot in one see-through colour.
  ghost(colour: THREE.Color): Robot {
    const ghost = new Robot(this.scene);
    ghost.object.traverse((part) => {
      const mesh = part as THREE.Mesh;
      if (mesh.isMesh) mesh.material = new THREE.MeshLambertMaterial({color: colour, transparent: true, opacity: 0.35, depthWrite: false,
                                                                         polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2});
    });
    return ghost;
  }
}

function hasMesh(object: THREE.Object3D): boolean {
  let found = false;
  object.traverse((part) => {
    found ||= (part as THREE.Mesh).isMesh === true;
  });
  return found;
}
