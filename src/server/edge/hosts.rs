//! Checks the host for which a request is meant, and the page from which it comes.
//!
//! A page of a stranger can let its own name point to this machine (DNS rebinding) and then talks to this server as if
//! it were its own. Its name is in `Host`, and in `Origin` if the page comes from elsewhere. Therefore only known names
//! are answered. An address in place of a name is always safe: it cannot be rebound.

use crate::config::Config;
use axum::http::{HeaderMap, Uri, header, uri::Authority};
use sinew_wire::status::Fault;
use std::net::{Ipv4Addr, Ipv6Addr};

/// Names of this machine on itself.
const LOOPBACK: &str = "localhost";
/// Characters of a name that a message repeats.
const ECHO: usize = 80;

/// The names that are known.
#[derive(Debug)]
pub(crate) struct Hosts {
    names: Vec<String>,
    origins: Vec<String>,
}

/// An address in place of a name.
fn address(host: &str) -> Option<std::net::IpAddr> {
    let v6 = host.strip_prefix('[').and_then(|h| h.strip_suffix(']'));
    match v6 {
        Some(h) => h.parse::<Ipv6Addr>().ok().map(Into::into),
        None => host.parse::<Ipv4Addr>().ok().map(Into::into),
    }
}

fn is_loopback(host: &str) -> bool {
    host.eq_ignore_ascii_case(LOOPBACK) || address(host).is_some_and(|a| a.is_loopback())
}

/// The authority of an origin, `http://host:port`.
fn authority(origin: &str) -> Option<Authority> {
    let (_, rest) = origin.split_once("://")?;
    rest.parse().ok().filter(is_plain)
}

/// Whether it is `host` or `host:port`. Other texts that parse as an authority, such as `[::1].example`, have a host
/// that is only a part of it.
fn is_plain(authority: &Authority) -> bool {
    let rest = authority.as_str().strip_prefix(authority.host());
    let port = |rest: &str| {
        let port = rest.strip_prefix(':');
        port.is_some_and(|p| p.bytes().all(|b| b.is_ascii_digit()))
    };
    rest.is_some_and(|rest| rest.is_empty() || port(rest))
}

/// Whether this is the origin of a page of the same machine.
fn is_local_origin(origin: &str) -> bool {
    authority(origin).is_some_and(|a| is_loopback(a.host()))
}

fn list(text: &str) -> Vec<String> {
    let items = text.split(',').map(|item| item.trim().to_ascii_lowercase());
    items.filter(|item| !item.is_empty()).collect()
}

impl Hosts {
    pub(super) fn new(config: &Config) -> Self {
        Self {
            names: list(&config.allowed_hosts),
            origins: list(&config.allowed_origins),
        }
    }

    /// Checks the host and origin of a request.
    ///
    /// # Errors
    /// A host or an origin that is not known.
    pub(super) fn check(&self, uri: &Uri, headers: &HeaderMap) -> Result<(), Fault> {
        let mut own: Option<Authority> = uri.authority().cloned();
        // A client without either header is not a browser.
        for value in headers.get_all(header::HOST) {
            let named = value
                .to_str()
                .ok()
                .and_then(|v| v.parse::<Authority>().ok());
            let Some(named) = named else {
                return Err(refused(
                    "HOST_NOT_ALLOWED",
                    "Host",
                    "allowed_hosts",
                    value.as_bytes(),
                ));
            };
            self.host(&named)?;
            own.get_or_insert(named);
        }
        if let Some(authority) = uri.authority() {
            self.host(authority)?;
        }
        for value in headers.get_all(header::ORIGIN) {
            let known = value.to_str().is_ok_and(|origin| {
                let same = own.as_ref().is_some_and(|own| {
                    authority(origin).is_some_and(|a| a.as_str().eq_ignore_ascii_case(own.as_str()))
                });
                same || self.allows(origin)
            });
            if !known {
                return Err(refused(
                    "ORIGIN_NOT_ALLOWED",
                    "Origin",
                    "allowed_origins",
                    value.as_bytes(),
                ));
            }
        }
        Ok(())
    }

    fn host(&self, authority: &Authority) -> Result<(), Fault> {
        let host = authority.host();
        let listed = self.names.iter().any(|n| n.eq_ignore_ascii_case(host));
        if is_plain(authority) && (listed || is_loopback(host) || address(host).is_some()) {
            Ok(())
        } else {
            Err(refused(
                "HOST_NOT_ALLOWED",
                "Host",
                "allowed_hosts",
                host.as_bytes(),
            ))
        }
    }

    /// Whether pages of this origin may call the server.
    pub(crate) fn allows(&self, origin: &str) -> bool {
        is_local_origin(origin) || self.origins.iter().any(|o| o.eq_ignore_ascii_case(origin))
    }
}

fn refused(reason: &'static str, header: &str, setting: &'static str, value: &[u8]) -> Fault {
    let shown = String::from_utf8_lossy(&value[..value.len().min(ECHO)]);
    Fault::Refused {
        reason,
        message: format!(
            "{header} {shown:?} is not known to this server; the setting {setting} lists what is"
        ),
        setting,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hosts() -> Hosts {
        Hosts::new(&Config {
            allowed_hosts: "sinew.example, other".into(),
            allowed_origins: "https://app.example".into(),
            ..Config::default()
        })
    }

    fn check(uri: &str, headers: &[(&str, &str)]) -> Result<(), &'static str> {
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            map.append(
                name.parse::<header::HeaderName>().unwrap(),
                value.parse().unwrap(),
            );
        }
        let checked = hosts().check(&uri.parse().unwrap(), &map);
        checked.map_err(|fault| fault.reason())
    }

    #[test]
    fn only_known_names_and_addresses_are_answered() {
        for good in [
            "localhost:7463",
            "LOCALHOST",
            "127.0.0.1:1",
            "[::1]:7463",
            "192.168.1.7:7463",
            "sinew.example",
        ] {
            assert_eq!(check("/", &[("host", good)]), Ok(()), "{good}");
            assert_eq!(check(&format!("http://{good}/x"), &[]), Ok(()), "{good}");
        }
        for bad in [
            "evil.example",
            "localhost.evil.example",
            "127.0.0.1.evil.example:7463",
            "sinew.example.evil",
        ] {
            assert_eq!(
                check("/", &[("host", bad)]),
                Err("HOST_NOT_ALLOWED"),
                "{bad}"
            );
            assert_eq!(
                check(&format!("http://{bad}/x"), &[]),
                Err("HOST_NOT_ALLOWED"),
                "{bad}"
            );
            // One good name does not hide a bad one.
            assert_eq!(
                check("/", &[("host", "localhost"), ("host", bad)]),
                Err("HOST_NOT_ALLOWED")
            );
        }
        assert_eq!(check("/", &[]), Ok(()), "no browser");
    }

    #[test]
    fn pages_of_other_origins_are_refused() {
        let host = ("host", "sinew.example");
        for good in [
            "http://localhost:3000",
            "http://127.0.0.1",
            "http://[::1]:8",
            "https://app.example",
            "https://sinew.example",
        ] {
            assert_eq!(check("/", &[host, ("origin", good)]), Ok(()), "{good}");
        }
        for bad in [
            "null",
            "https://evil.example",
            "http://app.example",
            "http://192.168.1.7",
            "https://other",
            "http://[::1].evil",
            "http://127.0.0.1@evil",
            "",
        ] {
            assert_eq!(
                check("/", &[host, ("origin", bad)]),
                Err("ORIGIN_NOT_ALLOWED"),
                "{bad}"
            );
        }
    }
}
