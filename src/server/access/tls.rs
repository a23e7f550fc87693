//! TLS on the port of the server, and the principal of a client certificate.
//!
//! Certificate, key and the roots of clients are read again when their files change, so that neither a renewed
//! certificate nor another root needs a restart. Existing connections stay as they were negotiated.

use super::caller::{Claims, Identity};
use super::keys::roots;
use super::roles::{Role, Roles};
use super::tokens::subject;
use crate::config::Config;
use rustls::crypto::CryptoProvider;
use rustls::pki_types::pem::PemObject as _;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use rustls::server::WebPkiClientVerifier;
use rustls::sign::{CertifiedKey, SingleCertAndKey};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::{Duration, SystemTime};
use tokio_rustls::TlsAcceptor;
use x509_parser::extensions::GeneralName;
use x509_parser::prelude::{FromDer as _, X509Certificate};

/// Interval at which the files are checked.
const LOOK_EVERY: Duration = Duration::from_secs(30);

/// The TLS settings for clients, and the files from which they come.
struct Agreed {
    /// Certificate, key, and roots of clients; empty where there are none.
    files: [String; 3],
    /// Connections without a client certificate are refused.
    required: bool,
    now: RwLock<(TlsAcceptor, [Option<SystemTime>; 3])>,
}

fn changed(files: &[String; 3]) -> [Option<SystemTime>; 3] {
    [0, 1, 2].map(|i: usize| std::fs::metadata(&files[i]).and_then(|m| m.modified()).ok())
}

/// TLS with the present content of the files.
fn load(files: &[String; 3], required: bool) -> Result<TlsAcceptor, String> {
    let [certificates, key, client_ca] = files;
    let provider = Arc::new(rustls::crypto::aws_lc_rs::default_provider());
    let shown = shown(certificates, key, &provider)?;
    let server = rustls::ServerConfig::builder_with_provider(provider.clone())
        .with_safe_default_protocol_versions()
        .map_err(|e| e.to_string())?;
    let server = if client_ca.is_empty() {
        server.with_no_client_auth()
    } else {
        let named = |e: String| format!("tls_client_ca: {e}");
        let roots = Arc::new(roots(client_ca).map_err(named)?);
        let verifier = WebPkiClientVerifier::builder_with_provider(roots, provider);
        let verifier = if required {
            verifier
        } else {
            verifier.allow_unauthenticated() // with a token instead, or for health
        };
        let verifier = verifier.build().map_err(|e| named(e.to_string()))?;
        server.with_client_cert_verifier(verifier)
    };
    let mut server = server.with_cert_resolver(Arc::new(SingleCertAndKey::from(shown)));
    server.alpn_protocols = vec![b"h2".to_vec(), b"http/1.1".to_vec()];
    Ok(TlsAcceptor::from(Arc::new(server)))
}

/// The certificate that the server shows.
fn shown(certificates: &str, key: &str, provider: &CryptoProvider) -> Result<CertifiedKey, String> {
    let chain = CertificateDer::pem_file_iter(certificates)
        .and_then(Iterator::collect::<Result<Vec<_>, _>>)
        .map_err(|e| format!("tls_cert: {certificates}: {e}"))?;
    if chain.is_empty() {
        return Err(format!(
            "tls_cert: {certificates}: there is no certificate in it"
        ));
    }
    // The error of a key reveals nothing of its content.
    let private = PrivateKeyDer::from_pem_file(key).map_err(|e| format!("tls_key: {key}: {e}"))?;
    CertifiedKey::from_der(chain, private, provider).map_err(|e| format!("tls_key: {key}: {e}"))
}

/// TLS as configured.
#[derive(Clone)]
pub struct Tls(Arc<Agreed>);

impl std::fmt::Debug for Tls {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Tls") // keys stay out of messages
    }
}

