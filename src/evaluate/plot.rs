//! Line plots as SVG: curves and bands over one axis each way, with a legend. No styling to choose; colours differ for
//! colour-blind eyes.

use super::strip::Rgba;
use std::fmt::Write;

/// Blue, vermilion, green, purple, sky, ink: told apart with any colour vision.
pub const COLOURS: [Rgba; 6] = [
    Rgba::hex(0x00_72b2),
    Rgba::hex(0xd5_5e00),
    Rgba::hex(0x00_9e73),
    Rgba::hex(0xcc_79a7),
    Rgba::hex(0x56_b4e9),
    Rgba::hex(0x33_373d),
];
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 44.0;
const LEGEND_LINE: f64 = 15.0;
const BOTTOM: f64 = 34.0;
/// More points than this say nothing more at this size.
const MOST_POINTS: usize = 400;

/// A line through points; a point that is not finite leaves a gap.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Text of the legend.
    pub label: String,
    /// Colour.
    pub colour: Rgba,
    /// Dashed instead of solid.
    pub dashed: bool,
    /// x, y.
    pub points: Vec<[f64; 2]>,
}

/// The area between two curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Text of the legend.
    pub label: String,
    /// x, lower y, upper y.
    pub points: Vec<[f64; 3]>,
}

/// A plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// Heading.
    pub title: String,
    /// Quantity and unit along x.
    pub x: String,
    /// Quantity and unit along y.
    pub y: String,
    /// Least and largest y; from the data if absent.
    pub range: Option<[f64; 2]>,
    /// Areas behind the curves.
    pub bands: Vec<Band>,
    /// Curves.
    pub curves: Vec<Curve>,
}

impl Plot {
    /// Adds a solid curve in the next colour.
    #[must_use]
    pub fn curve(self, label: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.add(label, false, points)
    }

    /// Adds a dashed curve in the next colour.
    #[must_use]
    pub fn dashed(self, label: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.add(label, true, points)
    }

    fn add(
        mut self,
        label: &str,
        dashed: bool,
        points: impl IntoIterator<Item = [f64; 2]>,
    ) -> Self {
        let colour = COLOURS[self.curves.len() % COLOURS.len()];
        self.curves.push(Curve {
            label: label.to_owned(),
            colour,
            dashed,
            points: points.into_iter().collect(),
        });
        self
    }

    /// Adds an area.
    #[must_use]
    pub fn band(mut self, label: &str, points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        self.bands.push(Band {
            label: label.to_owned(),
            points: points.into_iter().collect(),
        });
        self
    }

    /// The plot as a self-contained SVG document. Without a finite point the axes run from 0 to 1.
    pub fn svg(&self) -> String {
        let xs = self
            .curves
            .iter()
            .flat_map(|c| c.points.iter().map(|p| p[0]));
        let xs = xs.chain(
            self.bands
                .iter()
                .flat_map(|b| b.points.iter().map(|p| p[0])),
        );
        let ys = self
            .curves
            .iter()
            .flat_map(|c| c.points.iter().map(|p| p[1]));
        let ys = ys.chain(
            self.bands
                .iter()
                .flat_map(|b| b.points.iter().flat_map(|p| [p[1], p[2]])),
        );
        let x = Axis::new(extent(xs), 0.0, LEFT, WIDTH - RIGHT);
        let y = match self.range {
            Some(r) => Axis::new(r, 0.0, HEIGHT - BOTTOM, self.top()),
            None => Axis::new(extent(ys), 0.05, HEIGHT - BOTTOM, self.top()),
        };
        let mut out = String::new();
        self.write(&mut out, &x, &y)
            .expect("a string takes any text");
        out
    }

    /// Upper end of the axes: below the lines of the legend.
    fn top(&self) -> f64 {
        let labels = self.bands.iter().map(|b| &b.label);
        let labels = labels.chain(self.curves.iter().map(|c| &c.label));
        let (mut at, mut top) = (LEFT, TOP);
        for long in labels.filter(|l| !l.is_empty()).map(|l| room(l)) {
            if at > LEFT && at + long > WIDTH {
                (at, top) = (LEFT, top + LEGEND_LINE);
            }
            at += long;
        }
        top
    }

