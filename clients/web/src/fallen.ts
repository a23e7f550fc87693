// Figures that have fallen: a message for each for as long as it lies there, with a button that stands it up again.
import { numbers } from "./client.js";
import type { Person } from "./model.js";

/** Messages at a time; the other figures are counted. */
const MOST = 3;
/** If the desired pelvis is higher than the simulated one by this much (m), the motion itself does not lie down. */
const ABOVE_M = 0.2;

export class Fallen {
  private readonly list = document.createElement("ul");
  private readonly note = document.createElement("p");
  private readonly rows = new Map<string, HTMLLIElement>();
  private lying = new Set<string>();

  /** `root`: where the messages are shown. `standUp`: asked for with the button of a message. */
  constructor(
    private readonly root: HTMLElement,
    private readonly standUp: (name: string) => void,
  ) {
    this.root.setAttribute("role", "status");
    this.root.append(this.list, this.note);
    this.root.hidden = true;
  }

  /** Brings the messages up to date. `fallen`: whether the newest frame says so of a figure. */
  update(people: Iterable<Person>, fallen: (p: Person) => boolean, chosen: Person | undefined): void {
    const lying = new Set<string>();
    for (const p of people) {
      // A motion that lies on the floor counts as fallen, too: then nothing is wrong. Once told, it stays told until
      // the figure is up.
      if (fallen(p) && (this.lying.has(p.name) || wantsHigher(p))) lying.add(p.name);
    }
    this.lying = lying;
    const names = [...lying].sort((a, b) => Number(b === chosen?.name) - Number(a === chosen?.name)).slice(0, MOST);
    for (const [name, row] of this.rows)
      if (!names.includes(name)) {
        row.remove();
        this.rows.delete(name);
      }
    // Rows that stay keep their buttons, with focus and press.
    for (const name of names) if (!this.rows.has(name)) this.add(name);
    for (const [name, row] of this.rows) row.classList.toggle("chosen", name === chosen?.name);
    const more = lying.size - names.length;
    const alone =
      lying.size === 1
        ? "It gets up by itself only if its motion gets up."
        : "They get up by themselves only if their motions get up.";
    const note =
      more > 0
        ? `${more} more ${more === 1 ? "figure has" : "figures have"} fallen. ` +
          "Reset puts all of them back on their feet."
        : alone;
    if (this.note.textContent !== note) this.note.textContent = note;
    this.root.hidden = !lying.size;
  }

  private add(name: string): void {
    const row = document.createElement("li");
    const text = document.createElement("span");
    text.textContent = `${name} has fallen`;
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "Stand up again";
    button.setAttribute("aria-label", `Stand ${name} up again`);
    button.addEventListener("click", () => this.standUp(name));
    const key = document.createElement("kbd");
    key.textContent = "U";
    key.setAttribute("aria-hidden", "true");
    button.append(" ", key);
    row.append(text, button);
    this.rows.set(name, row);
    this.list.append(row);
  }
}

/** Whether the desired motion has its pelvis well above the simulated one. */
function wantsHigher(p: Person): boolean {
  const desired = numbers(p.frame?.desired?.rootPose);
  const actual = numbers(p.frame?.segmentTransforms);
  return desired.length < 3 || actual.length < 3 || desired[2] > actual[2] + ABOVE_M;
}
