//! The lift of the paper without an artificially weakened arm: a search over people of the tables and over postures for
//! a person who tracks the light load, helps with legs and back under the middle one, and bends under the heavy one.

use super::lift::{DURATION, arm_use, scene_of};
use super::{ControlPair, ExperimentRecord, record};
use sinew_physics::body::angles::anatomical_angles;
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES, R_HAND};
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::figure::StrengthScale;
use sinew_physics::figure::motion::tasks::grip;
use sinew_physics::motion::Clip;
use sinew_physics::motion::builtin::{LIFT_GRASP, LiftEnd, lift_to};
use sinew_physics::strength::Strength;
use std::sync::Arc;

/// Loads of the text and of the figure of the paper, kg.
pub const LOADS: [f64; 4] = [1.0, 3.0, 4.0, 5.0];
/// Ages that are searched, years, each for both sexes.
pub const AGES: [f64; 11] = [
    7.0, 8.0, 9.0, 10.0, 12.0, 14.0, 18.0, 30.0, 50.0, 65.0, 80.0,
];
/// Percentiles of strength that are searched.
pub const PERCENTILES: [f64; 5] = [5.0, 25.0, 50.0, 75.0, 95.0];
/// Ends of the lift that are searched.
pub const ENDS: [LiftEnd; 4] = [
    LiftEnd {
        squat: 0.0,
        reach: 0.58,
    },
    LiftEnd {
        squat: 0.5,
        reach: 0.58,
    },
    LiftEnd {
        squat: 1.0,
        reach: 0.58,
    },
    LiftEnd {
        squat: 0.5,
        reach: 0.45,
    },
];
/// Least share of the arm's strength that holding 3 kg takes of a candidate worth a run, and the largest share for 1
/// kg.
const NEED: [f64; 2] = [0.9, 1.8];
const LIGHT: f64 = 0.95;
/// A load is tracked below this joint error, rms, degrees.
pub const TRACKED: f64 = 1.0;
/// A joint helps if it deviates by this much, degrees.
pub const HELPS: f64 = 5.0;
/// A back bends if it deviates by this much, degrees.
pub const BENDS: f64 = 30.0;
/// A fall folds if hips, knees and back together are bent by this much, degrees; those of a falling plank are straight.
pub const FOLDS: f64 = 90.0;

/// The person who lifts, and the end of the lift.
#[derive(Clone, Debug, PartialEq)]
pub struct Lifter {
    /// Profile from the tables.
    pub profile: Profile,
    /// Percentile of strength.
    pub percentile: f64,
    /// End of the lift.
    pub end: LiftEnd,
}

/// The result of one load. Angles in degrees, largest until the fall.
#[derive(Clone, Debug)]
pub struct LoadResult {
    /// kg.
    pub mass: f64,
    /// Joint error, rms.
    pub rms: f64,
    /// Deviation of knees, hips and back (waist and thorax) in flexion.
    pub helps: [f64; 3],
    /// Forward bend of the back beyond the motion.
    pub bends: f64,
    /// Flexion of hips, knees (means of both sides) and back together, at the fall.
    pub folds: f64,
    /// Largest rate of change of the joint accelerations, rms over the joints, 1000 rad/s³.
    pub jerk: f64,
    /// Time at which it fell, s.
    pub fell_s: Option<f64>,
    /// The run.
    pub record: ExperimentRecord,
}

/// All loads of one candidate.
#[derive(Clone, Debug)]
pub struct LiftTrial {
    /// The candidate.
    pub candidate: Lifter,
    /// Share of the arm's strength that holding each of [`LOADS`] takes.
    pub need: [f64; 4],
    /// In the order of [`LOADS`]; for a search, only as long as they show the findings of the paper.
    pub results: Vec<LoadResult>,
}

impl LoadResult {
    /// Whether the motion was followed.
    fn is_tracked(&self) -> bool {
        self.fell_s.is_none() && self.rms < TRACKED
    }

