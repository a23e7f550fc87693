//! Work that takes long (files to clips, offline simulations): a few at a time, off the async threads, given up when
//! the client is gone.

use crate::wire::status::Fault;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;
use tokio::sync::Semaphore;

/// The bench where long work is done.
#[derive(Debug)]
pub struct Workers {
    permits: Arc<Semaphore>,
    waiting: AtomicUsize,
    running: Arc<AtomicUsize>,
    most_waiting: u64,
}

/// Tells the work that nobody waits for it any more.
#[derive(Clone, Debug, Default)]
pub struct Cancelled(Arc<AtomicBool>);

impl Cancelled {
    /// True if the work is to stop.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

struct CancelOnDrop(Cancelled);
impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.0.store(true, Ordering::Relaxed);
    }
}

struct Count<'a>(&'a AtomicUsize);
impl Drop for Count<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Workers {
    /// `most` at a time, and `most_waiting` that wait.
    pub fn new(most: u64, most_waiting: u64) -> Self {
        Self {
            permits: Arc::new(Semaphore::new(most as usize)),
            waiting: AtomicUsize::new(0),
            running: Arc::default(),
            most_waiting,
        }
    }

    /// Pieces of work that are being done.
    pub fn running(&self) -> usize {
        self.running.load(Ordering::Relaxed)
    }

    /// Does long work when its turn comes.
    ///
    /// # Errors
    /// Those of the work; too much work waits; the work panicked.
    pub async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Cancelled) -> Result<T, Fault> + Send + 'static,
    ) -> Result<T, Fault> {
        let permit = match self.permits.clone().try_acquire_owned() {
            Ok(permit) => permit,
            Err(_) => {
                let before = self.waiting.fetch_add(1, Ordering::Relaxed);
                let _counted = Count(&self.waiting);
                if before as u64 >= self.most_waiting {
                    return Err(Fault::Exhausted {
                        limit: "max_waiting_simulations",
                        value: self.most_waiting,
                        message: "one more simulation or file conversion".into(),
                        retry: Some(Duration::from_secs(1)),
                    });
                }
                self.permits
                    .clone()
                    .acquire_owned()
                    .await
                    .map_err(|_| Fault::Draining)?
            }
        };
        let cancelled = Cancelled::default();
        let flag = cancelled.clone();
        let _cancel = CancelOnDrop(cancelled);
        let running = self.running.clone();
        tokio::task::spawn_blocking(move || {
            running.fetch_add(1, Ordering::Relaxed);
            let _counted = Count(&running);
            let result = work(&flag);
            drop(permit);
            result
        })
        .await
        .unwrap_or_else(|e| Err(Fault::Internal(format!("the work ended abnormally: {e}"))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn work_that_panics_or_crowds_is_refused_and_the_rest_goes_on() {
        let workers = Workers::new(1, 0);
        let panicked = workers.run(|_| -> Result<(), Fault> { panic!("oh") }).await;
        assert!(matches!(panicked, Err(Fault::Internal(_))));
        let (go, wait) = std::sync::mpsc::sync_channel::<()>(1);
        let first = workers.run(move |_| {
            wait.recv().ok();
            Ok(1)
        });
        tokio::pin!(first);
        assert!(futures_util::FutureExt::now_or_never(&mut first).is_none());
        assert!(matches!(
            workers.run(|_| Ok(2)).await,
            Err(Fault::Exhausted { .. })
        ));
        go.send(()).unwrap();
        assert_eq!(first.await.unwrap(), 1);
        assert_eq!(workers.run(|_| Ok(3)).await.unwrap(), 3);
    }
}
