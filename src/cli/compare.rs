//! The part of `sinew paper` that compares pairs of controller and stepper over motions, loads and pushes.

use super::page::Page;
use sinew_evaluate::experiments::ControlPair;
use sinew_evaluate::experiments::compare::{
    Burden, ComparedMotion, ComparedOutcome, IMPULSES, LOADS, compare,
};
use sinew_evaluate::experiments::fall::DIRECTIONS;
use sinew_physics::body::Body;
use sinew_physics::world::World;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The pairs that are compared, in the order of the columns.
fn pairs() -> [ControlPair; 4] {
    [
        ControlPair::paper_kinematic(),
        ControlPair::paper_torque(),
        ControlPair::modern(),
        ControlPair::motors(),
    ]
}

/// One cell of the big tables.
fn cell(o: &ComparedOutcome) -> String {
    match o.fell_s {
        Some(t) => format!("falls at {t:.1} s"),
        None => format!("{:.2}°, {:.0} mm", o.joints_deg(), o.com_mm()),
    }
}

/// Sums over the outcomes of one pair.
#[derive(Clone, Default)]
struct Sum {
    all: ComparedOutcome,
    stood: u32,
    of: u32,
    time: Duration,
    ticks: u32,
}

impl Sum {
    fn add(&mut self, o: &ComparedOutcome, time: (Duration, u32)) {
        self.all.add(o);
        self.of += 1;
        self.stood += u32::from(o.fell_s.is_none());
        self.time += time.0;
        self.ticks += time.1;
    }
    fn tick_s(&self) -> f64 {
        self.time.as_secs_f64() / f64::from(self.ticks.max(1))
    }
}

/// Runs one scene and adds it to the sum.
fn run(
    body: &Arc<Body>,
    pair: &ControlPair,
    motion: &ComparedMotion,
    burden: Burden,
    sum: &mut Sum,
) -> ComparedOutcome {
    let (mut time, mut ticks) = (Duration::ZERO, 0);
    let mut step = |world: &mut World| {
        let began = Instant::now();
        world.step();
        time += began.elapsed();
        ticks += 1;
    };
    let out = compare(body, pair, motion, burden, &mut step);
    sum.add(&out, (time, ticks));
    out
}

fn head<'a>(first: &[&'a str], pairs: &[ControlPair]) -> Vec<&'a str> {
    first
        .iter()
        .copied()
        .chain(pairs.iter().map(|p| p.name))
        .collect()
}

fn load_name(mass: f64, both: bool) -> String {
    match (mass, both) {
        (0.0, _) => "none".into(),
        (m, false) => format!("{m} kg, one hand"),
        (m, true) => format!("{m} kg, two hands"),
    }
}

/// One line per pair: how often it stayed up, its errors and its computing time.
fn summary(page: &mut Page, pairs: &[ControlPair], sums: &[Sum], reference: &str) {
    let cost = pairs
        .iter()
        .zip(sums)
        .find(|(p, _)| p.name == reference)
        .map_or(1.0, |(_, s)| s.tick_s());
    let rows: Vec<Vec<String>> = pairs
        .iter()
        .zip(sums)
        .map(|(p, s)| {
            vec![
                p.name.to_owned(),
                format!("{} of {}", s.stood, s.of),
                format!("{:.2}", s.all.joints_deg()),
                format!("{:.1}", s.all.com_mm()),
                s.all
                    .chatter()
                    .map_or_else(|| "–".into(), |c| format!("{c:.4}")),
                format!("{:.2}", s.tick_s() / cost),
            ]
        })
        .collect();
    page.table(
        &[
            "controller, stepper",
            "without a fall",
            "joint error, rms °",
            "centre of mass error, rms mm",
            "torque change per tick / range, joints at their torque limit",
            "relative computing time",
        ],
        &rows,
    );
}

/// Numbers of scenes in which the modern pair stands where another falls, and vice versa.
#[derive(Default)]
struct StandCounts {
    wins: [u32; 4],
    closest: [u32; 4],
    losses: Vec<String>,
    scenes: u32,
}

impl StandCounts {
    fn count(&mut self, scene: &str, pairs: &[ControlPair], outcomes: &[ComparedOutcome]) {
        let stands = |o: &ComparedOutcome| o.fell_s.is_none();
        let Some(modern) = pairs
            .iter()
            .position(|p| p.name == ControlPair::modern().name)
        else {
            return;
        };
        self.scenes += 1;
        let standing = outcomes.iter().enumerate().filter(|(_, o)| stands(o));
        let error = |o: &ComparedOutcome| o.joints_deg();
        if let Some((k, _)) = standing.min_by(|a, b| error(a.1).total_cmp(&error(b.1))) {
            self.closest[k] += 1;
        }
        for (k, o) in outcomes.iter().enumerate() {
            if stands(&outcomes[modern]) && !stands(o) {
                self.wins[k] += 1;
            }
            if !stands(&outcomes[modern]) && stands(o) {
                self.losses.push(format!("{scene} ({})", pairs[k].name));
            }
        }
    }
}

