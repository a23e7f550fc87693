//! Angular momentum that is to be reached, as at lift-off.
//!
//! Nothing changes the angular momentum of a body in the air: a little too much of it turns the trunk by tens of
//! degrees until the landing. And the posture asks for too much: a foot that is held on the floor to the last, while
//! the pelvis already goes its way, makes the legs of the motion spin up and stop again within a few samples. So for
//! the last moments the momentum itself is a task, ahead of what joints are to do.

use super::{Modern, TaskRow};
use crate::control::ControlInput;

/// The task comes in over this time before the momentum is to be reached, s.
const BEFORE: f64 = 0.15;
/// Shortest time in which it is to be reached, s.
const LEAST: f64 = 0.03;
/// Its weight at the end, 1/(N·m)²: 1 N·m counts as much as 0.1 m/s² of the centre of mass.
const WEIGHT: f64 = 10.0;

impl Modern {
    /// Rows of the angular momentum `L`: `L̇ = (L_target − L)/t`, with the time `t` that is left.
    pub(super) fn momentum_task(&mut self, input: &ControlInput<'_>) {
        let momentum = input.centroidal.momentum;
        let Some(target) = momentum.filter(|m| m.within < BEFORE) else {
            return;
        };
        let (rows, bias) = input.terms.spin_rows();
        let weight = WEIGHT * (1.0 - target.within / BEFORE);
        let time = target.within.max(LEAST);
        let goals = target.value.to_array().into_iter().zip(bias.to_array());
        for (row, (goal, bias)) in rows.into_iter().zip(goals) {
            let velocity = &input.terms.state.velocity;
            let now: f64 = row.iter().zip(velocity).map(|(a, v)| a * v).sum();
            let value = (goal - now) / time - bias;
            self.rows.push(TaskRow { row, weight, value });
        }
    }
}
