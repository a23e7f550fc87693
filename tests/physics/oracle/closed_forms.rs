//! Motions that can be computed by hand: statics, free fall, pendulums, spinning bodies, flight, mirror images.

use super::bodies::{components, generator, loaded, random_body, random_loads, random_state};
use super::{GRAVITY, inverse, relative, terms};
use sinew_physics::body::topology::{
    DOF_LEN, DOF_SEGMENT, DOF_START, IS_ANCESTOR, JOINT, Joint, L_SHANK, L_THIGH, SEGMENT_NAMES,
};
use sinew_physics::body::{Body, DOF_COUNT, Links, NV, Posture, SEGMENT_COUNT, SegmentId, State};
use sinew_physics::dynamics::{
    AbaWorkspace, ExternalForces, Kinematics, aba, kinetic_energy, momentum,
};
use sinew_physics::math::{Quat, Sym3, Vec3};

const ROUNDING: f64 = 1e-12;

fn forward(links: &Links, state: &State, tau: &[f64; NV]) -> [f64; NV] {
    let mut kin = Kinematics::default();
    kin.set_state(links, state);
    let mut vdot = [0.0; NV];
    let mut work = AbaWorkspace::default();
    aba(
        links,
        &kin,
        &state.velocity,
        tau,
        ExternalForces::gravity(GRAVITY),
        &mut work,
        &mut vdot,
    );
    vdot
}

/// One step of the explicit midpoint rule; second order.
fn midpoint(links: &Links, state: &State, dt: f64, tau: &dyn Fn(&State) -> [f64; NV]) -> State {
    let a = forward(links, state, &tau(state));
    let mut half = *state;
    half.posture.integrate(&state.velocity, 0.5 * dt);
    half.velocity = std::array::from_fn(|i| state.velocity[i] + 0.5 * dt * a[i]);
    let a = forward(links, &half, &tau(&half));
    let mut out = *state;
    out.posture.integrate(&half.velocity, dt);
    out.velocity = std::array::from_fn(|i| state.velocity[i] + dt * a[i]);
    out
}

fn up(z: f64) -> Vec3 {
    Vec3 { x: 0.0, y: 0.0, z }
}

#[test]
fn holding_still_takes_the_moment_of_the_weight_beyond_each_joint() {
    for seed in 0..20 {
        let mut rng = generator(3000 + seed);
        let links = loaded(&random_body(&mut rng, 0.05), &random_loads(&mut rng));
        let mut state = random_state(&mut rng, 2.5);
        state.velocity = [0.0; NV];
        let t = terms(&links, &state);
        let tau = inverse(&links, &state, &[0.0; NV], GRAVITY);
        let mut expected = [0.0; NV];
        let mut whole = Vec3::zero();
        for s in 0..SEGMENT_COUNT {
            let com = t.point_world(s, links.moment[s] * (1.0 / links.mass[s]));
            let hold = up(links.mass[s] * GRAVITY);
            whole += (com - state.posture.root_position).cross(hold);
            for d in 0..DOF_COUNT {
                if IS_ANCESTOR[s][DOF_SEGMENT[d]] {
                    let arm = com - t.segment_position(DOF_SEGMENT[d]);
                    expected[6 + d] += t.kin.axis[d].dot(arm.cross(hold));
                }
            }
        }
        expected[..3].copy_from_slice(&whole.to_array());
        expected[5] = links.total_mass() * GRAVITY;
        assert!(relative(&tau, &expected) < ROUNDING);
    }
}

#[test]
fn a_released_body_at_rest_falls_as_one() {
    for seed in 0..20 {
        let mut rng = generator(3100 + seed);
        let links = loaded(&random_body(&mut rng, 0.05), &random_loads(&mut rng));
        let mut state = random_state(&mut rng, 2.5);
        state.velocity = [0.0; NV];
        let vdot = forward(&links, &state, &[0.0; NV]);
        let mut expected = [0.0; NV];
        expected[5] = -GRAVITY;
        for i in 0..NV {
            assert!((vdot[i] - expected[i]).abs() < 1e-9, "{i}: {}", vdot[i]);
        }
    }
}

