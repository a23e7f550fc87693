//! The content of a file is read back as it was written: joint positions, unit, axes, rate, bones.

use crate::corpus::dialect::{Dialect, file_axes, joint_points};
use crate::corpus::recorded::{Truth, all_fits, bvh, fits, man, motion, recordings};
use crate::corpus::tracks::DEG;
use sinew_physics::math::Vec3;
use sinew_physics::motion::Bvh;
use sinew_physics::plan::foot_lock::Sole;
use sinew_physics::reference::UpAxis;

/// Rounding of the files (0.005° and up to 0.5 mm) over the length of a limb, m.
const ROUNDING: f64 = 1e-3;

/// Places of the file's joints in one frame, m, world axes, and of the corresponding points of the actor.
fn places(name: &str, d: &Dialect, file: &Bvh, frame: usize) -> Vec<(String, Vec3, Vec3)> {
    let m = motion(name);
    let pose = m.recorded((frame - d.held) as f64 / d.rate);
    let back = file_axes(d).conjugate();
    let points = joint_points(d, &m.script.actor, &pose);
    assert_eq!(points.len(), file.joints.len(), "{name}.{}", d.name);
    points
        .into_iter()
        .zip(file.joints.iter().zip(file.world(frame)))
        .skip(usize::from(d.dead_root))
        .map(|((wanted, truth), (joint, pose))| {
            assert_eq!(wanted, joint.name, "{name}.{}", d.name);
            (wanted, back.rotate(pose.position * d.unit), truth)
        })
        .collect()
}

#[test]
fn joints_of_clean_files_are_where_the_actor_was() {
    let mut compared = 0;
    for (name, d) in recordings() {
        if d.faults.noise.0 > 0.0 {
            continue;
        }
        let file = bvh(name, d.name);
        for frame in (d.held..file.frame_count).step_by(3) {
            let places = places(name, &d, &file, frame);
            // Without positions of the root everything is relative to it.
            let shift = if d.name == "rot-only" {
                places[0].1 - places[0].2
            } else {
                Vec3::zero()
            };
            for (joint, is, truth) in places {
                let off = (is - shift - truth).norm();
                assert!(
                    off < ROUNDING,
                    "{name}.{} frame {frame} {joint}: off by {off} m",
                    d.name
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 50_000, "{compared} positions compared");
}

#[test]
fn noise_is_what_the_truth_says() {
    for (name, d) in recordings() {
        let (place, turn) = d.faults.noise;
        if place == 0.0 {
            continue;
        }
        // The knees seen from the root: noise of the root's and the hip's rotation over a thigh.
        let file = bvh(name, d.name);
        let (mut sum, mut count) = (0.0, 0.0f64);
        for frame in (0..file.frame_count).step_by(7) {
            let places = places(name, &d, &file, frame);
            let root = places[0].1 - places[0].2;
            for (joint, is, truth) in &places {
                if joint.ends_with("Knee") || joint.ends_with("knee") {
                    sum += (*is - root - *truth).dot(*is - root - *truth);
                    count += 1.0;
                }
            }
        }
        let rms = (sum / count).sqrt();
        let expected = motion(name).script.actor.thigh * turn * 2.0f64.sqrt();
        assert!(
            rms > 0.7 * expected && rms < 1.6 * expected,
            "{name}.{}: knees off by {rms} m rms, {expected} expected",
            d.name
        );
    }
}

#[test]
fn unit_axes_rate_and_bones_are_recognised_in_every_dialect() {
    for f in all_fits() {
        let (what, d, r) = (f.what(), &f.dialect, &f.fitted.report);
        let stature = f.motion.script.actor.stature();
        assert!(
            (r.size.unit_m / d.unit - 1.0).abs() < 1e-9,
            "{what}: unit {} m",
            r.size.unit_m
        );
        assert_eq!(
            r.size.up,
            if d.z_up { UpAxis::Z } else { UpAxis::Y },
            "{what}"
        );
        assert!(
            (r.frames.source_rate_hz / d.rate - 1.0).abs() < 1e-5,
            "{what}: {} Hz",
            r.frames.source_rate_hz
        );
        // Stature is guessed from legs and trunk; the actors have other proportions than the guess.
        assert!(
            (r.size.stature / stature - 1.0).abs() < 0.06,
            "{what}: stature {} m, {stature} in truth",
            r.size.stature
        );
        assert_eq!(
            r.skeleton.mapped.len(),
            18,
            "{what}: {:?}",
            r.skeleton.mapped
        );
        assert!(
            r.skeleton.missing.is_empty() && !r.skeleton.by_structure && !r.skeleton.sides_swapped,
            "{what}: {:?}",
            r.warnings
        );
    }
}

#[test]
fn the_floor_is_found() {
    let ankle = Sole::new(&man(), 0).ankle_height;
    for f in fits() {
        let r = &f.fitted.report;
        // The report measures from the height of the body's ankle at the recording's size; the actor's ankle is higher.
        let expected = f.dialect.faults.floor + f.motion.script.actor.ankle - ankle / r.size.scale;
        let off = r.place.floor_offset - expected;
        assert!(
            off.abs() < 3e-3,
            "{}: floor at {} m, off by {off} m",
            f.what(),
            r.place.floor_offset
        );
    }
}

#[test]
fn only_the_run_is_taken_for_one() {
    for f in fits() {
        assert_eq!(
            f.fitted.report.runs.speed.is_some(),
            f.motion.script.kind == "run",
            "{}: {:?}",
            f.what(),
            f.fitted.report.runs.speed
        );
    }
}

#[test]
fn a_truth_file_says_how_its_recordings_are_written() {
    for (name, d) in recordings() {
        let truth = Truth::of(name);
        let files = truth.0["files"].as_array().unwrap();
        let file = files.iter().find(|f| f["dialect"] == d.name).unwrap();
        let number = |k: &str| file[k].as_f64().unwrap();
        let read = bvh(name, d.name);
        assert_eq!(
            number("frames") as usize,
            read.frame_count,
            "{name}.{}",
            d.name
        );
        assert!((number("unit_m") / d.unit - 1.0).abs() < 1e-6);
        assert_eq!(number("first_frame") as usize, d.held);
        assert!((number("rate_hz") * read.frame_time - 1.0).abs() < 1e-5);
        let recorded = (read.frame_count - d.held - 1) as f64 / d.rate;
        let left = truth.number("duration_s") - recorded;
        assert!(
            (0.0..1.0 / d.rate).contains(&(left + 1e-9)),
            "{name}.{}: {left} s are missing",
            d.name
        );
        assert!((number("noise_deg") - d.faults.noise.1 / DEG).abs() < 1e-6);
    }
}
