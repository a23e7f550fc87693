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

/// The anchor of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum TextAnchor {
    Start,
    Middle,
}

/// One shape. Later shapes cover earlier ones, except that solids cover each other by depth.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum DrawnItem {
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
        anchor: TextAnchor,
        colour: Rgba,
        text: String,
    },
    /// A lit surface. `vertices`: x, y, nearness (larger is nearer) in pixels; `light`: brightness of each vertex, 0…1.
    /// A flat writer shows `outline` instead.
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
    pub items: Vec<DrawnItem>,
}

impl DrawnItem {
    /// Moves everything down by `by` pixels.
    fn lower(&mut self, by: f64) {
        match self {
            Self::Polygon { points, .. } => points.iter_mut().for_each(|p| p[1] += by),
            Self::Line { from, to, .. } => {
                from[1] += by;
                to[1] += by;
            }
            Self::Circle { centre, .. } => centre[1] += by,
            Self::Text { at, .. } => at[1] += by,
            Self::Solid {
                outline, vertices, ..
            } => {
                outline.iter_mut().for_each(|p| p[1] += by);
                vertices.iter_mut().for_each(|p| p[1] += by);
            }
        }
    }
}

impl Drawing {
    /// This one with `other` below it.
    #[must_use]
    pub fn above(mut self, mut other: Self) -> Self {
        other.items.iter_mut().for_each(|i| i.lower(self.height));
        self.items.append(&mut other.items);
        self.width = self.width.max(other.width);
        self.height += other.height;
        self
    }
}
