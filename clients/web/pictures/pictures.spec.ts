// Makes the pictures of the documents from the real program: `npm run pictures`.
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { statSync } from "node:fs";
import type { Page } from "@playwright/test";
import { expect, live, test } from "../test/support.js";

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

test("dark", async ({ page, server }) => {
  await server.start();
  await page.emulateMedia({ colorScheme: "dark" });
  await live(page, server.url);
  await expect(page.locator("#clock")).toHaveText(/^(10|18|26|34)\.\d s$/);
  await keep(page, "viewer-dark.jpg");
});
