//! Desired motion of one figure between its arrival and its use.
//!
//! Frames carry the time at which they were captured. The buffer plays them at that pace, a playout delay behind their
//! arrival, so that the jitter of the network does not become jitter of the motion. For a given instant it answers with
//! a frame, an interpolation between two frames, an extrapolation beyond the newest (fading out), the last posture, or
//! quiet standing; each case is counted.
//!
//! [`Playout`] decides which source time is due. A stream restarts if its clock starts again, or if it is too far
//! behind.

pub use super::playout::Now;
use super::playout::{Playout, PlayoutDue as Pace, is_time};
use super::time::{PlayoutTime, ScheduledTime, SourceTime};
pub use seam::StreamSeam;
use serde::{Deserialize, Serialize};
use sinew_physics::body::{Body, NV, Posture};
use sinew_physics::math::Quat;
use sinew_physics::motion::{Target, TargetPair};
use sinew_physics::plan::contact_labels::planted_between;
use sinew_physics::plan::stream::is_same;
use sinew_physics::time::WorldTime;
use sinew_wire::types::{Delay, DriveSettings, Supply};
use std::cell::Cell;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Instant;

/// Most frames that are held: over four seconds at 120 Hz.
pub const CAPACITY: usize = 512;
/// Time over which a jump of the desired motion is spread, s.
const BLEND: f64 = 0.3;
/// Time in which a figure relaxes into quiet standing, s.
const RELAX: f64 = 2.0;
/// Frames in a row that are older than the newest one, yet in order among themselves, after which the driver's clock is
/// taken to have started again, and the time over which they arrive, s.
const RESTART_FRAMES: u32 = 3;
const RESTART_TIME: f64 = 0.25;
/// Source time between two frames, with no such time passing here, that shows that the driver's clock was set, s.
const CLOCK_LEAP: f64 = 10.0;
/// Times closer than this are the same, s.
const SAME: f64 = 1e-6;
/// Reach to either side of the slope that replaces a velocity that was not sent, s.
const SLOPE: f64 = 0.04;
/// Jump of a joint or the pelvis beyond which the motion is blended, rad or m.
const JUMP: f64 = 0.02;

/// A frame as it is held.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BufferedFrame {
    /// Sequence.
    pub sequence: i64,
    /// When it was captured.
    pub source: SourceTime,
    /// Desired posture.
    pub posture: Posture,
    /// Desired velocity.
    #[serde(with = "crate::ingest::saved::optional_array")]
    pub velocity: Option<Box<[f64; NV]>>,
    /// Planted feet, if the driver named them.
    pub planted: Option<[bool; 2]>,
    /// Planted feet guessed when the frame comes into use: guessing takes kinematics, and most frames of a driver that
    /// sends too many are never used.
    pub guess: Cell<Option<[bool; 2]>>,
    /// When it came.
    #[serde(skip, default = "Instant::now")]
    pub arrival: Instant,
}

/// The motion that is in use now.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Applied {
    sequence: i64,
    source: SourceTime,
    #[serde(skip, default = "Instant::now")]
    arrival: Instant,
    /// Whether a published frame of the world has shown it.
    shown: bool,
}

impl Applied {
    fn new(frame: &BufferedFrame) -> Self {
        Self {
            sequence: frame.sequence,
            source: frame.source,
            arrival: frame.arrival,
            shown: false,
        }
    }
}

/// Counters of one buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Ticks by the kind of answer: present, interpolated, extrapolated, held, relaxed.
    pub ticks: [u64; 5],
    /// Frames that came too late to be interpolated to.
    pub late: u64,
    /// Frames not newer than the newest one held.
    pub stale: u64,
    /// Frames dropped for want of room.
    pub overflow: u64,
    /// Times that the stream restarted.
    pub resyncs: u64,
}

/// Why a stream restarted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Resync {
    /// Sequence or source time started again.
    Clock,
    /// It was too far behind, because its world skips ticks.
    Behind,
    /// It began in motion and fell silent before enough of it had arrived to lead its figure into it by steps.
    TooShort,
    /// It began in motion, and no moment of its beginning is within reach of the figure's steps.
    OutOfReach,
}

