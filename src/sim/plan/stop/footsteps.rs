//! The steps that bring a body to a stand, on a linear inverted pendulum.
//!
//! The capture point ξ = c + ċ/ω tells where the next foot has to land (Pratt et al. 2006). Once it lies between the
//! feet, they are brought side by side. Several sequences of steps are tried, and the one that asks least of a body is
//! taken.

use super::initial_state::InitialState;
use super::turned;
use crate::body::topology::{FEET, outward};
use crate::body::{Body, Posture};
use crate::math::curve::rise;
use crate::math::exp::exp;
use crate::math::polygon::{Region, hull, margin};
use crate::math::{Vec3, trig};
use crate::motion::GRAVITY;
use crate::motion::leg_ik::{center_of_mass, forward};
use crate::plan::foot_lock::{FootPlacement, Sole, turn, yaw_pitch};
use crate::plan::params::{common, stop};

/// One step of the stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlannedStep {
    pub(super) side: usize,
    pub(super) off: f64,
    pub(super) on: f64,
    /// Point of the floor under the flat ankle.
    pub(super) place: Vec3,
}

/// A step that catches the body.
#[derive(Clone, Copy)]
struct CaptureStep {
    /// Duration of the step, s.
    time: f64,
    place: Vec3,
    /// How far inside the support of the feet the capture point is when the foot lands, m.
    inside: f64,
}

/// Places and headings of the feet in the plan.
#[derive(Clone, Copy)]
pub(super) struct StepFeet<'a> {
    place: [Vec3; 2],
    yaw: [f64; 2],
    soles: &'a [Sole; 2],
}

/// The feet that are down while foot `side` swings.
fn all_but(side: usize) -> [bool; 2] {
    [side == 1, side == 0]
}

impl<'a> StepFeet<'a> {
    /// The feet as they are where a motion ends.
    pub(super) fn of(from: &InitialState, soles: &'a [Sole; 2]) -> Self {
        Self {
            place: from.feet.map(|f| f.place),
            yaw: from.feet.map(|f| f.yaw),
            soles,
        }
    }

    /// Whether a body in the state `from` could stop without a step. `omega`: rate of its inverted pendulum, 1/s.
    pub(super) fn stop_here(&self, from: &InitialState, omega: f64) -> bool {
        let capture = from.com + from.velocity * (1.0 / omega);
        from.velocity.level() < stop::STANDING_SPEED
            && from.down() == [true; 2]
            && margin(&self.support(from.down()), capture.xy()) > stop::STANDING_MARGIN
    }

    /// Hull of the soles that are down.
    pub(super) fn support(&self, down: [bool; 2]) -> Vec<[f64; 2]> {
        let mut corners = Vec::new();
        for s in (0..2).filter(|s| down[*s]) {
            let at = FootPlacement {
                tip: 0.0,
                place: self.place[s],
                yaw: self.yaw[s],
                pitch: 0.0,
            };
            self.soles[s].footprint(&at, &mut corners);
        }
        hull(&corners)
    }

    fn middle(&self, side: usize) -> Vec3 {
        self.place[side] + turned(self.yaw[side], Vec3::X * common::SOLE_MIDDLE)
    }
}

/// The final stand. Places are relative to the middle between the ankles, headings relative to that of the whole body.
pub(super) struct StandingPose {
    pub(super) posture: Posture,
    pub(super) home: [Vec3; 2],
    pub(super) yaw: [f64; 2],
    pub(super) mass: Vec3,
    pub(super) pelvis: Vec3,
    pub(super) heading: f64,
}

impl StandingPose {
    pub(super) fn of(body: &Body, posture: &Posture) -> Self {
        let poses = forward(body, posture);
        let feet = FEET.map(|s| poses[s.index()]);
        let yaws = feet.map(|f| yaw_pitch(f.1).0);
        let pelvis = yaw_pitch(posture.root_rotation).0;
        let heading = pelvis + 0.25 * (turn(pelvis, yaws[0]) + turn(pelvis, yaws[1]));
        let middle = (feet[0].0 + feet[1].0) * 0.5;
        let local = |p: Vec3| {
            let d = turned(-heading, p - middle);
            Vec3 { z: p.z, ..d }
        };
        Self {
            posture: *posture,
            home: feet.map(|f| local(f.0).horizontal()),
            yaw: yaws.map(|y| turn(heading, y)),
            mass: local(center_of_mass(body, &poses)),
            pelvis: local(posture.root_position),
            heading,
        }
    }
}

