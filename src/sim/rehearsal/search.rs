//! The search: windows, samples, survivors, sliding rounds (after Liu et al. 2010, *Sampling-based Contact-rich Motion
//! Control*, and 2015, *Improving Sampling-based Motion Control*).
//!
//! A window of the motion is tried from each state that survived the previous one, with offsets around those of the
//! best path known. The samples nearest to the recording survive, and a few of the others with them. A round ends when
//! everything is lost; the next begins some windows before that, with offsets spread like those of the survivors. Once
//! the end is reached, whole rounds polish the path.

use super::look::Cost;
use super::problem::{Problem, Reference};
use super::sample::{D, HELP, Node, Vector, Window, action, chosen, pool_score, simulate_all};
use super::settings::{Settings, Tries};
use super::simulator::{Action, Simulator, WindowTicks};

/// The progress of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Current round.
    pub round: usize,
    /// Windows with a survivor, and all windows.
    pub reached: [usize; 2],
    /// Finished rounds over the whole clip.
    pub polished: usize,
    /// Whether help is being tried.
    pub helps: bool,
    /// Ticks simulated.
    pub ticks: u64,
}

/// The result of a search.
#[derive(Clone, Debug)]
pub struct Path {
    /// By window; none after the last that was reached.
    pub actions: Vec<Action>,
    /// Windows that were reached.
    pub reached: usize,
    /// Mean cost of a window.
    pub cost: f64,
    /// Rounds.
    pub rounds: usize,
    /// Whether the caller stopped it.
    pub stopped: bool,
}

/// A search, between rounds.
pub struct Search<'a> {
    problem: &'a Problem,
    reference: &'a Reference,
    settings: &'a Settings,
    cost: Cost,
    windows: WindowTicks,
    /// First tick of each window, and the end.
    bounds: Vec<usize>,
    means: Vec<Vector>,
    spreads: Vec<Vector>,
    /// Spread of the first round.
    first: Vector,
    /// Survivors at the start of each window that was reached, and at the end of the last.
    layers: Vec<Vec<Node>>,
    sims: Vec<Simulator>,
    state: Standing,
}

/// The stages to which a search turns when it stops making progress, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SearchStage {
    /// Strength alone, within the near limits.
    Near,
    /// With help, if any is allowed.
    Helped,
    /// With help, if any is allowed, and within the far limits.
    Far,
}

/// The state of a search.
#[derive(Clone, Copy, Debug)]
struct Standing {
    stage: SearchStage,
    round: usize,
    reached: usize,
    total: f64,
    /// Additional windows to go back, because a round achieved nothing.
    farther: usize,
    polished: usize,
    /// Rounds since one got farther, or made the path noticeably cheaper.
    stuck: usize,
    stopped: bool,
}

impl std::fmt::Debug for Search<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Search")
            .field("state", &self.state)
            .finish_non_exhaustive()
    }
}

impl<'a> Search<'a> {
    /// A search without results yet, on the given number of threads, which does not affect the result.
    pub fn new(
        problem: &'a Problem,
        reference: &'a Reference,
        settings: &'a Settings,
        threads: usize,
    ) -> Self {
        let n = reference.ticks();
        let windows = WindowTicks::new(problem, settings);
        let bounds: Vec<usize> = (0..n).step_by(windows.length).chain([n]).collect();
        let count = bounds.len() - 1;
        let mut first = [0.0; D];
        first[..HELP].copy_from_slice(&settings.spread.each());
        let root = Node {
            state: reference.start(),
            parent: 0,
            vector: [0.0; D],
            cost: 0.0,
            score: 0.0,
            total: 0.0,
        };
        Self {
            problem,
            reference,
            settings,
            cost: Cost::new(settings.sizes),
            windows,
            bounds,
            means: vec![[0.0; D]; count],
            spreads: vec![first; count],
            first,
            layers: vec![vec![root]],
            sims: (0..threads.max(1))
                .map(|_| Simulator::new(problem, settings))
                .collect(),
            state: Standing {
                stage: SearchStage::Near,
                round: 0,
                reached: 0,
                total: f64::INFINITY,
                farther: 0,
                polished: 0,
                stuck: 0,
                stopped: false,
            },
        }
    }

    fn count(&self) -> usize {
        self.bounds.len() - 1
    }

    /// Ticks simulated until now.
    pub fn ticks(&self) -> u64 {
        self.sims.iter().map(|s| s.ticks).sum()
    }

