//! Stepping: footsteps, a path of the zero moment point over them, and the centre of mass that follows from it.
//!
//! The centre of mass obeys the linear inverted pendulum `ẍ = ω² (x − p)` with `ω² = g / height` and p the planned zero
//! moment point; the one solution that stays bounded is found as a boundary value problem over the whole motion. The
//! effect of swinging limbs is measured on the result and subtracted from the plan, a few times over (Kajita et al.
//! 2003, §5). The feet are a smooth function of time: flat, rolling over the ball before they lift, swinging, landing
//! on the heel.

use super::RATE;
use super::shape::{COM_AHEAD, Foot, Measures, Plan, posture};
use super::standing::{at_ease, stand};
use crate::body::topology::outward;
use crate::body::{Body, Posture, SEGMENT_COUNT};
use crate::math::curve::ramp;
use crate::math::{Quat, Vec3};
use std::f64::consts::{PI, TAU};

use super::super::leg_ik::{center_of_mass, forward};
use super::shape::set;
use crate::motion::GRAVITY;

/// Time that the zero moment point takes from between the feet to a point under the first foot that carries alone, and
/// back after the last step, s.
const TRANSFER: f64 = 0.5;
/// Time at both ends over which the rest of the pendulum's approach is faded out, so that the figure starts and ends at
/// rest, s.
const FADE: f64 = 0.6;

/// Rounds in which the zero moment point of the whole figure (swinging limbs included) is measured and the path
/// corrected for it.
const CORRECTIONS: usize = 4;

/// One footstep.
#[derive(Clone, Copy, Debug)]
struct Step {
    /// 0 = left, 1 = right.
    side: usize,
    /// Time when the toes leave the floor, and time when the heel comes back to it, s.
    lift: f64,
    land: f64,
    /// Ankle of the flat foot before and after the step, m.
    from: f64,
    to: f64,
}

/// How the figure steps. Lengths for the reference body, m; times s; angles rad.
struct Style {
    half_stance: f64,
    /// Time from one lift to the next; the foot is in the air for `swing` of it.
    period: f64,
    swing: f64,
    count: usize,
    /// Distance from one footprint to the next one of the other foot.
    length: f64,
    /// Height by which the ankle is lifted beyond the height that the foot's pitch asks for.
    clearance: f64,
    /// Pitch of the foot when it leaves the floor (heel up) and when it meets the floor (toes up).
    push: f64,
    strike: f64,
    /// Times of rolling over ball and heel.
    push_time: f64,
    strike_time: f64,
    /// Hip height in leg lengths, and the amplitude of its rise and fall.
    height: f64,
    bob: f64,
    /// Rotation of the pelvis, and swing of the shoulders.
    turn: f64,
    arms: f64,
    /// Advance of the zero moment point under a foot, to both sides of its middle.
    roll: f64,
    /// Time of standing still before the first lift, and after the last landing.
    before: f64,
    after: f64,
}

const WALK: Style = Style {
    half_stance: 0.085,
    period: 0.60,
    swing: 0.44,
    count: 6,
    length: 0.46,
    clearance: 0.03,
    push: 0.50,
    strike: -0.22,
    push_time: 0.26,
    strike_time: 0.14,
    height: 0.94,
    bob: 0.012,
    turn: 0.07,
    arms: 0.35,
    roll: 0.025,
    before: 1.4,
    after: 1.8,
};

const IN_PLACE: Style = Style {
    half_stance: 0.09,
    period: 0.95,
    swing: 0.60,
    count: 6,
    length: 0.0,
    clearance: 0.09,
    push: 0.0,
    strike: 0.0,
    push_time: 0.2,
    strike_time: 0.1,
    height: 0.975,
    bob: 0.0,
    turn: 0.0,
    arms: 0.10,
    roll: 0.0,
    before: 1.4,
    after: 1.6,
};

pub fn walk(body: &Body) -> (Vec<Posture>, Vec<[bool; 2]>) {
    go(body, &WALK)
}

pub fn step(body: &Body) -> (Vec<Posture>, Vec<[bool; 2]>) {
    go(body, &IN_PLACE)
}

/// Right foot first; the last step closes up to the foot before.
fn footsteps(style: &Style, scale: f64) -> Vec<Step> {
    let mut at = [0.0; 2];
    (0..style.count)
        .map(|i| {
            let side = (i + 1) % 2;
            let lift = style.before + i as f64 * style.period;
            let reach = (i + 1).min(style.count - 1) as f64 * style.length * scale;
            let from = std::mem::replace(&mut at[side], reach);
            Step {
                side,
                lift,
                land: lift + style.swing,
                from,
                to: reach,
            }
        })
        .collect()
}

