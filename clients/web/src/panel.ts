// The controls beside the scene: everything that the pointer does in the scene can be done here, too.
import type { MessageInitShape } from "@bufbuild/protobuf";
import { Sex, type BodyProfileSchema } from "./gen/sinew/v1/body_pb.js";
import { Controller, PaperPreset, Stepper, type FigureSchema } from "./gen/sinew/v1/figure_pb.js";
import { Follow, type Forecast } from "./gen/sinew/v1/motion_pb.js";
import type { RetargetReport } from "./gen/sinew/v1/types_pb.js";
import type { Person } from "./model.js";
import { busiest, inPlace, Plot, PLOTS } from "./plots.js";
import type { Shown } from "./scene.js";
import type { Session } from "./session.js";
import {
  clamp,
  dof as dofWords,
  forecast as forecastText,
  following,
  found,
  kilograms,
  margin,
  state,
  warnings,
} from "./words.js";

type Child = Node | string;

/** An element with attributes and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  e.append(...children);
  return e;
}

const button = (text: string, attributes: Record<string, string> = {}): HTMLButtonElement =>
  el("button", { type: "button", ...attributes }, text);
const section = (title: string, ...children: Child[]): HTMLElement =>
  el("section", {}, el("h2", {}, title), ...children);

let serial = 0;
function row(label: string, control: HTMLElement, output?: HTMLOutputElement): HTMLElement {
  control.id ||= `control-${++serial}`;
  return el(
    "div",
    { class: output ? "row three" : "row" },
    el("label", { for: control.id }, label),
    control,
    ...(output ? [output] : []),
  );
}

function fill(select: HTMLSelectElement, values: { value: string; text: string }[], chosen: string): void {
  const key = JSON.stringify(values);
  if (select.dataset.key !== key) {
    select.dataset.key = key;
    select.replaceChildren(...values.map((v) => el("option", { value: v.value }, v.text)));
  }
  if (document.activeElement !== select) select.value = chosen;
}

const DIRECTIONS: [string, string, [number, number]][] = [
  ["front", "from the front", [-1, 0]],
  ["back", "from behind", [1, 0]],
  ["left", "from the left", [0, -1]],
  ["right", "from the right", [0, 1]],
];
/** `adult-man` → `adult man`; `female-70y-1600mm-62000g` → `woman, 70 y, 1.60 m, 62 kg`. */
function plain(name: string): string {
  const [, sex, age, height, mass] = /^(male|female)-([\d.]+)y-(\d+)mm-(\d+)g$/.exec(name) ?? [];
  if (!sex) return name.replaceAll("-", " ");
  const person = sex === "male" ? "man" : "woman";
  return `${person}, ${age} y, ${(Number(height) / 1000).toFixed(2)} m, ${(Number(mass) / 1000).toFixed(0)} kg`;
}

/** What is fixed when a figure is made, and changes by making it anew. */
export interface Anew {
  body?: string;
  profile?: MessageInitShape<typeof BodyProfileSchema>;
  stepper?: Stepper;
}

const PRESETS: [PaperPreset, string][] = [
  [PaperPreset.PAPER_PRESET_SAFEGUARDED, "with safeguards"],
  [PaperPreset.PAPER_PRESET_2000, "as published in 2000"],
];
/** Seconds of fatigue per second. */
const FATIGUE: [number, string][] = [
  [0, "off"],
  [1, "real time"],
  [10, "10 times faster"],
  [60, "60 times faster"],
];

/** Rows of the summary: the state of the chosen figure. Each is one line high, whatever it says. */
const FACTS = [
  ["state", "State"],
  ["margin", "Balance margin"],
  ["load", "Load"],
  ["error", "Tracking error"],
  ["effort", "Highest effort"],
] as const;
type Fact = (typeof FACTS)[number][0];

/** What the panel asks of the page. */
/** Choices for a figure that is losing its motion. */
const FOLLOWS: [Follow, string][] = [
  [Follow.STRICT, "it falls"],
  [Follow.ASSISTED, "help, at most 30 % of its weight"],
  [Follow.ALWAYS, "help, at most its weight"],
];

