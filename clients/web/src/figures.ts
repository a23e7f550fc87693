// Worlds and figures that the page makes.
import { message, type Sinew } from "./client.js";
import type { Person } from "./model.js";
import type { Anew } from "./panel.js";
import type { Session } from "./session.js";
import { settingsOf, type Address } from "./share.js";

/** A valid last part of a name that is not taken. */
export function fresh(base: string, taken: string[]): string {
  const clean =
    base
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, "-")
      .replace(/^[^a-z]+|-+$/g, "")
      .slice(0, 48) || "motion";
  if (!taken.includes(clean)) return clean;
  for (let n = 2; ; n++) if (!taken.includes(`${clean}-${n}`)) return `${clean}-${n}`;
}

/** Waits until something holds, or for some seconds. */
export async function until(condition: () => boolean): Promise<void> {
  for (let n = 0; n < 100 && !condition(); n++) await new Promise((done) => setTimeout(done, 30));
}

/** Makes a world, with the figures of an address; gives the last part of its name. */
export async function createWorld(api: Sinew, from?: Address): Promise<string | undefined> {
  const { world } = await api.worlds.createWorld({ worldId: from?.world ?? "" });
  if (!world) return undefined;
  for (const c of from?.figures ?? []) {
    const { figure } = await api.figures.createFigure({
      parent: world.name,
      figureId: c.id,
      figure: settingsOf(c),
    });
    if (figure && c.clip)
      await api.motion.playClip({ figure: figure.name, clip: `clips/${c.clip}`, loop: true, reset: true });
  }
  return world.name.slice("worlds/".length);
}

/** Adds a figure beside those that there are; it idles. */
export async function createFigure(session: Session, figureId: string, body: string): Promise<void> {
  const people = [...session.people.values()];
  const yM = people.length ? Math.min(...people.map((p) => p.figure.placement?.yM ?? 0)) - 1.2 : 0;
  const { figure } = await session.api.figures.createFigure({
    parent: session.world?.name ?? "",
    figureId,
    figure: { body, placement: { yM } },
  });
  if (figure) await session.api.motion.playClip({ figure: figure.name, clip: "clips/idle", loop: true, reset: true });
}

/** Makes a figure anew in its place, doing the same, with one thing changed; as it was if that is refused. */
export async function makeAnew(
  session: Session,
  p: Person,
  change: Anew,
  say: (text: string, grave: boolean) => void,
): Promise<void> {
  const f = p.figure;
  const parent = f.name.slice(0, f.name.indexOf("/figures/"));
  const { clip } = p;
  await session.api.figures.deleteFigure({ name: f.name });
  const same = {
    body: p.body.name,
    stepper: f.stepper,
    controller: f.controller,
    strength: f.strength,
    assist: f.assist,
    follow: f.follow,
    maxHelpWeights: f.maxHelpWeights,
    fatigueTimeScale: f.fatigueTimeScale,
    paper: f.paper,
    placement: f.placement,
  };
  const figure = {
    ...same,
    ...(change.body && { body: `bodies/${change.body}` }),
    ...(change.profile && { body: "", profile: change.profile }),
    ...(change.stepper && { stepper: change.stepper }),
  };
  let made;
  try {
    made = (await session.api.figures.createFigure({ parent, figureId: p.name, figure })).figure;
  } catch (error) {
    say(message(error), true);
    made = (await session.api.figures.createFigure({ parent, figureId: p.name, figure: same })).figure;
  }
  if (made && clip) await session.api.motion.playClip({ figure: made.name, clip, loop: true, reset: true });
}
