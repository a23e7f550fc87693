//! A segment's surface as a few boxes and cylinders, for formats that cannot hold a mesh within the document.

use crate::body::geometry::mass_properties;
use crate::body::model::Mesh;
use crate::math::Vec3;

/// Slices of a segment along its longest extent.
const SLICES: usize = 4;
/// A slice whose two widths differ by less than this factor is drawn as a cylinder.
const ROUND: f64 = 1.3;

/// One box or cylinder, axes parallel to those of the segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Solid {
    /// Middle, segment frame, m.
    pub middle: Vec3,
    /// Edges along x, y, z, m; of a cylinder around z the first is its diameter and the last its length.
    pub size: Vec3,
    /// A cylinder around z; else a box.
    pub cylinder: bool,
}

/// Slices of `mesh` along its longest extent, each as wide as the surface there. Their volumes add to that of the
/// surface. Empty for a mesh that encloses nothing.
pub(super) fn solids(mesh: &Mesh) -> Vec<Solid> {
    if mesh.triangles.is_empty() {
        return Vec::new();
    }
    let Ok(whole) = mass_properties(mesh, 1.0) else {
        return Vec::new();
    };
    let vertices: Vec<[f64; 3]> = mesh.vertices.iter().map(|v| v.to_array()).collect();
    let [low, high] = extent(&vertices);
    let axis = (0..3).fold(0, |a, k| {
        if high[k] - low[k] > high[a] - low[a] {
            k
        } else {
            a
        }
    });
    let step = (high[axis] - low[axis]) / SLICES as f64;
    let boxes: Vec<[[f64; 3]; 2]> = (0..SLICES)
        .filter_map(|i| {
            let from = low[axis] + step * i as f64;
            slice(mesh, &vertices, axis, [from, from + step])
        })
        .collect();
    let volume: f64 = boxes
        .iter()
        .map(|[l, h]| (0..3).map(|k| h[k] - l[k]).product::<f64>())
        .sum();
    // Scale both widths of every slice by the same factor, so that the volume is right.
    let area = whole.volume / volume;
    boxes
        .iter()
        .map(|[l, h]| solid(*l, *h, axis, area))
        .collect()
}

/// The solid of a slice with these bounds, its cross-section `area` times that of the bounds.
fn solid(low: [f64; 3], high: [f64; 3], axis: usize, area: f64) -> Solid {
    let middle = Vec3::from_array(std::array::from_fn(|k| 0.5 * (low[k] + high[k])));
    let size: [f64; 3] = std::array::from_fn(|k| {
        let all = high[k] - low[k];
        if k == axis { all } else { all * area.sqrt() }
    });
    let (wide, narrow) = (size[0].max(size[1]), size[0].min(size[1]));
    let cylinder = axis == 2 && wide < ROUND * narrow;
    if !cylinder {
        return Solid {
            middle,
            size: Vec3::from_array(size),
            cylinder,
        };
    }
    let diameter = (size[0] * size[1] * 4.0 / std::f64::consts::PI).sqrt();
    Solid {
        middle,
        size: Vec3 {
            x: diameter,
            y: diameter,
            z: size[2],
        },
        cylinder,
    }
}

/// Least and largest coordinates of points.
fn extent(points: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let start = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    points.iter().fold(start, |[low, high], p| {
        [
            std::array::from_fn(|k| low[k].min(p[k])),
            std::array::from_fn(|k| high[k].max(p[k])),
        ]
    })
}

/// Bounds of the surface between two planes across `axis`; `None` if there is none.
fn slice(
    mesh: &Mesh,
    vertices: &[[f64; 3]],
    axis: usize,
    planes: [f64; 2],
) -> Option<[[f64; 3]; 2]> {
    let mut points: Vec<[f64; 3]> = vertices
        .iter()
        .filter(|v| (planes[0]..=planes[1]).contains(&v[axis]))
        .copied()
        .collect();
    for t in &mesh.triangles {
        for k in 0..3 {
            let [a, b] = [t[k], t[(k + 1) % 3]].map(|i| vertices[i as usize]);
            for at in planes {
                if (a[axis] < at) != (b[axis] < at) {
                    let u = (at - a[axis]) / (b[axis] - a[axis]);
                    points.push(std::array::from_fn(|k| a[k] + u * (b[k] - a[k])));
                }
            }
        }
    }
    let [mut low, mut high] = extent(&points);
    (low[axis], high[axis]) = (planes[0], planes[1]);
    (!points.is_empty()).then_some([low, high])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;

    #[test]
    fn solids_have_the_volume_of_the_surface_and_lie_within_its_bounds() {
        for body in [Body::adult_man(), Body::adult_woman()] {
            for s in &body.segments {
                let all = solids(&s.mesh);
                assert_eq!(all.len(), SLICES);
                let volume: f64 = all
                    .iter()
                    .map(|b| {
                        let share = if b.cylinder {
                            0.25 * std::f64::consts::PI
                        } else {
                            1.0
                        };
                        b.size.x * b.size.y * b.size.z * share
                    })
                    .sum();
                let whole = mass_properties(&s.mesh, 1.0).expect("closed").volume;
                assert!((volume / whole - 1.0).abs() < 1e-9, "{volume} {whole}");
                let points: Vec<[f64; 3]> = s.mesh.vertices.iter().map(|v| v.to_array()).collect();
                let [low, high] = extent(&points);
                for b in all {
                    let (c, e) = (b.middle.to_array(), b.size.to_array());
                    for k in 0..3 {
                        // A cylinder that replaces a slightly oval slice is a little wider in one direction.
                        let most = 0.5 * e[k] * if b.cylinder { 0.85 } else { 1.0 };
                        assert!(c[k] - most > low[k] - 1e-9 && c[k] + most < high[k] + 1e-9);
                    }
                }
            }
        }
    }

    #[test]
    fn a_segment_without_a_surface_has_no_solids() {
        assert!(solids(&Mesh::default()).is_empty());
    }
}
