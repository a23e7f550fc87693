// Two futures side by side: the original and a branch of it, at the same time since they parted. The branch sets the
// time; the original, which has been there already, is shown from its past until the branch has caught up.
import type { Beside } from "./beside.js";
import { CatchUp, type Pair } from "./branches.js";
import { message } from "./client.js";
import type { Moment } from "./moment.js";
import { el } from "./panel.js";
import type { Session } from "./session.js";

/** Lag from which on it is said, s. */
const LAGS_S = 1;

/** Parts of the page that are shown while two worlds are. */
export interface Strip {
  strip: HTMLElement;
  since: HTMLOutputElement;
  lag: HTMLElement;
  catchUp: HTMLButtonElement;
  swap: HTMLButtonElement;
  done: HTMLButtonElement;
  mainHeader: HTMLElement;
  mainTitle: HTMLElement;
  besideTitle: HTMLElement;
}

/** What the comparison asks of the page. */
export interface Wishes {
  say: (text: string, grave?: boolean) => void;
  /** Opens a dialog; gives what closes it. */
  ask: (title: string, ...content: HTMLElement[]) => () => void;
  /** Shows a world in the main pane. */
  show: (world: string) => void;
  changed: () => void;
}

export class Compare {
  /** What is compared; undefined: nothing is. */
  pair: Pair | undefined;
  /** Whether panel and time line are of the branch. */
  mainIsBranch = true;
  private readonly catching: CatchUp;

  constructor(
    private readonly session: Session,
    private readonly beside: Beside,
    private readonly parts: Strip,
    private readonly wishes: Wishes,
  ) {
    this.catching = new CatchUp(wishes.say);
    parts.catchUp.addEventListener("click", () => void this.catching.begin(this.branch));
    parts.swap.addEventListener("click", () => this.swap());
    parts.done.addEventListener("click", () => this.ask());
  }

  private get branch(): Session {
    return this.mainIsBranch ? this.session : this.beside.session;
  }

  private get original(): Session {
    return this.mainIsBranch ? this.beside.session : this.session;
  }

  /** Shows two worlds; panel and time line are of the branch. */
  begin(pair: Pair): void {
    this.pair = pair;
    this.mainIsBranch = true;
    this.open();
  }

  private open(): void {
    const { pair } = this;
    if (!pair) return;
    const { strip, mainHeader, mainTitle, besideTitle } = this.parts;
    strip.hidden = mainHeader.hidden = false;
    const titles = [`Branch: ${pair.branch}`, `Original: ${pair.original}`];
    [mainTitle.textContent, besideTitle.textContent] = this.mainIsBranch ? titles : titles.reverse();
    document.body.dataset.pair = this.mainIsBranch ? "branch" : "original";
    this.wishes.show(this.mainIsBranch ? pair.branch : pair.original);
    this.beside.show(this.mainIsBranch ? pair.original : pair.branch);
    this.wishes.changed();
  }

  private swap(): void {
    this.mainIsBranch = !this.mainIsBranch;
    this.open();
  }

  /** Shows one world only; which one is another's business. */
  leave(): void {
    if (!this.pair) return;
    this.pair = undefined;
    this.parts.strip.hidden = this.parts.mainHeader.hidden = true;
    delete document.body.dataset.pair;
    this.beside.close();
    this.wishes.changed();
  }

  private ask(): void {
    const { pair } = this;
    if (!pair) return;
    const button = (text: string, attributes: Record<string, string>, what: () => void): HTMLButtonElement => {
      const b = el("button", { type: "button", ...attributes }, text);
      b.addEventListener("click", () => {
        close();
        what();
      });
      return b;
    };
    const back = (): void => {
      this.leave();
      this.wishes.show(pair.original);
    };
    const close = this.wishes.ask(
      "End the comparison",
      el("p", {}, `The branch “${pair.branch}” is a world of its own and goes on until it is deleted.`),
      el(
        "div",
        { class: "buttons" },
        button("Delete the branch", { id: "branch-delete", class: "main" }, () => {
          back();
          this.session.api.worlds.deleteWorld({ name: `worlds/${pair.branch}` }).then(
            () => this.wishes.say(`The branch “${pair.branch}” is deleted`),
            (error: unknown) => this.wishes.say(message(error), true),
          );
        }),
        button("Keep it", { id: "branch-keep" }, back),
      ),
    );
  }

  /** World time of both pictures, s: that of the branch, as `main` or `beside` shows it alone. */
  time(main: Moment | undefined, beside: Moment | undefined): number | undefined {
    return this.pair && (this.mainIsBranch ? main : beside)?.time;
  }

  /** Brings words up to date: `time` is that of both pictures. */
  update(time: number | undefined): void {
    const { pair, parts } = this;
    if (!pair) return;
    const rate = this.branch.past?.rateHz ?? this.original.past?.rateHz ?? 60;
    const since = time === undefined ? NaN : time - pair.since / rate;
    const newest = this.original.playhead.newest()?.timeS ?? NaN;
    const lag = newest - (this.branch.playhead.newest()?.timeS ?? NaN);
    this.catching.update(this.branch, lag);
    const text = Number.isNaN(since) ? "Connecting" : `Since the branch: ${Math.max(0, since).toFixed(1)} s`;
    if (parts.since.textContent !== text) parts.since.textContent = text;
    const words = this.words(lag);
    if (parts.lag.textContent !== words) parts.lag.textContent = words;
    parts.catchUp.disabled = !(lag > LAGS_S) || this.catching.running;
  }

  private words(lag: number): string {
    if (this.catching.running) return `Catching up: ${Math.max(0, lag).toFixed(1)} s to go`;
    if (this.branch.paused) return "The branch is paused: change something in it, then resume it.";
    if (lag > LAGS_S) return `The original is shown ${lag.toFixed(1)} s after it happened.`;
    if (lag < -LAGS_S) return "The original is behind the branch: its newest picture is shown.";
    return "Both are live.";
  }
}
