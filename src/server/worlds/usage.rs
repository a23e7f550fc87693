//! Last use of a world, so that an unused one can be ended.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Uses of one world.
#[derive(Debug)]
pub struct WorldUsage(Arc<Mutex<UsageState>>);

#[derive(Debug)]
struct UsageState {
    /// Calls that wait and streams that are open.
    open: usize,
    last: Instant,
}

/// A call or a stream, as long as it lasts.
#[derive(Debug)]
pub struct InUse(Arc<Mutex<UsageState>>);

fn lock(state: &Mutex<UsageState>) -> MutexGuard<'_, UsageState> {
    // Two numbers are always consistent.
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Drop for InUse {
    fn drop(&mut self) {
        let mut state = lock(&self.0);
        state.open -= 1;
        state.last = Instant::now();
    }
}

impl Default for WorldUsage {
    fn default() -> Self {
        Self(Arc::new(Mutex::new(UsageState {
            open: 0,
            last: Instant::now(),
        })))
    }
}

impl WorldUsage {
    /// Notes that the world is used now.
    pub fn note(&self) {
        lock(&self.0).last = Instant::now();
    }

    /// Notes that the world is in use until the returned value is dropped.
    pub fn begin(&self) -> InUse {
        lock(&self.0).open += 1;
        InUse(self.0.clone())
    }

    /// Time for which the world has been unused at `now`.
    pub fn idle(&self, now: Instant) -> Duration {
        let state = lock(&self.0);
        if state.open > 0 {
            return Duration::ZERO;
        }
        now.saturating_duration_since(state.last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_world_is_idle_from_its_last_use() {
        let usage = WorldUsage::default();
        let later = Instant::now() + Duration::from_secs(60);
        assert!(usage.idle(later) >= Duration::from_secs(59));
        let stream = usage.begin();
        let call = usage.begin();
        drop(call);
        assert_eq!(usage.idle(later), Duration::ZERO, "the stream is open");
        drop(stream);
        assert!(usage.idle(later) >= Duration::from_secs(59));
        usage.note();
        assert!(usage.idle(Instant::now()) < Duration::from_secs(59));
    }
}
