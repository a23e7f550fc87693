//! World frames of trunk, head and arms split into the joints' own degrees of freedom.

use crate::body::Posture;
use crate::body::topology::{
    JOINT, Joint, L_FOREARM, L_HAND, L_UPPER_ARM, R_FOREARM, R_HAND, R_UPPER_ARM, SEGMENT_NAMES,
    SegmentId,
};
use crate::math::trig::wrapped;
use crate::math::{Quat, Vec3};
use crate::motion::filter::percentile;
use crate::reference::params::segments;

/// How the arms of a recording fit, left and right, rad.
pub(super) struct ArmFit {
    /// 95th percentile of the angle between forearm and elbow plane.
    pub off_axis: [f64; 2],
    /// Constant angle taken out of the wrist.
    pub wrist_bias: [f64; 2],
    /// Constant angle taken out of the pronation of the forearm.
    pub pronation_shift: [f64; 2],
}

/// The constant angle to take out of the `angles` of pronation, rad, so that they fit a forearm.
fn pronation_shift(angles: &[f64]) -> f64 {
    let (low, high) = (percentile(angles, 0.05), percentile(angles, 0.95));
    let (under, over) = (
        (-segments::PRONATION - low).max(0.0),
        (high - segments::PRONATION).max(0.0),
    );
    if under > 0.0 && over > 0.0 {
        0.5 * (low + high)
    } else if under.max(over) > segments::PRONATION_OUT
        || percentile(angles, 0.5).abs() > segments::PRONATION_MEDIAN
    {
        0.5 * (low + high) - segments::PRONATION_MIDDLE
    } else {
        // Take out as little as possible, and nothing if the range is as wide as a forearm's.
        let most = (2.0 * segments::PRONATION - (high - low)).max(0.0);
        (over - under).clamp(-most, most)
    }
}

/// Angles about z, x and y that turn a bent forearm to its hand, with continuity: the twist of the forearm, then the
/// two angles of the wrist.
///
/// The twist stays within π of its median: a larger one comes from a bent hand, where the twist is not defined.
fn split_hand(bent_to_hand: impl Iterator<Item = Quat>) -> Vec<[f64; 3]> {
    let mut before = 0.0f64;
    let mut out: Vec<[f64; 3]> = bent_to_hand
        .map(|q| {
            // M = Rz(α) Rx(β) Ry(γ).
            let w = q.to_mat3();
            let (sin_b, level) = (w.y.z, w.y.x.hypot(w.y.y));
            let twist = if level > segments::TWIST_DEFINED {
                (-w.y.x).atan2(w.y.y)
            } else {
                before
            };
            before += wrapped(twist - before);
            [before, sin_b.atan2(level), (-w.x.z).atan2(w.z.z)]
        })
        .collect();
    let twists: Vec<f64> = out.iter().map(|a| a[0]).collect();
    let median = percentile(&twists, 0.5);
    let middle = wrapped(median);
    for a in &mut out {
        a[0] = middle + wrapped(a[0] - middle);
    }
    out
}

/// World frames of the upper body per sample, ready to be split into joints.
pub(super) struct Joints {
    pub pelvis: Vec<Quat>,
    pub abdomen: Vec<Quat>,
    pub chest: Vec<Quat>,
    pub head: Option<Vec<Quat>>,
    pub upper_arm: [Vec<Quat>; 2],
    /// Direction from elbow to wrist.
    pub forearm_axis: [Vec<Vec3>; 2],
    pub hand: [Vec<Quat>; 2],
    pub has_hand: [bool; 2],
}

const UPPER_ARM: [SegmentId; 2] = [L_UPPER_ARM, R_UPPER_ARM];
const FOREARM: [SegmentId; 2] = [L_FOREARM, R_FOREARM];
const HAND: [SegmentId; 2] = [L_HAND, R_HAND];

fn ball(s: SegmentId) -> usize {
    match JOINT[s.index()] {
        Joint::Ball(b) => b,
        _ => unreachable!("{} is a ball joint", SEGMENT_NAMES[s.index()]),
    }
}

fn hinge(s: SegmentId) -> usize {
    match JOINT[s.index()] {
        Joint::Hinge1(h) | Joint::Hinge2(h) => h,
        _ => unreachable!("{} is a hinge", SEGMENT_NAMES[s.index()]),
    }
}

impl Joints {
    /// Joint positions; legs are left at zero.
    pub(super) fn postures(&self, pelvis_path: &[Vec3]) -> (Vec<Posture>, ArmFit) {
        use crate::body::topology::{ABDOMEN, CHEST, HEAD};
        let n = pelvis_path.len();
        let mut out = vec![Posture::default(); n];
        let mut fit = ArmFit {
            off_axis: [0.0; 2],
            wrist_bias: [0.0; 2],
            pronation_shift: [0.0; 2],
        };
        for (i, p) in out.iter_mut().enumerate() {
            p.root_position = pelvis_path[i];
            p.root_rotation = self.pelvis[i];
            p.ball[ball(ABDOMEN)] = self.pelvis[i].conjugate() * self.abdomen[i];
            p.ball[ball(CHEST)] = self.abdomen[i].conjugate() * self.chest[i];
            if let Some(head) = &self.head {
                p.ball[ball(HEAD)] = self.chest[i].conjugate() * head[i];
            }
        }
        for s in 0..2 {
            // Sign of the axes about z (pronation) and x (wrist flexion): left −, right +.
            let m = if s == 0 { -1.0 } else { 1.0 };
            let (elbow, wrist) = (hinge(FOREARM[s]), hinge(HAND[s]));
            let mut off_axis = Vec::with_capacity(n);
            let mut bent = Vec::with_capacity(n);
            for (i, p) in out.iter_mut().enumerate() {
                let upper = self.upper_arm[s][i];
                p.ball[ball(UPPER_ARM[s])] = self.chest[i].conjugate() * upper;
                let d = upper.conjugate().rotate(self.forearm_axis[s][i]);
                let flexion = d.x.atan2(-d.z);
                off_axis.push(d.y.abs().clamp(0.0, 1.0).asin());
                p.hinge[elbow] = flexion;
                bent.push((upper * Quat::exp(Vec3::Y * -flexion)).conjugate());
            }
            fit.off_axis[s] = percentile(&off_axis, 0.95);
            let hand = |off: f64| {
                let back = Quat::exp(Vec3::Z * -off);
                split_hand(bent.iter().zip(&self.hand[s]).map(|(b, q)| *b * *q * back))
            };
            let mut angles = hand(0.0);
            let shift = pronation_shift(&angles.iter().map(|a| m * a[0]).collect::<Vec<_>>());
            if shift != 0.0 {
                angles = hand(m * shift);
            }
            fit.pronation_shift[s] = shift;
            for (p, [twist, flexion, deviation]) in out.iter_mut().zip(angles) {
                p.hinge[elbow + 1] = m * twist;
                if self.has_hand[s] {
                    p.hinge[wrist] = m * flexion;
                    p.hinge[wrist + 1] = -deviation;
                }
            }
            for (h, most) in [
                (wrist, segments::WRIST_FLEXION),
                (wrist + 1, segments::WRIST_DEVIATION),
            ] {
                let angles: Vec<f64> = out.iter().map(|p| p.hinge[h]).collect();
                let median = percentile(&angles, 0.5);
                let bias = median - median.clamp(-most, most);
                out.iter_mut().for_each(|p| p.hinge[h] -= bias);
                fit.wrist_bias[s] = fit.wrist_bias[s].max(bias.abs());
            }
        }
        (out, fit)
    }
}
