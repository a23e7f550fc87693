// Torque within its limits, over the last seconds.
import { HISTORY_S, type Person } from "./model.js";
import { dof as dofWords } from "./words.js";

/** How many DOFs are plotted at a time. */
export const PLOTS = 3;

/** Draws torque (line), what the muscles could give (band) and where it was at its limit (thick, hatched). */
export function plot(canvas: HTMLCanvasElement, person: Person, dof: number): void {
  const scale = Math.min(2, devicePixelRatio);
  const [w, h] = [canvas.clientWidth, canvas.clientHeight];
  if (!w || !h) return;
  if (canvas.width !== Math.round(w * scale)) canvas.width = Math.round(w * scale);
  if (canvas.height !== Math.round(h * scale)) canvas.height = Math.round(h * scale);
  const ink = canvas.getContext("2d");
  if (!ink) return;
  const style = getComputedStyle(canvas);
  const colour = (name: string): string => style.getPropertyValue(name);
  ink.setTransform(scale, 0, 0, scale, 0, 0);
  ink.clearRect(0, 0, w, h);
  const history = person.history;
  const newest = history.at(-1);
  if (!newest) return;
  const count = person.body.dofs.length;
  let top = 1;
  for (const s of history) top = Math.max(top, -s.limits[dof], s.limits[count + dof]);
  top *= 1.08;
  const x = (time: number): number => w - ((newest.time - time) / HISTORY_S) * w;
  const y = (torque: number): number => h / 2 - (torque / top) * (h / 2 - 2);
  ink.beginPath();
  history.forEach((s, i) => (i ? ink.lineTo(x(s.time), y(s.limits[count + dof])) : ink.moveTo(x(s.time), y(s.limits[count + dof]))));
  for (let i = history.length - 1; i >= 0; i--) ink.lineTo(x(history[i].time), y(history[i].limits[dof]));
  ink.closePath();
  ink.fillStyle = colour("--band");
  ink.fill();
  ink.strokeStyle = colour("--faint");
  ink.lineWidth = 1;
  ink.beginPath();
  ink.moveTo(0, h / 2);
  ink.lineTo(w, h / 2);
  ink.stroke();
  ink.lineJoin = "round";
  ink.strokeStyle = colour("--accent");
  ink.lineWidth = 1.6;
  ink.beginPath();
  history.forEach((s, i) => (i ? ink.lineTo(x(s.time), y(s.torque[dof])) : ink.moveTo(x(s.time), y(s.torque[dof]))));
  ink.stroke();
  ink.strokeStyle = colour("--hot");
  ink.lineWidth = 4;
  ink.beginPath();
  let drawing = false;
  for (const s of history) {
    const limit = s.torque[dof] < 0 ? s.limits[dof] : s.limits[count + dof];
    const at = limit !== 0 && s.torque[dof] / limit > 0.995;
    if (at && drawing) ink.lineTo(x(s.time), y(s.torque[dof]));
    else if (at) ink.moveTo(x(s.time), y(s.torque[dof]));
    drawing = at;
  }
  ink.stroke();
}

/** The DOFs that worked hardest lately, one per joint. */
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
    // Left and right of the same joint say the same most of the time.
    const twin = person.body.joints[joint].name.replace(/^[lr]_/, "");
    const taken = chosen.some((c) => person.body.joints[person.body.dofs[c].joint].name.replace(/^[lr]_/, "") === twin);
    if (joints.has(joint) || taken) continue;
    joints.add(joint);
    chosen.push(d);
    if (chosen.length === PLOTS) break;
  }
  return chosen;
}

/** What a plot shows, for those who do not see it. */
export function plotText(person: Person, dof: number): string {
  const s = person.history.at(-1);
  const name = dofWords(person.body.dofs[dof].name);
  if (!s) return name;
  return `${name}: ${s.torque[dof].toFixed(0)} N·m, within ${s.limits[dof].toFixed(0)} to ${s.limits[person.body.dofs.length + dof].toFixed(0)} N·m`;
}
