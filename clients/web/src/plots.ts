// Joint torque and its available range over the last seconds, with axes.
import { HISTORY_S, type Person, type Sample } from "./model.js";
import { dof as dofWords, signed } from "./words.js";

/** How many DOFs are plotted at a time. */
export const PLOTS = 3;

/** What a plot without curves is called. */
const EMPTY = "no torque to plot";
/** Least height of a torque axis, N·m. */
const LEAST_SPAN = 4;
/** Marks on the time axis, s before now. */
const TIMES = [-8, -6, -4, -2, 0];

/** A torque axis: where it begins and ends, and its marks, N·m. */
export interface Axis {
  low: number;
  high: number;
  step: number;
}

/** An axis with round marks that contains `low` and `high` (N·m), with three to six marks. */
export function axis(low: number, high: number): Axis {
  const span = Math.max(high - low, LEAST_SPAN);
  const magnitude = 10 ** Math.floor(Math.log10(span / 4));
  const step = [1, 2, 5, 10].map((f) => f * magnitude).find((s) => span / s <= 4) ?? 10 * magnitude;
  const from = Math.floor(low / step) * step;
  const to = Math.ceil(high / step) * step;
  return { low: from, high: to > from ? to : from + step, step };
}

/** The axis for values from `low` to `high`: the one in use, as long as they fit in and fill at least half of it. */
export function settled(inUse: Axis | undefined, low: number, high: number): Axis {
  const fits = inUse && low >= inUse.low && high <= inUse.high;
  if (fits && high - low >= 0.5 * (inUse.high - inUse.low - inUse.step)) return inUse;
  return axis(low, high);
}

/**
 * Share of the time in which limits decide on the axis: a muscle that is stretched fast, as in a fall, resists with far
 * more for a moment.
 */
const USUAL = 0.95;

/** The value below which this share of the values lies. */
export function usual(values: number[], share: number): number {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? 0;
}

/** Marks of an axis from the lowest to the highest, N·m. */
export function marks(a: Axis): number[] {
  return Array.from({ length: Math.round((a.high - a.low) / a.step) + 1 }, (_, i) => a.low + i * a.step);
}

function element(tag: string, name: string, ...children: (Node | string)[]): HTMLElement {
  const e = document.createElement(tag);
  e.className = name;
  e.append(...children);
  return e;
}

/** One plot: title and readout, torque axis in N·m, curves, time axis in s. Its size never changes. */
export class Plot {
  readonly figure = element("figure", "plot");
  private readonly name = document.createElement("span");
  private readonly value = document.createElement("span");
  private readonly canvas = document.createElement("canvas");
  private readonly torques = element("div", "torques");
  private axis: Axis | undefined;
  private dof = -1;
  private person: Person | undefined;

  constructor() {
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", EMPTY);
    this.canvas.tabIndex = -1;
    this.torques.setAttribute("aria-hidden", "true");
    const times = element("div", "times", ...TIMES.map((t) => element("span", "", t === 0 ? "0 s" : signed(t))));
    times.setAttribute("aria-hidden", "true");
    const unit = element("span", "unit", "N·m");
    unit.setAttribute("aria-hidden", "true");
    const caption = document.createElement("figcaption");
    caption.append(this.name, this.value);
    this.figure.append(caption, this.torques, this.canvas, unit, times);
  }

  /** Shows one degree of freedom of a figure, or empty axes. `words`: its readout, too. */
  show(person: Person | undefined, dof: number | undefined, words: boolean): void {
    if (person !== this.person || dof !== this.dof) {
      [this.person, this.dof, this.axis] = [person, dof ?? -1, undefined];
      words = true;
    }
    const newest = dof === undefined ? undefined : person?.history.at(-1);
    if (!person || dof === undefined || !newest) {
      this.name.textContent = this.value.textContent = "";
      this.torques.replaceChildren();
      this.canvas.setAttribute("aria-label", EMPTY);
      this.canvas.getContext("2d")?.clearRect(0, 0, this.canvas.width, this.canvas.height);
      return;
    }
    const count = person.body.dofs.length;
    const { history } = person;
    const torques = history.map((s) => s.torque[dof]);
    const low = Math.min(
      0,
      ...torques,
      usual(
        history.map((s) => s.limits[dof]),
        1 - USUAL,
      ),
    );
    const high = Math.max(
      0,
      ...torques,
      usual(
        history.map((s) => s.limits[count + dof]),
        USUAL,
      ),
    );
    const scale = settled(this.axis, low, high);
    if (scale !== this.axis) {
      this.axis = scale;
      const place = (v: number): number => (100 * (scale.high - v)) / (scale.high - scale.low);
      this.torques.replaceChildren(
        ...marks(scale).map((v) => {
          const label = element("span", "", signed(v));
          label.style.top = `${place(v).toFixed(2)}%`;
          return label;
        }),
      );
    }
    draw(this.canvas, person, dof, scale);
    if (!words) return;
    this.name.textContent = dofWords(person.body.dofs[dof].name);
    const range = `${signed(newest.limits[dof])} to ${signed(newest.limits[count + dof])}`;
    this.value.textContent = `${signed(newest.torque[dof])} N·m (${range})`;
    this.canvas.setAttribute("aria-label", plotText(person, dof));
  }
}

