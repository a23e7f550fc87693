//! Joint limits as unilateral rows: anatomical angles stay in their range, and a raised arm stays off the antipode.
//! Also the tissue that is stretched before the limits are met.

use crate::body::angles::{SWING_MAX, Swings};
use crate::body::topology::{
    DOF_AXIS, DOF_COUNT, DOF_LEN, DOF_SEGMENT, DOF_START, JOINT, Joint, NV, SEGMENT_COUNT,
};
use crate::body::{Body, Posture, State};
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::strength::Strength;

/// Stiffness of a limit row, kg·m²: impulse per missing rad/s (`docs/equations.md`, 14.3).
pub const LIMIT_STIFFNESS: f64 = 1e3;
/// Share of a limit violation that is corrected per substep.
const RETURN_SHARE: f64 = 0.2;
/// Fastest return into the range, rad/s, so that a joint far outside is not flung back.
const RETURN_SPEED: f64 = 3.0;

/// One limit: the distance to it changes at `rate = coefficients · x[first..first + 3]` and must not become negative.
/// Stretched tissue before a limit has the same form, with its own stiffness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LimitRow {
    /// First velocity component it acts on.
    pub first: usize,
    /// Number of components (1 or 3).
    pub len: usize,
    /// Coefficients of the rate of the distance.
    pub coefficients: [f64; 3],
    /// The row pushes where `rate < −allowed`: distance per substep, rad/s.
    pub allowed: f64,
    /// Impulse per rad/s beyond that, kg·m².
    pub stiffness: f64,
}

/// The limit rows of one posture: the nearer limit of every DOF, the swing limit of every ball joint, and the stretched
/// tissue.
#[derive(Clone, Debug, Default)]
pub struct LimitRows {
    /// Rows.
    pub rows: Vec<LimitRow>,
}

/// Largest number of rows of a figure.
pub const MAX_LIMITS: usize = 3 * DOF_COUNT + 9;

impl LimitRows {
    /// No rows, with room for all.
    pub fn new() -> Self {
        Self {
            rows: Vec::with_capacity(MAX_LIMITS),
        }
    }
}

fn allowed(distance: f64, h: f64) -> f64 {
    if distance > 0.0 {
        distance / h
    } else {
        (RETURN_SHARE * distance / h).max(-RETURN_SPEED)
    }
}

/// An anatomical angle and the row that gives its rate from the velocity.
struct AngleRow {
    /// `None`: the whole swing of a ball joint.
    dof: Option<usize>,
    angle: f64,
    first: usize,
    len: usize,
    coefficients: [f64; 3],
}

impl AngleRow {
    /// The row of a ball joint whose first DOF is `d`; `row` gives the angle's rate from the angular velocity in child
    /// axes.
    fn ball(d: usize, dof: Option<usize>, angle: f64, row: Vec3) -> Self {
        let axes = row.to_array();
        let coefficients = std::array::from_fn(|k| {
            let a = DOF_AXIS[d + k];
            f64::from(a.sign) * axes[a.axis]
        });
        Self {
            dof,
            angle,
            first: 6 + d,
            len: 3,
            coefficients,
        }
    }

    fn hinge(dof: usize, angle: f64) -> Self {
        Self {
            dof: Some(dof),
            angle,
            first: 6 + dof,
            len: 1,
            coefficients: [1.0, 0.0, 0.0],
        }
    }

    fn rate(&self, velocity: &[f64; NV]) -> f64 {
        let of = &velocity[self.first..self.first + self.len];
        let terms = self.coefficients.iter().zip(of);
        terms.map(|(c, v)| c * v).sum()
    }

    /// A row that pushes the angle up (`sign` 1) or down (−1).
    fn row(&self, sign: f64, allowed: f64, stiffness: f64) -> LimitRow {
        LimitRow {
            first: self.first,
            len: self.len,
            coefficients: self.coefficients.map(|c| sign * c),
            allowed,
            stiffness,
        }
    }

    /// The nearer of two limits that are `above` and `below` away, rad.
    fn limit(&self, above: f64, below: f64, h: f64) -> LimitRow {
        let (sign, distance) = if above < below {
            (1.0, above)
        } else {
            (-1.0, below)
        };
        self.row(sign, allowed(distance, h), LIMIT_STIFFNESS)
    }
}

/// Visits all angles, and the swings of ball joints that are large.
fn each_angle(posture: &Posture, swings: &Swings, mut visit: impl FnMut(AngleRow)) {
    for s in 1..SEGMENT_COUNT {
        let d = DOF_START[s];
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => {
                let st = &swings[b];
                for (k, angle) in st.angles(d).into_iter().enumerate() {
                    let a = DOF_AXIS[d + k];
                    let row = st.rate_rows[a.axis] * f64::from(a.sign);
                    visit(AngleRow::ball(d, Some(d + k), angle, row));
                }
                let n = st.swing.norm();
                if n > 0.5 * SWING_MAX {
                    let u = st.swing * (1.0 / n);
                    let row = st.rate_rows[0] * u.x + st.rate_rows[1] * u.y;
                    visit(AngleRow::ball(d, None, n, row));
                }
            }
            Joint::Hinge2(i) => {
                for k in 0..2 {
                    visit(AngleRow::hinge(d + k, posture.hinge[i + k]));
                }
            }
            Joint::Hinge1(i) => visit(AngleRow::hinge(d, posture.hinge[i])),
        }
    }
}

