//! `CheckpointService`.

use super::{Api, answer, caller, client, first_grants, origin};
use crate::access::caller::Caller;
use crate::access::roles::Role;
use crate::checkpoints::{self, KeptCheckpoint};
use crate::shares::ClientKey;
use crate::tick::command::CommandOrigin;
use crate::tick::hosted_world::StateOrigin as Past;
use crate::tick::journal;
use crate::tick::scene::Scene;
use crate::worlds::WorldHandle;
use sinew_physics::world::checkpoint::Capture;
use sinew_wire::convert::checkpoint::{CheckpointInfo, checkpoint_name, checkpoint_out};
use sinew_wire::convert::names::CHECKPOINT;
use sinew_wire::convert::{new_id, not_negative, page, world, world_name};
use sinew_wire::pb::checkpoint_service_server::CheckpointService;
use sinew_wire::pb::{self, fork_world_request, restore_world_request};
use sinew_wire::status::Fault;
use std::sync::Arc;
use std::time::SystemTime;
use tonic::{Request, Response, Status};

/// The source of a requested state.
enum StateSource {
    Kept(Arc<KeptCheckpoint>),
    Data(&'static str, bytes::Bytes),
    Now(Box<Capture>),
    Past(Box<Scene>),
}

fn out(kept: &KeptCheckpoint) -> pb::Checkpoint {
    checkpoint_out(&CheckpointInfo {
        name: (&kept.world, &kept.id),
        tick: kept.tick,
        time: kept.time,
        hash: kept.hash,
        size: kept.bytes.len(),
        created: kept.created,
    })
}

impl Api {
    /// Refuses bytes that are too many for any response.
    fn check_data(&self, bytes: &[u8]) -> Result<(), Fault> {
        let most = self.config.max_response_bytes;
        if bytes.len() as u64 <= most {
            return Ok(());
        }
        Err(Fault::Exhausted {
            limit: "max_response_bytes",
            value: most,
            message: format!("a checkpoint of {} bytes", bytes.len()),
            retry: None,
        })
    }

    /// The bytes for a response, if the request wants them.
    fn data(&self, kept: &KeptCheckpoint, wanted: bool) -> Result<Vec<u8>, Fault> {
        if !wanted {
            return Ok(Vec::new());
        }
        self.check_data(&kept.bytes)?;
        Ok(kept.bytes.clone())
    }

    async fn captured(
        &self,
        (caller, origin): (&Caller, CommandOrigin),
        (field, name): (&str, &str),
    ) -> Result<(Arc<WorldHandle>, Capture), Fault> {
        let handle = self.enter_as(caller, Role::Director, world_name(field, name)?)?;
        let capture = handle.call(origin, |s| s.capture()).await?;
        Ok((handle, capture))
    }

    /// The world of a source. Built on a worker, because that takes long.
    async fn restored(&self, client: &ClientKey, source: StateSource) -> Result<Scene, Fault> {
        let most = self.config.max_clip_bytes;
        let work = move || match source {
            StateSource::Kept(kept) => checkpoints::decode("checkpoint", &kept.bytes),
            StateSource::Data(field, data) if data.len() as u64 > most => Err(Fault::Exhausted {
                limit: "max_clip_bytes",
                value: most,
                message: format!("{field}: {} bytes", data.len()),
                retry: None,
            }),
            StateSource::Data(field, data) => checkpoints::decode(field, &data),
            StateSource::Now(capture) => journal::scene_of(&capture),
            StateSource::Past(scene) => Ok(*scene),
        };
        self.conversions.run(client, move |_| work()).await
    }

