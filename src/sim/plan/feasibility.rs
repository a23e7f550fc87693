//! Whether a body can do a motion on its feet: the forces that inverse dynamics asks of the ground, compared with those
//! that the ground can give. See `docs/locomotion.md#balance`.
//!
//! A recording is consistent with the dynamics of a body if its zero-moment point stays inside the support polygon and
//! the wrench that its acceleration needs lies in the friction cones of the planted feet. The distance from that tells,
//! before anything is simulated, how hard the recording will be to follow. Pure, offline; nothing here changes a
//! motion.

use super::foot_lock::{AnklePose, FootPlacement, Sole};
use super::pelvis_shift::{GroundWrench, mass_track};
use crate::body::{Body, Posture};
use crate::math::nnls::nnls;
use crate::math::polygon::{hull, margin};
use crate::math::runs::stretches;
use crate::math::{Vec3, trig};
use crate::motion::GRAVITY;
use crate::motion::leg_ik::forward;
use crate::plan::params::{balance, feasibility, pelvis, stop};

/// Root mean square and largest value of a quantity over a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Root mean square.
    pub rms: f64,
    /// Largest value.
    pub max: f64,
}

impl Spread {
    fn of(values: &[f64]) -> Self {
        let n = values.len().max(1) as f64;
        Self {
            rms: (values.iter().map(|v| v * v).sum::<f64>() / n).sqrt(),
            max: values.iter().copied().fold(0.0, f64::max),
        }
    }
}

/// How far a motion is from one that a body on its feet can do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Consistency {
    /// Share of the samples on feet whose zero-moment point is outside the support polygon.
    pub outside: f64,
    /// Distance outside, 0 for samples inside, m.
    pub distance: Spread,
    /// Force that the feet cannot give within friction, over weight. Includes flight, where the whole force is of this
    /// kind.
    pub force: Spread,
    /// Moment about the centre of mass that the feet cannot give, over weight × 1 m.
    pub moment: Spread,
    /// Share of the samples with no foot on the floor.
    pub flight: f64,
    /// Share of the samples in which something other than the feet carries the body; none of the other figures includes
    /// them.
    pub carried: f64,
    /// Number of stances.
    pub stances: usize,
    /// Largest distance of a foot from its mean place within a stance, m: mean over stances, and maximum.
    pub slip: (f64, f64),
    /// Largest depth of a sole under the floor and largest height over it while its foot is planted, m.
    pub floor: (f64, f64),
}

/// Measures a motion.
///
/// * `postures`: samples, floor at z = 0, `rate_hz` samples per second.
/// * `label`: feet that the motion means to have on the floor (left, right), per sample.
///
/// The first and last two samples have no acceleration of their own and repeat their neighbour. O(n); allocates.
pub fn consistency(
    body: &Body,
    postures: &[Posture],
    label: &[[bool; 2]],
    rate_hz: f64,
) -> Consistency {
    let n = postures.len().min(label.len());
    let track = mass_track(body, &postures[..n], rate_hz);
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let weight = GRAVITY * body.segments.iter().map(|s| s.mass).sum::<f64>();
    let seated = pelvis::SEATED * body.standing_root_height();
    let feet = postures[..n].iter().map(|p| standing(body, &soles, p));
    let feet: Vec<_> = feet.collect();
    let (mut outside, mut force, mut moment) = (Vec::new(), Vec::new(), Vec::new());
    let mut out = Consistency::default();
    let mut corners = Vec::new();
    for i in 0..n {
        if postures[i].root_position.z < seated {
            out.carried += 1.0 / n as f64;
            continue;
        }
        corners.clear();
        for s in (0..2).filter(|s| label[i][*s]) {
            let (at, low) = &feet[i][s];
            soles[s].footprint(at, &mut corners);
            out.floor.0 = out.floor.0.max(-low);
            out.floor.1 = out.floor.1.max(*low);
        }
        if label[i] == [false; 2] {
            out.flight += 1.0 / n as f64;
        }
        let polygon = hull(&corners);
        if !polygon.is_empty() && track.load[i] > balance::LEAST_LOAD {
            outside.push((-margin(&polygon, track.zmp[i])).max(0.0));
        }
        let GroundWrench {
            force: f,
            moment: m,
        } = track.wrench[i];
        let (f, m) = lacking(
            &polygon,
            track.com[i],
            f * (1.0 / weight),
            m * (1.0 / weight),
        );
        force.push(f);
        moment.push(m);
    }
    out.outside = outside.iter().filter(|d| **d > 0.0).count() as f64 / outside.len().max(1) as f64;
    out.distance = Spread::of(&outside);
    out.force = Spread::of(&force);
    out.moment = Spread::of(&moment);
    let mut sum = 0.0;
    for s in 0..2 {
        let on: Vec<bool> = label[..n].iter().map(|l| l[s]).collect();
        for (i, j) in stretches(&on) {
            let place = |k: usize| feet[k][s].0.place;
            let mean = (i..j).fold(Vec3::zero(), |m, k| m + place(k)) * (1.0 / (j - i) as f64);
            let far = (i..j).map(|k| (place(k) - mean).norm()).fold(0.0, f64::max);
            out.stances += 1;
            sum += far;
            out.slip.1 = out.slip.1.max(far);
        }
    }
    out.slip.0 = sum / out.stances.max(1) as f64;
    out
}

