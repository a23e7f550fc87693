//! Hands on tables and walls (figure 3 of the paper), and two figures that run into each other.

use super::{ControlPair, ExperimentRecord, push_at_chest, record};
use crate::pose::segment_poses;
use crate::strip::Thing;
use sinew_physics::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew_physics::body::topology::{DOF_NAMES, L_FOOT, R_HAND};
use sinew_physics::body::{Body, Posture, State};
use sinew_physics::collide::{Mobility, ObstacleSetup, Other, Shape};
use sinew_physics::figure::{Flags, StrengthScale};
use sinew_physics::math::curve::ramp;
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::Clip;
use sinew_physics::motion::builtin::at_ease;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, MotionSource};
use std::sync::Arc;

/// The prop on which the hand leans.
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
/// Time for which it is watched, s.
const DURATION: f64 = 4.0;

/// A posture that leans: forward from the ankles and in the hips, rad; right shoulder and elbow flexion, rad.
#[derive(Clone, Copy, Debug)]
struct LeanPosture {
    ankles: f64,
    hips: f64,
    shoulder: f64,
    elbow: f64,
}

/// Bent over the table, the arm slanting down to it: the centre of mass is in front of the toes.
const TO_TABLE: LeanPosture = LeanPosture {
    ankles: 0.14,
    hips: 0.15,
    shoulder: 0.75,
    elbow: 0.05,
};
/// Straight towards the wall, the arm stretched to it.
const TO_WALL: LeanPosture = LeanPosture {
    ankles: 0.16,
    hips: 0.0,
    shoulder: 1.55,
    elbow: 0.15,
};

/// A figure that leans on its right hand.
#[derive(Clone, Debug)]
pub struct HandSupport {
    /// The run.
    pub record: ExperimentRecord,
    /// Mean force of table or wall on the hand over the last second, world axes, N.
    pub force: Vec3,
    /// Mean vertical force of the floor over the last second, N.
    pub floor: f64,
    /// Weight, N.
    pub weight: f64,
    /// Largest share of the friction cone that any tick used.
    pub cone: f64,
    /// Share of the ticks of the last second in which the hand touched.
    pub touching: f64,
    /// Mean vertical force of table or wall on the whole body over the last second, N.
    pub rest: f64,
    /// Mean force into the face over the last second, N.
    pub pressed: f64,
    /// Support ratio (2) of the hand with the centre of mass far from the hand's side and near to it: means of the
    /// centre of mass towards that side, m, and of the ratio, over the farther and the nearer half of the ticks in
    /// which feet and hand support.
    pub ratio: [(f64, f64); 2],
}

fn dof(name: &str) -> usize {
    DOF_NAMES
        .iter()
        .position(|n| *n == name)
        .expect("the DOF exists")
}

/// Standing at ease, leaning, the right arm put forward; feet flat in their places.
fn leaning(body: &Body, lean: LeanPosture) -> Posture {
    let ease = at_ease(body);
    let mut angles = anatomical_angles(&ease);
    for side in ["l", "r"] {
        angles[dof(&format!("{side}_ankle_flexion"))] += lean.ankles;
        angles[dof(&format!("{side}_hip_flexion"))] += lean.hips;
    }
    angles[dof("r_shoulder_flexion")] = lean.shoulder;
    angles[dof("r_elbow_flexion")] = lean.elbow;
    let mut out = ease;
    set_anatomical_angles(&mut out, &angles);
    let pitch = lean.ankles + lean.hips;
    out.root_rotation = Quat::from_axis_angle(Vec3::Y, pitch) * out.root_rotation;
    let foot = |p: &Posture| segment_poses(&body.joint_offset, p)[L_FOOT.index()].position;
    out.root_position += foot(&ease) - foot(&out);
    out
}

/// Normal of the face on which the hand leans.
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
    Some(fixed(half, position, Quat::from_axis_angle(Vec3::Y, slope)))
}

/// A box that nothing moves.
fn fixed(half: Vec3, position: Vec3, rotation: Quat) -> ObstacleSetup {
    ObstacleSetup {
        name: "prop".into(),
        shape: Shape::Box { half },
        mobility: Mobility::Fixed,
        friction: FRICTION,
        position,
        rotation,
        velocity: Vec3::zero(),
        angular_velocity: Vec3::zero(),
    }
}

