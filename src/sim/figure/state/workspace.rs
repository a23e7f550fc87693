//! The workspace of a tick: controllers and steppers with their buffers, several hundred kB.
//!
//! No figure owns one. The thread that steps a world lends a [`Workspace`] to a figure for a tick, so that the next
//! figure finds it in the cache. The memory of controllers and steppers from tick to tick is a few kB, and stays with
//! the figure ([`Memory`]).

use crate::control::{Controller, ModernMemory};
use crate::dynamics::Terms;
use crate::figure::motion::tasks::TaskWorkspace;
use crate::figure::state::controllers::Controllers;
use crate::math::Vec3;
use crate::paper::controller::PaperMemory;
use crate::paper::prescribed_step::KinematicStepper;
use crate::paper::prescribed_step::SupportAnchor;
use crate::report::MAX_CONTACTS;
use crate::stepper::forces::TickForces;
use crate::stepper::torque_step::TorqueStepper;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// Controllers and steppers, and their input from the figure whose tick it is.
#[derive(Debug)]
pub(crate) struct Workspace {
    /// Dynamics of the state at the start of the tick.
    pub(in crate::figure) terms: Terms,
    /// Kinematics of the desired motion.
    pub(in crate::figure) tasks: TaskWorkspace,
    pub(in crate::figure) controllers: Controllers,
    pub(in crate::figure) steppers: Steppers,
    pub(in crate::figure) floor: Box<FloorFacts>,
}

/// Facts about the floor and each contact point, by segment × 8 + vertex, for a figure that is helped.
#[derive(Debug)]
pub(in crate::figure) struct FloorFacts {
    /// Height of the point in the motion, m.
    pub heights: [f64; MAX_CONTACTS],
    /// Force of the floor on it in the last tick, N.
    pub forces: [Vec3; MAX_CONTACTS],
}

/// The steppers, one of which moves the body.
#[derive(Debug)]
pub(in crate::figure) struct Steppers {
    pub torque: TorqueStepper,
    pub kinematic: Box<KinematicStepper>,
}

impl Steppers {
    /// The result of the tick, whether accelerations moved the figure or torques did.
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
    /// A workspace without a figure. Each figure that borrows it sets the friction of its ground. Allocates.
    fn default() -> Self {
        Self {
            terms: Terms::default(),
            tasks: TaskWorkspace::default(),
            controllers: Controllers::default(),
            steppers: Steppers {
                torque: TorqueStepper::new(1.0),
                kinematic: Box::new(KinematicStepper::new(1.0)),
            },
            floor: Box::new(FloorFacts {
                heights: [0.0; MAX_CONTACTS],
                forces: [Vec3::zero(); MAX_CONTACTS],
            }),
        }
    }
}

/// The place for a workspace: belongs to a thread while none of its figures has the workspace, and to a figure during
/// its tick.
#[derive(Debug, Default)]
pub(crate) struct WorkspaceSlot(Option<Box<Workspace>>);

impl WorkspaceSlot {
    /// Fills it with a new workspace if it is empty.
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

/// The memory that controllers and steppers keep of a figure from tick to tick.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(in crate::figure) struct Memory {
    pub paper: PaperMemory,
    pub modern: ModernMemory,
    pub steppers: StepperMemory,
}

/// The memory of the steppers.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct StepperMemory {
    /// Impulse along the bar between two hands, N·s: first guess of the next substep.
    pub bar_impulse: f64,
    /// Its mean force in the last tick, N.
    pub bar_force: Vec3,
    /// Place of the support of prescribed accelerations.
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

/// The memory that controllers and steppers keep of a figure, and the workspace that it is lent for a tick. The memory
/// is in the workspace during a tick, and here between ticks.
#[derive(Debug, Default)]
pub(in crate::figure) struct Loan {
    memory: Memory,
    slot: WorkspaceSlot,
}

impl Loan {
    /// With a memory that was read from a checkpoint.
    pub fn remembering(memory: Memory) -> Self {
        Self {
            memory,
            slot: WorkspaceSlot::default(),
        }
    }

    /// The memory between two ticks.
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

    /// Returns the workspace to `slot`, unless it has computed with numbers that are not `finite`: they must not reach
    /// another figure.
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

    /// Makes the modern controller forget the last tick; may be called during a tick or between two.
    pub fn reset_modern(&mut self) {
        match &mut self.slot.0 {
            Some(workspace) => workspace.controllers.modern.reset(),
            None => self.memory.modern.reset(),
        }
    }

    /// Makes the controllers forget the last tick; may be called during a tick or between two.
    pub fn reset_controllers(&mut self) {
        self.reset_modern();
        match &mut self.slot.0 {
            Some(workspace) => workspace.controllers.paper.reset(),
            None => self.memory.paper.reset(),
        }
    }

    /// Resets the force of a bar between two hands to zero; may be called during a tick or between two.
    pub fn forget_bar(&mut self) {
        match &mut self.slot.0 {
            Some(workspace) => workspace.steppers.torque.remember(0.0, Vec3::zero()),
            None => {
                let steppers = &mut self.memory.steppers;
                (steppers.bar_impulse, steppers.bar_force) = (0.0, Vec3::zero());
            }
        }
    }

    /// Makes prescribed accelerations forget the place of their support; may be called during a tick or between two.
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
