//! Sine, cosine and arc tangent with one fixed rounding on every machine and in every lane.
//!
//! Argument reduction by π/2 in three parts (Cody & Waite) and the minimax polynomials of fdlibm; absolute error below
//! 3e-16 for |x| < 1e5. The platform's libm is never used in the core: it differs between systems.

use super::Lane;

const PIO2_1: f64 = 1.570_796_326_734_125_6; // first 33 bits of π/2
const PIO2_2: f64 = 6.077_100_506_303_966e-11; // next 33 bits
const PIO2_3: f64 = 2.022_266_248_795_950_6e-21; // rest

/// fdlibm's odd polynomial of the sine for |x| < π/4, after x.
const SIN: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
/// Its even polynomial of the cosine, after 1 − x²/2.
const COS: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];
/// Its odd polynomial of the arc tangent for |u| < 7/16, after u, with the sign turned.
const ATAN: [f64; 11] = [
    3.333_333_333_333_293e-1,
    -1.999_999_999_987_648_3e-1,
    1.428_571_427_250_346_6e-1,
    -1.111_111_040_546_235_6e-1,
    9.090_887_133_436_507e-2,
    -7.691_876_205_044_83e-2,
    6.661_073_137_387_531e-2,
    -5.833_570_133_790_573_5e-2,
    4.976_877_994_615_932_4e-2,
    -3.653_157_274_421_691_6e-2,
    1.628_582_011_536_578_2e-2,
];

/// c₀ + z (c₁ + z (c₂ + …)), from the inside out.
#[inline(always)]
fn horner<L: Lane, const N: usize>(z: L, c: [f64; N]) -> L {
    let mut sum = L::splat(c[N - 1]);
    for i in (0..N - 1).rev() {
        sum = L::splat(c[i]) + z * sum;
    }
    sum
}

/// Sine and cosine of an angle (rad), |x| < 1e5.
#[inline(always)]
pub fn sin_cos<L: Lane>(x: L) -> (L, L) {
    let n = (x * L::splat(std::f64::consts::FRAC_2_PI)).round_even();
    let r = ((x - n * L::splat(PIO2_1)) - n * L::splat(PIO2_2)) - n * L::splat(PIO2_3);
    let z = r * r;
    let k = L::splat;
    let s = r + r * z * horner(z, SIN);
    let c = L::one() - k(0.5) * z + z * z * horner(z, COS);
    // Quadrant n mod 4, computed in floating point so that it is lane-wise: q ∈ {−2, −1, 0, 1, 2}.
    let q = n - (n * k(0.25)).round_even() * k(4.0);
    let odd = (q.abs() - k(1.0))
        .abs()
        .select_lt(k(0.5), L::one(), L::zero());
    let swap = |a: L, b: L| k(0.5).select_lt(odd, b, a);
    let (s0, c0) = (swap(s, c), swap(c, s));
    // sin: + + − − for q = 0, 1, ±2, −1;  cos: + − − + for q = 0, 1, ±2, −1.
    let neg_s = q
        .abs()
        .select_lt(k(1.5), q.select_lt(k(-0.5), L::one(), L::zero()), L::one());
    let neg_c = q
        .abs()
        .select_lt(k(1.5), k(0.5).select_lt(q, L::one(), L::zero()), L::one());
    (
        k(0.5).select_lt(neg_s, -s0, s0),
        k(0.5).select_lt(neg_c, -c0, c0),
    )
}

/// Arc tangent of y/x in the right quadrant (rad), −π…π; error below 4e-16 relative to π.
#[inline(always)]
pub fn atan2<L: Lane>(y: L, x: L) -> L {
    let k = L::splat;
    let (ax, ay) = (x.abs(), y.abs());
    let hi = ax.max(ay).max(k(f64::MIN_POSITIVE));
    let lo = ax.min(ay);
    let t = lo / hi; // 0…1
    // atan(t) = π/4 + atan((t−1)/(t+1)) above tan(π/8), so the polynomial sees |u| ≤ 0.4143.
    let big = k(0.414_213_562_373_095_03);
    let u = big.select_lt(t, (t - L::one()) / (t + L::one()), t);
    let z = u * u;
    let p = horner(z, ATAN);
    let a = u - u * z * p;
    let a = big.select_lt(t, k(std::f64::consts::FRAC_PI_4) + a, a);
    let a = ax.select_lt(ay, k(std::f64::consts::FRAC_PI_2) - a, a);
    let a = x.select_lt(L::zero(), k(std::f64::consts::PI) - a, a);
    y.select_lt(L::zero(), -a, a)
}

/// The angle within ±π/2 whose sine this is, rad; numbers beyond ±1 count as ±1.
#[inline]
pub fn asin(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    atan2(x, ((1.0 - x) * (1.0 + x)).sqrt())
}

/// The same angle, wrapped into −π…π, rad.
#[inline]
pub fn wrapped(angle: f64) -> f64 {
    let (s, c) = sin_cos(angle);
    atan2(s, c)
}

#[cfg(test)]
mod tests {
    use super::super::F64x8;
    use super::*;

    #[test]
    fn sin_cos_and_atan2_agree_with_the_platform_to_rounding() {
        let mut worst = (0.0f64, 0.0f64);
        for i in -40_000..=40_000 {
            let x = f64::from(i) * 1.234_567e-3;
            let (s, c) = sin_cos(x);
            worst.0 = worst.0.max((s - x.sin()).abs()).max((c - x.cos()).abs());
            let (a, b) = (x.sin() * 3.0, (x * 1.7).cos());
            worst.1 = worst.1.max((atan2(a, b) - a.atan2(b)).abs());
        }
        assert!(worst.0 < 3e-16, "sin/cos error {:e}", worst.0);
        assert!(worst.1 < 9e-16, "atan2 error {:e}", worst.1);
    }

    #[test]
    fn lanes_carry_the_scalar_bits() {
        let xs = [0.1, -3.3, 7.7, 100.0, -0.0, 1e-9, 2.5, -1.57];
        let (s, c) = sin_cos(F64x8(xs));
        let a = atan2(F64x8(xs), c);
        for k in 0..8 {
            let (sk, ck) = sin_cos(xs[k]);
            assert_eq!(s.0[k].to_bits(), sk.to_bits());
            assert_eq!(c.0[k].to_bits(), ck.to_bits());
            assert_eq!(a.0[k].to_bits(), atan2(xs[k], ck).to_bits());
        }
    }
}
