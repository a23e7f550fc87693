// The time line: what was is looked at, the world is rewound, and two futures of one moment are seen side by side.
// Worlds are paused and stepped by hand, so that every tick is known.
import AxeBuilder from "@axe-core/playwright";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { connect } from "../src/client.js";
import { Past } from "../src/history.js";
import { expect, fact, live, program, shot, Sinew, test, type Server } from "./support.js";
import type { Page } from "@playwright/test";

const RATE = 60;

/** A paused world with a figure that plays a clip, after so many ticks; `push`: pushed hard after the first second. */
async function stepped(server: Server, id: string, clip: string, ticks: number, push = 0): Promise<Sinew> {
  const api = new Sinew(`http://${server.address}`);
  const world = `worlds/${id}`;
  await api.worlds.createWorld({ worldId: id, world: {}, paused: true });
  const { figure } = await api.figures.createFigure({
    parent: world,
    figureId: "anna",
    figure: { body: "bodies/adult-man" },
  });
  await api.motion.playClip({ figure: figure?.name ?? "", clip: `clips/${clip}`, loop: true, reset: true });
  const first = push ? RATE : ticks;
  await api.worlds.stepWorld({ name: world, tickCount: first });
  if (!push) return api;
  await api.perturbations.applyPerturbations({
    world,
    perturbations: [
      {
        figureId: "anna",
        kind: {
          case: "impulse",
          value: { segment: "chest", impulseNewtonSeconds: { x: push, y: 0, z: 0 }, durationS: 0.1 },
        },
      },
    ],
  });
  await api.worlds.stepWorld({ name: world, tickCount: ticks - first });
  return api;
}

/** The moment that a pane shows, s; NaN while it is not there yet. */
async function moment(page: Page, pane: "shown" | "beside" = "shown"): Promise<number> {
  const text = (await page.locator("body").getAttribute(`data-${pane}`)) ?? "";
  return text.endsWith(" true") ? Number(text.split(" ")[0]) : NaN;
}

const tickOf = async (api: Sinew, id: string): Promise<number> =>
  Number((await api.worlds.getWorld({ name: `worlds/${id}` })).world?.tick);

/** What the figure carries in the newest frame, kg. */
async function load(api: Sinew, id: string): Promise<number> {
  const { frame } = await api.state.getWorldFrame({ world: `worlds/${id}`, view: { fields: { paths: ["status"] } } });
  return (frame?.figures[0].status?.loads ?? []).reduce((sum, l) => sum + l.massKg, 0);
}

test("who comes late sees the world at once, and what was before", async ({ page, server }) => {
  await server.start("--no-demo");
  const api = await stepped(server, "late", "idle", 8 * RATE, 300);
  await live(page, `${server.url}#world=late`);
  await expect(page.locator("#timeline")).toHaveAttribute("data-state", "live");
  const time = page.locator("#time");
  await expect(time).toHaveAttribute("min", "0");
  await expect(time).toHaveAttribute("max", String(8 * RATE));
  await expect(page.locator("#marks .push")).toHaveCount(1);
  await expect(page.locator("#marks .push")).toHaveAttribute("title", /^1\.0 s: anna is pushed: 300 N·s$/);
  await expect(page.locator("#marks .fall").first()).toBeVisible();
  await expect(fact(page, "state")).toHaveText("fallen");
  // The push is a moment that this page has not seen: it comes from the server.
  await page.locator("#marks .push").click();
  await expect(page.locator("body")).toHaveAttribute("data-time", "past");
  await expect.poll(() => moment(page)).toBeCloseTo(1, 2);
  await expect(fact(page, "state")).toHaveText("standing");
  await expect(page.locator("#clock")).toHaveText("1.0 s");
  await expect(page.locator("#moment")).toHaveText("−7.0 s");
  await shot(page, "time-line-push");
  expect(await tickOf(api, "late"), "the world is not changed").toBe(8 * RATE);
  // A figure that is gone now is there as long as it was.
  await api.figures.deleteFigure({ name: "worlds/late/figures/anna" });
  await expect(page.locator("#figures button")).toHaveCount(0);
  await expect(page.locator("#labels span", { hasText: "anna" })).toBeVisible();
});

