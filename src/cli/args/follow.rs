//! How far a figure may go so that it keeps its motion.

use crate::exit::within;
use anyhow::Result;
use sinew_physics::rehearsal::follow::Follow;
use sinew_wire::types::{FollowSettings, FollowUpdate};

/// How far a figure may go so that it keeps a clip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum FollowArg {
    /// Plain tracking: physics alone, it falls honestly.
    Strict,
    /// A rehearsal where plain tracking fails; no help.
    Rehearsed,
    /// Help while the motion is being lost, or the least that a rehearsal finds.
    #[default]
    Assisted,
    /// The same to the end, with as much help as that takes.
    Always,
}

impl From<FollowArg> for Follow {
    fn from(arg: FollowArg) -> Self {
        match arg {
            FollowArg::Strict => Self::Strict,
            FollowArg::Rehearsed => Self::Rehearsed,
            FollowArg::Assisted => Self::Assisted,
            FollowArg::Always => Self::Always,
        }
    }
}

/// How far a figure may go that would lose its motion while it follows it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum LiveFollowArg {
    /// Physics alone, it falls honestly.
    #[default]
    Strict,
    /// A force and a moment on the pelvis, bounded and reported.
    Assisted,
    /// The same to the end of the motion, with as much as that takes.
    Always,
}

/// Help while a motion is being lost.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct LiveHelpArgs {
    /// Means for a figure that is losing its motion: none, help, or help to the end; reported as assist_*
    /// [default: strict, or assisted if --max-help is above 0].
    #[arg(long, value_enum)]
    follow: Option<LiveFollowArg>,
    /// Largest force of the help over the weight, 0 to 2 [default: 0.3 with assisted, 1 with always].
    #[arg(long, value_name = "SHARE")]
    max_help: Option<f64>,
}

impl LiveHelpArgs {
    /// The means, and the bound of the help.
    pub fn settings(&self) -> FollowSettings {
        FollowSettings::default().changed(FollowUpdate {
            follow: self.follow.map(|f| match f {
                LiveFollowArg::Strict => Follow::Strict,
                LiveFollowArg::Assisted => Follow::Assisted,
                LiveFollowArg::Always => Follow::Always,
            }),
            most_help: self.max_help.map(Some),
        })
    }

    /// The option that asks for help.
    pub fn option(&self) -> &'static str {
        match self.follow {
            Some(_) => "--follow",
            None => "--max-help",
        }
    }

    /// Largest force of the help over the weight; 0: none.
    pub fn most(&self) -> f64 {
        self.settings().most_help()
    }
}

/// Options of rehearsals, as `sinew survey` has them too.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct HelpArgs {
    /// Largest force of the help as a share of the weight, 0 to 2 [default: 0.3 with assisted, 1 with always].
    #[arg(long, value_name = "SHARE")]
    pub max_help: Option<f64>,
    /// Which random numbers a rehearsal draws.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
}

impl HelpArgs {
    /// Checks the conditions that clap cannot.
    ///
    /// # Errors
    /// A share out of range.
    pub fn check(&self) -> Result<()> {
        within("--max-help", self.max_help.unwrap_or(0.0), [0.0, 2.0])
    }

    /// Largest force of the help over the weight, by these means.
    pub fn most(&self, follow: FollowArg) -> f64 {
        self.max_help
            .unwrap_or_else(|| Follow::from(follow).most_help())
    }
}
