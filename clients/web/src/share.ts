// A scene as an address, as Python and as a command line.
import type { MessageInitShape } from "@bufbuild/protobuf";
import {
  Controller,
  PaperMetric,
  PaperPreset,
  PaperPriority,
  PaperShare,
  Stepper,
  type Figure,
  type FigureSchema,
} from "./gen/sinew/v1/figure_pb.js";
import { Follow, type Clip } from "./gen/sinew/v1/motion_pb.js";
import type { Person } from "./model.js";

/** What an address says. */
export interface Address {
  world: string;
  figure: string;
  load: number | undefined;
  hide: string[];
  camera: number[] | undefined;
  follow: boolean;
  figures: Cast[];
  /** World that is shown beside it; empty: none. */
  beside: string;
  /** Tick at which both parted. */
  since: number;
}

/** One figure of an address. */
export interface Cast {
  id: string;
  body: string;
  controller: string;
  strength: number;
  clip: string;
  x: number;
  y: number;
  /** Empty: the usual one. */
  stepper: string;
  assist: number;
  /** Of the paper's controller; empty: the usual one. */
  preset: string;
  fatigue: number;
  /** Help while it loses its motion: `assisted` or `always`. Empty: none. */
  follow: string;
}

const id = (name: string): string => name.split("/").at(-1) ?? name;
const controllerName = (c: Controller): string => (Controller[c] ?? "MODERN").toLowerCase();
const strengthOf = (f: Figure): number => f.strength?.all || 1;
const rounded = (v: number): number => Number(v.toFixed(3));

/** A figure as an address keeps it. */
export function cast(p: Person): Cast {
  const f = p.figure;
  return {
    id: p.name,
    body: id(p.body.name),
    controller: controllerName(f.controller),
    strength: rounded(strengthOf(f)),
    clip: id(p.clip),
    x: rounded(f.placement?.xM ?? 0),
    y: rounded(f.placement?.yM ?? 0),
    stepper: f.stepper === Stepper.KINEMATIC ? "kinematic" : f.stepper === Stepper.STAGED ? "staged" : "",
    assist: rounded(f.assist),
    preset: f.paper?.preset === PaperPreset.PAPER_PRESET_2000 ? "2000" : "",
    fatigue: rounded(f.fatigueTimeScale),
    follow: f.follow === Follow.ASSISTED ? "assisted" : f.follow === Follow.ALWAYS ? "always" : "",
  };
}

export function write(a: Address): string {
  const q = new URLSearchParams();
  if (a.world) q.set("world", a.world);
  if (a.figure) q.set("figure", a.figure);
  if (a.load !== undefined) q.set("load", String(a.load));
  if (a.hide.length) q.set("hide", a.hide.join("."));
  if (a.camera) q.set("camera", a.camera.join("_"));
  if (a.follow) q.set("follow", "1");
  if (a.beside) q.set("beside", a.beside);
  if (a.beside) q.set("since", String(a.since));
  for (const c of a.figures)
    q.append(
      "f",
      [
        ...[c.id, c.body, c.controller, c.strength, c.clip, c.x, c.y, c.stepper],
        ...[c.assist || "", c.preset, c.fatigue || "", c.follow],
      ]
        .join("~")
        .replace(/~+$/, ""),
    );
  return q.toString();
}

const NAME = /^[a-z][a-z0-9-]{0,62}$/;

