//! Forward dynamics in O(n): the articulated-body algorithm. Independent of CRBA and the factor; they check each other.

use super::kinematics::Kinematics;
use super::rnea::{External, ExternalForces};
use crate::body::Links;
use crate::body::topology::{
    DOF_COUNT, DOF_LEN, DOF_START, JOINT, Joint, NV, PARENT, SEGMENT_COUNT,
};
use crate::math::{Lane, Vec3};

/// A 6-vector, angular part first; motion or force.
#[derive(Clone, Copy, Debug)]
struct Spatial<L> {
    a: Vec3<L>,
    l: Vec3<L>,
}

impl<L: Lane> Spatial<L> {
    #[inline(always)]
    fn zero() -> Self {
        Self {
            a: Vec3::zero(),
            l: Vec3::zero(),
        }
    }
    #[inline(always)]
    fn plus(self, b: Self) -> Self {
        Self {
            a: self.a + b.a,
            l: self.l + b.l,
        }
    }
    #[inline(always)]
    fn scaled(self, s: L) -> Self {
        Self {
            a: self.a * s,
            l: self.l * s,
        }
    }
    #[inline(always)]
    fn dot(self, b: Self) -> L {
        self.a.dot(b.a) + self.l.dot(b.l)
    }
    /// Motion cross motion.
    #[inline(always)]
    fn cross_motion(self, m: Self) -> Self {
        Self {
            a: self.a.cross(m.a),
            l: self.a.cross(m.l) + self.l.cross(m.a),
        }
    }
    /// Motion cross force.
    #[inline(always)]
    fn cross_force(self, f: Self) -> Self {
        Self {
            a: self.a.cross(f.a) + self.l.cross(f.l),
            l: self.a.cross(f.l),
        }
    }
    #[inline(always)]
    fn get(self, i: usize) -> L {
        match i {
            0 => self.a.x,
            1 => self.a.y,
            2 => self.a.z,
            3 => self.l.x,
            4 => self.l.y,
            _ => self.l.z,
        }
    }
    #[inline(always)]
    fn from_array(v: [L; 6]) -> Self {
        Self {
            a: Vec3 {
                x: v[0],
                y: v[1],
                z: v[2],
            },
            l: Vec3 {
                x: v[3],
                y: v[4],
                z: v[5],
            },
        }
    }
}

/// Articulated inertias and bias forces; 6×6 symmetric matrices are stored in full.
#[derive(Clone, Debug)]
pub struct AbaWorkspace<L = f64> {
    inertia: [[[L; 6]; 6]; SEGMENT_COUNT],
    bias: [Spatial<L>; SEGMENT_COUNT],
    twist: [Spatial<L>; SEGMENT_COUNT],
    drift: [Spatial<L>; SEGMENT_COUNT],
    u: [Spatial<L>; DOF_COUNT],
    d: [L; DOF_COUNT],
    rhs: [L; DOF_COUNT],
    axis: [Spatial<L>; DOF_COUNT],
}

impl<L: Lane> Default for AbaWorkspace<L> {
    fn default() -> Self {
        let z = Spatial::zero();
        Self {
            inertia: [[[L::zero(); 6]; 6]; SEGMENT_COUNT],
            bias: [z; SEGMENT_COUNT],
            twist: [z; SEGMENT_COUNT],
            drift: [z; SEGMENT_COUNT],
            u: [z; DOF_COUNT],
            d: [L::zero(); DOF_COUNT],
            rhs: [L::zero(); DOF_COUNT],
            axis: [z; DOF_COUNT],
        }
    }
}

#[inline(always)]
fn mul<L: Lane>(m: &[[L; 6]; 6], v: Spatial<L>) -> Spatial<L> {
    let mut out = [L::zero(); 6];
    for (o, row) in out.iter_mut().zip(m) {
        *o = Spatial::from_array(*row).dot(v);
    }
    Spatial::from_array(out)
}

/// Acceleration `vdot` under generalised forces `tau` (layout of `State::velocity`; the first six act on the pelvis).
///
/// Featherstone 2008, §7.3, all bodies in world axes about the pelvis origin. The DOFs of one joint are eliminated one
/// after the other, which is Gaussian elimination of the joint's block. Arguments as in [`rnea`](super::rnea::rnea).
/// O(n), no allocation.
#[inline(always)]
pub fn aba<L: Lane>(
    links: &Links<L>,
    kin: &Kinematics<L>,
    velocity: &[L; NV],
    tau: &[L; NV],
    external: ExternalForces<'_, L>,
    ws: &mut AbaWorkspace<L>,
    vdot: &mut [L; NV],
) {
    set_bodies(links, kin, external.on_segments, ws);
    eliminate_joints(links, kin, velocity, tau, ws);
    let root = solve_root(
        &ws.inertia[0],
        std::array::from_fn(|i| tau[i] - ws.bias[0].get(i)),
    );
    let mut acc = [Spatial::zero(); SEGMENT_COUNT];
    acc[0] = root; // spatial acceleration minus gravity
    // Back from spatial to classical acceleration of the pelvis origin.
    let classical = root.l + kin.omega[0].cross(kin.velocity[0]);
    (vdot[0], vdot[1], vdot[2]) = (root.a.x, root.a.y, root.a.z);
    (vdot[3], vdot[4], vdot[5]) = (classical.x, classical.y, classical.z - external.gravity);
    for s in 1..SEGMENT_COUNT {
        let (p, d0) = (PARENT[s], DOF_START[s]);
        let mut a = acc[p].plus(ws.drift[s]);
        for k in 0..DOF_LEN[s] {
            let d = d0 + k;
            let qdd = (ws.rhs[d] - ws.u[d].dot(a)) * ws.d[d];
            vdot[6 + d] = qdd;
            a = a.plus(ws.axis[d].scaled(qdd));
        }
        acc[s] = a;
    }
}

