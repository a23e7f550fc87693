//! Who controls a figure.

use std::sync::Arc;
use std::time::Duration;

/// Who wants to control a figure, and by which tokens.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlKey {
    /// Who.
    pub principal: Arc<str>,
    /// Tokens of leases.
    pub tokens: Vec<String>,
}

/// How a lease is wanted.
#[derive(Clone, Debug)]
pub struct Acquire {
    /// Token of a new lease.
    pub token: String,
    /// Priority.
    pub priority: i32,
    /// How long it is kept unused.
    pub grace: Duration,
    /// Who wants it is known, not anonymous.
    pub known: bool,
}

/// How a lease is offered.
#[derive(Clone, Debug)]
pub struct Transfer {
    /// To whom; `None`: to who has the token.
    pub to: Option<Arc<str>>,
    /// Token of the offer.
    pub token: String,
    /// How long the figure goes over, s.
    pub blend: f64,
    /// How long it stands.
    pub lasts: Duration,
}

/// SHA-256 of a secret.
pub type TokenHash = [u8; 32];

/// A lease as it outlives the server.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptLease {
    /// Who has it.
    pub holder: Arc<str>,
    /// The hash of its secret.
    pub token: TokenHash,
    /// Its priority.
    pub priority: i32,
    /// How long it is kept unused.
    pub grace: Duration,
}

/// Who controls a figure.
#[derive(Clone, Debug, Default)]
pub struct ControlInfo {
    /// Last part of the figure's name.
    pub figure: String,
    /// Who; `None`: nobody.
    pub holder: Option<Arc<str>>,
    /// How often that changed.
    pub epoch: i64,
    /// Priority.
    pub priority: i32,
    /// When it ends; `None`: not as long as it is used.
    pub expires_in: Option<Duration>,
    /// It came with a drive.
    pub implicit: bool,
    /// To whom it is offered.
    pub offered_to: Option<Arc<str>>,
    /// The part of it that outlives the server. Not for clients.
    pub kept: Option<KeptLease>,
}
