//! Worlds.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::{Overrun, Pace, WorldCondition, WorldInfo, WorldSettings, WorldUpdate};
use super::{count, display_name, or_default, timestamp, within};

/// Least and largest tick rate, Hz.
pub const RATE_HZ: (f64, f64) = (10.0, 1000.0);

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

/// Settings of a new world.
pub fn settings(w: Option<pb::World>) -> Result<WorldSettings, Fault> {
    let w = w.unwrap_or_default();
    let catch_up_limit = count("world.catch_up_limit", w.catch_up_limit, 5, 1, 100)?;
    Ok(WorldSettings {
        rate_hz: rate("world.rate_hz", w.rate_hz)?,
        substeps: substeps("world.substeps", w.substeps)?,
        gravity: within(
            "world.gravity_mps2",
            w.gravity_mps2.unwrap_or(9.81),
            0.0,
            30.0,
        )?,
        friction: within("world.friction", w.friction.unwrap_or(0.9), 0.05, 2.0)?,
        collisions: w.collisions.unwrap_or(true),
        pace: Pace {
            display_name: display_name("world.display_name", &w.display_name)?,
            overrun: overrun("world.overrun_policy", w.overrun_policy, catch_up_limit)?,
            catch_up_limit,
            speed: or_default("world.speed", w.speed, 1.0, 0.01, 10.0)?,
        },
    })
}

/// Changes of a world.
pub fn update(w: &pb::World, mask: Option<&prost_types::FieldMask>) -> Result<WorldUpdate, Fault> {
    let mut out = WorldUpdate::default();
    for (i, path) in super::mask_paths(mask)?.iter().enumerate() {
        match path.as_str() {
            "display_name" => {
                out.display_name = Some(display_name("world.display_name", &w.display_name)?)
            }
            "speed" => out.speed = Some(speed("world.speed", w.speed)?),
            "overrun_policy" => {
                out.overrun = Some(overrun("world.overrun_policy", w.overrun_policy, 5)?)
            }
            "catch_up_limit" => {
                out.catch_up_limit =
                    Some(count("world.catch_up_limit", w.catch_up_limit, 5, 1, 100)?);
            }
            other => {
                return Err(Fault::invalid(
                    format!("update_mask.paths[{i}]"),
                    format!(
                        "must be display_name, overrun_policy, catch_up_limit or speed, got {:?}",
                        super::shortened(other)
                    ),
                ));
            }
        }
    }
    Ok(out)
}

/// A world for a response.
pub fn world_out(w: &WorldInfo) -> pb::World {
    let pace = &w.settings.pace;
    let (state, failure) = match &w.condition {
        WorldCondition::Running => (pb::WorldState::Running, String::new()),
        WorldCondition::Paused => (pb::WorldState::Paused, String::new()),
        WorldCondition::Failed(why) => (pb::WorldState::Failed, why.clone()),
    };
    pb::World {
        name: format!("worlds/{}", w.id),
        display_name: pace.display_name.clone(),
        rate_hz: w.settings.rate_hz,
        substeps: w.settings.substeps as i32,
        gravity_mps2: Some(w.settings.gravity),
        friction: Some(w.settings.friction),
        collisions: Some(w.settings.collisions),
        overrun_policy: match pace.overrun {
            Overrun::Skip => pb::OverrunPolicy::Skip,
            Overrun::CatchUp(_) => pb::OverrunPolicy::CatchUp,
            Overrun::Dilate => pb::OverrunPolicy::Dilate,
        }
        .into(),
        catch_up_limit: pace.catch_up_limit as i32,
        speed: pace.speed,
        state: state.into(),
        tick: w.tick as i64,
        time_s: w.time,
        figure_count: w.figures as i32,
        epoch: w.epoch,
        create_time: Some(timestamp(w.created)),
        failure,
    }
}
