//! A figure as it is written into a checkpoint, and restored from one.
//!
//! Everything that passes from tick to tick is written. Buffers, and values that follow from the body, are made again.

use crate::body::State;
use crate::dynamics::Terms;
use crate::figure::motion::activity::MotionState;
use crate::figure::motion::source::MotionSource;
use crate::figure::state::figure::Figure;
use crate::figure::state::parts::{
    BodyConstants, DesiredMotion, Neighbours, PhysicalState, Scratch, Surroundings, TickOutcome,
};
use crate::figure::state::workspace::{Loan, Memory};
use crate::paper::hand_over::HandOver;
use crate::setup::FigureSetup;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The parts of a figure that pass from tick to tick.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct SavedFigure<'a> {
    pub setup: Cow<'a, FigureSetup>,
    physical: Cow<'a, PhysicalState>,
    motion: Cow<'a, MotionState>,
    desired: Cow<'a, DesiredMotion>,
    surroundings: Cow<'a, Surroundings>,
    stepping: HandOver,
    memory: Cow<'a, Memory>,
    outcome: Cow<'a, TickOutcome>,
    /// State at the start of the last tick: commands read its dynamics.
    before: Cow<'a, State>,
    /// Whether it was put in its place since the last tick.
    is_new: bool,
}

impl Figure {
    /// Everything that passes on to the next tick. Every part is named here, so that a new part cannot be forgotten.
    pub(crate) fn saved(&self) -> SavedFigure<'_> {
        let Self {
            setup,
            constants: _, // follows from the setup
            physical,
            motion,
            desired,
            surroundings,
            stepping,
            workspace,
            scratch,
            outcome,
            neighbours:
                Neighbours {
                    cluster: _,
                    moved_alone: _,
                    is_new,
                },
        } = self;
        SavedFigure {
            setup: Cow::Borrowed(setup),
            physical: Cow::Borrowed(physical),
            motion: Cow::Borrowed(motion),
            desired: Cow::Borrowed(desired),
            surroundings: Cow::Borrowed(surroundings),
            stepping: *stepping,
            memory: Cow::Borrowed(workspace.memory()),
            outcome: Cow::Borrowed(outcome),
            before: Cow::Borrowed(&scratch.results.before),
            is_new: *is_new,
        }
    }

    /// The figure that [`Self::saved`] described, in a world with this gravity (m/s²). The setup was checked.
    ///
    /// # Errors
    /// Fails for values that no checkpoint could hold.
    pub(crate) fn restored(saved: SavedFigure<'_>, gravity: f64) -> Result<Self, &'static str> {
        let SavedFigure {
            setup,
            physical,
            motion,
            desired,
            surroundings,
            stepping,
            memory,
            outcome,
            before,
            is_new,
        } = saved;
        let setup = setup.into_owned();
        let physical = physical.into_owned();
        if !(physical.state.is_valid() && physical.last_good.is_valid() && before.is_valid()) {
            return Err("a state that no body has");
        }
        if !physical.links.is_valid() {
            return Err("masses that no body has");
        }
        if !physical.fatigue.as_ref().is_none_or(|f| f.is_valid()) {
            return Err("fatigue that no muscle has");
        }
        let mut motion = motion.into_owned();
        if let MotionSource::Live(live) = motion.source_mut()
            && !live.motion.complete()
        {
            return Err("a stream that cannot be");
        }
        if !motion.is_valid() {
            return Err("a motion that cannot be");
        }
        let mut desired = desired.into_owned();
        desired.tracker.complete(&setup.body);
        if !(desired.tracker.is_valid() && desired.get_up.is_valid()) {
            return Err("steps or a way of getting up that cannot be");
        }
        if !(desired.second_hand.is_valid() && desired.load_compensation.is_valid()) {
            return Err("loads, or a hand that helps with one, that cannot be");
        }
        let surroundings = surroundings.into_owned();
        let counts = surroundings.touches.is_valid() && surroundings.disturbances.is_valid();
        if !surroundings.help.is_valid() {
            return Err("help that cannot be");
        }
        if !(counts && desired.constraints.is_valid()) {
            return Err("more touches, perturbations or constraints than a figure can have");
        }
        let memory = memory.into_owned();
        if !memory.modern.is_valid() {
            return Err("torques or forces that cannot be");
        }
        let outcome = outcome.into_owned();
        let mut scratch = Scratch::new(&setup);
        scratch.results.before = before.into_owned();
        if outcome.reported {
            let state = &scratch.results.before;
            scratch.placement.set_state(&physical.links, state);
            let mut terms = Terms::default();
            terms.compute_placed(&physical.links, &scratch.placement, &[], gravity);
            scratch.com_velocity = terms.com_velocity;
        }
        Ok(Self {
            constants: BodyConstants::new(&setup.body, &setup.strength),
            physical,
            motion,
            desired,
            surroundings,
            stepping,
            workspace: Loan::remembering(memory),
            scratch,
            outcome,
            neighbours: Neighbours {
                cluster: 0,
                moved_alone: false,
                is_new,
            },
            setup,
        })
    }
}
