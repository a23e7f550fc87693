//! `sinew watch`: prints the frames of a world.

use super::args::CredentialArgs;
use super::exit::{UsageError, within};
use super::remote::{explain, world_resource};
use super::terminal::print_line;
use sinew_wire::frame::values;
use sinew_wire::pb;
use sinew_wire::watched::WatchWorldResponse;

/// Arguments of `sinew watch`.
#[derive(Clone, Debug, clap::Args)]
pub struct WatchArgs {
    /// Server, host:port
    address: String,
    /// World, for example `demo`
    world: String,
    /// Print one JSON object per frame
    #[arg(long)]
    json: bool,
    /// Fields of a figure frame, for example root_pose,torque; `*`: all
    #[arg(long, value_delimiter = ',', value_name = "FIELD,…")]
    fields: Vec<String>,
    /// Figures to show (repeatable) [default: all]
    #[arg(long = "figure", value_name = "NAME")]
    figures: Vec<String>,
    /// Ask for double precision
    #[arg(long)]
    double: bool,
    /// Print one frame every N ticks, 1 to 1000
    #[arg(long, default_value_t = 1, value_name = "N")]
    every: i32,
    /// End after N frames
    #[arg(long, value_name = "N")]
    count: Option<u64>,
    #[command(flatten)]
    credentials: CredentialArgs,
}

/// Largest number of ticks from one frame to the next.
const MOST_EVERY: f64 = 1000.0;

/// Checks the conditions that clap cannot.
fn check(args: &WatchArgs) -> anyhow::Result<()> {
    within("--every", f64::from(args.every), [1.0, MOST_EVERY])?;
    match args.count {
        Some(0) => Err(UsageError("--count 0: must be at least 1".to_owned()).into()),
        _ => Ok(()),
    }
}

/// Prints until the stream ends.
///
/// # Errors
/// No server, no such world, or the stream breaks.
pub fn run(args: &WatchArgs) -> anyhow::Result<()> {
    check(args)?;
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(watch(args))
}

async fn watch(args: &WatchArgs) -> anyhow::Result<()> {
    let client = args.credentials.connect(&args.address).await?;
    let fields = if args.fields.is_empty() {
        vec![
            "root_pose".into(),
            "joint_angles".into(),
            "torque".into(),
            "status".into(),
        ]
    } else {
        args.fields.clone()
    };
    let view = pb::View {
        figure_ids: args.figures.clone(),
        fields: Some(prost_types::FieldMask { paths: fields }),
        encoding: if args.double {
            pb::Encoding::Double
        } else {
            pb::Encoding::Float
        }
        .into(),
        rate_divisor: args.every,
    };
    let mut stream = client
        .watch(&world_resource(&args.world), view, None)
        .await
        .map_err(|e| explain(&e))?;
    let mut names = std::collections::BTreeMap::new();
    let mut seen = 0u64;
    while let Some(message) = stream.message().await.map_err(|e| explain(&e))? {
        match message {
            WatchWorldResponse::Roster(r) => {
                names = r
                    .figures
                    .into_iter()
                    .map(|f| (f.figure_index, f.figure_id))
                    .collect();
            }
            WatchWorldResponse::Frame(frame) => {
                let text = if args.json {
                    json(&frame, &names).to_string()
                } else {
                    line(&frame, &names)
                };
                print_line(&text)?;
                seen += 1;
                if args.count.is_some_and(|n| seen >= n) {
                    return Ok(());
                }
            }
            _ => {}
        }
    }
    Ok(())
}

type FigureNames = std::collections::BTreeMap<i32, String>;

fn name<'a>(names: &'a FigureNames, f: &pb::FigureFrame) -> &'a str {
    names.get(&f.figure_index).map_or("?", String::as_str)
}

