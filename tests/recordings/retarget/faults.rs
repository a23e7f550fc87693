//! Recordings with faults: poses before the motion, glitches, few frames, wrong frame times, and unusable files.

use super::source::Source;
use super::{same, take, text};
use sinew_physics::body::Body;
use sinew_physics::motion::RecordingError;
use sinew_physics::reference::{FileFacts, RetargetError, RetargetOptions};

#[test]
fn poses_before_the_motion_and_glitches_are_taken_out() {
    let body = Body::adult_man();
    let source = Source::read("walk");
    let plain = take(&source.text(), &body, &RetargetOptions::default()).unwrap();
    for held in [1, 60] {
        let r = take(
            &source.clone().with_t_pose(held).text(),
            &body,
            &RetargetOptions::default(),
        )
        .unwrap();
        assert_eq!(r.report.frames.skipped_frames, held);
        assert!(r.report.warnings.iter().any(|w| w.contains("hold a pose")));
        same(&plain, &r, "T-pose first");
    }
    // One frame of the left foot and two of the right arm are thrown off.
    let names: Vec<String> = source
        .header
        .iter()
        .filter_map(|l| l.strip_prefix("ROOT ").or_else(|| l.strip_prefix("JOINT ")))
        .map(str::to_owned)
        .collect();
    let column = |bone: &str| 3 + 3 * names.iter().position(|n| n == bone).unwrap();
    let mut bad = source.clone();
    bad.rows[150][column("LeftFoot") + 2] += 120.0;
    for f in [200, 201] {
        bad.rows[f][column("RightArm") + 1] += 60.0;
    }
    let r = take(&bad.text(), &body, &RetargetOptions::default()).unwrap();
    let found: Vec<(&str, usize, usize)> = r
        .report
        .frames
        .bridged
        .iter()
        .map(|b| (b.bone.as_str(), b.first, b.count))
        .collect();
    assert_eq!(found, [("LeftFoot", 150, 1), ("RightArm", 200, 2)]);
    same(&plain, &r, "glitches");
}

#[test]
fn slow_recordings_become_smooth_and_wrong_frame_times_can_be_corrected() {
    let body = Body::adult_man();
    let mut slow = Source::read("walk");
    slow.rows = slow.rows.into_iter().step_by(5).collect();
    slow.frame_time *= 5.0;
    let r = take(&slow.text(), &body, &RetargetOptions::default()).unwrap();
    assert!((r.report.frames.source_rate_hz - 24.0).abs() < 0.01 && r.clip.rate_hz() == 120.0);
    let plain = take(&text("walk"), &body, &RetargetOptions::default()).unwrap();
    for i in (30..plain.clip.len().min(r.clip.len()) - 30).step_by(10) {
        let d = (plain.clip.posture(i).root_position - r.clip.posture(i).root_position).norm();
        // Every fifth sample ends 20 ms sooner, at 1.2 m/s; its lead-out is planned from there and begins within the
        // clip.
        let most = if i + 100 < plain.clip.len() {
            0.02
        } else {
            0.03
        };
        assert!(d < most, "sample {i}: {d}");
    }
    let half = RetargetOptions {
        file: FileFacts {
            rate_hz: Some(60.0),
            ..FileFacts::default()
        },
        ..Default::default()
    };
    let r = take(&text("walk"), &body, &half).unwrap();
    assert!((r.clip.duration() - 2.0 * plain.clip.duration()).abs() < 0.02);
}

#[test]
fn errors_name_what_is_missing() {
    let body = Body::adult_man();
    let source = Source::read("walk");
    let go = |s: &Source, o: &RetargetOptions| take(&s.text(), &body, o).map(|_| ()).unwrap_err();
    let auto = RetargetOptions::default();
    let e = go(&source.clone().scaled(3.3), &auto);
    assert!(
        matches!(e, RetargetError::Unit { measured } if (80.0..120.0).contains(&measured)),
        "{e}"
    );
    let e = go(
        &source,
        &RetargetOptions {
            file: FileFacts {
                unit_m: Some(1.0),
                ..FileFacts::default()
            },
            ..Default::default()
        },
    );
    assert!(
        e.to_string().contains("unit_m = 1") && e.to_string().contains("file units"),
        "{e}"
    );
    let e = go(
        &source,
        &RetargetOptions {
            file: FileFacts {
                rate_hz: Some(5000.0),
                ..FileFacts::default()
            },
            ..Default::default()
        },
    );
    assert!(e.to_string().contains("5000"), "{e}");
    let e = go(
        &source,
        &RetargetOptions {
            cutoff_hz: f64::NAN,
            ..Default::default()
        },
    );
    assert!(e.to_string().contains("cutoff_hz"), "{e}");
    for tempo in [f64::NAN, 0.4, 2.1] {
        let options = RetargetOptions {
            tempo,
            ..Default::default()
        };
        let e = go(&source, &options);
        assert!(e.to_string().contains("tempo"), "{e}");
    }
    let mut one = source.clone();
    one.rows.truncate(1);
    assert!(matches!(
        go(&one, &auto),
        RetargetError::Recording(RecordingError::TooShort(1))
    ));
    let stick = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT LeftArm\n{\n\
        OFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n}\nMOTION\nFrames: 2\n\
        Frame Time: 0.01\n0 0 0 0 0 0\n0 0 0 0 0 0\n";
    let e = take(stick, &body, &auto).map(|_| ()).unwrap_err();
    assert!(
        e.to_string().contains("l_forearm") && e.to_string().contains("r_foot"),
        "{e}"
    );
    let flat = source.offsets(&|_| [0.0; 3]);
    let e = go(&flat, &auto);
    assert!(matches!(e, RetargetError::Degenerate { .. }), "{e}");
}
