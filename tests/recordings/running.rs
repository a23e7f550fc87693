//! Goal: a run that is kept as a run is prepared as a series of flights, and followed to its last sample. Method: clips
//! from the motion capture folder, in torque simulation, 60 Hz with two substeps, the modern controller. They begin and
//! end in full stride: the figure begins in the state of the first sample.

use crate::common::{man, mocap, recorded_with};
use sinew_evaluate::experiments::walk::{WalkTrial, Walker, walk};
use sinew_physics::body::Posture;
use sinew_physics::motion::Bvh;
use sinew_physics::plan::pelvis_shift::mass_track;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::RetargetOptions;
use sinew_physics::track::StepPlan;

const GRAVITY: f64 = 9.81;

#[test]
fn the_feet_of_a_run_stand_as_long_as_they_carry() {
    let body = man();
    // Duration of the run in each clip, s.
    for (name, until) in [("run", 1.0), ("quick-stop", 0.7)] {
        let bvh = Bvh::parse(&mocap::read(&format!("{name}.bvh"))).unwrap();
        let r = prepare_recording(
            &bvh.recording().unwrap(),
            &body,
            &RetargetOptions::default(),
        )
        .unwrap();
        let phases = &r.report.feet.phases;
        let text: Vec<String> = (phases.iter())
            .map(|p| format!("{}{:.3}", p.letter(), p.end - p.start))
            .collect();
        println!("{name}: {}", text.join(" "));
        let mut seen = 0;
        for p in phases.iter().filter(|p| p.start > 0.0 && p.start < until) {
            let lasts = p.end - p.start;
            match p.planted {
                // A runner neither has both feet on the floor, nor floats.
                [true, true] => panic!("{name}: {text:?}"),
                [false, false] => {
                    assert!((0.02..0.17).contains(&lasts), "{name}: {text:?}");
                    seen += 1;
                }
                _ => assert!((0.10..0.26).contains(&lasts), "{name}: {text:?}"),
            }
        }
        assert!(seen >= 3, "{name}: {text:?}");
        // Feet take turns.
        let stands: Vec<usize> = (phases.iter())
            .filter(|p| p.start < until && p.planted != [false; 2])
            .map(|p| usize::from(p.planted[1]))
            .collect();
        assert!(stands.windows(2).all(|w| w[0] != w[1]), "{name}: {text:?}");
    }
}

#[test]
fn who_runs_falls_freely_in_flight_and_the_step_plan_knows() {
    let body = man();
    let clip = recorded_with(&body, "run", &RetargetOptions::default());
    let postures: Vec<Posture> = (0..clip.len()).map(|i| *clip.posture(i)).collect();
    let track = mass_track(&body, &postures, clip.rate_hz());
    let weight = GRAVITY * body.segments.iter().map(|s| s.mass).sum::<f64>();
    let off = |i: usize| clip.planted(i) == [false; 2];
    let plan = StepPlan::new(&body, &clip, false);
    let (mut air, mut off_plan) = (0, 0);
    let mut most = [0.0f64; 2];
    for i in 6..clip.len() - 6 {
        // Second differences feel a landing or leaving foot up to three samples away.
        if (i - 3..=i + 3).all(off) {
            air += 1;
            let force = track.wrench[i].force;
            let level = force.x.hypot(force.y) / weight;
            most = [most[0].max(track.load[i].abs()), most[1].max(level)];
        }
        if off(i) {
            let t = i as f64 / clip.rate_hz();
            off_plan += u32::from((0..2).any(|side| plan.current(side, t).is_some()));
        }
    }
    println!("{air} samples in the air: {most:.3?} of the weight; {off_plan} of them on a foot");
    assert!(air > 25, "{air}");
    assert!(most[0] < 0.1 && most[1] < 0.1, "{most:?}");
    // Where it has no foot on the floor, none is planned there: only the samples beside a touch-down may be.
    assert!(off_plan <= 8, "{off_plan}");
}

#[test]
fn a_run_is_followed_to_its_last_sample() {
    let body = man();
    let clip = recorded_with(&body, "run", &RetargetOptions::default());
    assert_eq!((clip.lead_in(), clip.lead_out()), (0.0, 0.0));
    for (strength, bound) in [(1.0, 12.0), (1.5, 6.5)] {
        let who = Walker {
            strength,
            ..Walker::new(&body)
        };
        let kept = WalkTrial {
            seconds: clip.duration(),
            ..WalkTrial::once(&clip)
        };
        let w = walk(&who, &kept);
        let rms = w.report.tracking_joint_rms_deg;
        println!(
            "strength {strength}: {rms:.1} deg, capture point {:.2} m, {} landings",
            w.capture[1], w.steps
        );
        assert!(w.stood(), "strength {strength}: fell at {:?} s", w.fell_s);
        assert!(
            rms < bound && w.steps >= 3,
            "strength {strength}: {rms} deg, {} landings",
            w.steps
        );
    }
}
