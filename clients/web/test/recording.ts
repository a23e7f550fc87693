// A small recording: a standing person, 1.76 m, who raises the right arm. BVH text; y is up, the person looks along z,
// units are cm.

interface Bone {
  name: string;
  offset: [number, number, number];
  children: Bone[];
}

const bone = (name: string, offset: [number, number, number], ...children: Bone[]): Bone => ({
  name,
  offset,
  children,
});
const side = (name: "Left" | "Right", x: number): { arm: Bone; leg: Bone } => ({
  arm: bone(
    `${name}Arm`,
    [18 * x, 24, 0],
    bone(`${name}ForeArm`, [28 * x, 0, 0], bone(`${name}Hand`, [25 * x, 0, 0], bone("End", [17 * x, 0, 0]))),
  ),
  leg: bone(
    `${name}UpLeg`,
    [9 * x, -4, 0],
    bone(
      `${name}Leg`,
      [0, -42, 0],
      bone(`${name}Foot`, [0, -42, 0], bone(`${name}ToeBase`, [0, -8, 14], bone("End", [0, 0, 6]))),
    ),
  ),
});
const [left, right] = [side("Left", 1), side("Right", -1)];
const SKELETON = bone(
  "Hips",
  [0, 96, 0],
  bone(
    "Spine",
    [0, 10, 0],
    bone(
      "Spine1",
      [0, 16, 0],
      bone("Neck", [0, 28, 0], bone("Head", [0, 9, 0], bone("End", [0, 19, 0]))),
      left.arm,
      right.arm,
    ),
  ),
  left.leg,
  right.leg,
);

const RATE_HZ = 30;
const FRAMES = 90;

/** The recording; with `elbow`, the left elbow is bent by that many degrees for a third of it. */
export function recording(elbow = 20): string {
  const order: string[] = [];
  const write = (b: Bone, depth: number): string => {
    const pad = "  ".repeat(depth);
    const offset = `${pad}  OFFSET ${b.offset.join(" ")}\n`;
    if (b.name === "End") return `${pad}End Site\n${pad}{\n${offset}${pad}}\n`;
    order.push(b.name);
    const channels = depth
      ? "3 Zrotation Xrotation Yrotation"
      : "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation";
    const children = b.children.map((c) => write(c, depth + 1)).join("");
    const head = `${pad}${depth ? "JOINT" : "ROOT"} ${b.name}\n`;
    return `${head}${pad}{\n${offset}${pad}  CHANNELS ${channels}\n${children}${pad}}\n`;
  };
  const hierarchy = write(SKELETON, 0);
  const rows = Array.from({ length: FRAMES }, (_, frame) => {
    const raised = 0.5 - 0.5 * Math.cos((2 * Math.PI * frame) / FRAMES);
    const bent = frame > FRAMES / 3 && frame < (2 * FRAMES) / 3 ? elbow : 20;
    // Angles about z, x and y, degrees, from the pose with the arms sideways.
    const turned: Record<string, [number, number, number]> = {
      LeftArm: [-72, 0, 0],
      RightArm: [72 - 100 * raised, 0, 0],
      LeftForeArm: [0, 0, -bent],
      RightForeArm: [0, 0, 20 + 40 * raised],
    };
    const angles = order.flatMap((name) => turned[name] ?? [0, 0, 0]);
    return [...SKELETON.offset, ...angles].map((v) => v.toFixed(4)).join(" ");
  });
  const head = `MOTION\nFrames: ${FRAMES}\nFrame Time: ${(1 / RATE_HZ).toFixed(7)}`;
  return `HIERARCHY\n${hierarchy}${head}\n${rows.join("\n")}\n`;
}
