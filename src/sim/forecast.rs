//! The difficulty of a motion for a body, and a forecast, before any simulation, of whether the body can follow it.
//!
//! Inverse dynamics of the prepared motion. At each sample the floor pushes, within friction, at the points that touch
//! it, so that the required wrench is met as well as possible and the joints are loaded as evenly as possible. The
//! remainder of the wrench is what the floor lacks. The torques are compared with the strength of the body at those
//! angles and speeds. [`ForecastLimits`] turns both into a verdict with its reason.

use crate::body::angles::anatomical_angles;
use crate::body::topology::{
    DOF_LEN, DOF_NAMES, DOF_SEGMENT, DOF_START, L_FOOT, L_TOES, PARENT, R_FOOT, R_TOES,
};
use crate::body::{Body, DOF_COUNT, Links, SEGMENT_COUNT, SegmentId};
use crate::dynamics::{ExternalForces, Kinematics, RneaWorkspace, center_of_mass, rnea};
use crate::math::Vec3;
use crate::math::nnls::nnls;
use crate::math::rounding::short;
use crate::motion::{Clip, GRAVITY, Target};
use crate::setup::StrengthScale;
use crate::strength::{MuscleScale, Strength};

/// Samples examined per second: motion is below 6 Hz.
const RATE: f64 = 30.0;
/// Assumed friction of the floor: the value that the modern controller uses on the default floor.
const FRICTION: f64 = 0.8;
/// Edges of the pyramid that stands for a friction cone.
const EDGES: usize = 8;
/// A point touches below this height, m, if it is slower than [`SLOW`]: the error of a retargeted contact.
const TOUCH: f64 = 0.03;
/// See [`TOUCH`], m/s.
const SLOW: f64 = 0.6;
/// Points of a planted foot touch if they are within this height over its lowest one, m: a raised heel does not.
const SOLE: f64 = 0.02;
/// Weight of a joint at its limit against one body weight of missing force: even torques matter only where forces are
/// not determined.
const EVEN: f64 = 0.01;
/// Keeps the least squares solvable; forces are in weights.
const RIDGE: f64 = 1e-8;
/// Torques and forces are averaged over this time, s: shorter peaks come from differentiation, and a body bridges them.
const MEAN: f64 = 0.1;
/// Time over which a missing force moves the capture point, s: a step can still catch a later effect.
const STEP: f64 = 0.5;
/// Upright part of the pelvis's vertical axis below which it is upside down.
const INVERTED: f64 = -0.3;
/// Rows: force, moment about the centre of mass, joint torques.
const ROWS: usize = 6 + DOF_COUNT;
/// Longest part of a clip that is examined, s, so that the cost of a long recording stays bounded by that of its
/// preparation.
const LONGEST: f64 = 900.0;

/// The difficulty of a motion. Forces in body weights, moments in weight × metre, torques over the strength at that
/// instant, times on the clip's clock.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
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
    /// Farthest that the lacking wrench drives the capture point within 0.5 s, m.
    pub drift_m: f64,
    /// Middle of that time, s.
    pub drift_at_s: f64,
    /// Mean horizontal force that is lacking in that time, weights, and mean horizontal moment, weight × m.
    pub drift_force: f64,
    /// See `drift_force`.
    pub drift_moment: f64,
    /// Largest vertical speed that the lacking force causes within 0.5 s, m/s.
    pub sink_mps: f64,
    /// Middle of that time, s.
    pub sink_at_s: f64,
    /// Mean vertical force that is lacking in that time, weights: positive if the floor would have to push harder,
    /// negative if it would have to pull.
    pub sink_force: f64,
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
    /// Largest 95th percentile of the joints that carry: hips, knees, waist and thorax in flexion and to the side.
    /// Ankles are not among them: their torque depends on where under the sole the floor pushes.
    pub support_p95: f64,
    /// Its DOF; empty if none is needed.
    pub support_p95_dof: String,
    /// Largest mean torque of that DOF over 0.1 s, over its strength there.
    pub support_peak: f64,
    /// Time of that torque, s.
    pub support_peak_at_s: f64,
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

/// Verdict of a forecast.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    serde::Serialize,
    serde::Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum ForecastVerdict {
    /// The figure follows it by its own strength.
    #[default]
    Follows,
    /// It deviates or falls, unless it is helped.
    NeedsHelp,
    /// Tracking alone will not do, nor will a little help.
    Cannot,
}

