//! `sinew health`: asks a server whether it is alive, and whether it takes new clients.

use super::args::CredentialArgs;
use super::remote::explain;
use super::terminal::print_line;
use sinew_server::health::{LIVENESS, READINESS};
use std::time::Duration;

/// Longest time to wait for the answer.
const PATIENCE: Duration = Duration::from_secs(3);

/// Arguments of `sinew health`.
#[derive(Clone, Debug, clap::Args)]
pub struct HealthArgs {
    /// Server, host:port
    #[arg(default_value = "127.0.0.1:7463")]
    address: String,
    /// Ask only whether the process answers, as `/livez`; without it, whether new clients are welcome, as `/readyz`
    #[arg(long, conflicts_with = "service")]
    live: bool,
    /// Ask for one service, for example `sinew.v1.WorldService`
    #[arg(long, value_name = "NAME")]
    service: Option<String>,
    #[command(flatten)]
    credentials: CredentialArgs,
}

/// Succeeds if the server serves.
///
/// # Errors
/// No server, one that takes no new clients (unless `--live`), an unknown service, or no answer within 3 s.
pub fn run(args: &HealthArgs) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(async {
        let asked = async {
            let client = args.credentials.connect(&args.address).await?;
            let service = match &args.service {
                Some(service) => service,
                None if args.live => LIVENESS,
                None => READINESS,
            };
            client.is_healthy(service).await.map_err(|e| explain(&e))
        };
        let serves = tokio::time::timeout(PATIENCE, asked).await;
        match serves.unwrap_or_else(|_| Err(anyhow::anyhow!("no answer within {PATIENCE:?}")))? {
            true => print_line("serving"),
            false => Err(anyhow::anyhow!("not serving")),
        }
    })
}
