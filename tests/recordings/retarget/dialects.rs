//! The same recording in other words: names, units, axes, joints that are not needed.

use super::source::Source;
use super::{same, take};
use sinew_physics::body::Body;
use sinew_physics::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::reference::{FileFacts, Preparation, RetargetOptions, UpAxis};

/// Names of the CMU skeleton's limbs in other dialects. CMU's `LeftHand` only twists the forearm; its `LeftFingerBase`
/// is the wrist.
const DIALECTS: [(&str, [&str; 11]); 9] = [
    (
        "cmu",
        [
            "Arm",
            "ForeArm",
            "Hand",
            "FingerBase",
            "UpLeg",
            "Leg",
            "Foot",
            "ToeBase",
            "Shoulder",
            "Hips",
            "Head",
        ],
    ),
    (
        "mixamorig:{S}",
        [
            "Arm",
            "ForeArm",
            "ForeArmTwist",
            "Hand",
            "UpLeg",
            "Leg",
            "Foot",
            "ToeBase",
            "Shoulder",
            "mixamorig:Hips",
            "mixamorig:Head",
        ],
    ),
    (
        "{S}",
        [
            "UpperArm",
            "LowerArm",
            "LowerArmRoll",
            "Hand",
            "UpperLeg",
            "LowerLeg",
            "Foot",
            "Toes",
            "Shoulder",
            "Hips",
            "Head",
        ],
    ),
    (
        "{s}",
        [
            "Shldr",
            "ForeArm",
            "ForeArmRoll",
            "Hand",
            "Thigh",
            "Shin",
            "Foot",
            "Toe",
            "Collar",
            "hip",
            "head",
        ],
    ),
    (
        "Bip01 {S1} ",
        [
            "UpperArm",
            "Forearm",
            "ForeTwist",
            "Hand",
            "Thigh",
            "Calf",
            "Foot",
            "Toe0",
            "Clavicle",
            "Bip01 Pelvis",
            "Bip01 Head",
        ],
    ),
    (
        "{low}_",
        [
            "shoulder", "elbow", "twist", "wrist", "hip", "knee", "ankle", "toe", "collar", "root",
            "head",
        ],
    ),
    (
        "{S}",
        [
            "Shoulder", "Elbow", "Roll", "Wrist", "Hip", "Knee", "Ankle", "Toes", "Collar", "Hips",
            "Head",
        ],
    ),
    (
        "Character1_{S}",
        [
            "Arm",
            "ForeArm",
            "ForeArmRoll",
            "Hand",
            "UpLeg",
            "Leg",
            "Foot",
            "ToeBase",
            "Shoulder",
            "Character1_Hips",
            "Character1_Head",
        ],
    ),
    (
        "{S1}_",
        [
            "UpperArm", "LowerArm", "Twist", "Hand", "UpperLeg", "LowerLeg", "Foot", "Toe",
            "Shoulder", "Pelvis", "Head",
        ],
    ),
];

fn dialect(name: &str, (prefix, to): &(&str, [&str; 11])) -> String {
    let cmu = DIALECTS[0].1;
    for (k, full) in [(9, "Hips"), (10, "Head")] {
        if name == full {
            return to[k].to_owned();
        }
    }
    for (side, one, low) in [("Left", "L", "left"), ("Right", "R", "right")] {
        if let Some(part) = name.strip_prefix(side)
            && let Some(k) = cmu[..9].iter().position(|c| *c == part)
        {
            let prefix = prefix
                .replace("{S1}", one)
                .replace("{S}", side)
                .replace("{s}", &one.to_lowercase())
                .replace("{low}", low);
            return format!("{prefix}{}", to[k]);
        }
    }
    format!("extra_{name}")
}

#[test]
fn names_of_other_dialects_give_the_same_motion() {
    let body = Body::adult_man();
    let source = Source::read("walk");
    let plain = take(&source.text(), &body, &RetargetOptions::default()).unwrap();
    for d in &DIALECTS[1..] {
        let r = take(
            &source.clone().renamed(&|n| dialect(n, d)).text(),
            &body,
            &RetargetOptions::default(),
        )
        .unwrap();
        assert!(
            !r.report.skeleton.by_structure,
            "{}: names were enough",
            d.0
        );
        same(&plain, &r, d.0);
    }
}

