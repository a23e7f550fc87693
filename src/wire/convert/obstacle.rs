//! Obstacles.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::ObstacleInfo;
use super::{WORLD_EXTENT, rotation, shortened, vector, vector_out, within};
use crate::sim::collide::{Mobility, ObstacleSetup, Shape};
use crate::sim::math::{Quat, Vec3};

/// Friction of an obstacle that says nothing about it.
const FRICTION: f64 = 0.6;
/// Largest radius or half length, and largest half edge of a box, m.
const ROUND: f64 = 100.0;
const EDGE: f64 = 1000.0;
/// Least radius or half edge, m.
const THIN: f64 = 0.005;
/// Fastest, m/s and rad/s.
const FASTEST: f64 = 100.0;

fn shape(field: &str, s: Option<&pb::obstacle::Shape>) -> Result<Shape, Fault> {
    Ok(match s {
        None => {
            return Err(Fault::invalid(
                format!("{field}.shape"),
                "must be one of sphere, capsule, box, plane",
            ));
        }
        Some(pb::obstacle::Shape::Sphere(s)) => Shape::Sphere {
            radius: within(&format!("{field}.sphere.radius_m"), s.radius_m, THIN, ROUND)?,
        },
        Some(pb::obstacle::Shape::Capsule(c)) => Shape::Capsule {
            radius: within(
                &format!("{field}.capsule.radius_m"),
                c.radius_m,
                THIN,
                ROUND,
            )?,
            half_length: within(
                &format!("{field}.capsule.half_length_m"),
                c.half_length_m,
                0.0,
                ROUND,
            )?,
        },
        Some(pb::obstacle::Shape::Box(b)) => {
            let h = b.half_m.unwrap_or_default();
            let edge =
                |axis: &str, x: f64| within(&format!("{field}.box.half_m.{axis}"), x, THIN, EDGE);
            Shape::Box {
                half: Vec3 {
                    x: edge("x", h.x)?,
                    y: edge("y", h.y)?,
                    z: edge("z", h.z)?,
                },
            }
        }
        Some(pb::obstacle::Shape::Plane(_)) => Shape::Plane,
    })
}

/// An obstacle of a request.
pub fn setup(field: &str, o: Option<&pb::Obstacle>) -> Result<ObstacleSetup, Fault> {
    let o = o.ok_or_else(|| Fault::invalid(field, "must be given"))?;
    let shape = shape(field, o.shape.as_ref())?;
    let mobility = match pb::ObstacleMobility::try_from(o.mobility) {
        Ok(pb::ObstacleMobility::Unspecified | pb::ObstacleMobility::Fixed) => Mobility::Fixed,
        Ok(pb::ObstacleMobility::Led) => Mobility::Led,
        Ok(pb::ObstacleMobility::Free) if shape == Shape::Plane => {
            return Err(Fault::invalid(
                format!("{field}.mobility"),
                "a plane cannot move freely",
            ));
        }
        Ok(pb::ObstacleMobility::Free) => Mobility::Free(within(
            &format!("{field}.mass_kg"),
            o.mass_kg,
            0.01,
            10_000.0,
        )?),
        Err(_) => {
            return Err(Fault::invalid(
                format!("{field}.mobility"),
                format!("{} is not a mobility", o.mobility),
            ));
        }
    };
    let pose = o.pose.unwrap_or_default();
    let motion = |name: &str, v: Option<pb::Vector3>| {
        vector(&format!("{field}.{name}"), v.unwrap_or_default(), FASTEST)
    };
    Ok(ObstacleSetup {
        name: String::new(),
        shape,
        mobility,
        friction: within(
            &format!("{field}.friction"),
            o.friction.unwrap_or(FRICTION),
            0.05,
            2.0,
        )?,
        position: vector(
            &format!("{field}.pose.position_m"),
            pose.position_m.unwrap_or_default(),
            WORLD_EXTENT,
        )?,
        rotation: match pose.rotation {
            None => Quat::identity(),
            Some(q) => rotation(&format!("{field}.pose.rotation"), q)?,
        },
        velocity: motion("velocity_mps", o.velocity_mps)?,
        angular_velocity: motion("angular_velocity_radps", o.angular_velocity_radps)?,
    })
}

