//! The input of the experiments of `sinew walking`.

use sinew_physics::body::Body;
use sinew_physics::motion::Clip;
use sinew_physics::reference::RetargetOptions;
use std::sync::Arc;

/// A motion, and the arguments that it was loaded with.
pub(super) struct LoadedMotion {
    pub name: String,
    pub spec: String,
    pub options: RetargetOptions,
    pub clip: Arc<Clip>,
}

/// The input of all experiments.
pub(super) struct Study {
    pub body: Arc<Body>,
    /// Recorded runs are listed twice: turned into a walk, and as recorded.
    pub clips: Vec<LoadedMotion>,
    /// Name, and the clip made to repeat.
    pub walk: Option<(String, Arc<Clip>)>,
}

/// `x` with two decimals.
pub(super) fn hundredths(x: f64) -> String {
    format!("{x:.2}")
}
