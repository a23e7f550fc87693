//! Strength that motions require: the future work of the paper, which would derive a person's strength from observed
//! motion.
//!
//! Inverse dynamics of prepared clips with the forces of the floor ([`forecast::needed`]) gives the torque of every
//! joint, with its angle and speed. Recordings are noisy, so this is made robust twice: torques are means over 0.1 s
//! (the clips themselves are low-passed at 6 Hz when they are prepared), and a quantile counts for each direction of
//! each DOF, not the peak. If it is beyond the curves of a profile, [`Envelope::merged`] scales that muscle up; the
//! curves keep their shape, and no muscle becomes weaker: a motion shows what a person can do, not what they cannot.

use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::body::{Body, DOF_COUNT, Links};
use sinew_physics::figure::StrengthScale;
use sinew_physics::forecast::{self, Needed};
use sinew_physics::motion::Clip;
use sinew_physics::strength::{MuscleScale, Strength};

/// Width of an angle cell, rad (15°).
const ANGLE_CELL: f64 = std::f64::consts::PI / 12.0;
/// A joint that turns more slowly than this holds still, rad/s.
const STILL: f64 = 0.5;
/// Largest factor that a strength scale accepts.
const MOST: f64 = 100.0;

/// Speed at which the muscle shortens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Speed {
    /// It is stretched.
    Lengthening,
    /// It hardly changes its length.
    Still,
    /// It shortens.
    Shortening,
}

/// One cell of the envelope: the torque of one direction of a DOF at these angles and speeds.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Cell {
    /// DOF, as `sinew bodies` names it.
    pub dof: &'static str,
    /// Whether the muscles are those of its positive direction.
    pub positive: bool,
    /// Middle of the angles, degrees.
    pub angle_deg: f64,
    /// Speed at which they shorten.
    pub speed: Speed,
    /// Quantile of the torque, N·m, ≥ 0.
    pub torque: f64,
    /// Torque that the profile's curves give at the angle and speed of that sample, N·m.
    pub available: f64,
    /// Samples (1/30 s) in the cell.
    pub samples: usize,
}

/// Torque over angle and speed of every DOF, and its share of the strength of the profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    /// Quantile of torque over strength, positive and negative direction of each DOF; 0 where none is needed.
    pub ratio: [[f64; 2]; DOF_COUNT],
    /// Cells in DOF order.
    pub cells: Vec<Cell>,
}

/// One sample of one direction of one DOF.
#[derive(Clone, Copy)]
struct StrengthSample {
    angle: f64,
    /// Rate of shortening, rad/s.
    rate: f64,
    torque: f64,
    available: f64,
}

/// The `share` quantile (0…1) of values that are sorted in ascending order.
fn rank(count: usize, share: f64) -> usize {
    ((share * count as f64).ceil() as usize).clamp(1, count.max(1)) - 1
}

impl Envelope {
    /// The torque that `clips` require of the muscles of `body`.
    ///
    /// * `links`: the body with the loads that it carries.
    /// * `strength`: the curves of its profile.
    /// * `quantile`: of the samples of all clips together, 0…1.
    ///
    /// Pure; some ms per second of motion; allocates.
    pub fn of(
        body: &Body,
        links: &Links,
        strength: &Strength,
        clips: &[&Clip],
        quantile: f64,
    ) -> Self {
        let mut all: Vec<Needed> = Vec::new();
        for clip in clips {
            all.extend(forecast::needed(body, links, strength, clip));
        }
        let rested = MuscleScale::default();
        let mut uses: Vec<[Vec<StrengthSample>; 2]> =
            (0..DOF_COUNT).map(|_| [Vec::new(), Vec::new()]).collect();
        for n in &all {
            let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
            strength.range(&n.angle, &n.rate, &rested, &mut lower, &mut upper);
            for d in 0..DOF_COUNT {
                let side = usize::from(n.torque[d] < 0.0);
                let sign = if side == 0 { 1.0 } else { -1.0 };
                uses[d][side].push(StrengthSample {
                    angle: n.angle[d],
                    rate: sign * n.rate[d],
                    torque: n.torque[d].abs(),
                    available: if side == 0 { upper[d] } else { -lower[d] },
                });
            }
        }
        let mut out = Self {
            ratio: [[0.0; 2]; DOF_COUNT],
            cells: Vec::new(),
        };
        for (d, sides) in uses.iter_mut().enumerate() {
            for (side, uses) in sides.iter_mut().enumerate() {
                // The quantile is over all samples: in those missing here the muscles of this direction rest.
                let mut ratios: Vec<f64> = uses.iter().map(|u| u.torque / u.available).collect();
                ratios.resize(all.len(), 0.0);
                ratios.sort_by(f64::total_cmp);
                let at = rank(ratios.len(), quantile);
                out.ratio[d][side] = ratios.get(at).copied().unwrap_or(0.0);
                out.add_cells(d, side == 0, uses, quantile);
            }
        }
        out
    }

