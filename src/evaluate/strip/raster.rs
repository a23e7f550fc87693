//! Paints a drawing into pixels and writes PNG.

use super::drawing::{Drawing, DrawnItem, Rgba, TextAnchor};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use tiny_skia::{
    Color, FillRule, FilterQuality, GradientStop, LineCap, LineJoin, LinearGradient, Paint, Path,
    PathBuilder, Pixmap, PixmapPaint, Point, Shader, SpreadMode, Stroke, Transform,
};

/// Solids are painted this many times larger and then averaged, so that their triangles leave no seams.
const OVERSAMPLING: f32 = 2.0;
/// Share of a glyph's height that is above the base line.
const ASCENT: f64 = 0.78;

/// The drawing as a PNG file (8-bit RGB), `drawing.width` × `drawing.height` pixels.
///
/// # Errors
/// When the picture is empty or larger than PNG allows.
pub fn png(drawing: &Drawing) -> Result<Vec<u8>, png::EncodingError> {
    let (width, height) = (drawing.width.ceil() as u32, drawing.height.ceil() as u32);
    let mut canvas = Pixmap::new(width, height)
        .ok_or_else(|| std::io::Error::other("a picture of no pixels, or of too many"))?;
    canvas.fill(color(drawing.background, 1.0));
    for run in drawing
        .items
        .chunk_by(|a, b| matches!((a, b), (DrawnItem::Solid { .. }, DrawnItem::Solid { .. })))
    {
        match &run[0] {
            DrawnItem::Solid { .. } => paint_solids(&mut canvas, run),
            item => paint_flat(&mut canvas, item),
        }
    }
    let pixels = canvas.pixels().iter();
    let rgb: Vec<u8> = pixels
        .flat_map(|p| [p.red(), p.green(), p.blue()])
        .collect();
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(out)
}

/// A colour with its brightness scaled by `light`.
fn color(Rgba(c): Rgba, light: f64) -> Color {
    let [r, g, b] = [0, 1, 2].map(|i| (f64::from(c[i]) * light).clamp(0.0, 255.0) as u8);
    Color::from_rgba8(r, g, b, c[3])
}

fn paint(shader: Shader<'static>, anti_alias: bool) -> Paint<'static> {
    Paint {
        shader,
        anti_alias,
        ..Paint::default()
    }
}

/// A colour whose brightness between the corners of a triangle is that of the corners (Gouraud).
fn shade(colour: Rgba, corners: [[f64; 3]; 3], light: [f64; 3]) -> Paint<'static> {
    let [a, u, v] = [corners[0], corners[1], corners[2]];
    let (u, v) = ([u[0] - a[0], u[1] - a[1]], [v[0] - a[0], v[1] - a[1]]);
    let (du, dv) = (light[1] - light[0], light[2] - light[0]);
    let area = u[0] * v[1] - u[1] * v[0];
    let slope = [
        (du * v[1] - dv * u[1]) / area,
        (dv * u[0] - du * v[0]) / area,
    ];
    let square = slope[0] * slope[0] + slope[1] * slope[1];
    let [low, high] = [f64::min, f64::max]
        .map(|pick: fn(f64, f64) -> f64| pick(pick(light[0], light[1]), light[2]));
    // The point on the gradient through the first corner that is this bright.
    let at = |l: f64| {
        let [x, y] = [0, 1].map(|i| a[i] + slope[i] * (l - light[0]) / square);
        Point::from_xy(x as f32, y as f32)
    };
    let stops = vec![
        GradientStop::new(0.0, color(colour, low)),
        GradientStop::new(1.0, color(colour, high)),
    ];
    let even = || Shader::SolidColor(color(colour, 0.5 * (low + high)));
    let gradient = (high - low > 0.01)
        .then(|| {
            LinearGradient::new(
                at(low),
                at(high),
                stops,
                SpreadMode::Pad,
                Transform::identity(),
            )
        })
        .flatten();
    paint(gradient.unwrap_or_else(even), false)
}

/// A path through points, closed or open; `None` if there is nothing to paint.
fn path(points: impl IntoIterator<Item = [f64; 2]>, close: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for [x, y] in points.into_iter().map(|p| p.map(|x| x as f32)) {
        if path.is_empty() {
            path.move_to(x, y);
        } else {
            path.line_to(x, y);
        }
    }
    if close {
        path.close();
    }
    path.finish()
}

fn fill(canvas: &mut Pixmap, path: &Path, colour: Rgba) {
    let paint = paint(Shader::SolidColor(color(colour, 1.0)), true);
    canvas.fill_path(path, &paint, FillRule::Winding, Transform::identity(), None);
}

fn stroke(canvas: &mut Pixmap, path: &Path, (colour, width): (Rgba, f64)) {
    let stroke = Stroke {
        width: width as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        ..Stroke::default()
    };
    let paint = paint(Shader::SolidColor(color(colour, 1.0)), true);
    canvas.stroke_path(path, &paint, &stroke, Transform::identity(), None);
}

