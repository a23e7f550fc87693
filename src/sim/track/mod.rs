//! Steps: a played clip becomes a plan of footholds that follows what the feet really do (WALKING §2–4).
//!
//! The motion layer decides *when* (contact by events, not by the clock) and *where* (re-anchoring, step adaptation);
//! the controller only sees targets and which feet are planted. A clip whose feet never leave the floor passes through
//! unchanged, bit for bit.

pub mod capture_point;
mod clip_end;
mod contact_events;
mod flight_phase;
mod foot_places;
mod leg_collision;
pub mod planned_to_world;
pub mod recovery_step;
mod step_decision;
pub mod step_plan;
mod step_timing;
mod support_recovery;
mod swing;

pub use capture_point::Capture;
pub use flight_phase::Flight;
pub use recovery_step::{Purpose, RecoveryStep};
pub use step_plan::{Footfall, StepPlan};

use super::plan::StreamPlan;
use super::plan::foot_lock::Sole;
use crate::sim::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::sim::body::{Body, Posture, SegmentId};
use crate::sim::control::{Balance, PointTarget, RotationTarget, com_law};
use crate::sim::dynamics::Terms;
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::builtin::at_ease;
use crate::sim::motion::{PlanarTransform, TargetPair};
use crate::sim::support::Support;
use flight_phase::AHEAD;
use foot_places::{level, stance_points};
use planned_to_world::Anchor;
use step_decision::is_untidy;
use step_timing::{HastenedStep, PlannedLanding};
use support_recovery::SupportRecovery;
use swing::follow_mass;

const FOOT: [SegmentId; 2] = [L_FOOT, R_FOOT];
const TOES: [SegmentId; 2] = [L_TOES, R_TOES];
/// A sole lower than this touches, m.
const TOUCH: f64 = 0.004;
/// A body slower than this, and a capture point closer to its place than this, is settled: m/s and m.
const SETTLED: (f64, f64) = (0.1, 0.03);
/// Slowest clip-time rate that counts as playing at all.
const STILL: f64 = 1e-9;

/// What one foot is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Foot {
    /// On the floor, by events.
    down: bool,
    /// Landed before its time; the plan has to catch up.
    early: bool,
    /// How long it has been looking for the floor, s.
    late: f64,
    /// Clip time of its lift-off, s.
    lifted: f64,
    /// Distance from the plan at lift-off, m.
    release: Vec3,
    /// Displacement of its next foothold, m.
    shift: [f64; 2],
    /// How far it was inside what the other leg needs when it lifted off, once it is led past it, m.
    tight: Option<f64>,
}

impl Foot {
    /// Leaves the floor at clip time `phase`, for the foothold that the plan has next.
    fn lift(&mut self, phase: f64) {
        *self = Self {
            down: false,
            late: 0.0,
            lifted: phase,
            shift: [0.0; 2],
            tight: None,
            ..*self
        };
    }
}

/// How a foot came down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// 0 left, 1 right.
    pub side: usize,
    /// Later than planned, s; negative if earlier.
    pub late: f64,
    /// Distance from the foothold as it was mapped to the world, m.
    pub off: Vec3,
}

/// By how much the centre of mass was above the motion's in the last tick.
#[derive(Clone, Copy, Debug, Default)]
struct Above {
    /// How much higher it was, m.
    height: f64,
    /// How much faster it rose, m/s.
    speed: f64,
    /// Gravity, m/s².
    gravity: f64,
}

/// What tracking may change in a tick.
#[derive(Debug)]
pub struct TaskTargets<'a> {
    /// Desired centre of mass.
    pub com: &'a mut PointTarget,
    /// Rate of the desired centroidal angular momentum, N·m.
    pub moment: Vec3,
    /// Desired centroidal angular momentum, N·m·s.
    pub spin: Vec3,
    /// Desired ankles and rotations of the feet.
    pub feet: &'a mut [(PointTarget, RotationTarget); 2],
    /// Steps may be made that no clip planned.
    pub unplanned: bool,
}

