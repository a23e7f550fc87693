//! Goal: built-in motions are physical plans for any body. Method: forward kinematics of every sample, for four people.

use super::*;
use crate::body::angles::anatomical_angles;
use crate::body::topology::{
    DOF_COUNT, DOF_NAMES, L_FOOT, L_TOES, R_FOOT, R_HAND, R_TOES, SEGMENT_COUNT,
};
use crate::body::{Profile, Sex};
use crate::math::{Quat, Vec3};
use crate::motion::leg_ik::{center_of_mass, forward};

type Poses = [(Vec3, Quat); SEGMENT_COUNT];

fn people() -> Vec<Body> {
    let person = |sex, height, mass| {
        Body::humanoid(Profile {
            sex,
            age: 40.0,
            height,
            mass,
        })
        .unwrap()
    };
    vec![
        Body::adult_man(),
        Body::adult_woman(),
        person(Sex::Female, 1.45, 90.0),
        person(Sex::Male, 2.05, 80.0),
    ]
}

fn sole(body: &Body, poses: &Poses, side: usize) -> Vec<Vec3> {
    [[L_FOOT, L_TOES], [R_FOOT, R_TOES]][side]
        .iter()
        .flat_map(|s| {
            let (position, rotation) = poses[s.index()];
            let points = &body.segments[s.index()].contact_points;
            points.iter().map(move |p| position + rotation.rotate(*p))
        })
        .collect()
}

/// Distance of `c` to the nearest edge of the convex hull of points that touch the floor; negative outside.
fn margin(points: &[Vec3], c: Vec3) -> f64 {
    let floor: Vec<Vec3> = points.iter().copied().filter(|p| p.z < 0.004).collect();
    let mut least = f64::INFINITY;
    for a in &floor {
        for b in &floor {
            let (ex, ey) = (b.x - a.x, b.y - a.y);
            let length = ex.hypot(ey);
            if length < 1e-6 {
                continue;
            }
            let left = |p: &Vec3| (ex * (p.y - a.y) - ey * (p.x - a.x)) / length;
            if floor.iter().all(|p| left(p) > -1e-9) {
                least = least.min(left(&c));
            }
        }
    }
    least
}

#[test]
fn every_name_gives_a_smooth_clip_within_limits() {
    assert!(builtin(&Body::adult_man(), "dance").is_none());
    for body in people() {
        for name in BUILTIN_NAMES {
            let clip = builtin(&body, name).unwrap();
            assert!(clip.duration() > 3.0 && clip.name() == name);
            for i in 0..clip.len() {
                let t = i as f64 / RATE;
                let target = clip.sample(t);
                let angles = anatomical_angles(&target.posture);
                for d in 0..DOF_COUNT {
                    let (lower, upper) = (body.lower[d], body.upper[d]);
                    assert!(
                        angles[d] > lower - 1e-9 && angles[d] < upper + 1e-9,
                        "{name} {t:.2} s, {} m: {} is {:.1}°",
                        body.profile.height,
                        DOF_NAMES[d],
                        angles[d].to_degrees()
                    );
                    let (v, a) = (target.velocity[6 + d], target.acceleration[6 + d]);
                    assert!(
                        v.abs() < 14.0,
                        "{name} {t:.2} s: {} {v:.1} rad/s",
                        DOF_NAMES[d]
                    );
                    assert!(
                        a.abs() < 320.0,
                        "{name} {t:.2} s: {} {a:.0} rad/s²",
                        DOF_NAMES[d]
                    );
                }
                assert!(
                    target.acceleration[3..6].iter().all(|a| a.abs() < 10.0),
                    "{name} {t:.2}"
                );
            }
            let ends = [clip.sample(0.0), clip.sample(clip.duration() - 1e-9)];
            for end in ends {
                assert!(
                    end.velocity.iter().all(|v| v.abs() < 0.05),
                    "{name} starts and ends at rest"
                );
            }
        }
    }
}

#[test]
fn standing_motions_keep_their_feet_and_their_balance() {
    for body in people() {
        for name in ["idle", "lift", "squat", "wave"] {
            let clip = builtin(&body, name).unwrap();
            let start = forward(&body, clip.posture(0));
            for i in 0..clip.len() {
                let poses = forward(&body, clip.posture(i));
                assert_eq!(clip.planted(i), [true; 2]);
                let mut points = Vec::new();
                for side in 0..2 {
                    let now = sole(&body, &poses, side);
                    for (a, b) in now.iter().zip(sole(&body, &start, side)) {
                        assert!((*a - b).norm() < 1e-9, "{name}: sole moves at {i}");
                        assert!(a.z.abs() < 1e-9, "{name}: sole at {:e}", a.z);
                    }
                    points.extend(now);
                }
                let com = center_of_mass(&body, &poses);
                let room = margin(&points, com);
                assert!(room > 0.03, "{name} {i}: {room} m");
                let ahead = com.x - poses[L_FOOT.index()].0.x;
                assert!(
                    (0.03..0.06).contains(&ahead),
                    "{name}: {ahead} m before the ankles"
                );
            }
        }
    }
}

