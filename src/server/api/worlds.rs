//! `WorldService`.

use super::{Api, answer, caller, client, first_grants, origin};
use crate::access::roles::Role;
use crate::repeats::to_the_end;
use crate::tick::hosted_world::{HostedWorld, StepRequest};
use sinew_wire::convert::{count, new_id, page, world, world_name};
use sinew_wire::pb::{self, world_service_server::WorldService};
use sinew_wire::status::Fault;
use sinew_wire::types::{WorldInfo, WorldUpdate};
use std::sync::Arc;
use tokio::sync::oneshot;
use tonic::{Request, Response, Status};

/// Most ticks of one `StepWorld`: two minutes and three quarters at 60 Hz.
const MAX_STEPS: u32 = 10_000;

impl Api {
    async fn on_world<T>(
        &self,
        request: &Request<T>,
        name: &str,
        f: impl FnOnce(&mut HostedWorld) -> Result<WorldInfo, Fault> + Send + 'static,
    ) -> Result<pb::World, Fault> {
        let handle = self.world(request, "name", name)?;
        let (api, origin) = (self.clone(), origin(request));
        to_the_end(async move {
            let info = handle.call(origin, f).await?;
            api.stored(&handle).await?;
            Ok(world::world_out(&info))
        })
        .await
    }
}

#[tonic::async_trait]
impl WorldService for Api {
    async fn create_world(
        &self,
        request: Request<pb::CreateWorldRequest>,
    ) -> Result<Response<pb::CreateWorldResponse>, Status> {
        self.once(request, |api, request| async move {
            let owner = client(&request);
            let caller = caller(&request)?.clone();
            let r = request.into_inner();
            let id = new_id("world_id", &r.world_id)?;
            caller.check_new_name("world_id", id.as_deref())?;
            if let (Some(id), Some(persistence)) = (&id, &api.persistence) {
                persistence.check(id)?;
            }
            let settings = world::settings(r.world)?;
            let owner = (owner, first_grants(&caller));
            let info = if r.validate_only {
                api.worlds.would_create(id, settings, r.paused, &owner.0)?
            } else {
                let handle = api.worlds.create(id, settings, r.paused, owner)?;
                api.written(&handle).await?;
                handle.info()
            };
            Ok(pb::CreateWorldResponse {
                world: Some(world::world_out(&info)),
            })
        })
        .await
    }

    async fn get_world(
        &self,
        request: Request<pb::GetWorldRequest>,
    ) -> Result<Response<pb::GetWorldResponse>, Status> {
        answer(
            self.world(&request, "name", &request.get_ref().name)
                .map(|handle| pb::GetWorldResponse {
                    world: Some(world::world_out(&handle.info())),
                }),
        )
    }

    async fn list_worlds(
        &self,
        request: Request<pb::ListWorldsRequest>,
    ) -> Result<Response<pb::ListWorldsResponse>, Status> {
        let r = request.get_ref();
        let caller = caller(&request).map_err(super::refusal)?;
        let items = self
            .worlds
            .list()
            .into_iter()
            .filter(|w| self.sees(caller, w))
            .map(|w| (w.id.to_string(), w));
        answer(page("worlds", items, r.page_size, &r.page_token).map(
            |(handles, next_page_token)| {
                pb::ListWorldsResponse {
                    worlds: handles
                        .iter()
                        .map(|h| world::world_out(&h.info()))
                        .collect(),
                    next_page_token,
                }
            },
        ))
    }

