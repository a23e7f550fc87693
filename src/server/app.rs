//! The state of the server that its services share, and how a caller enters a world.

use crate::access::Access;
use crate::access::caller::Caller;
use crate::access::roles::{Role, Rule};
use crate::checkpoints::Checkpoints;
use crate::config::Config;
use crate::encoded::Encoded;
use crate::late_viewers::LateViewers;
use crate::library::{Bodies, Clips};
use crate::operations::{self as long_work, Operations};
use crate::persistence::Persistence;
use crate::recordings::Recordings;
use crate::repeats::{Repeats, to_the_end};
use crate::shares::Places;
use crate::workers::Pool;
use crate::worlds::{Leaving, Registry, WorldHandle};
use sinew_wire::convert::world_name;
use sinew_wire::status::Fault;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant, SystemTime};
use tokio::sync::watch;
use tonic::Request;

/// How often the server looks for worlds that have been idle for too long.
const IDLE_LOOK: Duration = Duration::from_millis(250);

/// The state that the services share.
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
    /// Recordings: kept parts of the past of worlds.
    pub recordings: Arc<Recordings>,
    /// Converts files to clips.
    pub conversions: Pool,
    /// Simulates clips.
    pub simulations: Pool,
    /// Identities and roles.
    pub access: Arc<Access>,
    /// The data directory.
    pub persistence: Option<Arc<Persistence>>,
    /// Long work that continues without a waiting client.
    pub(crate) operations: Arc<Operations<Encoded>>,
    /// Recent requests by name, with their answers.
    pub(crate) repeats: Arc<Repeats>,
    /// When the server started.
    pub started: SystemTime,
    /// Turns true when streams have to end.
    pub(crate) stopping: watch::Receiver<bool>,
    /// Viewers that are shown the past.
    pub(crate) late: LateViewers,
    pub(crate) viewers: Places,
    pub(crate) drivers: Places,
    next_stream: AtomicU64,
}

