//! From a recorded motion in body scale to a reference that a body can follow: feet locked, legs reaching, balance kept.

use super::balance::{Carrier, MassTrack, com_shift, hull, margin, mass_track, segment_poses};
use super::filter::{low_pass_points, percentile, smooth_minimum};
use super::foot_lock::{FootPose, LockedFoot, Sole, lock_foot};
use crate::sim::body::angles::clamp_to_limits;
use crate::sim::body::topology::{
    DOF_COUNT, DOF_START, JOINT, Joint, L_FOOT, L_SHANK, L_THIGH, L_TOES, R_FOOT, R_SHANK, R_THIGH, R_TOES, SegmentId,
};
use crate::sim::body::{Body, Posture};
use crate::sim::math::{Mat3, Quat, Vec3};

/// A planted leg reaches at most this fraction of its length: a straight knee makes inverse kinematics jump.
const REACH: f64 = 0.98;
/// Rounds of shifting the trunk and solving the legs again.
const BALANCE_ROUNDS: usize = 6;
/// The zero-moment point is kept this far inside the support polygon, m.
const INSET: f64 = 0.03;
/// A zero-moment point outside by more than this for long means that something other than the feet carries the body, m.
const CARRIED: f64 = 0.15;
/// The trunk is never moved further than this for balance, m.
const MOST_SHIFT: f64 = 0.12;
/// Angles are kept this far from their limits, rad.
const LIMIT_MARGIN: f64 = 0.01;

/// A recorded motion in body scale, floor at z = 0: what the preparation starts from.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Samples per second.
    pub rate_hz: f64,
    /// Pelvis pose, spine, neck and arms; the legs of these postures are not read.
    pub postures: Vec<Posture>,
    /// Left and right: knee axis (world, towards the figure's left) per sample.
    pub knee_axis: [Vec<Vec3>; 2],
    /// Left and right: ankle position per sample, m.
    pub ankle: [Vec<Vec3>; 2],
    /// Left and right: `world_from_foot` per sample.
    pub foot: [Vec<Quat>; 2],
    /// Left and right foot on the floor, per sample.
    pub label: Vec<[bool; 2]>,
}

/// What to do with the draft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrepareOptions {
    /// Lock planted feet to the floor.
    pub lock_feet: bool,
    /// Shift the trunk so that the zero-moment point stays in the support polygon.
    pub balance: bool,
}

/// How far the zero-moment point is outside the support polygon of planted feet, over the samples that feet carry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ZmpOutside {
    /// Fraction of the samples outside.
    pub fraction: f64,
    /// Mean excess over all samples (0 inside), m.
    pub mean: f64,
    /// 95th percentile of the excess, m.
    pub p95: f64,
    /// Largest excess, m.
    pub max: f64,
}

/// A motion that a body can follow.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Postures, one per sample.
    pub postures: Vec<Posture>,
    /// Feet locked to the floor: left, right.
    pub planted: Vec<[bool; 2]>,
    /// By how much each DOF was outside the body's limits, rad, and in which fraction of the samples.
    pub clamped: [(f64, f64); DOF_COUNT],
    /// Largest distance of a planted foot from its place, m: as recorded, and prepared.
    pub slide: (f64, f64),
    /// Largest depth of a sole below the floor while the foot is on it, m: as recorded, and prepared.
    pub penetration: (f64, f64),
    /// Zero-moment point before and after balancing.
    pub zmp: (ZmpOutside, ZmpOutside),
    /// Largest horizontal shift of the pelvis for balance, m.
    pub shift_max: f64,
    /// Largest lowering of the pelvis so that planted legs reach, m.
    pub drop_max: f64,
    /// Fraction of the samples in which something other than the feet carries the body.
    pub carried: f64,
}

/// One leg of a body: lengths and the angle between them at zero flexion.
struct Leg {
    side: usize,
    hip: Vec3,
    knee: Vec3,
    ankle: Vec3,
    /// Lengths of thigh and shank, m.
    a: f64,
    b: f64,
    /// Knee angle at which the leg is longest, rad.
    straight: f64,
}

