//! The points of a planted foot that the plan keeps on the floor while the motion rolls it off: the heel leaves first,
//! the toes leave with the whole foot.

use super::{Modern, POINTS};
use crate::body::Body;
use crate::body::topology::{DOF_START, JOINT, Joint, L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::control::{ControlInput, StancePhase};
use crate::math::curve::fall;
use crate::math::{Quat, Vec3};
use crate::motion::Target;

/// A point of a planted foot is planned down fully if it is below the first height in the motion, and not at all above
/// the second, m.
const PLANNED_FADE: (f64, f64) = (0.001, 0.006);
/// The same for toes that roll over their tip.
const TIP_FADE: (f64, f64) = (0.003, 0.010);
/// A point that the motion lifts faster than the first leaves the floor, m/s. All of these bounds are narrow on
/// purpose: a point that is half released is turned up while its force still acts.
const RISES: (f64, f64) = (0.035, 0.045);
/// A heel is needed if the desired zero-moment point is less than this far from it, as a share of the distance to the
/// toe joint: a body that brakes still stands on it.
const NEEDED: (f64, f64) = (0.45, 0.55);
/// An ankle that needs more than this share of its strength to carry the foot's load on the toe joint does not lift the
/// heel.
const STRAINED: (f64, f64) = (0.85, 0.90);
/// Toes that carry more than this share of the weight are kept to the end of the stance.
const CARRIES: (f64, f64) = (0.10, 0.15);
/// The weight goes from one planted foot to the other if the centre of mass moves faster than this, m/s.
const TRANSFER_SPEED: f64 = 0.5;

/// The roll of one planted foot in this tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Roll {
    /// `foot_from_toes` in the motion at the beginning and at the end of the tick.
    toes: [Quat; 2],
    /// Height that the motion adds to the heel within the tick, m.
    heel_rise: f64,
    /// 1 if the foot can do without its heel, 0 if it cannot.
    free: f64,
    /// 1 if the foot carries next to nothing, 0 if it carries.
    idle: f64,
}

impl Modern {
    /// The roll of both feet, left and right.
    pub(super) fn roll(&self, input: &ControlInput<'_>) -> [Roll; 2] {
        const FEET: [usize; 2] = [L_FOOT.index(), R_FOOT.index()];
        let heel_rise = FEET.map(|s| {
            let [before, z] = heights(input, s, [heel(input.body, s); 2]);
            z - before
        });
        // In a squat, on the way into a seat and in small steps, heels are lifted too, and carry while they are.
        let v = input.centroidal.com.now_velocity;
        let transfers = v.x * v.x + v.y * v.y > TRANSFER_SPEED * TRANSFER_SPEED;
        let may_lift = |side: usize| transfers || !input.target.next.planted[1 - side];
        let mg = input.terms.mass * input.gravity.max(1.0);
        std::array::from_fn(|side| {
            let s = FEET[side];
            let free =
                (1.0 - fall(wanted(input, s), NEEDED)) * fall(self.strain(input, s), STRAINED);
            let bent = |target: &Target| match JOINT[s + 1] {
                Joint::Hinge1(h) => Quat::exp(Vec3::Y * -target.posture.hinge[h]),
                _ => unreachable!("the toes are on a hinge"),
            };
            Roll {
                toes: [bent(&input.target.now), bent(&input.target.next)],
                heel_rise: heel_rise[side],
                free: if may_lift(side) { free } else { 0.0 },
                idle: fall(self.force(s).z / mg, CARRIES),
            }
        })
    }

    /// The load on foot `s` and its toes in the last plan, N.
    fn force(&self, s: usize) -> Vec3 {
        let points = &self.memory.force[s * POINTS..(s + 2) * POINTS];
        points.iter().fold(Vec3::zero(), |sum, f| sum + *f)
    }

    /// Torque that the ankle of foot `s` needs if its toe joint carries the whole foot's load of the last plan, as a
    /// share of its strength.
    fn strain(&self, input: &ControlInput<'_>, s: usize) -> f64 {
        let t = input.terms;
        let ball = Vec3 {
            z: 0.0,
            ..t.segment_position(s + 1)
        };
        let moment = (ball - t.segment_position(s)).cross(self.force(s));
        let needed = moment.dot(t.kin.rotation[s] * Vec3::Y).abs();
        needed / (-input.lower[DOF_START[s]]).max(1.0)
    }
}

/// Rearmost point of foot `s`, foot frame, m.
fn heel(body: &Body, s: usize) -> Vec3 {
    let points = body.segments[s].contact_points.iter();
    let rearmost = points.min_by(|p, q| p.x.total_cmp(&q.x));
    rearmost.copied().unwrap_or_default()
}

/// Desired position of the zero-moment point along foot `s`: 0 under its heel, 1 under its toe joint.
fn wanted(input: &ControlInput<'_>, s: usize) -> f64 {
    let t = input.terms;
    let Some([x, y]) = input.centroidal.acceleration else {
        return 0.0;
    };
    let zmp = t.com - Vec3 { x, y, z: 0.0 } * (t.com.z / input.gravity.max(1.0));
    let heel = t.point_world(s, heel(input.body, s));
    let way = t.segment_position(s + 1) - heel;
    let level = way.x * way.x + way.y * way.y;
    ((zmp.x - heel.x) * way.x + (zmp.y - heel.y) * way.y) / level.max(1e-6)
}

impl Roll {
    /// How far the plan keeps a point of segment `s` down. The floor does not push a part that the motion lifts:
    /// contacts of the plan have no complementarity, and a heel that turns up while its force still acts is turned by
    /// that force, with the whole weight on it.
    pub(super) fn kept(&self, input: &ControlInput<'_>, s: usize, point: Vec3) -> f64 {
        let toes = s == L_TOES.index() || s == R_TOES.index();
        let local = |foot_from_toes: Quat| {
            if toes {
                input.body.joint_offset[s] + foot_from_toes.rotate(point)
            } else {
                point
            }
        };
        let [before, z] = heights(input, s, self.toes.map(local));
        let stays = |rise: f64| fall(rise / input.dt, RISES);
        if !toes {
            let gives_way = self.free * (1.0 - stays(z - before));
            return (1.0 - gives_way).min(fall(z, PLANNED_FADE));
        }
        if input.contacts.phase == StancePhase::LiftOff {
            // At lift-off a foot rolls over the tip of its toes.
            return fall(z, TIP_FADE);
        }
        // Toes are turned up about a heel that stays, and carry while they are; they leave with it.
        1.0 - self.idle * (1.0 - stays((z - before).min(self.heel_rise)))
    }
}

/// Heights over the floor, in the motion, of a point of the foot of segment `s` (foot frame), at the beginning and at
/// the end of the tick, m.
fn heights(input: &ControlInput<'_>, s: usize, point: [Vec3; 2]) -> [f64; 2] {
    let foot = &input.contacts.feet[usize::from(s >= R_FOOT.index())];
    let [now, next] = point;
    [
        foot.ankle.now.z + foot.rotation.now.rotate(now).z,
        foot.ankle.next.z + foot.rotation.next.rotate(next).z,
    ]
}
