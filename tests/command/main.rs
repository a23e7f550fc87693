//! The real binary: from a shell, under attack, killed, and in a shortened run of hours.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

#[cfg(target_os = "linux")] // limits and memory of a process in the way of Linux
mod abuse;
#[cfg(unix)]
mod chaos;
mod cli;
mod operations;
mod pages;
mod parameters;
#[path = "../common/raw.rs"]
mod raw;
mod run_cli;
mod sharing;
mod strength;
#[allow(dead_code, reason = "shared with tests/server")]
#[path = "../server/support.rs"]
mod support;
mod survey;