/// The steps of one figure. Remembers phase and footholds; nothing allocates in a tick.
#[derive(Clone, Debug)]
pub struct StepTracker {
    soles: [Sole; 2],
    leg: f64,
    ease: Posture,
    /// Plan of the clip that plays, if its feet leave the floor.
    plan: Option<StepPlan>,
    speed: f64,
    origin: PlanarTransform,
    /// Last posture of a clip that ended in a step, and the time since, s.
    ended: Option<(Posture, f64)>,
    /// Speed of the pelvis over the floor as the motion last had it before it was over, m/s.
    last_speed: f64,
    anchor: Anchor,
    feet: [Foot; 2],
    started: bool,
    /// World time that the clip is behind its schedule, s.
    lag: f64,
    /// Clip time now, s.
    phase: f64,
    capture: Capture,
    flight: Option<Flight>,
    above: Above,
    landing: Option<Landing>,
    step: Option<RecoveryStep>,
    /// Foot that is about to be brought back, or is.
    tidying: Option<usize>,
    /// Whether the motion waits for a body that has put its raised foot down.
    wait: SupportRecovery,
    /// A foot is not where the motion has it.
    untidy: bool,
    /// Displacement of the desired centre of mass while feet are brought back, m.
    lean: Vec3,
    /// What the motion has in store for the next touch-down, while that matters.
    arrival: Option<PlannedLanding>,
    /// The next step, if it is made in a hurry.
    quick: Option<HastenedStep>,
}

impl StepTracker {
    /// Steps of figures with this body, standing.
    pub fn new(body: &Body) -> Self {
        let leg =
            body.joint_offset[L_FOOT.index()].norm() + body.joint_offset[L_FOOT.index() - 1].norm();
        Self {
            soles: [Sole::new(body, 0), Sole::new(body, 1)],
            leg,
            ease: at_ease(body),
            plan: None,
            speed: 1.0,
            origin: PlanarTransform::default(),
            ended: None,
            last_speed: 0.0,
            anchor: Anchor::default(),
            feet: [Foot::default(); 2],
            started: false,
            lag: 0.0,
            phase: 0.0,
            capture: Capture::new(body),
            flight: None,
            above: Above::default(),
            landing: None,
            step: None,
            tidying: None,
            wait: SupportRecovery::default(),
            untidy: false,
            lean: Vec3::zero(),
            arrival: None,
            quick: None,
        }
    }

    /// Follows another motion from the next tick on: a clip with its plan, speed (clip seconds per second) and origin,
    /// or, without, one whose feet stay where they are.
    pub fn follow(&mut self, plan: Option<(StepPlan, f64, PlanarTransform)>) {
        self.plan = None;
        if let Some((plan, speed, origin)) = plan.filter(|(p, ..)| p.steps()) {
            self.plan = Some(plan);
            self.speed = speed.max(STILL);
            self.origin = origin;
        }
        self.reset();
    }

    /// Goes on with another plan, with its speed and origin, in the middle of a motion: feet, places and lag stay. The
    /// new plan's time 0 is time `begin` (s) of the present one; both origins are in the same coordinates.
    pub fn go_on(&mut self, (plan, speed, origin): (StepPlan, f64, PlanarTransform), begin: f64) {
        let speed = speed.max(STILL);
        for foot in &mut self.feet {
            foot.lifted = (foot.lifted - begin) / self.speed * speed;
        }
        self.plan = Some(plan);
        self.speed = speed;
        self.origin = origin;
        self.ended = None;
        self.wait.end();
    }

    /// Time of the motion now, s.
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// True while it follows a motion that steps, if only later; a stream that stands does not.
    pub fn is_walking(&self) -> bool {
        let clip = |p: &StepPlan| self.ended.is_none() && !p.is_live();
        self.plan.as_ref().is_some_and(clip) || self.walks()
    }

    /// Takes over what is known now of the stream that is followed.
    pub fn follow_stream(&mut self, motion: &StreamPlan) {
        if let Some(plan) = &mut self.plan {
            plan.refresh(motion);
        }
    }

    /// Forgets the past: the motion lies where it was planned.
    pub fn reset(&mut self) {
        self.anchor = Anchor::default();
        self.feet = [Foot::default(); 2];
        self.started = false;
        self.lag = 0.0;
        self.ended = None;
        self.step = None;
        self.tidying = None;
        self.wait = SupportRecovery::default();
        self.untidy = false;
        self.lean = Vec3::zero();
        (self.arrival, self.quick) = (None, None);
    }

