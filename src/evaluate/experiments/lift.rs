//! Lifting a load with one arm: the paper's headline experiment.

use super::{ControlPair, ExperimentRecord, record};
use sinew_physics::body::angles::anatomical_angles;
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES, R_HAND};
use sinew_physics::body::{Body, Links, State};
use sinew_physics::dynamics::Terms;
use sinew_physics::figure::motion::tasks::grip;
use sinew_physics::figure::{Perturbation, StrengthScale};
use sinew_physics::motion::builtin::{LIFT_GRASP, builtin};
use sinew_physics::motion::{Clip, GRAVITY};
use sinew_physics::strength::Strength;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureKey, MotionSource, World};
use std::sync::Arc;

/// Share of the static need of 3 kg that the arm has.
const SHARE: f64 = 0.98;
/// The figure continues to hold the load after the clip has ended; total time, s.
pub const DURATION: f64 = 6.0;

/// Shoulder and elbow of the right arm.
pub fn is_arm(dof: usize) -> bool {
    DOF_NAMES[dof].starts_with("r_shoulder") || DOF_NAMES[dof].starts_with("r_elbow")
}

/// Joints that yield when the arm is too weak: hip, knee, ankle and back.
fn is_helper(dof: usize) -> bool {
    ["hip", "knee", "ankle", "waist", "thorax"]
        .iter()
        .any(|part| DOF_NAMES[dof].contains(part))
}

/// Factor on the strength of the right arm at which it has 98 % of the strength that `mass` (kg) requires, held still
/// in the clip's worst posture.
pub fn weak_arm(body: &Arc<Body>, clip: &Clip, mass: f64) -> f64 {
    SHARE * arm_use(body, &Strength::for_body(body), clip, mass)
}

/// Largest share of its strength that a joint of the right arm uses to hold `mass` (kg) still, in the clip's worst
/// posture from the grasp on.
pub fn arm_use(body: &Arc<Body>, strength: &Strength, clip: &Clip, mass: f64) -> f64 {
    let mut links = Links::new(body);
    links.add_load(R_HAND, grip(body, R_HAND), mass);
    let mut terms = Terms::default();
    let mut need = 0.0f64;
    let first = (LIFT_GRASP * clip.rate_hz()).ceil() as usize;
    for i in first..clip.len() {
        let state = State::at_rest(*clip.posture(i));
        terms.compute(&links, &state, &[], GRAVITY);
        let angles = anatomical_angles(&state.posture);
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        let muscles = StrengthScale::default().muscles(1.0);
        strength.range(&angles, &[0.0; DOF_COUNT], &muscles, &mut lower, &mut upper);
        for j in (0..DOF_COUNT).filter(|j| is_arm(*j)) {
            let tau = terms.h[6 + j];
            need = need.max(tau / upper[j]).max(tau / lower[j]);
        }
    }
    need
}

/// One lift.
#[derive(Clone, Debug)]
pub struct Lift {
    /// Load, kg.
    pub mass: f64,
    /// The run.
    pub record: ExperimentRecord,
    /// Time for which a joint of the arm was at its limit, s.
    pub arm_saturated_s: f64,
    /// Largest error of hip, knee, ankle or back, degrees, up to a fall.
    pub helpers_deg: f64,
    /// Least distance of the zero-moment point inside the polygon after the grasp, m, up to a fall; `None`: it never
    /// had one.
    pub margin: Option<f64>,
    /// Largest share of its strength that the right shoulder used.
    pub shoulder_use: f64,
}

/// The scene, before its first tick; `arm` is the factor on the strength of the right arm.
pub fn scene(body: &Arc<Body>, pair: &ControlPair, mass: f64, arm: f64) -> (World, FigureKey) {
    let clip = Arc::new(builtin(body, "lift").expect("there is a lift"));
    let mut strength = StrengthScale::default();
    for j in (0..DOF_COUNT).filter(|j| is_arm(*j)) {
        strength.dof[j] = arm;
    }
    scene_of(body, pair, mass, strength, clip)
}

/// The scene of `clip`, before its first tick.
pub(super) fn scene_of(
    body: &Arc<Body>,
    pair: &ControlPair,
    mass: f64,
    strength: StrengthScale,
    clip: Arc<Clip>,
) -> (World, FigureKey) {
    let first = clip.sample(0.0);
    let state = first.state();
    let (mut world, key) = pair.world(body, state, strength);
    let load = Perturbation::Load {
        segment: R_HAND,
        point: grip(body, R_HAND),
        mass,
        from: LIFT_GRASP,
        to: f64::INFINITY,
    };
    world.perturb(key, load).expect("loads are valid");
    let figure = world.figure_mut(key).expect("the figure was just added");
    figure.set_drive(MotionSource::Clip(ClipPlayback::new(clip, WorldTime(0.0))));
    (world, key)
}

/// Lifts `mass` kg.
pub fn lift(body: &Arc<Body>, pair: &ControlPair, mass: f64, arm: f64, panels: usize) -> Lift {
    let (mut world, key) = scene(body, pair, mass, arm);
    let at = grip(body, R_HAND);
    let record = record(&mut world, key, DURATION, panels, |_, t| {
        let loads = if t > LIFT_GRASP {
            vec![(R_HAND.index(), at, mass)]
        } else {
            Vec::new()
        };
        (loads, Vec::new())
    });
    let dt = 1.0 / pair.rate_hz;
    let mut out = Lift {
        mass,
        arm_saturated_s: 0.0,
        helpers_deg: 0.0,
        margin: None,
        shoulder_use: 0.0,
        record,
    };
    let end = out.record.fell_s.unwrap_or(f64::INFINITY);
    for s in &out.record.samples {
        if (0..DOF_COUNT).any(|j| is_arm(j) && s.saturated >> j & 1 == 1) {
            out.arm_saturated_s += dt;
        }
        if s.time_s >= end {
            continue;
        }
        for j in 0..DOF_COUNT {
            if is_helper(j) {
                out.helpers_deg = out.helpers_deg.max(s.joint_error[j].abs().to_degrees());
            }
            if DOF_NAMES[j].starts_with("r_shoulder") {
                let [t, low, high] = s.torque[j];
                let used = if t > 0.0 { t / high } else { t / low };
                out.shoulder_use = out.shoulder_use.max(used);
            }
        }
        if let (Some(z), Some([x0, x1, y0, y1]), true) = (s.zmp, s.polygon, s.time_s > LIFT_GRASP) {
            let inside = (z.x - x0).min(x1 - z.x).min(z.y - y0).min(y1 - z.y);
            out.margin = Some(out.margin.map_or(inside, |m| m.min(inside)));
        }
    }
    out
}
