//! `ControlService`.

use super::{Api, answer, caller, origin};
use crate::access::tokens::fill_random;
use sinew_wire::convert::{access, control};
use sinew_wire::pb::{self, control_service_server::ControlService};
use sinew_wire::status::Fault;
use sinew_wire::types::{Acquire, Transfer};
use tonic::{Request, Response, Status};

/// Bytes of a token: too many to guess.
const TOKEN_BYTES: usize = 24;

/// A new secret.
fn secret() -> Result<String, Fault> {
    let mut bytes = [0; TOKEN_BYTES];
    fill_random(&mut bytes).map_err(|e| Fault::Internal(e.to_string()))?;
    Ok(hex::encode(bytes))
}

#[tonic::async_trait]
impl ControlService for Api {
    async fn acquire_control(
        &self,
        request: Request<pb::AcquireControlRequest>,
    ) -> Result<Response<pb::AcquireControlResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let caller = caller(&request)?;
            let (handle, figure) = api.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let most = handle
                .grants
                .rights(&caller.identity, &handle.id)
                .max_priority;
            // Without authentication all callers look alike, so each may do everything.
            let acquire = Acquire {
                token: secret()?,
                priority: control::priority("priority", r.priority, most)?,
                grace: control::grace("grace_ms", r.grace_ms)?,
                known: !caller.identity.is_anonymous(),
            };
            let who = control::single(caller.principal(), "control_token", &r.control_token)?;
            let (info, token) = handle
                .call(origin(&request), move |s| s.acquire(&figure, &who, acquire))
                .await?;
            api.stored(&handle).await?;
            Ok(pb::AcquireControlResponse {
                lease: Some(control::lease(&handle.id, &info)),
                control_token: token,
            })
        })
        .await
    }

    async fn release_control(
        &self,
        request: Request<pb::ReleaseControlRequest>,
    ) -> Result<Response<pb::ReleaseControlResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (handle, figure) = api.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let principal = caller(&request)?.principal();
            let who = control::single(principal, "control_token", &r.control_token)?;
            handle
                .call(origin(&request), move |s| s.release(&figure, &who))
                .await?;
            api.stored(&handle).await?;
            Ok(pb::ReleaseControlResponse {})
        })
        .await
    }

    async fn transfer_control(
        &self,
        request: Request<pb::TransferControlRequest>,
    ) -> Result<Response<pb::TransferControlResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (handle, figure) = api.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let principal = caller(&request)?.principal();
            let who = control::single(principal, "control_token", &r.control_token)?;
            let to = match r.to.as_str() {
                "" | "*" => None,
                name => Some(access::principal("to", name)?.into()),
            };
            let (blend, lasts) = control::offer(r.blend_ms, r.offer_ms)?;
            let offer_token = secret()?;
            let transfer = Transfer {
                to,
                token: offer_token.clone(),
                blend,
                lasts,
            };
            let info = handle
                .call(origin(&request), move |s| {
                    s.transfer(&figure, &who, transfer)
                })
                .await?;
            Ok(pb::TransferControlResponse {
                lease: Some(control::lease(&handle.id, &info)),
                offer_token,
            })
        })
        .await
    }

    async fn accept_control(
        &self,
        request: Request<pb::AcceptControlRequest>,
    ) -> Result<Response<pb::AcceptControlResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (handle, figure) = api.figure(&request, "figure", &r.figure)?;
            let figure = figure.to_owned();
            let principal = caller(&request)?.principal();
            let who = control::single(principal, "offer_token", &r.offer_token)?;
            let grace = control::grace("grace_ms", r.grace_ms)?;
            let token = secret()?;
            let (info, token) = handle
                .call(origin(&request), move |s| {
                    s.accept(&figure, &who, token, grace)
                })
                .await?;
            api.stored(&handle).await?;
            Ok(pb::AcceptControlResponse {
                lease: Some(control::lease(&handle.id, &info)),
                control_token: token,
            })
        })
        .await
    }

    async fn get_control(
        &self,
        request: Request<pb::GetControlRequest>,
    ) -> Result<Response<pb::GetControlResponse>, Status> {
        let result = || {
            let (handle, figure) = self.figure(&request, "figure", &request.get_ref().figure)?;
            Ok(pb::GetControlResponse {
                lease: Some(control::lease(&handle.id, &handle.control(figure)?)),
            })
        };
        answer(result())
    }
}
