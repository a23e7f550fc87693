//! The part of a world that every stage of a tick reads.

use crate::time::WorldTime;

/// The reaction of a tick to a missing plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Planning {
    /// It works out the plan: every plan counts in the tick that was fixed for it.
    #[default]
    InTick,
    /// It does not wait: the figure continues with its activity, and takes a plan in a later tick.
    Aside,
}

/// The world, as a tick sees it.
#[derive(Clone, Copy, Debug)]
pub struct TickContext {
    /// Tick that is computed; it begins at `tick · dt`.
    pub tick: u64,
    /// Length of the tick, s.
    pub dt: f64,
    /// Substeps of torque simulation.
    pub substeps: u32,
    /// Magnitude of gravity, m/s².
    pub gravity: f64,
    /// The reaction of a tick to a missing plan.
    pub planning: Planning,
}

impl TickContext {
    /// Time at which it begins.
    pub fn time(&self) -> WorldTime {
        WorldTime(self.tick as f64 * self.dt)
    }
}
