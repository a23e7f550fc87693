//! The seam of a clip that repeats.

use super::*;

/// Length of the blend at the seam of a loop, s; at most a quarter of the clip.
const SEAM: f64 = 0.25;

/// The end of a loop: the correction that brings the last posture to the first one, displaced by one loop.
#[derive(Clone, Debug)]
pub(super) struct Seam {
    /// Displacement of one loop.
    pub advance: PlanarTransform,
    /// Length of the blend, s.
    pub length: f64,
    /// Correction at the end, and its first two derivatives.
    end: [[f64; NV]; 3],
}

impl Clip {
    pub(super) fn make_seam(&self) -> Option<Box<Seam>> {
        let last = self.lead_in + self.len().checked_sub(2)? + 1;
        let (first, end) = (&self.knots[self.lead_in], &self.knots[last]);
        // Heading and place of the end, seen from the start.
        let turned = end.posture.root_rotation * first.posture.root_rotation.conjugate();
        let yaw = 2.0 * trig::atan2(turned.z, turned.w);
        let mut advance = PlanarTransform {
            x: 0.0,
            y: 0.0,
            yaw,
        };
        let from = advance.point(first.posture.root_position);
        advance.x = end.posture.root_position.x - from.x;
        advance.y = end.posture.root_position.y - from.y;

        // The goal of the blend at its end: the first sample, displaced by one loop.
        let mut goal = Target {
            posture: first.posture,
            velocity: first.first,
            acceleration: first.second,
            planted: first.planted,
        };
        turn_root_rates(&mut goal);
        advance.apply_to(&mut goal);
        let root = goal.posture.root_rotation.conjugate();
        turn_root(root, &mut goal.velocity);
        turn_root(root, &mut goal.acceleration);
        let e = local_difference(&end.posture, &goal.posture);
        let mut ends = [e, [0.0; NV], [0.0; NV]];
        for_each_part(|part| match part {
            Part::Scalar(k) => {
                ends[1][k] = goal.velocity[k] - end.first[k];
                ends[2][k] = goal.acceleration[k] - end.second[k];
            }
            Part::Rotation { start, ball } => {
                // q = q_clip · exp(ε):  ω = Rᵀ ω_clip + Ω,  α = Rᵀ α_clip + (Rᵀ ω_clip) × Ω + Ω̇,  R = exp(ε)
                let epsilon = vector(ball, start, &e);
                let back = Quat::exp(-epsilon);
                let carried = back.rotate(vector(ball, start, &end.first));
                let omega = vector(ball, start, &goal.velocity) - carried;
                let alpha = vector(ball, start, &goal.acceleration)
                    - back.rotate(vector(ball, start, &end.second))
                    - carried.cross(omega);
                let (d, a) = rotation_vector::vector_rates(epsilon, omega, alpha);
                set_vector(ball, start, d, &mut ends[1]);
                set_vector(ball, start, a, &mut ends[2]);
            }
        });
        Some(Box::new(Seam {
            advance,
            length: SEAM.min(0.25 * self.duration()),
            end: ends,
        }))
    }
}

impl Seam {
    /// Adds the correction at `into` seconds after the blend's start.
    pub(super) fn blend(&self, into: f64, target: &mut Target) {
        let fifth = |k: usize| {
            let end = [self.end[0][k], self.end[1][k], self.end[2][k]];
            curve::quintic(self.length, into, 0.0, 0.0, end[0], end[1], end[2])
        };
        let curve: [[f64; 3]; NV] = std::array::from_fn(fifth);
        let row = |r: usize| -> [f64; NV] { std::array::from_fn(|k| curve[k][r]) };
        let (value, slope, bend) = (row(0), row(1), row(2));
        let root = target.posture.root_rotation.conjugate();
        turn_root(root, &mut target.velocity);
        turn_root(root, &mut target.acceleration);
        for_each_part(|part| match part {
            Part::Scalar(k) => {
                add_scalar(&mut target.posture, k, value[k]);
                target.velocity[k] += slope[k];
                target.acceleration[k] += bend[k];
            }
            Part::Rotation { start, ball } => {
                let epsilon = vector(ball, start, &value);
                let (omega, alpha) = rotation_vector::rates(
                    epsilon,
                    vector(ball, start, &slope),
                    vector(ball, start, &bend),
                );
                let back = Quat::exp(-epsilon);
                let carried = back.rotate(vector(ball, start, &target.velocity));
                let turned = back.rotate(vector(ball, start, &target.acceleration));
                let q = rotation_mut(&mut target.posture, ball);
                *q = (*q * Quat::exp(epsilon)).normalized();
                set_vector(ball, start, carried + omega, &mut target.velocity);
                set_vector(
                    ball,
                    start,
                    turned + carried.cross(omega) + alpha,
                    &mut target.acceleration,
                );
            }
        });
        turn_root_rates(target);
    }
}
