//! Turns runs into walking: slows a run down and shortens it until a body whose muscles cannot run can take the same
//! steps.
//!
//! A run needs more strength than is measured in people's joints: hip, knee and ankle are at their limits together, and
//! at take-off the ankle turns so fast that it gives far less torque than it can hold (`docs/locomotion.md#runs`). The
//! parts that can be kept are the steps, their order, rhythm and headings, and the motion of trunk and arms. Time is
//! slowed until steps last as long as walked ones. The path is shortened along with them until its speed is that of a
//! walk (and until the body leans no more than it can brake from such a speed). Every foot stays down until the other
//! one has landed, and between its places it swings as a walking foot does.

use crate::math::curve::{arc, smootherstep};
use crate::math::runs::{runs, stretches};
use crate::math::{Quat, Vec3};
use crate::motion::GRAVITY;
use crate::motion::filter::{low_pass, low_pass_points, speeds};
use crate::reference::params::{run_detection, run_to_walk};

/// Speed over the floor of the slow part of a path, the highest around each sample, m/s.
pub(crate) fn paces(way: &[Vec3], rate_hz: f64) -> Vec<f64> {
    let mut way: Vec<Vec3> = way.iter().map(|p| p.horizontal()).collect();
    low_pass_points(&mut way, run_detection::PATH_CUTOFF, rate_hz);
    let speed = speeds(&way, rate_hz);
    let half = (run_detection::PACE_TIME * rate_hz) as usize;
    let around = |i: usize| &speed[i.saturating_sub(half)..(i + half).min(speed.len())];
    let most = |i: usize| around(i).iter().copied().fold(0.0, f64::max);
    (0..speed.len()).map(most).collect()
}

/// How far behind (or ahead of) its feet a body on this path has to lean to change its `slow` path as fast as it does,
/// m.
fn leans(way: &[Vec3], slow: &[Vec3], feet: [&[Vec3]; 2], rate_hz: f64) -> Vec<f64> {
    let n = way.len();
    let lowest = feet.into_iter().flatten();
    let floor = lowest.map(|p| p.z).fold(f64::INFINITY, f64::min);
    let lean = |i: usize| {
        let (before, after) = (slow[i.saturating_sub(1)], slow[(i + 1).min(n - 1)]);
        let bend = before - slow[i] * 2.0 + after;
        let acceleration = bend.x.hypot(bend.y) * rate_hz * rate_hz;
        acceleration * (way[i].z - floor) / GRAVITY
    };
    let mut out: Vec<f64> = (0..n).map(lean).collect();
    if n > 2 {
        (out[0], out[n - 1]) = (out[1], out[n - 2]);
    }
    out
}

/// Lead of the left foot over the right one along the `slow` path of the body, m per sample.
pub(super) fn leads(slow: &[Vec3], [left, right]: [&[Vec3]; 2], rate_hz: f64) -> Vec<f64> {
    let n = slow.len();
    let mut lead: Vec<f64> = (0..n)
        .map(|i| {
            let ahead = slow[(i + 1).min(n - 1)] - slow[i.saturating_sub(1)];
            let ahead = ahead.horizontal().normalized_or(Vec3::X);
            (left[i] - right[i]).dot(ahead)
        })
        .collect();
    low_pass(&mut lead, run_detection::LEAD_CUTOFF, rate_hz);
    lead
}

/// Samples within `range` at which a foot that has moved ahead begins to fall behind.
pub(super) fn turning_points(lead: &[f64], range: std::ops::Range<usize>) -> Vec<usize> {
    let (mut turns, mut sense, mut last) = (Vec::new(), 0.0f64, range.start);
    for k in range.start + 1..range.end {
        let back = lead[last] - lead[k];
        if sense == 0.0 {
            if back.abs() > run_detection::LEAD_TURN {
                (sense, last) = (-back.signum(), k);
            }
        } else if sense * back < 0.0 {
            last = k;
        } else if sense * back > run_detection::LEAD_TURN {
            turns.push(last);
            (sense, last) = (-sense, k);
        }
    }
    turns
}

