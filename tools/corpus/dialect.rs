//! Dialects in which BVH files express the same motion, and the writer.

use super::actor::{ABDOMEN, ARM, Actor, CHEST, FootPose, HEAD, LEG, PELVIS, Pose, Upper, sign};
use super::gait::deg;
use super::plan::Motion;
use super::tracks::{DEG, Random, v3};
use sinew_physics::math::{Mat3, Quat, Vec3, trig};
use std::fmt::Write;

/// A point of the actor.
#[derive(Clone, Copy, Debug)]
pub enum Point {
    /// Proximal joint of a segment.
    Joint(usize),
    /// Above the middle of the hips by this much, m.
    Root(f64),
    Clavicle(usize),
    Skull,
    Top,
    Fingers(usize),
    Toes(usize),
}

/// The frame with which a bone turns.
#[derive(Clone, Copy, Debug)]
pub enum Follow {
    Segment(usize),
    /// Half-way between two segments.
    Between(usize, usize),
    Neck,
    /// The forearm without its pronation.
    Bend(usize),
}

/// Pose of the zero channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Zero {
    /// Arms to the sides.
    T,
    /// Arms to the sides, thighs splayed by 20°.
    Splayed,
    /// Arms 45° down.
    A,
    /// Arms hanging.
    Down,
    /// No pose: every bone along its local x.
    AlongX,
}

/// Names of the bones, sided ones with a `{}` where the side goes.
#[derive(Clone, Copy, Debug)]
pub struct Names {
    pub root: &'static str,
    /// Trunk from below: two joints (waist, thorax), or more for dialects that split them.
    pub trunk: &'static [&'static str],
    pub neck: &'static [&'static str],
    pub head: &'static str,
    /// Spelling of the sides: left, right.
    pub sides: [&'static str; 2],
    /// Clavicle, upper arm, forearm, hand (or forearm twist and hand).
    pub arm: &'static [&'static str],
    /// Bone between pelvis and thigh, if any; thigh, shank, foot, toes.
    pub leg: &'static [&'static str],
    /// Limbs before the trunk.
    pub legs_first: bool,
}

/// End of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lines {
    Lf,
    CrLf,
    Cr,
}

/// Faults of a recording.
#[derive(Clone, Copy, Debug)]
pub struct Faults {
    /// Noise of the root, m, and of every joint, rad (standard deviations, white).
    pub noise: (f64, f64),
    /// Drift of the whole figure along the floor: planted feet slide by at most this, m/s.
    pub skate: f64,
    /// Height of the floor, m.
    pub floor: f64,
}

/// No fault.
pub const CLEAN: Faults = Faults {
    noise: (0.0, 0.0),
    skate: 0.0,
    floor: 0.0,
};

/// A dialect.
#[derive(Clone, Copy, Debug)]
pub struct Dialect {
    pub name: &'static str,
    /// Metres per unit.
    pub unit: f64,
    pub z_up: bool,
    /// Heading that the file gives to the actor's forward direction, degrees about up.
    pub facing: f64,
    pub rate: f64,
    pub names: Names,
    pub zero: Zero,
    /// Channel order of root and joints: X Y Z positions, x y z rotations. Joints take them in turn.
    pub root: &'static str,
    pub joints: &'static [&'static str],
    /// Frames in front that hold the zero pose.
    pub held: usize,
    /// Heading of the root in them, degrees.
    pub held_heading: f64,
    pub lines: Lines,
    pub tabs: bool,
    pub end_sites: bool,
    /// A joint that never moves above the hips.
    pub dead_root: bool,
    /// Decimals of lengths and angles.
    pub decimals: (usize, usize),
    pub faults: Faults,
}

