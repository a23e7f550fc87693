//! Zero-moment point, Eq. (3): from the total ground wrench, and in the paper's form from the forces at the ankle.

use crate::math::{Vec3, vec3::vec3};

/// Normal force below which there is no zero-moment point (flight), N.
pub const LEAST_NORMAL_FORCE: f64 = 1e-3;

/// Zero-moment point on the floor z = 0 of a ground wrench: `(−N_y, N_x)/F_z`.
///
/// * `force`: N, `moment`: about the world origin, N·m; both acting on the figure, world axes.
/// * `None` if the ground does not push (`F_z` ≤ 1 mN).
///
/// Equation (3) of the paper.
pub fn zmp(force: Vec3, moment: Vec3) -> Option<Vec3> {
    zmp_above(LEAST_NORMAL_FORCE, force, moment).filter(|z| z.is_finite())
}

/// [`zmp`] for a ground that must push with more than `least`, N. Forces that are not finite give no finite point.
pub fn zmp_above(least: f64, force: Vec3, moment: Vec3) -> Option<Vec3> {
    (force.z > least).then(|| vec3(-moment.y / force.z, moment.x / force.z, 0.0))
}

/// Forces on a supporting foot other than the ground's, and the motion of the foot itself. World axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootLoad {
    /// Ankle, m.
    pub ankle: Vec3,
    /// Force of the shank on the foot f₁, N.
    pub ankle_force: Vec3,
    /// Moment of the shank on the foot n₁, about the ankle, N·m.
    pub ankle_moment: Vec3,
    /// Centre of mass of the foot, m.
    pub com: Vec3,
    /// Mass, kg.
    pub mass: f64,
    /// Acceleration of the centre of mass, m/s² (0 for a foot that holds still).
    pub com_acceleration: Vec3,
    /// Rate of change of the angular momentum about the centre of mass, N·m (0 for a foot that holds still).
    pub spin_rate: Vec3,
}

/// Force and moment about `point` that the ground must exert on one foot, Eq. (3).
///
/// n₀ = n₁ + l₀₁×f₁ + l_g×f_g is the moment that presses on the ground; the ground's reaction is −n₀ plus the foot's
/// own inertial terms, which the paper leaves out because its foot holds still.
///
/// * `gravity`: magnitude, m/s².
pub fn foot_ground_wrench(foot: &FootLoad, point: Vec3, gravity: f64) -> (Vec3, Vec3) {
    let weight = vec3(0.0, 0.0, -gravity * foot.mass);
    let (l01, lg) = (foot.ankle - point, foot.com - point);
    let n0 = foot.ankle_moment + l01.cross(foot.ankle_force) + lg.cross(weight);
    let inertial = foot.com_acceleration * foot.mass;
    (
        inertial - foot.ankle_force - weight,
        foot.spin_rate + lg.cross(inertial) - n0,
    )
}

/// Zero-moment point of one foot from the forces at its ankle, Eq. (3); `None` if the ground does not push.
pub fn foot_zmp(foot: &FootLoad, gravity: f64) -> Option<Vec3> {
    let (force, moment) = foot_ground_wrench(foot, Vec3::zero(), gravity);
    zmp(force, moment)
}
