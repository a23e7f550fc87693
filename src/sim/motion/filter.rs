//! Zero-phase smoothing and resampling of recorded trajectories (offline).
//!
//! A second-order Butterworth low-pass runs forwards and backwards, so that nothing is delayed; the signal is extended
//! at both ends by its point reflection, and each pass starts in the steady state of its first sample. Amplitude at the
//! cut-off is 1/2 (twice −3 dB). Rotations are filtered as sign-aligned quaternions and normalised again.

use crate::math::banded::Pentadiagonal;
use crate::math::{Quat, Vec3};

/// Cut-offs above this fraction of the sample rate leave the signal alone: there is nothing to remove.
const TOP_FRACTION: f64 = 0.45;

/// A digital second-order low-pass, `y[n] = b·x − a·y`, with unit gain at rest.
#[derive(Clone, Copy, Debug)]
struct Biquad {
    b: [f64; 3],
    a: [f64; 2],
}

impl Biquad {
    /// Butterworth by the bilinear transform with pre-warping.
    fn butterworth(cutoff_hz: f64, rate_hz: f64) -> Self {
        let k = (std::f64::consts::PI * cutoff_hz / rate_hz).tan();
        let norm = 1.0 / (1.0 + std::f64::consts::SQRT_2 * k + k * k);
        let b0 = k * k * norm;
        Self {
            b: [b0, 2.0 * b0, b0],
            a: [
                2.0 * (k * k - 1.0) * norm,
                (1.0 - std::f64::consts::SQRT_2 * k + k * k) * norm,
            ],
        }
    }

    /// Filters in place, starting as if the first sample had lasted for ever (transposed direct form II).
    fn run<'a>(&self, signal: impl Iterator<Item = &'a mut f64>) {
        let mut state: Option<(f64, f64)> = None;
        for x in signal {
            let (s1, s2) = state.unwrap_or_else(|| {
                let s2 = (self.b[2] - self.a[1]) * *x;
                ((self.b[1] - self.a[0]) * *x + s2, s2)
            });
            let y = self.b[0] * *x + s1;
            state = Some((
                self.b[1] * *x - self.a[0] * y + s2,
                self.b[2] * *x - self.a[1] * y,
            ));
            *x = y;
        }
    }
}

/// Smooths one channel in place without delay.
///
/// * `cutoff_hz`, `rate_hz`: Hz. Above 0.45 of the rate, or with fewer than three samples, the signal is left alone.
///
/// O(n); allocates the extension (at most 3/`cutoff_hz` seconds at each end).
pub fn low_pass(signal: &mut [f64], cutoff_hz: f64, rate_hz: f64) {
    let n = signal.len();
    if n < 3 || !(cutoff_hz > 0.0 && cutoff_hz < TOP_FRACTION * rate_hz) {
        return;
    }
    // The transient of the filter lasts about one period of the cut-off; three are plenty.
    let pad = ((3.0 * rate_hz / cutoff_hz) as usize).clamp(1, n - 1);
    let (first, last) = (signal[0], signal[n - 1]);
    let mut wide = Vec::with_capacity(n + 2 * pad);
    wide.extend((1..=pad).rev().map(|k| 2.0 * first - signal[k]));
    wide.extend_from_slice(signal);
    wide.extend((1..=pad).map(|k| 2.0 * last - signal[n - 1 - k]));
    let f = Biquad::butterworth(cutoff_hz, rate_hz);
    f.run(wide.iter_mut());
    f.run(wide.iter_mut().rev());
    signal.copy_from_slice(&wide[pad..pad + n]);
}

/// Smooths points in place without delay; see [`low_pass`].
pub fn low_pass_points(points: &mut [Vec3], cutoff_hz: f64, rate_hz: f64) {
    let mut channel = Vec::with_capacity(points.len());
    for axis in 0..3 {
        channel.clear();
        channel.extend(points.iter().map(|p| p.to_array()[axis]));
        low_pass(&mut channel, cutoff_hz, rate_hz);
        for (p, c) in points.iter_mut().zip(&channel) {
            match axis {
                0 => p.x = *c,
                1 => p.y = *c,
                _ => p.z = *c,
            }
        }
    }
}

