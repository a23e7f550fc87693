//! Turns a stream, as it arrives, into a motion that a body can follow, over a sliding window.
//!
//! [`prepare`](super::prepare) treats a whole clip; here the same happens sample by sample, one window behind the
//! newest sample. The stages are smoothing, labels of planted feet, foot lock, swings that clear the floor and meet the
//! next foothold, a pelvis that both legs reach, and the shift of the trunk that keeps the zero-moment point over the
//! feet, solved over the window again with every sample. Memory is a ring, time per sample is bounded, and nothing
//! allocates. Rounding is the same on every machine, since this is part of the tick.
//!
//! Position of a sample at each stage, in samples behind the newest: smoothed (`stream::SMOOTH`), labelled and balanced
//! (`LABEL`), feet posed and the planned body balanced again (up to `stream::FORESEEN` before the output), output (the
//! window).

mod foot;
mod late_entry;
mod momentum;
mod receding_horizon;
mod repeated_samples;
mod whole_body;

use super::ankle_torque_limit::AnkleTorqueLimit;
use super::foot_lock::{AnklePose, FootPose, Sole};
use crate::body::topology::{FEET, NV, SEGMENT_COUNT, TOES};
use crate::body::{Body, Posture};
use crate::math::curve::smootherstep;
use crate::math::exp::exp;
use crate::math::{Quat, Vec3};
use crate::motion::clip::{Knot, PlanarTransform, between};
use crate::motion::leg_ik::{center_of_mass, forward};
use crate::motion::target::Target;
use crate::plan::params::{contact, pelvis, stream, transition};
use crate::time::StreamTime;
pub use foot::Stance;
use foot::StreamFoot;
use receding_horizon::Balance;
use repeated_samples::RepeatedSamples;
pub use repeated_samples::is_same;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::sync::Arc;
use whole_body::PelvisLowering;

/// Samples per second of the grid that a stream is prepared on.
pub const RATE: f64 = stream::RATE;
/// Shortest and longest window, s.
pub const WINDOW: (f64, f64) = (stream::SHORTEST_WINDOW, stream::LONGEST_WINDOW);
/// Largest number of stances of a foot that are known at a time.
pub const MOST_STANCES: usize = foot::STANCES + 1;
const H: f64 = 1.0 / RATE;

/// Samples between the newest one and the one that is labelled.
const LABEL: i64 = stream::SMOOTH + 1 + contact::STREAM_STEADY;
/// Samples that may wait to be prepared: ten seconds.
pub const MOST_PENDING: usize = 600;

/// Whether this is the number of a sample that a stream can reach within a thousand years.
fn is_sample(number: i64) -> bool {
    number.unsigned_abs() < 1 << 41
}

/// A sample as it was received.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Raw {
    posture: Posture,
    planted: Option<[bool; 2]>,
}

/// Data received with a sample.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Received {
    /// Points of the received feet: ankle, toe joint, toe tip.
    points: [[Vec3; 3]; 2],
    /// Labels received with it.
    planted: Option<[bool; 2]>,
    /// Whether the stream jumped just before.
    broken: bool,
}

/// A sample on its way through the window.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Sample {
    /// The received posture, moved to where the stream lies now, with jumps spread.
    raw: Posture,
    received: Received,
    smooth: Posture,
    /// Poses of the segments of `smooth`.
    #[serde(skip, default = "unposed")]
    poses: [(Vec3, Quat); SEGMENT_COUNT],
    com: Vec3,
    /// Angular momentum about the centre of mass, kg·m²/s.
    momentum: Vec3,
    /// Centre of mass and momentum of the planned body, without the shift for balance.
    built: Built,
    /// How strongly the feet are believed to carry the body, 0…1.
    trust: f64,
    /// Planned foot poses, heights still without clearance.
    feet: [FootPose; 2],
    down: [bool; 2],
    /// Height that each sole lacks to clear the floor, m.
    lift: [f64; 2],
    /// How far the pelvis has to come down, m (≤ 0).
    drop: f64,
}

