//! `FigureService`.

use super::{Api, answer, caller, origin};
use crate::access::roles::Role;
use crate::engine;
use crate::repeats::to_the_end;
use sinew_wire::convert::names::FIGURE;
use sinew_wire::convert::{control, figure, new_id, page, place};
use sinew_wire::pb::{self, figure_service_server::FigureService};
use sinew_wire::status::Fault;
use tonic::{Request, Response, Status};

#[tonic::async_trait]
impl FigureService for Api {
    async fn create_figure(
        &self,
        request: Request<pb::CreateFigureRequest>,
    ) -> Result<Response<pb::CreateFigureResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let handle = api.world(&request, "parent", &r.parent)?;
            let id = new_id("figure_id", &r.figure_id)?;
            let settings = figure::settings("figure", r.figure.as_ref())?;
            let body = api.body("figure.profile", &settings.body).await?;
            let only = r.validate_only;
            if only {
                engine::check_figure(&handle.described().world.settings, &settings, body.clone())?;
            }
            let info = handle
                .call(origin(&request), move |s| {
                    if only {
                        s.would_create_figure(id, settings)
                    } else {
                        s.create_figure(id, settings, body)
                    }
                })
                .await?;
            if !only {
                api.stored(&handle).await?;
            }
            Ok(pb::CreateFigureResponse {
                figure: Some(figure::figure_out(&info)),
            })
        })
        .await
    }

    async fn get_figure(
        &self,
        request: Request<pb::GetFigureRequest>,
    ) -> Result<Response<pb::GetFigureResponse>, Status> {
        let result = || {
            let (handle, id) = self.figure(&request, "name", &request.get_ref().name)?;
            Ok(pb::GetFigureResponse {
                figure: Some(figure::figure_out(&handle.figure(id)?)),
            })
        };
        answer(result())
    }

    async fn list_figures(
        &self,
        request: Request<pb::ListFiguresRequest>,
    ) -> Result<Response<pb::ListFiguresResponse>, Status> {
        let result = || {
            let r = request.get_ref();
            let handle = self.world(&request, "parent", &r.parent)?;
            let figures = handle.figures();
            // Indices grow in the order of creation; padded they sort as text.
            let items = figures
                .iter()
                .map(|f| (format!("{:010}", f.index), figure::figure_out(f)));
            let list = FIGURE.name([&handle.id, ""]);
            let (figures, next_page_token) = page(&list, items, r.page_size, &r.page_token)?;
            Ok(pb::ListFiguresResponse {
                figures,
                next_page_token,
            })
        };
        answer(result())
    }

    async fn update_figure(
        &self,
        request: Request<pb::UpdateFigureRequest>,
    ) -> Result<Response<pb::UpdateFigureResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let f = r
                .figure
                .as_ref()
                .ok_or_else(|| Fault::invalid("figure", "must be given"))?;
            let (handle, id) = self.figure(&request, "figure.name", &f.name)?;
            let update = figure::update(f, r.update_mask.as_ref())?;
            let id = id.to_owned();
            let caller = caller(&request)?;
            let who = control::single(caller.principal(), "control_token", &r.control_token)?;
            let roles = handle.grants.rights(&caller.identity, &handle.id).roles;
            // A director sets the scene, even while others drive in it.
            let who = (!roles.contain(Role::Director)).then_some(who);
            let (etag, only) = (f.etag.clone(), r.validate_only);
            let settings = if only {
                let now = handle.figure(&id)?.settings;
                let settings = update.clone().applied(now);
                let body = self.body("figure.body", &settings.body).await?;
                engine::check_figure(&handle.described().world.settings, &settings, body)?;
                Some(settings)
            } else {
                None
            };
            let (api, origin) = (self.clone(), origin(&request));
            to_the_end(async move {
                let info = handle
                    .call(origin, move |s| {
                        figure::check_etag(&s.figure(&id)?, &etag)?;
                        match settings {
                            Some(settings) => s.would_update_figure(&id, settings, who.as_ref()),
                            None => s.update_figure(&id, update, who.as_ref()),
                        }
                    })
                    .await?;
                if !only {
                    api.stored(&handle).await?;
                }
                Ok(pb::UpdateFigureResponse {
                    figure: Some(figure::figure_out(&info)),
                })
            })
            .await
        };
        answer(result.await)
    }

    async fn delete_figure(
        &self,
        request: Request<pb::DeleteFigureRequest>,
    ) -> Result<Response<pb::DeleteFigureResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (handle, id) = api.figure(&request, "name", &r.name)?;
            let (id, etag) = (id.to_owned(), r.etag.clone());
            handle
                .call(origin(&request), move |s| {
                    figure::check_etag(&s.figure(&id)?, &etag)?;
                    s.delete_figure(&id)
                })
                .await?;
            api.stored(&handle).await?;
            Ok(pb::DeleteFigureResponse {})
        })
        .await
    }

    async fn reset_figure(
        &self,
        request: Request<pb::ResetFigureRequest>,
    ) -> Result<Response<pb::ResetFigureResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (handle, id) = api.figure(&request, "name", &r.name)?;
            let id = id.to_owned();
            let at = r.placement.map(|p| place("placement", p)).transpose()?;
            let principal = caller(&request)?.principal();
            let who = control::single(principal, "control_token", &r.control_token)?;
            let info = handle
                .call(origin(&request), move |s| s.reset_figure(&id, at, &who))
                .await?;
            Ok(pb::ResetFigureResponse {
                figure: Some(figure::figure_out(&info)),
            })
        })
        .await
    }
}
