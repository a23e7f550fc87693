// The three-dimensional view: figures, what they should do, what they stand on, and the forces on them.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { numbers } from "./client.js";
import type { Body } from "./gen/sinew/v1/body_pb.js";
import type { FigureFrame } from "./gen/sinew/v1/frame_pb.js";
import { displacement, forward, ghostOpacity, mixPoses, POSE, type Person } from "./model.js";
import { Touchable, type Touch } from "./picking.js";

/** What is shown besides the figures. */
export interface Shown {
  ghost: boolean;
  forces: boolean;
  support: boolean;
  effort: boolean;
}

/** Colours of the two themes. */
const LOOKS = {
  light: { sky: 0xe9edf0, ground: 0xfafbfc, line: "#d2d9de", body: 0xb9c4cc, ghost: 0x2f7d9d, sun: 2.4, fill: 1.7 },
  dark: { sky: 0x171d22, ground: 0x39424a, line: "#4c5862", body: 0x98a5af, ghost: 0x6cc3e0, sun: 1.7, fill: 1.1 },
};
/** Blue, vermilion, yellow and green of Okabe and Ito: told apart with any colour vision. */
export const HUES = {
  com: 0x0072b2,
  zmp: 0xd55e00,
  force: 0x009e73,
  push: 0xcc79a7,
  support: 0x56b4e9,
  help: 0xe69f00,
};
/** Length of an arrow, m per N. */
const METRES_PER_NEWTON = 1 / 700;
/** The same of a moment, m per N·m. */
const METRES_PER_NEWTON_METRE = 1 / 300;
/** Distance of the two heads of a moment's arrow, m. */
const HEADS_APART = 0.05;
const MOST_ARROWS = 16;
const MOST_SEGMENTS = 18;
/** Sides of the crate, m. */
const CRATE = [0.3, 0.3, 0.22] as const;

interface Effort {
  used: { value: Float32Array };
  atLimit: { value: Float32Array };
  shown: { value: number };
  chosen: { value: number };
}

/** Tints each segment by the torque used of the torque available, and draws stripes over it at the limit. */
function effortMaterial(colour: number): { material: THREE.MeshLambertMaterial; effort: Effort } {
  const effort: Effort = {
    used: { value: new Float32Array(MOST_SEGMENTS) },
    atLimit: { value: new Float32Array(MOST_SEGMENTS) },
    shown: { value: 1 },
    chosen: { value: 0 },
  };
  const material = new THREE.MeshLambertMaterial({ color: colour });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.uUsed = effort.used;
    shader.uniforms.uAtLimit = effort.atLimit;
    shader.uniforms.uShown = effort.shown;
    shader.uniforms.uChosen = effort.chosen;
    shader.vertexShader = shader.vertexShader
      .replace(
        "#include <common>",
        `#include <common>
attribute float segment;
uniform float uUsed[${MOST_SEGMENTS}];
uniform float uAtLimit[${MOST_SEGMENTS}];
varying float vUsed;
varying float vAtLimit;
varying vec3 vPlace;`,
      )
      .replace(
        "#include <begin_vertex>",
        `#include <begin_vertex>
int index = int(segment + 0.5);
vUsed = uUsed[index];
vAtLimit = uAtLimit[index];
vPlace = position;`,
      );
    shader.fragmentShader = shader.fragmentShader
      .replace(
        "#include <common>",
        `#include <common>
uniform float uShown;
uniform float uChosen;
varying float vUsed;
varying float vAtLimit;
varying vec3 vPlace;`,
      )
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
vec3 warm = mix(vec3(0.87, 0.52, 0.05), vec3(0.62, 0.09, 0.0), smoothstep(0.6, 1.0, vUsed));
diffuseColor.rgb = mix(diffuseColor.rgb, warm, uShown * smoothstep(0.2, 0.75, vUsed));
float stripe = step(0.5, fract((vPlace.x + vPlace.y + vPlace.z) * 22.0));
diffuseColor.rgb = mix(diffuseColor.rgb, vec3(1.0, 0.86, 0.55), uShown * vAtLimit * stripe);`,
      )
      .replace(
        "#include <opaque_fragment>",
        `float rim = pow(1.0 - saturate(dot(normalize(vViewPosition), normal)), 2.5);
outgoingLight += uChosen * rim * vec3(0.15, 0.5, 0.7);
#include <opaque_fragment>`,
      );
  };
  return { material, effort };
}

/** Opacity of the desired motion where it is far from the simulated one. */
const GHOST_OPACITY = 0.34;

/**
 * The desired motion: each segment has its own opacity, and none is drawn where it is 0. The offset puts the surface
 * behind the body's where both nearly coincide, so that depths that differ by rounding cannot flicker.
 */
