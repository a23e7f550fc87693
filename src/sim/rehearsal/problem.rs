//! The subject of a rehearsal: a body with its strength and loads, a world, and a recording.

use super::look::{Look, Looker, Off};
use super::settings::{Rest, Settings};
use crate::body::{Body, Links, Posture, State};
use crate::figure::motion::rehearsed::{MAX_TICKS, RehearsalWorld};
use crate::motion::{Clip, Target, TargetPair};
use crate::setup::StrengthScale;
use crate::strength::{MuscleScale, Strength};
use std::sync::Arc;

/// A motion to be rehearsed.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The body.
    pub body: Arc<Body>,
    /// Its mass properties, with the loads that it carries all the time.
    pub links: Links,
    /// Its strength.
    pub strength: Arc<Strength>,
    /// Factors on its strength.
    pub muscles: MuscleScale,
    /// Friction of the floor.
    pub friction: f64,
    /// The world.
    pub stage: RehearsalWorld,
    /// Largest force of the help over the weight; 0 for no help.
    pub most_help: f64,
    /// Postures in which the body stands before a recording that begins slowly, and after one that ends slowly. With
    /// `None`, its first and its last posture are used, which need not balance.
    pub stands: Option<[Posture; 2]>,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Why there is nothing to rehearse.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    /// Shorter than a tick, or longer than a rehearsed motion can be.
    #[error("a motion of {seconds} s, expected {least} to {most} s")]
    Length {
        /// Its length, s.
        seconds: f64,
        /// Least accepted.
        least: f64,
        /// Largest accepted.
        most: f64,
    },
}

impl Problem {
    /// An unloaded body without help.
    pub fn new(
        body: Arc<Body>,
        strength: &StrengthScale,
        friction: f64,
        stage: RehearsalWorld,
    ) -> Self {
        Self {
            links: Links::new(&body),
            strength: Arc::new(Strength::at_percentile(&body, strength.percentile)),
            muscles: strength.muscles(1.0),
            body,
            friction,
            stage,
            most_help: 0.0,
            stands: None,
            seed: 1,
        }
    }
}

/// The recording, tick by tick.
#[derive(Clone, Debug)]
pub struct Reference {
    /// At the start of each tick, and at the end of the last.
    pub targets: Vec<Target>,
    /// Over each tick, velocities set back for the steps of the simulator.
    pub pairs: Vec<TargetPair>,
    /// The looks at the start of each tick, and at the end of the last.
    pub looks: Vec<Look>,
    /// Height by which it was raised, m.
    pub raised: f64,
    /// First and last tick of the recording; before it and after it are the ways in and out.
    pub recorded: [usize; 2],
    /// Tick from which on the body should stand.
    stands_from: usize,
}

/// The floor is at the height below which the lowest point of the body is for a fifth (1/this) of the time: points that
/// touch now and then touch there, and a lower point for a moment is an error of the recording.
const FLOOR_SHARE: usize = 5;

impl Reference {
    /// From a clip with its ways in and out, raised so that its lowest points are on the floor. A motion that begins or
    /// ends slowly starts from rest or comes to rest, and stands there for a while.
    ///
    /// # Errors
    /// It is too short or too long.
    pub fn new(problem: &Problem, clip: &Clip, rest: &Rest) -> Result<Self, ProblemError> {
        let Problem {
            body, links, stage, ..
        } = problem;
        let dt = stage.dt;
        let whole = |seconds: f64| (seconds / dt + 1e-6).floor().clamp(0.0, 1e6) as usize;
        let (lead, ticks) = (whole(clip.lead_in() + 0.999 * dt), whole(clip.duration()));
        let out = whole(clip.lead_out() + 0.999 * dt);
        let count = lead + ticks + out + whole(rest.times.settling) + whole(rest.after);
        if ticks < 1 || count > MAX_TICKS {
            return Err(ProblemError::Length {
                seconds: clip.duration(),
                least: dt,
                most: MAX_TICKS as f64 * dt,
            });
        }
        // A motion that ends at full speed keeps its velocity up to its end.
        let last = clip.duration() + clip.lead_out() - 1e-9;
        let mut targets: Vec<Target> = (0..=lead + ticks + out)
            .map(|i| clip.sample(((i as f64 - lead as f64) * dt).min(last)))
            .collect();
        let mut looker = Looker::default();
        let mut slow =
            |t: &Target| looker.look(body, links, &t.state()).velocity.norm() < rest.speed;
        let ends = [&targets[0], &targets[targets.len() - 1]].map(&mut slow);
        let [first, last] = [targets[0].clone(), targets[targets.len() - 1].clone()];
        let stand = |end: &Target, k: usize| match &problem.stands {
            Some(stands) if near(&end.posture, &stands[k]) => stands[k],
            _ => end.posture,
        };
        let mut before = 0;
        let mut stands_from = usize::MAX;
        if ends[1] {
            stands_from = targets.len() - 1 + whole(rest.times.settling);
            let stand = stand(&last, 1);
            let at = |k: usize| last.to_rest(&stand, rest.times, k as f64 * dt, dt);
            targets.extend((1..=whole(rest.after)).map(at));
        }
        if ends[0] && lead == 0 {
            // The same backwards in time.
            before = whole(rest.times.settling);
            let stand = stand(&first, 0);
            let first = first.backwards();
            let at = |k: usize| first.to_rest(&stand, rest.times, k as f64 * dt, dt);
            targets.splice(0..0, (1..=before).rev().map(|k| at(k).backwards()));
        }
        let mut low: Vec<f64> = targets
            .iter()
            .map(|t| {
                let lowest = looker.look(body, links, &t.state()).lowest;
                lowest.into_iter().fold(f64::INFINITY, f64::min)
            })
            .collect();
        low.sort_by(f64::total_cmp);
        let raised = -low[low.len() / FLOOR_SHARE];
        for t in &mut targets {
            t.posture.root_position.z += raised;
        }
        let pairs = targets
            .windows(2)
            .map(|w| {
                let mut pair = TargetPair {
                    now: w[0].clone(),
                    next: w[1].clone(),
                };
                pair.set_velocities_back(0.5 / f64::from(stage.substeps));
                pair
            })
            .collect();
        let looks = targets
            .iter()
            .map(|t| looker.look(body, links, &t.state()))
            .collect();
        Ok(Self {
            targets,
            pairs,
            looks,
            raised,
            recorded: [before + lead, before + lead + ticks],
            stands_from: stands_from.saturating_add(before),
        })
    }

    /// Number of ticks.
    pub fn ticks(&self) -> usize {
        self.pairs.len()
    }

    /// Whether a body that is `off` by this much at the end of tick `k − 1` keeps the motion under these settings.
    pub fn is_kept(&self, off: &Off, k: usize, settings: &Settings) -> bool {
        // Written so that NaN does not count as kept.
        off.mean <= settings.kept && (k < self.stands_from || off.balance <= settings.rest.steady)
    }

    /// Its initial state.
    pub fn start(&self) -> State {
        self.targets[0].state()
    }
}

/// Largest displacement of the pelvis, m, and turn of a joint, rad, with which a body balances on its feet.
const SHIFT: f64 = 0.15;
const BEND: f64 = 0.6;

/// Whether a body at rest in `a` can stand in `b` without a step: the difference is only balance.
fn near(a: &Posture, b: &Posture) -> bool {
    let off = a.difference(b);
    let way = off[3..6].iter().map(|x| x * x).sum::<f64>().sqrt();
    way < SHIFT && off[..3].iter().chain(&off[6..]).all(|x| x.abs() < BEND)
}
