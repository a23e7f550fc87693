// The vectors of tests/conformance, and the small client, over gRPC-Web from Node. The same files are read in Rust and
// Python.
import {
  createRegistry,
  fromBinary,
  fromJson,
  toBinary,
  toJson,
  type DescMessage,
  type DescMethodStreaming,
  type DescMethodUnary,
  type JsonValue,
  type Message,
} from "@bufbuild/protobuf";
import { Code, ConnectError } from "@connectrpc/connect";
import { createGrpcWebTransport } from "@connectrpc/connect-web";
import { execFile } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { details } from "../src/client.js";
import { file_sinew_v1_body } from "../src/gen/sinew/v1/body_pb.js";
import { file_sinew_v1_figure } from "../src/gen/sinew/v1/figure_pb.js";
import { file_sinew_v1_motion } from "../src/gen/sinew/v1/motion_pb.js";
import { file_sinew_v1_obstacle } from "../src/gen/sinew/v1/obstacle_pb.js";
import { file_sinew_v1_operation } from "../src/gen/sinew/v1/operation_pb.js";
import { file_sinew_v1_perturbation } from "../src/gen/sinew/v1/perturbation_pb.js";
import { file_sinew_v1_server } from "../src/gen/sinew/v1/server_pb.js";
import { file_sinew_v1_simulation } from "../src/gen/sinew/v1/simulation_pb.js";
import { file_sinew_v1_state } from "../src/gen/sinew/v1/state_pb.js";
import { file_sinew_v1_world } from "../src/gen/sinew/v1/world_pb.js";
import { expect, program, Server } from "./support.js";
import { test } from "@playwright/test";

interface Vector {
  name: string;
  method: string;
  request: JsonValue;
  wire: string;
  outcome: { code: string; reason?: string; field?: string; resource?: string; response?: JsonValue };
}

const here = dirname(fileURLToPath(import.meta.url));
const folder = join(here, "../../../tests/conformance");
const registry = createRegistry(
  file_sinew_v1_body,
  file_sinew_v1_figure,
  file_sinew_v1_motion,
  file_sinew_v1_obstacle,
  file_sinew_v1_operation,
  file_sinew_v1_perturbation,
  file_sinew_v1_server,
  file_sinew_v1_simulation,
  file_sinew_v1_state,
  file_sinew_v1_world,
);

/** Whether all that is wanted is there; what is absent has its default. Gives the place of the first difference. */
function missing(wanted: JsonValue, given: JsonValue | undefined, place: string): string | undefined {
  if (Array.isArray(wanted)) {
    const list = given === undefined ? [] : given;
    if (!Array.isArray(list) || list.length !== wanted.length) return `${place}: ${JSON.stringify(given)}`;
    for (const [i, w] of wanted.entries()) {
      const found = missing(w, list[i], `${place}[${i}]`);
      if (found) return found;
    }
    return undefined;
  }
  if (wanted !== null && typeof wanted === "object") {
    if (given === null || typeof given !== "object" || Array.isArray(given))
      return `${place}: ${JSON.stringify(given)}`;
    for (const [key, w] of Object.entries(wanted)) {
      const found = missing(w, given[key], `${place}.${key}`);
      if (found) return found;
    }
    return undefined;
  }
  const defaults: unknown[] = [0, "0", "", false, null];
  const same =
    given === undefined
      ? defaults.includes(wanted)
      : typeof wanted === "number" && typeof given === "number"
        ? Math.abs(wanted - given) <= 1e-9 * Math.abs(wanted)
        : wanted === given;
  return same ? undefined : `${place}: ${JSON.stringify(given)} instead of ${JSON.stringify(wanted)}`;
}

const hex = (bytes: Uint8Array): string => Buffer.from(bytes).toString("hex");
const codeName = (code: Code): string => Code[code].replace(/(?!^)([A-Z])/g, "_$1").toUpperCase();

/** What comes of a request: of a stream, its first message. */
async function call(address: string, method: string, input: Message): Promise<{ desc: DescMessage; message: Message }> {
  const [service, name] = method.split("/");
  const desc = registry.getService(service)?.methods.find((m) => m.name === name);
  if (!desc) throw new Error(`no method ${method}`);
  const transport = createGrpcWebTransport({ baseUrl: address });
  if (desc.methodKind === "unary")
    return {
      desc: desc.output,
      message: (await transport.unary(desc as DescMethodUnary, undefined, undefined, undefined, input)).message,
    };
  if (desc.methodKind !== "server_streaming") throw new Error(`${method} takes a stream`);
  const stop = new AbortController();
  const one = async function* (): AsyncIterable<Message> {
    yield input;
  };
  const answer = await transport.stream(desc as DescMethodStreaming, stop.signal, undefined, undefined, one());
  for await (const message of answer.message) {
    stop.abort();
    return { desc: desc.output, message };
  }
  throw new Error(`${method} ended without a message`);
}

const server = new Server();
test.describe("conformance", () => {
  test.beforeAll(() => server.start("--no-demo"));
  test.afterAll(() => server.stop());

  for (const file of readdirSync(folder).filter((f) => f.endsWith(".json")))
    test(file, async () => {
      const { vectors } = JSON.parse(readFileSync(join(folder, file), "utf8")) as { vectors: Vector[] };
      expect(vectors.length).toBeGreaterThan(0);
      const wrong: string[] = [];
      for (const { name, method, request, wire, outcome } of vectors) {
        const [service, short] = method.split("/");
        const input = registry.getService(service)?.methods.find((m) => m.name === short)?.input;
        if (!input) throw new Error(`${name}: no method ${method}`);
        const message = fromJson(input, request, { registry });
        if (hex(toBinary(input, message)) !== wire) wrong.push(`${name}: written as ${hex(toBinary(input, message))}`);
        if (hex(toBinary(input, fromBinary(input, Buffer.from(wire, "hex")))) !== wire)
          wrong.push(`${name}: not written as it was read`);
        try {
          const answer = await call(`http://${server.address}`, method, message);
          if (outcome.code !== "OK") wrong.push(`${name}: OK instead of ${outcome.code}`);
          const difference =
            outcome.response &&
            missing(outcome.response, toJson(answer.desc, answer.message, { registry }), "response");
          if (difference) wrong.push(`${name}: ${difference}`);
        } catch (error) {
          if (!(error instanceof ConnectError)) throw error;
          const { reason, field, resource } = details(error);
          const told = { code: codeName(error.code), reason, field, resource };
          const wanted = {
            code: outcome.code,
            reason: outcome.reason,
            field: outcome.field,
            resource: outcome.resource ?? resource,
          };
          if (JSON.stringify(told) !== JSON.stringify(wanted))
            wrong.push(`${name}: ${JSON.stringify(told)} instead of ${JSON.stringify(wanted)} (${error.rawMessage})`);
        }
      }
      expect(wrong).toEqual([]);
    });

  test("the small client says what the one in Rust says", async () => {
    const run = promisify(execFile);
    const address = `http://${server.address}`;
    const typescript = await run(process.execPath, ["run.mjs", "../examples/typescript/client.ts", address], {
      cwd: join(here, ".."),
    });
    const rust = await run(join(dirname(program), "examples/client"), [address]);
    expect(typescript.stdout).toBe(rust.stdout);
    expect(typescript.stdout).toMatch(
      /^(\d\.\d\d s {2}right shoulder -?[\d.]+ of [\d.]+ N·m\n){8}state [0-9a-f]{16}\n$/,
    );
  });
});
