//! What a tick computes in: controllers and steppers with their buffers, several hundred kB.
//!
//! No figure owns one. The thread that steps a world lends a [`Workspace`] to a figure for a tick, so that the next
//! figure finds it in the cache. What controllers and steppers remember from tick to tick is a few kB, and stays with
//! the figure ([`Memory`]).

use crate::control::{Controller, ModernMemory};
use crate::dynamics::Terms;
use crate::figure::motion::tasks::TaskWorkspace;
use crate::figure::state::controllers::Controllers;
use crate::math::Vec3;
use crate::paper::controller::PaperMemory;
use crate::paper::prescribed_step::KinematicStepper;
use crate::paper::prescribed_step::SupportAnchor;
use crate::stepper::forces::TickForces;
use crate::stepper::torque_step::TorqueStepper;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// Controllers and steppers, and what they read of the figure whose tick it is.
#[derive(Debug)]
pub(crate) struct Workspace {
    /// Dynamics of the state at the start of the tick.
    pub(in crate::figure) terms: Terms,
    /// Kinematics of the desired motion.
    pub(in crate::figure) tasks: TaskWorkspace,
    pub(in crate::figure) controllers: Controllers,
    pub(in crate::figure) steppers: Steppers,
}

/// The steppers, one of which moves the body.
#[derive(Debug)]
pub(in crate::figure) struct Steppers {
    pub torque: TorqueStepper,
    pub kinematic: Box<KinematicStepper>,
}

impl Steppers {
    /// The result of the tick, which accelerations moved or torques.
    pub fn result(&self, prescribed: bool) -> StepResult<'_> {
        if prescribed {
            StepResult {
                forces: &self.kinematic.forces,
                penetration: self.kinematic.penetration(),
            }
        } else {
            StepResult {
                forces: &self.torque.forces,
                penetration: self.torque.penetration(),
            }
        }
    }
}

/// The result of the stepper that moved the body.
#[derive(Clone, Copy, Debug)]
pub(in crate::figure) struct StepResult<'a> {
    /// Means over the tick.
    pub forces: &'a TickForces,
    /// Deepest contact point below the surface, m.
    pub penetration: f64,
}

impl Default for Workspace {
    /// Of no figure yet; each that borrows it sets the friction of its ground. Allocates.
    fn default() -> Self {
        Self {
            terms: Terms::default(),
            tasks: TaskWorkspace::default(),
            controllers: Controllers::default(),
            steppers: Steppers {
                torque: TorqueStepper::new(1.0),
                kinematic: Box::new(KinematicStepper::new(1.0)),
            },
        }
    }
}

/// The place for a workspace: a thread's while none of its figures has it, a figure's during its tick.
#[derive(Debug, Default)]
pub(crate) struct WorkspaceSlot(Option<Box<Workspace>>);

impl WorkspaceSlot {
    /// With a workspace in it, a new one if there was none.
    pub fn fill(&mut self) {
        self.0.get_or_insert_default();
    }
}

impl Deref for WorkspaceSlot {
    type Target = Workspace;

    fn deref(&self) -> &Workspace {
        self.0.as_deref().expect("it is lent for the whole tick")
    }
}

impl DerefMut for WorkspaceSlot {
    fn deref_mut(&mut self) -> &mut Workspace {
        self.0
            .as_deref_mut()
            .expect("it is lent for the whole tick")
    }
}

/// What controllers and steppers remember of a figure from tick to tick.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(in crate::figure) struct Memory {
    pub paper: PaperMemory,
    pub modern: ModernMemory,
    pub steppers: StepperMemory,
}

/// What the steppers remember.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct StepperMemory {
    /// Impulse along the bar between two hands, N·s: first guess of the next substep.
    pub bar_impulse: f64,
    /// Its mean force in the last tick, N.
    pub bar_force: Vec3,
    /// Where the support of prescribed accelerations stands.
    pub anchor: Option<SupportAnchor>,
}

impl Default for StepperMemory {
    fn default() -> Self {
        Self {
            bar_impulse: 0.0,
            bar_force: Vec3::zero(),
            anchor: None,
        }
    }
}

/// What controllers and steppers remember of a figure, and the workspace that it is lent for a tick. The memory is in
/// the workspace during a tick, and here between two.
#[derive(Debug, Default)]
pub(in crate::figure) struct Loan {
    memory: Memory,
    slot: WorkspaceSlot,
}

impl Loan {
    /// With what was read from a checkpoint.
    pub fn remembering(memory: Memory) -> Self {
        Self {
            memory,
            slot: WorkspaceSlot::default(),
        }
    }

    /// What is remembered between two ticks.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// Takes the workspace of `slot` for a tick on ground with friction coefficient `friction`.
    pub fn borrow(&mut self, slot: &mut WorkspaceSlot, friction: f64) {
        slot.fill();
        std::mem::swap(&mut self.slot, slot);
        let Workspace {
            controllers,
            steppers: Steppers { torque, kinematic },
            ..
        } = &mut *self.slot;
        controllers.paper.swap_memory(&mut self.memory.paper);
        controllers.modern.swap_memory(&mut self.memory.modern);
        controllers.modern.set_friction(friction);
        let remembered = &self.memory.steppers;
        torque.remember(remembered.bar_impulse, remembered.bar_force);
        torque.set_friction(friction);
        kinematic.remember(remembered.anchor);
        kinematic.set_friction(friction);
    }

    /// Gives the workspace back to `slot`; not if it has computed with numbers that are not `finite`: they must not
    /// reach another figure.
    pub fn give_back(&mut self, slot: &mut WorkspaceSlot, finite: bool) {
        let Workspace {
            controllers,
            steppers: Steppers { torque, kinematic },
            ..
        } = &mut *self.slot;
        controllers.paper.swap_memory(&mut self.memory.paper);
        controllers.modern.swap_memory(&mut self.memory.modern);
        let (bar_impulse, bar_force) = torque.memory();
        self.memory.steppers = StepperMemory {
            bar_impulse,
            bar_force,
            anchor: kinematic.memory(),
        };
        std::mem::swap(&mut self.slot, slot);
        if !finite {
            *slot = WorkspaceSlot::default();
        }
    }

    /// The modern controller forgets the last tick; during a tick or between two.
    pub fn reset_modern(&mut self) {
        match &mut self.slot.0 {
            Some(workspace) => workspace.controllers.modern.reset(),
            None => self.memory.modern.reset(),
        }
    }

    /// The controllers forget the last tick; during a tick or between two.
    pub fn reset_controllers(&mut self) {
        self.reset_modern();
        match &mut self.slot.0 {
            Some(workspace) => workspace.controllers.paper.reset(),
            None => self.memory.paper.reset(),
        }
    }

    /// A bar between two hands pushes with nothing; during a tick or between two.
    pub fn forget_bar(&mut self) {
        match &mut self.slot.0 {
            Some(workspace) => workspace.steppers.torque.remember(0.0, Vec3::zero()),
            None => {
                let steppers = &mut self.memory.steppers;
                (steppers.bar_impulse, steppers.bar_force) = (0.0, Vec3::zero());
            }
        }
    }

    /// Prescribed accelerations forget where their support stands; during a tick or between two.
    pub fn reset_anchor(&mut self) {
        match &mut self.slot.0 {
            Some(workspace) => workspace.steppers.kinematic.reset(),
            None => self.memory.steppers.anchor = None,
        }
    }
}

impl Deref for Loan {
    type Target = Workspace;

    fn deref(&self) -> &Workspace {
        &self.slot
    }
}

impl DerefMut for Loan {
    fn deref_mut(&mut self) -> &mut Workspace {
        &mut self.slot
    }
}
