//! Goal: every dialect is read as intended, and errors are reported with line, frame and column.

use super::*;
use proptest::prelude::*;

const PLAIN: &str = "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 1 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation \
    Xrotation Yrotation\n\tJOINT Leg\n\t{\n\t\tOFFSET 0 -2 0\n\t\tCHANNELS 3 Xrotation Yrotation Zrotation\n\t\tEnd \
    Site\n\t\t{\n\t\t\tOFFSET 0 -3 0\n\t\t}\n\t}\n}\nMOTION\nFrames: 2\nFrame Time: 0.01\n1 2 3 0 0 0 0 0 0\n1 2 3 90 \
    0 0 90 0 0\n";

fn close(a: Vec3, b: [f64; 3]) {
    assert!((a - Vec3::from_array(b)).norm() < 1e-12, "{a:?} {b:?}");
}

fn error(text: &str) -> String {
    Bvh::parse(text.as_bytes())
        .expect_err("must fail")
        .to_string()
}

#[test]
fn plain_file_is_read_and_placed() {
    let bvh = Bvh::parse(PLAIN.as_bytes()).unwrap();
    assert_eq!((bvh.joints.len(), bvh.frame_count), (2, 2));
    assert_eq!(bvh.frame_time, 0.01);
    assert!(bvh.warnings.is_empty());
    assert_eq!(bvh.joints[1].parent, Some(0));
    let rest = bvh.world(0);
    close(rest[0].position, [1.0, 2.0, 3.0]); // the channels replace the root's offset
    close(rest[1].position, [1.0, 0.0, 3.0]);
    let turned = bvh.world(1);
    close(turned[1].position, [3.0, 2.0, 3.0]); // Z 90°: down becomes +x
    // then X 90° in the turned frame: the end, down at first, points along −z of the root frame, which Z leaves alone
    close(bvh.end_site_world(1, &turned).unwrap(), [3.0, 2.0, 0.0]);
}

#[test]
fn rotations_apply_in_channel_order() {
    let text = PLAIN
        .replace(
            "Zrotation Xrotation Yrotation",
            "Xrotation Zrotation Yrotation",
        )
        .replace("1 2 3 90 0 0 90 0 0", "1 2 3 90 90 0 0 0 0");
    let bvh = Bvh::parse(text.as_bytes()).unwrap();
    // R = Rx(90)·Rz(90): (0,−2,0) → Rz → (2,0,0) → Rx → (2,0,0); the other order would give (0,0,−2).
    close(bvh.world(1)[1].position, [3.0, 2.0, 3.0]);
}

#[test]
fn a_mirrored_file_is_seen_in_a_mirror() {
    let text = PLAIN
        .replace("OFFSET 0 -2 0", "OFFSET 0.5 -2 0.3")
        .replace("1 2 3 90 0 0 90 0 0", "1 2 3 20 -35 50 15 70 -10");
    let bvh = Bvh::parse(text.as_bytes()).unwrap();
    let mirrored = bvh.mirrored();
    let (there, here) = (bvh.world(1), mirrored.world(1));
    for (a, b) in there.iter().zip(&here) {
        let [x, y, z] = a.position.to_array();
        close(b.position, [-x, y, z]);
    }
    let ends = [(&bvh, &there), (&mirrored, &here)].map(|(b, at)| b.end_site_world(1, at));
    let [x, y, z] = ends[0].unwrap().to_array();
    close(ends[1].unwrap(), [-x, y, z]);
    assert_eq!(mirrored.mirrored(), bvh);
}

