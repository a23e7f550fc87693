// What can be copied from the page does what the page shows.
import { execFile } from "node:child_process";
import { promisify } from "node:util";
import { expect, fact, live, program, test } from "./support.js";

const run = promisify(execFile);

test("copies reproduce the scene", async ({ page, server, context }) => {
  await server.start();
  await context.grantPermissions(["clipboard-read", "clipboard-write"], { origin: server.url.slice(0, -1) });
  await live(page, server.url);
  const copied = (): Promise<string> => page.evaluate(() => navigator.clipboard.readText());
  await page.locator("#load-slider").fill("6");
  await expect(fact(page, "load")).toHaveText("6 kg");
  await page.locator("#assist").fill("0.5");
  await expect(page.locator("#assist")).toHaveValue("0.5");
  await expect.poll(() => page.url()).toContain("0.5");

  await page.locator("#copy-cli").click();
  await expect
    .poll(copied)
    .toBe("sinew run builtin:crate --body adult-man --controller modern --assist 0.5 --load 6@l_hand+r_hand");
  const [, ...words] = (await copied()).split(" ");
  const { stdout } = await run(program, [...words, "--duration", "0.5"]);
  expect(stdout).not.toBe("");

  await page.locator("#copy-python").click();
  await expect.poll(copied).toContain(`sinew.Client("${server.address}")`);
  const script = await copied();
  expect(script).toContain('man.carry(6, "l_hand", "r_hand")');
  await run("python3", ["-c", "import ast, sys; ast.parse(sys.argv[1])", script]);
  console.log(script);

  // What only the paper's controller knows is said in full.
  await page.locator("#controller").selectOption("paper 2000");
  await page.locator("#preset").selectOption("as published in 2000");
  await page.locator("#stepper").selectOption("kinematic");
  await expect.poll(() => page.url()).toContain("kinematic");
  await page.locator("#copy-cli").click();
  const printed = "--controller paper --stepper kinematic --alpha 0.2 --horizon 0 --metric I";
  await expect.poll(copied).toContain(printed);
  const [, ...choices] = (await copied()).split(" ");
  await run(program, [...choices, "--duration", "0.5"]);
  await page.locator("#copy-python").click();
  await expect.poll(copied).toContain('stepper="kinematic", paper=sinew.Paper(preset="2000")');

  await page.locator("#copy-link").click();
  await expect.poll(copied).toContain(`${server.url}#`);
  const link = await copied();
  await page.goto("about:blank");
  await page.goto(link);
  await expect(fact(page, "load")).toHaveText("6 kg");
});
