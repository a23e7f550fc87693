//! Frames of the last ticks, held for late readers, and events worth a mark on a time line.

use sinew_wire::status::Fault;
use sinew_wire::types::{EventKind, Snapshot, WorldEvent};
use std::collections::VecDeque;
use std::sync::Arc;

/// Events of one world that are held.
const MARKS: usize = 512;

/// Whether people look for this event in the past of a world. Other events come many times a second, or concern a
/// connection.
fn is_mark(e: &WorldEvent) -> bool {
    !matches!(
        e.kind,
        EventKind::SupportGained(_)
            | EventKind::SupportLost(_)
            | EventKind::Saturated(_)
            | EventKind::Relieved(_)
            | EventKind::Touched(..)
            | EventKind::Parted(..)
            | EventKind::DriveResynced(_)
            | EventKind::ControlAcquired(_)
            | EventKind::ControlReleased(_)
            | EventKind::ControlPreempted(_)
            | EventKind::ControlOffered(_)
            | EventKind::AccessRefused(_)
    )
}

/// The last frames of one world, one per tick, and its last events of interest.
#[derive(Debug)]
pub struct FrameHistory {
    held: VecDeque<Arc<Snapshot>>,
    most: usize,
    marks: VecDeque<WorldEvent>,
}

impl FrameHistory {
    /// Nothing yet; at most `most` frames.
    pub fn new(most: usize) -> Self {
        Self {
            held: VecDeque::new(),
            most,
            marks: VecDeque::new(),
        }
    }

    /// Adds those of these events that people look for.
    pub fn note(&mut self, events: &[WorldEvent]) {
        let marks = events.iter().filter(|e| is_mark(e));
        self.marks.extend(marks.cloned());
        let more = self.marks.len().saturating_sub(MARKS);
        self.marks.drain(..more);
    }

    /// The events of these ticks that are held.
    pub fn marks(&self, from: u64, until: u64) -> Vec<WorldEvent> {
        let marks = self.marks.iter();
        let marks = marks.filter(|e| (from..=until).contains(&e.tick));
        marks.cloned().collect()
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

    /// Forgets everything, because the world has another past now.
    pub fn clear(&mut self) {
        self.held.clear();
        self.marks.clear();
    }

    /// The world goes back to a tick of its past: everything later is forgotten, and frames can no longer be resumed.
    pub fn go_back(&mut self, tick: u64) {
        self.held.clear();
        self.marks.retain(|e| e.tick <= tick);
    }

    fn expired(&self, asked: i64) -> Fault {
        let tick = |s: Option<&Arc<Snapshot>>| s.map_or(-1, |s| s.tick as i64);
        Fault::Expired {
            asked,
            oldest: tick(self.held.front()),
            newest: tick(self.held.back()),
        }
    }

    /// The held frame of a tick.
    ///
    /// # Errors
    /// It is no longer held, or not computed yet.
    pub fn at(&self, tick: i64) -> Result<Arc<Snapshot>, Fault> {
        let found = self.held.binary_search_by_key(&tick, |s| s.tick as i64);
        found
            .map(|i| Arc::clone(&self.held[i]))
            .map_err(|_| self.expired(tick))
    }

    /// The held frames after a tick.
    ///
    /// # Errors
    /// The next one is no longer held, or `tick` is not computed yet.
    pub fn after(&self, tick: i64) -> Result<Vec<Arc<Snapshot>>, Fault> {
        let newest = self.held.back().map_or(-1, |s| s.tick as i64);
        let oldest = self.held.front().map_or(0, |s| s.tick as i64);
        // Resuming after the newest is fine, because nothing was missed. Resuming beyond it, or with a gap, is not.
        if tick > newest || tick.saturating_add(1) < oldest {
            return Err(self.expired(tick.saturating_add(1)));
        }
        let first = self.held.partition_point(|s| s.tick as i64 <= tick);
        Ok(self.held.iter().skip(first).cloned().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(tick: u64, kind: EventKind) -> WorldEvent {
        WorldEvent {
            tick,
            time: tick as f64 / 60.0,
            figure: "a".into(),
            kind,
        }
    }

    #[test]
    fn the_last_events_of_interest_are_held() {
        let mut history = FrameHistory::new(8);
        for tick in 0..2 * MARKS as u64 {
            let kinds = [EventKind::Fell, EventKind::Saturated(3)];
            history.note(&kinds.map(|kind| event(tick, kind)));
        }
        let marks = history.marks(0, u64::MAX);
        assert_eq!(marks.len(), MARKS);
        assert!(marks.iter().all(|e| e.kind == EventKind::Fell));
        let first = MARKS as u64;
        let ticks = |marks: Vec<WorldEvent>| marks.iter().map(|e| e.tick).collect::<Vec<_>>();
        assert_eq!(ticks(history.marks(0, first + 1)), [first, first + 1]);
        // The world goes back: later ticks have not happened.
        history.go_back(first + 2);
        let left = ticks(history.marks(0, u64::MAX));
        assert_eq!(left, [first, first + 1, first + 2]);
    }
}
