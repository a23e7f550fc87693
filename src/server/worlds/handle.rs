//! One world, as seen by services that command or query it.

use super::usage::WorldUsage;
use super::waiting::WaitingCommands;
use crate::access::caller::Caller;
use crate::access::grants::Grants;
use crate::durable::store::WorldKey;
use crate::fanout::hub::Hub;
use crate::ingest::mailbox::Mailboxes;
use crate::shares::ClientKey;
use crate::tick::Outlet;
use crate::tick::command::{CommandOrigin, CommandQueue, Refusal, WorldCommand};
use crate::tick::history::FrameHistory;
use crate::tick::hosted_world::HostedWorld;
use crate::tick::journal::Journal;
use crate::tick::scheduler::WorldTicket;
use crate::tick::stage_times::{Percentiles, STAGES};
use sinew_physics::body::Body;
use sinew_wire::status::Fault;
use sinew_wire::types::{ControlInfo, Described, FigureInfo, Snapshot, WorldInfo};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::{oneshot, watch};

/// One world, seen from outside the thread that runs it.
#[derive(Debug)]
pub struct WorldHandle {
    /// Last part of its name.
    pub id: Arc<str>,
    /// The output of that thread.
    pub outlet: Arc<Outlet>,
    /// Its views.
    pub hub: Hub,
    /// Mailboxes in which its drivers leave their motion.
    pub mailboxes: Arc<Mailboxes>,
    /// Its past, if it is kept.
    pub journal: Option<Arc<Journal>>,
    /// Locked while a seek looks for a state of that past.
    pub seeking: tokio::sync::Mutex<()>,
    /// Ends when the world does.
    pub closed: watch::Receiver<()>,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Frames for which viewers were too slow.
    pub dropped: AtomicU64,
    /// Requests that found the queue full.
    pub refused: AtomicU64,
    /// Viewers.
    pub viewers: AtomicI64,
    /// Its last use.
    pub usage: WorldUsage,
    /// The roles of principals in it.
    pub grants: Grants,
    /// Whether it is stored, and where.
    pub stored: watch::Sender<Persisted>,
    /// Its creator.
    pub(super) owner: ClientKey,
    /// Time of the last event about a refused caller.
    pub(super) told_refused: Mutex<Option<Instant>>,
    /// Waiting commands of each client.
    pub(super) waiting: WaitingCommands,
    pub(super) commands: Arc<CommandQueue>,
    pub(super) ticket: WorldTicket,
    /// Whether worlds end because the server does.
    pub(super) ending: Arc<AtomicBool>,
}

/// Whether a world is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Persisted {
    /// Not yet. Changes to the world wait for it.
    Coming,
    /// Under this number, which no other world has had.
    At(WorldKey),
    /// It lives only as long as the server.
    Never,
}

/// Least time between two events that tell of refusals.
const REFUSALS_EVERY: Duration = Duration::from_secs(1);

