//! Records of a world in a log: inputs, frames and ticks.

use crate::fuzz::edit::{damaged, edits};
use crate::fuzz::runner;
use proptest::prelude::*;
use sinew_physics::body::{Body, NV};
use sinew_server::engine;
use sinew_server::ingest::jitter_buffer::BufferedFrame;
use sinew_server::ingest::time::{ScheduledTime, SourceTime};
use sinew_server::tick::scene::{
    InputResult, RecordReader, RoundRecord, Scene, SceneInput, Unreadable,
};
use sinew_wire::convert;
use sinew_wire::pb;
use sinew_wire::types::{Delay, DriveSettings, Playback};
use std::cell::Cell;
use std::sync::Arc;
use std::time::Instant;

/// Records with items of every kind that a world produces.
fn records() -> Vec<RoundRecord> {
    let settings = convert::world::settings(Some(pb::World::default())).unwrap();
    let mut scene = Scene::new(settings).unwrap();
    scene.keep_records();
    let body = Arc::new(Body::adult_man());
    let mut out = Vec::new();
    let add = SceneInput::AddFigure {
        id: "a".into(),
        settings: Box::new(convert::figure::settings("", Some(&pb::Figure::default())).unwrap()),
        body: Some(Arc::clone(&body)),
    };
    let Ok(InputResult::Figure(figure)) = scene.apply(add) else {
        panic!("the figure is refused")
    };
    out.extend(scene.take_record());
    let walk = Arc::new(engine::builtin(&body, "walk").unwrap());
    let play = SceneInput::Play {
        rehearsed: None,
        figure,
        name: "walk".into(),
        clip: walk,
        playback: Playback {
            max_help: 0.0,
            speed: 1.0,
            looped: true,
            start: None,
            reset: true,
            place: None,
        },
    };
    scene.apply(play).unwrap();
    out.extend(scene.take_record());
    let follow = SceneInput::Follow {
        figure,
        settings: DriveSettings {
            rate_hz: 60.0,
            delay: Delay::Fixed(0.05),
            extrapolation: 0.1,
            hold: 0.5,
            grace: 5.0,
            reset: false,
            window: None,
        },
        window: 0.0,
        takeover: None,
    };
    let Ok(InputResult::Player(player)) = scene.apply(follow) else {
        panic!("the player is refused")
    };
    for i in 0..6 {
        let mut posture = engine::standing(&body, Default::default());
        posture.hinge[4] = 0.3 + 0.02 * i as f64;
        let frame = BufferedFrame {
            sequence: i,
            source: SourceTime(i * 16_666_667),
            posture,
            velocity: (i % 2 == 0).then(|| Box::new([0.1; NV])),
            planted: (i % 3 == 0).then_some([true, false]),
            guess: Cell::default(),
            arrival: Instant::now(),
        };
        scene.take_frame(player, frame, ScheduledTime(i as f64 / 60.0));
        scene.sample(0.0);
        out.extend(scene.take_record());
    }
    out
}

/// Damaged records, in the order of a world, are read or refused; records read before the damage equal those written.
#[test]
fn records_of_a_log_are_read_or_refused() {
    let good = records();
    assert!(good.len() >= 6, "{}", good.len());
    let (read, refused) = (Cell::new(0u64), Cell::new(0u64));
    let done = runner(2000).run(&(0..good.len(), edits(4)), |(which, edits)| {
        let mut reader = RecordReader::default();
        for (i, record) in good.iter().enumerate().take(which + 2) {
            let mut bytes = record.bytes.to_vec();
            if i == which {
                bytes = damaged(bytes, &edits);
            }
            let mut items = 0;
            let outcome = reader.read::<Unreadable>(&bytes, &record.definitions, |_| {
                items += 1;
                Ok(())
            });
            prop_assert!(items <= bytes.len());
            match outcome {
                Ok(()) => read.set(read.get() + 1),
                Err(_) if i >= which => refused.set(refused.get() + 1),
                Err(e) => prop_assert!(false, "what was not touched is refused: {:?}", e),
            }
        }
        Ok(())
    });
    if let Err(e) = done {
        panic!("{e}");
    }
    println!("{} records read, {} refused", read.get(), refused.get());
    assert!(read.get() > 0 && refused.get() > 0);
}
