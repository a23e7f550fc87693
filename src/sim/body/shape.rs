//! Shapes of the segments of an adult: cross-sections along each segment for the average man and woman.
//!
//! Lengths along a segment follow de Leva 1996 (see [`super::humanoid`]); the cross-sections are drawn here so that,
//! filled with tissue of the stated density, they come close to the centre of mass and the transverse radii of gyration
//! of that table. A segment's *girth* (one factor on its cross-sections) is then chosen so that density times volume is
//! the table's mass, which makes a heavy body stout. Head, hands and feet hardly grow with fat, so their girth is
//! bounded and their density changes instead.

use super::geometry::{Section, append, extreme, loft, volume};
use super::model::Mesh;
use crate::math::Vec3;
use crate::math::vec3::vec3;

/// A horizontal cross-section of a segment that runs along z.
///
/// `[z, half depth (x), half width (y), centre x, squareness]`; lengths in mm of the reference figure, z of limbs as a
/// fraction of the segment length (up positive).
type Row = [f64; 5];

/// The outline of a segment along z: a pole, rows, a pole; poles as `[z, x]`.
struct Outline<'a> {
    first: [f64; 2],
    rows: &'a [Row],
    last: [f64; 2],
}

const PELVIS_MAN: Outline<'static> = Outline {
    first: [-84.0, -4.0],
    rows: &[
        [-78.0, 44.0, 44.0, -4.0, 0.0],
        [-58.0, 80.0, 92.0, -8.0, 0.05],
        [-15.0, 110.0, 142.0, -12.0, 0.1],
        [35.0, 116.0, 160.0, -12.0, 0.1],
        [85.0, 109.0, 158.0, -5.0, 0.1],
        [125.0, 103.0, 152.0, 0.0, 0.1],
        [152.0, 99.0, 149.0, 0.0, 0.1],
    ],
    last: [166.0, 0.0],
};
const PELVIS_WOMAN: Outline<'static> = Outline {
    first: [-56.0, -6.0],
    rows: &[
        [-50.0, 36.0, 34.0, -6.0, 0.0],
        [-34.0, 66.0, 76.0, -9.0, 0.05],
        [2.0, 96.0, 130.0, -12.0, 0.1],
        [52.0, 112.0, 160.0, -12.0, 0.1],
        [100.0, 108.0, 160.0, -7.0, 0.1],
        [145.0, 101.0, 147.0, -2.0, 0.1],
        [180.0, 94.0, 133.0, 0.0, 0.1],
    ],
    last: [191.0, 0.0],
};
const ABDOMEN_MAN: Outline<'static> = Outline {
    first: [-12.0, 0.0],
    rows: &[
        [-4.0, 88.0, 132.0, 0.0, 0.1],
        [40.0, 98.0, 144.0, 0.0, 0.1],
        [95.0, 106.0, 151.0, 0.0, 0.1],
        [150.0, 110.0, 158.0, 0.0, 0.1],
        [195.0, 107.0, 158.0, 0.0, 0.1],
        [222.0, 98.0, 148.0, 0.0, 0.1],
    ],
    last: [232.0, 0.0],
};
const ABDOMEN_WOMAN: Outline<'static> = Outline {
    first: [-10.0, 0.0],
    rows: &[
        [-3.0, 86.0, 124.0, 0.0, 0.1],
        [45.0, 92.0, 126.0, 0.0, 0.1],
        [105.0, 94.0, 124.0, 0.0, 0.1],
        [160.0, 96.0, 130.0, 0.0, 0.1],
        [208.0, 88.0, 124.0, 0.0, 0.1],
    ],
    last: [218.0, 0.0],
};
const CHEST_MAN: Outline<'static> = Outline {
    first: [-6.0, 0.0],
    rows: &[
        [2.0, 98.0, 150.0, 0.0, 0.1],
        [45.0, 109.0, 166.0, 0.0, 0.15],
        [90.0, 115.0, 180.0, 0.0, 0.2],
        [130.0, 111.0, 190.0, -3.0, 0.2],
        [162.0, 98.0, 184.0, -6.0, 0.15],
        [188.0, 74.0, 126.0, -8.0, 0.05],
        [206.0, 56.0, 66.0, -8.0, 0.0],
    ],
    last: [216.0, -8.0],
};
const CHEST_WOMAN: Outline<'static> = Outline {
    first: [-6.0, 0.0],
    rows: &[
        [2.0, 88.0, 130.0, 0.0, 0.1],
        [40.0, 97.0, 140.0, 4.0, 0.15],
        [76.0, 110.0, 150.0, 9.0, 0.2],
        [112.0, 104.0, 162.0, 3.0, 0.2],
        [146.0, 88.0, 160.0, -4.0, 0.15],
        [176.0, 68.0, 110.0, -7.0, 0.05],
        [208.0, 48.0, 52.0, -8.0, 0.0],
    ],
    last: [234.0, -8.0],
};
const HEAD: Outline<'static> = Outline {
    first: [-16.0, 4.0],
    rows: &[
        [-6.0, 58.0, 58.0, 4.0, 0.0],
        [40.0, 56.0, 54.0, 9.0, 0.0],
        [64.0, 68.0, 55.0, 20.0, 0.0],
        [82.0, 84.0, 61.0, 28.0, 0.05],
        [120.0, 96.0, 72.0, 23.0, 0.0],
        [165.0, 100.0, 77.0, 17.0, 0.0],
        [205.0, 88.0, 69.0, 14.0, 0.0],
        [231.0, 56.0, 45.0, 12.0, 0.0],
    ],
    last: [242.9, 11.0],
};
const THIGH: Outline<'static> = Outline {
    first: [0.175, -4.0],
    rows: &[
        [0.14, 48.0, 40.0, -4.0, 0.0],
        [0.06, 80.0, 68.0, -5.0, 0.0],
        [-0.05, 89.0, 80.0, -5.0, 0.0],
        [-0.3, 87.0, 82.0, -2.0, 0.0],
        [-0.62, 73.0, 70.0, 2.0, 0.0],
        [-0.93, 58.0, 55.0, 2.0, 0.0],
        [-1.03, 45.0, 43.0, 2.0, 0.0],
    ],
    last: [-1.065, 2.0],
};
const SHANK: Outline<'static> = Outline {
    first: [0.055, 4.0],
    rows: &[
        [0.035, 38.0, 37.0, 4.0, 0.0],
        [-0.02, 56.0, 53.0, 2.0, 0.0],
        [-0.15, 55.0, 51.0, -4.0, 0.0],
        [-0.34, 60.0, 55.0, -9.0, 0.0],
        [-0.55, 51.0, 47.0, -7.0, 0.0],
        [-0.8, 38.0, 35.0, -2.0, 0.0],
        [-0.99, 37.0, 33.0, 0.0, 0.0],
    ],
    last: [-1.04, 0.0],
};
const UPPER_ARM: Outline<'static> = Outline {
    first: [0.085, 0.0],
    rows: &[
        [0.06, 24.0, 22.0, 0.0, 0.0],
        [0.0, 42.0, 38.0, 0.0, 0.0],
        [-0.2, 48.0, 43.0, 0.0, 0.0],
        [-0.55, 51.0, 46.0, 0.0, 0.0],
        [-0.93, 45.0, 42.0, 0.0, 0.0],
        [-1.02, 32.0, 30.0, 0.0, 0.0],
    ],
    last: [-1.05, 0.0],
};
const FOREARM: Outline<'static> = Outline {
    first: [0.08, -2.0],
    rows: &[
        [0.05, 26.0, 26.0, -2.0, 0.0],
        [-0.04, 40.0, 38.0, -1.0, 0.0],
        [-0.26, 45.0, 41.0, 0.0, 0.0],
        [-0.56, 39.0, 34.0, 0.0, 0.0],
        [-0.98, 30.0, 22.0, 0.0, 0.1],
        [-1.03, 21.0, 15.0, 0.0, 0.0],
    ],
    last: [-1.05, 0.0],
};
const HAND: Outline<'static> = Outline {
    first: [0.06, 0.0],
    rows: &[
        [0.02, 20.0, 14.0, 0.0, 0.0],
        [-0.06, 32.0, 21.0, 0.0, 0.1],
        [-0.25, 43.0, 21.0, 0.0, 0.15],
        [-0.48, 45.0, 17.0, 0.0, 0.2],
        [-0.74, 35.0, 11.0, 0.0, 0.2],
        [-0.94, 20.0, 7.0, 0.0, 0.1],
    ],
    last: [-1.0, 0.0],
};

