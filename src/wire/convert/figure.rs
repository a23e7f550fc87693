//! Figures.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::{FigureInfo, FigureSettings, FigureUpdate, FollowSettings, FollowUpdate};
use super::masks::MaskFields;
use super::names::{BODY, CLIP, FIGURE};
use super::{
    body, constraint, display_name, etags, motion, or_default, place, place_out, shortened, within,
};
use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::figure::{
    ControlParams, ControllerKind, FigureOptions, Metric, Priority, Share, StepperKind,
    StrengthScale,
};
use sinew_physics::strength::fatigue::MAX_TIME_SCALE;

/// Controller of a request.
pub fn controller(field: &str, value: i32) -> Result<ControllerKind, Fault> {
    match pb::Controller::try_from(value) {
        Ok(pb::Controller::Unspecified | pb::Controller::Modern) => Ok(ControllerKind::Modern),
        Ok(pb::Controller::Paper) => Ok(ControllerKind::Paper),
        Ok(pb::Controller::Motors) => Ok(ControllerKind::Motors),
        Err(_) => Err(Fault::invalid(
            field,
            format!("{value} is not a controller"),
        )),
    }
}

/// Stepper of a request.
pub fn stepper(field: &str, value: i32) -> Result<StepperKind, Fault> {
    match pb::Stepper::try_from(value) {
        Ok(pb::Stepper::Unspecified | pb::Stepper::Torque) => Ok(StepperKind::Torque),
        Ok(pb::Stepper::Kinematic) => Ok(StepperKind::Kinematic),
        Ok(pb::Stepper::Staged) => Ok(StepperKind::Staged),
        Err(_) => Err(Fault::invalid(field, format!("{value} is not a stepper"))),
    }
}

/// A value of an enumeration, or a fault that describes it.
fn choice<T: TryFrom<i32>>(field: &str, value: i32, what: &str) -> Result<T, Fault> {
    T::try_from(value).map_err(|_| Fault::invalid(field, format!("{value} is not a {what}")))
}

/// Choices of the paper's controller in a request.
pub fn paper(field: &str, o: Option<&pb::PaperOptions>) -> Result<ControlParams, Fault> {
    let Some(o) = o else {
        return Ok(ControlParams::default());
    };
    let at = |part: &str| format!("{field}.{part}");
    let mut out = match choice(&at("preset"), o.preset, "preset")? {
        pb::PaperPreset::Unspecified | pb::PaperPreset::Safeguarded => ControlParams::default(),
        pb::PaperPreset::PaperPreset2000 => ControlParams::paper2000(),
    };
    if let Some(alpha) = o.alpha {
        out.alpha = within(at("alpha"), alpha, 0.0, 1.0)?;
    }
    match o.horizon_s {
        Some(0.0) => out.horizon = None,
        Some(t) => out.horizon = Some(within(at("horizon_s"), t, 0.01, 2.0)?),
        None => {}
    }
    match choice(&at("metric"), o.metric, "metric")? {
        pb::PaperMetric::Unspecified => {}
        pb::PaperMetric::Identity => out.metric = Metric::Identity,
        pb::PaperMetric::Inertia => out.metric = Metric::Inertia,
        pb::PaperMetric::Torque => out.metric = Metric::Torque,
    }
    match choice(&at("priority"), o.priority, "priority")? {
        pb::PaperPriority::Unspecified => {}
        pb::PaperPriority::Printed => out.priority = Priority::Paper,
        pb::PaperPriority::Nested => out.priority = Priority::Nested,
    }
    match choice(&at("share"), o.share, "way to share")? {
        pb::PaperShare::Unspecified => {}
        pb::PaperShare::Ratio => out.share = Share::Paper,
        pb::PaperShare::Balanced => out.share = Share::Balanced,
    }
    for (to, from) in [
        (&mut out.to_limit, o.to_limit),
        (&mut out.tilt, o.tilt),
        (&mut out.zmp_feasible, o.zmp_feasible),
        (&mut out.track_hands, o.track_hands),
        (&mut out.track_com, o.track_com),
        (&mut out.hand_over, o.hand_over),
    ] {
        *to = from.unwrap_or(*to);
    }
    Ok(out)
}