impl ForecastVerdict {
    /// All, from the easiest on.
    pub const ALL: [Self; 3] = [Self::Follows, Self::NeedsHelp, Self::Cannot];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Follows => "follows",
            Self::NeedsHelp => "needs help",
            Self::Cannot => "not by tracking alone",
        }
    }
}

/// A forecast with its reason.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Forecast {
    /// Verdict.
    pub verdict: ForecastVerdict,
    /// The reason, as the end of the sentence "follows …", "needs help: …", "not by tracking alone: …".
    pub reason: String,
    /// The hardest demand: up to 1 it follows, from 2 on it cannot ([`ForecastLimits`]).
    pub demand: f64,
    /// The figures behind it.
    pub difficulty: Difficulty,
}

/// The values up to which a motion is expected to be followed, and from which on no small help suffices. One struct for
/// all clips; nothing in it belongs to a single recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastLimits {
    /// [`Difficulty::drift_m`], m. A foot reaches 0.1 to 0.2 m around its middle: a wrench that drives the capture
    /// point farther requires a step that the motion does not have. From half a metre on the drift alone counts as lost
    /// (PHC's rule).
    pub drift_m: [f64; 2],
    /// [`Difficulty::sink_mps`], m/s. A body that lacks 0.5 m/s of upward speed is a hand's breadth too low after 0.2
    /// s; 2.2 m/s is its speed after falling by 0.25 m.
    pub sink_mps: [f64; 2],
    /// [`Difficulty::support_p95`]. A joint that carries has no more than its strength; momentum bridges less than a
    /// twentieth of the time. At three times the strength of the joint, something else would have to carry most of the
    /// load.
    pub support: [f64; 2],
}

