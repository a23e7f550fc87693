//! Samples of a window: the draw, its result, and the selection of survivors.

use super::look::Cost;
use super::problem::Reference;
use super::random::Random;
use super::settings::{SAMPLED, Settings};
use super::simulator::{Action, Simulator};
use crate::body::State;
use crate::figure::motion::rehearsed::JointOffset;

/// Sampled joints, and the help.
pub(super) const D: usize = SAMPLED.len() + 1;
/// Index of the help.
pub(super) const HELP: usize = D - 1;
/// The values that a sample draws.
pub(super) type Vector = [f64; D];

/// Cost of a sample that was not simulated to the end of its window: no other sample can begin from it.
pub(super) const DROPPED: f64 = 1e9;

/// A state that a sample led to.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub state: State,
    /// Index in the layer before.
    pub parent: usize,
    pub vector: Vector,
    /// Cost of its window, the score by which it is chosen, and the sum of the costs of its path.
    pub cost: f64,
    pub score: f64,
    pub total: f64,
}

pub(super) fn action(v: &Vector) -> Action {
    let mut offset = [0.0; crate::body::DOF_COUNT];
    for (d, x) in SAMPLED.into_iter().zip(v) {
        offset[d] = *x;
    }
    Action {
        offset: JointOffset(offset),
        help: v[HELP],
    }
}

/// A thread's input for its share of a window.
#[derive(Clone, Copy)]
pub(super) struct Window<'a> {
    pub settings: &'a Settings,
    pub reference: &'a Reference,
    pub cost: &'a Cost,
    pub parents: &'a [Node],
    pub index: usize,
    pub ticks: [usize; 2],
    /// Ticks in which its offsets are reached.
    pub ramp: usize,
    pub mean: &'a Vector,
    pub spread: &'a Vector,
    pub first: &'a Vector,
    pub most_help: f64,
    /// Score beyond which a sample would not survive, by present knowledge.
    pub pool: f64,
    /// The key of its random numbers.
    pub what: [u64; 2],
}

impl Window<'_> {
    /// The offsets of sample `i`, and the parent from which it begins.
    fn draw(&self, i: usize) -> (Vector, usize) {
        let n = self.parents.len();
        let [seed, round] = self.what;
        let mut random = Random::of([seed, round, self.index as u64, i as u64]);
        let mut v = *self.mean;
        let draw = &self.settings.draw;
        // First the mean from the best parents; then others, more often from better parents.
        if i < n.min(draw.from) {
            return (v, i);
        }
        let u = random.unit();
        let parent = (n as f64 * u * u.sqrt()) as usize;
        // A few far, most near, each with only a part of the joints.
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

    /// Score of a half-simulated sample, if the rest of its window brings its cost down to half.
    fn at_least(&self, mean: f64, last: f64, from: &Node) -> f64 {
        let end = self.settings.end;
        (1.0 - end) * mean + 0.5 * end * last + self.settings.trials.past * from.score
    }

    /// Simulates a sample.
    fn simulate(&self, sim: &mut Simulator, i: usize, give_up: f64) -> Node {
        let (vector, parent) = self.draw(i);
        let from = &self.parents[parent];
        let (before, after) = (action(&from.vector), action(&vector));
        let mut state = from.state;
        let [first, end] = self.ticks;
        let (mut sum, mut last) = (0.0, 0.0);
        for k in first..end {
            let action = after.on_the_way(&before.offset, k - first, self.ramp);
            sim.tick(&mut state, &self.reference.pairs[k], &action, |_| ());
            if !state.is_finite() {
                return from.child(from.state, parent, vector, DROPPED);
            }
            let (cost, off) = sim.cost(self.cost, &state, self.reference, k + 1);
            last = cost;
            sum += last;
            let half = 2 * (k + 1 - first) >= end - first;
            let hopeless =
                half && self.at_least(sum / (k + 1 - first) as f64, last, from) > self.pool;
            let kept = self.reference.is_kept(&off, k + 1, self.settings);
            if hopeless || last > give_up || !kept {
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

/// Simulates samples, in order, on all simulators.
pub(super) fn simulate_all(
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

/// Size of the better part of `count` samples, from which the survivors are taken.
fn pool(count: usize) -> usize {
    (count * 6).div_ceil(10)
}

/// Score of the last of the better part of these samples.
pub(super) fn pool_score(all: &[Node]) -> f64 {
    let mut scores: Vec<f64> = all.iter().map(|n| n.score).collect();
    scores.sort_by(f64::total_cmp);
    let last = pool(scores.len()).checked_sub(1);
    last.map_or(f64::INFINITY, |k| scores[k])
}

/// The survivors, from all that reached the end of the window: ranks spread by a cube over the better 60 %, so that a
/// few come from farther down.
pub(super) fn chosen(mut all: Vec<Node>, survivors: usize) -> Vec<Node> {
    all.retain(|n| n.cost < DROPPED);
    all.sort_by(|a, b| a.score.total_cmp(&b.score));
    let pool = pool(all.len());
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
