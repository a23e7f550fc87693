//! The parts of Oshita & Makinouchi 2000 that the default mode does not use.
//!
//! [`controller`] composes Eqs. (4)–(17): `reroot` (the support as root, §3.1), `torque_limits` (7)–(11),
//! `spatial_targets` (12)–(16) on the row algebra of [`rows`](crate::control::rows), and `feasible_com`.
//! [`prescribed_step`] applies its accelerations as they are; `hand_over` decides when torques take over from them, and
//! `impact` solves the collisions of §3. [`mode`] answers a tick's questions about its controller. `docs/equations.md`
//! leads from each equation to its function and its tests.

pub mod controller;
pub mod feasible_com;
pub mod hand_over;
pub mod impact;
pub mod mode;
pub mod params;
pub mod prescribed_step;
pub mod reroot;
pub mod spatial_targets;
pub mod torque_limits;

pub use controller::{Paper, PaperMemory};