/// Flips signs so that neighbouring quaternions lie in the same half of the sphere.
pub fn align_signs(rotations: &mut [Quat]) {
    for i in 1..rotations.len() {
        let (p, q) = (rotations[i - 1].to_xyzw(), rotations[i].to_xyzw());
        if p.iter().zip(q).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
            rotations[i] = Quat::from_xyzw(q.map(|c| -c));
        }
    }
}

/// Unit quaternion, or the identity if `q` has nearly no length (opposite rotations averaged out).
pub fn renormalised(q: Quat) -> Quat {
    let n = q.to_xyzw().iter().map(|c| c * c).sum::<f64>();
    if n > 1e-12 {
        q.normalized()
    } else {
        Quat::identity()
    }
}

/// Smooths rotations in place without delay; see [`low_pass`].
pub fn low_pass_rotations(rotations: &mut [Quat], cutoff_hz: f64, rate_hz: f64) {
    align_signs(rotations);
    let mut channels: [Vec<f64>; 4] =
        std::array::from_fn(|k| rotations.iter().map(|q| q.to_xyzw()[k]).collect());
    for c in &mut channels {
        low_pass(c, cutoff_hz, rate_hz);
    }
    for (i, q) in rotations.iter_mut().enumerate() {
        *q = renormalised(Quat::from_xyzw(std::array::from_fn(|k| channels[k][i])));
    }
}

/// A natural cubic spline through equally spaced samples, evaluated at another rate.
///
/// * `signal`: samples at `rate_hz`; the result has `count` samples at `to_hz`, starting at the same instant; instants
///   past the end give the last sample.
///
/// O(n + count).
pub fn resample(signal: &[f64], rate_hz: f64, to_hz: f64, count: usize) -> Vec<f64> {
    let n = signal.len();
    if n < 3 {
        return (0..count)
            .map(|i| {
                let t = i as f64 * rate_hz / to_hz;
                match signal {
                    [] => 0.0,
                    [only] => *only,
                    [a, b, ..] => a + (b - a) * t.min(1.0),
                }
            })
            .collect();
    }
    // Second derivatives (per sample²): m[i−1] + 4 m[i] + m[i+1] = 6 (second difference), zero at both ends.
    let bands = Pentadiagonal::tridiagonal(vec![4.0; n - 2], 1.0);
    let mut m = vec![[0.0]; n];
    for i in 1..n - 1 {
        m[i] = [6.0 * (signal[i + 1] - 2.0 * signal[i] + signal[i - 1])];
    }
    bands.factor().solve(&mut m[1..n - 1]);
    (0..count)
        .map(|i| {
            let t = (i as f64 * rate_hz / to_hz).min((n - 1) as f64);
            let k = (t as usize).min(n - 2);
            let (u, v) = (t - k as f64, 1.0 - (t - k as f64));
            signal[k] * v
                + signal[k + 1] * u
                + ((v * v * v - v) * m[k][0] + (u * u * u - u) * m[k + 1][0]) / 6.0
        })
        .collect()
}

/// [`resample`] for points.
pub fn resample_points(points: &[Vec3], rate_hz: f64, to_hz: f64, count: usize) -> Vec<Vec3> {
    let channel = |axis: usize| {
        let s: Vec<f64> = points.iter().map(|p| p.to_array()[axis]).collect();
        resample(&s, rate_hz, to_hz, count)
    };
    let (x, y, z) = (channel(0), channel(1), channel(2));
    (0..count)
        .map(|i| Vec3::from_array([x[i], y[i], z[i]]))
        .collect()
}

