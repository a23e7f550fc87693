//! The form of the source: layers, sizes, equations, contract. Links nothing of the product.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

mod conventions;
mod equations;
mod house;
mod layering;
mod proto_bootstrap;
