//! Permissions: identities, roles, and the limits of each principal.
//!
//! A call passes [`identify`] first. It identifies the caller by the client certificate of the connection or by a
//! bearer token, looks up the role that the call needs ([`roles`]), and checks everything that needs no world. Services
//! get a world only through a check of the caller's role in it (`api::App::world`). Without certificates and keys in
//! the settings, every caller is `anonymous` and owns everything.

pub mod caller;
pub mod grants;
pub(super) mod keys;
pub mod limits;
pub mod roles;
pub mod tls;
pub mod tokens;

use super::config::Config;
use super::edge::connections::Peer;
use super::edge::unknown_method;
use super::shares::client_at;
use super::telemetry::{calls, count_refusal};
use axum::body::Body;
use axum::extract::{Request, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use axum::middleware::Next;
use axum::response::Response;
use caller::{Caller, Identity};
use limits::CallRates;
use sinew_wire::status::Fault;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Instant;
use tls::{CertificateRoles, Tls};
use tokens::Tokens;
use tonic::Status;

/// Bytes of a call's path that a message repeats.
const ECHO: usize = 120;

/// The state of this part of the server.
#[derive(Debug)]
pub struct Access {
    /// TLS, if there is a certificate.
    pub tls: Option<Tls>,
    certificates: CertificateRoles,
    trusts_certificates: bool,
    tokens: Option<Tokens>,
    rates: CallRates,
}

impl Access {
    /// Access as configured.
    ///
    /// # Errors
    /// A file cannot be used.
    pub fn new(config: &Config) -> Result<Arc<Self>, String> {
        Ok(Arc::new(Self {
            tls: Tls::new(config)?,
            certificates: CertificateRoles::new(config),
            trusts_certificates: !config.tls_client_ca.is_empty(),
            tokens: Tokens::new(config)?,
            rates: CallRates::new(config.max_client_calls_per_s),
        }))
    }

    /// Whether callers have to authenticate.
    pub fn is_required(&self) -> bool {
        self.tokens.is_some() || self.trusts_certificates
    }

    /// Keeps keys and certificate fresh; never ends.
    pub async fn keep_fresh(&self) {
        let keys = async {
            match &self.tokens {
                Some(tokens) => tokens.refresh().await,
                None => std::future::pending().await,
            }
        };
        let certificate = async {
            match &self.tls {
                Some(tls) => tls.follow_files().await,
                None => std::future::pending().await,
            }
        };
        tokio::join!(keys, certificate);
    }

    /// The identity of the caller. A token takes precedence over a certificate.
    ///
    /// # Errors
    /// The caller is unknown.
    pub(super) async fn identity(
        &self,
        headers: &HeaderMap,
        peer: Option<&Peer>,
    ) -> Result<Identity, Fault> {
        if !self.is_required() {
            return Ok(Identity::anonymous());
        }
        if let (Some(tokens), Some(value)) = (&self.tokens, headers.get(header::AUTHORIZATION)) {
            let token = value.to_str().ok().and_then(|v| {
                let (scheme, token) = v.split_once(' ')?;
                scheme.eq_ignore_ascii_case("bearer").then(|| token.trim())
            });
            let token = token.ok_or_else(|| Fault::Unauthenticated {
                reason: "TOKEN_MALFORMED",
                message: "the header authorization must hold `Bearer` and a token".into(),
            })?;
            return tokens.identify(token).await;
        }
        let certificate = peer.and_then(Peer::certificate);
        let identity = certificate.and_then(|c| self.certificates.identify(c));
        identity.ok_or_else(|| Fault::Unauthenticated {
            reason: "CREDENTIALS_REQUIRED",
            message: match (&self.tokens, self.trusts_certificates) {
                (Some(_), false) => "this server needs a bearer token in the header authorization",
                (None, _) => "this server needs a client certificate with a name",
                (Some(_), true) => {
                    "this server needs a bearer token in the header authorization, or a client certificate"
                }
            }
            .into(),
        })
    }

    async fn caller(&self, request: &Parts) -> Result<Caller, Fault> {
        let path = request.uri.path();
        let rule = roles::rule(path);
        let peer = request.extensions.get::<Arc<Peer>>();
        let identity = match rule {
            roles::Rule::Open => Identity::anonymous(),
            _ => self.identity(&request.headers, peer.map(|p| &**p)).await?,
        };
        let address: Option<SocketAddr> = peer.map(|p| p.address);
        let shown: String = path.trim_start_matches('/').chars().take(ECHO).collect();
        let caller = if identity.is_anonymous() {
            let connection = address.map_or_else(String::new, |a| a.to_string());
            Caller {
                client: client_at(address),
                order: connection.into(),
                identity,
                rule,
                call: shown.into(),
            }
        } else {
            Caller {
                client: identity.principal.clone(),
                order: identity.principal.clone(),
                identity,
                rule,
                call: shown.into(),
            }
        };
        // Programs on this machine without authentication are trusted; health is always answered.
        let local = address.is_none_or(|a| a.ip().to_canonical().is_loopback());
        let free = rule == roles::Rule::Open || (local && caller.identity.is_anonymous());
        if !free {
            self.rates.admit(&caller.client, Instant::now())?;
        }
        caller.check_server()?;
        Ok(caller)
    }
}

/// Identifies the caller, and refuses the call if the identity alone is reason enough.
pub(super) async fn identify(
    State(access): State<Arc<Access>>,
    request: Request,
    next: Next,
) -> Response {
    if roles::rule(request.uri().path()) == roles::Rule::Unknown {
        return unknown_method(request.uri().path());
    }
    let (mut parts, body) = request.into_parts();
    match access.caller(&parts).await {
        Ok(caller) => {
            if let Some(note) = parts.extensions.get::<Arc<calls::Note>>() {
                note.principal(caller.principal());
            }
            parts.extensions.insert(caller);
            next.run(Request::from_parts(parts, body)).await
        }
        Err(fault) => {
            count_refusal(&fault);
            Status::from(fault).into_http::<Body>()
        }
    }
}
