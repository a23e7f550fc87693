//! Falling like a person: the posture that a figure takes once its balance is lost for good.
//!
//! Studies of human falls (Hsiao & Robinovitch 1998, DeGoede et al. 2003) found that the hands reach the floor first in
//! nearly all falls, that hips and knees bend, which removes speed before the trunk arrives, and that the head is held
//! off the floor. Here the arms point to where the shoulders will be moving when they are an arm's length above the
//! floor. The head stays upright, the knees bend, and the hips bend to the extent that the fall goes backward. All of
//! this follows from the present state: nothing is remembered.

use crate::body::angles::{anatomical_angles, clamp_to_limits, set_anatomical_angles};
use crate::body::palm::load_point;
use crate::body::topology::{
    CHEST, DOF_START, HEAD, JOINT, Joint, L_SHANK, L_THIGH, R_SHANK, R_THIGH,
};
use crate::body::{Body, Posture};
use crate::dynamics::Terms;
use crate::figure::params::bracing::BEND;
use crate::figure::params::second_hand::STRETCH;
use crate::math::{Quat, Vec3, trig};
use crate::motion::arm_ik::{ARMS, reach};

/// The joint angles with which a figure in the state of `terms` falls, based on `desired`; `gravity` in m/s². The
/// pelvis stays as it is. O(1), no allocation.
pub(in crate::figure) fn posture(
    body: &Body,
    terms: &Terms,
    desired: &Posture,
    gravity: f64,
) -> Posture {
    let state = &terms.state;
    let mut out = *desired;
    (out.root_position, out.root_rotation) =
        (state.posture.root_position, state.posture.root_rotation);
    let ahead = state.posture.root_rotation.rotate(Vec3::X);
    let way = Vec3 {
        z: 0.0,
        ..terms.com_velocity
    };
    bend_legs(body, ahead.dot(way.normalized_or(Vec3::zero())), &mut out);
    let chest = terms.segment_rotation(CHEST.index());
    let chest_from_world = Quat::from_mat3(&chest).conjugate();
    if let Joint::Ball(neck) = JOINT[HEAD.index()] {
        out.ball[neck] = shortest_turn(Vec3::Z, chest_from_world.rotate(Vec3::Z));
    }
    let [wx, wy, wz] = [state.velocity[0], state.velocity[1], state.velocity[2]];
    let spin = Vec3 {
        x: wx,
        y: wy,
        z: wz,
    };
    for (arm, side) in ARMS.into_iter().zip([1.0, -1.0]) {
        let [upper, fore, hand] = arm.map(|s| s.index());
        let point = load_point(body, arm[2]);
        let stretched = body.joint_offset[fore].norm() + (body.joint_offset[hand] + point).norm();
        let length = STRETCH * stretched;
        let shoulder = body.joint_offset[upper];
        let height = terms.point_world(CHEST.index(), shoulder).z;
        let v = terms.point_velocity(CHEST.index(), shoulder);
        // Time until the hand of a stretched arm would meet the floor, in free fall; without gravity it never does.
        let left = (height - length).max(0.0);
        let arrives = if gravity > 0.0 {
            (v.z + (v.z * v.z + 2.0 * gravity * left).sqrt()) / gravity
        } else {
            0.0
        };
        let then = Vec3 {
            z: v.z - gravity * arrives,
            ..v
        };
        let turned = Quat::exp(spin * -arrives).rotate(then);
        let way = chest_from_world.rotate(turned).normalized_or(-Vec3::Z);
        // Elbows point outwards and to the feet, as in a press-up.
        let pole = Vec3 {
            x: 0.0,
            y: side,
            z: -1.0,
        };
        let (held, _) = reach(body, arm, point, shoulder + way * length, pole);
        held.hold(&mut out, arm);
    }
    clamp_to_limits(body, &mut out, 0.0);
    out
}

/// Bends the knees, and the hips to the extent that the fall goes backward: in a forward fall, bent hips would bring
/// the head down. `forward`: cosine of the angle between the direction of the fall and the front.
fn bend_legs(body: &Body, forward: f64, posture: &mut Posture) {
    let mut angles = anatomical_angles(posture);
    let sitting = 0.5 * (1.0 - forward);
    for (s, share) in [
        (L_THIGH, sitting),
        (R_THIGH, sitting),
        (L_SHANK, 1.0),
        (R_SHANK, 1.0),
    ] {
        let d = DOF_START[s.index()];
        angles[d] = angles[d].max(share * BEND * body.upper[d]);
    }
    set_anatomical_angles(posture, &angles);
}

/// The shortest rotation from one unit vector to another; a turn about x if they are opposite.
fn shortest_turn(from: Vec3, to: Vec3) -> Quat {
    let axis = from.cross(to);
    let angle = trig::atan2(axis.norm(), from.dot(to));
    Quat::exp(axis.normalized_or(Vec3::X) * angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::{DOF_COUNT, L_HAND, R_HAND};
    use crate::motion::leg_ik::forward;
    use crate::support::testing::{GRAVITY, mannequin, standing, terms};

    /// Standing, turned by `pitch` (rad, forward) and moving with `velocity`, m/s.
    fn falling(pitch: f64, velocity: [f64; 3], gravity: f64) -> (Body, Posture) {
        let body = mannequin();
        let mut state = standing(&body);
        let desired = state.posture;
        state.posture.root_rotation = Quat::exp(Vec3 {
            y: pitch,
            ..Vec3::zero()
        });
        state.velocity[3..6].copy_from_slice(&velocity);
        let t = terms(&body, &state);
        let held = posture(&body, &t, &desired, gravity);
        (body, held)
    }

    #[test]
    fn arms_go_where_the_body_falls_and_the_head_stays_upright() {
        for (pitch, speed) in [(0.8, 1.5), (-0.8, -1.5)] {
            let (body, held) = falling(pitch, [speed, 0.0, -1.0], GRAVITY);
            let poses = forward(&body, &held);
            let chest = poses[CHEST.index()].0;
            for hand in [L_HAND, R_HAND] {
                let (p, _) = poses[hand.index()];
                let ahead = (p.x - chest.x) * speed.signum();
                assert!(
                    ahead > 0.0 && p.z < chest.z - 0.3,
                    "{pitch}: {ahead} {}",
                    p.z - chest.z
                );
            }
            // As upright as the neck can.
            let head = poses[HEAD.index()].1.rotate(Vec3::Z).z;
            let chest = poses[CHEST.index()].1.rotate(Vec3::Z).z;
            assert!(head > chest + 0.1, "{pitch}: head {head}, chest {chest}");
        }
    }

    #[test]
    fn every_state_gives_angles_within_the_limits() {
        for gravity in [0.0, 1e-9, GRAVITY] {
            for velocity in [[0.0; 3], [0.0, 0.0, 3.0], [4.0, -2.0, -6.0]] {
                for pitch in [-3.0, 0.0, 1.5] {
                    let (body, held) = falling(pitch, velocity, gravity);
                    let angles = anatomical_angles(&held);
                    for d in 0..DOF_COUNT {
                        let within = body.lower[d] - 1e-9..=body.upper[d] + 1e-9;
                        assert!(
                            within.contains(&angles[d]),
                            "{gravity} {velocity:?} {pitch} {d}"
                        );
                    }
                }
            }
        }
    }
}
