//! The zero-moment point keeps to the feet, and what the floor gives explains the motion.

use super::{STANDING, take, text};
use sinew::sim::body::{Body, Posture};
use sinew::sim::plan::feasibility::consistency;
use sinew::sim::retarget::{Preparation, RetargetOptions};

#[test]
fn standing_motions_keep_the_zero_moment_point_over_the_feet() {
    for body in [Body::adult_man(), Body::adult_woman()] {
        for name in STANDING {
            let r = take(&text(name), &body, &RetargetOptions::default()).unwrap();
            let (before, after) = r.report.balance.zmp_outside;
            assert!(
                after.p95 == 0.0 && after.mean <= before.mean,
                "{name}: {before:?} {after:?}"
            );
            // Wave takes steps; the others never leave the floor.
            let (most, fraction) = if name == "wave" {
                (0.05, 0.03)
            } else {
                (0.0, 0.0)
            };
            assert!(
                after.max <= most && after.fraction <= fraction,
                "{name}: {after:?}"
            );
        }
    }
}

#[test]
fn balancing_and_locking_make_a_walk_consistent() {
    let body = Body::adult_man();
    for name in ["walk", "turn", "salsa-a"] {
        let r = take(&text(name), &body, &RetargetOptions::default()).unwrap();
        let (before, after) = r.report.balance.zmp_outside;
        assert!(
            after.mean < 0.01 && after.mean < 0.25 * before.mean,
            "{name}: {before:?} {after:?}"
        );
        assert!(
            r.report.feet.slide.0 > 0.02 && r.report.pelvis.shift < 0.1,
            "{name}: {:?}",
            r.report.feet.slide
        );
    }
}

/// Goal: preparation brings recordings of people on their feet close to what a body can do
/// (docs/locomotion.md#balance).
#[test]
fn preparation_makes_motions_consistent_with_the_dynamics() {
    let body = Body::adult_man();
    let bare = RetargetOptions {
        preparation: Preparation::NONE,
        ..RetargetOptions::default()
    };
    // Share of the weight that the ground lacks (rms) and distance of the zero-moment point from the soles (rms, m);
    // measured 0.012 and 0.024 for walk, 0.013 and 0.023 for turn, below 0.004 and 0.003 for the others.
    for (name, lacks, outside) in [
        ("walk", 0.015, 0.03),
        ("turn", 0.016, 0.03),
        ("idle", 0.002, 0.002),
        ("wave", 0.005, 0.004),
    ] {
        let of = |options: &RetargetOptions| {
            let out = take(&text(name), &body, options).unwrap();
            let phases = take(&text(name), &body, &bare).unwrap().report.feet.phases;
            let clip = out.clip;
            let at = |i: usize| (i as f64 + 0.5) / clip.rate_hz();
            let label: Vec<[bool; 2]> = (0..clip.len())
                .map(|i| phases.iter().find(|p| at(i) < p.end).unwrap().planted)
                .collect();
            let postures: Vec<Posture> = (0..clip.len()).map(|i| *clip.posture(i)).collect();
            consistency(&body, &postures, &label, clip.rate_hz())
        };
        let (before, after) = (of(&bare), of(&RetargetOptions::default()));
        println!("{name}\n  recorded {before:?}\n  prepared {after:?}");
        assert!(after.force.rms < before.force.rms && after.distance.rms < before.distance.rms);
        assert!(after.force.rms < lacks, "{name}: {after:?}");
        assert!(after.distance.rms < outside, "{name}: {after:?}");
        assert!(
            after.slip.0 < 0.6 * before.slip.0,
            "{name}: {before:?} {after:?}"
        );
    }
}
