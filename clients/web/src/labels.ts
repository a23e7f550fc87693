// Names above heads, and the size of a push at the pointer.
import type { Person } from "./model.js";
import type { Scene } from "./scene.js";

/** Figures up to which all have their names shown; above, only the chosen one. */
const FEW = 6;
/** Key of the label at the pointer; no figure is called so. */
const PUSH = "\u0000push";

export class Labels {
  /** What is written at the pointer. */
  push: { text: string; x: number; y: number } | undefined;
  private readonly tags = new Map<string, HTMLSpanElement>();

  constructor(private readonly root: HTMLElement) {}

  /** Brings the labels up to date. */
  update(people: Iterable<Person>, chosen: string | undefined, scene: Scene | undefined): void {
    const all = [...people];
    const present = new Set(all.map((p) => p.name));
    for (const [key, span] of this.tags)
      if (key !== PUSH && !present.has(key)) {
        span.remove();
        this.tags.delete(key);
      }
    for (const p of all) {
      const visible = p.name === chosen || (all.length <= FEW && !this.push);
      this.tag(p.name, p.name, p.name === chosen ? "chosen" : "", visible ? scene?.label(p) : undefined);
    }
    this.tag(PUSH, this.push?.text ?? "", "impulse", this.push && { x: this.push.x, y: this.push.y - 16 });
  }

  private tag(key: string, text: string, kind: string, place: { x: number; y: number } | undefined): void {
    let span = this.tags.get(key);
    if (!place) {
      if (span) span.hidden = true;
      return;
    }
    if (!span) {
      span = document.createElement("span");
      this.tags.set(key, span);
      this.root.append(span);
    }
    span.hidden = false;
    if (span.textContent !== text) span.textContent = text;
    if (span.className !== kind) span.className = kind;
    span.style.transform = `translate(${place.x.toFixed(1)}px, ${place.y.toFixed(1)}px) translate(-50%, -100%)`;
  }
}
