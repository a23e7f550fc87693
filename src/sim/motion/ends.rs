//! From standing into a motion and out of it again: what comes before the first and after the last recorded sample.
//!
//! A recording that ends in full stride has no last posture that a body could hold. Here it gets the steps that bring it to a stand. They
//! are planned on a linear inverted pendulum that starts where the recording stops: its capture point ξ = c + ċ/ω says where the next
//! foot has to land (Pratt et al. 2006), and once ξ lies between the feet they are brought side by side. Trunk and arms come to ease
//! meanwhile. The beginning is the same thing backwards. What comes out is a draft like any other; [`super::prepare`] locks its
//! feet and makes the whole body keep its balance.

use super::balance::{clip_inside, hull, margin};
use super::builtin::at_ease;
use super::contacts::runs;
use super::filter::low_pass_points;
use super::foot_lock::{Anchor, Sole, turn, yaw_pitch};
use super::leg_ik::{center_of_mass, forward, knee_axis};
use super::prepare::Draft;
use crate::sim::body::topology::{L_FOOT, NV, R_FOOT};
use crate::sim::body::{Body, Posture};
use crate::sim::math::{Quat, Vec3};

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.81;
/// Slower than this, m/s, and with the capture point this far inside the soles, m, it stands.
const STANDS: (f64, f64) = (0.35, 0.02);
/// A pelvis below this share of its standing height is not one that walks.
const UPRIGHT: f64 = 0.75;
/// Time over which the velocity at the end is measured, s.
const MEASURED: f64 = 0.08;
/// Shortest and longest swing of a step that catches the body, length of one that only closes the feet, s.
const SWING: (f64, f64) = (0.26, 0.46);
const CLOSING: f64 = 0.5;
/// A swing that is under way already lasts at least this long, s.
const LEAST_REST_OF_SWING: f64 = 0.12;
/// A swinging foot gets no faster than this on the average, m/s.
const SWING_SPEED: f64 = 2.2;
/// Double support after a step and before the first one, s.
const BOTH: f64 = 0.1;
/// Longest step, forward and to the side, leg lengths; least distance of the feet to the side, share of that at ease.
const LONGEST: (f64, f64) = (0.8, 0.65);
const CLOSEST: f64 = 0.8;
/// Between these distances before or behind the other foot, m, a step may come to cross its line by up to this, m.
const CROSS_FROM: (f64, f64) = (0.2, 0.35);
const CROSS: f64 = 0.12;
/// The zero-moment point stays this far inside the soles, m; it keeps the capture point this far inside where it can.
const INSET: f64 = 0.01;
const INNER: f64 = 0.035;
/// The capture point counts as caught this far inside the soles, m.
const CAUGHT: f64 = 0.015;
/// And so much more per m/s, s, where the moment is given and not chosen: a body stops less well than a pendulum.
const SPARE: f64 = 0.03;
/// A foot that catches a body of 1 m/s lands this far beyond the capture point, m, so that it comes to rest between the feet.
const BEYOND: f64 = 0.1;
/// Gain of the zero-moment point on the way to a place, how close counts as there, m, and when patience ends, s.
const LEAN: (f64, f64, f64) = (2.0, 0.015, 0.9);
/// A foot this close to where it belongs stays, m and rad.
const HOME: (f64, f64) = (0.04, 0.15);
/// Most steps of an end.
const MOST_STEPS: usize = 8;
/// Shortest and longest flight that is believed, s.
const SHORTEST_FLIGHT: f64 = 0.08;
const LONGEST_FLIGHT: f64 = 0.5;
/// Distance of the middle of the sole before the ankle, m.
const SOLE_MIDDLE: f64 = 0.05;
/// Time constant with which the rates of the joints die away, s, and the fastest one taken over, rad/s.
const DECAY: f64 = 0.2;
const FASTEST: f64 = 4.0;
/// Time in which trunk and arms come to ease, s.
const EASE: f64 = 1.0;
/// Joints this close to where they shall be are there, rad.
const ALIKE: f64 = 0.03;
/// Height of the ankle's arc, m. Clearance proper is the preparation's business.
const ARC: f64 = 0.05;
/// The heel of a foot that is left behind by more than this, m, rises by so much per m, up to the last, rad, within this time, s.
const ROLL_FROM: f64 = 0.15;
const ROLL_GAIN: f64 = 1.0;
const MOST_ROLL: f64 = 0.5;
const ROLL: f64 = 0.2;
/// How long the motion goes on after the feet have come to rest, s.
const REST: f64 = 0.8;

