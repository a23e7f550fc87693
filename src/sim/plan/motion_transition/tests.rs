//! Goal: a path from one motion into another begins and ends as the two motions are, changes little where they agree,
//! and lets no planted foot slide. Method: the built-in walk into itself, at its own speed and faster, and into
//! standing; from a stand into the middle of the built-in lift.

use super::*;
use crate::body::Posture;
use crate::math::Vec3;
use crate::motion::builtin::{at_ease, builtin};
use crate::motion::leg_ik::forward;
use crate::plan::foot_lock::{AnklePose, Sole};

const NOW: usize = 70;

/// The built-in walk with all but its last strides as the lead-in, and the part of it from its time `from` on as
/// planned paths know it.
fn walked(body: &Body, from: MotionTime) -> (Arc<Clip>, Vec<Sample>) {
    let clip = builtin(body, "walk").unwrap();
    let lead = (2.4 * clip.rate_hz()) as usize;
    let clip = Arc::new(clip.with_ends(lead, 0));
    let next = NextClip {
        clip: Arc::clone(&clip),
        speed: 1.0,
        looped: false,
    };
    let count = ((RUN_UP + AHEAD + BEYOND) * RATE) as usize;
    (clip, next.samples(from, count))
}

fn into(body: &Arc<Body>, known: &[Sample], clip: &Arc<Clip>, speed: f64) -> TransitionCandidates {
    let next = NextClip {
        clip: Arc::clone(clip),
        speed,
        looped: false,
    };
    TransitionCandidates::new(
        body,
        known.to_vec(),
        LeavingSamples {
            now: NOW,
            earliest: NOW,
        },
        next,
    )
}

/// Largest difference of two postures, m and rad.
fn apart(a: &Posture, b: &Posture) -> f64 {
    let e = a.difference(b);
    e.iter().fold(0.0, |m: f64, e| m.max(e.abs()))
}

#[test]
fn a_walk_into_itself_goes_on_as_it_was() {
    let body = Arc::new(Body::adult_man());
    let (clip, known) = walked(&body, MotionTime(-0.6));
    let ways = into(&body, &known, &clip, 1.0);
    let moment = &ways.moments()[0];
    assert!(moment.capture < 0.01 && moment.unlike < 0.02, "{moment:?}");
    let (way, place) = ways.way(0).unwrap();
    let mut worst = 0.0f64;
    let whole = ((way.until - way.begin) * RATE) as usize;
    for (i, (is, _)) in known.iter().enumerate().take(whole) {
        let mut p = way.clip.sample(i as f64 / RATE).posture;
        place.apply_posture(&mut p);
        let off = apart(&p, is);
        worst = worst.max(off);
        assert!(i > NOW || off < 1e-9, "{i}: {off}");
    }
    // The pelvis is shifted where the walk's own zero-moment point is at the edge.
    assert!(worst < 0.05, "{worst}");
}

#[test]
fn a_way_ends_as_the_clip_does_and_no_foot_slides_on_it() {
    let body = Arc::new(Body::adult_man());
    let (clip, known) = walked(&body, MotionTime(-0.5));
    for speed in [0.9, 1.0, 1.1] {
        let ways = into(&body, &known, &clip, speed);
        let (way, _) = ways.way(0).unwrap_or_else(|| panic!("at {speed}"));
        ends_as(&way, &clip, speed);
        no_foot_slides(&body, &way);
    }
}

/// From its last moment on the path equals the clip, and moves like it.
fn ends_as(way: &TransitionClip, clip: &Clip, speed: f64) {
    for t in [way.until, way.until + 0.1 * speed] {
        let (a, b) = (way.clip.sample(t - way.begin), clip.sample(t.0));
        assert!(apart(&a.posture, &b.posture) < 1e-4, "at {speed}, {t:?}");
        let rates = a.velocity.iter().zip(&b.velocity);
        let faster = rates.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        assert!(faster < 0.02, "at {speed}, {t:?}: {faster}");
    }
}

fn no_foot_slides(body: &Body, way: &TransitionClip) {
    let soles = [0, 1].map(|s| Sole::new(body, s));
    let mut stood: [Option<Vec3>; 2] = [None; 2];
    for (posture, planted) in way.clip.samples() {
        let poses = forward(body, posture);
        for s in 0..2 {
            let at = soles[s].footing(AnklePose::of(&poses, s)).place;
            let before = if planted[s] { stood[s] } else { None };
            let slid = before.map_or(0.0, |b| (at - b).norm());
            assert!(slid < 2e-4, "{slid} m in a sample");
            stood[s] = planted[s].then_some(at);
        }
    }
}

#[test]
fn who_stands_is_led_into_what_begins_otherwise() {
    let body = Arc::new(Body::adult_man());
    let ease = at_ease(&body);
    let lift = builtin(&body, "lift").unwrap();
    let next = |clip: &Clip, speed: f64| NextClip {
        clip: Arc::new(clip.clone()),
        speed,
        looped: false,
    };
    // The clip begins at ease, and is under way a moment later.
    assert!(next(&lift, 1.0).begins_as(&body, MotionTime(0.0), &ease));
    let from = (0.6 * lift.rate_hz()) as usize;
    let (postures, planted) = lift.samples().skip(from).map(|(p, f)| (*p, f)).unzip();
    let clip = Clip::from_postures("lift", lift.rate_hz(), postures, planted).unwrap();
    let first = clip.sample(0.0);
    let moves = first.velocity.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    assert!(moves > 1.0, "{moves}");
    for speed in [0.8, 1.0, 1.2] {
        let next = next(&clip, speed);
        assert!(!next.begins_as(&body, MotionTime(0.0), &ease));
        assert!(!next.begins_as(&body, MotionTime(0.0), &first.posture));
        let way = next.from_stand(&body, MotionTime(0.0), &ease).unwrap();
        let begins = way.clip.sample(0.0);
        let off = begins.posture.joint_difference(&ease);
        let off = off.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
        // Feet stay turned by up to 0.15 rad, and legs with them.
        assert!(off < 0.16, "at {speed}: {off} rad");
        ends_as(&way, &clip, speed);
        no_foot_slides(&body, &way);
        assert!(!way.leads_over() && way.until.0 > 0.2 * speed);
    }
}

#[test]
fn nothing_of_a_walk_is_like_standing() {
    let body = Arc::new(Body::adult_man());
    let (_, known) = walked(&body, MotionTime(-0.6));
    let idle = Arc::new(builtin(&body, "idle").unwrap());
    assert!(into(&body, &known, &idle, 1.0).moments().is_empty());
}
