//! Plain forward kinematics of a posture, and the analytic inverse of a leg.
//!
//! A leg is a ball hip, a hinge knee and a ball ankle. The knee angle follows from the distance between hip and ankle
//! (law of cosines, for any offsets between the joints). The hip points the leg at the ankle and turns the knee's hinge
//! axis as near as it can to a given direction, and the ankle does the rest. Every step is closed form, so the foot
//! pose is met to rounding. Rounding is the same on every machine: live streams are prepared within the tick.

use crate::body::topology::{
    DOF_AXIS, DOF_LEN, DOF_START, JOINT, Joint, L_FOOT, L_SHANK, L_THIGH, L_TOES, PARENT, R_FOOT,
    R_SHANK, R_THIGH, R_TOES, SEGMENT_COUNT,
};
use crate::body::{Body, Posture, SegmentId};
use crate::math::{Mat3, Quat, Vec3, trig};

/// Thigh, shank, foot and toes of one side.
pub fn leg_segments(left: bool) -> [SegmentId; 4] {
    if left {
        [L_THIGH, L_SHANK, L_FOOT, L_TOES]
    } else {
        [R_THIGH, R_SHANK, R_FOOT, R_TOES]
    }
}

/// `parent_from_child` of one joint.
fn joint_rotation(posture: &Posture, segment: usize) -> Quat {
    let hinge = |d: usize, angle: f64| Quat::exp(Vec3::from_array(DOF_AXIS[d].vector()) * angle);
    let d = DOF_START[segment];
    match JOINT[segment] {
        Joint::Free => posture.root_rotation,
        Joint::Ball(b) => posture.ball[b],
        Joint::Hinge2(h) => hinge(d, posture.hinge[h]) * hinge(d + 1, posture.hinge[h + 1]),
        Joint::Hinge1(h) => hinge(d, posture.hinge[h]),
    }
}

/// World pose of every segment: origin (m) and `world_from_segment`, in segment order.
///
/// Rotations stay quaternions and positions are in the world, since motion is planned there. `dynamics::Kinematics`
/// computes the same to rounding, as matrices relative to the pelvis, and `evaluate::pose` is the oracle of both; their
/// bits differ.
///
/// O(segments), no allocation.
pub fn forward(body: &Body, posture: &Posture) -> [(Vec3, Quat); SEGMENT_COUNT] {
    let mut out = [(posture.root_position, posture.root_rotation); SEGMENT_COUNT];
    for s in 1..SEGMENT_COUNT {
        let (position, rotation) = out[PARENT[s]];
        out[s] = (
            position + rotation.rotate(body.joint_offset[s]),
            rotation * joint_rotation(posture, s),
        );
    }
    out
}

/// Centre of mass of the whole body (world, m) from the poses of [`forward`].
pub fn center_of_mass(body: &Body, poses: &[(Vec3, Quat); SEGMENT_COUNT]) -> Vec3 {
    let (mut sum, mut mass) = (Vec3::zero(), 0.0);
    for (segment, (position, rotation)) in body.segments.iter().zip(poses) {
        sum += (*position + rotation.rotate(segment.com)) * segment.mass;
        mass += segment.mass;
    }
    sum * (1.0 / mass)
}

/// World direction of the knee's hinge axis of `posture`: normal to the plane in which its leg bends.
pub fn knee_axis(posture: &Posture, left: bool) -> Vec3 {
    let thigh = leg_segments(left)[0].index();
    let world_from_thigh = posture.root_rotation * joint_rotation(posture, thigh);
    world_from_thigh.rotate(hinge_axis(left))
}

fn hinge_axis(left: bool) -> Vec3 {
    let shank = leg_segments(left)[1].index();
    Vec3::from_array(DOF_AXIS[DOF_START[shank]].vector())
}

/// Sets hip, knee, ankle and toe of one leg so that the foot takes a wanted pose; the pelvis stays where it is.
///
/// The knee keeps bending in its present plane: the hinge axis of `posture` decides, so a smooth sequence of postures
/// and targets gives a smooth sequence of legs. See [`solve_leg_in_plane`] for the rest.
pub fn solve_leg(
    body: &Body,
    posture: &mut Posture,
    left: bool,
    world_from_foot: (Vec3, Quat),
    toe: f64,
) {
    let axis = knee_axis(posture, left);
    solve_leg_in_plane(body, posture, left, world_from_foot, toe, axis);
}

