//! The contacts against which the plan may push: the points of planted feet, of a body that works on the floor, and of
//! parts that rest on seats and tables, each with the acceleration that keeps it in place.

use super::{HoldStiffness, Modern, POINTS, blend, weight};
use crate::body::topology::{L_FOOT, L_HAND, L_TOES, R_FOOT, R_HAND, R_TOES, SEGMENT_COUNT};
use crate::contact::rows::PointRow;
use crate::control::{ControlInput, MEANT_BY_RECORDING};
use crate::math::Vec3;
use crate::math::curve::fall;
use crate::report::MAX_CONTACTS;
use crate::support::Rest;

/// Time constant that brings a planted point to rest, s.
const HOLD_TIME: f64 = 0.05;
/// The same along the floor for a foot that still turns, s: friction stops its points before its hip does, and until
/// then they slide.
const TURN_HOLD_TIME: f64 = 0.03;
/// A foot counts as turning if it turns about the vertical faster than the first, rad/s, and its points slide faster
/// than the first, m/s; fully from the second on.
const TURNS: (f64, f64) = (0.4, 0.6);
const SLIDES: (f64, f64) = (0.05, 0.07);
/// A point begins to count as striking if it comes down faster than its height allows by more than the first, m/s;
/// fully from the second on.
const STRIKES: (f64, f64) = (0.1, 0.3);
/// Hardest stop of a planted point that is planned, m/s².
const STOP: f64 = 150.0;
/// Fastest correction of a planted point's height, m/s.
const HOLD_SPEED: f64 = 0.3;
/// A planted point counts fully below the first height and not at all above the second, m.
const FADE: (f64, f64) = (0.004, 0.010);
/// The same for parts that touch while the whole body works on the floor, m.
const FLOOR_FADE: (f64, f64) = (0.006, 0.020);
/// Factors on the cost of bearing weight in that case: knees bear it more easily than feet, and hands less. A knee has
/// one contact point where a palm has four, and hands that carry weight that knees could carry cannot be lifted.
const EASE: (f64, f64, f64) = (5.0, 0.5, 0.2);
/// Share of the last tick's contact force that is kept.
pub(super) const FORCE_MEMORY: f64 = 0.98;
/// Weight of holding a part in place on a seat when it carries its full share, and that share of the body weight. The
/// weight is small while the motion does not need the seat: a body that is pinned to it topples with it. Otherwise it
/// is the second value, both along the surface and across it: a plan in which the body sinks into its seat, or slides
/// over it, lets the feet push with forces that the floor does not give, and they creep.
const REST_HOLD: f64 = 5.0;
const NEEDED_HOLD: (f64, f64) = (50.0, 500.0);
const REST_FULL: f64 = 0.2;
/// A part is held where it rests while the motion has it less than the first above its rest, and not at all from the
/// second on, m: a hand that is about to leave the seat is not pinned to it.
const LIFTED: (f64, f64) = (0.02, 0.06);
/// Share of hold and force that segments other than feet get.
const OTHER_SEGMENT: f64 = 1e-3;
/// The same for a helped figure, where they touch the floor and the motion means them to. Without them a body that lies
/// is planned as if it flew, and carried. They hold little: a hand or a back that sticks to the floor cannot move on.
const HELPED_SEGMENT: f64 = 0.5;
const HELPED_HOLD: f64 = 0.02;

