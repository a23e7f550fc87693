//! `PerturbationService`.

use super::{Api, caller, origin};
use crate::access::caller::Caller;
use sinew_wire::convert::{client_id, perturbation};
use sinew_wire::pb::{self, perturbation_service_server::PerturbationService};
use std::sync::Arc;
use tonic::{Request, Response, Status};

/// The key that orders a batch among others in the same tick: its principal, then the name that its sender chose. So no
/// choice of name gets ahead of other principals. Without principals the name counts, or the connection.
fn order(caller: &Caller, client: &str) -> Arc<str> {
    if client.is_empty() {
        caller.order.clone()
    } else if caller.identity.is_anonymous() {
        client.into()
    } else {
        // A space sorts below every character of a principal.
        format!("{} {client}", caller.principal()).into()
    }
}

#[tonic::async_trait]
impl PerturbationService for Api {
    async fn apply_perturbations(
        &self,
        request: Request<pb::ApplyPerturbationsRequest>,
    ) -> Result<Response<pb::ApplyPerturbationsResponse>, Status> {
        self.once(request, |api, request| async move {
            let mut from = origin(&request);
            let r = request.get_ref();
            let handle = api.world(&request, "world", &r.world)?;
            let client = client_id("client_id", &r.client_id)?;
            let caller = caller(&request)?;
            from.client = order(caller, &client);
            from.sequence = r.sequence;
            let batch = perturbation::batch(&r.perturbations)?;
            let rights = handle.grants.rights(&caller.identity, &handle.id);
            let bound = handle.grants.admit(caller, &rights, &batch)?;
            let only = r.validate_only;
            let tick = handle
                .call(from, move |s| {
                    if only {
                        s.would_perturb(&batch, bound.as_ref())
                    } else {
                        s.perturb(&batch, bound.as_ref())
                    }
                })
                .await?;
            Ok(pb::ApplyPerturbationsResponse { tick: tick as i64 })
        })
        .await
    }

    async fn clear_perturbations(
        &self,
        request: Request<pb::ClearPerturbationsRequest>,
    ) -> Result<Response<pb::ClearPerturbationsResponse>, Status> {
        self.once(request, |api, request| async move {
            let (handle, figure) = api.figure(&request, "figure", &request.get_ref().figure)?;
            let figure = figure.to_owned();
            let tick = handle
                .call(origin(&request), move |s| s.clear_perturbations(&figure))
                .await?;
            Ok(pb::ClearPerturbationsResponse { tick: tick as i64 })
        })
        .await
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::caller::{Claims, Identity};
    use crate::access::roles::Rule;

    fn from(principal: &str, connection: &str) -> Caller {
        let identity = Identity {
            principal: principal.into(),
            claims: Arc::new(Claims::default()),
            expires: None,
        };
        let known = !identity.is_anonymous();
        Caller {
            order: if known { principal } else { connection }.into(),
            identity,
            client: "".into(),
            rule: Rule::Open,
            call: "".into(),
        }
    }

    #[test]
    fn batches_are_ordered_by_principal_before_the_names_that_senders_choose() {
        let (ann, anna) = (from("user:ann", "9"), from("user:anna", "1"));
        let mut all = [
            order(&anna, ""),
            order(&anna, "!"),
            order(&ann, "zzz"),
            order(&ann, ""),
        ];
        all.sort();
        assert_eq!(
            all.each_ref().map(|a| &**a),
            ["user:ann", "user:ann zzz", "user:anna", "user:anna !"]
        );
        // The connection, wherever it comes from, does not stand for a principal.
        assert_eq!(
            order(&from("user:ann", "1"), "x"),
            order(&from("user:ann", "2"), "x")
        );
        let nobody = from("anonymous", "127.0.0.1:5");
        assert_eq!(
            (&*order(&nobody, ""), &*order(&nobody, "me")),
            ("127.0.0.1:5", "me")
        );
    }
}
