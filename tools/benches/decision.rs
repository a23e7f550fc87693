//! Everything between a state and a controller's decision.

use sinew_physics::body::angles::anatomical_angles;
use sinew_physics::body::topology::DOF_COUNT;
use sinew_physics::body::{Body, Links, Posture, State};
use sinew_physics::control::{
    CentroidalTarget, ContactTargets, ControlInput, Controller, StancePhase,
};
use sinew_physics::dynamics::Terms;
use sinew_physics::figure::ControlParams;
use sinew_physics::figure::motion::tasks::TaskWorkspace;
use sinew_physics::math::Vec3;
use sinew_physics::motion::{Target, TargetPair};
use sinew_physics::strength::{MuscleScale, Strength};
use sinew_physics::support::Support;

/// Duration of a tick, s.
pub const DT: f64 = 1.0 / 60.0;
const GRAVITY: f64 = 9.81;

/// Everything between a state and a command.
pub struct Decision {
    body: Body,
    links: Links,
    strength: Strength,
    scale: MuscleScale,
    params: ControlParams,
    state: State,
    target: TargetPair,
    terms: Terms,
    support: Support,
    tasks: TaskWorkspace,
    lower: [f64; DOF_COUNT],
    upper: [f64; DOF_COUNT],
}

impl Decision {
    /// Inputs of a decision for `body`, at rest until [`Self::look`] is called.
    pub fn new(body: Body) -> Self {
        let rest = Target::still(Posture::default());
        Self {
            links: Links::new(&body),
            strength: Strength::for_body(&body),
            scale: MuscleScale::default(),
            params: ControlParams::default(),
            state: State::default(),
            target: TargetPair {
                now: rest.clone(),
                next: rest,
            },
            terms: Terms::default(),
            support: Support::default(),
            tasks: TaskWorkspace::default(),
            lower: [0.0; DOF_COUNT],
            upper: [0.0; DOF_COUNT],
            body,
        }
    }

    /// Takes the state and target of the next decision.
    pub fn look(&mut self, state: &State, target: &TargetPair) {
        self.state.clone_from(state);
        self.target.clone_from(target);
        self.prepare();
    }

    /// Dynamics, supports and strength.
    pub fn prepare(&mut self) {
        self.terms.compute(&self.links, &self.state, &[], GRAVITY);
        self.support
            .update(&self.terms, &self.body, Vec3::zero(), GRAVITY);
        let angles = anatomical_angles(&self.state.posture);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| self.state.velocity[6 + j]);
        self.strength.range(
            &angles,
            &rates,
            &self.scale,
            &mut self.lower,
            &mut self.upper,
        );
    }

    /// A torque of the decision.
    pub fn decide(&mut self, controller: &mut impl Controller) -> f64 {
        let tasks = self.tasks.points(&self.body, &self.links, &self.target);
        let command = controller.control(&ControlInput {
            terms: &self.terms,
            body: &self.body,
            support: &self.support,
            target: &self.target,
            centroidal: CentroidalTarget {
                com: &tasks.com,
                acceleration: None,
                momentum: None,
            },
            contacts: ContactTargets {
                feet: &tasks.feet,
                phase: StancePhase::Stance,
                places_known: false,
                floor: None,
            },
            effectors: &tasks.hands,
            goals: &[],
            carried: [0.0; 2],
            lower: &self.lower,
            upper: &self.upper,
            params: &self.params,
            gravity: GRAVITY,
            dt: DT,
            assist: [0.0; 2],
            help: None,
            kinematic: false,
        });
        command.torque[0]
    }
}
