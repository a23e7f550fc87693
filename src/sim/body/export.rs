//! A body as a model file that other physics engines load: MJCF (MuJoCo; also read by Pinocchio) and URDF.
//!
//! The MJCF is exact: the same tree, ball joints, hinges in series, inertias, armature and gravity, so that another
//! engine gives the same inertia matrix and the same torques to rounding. URDF has no ball joint; there each one
//! becomes three hinges in the order of its DOFs, which moves the same way but has other coordinates and is singular
//! where the middle angle is ±90°. Both carry the strength of the muscles as constant torque bounds ([`Actuation`]):
//! actuators in MJCF, effort and velocity in URDF. Every number is printed with as many digits (up to 17) as it takes
//! to read back the same bits.

use super::links::Links;
use super::model::Body;
use super::topology::{
    DOF_AXIS, DOF_COUNT, DOF_LEN, DOF_NAMES, DOF_START, JOINT, JOINT_NAMES, Joint, PARENT,
    SEGMENT_COUNT, SEGMENT_NAMES,
};
use crate::math::{Sym3, Vec3};
use std::fmt::Write;

mod solids;

/// Standard gravity of exported models, m/s², pointing down z; also the default of a world.
pub const EXPORT_GRAVITY: f64 = 9.81;

/// The muscles of each DOF as plain actuators: torque bounds that depend on neither angle nor speed, and a largest
/// speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuation {
    /// Least torque of each DOF, N·m, < 0.
    pub lower: [f64; DOF_COUNT],
    /// Largest torque of each DOF, N·m, > 0.
    pub upper: [f64; DOF_COUNT],
    /// Largest speed of each DOF, rad/s, > 0.
    pub speed: [f64; DOF_COUNT],
}

/// Smallest mass (kg) and inertia (kg·m²) given to the massless links of a URDF in MuJoCo, which would otherwise reject
/// them.
const URDF_LEAST_MASS: f64 = 1e-12;

/// Mass properties of one segment as model files expect them: about the centre of mass, in segment axes.
struct Inertial {
    mass: f64,
    com: Vec3,
    inertia: Sym3,
}

/// The unloaded segment's own numbers where nothing was added (bit for bit), else those of `links` moved to the centre
/// of mass.
fn inertial(body: &Body, plain: &Links, links: &Links, i: usize) -> Inertial {
    let same = plain.mass[i] == links.mass[i]
        && plain.moment[i] == links.moment[i]
        && plain.inertia[i] == links.inertia[i];
    if same {
        let s = &body.segments[i];
        return Inertial {
            mass: s.mass,
            com: s.com,
            inertia: s.inertia,
        };
    }
    let com = links.moment[i] * (1.0 / links.mass[i]);
    Inertial {
        mass: links.mass[i],
        com,
        inertia: links.inertia[i] - Sym3::point_mass(links.mass[i], com),
    }
}

/// Numbers separated by blanks, each the shortest text that reads back as the same `f64`.
fn list(numbers: &[f64]) -> String {
    let mut out = String::new();
    for (k, x) in numbers.iter().enumerate() {
        if k > 0 {
            out.push(' ');
        }
        // −0 and 0 are the same number to a reader.
        let _ = write!(out, "{:?}", if *x == 0.0 { 0.0 } else { *x });
    }
    out
}

fn vector(v: Vec3) -> String {
    list(&v.to_array())
}

/// The children of segment `i`, in segment order.
fn children(i: usize) -> impl Iterator<Item = usize> {
    (1..SEGMENT_COUNT).filter(move |c| PARENT[*c] == i)
}

/// The unloaded body as MJCF, gravity [`EXPORT_GRAVITY`]; see [`mjcf_with`].
pub fn mjcf(body: &Body, actuation: &Actuation) -> String {
    mjcf_with(body, &Links::new(body), EXPORT_GRAVITY, actuation)
}

