//! Writes random states of several bodies with the results of Sinew's dynamics, for comparison with other engines:
//! `cargo run -p tools --bin dump_dynamics -- OUT_DIR [STATES_PER_MODEL]`.
//!
//! For each model `OUT_DIR/<name>.mjcf`, `OUT_DIR/<name>.urdf` and `OUT_DIR/<name>.f64`: one record per state of
//! little-endian doubles, whose fields and sizes `OUT_DIR/manifest.json` lists in order.
//! `tests/oracle/test_dynamics.py` reads them.

#[path = "../tests/physics/oracle/bodies.rs"]
mod bodies;

use bodies::{
    Load, components, generator, loaded, random_body, random_loads, random_state, vector,
};
use sinew_physics::body::export::{EXPORT_GRAVITY, mjcf_with, urdf_with};
use sinew_physics::body::topology::{DOF_AXIS, DOF_NAMES, DOF_SEGMENT, JOINT, JOINT_NAMES, Joint};
use sinew_physics::body::{Body, DOF_COUNT, NV, SEGMENT_COUNT, State};
use sinew_physics::dynamics::{
    AbaWorkspace, ExternalForces, Kinematics, RneaWorkspace, Terms, aba, factor, kinetic_energy,
    momentum, rnea, solve,
};
use sinew_physics::math::Vec3;
use sinew_physics::strength::Strength;
use std::error::Error;
use std::path::Path;

/// Name and length of each part of a record, filled as the first record is written.
type Fields = Vec<(&'static str, usize)>;

struct Record<'a> {
    numbers: Vec<f64>,
    fields: Option<&'a mut Fields>,
}

impl Record<'_> {
    fn put(&mut self, name: &'static str, values: impl IntoIterator<Item = f64>) {
        let before = self.numbers.len();
        self.numbers.extend(values);
        if let Some(f) = &mut self.fields {
            f.push((name, self.numbers.len() - before));
        }
    }
}

/// Pelvis position, pelvis rotation, then a quaternion or angles per joint: the layout of `FigureFrame.positions` on
/// the wire.
fn positions(state: &State) -> Vec<f64> {
    let p = &state.posture;
    let mut out = p.root_position.to_array().to_vec();
    out.extend(p.root_rotation.to_xyzw());
    for joint in JOINT {
        match joint {
            Joint::Free => {}
            Joint::Ball(b) => out.extend(p.ball[b].to_xyzw()),
            Joint::Hinge2(h) => out.extend([p.hinge[h], p.hinge[h + 1]]),
            Joint::Hinge1(h) => out.push(p.hinge[h]),
        }
    }
    out
}

/// Largest isometric torque over the range of angles of each DOF, its negative and its positive direction, N·m: a fine
/// scan of the muscles.
fn strongest(body: &Body) -> Vec<[f64; 2]> {
    const STEPS: u32 = 20_000;
    let strength = Strength::for_body(body);
    let scan = |d: usize, side: usize| {
        let (lower, width) = (body.lower[d], body.upper[d] - body.lower[d]);
        (0..=STEPS)
            .map(|i| lower + width * f64::from(i) / f64::from(STEPS))
            .map(|angle| strength.muscles(d)[side].torque(angle, 0.0))
            .fold(0.0, f64::max)
    };
    (0..DOF_COUNT).map(|d| [-scan(d, 1), scan(d, 0)]).collect()
}

struct Model {
    name: String,
    body: Body,
    loads: Vec<Load>,
    /// Range of joint rotations, rad.
    reach: f64,
}

