// What lies under a pointer. Segments are rigid, so a ray is taken into each segment's own frame once, and nothing is
// skinned.
import * as THREE from "three";
import type { Body } from "./gen/sinew/v1/body_pb.js";
import { POSE } from "./model.js";

/** A place on a figure. */
export interface Touch {
  segment: number;
  /** Segment frame, m. */
  local: THREE.Vector3;
  /** From the eye, m. */
  distance: number;
  /** Angle between the ray and the place, rad; 0 when it is met. */
  off: number;
}

interface Part {
  corners: Float32Array;
  triangles: ArrayLike<number>;
  bound: THREE.Sphere;
}

/** The surfaces of a body, segment by segment, for rays. */
export class Touchable {
  private readonly parts: Part[];

  constructor(body: Body) {
    this.parts = body.segments.map((s) => {
      const corners = Float32Array.from(s.meshVerticesM);
      const bound = new THREE.Box3().setFromArray(corners).getBoundingSphere(new THREE.Sphere());
      return { corners, triangles: s.meshTriangles, bound };
    });
  }

  /** The nearest place that the ray meets; if it meets none, the place least beside it, up to `slack` (rad). */
  touch(ray: THREE.Ray, poses: ArrayLike<number>, slack: number): Touch | undefined {
    let met: Touch | undefined;
    let beside: Touch | undefined;
    this.parts.forEach((part, segment) => {
      if (!part.corners.length) return;
      const o = segment * POSE;
      inverse.set(poses[o + 3], poses[o + 4], poses[o + 5], poses[o + 6]).conjugate();
      local.origin
        .set(ray.origin.x - poses[o], ray.origin.y - poses[o + 1], ray.origin.z - poses[o + 2])
        .applyQuaternion(inverse);
      local.direction.copy(ray.direction).applyQuaternion(inverse);
      const away = local.origin.distanceTo(part.bound.center);
      if (local.distanceToPoint(part.bound.center) > part.bound.radius + away * slack) return;
      const { corners, triangles } = part;
      for (let t = 0; t + 2 < triangles.length; t += 3) {
        a.fromArray(corners, 3 * triangles[t]);
        b.fromArray(corners, 3 * triangles[t + 1]);
        c.fromArray(corners, 3 * triangles[t + 2]);
        if (!local.intersectTriangle(a, b, c, true, place)) continue;
        const distance = place.distanceTo(local.origin);
        if (!met || distance < met.distance) met = { segment, local: place.clone(), distance, off: 0 };
      }
      if (met) return;
      for (let i = 0; i + 2 < corners.length; i += 3) {
        a.fromArray(corners, i);
        const off = b.subVectors(a, local.origin).angleTo(local.direction);
        if (off <= slack && (!beside || off < beside.off))
          beside = { segment, local: a.clone(), distance: b.length(), off };
      }
    });
    return met ?? beside;
  }
}

const [a, b, c, place] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
const inverse = new THREE.Quaternion();
const local = new THREE.Ray();
