//! Rehearsals of clips for figures: the figure for which a clip is rehearsed, the work itself, and its result.

use super::engine::{self, Clip};
use super::workers::Turn;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use sinew_physics::body::{Body, Links, Profile};
use sinew_physics::figure::{FigureOptions, HeldLoad, Perturbation, StrengthScale};
use sinew_physics::forecast::forecast;
use sinew_physics::motion::{self, Target};
use sinew_physics::plan::prepare_recording_unless;
use sinew_physics::reference::{Preparation, RetargetError};
use sinew_physics::rehearsal::follow::{FollowResult, FollowWay, RehearsalOptions, follow};
use sinew_physics::rehearsal::{Conditions, Progress, TrackingReference};
use sinew_physics::stepper::pelvis_wrench::RootStep;
use sinew_physics::strength::Strength;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{Figure, RehearsedMotion, WorldParams};
use sinew_wire::status::Fault;
use sinew_wire::types::{BvhReading, FollowSettings, MotionSource, RehearsalHelp, RehearsalInfo};
use std::borrow::Cow;
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

/// The figure for which a clip is rehearsed, as it is in its world.
#[derive(Clone, Debug)]
pub struct Performer {
    body: Arc<Body>,
    /// With the loads that it holds.
    links: Links,
    strength: StrengthScale,
    loads: Vec<Perturbation>,
    world: WorldParams,
}

impl Performer {
    /// A figure of a world.
    ///
    /// # Errors
    /// It holds one load in both hands, or may do so.
    pub fn of(figure: &Figure, world: &WorldParams, time: WorldTime) -> Result<Self, Fault> {
        let time = time.0;
        let holds = |p: &Perturbation| p.load().filter(|l| l.from <= time && time < l.to);
        let held: Vec<HeldLoad> = figure.perturbations().filter_map(holds).collect();
        let helped = |p: &Perturbation| matches!(p, Perturbation::Helped { .. });
        let may_be = figure.perturbations().filter(|p| helped(p));
        if held.iter().any(|l| l.second.is_some()) || may_be.filter_map(holds).next().is_some() {
            return Err(Fault::Precondition {
                reason: "LOAD_IN_TWO_HANDS",
                message: "a load that is, or may be, held in two hands cannot be rehearsed yet"
                    .into(),
                facts: vec![],
            });
        }
        // A load that is held now is held throughout.
        let always = |load: HeldLoad| {
            Perturbation::Held(HeldLoad {
                from: 0.0,
                to: f64::INFINITY,
                ..load
            })
        };
        Ok(Self {
            body: Arc::clone(figure.body()),
            links: figure.links().clone(),
            strength: figure.setup().strength.clone(),
            loads: held.into_iter().map(always).collect(),
            world: *world,
        })
    }

    /// Whether a rehearsal for one is also valid for the other.
    pub fn is_like(&self, other: &Self) -> bool {
        self.body.profile == other.body.profile
            && self.links == other.links
            && self.strength == other.strength
            && self.decisive() == other.decisive()
    }

    /// The parameters of its world that affect a rehearsal.
    fn decisive(&self) -> [f64; 4] {
        let w = &self.world;
        [w.rate_hz, f64::from(w.substeps), w.gravity, w.friction]
    }

    fn conditions(&self) -> Conditions {
        Conditions {
            body: Arc::clone(&self.body),
            world: WorldParams {
                threads: 1,
                collisions: false,
                ..self.world
            },
            strength: self.strength.clone(),
            options: FigureOptions::default(),
            perturbations: self.loads.clone(),
            live_window: None,
            rehearsed: None,
        }
    }
}

/// The result of a rehearsal.
#[derive(Clone, Debug)]
pub struct Rehearsed {
    /// The figure for which it is valid.
    pub performer: Performer,
    /// Whether it contains help.
    pub helps: bool,
    /// The motion to play.
    pub motion: Arc<RehearsedMotion>,
    /// Time of the result, ms since 1970: the oldest are forgotten first.
    pub found_ms: u64,
}

