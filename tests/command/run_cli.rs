//! The offline commands as a user sees them: `sinew run` on built-in motions writes all promised output, and wrong
//! arguments are named. Method: the real binary, files in a separate directory per test.

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

/// Every field that `report.json` promises.
const FIELDS: [&str; 21] = [
    "rate_hz",
    "ticks",
    "fell_at_s",
    "tracking_joint_rms_deg",
    "tracking_joint_max_deg",
    "tracking_mpjpe_root_mm",
    "tracking_mpjpe_global_mm",
    "max_utilisation",
    "over_limit_max",
    "saturated_s",
    "dynamics_residual_max",
    "root_wrench_unexplained_max_n",
    "foot_slip_mm_per_s",
    "penetration_max_mm",
    "margin_min_m",
    "state_hash",
    "us_per_tick_p50",
    "us_per_tick_p99",
    "retarget",
    "events",
    "non_finite_ticks",
];

/// A directory of this test process that is empty at first and removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(test: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("sinew-run-cli-{}-{test}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a directory for the test");
        Self(path)
    }
    fn file(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("UTF-8").to_owned()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn sinew(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sinew"))
        .args(args)
        .output()
        .expect("the binary runs")
}

fn succeed(args: &[&str]) -> String {
    let out = sinew(args);
    let errors = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "sinew {args:?}: {errors}");
    String::from_utf8(out.stdout).expect("UTF-8")
}

/// Runs with arguments that must be refused; returns the message.
fn fail(args: &[&str]) -> String {
    let out = sinew(args);
    assert!(!out.status.success(), "sinew {args:?} should be refused");
    String::from_utf8(out.stderr).expect("UTF-8")
}

fn json(path: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("the file was written"))
        .expect("JSON")
}

fn number(report: &Value, field: &str) -> f64 {
    report[field]
        .as_f64()
        .unwrap_or_else(|| panic!("{field} is {}", report[field]))
}

/// Repair S5.
///
/// Problem 14.1.
///
/// Problem 14.3.
#[test]
fn standing_motions_are_tracked_within_the_laws_of_physics() {
    let dir = Scratch::new("standing");
    let path = dir.file("report.json");
    succeed(&[
        "run",
        "builtin:idle",
        "builtin:wave",
        "builtin:squat",
        "builtin:lift",
        "--report",
        &path,
    ]);
    let reports = json(&path);
    assert_eq!(reports.as_array().map(Vec::len), Some(4));
    for r in reports.as_array().expect("a list") {
        let clip = &r["clip"];
        for field in FIELDS {
            assert!(r.get(field).is_some(), "{clip}: {field} is missing");
        }
        assert_eq!(number(r, "rate_hz"), 60.0);
        assert_eq!(number(r, "ticks"), (number(r, "duration_s") * 60.0).round());
        assert_eq!(number(r, "non_finite_ticks"), 0.0, "{clip}");
        assert!(
            r["fell_at_s"].is_null(),
            "{clip} fell at {}",
            r["fell_at_s"]
        );
        assert!(
            number(r, "tracking_joint_rms_deg") < 1.5,
            "{clip}: {} deg",
            r["tracking_joint_rms_deg"]
        );
        assert!(
            number(r, "over_limit_max") < 1e-9,
            "{clip}: {}",
            r["over_limit_max"]
        );
        assert!(
            number(r, "dynamics_residual_max") < 1e-9,
            "{clip}: {}",
            r["dynamics_residual_max"]
        );
        let weight = number(&r["body"], "mass_kg") * number(r, "gravity_mps2");
        assert!(
            number(r, "root_wrench_unexplained_max_n") < 1e-6 * weight,
            "{clip}"
        );
        assert!(
            number(r, "penetration_max_mm") < 5.0,
            "{clip}: {} mm",
            r["penetration_max_mm"]
        );
        assert_eq!(r["saturated_s"].as_object().map(|o| o.len()), Some(39));
        assert_eq!(r["state_hash"].as_str().map(str::len), Some(16));
        assert!(
            r["retarget"].is_null(),
            "{clip}: built-in motions are made for the body"
        );
        assert!(r["events"].is_array());
    }
}

