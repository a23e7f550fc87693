//! Footstep tracking: a body whose feet land early, late and elsewhere follows a plan of stances.
//!
//! **Given** are a [`StepPlan`] (when and where feet stand), the motion at any time of the plan, and the state of the
//! body. **Computed** in each tick are
//!
//! * the time `φ` of the plan, which follows contact events instead of the clock: it waits for a foot that is late, and
//!   catches up after one that is early ([`contact_events`]);
//! * the map from the plan to the world, anchored at the last foothold ([`planned_to_world`]);
//! * displacements of the next footholds, such that the error `e = ξ − ξ_ref` of the capture point `ξ = c + ċ/ω` is
//!   gone when the foot lands ([`capture_point`], [`step_timing`], [`swing`]);
//! * unplanned steps, when balance is lost or feet are misplaced ([`step_decision`], [`recovery_step`],
//!   [`support_recovery`]);
//! * the horizontal acceleration of the centre of mass that keeps the zero-moment point in the support.
//!
//! The controller sees targets and contacts only. A clip whose feet never leave the floor passes unchanged, bit for
//! bit. `docs/locomotion.md` lists the alternatives that were tried, with results.

pub mod capture_point;
mod clip_end;
mod contact_events;
mod flight_phase;
mod foot_places;
mod leg_collision;
pub mod params;
pub mod planned_to_world;
pub mod recovery_step;
mod step_decision;
pub mod step_plan;
mod step_timing;
mod support_recovery;
mod swing;
mod trailing;

pub use capture_point::Capture;
pub use flight_phase::Flight;
pub use foot_places::FootPlace;
pub use recovery_step::{Purpose, RecoveryStep};
pub use step_plan::{Footfall, StepPlan};

use super::plan::StreamPlan;
use super::plan::foot_lock::Sole;
use super::plan::params::common::REST_SPEED;
use crate::body::{Body, Posture};
use crate::control::{FootTarget, PointTarget, com_law};
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::math::exp::exp;
use crate::motion::builtin::at_ease;
use crate::motion::{PlanarTransform, TargetPair};
use crate::support::Support;
use crate::time::WorldTime;
use clip_end::PlannedStand;
use foot_places::{stance_points, turn};
use params::common::{LEAST_SPEED, SETTLED_OFFSET};
use params::flight::ANNOUNCED;
use params::recovery::SHIFT_SPEED;
use planned_to_world::Anchor;
use serde::{Deserialize, Serialize};
use step_decision::{UnplannedStep, is_misplaced};
use step_timing::StepTiming;
use support_recovery::SupportRecovery;
use swing::follow_com;
use trailing::Trailing;

/// State of one foot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct TrackedFoot {
    /// On the floor, by events.
    down: bool,
    /// Landed before its time; the plan has to catch up.
    early: bool,
    /// Time for which it has been searching for the floor, s.
    late: f64,
    /// Clip time of its lift-off, s.
    lifted: f64,
    /// Distance from the plan at lift-off, m.
    release: Vec3,
    /// Displacement of its next foothold, m.
    shift: [f64; 2],
    /// Depth inside the space of the stance leg at lift-off, m, once the foot is led around that leg.
    initial_depth: Option<f64>,
}

impl TrackedFoot {
    /// Leaves the floor at clip time `phase` (s) for the next foothold of the plan.
    fn lift(&mut self, phase: f64) {
        *self = Self {
            down: false,
            late: 0.0,
            lifted: phase,
            shift: [0.0; 2],
            initial_depth: None,
            ..*self
        };
    }
}

/// A touch-down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Landing {
    /// 0 left, 1 right.
    pub side: usize,
    /// Time after the planned one, s; negative if earlier.
    pub late: f64,
    /// Distance from the foothold as it was mapped to the world, m.
    pub off: Vec3,
}

