//! Line plots as SVG: curves and bands over an x and a y axis, with a legend. No styling to choose; colours differ for
//! colour-blind eyes.

use super::strip::Rgba;
use super::strip::svg::{css, tenth};
use ::svg::node::element::path::Data;
use ::svg::node::element::{ClipPath, Group, Path, Rectangle, Text};
use ::svg::{Document, Node};

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
/// Height of the middle of the legend's first line.
const FIRST_LINE: f64 = 30.0;
/// More points than this add nothing at this size.
const MOST_POINTS: usize = 400;
const BAND: Rgba = Rgba::hex(0xd9_e2ec);
const GRID: Rgba = Rgba::hex(0xe6_e4de);

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
        let (top, bottom) = (self.top(), HEIGHT - BOTTOM);
        let paper = Rectangle::new().set("width", "100%").set("height", "100%");
        let inside = Rectangle::new()
            .set("x", LEFT)
            .set("y", top)
            .set("width", WIDTH - LEFT - RIGHT)
            .set("height", bottom - top);
        let middle = 0.5 * (top + bottom);
        let turned = format!("translate(13 {middle}) rotate(-90)");
        let mut out = Document::new()
            .set("viewBox", (0, 0, WIDTH, HEIGHT))
            .set("width", WIDTH)
            .set("height", HEIGHT)
            .set("font-family", "system-ui, sans-serif")
            .set("font-size", 11)
            .set("fill", "#33373d")
            .add(paper.set("fill", "#fbfbf9"))
            .add(ClipPath::new().set("id", "c").add(inside))
            .add(
                text(&self.title, "start", [LEFT, 15.0])
                    .set("font-size", 13)
                    .set("font-weight", 600),
            )
            .add(text(&self.x, "end", [WIDTH - RIGHT, HEIGHT - 5.0]))
            .add(text(&self.y, "middle", [0.0, 0.0]).set("transform", turned));
        for v in x.ticks(8) {
            let at = x.at(v);
            out.append(line([[at, top], [at, bottom]], GRID, 1.0, false));
            out.append(text(&number(v), "middle", [at, bottom + 14.0]));
        }
        for v in y.ticks(5) {
            let at = y.at(v);
            out.append(line([[LEFT, at], [WIDTH - RIGHT, at]], GRID, 1.0, false));
            out.append(text(&number(v), "end", [LEFT - 6.0, at + 4.0]));
        }
        let mut data = Group::new()
            .set("clip-path", "url(#c)")
            .set("stroke-linejoin", "round");
        for b in &self.bands {
            let p = thinned(&b.points);
            let upper = p.iter().rev().map(|q| [x.at(q[0]), y.near(q[2])]);
            let lower = p.iter().map(|q| [x.at(q[0]), y.near(q[1])]);
            let area = Path::new().set("d", path(lower.chain(upper)).close());
            data.append(area.set("fill", css(BAND)));
        }
        for c in &self.curves {
            let points = thinned(&c.points);
            let points = points.iter().map(|q| [x.at(q[0]), y.near(q[1])]);
            data.append(line(points, c.colour, 1.6, c.dashed));
        }
        out.append(data);
        for ([x, y], (label, colour, width, dashed)) in self.legend() {
            out.append(line([[x, y], [x + 18.0, y]], colour, width, dashed));
            out.append(text(label, "start", [x + 23.0, y + 4.0]));
        }
        format!("{out}\n")
    }

    /// Upper end of the axes: below the lines of the legend.
    fn top(&self) -> f64 {
        let last = self.legend().last().map_or(FIRST_LINE, |(at, _)| at[1]);
        TOP + last - FIRST_LINE
    }

    /// Positions of the legend's entries, pixels, with their content.
    fn legend(&self) -> Vec<([f64; 2], LegendEntry<'_>)> {
        let bands = self.bands.iter().map(|b| (&b.label[..], BAND, 8.0, false));
        let curves = self.curves.iter();
        let curves = curves.map(|c| (&c.label[..], c.colour, 2.0, c.dashed));
        let (mut at, mut line) = (LEFT, FIRST_LINE);
        let entries = bands.chain(curves).filter(|e| !e.0.is_empty());
        let placed = entries.map(|entry| {
            // Largest width of the label, pixels.
            let long = 35.0 + 6.0 * entry.0.chars().count() as f64;
            if at > LEFT && at + long > WIDTH {
                (at, line) = (LEFT, line + LEGEND_LINE);
            }
            at += long;
            ([at - long, line], entry)
        });
        placed.collect()
    }
}

/// An entry of the legend: text, colour, width of its line in pixels, dashed.
type LegendEntry<'a> = (&'a str, Rgba, f64, bool);

fn text(content: &str, anchor: &str, [x, y]: [f64; 2]) -> Text {
    let [x, y] = [x, y].map(tenth);
    Text::new(content)
        .set("x", x)
        .set("y", y)
        .set("text-anchor", anchor)
}

/// A path through points, with gaps where they are not finite.
fn path(points: impl IntoIterator<Item = [f64; 2]>) -> Data {
    let (mut data, mut pen_down) = (Data::new(), false);
    for [x, y] in points {
        let finite = x.is_finite() && y.is_finite();
        let at = (tenth(x), tenth(y));
        data = match (finite, pen_down) {
            (true, true) => data.line_to(at),
            (true, false) => data.move_to(at),
            (false, _) => data,
        };
        pen_down = finite;
    }
    data
}

fn line(
    points: impl IntoIterator<Item = [f64; 2]>,
    colour: Rgba,
    width: f64,
    dashed: bool,
) -> Path {
    let mut line = Path::new()
        .set("d", path(points))
        .set("fill", "none")
        .set("stroke", css(colour))
        .set("stroke-width", width);
    if dashed {
        line.assign("stroke-dasharray", "5 4");
    }
    line
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
    /// The same, but never farther outside than the height of the plot: files stay readable when data run away.
    fn near(&self, v: f64) -> f64 {
        let at = self.at(v);
        if at.is_finite() {
            at.clamp(-HEIGHT, 2.0 * HEIGHT)
        } else {
            f64::NAN
        }
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

fn number(v: f64) -> String {
    let text = format!("{v:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
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
