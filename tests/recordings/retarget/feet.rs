//! Standing feet neither slide nor sink. The times of their stance are tested on recordings with known truth
//! (`tests/corpus`).

use super::{take, text};
use crate::common::mocap::CLIPS;
use sinew_physics::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::body::{Body, Posture};
use sinew_physics::math::Vec3;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::reference::{Preparation, RetargetOptions};

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
                r.report.feet.slide.prepared < 1e-3 && r.report.feet.penetration.prepared < 1e-3,
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

#[test]
fn no_sole_is_in_the_floor_on_the_way_in_and_out_either() {
    let body = Body::adult_man();
    let options = RetargetOptions {
        preparation: Preparation::walking(true),
        ..RetargetOptions::default()
    };
    // The feet of a lying body carry nothing.
    for name in CLIPS
        .iter()
        .filter(|n| !["get-up", "fall-rise"].contains(n))
    {
        let clip = take(&text(name), &body, &options).unwrap().clip;
        let low = |posture: &Posture| soles(&body, posture).map(|s| s.1);
        let all: Vec<f64> = clip.samples().flat_map(|(p, _)| low(p)).collect();
        let lowest = all.iter().copied().fold(f64::INFINITY, f64::min);
        let in_floor = all.iter().filter(|z| **z < -5e-3).count() as f64 / all.len() as f64;
        println!("{name}: {:.1} mm, {in_floor:.4}", 1e3 * lowest);
        // A hip that turns to its limit in a swing leaves no other path for its foot.
        assert!(
            lowest > -0.016 && in_floor < 0.005,
            "{name}: {lowest} m, {in_floor}"
        );
    }
}
