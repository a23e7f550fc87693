//! What figures are asked to do: clips, and drives that stream.

use super::Shard;
use crate::server::engine::{self, Clip, Drive as Motion};
use crate::server::ingest::jitter_buffer::{JitterBuffer, Now};
use crate::server::ingest::mailbox::{Mailbox, fenced};
use crate::server::tick::drives::{Drive, Slot, Window};
use crate::wire::status::Fault;
use crate::wire::types::{DriveOpen, EventKind, Feedback, Place, Playback};
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
    ) -> Result<f64, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        self.not_driven(figure)?;
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
    pub fn stop(&mut self, figure: &str) -> Result<(), Fault> {
        self.working()?;
        self.member(figure)?;
        self.not_driven(figure)?;
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
        let driver = match (open.driver.as_str(), connection) {
            ("", None) => "push".to_owned(),
            ("", Some(_)) => loop {
                let name = format!("driver-{}", self.next_driver);
                self.next_driver += 1;
                if self.drives.iter().all(|d| d.driver != name) {
                    break name;
                }
            },
            (name, _) => name.to_owned(),
        };
        for figure in &open.figures {
            if let Some(other) = self
                .drives
                .iter()
                .find(|d| d.driver != driver && d.has(figure))
            {
                return Err(other.controlled(figure, now));
            }
        }
        if let Some(d) = self.drives.iter_mut().find(|d| d.driver == driver) {
            if d.drives(&open.figures) {
                d.touch(connection, now); // the same driver comes back: its motion goes on
                return Ok(Arc::clone(&d.mailbox));
            }
            self.end_drive(&driver, "drives other figures now");
        }
        let mut slots = Vec::with_capacity(open.figures.len());
        for figure in &open.figures {
            self.hold(figure);
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
            for slot in &mut slots {
                let f = slot.key.and_then(|k| self.world.figure(k));
                if let (Some(f), Some(window)) = (f, &mut slot.window) {
                    window.lead_in(&f.target().next.posture);
                }
            }
        }
        let settings = open.settings.clone();
        let drive = Drive::new(driver.clone(), connection, settings, slots, now);
        let mailbox = Arc::clone(&drive.mailbox);
        mailbox.publish(drive.feedback(self.world.tick()));
        self.mailboxes.insert(Arc::clone(&mailbox));
        self.drives.push(drive);
        for figure in &open.figures {
            self.event(figure, EventKind::DriveBegan(driver.clone()));
        }
        Ok(mailbox)
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
                    let detail = format!("{}: {}", drive.driver, why.reason());
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

    /// Takes no more motion: the world has failed.
    pub(in crate::server::tick) fn close_mailboxes(&self, why: &Fault) {
        for drive in &self.drives {
            drive.mailbox.close(why.clone());
        }
    }

    /// What the driver of a stream is told.
    pub fn feedback(&mut self, driver: &str, connection: u64) -> Result<Feedback, Fault> {
        let (tick, scheduled) = (self.world.tick(), self.schedule());
        let d = self
            .drives
            .iter_mut()
            .find(|d| d.driver == driver && d.connection == Some(connection))
            .ok_or_else(|| fenced(driver))?;
        d.collect(scheduled, Instant::now());
        Ok(d.feedback(tick))
    }

    /// A stream ended: `kept` if it was lost and the driver may come back.
    pub fn close_drive(&mut self, driver: &str, connection: u64, kept: bool) {
        let Some(d) = self
            .drives
            .iter_mut()
            .find(|d| d.driver == driver && d.connection == Some(connection))
        else {
            return; // someone with this name has taken over
        };
        if kept {
            d.lost(Instant::now());
        } else {
            self.end_drive(driver, "given back");
        }
    }

    pub(super) fn end_drive(&mut self, driver: &str, why: &str) {
        let Some(i) = self.drives.iter().position(|d| d.driver == driver) else {
            return;
        };
        let drive = self.drives.remove(i);
        self.touch();
        drive.mailbox.close(fenced(driver));
        self.mailboxes.remove(driver);
        for slot in drive.slots.iter().filter(|s| s.key.is_some()) {
            self.hold(&slot.figure);
            self.event(
                &slot.figure,
                EventKind::DriveEnded(format!("{driver}: {why}")),
            );
        }
    }

    /// Gives up the figures of drivers that did not come back.
    pub(in crate::server::tick) fn expire_drives(&mut self, now: Instant) {
        while let Some(driver) = self
            .drives
            .iter()
            .find(|d| d.expires.is_some_and(|at| at <= now))
            .map(|d| d.driver.clone())
        {
            self.end_drive(&driver, "its time is over");
        }
    }

    /// Hands the desired motion of this tick to driven figures.
    pub(in crate::server::tick) fn sample_motion(&mut self) {
        let now = self.now();
        for drive in &mut self.drives {
            for slot in &mut drive.slots {
                let Some(key) = slot.key else { continue };
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