/// Duration of the step to which each sample belongs, s: from one turning point of the distance between the feet to the
/// next, along the `slow` path of the body.
fn steps(slow: &[Vec3], feet: [&[Vec3]; 2], rate_hz: f64) -> Vec<f64> {
    let n = slow.len();
    let turns = turning_points(&leads(slow, feet, rate_hz), 0..n);
    let of = |i: usize| {
        // Before the first and after the last turning point the steps are assumed to continue unchanged.
        let k = turns.partition_point(|t| *t <= i);
        let k = k.clamp(1, turns.len().max(2) - 1);
        let between = turns.get(k).map(|t| (t - turns[k - 1]) as f64 / rate_hz);
        between
            .unwrap_or(run_to_walk::LONGEST_STEP)
            .min(run_to_walk::LONGEST_STEP)
    };
    (0..n).map(of).collect()
}

/// How a recording with runs is played so that they are walked.
#[derive(Clone, Debug)]
pub(crate) struct RunToWalk {
    /// Sample of the recording, with fraction, that each sample of the motion shows.
    times: Vec<f64>,
    /// Length of the path in each sample of the motion, as a share of the recorded one.
    share: Vec<f64>,
    /// Seconds of the recording per second of the motion, in each of its samples.
    pace: Vec<f64>,
}

impl RunToWalk {
    /// `None` if there is no run.
    ///
    /// * `way`: of the middle of the body, `feet`: of the left and the right foot, m; `runs`: first sample of each run
    ///   and one past its last; `rate_hz`: of the recording; `to_hz`: of the motion.
    pub(crate) fn new(
        way: &[Vec3],
        feet: [&[Vec3]; 2],
        runs: &[(usize, usize)],
        rate_hz: f64,
        to_hz: f64,
    ) -> Option<Self> {
        let n = way.len();
        if runs.is_empty() {
            return None;
        }
        let speed = paces(way, rate_hz);
        let mut slow = way.to_vec();
        low_pass_points(&mut slow, run_detection::PATH_CUTOFF, rate_hz);
        let step = steps(&slow, feet, rate_hz);
        let leans = leans(way, &slow, feet, rate_hz);
        let (mut pace, mut share) = (vec![1.0; n], vec![1.0; n]);
        for &(i, j) in runs {
            for k in i..j {
                let rhythm = (step[k] / run_to_walk::WALKED_STEP).min(1.0);
                share[k] = (run_detection::WALK_SPEED / (speed[k] * rhythm))
                    .min(run_to_walk::MOST_LEAN / leans[k].max(1e-9))
                    .clamp(run_to_walk::LEAST_LENGTH, 1.0);
                pace[k] = (run_detection::WALK_SPEED / (speed[k] * share[k])).min(rhythm);
            }
        }
        // Time returns to its own pace after a run has ended, not before.
        let half = (run_to_walk::PACE_HELD * rate_hz) as usize;
        let mut pace: Vec<f64> = (0..n)
            .map(|i| {
                let around = &pace[i.saturating_sub(half)..(i + half + 1).min(n)];
                around.iter().copied().fold(1.0, f64::min)
            })
            .collect();
        low_pass(&mut pace, run_detection::PATH_CUTOFF, rate_hz);
        low_pass(&mut share, run_detection::PATH_CUTOFF, rate_hz);
        let mut out = Self {
            times: Vec::new(),
            share: Vec::new(),
            pace: Vec::new(),
        };
        let mut at = 0.0;
        while at < (n - 1) as f64 {
            let k = at as usize;
            out.times.push(at);
            out.share.push(share[k].min(1.0));
            let pace = pace[k].clamp(run_to_walk::LEAST_PACE, 1.0);
            out.pace.push(pace);
            at += pace * rate_hz / to_hz;
        }
        Some(out)
    }

