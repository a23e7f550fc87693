//! Random numbers that depend on their purpose, not on earlier draws: any thread may draw them.

use crate::math::exp::ln;
use crate::math::trig::sin_cos;

/// The numbers of one sample.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
    /// The second of a pair of normal numbers.
    spare: Option<f64>,
}

/// Odd, with bits like those of a random number: 2⁶⁴ over the golden ratio.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// David Stafford's thirteenth mix of 64 bits (`SplitMix64`).
fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Random {
    /// The random numbers for this key: seed, round, window and sample.
    pub fn of(what: [u64; 4]) -> Self {
        let state = what.into_iter().fold(0, |h: u64, w| {
            mixed(h.wrapping_add(STEP) ^ mixed(w.wrapping_add(STEP)))
        });
        Self { state, spare: None }
    }

    /// Evenly distributed from 0 to 1, without 1.
    pub fn unit(&mut self) -> f64 {
        self.state = self.state.wrapping_add(STEP);
        (mixed(self.state) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Normally distributed, of variance 1 (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        if let Some(x) = self.spare.take() {
            return x;
        }
        let radius = (-2.0 * ln(1.0 - self.unit())).sqrt();
        let (sin, cos) = sin_cos(std::f64::consts::TAU * self.unit() - std::f64::consts::PI);
        self.spare = Some(radius * sin);
        radius * cos
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_normal_and_belong_to_what_they_are_for() {
        let n = 20_000;
        let all: Vec<f64> = (0..n).map(|i| Random::of([1, 2, 3, i]).normal()).collect();
        let mean = all.iter().sum::<f64>() / n as f64;
        let variance = all.iter().map(|x| x * x).sum::<f64>() / n as f64 - mean * mean;
        let tails = all.iter().filter(|x| x.abs() > 1.96).count() as f64 / n as f64;
        // Three standard errors each.
        assert!(mean.abs() < 0.022, "{mean}");
        assert!((variance - 1.0).abs() < 0.03, "{variance}");
        assert!((tails - 0.05).abs() < 0.005, "{tails}");
        let first = |what| Random::of(what).unit();
        assert_eq!(first([1, 2, 3, 4]), first([1, 2, 3, 4]));
        assert_ne!(first([1, 2, 3, 4]), first([1, 2, 4, 3]));
    }

    #[test]
    fn units_fill_the_interval() {
        let mut r = Random::of([0; 4]);
        let all: Vec<f64> = (0..10_000).map(|_| r.unit()).collect();
        assert!(all.iter().all(|x| (0.0..1.0).contains(x)));
        let mean = all.iter().sum::<f64>() / 10_000.0;
        assert!((mean - 0.5).abs() < 0.01, "{mean}");
    }
}
