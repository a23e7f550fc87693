// The time line: the last minutes of the world, a moment of it that is looked at, and the present at its right end.
import { tickOf, type Past } from "./history.js";
import { mark as markWords } from "./words.js";
import type { Event } from "./gen/sinew/v1/state_pb.js";

/** Seconds before the newest moment that count as the present when the handle is dragged there. */
const EDGE_S = 0.12;
/** Seconds of an arrow key; with Shift; of a rewind. */
const [STEP_S, LEAP_S] = [0.1, 1];
export const REWIND_S = 5;
/** Marks that are shown, the last ones. */
const MOST_MARKS = 240;
/** Pixels between two marks of a kind below which the later one is left out. */
const APART = 5;

const seconds = (s: number): string => `${s.toFixed(1)} s`;

export class Timeline {
  /** World time that is looked at, s; undefined: the present. */
  shown: number | undefined;
  private past: Past | undefined;
  /** First tick and last of the time line. They stand still while the past is looked at. */
  private span = { first: 0, last: 1 };
  private held = false;
  private drawn = "";

  constructor(
    private readonly root: HTMLElement,
    private readonly slider: HTMLInputElement,
    private readonly marks: HTMLElement,
    private readonly readout: HTMLOutputElement,
    /** Another moment is looked at. */
    private readonly changed: () => void,
  ) {
    slider.addEventListener("input", () => this.to(slider.valueAsNumber / this.rate));
    slider.addEventListener("keydown", (e) => this.key(e));
    // The ends must not move under a finger that is down.
    slider.addEventListener("pointerdown", () => (this.held = true));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture", "change"])
      slider.addEventListener(end, () => (this.held = false));
    marks.addEventListener("click", (e) => {
      const tick = e.target instanceof HTMLElement ? e.target.dataset.tick : undefined;
      if (tick !== undefined) this.to(Number(tick) / this.rate);
    });
  }

  private get rate(): number {
    return this.past?.rateHz ?? 60;
  }

  /** Shows the past of another world, from its present on. */
  of(past: Past | undefined): void {
    if (past === this.past) return;
    this.past?.lookAt(undefined);
    this.past = past;
    this.drawn = "";
    this.live();
  }

  /** Looks at the present again. */
  live(): void {
    const was = this.shown;
    this.shown = undefined;
    this.held = false;
    this.past?.lookAt(undefined);
    this.update();
    if (was !== undefined) this.changed();
  }

  /** Looks at a moment, s of world time: the nearest that is held. */
  to(time: number): void {
    const { past } = this;
    if (!past || past.oldest < 0) return;
    if (this.shown === undefined) this.span = { first: past.oldest, last: past.newest };
    const { first, last } = this.span;
    if (time >= last / this.rate - EDGE_S) return this.live();
    this.shown = Math.max(time, Math.max(first, past.oldest) / this.rate);
    past.lookAt(this.shown);
    this.update();
    this.changed();
  }

  /** Looks at what was so many seconds before or after what is shown. */
  by(seconds: number): void {
    if (this.shown === undefined && seconds > 0) return;
    this.to((this.shown ?? (this.past?.newest ?? 0) / this.rate) + seconds);
  }

  /** The tick that is shown. */
  get tick(): number {
    return this.shown === undefined ? (this.past?.newest ?? -1) : Math.round(this.shown * this.rate);
  }

  private key(e: KeyboardEvent): void {
    const step = e.shiftKey ? LEAP_S : STEP_S;
    const keys: Record<string, () => void> = {
      ArrowLeft: () => this.by(-step),
      ArrowDown: () => this.by(-step),
      ArrowRight: () => this.by(step),
      ArrowUp: () => this.by(step),
      PageUp: () => this.toMark(-1),
      PageDown: () => this.toMark(1),
      Home: () => this.to(-Infinity),
      End: () => this.live(),
    };
    const action = keys[e.key];
    if (!action || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    e.stopPropagation();
    action();
  }

  /** Goes to the mark before or after what is shown. */
  toMark(direction: -1 | 1): void {
    const { tick } = this;
    const ticks = this.events().map(tickOf);
    const next = direction < 0 ? ticks.filter((t) => t < tick).at(-1) : ticks.find((t) => t > tick);
    if (next !== undefined) this.to(next / this.rate);
    else if (direction > 0) this.live();
  }

  private events(): Event[] {
    const { first, last } = this.span;
    const shown = (e: Event): boolean => tickOf(e) >= first && tickOf(e) <= last && markWords(e) !== undefined;
    return (this.past?.events ?? []).filter(shown).slice(-MOST_MARKS);
  }

  /** Brings the time line up to date. */
  update(): void {
    const { past } = this;
    const any = !!past && past.oldest >= 0 && past.newest > past.oldest;
    this.root.dataset.state = !any ? "none" : this.shown === undefined ? "live" : "past";
    this.slider.disabled = !any;
    if (!past || !any) {
      this.say("", "nothing is held yet");
      this.marks.replaceChildren();
      this.drawn = "";
      return;
    }
    if (this.shown === undefined && !this.held) this.span = { first: past.oldest, last: past.newest };
    else if (this.shown !== undefined && this.shown * this.rate < past.oldest) {
      // The server has forgotten that moment meanwhile.
      this.shown = past.oldest / this.rate;
      this.span.first = past.oldest;
      past.lookAt(this.shown);
    }
    const { first, last } = this.span;
    this.slider.min = String(first);
    this.slider.max = String(Math.max(last, first + 1));
    if (!this.held || this.shown !== undefined) this.slider.value = String(this.shown === undefined ? last : this.tick);
    if (this.shown === undefined) this.say("live", `live, ${seconds(last / this.rate)}`);
    else {
      const ago = past.newest / this.rate - this.shown;
      this.say(`−${seconds(ago)}`, `${seconds(this.shown)}, ${seconds(ago)} before now`);
    }
    this.mark();
  }

  private say(text: string, spoken: string): void {
    if (this.readout.textContent !== text) this.readout.textContent = text;
    this.slider.setAttribute("aria-valuetext", spoken);
  }

  /** Draws the marks where they are now. */
  private mark(): void {
    const { first, last } = this.span;
    const width = this.marks.clientWidth;
    const key = `${this.past?.version} ${first} ${last} ${width}`;
    if (key === this.drawn || !width) return;
    this.drawn = key;
    const ends = new Map<string, number>();
    const spans = this.events().flatMap((e) => {
      const words = markWords(e);
      const x = ((tickOf(e) - first) / Math.max(1, last - first)) * width;
      if (!words || x - (ends.get(words.kind) ?? -Infinity) < APART) return [];
      ends.set(words.kind, x);
      const span = document.createElement("span");
      span.className = words.kind;
      span.dataset.tick = String(tickOf(e));
      span.title = `${seconds(e.timeS)}: ${words.text}`;
      span.style.left = `${((100 * x) / width).toFixed(2)}%`;
      return [span];
    });
    this.marks.replaceChildren(...spans);
  }
}
