// Follows a motion on a server, through the TypeScript client:  node follow.js http://127.0.0.1:7463
import { numbers, Sinew } from "../src/client.js";

const sinew = new Sinew(process.argv[2] ?? "http://127.0.0.1:7463");
const { world } = await sinew.worlds.createWorld({ worldId: `follow-${process.pid}` });
const { figure } = await sinew.figures.createFigure({ parent: world?.name, figureId: "anna", figure: { body: "bodies/adult-woman" } });
await sinew.motion.playClip({ figure: figure?.name, clip: "clips/squat" });
await sinew.perturbations.applyPerturbations({
  world: world?.name,
  perturbations: [{ figure: "anna", kind: { case: "load", value: { segment: "chest", massKg: 10 } } }],
});

let seen = 0;
for await (const { message } of sinew.state.watchWorld({ world: world?.name, view: { rateDivisor: 2 } })) {
  if (message.case !== "frame") continue;
  const frame = message.value;
  const knee = numbers(frame.figures[0]?.torque)[26] ?? 0;
  console.log(`${frame.timeS.toFixed(2)} s  left knee ${knee.toFixed(1)} N·m`);
  if (++seen === 60) break;
}
await sinew.worlds.deleteWorld({ name: world?.name });
