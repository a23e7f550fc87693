//! From the problem to the motion: the search, then less help for as long as the motion is kept, then the run that is
//! recorded.

use super::problem::{Problem, ProblemError, Reference};
use super::search::{Path, Progress, Search};
use super::settings::Settings;
use super::simulator::{Action, Simulator, WindowTicks};
use crate::body::State;
use crate::body::topology::{DOF_COUNT, SEGMENT_COUNT};
use crate::figure::motion::rehearsed::RehearsedMotion;
use crate::motion::{Clip, GRAVITY};
use crate::stepper::pelvis_wrench::{PelvisHold, RootStep};

/// Mean distance from the recording beyond which a motion is lost, m (Luo et al. 2023, *PHC*).
pub const LOST: f64 = 0.5;

/// The result of a rehearsal.
#[derive(Clone, Debug)]
pub struct Rehearsal {
    /// The motion, to be played. If it is lost, it is the part that was found.
    pub motion: RehearsedMotion,
    /// Length of the recording in it, s.
    pub recorded: f64,
    /// The states of its run: at the start of each tick, and at the end of the last.
    pub states: Vec<State>,
    /// Its distances from the recording.
    pub errors: Errors,
    /// The help that it took.
    pub help: HelpGiven,
    /// Largest used share of strength of each DOF, 95th percentile of the ticks.
    pub effort: [f64; DOF_COUNT],
    /// The work of the search.
    pub work: Work,
}

/// Distances from the recording, whose lowest points are on the floor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Time at which the mean distance of the segment origins first exceeded [`LOST`], s on the recording's clock:
    /// negative on the way in.
    pub lost_at: Option<f64>,
    /// Mean distance of the segment origins, m, over the recording or until it was lost.
    pub global: f64,
    /// The same with both pelvis origins in one place, m.
    pub from_root: f64,
    /// Largest mean distance of a tick, m.
    pub farthest: f64,
}

/// Help that a rehearsal took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HelpGiven {
    /// Impulse, N·s.
    pub impulse: f64,
    /// Impulse over weight × time.
    pub share: f64,
    /// Largest force, N, and moment, N·m.
    pub most: [f64; 2],
    /// Windows that were helped, and all windows.
    pub windows: [usize; 2],
}

/// The work of a search.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Ticks simulated.
    pub ticks: u64,
    /// Rounds.
    pub rounds: usize,
    /// Windows that were reached, and all windows.
    pub reached: [usize; 2],
    /// Whether the caller stopped it.
    pub stopped: bool,
}

/// A run from beginning to end.
#[derive(Clone, Debug)]
struct Run {
    windows: WindowTicks,
    states: Vec<State>,
    path: Vec<RootStep>,
    effort: Vec<[f64; DOF_COUNT]>,
    errors: Errors,
}

/// Rehearses `clip` on the given number of threads, which does not affect the result. `go_on` gets the progress about
/// ten times a second, and stops the search by returning `false`: then the result is the best path until then.
///
/// # Errors
/// A clip that is too short or too long.
pub fn rehearse(
    problem: &Problem,
    clip: &Clip,
    settings: &Settings,
    threads: usize,
    go_on: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Rehearsal, ProblemError> {
    let reference = Reference::new(problem, clip, &settings.rest)?;
    let mut search = Search::new(problem, &reference, settings, threads);
    let windows = WindowTicks::new(problem, settings);
    let count = reference.ticks().div_ceil(windows.length);
    let Path {
        mut actions,
        reached,
        rounds,
        mut stopped,
        ..
    } = search.run(go_on);
    actions.resize(count, Action::NONE);
    let mut sim = Simulator::new(problem, settings);
    let mut stage = Playing {
        problem,
        reference: &reference,
        windows,
        settings,
        sim: &mut sim,
    };
    if reached == count && !stopped {
        let mut go_on = |ticks| {
            go_on(&Progress {
                ticks: search.ticks() + ticks,
                ..search.progress()
            })
        };
        stopped = !stage.take_help_away(&mut actions, settings.help.passes, &mut go_on);
    }
    let run = stage.run(&actions);
    let ticks = search.ticks() + sim.ticks;
    let work = Work {
        ticks,
        rounds,
        reached: [reached, count],
        stopped,
    };
    Ok(Rehearsal::new(
        problem,
        &reference,
        settings,
        (&actions, run),
        work,
    ))
}

/// Runs actions on one simulator.
struct Playing<'a> {
    problem: &'a Problem,
    reference: &'a Reference,
    windows: WindowTicks,
    settings: &'a Settings,
    sim: &'a mut Simulator,
}

