//! The services: convert, ask the world or the library, convert back.

pub mod access;
mod bodies;
mod checkpoints;
mod clips;
mod control;
mod drive;
mod figures;
mod history;
mod info;
mod late;
mod long;
mod obstacles;
mod operations;
mod past_frames;
mod permit;
mod perturbations;
mod recordings;
mod simulation;
mod state;
#[cfg(test)]
mod tests;
mod watching;
mod worlds;

use super::access::caller::Caller;
use super::access::grants::Grant;
use super::app::{App, caller, stopped};
use super::calls::largest_request;
use super::edge::Upload;
use super::encoded::Encoded;
use super::repeats::{self, to_the_end};
use super::shares::{ClientKey, HeldPlace};
use super::tick::command::CommandOrigin;
use bytes::Bytes;
use sinew_physics::reference;
use sinew_wire::convert::client_id;
use sinew_wire::pb;
use sinew_wire::repeatable::Repeatable;
use sinew_wire::status::Fault;
use std::future::Future;
use std::sync::Arc;
use tonic::service::RoutesBuilder;
use tonic::{Request, Response, Status};
use xxhash_rust::xxh3::xxh3_64;

/// Names of the services, for health checks; the empty name is the server as a whole.
pub const SERVICE_NAMES: [&str; 16] = [
    "",
    pb::world_service_server::SERVICE_NAME,
    pb::figure_service_server::SERVICE_NAME,
    pb::body_service_server::SERVICE_NAME,
    pb::motion_service_server::SERVICE_NAME,
    pb::perturbation_service_server::SERVICE_NAME,
    pb::state_service_server::SERVICE_NAME,
    pb::simulation_service_server::SERVICE_NAME,
    pb::server_service_server::SERVICE_NAME,
    pb::access_service_server::SERVICE_NAME,
    pb::control_service_server::SERVICE_NAME,
    pb::checkpoint_service_server::SERVICE_NAME,
    pb::history_service_server::SERVICE_NAME,
    pb::recording_service_server::SERVICE_NAME,
    pb::obstacle_service_server::SERVICE_NAME,
    pb::operation_service_server::SERVICE_NAME,
];

/// First grants of a world that a caller creates: an authenticated caller owns it.
fn first_grants(caller: &Caller) -> Vec<Grant> {
    let known = !caller.identity.is_anonymous();
    let owner = known.then(|| Grant::owner(caller.principal().clone()));
    owner.into_iter().collect()
}

/// The services; cheap to clone.
#[derive(Clone)]
pub struct Api(Arc<App>);

impl std::ops::Deref for Api {
    type Target = Arc<App>;
    fn deref(&self) -> &Arc<App> {
        &self.0
    }
}

impl Api {
    /// Answers a request that is done once, however often it arrives under the same `request_id`. Once begun, it is
    /// completed even if its client does not wait: a half-done request would differ from what is stored.
    async fn once<Q, R, W>(
        &self,
        request: Request<Q>,
        work: impl FnOnce(Self, Request<Q>) -> W,
    ) -> Result<Response<R>, Status>
    where
        Q: Repeatable,
        R: prost::Message + Default + 'static,
        W: Future<Output = Result<R, Fault>> + Send + 'static,
    {
        let upload = upload(&request);
        let work = |api, request| to_the_end(holding(upload, work(api, request)));
        self.once_if_awaited(request, work).await
    }

    /// The same for a request that takes long before it changes anything. Without a `request_id` it is given up when
    /// its client goes.
    async fn once_if_awaited<Q, R, W>(
        &self,
        request: Request<Q>,
        work: impl FnOnce(Self, Request<Q>) -> W,
    ) -> Result<Response<R>, Status>
    where
        Q: Repeatable,
        R: prost::Message + Default + 'static,
        W: Future<Output = Result<R, Fault>> + Send + 'static,
    {
        let id = client_id("request_id", request.get_ref().request_id()).map_err(refusal)?;
        if id.is_empty() || request.get_ref().is_trial() {
            return answer(work(self.clone(), request).await);
        }
        let caller = caller(&request).map_err(refusal)?;
        let key = repeats::RequestKey {
            principal: caller.principal().clone(),
            call: caller.call.clone(),
            id,
        };
        let hash = xxh3_64(&request.get_ref().encode_to_vec());
        let work = holding(upload(&request), work(self.clone(), request));
        let encoded = async move { work.await.map(|r| Bytes::from(r.encode_to_vec())) };
        let done = self.repeats.once(key, hash, encoded).await;
        answer(done.and_then(|bytes| {
            R::decode(bytes).map_err(|e| Fault::Internal(format!("an answer was kept badly: {e}")))
        }))
    }
}

/// Adds every service to the routes.
pub fn add_services(routes: &mut RoutesBuilder, app: &Arc<App>) {
    let api = Api(app.clone());
    // The sizes of requests were checked before, in `edge::requests`.
    let request = largest_request(&app.config);
    let response = app.config.max_response_bytes as usize * 2;
    macro_rules! add {
        ($($module:ident :: $server:ident;)*) => {
            $(routes.add_service(
                pb::$module::$server::new(api.clone())
                    .max_decoding_message_size(request)
                    .max_encoding_message_size(response),
            );)*
        };
    }
    add! {
        world_service_server::WorldServiceServer;
        figure_service_server::FigureServiceServer;
        body_service_server::BodyServiceServer;
        motion_service_server::MotionServiceServer;
        perturbation_service_server::PerturbationServiceServer;
        state_service_server::StateServiceServer;
        simulation_service_server::SimulationServiceServer;
        server_service_server::ServerServiceServer;
        access_service_server::AccessServiceServer;
        control_service_server::ControlServiceServer;
        checkpoint_service_server::CheckpointServiceServer;
        history_service_server::HistoryServiceServer;
        recording_service_server::RecordingServiceServer;
        obstacle_service_server::ObstacleServiceServer;
        operation_service_server::OperationServiceServer;
    }
}

/// The client whose share a request takes.
fn client<T>(request: &Request<T>) -> ClientKey {
    caller(request).map_or_else(|_| "".into(), |c| c.client.clone())
}

/// The accounted bytes of a request.
fn upload<T>(request: &Request<T>) -> Upload {
    let upload = request.extensions().get::<Upload>();
    upload.cloned().unwrap_or_default()
}

/// Work that may continue without its client: its request stays in memory until the work ends.
async fn holding<T>(upload: Upload, work: impl Future<Output = T>) -> T {
    let _upload = upload;
    work.await
}

/// Bytes that converting a file takes. Computed on a worker, because the head of a file may be long.
async fn memory(file: Bytes, rate_hz: Option<f64>) -> u64 {
    let found = tokio::task::spawn_blocking(move || reference::memory(&file, rate_hz));
    found.await.unwrap_or(0)
}

/// The sender of a request, by which commands of its world are ordered.
fn origin<T>(request: &Request<T>) -> CommandOrigin {
    CommandOrigin {
        client: caller(request).map_or_else(|_| "".into(), |c| c.order.clone()),
        sequence: 0,
    }
}

/// A result in the form that gRPC wants; refusals are counted by reason.
fn answer<T>(result: Result<T, Fault>) -> Result<Response<T>, Status> {
    result.map(Response::new).map_err(refusal)
}

/// An answer that is encoded already. The message itself is empty: the edge sends the bytes in its place.
fn encoded<T: Default>(bytes: Encoded) -> Response<T> {
    let mut response = Response::new(T::default());
    response.extensions_mut().insert(bytes);
    response
}

fn refusal(fault: Fault) -> Status {
    super::telemetry::count_refusal(&fault);
    fault.into()
}
