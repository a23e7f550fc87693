//! The flights of the motion: when no foot is to be on the floor.

use super::Gait;

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

impl Gait {
    /// True if no foot is on the floor.
    pub(super) fn flies(&self) -> bool {
        self.feet.iter().all(|foot| !foot.down)
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
