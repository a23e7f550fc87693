//! The part of a world that every stage of a tick reads.

/// What a tick does that needs a plan which is not there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Planning {
    /// It works the plan out: every plan counts in the tick that was fixed for it.
    #[default]
    InTick,
    /// It does not wait: the figure goes on with what it does, and takes a plan in a later tick.
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
    /// What a tick does that needs a plan which is not there.
    pub planning: Planning,
}

impl TickContext {
    /// When it begins, s.
    pub fn time(&self) -> f64 {
        self.tick as f64 * self.dt
    }
}
