// The TypeScript client: typed calls over gRPC-Web, and numbers of frames as arrays. Works in browsers and in Node.
import { BinaryReader, WireType } from "@bufbuild/protobuf/wire";
import type { MessageInitShape } from "@bufbuild/protobuf";
import {
  Code,
  ConnectError,
  createClient,
  type CallOptions,
  type Client,
  type Interceptor,
  type Transport,
} from "@connectrpc/connect";
import { createGrpcWebTransport } from "@connectrpc/connect-web";
import { AccessService } from "./gen/sinew/v1/access_pb.js";
import { BodyService } from "./gen/sinew/v1/body_pb.js";
import { CheckpointService } from "./gen/sinew/v1/checkpoint_pb.js";
import { ControlService } from "./gen/sinew/v1/control_pb.js";
import { FigureService } from "./gen/sinew/v1/figure_pb.js";
import type { WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import { HistoryService, type ReadHistoryRequestSchema } from "./gen/sinew/v1/history_pb.js";
import { MotionService } from "./gen/sinew/v1/motion_pb.js";
import { ObstacleService } from "./gen/sinew/v1/obstacle_pb.js";
import { OperationService } from "./gen/sinew/v1/operation_pb.js";
import { PerturbationService } from "./gen/sinew/v1/perturbation_pb.js";
import { RecordingService } from "./gen/sinew/v1/recording_pb.js";
import { ServerService } from "./gen/sinew/v1/server_pb.js";
import { SimulationService } from "./gen/sinew/v1/simulation_pb.js";
import { StateService, type Roster, type WatchWorldRequestSchema } from "./gen/sinew/v1/state_pb.js";
import type { Numbers } from "./gen/sinew/v1/types_pb.js";
import { WorldService } from "./gen/sinew/v1/world_pb.js";

/** Puts a bearer token into every request. */
function bearer(token: string): Interceptor {
  return (next) => (request) => {
    request.header.set("authorization", `Bearer ${token}`);
    return next(request);
  };
}

/**
 * `fetch` whose answers end with their signal. Node holds the link between the signal and a request weakly: it may be
 * collected while an answer is awaited, and a stream that is silent then goes on after it was aborted, with its
 * connection.
 */
const abortable: typeof fetch = async (input, init) => {
  const response = await fetch(input, init);
  const signal = init?.signal;
  if (!signal || !response.body) return response;
  const reader = response.body.getReader();
  const body = new ReadableStream<Uint8Array>({
    start(controller): void {
      const abort = (): void => {
        controller.error(signal.reason);
        reader.cancel(signal.reason).catch(() => undefined);
      };
      if (signal.aborted) abort();
      else signal.addEventListener("abort", abort, { once: true });
    },
    async pull(controller): Promise<void> {
      const { done, value } = await reader.read();
      if (signal.aborted) return;
      if (done) controller.close();
      else controller.enqueue(value);
    },
    cancel: (reason) => reader.cancel(reason),
  });
  return new Response(body, response);
};

/** gRPC-Web over the platform's `fetch`, with a bearer token if there is one. */
export function connect(address: string, token = ""): Transport {
  return createGrpcWebTransport({
    baseUrl: address,
    interceptors: token ? [bearer(token)] : [],
    ...(typeof document === "undefined" && { fetch: abortable }),
  });
}

/** Every service of one server. */
export class Sinew {
  readonly access: Client<typeof AccessService>;
  readonly bodies: Client<typeof BodyService>;
  readonly checkpoints: Client<typeof CheckpointService>;
  readonly control: Client<typeof ControlService>;
  readonly figures: Client<typeof FigureService>;
  readonly history: Client<typeof HistoryService>;
  readonly motion: Client<typeof MotionService>;
  readonly obstacles: Client<typeof ObstacleService>;
  readonly operations: Client<typeof OperationService>;
  readonly perturbations: Client<typeof PerturbationService>;
  readonly recordings: Client<typeof RecordingService>;
  readonly server: Client<typeof ServerService>;
  readonly simulations: Client<typeof SimulationService>;
  readonly state: Client<typeof StateService>;
  readonly worlds: Client<typeof WorldService>;

  /** `address`: for example `http://127.0.0.1:7463`; in a page that the server gave, `location.origin`. */
  constructor(address: string, transport: Transport = connect(address)) {
    this.access = createClient(AccessService, transport);
    this.bodies = createClient(BodyService, transport);
    this.checkpoints = createClient(CheckpointService, transport);
    this.control = createClient(ControlService, transport);
    this.figures = createClient(FigureService, transport);
    this.history = createClient(HistoryService, transport);
    this.motion = createClient(MotionService, transport);
    this.obstacles = createClient(ObstacleService, transport);
    this.operations = createClient(OperationService, transport);
    this.perturbations = createClient(PerturbationService, transport);
    this.recordings = createClient(RecordingService, transport);
    this.server = createClient(ServerService, transport);
    this.simulations = createClient(SimulationService, transport);
    this.state = createClient(StateService, transport);
    this.worlds = createClient(WorldService, transport);
  }
}

/** A frame, and who its figures are. */
export interface FrameOf {
  readonly frame: WorldFrame;
  readonly roster: Roster;
}

/**
 * The past of a world from `firstTick` to `lastTick`, as far as it is held: frames as they come, some at a time. To go
 * on from there without a gap: `watchWorld` with `resumeTick`.
 */
export async function* readHistory(
  api: Sinew,
  request: MessageInitShape<typeof ReadHistoryRequestSchema>,
  options?: CallOptions,
): AsyncGenerator<FrameOf[]> {
  let roster: Roster | undefined;
  for await (const part of api.history.readHistory(request, options)) {
    roster = part.roster ?? roster;
    const known = roster;
    if (known) yield part.frames.map((frame) => ({ frame, roster: known }));
  }
}

/** Frames of a world as they come; those after `resumeTick` first, as far as they are held. */
export async function* watchWorld(
  api: Sinew,
  request: MessageInitShape<typeof WatchWorldRequestSchema>,
  options?: CallOptions,
): AsyncGenerator<FrameOf> {
  let roster: Roster | undefined;
  for await (const { message } of api.state.watchWorld(request, options)) {
    if (message.case === "roster") roster = message.value;
    else if (message.case === "frame" && roster) yield { frame: message.value, roster };
  }
}

/** The numbers of a packed array, whatever their encoding; empty when the field is absent. */
export function numbers(packed: Numbers | undefined): ArrayLike<number> {
  if (!packed) return [];
  if (packed.f32.length) return packed.f32;
  if (packed.f64.length) return packed.f64;
  const view = new DataView(packed.i16.buffer, packed.i16.byteOffset, packed.i16.byteLength);
  return Array.from({ length: packed.i16.byteLength >> 1 }, (_, i) => view.getInt16(2 * i, true) * packed.scale);
}

/** Whether trying again may help: the server is away, starting or shutting down. */
export function isConnectionLoss(error: unknown): boolean {
  if (!(error instanceof ConnectError)) return error instanceof TypeError;
  return [Code.Unavailable, Code.Unknown, Code.Aborted, Code.Internal, Code.Canceled, Code.DeadlineExceeded].includes(
    error.code,
  );
}

/** What a person should read about an error. */
export function message(error: unknown): string {
  if (error instanceof ConnectError) return error.rawMessage || Code[error.code];
  return error instanceof Error ? error.message : String(error);
}

/** What the server says about an error beside its words. */
export interface Details {
  /** For programs, for example `INVALID_FIELD`. */
  reason?: string;
  /** The part of the request that was wrong, for example `world.rate_hz`. */
  field?: string;
  /** Name of the resource that is missing, taken or full. */
  resource?: string;
}

/** Members of a message that are text or messages themselves, by number; the first of each. */
function members(bytes: Uint8Array): Map<number, Uint8Array> {
  const found = new Map<number, Uint8Array>();
  const reader = new BinaryReader(bytes);
  while (reader.pos < reader.len) {
    const [number, type] = reader.tag();
    if (type !== WireType.LengthDelimited) reader.skip(type, number);
    else {
      const value = reader.bytes();
      if (!found.has(number)) found.set(number, value);
    }
  }
  return found;
}

/** The details of an error: of `google.rpc`, ErrorInfo, the first violation of BadRequest, and ResourceInfo. */
export function details(error: unknown): Details {
  const out: Details = {};
  if (!(error instanceof ConnectError)) return out;
  const text = (bytes: Uint8Array | undefined): string | undefined => bytes && new TextDecoder().decode(bytes);
  for (const d of error.details) {
    if (!("type" in d)) continue;
    const found = members(d.value as Uint8Array);
    if (d.type === "google.rpc.ErrorInfo") out.reason = text(found.get(1));
    if (d.type === "google.rpc.BadRequest") out.field = text(members(found.get(1) ?? new Uint8Array()).get(1));
    if (d.type === "google.rpc.ResourceInfo") out.resource = text(found.get(2));
  }
  return out;
}