/// How busy a world is.
#[derive(Clone, Debug)]
pub struct WorldStats {
    /// Last part of its name.
    pub id: String,
    /// Ticks computed, overruns, deadlines left out.
    pub ticks: [u64; 3],
    /// Refused requests.
    pub refused: u64,
    /// Dropped frames.
    pub dropped: u64,
    /// Viewers.
    pub viewers: i64,
    /// p99 of a tick relative to its period at the present speed.
    pub budget_used: f64,
    /// Stages of a tick.
    pub stages: [(&'static str, Percentiles); STAGES.len()],
}

impl WorldHandle {
    /// The client whose share of the worlds it uses.
    pub fn owner(&self) -> &ClientKey {
        &self.owner
    }

    /// Waits until it is known whether and where it is stored.
    ///
    /// # Errors
    /// It ended first.
    pub async fn place(&self) -> Result<Persisted, Fault> {
        let (mut stored, mut closed) = (self.stored.subscribe(), self.closed.clone());
        let known = stored.wait_for(|s| *s != Persisted::Coming);
        tokio::select! {
            biased;
            known = known => known.map(|s| *s).map_err(|_| self.ended()),
            _ = closed.changed() => Err(self.ended()),
        }
    }

    /// Reason why a world has ended, if one is known.
    fn why_ended(&self) -> Option<Fault> {
        let draining = || {
            self.ending
                .load(Ordering::SeqCst)
                .then_some(Fault::Draining)
        };
        self.lost().or_else(draining)
    }

    fn gone(&self) -> Fault {
        self.why_ended().unwrap_or_else(|| self.no_more())
    }

    /// The end of a stream whose world has ended.
    pub fn no_more(&self) -> Fault {
        Fault::not_found("world", format!("worlds/{}", self.id))
    }

    /// The fault of a world whose tick does not end, for which no caller should wait.
    fn lost(&self) -> Option<Fault> {
        self.outlet.lost.borrow().clone()
    }

    /// Waits for an answer of the world, as long as that can give one.
    ///
    /// # Errors
    /// Those of the answer; the world has ended, or its tick does not end.
    pub async fn answer<T>(&self, answer: oneshot::Receiver<Result<T, Fault>>) -> Result<T, Fault> {
        let mut lost = self.outlet.lost.subscribe();
        tokio::select! {
            biased;
            answer = answer => answer.unwrap_or_else(|_| Err(self.ended())),
            // Its sender lives as long as this handle.
            _ = lost.wait_for(Option::is_some) => Err(self.ended()),
        }
    }

    /// The answer to a request that the end of the world interrupted.
    pub fn ended(&self) -> Fault {
        self.why_ended().unwrap_or_else(|| Fault::Aborted {
            reason: "WORLD_ENDED",
            message: format!("world {:?} ended before the request was done", &*self.id),
        })
    }

    /// Sends an event to viewers that a caller was refused, at most once in an interval.
    pub fn tell_refused(&self, caller: &Caller, figure: &str) {
        let now = Instant::now();
        let mut told = self
            .told_refused
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if told.is_some_and(|at| now - at < REFUSALS_EVERY) {
            return;
        }
        *told = Some(now);
        drop(told);
        let origin = CommandOrigin {
            client: caller.order.clone(),
            sequence: 0,
        };
        let (figure, who, call) = (
            figure.to_owned(),
            caller.principal().clone(),
            caller.call.clone(),
        );
        // A full queue has no room for news.
        let _ = self.send(origin, move |s| {
            // A name made up by a stranger is not repeated.
            let figure = if s.figure(&figure).is_ok() {
                figure.as_str()
            } else {
                ""
            };
            s.tell_refused(figure, &who, &call);
        });
    }

    /// Queues something for the start of the next tick.
    ///
    /// # Errors
    /// The queue is full, the client has its share of it, or the world is gone.
    pub fn send(
        &self,
        origin: CommandOrigin,
        action: impl FnOnce(&mut HostedWorld) + Send + 'static,
    ) -> Result<(), Fault> {
        let place = self.waiting.enter(&origin.client)?;
        let command = WorldCommand {
            origin,
            action: Box::new(move |hosted| {
                drop(place);
                action(hosted);
            }),
        };
        self.commands.push(command).map_err(|e| match e {
            Refusal::Full => {
                self.refused.fetch_add(1, Ordering::Relaxed);
                metrics::counter!("sinew_commands_refused_total").increment(1);
                Fault::Exhausted {
                    limit: "command_queue",
                    value: self.waiting.most(),
                    message: format!("requests wait for the next tick of world {:?}", &*self.id),
                    retry: Some(Duration::from_secs_f64((2.0 / self.rate_hz).max(0.01))),
                }
            }
            Refusal::Closed => self.gone(),
        })?;
        self.ticket.wake();
        Ok(())
    }

    /// Does something at the start of the next tick and waits for its result.
    ///
    /// # Errors
    /// Those of `f`; the queue is full; the world is gone.
    pub async fn call<T: Send + 'static>(
        &self,
        origin: CommandOrigin,
        f: impl FnOnce(&mut HostedWorld) -> Result<T, Fault> + Send + 'static,
    ) -> Result<T, Fault> {
        let (tx, rx) = oneshot::channel();
        let _in_use = self.usage.begin();
        self.send(origin, move |hosted| {
            let done = catch_unwind(AssertUnwindSafe(|| f(hosted)));
            match done {
                Ok(result) => hosted.reply(move || {
                    // The caller may have given up; then the answer is not needed.
                    let _ = tx.send(result);
                }),
                Err(panic) => {
                    // The caller learns of it only once others can see that the world has failed.
                    hosted.reply(move || drop(tx));
                    resume_unwind(panic);
                }
            }
        })?;
        let result = self.answer(rx).await?;
        if let Some(journal) = &self.journal {
            journal
                .settled()
                .await
                .map_err(|e| Fault::Storage(e.to_string()))?;
        }
        Ok(result)
    }

    /// The world as it is now. Reading never waits for a tick.
    pub fn info(&self) -> WorldInfo {
        let described = self.outlet.described.borrow().clone();
        let latest = self.latest();
        WorldInfo {
            tick: latest.tick,
            time: latest.time,
            ..described.world.clone()
        }
    }

    /// The latest frame.
    pub fn latest(&self) -> Arc<Snapshot> {
        self.outlet.latest.borrow().clone()
    }

    /// World and figures as of their last change.
    pub fn described(&self) -> Arc<Described> {
        self.outlet.described.borrow().clone()
    }

    fn no_figure(&self, figure: &str) -> Fault {
        Fault::not_found("figure", format!("worlds/{}/figures/{figure}", self.id))
    }

    /// One figure.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn figure(&self, figure: &str) -> Result<FigureInfo, Fault> {
        let described = self.described();
        let found = described.figures.iter().find(|f| f.id == figure);
        let found = found.ok_or_else(|| self.no_figure(figure))?;
        Ok(as_of(&self.latest(), found))
    }