/// Inertia, twist and bias force of every segment by itself, about the pelvis origin.
#[inline(always)]
fn set_bodies<L: Lane>(
    links: &Links<L>,
    kin: &Kinematics<L>,
    external: &[External<L>],
    ws: &mut AbaWorkspace<L>,
) {
    for s in 0..SEGMENT_COUNT {
        let (p, m, h) = (kin.position[s], links.mass[s], kin.moment[s]);
        let first = h + p * m;
        // Rotational inertia about the pelvis origin: columns from its action on unit vectors.
        let w = kin.omega[s];
        let twist = Spatial {
            a: w,
            l: kin.velocity[s] + w.cross(-p),
        };
        let about = |a: Vec3<L>| {
            // Angular momentum about the pelvis origin of a unit turn `a` about an axis through it.
            let v = a.cross(p);
            let lin = v * m + a.cross(h);
            kin.inertia[s] * a + h.cross(v) + p.cross(lin)
        };
        let (o, i) = (L::zero(), L::one());
        let unit = [
            Vec3 { x: i, y: o, z: o },
            Vec3 { x: o, y: i, z: o },
            Vec3 { x: o, y: o, z: i },
        ];
        let mat = &mut ws.inertia[s];
        for c in 0..3 {
            let n = about(unit[c]);
            let f = unit[c].cross(first);
            let nl = first.cross(unit[c]);
            for (r, (nr, fr)) in [(n.x, f.x), (n.y, f.y), (n.z, f.z)].into_iter().enumerate() {
                mat[r][c] = nr;
                mat[3 + r][c] = fr;
            }
            for (r, x) in [nl.x, nl.y, nl.z].into_iter().enumerate() {
                mat[r][3 + c] = x;
                mat[3 + r][3 + c] = if r == c { m } else { o };
            }
        }
        let momentum = mul(mat, twist);
        let mut b = twist.cross_force(momentum);
        if let Some(e) = external.get(s) {
            b.a -= e.moment + p.cross(e.force);
            b.l -= e.force;
        }
        ws.twist[s] = twist;
        ws.bias[s] = b;
    }
}

/// From the tips to the root: eliminates the DOFs of each joint and adds the remaining inertia and force of the segment
/// to its parent.
#[inline(always)]
fn eliminate_joints<L: Lane>(
    links: &Links<L>,
    kin: &Kinematics<L>,
    velocity: &[L; NV],
    tau: &[L; NV],
    ws: &mut AbaWorkspace<L>,
) {
    for s in (1..SEGMENT_COUNT).rev() {
        let (p, d0, n) = (PARENT[s], DOF_START[s], DOF_LEN[s]);
        for k in 0..n {
            let a = kin.axis[d0 + k];
            ws.axis[d0 + k] = Spatial {
                a,
                l: kin.position[s].cross(a),
            };
        }
        let rate = |k: usize| ws.axis[d0 + k].scaled(velocity[6 + d0 + k]);
        let drift = match JOINT[s] {
            Joint::Hinge2(_) => ws.twist[p]
                .cross_motion(rate(0))
                .plus(ws.twist[s].cross_motion(rate(1))),
            Joint::Ball(_) => ws.twist[s].cross_motion(rate(0).plus(rate(1)).plus(rate(2))),
            _ => ws.twist[s].cross_motion(rate(0)),
        };
        ws.drift[s] = drift;
        let mut ia = ws.inertia[s];
        let mut pa = ws.bias[s];
        for k in (0..n).rev() {
            let d = d0 + k;
            let u = mul(&ia, ws.axis[d]);
            let den = ws.axis[d].dot(u) + links.armature[d];
            let inv = L::one() / den;
            let rhs = tau[6 + d] - ws.axis[d].dot(pa);
            for r in 0..6 {
                let ur = u.get(r) * inv;
                for c in 0..6 {
                    ia[r][c] -= ur * u.get(c);
                }
            }
            pa = pa.plus(u.scaled(rhs * inv));
            (ws.u[d], ws.d[d], ws.rhs[d]) = (u, inv, rhs);
        }
        pa = pa.plus(mul(&ia, drift));
        for r in 0..6 {
            for c in 0..6 {
                let x = ia[r][c];
                ws.inertia[p][r][c] += x;
            }
        }
        ws.bias[p] = ws.bias[p].plus(pa);
    }
}

/// Acceleration `inertia⁻¹ x` of the root, by Cholesky of the 6×6.
#[inline(always)]
fn solve_root<L: Lane>(inertia: &[[L; 6]; 6], mut x: [L; 6]) -> Spatial<L> {
    let mut l = *inertia;
    for j in 0..6 {
        for k in 0..j {
            let y = l[j][k];
            for i in j..6 {
                let z = l[i][k];
                l[i][j] -= z * y;
            }
        }
        let inv = L::one() / l[j][j].sqrt();
        for i in j..6 {
            l[i][j] *= inv;
        }
    }
    for i in 0..6 {
        for k in 0..i {
            let y = x[k];
            x[i] -= l[i][k] * y;
        }
        x[i] = x[i] / l[i][i];
    }
    for i in (0..6).rev() {
        for k in i + 1..6 {
            let y = x[k];
            x[i] -= l[k][i] * y;
        }
        x[i] = x[i] / l[i][i];
    }
    Spatial::from_array(x)
}
