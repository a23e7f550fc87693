//! Available joint torque, equation (5): isometric level × angle factor × velocity factor, per DOF and direction.
//!
//! [`Strength`] is made once per body (sex, age, mass, stature) and read in every tick by [`Strength::range`].
//! [`tables`] holds the data and their origin, [`curve`] the shapes.

pub mod curve;
pub mod fatigue;
pub mod tables;

#[cfg(test)]
mod tests;

use crate::body::age::{male_share, mix};
use crate::body::export::Actuation;
use crate::body::{Body, DOF_COUNT, Sex};
use crate::math::curve::rise;
use crate::math::exp::{exp, ln};
use curve::{AngleFactor, Muscle, VelocityFactor};
use serde::{Deserialize, Serialize};
use tables::{Action, AndersonRow, Group, Leg, Origin, Tissue};

/// Ligaments act within this angle before a limit, rad (4°): `docs/model.md#strength`.
pub const LIGAMENT_ZONE: f64 = 4.0 / 180.0 * std::f64::consts::PI;
const PER_ZONE: f64 = 1.0 / LIGAMENT_ZONE;
/// At and past a limit, ligaments oppose it with this multiple of the isometric peak that drives into it.
pub const LIGAMENT_FACTOR: f64 = 3.0;
/// Passive tissue pushes this share more while it is being stretched at [`TISSUE_SPEED`] or faster, and this share less
/// while it recoils. Without this damping it rings.
const TISSUE_DAMPING: f64 = 0.1;
const TISSUE_SPEED: f64 = 10.0;
/// Torque below which tissue does not act in the simulation, N·m. Also the angle below which a difference quotient is
/// not used as a slope, rad.
const FELT: f64 = 1e-3;
const LEAST_WAY: f64 = 1e-6;
/// Least stiffness over torque, 1/rad. Tissue stretched until its torque no longer grows would be a constant force,
/// which a row with a stiffness cannot represent. With this stiffness the torque changes by 8 % at 10 rad/s and 120
/// substeps a second, and only removes energy. Elsewhere tissue is stiffer.
const LEAST_RISE: f64 = 1.0;
/// Tissue is slack below this power of e: it would give less than 1e−13 N·m. Most joints are in this range most of the
/// time.
const SLACK: f64 = -35.0;

/// Scale of a figure's strength.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrengthScale {
    /// Factor on every DOF, 0.01…100.
    pub all: f64,
    /// Factor per DOF, 0.01…100.
    #[serde(with = "crate::saved::array")]
    pub dof: [f64; DOF_COUNT],
    /// Percentile of strength among people of that sex, age and size, 5…95; 50 is the average.
    pub percentile: f64,
    /// Share of its strength that the figure is willing to use, 0…1; values below [`LEAST_EFFORT`] count as
    /// [`LEAST_EFFORT`].
    pub effort: f64,
}

/// Keeps every muscle from vanishing, so that limits stay on both sides of zero.
pub const LEAST_EFFORT: f64 = 0.01;

impl Default for StrengthScale {
    fn default() -> Self {
        Self {
            all: 1.0,
            dof: [1.0; DOF_COUNT],
            percentile: 50.0,
            effort: 1.0,
        }
    }
}

impl StrengthScale {
    /// Factors on the muscles of each direction, all multiplied by `further`. The percentile is not included: it is
    /// part of [`Strength`].
    pub fn muscles(&self, further: f64) -> MuscleScale {
        let (all, effort) = (self.all * further, self.effort.max(LEAST_EFFORT));
        MuscleScale(std::array::from_fn(|d| [all * self.dof[d] * effort; 2]))
    }
}

/// Factors on the muscles of each DOF for its positive and its negative direction, > 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MuscleScale(#[serde(with = "crate::saved::array")] pub [[f64; 2]; DOF_COUNT]);

impl Default for MuscleScale {
    fn default() -> Self {
        Self([[1.0; 2]; DOF_COUNT])
    }
}

pub use crate::body::provenance::Provenance;

/// One side of a DOF's passive tissue: `amplitude · exp(steepness · x)`, x the angle beyond `onset`, up to `cap`, then
/// linear to twice that.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Passive {
    amplitude: f64,
    steepness: f64,
    onset: f64,
    cap: f64,
    /// Angle beyond onset at which the cap is met, rad.
    capped_at: f64,
    /// Power of e below which it does not act, because its torque is less than [`FELT`].
    slack: f64,
}

