//! Worlds.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::{
    Overrun, WorldCondition, WorldInfo, WorldPace, WorldSettings, WorldUpdate,
};
use super::masks::MaskFields;
use super::names::WORLD;
use super::{count, display_name, etags, or_default, timestamp, within};
use sinew_physics::world::WorldParams;
use std::time::Duration;

/// Least and largest tick rate, Hz.
pub const RATE_HZ: (f64, f64) = (10.0, 1000.0);

/// Least and longest time after which an idle world is deleted.
const IDLE_TTL: (Duration, Duration) = (
    Duration::from_secs(1),
    Duration::from_secs(30 * 24 * 60 * 60),
);

fn overrun(field: &str, value: i32, limit: u32) -> Result<Overrun, Fault> {
    match pb::OverrunPolicy::try_from(value) {
        Ok(pb::OverrunPolicy::Unspecified | pb::OverrunPolicy::Skip) => Ok(Overrun::Skip),
        Ok(pb::OverrunPolicy::CatchUp) => Ok(Overrun::CatchUp(limit)),
        Ok(pb::OverrunPolicy::Dilate) => Ok(Overrun::Dilate),
        Err(_) => Err(Fault::invalid(field, format!("{value} is not a policy"))),
    }
}

/// Tick rate, Hz; 0 stands for 60.
pub fn rate(field: &str, value: f64) -> Result<f64, Fault> {
    or_default(field, value, 60.0, RATE_HZ.0, RATE_HZ.1)
}

/// Substeps; 0 stands for 2.
pub fn substeps(field: &str, value: i32) -> Result<u32, Fault> {
    count(field, value, 2, 1, 16)
}

/// Speed of world time.
pub fn speed(field: &str, value: f64) -> Result<f64, Fault> {
    within(field, value, 0.01, 10.0)
}

fn catch_up(w: &pb::World) -> Result<u32, Fault> {
    count(
        "world.catch_up_tick_count",
        w.catch_up_tick_count,
        5,
        1,
        100,
    )
}

/// Settings of a new world.
pub fn settings(w: Option<pb::World>) -> Result<WorldSettings, Fault> {
    let w = w.unwrap_or_default();
    let catch_up_limit = catch_up(&w)?;
    let default = WorldParams::default();
    Ok(WorldSettings {
        rate_hz: rate("world.rate_hz", w.rate_hz)?,
        substeps: substeps("world.substep_count", w.substep_count)?,
        gravity: within(
            "world.gravity_mps2",
            w.gravity_mps2.unwrap_or(default.gravity),
            0.0,
            30.0,
        )?,
        friction: within(
            "world.friction",
            w.friction.unwrap_or(default.friction),
            0.05,
            2.0,
        )?,
        collisions: w.collisions.unwrap_or(true),
        pace: WorldPace {
            display_name: display_name("world.display_name", &w.display_name)?,
            overrun: overrun("world.overrun_policy", w.overrun_policy, catch_up_limit)?,
            catch_up_limit,
            speed: or_default("world.speed", w.speed, 1.0, 0.01, 10.0)?,
            idle_ttl: idle_ttl("world.idle_ttl", w.idle_ttl.as_ref())?,
        },
    })
}

/// Whether a request could have contained these settings.
pub fn is_pace(pace: &WorldPace) -> bool {
    let caught_up = match pace.overrun {
        Overrun::CatchUp(most) => most,
        Overrun::Skip | Overrun::Dilate => pace.catch_up_limit,
    };
    let counts = [pace.catch_up_limit, caught_up];
    display_name("", &pace.display_name).is_ok()
        && counts.iter().all(|c| (1..=100).contains(c))
        && speed("", pace.speed).is_ok()
        && (pace.idle_ttl).is_none_or(|ttl| (IDLE_TTL.0..=IDLE_TTL.1).contains(&ttl))
}