function ghostMaterial(colour: number): { material: THREE.MeshBasicMaterial; fade: { value: Float32Array } } {
  const fade = { value: new Float32Array(MOST_SEGMENTS) };
  const material = new THREE.MeshBasicMaterial({
    color: colour,
    transparent: true,
    opacity: GHOST_OPACITY,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 4,
  });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.uFade = fade;
    shader.vertexShader = shader.vertexShader
      .replace(
        "#include <common>",
        `#include <common>\nattribute float segment;\nuniform float uFade[${MOST_SEGMENTS}];\nvarying float vFade;`,
      )
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvFade = uFade[int(segment + 0.5)];");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float vFade;")
      .replace(
        "#include <color_fragment>",
        "#include <color_fragment>\nif (vFade <= 0.0) discard;\ndiffuseColor.a *= vFade;",
      );
  };
  return { material, fade };
}

/** One closed surface for all segments, each vertex bound to its segment. */
function surface(body: Body): THREE.BufferGeometry {
  const position: number[] = [];
  const index: number[] = [];
  const segment: number[] = [];
  body.segments.forEach((s, i) => {
    const start = position.length / 3;
    for (const v of s.meshVerticesM) position.push(v);
    for (const t of s.meshTriangles) index.push(start + t);
    for (let k = 0; k < s.meshVerticesM.length / 3; k++) segment.push(i);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  geometry.setAttribute("segment", new THREE.Float32BufferAttribute(segment, 1));
  const four = new Uint16Array(segment.length * 4);
  const weight = new Float32Array(segment.length * 4);
  segment.forEach((s, i) => {
    four[4 * i] = s;
    weight[4 * i] = 1;
  });
  geometry.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(four, 4));
  geometry.setAttribute("skinWeight", new THREE.Float32BufferAttribute(weight, 4));
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 1e4);
  return geometry;
}

/** A skinned surface whose bones are set from poses. */
class Solid {
  readonly mesh: THREE.SkinnedMesh;
  private readonly bones: THREE.Bone[];
  readonly poses: Float32Array;

  constructor(geometry: THREE.BufferGeometry, material: THREE.Material, segments: number) {
    this.bones = Array.from({ length: segments }, () => {
      const bone = new THREE.Bone();
      bone.matrixAutoUpdate = false;
      bone.matrixWorldAutoUpdate = false;
      return bone;
    });
    this.poses = new Float32Array(segments * POSE);
    this.mesh = new THREE.SkinnedMesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.bind(
      new THREE.Skeleton(
        this.bones,
        this.bones.map(() => new THREE.Matrix4()),
      ),
      new THREE.Matrix4(),
    );
  }

  place(): void {
    const [position, rotation, one] = [scratchA, scratchQ, scratchOne];
    this.bones.forEach((bone, i) => {
      const o = i * POSE;
      position.set(this.poses[o], this.poses[o + 1], this.poses[o + 2]);
      rotation.set(this.poses[o + 3], this.poses[o + 4], this.poses[o + 5], this.poses[o + 6]);
      bone.matrixWorld.compose(position, rotation, one);
    });
  }

  dispose(): void {
    this.mesh.skeleton.dispose();
    (this.mesh.material as THREE.Material).dispose();
  }
}

const scratchA = new THREE.Vector3();
const scratchB = new THREE.Vector3();
const scratchC = new THREE.Vector3();
const scratchQ = new THREE.Quaternion();
const scratchPlane = new THREE.Plane();
const scratchOne = new THREE.Vector3(1, 1, 1);

/** A solid arrow of variable length along its own y. */
/** An arrow; that of a moment has two heads. */
function arrow(colour: number, overBodies = false, heads = 1): THREE.Group {
  const group = new THREE.Group();
  const material = new THREE.MeshBasicMaterial({ color: colour, depthTest: !overBodies });
  const shaft = new THREE.Mesh(arrowShaft, material);
  group.add(shaft, ...Array.from({ length: heads }, () => new THREE.Mesh(arrowHead, material)));
  if (overBodies) for (const part of group.children) part.renderOrder = 3;
  group.visible = false;
  return group;
}
const arrowShaft = new THREE.CylinderGeometry(0.01, 0.01, 1, 8).translate(0, 0.5, 0);
const arrowHead = new THREE.ConeGeometry(0.024, 0.06, 12).translate(0, 0.03, 0);
const UP = new THREE.Vector3(0, 1, 0);

function point(arrowGroup: THREE.Group, from: THREE.Vector3, along: THREE.Vector3): void {
  const length = along.length();
  arrowGroup.visible = length > 0.01;
  if (!arrowGroup.visible) return;
  const [shaft, ...heads] = arrowGroup.children;
  const shaftLength = Math.max(0.001, length - 0.06);
  shaft.scale.set(1, shaftLength, 1);
  heads.forEach((head, i) => (head.position.y = shaftLength - i * HEADS_APART));
  arrowGroup.position.copy(from);
  arrowGroup.quaternion.setFromUnitVectors(UP, scratchC.copy(along).divideScalar(length));
}