impl Default for ForecastLimits {
    fn default() -> Self {
        Self {
            drift_m: [0.15, 0.5],
            sink_mps: [0.5, 2.2],
            support: [1.0, 3.0],
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
        &ForecastLimits::default(),
    )
}

/// Forecast of a clip for an unloaded body of ordinary strength.
pub fn forecast_plain(body: &Body, clip: &Clip) -> Forecast {
    let strength = Strength::for_body(body);
    let scale = StrengthScale::default();
    forecast(body, &Links::new(body), &strength, &scale, clip)
}

/// The verdict on a difficulty.
pub fn judge(difficulty: &Difficulty, limits: &ForecastLimits) -> Forecast {
    let d = difficulty;
    let demands = [
        demand(d.support_p95, limits.support),
        demand(d.drift_m, limits.drift_m),
        demand(d.sink_mps, limits.sink_mps),
    ];
    let most = demands.iter().copied().fold(0.0, f64::max);
    let verdict = match most {
        x if x <= 1.0 => ForecastVerdict::Follows,
        x if x < 2.0 => ForecastVerdict::NeedsHelp,
        _ => ForecastVerdict::Cannot,
    };
    let time = |t: f64| match t {
        t if t < -0.05 => format!("{:.1} s before its first frame", -t),
        t => format!("at {:.1} s", t.max(0.0)),
    };
    let reason = if d.support_p95_dof.is_empty() && most <= 0.0 {
        "needs no strength".to_owned()
    } else if demands[0] >= most {
        format!(
            "needs {:.1} times the strength of {} {}, {:.1} times for 5 % of the time",
            d.support_peak,
            spoken(&d.support_p95_dof),
            time(d.support_peak_at_s),
            d.support_p95
        )
    } else if demands[1] >= most {
        format!(
            "the floor lacks {:.2} weights and {:.2} weight·m {}, which drives the capture point off by {:.2} m",
            d.drift_force,
            d.drift_moment,
            time(d.drift_at_s),
            d.drift_m
        )
    } else {
        let way = if d.sink_force > 0.0 {
            "push harder"
        } else {
            "pull"
        };
        let force = d.sink_force.abs();
        format!(
            "the floor would have to {way} by {force:.1} weights {}",
            time(d.sink_at_s)
        )
    };
    Forecast {
        verdict,
        reason,
        demand: short(most),
        difficulty: d.clone(),
    }
}

/// 0 for no demand, 1 where a motion is no longer expected to be followed, 2 where no small help suffices; linear in
/// between and beyond.
fn demand(value: f64, [follows, cannot]: [f64; 2]) -> f64 {
    if value <= follows {
        value / follows
    } else {
        1.0 + (value - follows) / (cannot - follows)
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

/// Torques of the muscles at one moment of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Needed {
    /// Joint angles, rad.
    pub angle: [f64; DOF_COUNT],
    /// Their rates, rad/s.
    pub rate: [f64; DOF_COUNT],
    /// Torques of the muscles, N·m.
    pub torque: [f64; DOF_COUNT],
}

/// Torques of the muscles in a clip, way in and way out included, every 1/30 s; means over 0.1 s.
///
/// The floor pushes as in the forecast; the wrench that it lacks is left out.
pub fn needed(body: &Body, links: &Links, strength: &Strength, clip: &Clip) -> Vec<Needed> {
    let all = demands(body, links, strength, &MuscleScale::default(), clip);
    let width = ((MEAN * RATE).round() as usize).clamp(1, all.len().max(1));
    let mean = |w: &[Demand], of: &dyn Fn(&Needed) -> &[f64; DOF_COUNT]| {
        let sum = |d: usize| w.iter().map(|x| of(&x.needed)[d]).sum::<f64>();
        std::array::from_fn(|d| sum(d) / w.len() as f64)
    };
    (all.windows(width))
        .map(|w| Needed {
            angle: mean(w, &|n| &n.angle),
            rate: mean(w, &|n| &n.rate),
            torque: mean(w, &|n| &n.torque),
        })
        .collect()
}

/// Demand of one sample.
#[derive(Clone, Debug)]
struct Demand {
    time: f64,
    /// Force, weights, and moment about the centre of mass, weight × m, that the floor lacks.
    lacking: (Vec3, Vec3),
    /// Height of the centre of mass over the floor, m.
    height: f64,
    /// Torque over strength.
    torque: [f64; DOF_COUNT],
    needed: Box<Needed>,
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
    summary(&demands(body, links, strength, scale, clip))
}

/// Measures every sample of a clip.
fn demands(
    body: &Body,
    links: &Links,
    strength: &Strength,
    scale: &MuscleScale,
    clip: &Clip,
) -> Vec<Demand> {
    let from = -clip.lead_in();
    let length = (clip.lead_in() + clip.duration() + clip.lead_out()).min(LONGEST);
    // The ends of a clip have one-sided differences, and it stands still beyond them.
    let count = (length * RATE).floor() as usize;
    let mut sampler = DemandSampler::new(body, links, strength, scale);
    (1..count.max(2))
        .map(|i| {
            let time = from + i as f64 / RATE;
            sampler.look(&clip.sample(time.min(from + length)), time)
        })
        .collect()
}

/// Measures the demand of one sample after another.
struct DemandSampler<'a> {
    body: &'a Body,
    links: &'a Links,
    strength: &'a Strength,
    scale: &'a MuscleScale,
    weight: f64,
    kin: Kinematics,
    workspace: RneaWorkspace,
    columns: Vec<[f64; ROWS]>,
}

impl<'a> DemandSampler<'a> {
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
            ExternalForces::gravity(GRAVITY),
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
        let muscles: [f64; DOF_COUNT] = std::array::from_fn(|d| b[6 + d] / per_limit[d]);
        let torque = std::array::from_fn(|d| {
            let t = muscles[d];
            t / if t < 0.0 { lower[d] } else { upper[d] }
        });
        let up = target.posture.root_rotation.rotate(Vec3::Z).z;
        Demand {
            time,
            lacking: (vector(&b[..3]), vector(&b[3..6])),
            height: (root.z + com.z).max(0.2),
            torque,
            needed: Box::new(Needed {
                angle: angles,
                rate: rates,
                torque: muscles,
            }),
            feet,
            others,
            inverted: up < INVERTED,
        }
    }

    /// Fills the columns with the edges of the friction cones of all touching points. Returns whether feet touch, and
    /// whether other parts do.
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
                    *(if side.is_some() {
                        &mut feet
                    } else {
                        &mut others
                    }) = true;
                    self.add_cone(s, self.kin.position[s] + arm, com, per_limit);
                }
            }
        }
        (feet, others)
    }

    /// Edges of the cone at `point` (from the pelvis origin, world axes) of segment `s`; a unit is one weight along
    /// the normal.
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