/// [`resample`] for rotations.
pub fn resample_rotations(rotations: &[Quat], rate_hz: f64, to_hz: f64, count: usize) -> Vec<Quat> {
    let mut aligned = rotations.to_vec();
    align_signs(&mut aligned);
    let channels: [Vec<f64>; 4] = std::array::from_fn(|k| {
        let s: Vec<f64> = aligned.iter().map(|q| q.to_xyzw()[k]).collect();
        resample(&s, rate_hz, to_hz, count)
    });
    (0..count)
        .map(|i| renormalised(Quat::from_xyzw(std::array::from_fn(|k| channels[k][i]))))
        .collect()
}

/// Central differences per second; one-sided at the ends.
pub fn speeds(points: &[Vec3], rate_hz: f64) -> Vec<f64> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(n - 1));
            if a == b {
                0.0
            } else {
                (points[b] - points[a]).norm() * rate_hz / (b - a) as f64
            }
        })
        .collect()
}

/// Smallest value within `half` samples either side, then a moving average of the same width: a smooth curve that never
/// exceeds the signal.
pub fn smooth_minimum(signal: &[f64], half: usize) -> Vec<f64> {
    let n = signal.len();
    let window = |i: usize| i.saturating_sub(half)..(i + half + 1).min(n);
    let least: Vec<f64> = (0..n)
        .map(|i| {
            signal[window(i)]
                .iter()
                .copied()
                .fold(f64::INFINITY, f64::min)
        })
        .collect();
    // Two averages of half the width each give a curve with continuous slope; both stay within the window of the
    // minimum.
    let quarter = half / 2;
    let average = |s: &[f64]| -> Vec<f64> {
        (0..n)
            .map(|i| {
                let w = i.saturating_sub(quarter)..(i + quarter + 1).min(n);
                let len = w.len() as f64;
                s[w].iter().sum::<f64>() / len
            })
            .collect()
    };
    average(&average(&least))
}

/// The value below which the fraction `p` of the samples lies (0 for no samples).
pub fn percentile(values: &[f64], p: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let mut v = values.to_vec();
    v.sort_by(f64::total_cmp);
    v[((v.len() - 1) as f64 * p.clamp(0.0, 1.0)).round() as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn low_pass_keeps_slow_removes_fast_and_delays_nothing() {
        let rate = 120.0;
        let n = 600;
        let wave = |f: f64| -> Vec<f64> {
            (0..n)
                .map(|i| (std::f64::consts::TAU * f * f64::from(i) / rate).sin())
                .collect()
        };
        for (f, gain) in [(0.5, 1.0), (6.0, 0.5), (30.0, 0.0)] {
            let mut s = wave(f);
            low_pass(&mut s, 6.0, rate);
            let w = wave(f);
            let mid = 120..480;
            let dot: f64 = mid.clone().map(|i| s[i] * w[i]).sum();
            let own: f64 = mid.clone().map(|i| w[i] * w[i]).sum();
            assert!(
                (dot / own - gain).abs() < 0.01,
                "{f} Hz: gain {}",
                dot / own
            );
        }
        let mut line: Vec<f64> = (0..50).map(f64::from).collect();
        low_pass(&mut line, 6.0, rate);
        assert!(
            line.iter()
                .enumerate()
                .all(|(i, x)| (x - i as f64).abs() < 0.05),
            "edges hold a ramp: {line:?}"
        );
    }

    #[test]
    fn spline_reproduces_samples_and_smooth_curves() {
        let f = |t: f64| (2.0 * t).sin();
        let s: Vec<f64> = (0..48).map(|i| f(f64::from(i) / 24.0)).collect();
        let r = resample(&s, 24.0, 120.0, 236);
        for (i, x) in r.iter().enumerate() {
            // A natural spline has no curvature at its ends, whatever that of the curve.
            let bound = if i < 200 { 2e-4 } else { 2e-3 };
            assert!((x - f(i as f64 / 120.0)).abs() < bound, "sample {i}");
        }
    }

    #[test]
    fn smooth_minimum_never_exceeds_the_signal() {
        let s: Vec<f64> = (0..200).map(|i| ((i * 37) % 101) as f64).collect();
        let m = smooth_minimum(&s, 9);
        assert!(m.iter().zip(&s).all(|(a, b)| a <= b));
    }
}
