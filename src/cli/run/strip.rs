//! The motion strip of `--strip`.

use super::scenario::Scenario;
use crate::args::{LoadSpec, short_name};
use crate::output::{extension, write};
use anyhow::{Context, Result};
use sinew_evaluate::strip::{StripFrame, StripOptions, Thing, draw, raster, svg};
use sinew_physics::collide::{Mobility, ObstacleSetup, Shape};
use sinew_physics::figure::Constraint;
use sinew_physics::math::{Quat, Vec3};
use std::path::Path;

/// A small ball at the target position of a constraint on all three axes that holds at `time` (s).
pub(super) fn goal_mark(c: &Constraint, time: f64) -> Option<Thing> {
    let holds = c.from <= time && time < c.to && c.axes == [1.0; 3];
    let setup = ObstacleSetup {
        position: c.position.filter(|_| holds)?,
        name: String::new(),
        shape: Shape::Sphere { radius: 0.03 },
        mobility: Mobility::Fixed,
        friction: 1.0,
        rotation: Quat::identity(),
        velocity: Vec3::zero(),
        angular_velocity: Vec3::zero(),
    };
    Some(Thing::obstacle(&setup))
}

/// Loads in the figure's hands at `time` (s). One that the other hand helps to carry is drawn where it was picked up.
pub(super) fn held_loads(scenario: &Scenario<'_>, time: f64) -> Vec<(usize, Vec3, f64)> {
    let held = |l: &&LoadSpec| l.from_s < time && time <= l.to_s && l.mass_kg > 0.0;
    let place = |l: &LoadSpec| {
        let load = l.perturbation(&scenario.body, f64::INFINITY).load();
        let shares = load.into_iter().flat_map(|l| l.shares());
        shares.map(|(s, p, kg)| (s.index(), p, kg))
    };
    scenario
        .args
        .load
        .iter()
        .filter(held)
        .flat_map(place)
        .collect()
}

/// Draws the frames side by side.
pub(super) fn write_strip(
    scenario: &Scenario<'_>,
    name: &str,
    frames: &[StripFrame],
    path: &Path,
) -> Result<()> {
    let args = scenario.args;
    let profile = scenario.body.profile;
    let mut title = format!(
        "{name}: {}, {:.2} m, {:.0} kg, strength {}",
        short_name(&profile),
        profile.height,
        profile.mass,
        args.strength
    );
    for l in &args.load {
        title += &format!(", {} kg in {}", l.mass_kg, l.segment.name());
    }
    for p in &args.push {
        title += &format!(", push {} N s at {} s", p.impulse_ns, p.at_s);
    }
    let options = StripOptions {
        view: args.view.into(),
        title,
        ..StripOptions::default()
    };
    let drawing = draw(&scenario.body, frames, &options);
    if extension("--strip", path, &["svg", "png"])? == "svg" {
        write(path, svg::write(&drawing))
    } else {
        let png =
            raster::png(&drawing).with_context(|| format!("cannot draw {}", path.display()))?;
        write(path, png)
    }
}
