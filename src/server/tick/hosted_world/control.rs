//! Leases of figures: taking, returning, handing over and losing them.

use super::HostedWorld;
use crate::ingest::mailbox::DriverId;
use crate::tick::leases::{Lease, Offer, controlled, fenced, token_hash};
use crate::tick::scene::SceneInput;
use sinew_wire::status::Fault;
use sinew_wire::types::{Acquire, ControlInfo, ControlKey, EventKind, KeptLease, Transfer};
use std::sync::Arc;
use std::time::{Duration, Instant};

impl HostedWorld {
    /// The controller of a figure.
    ///
    /// # Errors
    /// There is no such figure.
    pub fn control(&self, figure: &str) -> Result<ControlInfo, Fault> {
        self.member(figure)?;
        Ok(self.control_of(figure, Instant::now()))
    }

    /// The controller of each figure, in the order of figures.
    pub fn controls(&self) -> Vec<ControlInfo> {
        let now = Instant::now();
        let members = self.scene.members().iter();
        members.map(|m| self.control_of(&m.id, now)).collect()
    }

    /// Whether a lease or a drive ends by itself, at a time that every use postpones.
    pub(super) fn control_passes(&self) -> bool {
        self.leases.end_by_themselves() || self.drives.iter().any(|d| d.expires.is_some())
    }

    fn control_of(&self, figure: &str, now: Instant) -> ControlInfo {
        let mut info = ControlInfo {
            figure: figure.to_owned(),
            epoch: self.leases.epoch(figure),
            ..ControlInfo::default()
        };
        let left = |at: Option<Instant>| at.map(|at| at.saturating_duration_since(now));
        if let Some(lease) = self.leases.of(figure) {
            info.holder = Some(lease.holder.clone());
            info.priority = lease.priority;
            info.expires_in = left(lease.expires);
            let offer = lease.offer.as_ref().filter(|o| o.expires > now);
            info.offered_to = offer.map(|o| o.to.clone().unwrap_or_else(|| "*".into()));
            info.kept = Some(lease.kept());
        } else if let Some(drive) = self.drives.iter().find(|d| d.has(figure)) {
            info.holder = Some(drive.id.principal.clone());
            info.expires_in = left(drive.expires);
            info.implicit = true;
        }
        info
    }

    /// Takes or renews a lease. Returns it with its token.
    ///
    /// # Errors
    /// Someone else has it, with no lower priority; or the token is not the valid one.
    pub fn acquire(
        &mut self,
        figure: &str,
        who: &ControlKey,
        a: Acquire,
    ) -> Result<(ControlInfo, String), Fault> {
        self.working()?;
        self.member(figure)?;
        let now = Instant::now();
        if !who.tokens.is_empty() {
            self.leases
                .check(figure, &who.principal, &who.tokens, now)?;
            let lease = self.leases.of_mut(figure).ok_or_else(|| fenced(figure))?;
            if a.priority != 0 {
                lease.priority = a.priority;
            }
            lease.grace = a.grace;
            if lease.expires.is_some() {
                lease.touch(now);
            }
            // The token that was just shown to be valid.
            let mut tokens = who.tokens.iter();
            let token = tokens.find(|t| lease.is_held_by(&who.principal, std::slice::from_ref(t)));
            let token = token.cloned().ok_or_else(|| fenced(figure))?;
            return Ok((self.control(figure)?, token));
        }
        // Two anonymous callers cannot be told apart, so a lost token is lost.
        let own = |holder: &str| a.known && *holder == *who.principal;
        let detail = match self.leases.of(figure) {
            Some(lease) if own(&lease.holder) => None,
            Some(lease) if a.priority > lease.priority => Some(lease.holder.clone()),
            Some(lease) => return Err(controlled(figure, lease, now)),
            None => match self.drives.iter().find(|d| d.has(figure)) {
                Some(d) if own(&d.id.principal) => None,
                Some(d) if a.priority > 0 => Some(d.id.to_string().into()),
                Some(d) => return Err(d.controlled(figure, now)),
                None => None,
            },
        };
        let renewed = self.leases.of(figure).is_some();
        if detail.is_some() || renewed {
            // A drive with the earlier token is fenced; one without a token continues with the new one.
            self.take_figure(figure, "someone else has the lease now");
        }
        let token = a.token;
        let lease = Lease::new(who.principal.clone(), &token, a.priority, a.grace, now);
        self.leases.put(figure, lease);
        self.use_leases(now);
        self.event(
            figure,
            match detail {
                Some(from) => EventKind::ControlPreempted(format!("{} from {from}", who.principal)),
                None => EventKind::ControlAcquired(who.principal.to_string()),
            },
        );
        self.touch();
        Ok((self.control(figure)?, token))
    }

