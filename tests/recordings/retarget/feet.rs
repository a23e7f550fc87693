//! Feet that stand neither slide nor sink, and stand when they did in the recording.

use super::{STANDING, stats, take, text};
use crate::common::mocap::CLIPS;
use sinew::sim::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew::sim::body::{Body, Posture};
use sinew::sim::math::Vec3;
use sinew::sim::motion::leg_ik::forward;
use sinew::sim::plan::contact_labels::ContactPhase;
use sinew::sim::plan::foot_lock::Sole;
use sinew::sim::retarget::{Preparation, RetargetOptions};

/// Heel, toe joint and tip of the toes of both feet, and the lowest point of either sole.
fn soles(body: &Body, posture: &Posture) -> [([Vec3; 3], f64); 2] {
    let poses = forward(body, posture);
    [(L_FOOT, L_TOES), (R_FOOT, R_TOES)].map(|(foot, toes)| {
        let (at, q) = poses[foot.index()];
        let back = body
            .segment(foot)
            .contact_points
            .iter()
            .min_by(|a, b| a.x.total_cmp(&b.x))
            .unwrap();
        let heel = at + q.rotate(Vec3 { y: 0.0, ..*back });
        let low = [foot, toes]
            .iter()
            .flat_map(|s| {
                let (at, q) = poses[s.index()];
                body.segment(*s)
                    .contact_points
                    .iter()
                    .map(move |p| (at + q.rotate(*p)).z)
            })
            .fold(f64::INFINITY, f64::min);
        let (toe, q) = poses[toes.index()];
        let front = body.segment(toes).contact_points.iter();
        let front = front.max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
        let tip = toe + q.rotate(Vec3 { y: 0.0, ..*front });
        ([heel, toe, tip], low)
    })
}

#[test]
fn planted_feet_neither_slide_nor_sink() {
    for body in [Body::adult_man(), Body::adult_woman()] {
        for name in CLIPS {
            let r = take(&text(name), &body, &RetargetOptions::default()).unwrap();
            // A planted foot is held by its heel, by its toe joint or, of a runner, by the tip of its toes; while one
            // holds, the others may lift off and come down elsewhere.
            let mut held: [Option<[Vec3; 3]>; 2] = [None; 2];
            for i in 0..r.clip.len() {
                let now = soles(&body, r.clip.posture(i));
                for s in 0..2 {
                    if !r.clip.planted(i)[s] {
                        held[s] = None;
                        continue;
                    }
                    let (points, low) = now[s];
                    let at = held[s].unwrap_or(points);
                    let off: [f64; 3] = std::array::from_fn(|k| {
                        (points[k].x - at[k].x).hypot(points[k].y - at[k].y)
                    });
                    assert!(
                        off.iter().any(|d| *d < 1e-3),
                        "{name}: foot {s} slides by {off:?} m at sample {i}"
                    );
                    held[s] = Some(std::array::from_fn(|k| {
                        if off[k] < 1e-3 { at[k] } else { points[k] }
                    }));
                    assert!(
                        low > -1e-3,
                        "{name}: foot {s} is {} m under the floor at sample {i}",
                        -low
                    );
                    assert!(
                        low < 2e-3,
                        "{name}: foot {s} stands {low} m over the floor at sample {i}"
                    );
                }
            }
            assert!(
                r.report.feet.slide.1 < 1e-3 && r.report.feet.penetration.1 < 1e-3,
                "{name}: {:?}",
                r.report
            );
            assert!(
                r.report.feet.freed < 0.12,
                "{name}: {} of the samples let go",
                r.report.feet.freed
            );
        }
    }
}

/// Phases of the statistics (frames, last one included), seconds.
fn known_phases(stats: &serde_json::Value, name: &str) -> Vec<(f64, f64, char)> {
    let clip = &stats[name];
    let h = clip["frame_time"].as_f64().unwrap();
    clip["phases"]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| {
            (
                p[0].as_f64().unwrap() * h,
                (p[1].as_f64().unwrap() + 1.0) * h,
                p[2].as_str().unwrap().chars().next().unwrap(),
            )
        })
        .collect()
}