export function read(text: string): Address {
  const q = new URLSearchParams(text.replace(/^#/, ""));
  const name = (key: string): string => {
    const value = q.get(key) ?? "";
    return NAME.test(value) ? value : "";
  };
  const load = q.has("load") ? Number(q.get("load")) : undefined;
  const camera = q.get("camera")?.split("_").map(Number);
  const figures = q
    .getAll("f")
    .slice(0, 64)
    .flatMap((text): Cast[] => {
      const [id, body, controller, strength, clip, x, y, stepper, assist, preset, fatigue, follow] = text.split("~");
      const [s, px, py, help, tires] = [
        Number(strength),
        Number(x),
        Number(y),
        Number(assist || 0),
        Number(fatigue || 0),
      ];
      if (!NAME.test(id) || !body || ![s, px, py, help, tires].every(Number.isFinite)) return [];
      return [
        {
          id,
          body,
          controller: controller ?? "",
          strength: s,
          clip: clip ?? "",
          x: px,
          y: py,
          stepper: stepper ?? "",
          assist: help,
          preset: preset ?? "",
          fatigue: tires,
          follow: follow ?? "",
        },
      ];
    });
  return {
    world: name("world"),
    figure: name("figure"),
    load: load !== undefined && load >= 0 && load <= 20 ? load : undefined,
    hide: (q.get("hide") ?? "").split(".").filter(Boolean),
    camera: camera?.every(Number.isFinite) ? camera : undefined,
    follow: q.get("follow") === "1",
    figures,
    beside: name("beside"),
    since: Math.max(0, Math.trunc(Number(q.get("since") ?? 0)) || 0),
  };
}

/** Controller of a word of an address; the default when it is none. */
function controllerOf(word: string): Controller {
  const value = (Controller as unknown as Record<string, number | string>)[word.toUpperCase()];
  return typeof value === "number" ? value : Controller.UNSPECIFIED;
}

/** Stepper of a word of an address; the default when it is none. */
function stepperOf(word: string): Stepper {
  return word === "kinematic" ? Stepper.KINEMATIC : word === "staged" ? Stepper.STAGED : Stepper.UNSPECIFIED;
}

/** The settings of a figure of an address, as a server takes them. */
export function settingsOf(c: Cast): MessageInitShape<typeof FigureSchema> {
  return {
    body: `bodies/${c.body}`,
    controller: controllerOf(c.controller),
    strength: { all: c.strength },
    stepper: stepperOf(c.stepper),
    assist: c.assist,
    fatigueTimeScale: c.fatigue,
    follow: c.follow === "assisted" ? Follow.ASSISTED : c.follow === "always" ? Follow.ALWAYS : Follow.UNSPECIFIED,
    paper: c.preset === "2000" ? { preset: PaperPreset.PAPER_PRESET_2000 } : undefined,
    placement: { xM: c.x, yM: c.y },
  };
}

/** Every choice of the paper's controller. The command line's own preset would choose stepper and rate as well. */
function paperArguments(o: Figure["paper"]): string {
  if (!o) return "";
  const metric = o.metric === PaperMetric.TORQUE ? "H2" : o.metric === PaperMetric.INERTIA ? "H" : "I";
  const priority = o.priority === PaperPriority.NESTED ? "nested" : "paper";
  const share = o.share === PaperShare.BALANCED ? "balanced" : "paper";
  const switches = {
    "to-limit": o.toLimit,
    tilt: o.tilt,
    "zmp-feasible": o.zmpFeasible,
    "track-hands": o.trackHands,
    "track-com": o.trackCom,
    "hand-over": o.handOver,
  };
  const words = Object.entries(switches).map(([name, on]) => `--${name}=${Boolean(on)}`);
  return [
    `--alpha ${o.alpha ?? 0} --horizon ${o.horizonS ?? 0} --metric ${metric} --priority ${priority} --share ${share}`,
    ...words,
  ].join(" ");
}

/** The motion as the command line names it: a built-in one, or the file that was dropped here. */
function motionArgument(clip: string, clips: Clip[]): string {
  const known = clips.find((c) => id(c.name) === clip);
  if (!clip || !known || known.builtin) return `builtin:${clip || "idle"}`;
  const file = known.displayName || `${clip}.bvh`;
  return /^[\w.-]+$/.test(file) ? file : `'${file.replaceAll("'", "'\\''")}'`;
}

/** The command line that runs one figure of the scene. */
export function asCommand(p: Person, clips: Clip[]): string {
  const c = cast(p);
  const parts = [`sinew run ${motionArgument(c.clip, clips)} --body ${c.body} --controller ${c.controller}`];
  if (c.stepper) parts.push(`--stepper ${c.stepper}`);
  if (c.preset) parts.push(paperArguments(p.figure.paper));
  if (c.strength !== 1) parts.push(`--strength ${c.strength}`);
  if (c.assist) parts.push(`--assist ${c.assist}`);
  if (c.follow) parts.push(`--follow ${c.follow}`);
  if (c.fatigue) parts.push(`--fatigue ${c.fatigue}`);
  for (const l of p.loads()) parts.push(`--load ${rounded(l.massKg)}@${l.segments.join("+")}`);
  return parts.join(" ");
}

/** The Python script that makes the scene in a new world and plots the torques of one figure. */
export function asPython(address: string, people: Person[], chosen: Person | undefined, clips: Clip[]): string {
  const text = JSON.stringify;
  const lines = [
    "import sinew",
    "",
    `with sinew.Client(${text(address)}) as client, client.create_world(paused=True) as world:`,
  ];
  for (const p of people) {
    const c = cast(p);
    const name = c.id.replaceAll("-", "_");
    const settings = [`body=${text(c.body)}`, `controller=${text(c.controller)}`, `position=(${c.x}, ${c.y})`];
    if (c.strength !== 1) settings.push(`strength=${c.strength}`);
    if (c.assist) settings.push(`assist=${c.assist}`);
    if (c.stepper) settings.push(`stepper=${text(c.stepper)}`);
    if (c.preset) settings.push(`paper=sinew.Paper(preset=${text(c.preset)})`);
    if (c.follow) settings.push(`follow=${text(c.follow)}`);
    if (c.fatigue) settings.push(`fatigue_time_scale=${c.fatigue}`);
    lines.push(`    ${name} = world.add_figure(${text(c.id)}, ${settings.join(", ")})`);
    if (c.clip) lines.push(`    ${name}.play(${text(c.clip)}, loop=True, reset=True, position=(${c.x}, ${c.y}))`);
    for (const l of p.loads())
      lines.push(`    ${name}.carry(${[rounded(l.massKg), ...l.segments.map((s) => text(s))].join(", ")})`);
  }
  const longest = Math.max(4, ...people.map((p) => clips.find((k) => k.name === p.clip)?.durationS ?? 0));
  lines.push(`    recordings = world.record(${Math.min(60, Math.ceil(longest))}.0)`);
  if (chosen) lines.push("", `recordings[${text(chosen.name)}].plot_torques().savefig("torques.png")`);
  return lines.join("\n") + "\n";
}
