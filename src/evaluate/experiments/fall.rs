//! Falls over an edge of the feet, against the physical pendulum.

use super::{ControlPair, ExperimentRecord, record};
use crate::pose::segment_poses;
use sinew_physics::body::topology::{DOF_NAMES, L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::body::{Body, Links, Posture, State};
use sinew_physics::dynamics::{Kinematics, center_of_mass, kinetic_energy, rotor_energy};
use sinew_physics::figure::StrengthScale;
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::GRAVITY;
use sinew_physics::motion::builtin::at_ease;
use sinew_physics::world::World;
use std::sync::Arc;

/// Height of the centre of mass that ends the comparison, m.
pub const LOW: f64 = 0.5;
/// Shortest edge over which a figure can tip as a whole, m; shorter ones round a corner.
const MIN_EDGE: f64 = 0.05;
/// Angle beyond balance at which a fall begins, degrees.
const BEYOND: f64 = 3.0;

/// The four directions.
pub const DIRECTIONS: [(&str, Vec3); 4] = [
    (
        "forward",
        Vec3 {
            x: 1.0,
            y: 0.0,
            z: 0.0,
        },
    ),
    (
        "backward",
        Vec3 {
            x: -1.0,
            y: 0.0,
            z: 0.0,
        },
    ),
    (
        "left",
        Vec3 {
            x: 0.0,
            y: 1.0,
            z: 0.0,
        },
    ),
    (
        "right",
        Vec3 {
            x: 0.0,
            y: -1.0,
            z: 0.0,
        },
    ),
];

/// A figure about to fall.
#[derive(Clone, Debug)]
pub struct Leaning {
    /// Its initial state, at rest.
    pub state: State,
    /// A point of the edge.
    pub pivot: Vec3,
    /// Horizontal, away from the feet, perpendicular to the edge.
    pub normal: Vec3,
}

/// Edge of the soles that faces `direction` most: a point on it and its outward normal. The soles are on the floor.
fn edge_towards(body: &Body, posture: &Posture, direction: Vec3) -> (Vec3, Vec3) {
    let poses = segment_poses(&body.joint_offset, posture);
    let mut soles = Vec::new();
    for s in [L_FOOT, L_TOES, R_FOOT, R_TOES] {
        for p in &body.segment(s).contact_points {
            let p = poses[s.index()].point(*p);
            soles.push(Vec3 { z: 0.0, ..p });
        }
    }
    let mut best = (f64::MIN, Vec3::zero(), Vec3::zero());
    for a in &soles {
        for b in &soles {
            let along = *b - *a;
            if along.norm() < MIN_EDGE {
                continue;
            }
            let normal = along.cross(Vec3::Z) * (1.0 / along.norm());
            let outside = soles.iter().any(|p| (*p - *a).dot(normal) > 1e-6);
            if !outside && normal.dot(direction) > best.0 {
                best = (normal.dot(direction), *a, normal);
            }
        }
    }
    (best.1, best.2)
}

/// `posture`, rotated rigidly about the edge of its soles that faces `direction` until the centre of mass is 3° beyond
/// it.
pub fn leaning(body: &Body, mut posture: Posture, direction: Vec3) -> Leaning {
    let (pivot, normal) = edge_towards(body, &posture, direction);
    let com = com_and_energy(&Links::new(body), &State::at_rest(posture)).0;
    let angle = (pivot - com).dot(normal).atan2(com.z) + BEYOND.to_radians();
    let turn = Quat::from_axis_angle(Vec3::Z.cross(normal), angle);
    posture.root_position = pivot + turn.rotate(posture.root_position - pivot);
    posture.root_rotation = turn * posture.root_rotation;
    Leaning {
        state: State::at_rest(posture),
        pivot,
        normal,
    }
}

/// Centre of mass (m) and energy (J, rotors included).
fn com_and_energy(links: &Links, state: &State) -> (Vec3, f64) {
    let mut kin = Kinematics::default();
    kin.set_state(links, state);
    let (com, mass) = center_of_mass(links, &kin);
    let com = state.posture.root_position + com;
    let rotors = rotor_energy(links, &state.velocity);
    (
        com,
        kinetic_energy(links, &kin) + rotors + mass * GRAVITY * com.z,
    )
}

/// The figure as one rigid body turning about the edge: time (s) and height of the centre of mass (m) every
/// millisecond, down to [`LOW`]. Midpoint rule, 0.1 ms.
pub fn pendulum(body: &Body, start: &Leaning) -> Vec<[f64; 2]> {
    let links = Links::new(body);
    let axis = Vec3::Z.cross(start.normal);
    let poses = segment_poses(&links.offset, &start.state.posture);
    let mut inertia = 0.0;
    for (segment, pose) in body.segments.iter().zip(&poses) {
        let own = segment.inertia.rotated(pose.rotation.to_mat3());
        let r = pose.point(segment.com) - start.pivot;
        inertia += axis.dot(own * axis) + segment.mass * axis.cross(r).dot(axis.cross(r));
    }
    let r = com_and_energy(&links, &start.state).0 - start.pivot;
    let across = r - axis * r.dot(axis);
    let length = across.norm();
    let stiffness = links.total_mass() * GRAVITY * length / inertia;
    let (mut angle, mut rate) = ((across.z / length).acos(), 0.0f64);
    let h = 1e-4;
    let mut out = Vec::new();
    for n in 0u32.. {
        let z = length * angle.cos();
        if n % 10 == 0 || z <= LOW {
            out.push([f64::from(n) * h, z]);
        }
        if z <= LOW {
            break;
        }
        let (a, w) = (
            angle + 0.5 * h * rate,
            rate + 0.5 * h * stiffness * angle.sin(),
        );
        angle += h * w;
        rate += h * stiffness * a.sin();
    }
    out
}

/// One fall.
#[derive(Clone, Debug)]
pub struct Fall {
    /// Time until the centre of mass is [`LOW`], s.
    pub time_s: Option<f64>,
    /// The same for the pendulum, s.
    pub pendulum_s: f64,
    /// Least and largest energy before that, relative to the start.
    pub energy: [f64; 2],
    /// Angle between the path of the centre of mass and the normal of the edge, degrees.
    pub off_course_deg: f64,
    /// Largest joint error before that, degrees.
    pub bent_deg: f64,
    /// The run.
    pub record: ExperimentRecord,
}

/// Time that the figure takes as a pendulum about the balls of its feet instead of the edge over which it leans, s: the
/// support that remains when the toes give way.
pub fn pendulum_about_the_balls(body: &Body, start: &Leaning) -> f64 {
    let poses = segment_poses(&body.joint_offset, &start.state.posture);
    let ball = (poses[L_TOES.index()].position + poses[R_TOES.index()].position) * 0.5;
    let start = Leaning {
        pivot: ball,
        ..start.clone()
    };
    pendulum(body, &start).last().map_or(0.0, |p| p[0])
}

/// Lets a figure fall with `strength` times its own.
pub fn fall(
    body: &Arc<Body>,
    pair: &ControlPair,
    direction: Vec3,
    strength: f64,
    panels: usize,
) -> Fall {
    fall_on_toes(body, pair, direction, [strength, 1.0], panels)
}

/// The same with a further factor on the strength of the toes.
pub fn fall_on_toes(
    body: &Arc<Body>,
    pair: &ControlPair,
    direction: Vec3,
    [strength, toes]: [f64; 2],
    panels: usize,
) -> Fall {
    let start = leaning(body, at_ease(body), direction);
    let mut scale = StrengthScale {
        all: strength,
        ..StrengthScale::default()
    };
    for (factor, name) in scale.dof.iter_mut().zip(DOF_NAMES) {
        if name.ends_with("toe_extension") {
            *factor = toes;
        }
    }
    let pendulum_s = pendulum(body, &start).last().map_or(0.0, |p| p[0]);
    // Energies come from the state, which the recording does not keep: a second world is cheaper than all states.
    let (mut world, key) = pair.world(body, start.state, scale.clone());
    let (com, first) = com_and_energy(&Links::new(body), &start.state);
    let mut out = Fall {
        time_s: None,
        pendulum_s,
        energy: [0.0; 2],
        off_course_deg: 0.0,
        bent_deg: 0.0,
        record: ExperimentRecord::default(),
    };
    while out.time_s.is_none() && world.time().0 < 3.0 {
        let (moved, energy, bent) = tick(&mut world, key, com);
        let gain = (energy - first) / first;
        out.energy = [out.energy[0].min(gain), out.energy[1].max(gain)];
        out.bent_deg = out.bent_deg.max(bent.to_degrees());
        let along = moved.dot(start.normal);
        let across = (moved - start.normal * along - Vec3::Z * moved.z).norm();
        out.off_course_deg = across.atan2(along).to_degrees();
        if com.z + moved.z < LOW {
            out.time_s = Some(world.time().0);
        }
    }
    let (mut world, key) = pair.world(body, start.state, scale);
    out.record = record(&mut world, key, 1.8, panels, |_, _| Default::default());
    out
}

/// One tick: displacement of the centre of mass from `start`, energy, and largest joint error (rad).
fn tick(world: &mut World, key: sinew_physics::world::FigureKey, start: Vec3) -> (Vec3, f64, f64) {
    world.step();
    let figure = world.figure(key).expect("nobody removes the figure");
    let (com, energy) = com_and_energy(figure.links(), figure.state());
    let report = figure.report().expect("a stepped figure has a report");
    let bent = report
        .joints
        .joint_error
        .iter()
        .fold(0.0f64, |m, e| m.max(e.abs()));
    (com - start, energy, bent)
}
