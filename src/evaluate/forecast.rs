//! How hard a motion is for a body, told before anything is simulated, and what will come of it.
//!
//! Inverse dynamics of the prepared motion: at each sample the floor pushes at the points that touch it, within friction, so that the needed
//! wrench is met as well as can be and the joints are loaded as evenly as can be. What is left of the wrench the floor lacks; the torques are
//! compared with the strength of the body at those angles and speeds. [`Limits`] turns both into a verdict with its reason.

use super::survey::stats::short;
use crate::sim::body::angles::anatomical_angles;
use crate::sim::body::topology::{
    DOF_LEN, DOF_NAMES, DOF_SEGMENT, DOF_START, L_FOOT, L_TOES, PARENT, R_FOOT, R_TOES,
};
use crate::sim::body::{Body, DOF_COUNT, Links, SEGMENT_COUNT, SegmentId};
use crate::sim::dynamics::{Kinematics, RneaWorkspace, center_of_mass, rnea};
use crate::sim::figure::StrengthScale;
use crate::sim::math::Vec3;
use crate::sim::math::nnls::nnls;
use crate::sim::motion::{Clip, Target};
use crate::sim::strength::{MuscleScale, Strength};

/// Samples per second that are looked at: motion is below 6 Hz.
const RATE: f64 = 30.0;
/// Gravity that motions are prepared for, m/s².
const GRAVITY: f64 = 9.81;
/// Friction that the floor is believed to have: what the modern controller counts on, on the default floor.
const FRICTION: f64 = 0.8;
/// Edges of the pyramid that stands for a friction cone.
const EDGES: usize = 8;
/// A point touches below this height, m, if it is slower than [`SLOW`]: the error of a retargeted contact.
const TOUCH: f64 = 0.03;
/// See [`TOUCH`], m/s.
const SLOW: f64 = 0.6;
/// Points of a foot that the motion plants touch within this height over its lowest one, m: a raised heel does not.
const SOLE: f64 = 0.02;
/// Weight of a joint at its limit against one body weight of force that is missing: even torques matter only where forces are not determined.
const EVEN: f64 = 0.01;
/// Keeps the least squares solvable; forces are in weights.
const RIDGE: f64 = 1e-8;
/// Torques and forces are means over this time, s: shorter peaks come from differentiation, and a body bridges them.
const MEAN: f64 = 0.1;
/// Time over which a missing force moves the capture point, s: what comes later can still be caught by a step.
const STEP: f64 = 0.5;
/// Upright part of the pelvis's vertical axis below which it is upside down.
const INVERTED: f64 = -0.3;
/// Rows: force, moment about the centre of mass, joint torques.
const ROWS: usize = 6 + DOF_COUNT;
/// Longest part of a clip that is looked at, s, so that the cost of a long recording stays bounded by that of its preparation.
const LONGEST: f64 = 900.0;

