//! The only place in the server that builds and steps the physics: bodies, clips, worlds.
//!
//! The rest of the server goes through the types and functions named here, so that the seam between clock and physics
//! is one file.

use crate::ingest::time::SourceTime;
use crate::workers::Turn;
use sinew_physics::body::palm::load_point;
use sinew_physics::body::provenance::Provenance;
use sinew_physics::body::topology::{self, SEGMENT_NAMES};
use sinew_physics::body::{Body, DOF_COUNT, Posture, SEGMENT_COUNT, SegmentId, State};
use sinew_physics::collide::{MAX_OBSTACLES, ObstacleSetup, Other};
use sinew_physics::figure::motion::tasks::held_point;
use sinew_physics::figure::{
    Constrained, Constraint, ControlParams, ControllerKind, FigureOptions, HeldLoad, Perturbation,
    StrengthScale,
};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::{self, PlanarTransform, Recording, Target};
use sinew_physics::plan::contact_labels::label_postures;
use sinew_physics::plan::{PreparedRecording, ReadingReport, prepare_recording_unless};
use sinew_physics::reference::{FileFacts, Preparation, RetargetError, RetargetOptions, UpAxis};
use sinew_physics::setup::MAX_PERTURBATIONS;
use sinew_physics::strength::Strength;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{FigureSetup, WorldError, WorldParams};
use sinew_wire::status::Fault;
use sinew_wire::types::{
    BvhReading, ConstraintSettings, Disturbance, EventKind, FigureSettings, FigureSnapshot,
    Follows, MotionSource, Place, SecondSegment, WorldSettings,
};
use std::sync::Arc;

pub use sinew_physics::collide::ObstacleKey;
pub use sinew_physics::figure::{PlanRequest, Planning};
pub use sinew_physics::motion::Clip;
pub use sinew_physics::motion::builtin::BUILTIN_NAMES;
pub use sinew_physics::world::{
    ClipPlayback, Figure, FigureEvent, FigureKey, LivePlayback, MotionSource as Motion, World,
};

/// Builds a body; the fault names the field of the profile that its tables do not cover.
pub fn build_body(profile: sinew_physics::body::Profile) -> Result<Body, Fault> {
    use sinew_physics::body::model::BodyError;
    Body::humanoid(profile).map_err(|e| match e {
        BodyError::Profile { field, .. } => {
            let field = match field {
                "age" => "age_years",
                "height" => "height_m",
                "mass" => "mass_kg",
                other => other,
            };
            Fault::invalid(field, e.to_string())
        }
        other => Fault::invalid("", other.to_string()),
    })
}

/// A body as MuJoCo XML, with actuators as strong as the average person that the body represents.
pub fn mjcf(body: &Body) -> String {
    sinew_physics::body::export::mjcf(body, &Strength::for_body(body).actuation())
}

/// A body as URDF, with joints as strong as the average person that the body represents.
pub fn urdf(body: &Body) -> String {
    sinew_physics::body::export::urdf(body, &Strength::for_body(body).actuation())
}

/// A motion that comes with the program.
pub fn builtin(body: &Body, name: &str) -> Option<Clip> {
    sinew_physics::motion::builtin::builtin(body, name)
}

/// Prepares a motion for a body. It is given up once `stop` says so.
///
/// # Errors
/// A problem of the file or its motion, with `field` as the place of the source in the request; or the work was given
/// up.
pub fn prepare(
    field: &str,
    name: &str,
    source: &MotionSource,
    body: &Body,
    tempo: f64,
    stop: &dyn Fn() -> bool,
) -> Result<(Clip, Option<ReadingReport>), Fault> {
    match source {
        MotionSource::Bvh(bytes, reading) => {
            let refused = |e: RetargetError| match e {
                RetargetError::Stopped => Turn::gone(),
                other => Fault::invalid(format!("{field}.data"), other.to_string()),
            };
            let recording = motion::read(bytes).map_err(|e| refused(e.into()))?;
            let prepared =
                retarget(name, &recording, reading, body, tempo, stop).map_err(refused)?;
            Ok((prepared.clip, Some(prepared.report)))
        }
        MotionSource::Postures {
            rate_hz,
            postures,
            planted,
        } => {
            let planted = if planted.is_empty() {
                label_postures(body, postures, *rate_hz)
            } else {
                planted.clone()
            };
            let clip = Clip::from_postures(name, *rate_hz, postures.clone(), planted)
                .map_err(|e| Fault::invalid(format!("{field}.frames"), e.to_string()))?;
            Ok((clip, None))
        }
    }
}

