//! The floor's forces explain every motion better once it is prepared.

use super::{take, text};
use crate::common::mocap;
use sinew_physics::body::{Body, Posture};
use sinew_physics::plan::feasibility::{Consistency, consistency};
use sinew_physics::reference::{Preparation, RetargetOptions};

/// A recording fitted to the body, and prepared, judged on the feet that are planted according to its labels.
fn before_and_after(body: &Body, name: &str) -> [Consistency; 2] {
    let bare = RetargetOptions {
        preparation: Preparation::NONE,
        ..RetargetOptions::default()
    };
    let phases = take(&text(name), body, &bare).unwrap().report.feet.phases;
    [bare, RetargetOptions::default()].map(|options| {
        let clip = take(&text(name), body, &options).unwrap().clip;
        let at = |i: usize| (i as f64 + 0.5) / clip.rate_hz();
        let label: Vec<[bool; 2]> = (0..clip.len())
            .map(|i| phases.iter().find(|p| at(i) < p.end).unwrap().planted)
            .collect();
        let postures: Vec<Posture> = (0..clip.len()).map(|i| *clip.posture(i)).collect();
        consistency(body, &postures, &label, clip.rate_hz())
    })
}

/// Preparation brings every recording with a foot on the floor closer to the abilities of a body
/// (docs/locomotion.md#balance). A residual of less than a thousandth of the weight, or a millimetre, counts as zero.
#[test]
fn preparation_makes_motions_consistent_with_the_dynamics() {
    let body = Body::adult_man();
    let mut seen = 0;
    for name in mocap::on_feet() {
        let [before, after] = before_and_after(&body, name);
        if before.flight > 0.0 {
            continue;
        }
        seen += 1;
        println!("{name}\n  recorded {before:?}\n  prepared {after:?}");
        let closer = |name: &str, before: f64, after: f64, least: f64| {
            assert!(after < before.max(least), "{name}: {before} to {after}");
        };
        closer(name, before.force.rms, after.force.rms, 1e-3);
        closer(name, before.moment.rms, after.moment.rms, 1e-3);
        closer(name, before.distance.rms, after.distance.rms, 1e-3);
        closer(name, before.slip.0, after.slip.0, 1e-3);
    }
    assert!(seen >= 10, "{seen}");
}
