//! The outside view of a figure: its properties, its activity, and changes between ticks.

use crate::body::topology::{DOF_COUNT, NV};
use crate::body::{Body, Links, SegmentId, State};
use crate::collide::shape::BodyShape;
use crate::dynamics::{Dynamics, Placement};
use crate::figure::constraints::Constraint;
use crate::figure::events::FigureEvent;
use crate::figure::loads::disturbances::LoadShare;
use crate::figure::loads::second_hand::HelpingHand;
use crate::figure::motion::exit::ExitPlan;
use crate::figure::motion::following::Following;
use crate::figure::motion::plan_task::{LatePlans, PlanRequest};
use crate::figure::motion::source::{LivePlayback, MotionSource, QueuedClip};
use crate::figure::motion::stream_entry::StreamEntryPlan;
use crate::figure::motion::tasks::TaskWorkspace;
use crate::figure::state::figure::Figure;
use crate::figure::state::parts::rested;
use crate::figure::touches::Touches;
use crate::math::Vec3;
use crate::motion::{PlanarTransform, TargetPair};
use crate::report::TickReport;
use crate::setup::{
    ControlParams, ControllerKind, FigureOptions, FigureSetup, Perturbation, StrengthScale,
};
use crate::strength::fatigue::Fatigue;
use crate::strength::{MuscleScale, Strength};
use crate::time::WorldTime;
use crate::track::{PlacedPlan, StepPlan, StepTracker};
use std::sync::Arc;

