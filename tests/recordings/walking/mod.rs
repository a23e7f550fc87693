//! Goal: recorded walks start from standing, continue for as long as they repeat, and come to a stand, in torque
//! simulation at the strength of a person and without any help. Method: clips from the motion capture folder,
//! retargeted with default options, 60 Hz with two substeps, the modern controller.
//!
//! * here: from standing to standing, repeatedly, by other people.
//! * `pushes`: unplanned steps.
//! * `loads`: loads in the hands.
//! * `pieces`: backwards.

mod loads;
mod pieces;
mod pushes;

use crate::common::{figure, man, mocap, recorded, recorded_with};
use sinew_evaluate::experiments::walk::{self as experiments, WalkTrial, Walker};
use sinew_physics::body::topology::{CHEST, L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::body::{Body, Links, Posture, Profile, SegmentId, Sex};
use sinew_physics::dynamics::{Kinematics, momentum};
use sinew_physics::figure::{ControllerKind, Flags};
use sinew_physics::math::Vec3;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::plan::cycle;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureKey, MotionSource, World, WorldParams};
use std::sync::Arc;

const RATE: f64 = 60.0;

/// A world with a figure that plays `clip` from time `from` of the clip, s.
fn playing(body: &Arc<Body>, clip: Arc<Clip>, from: f64, looped: bool) -> (World, FigureKey) {
    let start = clip.sample(from);
    let mut world = World::new(WorldParams::default()).unwrap();
    let key = world
        .add_figure(figure(body, ControllerKind::Modern, start.state()))
        .unwrap();
    let figure = world.figure_mut(key).unwrap();
    figure.set_drive(MotionSource::Clip(ClipPlayback {
        looped,
        ..ClipPlayback::new(clip, WorldTime(-from))
    }));
    (world, key)
}

/// Root mean square of the joint errors, degrees, and largest error of the capture point, m.
fn walk(body: &Arc<Body>, name: &str, clip: &Arc<Clip>, looped: bool, seconds: f64) -> (f64, f64) {
    let lead = clip.lead_in();
    let from = if looped { lead + 1.0 } else { 0.0 };
    let (mut world, key) = playing(body, Arc::clone(clip), -lead, looped);
    run(&mut world, key, name, seconds, from)
}

/// [`walk`] for a figure that is ready to go; the capture point counts from time `from` (s).
fn run(world: &mut World, key: FigureKey, name: &str, seconds: f64, from: f64) -> (f64, f64) {
    let (mut sum, mut count, mut capture) = (0.0, 0, 0.0f64);
    for tick in 0..(seconds * RATE) as usize {
        world.step();
        let figure = world.figure(key).unwrap();
        let r = figure.report().unwrap();
        assert!(
            !figure.is_fallen(),
            "{name} falls at {:.2} s",
            tick as f64 / RATE
        );
        assert!(r.joints.over_limit <= 1e-9 && !r.flags.has(Flags::QUARANTINED));
        sum += r.joints.joint_error.iter().map(|e| e * e).sum::<f64>();
        count += r.joints.joint_error.len();
        let e = figure.tracker().capture().error;
        // The lead-in is a start from standing, but the bound is that of steady walking.
        if tick as f64 / RATE > from {
            capture = capture.max(e[0].hypot(e[1]));
        }
    }
    let rms = (sum / f64::from(count as u32)).sqrt().to_degrees();
    println!(
        "{name}: {seconds:.1} s, joints {rms:.2} deg rms, capture point within {:.0} mm",
        1e3 * capture
    );
    (rms, capture)
}

/// Options that turn runs into walks.
fn walked() -> RetargetOptions {
    RetargetOptions {
        preparation: Preparation::walking(true),
        ..RetargetOptions::default()
    }
}

