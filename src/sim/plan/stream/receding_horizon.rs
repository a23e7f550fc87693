//! The shift of the trunk that keeps the balance of a stream: a small optimal control problem over the window, whose
//! solution is refined with every sample.

use super::{H, RATE};
use crate::math::banded::{Factor, Pentadiagonal};
use crate::math::exp::exp;
use crate::math::polygon::SmallPolygon;
use crate::plan::params::balance;
use crate::plan::pelvis_shift::PRICE;
use crate::plan::turned_on_floor;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::ops::Range;

/// The known facts about the balance in one sample.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Balanced {
    /// Zero-moment point as received, m.
    pub zmp: [f64; 2],
    /// Region for the zero-moment point, if feet carry the body.
    pub support: Option<SmallPolygon>,
    /// Weight of this sample, 0…1.
    pub weight: f64,
    /// Square of the pendulum frequency, 1/s².
    pub omega2: f64,
    /// Heading of the body, rad.
    pub heading: f64,
    /// Zero-moment point that the supports ask for, and the accumulated residual, m: kept from sample to sample.
    goal: [f64; 2],
    debt: [f64; 2],
}

impl Balanced {
    /// A sample without any weight.
    pub fn new(zmp: [f64; 2], omega2: f64, heading: f64) -> Self {
        Self {
            zmp,
            support: None,
            weight: 0.0,
            omega2,
            heading,
            goal: zmp,
            debt: [0.0; 2],
        }
    }

    /// Displacement from the received zero-moment point into the support, m.
    pub fn way_inside(&self) -> [f64; 2] {
        let inside = self.support.as_ref().map(|s| s.nearest(self.zmp));
        inside.map_or([0.0; 2], |p| std::array::from_fn(|k| p[k] - self.zmp[k]))
    }

    /// The same, weighted, m.
    fn lacks(&self) -> [f64; 2] {
        let most = balance::STREAM_MOST_OUTSIDE;
        self.way_inside()
            .map(|way| self.weight * way.clamp(-most, most))
    }

    /// Replaces the sample by better knowledge of it.
    fn improve(&mut self, better: Self) {
        for k in 0..2 {
            self.goal[k] += better.zmp[k] - self.zmp[k];
        }
        *self = Self {
            goal: self.goal,
            debt: self.debt,
            ..better
        };
    }

    /// Moves a zero-moment point into the support, in proportion to the weight.
    fn take(&mut self, zmp: [f64; 2]) {
        let v: [f64; 2] = std::array::from_fn(|k| zmp[k] + self.debt[k]);
        let inside = self.support.as_ref().map_or(v, |s| s.nearest(v));
        let share = self.weight / (self.weight + 1.0);
        let most = balance::STREAM_MOST_OUTSIDE;
        for k in 0..2 {
            let way = (inside[k] - v[k]).clamp(-most, most);
            self.goal[k] = v[k] + share * way;
            self.debt[k] = v[k] - self.goal[k];
        }
    }
}

/// The samples of the window whose balance is known, and buffers of the problem.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Balance {
    samples: VecDeque<Balanced>,
    #[serde(skip)]
    matrix: Pentadiagonal,
    #[serde(skip)]
    rows: Vec<[f64; 3]>,
    shift: Vec<[f64; 2]>,
    /// Number of the first of the samples, and the index of its shift among the shifts.
    first: (i64, usize),
    /// Number of shifts that are solved.
    solved: usize,
    lacking: Lacking,
}

/// Average displacement that zero-moment points lack to be over the feet, in the body's axes, m.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Lacking {
    /// Sum and weight over the last second or so.
    lately: [f64; 2],
    weight: f64,
    now: [f64; 2],
}

impl Lacking {
    fn take(&mut self, sample: &Balanced) {
        let lacks = turned_on_floor(sample.lacks(), -sample.heading);
        let (lately, now) = (
            exp(-H / balance::STREAM_USUAL_TIME),
            exp(-H / balance::STREAM_NOW_TIME),
        );
        self.weight = lately * self.weight + 1.0;
        for (k, lack) in lacks.into_iter().enumerate() {
            self.lately[k] = lately * self.lately[k] + lack;
            self.now[k] += (1.0 - now) * (lack - self.now[k]);
        }
    }

