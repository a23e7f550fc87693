//! The search: windows, samples, survivors, sliding rounds (after Liu et al. 2010, *Sampling-based Contact-rich Motion
//! Control*, and 2015, *Improving Sampling-based Motion Control*).
//!
//! A window of the motion is tried from each state that survived the one before, with offsets around those of the best
//! path so far. Those that come nearest to the recording live on, a few of the others with them. A round ends where
//! everything is lost; the next begins some windows before that, with offsets spread as those that lived on were. Once
//! the end is reached, whole rounds polish the path.

use super::look::Cost;
use super::problem::{Problem, Reference};
use super::random::Random;
use super::settings::{SAMPLED, Settings};
use super::simulator::{Action, Simulator};
use crate::sim::body::State;
use crate::sim::figure::rehearsed::JointOffset;

/// Sampled joints, and the help.
const D: usize = SAMPLED.len() + 1;
/// Index of the help.
const HELP: usize = D - 1;
/// What a sample draws.
type Vector = [f64; D];

/// Cost of a sample that was not simulated to the end of its window: it is no beginning of another one.
const DROPPED: f64 = 1e9;

/// How far a search has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Round.
    pub round: usize,
    /// Windows that some sample has survived, and windows in all.
    pub reached: [usize; 2],
    /// Rounds over the whole clip that are done.
    pub polished: usize,
    /// True once help is tried.
    pub helps: bool,
    /// Ticks simulated.
    pub ticks: u64,
}

/// What a search has found.
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
    /// The caller stopped it.
    pub stopped: bool,
}

/// A state that a sample led to.
#[derive(Clone, Debug)]
struct Node {
    state: State,
    /// Index in the layer before.
    parent: usize,
    vector: Vector,
    /// Cost of its window, what it is chosen by, and sum of the costs of its path.
    cost: f64,
    score: f64,
    total: f64,
}

fn action(v: &Vector) -> Action {
    let mut offset = [0.0; crate::sim::body::DOF_COUNT];
    for (d, x) in SAMPLED.into_iter().zip(v) {
        offset[d] = *x;
    }
    Action {
        offset: JointOffset(offset),
        help: v[HELP],
    }
}

fn vector(action: &Action) -> Vector {
    std::array::from_fn(|k| match k {
        HELP => action.help,
        k => action.offset.0[SAMPLED[k]],
    })
}

/// A search, between rounds.
pub struct Search<'a> {
    problem: &'a Problem,
    reference: &'a Reference,
    settings: &'a Settings,
    cost: Cost,
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

/// How a search stands.
#[derive(Clone, Copy, Debug)]
struct Standing {
    round: usize,
    reached: usize,
    total: f64,
    /// Windows to go back farther, since a round came to nothing.
    farther: usize,
    polished: usize,
    /// Rounds since one came farther.
    stuck: usize,
    helps: bool,
    stopped: bool,
}

impl std::fmt::Debug for Search<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Search")
            .field("state", &self.state)
            .finish_non_exhaustive()
    }
}

/// What a thread needs for its share of a window.
#[derive(Clone, Copy)]
struct Window<'a> {
    settings: &'a Settings,
    reference: &'a Reference,
    cost: &'a Cost,
    parents: &'a [Node],
    index: usize,
    ticks: [usize; 2],
    mean: &'a Vector,
    spread: &'a Vector,
    first: &'a Vector,
    most_help: f64,
    /// Numbers that its random numbers are for.
    what: [u64; 2],
}

