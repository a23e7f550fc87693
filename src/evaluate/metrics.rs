//! Accumulates the measures of a run, tick by tick.

use super::audit::audit;
use super::pose::segment_poses;
use super::report::{MAX_EVENTS, RunEvent, RunReport};
use sinew_physics::body::angles::anatomical_angles;
use sinew_physics::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::body::{Body, DOF_COUNT, Links, Posture, SEGMENT_COUNT, State};
use sinew_physics::figure::{Figure, Flags, TickReport};
use sinew_physics::math::Vec3;
use sinew_physics::motion::TargetPair;
use sinew_physics::strength::{MuscleScale, Strength};

/// A foot contact point carries weight above this force, N.
const CARRIES_N: f64 = 5.0;
/// A DOF counts as saturated at this share of its limit; the solvers land on the limit to 1e-9.
const AT_LIMIT: f64 = 1.0 - 1e-6;

/// Everything one tick shows of a figure.
#[derive(Clone, Copy, Debug)]
pub struct Tick<'a> {
    /// Its body.
    pub body: &'a Body,
    /// Its masses, loads included, during the tick.
    pub links: &'a Links,
    /// Its target.
    pub target: &'a TargetPair,
    /// Its report.
    pub report: &'a TickReport,
    /// Its state after the tick.
    pub state: &'a State,
    /// Its strength, and the factors on it.
    pub strength: (&'a Strength, &'a MuscleScale),
    /// Gravity, m/s², positive downwards.
    pub gravity: f64,
}

impl<'a> Tick<'a> {
    /// The last tick of `figure`, under `gravity`, m/s². Panics before its first tick.
    pub fn of(figure: &'a Figure, gravity: f64) -> Self {
        Self {
            body: figure.body(),
            links: figure.links(),
            target: figure.target(),
            report: figure.report().expect("a stepped figure has a report"),
            state: figure.state(),
            strength: (figure.strength(), figure.muscles()),
            gravity,
        }
    }

    /// Share of the available muscle torque that each DOF uses in the audited substep, from the strength of the body at
    /// that state.
    ///
    /// Limits follow angles and speeds, so mean torques of a tick cannot be compared with limits of one instant.
    pub fn utilisation(&self) -> [f64; DOF_COUNT] {
        let sample = &self.report.audit;
        let angles = anatomical_angles(&sample.state.posture);
        let rates = std::array::from_fn(|d| sample.state.velocity[6 + d]);
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        let (strength, scale) = self.strength;
        strength.range(&angles, &rates, scale, &mut lower, &mut upper);
        std::array::from_fn(|d| {
            let torque = sample.torque[d];
            let limit = if torque < 0.0 { lower[d] } else { upper[d] };
            if torque == 0.0 { 0.0 } else { torque / limit }
        })
    }
}

/// A run being measured.
#[derive(Clone, Debug)]
pub struct Metrics {
    rate_hz: f64,
    ticks: u64,
    tracked_ticks: u64,
    fell_at_s: Option<f64>,
    quarantined_at_s: Option<f64>,
    non_finite_ticks: u64,
    square_error: [f64; DOF_COUNT],
    largest_error: f64,
    root_distance: f64,
    global_distance: f64,
    utilisation: [f64; DOF_COUNT],
    over_limit: f64,
    saturated_ticks: [u64; DOF_COUNT],
    residual: f64,
    root_force: f64,
    root_moment: f64,
    slip_speed: f64,
    slip_samples: u64,
    penetration: f64,
    assist: [f64; 2],
    assist_sum: f64,
    root_error: f64,
    remaining: f64,
    margin: Option<f64>,
    before: Posture,
    events: Vec<RunEvent>,
    events_dropped: u64,
    tick_us: Vec<f32>,
}

impl Metrics {
    /// Starts measuring a figure that stands in `start`; `rate_hz` ticks per second.
    pub fn new(rate_hz: f64, start: &Posture) -> Self {
        Self {
            rate_hz,
            ticks: 0,
            tracked_ticks: 0,
            fell_at_s: None,
            quarantined_at_s: None,
            non_finite_ticks: 0,
            square_error: [0.0; DOF_COUNT],
            largest_error: 0.0,
            root_distance: 0.0,
            global_distance: 0.0,
            utilisation: [0.0; DOF_COUNT],
            over_limit: 0.0,
            saturated_ticks: [0; DOF_COUNT],
            residual: 0.0,
            root_force: 0.0,
            root_moment: 0.0,
            slip_speed: 0.0,
            slip_samples: 0,
            penetration: 0.0,
            assist: [0.0; 2],
            assist_sum: 0.0,
            root_error: 0.0,
            remaining: 1.0,
            margin: None,
            before: *start,
            events: Vec::new(),
            events_dropped: 0,
            tick_us: Vec::new(),
        }
    }

