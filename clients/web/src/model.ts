// What the viewer knows of one world: bodies, figures, the latest frames, and the time at which to draw.
import type { Body } from "./gen/sinew/v1/body_pb.js";
import type { Figure } from "./gen/sinew/v1/figure_pb.js";
import type { FigureFrame, WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import { numbers } from "./client.js";

/** Numbers per segment of `segment_transforms`. */
export const POSE = 7;
/** Frames that are kept for interpolation. */
const KEPT = 12;
/** Seconds of torque that plots show. */
export const HISTORY_S = 8;

/** Torques of one figure at one time, for plots. */
export interface Sample {
  time: number;
  torque: Float32Array;
  limits: Float32Array;
}

/** One figure of the world. */
export class Person {
  /** Share of the available torque that each DOF uses, 0…1. */
  readonly used: Float32Array;
  readonly history: Sample[] = [];
  /** World time since which each DOF is at its limit; NaN when it is not. */
  readonly limitSince: Float64Array;
  frame: FigureFrame | undefined;
  flags = 0;

  constructor(
    readonly index: number,
    readonly name: string,
    readonly body: Body,
    public figure: Figure,
  ) {
    this.used = new Float32Array(body.dofs.length);
    this.limitSince = new Float64Array(body.dofs.length).fill(NaN);
  }

  /** Takes what a new frame says. */
  take(frame: FigureFrame, time: number): void {
    this.frame = frame;
    const torque = numbers(frame.torque);
    const limits = numbers(frame.torqueLimits);
    const count = this.body.dofs.length;
    const saturated = frame.status?.saturated ?? 0n;
    this.flags = frame.status?.flags ?? 0;
    if (torque.length !== count || limits.length !== 2 * count) return;
    for (let d = 0; d < count; d++) {
      const limit = torque[d] < 0 ? limits[d] : limits[count + d];
      const used = limit !== 0 ? torque[d] / limit : 0;
      this.used[d] = Math.min(1, Math.max(0, used));
      const at = ((saturated >> BigInt(d)) & 1n) === 1n;
      if (!at) this.limitSince[d] = NaN;
      else if (!(this.limitSince[d] <= time)) this.limitSince[d] = time;
    }
    const last = this.history.at(-1);
    if (last && time < last.time) this.history.length = 0;
    if (!last || time > last.time) {
      this.history.push({ time, torque: Float32Array.from(torque), limits: Float32Array.from(limits) });
      while (this.history.length && this.history[0].time < time - HISTORY_S) this.history.shift();
    }
  }

  /** The DOF that works hardest now. */
  hardest(): number {
    let best = 0;
    for (let d = 1; d < this.used.length; d++) if (this.used[d] > this.used[best]) best = d;
    return best;
  }

  /** Mass of everything carried, kg. */
  loadKg(): number {
    return (this.frame?.status?.loads ?? []).reduce((sum, l) => sum + l.massKg, 0);
  }

  /** The clip that was asked for last, `clips/{clip}`: it plays, or begins once the figure stands. Empty if none. */
  get clip(): string {
    return this.figure.status?.clip || this.figure.status?.nextClip || "";
  }

  /** Whether its hands are where a crate is held, in a motion that lifts one. */
  holdsCrate(): boolean {
    const poses = numbers(this.frame?.segmentTransforms);
    if (this.clip !== "clips/crate" || !poses.length) return false;
    const [l, r] = [this.segment("l_hand") * POSE, this.segment("r_hand") * POSE];
    return Math.hypot(poses[l] - poses[r], poses[l + 1] - poses[r + 1], poses[l + 2] - poses[r + 2]) < 0.5;
  }

  /** What it carries: loads of equal mass at both hands are one crate. */
  loads(): { massKg: number; segments: string[] }[] {
    const loads = (this.frame?.status?.loads ?? []).map((l) => ({
      massKg: l.massKg,
      segments: [this.body.segments[l.segment].name],
    }));
    const [l, r] = ["l_hand", "r_hand"].map((hand) => loads.filter((x) => x.segments[0] === hand));
    if (
      !this.holdsCrate() ||
      loads.length !== 2 ||
      l.length !== 1 ||
      r.length !== 1 ||
      Math.abs(l[0].massKg - r[0].massKg) > 1e-9
    )
      return loads;
    return [{ massKg: l[0].massKg + r[0].massKg, segments: ["l_hand", "r_hand"] }];
  }

  segment(name: string): number {
    return this.body.segments.findIndex((s) => s.name === name);
  }
}

/** Chooses the moment to draw: behind the newest frame by a little, so that there is one on either side. */
export class Playhead {
  private readonly frames: WorldFrame[] = [];
  private time = NaN;
  private lastNow = NaN;

  push(frame: WorldFrame): void {
    const newest = this.frames.at(-1);
    if (newest && frame.timeS <= newest.timeS) this.frames.length = 0;
    this.frames.push(frame);
    if (this.frames.length > KEPT) this.frames.shift();
  }

  newest(): WorldFrame | undefined {
    return this.frames.at(-1);
  }

  clear(): void {
    this.frames.length = 0;
    this.time = NaN;
  }

  /** The two frames around a moment (s) and the share of the second, if it is as young as that. */
  around(time: number): { before: WorldFrame; after: WorldFrame; share: number } | undefined {
    const i = this.frames.findIndex((f) => f.timeS >= time);
    if (i < 0 || (i === 0 && this.frames[0].timeS > time)) return undefined;
    const [before, after] = [this.frames[Math.max(0, i - 1)], this.frames[i]];
    const span = after.timeS - before.timeS;
    return { before, after, share: span > 0 ? (time - before.timeS) / span : 1 };
  }

  /**
   * The two frames around the moment to draw at wall time `now` (s) and the share of the second. `speed`: of the world,
   * 0 while it is paused: then what is drawn is its newest frame, and does not creep towards it.
   */
  at(now: number, speed: number): { before: WorldFrame; after: WorldFrame; share: number } | undefined {
    const newest = this.newest();
    if (!newest) return undefined;
    const oldest = this.frames[0];
    const period = this.frames.length > 1 ? (newest.timeS - oldest.timeS) / (this.frames.length - 1) : 1 / 60;
    const wanted = newest.timeS - 1.6 * period;
    const elapsed = Number.isNaN(this.lastNow) ? 0 : Math.min(0.25, now - this.lastNow);
    this.lastNow = now;
    const free = this.time + elapsed * speed;
    // Follow the stream softly; jump when far off (a new world, a step of a paused one, a stall).
    const off = wanted - free;
    this.time = Number.isNaN(free) || Math.abs(off) > 8 * period + 0.1 ? wanted : free + 0.08 * off;
    if (speed === 0) this.time = newest.timeS;
    this.time = Math.min(Math.max(this.time, oldest.timeS), newest.timeS);
    let i = this.frames.length - 1;
    while (i > 0 && this.frames[i - 1].timeS >= this.time) i--;
    const after = this.frames[i];
    const before = this.frames[Math.max(0, i - 1)];
    const span = after.timeS - before.timeS;
    return { before, after, share: span > 0 ? (this.time - before.timeS) / span : 1 };
  }
}

/** Poses between two sets: positions along the line, rotations along the short arc (normalised). */
export function mixPoses(a: ArrayLike<number>, b: ArrayLike<number>, u: number, out: Float32Array): void {
  const source = a.length === b.length ? a : b;
  for (let i = 0; i + POSE <= b.length; i += POSE) {
    let dot = 0;
    for (let k = 3; k < POSE; k++) dot += source[i + k] * b[i + k];
    const sign = dot < 0 ? -1 : 1;
    let norm = 0;
    for (let k = 0; k < POSE; k++) {
      const value = source[i + k] * (1 - u) * (k < 3 ? 1 : sign) + b[i + k] * u;
      out[i + k] = value;
      if (k >= 3) norm += value * value;
    }
    norm = Math.sqrt(norm) || 1;
    for (let k = 3; k < POSE; k++) out[i + k] /= norm;
  }
}

/** Segment poses of a posture by forward kinematics: root pose (7) and 17 rotations `parent_from_segment`. */
export function forward(body: Body, root: ArrayLike<number>, rotations: ArrayLike<number>, out: Float32Array): void {
  for (let k = 0; k < POSE; k++) out[k] = root[k];
  for (let s = 1; s < body.segments.length; s++) {
    const p = POSE * body.segments[s].parent;
    const offset = body.joints[s].offsetM;
    const [qx, qy, qz, qw] = [out[p + 3], out[p + 4], out[p + 5], out[p + 6]];
    const [x, y, z] = [offset?.x ?? 0, offset?.y ?? 0, offset?.z ?? 0];
    const tx = 2 * (qy * z - qz * y);
    const ty = 2 * (qz * x - qx * z);
    const tz = 2 * (qx * y - qy * x);
    const o = POSE * s;
    out[o] = out[p] + x + qw * tx + qy * tz - qz * ty;
    out[o + 1] = out[p + 1] + y + qw * ty + qz * tx - qx * tz;
    out[o + 2] = out[p + 2] + z + qw * tz + qx * ty - qy * tx;
    const r = 4 * (s - 1);
    const [rx, ry, rz, rw] = [rotations[r], rotations[r + 1], rotations[r + 2], rotations[r + 3]];
    out[o + 3] = qw * rx + qx * rw + qy * rz - qz * ry;
    out[o + 4] = qw * ry - qx * rz + qy * rw + qz * rx;
    out[o + 5] = qw * rz + qx * ry - qy * rx + qz * rw;
    out[o + 6] = qw * rw - qx * rx - qy * ry - qz * rz;
  }
}

/** Displacement of a segment below which the desired motion is not drawn, and from which it is drawn in full, m. */
const GHOST_FADE = { from: 0.015, full: 0.08 };

/**
 * How strongly to draw a segment of the desired motion that is this far from the simulated one (m): 0 where both agree,
 * up to 1.
 */
export function ghostOpacity(displacement: number): number {
  const u = Math.min(1, Math.max(0, (displacement - GHOST_FADE.from) / (GHOST_FADE.full - GHOST_FADE.from)));
  return u * u * (3 - 2 * u);
}

/**
 * A bound on how far any point of a segment is from where it should be, m: `POSE` numbers of both sets from `at` on,
 * and the largest distance of a point of the segment from its origin, m.
 */
export function displacement(a: ArrayLike<number>, b: ArrayLike<number>, at: number, reach: number): number {
  const shift = Math.hypot(a[at] - b[at], a[at + 1] - b[at + 1], a[at + 2] - b[at + 2]);
  let dot = 0;
  for (let k = 3; k < POSE; k++) dot += a[at + k] * b[at + k];
  // The chord of a rotation by the angle 2 acos |dot|.
  return shift + 2 * reach * Math.sqrt(Math.max(0, 1 - dot * dot));
}