/// The choices in planning a stop.
#[derive(Clone, Copy, Debug)]
struct StepOptions {
    /// Margin to have in hand beyond [`stop::CAUGHT_INSET`], s.
    spare: f64,
    /// See [`stop::BEYOND_CAPTURE`], m.
    beyond: f64,
    /// Foot that steps first where both are down; if absent, the one that catches best.
    first: Option<usize>,
    /// Least duration of a swing that is under way already, s.
    rest: f64,
    /// Highest average speed of a swinging foot, m/s.
    speed: f64,
    /// Turn of the whole body, rad.
    turn: f64,
}

impl StepOptions {
    /// All options that are tried with the same `turn`.
    ///
    /// * `spare`: the largest margin to have in hand beyond [`stop::CAUGHT_INSET`], s; `in_air`: a foot is in the air.
    fn all(spare: f64, in_air: bool, turn: f64) -> impl Iterator<Item = Self> {
        let swings = [
            (stop::SWING_REST, stop::FOOT_SPEED),
            (stop::SWING_REST, stop::FAST_FOOT_SPEED),
            (stop::LONG_SWING_REST, stop::FOOT_SPEED),
            (stop::LONGEST_SWING_REST, stop::FOOT_SPEED),
        ];
        let tried = if in_air { swings.len() } else { 1 };
        let hands: &[f64] = if spare > 0.0 {
            &[1.0, 0.5, 0.0]
        } else {
            &[1.0]
        };
        let ways =
            { hands.iter() }.flat_map(move |h| [0.0, stop::BEYOND_CAPTURE].map(|b| (h * spare, b)));
        let ways = ways.flat_map(|way| [None, Some(0), Some(1)].map(|first| (way, first)));
        ways.flat_map(move |((spare, beyond), first)| {
            let swings = swings.into_iter().take(tried);
            swings.map(move |(rest, speed)| Self {
                spare,
                beyond,
                first,
                rest,
                speed,
                turn,
            })
        })
    }
}

/// The pendulum on its way to a stand: footsteps, and the path of its mass.
struct PendulumPlan<'a> {
    from: &'a InitialState,
    feet: StepFeet<'a>,
    stand: &'a StandingPose,
    leg: f64,
    omega: f64,
    dt: f64,
    capture: Vec3,
    way: StepOptions,
    steps: Vec<PlannedStep>,
    path: Vec<Vec3>,
}

/// The steps of a stop and the path of its mass over the floor; the first sample is where the motion ends.
pub(super) struct Footsteps {
    pub(super) steps: Vec<PlannedStep>,
    pub(super) path: Vec<Vec3>,
    /// Final heading, rad.
    pub(super) heading: f64,
}

/// Frequency of the pendulum between a start and a stand, rad/s.
pub(super) fn frequency(from: &InitialState, stand: &StandingPose) -> f64 {
    (GRAVITY / (0.5 * (from.com.z + stand.mass.z)).max(stop::LEAST_HEIGHT)).sqrt()
}

/// Inputs of the search for steps besides the body's state.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepSearch {
    /// Distance from hip to ankle, m.
    pub(super) leg: f64,
    /// Samples per second of the path.
    pub(super) rate_hz: f64,
    /// The largest margin to have in hand beyond [`stop::CAUGHT_INSET`], s.
    pub(super) spare: f64,
}

/// The steps that ask least of a body. `None` if no steps are found that stop it.
pub(super) fn footsteps(
    from: &InitialState,
    stand: &StandingPose,
    soles: &[Sole; 2],
    search: StepSearch,
) -> Option<Footsteps> {
    let StepSearch {
        leg,
        rate_hz,
        spare,
    } = search;
    let omega = frequency(from, stand);
    let tried = |way: StepOptions| {
        let mut stop = PendulumPlan {
            from,
            feet: StepFeet::of(from, soles),
            stand,
            leg,
            omega,
            dt: 1.0 / rate_hz,
            capture: (from.com + from.velocity * (1.0 / omega)).horizontal(),
            way,
            steps: Vec::new(),
            path: vec![from.com.horizontal()],
        };
        stop.run().then_some(stop)
    };
    let in_air = from.down() != [true; 2];
    let best = |turn: f64| {
        let found = StepOptions::all(spare, in_air, turn).filter_map(tried);
        found.min_by(|a, b| a.price().total_cmp(&b.price()))
    };
    // A body that falls towards a side which its feet cannot reach turns to that side.
    let aside = turn(from.heading, trig::atan2(from.velocity.y, from.velocity.x));
    let turns = if aside.abs() < stop::MOST_ASIDE {
        stop::TURNS
    } else {
        1
    };
    let best = (0..turns).find_map(|k| best(stop::TURN_STEP * k as f64 * aside))?;
    Some(Footsteps {
        heading: best.heading(),
        steps: best.steps,
        path: best.path,
    })
}

