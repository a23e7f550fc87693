//! The torque stepper alone: a body with a share of its strength and no controller, one substep per step, so that every
//! step is visible.

use sinew_physics::body::angles::{angles_of, swings};
use sinew_physics::body::{Body, DOF_COUNT, Links, NV, State};
use sinew_physics::contact::Tissue;
use sinew_physics::dynamics::Terms;
use sinew_physics::figure::StrengthScale;
use sinew_physics::stepper::command::{
    MotorCommand, StepForces, StepInput, Stepper, TickStart, TorqueRange,
};
use sinew_physics::stepper::torque_step::TorqueStepper;
use sinew_physics::strength::{MuscleScale, Strength};
use sinew_physics::tick_context::{Planning, TickContext};
use std::sync::Arc;

/// Coefficient of its floor.
pub(crate) const FRICTION: f64 = 0.9;

pub(crate) struct Bare {
    pub stepper: TorqueStepper,
    body: Arc<Body>,
    links: Links,
    strength: Strength,
    terms: Terms,
    scale: MuscleScale,
    gravity: f64,
    dt: f64,
}

impl Bare {
    /// A body with `share` of its strength and steps of `dt` seconds.
    pub fn new(body: Arc<Body>, share: f64, gravity: f64, dt: f64) -> Self {
        let scale = StrengthScale {
            all: share,
            ..StrengthScale::default()
        };
        Self {
            links: Links::new(&body),
            strength: Strength::for_body(&body),
            stepper: TorqueStepper::new(FRICTION),
            terms: Terms::default(),
            scale: scale.muscles(1.0),
            gravity,
            dt,
            body,
        }
    }

    /// Steps with motors that hold the present joint angles, and with stretched tissue if it is given.
    pub fn step(&mut self, state: &mut State, tissue: Option<&Tissue>) {
        self.terms.compute(&self.links, state, &[], self.gravity);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| state.velocity[6 + j]);
        let mut available = TorqueRange {
            lower: [0.0; DOF_COUNT],
            upper: [0.0; DOF_COUNT],
        };
        let swings = swings(&state.posture);
        let angles = angles_of(&swings, &state.posture);
        let TorqueRange { lower, upper } = &mut available;
        self.strength
            .range(&angles, &rates, &self.scale, lower, upper);
        let command = MotorCommand {
            acceleration: [0.0; DOF_COUNT],
            torque: [0.0; DOF_COUNT],
            saturation_speed: 1.0,
        };
        let input = StepInput {
            body: &self.body,
            links: &self.links,
            strength: &self.strength,
            scale: &self.scale,
            start: TickStart {
                terms: &self.terms,
                swings: &swings,
                available: &available,
            },
            last_acceleration: &[0.0; NV],
            command: &command,
            tissue,
            forces: StepForces {
                applied: &[],
                bar: None,
                assist: None,
            },
            own: None,
            world: &TickContext {
                tick: 0,
                dt: self.dt,
                substeps: 1,
                gravity: self.gravity,
                planning: Planning::default(),
            },
        };
        self.stepper.step(&input, state);
    }
}