/// Density of each part, including bone and air, kg/m³ (after the cadaver means of Dempster 1955 and Clauser 1969,
/// rounded), and the bounds on its girth relative to the average adult.
#[derive(Clone, Copy)]
pub(super) struct Fill {
    pub density: f64,
    pub girth: [f64; 2],
}

const fn fill(density: f64, low: f64, high: f64) -> Fill {
    Fill {
        density,
        girth: [low, high],
    }
}

/// Bounds that only keep the number finite and positive.
const FREE: [f64; 2] = [0.2, 5.0];

pub(super) const FILL_PELVIS: Fill = fill(1030.0, FREE[0], FREE[1]);
pub(super) const FILL_ABDOMEN: Fill = fill(1010.0, FREE[0], FREE[1]);
pub(super) const FILL_CHEST: Fill = fill(920.0, FREE[0], FREE[1]);
pub(super) const FILL_HEAD: Fill = fill(1090.0, 0.9, 1.12);
pub(super) const FILL_UPPER_ARM: Fill = fill(1060.0, FREE[0], FREE[1]);
pub(super) const FILL_FOREARM: Fill = fill(1100.0, FREE[0], FREE[1]);
pub(super) const FILL_HAND: Fill = fill(1130.0, 0.8, 1.15);
pub(super) const FILL_THIGH: Fill = fill(1050.0, FREE[0], FREE[1]);
pub(super) const FILL_SHANK: Fill = fill(1080.0, FREE[0], FREE[1]);
pub(super) const FILL_FOOT: Fill = fill(1090.0, 0.85, 1.15);

