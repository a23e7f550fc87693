//! A motion that was rehearsed (`sim::rehearsal`), and how a figure plays it.
//!
//! A rehearsed motion is a recording together with joint offsets for windows of a tenth of a second, which make stiff
//! motors of human strength perform it in our own simulator. Played from the state in which the rehearsal started, it
//! runs exactly as it did there. A weak spring, the *hold*, leads the pelvis back to its path in the rehearsal; on that
//! path its force is zero. If strength alone was not enough, the rehearsal found impulses on the pelvis, the *help*,
//! which are applied as found. Both are bounded, and reported like any assist.
//!
//! During such a motion no step is planned and no balance is watched: the motion itself states which parts touch, and
//! when. It is over at its end, or when the figure is farther from the path than the hold can correct. Then the figure
//! stands, recovers or falls as after any other motion.

use crate::body::topology::DOF_COUNT;
use crate::body::{NV, State};
use crate::motion::clip::PlanarTransform;
use crate::motion::{Target, TargetPair};
use crate::stepper::motor_law::MotorLaw;
use crate::stepper::pelvis_wrench::PelvisHelp;
use crate::stepper::pelvis_wrench::{PelvisHold, PelvisPath, RootStep};
use crate::tick_context::TickContext;
use crate::time::WorldTime;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How near a figure has to be to the beginning of a rehearsed motion to start it: it must stand in the same posture,
/// as steadily as a body stands.
struct StartTolerance {
    /// Turn of the pelvis, rad.
    turn: f64,
    /// Distance of the pelvis, m.
    place: f64,
    /// Root of the sum of the squared errors of all joints, rad.
    joints: f64,
    /// Velocity of the pelvis, m/s.
    speed: f64,
}

/// See [`StartTolerance`].
const NEAR: StartTolerance = StartTolerance {
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
    /// The recording with the ways in and out at the start of each tick, and at the end of the last one.
    pub desired: Vec<Target>,
    /// Offsets of the desired joints, rad, by window.
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

    /// Length of the way into the recording, s.
    pub fn lead_in(&self) -> f64 {
        self.lead as f64 * self.stage.dt
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

/// A rehearsed motion being played.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RehearsedPlayback {
    /// The motion.
    #[serde(with = "crate::saved::definition")]
    pub motion: Arc<RehearsedMotion>,
    /// When its first tick begins.
    pub start: WorldTime,
    /// Its place in the world.
    pub origin: PlanarTransform,
    /// Whether it contains help.
    helped: bool,
}

impl RehearsedPlayback {
    /// `motion` at its own place, from world time `start` on.
    pub fn new(motion: Arc<RehearsedMotion>, start: WorldTime) -> Self {
        Self {
            helped: motion.path.iter().any(RootStep::is_helped),
            motion,
            start,
            origin: PlanarTransform::default(),
        }
    }

    /// The same motion at another place.
    #[must_use]
    pub fn at(mut self, origin: PlanarTransform) -> Self {
        self.origin = origin;
        self
    }

    /// Whether it contains help.
    pub fn is_helped(&self) -> bool {
        self.helped
    }

    /// World time `t` as the nearest number of ticks since its start.
    fn ticks_at(&self, t: WorldTime) -> f64 {
        ((t - self.start) / self.motion.stage.dt).round()
    }

    /// The tick that begins at world time `t`: the first before its start, the last after its end.
    fn tick(&self, t: WorldTime) -> usize {
        (self.ticks_at(t).max(0.0) as usize).min(self.motion.ticks() - 1)
    }

    /// Whether no tick of it begins at world time `t`.
    pub fn is_over(&self, t: WorldTime) -> bool {
        self.ticks_at(t) >= self.motion.ticks() as f64
    }

    /// The recording at world time `t`. No allocation.
    pub fn sample(&self, t: WorldTime) -> Target {
        let at = self.ticks_at(t).max(0.0) as usize;
        let mut target = self.motion.desired[at.min(self.motion.ticks())].clone();
        if self.origin != PlanarTransform::default() {
            self.origin.apply_to(&mut target);
        }
        target
    }

    /// The joint offsets of the tick that begins at world time `t`.
    pub fn offset(&self, t: WorldTime) -> &JointOffset {
        &self.motion.offsets[self.tick(t) / self.motion.window]
    }

    /// The path of the pelvis in the tick that begins at world time `t`.
    pub fn path(&self, t: WorldTime) -> PelvisPath<'_> {
        let per_tick = self.motion.stage.substeps as usize;
        let first = self.tick(t) * per_tick;
        PelvisPath {
            steps: &self.motion.path[first..first + per_tick],
            origin: self.origin,
        }
    }

    /// The help for the pelvis in the tick that begins at world time `t`, if there is any.
    pub(in crate::figure) fn help(&self, t: WorldTime) -> Option<PelvisHelp<'_>> {
        let (hold, path) = (self.motion.hold, self.path(t));
        let acts = hold.most.iter().any(|m| *m > 0.0) || path.steps.iter().any(RootStep::is_helped);
        acts.then_some(PelvisHelp::Rehearsed(hold, path))
    }

    /// Whether a figure in `state` can start it: the hold can correct the remaining difference.
    pub(in crate::figure) fn begins_at(&self, state: &State) -> bool {
        let first = self.sample(self.start);
        let off = state.posture.difference(&first.posture);
        let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let rate: [f64; 3] = std::array::from_fn(|i| state.velocity[3 + i] - first.velocity[3 + i]);
        length(&off[..3]) < NEAR.turn
            && length(&off[3..6]) < NEAR.place
            && length(&off[6..]) < NEAR.joints
            && length(&rate) < NEAR.speed
    }

    /// Whether a figure in `state` at the start of the tick at `t` can continue with it in this world.
    pub(in crate::figure) fn goes_on(
        &self,
        t: WorldTime,
        state: &State,
        world: &TickContext,
    ) -> bool {
        let path = self.path(t).step(0).position;
        !self.is_over(t)
            && self.motion.stage == RehearsalWorld::of(world)
            && (path - state.posture.root_position).norm() <= self.motion.hold.reach
    }
}
