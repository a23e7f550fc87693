//! Pushes of a standing figure, in units of the impulse that the linear inverted pendulum can stop.

use super::{ControlPair, ExperimentRecord, push_at_chest, record};
use sinew_physics::body::{Body, State};
use sinew_physics::figure::StrengthScale;
use sinew_physics::math::Vec3;
use sinew_physics::motion::GRAVITY;
use sinew_physics::motion::builtin::at_ease;
use std::sync::Arc;

/// The push begins after the figure has settled, s, and lasts this long, s.
const BEGINS: f64 = 0.5;
const LASTS: f64 = 0.1;
/// The run, s.
const DURATION: f64 = 4.5;

/// One push.
#[derive(Clone, Debug)]
pub struct Push {
    /// Impulse, N·s.
    pub impulse: f64,
    /// The impulse that the pendulum can stop, N·s: m ω d with ω² = g/h and d the distance of the centre of mass to the
    /// edge.
    pub bound: f64,
    /// The run.
    pub record: ExperimentRecord,
}

/// Pushes the chest with `share` of the pendulum's bound. The feet stay where they are: no protective step.
pub fn push(
    body: &Arc<Body>,
    pair: &ControlPair,
    direction: Vec3,
    share: f64,
    panels: usize,
) -> Push {
    let state = State::at_rest(at_ease(body));
    let mut pair = pair.clone();
    pair.params.protective_steps = false;
    let (mut world, key) = pair.world(body, state, StrengthScale::default());
    world.step();
    let figure = world.figure(key).expect("nobody removes the figure");
    let r = figure.report().expect("a stepped figure has a report");
    let edge = r
        .balance
        .support_polygon
        .iter()
        .map(|c| c[0] * direction.x + c[1] * direction.y)
        .fold(f64::MIN, f64::max);
    let mass = figure.links().total_mass();
    let bound = mass * (GRAVITY / r.balance.com.z).sqrt() * (edge - r.balance.com.dot(direction));
    let impulse = share * bound;
    let what = push_at_chest(direction * (impulse / LASTS), BEGINS, LASTS);
    world.perturb(key, what).expect("pushes are valid");
    Push {
        impulse,
        bound,
        record: record(&mut world, key, DURATION, panels, |_, _| Default::default()),
    }
}

/// The largest push from which the figure recovers, as it does from every smaller one; in steps of 5 % of the bound, up
/// to 1.5.
pub fn recovered(body: &Arc<Body>, pair: &ControlPair, direction: Vec3) -> Push {
    let mut best = push(body, pair, direction, 0.0, 0);
    for n in 1..=30 {
        let next = push(body, pair, direction, 0.05 * f64::from(n), 0);
        if next.record.fell_s.is_some() {
            break;
        }
        best = next;
    }
    best
}
