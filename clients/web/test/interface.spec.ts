// What the page looks like and says: the desired motion, the hint, reset, falls, a layout that stays, axes, the view
// that follows.
import { create } from "@bufbuild/protobuf";
import { RetargetReportSchema } from "../src/gen/sinew/v1/types_pb.js";
import { axis, inPlace, marks, settled, usual } from "../src/plots.js";
import { numbers } from "../src/client.js";
import { ghostOpacity } from "../src/model.js";
import { HUES } from "../src/scene.js";
import { Follow, FollowWay } from "../src/gen/sinew/v1/motion_pb.js";
import { StatusSchema } from "../src/gen/sinew/v1/frame_pb.js";
import { following, kilograms, margin, warnings } from "../src/words.js";
import { recording } from "./recording.js";
import { coloured, differing, dropFile, expect, fact, live, off, shot, Sinew, test } from "./support.js";
import type { Page } from "@playwright/test";

/** A world of its own with figures that play a clip each, beside one another. */
async function world(address: string, id: string, clips: string[]): Promise<Sinew> {
  const api = new Sinew(`http://${address}`);
  await api.worlds.createWorld({ worldId: id });
  for (const [i, clip] of clips.entries()) {
    const { figure } = await api.figures.createFigure({
      parent: `worlds/${id}`,
      figureId: `f${i}`,
      figure: { body: "bodies/adult-man", placement: { yM: -6 * i } },
    });
    await api.motion.playClip({
      figure: figure?.name ?? "",
      clip: `clips/${clip}`,
      loop: true,
      reset: true,
      placement: { yM: -6 * i },
    });
  }
  return api;
}

/** The scene of a paused world once it is drawn: a slow machine draws its last pictures late. */
async function atRest(page: Page): Promise<Buffer> {
  const stage = page.locator("#stage");
  let last = await stage.screenshot();
  await expect
    .poll(async () => {
      await page.waitForTimeout(400);
      const before = last;
      last = await stage.screenshot();
      return differing(page, before, last);
    })
    .toBe(0);
  return last;
}

/** Pixels of the scene that the desired motion changes, in a paused world. */
async function ghostPixels(page: Page): Promise<number> {
  const toggle = async (): Promise<{ picture: Buffer; shown: string | undefined }> => {
    await page.keyboard.press("g");
    const drawn = Number(await page.evaluate(() => document.body.dataset.drawn));
    await page.waitForFunction((n) => Number(document.body.dataset.drawn) > n + 1, drawn);
    const picture = await atRest(page);
    return { picture, shown: await page.evaluate(() => document.body.dataset.shown) };
  };
  // The last frame may arrive after the answer to the pause: both pictures have to be of that one.
  let [without, on] = [await toggle(), await toggle()];
  for (let again = 0; on.shown !== without.shown && again < 3; again++)
    [without, on] = [await toggle(), await toggle()];
  expect(on.shown).toBe(without.shown);
  return differing(page, on.picture, without.picture);
}

/** Fells a figure with a push from behind. */
async function fell(api: Sinew, world: string, figure: string): Promise<void> {
  await api.perturbations.applyPerturbations({
    world,
    perturbations: [
      {
        figureId: figure,
        kind: {
          case: "impulse",
          value: { segment: "chest", impulseNewtonSeconds: { x: 300, y: 0, z: 0 }, durationS: 0.1 },
        },
      },
    ],
  });
}

/** Pelvis of every figure in the newest frame, and what it carries, kg. */
async function places(api: Sinew, world: string): Promise<{ x: number; y: number; z: number; loadKg: number }[]> {
  const { frame } = await api.state.getWorldFrame({
    world,
    view: { fields: { paths: ["segment_transforms", "status"] } },
  });
  return (frame?.figures ?? []).map((f) => {
    const [x, y, z] = Array.from(numbers(f.segmentTransforms));
    return { x, y, z, loadKg: (f.status?.loads ?? []).reduce((sum, l) => sum + l.massKg, 0) };
  });
}

