//! A motion that was rehearsed (`sim::rehearsal`).
//!
//! A rehearsed motion is a recording together with joint offsets at the ends of windows of a tenth of a second, which
//! make stiff motors of human strength perform it in our own simulator. Played from the state in which the rehearsal
//! started, it runs exactly as it did there. A weak spring, the *hold*, leads the pelvis back to its path in the
//! rehearsal; on that path its force is zero. If strength alone was not enough, the rehearsal found impulses on the
//! pelvis, the *help*, which are applied as found.

use crate::body::topology::DOF_COUNT;
use crate::body::{NV, State};
use crate::motion::{Target, TargetPair};
use crate::stepper::motor_law::MotorLaw;
use crate::stepper::pelvis_wrench::{PelvisHold, RootStep};
use crate::tick_context::TickContext;
use serde::{Deserialize, Serialize};

/// How near a figure has to be to the beginning of a rehearsed motion to start it: it must stand in the same posture,
/// as steadily as a body stands.
pub(super) struct StartTolerance {
    /// Turn of the pelvis, rad.
    pub turn: f64,
    /// Distance of the pelvis, m.
    pub place: f64,
    /// Root of the sum of the squared errors of all joints, rad.
    pub joints: f64,
    /// Velocity of the pelvis, m/s.
    pub speed: f64,
}

/// See [`StartTolerance`].
pub(super) const NEAR: StartTolerance = StartTolerance {
    turn: 0.2,
    place: 0.08,
    joints: 0.6,
    speed: 0.25,
};

/// Longest rehearsed motion, ticks: ten minutes at 60 a second.
pub const MAX_TICKS: usize = 36_000;

/// The world that a motion is rehearsed in. It is not played in any other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RehearsalWorld {
    /// Length of a tick, s.
    pub dt: f64,
    /// Substeps of a tick.
    pub substeps: u32,
    /// Magnitude of gravity, m/s².
    pub gravity: f64,
}

impl RehearsalWorld {
    /// The world of a tick.
    pub fn of(world: &TickContext) -> Self {
        Self {
            dt: world.dt,
            substeps: world.substeps,
            gravity: world.gravity,
        }
    }
}

/// A recording with the data that make it playable. Immutable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RehearsedMotion {
    /// The world that it is for.
    pub stage: RehearsalWorld,
    /// How motors follow it.
    pub motors: MotorLaw,
    /// The spring that leads back to its path; with largest force and moment 0 there is none.
    pub hold: PelvisHold,
    /// Ticks before the first frame of the recording.
    pub lead: usize,
    /// Length of a window, ticks.
    pub window: usize,
    /// Ticks of a window in which its offsets are reached; with 1 they jump.
    pub ramp: usize,
    /// The recording with the ways in and out at the start of each tick, and at the end of the last one.
    pub desired: Vec<Target>,
    /// Offsets of the desired joints, rad, at the end of each window; none at the start of the first. They are
    /// reached at a constant rate in `ramp` ticks ([`JointOffset::on_the_way`]).
    pub offsets: Vec<JointOffset>,
    /// The path of the pelvis, by substep.
    pub path: Vec<RootStep>,
}

/// Angles that are added to the joints along their axes, rad.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointOffset(#[serde(with = "crate::saved::array")] pub [f64; DOF_COUNT]);

impl Default for JointOffset {
    fn default() -> Self {
        Self([0.0; DOF_COUNT])
    }
}

impl JointOffset {
    /// The offset in tick `k` of a window that reaches this one in `ramp` ticks, from `before`, that of the previous
    /// window. No allocation.
    #[must_use]
    pub fn on_the_way(&self, before: &Self, k: usize, ramp: usize) -> Self {
        let share = ((k + 1) as f64 / ramp as f64).min(1.0);
        let between = |j: usize| before.0[j] + share * (self.0[j] - before.0[j]);
        Self(std::array::from_fn(between))
    }

    /// Adds it to both ends of a tick; the rates stay. No allocation.
    pub fn add_to(&self, target: &mut TargetPair) {
        let mut by = [0.0; NV];
        by[6..].copy_from_slice(&self.0);
        for t in [&mut target.now, &mut target.next] {
            t.posture.integrate(&by, 1.0);
        }
    }
}

impl RehearsedMotion {
    /// Number of ticks.
    pub fn ticks(&self) -> usize {
        self.desired.len().saturating_sub(1)
    }

    /// Length, s.
    pub fn duration(&self) -> f64 {
        self.ticks() as f64 * self.stage.dt
    }

    /// Whether it begins with a body at rest, so that one that stands there can begin it.
    pub fn begins_at_rest(&self) -> bool {
        let rate = &self.desired[0].velocity[3..6];
        rate.iter().map(|x| x * x).sum::<f64>().sqrt() < NEAR.speed
    }

    /// Length of the way into the recording, s.
    pub fn lead_in(&self) -> f64 {
        self.lead as f64 * self.stage.dt
    }

    /// The joint offsets of tick `k`. No allocation.
    pub fn offset(&self, k: usize) -> JointOffset {
        let (w, within) = (k / self.window, k % self.window);
        let before = w.checked_sub(1).map(|w| self.offsets[w]);
        self.offsets[w].on_the_way(&before.unwrap_or_default(), within, self.ramp)
    }

    /// The state that it was rehearsed from.
    pub fn start(&self) -> State {
        self.desired[0].state()
    }

    /// Whether its parts fit each other and can be played. The result of a rehearsal always does.
    pub fn is_valid(&self) -> bool {
        let Self {
            stage,
            motors,
            hold,
            lead,
            window,
            ramp,
            desired,
            offsets,
            path,
        } = self;
        let within = |x: f64, [least, most]: [f64; 2]| x >= least && x <= most;
        let n = self.ticks();
        let steps = n.checked_mul(stage.substeps as usize);
        (1..=MAX_TICKS).contains(&n)
            && within(stage.dt, [1e-3, 0.1])
            && (1..=16).contains(&stage.substeps)
            && within(stage.gravity, [0.0, 30.0])
            && within(motors.horizon, [1e-3, 2.0])
            && within(motors.saturation_speed, [1e-4, 100.0])
            && hold.is_valid()
            && *lead <= n
            && (1..=n).contains(window)
            && (1..=*window).contains(ramp)
            && offsets.len() == n.div_ceil(*window)
            && steps == Some(path.len())
            && desired.iter().all(|t| t.state().is_finite())
            && offsets
                .iter()
                .flat_map(|o| o.0)
                .all(|x| within(x, [-10.0, 10.0]))
            && path.iter().all(|s| {
                let vectors = s.velocity.iter().chain(&s.help);
                s.position.is_finite()
                    && s.rotation.is_finite()
                    && vectors.into_iter().all(|v| v.is_finite())
            })
    }
}
