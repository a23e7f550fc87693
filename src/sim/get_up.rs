//! Getting up from the floor, for any body and from any place: planned tick by tick.
//!
//! A sequence of [`stages`], each a handful of [`goals`]: the places of pelvis, knees, feet and hands, the place of the
//! centre of mass, and the joint angles. Goals and weights change smoothly from one stage to the next, and in each tick
//! one step of [`solver`] moves the posture towards them. Nothing is planned ahead, and nothing allocates. Goals refer
//! to the real places of the parts on the floor, so no part has to be where an earlier plan would put it, and the
//! motion can run at any pace.

mod goals;
pub mod params;
mod reference_pose;
mod solver;
mod stages;

use crate::body::angles::anatomical_angles;
use crate::body::topology::{
    CHEST, HANDS, HEAD, L_FOOT, L_FOREARM, L_HAND, L_SHANK, L_TOES, L_UPPER_ARM, NV, R_FOOT,
    R_FOREARM, R_HAND, R_SHANK, R_TOES, R_UPPER_ARM, SEGMENT_COUNT, SHANKS, SegmentId, TOES,
};
use crate::body::{Body, Posture};
use crate::dynamics::Terms;
use crate::math::curve::{arc, smootherstep};
use crate::math::exp::exp;
use crate::math::{Quat, Vec3, trig};
use crate::motion::builtin::REFERENCE_LEG;
use crate::motion::{PlanarTransform, Target, TargetPair};
use goals::Goals;
use params::layout::{LYING_HEIGHT, NEAR_HEIGHT, ON_SIDE, PRONE, TOUCH_HEIGHT, UPDATE_TIME};
use reference_pose::ReferencePoses;
use serde::{Deserialize, Serialize};
use solver::{BALL, KNEE, Solver};
use stages::{FloorContacts, GetUpStage, Layout};
use std::f64::consts::FRAC_PI_2;

/// The stage at which a body that lies on its side begins.
const SIDE: usize = 2;

/// The properties of a body that getting up needs, with the buffers of its inverse kinematics.
#[derive(Clone, Debug)]
pub struct GetUpSolver {
    solver: Solver,
    poses: ReferencePoses,
}

impl GetUpSolver {
    /// A solver for a body that ends standing in the posture `at_ease`. Allocates.
    pub fn new(body: &Body, at_ease: &Posture) -> Self {
        Self {
            solver: Solver::new(body),
            poses: ReferencePoses::new(anatomical_angles(at_ease)),
        }
    }
}

/// The motion of one figure that gets up.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct GetUpMotion {
    layout: Layout,
    /// Map from the motion's coordinates to the world.
    place: PlanarTransform,
    /// Whether the stages roll the body onto its belly, rather than up.
    turns_over: bool,
    stage: usize,
    /// Whether it rolls over the left side instead of the right.
    mirrored: bool,
    /// Time since the stage began, s.
    since: f64,
    /// Time spent waiting for the parts that should be on the floor, s.
    waits: f64,
    /// Goals at the start of the stage, and now.
    from: Goals,
    now: Goals,
    posture: Posture,
    #[serde(with = "crate::saved::array")]
    velocity: [f64; NV],
}

/// Angle by which a body that faces `front` is turned from lying on its belly, rad: π on the back, π/2 on the right
/// side.
fn roll(front: Vec3) -> f64 {
    trig::atan2(front.y, -front.z)
}

/// Whether a body lies on its belly.
fn is_prone(p: &Posture) -> bool {
    p.root_rotation.rotate(Vec3::X).z < -PRONE
}

/// Maps a point of the world into the motion's coordinates.
fn inverse(place: PlanarTransform, p: Vec3) -> Vec3 {
    let back = Quat::exp(Vec3::Z * -place.yaw);
    back.rotate(Vec3 {
        x: p.x - place.x,
        y: p.y - place.y,
        z: p.z,
    })
}

impl GetUpMotion {
    /// The motion of a body that has not yet begun to get up.
    pub fn new(body: &Body) -> Self {
        Self {
            layout: Layout {
                scale: body.leg_length(0) / REFERENCE_LEG,
                ..Layout::default()
            },
            place: PlanarTransform::default(),
            turns_over: false,
            stage: 0,
            mirrored: false,
            since: 0.0,
            waits: 0.0,
            from: Goals::default(),
            now: Goals::default(),
            posture: Posture::default(),
            velocity: [0.0; NV],
        }
    }

    /// Whether the body of `terms` is low enough to be lying.
    pub fn is_low(&self, terms: &Terms) -> bool {
        terms.com.z < LYING_HEIGHT * self.layout.scale
    }

