//! Conversion of a posture to anatomical angles and back.
//!
//! The state of a 3-DOF joint is a quaternion; its three anatomical angles (flexion, abduction or lateral bend,
//! rotation) are derived by swing–twist: `R = swing · twist`, twist about the segment's long axis z, and the swing's
//! rotation vector gives flexion and abduction along the signed axes of the joint. Continuous wherever the swing stays
//! below 180°, which the swing limit of [`SWING_MAX`] guarantees for every reachable posture; equal to the hinge angle
//! for a rotation about a single axis.

use super::model::Body;
use super::state::{Posture, ball_rate_vector};
use super::topology::{
    BALL_COUNT, DOF_AXIS, DOF_COUNT, DOF_LEN, DOF_START, JOINT, Joint, SEGMENT_COUNT,
};
use crate::math::{Quat, Vec3, trig};

/// Largest angle between a segment's long axis and its zero-pose direction, rad (172°): keeps a raised arm off the
/// antipode.
pub const SWING_MAX: f64 = 172.0 / 180.0 * std::f64::consts::PI;

/// Swing and twist of one ball joint.
#[derive(Clone, Copy, Debug)]
pub struct SwingTwist {
    /// Swing rotation vector, rad; z is 0.
    pub swing: Vec3,
    /// Twist about z, rad, −π…π.
    pub twist: f64,
    /// Rows that turn the angular velocity in child axes into the rates of (swing.x, swing.y, twist).
    pub rate_rows: [Vec3; 3],
}

/// Splits `q = swing · twist(z)` and gives the map from angular velocity (child axes) to the rates of the three angles.
pub fn swing_twist(q: Quat) -> SwingTwist {
    let c2 = (q.w * q.w + q.z * q.z).max(1e-24);
    let c = c2.sqrt(); // cos(swing/2) ≥ 0
    let twist = {
        let t = 2.0 * trig::atan2(q.z, q.w);
        let tau = 2.0 * std::f64::consts::PI;
        if t > std::f64::consts::PI {
            t - tau
        } else if t < -std::f64::consts::PI {
            t + tau
        } else {
            t
        }
    };
    // swing quaternion = q · conj(twist), with twist = (0, 0, q.z, q.w)/c.
    let s = Vec3 {
        x: (q.x * q.w - q.y * q.z) / c,
        y: (q.y * q.w + q.x * q.z) / c,
        z: 0.0,
    };
    let n = s.norm();
    let theta = 2.0 * trig::atan2(n, c);
    let k = if n > 1e-9 { theta / n } else { 2.0 };
    let swing = s * k;
    // Twist rate: d/dt 2·atan2(z, w) with q̇ = ½ q ω.
    let twist_row = Vec3 {
        x: (q.z * q.x - q.w * q.y) / c2,
        y: (q.w * q.x + q.z * q.y) / c2,
        z: 1.0,
    };
    // Angular velocity seen in the axes before the twist: ω_swing(child of swing) = Rz(twist) ω − twist rate·z.
    let (st, ct) = (2.0 * q.z * q.w / c2, (q.w * q.w - q.z * q.z) / c2);
    let a = Vec3 {
        x: ct,
        y: -st,
        z: 0.0,
    }; // row giving component x of Rz·ω
    let b = Vec3 {
        x: st,
        y: ct,
        z: 0.0,
    };
    // Swing angle rate = u·ω_s with u = swing axis; perpendicular part turns the axis:
    // rotation-vector rate of a swing = u (u·w) + p (p·w) (θ/2)/tan(θ/2)·(…) with the twist part removed.
    let (ux, uy) = if n > 1e-9 {
        (s.x / n, s.y / n)
    } else {
        (1.0, 0.0)
    };
    let (px, py) = (-uy, ux);
    // For q_s = (sin(θ/2) u, cos(θ/2)) with u ⟂ z, a horizontal body rate w along p (in swing-child axes) turns u by ψ̇
    // about z: horizontal part of the body angular velocity is θ̇ u + sin θ ψ̇ p, so ψ̇ θ = w_p θ / sin θ.
    let g = if theta < 1e-4 {
        1.0 + theta * theta / 6.0
    } else {
        theta / trig::sin_cos(theta).0.max(1e-6)
    };
    let row_u = a * ux + b * uy;
    let row_p = a * px + b * py;
    let rx = row_u * ux + row_p * (px * g);
    let ry = row_u * uy + row_p * (py * g);
    SwingTwist {
        swing,
        twist,
        rate_rows: [rx, ry, twist_row],
    }
}

impl SwingTwist {
    /// The three anatomical angles, rad, of the ball joint whose first DOF is `d`.
    #[inline]
    pub fn angles(&self, d: usize) -> [f64; 3] {
        let value = [self.swing.x, self.swing.y, self.twist];
        std::array::from_fn(|k| {
            let a = DOF_AXIS[d + k];
            f64::from(a.sign) * value[a.axis]
        })
    }
}

