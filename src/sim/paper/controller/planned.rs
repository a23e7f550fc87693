//! The feet that the desired motion keeps on the floor.

use crate::body::SegmentId;
use crate::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::control::ControlInput;

/// The feet that the desired motion keeps on the floor. A foot that it lifts carries nothing; otherwise it could never
/// be lifted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planned(pub [bool; 2]);

impl Planned {
    /// The plan of a motion. If it would leave no touching point to stand on, everything that touches carries.
    pub fn new(input: &ControlInput<'_>) -> Self {
        let plan = Self(input.target.next.planted);
        let points = input.support.points();
        if points.iter().any(|p| plan.holds(p.segment)) {
            plan
        } else {
            Self([true; 2])
        }
    }

    /// Whether points of this segment may carry load.
    pub fn holds(self, segment: SegmentId) -> bool {
        match segment {
            L_FOOT | L_TOES => self.0[0],
            R_FOOT | R_TOES => self.0[1],
            _ => true,
        }
    }

    /// The main support: the usual one, or the foot that stays if the usual one is about to lift.
    pub fn main(self, input: &ControlInput<'_>) -> Option<SegmentId> {
        let support = input.support;
        let main = support.main()?;
        if self.holds(main) {
            return Some(main);
        }
        let stays = support
            .points()
            .iter()
            .map(|p| p.support)
            .filter(|s| self.holds(*s));
        let ratio = support.ratio();
        let best = stays.reduce(|a, b| {
            if ratio[b.index()] > ratio[a.index()] {
                b
            } else {
                a
            }
        });
        best.or(Some(main))
    }
}