const MM: f64 = 1e-3;
const TRUNK_SIDES: usize = 16;
const LIMB_SIDES: usize = 12;
const HAND_SIDES: usize = 8;
/// Multiples of 8, so that the corners of a flat sole are vertices.
const FOOT_SIDES: usize = 16;
const TOE_SIDES: usize = 8;

/// Surface of an outline: z in units of `length` (m), cross-sections in mm × `width`, shifts of the centre in mm ×
/// `shift`.
fn surface(o: &Outline<'_>, length: f64, width: f64, shift: f64, sides: usize) -> Mesh {
    let sections: Vec<Section> = o
        .rows
        .iter()
        .map(|r| Section {
            centre: vec3(r[3] * MM * shift, 0.0, r[0] * length),
            u: vec3(r[1] * MM * width, 0.0, 0.0),
            v: vec3(0.0, r[2] * MM * width, 0.0),
            square: [r[4], r[4]],
        })
        .collect();
    let pole = |p: [f64; 2]| vec3(p[1] * MM * shift, 0.0, p[0] * length);
    loft(&sections, [pole(o.first), pole(o.last)], sides)
}

/// Girth for which `mesh_of(girth)` filled at the stated density weighs `mass`; volume goes with its square.
fn girth(fill: Fill, mass: f64, mesh_of: &dyn Fn(f64) -> Mesh) -> f64 {
    let g = (mass / (fill.density * volume(&mesh_of(1.0)))).sqrt();
    g.clamp(fill.girth[0], fill.girth[1])
}

/// Sizes from which a part of the trunk is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrunkSize {
    /// 1 draws the man's outline and 0 the woman's; values in between draw a growing body.
    pub male: f64,
    /// Stature over the reference stature of the man and of the woman.
    pub scale: [f64; 2],
    /// Length of the part in the outlines of the man and of the woman, mm.
    pub drawn: [f64; 2],
    /// Its length in this body, m.
    pub length: f64,
}

