// A small client: a man lifts 6 kg, and we see what that asks of his shoulder. With a server running, and after
// `npm ci` in clients/web: cd clients/web && npm run example -- http://127.0.0.1:7463
import { numbers, Sinew } from "../../web/src/client.js";
import { Encoding } from "../../web/src/gen/sinew/v1/types_pb.js";

const sinew = new Sinew(process.argv[2] ?? "http://127.0.0.1:7463");
const { body } = await sinew.bodies.getBody({ name: "bodies/adult-man" });
const dofs = body?.dofs ?? [];
const shoulder = dofs.findIndex((d) => d.name === "r_shoulder_flexion");

const { frames, summary } = await sinew.simulations.simulateClip({
  source: { case: "clip", value: "clips/lift" },
  perturbations: [{ startS: 1.7, perturbation: { kind: { case: "load", value: { segment: "r_hand", massKg: 6 } } } }],
  view: { fields: { paths: ["torque", "torque_limits"] }, encoding: Encoding.DOUBLE, rateDivisor: 30 },
});

for (const { timeS, figures } of frames) {
  const torque = numbers(figures[0].torque)[shoulder];
  const most = numbers(figures[0].torqueLimits)[dofs.length + shoulder];
  console.log(`${timeS.toFixed(2)} s  right shoulder ${torque.toFixed(1)} of ${most.toFixed(1)} N·m`);
}
console.log(
  `state ${BigInt.asUintN(64, summary?.stateHash ?? 0n)
    .toString(16)
    .padStart(16, "0")}`,
);
