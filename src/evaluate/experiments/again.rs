//! Strength from motion: a person who is too weak for a motion, by the tables, gets the strength that it requires, and
//! does it again in simulation.

use super::{ControlPair, ExperimentRecord, carried, record};
use crate::envelope::Envelope;
use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::body::{Body, Links};
use sinew_physics::figure::{Perturbation, StrengthScale};
use sinew_physics::motion::Clip;
use sinew_physics::strength::Strength;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, MotionSource};
use std::sync::Arc;

/// Quantile of the required torque that counts, and the factor on it: defaults of `sinew strength`.
pub const QUANTILE: f64 = 0.98;
/// See [`QUANTILE`].
pub const MARGIN: f64 = 1.1;

/// A motion that a person performed, with a load in the right hand.
#[derive(Clone, Debug)]
pub struct Did {
    /// The motion.
    pub clip: Arc<Clip>,
    /// kg; 0 for none.
    pub mass: f64,
}

/// The result.
#[derive(Clone, Debug)]
pub struct Again {
    /// DOF that needs the largest share of its strength, and the share.
    pub hardest: (&'static str, f64),
    /// Muscles that were scaled up: number of DOFs and the largest factor.
    pub raised: (usize, f64),
    /// With the strength of the tables, and with that of the motion.
    pub runs: [ExperimentRecord; 2],
}

/// Takes the strength from the motion, and repeats the motion with both strengths.
pub fn again(body: &Arc<Body>, percentile: f64, did: &Did, panels: usize) -> Again {
    let mut links = Links::new(body);
    let held = if did.mass > 0.0 {
        carried(body, did.mass, false)
    } else {
        Vec::new()
    };
    for p in &held {
        if let Perturbation::Load {
            segment,
            point,
            mass,
            ..
        } = p
        {
            links.add_load(*segment, *point, *mass);
        }
    }
    let strength = Strength::at_percentile(body, percentile);
    let envelope = Envelope::of(body, &links, &strength, &[&did.clip], QUANTILE);
    let merged = envelope.merged(percentile, MARGIN);
    let most = envelope.ratio.map(|[a, b]| a.max(b));
    let hardest = (0..most.len()).fold(0, |m, d| if most[d] > most[m] { d } else { m });
    let tables = StrengthScale {
        percentile,
        ..StrengthScale::default()
    };
    let runs = [&tables, &merged].map(|scale| {
        let first = did.clip.sample(0.0).state();
        let (mut world, key) = ControlPair::modern().world(body, first, scale.clone());
        for p in &held {
            world.perturb(key, *p).expect("loads are valid");
        }
        let figure = world.figure_mut(key).expect("it was just added");
        figure.set_drive(MotionSource::Clip(ClipPlayback::new(
            Arc::clone(&did.clip),
            WorldTime(0.0),
        )));
        let seconds = did.clip.duration() + 1.0;
        record(&mut world, key, seconds, panels, |_, _| {
            (Vec::new(), Vec::new())
        })
    });
    Again {
        hardest: (DOF_NAMES[hardest], most[hardest]),
        raised: (
            merged.dof.iter().filter(|f| **f > 1.0).count(),
            merged.dof.iter().copied().fold(1.0, f64::max),
        ),
        runs,
    }
}