#[test]
fn same_run_gives_the_same_bits_alone_and_beside_others() {
    let dir = Scratch::new("hash");
    let (one, two) = (dir.file("one.json"), dir.file("two.json"));
    succeed(&["run", "builtin:wave", "--duration", "1", "--report", &one]);
    succeed(&[
        "run",
        "builtin:wave",
        "builtin:idle",
        "--duration",
        "1",
        "--threads",
        "2",
        "--report",
        &two,
    ]);
    assert_eq!(json(&one)["state_hash"], json(&two)[0]["state_hash"]);
}

#[test]
fn another_clip_follows_when_it_is_asked_for() {
    let dir = Scratch::new("then");
    let report = |name: &str, then: &[&str]| {
        let path = dir.file(name);
        let run = ["run", "builtin:idle", "--duration", "4", "--report", &path];
        succeed(&[&run[..], then].concat());
        json(&path)
    };
    let stays = report("stays.json", &[]);
    assert_eq!(stays["then"].as_array().map(Vec::len), Some(0));
    let waves = report("waves.json", &["--then", "builtin:wave@1"]);
    assert_eq!(waves["then"][0]["clip"], "builtin:wave");
    assert_eq!(number(&waves["then"][0], "at_s"), 1.0);
    assert!(waves["fell_at_s"].is_null());
    assert_ne!(waves["state_hash"], stays["state_hash"]);
}

#[test]
fn every_clip_is_followed_by_its_own_forecast_whatever_runs_beside_it() {
    let clips = ["builtin:idle"; 8];
    let options = ["--duration", "0.1", "--threads", "8"];
    let text = succeed(&[&["run"][..], &clips, &options].concat());
    let rows: Vec<&str> = text.lines().skip(2).take(2 * clips.len()).collect();
    for two in rows.chunks(2) {
        let in_order = two[0].starts_with("idle") && two[1].contains("forecast: ");
        assert!(in_order, "{text}");
    }
}

#[test]
fn what_has_no_effect_is_said() {
    let run = |options: &[&str]| {
        let out = sinew(
            &[
                &["run", "builtin:idle", "--duration", "0.1", "--json"],
                options,
            ]
            .concat(),
        );
        assert!(out.status.success(), "{options:?}");
        String::from_utf8(out.stderr).expect("UTF-8")
    };
    assert_eq!(run(&["--push", "1@chest@0.05:1,0,0"]), "");
    let said = run(&[
        "--controller",
        "paper",
        "--max-help",
        "0.1",
        "--push",
        "1@chest@99:1,0,0",
    ]);
    for says in [
        "warning: --max-help has no effect",
        "warning: idle: --push at 99 s has no effect: the run ends at 0.10 s",
    ] {
        assert!(said.contains(says), "{said}");
    }
}

#[test]
fn files_have_the_promised_content() {
    let dir = Scratch::new("files");
    let (csv, bvh) = (dir.file("out.csv"), dir.file("out.bvh"));
    let (svg, png) = (dir.file("strip.svg"), dir.file("strip.png"));
    let run = ["run", "builtin:squat", "--duration", "0.5", "--out"];
    succeed(
        &[
            &run[..],
            &[
                &csv,
                "--strip",
                &svg,
                "--strip-frames",
                "3",
                "--view",
                "side",
            ],
        ]
        .concat(),
    );
    succeed(&[&run[..], &[&bvh, "--strip", &png]].concat());

    let table = std::fs::read_to_string(&csv).expect("a table");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!(rows.len(), 31, "a heading and 30 ticks");
    assert!(
        rows.iter().all(|r| r.len() == 8 + 4 * 39),
        "time, root pose, angles, torques, two limits"
    );
    for row in &rows[1..] {
        let values: Vec<f64> = row.iter().map(|v| v.parse().expect("a number")).collect();
        assert!(values.iter().all(|v| v.is_finite()));
        for d in 0..39 {
            assert!(
                values[8 + 78 + d] < 0.0 && values[8 + 117 + d] > 0.0,
                "limits have opposite signs"
            );
        }
    }
    let picture = std::fs::read_to_string(&svg).expect("a picture");
    assert_eq!(picture.matches("<svg ").count(), 1);
    assert_eq!(picture.matches(" s\n</text>").count(), 3, "three panels");
    assert!(
        std::fs::read(&png)
            .expect("a picture")
            .starts_with(b"\x89PNG\r\n\x1a\n")
    );
    // The same program can read its output.
    let text = std::fs::read(&bvh).expect("a motion");
    let motion = sinew_physics::motion::Bvh::parse(&text).expect("our own BVH");
    assert_eq!(motion.frame_count, 30);
    let words = succeed(&["lint", &bvh]);
    assert!(words.contains("mapped by name"));
    assert!(words.contains("as recorded") && words.contains("as prepared"));
}