/// Unsupported force and moment of a motion sampled at [`stop::RATE`]: the sum of their root mean squares over weight
/// (and 1 m).
pub(crate) fn infeasibility(body: &Body, postures: &[Posture], label: &[[bool; 2]]) -> f64 {
    let asked = consistency(body, postures, label, stop::RATE);
    asked.force.rms + asked.moment.rms
}

/// Placement of each planted foot, and the height of its lowest point, m.
fn standing(body: &Body, soles: &[Sole; 2], posture: &Posture) -> [(FootPlacement, f64); 2] {
    let poses = forward(body, posture);
    [0, 1].map(|side| {
        let at = soles[side].footing(AnklePose::of(&poses, side));
        (at, soles[side].lowest_at(&poses))
    })
}

/// Remainder of a wrench (force, moment about `com`) after the best forces in the friction cones at the corners of
/// `polygon`: lengths of force and moment, in the units given.
fn lacking(polygon: &[[f64; 2]], com: Vec3, force: Vec3, moment: Vec3) -> (f64, f64) {
    let mut columns = Vec::with_capacity(polygon.len() * feasibility::CONE_EDGES);
    for p in polygon {
        let arm = Vec3::on_floor(*p) - com;
        for k in 0..feasibility::CONE_EDGES {
            let (s, c) =
                trig::sin_cos(std::f64::consts::TAU * k as f64 / feasibility::CONE_EDGES as f64);
            let f = Vec3 {
                x: feasibility::FRICTION * c,
                y: feasibility::FRICTION * s,
                z: 1.0,
            };
            let m = arm.cross(f);
            columns.push([f.x, f.y, f.z, m.x, m.y, m.z]);
        }
    }
    let (f, m) = (force.to_array(), moment.to_array());
    let mut rest = [f[0], f[1], f[2], m[0], m[1], m[2]];
    let pushes = nnls(&columns, &rest, feasibility::RIDGE);
    for (c, x) in columns.iter().zip(&pushes) {
        for (r, a) in rest.iter_mut().zip(c) {
            *r -= a * x;
        }
    }
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length(&rest[..3]), length(&rest[3..]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::FEET;
    use crate::motion::builtin::at_ease;
    use crate::motion::leg_ik::center_of_mass;

    #[test]
    fn standing_still_lacks_nothing() {
        let body = Body::adult_man();
        let c = consistency(&body, &[at_ease(&body); 60], &[[true; 2]; 60], 60.0);
        assert_eq!(
            (c.outside, c.distance.max, c.flight, c.carried),
            (0.0, 0.0, 0.0, 0.0)
        );
        assert!(c.force.max < 1e-6 && c.moment.max < 1e-6, "{c:?}");
        assert!(
            c.slip.1 < 1e-12 && c.floor.0 < 1e-3 && c.floor.1 < 1e-3,
            "{c:?}"
        );
        assert_eq!(c.stances, 2);
    }

    #[test]
    fn a_lean_beyond_the_soles_is_found_again() {
        // Method: the trunk of a standing man is moved forward so that his centre of mass lies a known distance in
        // front of the soles.
        let body = Body::adult_man();
        let mut posture = at_ease(&body);
        let feet = forward(&body, &posture);
        let feet = FEET.map(|s| feet[s.index()]);
        let soles = [Sole::new(&body, 0), Sole::new(&body, 1)];
        let mut corners = Vec::new();
        for (sole, (at, _)) in soles.iter().zip(standing(&body, &soles, &posture)) {
            sole.footprint(&at, &mut corners);
        }
        let front = corners
            .iter()
            .map(|c| c[0])
            .fold(f64::NEG_INFINITY, f64::max);
        posture.root_position.z -= 0.15; // bent knees reach farther
        for lean in [0.02, 0.05, 0.1] {
            // The legs stay where they are, so the centre of mass follows the pelvis only part of the way.
            for _ in 0..30 {
                let com = center_of_mass(&body, &forward(&body, &posture)).x;
                posture.root_position.x += front + lean - com;
                for (side, pose) in feet.iter().enumerate() {
                    crate::motion::leg_ik::solve_leg(&body, &mut posture, side == 0, *pose, 0.0);
                }
            }
            let c = consistency(&body, &[posture; 30], &[[true; 2]; 30], 60.0);
            assert_eq!(c.outside, 1.0);
            assert!((c.distance.max - lean).abs() < 1e-6, "{lean}: {c:?}");
            assert!((c.distance.rms - lean).abs() < 1e-6, "{lean}: {c:?}");
            // Weight at the edge of the soles leaves a moment of at most weight × lean.
            assert!(
                c.moment.max < lean && c.moment.max > 0.3 * lean,
                "{lean}: {c:?}"
            );
        }
    }

    #[test]
    fn in_the_air_only_free_fall_is_consistent() {
        let body = Body::adult_man();
        let rate = 120.0;
        let at = |g: f64| -> Vec<Posture> {
            (0..40)
                .map(|i| {
                    let t = f64::from(i) / rate;
                    let mut p = at_ease(&body);
                    p.root_position.z += 0.5 + 1.5 * t - 0.5 * g * t * t;
                    p
                })
                .collect()
        };
        let air = [[false; 2]; 40];
        let fall = consistency(&body, &at(GRAVITY), &air, rate);
        assert!(
            (fall.flight - 1.0).abs() < 1e-9 && fall.force.max < 1e-6,
            "{fall:?}"
        );
        let float = consistency(&body, &at(0.0), &air, rate);
        assert!((float.force.rms - 1.0).abs() < 1e-6, "{float:?}");
    }
}