/// A rehearsal in stored form.
#[derive(Serialize, Deserialize)]
struct StoredRehearsal<'a> {
    /// Version of the server that found it: its corrections are only valid for that simulator.
    version: Cow<'a, str>,
    profile: Profile,
    links: Cow<'a, Links>,
    strength: Cow<'a, StrengthScale>,
    loads: Cow<'a, [Perturbation]>,
    world: WorldParams,
    helps: bool,
    found_ms: u64,
    motion: Cow<'a, RehearsedMotion>,
}

/// The version of this server.
const VERSION: &str = env!("CARGO_PKG_VERSION");

impl Rehearsed {
    /// The rehearsal in stored form.
    pub fn to_bytes(&self) -> Vec<u8> {
        let p = &self.performer;
        postcard::to_stdvec(&StoredRehearsal {
            version: VERSION.into(),
            profile: p.body.profile,
            links: Cow::Borrowed(&p.links),
            strength: Cow::Borrowed(&p.strength),
            loads: Cow::Borrowed(&p.loads),
            world: p.world,
            helps: self.helps,
            found_ms: self.found_ms,
            motion: Cow::Borrowed(&self.motion),
        })
        .expect("values in memory can be written")
    }

    /// Reads a stored rehearsal.
    ///
    /// # Errors
    /// The bytes cannot have been written by a server, or another version has found it.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Fault> {
        let cannot = |why: &str| Fault::Internal(format!("a rehearsal that cannot be used: {why}"));
        // The version stands first, because the format of the rest depends on it.
        let (version, _): (Cow<'_, str>, _) =
            postcard::take_from_bytes(bytes).map_err(|e| cannot(&e.to_string()))?;
        if version != VERSION {
            return Err(cannot(&format!("version {version:.20} has found it")));
        }
        let stored: StoredRehearsal<'_> =
            postcard::from_bytes(bytes).map_err(|e| cannot(&e.to_string()))?;
        if !(stored.links.is_valid() && stored.motion.is_valid()) {
            return Err(cannot("no rehearsal is like that"));
        }
        Ok(Self {
            performer: Performer {
                body: Arc::new(engine::build_body(stored.profile)?),
                links: stored.links.into_owned(),
                strength: stored.strength.into_owned(),
                loads: stored.loads.into_owned(),
                world: stored.world,
            },
            helps: stored.helps,
            motion: Arc::new(stored.motion.into_owned()),
            found_ms: stored.found_ms,
        })
    }

    /// A short name of the figure for which it is valid, the same for all that are alike ([`Performer::is_like`]).
    pub fn figure(&self) -> String {
        let p = &self.performer;
        let like = (&p.body.profile, &p.links, &p.strength, p.decisive());
        let bytes = postcard::to_stdvec(&like).expect("values in memory can be written");
        hex::encode(&Sha256::digest(bytes)[..8])
    }

    /// Approximate bytes in memory.
    pub fn bytes(&self) -> u64 {
        let m = &self.motion;
        (m.desired.len() * size_of::<Target>() + m.path.len() * size_of::<RootStep>()) as u64
    }
}

/// The forms of a recording.
struct RehearsalForms {
    reference: TrackingReference,
    /// The clip that is rehearsed.
    as_recorded: Arc<Clip>,
}

/// The source from which a clip is rehearsed.
#[derive(Debug)]
pub struct Score {
    /// Last part of its name.
    pub id: String,
    /// Its source; `None`: it is built in.
    pub source: Option<MotionSource>,
    /// Tells it from all others that have had this name.
    pub number: u64,
}

impl Score {
    fn forms(&self, body: &Body, stop: &dyn Fn() -> bool) -> Result<RehearsalForms, Fault> {
        if let Some(MotionSource::Bvh(bytes, reading)) = &self.source {
            return self.recorded(bytes, reading, body, stop);
        }
        let clip = match &self.source {
            None => engine::builtin(body, &self.id)
                .ok_or_else(|| Fault::not_found("clip", format!("clips/{}", self.id)))?,
            Some(source) => engine::prepare("clip", &self.id, source, body, 1.0, stop)?.0,
        };
        let clip = Arc::new(clip);
        Ok(RehearsalForms {
            reference: TrackingReference::authored(Arc::clone(&clip)),
            as_recorded: clip,
        })
    }

