//! The mailbox in which the desired motion of one drive waits for the next tick.
//!
//! Motion from the network is checked, converted and left here at once, without waiting for the world. The world's
//! thread takes all of it at the start of a tick. The allowance of the driver bounds how much can wait, and drives
//! share no queue, so a driver that floods its mailbox harms no other.

use super::admission::{Admission, FRAME_BURST, FRAMES_PER_SECOND};
use sinew_wire::status::Fault;
use sinew_wire::types::{Feedback, MotionSample};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};

/// Attempts of the world's thread to open a mailbox while a sender has it open. It never waits for a sender: anything
/// that it misses now it gets in the next tick.
const ATTEMPTS: usize = 100;

/// A batch that waits.
#[derive(Debug)]
pub struct Delivery {
    /// Arrival time.
    pub arrival: Instant,
    /// Its content.
    pub samples: Vec<MotionSample>,
}

/// The content of a mailbox, for the world's thread.
#[derive(Debug, Default)]
pub struct MailboxContent {
    /// Batches in the order in which they came.
    pub deliveries: Vec<Delivery>,
    /// Whether the driver pushed since the last time.
    pub pushed: bool,
}

/// The identity of a drive: no other drive can have the same.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct DriverId {
    /// Its owner.
    pub principal: Arc<str>,
    /// The name that the driver chose.
    pub name: Arc<str>,
}

impl std::fmt::Display for DriverId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.principal, self.name)
    }
}

#[derive(Debug)]
struct MailboxInner {
    /// The stream that may send; `None` for pushes.
    stream: Option<u64>,
    /// Why no more motion is accepted.
    closed: Option<Fault>,
    allowance: Admission,
    waiting: MailboxContent,
    /// Desired postures that wait.
    postures: usize,
    received: i64,
    refused: u64,
    /// Tokens of the leases with which it was opened.
    tokens: Vec<String>,
    /// Figures that were taken from the driver, by their place in its header.
    taken_away: Vec<bool>,
    /// Feedback to the driver that can be given without asking the world.
    feedback: Arc<Feedback>,
}

/// The mailbox of one drive.
#[derive(Debug)]
pub struct Mailbox {
    id: DriverId,
    figures: Vec<String>,
    inside: Mutex<MailboxInner>,
}

impl Mailbox {
    /// An empty mailbox of a drive of these figures.
    pub fn new(id: DriverId, figures: Vec<String>, stream: Option<u64>, now: Instant) -> Self {
        let feedback = Feedback {
            driver: id.name.to_string(),
            received_sequence: -1,
            ..Feedback::default()
        };
        let inside = MailboxInner {
            stream,
            closed: None,
            allowance: Admission::new(figures.len(), now),
            waiting: MailboxContent::default(),
            postures: 0,
            received: -1,
            refused: 0,
            tokens: Vec::new(),
            taken_away: vec![false; figures.len()],
            feedback: Arc::new(feedback),
        };
        Self {
            id,
            figures,
            inside: Mutex::new(inside),
        }
    }

    /// The driver.
    pub fn driver(&self) -> &DriverId {
        &self.id
    }

    /// Driven figures, last parts of their names.
    pub fn figures(&self) -> &[String] {
        &self.figures
    }

