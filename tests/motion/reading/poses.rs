//! Poses at the start that are not part of the motion.

use crate::reading::file::{File, bare, motion, turned};
use sinew_physics::body::Body;
use sinew_physics::body::topology::{L_UPPER_ARM, R_FOREARM};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::plan::PreparedRecording;

/// The motion `name` with the figure turned by 120° about the vertical.
fn turned_file(body: &Body, name: &str) -> File {
    let turn = Quat::exp(Vec3::Z * 120f64.to_radians());
    File::new(body, &turned(&motion(body, name), turn))
}

/// The same postures from the same frame of the file on, within `most` m and 5 cm.
fn same(plain: &PreparedRecording, other: &PreparedRecording, later: usize) {
    for i in (0..other.clip.len()).step_by(7) {
        let (a, b) = (plain.clip.posture(i + later), other.clip.posture(i));
        let up = b.root_rotation.rotate(Vec3::Z).z;
        assert!(up > 0.8, "sample {i}: the pelvis points {up} up");
        let height = (a.root_position.z - b.root_position.z).abs();
        assert!(height < 0.02, "sample {i}: pelvis {height} m off");
    }
}

#[test]
fn a_rest_pose_that_only_the_root_shows_is_left_out() {
    let body = Body::adult_man();
    for name in ["idle", "walk"] {
        let file = turned_file(&body, name);
        let plain = file.read(&body, &bare());
        for held in [1, 50] {
            let mut with = file.clone();
            // The motion's own pose, but with the root as in the rest pose.
            let mut pose = file.rows[0].clone();
            pose[3..6].fill(0.0);
            for _ in 0..held {
                with.rows.insert(0, pose.clone());
            }
            let r = with.read(&body, &bare());
            assert_eq!(r.report.frames.skipped_frames, held, "{name}");
            assert!(
                r.report.warnings.iter().any(|w| w.contains("hold a pose")),
                "{name}"
            );
            same(&plain, &r, 0);
        }
    }
}

#[test]
fn a_rest_pose_that_is_blended_into_the_motion_is_left_out() {
    let body = Body::adult_man();
    let mut file = turned_file(&body, "walk");
    let plain = file.read(&body, &bare());
    // The shoulders are 30° off in the first frame and come in over five, as in files of DAZ Studio.
    let rest = file.rest_row();
    for (i, left) in [1.0, 0.75, 0.5, 0.3, 0.1].into_iter().enumerate() {
        for s in [L_UPPER_ARM, R_FOREARM] {
            let column = 3 + 3 * s.index();
            file.rows[i][column] += 60.0 * left;
        }
    }
    file.rows[0] = rest;
    let r = file.read(&body, &bare());
    let skipped = r.report.frames.skipped_frames;
    assert!((1..=7).contains(&skipped), "{skipped} frames");
    same(&plain, &r, skipped);
}

#[test]
fn motion_that_begins_at_once_is_kept() {
    let body = Body::adult_man();
    // In the middle of a step, and an arm that shoots forward by 90° in 0.15 s after it has hung still.
    let walk = motion(&body, "walk");
    let cut = File::new(&body, &walk[walk.len() / 3..]);
    let mut punch = File::new(&body, &motion(&body, "idle"));
    punch.rows.truncate(240);
    for rate in [120usize, 24] {
        let mut punch = punch.clone();
        let stride = 120 / rate;
        punch.rows = punch.rows.into_iter().step_by(stride).collect();
        punch.rate = rate as f64;
        for (i, row) in punch.rows.iter_mut().enumerate() {
            let u = ((i as f64 / rate as f64 - 0.5) / 0.15).clamp(0.0, 1.0);
            row[3 + 3 * L_UPPER_ARM.index() + 1] -= 90.0 * u * u * (3.0 - 2.0 * u);
        }
        assert_eq!(
            punch.read(&body, &bare()).report.frames.skipped_frames,
            0,
            "{rate} Hz"
        );
    }
    assert_eq!(cut.read(&body, &bare()).report.frames.skipped_frames, 0);
}

#[test]
fn frames_in_which_all_channels_are_zero_are_bridged() {
    let body = Body::adult_man();
    let file = turned_file(&body, "walk");
    let plain = file.read(&body, &bare());
    let mut holes = file.clone();
    for i in [200, 201, 330] {
        holes.rows[i].fill(0.0);
    }
    let r = holes.read(&body, &bare());
    let root: Vec<(usize, usize)> = (r.report.frames.bridged.iter())
        .filter(|b| b.bone == "hips")
        .map(|b| (b.first, b.count))
        .collect();
    assert!(
        root.contains(&(200, 2)) && root.contains(&(330, 1)),
        "{root:?}"
    );
    same(&plain, &r, 0);
}