#[test]
fn a_rigid_spin_has_the_energy_and_momentum_of_one_rigid_body() {
    for seed in 0..20 {
        let mut rng = generator(3200 + seed);
        let links = loaded(&random_body(&mut rng, 0.0), &random_loads(&mut rng));
        let mut state = random_state(&mut rng, 2.5);
        state.velocity[6..].fill(0.0);
        let t = terms(&links, &state);
        let w = Vec3::from_array([state.velocity[0], state.velocity[1], state.velocity[2]]);
        // Inertia about the common centre of mass: each segment's own, turned, and shifted.
        let mut inertia = Sym3::zero();
        for s in 0..SEGMENT_COUNT {
            let c = links.moment[s] * (1.0 / links.mass[s]);
            let own = links.inertia[s] - Sym3::point_mass(links.mass[s], c);
            inertia += own.rotated(t.segment_rotation(s))
                + Sym3::point_mass(links.mass[s], t.point_world(s, c) - t.com);
        }
        let energy = 0.5 * (t.mass * t.com_velocity.dot(t.com_velocity) + w.dot(inertia * w));
        assert!(relative(&[kinetic_energy(&links, &t.kin)], &[energy]) < ROUNDING);
        let l = momentum(&links, &t.kin).angular;
        assert!(relative(&l.to_array(), &(inertia * w).to_array()) < ROUNDING);
        assert!(
            (t.com_velocity
                - Vec3::from_array([state.velocity[3], state.velocity[4], state.velocity[5]])
                - w.cross(t.com - state.posture.root_position))
            .norm()
                < 1e-11
        );
    }
}

/// Arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// The lower leg swings about the knee, all else held: a physical pendulum, whose period for any amplitude is
/// `2π √(I / m g l) / agm(1, cos(amplitude/2))`.
#[test]
fn a_swinging_shank_keeps_the_time_of_a_physical_pendulum() {
    let body = Body::adult_man();
    let links = Links::new(&body);
    let knee = DOF_START[L_SHANK.index()];
    // By hand: mass, centre and inertia of the chain below the knee, with ankle and toes straight.
    let (mut mass, mut moment, mut inertia) = (0.0, Vec3::zero(), body.armature[knee]);
    let mut origin = Vec3::zero();
    for s in L_SHANK.index()..L_SHANK.index() + 3 {
        if s > L_SHANK.index() {
            origin += body.joint_offset[s];
        }
        let (x, c) = (&body.segments[s], body.segments[s].com + origin);
        mass += x.mass;
        moment += c * x.mass;
        inertia += x.inertia.yy + x.mass * (c.x * c.x + c.z * c.z);
    }
    let com = moment * (1.0 / mass);
    let arm = com.x.hypot(com.z); // distance from the axis
    let amplitude = 1.2f64;
    // Positive knee angles turn about +y: the pendulum hangs straight where its centre is under the knee.
    let rest = com.x.atan2(-com.z);
    let period = 2.0 * std::f64::consts::PI * (inertia / (mass * GRAVITY * arm)).sqrt()
        / agm(1.0, (amplitude / 2.0).cos());

    let acceleration = |angle: f64, rate: f64| {
        let mut state = State::default();
        let Joint::Hinge1(h) = JOINT[L_SHANK.index()] else {
            panic!("the knee is a hinge")
        };
        state.posture.hinge[h] = angle;
        state.velocity[6 + knee] = rate;
        let t = terms(&links, &state);
        -t.h[6 + knee] / t.m[6 + knee][6 + knee]
    };
    let (mut x, mut v) = (rest + amplitude, 0.0);
    let (mut time, dt) = (0.0, 1e-4);
    let mut crossings = Vec::new();
    while crossings.len() < 3 {
        // Classical fourth-order step.
        let (v1, a1) = (v, acceleration(x, v));
        let (v2, a2) = (
            v + 0.5 * dt * a1,
            acceleration(x + 0.5 * dt * v1, v + 0.5 * dt * a1),
        );
        let (v3, a3) = (
            v + 0.5 * dt * a2,
            acceleration(x + 0.5 * dt * v2, v + 0.5 * dt * a2),
        );
        let (v4, a4) = (v + dt * a3, acceleration(x + dt * v3, v + dt * a3));
        let next = x + dt * (v1 + 2.0 * v2 + 2.0 * v3 + v4) / 6.0;
        v += dt * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0;
        if (x - rest) * (next - rest) < 0.0 {
            crossings.push(time + dt * (x - rest) / (x - next));
        }
        x = next;
        time += dt;
    }
    let measured = crossings[2] - crossings[0];
    assert!(
        (measured / period - 1.0).abs() < 1e-7,
        "{measured} s against {period} s"
    );
}

