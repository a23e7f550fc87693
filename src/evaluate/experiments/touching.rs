//! Hands on tables and walls (figure 3 of the paper), and two figures that run into each other.

use super::{Pair, Record, push_at_chest, record};
use crate::evaluate::pose::segment_poses;
use crate::evaluate::strip::Thing;
use crate::sim::body::angles::{anatomical_angles, set_anatomical_angles};
use crate::sim::body::topology::{DOF_NAMES, L_FOOT, R_HAND};
use crate::sim::body::{Body, Posture, State};
use crate::sim::collide::{Mobility, ObstacleSetup, Other, Shape};
use crate::sim::figure::StrengthScale;
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::builtin::at_ease;
use std::sync::Arc;

/// What the hand leans on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prop {
    /// Nothing.
    None,
    /// A table in front, the arm slanting down to it.
    Table,
    /// The same with a top that slopes down towards the figure.
    Desk,
    /// A wall in front, the arm stretched to it.
    Wall,
}

/// Friction of table and wall.
pub const FRICTION: f64 = 0.6;
/// Slope of the desk, rad.
const SLOPE: f64 = 0.35;
/// How far the body leans forward from the ankles, rad, and for how long it is watched, s.
const LEAN: f64 = 0.16;
const DURATION: f64 = 4.0;
/// Right arm: shoulder and elbow flexion, rad.
const TO_TABLE: (f64, f64) = (0.75, 0.35);
const TO_WALL: (f64, f64) = (1.55, 0.15);

/// A figure that leans on its right hand.
#[derive(Clone, Debug)]
pub struct Support {
    /// The run.
    pub record: Record,
    /// Mean force of table or wall on the hand over the last second, world axes, N.
    pub force: Vec3,
    /// Mean vertical force of the floor over the last second, N.
    pub floor: f64,
    /// Weight, N.
    pub weight: f64,
    /// Largest share of the friction cone that any tick used.
    pub cone: f64,
    /// Ticks of the last second in which the hand touched, share.
    pub touching: f64,
    /// Mean vertical force of table or wall on the whole body over the last second, N.
    pub rest: f64,
    /// Mean force into the face over the last second, N.
    pub pressed: f64,
}

fn dof(name: &str) -> usize {
    DOF_NAMES
        .iter()
        .position(|n| *n == name)
        .expect("the DOF exists")
}

/// Standing at ease, leaning from the ankles, the right arm put forward; feet flat where they were.
fn leaning(body: &Body, (shoulder, elbow): (f64, f64)) -> Posture {
    let ease = at_ease(body);
    let mut angles = anatomical_angles(&ease);
    for side in ["l", "r"] {
        angles[dof(&format!("{side}_ankle_flexion"))] += LEAN;
    }
    angles[dof("r_shoulder_flexion")] = shoulder;
    angles[dof("r_elbow_flexion")] = elbow;
    let mut out = ease;
    set_anatomical_angles(&mut out, &angles);
    out.root_rotation = Quat::from_axis_angle(Vec3::Y, LEAN) * out.root_rotation;
    let foot = |p: &Posture| segment_poses(&body.joint_offset, p)[L_FOOT.index()].position;
    out.root_position += foot(&ease) - foot(&out);
    out
}

/// Normal of the face that the hand leans on.
fn face(what: Prop) -> Vec3 {
    match what {
        Prop::Desk => Quat::from_axis_angle(Vec3::Y, -SLOPE).rotate(Vec3::Z),
        Prop::Wall => Vec3::X * -1.0,
        _ => Vec3::Z,
    }
}

/// A box whose face touches the hand.
fn prop(body: &Body, posture: &Posture, what: Prop) -> Option<ObstacleSetup> {
    let (half, slope) = match what {
        Prop::None => return None,
        Prop::Table => ([0.3, 0.5, 0.02], 0.0),
        Prop::Desk => ([0.3, 0.5, 0.02], -SLOPE),
        Prop::Wall => ([0.05, 0.6, 1.0], 0.0),
    };
    let [x, y, z] = half;
    let half = Vec3 { x, y, z };
    let n = face(what);
    let hand = segment_poses(&body.joint_offset, posture)[R_HAND.index()];
    let mesh = &body.segment(R_HAND).mesh;
    let places = mesh.vertices.iter().map(|p| hand.point(*p));
    let first = places.reduce(|a, b| if b.dot(n) < a.dot(n) { b } else { a })?;
    let thick = if what == Prop::Wall { half.x } else { half.z };
    let mut position = first - n * thick;
    if what == Prop::Wall {
        position.z = half.z;
    } else {
        // The hand lies near the edge, so that the body has room.
        position += Quat::from_axis_angle(Vec3::Y, slope).rotate(Vec3::X) * (half.x - 0.12);
    }
    Some(ObstacleSetup {
        name: "prop".into(),
        shape: Shape::Box { half },
        mobility: Mobility::Fixed,
        friction: FRICTION,
        position,
        rotation: Quat::from_axis_angle(Vec3::Y, slope),
        velocity: Vec3::zero(),
        angular_velocity: Vec3::zero(),
    })
}

