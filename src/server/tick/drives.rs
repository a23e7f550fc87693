//! Who drives which figure live: at most one driver per figure, kept for a grace time when the driver is gone.

use crate::server::engine::{self, Figure, FigureKey, LivePlayback};
use crate::server::ingest::jitter_buffer::{Due, Frame, JitterBuffer, Now};
use crate::server::ingest::mailbox::{DriverId, Mailbox};
use crate::sim::body::State;
use crate::sim::motion::TargetPair;
use crate::sim::plan::StreamPlan;
use crate::sim::plan::stream::RATE;
use crate::wire::status::Fault;
use crate::wire::types::{DriveSettings, Feedback, FigureFeedback, MotionSample, Supply};
use std::cell::Cell;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Samples of standing before a stream begins, for a figure that is not put into it.
const LEAD_IN: usize = 6;

/// One driven figure.
#[derive(Debug)]
pub struct Slot {
    /// Last part of the figure's name.
    pub figure: String,
    /// The figure; `None` once it was removed.
    pub key: Option<FigureKey>,
    /// Its desired motion.
    pub buffer: JitterBuffer,
    /// Its body, for a new window.
    pub body: Arc<crate::sim::body::Body>,
    /// The window that prepares its motion, if there is one.
    pub window: Option<Window>,
    /// It takes the figure over from another drive, over so many seconds, once its own motion is there.
    pub takeover: Option<f64>,
}

/// A window between the buffer and its figure.
#[derive(Debug)]
pub struct Window {
    /// Its length, s.
    pub length: f64,
    /// The stream until its figure begins to follow it.
    waiting: Option<Box<LivePlayback>>,
    /// The figure comes into the stream from what it does, whatever the driver asked for.
    begun: bool,
}

impl Window {
    /// A window of `length` seconds for a figure with this body.
    pub fn new(body: &Arc<crate::sim::body::Body>, length: f64) -> Self {
        let motion = StreamPlan::new(Arc::clone(body), length);
        Self {
            length: motion.window(),
            waiting: Some(Box::new(LivePlayback {
                motion,
                offset: 0.0,
            })),
            begun: false,
        }
    }
}

/// One driver with its figures.
#[derive(Debug)]
pub struct Drive {
    /// Who drives.
    pub id: DriverId,
    /// The stream that may send; `None` for pushes.
    pub connection: Option<u64>,
    /// Settings.
    pub settings: DriveSettings,
    /// Figures.
    pub slots: Vec<Slot>,
    /// When the figures are given up; `None` while a stream is open.
    pub expires: Option<Instant>,
    /// Where its motion waits for the next tick.
    pub mailbox: Arc<Mailbox>,
}

impl Drive {
    /// A drive without motion yet.
    pub fn new(
        id: DriverId,
        connection: Option<u64>,
        settings: DriveSettings,
        slots: Vec<Slot>,
        now: Instant,
    ) -> Self {
        let figures = slots.iter().map(|s| s.figure.clone()).collect();
        let mailbox = Mailbox::new(id.clone(), figures, connection, now);
        let mut drive = Self {
            id,
            connection,
            settings,
            slots,
            expires: None,
            mailbox: Arc::new(mailbox),
        };
        drive.touch(connection, now);
        drive
    }

    /// Notes that the driver is there: by a stream or by a push.
    pub fn touch(&mut self, connection: Option<u64>, now: Instant) {
        if connection.is_some() || self.connection.is_none() {
            self.connection = connection;
            self.mailbox.hand_to(connection);
        }
        self.expires = self
            .connection
            .is_none()
            .then(|| now + Duration::from_secs_f64(self.settings.grace));
    }

    /// Notes that the stream was lost: the figures are kept for the grace time.
    pub fn lost(&mut self, now: Instant) {
        self.connection = None;
        self.mailbox.hand_to(None);
        self.expires = Some(now + Duration::from_secs_f64(self.settings.grace));
    }

    /// True if it drives exactly these figures.
    pub fn drives(&self, figures: &[String]) -> bool {
        self.slots.len() == figures.len()
            && self.slots.iter().zip(figures).all(|(s, f)| s.figure == *f)
    }

    /// True if it drives this figure.
    pub fn has(&self, figure: &str) -> bool {
        self.slots
            .iter()
            .any(|s| s.figure == figure && s.key.is_some())
    }

    /// The fault that others get who want one of its figures.
    pub fn controlled(&self, figure: &str, now: Instant) -> Fault {
        let mut facts = vec![("controller", self.id.name.to_string())];
        if let Some(at) = self.expires {
            let left = at.saturating_duration_since(now).as_millis();
            facts.push(("lease_expires_ms", left.to_string()));
        }
        Fault::Precondition {
            reason: "FIGURE_CONTROLLED",
            message: format!("figure {figure:?} is driven by {:?}", self.id.name),
            facts,
        }
    }

    /// Takes what came since the last tick, in order of sequence: calls that meet in one tick overtake each other on
    /// their way. `scheduled` tells the scheduled time of an arrival.
    pub fn collect(&mut self, scheduled: impl Fn(Instant) -> f64, now: Instant) {
        let taken = self.mailbox.take();
        if taken.pushed {
            self.touch(None, now);
        }
        let mut samples: Vec<((f64, Instant), MotionSample)> = taken
            .deliveries
            .into_iter()
            .flat_map(|d| {
                let at = (scheduled(d.arrival), d.arrival);
                d.samples.into_iter().map(move |s| (at, s))
            })
            .collect();
        samples.sort_by_key(|(_, s)| s.sequence);
        let mut anew = None;
        for ((at, arrival), sample) in samples {
            for f in sample.figures {
                let slot = &mut self.slots[f.slot];
                let mut posture = f.posture;
                if !f.has_root {
                    let newest = slot.buffer.newest_posture();
                    posture.root_position = newest.root_position;
                    posture.root_rotation = newest.root_rotation;
                }
                let frame = Frame {
                    sequence: sample.sequence,
                    source_ns: sample.source_ns,
                    posture,
                    velocity: f.velocity,
                    planted: f.planted,
                    guess: Cell::default(),
                    arrival,
                };
                if slot.buffer.push(frame, at) || anew.is_some() {
                    anew = Some(sample.sequence);
                }
            }
        }
        if let Some(sequence) = anew {
            self.mailbox.begin_anew(sequence);
        }
    }

