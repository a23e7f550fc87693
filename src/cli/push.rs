//! `sinew push`: streams a motion capture file to a server as live motion for a figure.

use super::args::{BodyNameParser, CredentialArgs, FileArgs, LiveHelpArgs, UpArg};
use super::exit::{UsageError, within};
use super::number::{counted, hertz};
use super::remote::{explain, world_resource};
use super::source::{BUILTIN, recording};
use super::terminal::{note, print_line};
use anyhow::Context as _;
use sinew_client::Network;
use sinew_client::{Client, LiveDriver};
use sinew_physics::body::names::DEFAULT_BODY;
use sinew_physics::body::{Body, Profile};
use sinew_physics::math::Quat;
use sinew_physics::motion::{Clip, PlanarTransform, Recording};
use sinew_physics::plan::stream::WINDOW;
use sinew_physics::plan::{cycle, prepare_recording};
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_server::engine;
use sinew_wire::convert::{self, motion::figure_motion};
use sinew_wire::frame::values;
use sinew_wire::pb;
use sinew_wire::types::{BvhReading, Place};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tonic::Code;

/// Arguments of `sinew push`.
#[derive(Clone, Debug, clap::Args)]
pub struct PushArgs {
    /// Server, host:port
    address: String,
    #[command(flatten)]
    credentials: CredentialArgs,
    /// BVH file
    clip: PathBuf,
    /// World; created with default settings if it does not exist
    #[arg(long, default_value = "demo")]
    world: String,
    /// Figure; created at the start of the motion if it does not exist
    #[arg(long, default_value = "push")]
    figure: String,
    /// Body of the figure if it is created: one of these, or a profile such as female-25y-1680mm-61500g
    #[arg(long, value_name = "NAME", default_value = DEFAULT_BODY, value_parser = BodyNameParser)]
    body: Profile,
    /// Help while the motion is being lost, of the figure if it is created
    #[command(flatten)]
    help: LiveHelpArgs,
    /// Repeat until interrupted
    #[arg(long = "loop")]
    looped: bool,
    /// Fixed playout delay between arrival and use, ms [default: adapted to the jitter of the network]
    #[arg(long, value_name = "MS")]
    playout_delay_ms: Option<f64>,
    /// Window in which the server prepares the motion, ms: 300 to 1000; 0: frames are used unprepared
    #[arg(long, value_name = "MS", default_value_t = 1000.0)]
    window_ms: f64,
    /// Send the recording as a capture system would: only fitted to the body, prepared by the window of the server
    #[arg(long)]
    raw: bool,
    /// Stop after this time, s [default: duration of the motion]
    #[arg(long, value_name = "S")]
    duration: Option<f64>,
    /// Delay each frame by a random time of up to this, ms, keeping the order
    #[arg(long, value_name = "MS", default_value_t = 0.0)]
    jitter_ms: f64,
    /// Drop this fraction of the frames at random, 0 to 0.9
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    loss: f64,
    /// Seed of jitter and loss
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Unit and axes of the file
    #[command(flatten)]
    file: FileArgs,
    /// Keep recorded runs. Otherwise, without help, runs are turned into walks, slower and with shorter steps, which
    /// measured strength can do
    #[arg(long, conflicts_with = "raw")]
    keep_runs: bool,
}

/// Streams the file at its own rate.
///
/// # Errors
/// The file is bad, no server answers, or another driver has the figure.
pub fn run(args: &PushArgs) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(push(args))
}

/// Checks the conditions that clap cannot.
fn check(args: &PushArgs) -> anyhow::Result<()> {
    for (name, value, high) in [
        ("--loss", args.loss, 0.9),
        ("--jitter-ms", args.jitter_ms, 2000.0),
        (
            "--playout-delay-ms",
            args.playout_delay_ms.unwrap_or(0.0),
            2000.0,
        ),
        ("--max-help", args.help.most(), 2.0),
    ] {
        within(name, value, [0.0, high])?;
    }
    let (window, least, most) = (args.window_ms, 1e3 * WINDOW.0, 1e3 * WINDOW.1);
    if window != 0.0 && !(least..=most).contains(&window) {
        let text = format!("--window-ms {window}: must be 0 or within {least}…{most}");
        return Err(UsageError(text).into());
    }
    let clip = args.clip.to_string_lossy();
    if let Some(name) = clip.strip_prefix(BUILTIN) {
        let text = format!(
            "push takes BVH files, not {clip}: `sinew convert {clip} {name}.bvh` writes one"
        );
        return Err(UsageError(text).into());
    }
    if args.clip.is_dir() {
        return Err(UsageError(format!("{clip} is a folder; name one of its files")).into());
    }
    match args.duration {
        Some(d) if !(d > 0.0 && d.is_finite()) => {
            Err(UsageError(format!("--duration {d} s: must be positive")).into())
        }
        _ => Ok(()),
    }
}

