// The viewer: puts session, scene and panel together.
import "./viewer.css";
import { Captions } from "./captions.js";
import { connect, message, Sinew } from "./client.js";
import { Fallen } from "./fallen.js";
import type { FigureFrame, WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import type { Person } from "./model.js";
import { Obstacles } from "./obstacles.js";
import { el, Panel, type Anew } from "./panel.js";
import { Scene, type Shown } from "./scene.js";
import { Session, type Phase } from "./session.js";
import { asCommand, asPython, cast, read, settingsOf, write, type Address } from "./share.js";
import { takeToken } from "./token.js";
import { kilograms } from "./words.js";

function get<T extends HTMLElement>(id: string, kind: new () => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`the page has no ${id}`);
  return found;
}

const [bar, stage, canvas] = [get("bar", HTMLElement), get("stage", HTMLElement), get("view", HTMLCanvasElement)];
const [pauseButton, stepButton, speed] = [
  get("pause", HTMLButtonElement),
  get("step", HTMLButtonElement),
  get("speed", HTMLSelectElement),
];
const [slider, sliderValue] = [get("load-slider", HTMLInputElement), get("load-value", HTMLOutputElement)];
const [state, dialog, labels] = [
  get("state", HTMLElement),
  get("dialog", HTMLDialogElement),
  get("labels", HTMLElement),
];
const worldChoice = get("world", HTMLSelectElement);
const panelToggle = get("panel-toggle", HTMLButtonElement);
const [resetButton, followButton] = [get("reset", HTMLButtonElement), get("follow", HTMLButtonElement)];

const token = takeToken();
let address: Address = read(location.hash);
const shown: Shown = { ghost: true, forces: true, support: true, effort: true };
for (const key of address.hide) if (key in shown) shown[key as keyof Shown] = false;

let chosen: Person | undefined;
let rebuilding = false;
let wantedFigure = address.figure;
let lastFrame: WorldFrame | undefined;
const now = (): number => performance.now() / 1000;

const captions = new Captions(get("captions", HTMLElement));
const say = (text: string, grave = false): void => captions.say(text, now(), grave);
const attempt = (what: Promise<unknown>): void => void what.catch((error: unknown) => say(message(error), true));

/** One change after the other: each sees what the one before it has brought about. */
let turn: Promise<unknown> = Promise.resolve();
function inTurn(what: () => Promise<unknown>): void {
  const done = turn.then(what);
  turn = done.catch(() => undefined);
  attempt(done);
}

/** The same for the chosen figure, which may be made anew before its turn comes. */
function forChosen(what: (p: Person) => Promise<unknown>): void {
  if (!chosen) return say("Choose a figure first.");
  forFigure(chosen.name, what);
}

/** The same for a figure by its name. */
function forFigure(name: string, what: (p: Person) => Promise<unknown>): void {
  inTurn(async () => {
    const p = session.person(name);
    if (p) await what(p);
  });
}

const fallen = new Fallen(get("fallen", HTMLElement), (name) => forFigure(name, (p) => session.standUp(p)));
const obstacles = new Obstacles();
const session = new Session(
  new Sinew(location.origin, connect(location.origin, token)),
  (what) => {
    if (what === "phase") showPhase(session.phase);
    if (what === "roster") roster();
    if (what === "world") worldChanged();
    if (what === "lists") listsChanged();
  },
  (event) => captions.event(event, now()),
  (frame) => {
    lastFrame = frame;
    if (session.world) void obstacles.follow(session.api, session.world.name, frame);
  },
);