impl Resync {
    /// In words.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Clock => "its sequence or clock started again",
            Self::Behind => "its world leaves ticks out, it was too far behind",
            Self::TooShort => {
                "it began in motion and ended before steps could lead its figure into it; it was not played"
            }
            Self::OutOfReach => {
                "it began in motion, and no steps lead its figure into its beginning; that was left out"
            }
        }
    }
}

/// Restarts of a stream.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Anew {
    /// Frames that may be the beginning of a restart.
    restart: Option<Restart>,
    /// There was a restart that a window does not know of yet.
    broken: bool,
    /// There was a restart that has not been reported yet.
    notice: Option<Resync>,
}

/// The samples given to a window.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Grid {
    /// Newest time.
    head: Option<PlayoutTime>,
    /// The next sample of the grid.
    next: i64,
    /// Whether it continues from another stream, which supplied everything due before now.
    joins: bool,
    /// Frames that the window holds, with their playout times.
    held: VecDeque<(PlayoutTime, Applied)>,
}

/// Frames that may be the first of a clock that started again.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Restart {
    sequence: i64,
    source: SourceTime,
    since: ScheduledTime,
    frames: u32,
}

/// The buffer.
#[derive(Debug, Serialize, Deserialize)]
pub struct JitterBuffer {
    settings: DriveSettings,
    tick: f64,
    frames: VecDeque<BufferedFrame>,
    pace: Playout,
    anew: Anew,
    supply: Supply,
    counts: Counts,
    applied: Option<Applied>,
    /// The target at the end of the last tick.
    last: Target,
    /// Difference that bridges a jump of the desired motion, and when it began to fade.
    #[serde(with = "crate::ingest::saved::timed_array")]
    blend: Option<(Box<[f64; NV]>, WorldTime)>,
    /// Time over which it fades, s.
    blend_time: f64,
    /// Quiet standing.
    stand: Posture,
    #[serde(with = "sinew_physics::saved::definition")]
    body: Arc<Body>,
    grid: Grid,
}

/// The sample that a window is given for one point of its grid.
#[derive(Clone, Copy, Debug)]
pub enum DueSample<'a> {
    /// Posture, and planted feet if the driver named them.
    Sample(&'a Posture, Option<[bool; 2]>),
    /// The same, guessed beyond the newest frame.
    Guess(&'a Posture, Option<[bool; 2]>),
    /// No frame has arrived for too long, so guessing is impossible.
    Silence,
}

/// How far a window has been fed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridEnd {
    /// Time of the newest sample that is due.
    pub head: PlayoutTime,
    /// Number of samples of the grid that are past.
    pub next: i64,
}

/// The time of sample `i` of a grid of `rate` per second.
fn grid_time(i: i64, rate: f64) -> PlayoutTime {
    PlayoutTime(i as f64 / rate)
}

/// Largest relative difference between the speed of a window's time and that of the world's while delays change; if
/// they change by more than the following time, s, the window's time jumps.
const SLEW: f64 = 0.1;
const LEAP: f64 = 0.5;

/// How a frame relates to those before it.
#[derive(Clone, Copy, PartialEq)]
enum Order {
    Next,
    Anew,
    Stale,
}

/// The position of an instant among the frames.
#[derive(Clone, Copy)]
struct FrameSpan {
    supply: Supply,
    /// Frame at or before it.
    frame: usize,
    /// Time since that frame, s.
    since: f64,
}

/// Velocities of two neighbouring frames, cached: if a tick is as long as a frame, its two curves share a frame.
#[derive(Default)]
struct Velocities([Option<(usize, [f64; NV])>; 2]);

impl Velocities {
    fn of(&mut self, buffer: &JitterBuffer, i: usize) -> [f64; NV] {
        let held = &mut self.0[i % 2];
        match held {
            Some((known, v)) if *known == i => *v,
            _ => held.insert((i, buffer.velocity(i))).1,
        }
    }
}

