//! Orientation of the segments: their frames from end points, hinge planes, and bones relative to a calibration pose.

use super::scene::RecordedScene;
use crate::math::curve::rise;
use crate::math::{Mat3, Quat, Vec3};
use crate::motion::filter::percentile;
use crate::motion::skeleton_map::SkeletonMap;
use crate::reference::params::{root, segments};

/// How bones carry segments.
pub(super) struct Calibration {
    /// Whether the calibration uses the file's zero pose rather than samples of the motion.
    pub from_rest: bool,
    /// The calibration poses.
    pub poses: Vec<CalibrationPose>,
}

/// A pose in which the orientations of the segments are known.
#[derive(Clone, Copy)]
pub(super) struct CalibrationPose {
    /// Sample of the motion; `None`: the zero pose of the file.
    pub sample: Option<usize>,
    /// The figure's frame in that pose: x forward, y left, z up.
    pub figure: Quat,
}

/// A limb of two bones with a hinge between them, given by its joints.
#[derive(Clone, Copy)]
struct TwoBoneLimb {
    upper: usize,
    middle: usize,
    lower: usize,
    /// +1 for a knee (flexion about +y), −1 for an elbow (about −y).
    sense: f64,
}

/// The bone of a foot, given by its points.
#[derive(Clone, Copy)]
pub(super) struct FootBone {
    pub ankle: usize,
    pub toe: usize,
    /// Whether `toe` is the tip of the toes, not their joint.
    pub is_tip: bool,
}

/// Height of the ankle over the toe joint, and over the tip of the toes, on a flat foot, in leg lengths.
const ANKLE_OVER_TOE: [f64; 2] = [
    root::ANKLE_HEIGHT - root::TOE_JOINT_HEIGHT,
    root::ANKLE_HEIGHT - root::TOE_TIP_HEIGHT,
];

/// Mean of rotations that are roughly alike; those far from the others have less weight. The identity if there are
/// none.
pub(super) fn mean_rotation(rotations: &[Quat]) -> Quat {
    let mut mean = match rotations {
        [] => return Quat::identity(),
        [only] => return *only,
        [first, ..] => *first,
    };
    for round in 0..8 {
        let turns: Vec<Vec3> = rotations
            .iter()
            .map(|q| (mean.conjugate() * *q).log())
            .collect();
        let usual = percentile(&turns.iter().map(|t| t.norm()).collect::<Vec<_>>(), 0.5).max(1e-3);
        let (mut sum, mut weights) = (Vec3::zero(), 0.0);
        for t in &turns {
            // The first rounds only find the middle.
            let w = if round < 2 {
                1.0
            } else {
                1.0 / (1.0 + (t.norm() / usual).powi(2))
            };
            sum += *t * w;
            weights += w;
        }
        mean = (mean * Quat::exp(sum * (1.0 / weights))).normalized();
    }
    mean
}

/// Middle of the hips, m, and `world_from_pelvis`, per sample.
pub(super) struct PelvisPath {
    pub places: Vec<Vec3>,
    pub rotations: Vec<Quat>,
}

/// Segment frames per sample.
pub(super) struct SegmentFrames {
    pub abdomen: Vec<Quat>,
    pub chest: Vec<Quat>,
    pub head: Option<Vec<Quat>>,
    pub upper_arm: [Vec<Quat>; 2],
    pub forearm: [Vec<Vec3>; 2],
    pub hand: [Vec<Quat>; 2],
    pub knee_axis: [Vec<Vec3>; 2],
    pub knee_off_axis: [f64; 2],
}

/// Rotation whose columns are x = y × z, y (towards `left`, made normal to `up`), z = `up`.
pub(super) fn frame_of(up: Vec3, left: Vec3) -> Quat {
    let z = up.normalized_or(Vec3::Z);
    let y = (left - z * left.dot(z)).normalized_or(if z.y.abs() < 0.9 { Vec3::Y } else { Vec3::X });
    let y = (y - z * y.dot(z)).normalized_or(Vec3::X);
    Quat::from_mat3(&Mat3 {
        x: y.cross(z),
        y,
        z,
    })
}

