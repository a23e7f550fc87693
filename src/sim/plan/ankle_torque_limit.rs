//! The support that one foot can give alone: the zero-moment points for which its ankle is strong enough.
//!
//! Soles reach farther than the muscles over them: an adult man's toes end 20 cm in front of the ankle, but his calf
//! holds the weight no farther than 14 cm in front of it. A motion planned up to the edge of the sole leaves no torque
//! with which the body could correct anything.

use super::foot_lock::{FootPlacement, Sole};
use crate::body::Body;
use crate::body::topology::{DOF_COUNT, DOF_START, L_FOOT};
use crate::math::Vec3;
use crate::motion::GRAVITY;
use crate::plan::params::ankle;
use crate::strength::{MuscleScale, Strength};

/// Position of a body relative to its supporting foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over {
    /// Height of the centre of mass, m.
    pub height: f64,
    /// Its speed over the floor, m/s.
    pub speed: f64,
    /// From the zero-moment point to the centre of mass, over the floor, m.
    pub lean: [f64; 2],
    /// Load on a runner's foot, in units of the weight; absent in a walk.
    pub load: Option<f64>,
}

/// Limits of the support of one foot that carries the whole body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AnkleTorqueLimit {
    /// Distance in front of the ankle at which the weight of the body takes [`ankle::STRENGTH_SHARE`] of the strength
    /// of the ankle, or [`ankle::LEAST_SOLE`] of the sole, m.
    front: f64,
    /// How much farther that is than the ankle can hold, m.
    lacks: f64,
    /// Height of the ankle over the floor, m.
    ankle: f64,
}

impl AnkleTorqueLimit {
    /// For a body of average strength, standing with its foot flat. Allocates.
    pub fn new(body: &Body) -> Self {
        let weight = GRAVITY * body.segments.iter().map(|s| s.mass).sum::<f64>();
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        Strength::for_body(body).range(
            &[0.0; DOF_COUNT],
            &[0.0; DOF_COUNT],
            &MuscleScale::default(),
            &mut lower,
            &mut upper,
        );
        let sole = Sole::new(body, 0);
        let toes = sole.points(0.0).map(|p| p.x).fold(0.0, f64::max);
        let firm = -ankle::STRENGTH_SHARE * lower[DOF_START[L_FOOT.index()]] / weight;
        let lacks = (ankle::LEAST_SOLE * toes - firm).max(0.0);
        let front = firm + lacks;
        Self {
            front,
            lacks,
            ankle: sole.ankle_height,
        }
    }

