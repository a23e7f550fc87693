//! Names of bodies: one list for the command line, the API and the clients.
//!
//! Five profiles have their own name ([`NAMED_BODIES`]). Every other profile is named by its values,
//! `{sex}-{age}y-{height}mm-{mass}g`, for example `female-25y-1680mm-61500g`.

use super::model::{Profile, Sex};

/// Bodies with their own name: name, sex, age in years. Stature and mass are those of an ordinary person of that sex
/// and age.
pub const NAMED_BODIES: [(&str, Sex, f64); 5] = [
    ("adult-man", Sex::Male, 30.0),
    ("adult-woman", Sex::Female, 30.0),
    ("child", Sex::Male, 8.0),
    ("older-man", Sex::Male, 75.0),
    ("older-woman", Sex::Female, 75.0),
];

/// The default body.
pub const DEFAULT_BODY: &str = NAMED_BODIES[0].0;

/// The accepted forms of a body name, for error messages.
pub fn body_name_forms() -> String {
    let names: Vec<&str> = NAMED_BODIES.iter().map(|(name, ..)| *name).collect();
    format!(
        "{}, or a profile SEX-AGEy-HEIGHTmm-MASSg such as female-25y-1680mm-61500g",
        names.join(", ")
    )
}

/// `male` or `female`.
pub fn sex_name(sex: Sex) -> &'static str {
    match sex {
        Sex::Male => "male",
        Sex::Female => "female",
    }
}

impl Profile {
    /// The profile with its age in tenths of a year, its stature in whole millimetres and its mass in whole grams, as
    /// names write them.
    #[must_use]
    pub fn rounded(self) -> Self {
        Self {
            age: (self.age * 10.0).round() / 10.0,
            height: (self.height * 1e3).round() / 1e3,
            mass: (self.mass * 1e3).round() / 1e3,
            ..self
        }
    }

    /// The name by value: `{sex}-{age}y-{height}mm-{mass}g`. Exact for a [rounded](Self::rounded) profile.
    pub fn value_name(&self) -> String {
        format!(
            "{}-{}y-{}mm-{}g",
            sex_name(self.sex),
            self.age,
            (self.height * 1e3).round(),
            (self.mass * 1e3).round()
        )
    }

    /// The short name if the profile is one of [`NAMED_BODIES`], else the name by value.
    pub fn name(&self) -> String {
        let named = NAMED_BODIES
            .iter()
            .find(|(_, sex, age)| Self::ordinary(*sex, *age) == *self);
        named.map_or_else(|| self.value_name(), |(name, ..)| (*name).to_owned())
    }

    /// The profile of a name of either kind; `None` for any other text. Building a body checks whether the body tables
    /// cover the profile.
    pub fn from_name(name: &str) -> Option<Self> {
        let named = NAMED_BODIES.iter().find(|(n, ..)| *n == name);
        named
            .map(|(_, sex, age)| Self::ordinary(*sex, *age))
            .or_else(|| Self::from_value_name(name))
    }

    fn from_value_name(name: &str) -> Option<Self> {
        let mut parts = name.split('-');
        let sex = match parts.next()? {
            "male" => Sex::Male,
            "female" => Sex::Female,
            _ => return None,
        };
        let mut number = |unit: &str| -> Option<f64> {
            let digits = parts.next()?.strip_suffix(unit)?;
            let plain =
                digits.len() <= 8 && digits.bytes().all(|b| b.is_ascii_digit() || b == b'.');
            plain.then(|| digits.parse().ok()).flatten()
        };
        let (age, height, mass) = (number("y")?, number("mm")?, number("g")?);
        let profile = Self {
            sex,
            age,
            height: height / 1e3,
            mass: mass / 1e3,
        };
        // Accept only one spelling per profile.
        (parts.next().is_none() && profile.value_name() == name).then_some(profile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_body_is_found_by_its_name_and_named_by_its_profile() {
        for (name, sex, age) in NAMED_BODIES {
            let profile = Profile::from_name(name).expect(name);
            assert_eq!(profile, Profile::ordinary(sex, age));
            assert_eq!(profile.name(), name);
            assert_eq!(
                profile.rounded(),
                profile,
                "{name}: its name by value is exact"
            );
        }
        assert_eq!(DEFAULT_BODY, "adult-man");
    }

    #[test]
    fn names_by_value_say_the_profile() {
        let profile = Profile::from_name("female-25y-1680mm-61500g").expect("a profile");
        let want = Profile {
            sex: Sex::Female,
            age: 25.0,
            height: 1.68,
            mass: 61.5,
        };
        assert_eq!(profile, want);
        assert_eq!(profile.name(), "female-25y-1680mm-61500g");
        for bad in [
            "man",
            "male",
            "male-30y",
            "male-30y-1750mm-75000g-x",
            "male-030y-1750mm-75000g",
            "male-1e1y-1750mm-75000g",
            "male--1y-1750mm-75000g",
            "",
        ] {
            assert!(Profile::from_name(bad).is_none(), "{bad}");
        }
    }
}
