//! The folder equals the output of the program, and that output is physical.

use crate::corpus::actor::{LEG, MASS_SHARE};
use crate::corpus::corpus::files_of;
use crate::corpus::plan::{GRAVITY, Motion};
use crate::corpus::recorded::{Truth, folder, motions, read};
use crate::corpus::tracks::v3;
use crate::corpus::truth;
use sinew_physics::math::Vec3;
use std::collections::BTreeSet;

#[test]
fn committed_files_are_what_the_program_writes() {
    let mut written = BTreeSet::new();
    let mut wrong = Vec::new();
    for m in motions() {
        for (name, bytes) in files_of(m) {
            if read(&name) != bytes {
                wrong.push(name.clone());
            }
            written.insert(name);
        }
    }
    assert!(
        wrong.is_empty(),
        "cargo run -p tools --bin corpus -- tests/corpus would change {wrong:?}"
    );
    let kept: BTreeSet<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|n| n.ends_with(".bvh") || n.ends_with(".json"))
        .collect();
    assert_eq!(kept, written);
}

#[test]
fn legs_reach_their_feet_and_feet_keep_out_of_the_floor() {
    for m in motions() {
        let name = &m.script.name;
        for i in 0..=(m.duration() * 60.0) as usize {
            let pose = m.recorded(i as f64 / 60.0);
            for side in 0..2 {
                assert!(
                    pose.short[side] < 1e-6,
                    "{name} frame {i}: leg {side} short by {} m",
                    pose.short[side]
                );
                let low = m.script.actor.lowest(&pose, side);
                assert!(
                    low > -0.008,
                    "{name} frame {i}: foot {side} {low} m over the floor"
                );
            }
        }
    }
}

#[test]
fn planted_feet_do_not_move() {
    for m in motions() {
        let start = m.script.window.0;
        for (side, from, until, [x, y, _]) in truth::footholds(m) {
            let l = LEG[side];
            let mut t = from;
            while t < until {
                let pose = m.recorded(t);
                let foot = m.script.feet[side].at(&m.script.actor, start + t);
                // On a flat foot, the ankle stands over its point; on the heel or the toes, that point stands.
                let a = &m.script.actor;
                let (point, at) = if foot.pitch >= 0.0 {
                    (v3(-a.heel, 0.0, -a.ankle), -a.heel)
                } else {
                    (v3(a.ball, 0.0, a.ball_height - a.ankle), a.ball)
                };
                let there = pose.place[l + 2] + pose.turn[l + 2].rotate(point);
                let (sin, cos) = foot.yaw.sin_cos();
                let off = (there.x - x - cos * at).hypot(there.y - y - sin * at);
                assert!(
                    off < 1e-5,
                    "{} side {side} at {t} s: {off} m off its foothold",
                    m.script.name
                );
                t += 0.02;
            }
        }
    }
}

/// Centre of mass, force per mass and zero-moment point at `t`, from the segments' accelerations alone.
fn dynamics(m: &Motion, t: f64) -> (Vec3, Vec3, Option<Vec3>) {
    let h = 1.0 / 120.0;
    let a = &m.script.actor;
    let centres = [t - h, t, t + h].map(|t| a.centres(&m.pose(t)));
    let mut force = v3(0.0, 0.0, GRAVITY);
    let mut moment = Vec3::zero();
    let mut centre = Vec3::zero();
    for (s, share) in MASS_SHARE.iter().enumerate() {
        let acceleration = (centres[0][s] + centres[2][s] - centres[1][s] * 2.0) * (1.0 / (h * h));
        let f = (acceleration + v3(0.0, 0.0, GRAVITY)) * *share;
        force += acceleration * *share;
        moment += centres[1][s].cross(f);
        centre += centres[1][s] * *share;
    }
    let zmp = (force.z > 3.0).then(|| v3(-moment.y / force.z, moment.x / force.z, 0.0));
    (centre, force, zmp)
}

/// Distance of `p` from the hull of the soles that stand at `t`, by sampling directions; negative inside.
fn outside(m: &Motion, t: f64, p: Vec3) -> f64 {
    let a = &m.script.actor;
    let mut corners = Vec::new();
    for plan in &m.script.feet {
        if let Some(s) = plan.stance(t) {
            let (sin, cos) = s.yaw.sin_cos();
            for (x, y) in [
                (-a.heel, 0.035),
                (-a.heel, -0.035),
                (a.ball + a.toe, 0.035),
                (a.ball + a.toe, -0.035),
                (a.ball, 0.048),
                (a.ball, -0.048),
            ] {
                corners.push(v3(s.x + cos * x - sin * y, s.y + sin * x + cos * y, 0.0));
            }
        }
    }
    (0..180)
        .map(|k| {
            let (sin, cos) = (f64::from(k) * 2.0f64.to_radians()).sin_cos();
            let d = v3(cos, sin, 0.0);
            p.dot(d)
                - corners
                    .iter()
                    .map(|c| c.dot(d))
                    .fold(f64::NEG_INFINITY, f64::max)
        })
        .fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn the_zero_moment_point_stays_under_the_standing_feet() {
    for m in motions().iter().filter(|m| m.script.kind != "floor") {
        let (start, end) = m.script.window;
        let (mut worst, mut when) = (f64::NEG_INFINITY, 0.0);
        let mut mean = (0.0, 0);
        let mut t = start + 0.05;
        while t < end - 0.05 {
            let (_, force, zmp) = dynamics(m, t);
            // In the instants around a landing or take-off, the small force may act anywhere.
            if let Some(p) = zmp.filter(|_| force.z > 0.4 * GRAVITY) {
                let off = outside(m, t, p);
                if off > worst {
                    (worst, when) = (off, t - start);
                }
                mean.0 += off.max(0.0);
                mean.1 += 1;
            }
            t += 1.0 / 60.0;
        }
        // At the instant of a landing, the small force acts at the toes, which touch first; the jump lands hardest.
        let bound = if m.script.kind == "jump" { 0.08 } else { 0.03 };
        assert!(
            worst < bound,
            "{}: {worst} m outside at {when} s",
            m.script.name
        );
        let mean = mean.0 / f64::from(mean.1);
        assert!(
            mean < 5e-4,
            "{}: {mean} m outside on average",
            m.script.name
        );
    }
}

#[test]
fn flights_are_ballistic_and_only_runs_and_jumps_have_them() {
    for m in motions() {
        let (name, start) = (&m.script.name, m.script.window.0);
        let flights = truth::flights(m);
        assert_eq!(
            !flights.is_empty(),
            matches!(m.script.kind, "run" | "jump"),
            "{name}: {flights:?}"
        );
        for (from, until, _) in flights {
            // The ends of a flight are smoothed over a few hundredths of a second.
            let mut t = from + 0.02;
            while t < until - 0.02 {
                let (_, force, _) = dynamics(m, start + t);
                assert!(
                    force.z.abs() < 0.01 && force.norm() < 0.05 * GRAVITY,
                    "{name} at {t} s: {force:?} m/s² are not gravity's"
                );
                t += 0.01;
            }
        }
    }
}

#[test]
fn the_truth_has_the_motions_centre_of_mass() {
    for m in motions() {
        let truth = Truth::of(&m.script.name);
        for k in 0..10 {
            let t = (f64::from(k) * 0.1 * m.duration() * 30.0).floor() / 30.0;
            let (centre, _, _) = dynamics(m, m.script.window.0 + t);
            let written = truth.row("com_m", t);
            let off = (v3(written[0], written[1], written[2]) - centre).norm();
            assert!(off < 1e-3, "{} at {t} s: {off} m", m.script.name);
        }
    }
}