    fn inside(&self) -> MutexGuard<'_, MailboxInner> {
        // No change is left half done by a panic.
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// As [`Mailbox::inside`], without waiting for another holder.
    fn glance(&self) -> Option<MutexGuard<'_, MailboxInner>> {
        for _ in 0..ATTEMPTS {
            match self.inside.try_lock() {
                Ok(inside) => return Some(inside),
                Err(TryLockError::Poisoned(e)) => return Some(e.into_inner()),
                Err(TryLockError::WouldBlock) => std::hint::spin_loop(),
            }
        }
        None
    }

    /// Asks for the allowance of a batch with `postures` desired postures, before it is converted.
    ///
    /// # Errors
    /// The batch came too fast, or too much is waiting. It is counted.
    pub fn admit(&self, postures: usize, now: Instant) -> Result<(), Fault> {
        let mut inside = self.inside();
        let room = (FRAME_BURST as usize) * self.figures.len();
        let refused = if inside.postures + postures.max(1) > room {
            Some(Duration::from_millis(20)) // the next tick takes it; a stopped clock is looked at every 50 ms
        } else {
            inside.allowance.admit(postures, now).err()
        };
        let Some(retry) = refused else { return Ok(()) };
        inside.refused += 1;
        Err(Fault::Exhausted {
            limit: "frames_per_second",
            value: FRAMES_PER_SECOND as u64,
            message: format!("desired motion of driver {:?} came too fast", self.id.name),
            retry: Some(retry),
        })
    }

    /// Leaves a batch, from a stream or a push.
    ///
    /// # Errors
    /// The drive has ended, or another stream has it.
    pub fn deliver(
        &self,
        stream: Option<u64>,
        samples: Vec<MotionSample>,
        now: Instant,
    ) -> Result<(), Fault> {
        let mut inside = self.inside();
        if let Some(why) = &inside.closed {
            return Err(why.clone());
        }
        if stream.is_some() && stream != inside.stream {
            return Err(self.fenced());
        }
        // Frames for a figure that was taken away are refused one by one.
        let mut asked = samples.iter().flat_map(|s| &s.figures);
        if let Some(f) = asked.find(|f| inside.taken_away[f.slot]) {
            return Err(Fault::Aborted {
                reason: "CONTROL_FENCED",
                message: format!(
                    "figure {:?} was taken from {:?}",
                    self.figures[f.slot], self.id.name
                ),
            });
        }
        let newest = samples.iter().map(|s| s.sequence).max();
        inside.received = inside.received.max(newest.unwrap_or(-1));
        let postures: usize = samples.iter().map(|s| s.figures.len()).sum();
        inside.postures += postures.max(1);
        inside.waiting.pushed |= stream.is_none();
        inside.waiting.deliveries.push(Delivery {
            arrival: now,
            samples,
        });
        Ok(())
    }

    /// The answer to a stream that no longer drives.
    pub fn fenced(&self) -> Fault {
        fenced(&self.id.name)
    }

    /// Tokens of the leases with which the drive was opened.
    pub fn tokens(&self) -> Vec<String> {
        self.inside().tokens.clone()
    }

    /// Replaces them.
    pub fn keep_tokens(&self, tokens: &[String]) {
        self.inside().tokens = tokens.to_vec();
    }

    /// Accepts no more motion for a figure, given by its place in the header.
    pub fn fence(&self, slot: usize) {
        self.inside().taken_away[slot] = true;
    }

    /// Why the drive has ended, if it has.
    pub fn ended(&self) -> Option<Fault> {
        self.inside().closed.clone()
    }

    /// Takes the waiting motion, without waiting for a sender. For the world's thread.
    pub fn take(&self) -> MailboxContent {
        self.glance()
            .map_or_else(MailboxContent::default, |mut i| i.empty())
    }

    /// Lets another stream send from now on; `None`: no stream.
    pub fn hand_to(&self, stream: Option<u64>) {
        self.inside().stream = stream;
    }

    /// Accepts no more motion; senders are told why. The first reason stands.
    pub fn close(&self, why: Fault) {
        let mut inside = self.inside();
        inside.empty();
        inside.closed.get_or_insert(why);
    }

    /// Largest sequence that was taken (−1 if none), and batches that were refused.
    pub fn counts(&self) -> (i64, u64) {
        let inside = self.inside();
        (inside.received, inside.refused)
    }

    /// The driver's sequence has started again and is at `sequence` now.
    pub fn begin_anew(&self, sequence: i64) {
        self.inside().received = sequence;
    }

    /// Publishes the state of the drive after a tick. For the world's thread.
    pub fn publish(&self, feedback: Feedback) {
        if let Some(mut inside) = self.glance() {
            inside.feedback = Arc::new(feedback);
        }
    }

    /// The state of the drive after the last tick, with what was received and refused until now.
    pub fn feedback(&self) -> Feedback {
        let (feedback, received, refused) = {
            let inside = self.inside();
            (inside.feedback.clone(), inside.received, inside.refused)
        };
        Feedback {
            received_sequence: received,
            refused,
            ..(*feedback).clone()
        }
    }
}

