//! Mass, centre of mass and inertia of a closed triangulated surface, and the lofts that segments are made of.
//!
//! The paper (§3.1) takes mass properties from the polyhedra of the segments. A closed surface is the signed sum of the
//! tetrahedra that its triangles span with any fixed point, so the volume integrals of 1, x and x xᵀ are sums over
//! triangles (divergence theorem). Offline code: it runs when a body is built, never within a tick.

use super::model::Mesh;
use crate::math::vec3::vec3;
use crate::math::{Sym3, Vec3, trig};

/// Volume and mass properties of a solid of uniform density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Enclosed volume, m³.
    pub volume: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, frame of the mesh, m.
    pub com: Vec3,
    /// Rotational inertia about the centre of mass, axes of the mesh, kg·m².
    pub inertia: Sym3,
}

/// Why a mesh encloses no solid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeometryError {
    /// A coordinate is NaN or infinite.
    #[error("vertex {0} is not finite")]
    NotFinite(usize),
    /// A triangle names a vertex that does not exist, or one vertex twice.
    #[error("triangle {triangle} has corners {corners:?}, the mesh has {vertices} vertices")]
    Corner {
        /// Index of the triangle.
        triangle: usize,
        /// Its vertex indices.
        corners: [u32; 3],
        /// Number of vertices.
        vertices: usize,
    },
    /// An edge is not shared by exactly two triangles that pass it in opposite directions.
    #[error("the surface is open or folded at edge {0}–{1}")]
    Open(u32, u32),
    /// A connected part faces inwards or encloses nothing.
    #[error("the part with vertex {vertex} encloses {volume} m³: empty or inside out")]
    Inward {
        /// A vertex of the part.
        vertex: u32,
        /// Signed volume, m³.
        volume: f64,
    },
    /// Mass must be positive and finite.
    #[error("mass {0} kg is not positive")]
    Mass(f64),
}

/// Checks that `mesh` is a set of closed, outward-facing surfaces with finite vertices.
///
/// # Errors
/// The first defect, naming vertex, triangle or edge.
pub fn check(mesh: &Mesh) -> Result<(), GeometryError> {
    let n = mesh.vertices.len();
    if let Some(i) = mesh.vertices.iter().position(|v| !v.is_finite()) {
        return Err(GeometryError::NotFinite(i));
    }
    let mut edges = Vec::with_capacity(3 * mesh.triangles.len());
    let mut part: Vec<usize> = (0..n).collect();
    for (t, c) in mesh.triangles.iter().enumerate() {
        let bad =
            c.iter().any(|i| *i as usize >= n) || c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
        if bad {
            return Err(GeometryError::Corner {
                triangle: t,
                corners: *c,
                vertices: n,
            });
        }
        for k in 0..3 {
            edges.push((c[k], c[(k + 1) % 3]));
        }
        let (a, b, d) = (
            root(&mut part, c[0]),
            root(&mut part, c[1]),
            root(&mut part, c[2]),
        );
        let least = a.min(b).min(d);
        part[a] = least;
        part[b] = least;
        part[d] = least;
    }
    edges.sort_unstable();
    for (i, e) in edges.iter().enumerate() {
        let twice = i > 0 && edges[i - 1] == *e;
        if twice || edges.binary_search(&(e.1, e.0)).is_err() {
            return Err(GeometryError::Open(e.0, e.1));
        }
    }
    // Each part on its own: an inward part inside an outward one would only lower the total.
    let mut volume = vec![0.0; n];
    for c in &mesh.triangles {
        let r = root(&mut part, c[0]);
        let [p, q, s] = corners(mesh, c, mesh.vertices[r]);
        volume[r] += p.dot(q.cross(s)) / 6.0;
    }
    for c in &mesh.triangles {
        let r = root(&mut part, c[0]);
        if volume[r] <= 0.0 {
            return Err(GeometryError::Inward {
                vertex: c[0],
                volume: volume[r],
            });
        }
    }
    Ok(())
}

fn root(part: &mut [usize], vertex: u32) -> usize {
    let mut i = vertex as usize;
    while part[i] != i {
        part[i] = part[part[i]]; // path halving
        i = part[i];
    }
    i
}

fn corners(mesh: &Mesh, triangle: &[u32; 3], about: Vec3) -> [Vec3; 3] {
    triangle.map(|i| mesh.vertices[i as usize] - about)
}

/// Signed volume enclosed by a closed surface, m³; negative if it faces inwards.
pub fn volume(mesh: &Mesh) -> f64 {
    let about = centre(mesh);
    mesh.triangles
        .iter()
        .map(|t| {
            let [a, b, c] = corners(mesh, t, about);
            a.dot(b.cross(c)) / 6.0
        })
        .sum()
}

