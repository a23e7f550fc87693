//! Goal: a world that is replayed from any of its checkpoints is the same in each tick, bit for bit, on any number of
//! threads, and a difference is reported with its place. Method: a scene with every kind of change by clients (figures
//! that come and go, clips, live motion with and without a window that comes in bursts and is handed over, loads,
//! obstacles, late plans) keeps a journal as a server does. `SINEW_REPLAYS` is the number of replays.

use super::*;
use crate::engine::{self, Clip, FigureKey, ObstacleKey};
use crate::ingest::jitter_buffer::BufferedFrame;
use crate::ingest::time::{ScheduledTime, SourceTime};
use crate::tick::journal::{Journal, JournalSegment, Room, Total, from_disk};
use crate::tick::scene::{InputResult, PlayerKey, SceneInput};
use sinew_physics::body::Body;
use sinew_physics::collide::{Mobility, ObstacleSetup, Shape};
use sinew_physics::math::Vec3;
use sinew_wire::convert;
use sinew_wire::pb;
use sinew_wire::types::{
    Delay, Disturbance, DriveSettings, FigureDisturbance, FigureUpdate, Playback,
};
use std::cell::Cell;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Ticks between checkpoints: not a multiple of anything else here.
const STRIDE: u64 = 37;
const TICKS: u64 = 300;

struct Script {
    scene: Scene,
    body: Arc<Body>,
    walk: Arc<Clip>,
    keys: Vec<FigureKey>,
    players: Vec<PlayerKey>,
    obstacle: Option<ObstacleKey>,
}

impl Script {
    fn new() -> Self {
        let settings = convert::world::settings(Some(pb::World::default())).unwrap();
        let mut scene = Scene::new(settings).unwrap();
        scene.keep_records();
        let body = Arc::new(Body::adult_man());
        let walk = Arc::new(engine::builtin(&body, "walk").unwrap());
        Self {
            scene,
            body,
            walk,
            keys: Vec::new(),
            players: Vec::new(),
            obstacle: None,
        }
    }

    fn figure(&mut self, id: &str, y: f64) {
        let settings = convert::figure::settings(
            "",
            Some(&pb::Figure {
                controller: pb::Controller::Modern.into(),
                placement: Some(pb::Placement {
                    y_m: y,
                    ..Default::default()
                }),
                ..Default::default()
            }),
        );
        let done = self.scene.apply(SceneInput::AddFigure {
            id: id.into(),
            settings: Box::new(settings.unwrap()),
            body: Some(Arc::clone(&self.body)),
        });
        let Ok(InputResult::Figure(key)) = done else {
            panic!("{done:?}")
        };
        self.keys.push(key);
    }

    fn play(&mut self, i: usize, reset: bool) {
        let input = SceneInput::Play {
            figure: self.keys[i],
            name: "walk".into(),
            clip: Arc::clone(&self.walk),
            rehearsed: None,
            playback: Playback {
                speed: 1.0,
                looped: true,
                start: None,
                reset,
                max_help: 0.0,
                place: None,
            },
        };
        self.scene.apply(input).unwrap();
    }

    fn follow(&mut self, i: usize, window: f64, takeover: Option<f64>, reset: bool) {
        let settings = DriveSettings {
            rate_hz: 60.0,
            delay: Delay::Adaptive { most: 0.1 },
            extrapolation: 0.1,
            hold: 0.5,
            grace: 5.0,
            reset,
            window: Some(window),
        };
        let done = self.scene.apply(SceneInput::Follow {
            figure: self.keys[i],
            settings,
            window,
            takeover,
        });
        let Ok(InputResult::Player(key)) = done else {
            panic!("{done:?}")
        };
        self.players.push(key);
    }

    /// Sends a frame of a walk (or of a swinging arm), `i` frames after the first; it arrives a little late or early.
    fn send(&mut self, player: usize, i: i64, now: f64) {
        let t = i as f64 / 60.0;
        let mut posture = if player.is_multiple_of(2) {
            self.walk.sample(t.min(3.0)).posture
        } else {
            engine::standing(&self.body, Default::default())
        };
        posture.hinge[4] = 0.5 + 0.3 * (4.0 * t).sin();
        let frame = BufferedFrame {
            sequence: i,
            source: SourceTime(i * 16_666_667),
            posture,
            velocity: (player == 1).then(|| Box::new([0.0; sinew_physics::body::NV])),
            planted: (i % 5 == 0).then_some([true, true]),
            guess: Cell::default(),
            arrival: Instant::now(),
        };
        let jitter = 0.004 * f64::from((i * 7919 % 11) as i32);
        self.scene
            .take_frame(self.players[player], frame, ScheduledTime(now + jitter));
    }

