//! `--then`: clips that are played after the first one.

use super::spec::{MAX_TIME, SpecError, number};
use std::str::FromStr;

/// `CLIP@T`: a clip that is played from T seconds on.
#[derive(Clone, Debug, PartialEq)]
pub struct ThenSpec {
    /// BVH file or builtin:NAME.
    pub clip: String,
    /// Start, s.
    pub at_s: f64,
}

impl ThenSpec {
    const FORM: &'static str = "CLIP@T, for example turn.bvh@5";
}

impl FromStr for ThenSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let parts = text.rsplit_once('@').filter(|(clip, _)| !clip.is_empty());
        let Some((clip, at)) = parts else {
            return Err(SpecError::Form {
                got: text.to_owned(),
                form: Self::FORM,
            });
        };
        Ok(Self {
            clip: clip.to_owned(),
            at_s: number("time (s)", at, 0.0, MAX_TIME)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clip_may_have_an_at_in_its_name() {
        let t: ThenSpec = "a@b/turn.bvh@5.5".parse().expect("a clip");
        assert_eq!((t.clip.as_str(), t.at_s), ("a@b/turn.bvh", 5.5));
    }

    #[test]
    fn bad_clips_say_what_is_wrong() {
        for (text, says) in [
            ("turn.bvh", "is not of the form"),
            ("@3", "is not of the form"),
            ("turn.bvh@soon", "time (s): \"soon\" is not a number"),
            ("turn.bvh@-1", "time (s): -1 is outside"),
        ] {
            let error = text.parse::<ThenSpec>().expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
