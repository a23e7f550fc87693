//! `MotionService`: stored clips, playing them, and the unary twin of live driving. The stream itself is in `drive`.

use super::{Api, answer, caller, client, drive, long, memory, origin, refusal, upload};
use crate::access::caller::Caller;
use crate::access::roles::{Role, Roles};
use crate::edge::Upload;
use crate::library::NewClip;
use crate::persistence::Writing;
use crate::progress::WorkProgress;
use crate::rehearsals::{self, Rehearsed};
use crate::repeats::to_the_end;
use crate::shares::ClientKey;
use crate::tick::command::CommandOrigin;
use crate::workers::Turn;
use sinew_physics::reference::SAMPLE_BYTES;
use sinew_physics::rehearsal::follow::Follow;
use sinew_wire::convert::{
    body, clip_name, control, display_name, figure_name, motion, new_id, page,
};
use sinew_wire::pb::create_clip_request::Source;
use sinew_wire::pb::{self, motion_service_server::MotionService};
use sinew_wire::status::Fault;
use sinew_wire::types::{ClipInfo, FollowSettings};
use std::cell::Cell;
use std::sync::Arc;
use std::time::Instant;
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

/// A clip that the caller may see. All others are reported as missing.
pub(super) fn seen(api: &Api, caller: &Caller, id: &str) -> Result<ClipInfo, Fault> {
    let info = api.clips.info(id)?;
    if may(caller, &info, Role::Viewer) {
        return Ok(info);
    }
    Err(Fault::not_found("clip", format!("clips/{id}")))
}

/// Stages of a conversion; after each one it checks whether to continue.
const STAGES: f64 = 9.0;

/// Stores a clip, or reports what would be stored.
pub(super) async fn create(
    api: &Api,
    (caller, client): (&Caller, ClientKey),
    (r, upload): (pb::CreateClipRequest, Upload),
    progress: WorkProgress,
) -> Result<pb::CreateClipResponse, Fault> {
    let id = new_id("clip_id", &r.clip_id)?;
    caller.check_new_name("clip_id", id.as_deref())?;
    let follow = motion::follow_update("", r.follow, r.max_help_weights)?;
    let follow = FollowSettings::default().changed(follow);
    let known = !caller.identity.is_anonymous();
    let new = NewClip {
        id,
        display_name: display_name("display_name", &r.display_name)?,
        owner: known.then(|| caller.principal().clone()),
        follow,
    };
    let reference = body::reference("body", &r.body, "profile", None)?;
    let max_bytes = api.config.max_clip_bytes;
    let app = api.0.clone();
    let only = r.validate_only;
    let mut stored = (!only && api.persistence.is_some()).then(|| r.clone());
    let bytes = match &r.source {
        Some(Source::Bvh(file)) => {
            let rate_hz = file.options.as_ref().and_then(|o| o.rate_hz);
            memory(file.data.clone(), rate_hz).await
        }
        Some(Source::Frames(all)) => SAMPLE_BYTES * all.frames.len() as u64,
        None => 0,
    };
    let convert = move |turn: &Turn| {
        let _upload = upload; // the work continues for a moment after its client has gone
        let stage = Cell::new(0.0);
        let stop = || {
            progress.tell(stage.replace(stage.get() + 1.0), STAGES);
            turn.stop()
        };
        if stop() {
            return Err(Turn::gone());
        }
        let source = motion::clip_source(r.source, max_bytes, follow)?;
        app.clips.check_room(&new, &source)?;
        let built = app.bodies.get("body", &reference)?;
        if only {
            return app
                .clips
                .would_create(&new, &reference, &built, &source, &stop);
        }
        // Written in the order in which others see the clip appear and disappear, whether or not its client waits for
        // it.
        let mut writing = None;
        let mut write = |info: &ClipInfo| {
            if let (Some(persistence), Some(r)) = (&app.persistence, stored.take()) {
                writing = Some(persistence.clip_created(info, r)?);
            }
            Ok(())
        };
        let clips = &app.clips;
        let info = clips.create(new, &reference, &built, source, &stop, &mut write)?;
        if let Some(Err(fault)) = writing.map(Writing::wait) {
            // The clip may be gone already, and another one may have its name.
            let same = |there: &ClipInfo| match there.created == info.created {
                true => Ok(()),
                false => Err(Fault::not_found("clip", format!("clips/{}", info.id))),
            };
            let _ = clips.delete(&info.id, same);
            return Err(fault);
        }
        Ok(info)
    };
    let info = api.conversions.run_large(&client, bytes, convert).await?;
    Ok(pb::CreateClipResponse {
        clip: Some(motion::clip_out(&info, true)),
    })
}

