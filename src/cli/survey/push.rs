//! `--push` of a survey: as for `sinew run`, or at a time and in a direction determined by the clip and the copy.

use crate::args::PushSpec;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sinew_physics::body::{Body, SegmentId};
use sinew_physics::figure::Perturbation;
use sinew_physics::math::Vec3;
use std::fmt;
use std::str::FromStr;

/// Part of the clip in which random pushes begin.
const WITHIN: (f64, f64) = (0.1, 0.9);
/// Largest impulse, N·s.
const MOST: f64 = 1e5;

/// A push.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurveyPush {
    /// At a given time and in a given direction.
    At(PushSpec),
    /// At a time within the clip and in a horizontal direction that follow from a seed.
    Random {
        /// Pushed segment.
        segment: SegmentId,
        /// Impulse, N·s.
        impulse_ns: f64,
    },
}

impl SurveyPush {
    /// The push of a run.
    ///
    /// * `clip`: world times at which the recording begins and ends in that run, s.
    /// * `seed`: of the clip and the copy.
    pub fn perturbation(
        &self,
        body: &Body,
        duration: f64,
        clip: (f64, f64),
        seed: u64,
    ) -> Perturbation {
        match *self {
            Self::At(push) => push.perturbation(body, duration),
            Self::Random {
                segment,
                impulse_ns,
            } => {
                let mut rng = Pcg64Mcg::seed_from_u64(seed);
                let share = rng.random_range(WITHIN.0..WITHIN.1);
                let (s, c) = rng.random_range(0.0..std::f64::consts::TAU).sin_cos();
                PushSpec {
                    segment,
                    impulse_ns,
                    at_s: clip.0 + (clip.1 - clip.0) * share,
                    direction: Vec3::from_array([c, s, 0.0]),
                }
                .perturbation(body, duration)
            }
        }
    }
}

impl FromStr for SurveyPush {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some(head) = text.strip_suffix("@random") else {
            return text
                .parse()
                .map(Self::At)
                .map_err(|e: crate::args::SpecError| {
                    format!("{e}; or NS@random, NS@SEGMENT@random")
                });
        };
        let (impulse, name) = head.split_once('@').unwrap_or((head, "chest"));
        let segment = SegmentId::from_name(name)
            .ok_or_else(|| crate::args::SpecError::Segment(name.to_owned()).to_string())?;
        match impulse.trim().parse::<f64>() {
            Ok(n) if (0.0..=MOST).contains(&n) => Ok(Self::Random {
                segment,
                impulse_ns: n,
            }),
            _ => Err(format!(
                "impulse (N·s): {impulse:?} is no number within 0…{MOST}"
            )),
        }
    }
}

impl fmt::Display for SurveyPush {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::At(p) => {
                let d = p.direction.to_array();
                write!(
                    f,
                    "{}@{}@{}:{},{},{}",
                    p.impulse_ns,
                    p.segment.name(),
                    p.at_s,
                    d[0],
                    d[1],
                    d[2]
                )
            }
            Self::Random {
                segment,
                impulse_ns,
            } => write!(f, "{impulse_ns}@{}@random", segment.name()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_pushes_are_within_the_clip_and_follow_from_their_seed() {
        let body = Body::adult_man();
        let push: SurveyPush = "10@random".parse().expect("a push");
        assert_eq!(push.to_string(), "10@chest@random");
        let of = |seed| match push.perturbation(&body, 0.2, (2.0, 4.0), seed) {
            Perturbation::Force {
                force, from, to, ..
            } => (force, from, to),
            other => panic!("{other:?}"),
        };
        for seed in 0..20 {
            let (force, from, to) = of(seed);
            assert!((2.2..=3.8).contains(&from) && (to - from - 0.2).abs() < 1e-12);
            assert!((force.norm() - 50.0).abs() < 1e-9 && force.z == 0.0);
        }
        assert_eq!(of(3), of(3));
        assert_ne!(of(3), of(4));
    }

    #[test]
    fn bad_pushes_say_what_is_wrong() {
        for (text, says) in [
            ("x@random", "is no number"),
            ("10@nose@random", "there is no segment \"nose\""),
            ("10@chest", "NS@random"),
            ("nan@random", "is no number"),
        ] {
            let error = text.parse::<SurveyPush>().expect_err(text);
            assert!(error.contains(says), "{text}: {error}");
        }
        assert!(matches!(
            "20@chest@1.5:1,0,0".parse(),
            Ok(SurveyPush::At(_))
        ));
    }
}