#[test]
fn lint_tells_how_far_a_motion_is_from_one_that_feet_can_carry() {
    let text = succeed(&["lint", "builtin:idle", "builtin:walk", "--json"]);
    let all: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let of = |i: usize| &all[i]["consistency"]["prepared"];
    assert!(all[0]["consistency"]["recorded"].is_null());
    assert_eq!(of(0)["zmp_outside_share"], 0.0);
    assert_eq!(of(0)["flight_share"], 0.0);
    let lacks = |i: usize| {
        of(i)["residual_force_weights"]["max"]
            .as_f64()
            .expect("a number")
    };
    assert!(lacks(0) < 0.01, "{text}");
    assert!(
        lacks(1) < 0.2 && of(1)["stances"].as_u64() > Some(3),
        "{text}"
    );
}

/// Repair S5.
///
/// Problem 14.1.
#[test]
fn loads_pushes_and_weakness_reach_the_physics() {
    let dir = Scratch::new("loads");
    let path = dir.file("report.json");
    let report = |extra: &[&str]| {
        succeed(
            &[
                &[
                    "run",
                    "builtin:idle",
                    "--duration",
                    "2.5",
                    "--report",
                    &path,
                ],
                extra,
            ]
            .concat(),
        );
        json(&path)
    };
    let plain = report(&[]);
    let loaded = report(&["--load", "8@r_hand@0.5..1.5"]);
    assert!(number(&loaded, "max_utilisation") > number(&plain, "max_utilisation"));
    let kinds: Vec<&str> = loaded["events"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|e| e["kind"].as_str())
        .collect();
    assert!(
        kinds.contains(&"load_taken") && kinds.contains(&"load_dropped"),
        "{kinds:?}"
    );
    assert!(
        number(&loaded, "dynamics_residual_max") < 1e-9,
        "the load is on the books"
    );
    let pushed = report(&["--push", "15@chest@0.5:-1,0,0"]);
    assert_ne!(pushed["state_hash"], plain["state_hash"]);
    assert!(
        number(&pushed, "dynamics_residual_max") < 1e-9,
        "the push is on the books"
    );
    assert!(number(&pushed, "root_wrench_unexplained_max_n") < 1e-6 * 735.0);
    assert_eq!(pushed["pushes"][0]["segment"], "chest");
    let weak = report(&["--strength", "0.05"]);
    assert!(number(&weak, "over_limit_max") < 1e-9);
    assert!(number(&weak, "max_utilisation") > number(&plain, "max_utilisation"));
}

#[test]
fn a_fall_is_a_result_and_not_an_error() {
    let dir = Scratch::new("fall");
    let path = dir.file("report.json");
    let out = succeed(&[
        "run",
        "builtin:idle",
        "--duration",
        "4",
        "--push",
        "120@chest@0.5:1,0,0",
        "--report",
        &path,
    ]);
    let report = json(&path);
    assert!(number(&report, "fell_at_s") > 0.5, "120 N·s fell a person");
    assert!(out.contains("fell at"), "{out}");
    assert_eq!(number(&report, "non_finite_ticks"), 0.0);
    assert!(
        report["quarantined_at_s"].is_null(),
        "a fall is ordinary physics"
    );
}

