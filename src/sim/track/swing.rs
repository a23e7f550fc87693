//! Where swinging feet are led: to footholds that catch the body, clear of the floor, in the air about the centre of
//! mass (WALKING §4).

use super::leg_collision::Stance;
use super::step_plan::Footfall;
use super::{FOOT, StepTracker, TaskTargets, capture_point, level};
use crate::sim::control::{PointTarget, RotationTarget};
use crate::sim::dynamics::Terms;
use crate::sim::math::curve::smootherstep;
use crate::sim::math::{Quat, Vec3, trig};

/// A foot that finds no floor goes down at this speed, m/s.
const LOWERING: f64 = 0.5;
/// Time over which a lifting foot gives up its offset from the plan, s.
const RELEASE: f64 = 0.25;
/// Part of a swing in which the foot is led to its displaced foothold.
const SWING_SHARE: f64 = 0.9;
/// Least height of a swinging sole, m, and how fast it must come up and may come down, m/s.
const CLEARANCE: f64 = 0.03;
const CLEARANCE_RATE: f64 = 0.35;
/// Share of its distance from home by which a foothold is pulled there, and the most, m. A foothold that is pulled is
/// that far from where it would catch the body, and one foot holds no more than this against it to its side: with 4 cm
/// a body that was moved drifted on.
const HOME: (f64, f64) = (0.3, 0.015);

impl StepTracker {
    /// A standing foot keeps the heading it landed with: it could only be turned by scraping.
    pub(super) fn keep_headings(
        &self,
        terms: &Terms,
        feet: &mut [(PointTarget, RotationTarget); 2],
    ) {
        for (side, (_, target)) in feet.iter_mut().enumerate() {
            let swings = self.step.is_some_and(|s| s.side == side)
                || (self.walks() && !self.feet[side].down);
            if swings {
                continue;
            }
            let actual = Quat::from_mat3(&terms.kin.rotation[FOOT[side].index()]);
            let off = actual.heading() - target.now.heading();
            let turn = Quat::exp(Vec3::Z * trig::wrapped(off));
            target.now = turn * target.now;
            target.next = turn * target.next;
        }
    }

    /// Leads a foot that swings as the clip has it.
    pub(super) fn lead_planned(
        &mut self,
        terms: &Terms,
        side: usize,
        dt: f64,
        target: &mut (PointTarget, RotationTarget),
    ) {
        if self.feet[side].down {
            if self.feet[side].early {
                self.lower_early(side, target);
            }
            return;
        }
        let (current, next) = (self.planned(side), self.next(side));
        if let Some(f) = current.or(next) {
            self.adapt(terms, side, &f, dt);
        }
        let heading = current
            .or(next)
            .map(|f| self.anchor.yaw() + self.placed(&f).yaw);
        let foot = self.feet[side];
        let since = (self.phase - foot.lifted).max(0.0) / self.speed;
        let on = match (current, next) {
            (Some(_), _) => self.phase,
            (None, Some(f)) => f.on,
            (None, None) => self.phase + self.speed,
        };
        let remaining = (on - self.phase).max(0.0) / self.speed;
        let whole = (since + remaining).max(0.1) * SWING_SHARE;
        let share = |t: f64| smootherstep((t / whole).clamp(0.0, 1.0));
        let s = share(since);
        let kept = (1.0 - since / RELEASE).max(0.0);
        let mut offset = foot.release * (kept * kept);
        offset.x += s * foot.shift[0];
        offset.y += s * foot.shift[1];
        let wanted = CLEARANCE
            .min(CLEARANCE_RATE * since)
            .min(CLEARANCE_RATE * remaining);
        offset.z += (wanted - self.lowest(terms, side)).clamp(0.0, CLEARANCE);
        let target = &mut target.0;
        let clip = target.now;
        if let Some(quick) = self.quick.filter(|_| remaining > 0.0) {
            // In a hurry a foot lags by a tenth of a second if it is not told how fast it is led aside.
            let ahead = |t: f64| share(since + t * quick.rate);
            let (next, after) = (ahead(dt), ahead(2.0 * dt));
            let way = level(foot.shift);
            target.now_velocity += way * ((next - s) / dt);
            target.next_velocity += way * ((after - next) / dt);
            target.next += way * (next - s);
        }
        if foot.late > 0.0 {
            offset.z -= LOWERING * foot.late;
            target.now_velocity = Vec3::Z * -LOWERING;
            target.next_velocity = Vec3::Z * -LOWERING;
        }
        target.now += offset;
        target.next += offset;
        if let Some(yaw) = heading.filter(|_| self.feet[1 - side].down) {
            self.lead_around(terms, (side, yaw), (since, dt), clip, target);
        }
    }

