//! Frames on their way to viewers: encoded once per view and shared by all its viewers; the latest frame wins.

pub mod hub;
