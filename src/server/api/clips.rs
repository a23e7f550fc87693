//! `MotionService`: stored clips, playing them, and the unary twin of live driving. The stream itself is in `drive`.

use super::{Api, answer, caller, client, drive, origin, refusal};
use crate::server::access::caller::Caller;
use crate::server::access::roles::{Role, Roles};
use crate::server::library::NewClip;
use crate::wire::convert::{body, clip_name, control, display_name, motion, new_id, page};
use crate::wire::pb::{self, motion_service_server::MotionService};
use crate::wire::status::Fault;
use crate::wire::types::ClipInfo;
use tonic::{Request, Response, Status, Streaming};

/// Whether a caller may see (`Viewer`) or forget (`Owner`) a clip: its own, those that come with the server, and those
/// that its token names.
fn may(caller: &Caller, clip: &ClipInfo, role: Role) -> bool {
    let own = clip.owner.as_ref() == Some(caller.principal());
    let claims = &caller.identity.claims;
    let roles = if claims.name(&clip.id) {
        claims.roles
    } else {
        Roles::default()
    };
    let sees = role == Role::Viewer && (clip.builtin || roles.contain(Role::Creator));
    own || sees || roles.contain(role)
}

/// A clip that the caller may see; any other is one that there is not.
pub(super) fn seen(api: &Api, caller: &Caller, id: &str) -> Result<ClipInfo, Fault> {
    let info = api.clips.info(id)?;
    if may(caller, &info, Role::Viewer) {
        return Ok(info);
    }
    Err(Fault::not_found("clip", format!("clips/{id}")))
}

#[tonic::async_trait]
impl MotionService for Api {
    async fn create_clip(
        &self,
        request: Request<pb::CreateClipRequest>,
    ) -> Result<Response<pb::CreateClipResponse>, Status> {
        let result = async {
            let client = client(&request);
            let caller = caller(&request)?.clone();
            let r = request.into_inner();
            let id = new_id("clip_id", &r.clip_id)?;
            caller.check_new_name("clip_id", id.as_deref())?;
            let known = !caller.identity.is_anonymous();
            let new = NewClip {
                id,
                display_name: display_name("display_name", &r.display_name)?,
                owner: known.then(|| caller.principal().clone()),
            };
            let reference = body::reference("body", &r.body, "profile", None)?;
            let max_bytes = self.config.max_clip_bytes;
            let app = self.0.clone();
            let persistence = self.persistence.as_ref();
            let stored = persistence.map(|_| r.clone());
            let info = self
                .conversions
                .run(&client, move |turn| {
                    let source = motion::clip_source(r.source, max_bytes)?;
                    app.clips.check_room(&new, &source)?;
                    let built = app.bodies.get("body", &reference)?;
                    let stop = || turn.stop();
                    app.clips.create(new, &reference, &built, source, &stop)
                })
                .await?;
            let clip = motion::clip_out(&info, true);
            if let (Some(persistence), Some(r)) = (persistence, stored)
                && let Err(fault) = persistence
                    .clip_created(&clip, info.owner.as_deref(), r)
                    .await
            {
                self.clips.delete(&info.id)?;
                return Err(fault);
            }
            Ok(pb::CreateClipResponse { clip: Some(clip) })
        };
        answer(result.await)
    }

    async fn get_clip(
        &self,
        request: Request<pb::GetClipRequest>,
    ) -> Result<Response<pb::GetClipResponse>, Status> {
        answer(
            clip_name("name", &request.get_ref().name)
                .and_then(|id| seen(self, caller(&request)?, id))
                .map(|info| pb::GetClipResponse {
                    clip: Some(motion::clip_out(&info, true)),
                }),
        )
    }

    async fn list_clips(
        &self,
        request: Request<pb::ListClipsRequest>,
    ) -> Result<Response<pb::ListClipsResponse>, Status> {
        let r = request.get_ref();
        let caller = caller(&request).map_err(refusal)?;
        let items = self
            .clips
            .list()
            .iter()
            .filter(|c| may(caller, c, Role::Viewer))
            .map(|c| (c.id.clone(), motion::clip_out(c, false)))
            .collect();
        answer(
            page(items, r.page_size, &r.page_token).map(|(clips, next_page_token)| {
                pb::ListClipsResponse {
                    clips,
                    next_page_token,
                }
            }),
        )
    }

    async fn delete_clip(
        &self,
        request: Request<pb::DeleteClipRequest>,
    ) -> Result<Response<pb::DeleteClipResponse>, Status> {
        let result = async {
            let id = clip_name("name", &request.get_ref().name)?;
            let caller = caller(&request)?;
            let info = seen(self, caller, id)?;
            // Built-in clips say themselves that they stay.
            if !info.builtin && !may(caller, &info, Role::Owner) {
                return Err(caller.denied(Role::Owner, &format!("clips/{id}")));
            }
            self.clips.delete(id)?;
            if let Some(persistence) = &self.persistence {
                persistence.clip_deleted(id).await?;
            }
            Ok(pb::DeleteClipResponse {})
        };
        answer(result.await)
    }

    async fn play_clip(
        &self,
        request: Request<pb::PlayClipRequest>,
    ) -> Result<Response<pb::PlayClipResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let (handle, figure) = self.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let mut playback = motion::playback(r)?;
            let clip_id = clip_name("clip", &r.clip)?.to_owned();
            let caller = caller(&request)?;
            let who = control::single(caller.principal(), "control_token", &r.control_token)?;
            seen(self, caller, &clip_id)?;
            let (manner, rest) = self
                .clips
                .manner(&clip_id, playback.looped, playback.speed)?;
            playback.speed = rest;
            let (body_id, body) = handle.body_of(&figure)?;
            let clip = match self.clips.ready(&clip_id, &body_id, manner) {
                Some(clip) => clip,
                None => {
                    let (app, id) = (self.0.clone(), clip_id.clone());
                    self.conversions
                        .run(&client(&request), move |turn| {
                            let stop = || turn.stop();
                            app.clips.prepared(&id, &body_id, &body, manner, &stop)
                        })
                        .await?
                }
            };
            let start_time_s = handle
                .call(origin(&request), move |s| {
                    s.play(&figure, &clip_id, clip, playback, &who)
                })
                .await?;
            Ok(pb::PlayClipResponse { start_time_s })
        };
        answer(result.await)
    }

    async fn stop_clip(
        &self,
        request: Request<pb::StopClipRequest>,
    ) -> Result<Response<pb::StopClipResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let (handle, figure) = self.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let principal = caller(&request)?.principal();
            let who = control::single(principal, "control_token", &r.control_token)?;
            handle
                .call(origin(&request), move |s| s.stop(&figure, &who))
                .await?;
            Ok(pb::StopClipResponse {})
        };
        answer(result.await)
    }

    async fn push_motion(
        &self,
        request: Request<pb::PushMotionRequest>,
    ) -> Result<Response<pb::PushMotionResponse>, Status> {
        let pushed = async {
            let caller = caller(&request)?.clone();
            drive::push(self, &caller, request.into_inner()).await
        };
        answer(pushed.await)
    }

    type DriveFiguresStream = drive::Feedbacks;

    async fn drive_figures(
        &self,
        request: Request<Streaming<pb::DriveFiguresRequest>>,
    ) -> Result<Response<Self::DriveFiguresStream>, Status> {
        let caller = caller(&request).map_err(refusal)?.clone();
        drive::stream(self, caller, request.into_inner()).await
    }
}
