//! The bodies of one cluster, and their places in the present substep.

use super::Participant;
use crate::body::SegmentId;
use crate::collide::narrow::PosedBox;
use crate::collide::shape::Capsule;
use crate::collide::{Obstacle, ObstacleKey, Other, Shape};
use crate::dynamics::Placement;
use crate::figure::{Figure, FigureKey};
use crate::math::Vec3;

/// The bodies of one cluster.
pub(super) struct Cast<'a> {
    pub figures: &'a mut [(FigureKey, Box<Figure>)],
    pub free: &'a mut [(ObstacleKey, Obstacle)],
    pub firm: &'a [(ObstacleKey, Obstacle)],
    pub friction: f64,
}

impl Cast<'_> {
    /// Figures that torques move in this tick.
    pub fn moved_by_torques(&mut self) -> impl Iterator<Item = &mut Figure> {
        let all = self.figures.iter_mut().map(|(_, f)| &mut **f);
        all.filter(|f| !f.moved_alone())
    }

    /// Velocity of a world point of a part.
    pub fn velocity(&self, participant: Participant, part: usize, p: Vec3) -> Vec3 {
        match participant {
            Participant::Figure(i) => {
                let t = self.figures[i].1.substep_dynamics();
                t.kin.velocity[part] + t.kin.omega[part].cross(p - t.segment_position(part))
            }
            Participant::Free(i) => self.free[i].1.point_velocity(p),
            Participant::Firm(i) => self.firm[i].1.point_velocity(p),
            Participant::Ground => Vec3::zero(),
        }
    }

    /// Identity of a body in reports.
    pub fn other(&self, participant: Participant, part: usize) -> Option<Other> {
        match participant {
            Participant::Figure(i) => {
                Some(Other::Figure(self.figures[i].0.0, SegmentId::new(part)?))
            }
            Participant::Free(i) => Some(Other::Obstacle(self.free[i].0)),
            Participant::Firm(i) => Some(Other::Obstacle(self.firm[i].0)),
            Participant::Ground => None,
        }
    }

    /// The obstacle of a participant. A firm one has moved for `led_for` seconds since its pose was stored.
    pub fn obstacle(&self, participant: Participant, led_for: f64) -> Option<Posed> {
        match participant {
            Participant::Free(i) => Some(Posed::new(&self.free[i].1, 0.0)),
            Participant::Firm(i) => Some(Posed::new(&self.firm[i].1, led_for)),
            _ => None,
        }
    }
}

/// An obstacle's shape in the world.
pub(super) struct Posed {
    pub shape: PosedShape,
    pub friction: f64,
}

/// The shape of an obstacle at its pose.
pub(super) enum PosedShape {
    Round(Capsule),
    Box(PosedBox),
    Plane { origin: Vec3, normal: Vec3 },
}

impl Posed {
    /// The obstacle `later` seconds after its pose was stored.
    pub fn new(o: &Obstacle, later: f64) -> Self {
        let s = o.setup();
        let (position, axes) = o.pose_after(later);
        let shape = match s.shape {
            Shape::Box { half } => PosedShape::Box(PosedBox {
                centre: position,
                axes,
                half,
            }),
            Shape::Plane => PosedShape::Plane {
                origin: position,
                normal: axes.z,
            },
            round => {
                let c = round.capsule().expect("spheres and capsules are round");
                PosedShape::Round(Capsule {
                    a: position + axes * c.a,
                    b: position + axes * c.b,
                    ..c
                })
            }
        };
        Self {
            shape,
            friction: s.friction,
        }
    }

    /// The floor.
    pub fn ground(friction: f64) -> Self {
        Self {
            shape: PosedShape::Plane {
                origin: Vec3::zero(),
                normal: Vec3::Z,
            },
            friction,
        }
    }
}

/// A capsule of a segment in the world.
pub(super) fn posed(t: &Placement, s: usize, c: &Capsule) -> Capsule {
    let (p, r) = (t.segment_position(s), t.segment_rotation(s));
    Capsule {
        a: p + r * c.a,
        b: p + r * c.b,
        ..*c
    }
}
