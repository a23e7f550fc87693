//! Getting up (ALGORITHM §12): a figure that lies where its motion lay down gets up when the motion does, in its own way.
//!
//! A recorded way up cannot be repeated as it is: it was made by another body, it leans on hands whose skin nobody recorded, and often it
//! leaps. So the motion says *when*; *how* is a plan of the figure's own ([`crate::sim::motion::builtin::rise`]) that can be followed at any pace.

use super::report::MAX_CONTACTS;
use super::tasks::TaskWorkspace;
use crate::sim::body::topology::{
    L_FOREARM, L_HAND, L_UPPER_ARM, NV, R_FOREARM, R_HAND, R_UPPER_ARM, SegmentId,
};
use crate::sim::body::{Body, Posture, SEGMENT_COUNT};
use crate::sim::control::PointTarget;
use crate::sim::dynamics::Terms;
use crate::sim::gait::anchor::Anchor;
use crate::sim::math::{Quat, Vec3, trig};
use crate::sim::motion::builtin::{Rise, rise};
use crate::sim::motion::{Clip, PlanarTransform, Target, TargetPair};
use std::sync::Arc;

/// Most contact points of one segment.
const POINTS: usize = MAX_CONTACTS / SEGMENT_COUNT;
/// A motion lies below this share of the standing height (of its centre of mass); above it, it gets up.
const LOW: f64 = 0.45;
/// A clip lies whose pelvis comes below this share of its standing height.
const LIES: f64 = 0.4;
/// A point lower than the first touches, and is meant to where the motion has it lower than the second, m.
const TOUCH: f64 = 0.01;
const MEANT: f64 = 0.02;
/// The chest looks down where its front points down by more than this.
const PRONE: f64 = 0.5;
/// Time in which the arms come out to the sides, and in which the hands come beside the chest, s: before the way itself begins.
const ARMS: (f64, f64) = (1.6, 1.6);
/// Until then arms and hands are not what carries: they slide.
const ARM_SEGMENTS: [SegmentId; 6] = [
    L_UPPER_ARM,
    L_FOREARM,
    L_HAND,
    R_UPPER_ARM,
    R_FOREARM,
    R_HAND,
];
/// The way goes on at full pace below the first of both and waits at the second: rms of the joints, rad; turn of the pelvis, rad; distance of the
/// centre of mass over the floor, m.
const PACE: [(f64, f64); 3] = [(0.08, 0.2), (0.15, 0.4), (0.03, 0.08)];
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
pub(super) struct Rising {
    /// The way up of its body, once a motion has lain down.
    way: Option<Arc<Rise>>,
    /// The present motion lies down.
    lies: bool,
    phase: Phase,
    /// The motion has lain down since the figure fell; attempts that are left once it gets up.
    lay: bool,
    left: u32,
    /// The last tick's motion was not the commanded one.
    own: bool,
    anchor: Anchor,
    /// World time minus time of the way, s; the arms are brought into place at negative times of the way.
    start: f64,
    /// How it lay, and when it began, world time, s.
    from: (Posture, f64),
    /// Height of every contact point on the way, m.
    heights: Box<[f64; MAX_CONTACTS]>,
    /// Distance of the centre of mass from the way's over the floor, m.
    off: f64,
}

impl Default for Rising {
    fn default() -> Self {
        Self {
            way: None,
            lies: false,
            phase: Phase::Lying,
            lay: false,
            left: 0,
            own: false,
            anchor: Anchor::default(),
            start: 0.0,
            from: (Posture::default(), 0.0),
            heights: Box::new([0.0; MAX_CONTACTS]),
            off: 0.0,
        }
    }
}

/// Turn about the vertical from `b` to `a`, and how much they differ otherwise, rad.
fn heading(a: Quat, b: Quat) -> (f64, f64) {
    let [x, y, z, w] = (a * b.conjugate()).to_xyzw();
    let yaw = 2.0 * trig::atan2(z, w);
    let tilt = 2.0 * trig::atan2((x * x + y * y).sqrt(), (z * z + w * w).sqrt());
    (yaw, tilt)
}

/// Root mean square of the differences of the joints, rad.
fn unlike(a: &Posture, b: &Posture) -> f64 {
    let e = a.joint_difference(b);
    (e.iter().map(|e| e * e).sum::<f64>() / e.len() as f64).sqrt()
}

impl Rising {
    /// True for a clip that lies down at some time, so that its figure may have to get up.
    pub fn lies(body: &Body, clip: &Clip) -> bool {
        let least = LIES * body.standing_root_height();
        clip.samples().any(|(p, _)| p.root_position.z < least)
    }

    /// Plans the way up of `body`, which is always the figure's, once: about 0.1 s, allocates.
    pub fn plan(&mut self, body: &Body) {
        self.way.get_or_insert_with(|| Arc::new(rise(body)));
    }

