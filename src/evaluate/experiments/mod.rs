//! Experiments as functions: build the scene, run it, return the measures. `sinew paper` and `sinew walking` print
//! them; nothing here reads a clock or a file.

pub mod again;
pub mod compare;
pub mod fall;
pub mod lift;
pub mod person;
pub mod push;
pub mod second_hand;
pub mod statics;
pub mod touching;
pub mod walk;

use super::metrics::Tick;
use super::strip::{StripFrame, Thing, evenly_spaced};
use sinew_physics::body::topology::{CHEST, DOF_COUNT, L_HAND, R_HAND};
use sinew_physics::body::{Body, SegmentId, State};
use sinew_physics::figure::{
    ControlParams, ControllerKind, Flags, Perturbation, StepperKind, StrengthScale,
};
use sinew_physics::math::Vec3;
use sinew_physics::world::{FigureKey, FigureSetup, World, WorldParams};
use std::sync::Arc;

/// Controller, stepper and choices of an experiment.
#[derive(Clone, Debug)]
pub struct ControlPair {
    /// Name in tables.
    pub name: &'static str,
    /// Computes accelerations and torques.
    pub controller: ControllerKind,
    /// Moves the body.
    pub stepper: StepperKind,
    /// Choices and gains.
    pub params: ControlParams,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Whether joints have rotor inertia; without it they are as printed.
    pub armature: bool,
}

impl ControlPair {
    fn of(name: &'static str, controller: ControllerKind, stepper: StepperKind) -> Self {
        Self {
            name,
            controller,
            stepper,
            params: ControlParams::default(),
            rate_hz: 60.0,
            armature: true,
        }
    }

    /// The paper's controller and its own way of moving the body.
    pub fn paper_kinematic() -> Self {
        Self::of(
            "paper, kinematic",
            ControllerKind::Paper,
            StepperKind::Kinematic,
        )
    }

    /// The paper's controller driving full dynamics.
    pub fn paper_torque() -> Self {
        Self::of("paper, torque", ControllerKind::Paper, StepperKind::Torque)
    }

    /// The paper's controller and stepper, with collisions as in §3 of the paper.
    pub fn paper_staged() -> Self {
        Self::of("paper, staged", ControllerKind::Paper, StepperKind::Staged)
    }

    /// The default.
    pub fn modern() -> Self {
        Self::of(
            "modern, torque",
            ControllerKind::Modern,
            StepperKind::Torque,
        )
    }

    /// Motors alone.
    pub fn motors() -> Self {
        Self::of("motors alone", ControllerKind::Motors, StepperKind::Torque)
    }

    /// The paper to the letter, every safeguard off.
    pub fn paper2000() -> Self {
        Self {
            params: ControlParams::paper2000(),
            rate_hz: 30.0,
            armature: false,
            ..Self::of("paper2000", ControllerKind::Paper, StepperKind::Kinematic)
        }
    }

    /// A world of one figure that starts in `state`.
    fn world(&self, body: &Arc<Body>, state: State, strength: StrengthScale) -> (World, FigureKey) {
        let params = WorldParams {
            rate_hz: self.rate_hz,
            ..WorldParams::default()
        };
        let mut world = World::new(params).expect("experiments have valid worlds");
        let key = world
            .add_figure(self.setup(body, state, strength))
            .expect("experiments have valid figures");
        (world, key)
    }

    /// A figure that starts in `state`.
    fn setup(&self, body: &Arc<Body>, state: State, strength: StrengthScale) -> FigureSetup {
        let mut body = Arc::clone(body);
        if !self.armature {
            Arc::make_mut(&mut body).armature = [0.0; DOF_COUNT];
        }
        FigureSetup {
            name: self.name.to_owned(),
            strength,
            stepper: self.stepper,
            params: self.params.clone(),
            ..FigureSetup::new(body, self.controller, state)
        }
    }
}

/// A load in the right hand, or half of it in each hand, from the beginning on.
fn carried(body: &Body, mass: f64, both: bool) -> Vec<Perturbation> {
    let held = |segment: SegmentId, mass: f64| Perturbation::Load {
        segment,
        point: body.segment(segment).com,
        mass,
        from: 0.0,
        to: f64::INFINITY,
    };
    if both {
        vec![held(L_HAND, 0.5 * mass), held(R_HAND, 0.5 * mass)]
    } else {
        vec![held(R_HAND, mass)]
    }
}

/// A force (N, world axes) on the chest, 10 cm over its joint, that begins at `from` and lasts `lasts` s.
fn push_at_chest(force: Vec3, from: f64, lasts: f64) -> Perturbation {
    Perturbation::Force {
        segment: CHEST,
        point: Vec3::Z * 0.1,
        force,
        from,
        to: from + lasts,
    }
}

