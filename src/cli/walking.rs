//! `sinew walking`: simulates walks with pushes, loads, other bodies and noisy recordings, and writes a page with the
//! results.

mod study;
mod survey;

use super::page::{Page, progress};
use super::source::load;
use anyhow::{Context, Result};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sinew_evaluate::experiments::walk::{Hands, WalkTrial, Walked, Walker, walk};
use sinew_evaluate::noise::noisy;
use sinew_evaluate::survival::SurvivalMap;
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::math::Vec3;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::motion::{Bvh, Clip, read};
use sinew_physics::plan::cycle;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::{Preparation, RetargetOptions};
use std::path::PathBuf;
use std::sync::Arc;
use study::{LoadedMotion, Study, hundredths};

/// Impulses, N·s.
const IMPULSES: [f64; 4] = [10.0, 20.0, 30.0, 40.0];
/// Directions in which a push goes, in eighths of a turn to the left.
const DIRECTIONS: [&str; 8] = [
    "forward",
    "forward left",
    "left",
    "back left",
    "back",
    "back right",
    "right",
    "forward right",
];
/// Pushes are spread over this many phases of the cycle, or moments of standing.
const PHASES: u32 = 8;
/// Simulated time after a push, s.
const AFTER: f64 = 4.0;
/// Simulated time of a repeated walk, s: plain, and in each variation.
const LONG: f64 = 60.0;
const SHORT: f64 = 20.0;
/// Noisy copies of each recording: how many, by how much (m, degrees).
const COPIES: u32 = 20;
const NOISE: (f64, f64) = (0.001, 0.2);

