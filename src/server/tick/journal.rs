//! The last minutes of a world: checkpoints, each followed by the changes of the world and the hash of each tick.
//!
//! The world's thread appends; readers that seek, fork, replay or record copy pointers. With a data directory the same
//! entries go to the writing thread (`durable`), in the same order. A checkpoint is encoded elsewhere and gets there
//! later than it was taken. Entries after it are then handed in once more, so that the disk always has a checkpoint
//! with everything that followed.

use super::scene::{RoundRecord, SavedScene, Scene};
use crate::durable::keeper::{KeeperTicket, Recorder};
use crate::durable::store::{Durability, StoreError};
use bytes::Bytes;
use sinew_physics::saved::Definition;
use sinew_physics::world::checkpoint::{Capture, read_definitions, write_definitions};
use sinew_wire::status::Fault;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, Instant};
use tokio::sync::Notify;

/// Time between two checkpoints.
pub const CHECKPOINT_EVERY: Duration = Duration::from_secs(5);
/// Approximate bytes of an entry besides its content.
const ENTRY_BYTES: usize = size_of::<JournalItem>();
/// Least bytes of entries that are worth a checkpoint of their own.
const LEAST_SEGMENT: u64 = 1 << 20;
/// Approximate bytes of one frame of a clip.
const CLIP_FRAME_BYTES: usize = 1200;

/// A note about a world.
#[derive(Clone, Debug)]
pub enum JournalItem {
    /// Changes between two ticks.
    Record(RoundRecord),
    /// A tick was done: its number, and the hash of the state after it.
    Hash(u64, u64),
}

/// Total bytes of the past of all worlds of a server.
#[derive(Debug)]
pub struct Total {
    most: u64,
    used: AtomicU64,
}

impl Total {
    /// At most `most`, except for the minimum that each world needs.
    pub fn new(most: u64) -> Self {
        Self {
            most,
            used: AtomicU64::new(0),
        }
    }
}

/// How much is held.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// Bytes; 0: nothing.
    pub bytes: u64,
    /// Age of the oldest; 0: nothing.
    pub age: Duration,
}

impl Room {
    /// Whether something is held.
    pub fn any(&self) -> bool {
        self.bytes > 0 && !self.age.is_zero()
    }
}

/// A checkpoint and the entries up to the next one.
#[derive(Clone, Debug)]
pub struct JournalSegment {
    /// The state at its beginning.
    pub start: Arc<Capture>,
    /// Time of that state.
    pub begun: Instant,
    /// Whether the world was put into that state: it then differs from the end of the segment before, even if the
    /// physics is the same.
    pub restored: bool,
    /// The entries that followed.
    pub entries: Vec<JournalItem>,
    bytes: usize,
}

impl JournalSegment {
    fn new(start: Arc<Capture>, begun: Instant) -> Self {
        Self {
            bytes: start.size() + 256,
            start,
            begun,
            restored: false,
            entries: Vec::new(),
        }
    }

    /// A part of the past that was on disk, up to tick `until`: a state, and the entries that followed.
    pub fn of_disk(mut start: Scene, entries: Vec<JournalItem>, until: u64) -> Arc<Self> {
        let mut out = Self::new(Arc::new(start.capture()), Instant::now());
        // The players of live motion at that time were not continued.
        out.restored = true;
        for entry in entries {
            if matches!(entry, JournalItem::Hash(tick, _) if tick > until) {
                break;
            }
            out.push(entry);
        }
        out.sealed()
    }

    /// Ends the appending, and frees the spare capacity of the vector, which may be as large as its content.
    fn sealed(mut self) -> Arc<Self> {
        self.entries.shrink_to_fit();
        Arc::new(self)
    }

    fn push(&mut self, entry: JournalItem) {
        self.bytes += size(&entry);
        self.entries.push(entry);
    }

    /// Keeps the first entries.
    fn truncate(&mut self, count: usize) {
        let gone: usize = self.entries.drain(count..).map(|e| size(&e)).sum();
        self.bytes -= gone;
    }

    /// Its size, bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes as u64
    }

    /// Ticks done at its end.
    pub fn last_tick(&self) -> u64 {
        let hashes = self.entries.iter().rev().find_map(|e| match e {
            JournalItem::Hash(tick, _) => Some(*tick),
            JournalItem::Record(_) => None,
        });
        hashes.unwrap_or(self.start.tick())
    }

    /// The scene at its beginning.
    ///
    /// The checkpoint cannot be restored; impossible for one made by this program.
    /// The bytes are not a checkpoint; impossible for one of this program.
    pub fn scene(&self) -> Result<Scene, Fault> {
        scene_of(&self.start)
    }
}

