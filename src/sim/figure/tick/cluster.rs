//! Stage 6 of figures that are near something: the world solves substep by substep for all of them together
//! (`world::collisions`).

use crate::body::SegmentId;
use crate::body::topology::{L_FOOT, NV, R_FOOT};
use crate::collide::island::{Articulated, ArticulatedParts};
use crate::contact::SolveOutcome;
use crate::figure::state::figure::Figure;
use crate::figure::state::figure::FigureKey;
use crate::figure::state::workspace::Workspace;
use crate::figure::tick::Integration;
use crate::figure::touches::Contacting;
use crate::math::Vec3;
use crate::report::Flags;
use crate::setup::StepperKind;
use crate::tick_context::TickContext;

impl Articulated for (FigureKey, Box<Figure>) {
    fn parts(&mut self) -> ArticulatedParts<'_> {
        self.1.workspace.steppers.torque.parts()
    }
}

impl Figure {
    /// Whether accelerations move it in this tick, regardless of collisions.
    pub(crate) fn is_prescribed(&self) -> bool {
        self.stepping.is_prescribed()
    }
    /// Whether its collisions in this tick are resolved in the two stages of §3 of the paper.
    pub(crate) fn meets_in_stages(&self) -> bool {
        self.stepping.is_prescribed() && self.setup.stepper == StepperKind::Staged
    }
    /// Moves as if it were alone; [`Self::moved_alone`] reports this until the end of the tick.
    pub(crate) fn integrate_alone(&mut self, world: &TickContext) {
        self.integrate(world);
        self.neighbours.moved_alone = true;
    }
    /// Whether it has moved in this tick: by its accelerations, or by torques that had to take over.
    pub(crate) fn moved_alone(&self) -> bool {
        self.neighbours.moved_alone
    }
    /// Shows the poses of the segments after the move.
    pub(crate) fn show_moved(&mut self, world: &TickContext) {
        let applied = self.surroundings.disturbances.applied();
        self.workspace.steppers.torque.dynamics.compute(
            &self.physical.links,
            &self.physical.state,
            applied,
            world.gravity,
        );
    }
    /// The parts that hold still in an impact: feet that lie flat and that the motion does not lift, as a whole, or the
    /// point about which the support tips.
    pub(crate) fn held_still(&self) -> [Option<(SegmentId, Option<Vec3>)>; 2] {
        let support = &self.surroundings.support;
        let controller = self.workspace.controllers.get(self.setup.controller);
        let command = controller.command();
        let Some(main) = support.main().filter(|_| !command.flags.has(Flags::FLIGHT)) else {
            return [None; 2];
        };
        if let Some(pivot) = command.pivot {
            return [Some((main, Some(pivot.point))), None];
        }
        let planted = self.desired.target.next.planted;
        let mut out = [Some((main, None)), None];
        for (foot, stays) in [(L_FOOT, planted[0]), (R_FOOT, planted[1])] {
            let flat = support
                .points()
                .iter()
                .filter(|p| p.support == foot)
                .count()
                >= 3;
            if foot != main && flat && stays {
                out[1] = Some((foot, None));
            }
        }
        out
    }
    /// Sets the velocity after an impact.
    pub(crate) fn set_velocity(&mut self, velocity: &[f64; NV]) {
        self.physical.state.velocity = *velocity;
    }
    /// Moves the posture by `change`, in the components of a velocity.
    pub(crate) fn correct(&mut self, change: &[f64; NV]) {
        self.physical.state.posture.integrate(change, 1.0);
    }
    /// One contact of an impact, with its impulse on this figure.
    pub(crate) fn record_impact(&mut self, what: &Contacting, dt: f64) {
        self.surroundings
            .touches
            .add(&self.workspace.steppers.torque.dynamics, what, dt);
    }

    /// A collision is coming, and contact acts by forces: torques take over before the tick begins.
    pub(crate) fn hand_over(&mut self) {
        self.stepping.take_over();
    }
    /// Shows the poses of the segments before it is known which stepper moves them.
    pub(crate) fn show(&mut self) {
        let Workspace {
            terms, steppers, ..
        } = &mut *self.workspace;
        steppers.torque.dynamics.clone_from(terms);
    }

    /// Starts the tick.
    pub(crate) fn begin_substeps(&mut self) {
        self.workspace.steppers.kinematic.reset();
        self.workspace.steppers.torque.begin(&self.physical.state);
        self.surroundings.touches.begin();
    }
    /// Opens substep `i` as if only the ground were touched.
    pub(crate) fn open_substep(&mut self, world: &TickContext, i: u32) {
        let Integration {
            input,
            torque,
            state,
            ..
        } = self.integration(world);
        torque.open_substep(&input, state, i);
    }
    /// Takes the impulse of an island in velocity components.
    pub(crate) fn touch(&mut self, impulse: [f64; NV], outcome: SolveOutcome) {
        self.workspace.steppers.torque.touch(impulse, outcome);
    }
    /// One contact of the substep, with its impulse on this figure.
    pub(crate) fn record(&mut self, what: &Contacting, h: f64, dt: f64) {
        self.workspace
            .steppers
            .torque
            .push(what.segment, what.position, what.impulse * (1.0 / h));
        self.surroundings
            .touches
            .add(&self.workspace.steppers.torque.dynamics, what, dt);
    }
    /// Closes substep `i` and moves.
    pub(crate) fn close_substep(&mut self, world: &TickContext, i: u32) {
        let Integration {
            input,
            torque,
            state,
            ..
        } = self.integration(world);
        torque.close_substep(&input, state, i);
    }
    /// Ends the tick.
    pub(crate) fn end_substeps(&mut self, world: &TickContext) {
        let Integration { input, torque, .. } = self.integration(world);
        torque.end(&input);
    }
}