/// The targets that tracking may change in a tick.
#[derive(Debug)]
pub struct TaskTargets<'a> {
    /// Desired centre of mass.
    pub com: &'a mut PointTarget,
    /// Desired centroidal angular momentum, world axes, N·m·s.
    pub momentum: Vec3,
    /// Its rate, N·m.
    pub momentum_rate: Vec3,
    /// Desired ankles and rotations of the feet.
    pub feet: &'a mut [FootTarget; 2],
    /// Whether unplanned steps may be made.
    pub unplanned_steps: bool,
}

/// Dimensions of the legs: constants of the body.
#[derive(Clone, Debug, Default)]
struct Legs {
    soles: [Sole; 2],
    /// Length of a leg, m.
    length: f64,
    /// Posture of a stand at ease.
    at_ease: Posture,
}

impl Legs {
    fn of(body: &Body) -> Self {
        Self {
            soles: [Sole::new(body, 0), Sole::new(body, 1)],
            length: body.leg_length(0),
            at_ease: at_ease(body),
        }
    }
}

/// The plan that is followed: it is replaced as a whole.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct FollowedPlan {
    plan: StepPlan,
    /// Clip seconds per second.
    speed: f64,
    /// Place of the plan in the world before any step.
    origin: PlanarTransform,
    /// The stop, once the plan has ended in motion.
    stop: Option<PlannedStand>,
}

impl FollowedPlan {
    fn new(placed: PlacedPlan) -> Self {
        Self {
            plan: placed.plan,
            speed: placed.speed.max(LEAST_SPEED),
            origin: placed.origin,
            stop: None,
        }
    }
}

/// A plan to follow.
#[derive(Clone, Debug)]
pub struct PlacedPlan {
    /// When and where feet stand.
    pub plan: StepPlan,
    /// Clip seconds per second.
    pub speed: f64,
    /// Where the plan lies in the world.
    pub origin: PlanarTransform,
}

impl PlacedPlan {
    /// A plan that runs at `speed` clip seconds per second, at `origin` in the world.
    pub fn new(plan: StepPlan, speed: f64, origin: PlanarTransform) -> Self {
        Self {
            plan,
            speed,
            origin,
        }
    }
}

/// Time of the plan.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct PlanClock {
    /// Clip time now, s.
    phase: f64,
    /// World time that the plan is behind its schedule, s.
    lag: f64,
    /// Whether contacts are known.
    started: bool,
    /// Last speed of the pelvis over the floor in the motion before its end, m/s.
    last_speed: f64,
    /// Planned touch-downs since the motion began.
    landings: u32,
}

/// Events of this tick, for the report and the controller.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct TickEvents {
    landing: Option<Landing>,
    flight: Option<Flight>,
}

/// Height of the centre of mass above the motion's in the last tick, from which a fall in a flight starts.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct HeightError {
    /// Height above the motion's, m.
    height: f64,
    /// Upward speed beyond the motion's, m/s.
    speed: f64,
    /// Gravity, m/s².
    gravity: f64,
}

/// Actions beside the plan that keep or restore balance and stance.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Recovery {
    step: UnplannedStep,
    /// A raised foot that was put down early, and for which the plan waits.
    support: SupportRecovery,
    /// Whether a foot is not where the motion has it.
    misplaced: bool,
    /// Displacement of the desired centre of mass while a foot is brought back, m.
    shift: Vec3,
}

/// Footstep tracking of one figure. Remembers phase and footholds; nothing allocates in a tick.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StepTracker {
    /// Values that follow from the body.
    #[serde(skip)]
    legs: Legs,
    /// `None` for a motion whose feet never leave the floor.
    followed: Option<FollowedPlan>,
    clock: PlanClock,
    anchor: Anchor,
    trailing: Trailing,
    feet: [TrackedFoot; 2],
    capture: Capture,
    height_error: HeightError,
    events: TickEvents,
    recovery: Recovery,
    timing: StepTiming,
}

