//! The measures of a run: the content of `report.json`.
//!
//! # The reference of tracking errors
//!
//! Measures named `tracking_…` are distances from the *target*, the posture that the controller is asked for. The
//! target is not fixed in the world: after a step, the reference motion is moved to where the foot landed
//! ([`sinew_physics::track::planned_to_world`]), and it includes planned steps that a disturbance changed. A figure
//! that drifts away from the recording with every step therefore still has small tracking errors. Errors against the
//! recording itself, fixed in the world, are those of `sinew survey`.

use sinew_physics::body::DOF_COUNT;
use sinew_physics::body::topology::DOF_NAMES;

/// Events kept in a report; later ones are counted only, so that a chattering figure cannot fill memory.
pub const MAX_EVENTS: usize = 10_000;

/// An event at one instant of a run.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct RunEvent {
    /// End of the tick in which it happened, s from the start.
    pub time_s: f64,
    /// Kind of event, for example `fell` or `support_lost`.
    pub kind: &'static str,
    /// Segment concerned, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub segment: Option<&'static str>,
    /// DOF concerned, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dof: Option<&'static str>,
    /// Mass of the load concerned, if any, kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Hand that helps with a load, if one does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<&'static str>,
    /// Share of its strength that the arm needs to hold that load alone, and with help.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub need: Option<[f64; 2]>,
}

/// The measures of one run. Field names carry their units and are those of `report.json`.
///
/// Tracking errors, slip and margin end with the tick in which the figure falls: afterwards there is nothing left to
/// track. Limits, residuals and penetration cover every tick.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct RunReport {
    /// Ticks per second.
    pub rate_hz: f64,
    /// Ticks stepped.
    pub ticks: u64,
    /// Time at which the figure fell, s; `None` if it stood to the end.
    pub fell_at_s: Option<f64>,
    /// Root mean square of target ⊖ actual joint angle over all DOFs and ticks, degrees.
    pub tracking_joint_rms_deg: f64,
    /// Largest such error of any DOF in any tick, degrees.
    pub tracking_joint_max_deg: f64,
    /// Mean distance of segment origins from those of the target, both relative to the pelvis origin, mm.
    pub tracking_mpjpe_root_mm: f64,
    /// Mean distance of segment origins from those of the target in the world, mm. The target is moved along with the
    /// feet.
    pub tracking_mpjpe_global_mm: f64,
    /// Largest used share of the available muscle torque (1 = at the limit).
    pub max_utilisation: f64,
    /// Largest violation of a torque limit, relative to that limit; 0 when none.
    pub over_limit_max: f64,
    /// Time each DOF spent at its limit, s, in DOF order.
    #[serde(serialize_with = "by_dof")]
    pub saturated_s: [f64; DOF_COUNT],
    /// Largest relative residual of the equations of motion (see [`super::audit`]).
    pub dynamics_residual_max: f64,
    /// Largest force on the pelvis that no contact or perturbation accounts for, N.
    pub root_wrench_unexplained_max_n: f64,
    /// Largest moment on the pelvis that no contact or perturbation accounts for, N·m.
    pub root_wrench_unexplained_max_nm: f64,
    /// Largest mean force of the assist on the pelvis in a tick, N; 0 when it is off.
    pub assist_max_n: f64,
    /// Largest mean moment of the assist, N·m.
    pub assist_max_nm: f64,
    /// Mean over all ticks of the assist's force, N.
    pub assist_mean_n: f64,
    /// Largest distance of the pelvis origin from that of the target, mm. The target is moved along with the feet.
    pub tracking_root_max_mm: f64,
    /// Least strength that fatigue left any muscle, share of the rested strength; 1 when fatigue is off.
    pub remaining_strength_min: f64,
    /// Mean horizontal speed of foot contact points that carry more than 5 N, mm/s; 0 when no foot ever does.
    pub foot_slip_mm_per_s: f64,
    /// Deepest contact point below a surface, mm.
    pub penetration_max_mm: f64,
    /// Least balance margin: distance of the zero-moment point from the edge of the support polygon, positive inside,
    /// m; `None` if the figure never stood.
    pub margin_min_m: Option<f64>,
    /// Hash of the world's state after the last tick, 16 hexadecimal digits.
    pub state_hash: String,
    /// Median time of one tick, µs.
    pub us_per_tick_p50: f64,
    /// 99th percentile of the time of one tick, µs.
    pub us_per_tick_p99: f64,
    /// Ticks whose state or report held a number that is not finite; 0 in a sound run.
    pub non_finite_ticks: u64,
    /// Time at which the figure was frozen because its state diverged, s; `None` in a sound run.
    pub quarantined_at_s: Option<f64>,
    /// Largest used share of the available muscle torque of each DOF.
    #[serde(serialize_with = "by_dof")]
    pub utilisation_max: [f64; DOF_COUNT],
    /// Root mean square of target ⊖ actual of each DOF, degrees.
    #[serde(serialize_with = "by_dof")]
    pub tracking_joint_rms_by_dof_deg: [f64; DOF_COUNT],
    /// Events, in order; at most [`MAX_EVENTS`].
    pub events: Vec<RunEvent>,
    /// Events beyond those kept.
    pub events_dropped: u64,
}

impl RunReport {
    /// Name and time of the DOF that was longest at its limit; `None` if none ever was.
    pub fn longest_saturated(&self) -> Option<(&'static str, f64)> {
        (0..DOF_COUNT)
            .max_by(|a, b| self.saturated_s[*a].total_cmp(&self.saturated_s[*b]))
            .map(|d| (DOF_NAMES[d], self.saturated_s[d]))
            .filter(|(_, s)| *s > 0.0)
    }
}

/// Writes one number per DOF as an object with DOF names.
fn by_dof<S: serde::Serializer>(
    values: &[f64; DOF_COUNT],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(DOF_NAMES.iter().zip(values))
}