async fn push(args: &PushArgs) -> anyhow::Result<()> {
    let path = args.clip.display();
    check(args)?;
    let bytes = std::fs::read(&args.clip).with_context(|| format!("cannot read {path}"))?;
    let recording = recording(&path.to_string(), &bytes)?;
    let client = args.credentials.connect(&args.address).await?;
    let world = world_resource(&args.world);
    client.world(&world).await.map_err(|e| explain(&e))?;

    // The body of the figure decides how the motion is retargeted.
    let name = format!("{world}/figures/{}", args.figure);
    let existing = client
        .figures()
        .get_figure(pb::GetFigureRequest { name: name.clone() })
        .await;
    let existing = match existing {
        Ok(r) => r.into_inner().figure,
        Err(e) if e.code() == Code::NotFound => None,
        Err(e) => return Err(explain(&e)),
    };
    let created_body = format!("bodies/{}", args.body.name());
    let body_name = existing.as_ref().map_or(&created_body, |f| &f.body);
    let reference = convert::body::by_name("body", body_name)?;
    let body = engine::build_body(reference.profile)?;
    let clip = prepared(args, &recording, &body)?;
    // Starts from a stand, with the steps that lead into the motion.
    let lead = clip.lead_in();
    let start = engine::place_of(&clip.sample(-lead).posture);
    let created = existing.is_none();
    let place = if created {
        client
            .figures()
            .create_figure(pb::CreateFigureRequest {
                parent: world.clone(),
                figure_id: args.figure.clone(),
                figure: Some(pb::Figure {
                    body: body_name.clone(),
                    placement: Some(convert::place_out(start)),
                    follow: convert::motion::follow_out(args.help.settings().follow).into(),
                    max_help_weights: Some(args.help.most()),
                    ..Default::default()
                }),
                ..Default::default()
            })
            .await
            .map_err(|e| explain(&e))?;
        start
    } else {
        current_place(&client, &world, &args.figure).await?
    };
    let driver = client
        .drive(pb::DriveHeader {
            world: world.clone(),
            figure_ids: vec![args.figure.clone()],
            driver_id: format!("push-{}", std::process::id()),
            nominal_rate_hz: clip.rate_hz(),
            playout_delay_ms: args.playout_delay_ms,
            reset: created,
            preparation_window_ms: Some(args.window_ms),
            ..Default::default()
        })
        .await
        .map_err(|e| explain(&e))?;
    print_line(&format!(
        "streaming {path} ({} at {}, {:.1} s) to {name}",
        counted(clip.len(), "frame"),
        hertz(clip.rate_hz()),
        clip.duration()
    ))?;
    let most = existing.map_or(args.help.most(), |f| f.max_help_weights.unwrap_or(0.0));
    print_line(&if most > 0.0 {
        let percent = 100.0 * most;
        format!(
            "where strength is not enough, it is helped by at most {percent:.0} % of its weight"
        )
    } else {
        "it follows by its own strength; --follow assisted helps a new figure where that is not enough".to_owned()
    })?;
    stream(args, &clip, &engine::placing(start, place), driver).await
}

/// The recording fitted to the body; its warnings are printed.
fn prepared(args: &PushArgs, recording: &Recording, body: &Body) -> anyhow::Result<Clip> {
    let path = args.clip.display();
    let (clip, warnings) = if args.raw {
        let options = args.file.apply(RetargetOptions {
            preparation: Preparation::NONE,
            ..Default::default()
        });
        let fitted = prepare_recording(recording, body, &options)
            .map_err(|e| anyhow::anyhow!("{path}: {e}"))?;
        (fitted.clip, fitted.report.warnings)
    } else {
        let reading = BvhReading {
            unit_m: args.file.unit,
            z_up: args.file.up.map(|up| up == UpArg::Z),
            walk_runs: Some(!args.keep_runs && args.help.most() == 0.0),
            ..Default::default()
        };
        let fitted = engine::retarget(&args.figure, recording, &reading, body, 1.0, &|| false)
            .map_err(|e| anyhow::anyhow!("{path}: {e}"))?;
        (fitted.clip, fitted.report.warnings)
    };
    for warning in &warnings {
        note(&format!("warning: {path}: {warning}"));
    }
    let repeats = (args.looped && !args.raw).then(|| cycle(body, &clip));
    Ok(repeats.flatten().unwrap_or(clip))
}