const FOOT: [usize; 2] = [L_FOOT.index(), R_FOOT.index()];

/// Value at `t` of the quintic from `x0`, with slope `v0`, to rest at `x1` after time `end`; no curvature at either end.
fn min_jerk(x0: f64, v0: f64, x1: f64, end: f64, t: f64) -> f64 {
    let u = (t / end).clamp(0.0, 1.0);
    let (d, w) = (x1 - x0, v0 * end);
    let (c3, c4, c5) = (10.0 * d - 6.0 * w, 8.0 * w - 15.0 * d, 6.0 * d - 3.0 * w);
    x0 + u * (w + u * u * (c3 + u * (c4 + u * c5)))
}

fn min_jerk_3(x0: Vec3, v0: Vec3, x1: Vec3, end: f64, t: f64) -> Vec3 {
    let (a, v, b) = (x0.to_array(), v0.to_array(), x1.to_array());
    Vec3::from_array(std::array::from_fn(|k| min_jerk(a[k], v[k], b[k], end, t)))
}

fn smooth(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
}

fn turned(yaw: f64, v: Vec3) -> Vec3 {
    Quat::exp(Vec3::Z * yaw).rotate(v)
}

fn level(p: [f64; 2]) -> Vec3 {
    Vec3 {
        x: p[0],
        y: p[1],
        z: 0.0,
    }
}

fn flat(v: Vec3) -> [f64; 2] {
    [v.x, v.y]
}

/// One step of the end.
#[derive(Clone, Copy, Debug)]
struct Step {
    side: usize,
    off: f64,
    on: f64,
    /// Point of the floor under the flat ankle.
    place: Vec3,
}

/// What the end starts from.
struct State {
    posture: Posture,
    rates: [f64; NV],
    com: Vec3,
    velocity: Vec3,
    ankle: [Vec3; 2],
    ankle_velocity: [Vec3; 2],
    foot: [Quat; 2],
    place: [Vec3; 2],
    yaw: [f64; 2],
    down: [bool; 2],
    /// How long each foot has been in the air, s.
    since: [f64; 2],
    heading: f64,
}

impl State {
    fn of(body: &Body, draft: &Draft, soles: &[Sole; 2]) -> Self {
        let last = draft.postures.len() - 1;
        let back = ((MEASURED * draft.rate_hz) as usize).clamp(1, last);
        let per_s = draft.rate_hz / back as f64;
        let (a, b) = (&draft.postures[last - back], &draft.postures[last]);
        let mut rates = [0.0; NV];
        let spin = (b.root_rotation * a.root_rotation.conjugate()).log();
        rates[..3].copy_from_slice(&spin.to_array());
        rates[6..].copy_from_slice(&a.joint_difference(b));
        for r in &mut rates {
            *r = (*r * per_s).clamp(-FASTEST, FASTEST);
        }
        let mut place = [Vec3::zero(); 2];
        let mut yaw = [0.0; 2];
        for s in 0..2 {
            let (y, pitch) = yaw_pitch(draft.foot[s][last]);
            place[s] = draft.ankle[s][last] - soles[s].stand(Vec3::zero(), y, pitch).ankle;
            place[s].z = 0.0;
            yaw[s] = y;
        }
        // A foot that is about to come down, or has just left, may look as if both were in the air.
        let flight = draft.label.iter().rev();
        let flight = flight.take_while(|l| **l == [false; 2]).count();
        let down = if flight <= last && (flight as f64) < SHORTEST_FLIGHT * draft.rate_hz {
            draft.label[last - flight]
        } else {
            [false; 2]
        };
        let pelvis = yaw_pitch(b.root_rotation).0;
        let feet: Vec<f64> = (0..2)
            .filter(|s| down[*s])
            .map(|s| turn(pelvis, yaw[s]))
            .collect();
        let heading = pelvis + 0.5 * feet.iter().sum::<f64>() / feet.len().max(1) as f64;
        let since = std::array::from_fn(|s| {
            let on: Vec<bool> = draft.label.iter().map(|l| l[s]).collect();
            match runs(&on).last() {
                Some((i, j, false)) => (j - i) as f64 / draft.rate_hz,
                _ => 0.0,
            }
        });
        let com = |i: usize| center_of_mass(body, &forward(body, &draft.postures[i]));
        Self {
            posture: *b,
            rates,
            com: com(last),
            velocity: (com(last) - com(last - back)) * per_s,
            ankle: [0, 1].map(|s| draft.ankle[s][last]),
            ankle_velocity: [0, 1]
                .map(|s: usize| (draft.ankle[s][last] - draft.ankle[s][last - back]) * per_s),
            foot: [0, 1].map(|s| draft.foot[s][last]),
            place,
            yaw,
            down,
            since,
            heading,
        }
    }

