//! Flight phases: times in which the plan has no foot on the floor.

use super::params::flight::LEANING_TIME;
use super::{StepPlan, StepTracker};
use crate::time::WorldTime;
use serde::{Deserialize, Serialize};

/// The next flight phase of the plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flight {
    /// Time until the planned lift-off of the last foot, s.
    pub after: f64,
    /// When its middle is due, if nothing delays the plan.
    pub middle: WorldTime,
}

impl StepTracker {
    /// Whether no foot is on the floor.
    pub(super) fn is_airborne(&self) -> bool {
        self.feet.iter().all(|foot| !foot.down)
    }

    /// Whether the plan is about to jump from a stand; the body then falls towards its landing while both feet stay.
    pub(super) fn leans_to_jump(&self) -> bool {
        let next_flight = |plan: &StepPlan| plan.next_flight(self.clock.phase);
        let stands = !self.is_stopping() && !self.recovers();
        let take_off = self.plan().filter(|_| stands).and_then(next_flight);
        take_off.is_some_and(|(off, _)| self.until(off) < LEANING_TIME)
    }

    /// The next flight phase, if it has been announced.
    pub fn next_flight(&self) -> Option<Flight> {
        self.events.flight
    }

    /// The next flight phase as planned, if a foot stands now; the plan is at world time `now`.
    pub(super) fn planned_flight(&self, now: WorldTime) -> Option<Flight> {
        let (off, on) = self.plan()?.next_flight(self.clock.phase)?;
        (!self.is_airborne()).then(|| Flight {
            after: self.until(off).max(0.0),
            middle: now + self.until(0.5 * (off + on)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{PlacedPlan, TrackedFoot};
    use super::*;
    use crate::body::Body;
    use crate::motion::builtin::at_ease;
    use crate::motion::{Clip, PlanarTransform};

    const RATE: f64 = 120.0;

    /// Stands for 2 s and jumps up for 0.4 s.
    fn jumps(body: &Body) -> Clip {
        let (stands, flies) = (2 * 120, 48);
        let planted = |i: usize| [i < stands || i >= stands + flies; 2];
        let posture = |i: usize| {
            let mut posture = at_ease(body);
            if !planted(i)[0] {
                let t = (i - stands) as f64 / RATE;
                posture.root_position.z += 0.5 * 9.81 * t * (0.4 - t);
            }
            posture
        };
        let count = 2 * stands + flies;
        let postures = (0..count).map(posture).collect();
        Clip::from_postures("jump", RATE, postures, (0..count).map(planted).collect()).unwrap()
    }

    #[test]
    fn a_planned_jump_from_a_stand_is_no_loss_of_balance() {
        let body = Body::adult_man();
        let clip = jumps(&body);
        let mut tracker = StepTracker::new(&body);
        let plan = StepPlan::new(&body, &clip, false);
        tracker.follow(Some(PlacedPlan::new(plan, 1.0, PlanarTransform::default())));
        tracker.feet = [TrackedFoot {
            down: true,
            ..Default::default()
        }; 2];
        tracker.capture.error = [0.02, 0.0];
        for (phase, leans) in [
            (0.5, false),
            (1.0, false),
            (1.5, true),
            (1.8, true),
            (3.5, false),
        ] {
            tracker.clock.phase = phase;
            assert_eq!(tracker.leans_to_jump(), leans, "at {phase} s");
            assert_eq!(tracker.off_plan(), leans.then_some(0.02), "at {phase} s");
        }
    }
}