const VRM: Names = Names {
    root: "hips",
    trunk: &["spine", "chest"],
    neck: &["neck"],
    head: "head",
    sides: ["left", "right"],
    arm: &["{}Shoulder", "{}UpperArm", "{}LowerArm", "{}Hand"],
    leg: &["{}UpperLeg", "{}LowerLeg", "{}Foot", "{}Toes"],
    legs_first: false,
};
const CMU: Names = Names {
    root: "Hips",
    trunk: &["LowerBack", "Spine", "Spine1"],
    neck: &["Neck", "Neck1"],
    head: "Head",
    sides: ["Left", "Right"],
    arm: &["{}Shoulder", "{}Arm", "{}ForeArm", "{}Hand", "{}FingerBase"],
    leg: &["{1}HipJoint", "{}UpLeg", "{}Leg", "{}Foot", "{}ToeBase"],
    legs_first: true,
};
const LAFAN: Names = Names {
    root: "Hips",
    trunk: &["Spine", "Spine1", "Spine2"],
    neck: &["Neck"],
    head: "Head",
    sides: ["Left", "Right"],
    arm: &["{}Shoulder", "{}Arm", "{}ForeArm", "{}Hand"],
    leg: &["{}UpLeg", "{}Leg", "{}Foot", "{}Toe"],
    legs_first: true,
};
const MIXAMO: Names = Names {
    root: "mixamorig:Hips",
    trunk: &["mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2"],
    neck: &["mixamorig:Neck"],
    head: "mixamorig:Head",
    sides: ["mixamorig:Left", "mixamorig:Right"],
    arm: &["{}Shoulder", "{}Arm", "{}ForeArm", "{}Hand"],
    leg: &["{}UpLeg", "{}Leg", "{}Foot", "{}ToeBase"],
    legs_first: false,
};
const DAZ: Names = Names {
    root: "hip",
    trunk: &["abdomen", "chest"],
    neck: &["neck"],
    head: "head",
    sides: ["l", "r"],
    arm: &["{}Collar", "{}Shldr", "{}ForeArm", "{}Hand"],
    leg: &["{}Buttock", "{}Thigh", "{}Shin", "{}Foot", "{}Toe"],
    legs_first: false,
};
const BIPED: Names = Names {
    root: "Bip01 Pelvis",
    trunk: &["Bip01 Spine", "Bip01 Spine1"],
    neck: &["Bip01 Neck"],
    head: "Bip01 Head",
    sides: ["Bip01 L ", "Bip01 R "],
    arm: &["{}Clavicle", "{}UpperArm", "{}Forearm", "{}Hand"],
    leg: &["{}Thigh", "{}Calf", "{}Foot", "{}Toe0"],
    legs_first: true,
};
const GENERIC: Names = Names {
    root: "root",
    trunk: &["lowerback", "upperback"],
    neck: &["neck"],
    head: "head",
    sides: ["left_", "right_"],
    arm: &["{}collar", "{}shoulder", "{}elbow", "{}wrist"],
    leg: &["{}hip", "{}knee", "{}ankle", "{}toe"],
    legs_first: true,
};
const COLLAR: Names = Names {
    root: "Hips",
    trunk: &["Chest", "Chest2"],
    neck: &["Neck"],
    head: "Head",
    sides: ["Left", "Right"],
    arm: &["{}Collar", "{}Shoulder", "{}Elbow", "{}Wrist"],
    leg: &["{}Hip", "{}Knee", "{}Ankle", "{}Toe"],
    legs_first: false,
};

/// The clean dialect, in which every motion is written.
pub const PLAIN: Dialect = Dialect {
    name: "vrm",
    unit: 1.0,
    z_up: false,
    facing: 0.0,
    rate: 30.0,
    names: VRM,
    zero: Zero::T,
    root: "XYZyxz",
    joints: &["yxz"],
    held: 0,
    held_heading: 0.0,
    lines: Lines::Lf,
    tabs: false,
    end_sites: true,
    dead_root: false,
    decimals: (5, 2),
    faults: CLEAN,
};

/// CMU's skeleton in units of an inch over 0.45, thighs splayed.
pub const CMU_60: Dialect = Dialect {
    name: "cmu",
    unit: 0.0254 / 0.45,
    rate: 60.0,
    names: CMU,
    zero: Zero::Splayed,
    root: "XYZzyx",
    joints: &["zyx"],
    decimals: (4, 2),
    ..PLAIN
};