/// How hard a motion is. Forces in body weights, moments in weight × metre, torques over the strength at that instant, times on the clip's clock.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "net", derive(serde::Serialize, serde::Deserialize))]
pub struct Difficulty {
    /// Force that the floor lacks, root mean square over the clip, weights.
    pub lacking_force_rms: f64,
    /// Largest mean of it over 0.1 s, weights.
    pub lacking_force_peak: f64,
    /// Time of that peak, s.
    pub lacking_force_at_s: f64,
    /// Moment about the centre of mass that the floor lacks, root mean square, weight × m.
    pub lacking_moment_rms: f64,
    /// Largest mean of it over 0.1 s, weight × m.
    pub lacking_moment_peak: f64,
    /// Time of that peak, s.
    pub lacking_moment_at_s: f64,
    /// Farthest that what is lacking drives the capture point within 0.5 s, m.
    pub drift_m: f64,
    /// End of that half second, s.
    pub drift_at_s: f64,
    /// Largest vertical speed that what is lacking makes within 0.5 s, m/s.
    pub sink_mps: f64,
    /// End of that half second, s.
    pub sink_at_s: f64,
    /// Largest mean torque over 0.1 s, over the strength there.
    pub torque_peak: f64,
    /// DOF of that torque; empty if none is needed.
    pub torque_peak_dof: String,
    /// Time of that torque, s.
    pub torque_peak_at_s: f64,
    /// Largest 95th percentile of any DOF's torque over its strength.
    pub torque_p95: f64,
    /// Its DOF; empty if none is needed.
    pub torque_p95_dof: String,
    /// Share of the clip in which some DOF needs more than its strength.
    pub overload_share: f64,
    /// Time with nothing on the floor, s.
    pub flight_s: f64,
    /// Longest of those times, s.
    pub longest_flight_s: f64,
    /// Time with something other than the feet on the floor, s.
    pub floor_s: f64,
    /// Time with the pelvis upside down, s.
    pub inverted_s: f64,
    /// Largest torque over strength of every DOF (means over 0.1 s), in DOF order.
    pub torque_peak_by_dof: Vec<f64>,
    /// 95th percentile of the torque over strength of every DOF, in DOF order.
    pub torque_p95_by_dof: Vec<f64>,
}

/// What will come of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "net", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "net", serde(rename_all = "snake_case"))]
pub enum Verdict {
    /// The figure follows it by its own strength.
    #[default]
    Follows,
    /// It deviates or falls, unless it is helped.
    NeedsHelp,
    /// No help short of carrying it will do.
    Cannot,
}

impl Verdict {
    /// All, from the easiest on.
    pub const ALL: [Self; 3] = [Self::Follows, Self::NeedsHelp, Self::Cannot];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Follows => "follows",
            Self::NeedsHelp => "needs help",
            Self::Cannot => "cannot",
        }
    }
}

/// A forecast with its reason.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "net", derive(serde::Serialize, serde::Deserialize))]
pub struct Forecast {
    /// What will come of it.
    pub verdict: Verdict,
    /// Why, as the end of the sentence "follows …", "needs help: …", "cannot: …".
    pub reason: String,
    /// The hardest demand over what is believed to be followed; up to 1 it follows, from [`Limits::cannot`] on it cannot.
    pub demand: f64,
    /// The figures behind it.
    pub difficulty: Difficulty,
}

/// Up to where a motion is believed to be followed. One struct for all clips; nothing in it belongs to a single recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// [`Difficulty::drift_m`], m. A foot reaches about 0.1 m around its middle; what drives the capture point beyond the edge of the support needs
    /// a step that the motion does not have.
    pub drift_m: f64,
    /// [`Difficulty::sink_mps`], m/s. A body that lacks so much upward speed misses the height of the motion by a hand's breadth.
    pub sink_mps: f64,
    /// [`Difficulty::torque_peak`]. Beyond 1 the joint gives way; neighbours and momentum bridge a short excess.
    pub torque: f64,
    /// Demand, as a multiple of the above, from which no small help will do.
    pub cannot: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            drift_m: 0.2,
            sink_mps: 0.8,
            torque: 1.5,
            cannot: 3.0,
        }
    }
}

/// Forecast of a clip from its first to its last sample, way in and way out included.
///
/// * `links`: the body with the loads that it carries.
/// * `strength`, `scale`: its strength and the factors on it.
///
/// Pure; about 0.2 ms for each 1/30 s; allocates.
pub fn forecast(
    body: &Body,
    links: &Links,
    strength: &Strength,
    scale: &StrengthScale,
    clip: &Clip,
) -> Forecast {
    judge(
        &difficulty(body, links, strength, &scale.muscles(1.0), clip),
        &Limits::default(),
    )
}

/// Forecast of a clip for an unloaded body of ordinary strength.
pub fn forecast_plain(body: &Body, clip: &Clip) -> Forecast {
    let strength = Strength::for_body(body);
    let scale = StrengthScale::default();
    forecast(body, &Links::new(body), &strength, &scale, clip)
}

