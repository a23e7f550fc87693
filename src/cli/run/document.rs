//! The document written by `--report`.

use super::scenario::Scenario;
use crate::args::{ControllerArg, StepperArg};
use crate::lint;
use crate::source::LoadedClip;
use serde::Serialize;
use sinew_evaluate::RunReport;
use sinew_physics::body::SegmentId;
use sinew_physics::body::names::sex_name;
use sinew_physics::figure::SecondHand;
use sinew_physics::forecast::Forecast;

/// `report.json`: the scenario, how the motion was fitted, and the measures.
#[derive(Serialize)]
pub(super) struct Document<'a> {
    clip: &'a str,
    duration_s: f64,
    body: BodyEntry,
    controller: ControllerArg,
    stepper: StepperArg,
    strength: f64,
    percentile: f64,
    effort: f64,
    fatigue_time_scale: f64,
    assist: f64,
    max_help: f64,
    self_contact: bool,
    substeps: u32,
    gravity_mps2: f64,
    loads: Vec<LoadEntry>,
    pushes: Vec<PushEntry>,
    /// In the form of the arguments.
    obstacles: Vec<&'a str>,
    /// Clips that followed.
    then: Vec<ThenEntry<'a>>,
    #[serde(flatten)]
    measures: &'a RunReport,
    /// The forecast for the clip.
    forecast: &'a Forecast,
    /// `null` for built-in motions, which are made for the body.
    retarget: serde_json::Value,
}

#[derive(Serialize)]
struct ThenEntry<'a> {
    clip: &'a str,
    at_s: f64,
}

#[derive(Serialize)]
struct BodyEntry {
    /// In the form used by `--body` and the API.
    name: String,
    sex: &'static str,
    age_years: f64,
    height_m: f64,
    mass_kg: f64,
}

#[derive(Serialize)]
struct LoadEntry {
    segment: &'static str,
    /// `null`: one hand.
    second_segment: Option<&'static str>,
    /// When the other hand helps: `auto`, `always`, or `null`: never.
    two_hands: Option<&'static str>,
    mass_kg: f64,
    from_s: f64,
    /// `null`: never put down.
    to_s: Option<f64>,
}

#[derive(Serialize)]
struct PushEntry {
    segment: &'static str,
    impulse_ns: f64,
    at_s: f64,
    duration_s: f64,
    direction: [f64; 3],
}

/// The document of one clip.
pub(super) fn document<'a>(
    scenario: &Scenario<'a>,
    source: &'a LoadedClip,
    duration_s: f64,
    (measures, forecast): (&'a RunReport, &'a Forecast),
) -> Document<'a> {
    let args = scenario.args;
    let profile = scenario.body.profile;
    Document {
        clip: &source.name,
        duration_s,
        body: BodyEntry {
            name: profile.name(),
            sex: sex_name(profile.sex),
            age_years: profile.age,
            height_m: profile.height,
            mass_kg: profile.mass,
        },
        controller: args.controller_kind(),
        stepper: args.stepper_kind(),
        strength: scenario.strength.all,
        percentile: scenario.strength.percentile,
        effort: scenario.strength.effort,
        fatigue_time_scale: args.fatigue,
        assist: args.assist,
        max_help: args.help.most(),
        self_contact: args.self_contact,
        substeps: args.substeps,
        gravity_mps2: scenario.params.gravity,
        loads: args
            .load
            .iter()
            .map(|l| LoadEntry {
                segment: l.segment.name(),
                second_segment: l.second.map(SegmentId::name),
                two_hands: l.help.map(|h| match h {
                    SecondHand::Auto => "auto",
                    SecondHand::Always => "always",
                }),
                mass_kg: l.mass_kg,
                from_s: l.from_s,
                to_s: Some(l.to_s).filter(|t| t.is_finite()),
            })
            .collect(),
        pushes: args
            .push
            .iter()
            .map(|p| PushEntry {
                segment: p.segment.name(),
                impulse_ns: p.impulse_ns,
                at_s: p.at_s,
                duration_s: args.push_duration,
                direction: p.direction.to_array(),
            })
            .collect(),
        obstacles: args.obstacle.iter().map(|o| o.0.name.as_str()).collect(),
        then: (args.then.iter())
            .map(|t| ThenEntry {
                clip: &t.clip,
                at_s: t.at_s,
            })
            .collect(),
        measures,
        forecast,
        retarget: source
            .retarget
            .as_ref()
            .map_or(serde_json::Value::Null, lint::to_json),
    }
}