    /// True if a body could stop here without a step.
    fn stands(&self, soles: &[Sole; 2], omega: f64) -> bool {
        let feet = Feet {
            place: self.place,
            yaw: self.yaw,
            soles,
        };
        let capture = self.com + self.velocity * (1.0 / omega);
        self.velocity.x.hypot(self.velocity.y) < STANDS.0
            && self.down == [true; 2]
            && margin(&feet.support(self.down), flat(capture)) > STANDS.1
    }
}

/// Where the feet are in the plan.
struct Feet<'a> {
    place: [Vec3; 2],
    yaw: [f64; 2],
    soles: &'a [Sole; 2],
}

impl Feet<'_> {
    fn support(&self, down: [bool; 2]) -> Vec<[f64; 2]> {
        let mut corners = Vec::new();
        for s in (0..2).filter(|s| down[*s]) {
            let at = Anchor {
                place: self.place[s],
                yaw: self.yaw[s],
                pitch: 0.0,
            };
            self.soles[s].footprint(&at, &mut corners);
        }
        hull(&corners)
    }

    fn middle(&self, side: usize) -> Vec3 {
        self.place[side] + turned(self.yaw[side], Vec3::X * SOLE_MIDDLE)
    }
}

/// How it stands in the end. Places from the middle between the ankles, headings against that of the whole.
struct Stand {
    posture: Posture,
    home: [Vec3; 2],
    yaw: [f64; 2],
    mass: Vec3,
    pelvis: Vec3,
    heading: f64,
}

impl Stand {
    fn of(body: &Body, posture: &Posture) -> Self {
        let poses = forward(body, posture);
        let feet = FOOT.map(|s| poses[s]);
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
            home: feet.map(|f| Vec3 {
                z: 0.0,
                ..local(f.0)
            }),
            yaw: yaws.map(|y| turn(heading, y)),
            mass: local(center_of_mass(body, &poses)),
            pelvis: local(posture.root_position),
            heading,
        }
    }
}

/// The pendulum on its way to a stand: footsteps, and the path of its mass.
struct Stop<'a> {
    from: &'a State,
    feet: Feet<'a>,
    stand: &'a Stand,
    leg: f64,
    omega: f64,
    dt: f64,
    capture: Vec3,
    /// What has to be in hand beyond [`CAUGHT`], s.
    spare: f64,
    /// See [`BEYOND`], m.
    beyond: f64,
    /// Foot that steps first where both are down; otherwise the one that catches best.
    first: Option<usize>,
    steps: Vec<Step>,
    path: Vec<Vec3>,
}

