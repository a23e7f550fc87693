//! Curves over time from which motions are authored, and the noise of recordings. Every operation is exact or correctly
//! rounded (sum, product, quotient, root) or comes from the project's portable sine, so that the bytes are equal on
//! every machine.

use sinew_physics::math::Vec3;

/// Degrees to radians.
pub const DEG: f64 = std::f64::consts::PI / 180.0;

/// From 0 to 1 with zero velocity and acceleration at both ends (minimum jerk); constant outside.
pub fn ease(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * u * (10.0 + u * (6.0 * u - 15.0))
}

/// 0 before `a`, 1 after `b`, minimum jerk between.
pub fn ramp(t: f64, a: f64, b: f64) -> f64 {
    ease((t - a) / (b - a))
}

/// A bump of height 1 between `a` and `b`, with zero velocity at both ends, highest in the middle.
pub fn bump(t: f64, a: f64, b: f64) -> f64 {
    let u = ((t - a) / (b - a)).clamp(0.0, 1.0);
    let w = 4.0 * u * (1.0 - u);
    w * w * w
}

/// One end of a quintic.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    pub t: f64,
    pub value: f64,
    pub rate: f64,
    pub acceleration: f64,
}

/// A key with zero rate and acceleration.
pub fn rest(t: f64, value: f64) -> Key {
    Key {
        t,
        value,
        rate: 0.0,
        acceleration: 0.0,
    }
}

/// Quintic between two keys: value at `t`.
fn quintic(a: Key, b: Key, t: f64) -> f64 {
    let h = b.t - a.t;
    if h <= 0.0 {
        return b.value;
    }
    let u = (t - a.t) / h;
    let (p0, v0, a0) = (a.value, a.rate * h, a.acceleration * h * h);
    let (p1, v1, a1) = (b.value, b.rate * h, b.acceleration * h * h);
    let c3 = 10.0 * (p1 - p0) - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
    let c4 = -15.0 * (p1 - p0) + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
    let c5 = 6.0 * (p1 - p0) - 3.0 * (v0 + v1) - 0.5 * (a0 - a1);
    p0 + u * (v0 + u * (0.5 * a0 + u * (c3 + u * (c4 + u * c5))))
}

/// A curve through keys, quintic between them, constant outside. Twice continuously differentiable.
#[derive(Clone, Debug, Default)]
pub struct Track(Vec<Key>);

impl Track {
    /// Through the given keys, which are in order of time.
    pub fn new(keys: Vec<Key>) -> Self {
        Self(keys)
    }

    /// At rest at every key.
    pub fn still(keys: &[(f64, f64)]) -> Self {
        Self(keys.iter().map(|&(t, v)| rest(t, v)).collect())
    }

    /// Through the given values, with the mean of the neighbouring slopes as rate at inner keys (zero at a local
    /// extreme), at rest at the ends.
    pub fn through(keys: &[(f64, f64)]) -> Self {
        let n = keys.len();
        Self(
            (0..n)
                .map(|i| {
                    let rate = if i == 0 || i + 1 == n {
                        0.0
                    } else {
                        let before = (keys[i].1 - keys[i - 1].1) / (keys[i].0 - keys[i - 1].0);
                        let after = (keys[i + 1].1 - keys[i].1) / (keys[i + 1].0 - keys[i].0);
                        if before * after <= 0.0 {
                            0.0
                        } else {
                            2.0 * before * after / (before + after)
                        }
                    };
                    Key {
                        rate,
                        ..rest(keys[i].0, keys[i].1)
                    }
                })
                .collect(),
        )
    }

    /// Value at `t`; 0 without keys.
    pub fn at(&self, t: f64) -> f64 {
        let k = &self.0;
        let (Some(first), Some(last)) = (k.first(), k.last()) else {
            return 0.0;
        };
        if t <= first.t {
            return first.value;
        }
        if t >= last.t {
            return last.value;
        }
        let i = k.partition_point(|key| key.t <= t);
        quintic(k[i - 1], k[i], t)
    }
}

/// Samples at a fixed step, read between samples by a cubic through four of them.
#[derive(Clone, Debug, Default)]
pub struct Sampled {
    pub step: f64,
    pub values: Vec<f64>,
}

impl Sampled {
    /// Value at `t` s.
    pub fn at(&self, t: f64) -> f64 {
        let n = self.values.len();
        let x = (t / self.step).clamp(0.0, (n - 1) as f64);
        let i = (x.floor() as usize).min(n.saturating_sub(2));
        let u = x - i as f64;
        let v = |k: isize| self.values[(i as isize + k).clamp(0, n as isize - 1) as usize];
        let (a, b, c, d) = (v(-1), v(0), v(1), v(2));
        let m0 = 0.5 * (c - a);
        let m1 = 0.5 * (d - b);
        b + u * (m0 + u * (3.0 * (c - b) - 2.0 * m0 - m1 + u * (2.0 * (b - c) + m0 + m1)))
    }
}

/// Pseudo-random numbers (PCG-XSH-RR, 64-bit state), a fixed sequence per seed.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of `seed`.
    pub fn new(seed: u64) -> Self {
        let mut r = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x853c_49e6_748f_ea9b);
        r.next();
        r.next();
        r
    }

    fn next(&mut self) -> u32 {
        let s = self.0;
        self.0 = s
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let x = (((s >> 18) ^ s) >> 27) as u32;
        x.rotate_right((s >> 59) as u32)
    }

    /// Nearly normal with mean 0 and deviation 1: the sum of twelve uniform numbers.
    pub fn normal(&mut self) -> f64 {
        (0..12)
            .map(|_| (f64::from(self.next()) + 0.5) / 4_294_967_296.0)
            .sum::<f64>()
            - 6.0
    }
}

/// `a` at u = 0, `b` at u = 1.
pub fn mix(a: f64, b: f64, u: f64) -> f64 {
    a + (b - a) * u
}

/// A vector from its components.
pub const fn v3(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3 { x, y, z }
}