fn unposed() -> [(Vec3, Quat); SEGMENT_COUNT] {
    [(Vec3::zero(), Quat::identity()); SEGMENT_COUNT]
}

/// The planned body.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Built {
    poses: [(Vec3, Quat); SEGMENT_COUNT],
    com: Vec3,
    momentum: Vec3,
}

impl Sample {
    fn new(posture: &Posture, poses: [(Vec3, Quat); SEGMENT_COUNT]) -> Self {
        Self {
            raw: *posture,
            received: Received {
                points: [[Vec3::zero(); 3]; 2],
                planted: None,
                broken: false,
            },
            smooth: *posture,
            poses,
            com: Vec3::zero(),
            momentum: Vec3::zero(),
            built: Built {
                poses,
                com: Vec3::zero(),
                momentum: Vec3::zero(),
            },
            trust: 1.0,
            feet: [FootPose::default(); 2],
            down: [false; 2],
            lift: [0.0; 2],
            drop: 0.0,
        }
    }
}

/// How far behind the newest sample each stage is.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Timing {
    /// Samples between the newest one and the output.
    window: i64,
    /// Samples between the output and the one whose feet are posed.
    ahead: i64,
    /// Weights of the smoothing, the middle one first.
    weights: [f64; stream::SMOOTH as usize + 1],
}

/// Samples that have been received and wait.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Input {
    pending: VecDeque<Raw>,
    newest: RepeatedSamples,
    /// Samples at the end that were guessed.
    guessed: i64,
    /// Number of samples up to where the stream broke off in motion, or fell silent.
    ends: Option<i64>,
}

/// The samples already output.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Output {
    knots: Vec<Knot>,
    /// Last five postures, from which rates are computed.
    recent: [Posture; 5],
    /// Number of the last sample, −1 before the first.
    last: i64,
}

/// The shift for balance and the averages it depends on.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct ShiftState {
    /// Shift of the centre of mass for balance, at the output and one sample before, newest last, m.
    shift: [[f64; 2]; 2],
    /// Displacement from the zero-moment point into the support on average over about a second, m.
    lasting: [f64; 2],
    horizon: Balance,
}

/// Components of a posture minus those of another one.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Difference(#[serde(with = "crate::saved::array")] [f64; NV]);

/// Place of the stream in the world.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Placement {
    /// Transform of the stream; a stream that jumps continues from where it was.
    frame: PlanarTransform,
    /// The remaining part of a jump, the samples since, and the time over which it fades, s.
    fade: Option<(Difference, i64, f64)>,
    /// Number of the sample from which another stream takes over, and the time, s, over which its jump, however small,
    /// fades.
    join: Option<(i64, f64)>,
}

/// A stream of one figure on its way to becoming a motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StreamPlan {
    #[serde(with = "crate::saved::definition")]
    body: Arc<Body>,
    #[serde(skip)]
    soles: [Sole; 2],
    #[serde(skip)]
    ankle_limit: AnkleTorqueLimit,
    timing: Timing,
    input: Input,
    /// Number of samples taken into the ring.
    count: i64,
    ring: Vec<Sample>,
    feet: [StreamFoot; 2],
    lowering: PelvisLowering,
    balance: ShiftState,
    output: Output,
    placement: Placement,
}

