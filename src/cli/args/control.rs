//! Controller and stepper, and the options of the paper's controller.

use anyhow::{Result, ensure};
use clap::ValueEnum;
use sinew_physics::figure::{ControlParams, ControllerKind, Metric, Priority, Share, StepperKind};

/// Controller that computes the torques.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ControllerArg {
    /// The paper's controller.
    Paper,
    /// Whole-body optimisation within strength and friction limits.
    #[default]
    Modern,
    /// Strength-limited joint motors that hold the target posture, without balance control.
    Motors,
}

impl From<ControllerArg> for ControllerKind {
    fn from(arg: ControllerArg) -> Self {
        match arg {
            ControllerArg::Paper => Self::Paper,
            ControllerArg::Modern => Self::Modern,
            ControllerArg::Motors => Self::Motors,
        }
    }
}

/// Stepper that moves the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StepperArg {
    /// Torques drive rigid-body dynamics with ground contact.
    #[default]
    Torque,
    /// The accelerations of the controller are integrated directly (for the paper's controller).
    Kinematic,
    /// As kinematic; what a figure meets is met by an impact and a correction of angles, as in section 3 of the paper,
    /// where kinematic hands over to torques.
    Staged,
}

impl From<StepperArg> for StepperKind {
    fn from(arg: StepperArg) -> Self {
        match arg {
            StepperArg::Torque => Self::Torque,
            StepperArg::Kinematic => Self::Kinematic,
            StepperArg::Staged => Self::Staged,
        }
    }
}

/// Starting point of the paper's controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PresetArg {
    /// As published in 2000: --controller paper --stepper kinematic --rate 30, no safeguards, no armature.
    Paper2000,
}

/// Norm of equation (10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum MetricArg {
    /// W = I: all joints share the change.
    #[value(name = "I")]
    Identity,
    /// W = H: only the accelerations of saturated joints change.
    #[value(name = "H")]
    Inertia,
    /// W = H²: only the torques of saturated joints change.
    #[value(name = "H2")]
    Torque,
}

/// Order of equation (12).
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PriorityArg {
    /// As published.
    Paper,
    /// Hands are controlled in the null space of the centre of mass.
    Nested,
}

/// Sharing of the ground reaction between supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShareArg {
    /// By the ratios of equation (2).
    Paper,
    /// Smallest weighted forces with the required sum and moment.
    Balanced,
}

/// Options of the paper's controller; others read some of them, too ([`Self::of_paper_only`]). Options that are not
/// given have the value of the preset, or their default without one.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Paper's controller")]
pub struct PaperOptions {
    /// Preset for the options below.
    #[arg(long, value_enum, conflicts_with_all = ["controller", "stepper"])]
    pub preset: Option<PresetArg>,
    /// Weight of the position demand against the velocity demand in equation (4) per 1/30 s, 0 to 1; used with
    /// --horizon 0.
    #[arg(long, value_name = "A")]
    pub alpha: Option<f64>,
    /// Time constant of the demand, 0.01 to 2 s; 0: met within one step, as published.
    #[arg(long, value_name = "S")]
    pub horizon: Option<f64>,
    /// Norm of the smallest change, equation (10).
    #[arg(long, value_enum, ignore_case = true)]
    pub metric: Option<MetricArg>,
    /// Priority of centre of mass and hands, equation (12).
    #[arg(long, value_enum)]
    pub priority: Option<PriorityArg>,
    /// Sharing of the ground reaction between supports.
    #[arg(long, value_enum)]
    pub share: Option<ShareArg>,
    /// Joints that equation (16) saturates use their full limit.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub to_limit: Option<bool>,
    /// Account for the rotating support in the torques of a tipping figure.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub tilt: Option<bool>,
    /// Limit the demand for the centre of mass to what the feet can provide.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub zmp_feasible: Option<bool>,
    /// Control both hands.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub track_hands: Option<bool>,
    /// Control the centre of mass.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub track_com: Option<bool>,
    /// Kinematic stepper: hand over to torques while the prescribed accelerations are not feasible.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub hand_over: Option<bool>,
}

