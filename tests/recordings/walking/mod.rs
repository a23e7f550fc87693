//! Goal: recorded walks start from standing, go on for as long as they repeat, and come to a stand, in torque
//! simulation at the strength of a person and without any help. Method: clips from the motion capture folder,
//! retargeted as they come, 60 Hz with two substeps, the modern controller.
//!
//! * here: from standing to standing, again and again, with noise, by other people.
//! * `pushes`: steps that nobody planned.
//! * `loads`: what hands carry.
//! * `pieces`: backwards, and broken off.

mod loads;
mod pieces;
mod pushes;

use crate::common::{figure, man, mocap, recorded, recorded_with};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sinew::evaluate::experiments::walk::{self as experiments, Walk, Walker};
use sinew::evaluate::noise::noisy;
use sinew::sim::body::topology::{CHEST, L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew::sim::body::{Body, Links, Posture, Profile, SegmentId, Sex};
use sinew::sim::dynamics::{Kinematics, momentum};
use sinew::sim::figure::{ControllerKind, Flags};
use sinew::sim::math::Vec3;
use sinew::sim::motion::leg_ik::forward;
use sinew::sim::motion::{Bvh, Clip};
use sinew::sim::plan::cycle;
use sinew::sim::retarget::retarget;
use sinew::sim::retarget::{Preparation, RetargetOptions};
use sinew::sim::world::{ClipPlayback, Drive, FigureKey, World, WorldParams};
use std::ops::Range;
use std::sync::Arc;

const RATE: f64 = 60.0;

/// A world with a figure that plays `clip` from its sample at time `from` of the clip on, s.
fn playing(body: &Arc<Body>, clip: Arc<Clip>, from: f64, looped: bool) -> (World, FigureKey) {
    let start = clip.sample(from);
    let mut world = World::new(WorldParams::default()).unwrap();
    let key = world
        .add_figure(figure(body, ControllerKind::Modern, start.state()))
        .unwrap();
    let figure = world.figure_mut(key).unwrap();
    figure.set_drive(Drive::Clip(ClipPlayback {
        looped,
        ..ClipPlayback::new(clip, -from)
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

/// The same of a figure that is ready to go; the capture point counts from time `from` (s) on.
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
        // The way in is a start from standing; the bound is that of steady walking.
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

#[test]
fn walks_start_from_standing_and_stop() {
    let body = man();
    // Furthest that the capture point may be off, m.
    for (name, furthest) in [
        ("walk", 0.04),
        ("turn", 0.06),
        ("walk-around", 0.09),
        ("salsa-a", 0.07),
        ("salsa-b", 0.08),
        ("dance", 0.12),
        ("carry", 0.08),
        ("hit", 0.08),
    ] {
        let clip = recorded(&body, name);
        let seconds = clip.lead_in() + clip.duration() + clip.lead_out() + 1.0;
        let (first, last) = (
            clip.sample(-clip.lead_in()).posture,
            clip.sample(seconds).posture,
        );
        assert!(first.root_position.z > 0.8 && last.root_position.z > 0.8);
        let (rms, capture) = walk(&body, name, &clip, false, seconds);
        assert!(
            rms < 2.5 && capture < furthest,
            "{name}: {rms} deg, {capture} m"
        );
    }
}

/// Turning a whole round in 1.2 s on both balls of his feet, by dancers of other sizes, slower and faster, and on other
/// floors.
#[test]
fn who_dances_turns_by_steps_and_stays_on_his_feet() {
    let size = |height, mass| Profile {
        height,
        mass,
        ..Profile::ordinary(Sex::Male, 30.0)
    };
    for (height, mass) in [(1.70, 70.0), (1.75, 65.0), (1.75, 90.0), (1.85, 85.0)] {
        let body = Arc::new(Body::humanoid(size(height, mass)).unwrap());
        let clip = recorded(&body, "dance");
        let w = experiments::walk(&Walker::new(&body), &Walk::once(&clip));
        let rms = w.report.tracking_joint_rms_deg;
        assert!(w.stood() && rms < 0.75, "{height} m, {mass} kg: {rms} deg");
    }
    let body = man();
    let clip = recorded(&body, "dance");
    // Faster it turns his trunk, which one ball of a foot cannot keep from twisting.
    for (speed, friction, most) in [
        (0.9, 0.9, 0.7),
        (1.1, 0.9, 1.35),
        (1.0, 0.7, 0.75),
        (1.0, 1.1, 0.7),
    ] {
        let walker = Walker {
            speed,
            friction,
            ..Walker::new(&body)
        };
        let once = Walk::once(&clip);
        let seconds = once.seconds / speed;
        let w = experiments::walk(&walker, &Walk { seconds, ..once });
        let rms = w.report.tracking_joint_rms_deg;
        assert!(w.stood() && rms < most, "{speed}, {friction}: {rms} deg");
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
                // One foot that is being rolled off, with the other one in the air.
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
fn feet_stay_where_they_land_and_come_down_softly() {
    let body = man();
    let options = RetargetOptions {
        preparation: Preparation::walking(true),
        ..RetargetOptions::default()
    };
    // Furthest slide in a stance, m, by the load on each point, and largest push of the floor, weights: what the
    // recordings themselves ask of it is 1.5 (salsa-a) to 1.95 (walk-around).
    for (name, slides, pushes) in [
        ("walk", 0.002, 2.0),
        ("turn", 0.002, 2.0),
        ("walk-around", 0.002, 2.3),
        ("salsa-a", 0.002, 1.8),
        // It turns by 166 deg over one foot, further than hip and ankle rotate.
        ("salsa-b", 0.002, 2.0),
        ("dance", 0.002, 2.0),
        ("carry", 0.002, 2.3),
        ("hit", 0.0021, 1.8),
        ("jump", 0.002, 2.4),
        ("wave", 0.002, 1.8),
        // Walked; the first step of a run lands where its recording is still in the air.
        ("quick-stop", 0.002, 1.8),
        ("run", 0.002, 2.0),
    ] {
        let clip = recorded_with(&body, name, &options);
        let w = experiments::walk(&Walker::new(&body), &Walk::once(&clip));
        let text = format!(
            "{name}: slides {:.1} mm, floor pushes {:.2} weights, one foot {:.2}",
            1e3 * w.slip,
            w.peak[0],
            w.peak[1]
        );
        println!("{text}");
        assert!(w.stood() && w.slip < slides && w.peak[0] < pushes, "{text}");
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
fn a_motion_without_a_cycle_comes_back_to_its_beginning() {
    let body = man();
    // `hit` begins with its feet 0.7 m apart: the last foot is stepped onto, not put there by a body that crouches over
    // the other.
    for (name, furthest) in [("wave", 0.04), ("hit", 0.06)] {
        let repeats =
            cycle(&body, &recorded(&body, name)).expect("it ends otherwise than it begins");
        let (first, end) = (
            repeats.sample_looped(0.0),
            repeats.sample_looped(repeats.duration() - 1e-6),
        );
        let off = first.posture.joint_difference(&end.posture);
        assert!(
            off.iter().all(|e| e.abs() < 0.02),
            "the seam of {name} closes: {off:?}"
        );
        let (rms, capture) = walk(&body, name, &Arc::new(repeats), true, 30.0);
        assert!(
            rms < 2.0 && capture < furthest,
            "{name}: {rms} deg, {capture} m"
        );
    }
}

/// Copies of a recording with 1 mm and 0.2° of noise, and the seeds of their noise.
fn copies(body: &Body, name: &str, seeds: Range<u64>) -> Vec<(u64, Clip)> {
    let bytes = mocap::read(&format!("{name}.bvh"));
    let plain = Bvh::parse(&bytes).unwrap();
    let options = RetargetOptions::default();
    let unit = retarget(&plain, body, &options).unwrap().report.size.unit_m;
    let copy = |seed| {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let random = || rng.random_range(-1.0..=1.0);
        let copy = noisy(&bytes, &plain, 0.001 / unit, 0.2, random).unwrap();
        let bvh = Bvh::parse(copy.as_bytes()).unwrap();
        (seed, retarget(&bvh, body, &options).unwrap().clip)
    };
    seeds.map(copy).collect()
}

/// What hangs on the last millimetre of a recording is luck: copies with 1 mm and 0.2° of noise, repeated for half a
/// minute.
#[test]
fn who_turns_on_the_balls_of_his_feet_does_so_again_and_again_whatever_the_noise() {
    let body = man();
    for (seed, clip) in copies(&body, "hit", 1..7) {
        let repeats = cycle(&body, &clip).expect("it has a cycle");
        let (rms, capture) = walk(&body, "hit", &Arc::new(repeats), true, 30.0);
        assert!(
            rms < 1.0 && capture < 0.08,
            "copy {seed}: {rms} deg, {capture} m"
        );
    }
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
        let w = experiments::walk(&walker, &Walk::over_and_over(&Arc::new(walk_cycle), 20.0));
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
fn who_stands_but_moves_at_the_end_comes_to_rest_as_he_stands() {
    let body = man();
    let clip = Arc::new(recorded(&body, "wave"));
    assert!(clip.lead_out() > 0.0, "it ends in motion");
    let seconds = clip.duration() + clip.lead_out() + 1.0;
    let (rms, capture) = walk(&body, "wave", &clip, false, seconds);
    assert!(rms < 0.6 && capture < 0.03, "{rms} deg, {capture} m");
}

/// Noise lifts a foot of the last sample off the floor by a fraction of a millimetre now and then. Held so, nobody
/// stands on it.
#[test]
fn who_ends_on_both_feet_stands_on_both_whatever_the_noise() {
    let body = man();
    for (seed, clip) in copies(&body, "wave", 10..15) {
        let (_, last) = clip.samples().last().unwrap();
        assert_eq!(last, [true; 2], "copy {seed}");
        let seconds = clip.duration() + clip.lead_out() + 1.0;
        let (rms, capture) = walk(&body, "wave", &Arc::new(clip), false, seconds);
        assert!(
            rms < 0.4 && capture < 0.03,
            "copy {seed}: {rms} deg, {capture} m"
        );
    }
}

#[test]
fn a_run_that_is_walked_comes_to_a_stand() {
    let body = man();
    let options = |walk_runs| RetargetOptions {
        preparation: Preparation::walking(walk_runs),
        ..RetargetOptions::default()
    };
    // What does not run is not changed.
    let plain = recorded(&body, "walk");
    let asked = recorded_with(&body, "walk", &options(true));
    assert!(plain.samples().eq(asked.samples()));

    for (name, bounds) in [("quick-stop", (0.8, 0.09)), ("run", (1.2, 0.12))] {
        let clip = recorded_with(&body, name, &options(true));
        assert!(clip.lead_in() > 0.0, "it begins standing");
        assert!(clip.duration() > 1.3 * recorded(&body, name).duration());
        let seconds = clip.lead_in() + clip.duration() + clip.lead_out() + 1.0;
        let what = format!("{name}, walked");
        let (rms, capture) = walk(&body, &what, &clip, false, seconds);
        assert!(
            rms < bounds.0 && capture < bounds.1,
            "{what}: {rms} deg, {capture} m"
        );
    }
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
