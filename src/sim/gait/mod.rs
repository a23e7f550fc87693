//! Steps: a played clip becomes a plan of footholds that follows what the feet really do (WALKING §2–4).
//!
//! The motion layer decides *when* (contact by events, not by the clock) and *where* (re-anchoring, step adaptation); the controller only
//! sees targets and which feet are planted. A clip whose feet never leave the floor passes through unchanged, bit for bit.

pub mod anchor;
pub mod balance;
pub mod plan;

pub use balance::Capture;
pub use plan::{Footfall, StepPlan};

use crate::sim::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::sim::body::{Body, SegmentId};
use crate::sim::control::{PointTarget, RotationTarget};
use crate::sim::dynamics::Terms;
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::foot_lock::Sole;
use crate::sim::motion::{PlanarTransform, Target, TargetPair};
use anchor::Anchor;

const FOOT: [SegmentId; 2] = [L_FOOT, R_FOOT];
const TOES: [SegmentId; 2] = [L_TOES, R_TOES];
/// A sole lower than this touches, m.
const TOUCH: f64 = 0.004;
/// A foot may land this long before its time, s; earlier touches are scuffs.
const EARLY: f64 = 0.06;
/// A foot that finds no floor counts as planted after this time, s; until then it goes down at this speed, m/s.
const LATE: f64 = 0.15;
const LOWERING: f64 = 0.5;
/// Time over which a lifting foot gives up its offset from the plan, s.
const RELEASE: f64 = 0.25;
/// Part of a swing in which the foot is led to its displaced foothold.
const SWING_SHARE: f64 = 0.9;
/// Least height of a swinging sole, m, and how fast it must come up and may come down, m/s.
const CLEARANCE: f64 = 0.03;
const CLEARANCE_RATE: f64 = 0.35;
/// Share of its distance from home by which a foothold is pulled there, and the most, m.
const HOME: (f64, f64) = (0.3, 0.04);
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

/// The steps of one figure. Remembers phase and footholds; nothing allocates in a tick.
#[derive(Clone, Debug)]
pub struct Gait {
    plan: StepPlan,
    soles: [Sole; 2],
    anchor: Anchor,
    feet: [Foot; 2],
    started: bool,
    /// World time that the clip is behind its schedule, s.
    lag: f64,
    /// Clip time now, s.
    phase: f64,
    speed: f64,
    origin: PlanarTransform,
    capture: Capture,
    landing: Option<Landing>,
}

impl Gait {
    /// Steps of a clip with `plan`, played at `speed` clip seconds per second from `origin`.
    pub fn new(body: &Body, plan: StepPlan, speed: f64, origin: PlanarTransform) -> Self {
        Self {
            plan,
            soles: [Sole::new(body, 0), Sole::new(body, 1)],
            anchor: Anchor::default(),
            feet: [Foot::default(); 2],
            started: false,
            lag: 0.0,
            phase: 0.0,
            speed: speed.max(STILL),
            origin,
            capture: Capture::new(body),
            landing: None,
        }
    }

    /// Forgets the past: the motion lies where it was planned.
    pub fn reset(&mut self) {
        self.anchor = Anchor::default();
        self.feet = [Foot::default(); 2];
        self.started = false;
        self.lag = 0.0;
    }

    /// World time by which the clip is behind its schedule, s.
    pub fn lag(&self) -> f64 {
        self.lag
    }

    /// Error of the capture point, m.
    pub fn capture(&self) -> &Capture {
        &self.capture
    }

    /// The foot that came down in this tick.
    pub fn landing(&self) -> Option<&Landing> {
        self.landing.as_ref()
    }

    fn placed(&self, f: &Footfall) -> Footfall {
        Footfall {
            place: self.origin.point(f.place),
            yaw: f.yaw + self.origin.yaw,
            ..*f
        }
    }

    /// Desired motion of the tick that starts at world time `time`. `sample(t)` is the clip placed at its origin, at world time t, and
    /// `clip_time(t)` the clip time then; `terms` are those of the present state.
    pub fn targets(
        &mut self,
        time: f64,
        dt: f64,
        terms: &Terms,
        clip_time: impl Fn(f64) -> f64,
        sample: impl Fn(f64) -> Target,
    ) -> TargetPair {
        self.landing = None;
        self.phase = clip_time(time - self.lag);
        if !self.started {
            self.started = true;
            for side in 0..2 {
                self.feet[side].down = self.plan.current(side, self.phase).is_some();
                self.feet[side].lifted = self.plan.last_off(side, self.phase);
            }
        }
        self.anchor.settle(dt);
        let now_time = time - self.lag;
        let rate = self.schedule(terms, dt, &sample, now_time);
        self.lag += (1.0 - rate) * dt;
        let place = self.anchor.transform();
        let mut pair = TargetPair {
            now: sample(now_time),
            next: sample(time + dt - self.lag),
        };
        if self.anchor != Anchor::default() {
            place.apply_to(&mut pair.now);
            place.apply_to(&mut pair.next);
        }
        let planted = [self.feet[0].down, self.feet[1].down];
        pair.now.planted = planted;
        pair.next.planted = planted;
        pair
    }

