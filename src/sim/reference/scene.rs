//! The recording as a scene: metres, z up, even samples, smooth.

use super::error::RetargetError;
use super::options::RetargetOptions;
use super::run_detection::{FastStretch, Gait, RecordedPoints, fast_stretches};
use super::run_to_walk::RunToWalk;
use super::sampling::{check_samples, output_rate, sample_count};
use super::take::{Take, WorldPaths};
use crate::math::{Mat3, Quat, Vec3};
use crate::motion::filter::{
    low_pass_points, low_pass_rotations, resample_points, resample_rotations,
};
use crate::motion::recording::UpAxis;
use crate::motion::skeleton_map::SkeletonMap;
use crate::reference::params::run_detection;

/// Per sample: smoothed world positions and rotations, metres, z up.
pub(super) struct RecordedScene<'a> {
    pub take: &'a Take<'a>,
    pub places: Vec<Vec<Vec3>>,
    pub turns: Vec<Vec<Quat>>,
    pub rest: Vec<Vec3>,
    pub basis: Quat,
    pub count: usize,
    pub rate: f64,
}

/// A recording in its own units and axes, `[bone][frame]`.
pub(super) struct RecordedPaths {
    /// World positions and rotations.
    pub world: WorldPaths,
    /// Positions in the file's zero pose.
    pub rest: Vec<Vec3>,
    /// Axis that points up.
    pub up: UpAxis,
    /// Metres per unit.
    pub unit_m: f64,
    /// Frames per second.
    pub source_rate: f64,
}

/// Findings of [`RecordedScene::new`].
pub(super) struct SceneFindings {
    /// Points of either foot (ankle, toe joint, tip) before they were smoothed, `[side][point][sample]`.
    pub feet: [Vec<Vec<Vec3>>; 2],
    /// Root mean square distance by which smoothing moved the points, m.
    pub smoothing_rms: f64,
    /// Stretches that are faster than people walk, in samples of the recording, and how its runs are slowed down if
    /// they are to be walked.
    pub fast: Vec<FastStretch>,
    pub slowed: Option<RunToWalk>,
    /// How many times longer than the recording the motion is as a result.
    pub slower: f64,
}

impl SceneFindings {
    fn runs(&self) -> impl Iterator<Item = &FastStretch> {
        self.fast.iter().filter(|s| s.gait == Gait::Run)
    }

    /// Speed of the fastest run, m/s, if there is one.
    pub(super) fn fastest_run(&self) -> Option<f64> {
        self.runs().map(|s| s.speed).reduce(f64::max)
    }

    /// A message for the user about each fast stretch. `rate_hz`: of the recording.
    pub(super) fn notes(&self, rate_hz: f64) -> Vec<String> {
        let note = |s: &FastStretch| {
            if s.gait != Gait::Run {
                return s.why_not_a_run(rate_hz);
            }
            let what = format!(
                "from {:.2} s to {:.2} s a run of {:.1} m/s ({} changes of the leading foot, {} flights)",
                s.samples.0 as f64 / rate_hz,
                s.samples.1 as f64 / rate_hz,
                s.speed,
                s.steps,
                s.flights
            );
            if self.slowed.is_some() {
                let slower = self.slower;
                format!(
                    "{what} is walked: slower, with shorter steps; the clip is {slower:.1} times as long as recorded"
                )
            } else {
                format!("{what} takes more strength than people's joints are measured to have")
            }
        };
        self.fast.iter().map(note).collect()
    }
}

