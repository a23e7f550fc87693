//! Bounds of all inputs of a world: checked once, trusted afterwards.

use super::{WorldError, WorldParams};
use crate::body::State;
use crate::body::topology::{L_HAND, R_HAND};
use crate::collide::{Mobility, ObstacleSetup, Shape};
use crate::figure::constraints::{Constrained, Constraint, MAX_CONSTRAINTS, MAX_EASE};
use crate::figure::{ControlParams, FigureOptions, FigureSetup, Perturbation, StrengthScale};
use crate::math::Vec3;

/// Largest distance of a figure's start from the world origin, m. Farther out, positions lose the precision that
/// contact needs.
const FAR: f64 = 1e5;
/// Largest help, as a force relative to the weight: twice the force that carries the figure.
const LARGEST_HELP: f64 = 2.0;

fn range(field: &'static str, value: f64, lower: f64, upper: f64) -> Result<(), WorldError> {
    if value >= lower && value <= upper {
        Ok(())
    } else {
        Err(WorldError::Range {
            field,
            value,
            lower,
            upper,
        })
    }
}

fn vector(field: &'static str, v: Vec3, most: f64) -> Result<(), WorldError> {
    for x in v.to_array() {
        range(field, x, -most, most)?;
    }
    Ok(())
}

pub(super) fn params(p: &WorldParams) -> Result<(), WorldError> {
    range("rate_hz", p.rate_hz, 10.0, 1000.0)?;
    range("substeps", f64::from(p.substeps), 1.0, 16.0)?;
    range("gravity_mps2", p.gravity, 0.0, 30.0)?;
    range("friction", p.friction, 0.05, 2.0)?;
    range("threads", p.threads as f64, 1.0, 64.0)
}

pub(super) fn state(s: &State) -> Result<(), WorldError> {
    vector("state.root_position_m", s.posture.root_position, FAR)?;
    for q in s.posture.ball.iter().chain([&s.posture.root_rotation]) {
        let n: f64 = q.to_xyzw().iter().map(|c| c * c).sum();
        range("state.rotation", n, 0.999, 1.001)?;
    }
    for a in s.posture.hinge {
        range("state.joint_angle_rad", a, -10.0, 10.0)?;
    }
    for v in s.velocity {
        range("state.velocity", v, -200.0, 200.0)?;
    }
    Ok(())
}

pub(super) fn strength(s: &StrengthScale) -> Result<(), WorldError> {
    range("strength.all", s.all, 0.01, 100.0)?;
    for f in s.dof {
        range("strength.dof", f, 0.01, 100.0)?;
    }
    range("strength.percentile", s.percentile, 5.0, 95.0)?;
    range("strength.effort", s.effort, 0.0, 1.0)
}

pub(super) fn options(o: &FigureOptions) -> Result<(), WorldError> {
    range(
        "fatigue_time_scale",
        o.fatigue_time_scale,
        0.0,
        crate::strength::fatigue::MAX_TIME_SCALE,
    )?;
    range("assist", o.assist, 0.0, 1.0)?;
    range("max_help", o.max_help, 0.0, LARGEST_HELP)
}

pub(super) fn control(c: &ControlParams) -> Result<(), WorldError> {
    range("control.alpha", c.alpha, 0.0, 1.0)?;
    if let Some(t) = c.horizon {
        range("control.horizon_s", t, 0.01, 2.0)?;
    }
    Ok(())
}

pub(super) fn setup(s: &FigureSetup) -> Result<(), WorldError> {
    strength(&s.strength)?;
    control(&s.params)?;
    options(&s.options)?;
    state(&s.state)
}

pub(super) fn perturbation(p: &Perturbation) -> Result<(), WorldError> {
    let (from, to) = acting(p)?;
    range("perturbation.from_s", from, f64::NEG_INFINITY, 1e12)?;
    if to.is_nan() || to < from {
        return Err(WorldError::Interval {
            field: "perturbation",
            from,
            to,
        });
    }
    Ok(())
}