    /// Brings back leases from before a restart of the server: their holders have their grace time to come back. Leases
    /// of figures that no longer exist are dropped.
    pub fn bring_leases_back(&mut self, all: Vec<(String, i64, Option<KeptLease>)>) {
        let now = Instant::now();
        for (figure, epoch, kept) in all {
            if self.member(&figure).is_ok() {
                let lease = kept.map(|kept| Lease::again(kept, now));
                self.leases.bring_back(&figure, epoch, lease);
            }
        }
        self.touch();
    }

    /// Returns a lease.
    ///
    /// # Errors
    /// The token is not the valid one.
    pub fn release(&mut self, figure: &str, who: &ControlKey) -> Result<(), Fault> {
        self.member(figure)?;
        self.held(figure, who)?;
        self.end_lease(figure, "given back");
        Ok(())
    }

    /// Offers a lease. Returns it; the token of the offer is that of `t`.
    ///
    /// # Errors
    /// The token is not the valid one.
    pub fn transfer(
        &mut self,
        figure: &str,
        who: &ControlKey,
        t: Transfer,
    ) -> Result<ControlInfo, Fault> {
        self.working()?;
        self.member(figure)?;
        let now = Instant::now();
        let lease = self.held(figure, who)?;
        let whom = t.to.clone().unwrap_or_else(|| "*".into());
        let detail = format!("{} to {whom}", lease.holder);
        lease.offer = Some(Offer {
            to: t.to,
            token: token_hash(&t.token),
            blend: t.blend,
            expires: now + t.lasts,
        });
        self.event(figure, EventKind::ControlOffered(detail));
        self.control(figure)
    }

    /// Accepts an offer. The lease gets a new holder and a new token.
    ///
    /// # Errors
    /// There is no such offer to this principal.
    pub fn accept(
        &mut self,
        figure: &str,
        who: &ControlKey,
        token: String,
        grace: Duration,
    ) -> Result<(ControlInfo, String), Fault> {
        self.working()?;
        self.member(figure)?;
        let now = Instant::now();
        let lease = self.leases.of(figure).ok_or_else(|| fenced(figure))?;
        let offered = lease.offer.as_ref().filter(|o| {
            let to = o.to.as_ref().is_none_or(|to| *to == who.principal);
            to && o.expires > now && o.is_known_to(&who.tokens)
        });
        let offer = offered.ok_or_else(|| Fault::Aborted {
            reason: "CONTROL_FENCED",
            message: format!(
                "there is no such offer of the lease of figure {figure:?} to {:?}",
                who.principal
            ),
        })?;
        let mut next = Lease::new(who.principal.clone(), &token, lease.priority, grace, now);
        // Without a drive there is no motion to switch from.
        let driven = self.drives.iter().any(|d| d.has(figure));
        next.takeover = driven.then_some(offer.blend);
        let detail = format!("{} from {}", who.principal, lease.holder);
        self.leases.put(figure, next);
        self.event(figure, EventKind::ControlAcquired(detail));
        self.touch();
        Ok((self.control(figure)?, token))
    }

    fn held(&mut self, figure: &str, who: &ControlKey) -> Result<&mut Lease, Fault> {
        let lease = self.leases.of_mut(figure);
        lease
            .filter(|l| l.is_held_by(&who.principal, &who.tokens))
            .ok_or_else(|| fenced(figure))
    }

    /// Checks that a caller may let a figure do something other than follow a live drive, and counts that as a use of
    /// its lease.
    pub(super) fn may_direct(&mut self, figure: &str, who: &ControlKey) -> Result<(), Fault> {
        let now = Instant::now();
        self.leases
            .check(figure, &who.principal, &who.tokens, now)?;
        let goes_over = self.leases.of(figure).is_some_and(|l| l.takeover.is_some());
        if goes_over {
            // The previous holder still drives; its motion ends with the new one.
            self.detach(figure, "the lease was handed over");
        }
        self.not_driven(figure)?;
        if let Some(lease) = self.leases.of_mut(figure) {
            lease.takeover = None;
            lease.touch(now);
        }
        Ok(())
    }

