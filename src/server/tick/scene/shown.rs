//! The view of a scene.

use super::{Player, Scene};
use crate::engine::{self, FigureKey, ObstacleKey};
use crate::ingest::time::SourceTime;
use sinew_physics::collide::Other;
use sinew_physics::time::WorldTime;
use sinew_wire::types::{FigureSnapshot, ObstacleInfo, RosterEntry, Snapshot};
use std::sync::Arc;

impl Scene {
    /// The name of an object that a figure touches; empty if it has been removed.
    pub fn name_of(&self, other: Other) -> String {
        match other {
            Other::Figure(key, _) => {
                let m = self.members.iter().find(|m| m.key.0 == key);
                m.map_or_else(String::new, |m| format!("figures/{}", m.id))
            }
            Other::Obstacle(key) => {
                let o = self.obstacles.iter().find(|(_, k)| *k == key);
                o.map_or_else(String::new, |(id, _)| format!("obstacles/{id}"))
            }
        }
    }

    /// An obstacle as it is now.
    pub fn obstacle_info(&self, (id, key): &(String, ObstacleKey)) -> ObstacleInfo {
        let o = self.world.obstacle(*key).expect("it is in the world");
        ObstacleInfo {
            id: id.clone(),
            number: key.0,
            setup: o.setup().clone(),
            force: o.force(),
        }
    }

    /// The figures and their bodies, by index.
    pub fn roster(&self) -> Arc<[RosterEntry]> {
        let entry = |m: &super::Member| RosterEntry {
            index: m.index,
            figure: m.id.clone(),
            body: m.settings.body.id.clone(),
        };
        self.members.iter().map(entry).collect()
    }

    /// Its figures, in the order of creation.
    pub fn figures(&self) -> Vec<FigureSnapshot> {
        // Start of the last tick, to which the report refers.
        let (dt, tick) = (self.world.dt(), self.world.tick());
        let start = WorldTime(tick.saturating_sub(1) as f64 * dt);
        let applied = |key: FigureKey| {
            let mut players = self.players.iter();
            let player = players.find(|p| p.figure == key && p.takeover.is_none());
            player
                .and_then(Player::applied)
                .unwrap_or((-1, SourceTime(0)))
        };
        let shown = |m: &super::Member| {
            let f = self.figure(m.key);
            engine::snapshot(f, (start, dt), applied(m.key), |other| self.name_of(other))
        };
        self.members.iter().map(shown).collect()
    }

    /// A frame of it outside a server: it has neither epoch nor wall time.
    pub fn snapshot(&self, world: &Arc<str>, roster: (Arc<[RosterEntry]>, i32)) -> Snapshot {
        Snapshot {
            world: Arc::clone(world),
            rate_hz: self.settings.rate_hz,
            gravity: self.settings.gravity,
            tick: self.world.tick(),
            time: self.world.time().0,
            hash: self.world.state_hash(),
            epoch: 0,
            server_ns: 0,
            roster_version: roster.1,
            roster: roster.0,
            figures: self.figures(),
            obstacles: self
                .obstacles
                .iter()
                .map(|o| self.obstacle_info(o))
                .collect(),
        }
    }
}
