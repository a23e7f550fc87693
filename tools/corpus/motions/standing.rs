//! Motions on the spot.

use super::super::actor::{Actor, sign};
use super::super::gait::{at_ease, deg};
use super::super::plan::Script;
use super::super::tracks::{DEG, Track, mix, ramp};
use super::{STAND, hips, in_place};

pub(super) fn stand() -> Script {
    let a = Actor::medium();
    let head = Track::through(&[
        (0.0, 0.0),
        (1.0, 6.0),
        (2.2, 18.0),
        (3.2, 12.0),
        (4.4, -10.0),
        (5.2, -4.0),
        (6.0, 0.0),
    ]);
    let sway = Track::through(&[
        (0.3, 0.0),
        (1.4, 0.012),
        (2.6, -0.006),
        (3.7, 0.009),
        (4.9, -0.008),
        (5.7, 0.0),
    ]);
    let side = Track::still(&[
        (0.4, 0.0),
        (2.0, 0.045),
        (3.2, 0.040),
        (5.0, -0.02),
        (5.8, 0.0),
    ]);
    let lean = side.clone();
    Script {
        sway: [sway, side],
        ..in_place(
            "stand",
            "Quiet standing: weight shifts, sway, looking around, breathing.",
            6.0,
            0.11,
            Track::still(&[(0.0, hips(&a, STAND)), (6.0, hips(&a, STAND))]),
            Box::new(move |t| {
                let mut u = at_ease();
                let breath = breathing(t);
                let shift = lean.at(t) / 0.045;
                u.thorax[0] -= 1.2 * DEG * breath;
                u.neck[2] = head.at(t) * DEG;
                u.neck[0] += 0.8 * DEG * breath;
                u.pelvis[1] = 2.2 * DEG * shift;
                u.waist[1] = -2.0 * DEG * shift;
                u.thorax[1] = -0.8 * DEG * shift;
                for side in 0..2 {
                    u.shoulder[side][1] += 0.9 * DEG * breath;
                    u.shoulder[side][0] += sign(side) * 1.5 * DEG * shift;
                }
                u
            }),
        )
    }
}

/// −1…1, one breath in 3 s.
fn breathing(t: f64) -> f64 {
    sinew_physics::math::trig::sin_cos(t * 2.0 * std::f64::consts::PI / 3.0).0
}

pub(super) fn wave() -> Script {
    let a = Actor::medium();
    let up = Track::still(&[(0.6, 0.0), (1.4, 1.0), (4.2, 1.0), (5.1, 0.0)]);
    let side = Track::through(&[
        (1.3, 0.0),
        (1.65, 1.0),
        (2.05, -1.0),
        (2.45, 1.0),
        (2.85, -1.0),
        (3.25, 1.0),
        (3.65, -1.0),
        (4.1, 0.0),
    ]);
    in_place(
        "wave",
        "Raises the right arm and waves.",
        5.6,
        0.10,
        Track::still(&[(0.0, hips(&a, STAND)), (1.0, hips(&a, STAND))]),
        Box::new(move |t| {
            let mut u = at_ease();
            let (w, s) = (up.at(t), side.at(t));
            let goal = deg([38.0, 78.0 + 3.0 * s, -58.0 - 12.0 * s]);
            for k in 0..3 {
                u.shoulder[1][k] = mix(u.shoulder[1][k], goal[k], w);
            }
            u.elbow[1][0] = mix(u.elbow[1][0], (88.0 - 22.0 * s) * DEG, w);
            u.elbow[1][1] = mix(u.elbow[1][1], 40.0 * DEG, w);
            u.wrist[1] = deg([mix(4.0, 0.0, w), mix(-2.0, -6.0 * s, w)]);
            u.thorax[1] = -4.0 * DEG * w;
            u.waist[1] = -2.0 * DEG * w;
            u.neck[1] = 3.0 * DEG * w;
            u.neck[2] = -8.0 * DEG * w;
            u.thorax[0] -= 0.8 * DEG * breathing(t);
            u
        }),
    )
}

pub(super) fn squat() -> Script {
    let a = Actor::medium();
    let down = Track::still(&[(0.5, 0.0), (2.1, 1.0), (2.6, 1.0), (4.2, 0.0)]);
    let high = hips(&a, STAND);
    let low = a.ankle + 0.40 * a.leg();
    let height = Track::still(&[(0.5, high), (2.1, low), (2.6, low), (4.2, high)]);
    in_place(
        "squat",
        "A deep squat with the arms forward.",
        4.8,
        0.145,
        height,
        Box::new(move |t| {
            let mut u = at_ease();
            let w = down.at(t);
            u.pelvis[0] += 24.0 * DEG * w;
            u.waist[0] += 22.0 * DEG * w;
            u.thorax[0] += 12.0 * DEG * w;
            u.neck[0] -= 34.0 * DEG * w;
            for side in 0..2 {
                u.shoulder[side][0] = mix(u.shoulder[side][0], 96.0 * DEG, w);
                u.shoulder[side][1] = mix(u.shoulder[side][1], 8.0 * DEG, w);
                u.elbow[side][0] = mix(u.elbow[side][0], 18.0 * DEG, w);
            }
            u
        }),
    )
}

pub(super) fn lift() -> Script {
    let a = Actor::medium();
    let down = Track::still(&[(0.5, 0.0), (2.0, 1.0), (2.5, 1.0), (4.1, 0.0)]);
    let hold = Track::still(&[(2.4, 0.0), (4.2, 1.0)]);
    let (high, low) = (hips(&a, STAND), a.ankle + 0.50 * a.leg());
    let height = Track::still(&[(0.5, high), (2.0, low), (2.5, low), (4.1, hips(&a, 0.990))]);
    in_place(
        "lift",
        "Bends hips and knees, takes a box from the floor and stands with it before the chest; no load in the file.",
        5.4,
        0.15,
        height,
        Box::new(move |t| {
            let mut u = at_ease();
            let (w, h) = (down.at(t), hold.at(t));
            u.pelvis[0] += 34.0 * DEG * w - 2.0 * DEG * h;
            u.waist[0] += 30.0 * DEG * w - 3.0 * DEG * h;
            u.thorax[0] += 20.0 * DEG * w;
            u.neck[0] -= 30.0 * DEG * w - 6.0 * DEG * h;
            for side in 0..2 {
                let ease = at_ease();
                // Straight arms at the floor, then the box before the belly.
                let reach = [62.0, 4.0, 20.0, 16.0, 10.0];
                let carry = [24.0, 6.0, 25.0, 78.0, 5.0];
                let lifted: Vec<f64> = (0..5).map(|k| mix(reach[k], carry[k], h) * DEG).collect();
                let on = w.max(h).max(ramp(t, 2.0, 2.1));
                for k in 0..3 {
                    u.shoulder[side][k] = mix(ease.shoulder[side][k], lifted[k], on);
                }
                for k in 0..2 {
                    u.elbow[side][k] = mix(ease.elbow[side][k], lifted[3 + k], on);
                }
            }
            u
        }),
    )
}