/// Simulates walks with pushes, loads, other bodies and noise, and writes a page with the results.
#[derive(Clone, Debug, clap::Args)]
pub struct WalkingArgs {
    /// BVH files or `builtin:NAME`; the first one that can be repeated is the walk that is pushed and varied
    #[arg(value_name = "CLIP", default_value = "builtin:walk")]
    pub clips: Vec<String>,
    /// Folder for the page (README.md) and its plots; files of the same names are replaced
    #[arg(long, value_name = "FOLDER", default_value = "docs/walking")]
    pub out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Clips that cannot be read or fitted, files that cannot be written.
pub fn run(args: &WalkingArgs) -> Result<()> {
    let body = Arc::new(Body::adult_man());
    let mut clips = Vec::new();
    for spec in &args.clips {
        clips.extend(motions(spec, &body)?);
    }
    let walk = clips.iter().find_map(|m| {
        let cycle = cycle(&body, &m.clip)?;
        let far = cycle.advance().x.hypot(cycle.advance().y);
        (far > 0.5).then(|| (m.name.clone(), Arc::new(cycle)))
    });
    let study = Study { body, clips, walk };
    let mut page = Page::new(&args.out)?;
    introduction(&mut page, &study);
    let bar = progress("walking", 6);
    bar.set_message("clips");
    clips_once(&mut page, &study);
    bar.inc(1);
    bar.set_message("pushes, standing");
    pushes_standing(&mut page, &study)?;
    bar.inc(1);
    if let Some((name, clip)) = &study.walk {
        bar.set_message("pushes, walking");
        pushes_walking(&mut page, &study, name, clip)?;
        bar.inc(1);
        bar.set_message("variations");
        variations(&mut page, &study, name, clip)?;
        bar.inc(1);
    }
    bar.set_message("variations of all clips");
    survey::survey(&mut page, &study)?;
    bar.inc(1);
    bar.set_message("noise");
    sensitivity(&mut page, &study)?;
    bar.finish_and_clear();
    page.finish()
}

/// The motion of a recording; a run is returned both turned into a walk and as recorded.
fn motions(spec: &str, body: &Body) -> Result<Vec<LoadedMotion>> {
    let read = |kind: &str, walk_runs| -> Result<(LoadedMotion, bool)> {
        let options = RetargetOptions {
            preparation: Preparation::walking(walk_runs),
            ..RetargetOptions::default()
        };
        let source = load(spec, body, &options)?;
        let runs = source.retarget.is_some_and(|r| r.runs.speed.is_some());
        let motion = LoadedMotion {
            name: format!("{}{kind}", source.name),
            spec: spec.to_owned(),
            options,
            clip: Arc::new(source.clip),
        };
        Ok((motion, runs))
    };
    let (motion, runs) = read("", true)?;
    let mut out = vec![motion];
    if runs {
        out.push(read(", kept as a run", false)?.0);
    }
    Ok(out)
}

fn introduction(page: &mut Page, study: &Study) {
    page.say("# Walking: measurements");
    let plain = study
        .clips
        .iter()
        .filter(|m| m.options.preparation.walk_runs);
    let names: Vec<&str> = plain.map(|m| m.name.as_str()).collect();
    page.say(&format!(
        "Recorded motion in torque simulation with the body `adult-man` (30 years, 1.75 m, 75 kg) at measured \
         strength, without assist, at 60 ticks per second with two substeps each, unless stated otherwise. `sinew \
         walking {}` wrote this page; nothing on it is edited by hand.",
        names.join(" ")
    ));
}

fn row(name: &str, seconds: f64, w: &Walked) -> Vec<String> {
    let r = &w.report;
    let [rms, most] = w.capture;
    let result = w
        .fell_s
        .map_or("no fall".to_owned(), |t| format!("**fell at {t:.1} s**"));
    vec![
        name.to_owned(),
        format!("{seconds:.1}"),
        result,
        hundredths(r.tracking_joint_rms_deg),
        format!("{:.0}", r.tracking_mpjpe_root_mm),
        format!("{:.0}", r.tracking_mpjpe_global_mm),
        format!("{:.0} / {:.0}", 1e3 * rms, 1e3 * most),
        format!("{:.1}", 1e3 * w.slip),
        format!("{:.1} / {:.1}", w.peak[0], w.peak[1]),
        format!("{}", w.steps),
        format!("{:.0}", 1e3 * w.late),
    ]
}

const HEAD: [&str; 11] = [
    "clip",
    "duration, s",
    "result",
    "joint tracking error, ° rms",
    "tracking error relative to the pelvis, mm",
    "tracking error, mm",
    "capture point error rms / max, mm",
    "foot skate per stance, mm",
    "peak ground force, both feet / one foot, body weights",
    "steps",
    "largest touch-down error, ms",
];

fn clips_once(page: &mut Page, study: &Study) {
    page.say("## Clips");
    page.say(
        "Each clip starts and ends standing, with planned steps into and out of it. Errors are counted up to a fall. \
         *Tracking errors* are distances from the target, which is moved along with the feet after each step; errors \
         against the fixed recording are those of `sinew survey`. *Foot skate* is the distance that the contact points \
         of a foot travel over the floor in one stance, weighted by their load; *touch-down error* is the deviation \
         from the planned time. Runs are turned into walks, slower and with shorter steps, unless they are kept \
         (`--keep-runs`).",
    );
    let walker = Walker::new(&study.body);
    let mut rows: Vec<Vec<String>> = study
        .clips
        .iter()
        .map(|m| {
            let what = WalkTrial::once(&m.clip);
            row(&m.name, what.seconds, &walk(&walker, &what))
        })
        .collect();
    if let Some((name, clip)) = &study.walk {
        let what = WalkTrial::over_and_over(clip, LONG);
        rows.push(row(
            &format!("{name}, repeated"),
            LONG,
            &walk(&walker, &what),
        ));
    }
    page.table(&HEAD, &rows);
}

/// A push of `impulse` in direction `k`, eighths of a turn from `heading` (rad).
fn toward(heading: f64, k: usize, impulse: f64) -> Vec3 {
    let (s, c) = (heading + k as f64 * std::f64::consts::FRAC_PI_4).sin_cos();
    Vec3 {
        x: c * impulse,
        y: s * impulse,
        z: 0.0,
    }
}

/// Pushes of all impulses and directions at `moments`; the motion itself continues unchanged.
fn map(
    walker: &Walker,
    clip: &Arc<Clip>,
    heading: f64,
    moments: &[f64],
    title: String,
) -> SurvivalMap {
    let survivors = |direction: usize, impulse: f64| {
        let survived = moments.iter().filter(|t| {
            let mut what = WalkTrial::over_and_over(clip, **t + AFTER);
            what.push = Some((**t, toward(heading, direction, impulse)));
            walk(walker, &what).stood()
        });
        [survived.count() as u32, moments.len() as u32]
    };
    SurvivalMap {
        title,
        axes: ["direction".into(), "impulse, N·s".into()],
        rows: DIRECTIONS.map(str::to_owned).to_vec(),
        columns: IMPULSES.map(|i| format!("{i}")).to_vec(),
        cells: (0..DIRECTIONS.len())
            .map(|k| IMPULSES.iter().map(|i| survivors(k, *i)).collect())
            .collect(),
    }
}

fn show(page: &mut Page, name: &str, map: &SurvivalMap) -> Result<()> {
    let (head, rows) = map.table();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    page.table(&head, &rows);
    let [survived, tried] = map.total();
    page.svg(
        name,
        &format!("{}: no fall in {survived} of {tried}", map.title),
        map.svg(),
    )
}

fn pushes_standing(page: &mut Page, study: &Study) -> Result<()> {
    page.say("## Pushes while standing");
    page.say(&format!(
        "Pushes at the chest for 0.1 s, at {PHASES} times during quiet standing, 0.25 s apart. Cells count pushes \
         after which the figure is still standing {AFTER} s later. Protective steps are allowed. Without steps, a \
         linear inverted pendulum can absorb 35, 22 and 37 N·s forward, backward and sideways."
    ));
    let idle = builtin(&study.body, "idle").context("there is a built-in idle")?;
    let moments: Vec<f64> = (0..PHASES).map(|k| 0.5 + 0.25 * f64::from(k)).collect();
    let title = "Pushes while standing".to_owned();
    let map = map(
        &Walker::new(&study.body),
        &Arc::new(idle),
        0.0,
        &moments,
        title,
    );
    show(page, "standing", &map)
}

fn pushes_walking(page: &mut Page, study: &Study, name: &str, clip: &Arc<Clip>) -> Result<()> {
    page.say("## Pushes while walking");
    page.say(&format!(
        "The same pushes while `{name}` is repeated, at {PHASES} phases of its third cycle; directions are relative to \
         the direction of walking."
    ));
    let advance = clip.advance();
    let moments: Vec<f64> = (0..PHASES)
        .map(|k| clip.lead_in() + clip.duration() * (2.0 + f64::from(k) / f64::from(PHASES)))
        .collect();
    // The cycle may turn: the heading is that of its third repetition.
    let heading = advance.y.atan2(advance.x) + 2.0 * advance.yaw;
    let title = "Pushes while walking".to_owned();
    let map = map(&Walker::new(&study.body), clip, heading, &moments, title);
    show(page, "walking", &map)
}

/// The repeated walk of another body, at another pace: the recording fitted to it.
fn fitted(study: &Study, name: &str, body: &Body, tempo: f64) -> Result<Option<Arc<Clip>>> {
    let of = study.clips.iter().find(|m| m.name == name);
    let of = of.context("the walk is one of the clips")?;
    let options = RetargetOptions {
        tempo,
        ..of.options.clone()
    };
    let clip = load(&of.spec, body, &options)?.clip;
    Ok(cycle(body, &clip).map(Arc::new))
}

fn variations(page: &mut Page, study: &Study, name: &str, clip: &Arc<Clip>) -> Result<()> {
    page.say("## Other bodies, loads, floors and rates");
    page.say(&format!(
        "`{name}`, repeated for {SHORT} s. Loads are held from the start."
    ));
    let man = Walker::new(&study.body);
    let mut rows = Vec::new();
    let mut add = |text: &str, walker: &Walker, clip: &Arc<Clip>| {
        let what = WalkTrial::over_and_over(clip, SHORT);
        rows.push(row(text, SHORT, &walk(walker, &what)));
    };
    let size = |height: f64, mass: f64| Profile {
        height,
        mass,
        ..Profile::ordinary(Sex::Male, 30.0)
    };
    let people = [
        ("woman of 30", Profile::ordinary(Sex::Female, 30.0), 1.0),
        (
            "man of 70 at 70 % strength",
            Profile::ordinary(Sex::Male, 70.0),
            0.7,
        ),
        ("man of 1.55 m, 58 kg", size(1.55, 58.0), 1.0),
        ("man of 1.95 m, 95 kg", size(1.95, 95.0), 1.0),
        ("child of 8", Profile::ordinary(Sex::Male, 8.0), 1.0),
    ];
    for (text, profile, strength) in people {
        let body = Arc::new(Body::humanoid(profile)?);
        if let Some(own) = fitted(study, name, &body, 1.0)? {
            let walker = Walker {
                strength,
                ..Walker::new(&body)
            };
            add(text, &walker, &own);
        }
    }
    for mass in [2.5, 5.0, 10.0, 15.0] {
        for (hands, text) in [
            (Hands::Right, "in the right hand"),
            (Hands::Both, "in both hands"),
        ] {
            let load = Some((mass, hands));
            add(
                &format!("{mass} kg {text}"),
                &Walker {
                    load,
                    ..man.clone()
                },
                clip,
            );
        }
    }
    for friction in [0.4, 0.5, 0.6, 0.8, 1.0] {
        add(
            &format!("coefficient of friction {friction}"),
            &Walker {
                friction,
                ..man.clone()
            },
            clip,
        );
    }
    for rate_hz in [60.0, 120.0] {
        add(
            &format!("{rate_hz} ticks/s"),
            &Walker {
                rate_hz,
                ..man.clone()
            },
            clip,
        );
    }
    for tempo in [0.8, 0.9, 1.1, 1.2] {
        if let Some(paced) = fitted(study, name, &study.body, tempo)? {
            add(&format!("at {tempo} times its speed"), &man, &paced);
        }
    }
    page.table(&HEAD, &rows);
    Ok(())
}

fn sensitivity(page: &mut Page, study: &Study) -> Result<()> {
    let (metres, degrees) = NOISE;
    page.say("## Noise");
    page.say(&format!(
        "{COPIES} copies of each recording in which every value is changed at random by up to {} mm or {degrees}°, \
         prepared and simulated like the recording itself. A clip that is tracked only by chance falls in some copies.",
        1e3 * metres
    ));
    let walker = Walker::new(&study.body);
    let mut rows = Vec::new();
    for m in &study.clips {
        let (spec, options) = (&m.spec, &m.options);
        if spec.starts_with("builtin:") {
            continue;
        }
        let bytes = std::fs::read(spec).with_context(|| format!("cannot read {spec}"))?;
        let bvh = Bvh::parse(&bytes)?;
        let unit = {
            let fitted = prepare_recording(&bvh.recording()?, &study.body, options)?;
            fitted.report.size.unit_m
        };
        let (mut stood, mut least, mut most) = (0, f64::INFINITY, 0.0f64);
        for seed in 0..COPIES {
            let mut rng = Pcg64Mcg::seed_from_u64(u64::from(seed));
            let random = || rng.random_range(-1.0..=1.0);
            let copy = noisy(&bytes, &bvh, metres / unit, degrees, random)
                .with_context(|| format!("{spec} has no motion"))?;
            let clip = prepare_recording(&read(copy.as_bytes())?, &study.body, options)?.clip;
            let walked = walk(&walker, &WalkTrial::once(&Arc::new(clip)));
            stood += u32::from(walked.stood());
            let rms = walked.report.tracking_joint_rms_deg;
            (least, most) = (least.min(rms), most.max(rms));
        }
        rows.push(vec![
            m.name.clone(),
            format!("{stood} of {COPIES}"),
            format!("{least:.2} – {most:.2}"),
        ]);
    }
    page.table(&["clip", "no fall", "joint tracking error, ° rms"], &rows);
    Ok(())
}
