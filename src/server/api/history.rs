//! `HistoryService`.

use super::past_frames::{self, PastPart};
use super::permit::Permit;
use super::{Api, answer, caller, client, long, origin, refusal};
use crate::progress::WorkProgress;
use crate::shares::ClientKey;
use crate::tick::hosted_world::StateOrigin as Past;
use crate::tick::journal::{Journal, JournalSegment};
use crate::tick::replay::{Replay, ReplayError};
use crate::tick::scene::Scene;
use crate::workers::Turn;
use crate::worlds::WorldHandle;
use sinew_wire::convert::{not_negative, state, world};
use sinew_wire::pb;
use sinew_wire::pb::history_service_server::HistoryService;
use sinew_wire::status::Fault;
use std::sync::Arc;
use tonic::{Request, Response, Status};

/// Attempts to find a state while others restore the world.
const SEEKS: usize = 4;

/// The past of a world, if any is kept.
pub(super) fn journal(handle: &WorldHandle) -> Result<Arc<Journal>, Fault> {
    handle.journal.clone().ok_or(Fault::Expired {
        asked: -1,
        oldest: -1,
        newest: -1,
    })
}

/// The first and last tick of a request; the ends of the held past where the request names none.
fn span(journal: &Journal, first: Option<i64>, last: Option<i64>) -> Result<(u64, u64), Fault> {
    let (oldest, newest) = journal.held().unwrap_or_default();
    let tick = |field, tick: Option<i64>, default| match tick {
        Some(tick) => not_negative(field, tick),
        None => Ok(default),
    };
    let first = tick("first_tick", first, oldest)?;
    let last = tick("last_tick", last, newest)?;
    if first > last {
        let why = format!("must be at most last_tick ({last}), got {first}");
        return Err(Fault::invalid("first_tick", why));
    }
    Ok((first, last))
}

/// The scene at the end of this part of the past, or after tick `until` of it.
fn reached(past: &[Arc<JournalSegment>], until: u64, turn: &Turn) -> Result<Scene, Fault> {
    let mut replay = Replay::of(past)?;
    let done = replay.through_past(past, until, &mut |_| !turn.stop());
    match done {
        Ok(()) => Ok(replay.scene),
        Err(ReplayError::Stopped) => Err(Turn::gone()),
        Err(why) => Err(Fault::DataLoss {
            reason: "REPLAY_DIFFERS",
            message: why.to_string(),
        }),
    }
}

impl Api {
    /// The state of a world after a tick of its past.
    pub(super) async fn at_tick(
        &self,
        client: &ClientKey,
        handle: &WorldHandle,
        tick: u64,
    ) -> Result<Scene, Fault> {
        let _in_use = handle.usage.begin();
        let past = journal(handle)?.past(tick, tick)?;
        let work = move |turn: &Turn| reached(&past, tick, turn);
        self.simulations.run(client, work).await
    }
}

#[tonic::async_trait]
impl HistoryService for Api {
    async fn get_history(
        &self,
        request: Request<pb::GetHistoryRequest>,
    ) -> Result<Response<pb::GetHistoryResponse>, Status> {
        let get = || {
            let handle = self.world(&request, "name", &request.get_ref().name)?;
            let held = handle.journal.as_ref().and_then(|j| j.held());
            let Some((oldest, newest)) = held else {
                return Ok(pb::GetHistoryResponse {
                    oldest_tick: -1,
                    newest_tick: -1,
                    events: Vec::new(),
                });
            };
            let marks = handle.history().marks(oldest, newest);
            Ok(pb::GetHistoryResponse {
                oldest_tick: oldest as i64,
                newest_tick: newest as i64,
                events: marks.iter().map(state::event_out).collect(),
            })
        };
        answer(get())
    }

    type ReadHistoryStream = long::Messages<pb::ReadHistoryResponse>;

