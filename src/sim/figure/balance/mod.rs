//! The balance of a figure: whether it is lost, the arms that brace a fall, and help while a motion is being lost.

pub(in crate::figure) mod bracing;
pub mod live_help;
pub mod loss;
