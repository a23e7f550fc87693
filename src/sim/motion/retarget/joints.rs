//! World frames of trunk, head and arms split into the joints' own degrees of freedom.

use crate::sim::body::Posture;
use crate::sim::body::topology::{
    JOINT, Joint, L_FOREARM, L_HAND, L_UPPER_ARM, R_FOREARM, R_HAND, R_UPPER_ARM, SEGMENT_NAMES,
    SegmentId,
};
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::filter::percentile;
use crate::sim::motion::foot_lock::turn;

/// Largest median wrist deviation and flexion that are believed, rad: hand markers are few, so a hand's rest pose is often off.
const WRIST_BIAS: (f64, f64) = (0.15, 0.6);

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
    /// Joint positions; legs are left at zero. Also, per side, the 95th percentile of the angle between forearm and elbow plane and
    /// the bias that was taken out of the wrist.
    pub(super) fn postures(&self, pelvis_path: &[Vec3]) -> (Vec<Posture>, [f64; 2], [f64; 2]) {
        use crate::sim::body::topology::{ABDOMEN, CHEST, HEAD};
        let n = pelvis_path.len();
        let mut out = vec![Posture::default(); n];
        let mut off_axis: [Vec<f64>; 2] = Default::default();
        let mut wrist_bias = [0.0f64; 2];
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
            let mut before = 0.0f64;
            for (i, p) in out.iter_mut().enumerate() {
                let upper = self.upper_arm[s][i];
                p.ball[ball(UPPER_ARM[s])] = self.chest[i].conjugate() * upper;
                let d = upper.conjugate().rotate(self.forearm_axis[s][i]);
                let flexion = d.x.atan2(-d.z);
                off_axis[s].push(d.y.abs().clamp(0.0, 1.0).asin());
                p.hinge[elbow] = flexion;
                // Forearm twist, then wrist: M = Rz(α) Rx(β) Ry(γ).
                let bent = upper * Quat::exp(Vec3::Y * -flexion);
                let w = (bent.conjugate() * self.hand[s][i]).to_mat3();
                let (sin_b, level) = (w.y.z, w.y.x.hypot(w.y.y));
                let beta = sin_b.atan2(level);
                // A hand bent by 90° leaves the twist undefined: hold it.
                let twist = if level > 0.2 {
                    (-w.y.x).atan2(w.y.y)
                } else {
                    before
                };
                let twist = before + turn(before, twist);
                before = twist;
                p.hinge[elbow + 1] = m * twist;
                if self.has_hand[s] {
                    p.hinge[wrist] = m * beta;
                    p.hinge[wrist + 1] = -(-w.x.z).atan2(w.z.z);
                }
            }
            for (h, most) in [(wrist, WRIST_BIAS.1), (wrist + 1, WRIST_BIAS.0)] {
                let angles: Vec<f64> = out.iter().map(|p| p.hinge[h]).collect();
                let median = percentile(&angles, 0.5);
                let bias = median - median.clamp(-most, most);
                out.iter_mut().for_each(|p| p.hinge[h] -= bias);
                wrist_bias[s] = wrist_bias[s].max(bias.abs());
            }
        }
        (
            out,
            [
                percentile(&off_axis[0], 0.95),
                percentile(&off_axis[1], 0.95),
            ],
            wrist_bias,
        )
    }
}
