//! Bends for the sake of planted legs: where their ankles and hips would have to exceed their limits, other joints give
//! way.

use super::pelvis_yaw;
use crate::body::angles::anatomical_angles;
use crate::body::topology::{DOF_START, FEET, THIGHS};
use crate::body::{Body, Posture};
use crate::motion::filter::{low_pass, smooth_minimum};
use crate::plan::foot_lock::{Stance, StanceTurns};
use crate::plan::params::{leg, pitch};

/// The turns and bends, per sample, that keep planted legs within their limits.
pub(super) struct AnkleUnloading {
    /// How feet are turned in stance.
    pub feet: [StanceTurns; 2],
    /// Turn of each leg inwards about the line from hip to ankle, rad.
    pub turn_in: [Vec<f64>; 2],
    /// Turn of the pelvis anticlockwise about the vertical, rad.
    pub yaw: Vec<f64>,
}

impl AnkleUnloading {
    pub fn new(n: usize) -> Self {
        Self {
            feet: [StanceTurns::none(n), StanceTurns::none(n)],
            turn_in: [vec![0.0; n], vec![0.0; n]],
            yaw: vec![0.0; n],
        }
    }

    /// Adds the range that the ankles of planted feet lack: too much dorsiflexion raises the heel, too much rotation
    /// turns the leg along. Where hips lack range as a result, the foot is set down with another heading, and the
    /// pelvis turns where that is not enough.
    pub fn add(
        &mut self,
        body: &Body,
        postures: &[Posture],
        planted: &[[bool; 2]],
        stances: [&[Stance]; 2],
        runs: bool,
        rate_hz: f64,
    ) {
        let n = postures.len();
        let around = if runs {
            leg::RUN_UNLOAD_TIME
        } else {
            leg::UNLOAD_TIME
        };
        let half = (around * rate_hz) as usize;
        let angles: Vec<_> = postures.iter().map(anatomical_angles).collect();
        for s in 0..2 {
            let d = DOF_START[FEET[s].index()];
            let over = |dof: usize, up: bool| -> Vec<f64> {
                let raw: Vec<f64> = (0..n)
                    .map(|i| {
                        if !planted[i][s] {
                            return 0.0;
                        }
                        let a = angles[i][dof];
                        let e = if up {
                            a - body.upper[dof]
                        } else {
                            body.lower[dof] - a
                        };
                        -(e + leg::PLANTED_MARGIN).max(0.0)
                    })
                    .collect();
                smooth_minimum(&raw, half).into_iter().map(|x| -x).collect()
            };
            let hip = DOF_START[THIGHS[s].index()];
            let StanceTurns {
                heel_up,
                toe_out,
                tip,
            } = &mut self.feet[s];
            for (i, (sum, e)) in heel_up.iter_mut().zip(over(d, true)).enumerate() {
                // A runner's pelvis is lower in the first rounds than in the last: any excess is given back.
                if runs && e == 0.0 && *sum > 0.0 && planted[i][s] && tip[i] < pitch::FLAT {
                    let spare = (body.upper[d] - leg::PLANTED_MARGIN - angles[i][d]).max(0.0);
                    *sum = (*sum - spare).max(0.0);
                }
                *sum += e;
            }
            let (inward, outward) = (over(d + 2, true), over(d + 2, false));
            // A thigh adducted too far goes out with the knee, one abducted too far goes in.
            let (abducted, adducted) = (over(hip + 1, true), over(hip + 1, false));
            for (i, sum) in self.turn_in[s].iter_mut().enumerate() {
                *sum = (*sum + inward[i] - outward[i] + abducted[i] - adducted[i])
                    .clamp(-leg::MOST_TURN, leg::MOST_TURN);
            }
            let (rotated_in, rotated_out) = (over(hip + 2, true), over(hip + 2, false));
            for st in stances[s] {
                let most = |v: &[f64]| v[st.start..st.end].iter().copied().fold(0.0, f64::max);
                let e = leg::HEADING_GAIN * (most(&rotated_in) - most(&rotated_out));
                for i in st.start..st.end {
                    toe_out[i] = (toe_out[i] + e).clamp(-leg::MOST_TURN, leg::MOST_TURN);
                    self.turn_in[s][i] =
                        (self.turn_in[s][i] - e).clamp(-leg::MOST_TURN, leg::MOST_TURN);
                }
            }
            low_pass(&mut self.turn_in[s], leg::TURN_CUTOFF, rate_hz);
        }
        pelvis_yaw::add(body, postures, planted, stances, &mut self.yaw, rate_hz);
    }
}
