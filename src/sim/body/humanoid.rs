//! Bodies of men, women and children from stature, mass, sex and age.
//!
//! Lengths and mass fractions are those of de Leva 1996 (adjusted Zatsiorsky–Seluyanov means), scaled by stature and changed with age as
//! [`super::age`] says; centre of mass
//! and inertia come from the surface of each segment (paper §3.1, [`super::geometry`]), drawn in [`super::shape`]. The right side is
//! the mirror image of the left to the last bit.

use super::age::{
    ARM_CHANGE, LEG_CHANGE, LimitChange, MassFractions, Proportions, height_range, male_share,
    mass_range, mix,
};
use super::geometry::{mass_properties, mirrored};
use super::model::{Body, BodyError, Mesh, Profile, Segment, Sex};
use super::shape::{self, FootSize, TrunkSize, extremes};
use super::topology::{self as t, DOF_COUNT, SEGMENT_COUNT};
use crate::sim::math::Vec3;
use crate::sim::math::vec3::vec3;

/// Reflected inertia on every joint DOF, kg·m²: keeps toes and wrists at their torque limit from accelerating at 10⁴ rad/s² (ALGORITHM §2).
pub const ARMATURE: f64 = 0.02;

pub use super::age::AGE_RANGE;
/// Statures accepted for adults, m; see [`height_range`] for children.
pub const HEIGHT_RANGE: [f64; 2] = [1.4, 2.1];
/// Body masses accepted for adults, kg; see [`mass_range`] for children.
pub const MASS_RANGE: [f64; 2] = [35.0, 180.0];

/// Lengths (mm) and mass fractions (%) at the reference stature.
#[derive(Clone, Copy)]
struct Table {
    /// Stature of the sample, mm.
    stature: f64,
    /// Mid-hip to omphalion, omphalion to xiphion, xiphion to suprasternale.
    trunk: [f64; 3],
    /// Neck joint (height of the cervicale) over the suprasternale; the rest of the stature is head and neck.
    neck: f64,
    upper_arm: f64,
    forearm: f64,
    /// Wrist to third fingertip.
    hand: f64,
    thigh: f64,
    shank: f64,
    foot: f64,
    /// Ankle centre over the sole.
    ankle_height: f64,
    /// Shoulder centre: below the suprasternale, and to the side.
    shoulder: [f64; 2],
    /// Hip centre to the side.
    hip: f64,
    mass: MassFractions,
}

/// Trunk, limb lengths and masses: de Leva 1996. Neck and ankle heights close the stature; shoulder and hip widths are ours.
const MAN: Table = Table {
    stature: 1741.0,
    trunk: [145.7, 215.5, 170.7],
    neck: 25.2,
    upper_arm: 281.7,
    forearm: 268.9,
    hand: 187.9,
    thigh: 422.2,
    shank: 440.3,
    foot: 258.1,
    ankle_height: 78.5,
    shoulder: [40.0, 185.0],
    hip: 88.0,
    mass: MassFractions {
        row: "man (de Leva 1996)",
        percent: [
            11.17, 16.33, 15.96, 6.94, 2.71, 1.62, 0.61, 14.16, 4.33, 1.37,
        ],
    },
};
const WOMAN: Table = Table {
    stature: 1735.0,
    trunk: [181.5, 205.3, 142.5],
    neck: 82.9,
    upper_arm: 275.1,
    forearm: 264.3,
    hand: 170.1,
    thigh: 368.5,
    shank: 438.6,
    foot: 228.3,
    ankle_height: 72.0,
    shoulder: [31.0, 168.0],
    hip: 86.0,
    mass: MassFractions {
        row: "woman (de Leva 1996)",
        percent: [
            12.47, 14.65, 15.45, 6.68, 2.55, 1.38, 0.56, 14.78, 4.81, 1.29,
        ],
    },
};

