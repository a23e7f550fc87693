//! Getting up (ALGORITHM §12): a figure that lies where its motion lay down gets up when the motion does, in its own
//! way.
//!
//! A recorded way up cannot be repeated as it is: it was made by another body, it leans on hands whose skin nobody
//! recorded, and often it leaps. So the motion says *when*; *how* is the figure's own ([`crate::sim::get_up`]), at the
//! pace at which it can follow.

use super::report::MAX_CONTACTS;
use super::tasks::TaskWorkspace;
use crate::sim::body::topology::SegmentId;
use crate::sim::body::{Body, Posture, SEGMENT_COUNT};
use crate::sim::control::{OnFloor, PointTarget};
use crate::sim::dynamics::Terms;
use crate::sim::get_up::GetUpMotion;
use crate::sim::math::{Quat, Vec3, trig};
use crate::sim::motion::TargetPair;

/// Most contact points of one segment.
const POINTS: usize = MAX_CONTACTS / SEGMENT_COUNT;
/// A motion lies below this share of the standing height (of its centre of mass); above it, it gets up.
const LOW: f64 = 0.45;
/// It lies whose trunk rises less than this, and lies still below this speed, m/s.
const LEVEL: f64 = 0.7;
const STILL: f64 = 0.3;
/// The way goes on at full pace below the first of both and waits at the second: rms of the joints, rad; turn of the
/// pelvis, rad; distance of the centre of mass over the floor, m.
const PACE: [(f64, f64); 3] = [(0.08, 0.2), (0.15, 0.4), (0.03, 0.08)];
/// The same without the centre of mass for who lies and has nothing to lose: he waits less, and not for ever.
const LYING_PACE: [(f64, f64); 2] = [(0.08, 0.2), (0.25, 0.6)];
const LEAST_PACE: f64 = 0.25;
/// A way that goes on slower than this for so long, s, leads nowhere.
const STALLED: (f64, f64) = (0.05, 3.0);
/// Attempts for one command.
const ATTEMPTS: u32 = 3;

/// What a fallen figure is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// Nothing.
    Lying,
    /// It gets up; the way has hardly gone on for so long, s.
    Rising(f64),
}

/// How a fallen figure gets up.
#[derive(Clone, Debug)]
pub(super) struct GetUp {
    ascent: Box<GetUpMotion>,
    phase: Phase,
    /// The motion has lain down since the figure fell; attempts that are left once it gets up.
    lay: bool,
    left: u32,
    /// The last tick's motion was not the commanded one.
    own: bool,
    /// Height of every contact point on the way, m.
    heights: Box<[f64; MAX_CONTACTS]>,
    /// Distance of the centre of mass from the way's over the floor, m.
    off: f64,
}

/// How much two rotations differ but for a turn about the vertical, rad.
fn tilt(a: Quat, b: Quat) -> f64 {
    let [x, y, z, w] = (a * b.conjugate()).to_xyzw();
    2.0 * trig::atan2((x * x + y * y).sqrt(), (z * z + w * w).sqrt())
}

/// Root mean square of the differences of the joints, rad.
fn unlike(a: &Posture, b: &Posture) -> f64 {
    let e = a.joint_difference(b);
    (e.iter().map(|e| e * e).sum::<f64>() / e.len() as f64).sqrt()
}

impl GetUp {
    /// Of a figure with this body, that stands like `at_ease` in the end. Allocates.
    pub fn new(body: &Body, at_ease: &Posture) -> Self {
        Self {
            ascent: Box::new(GetUpMotion::new(body, at_ease)),
            phase: Phase::Lying,
            lay: false,
            left: 0,
            own: false,
            heights: Box::new([0.0; MAX_CONTACTS]),
            off: 0.0,
        }
    }

    /// Forgets that anything was commanded.
    pub fn reset(&mut self) {
        self.phase = Phase::Lying;
        self.lay = false;
        self.left = 0;
    }

