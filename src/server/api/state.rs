//! `StateService`.

use super::late::LateFrames;
use super::permit::Permit;
use super::watching::PastStart;
use super::{Api, answer, caller, client, refusal, watching};
use sinew_wire::convert::state;
use sinew_wire::frame::{roster, world_frame};
use sinew_wire::pb::{self, state_service_server::StateService};
use sinew_wire::status::Fault;
use sinew_wire::types::{Snapshot, ViewSpec};
use tonic::{Request, Response, Status};

/// Checks that the figures of a view are in the world.
fn check(view: &[String], snapshot: &Snapshot) -> Result<(), Fault> {
    for figure in view {
        if !snapshot.roster.iter().any(|e| e.figure == *figure) {
            return Err(Fault::not_found(
                "figure",
                format!("worlds/{}/figures/{figure}", snapshot.world),
            ));
        }
    }
    Ok(())
}

fn response(snapshot: &Snapshot, view: &ViewSpec) -> pb::GetWorldFrameResponse {
    pb::GetWorldFrameResponse {
        roster: Some(roster(snapshot, view)),
        frame: Some(world_frame(snapshot, view)),
    }
}

#[tonic::async_trait]
impl StateService for Api {
    async fn get_world_frame(
        &self,
        request: Request<pb::GetWorldFrameRequest>,
    ) -> Result<Response<pb::GetWorldFrameResponse>, Status> {
        let result = || {
            let r = request.get_ref();
            let handle = self.world(&request, "world", &r.world)?;
            let view = state::view(r.view.as_ref())?;
            let snapshot = match r.tick {
                None => handle.latest(),
                Some(tick) => handle.history().at(tick)?,
            };
            check(&view.figures, &snapshot)?;
            Ok(response(&snapshot, &view))
        };
        answer(result())
    }

    type WatchWorldStream = watching::FrameStream;

    async fn watch_world(
        &self,
        request: Request<pb::WatchWorldRequest>,
    ) -> Result<Response<Self::WatchWorldStream>, Status> {
        let watch = || {
            let r = request.get_ref();
            let handle = self.world(&request, "world", &r.world)?;
            let view = state::view(r.view.as_ref())?;
            check(&view.figures, &handle.outlet.latest.borrow())?;
            let place = self.viewers.take(client(&request))?;
            let permit = Permit::new(self, &handle, caller(&request)?, &[]);
            let resumed = r
                .resume_tick
                .map(|tick| (tick, handle.history().after(tick)));
            let late = match &resumed {
                // A tick that is not held as a frame is simulated again, as far back as the past reaches.
                Some((tick, Err(expired))) => {
                    if *tick < -1 || handle.journal.is_none() {
                        return Err(expired.clone());
                    }
                    Some(LateFrames::after(self, client(&request), &handle, *tick)?)
                }
                _ => None,
            };
            let channel = handle
                .hub
                .channel(&view, &handle.outlet.latest, client(&request))?;
            let past = match (late, resumed) {
                (Some(late), _) => PastStart::Late(Box::new(late)),
                (None, Some((_, Ok(held)))) => watching::held(&handle, &view, held),
                (None, _) => watching::held(&handle, &view, Vec::new()),
            };
            Ok(watching::frames(
                handle,
                (&view, channel),
                past,
                permit.ending(self.stopping.clone()),
                place,
            ))
        };
        watch().map(Response::new).map_err(refusal)
    }

    type WatchEventsStream = watching::Events;

    async fn watch_events(
        &self,
        request: Request<pb::WatchEventsRequest>,
    ) -> Result<Response<Self::WatchEventsStream>, Status> {
        let watch = || {
            let r = request.get_ref();
            let handle = self.world(&request, "world", &r.world)?;
            let filter = state::event_filter(r)?;
            check(&filter.figures, &handle.outlet.latest.borrow())?;
            let place = self.viewers.take(client(&request))?;
            let permit = Permit::new(self, &handle, caller(&request)?, &[]);
            Ok(watching::events(
                handle,
                filter,
                permit.ending(self.stopping.clone()),
                place,
            ))
        };
        watch().map(Response::new).map_err(refusal)
    }
}
