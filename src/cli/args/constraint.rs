//! `--constrain`: target positions of segments and of the centre of mass.

use super::spec::{SpecError, interval, number, segment};
use sinew_physics::body::{Body, SegmentId};
use sinew_physics::figure::motion::tasks::held_point;
use sinew_physics::figure::{Constrained, Constraint};
use sinew_physics::math::{Quat, Vec3};
use std::str::FromStr;

/// `PART@x,y,z[@T0..T1][:qx,qy,qz,qw]`: target position and rotation of a segment, or target position of the centre of
/// mass (`com`); `_` leaves an axis free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstraintSpec {
    /// Segment; `None`: the centre of mass.
    pub part: Option<SegmentId>,
    /// Target coordinates, m.
    pub position: [Option<f64>; 3],
    /// Target rotation.
    pub rotation: Option<Quat>,
    /// Starts at, s.
    pub from_s: f64,
    /// Ends at, s; infinite = never.
    pub to_s: f64,
}

impl ConstraintSpec {
    const FORM: &'static str =
        "PART@x,y,z[@T0..T1][:qx,qy,qz,qw], for example r_hand@0.4,-0.25,1.1@1..3 or com@_,0.08,_";

    /// The constraint on a figure of this body.
    pub fn constraint(&self, body: &Body) -> Constraint {
        let [x, y, z] = self.position.map(|x| x.unwrap_or(0.0));
        let any = self.position.iter().any(Option::is_some);
        Constraint {
            on: self.part.map_or(Constrained::CenterOfMass, |s| {
                Constrained::Point(s, held_point(body, s))
            }),
            position: any.then_some(Vec3 { x, y, z }),
            axes: self.position.map(|x| f64::from(u8::from(x.is_some()))),
            rotation: self.rotation,
            weight: 1.0,
            ease: 0.5,
            from: self.from_s,
            to: self.to_s,
        }
    }
}

impl FromStr for ConstraintSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let (rest, turn) = match text.split_once(':') {
            Some((rest, turn)) => (rest, Some(turn)),
            None => (text, None),
        };
        let mut parts = rest.split('@');
        let (Some(name), Some(place), times, None) =
            (parts.next(), parts.next(), parts.next(), parts.next())
        else {
            return Err(form());
        };
        let part = match name.trim() {
            "com" => None,
            name => Some(segment(name)?),
        };
        let mut position = [None; 3];
        let mut given = place.split(',');
        for (p, what) in position.iter_mut().zip(["x (m)", "y (m)", "z (m)"]) {
            *p = match given.next().ok_or_else(form)?.trim() {
                "_" => None,
                text => Some(number(what, text, -1e4, 1e4)?),
            };
        }
        if given.next().is_some() {
            return Err(form());
        }
        let (from_s, to_s) = times.map_or(Ok((0.0, f64::INFINITY)), |t| interval(t, form))?;
        let rotation = turn
            .map(|t| {
                let q = t
                    .split(',')
                    .map(|c| number("quaternion", c, -1.0, 1.0))
                    .collect::<Result<Vec<_>, _>>()?;
                let q: [f64; 4] = q.try_into().map_err(|_| form())?;
                let n: f64 = q.iter().map(|c| c * c).sum();
                ((n - 1.0).abs() < 0.01)
                    .then(|| Quat::from_xyzw(q).normalized())
                    .ok_or_else(form)
            })
            .transpose()?;
        let nothing = position.iter().all(Option::is_none) && rotation.is_none();
        if nothing || (part.is_none() && rotation.is_some()) {
            return Err(form());
        }
        Ok(Self {
            part,
            position,
            rotation,
            from_s,
            to_s,
        })
    }
}
