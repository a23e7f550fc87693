//! The demands of a sample on the floor: its angular momentum, its zero-moment point, and whether the feet can provide
//! that.

use super::receding_horizon::Balanced;
use super::{H, RATE, Sample, StreamPlan};
use crate::body::topology::SEGMENT_COUNT;
use crate::math::curve::smoothstep;
use crate::math::exp::exp;
use crate::math::polygon::SmallPolygon;
use crate::math::{Quat, Vec3};
use crate::motion::GRAVITY;
use crate::motion::leg_ik::{center_of_mass, forward};
use crate::plan::ankle_torque_limit::Over;
use crate::plan::params::balance;
use crate::plan::pelvis_shift::{GroundWrench, lasts_outside, pendulum_omega2, zero_moment_point};

impl StreamPlan {
    /// Angular momentum of sample `i` by central differences.
    pub(super) fn momentum(&mut self, i: i64) {
        if i >= 0 {
            let poses = |i: i64| &self.at(i).poses;
            let sum = self.spin([poses(i - 1), poses(i), poses(i + 1)]);
            self.at_mut(i).momentum = sum;
        }
    }

    /// Angular momentum about the centre of mass in the middle of three successive poses, kg·m²/s.
    fn spin(&self, [a, b, c]: [&[(Vec3, Quat); SEGMENT_COUNT]; 3]) -> Vec3 {
        let com = center_of_mass(&self.body, b);
        let mut sum = Vec3::zero();
        for (s, segment) in self.body.segments.iter().enumerate() {
            let centre = |p: &[(Vec3, Quat); SEGMENT_COUNT]| p[s].0 + p[s].1.rotate(segment.com);
            let v = (centre(c) - centre(a)) * (0.5 * RATE);
            let q = b[s].1;
            let turn = (c[s].1 * a[s].1.conjugate()).log() * (0.5 * RATE);
            let spin = q.conjugate().rotate(turn);
            let arm = centre(b) - com;
            sum += arm.cross(v) * segment.mass + q.rotate(segment.inertia * spin);
        }
        sum
    }

    /// Computes how far the received zero-moment point of sample `j` is from where the feet could have it.
    pub(super) fn balance(&mut self, j: i64) {
        let (mut balanced, load) = self.balanced(j, |s| (s.com, s.momentum));
        let way = balanced.way_inside();
        // Over about a second: peaks of gait, which go there and back, are corrected, a chair is not.
        for (lasting, way) in self.balance.lasting.iter_mut().zip(way) {
            *lasting += (way - *lasting) * (1.0 - exp(-H));
        }
        let far = Vec3::on_floor(self.balance.lasting).level();
        let trust = 1.0 - smoothstep(lasts_outside(far));
        self.at_mut(j).trust = trust;
        balanced.weight = trust * load * load;
        self.balance.horizon.push(balanced);
    }

    /// The balance of sample `j` with the centre of mass and the angular momentum given by `of`, and its load, 0…1.
    fn balanced(&self, j: i64, of: impl Fn(&Sample) -> (Vec3, Vec3)) -> (Balanced, f64) {
        let at = |i: i64| of(self.at(i));
        let (a, b, c) = (at(j - 2).0, at(j).0, at(j + 2).0);
        let acc = (c - b * 2.0 + a) * (0.25 * RATE * RATE);
        let rate = (at(j + 1).1 - at(j - 1).1) * (0.5 * RATE);
        let mass: f64 = self.body.segments.iter().map(|s| s.mass).sum();
        let load = 1.0 + acc.z / GRAVITY;
        let omega2 = pendulum_omega2(b.z, acc.z);
        let heading = self.at(j).smooth.root_rotation.heading();
        let mut balanced = Balanced::new(b.xy(), omega2, heading);
        if load > balance::LEAST_LOAD && j >= 2 {
            let wrench = GroundWrench {
                force: (acc + Vec3::Z * GRAVITY) * mass,
                moment: rate,
            };
            let z = zero_moment_point(b, wrench);
            let way = (c - a) * (0.25 * RATE);
            let over = Over {
                height: b.z,
                speed: way.level(),
                lean: [b.x - z[0], b.y - z[1]],
                load: None,
            };
            let placements: [_; 2] =
                std::array::from_fn(|side| self.feet[side].anchor(j, |i| self.standing(side, i)));
            let alone = placements[0].is_some() != placements[1].is_some();
            let mut polygon = SmallPolygon::default();
            for (sole, anchor) in self.soles.iter().zip(&placements) {
                match anchor {
                    Some(at) if alone => {
                        self.ankle_limit
                            .each_corner(sole, at, &over, |p| polygon.add(p));
                    }
                    Some(at) => sole.each_corner(at, |p| polygon.add(p)),
                    None => {}
                }
            }
            balanced = Balanced::new(z, omega2, heading);
            balanced.support = polygon.inner(balance::INSET);
        }
        (balanced, load.clamp(0.0, 1.0))
    }

    /// Assembles sample `i` as planned, and computes its balance.
    pub(super) fn build(&mut self, i: i64) {
        let shift = self.planned(i);
        let posture = self.posture(i, shift);
        let poses = forward(&self.body, &posture);
        let com = center_of_mass(&self.body, &poses);
        let s = self.at_mut(i);
        s.built.poses = poses;
        s.built.com = com - Vec3::on_floor(shift);
        let before = |k: i64| &self.at(i - k).built.poses;
        let sum = self.spin([before(2), before(1), before(0)]);
        if i < 4 {
            return;
        }
        self.at_mut(i - 1).built.momentum = sum;
        self.improve(i - 2, |s| (s.built.com, s.built.momentum));
    }

    /// Computes the balance of sample `i` again, with the centre of mass and the angular momentum given by `of`.
    pub(super) fn improve(&mut self, i: i64, of: impl Fn(&Sample) -> (Vec3, Vec3)) {
        let (mut better, load) = self.balanced(i, of);
        better.weight = self.at(i).trust * load * load;
        self.balance.horizon.improve(i, better);
    }
}
