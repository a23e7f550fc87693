//! A server with certificates and keys made here, and clients of it.

use rcgen::{BasicConstraints, CertificateParams, CertifiedIssuer, DnType, IsCa, KeyPair, SanType};
use sinew_client::{Client, ConnectError, Credentials};
use sinew_server::access::roles::Role;
use sinew_server::access::tokens::{NewToken, create_secret, read_secret, sign};
use sinew_server::app::App;
use sinew_server::config::Config;
use sinew_wire::pb;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use tonic::{Code, Status};
use tonic_types::StatusExt;

/// A directory of one test, removed at its end.
pub struct Files(pub PathBuf);

impl Files {
    pub fn new() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let n = NEXT.fetch_add(1, Ordering::Relaxed);
        let dir = std::env::temp_dir().join(format!("sinew-access-{}-{n}", std::process::id()));
        std::fs::create_dir_all(&dir).unwrap();
        Self(dir)
    }

    pub fn path(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    pub fn write(&self, name: &str, text: &str) -> String {
        std::fs::write(self.0.join(name), text).unwrap();
        self.path(name)
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A root that issues certificates.
pub struct Authority(CertifiedIssuer<'static, KeyPair>);

impl Authority {
    pub fn new(name: &str) -> Self {
        let mut params = CertificateParams::default();
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.distinguished_name.push(DnType::CommonName, name);
        let key = KeyPair::generate().unwrap();
        Self(CertifiedIssuer::self_signed(params, key).unwrap())
    }

    pub fn pem(&self) -> String {
        self.0.pem()
    }

    /// Certificate and key for these names.
    pub fn issue(&self, common: &str, names: Vec<SanType>) -> (String, String) {
        let mut params = CertificateParams::default();
        params.subject_alt_names = names;
        params.distinguished_name.push(DnType::CommonName, common);
        let key = KeyPair::generate().unwrap();
        let certificate = params.signed_by(&key, &self.0).unwrap();
        (certificate.pem(), key.serialize_pem())
    }
}

/// Claims of a token of the shared secret.
pub fn token(secret: &[u8], subject: &str, roles: &[Role], worlds: Option<&[&str]>) -> String {
    let token = NewToken {
        subject: subject.into(),
        roles: roles.to_vec(),
        worlds: worlds.map(|w| w.iter().map(|w| (*w).to_owned()).collect()),
        lifetime: Duration::from_secs(3600),
        audience: "sinew".into(),
        issuer: String::new(),
    };
    sign(secret, &token).unwrap()
}

/// A server with TLS and a shared secret.
pub struct Guarded {
    pub files: Files,
    pub app: Arc<App>,
    pub root: Authority,
    pub secret: Vec<u8>,
    pub address: SocketAddr,
    _stop: tokio::sync::oneshot::Sender<()>,
}

impl Guarded {
    pub async fn start(more: &[(&str, &str)]) -> Self {
        let files = Files::new();
        let secret = files.0.join("secret");
        create_secret(&secret).unwrap();
        let root = Authority::new("test root");
        let ip = SanType::IpAddress([127, 0, 0, 1].into());
        let (certificate, key) = root.issue("server", vec![ip]);
        let cert = files.write("server.pem", &certificate);
        let key = files.write("server.key", &key);
        let ca = files.write("root.pem", &root.pem());
        let secret_file = secret.display().to_string();
        let flags: Vec<_> = [
            ("max_tick_budget", "1000"),
            ("lame_duck_s", "0"),
            ("tls_cert", cert.as_str()),
            ("tls_key", key.as_str()),
            ("tls_client_ca", ca.as_str()),
            ("jwt_secret_file", secret_file.as_str()),
        ]
        .iter()
        .chain(more)
        .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()))
        .collect();
        let config = Config::load(None, std::iter::empty(), &flags).unwrap();
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
        let (signal, stopping) = tokio::sync::watch::channel(false);
        let app = Arc::new(App::new(Arc::new(config), stopping).unwrap());
        let served = app.clone();
        tokio::spawn(async move {
            let shutdown = async move {
                let _ = stopped.await;
            };
            sinew_server::serve(served, listener, shutdown, signal)
                .await
                .unwrap();
        });
        Self {
            secret: read_secret(&secret).unwrap(),
            files,
            app,
            root,
            address,
            _stop: stop,
        }
    }

    pub async fn connect(&self, credentials: Credentials) -> Result<Client, ConnectError> {
        let credentials = Credentials {
            ca: Some(self.root.pem().into_bytes()),
            ..credentials
        };
        Client::connect_with(&self.address.to_string(), &credentials).await
    }

    /// A client with a bearer token.
    pub async fn bearing(&self, token: String) -> Client {
        let credentials = Credentials {
            token: Some(token),
            ..Default::default()
        };
        self.connect(credentials).await.unwrap()
    }

    /// A client with a token for these roles.
    pub async fn client(&self, subject: &str, roles: &[Role], worlds: Option<&[&str]>) -> Client {
        self.bearing(token(&self.secret, subject, roles, worlds))
            .await
    }
}

pub async fn world(client: &Client, id: &str, paused: bool) -> String {
    let request = pb::CreateWorldRequest {
        world_id: id.into(),
        paused,
        ..Default::default()
    };
    let made = client.worlds().create_world(request).await.unwrap();
    made.into_inner().world.unwrap().name
}

pub async fn figure(client: &Client, world: &str, id: &str) -> String {
    let request = pb::CreateFigureRequest {
        parent: world.into(),
        figure_id: id.into(),
        figure: None,
        ..Default::default()
    };
    let made = client.figures().create_figure(request).await.unwrap();
    made.into_inner().figure.unwrap().name
}

pub async fn grant(client: &Client, world: &str, grant: pb::Grant) -> String {
    let request = pb::CreateGrantRequest {
        parent: world.into(),
        grant_id: String::new(),
        grant: Some(grant),
        ..Default::default()
    };
    let made = client.access().create_grant(request).await.unwrap();
    made.into_inner().grant.unwrap().name
}

pub fn role(principal: &str, role: pb::Role) -> pb::Grant {
    pb::Grant {
        principal: principal.into(),
        roles: vec![role.into()],
        ..Default::default()
    }
}

/// Code and reason of a refusal.
pub fn refusal(status: &Status) -> (Code, String) {
    let details = status.get_error_details();
    let info = details.error_info();
    let reason = info.map(|i| i.reason.clone());
    let reason = reason.unwrap_or_else(|| panic!("every refusal has an ErrorInfo: {status:?}"));
    (status.code(), reason)
}
