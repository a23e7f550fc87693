//! Jacobians of segments and points, and their bias accelerations `J̇ v`.

use super::kinematics::Kinematics;
use super::rnea::RneaWorkspace;
use crate::body::topology::{DOF_LEN, DOF_START, NV, PARENT, SEGMENT_COUNT};
use crate::math::{Lane, Vec3};

/// Visits the velocity components that move segment `s`, with the angular and the linear velocity that a unit of each
/// gives to the point at `r` (world axes, relative to the pelvis origin).
#[inline(always)]
pub fn for_each_column<L: Lane>(
    kin: &Kinematics<L>,
    s: usize,
    r: Vec3<L>,
    mut visit: impl FnMut(usize, Vec3<L>, Vec3<L>),
) {
    let (o, i) = (L::zero(), L::one());
    let unit = [
        Vec3 { x: i, y: o, z: o },
        Vec3 { x: o, y: i, z: o },
        Vec3 { x: o, y: o, z: i },
    ];
    for k in 0..3 {
        visit(k, unit[k], unit[k].cross(r));
        visit(3 + k, Vec3::zero(), unit[k]);
    }
    let mut a = s;
    while a != 0 {
        let arm = r - kin.position[a];
        for k in 0..DOF_LEN[a] {
            let d = DOF_START[a] + k;
            visit(6 + d, kin.axis[d], kin.axis[d].cross(arm));
        }
        a = PARENT[a];
    }
}

/// Angular acceleration and acceleration of the origin of every segment at `v̇ = 0` and without gravity (`J̇ v`), into
/// `ws`.
#[inline(always)]
pub fn bias_accelerations<L: Lane>(
    kin: &Kinematics<L>,
    velocity: &[L; NV],
    ws: &mut RneaWorkspace<L>,
) {
    ws.alpha[0] = Vec3::zero();
    ws.acceleration[0] = Vec3::zero();
    for s in 1..SEGMENT_COUNT {
        let p = PARENT[s];
        let r = kin.position[s] - kin.position[p];
        let w = kin.omega[p];
        ws.acceleration[s] = ws.acceleration[p] + ws.alpha[p].cross(r) + w.cross(w.cross(r));
        ws.alpha[s] = ws.alpha[p] + kin.joint_bias(s, velocity);
    }
}
