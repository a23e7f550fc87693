//! `sinew push`: streams a motion capture file to a server as the live driver of a figure.

use super::{explain, world_resource};
use crate::client::Client;
use crate::server::engine;
use crate::sim::motion::{Bvh, cycle};
use crate::wire::convert::{self, motion::figure_motion};
use crate::wire::frame::values;
use crate::wire::pb;
use crate::wire::types::{BvhReading, Place};
use anyhow::Context as _;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tonic::Code;

/// Arguments of `sinew push`.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Server, host:port
    address: String,
    /// BVH file
    clip: PathBuf,
    /// World; created if there is none
    #[arg(long, default_value = "demo")]
    world: String,
    /// Figure; created where the motion begins if there is none
    #[arg(long, default_value = "push")]
    figure: String,
    /// Body of a figure that is created
    #[arg(long, default_value = "bodies/adult-man")]
    body: String,
    /// Repeat until interrupted
    #[arg(long = "loop")]
    looped: bool,
    /// Fixed delay between arrival and use, ms [default: as the network needs]
    #[arg(long, value_name = "MS")]
    playout_delay_ms: Option<f64>,
    /// Length of one file unit, m [default: guessed from the stature]
    #[arg(long, value_name = "M")]
    unit: Option<f64>,
}

/// Streams the file at its own rate.
///
/// # Errors
/// The file is bad, no server answers, or someone else drives the figure.
pub fn run(args: &Args) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(push(args))
}

async fn push(args: &Args) -> anyhow::Result<()> {
    let path = args.clip.display();
    let bytes = std::fs::read(&args.clip).with_context(|| format!("{path}"))?;
    let bvh = Bvh::parse(&bytes).with_context(|| format!("{path}"))?;
    let client = Client::connect(&args.address).await?;
    let world = world_resource(&args.world);
    client.world(&world).await.map_err(|e| explain(&e))?;

    // Which body the figure has decides how the motion is retargeted.
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
    let body_name = existing.as_ref().map_or(&args.body, |f| &f.body);
    let reference = convert::body::by_name("body", body_name)?;
    let body = engine::build_body(reference.profile)?;
    let reading = BvhReading {
        unit_m: args.unit,
        ..Default::default()
    };
    let (clip, report) = engine::retarget(&args.figure, &bvh, &reading, &body)
        .map_err(|e| anyhow::anyhow!("{path}: {e}"))?;
    for warning in &report.warnings {
        eprintln!("{path}: {warning}");
    }
    let clip = match args.looped.then(|| cycle(&body, &clip)).flatten() {
        Some(repeats) => repeats,
        None => clip,
    };
    let start = engine::place_of(clip.posture(0));
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
                    ..Default::default()
                }),
            })
            .await
            .map_err(|e| explain(&e))?;
        start
    } else {
        current_place(&client, &world, &args.figure).await?
    };
    let mut driver = client
        .drive(pb::DriveHeader {
            world: world.clone(),
            figures: vec![args.figure.clone()],
            driver_id: format!("push-{}", std::process::id()),
            nominal_rate_hz: clip.rate_hz(),
            playout_delay_ms: args.playout_delay_ms,
            reset: created,
            ..Default::default()
        })
        .await
        .map_err(|e| explain(&e))?;
    println!(
        "pushing {path} ({} frames at {:.0} Hz, {:.1} s) to {name}",
        clip.len(),
        clip.rate_hz(),
        clip.duration()
    );

    let placing = engine::placing(start, place);
    let began = Instant::now();
    let mut sequence = 0i64;
    let mut told = Instant::now();
    let mut last: Option<pb::DriveFeedback> = None;
    loop {
        let t = sequence as f64 / clip.rate_hz();
        if !args.looped && t > clip.duration() {
            break;
        }
        let target = if args.looped {
            clip.sample_looped(t)
        } else {
            clip.sample(t)
        };
        let target = placing.apply(&target);
        let due = began + Duration::from_secs_f64(t);
        tokio::time::sleep_until(due.into()).await;
        let frame = pb::MotionFrame {
            sequence,
            source_time_ns: (t * 1e9).round() as i64,
            figures: vec![figure_motion(
                &args.figure,
                &target.posture,
                &target.velocity,
                Some(target.planted),
            )],
        };
        if !driver.send(vec![frame]).await {
            break; // the reason comes below
        }
        sequence += 1;
        // Feedback is read as it comes; its arrival does not hold the motion up.
        while let Some(ready) = futures_util::FutureExt::now_or_never(driver.feedback()) {
            match ready.map_err(|e| explain(&e))? {
                Some(f) => last = Some(f),
                None => anyhow::bail!("the server ended the stream"),
            }
        }
        if told.elapsed() > Duration::from_secs(1) {
            told = Instant::now();
            if let Some(f) = &last {
                println!("{t:6.1} s  {}", describe(f));
            }
        }
    }
    if let Some(f) = driver.finish().await.map_err(|e| explain(&e))? {
        println!("done    {}", describe(&f));
    }
    Ok(())
}

async fn current_place(client: &Client, world: &str, figure: &str) -> anyhow::Result<Place> {
    let response = client
        .states()
        .get_world_frame(pb::GetWorldFrameRequest {
            world: world.into(),
            tick: None,
            view: Some(pb::View {
                figures: vec![figure.into()],
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
        .context("the server sent no pose")?;
    Ok(Place {
        x: pose[0],
        y: pose[1],
        yaw: engine::heading(crate::sim::math::Quat::from_xyzw([
            pose[3], pose[4], pose[5], pose[6],
        ])),
    })
}

fn describe(f: &pb::DriveFeedback) -> String {
    let Some(g) = f.figures.first() else {
        return String::new();
    };
    let used = g.present_count + g.interpolated_count;
    format!(
        "delay {:.0} ms, jitter {:.0} ms, {used} ticks with motion, {} extrapolated, {} held, {} frames late",
        g.playout_delay_ms, g.jitter_ms, g.extrapolated_count, g.held_count, g.late_count
    )
}
