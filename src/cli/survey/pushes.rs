//! `sinew survey --pushes`: after how many of a fixed set of pushes figures are still up, by clip, phase and impulse.

use super::corpus::{ClipSource, CorpusClip};
use super::{SurveyArgs, jobs, say};
use crate::output::write;
use anyhow::{Context, Result};
use sinew_evaluate::survey::pushes::{PushBench, PushRow, PushedWhile};
use sinew_evaluate::survey::tables::SurveyTable;
use sinew_physics::body::Body;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

/// Runs all pushes, prints their table and writes it as JSON.
///
/// # Errors
/// A clip that cannot be read, a file that cannot be written.
pub(super) fn run(args: &SurveyArgs, body: &Arc<Body>, clips: &[CorpusClip]) -> Result<()> {
    let mut tasks = Vec::new();
    for clip in clips {
        let at = || format!("cannot read {}", clip.name);
        let bytes = match &clip.source {
            ClipSource::File(path) => std::fs::read(path).with_context(at)?,
            ClipSource::Builtin(_) => Vec::new(),
        };
        let (prepared, conditions) =
            jobs::prepared(args, body, &clip.source, &bytes).with_context(at)?;
        for spec in &args.pushes {
            if let Some(bench) = PushBench::new(&conditions, &prepared, spec.phase) {
                let bench = Arc::new(bench);
                let of = |impulse: &f64| (clip.name.as_str(), Arc::clone(&bench), *impulse);
                tasks.extend(spec.impulses.iter().map(of));
            }
        }
    }
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<Option<Result<PushRow>>>> =
        Mutex::new(tasks.iter().map(|_| None).collect());
    std::thread::scope(|scope| {
        for _ in 0..args.threads().min(tasks.len()) {
            scope.spawn(|| {
                while let Some((k, (name, bench, impulse))) = {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    tasks.get(k).map(|task| (k, task))
                } {
                    let row = bench.run(name, *impulse).map_err(Into::into);
                    done.lock()
                        .expect("no thread panics while it holds the rows")[k] = Some(row);
                }
            });
        }
    });
    let done = done.into_inner().expect("all threads have ended");
    let rows = done.into_iter().flatten().collect::<Result<Vec<_>>>()?;
    say(&table(&rows).text());
    let text = serde_json::to_string_pretty(&rows).context("rows have finite numbers")?;
    write(&args.out, text + "\n")
}

/// One row for each clip, phase and impulse, and one for all clips.
fn table(rows: &[PushRow]) -> SurveyTable {
    let phase = |p: PushedWhile| match p {
        PushedWhile::Start => "start",
        PushedWhile::Walk => "walk",
        PushedWhile::Stand => "stand",
    };
    let row = |r: &PushRow| {
        vec![
            r.clip.clone(),
            phase(r.phase).to_owned(),
            r.impulse_ns.to_string(),
            format!("{} of {}", r.stood, r.cells),
            r.waiting.to_string(),
            format!("{:.0}", r.tilt_deg),
            r.map.clone(),
        ]
    };
    let mut sums: Vec<PushRow> = Vec::new();
    for r in rows {
        let same = |s: &&mut PushRow| s.phase == r.phase && s.impulse_ns == r.impulse_ns;
        match sums.iter_mut().find(same) {
            Some(sum) => {
                sum.cells += r.cells;
                sum.stood += r.stood;
                sum.waiting += r.waiting;
            }
            None => sums.push(PushRow {
                clip: "all".to_owned(),
                map: String::new(),
                tilt_deg: 0.0,
                ..r.clone()
            }),
        }
    }
    let sum = |r: &PushRow| {
        let mut cells = row(r);
        cells[5].clear();
        cells
    };
    SurveyTable {
        head: vec![
            "clip",
            "while",
            "N·s",
            "up",
            "waiting",
            "tilt, °",
            "by moment",
        ],
        rows: rows.iter().map(row).chain(sums.iter().map(sum)).collect(),
    }
}
