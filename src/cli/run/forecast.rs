//! The forecast for a clip, printed beside its result.

use super::scenario::Scenario;
use sinew_physics::body::Links;
use sinew_physics::forecast::{Forecast, forecast};
use sinew_physics::motion::Clip;
use sinew_physics::strength::Strength;

/// The forecast for a clip with the strength and the loads of the scenario.
pub(super) fn of(scenario: &Scenario<'_>, clip: &Clip) -> Forecast {
    let (args, body) = (scenario.args, &scenario.body);
    let mut links = Links::new(body);
    let held = args.load.iter().filter(|l| l.from_s <= 0.0);
    for load in held.filter_map(|l| l.perturbation(body, f64::INFINITY).load()) {
        for (segment, point, mass) in load.shares() {
            links.add_load(segment, point, mass);
        }
    }
    let scale = &scenario.strength;
    let strength = Strength::at_percentile(body, scale.percentile);
    forecast(body, &links, &strength, scale, clip)
}

/// The forecast on one line.
pub(super) fn line(forecast: &Forecast) -> String {
    format!(
        "{:<14} forecast: {}, demand {:.2}: {}",
        "",
        forecast.verdict.name(),
        forecast.demand,
        forecast.reason
    )
}