    /// The commands of clients before a tick.
    fn commands(&mut self, tick: u64) {
        let now = self.scene.world().time().0;
        let push = |figure: &str, newtons: f64| FigureDisturbance {
            figure: figure.into(),
            tick: None,
            what: Disturbance::Force {
                segment: sinew_physics::body::topology::PELVIS,
                point: None,
                force: Vec3::Y * newtons,
                duration: 0.2,
            },
        };
        match tick {
            0 => {
                for (i, id) in ["a", "b", "c", "d"].iter().enumerate() {
                    self.figure(id, i as f64);
                }
                self.play(0, true);
                self.follow(1, 0.0, None, true);
                self.follow(2, 0.4, None, false);
            }
            30 => self
                .scene
                .apply(SceneInput::Stop(self.keys[0]))
                .map(drop)
                .unwrap(),
            50 => self.play(3, false),
            60 => {
                let setup = ObstacleSetup {
                    position: Vec3 {
                        x: 0.9,
                        y: 3.0,
                        z: 0.6,
                    },
                    velocity: Vec3 {
                        x: -1.5,
                        y: 0.0,
                        z: 1.0,
                    },
                    ..obstacle()
                };
                let done = self.scene.apply(SceneInput::AddObstacle {
                    id: "ball".into(),
                    setup,
                });
                let Ok(InputResult::Obstacle(_, key)) = done else {
                    panic!("{done:?}")
                };
                self.obstacle = Some(key);
            }
            70 => {
                let batch = vec![push("a", 90.0), push("d", -60.0)];
                self.scene.apply(SceneInput::Perturb(batch)).unwrap();
                // It is refused, and refused again in each replay.
                let none = self
                    .scene
                    .apply(SceneInput::Perturb(vec![push("nobody", 1.0)]));
                assert!(none.is_err());
            }
            90 => self.play(0, false),
            // Another driver takes the figure over in the middle of its stream.
            110 => self.follow(2, 0.4, Some(0.5), false),
            130 => {
                let update = FigureUpdate {
                    fatigue_time_scale: Some(30.0),
                    ..FigureUpdate::default()
                };
                let update = SceneInput::UpdateFigure(self.keys[3], Box::new(update));
                self.scene.apply(update).unwrap();
            }
            150 => {
                let input = SceneInput::UpdateObstacle(self.obstacle.unwrap(), obstacle());
                self.scene.apply(input).unwrap();
            }
            200 => {
                self.scene
                    .apply(SceneInput::Unfollow(self.players[0]))
                    .unwrap();
                self.scene.apply(SceneInput::Stop(self.keys[1])).unwrap();
                self.scene
                    .apply(SceneInput::RemoveFigure(self.keys[3]))
                    .unwrap();
            }
            230 => {
                let input = SceneInput::ResetFigure(self.keys[0], None);
                self.scene.apply(input).unwrap();
                self.scene
                    .apply(SceneInput::RemoveObstacle(self.obstacle.unwrap()))
                    .unwrap();
            }
            _ => {}
        }
        // Streams in bursts, with a gap.
        for player in 0..self.players.len() {
            let begun = [0, 0, 110][player];
            if (160..185).contains(&tick) || !tick.is_multiple_of(3) {
                continue;
            }
            for i in tick..tick + 3 {
                self.send(player, (i - begun) as i64, now);
            }
        }
    }

    /// Runs it, with a journal. `aside`: plans are computed by threads and arrive when they are ready.
    fn run(mut self, aside: bool) -> (Journal, Vec<u64>) {
        let room = Room {
            bytes: 1 << 30,
            age: Duration::from_secs(3600),
        };
        let journal = Journal::new(room, Arc::new(Total::new(1 << 30)));
        let now = Instant::now();
        journal.begin(self.scene.capture(), now);
        let mut hashes = vec![self.scene.world().state_hash()];
        for tick in 0..TICKS {
            self.commands(tick);
            self.scene.sample(0.01 * (tick / 100) as f64);
            // Some plans have not arrived when they are needed.
            let planning = if aside {
                Planning::Aside
            } else {
                Planning::InTick
            };
            if aside && !(25..58).contains(&tick) {
                self.scene.world().plan_requests().for_each(|r| r.solve());
            }
            self.scene.step(planning);
            if let Some(record) = self.scene.take_record() {
                journal.append(record);
            }
            let world = self.scene.world();
            hashes.push(world.state_hash());
            journal.stepped(world.tick(), world.state_hash());
            if world.tick().is_multiple_of(STRIDE) {
                journal.begin(self.scene.capture(), now);
            }
        }
        (journal, hashes)
    }
}

fn obstacle() -> ObstacleSetup {
    ObstacleSetup {
        name: String::new(),
        shape: Shape::Sphere { radius: 0.12 },
        mobility: Mobility::Free(2.0),
        friction: 0.6,
        position: Vec3 {
            x: 2.0,
            y: 0.0,
            z: 0.12,
        },
        rotation: sinew_physics::math::Quat::identity(),
        velocity: Vec3::zero(),
        angular_velocity: Vec3::zero(),
    }
}

fn replays() -> usize {
    let wanted = std::env::var("SINEW_REPLAYS").ok();
    wanted.map_or(12, |n| n.parse().expect("SINEW_REPLAYS is a number"))
}

