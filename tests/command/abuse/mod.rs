//! Attacks on the real binary in a process with little memory. During each one the server lives, stays small and
//! answers health checks, and a world that nobody attacks has the states that it has alone.
//!
//! One file per kind of attack: `net_…` sends bytes, connections and requests that are meant to exhaust; `tick_…`
//! takes what others share: ticks, workers, places. `cargo test --test abuse` runs the short form,
//! `tests/abuse/run.sh` the long one.
#![cfg(target_os = "linux")] // limits of a process and its memory as Linux tells them

mod harness;
mod net_http2;
mod net_memory;
mod net_resets;
mod net_silent;
mod tick_floods;
mod tick_greed;
mod witness;