/** One figure in the scene. Materials are few in kind: each kind is a program to compile before the first picture. */
class Actor {
  readonly group = new THREE.Group();
  readonly solid: Solid;
  private readonly ghost: Solid;
  private readonly fade: { value: Float32Array };
  /** Largest distance of a point of each segment from its origin, m. */
  private readonly reach: number[];
  private readonly effort: Effort;
  private readonly crate: THREE.Group;
  private readonly weights: THREE.Mesh[] = [];
  private readonly polygon = new THREE.Mesh(
    new THREE.BufferGeometry(),
    new THREE.MeshBasicMaterial({
      color: HUES.support,
      transparent: true,
      opacity: 0.35,
      depthWrite: false,
      side: THREE.DoubleSide,
    }),
  );
  private readonly outline = new THREE.LineLoop(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: HUES.support, transparent: true }),
  );
  private readonly com = new THREE.Mesh(comShape, new THREE.MeshBasicMaterial({ color: HUES.com }));
  private readonly plumb = new THREE.Line(
    new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), new THREE.Vector3()]),
    new THREE.LineBasicMaterial({ color: HUES.com, transparent: true, opacity: 0.6 }),
  );
  private readonly zmp = new THREE.Mesh(
    zmpShape,
    new THREE.MeshBasicMaterial({ color: HUES.zmp, transparent: true, depthWrite: false, side: THREE.DoubleSide }),
  );
  private readonly arrows: THREE.Group[] = [];
  private readonly help = arrow(HUES.help, true);
  private readonly helpMoment = arrow(HUES.help, true, 2);
  private readonly hands: [number, number];
  private readonly touchable: Touchable;

  constructor(
    public person: Person,
    look: (typeof LOOKS)["light"],
  ) {
    const geometry = surface(person.body);
    const count = person.body.segments.length;
    const { material, effort } = effortMaterial(look.body);
    this.effort = effort;
    this.solid = new Solid(geometry, material, count);
    this.solid.mesh.castShadow = true;
    this.solid.mesh.receiveShadow = true;
    const ghost = ghostMaterial(look.ghost);
    this.fade = ghost.fade;
    this.ghost = new Solid(geometry, ghost.material, count);
    this.reach = person.body.segments.map((s) => {
      let most = 0;
      const v = s.meshVerticesM;
      for (let i = 0; i + 2 < v.length; i += 3) most = Math.max(most, Math.hypot(v[i], v[i + 1], v[i + 2]));
      return most;
    });
    this.ghost.mesh.renderOrder = 2;
    this.touchable = new Touchable(person.body);
    this.hands = [person.segment("l_hand"), person.segment("r_hand")];
    this.crate = makeCrate();
    for (let i = 0; i < MOST_WEIGHTS; i++) {
      const weight = new THREE.Mesh(weightShape, weightMaterial);
      weight.castShadow = true;
      this.weights.push(weight);
    }
    this.polygon.renderOrder = 1;
    this.zmp.renderOrder = 3;
    this.com.renderOrder = 4;
    (this.com.material as THREE.Material).depthTest = false;
    for (let i = 0; i < MOST_ARROWS; i++) this.arrows.push(arrow(HUES.force));
    this.group.add(
      this.solid.mesh,
      this.ghost.mesh,
      this.crate,
      ...this.weights,
      this.polygon,
      this.outline,
      this.com,
      this.plumb,
      this.zmp,
      ...this.arrows,
      this.help,
      this.helpMoment,
    );
    // Nothing is seen of it before the first frame that tells where it is.
    this.group.visible = false;
    this.group.traverse((o) => {
      if (o instanceof THREE.Mesh || o instanceof THREE.Line) o.frustumCulled = false;
    });
  }

  repaint(look: (typeof LOOKS)["light"]): void {
    (this.solid.mesh.material as THREE.MeshLambertMaterial).color.set(look.body);
    (this.ghost.mesh.material as THREE.MeshBasicMaterial).color.set(look.ghost);
  }

  update(before: FigureFrame, after: FigureFrame, share: number, shown: Shown, chosen: boolean): void {
    const to = numbers(after.segmentTransforms);
    if (to.length !== this.solid.poses.length) return;
    mixPoses(numbers(before.segmentTransforms), to, share, this.solid.poses);
    this.solid.place();
    this.tint(shown.effort, chosen);
    this.showGhost(before, after, share, shown.ghost);
    this.showLoads(after);
    this.showSupport(after, shown.support);
    this.showForces(after, shown.forces);
    this.showHelp(after);
  }

  private tint(shown: boolean, chosen: boolean): void {
    const { used, atLimit } = this.effort;
    used.value.fill(0);
    atLimit.value.fill(0);
    this.person.body.dofs.forEach((d, i) => {
      used.value[d.joint] = Math.max(used.value[d.joint], this.person.used[i]);
      if (!Number.isNaN(this.person.limitSince[i])) atLimit.value[d.joint] = 1;
    });
    this.effort.shown.value = shown ? 1 : 0;
    this.effort.chosen.value = chosen ? 1 : 0;
  }

  private readonly wanted = [new Float32Array(POSE * MOST_SEGMENTS), new Float32Array(POSE * MOST_SEGMENTS)];

  private showGhost(before: FigureFrame, after: FigureFrame, share: number, shown: boolean): void {
    const [a, b] = [before.desired ?? after.desired, after.desired];
    const rotations = numbers(b?.jointRotations);
    this.ghost.mesh.visible = shown && rotations.length === 4 * (this.person.body.segments.length - 1);
    if (!this.ghost.mesh.visible || !a || !b) return;
    forward(this.person.body, numbers(a.rootPose), numbers(a.jointRotations), this.wanted[0]);
    forward(this.person.body, numbers(b.rootPose), rotations, this.wanted[1]);
    mixPoses(this.wanted[0], this.wanted[1], share, this.ghost.poses);
    // Where both agree there is nothing to show.
    let shows = false;
    this.reach.forEach((reach, i) => {
      this.fade.value[i] = ghostOpacity(displacement(this.ghost.poses, this.solid.poses, i * POSE, reach));
      shows ||= this.fade.value[i] > 0;
    });
    this.ghost.mesh.visible = shows;
    if (!shows) return;
    this.ghost.place();
  }

  private showLoads(frame: FigureFrame): void {
    const loads = frame.status?.loads ?? [];
    const place = (i: number, out: THREE.Vector3): THREE.Vector3 => {
      const { segment, pointM: p } = loads[i];
      return this.world(segment, out.set(p?.x ?? 0, p?.y ?? 0, p?.z ?? 0), out);
    };
    const [l, r] = this.hands.map((hand) => loads.findIndex((x) => x.segment === hand));
    const crate = l >= 0 && r >= 0 && loads.length === 2 && this.person.holdsCrate();
    this.crate.visible = crate;
    this.weights.forEach((weight, i) => {
      weight.visible = !crate && i < loads.length && loads[i].massKg > 0;
      if (!weight.visible) return;
      place(i, weight.position);
      weight.scale.setScalar(Math.cbrt(loads[i].massKg / IRON));
    });
    if (!crate) return;
    const left = place(l, scratchA);
    const right = place(r, scratchB);
    this.crate.position.copy(left).add(right).multiplyScalar(0.5);
    const across = left.clone().sub(right);
    const width = across.length();
    across.divideScalar(width || 1);
    const up = new THREE.Vector3(0, 0, 1).addScaledVector(across, -across.z);
    if (up.lengthSq() < 0.01) up.set(1, 0, 0).addScaledVector(across, -across.x);
    up.normalize();
    this.crate.quaternion.setFromRotationMatrix(
      new THREE.Matrix4().makeBasis(new THREE.Vector3().crossVectors(across, up), across, up),
    );
    this.crate.scale.set(1, Math.max(0.4, width / CRATE[1]), 1);
  }

  private showSupport(frame: FigureFrame, shown: boolean): void {
    const balance = frame.balance;
    const corners = numbers(balance?.polygon);
    const zmp = numbers(balance?.zmp);
    const com = numbers(balance?.com);
    this.polygon.visible = this.outline.visible = shown && corners.length >= 6;
    if (this.polygon.visible) {
      const count = corners.length / 2;
      const position = new Float32Array(3 * count);
      const index: number[] = [];
      for (let i = 0; i < count; i++) {
        position.set([corners[2 * i], corners[2 * i + 1], 0.004], 3 * i);
        if (i >= 2) index.push(0, i - 1, i);
      }
      for (const shape of [this.polygon, this.outline]) {
        const kept = shape.geometry.getAttribute("position") as THREE.BufferAttribute | undefined;
        if (kept?.count === count) {
          kept.array.set(position);
          kept.needsUpdate = true;
        } else {
          shape.geometry.dispose();
          shape.geometry = new THREE.BufferGeometry();
          shape.geometry.setAttribute("position", new THREE.BufferAttribute(position.slice(), 3));
          if (shape === this.polygon) shape.geometry.setIndex(index);
        }
      }
    }
    this.zmp.visible = shown && zmp.length === 3;
    if (this.zmp.visible) this.zmp.position.set(zmp[0], zmp[1], 0.008);
    this.com.visible = this.plumb.visible = shown && com.length === 3;
    if (this.com.visible) {
      this.com.position.set(com[0], com[1], com[2]);
      const line = this.plumb.geometry.getAttribute("position") as THREE.BufferAttribute;
      line.setXYZ(0, com[0], com[1], com[2]);
      line.setXYZ(1, com[0], com[1], 0.005);
      line.needsUpdate = true;
    }
  }

  /** Help is not physics: it is shown whenever it acts, and begins inside the pelvis. */
  private showHelp(frame: FigureFrame): void {
    const assist = numbers(frame.assist);
    const pelvis = scratchB.fromArray(this.solid.poses);
    const part = (at: number): THREE.Vector3 =>
      assist.length === 6 ? scratchA.fromArray(assist as number[], at) : scratchA.set(0, 0, 0);
    point(this.helpMoment, pelvis, part(0).multiplyScalar(METRES_PER_NEWTON_METRE));
    point(this.help, pelvis, part(3).multiplyScalar(METRES_PER_NEWTON));
  }

  private showForces(frame: FigureFrame, shown: boolean): void {
    // One arrow per segment that touches: the sum, at its centre of pressure.
    const position = numbers(frame.contacts?.position);
    const force = numbers(frame.contacts?.force);
    const sums = new Map<number, { force: THREE.Vector3; place: THREE.Vector3; weight: number }>();
    frame.contacts?.segment.forEach((segment, i) => {
      let sum = sums.get(segment);
      if (!sum) sums.set(segment, (sum = { force: new THREE.Vector3(), place: new THREE.Vector3(), weight: 0 }));
      scratchB.fromArray(force as number[], 3 * i);
      const weight = scratchB.length();
      sum.force.add(scratchB);
      sum.place.addScaledVector(scratchA.fromArray(position as number[], 3 * i), weight);
      sum.weight += weight;
    });
    const all = shown ? [...sums.values()].filter((x) => x.weight > 1) : [];
    this.arrows.forEach((a, i) => {
      const sum = all[i];
      if (sum) point(a, sum.place.divideScalar(sum.weight), sum.force.multiplyScalar(METRES_PER_NEWTON));
      else a.visible = false;
    });
  }

  /** What a ray touches of this figure; a load counts as the hand, or whatever else carries it. */
  touch(ray: THREE.Raycaster, slack: number): Touch | undefined {
    const body = this.touchable.touch(ray.ray, this.solid.poses, slack);
    const carried = ray.intersectObjects([this.crate, ...this.weights].filter((o) => o.visible))[0];
    if (!carried || (body && body.off === 0 && body.distance <= carried.distance)) return body;
    let nearest: Touch | undefined;
    let least = Infinity;
    for (const { segment, pointM: p } of this.person.frame?.status?.loads ?? []) {
      const local = new THREE.Vector3(p?.x ?? 0, p?.y ?? 0, p?.z ?? 0);
      const away = this.world(segment, local, scratchA).distanceTo(carried.point);
      if (away < least) [least, nearest] = [away, { segment, local, distance: carried.distance, off: 0 }];
    }
    return nearest;
  }

  /** World position of a place on a segment. */
  world(segment: number, local: THREE.Vector3, out: THREE.Vector3): THREE.Vector3 {
    const o = segment * POSE;
    return out
      .copy(local)
      .applyQuaternion(scratchQ.fromArray(this.solid.poses, o + 3))
      .add(scratchC.fromArray(this.solid.poses, o));
  }

  /** Above the head, world. */
  top(out: THREE.Vector3): THREE.Vector3 {
    const head = Math.max(0, this.person.segment("head"));
    const o = head * POSE;
    return out.set(this.solid.poses[o], this.solid.poses[o + 1], this.solid.poses[o + 2] + 0.3);
  }

  dispose(): void {
    this.solid.mesh.geometry.dispose();
    this.solid.dispose();
    this.ghost.dispose();
  }
}