    /// Visits the corners (x, y) of the support of a foot that stands alone at `at`.
    ///
    /// The ankle feels the line of force where it passes the height of the ankle, a little from the zero-moment point
    /// towards the centre of mass.
    pub fn each_corner(
        &self,
        sole: &Sole,
        at: &FootPlacement,
        over: &Over,
        mut visit: impl FnMut([f64; 2]),
    ) {
        let Over {
            height,
            speed,
            lean,
            load,
        } = *over;
        let hurry = ((speed - ankle::SLOW) / (ankle::FAST - ankle::SLOW)).clamp(0.0, 1.0);
        let mut front = self.front * (1.0 + ankle::FAST_EXTENSION * hurry) + self.lacks * hurry;
        if let Some(load) = load {
            front = self.front / load.max(ankle::LEAST_LOAD);
        }
        // A runner is over the ball of the foot before this limit matters.
        if at.is_on_ball() && load.is_none() {
            front = front.max(sole.toe_joint.x + ankle::BALL);
        }
        let rise = self.ankle / height.max(self.ankle);
        let lean = lean.map(|d| d * rise);
        let far = Vec3::on_floor(lean).level();
        let share = (ankle::MOST_MOVED / far.max(ankle::MOST_MOVED)).min(1.0);
        let ahead = at.ahead();
        sole.each_corner(at, |p| {
            let x = (p[0] - at.place.x) * ahead[0] + (p[1] - at.place.y) * ahead[1];
            let cut = (x - front).max(0.0);
            visit(std::array::from_fn(|k| {
                p[k] - cut * ahead[k] - share * lean[k]
            }));
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Profile, Sex};
    use crate::math::polygon::{hull, margin};

    const AT: FootPlacement = FootPlacement {
        place: Vec3 {
            x: 0.3,
            y: -0.2,
            z: 0.0,
        },
        yaw: 0.7,
        pitch: 0.0,
        tip: 0.0,
    };

    fn support(one: &AnkleTorqueLimit, sole: &Sole, lean: [f64; 2], speed: f64) -> Vec<[f64; 2]> {
        let mut corners = Vec::new();
        let over = Over {
            height: 1.0,
            speed,
            lean,
            load: None,
        };
        one.each_corner(sole, &AT, &over, |p| corners.push(p));
        hull(&corners)
    }

    #[test]
    fn the_support_ends_where_the_calf_does() {
        for body in [Body::adult_man(), Body::adult_woman()] {
            let (one, sole) = (AnkleTorqueLimit::new(&body), Sole::new(&body, 0));
            let p = support(&one, &sole, [0.0, 0.0], 0.0);
            let before = |x: f64| [AT.place.x + x * 0.7f64.cos(), AT.place.y + x * 0.7f64.sin()];
            assert!(margin(&p, before(one.front)).abs() < 1e-9);
            assert!(margin(&p, before(one.front - 0.01)) > 0.009);
            let toes = sole.points(0.0).map(|p| p.x).fold(0.0, f64::max);
            assert!(one.front > 0.5 * toes && one.front < 0.9 * toes, "{one:?}");
            let hurried = support(&one, &sole, [0.0, 0.0], 2.0);
            assert!(margin(&hurried, before(one.front)) > 0.01);
        }
    }

    #[test]
    fn nobody_stands_behind_the_ball_of_a_foot_whose_heel_is_up() {
        for body in [Body::adult_man(), Body::adult_woman()] {
            let (one, sole) = (AnkleTorqueLimit::new(&body), Sole::new(&body, 0));
            let at = FootPlacement { pitch: -0.3, ..AT };
            for speed in [0.0, 2.0] {
                let over = Over {
                    height: 1.0,
                    speed,
                    lean: [0.0, 0.0],
                    load: None,
                };
                let mut reach = (f64::INFINITY, f64::NEG_INFINITY);
                one.each_corner(&sole, &at, &over, |p| {
                    let x = (p[0] - at.place.x) * 0.7f64.cos() + (p[1] - at.place.y) * 0.7f64.sin();
                    reach = (reach.0.min(x), reach.1.max(x));
                });
                let ball = sole.toe_joint.x;
                assert!(
                    reach.0 >= ball - 0.01 && reach.1 >= ball + ankle::BALL - 1e-9,
                    "{speed} m/s: {reach:?}, ball at {ball}"
                );
            }
        }
    }

    #[test]
    fn the_more_a_runner_weighs_on_his_foot_the_nearer_to_his_ankle() {
        let body = Body::adult_man();
        let (one, sole) = (AnkleTorqueLimit::new(&body), Sole::new(&body, 0));
        let reach = |load: f64| {
            let over = Over {
                height: 1.0,
                speed: 3.5,
                lean: [0.0, 0.0],
                load: Some(load),
            };
            let mut most = f64::NEG_INFINITY;
            one.each_corner(&sole, &AT, &over, |p| {
                let x = (p[0] - AT.place.x) * 0.7f64.cos() + (p[1] - AT.place.y) * 0.7f64.sin();
                most = most.max(x);
            });
            most
        };
        // The moment about the ankle equals the ankle's strength there.
        assert!((reach(1.0) - one.front).abs() < 1e-9);
        assert!((reach(2.5) - one.front / 2.5).abs() < 1e-9);
        // The reach ends at the toes.
        let toes = sole.points(0.0).map(|p| p.x).fold(0.0, f64::max);
        assert!((reach(0.1) - toes).abs() < 1e-9);
    }

    #[test]
    fn a_weak_calf_is_planned_on_most_of_its_sole_and_at_speed_on_all_of_it() {
        let old = |age| Body::humanoid(Profile::ordinary(Sex::Male, age)).unwrap();
        for body in [old(70.0), old(80.0)] {
            let (one, sole) = (AnkleTorqueLimit::new(&body), Sole::new(&body, 0));
            let toes = sole.points(0.0).map(|p| p.x).fold(0.0, f64::max);
            assert!(
                (one.front - ankle::LEAST_SOLE * toes).abs() < 1e-12,
                "{one:?}"
            );
            let mut whole = Vec::new();
            sole.footprint(&AT, &mut whole);
            assert_eq!(support(&one, &sole, [0.0, 0.0], ankle::FAST), hull(&whole));
        }
        // The limit has no effect while the ankle is strong enough, and there is no jump where it takes effect.
        let at = |age: f64| AnkleTorqueLimit::new(&old(age));
        let young = at(30.0);
        assert!(young.lacks == 0.0 && at(70.0).lacks > 0.02);
        for age in 45..80 {
            let (a, b) = (at(f64::from(age)), at(f64::from(age) + 1.0));
            let step = (a.front - b.front).abs().max((a.lacks - b.lacks).abs());
            assert!(step < 0.006, "{age}: {a:?}, {b:?}");
        }
    }

    #[test]
    fn it_moves_against_the_lean_as_far_as_the_ankle_is_high() {
        let body = Body::adult_man();
        let (one, sole) = (AnkleTorqueLimit::new(&body), Sole::new(&body, 0));
        let still = support(&one, &sole, [0.0, 0.0], 0.0);
        for (lean, moved) in [(0.1, 0.1 * sole.ankle_height), (1.0, ankle::MOST_MOVED)] {
            for (a, b) in still.iter().zip(&support(&one, &sole, [lean, 0.0], 0.0)) {
                assert!((a[0] - b[0] - moved).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12);
            }
        }
    }
}