    async fn update_world(
        &self,
        request: Request<pb::UpdateWorldRequest>,
    ) -> Result<Response<pb::UpdateWorldResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let w = r
                .world
                .as_ref()
                .ok_or_else(|| Fault::invalid("world", "must be given"))?;
            let handle = self.world(&request, "world.name", &w.name)?;
            let update = world::update(w, r.update_mask.as_ref())?;
            let (etag, only) = (w.etag.clone(), r.validate_only);
            let change = move |s: &mut HostedWorld| {
                world::check_etag(&s.info(), &etag)?;
                if only {
                    s.would_update(update)
                } else {
                    s.update(update)
                }
            };
            let world = if only {
                world::world_out(&handle.call(origin(&request), change).await?)
            } else {
                self.on_world(&request, &w.name, change).await?
            };
            Ok(pb::UpdateWorldResponse { world: Some(world) })
        };
        answer(result.await)
    }

    async fn delete_world(
        &self,
        request: Request<pb::DeleteWorldRequest>,
    ) -> Result<Response<pb::DeleteWorldResponse>, Status> {
        self.once(request, |api, request| async move {
            let caller = caller(&request)?;
            let r = request.get_ref();
            let name = world_name("name", &r.name)?;
            // A world in quarantine exists only on disk, and so do its grants, so only claims count.
            let quarantined = api
                .persistence
                .as_ref()
                .is_some_and(|p| p.check(name).is_err());
            match &api.persistence {
                Some(persistence) if quarantined => {
                    caller.check_claim(Role::Owner, name)?;
                    persistence.deleted_in_quarantine(name).await?;
                }
                _ => {
                    let handle = api.enter(caller, name)?;
                    world::check_etag(&handle.info(), &r.etag)?;
                    api.delete(&handle, caller.principal()).await?;
                }
            }
            Ok(pb::DeleteWorldResponse {})
        })
        .await
    }

    async fn pause_world(
        &self,
        request: Request<pb::PauseWorldRequest>,
    ) -> Result<Response<pb::PauseWorldResponse>, Status> {
        let name = request.get_ref().name.clone();
        answer(
            self.on_world(&request, &name, HostedWorld::pause)
                .await
                .map(|w| pb::PauseWorldResponse { world: Some(w) }),
        )
    }

    async fn resume_world(
        &self,
        request: Request<pb::ResumeWorldRequest>,
    ) -> Result<Response<pb::ResumeWorldResponse>, Status> {
        let name = request.get_ref().name.clone();
        answer(
            self.on_world(&request, &name, HostedWorld::resume)
                .await
                .map(|w| pb::ResumeWorldResponse { world: Some(w) }),
        )
    }

    async fn step_world(
        &self,
        request: Request<pb::StepWorldRequest>,
    ) -> Result<Response<pb::StepWorldResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let r = request.get_ref();
            let handle = api.world(&request, "name", &r.name)?;
            let left = count("tick_count", r.tick_count, 1, 1, MAX_STEPS)?;
            let (tx, rx) = oneshot::channel();
            let slot = Arc::new(std::sync::Mutex::new(Some(tx)));
            let (waits, fills) = (slot.clone(), slot);
            let lock = |m: &std::sync::Mutex<Option<oneshot::Sender<_>>>| {
                m.lock()
                    .unwrap_or_else(std::sync::PoisonError::into_inner)
                    .take()
            };
            handle.send(origin(&request), move |s| {
                s.step(StepRequest {
                    left,
                    done: Box::new(move |result| {
                        if let Some(tx) = lock(&fills) {
                            let _ = tx.send(result); // the client may be gone
                        }
                    }),
                    abandoned: Box::new(move || {
                        waits
                            .lock()
                            .unwrap_or_else(std::sync::PoisonError::into_inner)
                            .as_ref()
                            .is_none_or(oneshot::Sender::is_closed)
                    }),
                });
            })?;
            let _in_use = handle.usage.begin();
            let snapshot = handle.answer(rx).await?;
            Ok(pb::StepWorldResponse {
                tick: snapshot.tick as i64,
                time_s: snapshot.time,
                state_hash: snapshot.hash as i64,
            })
        })
        .await
    }

    async fn set_world_speed(
        &self,
        request: Request<pb::SetWorldSpeedRequest>,
    ) -> Result<Response<pb::SetWorldSpeedResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            self.world(&request, "name", &r.name)?;
            let update = WorldUpdate {
                speed: Some(world::speed("speed", r.speed)?),
                ..Default::default()
            };
            self.on_world(&request, &r.name, |s| s.update(update)).await
        };
        answer(
            result
                .await
                .map(|w| pb::SetWorldSpeedResponse { world: Some(w) }),
        )
    }
}
