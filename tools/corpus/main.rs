//! Writes the corpus of synthesised motion capture recordings with their truth: see tests/corpus/README.md.
//!
//! ```sh
//! cargo run -p tools --bin corpus -- tests/corpus
//! ```
//! With `--check` it writes nothing and prints, per motion, the length that legs lack to reach their feet, and the
//! depth of feet in the floor: both are 0 unless a motion is authored wrongly.

mod actor;
mod corpus;
mod dialect;
mod gait;
mod motions;
mod plan;
mod tracks;
mod truth;

use plan::Motion;
use std::path::Path;

fn check(m: &Motion) {
    let script = &m.script;
    let n = (m.duration() * 60.0) as usize;
    let mut short = [(0.0f64, 0.0); 2];
    let mut low = (0.0f64, 0.0);
    let mut knee = [[0.0f64; 2], [999.0; 2]];
    for i in 0..=n {
        let t = i as f64 / 60.0;
        let q = m.recorded(t);
        for s in 0..2 {
            if q.short[s] > short[s].0 {
                short[s] = (q.short[s], t);
            }
            let depth = script.actor.lowest(&q, s);
            if depth < low.0 {
                low = (depth, t);
            }
            let k = q.angles[[26, 34][s]] / tracks::DEG;
            knee[0][s] = knee[0][s].max(k);
            knee[1][s] = knee[1][s].min(k);
        }
    }
    println!(
        "{:18} {:5.2} s: short {:.4} m at {:.2} s, {:.4} at {:.2}; \
         lowest {:.4} at {:.2}; knees {:.0}..{:.0}, {:.0}..{:.0}",
        script.name,
        m.duration(),
        short[0].0,
        short[0].1,
        short[1].0,
        short[1].1,
        low.0,
        low.1,
        knee[1][0],
        knee[0][0],
        knee[1][1],
        knee[0][1]
    );
}

fn main() -> std::io::Result<()> {
    let Some(to) = std::env::args().nth(1) else {
        eprintln!("usage: corpus FOLDER | corpus --check");
        std::process::exit(2);
    };
    let mut total = (0, 0);
    for motion in corpus::motions() {
        if to == "--check" {
            check(&motion);
            continue;
        }
        for (name, bytes) in corpus::files_of(&motion) {
            total = (total.0 + 1, total.1 + bytes.len());
            std::fs::write(Path::new(&to).join(name), bytes)?;
        }
    }
    if total.0 > 0 {
        println!("{} files, {} bytes", total.0, total.1);
    }
    Ok(())
}
