//! `--load`: loads that the figure holds.

use super::spec::{SpecError, interval, number, segment};
use crate::exit::usage;
use sinew_physics::body::palm::load_point;
use sinew_physics::body::topology::{L_HAND, R_HAND};
use sinew_physics::body::{Body, SegmentId};
use sinew_physics::figure::{HeldLoad, Perturbation, SecondHand};
use sinew_physics::math::Vec3;
use sinew_physics::rehearsal::follow::FollowError;
use std::fmt;
use std::str::FromStr;

/// `KG@SEGMENT[+SEGMENT|+auto|+always][@T0..T1]`: a load held by one or two segments, from T0 to T1 seconds; either end
/// may be left out. With `auto` the other hand helps when one arm is too weak, with `always` at all times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadSpec {
    /// Carrying segment.
    pub segment: SegmentId,
    /// Second carrying segment.
    pub second: Option<SegmentId>,
    /// When the other hand helps.
    pub help: Option<SecondHand>,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Picked up at, s.
    pub from_s: f64,
    /// Dropped at, s; infinite = never.
    pub to_s: f64,
}

impl LoadSpec {
    const FORM: &'static str = "KG@SEGMENT[+SEGMENT|+auto|+always][@T0..T1], for example 3@r_hand, 8@l_hand+r_hand, \
         8@r_hand+auto or 3@r_hand@1.0..2.5";

    /// The load in the palm of a hand, or at another segment's centre of mass ([`load_point`]).
    ///
    /// * `grip`: force at one hand beyond which it slips, N.
    pub fn perturbation(&self, body: &Body, grip: f64) -> Perturbation {
        let at = |s: SegmentId| load_point(body, s);
        let load = HeldLoad {
            segment: self.segment,
            point: at(self.segment),
            mass: self.mass_kg,
            velocity: Vec3::zero(),
            second: self.second.map(|s| (s, at(s))),
            grip,
            from: self.from_s,
            to: self.to_s,
        };
        match self.help {
            None => Perturbation::Held(load),
            Some(when) => Perturbation::Helped { load, when },
        }
    }

    /// Checks that a rehearsal can carry the load; otherwise the error would come only after plain tracking has failed.
    ///
    /// # Errors
    /// A load held by two hands, or one that is picked up or put down during the clip.
    pub fn check_rehearsable(&self) -> anyhow::Result<()> {
        let error = if self.second.is_some() || self.help.is_some() {
            FollowError::TwoHands
        } else if self.from_s > 0.0 || self.to_s.is_finite() {
            FollowError::ChangingLoad
        } else {
            return Ok(());
        };
        let context = format!("--load {self}");
        Err(usage(anyhow::Error::from(error).context(context)))
    }
}

/// In the form of the argument.
impl fmt::Display for LoadSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}", self.mass_kg, self.segment.name())?;
        match (self.second, self.help) {
            (Some(second), _) => write!(f, "+{}", second.name())?,
            (None, Some(SecondHand::Auto)) => f.write_str("+auto")?,
            (None, Some(SecondHand::Always)) => f.write_str("+always")?,
            (None, None) => {}
        }
        match (self.from_s > 0.0, self.to_s.is_finite()) {
            (false, false) => Ok(()),
            (_, false) => write!(f, "@{}..", self.from_s),
            (_, true) => write!(f, "@{}..{}", self.from_s, self.to_s),
        }
    }
}

impl FromStr for LoadSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let mut parts = text.split('@');
        let (Some(mass), Some(name), times, None) =
            (parts.next(), parts.next(), parts.next(), parts.next())
        else {
            return Err(form());
        };
        let (from_s, to_s) = times.map_or(Ok((0.0, f64::INFINITY)), |t| interval(t, form))?;
        let (name, second, help) = match name.split_once('+') {
            Some((first, "auto")) => (first, None, Some(SecondHand::Auto)),
            Some((first, "always")) => (first, None, Some(SecondHand::Always)),
            Some((first, second)) => (first, Some(segment(second)?), None),
            None => (name, None, None),
        };
        let first = segment(name)?;
        let is_hand = first == L_HAND || first == R_HAND;
        if second == Some(first) || (help.is_some() && !is_hand) {
            return Err(form());
        }
        Ok(Self {
            mass_kg: number("mass (kg)", mass, 0.0, 500.0)?,
            segment: first,
            second,
            help,
            from_s,
            to_s,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_are_read() {
        let l: LoadSpec = "3.5@r_hand".parse().expect("a load");
        assert_eq!(
            (l.mass_kg, l.segment.name(), l.from_s, l.to_s),
            (3.5, "r_hand", 0.0, f64::INFINITY)
        );
        let l: LoadSpec = "2@l_hand@1..2.5".parse().expect("a load");
        assert_eq!((l.from_s, l.to_s), (1.0, 2.5));
        let l: LoadSpec = "2@l_hand@..2".parse().expect("a load");
        assert_eq!((l.from_s, l.to_s), (0.0, 2.0));
        let l: LoadSpec = "2@l_hand@1..".parse().expect("a load");
        assert_eq!((l.from_s, l.to_s), (1.0, f64::INFINITY));
        let helped = |text: &str| text.parse::<LoadSpec>().expect("a load").help;
        assert_eq!(helped("2@l_hand+auto@1.."), Some(SecondHand::Auto));
        assert_eq!(helped("2@r_hand+always"), Some(SecondHand::Always));
        assert_eq!(helped("2@r_hand+l_hand"), None);
    }

    #[test]
    fn loads_are_written_as_they_are_read() {
        for text in [
            "3.5@r_hand",
            "8@l_hand+r_hand",
            "2@l_hand+auto@1..",
            "2@r_hand+always@0..2.5",
            "0@chest@1..2",
        ] {
            let load: LoadSpec = text.parse().expect("a load");
            assert_eq!(load.to_string(), text);
        }
    }

    #[test]
    fn loads_that_cannot_be_rehearsed_are_named() {
        let check = |text: &str| {
            text.parse::<LoadSpec>()
                .expect("a load")
                .check_rehearsable()
        };
        check("3@r_hand").expect("one hand, all the time");
        for (text, says) in [
            ("3@r_hand+auto", "two hands"),
            ("3@r_hand+always", "two hands"),
            ("3@r_hand+l_hand", "two hands"),
            ("3@r_hand@1..2", "taken up or let go"),
            ("3@r_hand@0..2", "taken up or let go"),
        ] {
            let error = check(text).expect_err(text);
            assert!(error.is::<crate::exit::UsageError>(), "{text}");
            let error = error.to_string();
            assert!(
                error.starts_with(&format!("--load {text}: ")) && error.contains(says),
                "{error}"
            );
        }
    }

    #[test]
    fn bad_loads_say_what_is_wrong() {
        for (text, says) in [
            ("3", "is not of the form"),
            ("3@r_hand@1", "is not of the form"),
            ("3@r_hand@1..2@3", "is not of the form"),
            ("x@r_hand", "mass (kg): \"x\" is not a number"),
            ("nan@r_hand", "mass (kg): NaN is outside 0…500"),
            ("-1@r_hand", "mass (kg): -1 is outside 0…500"),
            ("3@chest+auto", "is not of the form"),
            ("3@tail", "there is no segment \"tail\""),
            ("3@r_hand@2..1", "the interval 2..1 s is empty"),
        ] {
            let error = text.parse::<LoadSpec>().expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
