//! The body of the figure.

use crate::exit::{UsageError, usage};
use crate::number::kilograms;
use anyhow::Result;
use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;
use sinew_physics::body::model::BodyError;
use sinew_physics::body::names::{DEFAULT_BODY, NAMED_BODIES, body_name_forms, sex_name};
use sinew_physics::body::{Body, Profile};
use std::ffi::OsStr;

/// Which body the figure has.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct BodyArgs {
    /// Name of the body, as in the API: one of these, or a profile such as female-25y-1680mm-61500g [default:
    /// adult-man].
    #[arg(long, value_name = "NAME", value_parser = BodyNameParser)]
    pub body: Option<Profile>,
    /// Age, years, 6 to 90; the age of the named body unless given.
    #[arg(long, value_name = "YEARS")]
    pub age: Option<f64>,
    /// Stature, m; average for sex and age unless given.
    #[arg(long, value_name = "M")]
    pub height: Option<f64>,
    /// Body mass, kg; average for sex and age unless given.
    #[arg(long, value_name = "KG")]
    pub mass: Option<f64>,
}

impl BodyArgs {
    /// Whether none of the options is given.
    pub fn is_default(&self) -> bool {
        self.body.is_none() && !self.changes_profile()
    }

    fn changes_profile(&self) -> bool {
        self.age.or(self.height).or(self.mass).is_some()
    }

    /// The profile of the named body, changed by age, height and mass.
    ///
    /// # Errors
    /// The name describes a body by values, and one of the options is given as well.
    pub fn profile(&self) -> Result<Profile> {
        let base = self
            .body
            .or_else(|| Profile::from_name(DEFAULT_BODY))
            .expect("the default body has a profile");
        if !self.changes_profile() {
            return Ok(base);
        }
        if base.name() == base.value_name() {
            let text = format!(
                "--body {} gives age, height and mass already: leave out --age, --height and --mass",
                base.name()
            );
            return Err(UsageError(text).into());
        }
        let average = Profile::ordinary(base.sex, self.age.unwrap_or(base.age));
        Ok(Profile {
            height: self.height.unwrap_or(average.height),
            mass: self.mass.unwrap_or(average.mass),
            ..average
        }
        .rounded())
    }

    /// Builds the body.
    ///
    /// # Errors
    /// When the tables do not cover the profile; names the value and its range.
    pub fn build(&self) -> Result<Body> {
        let profile = self.profile()?;
        Body::humanoid(profile).map_err(|e| self.refused(&profile, e))
    }

    /// Describes the error in a profile, naming the option that has to be changed.
    fn refused(&self, profile: &Profile, error: BodyError) -> anyhow::Error {
        let BodyError::Profile {
            field,
            value,
            lower,
            upper,
        } = error
        else {
            return usage(error);
        };
        let flag = match field {
            "age_years" if self.age.is_some() => "--age",
            "height_m" if self.height.is_some() => "--height",
            "mass_kg" if self.mass.is_some() => "--mass",
            _ => {
                let context = format!(
                    "--body {}: the body tables do not cover this",
                    profile.name()
                );
                return usage(anyhow::Error::from(error).context(context));
            }
        };
        // Ranges of height and mass depend on the age.
        let of_age = match flag {
            "--age" => String::new(),
            _ => format!(" at {} years", profile.age),
        };
        let text =
            format!("{flag} {value}: outside {lower}…{upper}, what the body tables cover{of_age}");
        UsageError(text).into()
    }
}

/// Reads a body name; the names with a profile of their own are offered to help texts and shells.
#[derive(Clone, Copy, Debug)]
pub struct BodyNameParser;

impl TypedValueParser for BodyNameParser {
    type Value = Profile;

    fn parse_ref(
        &self,
        command: &clap::Command,
        _: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<Profile, clap::Error> {
        let name = value.to_string_lossy();
        Profile::from_name(&name).ok_or_else(|| {
            let text = format!(
                "there is no body {name:?}; the bodies are {}\n",
                body_name_forms()
            );
            clap::Error::raw(ErrorKind::InvalidValue, text).with_cmd(command)
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(NAMED_BODIES.iter().map(|(name, sex, age)| {
            PossibleValue::new(name).help(describe(&Profile::ordinary(*sex, *age)))
        })))
    }
}

/// Age, stature and mass of a profile.
pub fn describe(p: &Profile) -> String {
    format!("{} years, {:.2} m, {}", p.age, p.height, kilograms(p.mass))
}

/// The name of one of the named bodies, else `male` or `female`: for headings that give age, stature and mass as well.
pub fn short_name(p: &Profile) -> String {
    let named = p.name();
    if named == p.value_name() {
        sex_name(p.sex).to_owned()
    } else {
        named
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_physics::body::Sex;

    #[test]
    fn options_change_the_named_profile() {
        let args = BodyArgs {
            body: Profile::from_name("adult-woman"),
            height: Some(1.600_4),
            ..BodyArgs::default()
        };
        let p = args.profile().expect("a profile");
        assert_eq!((p.sex, p.age, p.height), (Sex::Female, 30.0, 1.6));
        assert_eq!(p.name(), "female-30y-1600mm-62000g");
        let plain = BodyArgs::default();
        assert!(plain.is_default());
        assert_eq!(plain.profile().expect("a profile").name(), "adult-man");
    }

    #[test]
    fn the_option_that_is_to_be_changed_is_named() {
        let refused = |args: &BodyArgs| {
            let error = args.build().expect_err("outside the tables");
            assert!(error.is::<UsageError>());
            error.to_string()
        };
        let age = BodyArgs {
            age: Some(3.0),
            ..BodyArgs::default()
        };
        let says = "--age 3: outside 6…90, what the body tables cover";
        assert_eq!(refused(&age), says);
        let mass = BodyArgs {
            mass: Some(-1.0),
            ..BodyArgs::default()
        };
        let text = refused(&mass);
        assert!(
            text.starts_with("--mass -1: outside 35…180") && text.ends_with("at 30 years"),
            "{text}"
        );
        let by_value = BodyArgs {
            body: Profile::from_name("female-3y-1680mm-61500g"),
            ..BodyArgs::default()
        };
        let text = refused(&by_value);
        assert!(
            text.starts_with("--body female-3y-1680mm-61500g: "),
            "{text}"
        );
    }

    #[test]
    fn a_profile_by_value_takes_no_further_values() {
        let args = BodyArgs {
            body: Profile::from_name("female-25y-1680mm-61500g"),
            age: Some(30.0),
            ..BodyArgs::default()
        };
        let error = args.profile().expect_err("two ages").to_string();
        assert!(error.contains("--age"), "{error}");
    }
}
