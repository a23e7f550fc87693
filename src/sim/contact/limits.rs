//! Joint limits as unilateral rows: anatomical angles stay in their range, a raised arm stays off the antipode.

use crate::sim::body::angles::{SWING_MAX, swing_twist};
use crate::sim::body::topology::{DOF_AXIS, DOF_COUNT, DOF_START, JOINT, Joint, SEGMENT_COUNT};
use crate::sim::body::{Body, Posture};
use crate::sim::math::Vec3;

/// Stiffness of a limit row, kg·m²: an impulse per rad/s that is still missing (ALGORITHM §14.3).
pub const LIMIT_STIFFNESS: f64 = 1e3;
/// Share of a limit violation that is taken back per substep.
const RETURN_SHARE: f64 = 0.2;
/// Fastest return into the range, rad/s: a joint far outside is led back, not shot back.
const RETURN_SPEED: f64 = 3.0;

/// One limit: the distance to it changes at `rate = coefficients · x[first..first + 3]` and must not become negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LimitRow {
    /// First velocity component it acts on.
    pub first: usize,
    /// How many components (1 or 3).
    pub len: usize,
    /// Coefficients of the rate of the distance.
    pub coefficients: [f64; 3],
    /// The row pushes where `rate < −allowed`: distance per substep, rad/s.
    pub allowed: f64,
}

/// The limit rows of one posture: the nearer limit of every DOF and the swing limit of every ball joint.
#[derive(Clone, Debug, Default)]
pub struct LimitRows {
    /// Rows.
    pub rows: Vec<LimitRow>,
}

impl LimitRows {
    /// No rows, with room for all.
    pub fn new() -> Self {
        Self {
            rows: Vec::with_capacity(DOF_COUNT + 9),
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

/// Fills the rows for a substep of `h` seconds from `posture`. Also returns the anatomical angles, which cost nothing extra here.
pub fn collect_limits(
    body: &Body,
    posture: &Posture,
    h: f64,
    out: &mut LimitRows,
) -> [f64; DOF_COUNT] {
    out.rows.clear();
    let mut angles = [0.0; DOF_COUNT];
    for s in 1..SEGMENT_COUNT {
        let d = DOF_START[s];
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => {
                let st = swing_twist(posture.ball[b]);
                for (k, angle) in st.angles(d).into_iter().enumerate() {
                    let a = DOF_AXIS[d + k];
                    angles[d + k] = angle;
                    push_ball(
                        out,
                        d,
                        st.rate_rows[a.axis] * f64::from(a.sign),
                        angle - body.lower[d + k],
                        body.upper[d + k] - angle,
                        h,
                    );
                }
                let n = st.swing.norm();
                if n > 0.5 * SWING_MAX {
                    let u = st.swing * (1.0 / n);
                    let row = st.rate_rows[0] * u.x + st.rate_rows[1] * u.y;
                    push_ball(out, d, row, f64::INFINITY, SWING_MAX - n, h);
                }
            }
            Joint::Hinge2(i) => {
                for k in 0..2 {
                    angles[d + k] = posture.hinge[i + k];
                    push_hinge(body, out, d + k, posture.hinge[i + k], h);
                }
            }
            Joint::Hinge1(i) => {
                angles[d] = posture.hinge[i];
                push_hinge(body, out, d, posture.hinge[i], h);
            }
        }
    }
    angles
}

/// `row` gives the angle's rate from the angular velocity in child axes; the nearer side is kept.
fn push_ball(out: &mut LimitRows, d: usize, row: Vec3, above: f64, below: f64, h: f64) {
    let axes = [row.x, row.y, row.z];
    let (sign, distance) = if above < below {
        (1.0, above)
    } else {
        (-1.0, below)
    };
    let coefficients = std::array::from_fn(|k| {
        let a = DOF_AXIS[d + k];
        sign * f64::from(a.sign) * axes[a.axis]
    });
    out.rows.push(LimitRow {
        first: 6 + d,
        len: 3,
        coefficients,
        allowed: allowed(distance, h),
    });
}

fn push_hinge(body: &Body, out: &mut LimitRows, d: usize, angle: f64, h: f64) {
    let (above, below) = (angle - body.lower[d], body.upper[d] - angle);
    let (sign, distance) = if above < below {
        (1.0, above)
    } else {
        (-1.0, below)
    };
    out.rows.push(LimitRow {
        first: 6 + d,
        len: 1,
        coefficients: [sign, 0.0, 0.0],
        allowed: allowed(distance, h),
    });
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
        LIMIT_STIFFNESS * (-self.allowed - rate).max(0.0)
    }
}
