//! Cost of an embedded store under the load of a log of inputs and checkpoints.
//!
//! `sinew-store-bench run ENGINE FORM WORLDS SECONDS DIR` writes at 60 Hz and prints one row; `recover ENGINE WORLDS
//! DIR` opens the files of a killed `run` and reads the data that a restart needs; `table SECONDS DIR` does all of it
//! and prints the table. Every engine holds the same thing: a log of records by a key that grows, cut off at its old
//! end.

mod engines;

use engines::{Record, open};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Figures in one world.
const FIGURES: usize = 10;
/// Ticks per second.
const RATE_HZ: f64 = 60.0;
/// Time between two commits.
const GROUP: Duration = Duration::from_millis(10);
/// Bytes of one figure in a checkpoint.
const CHECKPOINT_BYTES: usize = 40_000;
/// Time between two checkpoints of one world, s.
const CHECKPOINT_S: f64 = 5.0;
/// History that is kept, s.
const KEEP_S: f64 = 60.0;
/// Interval at which old history is cut off, s.
const CUT_S: f64 = 1.0;

/// Bytes of one figure and tick: every frame, or only the changes if a driver sends 15 frames a second.
const FORMS: [(&str, usize); 2] = [("full", 350), ("changed", 90)];
const ENGINES: [&str; 4] = ["sqlite", "redb", "fjall", "plain"];

/// Incompressible bytes, like joint angles.
fn noise() -> Vec<u8> {
    let mut x = 0x9e37_79b9_7f4a_7c15_u64;
    let mut out = Vec::with_capacity(8 << 20);
    while out.len() < 8 << 20 {
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        out.extend_from_slice(&x.to_le_bytes());
    }
    out
}

/// Processor time used by this process, s.
fn cpu_s() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").expect("procfs");
    let fields: Vec<&str> = text
        .rsplit(')')
        .next()
        .expect("fields")
        .split_whitespace()
        .collect();
    let ticks: f64 =
        fields[11].parse::<f64>().expect("utime") + fields[12].parse::<f64>().expect("stime");
    ticks / 100.0
}

/// Bytes that this process has caused to be written.
fn written() -> f64 {
    let text = std::fs::read_to_string("/proc/self/io").expect("procfs");
    let line = text.lines().find_map(|l| l.strip_prefix("write_bytes: "));
    line.expect("write_bytes").parse().expect("a number")
}

fn disk_bytes(dir: &Path) -> u64 {
    let Ok(entries) = std::fs::read_dir(dir) else {
        return 0;
    };
    entries
        .flatten()
        .map(|e| {
            if e.path().is_dir() {
                disk_bytes(&e.path())
            } else {
                e.metadata().map_or(0, |m| m.len())
            }
        })
        .sum()
}

fn key(group: u64, slot: u64) -> u64 {
    group << 20 | slot
}

/// Writes as a server would: each group holds the ticks that fell due, of worlds whose phases are spread.
fn run(engine: &str, form: &str, worlds: usize, seconds: f64, dir: &Path) {
    let bytes = FORMS.iter().find(|f| f.0 == form).expect("a form").1 * FIGURES;
    let noise = noise();
    let mut store = open(engine, dir);
    let (cpu, io) = (cpu_s(), written());
    let begun = Instant::now();
    let mut payload = 0_u64;
    let mut commits: Vec<Duration> = Vec::new();
    let mut late = 0_u64;
    let mut ticks = vec![0_u64; worlds];
    let mut checkpoints = vec![0_u64; worlds];
    let mut first_group: BTreeMap<u64, u64> = BTreeMap::new(); // by second
    let mut group = 0_u64;
    let mut cut_at = CUT_S;
    loop {
        let due = GROUP * (group as u32 + 1);
        let now = begun.elapsed();
        if now < due {
            std::thread::sleep(due - now);
        } else if now > due + 10 * GROUP {
            late += 1;
        }
        let t = begun.elapsed().as_secs_f64();
        if t >= seconds {
            break;
        }
        group = (t / GROUP.as_secs_f64()) as u64;
        first_group.entry(t as u64).or_insert(group);
        let mut records: Vec<Record<'_>> = Vec::new();
        let piece = |n: usize, k: u64| {
            let from = (k as usize * 4099) % (noise.len() - n);
            &noise[from..from + n]
        };
        for w in 0..worlds {
            let phase = w as f64 / worlds as f64;
            let upto = ((t * RATE_HZ) - phase).max(0.0) as u64;
            while ticks[w] < upto {
                ticks[w] += 1;
                let slot = records.len() as u64;
                records.push(Record {
                    key: key(group, slot),
                    world: w as u32,
                    tick: ticks[w],
                    checkpoint: false,
                    bytes: piece(bytes, ticks[w] + w as u64),
                });
            }
            let upto = ((t / CHECKPOINT_S) - phase).max(0.0) as u64;
            while checkpoints[w] < upto {
                checkpoints[w] += 1;
                let slot = records.len() as u64;
                records.push(Record {
                    key: key(group, slot),
                    world: w as u32,
                    tick: ticks[w],
                    checkpoint: true,
                    bytes: piece(CHECKPOINT_BYTES * FIGURES, ticks[w] + w as u64),
                });
            }
        }
        payload += records.iter().map(|r| r.bytes.len() as u64).sum::<u64>();
        let cut = (t >= cut_at).then(|| {
            cut_at = t + CUT_S;
            let second = (t - KEEP_S).floor();
            (second >= 0.0)
                .then(|| first_group.get(&(second as u64)).map(|g| key(*g, 0)))
                .flatten()
        });
        let start = Instant::now();
        store.commit(&records, cut.flatten());
        commits.push(start.elapsed());
    }
    let wall = begun.elapsed().as_secs_f64();
    let cpu = (cpu_s() - cpu) / wall;
    let amplification = (written() - io) / payload as f64;
    commits.sort();
    let at = |q: f64| commits[((commits.len() - 1) as f64 * q) as usize].as_secs_f64() * 1e3;
    let held = payload as f64 * (KEEP_S / wall).min(1.0);
    println!(
        "| {engine} | {form} | {:.1} | {:.1} % | {amplification:.2} | {:.1} / {:.1} / {:.0} | {late} | {:.2} |",
        payload as f64 / wall / 1e6,
        cpu * 100.0,
        at(0.5),
        at(0.99),
        at(1.0),
        disk_bytes(dir) as f64 / held,
    );
    drop(store);
}

