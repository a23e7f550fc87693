//! Articulated-body dynamics: pure kernels, generic over lanes, one file per algorithm.
//!
//! All kernels work in *world axes with the pelvis origin as reference point*, so nothing depends on where in the world
//! a figure stands. Bodies, not joint frames, are the unit: three rotations of a ball joint share one position, one
//! inertia and one acceleration. Accelerations are classical time derivatives of
//! [`State::velocity`](super::body::State::velocity).

pub mod aba;
pub mod crba;
pub mod factor;
pub mod integrals;
pub mod jacobian;
pub mod kinematics;
pub mod lanes;
pub mod mass_matrix;
pub mod rnea;
pub mod terms;

#[cfg(test)]
pub(crate) mod tests;

pub use aba::{AbaWorkspace, aba};
pub use crba::{CompositeInertia, crba};
pub use factor::{factor, solve};
pub use integrals::{Momentum, center_of_mass, kinetic_energy, momentum, rotor_energy};
pub use kinematics::Kinematics;
pub use mass_matrix::MassMatrix;
pub use rnea::{External, ExternalForces, RneaWorkspace, rnea};
pub use terms::{Dynamics, Placement, Terms};
