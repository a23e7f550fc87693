//! Initial accelerations from the desired motion, Eq. (4), and the same law for points (`docs/equations.md#repairs`).

use crate::body::angles::swing_twist;
use crate::body::state::{ball_rate_vector, ball_rates};
use crate::body::topology::{DOF_AXIS, DOF_LEN, DOF_START, JOINT, Joint};
use crate::body::{Body, DOF_COUNT, Posture, SEGMENT_COUNT, State};
use crate::control::rows::{JointRow, ROW};
use crate::math::dense::solve_3;
use crate::math::{Vec3, vec3::vec3};
use crate::motion::{Target, TargetPair};
use crate::setup::ControlParams;

/// Position gain of the law with a horizon, times T²: critical damping.
const CRITICAL: f64 = 0.25;
/// Share of an existing violation of a joint limit that is corrected per step.
const LIMIT_RETURN: f64 = 0.2;
/// Step for which the paper gives its α, s.
const PAPER_STEP: f64 = 1.0 / 30.0;

/// The tracking law: turns errors of position and rate into a demanded acceleration.
///
/// Without horizon it is Eq. (4), with α made independent of the step, `α(Δt) = 1 − (1 − α)^(Δt / (1/30 s))`. With a
/// horizon T (S3) it is `a_ff + (0.25/T²) error + (1/T) rate error`, errors at the start of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    alpha: f64,
    horizon: Option<f64>,
    dt: f64,
}

impl Law {
    /// The law that the parameters ask for, at step `dt` (s). A horizon shorter than the step is replaced by the step.
    pub fn new(params: &ControlParams, dt: f64) -> Self {
        Self {
            alpha: 1.0 - power(1.0 - params.alpha, dt / PAPER_STEP),
            horizon: params.horizon.map(|t| t.max(dt)),
            dt,
        }
    }

    /// The same law with `share` of the horizon, but never shorter than the step.
    pub fn sharpened(self, share: f64) -> Self {
        Self {
            horizon: self.horizon.map(|t| (share * t).max(self.dt)),
            ..self
        }
    }

    /// Length of the step, s.
    pub fn step(&self) -> f64 {
        self.dt
    }

    /// The horizon, or the step for the law without one, s.
    pub fn horizon_or_step(&self) -> f64 {
        self.horizon.unwrap_or(self.dt)
    }

    /// Whether errors are taken at the start of the step (with a horizon) rather than against the desired state at its
    /// end (4).
    pub fn uses_errors_now(&self) -> bool {
        self.horizon.is_some()
    }

    /// Demanded acceleration.
    ///
    /// * `now`: error of position and desired rate at the start of the step; `next`: position error of the present
    ///   state against the desired position at the end of the step, and desired rate there. `rate`: present rate. All
    ///   in the same axes.
    ///
    /// Equation (4) of the paper.
    #[inline(always)]
    pub fn demand(&self, now: (f64, f64), next: (f64, f64), rate: f64) -> f64 {
        let dt = self.dt;
        match self.horizon {
            Some(t) => (next.1 - now.1) / dt + CRITICAL / (t * t) * now.0 + (now.1 - rate) / t,
            None => {
                let position = (next.0 / dt - rate) / dt; // θ̈_a of Eq. 4
                let velocity = (next.1 - rate) / dt; // θ̈_v of Eq. 4
                self.alpha * position + (1.0 - self.alpha) * velocity
            }
        }
    }

    /// The same per component.
    pub fn demand_vector(&self, now: (Vec3, Vec3), next: (Vec3, Vec3), rate: Vec3) -> Vec3 {
        vec3(
            self.demand((now.0.x, now.1.x), (next.0.x, next.1.x), rate.x),
            self.demand((now.0.y, now.1.y), (next.0.y, next.1.y), rate.y),
            self.demand((now.0.z, now.1.z), (next.0.z, next.1.z), rate.z),
        )
    }
}

/// `x^y` for 0 < x ≤ 1 and y > 0 with additions and multiplications only: the platform's `powf` need not give the same
/// bits everywhere.
fn power(x: f64, y: f64) -> f64 {
    // Square-and-multiply for the integer part, repeated square roots for the binary fraction.
    let (mut whole, mut fraction) = (y.trunc().min(1e9) as u64, y.fract());
    let (mut result, mut square) = (1.0, x);
    while whole > 0 {
        if whole & 1 == 1 {
            result *= square;
        }
        square *= square;
        whole >>= 1;
    }
    let mut root = x;
    for _ in 0..52 {
        root = root.sqrt();
        fraction *= 2.0;
        if fraction >= 1.0 {
            result *= root;
            fraction -= 1.0;
        }
    }
    result
}