impl StreamPlan {
    /// A stream without samples, prepared `window` seconds behind its newest one (within [`WINDOW`]). Allocates all the
    /// memory it will ever need.
    pub fn new(body: Arc<Body>, window: f64) -> Self {
        let window = (window.clamp(WINDOW.0, WINDOW.1) * RATE).floor() as i64;
        let length = (stream::PAST + window + 8) as usize;
        let posture = Posture::default();
        let blank = Sample::new(&posture, forward(&body, &posture));
        let knot = Knot::of(&[posture], 0, H, [true; 2]);
        let mut weights: [f64; stream::SMOOTH as usize + 1] = std::array::from_fn(|k| {
            exp(-0.5 * (k as f64 / stream::SIGMA) * (k as f64 / stream::SIGMA))
        });
        let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
        weights.iter_mut().for_each(|w| *w /= sum);
        Self {
            soles: [Sole::new(&body, 0), Sole::new(&body, 1)],
            ankle_limit: AnkleTorqueLimit::new(&body),
            timing: Timing {
                window,
                ahead: stream::POSED + (window - (WINDOW.0 * RATE) as i64).min(stream::FORESEEN),
                weights,
            },
            input: Input {
                pending: VecDeque::with_capacity(MOST_PENDING),
                newest: RepeatedSamples::default(),
                guessed: 0,
                ends: None,
            },
            count: 0,
            ring: vec![blank; length],
            feet: [StreamFoot::new(), StreamFoot::new()],
            lowering: PelvisLowering::default(),
            balance: ShiftState {
                shift: [[0.0; 2]; 2],
                lasting: [0.0; 2],
                horizon: Balance::new(window as usize),
            },
            output: Output {
                knots: vec![knot; stream::PAST as usize],
                recent: [posture; 5],
                last: -1,
            },
            placement: Placement::default(),
            body,
        }
    }

    /// Restores whatever follows from the body and the buffers in a stream that was read from a checkpoint. Returns
    /// whether the value is one that a checkpoint could hold.
    #[must_use]
    pub fn complete(&mut self) -> bool {
        let window = self.timing.window as f64 * H;
        if !(WINDOW.0 - H..=WINDOW.1).contains(&window) {
            return false;
        }
        let fresh = Self::new(Arc::clone(&self.body), window + 0.5 * H);
        (self.soles, self.ankle_limit) = (fresh.soles, fresh.ankle_limit);
        let body = Arc::clone(&self.body);
        for sample in &mut self.ring {
            sample.poses = forward(&body, &sample.smooth);
        }
        // The progress of every stage follows from the number of samples, since a tick runs all of them.
        let newest = self.count - 1;
        let out = newest + 3 - self.timing.window;
        let posed = (out + self.timing.ahead).max(-1);
        let labelled = (newest - LABEL + 1).max(0);
        let fade = |f: &(Difference, i64, f64)| (0..=self.count).contains(&f.1) && f.2 > 0.0;
        let join = |j: &(i64, f64)| is_sample(j.0) && j.1 > 0.0;
        self.timing.window == fresh.timing.window
            && self.timing.ahead == fresh.timing.ahead
            && self.ring.len() == fresh.ring.len()
            && self.output.knots.len() == fresh.output.knots.len()
            && self.input.pending.len() <= MOST_PENDING
            && self.input.newest.is_valid()
            && is_sample(self.input.guessed)
            && self
                .input
                .ends
                .is_none_or(|n| (0..=self.fed()).contains(&n))
            && is_sample(self.count)
            && self.count >= 0
            && self.output.last == out.max(-1)
            && self.feet.iter().all(|f| f.is_valid(self.count, posed))
            && self.placement.frame.is_finite()
            && self.placement.fade.as_ref().is_none_or(fade)
            && self.placement.join.as_ref().is_none_or(join)
            && self
                .balance
                .horizon
                .complete(self.timing.window as usize, out.max(0)..labelled)
    }

    /// Length of the window, s.
    pub fn window(&self) -> f64 {
        self.timing.window as f64 * H
    }

    /// Transform of the stream in the world; it changes when the stream jumps.
    pub fn frame(&self) -> PlanarTransform {
        self.placement.frame
    }

    /// Number of samples that were taken or wait.
    pub fn fed(&self) -> i64 {
        self.count + self.input.pending.len() as i64
    }

    /// The same up to where the stream broke off in motion or fell silent, if it did.
    pub fn moved(&self) -> i64 {
        self.input.ends.unwrap_or_else(|| self.fed())
    }

