//! The `sinew` command as seen from a shell and a terminal: exit codes, pipes that end early, output without escape
//! codes, names and numbers. Method: the real binary with real pipes; motions are built in, or tiny BVH texts written
//! here.

use serde_json::Value;
use std::fmt::Write as _;
use std::io::{BufRead, BufReader, PipeReader, Read, Write as _};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const USAGE: i32 = 2;
const FALL: i32 = 3;

fn command(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sinew"));
    command.args(args).stdin(Stdio::null());
    command
}

fn sinew(args: &[&str]) -> Output {
    command(args).output().expect("the binary runs")
}

fn stdout(out: &Output) -> String {
    String::from_utf8(out.stdout.clone()).expect("UTF-8")
}

fn stderr(out: &Output) -> String {
    String::from_utf8(out.stderr.clone()).expect("UTF-8")
}

fn succeed(args: &[&str]) -> String {
    let out = sinew(args);
    assert!(out.status.success(), "sinew {args:?}: {}", stderr(&out));
    stdout(&out)
}

/// A directory of one test that is removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("sinew-cli-{}-{test}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a directory for the test");
        Self(path)
    }
    fn file(&self, name: &str, content: &str) -> String {
        let path = self.0.join(name);
        std::fs::write(&path, content).expect("a file");
        path.to_str().expect("UTF-8").to_owned()
    }
    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("UTF-8").to_owned()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Bones of a person of about 1.7 m in a T-pose: name, parent, offset in metres (x left, y up, z forward), and the end
/// of leaves.
const BONES: [(&str, Option<usize>, [f64; 3], Option<[f64; 3]>); 18] = [
    ("Hips", None, [0.0, 0.0, 0.0], None),
    ("Spine", Some(0), [0.0, 0.10, 0.0], None),
    ("Chest", Some(1), [0.0, 0.20, 0.0], None),
    ("Neck", Some(2), [0.0, 0.22, 0.0], None),
    ("Head", Some(3), [0.0, 0.10, 0.0], Some([0.0, 0.20, 0.0])),
    ("LeftShoulder", Some(2), [0.03, 0.18, 0.0], None),
    ("LeftArm", Some(5), [0.15, 0.0, 0.0], None),
    ("LeftForeArm", Some(6), [0.28, 0.0, 0.0], None),
    (
        "LeftHand",
        Some(7),
        [0.25, 0.0, 0.0],
        Some([0.17, 0.0, 0.0]),
    ),
    ("RightShoulder", Some(2), [-0.03, 0.18, 0.0], None),
    ("RightArm", Some(9), [-0.15, 0.0, 0.0], None),
    ("RightForeArm", Some(10), [-0.28, 0.0, 0.0], None),
    (
        "RightHand",
        Some(11),
        [-0.25, 0.0, 0.0],
        Some([-0.17, 0.0, 0.0]),
    ),
    ("LeftUpLeg", Some(0), [0.09, -0.02, 0.0], None),
    ("LeftLeg", Some(13), [0.0, -0.42, 0.0], None),
    (
        "LeftFoot",
        Some(14),
        [0.0, -0.41, 0.0],
        Some([0.0, -0.07, 0.14]),
    ),
    ("RightUpLeg", Some(0), [-0.09, -0.02, 0.0], None),
    ("RightLeg", Some(16), [0.0, -0.42, 0.0], None),
];
/// The right foot, the same as the left one.
const RIGHT_FOOT: (&str, [f64; 3], [f64; 3]) = ("RightFoot", [0.0, -0.41, 0.0], [0.0, -0.07, 0.14]);