impl StepTracker {
    /// Tracking for figures with this body, standing.
    pub fn new(body: &Body) -> Self {
        Self {
            legs: Legs::of(body),
            followed: None,
            clock: PlanClock::default(),
            anchor: Anchor::default(),
            trailing: Trailing::default(),
            feet: [TrackedFoot::default(); 2],
            capture: Capture::new(body),
            height_error: HeightError::default(),
            events: TickEvents::default(),
            recovery: Recovery::default(),
            timing: StepTiming::default(),
        }
    }

    /// Adds the values that follow from the body to a tracker read from a checkpoint.
    pub fn complete(&mut self, body: &Body) {
        self.legs = Legs::of(body);
        self.capture.complete(body);
    }

    /// Whether this value is one that a checkpoint could hold: there are two feet, and times are numbers.
    pub fn is_valid(&self) -> bool {
        let times = [self.clock.phase, self.clock.lag, self.clock.last_speed];
        let follows = |f: &FollowedPlan| {
            f.plan.is_valid() && f.origin.is_finite() && (LEAST_SPEED..=1e3).contains(&f.speed)
        };
        if !(times.iter().all(|t| t.is_finite()) && self.followed.as_ref().is_none_or(follows)) {
            return false;
        }
        let sides = [
            self.events.landing.map(|l| l.side),
            self.timing.side(),
            self.timing.early.map(|e| e.side),
        ];
        let mut all = sides.into_iter().flatten();
        all.all(|side| side < 2)
            && self.recovery.step.is_valid()
            && self.recovery.support.is_valid()
    }

    /// Follows another motion from the next tick on: a clip with its plan, speed (clip seconds per second) and origin,
    /// or, if `None`, a motion whose feet stay in place.
    pub fn follow(&mut self, plan: Option<PlacedPlan>) {
        let steps = plan.filter(|p| p.plan.steps());
        self.followed = steps.map(FollowedPlan::new);
        self.reset();
    }

    /// Continues with another plan, with its speed and origin, in the middle of a motion; feet, places and lag stay.
    /// The new plan's time 0 is time `begin` (s) of the present one; both origins are in the same coordinates.
    pub fn continue_with(&mut self, plan: PlacedPlan, begin: f64) {
        let (next, speed) = (FollowedPlan::new(plan), self.speed());
        for foot in &mut self.feet {
            foot.lifted = (foot.lifted - begin) / speed * next.speed;
        }
        self.followed = Some(next);
        self.recovery.support.end();
    }

    /// Takes over the present knowledge of the stream that is followed.
    pub fn follow_stream(&mut self, motion: &StreamPlan) {
        if let Some(f) = &mut self.followed {
            f.plan.refresh(motion);
        }
    }

    /// Forgets the past, so that the motion is at its planned place.
    pub fn reset(&mut self) {
        self.anchor = Anchor::default();
        self.trailing = Trailing::default();
        self.feet = [TrackedFoot::default(); 2];
        self.clock.started = false;
        self.clock.landings = 0;
        self.clock.lag = 0.0;
        if let Some(f) = &mut self.followed {
            f.stop = None;
        }
        self.recovery = Recovery::default();
        self.timing = StepTiming::default();
    }

    /// Resets the clock only, for a frozen figure: the values that the clock keeps of the motion may not be finite.
    pub fn reset_clock(&mut self) {
        self.reset();
        self.clock = PlanClock::default();
    }

    /// Clip time now, s.
    pub fn phase(&self) -> f64 {
        self.clock.phase
    }

    /// World time by which the clip is behind its schedule, s.
    pub fn lag(&self) -> f64 {
        self.clock.lag
    }

    /// Error of the capture point, m.
    pub fn capture(&self) -> &Capture {
        &self.capture
    }

    /// The foot that came down in this tick.
    pub fn landing(&self) -> Option<&Landing> {
        self.events.landing.as_ref()
    }

    /// The unplanned step under way.
    pub fn recovery_step(&self) -> Option<&RecoveryStep> {
        self.recovery.step.swing()
    }

    /// A direction of the motion, turned with its origin to the actual stance.
    pub fn turned(&self, v: Vec3) -> Vec3 {
        turn(self.anchor.yaw()).rotate(v)
    }

