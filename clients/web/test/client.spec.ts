// The TypeScript client in Node, against a real server.
import { setTimeout as sleep } from "node:timers/promises";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { readHistory, watchWorld } from "../src/client.js";
import { expect, Sinew, test } from "./support.js";

test("a stream that is silent ends with its signal", async ({ server }) => {
  await server.start("--no-demo");
  const api = new Sinew(`http://${server.address}`);
  await api.worlds.createWorld({ worldId: "quiet", paused: true });
  setFlagsFromString("--expose_gc");
  const collect = runInNewContext("gc") as () => void;
  const over = new AbortController();
  let begun = false;
  const watching = (async (): Promise<string> => {
    try {
      // The first message says that the watch has begun; nothing happens afterwards.
      for await (const { events } of api.state.watchEvents({ world: "worlds/quiet" }, { signal: over.signal }))
        begun = events.length === 0;
      return "it ended";
    } catch (error) {
      return String(error);
    }
  })();
  await expect.poll(() => begun).toBe(true);
  // What only the request holds is collected.
  for (let i = 0; i < 5; i++) {
    collect();
    await sleep(20);
  }
  over.abort();
  expect(await Promise.race([watching, sleep(10_000, "it goes on")])).toContain("abort");
});

test("who joins late reads what was and goes on from there without a gap", async ({ server }) => {
  await server.start("--no-demo");
  const api = new Sinew(`http://${server.address}`);
  const world = (await api.worlds.createWorld({ worldId: "late", paused: true })).world!.name;
  await api.figures.createFigure({ parent: world, figureId: "anna" });
  await api.worlds.stepWorld({ name: world, tickCount: 20 });
  const view = { fields: { paths: ["root_pose"] } };
  const ticks: bigint[] = [];
  for await (const part of readHistory(api, { name: world, view, firstTick: 5n }))
    for (const { frame, roster } of part) {
      expect(roster.figures.map((f) => f.figureId)).toEqual(["anna"]);
      ticks.push(frame.tick);
    }
  expect(ticks).toEqual(Array.from({ length: 16 }, (_, i) => BigInt(i + 5)));
  await api.worlds.stepWorld({ name: world, tickCount: 3 });
  const late: bigint[] = [];
  for await (const { frame, roster } of watchWorld(api, { world, view, resumeTick: ticks[15] })) {
    expect(roster.figures.length).toBe(1);
    if (late.push(frame.tick) === 3) break;
  }
  expect(late).toEqual([21n, 22n, 23n]);
});