    /// Time of the last sample before the stream broke off in motion or fell silent, s. The motion is played up to
    /// there, even if the stream moves again afterwards: in between it stood in a posture in which a body cannot stay.
    pub fn ends_at(&self) -> Option<StreamTime> {
        self.input
            .ends
            .map(|n| StreamTime((n - 1).max(0) as f64 * H))
    }

    /// Whether its samples have repeated one in the middle of a movement for so long that the stream is over: no body
    /// stops like that.
    pub fn breaks_off(&self) -> bool {
        self.input.newest.breaks_off()
    }

    /// Lets another stream take over from here: the samples pushed next are moved to where this one is, and the
    /// difference fades over `blend` seconds.
    pub fn join(&mut self, blend: f64) {
        self.placement.join = Some((self.fed(), blend.max(H)));
    }

    /// Takes the next sample, 1/[`RATE`] s after the last one.
    ///
    /// * `planted`: feet on the floor (left, right), if the sender knows.
    ///
    /// A sample that is not finite is left out.
    pub fn push(&mut self, posture: &Posture, planted: Option<[bool; 2]>) {
        if !posture.is_finite() {
            return;
        }
        let input = &mut self.input;
        input.newest.take(posture);
        input.guessed = 0;
        let (moves, played) = (input.newest.repeated() == 0, self.output.last);
        if moves && input.ends.is_some_and(|n| n <= played) {
            input.ends = None;
        }
        self.wait(Raw {
            posture: *posture,
            planted,
        });
        if self.breaks_off() {
            self.end_before(self.input.newest.repeated());
        }
    }

    /// [`Self::push`] of a sample that the receiver guessed, since none had arrived in time. If the stream falls silent
    /// after it, it is not played.
    pub fn push_guess(&mut self, posture: &Posture, planted: Option<[bool; 2]>) {
        let guessed = self.input.guessed + 1;
        self.push(posture, planted);
        self.input.guessed = guessed;
    }

    /// No sample has arrived for too long to guess one: the stream ends with the last one that did. Until another
    /// arrives, it stands still.
    pub fn fall_silent(&mut self) {
        let Some(last) = self.input.newest.posture() else {
            return;
        };
        let guessed = self.input.guessed;
        self.end_before(self.input.newest.repeated().max(guessed));
        self.push(&last, None);
        self.input.guessed = guessed + 1;
    }

    /// Ends the stream before its newest `count` samples, unless it has ended already.
    fn end_before(&mut self, count: i64) {
        let end = (self.fed() - count).max(0);
        self.input.ends.get_or_insert(end);
    }

    fn wait(&mut self, raw: Raw) {
        if self.input.pending.len() == MOST_PENDING {
            self.input.pending.pop_front();
        }
        self.input.pending.push_back(raw);
    }

    /// Prepares the received samples, up to time `t`. Where the stream has not come that far, it stands still in its
    /// last posture.
    pub fn advance(&mut self, t: StreamTime) {
        let needed = ((t.0 * RATE - 1e-6).ceil() as i64).saturating_add(self.timing.window);
        // Time jumps of hostile clocks are not made up for sample by sample.
        let most = self.count + self.timing.window + stream::PAST;
        while self.count < needed.min(most) {
            match self.input.pending.pop_front() {
                Some(raw) => self.take(&raw.posture, raw.planted),
                None if self.count > 0 => {
                    let last = self.at(self.count - 1).raw;
                    let back = self.unframed(&last);
                    self.take(&back, None);
                }
                None => return,
            }
        }
    }

    fn unframed(&self, posture: &Posture) -> Posture {
        let mut p = *posture;
        self.placement.frame.power(-1.0).apply_posture(&mut p);
        p
    }

    fn slot(&self, i: i64) -> usize {
        i.rem_euclid(self.ring.len() as i64) as usize
    }

    /// Sample `i`; the first one for any before it.
    fn at(&self, i: i64) -> &Sample {
        &self.ring[self.slot(i.max(0))]
    }

    fn at_mut(&mut self, i: i64) -> &mut Sample {
        let k = self.slot(i);
        &mut self.ring[k]
    }

