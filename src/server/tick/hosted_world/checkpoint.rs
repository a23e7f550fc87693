//! Puts a world into another state.

use super::HostedWorld;
use super::bounds::Shares;
use crate::engine::FigureKey;
use crate::telemetry::metrics::CheckpointTimer;
use crate::tick::scene::{Player, Scene, SceneInput};
use sinew_physics::world::checkpoint::Capture;
use sinew_wire::status::Fault;
use sinew_wire::types::{EventKind, WorldInfo};
use std::time::Instant;

/// The source of the state that a world continues with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateOrigin {
    /// The world begins with it. Drives without a sender continue with the motion that has arrived.
    Beginning,
    /// Another world, or an earlier version of it: the known past does not lead to this state.
    Elsewhere,
    /// Its own past: the ticks before the state remain its past.
    OwnPast,
}

impl HostedWorld {
    /// The state between two ticks. Slow work on it is done elsewhere.
    ///
    /// # Errors
    /// The world has failed.
    pub fn capture(&mut self) -> Result<Capture, Fault> {
        self.working()?;
        let _timed = CheckpointTimer::new("capture");
        self.flush();
        Ok(self.scene.capture())
    }

    /// Continues from another state. Pace, name and whether it is paused stay as they are, and so do drives of figures
    /// that are in both: their streams restart, and the figures switch to them.
    ///
    /// # Errors
    /// Another rate or number of substeps, too many figures, or no room for their ticks. Then nothing has changed.
    pub fn restore(&mut self, mut scene: Scene, from: StateOrigin) -> Result<WorldInfo, Fault> {
        self.working()?;
        let (new, old) = (scene.settings(), self.scene.settings());
        if (new.rate_hz, new.substeps) != (old.rate_hz, old.substeps) {
            return Err(Fault::Precondition {
                reason: "CHECKPOINT_OF_ANOTHER_RATE",
                message: format!(
                    "a checkpoint of {} ticks per second with {} substeps; fork a new world from it",
                    new.rate_hz, new.substeps
                ),
                facts: vec![],
            });
        }
        let (before, after) = (self.scene.members().len(), scene.members().len());
        if after as u64 > self.limits.figures {
            return Err(Fault::Exhausted {
                limit: "max_figures_per_world",
                value: self.limits.figures,
                message: format!("{after} figures in a checkpoint"),
                retry: None,
            });
        }
        for added in before..after {
            if let Err(fault) = self.budget.add_figure(&self.account) {
                (before..added).for_each(|_| self.budget.remove_figure(&self.account));
                return Err(fault);
            }
        }
        (after..before).for_each(|_| self.budget.remove_figure(&self.account));
        self.flush();
        self.end_drives_of_others(&scene);
        // Leases of figures that still exist continue.
        let there = |id: &str| scene.members().iter().any(|m| m.id == id);
        let gone = self.scene.members().iter().filter(|m| !there(&m.id));
        for figure in gone.map(|m| m.id.clone()).collect::<Vec<_>>() {
            self.end_lease(&figure, "the world was restored");
        }
        let tick = scene.world().tick();
        let pace = self.scene.settings().pace.clone();
        scene.set_threads(self.scene.world().params().threads);
        if from == StateOrigin::Beginning {
            self.lost_before = scene.lost();
            let tick = scene.world().tick();
            let grace = |p: &Player| (p.buffer.grace() / scene.world().dt()).ceil() as u64;
            let players = scene.players().iter();
            self.undriven = players.map(|p| (p.key, tick + grace(p))).collect();
        } else {
            scene.end_live();
        }
        // From here on this scene is the world.
        self.scene = scene;
        self.shares = Shares::default();
        let _ = self.scene.apply(SceneInput::Pace(pace)); // never refused
        self.follow_again();
        if let Some(journal) = &self.journal {
            self.scene.keep_records();
            let goes_back = from == StateOrigin::OwnPast;
            journal.begin_anew(self.scene.capture(), goes_back, Instant::now());
        }
        self.epoch += 1;
        self.restart_clock();
        // A roster of its own makes viewers accept a frame of an earlier tick.
        self.roster_changed();
        self.touch();
        self.world_event(EventKind::Restored(tick));
        self.note_clips();
        Ok(self.info())
    }

    /// Ends drives of figures that will no longer exist.
    fn end_drives_of_others(&mut self, scene: &Scene) {
        let there = |id: &str| scene.members().iter().any(|m| m.id == id);
        let gone =
            |s: &&super::super::drives::DrivenFigure| s.player.is_some() && !there(&s.figure);
        let slots = self.drives.iter().flat_map(|d| &d.slots);
        let figures: Vec<String> = slots.filter(gone).map(|s| s.figure.clone()).collect();
        for figure in figures {
            self.detach(&figure, "the world was restored");
        }
    }

    /// Ends the players of a figure without a driver: another source determines its motion now.
    pub(super) fn end_undriven(&mut self, figure: FigureKey) {
        let players = self.scene.players().iter();
        let own = players.filter(|p| p.figure == figure && self.undriven.contains_key(&p.key));
        for key in own.map(|p| p.key).collect::<Vec<_>>() {
            self.undriven.remove(&key);
            let _ = self.scene.apply(SceneInput::Unfollow(key)); // never refused
        }
    }

    /// Stops figures whose drives came with the state that the world began with, after the grace time of their drivers
    /// in world time. They finish their steps and stand.
    pub(in crate::tick) fn expire_undriven(&mut self) {
        let tick = self.scene.world().tick();
        while let Some((key, _)) = self.undriven.iter().find(|(_, until)| **until <= tick) {
            let key = *key;
            self.undriven.remove(&key);
            let Some(figure) = self.scene.player(key).map(|p| p.figure) else {
                continue; // it was removed with its figure
            };
            let _ = self.scene.apply(SceneInput::Unfollow(key)); // neither is refused
            let _ = self.scene.apply(SceneInput::Stop(figure));
        }
    }

    /// Connects the existing drives to the figures of this scene.
    fn follow_again(&mut self) {
        for d in 0..self.drives.len() {
            for s in 0..self.drives[d].slots.len() {
                let slot = &self.drives[d].slots[s];
                if slot.player.is_none() {
                    continue;
                }
                let found = self.member(&slot.figure);
                let settings = &self.drives[d].settings;
                self.drives[d].slots[s].player = found.ok().and_then(|i| {
                    let follow = SceneInput::Follow {
                        figure: self.scene.members()[i].key,
                        // The figure switches to it from its present motion.
                        settings: sinew_wire::types::DriveSettings {
                            reset: false,
                            ..settings.clone()
                        },
                        window: settings.window.unwrap_or(self.limits.window),
                        takeover: None,
                    };
                    match self.scene.apply(follow) {
                        Ok(crate::tick::scene::InputResult::Player(key)) => Some(key),
                        _ => None,
                    }
                });
            }
        }
    }
}
