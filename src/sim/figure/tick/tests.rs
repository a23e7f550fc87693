//! Figures whose numbers break, and figures whose plans are late.

use super::*;
use crate::body::{Body, Posture};
use crate::figure::state::figure::FigureKey;
use crate::figure::{ClipPlayback, FigureEvent, MotionSource};
use crate::math::Vec3;
use crate::motion::builtin::builtin;
use crate::motion::{Clip, Target, TargetPair};
use crate::setup::{ControllerKind, FigureSetup};
use crate::tick_context::Planning;
use crate::time::WorldTime;
use crate::world::{World, WorldParams};
use std::sync::Arc;

/// Every number shown of a figure is finite.
fn tells_finite_numbers(f: &Figure) {
    let told = format!("{:?} {:?} {:?}", f.report(), f.target(), f.following());
    let broken = ["NaN", "inf"].map(|word| told.contains(word));
    assert_eq!(broken, [false; 2]);
}

#[test]
fn a_figure_that_is_not_finite_is_frozen_reported_once_and_changes_no_other() {
    let body = Arc::new(Body::adult_man());
    let hashes = |broken: bool| {
        let mut world = World::new(WorldParams::default()).unwrap();
        let [key, victim] = [0.0, 3.0].map(|y| {
            let mut state = State::default();
            state.posture.root_position = Vec3 {
                x: 0.0,
                y,
                z: body.standing_root_height(),
            };
            let setup = FigureSetup::new(Arc::clone(&body), ControllerKind::Modern, state);
            world.add_figure(setup).unwrap()
        });
        let mut told = 0;
        let all: Vec<u64> = (0..60)
            .map(|tick| {
                if broken && tick == 20 {
                    world.figure_mut(victim).unwrap().physical.state.velocity[7] = f64::NAN;
                }
                world.step();
                let f = world.figure(victim).unwrap();
                told += f
                    .events()
                    .iter()
                    .filter(|e| **e == FigureEvent::Quarantined)
                    .count();
                assert!(f.state().is_finite());
                let frozen = f.report().unwrap().flags.has(Flags::QUARANTINED);
                assert_eq!(frozen, broken && tick >= 20);
                tells_finite_numbers(f);
                world.figure(key).unwrap().state_hash()
            })
            .collect();
        (all, told, world, victim)
    };
    let (alone, ..) = hashes(false);
    let (beside, told, mut world, victim) = hashes(true);
    assert_eq!(alone, beside);
    assert_eq!(told, 1);
    // A reset brings it back into the world.
    let mut state = State::default();
    state.posture.root_position.z = body.standing_root_height();
    world.reset_figure(victim, state).unwrap();
    for _ in 0..60 {
        world.step();
    }
    let f = world.figure(victim).unwrap();
    assert!(!f.report().unwrap().flags.has(Flags::QUARANTINED) && !f.is_fallen());
}

/// Desired motions that ask for numbers out of range, one each.
fn absurd(body: &Body) -> Vec<TargetPair> {
    let mut posture = Posture::default();
    posture.root_position.z = body.standing_root_height();
    let change = |change: fn(&mut Target)| {
        let mut target = Target::still(posture);
        target.planted = [true; 2];
        change(&mut target);
        TargetPair {
            now: target.clone(),
            next: target,
        }
    };
    vec![
        change(|t| t.posture.root_rotation.z = 3e258),
        change(|t| t.posture.ball[5].x = -7e174),
        change(|t| t.posture.root_position.x = 1e300),
        change(|t| t.posture.hinge[8] = f64::NAN),
        change(|t| t.velocity[4] = f64::INFINITY),
        change(|t| t.velocity[7] = 1e300),
    ]
}