impl Playing<'_> {
    /// Runs everything from beginning to end.
    fn run(&mut self, actions: &[Action]) -> Run {
        let n = self.reference.ticks();
        let mut state = self.reference.start();
        let mut out = Run {
            windows: self.windows,
            states: vec![state],
            path: Vec::with_capacity(n * self.problem.stage.substeps as usize),
            effort: Vec::with_capacity(n),
            errors: Errors::default(),
        };
        let mut counted = 0usize;
        let e = &mut out.errors;
        for k in 0..n {
            let action = Action::at(actions, k, self.windows);
            let path = &mut out.path;
            self.sim
                .tick(&mut state, &self.reference.pairs[k], &action, |s| {
                    path.push(s)
                });
            out.states.push(state);
            out.effort.push(self.sim.utilisation());
            let (is, should) = (self.sim.look(&state), &self.reference.looks[k + 1]);
            let mean = is.distance(should);
            e.farthest = e.farthest.max(mean);
            let [first, last] = self.reference.recorded;
            if mean > LOST || mean.is_nan() {
                let at = (k + 1) as f64 - first as f64;
                e.lost_at.get_or_insert(at * self.problem.stage.dt);
            }
            if e.lost_at.is_none() && (first..=last).contains(&(k + 1)) {
                let shift = should.at[0] - is.at[0];
                let off = is.at.iter().zip(&should.at);
                let from_root = off.map(|(a, b)| (*b - *a - shift).norm()).sum::<f64>();
                e.global += mean;
                e.from_root += from_root / SEGMENT_COUNT as f64;
                counted += 1;
            }
        }
        e.global /= counted.max(1) as f64;
        e.from_root /= counted.max(1) as f64;
        out
    }

    /// The states at the start of each window from `first` on, if the motion is kept from there to its end.
    fn kept(&mut self, actions: &[Action], first: usize, from: &State) -> Option<Vec<State>> {
        let mut state = *from;
        let mut out = Vec::new();
        for k in first * self.windows.length..self.reference.ticks() {
            if k % self.windows.length == 0 {
                out.push(state);
            }
            let action = Action::at(actions, k, self.windows);
            self.sim
                .tick(&mut state, &self.reference.pairs[k], &action, |_| ());
            let off = self.sim.look(&state).off(&self.reference.looks[k + 1]);
            if !self.reference.is_kept(&off, k + 1, self.settings) {
                return None;
            }
        }
        Some(out)
    }

    /// Removes help from one window after the other, from the last to the first, first all of it and then parts, as
    /// long as the motion is kept. `go_on` is asked before each with the number of ticks simulated; returns `false` if
    /// it declined.
    fn take_help_away(
        &mut self,
        actions: &mut [Action],
        passes: usize,
        go_on: &mut dyn FnMut(u64) -> bool,
    ) -> bool {
        let start = self.reference.start();
        let Some(mut states) = self.kept(actions, 0, &start) else {
            return true;
        };
        for pass in 0..passes {
            let left = if pass == 0 { 0.0 } else { 0.6 };
            for w in (0..actions.len()).rev() {
                let before = actions[w].help;
                if before <= 0.0 {
                    continue;
                }
                if !go_on(self.sim.ticks) {
                    return false;
                }
                actions[w].help = left * before;
                let from = states[w];
                match self.kept(actions, w, &from) {
                    Some(later) => states.splice(w.., later).for_each(drop),
                    None => actions[w].help = before,
                }
            }
        }
        true
    }
}

impl Rehearsal {
    fn new(
        problem: &Problem,
        reference: &Reference,
        settings: &Settings,
        (actions, run): (&[Action], Run),
        work: Work,
    ) -> Self {
        let p = problem.body.profile;
        let weight = p.mass * GRAVITY;
        let h = problem.stage.dt / f64::from(problem.stage.substeps);
        let mut help = HelpGiven {
            windows: [
                actions.iter().filter(|a| a.help > 0.0).count(),
                actions.len(),
            ],
            ..HelpGiven::default()
        };
        for step in &run.path {
            let [moment, force] = step.help.map(|p| p.norm());
            help.impulse += force;
            help.most = [help.most[0].max(force / h), help.most[1].max(moment / h)];
        }
        let seconds = reference.ticks() as f64 * problem.stage.dt;
        help.share = help.impulse / (weight * seconds);
        let effort = std::array::from_fn(|d| {
            let mut all: Vec<f64> = run.effort.iter().map(|e| e[d]).collect();
            all.sort_by(f64::total_cmp);
            all[(all.len() * 95 / 100).min(all.len() - 1)]
        });
        let share = settings.hold;
        let motion = RehearsedMotion {
            stage: problem.stage,
            motors: settings.motors,
            hold: PelvisHold {
                frequency: share.frequency,
                inertia: [p.mass, share.inertia * p.mass * p.height * p.height],
                most: [share.force * weight, share.moment * weight * p.height],
                reach: share.reach,
            },
            lead: reference.recorded[0],
            window: run.windows.length,
            ramp: run.windows.ramp,
            desired: reference.targets.clone(),
            offsets: actions.iter().map(|a| a.offset).collect(),
            path: run.path,
        };
        let [first, last] = reference.recorded;
        Self {
            motion,
            recorded: (last - first) as f64 * problem.stage.dt,
            states: run.states,
            errors: run.errors,
            help,
            effort,
            work,
        }
    }

    /// Whether it is never lost.
    pub fn completed(&self) -> bool {
        self.errors.lost_at.is_none() && !self.work.stopped
    }
}
