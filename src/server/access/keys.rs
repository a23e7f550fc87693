//! The public keys of token issuers: a JWKS in a file or behind a URL, fetched again at intervals.

use crate::config::Config;
use http_body_util::{BodyExt as _, Empty, Limited};
use hyper_rustls::{HttpsConnector, HttpsConnectorBuilder};
use hyper_util::client::legacy::Client;
use hyper_util::client::legacy::connect::HttpConnector;
use hyper_util::rt::TokioExecutor;
use jsonwebtoken::jwk::{AlgorithmParameters, EllipticCurve, Jwk, JwkSet, PublicKeyUse};
use jsonwebtoken::{Algorithm, DecodingKey};
use prost::bytes::Bytes;
use rustls::RootCertStore;
use rustls::pki_types::CertificateDer;
use rustls::pki_types::pem::PemObject as _;
use sinew_wire::status::Fault;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::{Duration, Instant};

/// Bytes of a set of keys.
const MOST_BYTES: usize = 256 * 1024;
/// Keys of a set.
const MOST_KEYS: usize = 128;
/// Bytes of the name of a key.
const MOST_ID: usize = 256;
/// Longest time for fetching.
const FETCH_TIME: Duration = Duration::from_secs(5);
/// Shortest interval at which a token with an unknown key causes the keys to be fetched again.
const LEAST_INTERVAL: Duration = Duration::from_secs(10);

/// A key for checking signatures.
#[derive(Clone)]
pub(super) struct VerificationKey {
    id: Option<String>,
    algorithms: Vec<Algorithm>,
    pub(super) key: DecodingKey,
}

enum From {
    File(PathBuf),
    Url(
        http::Uri,
        Box<Client<HttpsConnector<HttpConnector>, Empty<Bytes>>>,
    ),
}

/// The source of the keys, and the keys last fetched.
pub(crate) struct KeySource {
    from: From,
    interval: Duration,
    keys: RwLock<Vec<VerificationKey>>,
    version: AtomicU64,
    /// Time of the last attempt to fetch them, successful or not. Locked during an attempt.
    fetched: tokio::sync::Mutex<Option<Instant>>,
}

impl KeySource {
    /// The source named in the settings. A file is read at once.
    ///
    /// # Errors
    /// The file has no keys, or the address is invalid.
    pub(crate) fn new(config: &Config) -> Result<Arc<Self>, String> {
        let place = config.jwt_keys.as_str();
        let from = if place.contains("://") {
            let url: http::Uri = place
                .parse()
                .map_err(|e| format!("jwt_keys: {place}: {e}"))?;
            if !matches!(url.scheme_str(), Some("https" | "http")) {
                return Err(format!(
                    "jwt_keys: {place} must be a file, or an address with https or http"
                ));
            }
            From::Url(url, Box::new(client(&config.jwt_keys_ca)?))
        } else {
            From::File(PathBuf::from(place))
        };
        let keys = match &from {
            From::File(path) => {
                parse(&read(path)?).map_err(|e| format!("jwt_keys: {place}: {e}"))?
            }
            From::Url(..) => Vec::new(),
        };
        Ok(Arc::new(Self {
            from,
            interval: Duration::from_secs_f64(config.jwt_refresh_s),
            keys: RwLock::new(keys),
            version: AtomicU64::new(1),
            fetched: tokio::sync::Mutex::default(),
        }))
    }

    /// Counts up when the keys change.
    pub(super) fn version(&self) -> u64 {
        self.version.load(Ordering::Acquire)
    }

    fn known(&self, id: Option<&str>, algorithm: Algorithm) -> Option<VerificationKey> {
        let keys = self.keys.read().unwrap_or_else(PoisonError::into_inner);
        let mut fitting = keys.iter().filter(|k| {
            k.algorithms.contains(&algorithm) && (id.is_none() || k.id.as_deref() == id)
        });
        let first = fitting.next()?;
        // Without a name the key must be the only one.
        (id.is_some() || fitting.next().is_none()).then(|| first.clone())
    }

    /// The key of a token. An unknown one lets the keys be fetched again, at most once in an interval.
    ///
    /// # Errors
    /// There is none.
    pub(super) async fn find(
        &self,
        id: Option<&str>,
        algorithm: Algorithm,
    ) -> Result<VerificationKey, Fault> {
        if let Some(key) = self.known(id, algorithm) {
            return Ok(key);
        }
        if id.is_none_or(|id| id.len() <= MOST_ID) {
            self.fetch(LEAST_INTERVAL).await;
        }
        self.known(id, algorithm)
            .ok_or_else(|| Fault::Unauthenticated {
                reason: "TOKEN_KEY_UNKNOWN",
                message: "the token is signed with a key that this server does not know".into(),
            })
    }

    async fn read(&self) -> Result<Vec<VerificationKey>, String> {
        let text = match &self.from {
            From::File(path) => read(path),
            From::Url(url, client) => {
                let got = tokio::time::timeout(FETCH_TIME, get(client, url)).await;
                got.unwrap_or_else(|_| Err(format!("no answer within {FETCH_TIME:?}")))
            }
        };
        text.and_then(|text| parse(&text))
    }

    /// Whether the keys can be fetched now.
    ///
    /// # Errors
    /// Why they cannot.
    pub(crate) async fn try_fetch(&self) -> Result<(), String> {
        self.read().await.map(|_| ())
    }

