//! One tick's input to a controller, for tests.

use super::{
    CentroidalTarget, ConstraintGoal, ContactTargets, ControlInput, Effector, FootTarget,
    HelpAllowance, PointTarget, RotationTarget, StancePhase,
};
use crate::body::topology::{DOF_COUNT, L_FOOT, L_HAND, R_FOOT, R_HAND};
use crate::body::{Body, State};
use crate::dynamics::Terms;
use crate::math::vec3::vec3;
use crate::math::{Quat, Vec3};
use crate::motion::{Target, TargetPair};
use crate::report::MAX_CONTACTS;
use crate::setup::ControlParams;
use crate::support::Support;
use crate::support::testing::{GRAVITY, mannequin, strength, terms};

/// Length of a tick, s.
pub(crate) const DT: f64 = 1.0 / 60.0;

/// Price and bound of a wrench, and the share of the last one that costs nothing.
#[derive(Clone, Copy)]
pub(crate) struct SceneHelp {
    pub(crate) compliance: [f64; 2],
    pub(crate) most: [f64; 2],
    pub(crate) kept: f64,
}

/// One tick's input, owned.
pub(crate) struct Scene {
    pub(crate) body: Body,
    pub(crate) terms: Terms,
    pub(crate) support: Support,
    pub(crate) target: TargetPair,
    pub(crate) com: PointTarget,
    pub(crate) effectors: Vec<Effector>,
    pub(crate) goals: Vec<ConstraintGoal>,
    pub(crate) feet: [FootTarget; 2],
    pub(crate) lower: [f64; DOF_COUNT],
    pub(crate) upper: [f64; DOF_COUNT],
    pub(crate) params: ControlParams,
    pub(crate) assist: [f64; 2],
    pub(crate) help: Option<SceneHelp>,
    pub(crate) heights: Box<[f64; MAX_CONTACTS]>,
    pub(crate) floor: Box<[Vec3; MAX_CONTACTS]>,
    pub(crate) kinematic: bool,
}

impl Scene {
    /// The figure is in `state` and should stand still in `desired`, with `scale` times the strength of a person.
    pub(crate) fn new(state: &State, desired: &State, scale: f64) -> Self {
        let body = mannequin();
        let (t, d) = (terms(&body, state), terms(&body, desired));
        let mut support = Support::default();
        support.update(&t, &body, Vec3::zero(), GRAVITY);
        let grip = vec3(0.0, 0.0, -0.08);
        let effectors = [L_HAND, R_HAND]
            .map(|segment| Effector {
                segment,
                point: grip,
                position: PointTarget::still(d.point_world(segment.index(), grip)),
                rotation: None,
            })
            .to_vec();
        let feet = [L_FOOT, R_FOOT].map(|s| {
            let turn = Quat::from_mat3(&d.segment_rotation(s.index()));
            FootTarget {
                ankle: PointTarget::still(d.segment_position(s.index())),
                rotation: RotationTarget::still(turn),
            }
        });
        let target = Target::still(desired.posture);
        let (lower, upper) = strength(scale);
        Self {
            com: PointTarget::still(d.com),
            body,
            terms: t,
            support,
            target: TargetPair {
                now: target.clone(),
                next: target,
            },
            effectors,
            goals: Vec::new(),
            feet,
            lower,
            upper,
            params: ControlParams::default(),
            assist: [0.0; 2],
            help: None,
            heights: Box::new([0.0; MAX_CONTACTS]),
            floor: Box::new([Vec3::zero(); MAX_CONTACTS]),
            kinematic: false,
        }
    }

    /// Sets the feet that its motion keeps on the floor.
    pub(crate) fn plant(&mut self, planted: [bool; 2]) {
        self.target.now.planted = planted;
        self.target.next.planted = planted;
    }

    pub(crate) fn input(&self) -> ControlInput<'_> {
        ControlInput {
            carried: [0.0; 2],
            terms: &self.terms,
            body: &self.body,
            support: &self.support,
            target: &self.target,
            centroidal: CentroidalTarget {
                com: &self.com,
                acceleration: None,
                momentum: None,
            },
            contacts: ContactTargets {
                feet: &self.feet,
                phase: StancePhase::Stance,
                places_known: false,
                floor: None,
            },
            effectors: &self.effectors,
            goals: &self.goals,
            lower: &self.lower,
            upper: &self.upper,
            params: &self.params,
            gravity: GRAVITY,
            dt: DT,
            assist: self.assist,
            help: self.help.map(|help| HelpAllowance {
                compliance: help.compliance,
                most: help.most,
                kept: help.kept,
                heights: &self.heights,
                floor: &self.floor,
                as_it_lies: true,
            }),
            kinematic: self.kinematic,
        }
    }
}