#[test]
fn contact_phases_agree_with_the_statistics() {
    let stats = stats();
    let body = Body::adult_man();
    for name in ["walk", "run", "jump"] {
        let r = take(&text(name), &body, &RetargetOptions::default()).unwrap();
        let known = known_phases(&stats, name);
        // Both feet leave or land within a few frames of each other in a jump: such slivers are no phases of their own.
        let ours: Vec<&ContactPhase> = r
            .report
            .feet
            .phases
            .iter()
            .filter(|p| p.end - p.start > 0.03)
            .collect();
        let letters = |v: Vec<char>| v.into_iter().collect::<String>();
        assert_eq!(
            letters(ours.iter().map(|p| p.letter()).collect()),
            letters(known.iter().map(|k| k.2).collect()),
            "{name}"
        );
        for (p, k) in ours.iter().zip(&known) {
            let known = if name != "run" {
                (p.start - k.0).abs() < 0.06 && (p.end - k.1).abs() < 0.06
            } else if p.letter() == '-' {
                // The recorded body leaves the floor at 0.6 m/s, which is 0.12 s of free fall.
                (0.1..0.16).contains(&(p.end - p.start))
            } else {
                // The statistics call a foot planted while it is slow, which loses landing and roll-off
                // (docs/locomotion.md#runs): theirs is the middle of each stance.
                p.start < k.0 + 0.03 && p.end > k.1 - 0.03
            };
            assert!(
                known,
                "{name}: {} {:.3}…{:.3} against {:.3}…{:.3}",
                p.letter(),
                p.start,
                p.end,
                k.0,
                k.1
            );
        }
    }
    for name in STANDING {
        let r = take(&text(name), &body, &RetargetOptions::default()).unwrap();
        let both: f64 = r
            .report
            .feet
            .phases
            .iter()
            .filter(|p| p.letter() == 'D')
            .map(|p| p.end - p.start)
            .sum();
        assert!(
            both > 0.93 * r.clip.duration(),
            "{name}: both feet down for {both} s"
        );
    }
}

#[test]
fn swinging_feet_clear_the_floor() {
    let body = Body::adult_man();
    let r = take(&text("walk"), &body, &RetargetOptions::default()).unwrap();
    let sole = Sole::new(&body, 0);
    assert!(sole.ankle_height > 0.05);
    let mut runs = Vec::new();
    for s in 0..2 {
        let (mut top, mut stood) = (0.0f64, false);
        for i in 0..r.clip.len() {
            let low = soles(&body, r.clip.posture(i))[s].1;
            assert!(low > -2e-3, "foot {s} at {low} m in sample {i}");
            if r.clip.planted(i)[s] {
                if top > 0.0 {
                    runs.push(top);
                }
                (top, stood) = (0.0, true);
            } else if stood {
                // A swing that the clip starts in is not whole.
                top = top.max(low);
            }
        }
    }
    assert!(
        runs.len() >= 4 && runs.iter().all(|t| *t > 0.03),
        "clearance of each swing: {runs:?}"
    );
}

#[test]
fn no_sole_is_in_the_floor_on_the_way_in_and_out_either() {
    let body = Body::adult_man();
    let options = RetargetOptions {
        preparation: Preparation::walking(true),
        ..RetargetOptions::default()
    };
    // Who lies has feet that nothing holds up.
    for name in CLIPS
        .iter()
        .filter(|n| !["get-up", "fall-rise"].contains(n))
    {
        let clip = take(&text(name), &body, &options).unwrap().clip;
        let low = |posture: &Posture| soles(&body, posture).map(|s| s.1);
        let lowest = clip
            .samples()
            .flat_map(|(posture, _)| low(posture))
            .fold(f64::INFINITY, f64::min);
        println!("{name}: {:.1} mm", 1e3 * lowest);
        // The right hip of salsa-b turns to its limit in a swing.
        let most = if *name == "salsa-b" { 0.016 } else { 0.005 };
        assert!(lowest > -most, "{name}: {lowest} m");
    }
}
