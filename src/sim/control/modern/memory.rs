//! The controller's memory from tick to tick, also used in a checkpoint.

use crate::body::topology::{DOF_COUNT, NV};
use crate::math::Vec3;
use crate::report::MAX_CONTACTS;
use serde::{Deserialize, Serialize};

/// The memory of [`Modern`](super::Modern) from tick to tick: the starting point of its next solve, and the values that
/// it should stay near.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ModernMemory {
    #[serde(with = "crate::saved::array")]
    pub(super) price: [f64; NV],
    #[serde(with = "crate::saved::array")]
    pub(super) torque: [f64; DOF_COUNT],
    /// Contact forces by segment × 8 + vertex, N.
    #[serde(with = "sparse")]
    pub(super) force: Box<[Vec3; MAX_CONTACTS]>,
    /// Moment and force on the pelvis, N·m and N.
    pub(super) wrench: [Vec3; 2],
}

impl Default for ModernMemory {
    fn default() -> Self {
        Self {
            price: [0.0; NV],
            torque: [0.0; DOF_COUNT],
            force: Box::new([Vec3::zero(); MAX_CONTACTS]),
            wrench: [Vec3::zero(); 2],
        }
    }
}

impl ModernMemory {
    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let forces = self.force.iter().chain(&self.wrench);
        let forces = forces.flat_map(|f| f.to_array());
        let numbers = self.price.iter().chain(&self.torque).copied();
        numbers.chain(forces).all(f64::is_finite)
    }

    /// Forgets the last tick.
    pub fn reset(&mut self) {
        self.price = [0.0; NV];
        self.torque = [0.0; DOF_COUNT];
        self.force.fill(Vec3::zero());
        self.wrench = [Vec3::zero(); 2];
    }
}

/// Forces of points, mostly zero, stored as those that are not with their indices.
mod sparse {
    use super::{MAX_CONTACTS, Vec3};
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    type Forces = [Vec3; MAX_CONTACTS];
    const _: () = assert!(MAX_CONTACTS < 256, "indices are bytes");

    pub fn serialize<S: Serializer>(all: &Forces, to: S) -> Result<S::Ok, S::Error> {
        let is_zero = |f: &Vec3| f.to_array().iter().all(|x| x.to_bits() == 0);
        let some = (0u8..).zip(all).filter(|(_, f)| !is_zero(f));
        some.collect::<Vec<(u8, &Vec3)>>().serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Box<Forces>, D::Error> {
        let mut all = Box::new([Vec3::zero(); MAX_CONTACTS]);
        for (k, f) in Vec::<(u8, Vec3)>::deserialize(from)? {
            let place = all.get_mut(usize::from(k));
            *place.ok_or_else(|| D::Error::custom("a contact force of no point"))? = f;
        }
        Ok(all)
    }
}
