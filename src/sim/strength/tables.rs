//! The data behind strength, each number with its origin.
//!
//! Hip, knee and ankle flexion–extension: Anderson, Madigan & Nussbaum 2007, Table 3 (34 people). Everything else:
//! levels of industrial workers (Stobbe 1982 in Chaffin & Andersson) and single studies, with angle and velocity shapes
//! of the data set compiled for one elite gymnast, whose levels are not used. Levels refer to the reference man (1.75
//! m, 75 kg) and woman (1.63 m, 62 kg) and scale with mass · g · height. Population averages for animation and
//! planning, not for clinical or ergonomic decisions.

use crate::body::Sex;
use crate::body::age::polyline;

/// Gravity in the normalisation mass · g · height, m/s²: the gravity of the measurements, whatever gravity the world
/// has.
pub const NORMALISING_GRAVITY: f64 = 9.81;
/// Stature (m) and mass (kg) to which the levels of the tables refer.
pub const fn reference_body(sex: Sex) -> (f64, f64) {
    match sex {
        Sex::Male => (1.75, 75.0),
        Sex::Female => (1.63, 62.0),
    }
}

pub use crate::body::age::Origin;

/// Coefficients of Anderson 2007: level over m·g·h, angle (1/rad, rad), velocity (rad/s), eccentric (s/rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AndersonRow {
    /// Peak torque over mass · g · height.
    pub c1: f64,
    /// Width of the cosine, 1/rad.
    pub c2: f64,
    /// Angle of the peak, rad.
    pub c3: f64,
    /// Speed at ¾ of the isometric torque, rad/s.
    pub c4: f64,
    /// Speed at ½ of the isometric torque, rad/s.
    pub c5: f64,
    /// Eccentric coefficient, s/rad.
    pub c6: f64,
}

const fn row(c1: f64, c2: f64, c3: f64, c4: f64, c5: f64, c6: f64) -> AndersonRow {
    AndersonRow {
        c1,
        c2,
        c3,
        c4,
        c5,
        c6,
    }
}

/// Groups of Anderson 2007, index of [`ANDERSON`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Leg {
    HipFlexion,
    HipExtension,
    KneeFlexion,
    KneeExtension,
    Dorsiflexion,
    Plantarflexion,
}

impl Leg {
    /// All six, in the order of [`ANDERSON`].
    pub const ALL: [Self; 6] = [
        Self::HipFlexion,
        Self::HipExtension,
        Self::KneeFlexion,
        Self::KneeExtension,
        Self::Dorsiflexion,
        Self::Plantarflexion,
    ];
    /// Angle (rad) at which levels of different ages are compared. It lies within the range of all ages; the angle of
    /// C1 may not, because its cosine may peak beyond the range.
    pub fn reference_angle(self) -> f64 {
        let degrees: f64 = match self {
            Self::HipFlexion | Self::Dorsiflexion | Self::Plantarflexion => 0.0,
            Self::HipExtension | Self::KneeExtension => 60.0,
            Self::KneeFlexion => 30.0,
        };
        degrees.to_radians()
    }
    /// Name of the action.
    pub const fn name(self) -> &'static str {
        match self {
            Self::HipFlexion => "hip flexion",
            Self::HipExtension => "hip extension",
            Self::KneeFlexion => "knee flexion",
            Self::KneeExtension => "knee extension",
            Self::Dorsiflexion => "dorsiflexion",
            Self::Plantarflexion => "plantarflexion",
        }
    }
}