/// Thigh and shank swing about hip and knee, all else held: the textbook double pendulum, inertia and forces entry by
/// entry.
#[test]
fn hip_and_knee_make_the_textbook_double_pendulum() {
    let body = Body::adult_woman();
    let links = Links::new(&body);
    let (hip, knee) = (
        6 + DOF_START[L_THIGH.index()],
        6 + DOF_START[L_SHANK.index()],
    );
    let (Joint::Ball(ball), Joint::Hinge1(hinge)) =
        (JOINT[L_THIGH.index()], JOINT[L_SHANK.index()])
    else {
        panic!("hip and knee")
    };
    let thigh = &body.segments[L_THIGH.index()];
    let (m1, c1) = (thigh.mass, thigh.com);
    let i1 = thigh.inertia.yy + m1 * (c1.x * c1.x + c1.z * c1.z);
    let length = body.joint_offset[L_SHANK.index()];
    let (mut m2, mut s2, mut i2, mut at) = (0.0, Vec3::zero(), 0.0, Vec3::zero());
    for s in L_SHANK.index()..L_SHANK.index() + 3 {
        if s > L_SHANK.index() {
            at += body.joint_offset[s];
        }
        let (x, c) = (&body.segments[s], body.segments[s].com + at);
        m2 += x.mass;
        s2 += c * x.mass;
        i2 += x.inertia.yy + x.mass * (c.x * c.x + c.z * c.z);
    }
    for k in 0..50 {
        let f = f64::from(k);
        let (a, b) = (1.3 * (0.7 * f).sin(), 1.1 * (1.3 * f).cos());
        let (ra, rb) = (5.0 * (2.1 * f).sin(), 4.0 * (0.3 * f).cos());
        let mut state = State::default();
        // Hip flexion is about −y, knee flexion about +y.
        state.posture.ball[ball] = Quat::from_axis_angle(Vec3::Y, -a);
        state.posture.hinge[hinge] = b;
        (state.velocity[hip], state.velocity[knee]) = (ra, rb);
        let t = terms(&links, &state);

        // In the plane, with angles p, q about +y of thigh and shank, against the world.
        let (p, q) = (-a, -a + b);
        let turn = |v: Vec3, angle: f64| {
            (
                v.x * angle.cos() + v.z * angle.sin(),
                v.z * angle.cos() - v.x * angle.sin(),
            )
        };
        let (l, s) = (turn(length, p), turn(s2, q));
        let dot = l.0 * s.0 + l.1 * s.1; // L·S, the coupling
        let ll = length.x * length.x + length.z * length.z;
        // Lagrangian in (p, q): M = [[i1 + m2 ll, dot], [dot, i2]].
        let (mpp, mpq, mqq) = (i1 + m2 * ll, dot, i2);
        // Rates (p', q') = (−1, −1; 0, 1)ᵀ (a', b'): M in (a, b).
        let maa = mpp + 2.0 * mpq + mqq;
        let mab = -(mpq + mqq);
        let (wp, wq) = (-ra, -ra + rb);
        // d(turn)/dangle = (z, −x), so ∂(L·S)/∂q = −∂(L·S)/∂p = Lx Sz − Lz Sx.
        let coupling = l.0 * s.1 - l.1 * s.0;
        let hp = coupling * wq * wq + GRAVITY * (-(m1 * turn(c1, p).0) - m2 * l.0);
        let hq = -coupling * wp * wp - GRAVITY * s.0;
        let (ha, hb) = (-(hp + hq), hq);
        let ours = [
            t.m[hip][hip],
            t.m[hip][knee],
            t.m[knee][knee],
            t.h[hip],
            t.h[knee],
        ];
        let textbook = [
            maa + body.armature[hip - 6],
            mab,
            mqq + body.armature[knee - 6],
            ha,
            hb,
        ];
        for i in 0..5 {
            let off = (ours[i] - textbook[i]).abs();
            assert!(
                off < 1e-11,
                "entry {i}: {} against {}",
                ours[i],
                textbook[i]
            );
        }
    }
}

