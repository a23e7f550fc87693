// A second world beside the first one: a pane of its own, with the same camera and its own load, push and clock.
import { message, type Sinew } from "./client.js";
import { Labels } from "./labels.js";
import { Load } from "./load.js";
import { indexed, PastPeople, timeOf, type Moment } from "./moment.js";
import type { Person } from "./model.js";
import { Obstacles } from "./obstacles.js";
import { Scene, type Push, type Shown } from "./scene.js";
import { Session } from "./session.js";

/** Parts of the pane. */
export interface Parts {
  pane: HTMLElement;
  canvas: HTMLCanvasElement;
  labels: HTMLElement;
  slider: HTMLInputElement;
  output: HTMLOutputElement;
  pause: HTMLButtonElement;
  push: HTMLButtonElement;
}

/** What the pane asks of the page. */
export interface Wishes {
  say: (text: string, grave?: boolean) => void;
  /** A figure was chosen here. */
  choose: (name: string) => void;
  /** Pushes the chosen figure as set in the panel. */
  push: (session: Session) => void;
  /** A push was drawn here. */
  drawn: (session: Session, push: Push) => void;
  /** The world of this pane has gone. */
  gone: () => void;
}

export class Beside {
  readonly session: Session;
  scene: Scene | undefined;
  private readonly labels: Labels;
  private readonly load: Load;
  private readonly obstacles = new Obstacles();
  private readonly people: PastPeople;
  private populated: ReadonlyMap<number, Person> | undefined;
  private dark = false;
  open = false;
  private world = "";

  constructor(
    api: Sinew,
    private readonly parts: Parts,
    private readonly wishes: Wishes,
  ) {
    this.session = new Session(
      api,
      (what) => {
        if (what === "roster") this.populated = undefined;
        if (what === "world" || what === "phase") this.clock();
        const { world, phase } = this.session;
        // A session whose world is deleted shows another one.
        const other = what === "world" && world && world.name !== `worlds/${this.world}`;
        if (this.open && (other || phase.kind === "error")) this.wishes.gone();
      },
      () => undefined,
      (frame) => {
        if (this.session.world) void this.obstacles.follow(api, this.session.world.name, frame);
      },
    );
    this.people = new PastPeople(this.session);
    this.labels = new Labels(parts.labels);
    this.load = new Load(parts.slider, parts.output, this.session, {
      change: () => undefined,
      done: () => undefined,
      failed: (error) => wishes.say(message(error), true),
    });
    const attempt = (what: Promise<unknown>): void =>
      void what.catch((error: unknown) => wishes.say(message(error), true));
    parts.pause.addEventListener("click", () => attempt(this.session.setPaused(!this.session.paused)));
    parts.push.addEventListener("click", () => wishes.push(this.session));
  }

  private clock(): void {
    this.parts.pause.textContent = this.session.paused ? "Resume" : "Pause";
    this.parts.pause.setAttribute("aria-pressed", String(this.session.paused));
    this.parts.pause.disabled = this.parts.push.disabled = this.session.phase.kind !== "live";
    this.load.enable(this.session.phase.kind === "live");
  }

  /** Shows a world in the pane. */
  show(world: string): void {
    this.open = true;
    this.world = world;
    this.parts.pane.hidden = false;
    try {
      this.scene ??= this.make();
    } catch {
      // Without a picture the controls still work.
      this.parts.canvas.hidden = true;
    }
    this.scene?.theme(this.dark);
    this.session.show(world);
  }

  private make(): Scene {
    const scene = new Scene(this.parts.canvas, {
      choose: (p) => p && this.wishes.choose(p.name),
      pushing: (push, x, y) =>
        (this.labels.push = push ? { text: `${push.impulse.length().toFixed(0)} N·s`, x, y } : undefined),
      push: (push) => this.wishes.drawn(this.session, push),
      following: () => undefined,
    });
    scene.add(this.obstacles.group);
    return scene;
  }

  /** Closes the pane. */
  close(): void {
    this.open = false;
    this.parts.pane.hidden = true;
    this.session.end();
  }

  theme(dark: boolean): void {
    this.dark = dark;
    if (this.open) this.scene?.theme(dark);
  }

  /** The present of the world, as its pane would show it alone. */
  live(now: number): Moment | undefined {
    const { session } = this;
    const pair = session.playhead.at(now, session.paused ? 0 : (session.world?.speed ?? 1));
    return pair && { ...pair, time: timeOf(pair), people: session.people, exact: true };
  }

  /** The world at another time, s. */
  past(time: number, chosen: string): Moment | undefined {
    return this.people.at(time, chosen);
  }

  /** Draws a picture with the camera of another scene, or lets that one follow. */
  draw(moment: Moment | undefined, shown: Shown, chosen: string | undefined, other: Scene, leads: boolean): void {
    const { scene } = this;
    if (!scene) return;
    if (moment && moment.people !== this.populated) {
      scene.populate(moment.people.values());
      this.populated = moment.people;
    }
    if (leads) other.takeView(scene);
    else scene.takeView(other);
    const people = [...(moment?.people.values() ?? [])];
    scene.prepare(
      moment && { before: indexed(moment.before), after: indexed(moment.after), share: moment.share },
      shown,
      people.find((p) => p.name === chosen),
    );
    if (moment) this.obstacles.place(moment.before, moment.after, moment.share);
    this.labels.update(this.session.phase.kind === "live" ? people : [], chosen, scene);
    scene.draw3d();
  }

  /** Brings words up to date. */
  read(): void {
    this.load.read();
  }
}
