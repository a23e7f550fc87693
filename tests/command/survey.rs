//! Goal: a survey is the same on any number of threads, resumes where it was interrupted, detects wrong physics and
//! wrong labels, and is clean when nothing has changed. Method: built-in motions and a recording written from one of
//! them, through the `sinew` binary and through the library.

use serde_json::Value;
use sinew_evaluate::survey::compare::compare;
use sinew_evaluate::survey::{Lacks, MeasuredClip, MotionKind, SurveyRow, run};
use sinew_physics::body::Body;
use sinew_physics::figure::{FigureOptions, StrengthScale};
use sinew_physics::motion::builtin::builtin;
use sinew_physics::motion::write_bvh;
use sinew_physics::rehearsal::{Conditions, TrackingReference};
use sinew_physics::world::WorldParams;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

/// Error of time steps of 1/120 s in an impulse balance of 0.
const BALANCE: f64 = 1e-3;

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("sinew-survey-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(path.join("corpus")).unwrap();
        Self(path)
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap()
    }

    /// Writes a part of a built-in motion as a recording.
    fn record(&self, name: &str, of: &str, seconds: f64) {
        let body = Body::adult_man();
        let clip = builtin(&body, of).unwrap();
        let postures: Vec<_> = (0..(seconds * 60.0) as usize)
            .map(|i| clip.sample(i as f64 / 60.0).posture)
            .collect();
        std::fs::write(self.0.join(name), write_bvh(&body, &postures, 60.0)).unwrap();
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn survey(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sinew"))
        .arg("survey")
        .args(arguments)
        .output()
        .unwrap()
}

fn good(arguments: &[&str]) -> String {
    let out = survey(arguments);
    let error = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(out.status.success(), "{arguments:?}: {error}");
    assert_eq!(error, "", "no progress bar where there is no terminal");
    String::from_utf8(out.stdout).unwrap()
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

#[test]
fn a_survey_is_the_same_on_any_number_of_threads_and_goes_on_where_it_stopped() {
    let f = Folder::new("same");
    f.record("corpus/wave.bvh", "wave", 1.5);
    f.record("corpus/squat.bvh", "squat", 1.5);
    std::fs::write(f.0.join("corpus/broken.bvh"), "HIERARCHY\nROOT a\n{\n").unwrap();
    let corpus = f.path("corpus");
    let of = |name: &str, jobs: &str| {
        let out = f.path(name);
        good(&[
            &corpus,
            "builtin:idle",
            "--out",
            &out,
            "--jobs",
            jobs,
            "--copies",
            "1",
        ])
    };
    let text = of("one.json", "1");
    of("three.json", "3");
    assert_eq!(f.text("one.json"), f.text("three.json"));
    assert!(!f.0.join("one.json.partial").exists());

    // A clip that cannot be read is a row with its error.
    let all = json(&f.0.join("one.json"));
    let rows = all["rows"].as_array().unwrap();
    let names: Vec<&str> = rows.iter().map(|r| r["clip"].as_str().unwrap()).collect();
    assert_eq!(
        names,
        [
            "corpus/broken.bvh",
            "corpus/squat.bvh",
            "corpus/wave.bvh",
            "builtin:idle"
        ]
    );
    assert!(
        rows[0]["error"].as_str().unwrap().contains("BVH"),
        "{}",
        rows[0]
    );
    assert!(
        text.contains("4 clips, 1 of them could not be read"),
        "{text}"
    );
    for row in &rows[1..3] {
        let outcome = &row["result"]["outcome"];
        assert_eq!(outcome["completed"], true, "{row}");
        assert_eq!(row["result"]["copies"]["completed"], 1, "{row}");
        assert!(
            outcome["recorded"]["mpjpe_global_mm"].as_f64().unwrap() < 40.0,
            "{row}"
        );
        assert!(
            outcome["impulse_balance"].as_f64().unwrap().abs() < BALANCE,
            "{row}"
        );
    }
    assert_eq!(
        rows[3]["result"]["copies"],
        Value::Null,
        "there is no file that could have noise"
    );

    // Unknown keys and a truncated line are ignored.
    let line = "{\"key\":\"0\",\"done\":{\"Failed\":\"no\"}}\n{\"key\": \"cut sho";
    std::fs::write(f.0.join("again.json.partial"), line).unwrap();
    of("again.json", "2");
    assert_eq!(f.text("again.json"), f.text("one.json"));
}

#[test]
fn an_interrupted_survey_takes_over_what_it_had_and_runs_again_what_changed() {
    let f = Folder::new("resume");
    f.record("corpus/wave.bvh", "wave", 1.5);
    f.record("corpus/squat.bvh", "squat", 1.5);
    let (corpus, out) = (f.path("corpus"), f.path("s.json"));
    // Interrupted after the first clips: the survey itself cannot be written, because a folder has its name.
    std::fs::create_dir(f.0.join("s.json")).unwrap();
    assert_eq!(survey(&[&corpus, "--out", &out]).status.code(), Some(1));
    std::fs::remove_dir(f.0.join("s.json")).unwrap();
    let partial = f.0.join("s.json.partial");
    let marked = std::fs::read_to_string(&partial).unwrap();
    assert_eq!(marked.matches("\"key\"").count(), 2, "both were kept");
    let marked = marked.replace("\"warnings\":[]", "\"warnings\":[\"taken over\"]");
    std::fs::write(&partial, &marked).unwrap();
    f.record("corpus/squat.bvh", "squat", 1.6);
    good(&[&corpus, "--out", &out]);
    let all = json(&f.0.join("s.json"));
    let warnings = |k: usize| all["rows"][k]["result"]["warnings"].to_string();
    assert!(!warnings(0).contains("taken over"), "squat has changed");
    assert!(warnings(1).contains("taken over"), "wave has not");
    // Other settings have other keys.
    std::fs::write(&partial, &marked).unwrap();
    good(&[&corpus, "--out", &out, "--strength", "1.1"]);
    assert!(!f.text("s.json").contains("taken over"));
}

#[test]
fn unchanged_code_compares_clean_and_wrong_gravity_does_not() {
    let f = Folder::new("compare");
    let (old, new) = (f.path("old.json"), f.path("new.json"));
    let clips = ["builtin:idle", "builtin:squat", "builtin:walk"];
    fn with<'a>(clips: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
        [clips, more].concat()
    }
    good(&with(&clips, &["--out", &old]));
    let text = good(&with(&clips, &["--out", &new, "--compare", &old]));
    assert!(
        text.contains("3 clips compared: 0 better, 0 worse"),
        "{text}"
    );

    let wrong = survey(&with(
        &clips,
        &["--out", &new, "--compare", &old, "--gravity", "10.3"],
    ));
    let text = String::from_utf8_lossy(&wrong.stdout).into_owned();
    assert_eq!(wrong.status.code(), Some(1), "{text}");
    for clip in clips {
        let line = format!("worse   {clip}: vertical impulse balance: 0.050, was 0.000");
        assert!(text.contains(&line), "{text}");
    }

    let other = survey(&with(
        &clips,
        &["--out", &new, "--compare", &old, "--strength", "2"],
    ));
    assert_eq!(other.status.code(), Some(1));
    let error = String::from_utf8_lossy(&other.stderr).into_owned();
    assert!(error.contains("strength was 1.0, is 2.0"), "{error}");
    let allowed = survey(&with(
        &clips,
        &[
            "--out",
            &new,
            "--compare",
            &old,
            "--strength",
            "2",
            "--across",
            "strength",
        ],
    ));
    let error = String::from_utf8_lossy(&allowed.stderr).into_owned();
    assert!(!error.contains("different settings"), "{error}");
}

#[test]
fn tables_are_put_into_a_page_with_their_command() {
    let f = Folder::new("page");
    std::fs::create_dir(f.0.join("all")).unwrap();
    let (out, page) = (f.path("all/quick.json"), f.path("limits.md"));
    let before = "# Limits\n\n<!-- survey quick begin: -->\n<!-- survey quick end -->\n\nEnd.\n";
    std::fs::write(&page, before).unwrap();
    let section = format!("{page}#quick");
    let folder = f.path("all");
    let given = [
        "builtin:idle",
        "--out",
        &out,
        "--page",
        &section,
        "--summary",
        &folder,
    ];
    good(&given);
    let once = f.text("limits.md");
    let begin = "# Limits\n\n<!-- survey quick begin: sinew survey builtin:idle --out quick.json --page \
        limits.md#quick --summary all -->";
    assert!(once.starts_with(begin), "{once}");
    assert!(once.ends_with("<!-- survey quick end -->\n\nEnd.\n"));
    assert!(
        once.contains("| stand | 1 | 1 of 1 |") && once.contains("| follows | 1 | 0 |"),
        "{once}"
    );
    assert!(
        !once.contains("| builtin:idle | stand |"),
        "clips are in the file"
    );
    let all = f.text("all/README.md");
    assert!(
        all.contains("| quick |") && all.contains("| 1 | 1 | – | 1 | 1 |"),
        "{all}"
    );
    good(&given);
    assert_eq!(f.text("limits.md"), once);
    let missing = survey(&[
        "builtin:idle",
        "--out",
        &out,
        "--page",
        &format!("{page}#none"),
    ]);
    assert_eq!(missing.status.code(), Some(1), "before anything is run");
    assert_eq!(
        survey(&["builtin:idle", "--out", &out, "--noise", "1"])
            .status
            .code(),
        Some(2)
    );
}

/// The clip under ordinary conditions.
fn conditions() -> Conditions {
    Conditions {
        body: Arc::new(Body::adult_man()),
        world: WorldParams::default(),
        strength: StrengthScale::default(),
        options: FigureOptions::default(),
        perturbations: Vec::new(),
        live_window: None,
        rehearsed: None,
    }
}

fn row(reference: &TrackingReference) -> SurveyRow {
    SurveyRow {
        clip: "walk".into(),
        input: "1".into(),
        error: None,
        result: Some(MeasuredClip {
            kind: MotionKind::Walk,
            clip_s: reference.recorded.duration(),
            walked: false,
            prepared_off_m: 0.0,
            warnings: Vec::new(),
            recorded_lacks: None,
            prepared_lacks: Lacks::default(),
            forecast: Default::default(),
            outcome: run(&conditions(), reference).unwrap(),
            copies: None,
            followed: None,
        }),
    }
}

#[test]
fn labels_of_one_foot_that_are_wrong_are_seen() {
    let body = Body::adult_man();
    let right = TrackingReference::authored(Arc::new(builtin(&body, "walk").unwrap()));
    let good = row(&right);
    // Labels of the left foot are given to the right one, too.
    let mut mirrored = right.clone();
    for phase in &mut mirrored.phases {
        phase.planted[1] = phase.planted[0];
    }
    // The left foot is labelled 0.15 s too early. (The figure lands up to 0.15 s after the label of this motion.)
    let mut early = right.clone();
    let mut cuts: Vec<f64> = (right.phases.iter())
        .flat_map(|p| [p.end - 0.15, p.end])
        .filter(|t| *t > 0.0)
        .collect();
    cuts.sort_by(f64::total_cmp);
    let mut start = 0.0;
    early.phases = cuts
        .into_iter()
        .map(|end| {
            let mut phase = right.phases[0];
            (phase.start, phase.end) = (start, end);
            let middle = 0.5 * (start + end);
            phase.planted = [right.labelled(middle + 0.15)[0], right.labelled(middle)[1]];
            start = end;
            phase
        })
        .collect();
    for (name, wrong) in [("mirrored", mirrored), ("early", early)] {
        let found = compare(std::slice::from_ref(&good), &[row(&wrong)]);
        assert!(found.regressions() > 0, "{name}: {}", found.text());
        assert!(
            found.text().contains("contact") || found.text().contains("touch-down"),
            "{name}: {}",
            found.text()
        );
    }
}

#[test]
fn a_stream_through_a_window_is_followed_like_a_clip() {
    let body = Body::adult_man();
    let reference = TrackingReference::authored(Arc::new(builtin(&body, "wave").unwrap()));
    let live = Conditions {
        live_window: Some(0.5),
        ..conditions()
    };
    let outcome = run(&live, &reference).unwrap();
    assert!(
        outcome.completed && outcome.fell_at_s.is_none(),
        "{outcome:?}"
    );
    assert!(outcome.recorded.mpjpe_global_mm < 60.0, "{outcome:?}");
    assert!(
        outcome.impulse_balance.unwrap().abs() < BALANCE,
        "{outcome:?}"
    );
}
