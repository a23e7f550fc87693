//! Goal: streams that arrive while they are followed are prepared behind a window well enough to be walked, and figures
//! whose driver falls silent, or whose clip is stopped, finish their step and stand. Method: recordings as a capture
//! system would send them (fitted to the body, nothing else), sample by sample, into a figure in torque simulation. The
//! survey reports how well each is followed (`sinew survey --live-window`).

use crate::common::{figure, man, mocap, recorded, recorded_with};
use sinew_physics::body::topology::{CHEST, L_FOOT, R_FOOT};
use sinew_physics::body::{Body, Posture};
use sinew_physics::figure::{ControllerKind, Flags, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::motion::Clip;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::plan::cycle;
use sinew_physics::plan::stream::{RATE, StreamPlan};
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::time::{StreamTime, WorldTime};
use sinew_physics::world::{ClipPlayback, LivePlayback, MotionSource, World, WorldParams};
use std::sync::Arc;

/// A recording as it would be streamed.
fn bare(body: &Body, name: &str) -> Arc<Clip> {
    let options = RetargetOptions {
        preparation: Preparation::NONE,
        ..RetargetOptions::default()
    };
    recorded_with(body, name, &options)
}

/// The whole output of a stream, and the stance of its feet.
fn prepared(
    body: &Arc<Body>,
    posture: impl Fn(f64) -> Posture,
    seconds: f64,
    window: f64,
) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let mut live = StreamPlan::new(Arc::clone(body), window);
    let n = (seconds * RATE) as usize;
    let mut out = (Vec::new(), Vec::new());
    for i in 0..n {
        live.push(&posture(i as f64 / RATE), None);
        let t = StreamTime((i as f64 + 1.0) / RATE - live.window());
        live.advance(t);
        if t.0 > -1e-9 {
            let s = live.sample(t.max(StreamTime(0.0)));
            out.0.push(s.posture);
            out.1.push(s.planted);
        }
    }
    out
}

/// Measurements of a figure that follows.
struct Followed {
    /// Time of its fall, s.
    fell: Option<f64>,
    /// Errors of the joints, degrees rms.
    joints: f64,
    /// Largest error of the capture point, m.
    capture: f64,
    /// Speed of the pelvis in the end, m/s.
    speed: f64,
    /// Farthest of the feet from each other in the end, m.
    apart: f64,
}

/// Steps a world with one figure; `each` is called before each tick with the time, s.
fn watch(world: &mut World, seconds: f64, mut each: impl FnMut(&mut World, f64)) -> Followed {
    let key = world.figures().next().unwrap().0;
    let mut out = Followed {
        fell: None,
        joints: 0.0,
        capture: 0.0,
        speed: 0.0,
        apart: 0.0,
    };
    let mut count = 0.0;
    for i in 0..(seconds * RATE) as usize {
        let time = i as f64 / RATE;
        each(world, time);
        world.step();
        let f = world.figure(key).unwrap();
        let r = f.report().unwrap();
        assert!(r.joints.over_limit <= 1e-9 && !r.flags.has(Flags::QUARANTINED));
        // No figure is ahead of the frames received, or knows its footholds in advance.
        if matches!(f.drive(), MotionSource::Live(_)) {
            assert!(f.tracker().lag() > -1e-9 && !f.tracker().has_planned_footholds());
        }
        if f.is_fallen() {
            out.fell = Some(time);
            break;
        }
        count += r.joints.joint_error.len() as f64;
        out.joints += r.joints.joint_error.iter().map(|e| e * e).sum::<f64>();
        let e = f.tracker().capture().error;
        out.capture = out.capture.max(e[0].hypot(e[1]));
    }
    out.joints = (out.joints / count).sqrt().to_degrees();
    let f = world.figure(key).unwrap();
    let v = &f.state().velocity;
    out.speed = v[3].hypot(v[4]);
    let poses = forward(f.body(), &f.state().posture);
    let foot = |s: sinew_physics::body::SegmentId| poses[s.index()].0;
    out.apart = (foot(L_FOOT) - foot(R_FOOT)).norm();
    out
}

