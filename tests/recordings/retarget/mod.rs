//! Goal: real recordings become motions that a body can follow, whatever dialect they are written in. Method: all 18
//! clips on two bodies, checked against the statistics that come with the clips and against forward kinematics of the
//! result (`feet`, `balance`); and one clip rewritten (`source`) into other dialects and with faults, which must give
//! the same motion (`dialects`, `faults`).

mod balance;
mod dialects;
mod faults;
mod feet;
mod source;

use crate::common::mocap::{self, CLIPS};
use sinew_physics::body::Body;
use sinew_physics::body::angles::anatomical_angles;
use sinew_physics::body::topology::{DOF_NAMES, L_FOOT, L_THIGH, R_FOOT, R_THIGH};
use sinew_physics::math::Vec3;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::motion::{Bvh, read};
use sinew_physics::plan::PreparedRecording;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::Preparation;
use sinew_physics::reference::{RetargetError, RetargetOptions, UpAxis};

fn text(name: &str) -> String {
    String::from_utf8(mocap::read(&format!("{name}.bvh"))).unwrap()
}

fn stats() -> serde_json::Value {
    serde_json::from_slice(&mocap::read("stats.json")).unwrap()
}

fn take(
    text: &str,
    body: &Body,
    options: &RetargetOptions,
) -> Result<PreparedRecording, RetargetError> {
    prepare_recording(&read(text.as_bytes())?, body, options)
}

/// Largest difference of two motions: pelvis (m) and joint angles (rad), first samples of the second left out.
fn difference(a: &PreparedRecording, b: &PreparedRecording) -> (f64, f64) {
    assert_eq!(a.clip.len(), b.clip.len());
    let mut worst = (0.0f64, 0.0f64);
    for i in 0..a.clip.len() {
        let (p, q) = (a.clip.posture(i), b.clip.posture(i));
        worst.0 = worst.0.max((p.root_position - q.root_position).norm());
        for e in p.joint_difference(q) {
            worst.1 = worst.1.max(e.abs());
        }
    }
    worst
}

#[track_caller]
fn same(a: &PreparedRecording, b: &PreparedRecording, what: &str) {
    let d = difference(a, b);
    assert!(
        d.0 < 2e-3 && d.1 < 0.01,
        "{what}: pelvis off by {} m, joints by {} rad",
        d.0,
        d.1
    );
}

#[test]
fn every_clip_becomes_a_motion_of_every_body() {
    let stats = stats();
    for body in [Body::adult_man(), Body::adult_woman()] {
        for name in CLIPS {
            let r = take(
                &text(name),
                &body,
                &RetargetOptions {
                    name: name.into(),
                    ..Default::default()
                },
            )
            .unwrap();
            let (clip, report) = (&r.clip, &r.report);
            let known = &stats[name];
            assert_eq!(clip.name(), name);
            assert!(clip.rate_hz() >= 59.0);
            let seconds = known["seconds"].as_f64().unwrap();
            assert!(
                (clip.duration() - seconds).abs() < 0.06,
                "{name}: {} s",
                clip.duration()
            );
            assert!(
                (report.size.unit_m / known["scale_m_per_unit"].as_f64().unwrap() - 1.0).abs()
                    < 1e-3,
                "{name}: unit {}",
                report.size.unit_m
            );
            assert_eq!(report.size.up, UpAxis::Y, "{name}");
            assert!(
                !report.skeleton.sides_swapped && !report.skeleton.by_structure,
                "{name}"
            );
            assert!(
                (1.3..2.0).contains(&report.size.stature),
                "{name}: {}",
                report.size.stature
            );
            assert!(
                report.skeleton.mapped.len() + report.skeleton.missing.len() >= 18,
                "{name}: {:?}",
                report.skeleton.mapped
            );
            assert!(
                report
                    .joints
                    .knee_off_axis
                    .iter()
                    .chain(&report.joints.elbow_off_axis)
                    .all(|a| *a < 0.35),
                "{name}"
            );

            // Starts at the origin, facing +x; left is left.
            let first = clip.posture(0);
            let pelvis = first.root_rotation.rotate(Vec3::X);
            assert!(
                pelvis.y.abs() < 0.02 && pelvis.x > 0.0 || pelvis.z.abs() > 0.9,
                "{name}: faces {pelvis:?}"
            );
            // Balance moves it by up to 12 cm; a runner's mass stays farther back, limited by the ankle torque at a
            // load of 2.7 weights (docs/locomotion.md#runs).
            let moved = if name == "run" { 0.2 } else { 0.13 };
            assert!(
                first.root_position.x.hypot(first.root_position.y) < moved,
                "{name}: {:?}",
                first.root_position
            );
            let mut left = 0.0;
            for i in 0..clip.len() {
                let p = clip.posture(i);
                assert!(p.is_finite(), "{name} sample {i}");
                let poses = forward(&body, p);
                let across = p.root_rotation.rotate(Vec3::Y);
                left += (poses[L_FOOT.index()].0 - poses[R_FOOT.index()].0)
                    .dot(across)
                    .signum();
                assert!((poses[L_THIGH.index()].0 - poses[R_THIGH.index()].0).dot(across) > 0.0);
                for (d, a) in anatomical_angles(p).iter().enumerate() {
                    assert!(
                        *a >= body.lower[d] - 1e-9 && *a <= body.upper[d] + 1e-9,
                        "{name} sample {i}: {} at {a} rad",
                        DOF_NAMES[d]
                    );
                }
            }
            // The dancer stands with one foot crossed behind the other for most of the clip.
            assert!(
                left > 0.5 * clip.len() as f64 || name == "dance",
                "{name}: the left foot is on the left: {left} of {}",
                clip.len()
            );
        }
    }
}

#[test]
fn two_people_of_one_recording_keep_their_distance() {
    let body = Body::adult_man();
    let options = RetargetOptions {
        keep_origin: true,
        preparation: Preparation {
            balance: false,
            ..Preparation::default()
        },
        ..Default::default()
    };
    let [a, b] = ["salsa-a", "salsa-b"].map(|n| take(&text(n), &body, &options).unwrap());
    let gap = |i: usize| {
        let d = a.clip.posture(i).root_position - b.clip.posture(i).root_position;
        d.x.hypot(d.y)
    };
    let files = ["salsa-a", "salsa-b"].map(|n| Bvh::parse(text(n).as_bytes()).unwrap());
    for i in [0, 150, 300, 590] {
        let [p, q] = [0, 1].map(|k: usize| files[k].world(i)[0].position * 0.01);
        let recorded = (p.x - q.x).hypot(p.z - q.z);
        assert!(
            (gap(i) - recorded).abs() < 0.12,
            "frame {i}: {} against {recorded} m",
            gap(i)
        );
    }
    let o = a.report.place.origin;
    let at = a.clip.posture(0).root_position;
    assert!((at.x - o.x).hypot(at.y - o.y) < 0.02, "{at:?} {o:?}");
}