#[test]
fn dialects_read_alike() {
    let plain = Bvh::parse(PLAIN.as_bytes()).unwrap();
    let variants = [
        PLAIN.replace('\n', "\r\n"),
        PLAIN.replace('\n', "\r"),
        PLAIN.replace(' ', "\t"),
        PLAIN.replace('\n', "  \n\n"),
        PLAIN.replace("\n{", " {"),
        PLAIN.replace("Frames: 2", "Frames:2"),
        PLAIN.replace("Frames: 2", "FRAMES :\t2"),
        PLAIN.replace("Frame Time: 0.01", "Frame Time:1e-2"),
        PLAIN.replace("Frame Time: 0.01", "FrameTime: +1.0E-02"),
        PLAIN.replace(
            "Frames: 2\nFrame Time: 0.01",
            "Frame Time: .01\nFrames: 2.0",
        ),
        PLAIN.replace("Xposition", "XPOSITION").to_string(),
        PLAIN.replace("1 2 3 90", "1e0 +2. 3.0E+00 9.0e1"),
        PLAIN.replace("1 2 3 90", "1 2 3 -270"),
        format!("\u{feff}{PLAIN}"),
        format!("{PLAIN}\u{1a}"),
        PLAIN.trim_end().to_string(),
    ];
    for text in variants {
        let bvh = Bvh::parse(text.as_bytes()).unwrap_or_else(|e| panic!("{text:?}: {e}"));
        for f in 0..2 {
            for (a, b) in bvh.world(f).iter().zip(plain.world(f)) {
                close(a.position, b.position.to_array());
            }
        }
        assert_eq!(bvh.frame_time, 0.01);
        assert_eq!(bvh.joints[0].name, "Hips");
    }
}

#[test]
fn names_keep_blanks_and_end_sites_may_be_missing_or_empty() {
    let text = PLAIN.replace("JOINT Leg", "JOINT  Left Leg 01 \t");
    assert_eq!(
        Bvh::parse(text.as_bytes()).unwrap().joints[1].name,
        "Left Leg 01"
    );
    let none = PLAIN.replace("\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -3 0\n\t\t}\n", "");
    assert_eq!(
        Bvh::parse(none.as_bytes()).unwrap().joints[1].end_site,
        None
    );
    let empty = PLAIN.replace("\t\t\tOFFSET 0 -3 0\n", "");
    assert_eq!(
        Bvh::parse(empty.as_bytes()).unwrap().joints[1].end_site,
        Some([0.0; 3])
    );
    let nameless = PLAIN.replace("JOINT Leg", "JOINT");
    let bvh = Bvh::parse(nameless.as_bytes()).unwrap();
    assert_eq!(bvh.joints[1].name, "unnamed_1");
    assert_eq!(bvh.warnings.len(), 1);
}

#[test]
fn rotation_only_root_stands_at_its_offset_and_dead_roots_pass() {
    let text = PLAIN
        .replace(
            "CHANNELS 6 Xposition Yposition Zposition Zrotation",
            "CHANNELS 3 Zrotation",
        )
        .replace("1 2 3 ", "");
    close(
        Bvh::parse(text.as_bytes()).unwrap().world(0)[0].position,
        [0.0, 1.0, 0.0],
    );
    let dead = PLAIN
        .replace(
            "ROOT Hips\n{",
            "ROOT reference\n{\nOFFSET 0 0 0\nCHANNELS 0\nJOINT Hips\n{",
        )
        .replace("}\nMOTION", "}\n}\nMOTION");
    let bvh = Bvh::parse(dead.as_bytes()).unwrap();
    assert_eq!(bvh.joints[1].name, "Hips");
    close(bvh.world(0)[2].position, [1.0, 0.0, 3.0]);
}

#[test]
fn inner_positions_replace_the_offset_or_add_to_it() {
    let six = PLAIN.replace(
        "CHANNELS 3 Xrotation Yrotation Zrotation",
        "CHANNELS 6 Xrotation Yrotation Zrotation Xposition Yposition Zposition",
    );
    let whole = six
        .replace("0 0 0 0 0 0\n", "0 0 0 0 0 0 0 -2.1 0\n")
        .replace("90 0 0 90 0 0\n", "90 0 0 90 0 0 0 -2.1 0\n");
    let bvh = Bvh::parse(whole.as_bytes()).unwrap();
    close(bvh.world(0)[1].position, [1.0, 2.0 - 2.1, 3.0]);
    let delta = whole.replace("0 -2.1 0\n", "0.25 0 0\n");
    let bvh = Bvh::parse(delta.as_bytes()).unwrap();
    close(bvh.world(0)[1].position, [1.25, 0.0, 3.0]);
    assert!(bvh.warnings[0].contains("increments"));
}