/// A figure in flight that pulls in its arms and kicks: whatever its torques do, the centre of mass follows a parabola
/// and the angular momentum about it is conserved.
#[test]
fn flight_keeps_the_parabola_and_the_angular_momentum() {
    let mut rng = generator(77);
    let body = Body::adult_man();
    let links = loaded(&body, &random_loads(&mut rng));
    let mut start = State::default();
    start.posture.root_position = up(3.0);
    start.velocity = components(&mut rng, 1.0);
    start.velocity[2] = 6.0; // a spin about the vertical
    let tau = |s: &State| {
        let mut t = [0.0; NV];
        for d in 0..DOF_COUNT {
            t[6 + d] =
                8.0 * (d as f64).cos() * body.armature[d].max(0.02) - 0.05 * s.velocity[6 + d];
        }
        t
    };
    let duration = 0.3;
    let run = |steps: usize| {
        let dt = duration / steps as f64;
        let mut s = start;
        for _ in 0..steps {
            s = midpoint(&links, &s, dt, &tau);
        }
        let t = terms(&links, &s);
        (t.com, momentum(&links, &t.kin), s)
    };
    let t0 = terms(&links, &start);
    let p0 = momentum(&links, &t0.kin);
    let landing = t0.com + t0.com_velocity * duration + up(-0.5 * GRAVITY * duration * duration);
    let error = |steps: usize| {
        let (com, p, _) = run(steps);
        (
            (com - landing).norm(),
            (p.angular - p0.angular).norm() / p0.angular.norm(),
        )
    };
    let (coarse, fine) = (error(600), error(1200));
    // Second order: half the step, a quarter of the error (between 3 and 5 allows for higher terms).
    for (c, f) in [(coarse.0, fine.0), (coarse.1, fine.1)] {
        assert!((3.0..5.0).contains(&(c / f)), "{c:e} became {f:e}");
    }
    assert!(fine.0 < 1e-6 && fine.1 < 1e-6, "{fine:?}");
    let (_, p, s) = run(1200);
    let v = p.linear - (p0.linear + up(-links.total_mass() * GRAVITY * duration));
    assert!(v.norm() < 1e-6 * p0.linear.norm());
    let quaternions = s.posture.ball.iter().chain([&s.posture.root_rotation]);
    for q in quaternions {
        let n = q.to_xyzw().iter().map(|c| c * c).sum::<f64>();
        assert!((n - 1.0).abs() < 1e-14);
    }
}