export interface Wishes {
  choose: (p: Person) => void;
  say: (text: string, grave?: boolean) => void;
  forChosen: (what: (p: Person) => Promise<void>) => void;
  play: (clip: string) => void;
  rebuild: (change: Anew) => void;
  add: () => void;
  open: (file: File) => void;
  copy: (what: "python" | "cli" | "link") => void;
  /** What is shown, or what the address says of a figure, has changed. */
  shown: () => void;
}

export class Panel {
  private readonly figures = el("div", { id: "figures", role: "group", "aria-label": "Figures" });
  private readonly facts = Object.fromEntries(FACTS.map(([key]) => [key, el("dd", { "data-fact": key })])) as Record<
    Fact,
    HTMLElement
  >;
  private readonly meter = el("i");
  private readonly summary = el(
    "div",
    { id: "summary" },
    el("dl", {}, ...FACTS.flatMap(([key, name]) => [el("dt", {}, name), this.facts[key]])),
    el("span", { class: "meter", "aria-hidden": "true" }, this.meter),
  );
  private readonly clip = el("select", { id: "clip" });
  private readonly body = el("select", { id: "body" });
  private readonly controller = el("select", { id: "controller" });
  private readonly preset = el("select", { id: "preset" });
  private readonly presetRow = row("Variant", this.preset);
  private readonly stepper = el("select", { id: "stepper" });
  private readonly fatigue = el("select", { id: "fatigue" });
  private readonly sex = el("select", { id: "sex" });
  private readonly age = el("input", { id: "age", type: "number", min: "6", max: "90", step: "1", value: "70" });
  private readonly height = el("input", {
    id: "height",
    type: "number",
    min: "0.8",
    max: "2.1",
    step: "0.01",
    placeholder: "average",
  });
  private readonly mass = el("input", {
    id: "mass",
    type: "number",
    min: "12",
    max: "180",
    step: "0.5",
    placeholder: "average",
  });
  private readonly strength = el("input", {
    id: "strength",
    type: "range",
    min: "0.2",
    max: "2",
    step: "0.05",
    value: "1",
  });
  private readonly strengthOut = el("output", { for: "strength" }, "100 %");
  private readonly assist = el("input", { id: "assist", type: "range", min: "0", max: "1", step: "0.05", value: "0" });
  private readonly assistOut = el("output", { for: "assist" }, "0 %");
  private readonly follow = el("select", { id: "help-choice" });
  private readonly impulse = el("input", {
    id: "impulse",
    type: "range",
    min: "5",
    max: "150",
    step: "5",
    value: "30",
  });
  private readonly impulseOut = el("output", { for: "impulse" }, "30 N·s");
  private readonly direction = el("select", { id: "direction" });
  private readonly target = el("select", { id: "target" });
  private readonly file = el("input", {
    type: "file",
    accept: ".bvh",
    class: "hidden",
    tabindex: "-1",
    "aria-label": "BVH file",
  });
  private readonly report = el("div", { id: "report", "aria-live": "polite" });
  private readonly plots = Array.from({ length: PLOTS }, () => new Plot());
  private readonly dofs = el("select", { id: "plotted" });
  /** Buttons that need a chosen figure. */
  private readonly ofChosen: HTMLButtonElement[];
  private busiest: number[] = [];
  private busiestAt = 0;

