//! Obstacles.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::{FREE_PLANE, ObstacleInfo, ObstacleMobility, ObstacleUpdate};
use super::masks::MaskFields;
use super::names::OBSTACLE;
use super::{WORLD_EXTENT, etags, rotation, vector, vector_out, within};
use sinew_physics::collide::{Mobility, OBSTACLE_FRICTION, ObstacleSetup, Shape};
use sinew_physics::math::{Quat, Vec3};

/// Largest radius or half length, and largest half edge of a box, m.
const ROUND: f64 = 100.0;
const EDGE: f64 = 1000.0;
/// Least radius or half edge, m.
const THIN: f64 = 0.005;
/// Highest speed, m/s and rad/s.
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
            radius: within(format!("{field}.sphere.radius_m"), s.radius_m, THIN, ROUND)?,
        },
        Some(pb::obstacle::Shape::Capsule(c)) => Shape::Capsule {
            radius: within(format!("{field}.capsule.radius_m"), c.radius_m, THIN, ROUND)?,
            half_length: within(
                format!("{field}.capsule.half_length_m"),
                c.half_length_m,
                0.0,
                ROUND,
            )?,
        },
        Some(pb::obstacle::Shape::Box(b)) => {
            let h = b.half_m.unwrap_or_default();
            let edge =
                |axis: &str, x: f64| within(format!("{field}.box.half_m.{axis}"), x, THIN, EDGE);
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

fn mobility(field: &str, value: i32) -> Result<ObstacleMobility, Fault> {
    match pb::ObstacleMobility::try_from(value) {
        Ok(pb::ObstacleMobility::Unspecified | pb::ObstacleMobility::Fixed) => {
            Ok(ObstacleMobility::Fixed)
        }
        Ok(pb::ObstacleMobility::Led) => Ok(ObstacleMobility::Led),
        Ok(pb::ObstacleMobility::Free) => Ok(ObstacleMobility::Free),
        Err(_) => Err(Fault::invalid(
            format!("{field}.mobility"),
            format!("{value} is not a mobility"),
        )),
    }
}

fn mass(field: &str, value: f64) -> Result<f64, Fault> {
    within(format!("{field}.mass_kg"), value, 0.01, 10_000.0)
}

fn friction(field: &str, o: &pb::Obstacle) -> Result<f64, Fault> {
    let value = o.friction.unwrap_or(OBSTACLE_FRICTION);
    within(format!("{field}.friction"), value, 0.05, 2.0)
}

fn pose(field: &str, o: &pb::Obstacle) -> Result<(Vec3, Quat), Fault> {
    let pose = o.pose.unwrap_or_default();
    let position = pose.position_m.unwrap_or_default();
    let at = |part: &str| format!("{field}.pose.{part}");
    Ok((
        vector(at("position_m"), position, WORLD_EXTENT)?,
        match pose.rotation {
            None => Quat::identity(),
            Some(q) => rotation(at("rotation"), q)?,
        },
    ))
}

fn motion(field: &str, name: &str, v: Option<pb::Vector3>) -> Result<Vec3, Fault> {
    vector(format!("{field}.{name}"), v.unwrap_or_default(), FASTEST)
}

/// An obstacle of a request.
pub fn setup(field: &str, o: Option<&pb::Obstacle>) -> Result<ObstacleSetup, Fault> {
    let o = o.ok_or_else(|| Fault::invalid(field, "must be given"))?;
    let shape = shape(field, o.shape.as_ref())?;
    let mobility = match mobility(field, o.mobility)? {
        ObstacleMobility::Fixed => Mobility::Fixed,
        ObstacleMobility::Led => Mobility::Led,
        ObstacleMobility::Free if shape == Shape::Plane => {
            return Err(Fault::invalid(format!("{field}.mobility"), FREE_PLANE));
        }
        ObstacleMobility::Free => Mobility::Free(mass(field, o.mass_kg)?),
    };
    let (position, rotation) = pose(field, o)?;
    Ok(ObstacleSetup {
        name: String::new(),
        shape,
        mobility,
        friction: friction(field, o)?,
        position,
        rotation,
        velocity: motion(field, "velocity_mps", o.velocity_mps)?,
        angular_velocity: motion(field, "angular_velocity_rad_s", o.angular_velocity_rad_s)?,
    })
}

/// Changes of an obstacle.
pub fn update(
    o: &pb::Obstacle,
    mask: Option<&prost_types::FieldMask>,
) -> Result<ObstacleUpdate, Fault> {
    use pb::obstacle::Shape as S;
    let given = |name: &str| match &o.shape {
        Some(S::Sphere(_)) => name == "sphere",
        Some(S::Capsule(_)) => name == "capsule",
        Some(S::Box(_)) => name == "box",
        Some(S::Plane(_)) => name == "plane",
        None => false,
    };
    let shapes = ["sphere", "capsule", "box", "plane"];
    let taken = MaskFields {
        settable: &[
            ("sphere", given("sphere")),
            ("capsule", given("capsule")),
            ("box", given("box")),
            ("plane", given("plane")),
            ("mobility", o.mobility != 0),
            ("mass_kg", o.mass_kg != 0.0),
            ("friction", o.friction.is_some()),
            ("pose", o.pose.is_some()),
            ("velocity_mps", o.velocity_mps.is_some()),
            ("angular_velocity_rad_s", o.angular_velocity_rad_s.is_some()),
        ],
        fixed: &[],
        output: &["name", "etag"],
    }
    .taken(mask)?;
    let has = |name: &str| taken.contains(&name);
    let field = "obstacle";
    // An obstacle has one shape: if a mask names several, the one that is given counts.
    let shaped = shapes
        .iter()
        .copied()
        .filter(|s| has(s))
        .collect::<Vec<_>>();
    let shape = match shaped[..] {
        [] => None,
        [named] if !given(named) => {
            return Err(Fault::invalid(
                format!("{field}.{named}"),
                "must be given, as the mask names it",
            ));
        }
        _ => Some(shape(field, o.shape.as_ref())?),
    };
    Ok(ObstacleUpdate {
        shape,
        mobility: has("mobility")
            .then(|| mobility(field, o.mobility))
            .transpose()?,
        mass: has("mass_kg").then(|| mass(field, o.mass_kg)).transpose()?,
        friction: has("friction").then(|| friction(field, o)).transpose()?,
        pose: has("pose").then(|| pose(field, o)).transpose()?,
        velocity: has("velocity_mps")
            .then(|| motion(field, "velocity_mps", o.velocity_mps))
            .transpose()?,
        angular_velocity: has("angular_velocity_rad_s")
            .then(|| motion(field, "angular_velocity_rad_s", o.angular_velocity_rad_s))
            .transpose()?,
    })
}

/// Checks the etag of a request, if it has one.
///
/// # Errors
/// The obstacle has changed.
pub fn check_etag(world: &str, now: &ObstacleInfo, sent: &str) -> Result<(), Fault> {
    let name = OBSTACLE.name([world, &now.id]);
    etags::check(&name, sent, || out(world, now).etag)
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
    let mut out = pb::Obstacle {
        name: OBSTACLE.name([world, &o.id]),
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
        angular_velocity_rad_s: Some(vector_out(s.angular_velocity)),
        etag: String::new(),
    };
    out.etag = etags::obstacle(&out);
    out
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
            number: 1,
            setup: setup.clone(),
            force: Vec3::zero(),
        };
        let sent = out("w", &info);
        assert_eq!(sent.name, "worlds/w/obstacles/ball");
        assert_eq!(super::setup("obstacle", Some(&sent)).unwrap(), setup);
    }

    #[test]
    fn an_update_changes_what_the_mask_names_and_nothing_else() {
        let now = setup("obstacle", Some(&ball())).unwrap();
        let mask = |paths: &[&str]| prost_types::FieldMask {
            paths: paths.iter().map(|p| (*p).to_owned()).collect(),
        };
        let change = pb::Obstacle {
            friction: Some(0.9),
            mass_kg: 7.0,
            velocity_mps: Some(pb::Vector3 {
                x: f64::NAN,
                ..Default::default()
            }),
            ..Default::default()
        };
        let only = update(&change, Some(&mask(&["friction"]))).unwrap();
        let want = ObstacleSetup {
            friction: 0.9,
            ..now.clone()
        };
        assert_eq!(only.apply(&now).unwrap(), want);
        // Without a mask the given fields count, and are checked.
        let Err(Fault::Invalid { field, .. }) = update(&change, None) else {
            panic!("not a number was taken");
        };
        assert_eq!(field, "obstacle.velocity_mps.x");
        let given = pb::Obstacle {
            velocity_mps: None,
            ..change
        };
        let both = update(&given, None).unwrap().apply(&now).unwrap();
        assert_eq!(both.mobility, Mobility::Free(7.0));
        // All fields: missing ones get their defaults.
        let all = update(&ball(), Some(&mask(&["*"]))).unwrap();
        let moved = ObstacleSetup {
            velocity: Vec3 {
                x: 1.0,
                y: 0.0,
                z: 0.0,
            },
            ..want
        };
        assert_eq!(all.apply(&moved).unwrap(), now);
    }

    #[test]
    fn a_shape_is_replaced_by_the_one_that_is_named() {
        let now = setup("obstacle", Some(&ball())).unwrap();
        let mask = |path: &str| prost_types::FieldMask {
            paths: vec![path.to_owned()],
        };
        let plane = pb::Obstacle {
            shape: Some(pb::obstacle::Shape::Plane(pb::PlaneShape {})),
            ..Default::default()
        };
        // The ball is free, and a plane cannot be.
        let Err(Fault::Invalid { field, problem }) =
            update(&plane, Some(&mask("plane"))).unwrap().apply(&now)
        else {
            panic!("a free plane");
        };
        assert_eq!(
            (field.as_str(), &*problem),
            ("obstacle.mobility", FREE_PLANE)
        );
        let fixed = ObstacleSetup {
            mobility: Mobility::Fixed,
            ..now
        };
        let now = update(&plane, None).unwrap().apply(&fixed).unwrap();
        assert_eq!(now.shape, Shape::Plane);
        let Err(Fault::Invalid { field, .. }) = update(&plane, Some(&mask("box"))) else {
            panic!("no box was given");
        };
        assert_eq!(field, "obstacle.box");
        // An obstacle that becomes free needs a mass.
        let free = pb::Obstacle {
            mobility: pb::ObstacleMobility::Free.into(),
            ..Default::default()
        };
        let Err(Fault::Invalid { field, .. }) = update(&free, None).unwrap().apply(&fixed) else {
            panic!("free without a mass");
        };
        assert_eq!(field, "obstacle.mass_kg");
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