impl Passive {
    fn new(amplitude: f64, steepness: f64, onset: f64, cap: f64) -> Self {
        Self {
            amplitude,
            steepness,
            onset,
            cap,
            capped_at: ln(cap / amplitude) / steepness,
            slack: ln(FELT / amplitude),
        }
    }
    /// Torque (N·m, ≥ 0) at `x` rad beyond the onset.
    #[inline]
    fn at(&self, x: f64) -> f64 {
        let over = x - self.capped_at;
        let power = self.steepness * x;
        if power < SLACK {
            0.0
        } else if over < 0.0 {
            self.amplitude * exp(power)
        } else {
            self.cap * (1.0 + (self.steepness * over).min(1.0))
        }
    }

    /// Rate at which the torque `now = self.at(x)` grows with the angle, N·m/rad.
    #[inline]
    fn slope(&self, x: f64, now: f64) -> f64 {
        let over = self.steepness * (x - self.capped_at);
        if over < 0.0 {
            self.steepness * now
        } else if over < 1.0 {
            self.steepness * self.cap
        } else {
            0.0
        }
    }

    /// Energy stored at `x` rad beyond the onset, J: the integral of [`Self::at`].
    fn stored(&self, x: f64) -> f64 {
        let (k, cap) = (self.steepness, self.cap);
        let over = x - self.capped_at;
        if over < 0.0 {
            return self.at(x) / k;
        }
        let linear = over.min(1.0 / k);
        cap * (1.0 / k + linear * (1.0 + 0.5 * k * linear) + 2.0 * (over - linear))
    }
}

/// Stretched tissue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretched {
    /// Torque away from the end of the range, N·m, ≥ 0.
    pub torque: f64,
    /// Rate at which the torque grows with the angle, N·m/rad, > 0.
    pub stiffness: f64,
}

/// Strength of one body: immutable, shared by every figure that has the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Strength {
    /// Muscles for the positive and for the negative direction of each DOF.
    muscle: [[Muscle; 2]; DOF_COUNT],
    /// Passive tissue at the lower and at the upper end of each DOF.
    tissue: [[Passive; 2]; DOF_COUNT],
    lower: [f64; DOF_COUNT],
    upper: [f64; DOF_COUNT],
    provenance: Vec<Vec<Provenance>>,
}

impl Strength {
    /// Strength of the average person that `body.profile` describes: the tables, scaled by sex, mass · g · height and
    /// age.
    ///
    /// Ages beyond 6…90 years count as the nearest of them. Allocates; offline.
    pub fn for_body(body: &Body) -> Self {
        Self::at_percentile(body, 50.0)
    }

    /// Strength of a person at this percentile among people of that sex, age and size; clamped to 5…95. Allocates;
    /// offline.
    pub fn at_percentile(body: &Body, percentile: f64) -> Self {
        let person = Person::of(body, percentile);
        let (groups, tissues) = (in_dof_order(&tables::TRUNK, &tables::ARM, &tables::LEG), {
            in_dof_order(
                &tables::TRUNK_TISSUE,
                &tables::ARM_TISSUE,
                &tables::LEG_TISSUE,
            )
        });
        let muscle: [[Muscle; 2]; DOF_COUNT] =
            std::array::from_fn(|d| groups[d].map(|g| person.muscle(&g)));
        let tissue = std::array::from_fn(|d| {
            // Tissue stretched at the upper end belongs to the muscle that pulls away from that end.
            let (upper, lower) = (body.upper[d], body.lower[d]);
            [
                passive(tissues[d][0], -lower, muscle[d][0].peak, -1.0),
                passive(tissues[d][1], upper, muscle[d][1].peak, 1.0),
            ]
        });
        let provenance = (0..DOF_COUNT)
            .map(|d| {
                let mut all = person.provenance(&groups[d], &muscle[d], &tissues[d], &tissue[d]);
                let row = fatigue::fatigue_row(d);
                for (quantity, value, unit) in [
                    ("fatigue coefficient F", row.fatigue, "1/s"),
                    ("recovery coefficient R", row.recovery, "1/s"),
                    ("rest multiplier r", row.rest, "1"),
                ] {
                    let origin = fatigue::FATIGUE_ORIGIN;
                    all.push(Provenance::new(row.joint, quantity, value, unit, origin));
                }
                all
            })
            .collect();
        Self {
            muscle,
            tissue,
            lower: body.lower,
            upper: body.upper,
            provenance,
        }
    }