test("the past is looked at with pointer and keys, and the present goes on", async ({ page, server }) => {
  await server.start("--no-demo");
  const api = await stepped(server, "walks", "walk", 6 * RATE);
  await live(page, `${server.url}#world=walks`);
  const time = page.locator("#time");
  await expect(time).toHaveAttribute("max", String(6 * RATE));
  // Dragging: frames of moments on the way come and go; where the pointer rests is what is shown.
  const box = await time.boundingBox();
  if (!box) throw new Error("the time line is seen");
  await page.mouse.move(box.x + box.width - 8, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.25, box.y + box.height / 2, { steps: 9 });
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 5 });
  await expect.poll(async () => Math.abs((await moment(page)) - 3)).toBeLessThan(0.2);
  await page.mouse.up();
  expect(Math.abs((await moment(page)) - 3)).toBeLessThan(0.2);
  await expect(time).toBeFocused();
  await expect(time).toHaveAttribute("aria-valuetext", /^[23]\.\d s, [23]\.\d s before now$/);
  // Keys. Before the first tick there was no figure yet.
  await page.keyboard.press("Home");
  await expect.poll(() => moment(page)).toBe(0);
  await page.keyboard.press("ArrowRight");
  await expect.poll(() => moment(page)).toBeCloseTo(0.1, 2);
  const place = async (): Promise<number> => (await page.locator("#labels span").first().boundingBox())?.x ?? NaN;
  await expect.poll(place).toBeGreaterThan(0);
  const first = await place();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("ArrowLeft");
  await expect.poll(() => moment(page)).toBeCloseTo(1.9, 2);
  // What a picture shows is what was: the figure walks.
  await expect.poll(async () => Math.abs((await place()) - first)).toBeGreaterThan(10);
  // The world goes on meanwhile; the past stays where it is, and how long ago it was grows.
  await api.worlds.stepWorld({ name: "worlds/walks", tickCount: RATE });
  await expect(page.locator("#moment")).toHaveText("−5.1 s");
  expect(await moment(page)).toBeCloseTo(1.9, 2);
  await page.keyboard.press("End");
  await expect(page.locator("#timeline")).toHaveAttribute("data-state", "live");
  await expect.poll(() => moment(page)).toBeGreaterThan(6.8);
  // Escape and the button lead back, too; so does anything that changes the world.
  for (const back of [
    () => page.keyboard.press("Escape"),
    () => page.locator("#to-live").click(),
    () => page.locator("#step").click(),
  ]) {
    await time.fill("60");
    await expect(page.locator("#timeline")).toHaveAttribute("data-state", "past");
    await back();
    await expect(page.locator("#timeline")).toHaveAttribute("data-state", "live");
  }
  await expect.poll(() => tickOf(api, "walks")).toBe(7 * RATE + 1);
  const epoch = (await api.worlds.getWorld({ name: "worlds/walks" })).world?.epoch;
  expect(epoch, "nothing of it put the world back").toBe(1);
});

test("frames of the past are kept up to a bound, those around the moment that is looked at", async ({ server }) => {
  await server.start("--no-demo");
  const api = await stepped(server, "kept", "idle", 20 * RATE);
  const past = new Past(api, "worlds/kept", ["root_pose"]);
  await past.look();
  expect([past.oldest, past.newest]).toEqual([0, 20 * RATE]);
  expect(past.events.length).toBeGreaterThan(0);
  for (const time of [3, 17.21, 0, 20, 9.99]) {
    past.lookAt(time);
    await expect.poll(() => past.at(time)?.exact).toBe(true);
    const around = past.at(time);
    if (!around) throw new Error("there are frames");
    const [a, b] = [around.before.frame.timeS, around.after.frame.timeS];
    // Between two frames, or, at the edge of a piece whose neighbour is not held, the one next to it.
    const between = a <= time + 1e-9 && time <= b + 1e-9 && b - a < 0.05;
    const next = a === b && Math.abs(a - time) < 1.5 / RATE;
    expect(between || next, `${a} ≤ ${time} ≤ ${b}`).toBe(true);
  }
  // Half of the frames are kept; the neighbours of what is looked at come by themselves.
  await expect.poll(() => past.count).toBeGreaterThan(10 * (RATE / 2));
  expect(past.count).toBeLessThanOrEqual(20 * (RATE / 2) + 1);
  past.lookAt(undefined);
});

test("R rewinds the world by five seconds, and no farther than is held", async ({ page, server }) => {
  await server.start("--no-demo");
  const api = await stepped(server, "back", "idle", 7 * RATE, 300);
  await live(page, `${server.url}#world=back`);
  await expect(fact(page, "state")).toHaveText("fallen");
  await page.keyboard.press("r");
  await expect(page.locator("#captions")).toContainText("rewound to 2.0 s");
  await expect.poll(() => tickOf(api, "back")).toBe(2 * RATE);
  await expect(page.locator("#time")).toHaveAttribute("max", String(2 * RATE));
  await expect(page.locator("#marks .world")).toHaveCount(2);
  // From a moment that is looked at.
  await api.worlds.stepWorld({ name: "worlds/back", tickCount: 4 * RATE });
  await expect(page.locator("#time")).toHaveAttribute("max", String(6 * RATE));
  await page.locator("#time").fill(String(5.5 * RATE));
  await expect(page.locator("#timeline")).toHaveAttribute("data-state", "past");
  await page.locator("#rewind").click();
  await expect.poll(() => tickOf(api, "back")).toBe(0.5 * RATE);
  await expect(fact(page, "state")).toHaveText("standing");
  // What it was rewound from is gone, the push, too.
  await expect(page.locator("#time")).toHaveAttribute("max", String(0.5 * RATE));
  await expect(page.locator("#marks .push")).toHaveCount(0);
  await page.keyboard.press("r");
  await expect.poll(() => tickOf(api, "back")).toBe(0);
  // The key that was R stands a figure up.
  await page.keyboard.press("?");
  await expect(page.locator("#dialog tr", { hasText: "rewind" }).locator("kbd")).toHaveText("R");
  await expect(page.locator("#dialog tr", { hasText: "stand the chosen figure" }).locator("kbd")).toHaveText("U");
});

