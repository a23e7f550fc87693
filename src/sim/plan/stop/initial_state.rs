//! The initial state of a stop: where the body is in the last samples of a motion, and how it moves.

use crate::body::topology::NV;
use crate::body::{Body, Posture};
use crate::math::runs::runs;
use crate::math::{Quat, Vec3};
use crate::motion::leg_ik::{center_of_mass, forward};
use crate::plan::foot_lock::{Sole, turn, yaw_pitch};
use crate::plan::params::{contact, stop};
use crate::plan::prepare::Draft;

/// Pose and velocity of a foot at the end of a motion.
#[derive(Clone, Copy)]
pub(super) struct FootState {
    pub(super) ankle: Vec3,
    /// Velocity of the ankle, m/s.
    pub(super) velocity: Vec3,
    /// `world_from_foot`.
    pub(super) rotation: Quat,
    /// Rate of the rotation, rad/s.
    pub(super) spin: Vec3,
    /// Point of the floor under the flat ankle, m.
    pub(super) place: Vec3,
    pub(super) yaw: f64,
    pub(super) down: bool,
    /// How long the foot has been in the air, s.
    pub(super) since: f64,
}

/// The initial state of a stop.
pub(super) struct InitialState {
    pub(super) posture: Posture,
    pub(super) rates: [f64; NV],
    pub(super) com: Vec3,
    pub(super) velocity: Vec3,
    /// Velocity of the pelvis, m/s.
    pub(super) pelvis_velocity: Vec3,
    pub(super) feet: [FootState; 2],
    pub(super) heading: f64,
}

impl InitialState {
    /// Reads the state off the last samples of a draft.
    pub(super) fn of(body: &Body, draft: &Draft, soles: &[Sole; 2]) -> Self {
        let last = draft.postures.len() - 1;
        let half = ((0.5 * stop::MEASURED_TIME * draft.rate_hz) as usize).clamp(1, last / 2);
        let b = &draft.postures[last];
        // Slope of the parabola through three samples, at the last one: the mean over that time lags by half of it.
        let back = [last - half, last - 2 * half];
        let per_s = 0.5 * draft.rate_hz / half as f64;
        let slope = |far: [Vec3; 2]| (far[0] * 4.0 - far[1]) * per_s;
        let turned_by =
            |q: &dyn Fn(usize) -> Quat| slope(back.map(|i| (q(last) * q(i).conjugate()).log()));
        let mut rates = [0.0; NV];
        rates[..3].copy_from_slice(&turned_by(&|i| draft.postures[i].root_rotation).to_array());
        let joints = back.map(|i| draft.postures[i].joint_difference(b));
        for (r, (near, far)) in rates[6..].iter_mut().zip(joints[0].iter().zip(joints[1])) {
            *r = (4.0 * near - far) * per_s;
        }
        for r in &mut rates {
            *r = r.clamp(-stop::MOST_RATE, stop::MOST_RATE);
        }
        // A foot about to come down, or one that has just left the floor, may look as if both were in the air.
        let flight = draft.label.iter().rev();
        let flight = flight.take_while(|l| **l == [false; 2]).count();
        let down = if flight <= last && (flight as f64) < contact::SHORTEST * draft.rate_hz {
            draft.label[last - flight]
        } else {
            [false; 2]
        };
        let pelvis = yaw_pitch(b.root_rotation).0;
        let feet: Vec<f64> = (0..2)
            .filter(|s| down[*s])
            .map(|s| turn(pelvis, yaw_pitch(draft.foot[s][last]).0))
            .collect();
        let heading = pelvis + 0.5 * feet.iter().sum::<f64>() / feet.len().max(1) as f64;
        let com = |i: usize| center_of_mass(body, &forward(body, &draft.postures[i]));
        let moved = |p: &dyn Fn(usize) -> Vec3| slope(back.map(|i| p(last) - p(i)));
        let feet = [0, 1].map(|s: usize| {
            let (ankle, rotation) = (draft.ankle[s][last], draft.foot[s][last]);
            let (yaw, pitch) = yaw_pitch(rotation);
            let place = ankle - soles[s].stand(Vec3::zero(), yaw, pitch).ankle;
            let on: Vec<bool> = draft.label.iter().map(|l| l[s]).collect();
            let since = match runs(&on).last() {
                Some((i, j, false)) => (j - i) as f64 / draft.rate_hz,
                _ => 0.0,
            };
            FootState {
                ankle,
                velocity: moved(&|i| draft.ankle[s][i]),
                rotation,
                spin: turned_by(&|i| draft.foot[s][i]),
                place: place.horizontal(),
                yaw,
                down: down[s],
                since,
            }
        });
        Self {
            posture: *b,
            rates,
            com: com(last),
            velocity: moved(&com),
            pelvis_velocity: moved(&|i| draft.postures[i].root_position),
            feet,
            heading,
        }
    }

    /// Feet on the floor.
    pub(super) fn down(&self) -> [bool; 2] {
        self.feet.map(|f| f.down)
    }

    /// Whether the body is in motion, so that a clip which ended here would end in motion.
    pub(super) fn moves(&self) -> bool {
        self.pelvis_velocity.level() > stop::MOVING_SPEED
    }
}
