//! Obstacles of a world.

use super::Shard;
use crate::server::engine::{self, ObstacleKey};
use crate::sim::collide::{ObstacleSetup, Other};
use crate::wire::status::Fault;
use crate::wire::types::{EventKind, ObstacleInfo};

impl Shard {
    pub(super) fn obstacle(&self, id: &str) -> Result<usize, Fault> {
        let found = self.obstacles.iter().position(|(o, _)| o == id);
        found.ok_or_else(|| {
            Fault::not_found("obstacle", format!("worlds/{}/obstacles/{id}", self.id))
        })
    }

    pub(super) fn obstacle_info(&self, (id, key): &(String, ObstacleKey)) -> ObstacleInfo {
        let o = self.world.obstacle(*key).expect("it is in the world");
        ObstacleInfo {
            id: id.clone(),
            setup: o.setup().clone(),
            force: o.force(),
        }
    }

    /// All obstacles, in the order they were added.
    pub fn obstacles(&self) -> Vec<ObstacleInfo> {
        let all = self.obstacles.iter();
        all.map(|o| self.obstacle_info(o)).collect()
    }

    /// Adds an obstacle.
    pub fn add_obstacle(
        &mut self,
        id: Option<String>,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        let id = match id {
            Some(id) if self.obstacle(&id).is_ok() => {
                return Err(Fault::Exists {
                    kind: "obstacle",
                    name: format!("worlds/{}/obstacles/{id}", self.id),
                });
            }
            Some(id) => id,
            None => (self.next_obstacle..)
                .map(|n| format!("obstacle-{n}"))
                .find(|id| self.obstacle(id).is_err())
                .expect("there is a free number"),
        };
        let key = engine::add_obstacle(&mut self.world, setup)?;
        self.next_obstacle += 1;
        self.obstacles.push((id.clone(), key));
        self.changed = true;
        self.world_event(EventKind::ObstacleAdded(format!("obstacles/{id}")));
        Ok(self.obstacle_info(&(id, key)))
    }

    /// Replaces an obstacle.
    pub fn update_obstacle(
        &mut self,
        id: &str,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        let i = self.obstacle(id)?;
        engine::update_obstacle(&mut self.world, self.obstacles[i].1, setup)?;
        self.changed = true;
        Ok(self.obstacle_info(&self.obstacles[i]))
    }

    /// Removes an obstacle.
    pub fn remove_obstacle(&mut self, id: &str) -> Result<(), Fault> {
        self.working()?;
        let i = self.obstacle(id)?;
        let (_, key) = self.obstacles.remove(i);
        self.world.remove_obstacle(key);
        self.changed = true;
        self.world_event(EventKind::ObstacleRemoved(format!("obstacles/{id}")));
        Ok(())
    }

    /// What a figure touches, as it is called outside; empty for something that has gone.
    pub(super) fn name_of(&self, other: Other) -> String {
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
}