    /// Contact by events: lifts feet when planned, plants them when they touch. Returns the rate at which the plan goes on.
    fn schedule(
        &mut self,
        terms: &Terms,
        dt: f64,
        sample: &impl Fn(f64) -> Target,
        now_time: f64,
    ) -> f64 {
        let mut rate = 1.0;
        let mut lifted = [false; 2];
        for side in 0..2 {
            let planned = self.plan.current(side, self.phase);
            let touches = self.lowest(terms, side) < TOUCH;
            let mut foot = self.feet[side];
            if foot.down {
                if planned.is_some() {
                    foot.early = false;
                } else if foot.early {
                    rate = 2.0;
                } else {
                    let other = 1 - side;
                    let waits =
                        !self.feet[other].down && self.plan.current(other, self.phase).is_some();
                    if !waits {
                        foot.down = false;
                        foot.lifted = self.phase;
                        foot.shift = [0.0; 2];
                        foot.late = 0.0;
                        lifted[side] = true;
                    }
                }
                self.feet[side] = foot;
                continue;
            }
            if let Some(f) = planned {
                if touches || foot.late > LATE {
                    self.land(terms, side, &f, foot.late);
                } else {
                    rate = 0.0;
                    self.feet[side].late += dt;
                }
            } else if touches
                && let Some(f) = self.plan.next(side, self.phase)
                && (f.on - self.phase) / self.speed < EARLY
            {
                self.land(terms, side, &f, (self.phase - f.on) / self.speed);
                self.feet[side].early = true;
            }
        }
        if lifted != [false; 2] {
            let mut target = sample(now_time);
            self.anchor.transform().apply_to(&mut target);
            let poses = self.capture.feet(&target);
            for side in 0..2 {
                if lifted[side] {
                    self.feet[side].release =
                        terms.segment_position(FOOT[side].index()) - poses[side].0;
                }
            }
        }
        rate
    }

    fn land(&mut self, terms: &Terms, side: usize, planned: &Footfall, late: f64) {
        let planned = self.placed(planned);
        let s = FOOT[side].index();
        let (actual, yaw) = plan::place(
            &self.soles[side],
            terms.segment_position(s),
            Quat::from_mat3(&terms.kin.rotation[s]),
        );
        self.landing = Some(Landing {
            side,
            late,
            off: actual - self.anchor.point(planned.place),
        });
        self.anchor.land(planned.place, planned.yaw, actual, yaw);
        let foot = &mut self.feet[side];
        foot.down = true;
        foot.early = false;
        foot.late = 0.0;
        foot.shift = [0.0; 2];
    }

    /// Height of the lowest point of a sole, m.
    fn lowest(&self, terms: &Terms, side: usize) -> f64 {
        let mut low = f64::INFINITY;
        for (s, points) in [
            (FOOT[side].index(), self.soles[side].foot_points()),
            (TOES[side].index(), self.soles[side].toe_points()),
        ] {
            for p in points {
                low = low.min(terms.point_world(s, *p).z);
            }
        }
        low
    }

    /// Leads the swinging feet to footholds that catch the body (step adaptation, WALKING §4), clear of the floor.
    pub fn lead_feet(
        &mut self,
        terms: &Terms,
        com: &PointTarget,
        polygon: &crate::sim::support::Polygon,
        gravity: f64,
        dt: f64,
        feet: &mut [(PointTarget, RotationTarget); 2],
    ) {
        self.capture.update(terms, com, polygon, gravity, dt);
        for side in 0..2 {
            if self.feet[side].down {
                if self.feet[side].early {
                    self.lower_early(side, &mut feet[side]);
                }
                continue;
            }
            let next = self.plan.next(side, self.phase);
            let current = self.plan.current(side, self.phase);
            if let Some(f) = current.or(next) {
                self.adapt(terms, side, &f, dt);
            }
            let foot = self.feet[side];
            let since = (self.phase - foot.lifted).max(0.0) / self.speed;
            let on = current.map_or_else(
                || next.map_or(self.phase + self.speed, |f| f.on),
                |_| self.phase,
            );
            let remaining = (on - self.phase).max(0.0) / self.speed;
            let u = (since / (since + remaining).max(0.1) / SWING_SHARE).clamp(0.0, 1.0);
            let s = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
            let kept = (1.0 - since / RELEASE).max(0.0);
            let mut offset = foot.release * (kept * kept);
            offset.x += s * foot.shift[0];
            offset.y += s * foot.shift[1];
            let wanted = CLEARANCE
                .min(CLEARANCE_RATE * since)
                .min(CLEARANCE_RATE * remaining);
            offset.z += (wanted - self.lowest(terms, side)).clamp(0.0, CLEARANCE);
            let target = &mut feet[side].0;
            if foot.late > 0.0 {
                offset.z -= LOWERING * foot.late;
                target.now_velocity = Vec3::Z * -LOWERING;
                target.next_velocity = Vec3::Z * -LOWERING;
            }
            target.now += offset;
            target.next += offset;
        }
    }

    /// A foot that landed before its time stands where the plan still has it in the air.
    fn lower_early(&self, side: usize, target: &mut (PointTarget, RotationTarget)) {
        let low = target.0.next.z + self.soles[side].lowest(target.1.next, 0.0);
        target.0.now.z -= low.max(0.0);
        target.0.next.z -= low.max(0.0);
    }

    /// Displacement of the foothold `f` of a swinging foot.
    fn adapt(&mut self, terms: &Terms, side: usize, f: &Footfall, dt: f64) {
        let f = self.placed(f);
        let foot = &self.feet[side];
        let remaining = (f.on - self.phase).max(0.0) / self.speed;
        let home = self.anchor.point(f.place);
        let pull = |d: f64| (HOME.0 * d).clamp(-HOME.1, HOME.1);
        let mut d = self.capture.left_over(remaining);
        d[0] -= pull(home.x - f.place.x);
        d[1] -= pull(home.y - f.place.y);
        let stance = terms.segment_position(FOOT[1 - side].index());
        let heading = self.anchor.yaw() + f.yaw;
        let d = balance::within_reach(d, home, stance, heading, side);
        if remaining > balance::FREEZE || foot.shift == [0.0; 2] {
            let a = balance::smoothing(dt);
            let foot = &mut self.feet[side];
            for (x, y) in foot.shift.iter_mut().zip(d) {
                *x += a * (y - *x);
            }
        }
    }
}