/// Leans on a table or a wall with the right hand, with `arm` times the strength in that arm. The feet stay where they
/// are: no protective step.
pub fn hand_support(body: &Arc<Body>, pair: &Pair, what: Prop, arm: f64, panels: usize) -> Support {
    let arms = if what == Prop::Wall {
        TO_WALL
    } else {
        TO_TABLE
    };
    let posture = leaning(body, arms);
    let mut strength = StrengthScale::default();
    for (factor, name) in strength.dof.iter_mut().zip(DOF_NAMES) {
        if ["r_shoulder", "r_elbow", "r_wrist"]
            .iter()
            .any(|p| name.starts_with(p))
        {
            *factor = arm;
        }
    }
    let state = State::at_rest(posture);
    let mut pair = pair.clone();
    pair.params.protective_steps = false;
    let (mut world, key) = pair.world(body, state, strength);
    if let Some(o) = prop(body, &posture, what) {
        world.add_obstacle(o).expect("props are valid");
    }
    let normal = face(what);
    let last = DURATION - 1.0;
    let (mut force, mut floor, mut ticks, mut touching) = (Vec3::zero(), 0.0, 0.0, 0.0);
    let (mut cone, mut weight, mut rest) = (0.0f64, 0.0, 0.0);
    let record = record(&mut world, key, DURATION, panels, |w, time| {
        let f = w.figure(key).expect("nobody removes the figure");
        let r = f.report().expect("a stepped figure has a report");
        weight = f.links().total_mass() * w.params().gravity;
        let (mut on, mut pressed) = (Vec3::zero(), 0.0);
        for t in r
            .touches
            .iter()
            .filter(|t| matches!(t.other, Other::Obstacle(_)))
        {
            let push = t.force.dot(t.normal);
            if push > 5.0 {
                let slip = (t.force - t.normal * push).norm();
                cone = cone.max(slip / (FRICTION * push));
            }
            if t.segment == R_HAND {
                on += t.force;
                pressed += push.max(0.0);
            }
            if time > last {
                rest += t.force.z;
            }
        }
        if time > last {
            ticks += 1.0;
            force += on;
            floor += r.contacts.iter().map(|c| c.force.z).sum::<f64>();
            touching += f64::from(u8::from(pressed > 1.0));
        }
        let things = w.obstacles().map(|(_, o)| Thing::obstacle(o.setup()));
        (Vec::new(), things.collect())
    });
    Support {
        record,
        force: force * (1.0 / ticks),
        floor: floor / ticks,
        weight,
        cone,
        touching: touching / ticks,
        rest: rest / ticks,
        pressed: force.dot(normal) / ticks,
    }
}

/// Two figures of which one is pushed into the other.
#[derive(Clone, Debug)]
pub struct Bump {
    /// The run of the one that is pushed; the other is drawn with it.
    pub record: Record,
    /// Largest force between them in a tick, N, and when, s.
    pub most: (f64, f64),
    /// What they gave each other, N·s.
    pub impulse: f64,
    /// Largest difference of the forces on both, relative to the largest force.
    pub unequal: f64,
    /// Largest overlap, m.
    pub overlap: f64,
    /// Time for which they touched, s.
    pub touched_s: f64,
    /// When the other fell, s.
    pub other_fell_s: Option<f64>,
}

/// Distance of the two pelvises, m; when and for how long the first is pushed, s.
const APART: f64 = 0.75;
const PUSH: (f64, f64) = (0.4, 0.2);

/// Face to face; the left one is pushed in the back with `impulse` N·s.
pub fn bump(body: &Arc<Body>, pair: &Pair, impulse: f64, panels: usize) -> Bump {
    let at = |x: f64, yaw: f64| {
        let mut posture = at_ease(body);
        let turn = Quat::from_axis_angle(Vec3::Z, yaw);
        posture.root_position = turn.rotate(posture.root_position) + Vec3::X * x;
        posture.root_rotation = turn * posture.root_rotation;
        State::at_rest(posture)
    };
    let first = at(-0.5 * APART, 0.0);
    let (mut world, key) = pair.world(body, first, StrengthScale::default());
    let second = crate::sim::world::FigureSetup {
        name: "other".to_owned(),
        state: at(0.5 * APART, std::f64::consts::PI),
        ..pair.setup(body, first, StrengthScale::default())
    };
    let other = world.add_figure(second).expect("experiments are valid");
    let push = push_at_chest(Vec3::X * (impulse / PUSH.1), PUSH.0, PUSH.1);
    world.perturb(key, push).expect("pushes are valid");
    let dt = world.dt();
    let (mut most, mut sum, mut apart, mut overlap, mut touched) =
        ((0.0, 0.0), 0.0, 0.0f64, 0.0f64, 0.0);
    let mut fell = None;
    let record = record(&mut world, key, 3.0, panels, |w, time| {
        let of = |k| {
            let f = w.figure(k).expect("nobody removes figures");
            let r = f.report().expect("a stepped figure has a report");
            let all = r
                .touches
                .iter()
                .filter(|t| matches!(t.other, Other::Figure(..)));
            all.fold((Vec3::zero(), 0.0f64), |(f, d), t| {
                (f + t.force, d.max(t.depth))
            })
        };
        let ((a, depth), (b, _)) = (of(key), of(other));
        let f = a.norm();
        if f > most.0 && fell.is_none() {
            most = (f, time);
        }
        sum += f * dt;
        apart = apart.max((a + b).norm());
        overlap = overlap.max(depth);
        touched += if f > 0.0 { dt } else { 0.0 };
        let second = w.figure(other).expect("nobody removes figures");
        if second.is_fallen() {
            fell.get_or_insert(time);
        }
        let drawn = Thing::figure(second.body(), &second.state().posture);
        (Vec::new(), drawn.collect())
    });
    Bump {
        record,
        most,
        impulse: sum,
        unequal: if most.0 > 0.0 { apart / most.0 } else { 0.0 },
        overlap,
        touched_s: touched,
        other_fell_s: fell,
    }
}