/// The desired motion at one instant.
struct MotionAnswer {
    /// Everything except the planted feet.
    target: Target,
    supply: Supply,
    /// Frame at or before that instant.
    frame: usize,
    /// Frame whose planted feet count; `None`: both feet are planted.
    feet: Option<usize>,
}

/// Position on a curve in the tangent space of `base`: value, first and second derivative.
fn on_curve(base: &Posture, x: &[f64; NV], v: [f64; NV], a: [f64; NV]) -> Target {
    let mut posture = *base;
    posture.integrate(x, 1.0);
    Target {
        posture,
        velocity: v,
        acceleration: a,
        planted: [true; 2],
    }
}

impl JitterBuffer {
    /// An empty buffer for ticks of `tick` seconds of a figure with this body. `now` is the present desired motion of
    /// the figure, `stand` its quiet standing posture.
    pub fn new(
        settings: DriveSettings,
        tick: f64,
        body: Arc<Body>,
        now: Target,
        stand: Posture,
    ) -> Self {
        Self {
            settings,
            tick,
            frames: VecDeque::new(),
            pace: Playout::default(),
            anew: Anew::default(),
            supply: Supply::None,
            counts: Counts::default(),
            applied: None,
            last: now,
            blend: None,
            blend_time: BLEND,
            stand,
            body,
            grid: Grid::default(),
        }
    }

    /// Completes a buffer that was read. Returns whether a checkpoint could hold it, for a figure with this body in a
    /// world with ticks of `tick` seconds.
    pub fn complete(&mut self, body: &Arc<Body>, tick: f64) -> bool {
        let is_unit = |p: &Posture| {
            let turns = p.ball.iter().chain([&p.root_rotation]);
            let square = |q: &Quat| q.to_xyzw().iter().map(|c| c * c).sum::<f64>();
            p.is_finite() && turns.map(square).all(|n| (0.998..1.002).contains(&n))
        };
        let grows =
            |a: &BufferedFrame, b: &BufferedFrame| a.sequence < b.sequence && a.source < b.source;
        let frames = &self.frames;
        let mut pairs = frames.iter().zip(frames.iter().skip(1));
        let postures = frames.iter().map(|f| &f.posture);
        let settings = &self.settings;
        let delay = match settings.delay {
            Delay::Fixed(d) | Delay::Adaptive { most: d } => d,
        };
        let times = [
            delay,
            settings.extrapolation,
            settings.hold,
            settings.grace,
            self.blend_time,
        ];
        let is_whole = frames.len() <= CAPACITY
            && self.grid.held.len() <= CAPACITY
            && pairs.all(|(a, b)| grows(a, b))
            && postures
                .chain([&self.last.posture, &self.stand])
                .all(is_unit)
            && times.iter().all(|t| (0.0..=1e6).contains(t))
            && (1.0..=1e4).contains(&settings.rate_hz)
            && self.tick == tick
            && self.grid.head.is_none_or(|head| is_time(head.0))
            && self.blend.as_ref().is_none_or(|b| is_time(b.1.0))
            && self.grid.next.unsigned_abs() < 1 << 53
            && self.pace.is_valid();
        if is_whole {
            self.body = Arc::clone(body);
        }
        is_whole
    }

    /// Newest desired posture, for frames that leave the pelvis unchanged.
    pub fn newest_posture(&self) -> &Posture {
        self.frames
            .back()
            .map_or(&self.last.posture, |f| &f.posture)
    }

    /// Counters.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// How the last tick was answered.
    pub fn supply(&self) -> Supply {
        self.supply
    }

    /// Sequence and source time of the frame in use.
    pub fn applied(&self) -> Option<(i64, SourceTime)> {
        self.applied.map(|a| (a.sequence, a.source))
    }

    /// Arrival time of the frame in use, once for each frame: the world has published its effect.
    pub fn take_shown(&mut self) -> Option<Instant> {
        let applied = self.applied.as_mut().filter(|a| !a.shown)?;
        applied.shown = true;
        Some(applied.arrival)
    }

