//! The player of live motion for a figure: its jitter buffer and, if the motion is prepared, its window.
//!
//! A player is part of the world: its effect in a tick depends on the frames that arrived and on the clock that counted
//! the ticks, both of which are recorded. Permission to send it frames is a matter of drives (`drives`).

use super::input::PlayerKey;
use crate::engine::{self, Figure, FigureKey, LivePlayback};
use crate::ingest::jitter_buffer::{DueSample, GridEnd, JitterBuffer, Now, Resync, StreamSeam};
use crate::ingest::time::SourceTime;
use serde::{Deserialize, Serialize};
use sinew_physics::body::{Body, Posture, State};
use sinew_physics::motion::TargetPair;
use sinew_physics::plan::StreamPlan;
use sinew_physics::plan::motion_transition::StreamBeginning;
use sinew_physics::plan::stream::RATE;
use sinew_physics::time::{StreamTime, WorldTime};
use sinew_wire::types::Supply;
use std::sync::Arc;

/// Samples of standing before a stream begins, for a figure that is not put into it.
const LEAD_IN: usize = 6;
/// Longest time for which a stream waits for its figure to stand, s: a step or two, and some sway.
const MOST_STOPPING: f64 = 5.0;
/// Samples between two searches for a moment at which to catch up.
const CATCH_UP_STRIDE: i64 = 10;

/// The player of live motion for one figure.
#[derive(Debug, Serialize, Deserialize)]
pub struct Player {
    /// Its number.
    pub key: PlayerKey,
    /// The figure.
    pub figure: FigureKey,
    /// Its desired motion.
    pub buffer: JitterBuffer,
    /// The window that prepares its motion, if there is one.
    pub window: Option<PlayoutWindow>,
    /// Time over which it takes the figure over from another player, s, once its own motion has arrived.
    pub takeover: Option<f64>,
    /// Whether its figure is put into its first desired posture.
    pub reset: bool,
}

/// A window between the buffer and its figure.
#[derive(Debug, Serialize, Deserialize)]
pub struct PlayoutWindow {
    /// Its length, s.
    pub length: f64,
    /// The stream until its figure begins to follow it.
    waiting: Option<Box<LivePlayback>>,
    /// Whether the figure enters the stream from its present motion, whatever the driver asked for.
    begun: bool,
    /// Set while the figure first comes to a stand: when it is no longer awaited.
    stands: Option<WorldTime>,
    /// How far the figure is behind the window, because it was led into a stream that began in motion.
    late: WindowLag,
    /// Samples since the stream fell silent, while its figure does not follow it yet.
    silent: i64,
}

/// Progress on the way into a stream that begins in motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum EntryProgress {
    /// More of it has to arrive, or a plan to be made.
    Waits,
    /// The figure can follow now.
    Begins,
    /// The figure cannot be led into what has arrived.
    Impossible(Resync),
}

/// How far a figure is behind the window of its stream.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct WindowLag {
    /// The lag, s.
    by: f64,
    /// Sample from which on the figure follows the stream itself.
    from: i64,
}

impl WindowLag {
    /// Whether this value is one that a checkpoint could hold.
    fn is_valid(self) -> bool {
        (0.0..=60.0).contains(&self.by) && self.from.unsigned_abs() < 1 << 41
    }
}

/// The time of a stream that is due where its window, of `length` seconds, has been fed up to `fed`. Samples of the
/// stream and of the grid are equally long, but not equally numbered.
fn due_time(motion: &StreamPlan, fed: GridEnd, length: f64) -> StreamTime {
    StreamTime(fed.head.0 - length + (motion.fed() - fed.next) as f64 / RATE)
}

impl PlayoutWindow {
    /// A window of `length` seconds for a figure with this body.
    pub fn new(body: &Arc<Body>, length: f64) -> Self {
        let motion = StreamPlan::new(Arc::clone(body), length);
        Self {
            length: motion.window(),
            waiting: Some(Box::new(LivePlayback {
                motion,
                offset: 0.0,
            })),
            begun: false,
            stands: None,
            late: WindowLag::default(),
            silent: 0,
        }
    }

    /// How far its figure is behind it, s.
    pub fn behind(&self) -> f64 {
        self.late.by
    }

    /// The lag, for a player that takes its figure over.
    pub fn late(&self) -> WindowLag {
        self.late
    }

    /// A window that begins once its figure stands, after a stop requested at world time `time`.
    pub fn after_stop(body: &Arc<Body>, length: f64, time: WorldTime) -> Self {
        Self {
            begun: true,
            stands: Some(time + MOST_STOPPING),
            ..Self::new(body, length)
        }
    }