/// A world with a figure in the state in which a motion begins.
fn beginning(body: &Arc<Body>, drive: MotionSource) -> World {
    let mut world = World::new(WorldParams::default()).unwrap();
    let first = drive.targets(WorldTime(0.0), 1.0 / RATE).now;
    let state = first.state();
    let key = world
        .add_figure(figure(body, ControllerKind::Modern, state))
        .unwrap();
    world.figure_mut(key).unwrap().set_drive(drive);
    world
}

/// Streams `posture` into a figure; the stream stops when it returns `None`.
fn follow(
    body: &Arc<Body>,
    posture: impl Fn(f64) -> Option<Posture>,
    seconds: f64,
    window: f64,
) -> Followed {
    follow_pushed(body, posture, seconds, window, None)
}

/// [`follow`] for a figure that is pushed.
fn follow_pushed(
    body: &Arc<Body>,
    posture: impl Fn(f64) -> Option<Posture>,
    seconds: f64,
    window: f64,
    push: Option<Perturbation>,
) -> Followed {
    let mut motion = StreamPlan::new(Arc::clone(body), window);
    let mut fed = 0.0;
    while fed / RATE <= motion.window() {
        motion.push(&posture(fed / RATE).unwrap(), None);
        fed += 1.0;
    }
    motion.advance(StreamTime(1.0 / RATE));
    let live = Box::new(LivePlayback {
        motion,
        offset: 0.0,
    });
    let mut world = beginning(body, MotionSource::Live(live));
    let key = world.figures().next().unwrap().0;
    if let Some(push) = push {
        world.perturb(key, push).unwrap();
    }
    watch(&mut world, seconds, |world, time| {
        let f = world.figure_mut(key).unwrap();
        if let Some(live) = f.stream_mut() {
            match posture(fed / RATE) {
                Some(p) => live.motion.push(&p, None),
                None => f.stop(WorldTime(time)),
            }
        }
        fed += 1.0;
    })
}

/// Pitch of feet with the toes up, degrees: for feet that have stood for a quarter of a second, and for landing feet.
fn toes_up(body: &Body, postures: &[Posture], planted: &[[bool; 2]]) -> [f64; 2] {
    let feet = [L_FOOT, R_FOOT];
    let (mut stood, mut stands, mut lands) = ([0; 2], 0.0f64, 0.0f64);
    for (posture, planted) in postures.iter().zip(planted) {
        let poses = forward(body, posture);
        for side in 0..2 {
            stood[side] = if planted[side] { stood[side] + 1 } else { 0 };
            let toe_up = poses[feet[side].index()].1.rotate(Vec3::X).z.asin();
            if f64::from(stood[side]) > 0.25 * RATE {
                stands = stands.max(toe_up);
            } else if stood[side] > 0 {
                lands = lands.max(toe_up);
            }
        }
    }
    [stands, lands].map(f64::to_degrees)
}

/// A recording with a foot pitched up by some degrees while it carries everything would make its figure balance on a
/// heel. A window of a second sees enough to put the toes down; with less a dancer may turn on its heel.
#[test]
fn nobody_is_left_on_his_heel() {
    let body = man();
    let (mut all, mut left, mut steepest) = (0, 0, 0.0f64);
    for name in mocap::on_feet() {
        let raw = bare(&body, name);
        for window in [0.3, 0.5, 1.0] {
            let posture = |t: f64| raw.sample(t).posture;
            let (out, planted) = prepared(&body, posture, raw.duration(), window);
            let [stands, lands] = toes_up(&body, &out, &planted);
            println!(
                "{name}, {window} s: lands with its toes up by {lands:.1} deg, stands with {stands:.1}"
            );
            assert!(window < 1.0 || stands < 1.0, "{name}: {stands} deg");
            all += 1;
            left += usize::from(stands >= 1.0);
            steepest = steepest.max(lands);
        }
    }
    assert!(10 * left < all, "{left} of {all}");
    assert!(steepest > 5.0, "no foot lands on its heel: {steepest} deg");
}