    /// Moves the stream to where its last samples were leading if it has jumped, and spreads the rest of the jump.
    fn placed(&mut self, posture: &Posture) -> (Posture, bool) {
        let mut p = *posture;
        self.placement.frame.apply_posture(&mut p);
        if self.count < 2 {
            return (p, false);
        }
        let (a, b) = (self.at(self.count - 2).raw, self.at(self.count - 1).raw);
        let mut led = b;
        let going = a.difference(&b);
        led.integrate(&going, 1.0);
        let mut faded = self.faded(&p);
        let off = led.difference(&faded);
        let far = (off[3] * off[3] + off[4] * off[4] + off[5] * off[5]).sqrt();
        let beyond = |e: &&f64| e.abs() > stream::JUMP_ANGLE;
        // A single joint that snaps is only a glitch of that joint; a stream that jumps takes the whole body along.
        let join = self.placement.join.take_if(|(from, _)| *from <= self.count);
        let jumped = join.is_some()
            || far > stream::JUMP_DISTANCE
            || off[..3].iter().any(|e| beyond(&e))
            || off[6..].iter().filter(beyond).count() >= stream::JUMP_JOINTS;
        if jumped {
            // The place of the pelvis over the floor and its heading continue as they were; the rest is spread.
            let yaw = led.root_rotation.heading() - p.root_rotation.heading();
            let turn = PlanarTransform {
                x: 0.0,
                y: 0.0,
                yaw,
            };
            let turned = turn.point(p.root_position);
            let step = PlanarTransform {
                x: led.root_position.x - turned.x,
                y: led.root_position.y - turned.y,
                yaw,
            };
            self.placement.frame = step.after(self.placement.frame);
            step.apply_posture(&mut p);
            let time = join.map_or(transition::BLEND_TIME, |(_, blend)| blend);
            self.placement.fade = Some((Difference(p.difference(&led)), 0, time));
            faded = self.faded(&p);
        }
        if let Some((_, since, time)) = &mut self.placement.fade {
            *since += 1;
            if *since as f64 * H >= *time {
                self.placement.fade = None;
            }
        }
        (faded, jumped)
    }

    fn faded(&self, posture: &Posture) -> Posture {
        let mut p = *posture;
        if let Some((Difference(e), since, time)) = &self.placement.fade {
            let u = (*since as f64 * H / time).min(1.0);
            let s = 1.0 - smootherstep(u);
            p.integrate(&e.map(|e| e * s), 1.0);
        }
        p
    }

    /// Takes one sample through all stages.
    fn take(&mut self, posture: &Posture, planted: Option<[bool; 2]>) {
        let mut given = *posture;
        let (raw, broken) = self.placed(posture);
        self.placement.frame.apply_posture(&mut given);
        let k = self.count;
        let poses = forward(&self.body, &raw);
        let mut sample = Sample::new(&raw, poses);
        let own = forward(&self.body, &given);
        sample.received.points = [0, 1].map(|side| {
            let (at, q) = own[TOES[side].index()];
            let tip = self.soles[side].toe_tip();
            [own[FEET[side].index()].0, at, at + q.rotate(tip)]
        });
        sample.received.planted = planted;
        sample.received.broken = broken;
        *self.at_mut(k) = sample;
        self.count += 1;
        if k == 0 {
            self.measure(0);
        }
        let s = k - stream::SMOOTH;
        if s < 0 {
            return;
        }
        self.smooth(s);
        self.measure(s);
        self.touch(s - 1);
        self.momentum(s - 1);
        let j = k - LABEL;
        if j >= 0 {
            self.label(j, s - 1);
            self.balance(j);
        }
        let out = k + 3 - self.timing.window;
        let f = out + self.timing.ahead;
        if f >= 0 {
            if out < 0 {
                self.balance.horizon.next(None);
            }
            self.pose_feet(f, s - 1, j);
            let built = f - stream::POSED;
            if built > out && built >= 0 {
                self.build(built);
            }
        }
        if out >= 0 {
            self.emit(out);
        }
    }