/// Standard deviation of C1 between people, `[group][man, woman][18–25, 55–65, >65]`, order of [`ANDERSON`]. The oldest
/// groups have only six people, so their spread is accidental.
pub const ANDERSON_DEVIATION: [[[f64; 3]; 2]; 6] = [
    [[0.025, 0.02, 0.025], [0.033, 0.016, 0.008]],
    [[0.049, 0.043, 0.039], [0.047, 0.032, 0.003]],
    [[0.015, 0.017, 0.022], [0.015, 0.015, 0.005]],
    [[0.04, 0.031, 0.017], [0.028, 0.016, 0.018]],
    [[0.005, 0.005, 0.002], [0.006, 0.002, 0.003]],
    [[0.022, 0.029, 0.035], [0.034, 0.026, 0.006]],
];
/// Percentiles lie at most this many standard deviations from the mean.
pub const MOST_DEVIATIONS: f64 = 2.0;
/// Origin of the percentile factor.
pub const PERCENTILE_ORIGIN: Origin = Origin {
    source: "standard deviations of Anderson 2007; 5th and 95th percentiles of Stobbe 1982; a coefficient of variation \
        of 0.25 elsewhere",
    tag: "S1 (legs), R",
    note: "the same percentile in every group; normal or piecewise log-normal between the given ones",
};

/// Middle age of the three groups of [`ANDERSON`], years (18–25, 55–65, over 65).
pub const ANDERSON_AGE: [f64; 3] = [21.5, 60.0, 70.0];

/// `[group][man, woman][18–25, 55–65, >65]`.
pub const ANDERSON: [[[AndersonRow; 3]; 2]; 6] = [
    // HipFlexion
    [
        [
            row(0.113, 0.738, -0.214, 2.095, 4.267, 0.218),
            row(0.107, 0.712, -0.192, 2.038, 4.145, 0.206),
            row(0.101, 0.762, -0.269, 1.875, 3.819, 0.296),
        ],
        [
            row(0.127, 0.65, -0.35, 2.136, 4.349, 0.156),
            row(0.091, 0.812, -0.196, 2.145, 4.366, 0.186),
            row(0.081, 0.625, -0.422, 2.084, 4.245, 0.196),
        ],
    ],
    // HipExtension
    [
        [
            row(0.161, 0.958, 0.932, 1.578, 3.19, 0.242),
            row(0.171, 0.922, 1.176, 1.601, 3.236, 0.32),
            row(0.144, 0.896, 1.125, 1.561, 3.152, 0.477),
        ],
        [
            row(0.181, 0.697, 1.242, 1.567, 3.164, 0.164),
            row(0.14, 0.83, 1.241, 1.444, 2.919, 0.317),
            row(0.138, 0.707, 1.542, 1.613, 3.256, 0.36),
        ],
    ],
    // KneeFlexion
    [
        [
            row(0.087, 0.869, 0.522, 2.008, 5.233, 0.304),
            row(0.081, 0.986, 0.523, 1.83, 4.777, 0.23),
            row(0.069, 0.838, 0.437, 1.718, 4.476, 0.414),
        ],
        [
            row(0.08, 0.873, 0.635, 1.698, 4.412, 0.175),
            row(0.06, 0.967, 0.402, 1.693, 4.41, 0.349),
            row(0.06, 0.897, 0.445, 1.121, 2.922, 0.389),
        ],
    ],
    // KneeExtension
    [
        [
            row(0.163, 1.258, 1.133, 1.517, 3.952, 0.095),
            row(0.156, 1.225, 1.173, 1.518, 3.954, 0.266),
            row(0.137, 1.31, 1.067, 1.141, 3.152, 0.386),
        ],
        [
            row(0.159, 1.187, 1.274, 1.393, 3.623, 0.173),
            row(0.128, 1.286, 1.141, 1.332, 3.469, 0.233),
            row(0.124, 1.347, 1.14, 1.066, 2.855, 0.464),
        ],
    ],
    // Dorsiflexion
    [
        [
            row(0.033, 1.51, -0.187, 0.699, 1.94, 0.828),
            row(0.028, 1.293, -0.284, 0.634, 1.759, 0.999),
            row(0.029, 1.419, -0.174, 0.561, 1.558, 1.198),
        ],
        [
            row(0.027, 1.079, -0.302, 0.864, 2.399, 0.771),
            row(0.024, 1.308, -0.254, 0.596, 1.654, 1.006),
            row(0.022, 1.096, -0.369, 0.458, 1.242, 1.401),
        ],
    ],
    // Plantarflexion
    [
        [
            row(0.095, 1.391, 0.408, 0.987, 3.558, 0.295),
            row(0.114, 1.444, 0.551, 0.593, 2.128, 0.35),
            row(0.106, 1.465, 0.498, 0.49, 1.767, 0.571),
        ],
        [
            row(0.104, 1.399, 0.424, 0.862, 3.109, 0.189),
            row(0.093, 1.504, 0.381, 0.86, 3.126, 0.349),
            row(0.125, 1.299, 0.58, 0.587, 1.819, 0.348),
        ],
    ],
];

