// Keys: what they do, and what the help says of them.
import { el } from "./panel.js";

const KEYS: [string, string][] = [
  ["Space", "pause or resume"],
  [".", "advance one tick (pauses first)"],
  ["S", "slow motion on or off"],
  ["R", "rewind the world by 5 s, for everyone"],
  ["N", "branch: make a new world of the moment that is shown"],
  ["← →  Home  End", "with the time line focused: past moments, the oldest, the present; Page keys go to events"],
  ["[  ]", "choose the previous or next figure"],
  ["L  K", "more or less load"],
  ["P", "push the chosen figure as set in the panel"],
  ["U", "stand the chosen figure up again"],
  ["Shift R", "reset the world"],
  ["T", "follow the chosen figure"],
  ["F", "fit all figures in the view"],
  ["← → ↑ ↓", "turn the view (with the scene focused)"],
  ["+  −", "zoom in or out"],
  ["G  E  C  B", "show desired motion, joint effort, contact forces, support"],
  ["Esc", "cancel a push while dragging; back to the present"],
];

/** What the help says. */
export function helpText(): HTMLElement[] {
  const table = el(
    "table",
    {},
    ...KEYS.map(([key, text]) =>
      el("tr", {}, el("td", {}, ...key.split("  ").flatMap((k) => [el("kbd", {}, k), " "])), el("td", {}, text)),
    ),
  );
  const pointer = el(
    "p",
    {},
    "Drag a figure to push it. Drag beside the figures to turn the view, with the right button to pan, and use the " +
      "wheel or two fingers to zoom. Drop a BVH file anywhere on the page to play it. Drag the time line to see what " +
      "was; only Rewind changes the world.",
  );
  const marks: [string, string][] = [
    ["fall", "balance lost, fall"],
    ["push", "push"],
    ["clip", "clip or live motion begins"],
    ["mass", "load taken or dropped"],
    ["world", "figures, obstacles, rewinds"],
  ];
  const legend = el(
    "ul",
    { class: "key marks", "aria-label": "Marks on the time line" },
    ...marks.map(([kind, text]) => el("li", {}, el("i", { class: kind }), text)),
  );
  return [pointer, table, legend];
}

/** What keys do. */
export interface Actions {
  /** By key, letters in lower case; with Shift: `shift+r`. */
  keys: Record<string, () => void>;
  pause: () => void;
  /** Turns the view: sideways, upward (rad), nearer (factor). */
  turn: (sideways: number, upward: number, nearer: number) => void;
  /** Escape: gives up what is under way. */
  cancel: () => void;
  /** Whether keys go elsewhere now. */
  blocked: () => boolean;
}

const TURNS: Record<string, [number, number, number]> = {
  ArrowLeft: [-0.12, 0, 1],
  ArrowRight: [0.12, 0, 1],
  ArrowUp: [0, 0.08, 1],
  ArrowDown: [0, -0.08, 1],
};

/** Lets keys act, wherever the focus is but in fields that take text. */
export function listen(actions: Actions): void {
  addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || actions.blocked()) return;
    const at = e.target instanceof HTMLElement ? e.target : document.body;
    const typing = at.matches("input:not([type=checkbox]):not([type=range]), select, textarea");
    if (e.key === "Escape") actions.cancel();
    if (typing) return;
    const done = (what: () => void): void => {
      e.preventDefault();
      what();
    };
    if (e.key === " " && !at.matches("button, summary, a, input:not([type=range])")) return done(actions.pause);
    const turn = at.matches("canvas") ? TURNS[e.key] : undefined;
    if (turn) return done(() => actions.turn(...turn));
    const key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
    const action = actions.keys[e.shiftKey ? `shift+${key}` : key] ?? (key === "r" ? undefined : actions.keys[key]);
    if (action) done(action);
  });
}
