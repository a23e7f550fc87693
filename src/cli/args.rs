//! Arguments that several commands share, and the small languages of `--load`, `--push`, `--constrain` and `--obstacle`.

use crate::sim::body::topology::{L_HAND, R_HAND, SEGMENT_NAMES};
use crate::sim::body::{Body, Profile, SegmentId, Sex};
use crate::sim::collide::{Mobility, ObstacleSetup, Shape};
use crate::sim::figure::tasks::grip;
use crate::sim::figure::{
    Constrained, Constraint, ControlParams, ControllerKind, HeldLoad, Metric, Perturbation,
    Priority, Share, StepperKind,
};
use crate::sim::math::{Quat, Vec3};
use anyhow::{Context, Result, ensure};
use clap::ValueEnum;
use std::str::FromStr;

/// Which body tables are used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyKind {
    /// Adult man; 30 years, 1.75 m, 75 kg unless said otherwise.
    #[default]
    Man,
    /// Adult woman, of average size unless said otherwise.
    Woman,
    /// Child; 8 years, of ordinary size for the age unless said otherwise. Up to 10 years boys and girls are alike.
    Child,
    /// Older man; 75 years, of ordinary size unless said otherwise.
    OlderMan,
    /// Older woman; 75 years, of ordinary size unless said otherwise.
    OlderWoman,
}

/// Who the figure stands for.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct BodyArgs {
    /// Body and strength tables.
    #[arg(long, value_enum, default_value_t)]
    pub body: BodyKind,
    /// Age, years, 6 to 90.
    #[arg(long, value_name = "YEARS")]
    pub age: Option<f64>,
    /// Stature, m; ordinary for sex and age unless given.
    #[arg(long, value_name = "M")]
    pub height: Option<f64>,
    /// Body mass, kg; ordinary for sex and age unless given.
    #[arg(long, value_name = "KG")]
    pub mass: Option<f64>,
}

impl BodyArgs {
    /// Builds the body.
    ///
    /// # Errors
    /// When the tables do not cover the profile; names the value and its range.
    pub fn build(&self) -> Result<Body> {
        let (sex, age) = match self.body {
            BodyKind::Man => (Sex::Male, 30.0),
            BodyKind::Woman => (Sex::Female, 30.0),
            BodyKind::Child => (Sex::Male, 8.0),
            BodyKind::OlderMan => (Sex::Male, 75.0),
            BodyKind::OlderWoman => (Sex::Female, 75.0),
        };
        let ordinary = Profile::ordinary(sex, self.age.unwrap_or(age));
        let profile = Profile {
            height: self.height.unwrap_or(ordinary.height),
            mass: self.mass.unwrap_or(ordinary.mass),
            ..ordinary
        };
        Body::humanoid(profile).context("no such body")
    }
}

/// `man` or `woman`.
pub fn sex_name(sex: Sex) -> &'static str {
    match sex {
        Sex::Male => "man",
        Sex::Female => "woman",
    }
}

/// What people call someone of this sex and age, for headings.
pub fn person_name(p: &Profile) -> &'static str {
    match (p.sex, p.age) {
        (_, a) if a <= 10.0 => "child",
        (Sex::Male, a) if a < 18.0 => "boy",
        (Sex::Female, a) if a < 18.0 => "girl",
        (Sex::Male, a) if a >= 65.0 => "older man",
        (Sex::Female, a) if a >= 65.0 => "older woman",
        (sex, _) => sex_name(sex),
    }
}

/// Who computes torques.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ControllerArg {
    /// The paper's controller.
    Paper,
    /// Whole-body optimisation within strength and friction.
    #[default]
    Modern,
    /// Strength-limited motors at the joints alone.
    Motors,
}

impl From<ControllerArg> for ControllerKind {
    fn from(arg: ControllerArg) -> Self {
        match arg {
            ControllerArg::Paper => Self::Paper,
            ControllerArg::Modern => Self::Modern,
            ControllerArg::Motors => Self::Motors,
        }
    }
}

/// Who moves the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StepperArg {
    /// Torques drive rigid-body dynamics with ground contact.
    #[default]
    Torque,
    /// The controller's accelerations are applied as they are (for the paper's controller).
    Kinematic,
}

