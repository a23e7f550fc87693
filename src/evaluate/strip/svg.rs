//! Writes a drawing as SVG.

use super::drawing::{Anchor, Drawing, Item, Rgba};
use std::fmt::Write;

/// The drawing as a self-contained SVG document.
pub fn write(drawing: &Drawing) -> String {
    let mut out = String::new();
    let (w, h) = (drawing.width, drawing.height);
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w:.0} {h:.0}" width="{w:.0}" height="{h:.0}" font-family="system-ui, sans-serif" stroke-linejoin="round" stroke-linecap="round">"#
    );
    let _ = writeln!(
        out,
        r#"<rect width="100%" height="100%"{}/>"#,
        fill(drawing.background)
    );
    // Solids follow one another in the list; a flat picture shows the nearer ones last.
    let mut items = drawing.items.iter().peekable();
    while let Some(item) = items.next() {
        if let Item::Solid { .. } = item {
            let mut solids = vec![item];
            while let Some(next) = items.next_if(|i| matches!(i, Item::Solid { .. })) {
                solids.push(next);
            }
            solids.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
            for solid in solids {
                write_item(&mut out, solid);
            }
        } else {
            write_item(&mut out, item);
        }
    }
    out.push_str("</svg>\n");
    out
}

/// Mean nearness of a solid's vertices.
fn nearness(item: &Item) -> f64 {
    match item {
        Item::Solid { vertices, .. } if !vertices.is_empty() => {
            vertices.iter().map(|v| v[2]).sum::<f64>() / vertices.len() as f64
        }
        _ => 0.0,
    }
}

fn write_item(out: &mut String, item: &Item) {
    let _ = match item {
        Item::Polygon {
            points,
            fill: f,
            stroke: s,
        } => {
            writeln!(
                out,
                r#"<path d="{}"{}{}/>"#,
                path(points),
                fill(*f),
                stroke(*s)
            )
        }
        Item::Line {
            from,
            to,
            width,
            colour,
        } => writeln!(
            out,
            r#"<path d="M{:.1} {:.1}L{:.1} {:.1}" fill="none"{}/>"#,
            from[0],
            from[1],
            to[0],
            to[1],
            stroke(Some((*colour, *width)))
        ),
        Item::Circle {
            centre,
            radius,
            fill: f,
            stroke: s,
        } => writeln!(
            out,
            r#"<circle cx="{:.1}" cy="{:.1}" r="{radius:.1}"{}{}/>"#,
            centre[0],
            centre[1],
            fill(*f),
            stroke(*s)
        ),
        Item::Text {
            at,
            size,
            anchor,
            colour,
            text,
        } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
            };
            writeln!(
                out,
                r#"<text x="{:.1}" y="{:.1}" font-size="{size:.0}" text-anchor="{anchor}"{}>{}</text>"#,
                at[0],
                at[1],
                fill(*colour),
                escape(text)
            )
        }
        Item::Solid {
            outline, colour, ..
        } => {
            let edge = Rgba([0, 1, 2, 3].map(|i| {
                if i < 3 {
                    (f64::from(colour.0[i]) * 0.68) as u8
                } else {
                    255
                }
            }));
            writeln!(
                out,
                r#"<path d="{}"{}{}/>"#,
                path(outline),
                fill(*colour),
                stroke(Some((edge, 1.0)))
            )
        }
    };
}

fn path(points: &[[f64; 2]]) -> String {
    let mut out = String::new();
    for (i, p) in points.iter().enumerate() {
        let _ = write!(
            out,
            "{}{:.1} {:.1}",
            if i == 0 { 'M' } else { 'L' },
            p[0],
            p[1]
        );
    }
    out.push('Z');
    out
}

fn colour(c: Rgba) -> String {
    format!("#{:02x}{:02x}{:02x}", c.0[0], c.0[1], c.0[2])
}

fn opacity(name: &str, c: Rgba) -> String {
    if c.0[3] == 255 {
        String::new()
    } else {
        format!(r#" {name}-opacity="{:.2}""#, f64::from(c.0[3]) / 255.0)
    }
}

fn fill(c: Rgba) -> String {
    if c.0[3] == 0 {
        r#" fill="none""#.to_owned()
    } else {
        format!(r#" fill="{}"{}"#, colour(c), opacity("fill", c))
    }
}

fn stroke(s: Option<(Rgba, f64)>) -> String {
    s.map_or_else(String::new, |(c, w)| {
        format!(
            r#" stroke="{}" stroke-width="{w:.1}"{}"#,
            colour(c),
            opacity("stroke", c)
        )
    })
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
