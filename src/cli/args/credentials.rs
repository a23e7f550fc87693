//! How a command identifies itself to a server, and how it verifies the server.

use anyhow::Context as _;
use sinew_client::{Client, Credentials};
use std::path::{Path, PathBuf};

/// Credentials that commands share. A token comes by a file or the environment: arguments can be read by others.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct CredentialArgs {
    /// File with the bearer token; the variable SINEW_TOKEN holds a token itself
    #[arg(long, value_name = "FILE")]
    token_file: Option<PathBuf>,
    /// PEM file with the roots that the server's certificate is checked with [default: those of the system]
    #[arg(long, value_name = "FILE")]
    ca: Option<PathBuf>,
    /// PEM file with a certificate of the client
    #[arg(long, value_name = "FILE", requires = "key")]
    cert: Option<PathBuf>,
    /// PEM file with its private key
    #[arg(long, value_name = "FILE", requires = "cert")]
    key: Option<PathBuf>,
}

impl CredentialArgs {
    /// Connects with these credentials.
    ///
    /// # Errors
    /// A file cannot be read, or there is no answer.
    pub async fn connect(&self, address: &str) -> anyhow::Result<Client> {
        let read = |path: &Path| std::fs::read(path).with_context(|| path.display().to_string());
        let token = match &self.token_file {
            Some(path) => Some(String::from_utf8(read(path)?).context("the token is no text")?),
            None => std::env::var("SINEW_TOKEN").ok().filter(|t| !t.is_empty()),
        };
        let certificate = match (&self.cert, &self.key) {
            (Some(cert), Some(key)) => Some((read(cert)?, read(key)?)),
            _ => None,
        };
        let credentials = Credentials {
            token: token.map(|t| t.trim().to_owned()),
            ca: self.ca.as_deref().map(read).transpose()?,
            certificate,
        };
        Ok(Client::connect_with(address, &credentials).await?)
    }
}
