//! A real client against the server in this process, on a port of the system's choice.
#![cfg(feature = "net")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

mod clips;
mod constraints;
mod drives;
mod forecast;
mod live;
#[allow(dead_code)] // the list of clips
#[path = "../common/mocap.rs"]
mod mocap;
mod obstacles;
mod support;
mod watching;
mod wire_faults;
mod worlds;
