//! The flights of the motion: when no foot is to be on the floor.

use super::StepTracker;

/// A flight is looked ahead to for so long, s.
pub(super) const AHEAD: f64 = 0.2;

/// A flight of the motion that is still to come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// Time until no foot is to be on the floor, s.
    pub after: f64,
    /// World time at which the motion has its middle, if nothing delays it, s.
    pub middle: f64,
}

/// Who jumps away leans there for so long before he leaves the floor, s.
const LEANS: f64 = 0.6;

impl StepTracker {
    /// True if no foot is on the floor.
    pub(super) fn flies(&self) -> bool {
        self.feet.iter().all(|foot| !foot.down)
    }

    /// True if the motion is about to jump from where it stands: it falls towards where it lands while its feet still
    /// stay.
    pub(super) fn leans_to_jump(&self) -> bool {
        let stands = self.ended.is_none() && self.step.is_none() && !self.wait.waits();
        stands && self.leaves_in().is_some_and(|after| after < LEANS)
    }

    /// Time until the motion has no foot on the floor, s, while one stands; `None` if it does not fly next.
    pub(super) fn leaves_in(&self) -> Option<f64> {
        let (off, _) = self.plan.as_ref()?.next_flight(self.phase)?;
        Some((off - self.phase) / self.speed)
    }

    /// The flight that the motion has next, if it begins soon.
    pub fn coming_flight(&self) -> Option<Flight> {
        self.flight
    }

    /// The next flight as planned, if a foot stands now; the motion is at world time `now`, s.
    pub(super) fn coming(&self, now: f64) -> Option<Flight> {
        let (off, on) = self.plan.as_ref()?.next_flight(self.phase)?;
        let until = |phase: f64| (phase - self.phase) / self.speed;
        (!self.flies()).then(|| Flight {
            after: until(off).max(0.0),
            middle: now + until(0.5 * (off + on)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::body::Body;
    use crate::sim::motion::builtin::at_ease;
    use crate::sim::motion::{Clip, PlanarTransform};
    use crate::sim::track::StepPlan;

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
    fn who_is_about_to_jump_falls_where_his_motion_does_and_has_lost_nothing() {
        let body = Body::adult_man();
        let clip = jumps(&body);
        let mut tracker = StepTracker::new(&body);
        let plan = StepPlan::new(&body, &clip, false);
        tracker.follow(Some((plan, 1.0, PlanarTransform::default())));
        tracker.feet = [0; 2].map(|_| crate::sim::track::Foot {
            down: true,
            ..Default::default()
        });
        tracker.capture.error = [0.02, 0.0];
        for (phase, leans) in [
            (0.5, false),
            (1.0, false),
            (1.5, true),
            (1.8, true),
            (3.5, false),
        ] {
            tracker.phase = phase;
            assert_eq!(tracker.leans_to_jump(), leans, "at {phase} s");
            assert_eq!(tracker.off_plan(), leans.then_some(0.02), "at {phase} s");
        }
    }
}
