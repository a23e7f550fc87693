//! A contact strictly inside its friction cone, for the interior-point method ([`super::interior`]).
//!
//! Coordinates in which the cone `|(x, y)| ≤ z` is its own dual: normal force times μ, normal velocity over μ. With the
//! scaling W of Nesterov and Todd the multiplier λ is `W⁻² f`, and eliminating both leaves the stiffness `(R + W⁻²)⁻¹`.
//!
//! For a sliding point, force and multiplier come so close to the surface that `z − |(x, y)|` has no digits left, and
//! the eigenvalues of W⁻² differ by a factor of 10¹⁶ or more. Assembled in x, y and z, the stiffness would lose its
//! small eigenvalue, then its sign, and the next force would lie outside. Therefore the distance to the surface is
//! stored separately, and everything is assembled along the directions in which W is diagonal, from numbers of one
//! sign.

use crate::math::Vec3;

const HALF_ROOT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A vector inside the cone.
#[derive(Clone, Copy, Debug, Default)]
struct Inside {
    /// x, y, and their length with its direction.
    t: [f64; 2],
    length: f64,
    n: [f64; 2],
    /// `z − |(x, y)|`.
    s: f64,
}

/// A step of such a vector: in x and y, along its `n` and across, along z, and the first-order change of its `s`.
#[derive(Clone, Copy, Debug, Default)]
struct ConeStep {
    t: [f64; 2],
    along: f64,
    across: f64,
    z: f64,
    s: f64,
}

#[inline(always)]
fn inner(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// `1 − cos` and `1 + cos` of the angle between two unit vectors.
#[inline(always)]
fn versines(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let (d, s) = ([a[0] - b[0], a[1] - b[1]], [a[0] + b[0], a[1] + b[1]]);
    [0.5 * inner(d, d), 0.5 * inner(s, s)]
}

impl Inside {
    #[inline(always)]
    fn new(t: [f64; 2], s: f64) -> Self {
        let length = inner(t, t).sqrt();
        let n = if length > 0.0 {
            [t[0] / length, t[1] / length]
        } else {
            [1.0, 0.0]
        };
        Self { t, length, n, s }
    }

    #[inline(always)]
    fn z(&self) -> f64 {
        self.length + self.s
    }

    #[inline(always)]
    fn vector(&self) -> Vec3 {
        Vec3 {
            x: self.t[0],
            y: self.t[1],
            z: self.z(),
        }
    }

    /// `z² − x² − y²`.
    #[inline(always)]
    fn square(&self) -> f64 {
        self.s * (self.s + 2.0 * self.length)
    }

    /// Components along (n, 1), (−n, 1) and across, for a unit vector `n`.
    #[inline(always)]
    fn along(&self, n: [f64; 2]) -> [f64; 3] {
        let [less, more] = versines(n, self.n);
        [
            HALF_ROOT * (self.s + self.length * more),
            HALF_ROOT * (self.s + self.length * less),
            n[0] * self.t[1] - n[1] * self.t[0],
        ]
    }

    /// A step that is given by the same components.
    #[inline(always)]
    fn step(&self, n: [f64; 2], d: [f64; 3]) -> ConeStep {
        let [less, more] = versines(n, self.n);
        let a = HALF_ROOT * (d[0] - d[1]);
        let t = [n[0] * a - n[1] * d[2], n[1] * a + n[0] * d[2]];
        let sine = n[0] * self.n[1] - n[1] * self.n[0];
        ConeStep {
            t,
            along: inner(self.n, t),
            across: self.n[0] * t[1] - self.n[1] * t[0],
            z: HALF_ROOT * (d[0] + d[1]),
            s: HALF_ROOT * (d[0] * less + d[1] * more) - sine * d[2],
        }
    }

    /// Largest step ≤ `most` that stays in the cone.
    #[inline(always)]
    fn way(&self, d: &ConeStep, most: f64) -> f64 {
        // q0 + 2 q1 s + q2 s² is positive at 0; the cone is left at its first positive root, or where z changes sign.
        let q0 = self.square();
        let q1 = self.length * d.s + self.s * d.z;
        let q2 = d.s * (d.z + d.along) - d.across * d.across;
        let disc = q1 * q1 - q0 * q2;
        let mut s = most;
        if disc >= 0.0 {
            let r = disc.sqrt();
            // Both roots without cancellation.
            let big = if q1 >= 0.0 { -(q1 + r) } else { r - q1 };
            for root in [q0 / big, big / q2] {
                if root > 0.0 && root < s {
                    s = root;
                }
            }
        }
        if d.z < 0.0 {
            s = s.min(-self.z() / d.z);
        }
        s
    }

    #[inline(always)]
    fn advance(&mut self, d: &ConeStep, step: f64) {
        let next = Self::new(
            [self.t[0] + step * d.t[0], self.t[1] + step * d.t[1]],
            self.s,
        );
        // |t + d| − |t| − n·d = across² over the sum: all terms are positive unless d leads back across the axis.
        let (way, across) = (self.length + step * d.along, step * d.across);
        let bend = if way > 0.0 {
            across * across / (next.length + way)
        } else {
            next.length - way
        };
        *self = Self {
            s: self.s + step * d.s - bend,
            ..next
        };
    }
}

/// A contact in its cone: force and multiplier.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cone {
    f: Inside,
    l: Inside,
    df: ConeStep,
    dl: ConeStep,
    /// W is diagonal along (n, 1), (−n, 1) and across.
    n: [f64; 2],
    /// W⁻² there.
    w: [f64; 3],
    /// The stiffness there: of the first, the second, both, and across.
    h: [f64; 4],
    /// The force's step there, at the present velocity.
    d: [f64; 3],
}