/// Mean of the vertices: integrating about it keeps the cancellation between tetrahedra small.
fn centre(mesh: &Mesh) -> Vec3 {
    let sum = mesh.vertices.iter().fold(Vec3::zero(), |s, v| s + *v);
    sum * (1.0 / mesh.vertices.len().max(1) as f64)
}

/// Mass properties of the solid inside `mesh` when `mass` (kg) is spread uniformly (paper §3.1).
///
/// With tetrahedron (o, a, b, c) of signed volume V and s = a + b + c: ∫x = V s/4, ∫x xᵀ = V (a aᵀ + b bᵀ + c cᵀ + s
/// sᵀ)/20. Parts that overlap count twice, as if they were pressed into one another.
///
/// # Errors
/// Any error of [`check`], and a mass that is not positive.
pub fn mass_properties(mesh: &Mesh, mass: f64) -> Result<MassProperties, GeometryError> {
    if !(mass > 0.0 && mass.is_finite()) {
        return Err(GeometryError::Mass(mass));
    }
    check(mesh)?;
    let about = centre(mesh);
    let mut volume = 0.0;
    let mut first = Vec3::zero();
    // Second moments ∫x xᵀ: xx, yy, zz, xy, xz, yz.
    let mut second = [0.0; 6];
    for t in &mesh.triangles {
        let [a, b, c] = corners(mesh, t, about);
        let v = a.dot(b.cross(c)) / 6.0;
        let s = a + b + c;
        volume += v;
        first += s * (v / 4.0);
        for p in [a, b, c, s] {
            let w = v / 20.0;
            let products = [
                p.x * p.x,
                p.y * p.y,
                p.z * p.z,
                p.x * p.y,
                p.x * p.z,
                p.y * p.z,
            ];
            for (sum, product) in second.iter_mut().zip(products) {
                *sum += w * product;
            }
        }
    }
    if volume <= 0.0 {
        return Err(GeometryError::Inward { vertex: 0, volume });
    }
    let density = mass / volume;
    let offset = first * (1.0 / volume);
    let [xx, yy, zz, xy, xz, yz] = second.map(|s| s * density);
    let about_centre = Sym3 {
        xx: yy + zz,
        yy: xx + zz,
        zz: xx + yy,
        xy: -xy,
        xz: -xz,
        yz: -yz,
    };
    Ok(MassProperties {
        volume,
        mass,
        com: about + offset,
        inertia: about_centre - Sym3::point_mass(mass, offset), // parallel-axis theorem
    })
}

/// One cross-section of a loft: the points `centre + c·u + s·v` over a closed curve (c, s) between an ellipse and its
/// box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Middle of the section, m.
    pub centre: Vec3,
    /// First half axis, m.
    pub u: Vec3,
    /// Second half axis, m.
    pub v: Vec3,
    /// 0 = ellipse … 1 = rectangle, for the sides +v and −v.
    pub square: [f64; 2],
}

/// The unit curve of a section with `sides` points (a multiple of 4), exactly symmetric in both axes.
fn unit_curve(sides: usize, square: [f64; 2]) -> Vec<(f64, f64)> {
    assert!(
        sides >= 4 && sides.is_multiple_of(4),
        "a section has 4, 8, 12 … sides"
    );
    let quarter = sides / 4;
    let step = std::f64::consts::TAU / sides as f64;
    // Only the first quadrant is computed: mirrored bodies must match to the last bit.
    let first: Vec<(f64, f64)> = (0..=quarter)
        .map(|k| match k {
            0 => (1.0, 0.0),
            k if k == quarter => (0.0, 1.0),
            k => {
                let (s, c) = trig::sin_cos(step * k as f64);
                (c, s)
            }
        })
        .collect();
    let squared = |(c, s): (f64, f64), q: f64| {
        let r = 1.0 + q * (1.0 / f64::max(c, s) - 1.0);
        (c * r, s * r)
    };
    (0..sides)
        .map(|k| {
            let (turn, j) = (k / quarter, k % quarter);
            let (p, upper) = match turn {
                0 => (first[j], true),
                1 => ((first[quarter - j].0, first[quarter - j].1), true),
                2 => (first[j], false),
                _ => (first[quarter - j], false),
            };
            let (c, s) = squared(p, square[usize::from(!upper)]);
            match turn {
                0 => (c, s),
                1 => (-c, s),
                2 => (-c, -s),
                _ => (c, -s),
            }
        })
        .collect()
}

