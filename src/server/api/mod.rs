//! The services: convert, ask the world or the library, convert back.

mod bodies;
mod checkpoints;
mod clips;
mod drive;
mod figures;
mod info;
mod perturbations;
mod simulation;
mod state;
mod watching;
mod worlds;

use super::checkpoints::Checkpoints;
use super::config::Config;
use super::library::{Bodies, Clips};
use super::persistence::Persistence;
use super::shares::{Client, Place, Places, client_at};
use super::tick::command::Origin;
use super::workers::Pool;
use super::worlds::{Registry, WorldHandle};
use crate::wire::convert::world_name;
use crate::wire::pb;
use crate::wire::status::Fault;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::SystemTime;
use tokio::sync::watch;
use tonic::service::RoutesBuilder;
use tonic::{Request, Response, Status};

/// Names of the services, for health checks; the empty name is the server as a whole.
pub const SERVICE_NAMES: [&str; 10] = [
    "",
    pb::world_service_server::SERVICE_NAME,
    pb::figure_service_server::SERVICE_NAME,
    pb::body_service_server::SERVICE_NAME,
    pb::motion_service_server::SERVICE_NAME,
    pb::perturbation_service_server::SERVICE_NAME,
    pb::state_service_server::SERVICE_NAME,
    pb::simulation_service_server::SERVICE_NAME,
    pb::server_service_server::SERVICE_NAME,
    pb::checkpoint_service_server::SERVICE_NAME,
];

/// Calls that carry a clip or a checkpoint in their request: up to `max_clip_bytes`. All others take up to
/// `max_request_bytes`.
pub const UPLOADS: [&str; 4] = [
    "/sinew.v1.MotionService/CreateClip",
    "/sinew.v1.SimulationService/SimulateClip",
    "/sinew.v1.CheckpointService/RestoreWorld",
    "/sinew.v1.CheckpointService/ForkWorld",
];

/// Whether a call takes exactly one message. Of calls of other packages, reflection for example, nothing is known.
pub fn is_unary(path: &str) -> bool {
    path.starts_with("/sinew.v1.") && path != "/sinew.v1.MotionService/DriveFigures"
}

/// Bytes of the largest request: a file comes whole in one message, with a little around it.
pub fn largest_request(config: &Config) -> usize {
    config.max_clip_bytes.max(config.max_request_bytes) as usize + 65_536
}

/// What the services share.
pub struct App {
    /// Settings.
    pub config: Arc<Config>,
    /// Worlds.
    pub worlds: Registry,
    /// Bodies.
    pub bodies: Bodies,
    /// Clips.
    pub clips: Clips,
    /// Checkpoints of worlds.
    pub checkpoints: Checkpoints,
    /// Where files become clips.
    pub conversions: Pool,
    /// Where clips are simulated.
    pub simulations: Pool,
    /// The data directory.
    pub persistence: Option<Arc<Persistence>>,
    /// When the server started.
    pub started: SystemTime,
    /// Turns true when streams are to end.
    stopping: watch::Receiver<bool>,
    viewers: Places,
    drivers: Places,
    next_stream: AtomicU64,
}

impl App {
    /// An application without worlds; [`restore`](Self::restore) brings those of the data directory back.
    ///
    /// # Errors
    /// The built-in data cannot be prepared, or the data directory cannot be used.
    pub fn new(config: Arc<Config>, stopping: watch::Receiver<bool>) -> Result<Self, Fault> {
        super::telemetry::metrics();
        let bodies = Bodies::new(&config);
        let share = config.max_client_share;
        Ok(Self {
            clips: Clips::new(&config, &bodies)?,
            bodies,
            worlds: Registry::new(config.clone()),
            checkpoints: Checkpoints::new(share),
            conversions: Pool::new(
                "file conversion",
                "max_waiting_conversions",
                config.max_conversions,
                config.max_waiting_conversions,
            ),
            simulations: Pool::new(
                "simulation",
                "max_waiting_simulations",
                config.max_simulations,
                config.max_waiting_simulations,
            ),
            persistence: Persistence::open(&config)
                .map_err(|e| Fault::Precondition {
                    reason: "DATA_DIR",
                    message: e.to_string(),
                    facts: vec![],
                })?
                .map(Arc::new),
            started: SystemTime::now(),
            stopping,
            viewers: Places::new("max_viewers", config.max_viewers, share, "sinew_viewers"),
            drivers: Places::new("max_drivers", config.max_drivers, share, "sinew_drivers"),
            next_stream: AtomicU64::new(1),
            config,
        })
    }

    /// Brings the worlds and clips of the data directory back.
    pub async fn restore(self: &Arc<Self>) {
        if let Some(persistence) = &self.persistence {
            persistence.restore(self).await;
        }
    }

    /// Waits until what has changed of a world is on disk.
    async fn stored(&self, handle: &WorldHandle) -> Result<(), Fault> {
        match &self.persistence {
            Some(persistence) => persistence.changed(handle).await,
            None => Ok(()),
        }
    }

    fn world(&self, field: &str, name: &str) -> Result<Arc<WorldHandle>, Fault> {
        let name = world_name(field, name)?;
        self.worlds.get(name).map_err(|missing| {
            let quarantined = self.persistence.as_ref().map(|p| p.check(name));
            quarantined.and_then(Result::err).unwrap_or(missing)
        })
    }

    /// World and last part of the name of a figure.
    fn figure<'a>(&self, field: &str, name: &'a str) -> Result<(Arc<WorldHandle>, &'a str), Fault> {
        let (world, figure) = crate::wire::convert::figure_name(field, name)?;
        Ok((self.worlds.get(world)?, figure))
    }

    fn next_stream(&self) -> u64 {
        self.next_stream.fetch_add(1, Ordering::Relaxed)
    }

    /// The body of a reference. Building one takes milliseconds, so it is done where waiting does no harm.
    async fn body(
        self: &Arc<Self>,
        field: &'static str,
        reference: &crate::wire::types::BodyRef,
    ) -> Result<Arc<crate::sim::body::Body>, Fault> {
        let (app, reference) = (self.clone(), reference.clone());
        tokio::task::spawn_blocking(move || app.bodies.get(field, &reference))
            .await
            .unwrap_or_else(|e| Err(Fault::Internal(format!("building the body failed: {e}"))))
    }
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

/// Adds every service to the routes.
pub fn add_services(routes: &mut RoutesBuilder, app: &Arc<App>) {
    let api = Api(app.clone());
    // What each call takes is checked before (`edge::requests`).
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
        checkpoint_service_server::CheckpointServiceServer;
    }
}

/// Completes when the server shuts down.
async fn stopped(stopping: &mut watch::Receiver<bool>) {
    // An error means that the sender is gone, which says the same.
    let _ = stopping.wait_for(|s| *s).await;
}

/// Who sends a request.
fn client<T>(request: &Request<T>) -> Client {
    client_at(request.remote_addr())
}

/// The sender of a request, as commands of its world are ordered by.
fn origin<T>(request: &Request<T>) -> Origin {
    Origin {
        client: request
            .remote_addr()
            .map_or_else(String::new, |a| a.to_string())
            .into(),
        sequence: 0,
    }
}

/// A result as gRPC wants it; refusals are counted by reason.
fn answer<T>(result: Result<T, Fault>) -> Result<Response<T>, Status> {
    result.map(Response::new).map_err(refusal)
}

fn refusal(fault: Fault) -> Status {
    super::telemetry::count_refusal(&fault);
    fault.into()
}
