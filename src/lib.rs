//! Sinew: physically simulated human figures that track desired motions within human strength.
//!
//! * [`sim`]: physics and control; pure, synchronous, no I/O. The loop of one tick is `sim::world::World::step`.
#![cfg_attr(
    feature = "net",
    doc = "* `wire`: protobuf to domain types and back. * `server`: everything that touches the network or the clock; \
        the rate keeper is `server::tick::run`. * `client`: a thin Rust client."
)]

#[cfg(feature = "net")]
pub mod cli;
#[cfg(feature = "net")]
pub mod client;
pub mod evaluate;
#[cfg(feature = "net")]
pub mod server;
pub mod sim;
#[cfg(feature = "net")]
pub mod wire;