/// Origin of the rows of [`ANDERSON`].
pub const ANDERSON_ORIGIN: Origin = Origin {
    source: "Anderson, Madigan & Nussbaum 2007, J. Biomech. 40:3105, Table 3",
    tag: "S1",
    note: "level of the young group times the age trend; shapes interpolated between the age groups; eccentric branch \
        replaced by a plateau 1.1 + 0.2 C6",
};
/// Velocity shape of plantarflexion, whose published curve never reaches zero.
pub const PLANTARFLEXION_ORIGIN: Origin = Origin {
    source: "gymnast set (compiled in the rbdl muscle add-on)",
    tag: "S1",
    note: "Hill curve in place of the published one, which does not fall to zero",
};
/// Fastest plantarflexion (rad/s) and its factor at half that speed.
pub const PLANTARFLEXION_HILL: [f64; 2] = [11.8, 0.41];

/// One direction of a DOF outside Anderson's table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action {
    /// Name of the action.
    pub name: &'static str,
    /// Isometric torque at `at`, N·m, of the reference man and woman.
    pub level: [f64; 2],
    /// Anatomical angle at which the level was measured, degrees.
    pub at: f64,
    /// Angle of the peak and standard deviation of the bell, degrees.
    pub bell: [f64; 2],
    /// Hill curve: fastest (rad/s), factor at half of it, eccentric plateau.
    pub hill: [f64; 3],
    /// The level's 5th and 95th percentile over its median, men and women.
    pub spread: [[f64; 2]; 2],
    /// Origin of the level.
    pub level_origin: Origin,
    /// Origin of the shapes.
    pub shape_origin: Origin,
}

/// A muscle group by table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(clippy::large_enum_variant)] // a few constants, never stored
pub enum Group {
    /// Anderson 2007.
    Leg(Leg),
    /// Everything else.
    Other(Action),
}

const STOBBE: Origin = Origin {
    source: "Stobbe 1982, in Chaffin & Andersson; industrial workers, median",
    tag: "S3 (men), R (women)",
    note: "isometric",
};
const GYMNAST: Origin = Origin {
    source: "gymnast set (compiled in the rbdl muscle add-on from Jackson 2010, Kentel 2011 and others)",
    tag: "S1",
    note: "shape only; the levels of an elite athlete are not used",
};
const ESTIMATE: Origin = Origin {
    source: "general knowledge",
    tag: "R",
    note: "estimate, to be replaced by measurements",
};
const SHOULDER_FLEXION: Origin = Origin {
    source: "arm moment over measured utilisation at 90° (Stockholm reference sample, 96 men and 90 women)",
    tag: "D",
    note: "44–50 N·m man, about 22 N·m woman",
};
const SHOULDER_EXTENSION: Origin = Origin {
    source: "shoulder flexion times the extension-to-flexion ratio of the gymnast set",
    tag: "D",
    note: "ratio 1.4",
};
const VASAVADA: Origin = Origin {
    source: "Vasavada 2001, as quoted by a proprietary model",
    tag: "S3 (men), R (women)",
    note: "cross-checked value",
};
const SUGIMOTO: Origin = Origin {
    source: "Sugimoto 2014, college athletes, concentric at 60°/s",
    tag: "S2",
    note: "1.29 and 1.13 N·m/kg, divided by 0.86 for the speed",
};
const HALF_GYMNAST: Origin = Origin {
    source: "half of the gymnast set; women 0.55 of men",
    tag: "R",
    note: "typical men reach roughly half",
};