    /// Notes which frame is in use.
    fn apply(&mut self, new: Applied) {
        let same = |a: Applied| (a.sequence, a.source) == (new.sequence, new.source);
        if !self.applied.is_some_and(same) {
            self.applied = Some(new);
        }
    }

    /// p99 of the arrival jitter up to the last tick, s.
    pub fn jitter(&self) -> f64 {
        self.pace.jitter()
    }

    /// Delay between arrival and use, s.
    pub fn delay(&self) -> f64 {
        self.pace.delay(&self.settings)
    }

    /// World time that the clock had skipped by the last tick, s; `None`: nothing was played yet.
    pub fn lost(&self) -> Option<f64> {
        self.pace.lost()
    }

    /// How long its driver may be absent, s.
    pub fn grace(&self) -> f64 {
        self.settings.grace
    }

    /// How far the stream is behind because its world skips ticks, s; contained in the delay.
    pub fn behind(&self) -> f64 {
        self.pace.behind()
    }

    /// Has its driver told why the stream, or its beginning, was not played.
    pub fn note(&mut self, why: Resync) {
        self.anew.notice = Some(why);
    }

    /// Why the stream restarted since the last call, if it did.
    pub fn take_notice(&mut self) -> Option<Resync> {
        self.anew.notice.take()
    }

    /// Whether the stream restarted since the last call: a window holds earlier samples.
    pub fn take_break(&mut self) -> bool {
        std::mem::take(&mut self.anew.broken)
    }

    /// Duration of the motion that is held but not used yet, s.
    pub fn buffered(&self) -> f64 {
        match (self.frames.back(), self.pace.played.is_finite()) {
            (Some(f), true) => (self.time_of(f) - self.pace.played).max(0.0),
            (Some(f), false) => {
                let first = self.frames.front().map(|f| self.time_of(f));
                self.time_of(f) - first.unwrap_or_default()
            }
            _ => 0.0,
        }
    }

    fn time_of(&self, f: &BufferedFrame) -> PlayoutTime {
        self.pace.playout_time(f.source)
    }

    /// Takes a frame that arrived `now`. Frames whose sequence or source time does not grow are
    /// dropped and counted, until it is clear that the driver's clock has started again. Returns whether this frame is
    /// the first one after a restart.
    pub fn push(&mut self, frame: BufferedFrame, now: ScheduledTime) -> bool {
        let order = self.order(&frame, now);
        match order {
            Order::Next => {}
            Order::Anew => self.resync(Resync::Clock),
            Order::Stale => {
                self.counts.stale += 1;
                return false;
            }
        }
        self.anew.restart = None;
        if self.frames.len() == CAPACITY {
            // The buffer is fed faster than it is played: the oldest unplayed frame matters least for where the motion
            // is heading.
            self.frames.pop_front();
            self.counts.overflow += 1;
        }
        let at = self.pace.arrive(frame.source, now);
        if at < self.pace.played {
            self.counts.late += 1;
        }
        self.frames.push_back(frame);
        order == Order::Anew
    }

    fn order(&mut self, frame: &BufferedFrame, now: ScheduledTime) -> Order {
        let Some(last) = self.frames.back() else {
            return Order::Next;
        };
        if frame.sequence > last.sequence && frame.source > last.source {
            let passed = frame.source.since(last.source);
            let set = passed > CLOCK_LEAP && passed > 2.0 * self.pace.since_arrival(now);
            return if set { Order::Anew } else { Order::Next };
        }
        if self.restarts(frame, now) {
            Order::Anew
        } else {
            Order::Stale
        }
    }

    /// Whether a frame older than the newest one shows that the driver's clock has started again.
    fn restarts(&mut self, frame: &BufferedFrame, now: ScheduledTime) -> bool {
        let (sequence, source) = (frame.sequence, frame.source);
        let (since, frames) = match self.anew.restart {
            Some(r) if sequence > r.sequence && source > r.source => (r.since, r.frames + 1),
            _ => (now, 1),
        };
        self.anew.restart = Some(Restart {
            sequence,
            source,
            since,
            frames,
        });
        frames >= RESTART_FRAMES && now - since >= RESTART_TIME
    }