test("the desired motion is drawn where it differs from the body, and not where both agree", async ({
  page,
  server,
}) => {
  expect(ghostOpacity(0)).toBe(0);
  expect(ghostOpacity(0.01)).toBe(0);
  expect(ghostOpacity(0.2)).toBe(1);
  await server.start("--no-demo");
  const api = await world(server.address, "still", ["idle"]);
  await live(page, `${server.url}#world=still`);
  await page.waitForTimeout(2000);
  expect(await off(page)).toBeLessThan(1);
  await page.keyboard.press(" ");
  await expect(page.locator("#pause")).toHaveText("Resume");
  await shot(page, "ghost-agrees");
  expect(await ghostPixels(page), "pixels of a desired motion that agrees").toBeLessThan(20);
  await page.keyboard.press(" ");
  // A figure that has fallen is far from its desired motion.
  await fell(api, "worlds/still", "f0");
  await expect(fact(page, "state")).toHaveText("fallen");
  await page.keyboard.press(" ");
  await expect(page.locator("#pause")).toHaveText("Resume");
  await shot(page, "ghost-differs");
  expect(await ghostPixels(page), "pixels of a desired motion that differs").toBeGreaterThan(300);
});

test("help from outside is drawn as an arrow while it acts", async ({ page, server }) => {
  await server.start("--no-demo");
  const api = await world(server.address, "held", ["idle"]);
  await live(page, `${server.url}#world=held`);
  const orange = async (): Promise<number> => coloured(page, await page.locator("#stage").screenshot(), HUES.help);
  await page.waitForTimeout(1000);
  expect(await orange()).toBe(0);
  await api.figures.updateFigure({
    figure: { name: "worlds/held/figures/f0", assist: 0.9 },
    updateMask: { paths: ["assist"] },
  });
  // 300 N to the side for ten seconds.
  const value = { segment: "pelvis", impulseNewtonSeconds: { x: 0, y: 1000, z: 0 }, durationS: 10 };
  const push = { figureId: "f0", kind: { case: "impulse" as const, value } };
  await api.perturbations.applyPerturbations({ world: "worlds/held", perturbations: [push, push, push] });
  await expect.poll(orange).toBeGreaterThan(100);
  await shot(page, "help-arrow");
});

test("the first screen says what to try, beside the scene, until it is dismissed", async ({ page, server }) => {
  await server.start();
  await live(page, server.url);
  const hint = page.locator("#hint");
  for (const size of [
    { width: 1280, height: 720 },
    { width: 1000, height: 700 },
    { width: 390, height: 844 },
  ]) {
    await page.setViewportSize(size);
    await page.reload();
    await expect(page.locator("body")).toHaveAttribute("data-phase", "live");
    await expect(hint).toBeVisible();
    for (const words of ["Drag a figure", "load slider", "BVH file"]) await expect(hint).toContainText(words);
    const [h, s] = [await hint.boundingBox(), await page.locator("#stage").boundingBox()];
    if (!h || !s) throw new Error("hint and scene are seen");
    expect(h.y + h.height, "the hint ends above the scene").toBeLessThanOrEqual(s.y + 0.5);
    expect(s.height, "the scene keeps most of the page").toBeGreaterThan(0.6 * size.height);
    expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth)).toBe(true);
    await page.waitForTimeout(600);
    await shot(page, `hint-${size.width}`);
  }
  await page.locator("#hint-close").click();
  await expect(hint).toBeHidden();
  await page.reload();
  await expect(page.locator("body")).toHaveAttribute("data-phase", "live");
  await expect(hint).toBeHidden();
  await page.keyboard.press("?");
  await expect(page.locator("#dialog")).toContainText("Drag a figure to push it");
});

test("a fallen figure has a message with a button that stands it up again, and no other", async ({ page, server }) => {
  await server.start("--no-demo");
  const api = await world(server.address, "falls", ["idle", "walk"]);
  await live(page, `${server.url}#world=falls&figure=f1`);
  await expect(page.locator("#fallen")).toBeHidden();
  await fell(api, "worlds/falls", "f0");
  await expect(page.locator("#fallen")).toContainText("f0 has fallen");
  await expect(page.locator("#fallen")).toContainText("gets up by itself only if its motion gets up");
  await shot(page, "fallen");
  // The message waits for the button for as long as the figure lies there.
  await page.waitForTimeout(3000);
  await expect.poll(async () => (await places(api, "worlds/falls"))[1].x).toBeGreaterThan(1.5);
  await page.getByRole("button", { name: "Stand f0 up again" }).click();
  await expect(page.locator("#fallen")).toBeHidden();
  const [f0, f1] = await places(api, "worlds/falls");
  expect(f0.z, "the figure stands").toBeGreaterThan(0.8);
  expect(Math.hypot(f0.x, f0.y), "at its place").toBeLessThan(0.3);
  expect(f1.x, "the other one walks on").toBeGreaterThan(1.2);
});

