//! Boundary conditions of plans: where a motion begins and ends, and how it is joined to another. Method: walks cut out
//! of their recordings in full stride, their stops at moments spread over each, their loops, and the transitions from
//! walk to walk, compared with the motions that they join.

use crate::corpus::plans::{Continued, moments, repeated, stop, strides, walks, way_over};
use crate::corpus::preparation::{sole, soles};
use crate::corpus::recorded::man;
use sinew_physics::body::topology::{DOF_START, L_THIGH};
use sinew_physics::body::{Body, NV, Posture};
use sinew_physics::math::polygon::{hull, margin};
use sinew_physics::motion::Clip;
use sinew_physics::motion::builtin::at_ease;
use sinew_physics::motion::leg_ik::{center_of_mass, forward};
use sinew_physics::motion::target::Target;
use std::sync::Arc;

/// Difference of equal postures, caused by rounding, m and rad.
const SAME: f64 = 1e-6;
/// A body slower than this is at rest, m/s and rad/s: it moves by less than 1 mm in a tick.
const REST: f64 = 0.05;
/// Slower than this the capture point of a body is less than half a foot ahead of it, m/s.
const LEAVES_ITS_FEET: f64 = 0.3;
/// Height over or under the floor at which a sole stands on it, m.
const ON_FLOOR: f64 = 1e-3;
/// Velocity differences that resampling a motion causes: pelvis, m/s and rad/s, and joints, rms, rad/s. The velocities
/// of a walk are 1 m/s and 1 to 2 rad/s.
const AS_FAST: (f64, f64) = (0.05, 0.5);
/// Distance that the plan keeps from the edge of a sole, m.
const INSET: f64 = 0.04;

/// Largest difference of two postures, m and rad.
fn apart(a: &Posture, b: &Posture) -> f64 {
    a.difference(b).iter().fold(0.0, |m, e| m.max(e.abs()))
}

/// Differences of two velocities: pelvis, m/s or rad/s, and joints, rms, rad/s.
fn faster(a: &[f64; NV], b: &[f64; NV]) -> (f64, f64) {
    let square = |from: usize, to: usize| -> f64 {
        let pairs = a[from..to].iter().zip(&b[from..to]);
        pairs.map(|(a, b)| (a - b) * (a - b)).sum()
    };
    let pelvis = square(0, 3).max(square(3, 6)).sqrt();
    (pelvis, (square(6, NV) / (NV - 6) as f64).sqrt())
}

#[track_caller]
fn as_fast(a: &Target, b: &Target, what: &str) {
    let (pelvis, joints) = faster(&a.velocity, &b.velocity);
    assert!(
        pelvis < AS_FAST.0 && joints < AS_FAST.1,
        "{what}: velocity jumps by {pelvis} m/s or rad/s, joints {joints} rad/s rms"
    );
}

/// Checks that it is at rest, that both feet touch the floor, and that its centre of mass is well inside the contact
/// area.
#[track_caller]
fn stands(body: &Body, target: &Target, what: &str) {
    let fastest = target.velocity.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    assert!(fastest < REST, "{what}: {fastest} m/s or rad/s");
    assert_eq!(target.planted, [true; 2], "{what}");
    let soles = soles(body);
    let mut corners = Vec::new();
    for side in 0..2 {
        let points = sole(body, &soles, &target.posture, side);
        let low = points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        assert!(low.abs() < ON_FLOOR, "{what}: foot {side} at {low} m");
        let touching = points.iter().filter(|p| p.z < ON_FLOOR);
        corners.extend(touching.map(|p| [p.x, p.y]));
    }
    let com = center_of_mass(body, &forward(body, &target.posture));
    let inside = margin(&hull(&corners), [com.x, com.y]);
    assert!(
        inside > INSET,
        "{what}: {inside} m from the edge of its feet"
    );
}

/// Largest height of a point of either sole, m.
fn highest(body: &Body, posture: &Posture) -> f64 {
    let soles = soles(body);
    let all = (0..2).flat_map(|side| sole(body, &soles, posture, side));
    all.map(|p| p.z).fold(0.0, f64::max)
}

/// Until it may leave a motion, a plan equals that motion, and it leaves it at the same velocity.
#[track_caller]
fn continues(plan: &Continued, what: &str) {
    const TICK: f64 = 1.0 / 60.0;
    for i in 0..=(plan.leaves / TICK).round() as usize {
        let t = i as f64 * TICK;
        let off = apart(&plan.clip.sample(t).posture, &(plan.before)(t).posture);
        assert!(off < SAME, "{what}: {off} m or rad off at {t} s");
    }
    let (is, was) = (plan.clip.sample(plan.leaves), (plan.before)(plan.leaves));
    as_fast(&is, &was, what);
}

/// The first and the last moment of a whole clip, at which its posture is not yet, or no longer, held.
fn first_and_last(clip: &Clip) -> [Target; 2] {
    let edge = 0.01 / clip.rate_hz();
    [
        clip.sample(-clip.lead_in() + edge),
        clip.sample(clip.duration() + clip.lead_out() - edge),
    ]
}