#[test]
fn a_streamed_walk_goes_on() {
    let body = man();
    let walk = cycle(&body, &recorded(&body, "walk")).unwrap();
    for window in [0.3, 0.5, 1.0] {
        let f = follow(&body, |t| Some(walk.sample_looped(t).posture), 20.0, window);
        println!(
            "{window} s: joints {:.2} deg rms, capture point within {:.0} mm",
            f.joints,
            1e3 * f.capture
        );
        assert_eq!(f.fell, None, "{window} s");
        assert!(f.joints < 3.5 && f.capture < 0.15);
    }
}

#[test]
fn who_loses_balance_on_one_foot_puts_the_other_one_down_though_a_stream_does_not_wait() {
    let body = man();
    let clip = recorded(&body, "dance");
    let lead = clip.lead_in();
    let end = clip.duration() + clip.lead_out();
    let posture = |t: f64| clip.sample((t - lead).min(end)).posture;
    for at in [7.0, 7.25, 7.5] {
        let from = lead + at;
        let push = Perturbation::Force {
            segment: CHEST,
            point: Vec3::Z * 0.1,
            force: Vec3::Y * 100.0,
            from,
            to: from + 0.1,
        };
        let seconds = lead + end;
        let f = follow_pushed(&body, |t| Some(posture(t)), seconds, 1.0, Some(push));
        assert_eq!(f.fell, None, "pushed at {at} s");
    }
}

#[test]
fn a_driver_that_goes_silent_leaves_its_figure_standing() {
    let body = man();
    let walk = cycle(&body, &recorded(&body, "walk")).unwrap();
    let mut all = 0;
    for window in [0.3, 0.5, 1.0] {
        let mut standing = 0;
        print!("{window} s:");
        for phase in 0..8 {
            let silent = 4.0 + 0.14 * f64::from(phase);
            let given = |t: f64| (t < silent).then(|| walk.sample_looped(t).posture);
            let f = follow(&body, given, 10.0, window);
            let stands = f.fell.is_none() && f.speed < 0.1 && f.apart < 0.5;
            standing += usize::from(stands);
            print!(" {}", if stands { '+' } else { '-' });
        }
        println!(" {standing} of 8");
        assert!(standing >= 5, "{window} s: {standing} of 8");
        all += standing;
    }
    assert!(all >= 18, "{all} of 24");
}

/// The recording breaks off in motion; a driver that keeps sending its last posture demands the impossible of a body.
/// All that was sent is played first, as long behind as the window is; then there is time for two steps and to settle.
#[test]
fn a_recording_whose_last_posture_is_held_ends_in_a_stand() {
    let body = man();
    let (mut all, mut standing) = (0, 0);
    for name in ["walk", "turn", "walk-around", "salsa-a", "hit", "carry"] {
        let raw = bare(&body, name);
        let last = raw.duration();
        for window in [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0] {
            let posture = |t: f64| Some(raw.sample(t.min(last)).posture);
            let f = follow(&body, posture, last + 6.0, window);
            println!(
                "{name}, {window} s: fell {:?}, {:.2} m/s, feet {:.2} m apart, capture point within {:.0} mm",
                f.fell,
                f.speed,
                f.apart,
                1e3 * f.capture
            );
            all += 1;
            standing += i32::from(f.fell.is_none() && f.speed < 0.1 && f.apart < 0.5);
        }
    }
    // A figure that is off by half a metre before the end does not get there.
    assert!(10 * standing > 8 * all, "{standing} of {all}");
}