/// Figures follow every recording on foot from standing to standing, with feet that stay where they land and come down
/// softly. Single clips are guarded by the survey (`make survey`).
#[test]
fn walks_start_from_standing_and_stop() {
    let body = man();
    for name in mocap::on_feet() {
        let clip = recorded_with(&body, name, &walked());
        let ends = [
            (clip.lead_in(), clip.samples().next()),
            (clip.lead_out(), clip.samples().last()),
        ];
        for (way, end) in ends {
            let (posture, planted) = end.unwrap();
            // Recordings that already stand do so in their own way: a boxer low, a dancer on one foot.
            let stands = posture.root_position.z > 0.8 && planted == [true; 2];
            assert!(way == 0.0 || stands, "{name}: {planted:?}, {posture:?}");
        }
        let w = experiments::walk(&Walker::new(&body), &WalkTrial::once(&clip));
        let rms = w.report.tracking_joint_rms_deg;
        let text = format!(
            "{name}: {rms:.2} deg, capture point {:.0} mm, slides {:.1} mm, floor pushes {:.2} weights",
            1e3 * w.capture[1],
            1e3 * w.slip,
            w.peak[0]
        );
        println!("{text}");
        assert!(w.stood(), "{name} fell at {:?} s", w.fell_s);
        assert!(rms < 2.5 && w.capture[1] < 0.12, "{text}");
        assert!(w.slip < 0.0021 && w.peak[0] < 2.4, "{text}");
    }
}

#[test]
fn what_a_heel_carried_the_toes_carry_when_it_rises() {
    let body = man();
    let feet = [(L_FOOT, L_TOES), (R_FOOT, R_TOES)];
    for name in ["walk", "turn"] {
        let clip = recorded(&body, name);
        let seconds = clip.lead_in() + clip.duration();
        let (mut world, key) = playing(&body, Arc::clone(&clip), -clip.lead_in(), false);
        let (mut rises, mut most) = (0, 0.0f64);
        for _ in 0..(seconds * RATE) as usize {
            world.step();
            let figure = world.figure(key).unwrap();
            let target = &figure.target().next;
            for (side, (foot, toes)) in feet.into_iter().enumerate() {
                // One foot is rolling off, and the other one is in the air.
                let (ankle, rotation) = forward(&body, &target.posture)[foot.index()];
                let heel = body.segment(foot).contact_points[0];
                let height = (ankle + rotation.rotate(heel)).z;
                let alone = target.planted[side] && !target.planted[1 - side];
                if !alone || !(0.003..0.012).contains(&height) {
                    continue;
                }
                let contacts = &figure.report().unwrap().contacts;
                let load = |s: SegmentId| -> f64 {
                    contacts
                        .iter()
                        .filter(|c| c.segment == s)
                        .map(|c| c.force.z)
                        .sum()
                };
                rises += 1;
                most = most.max(load(foot) / (load(foot) + load(toes)));
            }
        }
        println!("{name}: the heel carries {most:.2} at most in {rises} ticks");
        assert!(rises > 4 && most < 0.2, "{name}: {most} in {rises} ticks");
    }
}

#[test]
fn a_walk_repeats_for_a_minute() {
    let body = man();
    let walk_cycle = cycle(&body, &recorded(&body, "walk")).expect("a walk has a cycle");
    assert!(walk_cycle.duration() > 1.0 && walk_cycle.advance().x > 1.0);
    let (rms, capture) = walk(&body, "walk", &Arc::new(walk_cycle), true, 60.0);
    assert!(rms < 0.5, "{rms} deg");
    assert!(capture < 0.04, "{capture} m");
}

#[test]
fn what_is_made_to_repeat_has_no_seam() {
    let body = man();
    let mut repeated = 0;
    for name in mocap::on_feet() {
        let Some(repeats) = cycle(&body, &recorded_with(&body, name, &walked())) else {
            continue;
        };
        let (first, end) = (
            repeats.sample_looped(0.0),
            repeats.sample_looped(repeats.duration() - 1e-6),
        );
        let off = first.posture.joint_difference(&end.posture);
        let off = off.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        assert!(off < 0.02, "the seam of {name} is open by {off} rad");
        repeated += 1;
    }
    assert!(repeated > 8, "{repeated}");
}

#[test]
fn people_of_other_sizes_walk_the_same_recording() {
    let man = |height, mass| Profile {
        height,
        mass,
        ..Profile::ordinary(Sex::Male, 30.0)
    };
    for (name, body) in [
        ("woman", Body::adult_woman()),
        ("1.55 m", Body::humanoid(man(1.55, 60.0)).unwrap()),
        ("1.95 m", Body::humanoid(man(1.95, 92.0)).unwrap()),
    ] {
        let walk_cycle = cycle(&body, &recorded(&body, "walk")).unwrap();
        let (rms, capture) = walk(&Arc::new(body), name, &Arc::new(walk_cycle), true, 20.0);
        assert!(rms < 4.0 && capture < 0.1, "{name}: {rms} deg, {capture} m");
    }
}

