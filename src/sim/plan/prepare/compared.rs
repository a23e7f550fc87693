//! Measures of a motion as recorded and as prepared, and angles outside their limits.

use serde::Serialize;

/// A measure of a motion as it was recorded and as it is prepared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Compared<T> {
    /// As recorded.
    pub recorded: T,
    /// As prepared.
    pub prepared: T,
}

impl<T: Copy> Compared<T> {
    /// Applies `change` to both values.
    pub fn map<U>(self, change: impl Fn(T) -> U) -> Compared<U> {
        Compared {
            recorded: change(self.recorded),
            prepared: change(self.prepared),
        }
    }
}

/// How far an angle is outside its limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Excess {
    /// Largest excess, rad.
    pub max: f64,
    /// Fraction of the samples that were clamped.
    pub fraction: f64,
}
