//! `MotionService`: stored clips, playing them, and the unary twin of live driving. The stream itself is in `drive`.

use super::{Api, answer, client, drive, origin};
use crate::wire::convert::{body, clip_name, display_name, motion, new_id, page};
use crate::wire::pb::{self, motion_service_server::MotionService};
use tonic::{Request, Response, Status, Streaming};

#[tonic::async_trait]
impl MotionService for Api {
    async fn create_clip(
        &self,
        request: Request<pb::CreateClipRequest>,
    ) -> Result<Response<pb::CreateClipResponse>, Status> {
        let result = async {
            let client = client(&request);
            let r = request.into_inner();
            let id = new_id("clip_id", &r.clip_id)?;
            let title = display_name("display_name", &r.display_name)?;
            let reference = body::reference("body", &r.body, "profile", None)?;
            let max_bytes = self.config.max_clip_bytes;
            let app = self.0.clone();
            let persistence = self.persistence.as_ref();
            let stored = persistence.map(|_| r.clone());
            let info = self
                .conversions
                .run(&client, move |turn| {
                    let source = motion::clip_source(r.source, max_bytes)?;
                    app.clips.check_room(id.as_deref(), &source)?;
                    let built = app.bodies.get("body", &reference)?;
                    let stop = || turn.stop();
                    app.clips
                        .create(id, title, &reference, &built, source, &stop)
                })
                .await?;
            let clip = motion::clip_out(&info, true);
            if let (Some(persistence), Some(r)) = (persistence, stored)
                && let Err(fault) = persistence.clip_created(&clip, r).await
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
                .and_then(|id| self.clips.info(id))
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
        let items = self
            .clips
            .list()
            .iter()
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
            let mut playback = motion::playback(r)?;
            let clip_id = clip_name("clip", &r.clip)?.to_owned();
            let (handle, figure) = self.figure("figure", &r.figure)?;
            let figure = figure.to_owned();
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
                    s.play(&figure, &clip_id, clip, playback)
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
            let (handle, figure) = self.figure("figure", &request.get_ref().figure)?;
            let figure = figure.to_owned();
            handle
                .call(origin(&request), move |s| s.stop(&figure))
                .await?;
            Ok(pb::StopClipResponse {})
        };
        answer(result.await)
    }

    async fn push_motion(
        &self,
        request: Request<pb::PushMotionRequest>,
    ) -> Result<Response<pb::PushMotionResponse>, Status> {
        answer(drive::push(self, request.into_inner()).await)
    }

    type DriveFiguresStream = drive::Feedbacks;

    async fn drive_figures(
        &self,
        request: Request<Streaming<pb::DriveFiguresRequest>>,
    ) -> Result<Response<Self::DriveFiguresStream>, Status> {
        let client = client(&request);
        drive::stream(self, client, request.into_inner()).await
    }
}