    /// How many times longer the motion is than its recording of `samples` samples at the rate of the motion.
    pub(crate) fn stretch(&self, samples: f64) -> f64 {
        self.times.len() as f64 / samples.max(1.0)
    }

    /// Samples of the motion.
    pub(crate) fn count(&self) -> usize {
        self.times.len()
    }

    fn between(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.times.iter().map(|t| (*t as usize, t.fract()))
    }

    /// A path of the recording as the motion shows it.
    pub(crate) fn points(&self, p: &[Vec3]) -> Vec<Vec3> {
        let at = |(k, u): (usize, f64)| p[k] * (1.0 - u) + p[k + 1] * u;
        self.between().map(at).collect()
    }

    /// The same for rotations.
    pub(crate) fn rotations(&self, q: &[Quat]) -> Vec<Quat> {
        let turn = |k: usize| (q[k].conjugate() * q[k + 1]).log();
        let at = |(k, u): (usize, f64)| (q[k] * Quat::exp(turn(k) * u)).normalized();
        self.between().map(at).collect()
    }

    /// First and one past the last sample of each run, its last step included.
    fn stretches(&self) -> Vec<(usize, usize)> {
        let run: Vec<bool> = self.share.iter().map(|c| *c < run_to_walk::WHOLE).collect();
        stretches(&run).collect()
    }

    /// Shortens the path of the pelvis, and of everything in `others` (one path each) with it, so that objects which
    /// stood still continue to do so.
    ///
    /// A run that turns keeps its length: only along a line is it clear which place lies before which.
    pub(crate) fn shorten_path<'a>(
        &self,
        pelvis: &mut [Vec3],
        others: impl Iterator<Item = &'a mut Vec<Vec3>>,
    ) {
        let mut others: Vec<&mut Vec<Vec3>> = others.collect();
        for (a, b) in self.stretches() {
            let Some(line) = StraightWay::new(&pelvis[a..b], &self.share[a..b]) else {
                continue;
            };
            let paths = others.iter_mut().map(|p| p.as_mut_slice());
            for path in paths.chain([&mut *pelvis]) {
                // A path that has not passed the end of the line by then is moved along until it has.
                let behind = path[b..].iter().position(|p| line.is_passed(*p));
                let until = behind.map_or(path.len(), |k| b + k);
                path[..until].iter_mut().for_each(|p| *p = line.shorter(*p));
            }
        }
    }

    /// Damps the heights of the body, m: a runner flies up from each step and sinks into the knees in the next. Knees
    /// that bend as far in a walk, on one leg alone and for longer, take more strength than the walk itself. The
    /// remaining bounce shrinks with the square of the pace.
    pub(crate) fn damp_bounces(&self, pelvis: &mut [Vec3], rate_hz: f64) {
        let mut middle: Vec<f64> = pelvis.iter().map(|p| p.z).collect();
        low_pass(&mut middle, run_to_walk::BOUNCE_CUTOFF, rate_hz);
        let heights = pelvis.iter_mut().map(|p| &mut p.z);
        for ((z, middle), pace) in heights.zip(middle).zip(&self.pace) {
            *z = middle + (*z - middle) * pace * pace;
        }
    }

    /// Removes every flight from the runs and gives the feet swings between their places.
    ///
    /// * `ankle`, `foot`: left and right, per sample, m and `world_from_foot`; `label`: on the floor, as recorded.
    pub(crate) fn replace_flights(
        &self,
        ankle: &mut [Vec<Vec3>; 2],
        foot: &mut [Vec<Quat>; 2],
        label: &mut [[bool; 2]],
        rate_hz: f64,
    ) {
        let n = label.len();
        for (a, b) in self.stretches() {
            let until = (b + (run_to_walk::LAST_STEP * rate_hz) as usize).min(n);
            let stood = label.to_vec();
            close_flights(label, a..until, rate_hz);
            for s in 0..2 {
                let down: Vec<bool> = label.iter().map(|l| l[s]).collect();
                let phases = runs(&down).into_iter();
                let phases: Vec<_> = phases.filter(|(i, j, _)| *j > a && *i < until).collect();
                let recorded = RecordedFootPath {
                    ankle: ankle[s].clone(),
                    rotation: foot[s].clone(),
                };
                for (i, j, _) in phases.iter().filter(|r| r.2) {
                    // For as long as its stance is extended, the foot keeps the pose of that stance.
                    let on = |k: &usize| stood[*k][s];
                    let (Some(first), Some(last)) = ((*i..*j).find(on), (*i..*j).rfind(on)) else {
                        continue;
                    };
                    for k in (*i..first).chain(last + 1..*j) {
                        let like = if k < first { first } else { last };
                        (ankle[s][k], foot[s][k]) = (ankle[s][like], foot[s][like]);
                    }
                }
                for (i, j, _) in phases.iter().filter(|r| !r.2) {
                    match (*i > 0, *j < n) {
                        (true, true) => swing(&mut ankle[s], &mut foot[s], *i, *j),
                        // The recording begins or ends within this swing: it keeps its path at that end and is bent to
                        // the foot's place at the other end.
                        (false, true) => {
                            bend(&mut ankle[s], &mut foot[s], &recorded, 0, *j, rate_hz)
                        }
                        (true, false) => {
                            bend(&mut ankle[s], &mut foot[s], &recorded, n, *i - 1, rate_hz)
                        }
                        (false, false) => {}
                    }
                }
            }
        }
    }
}

