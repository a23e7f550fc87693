//! Threads that compute the plans of figures, for all worlds of a server.
//!
//! The queue is bounded. A request that finds no room stays with its figure and is offered again in the next tick.

use crate::engine::{PlanRequest, Planning};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// Most planning threads.
const MOST_THREADS: usize = 4;
/// Most requests that wait for a planning thread.
const MOST_WAITING: usize = 256;

/// The planning threads. They end when this is dropped and the queue is empty.
#[derive(Debug)]
pub struct Planners {
    queue: SyncSender<PlanRequest>,
    threads: usize,
}

impl Planners {
    /// Starts the threads: one per processor, at most four. A machine without spare processors plans in its ticks.
    pub fn start() -> Self {
        let (queue, waiting) = sync_channel(MOST_WAITING);
        let waiting = Arc::new(Mutex::new(waiting));
        let count = thread::available_parallelism().map_or(1, usize::from);
        let mut threads = 0;
        for _ in 0..count.min(MOST_THREADS) {
            let waiting = Arc::clone(&waiting);
            let spawned = thread::Builder::new()
                .name("planner".into())
                .spawn(move || serve(&waiting));
            match spawned {
                Ok(_) => threads += 1,
                Err(e) => tracing::warn!("no thread to plan on: {e}"),
            }
        }
        Self { queue, threads }
    }

    /// How ticks get their plans: they do not wait for one, unless there is no thread to compute it.
    pub fn planning(&self) -> Planning {
        if self.threads > 0 {
            Planning::Aside
        } else {
            Planning::InTick
        }
    }

    /// Hands over the requests for which there is room. Never waits.
    pub fn offer(&self, requests: impl Iterator<Item = PlanRequest>) {
        for request in requests {
            if self.queue.try_send(request.clone()).is_err() {
                return;
            }
            request.accept();
        }
    }
}

fn serve(waiting: &Mutex<Receiver<PlanRequest>>) {
    loop {
        let next = waiting
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .recv();
        let Ok(request) = next else { return };
        request.solve();
    }
}
