//! The part of a tick that moves a body: from a motor command and the forces on the body to its next state.
//!
//! `command` is the input of every stepper and `forces` its result. [`torque_step`] solves each substep for motors,
//! joint limits, contact with the ground, the body's contact with itself (`self_contact`), a bar between two hands,
//! and the wrench that may act on the pelvis (`pelvis_wrench`). The paper's stepper is
//! [`prescribed_step`](crate::paper::prescribed_step).

pub mod command;
pub mod forces;
pub mod motor_law;
pub mod params;
pub mod pelvis_wrench;
pub mod self_contact;
pub mod torque_step;
