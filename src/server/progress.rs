//! Progress of long work, for its watchers.

use tokio::sync::watch;

/// Least change that is reported.
const STEP: f64 = 0.01;
/// Largest value reported before the end.
const NEARLY: f64 = 0.99;

/// Progress of a piece of work: nothing while it waits for its turn, then a share of 0…1.
#[derive(Clone, Debug)]
pub struct WorkProgress(watch::Sender<Option<f64>>);

impl Default for WorkProgress {
    fn default() -> Self {
        Self(watch::Sender::new(None))
    }
}

impl WorkProgress {
    /// Reports that `done` of `all` is done. The share never decreases.
    pub fn tell(&self, done: f64, all: f64) {
        let share = if all > 0.0 { done / all } else { 0.0 };
        let share = share.clamp(0.0, NEARLY);
        self.0.send_if_modified(|told| {
            let news = told.is_none_or(|before| share >= before + STEP);
            if news {
                *told = Some(share);
            }
            news
        });
    }

    /// Follows the progress.
    pub fn watch(&self) -> watch::Receiver<Option<f64>> {
        self.0.subscribe()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_goes_on_in_steps_and_never_back() {
        let progress = WorkProgress::default();
        let mut seen = progress.watch();
        assert_eq!(*seen.borrow_and_update(), None);
        for (done, told, news) in [
            (0.0, 0.0, true),
            (5.0, 0.005, false),
            (500.0, 0.5, true),
            (400.0, 0.5, false),
            (1000.0, NEARLY, true),
            (f64::NAN, NEARLY, false),
        ] {
            progress.tell(done, 1000.0);
            assert_eq!(seen.has_changed().unwrap(), news, "{done}");
            if news {
                assert_eq!(*seen.borrow_and_update(), Some(told));
            }
        }
    }
}
