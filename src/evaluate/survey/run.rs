//! One clip through the physics, measured against motions that are fixed in the world.

use super::contacts::{match_touch_downs, precision_recall, settled};
use super::errors::{PlacedPosture, TrackedTick, errors, jerk_ratio};
use super::outcome::SurveyOutcome;
use super::stats::median;
use super::verdict::{anchor_lost, farthest, phc_lost};
use crate::experiments::walk::FootSliding;
use crate::metrics::{Metrics, Tick};
use sinew_physics::body::Body;
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES, L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::dynamics::{Kinematics, momentum};
use sinew_physics::figure::Flags;
use sinew_physics::math::Vec3;
use sinew_physics::math::rounding::short;
use sinew_physics::motion::leg_ik::{center_of_mass, forward};
use sinew_physics::motion::{Clip, GRAVITY};
use sinew_physics::rehearsal::trial::{Conditions, Judge, TrackingReference, Trial, TrialResult};
use sinew_physics::world::{Figure, WorldError};

/// A foot is on the floor while the floor pushes it with more than this, N.
const STANDS: f64 = 20.0;
const FEET: [[sinew_physics::body::SegmentId; 2]; 2] = [[L_FOOT, L_TOES], [R_FOOT, R_TOES]];

/// Largest mean distance of the prepared motion from the recording, m, at 30 samples a second.
pub fn prepared_off(reference: &TrackingReference, body: &Body) -> f64 {
    let n = (reference.recorded.duration() * 30.0) as usize;
    (0..=n)
        .map(|i| {
            let t = i as f64 / 30.0;
            let at = |clip: &Clip| PlacedPosture::new(body, &clip.sample(t).posture);
            at(&reference.prepared).distance(&at(&reference.recorded))
        })
        .fold(0.0, f64::max)
}

/// Measures that accumulate over a run.
#[derive(Default)]
struct Course {
    judge: Judge,
    samples: Vec<TrackedTick>,
    stances: [FootSliding; 2],
    /// Distance slid in the present stance, m, and in the stances that have ended.
    way: [f64; 2],
    ways: Vec<f64>,
    target: TargetCourse,
    peak: f64,
    impulse: f64,
    limit_ticks: usize,
    fell: bool,
    frozen: bool,
}

/// How steadily the desired centre of mass moves, until balance is lost.
#[derive(Default)]
struct TargetCourse {
    /// The last two places, of the target and in the recording, m.
    before: Option<[Vec3; 2]>,
    earlier: Option<[Vec3; 2]>,
    lost: bool,
    /// Largest change of velocity from one tick to the next beyond the recording's, m/s.
    jump: Option<f64>,
}

impl TargetCourse {
    fn observe(&mut self, target: Vec3, recorded: Vec3, lost: bool, dt: f64) {
        self.lost |= lost;
        if self.lost {
            return;
        }
        let now = [target, recorded];
        if let (Some(a), Some(b)) = (self.earlier, self.before) {
            let change = |k: usize| ((now[k] - b[k]) - (b[k] - a[k])).norm() / dt;
            let beyond = (change(0) - change(1)).max(0.0);
            self.jump = Some(self.jump.map_or(beyond, |most| most.max(beyond)));
        }
        (self.earlier, self.before) = (self.before, Some(now));
    }
}

/// Runs the clip from its beginning to a little after its end, and measures.
///
/// # Errors
/// Conditions that no world or figure accepts.
pub fn run(
    conditions: &Conditions,
    reference: &TrackingReference,
) -> Result<SurveyOutcome, WorldError> {
    watched(conditions, reference, |_, _| ())
}

/// As [`run`]; `watch` sees the figure after each tick, with the time on the clip's clock, s.
///
/// # Errors
/// As [`run`].
pub fn watched(
    conditions: &Conditions,
    reference: &TrackingReference,
    mut watch: impl FnMut(&Figure, f64),
) -> Result<SurveyOutcome, WorldError> {
    let mut trial = Trial::new(conditions, reference)?;
    let world = &conditions.world;
    let mut metrics = Metrics::new(world.rate_hz, &trial.figure().state().posture);
    let mut course = Course::default();
    let (mass, before) = vertical(trial.figure());
    while let Some(time) = trial.step() {
        let figure = trial.figure();
        metrics.observe(Tick::of(figure, world.gravity), 0.0);
        course.observe(figure, reference, time, trial.world().dt());
        watch(figure, time);
    }
    let (figure, world) = (trial.figure(), trial.world());
    let report = metrics.finish(world.state_hash());
    let time = world.time().0;
    let mut out = course.outcome(course.judge.result(&trial), reference, world.dt());
    let (mass_after, after) = vertical(figure);
    let weight = mass_after * GRAVITY;
    let steady = !course.frozen && mass == mass_after;
    out.impulse_balance =
        steady.then(|| short((course.impulse - (after - before)) / (weight * time) - 1.0));
    out.penetration_mm = short(report.penetration_max_mm);
    if let Some((dof, s)) = (0..DOF_COUNT)
        .map(|d| (d, report.saturated_s[d]))
        .filter(|(_, s)| *s > 0.0)
        .reduce(|a, b| if b.1 > a.1 { b } else { a })
    {
        out.limit_dof = DOF_NAMES[dof].to_owned();
        out.limit_dof_s = short(s);
    }
    Ok(out)
}

/// Mass, kg, and vertical momentum, kg·m/s.
fn vertical(figure: &Figure) -> (f64, f64) {
    let mut kin = Kinematics::default();
    kin.set_state(figure.links(), figure.state());
    let (mass, sum) = (figure.links().total_mass(), momentum(figure.links(), &kin));
    (mass, sum.linear.z)
}