    /// Whether it still waits for its figure to stand.
    fn waits_for_stand(&mut self, figure: &Figure, time: WorldTime) -> bool {
        let Some(until) = self.stands else {
            return false;
        };
        if time < until && figure.comes_to_stand(time) {
            return true;
        }
        self.stands = None;
        self.lead_in(&figure.target().next.posture);
        false
    }

    /// Leads the figure into a stream that begins in motion: by steps, to a moment of the stream, once enough of it has
    /// arrived, or all of it. The window has been fed up to `fed`.
    fn lead_in_by_steps(
        &mut self,
        figure: &mut Figure,
        fed: GridEnd,
        time: WorldTime,
    ) -> EntryProgress {
        let Some(live) = &mut self.waiting else {
            return EntryProgress::Begins;
        };
        if let Some(found) = figure.take_stream_entry() {
            let Some(way) = found else {
                // Later samples may be within reach.
                return EntryProgress::Impossible(Resync::OutOfReach);
            };
            live.motion = live.motion.led_in(LEAD_IN, &way);
            // The stream begins here, so all of it that is due is the lag. A stream shorter than the window, with the
            // way into it, begins a little later instead.
            let due = due_time(&live.motion, fed, self.length);
            self.late = WindowLag {
                by: due.0.max(0.0),
                from: (LEAD_IN + way.samples.len()) as i64,
            };
            live.align(time, due.min(StreamTime(0.0)));
            return EntryProgress::Begins;
        }
        if figure.plans_stream_entry() {
            return EntryProgress::Waits;
        }
        if !figure.can_be_led() || !live.motion.begins_in_motion(LEAD_IN) {
            return EntryProgress::Begins;
        }
        let needed = StreamBeginning::needed();
        let came: Vec<_> = (live.motion.waiting().skip(LEAD_IN).take(needed)).collect();
        let enough = came.len() == needed;
        if !enough && self.silent == 0 {
            return EntryProgress::Waits;
        }
        if came.len() < StreamBeginning::least() {
            return EntryProgress::Impossible(Resync::TooShort);
        }
        figure.plan_stream_entry(came, time);
        EntryProgress::Waits
    }

    /// Continues from the present desired posture of the figure: a stream that begins elsewhere is moved there.
    fn lead_in(&mut self, posture: &Posture) {
        if let Some(live) = &mut self.waiting {
            for _ in 0..LEAD_IN {
                live.motion.push(posture, Some([true; 2]));
            }
        }
    }
}

impl Player {
    /// Completes a player that was read, by deriving the parts that follow from the body of its figure. Returns whether
    /// a checkpoint could hold it, for this figure in a world with ticks of `dt` seconds.
    pub(super) fn complete(&mut self, figure: &Figure, dt: f64) -> bool {
        let waiting = self.window.as_mut().and_then(|w| w.waiting.as_mut());
        let waits = waiting.is_none_or(|live| live.offset.is_finite() && live.motion.complete());
        let window = self.window.as_ref();
        waits
            && window.is_none_or(|w| {
                let silent = (0..1 << 41).contains(&w.silent);
                let known = (0.0..=2.0).contains(&w.length) && w.late.is_valid() && silent;
                known && w.stands.is_none_or(WorldTime::is_finite)
            })
            && self.takeover.is_none_or(|t| (0.0..=1e3).contains(&t))
            && self.buffer.complete(figure.body(), dt)
    }

    /// How it takes its figure over from the present player, if it can do so in the tick that begins `now`; `None`
    /// while there is no motion.
    pub fn seam(
        &mut self,
        figure: &mut Figure,
        before: Option<&Self>,
        now: Now,
    ) -> Option<StreamSeam> {
        let p = self.buffer.due(now)?;
        let Some(window) = &self.window else {
            return Some(StreamSeam::Nowhere);
        };
        // The stream that the figure follows continues with another motion, in the same window.
        let length = window.length;
        let before = before.filter(|b| b.window.as_ref().is_some_and(|w| w.length == length));
        Some(match before {
            Some(before) if figure.stream_mut().is_some() => {
                self.buffer.seam(p, &before.buffer, RATE)
            }
            _ => StreamSeam::Nowhere,
        })
    }

