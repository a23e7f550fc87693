//! The plan that leads from a stand into a stream that begins in motion.

use crate::figure::motion::plan_task::{PlanRequest, PlanTask};
use crate::plan::motion_transition::{StreamBeginning, StreamEntry};
use crate::time::WorldTime;
use serde::{Deserialize, Serialize, Serializer};

/// The way into a stream, while it is being planned.
#[derive(Clone, Debug, Deserialize)]
#[serde(from = "StreamEntryProblem")]
pub(in crate::figure) struct StreamEntryPlan {
    pub problem: StreamEntryProblem,
    pub task: PlanTask<Option<StreamEntry>>,
}

/// The input from which it is planned.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct StreamEntryProblem {
    pub beginning: StreamBeginning,
    /// When it is taken.
    pub due: WorldTime,
    /// Whether it can be taken.
    pub settled: bool,
}

impl From<StreamEntryProblem> for StreamEntryPlan {
    fn from(problem: StreamEntryProblem) -> Self {
        let beginning = problem.beginning.clone();
        Self {
            problem,
            task: PlanTask::new(move || beginning.way()),
        }
    }
}

impl Serialize for StreamEntryPlan {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.problem.serialize(to)
    }
}

impl StreamEntryPlan {
    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        self.problem.due.is_finite() && self.problem.beginning.is_valid()
    }

    /// Requests the way.
    pub fn request(&self) -> Option<PlanRequest> {
        self.task.request()
    }
}
