//! Goal: no bytes from outside can crash anything. Method: arbitrary bytes, and damaged valid ones, are given to all
//! code that reads bytes: requests of every call of the protos, BVH, checkpoints, files of the store.
//!
//! `SINEW_FUZZ_CASES` sets the number of each; docs/testing.md has the command.

mod bytes;
mod edit;
mod messages;
mod records;
mod services;
mod store;

use proptest::test_runner::{Config, TestRunner};

/// Cases of one property: `few` in the short run.
fn runner(few: u32) -> TestRunner {
    let cases = std::env::var("SINEW_FUZZ_CASES").map_or(few, |n| n.parse().unwrap());
    TestRunner::new(Config {
        cases,
        failure_persistence: None,
        max_shrink_iters: 2000,
        ..Config::default()
    })
}
