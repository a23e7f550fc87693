//! Exponential and logarithm with one fixed rounding on every machine (see [`super::trig`] for the reason).

const LN2_HI: f64 = 6.931_471_803_691_238e-1; // leading bits of ln 2: products with |n| < 2¹¹ are exact
const LN2_LO: f64 = 1.908_214_929_270_587_7e-10; // rest

/// `eˣ`, relative error below 1e-15; the argument is clamped to ±700, so the result is finite and positive.
#[inline]
pub fn exp(x: f64) -> f64 {
    let x = x.clamp(-700.0, 700.0);
    let n = (x * std::f64::consts::LOG2_E).round_ties_even();
    let r = (x - n * LN2_HI) - n * LN2_LO; // |r| ≤ ½ ln 2
    // Taylor to degree 13: the next term is below 2⁻⁵⁸.
    let mut p = 1.0;
    for k in (1..=13).rev() {
        p = 1.0 + p * r * INVERSE[k];
    }
    p * f64::from_bits(((n as i64 + 1023) as u64) << 52)
}

/// Natural logarithm of a positive normal number, error below 1e-15 of the larger of 1 and the result; NaN for anything
/// else.
pub fn ln(x: f64) -> f64 {
    if !(x.is_normal() && x > 0.0) {
        return f64::NAN;
    }
    // x = 2ᵉ m with m between √½ and √2.
    const FRACTION: u64 = (1 << 52) - 1;
    const ONE: u64 = 1023 << 52;
    let mut e = (x.to_bits() >> 52) as i64 - 1023;
    let mut m = f64::from_bits((x.to_bits() & FRACTION) | ONE);
    if m > std::f64::consts::SQRT_2 {
        m *= 0.5;
        e += 1;
    }
    // ln m = 2 artanh s, |s| < 0.172: the first term left out is below 2⁻⁶⁰.
    let s = (m - 1.0) / (m + 1.0);
    let s2 = s * s;
    let mut p = 0.0;
    for k in (0..=11).rev() {
        p = p * s2 + 1.0 / (2 * k + 1) as f64;
    }
    let e = e as f64;
    e * LN2_HI + (2.0 * s * p + e * LN2_LO)
}

const INVERSE: [f64; 14] = {
    let mut out = [0.0; 14];
    let mut k = 1;
    while k < 14 {
        out[k] = 1.0 / k as f64;
        k += 1;
    }
    out
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exp_agrees_with_the_platform_to_rounding() {
        for i in -70_000..=70_000 {
            let x = f64::from(i) * 9.876_543e-3;
            let (a, b) = (exp(x), x.exp());
            assert!((a / b - 1.0).abs() < 1e-15, "{x}: {a} against {b}");
        }
        assert_eq!(exp(0.0), 1.0);
        assert!(exp(f64::INFINITY).is_finite() && exp(f64::NEG_INFINITY) > 0.0);
    }

    #[test]
    fn ln_agrees_with_the_platform_to_rounding() {
        for i in -70_000..=70_000 {
            let x = (f64::from(i) * 9.876_543e-3).exp();
            let (a, b) = (ln(x), x.ln());
            assert!(
                (a - b).abs() < 1e-15 * b.abs().max(1.0),
                "{x}: {a} against {b}"
            );
        }
        assert_eq!(ln(1.0), 0.0);
        assert!(ln(0.0).is_nan() && ln(-1.0).is_nan() && ln(f64::INFINITY).is_nan());
    }
}