/// The choices in force, all of them explicit.
fn paper_out(p: &ControlParams) -> pb::PaperOptions {
    pb::PaperOptions {
        preset: if *p == ControlParams::paper2000() {
            pb::PaperPreset::PaperPreset2000
        } else {
            pb::PaperPreset::Safeguarded
        }
        .into(),
        alpha: Some(p.alpha),
        horizon_s: Some(p.horizon.unwrap_or(0.0)),
        metric: match p.metric {
            Metric::Identity => pb::PaperMetric::Identity,
            Metric::Inertia => pb::PaperMetric::Inertia,
            Metric::Torque => pb::PaperMetric::Torque,
        }
        .into(),
        priority: match p.priority {
            Priority::Paper => pb::PaperPriority::Printed,
            Priority::Nested => pb::PaperPriority::Nested,
        }
        .into(),
        share: match p.share {
            Share::Paper => pb::PaperShare::Ratio,
            Share::Balanced => pb::PaperShare::Balanced,
        }
        .into(),
        to_limit: Some(p.to_limit),
        tilt: Some(p.tilt),
        zmp_feasible: Some(p.zmp_feasible),
        track_hands: Some(p.track_hands),
        track_com: Some(p.track_com),
        hand_over: Some(p.hand_over),
    }
}

/// Strength of a request.
pub fn strength(field: &str, s: Option<&pb::StrengthScale>) -> Result<StrengthScale, Fault> {
    let mut out = StrengthScale::default();
    let Some(s) = s else { return Ok(out) };
    out.all = or_default(&format!("{field}.all"), s.all, 1.0, 0.01, 100.0)?;
    out.percentile = or_default(
        &format!("{field}.percentile"),
        s.percentile,
        50.0,
        5.0,
        95.0,
    )?;
    if let Some(effort) = s.effort {
        out.effort = within(format!("{field}.effort"), effort, 0.0, 1.0)?;
    }
    for (i, d) in s.dofs.iter().enumerate() {
        let at = |part: &str| format!("{field}.dofs[{i}].{part}");
        let dof = DOF_NAMES.iter().position(|n| *n == d.dof).ok_or_else(|| {
            Fault::invalid(
                at("dof"),
                format!(
                    "must be one of {}, got {:?}",
                    DOF_NAMES.join(", "),
                    shortened(&d.dof)
                ),
            )
        })?;
        out.dof[dof] = within(at("factor"), d.factor, 0.01, 100.0)?;
    }
    Ok(out)
}

fn time_scale(field: &str, value: f64) -> Result<f64, Fault> {
    within(field, value, 0.0, MAX_TIME_SCALE)
}

/// Settings of a new figure; `field` is the place of the message in the request.
pub fn settings(field: &str, f: Option<&pb::Figure>) -> Result<FigureSettings, Fault> {
    let none = pb::Figure::default();
    let f = f.unwrap_or(&none);
    let at = |part: &str| format!("{field}.{part}");
    let follow = motion::follow_update(field, f.follow, f.max_help_weights)?;
    let follow = FollowSettings::default().changed(follow);
    Ok(FigureSettings {
        display_name: display_name(&at("display_name"), &f.display_name)?,
        body: body::reference(&at("body"), &f.body, &at("profile"), f.profile.as_ref())?,
        strength: strength(&at("strength"), f.strength.as_ref())?,
        controller: controller(&at("controller"), f.controller)?,
        stepper: stepper(&at("stepper"), f.stepper)?,
        params: ControlParams {
            protective_steps: f.protective_steps.unwrap_or(true),
            ..paper(&at("paper"), f.paper.as_ref())?
        },
        options: FigureOptions {
            fatigue_time_scale: time_scale(&at("fatigue_time_scale"), f.fatigue_time_scale)?,
            assist: within(at("assist"), f.assist, 0.0, 1.0)?,
            max_help: follow.most_help(),
            self_contact: f.self_contact.unwrap_or(false),
        },
        follow,
        place: f
            .placement
            .map(|p| place(&at("placement"), p))
            .transpose()?
            .unwrap_or_default(),
        constraints: constraint::list(&at("constraints"), &f.constraints)?,
    })
}

