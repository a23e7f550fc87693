//! Joint-space inertia matrix (composite rigid body algorithm).

use super::kinematics::Kinematics;
use super::mass_matrix::{DEPTH, MassMatrix};
use crate::body::Links;
use crate::body::topology::{DOF_LEN, DOF_START, PARENT, SEGMENT_COUNT};
use crate::math::{Lane, Sym3, Vec3};

/// Mass, first moment and inertia of each subtree about the pelvis origin, world axes.
#[derive(Clone, Debug)]
pub struct CompositeInertia<L = f64> {
    /// Mass, kg.
    pub mass: [L; SEGMENT_COUNT],
    /// First moment of mass about the pelvis origin, kg·m.
    pub moment: [Vec3<L>; SEGMENT_COUNT],
    /// Inertia about the pelvis origin, kg·m².
    pub inertia: [Sym3<L>; SEGMENT_COUNT],
}

impl<L: Lane> Default for CompositeInertia<L> {
    fn default() -> Self {
        Self {
            mass: [L::zero(); SEGMENT_COUNT],
            moment: [Vec3::zero(); SEGMENT_COUNT],
            inertia: [Sym3::zero(); SEGMENT_COUNT],
        }
    }
}

/// Inertia about a point displaced by `p` from the one that `inertia` and `moment` refer to.
#[inline(always)]
fn shifted<L: Lane>(mass: L, moment: Vec3<L>, inertia: Sym3<L>, p: Vec3<L>) -> Sym3<L> {
    let two = L::splat(2.0);
    let cross = Sym3 {
        xx: two * (p.y * moment.y + p.z * moment.z),
        yy: two * (p.x * moment.x + p.z * moment.z),
        zz: two * (p.x * moment.x + p.y * moment.y),
        xy: -(p.x * moment.y + moment.x * p.y),
        xz: -(p.x * moment.z + moment.x * p.z),
        yz: -(p.y * moment.z + moment.y * p.z),
    };
    inertia + Sym3::point_mass(mass, p) + cross
}

/// Inertia matrix M(q), armature included, and the composite inertias from which it is built.
///
/// Featherstone 2008, §6.2, with every segment seen from the pelvis origin in world axes, so that composites simply
/// add. Needs [`Kinematics::set_posture`]. O(n·depth), no allocation.
#[inline(always)]
pub fn crba<L: Lane>(
    links: &Links<L>,
    kin: &Kinematics<L>,
    ci: &mut CompositeInertia<L>,
    m: &mut MassMatrix<L>,
) {
    for s in 0..SEGMENT_COUNT {
        let p = kin.position[s];
        ci.mass[s] = links.mass[s];
        ci.moment[s] = kin.moment[s] + p * links.mass[s];
        ci.inertia[s] = shifted(links.mass[s], kin.moment[s], kin.inertia[s], p);
    }
    for s in (1..SEGMENT_COUNT).rev() {
        let p = PARENT[s];
        let (ms, hs, is) = (ci.mass[s], ci.moment[s], ci.inertia[s]);
        ci.mass[p] += ms;
        ci.moment[p] += hs;
        ci.inertia[p] += is;
    }
    for s in 1..SEGMENT_COUNT {
        for k in 0..DOF_LEN[s] {
            let i = 6 + DOF_START[s] + k;
            let a = kin.axis[i - 6];
            let v = kin.position[s].cross(a); // velocity at the pelvis origin of a unit turn about the axis
            let n = ci.inertia[s] * a + ci.moment[s].cross(v);
            let f = v * ci.mass[s] + a.cross(ci.moment[s]);
            let row = &mut m.rows[i];
            (row[0], row[1], row[2]) = (n.x, n.y, n.z);
            (row[3], row[4], row[5]) = (f.x, f.y, f.z);
            // Every DOF on the path to the pelvis, including this segment's own earlier DOFs.
            let mut anc = s;
            while anc != 0 {
                let d = DOF_START[anc];
                let last = if anc == s { k + 1 } else { DOF_LEN[anc] };
                let about = n - kin.position[anc].cross(f); // moment about that joint
                for j in 0..last {
                    row[DEPTH[6 + d + j]] = kin.axis[d + j].dot(about);
                }
                anc = PARENT[anc];
            }
            row[DEPTH[i]] += links.armature[i - 6];
        }
    }
    let (mass, h, i) = (ci.mass[0], ci.moment[0], ci.inertia[0]);
    let z = L::zero();
    m.rows[0][0] = i.xx;
    (m.rows[1][0], m.rows[1][1]) = (i.xy, i.yy);
    (m.rows[2][0], m.rows[2][1], m.rows[2][2]) = (i.xz, i.yz, i.zz);
    // Unit linear velocity e: momentum m·e, moment h × e.
    (m.rows[3][0], m.rows[3][1], m.rows[3][2], m.rows[3][3]) = (z, h.z, -h.y, mass);
    (m.rows[4][0], m.rows[4][1], m.rows[4][2]) = (-h.z, z, h.x);
    (m.rows[4][3], m.rows[4][4]) = (z, mass);
    (m.rows[5][0], m.rows[5][1], m.rows[5][2]) = (h.y, -h.x, z);
    (m.rows[5][3], m.rows[5][4], m.rows[5][5]) = (z, z, mass);
}