test("reset puts all figures back, without loads, and starts their clips in the same tick", async ({
  page,
  server,
}) => {
  await server.start("--no-demo");
  const api = await world(server.address, "again", ["walk", "walk", "idle"]);
  await live(page, `${server.url}#world=again`);
  await page.locator("#load-slider").fill("4");
  await expect(fact(page, "load")).toHaveText("4 kg");
  await fell(api, "worlds/again", "f2");
  await expect(page.locator("#fallen")).toContainText("f2 has fallen");
  await expect.poll(async () => (await places(api, "worlds/again"))[0].x).toBeGreaterThan(1);
  // In a paused world the picture and the readouts show the start at once.
  await page.keyboard.press(" ");
  await expect(page.locator("#pause")).toHaveText("Resume");
  await page.keyboard.press("Shift+R");
  await expect(page.locator("#captions")).toContainText("World reset");
  await expect(page.locator("#fallen")).toBeHidden();
  await expect(page.locator("#load-value")).toHaveText("0 kg");
  await expect(fact(page, "load")).toHaveText("none");
  await expect(fact(page, "state")).toHaveText("standing");
  for (const [i, p] of (await places(api, "worlds/again")).entries()) {
    expect(Math.hypot(p.x, p.y + 6 * i), `f${i} is at its place`).toBeLessThan(0.1);
    expect(p.loadKg, `f${i} carries nothing`).toBe(0);
  }
  // It is still paused; then the two that walk do so in step.
  await expect(page.locator("#pause")).toHaveText("Resume");
  await page.locator("#pause").click();
  await expect.poll(async () => (await places(api, "worlds/again"))[0].x).toBeGreaterThan(0.5);
  const [a, b] = await places(api, "worlds/again");
  expect(Math.abs(a.x - b.x), "clips started in the same tick").toBeLessThan(0.01);
  // A running world goes on running.
  await page.locator("#reset").click();
  await expect.poll(async () => (await places(api, "worlds/again"))[0].x).toBeLessThan(0.3);
  await expect.poll(async () => (await places(api, "worlds/again"))[0].x).toBeGreaterThan(0.6);
});

test("nothing in the panel moves while the page fills and numbers change", async ({ page, server }) => {
  await server.start();
  const layout = (): Promise<string> =>
    page.evaluate(() => {
      const parts = document.querySelectorAll(
        "#controls, #controls section, #controls section > *, .plot > *, .row > *, #summary dd, " +
          "#bar > *, #bar .group > *",
      );
      return [...parts]
        .map((e) => {
          const { x, y, width, height } = e.getBoundingClientRect();
          return `${e.tagName} ${e.id} ${e.className}: ${[x, y, width, height].map((v) => v.toFixed(1)).join(" ")}`;
        })
        .join("\n");
    });
  // The server's answers wait until the empty page has been measured.
  let release: () => void = () => undefined;
  const measured = new Promise<void>((done) => (release = done));
  await page.route("**/sinew.v1.*/**", async (route) => {
    await measured;
    await route.continue();
  });
  await page.goto(server.url);
  await expect(page.locator("#controls section").first()).toBeVisible();
  const first = await layout();
  release();
  await expect(page.locator("body")).toHaveAttribute("data-phase", "live");
  await expect.poll(async () => Number(await page.locator("body").getAttribute("data-drawn"))).toBeGreaterThan(2);
  expect(await layout(), "when the figures are there").toBe(first);
  await page.locator("#figures button", { hasText: "child" }).click();
  const said = new Set<string>();
  for (const load of ["0.5", "19.5", "20", "0"]) {
    await page.locator("#load-slider").fill(load);
    for (let i = 0; i < 12; i++) {
      await page.waitForTimeout(250);
      said.add(await page.locator("#summary").innerText());
      expect(await layout(), `with ${load} kg`).toBe(first);
    }
  }
  // It did say different things meanwhile.
  expect(said.size).toBeGreaterThan(8);
});