#[test]
fn generic_suffix_names_and_no_names_at_all_are_understood() {
    let body = Body::adult_man();
    let source = Source::read("walk");
    let plain = take(&source.text(), &body, &RetargetOptions::default()).unwrap();
    let blender = [
        "upper_arm",
        "forearm",
        "twist",
        "hand",
        "thigh",
        "shin",
        "foot",
        "toe",
        "shoulder",
    ];
    let suffix = source.clone().renamed(&|n| {
        for (side, end) in [("Left", ".L"), ("Right", ".R")] {
            if let Some(k) = n
                .strip_prefix(side)
                .and_then(|p| DIALECTS[0].1[..9].iter().position(|c| *c == p))
            {
                return format!("{}{end}", blender[k]);
            }
        }
        n.to_lowercase()
    });
    same(
        &plain,
        &take(&suffix.text(), &body, &RetargetOptions::default()).unwrap(),
        "suffixes",
    );

    // Without names the structure decides; CMU's split forearm then ends at the twist joint, so only legs and trunk are
    // compared.
    let mut count = 0;
    let nameless = {
        let mut s = source.clone();
        for l in &mut s.header {
            for word in ["ROOT ", "JOINT "] {
                if l.starts_with(word) {
                    count += 1;
                    *l = format!("{word}node{count}");
                }
            }
        }
        s
    };
    // Added steps at the ends follow the mass of the whole body, arms included, so they do not depend on names.
    let bare = RetargetOptions {
        preparation: Preparation {
            ends: false,
            ..Preparation::default()
        },
        ..RetargetOptions::default()
    };
    let plain = take(&source.text(), &body, &bare).unwrap();
    let r = take(&nameless.text(), &body, &bare).unwrap();
    assert!(
        r.report.skeleton.by_structure
            && r.report
                .warnings
                .iter()
                .any(|w| w.contains("shape of the skeleton"))
    );
    for i in 0..plain.clip.len() {
        let (a, b) = (
            forward(&body, plain.clip.posture(i)),
            forward(&body, r.clip.posture(i)),
        );
        for s in [L_FOOT, R_FOOT, L_TOES, R_TOES] {
            let d = (a[s.index()].0 - b[s.index()].0).norm();
            assert!(d < 0.02, "sample {i}: {} is {d} m off", s.name());
        }
    }
}

#[test]
fn units_axes_and_extra_joints_change_nothing() {
    let body = Body::adult_man();
    let source = Source::read("walk");
    let plain = take(&source.text(), &body, &RetargetOptions::default()).unwrap();
    let cmu = 0.0254 / 0.45;
    for (unit, what) in [
        (1.0, "m"),
        (0.1, "dm"),
        (0.01, "cm"),
        (0.001, "mm"),
        (0.0254, "inch"),
    ] {
        let r = take(
            &source.clone().scaled(cmu / unit).text(),
            &body,
            &RetargetOptions::default(),
        )
        .unwrap();
        assert!(
            (r.report.size.unit_m - unit).abs() < 1e-12,
            "{what}: guessed {}",
            r.report.size.unit_m
        );
        same(&plain, &r, what);
    }
    let r = take(
        &source.clone().z_up().text(),
        &body,
        &RetargetOptions::default(),
    )
    .unwrap();
    assert_eq!(r.report.size.up, UpAxis::Z);
    same(&plain, &r, "z up");
    same(
        &plain,
        &take(
            &source.clone().with_dead_root().text(),
            &body,
            &RetargetOptions::default(),
        )
        .unwrap(),
        "dead root",
    );
    let given = RetargetOptions {
        file: FileFacts {
            unit_m: Some(0.05),
            ..FileFacts::default()
        },
        ..Default::default()
    };
    let r = take(&source.text(), &body, &given).unwrap();
    assert!(
        r.report.size.unit_given
            && (r.report.size.scale / plain.report.size.scale * 0.05 / cmu - 1.0).abs() < 1e-9
    );
}

#[test]
fn sides_named_the_wrong_way_round_are_told_by_position() {
    let body = Body::adult_man();
    let source = Source::read("walk");
    let plain = take(&source.text(), &body, &RetargetOptions::default()).unwrap();
    let swapped = source.renamed(&|n| {
        if let Some(p) = n.strip_prefix("Left") {
            format!("Right{p}")
        } else if let Some(p) = n.strip_prefix("Right") {
            format!("Left{p}")
        } else {
            n.to_owned()
        }
    });
    let r = take(&swapped.text(), &body, &RetargetOptions::default()).unwrap();
    assert!(
        r.report.skeleton.sides_swapped
            && r.report.warnings.iter().any(|w| w.contains("exchanged"))
    );
    same(&plain, &r, "swapped sides");
}
