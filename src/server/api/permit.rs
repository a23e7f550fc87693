//! How long a stream may continue: as long as its caller keeps the role with which it was opened, and its proof of
//! identity is valid.

use crate::access::caller::Caller;
use crate::app::{App, stopped};
use crate::worlds::WorldHandle;
use crate::worlds::usage::InUse;
use sinew_wire::status::Fault;
use std::future::Future;
use std::pin::Pin;
use std::sync::Arc;
use std::time::{Duration, SystemTime};
use tokio::sync::watch;

/// Longest sleep of a timer.
const DAY: Duration = Duration::from_secs(86_400);

/// Completes with the reason when a stream has to end.
pub(super) type Ending = Pin<Box<dyn Future<Output = Fault> + Send>>;

/// The right of a stream to continue.
pub(super) struct Permit {
    app: Arc<App>,
    handle: Arc<WorldHandle>,
    caller: Caller,
    figures: Vec<String>,
    changes: watch::Receiver<u64>,
    _in_use: InUse,
}

impl Permit {
    /// For a caller that has just been admitted.
    pub(super) fn new(
        app: &Arc<App>,
        handle: &Arc<WorldHandle>,
        caller: &Caller,
        figures: &[String],
    ) -> Self {
        Self {
            app: app.clone(),
            changes: handle.grants.changes(),
            _in_use: handle.usage.begin(),
            handle: handle.clone(),
            caller: caller.clone(),
            figures: figures.to_vec(),
        }
    }

    fn check(&self) -> Result<(), Fault> {
        if self.caller.expires_in() == Some(Duration::ZERO) {
            return Err(Caller::expired());
        }
        let figures: Vec<&str> = self.figures.iter().map(String::as_str).collect();
        let entered = self.app.enter_for(&self.caller, &self.handle.id, &figures);
        match entered {
            // The stream learns elsewhere that its world is gone.
            Err(fault @ Fault::Denied { .. }) => Err(fault),
            _ => Ok(()),
        }
    }

    /// Completes with the reason when the stream has to end: the server stops, the world is gone, or the right ends.
    /// Kept from one message to the next, so that waiting for a message neither checks the right again nor sets a
    /// timer.
    pub(super) fn ending(mut self, mut stopping: watch::Receiver<bool>) -> Ending {
        let mut closed = self.handle.closed.clone();
        Box::pin(async move {
            tokio::select! {
                () = stopped(&mut stopping) => Fault::Draining,
                // An error means that the world's thread is gone, which says the same.
                _ = closed.changed() => self.handle.no_more(),
                fault = self.ended() => fault,
            }
        })
    }

    /// Completes with the reason when the right ends. May be dropped and called again.
    pub(super) async fn ended(&mut self) -> Fault {
        loop {
            if let Err(fault) = self.check() {
                return fault;
            }
            let end = self.handle.grants.next_end();
            let end = end.map(|at| at.duration_since(SystemTime::now()).unwrap_or_default());
            let wait = [self.caller.expires_in(), end, Some(DAY)]
                .into_iter()
                .flatten()
                .min();
            tokio::select! {
                changed = self.changes.changed() => if changed.is_err() {
                    std::future::pending::<()>().await; // the world is gone
                },
                () = tokio::time::sleep(wait.unwrap_or(DAY) + Duration::from_millis(1)) => {}
            }
        }
    }
}