impl Tls {
    /// `None` without a certificate.
    ///
    /// # Errors
    /// A file cannot be read, or key and certificate do not belong together.
    pub fn new(config: &Config) -> Result<Option<Self>, String> {
        if config.tls_cert.is_empty() {
            return Ok(None);
        }
        let files = [&config.tls_cert, &config.tls_key, &config.tls_client_ca].map(String::clone);
        let required = config.tls_require_client_cert;
        let read = changed(&files);
        let now = RwLock::new((load(&files, required)?, read));
        Ok(Some(Self(Arc::new(Agreed {
            files,
            required,
            now,
        }))))
    }

    /// Accepts connections with the latest settings from the files.
    pub fn acceptor(&self) -> TlsAcceptor {
        let now = self.0.now.read();
        now.unwrap_or_else(PoisonError::into_inner).0.clone()
    }

    /// Reads the files again if one of them has changed since. Unreadable files change nothing. Sessions negotiated
    /// with the previous files are not resumed, so a client admitted by a removed root is no longer admitted.
    pub fn read_again(&self) {
        let read = changed(&self.0.files);
        let mut now = self.0.now.write().unwrap_or_else(PoisonError::into_inner);
        if now.1 == read {
            return;
        }
        now.1 = read;
        match load(&self.0.files, self.0.required) {
            Ok(acceptor) => {
                now.0 = acceptor;
                tracing::info!("certificates read again");
            }
            Err(error) => tracing::warn!(error, "the certificates stay as they were"),
        }
    }

    /// Reads the files again when they change, for as long as it is polled.
    pub async fn follow_files(&self) {
        loop {
            tokio::time::sleep(LOOK_EVERY).await;
            self.read_again();
        }
    }
}

/// Principals of client certificates that have roles for the server.
#[derive(Debug)]
pub struct CertificateRoles {
    owners: Vec<String>,
    creators: Vec<String>,
}

impl CertificateRoles {
    /// As the settings list them.
    pub fn new(config: &Config) -> Self {
        let list = |text: &str| {
            let names = text.split(',').map(|n| n.trim().to_owned());
            names.filter(|n| !n.is_empty()).collect()
        };
        Self {
            owners: list(&config.cert_owners),
            creators: list(&config.cert_creators),
        }
    }

    /// Roles that the settings give to a principal.
    pub fn of(&self, principal: &str) -> Roles {
        let listed =
            |list: &[String], role: Role| list.iter().any(|n| n == principal).then_some(role);
        let roles = [
            Some(Role::Member),
            listed(&self.owners, Role::Owner),
            listed(&self.owners, Role::Creator),
            listed(&self.creators, Role::Creator),
        ];
        roles.into_iter().flatten().collect()
    }

    /// The principal of a verified certificate: its first URI, else its first DNS name, else its common name.
    pub fn identify(&self, certificate: &CertificateDer<'_>) -> Option<Identity> {
        let (_, parsed) = X509Certificate::from_der(certificate).ok()?;
        let names = parsed.subject_alternative_name().ok().flatten();
        let names = names
            .map(|n| n.value.general_names.as_slice())
            .unwrap_or_default();
        let uri = names.iter().find_map(|n| match n {
            GeneralName::URI(uri) => Some(*uri),
            _ => None,
        });
        let dns = names.iter().find_map(|n| match n {
            GeneralName::DNSName(name) => Some(*name),
            _ => None,
        });
        let common = parsed
            .subject()
            .iter_common_name()
            .find_map(|n| n.as_str().ok());
        let principal = format!("cert:{}", subject(uri.or(dns).or(common)?).ok()?);
        let until = u64::try_from(parsed.validity().not_after.timestamp()).unwrap_or(0);
        Some(Identity {
            claims: Arc::new(Claims {
                roles: self.of(&principal),
                names: None,
            }),
            principal: principal.into(),
            expires: SystemTime::UNIX_EPOCH.checked_add(Duration::from_secs(until)),
        })
    }
}
