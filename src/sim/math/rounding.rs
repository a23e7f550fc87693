//! Numbers short enough to survive being written as text.

/// Smaller numbers are rounding errors.
const NOTHING: f64 = 1e-12;

/// `x` to seven significant digits, so that writing it as text and reading it again gives the same bits; 0 if it is
/// not finite or below 1e-12.
pub fn short(x: f64) -> f64 {
    if !x.is_finite() || x.abs() < NOTHING {
        return 0.0;
    }
    format!("{x:.6e}").parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_numbers_are_read_as_they_were_written() {
        for x in [1.0 / 3.0, 1e-9 / 7.0, 123_456.789_012, -0.1, 0.0] {
            let s = short(x);
            assert!((s - x).abs() <= 1e-6 * x.abs());
            assert_eq!(short(s), s);
            assert_eq!(format!("{s}").parse::<f64>().expect("a number"), s);
        }
        assert_eq!(short(f64::NAN), 0.0);
    }
}