/// Closes flights that begin in `within`: the later foot lands halfway through, and the earlier one leaves a moment
/// later.
fn close_flights(label: &mut [[bool; 2]], within: std::ops::Range<usize>, rate_hz: f64) {
    let n = label.len();
    let none: Vec<bool> = label.iter().map(|l| *l == [false; 2]).collect();
    for (i, j) in stretches(&none) {
        if !within.contains(&i)
            || (j - i) as f64 > run_to_walk::LONGEST_FLIGHT * rate_hz
            || (i, j) == (0, n)
        {
            continue;
        }
        let before = (i > 0).then(|| label[i - 1]);
        let after = (j < n).then(|| label[j]);
        let lands = if i == 0 { 0 } else { (i + j) / 2 };
        let leaves = if j == n {
            n
        } else {
            (lands + (run_to_walk::DOUBLE_SUPPORT * rate_hz) as usize).min(n)
        };
        for s in 0..2 {
            if before.is_some_and(|l| l[s]) {
                label[i..leaves].iter_mut().for_each(|l| l[s] = true);
            }
            if after.is_some_and(|l| l[s]) {
                label[lands..j].iter_mut().for_each(|l| l[s] = true);
            }
        }
    }
}

/// Replaces samples `i..j` by a swing from the foot's old place to its new one.
fn swing(ankle: &mut [Vec3], foot: &mut [Quat], i: usize, j: usize) {
    let (p, q) = ((ankle[i - 1], foot[i - 1]), (ankle[j], foot[j]));
    let turn = (q.1 * p.1.conjugate()).log();
    for k in i..j {
        let u = (k + 1 - i) as f64 / (j + 1 - i) as f64;
        let s = smootherstep(u);
        ankle[k] = p.0 + (q.0 - p.0) * s + Vec3::Z * (run_to_walk::ARC_HEIGHT * arc(1.0, u));
        foot[k] = (Quat::exp(turn * s) * p.1).normalized();
    }
}

/// Path of a foot as recorded, per sample.
struct RecordedFootPath {
    /// Ankle, m.
    ankle: Vec<Vec3>,
    /// `world_from_foot`.
    rotation: Vec<Quat>,
}

