//! The value of `--pushes`.

use sinew_evaluate::survey::pushes::PushedWhile;
use std::str::FromStr;

/// Largest impulse, N·s, and number of impulses.
const MOST: f64 = 1e5;
const MANY: usize = 16;

/// `PHASE:NS,NS…`: pushes of these impulses while figures start, walk or stand.
#[derive(Clone, Debug, PartialEq)]
pub struct PushesSpec {
    pub(super) phase: PushedWhile,
    pub(super) impulses: Vec<f64>,
}

impl FromStr for PushesSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("{text:?} is not start, walk or stand, then :NS,NS…: start:20,30");
        let (phase, impulses) = text.split_once(':').ok_or_else(form)?;
        let phase = match phase {
            "start" => PushedWhile::Start,
            "walk" => PushedWhile::Walk,
            "stand" => PushedWhile::Stand,
            _ => return Err(form()),
        };
        let number = |text: &str| match text.trim().parse::<f64>() {
            Ok(n) if (0.0..=MOST).contains(&n) => Ok(n),
            _ => Err(format!(
                "impulse (N·s): {text:?} is no number within 0…{MOST}"
            )),
        };
        let impulses = impulses
            .split(',')
            .map(number)
            .collect::<Result<Vec<_>, _>>()?;
        if impulses.len() > MANY {
            return Err(format!("{} impulses: at most {MANY}", impulses.len()));
        }
        Ok(Self { phase, impulses })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pushes_are_read_and_mistakes_are_told() {
        let spec: PushesSpec = "start:20,30".parse().unwrap();
        assert_eq!(
            (spec.phase, spec.impulses),
            (PushedWhile::Start, vec![20.0, 30.0])
        );
        let many = format!("stand:{}1", "1,".repeat(MANY));
        for (text, says) in [
            ("20", "start:20,30"),
            ("run:20", "start, walk or stand"),
            ("stand:x", "is no number"),
            ("stand:-1", "is no number"),
            (many.as_str(), "17 impulses"),
        ] {
            let error = text.parse::<PushesSpec>().expect_err(text);
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
