//! One figure reduced to the needs of a rehearsal: a state in, a state out. The parts are those of a figure's tick, in
//! the same order, so that a motion runs in a world exactly as it does here.

use super::look::{Cost, Look, Looker, Off};
use super::problem::{Problem, Reference};
use super::settings::Settings;
use crate::body::angles::{angles_of, swings};
use crate::body::topology::{DOF_COUNT, NV};
use crate::body::{Body, Links, State};
use crate::contact::Tissue;
use crate::control::Law;
use crate::dynamics::Terms;
use crate::figure::motion::rehearsed::JointOffset;
use crate::math::Vec3;
use crate::motion::TargetPair;
use crate::stepper::command::{StepForces, StepInput, TickStart, TorqueRange};
use crate::stepper::motor_law::MotorLaw;
use crate::stepper::pelvis_wrench;
use crate::stepper::pelvis_wrench::PelvisHelp;
use crate::stepper::pelvis_wrench::RootStep;
use crate::stepper::torque_step::{Accuracy, TorqueStepper};
use crate::strength::{MuscleScale, Strength};
use crate::tick_context::Planning;
use crate::tick_context::TickContext;
use std::sync::Arc;

/// The addition of a sample to the desired motion in a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action {
    /// Offsets of the joints at the end of the window, rad.
    pub offset: JointOffset,
    /// Largest force towards the desired pelvis over the weight.
    pub help: f64,
}

impl Action {
    /// No addition.
    pub const NONE: Self = Self {
        offset: JointOffset([0.0; DOF_COUNT]),
        help: 0.0,
    };

    /// The action in tick `k` of a window that begins with the offsets `before` and leaves them in `ramp` ticks.
    #[must_use]
    pub fn on_the_way(&self, before: &JointOffset, k: usize, ramp: usize) -> Self {
        Self {
            offset: self.offset.on_the_way(before, k, ramp),
            help: self.help,
        }
    }

    /// The action in tick `k` of a motion with these in its windows.
    pub fn at(actions: &[Self], k: usize, windows: WindowTicks) -> Self {
        let (w, within) = (k / windows.length, k % windows.length);
        let before = w.checked_sub(1).map_or(Self::NONE, |w| actions[w]);
        actions[w].on_the_way(&before.offset, within, windows.ramp)
    }
}

/// Ticks of a window that the end of the motion does not cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowTicks {
    /// All of them.
    pub length: usize,
    /// Those in which its offsets are reached.
    pub ramp: usize,
}

impl WindowTicks {
    /// Those of a problem.
    pub fn new(problem: &Problem, settings: &Settings) -> Self {
        let length = ((settings.window / problem.stage.dt).round() as usize).max(1);
        let ramp = (settings.ramp * length as f64).round() as usize;
        Self {
            length,
            ramp: ramp.clamp(1, length),
        }
    }
}

/// A body with its motors on the floor; made once per thread.
#[derive(Debug)]
pub struct Simulator {
    body: Arc<Body>,
    links: Links,
    strength: Arc<Strength>,
    muscles: MuscleScale,
    world: TickContext,
    motors: MotorLaw,
    law: Law,
    terms: Terms,
    stepper: TorqueStepper,
    available: TorqueRange,
    looker: Looker,
    /// Ticks simulated.
    pub ticks: u64,
}

impl Simulator {
    /// For this problem.
    pub fn new(problem: &Problem, settings: &Settings) -> Self {
        let motors = settings.motors;
        let none = [0.0; DOF_COUNT];
        let mut stepper = TorqueStepper::new(problem.friction);
        stepper.set_accuracy(Accuracy::REHEARSED);
        Self {
            body: Arc::clone(&problem.body),
            links: problem.links.clone(),
            strength: Arc::clone(&problem.strength),
            muscles: problem.muscles.clone(),
            world: TickContext {
                tick: 0,
                dt: problem.stage.dt,
                substeps: problem.stage.substeps,
                gravity: problem.stage.gravity,
                planning: Planning::InTick,
            },
            law: motors.law(problem.stage.dt),
            motors,
            terms: Terms::default(),
            stepper,
            available: TorqueRange {
                lower: none,
                upper: none,
            },
            looker: Looker::default(),
            ticks: 0,
        }
    }

    /// The look at a state.
    pub fn look(&mut self, state: &State) -> Look {
        self.looker.look(&self.body, &self.links, state)
    }

    /// Cost of being in `state` at the end of tick `k − 1`, and its distance from the recording.
    pub fn cost(
        &mut self,
        cost: &Cost,
        state: &State,
        reference: &Reference,
        k: usize,
    ) -> (f64, Off) {
        let is = self.look(state);
        let (wanted, should) = (&reference.targets[k].posture, &reference.looks[k]);
        let cost = cost.of((&state.posture, &is), (wanted, should));
        (cost, is.off(should))
    }

    /// Used share of the available torque in the last tick, by DOF: mean torque over the strength at its start, limited
    /// to 1 because the strength may have changed within the tick.
    pub fn utilisation(&self) -> [f64; DOF_COUNT] {
        let TorqueRange { lower, upper } = &self.available;
        std::array::from_fn(|d| {
            let torque = self.stepper.forces.torque[d];
            let limit = if torque < 0.0 { lower[d] } else { upper[d] };
            (torque / limit).min(1.0)
        })
    }

    /// One tick with an action that is on its way. The velocities of `target` are set back. `record` is called after
    /// each substep.
    pub fn tick(
        &mut self,
        state: &mut State,
        target: &TargetPair,
        action: &Action,
        mut record: impl FnMut(RootStep),
    ) {
        self.ticks += 1;
        let Self {
            body,
            links,
            strength,
            muscles,
            world,
            ..
        } = self;
        let mut moved = target.clone();
        action.offset.add_to(&mut moved);
        self.terms.compute(links, state, &[], world.gravity);
        let h = world.dt / f64::from(world.substeps);
        let swings = swings(&state.posture);
        let tissue = Tissue::new(strength, (state, &swings), world.substeps, h);
        let angles = angles_of(&swings, &state.posture);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| state.velocity[6 + j]);
        let TorqueRange { lower, upper } = &mut self.available;
        strength.range(&angles, &rates, muscles, lower, upper);
        let command = self.motors.command(&self.law, body, state, &moved);
        let pull = (action.help > 0.0).then(|| pelvis_wrench::pull(body, action.help));
        let input = StepInput {
            body,
            links,
            strength,
            scale: muscles,
            start: TickStart {
                terms: &self.terms,
                swings: &swings,
                available: &self.available,
            },
            last_acceleration: &[0.0; NV],
            command: &command,
            tissue: Some(&tissue),
            forces: StepForces {
                applied: &[],
                bar: None,
                assist: pull.map(|p| PelvisHelp::Pull(p, target)),
            },
            own: None,
            world,
        };
        self.stepper.begin(state);
        for i in 0..world.substeps {
            let (position, rotation) = (state.posture.root_position, state.posture.root_rotation);
            self.stepper.open_substep(&input, state, i);
            self.stepper.close_substep(&input, state, i);
            let (v, p) = (&state.velocity, &self.stepper.forces.audit.assist);
            let vector = |x: &[f64]| Vec3::from_array([x[0], x[1], x[2]]);
            record(RootStep {
                position,
                rotation,
                velocity: [vector(&v[..3]), vector(&v[3..6])],
                help: [vector(&p[..3]) * h, vector(&p[3..6]) * h],
            });
        }
        self.stepper.end(&input);
    }
}