    /// World time by which the clip is behind its schedule, s.
    pub fn lag(&self) -> f64 {
        self.lag
    }

    /// Error of the capture point, m.
    pub fn capture(&self) -> &Capture {
        &self.capture
    }

    /// Distance of the capture point from where a motion that steps has it, or from where that will be with the
    /// foothold to which a foot is led, m; `None` while the figure follows no such motion.
    pub fn off_plan(&self) -> Option<f64> {
        let [x, y] = self.capture.error;
        let swings = self.feet.iter().filter(|foot| !foot.down);
        let led = swings.map(|foot| (x - foot.shift[0]).hypot(y - foot.shift[1]));
        (self.walks() || self.leans_to_jump()).then(|| led.fold(self.capture.off(), f64::min))
    }

    /// True if it stands: no step is under way, none is to come, its feet are where they should be, and the body is
    /// slow enough and near enough to where it should be to begin something else.
    pub fn is_settled(&self, terms: &Terms) -> bool {
        let v = terms.com_velocity;
        let to_come = |side: usize| {
            let plan = self.plan.as_ref().filter(|_| self.ended.is_none());
            plan.is_some_and(|_| !self.feet[side].down || self.next(side).is_some())
        };
        self.step.is_none()
            && !self.wait.waits()
            && !self.untidy
            && !(0..2).any(to_come)
            && (v.x * v.x + v.y * v.y).sqrt() < SETTLED.0
            && self.capture.off() < SETTLED.1
    }

    /// True while steps are made that a plan has: not while a stream stands, nor while the feet of a clip stay for a
    /// while, nor until a step that nobody planned is finished.
    fn walks(&self) -> bool {
        let down = self.feet[0].down && self.feet[1].down;
        let stands = |p: &StepPlan| {
            let rests = if p.is_live() {
                p.rests(self.phase)
            } else {
                down && p.pauses(self.phase)
            };
            self.step.is_some() || self.wait.waits() || rests
        };
        self.ended.is_none() && self.plan.as_ref().is_some_and(|p| !stands(p))
    }

    /// The foot that came down in this tick.
    pub fn landing(&self) -> Option<&Landing> {
        self.landing.as_ref()
    }

    /// The step under way that no clip planned.
    pub fn unplanned(&self) -> Option<&RecoveryStep> {
        self.step.as_ref()
    }

    /// Desired motion of the tick that starts at world time `time`.
    ///
    /// * `terms`: those of the present state; `clip_time`: clip time at a world time; `pair(now, next)`: the motion as
    ///   planned, at two world times.
    pub fn targets(
        &mut self,
        time: f64,
        dt: f64,
        terms: &Terms,
        clip_time: impl Fn(f64) -> f64,
        pair: impl Fn(f64, f64) -> TargetPair,
    ) -> TargetPair {
        (self.landing, self.flight) = (None, None);
        self.anchor.settle(dt);
        self.phase = clip_time(time - self.lag);
        let now = time - self.lag;
        let over = self.plan.as_ref().is_some_and(|p| p.is_over(self.phase));
        if self.ended.is_none() && over && self.last_speed > SETTLED.0 {
            self.end(terms, &pair(now, now).now.posture);
        }
        let mut out;
        let mut planted;
        if let Some(standing) = self.ease_on(dt) {
            out = standing;
            planted = [true; 2];
        } else if self.plan.is_some() {
            let rate = self.schedule(terms, dt, || pair(now, now).now);
            self.lag += (1.0 - rate) * dt;
            self.foresee(|ahead| pair(now + ahead, now + ahead).now);
            out = pair(now, time + dt - self.lag);
            self.wait.slow(&mut out, &self.ease, dt);
            self.flight = self.coming(now).filter(|f| f.after < AHEAD);
            planted = [self.feet[0].down, self.feet[1].down];
        } else {
            out = pair(time, time + dt);
            planted = out.next.planted;
        }
        if self.anchor != Anchor::default() {
            let place = self.anchor.transform();
            place.apply_to(&mut out.now);
            place.apply_to(&mut out.next);
        }
        if !over {
            let v = &out.now.velocity;
            self.last_speed = (v[3] * v[3] + v[4] * v[4]).sqrt();
        }
        if let Some(step) = &mut self.step {
            step.since += dt;
            planted[step.side] = false;
        }
        if self.ended.is_some() || self.plan.is_some() || self.step.is_some() {
            out.now.planted = planted;
            out.next.planted = planted;
        }
        out
    }