    /// All figures, in the order of creation.
    pub fn figures(&self) -> Vec<FigureInfo> {
        let (described, latest) = (self.described(), self.latest());
        let figures = described.figures.iter();
        figures.map(|f| as_of(&latest, f)).collect()
    }

    /// The controller of a figure.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn control(&self, figure: &str) -> Result<ControlInfo, Fault> {
        let described = self.described();
        let found = described.controls.iter().find(|c| c.figure == figure);
        let mut info = found.cloned().ok_or_else(|| self.no_figure(figure))?;
        let since = described.at.elapsed();
        info.expires_in = info.expires_in.map(|left| left.saturating_sub(since));
        Ok(info)
    }

    /// The body of a figure, and the last part of its name.
    ///
    /// # Errors
    /// There is no figure of that name.
    pub fn body_of(&self, figure: &str) -> Result<(String, Arc<Body>), Fault> {
        let latest = self.latest();
        let i = latest.roster.iter().position(|e| e.figure == figure);
        let i = i.ok_or_else(|| self.no_figure(figure))?;
        Ok((
            latest.roster[i].body.clone(),
            latest.figures[i].body.clone(),
        ))
    }

    /// Frames of the last ticks.
    pub fn history(&self) -> MutexGuard<'_, FrameHistory> {
        let history = self.outlet.history.lock();
        history.unwrap_or_else(PoisonError::into_inner)
    }

    /// How busy it is.
    pub fn stats(&self) -> WorldStats {
        let times = self
            .outlet
            .times
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        let summary = times.summary();
        let speed = self.described().world.settings.pace.speed;
        let load = |a: &AtomicU64| a.load(Ordering::Relaxed);
        WorldStats {
            id: self.id.to_string(),
            ticks: [
                load(&self.outlet.ticks),
                load(&self.outlet.overruns),
                load(&self.outlet.skipped),
            ],
            refused: load(&self.refused),
            dropped: load(&self.dropped),
            viewers: self.viewers.load(Ordering::Relaxed),
            budget_used: summary[STAGES.len() - 1].p99 * 1e-6 * self.rate_hz * speed,
            stages: std::array::from_fn(|i| (STAGES[i], summary[i])),
        }
    }
}

/// A figure as last described, with the values in a frame that change from tick to tick.
fn as_of(latest: &Snapshot, described: &FigureInfo) -> FigureInfo {
    let mut figures = latest.roster.iter().zip(&latest.figures);
    let shown = figures.find(|(entry, _)| entry.index == described.index);
    FigureInfo {
        follows: shown.map_or(described.follows, |(_, f)| f.follows),
        ..described.clone()
    }
}
