//! Places of the centre of mass, the hands and the feet in the desired motion, with the present loads.

use crate::body::topology::{L_FOOT, L_HAND, R_FOOT, R_HAND};
use crate::body::{Body, Links, NV, SegmentId, State};
use crate::control::{Effector, FootTarget, PointTarget, RotationTarget};
use crate::dynamics::{Kinematics, center_of_mass, momentum};
use crate::math::{Quat, Vec3};
use crate::motion::{Target, TargetPair};

/// Spatial targets derived from the desired joint trajectories.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaskPoints {
    /// Desired centre of mass.
    pub com: PointTarget,
    /// Centroidal angular momentum at the start and at the end of the tick, N·m·s.
    pub spin: [Vec3; 2],
    /// Left and right hand.
    pub hands: [Effector; 2],
    /// Left and right foot.
    pub feet: [FootTarget; 2],
}

impl TaskPoints {
    /// Everything at the world origin, at rest: before the first tick.
    pub fn none() -> Self {
        let o = Vec3::zero();
        let point = PointTarget::still(o);
        let foot = FootTarget {
            ankle: point,
            rotation: RotationTarget::still(Quat::identity()),
        };
        let hand = |segment| Effector {
            segment,
            point: o,
            position: point,
            rotation: None,
        };
        Self {
            com: point,
            spin: [o; 2],
            hands: [hand(L_HAND), hand(R_HAND)],
            feet: [foot; 2],
        }
    }
}

/// The point at which a load is held: the middle of the hand.
pub fn grip(body: &Body, hand: SegmentId) -> Vec3 {
    body.segment(hand).tip * 0.5
}

/// Point of a segment that a constraint holds unless it names one, segment frame, m: the middle of a hand, otherwise
/// the centre of mass.
pub fn held_point(body: &Body, segment: SegmentId) -> Vec3 {
    if segment == L_HAND || segment == R_HAND {
        grip(body, segment)
    } else {
        body.segment(segment).com
    }
}

struct Pose<'a> {
    kin: &'a Kinematics<f64>,
    root: Vec3,
}

impl Pose<'_> {
    fn point(&self, s: SegmentId, local: Vec3) -> (Vec3, Vec3) {
        let i = s.index();
        let r = self.kin.rotation[i] * local;
        (
            self.root + self.kin.position[i] + r,
            self.kin.velocity[i] + self.kin.omega[i].cross(r),
        )
    }
    fn rotation(&self, s: SegmentId) -> (Quat, Vec3) {
        (
            Quat::from_mat3(&self.kin.rotation[s.index()]),
            self.kin.omega[s.index()],
        )
    }
}

/// Buffers for the kinematics of the two desired states of a tick, and of one more.
#[derive(Clone, Debug, Default)]
pub struct TaskWorkspace {
    now: Kinematics<f64>,
    next: Kinematics<f64>,
    aside: Kinematics<f64>,
}

impl TaskWorkspace {
    /// Place of a point (segment frame, m) in the desired motion at the start of the tick, world, m; call after
    /// [`points`](Self::points).
    pub fn desired_point(&self, target: &TargetPair, s: SegmentId, point: Vec3) -> Vec3 {
        let root = target.now.posture.root_position;
        Pose {
            kin: &self.now,
            root,
        }
        .point(s, point)
        .0
    }

    /// Centroidal angular momentum of a desired state, N·m·s, world axes. No allocation.
    pub fn spin(&mut self, links: &Links, target: &Target) -> Vec3 {
        self.aside.set_posture(links, &target.posture);
        self.aside.set_velocity(&target.velocity);
        momentum(links, &self.aside).angular
    }

    /// Centre of mass of a state (world, m) and its velocity (world axes, m/s), loads included. No allocation.
    pub fn center_of_mass(&mut self, links: &Links, state: &State) -> (Vec3, Vec3) {
        self.aside.set_state(links, state);
        let (com, mass) = center_of_mass(links, &self.aside);
        let linear = momentum(links, &self.aside).linear;
        (state.posture.root_position + com, linear * (1.0 / mass))
    }

    /// Spatial targets of a tick. `links` carry the present loads. No allocation.
    pub fn points(&mut self, body: &Body, links: &Links, target: &TargetPair) -> TaskPoints {
        let set = |kin: &mut Kinematics<f64>, t: &Target| {
            kin.set_posture(links, &t.posture);
            let v: &[f64; NV] = &t.velocity;
            kin.set_velocity(v);
        };
        set(&mut self.now, &target.now);
        set(&mut self.next, &target.next);
        let com = |kin: &Kinematics<f64>, t: &Target| {
            let (c, m) = center_of_mass(links, kin);
            let p = momentum(links, kin);
            let at = t.posture.root_position + c;
            ((at, p.linear * (1.0 / m)), p.angular)
        };
        let ((c0, spin), (c1, next_spin)) =
            (com(&self.now, &target.now), com(&self.next, &target.next));
        let now = Pose {
            kin: &self.now,
            root: target.now.posture.root_position,
        };
        let next = Pose {
            kin: &self.next,
            root: target.next.posture.root_position,
        };
        let pair = |a: (Vec3, Vec3), b: (Vec3, Vec3)| PointTarget {
            now: a.0,
            now_velocity: a.1,
            next: b.0,
            next_velocity: b.1,
        };
        let hand = |segment: SegmentId| {
            let point = grip(body, segment);
            Effector {
                segment,
                point,
                position: pair(now.point(segment, point), next.point(segment, point)),
                rotation: None,
            }
        };
        let foot = |segment: SegmentId| {
            let (a, b) = (now.rotation(segment), next.rotation(segment));
            FootTarget {
                ankle: pair(
                    now.point(segment, Vec3::zero()),
                    next.point(segment, Vec3::zero()),
                ),
                rotation: RotationTarget {
                    now: a.0,
                    now_velocity: a.1,
                    next: b.0,
                    next_velocity: b.1,
                },
            }
        };
        TaskPoints {
            com: pair(c0, c1),
            spin: [spin, next_spin],
            hands: [hand(L_HAND), hand(R_HAND)],
            feet: [foot(L_FOOT), foot(R_FOOT)],
        }
    }
}