impl Window<'_> {
    /// What sample `i` adds, and the parent that it begins from.
    fn draw(&self, i: usize) -> (Vector, usize) {
        let n = self.parents.len();
        let [seed, round] = self.what;
        let mut random = Random::of([seed, round, self.index as u64, i as u64]);
        let mut v = *self.mean;
        // The mean from every parent; then others, from better parents more often.
        if i < n {
            return (v, i);
        }
        let u = random.unit();
        let parent = (n as f64 * u * u.sqrt()) as usize;
        // Some far, most near, and only a part of the joints at a time.
        let draw = &self.settings.draw;
        let far = if random.unit() < draw.far_share {
            draw.far
        } else {
            draw.near
        };
        for k in 0..HELP {
            if random.unit() < draw.part {
                v[k] += far * self.spread[k] * random.normal();
            }
        }
        if self.most_help > 0.0 {
            let help = self.mean[HELP];
            v[HELP] = match random.unit() {
                u if u < 0.25 => 0.0,
                u if u < 0.5 => 0.6 * help,
                _ => help + far * self.spread[HELP] * random.normal().abs(),
            };
            v[HELP] = v[HELP].clamp(0.0, self.most_help);
            if v[HELP] < self.settings.help.least {
                v[HELP] = 0.0;
            }
        }
        (v, parent.min(n - 1))
    }

    /// Simulates a sample.
    fn simulate(&self, sim: &mut Simulator, i: usize, give_up: f64) -> Node {
        let (vector, parent) = self.draw(i);
        let from = &self.parents[parent];
        let action = action(&vector);
        let mut state = from.state;
        let [first, end] = self.ticks;
        let (mut sum, mut last) = (0.0, 0.0);
        for k in first..end {
            sim.tick(&mut state, &self.reference.pairs[k], &action, |_| ());
            if !state.is_finite() {
                return from.child(from.state, parent, vector, DROPPED);
            }
            let (cost, distance) = sim.cost(self.cost, &state, self.reference, k + 1);
            last = cost;
            sum += last;
            if last > give_up || distance > self.settings.kept {
                return from.child(state, parent, vector, DROPPED);
            }
        }
        let mean = sum / (end - first) as f64;
        let effort: f64 = (0..HELP)
            .filter(|k| self.first[*k] > 0.0)
            .map(|k| (vector[k] / self.first[k]) * (vector[k] / self.first[k]))
            .sum();
        let end = self.settings.end;
        let mut cost = (1.0 - end) * mean + end * last + self.settings.effort * effort;
        if vector[HELP] > 0.0 {
            let (share, price) = (vector[HELP] / self.most_help, &self.settings.help);
            cost += price.any + price.full * share;
        }
        let cost = if cost.is_finite() { cost } else { DROPPED };
        let mut node = from.child(state, parent, vector, cost);
        node.score = cost + self.settings.trials.past * from.score;
        node
    }
}

impl Node {
    fn child(&self, state: State, parent: usize, vector: Vector, cost: f64) -> Self {
        Self {
            state,
            parent,
            vector,
            cost,
            score: cost,
            total: self.total + cost,
        }
    }
}