  constructor(
    root: HTMLElement,
    private readonly session: Session,
    private readonly wishes: Wishes,
    private readonly shown: Shown,
  ) {
    fill(
      this.direction,
      DIRECTIONS.map(([value, text]) => ({ value, text })),
      "front",
    );
    fill(
      this.target,
      ["chest", "pelvis", "head", "r_hand", "l_foot"].map((value) => ({ value, text: dofWords(value) })),
      "chest",
    );
    const open = button("Open BVH…", { id: "open" });
    open.addEventListener("click", () => this.file.click());
    this.file.addEventListener("change", () => {
      const [file] = this.file.files ?? [];
      if (file) this.wishes.open(file);
      this.file.value = "";
    });
    const push = button("Push", { id: "push", class: "main" });
    push.addEventListener("click", () => this.wishes.forChosen((p) => this.push(p)));
    const stand = button("Stand up", {
      id: "stand",
      title: "Puts the figure back on its feet and starts its clip again (U)",
    });
    stand.addEventListener("click", () => this.wishes.forChosen((p) => this.session.standUp(p)));
    const add = button("Add figure", { id: "add" });
    add.addEventListener("click", () => this.wishes.add());
    const remove = button("Remove", { id: "remove" });
    remove.addEventListener("click", () =>
      this.wishes.forChosen(async (p) => void (await this.session.api.figures.deleteFigure({ name: p.figure.name }))),
    );
    this.clip.addEventListener("change", () => this.wishes.play(this.clip.value));
    this.body.addEventListener("change", () => this.wishes.rebuild({ body: this.body.value }));
    fill(
      this.sex,
      [
        { value: String(Sex.FEMALE), text: "woman" },
        { value: String(Sex.MALE), text: "man" },
      ],
      String(Sex.FEMALE),
    );
    const make = button("Apply", { id: "make-body" });
    make.addEventListener("click", () => {
      const asked = (input: HTMLInputElement): number =>
        Number.isFinite(input.valueAsNumber) ? input.valueAsNumber : 0;
      this.wishes.rebuild({
        profile: {
          sex: Number(this.sex.value),
          ageYears: asked(this.age),
          heightM: asked(this.height),
          massKg: asked(this.mass),
        },
      });
    });
    this.presetRow.hidden = true;
    this.changes(this.preset, "paper", (value) => ({ paper: { preset: value } }));
    this.changes(this.fatigue, "fatigue_time_scale", (value) => ({ fatigueTimeScale: value }));
    this.stepper.addEventListener("change", () => this.wishes.rebuild({ stepper: Number(this.stepper.value) }));
    this.changes(this.controller, "controller", (value) => ({ controller: value }));
    this.strength.addEventListener(
      "input",
      () => (this.strengthOut.textContent = `${Math.round(Number(this.strength.value) * 100)} %`),
    );
    this.changes(this.strength, "strength", (value, p) => {
      const { dofs, percentile, effort } = p.figure.strength ?? {};
      return { strength: { all: value, dofs, percentile, effort } };
    });
    this.assist.addEventListener(
      "input",
      () => (this.assistOut.textContent = `${Math.round(Number(this.assist.value) * 100)} %`),
    );
    this.changes(this.assist, "assist", (value) => ({ assist: value }));
    this.changes(this.follow, "follow", (value) => ({ follow: value }));
    this.impulse.addEventListener("input", () => (this.impulseOut.textContent = `${this.impulse.value} N·s`));
    this.ofChosen = [push, stand, remove, make];
    const copies = (["python", "cli", "link"] as const).map((what) => {
      const b = button({ python: "Copy as Python", cli: "Copy command line", link: "Copy link" }[what], {
        id: `copy-${what}`,
      });
      b.addEventListener("click", () => this.wishes.copy(what));
      return b;
    });
    const checks = (
      [
        ["ghost", "Desired motion"],
        ["effort", "Joint effort"],
        ["forces", "Contact forces"],
        ["support", "Support and balance"],
      ] as const
    ).map(([key, text]) => {
      const box = el("input", { type: "checkbox", id: `show-${key}` });
      box.checked = this.shown[key];
      box.addEventListener("change", () => {
        this.shown[key] = box.checked;
        this.wishes.shown();
      });
      return el("label", {}, box, text);
    });
    root.append(
      section("Figures", this.figures, this.summary, el("div", { class: "buttons" }, stand, add, remove)),
      section("Motion", row("Clip", this.clip), el("div", { class: "buttons" }, open, this.file), this.report),
      section(
        "Joint torques",
        row("Joint", this.dofs),
        el(
          "ul",
          { class: "key", "aria-label": "Curves" },
          ...[
            ["torque", "torque"],
            ["range", "available range"],
            ["reached", "at its limit"],
          ].map(([c, text]) => el("li", {}, el("i", { class: c }), text)),
        ),
        ...this.plots.map((p) => p.figure),
      ),
      section(
        "Push",
        row("Impulse", this.impulse, this.impulseOut),
        row("Direction", this.direction),
        row("Body part", this.target),
        el("div", { class: "buttons" }, push),
      ),
      section(
        "Body and control",
        row("Body", this.body),
        el(
          "details",
          {},
          el("summary", {}, "Custom body"),
          row("Sex", this.sex),
          row("Age (years)", this.age),
          row("Height (m)", this.height),
          row("Mass (kg)", this.mass),
          el("div", { class: "buttons" }, make),
        ),
        row("Strength", this.strength, this.strengthOut),
        row("Fatigue", this.fatigue),
        row("Controller", this.controller),
        this.presetRow,
        row("Stepper", this.stepper),
        row("Assist", this.assist, this.assistOut),
        row("If it loses its motion", this.follow),
      ),
      section(
        "Display",
        el("div", { class: "checks" }, ...checks),
        el(
          "ul",
          { class: "key", "aria-label": "Legend" },
          ...[
            ["com", "centre of mass"],
            ["zmp", "zero-moment point (ZMP)"],
            ["area", "support polygon"],
            ["force", "contact force"],
            ["limit", "at the torque limit"],
            ["help", "help: force, and moment with two heads"],
          ].map(([c, text]) => el("li", {}, el("i", { class: c }), text)),
        ),
      ),
      section("Export", el("div", { class: "buttons" }, ...copies)),
    );
  }