impl Stop<'_> {
    fn now(&self) -> f64 {
        (self.path.len() - 1) as f64 * self.dt
    }

    /// Heading that a foot gets.
    fn yaw(&self, side: usize) -> f64 {
        self.from.heading + self.stand.yaw[side]
    }

    fn mass(&self) -> Vec3 {
        self.path.last().copied().unwrap_or_default()
    }

    /// Moves on by one sample with the zero-moment point at `p`: ξ̇ = ω (ξ − p), ċ = ω (ξ − c).
    fn advance(&mut self, p: [f64; 2]) {
        let grows = (self.omega * self.dt).exp();
        let p = level(p);
        self.capture = p + (self.capture - p) * grows;
        let c = self.mass();
        self.path.push(c + (self.capture - c) * (1.0 - 1.0 / grows));
    }

    /// The zero-moment point within `support` that keeps the capture point there, or slows it down most.
    fn hold(&self, support: &[[f64; 2]]) -> [f64; 2] {
        let off = self.capture - level(clip_inside(support, flat(self.capture), INNER));
        clip_inside(support, flat(self.capture + off * LEAN.0), INSET)
    }

    /// Stands on both feet for a while.
    fn both(&mut self, time: f64) {
        let support = self.feet.support([true; 2]);
        for _ in 0..(time / self.dt).round() as usize {
            self.advance(self.hold(&support));
        }
    }

    /// Brings the capture point to `goal` with both feet on the floor.
    fn lean(&mut self, goal: Vec3) {
        let support = self.feet.support([true; 2]);
        for _ in 0..(LEAN.2 / self.dt) as usize {
            let off = self.capture - goal;
            if off.norm() < LEAN.1 {
                break;
            }
            let p = clip_inside(&support, flat(self.capture + off * LEAN.0), INSET);
            self.advance(p);
        }
    }

    /// Foot `side` swings for `time` s while the other one carries the body.
    fn swing(&mut self, side: usize, time: f64, place: Vec3) {
        let off = self.now();
        let mut down = [true; 2];
        down[side] = false;
        let support = self.feet.support(down);
        for _ in 0..((time / self.dt).round() as usize).max(1) {
            self.advance(self.hold(&support));
        }
        self.steps.push(Step {
            side,
            off,
            on: self.now(),
            place,
        });
        self.feet.place[side] = place;
        self.feet.yaw[side] = self.yaw(side);
    }

    /// When and where foot `side` should land to catch the body: as soon as it gets there without hurry.
    ///
    /// * `ankle`: where it is; `least`: shortest time.
    ///
    /// Returns time, place, and how far inside the feet the capture point will be then, m.
    fn catching(&self, side: usize, ankle: Vec3, least: f64) -> (f64, Vec3, f64) {
        let mut down = [true; 2];
        down[side] = false;
        let p = level(self.hold(&self.feet.support(down)));
        let away = self.capture - p;
        let landing = |time: f64| p + away * (self.omega * time).exp();
        // Where it moves, more than it needs: a body stops less well than a pendulum.
        let moves = (self.capture - self.mass()) * self.omega;
        let beyond = moves * (self.beyond / moves.norm().max(1.0));
        let mut best = (f64::INFINITY, least, Vec3::zero());
        let mut time = least;
        while time <= SWING.1.max(least) {
            let place = self.reachable(side, landing(time) + beyond);
            let far = place - ankle;
            let speed = far.x.hypot(far.y) / time;
            if speed < best.0 {
                best = (speed, time, place);
            }
            if speed < SWING_SPEED {
                break;
            }
            time += 0.02;
        }
        let (_, time, place) = best;
        let mut feet = Feet {
            place: self.feet.place,
            yaw: self.feet.yaw,
            soles: self.feet.soles,
        };
        feet.place[side] = place;
        feet.yaw[side] = self.yaw(side);
        let inside = margin(&feet.support([true; 2]), flat(landing(time)));
        (time, place, inside)
    }

    /// Place of foot `side` with the middle of its sole at `wanted`, or as near as the leg allows beside the other foot.
    fn reachable(&self, side: usize, wanted: Vec3) -> Vec3 {
        let heading = self.from.heading;
        let stance = self.feet.place[1 - side];
        let local = turned(-heading, wanted - stance);
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let apart = (self.stand.home[0].y - self.stand.home[1].y).abs();
        let (far, wide) = (LONGEST.0 * self.leg, LONGEST.1 * self.leg);
        let x = (local.x - SOLE_MIDDLE).clamp(-far, far);
        // Far before or behind the other foot there is room to cross.
        let room = ((x.abs() - CROSS_FROM.0) / (CROSS_FROM.1 - CROSS_FROM.0)).clamp(0.0, 1.0);
        let closest = CLOSEST * apart * (1.0 - room) - CROSS * room;
        let mut place = Vec3 {
            x,
            y: (local.y * outward).clamp(closest, wide.max(apart)) * outward,
            z: 0.0,
        };
        if place.x.abs() < 0.02 {
            place.x = 0.0;
        }
        Vec3 {
            z: 0.0,
            ..stance + turned(heading, place)
        }
    }

    /// Where foot `side` belongs beside the other one.
    fn beside(&self, side: usize) -> Vec3 {
        let d = turned(
            self.from.heading,
            self.stand.home[side] - self.stand.home[1 - side],
        );
        Vec3 {
            z: 0.0,
            ..self.feet.place[1 - side] + d
        }
    }

    fn is_home(&self, side: usize) -> bool {
        (self.feet.place[side] - self.beside(side)).norm() < HOME.0
            && turn(self.feet.yaw[side], self.yaw(side)).abs() < HOME.1
    }

    fn is_caught(&self) -> bool {
        let away = self.capture - self.mass();
        let speed = self.omega * away.x.hypot(away.y);
        margin(&self.feet.support([true; 2]), flat(self.capture)) > CAUGHT + self.spare * speed
    }

    /// All of it; false if the body runs away.
    fn run(&mut self) -> bool {
        let from = self.from;
        let mut down = from.down;
        if down == [false; 2] {
            // A body in the air comes down first, on the lower foot, as far ahead as the leg reaches.
            let fall = from.velocity.z;
            let drop = (from.com.z - (self.stand.mass.z - 0.03)).max(0.0);
            let time = ((fall + (fall * fall + 2.0 * GRAVITY * drop).sqrt()) / GRAVITY)
                .clamp(2.0 * self.dt, LONGEST_FLIGHT);
            let velocity = Vec3 {
                z: 0.0,
                ..from.velocity
            };
            for _ in 0..(time / self.dt).round() as usize {
                let c = self.mass() + velocity * self.dt;
                self.path.push(c);
                self.capture = c + velocity * (1.0 / self.omega);
            }
            let side = usize::from(from.ankle[1].z < from.ankle[0].z);
            let c = self.mass();
            let reach = (self.capture - c).norm().min(0.5 * LONGEST.0 * self.leg);
            let ahead = (self.capture - c).normalized_or(Vec3::X) * reach;
            let place = c + ahead + turned(from.heading, Vec3::Y * self.stand.home[side].y);
            self.steps.push(Step {
                side,
                off: 0.0,
                on: self.now(),
                place,
            });
            self.feet.place[side] = place;
            self.feet.yaw[side] = self.yaw(side);
            down[side] = true;
        }
        // The foot in the air lands where it catches; with both down, the one farther from the capture point goes first.
        let mut ankle = from.ankle;
        if let Some(side) = (0..2).find(|s| !down[*s]) {
            let since = from.since[side] + self.now();
            let least = (SWING.0 - since).max(LEAST_REST_OF_SWING);
            let (time, place, _) = self.catching(side, ankle[side], least);
            let before = self.now();
            self.swing(side, time, place);
            if let Some(step) = self.steps.last_mut().filter(|_| before > 0.0) {
                step.off = 0.0;
            }
            self.both(BOTH);
        }
        for _ in 0..MOST_STEPS {
            for s in self.steps.iter() {
                ankle[s.side] = s.place;
            }
            if self.is_caught() {
                break;
            }
            let [left, right] = [0, 1].map(|s: usize| self.catching(s, ankle[s], SWING.0));
            let right_first = match self.first.take() {
                Some(side) => side == 1,
                None => right.2 > left.2,
            };
            let (side, (time, place, _)) = if right_first { (1, right) } else { (0, left) };
            self.swing(side, time, place);
            self.both(BOTH);
        }
        if !self.is_caught() {
            return false;
        }
        // Feet side by side: the one that carries less moves.
        for _ in 0..2 {
            let far = |s: usize| (self.feet.middle(s) - self.capture).norm();
            let side = usize::from(far(1) > far(0));
            if self.is_home(side)
                && turn(self.feet.yaw[1 - side], self.yaw(1 - side)).abs() < HOME.1
            {
                break;
            }
            let side = if self.is_home(side) { 1 - side } else { side };
            self.lean(self.feet.middle(1 - side));
            let place = self.beside(side);
            self.swing(side, CLOSING, place);
            self.both(BOTH);
        }
        let middle = (self.feet.place[0] + self.feet.place[1]) * 0.5;
        self.lean(Vec3 {
            z: 0.0,
            ..middle + turned(from.heading, self.stand.mass)
        });
        self.both(REST);
        self.is_caught()
    }
}