impl From<StepperArg> for StepperKind {
    fn from(arg: StepperArg) -> Self {
        match arg {
            StepperArg::Torque => Self::Torque,
            StepperArg::Kinematic => Self::Kinematic,
        }
    }
}

/// Starting point of the paper's controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PresetArg {
    /// As printed in 2000: --controller paper --stepper kinematic --rate 30, no safeguards, no armature.
    Paper2000,
}

/// Norm of equation (10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum MetricArg {
    /// W = I: all joints help.
    #[value(name = "I")]
    Identity,
    /// W = H: only saturated joints accelerate otherwise.
    #[value(name = "H")]
    Inertia,
    /// W = H²: only saturated torques change.
    #[value(name = "H2")]
    Torque,
}

/// Order of equation (12).
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PriorityArg {
    /// As printed.
    Paper,
    /// Hands get what the centre of mass leaves.
    Nested,
}

/// Sharing of the ground reaction between supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShareArg {
    /// By the ratios of equation (2).
    Paper,
    /// Least weighted forces with the right sum and moment.
    Balanced,
}

/// Choices of the paper's controller; the others ignore them. What is not given is as the preset has it, or as usual without one.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Paper's controller")]
pub struct PaperOptions {
    /// Starting point of the choices below.
    #[arg(long, value_enum, conflicts_with_all = ["controller", "stepper"])]
    pub preset: Option<PresetArg>,
    /// Blend of position and velocity demand in (4) per 1/30 s, 0 to 1; counts with --horizon 0.
    #[arg(long, value_name = "A")]
    pub alpha: Option<f64>,
    /// Time constant of the demand, 0.01 to 2 s; 0: met within one step, as printed.
    #[arg(long, value_name = "S")]
    pub horizon: Option<f64>,
    /// Norm of the least change (10).
    #[arg(long, value_enum, ignore_case = true)]
    pub metric: Option<MetricArg>,
    /// Order of centre of mass and hands (12).
    #[arg(long, value_enum)]
    pub priority: Option<PriorityArg>,
    /// Sharing of the ground reaction between supports.
    #[arg(long, value_enum)]
    pub share: Option<ShareArg>,
    /// Joints that (16) saturates go to their limit.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub to_limit: Option<bool>,
    /// Torques of a tipping figure know that its support turns.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub tilt: Option<bool>,
    /// Keep the demand for the centre of mass within what the feet can give.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub zmp_feasible: Option<bool>,
    /// Control both hands.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub track_hands: Option<bool>,
    /// Control the centre of mass.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub track_com: Option<bool>,
    /// Kinematic stepper: torques move the figure while prescribed accelerations cannot go on.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub hand_over: Option<bool>,
}

impl PaperOptions {
    /// The choices as the controller takes them.
    ///
    /// # Errors
    /// A number outside its range; names it.
    pub fn params(&self) -> Result<ControlParams> {
        let mut out = match self.preset {
            Some(PresetArg::Paper2000) => ControlParams::paper2000(),
            None => ControlParams::default(),
        };
        if let Some(alpha) = self.alpha {
            ensure!((0.0..=1.0).contains(&alpha), "--alpha {alpha}: outside 0…1");
            out.alpha = alpha;
        }
        match self.horizon {
            Some(0.0) => out.horizon = None,
            Some(t) => {
                ensure!(
                    (0.01..=2.0).contains(&t),
                    "--horizon {t} s: neither 0 nor within 0.01…2"
                );
                out.horizon = Some(t);
            }
            None => {}
        }
        out.metric = match self.metric {
            Some(MetricArg::Identity) => Metric::Identity,
            Some(MetricArg::Inertia) => Metric::Inertia,
            Some(MetricArg::Torque) => Metric::Torque,
            None => out.metric,
        };
        out.priority = match self.priority {
            Some(PriorityArg::Paper) => Priority::Paper,
            Some(PriorityArg::Nested) => Priority::Nested,
            None => out.priority,
        };
        out.share = match self.share {
            Some(ShareArg::Paper) => Share::Paper,
            Some(ShareArg::Balanced) => Share::Balanced,
            None => out.share,
        };
        for (to, from) in [
            (&mut out.to_limit, self.to_limit),
            (&mut out.tilt, self.tilt),
            (&mut out.zmp_feasible, self.zmp_feasible),
            (&mut out.track_hands, self.track_hands),
            (&mut out.track_com, self.track_com),
            (&mut out.hand_over, self.hand_over),
        ] {
            *to = from.unwrap_or(*to);
        }
        Ok(out)
    }
}