/// Pose of one foot at time `t`, and whether it is on the floor.
fn foot(m: &Measures, style: &Style, steps: &[Step], side: usize, t: f64) -> (Foot, bool) {
    let y = style.half_stance * m.scale * outward(side);
    let mine = || steps.iter().filter(|s| s.side == side);
    let last = mine().rfind(|s| s.lift <= t);
    let next = mine().find(|s| s.lift > t);
    // Steps that barely advance need neither push nor heel strike.
    let push = |s: &Step| if s.to > s.from { style.push } else { 0.0 };
    // The foot that closes up lands flat beside the other.
    let is_last = |s: &Step| steps.last().is_some_and(|l| l.lift == s.lift);
    let strike = |s: &Step| if is_last(s) { 0.0 } else { style.strike };
    let pitched = |pitch: f64| Quat::exp(Vec3::Y * pitch);
    // Ankle of a foot planted at x and pitched about the ball (heel up) or about the heel (toes up).
    let standing = |x: f64, pitch: f64| {
        let flat = m.flat(x, y).ankle;
        let pivot = if pitch >= 0.0 {
            m.ball
        } else {
            Vec3 {
                x: -m.heel,
                y: 0.0,
                z: -m.ankle,
            }
        };
        flat + pivot - pitched(pitch).rotate(pivot)
    };
    if let Some(s) = last.filter(|s| t < s.land) {
        let u = ramp(t, s.lift, s.land);
        let pitch = push(s) + (strike(s) - push(s)) * u;
        let (a, b) = (standing(s.from, push(s)), standing(s.to, strike(s)));
        let phase = (t - s.lift) / (s.land - s.lift);
        let bump = (4.0 * phase * (1.0 - phase)).powi(3);
        let ankle = a + (b - a) * u + Vec3::Z * (style.clearance * m.scale * bump);
        let toe = push(s) * (1.0 - ramp(t, s.lift, s.lift + 0.6 * style.swing));
        let foot = Foot {
            ankle,
            rotation: pitched(pitch),
            toe,
        };
        return (foot, false);
    }
    let x = last.map_or_else(|| next.map_or(0.0, |s| s.from), |s| s.to);
    let landing = last.map_or(0.0, |s| {
        strike(s) * (1.0 - ramp(t, s.land, s.land + style.strike_time))
    });
    let leaving = next.map_or(0.0, |s| push(s) * ramp(t, s.lift - style.push_time, s.lift));
    let pitch = landing + leaving; // never both: a stance is longer than the two together
    let foot = Foot {
        ankle: standing(x, pitch),
        rotation: pitched(pitch),
        toe: pitch.max(0.0), // the toes stay flat while the heel rises
    };
    (foot, true)
}

/// Planned zero moment point at time `t`: under the planted foot, moving to the next one while both are planted.
fn zmp(m: &Measures, style: &Style, steps: &[Step], t: f64) -> [f64; 2] {
    let ahead = COM_AHEAD * m.scale;
    let y = 0.85 * style.half_stance * m.scale; // a little to the inside of the ankle
    let mut at = [ahead, 0.0];
    let mut moved = style.before - TRANSFER;
    for (i, s) in steps.iter().enumerate() {
        // The other foot carries this step.
        let other = 1 - s.side;
        let x = steps[..i]
            .iter()
            .rfind(|p| p.side == other)
            .map_or(0.0, |p| p.to);
        let side = if other == 0 { y } else { -y };
        let roll = style.roll * m.scale;
        let u = ramp(t, moved, s.lift);
        let under = [x + ahead - roll, side];
        at = std::array::from_fn(|k| at[k] + (under[k] - at[k]) * u);
        at[0] += 2.0 * roll * ramp(t, s.lift, s.land);
        moved = s.land;
    }
    if let Some(s) = steps.last() {
        let u = ramp(t, s.land, s.land + TRANSFER);
        at = [at[0] + (s.to + ahead - at[0]) * u, at[1] * (1.0 - u)];
    }
    at
}

