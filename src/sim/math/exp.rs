//! Exponential with one fixed rounding on every machine (see [`super::trig`] for the reason).

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
}