/// `body` with the mass properties of `links` (loads welded on) as a MuJoCo XML model. Gravity in m/s², along −z.
///
/// * A free joint `root`, then one MuJoCo body per segment, with Sinew's names and in its order; ball joints bear the
///   joint's name, hinges the DOF's. `qvel` is MuJoCo's: free joint linear (world) then angular (pelvis axes), balls
///   along child x, y, z; Sinew's rates are along the signed axes of [`DOF_AXIS`].
/// * Full inertia of each segment about its centre of mass; armature per joint. MuJoCo gives a ball joint one armature
///   for its three axes: the first DOF's is written, so the model is exact when the three are equal, as they are in
///   every body Sinew builds.
/// * Segment shapes are visual meshes, contact points are sites: nothing collides.
/// * One motor per DOF, named after it: control in N·m along the DOF's signed axis, bounds of control and force from
///   `actuation`. There is no damping: passive tissue and ligaments are not part of the file.
/// * Hinges have their range, which acts when the model's flag `limit` is enabled; it is disabled, so that the dynamics
///   are the unconstrained ones. MuJoCo has no range for the anatomical angles of a ball joint, so these are custom
///   numbers `<DOF>_range`.
/// * A key frame `stand` holds the zero pose with the soles on z = 0.
pub fn mjcf_with(body: &Body, links: &Links, gravity: f64, actuation: &Actuation) -> String {
    let plain = Links::new(body);
    let mut o = String::with_capacity(1 << 15);
    o.push_str("<mujoco model=\"sinew_human\">\n");
    o.push_str(
        "  <compiler angle=\"radian\" autolimits=\"false\" inertiafromgeom=\"false\" balanceinertia=\"false\" \
         fusestatic=\"false\"/>\n",
    );
    let _ = writeln!(
        o,
        "  <option gravity=\"{}\">\n    <flag limit=\"disable\"/>\n  </option>",
        list(&[0.0, 0.0, -gravity])
    );
    mjcf_ball_ranges(&mut o, body);
    let shaped = |i: usize| !body.segments[i].mesh.triangles.is_empty();
    if (0..SEGMENT_COUNT).any(shaped) {
        o.push_str("  <asset>\n");
        for i in (0..SEGMENT_COUNT).filter(|i| shaped(*i)) {
            let mesh = &body.segments[i].mesh;
            let vertices: Vec<f64> = mesh.vertices.iter().flat_map(|v| v.to_array()).collect();
            let faces: Vec<String> = mesh
                .triangles
                .iter()
                .map(|t| format!("{} {} {}", t[0], t[1], t[2]))
                .collect();
            let _ = writeln!(
                o,
                "    <mesh name=\"{}\" vertex=\"{}\" face=\"{}\"/>",
                SEGMENT_NAMES[i],
                list(&vertices),
                faces.join(" ")
            );
        }
        o.push_str("  </asset>\n");
    }
    o.push_str("  <worldbody>\n");
    mjcf_segment(&mut o, body, &plain, links, 0, 2);
    o.push_str("  </worldbody>\n");
    mjcf_motors(&mut o, actuation);
    // Free joint position and w, x, y, z; then in joint order a quaternion per ball and an angle per hinge.
    let mut stand = vec![0.0, 0.0, body.standing_root_height(), 1.0, 0.0, 0.0, 0.0];
    for s in 1..SEGMENT_COUNT {
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(_) => stand.extend([1.0, 0.0, 0.0, 0.0]),
            Joint::Hinge2(_) => stand.extend([0.0; 2]),
            Joint::Hinge1(_) => stand.push(0.0),
        }
    }
    let _ = writeln!(
        o,
        "  <keyframe>\n    <key name=\"stand\" qpos=\"{}\"/>\n  </keyframe>",
        list(&stand)
    );
    o.push_str("</mujoco>\n");
    o
}

