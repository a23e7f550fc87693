//! Goal: a felled person lands on hands or forearms first; the head, if it touches at all, touches slowly; and then the
//! person lies still. Method: felling pushes at the chest, from eight directions; the time at which each part touches
//! the floor, the speed of the head in the tick before its touch, and the distance that the body moves after landing.

use crate::acceptance::vec3;
use crate::common::{Scene, authored, figure, still};
use sinew_evaluate::pose::segment_poses;
use sinew_physics::body::topology::{
    CHEST, HEAD, L_FOOT, L_FOREARM, L_HAND, L_TOES, R_FOOT, R_FOREARM, R_HAND, R_TOES,
    SEGMENT_NAMES,
};
use sinew_physics::body::{Body, Links, Profile, SegmentId, Sex};
use sinew_physics::figure::{ControllerKind, Perturbation};
use sinew_physics::math::Vec3;
use std::sync::Arc;

/// Duration of the push, s.
const PUSH: f64 = 0.1;
/// Observed time after it, s.
const SECONDS: f64 = 4.0;
/// Head speed below which its touch counts as harmless, m/s.
const HARMLESS: f64 = 1.5;
/// A body whose centre of mass is lower than this has landed, m; and the time in which it comes to rest, s.
const LANDED: f64 = 0.2;
const SETTLES: f64 = 0.5;
const FEET: [SegmentId; 4] = [L_FOOT, L_TOES, R_FOOT, R_TOES];
const ARM: [SegmentId; 4] = [L_FOREARM, L_HAND, R_FOREARM, R_HAND];

/// Result of a push.
#[derive(Debug)]
struct Outcome {
    fell: bool,
    /// First touch of a hand or forearm, and of the head, s after the push began.
    arm: Option<f64>,
    head: Option<f64>,
    /// Speed of the head's centre of mass before its fastest touch, m/s.
    head_speed: f64,
    /// Distance that the body rolls or slides after landing, m.
    goes_on: f64,
    /// Parts that touched, in order.
    order: Vec<&'static str>,
}

fn felled(body: &Arc<Body>, direction: Vec3, impulse: f64) -> Outcome {
    let posture = authored(body, "idle").posture(0).to_owned();
    let mut scene = Scene::of(figure(body, ControllerKind::Modern, still(posture)));
    scene.run(0.5, |_| ());
    let start = scene.world.time().0;
    let what = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: direction * (impulse / PUSH),
        from: start,
        to: start + PUSH,
    };
    scene.world.perturb(scene.key, what).unwrap();
    let center = body.segment(HEAD).com;
    let place = |s: &Scene| {
        let f = s.figure();
        segment_poses(&f.links().offset, &f.state().posture)[HEAD.index()].point(center)
    };
    let mut before = place(&scene);
    let mut touched = false;
    let mut landed: Option<(f64, Vec3)> = None;
    let mut out = Outcome {
        fell: false,
        arm: None,
        head: None,
        head_speed: 0.0,
        goes_on: 0.0,
        order: Vec::new(),
    };
    scene.run(SECONDS, |s| {
        let now = place(s);
        let (dt, t) = (s.world.dt(), s.world.time().0 - start);
        out.fell |= s.figure().is_fallen();
        let com = s.figure().report().unwrap().balance.com;
        if com.z < LANDED {
            let (since, place) = *landed.get_or_insert((t, com));
            if t < since + SETTLES {
                landed = Some((since, com));
            } else {
                out.goes_on = out.goes_on.max((com - place).norm());
            }
        }
        let touches = |part: SegmentId| {
            let r = s.figure().report().unwrap();
            r.contacts.iter().any(|c| c.segment == part)
        };
        for part in SegmentId::all().filter(|p| !FEET.contains(p) && touches(*p)) {
            let name = SEGMENT_NAMES[part.index()];
            if !out.order.contains(&name) {
                out.order.push(name);
            }
        }
        if out.arm.is_none() && ARM.into_iter().any(touches) {
            out.arm = Some(t);
        }
        let head = touches(HEAD);
        if head && !touched {
            out.head.get_or_insert(t);
            out.head_speed = out.head_speed.max((now - before).norm() / dt);
        }
        (touched, before) = (head, now);
    });
    out
}

/// Falls from eight directions: the number of falls, the number in which the head arrives slowly, and a list of those
/// in which it arrives before the arms.
fn from_all_sides(name: &str, body: Body, impulses: &[f64]) -> (usize, usize, Vec<String>) {
    let body = Arc::new(body);
    let (mut falls, mut slow, mut head_first) = (0, 0, Vec::new());
    for impulse in impulses {
        for k in 0..8 {
            let angle = f64::from(k) * std::f64::consts::FRAC_PI_4;
            let o = felled(&body, vec3(angle.cos(), angle.sin(), 0.0), *impulse);
            let what = format!("{name}, {impulse} N·s, {:.0}°", angle.to_degrees());
            println!(
                "{what}: {}, arm at {:.2?} s, head at {:.2?} s with {:.2} m/s, in turn {:?}",
                if o.fell { "fell" } else { "stayed up" },
                o.arm.unwrap_or(f64::NAN),
                o.head.unwrap_or(f64::NAN),
                o.head_speed,
                o.order,
            );
            // Outstretched arms stop the body from rolling: half a turn of a trunk takes it half a metre.
            assert!(o.goes_on < 0.4, "{what}: goes on for {:.2} m", o.goes_on);
            falls += usize::from(o.fell);
            slow += usize::from(o.fell && o.head_speed < HARMLESS);
            if o.fell && o.head.is_some_and(|h| o.arm.is_none_or(|a| a > h)) {
                head_first.push(what);
            }
        }
    }
    println!("{name}: {falls} falls, the head slow in {slow}, first in {head_first:?}");
    (falls, slow, head_first)
}

#[test]
fn hands_reach_the_floor_before_the_head() {
    for (name, body) in [("man", Body::adult_man()), ("woman", Body::adult_woman())] {
        // Those of 0.8 m/s no longer fell everybody.
        let mass = Links::new(&body).total_mass();
        let impulses = [0.8, 1.07, 1.33].map(|speed| speed * mass);
        let (falls, slow, head_first) = from_all_sides(name, body, &impulses);
        assert!(falls >= 16, "{name}: these pushes fell");
        assert!(head_first.is_empty(), "{name}: {head_first:?}");
        assert!(8 * slow >= 7 * falls, "{name}: slow in {slow} of {falls}");
    }
}

/// Weaker arms come too late in some falls to the front.
#[test]
fn children_and_old_people_brace_themselves_too() {
    for (name, sex, age) in [
        ("child", Sex::Female, 10.0),
        ("old man", Sex::Male, 75.0),
        ("old woman", Sex::Female, 75.0),
    ] {
        let body = Body::humanoid(Profile::ordinary(sex, age)).unwrap();
        // Same speed as that of the man after 60 and 80 N·s.
        let impulse = 0.8 * Links::new(&body).total_mass();
        let (falls, _, head_first) = from_all_sides(name, body, &[impulse, 1.3 * impulse]);
        assert!(falls >= 8, "{name}: these pushes fell");
        assert!(4 * head_first.len() <= falls, "{name}: {head_first:?}");
    }
}
