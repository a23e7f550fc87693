//! Goal: bodies do not pass through themselves. The forces that ensure it change no momentum, add no energy, and do not
//! act on overlaps of the desired motion. Method: the stepper alone, with and without self-contact; limp bodies thrown
//! about, and motors at full strength that drive arms through the trunk.

use super::*;
use crate::body::State;
use crate::body::angles::{anatomical_angles, angles_of, set_anatomical_angles, swings};
use crate::body::topology::{DOF_COUNT, DOF_NAMES, NV};
use crate::body::{Body, Links};
use crate::contact::Tissue;
use crate::dynamics::Terms;
use crate::dynamics::{Kinematics, kinetic_energy, rotor_energy};
use crate::figure::{ControllerKind, FigureSetup};
use crate::math::vec3::vec3;
use crate::motion::Target;
use crate::setup::StrengthScale;
use crate::stepper::command::{
    MotorCommand, StepForces, StepInput, Stepper, TickStart, TorqueRange,
};
use crate::stepper::motor_law::MotorLaw;
use crate::stepper::torque_step::TorqueStepper;
use crate::strength::Strength;
use crate::tick_context::Planning;
use crate::tick_context::TickContext;
use crate::world::{MotionSource, World, WorldParams};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

/// A body moved by the torque stepper alone.
struct Rig {
    body: Body,
    shape: BodyShape,
    links: Links,
    strength: Strength,
    stepper: TorqueStepper,
    terms: Terms,
    world: TickContext,
    /// Share of its strength.
    share: f64,
    /// The target posture of the motors.
    aim: Posture,
    /// The posture whose overlaps are permitted.
    desired: Posture,
    /// Whether it collides with itself.
    meets: bool,
}

impl Rig {
    fn new(share: f64, gravity: f64, meets: bool) -> Self {
        let body = Body::adult_man();
        Self {
            shape: BodyShape::new(&body),
            links: Links::new(&body),
            strength: Strength::for_body(&body),
            stepper: TorqueStepper::new(0.9),
            terms: Terms::default(),
            world: TickContext {
                tick: 0,
                dt: 1.0 / 60.0,
                substeps: 2,
                gravity,
                planning: Planning::InTick,
            },
            share,
            aim: Posture::default(),
            desired: apart(),
            meets,
            body,
        }
    }

    fn pair(posture: Posture) -> TargetPair {
        TargetPair {
            now: Target::still(posture),
            next: Target::still(posture),
        }
    }

    fn step(&mut self, state: &mut State) {
        self.terms
            .compute(&self.links, state, &[], self.world.gravity);
        let h = self.world.dt / f64::from(self.world.substeps);
        let swings = swings(&state.posture);
        let tissue = Tissue::new(&self.strength, (state, &swings), self.world.substeps, h);
        let angles = angles_of(&swings, &state.posture);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| state.velocity[6 + j]);
        let scale = StrengthScale {
            all: self.share,
            ..StrengthScale::default()
        }
        .muscles(1.0);
        let mut available = TorqueRange {
            lower: [0.0; DOF_COUNT],
            upper: [0.0; DOF_COUNT],
        };
        let TorqueRange { lower, upper } = &mut available;
        self.strength.range(&angles, &rates, &scale, lower, upper);
        let motors = MotorLaw::STIFF;
        let command: MotorCommand = motors.command(
            &motors.law(self.world.dt),
            &self.body,
            state,
            &Self::pair(self.aim),
        );
        let desired = Self::pair(self.desired);
        let input = StepInput {
            body: &self.body,
            links: &self.links,
            strength: &self.strength,
            scale: &scale,
            start: TickStart {
                terms: &self.terms,
                swings: &swings,
                available: &available,
            },
            last_acceleration: &[0.0; NV],
            command: &command,
            tissue: Some(&tissue),
            forces: StepForces {
                applied: &[],
                bar: None,
                assist: None,
            },
            own: self.meets.then_some(OwnBody {
                shape: &self.shape,
                desired: &desired,
            }),
            world: &self.world,
        };
        self.stepper.step(&input, state);
    }

    /// Depth by which the body overlaps itself more than desired, m, and where.
    fn depth(&self, posture: &Posture) -> (f64, [&'static str; 2]) {
        let mut allowed = Vec::new();
        distances(&self.body, &self.shape, &self.desired, |_, near| {
            allowed.push(near.gap.min(0.0))
        });
        let mut worst = (0.0, ["", ""]);
        let mut k = 0;
        distances(&self.body, &self.shape, posture, |pair, near| {
            if allowed[k] - near.gap > worst.0 {
                worst = (allowed[k] - near.gap, pair.map(|s| s.name()));
            }
            k += 1;
        });
        worst
    }

    /// Kinetic energy plus that of stretched tissue, J.
    fn energy(&self, state: &State) -> f64 {
        let mut kin = Kinematics::default();
        kin.set_state(&self.links, state);
        kinetic_energy(&self.links, &kin)
            + rotor_energy(&self.links, &state.velocity)
            + self.strength.stored(&anatomical_angles(&state.posture))
    }
}

