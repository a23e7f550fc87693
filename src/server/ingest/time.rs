//! Types of time for a driver's motion on its way to the tick. The drawing of all axes is in
//! `docs/tick.md#time-axes`; those of the physics are in [`sinew_physics::time`].

use serde::{Deserialize, Serialize};

sinew_physics::time_axes! {
    /// World time if the clock of the world had skipped no tick, s. Arrivals are stamped with it: it passes like the
    /// driver's own clock while the clock of the world runs, and stands still with it.
    pub struct ScheduledTime;

    /// Time since the first frame of a stream by the driver's clock, s. It says which part of the stream is played.
    pub struct PlayoutTime;
}

/// Time by the driver's clock, ns. Its zero is the driver's choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct SourceTime(
    /// Nanoseconds.
    pub i64,
);

impl SourceTime {
    /// Seconds from `other` to this time.
    pub fn since(self, other: Self) -> f64 {
        // Differences of hostile times must not overflow.
        (i128::from(self.0) - i128::from(other.0)) as f64 * 1e-9
    }

    /// The time `seconds` before this one, as near as the clock counts.
    #[must_use]
    pub fn earlier(self, seconds: f64) -> Self {
        Self(self.0.saturating_sub((seconds * 1e9).round() as i64))
    }
}