/// A recording of a second of standing in that pose: `unit` metres per file unit, the y or the z axis up.
fn standing(unit: f64, z_up: bool, frame_time: &str, frames: usize) -> String {
    // Turning y up into z up about the x axis: (x, y, z) becomes (x, −z, y).
    let turned = |[x, y, z]: [f64; 3]| if z_up { [x, -z, y] } else { [x, y, z] };
    let triple = |v: [f64; 3]| {
        let [x, y, z] = turned(v).map(|c| c / unit);
        format!("{x:.6} {y:.6} {z:.6}")
    };
    let mut bones: Vec<(&str, Option<usize>, [f64; 3], Option<[f64; 3]>)> = BONES.to_vec();
    bones.push((RIGHT_FOOT.0, Some(17), RIGHT_FOOT.1, Some(RIGHT_FOOT.2)));
    let mut out = String::from("HIERARCHY\n");
    let mut channels = 0;
    write_bone(&bones, 0, &triple, &mut out, &mut channels);
    let _ = write!(out, "MOTION\nFrames: {frames}\nFrame Time: {frame_time}\n");
    let root = triple([0.0, 0.92, 0.0]);
    for _ in 0..frames {
        let _ = writeln!(out, "{root}{}", " 0".repeat(channels - 3));
    }
    out
}

fn write_bone(
    bones: &[(&str, Option<usize>, [f64; 3], Option<[f64; 3]>)],
    i: usize,
    triple: &impl Fn([f64; 3]) -> String,
    out: &mut String,
    channels: &mut usize,
) {
    let (name, parent, offset, end) = bones[i];
    let (kind, own) = match parent {
        None => (
            "ROOT",
            "6 Xposition Yposition Zposition Zrotation Yrotation Xrotation",
        ),
        Some(_) => ("JOINT", "3 Zrotation Yrotation Xrotation"),
    };
    *channels += if parent.is_none() { 6 } else { 3 };
    let _ = write!(
        out,
        "{kind} {name}\n{{\nOFFSET {}\nCHANNELS {own}\n",
        triple(offset)
    );
    for child in (0..bones.len()).filter(|c| bones[*c].1 == Some(i)) {
        write_bone(bones, child, triple, out, channels);
    }
    if let Some(end) = end {
        let _ = write!(out, "End Site\n{{\nOFFSET {}\n}}\n", triple(end));
    }
    out.push_str("}\n");
}

/// A pipe without a reader.
fn closed_pipe() -> std::io::PipeWriter {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    writer
}

/// A server whose standard output and standard error go to one pipe; ended when dropped.
struct Server {
    child: Child,
    address: String,
    first_line: String,
    lines: Option<BufReader<PipeReader>>,
}

impl Server {
    fn start(args: &[&str]) -> Self {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        let child = command(&["serve", "--listen", "127.0.0.1:0"])
            .args(args)
            .stdout(writer.try_clone().expect("the pipe"))
            .stderr(writer)
            .spawn()
            .expect("the binary runs");
        let mut lines = BufReader::new(reader);
        let mut first_line = String::new();
        lines.read_line(&mut first_line).expect("a line");
        let address = first_line
            .split_once("http://")
            .map(|(_, rest)| rest.split_whitespace().next().unwrap_or("").to_owned())
            .unwrap_or_default();
        Self {
            child,
            address,
            first_line,
            lines: Some(lines),
        }
    }

