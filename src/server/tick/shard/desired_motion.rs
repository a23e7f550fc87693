//! What figures are asked to do: clips, and drives that stream.

use super::Shard;
use crate::server::engine::{self, Clip, Drive as Motion};
use crate::server::ingest::jitter_buffer::{JitterBuffer, Now};
use crate::server::ingest::mailbox::{DriverId, Mailbox, fenced};
use crate::server::telemetry::metrics::ticks;
use crate::server::tick::drives::{Drive, Slot, Window};
use crate::wire::status::Fault;
use crate::wire::types::{ControlKey, DriveOpen, EventKind, Feedback, Place, Playback};
use std::sync::Arc;
use std::time::Instant;

impl Shard {
    pub(super) fn not_driven(&self, figure: &str) -> Result<(), Fault> {
        match self.drives.iter().find(|d| d.has(figure)) {
            Some(d) => Err(d.controlled(figure, Instant::now())),
            None => Ok(()),
        }
    }

    /// Lets a figure play a clip. Returns the world time of its start.
    pub fn play(
        &mut self,
        figure: &str,
        clip_id: &str,
        clip: Arc<Clip>,
        p: Playback,
        who: &ControlKey,
    ) -> Result<f64, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        self.may_direct(figure, who)?;
        let now = self.world.time();
        let begin = p.start.unwrap_or(now);
        let m = &mut self.members[i];
        let f = self
            .world
            .figure_mut(m.key)
            .expect("members are in the world");
        let place = p
            .place
            .unwrap_or_else(|| engine::place_of(&f.state().posture));
        let state = engine::first_state(&clip, place);
        // A figure that is put into the clip is in motion at once; one that stands comes into it by the clip's lead-in,
        // and one that moves comes to a stand before that.
        let playback = engine::playback(clip, begin, p.speed, p.looped, (place, !p.reset));
        let mut start = playback.start;
        if p.reset {
            f.set_drive(Motion::Clip(playback));
            engine::reset(&mut self.world, m.key, state)?;
            self.changed = true;
        } else {
            start = f.play(playback, p.place.is_some(), now);
        }
        m.clip = Some(clip_id.to_owned());
        Ok(start)
    }

    pub(super) fn hold(&mut self, figure: &str) {
        let Ok(i) = self.member(figure) else { return };
        let time = self.world.time();
        let m = &mut self.members[i];
        m.clip = None;
        if let Some(f) = self.world.figure_mut(m.key) {
            // It finishes its step and stands.
            f.stop(time);
        }
    }

    /// Lets a figure finish its step and stand, or hold the posture that is asked of it now if it stands already.
    pub fn stop(&mut self, figure: &str, who: &ControlKey) -> Result<(), Fault> {
        self.working()?;
        self.member(figure)?;
        self.may_direct(figure, who)?;
        self.hold(figure);
        Ok(())
    }

    /// Begins or takes up a drive. `connection` is the stream that will send; `None` for a push. Returns where its
    /// motion is to be left.
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
            let other = |d: &&Drive| d.id != id && d.has(figure);
            let other = self.drives.iter().find(other);
            if let Some(other) = other.filter(|_| self.takeover(figure).is_none()) {
                return Err(other.controlled(figure, now));
            }
        }
        if let Some(d) = self.drives.iter_mut().find(|d| d.id == id) {
            if d.drives(&open.figures) && who.tokens == d.mailbox.tokens() {
                d.touch(connection, now); // the same driver comes back: its motion goes on
                let mailbox = Arc::clone(&d.mailbox);
                self.use_leases(now);
                return Ok(mailbox);
            }
            self.end_drive(&id, "drives other figures now");
        }
        let mut slots = Vec::with_capacity(open.figures.len());
        for figure in &open.figures {
            let takeover = self.takeover(figure);
            match takeover {
                // What it does goes on until there is motion to go over to.
                Some(_) => self
                    .leases
                    .of_mut(figure)
                    .into_iter()
                    .for_each(|l| l.takeover = None),
                None => self.hold(figure),
            }
            let key = self.members[self.member(figure)?].key;
            let f = self.world.figure(key).expect("members are in the world");
            let stand = engine::standing(f.body(), Place::default());
            let length = open.settings.window.unwrap_or(self.limits.window);
            let window = (length > 0.0).then(|| Window::new(f.body(), length));
            slots.push(Slot {
                figure: figure.clone(),
                key: Some(key),
                body: f.body().clone(),
                window,
                takeover,
                buffer: JitterBuffer::new(
                    open.settings.clone(),
                    self.world.dt(),
                    Arc::clone(f.body()),
                    f.target().next.clone(),
                    stand,
                ),
            });
        }
        if !open.settings.reset {
            for slot in slots.iter_mut().filter(|s| s.takeover.is_none()) {
                let f = slot.key.and_then(|k| self.world.figure(k));
                if let (Some(f), Some(window)) = (f, &mut slot.window) {
                    window.lead_in(&f.target().next.posture);
                }
            }
        }
        let settings = open.settings.clone();
        let drive = Drive::new(id.clone(), connection, settings, slots, now);
        let mailbox = Arc::clone(&drive.mailbox);
        mailbox.keep_tokens(&who.tokens);
        mailbox.publish(drive.feedback(self.world.tick()));
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

    /// What a driver is called.
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

    /// How long the figure goes over to the motion of a new holder of its lease, s, if it is to.
    fn takeover(&self, figure: &str) -> Option<f64> {
        self.leases.of(figure)?.takeover
    }

    /// Takes what drivers have sent since the last tick.
    pub(in crate::server::tick) fn collect_motion(&mut self) {
        let now = Instant::now();
        let scheduled = self.schedule();
        for drive in &mut self.drives {
            drive.collect(&scheduled, now);
        }
        self.tell_new_beginnings();
    }

    /// World time now, with what the clock has left out.
    fn now(&self) -> Now {
        Now {
            time: self.world.time(),
            lost: self.clock.lost() * self.world.dt(),
        }
    }

    /// The scheduled time of an arrival. While the clock stands still so does scheduled time.
    fn schedule(&self) -> impl Fn(Instant) -> f64 + use<> {
        let (now, dt) = (self.now(), self.world.dt());
        let clock = (!self.paused).then(|| self.clock.clone());
        move |arrival| {
            let since = clock.as_ref().map_or(0.0, |c| c.since_deadline(arrival));
            now.time + now.lost + since * dt
        }
    }

    /// Tells that streams began anew, and why.
    fn tell_new_beginnings(&mut self) {
        let mut told = Vec::new();
        for drive in &mut self.drives {
            for slot in drive.slots.iter_mut().filter(|s| s.key.is_some()) {
                if let Some(why) = slot.buffer.take_notice() {
                    let detail = format!("{}: {}", drive.id.name, why.reason());
                    told.push((slot.figure.clone(), detail));
                }
            }
        }
        for (figure, detail) in told {
            self.event(&figure, EventKind::DriveResynced(detail));
        }
    }

    /// Lets drivers who push know the state of their drives without asking for it.
    pub(in crate::server::tick) fn publish_feedback(&self) {
        let tick = self.world.tick();
        for drive in self.drives.iter().filter(|d| d.connection.is_none()) {
            drive.mailbox.publish(drive.feedback(tick));
        }
    }

    /// Notes that a frame has been published: how long the motion that it shows took to get there.
    pub(in crate::server::tick) fn note_shown(&mut self) {
        let now = Instant::now();
        let slots = self.drives.iter_mut().flat_map(|d| &mut d.slots);
        for arrival in slots.filter_map(|s| s.buffer.take_shown()) {
            ticks().input_to_frame.record(now - arrival);
        }
    }

    /// Takes no more motion: the world has failed.
    pub(in crate::server::tick) fn close_mailboxes(&self, why: &Fault) {
        for drive in &self.drives {
            drive.mailbox.close(why.clone());
        }
    }

    /// What the driver of a stream is told.
    pub fn feedback(&mut self, driver: &DriverId, connection: u64) -> Result<Feedback, Fault> {
        let (tick, scheduled) = (self.world.tick(), self.schedule());
        let d = self
            .drives
            .iter_mut()
            .find(|d| d.id == *driver && d.connection == Some(connection))
            .ok_or_else(|| fenced(&driver.name))?;
        d.collect(scheduled, Instant::now());
        Ok(d.feedback(tick))
    }

    /// A stream ended: `kept` if it was lost and the driver may come back.
    pub fn close_drive(&mut self, driver: &DriverId, connection: u64, kept: bool) {
        let Some(d) = self
            .drives
            .iter_mut()
            .find(|d| d.id == *driver && d.connection == Some(connection))
        else {
            return; // someone with this name has taken over
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
        for slot in drive.slots.iter().filter(|s| s.key.is_some()) {
            // One whose motion was never there has nothing to stop.
            if slot.takeover.is_none() {
                self.hold(&slot.figure);
            }
            self.event(
                &slot.figure,
                EventKind::DriveEnded(format!("{}: {why}", driver.name)),
            );
        }
    }

    /// Gives up the figures of drivers that did not come back.
    pub(in crate::server::tick) fn expire_drives(&mut self, now: Instant) {
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

    /// Lets figures go over to the motion of those who took them over, where it is there.
    fn take_over(&mut self, now: Now) {
        for d in 0..self.drives.len() {
            for s in 0..self.drives.get(d).map_or(0, |d| d.slots.len()) {
                let slot = &mut self.drives[d].slots[s];
                let Some(blend) = slot.takeover.filter(|_| slot.key.is_some()) else {
                    continue;
                };
                if !slot.buffer.is_due(now) {
                    continue;
                }
                slot.takeover = None;
                let (figure, key) = (slot.figure.clone(), slot.key);
                // The one before ends here. It came earlier, so it lies before this one.
                let drives = self.drives.len();
                self.detach(&figure, "the lease was handed over");
                let d = d - (drives - self.drives.len());
                let f = key.and_then(|k| self.world.figure_mut(k));
                if let Some(f) = f {
                    self.drives[d].slots[s].join(f, now, blend);
                }
                return self.take_over(now);
            }
        }
    }

    /// Hands the desired motion of this tick to driven figures.
    pub(in crate::server::tick) fn sample_motion(&mut self) {
        let now = self.now();
        self.take_over(now);
        for drive in &mut self.drives {
            for slot in &mut drive.slots {
                // Until its own motion is there the one before goes on.
                let Some(key) = slot.key.filter(|_| slot.takeover.is_none()) else {
                    continue;
                };
                if slot.window.is_some() {
                    let Some(f) = self.world.figure_mut(key) else {
                        continue;
                    };
                    if let Some(state) = slot.feed(now, f, drive.settings.reset) {
                        let _ = engine::reset(&mut self.world, key, state);
                    }
                    continue;
                }
                let Some((pair, reset)) = slot.sample(now) else {
                    continue;
                };
                let state = pair.now.state();
                // First: a reset follows a stop that is still being planned.
                if let Some(f) = self.world.figure_mut(key) {
                    f.set_drive(Motion::External(Box::new(pair)));
                }
                if reset {
                    // What came over the wire was checked there, so there is nothing left to refuse.
                    let _ = engine::reset(&mut self.world, key, state);
                }
            }
        }
        self.tell_new_beginnings();
    }
}
