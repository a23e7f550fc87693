//! The measures by which a state is judged: its distance from the recording in everything that decides whether the
//! motion can continue.

use super::settings::Sizes;
use crate::body::topology::{
    DOF_COUNT, L_FOOT, L_HAND, L_TOES, R_FOOT, R_HAND, R_TOES, SEGMENT_COUNT, SegmentId,
};
use crate::body::{Body, Links, Posture, State};
use crate::dynamics::{Kinematics, center_of_mass, momentum};
use crate::math::Vec3;

/// The body as a whole in one state.
#[derive(Clone, Debug)]
pub struct Look {
    /// Centre of mass, world, m.
    pub com: Vec3,
    /// Its velocity, m/s.
    pub velocity: Vec3,
    /// Angular momentum about it, kg·m²/s.
    pub spin: Vec3,
    /// Origins of the segments, world, m.
    pub at: [Vec3; SEGMENT_COUNT],
    /// Heights of the lowest points of left and right hand, left and right foot, m.
    pub lowest: [f64; 4],
}

/// √(l/g) of a body that falls over, s, where l is the height of its centre of mass.
const FALL_TIME: f64 = 0.32;
const ENDS: [&[SegmentId]; 4] = [&[L_HAND], &[R_HAND], &[L_FOOT, L_TOES], &[R_FOOT, R_TOES]];

/// Measures states of one body. Allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct Looker {
    kin: Kinematics<f64>,
}

impl Looker {
    /// Measures `state`.
    pub fn look(&mut self, body: &Body, links: &Links, state: &State) -> Look {
        let kin = &mut self.kin;
        kin.set_state(links, state);
        let root = state.posture.root_position;
        let (com, mass) = center_of_mass(links, kin);
        let p = momentum(links, kin);
        Look {
            com: root + com,
            velocity: p.linear * (1.0 / mass),
            spin: p.angular,
            at: std::array::from_fn(|s| root + kin.position[s]),
            lowest: ENDS.map(|end| {
                let heights = end.iter().flat_map(|s| {
                    let (at, turn) = (kin.position[s.index()].z, kin.rotation[s.index()]);
                    let points = &body.segment(*s).contact_points;
                    points.iter().map(move |p| at + (turn * *p).z)
                });
                root.z + heights.fold(f64::INFINITY, f64::min)
            }),
        }
    }
}

/// Distance of a body from its desired state.
#[derive(Clone, Copy, Debug)]
pub struct Off {
    /// Mean distance of the segment origins, m.
    pub mean: f64,
    /// Distance on the floor between the two extrapolated centres of mass, each relative to its feet, m.
    pub balance: f64,
}

impl Look {
    /// Distance from another look.
    pub fn off(&self, other: &Self) -> Off {
        let apart = self.heading_for() - other.heading_for();
        Off {
            mean: self.distance(other),
            balance: (apart.x * apart.x + apart.y * apart.y).sqrt(),
        }
    }

    /// Place of the centre of mass, relative to the middle between the feet, to which it moves if nothing stops it (Hof
    /// et al. 2005, *The condition for dynamic stability*: the extrapolated centre of mass), m.
    fn heading_for(&self) -> Vec3 {
        let middle = (self.at[L_FOOT.index()] + self.at[R_FOOT.index()]) * 0.5;
        self.com - middle + self.velocity * FALL_TIME
    }

    /// Mean distance of the segment origins from those of another look, m.
    pub fn distance(&self, other: &Self) -> f64 {
        let all = self.at.iter().zip(&other.at).map(|(a, b)| (*a - *b).norm());
        all.sum::<f64>() / SEGMENT_COUNT as f64
    }
}

/// Weights of errors.
#[derive(Clone, Debug)]
pub struct Cost {
    sizes: Sizes,
    joints: [f64; DOF_COUNT],
}

impl Cost {
    /// From the sizes that cost 1.
    pub fn new(sizes: Sizes) -> Self {
        Self {
            joints: sizes.joint_weights(),
            sizes,
        }
    }

    /// Cost of being in a `posture`, seen as `is`, instead of the `wanted` one, seen as `should`.
    pub fn of(&self, (posture, is): (&Posture, &Look), (wanted, should): (&Posture, &Look)) -> f64 {
        let size = &self.sizes;
        let square = |v: Vec3| v.dot(v);
        let level = |v: Vec3| v.x * v.x + v.y * v.y;
        let over = |x: f64, size: f64| x / (size * size);
        let off = posture.joint_difference(wanted);
        let joints: f64 = off.iter().zip(&self.joints).map(|(e, w)| w * e * e).sum();
        let turn = (wanted.root_rotation * posture.root_rotation.conjugate()).log();
        let ends = is.lowest.iter().zip(&should.lowest);
        let com = should.com - is.com;
        let feet = [L_FOOT, R_FOOT].map(|s| {
            let under = |l: &Look| l.at[s.index()] - l.com;
            level(under(should) - under(is))
        });
        over(joints / DOF_COUNT as f64, size.joints)
            + over(square(turn), size.turn)
            + over(ends.map(|(a, b)| (a - b) * (a - b)).sum(), size.ends)
            + over(com.z * com.z, size.height)
            + over(level(com), size.place)
            + over(square(should.velocity - is.velocity), size.velocity)
            + over(square(should.spin - is.spin), size.spin)
            + over(feet[0] + feet[1], size.feet)
            + over(level(should.heading_for() - is.heading_for()), size.balance)
    }
}
