//! Getting up: a figure that lies where its motion lay down gets up when the motion does.
//!
//! A recording of getting up cannot be repeated as it is. Another body made it, it leans on hands whose skin was not
//! recorded, and it often leaps. So the motion decides *when*. *How* is planned for the figure ([`crate::get_up`]), at
//! a pace that it can follow.

use crate::body::topology::SegmentId;
use crate::body::{Body, Posture};
use crate::control::{MEANT_BY_US, OnFloor};
use crate::dynamics::Terms;
use crate::figure::motion::tasks::TaskWorkspace;
use crate::figure::params::fall::FALLEN_HEIGHT;
use crate::figure::params::get_up::{
    ATTEMPTS, FULL_PACE_COM, FULL_PACE_JOINTS, FULL_PACE_LYING_TURN, FULL_PACE_TURN, LEAST_PACE,
    LEVEL, NO_PACE_COM, NO_PACE_JOINTS, NO_PACE_LYING_TURN, NO_PACE_TURN, STALLED_PACE,
    STALLED_TIME, STILL_SPEED,
};
use crate::get_up::{GetUpMotion, GetUpSolver};
use crate::math::{Quat, Vec3, trig};
use crate::motion::TargetPair;
use crate::report::{MAX_CONTACTS, POINTS_PER_SEGMENT};
use serde::{Deserialize, Serialize};

/// How a fallen figure gets up, and when.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct GetUp {
    motion: GetUpMotion,
    /// Whether the commanded motion has lain down since the figure fell.
    lay: bool,
    /// Attempts left once the commanded motion gets up.
    attempts: u32,
    /// Whether the last tick's motion was the figure's own, not the commanded one.
    own: bool,
    /// How long the motion has hardly progressed, s.
    stalled: f64,
    /// Horizontal distance between the centre of mass and the motion's, m.
    off: f64,
}

/// The next action of a fallen figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::figure) enum GetUpDecision {
    /// Continue as before.
    Continue,
    /// Begin to get up.
    Begin,
    /// Abandon it: there is no progress.
    GiveUp,
}

/// Difference of two rotations, leaving out turns about the vertical, rad.
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
    /// For a figure with this body.
    pub fn new(body: &Body) -> Self {
        Self {
            motion: GetUpMotion::new(body),
            lay: false,
            attempts: 0,
            own: false,
            stalled: 0.0,
            off: 0.0,
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        self.motion.is_valid()
    }

    /// Forgets that the commanded motion gets up.
    pub fn reset(&mut self) {
        self.lay = false;
        self.attempts = 0;
    }

    /// The motion works on the floor: a figure that does not get up with it gets up in its own way.
    pub fn note_low_motion(&mut self) {
        (self.lay, self.attempts) = (true, ATTEMPTS);
    }

    /// Whether the motion is over.
    pub fn is_over(&self) -> bool {
        self.motion.is_over()
    }

    /// Name of the stage.
    pub fn stage(&self) -> &'static str {
        self.motion.stage()
    }

    /// How the body should touch the floor.
    pub fn on_floor<'a>(&'a self, heights: &'a [f64; MAX_CONTACTS]) -> OnFloor<'a> {
        OnFloor {
            heights,
            meant: MEANT_BY_US,
            lies: self.motion.lies(),
            rolls: self.motion.rolls(),
            slides: self.motion.slides(),
        }
    }

    /// Decides about a fallen figure in the state of `terms`, whose motion has its centre of mass at `height` (share of
    /// the standing one). `gets_up`: whether the figure is getting up already.
    pub fn decide(
        &mut self,
        solver: &GetUpSolver,
        terms: &Terms,
        height: f64,
        gets_up: bool,
    ) -> GetUpDecision {
        if gets_up {
            return if self.stalled.max(self.motion.waits()) > STALLED_TIME {
                GetUpDecision::GiveUp
            } else {
                GetUpDecision::Continue
            };
        }
        if self.own {
            self.own = false;
        } else if height < FALLEN_HEIGHT {
            self.note_low_motion();
        } else if self.lay && self.attempts > 0 && self.motion.is_low(terms) && lies(terms) {
            self.attempts -= 1;
            self.own = true;
            self.off = 0.0;
            self.stalled = 0.0;
            self.motion.begin(solver, terms);
            return GetUpDecision::Begin;
        }
        GetUpDecision::Continue
    }

    /// Desired motion of a tick of `dt` seconds while it gets up, at the pace at which the figure, in the state of
    /// `terms`, follows the last tick's `target`.
    pub fn targets(
        &mut self,
        body: &Body,
        solver: &mut GetUpSolver,
        terms: &Terms,
        target: &Posture,
        dt: f64,
    ) -> TargetPair {
        let state = &terms.state.posture;
        let turn = tilt(state.root_rotation, target.root_rotation);
        let keeping = |full: f64, none: f64, e: f64| ((none - e) / (none - full)).clamp(0.0, 1.0);
        let joints = || keeping(FULL_PACE_JOINTS, NO_PACE_JOINTS, unlike(state, target));
        let pace = if self.motion.rolls() {
            1.0
        } else if self.motion.lies() {
            (joints() * keeping(FULL_PACE_LYING_TURN, NO_PACE_LYING_TURN, turn)).max(LEAST_PACE)
        } else {
            joints()
                * keeping(FULL_PACE_TURN, NO_PACE_TURN, turn)
                * keeping(FULL_PACE_COM, NO_PACE_COM, self.off)
        };
        self.stalled = if pace < STALLED_PACE {
            self.stalled + dt
        } else {
            0.0
        };
        self.motion.advance(body, solver, terms, dt, pace)
    }

    /// Heights of the contact points that should touch the floor in the motion, with the target's kinematics in
    /// `tasks`; infinite for the others. `off`: from the centre of mass to the desired one, m.
    pub fn plan_contacts(
        &mut self,
        body: &Body,
        tasks: &TaskWorkspace,
        target: &TargetPair,
        off: Vec3,
        heights: &mut [f64; MAX_CONTACTS],
    ) {
        self.off = off.level();
        heights.fill(f64::INFINITY);
        for s in SegmentId::all().filter(|s| self.motion.carries(*s)) {
            let points = body
                .segment(s)
                .contact_points
                .iter()
                .take(POINTS_PER_SEGMENT);
            for (vertex, p) in points.enumerate() {
                heights[s.index() * POINTS_PER_SEGMENT + vertex] =
                    tasks.desired_point(target, s, *p).z;
            }
        }
    }
}

/// Whether it lies, and lies still.
fn lies(terms: &Terms) -> bool {
    let up = terms.state.posture.root_rotation.rotate(Vec3::Z);
    up.z.abs() < LEVEL && terms.com_velocity.norm() < STILL_SPEED
}