/// Rehearses a clip for a figure, and keeps the result.
pub(super) async fn rehearse(
    api: &Api,
    (caller, client): (&Caller, ClientKey),
    r: pb::RehearseClipRequest,
    progress: WorkProgress,
) -> Result<pb::RehearseClipResponse, Fault> {
    let id = clip_name("clip", &r.clip)?.to_owned();
    let info = seen(api, caller, &id)?;
    // Figures that play the clip from now on play the rehearsal.
    if !may(caller, &info, Role::Owner) {
        return Err(caller.denied(Role::Owner, &format!("clips/{id}")));
    }
    let update = motion::follow_update("", r.follow, r.max_help_weights)?;
    let settings = info.follow.changed(update);
    let budget = motion::budget("budget", r.budget)?;
    let (world, figure) = figure_name("figure", &r.figure)?;
    let handle = api.enter_as(caller, Role::Viewer, world)?;
    let figure = figure.to_owned();
    let who = CommandOrigin {
        client: caller.order.clone(),
        sequence: 0,
    };
    let performer = handle.call(who, move |s| s.performer(&figure)).await?;
    let app = api.0.clone();
    let bytes = 2 * app.clips.memory(&id)?; // three forms of it
    let work = move |turn: &Turn| {
        progress.tell(0.0, 1.0);
        let begun = Instant::now();
        let stop = || turn.stop();
        let score = app.clips.score(&id)?;
        let mut go_on = |share: f64| {
            progress.tell(share, 1.0);
            begun.elapsed() < budget && !turn.stop()
        };
        let (info, found) = rehearsals::rehearse(&score, &performer, settings, &stop, &mut go_on)?;
        let kept = match found.map(Arc::new) {
            Some(found) => {
                let gone = app.clips.keep_rehearsed(&score, &found)?;
                Some((score, found, gone))
            }
            None => None,
        };
        Ok((info, kept))
    };
    let (info, kept) = api.simulations.run_large(&client, bytes, work).await?;
    if let (Some(persistence), Some((score, found, gone))) = (api.persistence.clone(), kept) {
        let app = api.0.clone();
        to_the_end(async move {
            let written = persistence.rehearsed(&score.id, &found, &gone).await;
            if let Err(fault) = written {
                app.clips.forget_rehearsed(&score.id, &found);
                return Err(fault);
            }
            // Deleted in the meantime: another clip of that name must not get this rehearsal.
            if !app.clips.holds(&score) {
                persistence.forget_rehearsal(&score.id, &found).await?;
            }
            Ok(())
        })
        .await?;
    }
    Ok(pb::RehearseClipResponse {
        rehearsal: Some(motion::rehearsal_out(&info)),
    })
}

/// The rehearsals of a clip that may be played at this speed.
fn rehearsed(api: &Api, id: &str, follow: Option<Follow>, speed: f64) -> Vec<Arc<Rehearsed>> {
    if follow == Some(Follow::Strict) || speed != 1.0 {
        return Vec::new();
    }
    let mut all = api.clips.rehearsed(id);
    all.retain(|r| !r.helps || follow != Some(Follow::Rehearsed));
    all
}