    /// Whether it stands, and knees, hips and back have helped.
    fn is_helped(&self) -> bool {
        self.fell_s.is_none() && self.helps.iter().all(|h| *h >= HELPS)
    }
}

impl LiftTrial {
    /// The four findings of the paper: 1 kg is tracked, 3 kg makes knees, hips and back help, 4 or 5 kg bends the back
    /// before balance is lost, and a falling figure folds.
    pub fn shows(&self) -> [bool; 4] {
        let [one, three, heavy @ ..] = self.results.as_slice() else {
            return [false; 4];
        };
        let heaviest = heavy.iter().find(|r| r.fell_s.is_some());
        [
            one.is_tracked(),
            three.is_helped(),
            heaviest.is_some_and(|r| r.bends >= BENDS),
            heaviest.is_some_and(|r| r.folds >= FOLDS),
        ]
    }

    /// How many of them the trial shows: the number of findings, then how close the others are.
    fn score(&self) -> f64 {
        let shown = self.shows().iter().filter(|s| **s).count() as f64;
        let [_, three, heavy @ ..] = self.results.as_slice() else {
            return 0.0;
        };
        let least = three.helps.iter().copied().fold(HELPS, f64::min) / HELPS;
        let most = heavy.iter().map(|r| r.bends).fold(0.0, f64::max);
        let stands = f64::from(u8::from(three.fell_s.is_none()));
        shown + 0.2 * stands * least + 0.2 * (most / BENDS).min(1.0)
    }
}

fn dof(name: &str) -> usize {
    DOF_NAMES
        .iter()
        .position(|n| *n == name)
        .expect("the DOF exists")
}

/// One load.
pub fn attempt(
    body: &Arc<Body>,
    pair: &ControlPair,
    clip: &Arc<Clip>,
    (percentile, mass): (f64, f64),
    panels: usize,
) -> LoadResult {
    let strength = StrengthScale {
        percentile,
        ..StrengthScale::default()
    };
    let (mut world, key) = scene_of(body, pair, mass, strength, Arc::clone(clip));
    let at = grip(body, R_HAND);
    let mut last = [0.0; DOF_COUNT];
    let (mut jerk, mut folds, mut down, mut start) = (0.0f64, 0.0, false, None);
    let dt = world.dt();
    let run = record(&mut world, key, DURATION, panels, |w, t| {
        let f = w.figure(key);
        let r = f.and_then(|f| f.report());
        if let (Some(f), false) = (f, down) {
            let angles = anatomical_angles(&f.state().posture);
            let at = |name: &str| angles[dof(name)].to_degrees();
            let mean = |name: &str| 0.5 * (at(&format!("l_{name}")) + at(&format!("r_{name}")));
            let back = at("waist_flexion") + at("thorax_flexion");
            folds = mean("knee_flexion") + mean("hip_flexion") + back;
            let height = *start.get_or_insert(f.state().posture.root_position.z);
            down = r.is_some_and(|r| r.balance.com.z < super::FELL * height);
        }
        let now: [f64; DOF_COUNT] =
            std::array::from_fn(|d| r.map_or(0.0, |r| r.acceleration[6 + d]));
        let sum: f64 = now.iter().zip(&last).map(|(a, b)| (a - b) * (a - b)).sum();
        if t > LIFT_GRASP && t < DURATION - 1.0 {
            jerk = jerk.max((sum / DOF_COUNT as f64).sqrt() / dt);
        }
        last = now;
        let held = (R_HAND.index(), at, mass);
        (Vec::from_iter((t > LIFT_GRASP).then_some(held)), Vec::new())
    });
    let end = run.fell_s.unwrap_or(f64::INFINITY);
    let mut out = LoadResult {
        mass,
        rms: 0.0,
        helps: [0.0; 3],
        bends: 0.0,
        folds,
        jerk: jerk / 1e3,
        fell_s: run.fell_s,
        record: ExperimentRecord::default(),
    };
    let (mut squares, mut count) = (0.0, 0.0);
    for s in run.samples.iter().filter(|s| s.time_s < end) {
        // Beyond the motion: actual less desired.
        let more = |name: &str| -s.joint_error[dof(name)].to_degrees();
        let both = |name: &str| [more(&format!("l_{name}")), more(&format!("r_{name}"))];
        let most = |[a, b]: [f64; 2]| a.abs().max(b.abs());
        let back = more("waist_flexion") + more("thorax_flexion");
        let now = [
            most(both("knee_flexion")),
            most(both("hip_flexion")),
            back.abs(),
        ];
        for (h, n) in out.helps.iter_mut().zip(now) {
            *h = h.max(n);
        }
        out.bends = out.bends.max(back);
        squares += s.error * s.error;
        count += 1.0;
    }
    out.rms = (squares / f64::max(count, 1.0)).sqrt().to_degrees();
    out.record = run;
    out
}