let scene: Scene | undefined;
let pushLabel: { text: string; x: number; y: number } | undefined;
try {
  scene = new Scene(canvas, {
    choose: (p) => choose(p),
    pushing: (push, x, y) => (pushLabel = push ? { text: `${push.impulse.length().toFixed(0)} N·s`, x, y } : undefined),
    push: ({ person, segment, local, impulse }) => {
      const size = impulse.length();
      attempt(
        session.api.perturbations
          .applyPerturbations({
            world: session.world?.name ?? "",
            perturbations: [
              {
                figureId: person.name,
                kind: {
                  case: "impulse",
                  value: {
                    segment,
                    pointM: { x: local.x, y: local.y, z: local.z },
                    impulseNewtonSeconds: { x: impulse.x, y: impulse.y, z: impulse.z },
                    durationS: 0.1,
                  },
                },
              },
            ],
          })
          .then(() => say(`Pushed ${person.name}: ${size.toFixed(0)} N·s`)),
      );
    },
    following: (on) => {
      followButton.setAttribute("aria-pressed", String(on));
      remember();
    },
  });
  scene.add(obstacles.group);
} catch {
  // The panel, the readouts and the controls work without a picture.
  canvas.hidden = get("view-tools", HTMLElement).hidden = true;
  stage.append(
    el(
      "section",
      { class: "plain" },
      el("h2", {}, "No 3D view"),
      el("p", {}, "This browser does not provide WebGL. The controls and readouts in the panel still work."),
    ),
  );
}

const panel = new Panel(
  get("controls", HTMLElement),
  session,
  {
    choose,
    say,
    forChosen,
    play: (clip) => forChosen((p) => play(p, clip)),
    rebuild: (change) => forChosen((p) => rebuild(p, change)),
    add: () => inTurn(addFigure),
    open: (file) => inTurn(() => openFile(file)),
    copy,
    shown: remember,
  },
  shown,
);

// ── What is chosen ──────────────────────────────────────────────────────────────────────────────────────────────────

function choose(person: Person | undefined): void {
  chosen = person;
  wantedFigure = person?.name ?? "";
  panel.lists(person);
  remember();
}

function roster(): void {
  scene?.populate(session.people.values());
  // A figure that is being made anew stays the chosen one.
  chosen = session.person(wantedFigure) ?? (rebuilding ? chosen : [...session.people.values()][0]);
  panel.lists(chosen);
  get("load", HTMLElement).hidden = !session.people.size;
  reproduce();
}

function listsChanged(): void {
  const names = session.worlds.map((w) => w.name.slice("worlds/".length));
  worldChoice.replaceChildren(...names.map((n) => el("option", { value: n }, n)));
  worldChoice.hidden = names.length < 2;
  panel.lists(chosen);
}

function worldChanged(): void {
  const name = session.world?.name.slice("worlds/".length) ?? "";
  worldChoice.value = name;
  pauseButton.textContent = session.paused ? "Resume" : "Pause";
  pauseButton.setAttribute("aria-pressed", String(session.paused));
  const s = String(session.world?.speed ?? 1);
  if ([...speed.options].some((o) => o.value === s)) speed.value = s;
  remember();
}

// ── States ──────────────────────────────────────────────────────────────────────────────────────────────────────────

function showPhase(phase: Phase): void {
  if (phase.kind === "error") lastFrame = undefined;
  state.dataset.kind = phase.kind;
  state.hidden = phase.kind === "live";
  document.body.dataset.phase = phase.kind;
  const words: Record<Phase["kind"], [string, string]> = {
    connecting: ["Connecting", "Waiting for the first frame."],
    live: ["", ""],
    empty: session.world
      ? ["No figures yet", "This world is empty. Add a figure, or drop a BVH file on the page."]
      : [
          "No world yet",
          "The server is running but has no world. Create one here or from a client; it will appear by itself.",
        ],
    reconnecting: ["Connection lost", "The viewer reconnects by itself as soon as the server is back."],
    error: ["Something went wrong", phase.kind === "error" ? phase.text : ""],
  };
  const [title, text] = words[phase.kind];
  for (const [id, words] of [
    ["state-title", title],
    ["state-text", text],
  ] as const) {
    const at = get(id, HTMLElement);
    if (at.textContent !== words) at.textContent = words;
  }
  const actions: HTMLElement[] = [];
  const action = (label: string, what: () => void): void => {
    const b = el("button", { type: "button", class: actions.length ? "" : "main" }, label);
    b.addEventListener("click", what);
    actions.push(b);
  };
  if (phase.kind === "empty" && session.world) action("Add a figure", () => attempt(addFigure()));
  if (phase.kind === "empty" && !session.world) action("Create a world", () => attempt(makeWorld()));
  if (phase.kind === "error") {
    if (address.figures.length && address.world) action("Create it from this link", () => attempt(makeWorld(address)));
    for (const w of session.worlds.slice(0, 4)) {
      const name = w.name.slice("worlds/".length);
      action(`Show “${name}”`, () => session.show(name));
    }
    action("Try again", () => session.show(address.world));
  }
  // An empty server is asked again and again: buttons that are the same stay, with focus and press.
  const place = get("state-actions", HTMLElement);
  const same = (list: Iterable<Element>): string => [...list].map((b) => b.textContent).join("\n");
  if (same(place.children) !== same(actions)) place.replaceChildren(...actions);
  for (const b of [pauseButton, stepButton, speed, resetButton])
    b.disabled = phase.kind !== "live" && !(phase.kind === "empty" && session.world);
  if (phase.kind === "live") reproduce();
}

