//! Goal: nothing in the simulation knows left from right, or north from east. Method: the same scene mirrored in the
//! plane y = 0 with left and right exchanged, and turned about z; every number of every frame is transformed back and
//! compared.
//!
//! The paper's controller needs one main support. When both feet carry exactly the same, it takes the left one, even in
//! the mirror image; therefore the load is in the hand from the start.

use crate::acceptance::vec3;
use crate::common::{Scene, authored, figure, man, play, synthesised};
use sinew_physics::body::topology::{
    CHEST, DOF_LEN, DOF_START, JOINT, Joint, R_HAND, SEGMENT_NAMES,
};
use sinew_physics::body::{DOF_COUNT, Posture, SEGMENT_COUNT, SegmentId, State};
use sinew_physics::figure::motion::tasks::grip;
use sinew_physics::figure::{ControllerKind, Perturbation, StepperKind};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::{Clip, PlanarTransform};
use sinew_physics::world::{ClipPlayback, MotionSource};
use std::sync::Arc;

/// Largest difference relative to the scale of each quantity.
const TOLERANCE: f64 = 1e-9;

/// Segment on the other side.
pub(crate) fn opposite(s: usize) -> usize {
    let name = SEGMENT_NAMES[s];
    let other = match name.split_at(2) {
        ("l_", rest) => format!("r_{rest}"),
        ("r_", rest) => format!("l_{rest}"),
        _ => name.to_owned(),
    };
    SegmentId::from_name(&other).unwrap().index()
}

/// Joint rates, torques and the like, mirrored: anatomical signs are the same on both sides; in the middle, roll and
/// turn change theirs.
fn mirrored_dofs(x: &[f64]) -> [f64; DOF_COUNT] {
    let mut out = [0.0; DOF_COUNT];
    for s in 1..SEGMENT_COUNT {
        let o = opposite(s);
        for k in 0..DOF_LEN[s] {
            let sign = if o == s && k > 0 { -1.0 } else { 1.0 };
            out[DOF_START[o] + k] = sign * x[DOF_START[s] + k];
        }
    }
    out
}

pub(crate) fn flip(p: Vec3) -> Vec3 {
    vec3(p.x, -p.y, p.z)
}

fn flip_axial(w: Vec3) -> Vec3 {
    vec3(-w.x, w.y, -w.z)
}

pub(crate) fn flip_rotation(q: Quat) -> Quat {
    let [x, y, z, w] = q.to_xyzw();
    Quat::from_xyzw([-x, y, -z, w])
}

fn mirrored(p: &Posture) -> Posture {
    let mut out = *p;
    out.root_position = flip(p.root_position);
    out.root_rotation = flip_rotation(p.root_rotation);
    for s in 1..SEGMENT_COUNT {
        match (JOINT[s], JOINT[opposite(s)]) {
            (Joint::Ball(a), Joint::Ball(b)) => out.ball[b] = flip_rotation(p.ball[a]),
            (Joint::Hinge1(a) | Joint::Hinge2(a), Joint::Hinge1(b) | Joint::Hinge2(b)) => {
                for k in 0..DOF_LEN[s] {
                    out.hinge[b + k] = p.hinge[a + k];
                }
            }
            _ => {}
        }
    }
    out
}

pub(crate) fn mirrored_state(s: &State) -> State {
    let v = &s.velocity;
    let at = |i: usize| vec3(v[i], v[i + 1], v[i + 2]);
    let mut out = State::at_rest(mirrored(&s.posture));
    out.velocity[..3].copy_from_slice(&flip_axial(at(0)).to_array());
    out.velocity[3..6].copy_from_slice(&flip(at(3)).to_array());
    out.velocity[6..].copy_from_slice(&mirrored_dofs(&v[6..]));
    out
}

fn turned_state(s: &State, turn: Quat, shift: Vec3) -> State {
    let mut out = *s;
    out.posture.root_position = turn.rotate(s.posture.root_position) + shift;
    out.posture.root_rotation = turn * s.posture.root_rotation;
    for i in [0, 3] {
        let v = vec3(s.velocity[i], s.velocity[i + 1], s.velocity[i + 2]);
        out.velocity[i..i + 3].copy_from_slice(&turn.rotate(v).to_array());
    }
    out
}

/// A case: the controller of the figure, its motion, and its disturbances.
struct Case {
    name: &'static str,
    controller: ControllerKind,
    stepper: StepperKind,
    clip: Arc<Clip>,
    seconds: f64,
    load: f64,
    push: Vec3,
    max_help: f64,
}

