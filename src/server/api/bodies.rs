//! `BodyService`.

use super::{Api, answer};
use crate::engine;
use sinew_wire::convert::body::{self, TextForm};
use sinew_wire::convert::page;
use sinew_wire::pb::{self, body_service_server::BodyService};
use tonic::{Request, Response, Status};

#[tonic::async_trait]
impl BodyService for Api {
    async fn list_bodies(
        &self,
        request: Request<pb::ListBodiesRequest>,
    ) -> Result<Response<pb::ListBodiesResponse>, Status> {
        let r = request.get_ref();
        let all = self.bodies.list();
        let items = all.iter().map(|b| (b.id.clone(), body::brief(b)));
        answer(page("bodies", items, r.page_size, &r.page_token).map(
            |(bodies, next_page_token)| pb::ListBodiesResponse {
                bodies,
                next_page_token,
            },
        ))
    }

    async fn get_body(
        &self,
        request: Request<pb::GetBodyRequest>,
    ) -> Result<Response<pb::GetBodyResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let reference = body::by_name("name", &r.name)?;
            let built = self.body("name", &reference).await?;
            let mut description = body::describe(&reference.id, &built, r.include_geometry);
            if r.include_provenance {
                description.provenance = body::provenance_out(engine::provenance(&built));
            }
            Ok(pb::GetBodyResponse {
                body: Some(description),
            })
        };
        answer(result.await)
    }

    async fn export_body(
        &self,
        request: Request<pb::ExportBodyRequest>,
    ) -> Result<Response<pb::ExportBodyResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let form = body::text_form(r.format)?;
            let reference = body::by_name("name", &r.name)?;
            let built = self.body("name", &reference).await?;
            let (text, kind) = match form {
                TextForm::Mjcf => (engine::mjcf(&built), "xml"),
                TextForm::Urdf => (engine::urdf(&built), "urdf"),
            };
            Ok(pb::ExportBodyResponse {
                text,
                file_name: format!("{}.{kind}", reference.id),
            })
        };
        answer(result.await)
    }
}
