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

use super::access::Access;
use super::access::caller::Caller;
use super::access::grants::Grant;
use super::access::roles::{Role, Rule};
use super::checkpoints::Checkpoints;
use super::config::Config;
use super::edge::Upload;
use super::encoded::Encoded;
use super::library::{Bodies, Clips};
use super::operations::{self as long_work, Operations};
use super::persistence::Persistence;
use super::recordings::Recordings;
use super::repeats::{self, Repeats, to_the_end};
use super::shares::{Client, Place, Places};
use super::tick::command::Origin;
use super::workers::Pool;
use super::worlds::{Leaving, Registry, WorldHandle};
use bytes::Bytes;
use sinew_physics::retarget;
use sinew_wire::convert::{client_id, world_name};
use sinew_wire::pb;
use sinew_wire::repeatable::Repeatable;
use sinew_wire::status::Fault;
use std::future::Future;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant, SystemTime};
use tokio::sync::watch;
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

/// Calls that carry a clip or a checkpoint in their request: up to `max_clip_bytes`. All others take up to
/// `max_request_bytes`.
pub const UPLOADS: [&str; 7] = [
    "/sinew.v1.MotionService/CreateClip",
    "/sinew.v1.MotionService/StreamCreateClip",
    "/sinew.v1.SimulationService/SimulateClip",
    "/sinew.v1.SimulationService/StreamSimulateClip",
    "/sinew.v1.OperationService/StartOperation",
    "/sinew.v1.CheckpointService/RestoreWorld",
    "/sinew.v1.CheckpointService/ForkWorld",
];

/// How often worlds are looked at that may be idle only for some time.
const IDLE_LOOK: Duration = Duration::from_millis(250);

/// Grants of a world that a caller makes: who has said who it is owns it.
fn first_grants(caller: &Caller) -> Vec<Grant> {
    let known = !caller.identity.is_anonymous();
    let owner = known.then(|| Grant::owner(caller.principal().clone()));
    owner.into_iter().collect()
}

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
    /// Parts of their past that are kept.
    pub recordings: Arc<Recordings>,
    /// Where files become clips.
    pub conversions: Pool,
    /// Where clips are simulated.
    pub simulations: Pool,
    /// Who may do what.
    pub access: Arc<Access>,
    /// The data directory.
    pub persistence: Option<Arc<Persistence>>,
    /// Long work that nobody waits for.
    operations: Arc<Operations<Encoded>>,
    /// Recent requests by name, with their answers.
    repeats: Arc<Repeats>,
    /// When the server started.
    pub started: SystemTime,
    /// Turns true when streams are to end.
    stopping: watch::Receiver<bool>,
    /// Viewers that are shown the past.
    late: late::LateViewers,
    viewers: Places,
    drivers: Places,
    next_stream: AtomicU64,
}

