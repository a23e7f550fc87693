// From names of the protocol to words for people.
import { ForecastVerdict, type Forecast } from "./gen/sinew/v1/motion_pb.js";
import { EventType, type Event } from "./gen/sinew/v1/state_pb.js";

/** `l_shoulder_flexion` or `l_shoulder` → `left shoulder`. */
export function joint(name: string): string {
  const parts = name.split("_");
  const side = parts[0] === "l" ? "left " : parts[0] === "r" ? "right " : "";
  return side + (side ? parts[1] : parts[0]);
}

/** `l_shoulder_flexion` → `left shoulder flexion`. */
export function dof(name: string): string {
  const parts = name.split("_");
  const side = parts[0] === "l" ? "left " : parts[0] === "r" ? "right " : "";
  return side + parts.slice(side ? 1 : 0).join(" ");
}

/** What will come of a clip, and why, in a line. */
export function forecast(f: Forecast): string {
  const follows = f.verdict === ForecastVerdict.FOLLOWS;
  const word = follows ? "should be followed" : f.verdict === ForecastVerdict.NEEDS_HELP ? "will need help" : "cannot be followed";
  return `forecast: ${word}: ${f.reason}`;
}

/** What is worth a caption of its own, or nothing. Limits of strength have captions that count, elsewhere. */
export function event(e: Event): { text: string; grave: boolean } | undefined {
  const who = e.figure;
  switch (e.type) {
    case EventType.BALANCE_LOST:
      return { text: `${who} loses balance`, grave: true };
    case EventType.RECOVERED:
      return { text: `${who} is in balance again`, grave: false };
    case EventType.FELL:
      return { text: `${who} has fallen`, grave: true };
    case EventType.GOT_UP:
      return { text: `${who} stands again`, grave: false };
    case EventType.LOAD_SLIPPED:
      return { text: `${short(e.massKg)} kg slip from the ${joint(e.segment)} of ${who}`, grave: true };
    case EventType.QUARANTINED:
      return { text: `${who} is frozen: its state became unusable`, grave: true };
    case EventType.DRIVE_BEGAN:
      return { text: `${who} is driven live${e.detail ? ` by ${e.detail}` : ""}`, grave: false };
    case EventType.DRIVE_ENDED:
      return { text: `${who} is no longer driven live`, grave: false };
    case EventType.WORLD_FAILED:
      return { text: `The world failed: ${e.detail}`, grave: true };
    default:
      return undefined;
  }
}

/** Three figures at most, no trailing zeros. */
export function short(value: number): string {
  return String(Number(value.toPrecision(value >= 100 ? 3 : 2)));
}