fn line(frame: &pb::WorldFrame, names: &FigureNames) -> String {
    use std::fmt::Write as _;
    let mut out = format!("tick {:<7} {:8.3} s", frame.tick, frame.time_s);
    for f in &frame.figures {
        let _ = write!(out, "  {}", name(names, f));
        if let Some(p) = f.root_pose.as_ref().map(values).filter(|p| p.len() == 7) {
            let _ = write!(out, ": root at {:.2}, {:.2}, {:.2} m", p[0], p[1], p[2]);
        }
        if let Some(t) = f.torque.as_ref().map(values) {
            let most = t.iter().fold(0.0f64, |m, t| m.max(t.abs()));
            let _ = write!(out, ", largest torque {most:.0} N·m");
        }
        if let Some(s) = &f.status {
            let _ = write!(
                out,
                ", tracking error {:.2}° rms",
                s.tracking_joint_rms_rad.to_degrees()
            );
            for (bit, flag) in sinew_physics::figure::Flags::NAMES.iter().enumerate() {
                if s.flags >> bit & 1 == 1 {
                    let _ = write!(out, " {flag}");
                }
            }
        }
    }
    out
}

fn json(frame: &pb::WorldFrame, names: &FigureNames) -> serde_json::Value {
    use serde_json::{Map, Value, json};
    let figures: Vec<Value> = frame
        .figures
        .iter()
        .map(|f| {
            let mut out = Map::new();
            out.insert("figure".into(), json!(name(names, f)));
            let mut numbers = |key: &str, n: &Option<pb::Numbers>| {
                if let Some(n) = n {
                    out.insert(key.into(), json!(values(n)));
                }
            };
            numbers("root_pose", &f.root_pose);
            numbers("joint_angles", &f.joint_angles);
            numbers("joint_rotations", &f.joint_rotations);
            numbers("segment_transforms", &f.segment_transforms);
            numbers("velocity", &f.velocity);
            numbers("acceleration", &f.acceleration);
            numbers("torque", &f.torque);
            numbers("ligament_torque", &f.ligament_torque);
            numbers("torque_limits", &f.torque_limits);
            numbers("positions", &f.positions);
            if let Some(c) = &f.contacts {
                out.insert("contacts".into(), contacts(c));
            }
            if let Some(b) = &f.balance {
                let list = |n: &Option<pb::Numbers>| n.as_ref().map(values);
                out.insert(
                    "balance".into(),
                    json!({
                        "com": list(&b.com), "com_velocity": list(&b.com_velocity), "com_desired": list(&b.com_desired),
                        "zmp": list(&b.zmp), "margin_m": b.margin_m, "polygon": list(&b.polygon),
                        "main_support": b.main_support, "support_ratio": list(&b.support_ratio),
                    }),
                );
            }
            if let Some(d) = &f.desired {
                let list = |n: &Option<pb::Numbers>| n.as_ref().map(values);
                out.insert(
                    "desired".into(),
                    json!({
                        "root_pose": list(&d.root_pose), "joint_angles": list(&d.joint_angles),
                        "joint_rotations": list(&d.joint_rotations),
                    }),
                );
            }
            if let Some(s) = &f.status {
                out.insert(
                    "status".into(),
                    json!({
                        "flags": s.flags, "saturated": s.saturated, "over_limit": s.over_limit,
                        "tracking_joint_rms_rad": s.tracking_joint_rms_rad, "penetration_m": s.penetration_m,
                        "control_iterations": s.control_iterations, "step_iterations": s.step_iterations,
                    }),
                );
            }
            if let Some(a) = &f.audit {
                let list = |n: &Option<pb::Numbers>| n.as_ref().map(values);
                out.insert(
                    "audit".into(),
                    json!({
                        "positions": list(&a.positions), "velocity": list(&a.velocity),
                        "acceleration": list(&a.acceleration), "torque": list(&a.torque),
                        "ligament_torque": list(&a.ligament_torque),
                        "contacts": a.contacts.as_ref().map(contacts),
                        "applied": a.applied.as_ref().map(|p| json!({
                            "segment": p.segment, "position": list(&p.position), "force": list(&p.force),
                        })),
                        "gravity_mps2": a.gravity_mps2,
                    }),
                );
            }
            out.insert("applied_sequence".into(), json!(f.applied_sequence));
            Value::Object(out)
        })
        .collect();
    json!({
        "tick": frame.tick, "time_s": frame.time_s, "state_hash": format!("{:016x}", frame.state_hash),
        "server_time_ns": frame.server_time_ns, "figures": figures,
    })
}

fn contacts(c: &pb::Contacts) -> serde_json::Value {
    serde_json::json!({
        "segment": c.segment, "vertex": c.vertex,
        "position": c.position.as_ref().map(values), "force": c.force.as_ref().map(values),
    })
}