/// All dialects; the first is the clean one.
pub const DIALECTS: [Dialect; 13] = [
    PLAIN,
    CMU_60,
    // The conversion for MotionBuilder: a T-pose in frame 0, CRLF, tabs.
    Dialect {
        name: "cgspeed",
        rate: 120.0,
        zero: Zero::T,
        held: 1,
        lines: Lines::CrLf,
        tabs: true,
        ..CMU_60
    },
    // Every bone along its local x, cm.
    Dialect {
        name: "lafan",
        unit: 0.01,
        facing: 90.0,
        names: LAFAN,
        zero: Zero::AlongX,
        root: "XYZzyx",
        joints: &["zyx"],
        decimals: (3, 2),
        ..PLAIN
    },
    Dialect {
        name: "mixamo",
        unit: 0.01,
        names: MIXAMO,
        root: "XYZxyz",
        joints: &["xyz"],
        decimals: (3, 2),
        facing: 180.0,
        ..PLAIN
    },
    // A different order at each joint, and a held pose that only the root shows: it faces elsewhere.
    Dialect {
        name: "daz",
        unit: 0.01,
        names: DAZ,
        zero: Zero::Down,
        root: "XYZzxy",
        joints: &["zxy", "xyz", "yzx", "xzy", "yxz"],
        held: 1,
        held_heading: 120.0,
        facing: -60.0,
        decimals: (3, 2),
        ..PLAIN
    },
    // The same with a T-pose of the arms, held for a while.
    Dialect {
        name: "threejs",
        unit: 0.01,
        names: DAZ,
        zero: Zero::T,
        root: "XYZzxy",
        joints: &["zxy"],
        held: 12,
        held_heading: 0.0,
        facing: 200.0,
        decimals: (3, 2),
        ..PLAIN
    },
    // Rotations first, z up, inches, film rate, names with blanks.
    Dialect {
        name: "biped",
        unit: 0.0254,
        z_up: true,
        facing: -90.0,
        rate: 24.0,
        names: BIPED,
        zero: Zero::A,
        root: "zxyXYZ",
        joints: &["zxy"],
        decimals: (3, 2),
        ..PLAIN
    },
    Dialect {
        name: "generic-zup",
        z_up: true,
        facing: 30.0,
        rate: 100.0,
        names: GENERIC,
        zero: Zero::Down,
        root: "XYZxyz",
        joints: &["xyz"],
        dead_root: true,
        decimals: (4, 2),
        ..PLAIN
    },
    // Six channels on every joint, decimetres, lone CR, no End Sites.
    Dialect {
        name: "six",
        unit: 0.1,
        facing: -135.0,
        names: COLLAR,
        zero: Zero::T,
        root: "XYZzxy",
        joints: &["XYZzxy"],
        lines: Lines::Cr,
        end_sites: false,
        decimals: (3, 2),
        ..PLAIN
    },
    // A recording with noise, sliding feet and a floor below zero.
    Dialect {
        name: "noisy",
        unit: 0.01,
        rate: 60.0,
        names: COLLAR,
        zero: Zero::A,
        root: "XYZzxy",
        joints: &["zxy"],
        facing: 15.0,
        decimals: (2, 2),
        faults: Faults {
            noise: (0.002, 0.4 * DEG),
            skate: 0.15,
            floor: -0.045,
        },
        ..PLAIN
    },
    // The same at 120 Hz with the floor above zero, in millimetres.
    Dialect {
        name: "noisy-120",
        unit: 0.001,
        rate: 120.0,
        names: GENERIC,
        zero: Zero::Down,
        root: "XYZyzx",
        joints: &["yzx"],
        facing: 250.0,
        decimals: (1, 2),
        faults: Faults {
            noise: (0.003, 0.8 * DEG),
            skate: 0.20,
            floor: 0.06,
        },
        ..PLAIN
    },
    // The root has no position channels: its place is its OFFSET.
    Dialect {
        name: "rot-only",
        unit: 0.0254,
        rate: 30.0,
        names: CMU,
        zero: Zero::Splayed,
        root: "zyx",
        joints: &["zyx"],
        decimals: (4, 2),
        ..PLAIN
    },
];