/// The bounded path of a linear pendulum over the points `p`, at rest over the first and last: second differences,
/// solved by elimination (Thomas).
fn pendulum(p: &[f64], omega: f64) -> Vec<f64> {
    let k = (omega / RATE).powi(2);
    let n = p.len();
    // −x[i−1] + (2 + k) x[i] − x[i+1] = k p[i]
    let (mut upper, mut x) = (vec![0.0; n], p.to_vec());
    for i in 1..n - 1 {
        let pivot = 2.0 + k - upper[i - 1];
        upper[i] = 1.0 / pivot;
        x[i] = (k * p[i] + x[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        x[i] += upper[i] * x[i + 1];
    }
    x
}

/// Zero moment point of segments taken as point masses, over every posture but the first and last, where it is that of
/// standing.
fn measured_zmp(body: &Body, postures: &[Posture]) -> Vec<[f64; 2]> {
    let centers: Vec<[Vec3; SEGMENT_COUNT]> = postures
        .iter()
        .map(|p| {
            let poses = forward(body, p);
            std::array::from_fn(|s| poses[s].0 + poses[s].1.rotate(body.segments[s].com))
        })
        .collect();
    let last = centers.len() - 1;
    (0..=last)
        .map(|i| {
            let (mut moment, mut force) = ([0.0; 2], 0.0);
            for s in 0..SEGMENT_COUNT {
                let mass = body.segments[s].mass;
                let c = centers[i][s];
                let acceleration = if i == 0 || i == last {
                    Vec3::zero()
                } else {
                    (centers[i - 1][s] - c * 2.0 + centers[i + 1][s]) * (RATE * RATE)
                };
                let lift = acceleration.z + GRAVITY;
                moment[0] += mass * (c.x * lift - c.z * acceleration.x);
                moment[1] += mass * (c.y * lift - c.z * acceleration.y);
                force += mass * lift;
            }
            moment.map(|m| m / force)
        })
        .collect()
}

fn go(body: &Body, style: &Style) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let m = Measures::of(body);
    let steps = footsteps(style, m.scale);
    let end = steps[steps.len() - 1].land + style.after;
    let count = (end * RATE).round() as usize + 1;
    let times: Vec<f64> = (0..count).map(|i| i as f64 / RATE).collect();

    let start = stand(body, style.half_stance);
    let com_height = center_of_mass(body, &forward(body, &posture(body, &start))).z;
    let omega = (GRAVITY / com_height).sqrt();
    let fade = |t: f64| ramp(t, 0.0, FADE) * (1.0 - ramp(t, end - FADE, end));

    let wanted: Vec<[f64; 2]> = times.iter().map(|t| zmp(&m, style, &steps, *t)).collect();
    let mut aim = wanted.clone();
    let mut postures: Vec<Posture> = Vec::new();
    for pass in 0..=CORRECTIONS {
        if pass > 0 {
            for (i, found) in measured_zmp(body, &postures).iter().enumerate() {
                for k in 0..2 {
                    aim[i][k] -= (found[k] - wanted[i][k]) * fade(times[i]);
                }
            }
        }
        let path = [0, 1].map(|k| {
            let p: Vec<f64> = aim.iter().map(|p| p[k]).collect();
            let mut x = pendulum(&p, omega);
            for (i, t) in times.iter().enumerate() {
                let rest = wanted[i][k]; // constant where this fades
                x[i] = rest + (x[i] - rest) * fade(*t);
            }
            x
        });
        postures = times
            .iter()
            .enumerate()
            .map(|(i, t)| {
                let com = [path[0][i], path[1][i]];
                posture(body, &plan(&m, style, &steps, &start, *t, com))
            })
            .collect();
    }
    let planted = times
        .iter()
        .map(|t| [0, 1].map(|side| foot(&m, style, &steps, side, *t).1))
        .collect();
    (postures, planted)
}

/// The whole figure at time `t`, with its centre of mass over `com`.
fn plan(m: &Measures, style: &Style, steps: &[Step], start: &Plan, t: f64, com: [f64; 2]) -> Plan {
    let (first, last) = (steps[0].lift, steps[steps.len() - 1].land);
    let going = ramp(t, first - 0.2, first + style.period) - ramp(t, last - style.swing, last);
    let low = ramp(t, first - 1.0, first) - ramp(t, last - 0.2, last + 1.2);
    // +1 while the right foot lands ahead, −1 while the left does
    let beat = going * (PI * (t - steps[0].land) / style.period).cos();
    let double = (TAU * (t - steps[0].land) / style.period).cos();
    let arms = (style.arms * beat).to_degrees();
    let turn = style.turn * beat;
    let mut plan = Plan {
        angles: at_ease(),
        pelvis: Vec3::Z * turn,
        height: start.height + (style.height - start.height) * low
            - style.bob * going * (0.5 + 0.5 * double),
        com,
        feet: [0, 1].map(|side| foot(m, style, steps, side, t).0),
    };
    let back = (-0.8 * turn).to_degrees();
    set(
        &mut plan.angles,
        &[
            ("waist_flexion", 2.0 * low),
            ("waist_rotation", back),
            ("thorax_rotation", back),
            ("neck_rotation", -0.75 * back),
            ("l_shoulder_flexion", 2.0 + arms),
            ("r_shoulder_flexion", 2.0 - arms),
            ("l_elbow_flexion", 15.0 + 8.0 * low + 0.4 * arms),
            ("r_elbow_flexion", 15.0 + 8.0 * low - 0.4 * arms),
        ],
    );
    plan
}
