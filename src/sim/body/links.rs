//! The numbers of a body that the kernels read, for one figure or for eight figures in lanes.

use super::model::Body;
use super::topology::{DOF_COUNT, SEGMENT_COUNT, SegmentId};
use crate::math::{Lane, Sym3, Vec3};
use serde::{Deserialize, Serialize};

/// Joint offsets and mass properties of every segment, loads included.
///
/// Mass properties are about the *segment origin* (the joint), so that a load carried by the segment simply adds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Links<L = f64> {
    /// Joint position in the parent's frame, m.
    pub offset: [Vec3<L>; SEGMENT_COUNT],
    /// Mass, kg.
    pub mass: [L; SEGMENT_COUNT],
    /// First moment of mass `m·c`, segment frame, kg·m.
    pub moment: [Vec3<L>; SEGMENT_COUNT],
    /// Inertia about the segment origin, segment axes, kg·m².
    pub inertia: [Sym3<L>; SEGMENT_COUNT],
    /// Reflected inertia per joint DOF, kg·m².
    #[serde(with = "crate::saved::array")]
    pub armature: [L; DOF_COUNT],
}

impl Default for Links<f64> {
    /// All zero: a placeholder that belongs to no body.
    fn default() -> Self {
        Self {
            offset: [Vec3::zero(); SEGMENT_COUNT],
            mass: [0.0; SEGMENT_COUNT],
            moment: [Vec3::zero(); SEGMENT_COUNT],
            inertia: [Sym3::zero(); SEGMENT_COUNT],
            armature: [0.0; DOF_COUNT],
        }
    }
}

impl Links<f64> {
    /// Links of an unloaded body.
    pub fn new(body: &Body) -> Self {
        let seg = |i: usize| &body.segments[i];
        Self {
            offset: body.joint_offset,
            mass: std::array::from_fn(|i| seg(i).mass),
            moment: std::array::from_fn(|i| seg(i).com * seg(i).mass),
            inertia: std::array::from_fn(|i| {
                seg(i).inertia + Sym3::point_mass(seg(i).mass, seg(i).com)
            }),
            armature: body.armature,
        }
    }

    /// Whether a body, with loads that it may carry, can have these values.
    pub fn is_valid(&self) -> bool {
        let number = |x: f64| x.abs() <= 1e6;
        let vectors = self.offset.iter().chain(&self.moment);
        let inertia = self
            .inertia
            .iter()
            .flat_map(|i| [i.xx, i.yy, i.zz, i.xy, i.xz, i.yz]);
        self.mass.iter().all(|m| *m > 0.0 && number(*m))
            && self.armature.iter().all(|a| *a >= 0.0 && number(*a))
            && vectors
                .flat_map(|v| v.to_array())
                .chain(inertia)
                .all(number)
    }

    /// Welds a point mass (kg) to `segment` at `point` (segment frame, m): `docs/model.md`, load as inertia.
    pub fn add_load(&mut self, segment: SegmentId, point: Vec3, mass: f64) {
        let i = segment.index();
        self.mass[i] += mass;
        self.moment[i] += point * mass;
        self.inertia[i] += Sym3::point_mass(mass, point);
    }

    /// Total mass, kg, loads included.
    pub fn total_mass(&self) -> f64 {
        self.mass.iter().sum()
    }
}

impl<L: Lane> Links<L> {
    /// The same links in every lane.
    pub fn splat(one: &Links<f64>) -> Self {
        let mut out = Self {
            offset: [Vec3::zero(); SEGMENT_COUNT],
            mass: [L::zero(); SEGMENT_COUNT],
            moment: [Vec3::zero(); SEGMENT_COUNT],
            inertia: [Sym3::zero(); SEGMENT_COUNT],
            armature: [L::zero(); DOF_COUNT],
        };
        for k in 0..L::LANES {
            out.set_lane(k, one);
        }
        out
    }

    /// Replaces the links of lane `k`.
    pub fn set_lane(&mut self, k: usize, one: &Links<f64>) {
        for i in 0..SEGMENT_COUNT {
            self.offset[i].set_lane(k, one.offset[i]);
            self.mass[i].set_lane(k, one.mass[i]);
            self.moment[i].set_lane(k, one.moment[i]);
            self.inertia[i].set_lane(k, one.inertia[i]);
        }
        for d in 0..DOF_COUNT {
            self.armature[d].set_lane(k, one.armature[d]);
        }
    }
}