/// The dialect with this name.
pub fn dialect(name: &str) -> Dialect {
    *DIALECTS
        .iter()
        .find(|d| d.name == name)
        .unwrap_or_else(|| panic!("no dialect {name}"))
}

struct Joint {
    name: String,
    parent: Option<usize>,
    point: Point,
    follow: Follow,
    end: Option<Point>,
}

fn skeleton(d: &Dialect) -> Vec<Joint> {
    let n = &d.names;
    let mut out: Vec<Joint> = Vec::new();
    let mut add = |name: String, parent: Option<usize>, point, follow| {
        out.push(Joint {
            name,
            parent,
            point,
            follow,
            end: None,
        });
        out.len() - 1
    };
    let cmu = n.leg.len() == 5 && n.leg[0].contains("HipJoint");
    let root = if d.dead_root {
        let dead = add(
            "Reference".to_owned(),
            None,
            Point::Root(f64::NAN),
            Follow::Segment(usize::MAX),
        );
        add(
            n.root.to_owned(),
            Some(dead),
            Point::Root(0.05),
            Follow::Segment(PELVIS),
        )
    } else {
        add(
            n.root.to_owned(),
            None,
            Point::Root(0.05),
            Follow::Segment(PELVIS),
        )
    };
    let sided = |pattern: &str, side: usize| {
        let s = n.sides[side];
        pattern.replace("{1}", &s[..1]).replace("{}", s)
    };
    let mut ends = Vec::new();
    let legs = |add: &mut dyn FnMut(String, Option<usize>, Point, Follow) -> usize,
                ends: &mut Vec<(usize, Point)>| {
        for side in 0..2 {
            let l = LEG[side];
            let mut parent = root;
            let mut names = n.leg.iter();
            if n.leg.len() == 5 {
                let point = if cmu {
                    Point::Root(0.05)
                } else {
                    Point::Root(0.0)
                };
                parent = add(
                    sided(names.next().expect("five"), side),
                    Some(parent),
                    point,
                    Follow::Segment(PELVIS),
                );
            }
            for (k, name) in names.enumerate() {
                parent = add(
                    sided(name, side),
                    Some(parent),
                    Point::Joint(l + k),
                    Follow::Segment(l + k),
                );
            }
            ends.push((parent, Point::Toes(side)));
        }
    };
    if n.legs_first {
        legs(&mut add, &mut ends);
    }
    let mut trunk = root;
    for (k, name) in n.trunk.iter().enumerate() {
        let (point, follow) = match (n.trunk.len(), k) {
            // CMU's lower back and spine share the waist, one half each.
            (3, 0) if cmu => (Point::Root(0.05), Follow::Segment(PELVIS)),
            (3, 1) if cmu => (Point::Joint(ABDOMEN), Follow::Segment(ABDOMEN)),
            // Two joints at the thorax share its rotation.
            (3, 1) => (Point::Joint(CHEST), Follow::Between(ABDOMEN, CHEST)),
            (_, 0) => (Point::Joint(ABDOMEN), Follow::Segment(ABDOMEN)),
            _ => (Point::Joint(CHEST), Follow::Segment(CHEST)),
        };
        trunk = add((*name).to_owned(), Some(trunk), point, follow);
    }
    let mut neck = trunk;
    for (k, name) in n.neck.iter().enumerate() {
        let follow = if n.neck.len() == 2 && k == 0 {
            Follow::Between(CHEST, HEAD)
        } else {
            Follow::Neck
        };
        neck = add((*name).to_owned(), Some(neck), Point::Joint(HEAD), follow);
    }
    let head = add(
        n.head.to_owned(),
        Some(neck),
        Point::Skull,
        Follow::Segment(HEAD),
    );
    ends.push((head, Point::Top));
    for side in 0..2 {
        let a = ARM[side];
        let mut parent = add(
            sided(n.arm[0], side),
            Some(trunk),
            Point::Clavicle(side),
            Follow::Segment(CHEST),
        );
        parent = add(
            sided(n.arm[1], side),
            Some(parent),
            Point::Joint(a),
            Follow::Segment(a),
        );
        parent = add(
            sided(n.arm[2], side),
            Some(parent),
            Point::Joint(a + 1),
            Follow::Bend(side),
        );
        if n.arm.len() == 5 {
            parent = add(
                sided(n.arm[3], side),
                Some(parent),
                Point::Joint(a + 2),
                Follow::Segment(a + 1),
            );
        }
        parent = add(
            sided(n.arm[n.arm.len() - 1], side),
            Some(parent),
            Point::Joint(a + 2),
            Follow::Segment(a + 2),
        );
        ends.push((parent, Point::Fingers(side)));
    }
    if !n.legs_first {
        legs(&mut add, &mut ends);
    }
    for (joint, point) in ends {
        out[joint].end = Some(point);
    }
    out
}