impl<'a> Search<'a> {
    /// A search that nothing is known of yet, or that begins with what was found before. As many threads as there are
    /// simulators; their number does not matter to what is found.
    pub fn new(
        problem: &'a Problem,
        reference: &'a Reference,
        settings: &'a Settings,
        threads: usize,
        before: &[Action],
    ) -> Self {
        let n = reference.ticks();
        let window = window_ticks(problem, settings);
        let bounds: Vec<usize> = (0..n).step_by(window).chain([n]).collect();
        let count = bounds.len() - 1;
        let mut first = [0.0; D];
        first[..HELP].copy_from_slice(&settings.spread.each());
        let mut means = vec![[0.0; D]; count];
        for (m, a) in means.iter_mut().zip(before) {
            *m = vector(a);
        }
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
            bounds,
            means,
            spreads: vec![first; count],
            first,
            layers: vec![vec![root]],
            sims: (0..threads.max(1))
                .map(|_| Simulator::new(problem, settings.motors))
                .collect(),
            state: Standing {
                round: 0,
                reached: 0,
                total: f64::INFINITY,
                farther: 0,
                polished: 0,
                stuck: 0,
                helps: false,
                stopped: false,
            },
        }
    }

    fn count(&self) -> usize {
        self.bounds.len() - 1
    }

    /// Ticks simulated so far.
    pub fn ticks(&self) -> u64 {
        self.sims.iter().map(|s| s.ticks).sum()
    }

    /// Round after round until the path is polished, nothing gets it farther, the budget is used up, or `go_on` says
    /// no: it is asked after each window.
    pub fn run(&mut self, go_on: &mut dyn FnMut(&Progress) -> bool) -> Path {
        let trials = self.settings.trials;
        let budget = trials.budget * self.reference.ticks() as u64;
        let mut limit = budget;
        while self.state.polished < trials.polish && !self.state.stopped {
            if self.ticks() > limit || self.state.stuck >= trials.patience {
                if self.state.helps || self.problem.most_help == 0.0 || self.reached_end() {
                    break;
                }
                self.begin_to_help();
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

    fn reached_end(&self) -> bool {
        self.state.reached == self.count()
    }

    /// From now on samples may be helped. Where the search was lost it begins with all the help that is allowed, since
    /// what is kept can be improved: samples with less are preferred.
    fn begin_to_help(&mut self) {
        self.state.helps = true;
        (self.state.stuck, self.state.farther, self.state.total) = (0, 0, f64::INFINITY);
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
        self.layers.truncate(first + 1);
        let mut lost = 0;
        for w in first..count {
            let chosen = self.window(w);
            if chosen.is_empty() {
                break;
            }
            let cheapest = chosen.iter().map(|n| n.cost).fold(f64::INFINITY, f64::min);
            self.layers.push(chosen);
            lost = if cheapest > trials.lost { lost + 1 } else { 0 };
            let progress = Progress {
                round: self.state.round,
                reached: [self.state.reached.max(w + 1 - lost), count],
                polished: self.state.polished,
                helps: self.state.helps,
                ticks: self.ticks(),
            };
            if !go_on(&progress) {
                self.state.stopped = true;
                break;
            }
            if lost >= 2 {
                break;
            }
        }
        let now = self.layers.len() - 1 - lost;
        self.layers.truncate(now + 1);
        if now > 0 {
            self.learn(first, now);
        }
    }

    /// Samples window `w` from the last layer; those that live on, best first.
    fn window(&mut self, w: usize) -> Vec<Node> {
        let trials = self.settings.trials;
        let parents = self.layers.last().expect("there is a first one");
        let worst = parents.iter().map(|p| p.cost).fold(0.0, f64::max);
        let give_up = trials.drop * worst + trials.lost;
        let window = Window {
            settings: self.settings,
            reference: self.reference,
            cost: &self.cost,
            parents,
            index: w,
            ticks: [self.bounds[w], self.bounds[w + 1]],
            mean: &self.means[w],
            spread: &self.spreads[w],
            first: &self.first,
            most_help: if self.state.helps {
                self.problem.most_help
            } else {
                0.0
            },
            what: [self.problem.seed, self.state.round as u64],
        };
        let mut all: Vec<Node> = Vec::new();
        while all.len() < trials.samples {
            let batch = all.len()..(all.len() + trials.batch).min(trials.samples);
            all.extend(simulate_all(&window, &mut self.sims, batch, give_up));
            let cheapest = all.iter().map(|n| n.cost).fold(f64::INFINITY, f64::min);
            // What led to a loss is not easy, however it looks.
            let rewound = w < self.state.reached && !self.reached_end();
            if cheapest < trials.easy && !rewound {
                break;
            }
        }
        chosen(all, trials.survivors)
    }

    /// Takes over the best path of a round from window `first` to `now`, if it is better than the last, and the spread
    /// of those that live on.
    fn learn(&mut self, first: usize, now: usize) {
        let count = self.count();
        let ends = &self.layers[now];
        let mut order: Vec<usize> = (0..ends.len()).collect();
        order.sort_by(|a, b| ends[*a].total.total_cmp(&ends[*b].total));
        let total = ends[order[0]].total;
        let (before, at_end) = (self.state.reached, now == count);
        let better = now > before || (now == before && total < self.state.total);
        self.state.stuck = if now > before || at_end {
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
            // Nearer to what is known, or wider where nothing is.
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

/// Ticks of a window.
pub(super) fn window_ticks(problem: &Problem, settings: &Settings) -> usize {
    ((settings.window / problem.stage.dt).round() as usize).max(1)
}

/// Simulates samples, in order, on all simulators.
fn simulate_all(
    window: &Window<'_>,
    sims: &mut [Simulator],
    batch: std::ops::Range<usize>,
    give_up: f64,
) -> Vec<Node> {
    let share = batch.len().div_ceil(sims.len());
    let part = |t: usize| {
        let first = (batch.start + t * share).min(batch.end);
        first..(first + share).min(batch.end)
    };
    if let [sim] = sims {
        return part(0).map(|i| window.simulate(sim, i, give_up)).collect();
    }
    std::thread::scope(|scope| {
        let handles: Vec<_> = sims
            .iter_mut()
            .enumerate()
            .map(|(t, sim)| {
                let mine = part(t);
                scope.spawn(move || {
                    mine.map(|i| window.simulate(sim, i, give_up))
                        .collect::<Vec<_>>()
                })
            })
            .collect();
        let done = handles.into_iter().map(|h| h.join());
        done.flat_map(|all| all.expect("simulating does not panic"))
            .collect()
    })
}

/// Those that live on, of all that came to the end of the window: ranks spread by a cube over the better 60 %,
/// so that a few come from farther down.
fn chosen(mut all: Vec<Node>, survivors: usize) -> Vec<Node> {
    all.retain(|n| n.cost < DROPPED);
    all.sort_by(|a, b| a.score.total_cmp(&b.score));
    let pool = (all.len() * 6).div_ceil(10);
    let keep = survivors.min(pool);
    let mut next = 0;
    let ranks: Vec<usize> = (0..keep)
        .map(|i| {
            let share = i as f64 / keep as f64;
            let rank = ((share * share * share * pool as f64) as usize).max(next);
            next = rank + 1;
            rank
        })
        .collect();
    let mut ranks = ranks.into_iter().peekable();
    let mut out = Vec::with_capacity(keep);
    for (i, node) in all.into_iter().enumerate() {
        if ranks.peek() == Some(&i) {
            ranks.next();
            out.push(node);
        }
    }
    out
}