/** Draws torque (line), available range (band), torque limit where it is reached (thick) and lines at the marks. */
function draw(canvas: HTMLCanvasElement, person: Person, dof: number, scale: Axis): void {
  const density = Math.min(2, devicePixelRatio);
  const [w, h] = [canvas.clientWidth, canvas.clientHeight];
  if (!w || !h) return;
  if (canvas.width !== Math.round(w * density)) canvas.width = Math.round(w * density);
  if (canvas.height !== Math.round(h * density)) canvas.height = Math.round(h * density);
  const ink = canvas.getContext("2d");
  const { history } = person;
  const newest = history.at(-1);
  if (!ink || !newest) return;
  const style = getComputedStyle(canvas);
  const colour = (name: string): string => style.getPropertyValue(name);
  ink.setTransform(density, 0, 0, density, 0, 0);
  ink.clearRect(0, 0, w, h);
  const count = person.body.dofs.length;
  const x = (time: number): number => w - ((newest.time - time) / HISTORY_S) * w;
  const y = (torque: number): number => 1 + ((scale.high - torque) / (scale.high - scale.low)) * (h - 2);
  const trace = (value: (s: Sample) => number): void => {
    ink.beginPath();
    history.forEach((s, i) => (i ? ink.lineTo(x(s.time), y(value(s))) : ink.moveTo(x(s.time), y(value(s)))));
  };
  const lowest = (s: Sample): number => s.limits[dof];
  const highest = (s: Sample): number => s.limits[count + dof];
  trace(highest);
  for (let i = history.length - 1; i >= 0; i--) ink.lineTo(x(history[i].time), y(lowest(history[i])));
  ink.closePath();
  ink.fillStyle = colour("--band");
  ink.fill();
  ink.lineWidth = 1;
  for (const v of marks(scale)) {
    ink.strokeStyle = colour(Math.abs(v) < 1e-9 ? "--quiet" : "--grid");
    ink.beginPath();
    ink.moveTo(0, y(v));
    ink.lineTo(w, y(v));
    ink.stroke();
  }
  ink.strokeStyle = colour("--grid");
  for (const t of TIMES.slice(1, -1)) {
    ink.beginPath();
    ink.moveTo(x(newest.time + t), 0);
    ink.lineTo(x(newest.time + t), h);
    ink.stroke();
  }
  ink.lineJoin = "round";
  ink.strokeStyle = colour("--accent");
  ink.lineWidth = 1.6;
  trace((s) => s.torque[dof]);
  ink.stroke();
  ink.strokeStyle = colour("--hot");
  ink.lineWidth = 4;
  ink.beginPath();
  let drawing = false;
  for (const s of history) {
    const limit = s.torque[dof] < 0 ? lowest(s) : highest(s);
    const at = limit !== 0 && s.torque[dof] / limit > 0.995;
    if (at && drawing) ink.lineTo(x(s.time), y(s.torque[dof]));
    else if (at) ink.moveTo(x(s.time), y(s.torque[dof]));
    drawing = at;
  }
  ink.stroke();
}

/** The same choice in an order that leaves each one in its place if it was there before. */
export function inPlace(before: number[], chosen: number[]): number[] {
  const fresh = chosen.filter((d) => !before.includes(d));
  const kept = before.slice(0, chosen.length).map((d) => (chosen.includes(d) ? d : fresh.shift()));
  return [...kept.filter((d) => d !== undefined), ...fresh];
}

/** The DOFs with the highest effort lately, one per joint. */
export function busiest(person: Person): number[] {
  const peak = new Float32Array(person.body.dofs.length);
  const count = peak.length;
  for (const s of person.history)
    for (let d = 0; d < count; d++) {
      const limit = s.torque[d] < 0 ? s.limits[d] : s.limits[count + d];
      if (limit !== 0) peak[d] = Math.max(peak[d], s.torque[d] / limit);
    }
  const order = [...peak.keys()].sort((a, b) => peak[b] - peak[a]);
  const chosen: number[] = [];
  const joints = new Set<number>();
  for (const d of order) {
    const { joint } = person.body.dofs[d];
    // Left and right of the same joint show the same most of the time.
    const twin = person.body.joints[joint].name.replace(/^[lr]_/, "");
    const taken = chosen.some((c) => person.body.joints[person.body.dofs[c].joint].name.replace(/^[lr]_/, "") === twin);
    if (joints.has(joint) || taken) continue;
    joints.add(joint);
    chosen.push(d);
    if (chosen.length === PLOTS) break;
  }
  return chosen;
}

/** What a plot shows, for screen readers. */
export function plotText(person: Person, dof: number): string {
  const s = person.history.at(-1);
  const name = dofWords(person.body.dofs[dof].name);
  if (!s) return name;
  const range = `${signed(s.limits[dof])} to ${signed(s.limits[person.body.dofs.length + dof])} N·m`;
  return `${name}: ${signed(s.torque[dof])} N·m, available range ${range}, last ${HISTORY_S} s`;
}