/// Samples after the last one of `draft`, from its motion to standing as `goal` does, or at ease. `None` if it stands like that already, or at
/// all if there is no goal, if it does not walk, or if no steps are found that stop it.
fn tail(body: &Body, draft: &Draft, goal: Option<&Posture>, spare: f64) -> Option<Draft> {
    let rate = draft.rate_hz;
    if draft.postures.len() < 3 {
        return None;
    }
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let from = State::of(body, draft, &soles);
    let stand = Stand::of(body, goal.unwrap_or(&at_ease(body)));
    let omega = (GRAVITY / (0.5 * (from.com.z + stand.mass.z)).max(0.3)).sqrt();
    if from.posture.root_position.z < UPRIGHT * body.standing_root_height() {
        return None;
    }
    if from.stands(&soles, omega) && goal.is_none_or(|g| alike(&from.posture, g)) {
        return None;
    }
    let ground = |v: Vec3| Vec3 { z: 0.0, ..v };
    let plan = |(spare, beyond, first): (f64, f64, Option<usize>)| {
        let mut stop = Stop {
            from: &from,
            feet: Feet {
                place: from.place,
                yaw: from.yaw,
                soles: &soles,
            },
            stand: &stand,
            leg: leg_length(body),
            omega,
            dt: 1.0 / rate,
            capture: ground(from.com + from.velocity * (1.0 / omega)),
            spare,
            beyond,
            first,
            steps: Vec::new(),
            path: vec![ground(from.com)],
        };
        stop.run().then_some(stop)
    };
    // With as much in hand as there is a way for, and with the foot first that catches best, or else with either.
    let beyond = match spare > 0.0 {
        true => [BEYOND, 0.0],
        false => [0.0, BEYOND],
    };
    let hands: &[f64] = if spare > 0.0 {
        &[1.0, 0.5, 0.0]
    } else {
        &[0.0]
    };
    let ways = hands
        .iter()
        .flat_map(|h| beyond.map(|b| (h * spare, b)))
        .flat_map(|(h, b)| [None, Some(0), Some(1)].map(|first| (h, b, first)));
    let stop = { ways }.find_map(plan)?;
    let upright = Quat::exp(Vec3::Z * (from.heading - stand.heading)) * stand.posture.root_rotation;
    // The zero-moment point of the pendulum jumps from foot to foot; a body's does not.
    let mut path = stop.path;
    low_pass_points(&mut path, 4.0, rate);
    let offset = ground(from.posture.root_position - from.com);
    let end_offset = turned(from.heading, ground(stand.pelvis - stand.mass));
    let mut out = Draft::empty(rate);
    let last = draft.postures.len() - 1;
    for i in 1..path.len() {
        let t = i as f64 / rate;
        let s = smooth(t / EASE);
        let mut p = from.posture;
        // Rates die away while the joints come to ease.
        let mut rates = from.rates;
        rates[3..6].fill(0.0);
        p.integrate(&rates, DECAY * (1.0 - (-t / DECAY).exp()));
        let mut way = [0.0; NV];
        let spin = (upright * p.root_rotation.conjugate()).log() * s;
        way[..3].copy_from_slice(&spin.to_array());
        for (w, d) in way[6..].iter_mut().zip(p.joint_difference(&stand.posture)) {
            *w = s * d;
        }
        p.integrate(&way, 1.0);
        let at = path[i] + offset * (1.0 - s) + end_offset * s;
        p.root_position = Vec3 {
            z: min_jerk(
                from.posture.root_position.z,
                from.velocity.z,
                stand.pelvis.z,
                EASE,
                t,
            ),
            ..at
        };
        let mut label = [true; 2];
        for side in 0..2 {
            let yaw = from.heading + stand.yaw[side];
            let (ankle, foot, down) = swing(&from, &stop.steps, &soles[side], (side, yaw), t);
            out.ankle[side].push(ankle);
            out.foot[side].push(foot);
            label[side] = down;
            let axis =
                draft.knee_axis[side][last] * (1.0 - s) + p.root_rotation.rotate(Vec3::Y) * s;
            out.knee_axis[side].push(axis.normalized_or(Vec3::Y));
        }
        out.label.push(label);
        out.postures.push(p);
    }
    Some(out)
}

