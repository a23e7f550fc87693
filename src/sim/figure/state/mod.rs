//! The state of a figure: its parts, the workspace that it borrows for a tick, its form in a checkpoint, and its public
//! face.

mod access;
pub(in crate::figure) mod controllers;
pub(in crate::figure) mod figure;
pub(in crate::figure) mod parts;
pub(crate) mod saved;
pub(crate) mod workspace;

pub use figure::{Figure, FigureKey};
