//! `sinew health`: asks a server whether it serves.

use super::args::CredentialArgs;
use super::explain;
use super::terminal::print_line;
use std::time::Duration;

/// How long the answer may take.
const PATIENCE: Duration = Duration::from_secs(3);

/// Arguments of `sinew health`.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Server, host:port
    #[arg(default_value = "127.0.0.1:7463")]
    address: String,
    #[command(flatten)]
    credentials: CredentialArgs,
}

/// Succeeds if the server serves.
///
/// # Errors
/// No server, one that is shutting down, or no answer within 3 s.
pub fn run(args: &Args) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(async {
        let asked = async {
            let client = args.credentials.connect(&args.address).await?;
            client.serves().await.map_err(|e| explain(&e))
        };
        let serves = tokio::time::timeout(PATIENCE, asked).await;
        match serves.unwrap_or_else(|_| Err(anyhow::anyhow!("no answer within {PATIENCE:?}")))? {
            true => print_line("serving"),
            false => Err(anyhow::anyhow!("not serving")),
        }
    })
}