    /// Whether it follows a motion with steps, even later ones; a standing stream has none.
    pub fn is_walking(&self) -> bool {
        let clip = |p: &StepPlan| !self.is_stopping() && !p.is_live();
        self.plan().is_some_and(clip) || self.is_stepping()
    }

    /// Distance of the capture point from its place in a motion with steps, allowing for the foothold to which a foot
    /// is being led, m; `None` while the figure follows no such motion.
    pub fn off_plan(&self) -> Option<f64> {
        // A recovery step catches what comes to where it lands.
        if let Some(leaves) = self.recovery_step().and_then(RecoveryStep::leaves) {
            return Some(leaves);
        }
        let error = Vec3::on_floor(self.capture.error);
        let swings = self.feet.iter().filter(|foot| !foot.down);
        let led = swings.map(|foot| (error - Vec3::on_floor(foot.shift)).level());
        (self.is_stepping() || self.leans_to_jump()).then(|| led.fold(self.capture.off(), f64::min))
    }

    /// Whether the capture point is where the motion has it.
    pub fn is_on_plan(&self) -> bool {
        self.capture.off() < SETTLED_OFFSET
    }

    /// Whether a step is made to catch the body, in a clip that has steps to come.
    pub fn has_lost_plan(&self) -> bool {
        let catches = |s: &RecoveryStep| s.purpose != Purpose::Return;
        let goes_on = |p: &StepPlan| !p.is_live() && !p.is_over(self.clock.phase);
        self.recovery_step().is_some_and(catches)
            && !self.is_stopping()
            && !self.recovery.support.is_active()
            && self.plan().is_some_and(goes_on)
            && (0..2).any(|side| self.next(side).is_some())
    }

    /// Whether it is making planned steps and is far enough off the plan that they have to change.
    pub fn is_far_off_plan(&self) -> bool {
        let moves = self.clock.last_speed > REST_SPEED && !self.is_airborne();
        self.is_stepping() && moves && self.capture.off() > params::step_timing::ERROR
    }

    /// Whether it stands: no step is under way or to come, its feet are where they should be, and the body is slow
    /// enough and near enough to its place to begin another motion.
    ///
    /// * `com_velocity`: of the centre of mass, world axes, m/s.
    pub fn is_settled(&self, com_velocity: Vec3) -> bool {
        let goes_on = self.followed.is_some() && !self.is_stopping();
        let to_come = |side: usize| !self.feet[side].down || self.next(side).is_some();
        let steps = self.recovers() || goes_on && (0..2).any(to_come);
        !steps
            && !self.recovery.misplaced
            && com_velocity.level() < REST_SPEED
            && self.capture.off() < SETTLED_OFFSET
    }

    /// Whether planned steps are being made. They are not while a stream stands, while the feet of a clip stay for a
    /// while, or until an unplanned step is finished.
    fn is_stepping(&self) -> bool {
        let (phase, down) = (self.clock.phase, self.feet[0].down && self.feet[1].down);
        let stands = |p: &StepPlan| {
            if p.is_live() {
                p.rests(phase)
            } else {
                down && p.pauses(phase)
            }
        };
        let plan = self.plan().filter(|p| !stands(p));
        plan.is_some() && !self.is_stopping() && !self.recovers()
    }

    /// Whether an unplanned step is being made, or the plan waits for one.
    fn recovers(&self) -> bool {
        self.recovery_step().is_some() || self.recovery.support.is_active()
    }

