//! Effects of age on a body: size, proportions, mass fractions and ranges of motion from 6 to 90 years.
//!
//! Every quantity is a continuous function of age: values are given at nodes and interpolated between them, so nothing
//! jumps at a birthday. From 20 to 44 years all of them are those of the adult tables, to the last bit.

use super::model::{Profile, Sex};
use crate::math::curve::rise;

/// Where a number comes from and how far to trust it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    /// Publication or reason.
    pub source: &'static str,
    /// S1 read in data that cite the publication; S2 read in the publication or an excerpt; S3 cross-check only; D
    /// derived; R estimate.
    pub tag: &'static str,
    /// How the value was processed.
    pub note: &'static str,
}

/// Ages the tables cover, years.
pub const AGE_RANGE: [f64; 2] = [6.0, 90.0];
/// From this age on proportions are an adult's, years.
pub const GROWN: f64 = 20.0;
/// The sexes do not differ below the first age, and differ as adults do from the second on, years.
const SEXES_PART: [f64; 2] = [10.0, 18.0];

/// Value at `x` of the polyline through `nodes`, constant beyond its ends.
pub fn polyline<const N: usize>(nodes: &[(f64, [f64; N])], x: f64) -> [f64; N] {
    let k = nodes.partition_point(|n| n.0 <= x);
    if k == 0 || k == nodes.len() {
        return nodes[k.min(nodes.len() - 1)].1;
    }
    let ((a, from), (b, to)) = (nodes[k - 1], nodes[k]);
    let t = (x - a) / (b - a);
    std::array::from_fn(|i| from[i] + t * (to[i] - from[i]))
}

/// Share of the men's tables in a person: 1 and 0 for adults, ½ for both sexes up to ten years.
pub fn male_share(sex: Sex, age: f64) -> f64 {
    let apart = rise(age, SEXES_PART.into());
    match sex {
        Sex::Male => 0.5 + 0.5 * apart,
        Sex::Female => 0.5 - 0.5 * apart,
    }
}

/// `male·a + (1 − male)·b`; exactly `a` or `b` at the ends.
pub fn mix(male: f64, a: f64, b: f64) -> f64 {
    if male >= 1.0 {
        a
    } else if male <= 0.0 {
        b
    } else {
        b + male * (a - b)
    }
}

/// Stature (m) and mass (kg) of an ordinary man: growth-chart medians (6–12 y), sizes chosen for the age groups of
/// Anderson 2007 (adults). Interpolated between ages.
const ORDINARY_MAN: [(f64, [f64; 2]); 11] = [
    (6.0, [1.16, 21.0]),
    (8.0, [1.28, 26.0]),
    (10.0, [1.39, 32.0]),
    (12.0, [1.50, 41.0]),
    (14.0, [1.64, 51.0]),
    (16.0, [1.73, 61.0]),
    (20.0, [1.75, 72.0]),
    (25.0, [1.75, 75.0]),
    (35.0, [1.75, 75.0]),
    (60.0, [1.75, 82.0]),
    (72.0, [1.72, 78.0]),
];
/// Stature (m) and mass (kg) of an ordinary woman, by age.
const ORDINARY_WOMAN: [(f64, [f64; 2]); 11] = [
    (6.0, [1.16, 21.0]),
    (8.0, [1.28, 26.0]),
    (10.0, [1.39, 32.0]),
    (12.0, [1.50, 41.0]),
    (14.0, [1.60, 49.0]),
    (16.0, [1.62, 54.0]),
    (20.0, [1.63, 58.0]),
    (25.0, [1.63, 62.0]),
    (35.0, [1.63, 62.0]),
    (60.0, [1.62, 68.0]),
    (72.0, [1.59, 66.0]),
];

impl Profile {
    /// An ordinary person of this sex and age: stature and mass from tables, rounded to centimetres and half kilograms.
    ///
    /// The strength levels refer to the man and the woman of 30 years: 1.75 m, 75 kg and 1.63 m, 62 kg. Ages outside
    /// 6…90 years count as the nearest.
    pub fn ordinary(sex: Sex, age: f64) -> Self {
        let [height, mass] = match sex {
            Sex::Male => polyline(&ORDINARY_MAN, age),
            Sex::Female => polyline(&ORDINARY_WOMAN, age),
        };
        Self {
            sex,
            age,
            height: (height * 100.0).round() / 100.0,
            mass: (mass * 2.0).round() / 2.0,
        }
    }
}