pub(super) fn pelvis(size: TrunkSize, mass: f64) -> Mesh {
    trunk(size, [&PELVIS_MAN, &PELVIS_WOMAN], FILL_PELVIS, mass)
}
pub(super) fn abdomen(size: TrunkSize, mass: f64) -> Mesh {
    trunk(size, [&ABDOMEN_MAN, &ABDOMEN_WOMAN], FILL_ABDOMEN, mass)
}
pub(super) fn chest(size: TrunkSize, mass: f64) -> Mesh {
    trunk(size, [&CHEST_MAN, &CHEST_WOMAN], FILL_CHEST, mass)
}

fn trunk(size: TrunkSize, outlines: [&Outline<'_>; 2], fill: Fill, mass: f64) -> Mesh {
    for (k, whole) in [(0, size.male >= 1.0), (1, size.male <= 0.0)] {
        if whole {
            let w = size.scale[k];
            let stretch = size.length / (MM * w * size.drawn[k]);
            // An adult's part already has the drawn length, to rounding, so draw it exactly.
            let z = if (stretch - 1.0).abs() < 1e-12 {
                MM * w
            } else {
                MM * w * stretch
            };
            let mesh_of = |g: f64| surface(outlines[k], z, g * w, w, TRUNK_SIDES);
            return mesh_of(girth(fill, mass, &mesh_of));
        }
    }
    // Sample both outlines at the heights of all rows of either, as shares of their heights, and then mix them.
    let share = |o: &Outline<'_>, z: f64| (z - o.first[0]) / (o.last[0] - o.first[0]);
    let mut at: Vec<f64> = outlines
        .iter()
        .flat_map(|o| o.rows.iter().map(|r| share(o, r[0])))
        .collect();
    at.sort_by(f64::total_cmp);
    at.dedup_by(|a, b| *a - *b < LEAST_SPACING);
    let mix = |v: [f64; 2]| v[1] + size.male * (v[0] - v[1]);
    // z as a share of the part's length, lengths across in mm of the body that is drawn.
    let z = |k: usize, z: f64| z / size.drawn[k];
    let pole = |of: fn(&Outline<'_>) -> [f64; 2]| {
        let p = [0, 1].map(|k| of(outlines[k]));
        [
            mix([z(0, p[0][0]), z(1, p[1][0])]),
            mix([p[0][1] * size.scale[0], p[1][1] * size.scale[1]]),
        ]
    };
    let rows: Vec<Row> = at
        .iter()
        .map(|t| {
            let both: [Row; 2] = [0, 1].map(|k| {
                let o = outlines[k];
                let height = o.first[0] + t * (o.last[0] - o.first[0]);
                let [_, depth, width, centre, square] = row_at(o.rows, height);
                let w = size.scale[k];
                [z(k, height), depth * w, width * w, centre * w, square]
            });
            std::array::from_fn(|i| mix([both[0][i], both[1][i]]))
        })
        .collect();
    let mixed = Outline {
        first: pole(|o| o.first),
        rows: &rows,
        last: pole(|o| o.last),
    };
    let mesh_of = |g: f64| surface(&mixed, size.length, g, 1.0, TRUNK_SIDES);
    mesh_of(girth(fill, mass, &mesh_of))
}

/// Rows of a mixed outline closer than this share of its height become one.
const LEAST_SPACING: f64 = 0.06;

/// The cross-section of an outline at height `z`, mm; that of the nearest row beyond its ends.
fn row_at(rows: &[Row], z: f64) -> Row {
    let above = rows.partition_point(|r| r[0] < z);
    if above == 0 || above == rows.len() {
        return rows[above.min(rows.len() - 1)];
    }
    let (a, b) = (&rows[above - 1], &rows[above]);
    let t = (z - a[0]) / (b[0] - a[0]);
    std::array::from_fn(|k| a[k] + t * (b[k] - a[k]))
}

/// Head and neck, from the neck joint to the vertex at `length` (m), with a nose that shows which way the figure is
/// looking.
pub(super) fn head(scale: f64, length: f64, mass: f64) -> Mesh {
    let stretch = length / (HEAD.last[0] * MM);
    let mesh_of = |g: f64| {
        let mut mesh = surface(&HEAD, MM * stretch, g * scale, scale, TRUNK_SIDES);
        let at = |z: f64, half_x: f64, half_y: f64, x: f64| Section {
            centre: vec3((23.0 + (x - 23.0) * g) * MM * scale, 0.0, z * MM * stretch),
            u: vec3(half_x * MM * scale * g, 0.0, 0.0),
            v: vec3(0.0, half_y * MM * scale * g, 0.0),
            square: [0.0, 0.0],
        };
        let (top, tip) = (at(142.0, 7.0, 6.0, 115.0), at(114.0, 17.0, 13.0, 119.0));
        let poles = [
            vec3(top.centre.x, 0.0, 152.0 * MM * stretch),
            vec3(tip.centre.x, 0.0, 107.0 * MM * stretch),
        ];
        append(&mut mesh, &loft(&[top, tip], poles, HAND_SIDES));
        mesh
    };
    mesh_of(girth(FILL_HEAD, mass, &mesh_of))
}

fn limb(o: &Outline<'_>, fill: Fill, scale: f64, length: f64, mass: f64) -> Mesh {
    let mesh_of = |g: f64| surface(o, length, g * scale, scale, LIMB_SIDES);
    mesh_of(girth(fill, mass, &mesh_of))
}
pub(super) fn thigh(scale: f64, length: f64, mass: f64) -> Mesh {
    limb(&THIGH, FILL_THIGH, scale, length, mass)
}
pub(super) fn shank(scale: f64, length: f64, mass: f64) -> Mesh {
    limb(&SHANK, FILL_SHANK, scale, length, mass)
}
pub(super) fn upper_arm(scale: f64, length: f64, mass: f64) -> Mesh {
    limb(&UPPER_ARM, FILL_UPPER_ARM, scale, length, mass)
}
pub(super) fn forearm(scale: f64, length: f64, mass: f64) -> Mesh {
    limb(&FOREARM, FILL_FOREARM, scale, length, mass)
}

/// Left hand with a thumb, palm towards −y; `length` is wrist to fingertip.
pub(super) fn hand(scale: f64, length: f64, mass: f64) -> Mesh {
    let mesh_of = |g: f64| {
        let w = g * scale * MM;
        let mut mesh = surface(&HAND, length, g * scale, scale, HAND_SIDES);
        let at = |x: f64, y: f64, z: f64, half_x: f64, half_y: f64| Section {
            centre: vec3(x * w, y * w, z * length),
            u: vec3(half_x * w, 0.0, 0.0),
            v: vec3(0.0, half_y * w, 0.0),
            square: [0.0, 0.0],
        };
        let thumb = [
            at(27.0, -3.0, -0.14, 15.0, 14.0),
            at(46.0, -6.0, -0.3, 13.0, 12.0),
            at(57.0, -9.0, -0.46, 9.0, 9.0),
        ];
        let poles = [
            vec3(16.0 * w, 0.0, -0.06 * length),
            vec3(60.0 * w, -10.0 * w, -0.52 * length),
        ];
        append(&mut mesh, &loft(&thumb, poles, HAND_SIDES));
        mesh
    };
    mesh_of(girth(FILL_HAND, mass, &mesh_of))
}

/// Sizes of a foot, m: ankle centre over the sole and in front of the heel, MTP joint in front of the ankle and over
/// the sole, toes.
#[derive(Clone, Copy, Debug)]
pub(super) struct FootSize {
    pub ankle_height: f64,
    pub heel: f64,
    pub ball: f64,
    pub ball_height: f64,
    pub toes: f64,
}

/// Half widths of the reference foot, mm.
const HEEL_HALF: f64 = 29.0;
const BALL_HALF: f64 = 47.0;
const TIP_HALF: f64 = 34.0;
/// Where the rear corners of the sole are (share of the heel length) and the front corners (share of the toe length).
const HEEL_CORNER: f64 = 0.9;
const TIP_CORNER: f64 = 0.88;

/// Cross-section of a foot at `x` between the sole and `top`, flat below and round above.
fn foot_section(x: f64, half: f64, sole: f64, top: f64) -> Section {
    let half_height = 0.5 * (top - sole);
    Section {
        centre: vec3(x, 0.0, sole + half_height),
        u: vec3(0.0, half, 0.0),
        v: vec3(0.0, 0.0, half_height),
        square: [0.1, 1.0],
    }
}

/// Foot without toes, and the two corners of its heel, ±y. The ball of the foot belongs to the toes, so that the foot
/// rolls over the toe joint without scraping the planted part. `mass` is that of foot and toes together.
pub(super) fn foot(scale: f64, size: FootSize, mass: f64) -> (Mesh, [Vec3; 2]) {
    let w = scale * MM * foot_girth(scale, size, mass);
    let (h, ball, sole) = (size.heel, size.ball, -size.ankle_height);
    let up = |share: f64| sole + share * size.ankle_height;
    let heel_x = -HEEL_CORNER * h;
    let sections = [
        foot_section(heel_x, HEEL_HALF * w, sole, up(0.62)),
        foot_section(-0.55 * h, 33.0 * w, sole, up(0.9)),
        foot_section(0.0, 36.0 * w, sole, up(1.22)),
        foot_section(0.3 * ball, 38.0 * w, sole, up(1.05)),
        foot_section(0.65 * ball, 44.0 * w, sole, up(0.68)),
        foot_section(ball, BALL_HALF * w, sole, up(0.45)),
    ];
    let poles = [
        vec3(-h, 0.0, up(0.35)),
        vec3(ball + 0.08 * size.toes, 0.0, up(0.2)),
    ];
    let corners = [
        vec3(heel_x, HEEL_HALF * w, sole),
        vec3(heel_x, -HEEL_HALF * w, sole),
    ];
    (loft(&sections, poles, FOOT_SIDES), corners)
}

/// Toes as one part, and their four sole corners: ball ±y under the toe joint, tip ±y.
pub(super) fn toes(scale: f64, size: FootSize, foot_mass: f64) -> (Mesh, [Vec3; 4]) {
    let w = scale * MM * foot_girth(scale, size, foot_mass);
    let (l, sole) = (size.toes, -size.ball_height);
    let tip_x = TIP_CORNER * l;
    let up = |share: f64| sole + share * size.ball_height;
    let sections = [
        foot_section(0.0, BALL_HALF * w, sole, up(1.6)),
        foot_section(0.3 * l, 47.0 * w, sole, up(1.35)),
        foot_section(0.65 * l, 43.0 * w, sole, up(1.15)),
        foot_section(tip_x, TIP_HALF * w, sole, up(0.9)),
    ];
    let poles = [vec3(-0.16 * l, 0.0, up(0.7)), vec3(l, 0.0, up(0.4))];
    let corners = [
        vec3(0.0, BALL_HALF * w, sole),
        vec3(0.0, -BALL_HALF * w, sole),
        vec3(tip_x, TIP_HALF * w, sole),
        vec3(tip_x, -TIP_HALF * w, sole),
    ];
    (loft(&sections, poles, TOE_SIDES), corners)
}

/// Width factor common to foot and toes, so that they join; heights follow the skeleton.
fn foot_girth(scale: f64, size: FootSize, mass: f64) -> f64 {
    let length = size.heel + size.ball + size.toes;
    let volume = FOOT_FILL * length * size.ankle_height * (2.0 * BALL_HALF * MM * scale);
    (mass / (FILL_FOOT.density * volume)).clamp(FILL_FOOT.girth[0], FILL_FOOT.girth[1])
}

/// Volume of foot and toes over that of the box around them.
const FOOT_FILL: f64 = 0.47;

/// Surface points of `mesh` that lie farthest along each of `directions`, without repeats.
pub(super) fn extremes(mesh: &Mesh, directions: &[[f64; 3]]) -> Vec<Vec3> {
    let mut out: Vec<Vec3> = Vec::with_capacity(directions.len());
    for d in directions {
        let p = extreme(mesh, Vec3::from_array(*d));
        if !out.contains(&p) {
            out.push(p);
        }
    }
    out
}