    fn write(&self, out: &mut String, x: &Axis, y: &Axis) -> std::fmt::Result {
        writeln!(
            out,
            r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" font-family="system-ui, sans-serif" font-size="11" fill="#33373d"><rect width="100%" height="100%" fill="#fbfbf9"/><clipPath id="c"><rect x="{LEFT}" y="{}" width="{}" height="{}"/></clipPath>"##,
            self.top(),
            WIDTH - LEFT - RIGHT,
            HEIGHT - self.top() - BOTTOM
        )?;
        let (top, bottom) = (self.top(), HEIGHT - BOTTOM);
        for v in x.ticks(8) {
            let at = x.at(v);
            writeln!(
                out,
                r##"<path d="M{at:.1} {top}V{bottom}" stroke="#e6e4de"/><text x="{at:.1}" y="{}" text-anchor="middle">{}</text>"##,
                bottom + 14.0,
                number(v)
            )?;
        }
        for v in y.ticks(5) {
            let at = y.at(v);
            writeln!(
                out,
                r##"<path d="M{LEFT} {at:.1}H{}" stroke="#e6e4de"/><text x="{}" y="{:.1}" text-anchor="end">{}</text>"##,
                WIDTH - RIGHT,
                LEFT - 6.0,
                at + 4.0,
                number(v)
            )?;
        }
        writeln!(
            out,
            r##"<text x="{LEFT}" y="15" font-size="13" font-weight="600">{}</text><text x="{}" y="{}" text-anchor="end">{}</text><text transform="translate(13 {}) rotate(-90)" text-anchor="middle">{}</text><g clip-path="url(#c)" fill="none" stroke-width="1.6" stroke-linejoin="round">"##,
            escaped(&self.title),
            WIDTH - RIGHT,
            HEIGHT - 5.0,
            escaped(&self.x),
            0.5 * (top + bottom),
            escaped(&self.y)
        )?;
        for b in &self.bands {
            let p = thinned(&b.points);
            let mut d = String::new();
            for (i, q) in p.iter().enumerate() {
                let c = if i == 0 { 'M' } else { 'L' };
                write!(d, "{c}{:.1} {:.1}", x.at(q[0]), y.near(q[1]))?;
            }
            for q in p.iter().rev() {
                write!(d, "L{:.1} {:.1}", x.at(q[0]), y.near(q[2]))?;
            }
            writeln!(out, r##"<path d="{d}Z" fill="#d9e2ec"/>"##)?;
        }
        for c in &self.curves {
            let mut d = String::new();
            let mut pen = 'M';
            for q in thinned(&c.points) {
                if q[1].is_finite() {
                    write!(d, "{pen}{:.1} {:.1}", x.at(q[0]), y.near(q[1]))?;
                    pen = 'L';
                } else {
                    pen = 'M';
                }
            }
            let dash = if c.dashed {
                r#" stroke-dasharray="5 4""#
            } else {
                ""
            };
            writeln!(out, r#"<path d="{d}" stroke="{}"{dash}/>"#, css(c.colour))?;
        }
        out.push_str("</g>\n");
        self.write_legend(out)?;
        out.push_str("</svg>\n");
        Ok(())
    }

    fn write_legend(&self, out: &mut String) -> std::fmt::Result {
        let (mut at, mut line) = (LEFT, 30.0);
        let bands = self
            .bands
            .iter()
            .map(|b| (&b.label, "#d9e2ec".to_owned(), 8.0, ""));
        let curves = self.curves.iter().map(|c| {
            let dash = if c.dashed {
                r#" stroke-dasharray="5 4""#
            } else {
                ""
            };
            (&c.label, css(c.colour), 2.0, dash)
        });
        for (label, colour, width, dash) in bands.chain(curves).filter(|(l, ..)| !l.is_empty()) {
            let long = room(label);
            if at > LEFT && at + long > WIDTH {
                (at, line) = (LEFT, line + LEGEND_LINE);
            }
            writeln!(
                out,
                r#"<path d="M{at:.0} {line}h18" stroke="{colour}" stroke-width="{width}"{dash}/><text x="{:.0}" y="{}">{}</text>"#,
                at + 23.0,
                line + 4.0,
                escaped(label)
            )?;
            at += long;
        }
        Ok(())
    }
}

/// Pixels that a label takes in the legend, at most.
fn room(label: &str) -> f64 {
    35.0 + 6.0 * label.chars().count() as f64
}

/// A scale from values to pixels.
struct Axis {
    range: [f64; 2],
    pixels: [f64; 2],
}

impl Axis {
    fn new([a, b]: [f64; 2], margin: f64, from: f64, to: f64) -> Self {
        let spread = if b > a { b - a } else { a.abs().max(1.0) };
        let (a, b) = if b > a { (a, b) } else { (a, a + spread) };
        Self {
            range: [a - margin * spread, b + margin * spread],
            pixels: [from, to],
        }
    }
    fn at(&self, v: f64) -> f64 {
        let share = (v - self.range[0]) / (self.range[1] - self.range[0]);
        self.pixels[0] + share * (self.pixels[1] - self.pixels[0])
    }
    /// The same, but not farther outside than the plot is high: files stay readable when data run away.
    fn near(&self, v: f64) -> f64 {
        self.at(v).clamp(-HEIGHT, 2.0 * HEIGHT)
    }
    /// Round values inside the range, about `count` of them.
    fn ticks(&self, count: usize) -> Vec<f64> {
        let raw = (self.range[1] - self.range[0]) / count as f64;
        let power = 10f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .iter()
            .map(|k| k * power)
            .find(|s| *s >= raw)
            .unwrap_or(10.0 * power);
        let first = (self.range[0] / step).ceil() as i64;
        let last = (self.range[1] / step).floor() as i64;
        (first..=last).map(|i| i as f64 * step).collect()
    }
}

/// Least and largest finite value.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [a, b] = values
        .filter(|v| v.is_finite())
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
            [a.min(v), b.max(v)]
        });
    if a <= b { [a, b] } else { [0.0, 1.0] }
}