  /** The chosen figure as it is at the moment that is shown. */
  private seen: Person | undefined;

  /** Shows this figure's state and torques: the chosen one, as it was. */
  view(person: Person | undefined): void {
    if (person === this.seen) return;
    this.seen = person;
    this.busiestAt = 0;
  }

  /** Pushes a figure as the controls say. */
  push(p: Person, of = this.session): Promise<void> {
    if (!of.world) return Promise.resolve();
    const size = Number(this.impulse.value);
    const [x, y] = DIRECTIONS.find(([d]) => d === this.direction.value)?.[2] ?? [1, 0];
    const yaw = p.figure.placement?.yawRad ?? 0;
    const impulse = {
      x: size * (x * Math.cos(yaw) - y * Math.sin(yaw)),
      y: size * (x * Math.sin(yaw) + y * Math.cos(yaw)),
      z: 0,
    };
    return of.api.perturbations
      .applyPerturbations({
        world: of.world.name,
        perturbations: [
          {
            figureId: p.name,
            kind: {
              case: "impulse",
              value: { segment: this.target.value, impulseNewtonSeconds: impulse, durationS: 0.1 },
            },
          },
        ],
      })
      .then(() => this.wishes.say(`Pushed ${p.name} ${this.direction.selectedOptions[0]?.text ?? ""}: ${size} N·s`));
  }

  /** Lets a control change one setting of the chosen figure, to the number that it shows when it is set. */
  private changes(
    control: HTMLSelectElement | HTMLInputElement,
    path: string,
    settings: (value: number, p: Person) => MessageInitShape<typeof FigureSchema>,
  ): void {
    control.addEventListener("change", () => {
      const value = Number(control.value);
      this.wishes.forChosen((p) => this.change(p, settings(value, p), path));
    });
  }

  private async change(p: Person, change: MessageInitShape<typeof FigureSchema>, path: string): Promise<void> {
    const { figure } = await this.session.api.figures.updateFigure({
      figure: { name: p.figure.name, ...change },
      updateMask: { paths: [path] },
    });
    if (figure) p.figure = figure;
    this.lists(p);
    this.wishes.shown();
  }