/// Size of an entry, bytes.
fn size(entry: &JournalItem) -> usize {
    ENTRY_BYTES
        + match entry {
            JournalItem::Record(r) => r.bytes.len(),
            JournalItem::Hash(..) => 0,
        }
}

/// The scene of a capture.
///
/// The capture cannot be restored; impossible for one made by this program.
/// The bytes are not a checkpoint; impossible for one of this program.
pub fn scene_of(capture: &Capture) -> Result<Scene, Fault> {
    let failed = |e: &dyn std::fmt::Display| Fault::Internal(format!("a checkpoint: {e}"));
    let (world, saved) = capture
        .restore_with::<SavedScene<'static>>()
        .map_err(|e| failed(&e))?;
    Scene::restored(world, saved).map_err(|e| failed(&e))
}

/// Why a pinned part of the past has an end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PinEnd {
    /// It was told to end.
    Stopped,
    /// It has reached its size limit.
    Full,
    /// The world has another past now.
    Restored,
    /// Later entries are no longer on disk.
    Lost,
}

/// A part of the past that is kept as long as this value exists.
#[derive(Debug)]
pub struct Pin {
    most_bytes: u64,
    first: u64,
    inside: Mutex<Pinned>,
}

#[derive(Debug, Default)]
struct Pinned {
    kept: Vec<Arc<JournalSegment>>,
    bytes: u64,
    end: Option<PinEnd>,
}

impl Pin {
    fn inside(&self) -> MutexGuard<'_, Pinned> {
        // Every holder leaves it whole.
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The tick with which it begins.
    pub fn first_tick(&self) -> u64 {
        self.first
    }

    /// Reason for its end; `None`: it continues.
    pub fn end(&self) -> Option<PinEnd> {
        self.inside().end
    }

    /// Keeps one more segment. Returns whether it has not ended.
    fn keep(&self, segment: &Arc<JournalSegment>, end: Option<PinEnd>) -> bool {
        let mut inside = self.inside();
        if inside.end.is_some() {
            return false;
        }
        inside.bytes += segment.bytes as u64;
        inside.kept.push(Arc::clone(segment));
        let full = (inside.bytes > self.most_bytes).then_some(PinEnd::Full);
        inside.end = end.or(full);
        inside.end.is_none()
    }
}

#[derive(Debug)]
struct JournalInner {
    /// From oldest to newest.
    sealed: VecDeque<Arc<JournalSegment>>,
    /// The segment to which entries are appended.
    current: Option<JournalSegment>,
    recorder: Option<Recorder>,
    /// Whether nothing is handed to the recorder before a checkpoint, because the world has another past now.
    holds: bool,
    /// The last entry that was handed in.
    ticket: Option<KeeperTicket>,
    /// Parts of the past that are kept longer.
    pins: Vec<Weak<Pin>>,
    /// Bytes of it that are counted in the total.
    counted: u64,
    /// Number of times that the world continued from another state.
    begun_anew: u64,
}

/// The last minutes of one world.
#[derive(Debug)]
pub struct Journal {
    room: Room,
    total: Arc<Total>,
    inside: Mutex<JournalInner>,
    /// Notified when a checkpoint was handed to the recorder.
    written: Notify,
}

impl Drop for Journal {
    fn drop(&mut self) {
        let counted = self.inside().counted;
        self.total.used.fetch_sub(counted, Ordering::Relaxed);
    }
}

impl Journal {
    /// Nothing yet.
    pub fn new(room: Room, total: Arc<Total>) -> Self {
        Self {
            room,
            total,
            inside: Mutex::new(JournalInner {
                sealed: VecDeque::new(),
                current: None,
                recorder: None,
                holds: false,
                ticket: None,
                pins: Vec::new(),
                counted: 0,
                begun_anew: 0,
            }),
            written: Notify::new(),
        }
    }

    fn inside(&self) -> MutexGuard<'_, JournalInner> {
        // Every holder leaves it whole.
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How much is held.
    pub fn room(&self) -> Room {
        self.room
    }

    // ── the world's thread ──

    /// Appends a change of the world.
    pub fn append(&self, record: RoundRecord) {
        self.inside().append(JournalItem::Record(record));
    }

    /// Notes that a tick is done.
    pub fn stepped(&self, tick: u64, hash: u64) {
        self.inside().append(JournalItem::Hash(tick, hash));
    }