/// A posture with these angles, rad.
fn posture(angles: &[(&str, f64)]) -> Posture {
    let mut all = [0.0; DOF_COUNT];
    for (name, angle) in angles {
        all[DOF_NAMES.iter().position(|n| n == name).unwrap()] = *angle;
    }
    let mut out = Posture::default();
    set_anatomical_angles(&mut out, &all);
    out
}

/// Arms and legs away from everything.
fn apart() -> Posture {
    posture(&[
        ("l_shoulder_abduction", 0.8),
        ("r_shoulder_abduction", 0.8),
        ("l_hip_abduction", 0.25),
        ("r_hip_abduction", 0.25),
        ("l_elbow_flexion", 0.5),
        ("r_elbow_flexion", 0.5),
    ])
}

/// Both forearms in the trunk, one higher than the other, legs crossed.
fn folded() -> Posture {
    posture(&[
        ("l_shoulder_flexion", 0.5),
        ("r_shoulder_flexion", 0.2),
        ("l_shoulder_abduction", -0.3),
        ("r_shoulder_abduction", -0.2),
        ("l_shoulder_rotation", 1.2),
        ("r_shoulder_rotation", 1.1),
        ("l_elbow_flexion", 1.7),
        ("r_elbow_flexion", 1.5),
        ("l_hip_abduction", -0.4),
        ("r_hip_abduction", -0.35),
        ("r_hip_flexion", 0.1),
    ])
}

#[test]
fn capsules_of_a_body_at_rest_are_as_near_as_expected() {
    let rig = Rig::new(1.0, 0.0, true);
    let name = |posture: &Posture| {
        let mut all = Vec::new();
        distances(&rig.body, &rig.shape, posture, |pair, near| {
            if near.gap < 0.01 {
                all.push((pair.map(|s| s.name()), (1e3 * near.gap) as i32));
            }
        });
        all
    };
    println!("apart {:?}", name(&apart()));
    println!("zero {:?}", name(&Posture::default()));
    println!(
        "at ease {:?}",
        name(&crate::motion::builtin::at_ease(&rig.body))
    );
    println!("folded {:?}", name(&folded()));
    assert_eq!(name(&apart()), []);
}