    /// Restarts: the next frame is the first one again, and the figure waits for it in the posture it has.
    fn resync(&mut self, why: Resync) {
        self.frames.clear();
        self.pace = Playout::default();
        self.grid = Grid::default();
        self.counts.resyncs += 1;
        self.anew = Anew {
            restart: None,
            broken: true,
            notice: Some(why),
        };
    }

    /// Feet that a frame plants: as the driver says, or guessed from the frame before.
    fn planted(&self, i: usize) -> [bool; 2] {
        let frame = &self.frames[i];
        if let Some(known) = frame.planted.or(frame.guess.get()) {
            return known;
        }
        let (before, dt) = match i.checked_sub(1).map(|b| &self.frames[b]) {
            Some(b) => (
                &b.posture,
                (frame.source.0 as f64 - b.source.0 as f64) * 1e-9,
            ),
            None => (&frame.posture, 1.0),
        };
        let guess = planted_between(&self.body, before, &frame.posture, dt);
        frame.guess.set(Some(guess));
        guess
    }

    /// Playout time in the tick that begins `now`.
    fn playout(&mut self, now: Now) -> Option<PlayoutTime> {
        match self.pace.advance(now, self.tick, &self.settings) {
            Pace::At(p) => Some(p),
            Pace::Nothing => None,
            Pace::TooFarBehind => {
                self.resync(Resync::Behind);
                None
            }
        }
    }

    fn velocity(&self, i: usize) -> [f64; NV] {
        if let Some(v) = &self.frames[i].velocity {
            return **v;
        }
        // Least-squares slope through the neighbours within SLOPE, at least the adjacent ones.
        let t0 = self.time_of(&self.frames[i]);
        let mut lo = i.saturating_sub(1);
        let mut hi = (i + 1).min(self.frames.len() - 1);
        while lo > 0 && t0 - self.time_of(&self.frames[lo - 1]) <= SLOPE {
            lo -= 1;
        }
        while hi + 1 < self.frames.len() && self.time_of(&self.frames[hi + 1]) - t0 <= SLOPE {
            hi += 1;
        }
        let n = (hi - lo + 1) as f64;
        let mean = (lo..=hi)
            .map(|k| self.time_of(&self.frames[k]) - t0)
            .sum::<f64>()
            / n;
        let mut v = [0.0; NV];
        let mut square = 0.0;
        for k in lo..=hi {
            let dt = self.time_of(&self.frames[k]) - t0 - mean;
            square += dt * dt;
            let x = self.frames[i].posture.difference(&self.frames[k].posture);
            for (v, x) in v.iter_mut().zip(x) {
                *v += dt * x;
            }
        }
        if square > 0.0 {
            for v in &mut v {
                *v = (*v / square).clamp(-1000.0, 1000.0);
            }
        }
        v
    }

    /// The answer for playout time `p`.
    fn find(&self, p: PlayoutTime) -> FrameSpan {
        let after = self.frames.partition_point(|f| self.time_of(f) <= p + SAME);
        let Some(i) = after.checked_sub(1) else {
            return FrameSpan {
                supply: Supply::Waiting,
                frame: 0,
                since: 0.0,
            };
        };
        let since = (p - self.time_of(&self.frames[i])).max(0.0);
        let limit = self.settings.extrapolation;
        let supply = if since <= SAME {
            Supply::Present
        } else if after < self.frames.len() {
            Supply::Interpolated
        } else if since < limit {
            Supply::Extrapolated
        } else if since - limit - self.settings.hold <= 0.0 {
            Supply::Held
        } else {
            Supply::Relaxed
        };
        FrameSpan {
            supply,
            frame: i,
            since,
        }
    }

