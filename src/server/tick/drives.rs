//! The live drivers of figures: at most one driver per figure, kept for a grace time after it has gone.

use super::scene::{PlayerKey, PlayoutWindow, Scene};
use crate::ingest::jitter_buffer::{BufferedFrame, Counts};
use crate::ingest::mailbox::{DriverId, Mailbox};
use crate::ingest::time::{ScheduledTime, SourceTime};
use sinew_wire::status::Fault;
use sinew_wire::types::{DriveSettings, Feedback, FigureFeedback, MotionSample};
use std::cell::Cell;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// One driven figure.
#[derive(Debug)]
pub struct DrivenFigure {
    /// Last part of the figure's name.
    pub figure: String,
    /// The player of its motion; `None` once the figure was removed or taken away.
    pub player: Option<PlayerKey>,
}

/// One driver with its figures.
#[derive(Debug)]
pub struct DriverSession {
    /// The driver.
    pub id: DriverId,
    /// The stream that may send; `None` for pushes.
    pub connection: Option<u64>,
    /// Settings.
    pub settings: DriveSettings,
    /// Figures.
    pub slots: Vec<DrivenFigure>,
    /// When the figures are given up; `None` while a stream is open.
    pub expires: Option<Instant>,
    /// The mailbox in which its motion waits for the next tick.
    pub mailbox: Arc<Mailbox>,
}

impl DriverSession {
    /// A drive without motion.
    pub fn new(
        id: DriverId,
        connection: Option<u64>,
        settings: DriveSettings,
        slots: Vec<DrivenFigure>,
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

    /// Notes that the driver is present, by a stream or a push.
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

    /// Whether it drives exactly these figures.
    pub fn drives(&self, figures: &[String]) -> bool {
        self.slots.len() == figures.len()
            && self.slots.iter().zip(figures).all(|(s, f)| s.figure == *f)
    }

    /// Whether it drives this figure.
    pub fn has(&self, figure: &str) -> bool {
        self.slots
            .iter()
            .any(|s| s.figure == figure && s.player.is_some())
    }

    /// The fault for others that want one of its figures.
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

    /// Takes the motion that arrived since the last tick, in order of sequence: calls in the same tick overtake each
    /// other on their way. `scheduled` returns the scheduled time of an arrival.
    pub fn collect(
        &mut self,
        scene: &mut Scene,
        scheduled: impl Fn(Instant) -> ScheduledTime,
        now: Instant,
    ) {
        let taken = self.mailbox.take();
        if taken.pushed {
            self.touch(None, now);
        }
        let mut samples: Vec<((ScheduledTime, Instant), MotionSample)> = taken
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
                let Some(key) = self.slots[f.slot].player else {
                    continue;
                };
                let Some(player) = scene.player(key) else {
                    continue;
                };
                let mut posture = f.posture;
                if !f.has_root {
                    let newest = player.buffer.newest_posture();
                    posture.root_position = newest.root_position;
                    posture.root_rotation = newest.root_rotation;
                }
                let frame = BufferedFrame {
                    sequence: sample.sequence,
                    source: SourceTime(sample.source_ns),
                    posture,
                    velocity: f.velocity,
                    planted: f.planted,
                    guess: Cell::default(),
                    arrival,
                };
                let before = player.buffer.counts();
                let begins = scene.take_frame(key, frame, at);
                count_dropped(before, scene.player(key).map(|p| p.buffer.counts()));
                if begins || anew.is_some() {
                    anew = Some(sample.sequence);
                }
            }
        }
        if let Some(sequence) = anew {
            self.mailbox.begin_anew(sequence);
        }
    }

    /// The feedback to the driver.
    pub fn feedback(&self, scene: &Scene) -> Feedback {
        let (received, refused) = self.mailbox.counts();
        Feedback {
            driver: self.id.name.to_string(),
            tick: scene.world().tick(),
            received_sequence: received,
            refused,
            figures: self
                .slots
                .iter()
                .filter_map(|s| Some((s, scene.player(s.player?)?)))
                .map(|(slot, s)| {
                    let counts = s.buffer.counts();
                    let applied = s.buffer.applied();
                    FigureFeedback {
                        figure: slot.figure.clone(),
                        applied_sequence: applied.map_or(-1, |a| a.0),
                        applied_source_ns: applied.map_or(0, |a| a.1.0),
                        buffered: s.buffer.buffered(),
                        delay: s.buffer.delay()
                            + s.window.as_ref().map_or(0.0, |w| w.length + w.behind()),
                        jitter: s.buffer.jitter(),
                        supply: s.buffer.supply(),
                        ticks: counts.ticks,
                        late: counts.late,
                        stale: counts.stale,
                        overflow: counts.overflow,
                        resyncs: counts.resyncs,
                        behind: s.buffer.behind()
                            + s.window.as_ref().map_or(0.0, PlayoutWindow::behind),
                        window: s.window.as_ref().map_or(0.0, |w| w.length),
                    }
                })
                .collect(),
        }
    }
}

/// Counts the frames that a buffer has dropped because of a new one. The buffer does not count them itself, because it
/// also runs in replays, which must not count.
fn count_dropped(before: Counts, after: Option<Counts>) {
    let after = after.unwrap_or(before);
    for (reason, dropped) in [
        ("stale", after.stale - before.stale),
        ("overflow", after.overflow - before.overflow),
        ("late", after.late - before.late),
    ] {
        if dropped > 0 {
            metrics::counter!("sinew_motion_frames_dropped_total", "reason" => reason)
                .increment(dropped);
        }
    }
}
