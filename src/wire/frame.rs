//! Frames: the part of a world that a view shows after a tick.

use super::convert::motion::follow_mode_out;
use super::pb;
use super::posture::{joint_rotation, positions, segment_poses};
use super::types::{
    FieldSet, FigureSnapshot, NumberFormat, ObstacleInfo, RosterEntry, Snapshot, ViewSpec,
};
use super::watched::WatchWorldResponse;
use prost::bytes::Bytes;
use sinew_physics::body::angles::anatomical_angles;
use sinew_physics::body::{DOF_COUNT, Posture, SEGMENT_COUNT, SegmentId};
use sinew_physics::collide::{Other, Touch};
use sinew_physics::figure::{Audit, ContactPoint, TickReport};
use sinew_physics::math::Vec3;

/// Names of the fields of a figure's frame that a view can choose, by bit of [`FieldSet`].
pub const FIELD_NAMES: [&str; 19] = [
    "root_pose",
    "joint_angles",
    "joint_rotations",
    "segment_transforms",
    "velocity",
    "acceleration",
    "torque",
    "ligament_torque",
    "torque_limits",
    "contacts",
    "balance",
    "desired",
    "status",
    "audit",
    "positions",
    "fatigue",
    "assist",
    "touches",
    "constraint_error",
];

impl FieldSet {
    /// The fields of a view without a field mask.
    pub const DEFAULT: Self = Self(1 | 1 << 1 | 1 << 6 | 1 << 12);
    /// Every field.
    pub const ALL: Self = Self((1 << FIELD_NAMES.len()) - 1);

    /// The field with this name.
    pub fn named(name: &str) -> Option<Self> {
        FIELD_NAMES
            .iter()
            .position(|n| *n == name)
            .map(|i| Self(1 << i))
    }

    fn has(self, name: &str) -> bool {
        Self::named(name).is_some_and(|f| self.0 & f.0 != 0)
    }
}

/// A number in single precision. A number beyond that range becomes the largest one, so that no infinity is sent.
fn single(value: f64) -> f32 {
    let most = f64::from(f32::MAX);
    value.clamp(-most, most) as f32
}

/// Numbers in the wanted format.
pub fn numbers(format: NumberFormat, values: &[f64]) -> Option<pb::Numbers> {
    Some(match format {
        NumberFormat::Float => pb::Numbers {
            f32: values.iter().map(|v| single(*v)).collect(),
            ..Default::default()
        },
        NumberFormat::Double => pb::Numbers {
            f64: values.to_vec(),
            ..Default::default()
        },
        NumberFormat::Fixed16 => {
            let most = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
            // The divisor is the scale as it is sent, so that rounding happens once.
            let scale = single(most / 32767.0);
            let step = f64::from(scale);
            let mut bytes = Vec::with_capacity(2 * values.len());
            for v in values {
                let n = if step > 0.0 {
                    (v / step).round().clamp(-32767.0, 32767.0) as i16
                } else {
                    0
                };
                bytes.extend_from_slice(&n.to_le_bytes());
            }
            pb::Numbers {
                i16: Bytes::from(bytes),
                scale,
                ..Default::default()
            }
        }
    })
}

/// Numbers that are places in the world. A fixed-point step would grow with the distance from the origin, so crowds get
/// floats.
fn places(format: NumberFormat, values: &[f64]) -> Option<pb::Numbers> {
    numbers(
        match format {
            NumberFormat::Fixed16 => NumberFormat::Float,
            other => other,
        },
        values,
    )
}

fn flat(points: impl Iterator<Item = Vec3>) -> Vec<f64> {
    points.flat_map(Vec3::to_array).collect()
}

fn contacts(format: NumberFormat, points: &[ContactPoint]) -> pb::Contacts {
    pb::Contacts {
        segment: points.iter().map(|c| c.segment.index() as i32).collect(),
        vertex: points.iter().map(|c| c.vertex as i32).collect(),
        position: places(format, &flat(points.iter().map(|c| c.position))),
        force: numbers(format, &flat(points.iter().map(|c| c.force))),
    }
}

