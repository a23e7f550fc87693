//! Lengths, mass fractions and ranges of motion from which bodies are built.

use super::super::age::{ARM_CHANGE, LEG_CHANGE, LimitChange, MassFractions, Proportions, mix};
use crate::body::topology::DOF_COUNT;

/// Lengths (mm) and mass fractions (%) at the reference stature.
#[derive(Clone, Copy)]
pub(super) struct Table {
    /// Stature of the sample, mm.
    pub(super) stature: f64,
    /// Mid-hip to omphalion, omphalion to xiphion, xiphion to suprasternale.
    pub(super) trunk: [f64; 3],
    /// Neck joint (height of the cervicale) over the suprasternale; the rest of the stature is head and neck.
    pub(super) neck: f64,
    pub(super) upper_arm: f64,
    pub(super) forearm: f64,
    /// Wrist to third fingertip.
    pub(super) hand: f64,
    pub(super) thigh: f64,
    pub(super) shank: f64,
    pub(super) foot: f64,
    /// Ankle centre over the sole.
    pub(super) ankle_height: f64,
    /// Shoulder centre: below the suprasternale, and to the side.
    pub(super) shoulder: [f64; 2],
    /// Hip centre to the side.
    pub(super) hip: f64,
    pub(super) mass: MassFractions,
}

/// Trunk, limb lengths and masses: de Leva 1996. Neck and ankle heights close the stature; shoulder and hip widths are
/// our own choice.
pub(super) const MAN: Table = Table {
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
pub(super) const WOMAN: Table = Table {
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
    pub(super) fn adult(male: f64) -> Self {
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
    pub(super) fn grown_to(self, p: Proportions) -> Self {
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

/// Limits in degrees, DOF order: trunk and neck, arm, leg; the sides are equal because angles are anatomically signed.
///
/// After the goniometric tables (Boone & Azen, AAOS, Soucie 2011), with room for captured motion: here two joints share
/// the spine motion of a whole trunk, and flexion and abduction are the components of one swing (`angles`), up to 172°
/// together.
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

/// Least and largest angle of each DOF at an age, rad.
pub(super) fn joint_limits(age: f64) -> [[f64; DOF_COUNT]; 2] {
    let ordinary: Vec<[f64; 2]> = TRUNK_LIMITS
        .iter()
        .chain(&ARM_LIMITS)
        .chain(&ARM_LIMITS)
        .chain(&LEG_LIMITS)
        .chain(&LEG_LIMITS)
        .map(|deg| deg.map(f64::to_radians))
        .collect();
    [false, true].map(|upper| {
        std::array::from_fn(|d| {
            limit_changes(d)
                .filter(|c| c.upper == upper)
                .fold(ordinary[d][usize::from(upper)], |l, c| l + c.at(age))
        })
    })
}

/// How the limits of DOF `d` change with age.
pub(in crate::body) fn limit_changes(d: usize) -> impl Iterator<Item = &'static LimitChange> {
    let (table, dof): (&'static [LimitChange], usize) = match d {
        0..9 => (&[], 0),
        9..23 => (&ARM_CHANGE, (d - 9) % 7),
        _ => (&LEG_CHANGE, (d - 23) % 8),
    };
    table.iter().filter(move |c| c.dof == dof)
}
