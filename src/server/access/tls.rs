//! TLS on the port of the server, and who a client certificate speaks for.
//!
//! Certificate and key are read again when their files change, so that a renewed certificate needs no restart.

use super::caller::{Claims, Identity};
use super::keys::roots;
use super::roles::{Role, Roles};
use super::tokens::subject;
use crate::server::config::Config;
use rustls::crypto::CryptoProvider;
use rustls::pki_types::pem::PemObject as _;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use rustls::server::{ClientHello, ResolvesServerCert, WebPkiClientVerifier};
use rustls::sign::CertifiedKey;
use std::sync::{Arc, PoisonError, RwLock};
use std::time::{Duration, SystemTime};
use tokio_rustls::TlsAcceptor;
use x509_parser::extensions::GeneralName;
use x509_parser::prelude::{FromDer as _, X509Certificate};

/// How often the files are looked at.
const LOOK_EVERY: Duration = Duration::from_secs(30);

/// The certificate that the server shows.
#[derive(Debug)]
struct Shown {
    files: [String; 2],
    provider: Arc<CryptoProvider>,
    key: RwLock<Arc<CertifiedKey>>,
}

impl ResolvesServerCert for Shown {
    fn resolve(&self, _: ClientHello<'_>) -> Option<Arc<CertifiedKey>> {
        Some(
            self.key
                .read()
                .unwrap_or_else(PoisonError::into_inner)
                .clone(),
        )
    }
}

impl Shown {
    fn load(
        [certificates, key]: &[String; 2],
        provider: &CryptoProvider,
    ) -> Result<Arc<CertifiedKey>, String> {
        let chain = CertificateDer::pem_file_iter(certificates)
            .and_then(Iterator::collect::<Result<Vec<_>, _>>)
            .map_err(|e| format!("tls_cert: {certificates}: {e}"))?;
        if chain.is_empty() {
            return Err(format!(
                "tls_cert: {certificates}: there is no certificate in it"
            ));
        }
        // The error of a key says nothing of what is in it.
        let private =
            PrivateKeyDer::from_pem_file(key).map_err(|e| format!("tls_key: {key}: {e}"))?;
        CertifiedKey::from_der(chain, private, provider)
            .map(Arc::new)
            .map_err(|e| format!("tls_key: {key}: {e}"))
    }

    fn changed(&self) -> [Option<SystemTime>; 2] {
        let at = |path: &String| std::fs::metadata(path).and_then(|m| m.modified()).ok();
        [at(&self.files[0]), at(&self.files[1])]
    }

    fn reload(&self) {
        match Self::load(&self.files, &self.provider) {
            Ok(key) => {
                *self.key.write().unwrap_or_else(PoisonError::into_inner) = key;
                tracing::info!("certificate read again");
            }
            Err(error) => tracing::warn!(error, "the certificate stays as it was"),
        }
    }
}

/// TLS as the settings say.
#[derive(Clone)]
pub struct Tls {
    /// Takes connections.
    pub acceptor: TlsAcceptor,
    shown: Arc<Shown>,
}

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
        let provider = Arc::new(rustls::crypto::aws_lc_rs::default_provider());
        let files = [config.tls_cert.clone(), config.tls_key.clone()];
        let key = RwLock::new(Shown::load(&files, &provider)?);
        let shown = Arc::new(Shown {
            files,
            provider: provider.clone(),
            key,
        });
        let server = rustls::ServerConfig::builder_with_provider(provider.clone())
            .with_safe_default_protocol_versions()
            .map_err(|e| e.to_string())?;
        let server = if config.tls_client_ca.is_empty() {
            server.with_no_client_auth()
        } else {
            let named = |e: String| format!("tls_client_ca: {e}");
            let roots = Arc::new(roots(&config.tls_client_ca).map_err(named)?);
            let verifier = WebPkiClientVerifier::builder_with_provider(roots, provider);
            let verifier = if config.tls_require_client_cert {
                verifier
            } else {
                verifier.allow_unauthenticated() // with a token instead, or for health
            };
            let verifier = verifier.build().map_err(|e| named(e.to_string()))?;
            server.with_client_cert_verifier(verifier)
        };
        let mut server = server.with_cert_resolver(shown.clone());
        server.alpn_protocols = vec![b"h2".to_vec(), b"http/1.1".to_vec()];
        Ok(Some(Self {
            acceptor: TlsAcceptor::from(Arc::new(server)),
            shown,
        }))
    }

    /// Reads the certificate again when it changes, for as long as it is polled.
    pub async fn follow_files(&self) {
        let mut last = self.shown.changed();
        loop {
            tokio::time::sleep(LOOK_EVERY).await;
            let now = self.shown.changed();
            if now != last {
                last = now;
                self.shown.reload();
            }
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

    /// Who a certificate that was verified speaks for: its first URI, else its first DNS name, else its common name.
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