impl Table {
    /// The adult's table at `male` = 1 or 0; between them lengths as shares of the stature are mixed.
    fn adult(male: f64) -> Self {
        if male >= 1.0 {
            return MAN;
        }
        if male <= 0.0 {
            return WOMAN;
        }
        let stature = mix(male, MAN.stature, WOMAN.stature);
        let m = |a: f64, b: f64| stature * mix(male, a / MAN.stature, b / WOMAN.stature);
        let m3 = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| m(a[i], b[i]));
        let (a, b) = (&MAN, &WOMAN);
        Self {
            stature,
            trunk: m3(a.trunk, b.trunk),
            neck: m(a.neck, b.neck),
            upper_arm: m(a.upper_arm, b.upper_arm),
            forearm: m(a.forearm, b.forearm),
            hand: m(a.hand, b.hand),
            thigh: m(a.thigh, b.thigh),
            shank: m(a.shank, b.shank),
            foot: m(a.foot, b.foot),
            ankle_height: m(a.ankle_height, b.ankle_height),
            shoulder: [
                m(a.shoulder[0], b.shoulder[0]),
                m(a.shoulder[1], b.shoulder[1]),
            ],
            hip: m(a.hip, b.hip),
            mass: MassFractions {
                row: "adult (de Leva 1996)",
                percent: std::array::from_fn(|i| mix(male, a.mass.percent[i], b.mass.percent[i])),
            },
        }
    }

    /// The table of a growing body.
    fn grown_to(self, p: Proportions) -> Self {
        Self {
            trunk: self.trunk.map(|l| l * p.trunk),
            neck: self.neck * p.trunk,
            upper_arm: self.upper_arm * p.arm,
            forearm: self.forearm * p.arm,
            hand: self.hand * p.arm,
            thigh: self.thigh * p.leg,
            shank: self.shank * p.leg,
            ankle_height: self.ankle_height * p.leg,
            foot: self.foot * p.foot,
            shoulder: [self.shoulder[0] * p.trunk, self.shoulder[1] * p.width],
            hip: self.hip * p.width,
            ..self
        }
    }
}

/// Heel to ankle centre over foot length, heel to MTP joint over foot length, and the share of the foot's mass in front of the latter.
const HEEL_SHARE: f64 = 0.213;
const BALL_SHARE: f64 = 0.72;
const TOES_MASS_SHARE: f64 = 0.14;
/// MTP centre over the sole, mm.
const BALL_HEIGHT: f64 = 20.0;
/// Neck joint behind the middle of the trunk, mm.
const NECK_BACK: f64 = 10.0;

