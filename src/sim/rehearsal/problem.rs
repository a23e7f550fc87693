//! What is rehearsed: a body with its strength and loads, a stage, and a recording.

use super::look::{Look, Looker};
use crate::sim::body::{Body, Links, State};
use crate::sim::figure::rehearsed::{MAX_TICKS, Stage};
use crate::sim::motion::{Clip, Target, TargetPair};
use crate::sim::setup::StrengthScale;
use crate::sim::strength::{MuscleScale, Strength};
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
    /// Factors on it.
    pub muscles: MuscleScale,
    /// Friction of the floor.
    pub friction: f64,
    /// The world.
    pub stage: Stage,
    /// Largest force of the help over the weight; 0: none.
    pub most_help: f64,
    /// Which random numbers.
    pub seed: u64,
}

/// Why there is nothing to rehearse.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    /// Less than a tick, or more than a rehearsed motion can have.
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
    pub fn new(body: Arc<Body>, strength: &StrengthScale, friction: f64, stage: Stage) -> Self {
        Self {
            links: Links::new(&body),
            strength: Arc::new(Strength::at_percentile(&body, strength.percentile)),
            muscles: strength.muscles(1.0),
            body,
            friction,
            stage,
            most_help: 0.0,
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
    /// What there is to see at the start of each tick, and at the end of the last.
    pub looks: Vec<Look>,
    /// How far it was raised, m.
    pub raised: f64,
}

/// A floor is where the lowest point of the body is in the lowest fifth of the time: what touches now and then
/// touches there, and what is lower for a moment is an error of the recording.
const FLOOR_SHARE: usize = 5;

impl Reference {
    /// Of a clip from its first to its last sample, without the ways in and out, raised so that what is lowest is on
    /// the floor.
    ///
    /// # Errors
    /// It is too short or too long.
    pub fn new(problem: &Problem, clip: &Clip) -> Result<Self, ProblemError> {
        let Problem {
            body, links, stage, ..
        } = problem;
        let ticks = (clip.duration() / stage.dt + 1e-6).floor();
        if !(1.0..=MAX_TICKS as f64).contains(&ticks) {
            return Err(ProblemError::Length {
                seconds: clip.duration(),
                least: stage.dt,
                most: MAX_TICKS as f64 * stage.dt,
            });
        }
        let mut targets: Vec<Target> = (0..=ticks as usize)
            .map(|i| clip.sample((i as f64 * stage.dt).min(clip.duration() - 1e-9)))
            .collect();
        let mut looker = Looker::default();
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
        })
    }

    /// Ticks.
    pub fn ticks(&self) -> usize {
        self.pairs.len()
    }

    /// The state that it begins in.
    pub fn start(&self) -> State {
        self.targets[0].state()
    }
}
