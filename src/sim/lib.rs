//! Physics and control: pure, synchronous, without I/O, clock or logging.
//!
//! `world` ─► `rehearsal` ─► `figure` ─► `track` ─► `control` ─► `collide` ─► `contact` ─► `plan` ─► `reference` ─►
//! `motion`, `support` ─► `setup` ─► `strength` ─► `dynamics` ─► `report` ─► `touch` ─► `body` ─► `math` ─► `saved`.
//!
//! # Example
//!
//! The types convert to and from those of `nalgebra`, so that results can be computed with. The mass matrix of a
//! standing man, the inertia that a push on the pelvis meets, and where the left foot is:
//!
//! ```
//! use nalgebra::{DMatrix, DVector, Vector3};
//! use sinew_physics::body::topology::L_FOOT;
//! use sinew_physics::body::{Body, Links, NV, State};
//! use sinew_physics::dynamics::Dynamics;
//!
//! let body = Body::adult_man();
//! let mut dynamics = Dynamics::default();
//! dynamics.compute(&Links::new(&body), &State::default(), &[], 9.81);
//!
//! let m = DMatrix::from(&dynamics.mass_matrix);
//! let mut push = DVector::zeros(NV);
//! push[3] = 1.0; // forwards, at the pelvis
//! let acceleration = m.cholesky().expect("inertia is positive").solve(&push);
//! let felt = 1.0 / acceleration[3];
//! assert!(10.0 < felt && felt < body.profile.mass); // the joints are free, so the trunk and limbs lag behind
//!
//! let foot = dynamics.segment_pose(L_FOOT.index());
//! assert!(foot.translation.vector.y > 0.0); // y points to the left
//! assert!((foot.rotation * Vector3::z() - Vector3::z()).norm() < 0.2);
//! ```

pub mod body;
pub mod collide;
pub mod contact;
pub mod control;
pub mod dynamics;
pub mod figure;
pub mod forecast;
pub mod get_up;
pub mod math;
pub mod motion;
pub mod paper;
pub mod params;
pub mod plan;
pub mod reference;
pub mod rehearsal;
pub mod report;
pub mod saved;
pub mod setup;
pub mod stepper;
pub mod strength;
pub mod support;
pub mod tick_context;
pub mod time;
pub mod touch;
pub mod track;
pub mod world;

/// Every tunable number, by the part and the subject that it belongs to.
pub fn parameters() -> Vec<params::ParamGroup> {
    let group =
        |part| move |&(name, all): &(&'static str, _)| params::ParamGroup { part, name, all };
    let mut out = Vec::new();
    out.extend(reference::params::groups().iter().map(group("reference")));
    out.extend(plan::params::groups().iter().map(group("plan")));
    out.extend(track::params::groups().iter().map(group("track")));
    out.extend(get_up::params::groups().iter().map(group("get_up")));
    out.extend(control::params::groups().iter().map(group("control")));
    out.extend(stepper::params::groups().iter().map(group("stepper")));
    out.extend(paper::params::groups().iter().map(group("paper")));
    out.extend(figure::params::groups().iter().map(group("figure")));
    out
}