    /// Time after all ticks observed until now, s.
    pub fn time_s(&self) -> f64 {
        self.ticks as f64 / self.rate_hz
    }

    /// Time at which the figure fell, s.
    pub fn fell_at_s(&self) -> Option<f64> {
        self.fell_at_s
    }

    /// Takes in one tick. `us`: its duration, µs (measured by the caller, which owns the clock).
    pub fn observe(&mut self, tick: Tick<'_>, us: f64) {
        self.ticks += 1;
        self.tick_us.push(us as f32);
        if !is_finite(&tick) {
            self.non_finite_ticks += 1;
            self.before = tick.state.posture;
            return;
        }
        let report = tick.report;
        if report.flags.has(Flags::QUARANTINED) {
            // A frozen figure repeats its last report.
            self.quarantined_at_s
                .get_or_insert(self.ticks as f64 / self.rate_hz);
            return;
        }
        self.observe_torques(&tick);
        self.penetration = self.penetration.max(report.penetration);
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (moment, force) = report.assist.split_at(3);
        self.assist[0] = self.assist[0].max(size(moment));
        self.assist[1] = self.assist[1].max(size(force));
        self.assist_sum += size(force);
        let left = report.joints.remaining.iter().flatten();
        self.remaining = left.fold(self.remaining, |m, r| m.min(*r));
        let found = audit(tick.links, &report.audit, tick.gravity);
        self.residual = self.residual.max(found.relative);
        self.root_force = self.root_force.max(found.root_force);
        self.root_moment = self.root_moment.max(found.root_moment);
        if self.fell_at_s.is_none() {
            self.observe_tracking(&tick);
        }
        if report.flags.has(Flags::FALLEN) {
            self.fell_at_s
                .get_or_insert(self.ticks as f64 / self.rate_hz);
        }
        self.before = tick.state.posture;
    }

    /// Notes an event of the tick observed last, regardless of the event's own time.
    pub fn event(&mut self, what: RunEvent) {
        if self.events.len() < MAX_EVENTS {
            let time_s = self.time_s();
            self.events.push(RunEvent { time_s, ..what });
        } else {
            self.events_dropped += 1;
        }
    }

    fn observe_torques(&mut self, tick: &Tick<'_>) {
        for (d, used) in tick.utilisation().into_iter().enumerate() {
            self.utilisation[d] = self.utilisation[d].max(used);
            // The solver's value covers all substeps, ours one of them, independently.
            self.over_limit = self
                .over_limit
                .max(used - 1.0)
                .max(tick.report.joints.over_limit);
            if used >= AT_LIMIT || tick.report.joints.saturated >> d & 1 == 1 {
                self.saturated_ticks[d] += 1;
            }
        }
    }

    fn observe_tracking(&mut self, tick: &Tick<'_>) {
        self.tracked_ticks += 1;
        for (sum, e) in self
            .square_error
            .iter_mut()
            .zip(&tick.report.joints.joint_error)
        {
            *sum += e * e;
            self.largest_error = self.largest_error.max(e.abs());
        }
        let actual = segment_poses(&tick.links.offset, &tick.state.posture);
        let desired = segment_poses(&tick.links.offset, &tick.target.next.posture);
        let shift = desired[0].position - actual[0].position;
        self.root_error = self.root_error.max(shift.norm());
        for s in 0..SEGMENT_COUNT {
            let off = desired[s].position - actual[s].position;
            self.global_distance += off.norm() / SEGMENT_COUNT as f64;
            self.root_distance += (off - shift).norm() / SEGMENT_COUNT as f64;
        }
        if let Some(margin) = tick.report.balance.margin {
            self.margin = Some(self.margin.map_or(margin, |m| m.min(margin)));
        }
        let before = segment_poses(&tick.links.offset, &self.before);
        for c in &tick.report.contacts {
            let is_foot = [L_FOOT, L_TOES, R_FOOT, R_TOES].contains(&c.segment);
            if is_foot && c.force.norm() > CARRIES_N {
                let s = c.segment.index();
                let Some(point) = tick.body.segments[s].contact_points.get(c.vertex) else {
                    continue;
                };
                let moved: Vec3 = actual[s].point(*point) - before[s].point(*point);
                self.slip_speed += moved.x.hypot(moved.y) * self.rate_hz;
                self.slip_samples += 1;
            }
        }
    }

