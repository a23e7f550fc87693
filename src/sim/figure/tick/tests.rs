//! What a figure does when its numbers break.

use super::*;
use crate::sim::figure::FigureEvent;
use crate::sim::world::{World, WorldParams};

#[test]
fn a_figure_that_is_not_finite_is_frozen_told_once_and_harms_nobody() {
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
                world.figure(key).unwrap().state_hash()
            })
            .collect();
        (all, told, world, victim)
    };
    let (alone, ..) = hashes(false);
    let (beside, told, mut world, victim) = hashes(true);
    assert_eq!(alone, beside);
    assert_eq!(told, 1);
    // A reset takes it back into the world.
    let mut state = State::default();
    state.posture.root_position.z = body.standing_root_height();
    world.reset_figure(victim, state).unwrap();
    for _ in 0..60 {
        world.step();
    }
    let f = world.figure(victim).unwrap();
    assert!(!f.report().unwrap().flags.has(Flags::QUARANTINED) && !f.is_fallen());
}