fn paint_flat(canvas: &mut Pixmap, item: &DrawnItem) {
    let (path, filled, outline) = match item {
        DrawnItem::Polygon {
            points,
            fill,
            stroke,
        } => (path(points.iter().copied(), true), Some(*fill), *stroke),
        DrawnItem::Line {
            from,
            to,
            width,
            colour,
        } => (path([*from, *to], false), None, Some((*colour, *width))),
        DrawnItem::Circle {
            centre,
            radius,
            fill,
            stroke,
        } => (
            PathBuilder::from_circle(centre[0] as f32, centre[1] as f32, *radius as f32),
            Some(*fill),
            *stroke,
        ),
        DrawnItem::Text {
            at,
            size,
            anchor,
            colour,
            text,
        } => return write(canvas, text, *at, *size, *anchor, *colour),
        DrawnItem::Solid { .. } => return,
    };
    let Some(path) = path else { return };
    if let Some(colour) = filled {
        fill(canvas, &path, colour);
    }
    if let Some(outline) = outline {
        stroke(canvas, &path, outline);
    }
}

/// Paints solids that cover each other by depth: their triangles that face the viewer, the farthest first.
fn paint_solids(canvas: &mut Pixmap, solids: &[DrawnItem]) {
    let mut triangles = Vec::new();
    for item in solids {
        let DrawnItem::Solid {
            vertices,
            light,
            triangles: corners,
            colour,
            ..
        } = item
        else {
            continue;
        };
        for t in corners {
            let [a, b, c] = t.map(|i| vertices[i as usize]);
            let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            if turn < 0.0 {
                let lit = t.map(|i| light[i as usize]);
                triangles.push((
                    a[2] + b[2] + c[2],
                    [a, b, c],
                    shade(*colour, [a, b, c], lit),
                ));
            }
        }
    }
    triangles.sort_by(|a, b| a.0.total_cmp(&b.0));
    // A layer over the part of the picture that they cover.
    let corners = || triangles.iter().flat_map(|t| t.1);
    let end = [canvas.width(), canvas.height()].map(f64::from);
    let [low, high] = [f64::min, f64::max].map(|pick: fn(f64, f64) -> f64| {
        [0, 1].map(|i| corners().map(|p| p[i].clamp(0.0, end[i])).reduce(pick))
    });
    let ([Some(x0), Some(y0)], [Some(x1), Some(y1)]) = (low, high) else {
        return;
    };
    let (x0, y0) = (x0.floor() as f32, y0.floor() as f32);
    let size = [x1.ceil() as f32 - x0, y1.ceil() as f32 - y0];
    let [width, height] = size.map(|n| (n * OVERSAMPLING) as u32);
    let Some(mut layer) = Pixmap::new(width, height) else {
        return;
    };
    let larger = Transform::from_translate(-x0, -y0).post_scale(OVERSAMPLING, OVERSAMPLING);
    for (_, corners, paint) in &triangles {
        if let Some(path) = path(corners.map(|[x, y, _]| [x, y]), true) {
            layer.fill_path(&path, paint, FillRule::Winding, larger, None);
        }
    }
    let averaged = PixmapPaint {
        quality: FilterQuality::Bilinear,
        ..PixmapPaint::default()
    };
    let share = 1.0 / OVERSAMPLING;
    let smaller = Transform::from_row(share, 0.0, 0.0, share, x0, y0);
    canvas.draw_pixmap(0, 0, layer.as_ref(), &averaged, smaller, None);
}

/// Writes one line of text on the base line `at`, in the glyphs that are nearest to `size`.
fn write(
    canvas: &mut Pixmap,
    text: &str,
    at: [f64; 2],
    size: f64,
    anchor: TextAnchor,
    colour: Rgba,
) {
    let height = if size < 14.0 {
        RasterHeight::Size16
    } else {
        RasterHeight::Size20
    };
    let advance = get_raster_width(FontWeight::Regular, height) as f64;
    let left = match anchor {
        TextAnchor::Start => at[0],
        TextAnchor::Middle => at[0] - 0.5 * advance * text.chars().count() as f64,
    };
    let top = at[1] - ASCENT * height.val() as f64;
    for (k, c) in text.chars().enumerate() {
        let Some(glyph) = get_raster(c, FontWeight::Regular, height) else {
            continue;
        };
        let Some(mut ink) = Pixmap::new(glyph.width() as u32, glyph.height() as u32) else {
            continue;
        };
        for (p, share) in ink.pixels_mut().iter_mut().zip(glyph.pixels()) {
            let mut c = color(colour, 1.0);
            c.apply_opacity(f32::from(*share) / 255.0);
            *p = c.premultiply().to_color_u8();
        }
        let x = (left + k as f64 * advance).round() as i32;
        let y = top.round() as i32;
        let paint = PixmapPaint::default();
        canvas.draw_pixmap(x, y, ink.as_ref(), &paint, Transform::identity(), None);
    }
}
