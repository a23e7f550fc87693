//! Whole figures and worlds against laws of motion, independent algorithms and each other.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

mod acceptance;
mod checkpoints;
#[path = "../common/mod.rs"]
mod common;
mod determinism;
mod oracle;
mod rehearsal;
mod soak;
