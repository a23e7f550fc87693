//! A real client against the server in this process, on a port of the system's choice.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

mod access;
mod checkpoints;
mod clips;
mod conformance;
mod constraints;
mod contract;
#[allow(dead_code)] // not every function
#[path = "../common/corpus.rs"]
mod corpus;
mod drives;
mod edge;
mod ending;
mod following;
mod forecast;
mod fuzz;
mod history;
mod life;
mod limits;
mod live;
mod long_work;
mod obstacles;
mod offline;
#[cfg(feature = "otlp")]
mod otlp;
mod pages;
#[path = "../common/raw.rs"]
mod raw;
mod reasons;
mod rehearsals;
mod sharing;
mod support;
mod watching;
mod wire_faults;
mod worlds;
