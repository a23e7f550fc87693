//! A standing body as an inverted pendulum.

use crate::control::ControlInput;

/// √(height of the centre of mass / gravity), s.
pub(super) fn pendulum_time(input: &ControlInput<'_>) -> f64 {
    (input.terms.com.z.max(0.1) / input.gravity.max(1.0)).sqrt()
}
