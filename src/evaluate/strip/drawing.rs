//! A list of flat shapes and shaded solids in pixels, y downwards.

/// Colour with opacity, 0…255 each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgba(pub [u8; 4]);

impl Rgba {
    /// Opaque `0xRRGGBB`.
    pub const fn hex(rgb: u32) -> Self {
        Self([(rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8, 255])
    }
    /// The same colour with opacity `a` (0…255).
    pub const fn alpha(self, a: u8) -> Self {
        Self([self.0[0], self.0[1], self.0[2], a])
    }
}

/// Where a text is anchored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Anchor {
    Start,
    Middle,
}

/// One shape. Later shapes cover earlier ones, except that solids cover each other by depth.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Item {
    /// Filled polygon, optionally outlined (colour, width).
    Polygon {
        points: Vec<[f64; 2]>,
        fill: Rgba,
        stroke: Option<(Rgba, f64)>,
    },
    /// Straight line with round ends.
    Line {
        from: [f64; 2],
        to: [f64; 2],
        width: f64,
        colour: Rgba,
    },
    /// Disc, optionally outlined (colour, width).
    Circle {
        centre: [f64; 2],
        radius: f64,
        fill: Rgba,
        stroke: Option<(Rgba, f64)>,
    },
    /// One line of text; `at`: start or middle of the base line; `size`: height of a line.
    Text {
        at: [f64; 2],
        size: f64,
        anchor: Anchor,
        colour: Rgba,
        text: String,
    },
    /// A lit surface. `vertices`: x, y, nearness (larger is nearer) in pixels; `light`: brightness of each vertex, 0…1.
    /// `outline` is what a flat writer shows instead.
    Solid {
        outline: Vec<[f64; 2]>,
        vertices: Vec<[f64; 3]>,
        light: Vec<f64>,
        triangles: Vec<[u32; 3]>,
        colour: Rgba,
    },
}

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Pixels.
    pub width: f64,
    /// Pixels.
    pub height: f64,
    /// Background.
    pub background: Rgba,
    /// Shapes, back to front.
    pub items: Vec<Item>,
}

/// Corners of the convex hull of points in the plane (monotone chain), in order round it.
pub fn convex_hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let turn = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut out: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while out.len() >= 2 && turn(out[out.len() - 2], out[out.len() - 1], p) <= 0.0 {
                out.pop();
            }
            out.push(p);
        }
        out.pop(); // the last point starts the other chain
        out
    };
    let mut hull = chain(&mut sorted.iter().copied());
    hull.extend(chain(&mut sorted.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hull_of_a_square_with_inner_points_is_its_corners() {
        let mut points = vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [1.0, 1.0],
            [1.0, 0.0],
            [0.5, 1.5],
        ];
        let mut hull = convex_hull(&points);
        hull.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        points.truncate(4);
        points.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        assert_eq!(hull, points);
    }
}