impl App {
    /// An application without worlds; [`restore`](Self::restore) brings back those of the data directory.
    ///
    /// # Errors
    /// The built-in data cannot be prepared, the data directory cannot be used, or a certificate or key cannot be used.
    pub fn new(config: Arc<Config>, stopping: watch::Receiver<bool>) -> Result<Self, Fault> {
        crate::telemetry::metrics();
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
            operations: Operations::new(long_work::OperationLimits {
                most: config.max_operations,
                share,
                bytes: config.max_operation_bytes,
                ttl: Duration::from_secs_f64(config.operation_ttl_s),
            }),
            repeats: Repeats::new(config.max_request_ids, share),
            started: SystemTime::now(),
            stopping,
            late: LateViewers::default(),
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

    /// Reason why new clients should go elsewhere. It names no worlds, because not everyone may know their names.
    pub fn unready(&self) -> Option<String> {
        if self.worlds.is_draining() {
            return Some("shutting down".into());
        }
        match self.worlds.stuck().len() {
            0 => None,
            n => Some(format!("ticks that do not end: {n}")),
        }
    }

    /// Waits until the changes of a world are on disk, even if the client goes away: a half-written state would differ
    /// from the one in memory.
    pub(crate) async fn stored(&self, handle: &Arc<WorldHandle>) -> Result<(), Fault> {
        let Some(persistence) = self.persistence.clone() else {
            return Ok(());
        };
        let handle = handle.clone();
        to_the_end(async move { persistence.changed(&handle).await }).await
    }

    /// Writes a new world to disk, whether or not its client waits; a world that cannot be written is ended again.
    /// Called before any other wait, because others can see the world already.
    pub(crate) async fn written(self: &Arc<Self>, handle: &Arc<WorldHandle>) -> Result<(), Fault> {
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

    /// A world by the last part of its name. A world in quarantine is refused with that reason.
    pub(crate) fn existing(&self, id: &str) -> Result<Arc<WorldHandle>, Fault> {
        self.worlds.get(id).map_err(|missing| {
            let quarantined = self.persistence.as_ref().map(|p| p.check(id));
            quarantined.and_then(Result::err).unwrap_or(missing)
        })
    }

    /// Refuses to create something in a world that has been deleted.
    pub(crate) fn still_there(&self, handle: &WorldHandle) -> Result<(), Fault> {
        match self.worlds.holds(handle) {
            true => Ok(()),
            false => Err(handle.ended()),
        }
    }

    /// The world of this name, for a caller with the role there that its call needs.
    pub(crate) fn world<T>(
        &self,
        request: &Request<T>,
        field: &str,
        name: &str,
    ) -> Result<Arc<WorldHandle>, Fault> {
        let id = world_name(field, name)?;
        self.enter(caller(request)?, id)
    }

    /// World and last part of the name of a figure, for a caller with the role that its call needs; a driver must be
    /// one of that figure.
    pub(crate) fn figure<'a, T>(
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
    pub(crate) fn enter(&self, caller: &Caller, id: &str) -> Result<Arc<WorldHandle>, Fault> {
        self.enter_for(caller, id, &[])
    }

    /// The world, for a caller with the role that its call needs, for these figures.
    pub(crate) fn enter_for(
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
            // Do not reveal whether the world exists to a caller without permission.
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

    /// The world, for a caller with this role there, for these figures.
    pub(crate) fn admit(
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

    /// The world, for a caller with this role there, whatever role its call needs.
    pub(crate) fn enter_as(
        &self,
        caller: &Caller,
        role: Role,
        id: &str,
    ) -> Result<Arc<WorldHandle>, Fault> {
        match self.existing(id) {
            Ok(handle) => self.admit(caller, handle, (role, &[])),
            Err(fault) => caller.check_claim(role, id).and(Err(fault)),
        }
    }

    /// Ends this very world, and not another one of its name, also on disk. `by`: the caller or the reason.
    pub(crate) async fn delete(
        self: &Arc<Self>,
        handle: &Arc<WorldHandle>,
        by: &str,
    ) -> Result<(), Fault> {
        let (app, handle, by) = (self.clone(), handle.clone(), by.to_owned());
        to_the_end(async move {
            let same = |there: &Arc<WorldHandle>| Arc::ptr_eq(there, &handle);
            let leaving = app.worlds.delete_if(&handle.id, &by, same).await?;
            let missing = || Fault::not_found("world", format!("worlds/{}", handle.id));
            app.forget_world(leaving.ok_or_else(missing)?).await
        })
        .await
    }

    /// Forgets the stored data of a world that has ended. Until then no other world can have its name.
    pub(crate) async fn forget_world(&self, leaving: Leaving) -> Result<(), Fault> {
        let handle = &leaving.handle;
        self.checkpoints.forget_world(&handle.id);
        self.recordings.forget_world(&handle.id);
        match &self.persistence {
            Some(persistence) => persistence.deleted(handle).await,
            None => Ok(()),
        }
    }

    /// Ends worlds that have been idle for longer than they may be; never returns.
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
                // A world used since then is kept. If someone else deletes it first, there is nothing left to do.
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
    pub(crate) fn sees(&self, caller: &Caller, handle: &WorldHandle) -> bool {
        handle
            .grants
            .rights(&caller.identity, &handle.id)
            .roles
            .contain(Role::Viewer)
    }

    pub(crate) fn next_stream(&self) -> u64 {
        self.next_stream.fetch_add(1, Ordering::Relaxed)
    }

    /// The body of a reference. Building one takes milliseconds, so it is done on a blocking thread.
    pub(crate) async fn body(
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

/// Completes when the server shuts down.
pub(crate) async fn stopped(stopping: &mut watch::Receiver<bool>) {
    // An error means that the sender is gone, which says the same.
    let _ = stopping.wait_for(|s| *s).await;
}

/// The caller of a request.
pub(crate) fn caller<T>(request: &Request<T>) -> Result<&Caller, Fault> {
    // `access::identify` has put it there for every call that gets here.
    let caller = request.extensions().get::<Caller>();
    caller.ok_or_else(|| Fault::Internal("nobody knows who makes this call".into()))
}
