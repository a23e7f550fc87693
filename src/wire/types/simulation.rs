//! Offline simulations.

use super::figure::FigureSettings;
use super::perturbation::Disturbance;
use super::state::ViewSpec;

/// The request of an offline simulation.
#[derive(Clone, Debug)]
pub struct SimulationSettings {
    /// The figure.
    pub figure: FigureSettings,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Substeps per tick.
    pub substeps: u32,
    /// Duration, s; `None`: the length of the clip.
    pub duration: Option<f64>,
    /// Whether to repeat the clip.
    pub looped: bool,
    /// Disturbances by time, s.
    pub disturbances: Vec<(f64, Disturbance)>,
    /// Requested frames.
    pub view: Option<ViewSpec>,
}

/// Figures of merit of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationSummary {
    /// Ticks.
    pub ticks: u64,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Time at which the figure fell, s.
    pub fell_at: Option<f64>,
    /// Root mean square of the joint angle errors against the target that moves along with the feet, rad.
    pub tracking_joint_rms: f64,
    /// Largest joint angle error against that target, rad.
    pub tracking_joint_max: f64,
    /// Largest torque relative to the torque available.
    pub utilisation: f64,
    /// Largest excess over the strength.
    pub over_limit: f64,
    /// Time at the limit per DOF, s.
    pub saturated: Vec<f64>,
    /// Least margin, m.
    pub margin: Option<f64>,
    /// Largest penetration, m.
    pub penetration: f64,
    /// State hash at the end.
    pub hash: u64,
    /// Median and p99 of the time of a tick, µs.
    pub tick_us: [f64; 2],
}