#[test]
fn wrong_arguments_are_told_apart() {
    for (args, says) in [
        (&["run"][..], "CLIP"),
        (
            &["run", "builtin:fly"],
            "there is no built-in motion \"fly\"; the built-in motions are idle, lift, crate, squat, wave, step, walk",
        ),
        (&["run", "wave"], "did you mean builtin:wave?"),
        (&["run", "no/such.bvh"], "cannot read no/such.bvh"),
        (
            &["run", "builtin:idle", "--load", "3@tail"],
            "there is no segment \"tail\"",
        ),
        (
            &["run", "builtin:idle", "--push", "3@chest"],
            "is not of the form NS@SEGMENT@T:x,y,z",
        ),
        (
            &["run", "builtin:idle", "--strength", "0"],
            "--strength 0: outside 0.01…100",
        ),
        (
            &["run", "builtin:idle", "--rate", "5"],
            "--rate 5: outside 10…1000",
        ),
        (&["run", "builtin:idle", "--height", "9"], "height"),
        (
            &["run", "builtin:idle", "--duration", "-1"],
            "--duration -1 s: outside 0…86400",
        ),
        (
            &["run", "builtin:idle", "--duration", "nan"],
            "--duration NaN s: outside",
        ),
        (&["run", "builtin:idle", "--loop"], "--duration"),
        (
            &["run", "builtin:idle", "--then", "builtin:walk@1"],
            "--duration",
        ),
        (
            &[
                "run",
                "builtin:idle",
                "--duration",
                "2",
                "--then",
                "builtin:walk",
            ],
            "is not of the form CLIP@T",
        ),
        (
            &["run", "builtin:idle", "--out", "a.txt"],
            "--out a.txt: the name must end in one of .bvh, .csv",
        ),
        (
            &["run", "builtin:idle", "--strip", "a.gif"],
            "--strip a.gif: the name must end in one of .svg, .png",
        ),
        (
            &["run", "builtin:idle", "--controller", "magic"],
            "[possible values: paper, modern, motors]",
        ),
        (
            &["convert", "builtin:idle", "a.fbx"],
            "convert a.fbx: the name must end in one of .bvh, .csv, .json",
        ),
    ] {
        let error = fail(args);
        assert!(
            error.contains(says),
            "sinew {args:?} says {error:?}, not {says:?}"
        );
    }
}

#[test]
fn a_file_that_is_no_motion_is_refused_with_the_place() {
    let dir = Scratch::new("bad-bvh");
    let path = dir.file("bad.bvh");
    std::fs::write(&path, "HIERARCHY\nROOT hips\n{\n  OFFSET 0 0 zero\n}\n").expect("a file");
    for command in ["run", "lint"] {
        let error = fail(&[command, &path]);
        assert!(
            error.contains("is not a BVH file") && error.contains("line 4"),
            "{error}"
        );
    }
}

#[test]
fn prepared_motions_are_written_in_three_formats() {
    let dir = Scratch::new("convert");
    let (csv, bvh, list) = (dir.file("a.csv"), dir.file("a.bvh"), dir.file("a.json"));
    for path in [&csv, &bvh, &list] {
        succeed(&["convert", "builtin:wave", path, "--body", "adult-woman"]);
    }
    let samples = json(&list)["samples"]
        .as_array()
        .map(Vec::len)
        .expect("samples");
    let rows = std::fs::read_to_string(&csv)
        .expect("a table")
        .lines()
        .count();
    let motion = sinew_physics::motion::Bvh::parse(&std::fs::read(&bvh).expect("a motion"))
        .expect("our own BVH");
    assert_eq!((rows, motion.frame_count), (samples + 1, samples));
}

#[test]
fn bodies_are_listed_for_people_and_for_programs() {
    let woman = [
        "bodies",
        "--body",
        "adult-woman",
        "--height",
        "1.6",
        "--sources",
    ];
    let text = succeed(&woman);
    assert!(
        text.starts_with("female-30y-1600mm-62000g: 30 years, 1.60 m")
            && text.contains("l_knee_flexion")
    );
    let man = ["bodies", "--body", "adult-man", "--json"];
    let body: Value = serde_json::from_str(&succeed(&man)).expect("JSON");
    assert_eq!(body["name"], "adult-man");
    assert_eq!(body["dofs"].as_array().map(Vec::len), Some(39));
    let mass: f64 = body["segments"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|s| number(s, "mass_kg"))
        .sum();
    assert!((mass - number(&body, "mass_kg")).abs() < 1e-6);
    for dof in body["dofs"].as_array().expect("a list") {
        assert!(
            number(dof, "torque_min_at_rest_nm") < 0.0
                && number(dof, "torque_max_at_rest_nm") > 0.0,
            "{dof}"
        );
        assert!(
            !dof["sources"].as_array().expect("a list").is_empty(),
            "{} has no source",
            dof["name"]
        );
    }
}

