//! Shared helpers of the server's unit tests: a temporary directory, and a server on it.

use super::app::App;
use super::config::Config;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use tokio::sync::watch;

/// An empty directory that is removed when the test ends.
pub(crate) struct Temporary(pub PathBuf);

impl Temporary {
    /// A new directory for this test.
    pub fn new() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let n = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("sinew-test-{}-{n}", std::process::id());
        let dir = std::env::temp_dir().join(name);
        let _ = std::fs::remove_dir_all(&dir); // left by an earlier process with this number
        std::fs::create_dir_all(&dir).expect("a directory");
        Self(dir)
    }

    /// A server that stores its worlds in it, with these additional settings.
    pub async fn open(&self, more: &[(&str, &str)]) -> Arc<App> {
        let dir = self.0.to_str().expect("a path of letters");
        let own = [
            ("data_dir", dir),
            ("tick_priority", "plain"),
            ("tick_workers", "1"),
        ];
        let flags = own.iter().chain(more);
        let flags: Vec<_> = flags
            .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()))
            .collect();
        let config = Config::load(None, std::iter::empty(), &flags).expect("settings");
        let (_, stopping) = watch::channel(false);
        let app = Arc::new(App::new(Arc::new(config), stopping).expect("a server"));
        app.restore().await;
        app
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Shuts down a server in the orderly way.
pub(crate) async fn close(app: Arc<App>) {
    app.worlds.drain().await;
    app.persistence
        .as_ref()
        .expect("it has a data directory")
        .close()
        .await;
}
