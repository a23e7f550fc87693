//! A figure: everything that passes from tick to tick, and the results that its stages pass on.

use crate::figure::constraints::MAX_CONSTRAINTS;
use crate::figure::events::Watcher;
use crate::figure::motion::activity::MotionState;
use crate::figure::motion::plan_task::LatePlans;
use crate::figure::state::parts::TickOutcome;
use crate::figure::state::parts::{
    BodyConstants, DesiredMotion, Neighbours, PhysicalState, Scratch, Surroundings,
};
use crate::figure::state::workspace::Loan;
use crate::paper::hand_over::HandOver;
use crate::report::TickReport;
use crate::setup::FigureSetup;
use crate::stepper::forces::MAX_APPLIED;
use serde::{Deserialize, Serialize};

/// Identity of a figure in a world; never used again after removal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FigureKey(pub u64);

/// One figure of a world.
#[derive(Debug)]
pub struct Figure {
    /// Its setup, with later changes.
    pub(in crate::figure) setup: FigureSetup,
    pub(in crate::figure) constants: BodyConstants,
    pub(in crate::figure) physical: PhysicalState,
    pub(in crate::figure) motion: MotionState,
    pub(in crate::figure) desired: DesiredMotion,
    pub(in crate::figure) surroundings: Surroundings,
    pub(in crate::figure) stepping: HandOver,
    pub(in crate::figure) workspace: Loan,
    pub(in crate::figure) scratch: Scratch,
    pub(in crate::figure) outcome: TickOutcome,
    pub(crate) neighbours: Neighbours,
}

impl Figure {
    /// A figure whose setup the world has validated.
    pub(crate) fn new(setup: FigureSetup) -> Self {
        Self {
            constants: BodyConstants::new(&setup.body, &setup.strength),
            physical: PhysicalState::new(&setup),
            motion: MotionState::hold(setup.state.posture),
            desired: DesiredMotion::new(&setup),
            surroundings: Surroundings::default(),
            stepping: HandOver::default(),
            workspace: Loan::default(),
            scratch: Scratch::new(&setup),
            outcome: TickOutcome {
                report: TickReport::empty(&setup.state, MAX_CONSTRAINTS, MAX_APPLIED),
                reported: false,
                watcher: Watcher::default(),
                late: LatePlans::default(),
                told_late: LatePlans::default(),
            },
            neighbours: Neighbours {
                cluster: 0,
                moved_alone: false,
                is_new: true,
            },
            setup,
        }
    }
}