/// The verdict on a difficulty.
pub fn judge(difficulty: &Difficulty, limits: &Limits) -> Forecast {
    let d = difficulty;
    let demands = [
        (d.drift_m / limits.drift_m, 0),
        (d.sink_mps / limits.sink_mps, 1),
        (d.torque_peak / limits.torque, 2),
    ];
    let (demand, which) =
        (demands.into_iter()).fold((0.0, 2), |a, b| if b.0 > a.0 { b } else { a });
    let verdict = match demand {
        x if x <= 1.0 => Verdict::Follows,
        x if x < limits.cannot => Verdict::NeedsHelp,
        _ => Verdict::Cannot,
    };
    let time = |t: f64| match t {
        t if t < 0.0 => format!("{:.1} s before its first frame", -t),
        t => format!("at {t:.1} s"),
    };
    let reason = match which {
        0 => format!(
            "the floor lacks {:.2} weights and {:.2} weight·m {}, which drives the capture point {:.2} m off in half a second",
            d.lacking_force_peak,
            d.lacking_moment_peak,
            time(d.drift_at_s),
            d.drift_m
        ),
        1 => format!(
            "the floor would have to {} with {:.1} weights more than it can {}",
            if d.lacking_force_peak > 0.0 { "push or pull" } else { "push" },
            d.lacking_force_peak,
            time(d.sink_at_s)
        ),
        _ if d.torque_peak_dof.is_empty() => "needs no strength".to_owned(),
        _ => format!(
            "needs {:.1} times the strength of {} {}",
            d.torque_peak,
            spoken(&d.torque_peak_dof),
            time(d.torque_peak_at_s)
        ),
    };
    Forecast {
        verdict,
        reason,
        demand: short(demand),
        difficulty: d.clone(),
    }
}

/// `r_knee_flexion` as `the right knee (flexion)`.
fn spoken(dof: &str) -> String {
    let (side, rest) = match dof.split_at_checked(2) {
        Some(("l_", rest)) => ("left ", rest),
        Some(("r_", rest)) => ("right ", rest),
        _ => ("", dof),
    };
    match rest.split_once('_') {
        Some((joint, way)) => format!("the {side}{joint} ({way})"),
        None => format!("the {side}{rest}"),
    }
}

/// What one sample asks for.
#[derive(Clone, Debug)]
struct Demand {
    time: f64,
    /// Force, weights, and moment about the centre of mass, weight × m, that the floor lacks.
    lacking: (Vec3, Vec3),
    /// Height of the centre of mass over the floor, m.
    height: f64,
    /// Torque over strength.
    torque: [f64; DOF_COUNT],
    feet: bool,
    others: bool,
    inverted: bool,
}

/// Measures a clip, way in and way out included.
pub fn difficulty(
    body: &Body,
    links: &Links,
    strength: &Strength,
    scale: &MuscleScale,
    clip: &Clip,
) -> Difficulty {
    let from = -clip.lead_in();
    let length = (clip.lead_in() + clip.duration() + clip.lead_out()).min(LONGEST);
    // The ends of a clip have one-sided differences, and it stands still beyond them.
    let count = (length * RATE).floor() as usize;
    let mut looker = Looker::new(body, links, strength, scale);
    let demands: Vec<Demand> = (1..count.max(2))
        .map(|i| {
            let time = from + i as f64 / RATE;
            looker.look(&clip.sample(time.min(from + length)), time)
        })
        .collect();
    summary(&demands)
}

/// Everything that a sample is looked at with.
struct Looker<'a> {
    body: &'a Body,
    links: &'a Links,
    strength: &'a Strength,
    scale: &'a MuscleScale,
    weight: f64,
    kin: Kinematics,
    workspace: RneaWorkspace,
    columns: Vec<[f64; ROWS]>,
}

impl<'a> Looker<'a> {
    fn new(
        body: &'a Body,
        links: &'a Links,
        strength: &'a Strength,
        scale: &'a MuscleScale,
    ) -> Self {
        Self {
            body,
            links,
            strength,
            scale,
            weight: links.total_mass() * GRAVITY,
            kin: Kinematics::default(),
            workspace: RneaWorkspace::default(),
            columns: Vec::new(),
        }
    }

