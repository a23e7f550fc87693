//! `sinew serve`: serves worlds until Ctrl-C or SIGTERM.

use super::exit::{UsageError, usage};
use super::interrupt::interrupted;
use super::terminal::{OutputClosed, note, print, stderr_shows_colour};
use anyhow::Context as _;
use sinew_server::app::App;
use sinew_server::config::{Config, Sources};
use sinew_server::telemetry;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use tokio::net::TcpSocket;
use tracing_subscriber::filter::Targets;

/// Connections that the system holds until they are accepted: as many as Linux allows. A connection that finds the
/// queue full, for whatever reason, tries again after a second.
const BACKLOG: u32 = 4096;

/// Arguments of `sinew serve`.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct ServeArgs {
    /// TOML file with settings; deploy/config/sinew.toml lists all of them
    #[arg(long, env = "SINEW_CONFIG", value_name = "FILE")]
    config: Option<PathBuf>,
    /// Address and port to listen on [default: 127.0.0.1:7463]
    #[arg(long, value_name = "ADDR:PORT")]
    listen: Option<SocketAddr>,
    /// Directory in which worlds and clips outlive the server; it is made if need be
    #[arg(long, value_name = "DIR")]
    data_dir: Option<PathBuf>,
    /// Allow an address that other machines can reach without authentication or without TLS
    #[arg(long)]
    insecure_bind_any: bool,
    /// Log filter, for example `info` or `sinew=debug`; logs go to standard error
    #[arg(long, value_name = "FILTER")]
    log: Option<String>,
    /// Any setting by name (repeatable)
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = pair)]
    set: Vec<(String, String)>,
    /// Do not create the demo world
    #[arg(long)]
    no_demo: bool,
    /// Do not serve the viewer; the status page is then at `/`
    #[arg(long)]
    no_viewer: bool,
}

fn pair(text: &str) -> Result<(String, String), String> {
    text.split_once('=')
        .map(|(a, b)| (a.trim().to_owned(), b.trim().to_owned()))
        .ok_or_else(|| "expected NAME=VALUE".to_owned())
}

/// Variables of the environment. Anything in them that is not UTF-8 is replaced: no setting contains it.
fn variables() -> impl Iterator<Item = (String, String)> {
    let text = |s: std::ffi::OsString| s.to_string_lossy().into_owned();
    std::env::vars_os().map(move |(name, value)| (text(name), text(value)))
}