const THIGH: [SegmentId; 2] = [L_THIGH, R_THIGH];
const SHANK: [SegmentId; 2] = [L_SHANK, R_SHANK];
const FOOT: [SegmentId; 2] = [L_FOOT, R_FOOT];
const TOES: [SegmentId; 2] = [L_TOES, R_TOES];

impl Leg {
    fn new(body: &Body, side: usize) -> Self {
        let knee = body.joint_offset[SHANK[side].index()];
        let ankle = body.joint_offset[FOOT[side].index()];
        // Directions of both bones in the x–z plane of the knee hinge (axis +y).
        let angle = |v: Vec3| v.x.atan2(-v.z);
        Self {
            side,
            hip: body.joint_offset[THIGH[side].index()],
            knee,
            ankle,
            a: knee.x.hypot(knee.z),
            b: ankle.x.hypot(ankle.z),
            straight: angle(ankle) - angle(knee),
        }
    }

    fn length(&self) -> f64 {
        self.a + self.b
    }

    /// Sets hip, knee, ankle and toe of `posture` so that the foot takes `foot`; the knee axis comes as near `axis` (world) as it can.
    ///
    /// Returns the distance by which the leg is too short, m; then the ankle lies on the line to its goal.
    fn solve(&self, body: &Body, posture: &mut Posture, foot: &FootPose, axis: Vec3) -> f64 {
        let hip = posture.root_position + posture.root_rotation.rotate(self.hip);
        let line = foot.ankle - hip;
        let side_gap = self.knee.y + self.ankle.y; // out of the hinge plane; constant
        let wanted = (line.dot(line) - side_gap * side_gap).max(0.0).sqrt();
        let knee_dof = DOF_START[SHANK[self.side].index()];
        // Law of cosines: 0 at the longest leg, growing with flexion.
        let cos = ((wanted * wanted - self.a * self.a - self.b * self.b) / (2.0 * self.a * self.b)).clamp(-1.0, 1.0);
        let flexion = (cos.acos() + self.straight).clamp(body.lower[knee_dof] + LIMIT_MARGIN, body.upper[knee_dof] - LIMIT_MARGIN);
        let leg = self.knee + Quat::exp(Vec3::Y * flexion).rotate(self.ankle);
        let frame = |direction: Vec3, side: Vec3| {
            let d = direction.normalized_or(-Vec3::Z);
            let y = (side - d * side.dot(d)).normalized_or(Vec3::Y);
            Mat3 {
                x: d,
                y,
                z: d.cross(y),
            }
        };
        let world = frame(line, axis) * frame(leg, Vec3::Y).transpose();
        let thigh = Quat::from_mat3(&world);
        let shank = thigh * Quat::exp(Vec3::Y * flexion);
        let set = |posture: &mut Posture, s: SegmentId, q: Quat| {
            if let Joint::Ball(b) = JOINT[s.index()] {
                posture.ball[b] = q.normalized();
            }
        };
        set(posture, THIGH[self.side], posture.root_rotation.conjugate() * thigh);
        set(posture, FOOT[self.side], shank.conjugate() * foot.rotation);
        if let Joint::Hinge1(h) = JOINT[SHANK[self.side].index()] {
            posture.hinge[h] = flexion;
        }
        if let Joint::Hinge1(h) = JOINT[TOES[self.side].index()] {
            posture.hinge[h] = foot.toe;
        }
        (line.norm() - leg.norm()).max(0.0)
    }
}