/** Mass of a ball of iron of 1 m radius, kg: loads that are no crate are drawn as iron balls. */
const IRON = 32_000;
const MOST_WEIGHTS = 8;
const weightShape = new THREE.SphereGeometry(1, 24, 16);
const weightMaterial = new THREE.MeshLambertMaterial({ color: 0x3a434a });
const comShape = new THREE.SphereGeometry(0.028, 16, 12);
const zmpShape = new THREE.RingGeometry(0.022, 0.04, 24);

function makeCrate(): THREE.Group {
  const group = new THREE.Group();
  const box = new THREE.Mesh(new THREE.BoxGeometry(...CRATE), new THREE.MeshLambertMaterial({ color: 0xb98b54 }));
  box.castShadow = true;
  box.receiveShadow = true;
  const slat = new THREE.MeshLambertMaterial({ color: 0x8a6336 });
  group.add(box);
  for (const z of [-0.5, 0.5])
    for (const x of [-0.5, 0.5]) {
      const edge = new THREE.Mesh(new THREE.BoxGeometry(0.03, CRATE[1] * 1.02, 0.03), slat);
      edge.position.set(x * CRATE[0], 0, z * CRATE[2]);
      edge.castShadow = true;
      group.add(edge);
    }
  return group;
}

/** A push being drawn. */
export interface Push {
  person: Person;
  segment: string;
  /** Where, segment frame, m. */
  local: THREE.Vector3;
  /** World, N·s. */
  impulse: THREE.Vector3;
}

