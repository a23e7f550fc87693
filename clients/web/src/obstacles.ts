// Obstacles: their surfaces, asked for when the set changes, placed from frames.
import * as THREE from "three";
import { numbers, type Sinew } from "./client.js";
import type { WorldFrame } from "./gen/sinew/v1/frame_pb.js";
import type { Obstacle } from "./gen/sinew/v1/obstacle_pb.js";
import { mixPoses, POSE } from "./model.js";

/** An obstacle may be replaced by another of the same name: shapes are asked for again after this time, ms. */
const AGAIN_MS = 2000;
/** Edge of the patch of a plane that is drawn, m. */
const PATCH = 6;
const COLOUR = 0xa89f8d;

/** What an obstacle looks like in its own frame. */
function geometry(o: Obstacle): THREE.BufferGeometry {
  switch (o.shape.case) {
    case "sphere":
      return new THREE.SphereGeometry(o.shape.value.radiusM, 32, 20);
    case "capsule":
      // Along z, where three.js has it along y.
      return new THREE.CapsuleGeometry(o.shape.value.radiusM, 2 * o.shape.value.halfLengthM, 12, 24).rotateX(
        Math.PI / 2,
      );
    case "box": {
      const h = o.shape.value.halfM;
      return new THREE.BoxGeometry(2 * (h?.x ?? 0), 2 * (h?.y ?? 0), 2 * (h?.z ?? 0));
    }
    default:
      return new THREE.PlaneGeometry(PATCH, PATCH);
  }
}

/** The obstacles of the world that is watched. */
export class Obstacles {
  readonly group = new THREE.Group();
  private readonly meshes = new Map<string, THREE.Mesh>();
  private readonly material = new THREE.MeshStandardMaterial({ color: COLOUR, roughness: 0.8, side: THREE.DoubleSide });
  private readonly pose = new Float32Array(POSE);
  private known = "";
  private asked = -Infinity;
  private asking = false;

  /** Asks for the shapes if a frame has other obstacles than the last one, and now and then. */
  async follow(api: Sinew, world: string, frame: WorldFrame): Promise<void> {
    const names = frame.obstacles.length ? `${world} ${frame.obstacles.map((o) => o.obstacleId).join(" ")}` : "";
    const old = names && performance.now() - this.asked > AGAIN_MS;
    if (this.asking || (names === this.known && !old)) return;
    this.asking = true;
    try {
      const { obstacles } = names
        ? await api.obstacles.listObstacles({ parent: world, pageSize: 1000 })
        : { obstacles: [] };
      this.known = names;
      this.asked = performance.now();
      this.show(obstacles);
    } catch {
      // The watch of frames ends with the same cause and says so.
    } finally {
      this.asking = false;
    }
  }

  private show(obstacles: Obstacle[]): void {
    for (const mesh of this.meshes.values()) mesh.geometry.dispose();
    this.group.clear();
    this.meshes.clear();
    for (const o of obstacles) {
      const mesh = new THREE.Mesh(geometry(o), this.material);
      mesh.castShadow = o.shape.case !== "plane";
      mesh.receiveShadow = true;
      this.meshes.set(o.name.split("/").at(-1) ?? "", mesh);
      this.group.add(mesh);
    }
  }

  /** Puts them where they are between two frames. */
  place(before: WorldFrame, after: WorldFrame, share: number): void {
    const earlier = new Map(before.obstacles.map((o) => [o.obstacleId, o]));
    const seen = new Set<THREE.Mesh>();
    for (const o of after.obstacles) {
      const mesh = this.meshes.get(o.obstacleId);
      const to = numbers(o.pose);
      if (!mesh || to.length !== POSE) continue;
      mixPoses(numbers(earlier.get(o.obstacleId)?.pose), to, share, this.pose);
      mesh.position.fromArray(this.pose);
      mesh.quaternion.fromArray(this.pose, 3);
      seen.add(mesh);
    }
    for (const mesh of this.meshes.values()) mesh.visible = seen.has(mesh);
  }
}