/// Turns a draft into a motion that the body can follow.
///
/// Memory and time are linear in the number of samples (times a handful of balancing rounds).
pub fn prepare(body: &Body, draft: &Draft, options: PrepareOptions) -> Prepared {
    let n = draft.postures.len();
    let rate = draft.rate_hz;
    let legs = [Leg::new(body, 0), Leg::new(body, 1)];
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let mut upper = draft.postures.clone();
    let mut clamped = [(0.0f64, 0.0f64); DOF_COUNT];
    clamp_upper(body, &mut upper, rate, &mut clamped);

    let locked: [LockedFoot; 2] = std::array::from_fn(|s| {
        let label: Vec<bool> = draft.label.iter().map(|l| l[s] && options.lock_feet).collect();
        lock_foot(&soles[s], &draft.ankle[s], &draft.foot[s], &label, rate)
    });
    let planted: Vec<[bool; 2]> = (0..n).map(|i| [locked[0].planted[i], locked[1].planted[i]]).collect();
    let mut penetration_before: f64 = 0.0;
    for s in 0..2 {
        for i in (0..n).filter(|i| draft.label[*i][s]) {
            let low = draft.ankle[s][i].z + soles[s].lowest(draft.foot[s][i], locked[s].poses[i].toe);
            penetration_before = penetration_before.max(-low);
        }
    }

    // Legs: one pass as recorded, then rounds of shifting the trunk over the feet.
    let standing = body.standing_root_height();
    let carriers: Vec<Carrier> = (0..n)
        .map(|i| {
            let mut corners = Vec::new();
            for s in 0..2 {
                if let Some(st) = locked[s].stances.iter().find(|st| (st.start..st.end).contains(&i)) {
                    soles[s].footprint(st.anchor, st.yaw, locked[s].pitch[i], &mut corners);
                }
            }
            if upper[i].root_position.z < 0.45 * standing {
                Carrier::Other
            } else if corners.len() >= 3 {
                Carrier::Feet(hull(&corners))
            } else if draft.label[i] == [false, false] {
                Carrier::Air
            } else {
                Carrier::Other
            }
        })
        .collect();
    let mut shift = vec![[0.0f64; 2]; n];
    let (mut postures, mut drop_max) = assemble(body, &legs, &upper, &locked, draft, &shift);
    let track = mass_track(body, &postures, rate);
    let before = zmp_outside(&track, &carriers);
    let mut after = before;
    let mut carried = 0.0;
    if options.balance && options.lock_feet && n >= 8 {
        let mut track = track;
        for _ in 0..BALANCE_ROUNDS {
            let delta = com_shift(&track, &carriers, INSET, CARRIED, rate);
            for (s, d) in shift.iter_mut().zip(&delta) {
                // The feet stay behind, so the centre of mass follows the pelvis by some 85 %.
                let (x, y) = (s[0] + 1.15 * d[0], s[1] + 1.15 * d[1]);
                let far = x.hypot(y);
                let k = if far > MOST_SHIFT { MOST_SHIFT / far } else { 1.0 };
                *s = [x * k, y * k];
            }
            (postures, drop_max) = assemble(body, &legs, &upper, &locked, draft, &shift);
            track = mass_track(body, &postures, rate);
        }
        after = zmp_outside(&track, &carriers);
        let far = (0..n)
            .filter(|i| match &carriers[*i] {
                Carrier::Feet(p) => margin(p, track.zmp[*i]) < -CARRIED,
                Carrier::Other => true,
                Carrier::Air => false,
            })
            .count();
        carried = far as f64 / n.max(1) as f64;
    }

    // Legs into their limits last, and what is left of the lock.
    let mut slide_after: f64 = 0.0;
    let mut penetration_after: f64 = 0.0;
    for i in 0..n {
        let off = clamp_to_limits(body, &mut postures[i], LIMIT_MARGIN * 0.5);
        note_clamped(&mut clamped, &off, n);
        let poses = segment_poses(body, &postures[i]);
        for s in (0..2).filter(|s| planted[i][*s]) {
            let (at, q) = poses[FOOT[s].index()];
            let goal = &locked[s].poses[i];
            slide_after = slide_after.max((at - goal.ankle).norm());
            let toe = match JOINT[TOES[s].index()] {
                Joint::Hinge1(h) => postures[i].hinge[h],
                _ => goal.toe,
            };
            penetration_after = penetration_after.max(-(at.z + soles[s].lowest(q, toe)));
        }
    }
    Prepared {
        postures,
        planted,
        clamped,
        slide: (locked[0].slide_before.max(locked[1].slide_before), slide_after),
        penetration: (penetration_before, penetration_after),
        zmp: (before, after),
        shift_max: shift.iter().map(|s| s[0].hypot(s[1])).fold(0.0, f64::max),
        drop_max,
        carried,
    }
}

fn note_clamped(clamped: &mut [(f64, f64); DOF_COUNT], off: &[f64; DOF_COUNT], n: usize) {
    for (c, o) in clamped.iter_mut().zip(off) {
        // Below a tenth of a degree it is the margin, not the motion.
        if o.abs() > 0.002 {
            c.0 = c.0.max(o.abs());
            c.1 += 1.0 / n as f64;
        }
    }
}

