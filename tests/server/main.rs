//! A real client against the server in this process, on a port of the system's choice.
#![cfg(feature = "net")]

mod clips;
mod drives;
mod support;
mod watching;
mod wire_faults;
mod worlds;