/// Bends the recorded path of a foot, unchanged at the sample (or end) `free`, to the place where the foot is planted
/// in sample `stands`. A foot that lands does so where the recording still has it in the air, and comes to rest along
/// the floor within the last [`run_to_walk::REST_TIME`].
fn bend(
    ankle: &mut [Vec3],
    foot: &mut [Quat],
    recorded: &RecordedFootPath,
    free: usize,
    stands: usize,
    rate_hz: f64,
) {
    let off = ankle[stands] - recorded.ankle[stands];
    let turn = (foot[stands] * recorded.rotation[stands].conjugate()).log();
    let (i, j) = (free.min(stands + 1), free.max(stands));
    for k in i..j {
        let u = k.abs_diff(free) as f64 / stands.abs_diff(free) as f64;
        let s = smootherstep(u);
        ankle[k] = recorded.ankle[k] + off * s;
        foot[k] = (Quat::exp(turn * s) * recorded.rotation[k]).normalized();
        if free < stands {
            let left = (stands - k) as f64 / (run_to_walk::REST_TIME * rate_hz);
            let way = ankle[stands] - ankle[k];
            ankle[k] += way.horizontal() * smootherstep(1.0 - left);
        }
    }
}

/// A straight path and how it is shortened; its end stays where it is.
struct StraightWay {
    ahead: Vec3,
    /// Places along it, increasing, and their new places, m.
    places: Vec<f64>,
    shorter: Vec<f64>,
    /// Share of the path at its beginning.
    first: f64,
}

impl StraightWay {
    /// `None` if the path turns back on itself.
    fn new(way: &[Vec3], share: &[f64]) -> Option<Self> {
        let whole = *way.last()? - *way.first()?;
        let ahead = whole.horizontal().normalized_or(Vec3::X);
        let places: Vec<f64> = way.iter().map(|p| p.dot(ahead)).collect();
        if places.len() < 2 || places.windows(2).any(|w| w[1] <= w[0]) {
            return None;
        }
        let mut shorter = places.clone();
        for i in (0..places.len() - 1).rev() {
            shorter[i] = shorter[i + 1] - share[i] * (places[i + 1] - places[i]);
        }
        Some(Self {
            ahead,
            places,
            shorter,
            first: share[0],
        })
    }

    /// Whether a point is beyond the end, where nothing is moved.
    fn is_passed(&self, p: Vec3) -> bool {
        self.places
            .last()
            .is_some_and(|end| p.dot(self.ahead) >= *end)
    }

