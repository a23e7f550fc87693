//! Nearest points of two shapes, with a normal and a gap.

use super::shape::Capsule;
use crate::math::vec3::vec3;
use crate::math::{Mat3, Vec3};

/// Nearest points of two shapes A and B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Between the two surfaces, world, m.
    pub position: Vec3,
    /// Unit vector from B to A.
    pub normal: Vec3,
    /// Distance of the surfaces, m; negative when they overlap.
    pub gap: f64,
}

impl Near {
    /// The same, seen from B.
    pub fn flipped(self) -> Self {
        Self {
            normal: -self.normal,
            ..self
        }
    }
}

/// A box with its pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosedBox {
    /// Centre, world, m.
    pub centre: Vec3,
    /// Axes.
    pub axes: Mat3,
    /// Half edges, m.
    pub half: Vec3,
}

/// Parameters of the nearest points of two line segments (Ericson, *Real-Time Collision Detection*, §5.1.9).
fn nearest_parameters(p1: Vec3, d1: Vec3, p2: Vec3, d2: Vec3) -> (f64, f64) {
    const TINY: f64 = 1e-12;
    let r = p1 - p2;
    let (a, e, f) = (d1.dot(d1), d2.dot(d2), d2.dot(r));
    if a <= TINY && e <= TINY {
        return (0.0, 0.0);
    }
    if a <= TINY {
        return (0.0, (f / e).clamp(0.0, 1.0));
    }
    let c = d1.dot(r);
    if e <= TINY {
        return ((-c / a).clamp(0.0, 1.0), 0.0);
    }
    let b = d1.dot(d2);
    let denominator = a * e - b * b;
    let s = if denominator > 1e-9 * a * e {
        ((b * f - c * e) / denominator).clamp(0.0, 1.0)
    } else {
        // If they are parallel, take the middle of the common part, so that no body tips over an arbitrary point.
        let (t0, t1) = ((f / e).clamp(0.0, 1.0), ((f + b) / e).clamp(0.0, 1.0));
        let t = 0.5 * (t0 + t1);
        ((t * b - c) / a).clamp(0.0, 1.0)
    };
    let t = (b * s + f) / e;
    if t < 0.0 {
        ((-c / a).clamp(0.0, 1.0), 0.0)
    } else if t > 1.0 {
        (((b - c) / a).clamp(0.0, 1.0), 1.0)
    } else {
        (s, t)
    }
}

/// Two capsules.
pub fn capsules(a: &Capsule, b: &Capsule) -> Near {
    let (da, db) = (a.b - a.a, b.b - b.a);
    let (s, t) = nearest_parameters(a.a, da, b.a, db);
    let (pa, pb) = (a.a + da * s, b.a + db * t);
    let (ra, rb) = (a.ra + s * (a.rb - a.ra), b.ra + t * (b.rb - b.ra));
    let d = pa - pb;
    // If the axes cross, any direction separates them, and the one across both is the shortest.
    let normal = d.normalized_or(da.cross(db).normalized_or(Vec3::Z));
    let gap = d.norm() - ra - rb;
    Near {
        position: pb + normal * (rb + 0.5 * gap),
        normal,
        gap,
    }
}

/// Two capsules: their nearest points, and the points nearest to each end. A part that turns fast may hit with an end
/// that is not yet the nearest point, and two limbs side by side touch at two places.
pub fn capsule_points(a: &Capsule, b: &Capsule, mut emit: impl FnMut(Near)) {
    emit(capsules(a, b));
    let ball = |p: Vec3, r: f64| Capsule {
        a: p,
        b: p,
        ra: r,
        rb: r,
    };
    if (a.b - a.a).norm() > MERGE {
        emit(capsules(&ball(a.a, a.ra), b));
        emit(capsules(&ball(a.b, a.rb), b));
    }
    if (b.b - b.a).norm() > MERGE {
        emit(capsules(a, &ball(b.a, b.ra)));
        emit(capsules(a, &ball(b.b, b.rb)));
    }
}

/// Points nearer to each other than this are merged, m.
pub const MERGE: f64 = 0.02;

/// A ball (A) at a box (B); radius 0 is a point.
pub fn ball_box(centre: Vec3, radius: f64, b: &PosedBox) -> Near {
    let p = b.axes.transpose_mul(centre - b.centre);
    let (x, half) = (p.to_array(), b.half.to_array());
    let q: [f64; 3] = std::array::from_fn(|k| x[k].clamp(-half[k], half[k]));
    let outside = p - vec3(q[0], q[1], q[2]);
    let distance = outside.norm();
    let (normal, depth) = if distance > 1e-9 {
        (outside * (1.0 / distance), distance)
    } else {
        // If the centre is inside, move it out through the nearest face.
        let mut k = 0;
        for i in 1..3 {
            if half[i] - x[i].abs() < half[k] - x[k].abs() {
                k = i;
            }
        }
        let mut n = [0.0; 3];
        n[k] = if x[k] < 0.0 { -1.0 } else { 1.0 };
        (vec3(n[0], n[1], n[2]), x[k].abs() - half[k])
    };
    let normal = b.axes * normal;
    let gap = depth - radius;
    Near {
        position: centre - normal * (radius + 0.5 * gap),
        normal,
        gap,
    }
}