const fn action(
    name: &'static str,
    level: [f64; 2],
    at: f64,
    bell: [f64; 2],
    hill: [f64; 3],
    level_origin: Origin,
    shape_origin: Origin,
) -> Group {
    Group::Other(Action {
        name,
        level,
        at,
        bell,
        hill,
        spread: USUAL_SPREAD,
        level_origin,
        shape_origin,
    })
}

/// Spread used where none was measured: a coefficient of variation of a quarter, like that of the measured groups.
const USUAL_SPREAD: [[f64; 2]; 2] = [[0.59, 1.41]; 2];

/// 5th, 50th and 95th percentile of men and of women.
const fn spread(group: Group, man: [f64; 3], woman: [f64; 3]) -> Group {
    match group {
        Group::Other(a) => Group::Other(Action {
            spread: [
                [man[0] / man[1], man[2] / man[1]],
                [woman[0] / woman[1], woman[2] / woman[1]],
            ],
            ..a
        }),
        Group::Leg(_) => group,
    }
}

/// Strength of the thorax joint as a share of the waist's: the same muscles act on a shorter lever.
const THORAX: f64 = 0.88;

const fn thorax(waist: Group, name: &'static str) -> Group {
    match waist {
        Group::Other(a) => Group::Other(Action {
            name,
            level: [a.level[0] * THORAX, a.level[1] * THORAX],
            level_origin: Origin {
                note: "waist times 0.88 (R)",
                ..a.level_origin
            },
            ..a
        }),
        Group::Leg(_) => waist,
    }
}

/// Lumbar extension peaks far into flexion in the gymnast set; here two joints share the bend, and the level is known
/// only for the upright posture.
const TRUNK_FLEXION: Group = spread(
    action(
        "trunk flexion",
        [143.0, 75.0],
        0.0,
        [0.0, 120.0],
        [19.2, 0.15, 1.1],
        STOBBE,
        GYMNAST,
    ),
    [75.0, 143.0, 216.0],
    [49.0, 75.0, 161.0],
);
const TRUNK_EXTENSION: Group = spread(
    action(
        "trunk extension",
        [234.0, 184.0],
        0.0,
        [30.0, 45.0],
        [8.0, 0.15, 1.1],
        STOBBE,
        GYMNAST,
    ),
    [164.0, 234.0, 503.0],
    [71.0, 184.0, 371.0],
);
const TRUNK_LATERAL: Group = spread(
    action(
        "trunk lateral bend",
        [159.0, 94.0],
        0.0,
        [0.0, 60.0],
        [10.0, 0.2, 1.2],
        STOBBE,
        ESTIMATE,
    ),
    [95.0, 159.0, 261.0],
    [50.0, 94.0, 162.0],
);
const TRUNK_ROTATION: Group = action(
    "trunk rotation",
    [75.0, 45.0],
    0.0,
    [0.0, 70.0],
    [12.0, 0.2, 1.2],
    ESTIMATE,
    ESTIMATE,
);
const NECK_LATERAL: Group = action(
    "neck lateral bend",
    [36.0, 16.0],
    0.0,
    [0.0, 70.0],
    [15.0, 0.2, 1.2],
    VASAVADA,
    ESTIMATE,
);
const NECK_ROTATION: Group = action(
    "neck rotation",
    [15.0, 6.0],
    0.0,
    [0.0, 90.0],
    [18.0, 0.2, 1.2],
    VASAVADA,
    ESTIMATE,
);

/// Trunk and neck, DOF order: muscles for the positive and for the negative direction.
pub const TRUNK: [[Group; 2]; 9] = [
    [TRUNK_FLEXION, TRUNK_EXTENSION],
    [TRUNK_LATERAL, TRUNK_LATERAL],
    [TRUNK_ROTATION, TRUNK_ROTATION],
    [
        thorax(TRUNK_FLEXION, "thorax flexion"),
        thorax(TRUNK_EXTENSION, "thorax extension"),
    ],
    [
        thorax(TRUNK_LATERAL, "thorax lateral bend"),
        thorax(TRUNK_LATERAL, "thorax lateral bend"),
    ],
    [
        thorax(TRUNK_ROTATION, "thorax rotation"),
        thorax(TRUNK_ROTATION, "thorax rotation"),
    ],
    [
        action(
            "neck flexion",
            [30.0, 15.0],
            0.0,
            [0.0, 70.0],
            [15.0, 0.2, 1.2],
            VASAVADA,
            ESTIMATE,
        ),
        action(
            "neck extension",
            [52.0, 21.0],
            0.0,
            [10.0, 70.0],
            [15.0, 0.2, 1.2],
            VASAVADA,
            ESTIMATE,
        ),
    ],
    [NECK_LATERAL, NECK_LATERAL],
    [NECK_ROTATION, NECK_ROTATION],
];

