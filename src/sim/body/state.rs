//! Positions and velocities of one figure, or of eight figures in lanes.

use super::topology::{
    BALL_COUNT, DOF_AXIS, DOF_COUNT, DOF_LEN, DOF_START, HINGE_COUNT, JOINT, Joint, NV,
    SEGMENT_COUNT,
};
use crate::math::{Lane, Quat, Vec3};
use serde::{Deserialize, Serialize};

/// Position of every segment: pelvis pose and joint positions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Posture<L = f64> {
    /// Pelvis origin (midpoint of the hip centres), world, m.
    pub root_position: Vec3<L>,
    /// `world_from_pelvis`.
    pub root_rotation: Quat<L>,
    /// `parent_from_child` of the ball joints, in the order of [`Joint::Ball`] indices.
    pub ball: [Quat<L>; BALL_COUNT],
    /// Hinge angles, rad, anatomically signed, in the order of the hinge indices.
    pub hinge: [L; HINGE_COUNT],
}

impl<L: Lane> Default for Posture<L> {
    /// The zero pose at the world origin: upright, arms hanging, palms to the thighs.
    fn default() -> Self {
        Self {
            root_position: Vec3::zero(),
            root_rotation: Quat::identity(),
            ball: [Quat::identity(); BALL_COUNT],
            hinge: [L::zero(); HINGE_COUNT],
        }
    }
}

/// Positions and velocities.
///
/// `velocity` is angular first: pelvis angular velocity (rad/s) and velocity of the pelvis origin (m/s), both in world
/// axes, then the 39 joint rates (rad/s).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct State<L = f64> {
    /// Positions.
    pub posture: Posture<L>,
    /// Velocities, 45 components.
    #[serde(with = "crate::saved::array")]
    pub velocity: [L; NV],
}

impl<L: Lane> Default for State<L> {
    fn default() -> Self {
        Self {
            posture: Posture::default(),
            velocity: [L::zero(); NV],
        }
    }
}

/// Angular velocity in child axes from the three rates of a ball joint whose first DOF is `start`.
#[inline(always)]
pub fn ball_rate_vector<L: Lane>(start: usize, rates: &[L]) -> Vec3<L> {
    let mut w = [L::zero(); 3];
    for k in 0..3 {
        let a = DOF_AXIS[start + k];
        w[a.axis] = if a.sign > 0 { rates[k] } else { -rates[k] };
    }
    Vec3 {
        x: w[0],
        y: w[1],
        z: w[2],
    }
}

/// The three rates of a ball joint from a vector in child axes; inverse of [`ball_rate_vector`].
#[inline(always)]
pub fn ball_rates<L: Lane>(start: usize, w: Vec3<L>) -> [L; 3] {
    let w = [w.x, w.y, w.z];
    std::array::from_fn(|k| {
        let a = DOF_AXIS[start + k];
        if a.sign > 0 { w[a.axis] } else { -w[a.axis] }
    })
}

impl<L: Lane> Posture<L> {
    /// The posture reached by moving at constant `velocity` for `dt` seconds: `q ⊕ dt·v`.
    #[inline(always)]
    pub fn integrate(&mut self, velocity: &[L; NV], dt: L) {
        let v = velocity;
        let w = Vec3 {
            x: v[0],
            y: v[1],
            z: v[2],
        };
        self.root_rotation = (Quat::exp(w * dt) * self.root_rotation).normalized();
        self.root_position += Vec3 {
            x: v[3],
            y: v[4],
            z: v[5],
        } * dt;
        for s in 1..SEGMENT_COUNT {
            let d = DOF_START[s];
            match JOINT[s] {
                Joint::Free => {}
                Joint::Ball(b) => {
                    let w = ball_rate_vector(d, &v[6 + d..6 + d + 3]);
                    self.ball[b] = (self.ball[b] * Quat::exp(w * dt)).normalized();
                }
                Joint::Hinge2(h) | Joint::Hinge1(h) => {
                    for k in 0..DOF_LEN[s] {
                        self.hinge[h + k] += v[6 + d + k] * dt;
                    }
                }
            }
        }
    }