    /// Torque available at this instant, N·m, equation (5) with ligaments (`docs/model.md#strength`).
    ///
    /// τ_max = T⁺ f_len(θ) f_vel(θ̇), τ_min = −T⁻ f_len(θ) f_vel(−θ̇). Within [`LIGAMENT_ZONE`] of a limit the torque
    /// that opposes it grows linearly to [`LIGAMENT_FACTOR`] times the isometric peak that drives into it; ligaments do
    /// not scale with strength.
    ///
    /// * `angles`: anatomical angles, rad; `rates`: joint rates, rad/s; both in DOF order.
    /// * `scale`: factors on the muscles, > 0.
    /// * `lower` < 0 < `upper`: results in DOF order.
    ///
    /// About a microsecond; no allocation.
    pub fn range(
        &self,
        angles: &[f64; DOF_COUNT],
        rates: &[f64; DOF_COUNT],
        scale: &MuscleScale,
        lower: &mut [f64; DOF_COUNT],
        upper: &mut [f64; DOF_COUNT],
    ) {
        for d in 0..DOF_COUNT {
            let (theta, rate) = (angles[d], rates[d]);
            let [plus, minus] = &self.muscle[d];
            let [scale_plus, scale_minus] = scale.0[d];
            let into_upper = 1.0 - (self.upper[d] - theta) * PER_ZONE;
            let into_lower = 1.0 - (theta - self.lower[d]) * PER_ZONE;
            upper[d] = scale_plus * plus.torque(theta, rate)
                + LIGAMENT_FACTOR * minus.peak * into_lower.clamp(0.0, 1.0);
            lower[d] = -(scale_minus * minus.torque(theta, -rate)
                + LIGAMENT_FACTOR * plus.peak * into_upper.clamp(0.0, 1.0));
        }
    }

    /// Torque of stretched tissue, N·m, in DOF order: elastic, with 10 % of internal damping; at most 2.2 isometric
    /// peaks.
    ///
    /// * `angles`: anatomical angles, rad; `rates`: joint rates, rad/s.
    ///
    /// No allocation.
    pub fn passive(
        &self,
        angles: &[f64; DOF_COUNT],
        rates: &[f64; DOF_COUNT],
        out: &mut [f64; DOF_COUNT],
    ) {
        for d in 0..DOF_COUNT {
            let [low, high] = &self.tissue[d];
            let damping = TISSUE_DAMPING * (rates[d] / TISSUE_SPEED).clamp(-1.0, 1.0);
            out[d] = low.at(-angles[d] - low.onset) * (1.0 - damping)
                - high.at(angles[d] - high.onset) * (1.0 + damping);
        }
    }

    /// Energy that stretched tissue stores, J: its torque without damping is the negative gradient.
    ///
    /// * `angles`: anatomical angles, rad.
    pub fn stored(&self, angles: &[f64; DOF_COUNT]) -> f64 {
        let ends = self.tissue.iter().zip(angles);
        ends.map(|([low, high], a)| low.stored(-a - low.onset) + high.stored(a - high.onset))
            .sum()
    }

    /// Tissue of DOF `d` (0…38) at its lower (`side` 0) or upper (1) end; `None` where it is slack.
    ///
    /// * `angle`, `rate`: anatomical angle, rad, and its rate, rad/s. `h`: time ahead over which the stiffness is the
    ///   mean, s.
    ///
    /// The torque is that of [`Self::passive`], N·m ≥ 0, at `angle`. No allocation.
    #[inline]
    pub fn stretched(
        &self,
        d: usize,
        side: usize,
        angle: f64,
        rate: f64,
        h: f64,
    ) -> Option<Stretched> {
        let tissue = &self.tissue[d][side];
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let (x, speed) = (sign * angle - tissue.onset, sign * rate);
        let way = h * speed;
        if tissue.steepness * (x + way.max(0.0)) < tissue.slack {
            return None;
        }
        let damped = 1.0 + TISSUE_DAMPING * (speed / TISSUE_SPEED).clamp(-1.0, 1.0);
        let now = tissue.at(x);
        let slope = if way.abs() > LEAST_WAY {
            (tissue.at(x + way) - now) / way
        } else {
            tissue.slope(x, now)
        };
        Some(Stretched {
            torque: damped * now,
            stiffness: damped * slope.max(LEAST_RISE * now),
        })
    }

