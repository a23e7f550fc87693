//! Stage 2: the other hand's part in a load that is too heavy for one arm.

use crate::body::SegmentId;
use crate::figure::loads::second_hand::Sight;
use crate::figure::state::figure::Figure;
use crate::motion::arm_ik::ARMS;
use crate::tick_context::TickContext;

impl Figure {
    /// Changes the desired motion of an arm whose hand helps with a load.
    pub(in crate::figure) fn lead_second_hand(&mut self, world: &TickContext) {
        let time = world.time();
        let helps = self.surroundings.disturbances.helpable(time.0);
        if helps.is_none() && self.desired.second_hand.led().is_none() {
            return;
        }
        let muscles = self.available_strength();
        let free = ARMS.map(|arm| self.has_nothing_to_do(arm));
        let now = self.desired.target.now.posture;
        let goes_on = !(self.motion.stops() || self.motion.gets_up());
        let lag = self.desired.tracker.lag();
        let source = self.motion.source();
        let ahead = |seconds: f64| {
            if goes_on {
                let at = time - lag + seconds;
                source.pair(at, at).now.posture
            } else {
                now
            }
        };
        let sight = Sight {
            body: &self.setup.body,
            shape: &self.constants.shape,
            strength: &self.constants.strength,
            muscles: &muscles,
            links: &self.physical.links,
            state: &self.physical.state,
            ahead: &ahead,
            free,
            time: time.0,
            gravity: world.gravity,
            dt: world.dt,
        };
        self.desired.second_hand.update(
            &sight,
            &mut self.surroundings.disturbances,
            &mut self.desired.target,
        );
    }

    /// Whether an arm of a figure that stands or moves holds nothing of its own, touches nothing, and is not led from
    /// outside.
    fn has_nothing_to_do(&self, arm: [SegmentId; 3]) -> bool {
        let s = &self.surroundings;
        let upright = !(self.motion.has_fallen() || s.balance.lost());
        upright
            && self.motion.rehearsed().is_none()
            && !self.desired.constraints.holds(arm)
            && !s.disturbances.burdens(arm)
            && !s.touches.list().any(|t| arm.contains(&t.segment))
            && !s.support.points().iter().any(|p| arm.contains(&p.segment))
    }
}
