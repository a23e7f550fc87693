//! Plans: contacts, footholds, balance and whole-body postures of a motion that a body can follow.

pub mod ankle_torque_limit;
pub mod contact_labels;
pub mod cycle;
pub mod envelope;
pub mod feasibility;
pub(crate) mod flight_phases;
pub mod foot_lock;
pub mod motion_transition;
pub mod params;
pub mod pelvis_shift;
pub mod prepare;
pub mod splice;
pub mod stop;
pub mod stream;

pub use cycle::cycle;
pub use stream::StreamPlan;