    /// Another motion, which `lies` down or does not: what was commanded before counts no more.
    pub fn follow(&mut self, lies: bool) {
        self.lies = lies;
        self.reset();
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

    /// Where the way lies, and the world time at which it began if it had gone on at its own pace, s.
    pub fn place(&self) -> (Anchor, f64) {
        (self.anchor, self.start)
    }

    /// The way that is followed.
    pub fn way(&self) -> Option<&Arc<Rise>> {
        self.way.as_ref()
    }

    /// Heights of the contact points as the way has them at the end of the tick, m, while it is followed.
    pub fn heights(&self) -> Option<&[f64; MAX_CONTACTS]> {
        self.is_rising().then_some(&self.heights)
    }

    /// Judges a fallen figure in `state` at world time `time`, s, whose motion had its centre of mass at `height` (share
    /// of the standing one).
    pub fn watch(&mut self, state: &Posture, height: f64, time: f64) {
        let Some(way) = self.way.as_ref().filter(|_| self.lies) else {
            return;
        };
        match self.phase {
            Phase::Lying if self.own => self.own = false,
            Phase::Lying => {
                if height < LOW {
                    (self.lay, self.left) = (true, ATTEMPTS);
                } else if self.lay && self.left > 0 && is_prone(state) {
                    self.left -= 1;
                    self.own = true;
                    let first = way.clip.sample(0.0).posture;
                    let yaw = heading(state.root_rotation, first.root_rotation).0;
                    self.anchor =
                        Anchor::between((first.root_position, 0.0), (state.root_position, yaw));
                    self.start = time + ARMS.0 + ARMS.1;
                    (self.from, self.off) = ((*state, time), 0.0);
                    self.phase = Phase::Rising(0.0);
                }
            }
            Phase::Rising(stalled) if stalled > STALLED.1 => self.phase = Phase::Lying,
            Phase::Rising(_) => {}
        }
    }

    /// Desired motion of a tick, if it is the way's: its first posture while the joints are led there, then the way at the pace at which the figure,
    /// in `state`, follows the last tick's `target`.
    pub fn targets(
        &mut self,
        (time, dt): (f64, f64),
        state: &Posture,
        target: &Posture,
    ) -> Option<TargetPair> {
        let way = self.way.as_ref()?;
        let Phase::Rising(stalled) = self.phase else {
            return None;
        };
        self.anchor.settle(dt);
        let place = self.anchor.transform();
        if time < self.start {
            return Some(self.bring_arms(way, place, (time, dt)));
        }
        let errors = [
            unlike(state, target),
            heading(state.root_rotation, target.root_rotation).1,
            self.off,
        ];
        let pace = errors
            .iter()
            .zip(PACE)
            .fold(1.0, |pace, (e, (full, none))| {
                pace * ((none - e) / (none - full)).clamp(0.0, 1.0)
            });
        let stalled = if pace < STALLED.0 { stalled + dt } else { 0.0 };
        self.phase = Phase::Rising(stalled);
        self.start += dt * (1.0 - pace);
        let sample = |t: f64| {
            let mut out = way.clip.sample(t);
            out.velocity = out.velocity.map(|v| pace * v);
            place.apply_to(&mut out);
            out
        };
        let next = time + dt - self.start;
        Some(TargetPair {
            now: sample(next - dt * pace),
            next: sample(next),
        })
    }

    /// The arms come out to the sides and then beside the chest, from how it lay.
    fn bring_arms(&self, way: &Rise, place: PlanarTransform, (time, dt): (f64, f64)) -> TargetPair {
        let placed = |posture: Posture| {
            let mut out = Target::still(posture);
            place.apply_to(&mut out);
            out.posture
        };
        let (lay, since) = self.from;
        let out = placed(way.arms_out);
        let beside = placed(way.clip.sample(0.0).posture);
        let sample = |t: f64| match t - since {
            t if t < ARMS.0 => passing(&lay, &out, t, ARMS.0),
            t => passing(&out, &beside, t - ARMS.0, ARMS.1),
        };
        TargetPair {
            now: sample(time),
            next: sample(time + dt),
        }
    }

    /// Where the way has the contact points, with the target's kinematics in `tasks`, and where the figure really touches: the way goes there.
    pub fn touch(
        &mut self,
        body: &Body,
        terms: &Terms,
        tasks: &TaskWorkspace,
        target: &TargetPair,
        (com, time): (&PointTarget, f64),
    ) {
        let off = com.now - terms.com;
        self.off = (off.x * off.x + off.y * off.y).sqrt();
        self.heights.fill(f64::INFINITY);
        let carries = time >= self.start;
        let (mut there, mut here, mut count) = (Vec3::zero(), Vec3::zero(), 0.0);
        for s in SegmentId::all() {
            if !carries && ARM_SEGMENTS.contains(&s) {
                continue;
            }
            let points = body.segment(s).contact_points.iter().take(POINTS);
            for (vertex, p) in points.enumerate() {
                let goal = tasks.desired_point(target, s, *p);
                self.heights[s.index() * POINTS + vertex] = goal.z;
                let real = terms.point_world(s.index(), *p);
                if real.z < TOUCH && goal.z < MEANT {
                    there += goal;
                    here += real;
                    count += 1.0;
                }
            }
        }
        // Until the way begins, only its end lies where the anchor has it.
        if carries && count > 0.0 {
            self.anchor.pin(there * (1.0 / count), here * (1.0 / count));
        }
    }
}

/// `t` seconds into the smooth passage from `a` to `b` that takes `whole`.
fn passing(a: &Posture, b: &Posture, t: f64, whole: f64) -> Target {
    let u = (t / whole).clamp(0.0, 1.0);
    let (share, rate) = (u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / whole);
    let way: [f64; NV] = a.difference(b);
    let mut out = Target::still(*a);
    out.posture.integrate(&way.map(|w| share * w), 1.0);
    out.velocity = way.map(|w| rate * w);
    out.planted = [false; 2];
    out
}

/// True if the pelvis looks down.
fn is_prone(posture: &Posture) -> bool {
    posture.root_rotation.rotate(Vec3::X).z < -PRONE
}