    /// What the driver is told.
    pub fn feedback(&self, tick: u64) -> Feedback {
        let (received, refused) = self.mailbox.counts();
        Feedback {
            driver: self.id.name.to_string(),
            tick,
            received_sequence: received,
            refused,
            figures: self
                .slots
                .iter()
                .filter(|s| s.key.is_some())
                .map(|s| {
                    let counts = s.buffer.counts();
                    let applied = s.buffer.applied();
                    FigureFeedback {
                        figure: s.figure.clone(),
                        applied_sequence: applied.map_or(-1, |a| a.0),
                        applied_source_ns: applied.map_or(0, |a| a.1),
                        buffered: s.buffer.buffered(),
                        delay: s.buffer.delay() + s.window.as_ref().map_or(0.0, |w| w.length),
                        jitter: s.buffer.jitter(),
                        supply: s.buffer.supply(),
                        ticks: counts.ticks,
                        late: counts.late,
                        stale: counts.stale,
                        overflow: counts.overflow,
                        resyncs: counts.resyncs,
                        behind: s.buffer.behind(),
                        window: s.window.as_ref().map_or(0.0, |w| w.length),
                    }
                })
                .collect(),
        }
    }
}

impl Window {
    /// Continues from what is asked of the figure now: a stream that begins elsewhere is moved there.
    pub fn lead_in(&mut self, posture: &crate::sim::body::Posture) {
        self.begun = true;
        if let Some(live) = &mut self.waiting {
            for _ in 0..LEAD_IN {
                live.motion.push(posture, Some([true; 2]));
            }
        }
    }
}

impl Slot {
    /// Takes a figure over from another drive, in the middle of what it does, over `blend` seconds.
    pub fn join(&mut self, figure: &mut Figure, now: Now, blend: f64) {
        self.buffer.begin_from(figure.target().next.clone(), blend);
        let Some(window) = &mut self.window else {
            return; // the buffer goes over by itself
        };
        // The stream that the figure follows goes on with what comes now.
        let length = window.length;
        match figure.stream_mut().filter(|l| l.motion.window() == length) {
            Some(live) => {
                live.motion.join(blend);
                window.waiting = None;
                window.begun = true;
            }
            None => {
                // There is none like it: it finishes its step, and is led in from a stand.
                figure.stop(now.time);
                window.lead_in(&figure.target().next.posture);
            }
        }
    }

    /// Feeds the window with what is due in the tick that begins `now`; once there is enough of it, the figure
    /// follows. Returns the state that the figure is to be put into, if its driver asked for that.
    pub fn feed(&mut self, now: Now, figure: &mut Figure, reset: bool) -> Option<State> {
        let window = self.window.as_mut()?;
        let length = window.length;
        let time = now.time;
        if self.buffer.take_break() {
            // What the window holds has no continuation.
            if window.waiting.is_none() {
                figure.stop(time);
            } else {
                let begun = window.begun;
                *window = Window::new(&self.body, length);
                if begun {
                    window.lead_in(&figure.target().next.posture);
                }
            }
            return None;
        }
        if window.waiting.is_none() && figure.stream_mut().is_none() {
            // It stopped in a silence: a stream that comes again begins from where the figure is.
            if !self.buffer.has_news() {
                self.buffer.feed(now, (RATE, length), |_| ());
                return None;
            }
            *window = Window::new(&self.body, length);
            window.lead_in(&figure.target().next.posture);
        }
        let waits = window.waiting.is_some();
        let live = match &mut window.waiting {
            Some(waiting) => waiting,
            None => figure.stream_mut()?,
        };
        let motion = &mut live.motion;
        let mut silent = false;
        let (head, next) = self.buffer.feed(now, (RATE, length), |due| match due {
            Due::Sample(posture, planted) => motion.push(posture, planted),
            Due::Silence => silent = true,
        })?;
        if silent {
            // It finishes its step and stands.
            if !waits {
                figure.stop(time);
            }
            return None;
        }
        live.offset = head - length + (motion.fed() - next) as f64 / RATE - time;
        let begins = waits && live.stream_time(time) >= 0.0;
        let mut live = window.waiting.take_if(|_| begins)?;
        live.motion.advance(live.stream_time(time) + 1.0 / RATE);
        let first = live.motion.sample(live.stream_time(time));
        figure.set_drive(engine::Drive::Live(live));
        (reset && !window.begun).then_some(first.state())
    }

    /// The desired motion over the tick that begins `now`, and whether the figure is to be put into it at once.
    pub fn sample(&mut self, now: Now) -> Option<(TargetPair, bool)> {
        let pair = self.buffer.sample(now)?;
        Some((pair, self.buffer.resets_now()))
    }

    /// Sequence and source time that act now.
    pub fn applied(&self) -> Option<(i64, i64)> {
        match self.buffer.supply() {
            Supply::None | Supply::Waiting => None,
            _ => self.buffer.applied(),
        }
    }
}
