//! The motion that a figure should do at one instant.

use crate::body::{NV, Posture, State};
use crate::math::curve::smootherstep;
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

/// Times in which a motion comes to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestTimes {
    /// Moving parts stop within this time, s.
    pub stopping: f64,
    /// The body has come to its stand after this time, s.
    pub settling: f64,
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

    /// The same instant of the motion backwards in time.
    #[must_use]
    pub fn backwards(mut self) -> Self {
        self.velocity = self.velocity.map(|v| -v);
        self
    }

    /// The target `t` s after this one of a body that comes to rest in `stand`; rates are differences over `dt` s. No
    /// allocation.
    #[must_use]
    pub fn to_rest(&self, stand: &Posture, times: RestTimes, t: f64, dt: f64) -> Self {
        let RestTimes { stopping, settling } = times;
        let posture = |t: f64| {
            let left = (1.0 - t / stopping).max(0.0);
            let mut p = self.posture;
            p.integrate(&self.velocity, stopping * (1.0 - left * left * left) / 3.0);
            let way = p.difference(stand);
            p.integrate(&way, smootherstep(t / settling));
            p
        };
        let [a, now, b] = [t - dt, t, t + dt].map(posture);
        let rate = |a: &Posture, b: &Posture, h: f64| a.difference(b).map(|x| x / h);
        let (before, after) = (rate(&a, &now, dt), rate(&now, &b, dt));
        Self {
            posture: now,
            velocity: rate(&a, &b, 2.0 * dt),
            acceleration: std::array::from_fn(|i| (after[i] - before[i]) / dt),
            planted: self.planted,
        }
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
