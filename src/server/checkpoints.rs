//! Checkpoints as they are kept in memory and handed out: bytes with the physics of a world and its state on the
//! server.
//!
//! ```text
//!   magic 8 │ format u16 │ physics, with the server's part beside it
//! ```

use super::config::Config;
use super::shares::{ClientKey, check_part};
use super::telemetry::metrics::CheckpointTimer;
use super::tick::scene::{SavedScene, Scene};
use sinew_physics::world::checkpoint::{Capture, Checkpoint, CheckpointError, Definitions};
use sinew_wire::status::Fault;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

const MAGIC: [u8; 8] = *b"SINEWWLD";
/// Version of the server's part.
const FORMAT: u16 = 4;
const HEADER: usize = 10;

/// A state of a world as bytes.
///
/// # Errors
/// The state cannot be encoded; impossible for a world of this server.
pub fn encode(capture: &Capture) -> Result<Vec<u8>, Fault> {
    let _timed = CheckpointTimer::new("encode");
    let failed = |e: &dyn std::fmt::Display| Fault::Internal(format!("writing a checkpoint: {e}"));
    let checkpoint = capture.checkpoint(&mut Definitions::default());
    let physics = checkpoint.map_err(|e| failed(&e))?.to_bytes();
    let mut out = Vec::with_capacity(HEADER + physics.len());
    out.extend(MAGIC);
    out.extend(FORMAT.to_le_bytes());
    out.extend(physics);
    Ok(out)
}

/// The world that bytes describe. Slow: not on the thread of a tick.
///
/// # Errors
/// The bytes, whose place in the request is `field`, are no checkpoint, damaged, or of another version or other
/// numerics.
pub fn decode(field: &str, bytes: &[u8]) -> Result<Scene, Fault> {
    let _timed = CheckpointTimer::new("decode");
    let lost = |message: String| Fault::DataLoss {
        reason: "CHECKPOINT_DAMAGED",
        message: format!("{field}: {message}"),
    };
    let none = || Fault::invalid(field, "these bytes are not a checkpoint");
    let header = bytes.get(..HEADER).ok_or_else(none)?;
    if header[..8] != MAGIC {
        return Err(none());
    }
    let version = u16::from_le_bytes([header[8], header[9]]);
    if version != FORMAT {
        return Err(other_version(format!(
            "{field}: a checkpoint of format {version}, this server reads format {FORMAT}"
        )));
    }
    let refused = |e: CheckpointError| match e {
        CheckpointError::Format { .. } => other_version(format!("{field}: {e}")),
        CheckpointError::TooLarge(_) => Fault::invalid(field, e.to_string()),
        e => lost(e.to_string()),
    };
    let read = Checkpoint::from_bytes(&bytes[HEADER..]).map_err(refused)?;
    if !read.is_of_this_numerics() {
        return Err(other_version(format!(
            "{field}: a checkpoint of a program that computes otherwise: it would not go on bit for bit"
        )));
    }
    let (world, saved) = read
        .restore_with::<SavedScene<'static>>(|_| None)
        .map_err(refused)?;
    Scene::restored(world, saved).map_err(|e| lost(e.to_owned()))
}

fn other_version(message: String) -> Fault {
    Fault::Precondition {
        reason: "CHECKPOINT_VERSION",
        message,
        facts: vec![],
    }
}

/// A stored checkpoint.
#[derive(Debug)]
pub struct KeptCheckpoint {
    /// Last part of the name of its world.
    pub world: String,
    /// Last part of its name.
    pub id: String,
    /// Tick of the state.
    pub tick: u64,
    /// World time, s.
    pub time: f64,
    /// State hash.
    pub hash: u64,
    /// The state.
    pub bytes: Vec<u8>,
    /// When it was taken.
    pub created: SystemTime,
    /// The client that took it.
    pub owner: ClientKey,
}

/// All stored checkpoints, by world and name.
#[derive(Debug)]
pub struct Checkpoints {
    all: Mutex<BTreeMap<(String, String), Arc<KeptCheckpoint>>>,
    most: u64,
    most_bytes: u64,
    share: f64,
}

