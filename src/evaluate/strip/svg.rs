//! Writes a drawing as SVG.

use super::drawing::{Drawing, DrawnItem, Rgba, TextAnchor};
use ::svg::node::element::path::Data;
use ::svg::node::element::{Circle, Path, Rectangle, Text};
use ::svg::{Document, Node};

/// The drawing as a self-contained SVG document.
pub fn write(drawing: &Drawing) -> String {
    let (w, h) = (drawing.width.round(), drawing.height.round());
    let mut out = Document::new()
        .set("viewBox", (0, 0, w, h))
        .set("width", w)
        .set("height", h)
        .set("font-family", "system-ui, sans-serif")
        .set("stroke-linejoin", "round")
        .set("stroke-linecap", "round");
    let mut paper = Rectangle::new().set("width", "100%").set("height", "100%");
    fill(&mut paper, drawing.background);
    out.append(paper);
    // Solids follow one another in the list; a flat picture shows the nearer ones last.
    for run in drawing
        .items
        .chunk_by(|a, b| matches!((a, b), (DrawnItem::Solid { .. }, DrawnItem::Solid { .. })))
    {
        let mut run: Vec<&DrawnItem> = run.iter().collect();
        run.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
        run.into_iter().for_each(|item| append(&mut out, item));
    }
    format!("{out}\n")
}

/// Mean nearness of a solid's vertices.
fn nearness(item: &DrawnItem) -> f64 {
    match item {
        DrawnItem::Solid { vertices, .. } if !vertices.is_empty() => {
            vertices.iter().map(|v| v[2]).sum::<f64>() / vertices.len() as f64
        }
        _ => 0.0,
    }
}

fn append(out: &mut Document, item: &DrawnItem) {
    match item {
        DrawnItem::Polygon {
            points,
            fill: f,
            stroke: s,
        } => append_polygon(out, points, *f, *s),
        DrawnItem::Line {
            from,
            to,
            width,
            colour,
        } => {
            let line = Data::new().move_to(tenths(*from)).line_to(tenths(*to));
            let mut line = Path::new().set("d", line).set("fill", "none");
            stroke(&mut line, *colour, *width);
            out.append(line);
        }
        DrawnItem::Circle {
            centre,
            radius,
            fill: f,
            stroke: s,
        } => {
            let (x, y) = tenths(*centre);
            let mut circle = Circle::new()
                .set("cx", x)
                .set("cy", y)
                .set("r", tenth(*radius));
            fill(&mut circle, *f);
            if let Some((colour, width)) = s {
                stroke(&mut circle, *colour, *width);
            }
            out.append(circle);
        }
        DrawnItem::Text {
            at,
            size,
            anchor,
            colour,
            text,
        } => {
            let (x, y) = tenths(*at);
            let mut line = Text::new(text)
                .set("x", x)
                .set("y", y)
                .set("font-size", *size)
                .set(
                    "text-anchor",
                    match anchor {
                        TextAnchor::Start => "start",
                        TextAnchor::Middle => "middle",
                    },
                );
            fill(&mut line, *colour);
            out.append(line);
        }
        DrawnItem::Solid {
            outline, colour, ..
        } => {
            let [r, g, b, _] = colour.0.map(|c| (f64::from(c) * 0.68) as u8);
            let edge = Rgba([r, g, b, 255]);
            append_polygon(out, outline, *colour, Some((edge, 1.0)));
        }
    }
}

fn append_polygon(
    out: &mut Document,
    points: &[[f64; 2]],
    filled: Rgba,
    outline: Option<(Rgba, f64)>,
) {
    let mut data = Data::new();
    for (i, p) in points.iter().enumerate() {
        data = match i {
            0 => data.move_to(tenths(*p)),
            _ => data.line_to(tenths(*p)),
        };
    }
    let mut path = Path::new().set("d", data.close());
    fill(&mut path, filled);
    if let Some((colour, width)) = outline {
        stroke(&mut path, colour, width);
    }
    out.append(path);
}

/// Rounded to a tenth of a pixel.
pub(crate) fn tenth(x: f64) -> f32 {
    ((x * 10.0).round() / 10.0) as f32
}

fn tenths(p: [f64; 2]) -> (f32, f32) {
    (tenth(p[0]), tenth(p[1]))
}

fn fill(node: &mut impl Node, c: Rgba) {
    if c.0[3] == 0 {
        node.assign("fill", "none");
    } else {
        paint(node, "fill", c);
    }
}

fn stroke(node: &mut impl Node, c: Rgba, width: f64) {
    paint(node, "stroke", c);
    node.assign("stroke-width", tenth(width));
}

/// A colour without its opacity, as in style sheets.
pub(crate) fn css(Rgba([r, g, b, _]): Rgba) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn paint(node: &mut impl Node, what: &str, colour: Rgba) {
    node.assign(what, css(colour));
    let a = colour.0[3];
    if a < 255 {
        let opacity = (f32::from(a) / 2.55).round() / 100.0;
        node.assign(format!("{what}-opacity"), opacity);
    }
}