    /// Origins of the numbers of DOF `dof` (0…38).
    pub fn provenance(&self, dof: usize) -> &[Provenance] {
        &self.provenance[dof]
    }

    /// The muscles as plain actuators with constant bounds, for formats that know no others: per DOF, the largest
    /// isometric torque over its range of angles in both directions, and the speed at which [`curve::VELOCITY_FLOOR`]
    /// of it remains, for the faster direction.
    ///
    /// Lengthening muscles give up to [`curve::ECCENTRIC_MOST`] times as much, shortening ones less; ligaments are not
    /// included.
    pub fn actuation(&self) -> Actuation {
        let side = |d: usize, k: usize| self.muscle[d][k].strongest(self.lower[d], self.upper[d]);
        let fastest = |d: usize, k: usize| self.muscle[d][k].velocity.fastest();
        Actuation {
            lower: std::array::from_fn(|d| -side(d, 1)),
            upper: std::array::from_fn(|d| side(d, 0)),
            speed: std::array::from_fn(|d| fastest(d, 0).max(fastest(d, 1))),
        }
    }

    /// Muscles of DOF `dof` (0…38) for its positive and its negative direction.
    pub fn muscles(&self, dof: usize) -> &[Muscle; 2] {
        &self.muscle[dof]
    }
}

/// Trunk, left arm, right arm, left leg, right leg.
fn in_dof_order<T: Copy>(trunk: &[T; 9], arm: &[T; 7], leg: &[T; 8]) -> [T; DOF_COUNT] {
    std::array::from_fn(|d| match d {
        0..9 => trunk[d],
        9..16 => arm[d - 9],
        16..23 => arm[d - 16],
        23..31 => leg[d - 23],
        _ => leg[d - 31],
    })
}

/// Tissue at the end where `sign · θ` is largest; `limit` is that of `sign · θ`, `cap` the antagonist's peak.
fn passive(tissue: Tissue, limit: f64, cap: f64, sign: f64) -> Passive {
    match tissue {
        Tissue::Measured(amplitude, steepness, onset) => {
            Passive::new(amplitude, steepness, sign * onset, cap)
        }
        Tissue::AtLimit(amplitude, steepness) => {
            Passive::new(amplitude, steepness, limit - 0.1, cap)
        }
        Tissue::Between(start, full) => {
            between(sign * start.to_radians(), sign * full.to_radians(), cap)
        }
        Tissue::Unknown => {
            let half = 15f64.to_radians();
            between(limit - half, limit + half, cap)
        }
    }
}

/// Tissue that gives 1 % of `cap` at `start` and all of it at `full` (rad, growing towards the limit).
fn between(start: f64, full: f64, cap: f64) -> Passive {
    Passive::new(0.01 * cap, ln(100.0) / (full - start), start, cap)
}

/// The factors by which the tables are scaled.
struct Person {
    sex: Sex,
    /// Share of the men's tables: 1 or 0 for adults.
    male: f64,
    age: f64,
    /// mass · g · height, N·m.
    mgh: f64,
    /// Standard deviations from the average person.
    deviations: f64,
}

impl Person {
    fn of(body: &Body, percentile: f64) -> Self {
        let p = body.profile;
        let age = p.age.clamp(6.0, 90.0);
        Self {
            sex: p.sex,
            male: male_share(p.sex, age),
            age,
            mgh: p.mass * tables::NORMALISING_GRAVITY * p.height,
            deviations: deviations(percentile),
        }
    }

    /// A number of the men's and of the women's table, mixed for a child.
    fn mixed(&self, of: impl Fn(usize) -> f64) -> f64 {
        mix(self.male, of(0), of(1))
    }

    fn age_factor(&self) -> f64 {
        tables::age_factor(self.sex, self.age) * tables::child_factor(self.age)
    }