fn point(actor: &Actor, pose: &Pose, p: Point) -> Vec3 {
    match p {
        Point::Joint(s) => pose.place[s],
        Point::Root(up) if up.is_nan() => Vec3::zero(),
        Point::Root(up) => pose.place[PELVIS] + pose.turn[PELVIS].rotate(v3(0.0, 0.0, up)),
        Point::Clavicle(side) => {
            let c = actor.clavicle;
            pose.place[CHEST] + pose.turn[CHEST].rotate(v3(c.x, sign(side) * c.y, c.z))
        }
        Point::Skull => pose.skull,
        Point::Top => pose.top,
        Point::Fingers(side) => pose.fingers[side],
        Point::Toes(side) => pose.tips[side],
    }
}

fn follow(pose: &Pose, f: Follow) -> Quat {
    match f {
        Follow::Segment(usize::MAX) => Quat::identity(),
        Follow::Segment(s) => pose.turn[s],
        Follow::Between(a, b) => {
            let d = pose.turn[a].conjugate() * pose.turn[b];
            pose.turn[a] * Quat::exp(d.log() * 0.5)
        }
        Follow::Neck => pose.neck,
        Follow::Bend(side) => pose.bend[side],
    }
}

/// The actor in the zero pose of a dialect, standing at the origin.
pub fn zero_pose(actor: &Actor, zero: Zero) -> Pose {
    let (arm, splay) = match zero {
        Zero::T => (90.0, 0.0),
        Zero::Splayed => (90.0, 20.0),
        Zero::A => (45.0, 0.0),
        Zero::Down | Zero::AlongX => (0.0, 0.0),
    };
    let upper = Upper {
        shoulder: [deg([0.0, arm, 0.0]); 2],
        ..Upper::default()
    };
    let (sin, cos) = trig::sin_cos(splay * DEG);
    let reach = 0.9995 * actor.leg();
    let hips = actor.ankle + reach * cos;
    let feet = [0, 1].map(|side| FootPose {
        ankle: v3(0.0, sign(side) * (actor.hip + reach * sin), actor.ankle),
        yaw: 0.0,
        pitch: 0.0,
        toe: 0.0,
    });
    actor.pose(v3(0.0, 0.0, hips), Quat::identity(), &upper, feet)
}

/// Rotation from world axes (x forward, y left, z up) to the axes of the file, with the heading it gives.
pub fn file_axes(d: &Dialect) -> Quat {
    let heading = Quat::exp(v3(0.0, 0.0, d.facing * DEG));
    if d.z_up {
        heading
    } else {
        // x → Z, y → X, z → Y.
        Quat::from_mat3(&Mat3 {
            x: v3(0.0, 0.0, 1.0),
            y: v3(1.0, 0.0, 0.0),
            z: v3(0.0, 1.0, 0.0),
        }) * heading
    }
}

fn rows(q: Quat) -> [[f64; 3]; 3] {
    let c = [q.rotate(Vec3::X), q.rotate(Vec3::Y), q.rotate(Vec3::Z)].map(Vec3::to_array);
    [0, 1, 2].map(|r| [c[0][r], c[1][r], c[2][r]])
}