fn models() -> Vec<Model> {
    let mut rng = generator(20_260_101);
    let mut out = Vec::new();
    for (k, armature) in [0.0, 0.03, 0.05].into_iter().enumerate() {
        let body = random_body(&mut rng, armature);
        let loads = random_loads(&mut rng);
        out.push(Model {
            name: format!("random_{k}"),
            body: body.clone(),
            loads: Vec::new(),
            reach: 2.5,
        });
        out.push(Model {
            name: format!("random_{k}_loaded"),
            body,
            loads,
            reach: 2.5,
        });
    }
    let adults = [("man", Body::adult_man()), ("woman", Body::adult_woman())];
    for (name, body) in adults {
        let loads = random_loads(&mut rng);
        out.push(Model {
            name: name.into(),
            body: body.clone(),
            loads: Vec::new(),
            reach: 1.2,
        });
        out.push(Model {
            name: format!("{name}_loaded"),
            body,
            loads,
            reach: 1.2,
        });
    }
    out
}

fn write_model(
    dir: &Path,
    model: &Model,
    count: usize,
    seed: u64,
    fields: &mut Fields,
) -> Result<(), Box<dyn Error>> {
    let links = loaded(&model.body, &model.loads);
    let file = |extension: &str| dir.join(format!("{}.{extension}", model.name));
    let actuation = Strength::for_body(&model.body).actuation();
    let mjcf = mjcf_with(&model.body, &links, EXPORT_GRAVITY, &actuation);
    std::fs::write(file("mjcf"), mjcf)?;
    std::fs::write(file("urdf"), urdf_with(&model.body, &links, &actuation))?;
    let mut rng = generator(seed);
    let mut bytes = Vec::new();
    let mut terms = Terms::default();
    for _ in 0..count {
        let state = random_state(&mut rng, model.reach);
        let vdot = components(&mut rng, 50.0);
        terms.compute(&links, &state, &[], EXPORT_GRAVITY);
        let mut kin = Kinematics::default();
        kin.set_state(&links, &state);
        let mut tau = [0.0; NV];
        let mut work = RneaWorkspace::default();
        rnea(
            &links,
            &kin,
            &state.velocity,
            &vdot,
            ExternalForces::gravity(EXPORT_GRAVITY),
            &mut work,
            &mut tau,
        );
        // Forward dynamics of random torques, by both algorithms.
        let forces = components(&mut rng, 100.0);
        let mut by_aba = [0.0; NV];
        aba(
            &links,
            &kin,
            &state.velocity,
            &forces,
            ExternalForces::gravity(EXPORT_GRAVITY),
            &mut AbaWorkspace::default(),
            &mut by_aba,
        );
        let mut by_factor: [f64; NV] = std::array::from_fn(|i| forces[i] - terms.h[i]);
        let mut l = terms.mass_matrix.clone();
        factor(&mut l);
        solve(&l, &mut by_factor);
        let p = momentum(&links, &kin);

        let mut r = Record {
            numbers: Vec::new(),
            fields: fields.is_empty().then_some(&mut *fields),
        };
        r.put("positions", positions(&state));
        r.put("velocity", state.velocity);
        r.put("acceleration", vdot);
        r.put("torque", tau);
        r.put(
            "mass_matrix",
            terms.m.iter().flat_map(|row| row[..NV].to_vec()),
        );
        r.put("bias", terms.h);
        r.put("forces", forces);
        r.put("forward_aba", by_aba);
        r.put("forward_factor", by_factor);
        r.put("com", terms.com.to_array());
        r.put("com_velocity", terms.com_velocity.to_array());
        r.put("com_bias", terms.com_bias.to_array());
        r.put(
            "com_jacobian",
            terms.jc.iter().flat_map(|row| row[..NV].to_vec()),
        );
        r.put("kinetic_energy", [kinetic_energy(&links, &kin)]);
        r.put("linear_momentum", p.linear.to_array());
        r.put("angular_momentum", p.angular.to_array());
        let points: Vec<Vec3> = (0..SEGMENT_COUNT).map(|_| vector(&mut rng, 0.3)).collect();
        let (mut places, mut rotations, mut biases) = (Vec::new(), Vec::new(), Vec::new());
        let (mut world, mut velocity, mut bias) = (Vec::new(), Vec::new(), Vec::new());
        let (mut segment_jacobians, mut point_jacobians) = (Vec::new(), Vec::new());
        for (s, point) in points.iter().enumerate() {
            places.extend(terms.segment_position(s).to_array());
            let m = terms.segment_rotation(s);
            rotations.extend([m.x, m.y, m.z].iter().flat_map(|c| c.to_array()));
            let (alpha, a) = terms.segment_bias(s);
            biases.extend(alpha.to_array());
            biases.extend(a.to_array());
            world.extend(terms.point_world(s, *point).to_array());
            velocity.extend(terms.point_velocity(s, *point).to_array());
            bias.extend(terms.point_bias(s, *point).to_array());
            let (mut j6, mut j3) = ([[0.0; 48]; 6], [[0.0; 48]; 3]);
            terms.segment_jacobian(s, &mut j6);
            terms.point_jacobian(s, *point, &mut j3);
            segment_jacobians.extend(j6.iter().flat_map(|row| row[..NV].to_vec()));
            point_jacobians.extend(j3.iter().flat_map(|row| row[..NV].to_vec()));
        }
        r.put("segment_position", places);
        r.put("segment_rotation_columns", rotations);
        r.put("segment_bias", biases);
        r.put("segment_jacobian", segment_jacobians);
        r.put("point_local", points.iter().flat_map(|p| p.to_array()));
        r.put("point_world", world);
        r.put("point_velocity", velocity);
        r.put("point_bias", bias);
        r.put("point_jacobian", point_jacobians);
        bytes.extend(r.numbers.iter().flat_map(|x| x.to_le_bytes()));
    }
    std::fs::write(file("f64"), bytes)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let dir = arguments
        .next()
        .ok_or("usage: dump_dynamics OUT_DIR [STATES_PER_MODEL]")?;
    let count: usize = arguments.next().map_or(Ok(100), |n| n.parse())?;
    let dir = Path::new(&dir);
    std::fs::create_dir_all(dir)?;
    let mut fields = Fields::new();
    let models = models();
    for (k, model) in models.iter().enumerate() {
        write_model(dir, model, count, 77 + k as u64, &mut fields)?;
    }
    let manifest = serde_json::json!({
        "gravity": EXPORT_GRAVITY,
        "count": count,
        "fields": fields.iter().map(|(n, l)| serde_json::json!([n, l])).collect::<Vec<_>>(),
        "joint_names": JOINT_NAMES,
        "joint_kinds": JOINT.map(|j| match j {
            Joint::Free => "free",
            Joint::Ball(_) => "ball",
            Joint::Hinge2(_) => "hinge2",
            Joint::Hinge1(_) => "hinge1",
        }),
        "dof_names": DOF_NAMES.to_vec(),
        "dof_axes": DOF_AXIS.map(|a| a.vector()).to_vec(),
        "dof_segments": DOF_SEGMENT.to_vec(),
        "models": models.iter().map(|m| {
            let links = loaded(&m.body, &m.loads);
            let segment = |s: usize| serde_json::json!({
                "mass": m.body.segments[s].mass,
                "com": m.body.segments[s].com.to_array(),
                "inertia": [m.body.segments[s].inertia.xx, m.body.segments[s].inertia.yy, m.body.segments[s].inertia.zz,
                    m.body.segments[s].inertia.xy, m.body.segments[s].inertia.xz, m.body.segments[s].inertia.yz],
                "offset": m.body.joint_offset[s].to_array(),
            });
            serde_json::json!({
                "name": m.name,
                "mass": links.total_mass(),
                "armature": links.armature.to_vec(),
                "strongest": strongest(&m.body),
                "range": (0..DOF_COUNT).map(|d| [m.body.lower[d], m.body.upper[d]]).collect::<Vec<_>>(),
                "segments": (0..SEGMENT_COUNT).map(segment).collect::<Vec<_>>(),
                "loads": m
                    .loads
                    .iter()
                    .map(|(s, p, mass)| serde_json::json!([s.index(), p.to_array(), mass]))
                    .collect::<Vec<_>>(),
            })
        }).collect::<Vec<_>>(),
    });
    std::fs::write(dir.join("manifest.json"), serde_json::to_string(&manifest)?)?;
    Ok(())
}