    /// The desired motion at playout time `p`.
    fn at(&self, p: PlayoutTime) -> MotionAnswer {
        self.at_with(p, &mut Velocities::default())
    }

    /// The same, reusing velocities that are known already.
    fn at_with(&self, p: PlayoutTime, velocities: &mut Velocities) -> MotionAnswer {
        let FrameSpan {
            supply,
            frame: i,
            since,
        } = self.find(p);
        let answer = |target, feet| MotionAnswer {
            target,
            supply,
            frame: i,
            feet,
        };
        if supply == Supply::Waiting {
            return answer(Target::still(self.last.posture), None);
        }
        let from = &self.frames[i];
        let v0 = velocities.of(self, i);
        if let Some(to) = self.frames.get(i + 1) {
            // Cubic Hermite curve in the tangent space of the frame before.
            let h = self.time_of(to) - self.time_of(from);
            let u = (since / h).clamp(0.0, 1.0);
            let d = from.posture.difference(&to.posture);
            let v1 = velocities.of(self, i + 1);
            let measured = from.velocity.is_some() && to.velocity.is_some();
            let mut x = [0.0; NV];
            let mut v = [0.0; NV];
            let mut a = [0.0; NV];
            for k in 0..NV {
                let (m0, m1) = (v0[k] * h, v1[k] * h);
                let c3 = m0 + m1 - 2.0 * d[k];
                let c2 = 3.0 * d[k] - 2.0 * m0 - m1;
                x[k] = u * (m0 + u * (c2 + u * c3));
                v[k] = (m0 + u * (2.0 * c2 + 3.0 * u * c3)) / h;
                // Slopes that replace velocities are slightly wrong, equally at both ends. The curve would turn that
                // into accelerations six times as wrong per frame time; their difference does not.
                a[k] = if measured {
                    (2.0 * c2 + 6.0 * u * c3) / (h * h)
                } else {
                    (v1[k] - v0[k]) / h
                };
            }
            let feet = if u < 0.5 { i } else { i + 1 };
            return answer(on_curve(&from.posture, &x, v, a), Some(feet));
        }
        let limit = self.settings.extrapolation;
        if supply == Supply::Present {
            let still = [0.0; NV];
            return answer(on_curve(&from.posture, &still, v0, still), Some(i));
        }
        // The last velocity fades out linearly over the limit.
        let u = since.min(limit);
        let x = if limit > 0.0 {
            v0.map(|v| v * (u - u * u / (2.0 * limit)))
        } else {
            [0.0; NV]
        };
        if supply == Supply::Extrapolated {
            let v = v0.map(|v| v * (1.0 - u / limit));
            let a = v0.map(|v| -v / limit);
            return answer(on_curve(&from.posture, &x, v, a), Some(i));
        }
        let held = on_curve(&from.posture, &x, [0.0; NV], [0.0; NV]);
        if supply == Supply::Held {
            return answer(held, Some(i));
        }
        let over = since - limit - self.settings.hold;
        let d = held.posture.difference(&self.standing(&held.posture));
        let u = (over / RELAX).min(1.0);
        let s = u * u * (3.0 - 2.0 * u);
        let moving = if u < 1.0 { 1.0 / RELAX } else { 0.0 };
        let (s1, s2) = (
            6.0 * u * (1.0 - u) * moving,
            (6.0 - 12.0 * u) * moving * moving,
        );
        answer(
            on_curve(
                &held.posture,
                &d.map(|d| d * s),
                d.map(|d| d * s1),
                d.map(|d| d * s2),
            ),
            None,
        )
    }

    /// As [`JitterBuffer::at_with`], with planted feet.
    fn target(&self, p: PlayoutTime, velocities: &mut Velocities) -> MotionAnswer {
        let mut answer = self.at_with(p, velocities);
        answer.target.planted = answer.feet.map_or([true; 2], |i| self.planted(i));
        answer
    }