    /// Begins at the place of the body of `terms`: from its belly, or otherwise by rolling onto it.
    pub fn begin(&mut self, with: &GetUpSolver, terms: &Terms) {
        let p = &terms.state.posture;
        let knees = SHANKS.map(|s| terms.point_world(s.index(), with.solver.contact(s, KNEE)));
        let chest = terms.segment_position(CHEST.index());
        let front = p.root_rotation.rotate(Vec3::X);
        let prone = is_prone(p);
        // A body that does not lie straight rolls about its trunk.
        let back = if prone {
            (knees[0] + knees[1]) * 0.5
        } else {
            p.root_position
        };
        let ahead = chest - back;
        self.place = PlanarTransform {
            x: p.root_position.x,
            y: p.root_position.y,
            yaw: trig::atan2(ahead.y, ahead.x),
        };
        self.posture = *p;
        self.posture.root_position = inverse(self.place, p.root_position);
        let back = Quat::exp(Vec3::Z * -self.place.yaw);
        self.posture.root_rotation = (back * p.root_rotation).normalized();
        self.velocity = [0.0; NV];
        self.layout.yaw = 0.0;
        self.layout.roll = roll(back.rotate(front));
        for side in 0..2 {
            self.layout.knees[side] = self.real(with, terms, (SHANKS[side], KNEE));
            self.layout.balls[side] = self.ball(with, terms, side);
            self.layout.hands[side] =
                inverse(self.place, terms.segment_position(HANDS[side].index()));
        }
        self.turns_over = !prone;
        self.mirrored = !prone && self.layout.roll < 0.0;
        let first = match self.layout.roll.abs() {
            _ if prone => 0,
            // It already faces down, so its weight does the rest.
            roll if roll < FRAC_PI_2 => stages::OVER.len() - 1,
            roll if roll < ON_SIDE => SIDE,
            _ => 0,
        };
        self.layout.pelvis = self.posture.root_position;
        let up = self.posture.root_rotation.rotate(Vec3::Z);
        self.now = self.goals(&with.poses, first);
        self.now.begin(
            [trig::atan2(up.x, up.z), self.layout.roll, 0.0],
            &anatomical_angles(&self.posture),
        );
        self.enter(first);
    }