/// Length of a leg from hip to ankle, m.
fn leg_length(body: &Body) -> f64 {
    body.joint_offset[FOOT[0]].norm() + body.joint_offset[FOOT[0] - 1].norm()
}

/// True if nothing worth a movement is between two postures.
fn alike(a: &Posture, b: &Posture) -> bool {
    a.joint_difference(b).iter().all(|e| e.abs() < ALIKE)
}

/// Stance of a foot between two of its steps.
struct Stance {
    place: Vec3,
    yaw: f64,
    /// From when to when, s.
    on: f64,
    off: f64,
    /// Pitch when it comes down, in the middle, and when it is lifted, rad.
    pitch: [f64; 3],
}

impl Stance {
    /// Pose `t` seconds into the end. The heel of a foot that is left behind rises before it is lifted, over [`ROLL`].
    fn pose(&self, sole: &Sole, t: f64) -> (Vec3, Quat) {
        let [first, middle, last] = self.pitch;
        let half = 0.5 * (self.off - self.on);
        let rise = smooth(1.0 - (self.off - t) / ROLL.min(half).max(1e-9));
        let settle = smooth((t - self.on) / ROLL.min(half).max(1e-9));
        let pitch = first + (middle - first) * settle + (last - middle) * rise;
        let pose = sole.stand(self.place, self.yaw, pitch);
        (pose.ankle, pose.rotation)
    }
}

