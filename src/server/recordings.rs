//! Recordings of worlds: parts of their past, kept in memory and written as files on demand.

use super::shares::{ClientKey, check_part};
use super::tick::journal::{Journal, JournalSegment, Pin, PinEnd};
use sinew_wire::status::Fault;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

/// A recording.
#[derive(Debug)]
pub struct KeptRecording {
    /// Last part of the name of its world.
    pub world: String,
    /// Last part of its name.
    pub id: String,
    /// Creation time.
    pub created: SystemTime,
    owner: ClientKey,
    journal: Arc<Journal>,
    pin: Arc<Pin>,
}

/// A recording as it is now.
#[derive(Debug)]
pub struct Recorded {
    /// First tick and last.
    pub ticks: (u64, u64),
    /// Its size, bytes.
    pub bytes: u64,
    /// Reason for its end.
    pub end: Option<PinEnd>,
    /// The recorded segments.
    pub segments: Vec<Arc<JournalSegment>>,
}

impl KeptRecording {
    /// As it is now.
    pub fn now(&self) -> Recorded {
        let (segments, last, bytes) = self.journal.pinned(&self.pin);
        Recorded {
            ticks: (self.pin.first_tick(), last),
            bytes,
            end: self.pin.end(),
            segments,
        }
    }

    /// Ends it, unless it has ended.
    pub fn stop(&self) {
        self.journal.unpin(&self.pin);
    }
}

/// The stored part of a recording: its existence, its owner and its range. The past itself is in the log.
#[derive(Clone, PartialEq, prost::Message)]
pub struct StoredRecording {
    /// Last part of its name.
    #[prost(string, tag = "1")]
    pub id: String,
    /// The client that began it.
    #[prost(string, tag = "2")]
    pub owner: String,
    /// Its first tick.
    #[prost(uint64, tag = "3")]
    pub first: u64,
    /// Its last tick, once it has ended.
    #[prost(uint64, optional, tag = "4")]
    pub last: Option<u64>,
    /// The reason for its end, by name.
    #[prost(string, tag = "5")]
    pub end: String,
    /// Creation time, ms since 1970.
    #[prost(uint64, tag = "6")]
    pub created_ms: u64,
}

impl KeptRecording {
    /// Its stored form.
    fn stored(&self) -> StoredRecording {
        let end = self.pin.end();
        let created = self.created.duration_since(SystemTime::UNIX_EPOCH);
        StoredRecording {
            id: self.id.clone(),
            owner: self.owner.to_string(),
            first: self.pin.first_tick(),
            last: end.map(|_| self.journal.pinned(&self.pin).1),
            end: end.map_or("", end_name).to_owned(),
            created_ms: created.map_or(0, |d| d.as_millis() as u64),
        }
    }
}

/// The name of a reason for the end of a recording.
pub fn end_name(end: PinEnd) -> &'static str {
    match end {
        PinEnd::Stopped => "STOPPED",
        PinEnd::Full => "MAX_RECORDING_BYTES",
        PinEnd::Restored => "WORLD_RESTORED",
        PinEnd::Lost => "HISTORY_LOST",
    }
}

/// The reason of that name.
fn end_of(name: &str) -> Option<PinEnd> {
    use PinEnd::{Full, Lost, Restored, Stopped};
    let all = [Stopped, Full, Restored, Lost];
    all.into_iter().find(|end| end_name(*end) == name)
}

/// All recordings, by world and name.
#[derive(Debug)]
pub struct Recordings {
    all: Mutex<BTreeMap<(String, String), Arc<KeptRecording>>>,
    most: u64,
    most_bytes: u64,
    share: f64,
}

/// A recording to begin.
#[derive(Debug)]
pub struct NewRecording {
    /// Last part of the name of its world.
    pub world: String,
    /// Last part of its name; `None`: a free one.
    pub id: Option<String>,
    /// First tick; `None`: now.
    pub first: Option<u64>,
    /// The client that begins it.
    pub owner: ClientKey,
}

impl Recordings {
    /// None yet. At most `most` recordings of `most_bytes` each; one client may have `share` of them.
    pub fn new(most: u64, most_bytes: u64, share: f64) -> Self {
        Self {
            all: Mutex::default(),
            most,
            most_bytes,
            share,
        }
    }

    /// Most bytes of one recording.
    pub fn most_bytes(&self) -> u64 {
        self.most_bytes
    }

