//! From a stand into a stream that begins in motion. The way is planned in the background, and taken in a tick that is
//! fixed when it is requested; the caller that feeds the stream puts it before the stream's first sample.

use crate::body::Posture;
use crate::figure::motion::stream_entry::{StreamEntryPlan, StreamEntryProblem};
use crate::figure::params::switch::MOST_LEAD;
use crate::figure::state::figure::Figure;
use crate::plan::motion_transition::{StreamBeginning, StreamEntry};
use crate::plan::splice;
use crate::tick_context::Planning;
use crate::tick_context::TickContext;
use crate::time::WorldTime;

impl Figure {
    /// Whether it stands and can be led into a stream by steps.
    pub fn can_be_led(&self) -> bool {
        self.steps() && !self.crouches()
    }

    /// Begins to work out the way from its stand into a stream, at world time `time`.
    ///
    /// * `came`: the beginning of the stream, as [`StreamBeginning::new`] takes it, in its own place.
    pub fn plan_stream_entry(&mut self, came: Vec<(Posture, Option<[bool; 2]>)>, time: WorldTime) {
        let stand = self.desired.target.next.posture;
        self.motion.plan_stream_entry(
            StreamEntryProblem {
                beginning: StreamBeginning::new(&self.setup.body, came, stand),
                // It stands in the meantime: only time is lost.
                due: time + MOST_LEAD as f64 / splice::RATE,
                settled: false,
            }
            .into(),
        );
    }

    /// Whether the way into a stream is being planned.
    pub fn plans_stream_entry(&self) -> bool {
        self.motion.stream_entry().is_some()
    }

    /// The way into a stream, once it has been worked out: `Some(None)` if there is none.
    pub fn take_stream_entry(&mut self) -> Option<Option<StreamEntry>> {
        self.motion
            .stream_entry()
            .filter(|entry| entry.problem.settled)?;
        Some(self.motion.take_stream_entry()?.task.take())
    }

    /// Lets the way into a stream be taken when it is due. A tick that does not wait for plans postpones that.
    pub(in crate::figure) fn settle_stream_entry_if_due(&mut self, world: &TickContext) {
        let open = |e: &&StreamEntryPlan| !e.problem.settled;
        let Some(entry) = self.motion.stream_entry().filter(open) else {
            return;
        };
        if world.time() + world.dt <= entry.problem.due + 1e-9 {
            return;
        }
        let missing = world.planning == Planning::Aside && !entry.task.is_ready();
        if missing || self.outcome.told_late.entry {
            self.outcome.late.entry = true;
            let due = world.time() + MOST_LEAD as f64 / splice::RATE;
            self.motion.update_stream_entry(|e| e.problem.due = due);
            return;
        }
        entry.task.settle();
        self.motion
            .update_stream_entry(|e| e.problem.settled = true);
    }
}