/// One arm, DOF order.
pub const ARM: [[Group; 2]; 7] = [
    [
        action(
            "shoulder flexion",
            [47.0, 22.0],
            90.0,
            [51.0, 74.0],
            [19.1, 0.25, 1.23],
            SHOULDER_FLEXION,
            GYMNAST,
        ),
        action(
            "shoulder extension",
            [66.0, 31.0],
            90.0,
            [123.0, 105.0],
            [16.2, 0.25, 1.1],
            SHOULDER_EXTENSION,
            GYMNAST,
        ),
    ],
    [
        spread(
            action(
                "shoulder abduction",
                [71.0, 37.0],
                90.0,
                [60.0, 80.0],
                [18.0, 0.22, 1.23],
                STOBBE,
                ESTIMATE,
            ),
            [43.0, 71.0, 101.0],
            [15.0, 37.0, 57.0],
        ),
        spread(
            action(
                "shoulder adduction",
                [67.0, 30.0],
                90.0,
                [80.0, 90.0],
                [18.0, 0.22, 1.23],
                STOBBE,
                ESTIMATE,
            ),
            [35.0, 67.0, 115.0],
            [13.0, 30.0, 54.0],
        ),
    ],
    [
        spread(
            action(
                "shoulder internal rotation",
                [52.0, 21.0],
                0.0,
                [68.0, 161.0],
                [19.5, 0.29, 1.28],
                STOBBE,
                GYMNAST,
            ),
            [28.0, 52.0, 83.0],
            [9.0, 21.0, 33.0],
        ),
        spread(
            action(
                "shoulder external rotation",
                [33.0, 19.0],
                0.0,
                [38.0, 114.0],
                [18.0, 0.23, 1.36],
                STOBBE,
                GYMNAST,
            ),
            [23.0, 33.0, 51.0],
            [13.0, 19.0, 28.0],
        ),
    ],
    [
        spread(
            action(
                "elbow flexion",
                [77.0, 41.0],
                90.0,
                [19.0, 207.0],
                [18.1, 0.19, 1.37],
                STOBBE,
                GYMNAST,
            ),
            [42.0, 77.0, 111.0],
            [16.0, 41.0, 55.0],
        ),
        spread(
            action(
                "elbow extension",
                [46.0, 27.0],
                110.0,
                [94.0, 75.0],
                [18.4, 0.19, 1.32],
                STOBBE,
                GYMNAST,
            ),
            [31.0, 46.0, 67.0],
            [9.0, 27.0, 39.0],
        ),
    ],
    [
        action(
            "pronation",
            [9.0, 5.0],
            0.0,
            [12.0, 57.0],
            [27.9, 0.21, 1.39],
            ESTIMATE,
            GYMNAST,
        ),
        action(
            "supination",
            [9.5, 5.0],
            0.0,
            [12.0, 77.0],
            [35.5, 0.25, 1.24],
            ESTIMATE,
            GYMNAST,
        ),
    ],
    [
        action(
            "wrist flexion",
            [19.5, 10.5],
            0.0,
            [38.0, 98.0],
            [36.4, 0.12, 1.14],
            HALF_GYMNAST,
            GYMNAST,
        ),
        action(
            "wrist extension",
            [8.0, 4.4],
            0.0,
            [89.0, 80.0],
            [36.5, 0.12, 1.17],
            HALF_GYMNAST,
            GYMNAST,
        ),
    ],
    [
        action(
            "radial deviation",
            [12.0, 6.5],
            0.0,
            [65.0, 147.0],
            [21.8, 0.21, 1.31],
            HALF_GYMNAST,
            GYMNAST,
        ),
        action(
            "ulnar deviation",
            [15.5, 8.5],
            0.0,
            [-25.0, 85.0],
            [18.0, 0.2, 1.35],
            HALF_GYMNAST,
            GYMNAST,
        ),
    ],
];