async function makeWorld(from?: Address): Promise<void> {
  const { world } = await session.api.worlds.createWorld({ worldId: from?.world ?? "" });
  if (!world) return;
  for (const c of from?.figures ?? []) {
    const { figure } = await session.api.figures.createFigure({
      parent: world.name,
      figureId: c.id,
      figure: settingsOf(c),
    });
    if (figure && c.clip)
      await session.api.motion.playClip({ figure: figure.name, clip: `clips/${c.clip}`, loop: true, reset: true });
  }
  session.show(world.name.slice("worlds/".length));
}

/** Applies the view and the load of the address, once. */
let reproduced = false;
function reproduce(): void {
  if (reproduced || session.phase.kind !== "live" || !session.people.size) return;
  reproduced = true;
  if (scene) {
    scene.place = address.camera;
    scene.follow = address.follow;
  }
  if (address.load !== undefined && address.load !== slider.valueAsNumber) {
    slider.value = String(address.load);
    loadChanged();
  } else readLoad();
}

// ── Load ────────────────────────────────────────────────────────────────────────────────────────────────────────────

let carrying: Promise<void> | undefined;
let wantedLoad: number | undefined;

function loadChanged(): void {
  wantedLoad = slider.valueAsNumber;
  showLoad(wantedLoad);
  carrying ??= carry().finally(() => (carrying = undefined));
}

async function carry(): Promise<void> {
  try {
    while (wantedLoad !== undefined) {
      const mass = wantedLoad;
      wantedLoad = undefined;
      // A fallen figure stands up first, so that it can take the new load.
      const people = [...session.people.values()];
      for (const p of people) if (session.says(p, "FALLEN")) await session.standUp(p);
      await session.carry(people, mass);
      remember();
    }
  } catch (error) {
    say(message(error), true);
  }
}

function showLoad(mass: number): void {
  sliderValue.textContent = kilograms(mass);
  slider.setAttribute("aria-valuetext", `${mass} kilograms in both hands of every figure`);
}

/** Takes over a load that another viewer set. */
function readLoad(): void {
  if (carrying || document.activeElement === slider) return;
  const loads = [...session.people.values()].filter((p) => p.frame).map((p) => p.loadKg());
  if (!loads.length) return;
  const mass = Math.max(...loads);
  if (Math.abs(mass - slider.valueAsNumber) > 0.01 && mass <= 20) slider.value = String(mass);
  showLoad(mass);
}

slider.addEventListener("input", loadChanged);

// ── Reset ───────────────────────────────────────────────────────────────────────────────────────────────────────────

/** Every figure back at its start, all clips from their beginning, no loads, no pushes. */
async function resetWorld(): Promise<void> {
  wantedLoad = undefined;
  await carrying;
  const failed = await session.reset();
  slider.value = "0";
  showLoad(0);
  await session.refresh();
  remember();
  if (failed.length) say(`Not reset: ${failed.join("; ")}`, true);
  else say("World reset: all figures are back at their start, without loads");
}
resetButton.addEventListener("click", () => inTurn(resetWorld));

// ── Motion ──────────────────────────────────────────────────────────────────────────────────────────────────────────