#[test]
fn a_clip_that_is_tracked_is_not_rehearsed() {
    let dir = Scratch::new("rehearse");
    let (strip, out) = (dir.file("strip.png"), dir.file("out.bvh"));
    let text = succeed(&[
        "rehearse",
        "builtin:wave",
        "--json",
        "--strip",
        &strip,
        "--out",
        &out,
    ]);
    let report: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(report["followed"]["way"], "tracked");
    assert!(report["followed"]["rehearsal"].is_null());
    assert_eq!(report["outcome"], report["tracked"]);
    let said = report["followed"]["reason"].as_str().expect("a reason");
    assert!(said.starts_with("forecast: "), "{said}");
    let read = |path: &str| std::fs::read(path).expect("the file was written");
    assert!(read(&strip).starts_with(b"\x89PNG") && read(&out).starts_with(b"HIERARCHY"));

    let wrong = fail(&["rehearse", "builtin:wave", "--max-help", "3"]);
    assert!(wrong.contains("--max-help 3: outside 0…2"), "{wrong}");
    let wrong = fail(&[
        "rehearse",
        "builtin:crate",
        "--load",
        "2@l_hand+r_hand",
        "--strength",
        "0.1",
    ]);
    assert!(wrong.contains("two hands"), "{wrong}");
}

#[test]
fn who_did_a_motion_does_it_again_by_the_strength_that_it_took() {
    let scratch = Scratch::new("strength");
    let (file, cells) = (scratch.file("person.json"), scratch.file("cells.json"));
    // A weak old woman, lifting 5 kg.
    let person = ["--body", "female-75y-1600mm-67000g", "--load", "5@r_hand"];
    let mut args = vec!["strength", "builtin:lift", "--percentile", "5"];
    args.extend(person);
    args.extend(["--out", &file, "--envelope", &cells]);
    let table = succeed(&args);
    assert!(table.contains("r_shoulder_flexion"), "{table}");
    let strength = json(&file);
    let factors: Vec<f64> = (strength["dofs"].as_array().expect("a list").iter())
        .map(|d| d["factor"].as_f64().expect("a number"))
        .collect();
    assert!(factors.iter().any(|f| *f > 1.2) && factors.iter().all(|f| *f >= 1.0));
    let cells = json(&cells);
    assert!(cells.as_array().is_some_and(|c| c.len() > 100));
    let run = |more: &[&str], report: &str| {
        let report = scratch.file(report);
        let mut args = vec!["run", "builtin:lift", "--report", &report];
        args.extend(person);
        args.extend(more);
        succeed(&args);
        number(&json(&report), "tracking_joint_rms_deg")
    };
    let tables = run(&["--percentile", "5"], "tables.json");
    let motion = run(&["--strength-file", &file], "motion.json");
    println!("by the tables {tables:.2}°, by the motion {motion:.2}°");
    assert!(motion < 0.5 && tables > 3.0 * motion);
    // Recordings: a weak old man, walking, lifting and jumping.
    for clip in ["walk-normal.cmu", "lift.vrm", "jump.vrm"] {
        let clip = format!(
            "{}/tests/corpus/{clip}.bvh",
            concat!(env!("CARGO_MANIFEST_DIR"), "/../..")
        );
        let person = [clip.as_str(), "--body", "older-man"];
        let mut args = vec!["strength"];
        args.extend(person);
        args.extend(["--percentile", "5", "--out", &file]);
        succeed(&args);
        let fell = |more: [&str; 2]| {
            let report = scratch.file("recording.json");
            let mut args = vec!["run"];
            args.extend(person);
            args.extend(["--standing", "--report", &report]);
            args.extend(more);
            succeed(&args);
            json(&report)["fell_at_s"].clone()
        };
        assert!(!fell(["--percentile", "5"]).is_null(), "{clip}");
        assert!(fell(["--strength-file", &file]).is_null(), "{clip}");
    }
    let text = fail(&[
        "run",
        "builtin:idle",
        "--strength-file",
        &file,
        "--strength",
        "2",
    ]);
    assert!(text.contains("--strength"), "{text}");
    std::fs::write(&file, "{\"dofs\": [{\"dof\": \"tail\", \"factor\": 2}]}").expect("a file");
    let text = fail(&["run", "builtin:idle", "--strength-file", &file]);
    assert!(text.contains("tail"), "{text}");
}