/// Opens the existing store, finds the latest checkpoint of each world and reads the inputs after it.
fn recover(engine: &str, worlds: usize, dir: &Path) {
    let start = Instant::now();
    let mut store = open(engine, dir);
    let opened = start.elapsed();
    let mut found = BTreeMap::new();
    let (mut inputs, mut bytes) = (0_usize, 0_usize);
    store.backwards(&mut |r| {
        if found.contains_key(&r.world) {
            return true;
        }
        bytes += r.bytes.len();
        if r.checkpoint {
            found.insert(r.world, r.tick);
        } else {
            inputs += 1;
        }
        found.len() < worlds
    });
    println!(
        "| {engine} | {:.0} | {:.0} | {} of {worlds} | {inputs} | {:.1} |",
        opened.as_secs_f64() * 1e3,
        start.elapsed().as_secs_f64() * 1e3,
        found.len(),
        bytes as f64 / 1e6,
    );
}

fn clean(dir: &Path) {
    let _ = std::fs::remove_dir_all(dir);
    std::fs::create_dir_all(dir).expect("a directory");
}

fn table(seconds: &str, dir: &Path) {
    let me = std::env::current_exe().expect("this program");
    println!("1,000 driven figures: 100 worlds of 10, {seconds} s, {KEEP_S} s kept\n");
    println!(
        "| engine | form | payload MB/s | CPU of one core | written / payload | commit p50 / p99 / max ms \
              | groups > 100 ms late | size / payload held |\n|---|---|---|---|---|---|---|---|"
    );
    for (form, _) in FORMS {
        for engine in ENGINES {
            clean(dir);
            let args = ["run", engine, form, "100", seconds];
            let status = Command::new(&me)
                .args(args)
                .arg(dir)
                .status()
                .expect("a run");
            assert!(status.success(), "{engine}");
        }
    }
    println!("\nRestart after kill -9: 16 worlds of 10 figures after 20 s\n");
    println!(
        "| engine | open ms | all read ms | worlds | inputs read | MB read |\n|---|---|---|---|---|---|"
    );
    for engine in ENGINES {
        clean(dir);
        let mut child = Command::new(&me)
            .args(["run", engine, "full", "16", "600"])
            .arg(dir)
            .stdout(Stdio::null())
            .spawn()
            .expect("a run");
        std::thread::sleep(Duration::from_secs(20));
        child.kill().expect("a kill");
        child.wait().expect("its end");
        std::io::stdout().flush().expect("stdout");
        let status = Command::new(&me)
            .args(["recover", engine, "16"])
            .arg(dir)
            .status()
            .expect("a recovery");
        assert!(status.success(), "{engine}");
    }
    let _ = std::fs::remove_dir_all(dir);
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let number = |s: &str| s.parse::<usize>().expect("a number");
    match args.as_slice() {
        ["run", engine, form, worlds, seconds, dir] => {
            run(
                engine,
                form,
                number(worlds),
                number(seconds) as f64,
                Path::new(dir),
            );
        }
        ["recover", engine, worlds, dir] => recover(engine, number(worlds), Path::new(dir)),
        ["table", seconds, dir] => table(seconds, Path::new(dir)),
        _ => {
            eprintln!(
                "table SECONDS DIR | run ENGINE FORM WORLDS SECONDS DIR | recover ENGINE WORLDS DIR"
            );
            std::process::exit(2);
        }
    }
}