    /// The displacement expected for a body that faces along `heading` (rad), m, world axes.
    fn expected(&self, heading: f64) -> [f64; 2] {
        let mean = self.lately.map(|l| l / self.weight.max(1.0));
        let expected =
            [0, 1].map(|k| mean[k] + balance::STREAM_NOW_SHARE * (self.now[k] - mean[k]));
        turned_on_floor(expected, heading)
    }
}

impl Balance {
    /// For windows of at most `most` samples. Allocates all the memory it will ever need.
    pub fn new(most: usize) -> Self {
        Self {
            samples: VecDeque::with_capacity(most + 2),
            matrix: Pentadiagonal::new(vec![0.0; most + 2]),
            rows: vec![[0.0; 3]; most + 2],
            shift: vec![[0.0; 2]; most + 2],
            first: (0, 1),
            solved: 0,
            lacking: Lacking::default(),
        }
    }

    /// Adds the buffers to a value that was read from a checkpoint. Returns whether that value is for windows of at
    /// most `most` samples and holds the numbered `samples`.
    pub fn complete(&mut self, most: usize, samples: Range<i64>) -> bool {
        let Range { start: first, end } = samples;
        let fresh = Self::new(most);
        let room = fresh.shift.len();
        (self.matrix, self.rows) = (fresh.matrix, fresh.rows);
        self.shift.len() == room
            && self.samples.len() < room
            && self.solved <= room
            && self.first.1 <= room
            && self.first.0 == first
            && self.samples.len() as i64 == (end - first).max(0)
    }

    /// Adds the next known sample.
    pub fn push(&mut self, sample: Balanced) {
        self.lacking.take(&sample);
        self.samples.push_back(sample);
    }

    /// Replaces sample `i` by better knowledge of it.
    pub fn improve(&mut self, i: i64, better: Balanced) {
        let k = usize::try_from(i - self.first.0).ok();
        if let Some(sample) = k.and_then(|k| self.samples.get_mut(k)) {
            sample.improve(better);
        }
    }

    /// The shift planned for sample `i` with the present knowledge, m.
    pub fn planned(&self, i: i64) -> [f64; 2] {
        let k = (i - self.first.0).max(0) as usize + self.first.1;
        let last = self.solved.checked_sub(1);
        last.map_or([0.0; 2], |last| self.shift[k.min(last)])
    }

