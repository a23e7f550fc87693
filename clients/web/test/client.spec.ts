// The TypeScript client in Node, against a real server.
import { setTimeout as sleep } from "node:timers/promises";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
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