/// World and obstacle of `worlds/{world}/obstacles/{obstacle}`.
pub fn name<'a>(field: &str, name: &'a str) -> Result<(&'a str, &'a str), Fault> {
    let parts: Vec<&str> = name.splitn(5, '/').collect();
    match parts[..] {
        ["worlds", world, "obstacles", id] if !world.is_empty() && !id.is_empty() => {
            Ok((world, id))
        }
        _ => Err(Fault::invalid(
            field,
            format!(
                "must be a resource name worlds/{{world}}/obstacles/{{obstacle}}, got {:?}",
                shortened(name)
            ),
        )),
    }
}

/// An obstacle for a response.
pub fn out(world: &str, o: &ObstacleInfo) -> pb::Obstacle {
    let s = &o.setup;
    let (mobility, mass_kg) = match s.mobility {
        Mobility::Fixed => (pb::ObstacleMobility::Fixed, 0.0),
        Mobility::Led => (pb::ObstacleMobility::Led, 0.0),
        Mobility::Free(m) => (pb::ObstacleMobility::Free, m),
    };
    let q = s.rotation;
    pb::Obstacle {
        name: format!("worlds/{world}/obstacles/{}", o.id),
        shape: Some(match s.shape {
            Shape::Sphere { radius } => {
                pb::obstacle::Shape::Sphere(pb::SphereShape { radius_m: radius })
            }
            Shape::Capsule {
                radius,
                half_length,
            } => pb::obstacle::Shape::Capsule(pb::CapsuleShape {
                radius_m: radius,
                half_length_m: half_length,
            }),
            Shape::Box { half } => pb::obstacle::Shape::Box(pb::BoxShape {
                half_m: Some(vector_out(half)),
            }),
            Shape::Plane => pb::obstacle::Shape::Plane(pb::PlaneShape {}),
        }),
        mobility: mobility.into(),
        mass_kg,
        friction: Some(s.friction),
        pose: Some(pb::Pose {
            position_m: Some(vector_out(s.position)),
            rotation: Some(pb::Quaternion {
                x: q.x,
                y: q.y,
                z: q.z,
                w: q.w,
            }),
        }),
        velocity_mps: Some(vector_out(s.velocity)),
        angular_velocity_radps: Some(vector_out(s.angular_velocity)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball() -> pb::Obstacle {
        pb::Obstacle {
            shape: Some(pb::obstacle::Shape::Sphere(pb::SphereShape {
                radius_m: 0.1,
            })),
            mobility: pb::ObstacleMobility::Free.into(),
            mass_kg: 5.0,
            ..Default::default()
        }
    }

    #[test]
    fn obstacles_come_back_as_they_were_sent() {
        let setup = setup("obstacle", Some(&ball())).unwrap();
        let info = ObstacleInfo {
            id: "ball".into(),
            setup: setup.clone(),
            force: Vec3::zero(),
        };
        let sent = out("w", &info);
        assert_eq!(sent.name, "worlds/w/obstacles/ball");
        assert_eq!(super::setup("obstacle", Some(&sent)).unwrap(), setup);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let edits: [(&str, fn(&mut pb::Obstacle)); 7] = [
            ("obstacle.shape", |o| o.shape = None),
            ("obstacle.sphere.radius_m", |o| {
                o.shape = Some(pb::obstacle::Shape::Sphere(pb::SphereShape {
                    radius_m: f64::NAN,
                }));
            }),
            ("obstacle.mobility", |o| o.mobility = 77),
            ("obstacle.mobility", |o| {
                o.shape = Some(pb::obstacle::Shape::Plane(pb::PlaneShape {}));
            }),
            ("obstacle.mass_kg", |o| o.mass_kg = 0.0),
            ("obstacle.friction", |o| o.friction = Some(-1.0)),
            ("obstacle.velocity_mps.y", |o| {
                o.velocity_mps = Some(pb::Vector3 {
                    y: f64::INFINITY,
                    ..Default::default()
                });
            }),
        ];
        for (want, edit) in edits {
            let mut o = ball();
            edit(&mut o);
            match setup("obstacle", Some(&o)) {
                Err(Fault::Invalid { field, .. }) => assert_eq!(field, want),
                other => panic!("{want}: {other:?}"),
            }
        }
    }
}
