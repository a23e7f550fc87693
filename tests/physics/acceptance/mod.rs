//! Acceptance scenarios: whole figures in whole worlds against statics, pendulums, parabolas and conservation laws.
//!
//! * `stand`: ten seconds of standing still.
//! * `push`: the pushes that a standing figure survives, and the direction of its falls.
//! * `report`: the centre of mass in the report of a tick.
//! * `fall`: a stiff figure is a physical pendulum.
//! * `bump`: walking into another figure, or into a wall.
//! * `bracing`: a falling person lands on the hands, not on the head.
//! * `flight`: the parabola and the momenta of a thrown figure; a limp one gains no energy.
//! * `slide`: Coulomb's law for points that slide.
//! * `load`: a held load is inertia.
//! * `second_hand`: the other hand helps with a load that is too heavy for one arm.
//! * `constrain`: hands, head and centre of mass at places that a client gives.
//! * `get_up`: from belly, back and sides, within seconds.
//! * `hand`: leaning on tables and walls; two figures that run into each other.
//! * `people`: ages, sizes, fatigue, percentiles.
//! * `assist`: the external wrench, and its honest report.
//! * `help`: the wrench that acts only while a motion is being lost.
//! * `stream_end`: a stream is followed to its end.
//! * `symmetry`: left and right, and all directions, are alike.
//! * `containment`: bad input is refused, and a runaway figure harms no other.
//!
//! Everything is seeded or constant; nothing is timed.

mod assist;
mod bare;
mod bracing;
mod bump;
mod collide;
mod constrain;
mod containment;
mod fall;
mod flight;
mod get_up;
mod hand;
mod help;
mod jump;
mod lift;
mod load;
mod people;
mod push;
mod report;
mod second_hand;
mod self_contact;
mod slide;
mod stand;
mod start;
mod stream_end;
mod symmetry;

use sinew_physics::body::{Links, State};
use sinew_physics::dynamics::{
    Kinematics, Momentum, center_of_mass, kinetic_energy, momentum, rotor_energy,
};
use sinew_physics::math::Vec3;

/// Gravity of the default world, m/s².
const GRAVITY: f64 = 9.81;

/// A vector.
fn vec3(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3 { x, y, z }
}

/// World integrals of one state.
struct Integrals {
    com: Vec3,
    momentum: Momentum,
    /// Kinetic (armature included) and potential energy, J.
    energy: f64,
}

fn integrals(links: &Links, state: &State) -> Integrals {
    let mut kin = Kinematics::default();
    kin.set_state(links, state);
    let (com, mass) = center_of_mass(links, &kin);
    let com = state.posture.root_position + com;
    let rotors = rotor_energy(links, &state.velocity);
    Integrals {
        com,
        momentum: momentum(links, &kin),
        energy: kinetic_energy(links, &kin) + rotors + mass * GRAVITY * com.z,
    }
}