/// Time for which a world may be idle; `None`: for ever.
pub fn idle_ttl(
    field: &str,
    ttl: Option<&prost_types::Duration>,
) -> Result<Option<Duration>, Fault> {
    let Some(ttl) = ttl.filter(|t| t.seconds != 0 || t.nanos != 0) else {
        return Ok(None);
    };
    match super::duration(ttl).filter(|t| (IDLE_TTL.0..=IDLE_TTL.1).contains(t)) {
        Some(ttl) => Ok(Some(ttl)),
        None => Err(Fault::invalid(field, "must be 1 s…30 d, or 0 for never")),
    }
}

/// Changes of a world.
pub fn update(w: &pb::World, mask: Option<&prost_types::FieldMask>) -> Result<WorldUpdate, Fault> {
    let fields = MaskFields {
        settable: &[
            ("display_name", !w.display_name.is_empty()),
            ("overrun_policy", w.overrun_policy != 0),
            ("catch_up_tick_count", w.catch_up_tick_count != 0),
            ("speed", w.speed != 0.0),
            ("idle_ttl", w.idle_ttl.is_some()),
        ],
        fixed: &[
            "rate_hz",
            "substep_count",
            "gravity_mps2",
            "friction",
            "collisions",
        ],
        output: &[
            "name",
            "state",
            "tick",
            "time_s",
            "figure_count",
            "epoch",
            "create_time",
            "failure",
            "etag",
        ],
    };
    let mut out = WorldUpdate::default();
    for field in fields.taken(mask)? {
        match field {
            "display_name" => {
                out.display_name = Some(display_name("world.display_name", &w.display_name)?)
            }
            "speed" => out.speed = Some(or_default("world.speed", w.speed, 1.0, 0.01, 10.0)?),
            "overrun_policy" => {
                out.overrun = Some(overrun("world.overrun_policy", w.overrun_policy, 5)?)
            }
            "catch_up_tick_count" => out.catch_up_limit = Some(catch_up(w)?),
            _ => out.idle_ttl = Some(idle_ttl("world.idle_ttl", w.idle_ttl.as_ref())?),
        }
    }
    Ok(out)
}

/// Checks the etag of a request, if it has one.
///
/// # Errors
/// The world has changed.
pub fn check_etag(now: &WorldInfo, sent: &str) -> Result<(), Fault> {
    etags::check(&WORLD.name([&now.id]), sent, || world_out(now).etag)
}

/// A world for a response.
pub fn world_out(w: &WorldInfo) -> pb::World {
    let pace = &w.settings.pace;
    let (state, failure) = match &w.condition {
        WorldCondition::Running => (pb::WorldState::Running, String::new()),
        WorldCondition::Paused => (pb::WorldState::Paused, String::new()),
        WorldCondition::Failed(why) => (pb::WorldState::Failed, why.clone()),
    };
    let mut out = pb::World {
        name: WORLD.name([&w.id]),
        display_name: pace.display_name.clone(),
        rate_hz: w.settings.rate_hz,
        substep_count: w.settings.substeps as i32,
        gravity_mps2: Some(w.settings.gravity),
        friction: Some(w.settings.friction),
        collisions: Some(w.settings.collisions),
        overrun_policy: match pace.overrun {
            Overrun::Skip => pb::OverrunPolicy::Skip,
            Overrun::CatchUp(_) => pb::OverrunPolicy::CatchUp,
            Overrun::Dilate => pb::OverrunPolicy::Dilate,
        }
        .into(),
        catch_up_tick_count: pace.catch_up_limit as i32,
        speed: pace.speed,
        state: state.into(),
        tick: w.tick as i64,
        time_s: w.time,
        figure_count: w.figures as i32,
        epoch: w.epoch,
        create_time: Some(timestamp(w.created)),
        failure,
        idle_ttl: pace.idle_ttl.and_then(|ttl| ttl.try_into().ok()),
        etag: String::new(),
    };
    out.etag = etags::world(&out);
    out
}
