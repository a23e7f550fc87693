//! The offline commands: run a motion through the physics, look at motions and bodies. Each submodule is one command.

pub mod args;
pub mod bodies;
pub mod convert;
pub mod lint;
pub mod output;
pub mod run;
pub mod source;
