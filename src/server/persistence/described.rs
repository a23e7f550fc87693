//! The form of worlds and clips on disk: everything except the states of worlds and the content of clips.

use crate::api::access;
use crate::recordings::{Recordings, StoredRecording};
use crate::shares::comes_back;
use crate::worlds::WorldHandle;
use prost::Message;
use sinew_wire::convert::{figure, obstacle, world};
use sinew_wire::pb;
use sinew_wire::types::{ControlInfo, KeptLease};
use std::time::Duration;

/// The stored description of a world, apart from its states.
#[derive(Clone, PartialEq, Message)]
pub(super) struct StoredWorld {
    #[prost(message, optional, tag = "1")]
    pub world: Option<pb::World>,
    #[prost(message, repeated, tag = "2")]
    pub figures: Vec<pb::Figure>,
    #[prost(message, repeated, tag = "3")]
    pub obstacles: Vec<pb::Obstacle>,
    #[prost(message, repeated, tag = "4")]
    pub grants: Vec<pb::Grant>,
    #[prost(message, repeated, tag = "5")]
    pub recordings: Vec<StoredRecording>,
    #[prost(message, repeated, tag = "6")]
    pub controls: Vec<StoredControl>,
    /// The client that the world counts for in the shares; empty: a client that cannot come back.
    #[prost(string, tag = "7")]
    pub owner: String,
}

impl StoredWorld {
    /// A world as it is now, without the values that change in each tick.
    pub fn now(handle: &WorldHandle, recordings: &Recordings) -> Self {
        let described = handle.described();
        let figures = described.figures.iter().map(|f| {
            pb::Figure {
                profile: None, // the name of the body implies it
                status: None,
                constraints: Vec::new(),
                ..figure::figure_out(f)
            }
        });
        let latest = handle.latest();
        let obstacles = (latest.obstacles.iter()).map(|o| obstacle::out(&handle.id, o));
        Self {
            world: Some(pb::World {
                tick: 0,
                time_s: 0.0,
                ..world::world_out(&described.world)
            }),
            figures: figures.collect(),
            obstacles: obstacles.collect(),
            grants: (handle.grants.list().iter())
                .map(|g| access::grant_out(&handle.id, g))
                .collect(),
            recordings: recordings.stored(&handle.id),
            controls: (described.controls.iter())
                .filter(|c| c.epoch > 0 || c.kept.is_some())
                .map(StoredControl::of)
                .collect(),
            owner: match handle.owner() {
                owner if comes_back(owner) => owner.to_string(),
                _ => String::new(),
            },
        }
    }

    /// Whether two descriptions, as bytes, differ in something that no state contains.
    pub fn differ(a: &[u8], b: &[u8]) -> bool {
        a != b && Self::at_rest(a) != Self::at_rest(b)
    }

    /// The description without the values that change by themselves, which are in the states.
    fn at_rest(bytes: &[u8]) -> Option<Self> {
        let mut described = Self::decode(bytes).ok()?;
        let fixed = i32::from(pb::ObstacleMobility::Fixed);
        let obstacles = described.obstacles.iter_mut();
        for o in obstacles.filter(|o| o.mobility != fixed) {
            *o = pb::Obstacle {
                pose: None,
                velocity_mps: None,
                angular_velocity_rad_s: None,
                etag: String::new(),
                ..std::mem::take(o)
            };
        }
        Some(described)
    }

    /// Whether the world stood still.
    pub fn is_paused(&self) -> bool {
        let paused = i32::from(pb::WorldState::Paused);
        self.world.as_ref().is_some_and(|w| w.state == paused)
    }
}

/// The stored control of a figure.
#[derive(Clone, PartialEq, Message)]
pub(super) struct StoredControl {
    /// Last part of the name of the figure.
    #[prost(string, tag = "1")]
    figure: String,
    #[prost(int64, tag = "2")]
    epoch: i64,
    /// The holder of the lease; empty: none.
    #[prost(string, tag = "3")]
    holder: String,
    /// SHA-256 of its token.
    #[prost(bytes = "vec", tag = "4")]
    token: Vec<u8>,
    #[prost(int32, tag = "5")]
    priority: i32,
    #[prost(uint64, tag = "6")]
    grace_ms: u64,
}

impl StoredControl {
    fn of(info: &ControlInfo) -> Self {
        let lease = info.kept.as_ref();
        Self {
            figure: info.figure.clone(),
            epoch: info.epoch,
            holder: lease.map_or_else(String::new, |l| l.holder.to_string()),
            token: lease.map_or_else(Vec::new, |l| l.token.to_vec()),
            priority: lease.map_or(0, |l| l.priority),
            grace_ms: lease.map_or(0, |l| l.grace.as_millis() as u64),
        }
    }

    /// Figure, epoch, and the lease if there was one.
    pub fn kept(self) -> (String, i64, Option<KeptLease>) {
        let token = self.token.try_into().ok();
        let lease = token.map(|token| KeptLease {
            holder: self.holder.into(),
            token,
            priority: self.priority,
            grace: Duration::from_millis(self.grace_ms),
        });
        (self.figure, self.epoch, lease)
    }
}

/// The stored description of a clip, apart from the request that made it.
#[derive(Clone, PartialEq, Message)]
pub(super) struct DescribedClip {
    #[prost(message, optional, tag = "1")]
    pub clip: Option<pb::Clip>,
    /// The principal that owns it.
    #[prost(string, optional, tag = "2")]
    pub owner: Option<String>,
}
