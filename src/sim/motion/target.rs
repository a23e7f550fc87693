//! The motion that a figure should do at one instant.

use crate::body::{NV, Posture, State};
use serde::{Deserialize, Serialize};

/// Desired positions, velocities and accelerations at one instant.
///
/// Velocities and accelerations have the layout and axes of [`State::velocity`](crate::body::State::velocity):
/// pelvis angular and linear part in world axes, then joint rates along the signed child axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Desired posture.
    pub posture: Posture,
    /// Desired velocity.
    #[serde(with = "crate::saved::array")]
    pub velocity: [f64; NV],
    /// Desired acceleration.
    #[serde(with = "crate::saved::array")]
    pub acceleration: [f64; NV],
    /// Whether the motion keeps each foot on the floor: left, right.
    pub planted: [bool; 2],
}

impl Target {
    /// Standing still in `posture`.
    pub fn still(posture: Posture) -> Self {
        Self {
            posture,
            velocity: [0.0; NV],
            acceleration: [0.0; NV],
            planted: [true; 2],
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let mut rates = self.velocity.iter().chain(&self.acceleration);
        self.posture.is_finite() && rates.all(|x| x.is_finite())
    }

    /// The state of a body that does exactly this.
    pub fn state(&self) -> State {
        State {
            posture: self.posture,
            velocity: self.velocity,
        }
    }
}

/// The desired motion over one tick: at its start and at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TargetPair {
    /// At the start of the tick.
    pub now: Target,
    /// At the end of the tick.
    pub next: Target,
}

impl TargetPair {
    /// Sets the velocities back by `share` of the tick. A body that is stepped by semi-implicit Euler has, at time t,
    /// the velocity of half a substep earlier. Its error has to be measured from that velocity, or limbs lag behind by
    /// their acceleration.
    pub fn set_velocities_back(&mut self, share: f64) {
        for (now, next) in self.now.velocity.iter_mut().zip(&mut self.next.velocity) {
            let change = share * (*next - *now);
            *now -= change;
            *next -= change;
        }
    }
}
