//! Constraints on parts of a figure.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::ConstraintSettings;
use super::perturbation::{lasting, segment};
use super::{rotation, vector, vector_out, within};
use sinew_physics::figure::MAX_CONSTRAINTS;
use sinew_physics::figure::constraints::MAX_EASE;
use sinew_physics::math::Vec3;

/// Farthest place from the world origin, m.
const FAR: f64 = 1e4;
/// Ease of a constraint that names none, s.
const EASE: f64 = 0.5;

/// The constraints of a figure; `field` is the place of the list in the request.
pub fn list(field: &str, all: &[pb::Constraint]) -> Result<Vec<ConstraintSettings>, Fault> {
    if all.len() > MAX_CONSTRAINTS {
        return Err(Fault::invalid(
            field,
            format!("must be at most {MAX_CONSTRAINTS}, got {}", all.len()),
        ));
    }
    let mut out: Vec<ConstraintSettings> = Vec::with_capacity(all.len());
    for (i, c) in all.iter().enumerate() {
        let field = format!("{field}[{i}]");
        let c = one(&field, c)?;
        if let Some(j) = out.iter().position(|b| b.on == c.on) {
            return Err(Fault::invalid(
                field,
                format!("is on the same part as constraint {j}"),
            ));
        }
        out.push(c);
    }
    Ok(out)
}

fn one(field: &str, c: &pb::Constraint) -> Result<ConstraintSettings, Fault> {
    use pb::constraint::On;
    let at = |part: &str| format!("{field}.{part}");
    let point = c
        .point_m
        .map(|p| vector(at("point_m"), p, 2.0))
        .transpose()?;
    let turn = c
        .rotation
        .map(|q| rotation(at("rotation"), q))
        .transpose()?;
    let on = match &c.on {
        Some(On::Segment(name)) => Some((segment(&at("segment"), name)?, point)),
        Some(On::CenterOfMass(true)) => {
            for (part, given) in [("point_m", point.is_some()), ("rotation", turn.is_some())] {
                if given {
                    return Err(Fault::invalid(
                        at(part),
                        "must be absent for the centre of mass",
                    ));
                }
            }
            None
        }
        Some(On::CenterOfMass(false)) => {
            return Err(Fault::invalid(at("center_of_mass"), "must be true"));
        }
        None => {
            return Err(Fault::invalid(
                at("on"),
                "must be segment or center_of_mass",
            ));
        }
    };
    let position = c
        .position_m
        .map(|p| vector(at("position_m"), p, FAR))
        .transpose()?;
    if position.is_none() && turn.is_none() {
        return Err(Fault::invalid(
            at("position_m"),
            "must be given, or rotation",
        ));
    }
    let axes = c.position_axes.unwrap_or(pb::Vector3 {
        x: 1.0,
        y: 1.0,
        z: 1.0,
    });
    let axis = |part: &str, v: f64| within(at(&format!("position_axes.{part}")), v, 0.0, 1.0);
    Ok(ConstraintSettings {
        on,
        position,
        axes: [axis("x", axes.x)?, axis("y", axes.y)?, axis("z", axes.z)?],
        rotation: turn,
        weight: within(at("weight"), c.weight.unwrap_or(1.0), 0.0, 1.0)?,
        ease: within(at("ease_s"), c.ease_s.unwrap_or(EASE), 0.0, MAX_EASE)?,
        duration: lasting(&at("duration_s"), c.duration_s)?,
    })
}

