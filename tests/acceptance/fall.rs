//! Goal: a figure that holds its posture with its motors and tips over an edge of its feet falls like the rigid body it looks like.
//! Method: it starts 3° beyond balance over the edge; the time until its centre of mass is 0.5 m high is compared with the physical
//! pendulum `I θ̈ = m g l sin θ` about that edge, integrated to rounding.

use crate::common::{Scene, authored, figure, man, still};
use crate::{GRAVITY, integrals, vec3};
use sinew::evaluate::pose::segment_poses;
use sinew::sim::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew::sim::body::{Body, Links, Posture, State};
use sinew::sim::figure::ControllerKind;
use sinew::sim::math::{Quat, Sym3, Vec3};

/// Height of the centre of mass that ends the comparison, m.
const LOW: f64 = 0.5;

/// A posture turned about an edge on the floor until its centre of mass is 3° beyond it.
fn leaning(body: &Body, posture: &Posture, direction: Vec3) -> (State, Vec3) {
    let poses = segment_poses(&body.joint_offset, posture);
    let edge = [L_FOOT, L_TOES, R_FOOT, R_TOES]
        .iter()
        .flat_map(|s| {
            body.segment(*s)
                .contact_points
                .iter()
                .map(|p| poses[s.index()].point(*p))
        })
        .map(|p| p.dot(direction))
        .fold(f64::MIN, f64::max);
    let com = integrals(&Links::new(body), &still(*posture)).com;
    let pivot = direction * edge;
    let angle = (edge - com.dot(direction)).atan2(com.z) + 3f64.to_radians();
    let turn = Quat::from_axis_angle(Vec3::Z.cross(direction), angle);
    let mut out = *posture;
    out.root_position = pivot + turn.rotate(posture.root_position - pivot);
    out.root_rotation = turn * posture.root_rotation;
    (still(out), pivot)
}

/// Seconds until the rigid figure's centre of mass is at [`LOW`].
fn pendulum_time(body: &Body, state: &State, pivot: Vec3, axis: Vec3) -> f64 {
    let links = Links::new(body);
    let poses = segment_poses(&links.offset, &state.posture);
    let mut inertia = 0.0;
    for (segment, pose) in body.segments.iter().zip(&poses) {
        let about_com: Sym3 = segment.inertia.rotated(pose.rotation.to_mat3());
        let r = pose.point(segment.com) - pivot;
        inertia += axis.dot(about_com * axis) + segment.mass * axis.cross(r).dot(axis.cross(r));
    }
    let r = integrals(&links, state).com - pivot;
    let across = r - axis * r.dot(axis);
    let length = across.norm();
    let stiffness = links.total_mass() * GRAVITY * length / inertia;
    let (mut angle, mut rate, mut time) = ((across.z / length).acos(), 0.0f64, 0.0);
    let h = 1e-4;
    while length * angle.cos() > LOW {
        // Midpoint rule: error far below a tick.
        let (a, w) = (
            angle + 0.5 * h * rate,
            rate + 0.5 * h * stiffness * angle.sin(),
        );
        angle += h * w;
        rate += h * stiffness * a.sin();
        time += h;
    }
    time
}

/// `late`: how many ticks the fall may differ from the pendulum.
fn falls_like_a_pendulum(strength: f64, late: f64) {
    let body = man();
    let posture = authored(&body, "idle").posture(0).to_owned();
    for (name, direction) in [
        ("forward", vec3(1.0, 0.0, 0.0)),
        ("backward", vec3(-1.0, 0.0, 0.0)),
        ("left", vec3(0.0, 1.0, 0.0)),
        ("right", vec3(0.0, -1.0, 0.0)),
    ] {
        let (state, pivot) = leaning(&body, &posture, direction);
        let want = pendulum_time(&body, &state, pivot, Vec3::Z.cross(direction));
        let mut setup = figure(&body, ControllerKind::Motors, state);
        setup.strength.all = strength;
        let mut scene = Scene::of(setup);
        let start = integrals(scene.figure().links(), &state);
        let (mut fell, mut bent, mut energy) = (None, 0.0f64, f64::MIN);
        let (mut moved, mut slipped) = (Vec3::zero(), 0.0);
        scene.run(3.0, |s| {
            let now = integrals(s.figure().links(), s.figure().state());
            energy = energy.max(now.energy);
            if fell.is_none() {
                let r = s.figure().report().unwrap();
                bent = r.joint_error.iter().fold(bent, |m, e| m.max(e.abs()));
                slipped = r
                    .contacts
                    .iter()
                    .map(|c| c.position.dot(direction))
                    .fold(f64::MIN, f64::max)
                    - pivot.dot(direction);
                moved = now.com - start.com;
                if now.com.z < LOW {
                    fell = Some(s.world.time());
                }
            }
        });
        let fell = fell.expect("it falls");
        let gain = (energy - start.energy) / start.energy;
        let text = format!(
            "×{strength} {name}: {fell:.4} s, pendulum {want:.4} s, bent {:.2}°, energy {gain:+.2e}, moved {:.2} {:.2} m, edge {slipped:+.3} m",
            bent.to_degrees(),
            moved.x,
            moved.y
        );
        println!("{text}");
        let dt = scene.world.dt();
        // The tick in which it passes is seen at its end.
        assert!(
            fell - want > -late * dt && fell - want < (late + 1.0) * dt,
            "{text}"
        );
        let along = moved.dot(direction);
        let across = (moved - direction * along - Vec3::Z * moved.z).norm();
        assert!(
            along > 0.0 && across < 5f64.to_radians().tan() * along,
            "{text}: direction"
        );
        assert!(gain <= 0.0, "{text}: energy above the start");
    }
}

#[test]
fn at_human_strength() {
    falls_like_a_pendulum(1.0, 1.0);
}

#[test]
fn at_twenty_times_human_strength() {
    falls_like_a_pendulum(20.0, 1.0);
}