/// Means of `values` over [`MEAN`], one for each of them except at the ends.
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
    /// Rounds to numbers that survive being written and read.
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
            &mut self.drift_force,
            &mut self.drift_moment,
            &mut self.sink_force,
            &mut self.support_p95,
            &mut self.support_peak,
            &mut self.support_peak_at_s,
            &mut self.torque_peak,
            &mut self.torque_peak_at_s,
            &mut self.torque_p95,
            &mut self.overload_share,
            &mut self.flight_s,
            &mut self.longest_flight_s,
            &mut self.floor_s,
            &mut self.inverted_s,
        ];
        let lists = self
            .torque_peak_by_dof
            .iter_mut()
            .chain(&mut self.torque_p95_by_dof);
        for x in all.into_iter().chain(lists) {
            *x = short(*x);
        }
        self
    }
}

/// How far the missing wrench drives a linear inverted pendulum within [`STEP`], `ξ̇ = ω δ + f g/ω` with the missing
/// shift δ of the zero-moment point and the missing horizontal force f (in weights), and how fast the pendulum sinks.
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
    let (mut far, mut fast) = ((0, 0), (0, 0));
    for start in 0..rate.len() {
        let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
        for (i, r) in rate.iter().enumerate().skip(start).take(most) {
            (x, y, z) = (x + r.0 / RATE, y + r.1 / RATE, z + r.2 / RATE);
            if x.hypot(y) > out.drift_m {
                (out.drift_m, far) = (x.hypot(y), (start, i));
            }
            if z.abs() > out.sink_mps {
                (out.sink_mps, fast) = (z.abs(), (start, i));
            }
        }
    }
    let mean = |(a, b): (usize, usize), of: &dyn Fn(&Demand) -> Vec3| {
        let part = demands.get(a..=b).unwrap_or_default();
        part.iter().fold(Vec3::zero(), |sum, d| sum + of(d)) * (1.0 / part.len().max(1) as f64)
    };
    let middle = |(a, b): (usize, usize)| demands.get((a + b) / 2).map_or(0.0, |d| d.time);
    let level = |v: Vec3| v.x.hypot(v.y);
    (out.drift_at_s, out.sink_at_s) = (middle(far), middle(fast));
    out.drift_force = level(mean(far, &|d| d.lacking.0));
    out.drift_moment = level(mean(far, &|d| d.lacking.1));
    out.sink_force = mean(fast, &|d| d.lacking.0).z;
}

