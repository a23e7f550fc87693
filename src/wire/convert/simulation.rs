//! Offline simulations.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::{MotionSource, SimulationSettings, SimulationSummary, WorldEvent};
use super::{figure, motion, or_default, perturbation, state, world};
use sinew_physics::plan::ReadingReport;

/// The source of the motion of a simulation.
#[derive(Debug)]
pub enum SimulationSource {
    /// Last part of a clip's name.
    Clip(String),
    /// A file.
    File(MotionSource),
}

/// Motion and settings of a simulation.
pub fn settings(
    r: pb::SimulateClipRequest,
    max_bytes: u64,
    max_seconds: f64,
) -> Result<(SimulationSource, SimulationSettings), Fault> {
    use pb::simulate_clip_request::Source as S;
    let figure = figure::settings("figure", r.figure.as_ref())?;
    let source = match r.source {
        None => return Err(Fault::invalid("source", "must be clip or bvh")),
        Some(S::Clip(name)) => SimulationSource::Clip(super::clip_name("clip", &name)?.to_owned()),
        Some(S::Bvh(b)) => SimulationSource::File(motion::bvh(b, max_bytes, figure.follow)?),
    };
    let duration = or_default("duration_s", r.duration_s, 0.0, 0.0, max_seconds)?;
    Ok((
        source,
        SimulationSettings {
            figure,
            rate_hz: world::rate("rate_hz", r.rate_hz)?,
            substeps: world::substeps("substep_count", r.substep_count)?,
            duration: (duration > 0.0).then_some(duration),
            looped: r.r#loop,
            disturbances: perturbation::timed(&r.perturbations)?,
            view: r.view.as_ref().map(|v| state::view(Some(v))).transpose()?,
        },
    ))
}

/// The result, for a response, without the frames.
pub fn response(
    s: &SimulationSummary,
    events: &[WorldEvent],
    report: Option<&ReadingReport>,
) -> pb::SimulateClipResponse {
    pb::SimulateClipResponse {
        summary: Some(pb::SimulationSummary {
            tick_count: s.ticks as i32,
            rate_hz: s.rate_hz,
            fell_at_s: s.fell_at,
            tracking_joint_rms_rad: s.tracking_joint_rms,
            tracking_joint_max_rad: s.tracking_joint_max,
            max_utilisation: s.utilisation,
            over_limit_max: s.over_limit,
            saturated_s: s.saturated.clone(),
            margin_min_m: s.margin,
            penetration_max_m: s.penetration,
            state_hash: s.hash as i64,
            tick_p50_us: s.tick_us[0],
            tick_p99_us: s.tick_us[1],
        }),
        frames: Vec::new(),
        events: events.iter().map(state::event_out).collect(),
        report: report.map(motion::report_out),
    }
}