    fn recorded(
        &self,
        bytes: &[u8],
        reading: &BvhReading,
        body: &Body,
        stop: &dyn Fn() -> bool,
    ) -> Result<RehearsalForms, Fault> {
        let recording = motion::read(bytes).map_err(|e| Fault::invalid("clip", e.to_string()))?;
        let fitted = |preparation: Preparation| {
            let options = engine::options(&self.id, reading, preparation);
            prepare_recording_unless(&recording, body, &options, stop).map_err(|e| match e {
                RetargetError::Stopped => Turn::gone(),
                other => Fault::invalid("clip", other.to_string()),
            })
        };
        let prepared = fitted(Preparation::walking(false))?;
        Ok(RehearsalForms {
            reference: TrackingReference {
                phases: prepared.report.feet.phases.clone(),
                recorded: Arc::new(fitted(Preparation::NONE)?.clip),
                prepared: Arc::new(prepared.clip),
            },
            as_recorded: Arc::new(fitted(Preparation::REHEARSED)?.clip),
        })
    }
}

/// Rehearses a clip, on one thread. `go_on` gets the share of the search that is done, and stops the search with
/// `false`: the best motion until then is the result. `stop` gives it up.
///
/// # Errors
/// The clip cannot be rehearsed, or it was given up.
pub fn rehearse(
    score: &Score,
    performer: &Performer,
    settings: FollowSettings,
    stop: &dyn Fn() -> bool,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<(RehearsalInfo, Option<Rehearsed>), Fault> {
    let forms = score.forms(&performer.body, stop)?;
    let conditions = performer.conditions();
    let strength = Strength::at_percentile(&performer.body, performer.strength.percentile);
    let said = forecast(
        &performer.body,
        &performer.links,
        &strength,
        &performer.strength,
        &forms.reference.prepared,
    );
    let options = RehearsalOptions {
        follow: settings.follow,
        most_help: settings.most_help(),
        ..RehearsalOptions::default()
    };
    let polish = options.settings.trials.polish.rounds;
    let mut told = |p: &Progress| go_on(share(p, polish));
    let clip = (&*forms.as_recorded, &said);
    let found = follow(&conditions, &forms.reference, clip, &options, &mut told)
        .map_err(|e| Fault::invalid("clip", e.to_string()))?;
    if stop() {
        return Err(Turn::gone());
    }
    let info = info(&found);
    let rehearsed = found.motion.map(|motion| Rehearsed {
        performer: performer.clone(),
        helps: info.way == FollowWay::Helped,
        motion,
        found_ms: SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .map_or(0, |d| d.as_millis() as u64),
    });
    Ok((info, rehearsed))
}

/// Half for reaching the end of the clip, half for the rounds after that.
fn share(p: &Progress, polish: usize) -> f64 {
    let [reached, all] = p.reached.map(|n| n as f64);
    let polished = p.polished as f64 / polish.max(1) as f64;
    0.5 * reached / all.max(1.0) + 0.5 * polished.min(1.0)
}

fn info(found: &FollowResult) -> RehearsalInfo {
    let report = found.followed.rehearsal.clone().unwrap_or_default();
    let trial = &found.trial;
    RehearsalInfo {
        way: found.followed.way,
        reason: found.followed.reason.clone(),
        lost_at: trial.lost_at,
        error: [1e-3 * trial.global_mm, 1e-3 * trial.root_relative_mm],
        help: match &found.helped {
            Some(live) => RehearsalHelp {
                impulse: live.impulse,
                share: trial.help.share,
                most_force: trial.help.most,
                most_moment: trial.help.most_moment,
                acts: live.acts,
            },
            None => RehearsalHelp {
                impulse: report.help_ns,
                share: report.help_share,
                most_force: report.help_most_n,
                most_moment: report.help_most_nm,
                acts: report.helped_windows,
            },
        },
        hardest: (report.hardest_dof, report.hardest_share),
        stopped: report.stopped,
        begins_in_motion: found.motion.as_ref().is_some_and(|m| !m.begins_at_rest()),
    }
}