/// Pitch of a foot at `place` that is left behind by the other one at `other`, rad: heel up.
fn left_behind(place: Vec3, other: Vec3, heading: f64) -> f64 {
    let behind = turned(-heading, other - place).x;
    -(ROLL_GAIN * (behind - ROLL_FROM)).clamp(0.0, MOST_ROLL)
}

/// Ankle and rotation of a foot `t` seconds into the end, and whether it is down.
fn swing(
    from: &State,
    steps: &[Step],
    sole: &Sole,
    (side, yaw): (usize, f64),
    t: f64,
) -> (Vec3, Quat, bool) {
    let other = |t: f64| {
        let landed = steps.iter().rev().find(|s| s.side != side && s.on <= t);
        landed.map_or(from.place[1 - side], |s| s.place)
    };
    let mine: Vec<&Step> = steps.iter().filter(|s| s.side == side).collect();
    let pitch = yaw_pitch(from.foot[side]).1;
    let stance = |k: usize| {
        let off = mine.get(k).map_or(f64::INFINITY, |s| s.off);
        let lifted = |place: Vec3| left_behind(place, other(off), from.heading);
        match k.checked_sub(1) {
            None => {
                let place = from.place[side];
                let last = if off.is_finite() {
                    lifted(place).min(pitch)
                } else {
                    pitch
                };
                Stance {
                    place,
                    yaw: from.yaw[side],
                    on: 0.0,
                    off,
                    pitch: [pitch, pitch, last],
                }
            }
            Some(before) => {
                let Step { place, on, .. } = *mine[before];
                let first = left_behind(place, other(on), from.heading);
                let last = if off.is_finite() { lifted(place) } else { 0.0 };
                Stance {
                    place,
                    yaw,
                    on,
                    off,
                    pitch: [first, 0.0, last],
                }
            }
        }
    };
    let begins = |k: usize| mine.get(k).map_or(f64::INFINITY, |s| s.off);
    let k = (0..=mine.len())
        .find(|k| t <= begins(*k))
        .unwrap_or(mine.len());
    let under_way = k
        .checked_sub(1)
        .map(|k| (k, mine[k]))
        .filter(|(_, s)| t < s.on);
    let Some((k, step)) = under_way else {
        if k == 0 && !from.down[side] {
            return (from.ankle[side], from.foot[side], true);
        }
        let (ankle, rotation) = stance(k).pose(sole, t);
        return (ankle, rotation, true);
    };
    let in_air = k == 0 && !from.down[side];
    let (start, rotation, velocity) = if in_air {
        (from.ankle[side], from.foot[side], from.ankle_velocity[side])
    } else {
        let (ankle, rotation) = stance(k).pose(sole, step.off);
        (ankle, rotation, Vec3::zero())
    };
    let (goal, flat) = stance(k + 1).pose(sole, step.on);
    let long = step.on - step.off;
    let u = (t - step.off) / long;
    let mut p = min_jerk_3(start, velocity, goal, long, t - step.off);
    // What is left of a swing rises no more.
    let arc = if in_air {
        ARC * ((long - SWING.0) / SWING.0).clamp(0.0, 1.0)
    } else {
        ARC
    };
    p.z += arc * 16.0 * u * u * (1.0 - u) * (1.0 - u);
    let spin = (flat * rotation.conjugate()).log() * smooth(u);
    (p, Quat::exp(spin) * rotation, false)
}