async function play(p: Person, clip: string): Promise<void> {
  if (!clip) return;
  await session.api.motion.playClip({ figure: p.figure.name, clip: `clips/${clip}`, loop: true });
  await session.refresh();
  await takeAgain(p);
  say(`${p.name} plays “${clip}”`);
  remember();
}

/** Gives the same load again in the way that the new motion holds it: as a crate, or half in each hand. */
async function takeAgain(p: Person): Promise<void> {
  const load = p.loadKg();
  if (load > 0) await session.carry([p], load);
}

/** A valid last part of a name that is not taken. */
function fresh(base: string, taken: string[]): string {
  const clean =
    base
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, "-")
      .replace(/^[^a-z]+|-+$/g, "")
      .slice(0, 48) || "motion";
  if (!taken.includes(clean)) return clean;
  for (let n = 2; ; n++) if (!taken.includes(`${clean}-${n}`)) return `${clean}-${n}`;
}

async function openFile(file: File): Promise<void> {
  if (!chosen) await addFigure();
  const p = chosen;
  if (!p) return;
  say(`Reading ${file.name}`);
  try {
    const clipId = fresh(file.name.replace(/\.bvh$/i, ""), session.clips);
    const data = new Uint8Array(await file.arrayBuffer());
    const { clip } = await session.api.motion.createClip({
      clipId,
      displayName: file.name.slice(0, 100),
      body: p.body.name,
      source: { case: "bvh", value: { data } },
    });
    await session.lists();
    await session.api.motion.playClip({ figure: p.figure.name, clip: clip?.name ?? "", loop: true, reset: true });
    await session.refresh();
    await takeAgain(p);
    panel.showReport(file.name, clip?.report, undefined, clip?.forecast);
    say(`${p.name} plays ${file.name}`);
    remember();
  } catch (error) {
    panel.showReport(file.name, undefined, message(error));
    say(`${file.name}: ${message(error)}`, true);
  }
}

const drop = get("drop", HTMLElement);
let dragDepth = 0;
addEventListener("dragenter", (e) => {
  if (!e.dataTransfer?.types.includes("Files")) return;
  dragDepth++;
  drop.hidden = false;
});
addEventListener("dragleave", () => {
  dragDepth = Math.max(0, dragDepth - 1);
  if (!dragDepth) drop.hidden = true;
});
addEventListener("dragover", (e) => e.preventDefault());
addEventListener("drop", (e) => {
  e.preventDefault();
  dragDepth = 0;
  drop.hidden = true;
  const [file] = e.dataTransfer?.files ?? [];
  if (file) inTurn(() => openFile(file));
});

// ── Figures ─────────────────────────────────────────────────────────────────────────────────────────────────────────

async function addFigure(): Promise<void> {
  const people = [...session.people.values()];
  if (!session.world) return makeWorld();
  const y = people.length ? Math.min(...people.map((p) => p.figure.placement?.yM ?? 0)) - 1.2 : 0;
  const id = fresh(
    "figure",
    people.map((p) => p.name),
  );
  wantedFigure = id;
  const { figure } = await session.api.figures.createFigure({
    parent: session.world.name,
    figureId: id,
    figure: { body: chosen?.body.name ?? "bodies/adult-man", placement: { yM: y } },
  });
  if (figure) await session.api.motion.playClip({ figure: figure.name, clip: "clips/idle", loop: true, reset: true });
  await until(() => chosen?.name === id);
  await session.refresh();
}

/** Body and stepper are fixed at creation: the figure is made anew in its place, doing the same. */
async function rebuild(p: Person, change: Anew): Promise<void> {
  rebuilding = true;
  try {
    await makeAnew(p, change);
  } finally {
    rebuilding = false;
  }
}