impl Figure {
    /// Display name.
    pub fn name(&self) -> &str {
        &self.setup.name
    }
    /// The body.
    pub fn body(&self) -> &Arc<Body> {
        &self.setup.body
    }
    /// Its setup, with later changes.
    pub fn setup(&self) -> &FigureSetup {
        &self.setup
    }
    /// Strength curves of the body.
    pub fn strength(&self) -> &Strength {
        &self.constants.strength
    }
    /// Factors on its muscles in the last tick: scale, effort, fatigue, and relaxation of a fallen figure.
    pub fn muscles(&self) -> &MuscleScale {
        &self.physical.muscles
    }
    /// Fatigue, if it is on.
    pub fn fatigue(&self) -> Option<&Fatigue> {
        self.physical.fatigue.as_deref()
    }
    /// State after the last tick.
    pub fn state(&self) -> &State {
        &self.physical.state
    }
    /// Mass properties with the present loads.
    pub fn links(&self) -> &Links {
        &self.physical.links
    }
    /// Report of the last tick; `None` before the first.
    pub fn report(&self) -> Option<&TickReport> {
        self.outcome.reported.then_some(&self.outcome.report)
    }
    /// Desired motion of the last tick.
    pub fn target(&self) -> &TargetPair {
        &self.desired.target
    }
    /// The shapes it collides with.
    pub fn shape(&self) -> &BodyShape {
        &self.constants.shape
    }
    /// Whether it is frozen after an error.
    pub(crate) fn is_frozen(&self) -> bool {
        self.physical.frozen
    }
    /// Poses of its segments in the present substep.
    pub(crate) fn substep_dynamics(&self) -> &Dynamics {
        &self.workspace.steppers.torque.dynamics
    }
    /// Poses of its segments at the start of the tick.
    pub(crate) fn placement(&self) -> &Placement {
        &self.scratch.placement
    }
    /// Events of the last tick.
    pub fn events(&self) -> &[FigureEvent] {
        self.outcome.watcher.events()
    }
    /// Problems to be planned that no thread has accepted.
    pub(crate) fn plan_requests(&self) -> impl Iterator<Item = PlanRequest> + '_ {
        let exit = self.motion.exit().into_iter().flat_map(ExitPlan::requests);
        let entry = self.motion.next().and_then(QueuedClip::request);
        let stream = self.motion.stream_entry();
        exit.chain(entry)
            .chain(stream.and_then(StreamEntryPlan::request))
    }
    /// Plans that the last tick needed and that were missing.
    pub fn late_plans(&self) -> LatePlans {
        self.outcome.late
    }
    /// Makes the next tick do without these plans, as if they were late: a replay repeats the decisions of threads.
    pub(crate) fn delay_plans(&mut self, late: LatePlans) {
        self.outcome.told_late = late;
    }
    /// Name of the stage of getting up, while it gets up.
    pub fn rising(&self) -> Option<&'static str> {
        self.motion.gets_up().then(|| self.desired.get_up.stage())
    }
    /// Whether it has fallen and not yet stood up again.
    pub fn is_fallen(&self) -> bool {
        self.motion.has_fallen()
    }
    /// The source of the desired motion.
    pub fn drive(&self) -> &MotionSource {
        self.motion.source()
    }
    /// How it followed its motion in the last tick.
    pub fn following(&self) -> &Following {
        self.motion.following()
    }
    /// Replaces the source of the desired motion from the next tick on, whatever the present activity. Queued motions
    /// are forgotten.
    pub fn set_drive(&mut self, drive: MotionSource) {
        self.desired.tracker.follow(match &drive {
            MotionSource::Clip(play) => {
                let body = &self.setup.body;
                let mut plan = StepPlan::new(body, &play.clip, play.looped);
                if let Some(way) = &play.way_in {
                    plan = plan.entered_by(body, way);
                }
                Some(PlacedPlan::new(plan, play.speed, play.origin))
            }
            MotionSource::Live(_) => {
                let here = PlanarTransform::default();
                Some(PlacedPlan::new(StepPlan::live(), 1.0, here))
            }
            _ => None,
        });
        self.desired.get_up.reset();
        self.motion.follow(drive);
    }
    /// The windowed stream that drives it, if there is one, so that the caller can feed it. A stream that is being
    /// stopped counts as ended.
    pub fn stream_mut(&mut self) -> Option<&mut LivePlayback> {
        let stops = self.motion.exit().is_some();
        match self.motion.source_mut() {
            MotionSource::Live(live) if !stops => Some(live),
            _ => None,
        }
    }
    /// Its steps.
    pub fn tracker(&self) -> &StepTracker {
        &self.desired.tracker
    }
    /// Scheduled perturbations.
    pub fn perturbations(&self) -> impl Iterator<Item = &Perturbation> {
        self.surroundings.disturbances.scheduled()
    }
    /// The loads that segments hold at `time`: segment, point (segment frame, m), mass (kg). A load in two hands
    /// appears twice, with the share of each.
    pub fn held(&self, time: WorldTime) -> impl Iterator<Item = (SegmentId, Vec3, f64)> + '_ {
        self.surroundings.disturbances.held(time.0)
    }
    /// The other hand's part in a load, while it holds it.
    pub fn help(&self) -> Option<LoadShare> {
        self.surroundings.disturbances.present_help()
    }
    /// Releases all loads and stops all pushes at the next tick.
    pub fn clear_perturbations(&mut self) {
        self.surroundings.disturbances.clear();
    }
    /// Schedules a checked perturbation; returns `false` without room for it.
    pub(crate) fn schedule(&mut self, what: Perturbation) -> bool {
        self.surroundings.disturbances.add(what)
    }
    /// Puts the figure into a state and forgets its past; loads stay. A stop or transition that is being planned is
    /// followed at once, and worked out here if it is missing.
    pub fn reset(&mut self, state: State) {
        self.follow_exit();
        self.physical.state = state;
        self.neighbours.is_new = true;
        self.physical.last_good = state;
        self.motion.lie_down();
        self.motion.rise();
        self.motion.forget_following();
        self.physical.frozen = false;
        self.forget();
        self.physical.fatigue = rested(&self.setup.options);
        self.outcome.report.joints.remaining = [[1.0; 2]; DOF_COUNT];
        // The last tick's centre of mass belongs to another state. Loads that were removed go with the next tick.
        let links = self.surroundings.disturbances.loaded(&self.setup.body);
        (
            self.outcome.report.balance.com,
            self.outcome.report.balance.com_velocity,
        ) = TaskWorkspace::default().center_of_mass(&links, &state);
    }
    /// Forgets everything that passes from tick to tick except state, motion and fatigue.
    pub(in crate::figure) fn forget(&mut self) {
        self.desired.get_up.reset();
        self.desired.tracker.reset();
        self.desired.load_compensation.reset();
        self.desired.second_hand = HelpingHand::default();
        self.surroundings.disturbances.stop_help();
        self.physical.com_acceleration = Vec3::zero();
        self.outcome.report.audit.acceleration = [0.0; NV];
        self.surroundings.support.reset();
        self.surroundings.touches = Touches::default();
        self.workspace.reset_controllers();
        self.workspace.reset_anchor();
        self.stepping.forget();
        self.surroundings.balance.reset();
    }
    /// Changes the scale of its strength. Another percentile makes new curves: about 20 µs, allocates.
    pub fn set_strength(&mut self, scale: StrengthScale) {
        if scale.percentile != self.setup.strength.percentile {
            self.constants.strength =
                Arc::new(Strength::at_percentile(&self.setup.body, scale.percentile));
        }
        self.setup.strength = scale;
    }
    /// Changes fatigue and assist. Fatigue that stays on keeps its state; when turned off it is forgotten.
    pub fn set_options(&mut self, options: FigureOptions) {
        match (&mut self.physical.fatigue, options.fatigue_time_scale > 0.0) {
            (Some(fatigue), true) => fatigue.time_scale = options.fatigue_time_scale,
            (fatigue, _) => {
                *fatigue = rested(&options);
                self.outcome.report.joints.remaining = [[1.0; 2]; DOF_COUNT];
            }
        }
        self.setup.options = options;
    }
    /// Constraints that a client set, in order; those that have ended are gone.
    pub fn constraints(&self) -> &[Constraint] {
        self.desired.constraints.given()
    }
    /// Replaces all checked constraints at `time`.
    pub(crate) fn set_constraints(&mut self, constraints: &[Constraint], time: WorldTime) {
        self.desired.constraints.replace(constraints, time.0);
    }
    /// Removes all constraints at once, without fading.
    pub fn clear_constraints(&mut self) {
        self.desired.constraints.forget();
    }
    /// Changes controller and gains.
    pub fn set_controller(&mut self, controller: ControllerKind, params: ControlParams) {
        if controller != self.setup.controller {
            self.workspace.reset_controllers();
        }
        self.setup.controller = controller;
        self.setup.params = params;
    }
    /// Hash of the state's bits (64-bit FNV-1a over little-endian words).
    pub fn state_hash(&self) -> u64 {
        let mut h = crate::math::hash::Fnv::default();
        let p = &self.physical.state.posture;
        h.f64s(&p.root_position.to_array());
        h.f64s(&p.root_rotation.to_xyzw());
        for q in &p.ball {
            h.f64s(&q.to_xyzw());
        }
        h.f64s(&p.hinge);
        h.f64s(&self.physical.state.velocity);
        if let Some(fatigue) = &self.physical.fatigue {
            fatigue.add_to(&mut h);
        }
        h.finish()
    }
}