impl Course {
    /// Takes in a tick of `dt` s that ended at `time` on the clip's clock.
    fn observe(&mut self, figure: &Figure, reference: &TrackingReference, time: f64, dt: f64) {
        let report = figure.report().expect("a stepped figure has a report");
        self.judge.observe(figure, reference, time, dt);
        if report.flags.has(Flags::QUARANTINED) {
            self.frozen = true;
            return;
        }
        let weight = figure.links().total_mass() * GRAVITY;
        let floor: f64 = report.contacts.iter().map(|c| c.force.z).sum();
        self.impulse += (floor + report.assist[5]) * dt;
        self.limit_ticks += usize::from(report.joints.saturated != 0);
        self.fell |= figure.is_fallen();
        let lost = self.fell || report.flags.has(Flags::BALANCE_LOST);
        let body = figure.body();
        let recorded = forward(body, &reference.recorded.sample(time).posture);
        let recorded = center_of_mass(body, &recorded);
        self.target
            .observe(report.balance.com_desired, recorded, lost, dt);
        let end = (reference.recorded.duration()).max(reference.prepared.duration());
        let within = time > -1e-9 && time < end + 1e-9;
        if !self.fell {
            self.peak = self.peak.max(floor / weight);
            for (k, segments) in FEET.into_iter().enumerate() {
                let way = self.stances[k].observe(&report.contacts, segments);
                if self.stances[k].load() < STANDS {
                    if self.way[k] > 0.0 {
                        self.ways.push(self.way[k]);
                    }
                    self.way[k] = 0.0;
                } else {
                    self.way[k] = way;
                }
            }
        }
        if within {
            let body = figure.body();
            let at = |clip: &Clip| PlacedPosture::new(body, &clip.sample(time).posture);
            let down = FEET.map(|f| {
                let mine = report.contacts.iter().filter(|c| f.contains(&c.segment));
                mine.map(|c| c.force.z).sum::<f64>() > STANDS
            });
            self.samples.push(TrackedTick {
                time,
                actual: PlacedPosture::new(body, &figure.state().posture),
                recorded: at(&reference.recorded),
                prepared: at(&reference.prepared),
                down,
                labelled: reference.labelled(time),
            });
        }
    }

    fn outcome(&self, trial: TrialResult, reference: &TrackingReference, dt: f64) -> SurveyOutcome {
        // A motion whose runs are walked lasts longer than its recording.
        let until = |t: f64| self.samples.partition_point(|s| s.time < t + 1e-9);
        let recorded = &self.samples[..until(reference.recorded.duration())];
        let whole = &self.samples[..until(reference.prepared.duration())];
        let samples = &recorded[..trial.measured_ticks];
        let feet = |of: &dyn Fn(&TrackedTick) -> [bool; 2]| -> [Vec<bool>; 2] {
            [0, 1].map(|k| {
                let all: Vec<bool> = samples.iter().map(|s| of(s)[k]).collect();
                settled(&all, dt)
            })
        };
        let (down, label) = (feet(&|s| s.down), feet(&|s| s.labelled));
        let (contact_precision, contact_recall) = precision_recall(&down, &label);
        let mut ways: Vec<f64> = self.ways.iter().map(|w| 1e3 * w).collect();
        ways.extend(self.way.iter().filter(|w| **w > 0.0).map(|w| 1e3 * w));
        SurveyOutcome {
            completed: trial.completed,
            lost_at_s: trial.lost_at,
            farthest_m: Some(short(farthest(recorded, |s| &s.recorded))),
            anchor_lost_at_s: anchor_lost(recorded).map(short),
            prepared_lost_at_s: phc_lost(whole, |s| &s.prepared).map(short),
            fell_at_s: trial.fell_at,
            down_after: trial.down_after,
            frozen_at_s: trial.frozen_at,
            followed_s: trial.followed,
            recorded: errors(samples, |s| &s.recorded),
            prepared: errors(samples, |s| &s.prepared),
            touch_downs: match_touch_downs(&down, &label, dt),
            contact_precision,
            contact_recall,
            stances: ways.len(),
            skate_median_mm: median(&ways).map(short),
            skate_worst_mm: ways.iter().copied().reduce(f64::max).map(short),
            target_jump_m_s: self.target.jump.map(short),
            peak_force_weights: short(self.peak),
            jerk_ratio: jerk_ratio(samples),
            assist_share: trial.help.share,
            assist_recorded_share: trial.help.share_within,
            assist_max_n: trial.help.most,
            assist_max_nm: trial.help.most_moment,
            assist_change: trial.help.change,
            limit_s: short(self.limit_ticks as f64 * dt),
            ..SurveyOutcome::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_that_jumps_once_is_told_and_one_that_moves_as_recorded_is_not() {
        let dt = 1.0 / 60.0;
        let recorded = |i: usize| Vec3::X * (0.5 * (i as f64 * dt).powi(2));
        let mut steady = TargetCourse::default();
        let mut jumps = TargetCourse::default();
        let mut lost = TargetCourse::default();
        for i in 0..60 {
            let off = if i < 30 { Vec3::zero() } else { Vec3::Y * 0.05 };
            steady.observe(recorded(i) + Vec3::Z, recorded(i), false, dt);
            jumps.observe(recorded(i) + off, recorded(i), false, dt);
            lost.observe(recorded(i) + off, recorded(i), i > 20, dt);
        }
        assert!(steady.jump.is_some_and(|j| j < 1e-9));
        assert!(
            jumps.jump.is_some_and(|j| (j - 0.05 / dt).abs() < 0.1),
            "{:?}",
            jumps.jump
        );
        assert!(lost.jump.is_some_and(|j| j < 1e-9));
    }
}