/// One tick, for plots.
#[derive(Clone, Debug, PartialEq)]
pub struct PlottedTick {
    /// End of the tick, s.
    pub time_s: f64,
    /// Centre of mass, m.
    pub com: Vec3,
    /// Desired centre of mass, m.
    pub com_desired: Vec3,
    /// Zero-moment point, m.
    pub zmp: Option<Vec3>,
    /// Least and largest x and y of the support polygon, m.
    pub polygon: Option<[f64; 4]>,
    /// Joint error, rms over the DOFs, rad.
    pub error: f64,
    /// Error of each DOF, rad.
    pub joint_error: [f64; DOF_COUNT],
    /// Torques and their limits, N·m.
    pub torque: [[f64; 3]; DOF_COUNT],
    /// DOFs at their limit (K of the primary constraint).
    pub saturated: u64,
    /// Flags of the tick.
    pub flags: Flags,
    /// Largest joint speed, rad/s.
    pub speed: f64,
}

/// A recorded run.
#[derive(Clone, Debug, Default)]
pub struct ExperimentRecord {
    /// Every tick.
    pub samples: Vec<PlottedTick>,
    /// Panels of a strip.
    pub frames: Vec<StripFrame>,
    /// First tick with the centre of mass below 45 % of its height when the run began, s.
    pub fell_s: Option<f64>,
    /// Time at which the state ran away and the figure was frozen, s. Samples end there.
    pub frozen_s: Option<f64>,
    /// Largest violation of strength, relative to the limit.
    pub over_limit: f64,
}

/// A centre of mass below this share of that at the start counts as a fall.
const FELL: f64 = 0.45;

/// The surroundings of the figure in a panel: loads that it carries (segment, point, kg), and things.
type Beside = (Vec<(usize, Vec3, f64)>, Vec<Thing>);

/// Runs for `seconds` and keeps `panels` evenly spaced frames; `see` is called after every tick with the world and the
/// time (s).
fn record(
    world: &mut World,
    key: FigureKey,
    seconds: f64,
    panels: usize,
    mut see: impl FnMut(&World, f64) -> Beside,
) -> ExperimentRecord {
    let ticks = (seconds * world.params().rate_hz).round() as u64;
    let shown = evenly_spaced(ticks, panels);
    let mut out = ExperimentRecord::default();
    let mut start = None;
    for n in 0..ticks {
        world.step();
        let (time_s, gravity) = (world.time().0, world.params().gravity);
        let figure = world.figure(key).expect("nobody removes the figure");
        let r = figure.report().expect("a stepped figure has a report");
        let height = *start.get_or_insert(r.balance.com.z);
        if r.balance.com.z < FELL * height && out.fell_s.is_none() {
            out.fell_s = Some(time_s);
        }
        out.over_limit = out.over_limit.max(r.joints.over_limit);
        let corners = &r.balance.support_polygon;
        let range = |k: usize| {
            corners
                .iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], c| {
                    [a.min(c[k]), b.max(c[k])]
                })
        };
        let rates = &figure.state().velocity[6..];
        if r.flags.has(Flags::QUARANTINED) {
            out.frozen_s.get_or_insert(time_s);
        }
        let sample = PlottedTick {
            time_s,
            com: r.balance.com,
            com_desired: r.balance.com_desired,
            zmp: r.balance.zmp,
            polygon: (!corners.is_empty()).then(|| {
                let ([a, b], [c, d]) = (range(0), range(1));
                [a, b, c, d]
            }),
            error: (r.joints.joint_error.iter().map(|e| e * e).sum::<f64>() / DOF_COUNT as f64)
                .sqrt(),
            joint_error: r.joints.joint_error,
            torque: std::array::from_fn(|j| {
                [
                    r.joints.torque[j],
                    r.joints.torque_lower[j],
                    r.joints.torque_upper[j],
                ]
            }),
            saturated: r.joints.saturated,
            flags: r.flags,
            speed: rates.iter().fold(0.0, |m, v| m.max(v.abs())),
        };
        if out.frozen_s.is_none() {
            out.samples.push(sample);
        }
        let (loads, things) = see(world, time_s);
        if shown.binary_search(&n).is_ok() {
            let tick = Tick::of(figure, gravity);
            out.frames
                .push(StripFrame::of(&tick, time_s, loads).among(things));
        }
    }
    out
}

impl ExperimentRecord {
    /// Mean change of torque per tick as a share of the available range.
    pub fn chatter(&self) -> f64 {
        let mut sum = 0.0;
        for pair in self.samples.windows(2) {
            for (a, b) in pair[0].torque.iter().zip(&pair[1].torque) {
                sum += (b[0] - a[0]).abs() / (b[2] - b[1]);
            }
        }
        sum / (self.samples.len().max(2) - 1) as f64 / DOF_COUNT as f64
    }

    /// Largest joint speed, rad/s.
    pub fn top_speed(&self) -> f64 {
        self.samples.iter().fold(0.0, |m, s| m.max(s.speed))
    }

    /// The outcome of the figure, in a word or two.
    pub fn result(&self) -> String {
        match (self.frozen_s, self.fell_s) {
            (Some(f), t) if t.is_none_or(|t| f <= t) => format!("state diverges at {f:.1} s"),
            (_, Some(t)) => format!("falls at {t:.1} s"),
            _ => "stands".into(),
        }
    }

    /// Joint error over the whole run, rms, degrees.
    pub fn rms_deg(&self) -> f64 {
        let n = self.samples.len().max(1) as f64;
        let sum: f64 = self.samples.iter().map(|s| s.error * s.error).sum();
        (sum / n).sqrt().to_degrees()
    }
}