/// Why a `--load`, `--push`, `--constrain` or `--obstacle` cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpecError {
    /// Wrong shape.
    #[error("{got:?} is not of the form {form}")]
    Form {
        /// What was given.
        got: String,
        /// What is expected.
        form: &'static str,
    },
    /// Not a number.
    #[error("{what}: {got:?} is not a number")]
    Number {
        /// Which part.
        what: &'static str,
        /// What was given.
        got: String,
    },
    /// Out of range.
    #[error("{what}: {value} is outside {lower}…{upper}")]
    Range {
        /// Which part, with unit.
        what: &'static str,
        /// What was given.
        value: f64,
        /// Least.
        lower: f64,
        /// Largest.
        upper: f64,
    },
    /// Unknown segment.
    #[error("no segment is called {0:?}; there are {names}", names = SEGMENT_NAMES.join(", "))]
    Segment(String),
    /// An interval that ends before it begins.
    #[error("the interval {from}..{to} s is empty")]
    Interval {
        /// Begin, s.
        from: f64,
        /// End, s.
        to: f64,
    },
    /// A push or a plane without direction.
    #[error("there is no direction in 0,0,0")]
    Direction,
}

fn number(what: &'static str, text: &str, lower: f64, upper: f64) -> Result<f64, SpecError> {
    let value: f64 = text.trim().parse().map_err(|_| SpecError::Number {
        what,
        got: text.to_owned(),
    })?;
    if (lower..=upper).contains(&value) {
        Ok(value)
    } else {
        Err(SpecError::Range {
            what,
            value,
            lower,
            upper,
        })
    }
}

fn segment(text: &str) -> Result<SegmentId, SpecError> {
    SegmentId::from_name(text.trim()).ok_or_else(|| SpecError::Segment(text.to_owned()))
}

/// Largest time an argument may name, s.
const MAX_TIME: f64 = 1e6;

fn interval(times: &str, form: impl Fn() -> SpecError) -> Result<(f64, f64), SpecError> {
    let (mut from_s, mut to_s) = (0.0, f64::INFINITY);
    let (a, b) = times.split_once("..").ok_or_else(form)?;
    if !a.trim().is_empty() {
        from_s = number("begin (s)", a, 0.0, MAX_TIME)?;
    }
    if !b.trim().is_empty() {
        to_s = number("end (s)", b, 0.0, MAX_TIME)?;
    }
    if to_s <= from_s {
        return Err(SpecError::Interval {
            from: from_s,
            to: to_s,
        });
    }
    Ok((from_s, to_s))
}

/// `PART@x,y,z[@T0..T1][:qx,qy,qz,qw]`: where a segment or the centre of mass (`com`) is wanted, and how it is turned; `_` leaves an axis free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstraintSpec {
    /// Segment; `None`: the centre of mass.
    pub part: Option<SegmentId>,
    /// Wanted coordinates, m.
    pub position: [Option<f64>; 3],
    /// Wanted rotation.
    pub rotation: Option<Quat>,
    /// Begins at, s.
    pub from_s: f64,
    /// Ends at, s; infinite = never.
    pub to_s: f64,
}

impl ConstraintSpec {
    const FORM: &'static str =
        "PART@x,y,z[@T0..T1][:qx,qy,qz,qw], for example r_hand@0.4,-0.25,1.1@1..3 or com@_,0.08,_";

    /// The constraint on a figure of this body.
    pub fn constraint(&self, body: &Body) -> Constraint {
        let hand = |s: SegmentId| s == L_HAND || s == R_HAND;
        let point = |s: SegmentId| {
            if hand(s) {
                grip(body, s)
            } else {
                body.segment(s).com
            }
        };
        let [x, y, z] = self.position.map(|x| x.unwrap_or(0.0));
        let any = self.position.iter().any(Option::is_some);
        Constraint {
            on: self.part.map_or(Constrained::CenterOfMass, |s| {
                Constrained::Point(s, point(s))
            }),
            position: any.then_some(Vec3 { x, y, z }),
            axes: self.position.map(|x| f64::from(u8::from(x.is_some()))),
            rotation: self.rotation,
            weight: 1.0,
            ease: 0.5,
            from: self.from_s,
            to: self.to_s,
        }
    }
}

