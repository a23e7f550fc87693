//! The joints of a recorded skeleton, whatever file they came from.

use crate::math::{Quat, Vec3};

/// Largest number of joints of a skeleton that is read; rigs with full faces have about 300. Bounds the quadratic
/// searches of the tree.
pub const MAX_JOINTS: usize = 1024;

/// One joint of a recorded skeleton.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedJoint {
    /// Name as written.
    pub name: String,
    /// Index of the parent, which comes before its children; `None` for a root.
    pub parent: Option<usize>,
    /// Position in the parent's frame in the zero pose, file units.
    pub offset: Vec3,
    /// End of the bone in the joint's frame where the file gives it, file units.
    pub end_site: Option<Vec3>,
    /// Whether the file records its position, not only its rotation.
    pub has_position: bool,
}

/// World pose of one joint in file units and file axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPose {
    /// Joint position.
    pub position: Vec3,
    /// `world_from_joint`.
    pub rotation: Quat,
}
