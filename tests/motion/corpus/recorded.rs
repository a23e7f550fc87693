//! Access to the corpus: solved motions, committed files, truth.

use crate::corpus::corpus;
use crate::corpus::dialect::Dialect;
use crate::corpus::plan::Motion;
use sinew_physics::body::Body;
use sinew_physics::motion::Bvh;
use sinew_physics::plan::PreparedRecording;
use sinew_physics::plan::prepare_recording;
pub use sinew_physics::reference::{Preparation, RetargetOptions};
use std::path::PathBuf;
use std::sync::OnceLock;

/// All motions, solved once.
pub fn motions() -> &'static [Motion] {
    static ALL: OnceLock<Vec<Motion>> = OnceLock::new();
    ALL.get_or_init(corpus::motions)
}

/// The motion of a name.
pub fn motion(name: &str) -> &'static Motion {
    motions()
        .iter()
        .find(|m| m.script.name == name)
        .unwrap_or_else(|| panic!("no motion {name}"))
}

/// Folder of the corpus.
pub fn folder() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("tests/corpus")
}

/// Bytes of a committed file.
pub fn read(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The committed recording of a motion in a dialect.
pub fn bvh(motion: &str, dialect: &str) -> Bvh {
    let name = format!("{motion}.{dialect}.bvh");
    Bvh::parse(&read(&name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// All recordings: motion and dialect.
pub fn recordings() -> Vec<(&'static str, Dialect)> {
    motions()
        .iter()
        .flat_map(|m| {
            let name = m.script.name.as_str();
            corpus::dialects_of(name)
                .into_iter()
                .map(move |d| (name, d))
        })
        .collect()
}

/// A recording fitted to the man's body with default options.
pub struct Fit {
    pub motion: &'static Motion,
    pub dialect: Dialect,
    pub fitted: PreparedRecording,
}

impl Fit {
    /// Name of the file without its extension.
    pub fn what(&self) -> String {
        format!("{}.{}", self.motion.script.name, self.dialect.name)
    }

    /// Its truth.
    pub fn truth(&self) -> Truth {
        Truth::of(&self.motion.script.name)
    }

    /// Whether the file has noise and sliding feet.
    pub fn noisy(&self) -> bool {
        self.dialect.faults.noise.0 > 0.0
    }

    /// Time of sample `i`, s.
    pub fn time(&self, i: usize) -> f64 {
        i as f64 / self.fitted.clip.rate_hz()
    }
}

/// All recordings, fitted once.
pub fn all_fits() -> &'static [Fit] {
    static ALL: OnceLock<Vec<Fit>> = OnceLock::new();
    ALL.get_or_init(|| {
        recordings()
            .into_iter()
            .map(|(name, dialect)| Fit {
                motion: motion(name),
                dialect,
                fitted: fitted(name, dialect.name, &man(), &RetargetOptions::default()),
            })
            .collect()
    })
}

/// The fits of the recordings without held frames and with a place of the root. The others are in
/// `after_reading_fixes.rs`: a held pose visible in fewer than four bones is still taken for motion.
pub fn fits() -> impl Iterator<Item = &'static Fit> {
    all_fits()
        .iter()
        .filter(|f| f.dialect.held == 0 && f.dialect.name != "rot-only")
}

/// The body of the tests.
pub fn man() -> Body {
    Body::adult_man()
}

/// A recording fitted to a body.
pub fn fitted(
    motion: &str,
    dialect: &str,
    body: &Body,
    options: &RetargetOptions,
) -> PreparedRecording {
    prepare_recording(&bvh(motion, dialect).recording().unwrap(), body, options)
        .unwrap_or_else(|e| panic!("{motion}.{dialect}: {e}"))
}

/// Truth of a motion, from its committed file.
pub struct Truth(pub serde_json::Value);

/// A foothold of the truth.
#[derive(Clone, Copy, Debug)]
pub struct Foothold {
    /// 0 left, 1 right.
    pub side: usize,
    pub from: f64,
    pub until: f64,
    pub x: f64,
    pub y: f64,
}

impl Truth {
    pub fn of(motion: &str) -> Self {
        Self(serde_json::from_slice(&read(&format!("{motion}.truth.json"))).unwrap())
    }

    pub fn number(&self, key: &str) -> f64 {
        self.0[key].as_f64().unwrap()
    }

    /// Curve of a key, linear between samples: row at `t` s.
    pub fn row(&self, key: &str, t: f64) -> Vec<f64> {
        let rows = self.0[key].as_array().unwrap();
        let x = (t * self.number("rate_hz")).clamp(0.0, (rows.len() - 1) as f64);
        let i = (x.floor() as usize).min(rows.len() - 2);
        let u = x - i as f64;
        let row = |k: usize| -> Vec<f64> {
            rows[k]
                .as_array()
                .unwrap()
                .iter()
                .map(|v| v.as_f64().unwrap())
                .collect()
        };
        let (a, b) = (row(i), row(i + 1));
        a.iter().zip(&b).map(|(a, b)| a + (b - a) * u).collect()
    }

    pub fn footholds(&self) -> Vec<Foothold> {
        let of = |v: &serde_json::Value, k: &str| v[k].as_f64().unwrap();
        let holds = self.0["footholds"].as_array().unwrap();
        holds
            .iter()
            .map(|h| Foothold {
                side: usize::from(h["side"] == "right"),
                from: of(h, "from"),
                until: of(h, "until"),
                x: of(h, "x"),
                y: of(h, "y"),
            })
            .collect()
    }

    /// Whether each foot touches the floor at `t`.
    pub fn planted(&self, t: f64) -> [bool; 2] {
        let mut out = [false; 2];
        for h in self.footholds() {
            out[h.side] |= t >= h.from && t <= h.until;
        }
        out
    }

    pub fn flights(&self) -> Vec<(f64, f64)> {
        let all = self.0["flights"].as_array().unwrap();
        all.iter()
            .map(|f| (f["from"].as_f64().unwrap(), f["until"].as_f64().unwrap()))
            .collect()
    }
}
