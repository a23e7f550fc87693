//! Symmetries: a prepared motion depends neither on which side is left nor on the direction of north. Method: mirrored
//! and turned files, and stops, transitions and loops of the resulting motions, sample by sample.

use crate::corpus::dialect::{self, dialect};
use crate::corpus::plan::Motion;
use crate::corpus::plans;
use crate::corpus::recorded::{RetargetOptions, bvh, man, motion, motions};
use sinew_physics::body::Posture;
use sinew_physics::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::plan::PreparedRecording;
use sinew_physics::plan::prepare_recording;
use std::sync::Arc;

/// Differences that rounding in a file leaves, and that preparation does not enlarge: pelvis, m, and angles, degrees.
const SAME: (f64, f64) = (2e-3, 0.3);
/// The same for runs: the load decides whether a runner's foot carries in a sample, and one more or less sample of
/// stance moves the foot that pushes off.
const SAME_RUN: (f64, f64) = (5e-3, 2.0);

fn fit(bvh: &Bvh) -> PreparedRecording {
    prepare_recording(
        &bvh.recording().unwrap(),
        &man(),
        &RetargetOptions::default(),
    )
    .unwrap()
}

/// The mirror image of a posture: y and −y, left and right are exchanged.
fn mirrored(p: &Posture) -> Posture {
    let a = anatomical_angles(p);
    let other = |name: &str| match name.split_at(2) {
        ("l_", rest) => format!("r_{rest}"),
        ("r_", rest) => format!("l_{rest}"),
        _ => name.to_owned(),
    };
    let angles: [f64; DOF_COUNT] = std::array::from_fn(|k| {
        let name = DOF_NAMES[k];
        let from = DOF_NAMES.iter().position(|n| *n == other(name)).unwrap();
        // Limbs are signed alike on both sides; the trunk leans and turns the other way.
        let central = !(name.starts_with("l_") || name.starts_with("r_"));
        if central && (name.ends_with("lateral") || name.ends_with("rotation")) {
            -a[from]
        } else {
            a[from]
        }
    });
    let (r, q) = (p.root_position, p.root_rotation);
    let mut out = Posture {
        root_position: Vec3 { y: -r.y, ..r },
        root_rotation: Quat {
            x: -q.x,
            z: -q.z,
            ..q
        },
        ..Posture::default()
    };
    set_anatomical_angles(&mut out, &angles);
    out
}

/// The mirror image of a motion.
fn mirror(clip: &Clip) -> Clip {
    let (postures, planted) = clip
        .samples()
        .map(|(p, [left, right])| (mirrored(p), [right, left]))
        .unzip();
    let samples = |seconds: f64| (seconds * clip.rate_hz()).round() as usize;
    Clip::from_postures(clip.name(), clip.rate_hz(), postures, planted)
        .unwrap()
        .with_ends(samples(clip.lead_in()), samples(clip.lead_out()))
}

/// The motion turned about the vertical through the origin, and moved.
fn turned(clip: &Clip, yaw: f64, by: Vec3) -> Clip {
    let turn = Quat::exp(Vec3::Z * yaw);
    let (postures, planted) = clip
        .samples()
        .map(|(p, planted)| {
            let p = Posture {
                root_position: turn.rotate(p.root_position) + by,
                root_rotation: turn * p.root_rotation,
                ..*p
            };
            (p, planted)
        })
        .unzip();
    let samples = |seconds: f64| (seconds * clip.rate_hz()).round() as usize;
    Clip::from_postures(clip.name(), clip.rate_hz(), postures, planted)
        .unwrap()
        .with_ends(samples(clip.lead_in()), samples(clip.lead_out()))
}

/// Largest differences: pelvis position (m) and orientation, joint angles (degrees).
fn difference(p: &Posture, q: &Posture) -> (f64, f64) {
    let turn = (p.root_rotation.conjugate() * q.root_rotation).log().norm();
    let (a, b) = (anatomical_angles(p), anatomical_angles(q));
    let joints = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    let most = joints.fold(turn, f64::max).to_degrees();
    ((p.root_position - q.root_position).norm(), most)
}

/// Checks that the two motions are the same, with their lead-in and lead-out.
#[track_caller]
fn same(a: &Clip, b: &Clip, what: &str) {
    same_within(a, b, SAME, what);
}

