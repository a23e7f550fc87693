// Makes the pictures of the documents from the real program: `npm run pictures`.
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { statSync } from "node:fs";
import type { Page } from "@playwright/test";
import { expect, live, Sinew, test } from "../test/support.js";

const images = join(dirname(fileURLToPath(import.meta.url)), "../../../docs/images");
/** A picture may have this many bytes. */
const LARGEST = 200_000;

async function keep(page: Page, name: string): Promise<void> {
  const path = join(images, name);
  await page.screenshot({ path, type: "jpeg", quality: 88 });
  expect(statSync(path).size, name).toBeLessThan(LARGEST);
}

test("the demo world, and what 20 kg do", async ({ page, server }) => {
  await server.start();
  await live(page, server.url);
  // The crate is on its way up.
  await expect(page.locator("#clock")).toHaveText(/^(10|18|26|34)\.\d s$/);
  await keep(page, "viewer.jpg");
  await page.locator("#load-slider").fill("20");
  await expect(page.locator("#captions")).toContainText(/(has fallen|loses balance)/);
  await page.keyboard.press("Space");
  await page.waitForTimeout(500);
  await keep(page, "viewer-load.jpg");
});

test("two futures of the demo world", async ({ page, server }) => {
  await server.start();
  await live(page, server.url);
  await page.locator("#hint-close").click();
  // The branch begins before the crate is lifted, and the original has gone on.
  await expect(page.locator("#clock")).toHaveText(/^(14|22|30|38)\.\d s$/);
  await page.locator("#time").fill(String(60 * 9));
  await page.locator("#branch").click();
  await expect(page.locator("#compare")).toBeVisible();
  await page.locator("#load-slider").fill("16");
  await expect(page.locator("#load-value")).toHaveText("16 kg");
  const api = new Sinew(`http://${server.address}`);
  const loaded = async (): Promise<number> => {
    await api.worlds.stepWorld({ name: "worlds/demo-branch", tickCount: 1 });
    const { frame } = await api.state.getWorldFrame({
      world: "worlds/demo-branch",
      view: { fields: { paths: ["status"] } },
    });
    const carried = (frame?.figures ?? []).map((f) => (f.status?.loads ?? []).reduce((sum, l) => sum + l.massKg, 0));
    return Math.min(...carried);
  };
  await expect.poll(loaded).toBeGreaterThan(15);
  await api.worlds.stepWorld({ name: "worlds/demo-branch", tickCount: 150 });
  await expect(page.locator("#since")).toHaveText(/^Since the branch: 2\.\d s$/);
  await page.waitForTimeout(1500);
  await keep(page, "viewer-futures.jpg");
});

test("dark", async ({ page, server }) => {
  await server.start();
  await page.emulateMedia({ colorScheme: "dark" });
  await live(page, server.url);
  await expect(page.locator("#clock")).toHaveText(/^(10|18|26|34)\.\d s$/);
  await keep(page, "viewer-dark.jpg");
});
