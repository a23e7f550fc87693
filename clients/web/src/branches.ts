// Branches: a new world made of a moment of this one, and both shown side by side, at the same time since that moment.
import { message } from "./client.js";
import { Role } from "./gen/sinew/v1/options_pb.js";
import type { Session } from "./session.js";

/** Two futures of one moment. */
export interface Pair {
  /** World that was branched. */
  original: string;
  /** World that was made of it. */
  branch: string;
  /** Tick at which they part. */
  since: number;
}

/** Lag below which the branch has caught up, and speed with which it does, s and s/s. */
const [NEAR_S, FAST] = [0.3, 4];

/** Names of roles in a sentence. */
function called(roles: Set<Role>): string {
  const names: [Role, string][] = [
    [Role.OWNER, "owner"],
    [Role.DIRECTOR, "director"],
    [Role.DRIVER, "driver"],
    [Role.PERTURBER, "perturber"],
    [Role.VIEWER, "viewer"],
  ];
  return names.find(([role]) => roles.has(role))?.[1] ?? "none";
}

/** Why a page with these roles cannot rewind its world; nothing if it can. */
export function cannotRewind(roles: Set<Role>): string | undefined {
  if (roles.has(Role.DIRECTOR)) return undefined;
  return `Only a director can rewind this world; your role is ${called(roles)}. The time line shows you its past.`;
}

/** Why a page with these roles cannot branch its world; nothing if it can. */
export function cannotBranch(roles: Set<Role>): string | undefined {
  if (!roles.has(Role.DIRECTOR)) return `Only a director can branch this world; your role is ${called(roles)}.`;
  return roles.has(Role.CREATOR) ? undefined : "A branch is a new world, and you may not create worlds here.";
}

/** Makes a paused world of a tick of a session's world; without one, of the present. */
export async function fork(session: Session, tick: number | undefined, name: string): Promise<Pair> {
  const original = session.world?.name ?? "";
  const { world } = await session.api.checkpoints.forkWorld({
    source: { case: "world", value: original },
    worldId: name,
    paused: true,
    tick: tick === undefined ? undefined : BigInt(tick),
  });
  if (!world) throw new Error("the server has made no world");
  const id = (of: string): string => of.slice("worlds/".length);
  return { original: id(original), branch: id(world.name), since: Number(world.tick) };
}

/** Lets a branch run faster until it is where the original is. */
export class CatchUp {
  private speed: number | undefined;

  constructor(private readonly say: (text: string, grave?: boolean) => void) {}

  get running(): boolean {
    return this.speed !== undefined;
  }

  async begin(branch: Session): Promise<void> {
    if (this.running) return;
    this.speed = branch.world?.speed ?? 1;
    try {
      if (branch.paused) await branch.setPaused(false);
      await branch.setSpeed(FAST);
    } catch (error) {
      this.speed = undefined;
      this.say(message(error), true);
    }
  }

  /** Ends it once the branch is near enough (s behind the original). */
  update(branch: Session, lag: number): void {
    if (this.speed === undefined || lag > NEAR_S) return;
    const speed = this.speed;
    this.speed = undefined;
    branch.setSpeed(speed).catch((error: unknown) => this.say(message(error), true));
  }
}
