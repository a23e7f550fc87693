// The message vectors that all clients read: written alike, answered alike.
import { create, fromBinary, fromJson, toBinary, toJson, type DescMessage, type DescMethod, type JsonValue, type Message } from "@bufbuild/protobuf";
import { BinaryReader } from "@bufbuild/protobuf/wire";
import { Code, ConnectError } from "@connectrpc/connect";
import { createGrpcWebTransport } from "@connectrpc/connect-web";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { BodyService } from "../src/gen/sinew/v1/body_pb.js";
import { FigureService } from "../src/gen/sinew/v1/figure_pb.js";
import { MotionService } from "../src/gen/sinew/v1/motion_pb.js";
import { PerturbationService } from "../src/gen/sinew/v1/perturbation_pb.js";
import { ServerService } from "../src/gen/sinew/v1/server_pb.js";
import { SimulationService } from "../src/gen/sinew/v1/simulation_pb.js";
import { StateService } from "../src/gen/sinew/v1/state_pb.js";
import { WorldService } from "../src/gen/sinew/v1/world_pb.js";
import { expect, root, test } from "./support.js";

const SERVICES = [BodyService, FigureService, MotionService, PerturbationService, ServerService, SimulationService, StateService, WorldService];
const folder = join(root, "tests/conformance");

interface Outcome {
  code: string;
  reason?: string;
  field?: string;
  resource?: string;
  response?: JsonValue;
}
interface Vector {
  name: string;
  method: string;
  request: JsonValue;
  wire: string;
  outcome: Outcome;
}

function method(name: string): DescMethod {
  const [service, rpc] = name.split("/");
  const found = SERVICES.find((s) => s.typeName === service)?.methods.find((m) => m.name === rpc);
  if (!found) throw new Error(`no method ${name}`);
  return found;
}

/** Strings of a message by field number, those of nested messages after a dot. */
function strings(bytes: Uint8Array, nested: number[] = []): Map<string, string> {
  const out = new Map<string, string>();
  const reader = new BinaryReader(bytes);
  while (reader.pos < reader.len) {
    const [no, wire] = reader.tag();
    if (wire !== 2) reader.skip(wire);
    else if (nested.includes(no)) for (const [k, v] of strings(reader.bytes())) out.set(`${no}.${k}`, v);
    else out.set(String(no), new TextDecoder().decode(reader.bytes()));
  }
  return out;
}

/** What an error says in its details: google.rpc ErrorInfo, BadRequest and ResourceInfo. */
function details(error: ConnectError): Outcome {
  const out: Outcome = { code: Code[error.code].replace(/(.)([A-Z])/g, "$1_$2").toUpperCase() };
  for (const d of error.details) {
    if (!("type" in d) || !(d.value instanceof Uint8Array)) continue;
    if (d.type === "google.rpc.ErrorInfo") {
      out.reason = strings(d.value, [3]).get("1");
      expect(strings(d.value, [3]).get("2")).toBe("sinew");
    }
    if (d.type === "google.rpc.BadRequest") out.field = strings(d.value, [1]).get("1.1");
    if (d.type === "google.rpc.ResourceInfo") out.resource = strings(d.value).get("2");
  }
  return out;
}

/** Every member of `wanted` is in `got` with an equal value; an absent one has its default. */
function holds(wanted: JsonValue, got: JsonValue | undefined, at: string): void {
  if (Array.isArray(wanted)) {
    expect(Array.isArray(got) ? got.length : 0, at).toBe(wanted.length);
    wanted.forEach((w, i) => holds(w, (got as JsonValue[])[i], `${at}[${i}]`));
  } else if (wanted !== null && typeof wanted === "object") {
    for (const [key, value] of Object.entries(wanted)) holds(value, (got as Record<string, JsonValue> | undefined)?.[key], `${at}.${key}`);
  } else if (typeof wanted === "number") {
    expect(Math.abs(Number(got ?? 0) - wanted), `${at}: ${String(got)}`).toBeLessThanOrEqual(1e-9 * Math.abs(wanted));
  } else {
    const nothing = typeof wanted === "string" ? ["0", "", undefined] : [false, undefined];
    if (got === undefined) expect(nothing.concat(String(wanted).endsWith("_UNSPECIFIED") ? [wanted as string] : []), at).toContain(wanted);
    else expect(got, at).toBe(wanted);
  }
}

async function call(address: string, rpc: DescMethod, request: Message): Promise<JsonValue> {
  const transport = createGrpcWebTransport({ baseUrl: address });
  const answer = async (): Promise<Message> => {
    if (rpc.methodKind === "unary") return (await transport.unary(rpc as DescMethod & { methodKind: "unary" }, undefined, 20_000, undefined, request)).message as Message;
    const stop = new AbortController();
    async function* one(): AsyncIterable<Message> {
      yield request;
    }
    const stream = await transport.stream(rpc as DescMethod & { methodKind: "server_streaming" }, stop.signal, 20_000, undefined, one());
    for await (const first of stream.message) {
      stop.abort();
      return first as Message;
    }
    return create(rpc.output as DescMessage);
  };
  return toJson(rpc.output, await answer());
}

const hex = (bytes: Uint8Array): string => Buffer.from(bytes).toString("hex");

for (const file of readdirSync(folder).filter((f) => f.endsWith(".json")))
  test(`conformance: ${file}`, async ({ server }) => {
    await server.start("--no-demo");
    const { vectors } = JSON.parse(readFileSync(join(folder, file), "utf8")) as { vectors: Vector[] };
    expect(vectors.length).toBeGreaterThan(3);
    for (const v of vectors) {
      const rpc = method(v.method);
      const request = fromJson(rpc.input, v.request);
      expect(hex(toBinary(rpc.input, request)), `${v.name}: wire`).toBe(v.wire);
      expect(hex(toBinary(rpc.input, fromBinary(rpc.input, Buffer.from(v.wire, "hex")))), `${v.name}: wire again`).toBe(v.wire);
      let outcome: Outcome;
      try {
        outcome = { code: "OK", response: await call(server.url.slice(0, -1), rpc, request) };
      } catch (error) {
        outcome = details(ConnectError.from(error));
      }
      expect(outcome.code, `${v.name}: code`).toBe(v.outcome.code);
      expect(outcome.reason, `${v.name}: reason`).toBe(v.outcome.reason);
      expect(outcome.field, `${v.name}: field`).toBe(v.outcome.field);
      if (v.outcome.resource !== undefined) expect(outcome.resource, `${v.name}: resource`).toBe(v.outcome.resource);
      if (v.outcome.response !== undefined) holds(v.outcome.response, outcome.response, v.name);
    }
  });
