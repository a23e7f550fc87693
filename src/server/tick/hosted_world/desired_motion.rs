//! Desired motion of figures: clips, and live drives.

use super::HostedWorld;
use crate::engine::Clip;
use crate::ingest::jitter_buffer::Now;
use crate::ingest::mailbox::{DriverId, Mailbox, fenced};
use crate::ingest::time::ScheduledTime;
use crate::rehearsals::{Performer, Rehearsed};
use crate::telemetry::metrics::ticks;
use crate::tick::drives::{DrivenFigure, DriverSession};
use crate::tick::scene::{InputResult, SceneInput};
use sinew_wire::status::Fault;
use sinew_wire::types::{ClipBeginning, ControlKey, DriveOpen, EventKind, Feedback, Playback};
use std::sync::Arc;
use std::time::Instant;

impl HostedWorld {
    pub(super) fn not_driven(&self, figure: &str) -> Result<(), Fault> {
        match self.drives.iter().find(|d| d.has(figure)) {
            Some(d) => Err(d.controlled(figure, Instant::now())),
            None => Ok(()),
        }
    }

    /// A figure, for which a clip is to be rehearsed.
    ///
    /// # Errors
    /// There is none of that name, or nothing can be rehearsed for it.
    pub fn performer(&self, figure: &str) -> Result<Performer, Fault> {
        let key = self.scene.members()[self.member(figure)?].key;
        let world = self.scene.world();
        Performer::of(self.scene.figure(key), world.params(), world.time())
    }