#[track_caller]
fn same_within(a: &Clip, b: &Clip, most: (f64, f64), what: &str) {
    assert_eq!(a.samples().len(), b.samples().len(), "{what}");
    let mut worst = (0.0f64, 0.0f64);
    for ((p, _), (q, _)) in a.samples().zip(b.samples()) {
        let (far, off) = difference(p, q);
        worst = (worst.0.max(far), worst.1.max(off));
    }
    let feet = a.samples().zip(b.samples());
    let feet = feet.filter(|(a, b)| a.1 != b.1).count();
    println!(
        "{what}: {:.2e} m, {:.2e} deg, {feet} feet",
        worst.0, worst.1
    );
    assert!(
        worst.0 < most.0 && worst.1 < most.1,
        "{what}: {worst:?} (m, degrees)"
    );
    // A foot may stand one sample longer on one side.
    assert!(
        feet <= 1 + a.samples().len() / 100,
        "{what}: other feet stand in {feet} samples"
    );
}

/// Differences of a motion that are allowed.
fn most(motion: &Motion) -> (f64, f64) {
    match motion.script.kind {
        "run" => SAME_RUN,
        _ => SAME,
    }
}

#[test]
fn a_mirrored_recording_gives_the_mirrored_motion() {
    for m in motions() {
        let name = m.script.name.as_str();
        let file = bvh(name, "vrm");
        let (plain, mirrored) = (fit(&file), fit(&file.mirrored()));
        // The names stay, so segments named left are on the right.
        assert!(mirrored.report.skeleton.sides_swapped, "{name}");
        same_within(&mirror(&plain.clip), &mirrored.clip, most(m), name);
    }
}

#[test]
fn a_turned_recording_gives_the_same_motion() {
    for m in motions() {
        let name = m.script.name.as_str();
        let plain = fit(&bvh(name, "vrm"));
        for facing in [90.0, -147.0] {
            let mut d = dialect("vrm");
            d.rate = plain.report.frames.source_rate_hz.round();
            d.facing = facing;
            let other = fit(&Bvh::parse(&dialect::write(motion(name), &d, 1)).unwrap());
            let what = format!("{name} turned by {facing}°");
            same_within(&plain.clip, &other.clip, most(m), &what);
        }
    }
}

/// A clip unchanged, mirrored, and turned and moved, each with its inverse.
fn images(clip: &Clip) -> [(&'static str, Arc<Clip>, fn(&Clip) -> Clip); 2] {
    const YAW: f64 = 2.1;
    const BY: Vec3 = Vec3 {
        x: 40.0,
        y: -25.0,
        z: 0.0,
    };
    let back = |c: &Clip| turned(&turned(c, 0.0, -BY), -YAW, Vec3::zero());
    [
        (
            "mirrored",
            Arc::new(mirror(clip)),
            mirror as fn(&Clip) -> Clip,
        ),
        ("turned", Arc::new(turned(clip, YAW, BY)), back),
    ]
}

#[test]
fn a_mirrored_or_turned_motion_stops_alike() {
    let body = Arc::new(man());
    for name in plans::walks() {
        let clip = plans::strides(name);
        for at in plans::moments(&clip, 3) {
            let plain = plans::stop(&body, &clip, at);
            for (how, image, back) in images(&clip) {
                let what = format!("{name} {how}, stopped at {at:.2} s");
                let other = plans::stop(&body, &image, at);
                assert_eq!(plain.is_some(), other.is_some(), "{what}");
                if let (Some(a), Some(b)) = (&plain, &other) {
                    same(&a.clip, &back(&b.clip), &what);
                }
            }
        }
    }
}

#[test]
fn a_mirrored_or_turned_motion_repeats_alike() {
    for name in plans::walks() {
        let clip = plans::strides(name);
        let plain = plans::repeated(&clip);
        for (how, image, back) in images(&clip) {
            let what = format!("{name} {how}, repeated");
            same(&plain, &back(&plans::repeated(&image)), &what);
        }
    }
}

#[test]
fn a_mirrored_or_turned_motion_goes_over_alike() {
    let body = Arc::new(man());
    let [walk, arc] = ["walk-normal", "walk-arc"].map(plans::strides);
    let mut over = 0;
    for at in plans::moments(&walk, 6) {
        let plain = plans::way_over(&body, &walk, at, &arc);
        over += usize::from(plain.is_some());
        let pairs = images(&walk).into_iter().zip(images(&arc));
        for ((how, first, back), (_, second, _)) in pairs {
            let what = format!("from walk-normal at {at:.2} s to walk-arc, {how}");
            let other = plans::way_over(&body, &first, at, &second);
            assert_eq!(plain.is_some(), other.is_some(), "{what}");
            if let (Some(a), Some(b)) = (&plain, &other) {
                same(&a.left.clip, &back(&b.left.clip), &what);
            }
        }
    }
    assert!(over >= 3, "{over} ways of 6");
}