/// Changes of a figure.
pub fn update(
    f: &pb::Figure,
    mask: Option<&prost_types::FieldMask>,
) -> Result<FigureUpdate, Fault> {
    let fields = MaskFields {
        settable: &[
            ("display_name", !f.display_name.is_empty()),
            ("strength", f.strength.is_some()),
            ("controller", f.controller != 0),
            ("fatigue_time_scale", f.fatigue_time_scale != 0.0),
            ("assist", f.assist != 0.0),
            ("paper", f.paper.is_some()),
            ("constraints", !f.constraints.is_empty()),
            ("protective_steps", f.protective_steps.is_some()),
            ("follow", f.follow != 0),
            ("max_help_weights", f.max_help_weights.is_some()),
            ("self_contact", f.self_contact.is_some()),
        ],
        fixed: &["body", "profile", "stepper", "placement"],
        output: &["name", "status", "etag"],
    };
    let mut out = FigureUpdate::default();
    let mut takes = [false; 2];
    for field in fields.taken(mask)? {
        match field {
            "display_name" => {
                out.display_name = Some(display_name("figure.display_name", &f.display_name)?)
            }
            "strength" => out.strength = Some(strength("figure.strength", f.strength.as_ref())?),
            "controller" => out.controller = Some(controller("figure.controller", f.controller)?),
            "fatigue_time_scale" => {
                let value = time_scale("figure.fatigue_time_scale", f.fatigue_time_scale)?;
                out.fatigue_time_scale = Some(value);
            }
            "paper" => out.params = Some(paper("figure.paper", f.paper.as_ref())?),
            "constraints" => {
                out.constraints = Some(constraint::list("figure.constraints", &f.constraints)?);
            }
            "protective_steps" => out.protective_steps = Some(f.protective_steps.unwrap_or(true)),
            "follow" => takes[0] = true,
            "max_help_weights" => takes[1] = true,
            "self_contact" => out.self_contact = Some(f.self_contact.unwrap_or(false)),
            _ => out.assist = Some(within("figure.assist", f.assist, 0.0, 1.0)?),
        }
    }
    let [follow, most_help] = takes;
    let given = motion::follow_update(
        "figure",
        if follow { f.follow } else { 0 },
        f.max_help_weights.filter(|_| most_help),
    )?;
    out.follow = FollowUpdate {
        // A mask that names an absent value takes the default.
        follow: follow.then(|| given.follow.unwrap_or_default()),
        most_help: most_help.then(|| given.most_help.flatten()),
    };
    Ok(out)
}

/// Resource name of a clip, if there is one.
fn clip_resource(id: &Option<String>) -> String {
    id.as_ref().map_or_else(String::new, |c| CLIP.name([c]))
}

/// Checks the etag of a request, if it has one.
///
/// # Errors
/// The figure has changed.
pub fn check_etag(now: &FigureInfo, sent: &str) -> Result<(), Fault> {
    let name = FIGURE.name([&now.world, &now.id]);
    etags::check(&name, sent, || figure_out(now).etag)
}