/// Surface through `sections` in order, closed by a pole at each end, each with `sides` points (a multiple of 4).
///
/// `poles` are the end points beyond the first and the last section. The result faces outwards, in whichever direction
/// the sections run.
pub fn loft(sections: &[Section], poles: [Vec3; 2], sides: usize) -> Mesh {
    let mut vertices = Vec::with_capacity(sections.len() * sides + 2);
    for section in sections {
        for (c, s) in unit_curve(sides, section.square) {
            vertices.push(section.centre + section.u * c + section.v * s);
        }
    }
    let at = |ring: usize, k: usize| (ring * sides + k % sides) as u32;
    let (first_pole, last_pole) = (vertices.len() as u32, vertices.len() as u32 + 1);
    vertices.extend(poles);
    let mut triangles = Vec::with_capacity(2 * sides * sections.len());
    let last = sections.len() - 1;
    for k in 0..sides {
        triangles.push([first_pole, at(0, k + 1), at(0, k)]);
        for ring in 0..last {
            let (a, b) = (at(ring, k), at(ring, k + 1));
            let (c, d) = (at(ring + 1, k), at(ring + 1, k + 1));
            // The diagonal is mirrored in the two halves so that a symmetric outline gives a symmetric surface.
            if k < sides / 2 {
                triangles.push([a, b, d]);
                triangles.push([a, d, c]);
            } else {
                triangles.push([a, b, c]);
                triangles.push([b, d, c]);
            }
        }
        triangles.push([last_pole, at(last, k), at(last, k + 1)]);
    }
    let mut mesh = Mesh {
        vertices,
        triangles,
    };
    if volume(&mesh) < 0.0 {
        flip(&mut mesh);
    }
    mesh
}

/// Turns the surface inside out.
fn flip(mesh: &mut Mesh) {
    for t in &mut mesh.triangles {
        t.swap(1, 2);
    }
}

/// Adds the surfaces of `part` to `mesh`.
pub fn append(mesh: &mut Mesh, part: &Mesh) {
    let base = mesh.vertices.len() as u32;
    mesh.vertices.extend_from_slice(&part.vertices);
    mesh.triangles
        .extend(part.triangles.iter().map(|t| t.map(|i| i + base)));
}

/// The mirror image in the plane y = 0, facing outwards again.
pub fn mirrored(mesh: &Mesh) -> Mesh {
    let mut out = mesh.clone();
    for v in &mut out.vertices {
        v.y = -v.y;
    }
    flip(&mut out);
    out
}

/// The vertex that lies farthest along `direction`; the first one in a tie. Panics on an empty mesh, which a loft never
/// produces.
pub fn extreme(mesh: &Mesh, direction: Vec3) -> Vec3 {
    let mut best = mesh.vertices[0];
    for v in &mesh.vertices {
        if v.dot(direction) > best.dot(direction) {
            best = *v;
        }
    }
    best
}

/// An axis-aligned box with corners `low` and `high`, facing outwards.
pub fn cuboid(low: Vec3, high: Vec3) -> Mesh {
    let pick = |bit: bool, a: f64, b: f64| if bit { b } else { a };
    let vertices = (0..8)
        .map(|i| {
            vec3(
                pick(i & 1 != 0, low.x, high.x),
                pick(i & 2 != 0, low.y, high.y),
                pick(i & 4 != 0, low.z, high.z),
            )
        })
        .collect();
    let faces: [[u32; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = faces
        .iter()
        .flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]])
        .collect();
    Mesh {
        vertices,
        triangles,
    }
}

#[cfg(test)]
mod tests {
    //! Goal: the volume integrals against closed forms and against their own transformation rules.
    use super::*;
    use crate::math::Quat;

    fn sphere(radius: f64, rings: usize, sides: usize) -> Mesh {
        let sections: Vec<Section> = (1..rings)
            .map(|i| {
                let a = std::f64::consts::PI * i as f64 / rings as f64;
                Section {
                    centre: Vec3::Z * (-radius * a.cos()),
                    u: Vec3::X * (radius * a.sin()),
                    v: Vec3::Y * (radius * a.sin()),
                    square: [0.0; 2],
                }
            })
            .collect();
        loft(&sections, [Vec3::Z * -radius, Vec3::Z * radius], sides)
    }

    fn lopsided() -> Mesh {
        let section = |z: f64, a: f64, b: f64, x: f64| Section {
            centre: vec3(x, 0.3 * z, z),
            u: vec3(a, 0.0, 0.0),
            v: vec3(0.0, b, 0.0),
            square: [0.4, 0.0],
        };
        loft(
            &[
                section(0.0, 0.1, 0.2, 0.0),
                section(0.3, 0.25, 0.1, 0.05),
                section(0.5, 0.1, 0.1, 0.1),
            ],
            [vec3(0.0, 0.0, -0.1), vec3(0.1, 0.15, 0.6)],
            12,
        )
    }

    fn assert_tensor(a: Sym3, b: Sym3, relative: f64) {
        let scale = b.xx + b.yy + b.zz;
        for (p, q) in [
            (a.xx, b.xx),
            (a.yy, b.yy),
            (a.zz, b.zz),
            (a.xy, b.xy),
            (a.xz, b.xz),
            (a.yz, b.yz),
        ] {
            assert!((p - q).abs() < relative * scale, "{a:?} against {b:?}");
        }
    }