impl FromStr for ConstraintSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let (rest, turn) = match text.split_once(':') {
            Some((rest, turn)) => (rest, Some(turn)),
            None => (text, None),
        };
        let mut parts = rest.split('@');
        let (Some(name), Some(place), times, None) =
            (parts.next(), parts.next(), parts.next(), parts.next())
        else {
            return Err(form());
        };
        let part = match name.trim() {
            "com" => None,
            name => Some(segment(name)?),
        };
        let mut position = [None; 3];
        let mut given = place.split(',');
        for (p, what) in position.iter_mut().zip(["x (m)", "y (m)", "z (m)"]) {
            *p = match given.next().ok_or_else(form)?.trim() {
                "_" => None,
                text => Some(number(what, text, -1e4, 1e4)?),
            };
        }
        if given.next().is_some() {
            return Err(form());
        }
        let (from_s, to_s) = times.map_or(Ok((0.0, f64::INFINITY)), |t| interval(t, form))?;
        let rotation = turn
            .map(|t| {
                let q = t
                    .split(',')
                    .map(|c| number("quaternion", c, -1.0, 1.0))
                    .collect::<Result<Vec<_>, _>>()?;
                let q: [f64; 4] = q.try_into().map_err(|_| form())?;
                let n: f64 = q.iter().map(|c| c * c).sum();
                ((n - 1.0).abs() < 0.01)
                    .then(|| Quat::from_xyzw(q).normalized())
                    .ok_or_else(form)
            })
            .transpose()?;
        let nothing = position.iter().all(Option::is_none) && rotation.is_none();
        if nothing || (part.is_none() && rotation.is_some()) {
            return Err(form());
        }
        Ok(Self {
            part,
            position,
            rotation,
            from_s,
            to_s,
        })
    }
}

/// `KG@SEGMENT[+SEGMENT][@T0..T1]`: a load held by one or two segments, from T0 to T1 seconds; either end may be left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadSpec {
    /// Carrying segment.
    pub segment: SegmentId,
    /// Second carrying segment.
    pub second: Option<SegmentId>,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Picked up at, s.
    pub from_s: f64,
    /// Dropped at, s; infinite = never.
    pub to_s: f64,
}

impl LoadSpec {
    const FORM: &'static str =
        "KG@SEGMENT[+SEGMENT][@T0..T1], for example 3@r_hand, 8@l_hand+r_hand or 3@r_hand@1.0..2.5";

    /// The load at the segment's centre of mass; `grip`: force at one hand beyond which it slips, N.
    pub fn perturbation(&self, body: &Body, grip: f64) -> Perturbation {
        let at = |s: SegmentId| body.segment(s).com;
        Perturbation::Held(HeldLoad {
            segment: self.segment,
            point: at(self.segment),
            mass: self.mass_kg,
            velocity: Vec3::zero(),
            second: self.second.map(|s| (s, at(s))),
            grip,
            from: self.from_s,
            to: self.to_s,
        })
    }
}

impl FromStr for LoadSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let mut parts = text.split('@');
        let (Some(mass), Some(name), times, None) =
            (parts.next(), parts.next(), parts.next(), parts.next())
        else {
            return Err(form());
        };
        let (from_s, to_s) = times.map_or(Ok((0.0, f64::INFINITY)), |t| interval(t, form))?;
        let (name, second) = match name.split_once('+') {
            Some((first, second)) => (first, Some(segment(second)?)),
            None => (name, None),
        };
        let first = segment(name)?;
        if second == Some(first) {
            return Err(form());
        }
        Ok(Self {
            mass_kg: number("mass (kg)", mass, 0.0, 500.0)?,
            segment: first,
            second,
            from_s,
            to_s,
        })
    }
}