/** Impulse per metre drawn, N·s. */
const IMPULSE_PER_METRE = 80;
const MOST_IMPULSE = 200;
/** Height of what lies over the lower edge of the picture, pixels. */
const BAR = 84;
/** Pixels drawn below which a press only chooses. */
const LEAST_DRAWN = 6;
/** Pixels beside a figure that still count as on it: a finger is broader than a mouse. */
const SLACK = { mouse: 8, touch: 22 };
/** Time constant with which the view follows a figure, s. */
const FOLLOW_S = 0.3;
/** Height above the floor that the view looks at while it follows: the pelvis, but within these bounds, m. */
const FOLLOW_HEIGHT = { least: 0.45, most: 1.4 };
/** Movement of the point looked at by a drag from which on the user has taken the view over, m. */
const PANNED = 0.002;

export class Scene {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(36, 1, 0.05, 200);
  private readonly orbit: OrbitControls;
  private readonly actors = new Map<number, Actor>();
  private readonly sun = new THREE.DirectionalLight(0xffffff, 2.4);
  private readonly fill = new THREE.HemisphereLight(0xffffff, 0x8a949c, 1.4);
  private readonly ground: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshLambertMaterial>;
  private readonly pushArrow = arrow(HUES.push);
  private look = LOOKS.light;
  /** The push being drawn: where it takes hold, where the pointer went down and where it is, pixels of the window. */
  private push:
    { actor: Actor; segment: number; drawn: Push; start: THREE.Vector2; pointer: THREE.Vector2 } | undefined;
  /** Where the pointer hovers, since that was last looked at. */
  private hovered: PointerEvent | undefined;
  private readonly ray = new THREE.Raycaster();
  private moved = false;
  private followed = false;
  /** The point that was looked at when a drag of the view began, moved along with what the view follows. */
  private dragged: THREE.Vector3 | undefined;
  private preparedAt = NaN;
  /** Pictures drawn with a figure in them. */
  drawn = 0;
  /** Whether a drag on a figure pushes it: not in the past. */
  pushable = true;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly on: {
      choose: (person: Person | undefined) => void;
      pushing: (push: Push | undefined, x: number, y: number) => void;
      push: (push: Push) => void;
      following: (on: boolean) => void;
    },
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(4.4, -2.7, 1.9);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.target.set(0.15, 0, 0.85);
    this.orbit.maxPolarAngle = Math.PI * 0.495;
    this.orbit.minDistance = 0.8;
    this.orbit.maxDistance = 40;
    this.orbit.enableDamping = true;
    this.orbit.dampingFactor = 0.12;
    this.orbit.addEventListener("start", () => {
      this.moved = true;
      this.dragged = this.orbit.target.clone();
    });
    this.orbit.addEventListener("end", () => {
      this.endFollowIfPanned();
      this.dragged = undefined;
    });
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 5;
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.015;
    this.ground = new THREE.Mesh(new THREE.PlaneGeometry(160, 160), new THREE.MeshLambertMaterial());
    this.ground.receiveShadow = true;
    this.scene.add(this.sun, this.sun.target, this.fill, this.ground, this.pushArrow);
    canvas.addEventListener("pointerdown", (e) => this.press(e), { capture: true });
    canvas.addEventListener("pointermove", (e) => this.move(e));
    canvas.addEventListener("pointerup", () => this.release(true));
    canvas.addEventListener("pointercancel", () => this.release(false));
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement ?? canvas);
    this.resize();
  }

  private resize(): void {
    const { clientWidth: w, clientHeight: h } = this.canvas.parentElement ?? this.canvas;
    if (!w || !h) return;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / h;
    // The middle of the picture is that of the part above the load's bar.
    this.camera.setViewOffset(w, h, 0, BAR / 2, w, h);
    if (!this.moved) this.frameAll();
  }

  theme(dark: boolean): void {
    this.look = dark ? LOOKS.dark : LOOKS.light;
    this.scene.background = new THREE.Color(this.look.sky);
    this.scene.fog = new THREE.Fog(this.look.sky, 14, 48);
    this.sun.intensity = this.look.sun;
    this.fill.intensity = this.look.fill;
    const tile = document.createElement("canvas");
    tile.width = tile.height = 256;
    const ink = tile.getContext("2d");
    if (ink) {
      ink.fillStyle = "#" + new THREE.Color(this.look.ground).getHexString();
      ink.fillRect(0, 0, 256, 256);
      ink.strokeStyle = this.look.line;
      ink.lineWidth = 2;
      ink.strokeRect(0, 0, 256, 256);
    }
    const texture = new THREE.CanvasTexture(tile);
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.repeat.set(160, 160);
    texture.anisotropy = 8;
    texture.colorSpace = THREE.SRGBColorSpace;
    this.ground.material.map?.dispose();
    this.ground.material.map = texture;
    this.ground.material.needsUpdate = true;
    for (const a of this.actors.values()) a.repaint(this.look);
  }

  /** Shows something besides the figures. */
  add(thing: THREE.Object3D): void {
    this.scene.add(thing);
  }

  /** Shows these figures and no others. */
  populate(people: Iterable<Person>): void {
    const wanted = new Map([...people].map((p) => [p.index, p]));
    for (const [index, actor] of this.actors) {
      const person = wanted.get(index);
      // The same figure at another time is drawn with the same surfaces.
      if (person?.body === actor.person.body && person.name === actor.person.name) {
        actor.person = person;
        continue;
      }
      this.scene.remove(actor.group);
      actor.dispose();
      this.actors.delete(index);
    }
    for (const [index, person] of wanted) {
      if (this.actors.has(index)) continue;
      const actor = new Actor(person, this.look);
      this.actors.set(index, actor);
      this.scene.add(actor.group);
    }
    if (!this.moved) this.frameAll();
  }

  /** Puts the camera where every figure is seen. */
  frameAll(): void {
    const box = new THREE.Box3();
    for (const a of this.actors.values()) {
      const place = a.person.figure.placement;
      const x = a.solid.poses[0] || place?.xM || 0;
      const y = a.solid.poses[1] || place?.yM || 0;
      box.expandByPoint(scratchA.set(x - 0.3, y - 0.45, 0));
      box.expandByPoint(scratchA.set(x + 0.75, y + 0.45, 2.1));
    }
    if (box.isEmpty()) return;
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const height = this.canvas.clientHeight || 1;
    const angle = Math.atan(Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2)) * Math.max(0.5, 1 - BAR / height));
    const narrow = Math.min(
      angle,
      Math.atan(Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2)) * this.camera.aspect),
    );
    const distance = (sphere.radius * 0.76) / Math.sin(narrow);
    this.orbit.target.copy(sphere.center).setZ(0.86);
    this.camera.position.copy(this.orbit.target).addScaledVector(scratchA.set(0.9, -0.36, 0.2).normalize(), distance);
    this.orbit.update();
  }

  /** As `frameAll`, unless the camera was moved by hand. */
  frameAllOnce(): void {
    if (!this.moved) this.frameAll();
  }

  recentre(): void {
    this.follow = false;
    this.moved = false;
    this.frameAll();
  }

  /** Whether the view moves along with the chosen figure. Turning and zooming go on as usual; panning ends it. */
  get follow(): boolean {
    return this.followed;
  }

  set follow(on: boolean) {
    if (on === this.followed) return;
    this.followed = on;
    if (on) this.moved = true;
    // Two fingers that zoom always pan a little, too.
    this.orbit.touches.TWO = on ? THREE.TOUCH.DOLLY_ROTATE : THREE.TOUCH.DOLLY_PAN;
    this.on.following(on);
  }

  /** Moves the view along with a figure: the camera keeps its distance and direction. */
  private track(person: Person | undefined, elapsed: number): void {
    const actor = person && this.actors.get(person.index);
    if (!this.followed || !actor?.group.visible) return;
    const target = scratchA.fromArray(actor.solid.poses);
    target.z = THREE.MathUtils.clamp(target.z, FOLLOW_HEIGHT.least, FOLLOW_HEIGHT.most);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const by = target.sub(this.orbit.target).multiplyScalar(still ? 1 : 1 - Math.exp(-elapsed / FOLLOW_S));
    this.orbit.target.add(by);
    this.camera.position.add(by);
    this.dragged?.add(by);
  }

  /** Panning ends following; the way on which a view comes to rest after a drag does not. */
  private endFollowIfPanned(): void {
    if (this.followed && this.dragged && this.dragged.distanceTo(this.orbit.target) > PANNED) this.follow = false;
  }

  /** Turns (rad) and nears (factor) the camera, for keys. */
  turn(sideways: number, upward: number, nearer: number): void {
    this.moved = true;
    const offset = this.camera.position.clone().sub(this.orbit.target);
    offset.applyAxisAngle(scratchA.set(0, 0, 1), sideways);
    const axis = scratchA.set(-offset.y, offset.x, 0).normalize();
    const lifted = offset.clone().applyAxisAngle(axis, -upward);
    if (lifted.z > 0.1 && lifted.z / lifted.length() < 0.995) offset.copy(lifted);
    offset.setLength(THREE.MathUtils.clamp(offset.length() * nearer, this.orbit.minDistance, this.orbit.maxDistance));
    this.camera.position.copy(this.orbit.target).add(offset);
  }

  /** Camera as six numbers for the address. */
  get place(): number[] | undefined {
    return this.moved
      ? [...this.camera.position.toArray(), ...this.orbit.target.toArray()].map((v) => Number(v.toFixed(2)))
      : undefined;
  }

  set place(six: number[] | undefined) {
    if (six?.length !== 6 || !six.every(Number.isFinite)) return;
    this.moved = true;
    this.camera.position.fromArray(six);
    this.orbit.target.fromArray(six, 3);
    this.orbit.update();
  }

  /** Looks from where another scene looks. */
  takeView(other: Scene): void {
    this.moved = true;
    this.camera.position.copy(other.camera.position);
    this.orbit.target.copy(other.orbit.target);
  }

  /** Puts everything where one picture has it. */
  prepare(
    frames: { before: Map<number, FigureFrame>; after: Map<number, FigureFrame>; share: number } | undefined,
    shown: Shown,
    chosen: Person | undefined,
  ): void {
    const centre = scratchB.set(0, 0, 0);
    let reach = 2;
    if (frames) {
      for (const [index, actor] of this.actors) {
        const after = frames.after.get(index);
        actor.group.visible = !!after;
        if (after) actor.update(frames.before.get(index) ?? after, after, frames.share, shown, actor.person === chosen);
      }
    }
    const box = new THREE.Box3();
    for (const a of this.actors.values()) box.expandByPoint(scratchA.fromArray(a.solid.poses));
    if (!box.isEmpty()) {
      box.getCenter(centre);
      reach = Math.max(2, box.getSize(scratchA).length() / 2 + 1.6);
    }
    this.sun.target.position.set(centre.x, centre.y, 0);
    this.sun.position.set(centre.x + 6 + reach, centre.y - 7 - reach, 8 + reach);
    const c = this.sun.shadow.camera;
    if (Math.abs(c.right - reach) > 0.2) {
      c.left = c.bottom = -reach;
      c.right = c.top = reach;
      c.far = 30 + 3 * reach;
      c.updateProjectionMatrix();
    }
    const now = performance.now() / 1000;
    this.track(chosen, Number.isNaN(this.preparedAt) ? 0 : Math.min(0.5, now - this.preparedAt));
    this.preparedAt = now;
    this.orbit.update();
    this.endFollowIfPanned();
    // Labels are placed with the view of this picture, not of the one before.
    this.camera.updateMatrixWorld();
    // The figure moves on while a push is drawn on it, and under a pointer that rests.
    this.drawPush();
    if (this.hovered) {
      this.canvas.style.cursor = this.pick(this.hovered) ? "crosshair" : "grab";
      this.hovered = undefined;
    }
  }

  /** Draws what `prepare` made. */
  draw3d(): void {
    this.renderer.render(this.scene, this.camera);
    if ([...this.actors.values()].some((a) => a.group.visible)) this.drawn++;
  }

  /** Pixel above a figure's head, or nothing when it is behind the camera. */
  label(person: Person): { x: number; y: number } | undefined {
    const actor = this.actors.get(person.index);
    if (!actor) return undefined;
    const p = actor.top(scratchA).project(this.camera);
    if (p.z > 1 || Math.abs(p.x) > 1 || Math.abs(p.y) > 1) return undefined;
    return { x: ((p.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - p.y) / 2) * this.canvas.clientHeight };
  }

  private aim(x: number, y: number): void {
    const box = this.canvas.getBoundingClientRect();
    this.ray.setFromCamera(
      new THREE.Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2),
      this.camera,
    );
  }

  /** The figure under a pointer, and where on it. What is met goes before what is only near. */
  private pick(e: PointerEvent): { actor: Actor; touch: Touch } | undefined {
    this.aim(e.clientX, e.clientY);
    const perPixel = THREE.MathUtils.degToRad(this.camera.fov) / (this.canvas.clientHeight || 1);
    const slack = perPixel * (e.pointerType === "mouse" ? SLACK.mouse : SLACK.touch);
    let best: { actor: Actor; touch: Touch } | undefined;
    for (const actor of this.actors.values()) {
      const touch = actor.group.visible ? actor.touch(this.ray, slack) : undefined;
      if (
        touch &&
        (!best || touch.off < best.touch.off || (touch.off === best.touch.off && touch.distance < best.touch.distance))
      )
        best = { actor, touch };
    }
    return best;
  }

  private press(e: PointerEvent): void {
    if (e.button !== 0 || !e.isPrimary) return;
    const found = this.pick(e);
    if (!found) return;
    const { actor, touch } = found;
    const { person } = actor;
    if (!this.pushable) return this.on.choose(person);
    const pointer = new THREE.Vector2(e.clientX, e.clientY);
    this.push = {
      actor,
      segment: touch.segment,
      drawn: {
        person,
        segment: person.body.segments[touch.segment].name,
        local: touch.local,
        impulse: new THREE.Vector3(),
      },
      start: pointer.clone(),
      pointer,
    };
    this.orbit.enabled = false;
    this.canvas.setPointerCapture(e.pointerId);
    this.on.choose(person);
  }

  private move(e: PointerEvent): void {
    if (this.push) {
      this.push.pointer.set(e.clientX, e.clientY);
      this.drawPush();
    } else if (e.pointerType === "mouse" && !e.buttons) this.hovered = e;
  }

  /** Draws the arrow from where the figure is now to where the pointer is. */
  private drawPush(): void {
    if (!this.push) return;
    const { actor, segment, drawn, start, pointer } = this.push;
    if (this.actors.get(actor.person.index) !== actor) return this.release(false);
    const from = actor.world(segment, drawn.local, new THREE.Vector3());
    this.aim(pointer.x, pointer.y);
    const to = this.ray.ray.intersectPlane(
      scratchPlane.setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(scratchA), from),
      scratchB,
    );
    if (!to) return;
    const along = to
      .clone()
      .sub(from)
      .clampLength(0, MOST_IMPULSE / IMPULSE_PER_METRE);
    if (start.distanceTo(pointer) < LEAST_DRAWN) along.setScalar(0);
    drawn.impulse.copy(along).multiplyScalar(IMPULSE_PER_METRE);
    point(this.pushArrow, from, along);
    const box = this.canvas.getBoundingClientRect();
    this.on.pushing(along.lengthSq() > 0 ? drawn : undefined, pointer.x - box.left, pointer.y - box.top);
  }

  /** Ends the push that is being drawn. */
  release(apply: boolean): void {
    const push = this.push;
    this.push = undefined;
    this.orbit.enabled = true;
    this.pushArrow.visible = false;
    if (!push) return;
    this.on.pushing(undefined, 0, 0);
    if (apply && push.drawn.impulse.lengthSq() > 0) this.on.push(push.drawn);
  }
}
