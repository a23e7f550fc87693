// From names of the protocol to words for people.
import type { Status } from "./gen/sinew/v1/frame_pb.js";
import { FollowWay, ForecastVerdict, type Forecast } from "./gen/sinew/v1/motion_pb.js";
import { EventType, type Event } from "./gen/sinew/v1/state_pb.js";
import type { ClampedAngle, RetargetReport } from "./gen/sinew/v1/types_pb.js";

/** `l_shoulder_flexion` or `l_shoulder` → `left shoulder`. */
export function joint(name: string): string {
  const parts = name.split("_");
  const side = parts[0] === "l" ? "left " : parts[0] === "r" ? "right " : "";
  return side + (side ? parts[1] : parts[0]);
}

/** `l_shoulder_flexion` → `left shoulder flexion`. */
export function dof(name: string): string {
  const parts = name.split("_");
  const side = parts[0] === "l" ? "left " : parts[0] === "r" ? "right " : "";
  return side + parts.slice(side ? 1 : 0).join(" ");
}

/** What will come of a clip, and why, in a line. */
export function forecast(f: Forecast): string {
  const follows = f.verdict === ForecastVerdict.FOLLOWS;
  const word = follows
    ? "should be followed"
    : f.verdict === ForecastVerdict.NEEDS_HELP
      ? "will need help"
      : "cannot be followed by tracking alone";
  return `Forecast: ${word}: ${f.reason}`;
}

/** What is worth a caption of its own, or nothing. Torque limits and falls are shown elsewhere while they last. */
export function event(e: Event): { text: string; grave: boolean } | undefined {
  const { figureId: figure } = e;
  switch (e.type) {
    case EventType.BALANCE_LOST:
      return { text: `${figure} loses balance`, grave: true };
    case EventType.RECOVERED:
      return { text: `${figure} regains balance`, grave: false };
    case EventType.GOT_UP:
      return { text: `${figure} is back on its feet`, grave: false };
    case EventType.LOAD_SHARED:
      return {
        text:
          `${figure} helps with the ${joint(e.otherSegment)}: ${kilograms(e.massKg)} need ` +
          `${(100 * e.needAlone).toFixed(0)} % of one arm's strength`,
        grave: false,
      };
    case EventType.LOAD_SLIPPED:
      return { text: `${figure} drops ${kilograms(e.massKg)} from the ${joint(e.segment)}`, grave: true };
    case EventType.WAY_BARRED:
      return { text: `${figure} stops: something is in the way`, grave: false };
    case EventType.CLIP_RESTARTS:
      return { text: `${figure} catches itself and begins the clip again`, grave: false };
    case EventType.CLIP_GIVEN_UP:
      return { text: `${figure} catches itself again and stays where it is`, grave: false };
    case EventType.QUARANTINED:
      return { text: `${figure} is frozen: its simulation state became invalid`, grave: true };
    case EventType.DRIVE_BEGAN:
      return { text: `${figure} is now driven live${e.detail ? ` by ${e.detail}` : ""}`, grave: false };
    case EventType.DRIVE_ENDED:
      return { text: `Live control of ${figure} has ended`, grave: false };
    case EventType.WORLD_FAILED:
      return { text: `The world has failed: ${e.detail}`, grave: true };
    default:
      return undefined;
  }
}

/** Kinds of marks on the time line; each has a shape of its own. */
export type MarkKind = "fall" | "push" | "clip" | "mass" | "world";

