//! Motions that work on hands and knees: kneeling and crawling. A figure that follows one has not fallen: it keeps its
//! strength, and everything that the motion puts down carries it. One that lies down falls, and gets up in its own way.

use crate::body::SegmentId;
use crate::body::topology::{L_HAND, R_HAND, SEGMENT_COUNT};
use crate::control::{MEANT_BY_RECORDING, OnFloor};
use crate::figure::params::fall::FALLEN_HEIGHT;
use crate::figure::state::figure::Figure;
use crate::figure::tick::fall_detection::FEET;
use crate::report::{MAX_CONTACTS, POINTS_PER_SEGMENT};

/// A pelvis above this share of the length of a leg may kneel.
const KNEELS: f64 = 0.35;

/// The contacts of a motion on hands and knees, whose contact points are at these heights, m.
pub(in crate::figure) fn on_limbs(heights: &[f64; MAX_CONTACTS]) -> OnFloor<'_> {
    OnFloor {
        heights,
        meant: MEANT_BY_RECORDING,
        lies: false,
        rolls: false,
        slides: &[false; SEGMENT_COUNT],
    }
}

impl Figure {
    /// Whether the motion works on hands and knees, and the figure follows it there by itself.
    pub(in crate::figure) fn is_on_limbs(&self) -> bool {
        self.desired.on_limbs
            && self.mode().can_be_helped()
            && self.motion.rehearsed().is_none()
            && !self.motion.has_fallen()
            && !self.surroundings.help.acts()
    }

    /// Notes whether the motion, whose centre of mass is at `height` (m), works on hands and knees; with its kinematics
    /// in the workspace of tasks. A squat in which hands reach for the floor is still on its feet.
    pub(in crate::figure) fn look_for_limbs(&mut self, height: f64) {
        let before = self.desired.on_limbs;
        self.desired.on_limbs = false;
        // A pelvis that is much lower than a thigh is long lies or sits.
        let pelvis = self.desired.target.now.posture.root_position.z;
        if !self.is_low(height) || pelvis < KNEELS * self.setup.body.leg_length(0) {
            return;
        }
        let lies_low = height < FALLEN_HEIGHT * self.constants.standing_com_height;
        let tasks = &self.workspace.tasks;
        let target = &self.desired.target;
        let touches = |s: SegmentId| {
            let points = self.setup.body.segment(s).contact_points.iter();
            let mut heights = points
                .take(POINTS_PER_SEGMENT)
                .map(|p| tasks.desired_point(target, s, *p).z);
            heights.any(|z| z < MEANT_BY_RECORDING.1)
        };
        let hands = [L_HAND, R_HAND];
        let limb = |s: &SegmentId| !FEET.contains(s) && (lies_low || !hands.contains(s));
        self.desired.on_limbs = before || SegmentId::all().filter(limb).any(touches);
    }
}
