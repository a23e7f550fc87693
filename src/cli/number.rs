//! Numbers rounded for people: `120 Hz`, not `119.99999 Hz`; `0.0564 m`, not `0.056444444 m`. JSON and CSV keep every
//! digit.

use std::fmt::Display;

/// Significant digits of measured quantities: lengths, times, masses.
const MEASURED: usize = 3;
/// Significant digits of rates: 59.94 and 29.97 Hz differ from 60 and 30 Hz.
const RATE: usize = 4;

/// Largest number of decimals of a rounded number: anything smaller counts as 0.
const MOST_DECIMALS: i32 = 9;

/// A number with this many decimals, or a dash.
pub fn or_dash(v: Option<f64>, digits: usize) -> String {
    v.map_or_else(|| "–".into(), |v| format!("{v:.digits$}"))
}

/// `value` with `digits` significant digits and at most nine decimals, without zeros at the end of a fraction, and
/// never rounded before the decimal point.
pub fn rounded(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let before = value.abs().max(1e-12).log10().floor() as i32 + 1;
    let decimals = (digits as i32 - before).clamp(0, MOST_DECIMALS) as usize;
    let text = fixed(value, decimals);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// `value` with this many decimals; 0 has no sign.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| matches!(b, b'0' | b'.')) => rest.to_owned(),
        _ => text,
    }
}

/// A number of things: `1 frame`, `2 frames`.
pub fn counted<N: Display + PartialEq + From<u8>>(n: N, thing: &str) -> String {
    let plural = if n == N::from(1) { "" } else { "s" };
    format!("{n} {thing}{plural}")
}

/// A rate with its unit.
pub fn hertz(value: f64) -> String {
    format!("{} Hz", rounded(value, RATE))
}

/// A length with its unit.
pub fn metres(value: f64) -> String {
    format!("{} m", rounded(value, MEASURED))
}

/// A mass with its unit.
pub fn kilograms(value: f64) -> String {
    format!("{} kg", rounded(value, MEASURED))
}

/// A time with its unit, in hundredths of a second.
pub fn seconds(value: f64) -> String {
    format!("{value:.2} s")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_near() {
        for (value, digits, text) in [
            (119.99999, 4, "120"),
            (59.94, 4, "59.94"),
            (29.970_03, 4, "29.97"),
            (0.056_444_444, 3, "0.0564"),
            (9.9996, 3, "10"),
            (-0.25, 3, "-0.25"),
            (12_345.6, 3, "12346"),
            (1e-9, 3, "0.000000001"),
            (-4.5e-17, 2, "0"),
            (0.0, 3, "0"),
        ] {
            assert_eq!(rounded(value, digits), text);
        }
        assert_eq!(fixed(-0.04, 1), "0.0");
        assert_eq!(fixed(-0.06, 1), "-0.1");
        assert_eq!(rounded(f64::NAN, 3), "NaN");
        assert_eq!(hertz(119.999_99), "120 Hz");
        assert_eq!(metres(0.056_444_444), "0.0564 m");
        assert_eq!(kilograms(75.0), "75 kg");
        assert_eq!(seconds(2.349_9), "2.35 s");
        let frames = [0, 1, 2].map(|n| counted(n, "frame"));
        assert_eq!(frames, ["0 frames", "1 frame", "2 frames"]);
    }
}