    /// Gaussian average about sample `i`, in its tangent space.
    fn smooth(&mut self, i: i64) {
        let centre = self.at(i).raw;
        let mut e = [0.0; NV];
        // At the beginning the past is assumed to mirror the samples that follow.
        for (k, w) in (1..=stream::SMOOTH.min(i)).zip(&self.timing.weights[1..]) {
            for j in [i - k, i + k] {
                let d = centre.difference(&self.at(j).raw);
                for (e, d) in e.iter_mut().zip(d) {
                    *e += w * d;
                }
            }
        }
        let mut smooth = centre;
        smooth.integrate(&e, 1.0);
        self.at_mut(i).smooth = smooth;
    }

    /// Poses and centre of mass of a smoothed sample.
    fn measure(&mut self, i: i64) {
        let poses = forward(&self.body, &self.at(i).smooth);
        let com = center_of_mass(&self.body, &poses);
        let s = self.at_mut(i);
        (s.poses, s.com) = (poses, com);
        s.feet = std::array::from_fn(|k| {
            let (ankle, rotation) = poses[FEET[k].index()];
            FootPose {
                ankle,
                rotation,
                toe: 0.0,
            }
        });
    }

    /// Finds the points of the received feet that touch the floor in sample `i`.
    fn touch(&mut self, i: i64) {
        if i < 0 {
            return;
        }
        // A jump of the stream is not a movement of its feet.
        let broken = self.at(i).received.broken || self.at(i + 1).received.broken;
        let hint = self.at(i).received.planted;
        for side in 0..2 {
            let (a, b, c) = (
                self.at(i - 1).received.points[side],
                self.at(i).received.points[side],
                self.at(i + 1).received.points[side],
            );
            let standing = self.soles[side].standing_heights();
            let speed = |k: usize| {
                if broken {
                    None
                } else {
                    Some((c[k] - a[k]).norm() * 0.5 * RATE)
                }
            };
            self.feet[side].touch(i, b, standing, speed, hint.map(|h| h[side]));
        }
    }

    /// Decides which feet are planted in sample `j`; `last` is the newest sample whose contacts are known.
    fn label(&mut self, j: i64, last: i64) {
        let upright =
            self.at(j).smooth.root_position.z > pelvis::SEATED * self.body.standing_root_height();
        for side in 0..2 {
            let mut foot = std::mem::replace(&mut self.feet[side], StreamFoot::new());
            let other = &self.feet[1 - side];
            let given_up = foot.label(j, last, upright, other, |i| self.standing(side, i));
            self.feet[side] = foot;
            for i in given_up.unwrap_or(j)..j {
                self.improve(i, |s| (s.com, s.momentum));
            }
        }
    }

    /// Place, heading and pitch of a foot of a smoothed sample, and how fast its place moves, m/s.
    fn standing(&self, side: usize, i: i64) -> foot::StandingSample {
        let pose = |i: i64| AnklePose::of(&self.at(i).poses, side);
        let [before, at] = [i - 1, i].map(|i| self.soles[side].footing(pose(i)));
        foot::StandingSample {
            place: at.place,
            yaw: at.yaw,
            pitch: at.pitch,
            steep: foot::steepness(pose(i).rotation, at.pitch),
            speed: (at.place - before.place).norm() * RATE,
        }
    }

    /// Outputs the whole posture of sample `out`.
    fn emit(&mut self, out: i64) {
        self.shift_on(out);
        let posture = self.posture(out, self.balance.shift[1]);
        let s = self.at(out);
        let down = s.down;
        if out == 0 {
            self.output.recent = [posture; 5];
        }
        self.output.recent.rotate_left(1);
        self.output.recent[4] = posture;
        self.output.last = out;
        let n = self.output.knots.len() as i64;
        self.output.knots[out.rem_euclid(n) as usize] = Knot::of(&[posture], 0, H, down);
        // Rates need two neighbours on either side, where they exist.
        let known = (out + 1).min(5) as usize;
        let recent = &self.output.recent[5 - known..];
        for back in [2, 1] {
            let i = out - back;
            if i >= 0 {
                let down = self.at(i).down;
                let knot = Knot::of(recent, known - 1 - back as usize, H, down);
                let n = self.output.knots.len() as i64;
                self.output.knots[i.rem_euclid(n) as usize] = knot;
            }
        }
    }

