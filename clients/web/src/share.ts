// A scene as an address, as Python and as a command line.
import { Controller, type Figure } from "./gen/sinew/v1/figure_pb.js";
import type { Person } from "./model.js";

/** What an address says. */
export interface Address {
  world: string;
  figure: string;
  load: number | undefined;
  hide: string[];
  camera: number[] | undefined;
  figures: Cast[];
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
    clip: id(f.clip),
    x: rounded(f.placement?.xM ?? 0),
    y: rounded(f.placement?.yM ?? 0),
  };
}

export function write(a: Address): string {
  const q = new URLSearchParams();
  if (a.world) q.set("world", a.world);
  if (a.figure) q.set("figure", a.figure);
  if (a.load !== undefined) q.set("load", String(a.load));
  if (a.hide.length) q.set("hide", a.hide.join("."));
  if (a.camera) q.set("camera", a.camera.join("_"));
  for (const c of a.figures) q.append("f", [c.id, c.body, c.controller, c.strength, c.clip, c.x, c.y].join("~"));
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
  const figures = q.getAll("f").slice(0, 64).flatMap((text): Cast[] => {
    const [id, body, controller, strength, clip, x, y] = text.split("~");
    const [s, px, py] = [Number(strength), Number(x), Number(y)];
    if (!NAME.test(id) || !body || ![s, px, py].every(Number.isFinite)) return [];
    return [{ id, body, controller: controller ?? "", strength: s, clip: clip ?? "", x: px, y: py }];
  });
  return {
    world: name("world"),
    figure: name("figure"),
    load: load !== undefined && load >= 0 && load <= 20 ? load : undefined,
    hide: (q.get("hide") ?? "").split(".").filter(Boolean),
    camera: camera?.every(Number.isFinite) ? camera : undefined,
    figures,
  };
}

/** Controller of a word of an address; the default when it is none. */
export function controllerOf(word: string): Controller {
  const value = (Controller as unknown as Record<string, number | string>)[word.toUpperCase()];
  return typeof value === "number" ? value : Controller.UNSPECIFIED;
}

/** The command line that runs one figure of the scene. */
export function asCommand(p: Person): string {
  const c = cast(p);
  const parts = ["sinew run", c.clip || "idle", `--body ${c.body}`, `--controller ${c.controller}`];
  if (c.strength !== 1) parts.push(`--strength ${c.strength}`);
  for (const l of p.frame?.status?.loads ?? []) parts.push(`--load ${rounded(l.massKg)}@${p.body.segments[l.segment].name}`);
  return parts.join(" ");
}

/** The Python script that makes the scene in a new world and plots the torques of one figure. */
export function asPython(address: string, people: Person[], chosen: Person | undefined): string {
  const lines = ["import sinew", "", `client = sinew.Client(${JSON.stringify(address)})`, "world = client.create_world()"];
  for (const p of people) {
    const c = cast(p);
    const name = c.id.replaceAll("-", "_");
    lines.push(
      `${name} = world.add_figure(${JSON.stringify(c.id)}, body=${JSON.stringify(c.body)}, controller=${JSON.stringify(c.controller)}, strength=${c.strength}, at=(${c.x}, ${c.y}))`,
    );
    if (c.clip) lines.push(`${name}.play(${JSON.stringify(c.clip)}, loop=True)`);
    for (const l of p.frame?.status?.loads ?? []) lines.push(`${name}.load(${rounded(l.massKg)}, ${JSON.stringify(p.body.segments[l.segment].name)})`);
  }
  lines.push("recording = world.record(seconds=8)");
  if (chosen) lines.push(`recording.plot_torques(${JSON.stringify(chosen.name)})`);
  return lines.join("\n") + "\n";
}