/// A constraint for a response.
pub fn out(c: &ConstraintSettings) -> pb::Constraint {
    use pb::constraint::On;
    let [x, y, z] = c.axes;
    pb::Constraint {
        on: Some(match c.on {
            Some((segment, _)) => On::Segment(segment.name().into()),
            None => On::CenterOfMass(true),
        }),
        point_m: c.on.and_then(|(_, point)| point).map(vector_out),
        position_m: c.position.map(vector_out),
        position_axes: Some(vector_out(Vec3 { x, y, z })),
        rotation: c.rotation.map(|q| {
            let [x, y, z, w] = q.to_xyzw();
            pb::Quaternion { x, y, z, w }
        }),
        weight: Some(c.weight),
        ease_s: Some(c.ease),
        duration_s: if c.duration.is_finite() {
            c.duration
        } else {
            0.0
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pb::constraint::On;

    fn hand() -> pb::Constraint {
        pb::Constraint {
            on: Some(On::Segment("r_hand".into())),
            position_m: Some(pb::Vector3 {
                x: 0.4,
                y: -0.2,
                z: 1.1,
            }),
            ..Default::default()
        }
    }

    #[test]
    fn what_is_read_comes_back_as_it_was_sent() {
        let full = pb::Constraint {
            point_m: Some(pb::Vector3 {
                x: 0.0,
                y: 0.01,
                z: -0.1,
            }),
            position_axes: Some(pb::Vector3 {
                x: 1.0,
                y: 0.0,
                z: 0.5,
            }),
            rotation: Some(pb::Quaternion {
                x: 0.0,
                y: 0.0,
                z: 1.0,
                w: 0.0,
            }),
            weight: Some(0.25),
            ease_s: Some(0.0),
            duration_s: 3.0,
            ..hand()
        };
        let com = pb::Constraint {
            on: Some(On::CenterOfMass(true)),
            ..hand()
        };
        let read = list("figure.constraints", &[full.clone(), com]).unwrap();
        assert_eq!(out(&read[0]), full);
        assert_eq!(read[1].on, None);
        assert_eq!(
            (read[1].weight, read[1].ease, read[1].axes),
            (1.0, EASE, [1.0; 3])
        );
        assert_eq!(out(&read[1]).duration_s, 0.0);
    }

    #[test]
    fn hostile_constraints_name_their_field() {
        let bad = |f: fn(&mut pb::Constraint)| {
            let mut c = hand();
            f(&mut c);
            c
        };
        let cases: [(pb::Constraint, &str); 14] = [
            (bad(|c| c.on = None), "on"),
            (bad(|c| c.on = Some(On::Segment("tail".into()))), "segment"),
            (
                bad(|c| c.on = Some(On::CenterOfMass(false))),
                "center_of_mass",
            ),
            (
                bad(|c| {
                    c.on = Some(On::CenterOfMass(true));
                    c.rotation = Some(pb::Quaternion {
                        x: 0.0,
                        y: 0.0,
                        z: 0.0,
                        w: 1.0,
                    });
                }),
                "rotation",
            ),
            (
                bad(|c| {
                    c.on = Some(On::CenterOfMass(true));
                    c.point_m = Some(pb::Vector3::default());
                }),
                "point_m",
            ),
            (
                bad(|c| {
                    c.point_m = Some(pb::Vector3 {
                        x: 3.0,
                        y: 0.0,
                        z: 0.0,
                    })
                }),
                "point_m.x",
            ),
            (bad(|c| c.position_m = None), "position_m"),
            (
                bad(|c| {
                    c.position_m = Some(pb::Vector3 {
                        x: 0.0,
                        y: f64::NAN,
                        z: 0.0,
                    })
                }),
                "position_m.y",
            ),
            (
                bad(|c| {
                    c.position_m = Some(pb::Vector3 {
                        x: 0.0,
                        y: 0.0,
                        z: 1e9,
                    })
                }),
                "position_m.z",
            ),
            (
                bad(|c| {
                    c.position_axes = Some(pb::Vector3 {
                        x: 0.0,
                        y: -1.0,
                        z: 0.0,
                    })
                }),
                "position_axes.y",
            ),
            (
                bad(|c| c.rotation = Some(pb::Quaternion::default())),
                "rotation",
            ),
            (bad(|c| c.weight = Some(f64::INFINITY)), "weight"),
            (bad(|c| c.ease_s = Some(-1.0)), "ease_s"),
            (bad(|c| c.duration_s = f64::NAN), "duration_s"),
        ];
        for (c, part) in cases {
            let other = pb::Constraint {
                on: Some(On::Segment("head".into())),
                ..hand()
            };
            let Err(Fault::Invalid { field, .. }) = list("figure.constraints", &[other, c]) else {
                panic!("{part} was accepted");
            };
            assert_eq!(field, format!("figure.constraints[1].{part}"));
        }
        for (many, place) in [(9, "figure.constraints"), (2, "figure.constraints[1]")] {
            let Err(Fault::Invalid { field, .. }) = list("figure.constraints", &vec![hand(); many])
            else {
                panic!("{many} were accepted");
            };
            assert_eq!(field, place);
        }
    }
}