#[test]
fn one_row_more_or_fewer_is_accepted_two_are_not() {
    for (declared, ok) in [
        (1, true),
        (2, true),
        (3, true),
        (4, false),
        (100_000_000_000u64, false),
    ] {
        let text = PLAIN.replace("Frames: 2", &format!("Frames: {declared}"));
        let bvh = Bvh::parse(text.as_bytes());
        assert_eq!(bvh.is_ok(), ok, "{declared}");
        if let Ok(bvh) = bvh {
            assert_eq!(bvh.frame_count, 2);
            assert_eq!(bvh.warnings.len(), usize::from(declared != 2));
        }
    }
    let text = format!(
        "{}0 0 0 0 0 0 0 0 0\n",
        PLAIN.replace("Frames: 2", "Frames: 1")
    );
    assert!(error(&text).contains("1 frames are declared, 3"));
}

#[test]
fn errors_name_line_frame_and_column() {
    assert!(error("").contains("line 1"));
    assert!(error("<html>").contains("HIERARCHY"));
    assert!(
        error(&PLAIN.replace("1 2 3 90", "1 2 nan 90")).starts_with("line 20, frame 2, column 3")
    );
    assert!(error(&PLAIN.replace("1 2 3 90", "1 2 1e999 90")).contains("column 3"));
    assert!(
        error(&PLAIN.replace("1 2 3 90", "1 2 3 9 90")).contains("line 20, frame 2: 10 columns")
    );
    assert!(error(&PLAIN.replace("1 2 3 90 0 0 ", "1 2 ")).contains("5 columns"));
    assert!(error(&PLAIN.replace("0 -3 0", "0 inf 0")).starts_with("line 12"));
    assert!(error(&PLAIN.replace("CHANNELS 3", "CHANNELS 7")).contains("not \"7\""));
    assert!(error(&PLAIN.replace("CHANNELS 3", "CHANNELS 4")).contains("a channel"));
    assert!(error(&PLAIN.replace("0.01", "0")).contains("must be positive"));
    assert!(error(&PLAIN.replace("0.01", "0,01")).contains("frame time"));
    assert!(error(&PLAIN.replace("Frames: 2", "Frames: 0")).contains("must be positive"));
    assert!(
        error(&PLAIN.replace(
            "Xrotation Yrotation Zrotation\n\t\tEnd",
            "Xrotation Xrotation Zrotation\n\t\tEnd"
        ))
        .contains("twice")
    );
    assert!(
        error(&PLAIN.replace("MOTION", "ROOT other\n{\nOFFSET 0 0 0\n}\nMOTION"))
            .contains("second ROOT")
    );
    assert!(error(&PLAIN.replace("JOINT", "ROOT")).contains("second ROOT"));
    assert!(
        error("HIERARCHY ROOT a { OFFSET 0 0 0 } MOTION Frames: 1 Frame Time: 1\n")
            .contains("no joint has a channel")
    );
    let cut = &PLAIN[..PLAIN.find("\t\tEnd").unwrap()];
    assert!(error(cut).contains("ends where"));
}

#[test]
fn depth_and_joint_count_are_bounded() {
    let deep = format!("HIERARCHY ROOT a {{ {}", "JOINT b\n{ ".repeat(1_000_000));
    assert!(error(&deep).contains("more than 1024 joints"));
    let n = 1000;
    let text = format!(
        "HIERARCHY ROOT a\n{{ OFFSET 0 0 0 CHANNELS 1 Zrotation {} {} }} MOTION Frames: 1 Frame Time: 1\n0\n",
        "JOINT b\n{ OFFSET 0 1 0 ".repeat(n),
        "}".repeat(n)
    );
    let bvh = Bvh::parse(text.as_bytes()).unwrap();
    close(bvh.world(0)[n].position, [0.0, n as f64, 0.0]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = Bvh::parse(&bytes);
    }

    #[test]
    fn mutated_files_never_panic(
        edits in proptest::collection::vec((0usize..10_000, 0u8..5, any::<u8>()), 1..8),
    ) {
        let mut bytes = PLAIN.as_bytes().to_vec();
        for (at, kind, byte) in edits {
            let at = at % bytes.len().max(1);
            match kind {
                0 if at < bytes.len() => bytes[at] = byte,
                1 if at < bytes.len() => { bytes.remove(at); }
                2 => bytes.insert(at, byte),
                3 => bytes.truncate(at.max(1)),
                _ => { let tail = bytes[at..].to_vec(); bytes.extend_from_slice(&tail); }
            }
        }
        if let Ok(bvh) = Bvh::parse(&bytes) {
            for f in 0..bvh.frame_count {
                prop_assert_eq!(bvh.world(f).len(), bvh.joints.len());
            }
        }
    }
}
