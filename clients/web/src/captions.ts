// What happens, in words: events as they come, and torque limits with how long they last.
import { type Event } from "./gen/sinew/v1/state_pb.js";
import type { Person } from "./model.js";
import { event as eventWords, joint as jointWords } from "./words.js";

/** Captions at a time. */
const MOST = 4;
/** How long a caption stays after its cause is over, s. */
const STAYS_S = 2.5;
/** Time at a limit below which nothing is said, s. */
const LEAST_S = 0.25;

interface Caption {
  text: string;
  grave: boolean;
  until: number;
}

export class Captions {
  private readonly shown = new Map<string, Caption>();
  private readonly told = document.createElement("div");
  private last = "";

  constructor(private readonly list: HTMLElement) {
    this.told.className = "hidden";
    this.told.setAttribute("aria-live", "polite");
    list.removeAttribute("aria-live");
    list.after(this.told);
  }

  /** Takes an event of the world. */
  event(e: Event, now: number): void {
    const words = eventWords(e);
    if (!words) return;
    this.shown.delete(`event ${e.figureId}`);
    this.shown.set(`event ${e.figureId}`, { ...words, until: now + 2 * STAYS_S });
    this.told.textContent = words.text;
  }

  /** Says something of the page's own, at once. */
  say(text: string, now: number, grave = false): void {
    this.shown.delete("page");
    this.shown.set("page", { text, grave, until: now + 2.4 * STAYS_S });
    this.told.textContent = text;
  }

  clear(): void {
    this.shown.clear();
  }

  /** Brings the captions up to date: `time` is the world's, `now` the wall's (s). */
  update(people: Iterable<Person>, time: number, now: number): void {
    for (const p of people) {
      const longest = new Map<number, number>();
      p.body.dofs.forEach((d, i) => {
        const since = p.limitSince[i];
        if (!Number.isNaN(since)) longest.set(d.joint, Math.max(longest.get(d.joint) ?? 0, time - since));
      });
      // Left and right that strain together are one caption.
      const told = new Map<string, { sides: string[]; seconds: number }>();
      for (const [j, seconds] of longest) {
        if (seconds < LEAST_S) continue;
        const { name } = p.body.joints[j];
        const pair = name.replace(/^[lr]_/, "");
        const caption = told.get(pair) ?? { sides: [], seconds: 0 };
        told.set(pair, { sides: [...caption.sides, name], seconds: Math.max(caption.seconds, seconds) });
      }
      for (const [pair, { sides, seconds }] of told) {
        const what =
          sides.length > 1
            ? `both ${jointWords(pair)}s at their torque limit`
            : `${jointWords(sides[0])} at its torque limit`;
        this.shown.set(`${p.name} ${pair}`, {
          text: `${p.name}: ${what} for\u00a0${seconds.toFixed(1)}\u00a0s`,
          grave: false,
          until: now + STAYS_S,
        });
      }
    }
    for (const [key, c] of this.shown) if (c.until < now) this.shown.delete(key);
    // What is grave comes first, then what is newest.
    const lines = [...this.shown.values()]
      .sort((a, b) => Number(b.grave) - Number(a.grave) || b.until - a.until)
      .slice(0, MOST);
    const text = lines.map((l) => `${l.grave ? "!" : ""}${l.text}`).join("\n");
    if (text === this.last) return;
    this.last = text;
    this.list.replaceChildren(
      ...lines.map((l) => {
        const item = document.createElement("li");
        item.textContent = l.text;
        if (l.grave) item.className = "grave";
        return item;
      }),
    );
  }
}