    /// Section 3.1 of the paper.
    #[test]
    fn box_has_its_closed_form() {
        let (low, high) = (vec3(0.2, -0.3, 1.0), vec3(0.7, 0.1, 1.2));
        let p = mass_properties(&cuboid(low, high), 7.0).unwrap();
        let e = high - low;
        assert!((p.volume - e.x * e.y * e.z).abs() < 1e-15);
        assert!((p.com - (low + high) * 0.5).norm() < 1e-14);
        let i = |a: f64, b: f64| 7.0 / 12.0 * (a * a + b * b);
        assert_tensor(
            p.inertia,
            Sym3::diagonal(i(e.y, e.z), i(e.x, e.z), i(e.x, e.y)),
            1e-13,
        );
    }

    /// Section 3.1 of the paper.
    #[test]
    fn sphere_converges_to_two_fifths_m_r_squared() {
        let mut before = f64::INFINITY;
        for n in [8, 16, 32, 64] {
            let p = mass_properties(&sphere(0.3, n, 2 * n), 5.0).unwrap();
            let exact = 0.4 * 5.0 * 0.09;
            let error = (p.inertia.xx - exact)
                .abs()
                .max((p.inertia.zz - exact).abs())
                / exact;
            assert!(error < 0.3 * before, "second order: {error} after {before}");
            assert!(p.com.norm() < 1e-14);
            before = error;
        }
        assert!(before < 2e-3);
    }

    /// Section 3.1 of the paper.
    #[test]
    fn translation_obeys_the_parallel_axis_theorem() {
        let mesh = lopsided();
        let p = mass_properties(&mesh, 3.0).unwrap();
        let by = vec3(2.0, -1.0, 0.5);
        let mut moved = mesh;
        moved.vertices.iter_mut().for_each(|v| *v += by);
        let q = mass_properties(&moved, 3.0).unwrap();
        assert!((q.com - p.com - by).norm() < 1e-13);
        let about_origin = |m: MassProperties| m.inertia + Sym3::point_mass(m.mass, m.com);
        let shifted =
            about_origin(p) - Sym3::point_mass(3.0, p.com) + Sym3::point_mass(3.0, p.com + by);
        assert_tensor(about_origin(q), shifted, 1e-13);
        assert_tensor(q.inertia, p.inertia, 1e-12);
    }

    #[test]
    fn rotation_turns_the_tensor_and_mirroring_its_signs() {
        let mesh = lopsided();
        let p = mass_properties(&mesh, 3.0).unwrap();
        let r = Quat::exp(vec3(0.7, -1.1, 0.4)).to_mat3();
        let mut turned = mesh.clone();
        turned.vertices.iter_mut().for_each(|v| *v = r * *v);
        let q = mass_properties(&turned, 3.0).unwrap();
        assert!((q.com - r * p.com).norm() < 1e-14);
        assert_tensor(q.inertia, p.inertia.rotated(r), 1e-13);
        let m = mass_properties(&mirrored(&mesh), 3.0).unwrap();
        assert!((m.com - vec3(p.com.x, -p.com.y, p.com.z)).norm() < 1e-15);
        let expected = Sym3 {
            xy: -p.inertia.xy,
            yz: -p.inertia.yz,
            ..p.inertia
        };
        assert_tensor(m.inertia, expected, 1e-14);
    }

    #[test]
    fn defects_are_named() {
        let good = cuboid(Vec3::zero(), vec3(1.0, 1.0, 1.0));
        assert_eq!(check(&good), Ok(()));
        let mut open = good.clone();
        open.triangles.pop();
        assert!(matches!(check(&open), Err(GeometryError::Open(..))));
        let mut inward = good.clone();
        flip(&mut inward);
        assert!(matches!(check(&inward), Err(GeometryError::Inward { .. })));
        let mut beyond = good.clone();
        beyond.triangles[3][1] = 8;
        assert!(matches!(
            check(&beyond),
            Err(GeometryError::Corner { triangle: 3, .. })
        ));
        let mut nan = good.clone();
        nan.vertices[2].y = f64::NAN;
        assert_eq!(check(&nan), Err(GeometryError::NotFinite(2)));
        // A hidden inward part is found although the sum is positive.
        let mut hollow = good;
        let mut hole = cuboid(vec3(0.2, 0.2, 0.2), vec3(0.4, 0.4, 0.4));
        flip(&mut hole);
        append(&mut hollow, &hole);
        assert!(matches!(
            check(&hollow),
            Err(GeometryError::Inward { vertex: 8.., .. })
        ));
        assert!(matches!(
            mass_properties(&hollow, 0.0),
            Err(GeometryError::Mass(_))
        ));
    }
}
