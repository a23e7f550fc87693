//! Leases: control of a figure by a secret token.
//!
//! At most one lease per figure. It gets a new token with each new holder, and the epoch counts that. A driver of a
//! figure without a lease has it as long as the drive lasts, by name and without a token (`drives`).

use sha2::{Digest, Sha256};
use sinew_wire::status::Fault;
use sinew_wire::types::{KeptLease, TokenHash};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// An offer of a lease.
#[derive(Clone, Debug)]
pub struct Offer {
    /// The principal that may accept it; `None`: any with the token of the offer.
    pub to: Option<Arc<str>>,
    /// The hash of its token.
    pub token: TokenHash,
    /// Time over which the figure changes to the new motion, s.
    pub blend: f64,
    /// When it ends.
    pub expires: Instant,
}

/// The hash of a secret.
pub fn token_hash(token: &str) -> TokenHash {
    Sha256::digest(token).into()
}

/// The lease of one figure.
#[derive(Clone, Debug)]
pub struct Lease {
    /// The holder.
    pub holder: Arc<str>,
    /// The hash of its secret: it cannot be recovered from memory or disk.
    token: TokenHash,
    /// A lease of higher priority replaces it.
    pub priority: i32,
    /// How long it is kept unused.
    pub grace: Duration,
    /// When it ends; `None` while a stream uses it.
    pub expires: Option<Instant>,
    /// Whether it is offered.
    pub offer: Option<Offer>,
    /// Time over which the figure changes to the motion of this holder, s, once that motion has arrived.
    pub takeover: Option<f64>,
}

/// The leases of a world.
#[derive(Debug, Default)]
pub struct Leases {
    by_figure: BTreeMap<String, Lease>,
    epochs: BTreeMap<String, i64>,
}

/// Whether a secret has this hash, in a time that does not reveal how much of it is right.
fn same(token: &str, known: &TokenHash) -> bool {
    let hash = token_hash(token);
    hash.iter().zip(known).fold(0, |d, (a, b)| d | (a ^ b)) == 0
}

impl Offer {
    /// Whether one of these tokens is valid for it.
    pub fn is_known_to(&self, tokens: &[String]) -> bool {
        tokens.iter().any(|t| same(t, &self.token))
    }
}

/// The answer to a holder whose token is not the valid one.
pub fn fenced(figure: &str) -> Fault {
    Fault::Aborted {
        reason: "CONTROL_FENCED",
        message: format!("the token is not, or no longer, that of the lease of figure {figure:?}"),
    }
}

impl Lease {
    /// A new lease.
    pub fn new(
        holder: Arc<str>,
        token: &str,
        priority: i32,
        grace: Duration,
        now: Instant,
    ) -> Self {
        let token = token_hash(token);
        let kept = KeptLease {
            holder,
            token,
            priority,
            grace,
        };
        Self::again(kept, now)
    }

    /// A lease from before a restart, unused until its holder comes back.
    pub fn again(kept: KeptLease, now: Instant) -> Self {
        let KeptLease {
            holder,
            token,
            priority,
            grace,
        } = kept;
        Self {
            holder,
            token,
            priority,
            grace,
            expires: Some(now + grace),
            offer: None,
            takeover: None,
        }
    }

    /// The form in which it outlives the server.
    pub fn kept(&self) -> KeptLease {
        KeptLease {
            holder: Arc::clone(&self.holder),
            token: self.token,
            priority: self.priority,
            grace: self.grace,
        }
    }

    /// Whether someone holds it, with one of these tokens.
    pub fn is_held_by(&self, principal: &str, tokens: &[String]) -> bool {
        *self.holder == *principal && tokens.iter().any(|t| same(t, &self.token))
    }

    /// Notes that it is used.
    pub fn touch(&mut self, now: Instant) {
        self.expires = Some(now + self.grace);
    }
}

impl Leases {
    /// The lease of a figure.
    pub fn of(&self, figure: &str) -> Option<&Lease> {
        self.by_figure.get(figure)
    }

    /// The same, to change it.
    pub fn of_mut(&mut self, figure: &str) -> Option<&mut Lease> {
        self.by_figure.get_mut(figure)
    }

    /// Whether there are any.
    pub fn are_held(&self) -> bool {
        !self.by_figure.is_empty()
    }

    /// The number of times that the control of a figure has changed hands.
    pub fn epoch(&self, figure: &str) -> i64 {
        self.epochs.get(figure).copied().unwrap_or(0)
    }

    /// Counts one more change of hands.
    pub fn count(&mut self, figure: &str) {
        *self.epochs.entry(figure.to_owned()).or_default() += 1;
    }

    /// Gives a figure a lease, replacing the present one.
    pub fn put(&mut self, figure: &str, lease: Lease) {
        self.count(figure);
        self.by_figure.insert(figure.to_owned(), lease);
    }

