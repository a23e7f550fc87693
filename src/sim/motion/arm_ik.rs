//! The analytic inverse of an arm: shoulder and elbow that bring a point of the hand to a place.
//!
//! The elbow's angle follows from the distance between shoulder and place (law of cosines). The shoulder then points
//! the arm at the place and turns the elbow towards a given direction. Every step is closed form. Rounding is the same
//! on every machine, since this runs within the tick.

use super::leg_ik::{hinge_for_distance, point_and_roll};
use crate::body::topology::{
    DOF_AXIS, DOF_START, JOINT, Joint, L_FOREARM, L_HAND, L_UPPER_ARM, R_FOREARM, R_HAND,
    R_UPPER_ARM,
};
use crate::body::{Body, Posture, SegmentId};
use crate::math::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// Upper arm, forearm and hand, left and right.
pub const ARMS: [[SegmentId; 3]; 2] = [
    [L_UPPER_ARM, L_FOREARM, L_HAND],
    [R_UPPER_ARM, R_FOREARM, R_HAND],
];

/// The joint angles of an arm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Arm {
    shoulder: Quat,
    /// Elbow and wrist, rad.
    hinge: [f64; 4],
}

/// Indices of the joints of an arm in a posture: the shoulder, and the first angles of elbow and wrist.
pub fn joints(arm: [SegmentId; 3]) -> (usize, [usize; 2]) {
    match arm.map(|s| JOINT[s.index()]) {
        [Joint::Ball(b), Joint::Hinge2(elbow), Joint::Hinge2(wrist)] => (b, [elbow, wrist]),
        _ => unreachable!("shoulders are balls, elbows and wrists have two hinges"),
    }
}

impl Arm {
    /// The arm of a posture.
    pub fn of(posture: &Posture, arm: [SegmentId; 3]) -> Self {
        let (shoulder, [e, w]) = joints(arm);
        let h = &posture.hinge;
        Self {
            shoulder: posture.ball[shoulder],
            hinge: [h[e], h[e + 1], h[w], h[w + 1]],
        }
    }

    /// Gives the arm of a posture these angles.
    pub fn hold(&self, posture: &mut Posture, arm: [SegmentId; 3]) {
        let (shoulder, [e, w]) = joints(arm);
        posture.ball[shoulder] = self.shoulder;
        let h = &mut posture.hinge;
        [h[e], h[e + 1], h[w], h[w + 1]] = self.hinge;
    }

    /// Whether every angle is finite.
    pub fn is_finite(&self) -> bool {
        self.shoulder.is_finite() && self.hinge.iter().all(|a| a.is_finite())
    }

    /// Moves by `share` of the way to another arm.
    pub fn toward(&self, to: &Self, share: f64) -> Self {
        Self {
            shoulder: self.shoulder.slerp(to.shoulder, share),
            hinge: std::array::from_fn(|k| self.hinge[k] + share * (to.hinge[k] - self.hinge[k])),
        }
    }
}

/// Bends the elbow within its limits so that a point of the hand is at the given distance from the shoulder. Returns
/// the axis of the hinge, its angle, rad, and the resulting place of the point, frame of the upper arm, m.
pub(super) fn bend_elbow(
    body: &Body,
    arm: [SegmentId; 3],
    point: Vec3,
    distance: f64,
) -> (Vec3, f64, Vec3) {
    let [_, fore, hand] = arm.map(SegmentId::index);
    let dof = DOF_START[fore];
    let n = Vec3::from_array(DOF_AXIS[dof].vector());
    let (a, b) = (body.joint_offset[fore], body.joint_offset[hand] + point);
    let elbow = hinge_for_distance(a, b, n, distance).clamp(body.lower[dof], body.upper[dof]);
    (n, elbow, a + Quat::exp(n * elbow).rotate(b))
}

/// Brings a point of a hand to a place; forearm and wrist are neither turned nor bent.
///
/// * `point`: hand frame, m; `place`: chest frame, m; `pole`: where the elbow points, chest frame, any length.
///
/// The elbow stays within its limits; the caller checks those of the shoulder. Returns the arm and the remaining
/// distance, m: 0 where the place is within reach. O(1), no allocation.
pub fn reach(body: &Body, arm: [SegmentId; 3], point: Vec3, place: Vec3, pole: Vec3) -> (Arm, f64) {
    let shoulder = body.joint_offset[arm[0].index()];
    let way = place - shoulder;
    let (n, elbow, hand) = bend_elbow(body, arm, point, way.norm());
    let direction = way.normalized_or(-Vec3::Z);
    // The elbow lies off the line from shoulder to hand in direction × axis.
    let axis = pole.cross(direction);
    let chest_from_upper = point_and_roll(hand, n, direction, axis, -Vec3::Y);
    let held = Arm {
        shoulder: chest_from_upper,
        hinge: [elbow, 0.0, 0.0, 0.0],
    };
    (
        held,
        (shoulder + chest_from_upper.rotate(hand) - place).norm(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::palm::load_point;
    use crate::body::topology::CHEST;
    use crate::math::vec3::vec3;
    use crate::motion::leg_ik::forward;

    #[test]
    fn the_palm_comes_to_the_place_and_the_elbow_points_along_the_pole() {
        for body in [Body::adult_man(), Body::adult_woman()] {
            for (arm, side) in ARMS.into_iter().zip([1.0, -1.0]) {
                let point = load_point(&body, arm[2]);
                for (x, y, z) in [(0.35, 0.1, 0.0), (0.4, -0.15, 0.2), (0.3, 0.0, -0.2)] {
                    let (place, pole) = (vec3(x, side * y, z), vec3(-0.2, side * 0.4, -1.0));
                    let mut p = Posture::default();
                    let (held, missing) = reach(&body, arm, point, place, pole);
                    held.hold(&mut p, arm);
                    let poses = forward(&body, &p);
                    let chest = poses[CHEST.index()];
                    let local = |world: Vec3| chest.1.conjugate().rotate(world - chest.0);
                    let at = poses[arm[2].index()];
                    let palm = local(at.0 + at.1.rotate(point));
                    assert!(missing < 1e-9 && (palm - place).norm() < 1e-9, "{palm:?}");
                    let [s, e, _] = arm.map(|s| local(poses[s.index()].0));
                    let line = (place - s).normalized_or(Vec3::X);
                    let across = |v: Vec3| v - line * v.dot(line);
                    let (off, wanted) = (across(e - s), across(pole));
                    let along = off.dot(wanted) / off.norm() / wanted.norm();
                    assert!(along > 0.9, "{along}");
                }
            }
        }
    }

    #[test]
    fn what_is_out_of_reach_is_pointed_at() {
        let body = Body::adult_man();
        let place = vec3(2.0, 0.2, 0.3);
        let [upper, fore, hand] = ARMS[0].map(SegmentId::index);
        let (_, missing) = reach(&body, ARMS[0], Vec3::zero(), place, -Vec3::Z);
        let length = body.joint_offset[fore].norm() + body.joint_offset[hand].norm();
        let far = (place - body.joint_offset[upper]).norm();
        assert!((missing - (far - length)).abs() < 0.01, "{missing}");
    }
}