    /// Fetches the keys unless that was tried within `least`. The present keys stay if it fails.
    async fn fetch(&self, least: Duration) {
        let mut fetched = self.fetched.lock().await;
        if fetched.is_some_and(|at| at.elapsed() < least) {
            return;
        }
        let read = self.read().await;
        *fetched = Some(Instant::now());
        match read {
            Ok(keys) => {
                *self.keys.write().unwrap_or_else(PoisonError::into_inner) = keys;
                // Tokens that were checked with the previous keys are checked again.
                self.version.fetch_add(1, Ordering::AcqRel);
                metrics::counter!("sinew_key_fetches_total", "result" => "ok").increment(1);
            }
            Err(error) => {
                metrics::counter!("sinew_key_fetches_total", "result" => "failed").increment(1);
                tracing::warn!(
                    error,
                    "the keys of tokens could not be fetched; those from before stay"
                );
            }
        }
    }

    /// Fetches the keys at once, and then repeatedly.
    pub(super) async fn refresh_forever(&self) {
        loop {
            self.fetch(Duration::ZERO).await;
            let none = self
                .keys
                .read()
                .unwrap_or_else(PoisonError::into_inner)
                .is_empty();
            tokio::time::sleep(if none { LEAST_INTERVAL } else { self.interval }).await;
        }
    }
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    use std::io::Read as _;
    let shown = path.display();
    let file = std::fs::File::open(path).map_err(|e| format!("jwt_keys: {shown}: {e}"))?;
    let mut text = Vec::new();
    file.take(MOST_BYTES as u64 + 1)
        .read_to_end(&mut text)
        .map_err(|e| format!("jwt_keys: {shown}: {e}"))?;
    Ok(text)
}

/// Certificates of a PEM file; for an empty path, those that the system trusts.
pub(super) fn roots(path: &str) -> Result<RootCertStore, String> {
    let mut roots = RootCertStore::empty();
    if path.is_empty() {
        let found = rustls_native_certs::load_native_certs();
        roots.add_parsable_certificates(found.certs);
        return Ok(roots);
    }
    let certificates = CertificateDer::pem_file_iter(path).map_err(|e| format!("{path}: {e}"))?;
    for certificate in certificates {
        let certificate = certificate.map_err(|e| format!("{path}: {e}"))?;
        roots.add(certificate).map_err(|e| format!("{path}: {e}"))?;
    }
    if roots.is_empty() {
        return Err(format!("{path}: there is no certificate in it"));
    }
    Ok(roots)
}

fn client(ca: &str) -> Result<Client<HttpsConnector<HttpConnector>, Empty<Bytes>>, String> {
    let provider = Arc::new(rustls::crypto::aws_lc_rs::default_provider());
    let tls = rustls::ClientConfig::builder_with_provider(provider)
        .with_safe_default_protocol_versions()
        .map_err(|e| e.to_string())?
        .with_root_certificates(roots(ca)?)
        .with_no_client_auth();
    let connector = HttpsConnectorBuilder::new()
        .with_tls_config(tls)
        .https_or_http()
        .enable_http1()
        .build();
    Ok(Client::builder(TokioExecutor::new()).build(connector))
}

/// Fetches a page. Redirections are not followed: keys come only from the address that the operator gave.
async fn get(
    client: &Client<HttpsConnector<HttpConnector>, Empty<Bytes>>,
    url: &http::Uri,
) -> Result<Vec<u8>, String> {
    let response = client.get(url.clone()).await.map_err(|e| reasons(&e))?;
    if !response.status().is_success() {
        return Err(format!("the answer is {}", response.status()));
    }
    let body = Limited::new(response.into_body(), MOST_BYTES)
        .collect()
        .await;
    body.map(|b| b.to_bytes().to_vec())
        .map_err(|e| format!("the answer could not be read: {e}"))
}

/// An error with its causes.
fn reasons(error: &dyn std::error::Error) -> String {
    let mut out = error.to_string();
    let mut source = error.source();
    while let Some(e) = source {
        out += &format!(": {e}");
        source = e.source();
    }
    out
}

/// The keys of a set. Those for other uses are left out.
fn parse(text: &[u8]) -> Result<Vec<VerificationKey>, String> {
    if text.len() > MOST_BYTES {
        return Err(format!("a set of keys may have {MOST_BYTES} bytes"));
    }
    let set: JwkSet = serde_json::from_slice(text).map_err(|e| format!("is no JWKS: {e}"))?;
    let keys: Vec<VerificationKey> = set.keys.iter().take(MOST_KEYS).filter_map(key).collect();
    if keys.is_empty() {
        return Err("has no public key for signatures".into());
    }
    Ok(keys)
}

fn key(jwk: &Jwk) -> Option<VerificationKey> {
    use Algorithm::{ES256, ES384, EdDSA, PS256, PS384, PS512, RS256, RS384, RS512};
    let common = &jwk.common;
    if common
        .public_key_use
        .as_ref()
        .is_some_and(|u| *u != PublicKeyUse::Signature)
    {
        return None;
    }
    let mut algorithms = match &jwk.algorithm {
        AlgorithmParameters::RSA(_) => vec![RS256, RS384, RS512, PS256, PS384, PS512],
        AlgorithmParameters::EllipticCurve(p) => match p.curve {
            EllipticCurve::P256 => vec![ES256],
            EllipticCurve::P384 => vec![ES384],
            _ => return None,
        },
        AlgorithmParameters::OctetKeyPair(_) => vec![EdDSA],
        // A secret has no place in a set of public keys.
        AlgorithmParameters::OctetKey(_) => return None,
    };
    if let Some(named) = common.key_algorithm {
        let named = named.to_string();
        algorithms.retain(|a| format!("{a:?}") == named);
    }
    if algorithms.is_empty() || common.key_id.as_ref().is_some_and(|id| id.len() > MOST_ID) {
        return None;
    }
    Some(VerificationKey {
        id: common.key_id.clone(),
        algorithms,
        key: DecodingKey::from_jwk(jwk).ok()?,
    })
}
