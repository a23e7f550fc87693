// The viewer: puts session, scene and panel together.
import "./viewer.css";
import { Beside } from "./beside.js";
import { cannotBranch, cannotRewind, fork } from "./branches.js";
import { Captions } from "./captions.js";
import { connect, message, Sinew } from "./client.js";
import { Compare } from "./compare.js";
import { Fallen } from "./fallen.js";
import { createFigure, createWorld, fresh, makeAnew, until } from "./figures.js";
import type { WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import { helpText, listen } from "./keys.js";
import { Labels } from "./labels.js";
import { Load } from "./load.js";
import { indexed, PastPeople, timeOf, type Moment } from "./moment.js";
import type { Person } from "./model.js";
import { Obstacles } from "./obstacles.js";
import { el, Panel, type Anew } from "./panel.js";
import { keep, kept } from "./preferences.js";
import { Scene, type Push, type Shown } from "./scene.js";
import { Session, type Phase } from "./session.js";
import { asCommand, asPython, cast, read, write, type Address } from "./share.js";
import { REWIND_S, Timeline } from "./timeline.js";
import { takeToken } from "./token.js";

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
const [state, dialog] = [get("state", HTMLElement), get("dialog", HTMLDialogElement)];
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

/** One change after the other, of the present: each sees what the one before it has brought about. */
let turn: Promise<unknown> = Promise.resolve();
function inTurn(what: () => Promise<unknown>): void {
  timeline.live();
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
  (event) => {
    // Who looks at the past is not told of the present.
    if (timeline.shown === undefined) captions.event(event, now());
  },
  (frame) => {
    lastFrame = frame;
    if (session.world) void obstacles.follow(session.api, session.world.name, frame);
  },
);

/** Carries out a push that was drawn. */
async function pushed(of: Session, { person, segment, local, impulse }: Push): Promise<void> {
  await of.api.perturbations.applyPerturbations({
    world: of.world?.name ?? "",
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
  });
  say(`Pushed ${person.name}: ${impulse.length().toFixed(0)} N·s`);
}

const labels = new Labels(get("labels", HTMLElement));
let scene: Scene | undefined;
try {
  scene = new Scene(canvas, {
    choose: (p) => choose(p && session.person(p.name)),
    pushing: (push, x, y) =>
      (labels.push = push ? { text: `${push.impulse.length().toFixed(0)} N·s`, x, y } : undefined),
    push: (push) => attempt(pushed(session, push)),
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

const load = new Load(get("load-slider", HTMLInputElement), get("load-value", HTMLOutputElement), session, {
  change: () => timeline.live(),
  done: remember,
  failed: (error) => say(message(error), true),
});

// ── The past, and other futures ─────────────────────────────────────────────────────────────────────────────────────

const timeline = new Timeline(
  get("timeline", HTMLElement),
  get("time", HTMLInputElement),
  get("marks", HTMLElement),
  get("moment", HTMLOutputElement),
  () => {
    document.body.dataset.time = timeline.shown === undefined ? "live" : "past";
    for (const s of [scene, beside.scene]) if (s) s.pushable = timeline.shown === undefined;
  },
);
const pastPeople = new PastPeople(session);

const beside = new Beside(
  session.api,
  {
    pane: get("beside", HTMLElement),
    canvas: get("beside-view", HTMLCanvasElement),
    labels: get("beside-labels", HTMLElement),
    slider: get("beside-load", HTMLInputElement),
    output: get("beside-load-value", HTMLOutputElement),
    pause: get("beside-pause", HTMLButtonElement),
    push: get("beside-push", HTMLButtonElement),
  },
  {
    say,
    choose: (name) => choose(session.person(name)),
    push: (of) => {
      const p = of.person(chosen?.name ?? "") ?? [...of.people.values()][0];
      if (p) attempt(panel.push(p, of));
    },
    drawn: (of, push) => attempt(pushed(of, push)),
    gone: () => compare.leave(),
  },
);
const compare = new Compare(
  session,
  beside,
  {
    strip: get("compare", HTMLElement),
    since: get("since", HTMLOutputElement),
    lag: get("lag", HTMLElement),
    catchUp: get("catch-up", HTMLButtonElement),
    swap: get("swap", HTMLButtonElement),
    done: get("compare-done", HTMLButtonElement),
    mainHeader: get("main-header", HTMLElement),
    mainTitle: get("main-title", HTMLElement),
    besideTitle: get("beside-title", HTMLElement),
  },
  {
    say,
    ask: (title, ...content) => {
      show(title, ...content);
      return () => dialog.close();
    },
    show: (world) => {
      // View and load stay as they are.
      reproduced = true;
      session.show(world);
    },
    changed: () => {
      // On a small screen two pictures need all of it.
      if (compare.pair && innerWidth <= 900) openPanel(false);
      remember();
    },
  },
);
/** The picture whose camera was moved last: the other one follows. */
let besideLeads = false;
for (const [element, leads] of [
  [canvas, false],
  [get("beside-view", HTMLCanvasElement), true],
] as const)
  for (const kind of ["pointerdown", "wheel"])
    element.addEventListener(kind, () => (besideLeads = leads), { capture: true, passive: true });

/** Puts the world back by some seconds, counted from the moment that is shown. */
async function rewind(): Promise<void> {
  const { past, world } = session;
  if (!past || !world || past.oldest < 0) return say("Nothing of the past is held here.");
  const refused = cannotRewind(await session.roles());
  if (refused) return say(refused, true);
  const tick = Math.max(past.oldest, Math.round(timeline.tick - REWIND_S * past.rateHz));
  await session.api.history.seekWorld({ name: world.name, tick: BigInt(tick) });
  timeline.live();
  await session.refresh();
  say(`The world was rewound to ${(tick / past.rateHz).toFixed(1)} s`);
}

/** Makes a new world of the moment that is shown, and shows both. */
async function branch(): Promise<void> {
  const { past, world } = session;
  if (!past || !world) return;
  const refused = cannotBranch(await session.roles());
  if (refused) return say(refused, true);
  const of = world.name.slice("worlds/".length);
  const { worlds } = await session.api.worlds.listWorlds({ pageSize: 1000 });
  const name = fresh(
    `${of}-branch`,
    worlds.map((w) => w.name.slice("worlds/".length)),
  );
  const pair = await fork(session, timeline.shown === undefined ? undefined : timeline.tick, name);
  compare.leave();
  timeline.live();
  compare.begin(pair);
}

/** One at a time: a second press must not do it twice. */
let travelling = false;
function travel(what: () => Promise<void>): void {
  if (travelling) return;
  travelling = true;
  attempt(what().finally(() => (travelling = false)));
}
get("rewind", HTMLButtonElement).addEventListener("click", () => travel(rewind));
get("branch", HTMLButtonElement).addEventListener("click", () => travel(branch));
get("to-live", HTMLButtonElement).addEventListener("click", () => {
  timeline.live();
  get("time", HTMLInputElement).focus();
});

// ── What is chosen ──────────────────────────────────────────────────────────────────────────────────────────────────

function choose(person: Person | undefined): void {
  chosen = person;
  wantedFigure = person?.name ?? "";
  panel.lists(person);
  remember();
}

function roster(): void {
  populated = undefined;
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
  timeline.of(session.past);
  if (compare.pair && name && name !== compare.pair.branch && name !== compare.pair.original) compare.leave();
  worldChoice.value = name;
  pauseButton.textContent = session.paused ? "Resume" : "Pause";
  pauseButton.setAttribute("aria-pressed", String(session.paused));
  const s = String(session.world?.speed ?? 1);
  if ([...speed.options].some((o) => o.value === s)) speed.value = s;
  remember();
}

// ── States ──────────────────────────────────────────────────────────────────────────────────────────────────────────

function showPhase(phase: Phase): void {
  if (phase.kind === "error") {
    lastFrame = undefined;
    compare.leave();
  }
  timeline.of(session.past);
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
  load.enable(phase.kind === "live");
  if (phase.kind === "live") reproduce();
}

async function makeWorld(from?: Address): Promise<void> {
  const made = await createWorld(session.api, from);
  if (made) session.show(made);
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
  if (address.load !== undefined && address.load !== load.mass && !address.beside) load.set(address.load);
  else load.read();
}

// ── Reset ───────────────────────────────────────────────────────────────────────────────────────────────────────────

/** Every figure back at its start, all clips from their beginning, no loads, no pushes. */
async function resetWorld(): Promise<void> {
  await load.none();
  const failed = await session.reset();
  load.gone();
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
  if (!session.world) return makeWorld();
  const taken = [...session.people.values()].map((p) => p.name);
  wantedFigure = fresh("figure", taken);
  await createFigure(session, wantedFigure, chosen?.body.name ?? "bodies/adult-man");
  await until(() => chosen?.name === wantedFigure);
  await session.refresh();
}

/** Body and stepper are fixed at creation: the figure is made anew in its place, doing the same. */
async function rebuild(p: Person, change: Anew): Promise<void> {
  rebuilding = true;
  try {
    const load = p.loadKg();
    wantedFigure = p.name;
    await makeAnew(session, p, change, say);
    await until(() => chosen !== p && chosen?.name === p.name);
    if (chosen && load > 0) await session.carry([chosen], load);
    await session.refresh();
    remember();
  } finally {
    rebuilding = false;
  }
}

// ── Address and copies ──────────────────────────────────────────────────────────────────────────────────────────────

function here(full: boolean): string {
  return write({
    world: compare.pair?.branch ?? session.world?.name.slice("worlds/".length) ?? address.world,
    figure: chosen?.name ?? "",
    load: load.mass || undefined,
    hide: Object.entries(shown).flatMap(([key, on]) => (on ? [] : [key])),
    camera: scene?.place,
    follow: scene?.follow ?? false,
    figures: full ? [...session.people.values()].map(cast) : [],
    beside: compare.pair?.original ?? "",
    since: compare.pair?.since ?? 0,
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
  start();
});

/** Shows what the address says. */
function start(): void {
  const { world, beside: original, since } = address;
  compare.leave();
  if (world && original && world !== original) compare.begin({ branch: world, original, since });
  else session.show(world);
}

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
stepButton.addEventListener("click", () => {
  timeline.live();
  attempt(session.step());
});
speed.addEventListener("change", () => attempt(session.setSpeed(Number(speed.value))));
worldChoice.addEventListener("change", () => {
  reproduced = true;
  compare.leave();
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
  beside.theme(dark);
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

function help(): void {
  show("Help", ...helpText());
}
get("help", HTMLButtonElement).addEventListener("click", help);

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

/** Chooses the figure that is so many places farther on. */
function next(by: number): void {
  const people = [...session.people.values()];
  if (people.length) choose(people[(people.indexOf(chosen as Person) + by + people.length) % people.length]);
}

/** The same keys move whichever view has the focus. */
function zoom(factor: number): void {
  besideLeads = false;
  scene?.turn(0, 0, factor);
}

listen({
  blocked: () => dialog.open,
  pause: () => pauseButton.click(),
  cancel: () => {
    scene?.release(false);
    beside.scene?.release(false);
    timeline.live();
  },
  turn: (...by) => {
    besideLeads = false;
    scene?.turn(...by);
    remember();
  },
  keys: {
    ".": () => stepButton.click(),
    "[": () => next(-1),
    "]": () => next(1),
    l: () => load.set(load.mass + 1),
    k: () => load.set(load.mass - 1),
    p: () => forChosen((p) => panel.push(p)),
    r: () => travel(rewind),
    n: () => travel(branch),
    u: () => forChosen((p) => session.standUp(p)),
    "shift+r": () => resetButton.click(),
    t: follow,
    s: () => {
      speed.value = speed.value === "1" ? "0.25" : "1";
      attempt(session.setSpeed(Number(speed.value)));
    },
    "+": () => zoom(0.88),
    "=": () => zoom(0.88),
    "-": () => zoom(1.14),
    f: () => scene?.recentre(),
    g: () => toggle("ghost"),
    e: () => toggle("effort"),
    c: () => toggle("forces"),
    b: () => toggle("support"),
    "?": help,
  },
});

// ── Every picture ───────────────────────────────────────────────────────────────────────────────────────────────────

/** Time that a picture takes, ms, smoothed: the page's own part, and with the renderer. Tests read them. */
let scripted = 0;
let cost = 0;
let wordsAt = 0;
let plotsAt = 0;
let reframed = 0;
/** A picture that took longer than this (s) is drawn in software: then half of the time is left to others. */
const SLOW_S = 0.04;
let notBefore = 0;
/** Whom the scene has been made for. */
let populated: ReadonlyMap<number, Person> | undefined;

/** The present of the world, s and frames. */
function present(t: number): Moment | undefined {
  const pair = session.playhead.at(t, session.paused ? 0 : (session.world?.speed ?? 1));
  return pair && { ...pair, time: timeOf(pair), people: session.people, exact: true };
}

/** What both panes show: the present, a moment of the past, or the same time of two worlds. */
function moments(t: number): [Moment | undefined, Moment | undefined] {
  const main = present(t);
  const other = beside.open ? beside.live(t) : undefined;
  const name = chosen?.name ?? "";
  const common = compare.time(main, other);
  const mainTime = timeline.shown ?? (compare.pair && !compare.mainIsBranch ? common : undefined);
  const otherTime = timeline.shown ?? (compare.mainIsBranch ? common : undefined);
  return [
    mainTime === undefined ? main : pastPeople.at(mainTime, name),
    otherTime === undefined ? other : beside.past(otherTime, name),
  ];
}

function words(moment: Moment | undefined, t: number): void {
  const shows = timeline.shown;
  load.read();
  if (beside.open) beside.read();
  timeline.update();
  compare.update(moment?.time);
  const trouble = shows === undefined || moment?.exact ? "" : session.past?.trouble;
  if (trouble) captions.say(trouble, t, true);
}

function picture(): void {
  requestAnimationFrame(picture);
  const t = now();
  if (t < notBefore) return;
  const [moment, other] = moments(t);
  const people = moment?.people ?? session.people;
  if (populated !== people) {
    scene?.populate(people.values());
    populated = people;
  }
  const seen = chosen && (people.get(chosen.index)?.name === chosen.name ? people.get(chosen.index) : undefined);
  panel.view(seen);
  scene?.prepare(
    moment && { before: indexed(moment.before), after: indexed(moment.after), share: moment.share },
    shown,
    seen,
  );
  if (moment) obstacles.place(moment.before, moment.after, moment.share);
  if (moment && reframed !== session.people.size) {
    reframed = session.people.size;
    scene?.frameAllOnce();
  }
  const drawn = ["live", "reconnecting"].includes(session.phase.kind);
  labels.update(drawn ? people.values() : [], chosen?.name, scene);
  if (t - plotsAt > 0.066) {
    plotsAt = t;
    const due = t - wordsAt > 0.25;
    if (due) wordsAt = t;
    panel.update(t, due);
    if (due) words(moment, t);
    const at = moment?.time ?? 0;
    captions.update(people.values(), timeline.shown === undefined ? (lastFrame?.timeS ?? 0) : at, t);
    // Only the present can be helped.
    fallen.update(timeline.shown === undefined ? people.values() : [], (p) => session.says(p, "FALLEN"), chosen);
    const time = `${(people === session.people ? (lastFrame?.timeS ?? 0) : at).toFixed(1)} s`;
    const clock = get("clock", HTMLOutputElement);
    if (clock.textContent !== time) clock.textContent = time;
  }
  const script = (now() - t) * 1000;
  scene?.draw3d();
  if (beside.open && scene) beside.draw(other, shown, chosen?.name, scene, besideLeads);
  const took = now() - t;
  if (took > SLOW_S) notBefore = t + 2 * Math.min(took, 0.5);
  scripted += 0.05 * (script - scripted);
  cost += 0.05 * ((now() - t) * 1000 - cost);
  document.body.dataset.script = scripted.toFixed(2);
  document.body.dataset.drawn = String(scene?.drawn ?? 0);
  document.body.dataset.cost = cost.toFixed(2);
  document.body.dataset.shown = `${moment?.time.toFixed(4)} ${moment?.exact}`;
  document.body.dataset.beside = beside.open ? `${other?.time.toFixed(2)} ${other?.exact}` : "";
}

bar.dataset.ready = "true";
showPhase(session.phase);
start();
requestAnimationFrame(picture);
