//! Who the figure stands for.

use crate::sim::body::{Body, Profile, Sex};
use anyhow::{Context, Result};
use clap::ValueEnum;

/// Which body tables are used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyKind {
    /// Adult man; 30 years, 1.75 m, 75 kg unless said otherwise.
    #[default]
    Man,
    /// Adult woman, of average size unless said otherwise.
    Woman,
    /// Child; 8 years, of ordinary size for the age unless said otherwise. Up to 10 years boys and girls are alike.
    Child,
    /// Older man; 75 years, of ordinary size unless said otherwise.
    OlderMan,
    /// Older woman; 75 years, of ordinary size unless said otherwise.
    OlderWoman,
}

/// Who the figure stands for.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct BodyArgs {
    /// Body and strength tables.
    #[arg(long, value_enum, default_value_t)]
    pub body: BodyKind,
    /// Age, years, 6 to 90.
    #[arg(long, value_name = "YEARS")]
    pub age: Option<f64>,
    /// Stature, m; ordinary for sex and age unless given.
    #[arg(long, value_name = "M")]
    pub height: Option<f64>,
    /// Body mass, kg; ordinary for sex and age unless given.
    #[arg(long, value_name = "KG")]
    pub mass: Option<f64>,
}

impl BodyArgs {
    /// Builds the body.
    ///
    /// # Errors
    /// When the tables do not cover the profile; names the value and its range.
    pub fn build(&self) -> Result<Body> {
        let (sex, age) = match self.body {
            BodyKind::Man => (Sex::Male, 30.0),
            BodyKind::Woman => (Sex::Female, 30.0),
            BodyKind::Child => (Sex::Male, 8.0),
            BodyKind::OlderMan => (Sex::Male, 75.0),
            BodyKind::OlderWoman => (Sex::Female, 75.0),
        };
        let ordinary = Profile::ordinary(sex, self.age.unwrap_or(age));
        let profile = Profile {
            height: self.height.unwrap_or(ordinary.height),
            mass: self.mass.unwrap_or(ordinary.mass),
            ..ordinary
        };
        Body::humanoid(profile).context("no such body")
    }
}

/// `man` or `woman`.
pub fn sex_name(sex: Sex) -> &'static str {
    match sex {
        Sex::Male => "man",
        Sex::Female => "woman",
    }
}

/// What people call someone of this sex and age, for headings.
pub fn person_name(p: &Profile) -> &'static str {
    match (p.sex, p.age) {
        (_, a) if a <= 10.0 => "child",
        (Sex::Male, a) if a < 18.0 => "boy",
        (Sex::Female, a) if a < 18.0 => "girl",
        (Sex::Male, a) if a >= 65.0 => "older man",
        (Sex::Female, a) if a >= 65.0 => "older woman",
        (sex, _) => sex_name(sex),
    }
}