#[test]
fn a_stream_that_stands_still_is_not_broken_off() {
    let body = man();
    let raw = bare(&body, "walk");
    let mut motion = StreamPlan::new(Arc::clone(&body), 0.5);
    let at = |i: usize| raw.sample(1.0 + i as f64 / RATE).posture;
    (0..30).for_each(|i| motion.push(&at(i), None));
    (0..5).for_each(|_| motion.push(&at(29), None));
    assert!(!motion.breaks_off(), "a hiccup");
    assert_eq!(motion.moved(), 35);
    motion.push(&at(29), None);
    assert!(motion.breaks_off());
    assert_eq!((motion.fed(), motion.moved()), (36, 30));
    motion.push(&at(30), None);
    assert!(!motion.breaks_off(), "it goes on");
    let mut stands = StreamPlan::new(Arc::clone(&body), 0.5);
    (0..120).for_each(|_| stands.push(&at(0), None));
    assert!(!stands.breaks_off());
}

#[test]
fn a_clip_that_is_stopped_ends_in_a_stand() {
    let body = man();
    let walk = Arc::new(cycle(&body, &recorded(&body, "walk")).unwrap());
    let mut standing = 0;
    for phase in 0..8 {
        let stop = 3.0 + 0.14 * f64::from(phase);
        let mut world = beginning(
            &body,
            MotionSource::Clip(ClipPlayback {
                looped: true,
                ..ClipPlayback::new(Arc::clone(&walk), WorldTime(0.0))
            }),
        );
        let mut told = false;
        let f = watch(&mut world, 9.0, |world, time| {
            if !told && time >= stop {
                told = true;
                let key = world.figures().next().unwrap().0;
                world.figure_mut(key).unwrap().stop(WorldTime(time));
            }
        });
        let stands = f.fell.is_none() && f.speed < 0.1 && f.apart < 0.5;
        println!(
            "stopped at {stop:.2} s: fell {:?}, {:.2} m/s, feet {:.2} m apart, joints {:.1} deg, capture point within \
             {:.0} mm",
            f.fell,
            f.speed,
            f.apart,
            f.joints,
            1e3 * f.capture
        );
        standing += i32::from(stands);
    }
    assert!(standing >= 6, "{standing} of 8");
}

/// The transition to a stand is computed on another thread and takes over four ticks later, whether it has long been
/// finished, has just begun, or has found no thread to compute it.
#[test]
fn a_stop_takes_over_at_its_tick_however_fast_it_is_worked_out() {
    let body = man();
    let walk = Arc::new(cycle(&body, &recorded(&body, "walk")).unwrap());
    let walking = || {
        let play = ClipPlayback {
            looped: true,
            ..ClipPlayback::new(Arc::clone(&walk), WorldTime(0.0))
        };
        let mut world = beginning(&body, MotionSource::Clip(play));
        let key = world.figures().next().unwrap().0;
        (0..150).for_each(|_| world.step());
        (world, key)
    };
    let stopped = |wait: u64, others: usize| {
        let (mut world, key) = walking();
        // Plans of figures that are removed before the plans are needed.
        for _ in 0..others {
            let (mut other, key) = walking();
            let time = other.time();
            other.figure_mut(key).unwrap().stop(time);
            assert!(other.remove_figure(key));
        }
        let time = world.time();
        world.figure_mut(key).unwrap().stop(time);
        let (_keep, nothing) = std::sync::mpsc::sync_channel::<()>(0);
        let _ = nothing.recv_timeout(std::time::Duration::from_millis(wait));
        let mut took_over = None;
        for tick in 0..60 {
            world.step();
            let MotionSource::Clip(play) = world.figure(key).unwrap().drive() else {
                panic!("it walks to a stand");
            };
            if took_over.is_none() && !Arc::ptr_eq(&play.clip, &walk) {
                took_over = Some(tick);
            }
        }
        assert_eq!(took_over, Some(4), "ticks of 1/60 s");
        world.state_hash()
    };
    let at_once = stopped(0, 0);
    assert_eq!(stopped(300, 0), at_once);
    assert_eq!(stopped(0, 3), at_once);
}