/// `NS@SEGMENT@T:x,y,z`: a push of so many newton-seconds on a segment beginning at T seconds, along the world direction x, y, z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PushSpec {
    /// Pushed segment.
    pub segment: SegmentId,
    /// Impulse, N·s.
    pub impulse_ns: f64,
    /// Begins at, s.
    pub at_s: f64,
    /// Unit vector, world axes.
    pub direction: Vec3,
}

impl PushSpec {
    const FORM: &'static str = "NS@SEGMENT@T:x,y,z, for example 20@chest@1.5:1,0,0";

    /// The push as a constant force at the segment's centre of mass for `duration` seconds.
    pub fn perturbation(&self, body: &Body, duration: f64) -> Perturbation {
        Perturbation::Force {
            segment: self.segment,
            point: body.segment(self.segment).com,
            force: self.direction * (self.impulse_ns / duration),
            from: self.at_s,
            to: self.at_s + duration,
        }
    }
}

impl FromStr for PushSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let (head, direction) = text.split_once(':').ok_or_else(form)?;
        let head: Vec<&str> = head.split('@').collect();
        let direction: Vec<&str> = direction.split(',').collect();
        let ([impulse, name, at], [x, y, z]) = (head.as_slice(), direction.as_slice()) else {
            return Err(form());
        };
        let component = |t: &str| number("direction", t, -1e6, 1e6);
        let d = Vec3 {
            x: component(x)?,
            y: component(y)?,
            z: component(z)?,
        };
        if d.norm() < 1e-9 {
            return Err(SpecError::Direction);
        }
        Ok(Self {
            impulse_ns: number("impulse (N·s)", impulse, 0.0, 1e5)?,
            segment: segment(name)?,
            at_s: number("time (s)", at, 0.0, MAX_TIME)?,
            direction: d * (1.0 / d.norm()),
        })
    }
}

/// `SHAPE:SIZE@x,y,z[,yaw][:KGkg][:vx,vy,vz]`: a thing that figures touch. With a mass it moves freely, with a velocity alone it is led,
/// else it is fixed.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstacleSpec(pub ObstacleSetup);

impl ObstacleSpec {
    const FORM: &'static str = "SHAPE:SIZE@x,y,z[,yaw°][:KGkg][:vx,vy,vz] with SHAPE:SIZE one of box:LX,LY,LZ (edges, m), sphere:R, \
                                capsule:R,L (upright; L between the centres of its ends), plane:nx,ny,nz (normal)";
    /// Friction of wood or cloth on skin and cloth.
    const FRICTION: f64 = 0.6;
}

/// Comma-separated numbers, each within ±`most`.
fn numbers(what: &'static str, text: &str, most: f64) -> Result<Vec<f64>, SpecError> {
    text.split(',')
        .map(|t| number(what, t, -most, most))
        .collect()
}

impl FromStr for ObstacleSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let form = || SpecError::Form {
            got: text.to_owned(),
            form: Self::FORM,
        };
        let vector = |v: &[f64]| match *v {
            [x, y, z] => Ok(Vec3 { x, y, z }),
            _ => Err(form()),
        };
        let (head, rest) = text.split_once('@').ok_or_else(form)?;
        let (name, size) = head.split_once(':').ok_or_else(form)?;
        let mut rest = rest.split(':');
        let place = numbers("position (m)", rest.next().unwrap_or_default(), 1e4)?;
        let (place, yaw) = match *place {
            [x, y, z] => (Vec3 { x, y, z }, 0.0),
            [x, y, z, yaw] => (Vec3 { x, y, z }, yaw),
            _ => return Err(form()),
        };
        let mut rotation = Quat::exp(Vec3::Z * yaw.to_radians());
        let length = |x: f64, least: f64| {
            let within = (least..=100.0).contains(&x);
            within.then_some(x).ok_or(SpecError::Range {
                what: "size (m)",
                value: x,
                lower: least,
                upper: 100.0,
            })
        };
        let size = numbers("size (m)", size, 1e6)?;
        let shape = match (name.trim(), &*size) {
            ("sphere", [r]) => Shape::Sphere {
                radius: length(*r, 0.005)?,
            },
            ("capsule", [r, l]) => Shape::Capsule {
                radius: length(*r, 0.005)?,
                half_length: 0.5 * length(*l, 0.0)?,
            },
            ("box", [x, y, z]) => Shape::Box {
                half: Vec3 {
                    x: 0.5 * length(*x, 0.01)?,
                    y: 0.5 * length(*y, 0.01)?,
                    z: 0.5 * length(*z, 0.01)?,
                },
            },
            ("plane", normal) => {
                let n = vector(normal)?;
                if n.norm() < 1e-9 {
                    return Err(SpecError::Direction);
                }
                rotation = onto(n * (1.0 / n.norm()));
                Shape::Plane
            }
            _ => return Err(form()),
        };
        let (mut mobility, mut velocity) = (Mobility::Fixed, Vec3::zero());
        for part in rest {
            if let Some(mass) = part.trim().strip_suffix("kg") {
                mobility = Mobility::Free(number("mass (kg)", mass, 0.01, 10_000.0)?);
            } else {
                velocity = vector(&numbers("velocity (m/s)", part, 100.0)?)?;
                if mobility == Mobility::Fixed {
                    mobility = Mobility::Led;
                }
            }
        }
        if shape == Shape::Plane && matches!(mobility, Mobility::Free(_)) {
            return Err(form());
        }
        Ok(Self(ObstacleSetup {
            name: text.to_owned(),
            shape,
            mobility,
            friction: Self::FRICTION,
            position: place,
            rotation,
            velocity,
            angular_velocity: Vec3::zero(),
        }))
    }
}

