//! `--push`: pushes.

use super::spec::{MAX_TIME, SpecError, number, segment};
use sinew_physics::body::{Body, SegmentId};
use sinew_physics::figure::Perturbation;
use sinew_physics::math::Vec3;
use std::str::FromStr;

/// `NS@SEGMENT@T:x,y,z`: a push of NS newton-seconds on a segment, starting at T seconds, along the world direction x,
/// y, z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PushSpec {
    /// Pushed segment.
    pub segment: SegmentId,
    /// Impulse, N·s.
    pub impulse_ns: f64,
    /// Starts at, s.
    pub at_s: f64,
    /// Unit vector, world axes.
    pub direction: Vec3,
}

impl PushSpec {
    const FORM: &'static str = "NS@SEGMENT@T:x,y,z, for example 20@chest@1.5:1,0,0";

    /// The push as a constant force at the segment's centre of mass for `duration` seconds.
    pub fn perturbation(&self, body: &Body, duration: f64) -> Perturbation {
        Perturbation::Force {
            segment: self.segment,
            point: body.segment(self.segment).com,
            force: self.direction * (self.impulse_ns / duration),
            from: self.at_s,
            to: self.at_s + duration,
        }
    }
}

impl FromStr for PushSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let (head, direction) = text.split_once(':').ok_or_else(form)?;
        let head: Vec<&str> = head.split('@').collect();
        let direction: Vec<&str> = direction.split(',').collect();
        let ([impulse, name, at], [x, y, z]) = (head.as_slice(), direction.as_slice()) else {
            return Err(form());
        };
        let component = |t: &str| number("direction", t, -1e6, 1e6);
        let d = Vec3 {
            x: component(x)?,
            y: component(y)?,
            z: component(z)?,
        };
        if d.norm() < 1e-9 {
            return Err(SpecError::Direction);
        }
        Ok(Self {
            impulse_ns: number("impulse (N·s)", impulse, 0.0, 1e5)?,
            segment: segment(name)?,
            at_s: number("time (s)", at, 0.0, MAX_TIME)?,
            direction: d * (1.0 / d.norm()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pushes_are_read_and_normalised() {
        let p: PushSpec = "20@chest@1.5:0,-3,4".parse().expect("a push");
        assert_eq!(
            (p.impulse_ns, p.segment.name(), p.at_s),
            (20.0, "chest", 1.5)
        );
        assert!((p.direction.y + 0.6).abs() < 1e-15 && (p.direction.z - 0.8).abs() < 1e-15);
    }

    #[test]
    fn bad_pushes_say_what_is_wrong() {
        for (text, says) in [
            ("20@chest@1.5", "is not of the form"),
            ("20@chest:1,0,0", "is not of the form"),
            ("20@chest@1:1,0", "is not of the form"),
            ("20@chest@1:1,0,up", "direction: \"up\" is not a number"),
            ("20@chest@1:0,0,0", "no direction"),
            ("20@chest@-1:1,0,0", "time (s): -1 is outside"),
            ("inf@chest@1:1,0,0", "impulse (N·s): inf is outside"),
        ] {
            let error = text.parse::<PushSpec>().expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
