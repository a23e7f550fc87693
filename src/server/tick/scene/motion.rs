//! Desired motion of figures: clips, and live motion.

use super::player::{Player, PlayoutWindow};
use super::{InputResult, PlayerKey, Scene};
use crate::engine::{self, Clip, FigureKey, Motion};
use crate::ingest::jitter_buffer::{JitterBuffer, Now, StreamSeam};
use sinew_physics::figure::motion::rehearsal_playback::{ENTRY_TIME, RehearsalEntry};
use sinew_physics::time::WorldTime;
use sinew_physics::world::{RehearsedMotion, RehearsedPlayback};
use sinew_wire::status::Fault;
use sinew_wire::types::{ClipBeginning, ClipStart, DriveSettings, Place, Playback};
use std::sync::Arc;

impl Scene {
    pub(super) fn play(
        &mut self,
        key: FigureKey,
        name: String,
        (clip, rehearsed): (Arc<Clip>, Option<Arc<RehearsedMotion>>),
        p: Playback,
    ) -> Result<InputResult, Fault> {
        let now = self.world.time();
        let begin = p.start.map_or(now, WorldTime);
        let f = self.figure_mut(key)?;
        let place = p
            .place
            .unwrap_or_else(|| engine::place_of(&f.state().posture));
        let state = engine::first_state(&clip, place);
        // A figure that is reset to the clip moves at once. One that stands enters it by the clip's lead-in, and one
        // that moves comes to a stand first.
        let mut playback = engine::playback(clip, begin, p.speed, p.looped, (place, !p.reset));
        playback.max_help = p.max_help;
        let mut begins = ClipBeginning {
            time: playback.start,
            start: ClipStart::Reset,
            rehearsed: false,
        };
        // A rehearsal begins with its way into the recording.
        let from_start = rehearsed.clone().filter(|_| p.reset && begin <= now);
        if let Some(motion) = from_start {
            let origin = engine::placing(engine::place_of(&motion.start().posture), place);
            begins.time = now + motion.lead_in();
            begins.rehearsed =
                f.rehearse_from_start(RehearsedPlayback::new(motion, now).at(origin));
        }
        if p.reset && !begins.rehearsed {
            begins.time = playback.start;
            f.set_drive(Motion::Clip(playback));
            engine::reset(&mut self.world, key, state)?;
        } else if !p.reset {
            playback.rehearsed = rehearsed;
            let entry = f.rehearsal_entry(&playback);
            begins.rehearsed = entry.is_some();
            begins.time = f.play(playback, p.place.is_some(), now);
            let waits = f.next_clip().is_some();
            begins.start = match entry {
                Some(RehearsalEntry::Led) => ClipStart::Led,
                _ if waits => ClipStart::Switch,
                _ => ClipStart::AtOnce,
            };
            if begins.start == ClipStart::Led {
                begins.time = begins.time + ENTRY_TIME;
            }
        }
        self.member_mut(key)?.clip = Some(name);
        Ok(InputResult::Begins(begins))
    }

    pub(super) fn follow(
        &mut self,
        figure: FigureKey,
        settings: DriveSettings,
        length: f64,
        takeover: Option<f64>,
    ) -> Result<InputResult, Fault> {
        // The present motion continues until there is motion to switch to.
        let (dt, time, key) = (self.world.dt(), self.world.time(), self.next_player);
        if takeover.is_none() {
            self.member_mut(figure)?.clip = None;
            self.figure_mut(figure)?.stop(time);
        }
        let f = self.figure_mut(figure)?;
        // A player that takes over decides itself when its motion has arrived.
        let window = (length > 0.0).then(|| {
            if settings.reset || takeover.is_some() {
                PlayoutWindow::new(f.body(), length)
            } else {
                PlayoutWindow::after_stop(f.body(), length, time)
            }
        });
        let stand = engine::standing(f.body(), Place::default());
        let player = Player {
            key,
            figure,
            window,
            takeover,
            reset: settings.reset,
            buffer: JitterBuffer::new(
                settings,
                dt,
                Arc::clone(f.body()),
                f.target().next.clone(),
                stand,
            ),
        };
        self.next_player += 1;
        self.players.push(player);
        Ok(InputResult::Player(key))
    }

    /// Changes figures to the players that take them over, where their motion has arrived. Returns the previous
    /// players.
    pub(super) fn take_over(&mut self, now: Now) -> Vec<PlayerKey> {
        let mut ended = Vec::new();
        let mut i = 0;
        while i < self.players.len() {
            let Some((blend, seam)) = self.seam(i, now) else {
                i += 1;
                continue;
            };
            let player = &mut self.players[i];
            player.takeover = None;
            let (key, figure) = (player.key, player.figure);
            // The previous player ends here.
            let plays = |p: &&Player| p.figure == figure && p.key != key && p.takeover.is_none();
            let before = self.players.iter().find(plays);
            let late = before.and_then(|p| Some(p.window.as_ref()?.late()));
            self.players.retain(|p| {
                let stays = p.figure != figure || p.key == key || p.takeover.is_some();
                if !stays {
                    ended.push(p.key);
                }
                stays
            });
            let player = self.players.iter_mut().find(|p| p.key == key);
            if let (Some(p), Some(f)) = (player, self.world.figure_mut(figure)) {
                p.join(f, now, blend, seam, late.unwrap_or_default());
            }
            // The removal has moved other players.
            i = 0;
        }
        ended
    }

    /// How the `i`-th player takes its figure over in the tick that begins `now`, and over how many seconds, if it
    /// does.
    fn seam(&mut self, i: usize, now: Now) -> Option<(f64, StreamSeam)> {
        let blend = self.players[i].takeover?;
        let key = self.players[i].figure;
        let plays = |p: &Player| p.figure == key && p.takeover.is_none();
        let figure = self.world.figure_mut(key)?;
        let seam = match self.players.iter().position(plays) {
            None => self.players[i].seam(figure, None, now),
            Some(j) => {
                let [player, before] = self.players.get_disjoint_mut([i, j]).ok()?;
                player.seam(figure, Some(before), now)
            }
        };
        seam.filter(|s| *s != StreamSeam::Later).map(|s| (blend, s))
    }

    pub(super) fn play_live(&mut self, now: Now) {
        for player in &mut self.players {
            // The previous player continues until its own motion has arrived.
            if player.takeover.is_some() {
                continue;
            }
            let key = player.figure;
            if player.window.is_some() {
                let Some(f) = self.world.figure_mut(key) else {
                    continue;
                };
                if let Some(state) = player.feed(now, f) {
                    let _ = engine::reset(&mut self.world, key, state);
                }
                continue;
            }
            let Some((pair, reset)) = player.sample(now) else {
                continue;
            };
            let first = reset.then(|| pair.now.state());
            // Before the reset, which would carry out a stop that is still being planned.
            if let Some(f) = self.world.figure_mut(key) {
                f.set_drive(Motion::External(pair));
            }
            if let Some(state) = first {
                // The motion was checked when it came from the wire, so there is nothing left to refuse.
                let _ = engine::reset(&mut self.world, key, state);
            }
        }
    }
}