    fn look(&mut self, target: &Target, time: f64) -> Demand {
        let state = target.state();
        self.kin.set_state(self.links, &state);
        let mut tau = [0.0; ROWS];
        rnea(
            self.links,
            &self.kin,
            &target.velocity,
            &target.acceleration,
            GRAVITY,
            &[],
            &mut self.workspace,
            &mut tau,
        );
        let angles = anatomical_angles(&target.posture);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|d| target.velocity[6 + d]);
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        (self.strength).range(&angles, &rates, self.scale, &mut lower, &mut upper);
        let mut tissue = [0.0; DOF_COUNT];
        self.strength.passive(&angles, &rates, &mut tissue);

        let (com, _) = center_of_mass(self.links, &self.kin);
        let root = target.posture.root_position;
        let force = vector(&tau[3..6]);
        let moment = vector(&tau[..3]) - com.cross(force);
        let per_weight = 1.0 / self.weight;
        let mut b = [0.0; ROWS];
        b[..3].copy_from_slice(&(force * per_weight).to_array());
        b[3..6].copy_from_slice(&(moment * per_weight).to_array());
        // Rows of the joints: torque over the mean of both limits.
        let per_limit: [f64; DOF_COUNT] =
            std::array::from_fn(|d| 2.0 * EVEN / (upper[d] - lower[d]));
        for d in 0..DOF_COUNT {
            b[6 + d] = (tau[6 + d] - tissue[d]) * per_limit[d];
        }
        let (feet, others) = self.touch(target, com, &per_limit);
        let pushes = nnls(&self.columns, &b, RIDGE);
        for (c, x) in self.columns.iter().zip(&pushes).filter(|(_, x)| **x > 0.0) {
            for (r, a) in b.iter_mut().zip(c) {
                *r -= a * x;
            }
        }
        let torque = std::array::from_fn(|d| {
            let t = b[6 + d] / per_limit[d];
            t / if t < 0.0 { lower[d] } else { upper[d] }
        });
        let up = target.posture.root_rotation.rotate(Vec3::Z).z;
        Demand {
            time,
            lacking: (vector(&b[..3]), vector(&b[3..6])),
            height: (root.z + com.z).max(0.2),
            torque,
            feet,
            others,
            inverted: up < INVERTED,
        }
    }

    /// Fills the columns with the edges of the friction cones of all touching points; whether feet, and whether other parts, touch.
    fn touch(&mut self, target: &Target, com: Vec3, per_limit: &[f64; DOF_COUNT]) -> (bool, bool) {
        self.columns.clear();
        let root = target.posture.root_position.z;
        let (mut feet, mut others) = (false, false);
        let mut heights: Vec<(Vec3, f64)> = Vec::with_capacity(16);
        for s in 0..SEGMENT_COUNT {
            let id = SegmentId::new(s).expect("s < SEGMENT_COUNT");
            let side = [[L_FOOT, L_TOES], [R_FOOT, R_TOES]]
                .iter()
                .position(|f| f.contains(&id));
            let planted = side.is_some_and(|k| target.planted[k]);
            heights.clear();
            heights.extend(self.body.segments[s].contact_points.iter().map(|p| {
                let arm = self.kin.rotation[s] * *p;
                (arm, root + self.kin.position[s].z + arm.z)
            }));
            let lowest = heights.iter().map(|h| h.1).fold(f64::INFINITY, f64::min);
            for i in 0..heights.len() {
                let (arm, height) = heights[i];
                let speed = || (self.kin.velocity[s] + self.kin.omega[s].cross(arm)).norm();
                let on = (planted && height < TOUCH.max(lowest + SOLE))
                    || (height < TOUCH && speed() < SLOW);
                if on {
                    *(if side.is_some() { &mut feet } else { &mut others }) = true;
                    self.add_cone(s, self.kin.position[s] + arm, com, per_limit);
                }
            }
        }
        (feet, others)
    }

    /// Edges of the cone at `point` (from the pelvis origin, world axes) of segment `s`; a unit is one weight along the normal.
    fn add_cone(&mut self, s: usize, point: Vec3, com: Vec3, per_limit: &[f64; DOF_COUNT]) {
        let corner = std::f64::consts::FRAC_1_SQRT_2;
        const AROUND: [(f64, f64); EDGES] = [
            (1.0, 0.0),
            (1.0, 1.0),
            (0.0, 1.0),
            (-1.0, 1.0),
            (-1.0, 0.0),
            (-1.0, -1.0),
            (0.0, -1.0),
            (1.0, -1.0),
        ];
        for (x, y) in AROUND {
            let share = FRICTION * if x * y == 0.0 { 1.0 } else { corner };
            let f = Vec3 {
                x: share * x,
                y: share * y,
                z: 1.0,
            };
            let mut column = [0.0; ROWS];
            column[..3].copy_from_slice(&f.to_array());
            column[3..6].copy_from_slice(&(point - com).cross(f).to_array());
            let mut at = s;
            while at != 0 {
                let moment = (point - self.kin.position[at]).cross(f) * self.weight;
                for d in DOF_START[at]..DOF_START[at] + DOF_LEN[at] {
                    debug_assert_eq!(DOF_SEGMENT[d], at);
                    column[6 + d] = self.kin.axis[d].dot(moment) * per_limit[d];
                }
                at = PARENT[at];
            }
            self.columns.push(column);
        }
    }
}

