//! `sinew serve`: serves worlds until it is told to stop.

use crate::server::api::App;
use crate::server::config::Config;
use crate::server::{self, telemetry};
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
    /// Do not serve the viewer; the status page is at `/` then
    #[arg(long)]
    no_viewer: bool,
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
        if self.no_viewer {
            flag("viewer", "false".to_owned());
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
            let people = server::demo::create(&app)
                .await
                .map_err(|e| anyhow::anyhow!(e))?;
            tracing::info!("the world `demo` has {}", people.join(", "));
        }
        println!("Sinew serves at http://{address} (gRPC, gRPC-Web, status page; Ctrl-C ends it)");
        if app.config.viewer {
            println!("Open it in a browser to see and disturb its figures: http://{address}/");
        }
        if !args.no_demo {
            println!("In the world `demo` people lift the same crate. In the terminal:");
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