    async fn read_history(
        &self,
        request: Request<pb::ReadHistoryRequest>,
    ) -> Result<Response<Self::ReadHistoryStream>, Status> {
        let start = || {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let r = request.get_ref();
            let handle = self.world(&request, "name", &r.name)?;
            let view = state::view(r.view.as_ref())?;
            let journal = journal(&handle)?;
            let ticks = span(&journal, r.first_tick, r.last_tick)?;
            let part = PastPart {
                world: handle.id.clone(),
                past: journal.past(ticks.0, ticks.1)?,
                ticks,
                view,
            };
            let progress = WorkProgress::default();
            let told = progress.watch();
            let permit = Permit::new(self, &handle, &caller, &[]);
            let pool = self.simulations.clone();
            let work = |out| async move {
                let read = move |turn: &Turn| past_frames::read(&part, out, &progress, turn);
                pool.run(&client, read).await
            };
            Ok(long::LongStream {
                caller,
                permit: Some(permit),
                told,
                progress: None::<fn(f64) -> pb::ReadHistoryResponse>,
                last: |rest| rest,
            }
            .run_with(work, self.stopping.clone()))
        };
        start().map(Response::new).map_err(refusal)
    }

    async fn seek_world(
        &self,
        request: Request<pb::SeekWorldRequest>,
    ) -> Result<Response<pb::SeekWorldResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let (client, origin) = (client(&request), origin(&request));
            let handle = api.world(&request, "name", &request.get_ref().name)?;
            let tick = not_negative("tick", request.get_ref().tick)?;
            // One at a time, because another seek would change the past in which this one looks.
            let _alone = handle.seeking.lock().await;
            for _ in 0..SEEKS {
                let journal = journal(&handle)?;
                let begun_anew = journal.begun_anew();
                let scene = api.at_tick(&client, &handle, tick).await?;
                let cleared = handle.clone();
                let found = handle
                    .call(origin.clone(), move |s| {
                        // The world has another past now, so this state no longer belongs to it.
                        if journal.begun_anew() != begun_anew {
                            return Ok(None);
                        }
                        let info = s.restore(scene, Past::OwnPast)?;
                        // Viewers can no longer resume, because the frames held are from another time.
                        cleared.history().go_back(tick);
                        Ok(Some(info))
                    })
                    .await?;
                if let Some(info) = found {
                    return Ok(pb::SeekWorldResponse {
                        world: Some(world::world_out(&info)),
                    });
                }
            }
            Err(Fault::Aborted {
                reason: "WORLD_RESTORED",
                message: "others restored the world again and again meanwhile".to_owned(),
            })
        })
        .await
    }

    async fn replay_world(
        &self,
        request: Request<pb::ReplayWorldRequest>,
    ) -> Result<Response<pb::ReplayWorldResponse>, Status> {
        let result = async {
            let client = client(&request);
            caller(&request)?;
            let r = request.get_ref();
            let handle = self.world(&request, "name", &r.name)?;
            let threads = match r.thread_count {
                0 => 1,
                n @ 1..=64 => n as usize,
                n => {
                    let why = format!("must be in 0…64, got {n}");
                    return Err(Fault::invalid("thread_count", why));
                }
            };
            let _in_use = handle.usage.begin();
            let journal = journal(&handle)?;
            let (first, last) = span(&journal, r.first_tick, r.last_tick)?;
            let past = journal.past(first, last)?;
            let work = move |turn: &Turn| replayed(&past, last, threads, turn);
            self.simulations.run(&client, work).await
        };
        answer(result.await)
    }
}

fn replayed(
    past: &[Arc<JournalSegment>],
    last: u64,
    threads: usize,
    turn: &Turn,
) -> Result<pb::ReplayWorldResponse, Fault> {
    let mut replay = Replay::of(past)?.with_threads(threads);
    let first = replay.scene.world().tick();
    let done = replay.through_past(past, last, &mut |_| !turn.stop());
    let difference = match done {
        Ok(()) => None,
        Err(ReplayError::Stopped) => return Err(Turn::gone()),
        Err(ReplayError::Differs {
            tick,
            expected,
            found,
        }) => Some(pb::ReplayDifference {
            tick: tick as i64,
            recorded_state_hash: expected as i64,
            replayed_state_hash: found as i64,
            detail: String::new(),
        }),
        Err(ReplayError::Record { tick, why }) => Some(pb::ReplayDifference {
            tick: tick as i64,
            detail: why.to_owned(),
            ..Default::default()
        }),
    };
    Ok(pb::ReplayWorldResponse {
        first_tick: first as i64,
        last_tick: replay.scene.world().tick() as i64,
        compared_tick_count: replay.compared as i64,
        difference,
    })
}