impl PaperOptions {
    /// The options as parameters of the controller.
    ///
    /// # Errors
    /// A number outside its range; names it.
    pub fn params(&self) -> Result<ControlParams> {
        let mut out = match self.preset {
            Some(PresetArg::Paper2000) => ControlParams::paper2000(),
            None => ControlParams::default(),
        };
        if let Some(alpha) = self.alpha {
            ensure!((0.0..=1.0).contains(&alpha), "--alpha {alpha}: outside 0…1");
            out.alpha = alpha;
        }
        match self.horizon {
            Some(0.0) => out.horizon = None,
            Some(t) => {
                ensure!(
                    (0.01..=2.0).contains(&t),
                    "--horizon {t} s: must be 0 or within 0.01…2"
                );
                out.horizon = Some(t);
            }
            None => {}
        }
        out.metric = match self.metric {
            Some(MetricArg::Identity) => Metric::Identity,
            Some(MetricArg::Inertia) => Metric::Inertia,
            Some(MetricArg::Torque) => Metric::Torque,
            None => out.metric,
        };
        out.priority = match self.priority {
            Some(PriorityArg::Paper) => Priority::Paper,
            Some(PriorityArg::Nested) => Priority::Nested,
            None => out.priority,
        };
        out.share = match self.share {
            Some(ShareArg::Paper) => Share::Paper,
            Some(ShareArg::Balanced) => Share::Balanced,
            None => out.share,
        };
        for (to, from) in [
            (&mut out.to_limit, self.to_limit),
            (&mut out.tilt, self.tilt),
            (&mut out.zmp_feasible, self.zmp_feasible),
            (&mut out.track_hands, self.track_hands),
            (&mut out.track_com, self.track_com),
            (&mut out.hand_over, self.hand_over),
        ] {
            *to = from.unwrap_or(*to);
        }
        Ok(out)
    }

    /// Names of the given options that only the paper's controller reads.
    pub fn of_paper_only(&self) -> impl Iterator<Item = &'static str> {
        let given = [
            ("--metric", self.metric.is_some()),
            ("--priority", self.priority.is_some()),
            ("--share", self.share.is_some()),
            ("--to-limit", self.to_limit.is_some()),
            ("--tilt", self.tilt.is_some()),
            ("--zmp-feasible", self.zmp_feasible.is_some()),
        ];
        given
            .into_iter()
            .filter(|(_, is)| *is)
            .map(|(name, _)| name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(clap::Parser)]
    struct Tuned {
        #[arg(long, default_value = "modern")]
        controller: String,
        #[arg(long, default_value = "torque")]
        stepper: String,
        #[command(flatten)]
        paper: PaperOptions,
    }

    fn tuned(arguments: &[&str]) -> Result<ControlParams> {
        let all = ["sinew"].iter().chain(arguments);
        let t = <Tuned as clap::Parser>::try_parse_from(all)?;
        assert!(!t.controller.is_empty() && !t.stepper.is_empty());
        t.paper.params()
    }

    #[test]
    fn choices_of_the_papers_controller_start_from_the_preset() {
        assert_eq!(tuned(&[]).expect("none given"), ControlParams::default());
        let printed = tuned(&["--preset", "paper2000"]).expect("the preset");
        assert_eq!(printed, ControlParams::paper2000());
        let some = [
            "--preset",
            "paper2000",
            "--metric",
            "h2",
            "--tilt",
            "--horizon",
            "0.2",
        ];
        let want = ControlParams {
            metric: Metric::Torque,
            tilt: true,
            horizon: Some(0.2),
            ..ControlParams::paper2000()
        };
        assert_eq!(tuned(&some).expect("valid"), want);
        let off = tuned(&["--tilt=false", "--horizon", "0", "--alpha", "0.5"]).expect("valid");
        assert!(!off.tilt && off.horizon.is_none() && off.alpha == 0.5);
    }

    #[test]
    fn bad_choices_of_the_papers_controller_are_refused() {
        for bad in [
            ["--horizon", "5"],
            ["--alpha", "nan"],
            ["--metric", "H3"],
            ["--tilt=maybe", "--track-com"],
        ] {
            assert!(tuned(&bad).is_err(), "{bad:?}");
        }
        assert!(tuned(&["--preset", "paper2000", "--stepper", "torque"]).is_err());
    }
}