    /// Checks that a caller may change a figure that another one may be driving.
    pub(super) fn may_adjust(&self, figure: &str, who: &ControlKey) -> Result<(), Fault> {
        let now = Instant::now();
        self.leases
            .check(figure, &who.principal, &who.tokens, now)?;
        let drive = self.drives.iter().find(|d| d.has(figure));
        match drive.filter(|d| d.id.principal != who.principal) {
            Some(other) => Err(other.controlled(figure, now)),
            None => Ok(()),
        }
    }

    /// Ends a lease and the drive of the figure under it.
    pub(super) fn end_lease(&mut self, figure: &str, why: &str) {
        let Some(lease) = self.leases.end(figure) else {
            return;
        };
        self.take_figure(figure, why);
        self.event(
            figure,
            EventKind::ControlReleased(format!("{}: {why}", lease.holder)),
        );
        self.touch();
    }

    /// Ends expired leases. A driven figure comes to a stand; one that plays a clip continues.
    pub(super) fn expire_leases(&mut self, now: Instant) {
        while let Some(figure) = self.leases.expired(now) {
            self.end_lease(&figure, "its time is over");
        }
    }

    /// Leases do not expire while a stream or pushes of their holders use them.
    pub(super) fn use_leases(&mut self, now: Instant) {
        for drive in &self.drives {
            for slot in drive.slots.iter().filter(|s| s.player.is_some()) {
                let lease = self.leases.of_mut(&slot.figure);
                // The drive of the previous holder must not keep the new holder's lease alive.
                let Some(lease) = lease.filter(|l| l.holder == drive.id.principal) else {
                    continue;
                };
                match (drive.connection, drive.expires) {
                    (Some(_), _) => lease.expires = None,
                    (None, Some(at)) => {
                        let least = lease.expires.unwrap_or(now + lease.grace);
                        lease.expires = Some(least.max(at));
                    }
                    (None, None) => {}
                }
            }
        }
    }

    /// A stream of this drive has ended: the grace time of its leases begins now.
    pub(super) fn release_leases(&mut self, id: &DriverId, now: Instant) {
        let drive = self.drives.iter().find(|d| d.id == *id);
        let figures = drive
            .iter()
            .flat_map(|d| d.slots.iter().map(|s| s.figure.clone()));
        for figure in figures.collect::<Vec<_>>() {
            let lease = self.leases.of_mut(&figure);
            if let Some(lease) = lease.filter(|l| l.holder == id.principal && l.expires.is_none()) {
                lease.touch(now);
            }
        }
    }

    /// Takes a figure from its driver: it finishes its step and stands.
    fn take_figure(&mut self, figure: &str, why: &str) {
        if self.detach(figure, why) {
            self.hold(figure);
        }
    }

    /// Ends the drive of a figure without stopping its motion; its driver is fenced. Returns whether it had a driver.
    pub(super) fn detach(&mut self, figure: &str, why: &str) -> bool {
        let Some(i) = self.drives.iter().position(|d| d.has(figure)) else {
            return false;
        };
        let drive = &mut self.drives[i];
        let mut ended = None;
        for (n, slot) in drive.slots.iter_mut().enumerate() {
            if slot.figure == figure {
                ended = slot.player.take();
                drive.mailbox.fence(n);
            }
        }
        let name = drive.id.name.clone();
        if drive.slots.iter().all(|s| s.player.is_none()) {
            let drive = self.drives.remove(i);
            drive.mailbox.close(fenced(figure));
            self.mailboxes.remove(&drive.id);
        }
        // It may have ended by itself because another player took the figure over.
        if let Some(key) = ended.filter(|key| self.scene.player(*key).is_some()) {
            let _ = self.scene.apply(SceneInput::Unfollow(key)); // never refused
        }
        self.event(figure, EventKind::DriveEnded(format!("{name}: {why}")));
        self.touch();
        true
    }

    /// Tells viewers of events that a caller was refused.
    pub fn tell_refused(&mut self, figure: &str, who: &Arc<str>, call: &str) {
        self.event(figure, EventKind::AccessRefused(format!("{who}: {call}")));
    }
}
