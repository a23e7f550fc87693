//! Motion strips: evenly spaced frames of a run side by side, as SVG or PNG.
//!
//! Each panel shows the figure as a solid body (left limbs blue, right limbs orange), the desired posture as a pale
//! ghost behind it, the contact force of each segment, the force of help, support polygon, centre of mass, zero-moment
//! point, and a ring at every joint that is at (red) or near (amber) the limit of its strength. [`Drawing`] is the list
//! of shapes; [`svg`] and [`raster`] are its two writers.

mod drawing;
mod frame;
mod panel;
pub mod raster;
pub mod svg;
mod things;

pub use drawing::{Drawing, DrawnItem, Rgba};
pub use frame::{StripFrame, StripOptions, View};
pub use things::{Thing, ThingKind};

use sinew_physics::body::Body;

/// The ticks, in a run of `ticks` ticks, that `count` evenly spaced panels show: from the first to the last, without
/// repetition.
pub fn evenly_spaced(ticks: u64, count: usize) -> Vec<u64> {
    let last = ticks.saturating_sub(1);
    let steps = (count.max(2) - 1) as u64;
    let mut out: Vec<u64> = (0..=steps)
        .map(|i| (i * last + steps / 2) / steps)
        .collect();
    out.dedup();
    out
}

/// Draws `frames` of `body` side by side.
pub fn draw(body: &Body, frames: &[StripFrame], options: &StripOptions) -> Drawing {
    panel::draw(body, frames, options)
}

#[cfg(test)]
mod tests;