impl Modern {
    /// Contact points that the plan keeps down, faded by height, with the acceleration that brings them to rest.
    pub(super) fn collect_contacts(&mut self, input: &ControlInput<'_>) {
        self.contacts.clear();
        self.hold.clear();
        let t = input.terms;
        let planted = input.target.next.planted;
        let mg = t.mass * input.gravity.max(1.0);
        let roll = self.roll(input);
        for s in 0..SEGMENT_COUNT {
            for rest in input.support.rests().iter().filter(|r| r.is_level()) {
                if rest.segment.index() != s || self.contacts.points.len() >= MAX_CONTACTS {
                    continue;
                }
                // A seat or a table pushes a part that rests on it as the solution requires, starting from its last
                // reaction.
                let stays = fall(rest.lift, LIFTED);
                let share = stays * (rest.force.norm() / (REST_FULL * mg)).min(1.0);
                let r = rest.position - t.segment_position(s);
                let local = t.kin.rotation[s].transpose_mul(r);
                let v = t.kin.velocity[s] + t.kin.omega[s].cross(r);
                let a = v * (-1.0 / HOLD_TIME) - t.point_bias(s, local);
                let inverse_r = share.max(OTHER_SEGMENT) / weight::FORCE;
                let slot = self.contacts.slot(&t.kin, s);
                self.contacts.points.push(PointRow {
                    slot,
                    r,
                    c: rest.force * (-FORCE_MEMORY / inverse_r),
                    inverse_r,
                    segment: s,
                    vertex: POINTS,
                    turn: Rest::frame(rest.normal),
                });
                let weight =
                    |most: f64| share * (REST_HOLD + self.seat.needed * (most - REST_HOLD));
                let (along, across) = (weight(NEEDED_HOLD.0), weight(NEEDED_HOLD.1));
                self.hold.push((hold(along, across, rest.normal), a));
            }
            let foot = s == L_FOOT.index()
                || s == L_TOES.index()
                || s == R_FOOT.index()
                || s == R_TOES.index();
            let on_feet = input.contacts.floor.is_none();
            if on_feet && foot && !planted[usize::from(s >= R_FOOT.index())] {
                self.memory.force[s * POINTS..(s + 1) * POINTS].fill(Vec3::zero());
                continue;
            }
            for (vertex, p) in input.body.segments[s]
                .contact_points
                .iter()
                .enumerate()
                .take(POINTS)
            {
                let r = t.kin.rotation[s] * *p;
                let z = t.segment_position(s).z + r.z;
                let mut fade = fall(z, FADE);
                let (mut slides, mut held) = (false, 1.0);
                let mut last = self.memory.force[s * POINTS + vertex];
                if let Some(floor) = input.contacts.floor {
                    slides = floor.slides[s];
                    let meant = fall(floor.heights[s * POINTS + vertex], floor.meant);
                    fade = fall(z, FLOOR_FADE);
                    // A body that rolls over is carried by everything that touches, even if that is about to lift.
                    if floor.rolls {
                        held = meant;
                    } else {
                        fade *= meant;
                    }
                } else if foot {
                    let side = usize::from(s >= R_FOOT.index());
                    fade *= roll[side].kept(input, s, *p);
                } else if let Some(help) = &input.help {
                    let meant = fall(help.heights[s * POINTS + vertex], MEANT_BY_RECORDING);
                    fade = HELPED_SEGMENT * fall(z, FLOOR_FADE) * meant;
                    (slides, held) = (true, HELPED_HOLD);
                    // The plan does not know whether the point rises, so it counts on what the floor really gave.
                    last = help.floor[s * POINTS + vertex];
                } else {
                    fade *= OTHER_SEGMENT;
                }
                if fade <= 0.0 {
                    self.memory.force[s * POINTS + vertex] = Vec3::zero();
                    continue;
                }
                let v = t.kin.velocity[s] + t.kin.omega[s].cross(r);
                let turns = on_feet && foot && input.contacts.places_known;
                let spin = if turns { t.kin.omega[s].z } else { 0.0 };
                let a = stop((z, v), spin, input.dt) - t.point_bias(s, *p);
                let ease = if on_feet { 1.0 } else { ease(s, foot) };
                let inverse_r = ease * fade.max(OTHER_SEGMENT) / weight::FORCE;
                let c = last * (-FORCE_MEMORY / inverse_r);
                let slot = self.contacts.slot(&t.kin, s);
                self.contacts.points.push(PointRow {
                    slot,
                    r,
                    c,
                    inverse_r,
                    segment: s,
                    vertex,
                    turn: None,
                });
                let w = weight::HOLD * fade * held;
                let along = if slides { 0.0 } else { w };
                self.hold.push((hold(along, w, Vec3::Z), a));
            }
        }
    }
}

/// Acceleration that brings a planted point to rest on the floor, m/s².
///
/// * `(z, v)`: its height, m, and velocity, m/s.
/// * `spin`: angular velocity of its foot about the vertical, rad/s, if a foot that lands turning is held sooner;
///   otherwise 0.
/// * `dt`: length of the tick, s.
fn stop((z, v): (f64, Vec3), spin: f64, dt: f64) -> Vec3 {
    let rise = (-0.2 * z / dt).clamp(-HOLD_SPEED, HOLD_SPEED);
    // A point that strikes the floor within the tick is at rest at its end, whatever the plan.
    let strikes = 1.0 - fall(-v.z - z.max(0.0) / dt, STRIKES);
    let pace = blend(1.0 / HOLD_TIME, 1.0 / dt, strikes);
    let turning = 1.0 - fall(spin.abs(), TURNS);
    let sliding = 1.0 - fall((v.x * v.x + v.y * v.y).sqrt(), SLIDES);
    let along = blend(pace, pace.max(1.0 / TURN_HOLD_TIME), turning * sliding);
    let to_rest = Vec3 {
        x: -v.x * along,
        y: -v.y * along,
        z: (rise - v.z) * pace,
    };
    to_rest.capped(STOP)
}

/// Ease with which a segment bears weight on the floor.
fn ease(s: usize, foot: bool) -> f64 {
    if foot {
        EASE.1
    } else if s == L_HAND.index() || s == R_HAND.index() {
        EASE.2
    } else {
        EASE.0
    }
}

/// Weights along a surface and across it.
fn hold(along: f64, across: f64, normal: Vec3) -> HoldStiffness {
    let n = normal.to_array();
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let own = if i == j { along } else { 0.0 };
            own + (across - along) * n[i] * n[j]
        })
    })
}