    /// The motion at time `t`, clamped to the samples that were output and are still held.
    pub fn sample(&self, t: StreamTime) -> Target {
        if self.count == 0 {
            return Target::still(Posture::default());
        }
        if self.output.last < 0 {
            return Target::still(self.at(0).raw);
        }
        if t.0 < 0.0 {
            return Target::still(self.sample(StreamTime(0.0)).posture);
        }
        let n = self.output.knots.len() as i64;
        // The newest two have no rates of their own yet.
        let last = (self.output.last - 2).max(0) as f64;
        let first = (self.output.last - n + 1).max(0) as f64;
        let x = (t.0 * RATE).clamp(first, last.max(first));
        let i = (x as i64).min((last as i64 - 1).max(0));
        let knot = |i: i64| &self.output.knots[i.rem_euclid(n) as usize];
        between(knot(i), knot(i + 1), H, (x - i as f64).clamp(0.0, 1.0))
    }

    /// Centroidal angular momentum of the recording at time `t`, also for samples not output yet, N·m·s, axes of the
    /// stream; `None` where that is not known. A recorded body keeps it in flight, however its legs are changed.
    pub fn spin_at(&self, t: StreamTime) -> Option<Vec3> {
        let i = (t.0 * RATE).round() as i64;
        let newest = self.count - stream::SMOOTH - 2;
        let held = self.count - self.ring.len() as i64;
        (i > held.max(0) && i <= newest).then(|| self.at(i).momentum)
    }

    /// Time up to which touch-downs are seen.
    pub fn seen(&self) -> StreamTime {
        StreamTime((self.count - stream::SMOOTH - 2).max(0) as f64 * H)
    }

    /// Latest time that can be sampled.
    pub fn ready(&self) -> StreamTime {
        StreamTime((self.output.last - 2).max(0) as f64 * H)
    }

    /// Stances of a foot (0 left, 1 right) that are known, oldest first; times in samples.
    pub fn stances(&self, side: usize) -> impl Iterator<Item = &Stance> {
        self.feet[side].stances()
    }

    /// The motion from time `from` on as far as it has been received, with its feet: first the samples that were
    /// output, then those still in the window as received, joined smoothly. Samples are 1/[`RATE`] s apart; the time of
    /// the first one is returned with them. `came`: number of received samples, if the motion has been prepared beyond
    /// them.
    pub fn known(&self, from: StreamTime, came: i64) -> (StreamTime, Vec<(Posture, [bool; 2])>) {
        let n = self.output.knots.len() as i64;
        let last = self.count.min(came) - 1;
        let held = (self.output.last - n + 1).max(0);
        let done = (self.output.last - 2).min(last).max(held);
        let first = ((from.0 * RATE) as i64).clamp(held, done);
        let mut all: Vec<(Posture, [bool; 2])> = (first..=done)
            .map(|i| {
                let knot = &self.output.knots[i.rem_euclid(n) as usize];
                (knot.posture, knot.planted)
            })
            .collect();
        let Some(&(end, _)) = all.last() else {
            return (StreamTime(0.0), all);
        };
        let moved = self.at(done).raw.difference(&end);
        let (labelled, seen) = (last - LABEL, last - stream::SMOOTH - 1);
        for i in done + 1..=last {
            let mut p = self.at(i).raw;
            p.integrate(&moved, 1.0);
            let down = std::array::from_fn(|s| match i {
                i if i <= labelled => self.feet[s].is_down(i),
                i => self.feet[s].touches(i.min(seen)),
            });
            all.push((p, down));
        }
        (StreamTime(first as f64 * H), all)
    }
}

#[cfg(test)]
mod tests;