    /// Whether it is time for a checkpoint, and something has happened since the last one.
    pub fn wants_checkpoint(&self, now: Instant) -> bool {
        let inside = self.inside();
        match &inside.current {
            None => true,
            Some(current) => {
                let entries = current.bytes.saturating_sub(current.start.size()) as u64;
                let full = self.room.any() && entries > (self.room.bytes / 4).max(LEAST_SEGMENT);
                (now - current.begun >= CHECKPOINT_EVERY || full) && !current.entries.is_empty()
            }
        }
    }

    /// Begins a new segment with a checkpoint. Expired segments are forgotten.
    pub fn begin(&self, capture: Capture, now: Instant) {
        let mut inside = self.inside();
        let mut next = JournalSegment::new(Arc::new(capture), now);
        // About as many entries as before will come, so they are not moved as the vector grows.
        let count = inside.current.as_ref().map_or(0, |c| c.entries.len());
        next.entries.reserve_exact(count);
        if let Some(before) = inside.current.replace(next) {
            let before = before.sealed();
            inside.pin(&before, None);
            inside.sealed.push_back(before);
        }
        inside.cut(&self.room, now, &self.total);
    }

    /// Number of times that the world continued from a state other than that of its last tick.
    pub fn begun_anew(&self) -> u64 {
        self.inside().begun_anew
    }

    /// The world continues from `capture` instead of its present state. With `goes_back`, the entries up to that state
    /// remain its past.
    pub fn begin_anew(&self, capture: Capture, goes_back: bool, now: Instant) {
        let mut inside = self.inside();
        inside.begun_anew += 1;
        let (tick, hash) = (capture.tick(), capture.hash());
        if let Some(before) = inside.current.take().map(JournalSegment::sealed) {
            inside.pin(&before, Some(PinEnd::Restored));
            inside.sealed.push_back(before);
        }
        if goes_back {
            inside.sealed.retain(|s| s.start.tick() <= tick);
            if let Some(last) = inside.sealed.pop_back() {
                let mut last = Arc::unwrap_or_clone(last);
                let there = |e: &JournalItem| matches!(e, JournalItem::Hash(t, h) if (*t, *h) == (tick, hash));
                let end = last.entries.iter().position(there);
                last.truncate(end.map_or(0, |i| i + 1));
                inside.sealed.push_back(Arc::new(last));
            }
        } else {
            inside.sealed.clear();
        }
        inside.current = Some(JournalSegment {
            restored: true,
            ..JournalSegment::new(Arc::new(capture), now)
        });
        inside.holds = inside.recorder.is_some();
        inside.cut(&self.room, now, &self.total);
    }

    // ── the disk ──

    /// From the next checkpoint on, everything also goes to this recorder.
    pub fn write_to(&self, recorder: Recorder) {
        let mut inside = self.inside();
        inside.holds = true;
        inside.recorder = Some(recorder);
    }

    /// The latest checkpoint; `None` if it is `written` and the recorder does not need it once more.
    pub fn to_write(&self, written: Option<(u64, u64)>) -> Option<Arc<Capture>> {
        let inside = self.inside();
        let (start, recorder) = (&inside.current.as_ref()?.start, inside.recorder.as_ref()?);
        let known = written == Some((start.tick(), start.hash()));
        let needed = inside.holds || !known || recorder.needs_checkpoint();
        needed.then(|| Arc::clone(start))
    }

    /// Hands in an encoded checkpoint, and once more the entries after it. Returns false if the world has another past
    /// now, or a later checkpoint.
    pub fn write(&self, capture: &Arc<Capture>, bytes: Bytes) -> bool {
        let mut inside = self.inside();
        let inside = &mut *inside;
        let (Some(recorder), Some(current)) = (&inside.recorder, &inside.current) else {
            return false;
        };
        if !Arc::ptr_eq(&current.start, capture) {
            return false;
        }
        recorder.checkpoint(capture.tick(), bytes);
        let mut ticket = recorder.hash(capture.tick(), capture.hash());
        inside.holds = false;
        for entry in &current.entries {
            ticket = hand_in(recorder, entry);
        }
        inside.ticket = Some(ticket);
        self.written.notify_waiters();
        true
    }

