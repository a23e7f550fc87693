//! `sinew serve`: serves worlds until it is told to stop.

use crate::server::api::App;
use crate::server::config::Config;
use crate::server::tick::command::Origin;
use crate::server::{self, telemetry};
use crate::wire::convert;
use crate::wire::pb;
use crate::wire::types::{Place, Playback};
use anyhow::Context as _;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;

/// Arguments of `sinew serve`.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Args {
    /// TOML file with settings; see deploy/config/sinew.toml for all of them
    #[arg(long, env = "SINEW_CONFIG", value_name = "FILE")]
    config: Option<PathBuf>,
    /// Address and port to serve on [default: 127.0.0.1:7463]
    #[arg(long, value_name = "ADDR:PORT")]
    listen: Option<SocketAddr>,
    /// Allow an address that other machines can reach, without any authentication
    #[arg(long)]
    insecure_bind_any: bool,
    /// What to log, for example `info` or `sinew=debug`
    #[arg(long, value_name = "FILTER")]
    log: Option<String>,
    /// Any setting by name; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = pair)]
    set: Vec<(String, String)>,
    /// Do not create the demo world
    #[arg(long)]
    no_demo: bool,
}

fn pair(text: &str) -> Result<(String, String), String> {
    text.split_once('=')
        .map(|(a, b)| (a.trim().to_owned(), b.trim().to_owned()))
        .ok_or_else(|| "expected NAME=VALUE".to_owned())
}

impl Args {
    fn settings(&self) -> anyhow::Result<Config> {
        let mut flags = self.set.clone();
        let mut flag = |name: &str, value: String| flags.push((name.to_owned(), value));
        if let Some(listen) = self.listen {
            flag("listen", listen.to_string());
        }
        if self.insecure_bind_any {
            flag("insecure_bind_any", "true".to_owned());
        }
        if let Some(log) = &self.log {
            flag("log", log.clone());
        }
        Ok(Config::load(
            self.config.as_deref(),
            std::env::vars(),
            &flags,
        )?)
    }
}

/// Serves until Ctrl-C or SIGTERM.
///
/// # Errors
/// Settings that are not usable, or a port that is taken.
pub fn run(args: &Args) -> anyhow::Result<()> {
    let config = args.settings()?;
    telemetry::init_logs(&config).map_err(anyhow::Error::msg)?;
    for (name, _, value) in config.table() {
        tracing::info!("setting {name} = {value}");
    }
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()?;
    runtime.block_on(async {
        let listener = tokio::net::TcpListener::bind(config.listen)
            .await
            .with_context(|| {
                format!(
                    "cannot serve on {}: is another server running? --listen takes another port",
                    config.listen
                )
            })?;
        let address = listener.local_addr()?;
        let (stop, stopping) = tokio::sync::watch::channel(false);
        let app = Arc::new(App::new(Arc::new(config), stopping)?);
        if !args.no_demo {
            demo(&app).await?;
        }
        println!("Sinew serves at http://{address} (gRPC, gRPC-Web, status page; Ctrl-C ends it)");
        if !args.no_demo {
            println!("The world `demo` has three figures with built-in motions. Watch them:");
            println!("  sinew watch {address} demo");
        }
        server::serve(app, listener, interrupted(), stop)
            .await
            .map_err(|e| anyhow::anyhow!(e))
    })
}

async fn interrupted() {
    let interrupt = tokio::signal::ctrl_c();
    #[cfg(unix)]
    {
        use tokio::signal::unix::{SignalKind, signal};
        match signal(SignalKind::terminate()) {
            Ok(mut terminate) => {
                tokio::select! {
                    _ = interrupt => {}
                    _ = terminate.recv() => {}
                }
            }
            Err(_) => {
                let _ = interrupt.await;
            }
        }
    }
    #[cfg(not(unix))]
    let _ = interrupt.await;
}

/// A world with three figures that play built-in motions.
async fn demo(app: &Arc<App>) -> anyhow::Result<()> {
    let world = app
        .worlds
        .create(Some("demo".into()), convert::world::settings(None)?, false)?;
    let origin = || Origin {
        client: "demo".into(),
        sequence: 0,
    };
    for (name, body, clip_name, y) in [
        ("man", "bodies/adult-man", "squat", 0.0),
        ("woman", "bodies/adult-woman", "wave", 1.5),
        ("stepper", "bodies/adult-man", "step", -1.5),
    ] {
        let settings = convert::figure::settings(
            "figure",
            Some(&pb::Figure {
                body: body.into(),
                controller: pb::Controller::Modern.into(),
                placement: Some(pb::Placement {
                    y_m: y,
                    ..Default::default()
                }),
                ..Default::default()
            }),
        )?;
        let built = app.bodies.get("figure.profile", &settings.body)?;
        let clip = app
            .clips
            .prepared(clip_name, &settings.body.id, &built, true)?;
        let playback = Playback {
            speed: 1.0,
            looped: true,
            start: None,
            reset: true,
            place: Some(Place {
                y,
                ..Place::default()
            }),
        };
        world
            .call(origin(), move |s| {
                s.create_figure(Some(name.to_owned()), settings, built)?;
                s.play(name, clip_name, clip, playback)
            })
            .await?;
    }
    Ok(())
}
