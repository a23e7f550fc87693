//! Stage 6 of figures that are near something: the world solves substep by substep for all of them together
//! (`world::collisions`).

use super::{Figure, Integration, TickContext};
use crate::sim::body::topology::NV;
use crate::sim::collide::island::{Articulated, Parts};
use crate::sim::contact::Outcome;
use crate::sim::figure::FigureKey;
use crate::sim::figure::touches::Contacting;

impl Articulated for (FigureKey, Box<Figure>) {
    fn parts(&mut self) -> Parts<'_> {
        self.1.steppers.torque.parts()
    }
}

impl Figure {
    /// True if accelerations move it in this tick, whatever it meets.
    pub(crate) fn is_prescribed(&self) -> bool {
        self.stepping.prescribed
    }
    /// Something will be met, and contact acts by forces: torques take over before the tick begins.
    pub(crate) fn hand_over(&mut self) {
        self.stepping.prescribed = false;
        self.stepping.handed_over = Some(0.0);
    }
    /// Shows where the segments are before it is known which stepper moves them.
    pub(crate) fn show(&mut self) {
        self.steppers.torque.terms.clone_from(&self.scratch.terms);
    }

    /// Starts the tick.
    pub(crate) fn begin_substeps(&mut self) {
        self.steppers.kinematic.reset();
        self.steppers.torque.begin(&self.physical.state);
        self.surroundings.touches.begin();
    }
    /// Substep `i` as if nothing but the ground were touched.
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
    pub(crate) fn touch(&mut self, impulse: [f64; NV], outcome: Outcome) {
        self.steppers.torque.touch(impulse, outcome);
    }
    /// One contact of the substep, with its impulse on this figure.
    pub(crate) fn record(&mut self, what: &Contacting, h: f64, dt: f64) {
        self.steppers
            .torque
            .push(what.segment, what.position, what.impulse * (1.0 / h));
        self.surroundings
            .touches
            .add(&self.steppers.torque.terms, what, dt);
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