    /// Waits until everything until now is on disk, in a world with the guarantee that no answered request is lost.
    ///
    /// # Errors
    /// It could not be written.
    pub async fn settled(&self) -> Result<(), StoreError> {
        loop {
            let written = self.written.notified();
            let (recorder, ticket) = {
                let inside = self.inside();
                let recorder = inside.recorder.clone();
                let Some(recorder) = recorder.filter(|r| r.durability() == Durability::Each) else {
                    return Ok(());
                };
                (recorder, inside.ticket.filter(|_| !inside.holds))
            };
            match ticket {
                Some(ticket) => return recorder.durable(ticket).await,
                // The checkpoint before these entries comes first.
                None => drop(tokio::time::timeout(CHECKPOINT_EVERY, written).await),
            }
        }
    }

    // ── the past ──

    /// The first and last tick that are held; `None`: nothing is.
    pub fn held(&self) -> Option<(u64, u64)> {
        self.inside().held(&self.room)
    }

    /// The segments that lead from the last checkpoint at or before `from` to `until`.
    ///
    /// # Errors
    /// `from` is no longer held, or `until` is not reached yet.
    pub fn past(&self, from: u64, until: u64) -> Result<Vec<Arc<JournalSegment>>, Fault> {
        self.inside().past(&self.room, from, until)
    }
}

impl Journal {
    /// Keeps the past from tick `first` on (`None`: from now on), at most `most_bytes` of it.
    ///
    /// # Errors
    /// That tick is not held.
    pub fn pin(&self, first: Option<u64>, most_bytes: u64) -> Result<Arc<Pin>, Fault> {
        let mut inside = self.inside();
        let (_, newest) = inside.held(&self.room).ok_or_else(|| expired(0, None))?;
        let first = first.unwrap_or(newest);
        let mut past = inside.past(&self.room, first, first.max(newest))?;
        // The current segment is kept once it is complete.
        past.pop();
        let pin = Arc::new(Pin {
            most_bytes,
            first,
            inside: Mutex::new(Pinned {
                bytes: past.iter().map(|s| s.bytes as u64).sum(),
                kept: past,
                end: None,
            }),
        });
        inside.pins.push(Arc::downgrade(&pin));
        Ok(pin)
    }

    /// A pin from before: with the remaining part of it, and continuing if it has not ended.
    pub fn pin_again(
        &self,
        kept: Vec<Arc<JournalSegment>>,
        (first, most_bytes): (u64, u64),
        end: Option<PinEnd>,
    ) -> Arc<Pin> {
        let pin = Arc::new(Pin {
            most_bytes,
            first,
            inside: Mutex::new(Pinned {
                bytes: kept.iter().map(|s| s.bytes as u64).sum(),
                kept,
                end,
            }),
        });
        self.inside().pins.push(Arc::downgrade(&pin));
        pin
    }

    /// Ends a pin, unless it has ended.
    pub fn unpin(&self, pin: &Pin) {
        let inside = self.inside();
        if let Some(current) = &inside.current {
            pin.keep(&Arc::new(current.clone()), Some(PinEnd::Stopped));
        }
    }

    /// The segments that a pin keeps until now, its last tick, and its bytes.
    pub fn pinned(&self, pin: &Pin) -> (Vec<Arc<JournalSegment>>, u64, u64) {
        let inside = self.inside();
        let pinned = pin.inside();
        let (mut kept, mut bytes) = (pinned.kept.clone(), pinned.bytes);
        if pinned.end.is_none()
            && let Some(current) = &inside.current
        {
            bytes += current.bytes as u64;
            kept.push(Arc::new(current.clone()));
        }
        let last = kept.last().map_or(pin.first, |s| s.last_tick());
        (kept, last.max(pin.first), bytes)
    }
}

fn expired(asked: u64, held: Option<(u64, u64)>) -> Fault {
    let tick = |t: u64| i64::try_from(t).unwrap_or(i64::MAX);
    Fault::Expired {
        asked: tick(asked),
        oldest: held.map_or(-1, |h| tick(h.0)),
        newest: held.map_or(-1, |h| tick(h.1)),
    }
}

impl JournalInner {
    fn held(&self, room: &Room) -> Option<(u64, u64)> {
        let current = self.current.as_ref().filter(|_| room.any())?;
        let first = self.sealed.front().map_or(&current.start, |s| &s.start);
        Some((first.tick(), current.last_tick()))
    }

    fn past(&self, room: &Room, from: u64, until: u64) -> Result<Vec<Arc<JournalSegment>>, Fault> {
        let held = self.held(room);
        if held.is_none_or(|(oldest, newest)| from < oldest || until > newest || from > until) {
            return Err(expired(from, held));
        }
        let mut all: Vec<Arc<JournalSegment>> = self.sealed.iter().cloned().collect();
        all.extend(self.current.clone().map(Arc::new));
        let first = all.partition_point(|s| s.start.tick() <= from).max(1) - 1;
        let last = all.partition_point(|s| s.start.tick() <= until);
        Ok(all.drain(first..last.max(first + 1)).collect())
    }