/// Spine, neck and arms into their limits, then smooth again where clamping left a corner.
fn clamp_upper(body: &Body, postures: &mut [Posture], rate_hz: f64, clamped: &mut [(f64, f64); DOF_COUNT]) {
    let n = postures.len();
    let mut any = false;
    for p in postures.iter_mut() {
        let mut q = *p;
        // Legs of a draft mean nothing yet: keep them out of the count.
        for s in [L_THIGH, R_THIGH, L_FOOT, R_FOOT] {
            if let Joint::Ball(b) = JOINT[s.index()] {
                q.ball[b] = Quat::identity();
            }
        }
        for s in [L_SHANK, R_SHANK, L_TOES, R_TOES] {
            if let Joint::Hinge1(h) = JOINT[s.index()] {
                let d = DOF_START[s.index()];
                q.hinge[h] = 0.5 * (body.lower[d] + body.upper[d]);
            }
        }
        let off = clamp_to_limits(body, &mut q, LIMIT_MARGIN);
        let mut upper = off;
        upper[DOF_START[L_THIGH.index()]..].fill(0.0);
        any |= upper.iter().any(|o| o.abs() > 0.002);
        note_clamped(clamped, &upper, n);
        *p = q;
    }
    if any {
        super::retarget::smooth_joints(postures, 8.0, rate_hz);
    }
}

/// Postures from upper body, feet and trunk shift: pelvis lowered until planted legs reach, legs solved.
fn assemble(
    body: &Body,
    legs: &[Leg; 2],
    upper: &[Posture],
    locked: &[LockedFoot; 2],
    draft: &Draft,
    shift: &[[f64; 2]],
) -> (Vec<Posture>, f64) {
    let n = upper.len();
    let mut out = upper.to_vec();
    let mut drop = vec![0.0f64; n];
    for i in 0..n {
        out[i].root_position.x += shift[i][0];
        out[i].root_position.y += shift[i][1];
        for (leg, foot) in legs.iter().zip(locked).filter(|(_, f)| f.planted[i]) {
            let hip = out[i].root_position + out[i].root_rotation.rotate(leg.hip);
            let d = hip - foot.poses[i].ankle;
            let most = REACH * leg.length();
            let level = d.x.hypot(d.y);
            let height = (most * most - level * level).max(0.04 * most * most).sqrt();
            drop[i] = drop[i].min(height - d.z);
        }
    }
    let drop = smooth_minimum(&drop, (0.1 * draft.rate_hz) as usize);
    // The moving average leaves corners of its own; a light low-pass of the pelvis path takes them out.
    let mut path: Vec<Vec3> = (0..n)
        .map(|i| {
            let mut p = out[i].root_position;
            p.z += drop[i];
            p
        })
        .collect();
    low_pass_points(&mut path, 10.0, draft.rate_hz);
    let lowest = drop.iter().copied().fold(0.0, f64::min);
    for i in 0..n {
        out[i].root_position = path[i];
        for (s, leg) in legs.iter().enumerate() {
            let mut foot = locked[s].poses[i];
            let hip = path[i] + out[i].root_rotation.rotate(leg.hip);
            let line = foot.ankle - hip;
            let far = line.norm();
            let most = 0.995 * leg.length();
            if !locked[s].planted[i] && far > most {
                foot.ankle = hip + line * (most / far);
            }
            leg.solve(body, &mut out[i], &foot, draft.knee_axis[s][i]);
        }
    }
    (out, -lowest)
}

fn zmp_outside(track: &MassTrack, carriers: &[Carrier]) -> ZmpOutside {
    let outside: Vec<f64> = track
        .zmp
        .iter()
        .zip(carriers)
        .filter_map(|(z, c)| match c {
            Carrier::Feet(p) => Some((-margin(p, *z)).max(0.0)),
            _ => None,
        })
        .collect();
    let n = outside.len().max(1) as f64;
    ZmpOutside {
        fraction: outside.iter().filter(|x| **x > 0.0).count() as f64 / n,
        mean: outside.iter().sum::<f64>() / n,
        p95: percentile(&outside, 0.95),
        max: outside.iter().copied().fold(0.0, f64::max),
    }
}
