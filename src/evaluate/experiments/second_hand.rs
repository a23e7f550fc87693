//! The second hand: a lift with one hand, of loads that are too heavy for one arm.

use super::{ControlPair, ExperimentRecord, record};
use sinew_physics::body::topology::{DOF_NAMES, R_HAND};
use sinew_physics::body::{Body, SegmentId};
use sinew_physics::dynamics::Kinematics;
use sinew_physics::figure::{FigureEvent, HeldLoad, Perturbation, SecondHand, StrengthScale};
use sinew_physics::math::Vec3;
use sinew_physics::motion::builtin::{LIFT_GRASP, builtin};
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, Figure, MotionSource};
use std::sync::Arc;

/// Loads of the ladder, kg.
pub const LADDER: [f64; 6] = [1.0, 2.0, 3.0, 5.0, 8.0, 12.0];
/// The lift and two seconds of holding, s.
const DURATION: f64 = 6.0;
/// Time at the end over which the hold is judged, s.
const JUDGED: f64 = 1.0;

/// The result of one load.
#[derive(Clone, Debug, Default)]
pub struct Rung {
    /// The run.
    pub record: ExperimentRecord,
    /// `None` unless the other hand held the load at the end: the time at which it took hold (s), and the share of its
    /// strength that the arm needs alone and with help.
    pub shared: Option<(f64, [f64; 2])>,
    /// Share of the other hand at the end.
    pub share: f64,
    /// Over the last second: depth of the right hand below its place in the motion, m.
    pub below: f64,
    /// Over the last second: largest mean share of its strength that a joint of an arm uses.
    pub arm_use: f64,
    /// Largest distance of the left palm from the right one while both hold, m.
    pub apart: f64,
}

fn is_arm(dof: usize) -> bool {
    ["shoulder", "elbow", "wrist"]
        .iter()
        .any(|joint| DOF_NAMES[dof].contains(joint))
}

/// Height of a point of a segment, m.
fn height(figure: &Figure, kin: &mut Kinematics, desired: bool, at: (SegmentId, Vec3)) -> Vec3 {
    let posture = if desired {
        &figure.target().next.posture
    } else {
        &figure.state().posture
    };
    kin.set_posture(figure.links(), posture);
    let s = at.0.index();
    posture.root_position + kin.position[s] + kin.rotation[s] * at.1
}

/// Lifts `mass` kg with the right hand; the left one helps according to `when`.
pub fn rung(
    body: &Arc<Body>,
    pair: &ControlPair,
    mass: f64,
    when: Option<SecondHand>,
    panels: usize,
) -> Rung {
    let clip = Arc::new(builtin(body, "lift").expect("there is a lift"));
    let (mut world, key) = pair.world(body, clip.sample(0.0).state(), StrengthScale::default());
    let at = sinew_physics::body::palm::load_point(body, R_HAND);
    let load = HeldLoad {
        segment: R_HAND,
        point: at,
        mass,
        velocity: Vec3::zero(),
        second: None,
        grip: f64::INFINITY,
        from: LIFT_GRASP,
        to: f64::INFINITY,
    };
    let load = match when {
        None => Perturbation::Held(load),
        Some(when) => Perturbation::Helped { load, when },
    };
    world.perturb(key, load).expect("loads are valid");
    let figure = world.figure_mut(key).expect("the figure was just added");
    figure.set_drive(MotionSource::Clip(ClipPlayback::new(clip, WorldTime(0.0))));
    let mut out = Rung::default();
    let mut kin = Kinematics::default();
    let (mut below, mut count) = (0.0, 0.0);
    out.record = record(&mut world, key, DURATION, panels, |w, t| {
        let f = w.figure(key).expect("nobody removes the figure");
        for event in f.events() {
            match *event {
                FigureEvent::LoadShared { need, .. } => out.shared = Some((t, need)),
                FigureEvent::LoadUnshared { .. } => out.shared = None,
                _ => {}
            }
        }
        let hand = height(f, &mut kin, false, (R_HAND, at));
        if t > DURATION - JUDGED {
            below += height(f, &mut kin, true, (R_HAND, at)).z - hand.z;
            count += 1.0;
        }
        out.share = f.help().map_or(0.0, |h| h.share);
        if let Some(help) = f.help() {
            let other = height(f, &mut kin, false, (help.hand, help.point));
            out.apart = out.apart.max((other - hand).norm());
        }
        let held = (R_HAND.index(), at, mass);
        (Vec::from_iter((t > LIFT_GRASP).then_some(held)), Vec::new())
    });
    out.below = below / f64::max(count, 1.0);
    let last: Vec<_> = (out.record.samples.iter())
        .filter(|s| s.time_s > DURATION - JUDGED)
        .collect();
    for d in (0..DOF_NAMES.len()).filter(|d| is_arm(*d)) {
        let used = last.iter().map(|s| {
            let [t, low, high] = s.torque[d];
            if t > 0.0 { t / high } else { t / low }
        });
        let mean = used.sum::<f64>() / last.len().max(1) as f64;
        out.arm_use = out.arm_use.max(mean);
    }
    out
}
