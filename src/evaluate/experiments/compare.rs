//! Controllers against each other: the same motions, loads and pushes for every pair of controller and stepper.

use super::{ControlPair, carried, push_at_chest};
use sinew_physics::body::Body;
use sinew_physics::body::topology::DOF_COUNT;
use sinew_physics::collide::{Mobility, ObstacleSetup, Shape};
use sinew_physics::figure::{StrengthScale, TickReport};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::Clip;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureKey, MotionSource, World};
use std::sync::Arc;

/// A push begins at this time and lasts this long, s.
const PUSH: (f64, f64) = (1.0, 0.1);
/// Time for which the figure is watched beyond the end of the clip, s.
const AFTERWARDS: f64 = 1.0;

/// Loads that are compared: kg, and whether in two hands, half in each.
pub const LOADS: [(f64, bool); 7] = [
    (0.0, false),
    (2.0, false),
    (5.0, false),
    (10.0, false),
    (2.0, true),
    (5.0, true),
    (10.0, true),
];
/// Pushes that are compared, N·s.
pub const IMPULSES: [f64; 3] = [10.0, 20.0, 30.0];

/// A motion, with the seat or prop that it requires.
#[derive(Clone, Debug)]
pub struct ComparedMotion {
    /// Its name.
    pub name: String,
    /// The motion.
    pub clip: Arc<Clip>,
    /// Its seat.
    pub seat: Option<ObstacleSetup>,
    /// Length of the compared part, s.
    pub seconds: f64,
}

impl ComparedMotion {
    /// The whole of `clip`, called `name`, and a second afterwards. The recording called `sit-stand` gets the stool
    /// that it lacks, at the place where it sits: under the pelvis, and as high as a rigid stool can be there. It ends
    /// where it begins to walk away, since the outcome of that depends on luck (docs/limits.md).
    pub fn new(name: &str, clip: Arc<Clip>) -> Self {
        let sits = name == "sit-stand";
        let half = Vec3 {
            x: 0.17,
            y: 0.17,
            z: 0.175,
        };
        let seat = ObstacleSetup {
            name: "stool".into(),
            shape: Shape::Box { half },
            mobility: Mobility::Fixed,
            friction: 0.8,
            position: Vec3 {
                x: 0.41,
                y: 0.54,
                z: half.z,
            },
            rotation: Quat::from_axis_angle(Vec3::Z, -51f64.to_radians()),
            velocity: Vec3::zero(),
            angular_velocity: Vec3::zero(),
        };
        Self {
            name: name.to_owned(),
            seconds: if sits {
                8.0
            } else {
                clip.duration() + AFTERWARDS
            },
            seat: sits.then_some(seat),
            clip,
        }
    }
}

/// The load or push that is added to a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Burden {
    /// Mass in the right hand, or half of it in each hand, kg.
    Load(f64, bool),
    /// Impulse at the chest, N·s.
    Push(Vec3),
}

/// The result; errors are those before a fall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ComparedOutcome {
    /// Time at which it fell, s.
    pub fell_s: Option<f64>,
    /// Ticks that were measured.
    pub ticks: u32,
    /// Sum over the ticks of the mean square error of the joints, rad².
    pub joints: f64,
    /// Sum of the square distance of the centre of mass from the desired one, m².
    pub com: f64,
    /// Sum of the changes of torque from tick to tick, as a share of the range, for joints at their limit before or
    /// after, and the number of such changes.
    pub chatter: (f64, u32),
}

impl ComparedOutcome {
    /// Joint error, rms, degrees.
    pub fn joints_deg(&self) -> f64 {
        (self.joints / f64::from(self.ticks.max(1)))
            .sqrt()
            .to_degrees()
    }
    /// Error of the centre of mass, rms, mm.
    pub fn com_mm(&self) -> f64 {
        1e3 * (self.com / f64::from(self.ticks.max(1))).sqrt()
    }
    /// Mean change of torque of a saturated joint from tick to tick, as a share of its range; `None` if none was ever
    /// saturated.
    pub fn chatter(&self) -> Option<f64> {
        let (sum, count) = self.chatter;
        (count > 0).then(|| sum / f64::from(count))
    }
    /// Adds another result; the earlier fall counts.
    pub fn add(&mut self, other: &Self) {
        self.fell_s = match (self.fell_s, other.fell_s) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        self.ticks += other.ticks;
        self.joints += other.joints;
        self.com += other.com;
        self.chatter.0 += other.chatter.0;
        self.chatter.1 += other.chatter.1;
    }

    fn observe(&mut self, r: &TickReport, before: &mut ([f64; DOF_COUNT], u64)) {
        let mean = r.joints.joint_error.iter().map(|e| e * e).sum::<f64>() / DOF_COUNT as f64;
        let off = r.balance.com - r.balance.com_desired;
        if self.ticks > 0 {
            let at_limit = r.joints.saturated | before.1;
            for j in (0..DOF_COUNT).filter(|j| at_limit >> j & 1 == 1) {
                let range = r.joints.torque_upper[j] - r.joints.torque_lower[j];
                self.chatter.0 += (r.joints.torque[j] - before.0[j]).abs() / range;
                self.chatter.1 += 1;
            }
        }
        *before = (r.joints.torque, r.joints.saturated);
        self.ticks += 1;
        self.joints += mean;
        self.com += off.dot(off);
    }
}

fn scene(
    body: &Arc<Body>,
    pair: &ControlPair,
    motion: &ComparedMotion,
    burden: Burden,
) -> (World, FigureKey) {
    let state = motion.clip.sample(0.0).state();
    let (mut world, key) = pair.world(body, state, StrengthScale::default());
    if let Some(seat) = &motion.seat {
        world.add_obstacle(seat.clone()).expect("seats are valid");
    }
    let figure = world.figure_mut(key).expect("the figure was just added");
    let play = ClipPlayback::new(Arc::clone(&motion.clip), WorldTime(0.0));
    figure.set_drive(MotionSource::Clip(play));
    let what = match burden {
        Burden::Load(0.0, _) => Vec::new(),
        Burden::Load(mass, both) => carried(body, mass, both),
        Burden::Push(impulse) => vec![push_at_chest(impulse * (1.0 / PUSH.1), PUSH.0, PUSH.1)],
    };
    for p in what {
        world.perturb(key, p).expect("loads and pushes are valid");
    }
    (world, key)
}

/// Makes one run, to its end or a fall. `step` makes a tick, and may time it.
pub fn compare(
    body: &Arc<Body>,
    pair: &ControlPair,
    motion: &ComparedMotion,
    burden: Burden,
    step: &mut dyn FnMut(&mut World),
) -> ComparedOutcome {
    let (mut world, key) = scene(body, pair, motion, burden);
    let mut out = ComparedOutcome::default();
    let mut before = ([0.0; DOF_COUNT], 0);
    let ticks = (motion.seconds * pair.rate_hz).round() as u64;
    for _ in 0..ticks {
        step(&mut world);
        let figure = world.figure(key).expect("nobody removes the figure");
        if figure.is_fallen() {
            out.fell_s = Some(world.time().0);
            break;
        }
        let report = figure.report().expect("a stepped figure has a report");
        out.observe(report, &mut before);
    }
    out
}
