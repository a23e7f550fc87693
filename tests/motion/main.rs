//! Reading, fitting and preparing motion files.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

#[path = "../common/mod.rs"]
mod common;
mod corpus;
mod reading;
