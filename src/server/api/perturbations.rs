//! `PerturbationService`.

use super::{Api, answer, caller, origin};
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
            let handle = self.world(&request, "world", &r.world)?;
            let client = client_id("client_id", &r.client_id)?;
            let caller = caller(&request)?;
            if !client.is_empty() {
                // By principal first: a name that someone chooses does not push in before others.
                from.client = if caller.identity.is_anonymous() {
                    client.into()
                } else {
                    format!("{} {client}", caller.principal()).into()
                };
            }
            from.sequence = r.sequence;
            let batch = perturbation::batch(&r.perturbations)?;
            let rights = handle.grants.rights(&caller.identity, &handle.id);
            handle.grants.admit(caller, &rights, &batch)?;
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
            let (handle, figure) = self.figure(&request, "figure", &request.get_ref().figure)?;
            let figure = figure.to_owned();
            let tick = handle
                .call(origin(&request), move |s| s.clear_perturbations(&figure))
                .await?;
            Ok(pb::ClearPerturbationsResponse { tick: tick as i64 })
        };
        answer(result.await)
    }
}