/// How to read a file, and how to prepare its motion.
pub(super) fn options(
    name: &str,
    reading: &BvhReading,
    preparation: Preparation,
) -> RetargetOptions {
    let defaults = RetargetOptions::default();
    RetargetOptions {
        name: name.to_owned(),
        floor: reading.floor.unwrap_or(defaults.floor),
        cutoff_hz: reading.cutoff_hz.unwrap_or(defaults.cutoff_hz),
        file: FileFacts {
            unit_m: reading.unit_m,
            up: reading.z_up.map(|z| if z { UpAxis::Z } else { UpAxis::Y }),
            rate_hz: reading.rate_hz,
        },
        preparation,
        ..defaults
    }
}

/// A clip of `body` from a recording. The clip keeps the place and heading of the recording.
///
/// # Errors
/// Unusable input, with the bone, frame or figure; or the work was given up.
pub fn retarget(
    name: &str,
    recording: &Recording,
    reading: &BvhReading,
    body: &Body,
    tempo: f64,
    stop: &dyn Fn() -> bool,
) -> Result<PreparedRecording, RetargetError> {
    let defaults = Preparation::default();
    let preparation = Preparation {
        lock_feet: reading.lock_feet.unwrap_or(defaults.lock_feet),
        // Uploaded motions are simulated, and measured strength is not enough for running.
        walk_runs: reading.walk_runs.unwrap_or(true),
        ..defaults
    };
    let options = RetargetOptions {
        tempo,
        ..options(name, reading, preparation)
    };
    prepare_recording_unless(recording, body, &options, stop)
}

/// Quiet standing at a place: the zero pose with the soles on the ground.
pub fn standing(body: &Body, place: Place) -> Posture {
    Posture {
        root_position: Vec3 {
            x: place.x,
            y: place.y,
            z: body.standing_root_height(),
        },
        root_rotation: Quat::from_axis_angle(Vec3::Z, place.yaw),
        ..Posture::default()
    }
}

/// The place of a figure: its pelvis projected to the ground, and its heading.
pub fn place_of(posture: &Posture) -> Place {
    Place {
        x: posture.root_position.x,
        y: posture.root_position.y,
        yaw: posture.root_rotation.heading(),
    }
}

/// A refusal of the physics, with the place of its input in the request.
fn refused(prefix: &str, e: &WorldError) -> Fault {
    match e {
        WorldError::Range { field, .. } | WorldError::Interval { field, .. } => {
            Fault::invalid(format!("{prefix}.{field}"), e.to_string())
        }
        WorldError::TooManyPerturbations => Fault::Exhausted {
            limit: "max_perturbations_per_figure",
            value: MAX_PERTURBATIONS as u64,
            message: e.to_string(),
            retry: None,
        },
        WorldError::TooManyObstacles => Fault::Exhausted {
            limit: "max_obstacles_per_world",
            value: MAX_OBSTACLES as u64,
            message: e.to_string(),
            retry: None,
        },
        WorldError::TooManyConstraints | WorldError::Constraint(_) => {
            Fault::invalid(format!("{prefix}.constraints"), e.to_string())
        }
        WorldError::NotInOneHand => {
            Fault::invalid(format!("{prefix}.load.two_hands"), e.to_string())
        }
        WorldError::OtherHandHoldsLoad => Fault::Precondition {
            reason: "OTHER_HAND_HOLDS_LOAD",
            message: format!("{prefix}.{e}"),
            facts: vec![],
        },
        WorldError::FreePlane => Fault::invalid(format!("{prefix}.mobility"), e.to_string()),
        WorldError::UnknownFigure(_) | WorldError::UnknownObstacle(_) => {
            Fault::Internal(e.to_string())
        }
    }
}

/// A world with these settings.
pub fn new_world(s: &WorldSettings) -> Result<World, Fault> {
    World::new(WorldParams {
        rate_hz: s.rate_hz,
        substeps: s.substeps,
        gravity: s.gravity,
        friction: s.friction,
        collisions: s.collisions,
        ..WorldParams::default()
    })
    .map_err(|e| refused("world", &e))
}

