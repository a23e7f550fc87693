//! What a body takes along into the air.
//!
//! Nothing changes the angular momentum of who flies: a little too much of it at take-off turns the trunk by tens of
//! degrees until he lands. And the motion asks for too much: a foot that is held on the floor to the last, while the
//! pelvis already goes its way, makes the legs of the motion spin up and stop again within a few samples. So for the
//! last moments on the floor the momentum itself is a task, ahead of what joints are to do.

use super::{Modern, TaskRow};
use crate::sim::control::ControlInput;

/// The task comes in over this time before take-off, s.
const BEFORE: f64 = 0.15;
/// Shortest time in which the momentum is to be reached, s.
const LEAST: f64 = 0.03;
/// Its weight at take-off, 1/(N·m)²: 1 N·m counts as much as 0.1 m/s² of the centre of mass.
const WEIGHT: f64 = 10.0;

impl Modern {
    /// Rows of the angular momentum with which the body is to leave the floor: `L̇ = (L_flight − L)/t`, t the time that
    /// is left.
    pub(super) fn take_off_task(&mut self, input: &ControlInput<'_>) {
        let Some(flight) = input.take_off.filter(|f| f.after < BEFORE) else {
            return;
        };
        let (rows, bias) = input.terms.spin_rows();
        let weight = WEIGHT * (1.0 - flight.after / BEFORE);
        let time = flight.after.max(LEAST);
        let goals = flight.spin.to_array().into_iter().zip(bias.to_array());
        for (row, (spin, bias)) in rows.into_iter().zip(goals) {
            let velocity = &input.terms.state.velocity;
            let now: f64 = row.iter().zip(velocity).map(|(a, v)| a * v).sum();
            let value = (spin - now) / time - bias;
            self.rows.push(TaskRow { row, weight, value });
        }
    }
}