    /// Runs round after round until the path is polished, no round gets farther, the budget is used up, or `go_on`
    /// returns `false`; it is asked after each window.
    pub fn run(&mut self, go_on: &mut dyn FnMut(&Progress) -> bool) -> Path {
        let trials = self.settings.trials;
        let budget = (trials.budget * self.reference.ticks() as u64).max(trials.least_budget);
        let mut limit = budget;
        while self.state.polished < trials.polish.rounds && !self.state.stopped {
            if self.ticks() > limit || self.state.stuck >= trials.patience {
                if self.reached_end() || self.state.stage == SearchStage::Far {
                    break;
                }
                if self.state.stage == SearchStage::Near && self.problem.most_help > 0.0 {
                    self.begin_to_help();
                } else {
                    self.begin_to_go_far();
                }
                limit = self.ticks() + budget;
            }
            self.round(go_on);
            self.state.round += 1;
        }
        Path {
            actions: self.means[..self.state.reached]
                .iter()
                .map(action)
                .collect(),
            reached: self.state.reached,
            cost: self.state.total / self.state.reached.max(1) as f64,
            rounds: self.state.round,
            stopped: self.state.stopped,
        }
    }

    /// The progress until now.
    pub fn progress(&self) -> Progress {
        Progress {
            round: self.state.round,
            reached: [self.state.reached, self.count()],
            polished: self.state.polished,
            helps: self.helps(),
            ticks: self.ticks(),
        }
    }

    fn reached_end(&self) -> bool {
        self.state.reached == self.count()
    }

    /// Whether samples may be helped.
    fn helps(&self) -> bool {
        self.state.stage != SearchStage::Near && self.problem.most_help > 0.0
    }

    /// The effort per window in the present stage.
    fn tries(&self) -> Tries {
        let trials = &self.settings.trials;
        match self.state.stage {
            SearchStage::Near | SearchStage::Helped => trials.near,
            SearchStage::Far => trials.far,
        }
    }

    /// Enters a stage, which is not measured by earlier results.
    fn begin(&mut self, stage: SearchStage) {
        self.state.stage = stage;
        (self.state.stuck, self.state.farther, self.state.total) = (0, 0, f64::INFINITY);
    }

    /// From now on nothing counts as lost that is near enough to count as kept, and everything is open again.
    fn begin_to_go_far(&mut self) {
        self.begin(SearchStage::Far);
        self.spreads.fill(self.first);
    }

    /// From now on samples may be helped. At the place where the search was lost it begins with all the allowed help,
    /// since a kept path can be improved: samples with less help are preferred.
    fn begin_to_help(&mut self) {
        self.begin(SearchStage::Helped);
        let back = self.settings.trials.back;
        for m in &mut self.means[self.state.reached.saturating_sub(back)..] {
            m[HELP] = self.problem.most_help;
        }
        self.first[HELP] = 0.5 * self.problem.most_help;
        for s in &mut self.spreads {
            s[HELP] = self.first[HELP];
        }
    }

    /// One round.
    fn round(&mut self, go_on: &mut dyn FnMut(&Progress) -> bool) {
        let trials = self.settings.trials;
        let count = self.count();
        let first = match self.state.reached {
            0 => 0,
            n if n == count => 0,
            n => n.saturating_sub(trials.back + self.state.farther),
        };
        // A round that achieved nothing has left no states beyond the window in which it was lost.
        let first = first.min(self.layers.len() - 1);
        self.layers.truncate(first + 1);
        let mut lost = 0;
        for w in first..count {
            debug_assert_eq!(
                self.layers.len(),
                w + 1,
                "states at the start of window {w}"
            );
            let chosen = self.window(w);
            let cheapest = chosen.iter().map(|n| n.cost).fold(f64::INFINITY, f64::min);
            let ended = chosen.is_empty();
            if !ended {
                self.layers.push(chosen);
                lost = if cheapest > self.tries().lost {
                    lost + 1
                } else {
                    0
                };
            }
            let mut progress = self.progress();
            progress.reached[0] = progress.reached[0].max(self.layers.len() - 1 - lost);
            if !go_on(&progress) {
                self.state.stopped = true;
            }
            if ended || self.state.stopped || lost >= 2 {
                break;
            }
        }
        let now = self.layers.len() - 1 - lost;
        self.layers.truncate(now + 1);
        if now > 0 {
            self.learn(first, now);
        } else {
            // Lost in the first window.
            self.state.stuck += 1;
        }
    }

    /// Samples window `w` from the last layer; returns the survivors, best first.
    fn window(&mut self, w: usize) -> Vec<Node> {
        let trials = self.settings.trials;
        let parents = self.layers.last().expect("there is a first one");
        let worst = parents.iter().map(|p| p.cost).fold(0.0, f64::max);
        let tries = self.tries();
        let give_up = trials.drop * worst + tries.lost;
        let mut window = Window {
            pool: f64::INFINITY,
            settings: self.settings,
            reference: self.reference,
            cost: &self.cost,
            parents,
            index: w,
            ticks: [self.bounds[w], self.bounds[w + 1]],
            ramp: self.windows.ramp,
            mean: &self.means[w],
            spread: &self.spreads[w],
            first: &self.first,
            most_help: if self.helps() {
                self.problem.most_help
            } else {
                0.0
            },
            what: [self.problem.seed, self.state.round as u64],
        };
        let mut all: Vec<Node> = Vec::new();
        let most = match self.state.polished {
            0 => tries.samples,
            _ => trials.polish.samples.min(tries.samples),
        };
        let enough = trials.enough;
        // A window that led to a loss does not count as easy, however it looks.
        let rewound = w < self.state.reached && !self.reached_end();
        let mut best = f64::INFINITY;
        while all.len() < most {
            let batch = all.len()..(all.len() + trials.batch).min(most);
            window.pool = pool_score(&all);
            all.extend(simulate_all(&window, &mut self.sims, batch, give_up));
            let least = |of: fn(&Node) -> f64| all.iter().map(of).fold(f64::INFINITY, f64::min);
            let (cheapest, score) = (least(|n| n.cost), least(|n| n.score));
            let gained = score < (1.0 - enough.gain) * best;
            best = score;
            if !rewound && (cheapest < enough.easy || (cheapest < enough.calm && !gained)) {
                break;
            }
        }
        chosen(all, trials.survivors)
    }