/// Ranges of the anatomical angles of ball joints, which joints of the format cannot hold.
fn mjcf_ball_ranges(o: &mut String, body: &Body) {
    o.push_str("  <custom>\n");
    for i in (1..SEGMENT_COUNT).filter(|i| matches!(JOINT[*i], Joint::Ball(_))) {
        for k in DOF_START[i]..DOF_START[i] + DOF_LEN[i] {
            let _ = writeln!(
                o,
                "    <numeric name=\"{}_range\" data=\"{}\"/>",
                DOF_NAMES[k],
                list(&[body.lower[k], body.upper[k]])
            );
        }
    }
    o.push_str("  </custom>\n");
}

/// One motor per DOF. On a ball joint the gear is the DOF's axis in child axes, so that control is torque along it.
fn mjcf_motors(o: &mut String, actuation: &Actuation) {
    o.push_str("  <actuator>\n");
    for i in 1..SEGMENT_COUNT {
        for k in DOF_START[i]..DOF_START[i] + DOF_LEN[i] {
            let (joint, gear) = match JOINT[i] {
                Joint::Ball(_) => (JOINT_NAMES[i], list(&DOF_AXIS[k].vector())),
                _ => (DOF_NAMES[k], list(&[1.0])),
            };
            let range = list(&[actuation.lower[k], actuation.upper[k]]);
            let _ = writeln!(
                o,
                "    <motor name=\"{}\" joint=\"{joint}\" gear=\"{gear}\" ctrllimited=\"true\" ctrlrange=\"{range}\" \
                 forcelimited=\"true\" forcerange=\"{range}\"/>",
                DOF_NAMES[k]
            );
        }
    }
    o.push_str("  </actuator>\n");
}

fn mjcf_segment(o: &mut String, body: &Body, plain: &Links, links: &Links, i: usize, depth: usize) {
    let pad = "  ".repeat(depth);
    let name = SEGMENT_NAMES[i];
    let offset = if i == 0 {
        Vec3::zero()
    } else {
        links.offset[i]
    };
    let _ = writeln!(o, "{pad}<body name=\"{name}\" pos=\"{}\">", vector(offset));
    let d = DOF_START[i];
    match JOINT[i] {
        Joint::Free => {
            let _ = writeln!(o, "{pad}  <freejoint name=\"{}\"/>", JOINT_NAMES[i]);
        }
        Joint::Ball(_) => {
            let _ = writeln!(
                o,
                "{pad}  <joint name=\"{}\" type=\"ball\" armature=\"{}\" limited=\"false\"/>",
                JOINT_NAMES[i],
                list(&[links.armature[d]])
            );
        }
        Joint::Hinge2(_) | Joint::Hinge1(_) => {
            for k in d..d + DOF_LEN[i] {
                let _ = writeln!(
                    o,
                    "{pad}  <joint name=\"{}\" type=\"hinge\" axis=\"{}\" armature=\"{}\" \
                     limited=\"true\" range=\"{}\"/>",
                    DOF_NAMES[k],
                    list(&DOF_AXIS[k].vector()),
                    list(&[links.armature[k]]),
                    list(&[body.lower[k], body.upper[k]])
                );
            }
        }
    }
    let p = inertial(body, plain, links, i);
    let j = p.inertia;
    let _ = writeln!(
        o,
        "{pad}  <inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>",
        vector(p.com),
        list(&[p.mass]),
        list(&[j.xx, j.yy, j.zz, j.xy, j.xz, j.yz])
    );
    let segment = &body.segments[i];
    if !segment.mesh.triangles.is_empty() {
        let _ = writeln!(
            o,
            "{pad}  <geom name=\"{name}\" type=\"mesh\" mesh=\"{name}\" contype=\"0\" conaffinity=\"0\"/>"
        );
    }
    for (k, point) in segment.contact_points.iter().enumerate() {
        let _ = writeln!(
            o,
            "{pad}  <site name=\"{name}_contact_{k}\" pos=\"{}\" size=\"0.005\"/>",
            vector(*point)
        );
    }
    for c in children(i) {
        mjcf_segment(o, body, plain, links, c, depth + 1);
    }
    let _ = writeln!(o, "{pad}</body>");
}