    /// Joint difference `to ⊖ self` in DOF order (rad): `log(R⁻¹ R_to)` along the signed child axes for ball joints.
    #[inline(always)]
    pub fn joint_difference(&self, to: &Self) -> [L; DOF_COUNT] {
        let mut e = [L::zero(); DOF_COUNT];
        for s in 1..SEGMENT_COUNT {
            let d = DOF_START[s];
            match JOINT[s] {
                Joint::Free => {}
                Joint::Ball(b) => {
                    let r = ball_rates(d, (self.ball[b].conjugate() * to.ball[b]).log());
                    e[d..d + 3].copy_from_slice(&r);
                }
                Joint::Hinge2(h) | Joint::Hinge1(h) => {
                    for k in 0..DOF_LEN[s] {
                        e[d + k] = to.hinge[h + k] - self.hinge[h + k];
                    }
                }
            }
        }
        e
    }

    /// Full difference `to ⊖ self`: rotation vector (world axes) and translation of the pelvis, then
    /// [`Self::joint_difference`].
    #[inline(always)]
    pub fn difference(&self, to: &Self) -> [L; NV] {
        let mut e = [L::zero(); NV];
        let r = (to.root_rotation * self.root_rotation.conjugate()).log();
        let p = to.root_position - self.root_position;
        (e[0], e[1], e[2], e[3], e[4], e[5]) = (r.x, r.y, r.z, p.x, p.y, p.z);
        e[6..].copy_from_slice(&self.joint_difference(to));
        e
    }
}

impl Posture<f64> {
    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.root_position.is_finite()
            && self.root_rotation.is_finite()
            && self.ball.iter().all(|q| q.is_finite())
            && self.hinge.iter().all(|a| a.is_finite())
    }

    /// Whether every number is finite and every quaternion is a rotation.
    pub fn is_valid(&self) -> bool {
        let unit = |q: &Quat| {
            let square: f64 = q.to_xyzw().iter().map(|x| x * x).sum();
            (0.999..=1.001).contains(&square)
        };
        self.is_finite() && unit(&self.root_rotation) && self.ball.iter().all(unit)
    }
}

impl State<f64> {
    /// At rest in `posture`.
    pub fn at_rest(posture: Posture) -> Self {
        Self {
            posture,
            ..Self::default()
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.posture.is_finite() && self.velocity.iter().all(|v| v.is_finite())
    }

    /// Whether every number is finite and every quaternion is a rotation.
    pub fn is_valid(&self) -> bool {
        self.posture.is_valid() && self.velocity.iter().all(|v| v.is_finite())
    }

    /// Scales all velocities by one factor, so that kinetic energy can only fall, until none exceeds `fastest` (rad/s,
    /// m/s). Returns whether any did.
    pub fn brake(&mut self, fastest: f64) -> bool {
        let most = self.velocity.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if most > fastest {
            for v in &mut self.velocity {
                *v *= fastest / most;
            }
        }
        most > fastest
    }
}

impl<L: Lane> State<L> {
    /// State of lane `k`.
    pub fn lane(&self, k: usize) -> State<f64> {
        State {
            posture: Posture {
                root_position: self.posture.root_position.lane(k),
                root_rotation: self.posture.root_rotation.lane(k),
                ball: std::array::from_fn(|b| self.posture.ball[b].lane(k)),
                hinge: std::array::from_fn(|h| self.posture.hinge[h].lane(k)),
            },
            velocity: std::array::from_fn(|i| self.velocity[i].lane(k)),
        }
    }
    /// Replaces the state of lane `k`.
    pub fn set_lane(&mut self, k: usize, s: &State<f64>) {
        self.posture
            .root_position
            .set_lane(k, s.posture.root_position);
        self.posture
            .root_rotation
            .set_lane(k, s.posture.root_rotation);
        for b in 0..BALL_COUNT {
            self.posture.ball[b].set_lane(k, s.posture.ball[b]);
        }
        for h in 0..HINGE_COUNT {
            self.posture.hinge[h].set_lane(k, s.posture.hinge[h]);
        }
        for i in 0..NV {
            self.velocity[i].set_lane(k, s.velocity[i]);
        }
    }
}
