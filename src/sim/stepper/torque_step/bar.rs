//! The bar between two hands that hold one load: one more unknown of a substep.

use crate::body::topology::{NV, SegmentId};
use crate::dynamics::Dynamics;
use crate::dynamics::jacobian::for_each_column;
use crate::math::Vec3;
use crate::stepper::command::Bar;
use crate::stepper::params::bar;

/// The bar as a row of the solve.
#[derive(Clone, Copy, Debug)]
pub(super) struct BarRow {
    /// Segments and world points of its ends.
    pub(super) ends: [(SegmentId, Vec3); 2],
    /// Unit vector from the first end to the second, world axes.
    pub(super) direction: Vec3,
    /// Derivative of its length by the velocity.
    row: [f64; NV],
    /// Rate of its length that corrects an error, m/s.
    pub(super) wanted: f64,
}

impl BarRow {
    pub(super) fn new(bar: &Bar, terms: &Dynamics, h: f64) -> Self {
        let ends = bar.ends.map(|(s, p)| (s, terms.point_world(s.index(), p)));
        let span = ends[1].1 - ends[0].1;
        let length = span.norm();
        let direction = if length > 1e-6 {
            span * (1.0 / length)
        } else {
            Vec3::Y
        };
        let mut row = [0.0; NV];
        let root = terms.state.posture.root_position;
        for (sign, (s, p)) in [-1.0, 1.0].into_iter().zip(ends) {
            for_each_column(&terms.kin, s.index(), p - root, |i, _, v| {
                row[i] += sign * v.dot(direction)
            });
        }
        Self {
            ends,
            direction,
            row,
            wanted: (bar::RETURN * (bar.length - length) / h)
                .clamp(-bar::RETURN_SPEED, bar::RETURN_SPEED),
        }
    }

    pub(super) fn rate(&self, v: &[f64; NV]) -> f64 {
        self.row.iter().zip(v).map(|(a, b)| a * b).sum()
    }

    pub(super) fn add(&self, impulse: f64, x: &mut [f64; NV]) {
        for (x, r) in x.iter_mut().zip(&self.row) {
            *x += impulse * r;
        }
    }
}