#[tonic::async_trait]
impl MotionService for Api {
    async fn rehearse_clip(
        &self,
        request: Request<pb::RehearseClipRequest>,
    ) -> Result<Response<pb::RehearseClipResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let r = request.into_inner();
            rehearse(&api, (&caller, client), r, WorkProgress::default()).await
        })
        .await
    }

    async fn create_clip(
        &self,
        request: Request<pb::CreateClipRequest>,
    ) -> Result<Response<pb::CreateClipResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let upload = upload(&request);
            let r = (request.into_inner(), upload);
            create(&api, (&caller, client), r, WorkProgress::default()).await
        })
        .await
    }

    type StreamCreateClipStream = long::Messages<pb::StreamCreateClipResponse>;

    async fn stream_create_clip(
        &self,
        request: Request<pb::StreamCreateClipRequest>,
    ) -> Result<Response<Self::StreamCreateClipStream>, Status> {
        use pb::stream_create_clip_response::Message;
        let start = || {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let upload = upload(&request);
            let r = request.into_inner().create_clip;
            let r = r.ok_or_else(|| Fault::invalid("create_clip", "must be given"))?;
            let (api, progress) = (self.clone(), WorkProgress::default());
            let told = progress.watch();
            let who = caller.clone();
            let work = async move {
                let made = create(&api, (&who, client), (r, upload), progress).await;
                made.map_err(|fault| fault.within("create_clip"))
            };
            let message = |message| pb::StreamCreateClipResponse {
                message: Some(message),
            };
            Ok(long::LongStream {
                caller,
                permit: None,
                told,
                progress: Some(move |share| message(Message::Progress(share))),
                last: move |made| message(Message::CreateClip(made)),
            }
            .run(work, self.stopping.clone()))
        };
        start().map(Response::new).map_err(refusal)
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
        let all = self.clips.list();
        let items = all
            .iter()
            .filter(|c| may(caller, c, Role::Viewer))
            .map(|c| (c.id.clone(), motion::clip_out(c, false)));
        answer(
            page("clips", items, r.page_size, &r.page_token).map(|(clips, next_page_token)| {
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
        self.once(request, |api, request| async move {
            let id = clip_name("name", &request.get_ref().name)?;
            let caller = caller(&request)?;
            seen(&api, caller, id)?;
            let mut writing = None;
            // Built-in clips refuse deletion themselves.
            api.clips.delete(id, |info| {
                if !may(caller, info, Role::Owner) {
                    return Err(caller.denied(Role::Owner, &format!("clips/{id}")));
                }
                if let Some(persistence) = &api.persistence {
                    writing = Some(persistence.clip_deleted(id)?);
                }
                Ok(())
            })?;
            if let Some(writing) = writing {
                writing.done().await?;
            }
            Ok(pb::DeleteClipResponse {})
        })
        .await
    }

    async fn play_clip(
        &self,
        request: Request<pb::PlayClipRequest>,
    ) -> Result<Response<pb::PlayClipResponse>, Status> {
        self.once_if_awaited(request, |api, request| async move {
            let r = request.get_ref();
            let (handle, figure) = api.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let clip_id = clip_name("clip", &r.clip)?.to_owned();
            let caller = caller(&request)?;
            let who = control::single(caller.principal(), "control_token", &r.control_token)?;
            let info = seen(&api, caller, &clip_id)?;
            let follow = motion::follow("follow", r.follow)?;
            let mut playback = motion::playback(r, info.follow)?;
            let rehearsed = rehearsed(&api, &clip_id, follow, playback.speed);
            let (manner, rest) = api
                .clips
                .manner(&clip_id, playback.looped, playback.speed)?;
            playback.speed = rest;
            let (body_id, body) = handle.body_of(&figure)?;
            let _in_use = handle.usage.begin();
            let clip = match api.clips.ready(&clip_id, &body_id, manner) {
                Some(clip) => clip,
                None => {
                    let (app, id) = (api.0.clone(), clip_id.clone());
                    let bytes = api.clips.memory(&id)?;
                    api.conversions
                        .run_large(&client(&request), bytes, move |turn| {
                            let stop = || turn.stop();
                            app.clips.prepared(&id, &body_id, &body, manner, &stop)
                        })
                        .await?
                }
            };
            let begins = handle
                .call(origin(&request), move |s| {
                    s.play(&figure, &clip_id, (clip, &rehearsed), playback, &who)
                })
                .await?;
            Ok(motion::clip_beginning_out(&begins))
        })
        .await
    }

    async fn stop_clip(
        &self,
        request: Request<pb::StopClipRequest>,
    ) -> Result<Response<pb::StopClipResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (handle, figure) = api.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let principal = caller(&request)?.principal();
            let who = control::single(principal, "control_token", &r.control_token)?;
            handle
                .call(origin(&request), move |s| s.stop(&figure, &who))
                .await?;
            Ok(pb::StopClipResponse {})
        })
        .await
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