/** What a mark on the time line says, and its kind; nothing for what is not worth one. */
export function mark(e: Event): { kind: MarkKind; text: string } | undefined {
  const { figureId: figure } = e;
  const clip = e.detail.replace(/^clips\//, "");
  switch (e.type) {
    case EventType.BALANCE_LOST:
      return { kind: "fall", text: `${figure} loses balance` };
    case EventType.FELL:
      return { kind: "fall", text: `${figure} falls` };
    case EventType.QUARANTINED:
      return { kind: "fall", text: `${figure} is frozen` };
    case EventType.WAY_BARRED:
      return { kind: "push", text: `${figure} stops: something is in the way` };
    case EventType.CLIP_RESTARTS:
      return { kind: "clip", text: `${figure} begins the clip again` };
    case EventType.CLIP_GIVEN_UP:
      return { kind: "clip", text: `${figure} gives up the clip` };
    case EventType.PUSHED:
      return { kind: "push", text: `${figure} is pushed: ${e.impulseNewtonSeconds.toFixed(0)} N·s` };
    case EventType.CLIP_BEGAN:
      return { kind: "clip", text: `${figure} begins “${clip}”` };
    case EventType.DRIVE_BEGAN:
      return { kind: "clip", text: `${figure} is driven live` };
    case EventType.LOAD_TAKEN:
      return { kind: "mass", text: `${figure} takes ${kilograms(e.massKg)}` };
    case EventType.LOAD_DROPPED:
      return { kind: "mass", text: `${figure} puts down ${kilograms(e.massKg)}` };
    case EventType.LOAD_SHARED:
      return { kind: "mass", text: `${figure} helps with the other hand: ${kilograms(e.massKg)}` };
    case EventType.LOAD_UNSHARED:
      return { kind: "mass", text: `${figure} holds ${kilograms(e.massKg)} in one hand again` };
    case EventType.LOAD_SLIPPED:
      return { kind: "mass", text: `${figure} drops ${kilograms(e.massKg)}` };
    case EventType.FIGURE_ADDED:
      return { kind: "world", text: `${figure} is added` };
    case EventType.FIGURE_REMOVED:
      return { kind: "world", text: `${figure} is removed` };
    case EventType.OBSTACLE_ADDED:
    case EventType.OBSTACLE_REMOVED:
      return {
        kind: "world",
        text: `obstacle ${e.other} is ${e.type === EventType.OBSTACLE_ADDED ? "added" : "removed"}`,
      };
    case EventType.WORLD_RESTORED:
      return { kind: "world", text: "the world was rewound to this moment" };
    default:
      return undefined;
  }
}

/** What a figure does, from its flags. */
export function state(has: (flag: string) => boolean): string {
  const base = has("QUARANTINED")
    ? "frozen"
    : has("FALLEN")
      ? "fallen"
      : has("BALANCE_LOST")
        ? "off balance"
        : has("FLIGHT")
          ? "in the air"
          : "standing";
  return has("HANDED_OVER") ? `${base}, torque-driven for now` : base;
}

/** In which way a figure follows its motion, unless that is by its own strength and as it comes. */
export function following(status: Status | undefined): string {
  if (status?.following === FollowWay.REHEARSED) return ", rehearsed";
  if (status?.following !== FollowWay.HELPED) return "";
  const [force, moment] = [status.helpNewtonSeconds, status.helpNewtonMetreSeconds].map((x) => x.toFixed(0));
  return `, helped ${force} N·s (${(100 * status.helpRatio).toFixed(1)} %), ${moment} N·m·s`;
}

/** Distance of the zero-moment point from the edge of the support polygon: positive inside. */
export function margin(metres: number | undefined): string {
  if (metres === undefined || !Number.isFinite(metres)) return "no support";
  const cm = Math.round(metres * 100) || 0;
  return cm < 0 ? `${Math.abs(cm)} cm outside support` : `${cm} cm`;
}

/** Kilograms with one decimal at most; small masses with two figures. */
export function kilograms(mass: number): string {
  return `${Number(mass < 1 ? mass.toPrecision(2) : mass.toFixed(1))} kg`;
}

/** A number with a true minus sign, as axes and readouts have it. */
export function signed(value: number, digits = 0): string {
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** Names of degrees of freedom in a sentence, as words. */
function spelled(sentence: string, dofs: string[]): string {
  const replaced = dofs.reduce((text, name) => text.replaceAll(new RegExp(`\\b${name}\\b`, "g"), dof(name)), sentence);
  const words = replaced.replace(/\b[lr]_[a-z]+(?:_[a-z]+)*\b/g, dof);
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const cm = (metres: number): string => `${(metres * 100).toFixed(1)} cm`;

/** What was found in a recording. */
export function found(r: RetargetReport): string[] {
  return [
    `${r.mapped.length} bones matched`,
    `Performer ${r.statureM.toFixed(2)} m tall, ${r.upAxis} axis up, ${r.sourceRateHz.toFixed(0)} frames per second`,
    `Feet slide ${cm(r.footSlideBeforeM)} in the recording, ${cm(r.footSlideAfterM)} after preparation`,
  ];
}

/** One clamped angle: of which joint, in how much of the clip, by how much. */
export function clamp(c: ClampedAngle): [string, string, string] {
  const share = c.fraction < 0.01 ? "< 1" : (c.fraction * 100).toFixed(0);
  const degrees = (c.maxExcessRad * 180) / Math.PI;
  return [dof(c.dof), `${share} %`, degrees < 1 ? "< 1°" : `${degrees.toFixed(0)}°`];
}

/** Whether a sentence names a degree of freedom, as the protocol does or in words. */
function names(sentence: string, name: string): boolean {
  const plain = (text: string): string => text.toLowerCase().replace(/[^a-z]+/g, " ");
  return sentence.includes(name) || ` ${plain(sentence)} `.includes(` ${plain(dof(name))} `);
}

/** Excess (rad) and share of the frames beyond which a clamped angle is a warning. */
const CLAMP_WARNS = { excess: 0.087, share: 0.05 };

/** Every warning about a recording: the server's, and clamped angles that it does not mention itself. */
export function warnings(r: RetargetReport): string[] {
  const dofs = r.clamped.map((c) => c.dof);
  const large = r.clamped.filter((c) => c.maxExcessRad > CLAMP_WARNS.excess && c.fraction > CLAMP_WARNS.share);
  const more = large.filter((c) => !r.warnings.some((w) => names(w, c.dof)));
  const lines = more.map((c) => {
    const [, share, excess] = clamp(c);
    return `${c.dof} exceeds the body's limits by up to ${excess} in ${share} of the frames`;
  });
  return [...r.warnings, ...lines].map((text) => spelled(text, dofs));
}