async function makeAnew(p: Person, change: Anew): Promise<void> {
  const f = p.figure;
  const load = p.loadKg();
  wantedFigure = p.name;
  const parent = f.name.slice(0, f.name.indexOf("/figures/"));
  const { clip } = p;
  await session.api.figures.deleteFigure({ name: f.name });
  const same = {
    body: p.body.name,
    stepper: f.stepper,
    controller: f.controller,
    strength: f.strength,
    assist: f.assist,
    fatigueTimeScale: f.fatigueTimeScale,
    paper: f.paper,
    placement: f.placement,
  };
  const figure = {
    ...same,
    ...(change.body && { body: `bodies/${change.body}` }),
    ...(change.profile && { body: "", profile: change.profile }),
    ...(change.stepper && { stepper: change.stepper }),
  };
  let made;
  try {
    made = (await session.api.figures.createFigure({ parent, figureId: p.name, figure })).figure;
  } catch (error) {
    say(message(error), true);
    made = (await session.api.figures.createFigure({ parent, figureId: p.name, figure: same })).figure;
  }
  if (made && clip) await session.api.motion.playClip({ figure: made.name, clip, loop: true, reset: true });
  await until(() => chosen !== p && chosen?.name === p.name);
  if (chosen && load > 0) await session.carry([chosen], load);
  await session.refresh();
  remember();
}

async function until(condition: () => boolean): Promise<void> {
  for (let n = 0; n < 100 && !condition(); n++) await new Promise((done) => setTimeout(done, 30));
}

// ── Address and copies ──────────────────────────────────────────────────────────────────────────────────────────────

function here(full: boolean): string {
  return write({
    world: session.world?.name.slice("worlds/".length) ?? address.world,
    figure: chosen?.name ?? "",
    load: slider.valueAsNumber || undefined,
    hide: Object.entries(shown).flatMap(([key, on]) => (on ? [] : [key])),
    camera: scene?.place,
    follow: scene?.follow ?? false,
    figures: full ? [...session.people.values()].map(cast) : [],
  });
}

let remembering = 0;
function remember(): void {
  if (session.phase.kind !== "live") return;
  clearTimeout(remembering);
  remembering = window.setTimeout(() => history.replaceState(null, "", `#${here(session.people.size <= 8)}`), 150);
}
canvas.addEventListener("pointerup", remember);
canvas.addEventListener("wheel", remember, { passive: true });
addEventListener("hashchange", () => {
  // The skip link's target is a place on the page, not a scene.
  if (location.hash && !location.hash.includes("=")) return;
  if (takeToken() !== token) return location.reload(); // someone else from now on
  address = read(location.hash);
  wantedFigure = address.figure;
  reproduced = false;
  session.show(address.world);
});

function copy(what: "python" | "cli" | "link"): void {
  const text =
    what === "link"
      ? `${location.origin}/#${here(true)}`
      : what === "cli"
        ? chosen
          ? asCommand(chosen, session.motions)
          : ""
        : asPython(location.host, [...session.people.values()], chosen, session.motions);
  const shownText = (): void => show("Copy this text", el("pre", { class: "copied", tabindex: "0" }, text));
  if (!navigator.clipboard) return shownText();
  navigator.clipboard.writeText(text).then(() => say(`Copied: ${text.split("\n")[0].slice(0, 60)}`), shownText);
}

// ── Bar, keys ───────────────────────────────────────────────────────────────────────────────────────────────────────

pauseButton.addEventListener("click", () => attempt(session.setPaused(!session.paused)));
stepButton.addEventListener("click", () => attempt(session.step()));
speed.addEventListener("change", () => attempt(session.setSpeed(Number(speed.value))));
worldChoice.addEventListener("change", () => {
  reproduced = true;
  session.show(worldChoice.value);
});

function openPanel(open: boolean): void {
  document.body.classList.toggle("closed", !open);
  panelToggle.setAttribute("aria-expanded", String(open));
}
panelToggle.addEventListener("click", () => openPanel(document.body.classList.contains("closed")));
if (innerWidth <= 900) openPanel(false);

const prefersDark = matchMedia("(prefers-color-scheme: dark)");
function theme(dark: boolean): void {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  scene?.theme(dark);
}
/** What the browser keeps for this page; nothing where it keeps nothing. */
function kept(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}
function keep(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Then it holds for this visit.
  }
}
theme(kept("sinew-theme") ? kept("sinew-theme") === "dark" : prefersDark.matches);
prefersDark.addEventListener("change", () => kept("sinew-theme") ?? theme(prefersDark.matches));
get("theme", HTMLButtonElement).addEventListener("click", () => {
  const dark = document.documentElement.dataset.theme !== "dark";
  theme(dark);
  keep("sinew-theme", dark ? "dark" : "light");
});

