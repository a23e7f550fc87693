//! Files that are wrong or odd: errors name the place, and nothing panics.

use crate::reading::file::{File, motion};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use sinew_physics::body::Body;
use sinew_physics::motion::Bvh;
use sinew_physics::motion::read;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::{RetargetError, RetargetOptions};

fn refuse(text: &str) -> String {
    match read(text.as_bytes()) {
        Err(e) => e.to_string(),
        Ok(file) => prepare_recording(&file, &Body::adult_man(), &RetargetOptions::default())
            .map(|_| ())
            .unwrap_err()
            .to_string(),
    }
}

fn walk(frames: usize) -> File {
    let body = Body::adult_man();
    let mut file = File::new(&body, &motion(&body, "walk"));
    file.rows.truncate(frames);
    file
}

#[test]
fn a_joint_without_offset_is_named_with_its_line() {
    let text = walk(10).text();
    let at = text.find("JOINT leftLowerLeg").unwrap();
    let line = text[..at].lines().count() + 1;
    let offset = at + text[at..].find("OFFSET").unwrap();
    let end = offset + text[offset..].find('\n').unwrap() + 1;
    let without = format!("{}{}", &text[..offset], &text[end..]);
    let e = refuse(&without);
    assert_eq!(
        e,
        format!("line {line}: joint \"leftLowerLeg\" has no OFFSET")
    );
}

#[test]
fn names_that_joints_share_are_named_and_never_guessed_between() {
    let file = walk(10);
    let two = file
        .head
        .replace("JOINT rightLowerArm", "JOINT leftLowerArm");
    // Give the right one another name, so that every segment has a bone by name.
    let two = two.replace("JOINT rightHand", "JOINT RightForeArm");
    let e = refuse(
        &File {
            head: two,
            ..file.clone()
        }
        .text(),
    );
    assert!(
        e.contains("l_forearm") && e.contains("\"leftLowerArm\""),
        "{e}"
    );
    assert!(
        e.contains("\"leftUpperArm\"") && e.contains("\"rightUpperArm\""),
        "{e}"
    );

    // A name from which no segment is read may occur twice.
    let harmless = file.head.replace("JOINT spine", "JOINT chest");
    let text = File {
        head: harmless,
        ..file
    }
    .text();
    let bvh = Bvh::parse(text.as_bytes()).unwrap();
    let lines: Vec<usize> = text
        .lines()
        .enumerate()
        .filter(|(_, l)| *l == "JOINT chest")
        .map(|(i, _)| i + 1)
        .collect();
    let said = format!(
        "2 joints are named \"chest\" (lines {}, {})",
        lines[0], lines[1]
    );
    assert_eq!(bvh.warnings, [said]);
    assert!(
        prepare_recording(
            &bvh.recording().unwrap(),
            &Body::adult_man(),
            &RetargetOptions::default()
        )
        .is_ok()
    );
}

#[test]
fn damaged_files_are_refused_by_line_or_frame_and_never_panic() {
    let body = Body::adult_man();
    let text = walk(30).text();
    let bytes = text.as_bytes();
    let head = text.find("MOTION").unwrap();
    let mut random = Pcg64::seed_from_u64(29);
    let words: [&[u8]; 12] = [
        b"-",
        b"1e12",
        b"nan",
        b"OFFSET",
        b"}",
        b"{",
        b"\r",
        b"0",
        b"9",
        b".",
        b"End Site",
        b"",
    ];
    let (mut refused, mut read) = (0, 0);
    for round in 0..1200 {
        let mut damaged = bytes.to_vec();
        for _ in 0..random.random_range(1..4) {
            // Half of the damage is in the hierarchy.
            let end = if random.random_bool(0.5) {
                head
            } else {
                damaged.len()
            };
            let at = random.random_range(0..end.min(damaged.len()));
            let until = (at + random.random_range(0..12)).min(damaged.len());
            let word = words[random.random_range(0..words.len())];
            damaged.splice(at..until, word.iter().copied());
        }
        match Bvh::parse(&damaged) {
            Err(e) => {
                let e = e.to_string();
                assert!(e.starts_with("line "), "round {round}: {e}");
                refused += 1;
            }
            Ok(bvh) if read < 60 => {
                // A readable file gives a clip or a reason.
                let options = RetargetOptions::default();
                let fitted = bvh.recording().map_err(RetargetError::from);
                let fitted = fitted.and_then(|r| prepare_recording(&r, &body, &options));
                if let Err(e) = fitted {
                    assert!(!e.to_string().is_empty());
                }
                read += 1;
            }
            Ok(_) => {}
        }
    }
    assert!(
        refused > 300 && read >= 60,
        "{refused} refused, {read} read"
    );
}

#[test]
fn huge_numbers_in_frames_are_an_error_or_a_clip() {
    let body = Body::adult_man();
    let mut random = Pcg64::seed_from_u64(30);
    for round in 0..60 {
        let mut file = walk(40);
        let columns = file.rows[0].len();
        for _ in 0..random.random_range(1..6) {
            let value = [1e12, -1e12, 1e9, 0.0, 1e-300, 720.0][random.random_range(0..6)];
            let column = random.random_range(0..columns);
            if random.random_bool(0.3) {
                file.rows.iter_mut().for_each(|r| r[column] = value);
            } else {
                let row = random.random_range(0..file.rows.len());
                file.rows[row][column] = value;
            }
        }
        let bvh = Bvh::parse(file.text().as_bytes()).unwrap();
        let Ok(recording) = bvh.recording() else {
            continue;
        };
        if let Ok(r) = prepare_recording(&recording, &body, &RetargetOptions::default()) {
            let finite = |i: usize| r.clip.posture(i).root_position.is_finite();
            assert!((0..r.clip.len()).all(finite), "round {round}");
        }
    }
}