    /// The answer of the status page.
    fn status_page(&self) -> String {
        let mut stream = TcpStream::connect(&self.address).expect("the server accepts");
        stream
            .write_all(b"GET /status HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            .expect("a request");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        answer
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

const STAND: [&str; 4] = ["run", "builtin:idle", "--duration", "0.2"];
const FALLING: [&str; 6] = [
    "run",
    "builtin:idle",
    "--duration",
    "3",
    "--push",
    "120@chest@0.3:1,0,0",
];

#[test]
fn the_exit_code_tells_error_usage_and_fall_apart() {
    let code = |args: &[&str]| sinew(args).status.code().expect("no signal");
    assert_eq!(code(&STAND), 0);
    assert_eq!(code(&[&STAND[..], &["--fail-on-fall"]].concat()), 0);
    assert_eq!(code(&FALLING), 0, "a fall is a result");
    assert_eq!(code(&[&FALLING[..], &["--fail-on-fall"]].concat()), FALL);
    assert_eq!(code(&["run", "no/such.bvh"]), 1);
    for wrong in [
        &["run"][..],
        &["run", "builtin:idle", "--fly"],
        &["run", "builtin:idle", "--strength", "0"],
        &["run", "builtin:idle", "--rate", "5"],
        &["run", "builtin:idle", "--height", "9"],
        &["run", "builtin:idle", "--out", "a.txt"],
        &["run", "builtin:idle", "--horizon", "9"],
        &["run", "builtin:idle", "--unit", "0"],
        &["bodies", "--percentile", "1"],
        &["serve", "--set", "max_worlds=0"],
        &["serve", "--log", "sinew=loud"],
        &["push", "127.0.0.1:1", "a.bvh", "--loss", "2"],
    ] {
        assert_eq!(code(wrong), USAGE, "sinew {wrong:?}");
    }
    let text = succeed(&["run", "--help"]);
    let (options, paper) = text
        .split_once("Paper's controller:")
        .expect("a heading of its own");
    assert!(options.contains("--fail-on-fall") && options.contains("--duration"));
    for part in ["[,yaw°]", "capsule:R,L", "plane:nx,ny,nz", "-CLIP is added"] {
        assert!(options.contains(part), "{part}: {options}");
    }
    assert!(paper.contains("--metric") && !paper.contains("--duration"));
    for help in [&["--help"][..], &["run", "--help"]] {
        let text = succeed(help);
        for line in ["0  success", "1  error", "2  usage", "3  fall"] {
            assert!(text.contains(line), "sinew {help:?}: {text}");
        }
    }
}

#[test]
fn wrong_arguments_are_refused_by_their_names_before_anything_is_done() {
    let dir = Scratch::new("usage");
    let bvh = dir.file("idle.bvh", &standing(0.01, false, "0.033333", 30));
    let (folder, out) = (dir.path(""), dir.path("out.csv"));
    let (survey, missing) = (dir.path("survey.json"), dir.path("none.bvh"));
    let nobody = "127.0.0.1:1";
    let two_hands = "a load held in two hands cannot be rehearsed";
    let refused: [(&[&str], &str); 26] = [
        (
            &["run", "builtin:lif"],
            "there is no built-in motion \"lif\"",
        ),
        (&["run", &folder], "is a folder; name its files"),
        (
            &["run", "builtin:idle", &bvh, "--out", &out],
            "two clips are called idle",
        ),
        (
            &["run", "builtin:idle", "--report", "no/such/r.json"],
            "there is no folder no/such",
        ),
        (
            &["run", "builtin:idle", "--substeps", "0"],
            "--substeps 0: outside 1…16",
        ),
        (
            &["run", "builtin:idle", "--age", "3"],
            "--age 3: outside 6…90",
        ),
        (
            &["run", "builtin:idle", "--tempo", "0"],
            "--tempo 0: outside 0.5…2",
        ),
        (&["run", &bvh, "--tempo", "3"], "--tempo 3: outside 0.5…2"),
        (
            &["lint", "builtin:idle", "--tempo", "-1"],
            "--tempo -1: outside 0.5…2",
        ),
        (
            &["run", "builtin:idle", "--load", "-3@r_hand"],
            "mass (kg): -3 is outside 0…500",
        ),
        (
            &["run", "builtin:idle", "--grip", "-1"],
            "--grip -1: outside 0…",
        ),
        (
            &["rehearse", "builtin:wave", "--out", "no/such/o.bvh"],
            "there is no folder no/such",
        ),
        (
            &["rehearse", "builtin:wave", "--load", "3@r_hand+auto"],
            two_hands,
        ),
        (
            &["rehearse", "builtin:wave", "--load", "3@r_hand+l_hand"],
            two_hands,
        ),
        (
            &["rehearse", "builtin:wave", "--load", "3@r_hand@1..2"],
            "--load 3@r_hand@1..2: ",
        ),
        (
            &["survey", &missing, "--out", &survey],
            "there is no such file or folder",
        ),
        (
            &["survey", "builtin:lif", "--out", &survey],
            "there is no built-in motion",
        ),
        (
            &[
                "survey",
                "builtin:idle",
                "--out",
                &survey,
                "--noise",
                "-1mm,1deg",
            ],
            "noise -1 mm",
        ),
        (
            &[
                "survey",
                "builtin:idle",
                "--out",
                &survey,
                "--follow",
                "assisted",
                "--rehearse",
                "--load",
                "3@r_hand+always",
            ],
            two_hands,
        ),
        (
            &["survey", "builtin:idle", "--out", &survey, "--rehearse"],
            "--rehearse needs --follow",
        ),
        (&["push", nobody, "builtin:walk"], "push takes BVH files"),
        (&["push", nobody, &folder], "is a folder"),
        (
            &["push", nobody, &bvh, "--playout-delay-ms", "-5"],
            "--playout-delay-ms -5: outside",
        ),
        (
            &["push", nobody, &bvh, "--duration", "-1"],
            "--duration -1 s: must be positive",
        ),
        (
            &["watch", nobody, "demo", "--count", "0"],
            "--count 0: must be at least 1",
        ),
        (
            &["watch", nobody, "demo", "--every", "0"],
            "--every 0: outside 1…1000",
        ),
    ];
    for (args, says) in refused {
        let done = sinew(args);
        let said = stderr(&done);
        assert_eq!(done.status.code(), Some(USAGE), "sinew {args:?}: {said}");
        assert!(said.contains(says), "sinew {args:?}: {said}");
    }
    let files = std::fs::read_dir(&dir.0).expect("the directory");
    assert_eq!(files.count(), 1, "nothing was written");
    // Plain tracking may have any load.
    let strict = [
        "rehearse",
        "builtin:idle",
        "--follow",
        "strict",
        "--load",
        "1@r_hand+auto",
    ];
    succeed(&strict);
}

#[test]
fn a_secret_that_is_not_there_can_be_made() {
    let dir = Scratch::new("token");
    let key = dir.path("t.key");
    let token = ["token", "--key", &key, "--for", "ada"];
    let out = sinew(&token);
    assert_eq!(out.status.code(), Some(1));
    let said = stderr(&out);
    assert!(said.contains("`--new-key` makes one"), "{said}");
    assert!(succeed(&[&token[..], &["--new-key"]].concat()).contains('.'));
}

#[cfg(target_os = "linux")]
#[test]
fn a_survey_of_one_clip_that_cannot_be_read_says_so_once() {
    let dir = Scratch::new("unreadable");
    let out = dir.path("survey.json");
    // Reading the beginning of a process's memory fails.
    let text = succeed(&["survey", "/proc/self/mem", "--out", &out]);
    assert!(
        text.contains("1 clip, 1 of them could not be read"),
        "{text}"
    );
    assert_eq!(text.matches("cannot be read").count(), 1, "{text}");
}

#[test]
fn json_is_all_that_is_printed_and_the_same_as_the_report() {
    let dir = Scratch::new("json");
    let path = dir.path("report.json");
    let text = succeed(&[&STAND[..], &["--json", "--report", &path]].concat());
    let report: Value = serde_json::from_str(&text).expect("JSON and nothing else");
    assert_eq!(report["clip"], "idle");
    assert_eq!(report["body"]["name"], "adult-man");
    assert_eq!(text, std::fs::read_to_string(&path).expect("the report"));
    let two = succeed(&[
        "run",
        "builtin:idle",
        "builtin:wave",
        "--duration",
        "0.1",
        "--json",
    ]);
    let two: Value = serde_json::from_str(&two).expect("JSON");
    assert_eq!(two.as_array().map(Vec::len), Some(2));
}

#[test]
fn the_table_explains_its_columns() {
    let text = succeed(&STAND);
    for part in [
        "tracking error",
        "balance margin",
        "no fall",
        "The target is moved along with the feet",
        "sinew survey",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let heading = text.lines().nth(1).expect("a heading");
    let line = text.lines().nth(2).expect("the clip");
    assert!(heading.starts_with("clip") && line.starts_with("idle"));
    assert!(line.chars().count() > heading.find("result").expect("a column"));
}

#[test]
fn measures_against_the_moved_target_are_called_tracking_errors() {
    let text = succeed(&[&STAND[..], &["--json"]].concat());
    let report: Value = serde_json::from_str(&text).expect("JSON");
    for name in [
        "tracking_joint_rms_deg",
        "tracking_joint_max_deg",
        "tracking_mpjpe_root_mm",
        "tracking_mpjpe_global_mm",
        "tracking_root_max_mm",
    ] {
        assert!(report[name].is_f64(), "{name}: {}", report[name]);
    }
    assert!(report["tracking_joint_rms_by_dof_deg"].is_object());
    for old in [
        "joint_rms_deg",
        "joint_max_deg",
        "mpjpe_root_mm",
        "mpjpe_global_mm",
        "root_error_max_mm",
        "joint_rms_by_dof_deg",
    ] {
        assert!(report.get(old).is_none(), "{old} sounds like the recording");
    }
}

#[test]
fn shells_get_completions() {
    // Those of PowerShell and Elvish complete options, not their values.
    for (shell, values) in [
        ("bash", true),
        ("zsh", true),
        ("fish", true),
        ("powershell", false),
        ("elvish", false),
    ] {
        let script = succeed(&["completions", shell]);
        for word in ["fail-on-fall", "completions"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
        assert!(!values || script.contains("adult-woman"), "{shell}");
    }
}

#[test]
fn a_reader_that_ends_early_ends_the_command_quietly() {
    let dir = Scratch::new("pipe");
    let bvh = dir.file("stand.bvh", &standing(0.01, false, "0.033333", 30));
    let converted = dir.path("out.csv");
    for args in [
        &["bodies"][..],
        &["bodies", "--body", "child", "--sources"],
        &["bodies", "--json"],
        &["run", "builtin:idle", "--duration", "0.1"],
        &["run", "builtin:idle", "--duration", "0.1", "--json"],
        &["lint", &bvh],
        &["lint", &bvh, "--json"],
        &["convert", &bvh, &converted],
        &["completions", "bash"],
        &["--help"],
        &["run", "--help"],
    ] {
        let out = command(args)
            .stdout(closed_pipe())
            .output()
            .expect("the binary runs");
        let errors = stderr(&out);
        assert!(out.status.success(), "sinew {args:?}: {errors}");
        assert!(
            !errors.contains("panicked") && !errors.contains("error"),
            "sinew {args:?}: {errors}"
        );
    }
    // An unread error message is still an error, not a panic.
    let out = command(&["run", "no/such.bvh"])
        .stderr(closed_pipe())
        .status();
    assert_eq!(out.expect("the binary runs").code(), Some(1));
}

#[test]
fn files_and_exit_code_do_not_depend_on_the_reader() {
    let dir = Scratch::new("pipe-files");
    let path = dir.path("report.json");
    let out = command(&[&FALLING[..], &["--report", &path, "--fail-on-fall"]].concat())
        .stdout(closed_pipe())
        .status()
        .expect("the binary runs");
    assert_eq!(out.code(), Some(FALL));
    let report = std::fs::read_to_string(&path).expect("the report");
    assert!(report.contains("\"fell_at_s\""));
}

#[test]
fn files_and_pipes_get_no_escape_codes() {
    for args in [
        &STAND[..],
        &["run", "builtin:fly"],
        &["run", "--help"],
        &["bodies", "--body", "nobody"],
        &["bodies"],
    ] {
        let out = sinew(args);
        let all = stdout(&out) + &stderr(&out);
        assert!(!all.contains('\x1b'), "sinew {args:?}: {all:?}");
    }
    let mut server = Server::start(&["--no-demo", "--log", "debug"]);
    let _ = server.status_page();
    let mut lines = server.lines.take().expect("the pipe");
    server.child.kill().expect("the server runs");
    let mut log = String::new();
    lines.read_to_string(&mut log).expect("the log");
    assert!(log.contains("setting listen"), "{log}");
    assert!(
        !log.contains("setting max_worlds"),
        "defaults are not logged: {log}"
    );
    assert!(!log.contains('\x1b'), "{log:?}");
}

#[test]
fn the_first_line_of_serve_is_an_address_that_answers() {
    for args in [&["--no-demo"][..], &[]] {
        let server = Server::start(args);
        assert!(!server.address.is_empty(), "{:?}", server.first_line);
        let answer = server.status_page();
        assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    }
}

#[test]
fn health_says_whether_a_server_serves() {
    let server = Server::start(&["--no-demo"]);
    for asked in [
        &[][..],
        &["--live"],
        &["--service", "sinew.v1.WorldService"],
    ] {
        let args = [&["health", &server.address], asked].concat();
        assert_eq!(succeed(&args), "serving\n", "{asked:?}");
    }
    let out = sinew(&["health", &server.address, "--service", "sinew.v1.NoService"]);
    assert_eq!(out.status.code(), Some(1), "{}", stderr(&out));
    let address = server.address.clone();
    drop(server);
    let out = sinew(&["health", &address]);
    assert_eq!(out.status.code(), Some(1), "{}", stderr(&out));
}

#[test]
fn settings_are_checked_and_shown_with_where_they_come_from() {
    let scratch = Scratch::new("config");
    let file = scratch.file("sinew.toml", "max_clips = 7\n");
    let with = |args: &[&str], variables: &[(&str, &str)]| {
        let mut command = command(args);
        command.envs(variables.iter().copied());
        command.output().expect("the binary runs")
    };
    let set = ["--set", "listen=127.0.0.1:0"];
    let args = [
        &["config", "show", "--config", &file, "--log", "warn"],
        &set[..],
    ]
    .concat();
    let out = with(&args, &[("SINEW_MAX_WORLDS", "4"), ("SINEW_TOKEN", "hush")]);
    let shown = stdout(&out);
    let line = |name: &str| {
        let line = shown.lines().find(|l| l.starts_with(&format!("{name} = ")));
        line.unwrap_or_else(|| panic!("{name} is not in {shown}"))
    };
    for (name, value, source) in [
        ("max_worlds", "4", "SINEW_MAX_WORLDS"),
        ("max_clips", "7", &file),
        ("log", "warn", "flag"),
        ("tick_workers", "0", "default"),
    ] {
        let line = line(name);
        assert!(line.starts_with(&format!("{name} = {value} ")), "{line}");
        assert!(line.ends_with(&format!("# {source}")), "{line}");
    }
    assert!(!shown.contains("hush"));

    let check = [&["config", "check"], &set[..]].concat();
    assert!(with(&check, &[]).status.success());
    let misspelt = with(&check, &[("SINEW_MAX_WORDLS", "4")]);
    assert_eq!(misspelt.status.code(), Some(USAGE));
    let said = stderr(&misspelt);
    assert!(said.contains("did you mean SINEW_MAX_WORLDS?"), "{said}");
    // All faults are named at once.
    let no_key = scratch.file("empty.json", "{\"keys\": []}");
    let secret = scratch.file("secret", "password1");
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let listen = format!("listen={}", taken.local_addr().expect("an address"));
    let cert = format!("tls_cert={}", scratch.path("none.pem"));
    let key = format!("tls_key={}", scratch.path("none.key"));
    let (keys, secret) = (
        format!("jwt_keys={no_key}"),
        format!("jwt_secret_file={secret}"),
    );
    let data_dir = format!("data_dir={no_key}/worlds");
    let mut args = vec!["config", "check"];
    for setting in [&listen, &cert, &key, &keys, &secret, &data_dir] {
        args.extend(["--set", setting]);
    }
    let out = with(&args, &[]);
    assert_eq!(out.status.code(), Some(1));
    let said = stderr(&out);
    for name in [
        "listen",
        "tls_cert",
        "jwt_keys",
        "jwt_secret_file",
        "data_dir",
    ] {
        assert!(
            said.lines().any(|l| l.starts_with(&format!("{name}: "))),
            "{name}: {said}"
        );
    }
    assert!(
        said.contains("5 problems") && !said.contains("password1"),
        "{said}"
    );
}

#[test]
fn a_server_whose_output_is_closed_goes_on() {
    let mut server = Server::start(&["--no-demo", "--log", "debug"]);
    drop(server.lines.take());
    for _ in 0..3 {
        let answer = server.status_page();
        assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    }
    let watched = command(&["watch", &server.address, "none"]).output();
    assert_eq!(watched.expect("the binary runs").status.code(), Some(1));
    assert!(server.child.try_wait().expect("the server").is_none());
}

#[test]
fn watch_ends_quietly_when_its_reader_does() {
    let server = Server::start(&[]);
    let out = command(&["watch", &server.address, "demo"])
        .stdout(closed_pipe())
        .output()
        .expect("the binary runs");
    assert!(out.status.success(), "{}", stderr(&out));
}

#[test]
fn unit_and_up_axis_can_be_given_wherever_a_recording_is_read() {
    let dir = Scratch::new("unit");
    let bvh = dir.file("stand.bvh", &standing(0.01, true, "0.033333", 30));
    let given = ["--unit", "0.0102", "--up", "z"];
    for args in [
        &["lint", &bvh, "--json"][..],
        &["run", &bvh, "--duration", "0.1", "--json"],
    ] {
        let text = succeed(&[args, &given].concat());
        let report: Value = serde_json::from_str(&text).expect("JSON");
        let r = &report["retarget"];
        assert_eq!(r["unit_given"], true, "{text}");
        assert_eq!(r["unit_m"], 0.0102);
        assert_eq!(r["up"], "z");
    }
    let path = dir.path("out.json");
    succeed(&[&["convert", &bvh, &path][..], &given].concat());
    let text = std::fs::read_to_string(&path).expect("the motion");
    let motion: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(motion["retarget"]["up"], "z");
    assert_eq!(motion["retarget"]["unit_given"], true);
    let server = Server::start(&["--no-demo", "--log", "error"]);
    let push = ["push", &server.address, &bvh, "--duration", "0.2"];
    assert!(succeed(&[&push[..], &given].concat()).contains("streaming"));
}

#[test]
fn numbers_are_printed_for_people() {
    let dir = Scratch::new("numbers");
    // 0.0083333334 s are 119.99999 Hz; the unit is 0.056444444 m.
    let text = standing(0.056_444_444, false, "0.0083333334", 120);
    let bvh = dir.file("stand.bvh", &text);
    let words = succeed(&["lint", &bvh, "--unit", "0.056444444"]);
    assert!(words.contains("recorded at 120 Hz"), "{words}");
    assert!(words.contains("1 file unit = 0.0564 m"), "{words}");
    for long in ["119.9", "0.056444"] {
        assert!(!words.contains(long), "{long}: {words}");
    }
    let csv = dir.path("out.csv");
    let words = succeed(&["convert", &bvh, &csv, "--unit", "0.056444444"]);
    assert!(words.contains(" Hz, written to"), "{words}");
    assert!(!words.contains("99999"), "{words}");
}

#[test]
fn warnings_of_the_retargeting_are_shown_beside_the_result() {
    let dir = Scratch::new("warnings");
    let good = dir.path("idle.bvh");
    succeed(&["convert", "builtin:idle", &good]);
    // Left named right: the reader notices by feet and knees, exchanges the names, and warns.
    let text = std::fs::read_to_string(&good).expect("our own BVH");
    let text = text.replace("left", "other");
    let text = text.replace("right", "left").replace("other", "right");
    let swapped = dir.file("swapped.bvh", &text);
    let converted = dir.path("swapped.csv");
    for args in [
        &["run", &swapped, "--duration", "0.1", "--json"][..],
        &["convert", &swapped, &converted],
    ] {
        let out = sinew(args);
        let errors = stderr(&out);
        assert!(out.status.success(), "{errors}");
        assert!(errors.contains("warning: swapped: "), "{errors}");
        assert!(!stdout(&out).contains("warning: "), "standard error only");
    }
}

#[test]
fn one_body_has_one_name_everywhere() {
    let list: Value = serde_json::from_str(&succeed(&["bodies", "--json"])).expect("JSON");
    let names: Vec<&str> = list["bodies"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|b| b["name"].as_str())
        .collect();
    let want = [
        "adult-man",
        "adult-woman",
        "child",
        "older-man",
        "older-woman",
    ];
    assert_eq!(names, want);
    let text = succeed(&["bodies"]);
    let server = Server::start(&["--no-demo", "--log", "error"]);
    let runtime = tokio::runtime::Runtime::new().expect("a runtime");
    let client = runtime
        .block_on(sinew_client::Client::connect(&server.address))
        .expect("the server answers");
    let by_value = "female-25y-1680mm-61500g";
    for name in want.into_iter().chain([by_value]) {
        assert!(text.contains(name), "{name}: {text}");
        let body: Value =
            serde_json::from_str(&succeed(&["bodies", "--body", name, "--json"])).expect("JSON");
        assert_eq!(body["name"], name);
        let served = runtime
            .block_on(client.body(&format!("bodies/{name}")))
            .expect("the API knows it");
        let profile = served.profile.expect("a profile");
        assert_eq!(Some(profile.height_m), body["height_m"].as_f64(), "{name}");
        assert_eq!(Some(profile.mass_kg), body["mass_kg"].as_f64(), "{name}");
    }
    for wrong in ["man", "woman", "Adult-Man", "bodies/adult-man", "robot"] {
        let out = sinew(&["run", "builtin:idle", "--body", wrong]);
        assert_eq!(out.status.code(), Some(USAGE), "{wrong}");
        let error = stderr(&out);
        assert!(want.iter().all(|n| error.contains(n)), "{wrong}: {error}");
    }
    let refused = runtime
        .block_on(client.body("bodies/robot"))
        .expect_err("there is no robot");
    assert!(
        want.iter().all(|n| refused.message().contains(n)),
        "{refused}"
    );
}

#[test]
fn help_texts_name_things_by_their_terms() {
    for command in [
        "serve", "push", "watch", "run", "lint", "convert", "paper", "walking", "bodies",
    ] {
        let text = succeed(&[command, "--help"]);
        let riddles = ["who", "nobody", "wanted", "guessed", "whoever"];
        for word in text.split(|c: char| !c.is_alphabetic()) {
            assert!(
                !riddles.contains(&word.to_lowercase().as_str()),
                "sinew {command} --help says {word:?}"
            );
        }
    }
}

/// A bench of two worlds that outlasts every wait of a test, with its data directory below `parent`.
#[cfg(unix)]
fn bench_below(parent: &Path) -> std::process::Child {
    Command::new(env!("CARGO_BIN_EXE_sinew"))
        .args(["bench", "--worlds", "2", "--seconds", "600"])
        .args(["--durability", "group", "--data-dir"])
        .arg(parent)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the binary starts")
}

/// Waits until another process has made a directory.
#[cfg(unix)]
#[allow(clippy::disallowed_methods, reason = "another process makes it")]
fn comes(dir: &Path) {
    let begun = Instant::now();
    while !dir.is_dir() {
        assert!(begun.elapsed() < Duration::from_secs(60), "{dir:?}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[cfg(unix)]
#[test]
fn a_bench_that_is_interrupted_takes_its_directory_away_and_no_other() {
    let parent = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interrupted_bench");
    let _ = std::fs::remove_dir_all(&parent); // of an earlier run
    let other = parent.join("sinew-bench-1");
    std::fs::create_dir_all(&other).expect("a directory");
    std::fs::write(other.join("kept"), "of another bench").expect("a file");
    let here = || {
        let all = std::fs::read_dir(&parent).expect("it is there");
        let mut names: Vec<_> = all.map(|f| f.expect("an entry").file_name()).collect();
        names.sort();
        names
    };
    for signal in ["-INT", "-TERM"] {
        let mut bench = bench_below(&parent);
        let own = parent.join(format!("sinew-bench-{}", bench.id()));
        comes(&own.join("worlds"));
        let pid = bench.id().to_string();
        let sent = Command::new("kill").args([signal, &pid]).status();
        assert!(sent.expect("kill is there").success());
        assert_eq!(bench.wait().expect("it ends").code(), Some(1), "{signal}");
        assert_eq!(here(), ["sinew-bench-1"], "{signal}");
    }
    // A server that does not start leaves nothing behind either.
    let broken = sinew(&[
        "bench",
        "--durability",
        "group",
        "--data-dir",
        parent.to_str().expect("UTF-8"),
        "--set",
        "max_worlds=none",
    ]);
    assert_eq!(broken.status.code(), Some(1));
    assert_eq!(here(), ["sinew-bench-1"]);
    assert!(other.join("kept").is_file());
}