/// Joint errors and desired rates in the axes of the present state: `error = log(R⁻¹ R_des)` along the child axes for
/// ball joints, and desired rates turned from the desired child axes into the present ones by `R⁻¹ R_des`.
fn errors(posture: &Posture, target: &Target) -> ([f64; DOF_COUNT], [f64; DOF_COUNT]) {
    let error = posture.joint_difference(&target.posture);
    let mut rate = [0.0; DOF_COUNT];
    for s in 1..SEGMENT_COUNT {
        let d = DOF_START[s];
        let desired = &target.velocity[6 + d..6 + d + DOF_LEN[s]];
        if let Joint::Ball(b) = JOINT[s] {
            let relative = posture.ball[b].conjugate() * target.posture.ball[b];
            let w = relative.rotate(ball_rate_vector(d, desired));
            rate[d..d + 3].copy_from_slice(&ball_rates(d, w));
        } else {
            rate[d..d + DOF_LEN[s]].copy_from_slice(desired);
        }
    }
    (error, rate)
}

/// θ̈_initial of Eq. (4), or its form with a horizon (S3), then clamped so that the next anatomical angles stay inside
/// the limits.
///
/// * Returns joint accelerations in rad/s² (ball joints: along the signed child axes), padded. No allocation.
#[inline(always)]
pub fn initial_acceleration(
    body: &Body,
    state: &State,
    target: &TargetPair,
    law: &Law,
) -> JointRow {
    let posture = &state.posture;
    let (e0, r0) = errors(posture, &target.now);
    let (e1, mut r1) = errors(posture, &target.next);
    if law.uses_errors_now() {
        // The feed-forward is a difference of rates over the step; both must be seen in the same (present desired)
        // axes.
        for s in 1..SEGMENT_COUNT {
            if let Joint::Ball(b) = JOINT[s] {
                let d = DOF_START[s];
                let relative = posture.ball[b].conjugate() * target.now.posture.ball[b];
                let w = ball_rate_vector(d, &target.next.velocity[6 + d..6 + d + 3]);
                r1[d..d + 3].copy_from_slice(&ball_rates(d, relative.rotate(w)));
            }
        }
    }
    let mut qdd = [0.0; ROW];
    for d in 0..DOF_COUNT {
        qdd[d] = law.demand((e0[d], r0[d]), (e1[d], r1[d]), state.velocity[6 + d]);
    }
    clamp_to_limits(body, state, law.dt, &mut qdd);
    qdd
}

