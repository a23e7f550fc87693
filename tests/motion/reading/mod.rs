//! Goal: recordings are read for what they are, and what is odd about them is said.
//! Method: BVH files written from postures that are known, damaged or written in an odd way, read back.

mod calibration;
mod file;
mod hostile;
mod poses;
mod preparation;
mod roots;

use sinew_physics::body::topology::DOF_NAMES;

/// Index of a degree of freedom.
fn dof(name: &str) -> usize {
    DOF_NAMES.iter().position(|n| *n == name).unwrap()
}
