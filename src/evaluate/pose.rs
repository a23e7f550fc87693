//! World poses of the segments by plain forward kinematics, joint by joint: the oracle of `sim::dynamics::Kinematics`
//! and of `sim::motion::leg_ik::forward`, and so independent of both.

use sinew_physics::body::topology::{DOF_AXIS, DOF_LEN, DOF_START, JOINT, Joint, PARENT};
use sinew_physics::body::{Posture, SEGMENT_COUNT};
use sinew_physics::math::{Quat, Vec3};

/// The pose of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentPose {
    /// World position of the segment origin (the proximal joint), m.
    pub position: Vec3,
    /// `world_from_segment`.
    pub rotation: Quat,
}

impl SegmentPose {
    /// World position of a point given in the segment frame, m.
    pub fn point(&self, local: Vec3) -> Vec3 {
        self.position + self.rotation.rotate(local)
    }
}

/// World pose of every segment. `offsets`: joint positions in the parent's frame, m.
pub fn segment_poses(
    offsets: &[Vec3; SEGMENT_COUNT],
    posture: &Posture,
) -> [SegmentPose; SEGMENT_COUNT] {
    let root = SegmentPose {
        position: posture.root_position,
        rotation: posture.root_rotation,
    };
    let mut out = [root; SEGMENT_COUNT];
    for s in 1..SEGMENT_COUNT {
        let parent = out[PARENT[s]];
        let mut rotation = parent.rotation;
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => rotation = rotation * posture.ball[b],
            Joint::Hinge2(h) | Joint::Hinge1(h) => {
                for k in 0..DOF_LEN[s] {
                    let axis = Vec3::from_array(DOF_AXIS[DOF_START[s] + k].vector());
                    rotation = rotation * Quat::from_axis_angle(axis, posture.hinge[h + k]);
                }
            }
        }
        out[s] = SegmentPose {
            position: parent.point(offsets[s]),
            rotation,
        };
    }
    out
}