    /// Leads a swinging foot that is to cross, or has crossed, around the leg that stands; `clip`: where the clip has
    /// it.
    fn lead_around(
        &mut self,
        terms: &Terms,
        (side, yaw): (usize, f64),
        (since, dt): (f64, f64),
        clip: Vec3,
        target: &mut PointTarget,
    ) {
        let foot = &mut self.feet[side];
        let ankle = |side: usize| terms.segment_position(FOOT[side].index());
        let stance = Stance::new(ankle(1 - side), yaw, side);
        let Some(stance) = stance.crossed(level(foot.shift), foot.release, clip) else {
            return;
        };
        let short = stance.short(ankle(side), Vec3::zero());
        let tight = *foot.tight.get_or_insert(short.max(0.0));
        let (v0, v1) = (target.now_velocity, target.next_velocity);
        let now = stance.aside(target.now, v0, since, tight);
        let next = stance.aside(target.next, v1, since + dt, tight);
        let after = (target.next + v1 * dt, v1 * 2.0 - v0);
        let after = stance.aside(after.0, after.1, since + 2.0 * dt, tight);
        target.now += now;
        target.next += next;
        target.now_velocity += (next - now) * (1.0 / dt);
        target.next_velocity += (after - next) * (1.0 / dt);
    }

    /// A foot that landed before its time stands where the plan still has it in the air.
    fn lower_early(&self, side: usize, target: &mut (PointTarget, RotationTarget)) {
        let low = target.0.next.z + self.soles[side].lowest(target.1.next, 0.0);
        target.0.now.z -= low.max(0.0);
        target.0.next.z -= low.max(0.0);
    }

    /// Displacement of the foothold `f` of a swinging foot.
    fn adapt(&mut self, terms: &Terms, side: usize, f: &Footfall, dt: f64) {
        let f = self.placed(f);
        let foot = &self.feet[side];
        let remaining = (f.on - self.phase).max(0.0) / self.speed;
        let home = self.anchor.point(f.place);
        let away = home - f.place;
        let pull = HOME
            .0
            .min(HOME.1 / level([away.x, away.y]).norm().max(1e-9));
        let mut d = self.capture.left_over(remaining);
        d[0] -= pull * away.x;
        d[1] -= pull * away.y;
        let stance = terms.segment_position(FOOT[1 - side].index());
        let heading = self.anchor.yaw() + f.yaw;
        let d = match self.quick.filter(|q| q.side == side) {
            Some(quick) => [quick.place.x - home.x, quick.place.y - home.y],
            None => {
                capture_point::within_reach(d, home, stance, heading, side, capture_point::REACH.0)
            }
        };
        if remaining > capture_point::FREEZE || foot.shift == [0.0; 2] {
            let a = capture_point::smoothing(dt);
            let foot = &mut self.feet[side];
            for (x, y) in foot.shift.iter_mut().zip(d) {
                *x += a * (y - *x);
            }
        }
    }
}

/// Leads the feet of who flies about his centre of mass, whose way nothing changes: led to where the motion has them
/// they would pull the legs up or stretch them, and turn the trunk.
pub(super) fn follow_mass(terms: &Terms, dt: f64, tasks: &mut TaskTargets<'_>) {
    let off = terms.com - tasks.com.now;
    let drift = terms.com_velocity - tasks.com.now_velocity;
    for (foot, _) in tasks.feet.iter_mut() {
        foot.now += off;
        foot.next += off + drift * dt;
        foot.now_velocity += drift;
        foot.next_velocity += drift;
    }
}