const HIP_ROTATION: [f64; 2] = [56.0, 40.0];
const ANKLE_ROLL: [f64; 2] = [26.5, 20.5];
const ANKLE_ROTATION: [f64; 2] = [25.0, 17.0];

/// One leg, DOF order.
pub const LEG: [[Group; 2]; 8] = [
    [Group::Leg(Leg::HipFlexion), Group::Leg(Leg::HipExtension)],
    [
        action(
            "hip abduction",
            [112.0, 81.0],
            0.0,
            [-10.0, 50.0],
            [12.0, 0.25, 1.2],
            SUGIMOTO,
            ESTIMATE,
        ),
        action(
            "hip adduction",
            [123.0, 89.0],
            0.0,
            [15.0, 50.0],
            [12.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
    ],
    [
        action(
            "hip internal rotation",
            HIP_ROTATION,
            0.0,
            [0.0, 80.0],
            [15.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
        action(
            "hip external rotation",
            HIP_ROTATION,
            0.0,
            [0.0, 80.0],
            [15.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
    ],
    [Group::Leg(Leg::KneeFlexion), Group::Leg(Leg::KneeExtension)],
    [
        Group::Leg(Leg::Dorsiflexion),
        Group::Leg(Leg::Plantarflexion),
    ],
    [
        action(
            "ankle roll outward",
            ANKLE_ROLL,
            0.0,
            [0.0, 40.0],
            [12.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
        action(
            "ankle roll inward",
            ANKLE_ROLL,
            0.0,
            [0.0, 40.0],
            [12.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
    ],
    [
        action(
            "ankle internal rotation",
            ANKLE_ROTATION,
            0.0,
            [0.0, 60.0],
            [12.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
        action(
            "ankle external rotation",
            ANKLE_ROTATION,
            0.0,
            [0.0, 60.0],
            [12.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
    ],
    [
        action(
            "toe extension",
            [7.0, 4.5],
            0.0,
            [0.0, 60.0],
            [15.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
        action(
            "toe flexion",
            [20.0, 14.0],
            0.0,
            [30.0, 60.0],
            [15.0, 0.25, 1.2],
            ESTIMATE,
            ESTIMATE,
        ),
    ],
];

/// Share of an adult's strength per mass · g · height that a child has.
const CHILD: [(f64, [f64; 1]); 3] = [(6.0, [0.9]), (12.0, [0.97]), (18.0, [1.0])];

/// Strength per mass · g · height at `age` (years) relative to an adult: 1 from 18 years.
pub fn child_factor(age: f64) -> f64 {
    polyline(&CHILD, age)[0]
}

/// Origin of the child's factor.
pub const CHILD_ORIGIN: Origin = Origin {
    source: "Hogrel 2012 (96 children, 5–17 y) against adult coefficients times own mass · g · height",
    tag: "D",
    note: "0.90 at 6 y, 0.97 at 12 y, 1 from 18 y; sexes alike to 10 y",
};

/// Origin of the age trend.
pub const AGE_ORIGIN: Origin = Origin {
    source: "Frontiers Physiol. 2018, 9:1524 (n = 362); women held to 40 y after Danneskiold-Samsøe 2009",
    tag: "S2/D",
    note: "−0.15 %/y to 52 y, then −1.3 %/y",
};

/// Strength at `age` (years) relative to a young adult of the same sex.
///
/// Men lose 0.15 % a year from 25 and 1.3 % a year from 52; women hold to 40, then the same slopes with the bend at 47.
/// Never below 0.3.
pub fn age_factor(sex: Sex, age: f64) -> f64 {
    let (decline, bend) = match sex {
        Sex::Male => (25.0, 52.0),
        Sex::Female => (40.0, 47.0),
    };
    let slow = (age.min(bend) - decline).max(0.0);
    let fast = (age - bend).max(0.0);
    (1.0 - 0.0015 * slow - 0.013 * fast).max(0.3)
}

/// Passive tissue on one side of a DOF: torque `amplitude · exp(steepness · (excess over onset))` away from that side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tissue {
    /// Amplitude (N·m), steepness (1/rad), onset (rad): Falisse 2019 after Anderson & Pandy.
    Measured(f64, f64, f64),
    /// Amplitude (N·m) and steepness (1/rad) as measured, onset 0.1 rad before the limit: the measured trunk bends in
    /// one joint, but this one bends in two.
    AtLimit(f64, f64),
    /// 1 % of the antagonist's peak at the first angle, all of it at the second, degrees.
    Between(f64, f64),
    /// No data: 1 % of the antagonist's peak 15° before the limit, all of it 15° beyond.
    Unknown,
}

use Tissue::{AtLimit, Between, Measured, Unknown};

/// Passive tissue at the lower and the upper end, DOF order.
pub const TRUNK_TISSUE: [[Tissue; 2]; 9] = [
    [AtLimit(0.35, 30.72), AtLimit(0.25, 20.36)],
    [AtLimit(0.25, 20.36), AtLimit(0.25, 20.36)],
    [AtLimit(0.25, 20.36), AtLimit(0.25, 20.36)],
    [AtLimit(0.35, 30.72), AtLimit(0.25, 20.36)],
    [AtLimit(0.25, 20.36), AtLimit(0.25, 20.36)],
    [AtLimit(0.25, 20.36), AtLimit(0.25, 20.36)],
    [Unknown, Unknown],
    [Unknown, Unknown],
    [Unknown, Unknown],
];
/// One arm. The elbow hangs at the end of its range without effort, as in the gymnast's data.
pub const ARM_TISSUE: [[Tissue; 2]; 7] = [
    [Unknown, Unknown],
    [Unknown, Unknown],
    [Unknown, Unknown],
    [Between(0.0, -10.0), Unknown],
    [Unknown, Unknown],
    [Unknown, Unknown],
    [Unknown, Unknown],
];
/// One leg. The measured toe resists flexion from 0 on, at 70/rad; here its steepness is that of extension and it
/// begins at the limit.
pub const LEG_TISSUE: [[Tissue; 2]; 8] = [
    [Measured(1.51, 21.88, -0.6981), Measured(2.44, 5.05, 1.81)],
    [Measured(0.03, 14.94, -0.5), Measured(0.03, 14.94, 0.5)],
    [Measured(0.03, 14.94, -0.92), Measured(0.03, 14.94, 0.92)],
    [Measured(6.09, 33.94, -0.13), Measured(11.03, 11.33, 2.4)],
    [Measured(0.18, 12.12, -0.74), Measured(2.03, 38.11, 0.52)],
    [Measured(60.21, 16.32, -0.65), Measured(60.21, 16.32, 0.65)],
    [Unknown, Unknown],
    [AtLimit(0.18, 14.87), Measured(0.9, 14.87, 1.134)],
];

/// Origin of [`Tissue::Measured`] and [`Tissue::AtLimit`].
pub const TISSUE_ORIGIN: Origin = Origin {
    source: "Falisse et al. 2019, after Anderson & Pandy",
    tag: "S1",
    note: "capped at the antagonist's isometric peak, then linear to twice that",
};
/// Origin of [`Tissue::Between`].
pub const BETWEEN_TISSUE_ORIGIN: Origin = Origin {
    source: GYMNAST.source,
    tag: "S1",
    note: "start and full angle of the passive curve; an exponential between them",
};
/// Origin of [`Tissue::Unknown`].
pub const UNKNOWN_TISSUE_ORIGIN: Origin = Origin {
    source: "general knowledge",
    tag: "R",
    note: "1 % of the antagonist's peak 15° before the limit, all of it 15° beyond",
};
