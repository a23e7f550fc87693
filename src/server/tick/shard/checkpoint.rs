//! A world with what belongs to its clock, written into a checkpoint and made again from one.

use super::{Member, Shard};
use crate::server::engine::{self, Drive, FigureKey, ObstacleKey, World};
use crate::server::ingest::mailbox::DriverId;
use crate::server::telemetry::metrics::CheckpointTimer;
use crate::sim::world::checkpoint::Capture;
use crate::wire::convert::new_id;
use crate::wire::status::Fault;
use crate::wire::types::{EventKind, FigureSettings, WorldInfo, WorldSettings};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// What a world has on the server besides its physics. Drives are not part of it: their streams belong to connections,
/// which do not go back in time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SavedShard {
    /// Settings, with name and pace.
    pub settings: WorldSettings,
    members: Vec<SavedMember>,
    obstacles: Vec<(String, ObstacleKey)>,
    next_obstacle: u64,
    next_index: i32,
    next_driver: u64,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct SavedMember {
    id: String,
    key: FigureKey,
    index: i32,
    settings: FigureSettings,
    clip: Option<String>,
}

/// A world that a checkpoint describes.
#[derive(Debug)]
pub struct Restored {
    /// Its physics.
    pub world: World,
    /// The rest.
    pub shard: SavedShard,
}

impl Restored {
    /// Puts both together.
    ///
    /// # Errors
    /// They are not of one world.
    pub fn new(world: World, shard: SavedShard) -> Result<Self, &'static str> {
        let p = world.params();
        let s = &shard.settings;
        if (p.rate_hz, p.substeps, p.gravity) != (s.rate_hz, s.substeps, s.gravity)
            || (p.friction, p.collisions) != (s.friction, s.collisions)
            || !(0.01..=10.0).contains(&s.pace.speed)
        {
            return Err("settings of another world");
        }
        let names = |all: Vec<&String>| {
            let distinct: BTreeSet<&String> = all.iter().copied().collect();
            let named = |id: &&String| matches!(new_id("", id), Ok(Some(_)));
            distinct.len() == all.len() && all.iter().all(named)
        };
        let indices: BTreeSet<i32> = shard.members.iter().map(|m| m.index).collect();
        let fits = shard
            .members
            .iter()
            .map(|m| m.key)
            .eq(world.figures().map(|(k, _)| k))
            && shard
                .obstacles
                .iter()
                .map(|o| o.1)
                .eq(world.obstacles().map(|(k, _)| k))
            && indices.len() == shard.members.len()
            && indices.iter().all(|i| (0..shard.next_index).contains(i))
            && names(shard.members.iter().map(|m| &m.id).collect())
            && names(shard.obstacles.iter().map(|o| &o.0).collect());
        if fits {
            Ok(Self { world, shard })
        } else {
            Err("names of other figures or obstacles")
        }
    }
}

impl Shard {
    /// The state between two ticks. What takes time is done elsewhere.
    ///
    /// # Errors
    /// The world has failed.
    pub fn capture(&self) -> Result<(SavedShard, Capture), Fault> {
        self.working()?;
        let _timed = CheckpointTimer::new("capture");
        let member = |m: &Member| SavedMember {
            id: m.id.clone(),
            key: m.key,
            index: m.index,
            settings: m.settings.clone(),
            clip: m.clip.clone(),
        };
        let saved = SavedShard {
            settings: self.settings.clone(),
            members: self.members.iter().map(member).collect(),
            obstacles: self.obstacles.clone(),
            next_obstacle: self.next_obstacle,
            next_index: self.next_index,
            next_driver: self.next_driver,
        };
        Ok((saved, self.world.capture()))
    }

    /// Goes on from a checkpoint. Pace, name and whether it is paused stay as they are.
    ///
    /// # Errors
    /// Another rate or number of substeps, too many figures, or no room for their ticks. Nothing has changed then.
    pub fn restore(&mut self, from: Restored) -> Result<WorldInfo, Fault> {
        self.working()?;
        let Restored { mut world, shard } = from;
        let (new, old) = (&shard.settings, &self.settings);
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
        if shard.members.len() as u64 > self.limits.figures {
            return Err(Fault::Exhausted {
                limit: "max_figures_per_world",
                value: self.limits.figures,
                message: format!("{} figures in a checkpoint", shard.members.len()),
                retry: None,
            });
        }
        let before = self.members.len();
        for added in before..shard.members.len() {
            if let Err(fault) = self.budget.add_figure(&self.account) {
                (before..added).for_each(|_| self.budget.remove_figure(&self.account));
                return Err(fault);
            }
        }
        (shard.members.len()..before).for_each(|_| self.budget.remove_figure(&self.account));
        let drivers: Vec<DriverId> = self.drives.iter().map(|d| d.id.clone()).collect();
        for driver in drivers {
            self.end_drive(&driver, "the world was restored");
        }
        // Who controls a figure that is still there goes on doing so.
        let there = |m: &&Member| shard.members.iter().any(|s| s.id == m.id);
        let gone = self.members.iter().filter(|m| !there(m));
        for figure in gone.map(|m| m.id.clone()).collect::<Vec<_>>() {
            self.end_lease(&figure, "the world was restored");
        }
        // Who was driven has no driver now.
        let time = world.time();
        for m in &shard.members {
            let driven =
                |f: &engine::Figure| matches!(f.drive(), Drive::Live(_) | Drive::External(_));
            if let Some(f) = world.figure_mut(m.key)
                && driven(f)
            {
                f.stop(time);
            }
        }
        let tick = world.tick();
        world.set_threads(self.world.params().threads);
        self.world = world;
        self.settings = WorldSettings {
            pace: self.settings.pace.clone(),
            ..shard.settings
        };
        let member = |m: SavedMember| Member {
            id: m.id,
            key: m.key,
            index: m.index,
            settings: m.settings,
            clip: m.clip,
            told: None,
        };
        self.members = shard.members.into_iter().map(member).collect();
        self.obstacles = shard.obstacles;
        self.next_obstacle = shard.next_obstacle;
        self.next_index = shard.next_index;
        self.next_driver = self.next_driver.max(shard.next_driver);
        self.epoch += 1;
        self.restart_clock();
        // A roster of its own makes viewers take a frame of an earlier tick.
        self.roster_changed();
        self.touch();
        self.world_event(EventKind::Restored(tick));
        self.note_clips();
        Ok(self.info())
    }
}