#[test]
fn the_lift_reaches_object_and_shelf() {
    for body in people() {
        let clip = builtin(&body, "lift").unwrap();
        let scale = shape::Measures::of(&body).scale;
        let off = |t: f64, wanted: [f64; 3]| {
            let (p, r) = forward(&body, &clip.sample(t).posture)[R_HAND.index()];
            let hand = (p + r.rotate(shape::grip(&body))) * (1.0 / scale);
            (hand - Vec3::from_array(wanted)).norm()
        };
        for t in [LIFT_GRASP - 0.2, LIFT_GRASP] {
            assert!(
                off(t, [0.46, -0.16, 0.50]) < 1e-6,
                "{} m",
                body.profile.height
            );
        }
        assert!(
            off(clip.duration(), [0.58, -0.20, 1.28]) < 1e-6,
            "{} m",
            body.profile.height
        );
    }
}

#[test]
fn steps_stand_on_the_floor_and_swing_above_it() {
    for body in people() {
        for name in ["step", "walk"] {
            let clip = builtin(&body, name).unwrap();
            let mut held: [Option<Vec3>; 2] = [None; 2];
            for i in 0..clip.len() {
                let poses = forward(&body, clip.posture(i));
                assert!(clip.planted(i) != [false; 2], "one foot always stands");
                for side in 0..2 {
                    let points = sole(&body, &poses, side);
                    let lowest = points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
                    assert!(lowest > -1e-3, "{name} {i}: sole at {lowest}");
                    if !clip.planted(i)[side] {
                        held[side] = None;
                        continue;
                    }
                    assert!(lowest < 1e-3, "{name} {i}: planted sole at {lowest}");
                    // Flat: the sole does not move at all. Rolling: heel or toes do.
                    let flat = points.iter().all(|p| p.z.abs() < 1e-7);
                    if flat {
                        let at = points[0];
                        let before = *held[side].get_or_insert(at);
                        assert!((at - before).norm() < 1e-6, "{name} {i}: slides");
                    }
                }
            }
        }
        let walk = builtin(&body, "walk").unwrap();
        let end = walk.posture(walk.len() - 1).root_position;
        let start = walk.posture(0).root_position;
        let scale = shape::Measures::of(&body).scale;
        assert!((end.x - start.x - 2.3 * scale).abs() < 0.01 && (end.y - start.y).abs() < 1e-3);
        let step = builtin(&body, "step").unwrap();
        let end = step.posture(step.len() - 1).difference(step.posture(0));
        assert!(
            end.iter().all(|e| e.abs() < 2e-3),
            "steps end where they began"
        );
    }
}

#[test]
fn the_zero_moment_point_of_stepping_stays_under_the_feet() {
    // Point masses at the segments' centres: p = x − z ẍ / (z̈ + g), summed over segments.
    let body = Body::adult_man();
    for name in ["step", "walk"] {
        let clip = builtin(&body, name).unwrap();
        let centers = |i: usize| {
            let poses = forward(&body, clip.posture(i));
            let of = |s: usize| poses[s].0 + poses[s].1.rotate(body.segments[s].com);
            std::array::from_fn::<Vec3, SEGMENT_COUNT, _>(of)
        };
        let mut worst = f64::INFINITY;
        for i in 2..clip.len() - 2 {
            let (a, b, c) = (centers(i - 2), centers(i), centers(i + 2));
            let h = 2.0 / RATE;
            let (mut px, mut py, mut weight) = (0.0, 0.0, 0.0);
            for s in 0..SEGMENT_COUNT {
                let acc = (a[s] - b[s] * 2.0 + c[s]) * (1.0 / (h * h));
                let m = body.segments[s].mass;
                px += m * (b[s].x * (acc.z + 9.81) - b[s].z * acc.x);
                py += m * (b[s].y * (acc.z + 9.81) - b[s].z * acc.y);
                weight += m * (acc.z + 9.81);
            }
            let point = Vec3 {
                x: px / weight,
                y: py / weight,
                z: 0.0,
            };
            let poses = forward(&body, clip.posture(i));
            let points: Vec<Vec3> = (0..2)
                .filter(|side| clip.planted(i)[*side])
                .flat_map(|side| {
                    let mut p = sole(&body, &poses, side);
                    p.iter_mut()
                        .for_each(|p| p.z = if p.z < 0.06 { 0.0 } else { p.z });
                    p
                })
                .collect();
            worst = worst.min(margin(&points, point));
        }
        assert!(worst > 0.015, "{name}: {worst} m");
    }
}
