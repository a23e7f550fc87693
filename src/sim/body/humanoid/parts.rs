//! The segments of one body. Each has a surface of the right size and mass, and the points that can touch the floor.

use super::super::age::Proportions;
use super::super::geometry::{mass_properties, mirrored};
use super::super::model::{Mesh, Profile, Segment};
use super::super::shape::{self, FootSize, TrunkSize, extremes};
use super::tables::{MAN, Table, WOMAN};
use crate::math::Vec3;
use crate::math::vec3::vec3;

/// Heel to ankle centre over foot length.
pub(super) const HEEL_SHARE: f64 = 0.213;
/// Heel to MTP joint over foot length.
const BALL_SHARE: f64 = 0.72;
/// Share of the foot's mass in front of that joint.
const TOES_MASS_SHARE: f64 = 0.14;
/// MTP centre over the sole, mm.
const BALL_HEIGHT: f64 = 20.0;
/// Neck joint behind the middle of the trunk, mm.
const NECK_BACK: f64 = 10.0;

/// Lengths (m) and masses (kg) of one body.
pub(super) struct Dimensions {
    stature: f64,
    /// Share of the man in the surfaces of the trunk, 0 to 1.
    male: f64,
    /// Stature over that of the tables.
    scale: f64,
    /// Width of the head over an adult's.
    head_width: f64,
    /// Lower, middle and upper trunk.
    trunk: [f64; 3],
    /// Neck joint over the chest's.
    neck: f64,
    head: f64,
    upper_arm: f64,
    forearm: f64,
    hand: f64,
    thigh: f64,
    shank: f64,
    foot: FootSize,
    /// Shoulder centre in the chest, left.
    pub(super) shoulder: Vec3,
    /// Hip centre in the pelvis, left.
    pub(super) hip: Vec3,
    /// Pelvis, abdomen, chest, head, upper arm, forearm, hand, thigh, shank, foot with toes.
    mass: [f64; 10],
}

impl Dimensions {
    /// Dimensions of a person of this profile; `male` and `adult` are as in [`Table::adult`].
    pub(super) fn new(profile: &Profile, male: f64, adult: &Table) -> Self {
        let growth = Proportions::at(profile.age);
        let table = adult.grown_to(growth);
        let scale = profile.height / (table.stature * 1e-3);
        let m = |mm: f64| mm * 1e-3 * scale;
        let [lower_trunk, middle_trunk, upper_trunk] = table.trunk.map(m);
        let neck = upper_trunk + m(table.neck);
        let (thigh, shank, foot) = (m(table.thigh), m(table.shank), m(table.foot));
        let ankle_height = m(table.ankle_height);
        let [below, aside] = table.shoulder.map(m);
        // The printed fractions add to 100 % within rounding; sides count twice.
        let sum = table.mass.sum();
        Self {
            stature: profile.height,
            male,
            scale,
            head_width: growth.head_width,
            trunk: [lower_trunk, middle_trunk, upper_trunk],
            neck,
            head: profile.height
                - (ankle_height + shank + thigh + lower_trunk + middle_trunk + neck),
            upper_arm: m(table.upper_arm),
            forearm: m(table.forearm),
            hand: m(table.hand),
            thigh,
            shank,
            foot: FootSize {
                ankle_height,
                heel: HEEL_SHARE * foot,
                ball: (BALL_SHARE - HEEL_SHARE) * foot,
                ball_height: m(BALL_HEIGHT),
                toes: (1.0 - BALL_SHARE) * foot,
            },
            shoulder: vec3(0.0, aside, upper_trunk - below),
            hip: vec3(0.0, m(table.hip), 0.0),
            mass: table
                .mass
                .percent
                .map(|percent| percent / sum * profile.mass),
        }
    }

    fn trunk_size(&self, part: usize) -> TrunkSize {
        TrunkSize {
            male: self.male,
            scale: [&MAN, &WOMAN].map(|t| self.stature / (t.stature * 1e-3)),
            drawn: [&MAN, &WOMAN].map(|t| t.trunk[part]),
            length: self.trunk[part],
        }
    }

    /// Pelvis, abdomen, chest and head.
    pub(super) fn trunk_and_head(&self) -> [Segment; 4] {
        let part = |mesh: Mesh, k: usize, points: &[[f64; 3]], tip: Vec3| {
            let points = extremes(&mesh, points);
            symmetric(segment(mesh, self.mass[k], points, tip))
        };
        let [lower, middle, _] = self.trunk;
        let pelvis = shape::pelvis(self.trunk_size(0), self.mass[0]);
        let abdomen = shape::abdomen(self.trunk_size(1), self.mass[1]);
        let chest = shape::chest(self.trunk_size(2), self.mass[2]);
        let neck = vec3(-NECK_BACK * 1e-3 * self.scale, 0.0, self.neck);
        let head = shape::head(self.scale * self.head_width, self.head, self.mass[3]);
        let vertex = extremes(&head, &HEAD)[0];
        [
            part(pelvis, 0, &PELVIS, vec3(0.0, 0.0, lower)),
            part(abdomen, 1, &ABDOMEN, vec3(0.0, 0.0, middle)),
            part(chest, 2, &CHEST, neck),
            part(head, 3, &HEAD, vertex),
        ]
    }

