// What one picture shows of a world: the frames around a moment, and who was there. The present comes from the frames
// that stream in, the past from those that are kept.
import { create } from "@bufbuild/protobuf";
import type { Body } from "./gen/sinew/v1/body_pb.js";
import { FigureSchema } from "./gen/sinew/v1/figure_pb.js";
import type { FigureFrame, WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import type { Roster } from "./gen/sinew/v1/state_pb.js";
import type { Around, Past } from "./history.js";
import { HISTORY_S, Person } from "./model.js";
import type { Session } from "./session.js";

/** What one picture shows. */
export interface Moment {
  before: WorldFrame;
  after: WorldFrame;
  /** Share of the second frame. */
  share: number;
  /** World time, s. */
  time: number;
  /** Who was there, by index. */
  people: ReadonlyMap<number, Person>;
  /** Whether it is the moment that was asked for, and not the nearest one that there is. */
  exact: boolean;
}

/** How often what lies around a moment that moves is asked for, ms. */
const ASK_MS = 250;

const byFrame = new WeakMap<WorldFrame, Map<number, FigureFrame>>();
/** The figures of a frame by index. */
export function indexed(frame: WorldFrame): Map<number, FigureFrame> {
  let map = byFrame.get(frame);
  if (!map) {
    map = new Map(frame.figures.map((f) => [f.figureIndex, f]));
    byFrame.set(frame, map);
  }
  return map;
}

/** World time of a picture between two frames, s. */
export const timeOf = (m: { before: WorldFrame; after: WorldFrame; share: number }): number =>
  m.before.timeS + m.share * (m.after.timeS - m.before.timeS);

/** The past of the world of a session, as people who can be drawn like those of the present. */
export class PastPeople {
  /** Everyone who was ever seen, by index, name and body. */
  private readonly all = new Map<string, Person>();
  private readonly bodies = new Map<string, Body>();
  private roster: Roster | undefined;
  private people: ReadonlyMap<number, Person> = new Map();
  private shown: WorldFrame | undefined;
  private asked = -Infinity;
  private past: Past | undefined;
  private version = -1;

  constructor(private readonly session: Session) {}

  /**
   * The moment at this time (s); what is missing of it is asked for. `chosen`: whose torques of the seconds before are
   * wanted, too.
   */
  at(time: number, chosen: string): Moment | undefined {
    const { past } = this.session;
    if (past !== this.past) {
      // Another world: its people are others, even if they have the same names.
      this.past = past;
      this.all.clear();
      this.roster = this.shown = undefined;
    }
    if (performance.now() - this.asked > ASK_MS) {
      this.asked = performance.now();
      past?.lookAt(time);
    }
    const around = this.session.playhead.around(time);
    const roster = this.session.roster;
    const found: Around | undefined =
      around && roster
        ? {
            before: { frame: around.before, roster },
            after: { frame: around.after, roster },
            share: around.share,
            exact: true,
          }
        : past?.at(time);
    if (!found) return undefined;
    const { before, after, share, exact } = found;
    this.cast(after.roster);
    const moment = { before: before.frame, after: after.frame, share, people: this.people, exact };
    this.bring(after.frame, chosen);
    return { ...moment, time: exact ? time : timeOf(moment) };
  }

  /** Who is in a roster. A body that is not known yet is asked for, and its figure left out meanwhile. */
  private cast(roster: Roster): void {
    if (roster === this.roster) return;
    const people = new Map<number, Person>();
    let whole = true;
    for (const { figureIndex, figureId, body } of roster.figures) {
      const key = `${figureIndex} ${figureId} ${body}`;
      const known = this.bodies.get(body);
      if (!known) {
        whole = false;
        this.session.body(body).then(
          (b) => this.bodies.set(body, b),
          () => undefined,
        );
        continue;
      }
      const now = this.session.people.get(figureIndex);
      const person = this.all.get(key) ?? new Person(figureIndex, figureId, known, create(FigureSchema));
      if (now?.name === figureId) person.figure = now.figure;
      this.all.set(key, person);
      people.set(figureIndex, person);
    }
    this.people = people;
    this.roster = whole ? roster : undefined;
  }

  /** Lets people be as in a frame. */
  private bring(frame: WorldFrame, chosen: string): void {
    const version = this.past?.version ?? 0;
    // Frames of the seconds before come later than the moment itself.
    const more = version !== this.version;
    this.version = version;
    if (frame === this.shown && !more) return;
    const last = this.shown?.timeS ?? NaN;
    this.shown = frame;
    // A jump: the seconds before are others.
    const jumps = !(frame.timeS >= last && frame.timeS - last < 0.5);
    for (const p of this.people.values()) {
      if (jumps) p.limitSince.fill(NaN);
      if ((jumps || more) && p.name === chosen) {
        p.history.length = 0;
        for (const k of this.session.past?.before(frame.timeS, HISTORY_S) ?? []) {
          const f = indexed(k.frame).get(p.index);
          if (f) p.take(f, k.frame.timeS);
        }
      }
      const f = indexed(frame).get(p.index);
      if (f) p.take(f, frame.timeS);
    }
  }
}
