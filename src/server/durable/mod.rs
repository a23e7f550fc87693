//! Worlds and clips that outlive the process.
//!
//! [`store`] defines a store in terms of bytes; [`local`] implements it in a directory, with one log for all worlds
//! ([`log`]) and small files for everything else ([`records`] has their fields, [`files`] writes them); `memory`
//! implements it for tests. [`keeper`] is the writing thread, [`recovery`] runs when the server starts, and [`marks`]
//! records which world crashed the process.

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
