//! The prepared motion: feet that stand still where they should, and the zero-moment point.

use crate::corpus::recorded::{Fit, Preparation, RetargetOptions, Truth, fits, fitted, man};
use sinew_physics::body::topology::{FEET, NV};
use sinew_physics::body::{Body, Links, Posture};
use sinew_physics::dynamics::{ExternalForces, Kinematics, RneaWorkspace, rnea};
use sinew_physics::math::Vec3;
use sinew_physics::math::polygon::{hull, margin};
use sinew_physics::motion::Clip;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::motion::target::Target;
use sinew_physics::plan::foot_lock::Sole;

/// Gravity for which motions are prepared, m/s².
const GRAVITY: f64 = 9.81;
/// Height below which a point of a sole touches the floor, m.
const TOUCHES: f64 = 0.005;

/// Contact points of a foot in the world: those of the foot, then those of the toes.
pub fn sole(body: &Body, soles: &[Sole; 2], posture: &Posture, side: usize) -> Vec<Vec3> {
    soles[side].points_at(&forward(body, posture)).collect()
}

pub fn soles(body: &Body) -> [Sole; 2] {
    [Sole::new(body, 0), Sole::new(body, 1)]
}

#[test]
fn a_point_of_each_planted_foot_stands_still() {
    let body = man();
    let soles = soles(&body);
    for f in fits() {
        let clip = &f.fitted.clip;
        let mut worst = (0.0f64, 0.0);
        for i in 1..clip.len() {
            for side in 0..2 {
                if !(clip.planted(i - 1)[side] && clip.planted(i)[side]) {
                    continue;
                }
                // A foot that rolls turns about its edge: the stillest point of its sole counts.
                let [a, b] = [i - 1, i].map(|k| sole(&body, &soles, clip.posture(k), side));
                let step = a
                    .iter()
                    .zip(&b)
                    .map(|(p, q)| (*p - *q).norm())
                    .fold(f64::INFINITY, f64::min);
                let speed = step * clip.rate_hz();
                if speed > worst.0 {
                    worst = (speed, f.time(i));
                }
            }
        }
        // While a foot rolls, its centre of rotation moves from the heel's edge to the toe joint and passes between
        // contact points.
        let most = if f.motion.script.kind == "run" {
            0.15
        } else {
            0.065
        };
        assert!(
            worst.0 < most,
            "{}: {} m/s at {} s",
            f.what(),
            worst.0,
            worst.1
        );
    }
}

#[test]
fn soles_stay_out_of_the_floor() {
    // The clip on the floor is in `after_reading_fixes.rs`.
    for f in fits().filter(|f| f.motion.script.kind != "floor") {
        let (low, when) = lowest(f);
        assert!(
            low > -1e-3,
            "{}: sole {low} m over the floor at {when} s",
            f.what()
        );
    }
}

/// Least height to which a whole swing raises the sole, m (docs/locomotion.md#foot-lock).
const CLEARANCE: f64 = 0.015;

#[test]
fn swinging_feet_clear_the_floor() {
    let body = man();
    let soles = soles(&body);
    let mut swings = 0;
    // In a noisy file, a standing foot may lose the floor for a moment.
    for f in fits().filter(|f| f.motion.script.kind == "walk" && !f.noisy()) {
        let clip = &f.fitted.clip;
        for side in 0..2 {
            let (mut top, mut stood) = (0.0f64, false);
            for (posture, planted) in clip.samples() {
                if !planted[side] {
                    let points = sole(&body, &soles, posture, side);
                    let low = points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
                    top = top.max(low);
                    continue;
                }
                // A swing at the start of the clip is not whole.
                if stood && top > 0.0 {
                    assert!(top > CLEARANCE, "{}: foot {side} by {top} m", f.what());
                    swings += 1;
                }
                (top, stood) = (0.0, true);
            }
        }
    }
    assert!(swings > 150, "{swings}");
}

/// Height of the lowest contact point of the feet over a whole clip, m, and its time, s.
pub fn lowest(f: &Fit) -> (f64, f64) {
    let body = man();
    let soles = soles(&body);
    let clip = &f.fitted.clip;
    let mut low = (0.0f64, 0.0);
    for i in 0..clip.len() {
        for side in 0..2 {
            let z = sole(&body, &soles, clip.posture(i), side)
                .iter()
                .map(|p| p.z)
                .fold(f64::INFINITY, f64::min);
            if z < low.0 {
                low = (z, f.time(i));
            }
        }
    }
    low
}

/// Largest error of the distance between successive footholds, m, against the truth in the body's size.
fn foothold_error(body: &Body, f: &Fit) -> f64 {
    let (clip, scale) = (&f.fitted.clip, f.fitted.report.size.scale);
    let at: Vec<(Vec3, Vec3)> = f
        .truth()
        .footholds()
        .iter()
        .filter(|h| h.until - h.from > 0.1)
        .map(|h| {
            let t = 0.5 * (h.from + h.until);
            let posture = clip.sample(t).posture;
            let place = Vec3 {
                x: h.x,
                y: h.y,
                z: 0.0,
            };
            (
                forward(body, &posture)[FEET[h.side].index()].0,
                place * scale,
            )
        })
        .collect();
    let flat = |v: Vec3| (v.x * v.x + v.y * v.y).sqrt();
    at.windows(2)
        .map(|w| (flat(w[1].0 - w[0].0) - flat(w[1].1 - w[0].1)).abs())
        .fold(0.0, f64::max)
}

