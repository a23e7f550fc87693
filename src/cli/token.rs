//! `sinew token`: makes bearer tokens for small set-ups, signed with a secret that the server shares.

use super::exit::UsageError;
use super::terminal::{note, print_line};
use anyhow::Context as _;
use sinew_server::access::roles::Role;
use sinew_server::access::tokens::{NewToken, create_secret, read_secret, sign};
use std::path::PathBuf;
use std::time::Duration;

/// Longest lifetime, days.
const MOST_DAYS: f64 = 3660.0;
/// Length of a day, s.
const DAY_S: f64 = 86_400.0;

/// Arguments of `sinew token`.
#[derive(Clone, Debug, clap::Args)]
pub struct TokenArgs {
    /// File with the secret: the setting `jwt_secret_file` of the server
    #[arg(long, value_name = "FILE")]
    key: PathBuf,
    /// Write a new secret to that file first; there must be none yet
    #[arg(long)]
    new_key: bool,
    /// The user for whom the token is; grants call it `user:NAME`
    #[arg(long = "for", value_name = "NAME", required_unless_present = "new_key")]
    subject: Option<String>,
    /// Role: viewer, perturber, driver, director, owner or creator (repeatable) [default: none but those of grants]
    #[arg(long = "role", value_name = "ROLE", value_parser = role)]
    roles: Vec<Role>,
    /// World or clip that the roles are for; a `*` at the end stands for any ending (repeatable) [default: all]
    #[arg(long = "world", value_name = "NAME")]
    worlds: Vec<String>,
    /// How long it is valid, days
    #[arg(long, default_value_t = 30.0, value_name = "DAYS")]
    days: f64,
    /// For which server: its setting `jwt_audience`
    #[arg(long, default_value = "sinew", value_name = "NAME")]
    audience: String,
    /// By whom: the server's setting `jwt_issuer`
    #[arg(long, default_value = "", value_name = "NAME")]
    issuer: String,
}

fn role(text: &str) -> Result<Role, String> {
    Role::named(text)
        .filter(|r| *r != Role::Member)
        .ok_or_else(|| "expected viewer, perturber, driver, director, owner or creator".to_owned())
}

/// Prints a token, and nothing else, on standard output.
///
/// # Errors
/// The file with the secret cannot be used, or a name is not allowed.
pub fn run(args: &TokenArgs) -> anyhow::Result<()> {
    // Written so that NaN fails.
    if !(args.days > 0.0 && args.days <= MOST_DAYS) {
        return Err(UsageError(format!("--days must be above 0 and at most {MOST_DAYS}")).into());
    }
    if args.new_key {
        create_secret(&args.key).with_context(|| args.key.display().to_string())?;
        note(&format!(
            "a new secret is in {}; keep it to yourself",
            args.key.display()
        ));
    }
    let Some(subject) = &args.subject else {
        return Ok(());
    };
    let secret = read_secret(&args.key).map_err(|e| {
        let help = if args.key.exists() {
            ""
        } else {
            "; `--new-key` makes one"
        };
        anyhow::anyhow!("{e}{help}")
    })?;
    let token = NewToken {
        subject: subject.clone(),
        roles: args.roles.clone(),
        worlds: (!args.worlds.is_empty()).then(|| args.worlds.clone()),
        lifetime: Duration::from_secs_f64(args.days * DAY_S),
        audience: args.audience.clone(),
        issuer: args.issuer.clone(),
    };
    print_line(&sign(&secret, &token).map_err(anyhow::Error::msg)?)
}