/// A rotation that turns z into the unit vector `n`.
fn onto(n: Vec3) -> Quat {
    if n.z < -1.0 + 1e-9 {
        return Quat::exp(Vec3::X * std::f64::consts::PI);
    }
    let axis = Vec3::Z.cross(n);
    Quat {
        x: axis.x,
        y: axis.y,
        z: axis.z,
        w: 1.0 + n.z,
    }
    .normalized()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn obstacles_are_read() {
        let read = |t: &str| t.parse::<ObstacleSpec>().expect(t).0;
        let seat = read("box:0.4,0.5,0.45@-0.3,0,0.225,90");
        let half = Vec3 {
            x: 0.2,
            y: 0.25,
            z: 0.225,
        };
        assert_eq!(seat.shape, Shape::Box { half });
        assert_eq!(seat.mobility, Mobility::Fixed);
        assert!((seat.rotation.rotate(Vec3::X) - Vec3::Y).norm() < 1e-12);
        let ball = read("sphere:0.11@2,0,1.3:5kg:-5,0,1");
        assert_eq!(ball.mobility, Mobility::Free(5.0));
        assert_eq!(ball.velocity.x, -5.0);
        assert_eq!(read("capsule:0.05,1@0,1,1:1,0,0").mobility, Mobility::Led);
        for n in [Vec3::X, -Vec3::Y, Vec3::Z, -Vec3::Z] {
            let text = format!("plane:{},{},{}@1,2,3", 2.0 * n.x, 2.0 * n.y, 2.0 * n.z);
            assert!((read(&text).rotation.rotate(Vec3::Z) - n).norm() < 1e-12);
        }
    }

    #[test]
    fn bad_obstacles_say_what_is_wrong() {
        for (text, says) in [
            ("box", "is not of the form"),
            ("box:1,1@0,0,0", "is not of the form"),
            ("cone:1@0,0,0", "is not of the form"),
            ("box:1,1,1@0,0", "is not of the form"),
            ("box:1,1,nan@0,0,0", "size (m): NaN is outside"),
            ("sphere:-1@0,0,0", "size (m): -1 is outside 0.005…100"),
            ("sphere:1@0,up,0", "position (m): \"up\" is not a number"),
            ("sphere:1@0,0,0:0kg", "mass (kg): 0 is outside"),
            ("sphere:1@0,0,0:1,2", "is not of the form"),
            ("plane:0,0,0@0,0,0", "no direction"),
            ("plane:0,0,1@0,0,0:3kg", "is not of the form"),
        ] {
            let error = text.parse::<ObstacleSpec>().expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }

    #[test]
    fn loads_are_read() {
        let l: LoadSpec = "3.5@r_hand".parse().expect("a load");
        assert_eq!(
            (l.mass_kg, l.segment.name(), l.from_s, l.to_s),
            (3.5, "r_hand", 0.0, f64::INFINITY)
        );
        let l: LoadSpec = "2@l_hand@1..2.5".parse().expect("a load");
        assert_eq!((l.from_s, l.to_s), (1.0, 2.5));
        let l: LoadSpec = "2@l_hand@..2".parse().expect("a load");
        assert_eq!((l.from_s, l.to_s), (0.0, 2.0));
        let l: LoadSpec = "2@l_hand@1..".parse().expect("a load");
        assert_eq!((l.from_s, l.to_s), (1.0, f64::INFINITY));
    }

    #[test]
    fn bad_loads_say_what_is_wrong() {
        for (text, says) in [
            ("3", "is not of the form"),
            ("3@r_hand@1", "is not of the form"),
            ("3@r_hand@1..2@3", "is not of the form"),
            ("x@r_hand", "mass (kg): \"x\" is not a number"),
            ("nan@r_hand", "mass (kg): NaN is outside 0…500"),
            ("-1@r_hand", "mass (kg): -1 is outside 0…500"),
            ("3@tail", "no segment is called \"tail\""),
            ("3@r_hand@2..1", "the interval 2..1 s is empty"),
        ] {
            let error = text.parse::<LoadSpec>().expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }

    #[test]
    fn pushes_are_read_and_normalised() {
        let p: PushSpec = "20@chest@1.5:0,-3,4".parse().expect("a push");
        assert_eq!(
            (p.impulse_ns, p.segment.name(), p.at_s),
            (20.0, "chest", 1.5)
        );
        assert!((p.direction.y + 0.6).abs() < 1e-15 && (p.direction.z - 0.8).abs() < 1e-15);
    }

    #[test]
    fn bad_pushes_say_what_is_wrong() {
        for (text, says) in [
            ("20@chest@1.5", "is not of the form"),
            ("20@chest:1,0,0", "is not of the form"),
            ("20@chest@1:1,0", "is not of the form"),
            ("20@chest@1:1,0,up", "direction: \"up\" is not a number"),
            ("20@chest@1:0,0,0", "no direction"),
            ("20@chest@-1:1,0,0", "time (s): -1 is outside"),
            ("inf@chest@1:1,0,0", "impulse (N·s): inf is outside"),
        ] {
            let error = text.parse::<PushSpec>().expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }

    #[derive(clap::Parser)]
    struct Tuned {
        #[arg(long, default_value = "modern")]
        controller: String,
        #[arg(long, default_value = "torque")]
        stepper: String,
        #[command(flatten)]
        paper: PaperOptions,
    }

    fn tuned(arguments: &[&str]) -> Result<ControlParams> {
        let all = ["sinew"].iter().chain(arguments);
        let t = <Tuned as clap::Parser>::try_parse_from(all)?;
        assert!(!t.controller.is_empty() && !t.stepper.is_empty());
        t.paper.params()
    }

    #[test]
    fn choices_of_the_papers_controller_start_from_the_preset() {
        assert_eq!(tuned(&[]).expect("none given"), ControlParams::default());
        let printed = tuned(&["--preset", "paper2000"]).expect("the preset");
        assert_eq!(printed, ControlParams::paper2000());
        let some = [
            "--preset",
            "paper2000",
            "--metric",
            "h2",
            "--tilt",
            "--horizon",
            "0.2",
        ];
        let want = ControlParams {
            metric: Metric::Torque,
            tilt: true,
            horizon: Some(0.2),
            ..ControlParams::paper2000()
        };
        assert_eq!(tuned(&some).expect("valid"), want);
        let off = tuned(&["--tilt=false", "--horizon", "0", "--alpha", "0.5"]).expect("valid");
        assert!(!off.tilt && off.horizon.is_none() && off.alpha == 0.5);
    }

    #[test]
    fn bad_choices_of_the_papers_controller_are_refused() {
        for bad in [
            ["--horizon", "5"],
            ["--alpha", "nan"],
            ["--metric", "H3"],
            ["--tilt=maybe", "--track-com"],
        ] {
            assert!(tuned(&bad).is_err(), "{bad:?}");
        }
        assert!(tuned(&["--preset", "paper2000", "--stepper", "torque"]).is_err());
    }
}