impl Checkpoints {
    /// None yet, with the limits of the settings.
    pub fn new(config: &Config) -> Self {
        Self {
            all: Mutex::default(),
            most: config.max_checkpoints,
            most_bytes: config.max_checkpoint_bytes,
            share: config.max_client_share,
        }
    }

    fn all(&self) -> MutexGuard<'_, BTreeMap<(String, String), Arc<KeptCheckpoint>>> {
        // Entries are whole.
        self.all.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps a checkpoint, under a free name if `id` is empty, unless `there` reports that its world is gone: a world
    /// leaves before its checkpoints are forgotten, so none is added after that.
    ///
    /// # Errors
    /// The name is taken; there are too many, or too many bytes, of all or of this client; those of `there`.
    pub fn keep(
        &self,
        mut new: KeptCheckpoint,
        there: impl FnOnce() -> Result<(), Fault>,
    ) -> Result<Arc<KeptCheckpoint>, Fault> {
        let mut all = self.all();
        there()?;
        if new.id.is_empty() {
            let free = |id: &String| !all.contains_key(&(new.world.clone(), id.clone()));
            let mut names = (new.tick..).map(|n| format!("tick-{n}"));
            new.id = names.find(free).expect("there is a free number");
        }
        let key = (new.world.clone(), new.id.clone());
        if all.contains_key(&key) {
            let name = format!("worlds/{}/checkpoints/{}", new.world, new.id);
            return Err(Fault::Exists {
                kind: "checkpoint",
                name,
            });
        }
        let own = || all.values().filter(|k| k.owner == new.owner);
        let bytes = |k: &Arc<KeptCheckpoint>| k.bytes.len() as u64;
        let size = new.bytes.len() as u64;
        let full = |limit, value| Fault::Exhausted {
            limit,
            value,
            message: "one more checkpoint".into(),
            retry: None,
        };
        let held = all.values().map(bytes).sum::<u64>();
        if all.len() as u64 >= self.most {
            return Err(full("max_checkpoints", self.most));
        }
        if held + size > self.most_bytes {
            return Err(full("max_checkpoint_bytes", self.most_bytes));
        }
        let (count, used) = (own().count() as u64, own().map(bytes).sum::<u64>());
        check_part("max_checkpoints", count, self.most, self.share)?;
        let (limit, used) = ("max_checkpoint_bytes", used + size);
        check_part(limit, used, self.most_bytes, self.share)?;
        let kept = Arc::new(new);
        all.insert(key, Arc::clone(&kept));
        tell(&all);
        Ok(kept)
    }

    /// One checkpoint.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn get(&self, world: &str, id: &str) -> Result<Arc<KeptCheckpoint>, Fault> {
        let found = self.all().get(&(world.to_owned(), id.to_owned())).cloned();
        found.ok_or_else(|| missing(world, id))
    }

    /// Those of a world, by name.
    pub fn of_world(&self, world: &str) -> Vec<Arc<KeptCheckpoint>> {
        let all = self.all();
        all.values().filter(|k| k.world == world).cloned().collect()
    }

    /// Forgets one checkpoint.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn remove(&self, world: &str, id: &str) -> Result<(), Fault> {
        let mut all = self.all();
        let gone = all.remove(&(world.to_owned(), id.to_owned()));
        tell(&all);
        gone.map(drop).ok_or_else(|| missing(world, id))
    }

    /// Forgets the checkpoints of a world.
    pub fn forget_world(&self, world: &str) {
        let mut all = self.all();
        all.retain(|_, k| k.world != world);
        tell(&all);
    }
}

/// Updates the metrics.
fn tell(all: &BTreeMap<(String, String), Arc<KeptCheckpoint>>) {
    let bytes: usize = all.values().map(|k| k.bytes.len()).sum();
    metrics::gauge!("sinew_checkpoints").set(all.len() as f64);
    metrics::gauge!("sinew_checkpoint_bytes").set(bytes as f64);
}

fn missing(world: &str, id: &str) -> Fault {
    Fault::not_found("checkpoint", format!("worlds/{world}/checkpoints/{id}"))
}