    /// The stages of the present part of the motion.
    fn stages(&self) -> &'static [GetUpStage] {
        if self.turns_over {
            stages::OVER
        } else {
            stages::UP
        }
    }

    /// The parts that are on the floor.
    fn down(&self) -> FloorContacts {
        self.stages()[self.stage].down
    }

    /// Whether it is in one of its stages; a value read from a checkpoint may not be.
    pub fn is_valid(&self) -> bool {
        self.stage < self.stages().len()
    }

    /// Goals of a stage.
    fn goals(&self, poses: &ReferencePoses, stage: usize) -> Goals {
        let goals = self.stages()[stage].goals;
        if self.mirrored {
            goals(&self.layout.mirrored(), poses).mirrored()
        } else {
            goals(&self.layout, poses)
        }
    }

    /// Real place of a contact point.
    fn real(&self, with: &GetUpSolver, terms: &Terms, (s, point): (SegmentId, usize)) -> Vec3 {
        let p = with.solver.contact(s, point);
        inverse(self.place, terms.point_world(s.index(), p))
    }

    fn ball(&self, with: &GetUpSolver, terms: &Terms, side: usize) -> Vec3 {
        let [a, b] = BALL.map(|k| self.real(with, terms, (TOES[side], k)));
        (a + b) * 0.5
    }

    fn enter(&mut self, stage: usize) {
        self.stage = stage;
        self.since = 0.0;
        self.waits = 0.0;
        self.from = self.now;
    }

    /// Whether the last stage is over.
    pub fn is_over(&self) -> bool {
        !self.turns_over
            && self.stage + 1 == self.stages().len()
            && self.since >= self.stages()[self.stage].seconds
    }

    /// Whether a segment that touches the floor carries weight. Arms and feet that are moving elsewhere slide instead.
    pub fn carries(&self, s: SegmentId) -> bool {
        let down = self.down();
        match s {
            _ if down.whole => true,
            L_UPPER_ARM | L_FOREARM | L_HAND => down.hands[0],
            R_UPPER_ARM | R_FOREARM | R_HAND => down.hands[1],
            L_FOOT | L_TOES | R_FOOT | R_TOES => down.balls,
            L_SHANK | R_SHANK => down.knees,
            HEAD => !down.balls,
            _ => !down.balls || down.slides,
        }
    }

    /// Whether the trunk lies on the floor.
    pub fn lies(&self) -> bool {
        let down = self.down();
        down.whole || !down.balls
    }

    /// Whether it is rolling over.
    pub fn rolls(&self) -> bool {
        self.down().whole
    }

    /// Segments that may slide over the floor.
    pub fn slides(&self) -> &[bool; SEGMENT_COUNT] {
        const fn all_but(kept: &[SegmentId]) -> [bool; SEGMENT_COUNT] {
            let mut out = [true; SEGMENT_COUNT];
            let mut k = 0;
            while k < kept.len() {
                out[kept[k].index()] = false;
                k += 1;
            }
            out
        }
        const NONE: [bool; SEGMENT_COUNT] = [false; SEGMENT_COUNT];
        const BUT_FEET: [bool; SEGMENT_COUNT] = all_but(&[L_FOOT, R_FOOT, L_TOES, R_TOES]);
        const BUT_HANDS: [bool; SEGMENT_COUNT] = all_but(&HANDS);
        match self.down() {
            FloorContacts { whole: true, .. } => &BUT_FEET,
            FloorContacts { slides: true, .. } => &BUT_HANDS,
            _ => &NONE,
        }
    }

    /// Time spent waiting for the parts that should be on the floor by now, s.
    pub fn waits(&self) -> f64 {
        self.waits
    }

    /// Name of the present stage.
    pub fn stage(&self) -> &'static str {
        self.stages()[self.stage].name
    }

    /// Desired motion of a tick of `dt` seconds at the fraction `pace` of full speed, for the body of `terms`. No
    /// allocation.
    pub fn advance(
        &mut self,
        body: &Body,
        with: &mut GetUpSolver,
        terms: &Terms,
        dt: f64,
        pace: f64,
    ) -> TargetPair {
        let before = self.target();
        if !self.turns_over && self.lies() && !is_prone(&terms.state.posture) {
            // It has rolled off its belly, so begin again.
            self.begin(with, terms);
        }
        self.since += dt * pace;
        let stage = self.stages()[self.stage];
        if self.since >= stage.seconds && self.stage + 1 < self.stages().len() {
            if is_down(&with.solver, terms, self.stages()[self.stage + 1].down) {
                self.enter(self.stage + 1);
            } else {
                self.since = stage.seconds;
                self.waits += dt;
            }
        } else if self.since >= stage.seconds && self.turns_over {
            self.begin(with, terms);
        }
        self.update_layout(with, terms, dt);
        let stage = &self.stages()[self.stage];
        let u = (self.since / stage.seconds).min(1.0);
        let share = smootherstep(u);
        self.now = self.from.mix(&self.goals(&with.poses, self.stage), share);
        let mut goals = self.now;
        if let Some((side, height)) = stage.step {
            let rise = arc(height * self.layout.scale, u);
            goals.hands[side][2].at += rise;
            goals.palms[side].at += rise;
        }
        with.solver
            .advance(body, (&mut self.posture, &mut self.velocity), &goals, dt);
        TargetPair {
            now: before,
            next: self.target(),
        }
    }

    /// Updates the layout from the real places of the parts on the floor.
    fn update_layout(&mut self, with: &GetUpSolver, terms: &Terms, dt: f64) {
        let share = 1.0 - exp(-dt / UPDATE_TIME);
        let real = &terms.state.posture;
        self.layout.pelvis = inverse(self.place, real.root_position);
        let down = self.down();
        let heading = if down.whole {
            real.root_rotation.rotate(Vec3::Z)
        } else {
            real.root_rotation.rotate(Vec3::Y).cross(Vec3::Z)
        };
        let yaw = trig::atan2(heading.y, heading.x) - self.place.yaw;
        let off = trig::wrapped(yaw - self.layout.yaw);
        self.layout.yaw += share * off;
        for side in 0..2 {
            let knee = self.real(with, terms, (SHANKS[side], KNEE));
            let ball = self.ball(with, terms, side);
            let wrist = inverse(self.place, terms.segment_position(HANDS[side].index()));
            let palm = with.solver.lowest(terms, HANDS[side]);
            let toes = with.solver.lowest(terms, TOES[side]);
            let h = &mut self.layout;
            let take = |place: &mut Vec3, real: Vec3, low: f64, down: bool| {
                if down && low < TOUCH_HEIGHT {
                    *place += (real - *place) * share;
                }
            };
            take(&mut h.knees[side], knee, knee.z, down.knees);
            take(&mut h.balls[side], ball, toes, down.balls);
            take(&mut h.hands[side], wrist, palm, down.hands[side]);
            if !down.balls {
                h.balls[side] = ball;
            }
            if !down.hands[side] {
                h.hands[side] = wrist;
            }
        }
    }

    fn target(&self) -> Target {
        let mut out = Target::still(self.posture);
        out.velocity = self.velocity;
        let d = self.down();
        out.planted = [d.balls && !d.knees && d.hands == [false; 2]; 2];
        self.place.apply_to(&mut out);
        out
    }
}

/// Whether all parts that a stage leans on are on the floor.
fn is_down(solver: &Solver, terms: &Terms, down: FloorContacts) -> bool {
    (0..2).all(|side| {
        let low = |s: SegmentId| solver.lowest(terms, s) < NEAR_HEIGHT;
        down.whole
            || (!down.knees || !down.balls || low(SHANKS[side]))
                && (!down.balls || low(TOES[side]))
                && (!down.hands[side] || low(HANDS[side]))
    })
}

#[cfg(test)]
mod tests;