/// DOFs that carry the body.
fn carries(dof: &str) -> bool {
    let joint = ["hip_", "knee_", "waist_", "thorax_"];
    let turns = ["rotation"];
    joint.iter().any(|j| dof.contains(j)) && !turns.iter().any(|t| dof.ends_with(t))
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
    let mut peak_at = [0.0; DOF_COUNT];
    for (i, sum) in &sums {
        for d in 0..DOF_COUNT {
            if sum[d] / width >= out.torque_peak_by_dof[d] {
                peak_at[d] = demands[*i].time;
            }
        }
    }
    for d in 0..DOF_COUNT {
        if carries(DOF_NAMES[d]) && out.torque_p95_by_dof[d] > out.support_p95 {
            out.support_p95 = out.torque_p95_by_dof[d];
            out.support_p95_dof = DOF_NAMES[d].to_owned();
            (out.support_peak, out.support_peak_at_s) = (out.torque_peak_by_dof[d], peak_at[d]);
        }
        if out.torque_p95_by_dof[d] > out.torque_p95 {
            out.torque_p95 = out.torque_p95_by_dof[d];
            out.torque_p95_dof = DOF_NAMES[d].to_owned();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Posture;
    use crate::motion::builtin::{at_ease, builtin};

    /// A clip of 1.5 s in the posture of quiet standing, changed by `place`.
    fn clip(planted: bool, place: impl Fn(f64, &mut Posture)) -> Clip {
        let body = Body::adult_man();
        let postures = (0..90)
            .map(|i| {
                let mut p = at_ease(&body);
                place(f64::from(i) / 60.0, &mut p);
                p
            })
            .collect();
        Clip::from_postures("test", 60.0, postures, vec![[planted; 2]; 90]).expect("a clip")
    }

    fn of(clip: &Clip) -> Forecast {
        forecast_plain(&Body::adult_man(), clip)
    }

    #[test]
    fn standing_lacks_nothing_and_follows() {
        let f = of(&clip(true, |_, _| {}));
        let d = &f.difficulty;
        assert_eq!(f.verdict, ForecastVerdict::Follows, "{f:?}");
        assert!(
            d.lacking_force_peak < 1e-3 && d.lacking_moment_peak < 1e-3,
            "{d:?}"
        );
        assert!(d.torque_peak > 0.0 && d.torque_peak < 0.5, "{d:?}");
        assert_eq!((d.flight_s, d.floor_s, d.inverted_s), (0.0, 0.0, 0.0));
    }

    #[test]
    fn free_fall_lacks_nothing_and_floating_lacks_the_weight() {
        let fall =
            |t: f64, p: &mut Posture| p.root_position.z += 2.0 + 5.0 * t - 0.5 * GRAVITY * t * t;
        let d = of(&clip(false, fall)).difficulty;
        assert!(d.lacking_force_peak < 1e-3 && d.sink_mps < 1e-2, "{d:?}");
        assert!(
            d.flight_s > 1.3 && (d.longest_flight_s - d.flight_s).abs() < 1e-6,
            "{d:?}"
        );
        let float = of(&clip(false, |_, p| p.root_position.z += 1.0));
        assert!(
            (float.difficulty.lacking_force_peak - 1.0).abs() < 1e-3,
            "{float:?}"
        );
        // Half a second of 9.81 m/s².
        assert!(
            (float.difficulty.sink_mps - 4.905).abs() < 0.01,
            "{float:?}"
        );
        assert_eq!(float.verdict, ForecastVerdict::Cannot);
        assert!(
            float.reason.contains("push harder by 1.0 weights"),
            "{}",
            float.reason
        );
    }

    #[test]
    fn a_lean_beyond_the_soles_lacks_the_moment_of_its_distance() {
        // The whole body turns about its feet, which are labelled as standing: its centre of mass moves away from them
        // by its height times the lean.
        let lean = |angle: f64| {
            of(&clip(true, move |_, p| {
                let q = crate::math::Quat::exp(Vec3::Y * angle);
                p.root_position = q.rotate(p.root_position);
                p.root_rotation = q * p.root_rotation;
            }))
        };
        let (small, large) = (lean(0.02), lean(0.7));
        assert!(small.difficulty.lacking_moment_peak < 0.01, "{small:?}");
        assert!(large.difficulty.lacking_moment_peak > 0.1, "{large:?}");
        assert_ne!(large.verdict, ForecastVerdict::Follows, "{large:?}");
    }

    #[test]
    fn less_strength_and_more_load_need_a_larger_share() {
        let body = Body::adult_man();
        let strength = Strength::for_body(&body);
        let squat = builtin(&body, "squat").expect("built in");
        let links = Links::new(&body);
        let share = |links: &Links, all: f64| {
            let scale = StrengthScale {
                all,
                ..StrengthScale::default()
            };
            forecast(&body, links, &strength, &scale, &squat)
        };
        let (plain, weak) = (share(&links, 1.0), share(&links, 0.2));
        assert_eq!(plain.verdict, ForecastVerdict::Follows, "{plain:?}");
        assert!(weak.difficulty.support_p95 > 3.0 * plain.difficulty.support_p95);
        assert_ne!(weak.verdict, ForecastVerdict::Follows, "{weak:?}");
        assert!(
            weak.reason.contains("times the strength of the"),
            "{}",
            weak.reason
        );
        let mut loaded = links.clone();
        loaded.add_load(
            SegmentId::from_name("chest").expect("a chest"),
            Vec3::Z * 0.2,
            60.0,
        );
        assert!(share(&loaded, 1.0).difficulty.support_p95 > plain.difficulty.support_p95);
    }

    #[test]
    fn the_worst_demand_gives_the_reason() {
        let limits = ForecastLimits::default();
        let d = Difficulty {
            support_p95: 1.4,
            support_p95_dof: "r_knee_flexion".into(),
            support_peak: 1.8,
            support_peak_at_s: 1.2,
            drift_m: 0.1,
            ..Difficulty::default()
        };
        let f = judge(&d, &limits);
        assert_eq!((f.verdict, f.demand), (ForecastVerdict::NeedsHelp, 1.2));
        let says = "needs 1.8 times the strength of the right knee (flexion) at 1.2 s";
        assert!(f.reason.starts_with(says), "{}", f.reason);
        let pulled = Difficulty {
            sink_mps: 3.0,
            sink_at_s: 0.7,
            sink_force: -0.6,
            ..d
        };
        let f = judge(&pulled, &limits);
        assert_eq!(f.verdict, ForecastVerdict::Cannot);
        assert_eq!(
            f.reason,
            "the floor would have to pull by 0.6 weights at 0.7 s"
        );
        assert_eq!(
            judge(&Difficulty::default(), &limits).verdict,
            ForecastVerdict::Follows
        );
    }
}
