//! The dialects of each motion, and all files of the corpus.

use super::dialect::{DIALECTS, Dialect, dialect, write};
use super::motions;
use super::plan::Motion;
use super::truth;

/// Motions that are too fast for 30 Hz: their clean file has 60.
const FAST: [&str; 4] = ["jog", "jump", "hops", "kick"];

/// Dialects beside the clean one, by motion.
const OTHERS: [(&str, &[&str]); 22] = [
    ("stand", &["noisy"]),
    ("wave", &["mixamo"]),
    ("squat", &["lafan"]),
    ("lift", &["biped", "rot-only"]),
    (
        "walk-normal",
        &[
            "cmu",
            "cgspeed",
            "lafan",
            "mixamo",
            "daz",
            "threejs",
            "biped",
            "generic-zup",
            "six",
            "noisy",
            "noisy-120",
        ],
    ),
    ("walk-normal-tall", &["lafan"]),
    ("walk-normal-short", &["biped"]),
    ("walk-normal-child", &["daz"]),
    ("walk-slow", &["six"]),
    ("walk-fast", &["noisy"]),
    ("walk-crouched", &["threejs"]),
    ("walk-broad", &["generic-zup"]),
    ("walk-arc", &["daz"]),
    ("walk-stop-start", &["biped"]),
    ("turn", &["mixamo"]),
    ("side-steps", &["threejs"]),
    ("back-steps", &["six"]),
    ("jog", &["cgspeed"]),
    ("jump", &["generic-zup"]),
    ("hops", &["noisy"]),
    ("kick", &["cmu"]),
    ("lie-down", &["lafan"]),
];

/// The dialects of a motion, the clean one first.
pub fn dialects_of(motion: &str) -> Vec<Dialect> {
    let mut clean = DIALECTS[0];
    if FAST.contains(&motion) {
        clean.rate = 60.0;
    }
    let others = OTHERS
        .iter()
        .find(|(name, _)| *name == motion)
        .map_or(&[][..], |(_, d)| *d);
    std::iter::once(clean)
        .chain(others.iter().map(|d| dialect(d)))
        .collect()
}

/// Name of a motion's file in a dialect.
pub fn file_name(motion: &str, dialect: &Dialect) -> String {
    format!("{motion}.{}.bvh", dialect.name)
}

/// All motions, solved.
pub fn motions() -> Vec<Motion> {
    motions::all().into_iter().map(|s| s.solve()).collect()
}

/// Files of one motion: name and bytes; the truth comes last.
pub fn files_of(motion: &Motion) -> Vec<(String, Vec<u8>)> {
    let name = &motion.script.name;
    let mut out = Vec::new();
    let mut listed = Vec::new();
    for (k, d) in dialects_of(name).into_iter().enumerate() {
        // Every file has its own noise.
        let seed = name.bytes().fold(k as u64 + 1, |h, b| {
            h.wrapping_mul(131).wrapping_add(u64::from(b))
        });
        let bytes = write(motion, &d, seed);
        let file = file_name(name, &d);
        listed.push(truth::File {
            name: file.clone(),
            frames: (motion.duration() * d.rate + 1e-9).floor() as usize + 1 + d.held,
            dialect: d,
        });
        out.push((file, bytes));
    }
    out.push((format!("{name}.truth.json"), truth::write(motion, &listed)));
    out
}