fn vector(v: &[f64]) -> Vec3 {
    Vec3 {
        x: v[0],
        y: v[1],
        z: v[2],
    }
}

/// Means of `values` over [`MEAN`], one for each of them but for the ends.
fn means<T: Copy>(values: &[T], zero: T, add: impl Fn(T, T) -> T) -> Vec<(usize, T)> {
    let width = ((MEAN * RATE).round() as usize).clamp(1, values.len().max(1));
    values
        .windows(width)
        .enumerate()
        .map(|(i, w)| (i + width / 2, w.iter().copied().fold(zero, &add)))
        .collect()
}

fn summary(demands: &[Demand]) -> Difficulty {
    let n = demands.len().max(1) as f64;
    let mut out = Difficulty::default();
    let mean = |of: &dyn Fn(&Demand) -> Vec3| {
        let all: Vec<Vec3> = demands.iter().map(of).collect();
        let square: f64 = all.iter().map(|v| v.dot(*v)).sum();
        let width = ((MEAN * RATE).round()).clamp(1.0, n);
        let peak = means(&all, Vec3::zero(), |a, b| a + b)
            .into_iter()
            .map(|(i, v)| (v.norm() / width, i))
            .fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
        ((square / n).sqrt(), peak)
    };
    let time = |i: usize| demands.get(i).map_or(0.0, |d| d.time);
    let (rms, (peak, at)) = mean(&|d| d.lacking.0);
    (out.lacking_force_rms, out.lacking_force_peak) = (rms, peak);
    out.lacking_force_at_s = time(at);
    let (rms, (peak, at)) = mean(&|d| d.lacking.1);
    (out.lacking_moment_rms, out.lacking_moment_peak) = (rms, peak);
    out.lacking_moment_at_s = time(at);
    drift(demands, &mut out);
    torques(demands, &mut out);
    let mut flight = 0.0;
    for d in demands {
        let share = 1.0 / RATE;
        if !d.feet && !d.others {
            out.flight_s += share;
            flight += share;
            out.longest_flight_s = out.longest_flight_s.max(flight);
        } else {
            flight = 0.0;
        }
        out.floor_s += if d.others { share } else { 0.0 };
        out.inverted_s += if d.inverted { share } else { 0.0 };
    }
    out.shortened()
}