test("torque plots have axes with units, a legend and the range of strength", async ({ page, server }) => {
  expect(axis(-32, 45)).toEqual({ low: -40, high: 60, step: 20 });
  expect(marks({ low: -40, high: 60, step: 20 })).toEqual([-40, -20, 0, 20, 40, 60]);
  for (const [low, high] of [
    [-3, 0.2],
    [0, 0],
    [-812, 95],
    [-1, 1.5e4],
  ]) {
    const a = axis(low, high);
    expect(
      a.low <= low && a.high >= high && marks(a).length >= 2 && marks(a).length <= 7,
      `${low} to ${high}: ${JSON.stringify(a)}`,
    ).toBe(true);
  }
  const inUse = axis(-32, 45);
  expect(settled(inUse, -30, 41), "a small change keeps the axis").toBe(inUse);
  expect(settled(inUse, -30, 61), "what does not fit changes it").not.toBe(inUse);
  const spike = Array.from({ length: 100 }, (_, i) => (i === 50 ? 1000 : 120));
  expect(usual(spike, 0.95), "one spike does not set the axis").toBe(120);
  expect(inPlace([3, 7, 9], [9, 1, 3]), "a plot stays in its place").toEqual([3, 1, 9]);

  await server.start();
  await live(page, server.url);
  const plot = page.locator(".plot").first();
  await expect(plot.locator(".torques span").first()).toBeVisible();
  await expect(plot.locator(".unit")).toHaveText("N·m");
  await expect(plot.locator(".times span")).toHaveText(["−8", "−6", "−4", "−2", "0 s"]);
  const number = (text: string): number => Number(text.replace("−", "-"));
  const labels = (await plot.locator(".torques span").allInnerTexts()).map(number);
  expect(labels.length).toBeGreaterThan(2);
  expect(labels).toContain(0);
  const readout = await plot.locator("figcaption span").last().innerText();
  const [, torque, low, high] = (/^(−?\d+) N·m \((−?\d+) to (−?\d+)\)$/.exec(readout) ?? []).map(number);
  for (const v of [torque, low, high])
    expect(v >= Math.min(...labels) && v <= Math.max(...labels), `${v} lies on the axis ${labels.join(", ")}`).toBe(
      true,
    );
  // Marks stand where their values are: the same distance between any two of them.
  const heights = await plot
    .locator(".torques span")
    .evaluateAll((spans) => spans.map((s) => s.getBoundingClientRect().y));
  const gaps = heights.slice(1).map((y, i) => Math.abs(y - heights[i]));
  expect(Math.max(...gaps) - Math.min(...gaps)).toBeLessThan(1);
  expect(Math.min(...gaps), "labels do not overlap").toBeGreaterThan(10);
  await expect(page.getByRole("list", { name: "Curves" }).locator("li")).toHaveText([
    "torque",
    "available range",
    "at its limit",
  ]);
});

test("the view follows the chosen figure until it is panned", async ({ page, server }) => {
  await server.start("--no-demo");
  const api = await world(server.address, "far", ["idle", "walk"]);
  await live(page, `${server.url}#world=far&figure=f1`);
  const view = page.locator("#view");
  const fromMiddle = async (): Promise<number> => {
    const [label, box] = [
      await page.locator("#labels span.chosen:not([hidden])").boundingBox(),
      await view.boundingBox(),
    ];
    return label && box ? Math.abs(label.x + label.width / 2 - box.x - box.width / 2) / box.width : Infinity;
  };
  expect(await fromMiddle(), "it stands aside at first").toBeGreaterThan(0.15);
  await page.keyboard.press("t");
  await expect(page.locator("#follow")).toHaveAttribute("aria-pressed", "true");
  await expect.poll(fromMiddle).toBeLessThan(0.06);
  await expect.poll(() => page.url()).toContain("follow=1");
  // It keeps up with a walk of metres, and goes along to another figure and another place.
  await expect.poll(async () => (await places(api, "worlds/far"))[1].x).toBeGreaterThan(2);
  expect(await fromMiddle()).toBeLessThan(0.1);
  await api.figures.resetFigure({ name: "worlds/far/figures/f0", placement: { xM: 9, yM: 4 } });
  await page.keyboard.press("[");
  await expect(page.locator("#labels span.chosen:not([hidden])")).toHaveText("f0");
  await expect.poll(fromMiddle).toBeLessThan(0.06);
  // Turning keeps it in view; panning ends it.
  const box = await view.boundingBox();
  if (!box) throw new Error("the view is seen");
  const drag = async (button: "left" | "right"): Promise<void> => {
    await page.mouse.move(box.x + 60, box.y + box.height - 160);
    await page.mouse.down({ button });
    await page.mouse.move(box.x + 260, box.y + box.height - 190, { steps: 6 });
    await page.mouse.up({ button });
  };
  await drag("left");
  await expect.poll(fromMiddle).toBeLessThan(0.06);
  await expect(page.locator("#follow")).toHaveAttribute("aria-pressed", "true");
  await shot(page, "follow");
  await drag("right");
  await expect(page.locator("#follow")).toHaveAttribute("aria-pressed", "false");
  await page.locator("#follow").click();
  await expect.poll(fromMiddle).toBeLessThan(0.06);
  await page.keyboard.press("f");
  await expect(page.locator("#follow")).toHaveAttribute("aria-pressed", "false");
});

