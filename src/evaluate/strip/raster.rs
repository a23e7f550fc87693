//! Paints a drawing into pixels and writes PNG.

use super::drawing::{Anchor, Drawing, Item, Rgba};
use super::font;

/// Samples per pixel and direction: edges are smoothed by averaging.
const SAMPLES: usize = 3;

/// The drawing as a PNG file (8-bit RGB), `drawing.width` × `drawing.height` pixels.
///
/// # Errors
/// When the picture is empty or larger than PNG allows.
pub fn png(drawing: &Drawing) -> Result<Vec<u8>, png::EncodingError> {
    let mut canvas = Canvas::new(drawing);
    for item in &drawing.items {
        canvas.paint(item);
    }
    let (width, height, pixels) = canvas.averaged();
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(out)
}

/// Samples: colour and nearness.
struct Canvas {
    width: usize,
    height: usize,
    colour: Vec<[u8; 3]>,
    nearness: Vec<f32>,
}

impl Canvas {
    fn new(drawing: &Drawing) -> Self {
        let (width, height) = (
            drawing.width.ceil() as usize * SAMPLES,
            drawing.height.ceil() as usize * SAMPLES,
        );
        let [r, g, b, _] = drawing.background.0;
        Self {
            width,
            height,
            colour: vec![[r, g, b]; width * height],
            nearness: vec![f32::NEG_INFINITY; width * height],
        }
    }

    fn averaged(&self) -> (usize, usize, Vec<u8>) {
        let (w, h) = (self.width / SAMPLES, self.height / SAMPLES);
        let mut out = Vec::with_capacity(w * h * 3);
        for y in 0..h {
            for x in 0..w {
                let mut sum = [0u32; 3];
                for sy in 0..SAMPLES {
                    let row = (y * SAMPLES + sy) * self.width + x * SAMPLES;
                    for c in &self.colour[row..row + SAMPLES] {
                        for i in 0..3 {
                            sum[i] += u32::from(c[i]);
                        }
                    }
                }
                out.extend(sum.map(|s| (s / (SAMPLES * SAMPLES) as u32) as u8));
            }
        }
        (w, h, out)
    }

