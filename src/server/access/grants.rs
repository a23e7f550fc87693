//! The roles of principals in one world.

use super::caller::{Caller, EVERYONE, Identity};
use super::limits::Bucket;
use super::roles::{Role, Roles};
use crate::tick::hosted_world::bounds::Bound;
use sinew_physics::motion::GRAVITY;
use sinew_wire::status::Fault;
use sinew_wire::types::{Disturbance, FigureDisturbance};
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, PoisonError, RwLock};
use std::time::{Instant, SystemTime};
use tokio::sync::watch;

/// Grants of a world.
const MOST_GRANTS: usize = 256;
/// Highest priority of leases of owners and directors.
pub const TOP_PRIORITY: i32 = 100;
/// Seconds' worth of perturbations that may come at once.
const PERTURBATION_BURST_S: f64 = 10.0;

/// Time in which the largest force would stop a thrown load, s: the default duration of an impulse.
const CATCH_TIME: f64 = 0.1;

/// Limits of a perturber.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerturbationBounds {
    /// Largest force, N.
    pub force: f64,
    /// Largest mass of a load, kg.
    pub mass: f64,
    /// Perturbations per second in the long run.
    pub rate: f64,
}

impl PerturbationBounds {
    /// No limits except those of the calls.
    pub const NONE: Self = Self {
        force: f64::INFINITY,
        mass: f64::INFINITY,
        rate: f64::INFINITY,
    };

    /// Bounds as given; without a mass, its weight equals the force.
    pub fn new(force: Option<f64>, mass: Option<f64>, rate: Option<f64>) -> Self {
        let force = force.unwrap_or(f64::INFINITY);
        Self {
            force,
            mass: mass.unwrap_or(force / GRAVITY),
            rate: rate.unwrap_or(f64::INFINITY),
        }
    }

    /// The union of both permissions.
    fn or(self, other: Self) -> Self {
        Self {
            force: self.force.max(other.force),
            mass: self.mass.max(other.mass),
            rate: self.rate.max(other.rate),
        }
    }

    /// Checks the sizes of a batch.
    fn check(&self, batch: &[FigureDisturbance]) -> Result<(), (String, String)> {
        for (i, d) in batch.iter().enumerate() {
            let (what, value, most, unit) = match &d.what {
                Disturbance::Force { force, .. } => ("force", force.norm(), self.force, "N"),
                Disturbance::Load { mass, .. } => ("mass", *mass, self.mass, "kg"),
            };
            let mut all = vec![(what, value, most, unit)];
            if let Disturbance::Load { mass, velocity, .. } = &d.what {
                let most = self.force * CATCH_TIME;
                all.push(("load with a momentum", mass * velocity.norm(), most, "N·s"));
            }
            // Numbers from the wire are finite.
            for (what, value, most, unit) in all {
                if value > most {
                    let limit = format!(
                        "the grant allows a {what} of {most} {unit}, asked for were {value:.3}"
                    );
                    return Err((format!("perturbations[{i}]"), limit));
                }
            }
        }
        Ok(())
    }
}

/// Roles of one principal.
#[derive(Clone, Debug, PartialEq)]
pub struct Grant {
    /// Last part of its name.
    pub id: String,
    /// The principal to which it is given.
    pub principal: Arc<str>,
    /// Roles as they were given.
    pub roles: Vec<Role>,
    /// Figures to which the role of a driver applies; empty: all.
    pub figures: Vec<String>,
    /// Bounds of a perturber, as they were given: force (N), mass (kg), rate (1/s).
    pub bounds: Option<[Option<f64>; 3]>,
    /// Highest priority of a driver's leases.
    pub max_priority: i32,
    /// Time of creation.
    pub created: SystemTime,
    /// Time at which it ends.
    pub expires: Option<SystemTime>,
}

impl Grant {
    /// Full ownership of a principal's own world.
    pub fn owner(principal: Arc<str>) -> Self {
        Self {
            id: "creator".to_owned(),
            principal,
            roles: vec![Role::Owner],
            figures: Vec::new(),
            bounds: None,
            max_priority: 0,
            created: SystemTime::now(),
            expires: None,
        }
    }

    fn is_for(&self, identity: &Identity, now: SystemTime) -> bool {
        let whom = self.principal == identity.principal || &*self.principal == EVERYONE;
        whom && self.expires.is_none_or(|at| at > now)
    }
}

