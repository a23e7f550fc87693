//! Frames of the last ticks, held for late readers.

use crate::wire::status::Fault;
use crate::wire::types::Snapshot;
use std::collections::VecDeque;
use std::sync::Arc;

/// The last frames of one world, one per tick.
#[derive(Debug)]
pub struct History {
    held: VecDeque<Arc<Snapshot>>,
    most: usize,
}

impl History {
    /// Nothing yet; at most `most` frames.
    pub fn new(most: usize) -> Self {
        Self {
            held: VecDeque::new(),
            most,
        }
    }

    /// Adds the frame of a new tick, or replaces that of the last one: the roster may change between ticks.
    pub fn push(&mut self, snapshot: Arc<Snapshot>) {
        if self.held.back().is_some_and(|s| s.tick == snapshot.tick) {
            self.held.pop_back();
        }
        self.held.push_back(snapshot);
        while self.held.len() > self.most {
            self.held.pop_front();
        }
    }

    /// Forgets all: the world has another past now.
    pub fn clear(&mut self) {
        self.held.clear();
    }

    fn expired(&self, asked: i64) -> Fault {
        let tick = |s: Option<&Arc<Snapshot>>| s.map_or(-1, |s| s.tick as i64);
        Fault::Expired {
            asked,
            oldest: tick(self.held.front()),
            newest: tick(self.held.back()),
        }
    }

    /// The held frame of one tick.
    ///
    /// # Errors
    /// It is not held any more, or not computed yet.
    pub fn at(&self, tick: i64) -> Result<Arc<Snapshot>, Fault> {
        let found = self.held.binary_search_by_key(&tick, |s| s.tick as i64);
        found
            .map(|i| Arc::clone(&self.held[i]))
            .map_err(|_| self.expired(tick))
    }

    /// The held frames after one tick.
    ///
    /// # Errors
    /// The next one is not held any more, or `tick` is not computed yet.
    pub fn after(&self, tick: i64) -> Result<Vec<Arc<Snapshot>>, Fault> {
        let newest = self.held.back().map_or(-1, |s| s.tick as i64);
        let oldest = self.held.front().map_or(0, |s| s.tick as i64);
        // Resuming after the newest is fine (nothing was missed); beyond it, or with a gap, is not.
        if tick > newest || tick.saturating_add(1) < oldest {
            return Err(self.expired(tick.saturating_add(1)));
        }
        let first = self.held.partition_point(|s| s.tick as i64 <= tick);
        Ok(self.held.iter().skip(first).cloned().collect())
    }
}