    fn paint(&mut self, item: &Item) {
        match item {
            Item::Polygon {
                points,
                fill,
                stroke,
            } => {
                self.polygon(points, *fill);
                if let Some((colour, width)) = stroke {
                    for i in 0..points.len() {
                        self.line(points[i], points[(i + 1) % points.len()], *width, *colour);
                    }
                }
            }
            Item::Line {
                from,
                to,
                width,
                colour,
            } => self.line(*from, *to, *width, *colour),
            Item::Circle {
                centre,
                radius,
                fill,
                stroke,
            } => {
                let (colour, width) = stroke.unwrap_or((*fill, 0.0));
                self.disc(*centre, radius + width / 2.0, radius - width / 2.0, colour);
                self.disc(*centre, radius - width / 2.0, 0.0, *fill);
            }
            Item::Text {
                at,
                size,
                anchor,
                colour,
                text,
            } => {
                let shift = match anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle => font::width(text, *size) / 2.0,
                };
                for [from, to] in font::strokes(text, [at[0] - shift, at[1]], *size) {
                    self.line(from, to, size * 0.085, *colour);
                }
            }
            Item::Solid {
                vertices,
                light,
                triangles,
                colour,
                ..
            } => {
                for t in triangles {
                    let corner = t.map(|i| vertices[i as usize]);
                    let lit = t.map(|i| light[i as usize]);
                    self.triangle(corner, lit, *colour);
                }
            }
        }
    }

    /// Sample columns and rows that the box touches.
    fn bounds(&self, low: [f64; 2], high: [f64; 2]) -> [std::ops::Range<usize>; 2] {
        let s = SAMPLES as f64;
        // Casting saturates, so that far outside points are harmless.
        let range = |a: f64, b: f64, n: usize| {
            let end = ((b * s).ceil().max(0.0) as usize).min(n);
            ((a * s).floor().max(0.0) as usize).min(end)..end
        };
        [
            range(low[0], high[0], self.width),
            range(low[1], high[1], self.height),
        ]
    }

    /// Centre of a sample in pixels.
    fn centre(x: usize, y: usize) -> [f64; 2] {
        [
            (x as f64 + 0.5) / SAMPLES as f64,
            (y as f64 + 0.5) / SAMPLES as f64,
        ]
    }

    fn blend(&mut self, x: usize, y: usize, c: Rgba) {
        let to = &mut self.colour[y * self.width + x];
        let a = u32::from(c.0[3]);
        for i in 0..3 {
            to[i] = ((u32::from(to[i]) * (255 - a) + u32::from(c.0[i]) * a + 127) / 255) as u8;
        }
    }

    fn polygon(&mut self, points: &[[f64; 2]], fill: Rgba) {
        if points.len() < 3 || fill.0[3] == 0 {
            return;
        }
        let low = [0, 1].map(|i| points.iter().map(|p| p[i]).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|i| {
            points
                .iter()
                .map(|p| p[i])
                .fold(f64::NEG_INFINITY, f64::max)
        });
        let [_, rows] = self.bounds(low, high);
        let mut crossings = Vec::new();
        for y in rows {
            let py = Self::centre(0, y)[1];
            crossings.clear();
            for i in 0..points.len() {
                let (a, b) = (points[i], points[(i + 1) % points.len()]);
                if (a[1] <= py) != (b[1] <= py) {
                    crossings.push(a[0] + (py - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
                }
            }
            crossings.sort_by(f64::total_cmp);
            for span in crossings.chunks_exact(2) {
                let [columns, _] = self.bounds([span[0], 0.0], [span[1], 0.0]);
                for x in columns {
                    let px = Self::centre(x, y)[0];
                    if px >= span[0] && px < span[1] {
                        self.blend(x, y, fill);
                    }
                }
            }
        }
    }

    fn line(&mut self, from: [f64; 2], to: [f64; 2], width: f64, colour: Rgba) {
        let r = width / 2.0;
        let low = [0, 1].map(|i| from[i].min(to[i]) - r);
        let high = [0, 1].map(|i| from[i].max(to[i]) + r);
        let d = [to[0] - from[0], to[1] - from[1]];
        let length2 = (d[0] * d[0] + d[1] * d[1]).max(1e-12);
        let [columns, rows] = self.bounds(low, high);
        for y in rows {
            for x in columns.clone() {
                let p = Self::centre(x, y);
                let e = [p[0] - from[0], p[1] - from[1]];
                let u = ((e[0] * d[0] + e[1] * d[1]) / length2).clamp(0.0, 1.0);
                let off = [e[0] - u * d[0], e[1] - u * d[1]];
                if off[0] * off[0] + off[1] * off[1] <= r * r {
                    self.blend(x, y, colour);
                }
            }
        }
    }

    fn disc(&mut self, centre: [f64; 2], outer: f64, inner: f64, colour: Rgba) {
        if colour.0[3] == 0 {
            return;
        }
        let [columns, rows] = self.bounds(centre.map(|c| c - outer), centre.map(|c| c + outer));
        for y in rows {
            for x in columns.clone() {
                let p = Self::centre(x, y);
                let r = (p[0] - centre[0]).hypot(p[1] - centre[1]);
                if r <= outer && r >= inner {
                    self.blend(x, y, colour);
                }
            }
        }
    }

    fn triangle(&mut self, v: [[f64; 3]; 3], light: [f64; 3], colour: Rgba) {
        let area =
            (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[1][1] - v[0][1]) * (v[2][0] - v[0][0]);
        if area.abs() < 1e-9 || !area.is_finite() {
            return;
        }
        let low = [0, 1].map(|i| v[0][i].min(v[1][i]).min(v[2][i]));
        let high = [0, 1].map(|i| v[0][i].max(v[1][i]).max(v[2][i]));
        let [columns, rows] = self.bounds(low, high);
        for y in rows {
            for x in columns.clone() {
                let p = Self::centre(x, y);
                // Barycentric coordinates: share of each corner.
                let share = |a: usize, b: usize| {
                    ((v[b][0] - v[a][0]) * (p[1] - v[a][1])
                        - (v[b][1] - v[a][1]) * (p[0] - v[a][0]))
                        / area
                };
                let w = [share(1, 2), share(2, 0), share(0, 1)];
                if w.iter().any(|s| *s < 0.0) {
                    continue;
                }
                let mix = |f: [f64; 3]| w[0] * f[0] + w[1] * f[1] + w[2] * f[2];
                let near = mix([v[0][2], v[1][2], v[2][2]]) as f32;
                let at = y * self.width + x;
                if near > self.nearness[at] {
                    self.nearness[at] = near;
                    let b = mix(light);
                    self.colour[at] =
                        [0, 1, 2].map(|i| (f64::from(colour.0[i]) * b).clamp(0.0, 255.0) as u8);
                }
            }
        }
    }
}