impl ServeArgs {
    /// Settings from all sources, and the source of each.
    ///
    /// # Errors
    /// One is not usable.
    pub(super) fn settings(&self) -> anyhow::Result<(Config, Sources)> {
        let mut flags = self.set.clone();
        let mut flag = |name: &str, value: String| flags.push((name.to_owned(), value));
        if let Some(listen) = self.listen {
            flag("listen", listen.to_string());
        }
        if let Some(dir) = &self.data_dir {
            let Some(dir) = dir.to_str().filter(|d| !d.is_empty()) else {
                anyhow::bail!("--data-dir must be a path in UTF-8, got {}", dir.display());
            };
            flag("data_dir", dir.to_owned());
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
        Ok(Config::load_with_sources(
            self.config.as_deref(),
            variables(),
            &flags,
        )?)
    }
}

/// Serves until Ctrl-C or SIGTERM. The first line on standard output holds the address, and connections are accepted by
/// then; logs follow on standard error.
///
/// # Errors
/// Settings that are not usable, or a port that is taken.
pub fn run(args: &ServeArgs) -> anyhow::Result<()> {
    let (config, _) = args.settings().map_err(usage)?;
    let filter = telemetry::log_filter(&config).map_err(UsageError)?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()?;
    runtime.block_on(serve(args, Arc::new(config), filter))
}

async fn serve(args: &ServeArgs, config: Arc<Config>, filter: Targets) -> anyhow::Result<()> {
    // Binds the port now, so that a mistake is reported at once; accepts connections only when the server can answer.
    let cannot_listen = || {
        format!(
            "cannot listen on {}: is another server running? --listen selects another port",
            config.listen
        )
    };
    let socket = bind(config.listen).with_context(cannot_listen)?;
    let address = socket.local_addr()?;
    let log = || telemetry::init_logs(filter, config.log_json, stderr_shows_colour());
    // Damage in a data directory is logged as it is opened. Otherwise the address is the first line even where both
    // outputs are the same.
    let opens = !config.data_dir.is_empty();
    let log = if opens {
        log();
        None
    } else {
        Some(log)
    };
    let (stop, stopping) = tokio::sync::watch::channel(false);
    let app = Arc::new(App::new(config.clone(), stopping)?);
    app.restore().await;
    let mut figures = Vec::new();
    if !args.no_demo && app.worlds.get("demo").is_err() {
        figures = sinew_server::demo::create(&app)
            .await
            .map_err(|e| anyhow::anyhow!(e))?;
    }
    let listener = socket.listen(BACKLOG).with_context(cannot_listen)?;
    let serving = tokio::spawn(sinew_server::serve(app, listener, interrupted(), stop));
    // One write: a reader that wants only the first line takes the rest with it. A server without readers serves all
    // the same.
    match print(&greeting(address, &config, &figures)) {
        Err(error) if !error.is::<OutputClosed>() => note(&format!("warning: {error:#}")),
        _ => {}
    }
    if let Some(log) = log {
        log();
    }
    for (name, value) in changed(&config) {
        tracing::info!("setting {name} = {value}");
    }
    if !figures.is_empty() {
        tracing::info!("world `demo` created with figures {}", figures.join(", "));
    }
    serving.await?.map_err(|e| anyhow::anyhow!(e))
}

/// Settings that differ from their defaults. `sinew config show` lists all of them; here they would push the address
/// off the terminal.
fn changed(config: &Config) -> impl Iterator<Item = (&'static str, String)> {
    let defaults = Config::default().shown();
    let both = config.shown().into_iter().zip(defaults);
    both.filter(|(given, default)| given != default)
        .map(|((name, _, value), _)| (name, value))
}

/// A socket that holds the address but does not accept yet.
fn bind(address: SocketAddr) -> std::io::Result<TcpSocket> {
    let socket = if address.is_ipv4() {
        TcpSocket::new_v4()?
    } else {
        TcpSocket::new_v6()?
    };
    // Allows the address of a server that has just stopped to be used again.
    socket.set_reuseaddr(true)?;
    socket.bind(address)?;
    Ok(socket)
}

/// The text printed when the server is ready.
fn greeting(address: SocketAddr, config: &Config, figures: &[&str]) -> String {
    let viewer = config.viewer;
    let scheme = if config.tls_cert.is_empty() {
        "http"
    } else {
        "https"
    };
    let pages = if viewer { "viewer, " } else { "" };
    let mut out = format!(
        "Sinew serves at {scheme}://{address} ({pages}gRPC, gRPC-Web, /status, /metrics); Ctrl-C stops it\n"
    );
    if viewer {
        out += &format!("Viewer, in a browser: {scheme}://{address}/\n");
    }
    if !figures.is_empty() {
        out += &format!(
            "World `demo`: figures {} lift a crate. In a terminal: sinew watch {address} demo\n",
            figures.join(", ")
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::ErrorKind;
    use tokio::net::TcpStream;

    #[test]
    fn only_settings_that_differ_from_their_defaults_are_logged() {
        assert_eq!(changed(&Config::default()).count(), 0);
        let config = Config {
            max_worlds: 4,
            ..Config::default()
        };
        let all: Vec<_> = changed(&config).collect();
        assert_eq!(all, [("max_worlds", "4".to_owned())]);
    }

    #[tokio::test]
    async fn the_port_is_taken_at_once_and_accepts_when_somebody_answers() {
        let socket = bind(([127, 0, 0, 1], 0).into()).unwrap();
        let address = socket.local_addr().unwrap();
        let early = TcpStream::connect(address).await;
        assert_eq!(early.unwrap_err().kind(), ErrorKind::ConnectionRefused);
        let _listener = socket.listen(BACKLOG).unwrap();
        TcpStream::connect(address).await.unwrap();
        assert_eq!(bind(address).unwrap_err().kind(), ErrorKind::AddrInUse);
    }
}