/// The unloaded body as URDF; see [`urdf_with`].
pub fn urdf(body: &Body, actuation: &Actuation) -> String {
    urdf_with(body, &Links::new(body), actuation)
}

/// `body` with the mass properties of `links` (loads welded on) as URDF.
///
/// The pelvis is the root link, to be given a floating base by the loader. Each joint with k DOFs is k `revolute`
/// joints named after the DOFs, in their order, about their signed axes, with massless links (named `<DOF>_link`)
/// between; the last carries the segment. A ball joint's three hinge angles turn the child by `R = exp(a₁θ₁) exp(a₂θ₂)
/// exp(a₃θ₃)`. Limits are the anatomical ones: for hinge chains they bound slightly other angles. `effort` is the
/// larger of the two bounds of `actuation`, because the format has one for both directions; `velocity` is its speed.
/// Armature and gravity have no place in the format.
///
/// Visuals are boxes and cylinders, because meshes would have to be separate files: four slices per segment, together
/// of the volume of its surface. An element `mujoco`, which other loaders skip, tells MuJoCo to keep visuals and the
/// pelvis as a body, and to accept massless links.
pub fn urdf_with(body: &Body, links: &Links, actuation: &Actuation) -> String {
    let plain = Links::new(body);
    let mut o = String::with_capacity(1 << 15);
    o.push_str("<?xml version=\"1.0\"?>\n<robot name=\"sinew_human\">\n");
    let least = list(&[URDF_LEAST_MASS]);
    let _ = writeln!(
        o,
        "  <mujoco>\n    <compiler fusestatic=\"false\" discardvisual=\"false\" inertiafromgeom=\"false\" \
         boundmass=\"{least}\" boundinertia=\"{least}\"/>\n  </mujoco>"
    );
    for i in 0..SEGMENT_COUNT {
        let p = inertial(body, &plain, links, i);
        let j = p.inertia;
        let _ = writeln!(
            o,
            "  <link name=\"{}\">\n    <inertial>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n      <mass \
             value=\"{}\"/>",
            SEGMENT_NAMES[i],
            vector(p.com),
            list(&[p.mass])
        );
        let _ = writeln!(
            o,
            "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n    </inertial>",
            list(&[j.xx]),
            list(&[j.xy]),
            list(&[j.xz]),
            list(&[j.yy]),
            list(&[j.yz]),
            list(&[j.zz])
        );
        urdf_visuals(&mut o, body, i);
        o.push_str("  </link>\n");
    }
    for i in 1..SEGMENT_COUNT {
        let (first, count) = (DOF_START[i], DOF_LEN[i]);
        let mut parent = SEGMENT_NAMES[PARENT[i]].to_owned();
        for k in first..first + count {
            let last = k + 1 == first + count;
            let child = if last {
                SEGMENT_NAMES[i].to_owned()
            } else {
                let link = format!("{}_link", DOF_NAMES[k]);
                let _ = writeln!(o, "  <link name=\"{link}\"/>");
                link
            };
            let origin = if k == first {
                links.offset[i]
            } else {
                Vec3::zero()
            };
            let _ = writeln!(
                o,
                "  <joint name=\"{}\" type=\"revolute\">\n    <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n    <parent \
                 link=\"{parent}\"/>\n    <child link=\"{child}\"/>\n    <axis xyz=\"{}\"/>",
                DOF_NAMES[k],
                vector(origin),
                list(&DOF_AXIS[k].vector())
            );
            let _ = writeln!(
                o,
                "    <limit lower=\"{}\" upper=\"{}\" effort=\"{}\" velocity=\"{}\"/>\n  </joint>",
                list(&[body.lower[k]]),
                list(&[body.upper[k]]),
                list(&[actuation.upper[k].max(-actuation.lower[k])]),
                list(&[actuation.speed[k]])
            );
            parent = child;
        }
    }
    o.push_str("</robot>\n");
    o
}