#[test]
fn energy_is_kept_in_flight_without_torques() {
    let mut rng = generator(78);
    let mut body = random_body(&mut rng, 0.0);
    body.armature = [0.05; DOF_COUNT];
    let links = Links::new(&body);
    let mut start = random_state(&mut rng, 1.0);
    start.velocity = components(&mut rng, 2.0);
    let energy = |s: &State| {
        let t = terms(&links, s);
        let reflected: f64 = (6..NV).map(|i| 0.025 * s.velocity[i].powi(2)).sum();
        kinetic_energy(&links, &t.kin) + reflected + t.mass * GRAVITY * t.com.z
    };
    let run = |steps: usize| {
        let mut s = start;
        for _ in 0..steps {
            s = midpoint(&links, &s, 0.2 / steps as f64, &|_| [0.0; NV]);
        }
        (energy(&s) - energy(&start)).abs() / kinetic_energy(&links, &terms(&links, &start).kin)
    };
    let (coarse, fine) = (run(2000), run(4000));
    assert!(fine < 1e-6, "{fine:e}");
    assert!(fine < coarse, "{coarse:e} became {fine:e}");
}

#[test]
fn quaternions_stay_of_unit_length_over_long_runs() {
    let mut rng = generator(79);
    let mut p = Posture::default();
    let v = components(&mut rng, 20.0);
    for _ in 0..100_000 {
        p.integrate(&v, 1.0 / 120.0);
    }
    for q in p.ball.iter().chain([&p.root_rotation]) {
        let n = q.to_xyzw().iter().map(|c| c * c).sum::<f64>().sqrt();
        assert!((n - 1.0).abs() < 1e-14);
    }
}

/// The segment on the other side.
fn other_side(s: usize) -> usize {
    let name = SEGMENT_NAMES[s];
    let other = match name.as_bytes() {
        [b'l', b'_', ..] => format!("r{}", &name[1..]),
        [b'r', b'_', ..] => format!("l{}", &name[1..]),
        _ => name.to_owned(),
    };
    SegmentId::from_name(&other).unwrap().index()
}

/// Rates, accelerations or torques of the mirror image (left ↔ right).
fn mirrored(v: &[f64; NV]) -> [f64; NV] {
    let mut out = [0.0; NV];
    for (k, sign) in [-1.0, 1.0, -1.0, 1.0, -1.0, 1.0].into_iter().enumerate() {
        out[k] = sign * v[k];
    }
    for s in 1..SEGMENT_COUNT {
        let o = other_side(s);
        for k in 0..DOF_LEN[s] {
            // Anatomical signs are the same on both sides; in the midline, lateral bend and rotation change theirs.
            let sign = if o == s && k > 0 { -1.0 } else { 1.0 };
            out[6 + DOF_START[o] + k] = sign * v[6 + DOF_START[s] + k];
        }
    }
    out
}

fn mirrored_posture(p: &Posture) -> Posture {
    let flip = |q: Quat| Quat::from_xyzw([-q.x, q.y, -q.z, q.w]);
    let mut out = Posture {
        root_position: Vec3 {
            y: -p.root_position.y,
            ..p.root_position
        },
        root_rotation: flip(p.root_rotation),
        ..Posture::default()
    };
    for s in 1..SEGMENT_COUNT {
        match (JOINT[s], JOINT[other_side(s)]) {
            (Joint::Ball(a), Joint::Ball(b)) => out.ball[b] = flip(p.ball[a]),
            (Joint::Hinge1(a), Joint::Hinge1(b)) => out.hinge[b] = p.hinge[a],
            (Joint::Hinge2(a), Joint::Hinge2(b)) => {
                out.hinge[b] = p.hinge[a];
                out.hinge[b + 1] = p.hinge[a + 1];
            }
            _ => panic!(
                "{} has another kind of joint than its mirror image",
                SEGMENT_NAMES[s]
            ),
        }
    }
    out
}

#[test]
fn mirror_images_take_mirrored_torques() {
    let links = Links::new(&Body::adult_man());
    for seed in 0..30 {
        let mut rng = generator(3300 + seed);
        let state = random_state(&mut rng, 1.5);
        let a = components(&mut rng, 30.0);
        let image = State {
            posture: mirrored_posture(&state.posture),
            velocity: mirrored(&state.velocity),
        };
        let expected = mirrored(&inverse(&links, &state, &a, GRAVITY));
        let got = inverse(&links, &image, &mirrored(&a), GRAVITY);
        assert!(relative(&got, &expected) < ROUNDING);
    }
}