    /// The shift of the centre of mass in the next sample of the output, m.
    ///
    /// Minimises `Σ Δ² + τ⁴ Δ̈² + Σ (outside/COST)²` over the samples that are known, where the zero-moment point
    /// answers to a shift Δ by Δ − Δ̈/ω², as the preparation of clips does
    /// ([`pelvis_shift`](crate::plan::pelvis_shift::pelvis_shift)). Unlike there, Δ continues from its present value,
    /// and beyond the window it falls, as a pendulum at rest does, to the average displacement that zero-moment points
    /// lack: bodies that are built differently from the recorded one, or carry nothing where it does, are off in the
    /// same way all the time. A few alternations are enough, since every sample takes part in as many problems as the
    /// window is long.
    ///
    /// * `so_far`: Δ of the last two samples of the output, the newer one last, m; `None` in the beginning, where it is
    ///   free. The newer one is the first of the samples that take part: those before it are forgotten.
    ///
    /// O(samples); allocates nothing.
    pub fn next(&mut self, so_far: Option<[[f64; 2]; 2]>) -> [f64; 2] {
        // Unknown 0 lies before the first sample.
        let n = self.samples.len() + 1;
        if n < 2 {
            return so_far.map_or([0.0; 2], |s| s[1]);
        }
        let factor = self.factor(n, so_far.is_some());
        let last = n - 2;
        let (a, dies) = self.last_answer();
        // The last shift leads on to the one beyond: this is its effect on the last zero-moment point, and on the last
        // bend.
        let heading = self.samples.back().map_or(0.0, |s| s.heading);
        let beyond = self.lacking.expected(heading).map(|m| (1.0 - dies) * m);
        let bend = (balance::BEND_TIME * RATE).powi(4);
        let rounds = match self.solved {
            0 => balance::STREAM_FIRST_ALTERNATIONS,
            _ => balance::STREAM_ALTERNATIONS,
        };
        let shift = &mut self.shift[..n];
        for _ in 0..rounds {
            shift.fill([0.0; 2]);
            for (x, held) in shift.iter_mut().zip(so_far.iter().flatten()) {
                *x = held.map(|h| balance::STREAM_FIXED_PRICE * h);
            }
            for (x, w) in shift[last..].iter_mut().zip([1.0, dies - 2.0]) {
                for (x, m) in x.iter_mut().zip(beyond) {
                    *x -= bend * w * m;
                }
            }
            for (i, (s, row)) in self.samples.iter().zip(&self.rows).enumerate() {
                let on = if i == last { a } else { 0.0 };
                let want: [f64; 2] = std::array::from_fn(|k| {
                    PRICE * (s.goal[k] - s.debt[k] - s.zmp[k] + on * beyond[k])
                });
                for (x, share) in shift[i..].iter_mut().zip(row) {
                    for (x, w) in x.iter_mut().zip(want) {
                        *x += share * w;
                    }
                }
            }
            factor.solve(shift);
            for (i, (s, row)) in self.samples.iter_mut().zip(&self.rows).enumerate() {
                let on = if i == last { a } else { 0.0 };
                let answer = |k: usize| -> f64 {
                    let own: f64 = shift[i..].iter().zip(row).map(|(x, r)| r * x[k]).sum();
                    own - on * beyond[k]
                };
                s.take([s.zmp[0] + answer(0), s.zmp[1] + answer(1)]);
            }
        }
        let next = self.shift[if so_far.is_some() { 2 } else { 1 }.min(n - 1)];
        self.matrix = factor.into_matrix();
        // The next sample of the output is the first of the next problem.
        if so_far.is_some() {
            self.samples.pop_front();
            self.first = (self.first.0 + 1, 2);
        }
        self.solved = n;
        next
    }

    /// How the last zero-moment point answers to the shift beyond, and the factor by which a decaying shift shrinks per
    /// sample.
    fn last_answer(&self) -> (f64, f64) {
        let omega2 = self.samples.back().map_or(10.0, |s| s.omega2);
        (RATE * RATE / omega2, exp(-omega2.sqrt() * H))
    }