/// The scene of a case with its start, clip and disturbances as given.
fn scene(
    case: &Case,
    start: State,
    clip: Arc<Clip>,
    origin: PlanarTransform,
    hand: usize,
    push: Vec3,
) -> Scene {
    let body = man();
    let mut setup = figure(&body, case.controller, start);
    setup.stepper = case.stepper;
    setup.options.max_help = case.max_help;
    let mut scene = Scene::of(setup);
    let drive = match play(&clip) {
        MotionSource::Clip(p) => MotionSource::Clip(ClipPlayback { origin, ..p }),
        other => other,
    };
    scene.figure_mut().set_drive(drive);
    let segment = SegmentId::new(hand).unwrap();
    let load = Perturbation::Load {
        segment,
        point: grip(&body, segment),
        mass: case.load,
        from: 0.0,
        to: 1e3,
    };
    let push = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: push * 10.0,
        from: 0.5,
        to: 0.6,
    };
    for what in [load, push] {
        scene.world.perturb(scene.key, what).unwrap();
    }
    scene
}

/// Maps everything in a frame of a figure back to the plain scene, by `vector`, `axial`, `dofs` and `segment`.
struct Back<'a> {
    state: &'a dyn Fn(&State) -> State,
    point: &'a dyn Fn(Vec3) -> Vec3,
    vector: &'a dyn Fn(Vec3) -> Vec3,
    dofs: &'a dyn Fn(&[f64]) -> [f64; DOF_COUNT],
    segment: &'a dyn Fn(usize) -> usize,
}

/// Largest difference of two frames, each quantity relative to its scale, and which it was.
fn difference(plain: &Scene, other: &Scene, back: &Back<'_>) -> (f64, String) {
    let (a, b) = (plain.figure(), other.figure());
    let (r, q) = (a.report().unwrap(), b.report().unwrap());
    let mut worst = (0.0, String::new());
    let mut see = |what: &str, x: f64, y: f64, scale: f64| {
        let d = (x - y).abs() / scale;
        if d > worst.0 || d.is_nan() {
            worst = (d, format!("{what}: {x} {y}"));
        }
    };
    let vectors = |see: &mut dyn FnMut(&str, f64, f64, f64), what: &str, x: Vec3, y: Vec3, s| {
        for (x, y) in x.to_array().into_iter().zip(y.to_array()) {
            see(what, x, y, s);
        }
    };
    let (s, t) = (a.state(), (back.state)(b.state()));
    vectors(
        &mut see,
        "root",
        s.posture.root_position,
        t.posture.root_position,
        1.0,
    );
    let angle = |p: Quat, q: Quat| (p.conjugate() * q).log().norm();
    see(
        "rotation",
        angle(s.posture.root_rotation, t.posture.root_rotation),
        0.0,
        1.0,
    );
    for (p, q) in s.posture.ball.iter().zip(&t.posture.ball) {
        see("ball", angle(*p, *q), 0.0, 1.0);
    }
    for (p, q) in s.posture.hinge.iter().zip(&t.posture.hinge) {
        see("hinge", *p, *q, 1.0);
    }
    for (p, q) in s.velocity.iter().zip(&t.velocity) {
        see("velocity", *p, *q, 10.0);
    }
    let torque = (back.dofs)(&q.joints.torque);
    for j in 0..DOF_COUNT {
        see("torque", r.joints.torque[j], torque[j], 100.0);
    }
    let weight = 735.0;
    let help = |r: &sinew_physics::figure::TickReport| vec3(r.assist[3], r.assist[4], r.assist[5]);
    let other = (back.vector)(help(q));
    vectors(&mut see, "help", help(r), other, weight);
    for s in 0..SEGMENT_COUNT {
        let sum = |r: &sinew_physics::figure::TickReport, s: usize| {
            r.contacts
                .iter()
                .filter(|c| c.segment.index() == s)
                .fold(Vec3::zero(), |f, c| f + c.force)
        };
        let other = (back.vector)(sum(q, (back.segment)(s)));
        vectors(&mut see, "force", sum(r, s), other, weight);
    }
    vectors(
        &mut see,
        "com",
        r.balance.com,
        (back.point)(q.balance.com),
        1.0,
    );
    match (r.balance.zmp, q.balance.zmp) {
        (Some(x), Some(y)) => vectors(&mut see, "zmp", x, (back.point)(y), 1.0),
        (x, y) => assert_eq!(x.is_some(), y.is_some()),
    }
    worst
}