/// A figure keeps a finite state under any request, the others continue, and its world can be stored.
#[test]
fn a_figure_whose_desired_motion_is_out_of_hand_is_set_aside() {
    let body = Arc::new(Body::adult_man());
    let mut set_aside = 0;
    for kind in [
        ControllerKind::Modern,
        ControllerKind::Paper,
        ControllerKind::Motors,
    ] {
        for (case, asked) in [None]
            .into_iter()
            .chain(absurd(&body).into_iter().map(Some))
            .enumerate()
        {
            let mut world = World::new(WorldParams::default()).unwrap();
            let [other, victim] = [0.0, 0.6].map(|y| {
                let mut state = State::default();
                state.posture.root_position = Vec3 {
                    x: 0.0,
                    y,
                    z: body.standing_root_height(),
                };
                let setup = FigureSetup::new(Arc::clone(&body), kind, state);
                world.add_figure(setup).unwrap()
            });
            (0..10).for_each(|_| world.step());
            let held = world.figure(victim).unwrap().target().next.posture;
            if let Some(asked) = &asked {
                let drive = MotionSource::External(Box::new(asked.clone()));
                world.figure_mut(victim).unwrap().set_drive(drive);
            }
            for _ in 0..5 {
                world.step();
                for f in [other, victim].map(|k| world.figure(k).unwrap()) {
                    assert!(f.state().is_finite(), "{kind:?} {case}");
                    tells_finite_numbers(f);
                }
            }
            let frozen = |w: &World, k| w.figure(k).unwrap().is_frozen();
            assert!(!frozen(&world, other), "{kind:?} {case}");
            assert!(asked.is_some() || !frozen(&world, victim));
            set_aside += usize::from(frozen(&world, victim));
            // Its memory is not refused, and a reset brings it back if it gets a different command.
            let drive = MotionSource::Hold(held);
            world.figure_mut(victim).unwrap().set_drive(drive);
            let capture = world.capture();
            let (mut restored, ()) = capture
                .restore_with()
                .unwrap_or_else(|e| panic!("{kind:?} {case}: {e}"));
            for w in [&mut world, &mut restored] {
                let mut state = State::at_rest(held);
                state.posture.root_position.y = 0.6;
                w.reset_figure(victim, state).unwrap();
                (0..30).for_each(|_| w.step());
                assert!(!frozen(w, victim), "{kind:?} {case}");
            }
            assert_eq!(world.state_hash(), restored.state_hash());
        }
    }
    assert!(set_aside > 3, "{set_aside}");
}

/// A figure that has walked for a second, and its clip.
fn walking(planning: Planning) -> (World, FigureKey, Arc<Clip>) {
    let body = Arc::new(Body::adult_man());
    let clip = Arc::new(builtin(&body, "walk").unwrap());
    let mut world = World::new(WorldParams::default()).unwrap();
    world.set_planning(planning);
    let state = clip.sample(0.0).state();
    let setup = FigureSetup::new(body, ControllerKind::Modern, state);
    let key = world.add_figure(setup).unwrap();
    world
        .figure_mut(key)
        .unwrap()
        .set_drive(MotionSource::Clip(ClipPlayback {
            looped: true,
            ..ClipPlayback::new(Arc::clone(&clip), WorldTime(0.0))
        }));
    (0..60).for_each(|_| world.step());
    (world, key, clip)
}

/// Stops it, and steps on; requests of the ticks from `solved` on are solved. Returns the number of plans that were
/// late, and the tick in which it turned to its way to a stand.
fn stopped(planning: Planning, solved: usize) -> (usize, Option<usize>, u64) {
    let (mut world, key, clip) = walking(planning);
    let time = world.time();
    world.figure_mut(key).unwrap().stop(time);
    let (mut late, mut turned) = (0, None);
    for tick in 0..90 {
        if tick >= solved {
            world.plan_requests().for_each(|r| r.solve());
        }
        world.step();
        late += world.late_plans();
        let stays = match world.figure(key).unwrap().drive() {
            MotionSource::Clip(play) => Arc::ptr_eq(&play.clip, &clip),
            _ => false,
        };
        if !stays {
            turned = turned.or(Some(tick));
        }
    }
    (late, turned, world.state_hash())
}

#[test]
fn plans_that_are_there_in_time_count_in_the_tick_that_was_fixed_for_them() {
    let in_tick = stopped(Planning::InTick, usize::MAX);
    assert_eq!((in_tick.0, in_tick.1), (0, Some(4)));
    assert_eq!(stopped(Planning::Aside, 0), in_tick);
    assert_eq!(stopped(Planning::Aside, 4), in_tick);
}

#[test]
fn a_tick_waits_for_no_plan_and_takes_a_later_one() {
    let (late, turned, _) = stopped(Planning::Aside, usize::MAX);
    assert!(late > 2 && turned.is_none(), "it walks on");
    let (late, turned, _) = stopped(Planning::Aside, 20);
    assert!(late > 0 && turned.is_some_and(|t| t > 20 && t < 60));
}