/// Statures accepted at an age, m: 1.4…2.1 for adults, four fifths to five quarters of the ordinary for children.
pub fn height_range(age: f64) -> [f64; 2] {
    let [height, _] = polyline(&ORDINARY_MAN, age.clamp(AGE_RANGE[0], GROWN));
    [(0.8 * height).min(1.4), (1.25 * height).min(2.1)]
}

/// Masses accepted at an age, kg: 35…180 for adults; for children about half to two and a half times the ordinary.
pub fn mass_range(age: f64) -> [f64; 2] {
    let [_, mass] = polyline(&ORDINARY_MAN, age.clamp(AGE_RANGE[0], GROWN));
    [(0.6 * mass).min(35.0), (2.5 * mass).min(180.0)]
}

/// Lengths of a growing body over those of an adult of the same stature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportions {
    /// Trunk and height of the neck joint.
    pub trunk: f64,
    /// Upper arm, forearm, hand.
    pub arm: f64,
    /// Thigh, shank, height of the ankle.
    pub leg: f64,
    /// Length of the foot.
    pub foot: f64,
    /// Distances of the shoulders and of the hips.
    pub width: f64,
    /// Cross-section of the head; its height is the remainder of the stature.
    pub head_width: f64,
}

/// Trunk, arm, leg, foot, width, head width.
const GROWING: [(f64, [f64; 6]); 4] = [
    (6.0, [1.01, 0.95, 0.934, 1.05, 0.93, 1.30]),
    (12.0, [0.998, 0.985, 0.985, 1.04, 0.97, 1.11]),
    (15.0, [0.998, 0.995, 1.0, 1.02, 0.99, 1.02]),
    (GROWN, [1.0; 6]),
];
/// Origin of the proportions of children.
pub const GROWTH_ORIGIN: Origin = Origin {
    source: "adult proportions with the shares of head, trunk and legs that growth charts show",
    tag: "R",
    note: "head 17 % of the stature at 6 y against 14 %, legs 49 % against 52 %",
};

impl Proportions {
    /// Proportions at `age`, years.
    pub fn at(age: f64) -> Self {
        let [trunk, arm, leg, foot, width, head_width] = polyline(&GROWING, age);
        Self {
            trunk,
            arm,
            leg,
            foot,
            width,
            head_width,
        }
    }
}

/// Share of the body mass in each kind of segment, %: pelvis, abdomen, chest, head with neck, then one upper arm,
/// forearm, hand, thigh, shank, foot with toes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassFractions {
    /// Which population.
    pub row: &'static str,
    /// The shares, %.
    pub percent: [f64; 10],
}

/// Sums of fractions within this of 100 % are taken for rounding, percentage points.
const FRACTION_SLACK: f64 = 1.0;

impl MassFractions {
    /// Sum over the body: limbs count twice, %.
    pub fn sum(&self) -> f64 {
        self.percent[..4].iter().sum::<f64>() + 2.0 * self.percent[4..].iter().sum::<f64>()
    }

    /// Checks a table before it is used.
    ///
    /// # Errors
    /// The row's name and its sum, if a share is not positive or the sum is not 100 ± 1 %.
    pub fn check(&self) -> Result<(), super::model::BodyError> {
        let sum = self.sum();
        let positive = self.percent.iter().all(|p| *p > 0.0);
        if positive && (sum - 100.0).abs() <= FRACTION_SLACK {
            Ok(())
        } else {
            Err(super::model::BodyError::Fractions { row: self.row, sum })
        }
    }

    fn blend(&self, other: &Self, share: f64) -> Self {
        if share <= 0.0 {
            return *self;
        }
        let scale = 100.0 / self.sum();
        let other_scale = 100.0 / other.sum();
        Self {
            row: if share < 0.5 { self.row } else { other.row },
            percent: std::array::from_fn(|i| {
                let (a, b) = (self.percent[i] * scale, other.percent[i] * other_scale);
                a + share * (b - a)
            }),
        }
    }

    /// A published row that gives the trunk as one number; the trunk is divided here as in `adult`.
    fn whole_trunk(row: &'static str, head: f64, trunk: f64, limb: [f64; 6], adult: &Self) -> Self {
        let parts = &adult.percent;
        let share = trunk / (parts[0] + parts[1] + parts[2]);
        Self {
            row,
            percent: [
                parts[0] * share,
                parts[1] * share,
                parts[2] * share,
                head,
                limb[0],
                limb[1],
                limb[2],
                limb[3],
                limb[4],
                limb[5],
            ],
        }
    }