  /** Brings what can be chosen up to date. */
  lists(person: Person | undefined): void {
    const people = [...this.session.people.values()];
    const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.figure : undefined;
    this.figures.replaceChildren(
      ...people.map((p) => {
        const b = button(p.name, { "aria-pressed": String(p === person), "data-figure": p.name });
        b.addEventListener("click", () => this.wishes.choose(p));
        return b;
      }),
    );
    if (focused)
      [...this.figures.children]
        .find((b): b is HTMLElement => b instanceof HTMLElement && b.dataset.figure === focused)
        ?.focus();
    const same = (v: string): { value: string; text: string } => ({ value: v, text: plain(v) });
    const clip = person?.clip.slice("clips/".length) ?? "";
    fill(
      this.clip,
      [
        ...(clip ? [] : [{ value: "", text: person?.figure.status?.driverId ? "driven live" : "none (holds still)" }]),
        ...this.session.clips.map(same),
      ],
      clip,
    );
    fill(
      this.body,
      [...new Set([...this.session.bodies, ...(person ? [person.body.name.slice("bodies/".length)] : [])])].map(same),
      person?.body.name.slice("bodies/".length) ?? "",
    );
    const can = (name: string): boolean =>
      !this.session.capabilities.length || this.session.capabilities.includes(name);
    const controllers: [Controller, string, string][] = [
      [Controller.MODERN, "modern", "CONTROLLER_MODERN"],
      [Controller.PAPER, "paper 2000", "CONTROLLER_PAPER"],
      [Controller.MOTORS, "motors only", "CONTROLLER_MOTORS"],
    ];
    fill(
      this.controller,
      controllers.filter((c) => can(c[2])).map(([v, text]) => ({ value: String(v), text })),
      String(person?.figure.controller || Controller.MODERN),
    );
    fill(
      this.preset,
      PRESETS.map(([v, text]) => ({ value: String(v), text })),
      String(person?.figure.paper?.preset || PaperPreset.PAPER_PRESET_SAFEGUARDED),
    );
    this.presetRow.hidden = person?.figure.controller !== Controller.PAPER;
    const tires = person?.figure.fatigueTimeScale ?? 0;
    fill(
      this.fatigue,
      [...FATIGUE, ...(FATIGUE.some(([v]) => v === tires) ? [] : [[tires, `${tires} times faster`] as const])].map(
        ([v, text]) => ({ value: String(v), text }),
      ),
      String(tires),
    );
    const steppers: [Stepper, string, string][] = [
      [Stepper.TORQUE, "torque", "STEPPER_TORQUE"],
      [Stepper.KINEMATIC, "kinematic", "STEPPER_KINEMATIC"],
      [Stepper.STAGED, "staged", "STEPPER_STAGED"],
    ];
    fill(
      this.stepper,
      steppers.filter((c) => can(c[2])).map(([v, text]) => ({ value: String(v), text })),
      String(person?.figure.stepper || Stepper.TORQUE),
    );
    const strength = person?.figure.strength?.all || 1;
    if (document.activeElement !== this.strength) this.strength.value = String(strength);
    this.strengthOut.textContent = `${Math.round(strength * 100)} %`;
    const assist = person?.figure.assist ?? 0;
    if (document.activeElement !== this.assist) this.assist.value = String(assist);
    this.assistOut.textContent = `${Math.round(assist * 100)} %`;
    fill(
      this.follow,
      FOLLOWS.map(([v, text]) => ({ value: String(v), text })),
      String(person?.figure.follow === Follow.REHEARSED ? Follow.STRICT : person?.figure.follow || Follow.STRICT),
    );
    const dofs = person?.body.dofs ?? [];
    fill(
      this.dofs,
      [{ value: "", text: "highest effort" }, ...dofs.map((d) => ({ value: d.name, text: dofWords(d.name) }))],
      this.dofs.value,
    );
    for (const c of [
      this.clip,
      this.body,
      this.controller,
      this.preset,
      this.stepper,
      this.fatigue,
      this.sex,
      this.age,
      this.height,
      this.mass,
      ...this.ofChosen,
      this.strength,
      this.assist,
      this.follow,
      this.dofs,
    ])
      c.disabled = !person;
    this.busiestAt = 0;
  }