impl Draft {
    fn empty(rate_hz: f64) -> Self {
        Self {
            rate_hz,
            postures: Vec::new(),
            knee_axis: Default::default(),
            ankle: Default::default(),
            foot: Default::default(),
            label: Vec::new(),
        }
    }

    /// Postures that are whole, legs included, with the feet labelled as on the floor or not.
    pub fn of_postures(
        body: &Body,
        rate_hz: f64,
        postures: Vec<Posture>,
        label: Vec<[bool; 2]>,
    ) -> Self {
        let mut out = Self::empty(rate_hz);
        for p in &postures {
            let poses = forward(body, p);
            for s in 0..2 {
                let (ankle, foot) = poses[FOOT[s]];
                out.ankle[s].push(ankle);
                out.foot[s].push(foot);
                out.knee_axis[s].push(knee_axis(p, s == 0));
            }
        }
        out.postures = postures;
        out.label = label;
        out
    }

    /// The same motion backwards.
    fn reversed(mut self) -> Self {
        self.postures.reverse();
        self.label.reverse();
        for s in 0..2 {
            self.knee_axis[s].reverse();
            self.ankle[s].reverse();
            self.foot[s].reverse();
        }
        self
    }

    fn append(&mut self, more: Self) {
        self.postures.extend(more.postures);
        self.label.extend(more.label);
        let parts = more.knee_axis.into_iter().zip(more.ankle).zip(more.foot);
        for (s, ((axis, ankle), foot)) in parts.enumerate() {
            self.knee_axis[s].extend(axis);
            self.ankle[s].extend(ankle);
            self.foot[s].extend(foot);
        }
    }

    /// Continues a draft of whole postures so that it ends standing like `goal`, wherever that is. Returns how many samples it took.
    pub fn end_like(&mut self, body: &Body, goal: &Posture) -> usize {
        let Some(after) = tail(body, self, Some(goal), 0.0) else {
            return 0;
        };
        let count = after.postures.len();
        self.append(after);
        count
    }

    /// Continues a draft of whole postures to a stand, wherever that is. Returns how many samples it took; none if it stands, sits or lies.
    ///
    /// * `given`: the moment is given, or the motion poorly known: more is kept in hand than for a moment that was chosen for being easy.
    pub fn end_standing(&mut self, body: &Body, given: bool) -> usize {
        let after = tail(body, self, None, if given { SPARE } else { 0.0 });
        let count = after.as_ref().map_or(0, |a| a.postures.len());
        if let Some(after) = after {
            self.append(after);
        }
        count
    }

    /// Continues a draft of whole postures to a stand and lets it begin from one, where it does not stand, sit or lie anyway. Returns how
    /// many samples came before and after.
    pub fn add_ends(&mut self, body: &Body) -> (usize, usize) {
        let after = tail(body, self, None, SPARE);
        let before = tail(body, &self.clone().reversed(), None, SPARE).map(Self::reversed);
        let count = |d: &Option<Self>| d.as_ref().map_or(0, |d| d.postures.len());
        let counts = (count(&before), count(&after));
        let mut all = before.unwrap_or_else(|| Self::empty(self.rate_hz));
        all.append(std::mem::replace(self, Self::empty(self.rate_hz)));
        if let Some(after) = after {
            all.append(after);
        }
        *self = all;
        counts
    }
}