    fn shorter(&self, p: Vec3) -> Vec3 {
        let x = p.dot(self.ahead);
        let k = self.places.partition_point(|place| *place <= x);
        let to = if k == 0 {
            self.shorter[0] - self.first * (self.places[0] - x)
        } else if k == self.places.len() {
            x
        } else {
            let u = (x - self.places[k - 1]) / (self.places[k] - self.places[k - 1]);
            self.shorter[k - 1] + u * (self.shorter[k] - self.shorter[k - 1])
        };
        p + self.ahead * (to - x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::vec3;

    const RATE: f64 = 120.0;

    /// Three seconds forward at `speed(t)`, m/s.
    fn way(speed: impl Fn(f64) -> f64) -> Vec<Vec3> {
        let mut x = 0.0;
        (0..360)
            .map(|i| {
                x += speed(f64::from(i) / RATE) / RATE;
                vec3(x, 0.0, 1.0)
            })
            .collect()
    }

    /// Feet that are in turns half a metre in front of and behind the middle, one step per 0.35 s.
    fn feet(way: &[Vec3]) -> [Vec<Vec3>; 2] {
        [1.0, -1.0].map(|side| {
            let at = |(i, p): (usize, &Vec3)| {
                let turn = std::f64::consts::PI * i as f64 / RATE / 0.35;
                vec3(p.x + 0.5 * side * turn.cos(), 0.1 * side, 0.0)
            };
            way.iter().enumerate().map(at).collect()
        })
    }

    /// Every stretch that is faster than a walk and, somewhere in it, as fast as a run.
    fn fast(way: &[Vec3]) -> Vec<(usize, usize)> {
        let speed = paces(way, RATE);
        let moves: Vec<bool> = speed
            .iter()
            .map(|v| *v > run_detection::WALK_SPEED)
            .collect();
        let fast = runs(&moves).into_iter().filter(|(i, j, fast)| {
            *fast && speed[*i..*j].iter().any(|v| *v > run_detection::RUN_SPEED)
        });
        fast.map(|(i, j, _)| (i, j)).collect()
    }

    fn slowed(way: &[Vec3]) -> Option<RunToWalk> {
        let [left, right] = feet(way);
        RunToWalk::new(way, [&left, &right], &fast(way), RATE, RATE)
    }

    #[test]
    fn steps_last_from_turn_to_turn_also_where_feet_do_not_pass_each_other() {
        let way = way(|_| 4.0);
        let [left, right] = feet(&way);
        // The other foot is always half a metre farther back.
        let back: Vec<Vec3> = right.iter().map(|p| *p - Vec3::X * 1.2).collect();
        for right in [&right, &back] {
            let step = steps(&way, [&left, right], RATE);
            assert!(
                step.iter().all(|s| (s - 0.35).abs() < 1.5 / RATE),
                "{step:?}"
            );
        }
    }

    #[test]
    fn who_brakes_hard_leans_less_when_slow() {
        // 4.2 m/s, then braking to a stand at 3 m/s² with a body 1 m high: a lean of 0.31 m.
        let speed = |t: f64| 4.2 - 3.0 * (t - 1.0).clamp(0.0, 1.4);
        let recorded = way(speed);
        let slowed = slowed(&recorded).unwrap();
        let at = |t: f64| slowed.times.partition_point(|k| *k < t * RATE);
        let share = slowed.share[at(1.7)];
        assert!(
            (share - run_to_walk::MOST_LEAN / 0.306).abs() < 0.02,
            "{share}"
        );
    }

    #[test]
    fn walks_are_left_alone() {
        for speed in [0.0, 1.2, 2.0] {
            let way = way(|_| speed);
            assert!(slowed(&way).is_none());
            assert!(
                paces(&way, RATE)
                    .iter()
                    .all(|v| *v <= run_detection::RUN_SPEED)
            );
        }
    }

    #[test]
    fn a_run_goes_at_a_walk_and_what_comes_after_it_at_its_own_pace() {
        // 4 m/s, brakes within a second, continues walking.
        let speed = |t: f64| 4.0 - 3.2 * ((t - 1.0) / 1.0).clamp(0.0, 1.0);
        let recorded = way(speed);
        let fastest = paces(&recorded, RATE).into_iter().fold(0.0, f64::max);
        assert!((fastest - 4.0).abs() < 0.05);
        let slowed = slowed(&recorded).unwrap();
        let mut pelvis = slowed.points(&recorded);
        assert_eq!(pelvis.len(), slowed.count());
        // A foot planted on the path stays where it is while the pelvis passes.
        let n = pelvis.len();
        let mut foot = vec![vec3(2.0, 0.1, 0.0); n];
        slowed.shorten_path(&mut pelvis, [&mut foot].into_iter());
        assert!(foot.iter().all(|p| (*p - foot[0]).norm() < 1e-9));
        assert!((*pelvis.last().unwrap() - *recorded.last().unwrap()).norm() < 0.02);
        for (i, v) in speeds(&pelvis, RATE).into_iter().enumerate().skip(10) {
            assert!(v < 1.3, "{v} m/s in sample {i} of {n}");
        }
        let long = slowed.times.iter().filter(|t| **t > 2.2 * RATE).count();
        assert!((long as f64 - 0.8 * RATE).abs() < 3.0, "{long}");
    }

    #[test]
    fn a_run_bounces_less_when_it_is_walked_and_what_is_walked_anyway_as_it_did() {
        // 4 m/s, brakes and continues walking; 5 cm up and down, three times a second.
        let mut recorded = way(|t| 4.0 - 3.0 * ((t - 1.0) / 0.5).clamp(0.0, 1.0));
        for (i, p) in recorded.iter_mut().enumerate() {
            p.z += 0.05 * (6.0 * std::f64::consts::PI * i as f64 / RATE).sin();
        }
        let slowed = slowed(&recorded).unwrap();
        let before = slowed.points(&recorded);
        let mut after = before.clone();
        slowed.damp_bounces(&mut after, RATE);
        let most = |of: &[Vec3], from: f64, to: f64| {
            let within = |k: f64| (from..to).contains(&(k / RATE));
            let at = of.iter().zip(&slowed.times).filter(|(_, k)| within(**k));
            at.map(|(p, _)| (p.z - 1.0).abs()).fold(0.0, f64::max)
        };
        let pace = slowed.pace[(0.4 * RATE) as usize];
        let left = most(&after, 0.2, 0.8) / most(&before, 0.2, 0.8);
        assert!(pace < 0.8 && left < 1.3 * pace * pace, "{left} at {pace}");
        let walks = (before.iter().zip(&after)).zip(&slowed.times);
        for ((a, b), _) in walks.filter(|(_, k)| **k > 2.6 * RATE) {
            assert!((*a - *b).norm() < 1e-4, "{} m of {}", b.z, a.z);
        }
    }

    #[test]
    fn a_foot_that_lands_before_its_recording_does_is_at_rest_there() {
        // The recorded foot continues at 3 m/s where it should be planted, 5 cm beside the path.
        let n = 60;
        let recorded: Vec<Vec3> = (0..=n).map(|i| Vec3::X * (0.025 * f64::from(i))).collect();
        let turns = vec![Quat::exp(Vec3::zero()); recorded.len()];
        let n = n as usize;
        let mut ankle = recorded.clone();
        ankle[n] += Vec3::Y * 0.05;
        let (place, mut foot) = (ankle[n], turns.clone());
        bend(
            &mut ankle,
            &mut foot,
            &RecordedFootPath {
                ankle: recorded.clone(),
                rotation: turns,
            },
            0,
            n,
            RATE,
        );
        assert_eq!(ankle[0], recorded[0]);
        assert!(
            (ankle[20] - recorded[20]).norm() < 0.02,
            "the swing is as it was"
        );
        let steps = ankle.windows(2).map(|w| (w[1] - w[0]).norm());
        assert!(steps.fold(0.0, f64::max) < 0.06, "it does not jump");
        let fast = (place - ankle[n - 1]).norm() * RATE;
        assert!(fast < 0.1, "{fast} m/s");
    }

    #[test]
    fn a_run_has_no_flight_and_its_feet_stand_still_between_clean_swings() {
        let slowed = slowed(&way(|_| 4.0)).unwrap();
        let n = slowed.count();
        // Feet planted for 0.2 s in turn, with flights of 0.2 s, drifting while in the air.
        let period = 0.8;
        let mut label = vec![[false; 2]; n];
        let mut ankle = [vec![Vec3::zero(); n], vec![Vec3::zero(); n]];
        let mut foot = [vec![Quat::identity(); n], vec![Quat::identity(); n]];
        for i in 0..n {
            for s in 0..2 {
                let u = i as f64 / RATE / period + 0.5 * s as f64;
                label[i][s] = u.fract() < 0.25;
                ankle[s][i] = vec3(u.floor() + (u.fract() - 0.25).max(0.0), 0.0, 0.08);
            }
        }
        slowed.replace_flights(&mut ankle, &mut foot, &mut label, RATE);
        assert!(label.iter().all(|l| l[0] || l[1]), "somebody stands");
        assert!(label.iter().any(|l| *l != [true; 2]), "and somebody swings");
        for s in 0..2 {
            // The last swing continues beyond the recording.
            let last = label.iter().rposition(|l| l[s]).unwrap();
            for i in 1..last {
                let moved = (ankle[s][i] - ankle[s][i - 1]).norm();
                if label[i][s] && label[i - 1][s] {
                    assert!(moved < 1e-12, "foot {s} drifts at sample {i}");
                }
                assert!(moved * RATE < 8.0, "foot {s} jumps at sample {i}");
            }
        }
    }
}
