//! The exit from a motion: the plan that leads from it to another clip or to a stand.

use crate::body::Posture;
use crate::figure::motion::plan_task::{PlanRequest, PlanTask};
use crate::figure::params::switch::MOST_LEAD;
use crate::motion::clip::{Clip, PlanarTransform};
use crate::plan::motion_transition::{TransitionCandidates, TransitionClip};
use crate::plan::splice::StopCandidates;
use crate::time::WorldTime;
use serde::{Deserialize, Serialize, Serializer};
use std::sync::Arc;

/// A way to a stand, with its demand on the ground.
pub(in crate::figure) type StopWay = Option<(f64, Clip)>;
/// A way into a clip, and the resulting place of the clip's origin.
pub(in crate::figure) type ClipWay = Option<(TransitionClip, PlanarTransform)>;

/// The goal of an exit from the motion.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct ExitGoal {
    /// The posture in which the figure should stand if it hardly moves, or cannot reach the clip by steps; at ease if
    /// `None`.
    pub posture: Option<Posture>,
    /// The clip's origin is fixed: the figure may not start it from its present place.
    pub fixed: bool,
    /// The clip does not begin before this time.
    pub from: WorldTime,
}

/// The exit from a motion, while it is being planned.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "ExitProblem")]
pub(in crate::figure) struct ExitPlan {
    pub(in crate::figure) problem: ExitProblem,
    /// To the queued clip, best first.
    pub(in crate::figure) over: Vec<PlanTask<ClipWay>>,
    /// To a stand.
    pub(in crate::figure) stops: Vec<PlanTask<StopWay>>,
    /// To a stand like the beginning of the next clip, if there is no such way.
    pub(in crate::figure) last_resort: Option<PlanTask<Option<Clip>>>,
}

/// The input from which [`ExitPlan`] is planned.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct ExitProblem {
    pub goal: ExitGoal,
    /// Number of samples that were available for planning.
    pub lead: usize,
    /// The ways to the queued clip, if there are any.
    pub ways: Option<Arc<TransitionCandidates>>,
    /// When the first sample of these plays.
    pub known_from: WorldTime,
    /// The ways to a stand, if the motion should end.
    pub ends: Option<Arc<StopCandidates>>,
    /// When the motion leaves its own course for the exit.
    pub due: WorldTime,
    /// When the first sample of the way to a stand plays, and the time of the present motion's plan then, s.
    pub begin: WorldTime,
    pub before: f64,
}

impl ExitPlan {
    /// All pending plans, the most urgent first.
    pub fn requests(&self) -> impl Iterator<Item = PlanRequest> + '_ {
        let over = self.over.iter().filter_map(|t| t.request());
        let ends = self.stops.iter().filter_map(|t| t.request());
        let last = self.last_resort.iter().filter_map(|t| t.request());
        over.chain(ends).chain(last)
    }

    /// Whether everything that the decision needs has been worked out.
    pub fn is_ready(&self) -> bool {
        for way in &self.over {
            match way.result() {
                Some(Some(_)) => return true,
                _ if way.is_ready() => {}
                _ => return false,
            }
        }
        let found = |end: &PlanTask<StopWay>| matches!(end.result(), Some(Some(_)));
        self.stops.iter().all(PlanTask::is_ready)
            && (self.stops.iter().any(found)
                || self.last_resort.as_ref().is_none_or(PlanTask::is_ready))
    }

    /// Whether it may lead to the queued clip.
    pub fn leads_over(&self) -> bool {
        !self.over.is_empty()
    }
}

impl ExitProblem {
    pub fn at(due: WorldTime, goal: ExitGoal, lead: usize) -> Self {
        Self {
            goal,
            lead,
            ways: None,
            known_from: WorldTime::default(),
            ends: None,
            due,
            begin: WorldTime::default(),
            before: 0.0,
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    fn is_valid(&self) -> bool {
        let times = [self.goal.from, self.known_from, self.due, self.begin];
        self.lead <= MOST_LEAD
            && times.iter().all(|t| t.is_finite())
            && self.before.is_finite()
            && self.ways.as_ref().is_none_or(|w| w.is_valid())
            && self.ends.as_ref().is_none_or(|e| e.is_valid())
    }
}

impl TryFrom<ExitProblem> for ExitPlan {
    type Error = &'static str;

    /// Built from a problem that was read from a checkpoint.
    fn try_from(problem: ExitProblem) -> Result<Self, Self::Error> {
        if problem.is_valid() {
            Ok(Self::of(problem))
        } else {
            Err("an exit from a motion that cannot be")
        }
    }
}

impl ExitPlan {
    pub fn of(problem: ExitProblem) -> Self {
        let ways = problem.ways.as_ref();
        let over = |k| {
            let ways = Arc::clone(ways?);
            Some(PlanTask::new(move || ways.way(k)))
        };
        let count = ways.map_or(0, |w| w.moments().len());
        let over = (0..count).filter_map(over).collect();
        let Some(ends) = &problem.ends else {
            return Self {
                over,
                stops: Vec::new(),
                last_resort: None,
                problem,
            };
        };
        // Ends are left out if there is a way to the clip.
        let end = |k| {
            let (ends, ways) = (Arc::clone(ends), ways.cloned());
            PlanTask::new(move || {
                let needed = ways.as_ref().is_none_or(|w| !w.found());
                needed.then(|| ends.end(k)).flatten()
            })
        };
        let stops: Vec<_> = (0..StopCandidates::MOST).map(end).collect();
        let posture = problem.goal.posture.filter(|_| !ends.have_goal());
        let last_resort = posture.map(|posture| {
            let (ends, ways, stops) = (Arc::clone(ends), ways.cloned(), stops.clone());
            PlanTask::new(move || {
                let found = stops.iter().any(|e| matches!(e.result(), Some(Some(_))));
                if found || ways.as_ref().is_some_and(|w| w.found()) {
                    return None;
                }
                ends.like(posture)
            })
        });
        Self {
            over,
            stops,
            last_resort,
            problem,
        }
    }
}

impl Serialize for ExitPlan {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.problem.serialize(to)
    }
}