    /// Quiet standing at the place of the held posture's pelvis.
    fn standing(&self, held: &Posture) -> Posture {
        use sinew_physics::math::{Quat, Vec3};
        let mut p = self.stand;
        p.root_position.x = held.root_position.x;
        p.root_position.y = held.root_position.y;
        p.root_rotation = Quat::from_axis_angle(Vec3::Z, held.root_rotation.heading());
        p
    }

    /// The desired motion over the tick that begins at `at`. `None` while nothing was pushed or the first frame is
    /// still to come: until then the previous desired motion continues.
    pub fn sample(&mut self, at: Now) -> Option<Box<TargetPair>> {
        let Some(p) = self.playout(at) else {
            return self.wait();
        };
        let t = at.time;
        let found = self.find(p);
        self.supply = found.supply;
        let began = self.applied.is_none();
        match found.supply {
            Supply::Waiting | Supply::None => return self.wait(),
            Supply::Present => self.counts.ticks[0] += 1,
            Supply::Interpolated => self.counts.ticks[1] += 1,
            Supply::Extrapolated => self.counts.ticks[2] += 1,
            Supply::Held => self.counts.ticks[3] += 1,
            Supply::Relaxed => self.counts.ticks[4] += 1,
        }
        self.pace.played = p;
        self.apply(Applied::new(&self.frames[found.frame]));
        let mut velocities = Velocities::default();
        let now = self.target(p, &mut velocities).target;
        let next = self.target(p + self.tick, &mut velocities).target;
        let mut pair = Box::new(TargetPair { now, next });
        let TargetPair { now, next } = &mut *pair;
        // A jump, at the start or after a gap, is spread over time. A jump expected from the last velocity is not one.
        if self.blend.is_none() && !(began && self.settings.reset) {
            let jump = now.posture.difference(&self.last.posture);
            let beyond =
                |(k, e): (usize, &f64)| e.abs() > JUMP + self.last.velocity[k].abs() * self.tick;
            if jump.iter().enumerate().any(beyond) {
                self.blend = Some((Box::new(jump), t));
            }
        }
        if let Some((jump, since)) = &self.blend {
            let since = *since;
            let fade = |target: &mut Target, t: WorldTime| {
                let over = self.blend_time;
                let u = ((t - since) / over).clamp(0.0, 1.0);
                // 1 at the start, 0 at the end, flat at both.
                let s = 1.0 - u * u * (3.0 - 2.0 * u);
                let moving = if u < 1.0 { 1.0 / over } else { 0.0 };
                let s1 = -6.0 * u * (1.0 - u) * moving;
                let s2 = -(6.0 - 12.0 * u) * moving * moving;
                target.posture.integrate(&jump.map(|e| e * s), 1.0);
                for k in 0..NV {
                    target.velocity[k] += jump[k] * s1;
                    target.acceleration[k] += jump[k] * s2;
                }
            };
            fade(now, t);
            fade(next, t + self.tick);
            if t - since >= self.blend_time {
                self.blend = None;
                self.blend_time = BLEND;
            }
        }
        self.last.clone_from(next);
        // Frames before the one in use serve only as neighbours of its velocity.
        while self.frames.len() > 2 && self.time_of(&self.frames[1]) < p - 2.0 * SLOPE {
            self.frames.pop_front();
        }
        Some(pair)
    }

    /// The target before the first frame: none, or the last posture if the stream is restarting.
    fn wait(&mut self) -> Option<Box<TargetPair>> {
        self.applied?;
        self.supply = Supply::Held;
        self.counts.ticks[3] += 1;
        let still = Target::still(self.last.posture);
        self.last = still.clone();
        Some(Box::new(TargetPair {
            now: still.clone(),
            next: still,
        }))
    }

    /// Whether there is motion that was not handed to a window yet. A driver that repeats the same posture does not
    /// move.
    pub fn has_news(&self) -> bool {
        let (Some(newest), Some(head)) = (self.frames.back(), self.grid.head) else {
            return false;
        };
        self.time_of(newest) > head && !is_same(&self.at(head).target.posture, &newest.posture)
    }