test("who may only watch is told so, and sees the past", async ({ page, server }) => {
  const work = mkdtempSync(join(tmpdir(), "sinew-time-"));
  try {
    const key = join(work, "key");
    execFileSync(program, ["token", "--key", key, "--new-key"]);
    const token = (name: string, role: string): string =>
      execFileSync(program, ["token", "--key", key, "--for", name, "--role", role, "--world", "hall"], {
        encoding: "utf8",
      }).trim();
    const config = join(work, "sinew.toml");
    writeFileSync(config, `jwt_secret_file = "${key}"\n`);
    await server.start("--no-demo", "--config", config);
    const url = `http://${server.address}`;
    const ada = new Sinew(url, connect(url, token("ada", "owner")));
    await ada.worlds.createWorld({ worldId: "hall", paused: true });
    await ada.figures.createFigure({ parent: "worlds/hall", figureId: "anna" });
    await ada.worlds.stepWorld({ name: "worlds/hall", tickCount: 2 * RATE });
    await live(page, `${server.url}#world=hall&token=${token("vic", "viewer")}`);
    await page.keyboard.press("r");
    await expect(page.locator("#captions")).toContainText("Only a director can rewind this world; your role is viewer");
    await page.locator("#branch").click();
    await expect(page.locator("#captions")).toContainText("Only a director can branch this world");
    await page.locator("#time").fill("60");
    await expect.poll(() => moment(page)).toBeCloseTo(1, 2);
    await shot(page, "time-line-viewer");
    expect(await tickOf(ada, "hall")).toBe(2 * RATE);
  } finally {
    rmSync(work, { recursive: true, force: true });
  }
});