/// Runs all loads of a candidate; `None` for a candidate who is not worth a run.
pub fn trial(candidate: &Lifter, pair: &ControlPair, panels: usize) -> Option<LiftTrial> {
    run(candidate, pair, panels, |_, _| true)
}

/// The same, as long as `goes_on` returns `true` after a load, given by its index.
fn run(
    candidate: &Lifter,
    pair: &ControlPair,
    panels: usize,
    goes_on: impl Fn(usize, &LoadResult) -> bool,
) -> Option<LiftTrial> {
    let body = Arc::new(Body::humanoid(candidate.profile).ok()?);
    let clip = Arc::new(lift_to(&body, candidate.end));
    let strength = Strength::at_percentile(&body, candidate.percentile);
    let need = LOADS.map(|mass| arm_use(&body, &strength, &clip, mass));
    let worth = (NEED[0]..=NEED[1]).contains(&need[1]) && need[0] < LIGHT;
    if !worth {
        return None;
    }
    let mut results = Vec::new();
    for (k, mass) in LOADS.into_iter().enumerate() {
        let result = attempt(&body, pair, &clip, (candidate.percentile, mass), panels);
        let more = goes_on(k, &result);
        results.push(result);
        if !more {
            break;
        }
    }
    Some(LiftTrial {
        candidate: candidate.clone(),
        need,
        results,
    })
}

/// Everyone in the search.
pub fn candidates() -> impl Iterator<Item = Lifter> {
    let people = [Sex::Female, Sex::Male].into_iter().flat_map(|sex| {
        AGES.into_iter()
            .flat_map(move |age| PERCENTILES.map(|p| (Profile::ordinary(sex, age), p)))
    });
    people.flat_map(|(profile, percentile)| {
        ENDS.map(|end| Lifter {
            profile,
            percentile,
            end,
        })
    })
}

/// The candidates who are worth a run, the best first. A candidate who does not track the light load, or does not stand
/// and help with the middle one, does not get the next. Runs on as many threads as there are cores; the result does not
/// depend on their number.
pub fn search(pair: &ControlPair) -> Vec<LiftTrial> {
    let all: Vec<Lifter> = candidates().collect();
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let goes_on = |k: usize, r: &LoadResult| match k {
        0 => r.is_tracked(),
        1 => r.is_helped(),
        _ => true,
    };
    let one = |c: &Lifter| run(c, pair, 0, goes_on);
    let mut found: Vec<LiftTrial> = std::thread::scope(|scope| {
        let parts: Vec<_> = (all.chunks(all.len().div_ceil(threads)))
            .map(|part| scope.spawn(move || part.iter().filter_map(one).collect::<Vec<_>>()))
            .collect();
        let ends = parts
            .into_iter()
            .map(|p| p.join().expect("runs do not panic"));
        ends.flatten().collect()
    });
    found.sort_by(|a, b| b.score().total_cmp(&a.score()));
    found
}
