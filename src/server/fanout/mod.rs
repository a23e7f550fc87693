//! Frames on their way to viewers: encoded once per view, shared by all that want the same, latest wins.

pub mod hub;