/// At most [`MOST_POINTS`] of them, evenly.
fn thinned<T: Copy>(points: &[T]) -> Vec<T> {
    let step = points.len().div_ceil(MOST_POINTS).max(1);
    points.iter().step_by(step).copied().collect()
}

pub(super) fn number(v: f64) -> String {
    let text = format!("{v:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

fn css(c: Rgba) -> String {
    format!("#{:02x}{:02x}{:02x}", c.0[0], c.0[1], c.0[2])
}

pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_shows_its_data_within_its_axes_and_gaps_where_there_are_none() {
        let svg = Plot {
            title: "a < b".into(),
            ..Plot::default()
        }
        .band("limits", [[0.0, -1.0, 1.0], [2.0, -1.0, 1.0]])
        .curve("torque", [[0.0, 0.0], [1.0, f64::NAN], [2.0, 1.0]])
        .svg();
        assert!(svg.contains("a &lt; b") && svg.contains("limits") && svg.contains("torque"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        // The curve is broken in two.
        let curve = svg.lines().find(|l| l.contains("#0072b2")).unwrap();
        assert_eq!(curve.matches('M').count(), 2);
    }

    #[test]
    fn empty_and_constant_data_still_have_axes() {
        for plot in [
            Plot::default(),
            Plot::default().curve("c", [[1.0, 5.0], [2.0, 5.0]]),
        ] {
            let svg = plot.svg();
            assert!(svg.contains("<text") && !svg.contains("NaN"));
        }
    }

    #[test]
    fn ticks_are_round_numbers_inside_the_range() {
        let axis = Axis::new([-0.3, 1.1], 0.0, 0.0, 100.0);
        assert_eq!(axis.ticks(5), [0.0, 0.5, 1.0]);
    }
}