#[test]
fn footholds_are_those_of_the_truth_in_the_bodys_size() {
    let body = man();
    for f in fits() {
        let off = foothold_error(&body, f);
        // The jog's and the hops' feet are on their toes in the middle of a stance. Noisy files slide by up to 0.2 m/s.
        let most = match (f.noisy(), f.motion.script.kind) {
            (true, _) => 0.075,
            (_, "run" | "jump") => 0.012,
            _ => 0.002,
        };
        assert!(off < most, "{}: footholds are off by {off} m", f.what());
    }
}

#[test]
fn feet_carry_every_motion_but_the_one_on_the_floor() {
    for f in fits() {
        let carried = f.fitted.report.balance.carried;
        if f.motion.script.kind == "floor" {
            assert!(carried > 0.35 && carried < 0.75, "{}: {carried}", f.what());
        } else {
            assert!(carried < 0.03, "{}: {carried}", f.what());
        }
    }
}

/// Zero-moment point of a motion at a time and the load on the floor, weights, from inverse dynamics.
fn pressure_point(links: &Links, target: &Target) -> (f64, [f64; 2]) {
    let mut kin = Kinematics::default();
    kin.set_state(links, &target.state());
    let mut wrench = [0.0; NV];
    rnea(
        links,
        &kin,
        &target.velocity,
        &target.acceleration,
        ExternalForces::gravity(GRAVITY),
        &mut RneaWorkspace::default(),
        &mut wrench,
    );
    let r = target.posture.root_position;
    let [mx, my, _, fx, fy, fz] = [0, 1, 2, 3, 4, 5].map(|i: usize| wrench[i]);
    let weight = links.mass.iter().sum::<f64>() * GRAVITY;
    let p = [r.x - (my + r.z * fx) / fz, r.y + (mx - r.z * fy) / fz];
    (fz / weight, p)
}

/// Extent to which a motion requires the floor to pull.
struct Outside {
    /// Time during which its zero-moment point is outside the support polygon, s.
    time: f64,
    /// Farthest that this drives the capture point within half a second, m.
    drift: f64,
}

/// Measures a motion with its lead-in and lead-out, on the points of planted feet that touch the floor.
fn outside(body: &Body, clip: &Clip) -> Outside {
    let (links, soles) = (Links::new(body), soles(body));
    let (h, lead) = (1.0 / clip.rate_hz(), clip.lead_in());
    let mut excess = Vec::new();
    // Where a recording is cut in motion, differences at its very ends are not those of the motion.
    for i in 2..clip.samples().len() - 2 {
        let t = clip.sample(i as f64 * h - lead);
        let (load, p) = pressure_point(&links, &t);
        let mut corners = Vec::new();
        for side in (0..2).filter(|s| t.planted[*s]) {
            let points = sole(body, &soles, &t.posture, side);
            corners.extend(points.iter().filter(|p| p.z < TOUCHES).map(|p| [p.x, p.y]));
        }
        let far = if corners.is_empty() {
            0.0
        } else {
            -margin(&hull(&corners), p)
        };
        excess.push(load.max(0.0) * far.max(0.0));
    }
    let omega = (GRAVITY / body.standing_root_height()).sqrt();
    let sums = excess.windows((0.5 / h) as usize);
    let sums = sums.map(|w| w.iter().sum::<f64>());
    Outside {
        time: h * excess.iter().filter(|e| **e > 0.0).count() as f64,
        drift: omega * h * sums.fold(0.0, f64::max),
    }
}

/// Time around each touch-down and each lift-off in which smoothing at 6 Hz mixes the motion before and after it, s.
const BLURRED: f64 = 0.05;
/// Longest time for which the zero-moment point of a motion may be outside because of that, s.
fn most_outside(name: &str) -> f64 {
    let holds = Truth::of(name).footholds();
    let steps = holds.iter().filter(|h| h.from > 0.0).count();
    2.0 * BLURRED * steps as f64
}

/// Distance that the plan keeps from the edge of a sole, m: an error of the capture point that the soles can correct.
const INSET: f64 = 0.04;

/// The floor would have to pull only while one foot takes over from the other, and never long or far enough to require
/// other footholds.
#[test]
fn the_zero_moment_point_stays_inside_the_support_polygon() {
    let body = man();
    let options = |preparation| RetargetOptions {
        preparation,
        ..RetargetOptions::default()
    };
    let mut seen = 0;
    // A lying body is not carried by its feet, and running needs more than feet can give (docs/limits.md).
    for f in fits().filter(|f| !["floor", "run"].contains(&f.motion.script.kind)) {
        let what = f.what();
        let o = outside(&body, &f.fitted.clip);
        let most = most_outside(&f.motion.script.name);
        assert!(o.time <= most, "{what}: outside for {} of {most} s", o.time);
        let most = if f.noisy() { 2.0 * INSET } else { INSET };
        assert!(
            o.drift <= most,
            "{what}: the capture point drifts by {} m",
            o.drift
        );
        seen += 1;
    }
    assert!(seen > 30, "{seen}");
    // The measure detects the effect of balance.
    let unbalanced = Preparation {
        balance: false,
        ..Preparation::default()
    };
    for name in ["walk-normal", "walk-fast"] {
        let clip = fitted(name, "vrm", &body, &options(unbalanced)).clip;
        let o = outside(&body, &clip);
        assert!(o.time > most_outside(name), "{name}: {} s", o.time);
    }
}