/// Like [`solve_leg`] with the knee's hinge axis as near as possible to `axis` (world, any length).
///
/// * `world_from_foot`: wanted ankle position (m, world) and foot orientation.
/// * `toe`: toe extension, rad; clamped to the body's limits.
///
/// The knee flexes between its limits and never backwards. A target out of reach leaves the leg stretched (or fully
/// bent) towards it, with the foot's orientation as wanted. Hip and ankle angles are not held to their limits: the
/// caller decides whether they must be, and what gives way. O(1), no allocation.
pub fn solve_leg_in_plane(
    body: &Body,
    posture: &mut Posture,
    left: bool,
    world_from_foot: (Vec3, Quat),
    toe: f64,
    axis: Vec3,
) {
    let [thigh, shank, foot, toes] = leg_segments(left).map(SegmentId::index);
    let (wanted, foot_rotation) = world_from_foot;
    let pelvis = posture.root_rotation;
    let hip = posture.root_position + pelvis.rotate(body.joint_offset[thigh]);
    let to_ankle = wanted - hip;
    let distance = to_ankle.norm();

    let (a, b, n) = (
        body.joint_offset[shank],
        body.joint_offset[foot],
        hinge_axis(left),
    );
    let dof = DOF_START[shank];
    let lower = body.lower[dof].max(0.0);
    let upper = body.upper[dof].max(lower);
    let knee = hinge_for_distance(a, b, n, distance).clamp(lower, upper);
    let knee_rotation = Quat::exp(n * knee);
    let reach = a + knee_rotation.rotate(b); // thigh frame

    // Turn the thigh frame so that `reach` points at the ankle and n is as near to `axis` as that allows.
    let direction = to_ankle.normalized_or(-pelvis.rotate(Vec3::Z));
    let world_from_thigh = point_and_roll(reach, n, direction, axis, pelvis.rotate(Vec3::X));

    if let (Joint::Ball(h), Joint::Hinge1(k), Joint::Ball(f), Joint::Hinge1(t)) =
        (JOINT[thigh], JOINT[shank], JOINT[foot], JOINT[toes])
    {
        posture.ball[h] = (pelvis.conjugate() * world_from_thigh).normalized();
        posture.hinge[k] = knee;
        let world_from_shank = world_from_thigh * knee_rotation;
        posture.ball[f] = (world_from_shank.conjugate() * foot_rotation).normalized();
        let d = DOF_START[toes];
        posture.hinge[t] = toe.clamp(body.lower[d], body.upper[d]);
        debug_assert_eq!(DOF_LEN[toes], 1);
    } else {
        unreachable!("the tree has ball hips and ankles and hinge knees and toes");
    }
}

/// Angle of the hinge with axis `n` at the end of `a` that brings the end of `b` to `distance` from the start of `a`:
/// the flexed one of the two solutions, or stretched or folded where there is none.
///
/// Start to end is `r(θ) = a + R(θ) b`. With the parts of a and b across n, `|r|² = |a|² + |b|² + 2 (a·n)(b·n) + 2 C
/// cos(θ − φ)`, `C = |a⊥||b⊥|`: longest at θ = φ, shorter on both sides.
pub(crate) fn hinge_for_distance(a: Vec3, b: Vec3, n: Vec3, distance: f64) -> f64 {
    let (an, bn) = (a.dot(n), b.dot(n));
    let (across_a, across_b) = (a - n * an, b - n * bn);
    let cosine_part = across_a.dot(across_b);
    let sine_part = across_a.dot(n.cross(across_b));
    let amplitude = (cosine_part * cosine_part + sine_part * sine_part).sqrt();
    let stretched = trig::atan2(sine_part, cosine_part);
    let constant = a.dot(a) + b.dot(b) + 2.0 * an * bn;
    let cosine = ((distance * distance - constant) / (2.0 * amplitude)).clamp(-1.0, 1.0);
    stretched + trig::atan2((1.0 - cosine * cosine).sqrt(), cosine)
}

/// Rotation that takes `reach` to the unit vector `direction` and turns `n` as near to `axis` as that allows (`spare`
/// where `axis` gives no direction).
pub(crate) fn point_and_roll(
    reach: Vec3,
    n: Vec3,
    direction: Vec3,
    axis: Vec3,
    spare: Vec3,
) -> Quat {
    let from = frame(reach.normalized_or(-Vec3::Z), n, Vec3::X);
    let to = frame(direction, axis, spare);
    Quat::from_mat3(&(to * from.transpose()))
}