/// A figure for a response.
pub fn figure_out(f: &FigureInfo) -> pb::Figure {
    let s = &f.settings;
    let mut out = pb::Figure {
        name: FIGURE.name([&f.world, &f.id]),
        display_name: s.display_name.clone(),
        body: BODY.name([&s.body.id]),
        profile: Some(body::profile_out(&s.body.profile)),
        strength: Some(pb::StrengthScale {
            all: s.strength.all,
            percentile: s.strength.percentile,
            effort: Some(s.strength.effort),
            dofs: s
                .strength
                .dof
                .iter()
                .enumerate()
                .filter(|(_, factor)| **factor != 1.0)
                .map(|(d, factor)| pb::DofStrength {
                    dof: DOF_NAMES[d].into(),
                    factor: *factor,
                })
                .collect(),
        }),
        controller: match s.controller {
            ControllerKind::Paper => pb::Controller::Paper,
            ControllerKind::Modern => pb::Controller::Modern,
            ControllerKind::Motors => pb::Controller::Motors,
        }
        .into(),
        stepper: match s.stepper {
            StepperKind::Torque => pb::Stepper::Torque,
            StepperKind::Kinematic => pb::Stepper::Kinematic,
            StepperKind::Staged => pb::Stepper::Staged,
        }
        .into(),
        placement: Some(place_out(s.place)),
        status: Some(pb::FigureStatus {
            clip: clip_resource(&f.clip),
            next_clip: clip_resource(&f.next_clip),
            driver_id: f.driver.clone().unwrap_or_default(),
            figure_index: f.index,
            following: motion::follow_mode_out(f.follows.so_far.mode).into(),
            help_newton_seconds: f.follows.so_far.impulse,
            help_ratio: f.follows.so_far.help_share(),
            max_help_weights: f.follows.most_help,
            help_newton_metre_seconds: f.follows.so_far.turning_impulse,
        }),
        fatigue_time_scale: s.options.fatigue_time_scale,
        assist: s.options.assist,
        follow: motion::follow_out(s.follow.follow).into(),
        max_help_weights: Some(s.options.max_help),
        self_contact: Some(s.options.self_contact),
        paper: Some(paper_out(&s.params)),
        constraints: f.constraints.iter().map(constraint::out).collect(),
        protective_steps: Some(s.params.protective_steps),
        etag: String::new(),
    };
    out.etag = etags::figure(&out);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_choice_of_the_papers_controller_comes_back_as_it_was_sent() {
        let choices = ControlParams {
            alpha: 0.35,
            horizon: None,
            metric: Metric::Torque,
            priority: Priority::Paper,
            share: Share::Paper,
            to_limit: true,
            tilt: false,
            zmp_feasible: false,
            track_hands: false,
            track_com: false,
            hand_over: false,
            ..ControlParams::default()
        };
        for p in [
            ControlParams::default(),
            ControlParams::paper2000(),
            choices,
        ] {
            assert_eq!(paper("paper", Some(&paper_out(&p))).unwrap(), p);
        }
        assert_eq!(paper("paper", None).unwrap(), ControlParams::default());
        let preset = pb::PaperOptions {
            preset: pb::PaperPreset::PaperPreset2000.into(),
            ..Default::default()
        };
        let got = paper("paper", Some(&preset)).unwrap();
        assert_eq!(got, ControlParams::paper2000());
    }

    #[test]
    fn bad_choices_name_their_field() {
        let base = pb::PaperOptions::default();
        let cases = [
            (pb::PaperOptions { metric: 9, ..base }, "paper.metric"),
            (pb::PaperOptions { preset: -1, ..base }, "paper.preset"),
            (
                pb::PaperOptions {
                    alpha: Some(f64::NAN),
                    ..base
                },
                "paper.alpha",
            ),
            (
                pb::PaperOptions {
                    horizon_s: Some(1e-3),
                    ..base
                },
                "paper.horizon_s",
            ),
        ];
        for (options, field) in cases {
            let fault = paper("paper", Some(&options)).unwrap_err();
            assert!(format!("{fault:?}").contains(field), "{fault:?}");
        }
    }
}