    fn all(&self) -> MutexGuard<'_, BTreeMap<(String, String), Arc<KeptRecording>>> {
        // Entries are whole.
        self.all.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins a recording, unless `there` reports that its world is gone: a world leaves before its recordings are
    /// forgotten, so none is added after that.
    ///
    /// # Errors
    /// The name is taken, there are too many, of all or of this client, or the tick is not held; or `there` fails.
    pub fn start(
        &self,
        journal: Arc<Journal>,
        new: NewRecording,
        there: impl FnOnce() -> Result<(), Fault>,
    ) -> Result<Arc<KeptRecording>, Fault> {
        let mut all = self.all();
        there()?;
        let key = |id: &str| (new.world.clone(), id.to_owned());
        let id = match new.id {
            Some(id) if all.contains_key(&key(&id)) => {
                return Err(Fault::Exists {
                    kind: "recording",
                    name: format!("worlds/{}/recordings/{id}", new.world),
                });
            }
            Some(id) => id,
            None => (1..)
                .map(|n| format!("recording-{n}"))
                .find(|id| !all.contains_key(&key(id)))
                .expect("there is a free number"),
        };
        if all.len() as u64 >= self.most {
            return Err(Fault::Exhausted {
                limit: "max_recordings",
                value: self.most,
                message: "one more recording".into(),
                retry: None,
            });
        }
        let own = all.values().filter(|r| r.owner == new.owner).count() as u64;
        check_part("max_recordings", own, self.most, self.share)?;
        let recording = Arc::new(KeptRecording {
            pin: journal.pin(new.first, self.most_bytes)?,
            world: new.world.clone(),
            id: id.clone(),
            created: SystemTime::now(),
            owner: new.owner,
            journal,
        });
        all.insert((new.world, id), Arc::clone(&recording));
        Ok(recording)
    }

    /// Recordings of a world in stored form, by name.
    pub fn stored(&self, world: &str) -> Vec<StoredRecording> {
        self.of_world(world).iter().map(|r| r.stored()).collect()
    }

    /// Brings back a stored recording, with the remaining part of its past, of a world that continues at tick `now`.
    pub fn bring_back(
        &self,
        journal: &Arc<Journal>,
        (world, now): (&str, u64),
        stored: StoredRecording,
        kept: Vec<Arc<JournalSegment>>,
    ) {
        let first = kept
            .first()
            .map_or(stored.first, |s| s.start.tick().max(stored.first));
        let reached = kept.last().map(|s| s.last_tick());
        let whole =
            first == stored.first && reached.is_some_and(|r| r >= stored.last.unwrap_or(now));
        let end = match (end_of(&stored.end), whole) {
            (end, true) => end,
            // If the recording continues, the remaining part leads up to now.
            (None, false) if reached == Some(now) => None,
            (_, false) => Some(PinEnd::Lost),
        };
        if !whole {
            let (recording, last) = (&*stored.id, stored.last.unwrap_or(now));
            let (from, until) = (first, reached);
            tracing::error!(
                world,
                recording,
                first = stored.first,
                last,
                from,
                until,
                "a part of a recording is lost: its history was cut off"
            );
        }
        let created = SystemTime::UNIX_EPOCH + std::time::Duration::from_millis(stored.created_ms);
        let recording = Arc::new(KeptRecording {
            pin: journal.pin_again(kept, (first, self.most_bytes), end),
            world: world.to_owned(),
            id: stored.id.clone(),
            created,
            owner: stored.owner.into(),
            journal: Arc::clone(journal),
        });
        self.all().insert((world.to_owned(), stored.id), recording);
    }

    /// One recording.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn get(&self, world: &str, id: &str) -> Result<Arc<KeptRecording>, Fault> {
        let found = self.all().get(&(world.to_owned(), id.to_owned())).cloned();
        found.ok_or_else(|| missing(world, id))
    }

    /// Those of a world, by name.
    pub fn of_world(&self, world: &str) -> Vec<Arc<KeptRecording>> {
        let all = self.all();
        all.values().filter(|r| r.world == world).cloned().collect()
    }

    /// Forgets one recording.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn remove(&self, world: &str, id: &str) -> Result<(), Fault> {
        let gone = self.all().remove(&(world.to_owned(), id.to_owned()));
        gone.map(drop).ok_or_else(|| missing(world, id))
    }

    /// Forgets the recordings of a world.
    pub fn forget_world(&self, world: &str) {
        self.all().retain(|_, r| r.world != world);
    }
}

fn missing(world: &str, id: &str) -> Fault {
    Fault::not_found("recording", format!("worlds/{world}/recordings/{id}"))
}
