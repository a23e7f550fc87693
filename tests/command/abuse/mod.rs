//! Attacks on the real binary in a process with little memory. During each attack the server stays alive, small and
//! healthy, and a bystander world has the states that it has alone.
//!
//! There is one file per kind of attack: `net_…` sends bytes, connections and requests meant to exhaust the server;
//! `tick_…` takes shared resources: ticks, workers, places. `cargo test --test command abuse` runs the short form,
//! `tests/abuse/run.sh` the long one.
#![cfg(target_os = "linux")] // limits and memory of a process in the way of Linux

mod harness;
mod net_http2;
mod net_memory;
mod net_resets;
mod net_silent;
mod tick_floods;
mod tick_greed;
mod witness;
