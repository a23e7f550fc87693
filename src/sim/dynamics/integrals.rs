//! Whole-body integrals: centre of mass, momentum, energy.

use super::kinematics::Kinematics;
use crate::body::Links;
use crate::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::math::{Lane, Vec3};

/// Centre of mass minus pelvis origin (m, world axes) and total mass (kg). Needs [`Kinematics::set_posture`].
#[inline(always)]
pub fn center_of_mass<L: Lane>(links: &Links<L>, kin: &Kinematics<L>) -> (Vec3<L>, L) {
    let mut h = Vec3::zero();
    let mut m = L::zero();
    for s in 0..SEGMENT_COUNT {
        h += kin.moment[s] + kin.position[s] * links.mass[s];
        m += links.mass[s];
    }
    (h * (L::one() / m), m)
}

/// Momentum of the whole body, world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momentum<L = f64> {
    /// Linear momentum, kg·m/s.
    pub linear: Vec3<L>,
    /// Angular momentum about the centre of mass, kg·m²/s.
    pub angular: Vec3<L>,
}

/// Linear and centroidal angular momentum. Needs [`Kinematics::set_state`].
#[inline(always)]
pub fn momentum<L: Lane>(links: &Links<L>, kin: &Kinematics<L>) -> Momentum<L> {
    let (com, _) = center_of_mass(links, kin);
    let mut linear = Vec3::zero();
    let mut angular = Vec3::zero(); // about the pelvis origin first
    for s in 0..SEGMENT_COUNT {
        let (w, v, h) = (kin.omega[s], kin.velocity[s], kin.moment[s]);
        let p = v * links.mass[s] + w.cross(h);
        linear += p;
        angular += kin.inertia[s] * w + h.cross(v) + kin.position[s].cross(p);
    }
    Momentum {
        linear,
        angular: angular - com.cross(linear),
    }
}

/// Kinetic energy of the rotors (armature) at `velocity`, J.
#[inline(always)]
pub fn rotor_energy<L: Lane>(links: &Links<L>, velocity: &[L; NV]) -> L {
    let mut e = L::zero();
    for d in 0..DOF_COUNT {
        e += links.armature[d] * velocity[6 + d] * velocity[6 + d];
    }
    e * L::splat(0.5)
}

/// Kinetic energy, J, without armature. Needs [`Kinematics::set_state`].
#[inline(always)]
pub fn kinetic_energy<L: Lane>(links: &Links<L>, kin: &Kinematics<L>) -> L {
    let mut e = L::zero();
    for s in 0..SEGMENT_COUNT {
        let (w, v, h) = (kin.omega[s], kin.velocity[s], kin.moment[s]);
        let p = v * links.mass[s] + w.cross(h);
        e += p.dot(v) + (kin.inertia[s] * w + h.cross(v)).dot(w);
    }
    e * L::splat(0.5)
}