    /// Leads the swinging feet to footholds that catch the body, clear of the floor (step adaptation, WALKING §4), and
    /// decides on steps that no clip planned. Returns what balance asks of the centre of mass.
    pub fn lead(
        &mut self,
        terms: &Terms,
        support: &Support,
        gravity: f64,
        dt: f64,
        tasks: &mut TaskTargets<'_>,
    ) -> Option<Balance> {
        self.wait.lean(tasks.com, self.capture.omega(), dt);
        if self.is_live() {
            // Balance is kept where the motion goes, not where it still is: limbs take time to get there, and what that
            // looks off by is none to be driven out over the foot that has just landed.
            let rest = self.anchor.rest();
            tasks.com.now += rest;
            tasks.com.next += rest;
        }
        self.capture
            .update(terms, tasks.com, support.polygon(), gravity, dt);
        // Only a step in a hurry counts it.
        let spin = self.arrival.map(|_| tasks.spin);
        self.capture.feel(terms, spin, self.walks());
        self.above = Above {
            height: terms.com.z - tasks.com.now.z,
            speed: terms.com_velocity.z - tasks.com.now_velocity.z,
            gravity,
        };
        let (now, home) = (self.places(terms), self.meant(tasks.feet));
        self.untidy = (0..2).any(|k| is_untidy(now[k], home[k]));
        if tasks.unplanned && self.walks() {
            self.fall_alone(terms, support, &now, dt);
        }
        if self.walks() {
            self.quicken(terms, support);
            for side in 0..2 {
                self.lead_planned(terms, side, dt, &mut tasks.feet[side]);
            }
            if self.flies() {
                follow_mass(terms, dt, tasks);
            }
        } else {
            self.quick = None;
            if tasks.unplanned {
                let home = self.wait.standing(home, self.leg);
                self.catch(terms, support, dt, (&now, &home), tasks);
                self.stand_by((terms, support), &now, dt, tasks.feet);
            }
        }
        self.keep_headings(terms, tasks.feet);
        if let Some(step) = self.step.filter(|s| s.purpose != Purpose::Tidy) {
            // The centre of mass goes where the pendulum over the stance foot falls slowest.
            return Some(Balance {
                acceleration: self
                    .capture
                    .slowest(terms, stance_points(support, step.side)),
            });
        }
        if let Some(acceleration) = self.hurries(terms, support) {
            return Some(Balance { acceleration });
        }
        let wanted = com_law(tasks.com, terms.com, terms.com_velocity, dt);
        let acceleration =
            self.capture
                .feasible(terms, (wanted, tasks.moment), support.polygon(), gravity)?;
        Some(Balance { acceleration })
    }

    /// True if feet come down where a plan has had them all along: that of a stream is made while it is followed, and a
    /// step that nobody planned has none.
    pub fn lands_as_planned(&self) -> bool {
        self.step.is_none() && self.plan.as_ref().is_some_and(|p| !p.is_live())
    }

    /// True while it follows a stream.
    fn is_live(&self) -> bool {
        self.plan.as_ref().is_some_and(StepPlan::is_live)
    }

    /// A direction of the motion as its origin is turned to where the feet are.
    pub fn turned(&self, v: Vec3) -> Vec3 {
        Quat::exp(Vec3::Z * self.anchor.yaw()).rotate(v)
    }

    fn planned(&self, side: usize) -> Option<Footfall> {
        self.plan.as_ref()?.current(side, self.phase)
    }

    fn next(&self, side: usize) -> Option<Footfall> {
        self.plan.as_ref()?.next(side, self.phase)
    }

    fn last_off(&self, side: usize) -> f64 {
        self.plan
            .as_ref()
            .map_or(0.0, |p| p.last_off(side, self.phase))
    }
}
