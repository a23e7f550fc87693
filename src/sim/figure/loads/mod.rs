//! The loads of a figure: those that act and how they are shared, the hand that helps, and the posture that compensates
//! for them.

pub(in crate::figure) mod compensation;
pub mod disturbances;
pub(in crate::figure) mod second_hand;
