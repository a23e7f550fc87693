//! `--obstacle`: objects that figures collide with.

use super::spec::{SpecError, number, numbers};
use sinew_physics::collide::{Mobility, ObstacleSetup, Shape};
use sinew_physics::math::{Quat, Vec3};
use std::str::FromStr;

/// `SHAPE:SIZE@x,y,z[,yaw][:KGkg][:vx,vy,vz]`: an object that figures collide with. With a mass it moves freely; with a
/// velocity and no mass it moves at that velocity; else it is fixed.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstacleSpec(pub ObstacleSetup);

impl ObstacleSpec {
    const FORM: &'static str = "SHAPE:SIZE@x,y,z[,yaw°][:KGkg][:vx,vy,vz] with SHAPE:SIZE one of box:LX,LY,LZ (edges, \
        m), sphere:R, capsule:R,L (upright; L between the centres of its ends), plane:nx,ny,nz (normal)";
    /// Coefficient of friction of wood or cloth on skin and cloth.
    const FRICTION: f64 = 0.6;
}

impl FromStr for ObstacleSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let vector = |v: &[f64]| match *v {
            [x, y, z] => Ok(Vec3 { x, y, z }),
            _ => Err(form()),
        };
        let (head, rest) = text.split_once('@').ok_or_else(form)?;
        let (name, size) = head.split_once(':').ok_or_else(form)?;
        let mut rest = rest.split(':');
        let place = numbers("position (m)", rest.next().unwrap_or_default(), 1e4)?;
        let (place, yaw) = match *place {
            [x, y, z] => (Vec3 { x, y, z }, 0.0),
            [x, y, z, yaw] => (Vec3 { x, y, z }, yaw),
            _ => return Err(form()),
        };
        let mut rotation = Quat::exp(Vec3::Z * yaw.to_radians());
        let length = |x: f64, least: f64| {
            let within = (least..=100.0).contains(&x);
            within.then_some(x).ok_or(SpecError::Range {
                what: "size (m)",
                value: x,
                lower: least,
                upper: 100.0,
            })
        };
        let size = numbers("size (m)", size, 1e6)?;
        let shape = match (name.trim(), &*size) {
            ("sphere", [r]) => Shape::Sphere {
                radius: length(*r, 0.005)?,
            },
            ("capsule", [r, l]) => Shape::Capsule {
                radius: length(*r, 0.005)?,
                half_length: 0.5 * length(*l, 0.0)?,
            },
            ("box", [x, y, z]) => Shape::Box {
                half: Vec3 {
                    x: 0.5 * length(*x, 0.01)?,
                    y: 0.5 * length(*y, 0.01)?,
                    z: 0.5 * length(*z, 0.01)?,
                },
            },
            ("plane", normal) => {
                let n = vector(normal)?;
                if n.norm() < 1e-9 {
                    return Err(SpecError::Direction);
                }
                rotation = onto(n * (1.0 / n.norm()));
                Shape::Plane
            }
            _ => return Err(form()),
        };
        let (mut mobility, mut velocity) = (Mobility::Fixed, Vec3::zero());
        for part in rest {
            if let Some(mass) = part.trim().strip_suffix("kg") {
                mobility = Mobility::Free(number("mass (kg)", mass, 0.01, 10_000.0)?);
            } else {
                velocity = vector(&numbers("velocity (m/s)", part, 100.0)?)?;
                if mobility == Mobility::Fixed {
                    mobility = Mobility::Led;
                }
            }
        }
        if shape == Shape::Plane && matches!(mobility, Mobility::Free(_)) {
            return Err(form());
        }
        Ok(Self(ObstacleSetup {
            name: text.to_owned(),
            shape,
            mobility,
            friction: Self::FRICTION,
            position: place,
            rotation,
            velocity,
            angular_velocity: Vec3::zero(),
        }))
    }
}

/// A rotation that turns z into the unit vector `n`.
fn onto(n: Vec3) -> Quat {
    if n.z < -1.0 + 1e-9 {
        return Quat::exp(Vec3::X * std::f64::consts::PI);
    }
    let axis = Vec3::Z.cross(n);
    Quat {
        x: axis.x,
        y: axis.y,
        z: axis.z,
        w: 1.0 + n.z,
    }
    .normalized()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn obstacles_are_read() {
        let read = |t: &str| t.parse::<ObstacleSpec>().expect(t).0;
        let seat = read("box:0.4,0.5,0.45@-0.3,0,0.225,90");
        let half = Vec3 {
            x: 0.2,
            y: 0.25,
            z: 0.225,
        };
        assert_eq!(seat.shape, Shape::Box { half });
        assert_eq!(seat.mobility, Mobility::Fixed);
        assert!((seat.rotation.rotate(Vec3::X) - Vec3::Y).norm() < 1e-12);
        let ball = read("sphere:0.11@2,0,1.3:5kg:-5,0,1");
        assert_eq!(ball.mobility, Mobility::Free(5.0));
        assert_eq!(ball.velocity.x, -5.0);
        assert_eq!(read("capsule:0.05,1@0,1,1:1,0,0").mobility, Mobility::Led);
        for n in [Vec3::X, -Vec3::Y, Vec3::Z, -Vec3::Z] {
            let text = format!("plane:{},{},{}@1,2,3", 2.0 * n.x, 2.0 * n.y, 2.0 * n.z);
            assert!((read(&text).rotation.rotate(Vec3::Z) - n).norm() < 1e-12);
        }
    }

    #[test]
    fn bad_obstacles_say_what_is_wrong() {
        for (text, says) in [
            ("box", "is not of the form"),
            ("box:1,1@0,0,0", "is not of the form"),
            ("cone:1@0,0,0", "is not of the form"),
            ("box:1,1,1@0,0", "is not of the form"),
            ("box:1,1,nan@0,0,0", "size (m): NaN is outside"),
            ("sphere:-1@0,0,0", "size (m): -1 is outside 0.005…100"),
            ("sphere:1@0,up,0", "position (m): \"up\" is not a number"),
            ("sphere:1@0,0,0:0kg", "mass (kg): 0 is outside"),
            ("sphere:1@0,0,0:1,2", "is not of the form"),
            ("plane:0,0,0@0,0,0", "no direction"),
            ("plane:0,0,1@0,0,0:3kg", "is not of the form"),
        ] {
            let error = text.parse::<ObstacleSpec>().expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