  /** The state of a figure, row by row. */
  private describe(p: Person): Record<Fact, string> {
    const has = (flag: string): boolean => this.session.says(p, flag);
    const hardest = p.hardest();
    const load = p.loadKg();
    const rms = ((p.frame?.status?.trackingJointRmsRad ?? 0) * 180) / Math.PI;
    return {
      state: state(has) + following(p.frame?.status),
      margin: has("FALLEN") || has("FLIGHT") ? "–" : margin(p.frame?.balance?.marginM),
      load: load > 0 ? kilograms(load) : "none",
      error: `${rms.toFixed(1)}° rms`,
      effort: `${Math.round(100 * p.used[hardest])} % ${dofWords(p.body.dofs[hardest]?.name ?? "")}`,
    };
  }

  /** Words and plots, a few times a second. */
  update(now: number, words: boolean): void {
    const p = this.seen;
    if (words) {
      const facts = p && this.describe(p);
      for (const [key] of FACTS) {
        const text = facts?.[key] ?? "–";
        if (this.facts[key].textContent !== text) this.facts[key].title = this.facts[key].textContent = text;
      }
      const used = p?.used[p.hardest()] ?? 0;
      this.meter.className = used > 0.995 ? "hot" : "";
      this.meter.style.width = `${Math.round(used * 100)}%`;
    }
    if (p && now - this.busiestAt > 3) {
      this.busiest = inPlace(this.busiest, busiest(p));
      this.busiestAt = now;
    }
    const one = p && this.dofs.value ? p.body.dofs.findIndex((d) => d.name === this.dofs.value) : -1;
    const wanted = one >= 0 ? [one] : this.busiest;
    this.plots.forEach((view, i) => {
      view.figure.hidden = one >= 0 && i > 0;
      if (!view.figure.hidden) view.show(p, wanted[i], words);
    });
  }

  /** How a file was understood, or why it was not. */
  showReport(file: string, outcome: RetargetReport | undefined, error?: string, forecast?: Forecast): void {
    const offer = button("Help it", { id: "help-it" });
    offer.addEventListener("click", () =>
      this.wishes.forChosen((p) => this.change(p, { follow: Follow.ASSISTED }, "follow")),
    );
    if (error !== undefined) {
      this.report.replaceChildren(
        el(
          "div",
          { class: "report bad", role: "alert" },
          el("strong", {}, `${file} could not be read`),
          el("p", {}, error),
        ),
      );
      return;
    }
    const r = outcome;
    if (!r) return;
    const facts = found(r);
    if (forecast) facts.push(forecastText(forecast));
    const said = warnings(r);
    const notes = said.length
      ? [
          el("strong", { class: "warnings" }, said.length === 1 ? "1 warning" : `${said.length} warnings`),
          el("ul", { class: "warnings" }, ...said.map((w) => el("li", {}, w))),
        ]
      : [];
    const clamps = [...r.clamped]
      .sort((a, b) => b.maxExcessRad - a.maxExcessRad)
      .map((c) => el("tr", {}, ...clamp(c).map((text) => el("td", {}, text))));
    const head = el("tr", {}, ...["Angle", "Frames", "Excess"].map((text) => el("th", { scope: "col" }, text)));
    const limited = clamps.length
      ? [
          el(
            "details",
            {},
            el(
              "summary",
              {},
              clamps.length === 1
                ? "1 angle limited to the body’s range"
                : `${clamps.length} angles limited to the body’s range`,
            ),
            el("table", {}, head, ...clamps),
          ),
        ]
      : [];
    const map = el(
      "details",
      {},
      el("summary", {}, "Bone mapping"),
      el("ul", {}, ...r.mapped.map((m) => el("li", {}, `${m.bone}: ${m.joints.join(", ")}`))),
    );
    this.report.replaceChildren(
      el(
        "div",
        { class: "report" },
        el("strong", {}, `${file} is playing`),
        el("ul", {}, ...facts.map((f) => el("li", {}, f))),
        ...notes,
        ...limited,
        map,
        el("p", {}, "It follows by its own strength, and falls where that is not enough. ", offer),
        el(
          "p",
          {},
          "Help is a force on the pelvis of at most 30 % of the weight, and a moment, drawn as orange arrows.",
        ),
      ),
    );
  }
}
