//! Obstacles of a world.

use super::HostedWorld;
use crate::engine;
use crate::tick::scene::{InputResult, SceneInput};
use sinew_physics::collide::ObstacleSetup;
use sinew_physics::math::Vec3;
use sinew_wire::status::Fault;
use sinew_wire::types::{EventKind, ObstacleInfo};

impl HostedWorld {
    pub(super) fn obstacle(&self, id: &str) -> Result<usize, Fault> {
        let found = self.scene.obstacles().iter().position(|(o, _)| o == id);
        found.ok_or_else(|| {
            Fault::not_found("obstacle", format!("worlds/{}/obstacles/{id}", self.id))
        })
    }

    /// All obstacles, in the order in which they were added.
    pub fn obstacles(&self) -> Vec<ObstacleInfo> {
        let all = self.scene.obstacles().iter();
        all.map(|o| self.scene.obstacle_info(o)).collect()
    }

    /// One obstacle.
    pub fn obstacle_now(&self, id: &str) -> Result<ObstacleInfo, Fault> {
        let i = self.obstacle(id)?;
        Ok(self.scene.obstacle_info(&self.scene.obstacles()[i]))
    }

    /// The name of a new obstacle, or a free one if none is given.
    fn new_obstacle_id(&self, id: Option<String>) -> Result<String, Fault> {
        Ok(match id {
            Some(id) if self.obstacle(&id).is_ok() => {
                return Err(Fault::Exists {
                    kind: "obstacle",
                    name: format!("worlds/{}/obstacles/{id}", self.id),
                });
            }
            Some(id) => id,
            None => self.scene.free_obstacle(),
        })
    }

    /// The obstacle that [`Self::add_obstacle`] would add.
    pub fn would_add_obstacle(
        &self,
        id: Option<String>,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        let id = self.new_obstacle_id(id)?;
        engine::check_obstacle(self.scene.world(), &setup, true)?;
        Ok(ObstacleInfo {
            id,
            number: 0,
            setup,
            force: Vec3::zero(),
        })
    }

    /// Adds an obstacle.
    pub fn add_obstacle(
        &mut self,
        id: Option<String>,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        let id = self.new_obstacle_id(id)?;
        let InputResult::Obstacle(id, key) =
            self.scene.apply(SceneInput::AddObstacle { id, setup })?
        else {
            return Err(Fault::Internal("an obstacle was added".into()));
        };
        self.changed = true;
        self.world_event(EventKind::ObstacleAdded(format!("obstacles/{id}")));
        Ok(self.scene.obstacle_info(&(id, key)))
    }

    /// The obstacle as [`Self::update_obstacle`] would leave it.
    pub fn would_update_obstacle(
        &self,
        now: ObstacleInfo,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        engine::check_obstacle(self.scene.world(), &setup, false)?;
        Ok(ObstacleInfo { setup, ..now })
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
        self.scene.apply(SceneInput::UpdateObstacle(key, setup))?;
        self.changed = true;
        Ok(self.scene.obstacle_info(&self.scene.obstacles()[i]))
    }

    /// Removes an obstacle.
    pub fn remove_obstacle(&mut self, id: &str) -> Result<(), Fault> {
        self.working()?;
        let i = self.obstacle(id)?;
        let key = self.scene.obstacles()[i].1;
        self.scene.apply(SceneInput::RemoveObstacle(key))?;
        self.changed = true;
        self.world_event(EventKind::ObstacleRemoved(format!("obstacles/{id}")));
        Ok(())
    }
}