/// Fills the rows for a substep of `h` seconds from a state and the [`swings`](crate::body::angles::swings) of its
/// posture.
///
/// Stretched tissue gives `τ + K h ω` at the end of the substep, ω the speed into it: `K` is its mean stiffness over
/// the stretch at the present speed, so that it absorbs at least the energy that it stores. It never pulls.
///
/// Problem 14.3.
pub fn collect_limits(
    body: &Body,
    tissue: Option<&Strength>,
    (state, swings): (&State, &Swings),
    h: f64,
    out: &mut LimitRows,
) {
    let rows = &mut out.rows;
    rows.clear();
    each_angle(&state.posture, swings, |a| {
        let Some(d) = a.dof else {
            rows.push(a.limit(f64::INFINITY, SWING_MAX - a.angle, h));
            return;
        };
        rows.push(a.limit(a.angle - body.lower[d], body.upper[d] - a.angle, h));
        let Some(strength) = tissue else { return };
        let rate = a.rate(&state.velocity);
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            if let Some(s) = strength.stretched(d, side, a.angle, rate, h) {
                let allowed = -s.torque / (h * s.stiffness);
                rows.push(a.row(sign, allowed, h * h * s.stiffness));
            }
        }
    });
}

/// Torque of stretched tissue over a tick, as a controller expects it: the mean over the substeps.
#[derive(Clone, Debug, PartialEq)]
pub struct Tissue {
    /// Torque along the joint components if they do not accelerate, N·m.
    pub torque: [f64; DOF_COUNT],
    /// Decrease of the torque per rad/s² of acceleration, kg·m²; by segment, the components of its joint.
    pub inertia: Blocks,
}

/// By segment, the components of its joint.
pub type Blocks = [[[f64; 3]; 3]; SEGMENT_COUNT];

impl Tissue {
    /// Tissue in the state at the start of a tick of `substeps` substeps of `h` seconds, with the
    /// [`swings`](crate::body::angles::swings) of its posture. No allocation.
    ///
    /// The substeps are implicit: the i-th finds the tissue stretched by `i h ω + ½ i (i + 1) h² ω̇` more.
    pub fn new(
        strength: &Strength,
        (state, swings): (&State, &Swings),
        substeps: u32,
        h: f64,
    ) -> Self {
        let n = f64::from(substeps);
        let (way, by) = (0.5 * (n + 1.0) * h, (n + 1.0) * (n + 2.0) * h * h / 6.0);
        let mut out = Self {
            torque: [0.0; DOF_COUNT],
            inertia: [[[0.0; 3]; 3]; SEGMENT_COUNT],
        };
        each_angle(&state.posture, swings, |a| {
            let Some(d) = a.dof else { return };
            let rate = a.rate(&state.velocity);
            for (side, sign) in [(0, 1.0), (1, -1.0)] {
                let Some(s) = strength.stretched(d, side, a.angle, rate, 0.0) else {
                    continue;
                };
                let torque = (sign * s.torque) - s.stiffness * way * rate;
                let block = &mut out.inertia[DOF_SEGMENT[d]];
                for (k, c) in a.coefficients[..a.len].iter().enumerate() {
                    out.torque[a.first - 6 + k] += torque * c;
                    let at = a.first - 6 + k - DOF_START[DOF_SEGMENT[d]];
                    for (l, e) in a.coefficients[..a.len].iter().enumerate() {
                        block[at][at + l - k] += s.stiffness * by * c * e;
                    }
                }
            }
        });
        out
    }

    /// Adds the tissue to the dense dynamics with which a controller plans; returns the former blocks of M.
    pub fn add_to(&self, terms: &mut Terms) -> Blocks {
        let mut before = [[[0.0; 3]; 3]; SEGMENT_COUNT];
        for (h, torque) in terms.h[6..].iter_mut().zip(&self.torque) {
            *h -= torque;
        }
        for s in 1..SEGMENT_COUNT {
            let d = 6 + DOF_START[s];
            for k in 0..DOF_LEN[s] {
                for l in 0..DOF_LEN[s] {
                    let m = &mut terms.m[d + k][d + l];
                    before[s][k][l] = *m;
                    *m += self.inertia[s][k][l];
                }
            }
        }
        before
    }

    /// Restores the former blocks of M.
    pub fn restore(before: &Blocks, terms: &mut Terms) {
        for s in 1..SEGMENT_COUNT {
            let d = 6 + DOF_START[s];
            for k in 0..DOF_LEN[s] {
                for l in 0..DOF_LEN[s] {
                    terms.m[d + k][d + l] = before[s][k][l];
                }
            }
        }
    }

    /// Torque along the joint components at their accelerations, N·m.
    pub fn at(&self, acceleration: &[f64]) -> [f64; DOF_COUNT] {
        let mut out = self.torque;
        for s in 1..SEGMENT_COUNT {
            let d = DOF_START[s];
            for k in 0..DOF_LEN[s] {
                for l in 0..DOF_LEN[s] {
                    out[d + k] -= self.inertia[s][k][l] * acceleration[d + l];
                }
            }
        }
        out
    }
}

impl LimitRow {
    /// Rate of the distance to the limit.
    #[inline(always)]
    pub fn rate(&self, x: &[f64]) -> f64 {
        let f = self.first;
        if self.len == 1 {
            self.coefficients[0] * x[f]
        } else {
            self.coefficients[0] * x[f]
                + self.coefficients[1] * x[f + 1]
                + self.coefficients[2] * x[f + 2]
        }
    }
    /// Impulse at that rate, ≥ 0.
    #[inline(always)]
    pub fn impulse(&self, rate: f64) -> f64 {
        self.stiffness * (-self.allowed - rate).max(0.0)
    }
}
