//! Postures as rotations and positions, for frames and for desired motion given by bone.

use sinew_physics::body::topology::{
    BONE_NAMES, DOF_AXIS, DOF_LEN, DOF_START, JOINT, Joint, PARENT,
};
use sinew_physics::body::{Body, Posture, SEGMENT_COUNT};
use sinew_physics::math::{Quat, Vec3};

/// Number of coordinates of [`positions`]: pelvis 7, nine quaternions, twelve angles.
pub const POSITION_COUNT: usize = 7 + 9 * 4 + 12;

fn hinge(dof: usize, angle: f64) -> Quat {
    Quat::from_axis_angle(Vec3::from_array(DOF_AXIS[dof].vector()), angle)
}

/// `parent_from_segment` rotation of the joint of segment `s`; the pelvis gives `world_from_pelvis`.
pub fn joint_rotation(posture: &Posture, s: usize) -> Quat {
    let d = DOF_START[s];
    match JOINT[s] {
        Joint::Free => posture.root_rotation,
        Joint::Ball(b) => posture.ball[b],
        Joint::Hinge2(h) => hinge(d, posture.hinge[h]) * hinge(d + 1, posture.hinge[h + 1]),
        Joint::Hinge1(h) => hinge(d, posture.hinge[h]),
    }
}

/// Sets the joint of segment `s` from `parent_from_segment`. Rotation that hinges cannot represent is dropped: the
/// rotation is split about their axes in order, and the rest about the missing axis is left out.
pub fn set_joint_rotation(posture: &mut Posture, s: usize, q: Quat) {
    let d = DOF_START[s];
    match JOINT[s] {
        Joint::Free => posture.root_rotation = q,
        Joint::Ball(b) => posture.ball[b] = q,
        Joint::Hinge1(h) => {
            let axis = DOF_AXIS[d];
            let v = [q.x, q.y, q.z][axis.axis] * f64::from(axis.sign);
            // Twist about the axis, by the shorter way.
            let (v, w) = if q.w < 0.0 { (-v, -q.w) } else { (v, q.w) };
            posture.hinge[h] = 2.0 * v.atan2(w);
        }
        Joint::Hinge2(h) => {
            let (a, b) = (DOF_AXIS[d], DOF_AXIS[d + 1]);
            let (i, j) = (a.axis, b.axis);
            let k = 3 - i - j;
            let cyclic = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
            // R = R_i(α) R_j(β) R_k(γ): the image of axis k depends on α and β, not on γ.
            let m = q.to_mat3();
            let image = [m.x, m.y, m.z][k].to_array();
            let alpha = (-cyclic * image[j]).atan2(image[k]);
            let beta = (cyclic * image[i]).atan2(image[j].hypot(image[k]));
            posture.hinge[h] = alpha * f64::from(a.sign);
            posture.hinge[h + 1] = beta * f64::from(b.sign);
        }
    }
}

/// World pose of every segment.
pub fn segment_poses(body: &Body, posture: &Posture) -> [(Vec3, Quat); SEGMENT_COUNT] {
    let mut out = [(posture.root_position, posture.root_rotation); SEGMENT_COUNT];
    for s in 1..SEGMENT_COUNT {
        let (p, q) = out[PARENT[s]];
        out[s] = (
            p + q.rotate(body.joint_offset[s]),
            (q * joint_rotation(posture, s)).normalized(),
        );
    }
    out
}

/// The state's own coordinates: pelvis position (3) and rotation (x, y, z, w), then per segment 1…17 the joint
/// position: a quaternion for a ball joint, one or two angles (rad) for hinges.
pub fn positions(posture: &Posture) -> [f64; POSITION_COUNT] {
    let mut out = [0.0; POSITION_COUNT];
    out[..3].copy_from_slice(&posture.root_position.to_array());
    out[3..7].copy_from_slice(&posture.root_rotation.to_xyzw());
    let mut n = 7;
    for s in 1..SEGMENT_COUNT {
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => {
                out[n..n + 4].copy_from_slice(&posture.ball[b].to_xyzw());
                n += 4;
            }
            Joint::Hinge2(h) | Joint::Hinge1(h) => {
                let len = DOF_LEN[s];
                out[n..n + len].copy_from_slice(&posture.hinge[h..h + len]);
                n += len;
            }
        }
    }
    out
}

/// Segment of a canonical bone name (VRM).
pub fn segment_of_bone(bone: &str) -> Option<usize> {
    BONE_NAMES.iter().position(|b| *b == bone)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joint_rotations_round_trip() {
        let mut seed = 7u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((seed >> 33) as f64 / 2f64.powi(31)) * 2.0 - 1.0
        };
        for _ in 0..200 {
            let mut p = Posture::default();
            for q in &mut p.ball {
                *q = Quat::exp(Vec3 {
                    x: random(),
                    y: random(),
                    z: random(),
                });
            }
            for h in &mut p.hinge {
                *h = 1.5 * random();
            }
            let mut back = Posture::default();
            for s in 1..SEGMENT_COUNT {
                set_joint_rotation(&mut back, s, joint_rotation(&p, s));
            }
            let e = p.joint_difference(&back);
            assert!(e.iter().all(|e| e.abs() < 1e-12), "{e:?}");
        }
    }

    #[test]
    fn positions_fill_every_coordinate() {
        let p = positions(&Posture::default());
        assert_eq!(p.iter().filter(|x| **x == 1.0).count(), 10); // ten unit quaternions
    }
}
