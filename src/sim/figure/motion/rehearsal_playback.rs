//! How a figure plays a rehearsed motion.
//!
//! A figure that stands otherwise than the motion begins can be *led* into it, by stiff motors and a spring on the
//! pelvis, which is bounded and reported like any help.
//!
//! During such a motion no step is planned and no balance is watched: the motion itself states which parts touch, and
//! when. It is over at its end, or when the figure is farther from the path than the hold can correct. Then the figure
//! stands, recovers or falls as after any other motion.

use crate::body::{Body, Posture, State};
use crate::figure::motion::clip_playback::ClipPlayback;
use crate::figure::motion::rehearsed::{JointOffset, NEAR, RehearsalWorld, RehearsedMotion};
use crate::motion::clip::PlanarTransform;
use crate::motion::target::RestTimes;
use crate::motion::{Target, TargetPair};
use crate::stepper::pelvis_wrench::{Assist, PelvisHelp, PelvisPath, RootStep};
use crate::tick_context::TickContext;
use crate::time::WorldTime;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Times of the way into a motion that no steps lead into, backwards: the body takes a run-up, or goes down.
const ENTRY: RestTimes = RestTimes {
    stopping: ENTRY_TIME,
    settling: ENTRY_TIME,
};

/// Length of that way, s: about the time in which a body goes down into a crouch and comes to speed.
pub const ENTRY_TIME: f64 = 1.0;

/// How a figure comes into a rehearsed motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RehearsalEntry {
    /// It begins at rest: from a stand, with the steps that the clip has.
    FromStand,
    /// It begins in motion: from any posture with help, within [`ENTRY_TIME`].
    Led,
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
    /// The way from the figure's posture into it, if it does not begin there.
    entry: Option<LedEntry>,
}

/// The way into a motion from any posture: stiff motors, and a stiff spring of bounded force on the pelvis, lead to its
/// first state. It arrives there within [`NEAR`] at full speed, which the softer pull of live help does not.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct LedEntry {
    /// Where it begins.
    from: Posture,
    /// Largest force of the spring over the weight.
    most: f64,
    /// Played instead if it does not get there.
    instead: Box<ClipPlayback>,
}

impl RehearsedPlayback {
    /// `motion` at its own place, from world time `start` on.
    pub fn new(motion: Arc<RehearsedMotion>, start: WorldTime) -> Self {
        Self {
            helped: motion.path.iter().any(RootStep::is_helped),
            motion,
            start,
            origin: PlanarTransform::default(),
            entry: None,
        }
    }

    /// The same motion, led into from a posture at its present start, with at most this force over the weight.
    /// `instead` is played if that does not succeed.
    pub(in crate::figure) fn led_from(
        mut self,
        from: Posture,
        most: f64,
        instead: ClipPlayback,
    ) -> Self {
        let ticks = (ENTRY.settling / self.motion.stage.dt).ceil();
        self.start = self.start + ticks * self.motion.stage.dt;
        let instead = Box::new(ClipPlayback {
            start: self.start + self.motion.lead_in(),
            origin: self.origin,
            rehearsed: None,
            ..instead
        });
        self.entry = Some(LedEntry {
            from,
            most,
            instead,
        });
        self
    }

    /// Whether this value is one that a checkpoint could hold.
    pub(in crate::figure) fn is_valid(&self) -> bool {
        let entry = |e: &LedEntry| {
            e.from.is_valid() && (0.0..=2.0).contains(&e.most) && e.instead.is_valid()
        };
        self.start.is_finite() && self.origin.is_finite() && self.entry.as_ref().is_none_or(entry)
    }

    /// The same motion at another place.
    #[must_use]
    pub fn at(mut self, origin: PlanarTransform) -> Self {
        self.origin = origin;
        self
    }

    /// Whether it contains help, or is led into.
    pub fn is_helped(&self) -> bool {
        self.helped || self.entry.is_some()
    }

    /// Ends the way into it, if that is over at world time `t`.
    pub(in crate::figure) fn end_entry_if_over(&mut self, t: WorldTime) {
        if self.ticks_at(t) >= 0.0 {
            self.entry = None;
        }
    }

    /// The clip that a figure plays that could not be led into it.
    pub(in crate::figure) fn take_instead(&mut self) -> Option<ClipPlayback> {
        self.entry.take().map(|entry| *entry.instead)
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
        let (at, dt) = (self.ticks_at(t), self.motion.stage.dt);
        let tick = (at.max(0.0) as usize).min(self.motion.ticks());
        let mut target = self.motion.desired[tick].clone();
        if self.origin != PlanarTransform::default() {
            self.origin.apply_to(&mut target);
        }
        match &self.entry {
            Some(entry) if at < 0.0 => target
                .backwards()
                .to_rest(&entry.from, ENTRY, -at * dt, dt)
                .backwards(),
            _ => target,
        }
    }

    /// The joint offsets of the tick that begins at world time `t`.
    pub fn offset(&self, t: WorldTime) -> JointOffset {
        if self.entry.is_some() {
            return JointOffset::default();
        }
        self.motion.offset(self.tick(t))
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
    pub(in crate::figure) fn help<'a>(
        &'a self,
        t: WorldTime,
        body: &Body,
        target: &'a TargetPair,
    ) -> Option<PelvisHelp<'a>> {
        if let Some(entry) = &self.entry {
            return Some(PelvisHelp::Desired(
                Assist::bounded(body, entry.most),
                target,
            ));
        }
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
        let path = match &self.entry {
            Some(_) if self.ticks_at(t) < 0.0 => self.sample(t).posture.root_position,
            Some(_) if !self.begins_at(state) => return false,
            _ => self.path(t).step(0).position,
        };
        !self.is_over(t)
            && self.motion.stage == RehearsalWorld::of(world)
            && (path - state.posture.root_position).norm() <= self.motion.hold.reach
    }
}