/// Checks that a world with these settings would accept a figure, by adding a hidden one.
///
/// # Errors
/// The physics refuses the input.
pub fn check_figure(
    world: &WorldSettings,
    figure: &FigureSettings,
    body: Arc<Body>,
) -> Result<(), Fault> {
    let mut scratch = new_world(world)?;
    add_figure(&mut scratch, "figure", figure, body).map(|_| ())
}

/// Checks an obstacle; `new`: also whether there is room for it.
///
/// # Errors
/// The physics refuses the input.
pub fn check_obstacle(world: &World, setup: &ObstacleSetup, new: bool) -> Result<(), Fault> {
    let checked = world.check_obstacle(setup, new);
    checked.map_err(|e| refused_obstacle(&e))
}

/// World time of the first frame of the clip that a figure plays at `time`. `None` before that frame, and in the stand
/// after the clip.
pub fn playing_since(figure: &Figure, time: WorldTime) -> Option<WorldTime> {
    let Motion::Clip(play) = figure.drive() else {
        return None;
    };
    if figure.next_clip().is_some() {
        return None; // it is coming to a stand, or in a transition
    }
    let at = play.motion_time(time).0;
    let plays = at >= 0.0 && (play.looped || at <= play.clip.duration());
    plays.then_some(play.start)
}

/// Adds an obstacle.
pub fn add_obstacle(world: &mut World, setup: ObstacleSetup) -> Result<ObstacleKey, Fault> {
    world.add_obstacle(setup).map_err(|e| refused_obstacle(&e))
}

/// Replaces an obstacle.
pub fn update_obstacle(
    world: &mut World,
    key: ObstacleKey,
    setup: ObstacleSetup,
) -> Result<(), Fault> {
    world
        .update_obstacle(key, setup)
        .map_err(|e| refused_obstacle(&e))
}

fn refused_obstacle(e: &WorldError) -> Fault {
    match e {
        WorldError::Range { field, .. } => Fault::invalid(*field, e.to_string()),
        other => refused("obstacle", other),
    }
}

/// Schedules a perturbation.
pub fn perturb(world: &mut World, key: FigureKey, p: Perturbation) -> Result<(), Fault> {
    world
        .perturb(key, p)
        .map_err(|e| refused("perturbations", &e))
}

/// Checks a perturbation against the others that a figure has or is about to get.
///
/// # Errors
/// It is a load that the other hand is to help with, and that hand holds one at that time.
pub fn check_beside<'a>(
    prefix: &str,
    p: &Perturbation,
    mut others: impl Iterator<Item = &'a Perturbation>,
) -> Result<(), Fault> {
    if others.any(|o| p.wants_hand_of(o)) {
        return Err(refused(prefix, &WorldError::OtherHandHoldsLoad));
    }
    Ok(())
}

/// How many more perturbations a figure has room for.
pub fn perturbation_room(figure: &Figure) -> usize {
    MAX_PERTURBATIONS.saturating_sub(figure.perturbations().count())
}

/// Puts a figure into a state. Speeds beyond those of any body are limited.
pub fn reset(world: &mut World, key: FigureKey, mut state: State) -> Result<(), Fault> {
    const FASTEST: f64 = 200.0;
    for v in &mut state.velocity {
        *v = v.clamp(-FASTEST, FASTEST);
    }
    world
        .reset_figure(key, state)
        .map_err(|e| refused("figure", &e))
}

/// Changes strength, controller and the controller's options.
pub fn retune(
    world: &mut World,
    key: FigureKey,
    strength: StrengthScale,
    controller: ControllerKind,
    params: ControlParams,
) -> Result<(), Fault> {
    world
        .retune_figure(key, strength, controller, params)
        .map_err(|e| refused("figure", &e))
}

/// Changes fatigue, assist and help.
pub fn set_options(world: &mut World, key: FigureKey, options: FigureOptions) -> Result<(), Fault> {
    world
        .set_figure_options(key, options)
        .map_err(|e| refused("figure", &e))
}