    /// Desired motion of the tick that starts at world time `time`.
    ///
    /// * `terms`: those of the present state; `plan_time`: time of the plan (s) at a world time; `pair(now, next)`: the
    ///   motion as planned, at two world times.
    /// * `fade`: if help keeps the figure with its motion, the time constant (s) with which lag and displacement of the
    ///   motion fade. Contacts are ignored; they are looked up again afterwards.
    pub fn targets(
        &mut self,
        time: WorldTime,
        dt: f64,
        terms: &Terms,
        plan_time: impl Fn(WorldTime) -> f64,
        pair: impl Fn(WorldTime, WorldTime) -> TargetPair,
        fade: Option<f64>,
    ) -> TargetPair {
        let carried = fade.is_some();
        self.events = TickEvents::default();
        if let Some(time) = fade {
            self.feet = [TrackedFoot::default(); 2];
            self.recovery = Recovery::default();
            self.timing = StepTiming::default();
            self.clock.started = false;
            let share = filter_gain(dt, time);
            self.anchor.go_home(share);
            self.trailing.rebase(self.anchor.transform());
            self.clock.lag *= 1.0 - share;
        } else {
            self.anchor.settle(dt);
        }
        let now = time - self.clock.lag;
        self.clock.phase = plan_time(now);
        let over = self.plan().is_some_and(|p| p.is_over(self.clock.phase));
        if over && !self.is_stopping() && self.clock.last_speed > REST_SPEED {
            let last = pair(now, now).now;
            self.begin_stop(terms, &last, Purpose::RecoverOnOwnSide);
        }
        let (mut out, planted) = if let Some(standing) = self.advance_stop(dt) {
            (standing, Some([true; 2]))
        } else if carried {
            (pair(now, now + dt), None)
        } else if self.followed.is_some() {
            let rate = self.update_contacts(terms, dt, || pair(now, now).now);
            self.clock.lag += (1.0 - rate) * dt;
            self.predict_landing(|ahead| pair(now + ahead, now + ahead).now);
            let mut out = pair(now, time + dt - self.clock.lag);
            self.recovery.support.slow(&mut out, &self.legs.at_ease, dt);
            self.events.flight = self.planned_flight(now).filter(|f| f.after < ANNOUNCED);
            (out, Some([self.feet[0].down, self.feet[1].down]))
        } else {
            (pair(time, time + dt), None)
        };
        if carried || self.anchor != Anchor::default() {
            let place = self.anchor.transform();
            place.apply_to(&mut out.now);
            place.apply_to(&mut out.next);
        }
        if !over {
            let v = &out.now.velocity;
            self.clock.last_speed = Vec3::on_floor([v[3], v[4]]).level();
        }
        let mut planted = planted.unwrap_or(out.next.planted);
        if let Some(step) = self.recovery.step.swing_mut() {
            step.since += dt;
            planted[step.side] = false;
        }
        if !carried && (self.followed.is_some() || self.recovery_step().is_some()) {
            out.now.planted = planted;
            out.next.planted = planted;
        }
        out
    }

    /// Lets the desired body follow the map for the `dt` seconds of its tick; feet are placed in
    /// [`Self::update_tasks`].
    ///
    /// * `out`: what [`Self::targets`] gave, with everything else that changes the posture.
    pub fn trail(&mut self, body: &Body, out: &mut TargetPair, dt: f64) {
        // The plan of a stream changes under its feet.
        let on_plan = self.is_stepping() || self.recovery.support.is_active();
        let legs_stand = on_plan && !self.is_live();
        let (map, omega) = (self.anchor.transform(), self.capture.omega());
        self.trailing.advance(omega, dt, legs_stand);
        if !self.trailing.is_at(&map) {
            let posture = &out.now.posture;
            let ankles = self.capture.feet(posture).map(|foot| foot.at);
            self.trailing.move_to(map, posture.root_position, ankles);
        }
        self.trailing.apply(out, body, omega, dt);
    }

