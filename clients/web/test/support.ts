// A server of its own for each test, and what tests ask of the page.
import { test as base, expect, type Locator, type Page } from "@playwright/test";
import { spawn, type ChildProcess } from "node:child_process";
import { mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
export const root = join(here, "../../..");
export const program = process.env.SINEW_BIN ?? join(root, "target/debug/sinew");
/** Least time between two pictures in tests, ms. */
const PICTURE_MS = Number(process.env.PICTURE_MS ?? 100);
/** Where screenshots are kept, to be looked at. */
export const SHOTS = join(here, "../shots");
mkdirSync(SHOTS, { recursive: true });

export class Server {
  address = "";
  private scheme = "http";
  private process: ChildProcess | undefined;

  async start(...args: string[]): Promise<void> {
    const port = this.address ? this.address.split(":")[1] : "0";
    const child = spawn(program, ["serve", "--listen", `127.0.0.1:${port}`, "--log", "warn", ...args], {
      stdio: ["ignore", "pipe", "inherit"],
    });
    this.process = child;
    this.address = await new Promise<string>((done, failed) => {
      let said = "";
      child.stdout.on("data", (text) => {
        said += String(text);
        const found = /(https?):\/\/(127\.0\.0\.1:\d+)/.exec(said);
        if (!found) return;
        this.scheme = found[1];
        done(found[2]);
      });
      child.on("exit", (code) => failed(new Error(`the server ended with ${code}: ${said}`)));
    });
  }

  async stop(): Promise<void> {
    const child = this.process;
    this.process = undefined;
    if (!child || child.exitCode !== null) return;
    const ended = new Promise((done) => child.once("exit", done));
    child.kill("SIGTERM");
    await ended;
  }

  get url(): string {
    return `${this.scheme}://${this.address}/`;
  }
}

/** Serves the page from this folder instead of from the server: to work on the page without building the server. */
const pageFolder = process.env.SINEW_PAGE;

/** Every request that leaves for another host, and every error of the page, fails the test. */
export const test = base.extend<{ server: Server }>({
  server: async ({ page, context }, use) => {
    const server = new Server();
    // Pictures are drawn by software here, on all processors and as often as it can: fewer leave time to the rest.
    await context.addInitScript((least) => {
      const request = window.requestAnimationFrame.bind(window);
      const drawn = new WeakMap<FrameRequestCallback, number>();
      window.requestAnimationFrame = (draw) => {
        const due = (t: number): void => {
          if (t - (drawn.get(draw) ?? -Infinity) < least) request(due);
          else {
            drawn.set(draw, t);
            draw(t);
          }
        };
        return request(due);
      };
    }, PICTURE_MS);
    if (pageFolder)
      for (const [path, name] of [
        ["/", "index.html"],
        ["/viewer.js", "viewer.js"],
        ["/viewer.css", "viewer.css"],
      ])
        await context.route(
          (url) => url.pathname === path,
          async (r) =>
            r.fulfill({
              response: await r.fetch({ headers: { ...r.request().headers(), "accept-encoding": "identity" } }),
              path: join(pageFolder, name),
            }),
        );
    const foreign: string[] = [];
    const errors: string[] = [];
    context.on("request", (r) => {
      const url = new URL(r.url());
      if (!["data:", "blob:"].includes(url.protocol) && url.host !== server.address) foreign.push(r.url());
    });
    page.on("pageerror", (e) => errors.push(e.stack ?? e.message));
    page.on("console", (m) => {
      if (m.type() === "error" && /Content Security Policy|WebGL|THREE/.test(m.text())) errors.push(m.text());
    });
    await use(server);
    await server.stop();
    expect(foreign, "requests to other hosts").toEqual([]);
    expect(errors, "errors of the page").toEqual([]);
  },
});
export { expect };

export async function live(page: Page, url: string): Promise<void> {
  await page.goto(url);
  await expect(page.locator("body")).toHaveAttribute("data-phase", "live");
  await expect.poll(async () => Number(await page.locator("body").getAttribute("data-drawn"))).toBeGreaterThan(2);
}

export async function shot(page: Page, name: string): Promise<void> {
  await page.screenshot({ path: join(SHOTS, `${name}.png`) });
}

/** A row of the summary of the chosen figure. */
export function fact(page: Page, name: "state" | "margin" | "load" | "effort" | "error"): Locator {
  return page.locator(`#summary [data-fact=${name}]`);
}

/** How far the chosen figure is from the desired motion, degrees, as the summary says. */
export async function off(page: Page): Promise<number> {
  return Number(/^([\d.]+)° rms$/.exec(await fact(page, "error").innerText())?.[1]);
}

/** Drops a file on the page. */
export async function dropFile(page: Page, name: string, content: string): Promise<void> {
  const transfer = await page.evaluateHandle(
    ([name, content]) => {
      const data = new DataTransfer();
      data.items.add(new File([content], name));
      return data;
    },
    [name, content],
  );
  await page.dispatchEvent("body", "dragenter", { dataTransfer: transfer });
  await expect(page.locator("#drop")).toBeVisible();
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await expect(page.locator("#drop")).toBeHidden();
}

/** How many pixels differ between two pictures (PNG), by more than `threshold` of 255 in any colour. */
export async function differing(page: Page, a: Buffer, b: Buffer, threshold = 6): Promise<number> {
  return page.evaluate(
    async ([a, b, threshold]) => {
      const pixels = async (text: string): Promise<Uint8ClampedArray> => {
        const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))]));
        const canvas = new OffscreenCanvas(picture.width, picture.height);
        const ink = canvas.getContext("2d");
        ink?.drawImage(picture, 0, 0);
        return ink?.getImageData(0, 0, picture.width, picture.height).data ?? new Uint8ClampedArray();
      };
      const [x, y] = [await pixels(a), await pixels(b)];
      let count = 0;
      for (let i = 0; i < x.length; i += 4)
        if ([0, 1, 2].some((k) => Math.abs(x[i + k] - y[i + k]) > threshold)) count++;
      return count;
    },
    [a.toString("base64"), b.toString("base64"), threshold] as const,
  );
}

/** How many pixels of a picture (PNG) have this colour (0xrrggbb), to within 24 of 255 in each. */
export async function coloured(page: Page, picture: Buffer, colour: number): Promise<number> {
  return page.evaluate(
    async ([text, colour]) => {
      const shown = await createImageBitmap(new Blob([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))]));
      const ink = new OffscreenCanvas(shown.width, shown.height).getContext("2d");
      ink?.drawImage(shown, 0, 0);
      const pixels = ink?.getImageData(0, 0, shown.width, shown.height).data ?? new Uint8ClampedArray();
      const want = [colour >> 16, (colour >> 8) & 255, colour & 255];
      let count = 0;
      for (let i = 0; i < pixels.length; i += 4) if (want.every((c, k) => Math.abs(c - pixels[i + k]) < 24)) count++;
      return count;
    },
    [picture.toString("base64"), colour] as const,
  );
}

/** A call over gRPC-Web from the test's own side. */
export { Sinew } from "../src/client.js";