function show(title: string, ...content: HTMLElement[]): void {
  get("dialog-title", HTMLElement).textContent = title;
  get("dialog-body", HTMLElement).replaceChildren(...content);
  dialog.showModal();
}

const KEYS: [string, string][] = [
  ["Space", "pause or resume"],
  [".", "advance one tick (pauses first)"],
  ["S", "slow motion on or off"],
  ["[  ]", "choose the previous or next figure"],
  ["L  K", "more or less load"],
  ["P", "push the chosen figure as set in the panel"],
  ["R", "stand the chosen figure up again"],
  ["Shift R", "reset the world"],
  ["T", "follow the chosen figure"],
  ["F", "fit all figures in the view"],
  ["← → ↑ ↓", "turn the view (with the scene focused)"],
  ["+  −", "zoom in or out"],
  ["G  E  C  B", "show desired motion, joint effort, contact forces, support"],
  ["Esc", "cancel a push while dragging"],
];
get("help", HTMLButtonElement).addEventListener("click", help);
function help(): void {
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
      "wheel or two fingers to zoom. Drop a BVH file anywhere on the page to play it.",
  );
  show("Help", pointer, table);
}

// The hint is shown until it is dismissed, and then never again in this browser.
const hint = get("hint", HTMLElement);
hint.hidden = kept("sinew-hint") === "dismissed";
get("hint-close", HTMLButtonElement).addEventListener("click", () => {
  hint.hidden = true;
  keep("sinew-hint", "dismissed");
  canvas.focus({ preventScroll: true });
});

function follow(): void {
  if (!scene) return;
  if (!scene.follow && !chosen) return say("Choose a figure first.");
  scene.follow = !scene.follow;
}
followButton.addEventListener("click", follow);
get("fit", HTMLButtonElement).addEventListener("click", () => scene?.recentre());

function toggle(key: keyof Shown): void {
  document.getElementById(`show-${key}`)?.click();
}

function nudge(by: number): void {
  slider.valueAsNumber += by;
  loadChanged();
}

addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey || dialog.open) return;
  const at = e.target instanceof HTMLElement ? e.target : document.body;
  const typing = at.matches("input:not([type=checkbox]):not([type=range]), select, textarea");
  if (e.key === "Escape") scene?.release(false);
  if (typing) return;
  const people = [...session.people.values()];
  const next = (by: number): void => {
    if (people.length) choose(people[(people.indexOf(chosen as Person) + by + people.length) % people.length]);
  };
  const inScene = at === canvas;
  const done = (what: () => void): void => {
    e.preventDefault();
    what();
  };
  if (e.key === " " && !at.matches("button, summary, a, input:not([type=range])"))
    return done(() => pauseButton.click());
  if (inScene) {
    const turns: Record<string, [number, number, number]> = {
      ArrowLeft: [-0.12, 0, 1],
      ArrowRight: [0.12, 0, 1],
      ArrowUp: [0, 0.08, 1],
      ArrowDown: [0, -0.08, 1],
    };
    const turn = turns[e.key];
    if (turn)
      return done(() => {
        scene?.turn(...turn);
        remember();
      });
  }
  const actions: Record<string, () => void> = {
    ".": () => stepButton.click(),
    "[": () => next(-1),
    "]": () => next(1),
    l: () => nudge(1),
    k: () => nudge(-1),
    p: () => forChosen((p) => panel.push(p)),
    r: () => (e.shiftKey ? resetButton.click() : forChosen((p) => session.standUp(p))),
    t: follow,
    s: () => {
      speed.value = speed.value === "1" ? "0.25" : "1";
      attempt(session.setSpeed(Number(speed.value)));
    },
    "+": () => scene?.turn(0, 0, 0.88),
    "=": () => scene?.turn(0, 0, 0.88),
    "-": () => scene?.turn(0, 0, 1.14),
    f: () => scene?.recentre(),
    g: () => toggle("ghost"),
    e: () => toggle("effort"),
    c: () => toggle("forces"),
    b: () => toggle("support"),
    "?": help,
  };
  const action = actions[e.key.length === 1 ? e.key.toLowerCase() : e.key];
  if (action) done(action);
});