    fn add_cells(&mut self, d: usize, positive: bool, uses: &mut [StrengthSample], quantile: f64) {
        let speed = |u: &StrengthSample| match u.rate {
            r if r > STILL => Speed::Shortening,
            r if r < -STILL => Speed::Lengthening,
            _ => Speed::Still,
        };
        let cell = |u: &StrengthSample| ((u.angle / ANGLE_CELL).floor() as i64, speed(u));
        uses.sort_by(|a, b| cell(a).cmp(&cell(b)).then(a.torque.total_cmp(&b.torque)));
        for group in uses.chunk_by(|a, b| cell(a) == cell(b)) {
            let (angle, speed) = cell(&group[0]);
            let chosen = group[rank(group.len(), quantile)];
            self.cells.push(Cell {
                dof: DOF_NAMES[d],
                positive,
                angle_deg: ((angle as f64 + 0.5) * ANGLE_CELL).to_degrees(),
                speed,
                torque: chosen.torque,
                available: chosen.available,
                samples: group.len(),
            });
        }
    }

    /// The profile's strength, with those muscles scaled up that gave more in the motions.
    ///
    /// * `percentile`: that of the curves.
    /// * `margin`: factor on the required torque (feedback takes some), ≥ 1.
    pub fn merged(&self, percentile: f64, margin: f64) -> StrengthScale {
        StrengthScale {
            percentile,
            dof: self
                .ratio
                .map(|[a, b]| (margin * a.max(b)).clamp(1.0, MOST)),
            ..StrengthScale::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_physics::motion::builtin::builtin;

    fn of(all: f64) -> Envelope {
        let body = Body::adult_man();
        let clip = builtin(&body, "squat").expect("built in");
        let mut links = Links::new(&body);
        let chest = sinew_physics::body::SegmentId::from_name("chest").expect("a chest");
        links.add_load(chest, sinew_physics::math::Vec3::Z * 0.2, all);
        Envelope::of(&body, &links, &Strength::for_body(&body), &[&clip], 0.98)
    }

    #[test]
    fn more_load_needs_more_and_what_suffices_is_left_alone() {
        let (plain, loaded) = (of(0.0), of(80.0));
        let knee = DOF_NAMES
            .iter()
            .position(|n| *n == "r_knee_flexion")
            .expect("a knee");
        assert!(plain.ratio[knee][1] > 0.1, "{:?}", plain.ratio[knee]);
        assert!(loaded.ratio[knee][1] > 1.5 * plain.ratio[knee][1]);
        assert_eq!(plain.merged(50.0, 1.0).dof[knee], 1.0);
        let scale = loaded.merged(50.0, 1.1);
        assert!((scale.dof[knee] - (1.1 * loaded.ratio[knee][1]).max(1.0)).abs() < 1e-12);
        // The merged strength covers everything that the person has done once.
        for (f, [a, b]) in scale.dof.iter().zip(loaded.ratio) {
            assert!(a.max(b) <= *f);
        }
    }

    #[test]
    fn cells_hold_every_sample_of_their_direction() {
        let e = of(0.0);
        let knee: Vec<&Cell> = e
            .cells
            .iter()
            .filter(|c| c.dof == "l_knee_flexion")
            .collect();
        assert!(knee.len() > 3, "{knee:?}");
        let samples: usize = knee.iter().map(|c| c.samples).sum();
        let other: usize = (e.cells.iter().filter(|c| c.dof == "waist_flexion"))
            .map(|c| c.samples)
            .sum();
        assert_eq!(samples, other);
        assert!(e.cells.iter().all(|c| c.torque >= 0.0 && c.available > 0.0));
    }
}
