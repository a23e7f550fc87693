//! The prepared motion: feet, zero-moment point, symmetries.

use crate::dialect::{self, dialect};
use crate::recorded::{Fit, RetargetOptions, bvh, fits, man, motion};
use sinew::sim::body::angles::anatomical_angles;
use sinew::sim::body::topology::{DOF_COUNT, DOF_NAMES, L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew::sim::body::{Body, Posture};
use sinew::sim::math::{Quat, Vec3};
use sinew::sim::motion::Bvh;
use sinew::sim::motion::leg_ik::forward;
use sinew::sim::plan::foot_lock::Sole;
use sinew::sim::retarget::Retargeted;
use sinew::sim::retarget::retarget;

const FOOT: [usize; 2] = [L_FOOT.index(), R_FOOT.index()];
const TOES: [usize; 2] = [L_TOES.index(), R_TOES.index()];

/// Contact points of a foot in the world: those of the foot, then those of the toes.
fn sole(body: &Body, soles: &[Sole; 2], posture: &Posture, side: usize) -> Vec<Vec3> {
    let poses = forward(body, posture);
    let at = |segment: usize, p: &Vec3| poses[segment].0 + poses[segment].1.rotate(*p);
    let foot = soles[side].foot_points().iter().map(|p| at(FOOT[side], p));
    foot.chain(soles[side].toe_points().iter().map(|p| at(TOES[side], p)))
        .collect()
}

fn soles(body: &Body) -> [Sole; 2] {
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
        // While a foot rolls, the point that it turns about moves from the heel's edge to the toe joint and passes
        // between contact points.
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
            (forward(body, &posture)[FOOT[h.side]].0, place * scale)
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
fn the_zero_moment_point_stays_inside_the_planted_feet() {
    for f in fits().filter(|f| f.motion.script.kind != "run") {
        let z = f.fitted.report.balance.zmp_outside.1;
        let most = if f.motion.script.kind == "jump" {
            0.004
        } else {
            0.0013
        };
        assert!(z.mean < most && z.p95 < 0.008, "{}: {z:?}", f.what());
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

fn fit(bvh: &Bvh) -> Retargeted {
    retarget(bvh, &man(), &RetargetOptions::default()).unwrap()
}

/// The posture that a mirror shows: y against −y, left against right.
fn mirrored(p: &Posture) -> (Vec3, Quat, [f64; DOF_COUNT]) {
    let a = anatomical_angles(p);
    let other = |name: &str| match name.split_at(2) {
        ("l_", rest) => format!("r_{rest}"),
        ("r_", rest) => format!("l_{rest}"),
        _ => name.to_owned(),
    };
    let angles = std::array::from_fn(|k| {
        let name = DOF_NAMES[k];
        let from = DOF_NAMES.iter().position(|n| *n == other(name)).unwrap();
        // Limbs are signed alike on both sides; the trunk leans and turns the other way.
        let central = !(name.starts_with("l_") || name.starts_with("r_"));
        if central && (name.ends_with("lateral") || name.ends_with("rotation")) {
            -a[from]
        } else {
            a[from]
        }
    });
    let (r, q) = (p.root_position, p.root_rotation);
    (
        Vec3 { y: -r.y, ..r },
        Quat {
            x: -q.x,
            z: -q.z,
            ..q
        },
        angles,
    )
}

/// Largest differences: pelvis position (m) and orientation, joint angles (degrees).
fn difference(a: (Vec3, Quat, [f64; DOF_COUNT]), b: (Vec3, Quat, [f64; DOF_COUNT])) -> (f64, f64) {
    let turn = (a.1.conjugate() * b.1).log().norm().to_degrees();
    let joint = (0..DOF_COUNT)
        .map(|k| (a.2[k] - b.2[k]).abs().to_degrees())
        .fold(0.0, f64::max);
    ((a.0 - b.0).norm(), turn.max(joint))
}

#[test]
fn a_mirrored_recording_gives_the_mirrored_motion() {
    for name in ["walk-normal", "kick", "side-steps", "wave"] {
        let file = bvh(name, "vrm");
        let (plain, mirror) = (fit(&file), fit(&file.mirrored()));
        // The names stay: what is called left is on the right.
        assert!(mirror.report.skeleton.sides_swapped, "{name}");
        assert_eq!(plain.clip.len(), mirror.clip.len(), "{name}");
        for i in 0..plain.clip.len() {
            let q = mirror.clip.posture(i);
            let (far, turned) = difference(
                mirrored(plain.clip.posture(i)),
                (q.root_position, q.root_rotation, anatomical_angles(q)),
            );
            assert!(
                far < 1e-3 && turned < 0.2,
                "{name} sample {i}: {far} m, {turned}°"
            );
        }
    }
}

#[test]
fn a_turned_recording_gives_the_same_motion() {
    for name in ["walk-arc", "turn", "jump"] {
        let m = motion(name);
        let plain = fit(&bvh(name, "vrm"));
        for facing in [90.0, -147.0] {
            let mut d = dialect("vrm");
            d.rate = plain.report.frames.source_rate_hz.round();
            d.facing = facing;
            let turned = fit(&Bvh::parse(&dialect::write(m, &d, 1)).unwrap());
            assert_eq!(plain.clip.len(), turned.clip.len(), "{name}");
            for i in 0..plain.clip.len() {
                let [p, q] = [&plain, &turned].map(|r| {
                    let p = r.clip.posture(i);
                    (p.root_position, p.root_rotation, anatomical_angles(p))
                });
                let (far, off) = difference(p, q);
                assert!(
                    far < 2e-3 && off < 0.3,
                    "{name} turned by {facing}°, sample {i}: {far} m, {off}°"
                );
            }
        }
    }
}