    /// Upper arm, forearm and hand of the left side.
    pub(super) fn arm(&self) -> [Segment; 3] {
        let upper_arm = shape::upper_arm(self.scale, self.upper_arm, self.mass[4]);
        let forearm = shape::forearm(self.scale, self.forearm, self.mass[5]);
        let hand = shape::hand(self.scale, self.hand, self.mass[6]);
        [
            self.limb(upper_arm, 4, &UPPER_ARM, self.upper_arm),
            self.limb(forearm, 5, &FOREARM, self.forearm),
            self.limb(hand, 6, &HAND, self.hand),
        ]
    }

    /// Thigh, shank, foot and toes of the left side.
    pub(super) fn leg(&self) -> [Segment; 4] {
        let thigh = shape::thigh(self.scale, self.thigh, self.mass[7]);
        let shank = shape::shank(self.scale, self.shank, self.mass[8]);
        let (size, mass) = (self.foot, self.mass[9]);
        let (foot, foot_corners) = shape::foot(self.scale, size, mass);
        let (toes, toe_corners) = shape::toes(self.scale, size, mass);
        let toe_joint = vec3(size.ball, 0.0, size.ball_height - size.ankle_height);
        let toe_tip = vec3(size.toes, 0.0, toe_corners[2].z);
        [
            self.limb(thigh, 7, &THIGH, self.thigh),
            self.limb(shank, 8, &SHANK, self.shank),
            segment(
                foot,
                mass * (1.0 - TOES_MASS_SHARE),
                foot_corners.to_vec(),
                toe_joint,
            ),
            segment(toes, mass * TOES_MASS_SHARE, toe_corners.to_vec(), toe_tip),
        ]
    }

    fn limb(&self, mesh: Mesh, k: usize, points: &[[f64; 3]], length: f64) -> Segment {
        let points = extremes(&mesh, points);
        segment(mesh, self.mass[k], points, vec3(0.0, 0.0, -length))
    }
}

// Directions towards the outermost points that can touch something, in half widths, depths and lengths.
const PELVIS: [[f64; 3]; 6] = [
    [-0.55, 0.5, -1.0], // sit points
    [-0.55, -0.5, -1.0],
    [-1.0, 0.0, 0.1],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
];
const ABDOMEN: [[f64; 3]; 4] = [
    [-1.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
];
const CHEST: [[f64; 3]; 6] = [
    [-1.0, 0.5, 0.3], // shoulder blades
    [-1.0, -0.5, 0.3],
    [1.0, 0.35, 0.0],
    [1.0, -0.35, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
];
const HEAD: [[f64; 3]; 6] = [
    [0.0, 0.0, 1.0], // vertex
    [-1.0, 0.0, 0.2],
    [1.0, 0.0, 0.0],
    [0.7, 0.0, 0.8],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
];
const UPPER_ARM: [[f64; 3]; 4] = [
    [0.0, 1.0, 0.6], // shoulder
    [-1.0, 0.2, 0.4],
    [1.0, 0.2, 0.4],
    [0.0, 1.0, -0.1],
];
const FOREARM: [[f64; 3]; 4] = [
    [-0.9, 0.0, 1.0], // elbow
    [0.0, 1.0, 0.1],
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, -0.5],
];
const HAND: [[f64; 3]; 5] = [
    [0.0, 0.0, -1.0], // finger tip
    [0.0, -1.0, -0.1],
    [0.0, 1.0, -0.1], // knuckles
    [1.0, 0.0, -0.2],
    [-1.0, 0.0, -0.1],
];
const THIGH: [[f64; 3]; 4] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.1], // trochanter
    [0.3, -1.0, -0.3],
];
const SHANK: [[f64; 3]; 5] = [
    [1.0, 0.0, 0.4], // knee cap
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 1.0, -0.3], // outer ankle
];

/// A segment from its surface: mass properties of the filled mesh.
fn segment(mesh: Mesh, mass: f64, contact_points: Vec<Vec3>, tip: Vec3) -> Segment {
    let p =
        mass_properties(&mesh, mass).expect("lofts of positive size are closed and face outwards");
    Segment {
        mass,
        com: p.com,
        inertia: p.inertia,
        mesh,
        contact_points,
        tip,
    }
}

/// A segment that is symmetric in y: the rounding of the sums is removed.
fn symmetric(mut s: Segment) -> Segment {
    s.com.y = 0.0;
    s.inertia.xy = 0.0;
    s.inertia.yz = 0.0;
    s
}

/// The same point of the other side.
pub(super) fn mirror_point(p: Vec3) -> Vec3 {
    vec3(p.x, -p.y, p.z)
}

/// The same segment of the other side.
pub(super) fn mirror(s: &Segment) -> Segment {
    let mut out = s.clone();
    out.com = mirror_point(s.com);
    out.inertia.xy = -s.inertia.xy;
    out.inertia.yz = -s.inertia.yz;
    out.mesh = mirrored(&s.mesh);
    out.contact_points = s.contact_points.iter().map(|p| mirror_point(*p)).collect();
    out.tip = mirror_point(s.tip);
    out
}