    /// The measures of the run; `state_hash`: of the world after the last tick.
    pub fn finish(self, state_hash: u64) -> RunReport {
        let tracked = self.tracked_ticks.max(1) as f64;
        let rms = |sum: f64, n: f64| (sum / n).sqrt().to_degrees();
        let mut times = self.tick_us;
        times.sort_by(f32::total_cmp);
        RunReport {
            rate_hz: self.rate_hz,
            ticks: self.ticks,
            fell_at_s: self.fell_at_s,
            tracking_joint_rms_deg: rms(self.square_error.iter().sum(), tracked * DOF_COUNT as f64),
            tracking_joint_max_deg: self.largest_error.to_degrees(),
            tracking_mpjpe_root_mm: 1e3 * self.root_distance / tracked,
            tracking_mpjpe_global_mm: 1e3 * self.global_distance / tracked,
            max_utilisation: self.utilisation.iter().copied().fold(0.0, f64::max),
            over_limit_max: self.over_limit,
            saturated_s: self.saturated_ticks.map(|n| n as f64 / self.rate_hz),
            dynamics_residual_max: self.residual,
            root_wrench_unexplained_max_n: self.root_force,
            root_wrench_unexplained_max_nm: self.root_moment,
            assist_max_n: self.assist[1],
            assist_max_nm: self.assist[0],
            assist_mean_n: self.assist_sum / self.ticks.max(1) as f64,
            tracking_root_max_mm: 1e3 * self.root_error,
            remaining_strength_min: self.remaining,
            foot_slip_mm_per_s: 1e3 * self.slip_speed / self.slip_samples.max(1) as f64,
            penetration_max_mm: 1e3 * self.penetration,
            margin_min_m: self.margin,
            state_hash: format!("{state_hash:016x}"),
            us_per_tick_p50: percentile(&times, 0.5),
            us_per_tick_p99: percentile(&times, 0.99),
            non_finite_ticks: self.non_finite_ticks,
            quarantined_at_s: self.quarantined_at_s,
            utilisation_max: self.utilisation,
            tracking_joint_rms_by_dof_deg: self.square_error.map(|sum| rms(sum, tracked)),
            events: self.events,
            events_dropped: self.events_dropped,
        }
    }
}

/// Nearest-rank percentile of ascending values; 0 for none.
fn percentile(sorted: &[f32], share: f64) -> f64 {
    if sorted.is_empty() {
        return 0.0;
    }
    let rank = (share * sorted.len() as f64).ceil() as usize;
    f64::from(sorted[rank.clamp(1, sorted.len()) - 1])
}

/// Whether nothing that enters the measures is NaN or infinite.
fn is_finite(tick: &Tick<'_>) -> bool {
    let r = tick.report;
    let a = &r.audit;
    let all = |v: &[f64]| v.iter().all(|x| x.is_finite());
    tick.state.is_finite()
        && a.state.is_finite()
        && tick.target.next.posture.is_finite()
        && [
            &r.joints.torque,
            &r.joints.ligament_torque,
            &r.joints.torque_lower,
            &r.joints.torque_upper,
            &r.joints.joint_error,
            &a.torque,
            &a.ligament_torque,
        ]
        .iter()
        .all(|v| all(*v))
        && all(&r.acceleration)
        && all(&a.acceleration)
        && all(&r.assist)
        && all(&a.assist)
        && all(&[
            r.joints.over_limit,
            r.penetration,
            r.balance.margin.unwrap_or(0.0),
        ])
        && r.contacts
            .iter()
            .chain(&a.contacts)
            .all(|c| c.position.is_finite() && c.force.is_finite())
        && a.applied
            .iter()
            .all(|(_, p, f)| p.is_finite() && f.is_finite())
}

#[cfg(test)]
mod tests;