impl App {
    /// An application without worlds; [`restore`](Self::restore) brings those of the data directory back.
    ///
    /// # Errors
    /// The built-in data cannot be prepared, the data directory cannot be used, or a certificate or key cannot be used.
    pub fn new(config: Arc<Config>, stopping: watch::Receiver<bool>) -> Result<Self, Fault> {
        super::telemetry::metrics();
        let bodies = Bodies::new(&config);
        let share = config.max_client_share;
        let (most, bytes) = (config.max_recordings, config.max_recording_bytes);
        let recordings = Arc::new(Recordings::new(most, bytes, share));
        Ok(Self {
            access: Access::new(&config).map_err(Fault::Internal)?,
            clips: Clips::new(&config, &bodies)?,
            bodies,
            worlds: Registry::new(config.clone())?,
            checkpoints: Checkpoints::new(&config),
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
            persistence: Persistence::open(&config, &recordings)
                .map_err(|e| Fault::Precondition {
                    reason: "DATA_DIR",
                    message: e.to_string(),
                    facts: vec![],
                })?
                .map(Arc::new),
            recordings,
            operations: Operations::new(long_work::Limits {
                most: config.max_operations,
                share,
                bytes: config.max_operation_bytes,
                ttl: Duration::from_secs_f64(config.operation_ttl_s),
            }),
            repeats: Repeats::new(config.max_request_ids, share),
            started: SystemTime::now(),
            stopping,
            late: late::LateViewers::default(),
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

    /// Why new clients should rather go elsewhere. Names of worlds are not for everyone.
    pub fn unready(&self) -> Option<String> {
        if self.worlds.is_draining() {
            return Some("shutting down".into());
        }
        match self.worlds.stuck().len() {
            0 => None,
            n => Some(format!("ticks that do not end: {n}")),
        }
    }

    /// Waits until what has changed of a world is on disk. What is half written when its client goes away would differ
    /// from what is known of it.
    async fn stored(&self, handle: &Arc<WorldHandle>) -> Result<(), Fault> {
        let Some(persistence) = self.persistence.clone() else {
            return Ok(());
        };
        let handle = handle.clone();
        to_the_end(async move { persistence.changed(&handle).await }).await
    }

    /// Writes a new world down, whether or not its client waits for it; one that cannot be is ended again. Called
    /// before anything else is waited for: others can see the world already.
    async fn written(self: &Arc<Self>, handle: &Arc<WorldHandle>) -> Result<(), Fault> {
        let Some(persistence) = self.persistence.clone() else {
            return Ok(());
        };
        let (app, handle) = (self.clone(), handle.clone());
        to_the_end(async move {
            let written = persistence.created(&handle).await;
            if written.is_err() {
                app.delete(&handle, "it could not be stored").await?;
            }
            written
        })
        .await
    }

    /// A world by the last part of its name; one in quarantine says so.
    fn existing(&self, id: &str) -> Result<Arc<WorldHandle>, Fault> {
        self.worlds.get(id).map_err(|missing| {
            let quarantined = self.persistence.as_ref().map(|p| p.check(id));
            quarantined.and_then(Result::err).unwrap_or(missing)
        })
    }

    /// Refuses what is not to come into being after its world has left.
    fn still_there(&self, handle: &WorldHandle) -> Result<(), Fault> {
        match self.worlds.holds(handle) {
            true => Ok(()),
            false => Err(handle.ended()),
        }
    }

    /// The world of this name, for a caller who has the role there that its call needs.
    fn world<T>(
        &self,
        request: &Request<T>,
        field: &str,
        name: &str,
    ) -> Result<Arc<WorldHandle>, Fault> {
        let id = world_name(field, name)?;
        self.enter(caller(request)?, id)
    }

    /// World and last part of the name of a figure, likewise; a driver must be one of that figure.
    fn figure<'a, T>(
        &self,
        request: &Request<T>,
        field: &str,
        name: &'a str,
    ) -> Result<(Arc<WorldHandle>, &'a str), Fault> {
        let (world, figure) = sinew_wire::convert::figure_name(field, name)?;
        let handle = self.enter_for(caller(request)?, world, &[figure])?;
        Ok((handle, figure))
    }

    /// As [`App::world`], by the last part of the name.
    fn enter(&self, caller: &Caller, id: &str) -> Result<Arc<WorldHandle>, Fault> {
        self.enter_for(caller, id, &[])
    }

    /// The world, for a caller who has the role that its call needs, for these figures.
    fn enter_for(
        &self,
        caller: &Caller,
        id: &str,
        figures: &[&str],
    ) -> Result<Arc<WorldHandle>, Fault> {
        let Rule::Needs(role) = caller.rule else {
            return Err(Fault::Internal(format!(
                "{} does not say what it needs",
                caller.call
            )));
        };
        let place = format!("worlds/{id}");
        let handle = match self.existing(id) {
            Ok(handle) => handle,
            // Who may not do it does not learn whether it is there.
            Err(fault) => {
                let claimed = caller.identity.claims.roles_in(id).contain(role);
                let shown = claimed || !role.is_of_world() || matches!(fault, Fault::Draining);
                return Err(if shown {
                    fault
                } else {
                    caller.denied(role, &place)
                });
            }
        };
        if !role.is_of_world() {
            return Ok(handle);
        }
        self.admit(caller, handle, (role, figures))
    }

    /// The world, for a caller who has this role there, for these figures.
    fn admit(
        &self,
        caller: &Caller,
        handle: Arc<WorldHandle>,
        (role, figures): (Role, &[&str]),
    ) -> Result<Arc<WorldHandle>, Fault> {
        let id = &*handle.id;
        let place = format!("worlds/{id}");
        let rights = handle.grants.rights(&caller.identity, id);
        let missing = if !rights.roles.contain(role) {
            Some((place, figures.first().copied().unwrap_or_default()))
        } else if role == Role::Driver {
            let other = figures.iter().find(|f| !rights.drives(f));
            other.map(|f| (format!("{place}/figures/{f}"), *f))
        } else {
            None
        };
        match missing {
            None => {
                handle.usage.note();
                Ok(handle)
            }
            Some((place, figure)) => {
                if role != Role::Viewer {
                    handle.tell_refused(caller, figure);
                }
                Err(caller.denied(role, &place))
            }
        }
    }

    /// The world, for a caller who has this role there, whatever role its call needs.
    fn enter_as(&self, caller: &Caller, role: Role, id: &str) -> Result<Arc<WorldHandle>, Fault> {
        match self.existing(id) {
            Ok(handle) => self.admit(caller, handle, (role, &[])),
            Err(fault) => caller.check_claim(role, id).and(Err(fault)),
        }
    }

    /// Ends this very world, and not another one of its name, also on disk. `by`: who wants it.
    async fn delete(self: &Arc<Self>, handle: &Arc<WorldHandle>, by: &str) -> Result<(), Fault> {
        let (app, handle, by) = (self.clone(), handle.clone(), by.to_owned());
        to_the_end(async move {
            let same = |there: &Arc<WorldHandle>| Arc::ptr_eq(there, &handle);
            let leaving = app.worlds.delete_if(&handle.id, &by, same).await?;
            let missing = || Fault::not_found("world", format!("worlds/{}", handle.id));
            app.forget_world(leaving.ok_or_else(missing)?).await
        })
        .await
    }

    /// Forgets what is kept of a world that has ended. Until then no other one has its name.
    async fn forget_world(&self, leaving: Leaving) -> Result<(), Fault> {
        let handle = &leaving.handle;
        self.checkpoints.forget_world(&handle.id);
        self.recordings.forget_world(&handle.id);
        match &self.persistence {
            Some(persistence) => persistence.deleted(handle).await,
            None => Ok(()),
        }
    }

    /// Ends worlds that nobody has used for as long as they may be idle, for ever.
    pub async fn end_idle_worlds(&self) {
        loop {
            tokio::time::sleep(IDLE_LOOK).await;
            for handle in self.worlds.list() {
                let idle = |w: &Arc<WorldHandle>| {
                    let ttl = w.described().world.settings.pace.idle_ttl;
                    ttl.is_some_and(|ttl| w.usage.idle(Instant::now()) >= ttl)
                };
                if !idle(&handle) {
                    continue;
                }
                // Whoever came in the meantime keeps it; one that somebody else deletes is gone, too.
                let ended = self.worlds.delete_if(&handle.id, "idle_ttl", idle).await;
                if let Ok(Some(leaving)) = ended
                    && let Err(fault) = self.forget_world(leaving).await
                {
                    tracing::error!(world = &*handle.id, %fault, "an idle world is still stored");
                }
            }
        }
    }

    /// Whether a caller may watch a world.
    fn sees(&self, caller: &Caller, handle: &WorldHandle) -> bool {
        handle
            .grants
            .rights(&caller.identity, &handle.id)
            .roles
            .contain(Role::Viewer)
    }

    fn next_stream(&self) -> u64 {
        self.next_stream.fetch_add(1, Ordering::Relaxed)
    }

    /// The body of a reference. Building one takes milliseconds, so it is done where waiting does no harm.
    async fn body(
        self: &Arc<Self>,
        field: &'static str,
        reference: &sinew_wire::types::BodyRef,
    ) -> Result<Arc<sinew_physics::body::Body>, Fault> {
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

impl Api {
    /// Answers a request that is done once, however often it comes under the same `request_id`. Once it has begun it is
    /// done to its end, also if its client does not wait for it: what is half done would differ from what is stored.
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

    /// The same for what takes long before it changes anything: without a `request_id` it is given up with its client.
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
        let key = repeats::Key {
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
        access_service_server::AccessServiceServer;
        control_service_server::ControlServiceServer;
        checkpoint_service_server::CheckpointServiceServer;
        history_service_server::HistoryServiceServer;
        recording_service_server::RecordingServiceServer;
        obstacle_service_server::ObstacleServiceServer;
        operation_service_server::OperationServiceServer;
    }
}

/// Completes when the server shuts down.
async fn stopped(stopping: &mut watch::Receiver<bool>) {
    // An error means that the sender is gone, which says the same.
    let _ = stopping.wait_for(|s| *s).await;
}

/// Who makes a call.
fn caller<T>(request: &Request<T>) -> Result<&Caller, Fault> {
    // `access::identify` has put it there, or the call has not come here.
    let caller = request.extensions().get::<Caller>();
    caller.ok_or_else(|| Fault::Internal("nobody knows who makes this call".into()))
}

/// Whose share a request takes.
fn client<T>(request: &Request<T>) -> Client {
    caller(request).map_or_else(|_| "".into(), |c| c.client.clone())
}

/// The bytes that a request has come with.
fn upload<T>(request: &Request<T>) -> Upload {
    let upload = request.extensions().get::<Upload>();
    upload.cloned().unwrap_or_default()
}

/// Work that may go on without its client: until it ends, its request is in memory.
async fn holding<T>(upload: Upload, work: impl Future<Output = T>) -> T {
    let _upload = upload;
    work.await
}

/// Bytes that converting a file takes meanwhile. They are found where there is time for it: its head may be long.
async fn memory(file: Bytes, rate_hz: Option<f64>) -> u64 {
    let found = tokio::task::spawn_blocking(move || retarget::memory(&file, rate_hz));
    found.await.unwrap_or(0)
}

/// The sender of a request, as commands of its world are ordered by.
fn origin<T>(request: &Request<T>) -> Origin {
    Origin {
        client: caller(request).map_or_else(|_| "".into(), |c| c.order.clone()),
        sequence: 0,
    }
}

/// A result as gRPC wants it; refusals are counted by reason.
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