/// Leans on a table or a wall with the right hand, with `arm` times the strength in that arm. The feet stay where they
/// are: no protective step.
pub fn hand_support(
    body: &Arc<Body>,
    pair: &ControlPair,
    what: Prop,
    arm: f64,
    panels: usize,
) -> HandSupport {
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
    let mut ratios: Vec<(f64, f64)> = Vec::new();
    let record = record(&mut world, key, DURATION, panels, |w, time| {
        let f = w.figure(key).expect("nobody removes the figure");
        let r = f.report().expect("a stepped figure has a report");
        weight = f.links().total_mass() * w.params().gravity;
        let (at, share) = (r.balance.com.x, r.balance.support_ratio[R_HAND.index()]);
        if share > 0.0 && r.balance.main_support.is_some() && !f.is_fallen() {
            ratios.push((at, share));
        }
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
    HandSupport {
        record,
        force: force * (1.0 / ticks),
        floor: floor / ticks,
        weight,
        cone,
        touching: touching / ticks,
        rest: rest / ticks,
        pressed: force.dot(normal) / ticks,
        ratio: halves(ratios),
    }
}

/// Means of the halves with the smaller and with the larger first numbers; zeros for an empty half.
fn halves(mut all: Vec<(f64, f64)>) -> [(f64, f64); 2] {
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (low, high) = all.split_at(all.len() / 2);
    [low, high].map(|half| {
        let sum = half.iter().fold((0.0, 0.0), |s, x| (s.0 + x.0, s.1 + x.1));
        let n = half.len().max(1) as f64;
        (sum.0 / n, sum.1 / n)
    })
}

/// Two figures, one of which is pushed into the other.
#[derive(Clone, Debug)]
pub struct Bump {
    /// The run of the one that is pushed; the other is drawn with it.
    pub record: ExperimentRecord,
    /// Largest force between them in a tick, N, and its time, s.
    pub most: (f64, f64),
    /// The impulse between them, N·s.
    pub impulse: f64,
    /// Largest difference of the forces on both, relative to the largest force.
    pub unequal: f64,
    /// Largest overlap, m.
    pub overlap: f64,
    /// Time for which they touched, s.
    pub touched_s: f64,
    /// Time at which the other fell, s.
    pub other_fell_s: Option<f64>,
}

/// Distance of the two pelvises, m; beginning and length of the push on the first, s.
const APART: f64 = 0.75;
const PUSH: (f64, f64) = (0.4, 0.2);

/// Face to face; the left one is pushed in the back with `impulse` N·s.
pub fn bump(body: &Arc<Body>, pair: &ControlPair, impulse: f64, panels: usize) -> Bump {
    let at = |x: f64, yaw: f64| {
        let mut posture = at_ease(body);
        let turn = Quat::from_axis_angle(Vec3::Z, yaw);
        posture.root_position = turn.rotate(posture.root_position) + Vec3::X * x;
        posture.root_rotation = turn * posture.root_rotation;
        State::at_rest(posture)
    };
    let first = at(-0.5 * APART, 0.0);
    let (mut world, key) = pair.world(body, first, StrengthScale::default());
    let second = sinew_physics::world::FigureSetup {
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

/// An arm that is raised against something.
#[derive(Clone, Debug)]
pub struct ArmReach {
    /// The run of the figure that raises the arm.
    pub record: ExperimentRecord,
    /// Time of the first touch, s; the share of the time after it in which the arm touches.
    pub met: Option<(f64, f64)>,
    /// Mean force on the arm over the last second, N, and the largest of any tick.
    pub force: (f64, f64),
    /// Largest overlap after a tick, m.
    pub overlap: f64,
    /// Largest difference of the forces on both figures, relative to the largest force; 0 with a wall.
    pub unequal: f64,
    /// Share of the ticks in which torques moved the figure.
    pub handed_over: f64,
    /// Largest violation of strength.
    pub over_limit: f64,
}

/// The obstacle against which the arm is raised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReachObstacle {
    /// A wall, closer than the length of the arm.
    Wall,
    /// A standing figure.
    Other,
}

/// Time over which the arm is raised, s, and time for which it is watched.
const RAISE: f64 = 1.0;
const WATCHED: f64 = 4.0;
/// Distance by which the obstacle is closer than the reach of the hand, m.
const TOO_NEAR: f64 = 0.06;

/// Stands and raises the right arm against something, with `arm` times its strength.
pub fn reach(
    body: &Arc<Body>,
    pair: &ControlPair,
    against: ReachObstacle,
    arm: f64,
    panels: usize,
) -> ArmReach {
    const RATE: f64 = 60.0;
    let ease = at_ease(body);
    let raised = |share: f64| {
        let mut angles = anatomical_angles(&ease);
        let mut turn = |name: &str, to: f64| {
            let d = dof(name);
            angles[d] += share * (to - angles[d]);
        };
        turn("r_shoulder_flexion", 1.2);
        turn("r_elbow_flexion", 0.5);
        let mut out = ease;
        set_anatomical_angles(&mut out, &angles);
        out
    };
    let postures: Vec<Posture> = (0..=(WATCHED * RATE) as usize)
        .map(|i| raised(ramp(i as f64 / RATE, 0.2, 0.2 + RAISE)))
        .collect();
    let planted = vec![[true; 2]; postures.len()];
    let clip = Clip::from_postures("reach", RATE, postures, planted).expect("a valid clip");
    let mut strength = StrengthScale::default();
    for (factor, name) in strength.dof.iter_mut().zip(DOF_NAMES) {
        if name.starts_with("r_shoulder") || name.starts_with("r_elbow") {
            *factor = arm;
        }
    }
    let mut pair = pair.clone();
    pair.params.protective_steps = false;
    let (mut world, key) = pair.world(body, State::at_rest(ease), strength);
    let figure = world.figure_mut(key).expect("it was just added");
    figure.set_drive(MotionSource::Clip(ClipPlayback::new(
        Arc::new(clip),
        WorldTime(0.0),
    )));
    // The full reach of the hand.
    let hand = segment_poses(&body.joint_offset, &raised(1.0))[R_HAND.index()];
    let mesh = &body.segment(R_HAND).mesh;
    let tip = (mesh.vertices.iter().map(|p| hand.point(*p).x)).fold(f64::NEG_INFINITY, f64::max);
    let mut other = None;
    match against {
        ReachObstacle::Wall => {
            let half = Vec3 {
                x: 0.05,
                y: 0.6,
                z: 1.0,
            };
            let position = Vec3 {
                x: tip - TOO_NEAR + half.x,
                y: 0.0,
                z: half.z,
            };
            let wall = fixed(half, position, Quat::identity());
            world.add_obstacle(wall).expect("walls are valid");
        }
        ReachObstacle::Other => {
            // Face to face, a little to the side, so that the hand meets the middle of the chest.
            let mut posture = ease;
            let turn = Quat::from_axis_angle(Vec3::Z, std::f64::consts::PI);
            posture.root_position = turn.rotate(posture.root_position);
            posture.root_rotation = turn * posture.root_rotation;
            posture.root_position += Vec3 {
                x: tip - TOO_NEAR + 0.12,
                y: hand.position.y,
                z: 0.0,
            };
            let second = sinew_physics::world::FigureSetup {
                name: "other".to_owned(),
                ..pair.setup(body, State::at_rest(posture), StrengthScale::default())
            };
            other = Some(world.add_figure(second).expect("experiments are valid"));
        }
    }
    let (mut met, mut touching, mut after) = (None, 0.0, 0.0);
    let (mut last, mut ticks, mut most, mut overlap) = (0.0, 0.0, 0.0f64, 0.0f64);
    let (mut unequal, mut handed, mut all) = (0.0f64, 0.0, 0.0);
    let record = record(&mut world, key, WATCHED, panels, |w, time| {
        let sum = |k| {
            let r = w.figure(k).and_then(|f| f.report());
            let touches = r.into_iter().flat_map(|r| r.touches.iter());
            touches.fold((Vec3::zero(), 0.0f64), |(f, d), t| {
                (f + t.force, d.max(t.depth))
            })
        };
        let (force, depth) = sum(key);
        let f = force.norm();
        if f > 0.0 {
            met.get_or_insert(time);
        }
        if met.is_some() {
            after += 1.0;
            touching += f64::from(u8::from(f > 0.0));
        }
        if time > WATCHED - 1.0 {
            last += f;
            ticks += 1.0;
        }
        most = most.max(f);
        overlap = overlap.max(depth);
        let flags = w.figure(key).and_then(|f| f.report()).map(|r| r.flags);
        handed += f64::from(u8::from(flags.is_some_and(|f| f.has(Flags::HANDED_OVER))));
        all += 1.0;
        let mut things: Vec<Thing> = w
            .obstacles()
            .map(|(_, o)| Thing::obstacle(o.setup()))
            .collect();
        if let Some(k) = other {
            unequal = unequal.max((force + sum(k).0).norm());
            let second = w.figure(k).expect("nobody removes figures");
            things.extend(Thing::figure(second.body(), &second.state().posture));
        }
        (Vec::new(), things)
    });
    ArmReach {
        met: met.map(|t| (t, touching / f64::max(after, 1.0))),
        force: (last / ticks, most),
        overlap,
        unequal: if most > 0.0 { unequal / most } else { 0.0 },
        handed_over: handed / all,
        over_limit: record.over_limit,
        record,
    }
}
