//! A wrench on the root of the body with a price and a bound (`docs/equations.md`, 14.2).
//!
//! Moment and force each minimise `½ |w − rest|²/κ + w·x` within the ball `|w| ≤ most`, where `x` is the price of the
//! dynamics along the root's angular or linear velocity. So `w` is the nearest point of the ball to `rest − κ x`: a
//! motor in three dimensions whose limit is a norm. Its derivative is symmetric and positive semidefinite inside the
//! ball and beyond it, so that Newton's method treats the bound as it treats friction, without solving again.

use crate::body::topology::NV;
use crate::math::Vec3;

/// Moment or force of a wrench.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BallForce {
    /// κ: force per unit of price.
    pub gain: f64,
    /// Force at price 0.
    pub rest: Vec3,
    /// Largest norm.
    pub most: f64,
}

/// A force as it was brought into its ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CutForce {
    /// The force.
    pub force: Vec3,
    /// Its norm over that of the free force, 0…1.
    pub share: f64,
}

impl Default for CutForce {
    fn default() -> Self {
        Self {
            force: Vec3::zero(),
            share: 1.0,
        }
    }
}

/// A wrench on the root: moment about its origin, then force; world axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootWrench(pub [BallForce; 2]);

impl BallForce {
    /// The force at this price.
    #[inline(always)]
    pub(crate) fn value(&self, price: Vec3) -> CutForce {
        let free = self.rest - price * self.gain;
        let size = free.dot(free).sqrt();
        let share = if size <= self.most {
            1.0
        } else {
            self.most / size
        };
        CutForce {
            force: free * share,
            share,
        }
    }

    /// Derivative of the force, with this value, with respect to minus the price.
    #[inline(always)]
    pub(crate) fn slope(&self, CutForce { force, share }: CutForce) -> [[f64; 3]; 3] {
        let along = force.to_array();
        // At the bound only the direction changes.
        let cut = if share < 1.0 && self.most > 0.0 {
            1.0 / (self.most * self.most)
        } else {
            0.0
        };
        let k = self.gain * share;
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let own = if i == j { 1.0 } else { 0.0 };
                k * (own - cut * along[i] * along[j])
            })
        })
    }
}

impl RootWrench {
    /// The part of a price, or of a step of it, that moment (0) or force (1) sees.
    #[inline(always)]
    pub(crate) fn seen(x: &[f64; NV], part: usize) -> Vec3 {
        Vec3 {
            x: x[3 * part],
            y: x[3 * part + 1],
            z: x[3 * part + 2],
        }
    }

    /// Rate of work of the wrench at price `x + a d` along `d`.
    #[inline(always)]
    pub(crate) fn along(&self, x: &[f64; NV], d: &[f64; NV], a: f64) -> f64 {
        let mut sum = 0.0;
        for (part, ball) in self.0.iter().enumerate() {
            let way = Self::seen(d, part);
            let cut = ball.value(Self::seen(x, part) + way * a);
            sum += way.dot(cut.force);
        }
        sum
    }
}

/// A force strictly inside its ball, for the interior-point method: `½ (most² − |w|²) ≥ 0` with multiplier `z`, and
/// `(w − rest)/κ + x + z w = 0`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InnerForce {
    w: Vec3,
    z: f64,
    dw: Vec3,
    dz: f64,
    /// Slope as last eliminated.
    pub(crate) slope: [[f64; 3]; 3],
}

impl InnerForce {
    /// Starts in the middle, with a multiplier of the size that a motor of half range `widest` would have.
    #[inline(always)]
    pub(crate) fn begin(ball: &BallForce, size: f64, widest: f64) -> Self {
        Self {
            z: 2.0 * size * widest / (ball.most * ball.most),
            ..Self::default()
        }
    }

    #[inline(always)]
    fn room(&self, ball: &BallForce) -> f64 {
        0.5 * (ball.most * ball.most - self.w.dot(self.w))
    }

    /// Product of multiplier and room.
    #[inline(always)]
    pub(crate) fn gap(&self, ball: &BallForce) -> f64 {
        self.z * self.room(ball)
    }

    /// Eliminates the force at `price`, as a motor is eliminated.
    #[inline(always)]
    pub(crate) fn eliminate(&mut self, ball: &BallForce, price: Vec3, aim: f64) {
        let (room, w) = (self.room(ball), self.w);
        // Inverse of (1/κ + z) 1 + (z/room) w wᵀ.
        let a = 1.0 / ball.gain + self.z;
        let c = self.z / room;
        let cut = c / (a + c * w.dot(w));
        let along = w.to_array();
        self.slope = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let own = if i == j { 1.0 } else { 0.0 };
                (own - cut * along[i] * along[j]) / a
            })
        });
        let residual = (w - ball.rest) * (1.0 / ball.gain) + price + w * (aim / room);
        self.dw = self.times(residual) * -1.0;
    }

    #[inline(always)]
    fn times(&self, v: Vec3) -> Vec3 {
        let v = v.to_array();
        Vec3::from_array(self.slope.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2]))
    }

    /// The force after the step.
    #[inline(always)]
    pub(crate) fn next(&self) -> Vec3 {
        self.w + self.dw
    }

    /// Its steps for a change of the price; the largest step ≤ `most` that keeps it inside.
    #[inline(always)]
    pub(crate) fn direct(&mut self, ball: &BallForce, change: Vec3, aim: f64, most: f64) -> f64 {
        self.dw -= self.times(change);
        let room = self.room(ball);
        let out = self.w.dot(self.dw);
        self.dz = (aim + self.z * out) / room - self.z;
        let mut step = most;
        if self.dz < 0.0 {
            step = step.min(-self.z / self.dz);
        }
        // |w + t dw| = most
        let way = self.dw.dot(self.dw);
        if way > 0.0 {
            step = step.min(((out * out + 2.0 * way * room).sqrt() - out) / way);
        }
        step
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self, step: f64) {
        self.w += self.dw * step;
        self.z += self.dz * step;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::vec3;

    #[test]
    fn a_force_is_the_nearest_point_of_its_ball_and_its_slope_is_the_derivative() {
        let ball = BallForce {
            gain: 40.0,
            rest: vec3(30.0, -20.0, 5.0),
            most: 90.0,
        };
        for price in [
            vec3(0.5, 0.1, -0.7),
            vec3(2.0, -3.0, 4.0),
            vec3(0.0, 0.0, 0.0),
        ] {
            let cut = ball.value(price);
            assert!(cut.force.norm() <= ball.most * (1.0 + 1e-15));
            let free = ball.rest - price * ball.gain;
            let nearest = free.capped(ball.most);
            assert!((cut.force - nearest).norm() < 1e-12);
            let slope = ball.slope(cut);
            for i in 0..3 {
                let e = [Vec3::X, Vec3::Y, Vec3::Z][i] * 1e-6;
                let change = (ball.value(price - e).force - ball.value(price + e).force) * 0.5e6;
                for (j, c) in change.to_array().into_iter().enumerate() {
                    assert!((slope[j][i] - c).abs() < 1e-6, "{slope:?} {change:?}");
                }
            }
        }
    }

    #[test]
    fn a_ball_without_room_holds_no_force() {
        let ball = BallForce {
            gain: 40.0,
            rest: vec3(1.0, 0.0, 0.0),
            most: 0.0,
        };
        let value = ball.value(vec3(0.0, 3.0, 0.0));
        assert_eq!(value.force, Vec3::zero());
        assert_eq!(ball.slope(value), [[0.0; 3]; 3]);
    }
}