/// Angles (rad) about the axes `order`, each turning the next: closed form for three different axes.
fn euler(q: Quat, order: [usize; 3]) -> [f64; 3] {
    let r = rows(q);
    let [a, b, c] = order;
    let e = if (a + 1) % 3 == b { 1.0 } else { -1.0 };
    let cos = (r[a][a] * r[a][a] + r[a][b] * r[a][b]).sqrt();
    let middle = trig::atan2(e * r[a][c], cos);
    if cos < 1e-9 {
        return [trig::atan2(e * r[c][b], r[b][b]), middle, 0.0];
    }
    [
        trig::atan2(-e * r[b][c], r[c][c]),
        middle,
        trig::atan2(-e * r[a][b], r[a][a]),
    ]
}

/// The angles of the same rotation that are nearest to `last`.
fn continuous(angles: [f64; 3], last: Option<[f64; 3]>) -> [f64; 3] {
    let pi = std::f64::consts::PI;
    let Some(last) = last else { return angles };
    let near = |a: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|k| a[k] - ((a[k] - last[k]) / (2.0 * pi)).round() * 2.0 * pi)
    };
    let far = |a: [f64; 3]| (0..3).map(|k| (a[k] - last[k]).abs()).sum::<f64>();
    let one = near(angles);
    let two = near([angles[0] + pi, pi - angles[1], angles[2] + pi]);
    if far(two) < far(one) { two } else { one }
}

/// Fixed decimals without a sign before zero and without zeros behind.
fn number(x: f64, decimals: usize) -> String {
    let mut s = format!("{x:.decimals$}");
    if s.contains('.') {
        s.truncate(s.trim_end_matches('0').trim_end_matches('.').len());
    }
    if s == "-0" { "0".to_owned() } else { s }
}

fn channels(spec: &str) -> impl Iterator<Item = (bool, usize)> + '_ {
    spec.chars().map(|c| {
        (
            c.is_uppercase(),
            "xyz".find(c.to_ascii_lowercase()).expect("an axis"),
        )
    })
}

fn rotation_order(spec: &str) -> [usize; 3] {
    let v: Vec<usize> = channels(spec).filter(|(p, _)| !p).map(|(_, k)| k).collect();
    [v[0], v[1], v[2]]
}

struct Writer<'a> {
    d: &'a Dialect,
    joints: Vec<Joint>,
    /// Constant offset of every joint in its parent's frame, m, and frame of every joint in the zero pose (file axes).
    offset: Vec<Vec3>,
    /// From the followed frame (world axes) to the joint's frame.
    carried: Vec<Quat>,
    ends: Vec<Option<Vec3>>,
    axes: Quat,
    zero: Pose,
}

/// Frame whose x axis is `x`.
fn along(x: Vec3) -> Quat {
    let x = x.normalized_or(Vec3::X);
    let side = if x.z.abs() < 0.8 { Vec3::Z } else { Vec3::X };
    let y = side.cross(x).normalized_or(Vec3::Y);
    Quat::from_mat3(&Mat3 {
        x,
        y,
        z: x.cross(y),
    })
}

impl<'a> Writer<'a> {
    fn new(d: &'a Dialect, actor: &Actor) -> Self {
        let joints = skeleton(d);
        let zero = zero_pose(actor, d.zero);
        // The zero pose faces the file's own forward axis (z, or x where z is up).
        let axes = file_axes(d);
        let plain = file_axes(&Dialect { facing: 0.0, ..*d });
        let at: Vec<Vec3> = joints
            .iter()
            .map(|j| point(actor, &zero, j.point))
            .collect();
        let end: Vec<Option<Vec3>> = joints
            .iter()
            .map(|j| j.end.map(|p| point(actor, &zero, p)))
            .collect();
        let n = joints.len();
        // Frame of each joint in the zero pose, world axes: the file's own axes, or along the bone.
        let frames: Vec<Quat> = (0..n)
            .map(|k| {
                let child = (k + 1..n)
                    .filter(|c| joints[*c].parent == Some(k))
                    .find(|c| (at[*c] - at[k]).norm() > 1e-6);
                let tip = child.map(|c| at[c]).or(end[k]);
                match tip {
                    Some(tip) if d.zero == Zero::AlongX && k > 0 => along(tip - at[k]),
                    _ => plain.conjugate(),
                }
            })
            .collect();
        let carried = (0..n)
            .map(|k| follow(&zero, joints[k].follow).conjugate() * frames[k])
            .collect();
        let offset = (0..n)
            .map(|k| match joints[k].parent {
                None => Vec3::zero(),
                Some(p) => frames[p].conjugate().rotate(at[k] - at[p]),
            })
            .collect();
        let ends = (0..n)
            .map(|k| end[k].map(|e| frames[k].conjugate().rotate(e - at[k])))
            .collect();
        Self {
            d,
            joints,
            offset,
            carried,
            ends,
            axes,
            zero,
        }
    }