/// The regions in which the feet that are down carry the body.
struct StepSupport {
    /// Region in which the capture point should stay.
    capture: Region,
    /// Region in which the zero-moment point may be.
    pressure: Region,
}

impl StepSupport {
    fn of(feet: &StepFeet<'_>, down: [bool; 2]) -> Self {
        let hull = feet.support(down);
        Self {
            capture: Region::inside(&hull, stop::CAPTURE_INSET),
            pressure: Region::inside(&hull, common::ZMP_INSET),
        }
    }
}

impl PendulumPlan<'_> {
    fn now(&self) -> f64 {
        (self.path.len() - 1) as f64 * self.dt
    }

    /// Heading of the whole body.
    fn heading(&self) -> f64 {
        self.from.heading + self.way.turn
    }

    /// Final heading of a foot.
    fn yaw(&self, side: usize) -> f64 {
        self.heading() + self.stand.yaw[side]
    }

    fn mass(&self) -> Vec3 {
        self.path.last().copied().unwrap_or_default()
    }

    /// Advances by one sample with the zero-moment point at `p`: ξ̇ = ω (ξ − p), ċ = ω (ξ − c).
    fn advance(&mut self, p: [f64; 2]) {
        let grows = exp(self.omega * self.dt);
        let p = Vec3::on_floor(p);
        self.capture = p + (self.capture - p) * grows;
        let c = self.mass();
        self.path.push(c + (self.capture - c) * (1.0 - 1.0 / grows));
    }

    /// The zero-moment point within `support` that drives the capture point to `goal`.
    fn drive(&self, support: &StepSupport, goal: Vec3) -> [f64; 2] {
        let off = self.capture - goal;
        let wanted = self.capture + off * stop::LEAN_GAIN;
        support.pressure.nearest(wanted.xy())
    }

    /// The zero-moment point within `support` that keeps the capture point in place, or slows it down most.
    fn hold(&self, support: &StepSupport) -> [f64; 2] {
        let inside = support.capture.nearest(self.capture.xy());
        self.drive(support, Vec3::on_floor(inside))
    }

    /// Stands on both feet for a while.
    fn both(&mut self, time: f64) {
        let support = StepSupport::of(&self.feet, [true; 2]);
        for _ in 0..(time / self.dt).round() as usize {
            self.advance(self.hold(&support));
        }
    }

    /// Brings the capture point to `goal` with both feet on the floor. Foot `next`, if any, steps after that. It steps
    /// sooner if the leg reaches no further and the other foot has the capture point.
    fn lean(&mut self, goal: Vec3, next: Option<usize>) {
        let support = StepSupport::of(&self.feet, [true; 2]);
        let other = next.map(|side| (self.feet.support(all_but(side)), self.feet.place[side]));
        for _ in 0..(stop::LEAN_TIME / self.dt) as usize {
            if (self.capture - goal).norm() < stop::LEAN_SETTLED {
                break;
            }
            let leaves = other.as_ref().is_some_and(|(sole, foot)| {
                (*foot - self.mass()).norm() > stop::STRETCHED * self.leg
                    && margin(sole, self.capture.xy()) > stop::CAPTURE_INSET
            });
            if leaves {
                break;
            }
            self.advance(self.drive(&support, goal));
        }
    }

    /// Lands foot `side`, which left the floor at time `off` (s), at `place`.
    fn put(&mut self, side: usize, off: f64, place: Vec3) {
        self.steps.push(PlannedStep {
            side,
            off,
            on: self.now(),
            place,
        });
        self.feet.place[side] = place;
        self.feet.yaw[side] = self.yaw(side);
    }

    /// Swings foot `side` for `time` s while the other one carries the body. With a `goal`, the capture point is there
    /// when the foot lands.
    fn swing(&mut self, side: usize, time: f64, place: Vec3, goal: Option<Vec3>) {
        let off = self.now();
        let support = StepSupport::of(&self.feet, all_but(side));
        let count = ((time / self.dt).round() as usize).max(1);
        for left in (1..=count).rev() {
            let p = match goal {
                Some(goal) => {
                    // ξ(t) = p + (ξ − p) e^{ωt}, solved for p.
                    let grows = exp(self.omega * self.dt * left as f64);
                    let p = (self.capture * grows - goal) * (1.0 / (grows - 1.0));
                    support.pressure.nearest(p.xy())
                }
                None => self.hold(&support),
            };
            self.advance(p);
        }
        self.put(side, off, place);
    }

    /// When and where foot `side` should land to catch the body: as soon as it can get there without hurry.
    ///
    /// * `ankle`: its present place; `least`: shortest time.
    fn capture_step(&self, side: usize, ankle: Vec3, least: f64) -> CaptureStep {
        let p = Vec3::on_floor(self.hold(&StepSupport::of(&self.feet, all_but(side))));
        let away = self.capture - p;
        let landing = |time: f64| p + away * exp(self.omega * time);
        // Aim beyond the capture point, in the direction of its motion: a body stops less well than a pendulum.
        let moves = (self.capture - self.mass()) * self.omega;
        let beyond = moves * (self.way.beyond / moves.norm().max(1.0));
        let mut best = (f64::INFINITY, least, Vec3::zero());
        let mut time = least;
        while time <= stop::LONGEST_SWING.max(least) {
            let place = self.reachable(side, landing(time) + beyond);
            let far = place - ankle;
            let speed = far.level() / time;
            if speed < best.0 {
                best = (speed, time, place);
            }
            if speed < self.way.speed {
                break;
            }
            time += stop::SWING_STEP;
        }
        let (_, time, place) = best;
        let mut feet = self.feet;
        feet.place[side] = place;
        feet.yaw[side] = self.yaw(side);
        let inside = margin(&feet.support([true; 2]), landing(time).xy());
        CaptureStep {
            time,
            place,
            inside,
        }
    }

    /// Place of foot `side` that puts the middle of its sole at `wanted`, or as near as the leg allows beside the other
    /// foot.
    fn reachable(&self, side: usize, wanted: Vec3) -> Vec3 {
        let heading = self.heading();
        let stance = self.feet.place[1 - side];
        let local = turned(-heading, wanted - stance);
        let outward = outward(side);
        let apart = (self.stand.home[0].y - self.stand.home[1].y).abs();
        let (far, wide) = (stop::STEP_LENGTH * self.leg, stop::STEP_WIDTH * self.leg);
        let x = (local.x - common::SOLE_MIDDLE).clamp(-far, far);
        // Far in front of or behind the other foot there is room to cross.
        let room = ((x.abs() - stop::CROSS_BEGINS) / (stop::CROSS_ENDS - stop::CROSS_BEGINS))
            .clamp(0.0, 1.0);
        let closest = stop::LEAST_WIDTH * apart * (1.0 - room) - stop::MOST_CROSS * room;
        let y = (local.y * outward).clamp(closest, wide.max(apart)) * outward;
        let x = if x.abs() < stop::STEP_LEVEL { 0.0 } else { x };
        (stance + turned(heading, Vec3::on_floor([x, y]))).horizontal()
    }

    /// The normal place of foot `side` beside the other one.
    fn beside(&self, side: usize) -> Vec3 {
        let way = self.stand.home[side] - self.stand.home[1 - side];
        (self.feet.place[1 - side] + turned(self.heading(), way)).horizontal()
    }

    fn is_home(&self, side: usize) -> bool {
        (self.feet.place[side] - self.beside(side)).norm() < common::MISPLACED_BY
            && turn(self.feet.yaw[side], self.yaw(side)).abs() < stop::HOME_ANGLE
    }

    /// Cost of the steps for a body, less a bonus for the margin they leave.
    fn price(&self) -> f64 {
        let fall = |p: &[Vec3]| {
            // Distance of the mass from its zero-moment point, c − p = c̈/ω².
            let off = (p[0] - p[1] * 2.0 + p[2]) * (1.0 / (self.dt * self.omega)).powi(2);
            let square = off.x * off.x + off.y * off.y;
            square * square * self.dt
        };
        let falls: f64 = self.path.windows(3).map(fall).sum();
        let hops =
            |w: &&[PlannedStep]| w[0].side == w[1].side && w[1].on - w[1].off < stop::CLOSING_TIME;
        let hops = self.steps.windows(2).filter(hops).count() as f64;
        let mut at = [0, 1].map(|s| (self.from.feet[s].ankle.horizontal(), self.from.feet[s].yaw));
        let mut hurry = 0.0;
        for s in &self.steps {
            let (place, yaw) = at[s.side];
            let way = (s.place - place).norm() + stop::TURN_ARM * turn(yaw, self.yaw(s.side)).abs();
            hurry += (way / (s.on - s.off) - stop::UNHURRIED_SPEED)
                .max(0.0)
                .powi(2);
            at[s.side] = (s.place, self.yaw(s.side));
        }
        falls + stop::HURRY_PRICE * hurry + stop::HOP_PRICE * hops
            - stop::SPARE_WORTH * self.way.spare
    }

    fn is_caught(&self) -> bool {
        let away = self.capture - self.mass();
        let speed = self.omega * away.level();
        margin(&self.feet.support([true; 2]), self.capture.xy())
            > stop::CAUGHT_INSET + self.way.spare * speed
    }

    /// Brings a body in the air down on its lower foot, as far ahead as the leg reaches. Returns that foot.
    fn land_from_flight(&mut self) -> usize {
        let from = self.from;
        let fall = from.velocity.z;
        let drop = (from.com.z - (self.stand.mass.z - stop::LANDING_DROP)).max(0.0);
        let time = ((fall + (fall * fall + 2.0 * GRAVITY * drop).sqrt()) / GRAVITY)
            .clamp(2.0 * self.dt, stop::LONGEST_FLIGHT);
        let velocity = from.velocity.horizontal();
        for _ in 0..(time / self.dt).round() as usize {
            let c = self.mass() + velocity * self.dt;
            self.path.push(c);
            self.capture = c + velocity * (1.0 / self.omega);
        }
        let side = usize::from(from.feet[1].ankle.z < from.feet[0].ankle.z);
        let c = self.mass();
        let reach = (self.capture - c)
            .norm()
            .min(0.5 * stop::STEP_LENGTH * self.leg);
        let ahead = (self.capture - c).normalized_or(Vec3::X) * reach;
        let place = c + ahead + turned(self.heading(), Vec3::Y * self.stand.home[side].y);
        self.put(side, 0.0, place);
        side
    }

    /// Lands the foot that is in the air already where it catches the body.
    fn land(&mut self, side: usize) {
        let since = self.from.feet[side].since + self.now();
        let least = (stop::SHORTEST_SWING - since).max(self.way.rest);
        let step = self.capture_step(side, self.from.feet[side].ankle, least);
        let in_flight = self.path.len() > 1;
        self.swing(side, step.time, step.place, None);
        if let Some(step) = self.steps.last_mut().filter(|_| in_flight) {
            step.off = 0.0;
        }
        self.both(stop::DOUBLE_SUPPORT);
    }

    /// Steps until the capture point is between the feet, or for as long as there is hope. With both feet down, the one
    /// that catches better steps first.
    fn capture(&mut self) {
        let mut ankle = self.from.feet.map(|f| f.ankle);
        let mut first = self.way.first;
        for _ in 0..stop::MOST_STEPS {
            for s in &self.steps {
                ankle[s.side] = s.place;
            }
            if self.is_caught() {
                return;
            }
            let [left, right] =
                [0, 1].map(|s: usize| self.capture_step(s, ankle[s], stop::SHORTEST_SWING));
            let side = first
                .take()
                .unwrap_or(usize::from(right.inside > left.inside));
            let step = [left, right][side];
            self.swing(side, step.time, step.place, None);
            self.both(stop::DOUBLE_SUPPORT);
        }
    }

    /// Brings the feet side by side, starting with the one that carries less, and the mass over them.
    fn close_feet(&mut self) {
        for _ in 0..2 {
            let far = |s: usize| (self.feet.middle(s) - self.capture).norm();
            let side = usize::from(far(1) > far(0));
            let heads_home =
                turn(self.feet.yaw[1 - side], self.yaw(1 - side)).abs() < stop::HOME_ANGLE;
            if self.is_home(side) && heads_home {
                break;
            }
            let side = if self.is_home(side) { 1 - side } else { side };
            let over = self.feet.middle(1 - side);
            self.lean(over, Some(side));
            let place = self.beside(side);
            let way = place - self.feet.place[1 - side];
            let strides = 0.5 * rise(way.norm(), (stop::STRIDE_BEGINS, stop::STRIDE_ENDS));
            let goal = (strides > 0.0).then(|| over + way * strides);
            self.swing(side, stop::CLOSING_TIME, place, goal);
            self.both(stop::DOUBLE_SUPPORT);
        }
        let middle = (self.feet.place[0] + self.feet.place[1]) * 0.5;
        let stands = middle + turned(self.heading(), self.stand.mass);
        self.lean(stands.horizontal(), None);
        self.both(stop::REST_TIME);
    }

    /// Plans the whole stop; false if the body runs away.
    fn run(&mut self) -> bool {
        let mut down = self.from.down();
        if down == [false; 2] {
            down[self.land_from_flight()] = true;
        }
        if let Some(side) = (0..2).find(|s| !down[*s]) {
            self.land(side);
        }
        self.capture();
        if !self.is_caught() {
            return false;
        }
        self.close_feet();
        self.is_caught()
    }
}