/// The shape of segment `i` as boxes and cylinders.
fn urdf_visuals(o: &mut String, body: &Body, i: usize) {
    for s in solids::solids(&body.segments[i].mesh) {
        let shape = if s.cylinder {
            format!(
                "<cylinder radius=\"{}\" length=\"{}\"/>",
                list(&[0.5 * s.size.x]),
                list(&[s.size.z])
            )
        } else {
            format!("<box size=\"{}\"/>", vector(s.size))
        };
        let _ = writeln!(
            o,
            "    <visual>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n      <geometry>{shape}</geometry>\n    </visual>",
            vector(s.middle)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Profile, Segment, SegmentId, Sex};
    use crate::math::vec3::vec3;

    fn body() -> Body {
        let segment = |i: usize| Segment {
            mass: 1.0 + i as f64 / 3.0,
            com: vec3(0.01 * i as f64, -0.02, 0.1),
            inertia: Sym3 {
                xx: 0.1,
                yy: 0.11,
                zz: 0.12,
                xy: 1e-3 / 3.0,
                xz: -2e-3,
                yz: 1e-3,
            },
            mesh: Default::default(),
            contact_points: vec![vec3(0.0, 0.0, -0.1)],
            tip: vec3(0.0, 0.0, 0.2),
        };
        let segments: Vec<Segment> = (0..SEGMENT_COUNT).map(segment).collect();
        Body {
            profile: Profile {
                sex: Sex::Male,
                age: 30.0,
                height: 1.75,
                mass: segments.iter().map(|s| s.mass).sum(),
            },
            segments,
            joint_offset: std::array::from_fn(|i| vec3(0.1 / 3.0, 0.01 * i as f64, 0.2)),
            lower: [-1.0; DOF_COUNT],
            upper: [2.0 / 3.0; DOF_COUNT],
            armature: [0.02; DOF_COUNT],
        }
    }

    fn actuation() -> Actuation {
        Actuation {
            lower: std::array::from_fn(|d| -10.0 - d as f64 / 3.0),
            upper: std::array::from_fn(|d| 20.0 - d as f64 / 7.0),
            speed: std::array::from_fn(|d| 5.0 + d as f64),
        }
    }

    /// Values of an attribute of the element that follows `anchor`.
    fn attribute(text: &str, anchor: &str, attribute: &str) -> Vec<f64> {
        let rest = &text[text.find(anchor).expect("anchor present")..];
        let key = format!(" {attribute}=\"");
        let start = rest.find(&key).expect("attribute present") + key.len();
        let end = start + rest[start..].find('"').expect("closing quote");
        rest[start..end]
            .split(' ')
            .map(|x| x.parse().expect("a number"))
            .collect()
    }

    #[test]
    fn printed_numbers_read_back_to_the_same_bits() {
        let b = body();
        for i in 0..SEGMENT_COUNT {
            let (anchor, s) = (
                format!("<body name=\"{}\"", SEGMENT_NAMES[i]),
                &b.segments[i],
            );
            let x = mjcf(&b, &actuation());
            assert_eq!(attribute(&x, &anchor, "mass"), [s.mass]);
            let j = s.inertia;
            assert_eq!(
                attribute(&x, &anchor, "fullinertia"),
                [j.xx, j.yy, j.zz, j.xy, j.xz, j.yz]
            );
            if i > 0 {
                assert_eq!(
                    attribute(&x, &anchor, "pos"),
                    b.joint_offset[i].to_array().to_vec()
                );
            }
        }
    }

    #[test]
    fn a_load_changes_its_segment_and_no_other() {
        let b = body();
        let mut links = Links::new(&b);
        let hand = SegmentId::from_name("r_hand").expect("a segment");
        links.add_load(hand, vec3(0.1, 0.2, -0.3), 5.0);
        let (plain, loaded) = (
            mjcf(&b, &actuation()),
            mjcf_with(&b, &links, EXPORT_GRAVITY, &actuation()),
        );
        let changed: Vec<(&str, &str)> = plain
            .lines()
            .zip(loaded.lines())
            .filter(|(a, b)| a != b)
            .collect();
        assert_eq!(changed.len(), 1);
        let mass = attribute(&loaded, "<body name=\"r_hand\"", "mass")[0];
        assert_eq!(mass, b.segments[9].mass + 5.0);
        // Parallel axes: inertia about the segment origin is the sum of both.
        let com = Vec3::from_array(
            attribute(&loaded, "<body name=\"r_hand\"", "pos")
                .try_into()
                .map_or([0.0; 3], |a: [f64; 3]| a),
        );
        assert_eq!(com, b.joint_offset[9], "first pos is the joint's");
        let full = attribute(&loaded, "<body name=\"r_hand\"", "fullinertia");
        let c = links.moment[9] * (1.0 / links.mass[9]);
        let back = Sym3 {
            xx: full[0],
            yy: full[1],
            zz: full[2],
            xy: full[3],
            xz: full[4],
            yz: full[5],
        } + Sym3::point_mass(links.mass[9], c);
        assert!((back.xx - links.inertia[9].xx).abs() < 1e-15 * 10.0);
        assert!((back.yz - links.inertia[9].yz).abs() < 1e-15 * 10.0);
    }

    #[test]
    fn urdf_has_one_joint_per_dof_and_a_tree_of_links() {
        let x = urdf(&body(), &actuation());
        assert_eq!(x.matches("<joint name=").count(), DOF_COUNT);
        assert_eq!(
            x.matches("<link name=").count(),
            DOF_COUNT + 1,
            "every joint has its own child link, plus the pelvis"
        );
        for name in DOF_NAMES {
            assert_eq!(x.matches(&format!("<joint name=\"{name}\"")).count(), 1);
        }
        assert_eq!(attribute(&x, "name=\"l_elbow_flexion\"", "lower"), [-1.0]);
    }

    #[test]
    fn every_dof_has_a_motor_with_its_own_bounds_and_a_range() {
        let (x, a) = (mjcf(&body(), &actuation()), actuation());
        assert_eq!(x.matches("<motor ").count(), DOF_COUNT);
        for d in 0..DOF_COUNT {
            let motor = format!("<motor name=\"{}\"", DOF_NAMES[d]);
            for range in ["ctrlrange", "forcerange"] {
                let bounds = attribute(&x, &motor, range);
                assert_eq!(bounds, [a.lower[d], a.upper[d]], "{}", DOF_NAMES[d]);
            }
            let range = format!("<numeric name=\"{}_range\"", DOF_NAMES[d]);
            let joint = format!("<joint name=\"{}\"", DOF_NAMES[d]);
            let (anchor, key) = if x.contains(&range) {
                (range, "data")
            } else {
                (joint, "range")
            };
            assert_eq!(attribute(&x, &anchor, key), [-1.0, 2.0 / 3.0]);
        }
    }

    #[test]
    fn urdf_bounds_are_those_of_the_stronger_direction() {
        let (x, a) = (urdf(&body(), &actuation()), actuation());
        for d in 0..DOF_COUNT {
            let joint = format!("<joint name=\"{}\"", DOF_NAMES[d]);
            let most = a.upper[d].max(-a.lower[d]);
            assert_eq!(attribute(&x, &joint, "effort"), [most]);
            assert_eq!(attribute(&x, &joint, "velocity"), [a.speed[d]]);
        }
        let shown = urdf(&Body::adult_man(), &a);
        assert_eq!(shown.matches("<visual>").count(), 4 * SEGMENT_COUNT);
    }
}
