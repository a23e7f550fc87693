//! The entries that worlds hand in. Nothing here waits for the disk.

use super::queue::{KeeperShared, KeeperTicket, Later, Queued, TOO_LATE, WorldState, locked};
use crate::durable::store::{Durability, StoreEntry, StoreError, StoreItem, WorldKey};
use bytes::Bytes;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Writes one world. Its methods do not wait.
#[derive(Clone)]
pub struct Recorder {
    pub(super) shared: Arc<KeeperShared>,
    pub(super) world: Arc<WorldState>,
}

impl std::fmt::Debug for Recorder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Recorder").field(&self.world).finish()
    }
}

impl Recorder {
    /// Number of the world.
    pub fn world(&self) -> WorldKey {
        self.world.key
    }

    /// The world's guarantee against loss.
    pub fn durability(&self) -> Durability {
        self.world.durability
    }

    /// Hands in the changes to the world before a tick.
    pub fn input(&self, tick: u64, bytes: Bytes) -> KeeperTicket {
        self.push(tick, StoreItem::Input(bytes), None)
    }

    /// [`Self::input`] with bytes that the writing thread produces; `size`: their approximate number.
    pub fn input_later(
        &self,
        tick: u64,
        size: usize,
        bytes: impl FnOnce() -> Bytes + Send + 'static,
    ) -> KeeperTicket {
        self.push(
            tick,
            StoreItem::Input(Bytes::new()),
            Some((size, Box::new(bytes))),
        )
    }

    /// Hands in the hash of the state after a tick.
    pub fn hash(&self, tick: u64, hash: u64) -> KeeperTicket {
        self.push(tick, StoreItem::Hash(hash), None)
    }

    /// Hands in the state after a tick.
    pub fn checkpoint(&self, tick: u64, bytes: Bytes) -> KeeperTicket {
        let item = StoreItem::Checkpoint {
            bytes,
            after_gap: false,
        };
        self.push(tick, item, None)
    }

    /// Whether nothing is written until there is a new checkpoint, and one could be written now.
    pub fn needs_checkpoint(&self) -> bool {
        if self.world.durability == Durability::None || !self.world.gap.load(Ordering::Relaxed) {
            return false;
        }
        let queue = locked(&self.shared.queue);
        let room = queue.bytes < self.shared.sizes.queue_bytes / 2;
        room && queue.retry_at.is_none_or(|at| at <= Instant::now())
    }

    fn push(&self, tick: u64, mut item: StoreItem, later: Option<Later>) -> KeeperTicket {
        let world = &self.world;
        let mut queue = locked(&self.shared.queue);
        queue.sent += 1;
        let ticket = queue.sent;
        let is_checkpoint = matches!(item, StoreItem::Checkpoint { .. });
        if world.durability == Durability::None && !is_checkpoint {
            return KeeperTicket(ticket);
        }
        if queue.ended || world.gap.load(Ordering::Relaxed) && !is_checkpoint {
            let was_whole = world.lose(ticket, ticket);
            let late = was_whole && queue.ended;
            drop(queue);
            if late {
                world.tell_loss(TOO_LATE);
            }
            metrics::counter!("sinew_store_lost_entries_total").increment(1);
            return KeeperTicket(ticket);
        }
        if let StoreItem::Checkpoint { after_gap, .. } = &mut item {
            *after_gap = world.gap.load(Ordering::Relaxed);
        }
        let entry = StoreEntry {
            world: world.key,
            tick,
            item,
        };
        let size = entry.size() + later.as_ref().map_or(0, |l| l.0);
        if queue.bytes + size > self.shared.sizes.queue_bytes {
            world.gap.store(true, Ordering::Relaxed);
            let was_whole = world.lose(ticket, ticket);
            drop(queue);
            metrics::counter!("sinew_store_lost_entries_total").increment(1);
            let why = format!(
                "the disk is too slow: more than {} bytes wait for it",
                self.shared.sizes.queue_bytes
            );
            if was_whole {
                world.tell_loss(&why);
            }
            self.shared.degrade(&why);
            return KeeperTicket(ticket);
        }
        if is_checkpoint {
            world.gap.store(false, Ordering::Relaxed);
        }
        queue.bytes += size;
        queue.urgent |= world.durability == Durability::Each;
        let first = queue.entries.is_empty();
        queue.begun.get_or_insert_with(Instant::now);
        queue.entries.push(Queued {
            entry,
            world: world.clone(),
            later: later.map(|l| l.1),
        });
        let wake = first || queue.urgent;
        drop(queue);
        if wake {
            self.shared.filled.notify_one();
        }
        KeeperTicket(ticket)
    }

    /// Waits until something that was handed in is on disk.
    ///
    /// # Errors
    /// It was left out, or the store has ended.
    pub async fn durable(&self, ticket: KeeperTicket) -> Result<(), StoreError> {
        let mut done = self.shared.done.subscribe();
        let waited = done.wait_for(|done| *done >= ticket.0).await.is_ok();
        if self.world.has_lost(ticket) {
            let why = self.shared.degraded.borrow().clone();
            return Err(StoreError::Io(
                why.unwrap_or_else(|| "it was not written".to_owned()),
            ));
        }
        if waited {
            Ok(())
        } else {
            Err(StoreError::Ended)
        }
    }

    /// Last tick of it that is on disk.
    pub fn durable_tick(&self) -> u64 {
        self.world.tick.load(Ordering::Relaxed)
    }
}