/// Replaces the constraints of a figure from now on.
pub fn set_constraints(
    world: &mut World,
    key: FigureKey,
    all: &[ConstraintSettings],
) -> Result<(), Fault> {
    let now = world.time().0;
    let figure = world.figure(key);
    let body = Arc::clone(figure.expect("members are in the world").body());
    let all: Vec<_> = all
        .iter()
        .map(|c| Constraint {
            on: c.on.map_or(Constrained::CenterOfMass, |(s, point)| {
                Constrained::Point(s, point.unwrap_or_else(|| held_point(&body, s)))
            }),
            position: c.position,
            axes: c.axes,
            rotation: c.rotation,
            weight: c.weight,
            ease: c.ease,
            from: now,
            to: now + c.duration,
        })
        .collect();
    world
        .set_constraints(key, &all)
        .map_err(|e| refused("figure", &e))
}

/// The constraints that are active at world time `now`.
pub fn constraints(figure: &Figure, now: WorldTime) -> Vec<ConstraintSettings> {
    let now = now.0;
    let holds = figure.constraints().iter().filter(|c| c.to > now);
    holds
        .map(|c| ConstraintSettings {
            on: match c.on {
                Constrained::CenterOfMass => None,
                Constrained::Point(s, point) => Some((s, Some(point))),
            },
            position: c.position,
            axes: c.axes,
            rotation: c.rotation,
            weight: c.weight,
            ease: c.ease,
            duration: c.to - now,
        })
        .collect()
}

/// The sources of the numbers of a body and of its strength, by segment or DOF.
pub fn provenance(body: &Body) -> Vec<(&'static str, Provenance)> {
    let strength = Strength::for_body(body);
    let segments = (0..SEGMENT_COUNT).flat_map(|s| {
        body.segment_provenance(s)
            .into_iter()
            .map(move |p| (SEGMENT_NAMES[s], p))
    });
    let dofs = (0..DOF_COUNT).flat_map(|d| {
        let name = topology::DOF_NAMES[d];
        body.limit_provenance(d)
            .into_iter()
            .chain(strength.provenance(d).iter().cloned())
            .map(move |p| (name, p))
    });
    segments.chain(dofs).collect()
}

/// Names of the controllers and steppers that work in this build.
pub const CAPABILITIES: [&str; 6] = [
    "CONTROLLER_PAPER",
    "CONTROLLER_MODERN",
    "CONTROLLER_MOTORS",
    "STEPPER_TORQUE",
    "STEPPER_KINEMATIC",
    "STEPPER_STAGED",
];

/// Adds a figure, standing still at its place.
pub fn add_figure(
    world: &mut World,
    id: &str,
    s: &FigureSettings,
    body: Arc<Body>,
) -> Result<FigureKey, Fault> {
    let state = State::at_rest(standing(&body, s.place));
    let key = world
        .add_figure(FigureSetup {
            body,
            strength: s.strength.clone(),
            controller: s.controller,
            stepper: s.stepper,
            params: s.params.clone(),
            options: s.options,
            state,
            name: id.to_owned(),
        })
        .map_err(|e| refused("figure", &e))?;
    if let Err(fault) = set_constraints(world, key, &s.constraints) {
        world.remove_figure(key);
        return Err(fault);
    }
    Ok(key)
}

/// A clip that begins at a place at world time `start`. When played from standing, it includes its lead-in, which then
/// begins there.
pub fn playback(
    clip: Arc<Clip>,
    start: WorldTime,
    speed: f64,
    looped: bool,
    (at, standing): (Place, bool),
) -> ClipPlayback {
    let lead = if standing { clip.lead_in() } else { 0.0 };
    let origin = placing(place_of(&clip.sample(-lead).posture), at);
    ClipPlayback {
        clip,
        start: start + lead / speed,
        speed,
        looped,
        origin,
        way_in: None,
        rehearsed: None,
        again: false,
        max_help: 0.0,
    }
}

/// The transform that moves a motion beginning at `from` so that it begins at `to`.
pub fn placing(from: Place, to: Place) -> PlanarTransform {
    let turn = PlanarTransform {
        x: 0.0,
        y: 0.0,
        yaw: to.yaw - from.yaw,
    };
    let turned = turn.point(Vec3 {
        x: from.x,
        y: from.y,
        z: 0.0,
    });
    PlanarTransform {
        x: to.x - turned.x,
        y: to.y - turned.y,
        yaw: turn.yaw,
    }
}

/// First state of a clip that begins at a place.
pub fn first_state(clip: &Clip, at: Place) -> State {
    let target: Target = placing(place_of(clip.posture(0)), at).apply(&clip.sample(0.0));
    target.state()
}

