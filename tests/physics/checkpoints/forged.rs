//! Goal: a checkpoint made by a stranger, with a correct checksum, is refused or gives a world that can be stepped:
//! nothing panics, no tick runs forever, nothing allocates memory without bound. Method: states of figures that do
//! everything are taken apart, changed where a stranger would, and put together again: bytes, floating-point numbers
//! that are not finite, huge or tiny, numbers of things in the length that integers take, bytes left out or added, also
//! in bodies and clips. Restored worlds are stepped for a second. A watchdog ends the process at a case that takes too
//! long, and names it.
//!
//! `SINEW_FORGED` sets the number of cases, for example 100000, and `SINEW_FORGED_FROM` the first case.

use super::{bytes, restored, streamed, things, transitions};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};
use sinew_physics::world::World;
use sinew_physics::world::checkpoint::Checkpoint;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, mpsc};
use std::time::Duration;
use xxhash_rust::xxh3::{xxh3_64, xxh3_128};

/// Ticks that a restored world does.
const TICKS: u64 = 60;
/// A case that takes longer counts as endless.
const LONGEST: Duration = Duration::from_secs(20);
const HEADER: usize = 44;

/// The content of a checkpoint, as it is written.
#[derive(Clone, Serialize, Deserialize)]
struct Content {
    definitions: Vec<Definition>,
    state: Vec<u8>,
    beside: Vec<u8>,
}

#[derive(Clone, Serialize, Deserialize)]
struct Definition {
    kind: u32,
    hash: [u8; 16],
    bytes: Option<Vec<u8>>,
}

/// A checkpoint that is taken apart.
struct Taken {
    header: Vec<u8>,
    content: Content,
}

impl Taken {
    fn of(good: &[u8]) -> Self {
        Self {
            header: good[..HEADER].to_vec(),
            content: postcard::from_bytes(&good[HEADER..]).unwrap(),
        }
    }

    /// Put together again with checksums that fit.
    fn forged(&self, rng: &mut Pcg64Mcg) -> Vec<u8> {
        let mut content = self.content.clone();
        if rng.random_range(0..8) == 0 {
            let n = content.definitions.len();
            let definition = &mut content.definitions[rng.random_range(0..n)];
            let bytes = definition.bytes.as_mut().unwrap();
            change(bytes, rng);
            let hash = xxh3_128(bytes) ^ u128::from(definition.kind);
            definition.hash = hash.to_le_bytes();
        } else {
            (0..rng.random_range(1..5)).for_each(|_| change(&mut content.state, rng));
        }
        let mut out = self.header.clone();
        out.extend(postcard::to_stdvec(&content).unwrap());
        let length = (out.len() - HEADER) as u64;
        out[28..36].copy_from_slice(&length.to_le_bytes());
        let mut all = [0; 24];
        all[..16].copy_from_slice(&out[12..28]);
        all[16..].copy_from_slice(&xxh3_64(&out[HEADER..]).to_le_bytes());
        out[36..44].copy_from_slice(&xxh3_64(&all).to_le_bytes());
        out
    }
}

/// Changes a place of bytes.
fn change(bytes: &mut Vec<u8>, rng: &mut Pcg64Mcg) {
    const FLOATS: [f64; 12] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        1e300,
        -1e300,
        1e-300,
        1e18,
        -1e18,
        1e6,
        -1e6,
        0.0,
        -1.0,
    ];
    const NUMBERS: [u64; 9] = [
        0,
        1,
        0x7f,
        1 << 16,
        u32::MAX as u64,
        1 << 40,
        (1 << 53) - 1,
        i64::MAX as u64,
        u64::MAX,
    ];
    let at = rng.random_range(0..bytes.len());
    match rng.random_range(0..6) {
        0 => bytes[at] = [0, 1, 2, 7, 0x7f, 0x80, 0xff, rng.random()][rng.random_range(0..8)],
        1 => drop(bytes.drain(at..(at + rng.random_range(1..9)).min(bytes.len()))),
        2 => {
            let number = NUMBERS[rng.random_range(0..NUMBERS.len())];
            let written = postcard::to_stdvec(&number).unwrap();
            bytes.splice(at..=at, written);
        }
        _ => {
            let value = match rng.random_range(0..3) {
                0 => rng.random_range(-100.0..100.0),
                _ => FLOATS[rng.random_range(0..FLOATS.len())],
            };
            for (b, v) in bytes[at..].iter_mut().zip(f64::to_le_bytes(value)) {
                *b = v;
            }
        }
    }
}

/// States in the middle of every process that takes several ticks.
fn states() -> Vec<Taken> {
    let mut out = Vec::new();
    for (mut scene, at) in [
        // A planned exit, a waiting clip, and a transition to another clip.
        (transitions(), &[61, 72, 90, 202, 240][..]),
        (streamed(), &[3, 40, 170]),
        (things(), &[31, 70]),
    ] {
        for tick in 0..=*at.iter().max().unwrap() {
            if at.contains(&tick) {
                out.push(Taken::of(&bytes(&scene.world)));
            }
            (scene.commands)(&mut scene.world, tick);
            scene.world.step();
        }
    }
    out
}

/// Ends the process when a case does not end, and names the case.
fn watch(case: &Arc<AtomicU64>) -> mpsc::SyncSender<()> {
    let (done, ended) = mpsc::sync_channel(1);
    let case = Arc::clone(case);
    std::thread::spawn(move || {
        let mut last = u64::MAX;
        while let Err(mpsc::RecvTimeoutError::Timeout) = ended.recv_timeout(LONGEST) {
            let now = case.load(Ordering::Relaxed);
            if now == last {
                eprintln!("case {now} does not end: SINEW_FORGED_FROM={now} SINEW_FORGED=1");
                std::process::abort();
            }
            last = now;
        }
    });
    done
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |n| n.parse().unwrap())
}

#[test]
fn forged_checkpoints_are_refused_or_can_be_stepped() {
    let states = states();
    for good in &states {
        let mut unchanged = good.header.clone();
        unchanged.extend(postcard::to_stdvec(&good.content).unwrap());
        restored(&unchanged);
    }
    let (from, cases) = (
        setting("SINEW_FORGED_FROM", 0),
        setting("SINEW_FORGED", 300),
    );
    let running = Arc::new(AtomicU64::new(from));
    let _watch = watch(&running);
    let (mut refused, mut stepped, mut panicked) = (0, 0, Vec::new());
    for case in from..from + cases {
        running.store(case, Ordering::Relaxed);
        let mut rng = Pcg64Mcg::seed_from_u64(case);
        let forged = states[case as usize % states.len()].forged(&mut rng);
        let make = || Checkpoint::from_bytes(&forged).and_then(|c| c.restore(|_| None));
        let run = |world: &mut World| (0..TICKS).for_each(|_| world.step());
        match catch_unwind(AssertUnwindSafe(make)) {
            Ok(Err(_)) => refused += 1,
            Ok(Ok(mut world)) => match catch_unwind(AssertUnwindSafe(|| run(&mut world))) {
                Ok(()) => stepped += 1,
                Err(_) => panicked.push(case),
            },
            Err(_) => panicked.push(case),
        }
    }
    println!(
        "{refused} refused, {stepped} stepped, {} panicked",
        panicked.len()
    );
    assert!(panicked.is_empty(), "cases {panicked:?} panic");
    assert!(cases < 100 || refused > 0 && stepped > 0);
}