/// The whole comparison over `motions`; pushes act while the motions in `pushed` are played.
pub fn section(page: &mut Page, body: &Arc<Body>, motions: &[ComparedMotion], pushed: &[&str]) {
    let pairs = pairs();
    let mut against = StandCounts::default();
    page.say("### Motions and loads");
    page.say(
        "Each motion is played once, and one second more in its last posture. The load is in the right hand, or half \
         in each hand, from the first tick; the motion is not adapted to it. Cells: joint error (rms) and centre of \
         mass error (rms) over the run.",
    );
    let mut sums = vec![Sum::default(); pairs.len()];
    let mut rows = Vec::new();
    for motion in motions {
        for (mass, both) in LOADS {
            let burden = Burden::Load(mass, both);
            let outcomes: Vec<ComparedOutcome> = pairs
                .iter()
                .zip(&mut sums)
                .map(|(p, s)| run(body, p, motion, burden, s))
                .collect();
            let load = load_name(mass, both);
            against.count(&format!("{}, {load}", motion.name), &pairs, &outcomes);
            let mut row = vec![motion.name.clone(), load];
            row.extend(outcomes.iter().map(cell));
            rows.push(row);
        }
    }
    page.table(&head(&["motion", "load"], &pairs), &rows);
    summary(page, &pairs, &sums, ControlPair::modern().name);
    page.say(
        "Errors are counted up to a fall, so an early fall lowers the mean error. The torque changes include those of \
         falls.",
    );

    pushes(page, body, motions, pushed, &pairs, &mut against);
    conclusion(page, &pairs, &against);
}

fn pushes(
    page: &mut Page,
    body: &Arc<Body>,
    motions: &[ComparedMotion],
    pushed: &[&str],
    pairs: &[ControlPair; 4],
    against: &mut StandCounts,
) {
    if !motions.iter().any(|m| pushed.contains(&m.name.as_str())) {
        return;
    }
    page.say("### Motions and pushes");
    page.say(
        "A push of 0.1 s at the chest, one second into the motion. Protective steps are off, except in the last \
         column, which is the default configuration.",
    );
    let fixed = pairs.clone().map(|mut p| {
        p.params.protective_steps = false;
        p
    });
    let stepping = ControlPair {
        name: "modern, with steps",
        ..ControlPair::modern()
    };
    let mut sums = vec![Sum::default(); pairs.len() + 1];
    let mut rows = Vec::new();
    let of = motions.iter().filter(|m| pushed.contains(&m.name.as_str()));
    for motion in of {
        for (name, direction) in DIRECTIONS {
            for impulse in IMPULSES {
                let burden = Burden::Push(direction * impulse);
                let outcomes: Vec<ComparedOutcome> = fixed
                    .iter()
                    .chain([&stepping])
                    .zip(&mut sums)
                    .map(|(p, s)| run(body, p, motion, burden, s))
                    .collect();
                let what = format!("{impulse} N·s {name}");
                against.count(
                    &format!("{}, {what}", motion.name),
                    pairs,
                    &outcomes[..pairs.len()],
                );
                let mut row = vec![motion.name.clone(), what];
                row.extend(outcomes.iter().map(cell));
                rows.push(row);
            }
        }
    }
    let mut everyone: Vec<ControlPair> = fixed.to_vec();
    everyone.push(stepping);
    page.table(&head(&["motion", "push"], &everyone), &rows);
    summary(page, &everyone, &sums, ControlPair::modern().name);
}

fn conclusion(page: &mut Page, pairs: &[ControlPair], against: &StandCounts) {
    page.say("### Summary");
    let wins: Vec<String> = pairs
        .iter()
        .zip(&against.wins)
        .filter(|(p, _)| p.name != ControlPair::modern().name)
        .map(|(p, n)| format!("{n} against *{}*", p.name))
        .collect();
    let closest: Vec<String> = pairs
        .iter()
        .zip(&against.closest)
        .map(|(p, n)| format!("*{}* {n}", p.name))
        .collect();
    let losses = if against.losses.is_empty() {
        "There is no scene in which *modern, torque* falls and another stands.".to_owned()
    } else {
        format!(
            "*Modern, torque* falls where another stands in: {}.",
            against.losses.join("; ")
        )
    };
    page.say(&format!(
        "Number of scenes, of {}, in which *modern, torque* stands and the other falls: {}. {losses} Smallest joint \
         error among the pairs that stand, number of scenes: {}. *Motors alone* hold the posture without balance \
         control: this is enough where the motion is balanced and the disturbance small, but the centre of mass \
         drifts. *Modern* gives up posture for balance when pushed. Decision: [ADR \
         0004](../adr/0004-modern-mode-by-default.md).",
        against.scenes,
        wins.join(", "),
        closest.join(", ")
    ));
}