/// Right-handed frame whose first axis is `first` (unit) and whose second lies in the half plane of `second`; where the
/// two are parallel, `spare` takes the place of `second`.
fn frame(first: Vec3, second: Vec3, spare: Vec3) -> Mat3 {
    let across = |v: Vec3| v - first * v.dot(first);
    let mut y = across(second);
    if y.norm() < 1e-9 * second.norm().max(1e-300) || y.norm() == 0.0 {
        y = across(spare);
    }
    let y = y.normalized_or(across(Vec3::Y).normalized_or(Vec3::Z));
    Mat3 {
        x: first,
        y,
        z: first.cross(y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::DOF_COUNT;
    use crate::body::{Links, angles};
    use crate::dynamics::Kinematics;
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64;

    fn random_posture(body: &Body, random: &mut Pcg64) -> Posture {
        let mut posture = Posture::default();
        let mut a = [0.0; DOF_COUNT];
        for d in 0..DOF_COUNT {
            a[d] = random.random_range(body.lower[d]..body.upper[d]);
        }
        angles::set_anatomical_angles(&mut posture, &a);
        posture.root_position =
            Vec3::from_array([0.0; 3].map(|_: f64| random.random_range(-2.0..2.0)));
        posture.root_rotation = Quat::exp(Vec3::from_array(
            [0.0; 3].map(|_: f64| random.random_range(-1.5..1.5)),
        ));
        posture
    }

    /// The result of solving for a leg target.
    #[derive(Debug)]
    struct LegResult {
        /// Distance between the wanted and the reached ankle position, m.
        shortfall: f64,
        /// Knee flexion, rad.
        knee: f64,
    }

    impl LegResult {
        fn of(body: &Body, posture: &Posture, left: bool, wanted: Vec3) -> Self {
            let [_, shank, foot, _] = leg_segments(left).map(SegmentId::index);
            let Joint::Hinge1(k) = JOINT[shank] else {
                panic!()
            };
            Self {
                shortfall: (forward(body, posture)[foot].0 - wanted).norm(),
                knee: posture.hinge[k],
            }
        }
    }

    fn angle_between(a: Quat, b: Quat) -> f64 {
        (a.conjugate() * b).log().norm()
    }

    #[test]
    fn forward_agrees_with_the_kernels() {
        let body = Body::adult_man();
        let links = Links::new(&body);
        let mut random = Pcg64::seed_from_u64(1);
        let mut kin = Kinematics::<f64>::default();
        for _ in 0..200 {
            let posture = random_posture(&body, &mut random);
            kin.set_posture(&links, &posture);
            for (s, (position, rotation)) in forward(&body, &posture).iter().enumerate() {
                let v = Vec3 {
                    x: 0.3,
                    y: -0.7,
                    z: 0.2,
                };
                let world = kin.rotation[s] * v;
                assert!((rotation.rotate(v) - world).norm() < 1e-13);
                let at = posture.root_position + kin.position[s];
                assert!(
                    (*position - at).norm() < 1e-12 || (*position - kin.position[s]).norm() < 1e-12
                );
            }
        }
    }

    #[test]
    fn reachable_foot_poses_are_met_and_the_leg_is_found_again() {
        // Method: a random leg within limits gives the target; another random leg of the same pelvis is then sent
        // there.
        let body = Body::adult_man();
        let mut random = Pcg64::seed_from_u64(2);
        for left in [true, false] {
            let foot = leg_segments(left)[2].index();
            let toes = leg_segments(left)[3].index();
            for _ in 0..2000 {
                let truth = random_posture(&body, &mut random);
                let target = forward(&body, &truth)[foot];
                let Joint::Hinge1(t) = JOINT[toes] else {
                    panic!()
                };
                let mut other = random_posture(&body, &mut random);
                (other.root_position, other.root_rotation) =
                    (truth.root_position, truth.root_rotation);
                solve_leg(&body, &mut other, left, target, truth.hinge[t]);
                let result = LegResult::of(&body, &other, left, target.0);
                assert!(result.shortfall < 1e-9, "{result:?}");
                let found = forward(&body, &other)[foot];
                assert!((found.0 - target.0).norm() < 1e-9);
                assert!(angle_between(found.1, target.1) < 1e-9);
                assert_eq!(other.hinge[t], truth.hinge[t]);
                // Given the true knee axis, the whole leg is recovered; near full stretch the knee angle is
                // ill-conditioned.
                let mut again = other;
                let axis = knee_axis(&truth, left);
                solve_leg_in_plane(&body, &mut again, left, target, truth.hinge[t], axis);
                if LegResult::of(&body, &again, left, target.0).knee > 0.05 {
                    for (a, b) in forward(&body, &again)
                        .iter()
                        .zip(forward(&body, &truth))
                        .skip(if left { 10 } else { 14 })
                        .take(4)
                    {
                        assert!((a.0 - b.0).norm() < 1e-8 && angle_between(a.1, b.1) < 1e-7);
                    }
                }
            }
        }
    }

    #[test]
    fn joints_that_are_offset_sideways_change_nothing() {
        let mut body = Body::adult_man();
        for left in [true, false] {
            let [_, shank, foot, _] = leg_segments(left).map(SegmentId::index);
            body.joint_offset[shank] = Vec3 {
                x: 0.02,
                y: 0.015,
                z: -0.42,
            };
            body.joint_offset[foot] = Vec3 {
                x: -0.01,
                y: -0.02,
                z: -0.44,
            };
        }
        let mut random = Pcg64::seed_from_u64(3);
        for i in 0..1000 {
            let left = i % 2 == 0;
            let foot = leg_segments(left)[2].index();
            let mut posture = random_posture(&body, &mut random);
            let Joint::Hinge1(k) = JOINT[leg_segments(left)[1].index()] else {
                panic!()
            };
            posture.hinge[k] = random.random_range(0.2..2.4); // away from the stretched knee, which is not at 0 here
            let target = forward(&body, &posture)[foot];
            let mut other = posture;
            solve_leg(&body, &mut other, left, target, 0.0);
            let result = LegResult::of(&body, &other, left, target.0);
            assert!(result.shortfall < 1e-9, "{result:?}");
            assert!((forward(&body, &other)[foot].0 - target.0).norm() < 1e-9);
            assert!((other.hinge[k] - posture.hinge[k]).abs() < 1e-7);
        }
    }

    #[test]
    fn targets_out_of_reach_leave_a_straight_leg_pointing_at_them() {
        let body = Body::adult_man();
        let mut posture = Posture::default();
        let (thigh, foot) = (L_THIGH.index(), L_FOOT.index());
        let hip = body.joint_offset[thigh];
        let length = body.leg_length(0);
        let direction = Vec3 {
            x: 0.6,
            y: 0.0,
            z: -0.8,
        };
        let turned = Quat::exp(Vec3::Z * 0.3);
        let far = hip + direction * 2.0;
        solve_leg(&body, &mut posture, true, (far, turned), 9.0);
        let result = LegResult::of(&body, &posture, true, far);
        assert!((result.shortfall - (2.0 - length)).abs() < 1e-12);
        assert_eq!(result.knee, 0.0);
        let poses = forward(&body, &posture);
        assert!((poses[foot].0 - (hip + direction * length)).norm() < 1e-12);
        assert!(angle_between(poses[foot].1, turned) < 1e-12);
        let toe = DOF_START[L_TOES.index()];
        assert_eq!(posture.hinge[9], body.upper[toe], "toe angle is clamped");
        // Too near: the knee stops at its limit, and a target in the hip itself does no harm.
        for near in [0.05, 1e-15, 0.0] {
            let target = (hip + direction * near, Quat::identity());
            solve_leg(&body, &mut posture, true, target, 0.0);
            let result = LegResult::of(&body, &posture, true, target.0);
            assert_eq!(result.knee, body.upper[DOF_START[L_SHANK.index()]]);
            assert!(result.shortfall > 0.1 && posture.is_finite());
        }
    }

    #[test]
    fn legs_follow_a_moving_pelvis_without_jumps() {
        // A squat with feet planted: the largest change per step stays in proportion to the step.
        let body = Body::adult_man();
        let mut posture = Posture::default();
        let targets = [true, false].map(|l| forward(&body, &posture)[leg_segments(l)[2].index()]);
        let mut last: Option<Posture> = None;
        for i in 0..=400 {
            let depth = 0.02 + 0.2 * f64::from(i) / 400.0;
            posture.root_position = Vec3 {
                x: -0.5 * depth,
                y: 0.0,
                z: -depth,
            };
            posture.root_rotation = Quat::exp(Vec3::Y * depth);
            for (side, target) in targets.iter().enumerate() {
                solve_leg(&body, &mut posture, side == 0, *target, 0.0);
                let result = LegResult::of(&body, &posture, side == 0, target.0);
                assert!(result.shortfall < 1e-12 && result.knee > 0.0);
            }
            if let Some(last) = last {
                let step = last.joint_difference(&posture);
                assert!(step.iter().all(|s| s.abs() < 0.02));
            }
            last = Some(posture);
        }
        let found = angles::anatomical_angles(&posture);
        for d in 0..DOF_COUNT {
            assert!(
                found[d] > body.lower[d] - 1e-9 && found[d] < body.upper[d],
                "{}",
                crate::body::topology::DOF_NAMES[d]
            );
        }
    }
}
