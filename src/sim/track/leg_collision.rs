//! The stance leg as an obstacle: where a foot may land beside, before and behind it, and how much clearance a crossing
//! foot keeps.
//!
//! Seen from the standing ankle, with `x` ahead and `y` towards the side of the swinging foot, the swinging foot must
//! keep a minimum distance in `y`. The whole far side is blocked too, unless the foot is far enough before or behind.
//! The further a leg crosses, the higher up the legs cross, so the further apart they must be along `x`.

use super::foot_places::{FootPlace, turn};
use super::params::leg_collision::{
    AVOIDED_FROM, AVOIDED_FULLY, CLEARING_TIME, CROSSED_LENGTH, CROSSED_SLANT, FOOT_LAG, ROUNDING,
    SLANT_FRONT, SLANT_REAR, SPARE, STRIP_FRONT, STRIP_REAR, SWING_DISTANCE,
};
use crate::body::topology::outward;
use crate::math::Vec3;

/// The stance leg as seen from a foot that swings past it.
#[derive(Clone, Copy, Debug)]
pub(super) struct StanceLeg {
    /// Ankle of the stance leg, with the heading of the swinging foot.
    place: FootPlace,
    /// Side of the swinging foot: 1 left, −1 right.
    outward: f64,
    /// Least distance of the ankles side by side, m.
    distance: f64,
    /// Share of the avoidance that is applied.
    share: f64,
}

impl StanceLeg {
    /// The leg with this ankle, past which foot `side` swings with the heading of `place`.
    pub(super) fn new(place: FootPlace, side: usize) -> Self {
        Self {
            place,
            outward: outward(side),
            distance: SWING_DISTANCE,
            share: 1.0,
        }
    }

    /// The stance leg for a foot whose foothold is displaced by `shift`, and that was `release` away from the clip at
    /// lift-off; `clip` is its present place in the clip. `None` if the foot does not cross.
    pub(super) fn crossed(self, shift: Vec3, release: Vec3, clip: Vec3) -> Option<Self> {
        let inward = |v: Vec3| -self.local(self.place.at + v).1;
        let across = inward(shift).max(inward(release));
        let share = ((across - AVOIDED_FROM) / (AVOIDED_FULLY - AVOIDED_FROM)).clamp(0.0, 1.0);
        let low = SWING_DISTANCE.min(self.local(clip).1 - SPARE);
        (share > 0.0).then_some(Self {
            distance: low + share * (SWING_DISTANCE - low),
            share,
            ..self
        })
    }

    fn local(&self, p: Vec3) -> (f64, f64) {
        let p = self.place.local(p);
        (p.x, p.y * self.outward)
    }

    /// Depth of an ankle at `p` with velocity `v` inside the space that the leg needs, m; negative outside.
    pub(super) fn depth(&self, p: Vec3, v: Vec3) -> f64 {
        let beyond = |d: f64| 0.5 * (d + (d * d + ROUNDING * ROUNDING).sqrt());
        let (x, y) = self.local(p);
        let x = x + FOOT_LAG * self.local(self.place.at + v).0;
        let behind = beyond(STRIP_REAR - x) / SLANT_REAR;
        let before = beyond(x - STRIP_FRONT) / SLANT_FRONT;
        self.distance - behind - before - y
    }

    /// Displacement of a foot's path `since` seconds after it lifted off at depth `initial`, m.
    pub(super) fn aside(&self, p: Vec3, v: Vec3, since: f64, initial: f64) -> Vec3 {
        let left = (1.0 - since / CLEARING_TIME).max(0.0);
        let by = self.share * (self.depth(p, v) - initial * left * left).max(0.0);
        turn(self.place.yaw).rotate(Vec3::Y * (by * self.outward))
    }
}

/// The foothold nearest to `(x, y)` at which the legs do not intersect: `beside` the other foot (m), or else before or
/// behind it, on whichever end it already is.
pub(super) fn foothold((x, y): (f64, f64), beside: f64) -> (f64, f64) {
    let (least, slant) = (CROSSED_LENGTH, CROSSED_SLANT);
    let ahead = if x > 0.0 { 1.0 } else { -1.0 };
    let short = least + slant * (beside - y) - x * ahead;
    if y >= beside || short <= 0.0 {
        return (x, y);
    }
    // Move it onto the slanted edge or to the side, whichever is nearer.
    let n = 1.0 + slant * slant;
    let moved = (x + ahead * short / n, y + slant * short / n);
    if beside - y <= short / n.sqrt() {
        (x, beside)
    } else if moved.1 > beside {
        (ahead * least, beside)
    } else {
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::super::params::leg_collision::FOOTHOLD_DISTANCE;
    use super::*;

    #[test]
    fn footholds_lie_beside_before_or_behind() {
        for (x, y) in [(0.05, 0.02), (0.12, -0.2), (-0.1, -0.3), (0.0, -0.02)] {
            let (fx, fy) = foothold((x, y), FOOTHOLD_DISTANCE);
            let room = CROSSED_LENGTH + CROSSED_SLANT * (FOOTHOLD_DISTANCE - fy);
            assert!(
                fy >= FOOTHOLD_DISTANCE || fx.abs() >= room - 1e-12,
                "{x}, {y} -> {fx}, {fy}"
            );
            assert!(fx * x >= 0.0, "it does not change from before to behind");
            assert_eq!(
                foothold((fx, fy + 1e-12), FOOTHOLD_DISTANCE).0,
                fx,
                "and stays"
            );
        }
        assert_eq!(foothold((0.3, -0.1), FOOTHOLD_DISTANCE), (0.3, -0.1));
        assert_eq!(foothold((0.0, 0.1), FOOTHOLD_DISTANCE), (0.0, 0.1));
    }

    #[test]
    fn a_foot_passes_the_stance_leg_before_it_crosses() {
        let place = FootPlace {
            at: Vec3::X * 2.0,
            yaw: 0.0,
        };
        let stance = StanceLeg::new(place, 1);
        let across = Vec3::Y * 0.3;
        assert!(
            stance
                .crossed(across * -1.0, Vec3::zero(), Vec3::zero())
                .is_none()
        );
        let stance = stance.crossed(across, Vec3::zero(), Vec3::X * 2.0).unwrap();
        let at = |x: f64| Vec3 {
            x: 2.0 + x,
            y: 0.2,
            z: 0.1,
        };
        for x in [-0.3, -0.1, -0.05] {
            let p = at(x);
            let moved = p + stance.aside(p, Vec3::zero(), 1.0, 0.0);
            assert!((moved.y + SWING_DISTANCE).abs() < 0.02, "{x}: {moved:?}");
            // A foot that was inside at lift-off moves out gradually.
            let depth = stance.depth(p, Vec3::zero());
            assert!(stance.aside(p, Vec3::zero(), 0.0, depth).norm() < 1e-12);
        }
        assert_eq!(stance.aside(at(0.2), Vec3::zero(), 1.0, 0.0).norm(), 0.0);
    }
}