/// Ball rotation from swing and twist.
pub fn from_swing_twist(swing_x: f64, swing_y: f64, twist: f64) -> Quat {
    Quat::exp(Vec3 {
        x: swing_x,
        y: swing_y,
        z: 0.0,
    }) * Quat::exp(Vec3 {
        x: 0.0,
        y: 0.0,
        z: twist,
    })
}

/// Swing and twist of each ball joint, by index of its quaternion.
pub type Swings = [SwingTwist; BALL_COUNT];

/// Swings and twists of a posture, from which its angles and their rates are derived.
pub fn swings(posture: &Posture) -> Swings {
    posture.ball.map(swing_twist)
}

/// The 39 anatomical angles of a posture, rad, in DOF order.
pub fn anatomical_angles(posture: &Posture) -> [f64; DOF_COUNT] {
    angles_of(&swings(posture), posture)
}

/// [`anatomical_angles`] for a caller that already has the [`swings`] of the posture.
pub fn angles_of(swings: &Swings, posture: &Posture) -> [f64; DOF_COUNT] {
    let mut out = [0.0; DOF_COUNT];
    for s in 1..SEGMENT_COUNT {
        let d = DOF_START[s];
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => {
                out[d..d + 3].copy_from_slice(&swings[b].angles(d));
            }
            Joint::Hinge2(h) | Joint::Hinge1(h) => {
                out[d..d + DOF_LEN[s]].copy_from_slice(&posture.hinge[h..h + DOF_LEN[s]])
            }
        }
    }
    out
}

/// Sets the joints of `posture` from 39 anatomical angles, rad; the pelvis pose is left alone.
pub fn set_anatomical_angles(posture: &mut Posture, angles: &[f64; DOF_COUNT]) {
    for s in 1..SEGMENT_COUNT {
        let d = DOF_START[s];
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => {
                let v = ball_rate_vector(d, &angles[d..d + 3]);
                posture.ball[b] = from_swing_twist(v.x, v.y, v.z);
            }
            Joint::Hinge2(h) | Joint::Hinge1(h) => {
                posture.hinge[h..h + DOF_LEN[s]].copy_from_slice(&angles[d..d + DOF_LEN[s]])
            }
        }
    }
}

/// Clamps the joints of `posture` into the body's limits (with `margin` rad to spare) and returns by how much each DOF
/// was off, rad.
pub fn clamp_to_limits(body: &Body, posture: &mut Posture, margin: f64) -> [f64; DOF_COUNT] {
    let mut a = anatomical_angles(posture);
    let mut off = [0.0; DOF_COUNT];
    for d in 0..DOF_COUNT {
        let c = a[d].clamp(body.lower[d] + margin, body.upper[d] - margin);
        off[d] = a[d] - c;
        a[d] = c;
    }
    for s in 1..SEGMENT_COUNT {
        if let Joint::Ball(_) = JOINT[s] {
            let d = DOF_START[s];
            let n = (a[d] * a[d] + a[d + 1] * a[d + 1]).sqrt();
            let most = SWING_MAX - margin;
            if n > most {
                for k in 0..2 {
                    let c = a[d + k] * (most / n);
                    off[d + k] += a[d + k] - c;
                    a[d + k] = c;
                }
            }
        }
    }
    if off.iter().any(|o| *o != 0.0) {
        set_anatomical_angles(posture, &a);
    }
    off
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_round_trip_and_rates_match_differences() {
        let mut seed = 1u64;
        let mut rnd = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((seed >> 33) as f64 / 2f64.powi(31)) * 2.0 - 1.0
        };
        for _ in 0..2000 {
            let (x, y, z) = (rnd() * 2.0, rnd() * 2.0, rnd() * 2.5);
            if x.hypot(y) > 2.9 {
                continue;
            }
            let q = from_swing_twist(x, y, z);
            let st = swing_twist(q);
            assert!(
                (st.swing.x - x).abs() < 1e-12
                    && (st.swing.y - y).abs() < 1e-12
                    && (st.twist - z).abs() < 1e-12
            );
            let w = Vec3 {
                x: rnd(),
                y: rnd(),
                z: rnd(),
            };
            let h = 1e-6;
            let (p, m) = (
                swing_twist(q * Quat::exp(w * h)),
                swing_twist(q * Quat::exp(w * -h)),
            );
            let num = [
                (p.swing.x - m.swing.x) / (2.0 * h),
                (p.swing.y - m.swing.y) / (2.0 * h),
                (p.twist - m.twist) / (2.0 * h),
            ];
            for k in 0..3 {
                let ana = st.rate_rows[k].dot(w);
                assert!(
                    (ana - num[k]).abs() < 2e-7 * (1.0 + ana.abs()) * 10.0,
                    "row {k}: {ana} against {}",
                    num[k]
                );
            }
        }
    }
}