/// Largest depth within 2 s.
fn driven(meets: bool) -> (f64, [&'static str; 2]) {
    let mut rig = Rig::new(1.0, 0.0, meets);
    rig.aim = folded();
    let mut state = State::at_rest(apart());
    state.posture.root_position.z = 5.0;
    let mut worst = (0.0, ["", ""]);
    for i in 0..120 {
        rig.step(&mut state);
        assert!(state.is_finite());
        let depth = rig.depth(&state.posture);
        if i % 10 == 0 {
            println!("{i}: {depth:?} energy {:.2}", rig.energy(&state));
        }
        if depth.0 > worst.0 {
            worst = depth;
        }
    }
    worst
}

#[test]
fn arms_and_legs_that_are_driven_inwards_stop_at_the_surface() {
    let (with, without) = (driven(true), driven(false));
    println!("{with:?} instead of {without:?}");
    assert!(with.0 < 0.05 && without.0 > 0.1, "{with:?} {without:?}");
}

/// Thrown down tumbling, limbs flung about.
fn thrown(rng: &mut Pcg64Mcg) -> State {
    let mut state = State::at_rest(apart());
    state.posture.root_position.z = 1.5;
    let mut r = |most: f64| rng.random_range(-most..most);
    state.posture.root_rotation = Quat::exp(vec3(r(2.0), r(2.0), r(2.0)));
    for v in &mut state.velocity[..3] {
        *v = r(4.0);
    }
    for v in &mut state.velocity[6..] {
        *v = r(6.0);
    }
    state
}

fn fallen(meets: bool) -> Vec<(f64, [&'static str; 2])> {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    (0..8)
        .map(|_| {
            let mut rig = Rig::new(0.02, 9.81, meets);
            rig.aim = apart();
            let mut state = thrown(&mut rng);
            let mut worst = (0.0, ["", ""]);
            for _ in 0..150 {
                rig.step(&mut state);
                let depth = rig.depth(&state.posture);
                if depth.0 > worst.0 {
                    worst = depth;
                }
            }
            let last = rig.depth(&state.posture);
            println!("meets {meets}: {worst:?}, at the end {last:?}");
            worst
        })
        .collect()
}

#[test]
fn a_limp_body_thrown_down_stays_out_of_itself() {
    let (with, without) = (fallen(true), fallen(false));
    let deep = |all: &[(f64, [&str; 2])]| all.iter().filter(|d| d.0 > 0.07).count();
    let deepest = with.iter().fold(0.0f64, |m, d| m.max(d.0));
    println!("{deepest}, {} instead of {}", deep(&with), deep(&without));
    // One lands with its trunk on an arm, at several metres per second.
    assert!(deepest < 0.1 && deep(&with) <= 1 && deep(&without) >= 6);
}

#[test]
fn arms_that_press_on_the_trunk_change_no_momentum() {
    let mut rig = Rig::new(1.0, 0.0, true);
    rig.aim = folded();
    let mut state = State::at_rest(apart());
    state.posture.root_position.z = 5.0;
    let mut pressed = 0.0f64;
    for _ in 0..120 {
        rig.step(&mut state);
        let audit = &rig.stepper.forces.audit;
        let (mut force, mut moment, mut size) = (Vec3::zero(), Vec3::zero(), 0.0f64);
        for (_, at, f) in &audit.applied {
            force += *f;
            moment += at.cross(*f);
            size = size.max(f.norm());
        }
        pressed = pressed.max(size);
        assert!(force.norm() <= 1e-9 && moment.norm() <= 1e-9 * size.max(1.0));
        // The external forces that the motion of the step requires.
        let mut terms = Terms::default();
        terms.compute(&rig.links, &audit.state, &[], 0.0);
        let (force, moment) = terms.ground_wrench(&audit.acceleration);
        let asked = force.norm().max(moment.norm());
        assert!(asked < 1e-9 * size.max(1.0), "{asked} of {size}");
    }
    assert!(pressed > 50.0, "{pressed}");
}

/// Energy at the end over that at the start of a limp body that flies for 1 s in steps of `dt`, and the largest share
/// of it that self-contact adds in one step.
fn flown(rng: &mut Pcg64Mcg, dt: f64, meets: bool) -> [f64; 2] {
    let mut rig = Rig::new(1e-9, 0.0, meets);
    (rig.world.dt, rig.world.substeps) = (dt, 1);
    let mut state = thrown(rng);
    state.posture.root_position.z = 20.0;
    let start = rig.energy(&state);
    let (mut most, mut met) = (0.0f64, 0);
    for _ in 0..(1.0 / dt) as usize {
        rig.step(&mut state);
        let mut kin = Kinematics::default();
        let audit = &rig.stepper.forces.audit;
        let after = State {
            velocity: state.velocity,
            ..audit.state
        };
        kin.set_state(&rig.links, &after);
        let work = |(s, at, force): &(SegmentId, Vec3, Vec3)| {
            let r = *at - after.posture.root_position - kin.position[s.index()];
            dt * force.dot(kin.velocity[s.index()] + kin.omega[s.index()].cross(r))
        };
        most = most.max(audit.applied.iter().map(work).sum());
        met += usize::from(!audit.applied.is_empty());
    }
    println!(
        "{start:.1} J to {:.1} J, {most:.3} J in a step, met in {met}",
        rig.energy(&state)
    );
    assert!(!meets || met > 0);
    [rig.energy(&state) / start, most / start]
}

#[test]
fn a_limp_body_that_meets_itself_gains_no_energy() {
    for seed in 0..5 {
        let rng = || Pcg64Mcg::seed_from_u64(seed);
        let dt = 1.0 / 960.0;
        let ([with, most], [without, _]) =
            (flown(&mut rng(), dt, true), flown(&mut rng(), dt, false));
        println!("{with} and {without}, {most}");
        assert!(with < 1.01 && most < 0.01, "{with} {without} {most}");
    }
}

#[test]
fn hands_in_the_hips_are_left_alone_where_the_motion_has_them_there() {
    let body = Arc::new(Body::adult_man());
    let held = |rotation: f64| {
        let mut p = posture(&[
            ("l_shoulder_abduction", 0.7),
            ("r_shoulder_abduction", 0.7),
            ("l_shoulder_rotation", rotation),
            ("r_shoulder_rotation", rotation),
            ("l_elbow_flexion", 1.6),
            ("r_elbow_flexion", 1.6),
        ]);
        p.root_position.z = body.standing_root_height();
        p
    };
    let shape = BodyShape::new(&body);
    let deepest = |p: &Posture| {
        let mut least = 0.0f64;
        distances(&body, &shape, p, |_, near| least = least.min(near.gap));
        -least
    };
    let posture = (0..20)
        .map(|k| held(0.1 * f64::from(k)))
        .max_by(|a, b| deepest(a).total_cmp(&deepest(b)))
        .unwrap();
    let depth = deepest(&posture);
    println!("{depth}");
    assert!(depth > 0.03, "the hands are in the body: {depth}");
    let mut world = World::new(WorldParams::default()).unwrap();
    let state = State::at_rest(posture);
    let mut setup = FigureSetup::new(Arc::clone(&body), ControllerKind::Modern, state);
    setup.options.self_contact = true;
    let key = world.add_figure(setup).unwrap();
    world
        .figure_mut(key)
        .unwrap()
        .set_drive(MotionSource::Hold(posture));
    for _ in 0..120 {
        world.step();
        let report = world.figure(key).unwrap().report().unwrap();
        assert!(report.audit.applied.is_empty());
    }
}

/// A posture with these angles, or with those of the other side.
fn sided(left: bool, angles: &[(&'static str, f64)]) -> Posture {
    let name = |n: &str| match n.split_at(2) {
        ("l_", rest) if !left => format!("r_{rest}"),
        ("r_", rest) if !left => format!("l_{rest}"),
        _ => n.to_owned(),
    };
    let all: Vec<(String, f64)> = angles.iter().map(|(n, a)| (name(n), *a)).collect();
    let all: Vec<(&str, f64)> = all.iter().map(|(n, a)| (n.as_str(), *a)).collect();
    posture(&all)
}

#[test]
fn what_is_mirrored_meets_itself_alike() {
    let run = |left: bool| {
        let mut rig = Rig::new(1.0, 0.0, true);
        rig.aim = sided(
            left,
            &[
                ("l_shoulder_flexion", 0.5),
                ("r_shoulder_flexion", 0.2),
                ("l_shoulder_rotation", 1.2),
                ("r_shoulder_rotation", 1.1),
                ("l_elbow_flexion", 1.7),
                ("r_elbow_flexion", 1.5),
                ("l_hip_abduction", -0.4),
            ],
        );
        let mut state = State::at_rest(apart());
        state.posture.root_position.z = 5.0;
        let mut pressed = 0;
        for _ in 0..60 {
            rig.step(&mut state);
            pressed += rig.stepper.forces.audit.applied.len();
        }
        (state, pressed)
    };
    let ((a, pressed), (b, _)) = (run(true), run(false));
    assert!(pressed > 50, "{pressed}");
    let (p, q) = (a.posture.root_position, b.posture.root_position);
    assert!((p - vec3(q.x, -q.y, q.z)).norm() < 1e-6, "{p:?} {q:?}");
    let of = |s: &State, joint: &str| {
        anatomical_angles(&s.posture)[DOF_NAMES.iter().position(|n| *n == joint).unwrap()]
    };
    for joint in [
        "shoulder_flexion",
        "shoulder_rotation",
        "elbow_flexion",
        "hip_abduction",
    ] {
        let (l, r) = (of(&a, &format!("l_{joint}")), of(&b, &format!("r_{joint}")));
        assert!((l - r).abs() < 1e-6, "{joint}: {l} {r}");
    }
}

#[test]
fn the_same_is_found_again_and_nothing_breaks_where_a_body_is_turned_inside_out() {
    let run = || {
        let mut rig = Rig::new(1.0, 9.81, true);
        rig.aim = folded();
        // It begins with a deep overlap, and fast.
        let mut state = State::at_rest(folded());
        state.posture.root_position.z = 1.0;
        for (i, v) in state.velocity.iter_mut().enumerate() {
            *v = if i % 2 == 0 { 60.0 } else { -60.0 };
        }
        for _ in 0..120 {
            rig.step(&mut state);
            assert!(state.is_finite());
        }
        state
    };
    let (a, b) = (run(), run());
    assert_eq!(a, b);
}