    /// Fractions of a person, from those of an adult of the sex: Jensen's children up to 15 years, `adult` from 20,
    /// Pavol's older people from 73; interpolated between.
    pub fn of(sex: Sex, age: f64, adult: &Self) -> Self {
        if age < GROWN {
            let rows = CHILDREN.map(|(at, row, head, trunk, limb)| {
                (at, Self::whole_trunk(row, head, trunk, limb, adult))
            });
            let k = rows.partition_point(|r| r.0 <= age).max(1);
            let (from, row) = rows[k - 1];
            let (to, next) = rows.get(k).copied().unwrap_or((GROWN, *adult));
            return row.blend(&next, ((age - from) / (to - from)).max(0.0));
        }
        let (row, head, trunk, limb) = match sex {
            Sex::Male => OLDER_MAN,
            Sex::Female => OLDER_WOMAN,
        };
        let older = Self::whole_trunk(row, head, trunk, limb, adult);
        adult.blend(&older, rise(age, OLDER.into()))
    }
}

type Whole = (&'static str, f64, f64, [f64; 6]);

/// Age, name, head with neck, trunk, limb segments. The 18-year-olds of the same method are left out: their thighs
/// (11.4 %) contradict the adults that the body grows into (14.2 %).
const CHILDREN: [(f64, &str, f64, f64, [f64; 6]); 3] = [
    (
        6.0,
        "child of 6 y (Jensen 1989)",
        18.2,
        43.0,
        [2.4, 1.3, 0.8, 8.5, 4.6, 1.9],
    ),
    (
        12.0,
        "child of 12 y (Jensen 1986)",
        10.1,
        41.7,
        [3.2, 1.7, 0.9, 11.0, 5.3, 2.1],
    ),
    (
        15.0,
        "teenager of 15 y (Jensen 1986)",
        6.7,
        41.6,
        [3.5, 1.7, 0.8, 12.1, 5.6, 2.1],
    ),
];
const OLDER_MAN: Whole = (
    "older man (Pavol 2002)",
    6.62,
    48.71,
    [2.99, 1.75, 0.65, 11.27, 4.41, 1.27],
);
const OLDER_WOMAN: Whole = (
    "older woman (Pavol 2002)",
    7.39,
    47.86,
    [3.01, 1.41, 0.54, 11.62, 4.56, 1.23],
);
/// Ages between which the adult's fractions become the older person's, years.
const OLDER: [f64; 2] = [50.0, 73.0];

/// Origin of the mass fractions at `age`.
pub fn mass_origin(age: f64) -> Origin {
    if age < GROWN {
        Origin {
            source: "Jensen 1986 and 1989 (6, 12, 15 y), de Leva 1996 from 20 y",
            tag: "S1",
            note: "interpolated in age; trunk divided as de Leva divides it; scaled to the exact body mass",
        }
    } else if age <= OLDER[0] {
        Origin {
            source: "de Leva 1996",
            tag: "S1",
            note: "scaled to the exact body mass; the toes are 14 % of the foot (R)",
        }
    } else {
        Origin {
            source: "Pavol 2002 (older people), de Leva 1996 up to 50 y",
            tag: "S1",
            note: "interpolated from 50 to 73 y; trunk divided as de Leva divides it; scaled to the exact body mass",
        }
    }
}

/// Ages between which the range of motion of a child becomes an adult's, and of an adult an older person's, years.
const CHILD_RANGE: [f64; 2] = [8.0, 20.0];
const OLDER_RANGE: [f64; 2] = [44.0, 67.0];

/// Change of a limit (deg): name of the motion, DOF within its limb, upper end?, child − adult, older − adult.
pub struct LimitChange {
    /// DOF within the limb.
    pub dof: usize,
    /// Whether this is the upper limit.
    pub upper: bool,
    /// How much further a child of up to 8 years can move, degrees.
    pub child: f64,
    /// How much further a person of 67 or more can move, degrees.
    pub older: f64,
}

const fn change(dof: usize, upper: bool, child: f64, older: f64) -> LimitChange {
    LimitChange {
        dof,
        upper,
        child,
        older,
    }
}

/// Differences of the age groups of Soucie 2011 (mean of the sexes), arm: shoulder flexion, elbow flexion.
pub const ARM_CHANGE: [LimitChange; 2] = [change(0, true, 7.8, -4.4), change(3, true, 4.9, -1.4)];
/// Leg: hip extension and flexion, knee flexion, plantar- and dorsiflexion.
pub const LEG_CHANGE: [LimitChange; 5] = [
    change(0, false, -9.5, 2.6),
    change(0, true, 3.9, -3.1),
    change(3, true, 10.4, -4.5),
    change(4, false, -3.1, 5.4),
    change(4, true, 10.5, -1.5),
];

impl LimitChange {
    /// Change at `age` in rad; 0 from 20 to 44 years.
    pub fn at(&self, age: f64) -> f64 {
        let child = 1.0 - rise(age, CHILD_RANGE.into());
        let older = rise(age, OLDER_RANGE.into());
        (self.child * child + self.older * older).to_radians()
    }
}

/// Origin of a limit, changed with age or not.
pub fn limit_origin(changed: bool) -> Origin {
    if changed {
        Origin {
            source: "Boone & Azen, AAOS; differences between ages: Soucie 2011",
            tag: "S2 (2–8 y leg), R",
            note: "with room for captured motion; children full to 8 y, older people full from 67 y",
        }
    } else {
        Origin {
            source: "Boone & Azen, AAOS, Soucie 2011",
            tag: "S2",
            note: "with room for captured motion; spine motion falls on two joints",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_people_have_their_sizes_and_nothing_jumps() {
        let size = |sex, age| {
            let p = Profile::ordinary(sex, age);
            (p.height, p.mass)
        };
        assert_eq!(size(Sex::Male, 30.0), (1.75, 75.0));
        assert_eq!(size(Sex::Female, 30.0), (1.63, 62.0));
        assert_eq!(size(Sex::Female, 6.0), (1.16, 21.0));
        assert_eq!(size(Sex::Male, 75.0), (1.72, 78.0));
        for sex in [Sex::Male, Sex::Female] {
            for tenth in 60..900 {
                let age = f64::from(tenth) * 0.1;
                let (a, b) = (size(sex, age), size(sex, age + 0.1));
                assert!((a.0 - b.0).abs() < 0.02 && (a.1 - b.1).abs() < 1.6, "{age}");
                let (h, m) = (height_range(age), mass_range(age));
                assert!(
                    h[0] < a.0 && a.0 < h[1] && m[0] < a.1 && a.1 < m[1],
                    "{age}"
                );
            }
        }
        assert_eq!(
            (height_range(30.0), mass_range(18.0)[0]),
            ([1.4, 2.1], 35.0)
        );
        assert_eq!(mass_range(40.0), [35.0, 180.0]);
    }

    #[test]
    fn tables_that_do_not_add_up_are_refused_by_name() {
        let mut t = MassFractions {
            row: "mine",
            percent: [
                11.17, 16.33, 15.96, 6.94, 2.71, 1.62, 0.61, 14.16, 4.33, 1.37,
            ],
        };
        assert_eq!(t.check(), Ok(()));
        t.percent[7] = 13.0;
        let message = t.check().unwrap_err().to_string();
        assert!(
            message.contains("mine") && message.contains("97.6"),
            "{message}"
        );
        t.percent[7] = f64::NAN;
        assert!(t.check().is_err());
    }

    #[test]
    fn fractions_are_the_published_ones_at_their_ages() {
        let adult = MassFractions {
            row: "adult",
            percent: [
                11.17, 16.33, 15.96, 6.94, 2.71, 1.62, 0.61, 14.16, 4.33, 1.37,
            ],
        };
        let at = |age| MassFractions::of(Sex::Male, age, &adult);
        for (age, head, thigh) in [(6.0, 18.2, 8.5), (12.0, 10.1, 11.0), (80.0, 6.62, 11.27)] {
            let f = at(age);
            let exact = 100.0 / f.sum();
            assert!((f.percent[3] * exact - head).abs() < 0.05, "{age}");
            assert!((f.percent[7] * exact - thigh).abs() < 0.05, "{age}");
            assert!(f.check().is_ok());
        }
        assert_eq!(at(30.0), adult);
        for tenth in 60..900 {
            let (a, b) = (at(f64::from(tenth) * 0.1), at(f64::from(tenth + 1) * 0.1));
            for (x, y) in a.percent.iter().zip(&b.percent) {
                assert!((x * 100.0 / a.sum() - y * 100.0 / b.sum()).abs() < 0.15);
            }
        }
    }
}
