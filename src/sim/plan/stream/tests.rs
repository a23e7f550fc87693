use super::*;
use crate::math::trig;
use crate::motion::builtin::{at_ease, builtin};
use crate::motion::leg_ik::{forward, solve_leg};

/// Feeds `posture` sample by sample and returns the output, one target per sample.
fn through(
    body: &Arc<Body>,
    window: f64,
    samples: usize,
    posture: impl Fn(usize) -> Posture,
) -> (StreamPlan, Vec<Target>) {
    let mut live = StreamPlan::new(Arc::clone(body), window);
    let mut out = Vec::new();
    for i in 0..samples {
        live.push(&posture(i), None);
        let t = StreamTime((i + 1) as f64 / RATE - live.window());
        live.advance(t);
        if t.0 >= 0.0 {
            let ready = live.ready();
            assert!(ready >= t - 1e-9, "{t:?}: only {ready:?} is ready");
            out.push(live.sample(t));
        }
    }
    (live, out)
}

#[test]
fn who_stands_stays_as_he_is() {
    let body = Arc::new(Body::adult_man());
    let stand = at_ease(&body);
    for window in [0.3, 0.5, 1.0] {
        let (live, out) = through(&body, window, 150, |_| stand);
        assert!((live.window() - window).abs() < 1e-9);
        for t in &out {
            assert_eq!(t.planted, [true; 2]);
            // Legs that are nearly straight are bent a little: the pelvis comes down by a centimetre.
            let off = stand.difference(&t.posture);
            assert!(off[..29].iter().all(|e| e.abs() < 0.012), "{off:?}");
            assert!(off.iter().all(|e| e.abs() < 0.15), "{off:?}");
            assert!(t.velocity.iter().all(|v| v.abs() < 1e-2));
        }
    }
}

#[test]
fn planted_feet_do_not_slide_and_the_motion_is_its_own_derivative() {
    let body = Arc::new(Body::adult_man());
    let walk = builtin(&body, "walk").unwrap();
    // As a camera records it: with a slow wobble of a centimetre over everything.
    let seen = |i: usize| {
        let t = i as f64 / RATE;
        let mut p = walk.sample(t).posture;
        p.root_position += Vec3 {
            x: 0.01 * (2.0 * t).sin(),
            y: 0.01 * (1.3 * t).cos(),
            z: 0.005 * (1.7 * t).sin(),
        };
        p
    };
    let (_, out) = through(&body, 1.0, 400, seen);
    let mut stands: [Option<Vec3>; 2] = [None; 2];
    let mut steps = 0;
    for pair in out.windows(2) {
        let e = pair[0].posture.difference(&pair[1].posture);
        for k in 0..NV {
            let v = 0.5 * (pair[0].velocity[k] + pair[1].velocity[k]);
            let bend = (pair[0].acceleration[k] - pair[1].acceleration[k]).abs();
            let allowed = 2e-3 + 0.01 * bend / RATE;
            assert!(
                (e[k] - v / RATE).abs() < allowed,
                "{k}: {} {}",
                e[k],
                v / RATE
            );
        }
        let poses = forward(&body, &pair[1].posture);
        for side in 0..2 {
            let at = Sole::new(&body, side)
                .footing(AnklePose::of(&poses, side))
                .place;
            if !pair[1].planted[side] {
                steps += usize::from(stands[side].is_some());
                stands[side] = None;
            } else if pair[0].planted[side] {
                let place = *stands[side].get_or_insert(at);
                assert!((at - place).norm() < 4e-3, "{}", (at - place).norm());
            }
        }
    }
    assert!(steps >= 5, "{steps} steps");
}