/// Shortest rotation that takes unit vector `a` to unit vector `b`.
pub(super) fn shortest(a: Vec3, b: Vec3) -> Quat {
    let c = a.cross(b);
    let s = c.norm();
    if s < 1e-9 {
        if a.dot(b) > 0.0 {
            return Quat::identity();
        }
        let side = if a.x.abs() < 0.9 { Vec3::X } else { Vec3::Y };
        return Quat::exp(a.cross(side).normalized_or(Vec3::Y) * std::f64::consts::PI);
    }
    Quat::exp(c * (s.atan2(a.dot(b)) / s))
}

impl RecordedScene<'_> {
    /// Chooses the calibration pose.
    pub(super) fn calibrate(&self, map: &SkeletonMap) -> Calibration {
        let rest = |j: usize| self.rest[self.take.at(j)];
        let [l, r] = map.sides;
        let mid = |a: Vec3, b: Vec3| (a + b) * 0.5;
        let pose = |at: &dyn Fn(usize) -> Vec3| {
            let trunk = mid(at(l.upper_arm), at(r.upper_arm)) - mid(at(l.thigh), at(r.thigh));
            let up = trunk.normalized_or(Vec3::Z);
            let across = at(l.thigh) - at(r.thigh);
            let left = across.normalized_or(Vec3::Y);
            let down = |a: usize, b: usize| (at(b) - at(a)).normalized_or(Vec3::zero()).dot(-up);
            let legs = [
                (l.thigh, l.shank),
                (l.shank, l.foot),
                (r.thigh, r.shank),
                (r.shank, r.foot),
            ]
            .into_iter()
            .map(|(a, b)| down(a, b))
            .fold(f64::INFINITY, f64::min);
            (trunk, up, left, across, legs)
        };
        let (trunk, up, left, across, legs) = pose(&rest);
        let standing = trunk.norm() > 1e-9
            && across.norm() > 1e-9
            && legs > 0.75
            && left.dot(up).abs() < 0.3
            && (rest(l.upper_arm) - rest(r.upper_arm)).dot(left) > 0.0;
        if standing {
            // A trunk that leans only a little from a file axis was drawn along that axis.
            let axis = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z]
                .into_iter()
                .find(|a| a.dot(up) > 0.95);
            return Calibration {
                from_rest: true,
                poses: vec![CalibrationPose {
                    sample: None,
                    figure: frame_of(axis.unwrap_or(up), left),
                }],
            };
        }
        let upright: Vec<f64> = (0..self.count)
            .map(|i| {
                let at = |j: usize| self.place(j)[i];
                let (_, up, _, _, legs) = pose(&at);
                up.z + 0.5 * legs
            })
            .collect();
        let most = upright.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let samples: Vec<usize> = (0..self.count)
            .filter(|i| upright[*i] >= most - segments::UPRIGHT_RANGE)
            .collect();
        let stride = samples.len().div_ceil(segments::MOST_POSES).max(1);
        let poses = samples
            .into_iter()
            .step_by(stride)
            .map(|i| {
                let at = |j: usize| self.place(j)[i];
                let (_, up, left, _, _) = pose(&at);
                CalibrationPose {
                    sample: Some(i),
                    figure: frame_of(if up.z > 0.85 { Vec3::Z } else { up }, left),
                }
            })
            .collect();
        Calibration {
            from_rest: false,
            poses,
        }
    }

    /// Rotation of a bone in a calibration pose.
    fn turn_in(&self, joint: usize, pose: Option<usize>) -> Quat {
        pose.map_or(self.basis, |i| self.turn(joint)[i])
    }

    /// A rotation or direction given for each calibration pose, as a rotation in the bone `joint`, averaged over the
    /// poses.
    ///
    /// `figure_from_segment`: of a pose, in the axes of its figure.
    fn bone_from_segment(
        &self,
        joint: usize,
        calibration: &Calibration,
        figure_from_segment: impl Fn(CalibrationPose) -> Quat,
    ) -> Quat {
        let of = |&pose: &CalibrationPose| {
            let bone = self.turn_in(joint, pose.sample);
            bone.conjugate() * pose.figure * figure_from_segment(pose)
        };
        mean_rotation(&calibration.poses.iter().map(of).collect::<Vec<_>>())
    }

    /// Segment frame per sample from a bone's rotation and the segment's frame in a calibration pose, in the axes of
    /// the figure.
    pub(super) fn follow(
        &self,
        joint: usize,
        calibration: &Calibration,
        figure_from_segment: impl Fn(CalibrationPose) -> Quat,
    ) -> Vec<Quat> {
        let bone_from_segment = self.bone_from_segment(joint, calibration, figure_from_segment);
        let turns = self.turn(joint).iter();
        turns
            .map(|q| (*q * bone_from_segment).normalized())
            .collect()
    }

    /// The same for a segment whose frame in the calibration pose is that of the figure.
    fn follow_upright(&self, joint: usize, calibration: &Calibration) -> Vec<Quat> {
        self.follow(joint, calibration, |_| Quat::identity())
    }

    /// Direction of a bone in a calibration pose, figure axes.
    pub(super) fn calibrated_direction(
        &self,
        from: usize,
        to: usize,
        pose: CalibrationPose,
    ) -> Vec3 {
        let d = match pose.sample {
            None => self.rest[self.take.at(to)] - self.rest[self.take.at(from)],
            Some(i) => self.place(to)[i] - self.place(from)[i],
        };
        pose.figure.conjugate().rotate(d).normalized_or(-Vec3::Z)
    }

    /// Foot in a calibration pose, figure axes: x along the line from ankle to `toe`, level where that line falls as
    /// steeply as on the flat foot of a person with this length of `leg`, m. The zero pose of the file has flat feet.
    pub(super) fn foot_in_pose(&self, bone: FootBone, pose: CalibrationPose, leg: f64) -> Quat {
        let FootBone {
            ankle: foot,
            toe,
            is_tip,
        } = bone;
        let ahead = self.calibrated_direction(foot, toe, pose);
        let level = ahead.x.hypot(ahead.y);
        let yaw = if level > 0.2 {
            ahead.y.atan2(ahead.x)
        } else {
            0.0
        };
        let heading = Quat::exp(Vec3::Z * yaw);
        let Some(i) = pose.sample else {
            return heading;
        };
        let length = (self.place(toe)[i] - self.place(foot)[i]).norm();
        let falls = (ANKLE_OVER_TOE[usize::from(is_tip)] * leg / length.max(1e-9))
            .min(0.8)
            .asin();
        heading * Quat::exp(Vec3::Y * (-ahead.z.atan2(level) - falls))
    }

    pub(super) fn pelvis(&self, map: &SkeletonMap, calibration: &Calibration) -> PelvisPath {
        let [l, r] = map.sides;
        let centre = (0..self.count)
            .map(|i| (self.place(l.thigh)[i] + self.place(r.thigh)[i]) * 0.5)
            .collect();
        let mut turn = self.follow_upright(map.pelvis, calibration);
        // The line of the hips is more reliable than the bone's calibration: take the mean difference out.
        let mut sum = Vec3::zero();
        for i in 0..self.count {
            sum += turn[i]
                .conjugate()
                .rotate(self.place(l.thigh)[i] - self.place(r.thigh)[i]);
        }
        let correct = shortest(Vec3::Y, sum.normalized_or(Vec3::Y));
        for q in &mut turn {
            *q = *q * correct;
        }
        PelvisPath {
            places: centre,
            rotations: turn,
        }
    }

    /// Hinge axis (towards the left, before any twist) of a two-bone limb per sample, and the off-axis angle of the
    /// lower bone.
    fn hinge_axis(&self, limb: TwoBoneLimb, calibration: &Calibration) -> (Vec<Vec3>, Vec<f64>) {
        let TwoBoneLimb {
            upper,
            middle,
            lower,
            sense,
        } = limb;
        let (a, b, c) = (self.place(upper), self.place(middle), self.place(lower));
        let turn = self.turn(upper);
        let normal = |i: usize| {
            let u = (b[i] - a[i]).normalized_or(-Vec3::Z);
            let v = (c[i] - b[i]).normalized_or(u);
            let n = u.cross(v) * sense;
            (u, n, n.norm().atan2(u.dot(v)))
        };
        let mut mean = Vec3::zero();
        let mut weight = 0.0;
        for (i, q) in turn.iter().enumerate() {
            let (_, n, bend) = normal(i);
            if bend > segments::PLANE_LEAST && bend < 2.8 {
                let w = n.norm();
                mean += q.conjugate().rotate(n);
                weight += w;
            }
        }
        // The axis shown by the bent samples, if there are enough of them and they agree; else that of the calibration
        // pose.
        let seen = weight > 0.3 * 0.1 * self.rate && mean.norm() > 0.8 * weight;
        let local = if seen {
            mean.normalized_or(Vec3::Y)
        } else {
            let of = |&at: &CalibrationPose| {
                let direction = self.calibrated_direction(upper, middle, at);
                let axis = at
                    .figure
                    .rotate(shortest(-Vec3::Z, direction).rotate(Vec3::Y));
                self.turn_in(upper, at.sample).conjugate().rotate(axis)
            };
            let sum = calibration
                .poses
                .iter()
                .map(of)
                .fold(Vec3::zero(), |s, v| s + v);
            sum.normalized_or(Vec3::Y)
        };
        let mut axis = Vec::with_capacity(self.count);
        let mut off = Vec::new();
        for (i, q) in turn.iter().enumerate() {
            let (u, n, bend) = normal(i);
            let own = q.rotate(local);
            let own = (own - u * own.dot(u)).normalized_or(Vec3::Y);
            let plane = n.normalized_or(own);
            let agree = plane.dot(own);
            if bend > segments::PLANE_LEAST {
                let v = (c[i] - b[i]).normalized_or(u);
                off.push(v.dot(own).abs().clamp(0.0, 1.0).asin());
            }
            let w = rise(bend, (segments::PLANE_NOISE, segments::PLANE_TRUSTED))
                * (1.0 - rise(bend, (2.6, 2.9)))
                * rise(agree, (0.3, 0.7));
            axis.push((own * (1.0 - w) + plane * w).normalized_or(own));
        }
        (axis, off)
    }

    pub(super) fn frames(&self, map: &SkeletonMap, calibration: &Calibration) -> SegmentFrames {
        let chest_bone = map.trunk.last().copied().unwrap_or(map.pelvis);
        let chest = self.follow_upright(chest_bone, calibration);
        let pelvis = self.pelvis(map, calibration).rotations;
        let abdomen = if map.trunk.len() >= 2 {
            self.follow_upright(map.trunk[map.abdomen], calibration)
        } else {
            // One bone bends the trunk: both joints of the body share it.
            pelvis
                .iter()
                .zip(&chest)
                .map(|(p, c)| p.slerp(*c, 0.5))
                .collect()
        };
        let head = map.head.map(|h| self.follow_upright(h, calibration));
        let mut knee_off_axis = [0.0; 2];
        let knee_axis = [0, 1].map(|s| {
            let m = &map.sides[s];
            let leg = TwoBoneLimb {
                upper: m.thigh,
                middle: m.shank,
                lower: m.foot,
                sense: 1.0,
            };
            let (axis, off) = self.hinge_axis(leg, calibration);
            knee_off_axis[s] = percentile(&off, 0.95);
            axis
        });
        let mut upper_arm: [Vec<Quat>; 2] = Default::default();
        let mut forearm: [Vec<Vec3>; 2] = Default::default();
        let mut hand: [Vec<Quat>; 2] = Default::default();
        for s in 0..2 {
            let m = &map.sides[s];
            let wrist = self
                .take
                .wrist(m)
                .expect("measured before: every forearm has an end");
            let (shoulder, elbow) = (self.place(m.upper_arm), self.place(m.forearm));
            let hand_place = self.place(wrist);
            forearm[s] = (0..self.count)
                .map(|i| (hand_place[i] - elbow[i]).normalized_or(-Vec3::Z))
                .collect();
            let arm = TwoBoneLimb {
                upper: m.upper_arm,
                middle: m.forearm,
                lower: wrist,
                sense: -1.0,
            };
            let axis = self.hinge_axis(arm, calibration).0;
            upper_arm[s] = (0..self.count)
                .map(|i| frame_of(shoulder[i] - elbow[i], axis[i]))
                .collect();
            let bone = m.hand.unwrap_or(m.forearm);
            // A hand that hangs in a sample of the motion is assumed to have the usual pronation of hanging hands.
            let sign = if s == 0 { -1.0 } else { 1.0 };
            let hangs = Quat::exp(Vec3::Z * (sign * segments::PRONATION_MIDDLE));
            hand[s] = self.follow(bone, calibration, |pose| {
                let direction = self.calibrated_direction(m.forearm, wrist, pose);
                let straight = shortest(-Vec3::Z, direction);
                if pose.sample.is_some() && direction.z < -segments::HANGING {
                    straight * hangs
                } else {
                    straight
                }
            });
        }
        SegmentFrames {
            abdomen,
            chest,
            head,
            upper_arm,
            forearm,
            hand,
            knee_axis,
            knee_off_axis,
        }
    }
}