/// Sends the clip at its own pace and prints once a second how it arrives.
async fn stream(
    args: &PushArgs,
    clip: &Clip,
    placing: &PlanarTransform,
    mut driver: LiveDriver,
) -> anyhow::Result<()> {
    let lead = clip.lead_in();
    let length = clip.duration() + clip.lead_out() + lead;
    let length = match (args.duration, args.looped) {
        (Some(d), true) => d,
        (Some(d), false) => d.min(length),
        (None, true) => f64::INFINITY,
        (None, false) => length,
    };
    let began = Instant::now();
    let mut network = Network::new(args.jitter_ms / 1e3, args.loss, args.seed);
    let mut sequence = 0i64;
    let mut told = Instant::now();
    let mut last: Option<pb::DriveFeedback> = None;
    let mut delay = FrameDelay::default();
    loop {
        let t = sequence as f64 / clip.rate_hz();
        if t > length {
            break;
        }
        let target = if args.looped {
            clip.sample_looped(t - lead)
        } else {
            clip.sample(t - lead)
        };
        let target = placing.apply(&target);
        let frame = pb::MotionFrame {
            sequence,
            source_time_ns: (t * 1e9).round() as i64,
            figures: vec![figure_motion(
                &args.figure,
                &target.posture,
                &target.velocity,
                (!args.raw).then_some(target.planted),
            )],
        };
        sequence += 1;
        if let Some(at) = network.arrival(t) {
            tokio::time::sleep_until((began + Duration::from_secs_f64(at)).into()).await;
            if !driver.send(vec![frame]).await {
                break; // the reason is reported below
            }
        }
        // Feedback is read when available; the motion does not wait for it.
        while let Some(ready) = futures_util::FutureExt::now_or_never(driver.feedback()) {
            match ready.map_err(|e| explain(&e))? {
                Some(f) => {
                    delay.note(&f, began.elapsed().as_secs_f64(), clip.rate_hz());
                    last = Some(f);
                }
                None => anyhow::bail!("the server ended the stream"),
            }
        }
        if told.elapsed() > Duration::from_secs(1) {
            told = Instant::now();
            if let Some(f) = &last {
                print_line(&format!("{t:6.1} s  {}", describe(f)))?;
            }
        }
    }
    if let Some(f) = driver.finish().await.map_err(|e| explain(&e))? {
        print_line(&format!("done      {}", describe(&f)))?;
    }
    if delay.count > 0 {
        print_line(&format!(
            "latency from capture to the figure: {:.0} ms mean, {:.0} ms max",
            1e3 * delay.sum / delay.count as f64,
            1e3 * delay.most
        ))?;
    }
    Ok(())
}

/// Time from a frame's capture to its use, as feedback shows it (so it includes the way back).
#[derive(Clone, Copy, Debug, Default)]
struct FrameDelay {
    sum: f64,
    count: u32,
    most: f64,
}

impl FrameDelay {
    fn note(&mut self, f: &pb::DriveFeedback, now: f64, rate_hz: f64) {
        let Some(g) = f.figures.first().filter(|g| g.applied_sequence > 0) else {
            return;
        };
        let age = now - g.applied_sequence as f64 / rate_hz;
        self.sum += age;
        self.count += 1;
        self.most = self.most.max(age);
    }
}

async fn current_place(client: &Client, world: &str, figure: &str) -> anyhow::Result<Place> {
    let response = client
        .states()
        .get_world_frame(pb::GetWorldFrameRequest {
            world: world.into(),
            tick: None,
            view: Some(pb::View {
                figure_ids: vec![figure.into()],
                fields: Some(prost_types::FieldMask {
                    paths: vec!["root_pose".into()],
                }),
                encoding: pb::Encoding::Double.into(),
                ..Default::default()
            }),
        })
        .await
        .map_err(|e| explain(&e))?
        .into_inner();
    let pose = response
        .frame
        .and_then(|f| f.figures.into_iter().next())
        .and_then(|f| f.root_pose)
        .map(|n| values(&n))
        .filter(|p| p.len() == 7)
        .context("the server sent no root pose")?;
    Ok(Place {
        x: pose[0],
        y: pose[1],
        yaw: Quat::from_xyzw([pose[3], pose[4], pose[5], pose[6]]).heading(),
    })
}

fn describe(f: &pb::DriveFeedback) -> String {
    let Some(g) = f.figures.first() else {
        return String::new();
    };
    let used = g.present_count + g.interpolated_count;
    format!(
        "playout delay {:.0} ms (window {:.0} ms), jitter {:.0} ms; ticks: {used} with motion, {} extrapolated, {} \
         held; {}",
        g.playout_delay_ms,
        g.preparation_window_ms,
        g.jitter_ms,
        g.extrapolated_count,
        g.held_count,
        counted(g.late_count, "late frame")
    )
}