#[test]
fn a_stream_that_jumps_goes_on_from_where_it_was() {
    let body = Arc::new(Body::adult_man());
    let stand = at_ease(&body);
    let other_support = |i: usize| {
        let mut p = stand;
        let place = PlanarTransform {
            x: 7.0,
            y: -3.0,
            yaw: 2.0,
        };
        if (60..120).contains(&i) {
            place.apply_posture(&mut p);
        }
        if (120..122).contains(&i) {
            p.root_position.z = f64::NAN;
        }
        p
    };
    let (_, out) = through(&body, 0.5, 240, other_support);
    for t in &out {
        let e = stand.difference(&t.posture);
        assert!(e.iter().all(|e| e.abs() < 0.15), "{e:?}");
        assert!(e[3..5].iter().all(|e| e.abs() < 0.02), "{e:?}");
        assert!(t.velocity.iter().all(|v| v.abs() < 0.3), "{:?}", t.velocity);
    }
}

#[test]
fn wild_streams_stay_finite_and_bounded() {
    use rand::{Rng, SeedableRng};
    let body = Arc::new(Body::adult_man());
    let mut random = rand_pcg::Pcg64::seed_from_u64(3);
    let mut live = StreamPlan::new(Arc::clone(&body), 0.3);
    for i in 0..600 {
        let mut p = at_ease(&body);
        p.root_position = Vec3::from_array([0; 3].map(|_| random.random_range(-1e4..1e4)));
        for q in &mut p.ball {
            *q = Quat::exp(Vec3::from_array(
                [0; 3].map(|_| random.random_range(-3.0..3.0)),
            ));
        }
        live.push(&p, Some([random.random(), random.random()]));
        let t = StreamTime(i as f64 / RATE - 0.3);
        live.advance(t);
        let t = live.sample(t);
        assert!(t.posture.is_finite());
        assert!(
            t.velocity
                .iter()
                .chain(&t.acceleration)
                .all(|v| v.is_finite())
        );
    }
    // Clocks that leap do not make it work for ever.
    live.advance(StreamTime(1e9));
    for _ in 0..3 * MOST_PENDING {
        live.push(&at_ease(&body), None);
    }
    assert!(live.fed() < 10_000);
}

#[test]
fn where_a_stream_walks_makes_no_difference() {
    let body = Arc::new(Body::adult_man());
    let walk = builtin(&body, "walk").unwrap();
    let far = Vec3 {
        x: 3000.0,
        y: -2000.0,
        z: 0.0,
    };
    let seen = |i: usize| walk.sample(i as f64 / RATE).posture;
    let (_, here) = through(&body, 0.5, 300, seen);
    let (_, there) = through(&body, 0.5, 300, |i| {
        let mut p = seen(i);
        p.root_position += far;
        p
    });
    for (a, b) in here.iter().zip(&there) {
        let mut back = b.posture;
        back.root_position -= far;
        let off = a.posture.difference(&back);
        assert!(off.iter().all(|e| e.abs() < 1e-6), "{off:?}");
        assert_eq!(a.planted, b.planted);
    }
}

#[test]
fn the_momentum_of_the_stream_is_known_ahead_of_what_is_put_out() {
    let body = Arc::new(Body::adult_man());
    let fall = |t: f64| {
        let mut p = at_ease(&body);
        p.root_rotation = Quat::exp(Vec3::Y * (2.0 * t)) * p.root_rotation;
        p.root_position.z += 2.0;
        p
    };
    let (live, out) = through(&body, 0.5, 120, |i| fall(i as f64 / RATE));
    let newest = 119.0 / RATE;
    let emit = live.ready().0;
    let spin_at = |t: f64| live.spin_at(StreamTime(t));
    assert!(out.len() > 60 && emit < newest - 0.4);
    assert_eq!(spin_at(newest), None, "its neighbours have not come");
    assert_eq!(spin_at(f64::NAN), None);
    for t in [-1.0, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        assert_eq!(spin_at(t), None, "{t}");
    }
    // One rigid body that turns: inertia about the lateral axis, from its own links, times the rate.
    for t in [emit, emit + 0.2, newest - 0.1] {
        let poses = forward(&body, &fall(t));
        let com = crate::motion::leg_ik::center_of_mass(&body, &poses);
        let rate = Vec3::Y * 2.0;
        let mut expected = Vec3::zero();
        for (segment, (at, q)) in body.segments.iter().zip(&poses) {
            let arm = *at + q.rotate(segment.com) - com;
            expected += arm.cross(rate.cross(arm)) * segment.mass
                + q.rotate(segment.inertia * q.conjugate().rotate(rate));
        }
        let found = spin_at(t).unwrap();
        let off = (found - expected).norm();
        assert!(off < 0.01 * expected.norm(), "{t}: {found:?} {expected:?}");
    }
}

