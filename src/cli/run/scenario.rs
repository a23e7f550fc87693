//! The scene of `sinew run`, which all its clips share.

use super::args::RunArgs;
use sinew_physics::body::Body;
use sinew_physics::figure::StrengthScale;
use sinew_physics::motion::Clip;
use sinew_physics::world::WorldParams;
use std::sync::Arc;

/// Everything that is simulated, apart from the motion.
pub(super) struct Scenario<'a> {
    pub args: &'a RunArgs,
    pub body: Arc<Body>,
    pub params: WorldParams,
    pub strength: StrengthScale,
    /// Clips of `--then`, and when they begin, s.
    pub then: Vec<(f64, Arc<Clip>)>,
}