test("two futures of one moment side by side", async ({ page, server }) => {
  await server.start("--no-demo");
  const api = await stepped(server, "lab", "idle", 5 * RATE);
  await live(page, `${server.url}#world=lab`);
  await page.locator("#time").fill(String(2 * RATE));
  await expect.poll(() => moment(page)).toBeCloseTo(2, 2);
  await page.locator("#branch").click();
  const compare = page.locator("#compare");
  await expect(compare).toBeVisible();
  await expect(page.locator("#main-title")).toHaveText("Branch: lab-branch");
  await expect(page.locator("#beside-title")).toHaveText("Original: lab");
  await expect(page.locator("#since")).toHaveText("Since the branch: 0.0 s");
  await expect(page.locator("#lag")).toContainText("paused: change something");
  expect(await tickOf(api, "lab-branch")).toBe(2 * RATE);
  // Both show the same moment, with the same camera.
  await expect.poll(() => moment(page)).toBeCloseTo(2, 2);
  await expect.poll(() => moment(page, "beside")).toBeCloseTo(2, 2);
  const head = async (pane: string): Promise<[number, number]> => {
    const [label, frame] = [
      await page.locator(`${pane} .labels span`, { hasText: "anna" }).boundingBox(),
      await page.locator(`${pane} .picture`).boundingBox(),
    ];
    return label && frame ? [label.x - frame.x, label.y - frame.y] : [NaN, NaN];
  };
  const apart = async (): Promise<number> => {
    const [[ax, ay], [bx, by]] = [await head("#main"), await head("#beside")];
    return Math.hypot(ax - bx, ay - by);
  };
  await expect.poll(apart).toBeLessThan(1.5);
  await page.locator("#view").focus();
  const before = await head("#main");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("-");
  await expect.poll(async () => Math.hypot(...(await head("#main")).map((v, i) => v - before[i]))).toBeGreaterThan(4);
  await expect.poll(apart).toBeLessThan(1.5);
  // What if it carried 6 kg? The branch has its own load, and the original another one.
  const loadAfterTick = async (id: string): Promise<number> => {
    await api.worlds.stepWorld({ name: `worlds/${id}`, tickCount: 1 });
    return load(api, id);
  };
  await page.locator("#load-slider").fill("6");
  await expect.poll(() => loadAfterTick("lab-branch")).toBeCloseTo(6, 6);
  expect(await load(api, "lab")).toBe(0);
  await page.locator("#beside-load").fill("2");
  await expect(page.locator("#beside-load-value")).toHaveText("2 kg");
  await expect.poll(() => loadAfterTick("lab")).toBeCloseTo(2, 6);
  expect(await load(api, "lab-branch")).toBeCloseTo(6, 6);
  // A second later both are shown at the same time since they parted.
  await api.worlds.stepWorld({ name: "worlds/lab-branch", tickCount: RATE });
  await expect(page.locator("#since")).toHaveText(/^Since the branch: 1\.\d s$/);
  await expect.poll(async () => (await moment(page)) - (await moment(page, "beside"))).toBeCloseTo(0, 2);
  // A push in the original, from its own pane.
  await page.locator("#beside-push").click();
  await expect(page.locator("#captions")).toContainText("Pushed anna");
  // The address opens the same comparison.
  await expect.poll(() => page.url()).toContain("beside=lab&since=120");
  await page.reload();
  await expect(page.locator("#beside-title")).toHaveText("Original: lab");
  await expect.poll(async () => (await moment(page)) - (await moment(page, "beside"))).toBeCloseTo(0, 2);
  await shot(page, "two-futures");
  const found = await new AxeBuilder({ page }).analyze();
  expect(found.violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(" ")).join(", ")}`)).toEqual([]);
  // Panel and time line of the other one; the time stays that of the branch.
  await page.locator("#swap").click();
  await expect(page.locator("#main-title")).toHaveText("Original: lab");
  await expect(page.locator("body")).toHaveAttribute("data-pair", "original");
  await expect.poll(async () => (await moment(page)) - (await moment(page, "beside"))).toBeCloseTo(0, 2);
  await expect.poll(() => moment(page)).toBeLessThan(3.6);
  // The branch runs until it is where the original is.
  await page.locator("#catch-up").click();
  await expect(page.locator("#catch-up")).toBeDisabled();
  await expect.poll(() => tickOf(api, "lab-branch")).toBeGreaterThan(4.5 * RATE);
  await expect.poll(async () => (await api.worlds.getWorld({ name: "worlds/lab-branch" })).world?.speed).toBe(1);
  // When it is over, the branch is deleted or kept.
  await page.locator("#compare-done").click();
  await page.locator("#branch-delete").click();
  await expect(compare).toBeHidden();
  await expect(page.locator("#beside")).toBeHidden();
  await expect.poll(async () => (await api.worlds.listWorlds({})).worlds.map((w) => w.name)).toEqual(["worlds/lab"]);
  await expect(page.locator("body")).toHaveAttribute("data-phase", "live");
  await expect.poll(() => moment(page)).toBeGreaterThan(4.9);
});

for (const scheme of ["light", "dark"] as const)
  test(`time line and futures on large and small screens (${scheme}) @nightly`, async ({ page, server }) => {
    await server.start("--no-demo");
    const api = await stepped(server, "looks", "crate", 8 * RATE, 20);
    await page.emulateMedia({ colorScheme: scheme, reducedMotion: "reduce" });
    for (const [name, width, height] of [
      ["desktop", 1280, 800],
      ["phone", 390, 844],
    ] as const) {
      await page.setViewportSize({ width, height });
      await live(page, `${server.url}#world=looks`);
      if (await page.locator("#hint").isVisible()) await page.locator("#hint-close").click();
      await page.locator("#time").fill(String(3 * RATE));
      await expect.poll(() => moment(page)).toBeCloseTo(3, 2);
      await shot(page, `time-line-${name}-${scheme}`);
      await page.locator("#branch").click();
      await expect.poll(() => moment(page, "beside")).toBeCloseTo(3, 2);
      await page.locator("#load-slider").fill("16");
      const id = (await page.locator("#main-title").innerText()).replace("Branch: ", "");
      await expect(page.locator("#load-value")).toHaveText("16 kg");
      const afterTick = async (): Promise<number> => {
        await api.worlds.stepWorld({ name: `worlds/${id}`, tickCount: 1 });
        return load(api, id);
      };
      await expect.poll(afterTick).toBeGreaterThan(15);
      await api.worlds.stepWorld({ name: `worlds/${id}`, tickCount: 3 * RATE });
      await expect.poll(() => moment(page, "beside")).toBeGreaterThan(5.5);
      expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth)).toBe(true);
      await shot(page, `two-futures-${name}-${scheme}`);
      await page.locator("#compare-done").click();
      await page.locator("#branch-keep").click();
      await expect(page.locator("#compare")).toBeHidden();
      await api.worlds.deleteWorld({ name: `worlds/${id}` });
    }
  });
