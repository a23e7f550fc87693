//! Who may do what: identities, roles, leases and quotas, by a real client against the server in this process.
#![cfg(feature = "net")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

#[allow(dead_code)] // not every function
#[path = "../common/corpus.rs"]
mod corpus;
mod entering;
mod identity;
mod leases;
mod page;
mod roles;
mod support;
mod tenants;