fn touches(format: NumberFormat, list: &[Touch], others: &[String]) -> pb::Touches {
    pb::Touches {
        segment: list.iter().map(|t| t.segment.index() as i32).collect(),
        other: others.to_vec(),
        other_segment: list
            .iter()
            .map(|t| match t.other {
                Other::Figure(_, s) => s.index() as i32,
                Other::Obstacle(_) => -1,
            })
            .collect(),
        position: places(format, &flat(list.iter().map(|t| t.position))),
        force: numbers(format, &flat(list.iter().map(|t| t.force))),
        depth: numbers(format, &list.iter().map(|t| t.depth).collect::<Vec<_>>()),
    }
}

fn obstacle_frame(o: &ObstacleInfo, format: NumberFormat) -> pb::ObstacleFrame {
    let s = &o.setup;
    let (p, q) = (s.position, s.rotation);
    let (w, v) = (s.angular_velocity, s.velocity);
    pb::ObstacleFrame {
        obstacle_id: o.id.clone(),
        pose: places(format, &[p.x, p.y, p.z, q.x, q.y, q.z, q.w]),
        velocity: numbers(format, &[w.x, w.y, w.z, v.x, v.y, v.z]),
        force: numbers(format, &o.force.to_array()),
    }
}

fn root_pose(p: &Posture) -> [f64; 7] {
    let (x, q) = (p.root_position, p.root_rotation);
    [x.x, x.y, x.z, q.x, q.y, q.z, q.w]
}

fn joint_rotations(p: &Posture) -> Vec<f64> {
    (1..SEGMENT_COUNT)
        .flat_map(|s| joint_rotation(p, s).to_xyzw())
        .collect()
}

/// Loads in the form of the wire.
pub fn loads(list: &[(SegmentId, Vec3, f64)]) -> Vec<pb::CarriedLoad> {
    list.iter()
        .map(|(s, p, m)| pb::CarriedLoad {
            segment: s.index() as i32,
            point_m: Some(super::convert::vector_out(*p)),
            mass_kg: *m,
        })
        .collect()
}

fn balance(format: NumberFormat, r: &TickReport) -> pb::Balance {
    pb::Balance {
        com: places(format, &r.balance.com.to_array()),
        com_velocity: numbers(format, &r.balance.com_velocity.to_array()),
        com_desired: places(format, &r.balance.com_desired.to_array()),
        zmp: r.balance.zmp.and_then(|z| places(format, &z.to_array())),
        margin_m: r.balance.margin,
        polygon: places(format, r.balance.support_polygon.as_flattened()),
        main_support: r.balance.main_support.map_or(-1, |s| s.index() as i32),
        support_ratio: numbers(format, &r.balance.support_ratio),
    }
}

fn status(r: &TickReport, f: &FigureSnapshot) -> pb::Status {
    let follows = &f.follows.so_far;
    let square: f64 = r.joints.joint_error.iter().map(|e| e * e).sum();
    pb::Status {
        flags: r.flags.0 as i32,
        saturated: r.joints.saturated as i64,
        saturated_secondary: r.joints.saturated_secondary as i64,
        over_limit: r.joints.over_limit,
        tracking_joint_rms_rad: (square / DOF_COUNT as f64).sqrt(),
        penetration_m: r.penetration,
        control_iterations: r.control_iterations as i32,
        step_iterations: r.step_iterations as i32,
        loads: loads(&f.loads),
        following: follow_mode_out(follows.mode).into(),
        help_newton_seconds: follows.impulse,
        help_ratio: follows.help_share(),
        help_newton_metre_seconds: follows.turning_impulse,
    }
}

