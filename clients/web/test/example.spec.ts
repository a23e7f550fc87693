// The small client of examples/ compiles and does what it says.
import { build } from "esbuild";
import { execFile } from "node:child_process";
import { join } from "node:path";
import { promisify } from "node:util";
import { expect, root, test } from "./support.js";

test("the example follows a motion from Node", async ({ server }, info) => {
  await server.start("--no-demo");
  const program = info.outputPath("follow.mjs");
  await build({ entryPoints: [join(root, "clients/web/examples/follow.ts")], outfile: program, bundle: true, platform: "node", format: "esm", target: "node20", logLevel: "warning" });
  const { stdout } = await promisify(execFile)(process.execPath, [program, server.url.slice(0, -1)], { timeout: 30_000 });
  const lines = stdout.trim().split("\n");
  expect(lines).toHaveLength(60);
  expect(lines.at(-1)).toMatch(/^\d+\.\d\d s {2}left knee -?\d+\.\d N·m$/);
});
