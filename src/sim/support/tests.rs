//! Supports of whole figures: statics, cart-table, Eq. (3) two ways, tipping of boxes and feet.

use super::ratio::{Touching, support_ratios};
use super::testing::{GRAVITY, Rng, mannequin, random_stance, random_state, standing, terms};
use super::zmp::{FootLoad, foot_ground_wrench, foot_zmp};
use super::*;
use crate::body::topology::{L_FOOT, L_TOES, NV, R_FOOT, R_HAND, R_SHANK, R_TOES};
use crate::body::{Links, State};
use crate::math::Quat;
use crate::math::vec3::vec3;

fn supported(state: &State) -> (Terms, Support) {
    let body = mannequin();
    let t = terms(&body, state);
    let mut s = Support::default();
    s.update(&t, &body, Vec3::zero(), GRAVITY);
    (t, s)
}

/// Equation (2) of the paper.
#[test]
fn standing_figure_has_two_supports_with_equal_ratios() {
    let (_, s) = supported(&standing(&mannequin()));
    assert_eq!(
        s.points().len(),
        12,
        "four corners of each sole and two of each toe cap"
    );
    assert!(
        s.points()
            .iter()
            .all(|p| p.support == L_FOOT || p.support == R_FOOT)
    );
    // Toes that touch together with their foot are not a separate support: they count with the foot.
    let is_support = |segment| s.points().iter().any(|p| p.support == segment);
    assert!(is_support(L_FOOT) && !is_support(L_TOES));
    assert!((s.ratio()[L_FOOT.index()] - 0.5).abs() < 1e-12);
    assert_eq!(s.main(), Some(L_FOOT));
    assert!(s.polygon().has_area());
}