fn audit(
    format: NumberFormat,
    a: &Audit,
    carried: &[(SegmentId, Vec3, f64)],
    gravity: f64,
) -> pb::Audit {
    pb::Audit {
        positions: places(format, &positions(&a.state.posture)),
        velocity: numbers(format, &a.state.velocity),
        acceleration: numbers(format, &a.acceleration),
        torque: numbers(format, &a.torque),
        ligament_torque: numbers(format, &a.ligament_torque),
        contacts: Some(contacts(format, &a.contacts)),
        applied: Some(pb::AppliedForces {
            segment: a.applied.iter().map(|f| f.0.index() as i32).collect(),
            position: places(format, &flat(a.applied.iter().map(|f| f.1))),
            force: numbers(format, &flat(a.applied.iter().map(|f| f.2))),
        }),
        loads: loads(carried),
        gravity_mps2: gravity,
        assist: (a.assist != [0.0; 6])
            .then(|| numbers(format, &a.assist))
            .flatten(),
    }
}

/// One figure as a view shows it.
pub fn figure_frame(
    index: i32,
    f: &FigureSnapshot,
    gravity: f64,
    fields: FieldSet,
    format: NumberFormat,
) -> pb::FigureFrame {
    let posture = &f.state.posture;
    let mut out = pb::FigureFrame {
        figure_index: index,
        applied_sequence: f.applied_sequence,
        applied_source_time_ns: f.applied_source_ns,
        ..Default::default()
    };
    if fields.has("root_pose") {
        out.root_pose = places(format, &root_pose(posture));
    }
    if fields.has("joint_angles") {
        out.joint_angles = numbers(format, &anatomical_angles(posture));
    }
    if fields.has("joint_rotations") {
        out.joint_rotations = numbers(format, &joint_rotations(posture));
    }
    if fields.has("segment_transforms") {
        let poses = segment_poses(&f.body, posture);
        let values: Vec<f64> = poses
            .iter()
            .flat_map(|(p, q)| [p.x, p.y, p.z, q.x, q.y, q.z, q.w])
            .collect();
        out.segment_transforms = places(format, &values);
    }
    if fields.has("velocity") {
        out.velocity = numbers(format, &f.state.velocity);
    }
    if fields.has("positions") {
        out.positions = places(format, &positions(posture));
    }
    if fields.has("desired") {
        let p = &f.desired.posture;
        out.desired = Some(pb::DesiredPosture {
            root_pose: places(format, &root_pose(p)),
            joint_angles: numbers(format, &anatomical_angles(p)),
            joint_rotations: numbers(format, &joint_rotations(p)),
        });
    }
    let Some(r) = &f.report else { return out }; // nothing was computed before the first tick
    if fields.has("acceleration") {
        out.acceleration = numbers(format, &r.acceleration);
    }
    if fields.has("torque") {
        out.torque = numbers(format, &r.joints.torque);
    }
    if fields.has("ligament_torque") {
        out.ligament_torque = numbers(format, &r.joints.ligament_torque);
    }
    if fields.has("torque_limits") {
        out.torque_limits = numbers(
            format,
            &[r.joints.torque_lower, r.joints.torque_upper].concat(),
        );
    }
    if fields.has("contacts") {
        out.contacts = Some(contacts(format, &r.contacts));
    }
    if fields.has("balance") {
        out.balance = Some(balance(format, r));
    }
    if fields.has("status") {
        out.status = Some(status(r, f));
    }
    if fields.has("fatigue") {
        let side = |k: usize| r.joints.remaining.iter().map(move |left| left[k]);
        let values: Vec<f64> = side(0).chain(side(1)).collect();
        out.fatigue = numbers(format, &values);
    }
    if fields.has("assist") {
        out.assist = numbers(format, &r.assist);
    }
    if fields.has("constraint_error") {
        out.constraint_error = numbers(format, r.constraint_error.as_flattened());
    }
    if fields.has("touches") {
        out.touches = Some(touches(format, &r.touches, &f.touched));
    }
    if fields.has("audit") {
        out.audit = Some(audit(format, &r.audit, &f.loads, gravity));
    }
    out
}