    fn spec(&self, k: usize) -> &'static str {
        let root = usize::from(self.d.dead_root);
        if k < root {
            "XYZzxy"
        } else if k == root {
            self.d.root
        } else {
            self.d.joints[(k - 1) % self.d.joints.len()]
        }
    }

    fn length(&self, x: f64) -> String {
        number(x / self.d.unit, self.d.decimals.0)
    }

    fn triple(&self, v: Vec3) -> String {
        v.to_array().map(|x| self.length(x)).join(" ")
    }

    fn head(&self, out: &mut Vec<String>, k: usize, depth: usize, root_offset: Vec3) {
        let pad = if self.d.tabs {
            "\t".repeat(depth)
        } else {
            " ".repeat(depth)
        };
        let word = if self.joints[k].parent.is_none() {
            "ROOT"
        } else {
            "JOINT"
        };
        out.push(format!("{pad}{word} {}", self.joints[k].name));
        out.push(format!("{pad}{{"));
        let inner = if self.d.tabs {
            format!("{pad}\t")
        } else {
            format!("{pad} ")
        };
        let offset = if self.joints[k].parent.is_none() {
            root_offset
        } else {
            self.offset[k]
        };
        out.push(format!("{inner}OFFSET {}", self.triple(offset)));
        let spec = self.spec(k);
        let names: Vec<String> = channels(spec)
            .map(|(place, axis)| {
                format!(
                    "{}{}",
                    ["X", "Y", "Z"][axis],
                    if place { "position" } else { "rotation" }
                )
            })
            .collect();
        out.push(format!(
            "{inner}CHANNELS {} {}",
            names.len(),
            names.join(" ")
        ));
        for c in k + 1..self.joints.len() {
            if self.joints[c].parent == Some(k) {
                self.head(out, c, depth + 1, root_offset);
            }
        }
        if let (Some(end), true) = (self.ends[k], self.d.end_sites) {
            out.push(format!("{inner}End Site"));
            out.push(format!("{inner}{{"));
            out.push(format!("{inner} OFFSET {}", self.triple(end)));
            out.push(format!("{inner}}}"));
        }
        out.push(format!("{pad}}}"));
    }

    /// Local rotations of all joints and the place of the root, file axes, m.
    fn locals(&self, actor: &Actor, pose: &Pose, axes: Quat) -> (Vec<Quat>, Vec<Vec3>) {
        let world: Vec<Quat> = (0..self.joints.len())
            .map(|k| (follow(pose, self.joints[k].follow) * self.carried[k]).normalized())
            .collect();
        let mut turns = Vec::new();
        let mut places = Vec::new();
        for (k, j) in self.joints.iter().enumerate() {
            let dead = j.parent.is_none() && self.d.dead_root;
            let above_dead = j.parent == Some(0) && self.d.dead_root;
            if dead {
                turns.push(Quat::identity());
                places.push(Vec3::zero());
            } else if j.parent.is_none() || above_dead {
                turns.push(axes * world[k]);
                places.push(axes.rotate(point(actor, pose, j.point)));
            } else {
                let p = j.parent.expect("inner joint");
                turns.push(world[p].conjugate() * world[k]);
                places.push(self.offset[k]);
            }
        }
        (turns, places)
    }

    fn frame(&self, turns: &[Quat], places: &[Vec3], last: &mut [Option<[f64; 3]>]) -> String {
        let mut row = String::new();
        for k in 0..self.joints.len() {
            let spec = self.spec(k);
            let order = rotation_order(spec);
            let angles = continuous(euler(turns[k], order), last[k]);
            last[k] = Some(angles);
            for (place, axis) in channels(spec) {
                if !row.is_empty() {
                    row.push(if self.d.tabs { '\t' } else { ' ' });
                }
                let text = if place {
                    self.length(places[k].to_array()[axis])
                } else {
                    let at = order.iter().position(|a| *a == axis).expect("ordered");
                    number(angles[at] / DEG, self.d.decimals.1)
                };
                row.push_str(&text);
            }
        }
        row
    }
}