    /// Strength of the percentile over the average in one group.
    fn percentile_factor(&self, group: &Group) -> f64 {
        let z = self.deviations;
        if z == 0.0 {
            return 1.0;
        }
        match group {
            Group::Leg(leg) => {
                let variation = self.mixed(|t| {
                    let (rows, sd) = (
                        &tables::ANDERSON[*leg as usize][t],
                        &tables::ANDERSON_DEVIATION[*leg as usize][t],
                    );
                    by_age(std::array::from_fn(|g| sd[g] / rows[g].c1), self.age)
                });
                1.0 + variation * z.clamp(-tables::MOST_DEVIATIONS, tables::MOST_DEVIATIONS)
            }
            Group::Other(a) => {
                let side = usize::from(z > 0.0);
                let end = self.mixed(|t| a.spread[t][side]);
                exp(ln(end) * z.abs() / FIVE_PERCENT)
            }
        }
    }

    fn row(&self, leg: Leg, age: f64) -> AndersonRow {
        let [m, f] = [0, 1].map(|t| at_age(&tables::ANDERSON[leg as usize][t], age));
        let c = |of: fn(&AndersonRow) -> f64| mix(self.male, of(&m), of(&f));
        AndersonRow {
            c1: c(|r| r.c1),
            c2: c(|r| r.c2),
            c3: c(|r| r.c3),
            c4: c(|r| r.c4),
            c5: c(|r| r.c5),
            c6: c(|r| r.c6),
        }
    }

    fn muscle(&self, group: &Group) -> Muscle {
        let mut muscle = match group {
            Group::Leg(leg) => {
                let mut muscle = anderson(*leg, &self.row(*leg, self.age), self.mgh);
                // Each row's C1 applies at that row's own posture, so levels are transferred at a posture that people
                // of all ages can reach.
                let young = anderson(*leg, &self.row(*leg, 0.0), self.mgh);
                let at = leg.reference_angle();
                let level = young.peak * young.angle.at(at) * self.age_factor();
                muscle.peak = level / muscle.angle.at(at);
                muscle
            }
            Group::Other(a) => self.other(a),
        };
        muscle.peak *= self.percentile_factor(group);
        muscle
    }

    fn other(&self, a: &Action) -> Muscle {
        let [peak, deviation] = a.bell.map(f64::to_radians);
        let angle = AngleFactor::Bell {
            peak,
            narrowness: 1.0 / deviation,
        };
        let level = self.mixed(|t| {
            let (height, mass) = tables::reference_body([Sex::Male, Sex::Female][t]);
            let reference = mass * tables::NORMALISING_GRAVITY * height;
            a.level[t] * self.mgh / reference * self.age_factor()
        });
        let [fastest, at_half, eccentric] = a.hill;
        Muscle {
            peak: level / angle.at(a.at.to_radians()),
            angle,
            velocity: VelocityFactor::hill(fastest, at_half, eccentric),
        }
    }

