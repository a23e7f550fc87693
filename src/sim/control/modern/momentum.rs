//! Angular momentum that must be reached, as at lift-off.
//!
//! Nothing changes the angular momentum of a body in the air: a small excess turns the trunk by tens of degrees until
//! the landing. And the posture asks for too much: a foot that is held on the floor until the end, while the pelvis
//! already moves away, makes the legs of the motion spin up and stop again within a few samples. So during the last
//! moments the momentum itself is a task, with precedence over the joints.

use super::{Modern, TaskRow};
use crate::control::ControlInput;

/// The task fades in over this time before the momentum must be reached, s.
const BEFORE: f64 = 0.15;
/// Shortest time in which it must be reached, s.
const LEAST: f64 = 0.03;
/// Its weight at the end, 1/(N·m)²: 1 N·m counts as much as 0.1 m/s² of the centre of mass.
const WEIGHT: f64 = 10.0;

impl Modern {
    /// Rows of the angular momentum `L`: `L̇ = (L_target − L)/t`, with the remaining time `t`.
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