// ── Every picture ───────────────────────────────────────────────────────────────────────────────────────────────────

const byFrame = new WeakMap<WorldFrame, Map<number, FigureFrame>>();
function indexed(frame: WorldFrame): Map<number, FigureFrame> {
  let map = byFrame.get(frame);
  if (!map) {
    map = new Map(frame.figures.map((f) => [f.figureIndex, f]));
    byFrame.set(frame, map);
  }
  return map;
}

const tags = new Map<string, HTMLSpanElement>();
function tag(key: string, text: string, kind: string, place: { x: number; y: number } | undefined): void {
  let span = tags.get(key);
  if (!place) {
    if (span) span.hidden = true;
    return;
  }
  if (!span) {
    span = el("span");
    tags.set(key, span);
    labels.append(span);
  }
  span.hidden = false;
  if (span.textContent !== text) span.textContent = text;
  if (span.className !== kind) span.className = kind;
  span.style.transform = `translate(${place.x.toFixed(1)}px, ${place.y.toFixed(1)}px) translate(-50%, -100%)`;
}

/** Names above heads: of all figures when there are few, else of the chosen one only. */
const FEW = 6;
function label(): void {
  const people =
    session.phase.kind === "live" || session.phase.kind === "reconnecting" ? [...session.people.values()] : [];
  const present = new Set(people.map((p) => p.name));
  for (const [key, span] of tags)
    if (key !== "\u0000push" && !present.has(key)) {
      span.remove();
      tags.delete(key);
    }
  for (const p of people) {
    const visible = p === chosen || (people.length <= FEW && !pushLabel);
    tag(p.name, p.name, p === chosen ? "chosen" : "", visible ? scene?.label(p) : undefined);
  }
  tag("\u0000push", pushLabel?.text ?? "", "impulse", pushLabel && { x: pushLabel.x, y: pushLabel.y - 16 });
}

/** Time that a picture takes, ms, smoothed: the page's own part, and with the renderer. Tests read them. */
let scripted = 0;
let cost = 0;
let wordsAt = 0;
let plotsAt = 0;
let reframed = 0;
/** A picture that took longer than this (s) is drawn in software: then half of the time is left to others. */
const SLOW_S = 0.04;
let notBefore = 0;
function picture(): void {
  requestAnimationFrame(picture);
  const t = now();
  if (t < notBefore) return;
  const pair = session.playhead.at(t, session.paused ? 1 : (session.world?.speed ?? 1));
  scene?.prepare(
    pair && { before: indexed(pair.before), after: indexed(pair.after), share: pair.share },
    shown,
    chosen,
  );
  if (pair) obstacles.place(pair.before, pair.after, pair.share);
  if (pair && reframed !== session.people.size) {
    reframed = session.people.size;
    scene?.frameAllOnce();
  }
  label();
  if (t - plotsAt > 0.066) {
    plotsAt = t;
    const words = t - wordsAt > 0.25;
    if (words) wordsAt = t;
    panel.update(t, words);
    if (words) readLoad();
    captions.update(session.people.values(), lastFrame?.timeS ?? 0, t);
    fallen.update(session.people.values(), (p) => session.says(p, "FALLEN"), chosen);
    const time = `${(lastFrame?.timeS ?? 0).toFixed(1)} s`;
    const clock = get("clock", HTMLOutputElement);
    if (clock.textContent !== time) clock.textContent = time;
  }
  const script = (now() - t) * 1000;
  scene?.draw3d();
  const took = now() - t;
  if (took > SLOW_S) notBefore = t + 2 * Math.min(took, 0.5);
  scripted += 0.05 * (script - scripted);
  cost += 0.05 * ((now() - t) * 1000 - cost);
  document.body.dataset.script = scripted.toFixed(2);
  document.body.dataset.drawn = String(scene?.drawn ?? 0);
  document.body.dataset.cost = cost.toFixed(2);
}

bar.dataset.ready = "true";
showPhase(session.phase);
session.show(address.world);
requestAnimationFrame(picture);
