//! The motions of the corpus.

mod airborne;
mod lying;
mod standing;
mod walking;

use super::actor::{Actor, pelvis_turn};
use super::gait::at_ease;
use super::plan::{Height, Script, Style, standing_feet};
use super::tracks::{DEG, Track, v3};
use airborne::{jog, jumping, kick};
use lying::lie_down;
use standing::{lift, squat, stand, wave};
use walking::{back_steps, side_steps, turn, walks};

/// Height of the hips in quiet standing, share of the leg.
const STAND: f64 = 0.992;

fn hips(actor: &Actor, share: f64) -> f64 {
    actor.ankle + actor.leg() * share
}

/// Height of the centre of mass in quiet standing.
fn standing_centre(actor: &Actor) -> f64 {
    let feet = standing_feet(1.0, 0.095, 0.1);
    let upper = at_ease();
    let pose = actor.pose(
        v3(0.0, 0.0, hips(actor, STAND)),
        pelvis_turn(0.0, &upper),
        &upper,
        [feet[0].at(actor, 0.0), feet[1].at(actor, 0.0)],
    );
    actor.centre(&pose).z
}

fn in_place(
    name: &str,
    about: &'static str,
    length: f64,
    half: f64,
    height: Track,
    style: Style,
) -> Script {
    Script {
        name: name.to_owned(),
        kind: "stand",
        about,
        actor: Actor::medium(),
        length,
        window: (0.0, length),
        feet: standing_feet(length, half, 8.0 * DEG),
        style,
        heading: Track::default(),
        height: Height::Pelvis(height),
        elsewhere: None,
        seat: None,
        sway: Default::default(),
        touches: Vec::new(),
    }
}

/// Length and time factors of an actor against the adult one: a pendulum of its leg.
fn scales(actor: &Actor) -> (f64, f64) {
    let k = actor.leg() / Actor::medium().leg();
    (k, k.sqrt())
}

/// All motions, in order of their names' first use.
pub fn all() -> Vec<Script> {
    let mut out = vec![stand(), wave(), squat(), lift()];
    out.extend(walks());
    out.extend([turn(), side_steps(), back_steps(), jog()]);
    out.push(jumping(
        "jump",
        "jump",
        "Jumps up from both feet with a swing of the arms.",
        &[(1.75, 0.46, 0.0, 0.28)],
        1.5,
    ));
    out.push(jumping(
        "hops",
        "jump",
        "Three hops forward on both feet.",
        &[
            (1.6, 0.26, 0.30, 0.17),
            (2.24, 0.26, 0.30, 0.13),
            (2.88, 0.26, 0.30, 0.13),
        ],
        1.5,
    ));
    out.push(kick());
    out.push(lie_down());
    out
}
