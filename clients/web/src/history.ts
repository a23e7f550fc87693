// The last minutes of one world: frames that this page has seen, frames that the server simulates again for it, and
// what happened. Frames are kept up to a bound; what is missing is asked for in pieces, the one looked at first.
import { Code, ConnectError } from "@connectrpc/connect";
import { details, isConnectionLoss, message, readHistory, type FrameOf, type Sinew } from "./client.js";
import type { WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import { EventType, type Event, type Roster } from "./gen/sinew/v1/state_pb.js";

/** Frames per second that are kept: between them the picture is interpolated, as it is live. */
const KEPT_HZ = 30;
/** Frames of one figure that are kept, of all moments together: some 4 kB each. */
const MOST = 12_000;
/** Seconds that are asked for at a time. */
const PIECE_S = 5;
/** Frames farther apart than this (s) are not interpolated: something is missing between them. */
const CLOSE_S = 0.15;
/** Time after which a piece that did not help is asked for again, ms. */
const AGAIN_MS = 3000;
/** How often what is held is asked for, ms: it moves along with the world. */
const LOOK_MS = 5000;
/** Events that are kept. */
const MOST_EVENTS = 512;

/** A frame that is kept. */
export type Kept = FrameOf;

/** The frames around a moment. */
export interface Around {
  before: Kept;
  after: Kept;
  /** Share of the second. */
  share: number;
  /** Whether it is that moment, and not the nearest one that there is. */
  exact: boolean;
}

/** Events that come too often to be marks, or say nothing about people. */
const NO_MARKS = new Set([
  EventType.SUPPORT_GAINED,
  EventType.SUPPORT_LOST,
  EventType.SATURATED,
  EventType.RELIEVED,
  EventType.TOUCHED,
  EventType.PARTED,
  EventType.DRIVE_RESYNCED,
  EventType.CONTROL_ACQUIRED,
  EventType.CONTROL_RELEASED,
  EventType.CONTROL_PREEMPTED,
  EventType.CONTROL_OFFERED,
  EventType.ACCESS_REFUSED,
]);

/** The tick of a frame or an event as a number. */
export const tickOf = (of: { tick: bigint }): number => Number(of.tick);

export class Past {
  /** First tick that is held and last; −1: none. */
  oldest = -1;
  newest = -1;
  /** What happened that is worth a mark, by tick. */
  events: Event[] = [];
  /** Counts the changes of what is above. */
  version = 0;
  rateHz = 60;
  /** Why the piece that is looked at does not come; empty: it does. */
  trouble = "";
  private kept: Kept[] = [];
  private epoch = 0;
  /** The newest tick that has come here. */
  private seen = -1;
  /** The moment that is looked at, tick; none: the present. */
  private focus: number | undefined;
  private reading: { piece: number; stop: AbortController } | undefined;
  private readonly asked = new Map<number, number>();
  private looked = -Infinity;

  constructor(
    private readonly api: Sinew,
    readonly world: string,
    private readonly fields: string[],
  ) {}

  /** Ticks from one frame that is kept to the next. */
  private get divisor(): number {
    return Math.max(1, Math.round(this.rateHz / KEPT_HZ));
  }

  /** Takes a frame of the present. */
  add(frame: WorldFrame, roster: Roster): void {
    this.rateHz = roster.rateHz || this.rateHz;
    const tick = tickOf(frame);
    // The world went back, or became another one: what came later is no longer its past.
    if (this.epoch && (frame.epoch !== this.epoch || tick < this.seen)) this.forget(tick);
    this.epoch = frame.epoch;
    this.seen = tick;
    this.newest = Math.max(this.newest, tick);
    const last = this.kept.at(-1);
    if (last && tickOf(last.frame) === tick) this.kept[this.kept.length - 1] = { frame, roster };
    else if (!last || tick % this.divisor === 0 || tick - tickOf(last.frame) >= this.divisor)
      this.kept.push({ frame, roster });
    this.bound();
    if (performance.now() - this.looked > LOOK_MS) void this.look();
  }

  /** Takes an event of the present. */
  happened(e: Event): void {
    if (NO_MARKS.has(e.type)) return;
    if (e.type === EventType.WORLD_RESTORED) this.events = this.events.filter((o) => o.tick <= e.tick);
    this.events.push(e);
    if (this.events.length > MOST_EVENTS) this.events.shift();
    this.version++;
  }

  private forget(tick: number): void {
    this.reading?.stop.abort();
    this.asked.clear();
    this.kept = this.kept.filter((k) => tickOf(k.frame) < tick);
    this.events = this.events.filter((e) => tickOf(e) <= tick);
    this.newest = tick;
    this.looked = -Infinity;
    this.version++;
  }

  /** Asks what is held. */
  async look(): Promise<void> {
    this.looked = performance.now();
    const { epoch } = this;
    try {
      const held = await this.api.history.getHistory({ name: this.world });
      if (epoch && epoch !== this.epoch) return;
      this.oldest = Number(held.oldestTick);
      this.newest = Math.max(this.newest, Number(held.newestTick));
      const last = held.newestTick;
      // What was told meanwhile stays.
      this.events = [...held.events, ...this.events.filter((e) => e.tick > last)];
      this.version++;
    } catch {
      // The watch of frames ends with the same cause and says so.
    }
  }

  /** Looks at a moment (s of world time), or at the present again: what is missing there is asked for. */
  lookAt(time: number | undefined): void {
    this.focus = time === undefined ? undefined : time * this.rateHz;
    if (this.focus === undefined) this.reading?.stop.abort();
    else this.fetch();
  }

  /** The frames around a moment, or those that are nearest to it. */
  at(time: number): Around | undefined {
    const { kept } = this;
    if (!kept.length) return undefined;
    const i = this.first(time * this.rateHz);
    const [before, after] = [kept[i - 1], kept[i]];
    const period = 1.5 / this.rateHz;
    if (before && after) {
      const [a, b] = [before.frame.timeS, after.frame.timeS];
      if (b - a <= CLOSE_S) return { before, after, share: (time - a) / (b - a), exact: true };
      const one = time - a < b - time ? before : after;
      return { before: one, after: one, share: 1, exact: Math.abs(one.frame.timeS - time) < period };
    }
    const one = before ?? after;
    const off = Math.abs(one.frame.timeS - time);
    // Between the first tick that is held and the first frame that is kept lies less than a period of what is kept.
    return { before: one, after: one, share: 1, exact: off < this.divisor * period };
  }

  /** Frames of the seconds before a moment, for plots. */
  before(time: number, seconds: number): Kept[] {
    const from = this.first((time - seconds) * this.rateHz);
    return this.kept.slice(from, this.first(time * this.rateHz));
  }

  /** Index of the first frame at or after a tick. */
  private first(tick: number): number {
    let [low, high] = [0, this.kept.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (tickOf(this.kept[middle].frame) < tick) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** The last moment of which there is a frame, s. */
  get latest(): number {
    return this.kept.at(-1)?.frame.timeS ?? NaN;
  }

  /** Whether there is a frame for every moment of a piece that is held. */
  private complete(piece: number, size: number): boolean {
    const [from, until] = [Math.max(piece * size, this.oldest), Math.min((piece + 1) * size, this.newest)];
    const step = CLOSE_S * this.rateHz;
    for (let tick = from; tick < until; tick += step) if (!this.at(tick / this.rateHz)?.exact) return false;
    return true;
  }

  /** Asks for the piece that is looked at, or for what lies beside it. */
  private fetch(): void {
    const { focus } = this;
    if (focus === undefined || this.oldest < 0) return;
    const size = Math.max(this.divisor, Math.round(PIECE_S * this.rateHz));
    const here = Math.floor(Math.min(Math.max(focus, this.oldest), this.newest) / size);
    const now = performance.now();
    const may = (piece: number): boolean =>
      piece * size <= this.newest &&
      (piece + 1) * size > this.oldest &&
      now - (this.asked.get(piece) ?? -Infinity) > AGAIN_MS &&
      !this.complete(piece, size);
    // The moment itself may be there while its piece is not: then the piece comes, too, but nobody waits for it.
    const beside = this.most() > 4 * PIECE_S * KEPT_HZ ? [here - 1, here + 1] : [];
    const piece = [here, ...beside].find(may);
    if (this.reading) {
      if (this.reading.piece === here || this.at(focus / this.rateHz)?.exact) return;
      this.reading.stop.abort();
    }
    if (piece === undefined) return;
    this.asked.set(piece, now);
    void this.read(piece, size);
  }

  private async read(piece: number, size: number): Promise<void> {
    const reading = { piece, stop: new AbortController() };
    this.reading = reading;
    const first = Math.max(piece * size, this.oldest);
    const last = Math.min((piece + 1) * size, this.newest);
    let again = true;
    try {
      const answer = readHistory(
        this.api,
        {
          name: this.world,
          view: { fields: { paths: this.fields }, rateDivisor: this.divisor },
          firstTick: BigInt(first),
          lastTick: BigInt(last),
        },
        { signal: reading.stop.signal },
      );
      for await (const part of answer) {
        if (reading.stop.signal.aborted) break;
        this.merge(part);
      }
      this.trouble = "";
    } catch (error) {
      if (reading.stop.signal.aborted) this.asked.delete(piece);
      else again = this.failed(error);
    } finally {
      if (this.reading === reading) this.reading = undefined;
      if (again) this.fetch();
    }
  }

  /** What to do about a piece that did not come; whether to go on. */
  private failed(error: unknown): boolean {
    if (error instanceof ConnectError && error.code === Code.OutOfRange) {
      // It has been forgotten meanwhile.
      void this.look().then(() => this.fetch());
      return false;
    }
    this.trouble = details(error).reason === "SLOW_READER" ? "" : message(error);
    if (isConnectionLoss(error) || (error instanceof ConnectError && error.code === Code.ResourceExhausted))
      setTimeout(() => this.fetch(), AGAIN_MS + 100);
    return false;
  }

  private merge(fresh: FrameOf[]): void {
    if (!fresh.length) return;
    const [from, until] = [tickOf(fresh[0].frame), tickOf(fresh[fresh.length - 1].frame)];
    const a = this.first(from);
    const b = this.first(until + 1);
    this.kept = [...this.kept.slice(0, a), ...fresh, ...this.kept.slice(b)];
    this.bound();
    this.version++;
  }

  /** Forgets what is farthest from the moment that is looked at when there is too much. */
  private bound(): void {
    const { kept } = this;
    const most = this.most();
    if (kept.length <= most) return;
    const focus = this.focus ?? this.newest;
    if (focus - tickOf(kept[0].frame) >= this.newest - focus) kept.splice(0, kept.length - most);
    else kept.splice(most);
  }

  /** Frames that may be kept. Figures are about as many in all of them: an exact count is not worth its time. */
  private most(): number {
    return Math.max(2 * KEPT_HZ, Math.round(MOST / Math.max(1, this.kept.at(-1)?.frame.figures.length ?? 0)));
  }

  /** Frames that are kept, for tests. */
  get count(): number {
    return this.kept.length;
  }
}