    /// Brings back the known control of a figure from before a restart of the server.
    pub fn bring_back(&mut self, figure: &str, epoch: i64, lease: Option<Lease>) {
        self.epochs.insert(figure.to_owned(), epoch);
        if let Some(lease) = lease {
            self.by_figure.insert(figure.to_owned(), lease);
        }
    }

    /// Ends a lease.
    pub fn end(&mut self, figure: &str) -> Option<Lease> {
        self.by_figure.remove(figure)
    }

    /// Forgets a figure that no longer exists.
    pub fn forget(&mut self, figure: &str) {
        self.by_figure.remove(figure);
        self.epochs.remove(figure);
    }

    /// Whether one of them ends if it is not used.
    pub fn end_by_themselves(&self) -> bool {
        self.by_figure.values().any(|l| l.expires.is_some())
    }

    /// A figure with an expired lease.
    pub fn expired(&self, now: Instant) -> Option<String> {
        let over = |l: &Lease| l.expires.is_some_and(|at| at <= now);
        self.by_figure
            .iter()
            .find(|(_, l)| over(l))
            .map(|(figure, _)| figure.clone())
    }

    /// Checks that leases let a caller control a figure.
    ///
    /// # Errors
    /// A token is not the valid one, or there is none and someone else has the lease.
    pub fn check(
        &self,
        figure: &str,
        principal: &str,
        tokens: &[String],
        now: Instant,
    ) -> Result<(), Fault> {
        match self.of(figure) {
            Some(lease) if lease.is_held_by(principal, tokens) => Ok(()),
            Some(lease) if tokens.is_empty() => Err(controlled(figure, lease, now)),
            None if tokens.is_empty() => Ok(()),
            _ => Err(fenced(figure)),
        }
    }
}

impl Leases {
    /// Checks that someone may drive all of these figures. Every token must be that of one of them.
    ///
    /// # Errors
    /// Same as [`Leases::check`].
    pub fn check_all(
        &self,
        figures: &[String],
        principal: &str,
        tokens: &[String],
        now: Instant,
    ) -> Result<(), Fault> {
        let leased: Vec<_> = figures
            .iter()
            .filter_map(|f| Some((f, self.of(f)?)))
            .collect();
        for (figure, lease) in &leased {
            if !lease.is_held_by(principal, tokens) {
                return Err(if tokens.is_empty() {
                    controlled(figure, lease, now)
                } else {
                    fenced(figure)
                });
            }
        }
        let known = |t: &String| leases_hold(&leased, t);
        match tokens.iter().all(known) {
            true => Ok(()),
            false => Err(fenced(figures.first().map_or("", String::as_str))),
        }
    }
}

fn leases_hold(leased: &[(&String, &Lease)], token: &str) -> bool {
    leased.iter().any(|(_, l)| same(token, &l.token))
}

/// The fault for others that want a figure with a lease.
pub fn controlled(figure: &str, lease: &Lease, now: Instant) -> Fault {
    let mut facts = vec![
        ("controller", lease.holder.to_string()),
        ("priority", lease.priority.to_string()),
    ];
    if let Some(at) = lease.expires {
        let left = at.saturating_duration_since(now).as_millis();
        facts.push(("lease_expires_ms", left.to_string()));
    }
    Fault::Precondition {
        reason: "FIGURE_CONTROLLED",
        message: format!("{:?} has the lease of figure {figure:?}", lease.holder),
        facts,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_holder_with_the_valid_token_passes() {
        let now = Instant::now();
        let mut leases = Leases::default();
        let lease = |holder: &str, token: &str| {
            Lease::new(holder.into(), token, 0, Duration::from_secs(1), now)
        };
        let tokens = |t: &str| vec![t.to_owned()];
        let reason = |leases: &Leases, who: &str, tokens: &[String]| {
            leases.check("a", who, tokens, now).map_err(|f| f.reason())
        };
        assert_eq!(reason(&leases, "me", &[]), Ok(()));
        assert_eq!(reason(&leases, "me", &tokens("old")), Err("CONTROL_FENCED"));
        leases.put("a", lease("me", "secret"));
        assert_eq!(reason(&leases, "me", &tokens("secret")), Ok(()));
        assert_eq!(
            reason(&leases, "you", &tokens("secret")),
            Err("CONTROL_FENCED"),
            "stolen"
        );
        assert_eq!(
            reason(&leases, "me", &tokens("secre")),
            Err("CONTROL_FENCED")
        );
        assert_eq!(reason(&leases, "me", &[]), Err("FIGURE_CONTROLLED"));
        leases.put("a", lease("you", "other"));
        assert_eq!(leases.epoch("a"), 2);
        assert_eq!(
            reason(&leases, "me", &tokens("secret")),
            Err("CONTROL_FENCED")
        );
        assert_eq!(leases.expired(now), None);
        assert_eq!(
            leases.expired(now + Duration::from_secs(1)),
            Some("a".into())
        );
    }
}