impl Cone {
    /// On the axis: force `widest`, multiplier `size` beyond the velocity `v`.
    #[inline(always)]
    pub(crate) fn begin(v: Vec3, size: f64, widest: f64) -> Self {
        Self {
            f: Inside::new([0.0; 2], widest),
            l: Inside::new([0.0; 2], size + v.norm()),
            ..Self::default()
        }
    }

    /// Product of force and multiplier.
    #[inline(always)]
    pub(crate) fn gap(&self) -> f64 {
        let (f, l) = (&self.f, &self.l);
        let more = versines(f.n, l.n)[1];
        f.length * l.length * more + f.length * l.s + f.s * l.z()
    }

    /// Computes the directions in which W is diagonal, and W⁻² there.
    #[inline(always)]
    fn scale(&mut self) {
        let (f, l) = (&self.f, &self.l);
        let (sf, sl) = (f.square().sqrt(), l.square().sqrt());
        let t = [l.t[0] / sl - f.t[0] / sf, l.t[1] / sl - f.t[1] / sf];
        let gamma = (0.5 * (1.0 + self.gap() / (sf * sl))).sqrt();
        let w = Inside::new([t[0] * (0.5 / gamma), t[1] * (0.5 / gamma)], 0.0);
        let (k, sum) = (sl / sf, w.length + (1.0 + w.length * w.length).sqrt());
        self.n = w.n;
        self.w = [k * sum * sum, k / (sum * sum), k];
    }

    /// Eliminates the contact and returns the root of its stiffness `(R + W⁻²)⁻¹ = Σ c cᵀ`. Afterwards [`Self::next`]
    /// is its force at the velocity `v` (offset included), with the multiplier that the aim requires. `r`: compliance.
    #[inline(always)]
    pub(crate) fn eliminate(&mut self, r: f64, mu: f64, v: Vec3, aim: f64) -> [Vec3; 3] {
        self.scale();
        let [plus, minus, k] = self.w;
        let rn = r / (mu * mu);
        let (d1, d2) = (0.5 * (rn + r), 0.5 * (rn - r));
        let det = r * rn + d1 * (plus + minus) + plus * minus;
        self.h = [
            (d1 + minus) / det,
            (d1 + plus) / det,
            -d2 / det,
            1.0 / (r + k),
        ];
        let f = self.f.vector();
        let rest = self.components(Vec3 {
            x: r * f.x + v.x,
            y: r * f.y + v.y,
            z: rn * f.z + v.z,
        });
        let inverse = self.inverse();
        self.d = self.pushed([0, 1, 2].map(|i| rest[i] - aim * inverse[i]));
        let (a, b) = (self.h[1].sqrt(), 1.0 / (d1 + plus).sqrt());
        let c = -d2 / (d1 + plus) * a;
        [
            self.vector([c, a, 0.0]),
            self.vector([b, 0.0, 0.0]),
            self.vector([0.0, 0.0, self.h[3].sqrt()]),
        ]
    }