/// Checks the effect of a perturbation; returns its start and end, which the caller checks.
pub(super) fn acting(p: &Perturbation) -> Result<(f64, f64), WorldError> {
    Ok(match p {
        Perturbation::Load { .. } | Perturbation::Held(_) | Perturbation::Helped { .. } => {
            let l = p.load().expect("all three kinds are loads");
            if matches!(p, Perturbation::Helped { .. })
                && !(l.second.is_none() && (l.segment == L_HAND || l.segment == R_HAND))
            {
                return Err(WorldError::NotInOneHand);
            }
            range("load.mass_kg", l.mass, 0.0, 500.0)?;
            vector("load.point_m", l.point, 10.0)?;
            vector("load.velocity_mps", l.velocity, 100.0)?;
            if let Some((_, point)) = l.second {
                vector("load.second_point_m", point, 10.0)?;
            }
            range("load.grip_n", l.grip, 0.0, f64::INFINITY)?;
            (l.from, l.to)
        }
        Perturbation::Force {
            point,
            force,
            from,
            to,
            ..
        } => {
            vector("force.force_newtons", *force, 1e6)?;
            vector("force.point_m", *point, 10.0)?;
            (*from, *to)
        }
    })
}

pub(super) fn constraints(all: &[Constraint]) -> Result<(), WorldError> {
    if all.len() > MAX_CONSTRAINTS {
        return Err(WorldError::TooManyConstraints);
    }
    for c in all {
        match (c.on, c.position, c.rotation) {
            (_, None, None) => {
                return Err(WorldError::Constraint(
                    "neither a position nor a rotation is given",
                ));
            }
            (Constrained::CenterOfMass, _, Some(_)) => {
                return Err(WorldError::Constraint("the centre of mass has no rotation"));
            }
            (Constrained::Point(_, point), ..) => vector("constraints.point_m", point, 10.0)?,
            _ => {}
        }
        if let Some(p) = c.position {
            vector("constraints.position_m", p, FAR)?;
        }
        for a in c.axes {
            range("constraints.axes", a, 0.0, 1.0)?;
        }
        if let Some(q) = c.rotation {
            let n: f64 = q.to_xyzw().iter().map(|c| c * c).sum();
            range("constraints.rotation", n, 0.999, 1.001)?;
        }
        range("constraints.weight", c.weight, 0.0, 1.0)?;
        range("constraints.ease_s", c.ease, 0.0, MAX_EASE)?;
        range("constraints.from_s", c.from, f64::NEG_INFINITY, 1e12)?;
        if c.to.is_nan() || c.to < c.from {
            return Err(WorldError::Interval {
                field: "constraints",
                from: c.from,
                to: c.to,
            });
        }
    }
    for (i, c) in all.iter().enumerate() {
        if all[..i].iter().any(|b| b.on == c.on) {
            return Err(WorldError::Constraint("two of them are on the same part"));
        }
    }
    Ok(())
}

pub(super) fn obstacle(o: &ObstacleSetup) -> Result<(), WorldError> {
    match o.shape {
        Shape::Sphere { radius } => range("obstacle.sphere.radius_m", radius, 0.005, 100.0)?,
        Shape::Capsule {
            radius,
            half_length,
        } => {
            range("obstacle.capsule.radius_m", radius, 0.005, 100.0)?;
            range("obstacle.capsule.half_length_m", half_length, 0.0, 100.0)?;
        }
        Shape::Box { half } => {
            let fields = [
                "obstacle.box.half_m.x",
                "obstacle.box.half_m.y",
                "obstacle.box.half_m.z",
            ];
            for (field, x) in fields.into_iter().zip(half.to_array()) {
                range(field, x, 0.005, 1000.0)?;
            }
        }
        Shape::Plane => {}
    }
    if let Mobility::Free(mass) = o.mobility {
        range("obstacle.mass_kg", mass, 0.01, 10_000.0)?;
        if o.shape == Shape::Plane {
            return Err(WorldError::FreePlane);
        }
    }
    range("obstacle.friction", o.friction, 0.05, 2.0)?;
    vector("obstacle.position_m", o.position, FAR)?;
    let n: f64 = o.rotation.to_xyzw().iter().map(|c| c * c).sum();
    range("obstacle.rotation", n, 0.999, 1.001)?;
    vector("obstacle.velocity_mps", o.velocity, 100.0)?;
    vector("obstacle.angular_velocity_radps", o.angular_velocity, 100.0)
}