    /// Takes a figure over from another player, in the middle of its motion, over `blend` seconds.
    ///
    /// * `late`: how far the figure is behind the window of that player.
    pub fn join(
        &mut self,
        figure: &mut Figure,
        now: Now,
        blend: f64,
        seam: StreamSeam,
        late: WindowLag,
    ) {
        self.buffer.begin_from(figure.target().next.clone(), blend);
        let Some(window) = &mut self.window else {
            return; // the buffer blends by itself
        };
        match (seam, figure.stream_mut()) {
            (StreamSeam::Here(entry), Some(live)) => {
                self.buffer.enter(entry);
                live.motion.join(blend);
                window.waiting = None;
                window.begun = true;
                window.late = late;
            }
            _ => {
                // The figure finishes its step, and is led in from a stand.
                figure.stop(now.time);
                *window = PlayoutWindow::after_stop(figure.body(), window.length, now.time);
            }
        }
    }

    /// Feeds the window with the samples due in the tick that begins `now`. Once there are enough of them, the figure
    /// follows. Returns the state into which to put the figure, if its driver asked for that.
    pub fn feed(&mut self, now: Now, figure: &mut Figure) -> Option<State> {
        let reset = self.reset;
        let window = self.window.as_mut()?;
        let length = window.length;
        let time = now.time;
        if self.buffer.take_break() {
            // The samples of the window have no continuation.
            if window.waiting.is_none() {
                figure.stop(time);
            } else if window.begun {
                *window = PlayoutWindow::after_stop(figure.body(), length, time);
            } else {
                *window = PlayoutWindow::new(figure.body(), length);
            }
            return None;
        }
        if window.waiting.is_none() && figure.stream_mut().is_none() {
            // The figure stopped in a silence: a stream that comes again begins from where the figure is.
            if !self.buffer.has_news() {
                self.buffer.feed(now, (RATE, length), |_| ());
                return None;
            }
            *window = PlayoutWindow::after_stop(figure.body(), length, time);
        }
        if window.waits_for_stand(figure, time) {
            self.buffer.feed(now, (RATE, length), |_| ());
            return None;
        }
        let waits = window.waiting.is_some();
        let live = match &mut window.waiting {
            Some(waiting) => waiting,
            None => figure.stream_mut()?,
        };
        let motion = &mut live.motion;
        let (mut given, mut silent) = (0, window.silent);
        let all = length + window.late.by;
        let fed = self.buffer.feed(now, (RATE, all), |due| match due {
            DueSample::Sample(posture, planted) => {
                motion.push(posture, planted);
                (given, silent) = (given + 1, 0);
            }
            DueSample::Guess(posture, planted) => {
                motion.push_guess(posture, planted);
                (given, silent) = (given + 1, 0);
            }
            DueSample::Silence => {
                // A stream that a figure follows is played to its end.
                if !waits {
                    motion.fall_silent();
                }
                silent += 1;
            }
        })?;
        window.silent = if waits { silent } else { 0 };
        let late = &mut window.late;
        let due = fed.next.rem_euclid(CATCH_UP_STRIDE) < given;
        if !waits && due && late.by > 0.0 && motion.taken() >= late.from {
            late.by = (late.by - motion.catch_up(late.by)).max(0.0);
        }
        let at = due_time(motion, fed, length);
        live.align(time, at);
        live.offset -= late.by;
        if !waits {
            let is_over = silent > 0
                && live
                    .motion
                    .ends_at()
                    .is_some_and(|end| end <= live.stream_time(time));
            if is_over {
                // The last posture is one in which it stands, or from which no steps lead to a stand.
                figure.stop(time);
            }
            return None;
        }
        // A stream that fell silent before it filled the window is as long as it will be.
        if live.stream_time(time).0 + window.silent as f64 / RATE < 0.0 {
            return None;
        }
        let start = match window.begun {
            true => window.lead_in_by_steps(figure, fed, time),
            false => EntryProgress::Begins,
        };
        if let EntryProgress::Impossible(why) = start {
            *window = PlayoutWindow::after_stop(figure.body(), length, time);
            self.buffer.note(why);
        }
        let mut live = (window.waiting).take_if(|_| start == EntryProgress::Begins)?;
        live.motion.advance(live.stream_time(time) + 1.0 / RATE);
        let first = live.motion.sample(live.stream_time(time));
        figure.set_drive(engine::Motion::Live(live));
        (reset && !window.begun).then_some(first.state())
    }

    /// The desired motion over the tick that begins `now`, and whether to put the figure into it at once.
    pub fn sample(&mut self, now: Now) -> Option<(Box<TargetPair>, bool)> {
        let pair = self.buffer.sample(now)?;
        Some((pair, self.buffer.resets_now()))
    }

    /// Sequence and source time of the frame in use.
    pub fn applied(&self) -> Option<(i64, SourceTime)> {
        match self.buffer.supply() {
            Supply::None | Supply::Waiting => None,
            _ => self.buffer.applied(),
        }
    }
}