    /// Inverse of the force in the algebra of the cone.
    #[inline(always)]
    fn inverse(&self) -> [f64; 3] {
        let [plus, minus, across] = self.f.along(self.n);
        let q = 1.0 / self.f.square();
        [minus * q, plus * q, -across * q]
    }

    /// Minus the stiffness times a vector.
    #[inline(always)]
    fn pushed(&self, v: [f64; 3]) -> [f64; 3] {
        let h = &self.h;
        [
            -(h[0] * v[0] + h[2] * v[1]),
            -(h[2] * v[0] + h[1] * v[1]),
            -h[3] * v[2],
        ]
    }

    /// Components along the directions in which W is diagonal.
    #[inline(always)]
    fn components(&self, v: Vec3) -> [f64; 3] {
        let a = self.n[0] * v.x + self.n[1] * v.y;
        [
            HALF_ROOT * (v.z + a),
            HALF_ROOT * (v.z - a),
            self.n[0] * v.y - self.n[1] * v.x,
        ]
    }

    /// The vector with these components; inverse of [`Self::components`].
    #[inline(always)]
    fn vector(&self, c: [f64; 3]) -> Vec3 {
        let a = HALF_ROOT * (c[0] - c[1]);
        Vec3 {
            x: self.n[0] * a - self.n[1] * c[2],
            y: self.n[1] * a + self.n[0] * c[2],
            z: HALF_ROOT * (c[0] + c[1]),
        }
    }

    /// Its force after the step.
    #[inline(always)]
    pub(crate) fn next(&self) -> Vec3 {
        self.f.vector() + self.vector(self.d)
    }

    /// Its steps for a change `dv` of the velocity; the largest step ≤ `most` that keeps it inside.
    #[inline(always)]
    pub(crate) fn direct(&mut self, dv: Vec3, aim: f64, most: f64) -> f64 {
        let more = self.pushed(self.components(dv));
        let df = [0, 1, 2].map(|i| self.d[i] + more[i]);
        let (inverse, l) = (self.inverse(), self.l.along(self.n));
        let dl = [0, 1, 2].map(|i| aim * inverse[i] - l[i] - self.w[i] * df[i]);
        self.df = self.f.step(self.n, df);
        self.dl = self.l.step(self.n, dl);
        let step = self.f.way(&self.df, most);
        self.l.way(&self.dl, step)
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self, step: f64) {
        self.f.advance(&self.df, step);
        self.l.advance(&self.dl, step);
    }

    /// Its force.
    #[cfg(test)]
    pub(crate) fn force(&self) -> Vec3 {
        self.f.vector()
    }

    /// Distance of the force from the surface, relative to its size.
    #[cfg(test)]
    pub(crate) fn nearness(&self) -> f64 {
        self.f.s / self.f.z()
    }
}

/// `Σ c cᵀ`.
#[inline(always)]
pub(crate) fn squared(root: &[Vec3; 3]) -> [[f64; 3]; 3] {
    let mut d = [[0.0; 3]; 3];
    for c in root {
        let c = c.to_array();
        for (row, x) in d.iter_mut().zip(c) {
            for (z, y) in row.iter_mut().zip(c) {
                *z += x * y;
            }
        }
    }
    d
}