    /// Lets a figure play a clip, in its rehearsed form if it was rehearsed for this figure.
    pub fn play(
        &mut self,
        figure: &str,
        clip_id: &str,
        (clip, rehearsed): (Arc<Clip>, &[Arc<Rehearsed>]),
        playback: Playback,
        who: &ControlKey,
    ) -> Result<ClipBeginning, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        self.may_direct(figure, who)?;
        let key = self.scene.members()[i].key;
        let reset = playback.reset;
        let rehearsed = match rehearsed {
            _ if playback.looped => None,
            [] => None,
            all => self.performer(figure).ok().and_then(|mine| {
                let like = |r: &&Arc<Rehearsed>| r.performer.is_like(&mine);
                all.iter().find(like).map(|r| Arc::clone(&r.motion))
            }),
        };
        self.end_undriven(key);
        let done = self.scene.apply(SceneInput::Play {
            figure: key,
            name: clip_id.to_owned(),
            clip,
            rehearsed,
            playback,
        })?;
        self.changed |= reset;
        match done {
            InputResult::Begins(begins) => Ok(begins),
            _ => Err(Fault::Internal("a clip was played".into())),
        }
    }

    pub(super) fn hold(&mut self, figure: &str) {
        let Ok(i) = self.member(figure) else { return };
        let key = self.scene.members()[i].key;
        self.end_undriven(key);
        let _ = self.scene.apply(SceneInput::Stop(key)); // never refused
    }

    /// Lets a figure finish its step and stand, or hold its present desired posture if it stands already.
    pub fn stop(&mut self, figure: &str, who: &ControlKey) -> Result<(), Fault> {
        self.working()?;
        self.member(figure)?;
        self.may_direct(figure, who)?;
        self.hold(figure);
        Ok(())
    }

    /// Begins or resumes a drive. `connection` is the stream that will send; `None` for a push. Returns the mailbox for
    /// its motion.
    pub fn open_drive(
        &mut self,
        open: &DriveOpen,
        connection: Option<u64>,
    ) -> Result<Arc<Mailbox>, Fault> {
        self.working()?;
        self.check_figures(&open.figures)?;
        let now = Instant::now();
        let who = &open.who;
        self.leases
            .check_all(&open.figures, &who.principal, &who.tokens, now)?;
        let id = DriverId {
            principal: who.principal.clone(),
            name: self.driver_name(&open.driver, connection),
        };
        for figure in &open.figures {
            let other = |d: &&DriverSession| d.id != id && d.has(figure);
            let other = self.drives.iter().find(other);
            if let Some(other) = other.filter(|_| self.takeover(figure).is_none()) {
                return Err(other.controlled(figure, now));
            }
        }
        if let Some(d) = self.drives.iter_mut().find(|d| d.id == id) {
            if d.drives(&open.figures) && who.tokens == d.mailbox.tokens() {
                d.touch(connection, now); // the same driver comes back: its motion continues
                let mailbox = Arc::clone(&d.mailbox);
                self.use_leases(now);
                return Ok(mailbox);
            }
            self.end_drive(&id, "drives other figures now");
        }
        let mut slots = Vec::with_capacity(open.figures.len());
        for figure in &open.figures {
            let takeover = self.takeover(figure);
            if takeover.is_some()
                && let Some(lease) = self.leases.of_mut(figure)
            {
                lease.takeover = None;
            }
            let key = self.scene.members()[self.member(figure)?].key;
            self.end_undriven(key);
            let followed = self.scene.apply(SceneInput::Follow {
                figure: key,
                settings: open.settings.clone(),
                window: open.settings.window.unwrap_or(self.limits.window),
                takeover,
            })?;
            slots.push(DrivenFigure {
                figure: figure.clone(),
                player: match followed {
                    InputResult::Player(key) => Some(key),
                    _ => None,
                },
            });
        }
        let settings = open.settings.clone();
        let drive = DriverSession::new(id.clone(), connection, settings, slots, now);
        let mailbox = Arc::clone(&drive.mailbox);
        mailbox.keep_tokens(&who.tokens);
        mailbox.publish(drive.feedback(&self.scene));
        self.mailboxes.insert(Arc::clone(&mailbox));
        self.drives.push(drive);
        for figure in &open.figures {
            if self.leases.of(figure).is_none() {
                self.leases.count(figure); // a lease without a token
            }
            self.event(figure, EventKind::DriveBegan(id.name.to_string()));
        }
        self.use_leases(now);
        Ok(mailbox)
    }

    /// The name of a driver.
    fn driver_name(&mut self, asked: &str, connection: Option<u64>) -> Arc<str> {
        match (asked, connection) {
            ("", None) => "push".into(),
            ("", Some(_)) => loop {
                let name = format!("driver-{}", self.next_driver);
                self.next_driver += 1;
                if self.drives.iter().all(|d| *d.id.name != *name) {
                    break name.into();
                }
            },
            (name, _) => name.into(),
        }
    }

    /// Time over which the figure changes to the motion of a new holder of its lease, s, if a handover is pending.
    fn takeover(&self, figure: &str) -> Option<f64> {
        self.leases.of(figure)?.takeover
    }

    /// Takes the motion that drivers have sent since the last tick.
    pub(in crate::tick) fn collect_motion(&mut self) {
        let now = Instant::now();
        let scheduled = self.schedule();
        for drive in &mut self.drives {
            drive.collect(&mut self.scene, &scheduled, now);
        }
        self.tell_new_beginnings();
    }

    /// World time that the clock has skipped until now, s.
    fn lost(&self) -> f64 {
        self.lost_before + self.clock.lost() * self.scene.world().dt()
    }

    /// The scheduled time of an arrival. Scheduled time stands still while the clock does.
    fn schedule(&self) -> impl Fn(Instant) -> ScheduledTime + use<> {
        let now = Now {
            time: self.scene.world().time(),
            lost: self.lost(),
        };
        let dt = self.scene.world().dt();
        let clock = (!self.paused).then(|| self.clock.clone());
        move |arrival| {
            let since = clock.as_ref().map_or(0.0, |c| c.since_deadline(arrival));
            now.scheduled() + since * dt
        }
    }

    /// Announces that streams restarted, and why.
    fn tell_new_beginnings(&mut self) {
        let mut told = Vec::new();
        for drive in &self.drives {
            for slot in &drive.slots {
                let notice = slot.player.and_then(|key| self.scene.take_notice(key));
                if let Some(why) = notice {
                    let detail = format!("{}: {}", drive.id.name, why.reason());
                    told.push((slot.figure.clone(), detail));
                }
            }
        }
        for (figure, detail) in told {
            self.event(&figure, EventKind::DriveResynced(detail));
        }
    }

    /// Gives drivers that push the state of their drives without a question to the world.
    pub(in crate::tick) fn publish_feedback(&self) {
        for drive in self.drives.iter().filter(|d| d.connection.is_none()) {
            drive.mailbox.publish(drive.feedback(&self.scene));
        }
    }

    /// Notes that a frame has been published: how long its motion took to get there.
    pub(in crate::tick) fn note_shown(&mut self) {
        let now = Instant::now();
        for arrival in self.scene.take_shown() {
            ticks().input_to_frame.record(now - arrival);
        }
    }

    /// Accepts no more motion, because the world has failed.
    pub(in crate::tick) fn close_mailboxes(&self, why: &Fault) {
        for drive in &self.drives {
            drive.mailbox.close(why.clone());
        }
    }

    /// The feedback to the driver of a stream.
    pub fn feedback(&mut self, driver: &DriverId, connection: u64) -> Result<Feedback, Fault> {
        let scheduled = self.schedule();
        let d = self
            .drives
            .iter_mut()
            .find(|d| d.id == *driver && d.connection == Some(connection))
            .ok_or_else(|| fenced(&driver.name))?;
        d.collect(&mut self.scene, scheduled, Instant::now());
        Ok(d.feedback(&self.scene))
    }

    /// Ends a stream. `kept`: it was lost, and the driver may come back.
    pub fn close_drive(&mut self, driver: &DriverId, connection: u64, kept: bool) {
        let Some(d) = self
            .drives
            .iter_mut()
            .find(|d| d.id == *driver && d.connection == Some(connection))
        else {
            return; // another stream with this name has taken over
        };
        let now = Instant::now();
        if kept {
            d.lost(now);
        }
        self.release_leases(driver, now);
        if !kept {
            self.end_drive(driver, "given back");
        }
    }

    pub(super) fn end_drive(&mut self, driver: &DriverId, why: &str) {
        let Some(i) = self.drives.iter().position(|d| d.id == *driver) else {
            return;
        };
        let drive = self.drives.remove(i);
        self.touch();
        drive.mailbox.close(fenced(&driver.name));
        self.mailboxes.remove(driver);
        for slot in drive.slots.iter().filter(|s| s.player.is_some()) {
            // A drive without motion has nothing to stop.
            let player = slot.player.and_then(|key| self.scene.player(key));
            let stops = player.is_none_or(|p| p.takeover.is_none());
            if let Some(key) = slot.player {
                let _ = self.scene.apply(SceneInput::Unfollow(key)); // never refused
            }
            if stops {
                self.hold(&slot.figure);
            }
            self.event(
                &slot.figure,
                EventKind::DriveEnded(format!("{}: {why}", driver.name)),
            );
        }
    }

    /// Gives up the figures of drivers that did not come back.
    pub(in crate::tick) fn expire_drives(&mut self, now: Instant) {
        while let Some(driver) = self
            .drives
            .iter()
            .find(|d| d.expires.is_some_and(|at| at <= now))
            .map(|d| d.id.clone())
        {
            self.end_drive(&driver, "its time is over");
        }
        self.use_leases(now);
        self.expire_leases(now);
    }

    /// Hands the desired motion of this tick to driven figures.
    pub(in crate::tick) fn sample_motion(&mut self) {
        self.expire_undriven();
        for player in self.scene.sample(self.lost()) {
            let slots = self.drives.iter().flat_map(|d| &d.slots);
            let mut ended = slots.filter(|s| s.player == Some(player));
            if let Some(figure) = ended.next().map(|s| s.figure.clone()) {
                self.detach(&figure, "the lease was handed over");
            }
        }
        self.tell_new_beginnings();
    }
}
