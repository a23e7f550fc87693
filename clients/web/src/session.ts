// One world as it is on the server: its figures, frames and events; connects again by itself.
import { Code, ConnectError } from "@connectrpc/connect";
import { isConnectionLoss, message, numbers, type Sinew } from "./client.js";
import { Past } from "./history.js";
import type { Body } from "./gen/sinew/v1/body_pb.js";
import type { WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import type { Event, Roster } from "./gen/sinew/v1/state_pb.js";
import type { Clip } from "./gen/sinew/v1/motion_pb.js";
import type { Role } from "./gen/sinew/v1/options_pb.js";
import { WorldState, type World } from "./gen/sinew/v1/world_pb.js";
import { Person, Playhead } from "./model.js";

/** How things stand between page and server. */
export type Phase =
  | { kind: "connecting" }
  | { kind: "live" }
  | { kind: "empty" }
  | { kind: "reconnecting"; attempt: number }
  | { kind: "error"; text: string };

/** Figures above which frames come at half the rate; interpolation fills in. */
const CROWD = 8;
const FIELDS = ["segment_transforms", "torque", "torque_limits", "contacts", "balance", "desired", "assist", "status"];
const FIRST_RETRY_MS = 250;
const LONGEST_RETRY_MS = 3000;

/** The pasts of the worlds that this page has shown last: whoever comes back to one finds its frames. */
const pasts = new Map<string, Past>();
const MOST_PASTS = 2;

export class Session {
  readonly people = new Map<number, Person>();
  readonly playhead = new Playhead();
  world: World | undefined;
  worlds: World[] = [];
  motions: Clip[] = [];
  clips: string[] = [];
  bodies: string[] = [];
  capabilities: string[] = [];
  flagNames: string[] = [];
  phase: Phase = { kind: "connecting" };
  /** Who is in the newest frames. */
  roster: Roster | undefined;
  /** The last minutes of the world. */
  past: Past | undefined;
  private watching = new AbortController();
  private generation = 0;

  constructor(
    readonly api: Sinew,
    private readonly changed: (what: "phase" | "roster" | "world" | "lists") => void,
    private readonly happened: (event: Event) => void,
    private readonly framed: (frame: WorldFrame) => void,
  ) {}

  get paused(): boolean {
    return this.world?.state === WorldState.PAUSED;
  }

  person(name: string): Person | undefined {
    return [...this.people.values()].find((p) => p.name === name);
  }

  /** Shows a world; empty: `demo`, else the first there is. Goes on until another one is shown. */
  show(wanted: string): void {
    const generation = ++this.generation;
    this.watching.abort();
    this.watching = new AbortController();
    this.playhead.clear();
    this.people.clear();
    this.past = undefined;
    this.roster = undefined;
    this.enter({ kind: "connecting" });
    void this.keep(wanted, generation, this.watching.signal);
  }

  /** Shows nothing any more. */
  end(): void {
    this.generation++;
    this.watching.abort();
    this.playhead.clear();
    this.people.clear();
    this.world = undefined;
    this.past = undefined;
    this.roster = undefined;
  }

  private enter(phase: Phase): void {
    this.phase = phase;
    this.changed("phase");
  }

  private async keep(wanted: string, generation: number, signal: AbortSignal): Promise<void> {
    let attempt = 0;
    while (generation === this.generation) {
      try {
        await this.lists();
        const name =
          this.worlds.find((w) => w.name === `worlds/${wanted || "demo"}`)?.name ??
          (wanted ? undefined : this.worlds[0]?.name);
        if (generation !== this.generation) return;
        if (name) {
          await this.watch(name, signal, () => (attempt = 0));
        } else {
          this.world = undefined;
          if (wanted) this.enter({ kind: "error", text: `There is no world “${wanted}” on this server.` });
          else this.enter({ kind: "empty" });
          await pause(1500, signal);
          continue;
        }
      } catch (error) {
        if (generation !== this.generation || signal.aborted) return;
        if (error instanceof ConnectError && error.code === Code.NotFound && this.phase.kind === "live") {
          // The world was deleted.
          wanted = "";
        } else if (!isConnectionLoss(error)) {
          this.enter({ kind: "error", text: message(error) });
          await pause(LONGEST_RETRY_MS, signal);
          continue;
        }
      }
      if (generation !== this.generation) return;
      attempt++;
      this.playhead.clear();
      this.enter({ kind: "reconnecting", attempt });
      await pause(Math.min(LONGEST_RETRY_MS, FIRST_RETRY_MS * 2 ** Math.min(6, attempt - 1)), signal);
    }
  }

  /** Reads again what can be chosen from. */
  async lists(): Promise<void> {
    const [info, worlds, clips, bodies] = await Promise.all([
      this.api.server.getServerInfo({}),
      this.api.worlds.listWorlds({ pageSize: 1000 }),
      this.api.motion.listClips({ pageSize: 1000 }),
      this.api.bodies.listBodies({ pageSize: 1000 }),
    ]);
    this.worlds = worlds.worlds;
    this.motions = clips.clips;
    this.clips = clips.clips.map((c) => c.name.slice("clips/".length));
    this.bodies = bodies.bodies.map((b) => b.name.slice("bodies/".length));
    this.capabilities = info.capabilities;
    this.flagNames = info.flagNames;
    this.changed("lists");
  }

  private async watch(name: string, signal: AbortSignal, alive: () => void): Promise<void> {
    this.world = (await this.api.worlds.getWorld({ name }, { signal })).world;
    this.past = this.world && this.pastOf(this.world);
    void this.past?.look();
    this.changed("world");
    const crowd = (this.world?.figureCount ?? 0) > CROWD;
    const view = { fields: { paths: FIELDS }, rateDivisor: crowd ? 2 : 1 };
    const ended = new AbortController();
    const stop = (): void => ended.abort();
    signal.addEventListener("abort", stop, { once: true });
    void this.listen(name, ended.signal);
    let seen = false;
    try {
      for await (const { message: m } of this.api.state.watchWorld({ world: name, view }, { signal })) {
        if (m.case === "roster") {
          this.roster = m.value;
          await this.enroll(m.value);
          if (this.phase.kind !== "live" && !this.people.size) this.enter({ kind: "empty" });
        } else if (m.case === "frame") {
          alive();
          this.take(m.value);
          if (!seen || this.phase.kind !== "live") {
            seen = true;
            if (this.people.size) this.enter({ kind: "live" });
            else if (this.phase.kind !== "empty") this.enter({ kind: "empty" });
          }
        }
      }
    } finally {
      stop();
      signal.removeEventListener("abort", stop);
    }
  }

  private async listen(world: string, signal: AbortSignal): Promise<void> {
    try {
      for await (const { events } of this.api.state.watchEvents({ world }, { signal }))
        for (const e of events) {
          if (this.world?.name === world) this.past?.happened(e);
          this.happened(e);
        }
    } catch {
      // The watch of frames ends with the same cause and says so.
    }
  }

  private async enroll(roster: Roster): Promise<void> {
    const [figures, described] = await Promise.all([
      this.api.figures.listFigures({ parent: roster.world, pageSize: 1000 }),
      Promise.all([...new Set(roster.figures.map((f) => f.body))].map((name) => this.body(name))),
    ]);
    const bodies = new Map(described.map((b) => [b.name, b]));
    const old = new Map(this.people);
    this.people.clear();
    for (const entry of roster.figures) {
      const body = bodies.get(entry.body);
      const figure = figures.figures.find((f) => f.name.endsWith(`/${entry.figureId}`));
      if (!body || !figure) continue;
      const before = old.get(entry.figureIndex);
      if (before && before.name === entry.figureId && before.body === body) {
        before.figure = figure;
        this.people.set(entry.figureIndex, before);
      } else this.people.set(entry.figureIndex, new Person(entry.figureIndex, entry.figureId, body, figure));
    }
    this.changed("roster");
  }

  private pastOf(world: World): Past {
    // A world of the same name may be another one.
    const key = `${world.name} ${world.createTime?.seconds} ${world.createTime?.nanos}`;
    const past = pasts.get(key) ?? new Past(this.api, world.name, FIELDS);
    pasts.delete(key);
    pasts.set(key, past);
    for (const oldest of pasts.keys()) if (pasts.size > MOST_PASTS) pasts.delete(oldest);
    return past;
  }

  /** The roles of this page in the world, those that others contain included. */
  async roles(): Promise<Set<Role>> {
    const { roles } = await this.api.access.getCaller({ world: this.world?.name ?? "" });
    return new Set(roles);
  }

  private readonly described = new Map<string, Promise<Body>>();

  /** The description of a body. */
  body(name: string): Promise<Body> {
    let body = this.described.get(name);
    if (!body) {
      body = this.api.bodies.getBody({ name, includeGeometry: true }).then((r) => {
        if (!r.body) throw new Error(`the server has no description of ${name}`);
        return r.body;
      });
      this.described.set(name, body);
      body.catch(() => this.described.delete(name));
    }
    return body;
  }

  private take(frame: WorldFrame): void {
    const last = this.playhead.newest();
    this.playhead.push(frame);
    if (this.roster) this.past?.add(frame, this.roster);
    // A paused world sends its tick again when a figure was changed.
    for (const f of frame.figures) this.people.get(f.figureIndex)?.take(f, frame.timeS);
    if (last?.tick !== frame.tick) this.framed(frame);
  }

  /** Asks again for what figures play and how strong they are. */
  async refresh(): Promise<void> {
    if (!this.world) return;
    const { figures } = await this.api.figures.listFigures({ parent: this.world.name, pageSize: 1000 });
    for (const p of this.people.values()) p.figure = figures.find((f) => f.name.endsWith(`/${p.name}`)) ?? p.figure;
    this.changed("roster");
  }

  async setPaused(paused: boolean): Promise<void> {
    if (!this.world) return;
    const { name } = this.world;
    const answer = paused ? await this.api.worlds.pauseWorld({ name }) : await this.api.worlds.resumeWorld({ name });
    this.world = answer.world;
    this.changed("world");
  }

  async step(): Promise<void> {
    if (!this.world) return;
    if (!this.paused) await this.setPaused(true);
    await this.api.worlds.stepWorld({ name: this.world.name, tickCount: 1 });
  }

  async setSpeed(speed: number): Promise<void> {
    if (!this.world) return;
    this.world = (await this.api.worlds.setWorldSpeed({ name: this.world.name, speed })).world;
    this.changed("world");
  }

  /** Whether the newest frame of a figure has this flag. */
  says(p: Person, flag: string): boolean {
    const bit = this.flagNames.indexOf(flag);
    return bit >= 0 && ((p.flags >>> bit) & 1) === 1;
  }

  /** Gives each figure this mass in place of its load: as a crate if it lifts one, else half of it in each hand. */
  async carry(people: Person[], massKg: number): Promise<void> {
    if (!this.world) return;
    const world = this.world.name;
    await Promise.all(
      people.map(async (p) => {
        await this.api.perturbations.clearPerturbations({ figure: p.figure.name });
        if (massKg <= 0) return;
        const load = (value: { segment: string; secondSegment?: string; massKg: number }): object => ({
          figureId: p.name,
          kind: { case: "load" as const, value },
        });
        const perturbations = p.holdsCrate()
          ? [load({ segment: "l_hand", secondSegment: "r_hand", massKg })]
          : [load({ segment: "l_hand", massKg: massKg / 2 }), load({ segment: "r_hand", massKg: massKg / 2 })];
        await this.api.perturbations.applyPerturbations({ world, perturbations });
      }),
    );
  }

  /** Puts a figure back to its place and starts its clip again, without loads and pushes. */
  private async restart(p: Person): Promise<void> {
    const { clip } = p;
    await this.api.figures.resetFigure({ name: p.figure.name });
    if (clip)
      await this.api.motion.playClip({
        figure: p.figure.name,
        clip,
        loop: true,
        reset: true,
        placement: p.figure.placement,
      });
  }

  /** Stands a figure up again at its place: its clip starts again, with the same load. */
  async standUp(p: Person): Promise<void> {
    const load = p.loadKg();
    await this.restart(p);
    if (load > 0) await this.carry([p], load);
    await this.tickIfPaused();
  }

  /** Flags, contacts and torques of a figure that was put back come with the next tick: a paused world computes one. */
  private async tickIfPaused(): Promise<void> {
    if (!this.world || !this.paused) return;
    try {
      await this.api.worlds.stepWorld({ name: this.world.name, tickCount: 1 });
    } catch (error) {
      // Another client has resumed the world meanwhile: then ticks come anyway.
      if (!(error instanceof ConnectError && error.code === Code.FailedPrecondition)) throw error;
    }
  }

  /**
   * Puts every figure back to its place and starts all clips again, in the same tick; loads and pushes are gone.
   * Settings, obstacles and the clock go on as they are. Gives the figures that could not be reset, with the reason.
   */
  async reset(): Promise<string[]> {
    if (!this.world) return [];
    const { name } = this.world;
    const ran = !this.paused;
    if (ran) await this.api.worlds.pauseWorld({ name });
    try {
      const people = [...this.people.values()];
      const results = await Promise.allSettled(people.map((p) => this.restart(p)));
      await this.tickIfPaused();
      return results.flatMap((r, i) => (r.status === "rejected" ? [`${people[i].name} (${message(r.reason)})`] : []));
    } finally {
      if (ran) await this.api.worlds.resumeWorld({ name });
    }
  }
}

/** Position and rotation of every segment in the newest frame. */
export function poses(p: Person): ArrayLike<number> {
  return numbers(p.frame?.segmentTransforms);
}

function pause(ms: number, signal: AbortSignal): Promise<void> {
  return new Promise((done) => {
    const timer = setTimeout(done, ms);
    signal.addEventListener("abort", () => {
      clearTimeout(timer);
      done();
    });
  });
}
