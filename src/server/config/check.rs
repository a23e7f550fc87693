//! Checks that the files, directories and addresses in the settings can be used. Nothing is changed.

use super::Config;
use crate::access::keys::KeySource;
use crate::access::tls::Tls;
use crate::access::tokens::read_secret;
use crate::durable::local::LocalStore;
use crate::telemetry;
use std::net::TcpListener;
use std::path::Path;

/// A problem with a setting.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettingProblem {
    /// Name of the setting.
    pub setting: &'static str,
    /// The problem.
    pub what: String,
}

/// All problems. Keys are fetched from their address; no other request leaves this machine.
pub async fn problems(config: &Config) -> Vec<SettingProblem> {
    let mut all = Vec::new();
    let mut check = |setting: &'static str, result: Result<(), String>| {
        if let Err(what) = result {
            // Drop the setting's name if the message already begins with it.
            let what = what.strip_prefix(&format!("{setting}: ")).unwrap_or(&what);
            let what = super::without_secrets(what);
            all.push(SettingProblem { setting, what });
        }
    };
    let tls = Tls::new(config).map(|_| ());
    check(
        named_in(&tls, &["tls_client_ca", "tls_key", "tls_cert"]),
        tls,
    );
    if !config.jwt_secret_file.is_empty() {
        check(
            "jwt_secret_file",
            read_secret(Path::new(&config.jwt_secret_file)).map(|_| ()),
        );
    }
    if !config.jwt_keys.is_empty() {
        check("jwt_keys", keys(config).await);
    }
    check("log", telemetry::log_filter(config).map(|_| ()));
    check("data_dir", directory(&config.data_dir));
    let free = TcpListener::bind(config.listen);
    check(
        "listen",
        free.map(|_| ())
            .map_err(|e| format!("{}: {e}", config.listen)),
    );
    all
}

/// The setting that a message is about: it begins with its name.
fn named_in(result: &Result<(), String>, names: &[&'static str]) -> &'static str {
    let Err(message) = result else {
        return names[names.len() - 1];
    };
    let named = names.iter().find(|n| message.starts_with(**n));
    named.copied().unwrap_or(names[names.len() - 1])
}

async fn keys(config: &Config) -> Result<(), String> {
    KeySource::new(config)?.try_fetch().await
}

/// Checks that worlds can be kept there. A running server may be using it.
fn directory(dir: &str) -> Result<(), String> {
    if dir.is_empty() {
        return Ok(());
    }
    let path = Path::new(dir);
    // A directory that does not exist yet will be made in the nearest existing one.
    let there = path
        .ancestors()
        .find(|p| p.exists() || p.as_os_str().is_empty());
    let there = match there {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    if !there.is_dir() {
        return Err(format!("{}: is no directory", there.display()));
    }
    let probe = there.join(format!(".sinew-check-{}", std::process::id()));
    let written = std::fs::write(&probe, b"").and_then(|()| std::fs::remove_file(&probe));
    written.map_err(|e| format!("{}: cannot be written to: {e}", there.display()))?;
    LocalStore::check_format(path).map_err(|e| e.to_string())
}
