//! Where the segments point: their frames from end points, hinge planes, and bones relative to a calibration pose.

use super::scene::Scene;
use crate::sim::math::ease::rise;
use crate::sim::math::{Mat3, Quat, Vec3};
use crate::sim::motion::filter::percentile;
use crate::sim::motion::skeleton_map::SkeletonMap;

/// Bend below which the plane of a limb is noise, and from which it is trusted, rad.
const PLANE_TRUST: (f64, f64) = (0.26, 0.70);
/// Bend from which a frame tells something about the hinge axis, rad.
const PLANE_LEAST: f64 = 0.30;

/// How bones carry segments.
pub(super) struct Calibration {
    /// True if the file's zero pose served, false if a frame of the motion did.
    pub from_rest: bool,
    /// Figure frame (x forward, y left, z up) of the calibration pose.
    pub figure: Quat,
    /// Sample of the calibration pose; unused with `from_rest`.
    pub sample: usize,
}

/// Segment frames per sample.
pub(super) struct Frames {
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

impl Scene<'_> {
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
            // A trunk that leans a little about a file axis was drawn along that axis.
            let axis = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z]
                .into_iter()
                .find(|a| a.dot(up) > 0.95);
            return Calibration {
                from_rest: true,
                figure: frame_of(axis.unwrap_or(up), left),
                sample: 0,
            };
        }
        let upright = |i: usize| {
            let at = |j: usize| self.place(j)[i];
            let (_, up, _, _, legs) = pose(&at);
            up.z + 0.5 * legs
        };
        let sample = (0..self.count)
            .max_by(|a, b| upright(*a).total_cmp(&upright(*b)).then(b.cmp(a)))
            .unwrap_or(0);
        let at = |j: usize| self.place(j)[sample];
        let (_, up, left, _, _) = pose(&at);
        Calibration {
            from_rest: false,
            figure: frame_of(if up.z > 0.85 { Vec3::Z } else { up }, left),
            sample,
        }
    }

    /// Segment frame per sample from a bone's rotation and the segment's frame in the calibration pose (`figure · relative`).
    pub(super) fn follow(
        &self,
        joint: usize,
        calibration: &Calibration,
        relative: Quat,
    ) -> Vec<Quat> {
        let turns = self.turn(joint);
        let at_calibration = if calibration.from_rest {
            self.basis
        } else {
            turns[calibration.sample]
        };
        let bone_from_segment = at_calibration.conjugate() * calibration.figure * relative;
        turns
            .iter()
            .map(|q| (*q * bone_from_segment).normalized())
            .collect()
    }

    /// Direction of a bone in the calibration pose, figure axes.
    pub(super) fn calibrated_direction(
        &self,
        from: usize,
        to: usize,
        calibration: &Calibration,
    ) -> Vec3 {
        let d = if calibration.from_rest {
            self.rest[self.take.at(to)] - self.rest[self.take.at(from)]
        } else {
            self.place(to)[calibration.sample] - self.place(from)[calibration.sample]
        };
        calibration
            .figure
            .conjugate()
            .rotate(d)
            .normalized_or(-Vec3::Z)
    }

    pub(super) fn pelvis(
        &self,
        map: &SkeletonMap,
        calibration: &Calibration,
    ) -> (Vec<Vec3>, Vec<Quat>) {
        let [l, r] = map.sides;
        let centre = (0..self.count)
            .map(|i| (self.place(l.thigh)[i] + self.place(r.thigh)[i]) * 0.5)
            .collect();
        let mut turn = self.follow(map.pelvis, calibration, Quat::identity());
        // The line of the hips is better known than the bone's calibration: take the mean difference out.
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
        (centre, turn)
    }

    /// Hinge axis (towards the left, before any twist) of a two-bone limb per sample, and the off-axis angle of the lower bone.
    ///
    /// `sense` is +1 for a knee (flexion about +y) and −1 for an elbow (about −y).
    fn hinge_axis(
        &self,
        (upper, middle, lower): (usize, usize, usize),
        sense: f64,
        calibration: &Calibration,
    ) -> (Vec<Vec3>, Vec<f64>) {
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
            if bend > PLANE_LEAST && bend < 2.8 {
                let w = n.norm();
                mean += q.conjugate().rotate(n);
                weight += w;
            }
        }
        // The axis as the bent samples show it, if they are enough and agree; else that of the calibration pose.
        let seen = weight > 0.3 * 0.1 * self.rate && mean.norm() > 0.8 * weight;
        let local = if seen {
            mean.normalized_or(Vec3::Y)
        } else {
            let direction = self.calibrated_direction(upper, middle, calibration);
            let axis = calibration
                .figure
                .rotate(shortest(-Vec3::Z, direction).rotate(Vec3::Y));
            let q = if calibration.from_rest {
                self.basis
            } else {
                turn[calibration.sample]
            };
            q.conjugate().rotate(axis)
        };
        let mut axis = Vec::with_capacity(self.count);
        let mut off = Vec::new();
        for (i, q) in turn.iter().enumerate() {
            let (u, n, bend) = normal(i);
            let own = q.rotate(local);
            let own = (own - u * own.dot(u)).normalized_or(Vec3::Y);
            let plane = n.normalized_or(own);
            let agree = plane.dot(own);
            if bend > PLANE_LEAST {
                let v = (c[i] - b[i]).normalized_or(u);
                off.push(v.dot(own).abs().clamp(0.0, 1.0).asin());
            }
            let w =
                rise(bend, PLANE_TRUST) * (1.0 - rise(bend, (2.6, 2.9))) * rise(agree, (0.3, 0.7));
            axis.push((own * (1.0 - w) + plane * w).normalized_or(own));
        }
        (axis, off)
    }

    pub(super) fn frames(&self, map: &SkeletonMap, calibration: &Calibration) -> Frames {
        let chest_bone = map.trunk.last().copied().unwrap_or(map.pelvis);
        let chest = self.follow(chest_bone, calibration, Quat::identity());
        let pelvis = self.pelvis(map, calibration).1;
        let abdomen = if map.trunk.len() >= 2 {
            self.follow(map.trunk[map.abdomen], calibration, Quat::identity())
        } else {
            // One bone bends the trunk: both of our joints share it.
            pelvis
                .iter()
                .zip(&chest)
                .map(|(p, c)| p.slerp(*c, 0.5))
                .collect()
        };
        let head = map
            .head
            .map(|h| self.follow(h, calibration, Quat::identity()));
        let mut knee_off_axis = [0.0; 2];
        let knee_axis = [0, 1].map(|s| {
            let m = &map.sides[s];
            let (axis, off) = self.hinge_axis((m.thigh, m.shank, m.foot), 1.0, calibration);
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
            let axis = self
                .hinge_axis((m.upper_arm, m.forearm, wrist), -1.0, calibration)
                .0;
            upper_arm[s] = (0..self.count)
                .map(|i| frame_of(shoulder[i] - elbow[i], axis[i]))
                .collect();
            let bone = m.hand.unwrap_or(m.forearm);
            let direction = self.calibrated_direction(m.forearm, wrist, calibration);
            hand[s] = self.follow(bone, calibration, shortest(-Vec3::Z, direction));
        }
        Frames {
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