    /// Hands the samples of a grid of `rate` per second, up to those due in the tick that begins `now`, to a window
    /// that lies `window` seconds behind them. `None` while there is no motion.
    pub fn feed(
        &mut self,
        now: Now,
        (rate, window): (f64, f64),
        mut give: impl FnMut(DueSample<'_>),
    ) -> Option<GridEnd> {
        let p = self.playout(now)?;
        let p = match self.grid.head {
            Some(head) if (p - head).abs() < LEAP => {
                let [least, most] = [1.0 - SLEW, 1.0 + SLEW].map(|speed| head + speed * self.tick);
                PlayoutTime(p.0.clamp(least.0, most.0))
            }
            _ => p,
        };
        if p.0 < -self.tick {
            self.supply = Supply::Waiting;
            return None;
        }
        self.grid.head = Some(p);
        self.supply = self.find(p.max(PlayoutTime(0.0))).supply;
        let k = match self.supply {
            Supply::Present => 0,
            Supply::Interpolated => 1,
            Supply::Extrapolated => 2,
            Supply::Held => 3,
            Supply::Relaxed => 4,
            Supply::Waiting | Supply::None => return None,
        };
        self.counts.ticks[k] += 1;
        let last = ((p + self.tick).0 * rate + SAME).floor() as i64;
        // A leap in time, or a silence, is not made up for sample by sample.
        if std::mem::take(&mut self.grid.joins) {
            self.grid.next = last;
        }
        let first = self.grid.next.max(last.saturating_sub(CAPACITY as i64));
        let mut velocities = Velocities::default();
        for g in first..=last {
            let answer = self.at_with(grid_time(g, rate), &mut velocities);
            match answer.supply {
                Supply::Present | Supply::Interpolated | Supply::Extrapolated => {
                    let frame = &self.frames[answer.frame];
                    // A window finds planted feet itself if the driver does not name them.
                    let planted = frame.planted.and(answer.feet).map(|i| self.planted(i));
                    let posture = &answer.target.posture;
                    give(match answer.supply {
                        Supply::Extrapolated => DueSample::Guess(posture, planted),
                        _ => DueSample::Sample(posture, planted),
                    });
                    let known =
                        (self.grid.held.back()).is_none_or(|h| h.1.sequence < frame.sequence);
                    if known {
                        if self.grid.held.len() == CAPACITY {
                            self.grid.held.pop_front();
                        }
                        let entry = (self.time_of(frame), Applied::new(frame));
                        self.grid.held.push_back(entry);
                    }
                }
                _ => give(DueSample::Silence),
            }
        }
        self.grid.next = last + 1;
        self.pace.played = p;
        // The motion in use now arrived a window ago.
        while let Some(&(at, entry)) = self.grid.held.front()
            && at <= p - window + SAME
        {
            self.apply(entry);
            self.grid.held.pop_front();
        }
        while self.frames.len() > 2 && self.time_of(&self.frames[1]) < p - 2.0 * SLOPE {
            self.frames.pop_front();
        }
        let next = self.grid.next;
        Some(GridEnd { head: p, next })
    }

    /// Playout time of the tick that begins `now`, if there is motion for it.
    pub fn due(&mut self, now: Now) -> Option<PlayoutTime> {
        let p = self.playout(now)?;
        // At least two frames, so that its velocity is known, and none that would have to be guessed.
        let newest = self.time_of(self.frames.back()?);
        (p.0 >= 0.0 && self.frames.len() >= 2 && newest >= p + self.tick).then_some(p)
    }

    /// Begins from the present desired motion of the figure, and changes to its own motion within `blend` seconds.
    pub fn begin_from(&mut self, target: Target, blend: f64) {
        self.last = target;
        self.blend_time = blend.max(self.tick);
        self.grid.joins = true;
    }

    /// True once, when the figure is to be put into its first desired posture.
    pub fn resets_now(&self) -> bool {
        self.settings.reset && self.counts.ticks.iter().sum::<u64>() == 1
    }
}

mod seam;
#[cfg(test)]
mod tests;