    /// How each of the samples' zero-moment points answers to its own shift and those of its neighbours (`rows`), and
    /// the problem of the `n` shifts with the first two `held`, or at rest.
    fn factor(&mut self, n: usize, held: bool) -> Factor {
        let dies = self.last_answer().1;
        let mut matrix = std::mem::take(&mut self.matrix);
        matrix.reset(n, 1.0);
        if held {
            matrix.add_row(0, [1.0, 0.0, 0.0], balance::STREAM_FIXED_PRICE);
            matrix.add_row(1, [1.0, 0.0, 0.0], balance::STREAM_FIXED_PRICE);
        } else {
            matrix.add_row(0, [1.0, -1.0, 0.0], balance::STREAM_FIXED_PRICE);
        }
        for (i, (s, row)) in self.samples.iter().zip(&mut self.rows).enumerate() {
            let a = RATE * RATE / s.omega2;
            *row = [-a, 1.0 + 2.0 * a, -a];
            let mut bend = [1.0, -2.0, 1.0];
            if i + 2 == n {
                row[1] += dies * row[2];
                bend[1] += dies;
                (row[2], bend[2]) = (0.0, 0.0);
            }
            matrix.add_row(i as isize, *row, PRICE);
            matrix.add_row(i as isize, bend, (balance::BEND_TIME * RATE).powi(4));
        }
        matrix.factor()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OMEGA2: f64 = 11.0;

    /// A support of ±3 cm about the origin, and a zero-moment point that is 8 cm off for a third of a second.
    fn recorded(i: usize) -> Balanced {
        let out = (90..110).contains(&i);
        let mut b = Balanced::new([if out { 0.08 } else { 0.0 }, 0.0], OMEGA2, 0.0);
        let mut square = SmallPolygon::default();
        for corner in [[-0.04, -0.04], [0.04, -0.04], [0.04, 0.04], [-0.04, 0.04]] {
            square.add(corner);
        }
        b.support = square.inner(0.01);
        b.weight = 1.0;
        b
    }

    /// Shifts of 200 samples, prepared with a window of `window` samples.
    fn shifts(window: usize, recorded: impl Fn(usize) -> Balanced) -> Vec<[f64; 2]> {
        let mut balance = Balance::new(window);
        (0..window - 1).for_each(|i| balance.push(recorded(i)));
        let mut out: Vec<[f64; 2]> = Vec::new();
        for i in 0..200usize {
            balance.push(recorded(i + window - 1));
            let so_far = (i > 0).then(|| [out[i.saturating_sub(2)], out[i - 1]]);
            out.push(balance.next(so_far));
        }
        out
    }

    /// Largest distance by which the zero-moment point that answers to the shifts is out of the support along x, m.
    fn outside(shift: &[[f64; 2]]) -> f64 {
        let a = RATE * RATE / OMEGA2;
        (1..shift.len() - 1)
            .map(|i| {
                let [before, now, after] = [i - 1, i, i + 1].map(|k| shift[k][0]);
                let zmp = recorded(i).zmp[0] + now - a * (after - 2.0 * now + before);
                zmp.abs() - 0.03
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn what_is_seen_in_time_is_brought_inside() {
        let [short, long] = [10, 50].map(|window| outside(&shifts(window, recorded)));
        // The recorded value is 5 cm.
        assert!(long < 0.015, "{long}");
        assert!(short < 0.045 && long < short, "{short}, {long}");
    }

    #[test]
    fn what_lasts_is_expected_to_go_on() {
        // 8 cm off all the time, in a window of a tenth of a second: nothing in the window shows when that ends, so it
        // is assumed not to end.
        let lasting = |_: usize| recorded(100);
        let shift = shifts(10, lasting);
        for s in &shift[60..] {
            assert!((0.08 + s[0] - 0.03).abs() < 0.01, "{s:?}");
        }
    }

    #[test]
    fn what_is_known_better_counts() {
        let square = recorded(0);
        let mut balance = Balance::new(40);
        (0..40).for_each(|_| balance.push(square));
        assert!(balance.next(None)[0].abs() < 1e-9);
        (0..40).for_each(|i| {
            let zmp = [0.08, 0.0];
            balance.improve(i, Balanced { zmp, ..square });
        });
        for _ in 0..20 {
            balance.next(None);
        }
        assert!((balance.planned(20)[0] + 0.05).abs() < 0.01);
    }

    #[test]
    fn what_is_inside_is_left_alone() {
        let still = |_: usize| Balanced {
            zmp: [0.02, -0.01],
            goal: [0.02, -0.01],
            ..recorded(0)
        };
        for s in shifts(30, still) {
            assert!(s[0].abs() < 1e-9 && s[1].abs() < 1e-9, "{s:?}");
        }
    }

    #[test]
    fn the_shift_goes_on_from_where_it_is() {
        let mut balance = Balance::new(40);
        (0..40).for_each(|_| balance.push(recorded(0)));
        let next = balance.next(Some([[0.030, -0.02], [0.032, -0.02]]));
        // Continues at 0.12 m/s, bent by no more than supports allow: ω² (0.032 + 0.03 + 0.01) / 60².
        assert!((next[0] - 0.034).abs() < 3e-4, "{next:?}");
        assert!((next[1] + 0.02).abs() < 3e-4, "{next:?}");
    }
}