    fn provenance(
        &self,
        groups: &[Group; 2],
        muscles: &[Muscle; 2],
        tissues: &[Tissue; 2],
        passive: &[Passive; 2],
    ) -> Vec<Provenance> {
        let mut out = Vec::new();
        let mut add = |action, quantity, value: f64, unit, origin: Origin| {
            out.push(Provenance::new(action, quantity, value, unit, origin));
        };
        for (group, muscle) in groups.iter().zip(muscles) {
            let (name, level, shape, speed) = match group {
                Group::Leg(Leg::Plantarflexion) => (
                    Leg::Plantarflexion.name(),
                    tables::ANDERSON_ORIGIN,
                    tables::ANDERSON_ORIGIN,
                    tables::PLANTARFLEXION_ORIGIN,
                ),
                Group::Leg(leg) => (
                    leg.name(),
                    tables::ANDERSON_ORIGIN,
                    tables::ANDERSON_ORIGIN,
                    tables::ANDERSON_ORIGIN,
                ),
                Group::Other(a) => (a.name, a.level_origin, a.shape_origin, a.shape_origin),
            };
            let peak = match muscle.angle {
                AngleFactor::Cosine { peak, .. } | AngleFactor::Bell { peak, .. } => peak,
            };
            add(name, "isometric peak torque", muscle.peak, "N·m", level);
            if self.deviations != 0.0 {
                let factor = self.percentile_factor(group);
                let origin = tables::PERCENTILE_ORIGIN;
                add(
                    name,
                    "factor of the strength percentile",
                    factor,
                    "1",
                    origin,
                );
            }
            add(name, "angle of the peak", peak.to_degrees(), "deg", shape);
            let share = muscle.velocity.at(5.0);
            add(name, "share of it at 5 rad/s shortening", share, "1", speed);
            let share = muscle.velocity.at(-5.0);
            add(
                name,
                "share of it at 5 rad/s lengthening",
                share,
                "1",
                speed,
            );
        }
        let name = match groups[0] {
            Group::Leg(leg) => leg.name(),
            Group::Other(a) => a.name,
        };
        let origin = if self.age < 18.0 {
            tables::CHILD_ORIGIN
        } else {
            tables::AGE_ORIGIN
        };
        add(name, "age factor", self.age_factor(), "1", origin);
        let ends = [
            "passive torque at the lower onset",
            "passive torque at the upper onset",
        ];
        for k in 0..2 {
            let origin = match tissues[k] {
                Tissue::Unknown => tables::UNKNOWN_TISSUE_ORIGIN,
                Tissue::Between(..) => tables::BETWEEN_TISSUE_ORIGIN,
                Tissue::Measured(..) | Tissue::AtLimit(..) => tables::TISSUE_ORIGIN,
            };
            add(name, ends[k], passive[k].amplitude, "N·m", origin);
        }
        out
    }
}

/// The muscle of one row of Anderson 2007 for a person of `mgh` N·m, with the repairs of [`curve`].
fn anderson(leg: Leg, row: &AndersonRow, mgh: f64) -> Muscle {
    let eccentric = 1.1 + 0.2 * row.c6;
    let velocity = if leg == Leg::Plantarflexion {
        let [fastest, at_half] = tables::PLANTARFLEXION_HILL;
        VelocityFactor::hill(fastest, at_half, eccentric)
    } else {
        VelocityFactor::anderson(row.c4, row.c5, eccentric)
    };
    Muscle {
        peak: row.c1 * mgh,
        angle: AngleFactor::Cosine {
            width: row.c2,
            peak: row.c3,
        },
        velocity,
    }
}

/// Standard normal quantile of 95 %.
const FIVE_PERCENT: f64 = 1.644_853_626_951_472_2;

/// Standard deviations from the mean at a percentile of a normal distribution, clamped to 5…95; 0 at 50.
///
/// The series of the inverse error function to the ninth order, with a term that makes it exact at the ends; off by
/// less than 0.01 between.
fn deviations(percentile: f64) -> f64 {
    let x = (percentile.clamp(5.0, 95.0) - 50.0) / 45.0;
    let series = |x: f64| {
        // √2·erf⁻¹(0.9 x)
        let u = 2.506_628_274_631_000_5 * 0.45 * x;
        let u2 = u * u;
        u * (1.0
            + u2 * (1.0 / 6.0
                + u2 * (7.0 / 120.0 + u2 * (127.0 / 5040.0 + u2 * (4369.0 / 362_880.0)))))
    };
    let x4 = x * x * x * x;
    series(x) + (FIVE_PERCENT - series(1.0)) * x * x4 * x4 * x4
}

/// Values of the three groups of [`tables::ANDERSON`] at an age between them: smoothstep between their middle ages.
fn by_age(v: [f64; 3], age: f64) -> f64 {
    let [young, middle, senior] = tables::ANDERSON_AGE;
    let (a, b) = (rise(age, (young, middle)), rise(age, (middle, senior)));
    v[0] + a * (v[1] - v[0]) + b * (v[2] - v[1])
}

/// Row at an age between the groups, so that nothing jumps at a birthday.
fn at_age(rows: &[AndersonRow; 3], age: f64) -> AndersonRow {
    let mix = |of: fn(&AndersonRow) -> f64| by_age([0, 1, 2].map(|g| of(&rows[g])), age);
    AndersonRow {
        c1: mix(|r| r.c1),
        c2: mix(|r| r.c2),
        c3: mix(|r| r.c3),
        c4: mix(|r| r.c4),
        c5: mix(|r| r.c5),
        c6: mix(|r| r.c6),
    }
}