#[test]
fn the_old_and_the_weak_walk_it_too() {
    for (age, strength, rms, furthest) in [
        (70.0, 0.8, 1.6, 0.1),
        (70.0, 0.7, 2.0, 0.12),
        (80.0, 1.0, 1.4, 0.08),
    ] {
        let body = Arc::new(Body::humanoid(Profile::ordinary(Sex::Male, age)).unwrap());
        let walk_cycle = cycle(&body, &recorded(&body, "walk")).unwrap();
        let walker = Walker {
            strength,
            ..Walker::new(&body)
        };
        let w = experiments::walk(
            &walker,
            &WalkTrial::over_and_over(&Arc::new(walk_cycle), 20.0),
        );
        let text = format!(
            "{age} years, {strength}: {:.2} deg, {:.3} m",
            w.report.tracking_joint_rms_deg, w.capture[1]
        );
        println!("{text}");
        assert!(
            w.stood() && w.report.tracking_joint_rms_deg < rms && w.capture[1] < furthest,
            "{text}"
        );
    }
}

#[test]
fn a_run_that_is_walked_comes_to_a_stand() {
    let body = man();
    let mut runs = 0;
    for name in mocap::on_feet() {
        let bvh = Bvh::parse(&mocap::read(&format!("{name}.bvh"))).unwrap();
        let plain = prepare_recording(
            &bvh.recording().unwrap(),
            &body,
            &RetargetOptions::default(),
        )
        .unwrap();
        let asked = prepare_recording(&bvh.recording().unwrap(), &body, &walked()).unwrap();
        if plain.report.runs.speed.is_none() {
            // Motions that do not run are unchanged.
            assert!(plain.clip.samples().eq(asked.clip.samples()), "{name}");
            continue;
        }
        // `walks_start_from_standing_and_stop` checks that it then stands.
        assert!(asked.report.runs.walked, "{name}");
        assert!(asked.clip.lead_in() > 0.0, "{name} begins standing");
        let longer = asked.clip.duration() / plain.clip.duration();
        assert!(longer > 1.3, "{name} takes {longer} times as long");
        runs += 1;
    }
    assert!(runs >= 2, "{runs}");
}

/// Which way the chest points up, world axes.
fn chest_up(body: &Body, posture: &Posture) -> Vec3 {
    let mut kin = Kinematics::default();
    kin.set_posture(&Links::new(body), posture);
    kin.rotation[CHEST.index()] * Vec3::Z
}

#[test]
fn who_jumps_takes_no_spin_along_and_lands_upright() {
    let body = man();
    let clip = recorded(&body, "jump");
    let seconds = clip.duration() + 0.5;
    let (rms, capture) = walk(&body, "jump", &clip, false, seconds);
    assert!(rms < 1.2 && capture < 0.12, "{rms} deg, {capture} m");

    let (mut world, key) = playing(&body, clip, 0.0, false);
    let (mut spin, mut bow, mut flown) = (0.0f64, 0.0f64, 0);
    for _ in 0..(seconds * RATE) as usize {
        world.step();
        let f = world.figure(key).unwrap();
        let (is, asked) = (&f.state().posture, &f.target().next.posture);
        let cosine = chest_up(&body, is).dot(chest_up(&body, asked));
        bow = bow.max(cosine.clamp(-1.0, 1.0).acos().to_degrees());
        if f.report().unwrap().contacts.is_empty() {
            let mut kin = Kinematics::default();
            kin.set_state(f.links(), f.state());
            spin = spin.max(momentum(f.links(), &kin).angular.norm());
            flown += 1;
        }
    }
    println!("{flown} ticks in the air, {spin:.1} N m s, chest off by {bow:.0} deg");
    assert!(flown > 12, "it leaves the floor for a quarter of a second");
    assert!(spin < 2.0 && bow < 25.0, "{spin} N m s, {bow} deg");
}