/// A standing man whose feet are moved: each is raised (m), turned about the vertical and pitched toes up (rad) by the
/// given amounts.
fn standing_with(body: &Body, feet: [(f64, f64, f64); 2]) -> Posture {
    let mut p = at_ease(body);
    p.root_position.z -= 0.03;
    let poses = forward(body, &at_ease(body));
    for (side, (up, yaw, pitch)) in feet.into_iter().enumerate() {
        let (ankle, rotation) = poses[FEET[side].index()];
        let to = Quat::exp(Vec3::Z * yaw) * rotation * Quat::exp(Vec3::Y * -pitch);
        solve_leg(body, &mut p, side == 0, (ankle + Vec3::Z * up, to), 0.0);
    }
    p
}

#[test]
fn a_foot_on_the_tip_of_its_toes_does_not_stand_however_still_it_is() {
    let body = Arc::new(Body::adult_man());
    let tiptoe = standing_with(&body, [(0.13, 0.0, -1.2), (0.0, 0.0, 0.0)]);
    for window in [0.3, 1.0] {
        let (live, out) = through(&body, window, 150, |_| tiptoe);
        for t in &out {
            assert_eq!(t.planted, [false, true]);
        }
        assert_eq!(live.stances(0).count(), 0, "nor is it about to");
    }
}

#[test]
fn feet_that_turn_on_the_floor_are_set_down_anew_one_after_the_other() {
    let body = Arc::new(Body::adult_man());
    let outward = |i: usize| 0.9 * ((i as f64 - 120.0) / 60.0).clamp(0.0, 1.0);
    for (window, both) in [(0.3, false), (1.0, false), (1.0, true)] {
        let turning = |i: usize| {
            let right = if both { -outward(i) } else { 0.0 };
            standing_with(&body, [(0.0, outward(i), 0.0), (0.0, right, 0.0)])
        };
        let (_, out) = through(&body, window, 400, turning);
        let lifted = |side: usize| out.iter().filter(|t| !t.planted[side]).count();
        assert!(out.iter().all(|t| t.planted != [false; 2]), "{window} s");
        assert!(lifted(0) > 5, "{window} s: {}", lifted(0));
        assert_eq!(lifted(1) > 5, both, "{window} s: {}", lifted(1));
        let end = forward(&body, &out[out.len() - 1].posture)[FEET[0].index()].1;
        let off = end.heading() - forward(&body, &turning(399))[FEET[0].index()].1.heading();
        assert!(off.abs() < 0.45, "{window} s: {off}");
    }
}

#[test]
fn who_rocks_to_and_fro_is_not_carried_by_a_chair() {
    let body = Arc::new(Body::adult_man());
    let stand = at_ease(&body);
    // How strongly the feet are believed to carry a body that moves like that.
    let believed = |posture: &dyn Fn(f64) -> Posture| {
        let mut live = StreamPlan::new(Arc::clone(&body), 0.5);
        for i in 0..300 {
            live.push(&posture(i as f64 / RATE), Some([true; 2]));
            live.advance(StreamTime((i + 1) as f64 / RATE - live.window()));
        }
        live.at(live.count - 1 - LABEL).trust
    };
    // Its zero-moment point is 0.3 m outside the feet, on either side, at every turning point.
    let rocks = believed(&|t| {
        let mut p = stand;
        p.root_position.y += 0.035 * trig::sin_cos(4.0 * std::f64::consts::PI * t).0;
        p
    });
    assert!(rocks > 0.99, "{rocks}");
    let leans = believed(&|_| {
        let mut p = stand;
        p.root_rotation = Quat::exp(Vec3::Y * 0.45) * p.root_rotation;
        p
    });
    assert!(leans < 0.01, "{leans}");
}