/// Steps both scenes side by side.
fn agree(case: &Case, what: &str, plain: &mut Scene, other: &mut Scene, back: &Back<'_>) {
    let mut worst = (0.0, String::new());
    for _ in 0..plain.ticks(case.seconds) {
        plain.world.step();
        other.world.step();
        let d = difference(plain, other, back);
        assert!(!d.0.is_nan(), "{}: {what}: {}", case.name, d.1);
        if d.0 > worst.0 {
            worst = (d.0, format!("{:.3} s {}", plain.world.time().0, d.1));
        }
    }
    let text = format!("{}: {what}: {:.1e} at {}", case.name, worst.0, worst.1);
    println!("{text}");
    assert!(worst.0 < TOLERANCE, "{text}");
}

fn cases() -> Vec<Case> {
    use ControllerKind::{Modern, Motors, Paper};
    use StepperKind::{Kinematic, Torque};
    let body = man();
    let lift = authored(&body, "lift");
    let idle = authored(&body, "idle");
    let walk = authored(&body, "walk");
    let wave = synthesised(&body, "wave.vrm");
    let case =
        |name: &'static str, controller, stepper, clip: &Arc<Clip>, seconds, load, push| Case {
            name,
            controller,
            stepper,
            clip: Arc::clone(clip),
            seconds,
            load,
            push,
            max_help: 0.0,
        };
    let none = Vec3::zero();
    vec![
        case("modern lifts", Modern, Torque, &lift, 4.0, 3.0, none),
        case(
            "modern is pushed",
            Modern,
            Torque,
            &idle,
            2.0,
            0.0,
            vec3(8.0, 15.0, 0.0),
        ),
        Case {
            max_help: 0.3,
            ..case(
                "modern is pushed and helped",
                Modern,
                Torque,
                &idle,
                1.5,
                0.0,
                vec3(60.0, 45.0, 0.0),
            )
        },
        case("modern walks", Modern, Torque, &walk, 3.0, 2.0, none),
        case("modern waves", Modern, Torque, &wave, 3.0, 0.0, none),
        case("paper lifts", Paper, Torque, &lift, 4.0, 2.0, none),
        case(
            "paper is pushed",
            Paper,
            Torque,
            &wave,
            1.5,
            0.0,
            vec3(5.0, 4.0, 0.0),
        ),
        case(
            "paper lifts, kinematic",
            Paper,
            Kinematic,
            &lift,
            4.0,
            2.0,
            none,
        ),
        case(
            "motors fall",
            Motors,
            Torque,
            &idle,
            1.2,
            0.0,
            vec3(20.0, 5.0, 0.0),
        ),
    ]
}

#[test]
fn left_and_right_are_alike() {
    for case in cases() {
        let first = case.clip.sample(0.0);
        let start = first.state();
        let postures = (0..case.clip.len())
            .map(|i| mirrored(case.clip.posture(i)))
            .collect();
        let planted = (0..case.clip.len())
            .map(|i| {
                let [l, r] = case.clip.planted(i);
                [r, l]
            })
            .collect();
        let rate = case.clip.rate_hz();
        let clip = Arc::new(Clip::from_postures("mirrored", rate, postures, planted).unwrap());
        let at = PlanarTransform::default();
        let (right, left) = (R_HAND.index(), opposite(R_HAND.index()));
        let mut plain = scene(&case, start, Arc::clone(&case.clip), at, right, case.push);
        let mut other = scene(
            &case,
            mirrored_state(&start),
            clip,
            at,
            left,
            flip(case.push),
        );
        let back = Back {
            state: &mirrored_state,
            point: &flip,
            vector: &flip,
            dofs: &|x| mirrored_dofs(x),
            segment: &opposite,
        };
        agree(&case, "mirrored", &mut plain, &mut other, &back);
    }
}

#[test]
fn directions_are_alike() {
    for case in cases() {
        let yaw = 2.2;
        let shift = vec3(3.0, -2.0, 0.0);
        let turn = Quat::from_axis_angle(Vec3::Z, yaw);
        let first = case.clip.sample(0.0);
        let start = first.state();
        let (here, there) = (
            PlanarTransform::default(),
            PlanarTransform {
                x: shift.x,
                y: shift.y,
                yaw,
            },
        );
        let hand = R_HAND.index();
        let mut plain = scene(&case, start, Arc::clone(&case.clip), here, hand, case.push);
        let mut other = scene(
            &case,
            turned_state(&start, turn, shift),
            Arc::clone(&case.clip),
            there,
            hand,
            turn.rotate(case.push),
        );
        let undo = turn.conjugate();
        let back = Back {
            state: &|s| turned_state(s, undo, -undo.rotate(shift)),
            point: &|p| undo.rotate(p - shift),
            vector: &|p| undo.rotate(p),
            dofs: &|x| x.try_into().unwrap(),
            segment: &|s| s,
        };
        agree(&case, "turned", &mut plain, &mut other, &back);
    }
}