impl<'a> RecordedScene<'a> {
    /// World positions and rotations of `take` and its rest pose, file units and axes, in metres with z up, at the
    /// output rate, smooth.
    pub(super) fn new(
        take: &'a Take<'a>,
        map: &SkeletonMap,
        recorded: RecordedPaths,
        options: &RetargetOptions,
    ) -> Result<(Self, SceneFindings), RetargetError> {
        let RecordedPaths {
            world,
            rest,
            up,
            unit_m,
            source_rate,
        } = recorded;
        let WorldPaths {
            mut places,
            mut turns,
        } = world;
        for p in &mut places {
            for v in p.iter_mut() {
                *v = z_up(up, *v * unit_m);
            }
        }
        let basis = Quat::from_mat3(&Mat3 {
            x: z_up(up, Vec3::X),
            y: z_up(up, Vec3::Y),
            z: z_up(up, Vec3::Z),
        });
        for t in &mut turns {
            for q in t.iter_mut() {
                *q = basis * *q;
            }
        }
        let rest: Vec<Vec3> = rest.into_iter().map(|v| z_up(up, v * unit_m)).collect();
        let rate = output_rate(source_rate, options);
        let count = sample_count(places[0].len(), source_rate, rate);
        let way = middle(&places);
        let feet = [0, 1].map(|s: usize| places[take.at(map.sides[s].foot)].as_slice());
        let between = |pair: [usize; 2]| {
            let [a, b] = pair.map(|j| &places[take.at(j)]);
            let middle = a.iter().zip(b).map(|(a, b)| (*a + *b) * 0.5);
            middle.collect::<Vec<_>>()
        };
        let [l, r] = &map.sides;
        let trunk = [
            between([l.thigh, r.thigh]),
            between([l.upper_arm, r.upper_arm]),
        ];
        let figure = RecordedPoints {
            middle: &way,
            feet,
            trunk: [&trunk[0], &trunk[1]],
        };
        let fast = fast_stretches(&figure, source_rate);
        let runs: Vec<(usize, usize)> = fast
            .iter()
            .filter(|s| s.gait == Gait::Run)
            .map(|s| s.samples)
            .collect();
        let slowed = (options.preparation.walk_runs)
            .then(|| RunToWalk::new(&way, feet, &runs, source_rate, rate))
            .flatten();
        let slower = slowed.as_ref().map_or(1.0, |s| s.stretch(count as f64));
        let count = slowed.as_ref().map_or(count, RunToWalk::count);
        check_samples(count)?; // a run that is walked takes longer
        let mapped = take.is_mapped(map);
        let mut smoothing = (0.0, 0usize);
        let cutoff_hz = if !runs.is_empty() && slowed.is_none() {
            options.cutoff_hz.max(run_detection::RUN_CUTOFF)
        } else {
            options.cutoff_hz
        };
        let same = (rate - source_rate).abs() < 1e-9;
        let mut feet: [Vec<Vec<Vec3>>; 2] = Default::default();
        for (k, path) in places.iter_mut().enumerate() {
            if let Some(slowed) = &slowed {
                *path = slowed.points(path);
            } else if !same {
                *path = resample_points(path, source_rate, rate, count);
            }
            for (points, side) in feet.iter_mut().zip(&map.sides) {
                let tip = take.tip(side.toes.unwrap_or(side.foot));
                if [Some(side.foot), side.toes, tip].contains(&Some(take.point(k))) {
                    points.push(path.clone());
                }
            }
            let before = path.clone();
            low_pass_points(path, cutoff_hz, rate);
            for (a, b) in before.iter().zip(path.iter()) {
                smoothing.0 += (*a - *b).dot(*a - *b);
                smoothing.1 += 1;
            }
            if !mapped[k] {
                *path = Vec::new();
            }
        }
        for (path, mapped) in turns.iter_mut().zip(&mapped) {
            if !mapped {
                *path = Vec::new();
                continue;
            }
            if let Some(slowed) = &slowed {
                *path = slowed.rotations(path);
            } else if !same {
                *path = resample_rotations(path, source_rate, rate, count);
            }
            low_pass_rotations(path, cutoff_hz, rate);
        }
        let scene = Self {
            take,
            places,
            turns,
            rest,
            basis,
            count,
            rate,
        };
        let smoothing_rms = (smoothing.0 / smoothing.1.max(1) as f64).sqrt();
        let findings = SceneFindings {
            feet,
            smoothing_rms,
            fast,
            slowed,
            slower,
        };
        Ok((scene, findings))
    }
}

/// The middle of all joints, per sample.
fn middle(places: &[Vec<Vec3>]) -> Vec<Vec3> {
    let share = 1.0 / places.len().max(1) as f64;
    let at = |i: usize| places.iter().fold(Vec3::zero(), |m, p| m + p[i] * share);
    (0..places.first().map_or(0, Vec::len)).map(at).collect()
}

fn z_up(up: UpAxis, v: Vec3) -> Vec3 {
    match up {
        UpAxis::Y => Vec3 {
            x: v.z,
            y: v.x,
            z: v.y,
        },
        UpAxis::Z => v,
    }
}

impl RecordedScene<'_> {
    pub(super) fn place(&self, joint: usize) -> &[Vec3] {
        &self.places[self.take.at(joint)]
    }
    pub(super) fn turn(&self, joint: usize) -> &[Quat] {
        &self.turns[self.take.at(joint)]
    }

    /// Direction in which the feet of a sample point, made level in the figure; zero if the file has no toes.
    pub(super) fn toe_direction(&self, map: &SkeletonMap, s: usize, i: usize) -> Vec3 {
        let side = &map.sides[s];
        self.take.toe(side).map_or(Vec3::zero(), |t| {
            self.place(t)[i] - self.place(side.foot)[i]
        })
    }

    /// Exchanges sides that the file names the wrong way round, decided by where feet point and knees bend.
    pub(super) fn settle_sides(&mut self, map: &mut SkeletonMap) -> bool {
        let mut vote = 0.0;
        let mut arms = 0.0;
        for i in 0..self.count {
            let p = |j: usize| self.place(j)[i];
            let [l, r] = map.sides;
            let hips = (p(l.thigh) + p(r.thigh)) * 0.5;
            let up = ((p(l.upper_arm) + p(r.upper_arm)) * 0.5 - hips).normalized_or(Vec3::Z);
            let left = (p(l.thigh) - p(r.thigh)).normalized_or(Vec3::Y);
            let forward = left.cross(up);
            arms += (p(l.upper_arm) - p(r.upper_arm)).dot(left).signum();
            for (s, side) in map.sides.iter().enumerate() {
                let thigh = (p(side.shank) - p(side.thigh)).normalized_or(Vec3::zero());
                let shank = (p(side.foot) - p(side.shank)).normalized_or(Vec3::zero());
                // A bent knee turns about an axis towards the left.
                vote += thigh.cross(shank).dot(left);
                vote += self
                    .toe_direction(map, s, i)
                    .normalized_or(Vec3::zero())
                    .dot(forward);
            }
        }
        if arms < 0.0 {
            let [l, r] = map.sides;
            for (s, other) in [(0, r), (1, l)] {
                map.sides[s].upper_arm = other.upper_arm;
                map.sides[s].forearm = other.forearm;
                map.sides[s].hand = other.hand;
            }
        }
        if vote < 0.0 {
            map.sides.swap(0, 1);
            return !map.by_structure;
        }
        arms < 0.0 && !map.by_structure
    }
}
