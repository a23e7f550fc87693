//! Goal: recordings are read correctly, and their oddities are reported. Method: BVH files written from known postures,
//! damaged or written in an odd way, are read back.

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