    /// A checkpoint, for directors of its world: it contains everything in the world.
    fn kept(&self, caller: &Caller, field: &str, name: &str) -> Result<Arc<KeptCheckpoint>, Fault> {
        let (world, id) = checkpoint_name(field, name)?;
        self.enter_as(caller, Role::Director, world)?;
        self.checkpoints.get(world, id)
    }
}

#[tonic::async_trait]
impl CheckpointService for Api {
    async fn checkpoint_world(
        &self,
        request: Request<pb::CheckpointWorldRequest>,
    ) -> Result<Response<pb::CheckpointWorldResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let (owner, origin) = (client(&request), origin(&request));
            let caller = caller(&request)?.clone();
            let r = request.into_inner();
            let id = new_id("checkpoint_id", &r.checkpoint_id)?.unwrap_or_default();
            let from = (&caller, origin);
            let (handle, capture) = api.captured(from, ("name", &r.name)).await?;
            let (keeper, in_use) = (api.clone(), handle.usage.begin());
            let (created, client) = (SystemTime::now(), owner.clone());
            let work = move || {
                let _in_use = in_use;
                let bytes = checkpoints::encode(&capture)?;
                if r.return_data {
                    keeper.check_data(&bytes)?; // a refused checkpoint is not kept
                }
                let new = KeptCheckpoint {
                    world: handle.id.to_string(),
                    id,
                    tick: capture.tick(),
                    time: capture.tick() as f64 / handle.rate_hz,
                    hash: capture.hash(),
                    bytes,
                    created,
                    owner,
                };
                keeper.checkpoints.keep(new, || keeper.still_there(&handle))
            };
            let kept = api.conversions.run(&client, move |_| work()).await?;
            Ok(pb::CheckpointWorldResponse {
                checkpoint: Some(out(&kept)),
                data: api.data(&kept, r.return_data)?,
            })
        })
        .await
    }

    async fn get_checkpoint(
        &self,
        request: Request<pb::GetCheckpointRequest>,
    ) -> Result<Response<pb::GetCheckpointResponse>, Status> {
        let r = request.get_ref();
        let get = || {
            let kept = self.kept(caller(&request)?, "name", &r.name)?;
            Ok(pb::GetCheckpointResponse {
                checkpoint: Some(out(&kept)),
                data: self.data(&kept, r.return_data)?,
            })
        };
        answer(get())
    }

    async fn list_checkpoints(
        &self,
        request: Request<pb::ListCheckpointsRequest>,
    ) -> Result<Response<pb::ListCheckpointsResponse>, Status> {
        let r = request.get_ref();
        let list = || {
            let handle = self.world(&request, "parent", &r.parent)?;
            let all = self.checkpoints.of_world(&handle.id);
            let items = all.into_iter().map(|k| (k.id.clone(), k));
            let list = CHECKPOINT.name([&handle.id, ""]);
            let (kept, next_page_token) = page(&list, items, r.page_size, &r.page_token)?;
            Ok(pb::ListCheckpointsResponse {
                checkpoints: kept.iter().map(|k| out(k)).collect(),
                next_page_token,
            })
        };
        answer(list())
    }

    async fn delete_checkpoint(
        &self,
        request: Request<pb::DeleteCheckpointRequest>,
    ) -> Result<Response<pb::DeleteCheckpointResponse>, Status> {
        self.once(request, |api, request| async move {
            let (world, id) = checkpoint_name("name", &request.get_ref().name)?;
            api.enter(caller(&request)?, world)?;
            api.checkpoints.remove(world, id)?;
            Ok(pb::DeleteCheckpointResponse {})
        })
        .await
    }

    async fn restore_world(
        &self,
        request: Request<pb::RestoreWorldRequest>,
    ) -> Result<Response<pb::RestoreWorldResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let (client, origin) = (client(&request), origin(&request));
            let caller = caller(&request)?.clone();
            let handle = api.world(&request, "name", &request.get_ref().name)?;
            let r = request.into_inner();
            let source = match r.source {
                Some(restore_world_request::Source::Checkpoint(name)) => {
                    StateSource::Kept(api.kept(&caller, "checkpoint", &name)?)
                }
                Some(restore_world_request::Source::Data(data)) => StateSource::Data("data", data),
                None => return Err(Fault::invalid("source", "must be given")),
            };
            let _in_use = handle.usage.begin();
            let restored = api.restored(&client, source).await?;
            let cleared = handle.clone();
            let info = handle
                .call(origin, move |s| {
                    let info = s.restore(restored, Past::Elsewhere)?;
                    // Viewers can no longer resume, because the frames held are from another time.
                    cleared.history().clear();
                    Ok(info)
                })
                .await?;
            Ok(pb::RestoreWorldResponse {
                world: Some(world::world_out(&info)),
            })
        })
        .await
    }

    async fn fork_world(
        &self,
        request: Request<pb::ForkWorldRequest>,
    ) -> Result<Response<pb::ForkWorldResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let (owner, origin) = (client(&request), origin(&request));
            let caller = caller(&request)?.clone();
            let r = request.into_inner();
            let id = new_id("world_id", &r.world_id)?;
            caller.check_new_name("world_id", id.as_deref())?;
            let source = match r.source {
                Some(fork_world_request::Source::Checkpoint(name)) => {
                    StateSource::Kept(api.kept(&caller, "checkpoint", &name)?)
                }
                Some(fork_world_request::Source::Data(data)) => StateSource::Data("data", data),
                Some(fork_world_request::Source::World(name)) if r.tick.is_some() => {
                    let tick = not_negative("tick", r.tick.unwrap_or_default())?;
                    let of = world_name("world", &name)?;
                    let handle = api.enter_as(&caller, Role::Director, of)?;
                    StateSource::Past(Box::new(api.at_tick(&owner, &handle, tick).await?))
                }
                Some(_) if r.tick.is_some() => {
                    return Err(Fault::invalid("tick", "needs world"));
                }
                Some(fork_world_request::Source::World(name)) => {
                    let from = (&caller, origin);
                    let (_, capture) = api.captured(from, ("world", &name)).await?;
                    StateSource::Now(Box::new(capture))
                }
                None => return Err(Fault::invalid("source", "must be given")),
            };
            let restored = api.restored(&owner, source).await?;
            if let (Some(id), Some(persistence)) = (&id, &api.persistence) {
                persistence.check(id)?;
            }
            let owner = (owner, first_grants(&caller));
            let handle = api.worlds.fork(id, restored, r.paused, owner)?;
            api.written(&handle).await?;
            Ok(pb::ForkWorldResponse {
                world: Some(world::world_out(&handle.info())),
            })
        })
        .await
    }
}