impl MailboxInner {
    fn empty(&mut self) -> MailboxContent {
        self.postures = 0;
        std::mem::take(&mut self.waiting)
    }
}

/// The fault of a driver that no longer has a drive.
pub fn fenced(driver: &str) -> Fault {
    Fault::Aborted {
        reason: "CONTROL_FENCED",
        message: format!("{driver:?} has given up its figures or drives by another stream"),
    }
}

/// The mailboxes of one world, by driver.
#[derive(Debug, Default)]
pub struct Mailboxes(Mutex<HashMap<DriverId, Arc<Mailbox>>>);

impl Mailboxes {
    fn held(&self) -> MutexGuard<'_, HashMap<DriverId, Arc<Mailbox>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The mailbox of a driver, if it drives exactly these figures.
    pub fn of(&self, driver: &DriverId, figures: &[String]) -> Option<Arc<Mailbox>> {
        let found = self.held().get(driver).cloned()?;
        (found.figures() == figures).then_some(found)
    }

    /// Adds a mailbox.
    pub fn insert(&self, mailbox: Arc<Mailbox>) {
        self.held().insert(mailbox.driver().clone(), mailbox);
    }

    /// Accepts no more motion from any driver.
    pub fn close_all(&self, why: &Fault) {
        for mailbox in self.held().values() {
            mailbox.close(why.clone());
        }
    }

    /// Removes the mailbox of a driver.
    pub fn remove(&self, driver: &DriverId) {
        self.held().remove(driver);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn me() -> DriverId {
        DriverId {
            principal: "user:me".into(),
            name: "me".into(),
        }
    }

    fn sample(sequence: i64) -> MotionSample {
        MotionSample {
            sequence,
            source_ns: sequence,
            figures: Vec::new(),
        }
    }

    #[test]
    fn batches_wait_in_order_and_an_old_stream_is_fenced() {
        let now = Instant::now();
        let m = Mailbox::new(me(), vec!["a".into()], Some(1), now);
        m.deliver(Some(1), vec![sample(0)], now).unwrap();
        m.deliver(Some(1), vec![sample(1)], now).unwrap();
        m.hand_to(Some(2));
        assert_eq!(
            m.deliver(Some(1), vec![sample(2)], now),
            Err(fenced("me")),
            "another stream has it"
        );
        m.deliver(Some(2), vec![sample(3)], now).unwrap();
        let taken = m.take();
        let sequences: Vec<i64> = taken
            .deliveries
            .iter()
            .flat_map(|d| &d.samples)
            .map(|s| s.sequence)
            .collect();
        assert_eq!((sequences, taken.pushed), (vec![0, 1, 3], false));
        assert!(m.take().deliveries.is_empty());
        m.deliver(None, vec![sample(4)], now).unwrap();
        assert!(m.take().pushed);
        m.close(Fault::Draining);
        m.close(fenced("me"));
        assert_eq!(
            m.deliver(Some(2), vec![sample(5)], now),
            Err(Fault::Draining)
        );
        assert_eq!(m.feedback().received_sequence, 4);
    }

    #[test]
    fn a_world_whose_thread_never_looks_does_not_collect_motion_without_bound() {
        let start = Instant::now();
        let m = Mailbox::new(me(), vec!["a".into()], None, start);
        let figure = sinew_wire::types::FigureSample {
            slot: 0,
            posture: sinew_physics::body::Posture::default(),
            has_root: false,
            velocity: None,
            planted: None,
        };
        let full = || MotionSample {
            figures: vec![figure.clone()],
            ..sample(0)
        };
        let mut taken = 0;
        for second in 0..10 {
            let now = start + Duration::from_secs(second);
            for _ in 0..1000 {
                if m.admit(1, now).is_ok() {
                    m.deliver(None, vec![full()], now).unwrap();
                    taken += 1;
                }
            }
        }
        assert_eq!(taken, FRAME_BURST as usize);
        assert_eq!(m.feedback().refused, 10_000 - taken as u64);
    }
}
