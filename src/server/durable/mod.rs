//! Worlds and clips that outlive the process.
//!
//! [`store`] says what a store does, in bytes; [`local`] does it in a directory, with one log for all worlds ([`log`])
//! and a small file for everything else ([`records`] has their fields, [`files`] how they are written); `memory` does
//! it for tests. [`keeper`] is the thread that writes, [`recovery`] what happens when the server starts, [`marks`] how
//! it knows which world crashed the process.

pub mod keeper;
pub mod local;
pub mod marks;
pub mod recovery;
pub mod store;

mod files;
mod log;
mod records;

#[cfg(test)]
mod memory;
#[cfg(test)]
mod tests;