/// A ball (A) over a half-space (B) through `origin` with unit `normal`.
pub fn ball_plane(centre: Vec3, radius: f64, origin: Vec3, normal: Vec3) -> Near {
    let gap = (centre - origin).dot(normal) - radius;
    Near {
        position: centre - normal * (radius + 0.5 * gap),
        normal,
        gap,
    }
}

/// A capsule (A) at a box (B): its ends, and the nearest point between them if that is nearer than both.
pub fn capsule_box(c: &Capsule, b: &PosedBox, mut emit: impl FnMut(Near)) {
    let d = c.b - c.a;
    let at = |t: f64| ball_box(c.a + d * t, c.ra + t * (c.rb - c.ra), b);
    let (first, last) = (at(0.0), at(1.0));
    emit(first);
    if d.dot(d) < 1e-12 {
        return;
    }
    emit(last);
    // The gap is convex along the axis.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..24 {
        let (l, h) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(l).gap <= at(h).gap {
            high = h;
        } else {
            low = l;
        }
    }
    let middle = at(0.5 * (low + high));
    if middle.gap < first.gap.min(last.gap) - 1e-4 {
        emit(middle);
    }
}

/// Corners of a box.
pub fn corners(b: &PosedBox) -> [Vec3; 8] {
    std::array::from_fn(|i| {
        let s = |bit: usize, h: f64| if i & bit != 0 { h } else { -h };
        b.centre + b.axes * vec3(s(1, b.half.x), s(2, b.half.y), s(4, b.half.z))
    })
}

#[cfg(test)]
mod tests {
    //! Goal: nearest points against sampling.
    use super::*;
    use crate::math::Quat;
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    fn vector(rng: &mut Pcg64Mcg) -> Vec3 {
        let mut r = || rng.random_range(-1.0..1.0);
        vec3(r(), r(), r())
    }

    #[test]
    fn capsules_are_as_far_apart_as_sampling_says() {
        let mut rng = Pcg64Mcg::seed_from_u64(7);
        for _ in 0..500 {
            let (a, b) = (
                Capsule {
                    a: vector(&mut rng),
                    b: vector(&mut rng),
                    ra: 0.1,
                    rb: 0.1,
                },
                Capsule {
                    a: vector(&mut rng),
                    b: vector(&mut rng),
                    ra: 0.05,
                    rb: 0.05,
                },
            );
            let near = capsules(&a, &b);
            let mut least = f64::INFINITY;
            for i in 0..=60 {
                for j in 0..=60 {
                    let p = a.a + (a.b - a.a) * (f64::from(i) / 60.0);
                    let q = b.a + (b.b - b.a) * (f64::from(j) / 60.0);
                    least = least.min((p - q).norm() - 0.15);
                }
            }
            assert!(near.gap <= least + 1e-9 && near.gap > least - 0.05);
            assert!((near.normal.norm() - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn box_pushes_out_through_the_nearest_face() {
        let b = PosedBox {
            centre: vec3(1.0, 2.0, 3.0),
            axes: Quat::exp(vec3(0.3, -0.2, 0.5)).to_mat3(),
            half: vec3(0.5, 0.4, 0.3),
        };
        let n = ball_box(b.centre + b.axes * vec3(0.1, 0.0, 0.25), 0.0, &b);
        assert!((n.gap + 0.05).abs() < 1e-12 && (n.normal - b.axes.z).norm() < 1e-12);
        let n = ball_box(b.centre + b.axes * vec3(0.8, 0.8, 0.0), 0.1, &b);
        assert!((n.gap - 0.4).abs() < 1e-12);
        let mut rng = Pcg64Mcg::seed_from_u64(8);
        for _ in 0..300 {
            let c = Capsule {
                a: b.centre + vector(&mut rng),
                b: b.centre + vector(&mut rng),
                ra: 0.05,
                rb: 0.05,
            };
            let mut least = f64::INFINITY;
            capsule_box(&c, &b, |n| least = least.min(n.gap));
            for i in 0..=100 {
                let p = c.a + (c.b - c.a) * (f64::from(i) / 100.0);
                let gap = ball_box(p, 0.05, &b).gap;
                assert!(least < gap + 2e-3 || gap < -0.2, "{least} {gap}");
            }
        }
    }
}
