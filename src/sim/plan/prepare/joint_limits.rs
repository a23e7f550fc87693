//! Joints within the limits of the body: the upper body first, the legs last.

use super::compared::Excess;
use crate::body::angles::clamp_to_limits;
use crate::body::topology::{
    BALL_COUNT, DOF_COUNT, DOF_START, FEET, HINGE_COUNT, JOINT, Joint, L_THIGH, SHANKS, THIGHS,
    TOES,
};
use crate::body::{Body, Posture};
use crate::math::{Quat, Vec3};
use crate::motion::filter::{low_pass, low_pass_rotations};
use crate::motion::leg_ik::{forward, knee_axis, solve_leg};
use crate::plan::foot_lock::{AnklePose, LockedFoot, Sole};
use crate::plan::params::{leg, swing};
use crate::plan::toe_hinge;

/// How well locked feet hold once the legs are within their limits.
#[derive(Default)]
pub(super) struct HeldFeet {
    /// Largest distance of a planted foot from its place, m.
    pub slide: f64,
    /// Largest depth of a planted foot in the floor, m.
    pub penetration: f64,
    /// Foot samples that were declared free.
    pub freed: usize,
}

/// Brings the legs within their limits, as the last step, and declares the feet free that they then cannot hold in
/// place.
pub(super) fn into_limits(
    body: &Body,
    postures: &mut [Posture],
    planted: &mut [[bool; 2]],
    soles: &[Sole; 2],
    locked: &[LockedFoot; 2],
    accuracy: f64,
    clamped: &mut [Excess; DOF_COUNT],
) -> HeldFeet {
    let n = postures.len();
    let mut held = HeldFeet::default();
    for (i, (posture, planted)) in postures.iter_mut().zip(planted).enumerate() {
        let wanted = forward(body, posture);
        let off = clamp_to_limits(body, posture, leg::LIMIT_MARGIN * 0.5);
        note_clamped(clamped, &off, n);
        let behind = |s: usize| off[DOF_START[THIGHS[s].index()]] < 0.0;
        for s in (0..2).filter(|s| !planted[*s] && behind(*s)) {
            lift_by_knee(body, posture, s, AnklePose::of(&wanted, s));
        }
        for s in (0..2).filter(|s| !planted[*s]) {
            raise_foot(body, posture, s, &soles[s]);
        }
        let poses = forward(body, posture);
        for s in 0..2 {
            if !planted[s] {
                continue;
            }
            let is = AnklePose::of(&poses, s);
            let low = is.at.z + soles[s].lowest(is.rotation, posture.hinge[toe_hinge(s)]);
            let stray = soles[s].stray(is, &locked[s].poses[i]);
            if stray > accuracy || low < -accuracy {
                planted[s] = false;
                held.freed += 1;
                raise_foot(body, posture, s, &soles[s]);
                continue;
            }
            held.slide = held.slide.max(stray);
            held.penetration = held.penetration.max(-low);
        }
    }
    held
}

/// Bends the knee of a swinging leg whose hip does not reach far enough back, until its ankle is as high as `wanted`.
/// Otherwise its foot would be in the floor.
fn lift_by_knee(body: &Body, posture: &mut Posture, side: usize, wanted: AnklePose) {
    let shank = SHANKS[side].index();
    let foot = FEET[side].index();
    let (Joint::Hinge1(k), Joint::Ball(f)) = (JOINT[shank], JOINT[foot]) else {
        unreachable!("the tree has hinge knees and ball ankles")
    };
    let most = body.upper[DOF_START[shank]] - leg::LIMIT_MARGIN;
    for _ in 0..leg::SOLVES {
        let poses = forward(body, posture);
        let low = wanted.at.z - poses[foot].0.z;
        let axis = knee_axis(posture, side == 0);
        let rises = axis.cross(poses[foot].0 - poses[shank].0).z;
        if low < leg::KNEE_SLACK || rises < leg::KNEE_RISE || posture.hinge[k] >= most {
            break;
        }
        posture.hinge[k] = (posture.hinge[k] + (low / rises).min(leg::KNEE_STEP)).min(most);
        let shank = forward(body, posture)[shank].1;
        posture.ball[f] = (shank.conjugate() * wanted.rotation).normalized();
    }
    clamp_to_limits(body, posture, leg::LIMIT_MARGIN * 0.5);
}

/// Raises a foot that limits have put deeper into the floor than [`leg::DEEP`] to that depth, by the whole leg.
fn raise_foot(body: &Body, posture: &mut Posture, side: usize, sole: &Sole) {
    for _ in 0..leg::SOLVES {
        let (ankle, rotation) = forward(body, posture)[FEET[side].index()];
        let toe = posture.hinge[toe_hinge(side)];
        let deep = -(ankle.z + sole.lowest(rotation, toe)) - leg::DEEP;
        if deep <= 0.0 {
            break;
        }
        let to = (ankle + Vec3::Z * deep, rotation);
        solve_leg(body, posture, side == 0, to, toe);
        clamp_to_limits(body, posture, leg::LIMIT_MARGIN * 0.5);
    }
}

fn note_clamped(clamped: &mut [Excess; DOF_COUNT], off: &[f64; DOF_COUNT], n: usize) {
    for (c, o) in clamped.iter_mut().zip(off) {
        // Below a tenth of a degree the excess comes from the margin, not the motion.
        if o.abs() > leg::NOTED_EXCESS {
            c.max = c.max.max(o.abs());
            c.fraction += 1.0 / n as f64;
        }
    }
}

/// Brings spine, neck and arms within their limits, then smooths again where clamping left a corner.
pub(super) fn clamp_upper(
    body: &Body,
    postures: &mut [Posture],
    rate_hz: f64,
    clamped: &mut [Excess; DOF_COUNT],
) {
    let n = postures.len();
    let mut any = false;
    for p in postures.iter_mut() {
        let mut q = *p;
        // Legs of a draft have no meaning yet: keep them out of the count.
        for s in THIGHS.into_iter().chain(FEET) {
            if let Joint::Ball(b) = JOINT[s.index()] {
                q.ball[b] = Quat::identity();
            }
        }
        for s in SHANKS.into_iter().chain(TOES) {
            if let Joint::Hinge1(h) = JOINT[s.index()] {
                let d = DOF_START[s.index()];
                q.hinge[h] = 0.5 * (body.lower[d] + body.upper[d]);
            }
        }
        let off = clamp_to_limits(body, &mut q, leg::LIMIT_MARGIN);
        let mut upper = off;
        upper[DOF_START[L_THIGH.index()]..].fill(0.0);
        any |= upper.iter().any(|o| o.abs() > leg::NOTED_EXCESS);
        note_clamped(clamped, &upper, n);
        *p = q;
    }
    if any {
        smooth_joints(postures, swing::JOINT_CUTOFF, rate_hz);
    }
}

/// Low-pass of all joint positions of a motion, in place; the pelvis is left alone.
fn smooth_joints(postures: &mut [Posture], cutoff_hz: f64, rate_hz: f64) {
    for b in 0..BALL_COUNT {
        let mut q: Vec<Quat> = postures.iter().map(|p| p.ball[b]).collect();
        low_pass_rotations(&mut q, cutoff_hz, rate_hz);
        for (p, q) in postures.iter_mut().zip(q) {
            p.ball[b] = q;
        }
    }
    for h in 0..HINGE_COUNT {
        let mut a: Vec<f64> = postures.iter().map(|p| p.hinge[h]).collect();
        low_pass(&mut a, cutoff_hz, rate_hz);
        for (p, a) in postures.iter_mut().zip(a) {
            p.hinge[h] = a;
        }
    }
}
