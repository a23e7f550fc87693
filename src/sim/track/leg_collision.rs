//! Around the leg that stands: where a foot may land beside, before and behind it, and how far from it one swings that
//! is led across.
//!
//! Seen from the standing ankle, `x` ahead and `y` to the side of the foot that swings, what must be kept free is a
//! strip: nearer than some distance to that side, and so to the whole other side, unless far enough before or behind.
//! Legs that cross do so the higher the further, and have to be the further apart along `x`.

use crate::sim::math::{Quat, Vec3};

/// Least distance of two ankles side by side, m: in a swing, and of a foothold.
const ABREAST: f64 = 0.09;
pub(super) const BESIDE: f64 = 0.08;
/// A foothold across lies before or behind the other ankle by the first, m, and by the second for each metre that it is
/// across.
const PASSING: (f64, f64) = (0.16, 0.4);
/// Strip in which a swinging ankle is not let across: from and to, m. A knee that swings forward is far before its
/// ankle, one that is raised makes room behind it.
const STRIP: (f64, f64) = (-0.6, -0.02);
/// How far it must go on, or still have to come, for each metre across.
const SLANT: (f64, f64) = (0.7, 0.15);
/// The corners are rounded by this, m.
const ROUND: f64 = 0.01;
/// A foot lags behind where it is led, s.
const LAG: f64 = 0.03;
/// A foot is led across if its foothold, or where it lifts off, is this much further across than the clip has it:
/// begins to be, and is, m.
const LED: (f64, f64) = (0.06, 0.12);
/// What a clip's swings come closer to the leg that stands than [`ABREAST`], those led a little aside may, and by this
/// more, m.
const SPARE: f64 = 0.03;
/// Time in which a foot that lifts off too near to the other leg gets out of its way, s.
const CLEARS: f64 = 0.2;

/// The leg that stands, as one that swings past it sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stance {
    ankle: Vec3,
    yaw: f64,
    /// Side of the swinging foot.
    outward: f64,
    /// How near to it a foot may pass, m.
    abreast: f64,
    /// To what share the way is corrected.
    share: f64,
}

impl Stance {
    /// Of the leg with this ankle, past which foot `side` swings with heading `yaw`.
    pub(super) fn new(ankle: Vec3, yaw: f64, side: usize) -> Self {
        Self {
            ankle,
            yaw,
            outward: if side == 0 { 1.0 } else { -1.0 },
            abreast: ABREAST,
            share: 1.0,
        }
    }

    /// The same for a foot whose foothold is displaced by `shift`, that lifted off `release` from where the clip, which
    /// has it at `clip` now, had it; `None` if it is not led across.
    pub(super) fn crossed(self, shift: Vec3, release: Vec3, clip: Vec3) -> Option<Self> {
        let inward = |v: Vec3| -self.local(self.ankle + v).1;
        let across = inward(shift).max(inward(release));
        let share = ((across - LED.0) / (LED.1 - LED.0)).clamp(0.0, 1.0);
        let low = ABREAST.min(self.local(clip).1 - SPARE);
        (share > 0.0).then_some(Self {
            abreast: low + share * (ABREAST - low),
            share,
            ..self
        })
    }

    fn local(&self, p: Vec3) -> (f64, f64) {
        let p = Quat::exp(Vec3::Z * -self.yaw).rotate(p - self.ankle);
        (p.x, p.y * self.outward)
    }

    /// How far an ankle at `p` with velocity `v` is inside what the leg needs, m; negative outside.
    pub(super) fn short(&self, p: Vec3, v: Vec3) -> f64 {
        let beyond = |d: f64| 0.5 * (d + (d * d + ROUND * ROUND).sqrt());
        let (x, y) = self.local(p);
        let x = x + LAG * self.local(self.ankle + v).0;
        let behind = beyond(STRIP.0 - x) / SLANT.0;
        let before = beyond(x - STRIP.1) / SLANT.1;
        self.abreast - behind - before - y
    }

    /// By how much the way of a foot is displaced `since` seconds after it lifted off `tight` inside, m.
    pub(super) fn aside(&self, p: Vec3, v: Vec3, since: f64, tight: f64) -> Vec3 {
        let left = (1.0 - since / CLEARS).max(0.0);
        let by = self.share * (self.short(p, v) - tight * left * left).max(0.0);
        Quat::exp(Vec3::Z * self.yaw).rotate(Vec3::Y * (by * self.outward))
    }
}

/// The foothold nearest to `(x, y)` from which a leg does not go through the other one: `beside` it, or else before or
/// behind it, where it already is.
pub(super) fn foothold((x, y): (f64, f64), beside: f64) -> (f64, f64) {
    let (least, slant) = PASSING;
    let ahead = if x > 0.0 { 1.0 } else { -1.0 };
    let short = least + slant * (beside - y) - x * ahead;
    if y >= beside || short <= 0.0 {
        return (x, y);
    }
    // Onto the slanted edge, or to the side, whichever is nearer.
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
    use super::*;

    #[test]
    fn footholds_lie_beside_before_or_behind() {
        for (x, y) in [(0.05, 0.02), (0.12, -0.2), (-0.1, -0.3), (0.0, -0.02)] {
            let (fx, fy) = foothold((x, y), BESIDE);
            let room = PASSING.0 + PASSING.1 * (BESIDE - fy);
            assert!(
                fy >= BESIDE || fx.abs() >= room - 1e-12,
                "{x}, {y} -> {fx}, {fy}"
            );
            assert!(fx * x >= 0.0, "it does not change from before to behind");
            assert_eq!(foothold((fx, fy + 1e-12), BESIDE).0, fx, "and stays");
        }
        assert_eq!(foothold((0.3, -0.1), BESIDE), (0.3, -0.1));
        assert_eq!(foothold((0.0, 0.1), BESIDE), (0.0, 0.1));
    }

    #[test]
    fn who_crosses_passes_first() {
        let stance = Stance::new(Vec3::X * 2.0, 0.0, 1);
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
            assert!((moved.y + ABREAST).abs() < 0.02, "{x}: {moved:?}");
            // A foot that was in the way when it lifted off gets out of it by and by.
            let tight = stance.short(p, Vec3::zero());
            assert!(stance.aside(p, Vec3::zero(), 0.0, tight).norm() < 1e-12);
        }
        assert_eq!(stance.aside(at(0.2), Vec3::zero(), 1.0, 0.0).norm(), 0.0);
    }
}
