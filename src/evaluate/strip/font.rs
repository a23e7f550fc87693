//! A small stroke font for labels in pixel pictures: lower-case letters, digits and punctuation on a 4 × 8 grid.
//!
//! A glyph is a list of strokes; a stroke is a list of points `xy` with x in 0…4 and y in 0…8: 0 is the descender, 2
//! the base line, 6 the height of an `x`, 8 the height of an `l`.

/// Units of advance beyond a glyph's width.
const SPACING: f64 = 1.6;
/// Grid units in one line height.
const UNITS: f64 = 11.0;

#[rustfmt::skip]
const GLYPHS: [(char, &str); 47] = [
    ('a', "46 42 33 22 12 03 05 16 26 35 42"), ('b', "08 02 12 32 43 45 36 16 05"), ('c', "45 36 16 05 03 12 32 43"),
    ('d', "48 42 32 12 03 05 16 36 45"), ('e', "04 44 45 36 16 05 03 12 32 43"), ('f', "38 28 17 12|06 26"),
    ('g', "46 41 30 10 01|42 32 12 03 05 16 36 45"), ('h', "08 02|05 16 36 45 42"), ('i', "16 12|18 18"), ('j', "26 21 10 00|28 28"),
    ('k', "08 02|04 36|14 32"), ('l', "18 13 22"), ('m', "02 06|05 16 25 22|25 36 45 42"), ('n', "02 06|05 16 36 45 42"),
    ('o', "16 36 45 43 32 12 03 05 16"), ('p', "00 06 16 36 45 43 32 12 03"), ('q', "40 46 36 16 05 03 12 32 43"), ('r', "02 06|05 16 26"),
    ('s', "45 36 16 05 14 34 43 32 12 03"), ('t', "18 13 22 32|06 26"), ('u', "06 03 12 32 43 46|43 42"), ('v', "06 22 46"),
    ('w', "06 12 25 32 46"), ('x', "06 42|46 02"), ('y', "06 22|46 10 00"), ('z', "06 46 02 42"),
    ('0', "17 18 38 47 43 32 12 03 07 18"), ('1', "06 28 22"), ('2', "07 18 38 47 45 02 42"), ('3', "07 18 38 47 46 35 15|35 44 43 32 12 03"),
    ('4', "32 38 03 43"), ('5', "48 08 05 15 35 44 43 32 12 03"), ('6', "38 18 07 03 12 32 43 44 35 15 04"), ('7', "08 48 12"),
    ('8', "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35"), ('9', "03 12 32 43 47 38 18 07 06 15 35 46"), ('.', "12 12"), (',', "12 01"),
    (':', "12 12|16 16"), ('-', "04 44"), ('+', "04 44|26 22"), ('/', "01 48"), ('(', "28 16 13 21"), (')', "08 16 13 01"), ('%', "02 48|08 08|42 42"),
    ('=', "03 43|05 45"), ('_', "02 42"),
];

/// Strokes of one character; capitals are shown as small letters, unknown characters as a space.
fn glyph(c: char) -> &'static str {
    let c = c.to_ascii_lowercase();
    let c = if c == '·' { '.' } else { c };
    GLYPHS.iter().find(|(g, _)| *g == c).map_or("", |(_, s)| s)
}

fn points(stroke: &str) -> impl Iterator<Item = [f64; 2]> + '_ {
    stroke.split(' ').filter_map(|p| {
        let mut digits = p.chars().filter_map(|d| d.to_digit(10)).map(f64::from);
        Some([digits.next()?, digits.next()?])
    })
}

/// Width of a character with the space after it, grid units.
fn advance(c: char) -> f64 {
    let widest = glyph(c)
        .split('|')
        .flat_map(points)
        .map(|p| p[0])
        .fold(f64::NEG_INFINITY, f64::max);
    if widest.is_finite() {
        widest.max(1.0) + SPACING
    } else {
        2.6
    }
}

/// Width of `text` in pixels at line height `size`.
pub fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size / UNITS
}

/// Line segments of `text` starting at `at` (pixels, y downwards, on the base line) at line height `size`.
pub fn strokes(text: &str, at: [f64; 2], size: f64) -> Vec<[[f64; 2]; 2]> {
    let unit = size / UNITS;
    let mut out = Vec::new();
    let mut x = 0.0;
    for c in text.chars() {
        for stroke in glyph(c).split('|') {
            let place = |p: [f64; 2]| [at[0] + (x + p[0]) * unit, at[1] - (p[1] - 2.0) * unit];
            let line: Vec<[f64; 2]> = points(stroke).map(place).collect();
            out.extend(line.windows(2).map(|w| [w[0], w[1]]));
        }
        x += advance(c);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_has_strokes_inside_its_grid() {
        for (c, _) in GLYPHS {
            let lines = strokes(&c.to_string(), [0.0, 0.0], UNITS);
            assert!(!lines.is_empty(), "{c} is empty");
            for p in lines.iter().flatten() {
                assert!(
                    (0.0..=4.0).contains(&p[0]) && (-6.0..=2.0).contains(&p[1]),
                    "{c}: {p:?}"
                );
            }
        }
    }
}
