//! Obstacles of a world.

use super::Shard;
use crate::server::engine::{self, ObstacleKey};
use crate::sim::collide::{ObstacleSetup, Other};
use crate::sim::math::Vec3;
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
            number: key.0,
            setup: o.setup().clone(),
            force: o.force(),
        }
    }

    /// All obstacles, in the order they were added.
    pub fn obstacles(&self) -> Vec<ObstacleInfo> {
        let all = self.obstacles.iter();
        all.map(|o| self.obstacle_info(o)).collect()
    }

    /// One obstacle.
    pub fn obstacle_now(&self, id: &str) -> Result<ObstacleInfo, Fault> {
        Ok(self.obstacle_info(&self.obstacles[self.obstacle(id)?]))
    }

    /// The name of a new obstacle; one that is free if none is given.
    fn new_obstacle_id(&self, id: Option<String>) -> Result<String, Fault> {
        Ok(match id {
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
        engine::check_obstacle(&self.world, &setup, true)?;
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
        let key = engine::add_obstacle(&mut self.world, setup)?;
        self.next_obstacle += 1;
        self.obstacles.push((id.clone(), key));
        self.changed = true;
        self.world_event(EventKind::ObstacleAdded(format!("obstacles/{id}")));
        Ok(self.obstacle_info(&(id, key)))
    }

    /// The obstacle as [`Self::update_obstacle`] would leave it.
    pub fn would_update_obstacle(
        &self,
        now: ObstacleInfo,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        engine::check_obstacle(&self.world, &setup, false)?;
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