    /// Lets all pins keep this segment.
    fn pin(&mut self, segment: &Arc<JournalSegment>, end: Option<PinEnd>) {
        let keeps = |pin: &Weak<Pin>| pin.upgrade().is_some_and(|p| p.keep(segment, end));
        self.pins.retain(keeps);
    }

    fn append(&mut self, entry: JournalItem) {
        if let Some(recorder) = self.recorder.as_ref().filter(|_| !self.holds) {
            self.ticket = Some(hand_in(recorder, &entry));
        }
        if let Some(current) = &mut self.current {
            current.push(entry);
        }
    }

    fn cut(&mut self, room: &Room, now: Instant, total: &Total) {
        let mut bytes: u64 = self.sealed.iter().map(|s| s.bytes as u64).sum();
        let room = if room.any() {
            *room
        } else {
            Room {
                bytes: 0,
                age: Duration::ZERO,
            }
        };
        let current = self.current.as_ref().map_or(0, |c| c.bytes as u64);
        let before = std::mem::replace(&mut self.counted, bytes + current);
        total.used.fetch_add(self.counted, Ordering::Relaxed);
        total.used.fetch_sub(before, Ordering::Relaxed);
        // The age of a segment is that of its end.
        while let Some(first) = self.sealed.front()
            && (bytes > room.bytes
                || now - first.begun > room.age + CHECKPOINT_EVERY
                || total.used.load(Ordering::Relaxed) > total.most)
        {
            let less = first.bytes as u64;
            bytes -= less;
            self.counted -= less;
            total.used.fetch_sub(less, Ordering::Relaxed);
            self.sealed.pop_front();
        }
    }
}

fn hand_in(recorder: &Recorder, entry: &JournalItem) -> KeeperTicket {
    match entry {
        JournalItem::Hash(tick, hash) => recorder.hash(*tick, *hash),
        JournalItem::Record(r) if r.definitions.is_empty() => {
            recorder.input(r.tick, r.bytes.clone())
        }
        JournalItem::Record(r) => {
            let size = r.bytes.len() + r.definitions.iter().map(size_of_definition).sum::<usize>();
            let r = r.clone();
            recorder.input_later(r.tick, size, move || with_clips(&r))
        }
    }
}

fn size_of_definition(definition: &Definition) -> usize {
    let clip = definition.downcast_ref::<crate::engine::Clip>();
    clip.map_or(0, |c| c.len() * CLIP_FRAME_BYTES)
}

/// A record in the form for the disk.
#[cfg(test)]
pub(super) fn on_disk(record: &RoundRecord) -> Bytes {
    if record.definitions.is_empty() {
        record.bytes.clone()
    } else {
        with_clips(record)
    }
}

/// A record, followed by the clips to which it refers, after a zero, with which no record begins, and its length.
fn with_clips(record: &RoundRecord) -> Bytes {
    // A value that cannot be written cannot be read either, which is found on reading.
    let definitions = write_definitions(&record.definitions).unwrap_or_default();
    let mut out = Vec::with_capacity(record.bytes.len() + definitions.len() + 5);
    out.push(0);
    out.extend_from_slice(&(record.bytes.len() as u32).to_le_bytes());
    out.extend_from_slice(&record.bytes);
    out.extend_from_slice(&definitions);
    out.into()
}

/// A record from the form for the disk.
///
/// # Errors
/// It cannot have been written.
pub fn from_disk(tick: u64, bytes: &Bytes) -> Result<RoundRecord, String> {
    let ends = || "a record that ends too soon".to_owned();
    let (bytes, definitions) = match bytes.first() {
        Some(0) => {
            let head = bytes.get(1..5).ok_or_else(ends)?;
            let length = u32::from_le_bytes(head.try_into().expect("four bytes")) as usize;
            let end = length.saturating_add(5);
            let rest = bytes.get(end..).ok_or_else(ends)?;
            let definitions = read_definitions(rest).map_err(|e| e.to_string())?;
            (bytes.slice(5..end), definitions)
        }
        _ => (bytes.clone(), Vec::new()),
    };
    let seq = super::scene::RecordReader::seq(&bytes).map_err(|e| e.to_string())?;
    Ok(RoundRecord {
        seq,
        tick,
        bytes,
        definitions,
    })
}