#[test]
fn a_walk_begins_and_ends_standing_at_ease_and_is_joined_to_both() {
    let body = man();
    let ease = at_ease(&body);
    for name in walks() {
        let clip = strides(name);
        assert!(clip.lead_in() > 0.0 && clip.lead_out() > 0.0, "{name}");
        let [first, last] = first_and_last(&clip);
        for (target, what) in [(&first, "begins"), (&last, "ends")] {
            let what = format!("{name} {what}");
            stands(&body, target, &what);
            let off = target.posture.joint_difference(&ease);
            let upper = off[..DOF_START[L_THIGH.index()]].iter();
            let off = upper.fold(0.0f64, |m, e| m.max(e.abs()));
            assert!(off < SAME, "{what}: {off} rad from ease above the legs");
        }
        let high = highest(&body, &last.posture);
        assert!(high < ON_FLOOR, "{name} ends with a sole {high} m up");
        // The velocity is continuous where the recording is entered and where it is left.
        let h = 1.0 / clip.rate_hz();
        for seam in [0.0, clip.duration()] {
            let [before, at, after] = [-h, 0.0, h].map(|d| clip.sample(seam + d));
            as_fast(&before, &at, &format!("{name}, into {seam:.2} s"));
            as_fast(&at, &after, &format!("{name}, from {seam:.2} s"));
        }
    }
}

#[test]
fn a_stop_begins_as_the_motion_was_and_ends_at_rest_on_both_feet() {
    let body = Arc::new(man());
    let mut stops = 0;
    for name in walks() {
        let clip = strides(name);
        for at in moments(&clip, 6) {
            let what = format!("{name} stopped at {at:.2} s");
            let Some(plan) = stop(&body, &clip, at) else {
                // It would stand in the coming step, and does not leave its feet.
                let soon = clip.sample(at + 0.5);
                let slow = soon.velocity[3].hypot(soon.velocity[4]) < LEAVES_ITS_FEET;
                let stands = soon.planted == [true; 2] && slow;
                assert!(stands, "{what}: no way to a stand");
                continue;
            };
            continues(&plan, &what);
            let [_, last] = first_and_last(&plan.clip);
            stands(&body, &last, &what);
            let high = highest(&body, &last.posture);
            assert!(high < ON_FLOOR, "{what}: a sole is {high} m up");
            stops += 1;
        }
    }
    assert!(stops > 50, "{stops}");
}

#[test]
fn a_loop_has_no_seam() {
    let body = man();
    let soles = soles(&body);
    for name in walks() {
        let clip = repeated(&strides(name));
        let (period, h) = (clip.duration(), 1.0 / clip.rate_hz());
        // The end of a round is the beginning of the next one, before anything is blended.
        let mut first = *clip.posture(0);
        clip.advance().apply_posture(&mut first);
        let off = apart(&first, clip.posture(clip.len() - 1));
        assert!(off < 0.01, "{name}: {off} m or rad between two rounds");
        assert_eq!(clip.planted(0), clip.planted(clip.len() - 1), "{name}");
        let edge = 1e-6;
        let [before, after] = [-edge, edge].map(|d| clip.sample_looped(period + d));
        let off = apart(&before.posture, &after.posture);
        assert!(off < 1e-4, "{name}: the posture jumps by {off} m or rad");
        let (pelvis, joints) = faster(&before.velocity, &after.velocity);
        assert!(
            pelvis < 1e-2 && joints < 1e-2,
            "{name}: the velocity jumps by {pelvis} and {joints}"
        );
        // A foot that stands across the seam stays in place.
        for i in 0..(0.2 / h) as usize {
            let [a, b] = [0.0, h].map(|d| clip.sample_looped(period - 0.1 + i as f64 * h + d));
            for side in (0..2).filter(|s| a.planted[*s] && b.planted[*s]) {
                let [p, q] = [&a, &b].map(|t| sole(&body, &soles, &t.posture, side));
                let ways = p.iter().zip(&q).map(|(p, q)| (*p - *q).norm());
                let speed = ways.fold(f64::INFINITY, f64::min) / h;
                assert!(speed < 0.065, "{name}: foot {side} slides by {speed} m/s");
            }
        }
    }
}

#[test]
fn a_transition_begins_on_the_one_motion_and_ends_on_the_other() {
    let body = Arc::new(man());
    let clips: Vec<_> = walks().into_iter().map(|n| (n, strides(n))).collect();
    let (mut found, mut asked) = (0, 0);
    for (k, (first, left)) in clips.iter().enumerate() {
        for (second, entered) in [&clips[(k + 1) % clips.len()], &clips[(k + 4) % clips.len()]] {
            for at in moments(left, 4) {
                asked += 1;
                let Some(over) = way_over(&body, left, at, entered) else {
                    continue;
                };
                found += 1;
                let what = format!("{first} at {at:.2} s to {second}");
                continues(&over.left, &what);
                let way = &over.way;
                for t in [way.until, way.until + 0.1] {
                    let (is, shall) = (way.clip.sample(t - way.begin), entered.sample(t.0));
                    let off = apart(&is.posture, &shall.posture);
                    assert!(off < SAME, "{what}: {off} m or rad off at {t:?}");
                    as_fast(&is, &shall, &what);
                }
            }
        }
    }
    // If no moments are similar enough, a figure comes to a stand in between.
    assert!(2 * found > asked, "{found} ways of {asked}");
}