    /// True while the figure follows its way up.
    pub fn is_rising(&self) -> bool {
        matches!(self.phase, Phase::Rising(_))
    }

    /// True once it has gone its way to the end.
    pub fn is_up(&self) -> bool {
        self.is_rising() && self.ascent.is_over()
    }

    /// What it is about on its way.
    pub fn stage(&self) -> Option<&'static str> {
        self.is_rising().then(|| self.ascent.stage())
    }

    /// How it is meant to touch the floor, while it follows its way.
    pub fn on_floor(&self) -> Option<OnFloor<'_>> {
        self.is_rising().then_some(OnFloor {
            heights: &self.heights,
            lies: self.ascent.lies(),
            rolls: self.ascent.rolls(),
            slides: self.ascent.slides(),
        })
    }

    /// Judges a fallen figure in the state of `terms`, whose motion had its centre of mass at `height` (share of the
    /// standing one).
    pub fn watch(&mut self, terms: &Terms, height: f64) {
        match self.phase {
            Phase::Lying if self.own => self.own = false,
            Phase::Lying => {
                if height < LOW {
                    (self.lay, self.left) = (true, ATTEMPTS);
                } else if self.lay && self.left > 0 && lies(terms) {
                    self.left -= 1;
                    self.own = true;
                    self.off = 0.0;
                    self.ascent.begin(terms);
                    self.phase = Phase::Rising(0.0);
                }
            }
            Phase::Rising(stalled) if stalled.max(self.ascent.waits()) > STALLED.1 => {
                self.phase = Phase::Lying
            }
            Phase::Rising(_) => {}
        }
    }

    /// Desired motion of a tick of `dt` seconds, if it is the way's: at the pace at which the figure, in the state of
    /// `terms`, follows the last tick's `target`.
    pub fn targets(
        &mut self,
        body: &Body,
        terms: &Terms,
        target: &Posture,
        dt: f64,
    ) -> Option<TargetPair> {
        let Phase::Rising(stalled) = self.phase else {
            return None;
        };
        let state = &terms.state.posture;
        let turn = tilt(state.root_rotation, target.root_rotation);
        let keeping =
            |(full, none): (f64, f64), e: f64| ((none - e) / (none - full)).clamp(0.0, 1.0);
        let pace = if self.ascent.rolls() {
            1.0
        } else if self.ascent.lies() {
            (keeping(LYING_PACE[0], unlike(state, target)) * keeping(LYING_PACE[1], turn))
                .max(LEAST_PACE)
        } else {
            keeping(PACE[0], unlike(state, target))
                * keeping(PACE[1], turn)
                * keeping(PACE[2], self.off)
        };
        let stalled = if pace < STALLED.0 { stalled + dt } else { 0.0 };
        self.phase = Phase::Rising(stalled);
        Some(self.ascent.advance(body, terms, dt, pace))
    }

    /// Where the way has the contact points, with the target's kinematics in `tasks`.
    pub fn touch(
        &mut self,
        body: &Body,
        terms: &Terms,
        tasks: &TaskWorkspace,
        target: &TargetPair,
        com: &PointTarget,
    ) {
        let off = com.now - terms.com;
        self.off = (off.x * off.x + off.y * off.y).sqrt();
        self.heights.fill(f64::INFINITY);
        for s in SegmentId::all().filter(|s| self.ascent.carries(*s)) {
            let points = body.segment(s).contact_points.iter().take(POINTS);
            for (vertex, p) in points.enumerate() {
                self.heights[s.index() * POINTS + vertex] = tasks.desired_point(target, s, *p).z;
            }
        }
    }
}

/// True if it lies, and lies still.
fn lies(terms: &Terms) -> bool {
    let up = terms.state.posture.root_rotation.rotate(Vec3::Z);
    up.z.abs() < LEVEL && terms.com_velocity.norm() < STILL
}
