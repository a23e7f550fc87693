//! Every clip in variations that change one condition at a time.

use super::study::{LoadedMotion, Study, hundredths};
use crate::page::Page;
use anyhow::{Context, Result};
use sinew_evaluate::experiments::walk::{Hands, WalkTrial, Walker, walk};
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::motion::Bvh;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::RetargetOptions;
use std::sync::Arc;

/// One variation.
struct Case {
    name: &'static str,
    walker: Walker,
    tempo: f64,
    mirrored: bool,
}

/// All variations, the unchanged one first.
fn cases(man: &Arc<Body>) -> Result<Vec<Case>> {
    let plain = |name, body: &Arc<Body>| Case {
        name,
        walker: Walker::new(body),
        tempo: 1.0,
        mirrored: false,
    };
    let mut out = vec![plain("as recorded", man)];
    out.push(Case {
        mirrored: true,
        ..plain("mirrored", man)
    });
    for (name, tempo) in [
        ("× 0.8", 0.8),
        ("× 0.9", 0.9),
        ("× 1.1", 1.1),
        ("× 1.2", 1.2),
    ] {
        out.push(Case {
            tempo,
            ..plain(name, man)
        });
    }
    let size = |height, mass| Profile {
        height,
        mass,
        ..Profile::ordinary(Sex::Male, 30.0)
    };
    for (name, profile) in [
        ("woman", Profile::ordinary(Sex::Female, 30.0)),
        ("1.55 m", size(1.55, 58.0)),
        ("1.95 m", size(1.95, 95.0)),
        ("man of 70", Profile::ordinary(Sex::Male, 70.0)),
    ] {
        out.push(plain(name, &Arc::new(Body::humanoid(profile)?)));
    }
    let with = |name, change: fn(&mut Walker)| {
        let mut case = plain(name, man);
        change(&mut case.walker);
        case
    };
    out.extend([
        with("strength 0.8", |w| w.strength = 0.8),
        with("15 kg, right hand", |w| w.load = Some((15.0, Hands::Right))),
        with("15 kg, both hands", |w| w.load = Some((15.0, Hands::Both))),
        with("friction 0.4", |w| w.friction = 0.4),
        with("120 ticks/s", |w| w.rate_hz = 120.0),
    ]);
    Ok(out)
}

/// Joint tracking error of a motion in one variation, or the time of its fall, and whether it stays up.
fn cell(motion: &LoadedMotion, bvh: &Bvh, case: &Case) -> Result<(String, bool)> {
    let options = RetargetOptions {
        tempo: case.tempo,
        ..motion.options.clone()
    };
    let of = if case.mirrored { &bvh.mirrored() } else { bvh };
    let at = || format!("{}, {}", motion.name, case.name);
    let recording = of.recording().with_context(at)?;
    let clip = prepare_recording(&recording, &case.walker.body, &options)
        .with_context(at)?
        .clip;
    let w = walk(&case.walker, &WalkTrial::once(&Arc::new(clip)));
    let text = w.fell_s.map_or_else(
        || hundredths(w.report.tracking_joint_rms_deg),
        |t| format!("**fell at {t:.1} s**"),
    );
    Ok((text, w.stood()))
}

/// The table of all recordings and all variations.
///
/// # Errors
/// Clips that cannot be read or fitted.
pub(super) fn survey(page: &mut Page, study: &Study) -> Result<()> {
    let cases = cases(&study.body)?;
    let mut rows = Vec::new();
    let mut stood = vec![0; cases.len()];
    for motion in &study.clips {
        if motion.spec.starts_with("builtin:") || !motion.options.preparation.walk_runs {
            continue;
        }
        let bytes =
            std::fs::read(&motion.spec).with_context(|| format!("cannot read {}", motion.spec))?;
        let bvh = Bvh::parse(&bytes)?;
        let mut row = vec![motion.name.clone()];
        for (case, count) in cases.iter().zip(&mut stood) {
            let (text, stands) = cell(motion, &bvh, case)?;
            row.push(text);
            *count += usize::from(stands);
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return Ok(());
    }
    page.say("## Variations of every clip");
    page.say(
        "From standing to standing, with one condition changed at a time. Cells: joint tracking error, ° rms, or time \
         of the fall. Clips at another speed are prepared for it, as `PlayClip` does; the man of 70 has the strength \
         of his age; loads are held from the start.",
    );
    let all = rows.len();
    let counts = stood.iter().map(|n| format!("{n} of {all}"));
    rows.push(
        std::iter::once("no fall".to_owned())
            .chain(counts)
            .collect(),
    );
    let head: Vec<&str> = std::iter::once("clip")
        .chain(cases.iter().map(|c| c.name))
        .collect();
    page.table(&head, &rows);
    Ok(())
}