test("a report lists every warning about a recording and every limited angle", async ({ page, server }) => {
  const clamped = [
    { dof: "l_elbow_flexion", fraction: 0.3, maxExcessRad: 0.5 },
    { dof: "waist_flexion", fraction: 0.2, maxExcessRad: 0.2 },
    { dof: "r_knee_flexion", fraction: 0.001, maxExcessRad: 0.5 },
  ];
  const told = (...sentences: string[]): string[] =>
    warnings(create(RetargetReportSchema, { clamped, warnings: sentences }));
  const waist = "Waist flexion exceeds the body's limits by up to 11° in 20 % of the frames";
  // Each angle is told once, whether the server names it as the protocol does or in words; a short clamp is no warning.
  expect(told()).toEqual(["Left elbow flexion exceeds the body's limits by up to 29° in 30 % of the frames", waist]);
  expect(told("l_elbow_flexion was up to 29° outside")).toEqual(["Left elbow flexion was up to 29° outside", waist]);
  expect(told("left elbow: flexion cut by up to 29°")).toEqual(["Left elbow: flexion cut by up to 29°", waist]);
  await server.start();
  await live(page, server.url);
  await dropFile(page, "folded.bvh", recording(178));
  const report = page.locator("#report");
  await expect(report).toContainText("folded.bvh is playing");
  await expect(report.locator("ul.warnings li").filter({ hasText: /^Left elbow:? flexion/ })).toContainText(
    /\d+°.*\d+ %/,
  );
  await expect(report, "no name of the protocol").not.toContainText("_");
  const limited = report.locator("details").filter({ hasText: "limited to the body’s range" });
  await limited.locator("summary").click();
  await expect(limited.locator("tr").filter({ hasText: "left elbow flexion" })).toContainText(/\d+ %\s*\d+°/);
  await report.scrollIntoViewIfNeeded();
  await shot(page, "report");
  // Help is offered, and the address keeps the choice.
  await expect(page.locator("#help-choice")).toHaveValue(String(Follow.STRICT));
  await report.locator("#help-it").click();
  await expect(page.locator("#help-choice")).toHaveValue(String(Follow.ASSISTED));
  await expect.poll(() => page.url()).toContain("assisted");
});

test("readouts use the terms of the field", async ({ page, server }) => {
  expect(margin(0.094)).toBe("9 cm");
  expect(margin(-0.031)).toBe("3 cm outside support");
  expect(margin(undefined)).toBe("no support");
  const status = {
    following: FollowWay.HELPED,
    helpNewtonSeconds: 12.4,
    helpRatio: 0.021,
    helpNewtonMetreSeconds: 4.8,
  };
  expect(following(create(StatusSchema, status))).toBe(", helped 12 N·s (2.1 %), 5 N·m·s");
  expect(following(create(StatusSchema, { following: FollowWay.REHEARSED }))).toBe(", rehearsed");
  expect(following(create(StatusSchema, { following: FollowWay.TRACKED }))).toBe("");
  expect([kilograms(19.5), kilograms(20), kilograms(0.25)]).toEqual(["19.5 kg", "20 kg", "0.25 kg"]);
  await server.start();
  await live(page, server.url);
  await expect(page.locator("#summary dt")).toHaveText([
    "State",
    "Balance margin",
    "Load",
    "Tracking error",
    "Highest effort",
  ]);
  await expect(fact(page, "margin")).toHaveText(/^\d+ cm( outside support)?$/);
  await expect(fact(page, "error")).toHaveText(/^\d+\.\d° rms$/);
  const text = await page.locator("body").innerText();
  for (const phrase of [
    "inside its support",
    "Nobody",
    "Go on",
    "Take it with you",
    "How hard",
    "Tires",
    "hardest working",
    "Off the desired",
  ])
    expect(text).not.toContain(phrase);
});