/// Changes to a grant; `None` leaves a field unchanged.
#[derive(Clone, Debug, Default)]
pub struct GrantUpdate {
    /// Roles.
    pub roles: Option<Vec<Role>>,
    /// Figures.
    pub figures: Option<Vec<String>>,
    /// Bounds.
    pub bounds: Option<Option<[Option<f64>; 3]>>,
    /// Priority.
    pub max_priority: Option<i32>,
    /// End.
    pub expires: Option<Option<SystemTime>>,
}

/// All permissions of a caller in a world.
#[derive(Clone, Debug)]
pub struct Rights {
    /// Its roles.
    pub roles: Roles,
    /// Figures that it may drive; `None`: all.
    pub figures: Option<Vec<String>>,
    /// Bounds of its perturbations.
    pub bounds: PerturbationBounds,
    /// Highest priority of its leases.
    pub max_priority: i32,
}

impl Rights {
    /// Whether it may drive a figure.
    pub fn drives(&self, figure: &str) -> bool {
        let named = |figures: &Vec<String>| figures.iter().any(|f| f == figure);
        self.roles.contain(Role::Driver) && self.figures.as_ref().is_none_or(named)
    }
}

/// A new grant with its name, if there is room for it.
fn admit(all: &BTreeMap<String, Grant>, world: &str, mut grant: Grant) -> Result<Grant, Fault> {
    if grant.id.is_empty() {
        grant.id = (1..)
            .map(|n| format!("grant-{n}"))
            .find(|id| !all.contains_key(id))
            .expect("there is a free number");
    }
    if all.contains_key(&grant.id) {
        return Err(Fault::Exists {
            kind: "grant",
            name: format!("worlds/{world}/grants/{}", grant.id),
        });
    }
    if all.len() >= MOST_GRANTS {
        return Err(Fault::Exhausted {
            limit: "max_grants_per_world",
            value: MOST_GRANTS as u64,
            message: "one more grant".into(),
            retry: None,
        });
    }
    Ok(grant)
}

/// The grants of one world.
#[derive(Debug)]
pub struct Grants {
    all: RwLock<BTreeMap<String, Grant>>,
    /// Changes whenever the grants change.
    version: watch::Sender<u64>,
    rates: Mutex<HashMap<Arc<str>, Bucket>>,
}

impl Grants {
    /// Those of a new world.
    pub fn new(first: Vec<Grant>) -> Self {
        Self {
            all: RwLock::new(first.into_iter().map(|g| (g.id.clone(), g)).collect()),
            version: watch::Sender::new(0),
            rates: Mutex::default(),
        }
    }