    /// Updates the targets of feet and centre of mass: swinging feet are led, clear of the floor, to footholds that
    /// catch the body, and unplanned steps are begun and led. Returns the horizontal acceleration of the centre of mass
    /// that balance requires, m/s²; `None` without a support.
    pub fn update_tasks(
        &mut self,
        terms: &Terms,
        support: &Support,
        gravity: f64,
        dt: f64,
        tasks: &mut TaskTargets<'_>,
    ) -> Option<[f64; 2]> {
        let omega = self.capture.omega();
        self.trailing.release(tasks.feet, omega, dt);
        self.recovery.support.shift_com(tasks.com, omega, dt);
        self.capture
            .update(terms, tasks.com, support.polygon(), gravity, dt);
        let lands = self.timing.landing.is_some();
        self.capture
            .update_disturbance(terms, tasks.momentum, lands, self.is_stepping());
        self.height_error = HeightError {
            height: terms.com.z - tasks.com.now.z,
            speed: terms.com_velocity.z - tasks.com.now_velocity.z,
            gravity,
        };
        let (now, planned) = (self.places(terms), self.planned_places(tasks.feet));
        self.recovery.misplaced = (0..2).any(|k| is_misplaced(&now[k], &planned[k]));
        if tasks.unplanned_steps && self.is_stepping() {
            self.begin_support_recovery(terms, support, &now, dt);
            self.step_out_of_start(terms, support, [&now, &planned]);
        }
        if self.is_stepping() {
            // A step that brought a foot back leaves the body over the other one.
            let shift = &mut self.recovery.shift;
            *shift -= shift.capped(SHIFT_SPEED * dt);
            tasks.com.shift(*shift);
            self.update_step_timing(terms, support);
            for side in 0..2 {
                self.update_swing(terms, side, dt, &mut tasks.feet[side]);
            }
            if self.is_airborne() {
                follow_com(terms, dt, tasks);
            }
        } else {
            self.timing.early = None;
            if tasks.unplanned_steps {
                let home = self.recovery.support.home(planned, self.legs.length);
                self.update_recovery_step(terms, support, dt, [&now, &home], tasks);
                self.hold_support(terms, support, &now, dt, tasks.feet);
            }
        }
        self.keep_headings(terms, tasks.feet);
        let swings = self.recovery.step.swing();
        if let Some(step) = swings.filter(|s| s.purpose != Purpose::Return) {
            let stance = stance_points(support, step.side);
            return Some(self.capture.slowest_fall(terms, stance));
        }
        if let Some(early) = self.timing.early {
            return Some(self.capture.fall_about(terms, support.polygon(), early.zmp));
        }
        let wanted = com_law(tasks.com, terms.com, terms.com_velocity, dt);
        self.capture.feasible(
            terms,
            wanted,
            tasks.momentum_rate,
            support.polygon(),
            gravity,
        )
    }

    /// Whether footholds are known in advance. Those of a stream are found while it is followed, and those of an
    /// unplanned step while it is made.
    pub fn has_planned_footholds(&self) -> bool {
        self.recovery_step().is_none() && self.plan().is_some_and(|p| !p.is_live())
    }

    /// The foot that is on the floor, if the other one is not.
    fn only_stance(&self) -> Option<usize> {
        let [left, right] = self.feet.map(|foot| foot.down);
        (left != right).then(|| usize::from(right))
    }

    /// Whether it follows a stream.
    fn is_live(&self) -> bool {
        self.plan().is_some_and(StepPlan::is_live)
    }

    fn plan(&self) -> Option<&StepPlan> {
        self.followed.as_ref().map(|f| &f.plan)
    }

    /// Clip seconds per second.
    fn speed(&self) -> f64 {
        self.followed.as_ref().map_or(1.0, |f| f.speed)
    }

    /// World time until clip time `t` (s) at the plan's speed, s.
    fn until(&self, t: f64) -> f64 {
        (t - self.clock.phase) / self.speed()
    }

    /// The present stance of a foot in the plan.
    fn planned(&self, side: usize) -> Option<Footfall> {
        self.plan()?.current(side, self.clock.phase)
    }

    /// The next stance of a foot.
    fn next(&self, side: usize) -> Option<Footfall> {
        self.plan()?.next(side, self.clock.phase)
    }
}

/// Fraction by which a first-order filter with time constant `time` (s) approaches a new value in `dt` seconds.
fn filter_gain(dt: f64, time: f64) -> f64 {
    1.0 - exp(-dt / time)
}