fn shown(view: &ViewSpec, entry: &RosterEntry) -> bool {
    view.figures.is_empty() || view.figures.binary_search(&entry.figure).is_ok()
}

/// A world as a view shows it.
pub fn world_frame(snapshot: &Snapshot, view: &ViewSpec) -> pb::WorldFrame {
    pb::WorldFrame {
        tick: snapshot.tick as i64,
        time_s: snapshot.time,
        state_hash: snapshot.hash as i64,
        epoch: snapshot.epoch,
        server_time_ns: snapshot.server_ns,
        roster_version: snapshot.roster_version,
        figures: snapshot
            .roster
            .iter()
            .zip(&snapshot.figures)
            .filter(|(entry, _)| shown(view, entry))
            .map(|(entry, f)| {
                figure_frame(entry.index, f, snapshot.gravity, view.fields, view.format)
            })
            .collect(),
        obstacles: snapshot
            .obstacles
            .iter()
            .map(|o| obstacle_frame(o, view.format))
            .collect(),
    }
}

/// The names of the figures in the frames of a view.
pub fn roster(snapshot: &Snapshot, view: &ViewSpec) -> pb::Roster {
    pb::Roster {
        world: format!("worlds/{}", snapshot.world),
        rate_hz: snapshot.rate_hz,
        version: snapshot.roster_version,
        figures: snapshot
            .roster
            .iter()
            .filter(|entry| shown(view, entry))
            .map(|entry| pb::RosterEntry {
                figure_index: entry.index,
                figure_id: entry.figure.clone(),
                body: format!("bodies/{}", entry.body),
            })
            .collect(),
    }
}

/// The frame of a view as a message of a watch, encoded once for all viewers of the view.
pub fn shared_frame(snapshot: &Snapshot, view: &ViewSpec) -> Bytes {
    WatchWorldResponse::Frame(Box::new(world_frame(snapshot, view))).share()
}

/// The roster of a view as a message of a watch.
pub fn shared_roster(snapshot: &Snapshot, view: &ViewSpec) -> Bytes {
    WatchWorldResponse::Roster(Box::new(roster(snapshot, view))).share()
}

/// The numbers themselves, whatever the format; for clients.
pub fn values(n: &pb::Numbers) -> Vec<f64> {
    if !n.f64.is_empty() {
        n.f64.clone()
    } else if !n.f32.is_empty() {
        n.f32.iter().map(|v| f64::from(*v)).collect()
    } else {
        n.i16
            .chunks_exact(2)
            .map(|b| f64::from(i16::from_le_bytes([b[0], b[1]])) * f64::from(n.scale))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn field_names_are_those_of_the_message() {
        use prost::Message as _;
        let set = prost_types::FileDescriptorSet::decode(super::super::DESCRIPTOR_SET).unwrap();
        let message = set
            .file
            .iter()
            .flat_map(|f| &f.message_type)
            .find(|m| m.name() == "FigureFrame")
            .unwrap();
        let mut names: Vec<&str> = message.field.iter().map(|f| f.name()).skip(3).collect();
        let mut ours = FIELD_NAMES.to_vec();
        names.sort_unstable();
        ours.sort_unstable();
        assert_eq!(names, ours);
    }

    #[test]
    fn formats_round_trip_within_their_precision() {
        let x = [0.1, -2.5, 3.0, 0.0];
        assert_eq!(values(&numbers(NumberFormat::Double, &x).unwrap()), x);
        for (format, tolerance) in [
            (NumberFormat::Float, 2e-7),
            (NumberFormat::Fixed16, 3.0 / 32767.0 * 0.51),
        ] {
            let back = values(&numbers(format, &x).unwrap());
            for (a, b) in x.iter().zip(back) {
                assert!((a - b).abs() <= tolerance, "{a} {b}");
            }
        }
        assert_eq!(
            values(&numbers(NumberFormat::Fixed16, &[0.0; 3]).unwrap()),
            [0.0; 3]
        );
    }
}