    /// Adopts the best path of a round from window `first` to `now`, if it is better than the last, and the spread of
    /// the survivors.
    fn learn(&mut self, first: usize, now: usize) {
        let count = self.count();
        let ends = &self.layers[now];
        let mut order: Vec<usize> = (0..ends.len()).collect();
        order.sort_by(|a, b| ends[*a].total.total_cmp(&ends[*b].total));
        let total = ends[order[0]].total;
        let (before, at_end) = (self.state.reached, now == count);
        let better = now > before || (now == before && total < self.state.total);
        let least = (1.0 - self.settings.trials.gain) * self.state.total;
        let gained = now == before && total < least;
        self.state.stuck = if now > before || at_end || gained {
            0
        } else {
            self.state.stuck + 1
        };
        self.state.farther = if now > before || at_end {
            0
        } else {
            self.state.farther + 2
        };
        if at_end {
            self.state.polished += 1;
        }
        if !better {
            // Narrower around a known path, or wider without one.
            let factor = if at_end { 0.7 } else { 1.2 };
            for s in &mut self.spreads[first..now] {
                for (s, most) in s.iter_mut().zip(&self.first) {
                    *s = (factor * *s).min(*most);
                }
            }
            return;
        }
        let mut at = order[0];
        for w in (0..now).rev() {
            let node = &self.layers[w + 1][at];
            self.means[w] = node.vector;
            at = node.parent;
        }
        let mut alive: Vec<usize> = order[..order.len().div_ceil(2)].to_vec();
        for w in (0..now).rev() {
            alive.sort_unstable();
            alive.dedup();
            let layer = &self.layers[w + 1];
            if w >= first {
                for k in 0..D {
                    let mean = self.means[w][k];
                    let square =
                        |i: &usize| (layer[*i].vector[k] - mean) * (layer[*i].vector[k] - mean);
                    let variance = alive.iter().map(square).sum::<f64>() / alive.len() as f64;
                    let s = &mut self.spreads[w][k];
                    *s = (0.5 * *s * *s + 0.5 * variance).sqrt();
                    *s = s.clamp(
                        self.settings.draw.least_spread * self.first[k],
                        self.first[k],
                    );
                }
            }
            for a in &mut alive {
                *a = layer[*a].parent;
            }
        }
        (self.state.reached, self.state.total) = (now, total);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::figure::motion::rehearsed::RehearsalWorld as World;
    use crate::motion::Clip;
    use crate::motion::builtin::builtin;
    use crate::setup::StrengthScale;
    use std::sync::Arc;

    /// A round that was lost at once leaves only the states at its start, while the best path continues beyond.
    #[test]
    fn a_round_begins_where_there_are_states() {
        let body = Arc::new(Body::adult_man());
        let world = World {
            dt: 1.0 / 60.0,
            substeps: 2,
            gravity: 9.81,
        };
        let whole = builtin(&body, "squat").unwrap();
        let postures = (0..=60).map(|i| whole.sample(0.8 + f64::from(i) / 60.0).posture);
        let planted = vec![[true; 2]; 61];
        let clip = Clip::from_postures("squat", 60.0, postures.collect(), planted).unwrap();
        let problem = Problem::new(body, &StrengthScale::default(), 0.9, world);
        let mut settings = Settings::default();
        (settings.trials.near.samples, settings.trials.batch) = (12, 12);
        let reference = Reference::new(&problem, &clip, &settings.rest).unwrap();
        let mut search = Search::new(&problem, &reference, &settings, 1);
        search.round(&mut |_| true);
        let count = search.count();
        assert_eq!(
            (search.state.reached, search.layers.len()),
            (count, count + 1)
        );
        search.layers.truncate(1);
        search.state.reached = count - 1;
        search.round(&mut |_| true);
        assert_eq!(
            (search.state.reached, search.layers.len()),
            (count, count + 1)
        );
        for (layer, next) in search.layers.iter().zip(&search.layers[1..]) {
            assert!(next.iter().all(|n| n.parent < layer.len()));
        }
    }
}