/// Clamps accelerations so that the anatomical angles after the step are inside the joint limits (§7). An angle that is
/// already outside comes back by [`LIMIT_RETURN`] of its violation per step, not at once: a dead-beat return would
/// saturate the joint.
#[inline(always)]
fn clamp_to_limits(body: &Body, state: &State, dt: f64, qdd: &mut JointRow) {
    let clamp = |d: usize, angle: f64, next_rate: f64| {
        let bound = |limit: f64, outside: bool| {
            (limit - angle) / dt * if outside { LIMIT_RETURN } else { 1.0 }
        };
        let (lower, upper) = (body.lower[d], body.upper[d]);
        let next_rate = next_rate.min(bound(upper, angle > upper));
        next_rate.max(bound(lower, angle < lower))
    };
    for s in 1..SEGMENT_COUNT {
        let d = DOF_START[s];
        match JOINT[s] {
            Joint::Free => {}
            Joint::Hinge1(h) | Joint::Hinge2(h) => {
                for k in 0..DOF_LEN[s] {
                    let rate = state.velocity[6 + d + k];
                    let next = rate + dt * qdd[d + k];
                    let allowed = clamp(d + k, state.posture.hinge[h + k], next);
                    if allowed != next {
                        qdd[d + k] = (allowed - rate) / dt;
                    }
                }
            }
            Joint::Ball(b) => {
                // Anatomical angles are not the integral of the rates: go through their rate map and back.
                let st = swing_twist(state.posture.ball[b]);
                let angles = [st.swing.x, st.swing.y, st.twist];
                let rate = ball_rate_vector(d, &state.velocity[6 + d..6 + d + 3]);
                let next = rate + ball_rate_vector(d, &qdd[d..d + 3]) * dt;
                let (mut wanted, mut acted) = ([0.0; 3], false);
                for k in 0..3 {
                    let a = DOF_AXIS[d + k];
                    let (i, sign) = (a.axis, f64::from(a.sign));
                    let u = st.rate_rows[i].dot(next);
                    let allowed = sign * clamp(d + k, sign * angles[i], sign * u);
                    acted |= allowed != u;
                    wanted[i] = allowed;
                }
                if acted && let Some(w) = solve_3(&st.rate_rows, wanted) {
                    let w = (w - rate) * (1.0 / dt);
                    qdd[d..d + 3].copy_from_slice(&ball_rates(d, w));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::angles::anatomical_angles;
    use crate::math::Quat;
    use crate::support::testing::{Rng, mannequin, random_state, standing};

    fn paper() -> ControlParams {
        ControlParams {
            horizon: None,
            ..ControlParams::default()
        }
    }

    #[test]
    fn power_matches_the_platform() {
        for (x, y) in [
            (0.8, 1.0),
            (0.8, 0.5),
            (0.8, 30.0 / 120.0),
            (0.3, 3.7),
            (1.0, 0.1),
        ] {
            assert!((power(x, y) - f64::powf(x, y)).abs() < 1e-14);
        }
    }

    /// Equation (4) of the paper.
    #[test]
    fn error_shrinks_by_one_minus_alpha_per_step_at_every_step_size() {
        let body = mannequin();
        for (rate, ratio) in [
            (30.0, 0.8f64),
            (60.0, 0.8f64.sqrt()),
            (120.0, 0.8f64.powf(0.25)),
        ] {
            let dt = 1.0 / rate;
            let law = Law::new(&paper(), dt);
            let mut state = standing(&body);
            let desired = state.posture;
            // A hinge and one axis of a ball joint, where errors of rotations add like numbers.
            state.posture.hinge[8] += 0.2;
            state.posture.ball[0] = state.posture.ball[0] * Quat::exp(vec3(0.0, 0.1, 0.0));
            // Desired: both turn at constant speed, so θ_des(t+Δt) − Δt θ̇_des(t+Δt) = θ_des(t).
            let mut target = Target::still(desired);
            target.velocity[6 + 26] = 0.3;
            target.velocity[6] = 0.2;
            let mut last: Option<[f64; DOF_COUNT]> = None;
            for _ in 0..12 {
                let mut next = target.clone();
                next.posture.integrate(&target.velocity, dt);
                let pair = TargetPair { now: target, next };
                let qdd = initial_acceleration(&body, &state, &pair, &law);
                for d in 0..DOF_COUNT {
                    state.velocity[6 + d] += dt * qdd[d];
                }
                let v = state.velocity;
                state.posture.integrate(&v, dt);
                let e = state.posture.joint_difference(&pair.next.posture);
                if let Some(last) = last {
                    for d in [0, 26] {
                        assert!(
                            (e[d] / last[d] - ratio).abs() < 1e-9,
                            "DOF {d} at {rate} Hz"
                        );
                    }
                }
                last = Some(e);
                target = pair.next;
            }
        }
    }

    /// Repair S3.
    #[test]
    fn horizon_is_critically_damped_and_feeds_the_desired_acceleration_forward() {
        let body = mannequin();
        let law = Law::new(&ControlParams::default(), 1.0 / 60.0);
        assert!((law.demand((0.1, 0.0), (9.0, 0.0), 0.0) - 2.5).abs() < 1e-12);
        assert!((law.demand((0.0, 0.5), (9.0, 0.5), 0.0) - 5.0).abs() < 1e-12);
        assert!((law.demand((0.0, 0.5), (9.0, 0.6), 0.5) - 6.0).abs() < 1e-10);
        // Without any error only the feed-forward remains, which is exactly zero at rest.
        let state = standing(&body);
        let still = Target::still(state.posture);
        let pair = TargetPair {
            now: still.clone(),
            next: still,
        };
        let qdd = initial_acceleration(&body, &state, &pair, &law);
        assert!(qdd.iter().all(|a| a.abs() < 1e-9));
    }

    /// Equation (4) of the paper.
    #[test]
    fn desired_rates_are_seen_in_present_axes() {
        // Present joint turned by 90° about x against the desired one: a desired rate about the desired child's y is
        // one about the present child's axis R⁻¹ R_des y.
        let body = mannequin();
        let mut state = standing(&body);
        let mut target = Target::still(state.posture);
        state.posture.ball[0] = Quat::identity();
        target.posture.ball[0] = Quat::exp(vec3(std::f64::consts::FRAC_PI_2, 0.0, 0.0));
        target.velocity[6] = 1.0; // waist flexion, +y
        let (_, rate) = errors(&state.posture, &target);
        assert!(rate[0].abs() < 1e-12 && (rate[2] - 1.0).abs() < 1e-12);
    }

    /// Equation (4) of the paper.
    #[test]
    fn next_angles_stay_inside_the_limits() {
        let body = mannequin();
        let (dt, mut rng) = (1.0 / 60.0, Rng::new(8));
        for horizon in [None, Some(0.1)] {
            let params = ControlParams {
                horizon,
                ..ControlParams::default()
            };
            let law = Law::new(&params, dt);
            for _ in 0..200 {
                let mut state = random_state(&body, &mut rng, 1.5, 5.0);
                let pair = TargetPair {
                    now: Target::still(random_state(&body, &mut rng, 3.0, 0.0).posture),
                    next: Target::still(random_state(&body, &mut rng, 3.0, 0.0).posture),
                };
                let qdd = initial_acceleration(&body, &state, &pair, &law);
                for d in 0..DOF_COUNT {
                    state.velocity[6 + d] += dt * qdd[d];
                }
                let v = state.velocity;
                let before = anatomical_angles(&state.posture);
                state.posture.integrate(&v, dt);
                let a = anatomical_angles(&state.posture);
                for d in 0..DOF_COUNT {
                    let ball = DOF_LEN[crate::body::topology::DOF_SEGMENT[d]] == 3;
                    // First order in the step for ball joints, exact for hinges.
                    let slack = if ball {
                        0.5 * (a[d] - before[d]).abs() + 0.02
                    } else {
                        1e-12
                    };
                    assert!(
                        a[d] > body.lower[d] - slack && a[d] < body.upper[d] + slack,
                        "{d}"
                    );
                }
            }
        }
    }
}