/// Limits in degrees, DOF order: trunk and neck, arm, leg; the sides are equal because angles are anatomically signed.
///
/// After the goniometric tables (Boone & Azen, AAOS, Soucie 2011), with room for captured motion: spine motion of a whole trunk falls on
/// two joints here, and flexion and abduction are the components of one swing (`angles`), up to 172° together.
const TRUNK_LIMITS: [[f64; 2]; 9] = [
    [-25.0, 65.0],
    [-35.0, 35.0],
    [-40.0, 40.0],
    [-25.0, 45.0],
    [-30.0, 30.0],
    [-40.0, 40.0],
    [-60.0, 60.0],
    [-50.0, 50.0],
    [-80.0, 80.0],
];
const ARM_LIMITS: [[f64; 2]; 7] = [
    [-60.0, 172.0],
    [-40.0, 172.0],
    [-90.0, 90.0],
    [0.0, 150.0],
    [-90.0, 90.0],
    [-75.0, 80.0],
    [-40.0, 25.0],
];
const LEG_LIMITS: [[f64; 2]; 8] = [
    [-30.0, 125.0],
    [-35.0, 60.0],
    [-50.0, 50.0],
    [0.0, 150.0],
    [-55.0, 35.0],
    [-35.0, 35.0],
    [-30.0, 30.0],
    [-35.0, 65.0],
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

fn mirror_point(p: Vec3) -> Vec3 {
    vec3(p.x, -p.y, p.z)
}

fn mirror(s: &Segment) -> Segment {
    let mut out = s.clone();
    out.com = mirror_point(s.com);
    out.inertia.xy = -s.inertia.xy;
    out.inertia.yz = -s.inertia.yz;
    out.mesh = mirrored(&s.mesh);
    out.contact_points = s.contact_points.iter().map(|p| mirror_point(*p)).collect();
    out.tip = mirror_point(s.tip);
    out
}

fn within(field: &'static str, value: f64, range: [f64; 2]) -> Result<(), BodyError> {
    // Written so that NaN fails.
    if value >= range[0] && value <= range[1] {
        Ok(())
    } else {
        Err(BodyError::Profile {
            field,
            value,
            lower: range[0],
            upper: range[1],
        })
    }
}

impl Body {
    /// The body of a person of the given sex, age, stature and mass.
    ///
    /// Proportions of de Leva 1996 for the sex; children have shorter limbs, a larger head and Jensen's mass fractions, older people those
    /// of Pavol 2002, and ranges of motion follow age ([`super::age`]). Segment masses add to `profile.mass`; the top of the head
    /// is at `profile.height` over the soles in the zero pose. Builds surfaces: about a millisecond, allocates.
    ///
    /// # Errors
    /// [`BodyError::Profile`] naming `age_years` (6…90), `height_m` (adults 1.4…2.1) or `mass_kg` (adults 35…180; children by age); NaN
    /// counts as outside.
    pub fn humanoid(profile: Profile) -> Result<Self, BodyError> {
        Self::build(profile, None)
    }

    /// The same with mass fractions of one's own, for example measured ones.
    ///
    /// # Errors
    /// As [`Self::humanoid`], and [`BodyError::Fractions`] naming a row whose shares are not positive or do not add to 100 ± 1 %.
    pub fn with_mass_fractions(
        profile: Profile,
        fractions: &MassFractions,
    ) -> Result<Self, BodyError> {
        Self::build(profile, Some(fractions))
    }

    fn build(profile: Profile, fractions: Option<&MassFractions>) -> Result<Self, BodyError> {
        within("age_years", profile.age, AGE_RANGE)?;
        within("height_m", profile.height, height_range(profile.age))?;
        within("mass_kg", profile.mass, mass_range(profile.age))?;
        let male = male_share(profile.sex, profile.age);
        let mut table = Table::adult(male);
        table.mass = match fractions {
            Some(own) => *own,
            None => MassFractions::of(profile.sex, profile.age, &table.mass),
        };
        table.mass.check()?;
        let body = assemble(profile, male, &table);
        body.validate()?;
        Ok(body)
    }

    /// A boy of eight: 1.28 m, 26 kg. Up to ten years boys and girls are alike here.
    pub fn child() -> Self {
        Self::humanoid(Profile::ordinary(Sex::Male, 8.0)).expect("a child lies within the tables")
    }

    /// The average man: 30 years, 1.75 m, 75 kg.
    pub fn adult_man() -> Self {
        let profile = Profile {
            sex: Sex::Male,
            age: 30.0,
            height: 1.75,
            mass: 75.0,
        };
        Self::humanoid(profile).expect("the average man lies within the tables")
    }

    /// The average woman: 30 years, 1.63 m, 62 kg.
    pub fn adult_woman() -> Self {
        let profile = Profile {
            sex: Sex::Female,
            age: 30.0,
            height: 1.63,
            mass: 62.0,
        };
        Self::humanoid(profile).expect("the average woman lies within the tables")
    }
}

fn assemble(profile: Profile, male: f64, adult: &Table) -> Body {
    let growth = Proportions::at(profile.age);
    let table = &adult.grown_to(growth);
    let scale = profile.height / (table.stature * 1e-3);
    let m = |mm: f64| mm * 1e-3 * scale;
    // The printed fractions add to 100 % within rounding; sides count twice.
    let sum = table.mass.sum();
    let mass = table
        .mass
        .percent
        .map(|percent| percent / sum * profile.mass);
    let [lower_trunk, middle_trunk, upper_trunk] = table.trunk.map(m);
    let neck_z = upper_trunk + m(table.neck);
    let (thigh, shank, foot) = (m(table.thigh), m(table.shank), m(table.foot));
    let ankle_height = m(table.ankle_height);
    let head =
        profile.height - (ankle_height + shank + thigh + lower_trunk + middle_trunk + neck_z);
    let size = FootSize {
        ankle_height,
        heel: HEEL_SHARE * foot,
        ball: (BALL_SHARE - HEEL_SHARE) * foot,
        ball_height: m(BALL_HEIGHT),
        toes: (1.0 - BALL_SHARE) * foot,
    };
    let trunk = |part: usize| TrunkSize {
        male,
        scale: [&MAN, &WOMAN].map(|t| profile.height / (t.stature * 1e-3)),
        drawn: [&MAN, &WOMAN].map(|t| t.trunk[part]),
        length: [lower_trunk, middle_trunk, upper_trunk][part],
    };

    let pelvis = {
        let mesh = shape::pelvis(trunk(0), mass[0]);
        let points = extremes(
            &mesh,
            &[
                [-0.55, 0.5, -1.0], // sit points
                [-0.55, -0.5, -1.0],
                [-1.0, 0.0, 0.1],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, -1.0, 0.0],
            ],
        );
        symmetric(segment(mesh, mass[0], points, vec3(0.0, 0.0, lower_trunk)))
    };
    let abdomen = {
        let mesh = shape::abdomen(trunk(1), mass[1]);
        let points = extremes(&mesh, &AROUND);
        symmetric(segment(mesh, mass[1], points, vec3(0.0, 0.0, middle_trunk)))
    };
    let chest = {
        let mesh = shape::chest(trunk(2), mass[2]);
        let points = extremes(
            &mesh,
            &[
                [-1.0, 0.5, 0.3], // shoulder blades
                [-1.0, -0.5, 0.3],
                [1.0, 0.35, 0.0],
                [1.0, -0.35, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, -1.0, 0.0],
            ],
        );
        symmetric(segment(
            mesh,
            mass[2],
            points,
            vec3(-m(NECK_BACK), 0.0, neck_z),
        ))
    };
    let head = {
        let mesh = shape::head(scale * growth.head_width, head, mass[3]);
        let points = extremes(
            &mesh,
            &[
                [0.0, 0.0, 1.0],
                [-1.0, 0.0, 0.2],
                [1.0, 0.0, 0.0],
                [0.7, 0.0, 0.8],
                [0.0, 1.0, 0.0],
                [0.0, -1.0, 0.0],
            ],
        );
        let vertex = points[0];
        symmetric(segment(mesh, mass[3], points, vertex))
    };
    let upper_arm = {
        let (length, mesh) = (
            m(table.upper_arm),
            shape::upper_arm(scale, m(table.upper_arm), mass[4]),
        );
        let points = extremes(
            &mesh,
            &[
                [0.0, 1.0, 0.6], // shoulder
                [-1.0, 0.2, 0.4],
                [1.0, 0.2, 0.4],
                [0.0, 1.0, -0.1],
            ],
        );
        segment(mesh, mass[4], points, vec3(0.0, 0.0, -length))
    };
    let forearm = {
        let (length, mesh) = (
            m(table.forearm),
            shape::forearm(scale, m(table.forearm), mass[5]),
        );
        let points = extremes(
            &mesh,
            &[
                [-0.9, 0.0, 1.0], // elbow
                [0.0, 1.0, 0.1],
                [1.0, 0.0, 0.0],
                [-1.0, 0.0, -0.5],
            ],
        );
        segment(mesh, mass[5], points, vec3(0.0, 0.0, -length))
    };
    let hand = {
        let (length, mesh) = (m(table.hand), shape::hand(scale, m(table.hand), mass[6]));
        let points = extremes(
            &mesh,
            &[
                [0.0, 0.0, -1.0], // finger tip
                [0.0, -1.0, -0.1],
                [0.0, 1.0, -0.1], // knuckles
                [1.0, 0.0, -0.2],
                [-1.0, 0.0, -0.1],
            ],
        );
        segment(mesh, mass[6], points, vec3(0.0, 0.0, -length))
    };
    let thigh_segment = {
        let mesh = shape::thigh(scale, thigh, mass[7]);
        let points = extremes(
            &mesh,
            &[
                [1.0, 0.0, 0.0],
                [-1.0, 0.0, 0.0],
                [0.0, 1.0, 0.1], // trochanter
                [0.3, -1.0, -0.3],
            ],
        );
        segment(mesh, mass[7], points, vec3(0.0, 0.0, -thigh))
    };
    let shank_segment = {
        let mesh = shape::shank(scale, shank, mass[8]);
        let points = extremes(
            &mesh,
            &[
                [1.0, 0.0, 0.4], // knee cap
                [-1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, -1.0, 0.0],
                [0.0, 1.0, -0.3], // outer ankle
            ],
        );
        segment(mesh, mass[8], points, vec3(0.0, 0.0, -shank))
    };
    let toe_joint = vec3(size.ball, 0.0, size.ball_height - ankle_height);
    let foot_segment = {
        let (mesh, corners) = shape::foot(scale, size, mass[9]);
        segment(
            mesh,
            mass[9] * (1.0 - TOES_MASS_SHARE),
            corners.to_vec(),
            toe_joint,
        )
    };
    let toes_segment = {
        let (mesh, corners) = shape::toes(scale, size, mass[9]);
        let tip = vec3(size.toes, 0.0, corners[2].z);
        segment(mesh, mass[9] * TOES_MASS_SHARE, corners.to_vec(), tip)
    };

    let mut joint_offset = [Vec3::zero(); SEGMENT_COUNT];
    joint_offset[t::ABDOMEN.index()] = pelvis.tip;
    joint_offset[t::CHEST.index()] = abdomen.tip;
    joint_offset[t::HEAD.index()] = chest.tip;
    let [below, aside] = table.shoulder.map(m);
    let left_arm = [
        (t::L_UPPER_ARM, vec3(0.0, aside, upper_trunk - below)),
        (t::L_FOREARM, upper_arm.tip),
        (t::L_HAND, forearm.tip),
    ];
    let left_leg = [
        (t::L_THIGH, vec3(0.0, m(table.hip), 0.0)),
        (t::L_SHANK, thigh_segment.tip),
        (t::L_FOOT, shank_segment.tip),
        (t::L_TOES, toe_joint),
    ];
    for (id, offset) in left_arm {
        joint_offset[id.index()] = offset;
        joint_offset[id.index() + left_arm.len()] = mirror_point(offset);
    }
    for (id, offset) in left_leg {
        joint_offset[id.index()] = offset;
        joint_offset[id.index() + left_leg.len()] = mirror_point(offset);
    }
    let mut segments = vec![pelvis, abdomen, chest, head, upper_arm, forearm, hand];
    let right: Vec<Segment> = segments[4..].iter().map(mirror).collect();
    segments.extend(right);
    segments.extend([thigh_segment, shank_segment, foot_segment, toes_segment]);
    let right: Vec<Segment> = segments[10..].iter().map(mirror).collect();
    segments.extend(right);

    let limits: Vec<[f64; 2]> = TRUNK_LIMITS
        .iter()
        .chain(&ARM_LIMITS)
        .chain(&ARM_LIMITS)
        .chain(&LEG_LIMITS)
        .chain(&LEG_LIMITS)
        .map(|deg| deg.map(f64::to_radians))
        .collect();
    let limit = |d: usize, upper: bool| {
        let first = limits[d][usize::from(upper)];
        limit_changes(d)
            .filter(|c| c.upper == upper)
            .fold(first, |l, c| l + c.at(profile.age))
    };
    // Reflected inertia goes with the body, as strength does, while it grows.
    let size = profile.mass * profile.height * profile.height / REFERENCE_SIZE;
    let grown = super::age::smooth(AGE_RANGE[0], super::age::GROWN, profile.age);
    let armature = ARMATURE * mix(grown, 1.0, size.min(1.0));
    Body {
        profile,
        segments,
        joint_offset,
        lower: std::array::from_fn(|d| limit(d, false)),
        upper: std::array::from_fn(|d| limit(d, true)),
        armature: [armature; DOF_COUNT],
    }
}

/// Mass times stature squared of the reference man, kg·m².
const REFERENCE_SIZE: f64 = 75.0 * 1.75 * 1.75;

/// How the limits of DOF `d` change with age.
pub(super) fn limit_changes(d: usize) -> impl Iterator<Item = &'static LimitChange> {
    let (table, dof): (&'static [LimitChange], usize) = match d {
        0..9 => (&[], 0),
        9..23 => (&ARM_CHANGE, (d - 9) % 7),
        _ => (&LEG_CHANGE, (d - 23) % 8),
    };
    table.iter().filter(move |c| c.dof == dof)
}

/// Back, front, left, right.
const AROUND: [[f64; 3]; 4] = [
    [-1.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
];

#[cfg(test)]
mod tests;