/// Equation (2) of the paper, on planes of any slope: once written with angles, and once with the whole scene rotated.
#[test]
fn ratios_follow_the_normal_of_each_support() {
    let mut rng = Rng::new(2);
    let mut vector = |size: f64| {
        let mut part = || size * rng.unit();
        vec3(part(), part(), part())
    };
    let angle = |a: Vec3, b: Vec3| a.cross(b).norm().atan2(a.dot(b));
    for _ in 0..200 {
        let (com, pull) = (vector(1.0), vector(5.0) + Vec3::Z * GRAVITY);
        let supports = [L_FOOT, R_FOOT, R_HAND].map(|support| Touching {
            support,
            position: vector(1.0),
            normal: vector(1.0).normalized_or(Vec3::Z),
        });
        let alpha = supports.map(|t| {
            let l = com - t.position;
            (pull.norm() * angle(pull, l).cos() * angle(t.normal, l).cos()).max(0.0)
        });
        let total: f64 = alpha.iter().sum();
        let ratio = support_ratios(supports.into_iter(), com, pull);
        let turn = Quat::from_axis_angle(vector(1.0).normalized_or(Vec3::X), 1.0 + vector(1.0).x);
        let turned = supports.map(|t| Touching {
            position: turn.rotate(t.position),
            normal: turn.rotate(t.normal),
            ..t
        });
        let again = support_ratios(turned.into_iter(), turn.rotate(com), turn.rotate(pull));
        for (t, a) in supports.iter().zip(alpha) {
            let s = t.support.index();
            let expected = if total > 1e-6 { a / total } else { ratio[s] };
            assert!(
                (ratio[s] - expected).abs() < 1e-9,
                "{} {expected}",
                ratio[s]
            );
            assert!((ratio[s] - again[s]).abs() < 1e-9);
        }
        assert!((ratio.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}

/// Equation (2) of the paper: the hand on the wall of figure 3.
#[test]
fn who_moves_towards_a_wall_leans_more_on_the_hand_on_it() {
    let (t, _) = supported(&standing(&mannequin()));
    let hand = Rest {
        segment: R_HAND,
        position: t.com + vec3(0.5, 0.0, -0.1),
        normal: -Vec3::X,
        force: -Vec3::X * 50.0,
        lift: 0.0,
    };
    let mut before = 0.0;
    for step in 0..8 {
        let com = t.com + Vec3::X * (0.05 * f64::from(step));
        let (_, mut s) = supported(&standing(&mannequin()));
        s.rest_on(std::iter::once(hand), com, Vec3::Z * GRAVITY);
        let ratio = s.ratio()[R_HAND.index()];
        assert!(ratio > before, "{step}: {ratio} {before}");
        before = ratio;
    }
    // A surface that faces away carries nothing.
    let behind = Rest {
        normal: Vec3::X,
        ..hand
    };
    let (_, mut s) = supported(&standing(&mannequin()));
    s.rest_on(std::iter::once(behind), t.com, Vec3::Z * GRAVITY);
    assert_eq!(s.ratio()[R_HAND.index()], 0.0);
    assert!((s.ratio()[L_FOOT.index()] - 0.5).abs() < 1e-12);
}

/// Figure 3 of the paper: the hand stops the rotation about the foot's edge.
#[test]
fn a_hand_stops_the_rotation_that_would_push_it_into_what_it_rests_on() {
    let edge = Pivot::edge(vec3(0.2, 0.0, 0.0), Vec3::Y);
    let rest = |position: Vec3, normal: Vec3| Rest {
        segment: R_HAND,
        position,
        normal,
        force: normal * 50.0,
        lift: 0.0,
    };
    let wall = rest(vec3(0.7, -0.2, 1.3), -Vec3::X);
    let table = rest(vec3(0.6, -0.2, 0.8), Vec3::Z);
    let behind = rest(vec3(-0.4, 0.0, 0.5), Vec3::Z);
    let stopped = |spin: f64, r: &Rest| is_stopped(&edge, Vec3::Y * spin, std::iter::once(r));
    for front in [&wall, &table] {
        assert!(stopped(0.3, front), "forward, into it");
        assert!(!stopped(-0.3, front), "backward, away from it");
    }
    assert!(!stopped(0.3, &behind) && stopped(-0.3, &behind));
    // Only rotation about the edge counts; a part that does not move is not blocked.
    assert!(!is_stopped(
        &edge,
        vec3(0.3, 0.0, 0.5),
        std::iter::once(&wall)
    ));
    assert!(!stopped(0.0, &wall));
    assert!(!is_stopped(&edge, Vec3::Y, std::iter::empty()));
}

/// Equation (2) of the paper: a rest is a support like any other; it shares the reaction and is reported.
#[test]
fn what_it_rests_on_shares_the_reaction() {
    let (t, mut s) = supported(&standing(&mannequin()));
    assert_eq!(s.carriers(), s.points());
    let hand = Rest {
        segment: R_HAND,
        position: t.com + vec3(0.45, -0.2, -0.2),
        normal: Vec3::Z,
        force: Vec3::Z * 50.0,
        lift: 0.0,
    };
    s.rest_on(std::iter::once(hand), t.com, Vec3::Z * GRAVITY);
    assert_eq!(s.carriers().len(), s.points().len() + 1);
    let total = |about: Vec3| {
        let (f, at) = (Vec3::Z * (GRAVITY * t.mass), t.com + Vec3::X * 0.15);
        let n = (at - about).cross(f);
        [n.x, n.y, n.z, f.x, f.y, f.z]
    };
    let mut out = [false; MAX_CONTACTS];
    let mut sharing = Sharing::default();
    assert!(sharing.set_unilateral(s.carriers(), s.ratio(), &mut out, total));
    let y = sharing.multiplier(&total(sharing.reference));
    let on_hand = sharing.segment_wrench(R_HAND.index(), &y)[5];
    assert!(on_hand > 5.0, "{on_hand}");
    let all: f64 = [L_FOOT, R_FOOT, L_TOES, R_TOES, R_HAND]
        .map(|g| sharing.segment_wrench(g.index(), &y)[5])
        .iter()
        .sum();
    assert!((all - GRAVITY * t.mass).abs() < 1e-6 * all);
}

#[test]
fn contacts_enter_low_and_leave_high() {
    let body = mannequin();
    let mut state = standing(&body);
    let mut s = Support::default();
    let mut count = |height: f64| {
        state.posture.root_position.z = standing(&body).posture.root_position.z + height;
        s.update(&terms(&body, &state), &body, Vec3::zero(), GRAVITY);
        s.points().len()
    };
    assert_eq!(count(0.008), 0, "not yet");
    assert_eq!(count(0.005), 12);
    assert_eq!(count(0.008), 12, "still");
    assert_eq!(count(0.011), 0);
    assert_eq!(count(0.008), 0);
}

/// Equation (2) of the paper.
#[test]
fn main_support_is_kept_within_the_hysteresis() {
    let body = mannequin();
    let state = standing(&body);
    let t = terms(&body, &state);
    let mut s = Support::default();
    // Accelerating to the right needs the zero-moment point further left.
    s.update(&t, &body, vec3(0.0, -0.05, 0.0), GRAVITY);
    assert_eq!(s.main(), Some(L_FOOT));
    s.update(&t, &body, vec3(0.0, 0.05, 0.0), GRAVITY);
    assert!(s.load()[R_FOOT.index()] > s.load()[L_FOOT.index()]);
    assert_eq!(s.main(), Some(L_FOOT), "kept");
    s.update(&t, &body, vec3(0.0, 0.8, 0.0), GRAVITY);
    assert!(s.load()[R_FOOT.index()] > 0.8);
    let total: f64 = s.load().iter().sum();
    assert!((total - 1.0).abs() < 1e-12);
    assert_eq!(s.main(), Some(R_FOOT));
    s.reset();
    s.update(&t, &body, vec3(0.0, 0.05, 0.0), GRAVITY);
    assert_eq!(s.main(), Some(R_FOOT));
    // The ratios (2) hardly move.
    assert!((s.ratio()[L_FOOT.index()] - 0.5).abs() < 0.05);
}

#[test]
fn a_lifted_figure_has_no_support() {
    let mut state = standing(&mannequin());
    state.posture.root_position.z += 0.5;
    let (_, s) = supported(&state);
    assert!(s.main().is_none() && s.points().is_empty() && s.polygon().is_empty());
    assert!(s.margin(Vec3::zero()).is_none());
}

/// Equation (3) of the paper.
#[test]
fn zmp_of_static_pose_is_below_com() {
    let (body, mut rng) = (mannequin(), Rng::new(1));
    for _ in 0..20 {
        let t = terms(&body, &random_stance(&body, &mut rng, 0.5, 0.0));
        let (f, n) = t.ground_wrench(&[0.0; NV]);
        let z = zmp(f, n).unwrap();
        assert!((z.x - t.com.x).abs() < 1e-12 && (z.y - t.com.y).abs() < 1e-12);
    }
}

/// Equation (3) of the paper.
#[test]
fn zmp_of_a_sliding_figure_is_that_of_the_cart_table() {
    // The whole body accelerates as one: no angular momentum, so the ZMP is x − (z/g) ẍ.
    let body = mannequin();
    let t = terms(&body, &standing(&body));
    let mut a = [0.0; NV];
    (a[3], a[4]) = (1.3, -0.7);
    let (f, n) = t.ground_wrench(&a);
    let z = zmp(f, n).unwrap();
    assert!((z.x - (t.com.x - t.com.z / GRAVITY * 1.3)).abs() < 1e-12);
    assert!((z.y - (t.com.y + t.com.z / GRAVITY * 0.7)).abs() < 1e-12);
    a[5] = -GRAVITY;
    let (f, n) = t.ground_wrench(&a);
    assert!(zmp(f, n).is_none(), "free fall");
}

#[test]
fn force_is_mass_times_com_acceleration_minus_gravity() {
    let (body, mut rng) = (mannequin(), Rng::new(2));
    for _ in 0..20 {
        let t = terms(&body, &random_state(&body, &mut rng, 1.0, 3.0));
        let a: [f64; NV] = std::array::from_fn(|_| 10.0 * rng.unit());
        let (f, _) = t.ground_wrench(&a);
        let row = |k: usize| (0..NV).map(|i| t.jc[k][i] * a[i]).sum::<f64>();
        let c = vec3(row(0), row(1), row(2)) + t.com_bias;
        let expected = (c + vec3(0.0, 0.0, GRAVITY)) * t.mass;
        assert!((f - expected).norm() < 1e-9 * t.mass * GRAVITY);
    }
}

/// Load of the shank on the right foot (with its toes), from Newton's and Euler's equations of all *other* segments.
fn foot_load(links: &Links, t: &Terms, a: &[f64; NV], foot: &[usize]) -> FootLoad {
    let shank_end = t.segment_position(foot[0]);
    // Momentum rates of each segment by its point accelerations.
    let mut jacobian = [[0.0; 48]; 6];
    let mut rates = |s: usize, about: Vec3| {
        t.segment_jacobian(s, &mut jacobian);
        let row = |k: usize| (0..NV).map(|i| jacobian[k][i] * a[i]).sum::<f64>();
        let (bias_alpha, bias) = t.segment_bias(s);
        let alpha = vec3(row(0), row(1), row(2)) + bias_alpha;
        let acc = vec3(row(3), row(4), row(5)) + bias;
        let (w, m) = (t.kin.omega[s], links.mass[s]);
        let (h, i) = (t.kin.moment[s], t.kin.inertia[s]);
        let p = acc * m + alpha.cross(h) + w.cross(w.cross(h));
        let l = i * alpha + w.cross(i * w) + h.cross(acc);
        (
            p,
            l + (t.segment_position(s) - about).cross(p),
            h * (1.0 / m),
        )
    };
    let (mut com, mut mass, mut p) = (Vec3::zero(), 0.0, Vec3::zero());
    for s in foot {
        let (rate, _, c) = rates(*s, Vec3::zero());
        com += (t.segment_position(*s) + c) * links.mass[*s];
        mass += links.mass[*s];
        p += rate;
    }
    let com = com * (1.0 / mass);
    let spin_rate = foot
        .iter()
        .fold(Vec3::zero(), |sum, s| sum + rates(*s, com).1);
    // The foot alone carries the rest of the body, so the ankle transmits the ground reaction of all other segments.
    let (mut force, mut moment) = (Vec3::zero(), Vec3::zero());
    for s in (0..SEGMENT_COUNT).filter(|s| !foot.contains(s)) {
        let (rate, l, c) = rates(s, shank_end);
        let weight = vec3(0.0, 0.0, GRAVITY * links.mass[s]);
        let arm = t.segment_position(s) + c - shank_end;
        force += rate + weight;
        moment += l + arm.cross(weight);
    }
    FootLoad {
        ankle: shank_end,
        ankle_force: -force,
        ankle_moment: -moment,
        com,
        mass,
        com_acceleration: p * (1.0 / mass),
        spin_rate,
    }
}

/// Equation (3) of the paper.
#[test]
fn the_papers_foot_form_gives_the_total_wrench_zmp() {
    let (body, mut rng) = (mannequin(), Rng::new(3));
    let links = Links::new(&body);
    let foot = [R_FOOT.index(), R_FOOT.index() + 1];
    assert_eq!(body.segments.len(), SEGMENT_COUNT);
    assert_ne!(R_SHANK, R_FOOT);
    for _ in 0..20 {
        let t = terms(&body, &random_state(&body, &mut rng, 0.5, 2.0));
        let a: [f64; NV] = std::array::from_fn(|_| 2.0 * rng.unit());
        let (f, n) = t.ground_wrench(&a);
        let load = foot_load(&links, &t, &a, &foot);
        let (f2, n2) = foot_ground_wrench(&load, Vec3::zero(), GRAVITY);
        assert!((f - f2).norm() < 1e-9 * f.norm() && (n - n2).norm() < 1e-9 * f.norm());
        let (z, z2) = (zmp(f, n).unwrap(), foot_zmp(&load, GRAVITY).unwrap());
        assert!((z - z2).norm() < 1e-9);
    }
}

/// Repair S1.
#[test]
fn mmp_of_square_foot_is_on_the_edge_or_corner_the_zmp_left() {
    let mut foot = Polygon::default();
    foot.set_hull([[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]].into_iter());
    assert!(pivot(&foot, vec3(0.1, 0.1, 0.0)).is_none());
    for (z, mmp, axis) in [
        ([0.1, -0.3], [0.1, 0.0], [1.0, 0.0]),
        ([0.9, 0.15], [0.2, 0.15], [0.0, 1.0]),
        ([0.05, 0.21], [0.05, 0.2], [1.0, 0.0]),
        ([-1e-6, 0.03], [0.0, 0.03], [0.0, 1.0]),
    ] {
        let p = pivot(&foot, vec3(z[0], z[1], 0.0)).unwrap();
        assert!((p.point - vec3(mmp[0], mmp[1], 0.0)).norm() < 1e-15);
        assert_eq!(p.axes().len(), 1);
        assert!(p.axes()[0].cross(vec3(axis[0], axis[1], 0.0)).norm() < 1e-15);
        assert!((p.distance(vec3(mmp[0] + axis[0], mmp[1] + axis[1], 0.0))) < 1e-12);
    }
    for (z, corner) in [
        ([-0.1, -0.1], [0.0, 0.0]),
        ([0.3, -0.2], [0.2, 0.0]),
        ([0.25, 0.4], [0.2, 0.2]),
        ([-0.2, 0.3], [0.0, 0.2]),
    ] {
        let p = pivot(&foot, vec3(z[0], z[1], 0.0)).unwrap();
        assert!((p.point - vec3(corner[0], corner[1], 0.0)).norm() < 1e-15);
        assert_eq!(p.axes(), &[Vec3::X, Vec3::Y]);
    }
}

/// Repair S1.
#[test]
fn a_tilted_figure_pivots_on_what_touches() {
    let mut edge = Polygon::default();
    edge.set_hull([[0.0, 0.0], [0.0, 0.1]].into_iter());
    for x in [-0.2, 0.2] {
        let p = pivot(&edge, vec3(x, 0.05, 0.0)).unwrap();
        assert_eq!(p.axes().len(), 1);
        assert!(p.axes()[0].x.abs() < 1e-15);
    }
    assert_eq!(pivot(&edge, vec3(0.1, 0.4, 0.0)).unwrap().axes().len(), 2);
}

#[test]
fn a_corner_that_would_sink_holds_the_rotation() {
    // The figure leans far out over the right edge and slightly over the front one. About the corner alone it would
    // turn mostly to the right, which lifts the front-left corner and moves the back-right corner down or up, depending
    // on the direction of the lean.
    let body = mannequin();
    let t = terms(&body, &standing(&body));
    let (f, n) = t.ground_wrench(&[0.0; NV]);
    let z = zmp(f, n).unwrap();
    for (ahead, aside) in [(0.2, 0.2), (0.2, 0.001), (0.001, 0.2)] {
        let corner = [z.x - ahead, z.y + aside]; // front right
        let mut polygon = Polygon::default();
        let square = [[-0.2, 0.0], [0.0, 0.0], [0.0, 0.2], [-0.2, 0.2]];
        polygon.set_hull(
            square
                .map(|c| [corner[0] + c[0], corner[1] + c[1]])
                .into_iter(),
        );
        assert_eq!(pivot(&polygon, z).unwrap().axes().len(), 2);
        let p = unblocked_pivot(&t, &polygon, L_FOOT, (z, f, n), 1.0 / 60.0).unwrap();
        assert!((p.point - vec3(corner[0], corner[1], 0.0)).norm() < 1e-12);
        let spin = p.project(tipping_acceleration(&t, &p, f, n));
        for c in polygon.corners() {
            let down = spin.cross(vec3(c[0], c[1], 0.0) - p.point).z;
            assert!(down > -1e-9, "({ahead}, {aside}): {down}");
        }
        assert!(spin.norm() > 1e-3, "it tips");
    }
}

/// Repair S1.
#[test]
fn a_stiff_figure_on_an_edge_turns_like_a_box() {
    // A stiff body about an edge: ω̇ = m g l sin φ / I, l sin φ the horizontal distance of the centre of mass from the
    // edge.
    let body = mannequin();
    let t = terms(&body, &standing(&body));
    let (f, n) = t.ground_wrench(&[0.0; NV]);
    for offset in [0.02, 0.1, 0.4] {
        let edge = vec3(t.com.x - offset, 0.3, 0.0);
        let p = Pivot::edge(edge, Vec3::Y);
        let w = tipping_acceleration(&t, &p, f, n);
        // Inertia about the edge by the parallel-axis theorem over all segments.
        let links = Links::new(&body);
        let mut inertia = 0.0;
        for s in 0..SEGMENT_COUNT {
            let (m, h) = (links.mass[s], t.kin.moment[s]);
            let r = t.segment_position(s) - edge;
            // About the segment origin, moved: I_yy + 2 r·h + m r² without the y parts.
            let i = t.kin.inertia[s] * Vec3::Y;
            inertia += i.y + 2.0 * (r.x * h.x + r.z * h.z) + m * (r.x * r.x + r.z * r.z);
        }
        let expected = t.mass * GRAVITY * offset / inertia;
        assert!((w.y / expected - 1.0).abs() < 1e-9, "{} {expected}", w.y);
        assert!(w.x.abs() < 1e-12 && w.z.abs() < 1e-12);
        // At a vertex both horizontal axes are free.
        let w = tipping_acceleration(&t, &Pivot::vertex(vec3(edge.x, t.com.y, 0.0)), f, n);
        assert!(w.y > 0.0 && w.x.abs() < 0.2 * w.y);
    }
}
