// Runs a TypeScript file in Node: `node run.mjs FILE [ARGUMENT…]`. Node 20 does not read TypeScript; esbuild is there
// for the bundle.
import { build } from "esbuild";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [file, ...rest] = process.argv.slice(2);
if (!file) throw new Error("usage: node run.mjs FILE [ARGUMENT…]");
const folder = mkdtempSync(join(tmpdir(), "sinew-run-"));
const outfile = join(folder, "program.mjs");
try {
  await build({
    entryPoints: [resolve(file)],
    outfile,
    bundle: true,
    platform: "node",
    format: "esm",
    target: "node20",
    logLevel: "warning",
  });
  process.argv = [process.argv[0], resolve(file), ...rest];
  await import(pathToFileURL(outfile).href);
} finally {
  rmSync(folder, { recursive: true });
}
