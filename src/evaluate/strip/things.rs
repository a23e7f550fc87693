//! The surroundings of a figure: obstacles and other figures, as meshes.

use crate::pose::{SegmentPose, segment_poses};
use sinew_physics::body::{Body, Mesh, Posture, SEGMENT_COUNT};
use sinew_physics::collide::{ObstacleSetup, Shape};
use sinew_physics::math::Vec3;
use std::f64::consts::{PI, TAU};

/// Half edge of the patch of a plane that is drawn, and its thickness, m.
const PATCH: f64 = 0.75;
const THICKNESS: f64 = 0.02;
/// Sectors and rings of round things.
const SECTORS: u32 = 20;
const RINGS: u32 = 5;

/// The owner of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThingKind {
    /// An obstacle.
    Obstacle,
    /// A segment of another figure.
    Other(usize),
}

/// A surface and its pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Surface in its own frame, m.
    pub mesh: Mesh,
    /// Its frame in the world.
    pub pose: SegmentPose,
    /// Its owner.
    pub kind: ThingKind,
}

fn at(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3 { x, y, z }
}

/// Six sides with corners of their own, so that edges stay sharp.
fn cuboid(half: Vec3, lift: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let axes = [Vec3::X * half.x, Vec3::Y * half.y, Vec3::Z * half.z];
    for k in 0..3 {
        for sign in [-1.0, 1.0] {
            let (n, u, v) = (axes[k] * sign, axes[(k + 1) % 3] * sign, axes[(k + 2) % 3]);
            let first = mesh.vertices.len() as u32;
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                mesh.vertices.push(n + u * a + v * b + Vec3::Z * lift);
            }
            mesh.triangles.push([first, first + 1, first + 2]);
            mesh.triangles.push([first, first + 2, first + 3]);
        }
    }
    mesh
}

/// A ball whose halves are pulled apart by `half_length` along z.
fn round(radius: f64, half_length: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let rows = 2 * (RINGS + 1);
    for i in 0..rows {
        let upper = i > RINGS;
        let ring = if upper { i - 1 } else { i };
        let (st, ct) = (PI * (1.0 - f64::from(ring) / f64::from(2 * RINGS))).sin_cos();
        let shift = if upper { half_length } else { -half_length };
        for j in 0..SECTORS {
            let (sp, cp) = (TAU * f64::from(j) / f64::from(SECTORS)).sin_cos();
            let p = at(st * cp, st * sp, ct) * radius;
            mesh.vertices.push(p + Vec3::Z * shift);
        }
    }
    for i in 0..rows - 1 {
        for j in 0..SECTORS {
            let index = |i: u32, j: u32| i * SECTORS + j % SECTORS;
            let (a, b) = (index(i, j), index(i, j + 1));
            let (c, d) = (index(i + 1, j + 1), index(i + 1, j));
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([a, c, d]);
        }
    }
    mesh
}

impl Thing {
    /// An obstacle at its place.
    pub fn obstacle(o: &ObstacleSetup) -> Self {
        let mesh = match o.shape {
            Shape::Sphere { radius } => round(radius, 0.0),
            Shape::Capsule {
                radius,
                half_length,
            } => round(radius, half_length),
            Shape::Box { half } => cuboid(half, 0.0),
            Shape::Plane => cuboid(at(PATCH, PATCH, 0.5 * THICKNESS), -0.5 * THICKNESS),
        };
        Self {
            mesh,
            pose: SegmentPose {
                position: o.position,
                rotation: o.rotation,
            },
            kind: ThingKind::Obstacle,
        }
    }

    /// The segments of another figure.
    pub fn figure(body: &Body, posture: &Posture) -> impl Iterator<Item = Self> {
        let poses: [SegmentPose; SEGMENT_COUNT] = segment_poses(&body.joint_offset, posture);
        (0..SEGMENT_COUNT).map(move |s| Self {
            mesh: body.segments[s].mesh.clone(),
            pose: poses[s],
            kind: ThingKind::Other(s),
        })
    }
}

#[cfg(test)]
mod tests {
    //! Goal: meshes are closed, face outwards and have the size of the shape.
    use super::*;

    /// Volume from the triangles: right only if all face outwards.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |i: u32| mesh.vertices[i as usize];
        let six = |t: &[u32; 3]| corner(t[0]).dot(corner(t[1]).cross(corner(t[2])));
        mesh.triangles.iter().map(six).sum::<f64>() / 6.0
    }

    #[test]
    fn meshes_have_the_volume_of_their_shapes() {
        let half = at(0.2, 0.3, 0.4);
        assert!((volume(&cuboid(half, 1.0)) - 8.0 * half.x * half.y * half.z).abs() < 1e-12);
        let (r, l) = (0.3f64, 0.5);
        let ball = 4.0 / 3.0 * PI * r.powi(3);
        let capsule = ball + 2.0 * l * PI * r * r;
        for (mesh, want) in [(round(r, 0.0), ball), (round(r, l), capsule)] {
            let v = volume(&mesh);
            assert!(v > 0.92 * want && v < want, "{v} of {want}");
        }
    }
}
