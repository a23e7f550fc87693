//! Obstacles of a world.

use super::Shard;
use crate::server::tick::scene::{Done, Input};
use crate::sim::collide::ObstacleSetup;
use crate::wire::status::Fault;
use crate::wire::types::{EventKind, ObstacleInfo};

impl Shard {
    pub(super) fn obstacle(&self, id: &str) -> Result<usize, Fault> {
        let found = self.scene.obstacles().iter().position(|(o, _)| o == id);
        found.ok_or_else(|| {
            Fault::not_found("obstacle", format!("worlds/{}/obstacles/{id}", self.id))
        })
    }

    /// All obstacles, in the order they were added.
    pub fn obstacles(&self) -> Vec<ObstacleInfo> {
        let all = self.scene.obstacles().iter();
        all.map(|o| self.scene.obstacle_info(o)).collect()
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
            id => id,
        };
        let Done::Obstacle(id, key) = self.scene.apply(Input::AddObstacle { id, setup })? else {
            return Err(Fault::Internal("an obstacle was added".into()));
        };
        self.changed = true;
        self.world_event(EventKind::ObstacleAdded(format!("obstacles/{id}")));
        Ok(self.scene.obstacle_info(&(id, key)))
    }

    /// Replaces an obstacle.
    pub fn update_obstacle(
        &mut self,
        id: &str,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        let i = self.obstacle(id)?;
        let key = self.scene.obstacles()[i].1;
        self.scene.apply(Input::UpdateObstacle(key, setup))?;
        self.changed = true;
        Ok(self.scene.obstacle_info(&self.scene.obstacles()[i]))
    }

    /// Removes an obstacle.
    pub fn remove_obstacle(&mut self, id: &str) -> Result<(), Fault> {
        self.working()?;
        let i = self.obstacle(id)?;
        let key = self.scene.obstacles()[i].1;
        self.scene.apply(Input::RemoveObstacle(key))?;
        self.changed = true;
        self.world_event(EventKind::ObstacleRemoved(format!("obstacles/{id}")));
        Ok(())
    }
}
