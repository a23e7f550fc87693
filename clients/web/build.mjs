// Bundles the viewer into dist, the folder that the server embeds. `--check` builds beside it and compares all bytes.
import { build } from "esbuild";
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, copyFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, dirname } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const check = process.argv.includes("--check");
const dist = join(here, "dist");
const out = check ? mkdtempSync(join(tmpdir(), "sinew-web-")) : dist;
const LARGEST = 1_500_000;

mkdirSync(out, { recursive: true });
await build({
  absWorkingDir: here,
  entryPoints: [{ in: "src/main.ts", out: "viewer" }],
  outdir: out,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "eof",
  charset: "utf8",
  logLevel: "warning",
});
for (const name of readdirSync(join(here, "public"))) copyFileSync(join(here, "public", name), join(out, name));

let total = 0;
let differs = [];
for (const name of readdirSync(out).sort()) {
  const bytes = readFileSync(join(out, name));
  total += bytes.length;
  if (check) {
    let kept = Buffer.alloc(0);
    try {
      kept = readFileSync(join(dist, name));
    } catch {
      // Missing counts as different.
    }
    if (!kept.equals(bytes)) differs.push(name);
  }
}
if (check) rmSync(out, { recursive: true });
console.log(`bundle: ${total} bytes`);
if (total > LARGEST) throw new Error(`the bundle has ${total} bytes, more than ${LARGEST}`);
if (differs.length)
  throw new Error(`dist is not what the source builds: ${differs.join(", ")}; run npm run build and commit it`);