/// The physics' perturbation for a disturbance that begins at world time `from`.
pub fn perturbation(body: &Body, what: &Disturbance, from: f64) -> Perturbation {
    match *what {
        Disturbance::Load {
            segment,
            point,
            mass,
            velocity,
            second,
            grip,
            duration,
        } => {
            let place = |s: SegmentId| load_point(body, s);
            let load = HeldLoad {
                segment,
                point: point.unwrap_or_else(|| place(segment)),
                mass,
                velocity,
                second: match second {
                    SecondSegment::Holds(s, p) => Some((s, p.unwrap_or_else(|| place(s)))),
                    SecondSegment::Never | SecondSegment::Helps(_) => None,
                },
                grip,
                from,
                to: from + duration,
            };
            match second {
                SecondSegment::Helps(when) => Perturbation::Helped { load, when },
                SecondSegment::Never | SecondSegment::Holds(..) => Perturbation::Held(load),
            }
        }
        Disturbance::Force {
            segment,
            point,
            force,
            duration,
        } => Perturbation::Force {
            segment,
            point: point.unwrap_or(body.segment(segment).com),
            force,
            from,
            to: from + duration,
        },
    }
}

/// A figure's event in the terms of the server. `name` gives the name of a touched object.
pub fn event_kind(e: &FigureEvent, name: impl Fn(Other) -> String) -> EventKind {
    let part = |o: Other| match o {
        Other::Figure(_, s) => Some(s),
        Other::Obstacle(_) => None,
    };
    match *e {
        FigureEvent::Touched { segment, other } => {
            EventKind::Touched(segment, name(other), part(other))
        }
        FigureEvent::Parted { segment, other } => {
            EventKind::Parted(segment, name(other), part(other))
        }
        FigureEvent::SupportGained { segment } => EventKind::SupportGained(segment),
        FigureEvent::SupportLost { segment } => EventKind::SupportLost(segment),
        FigureEvent::Saturated { dof } => EventKind::Saturated(dof.min(DOF_COUNT - 1)),
        FigureEvent::Relieved { dof } => EventKind::Relieved(dof.min(DOF_COUNT - 1)),
        FigureEvent::BalanceLost => EventKind::BalanceLost,
        FigureEvent::Recovered => EventKind::Recovered,
        FigureEvent::Fell => EventKind::Fell,
        FigureEvent::GotUp => EventKind::GotUp,
        FigureEvent::LoadTaken { segment, mass } => EventKind::LoadTaken(segment, mass),
        FigureEvent::LoadDropped { segment, mass } => EventKind::LoadDropped(segment, mass),
        FigureEvent::LoadSlipped { segment, mass } => EventKind::LoadSlipped(segment, mass),
        FigureEvent::WayBarred => EventKind::WayBarred,
        FigureEvent::ClipRestarts => EventKind::ClipRestarts,
        FigureEvent::ClipGivenUp => EventKind::ClipGivenUp,
        FigureEvent::LoadShared {
            segment,
            mass,
            hand,
            need,
        } => EventKind::LoadShared(segment, mass, hand, need),
        FigureEvent::LoadUnshared {
            segment,
            mass,
            hand,
            need,
        } => EventKind::LoadUnshared(segment, mass, hand, need),
        FigureEvent::Quarantined => EventKind::Quarantined,
    }
}

/// A figure after the tick of `dt` that began at world time `start`; its loads are those of that tick. `name` gives the
/// name of a touched object.
pub fn snapshot(
    figure: &Figure,
    (start, dt): (WorldTime, f64),
    applied: (i64, SourceTime),
    name: impl Fn(Other) -> String,
) -> FigureSnapshot {
    let soon = start + 1e-9 * dt; // as in the physics: a time on a tick boundary belongs to the tick that it begins
    let report = figure.report();
    let touches = report.map_or(&[][..], |r| &r.touches);
    FigureSnapshot {
        touched: touches.iter().map(|t| name(t.other)).collect(),
        body: figure.body().clone(),
        state: *figure.state(),
        report: report.cloned(),
        desired: figure.target().next.clone(),
        applied_sequence: applied.0,
        applied_source_ns: applied.1.0,
        loads: figure.held(soon).collect(),
        follows: follows(figure),
    }
}

/// How a figure follows its motion.
pub fn follows(figure: &Figure) -> Follows {
    Follows {
        so_far: *figure.following(),
        most_help: figure.allowed_help(),
    }
}