/// The file of a motion in a dialect.
pub fn write(motion: &Motion, d: &Dialect, seed: u64) -> Vec<u8> {
    let actor = &motion.script.actor;
    let w = Writer::new(d, actor);
    let frames = (motion.duration() * d.rate + 1e-9).floor() as usize + 1;
    let mut random = Random::new(seed);
    let mut rows = Vec::new();
    let mut last = vec![None; w.joints.len()];
    if d.held > 0 {
        // The held pose stands at the origin and faces where the dialect says.
        let axes = file_axes(&Dialect {
            facing: d.held_heading,
            ..*d
        });
        let (turns, places) = w.locals(actor, &w.zero, axes);
        let row = w.frame(&turns, &places, &mut vec![None; w.joints.len()]);
        rows.extend(std::iter::repeat_n(row, d.held));
    }
    let mut fixed = Vec3::zero();
    for i in 0..frames {
        let t = i as f64 / d.rate;
        let pose = motion.recorded(t);
        let (mut turns, mut places) = w.locals(actor, &pose, w.axes);
        let root = usize::from(d.dead_root);
        // Two sines of different frequency: together at most `skate`.
        let drift = |rate: f64, phase: f64| {
            let omega = 2.0 * std::f64::consts::PI * rate;
            trig::sin_cos(omega * t + phase).0 * 0.7 * d.faults.skate / omega
        };
        let offset = w
            .axes
            .rotate(v3(drift(0.55, 0.0), drift(0.8, 1.0), d.faults.floor));
        places[root] += offset;
        if i == 0 {
            fixed = places[root];
        }
        let (place_noise, turn_noise) = d.faults.noise;
        if place_noise > 0.0 {
            places[root] += v3(random.normal(), random.normal(), random.normal()) * place_noise;
        }
        if turn_noise > 0.0 {
            for (k, q) in turns.iter_mut().enumerate().skip(root) {
                // The root is seen by many markers.
                let s = if k == root {
                    0.3 * turn_noise
                } else {
                    turn_noise
                };
                *q = *q * Quat::exp(v3(random.normal(), random.normal(), random.normal()) * s);
            }
        }
        rows.push(w.frame(&turns, &places, &mut last));
    }
    let mut lines = vec!["HIERARCHY".to_owned()];
    let has_place = channels(d.root).any(|(p, _)| p);
    w.head(
        &mut lines,
        0,
        0,
        if has_place { Vec3::zero() } else { fixed },
    );
    lines.push("MOTION".to_owned());
    lines.push(format!("Frames: {}", rows.len()));
    lines.push(format!("Frame Time: {}", number(1.0 / d.rate, 7)));
    lines.extend(rows);
    let end = match d.lines {
        Lines::Lf => "\n",
        Lines::CrLf => "\r\n",
        Lines::Cr => "\r",
    };
    let mut text = String::new();
    for l in lines {
        let _ = write!(text, "{l}{end}");
    }
    text.into_bytes()
}

/// Names of the file's joints with the actor's point that each lies at.
#[allow(dead_code)] // tests/corpus compares every joint with it
pub fn joint_points(d: &Dialect, actor: &Actor, pose: &Pose) -> Vec<(String, Vec3)> {
    skeleton(d)
        .into_iter()
        .map(|j| (j.name, point(actor, pose, j.point)))
        .collect()
}
