//! `PerturbationService`.

use super::{Api, answer, origin};
use crate::wire::convert::{client_id, perturbation};
use crate::wire::pb::{self, perturbation_service_server::PerturbationService};
use tonic::{Request, Response, Status};

#[tonic::async_trait]
impl PerturbationService for Api {
    async fn apply_perturbations(
        &self,
        request: Request<pb::ApplyPerturbationsRequest>,
    ) -> Result<Response<pb::ApplyPerturbationsResponse>, Status> {
        let result = async {
            let mut from = origin(&request);
            let r = request.get_ref();
            let handle = self.world("world", &r.world)?;
            let client = client_id("client_id", &r.client_id)?;
            if !client.is_empty() {
                from.client = client.into();
            }
            from.sequence = r.sequence;
            let batch = perturbation::batch(&r.perturbations)?;
            let tick = handle.call(from, move |s| s.perturb(&batch)).await?;
            Ok(pb::ApplyPerturbationsResponse { tick: tick as i64 })
        };
        answer(result.await)
    }

    async fn clear_perturbations(
        &self,
        request: Request<pb::ClearPerturbationsRequest>,
    ) -> Result<Response<pb::ClearPerturbationsResponse>, Status> {
        let result = async {
            let (handle, figure) = self.figure("figure", &request.get_ref().figure)?;
            let figure = figure.to_owned();
            let tick = handle
                .call(origin(&request), move |s| s.clear_perturbations(&figure))
                .await?;
            Ok(pb::ClearPerturbationsResponse { tick: tick as i64 })
        };
        answer(result.await)
    }
}
