//! Goal: recordings are followed mirrored, and slower and faster than they were recorded, because their steps and their
//! balance are prepared for the pace. Method: clips from the motion capture folder, mirrored, and at 0.8 to 1.2 times
//! their speed, 60 Hz with two substeps, the modern controller; for comparison, the same clips prepared at their own
//! pace and played faster and slower.

use crate::common::{man, mocap, recorded_with};
use sinew_evaluate::experiments::walk::{WalkTrial, Walker, walk};
use sinew_physics::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::body::{Body, Posture};
use sinew_physics::motion::Bvh;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::{Preparation, RetargetOptions};
use std::sync::Arc;

/// The recording as a server prepares it for a pace.
fn at(tempo: f64) -> RetargetOptions {
    RetargetOptions {
        tempo,
        preparation: Preparation::walking(true),
        ..RetargetOptions::default()
    }
}

#[test]
fn recordings_are_followed_at_the_pace_they_are_prepared_for() {
    let body = man();
    let names = [
        "walk",
        "turn",
        "walk-around",
        "salsa-a",
        "salsa-b",
        "carry",
        "run",
        "wave",
        "hit",
    ];
    // Largest joint error of one clip and of all, ° rms.
    for (tempo, most, mean) in [
        (0.8, 0.7, 0.45),
        (0.9, 0.8, 0.45),
        (1.1, 1.5, 0.65),
        (1.2, 1.7, 0.85),
    ] {
        let (mut prepared, mut played) = (0.0, 0.0);
        for name in names {
            let w = walk(
                &Walker::new(&body),
                &WalkTrial::once(&recorded_with(&body, name, &at(tempo))),
            );
            let rms = w.report.tracking_joint_rms_deg;
            assert!(w.stood() && rms < most, "{name} at {tempo}: {rms} deg");
            prepared += rms / names.len() as f64;

            let once = WalkTrial::once(&recorded_with(&body, name, &at(1.0)));
            let seconds = once.seconds / tempo;
            let walker = Walker {
                speed: tempo,
                ..Walker::new(&body)
            };
            let w = walk(&walker, &WalkTrial { seconds, ..once });
            played += w.report.tracking_joint_rms_deg / names.len() as f64;
        }
        println!("{tempo}: joints {prepared:.2} deg rms in the mean, {played:.2} as prepared at 1");
        assert!(
            prepared < mean && prepared < 0.8 * played,
            "{tempo}: {prepared} deg, {played} deg without preparation"
        );
    }
}

#[test]
fn the_pace_changes_the_rate_and_not_the_samples_of_the_recording() {
    let body = man();
    let bare = |tempo| RetargetOptions {
        preparation: Preparation {
            ends: false,
            balance: false,
            ..at(tempo).preparation
        },
        ..at(tempo)
    };
    let [slow, fast] = [0.5, 2.0].map(|tempo| recorded_with(&body, "turn", &bare(tempo)));
    assert_eq!(slow.len(), fast.len());
    assert!((fast.rate_hz() / slow.rate_hz() - 4.0).abs() < 1e-12);
    assert!((slow.duration() / fast.duration() - 4.0).abs() < 1e-12);
    // The middle of the motion is the same posture; the plan for the feet depends slightly on the pace.
    let middle = |clip: &sinew_physics::motion::Clip| clip.sample(0.5 * clip.duration()).posture;
    let (a, b) = (middle(&slow), middle(&fast));
    assert!((a.root_position - b.root_position).norm() < 0.03);
    // Balance demands more of the faster one.
    let sway = |tempo| {
        let clip = recorded_with(&body, "turn", &at(tempo));
        let way = |t: f64| clip.sample(t).posture.root_position.y;
        let count = 100;
        let times = (0..count).map(|k| clip.duration() * f64::from(k) / f64::from(count));
        let (least, most) = times.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| {
            (a.min(way(t)), b.max(way(t)))
        });
        most - least
    };
    assert!((sway(0.6) - sway(1.4)).abs() > 1e-3);
}

/// Lowest contact point of each foot, m.
fn soles(body: &Body, posture: &Posture) -> [f64; 2] {
    let poses = forward(body, posture);
    [[L_FOOT, L_TOES], [R_FOOT, R_TOES]].map(|foot| {
        foot.iter()
            .flat_map(|s| {
                let (origin, rotation) = poses[s.index()];
                let points = &body.segment(*s).contact_points;
                points.iter().map(move |p| (origin + rotation.rotate(*p)).z)
            })
            .fold(f64::INFINITY, f64::min)
    })
}

/// The last long step of a run leaves the other foot 0.7 m behind. It used to wait there until the body had come to
/// rest over the front foot, out of reach, and was dragged 0.3 m below the floor.
#[test]
fn a_foot_that_is_left_behind_steps_before_its_leg_is_stretched() {
    let body = man();
    for tempo in [0.8, 1.0, 1.1] {
        let clip = recorded_with(&body, "run", &at(tempo));
        let rate = clip.rate_hz();
        let count = (clip.lead_out() * rate) as usize;
        let lowest = (0..=count)
            .map(|i| clip.duration() + i as f64 / rate)
            .flat_map(|t| soles(&body, &clip.sample(t).posture))
            .fold(f64::INFINITY, f64::min);
        let w = walk(&Walker::new(&body), &WalkTrial::once(&clip));
        let rms = w.report.tracking_joint_rms_deg;
        println!("{tempo}: lowest point {:.1} mm, {rms:.2} deg", 1e3 * lowest);
        assert!(lowest > -0.004, "{tempo}: {lowest} m");
        assert!(w.stood() && rms < 1.2, "{tempo}: {rms} deg");
    }
}

#[test]
fn mirrored_recordings_are_followed_as_well() {
    let body = man();
    for name in [
        "walk",
        "turn",
        "walk-around",
        "salsa-b",
        "dance",
        "run",
        "hit",
    ] {
        let bvh = Bvh::parse(&mocap::read(&format!("{name}.bvh"))).unwrap();
        let [plain, mirrored] = [bvh.clone(), bvh.mirrored()].map(|bvh| {
            let clip = prepare_recording(&bvh.recording().unwrap(), &body, &at(1.0))
                .unwrap()
                .clip;
            walk(&Walker::new(&body), &WalkTrial::once(&Arc::new(clip)))
        });
        let rms = [&plain, &mirrored].map(|w| w.report.tracking_joint_rms_deg);
        println!("{name}: {:.2} deg, mirrored {:.2} deg", rms[0], rms[1]);
        assert!(plain.stood() && mirrored.stood(), "{name}");
        assert!((rms[1] - rms[0]).abs() < 0.1, "{name}: {rms:?}");
        assert!(mirrored.slip < plain.slip + 1e-3, "{name}");
    }
}