    fn read(&self) -> std::sync::RwLockReadGuard<'_, BTreeMap<String, Grant>> {
        self.all.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn write(&self) -> std::sync::RwLockWriteGuard<'_, BTreeMap<String, Grant>> {
        self.all.write().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tells when grants change.
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.version.subscribe()
    }

    /// End of the next grant to expire.
    pub fn next_end(&self) -> Option<SystemTime> {
        let now = SystemTime::now();
        self.read()
            .values()
            .filter_map(|g| g.expires)
            .filter(|at| *at > now)
            .min()
    }

    /// The permissions of a caller in this world, whose name is `world`.
    pub fn rights(&self, identity: &Identity, world: &str) -> Rights {
        let claimed = identity.claims.roles_in(world);
        let mut rights = Rights {
            roles: claimed,
            figures: (!claimed.contain(Role::Driver)).then(Vec::new),
            bounds: if claimed.contain(Role::Perturber) {
                PerturbationBounds::NONE
            } else {
                PerturbationBounds::new(Some(0.0), None, Some(0.0))
            },
            max_priority: 0,
        };
        let now = SystemTime::now();
        for grant in self.read().values().filter(|g| g.is_for(identity, now)) {
            let roles: Roles = grant.roles.iter().copied().collect();
            rights.roles = rights.roles.and(roles);
            if roles.contain(Role::Driver) {
                rights.max_priority = rights.max_priority.max(grant.max_priority);
                match &mut rights.figures {
                    _ if grant.figures.is_empty() => rights.figures = None,
                    Some(figures) => figures.extend(grant.figures.iter().cloned()),
                    None => {}
                }
            }
            if roles.contain(Role::Perturber) {
                let given = grant.bounds.map_or(PerturbationBounds::NONE, |[f, m, r]| {
                    PerturbationBounds::new(f, m, r)
                });
                rights.bounds = rights.bounds.or(given);
            }
        }
        if rights.roles.contain(Role::Director) {
            rights.figures = None;
            rights.bounds = PerturbationBounds::NONE;
            rights.max_priority = TOP_PRIORITY;
        }
        rights
    }

    /// Checks that each perturbation of a batch is within the bounds of a caller, and counts them. Returns the bound on
    /// their sum, which is checked by the code that knows the other forces; `None`: no bound.
    ///
    /// # Errors
    /// One is too strong, there are more than may come at once, or they come too often.
    pub fn admit(
        &self,
        caller: &Caller,
        rights: &Rights,
        batch: &[FigureDisturbance],
    ) -> Result<Option<Bound>, Fault> {
        let denied = |(field, message): (String, String)| Fault::Denied {
            reason: "PERTURBATION_BOUND",
            message: format!("{field}: {message}"),
            facts: vec![("field", field)],
        };
        rights.bounds.check(batch).map_err(denied)?;
        let PerturbationBounds { force, mass, rate } = rights.bounds;
        let bound = Bound {
            principal: caller.principal().clone(),
            force,
            mass,
        };
        let bound = (force.is_finite() || mass.is_finite()).then_some(bound);
        if rate.is_infinite() {
            return Ok(bound);
        }
        let now = Instant::now();
        let burst = (rate * PERTURBATION_BURST_S).max(1.0);
        if batch.len() as f64 > burst {
            let message = format!(
                "the grant allows {} at once, got {}",
                burst.floor(),
                batch.len()
            );
            return Err(denied(("perturbations".to_owned(), message)));
        }
        let mut rates = self.rates.lock().unwrap_or_else(PoisonError::into_inner);
        if rates.len() >= 4 * MOST_GRANTS {
            rates.clear(); // `*` may stand for any number of principals
        }
        let bucket = rates
            .entry(caller.principal().clone())
            .or_insert_with(|| Bucket::full(burst, now));
        let taken = bucket.take(batch.len() as f64, rate, burst, now);
        taken.map_err(|retry| Fault::Exhausted {
            limit: "max_rate_hz",
            value: rate.ceil() as u64,
            message: "perturbations of one principal, as its grant says".into(),
            retry: Some(retry),
        })?;
        Ok(bound)
    }

    /// The grant that [`Self::add`] would add.
    ///
    /// # Errors
    /// Those of [`Self::add`].
    pub fn would_add(&self, world: &str, grant: Grant) -> Result<Grant, Fault> {
        admit(&self.read(), world, grant)
    }

    /// Adds a grant; an empty name is chosen here.
    ///
    /// # Errors
    /// The name is taken, or there are too many.
    pub fn add(&self, world: &str, grant: Grant) -> Result<Grant, Fault> {
        let mut all = self.write();
        let grant = admit(&all, world, grant)?;
        all.insert(grant.id.clone(), grant.clone());
        drop(all);
        self.version.send_modify(|v| *v += 1);
        Ok(grant)
    }

    /// All of them, by name.
    pub fn list(&self) -> Vec<Grant> {
        self.read().values().cloned().collect()
    }

    /// One of them.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn get(&self, world: &str, id: &str) -> Result<Grant, Fault> {
        self.read()
            .get(id)
            .cloned()
            .ok_or_else(|| missing(world, id))
    }

    /// Changes one, if `same` accepts its present value; `only`: returns the result without changing it.
    ///
    /// # Errors
    /// There is none of that name; those of `same`.
    pub fn update(
        &self,
        world: &str,
        id: &str,
        (u, only): (GrantUpdate, bool),
        same: impl FnOnce(&Grant) -> Result<(), Fault>,
    ) -> Result<Grant, Fault> {
        let mut all = self.write();
        let kept = all.get_mut(id).ok_or_else(|| missing(world, id))?;
        same(kept)?;
        let mut grant = kept.clone();
        if let Some(roles) = u.roles {
            grant.roles = roles;
        }
        if let Some(figures) = u.figures {
            grant.figures = figures;
        }
        if let Some(bounds) = u.bounds {
            grant.bounds = bounds;
        }
        if let Some(priority) = u.max_priority {
            grant.max_priority = priority;
        }
        if let Some(expires) = u.expires {
            grant.expires = expires;
        }
        if only {
            return Ok(grant);
        }
        kept.clone_from(&grant);
        drop(all);
        self.version.send_modify(|v| *v += 1);
        Ok(grant)
    }

    /// Removes one, if `same` accepts its present value.
    ///
    /// # Errors
    /// There is none of that name; those of `same`.
    pub fn remove(
        &self,
        world: &str,
        id: &str,
        same: impl FnOnce(&Grant) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let mut all = self.write();
        same(all.get(id).ok_or_else(|| missing(world, id))?)?;
        all.remove(id);
        drop(all);
        self.version.send_modify(|v| *v += 1);
        Ok(())
    }
}

fn missing(world: &str, id: &str) -> Fault {
    Fault::not_found("grant", format!("worlds/{world}/grants/{id}"))
}
