//! The effort of two arms to hold a load still in a posture, as shares of their strength, and the best way to share it.

use crate::body::angles::anatomical_angles;
use crate::body::topology::{DOF_COUNT, DOF_SEGMENT, DOF_START};
use crate::body::{Posture, SegmentId};
use crate::dynamics::Kinematics;
use crate::figure::loads::second_hand::sight::Sight;
use crate::figure::params::second_hand::LARGEST_SHARE;
use crate::math::Vec3;
use crate::motion::arm_ik::ARMS;
use crate::setup::HeldLoad;

/// Degrees of freedom from the shoulder to the wrist; they are consecutive.
const ARM_DOFS: usize = 7;

/// Torques of the joints of one arm, N·m.
#[derive(Clone, Copy, Debug)]
struct LoadedArm {
    /// To hold the arm itself and anything else that it carries.
    own: [f64; ARM_DOFS],
    /// In addition, for each kilogram of the load.
    per_kg: [f64; ARM_DOFS],
    lower: [f64; ARM_DOFS],
    upper: [f64; ARM_DOFS],
}

impl LoadedArm {
    /// Share of its strength that the hardest-working joint needs with a load of `mass` kg.
    fn need(&self, mass: f64) -> f64 {
        (0..ARM_DOFS).fold(0.0, |most, k| {
            let torque = self.own[k] + mass * self.per_kg[k];
            let limit = if torque > 0.0 {
                self.upper[k]
            } else {
                self.lower[k]
            };
            f64::max(most, torque / limit)
        })
    }

    /// Σ (a/R)² and Σ a b/R², where a is the torque per kilogram, b the torque with `mass` kg and the arm's own, and R
    /// the strength in the direction in which the load acts.
    fn squares(&self, mass: f64) -> (f64, f64) {
        (0..ARM_DOFS).fold((0.0, 0.0), |(square, product), k| {
            let a = self.per_kg[k];
            let r = if a > 0.0 {
                self.upper[k]
            } else {
                self.lower[k]
            };
            let b = self.own[k] + mass * a;
            (square + a * a / (r * r), product + a * b / (r * r))
        })
    }
}

/// The needs of both arms for a load.
pub(super) struct Efforts {
    carrying: LoadedArm,
    other: LoadedArm,
    mass: f64,
}

/// A load in two hands.
#[derive(Clone, Copy)]
pub(super) struct Grasp<'a> {
    /// The load.
    pub load: &'a HeldLoad,
    /// Point of the other hand that holds it, segment frame, m.
    pub point: Vec3,
    /// Mass that the carrying and the other hand hold now, kg.
    pub masses: [f64; 2],
}

impl Efforts {
    /// For a posture in which both hands are at the load.
    ///
    /// * `other`: index in [`ARMS`] of the arm that helps.
    /// * `hold`: how the two hands hold the load.
    pub fn new(see: &Sight<'_>, posture: &Posture, other: usize, hold: &Grasp<'_>) -> Self {
        let Grasp {
            load,
            point,
            masses: held,
        } = *hold;
        let mut kin = Kinematics::default();
        kin.set_posture(see.links, posture);
        let angles = anatomical_angles(posture);
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        let still = [0.0; DOF_COUNT];
        (see.strength).range(&angles, &still, see.muscles, &mut lower, &mut upper);
        let arm = |index: usize, point: Vec3, held: f64| {
            let segments = ARMS[index];
            let first = DOF_START[segments[0].index()];
            let hand = segments[2].index();
            let at = kin.position[hand] + kin.rotation[hand] * point;
            // Torque that holds a first moment of mass (kg·m about the joint) against gravity.
            let torque = |d: usize, moment: Vec3| see.gravity * kin.axis[d].cross(moment).z;
            let per_kg: [f64; ARM_DOFS] = std::array::from_fn(|k| {
                let d = first + k;
                torque(d, at - kin.position[DOF_SEGMENT[d]])
            });
            LoadedArm {
                own: std::array::from_fn(|k| {
                    let d = first + k;
                    let joint = DOF_SEGMENT[d];
                    let beyond = segments.map(SegmentId::index);
                    let beyond = beyond.into_iter().filter(|s| *s >= joint);
                    let moment = beyond.fold(Vec3::zero(), |sum, s| {
                        let arm = kin.position[s] - kin.position[joint];
                        sum + arm * see.links.mass[s] + kin.moment[s]
                    });
                    torque(d, moment) - held * per_kg[k]
                }),
                per_kg,
                lower: std::array::from_fn(|k| lower[first + k]),
                upper: std::array::from_fn(|k| upper[first + k]),
            }
        };
        Self {
            carrying: arm(1 - other, load.point, held[0]),
            other: arm(other, point, held[1]),
            mass: load.mass,
        }
    }

    /// Share of its strength that the carrying arm needs alone.
    pub fn alone(&self) -> f64 {
        self.carrying.need(self.mass)
    }

    /// Share of its strength that the harder-working arm needs when the other takes `share` of the load.
    pub fn together(&self, share: f64) -> f64 {
        let other = share * self.mass;
        let carrying = self.carrying.need(self.mass - other);
        carrying.max(self.other.need(other))
    }

    /// The share of the other arm that minimizes the sum of squares of torque over strength, over the joints of both
    /// arms: a convex problem with one unknown.
    pub fn best_share(&self) -> f64 {
        let (a, b) = self.carrying.squares(self.mass);
        let (c, d) = self.other.squares(0.0);
        let most = a + c;
        if self.mass > 0.0 && most > 0.0 {
            ((b - d) / most / self.mass).clamp(0.0, LARGEST_SHARE)
        } else {
            0.0
        }
    }
}
