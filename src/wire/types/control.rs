//! Control of figures.

use std::sync::Arc;
use std::time::Duration;

/// A principal that wants to control a figure, and its tokens.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlKey {
    /// The principal.
    pub principal: Arc<str>,
    /// Tokens of leases.
    pub tokens: Vec<String>,
}

/// The request for a lease.
#[derive(Clone, Debug)]
pub struct Acquire {
    /// Token of a new lease.
    pub token: String,
    /// Priority.
    pub priority: i32,
    /// Time for which an unused lease is kept.
    pub grace: Duration,
    /// Whether the principal is known, not anonymous.
    pub known: bool,
}

/// The offer of a lease.
#[derive(Clone, Debug)]
pub struct Transfer {
    /// The principal that may accept it; `None`: any with the token.
    pub to: Option<Arc<str>>,
    /// Token of the offer.
    pub token: String,
    /// Time over which the figure changes to the new motion, s.
    pub blend: f64,
    /// Time for which the offer stands.
    pub lasts: Duration,
}

/// SHA-256 of a secret.
pub type TokenHash = [u8; 32];

/// The part of a lease that outlives the server.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptLease {
    /// The holder.
    pub holder: Arc<str>,
    /// The hash of its secret.
    pub token: TokenHash,
    /// Its priority.
    pub priority: i32,
    /// Time for which it is kept unused.
    pub grace: Duration,
}

/// The control of a figure.
#[derive(Clone, Debug, Default)]
pub struct ControlInfo {
    /// Last part of the figure's name.
    pub figure: String,
    /// The holder; `None`: none.
    pub holder: Option<Arc<str>>,
    /// The number of changes of control.
    pub epoch: i64,
    /// Priority.
    pub priority: i32,
    /// Remaining time; `None`: no end while it is used.
    pub expires_in: Option<Duration>,
    /// Whether it came with a drive.
    pub implicit: bool,
    /// The principal to which it is offered.
    pub offered_to: Option<Arc<str>>,
    /// The part of it that outlives the server. Not for clients.
    pub kept: Option<KeptLease>,
}