impl Difficulty {
    /// With numbers that survive being written and read.
    fn shortened(mut self) -> Self {
        let all = [
            &mut self.lacking_force_rms,
            &mut self.lacking_force_peak,
            &mut self.lacking_force_at_s,
            &mut self.lacking_moment_rms,
            &mut self.lacking_moment_peak,
            &mut self.lacking_moment_at_s,
            &mut self.drift_m,
            &mut self.drift_at_s,
            &mut self.sink_mps,
            &mut self.sink_at_s,
            &mut self.torque_peak,
            &mut self.torque_peak_at_s,
            &mut self.torque_p95,
            &mut self.overload_share,
            &mut self.flight_s,
            &mut self.longest_flight_s,
            &mut self.floor_s,
            &mut self.inverted_s,
        ];
        let lists = self.torque_peak_by_dof.iter_mut().chain(&mut self.torque_p95_by_dof);
        for x in all.into_iter().chain(lists) {
            *x = short(*x);
        }
        self
    }
}

/// How far the missing wrench drives a linear inverted pendulum within [`STEP`]: `ξ̇ = ω δ + f g/ω` with the missing shift δ of the zero-moment
/// point and the missing level force f (in weights), and how fast it makes it sink.
fn drift(demands: &[Demand], out: &mut Difficulty) {
    let rate: Vec<(f64, f64, f64)> = demands
        .iter()
        .map(|d| {
            let omega = (GRAVITY / d.height).sqrt();
            let (f, m) = d.lacking;
            (
                -m.y * omega + f.x * GRAVITY / omega,
                m.x * omega + f.y * GRAVITY / omega,
                f.z * GRAVITY,
            )
        })
        .collect();
    let most = ((STEP * RATE).round() as usize).max(1);
    for start in 0..rate.len() {
        let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
        for (i, r) in rate.iter().enumerate().skip(start).take(most) {
            (x, y, z) = (x + r.0 / RATE, y + r.1 / RATE, z + r.2 / RATE);
            if x.hypot(y) > out.drift_m {
                (out.drift_m, out.drift_at_s) = (x.hypot(y), demands[i].time);
            }
            if z.abs() > out.sink_mps {
                (out.sink_mps, out.sink_at_s) = (z.abs(), demands[i].time);
            }
        }
    }
}

fn torques(demands: &[Demand], out: &mut Difficulty) {
    let all: Vec<[f64; DOF_COUNT]> = demands.iter().map(|d| d.torque).collect();
    let width = ((MEAN * RATE).round() as usize).clamp(1, all.len().max(1)) as f64;
    let sums = means(&all, [0.0; DOF_COUNT], |a, b| {
        std::array::from_fn(|d| a[d] + b[d])
    });
    out.torque_peak_by_dof = vec![0.0; DOF_COUNT];
    for (i, sum) in &sums {
        for d in 0..DOF_COUNT {
            let ratio = sum[d] / width;
            out.torque_peak_by_dof[d] = out.torque_peak_by_dof[d].max(ratio);
            if ratio > out.torque_peak {
                out.torque_peak = ratio;
                out.torque_peak_dof = DOF_NAMES[d].to_owned();
                out.torque_peak_at_s = demands[*i].time;
            }
        }
    }
    let over = |t: &&[f64; DOF_COUNT]| t.iter().any(|r| *r > 1.0);
    out.overload_share = all.iter().filter(over).count() as f64 / all.len().max(1) as f64;
    out.torque_p95_by_dof = (0..DOF_COUNT)
        .map(|d| {
            let mut ratios: Vec<f64> = all.iter().map(|t| t[d]).collect();
            ratios.sort_by(f64::total_cmp);
            let rank = (0.95 * ratios.len() as f64).ceil() as usize;
            ratios.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
        })
        .collect();
    for d in 0..DOF_COUNT {
        if out.torque_p95_by_dof[d] > out.torque_p95 {
            out.torque_p95 = out.torque_p95_by_dof[d];
            out.torque_p95_dof = DOF_NAMES[d].to_owned();
        }
    }
}
