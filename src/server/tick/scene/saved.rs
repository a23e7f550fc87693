//! The form of a scene in a checkpoint, and a scene from that form.

use super::record::RecordWriter;
use super::{Member, Player, PlayerKey, Scene};
use crate::engine::{Figure, Motion, ObstacleKey, World};
use serde::{Deserialize, Serialize};
use sinew_physics::figure::constraints::MAX_CONSTRAINTS;
use sinew_physics::world::checkpoint::Capture;
use sinew_wire::convert::world::is_pace;
use sinew_wire::convert::{MAX_ID, display_name, new_id};
use sinew_wire::types::WorldSettings;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// Most players of a scene that is read: each figure has one or two.
const MAX_PLAYERS: usize = 200_000;

/// The parts of a scene besides its physics.
#[derive(Debug, Serialize, Deserialize)]
pub struct SavedScene<'a> {
    settings: Cow<'a, WorldSettings>,
    members: Cow<'a, [Member]>,
    obstacles: Cow<'a, [(String, ObstacleKey)]>,
    next_obstacle: u64,
    next_index: i32,
    players: Players<'a>,
    next_player: PlayerKey,
    seq: u64,
}

/// Players hold buffers that are not copied.
#[derive(Debug)]
enum Players<'a> {
    Of(&'a [Player]),
    Own(Vec<Player>),
}

impl Serialize for Players<'_> {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Of(players) => players.serialize(to),
            Self::Own(players) => players.serialize(to),
        }
    }
}

impl<'de> Deserialize<'de> for Players<'_> {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Vec::deserialize(from).map(Self::Own)
    }
}

/// Whether requests could have made this description of a figure.
fn is_member(m: &Member) -> bool {
    display_name("", &m.settings.display_name).is_ok()
        && m.settings.constraints.len() <= MAX_CONSTRAINTS
        && m.clip.as_ref().is_none_or(|id| id.len() <= MAX_ID)
}

impl Scene {
    /// The state between two ticks. Makes the next record readable without those before.
    pub fn capture(&mut self) -> Capture {
        self.record.forget();
        let Self {
            world,
            settings,
            members,
            obstacles,
            next_obstacle,
            next_index,
            players,
            next_player,
            record,
        } = self;
        world.capture_with(&SavedScene {
            settings: Cow::Borrowed(settings),
            members: Cow::Borrowed(members),
            obstacles: Cow::Borrowed(obstacles),
            next_obstacle: *next_obstacle,
            next_index: *next_index,
            players: Players::Of(players),
            next_player: *next_player,
            seq: record.seq(),
        })
    }

    /// Makes a scene from a world and the other parts captured with it.
    ///
    /// # Errors
    /// They are not of one world, or a checkpoint could not hold them.
    pub fn restored(world: World, saved: SavedScene<'static>) -> Result<Self, &'static str> {
        let SavedScene {
            settings,
            members,
            obstacles,
            next_obstacle,
            next_index,
            players,
            next_player,
            seq,
        } = saved;
        let (settings, members) = (settings.into_owned(), members.into_owned());
        let obstacles = obstacles.into_owned();
        let (p, s) = (world.params(), &settings);
        if (p.rate_hz, p.substeps, p.gravity) != (s.rate_hz, s.substeps, s.gravity)
            || (p.friction, p.collisions) != (s.friction, s.collisions)
            || !is_pace(&s.pace)
        {
            return Err("settings of another world");
        }
        let names = |all: Vec<&String>| {
            let distinct: BTreeSet<&String> = all.iter().copied().collect();
            let named = |id: &&String| matches!(new_id("", id), Ok(Some(_)));
            distinct.len() == all.len() && all.iter().all(named)
        };
        let indices: BTreeSet<i32> = members.iter().map(|m| m.index).collect();
        let fits = members
            .iter()
            .map(|m| m.key)
            .eq(world.figures().map(|(k, _)| k))
            && obstacles
                .iter()
                .map(|o| o.1)
                .eq(world.obstacles().map(|(k, _)| k))
            && indices.len() == members.len()
            && indices.iter().all(|i| (0..next_index).contains(i))
            && members.iter().all(is_member)
            && next_obstacle < u64::MAX / 2
            && seq < u64::MAX / 2
            && next_player < u64::MAX / 2
            && next_index < i32::MAX / 2
            && names(members.iter().map(|m| &m.id).collect())
            && names(obstacles.iter().map(|o| &o.0).collect());
        if !fits {
            return Err("names of other figures or obstacles");
        }
        let mut players = match players {
            Players::Own(players) => players,
            Players::Of(_) => Vec::new(),
        };
        let ascending = players.windows(2).all(|w| w[0].key < w[1].key);
        let last = players.last().map_or(0, |p| p.key);
        if !ascending || last >= next_player || players.len() > MAX_PLAYERS {
            return Err("players out of order");
        }
        for player in &mut players {
            let figure = world.figure(player.figure);
            if !figure.is_some_and(|f| player.complete(f, world.dt())) {
                return Err("live motion that cannot be");
            }
        }
        Ok(Self {
            world,
            settings,
            members,
            obstacles,
            next_obstacle,
            next_index,
            players,
            next_player,
            record: RecordWriter::after(seq),
        })
    }

    /// World time that the clock had skipped when live motion was played last, s.
    pub fn lost(&self) -> f64 {
        let lost = self.players.iter().filter_map(|p| p.buffer.lost());
        lost.fold(0.0, f64::max)
    }

    /// Ends all live motion: driven figures finish their step and stand.
    pub fn end_live(&mut self) {
        let time = self.world.time();
        self.players.clear();
        for m in &self.members {
            let driven = |f: &Figure| matches!(f.drive(), Motion::Live(_) | Motion::External(_));
            if let Some(f) = self.world.figure_mut(m.key)
                && driven(f)
            {
                f.stop(time);
            }
        }
    }
}