fn again(
    segments: &[Arc<JournalSegment>],
    threads: usize,
    until: u64,
) -> Result<Replay, ReplayError> {
    let mut replay = Replay::new(segments[0].scene().unwrap());
    replay.scene.set_threads(threads);
    let entries = segments.iter().flat_map(|s| &s.entries);
    replay.through(entries, until, &mut |_| true)?;
    Ok(replay)
}

#[test]
fn a_world_is_done_again_bit_for_bit_from_any_checkpoint_on_any_threads() {
    let (journal, hashes) = Script::new().run(false);
    let (aside, late_hashes) = Script::new().run(true);
    assert!(hashes != late_hashes, "some plan was late");
    assert_eq!(journal.held(), Some((0, TICKS)));
    let mut done = 0;
    'all: loop {
        for (journal, hashes) in [(&journal, &hashes), (&aside, &late_hashes)] {
            for from in (0..TICKS).step_by(STRIDE as usize) {
                for threads in [1, 2, 7] {
                    if done == replays() {
                        break 'all;
                    }
                    done += 1;
                    let past = journal.past(from, TICKS).unwrap();
                    let replay = again(&past, threads, u64::MAX).unwrap();
                    assert_eq!(replay.scene.world().tick(), TICKS);
                    assert_eq!(replay.compared, TICKS - from);
                    let last = replay.scene.world().state_hash();
                    assert_eq!(last, hashes[TICKS as usize]);
                }
            }
        }
    }
    println!("{done} of {done} replays are equal");
}

#[test]
fn any_tick_that_is_held_is_found() {
    let (journal, hashes) = Script::new().run(false);
    for tick in [0, 1, 36, 37, 38, 113, 299, 300] {
        let past = journal.past(tick, tick).unwrap();
        assert!(past[0].start.tick() <= tick && tick - past[0].start.tick() <= STRIDE);
        let replay = again(&past, 1, tick).unwrap();
        let world = replay.scene.world();
        assert_eq!(
            (world.tick(), world.state_hash()),
            (tick, hashes[tick as usize])
        );
    }
    assert!(journal.past(301, 301).is_err() && journal.past(5, 4).is_err());
    // A world that goes back has another future, and the same past.
    let past = journal.past(120, 120).unwrap();
    let mut replay = again(&past, 1, 120).unwrap();
    replay.scene.keep_records();
    journal.begin_anew(replay.scene.capture(), true, Instant::now());
    assert_eq!(journal.held(), Some((0, 120)));
    replay.scene.sample(0.25);
    replay.scene.step(Planning::InTick);
    journal.append(replay.scene.take_record().unwrap());
    let world = replay.scene.world();
    journal.stepped(world.tick(), world.state_hash());
    let all = journal.past(0, 121).unwrap();
    assert_eq!(again(&all, 2, u64::MAX).unwrap().compared, 121);
}

#[test]
fn what_differs_is_told_with_its_tick() {
    let (journal, _) = Script::new().run(false);
    let mut past = journal.past(0, TICKS).unwrap();
    let first = Arc::make_mut(&mut past[2]);
    let at = first
        .entries
        .iter()
        .position(|e| matches!(e, JournalItem::Hash(90, _)));
    let JournalItem::Hash(tick, hash) = first.entries[at.unwrap()] else {
        unreachable!()
    };
    first.entries[at.unwrap()] = JournalItem::Hash(tick, hash ^ 1);
    let differs = again(&past, 1, u64::MAX).unwrap_err();
    assert_eq!(
        differs,
        ReplayError::Differs {
            tick: 90,
            expected: hash ^ 1,
            found: hash
        }
    );
    // A lost record, and a cut one.
    let mut past = journal.past(0, TICKS).unwrap();
    let first = Arc::make_mut(&mut past[1]);
    let at = first
        .entries
        .iter()
        .position(|e| matches!(e, JournalItem::Record(_)));
    first.entries.remove(at.unwrap());
    let missing = again(&past, 1, u64::MAX).unwrap_err();
    assert!(matches!(
        missing,
        ReplayError::Record {
            why: "a record is missing",
            ..
        }
    ));
}

#[test]
fn a_record_with_its_clips_comes_back_from_the_disk() {
    let (journal, _) = Script::new().run(false);
    let past = journal.past(0, TICKS).unwrap();
    let entries = past.iter().flat_map(|s| &s.entries);
    let mut clips = 0;
    let stored: Vec<JournalItem> = entries
        .map(|e| match e {
            JournalItem::Record(r) => {
                clips += r.definitions.len();
                let bytes = crate::tick::journal::on_disk(r);
                JournalItem::Record(from_disk(r.tick, &bytes).unwrap())
            }
            hash => hash.clone(),
        })
        .collect();
    assert!(clips >= 3);
    let mut replay = Replay::new(past[0].scene().unwrap());
    replay.through(&stored, u64::MAX, &mut |_| true).unwrap();
    assert_eq!(replay.compared, TICKS);
}
