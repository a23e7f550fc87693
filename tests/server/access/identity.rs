//! Identity: TLS, client certificates, tokens, and the limits of each.

use crate::access::support::{Authority, Files, Guarded, refusal, token, world};
use jsonwebtoken::{Algorithm, EncodingKey, Header, encode};
use rcgen::{KeyPair, PKCS_ECDSA_P256_SHA256, PublicKeyData, SanType};
use serde_json::{Value, json};
use sinew_client::{Client, Credentials};
use sinew_server::access::roles::Role;
use sinew_server::config::{Config, ConfigError};
use sinew_wire::pb;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tonic::{Code, Status};

fn now() -> u64 {
    SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap()
        .as_secs()
}

async fn who(client: &Client) -> Result<pb::GetCallerResponse, Status> {
    let request = pb::GetCallerRequest::default();
    client
        .access()
        .get_caller(request)
        .await
        .map(tonic::Response::into_inner)
}

async fn refused(server: &Guarded, token: String) -> String {
    let e = who(&server.bearing(token).await).await.unwrap_err();
    let (code, reason) = refusal(&e);
    assert_eq!(code, Code::Unauthenticated, "{e:?}");
    reason
}

fn base64url(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    let mut out = String::new();
    for chunk in bytes.chunks(3) {
        let n = chunk.iter().fold(0u32, |n, b| n << 8 | u32::from(*b)) << (8 * (3 - chunk.len()));
        for i in 0..=chunk.len() {
            out.push(DIGITS[(n >> (18 - 6 * i)) as usize & 63] as char);
        }
    }
    out
}

/// A pair of keys of an issuer, as its JWKS shows the public one.
struct Issuer {
    id: String,
    key: KeyPair,
}

impl Issuer {
    fn new(id: &str) -> Self {
        Self {
            id: id.into(),
            key: KeyPair::generate_for(&PKCS_ECDSA_P256_SHA256).unwrap(),
        }
    }

    fn jwk(&self) -> Value {
        let point = self.key.der_bytes(); // 4, x, y
        json!({
            "kty": "EC", "crv": "P-256", "use": "sig", "alg": "ES256", "kid": self.id,
            "x": base64url(&point[1..33]), "y": base64url(&point[33..65]),
        })
    }

    fn sign(&self, claims: &Value) -> String {
        let mut header = Header::new(Algorithm::ES256);
        header.kid = Some(self.id.clone());
        let key = EncodingKey::from_ec_der(&self.key.serialize_der());
        encode(&header, claims, &key).unwrap()
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_token_says_who_someone_is_and_without_one_nobody_is_served() {
    let server = Guarded::start(&[]).await;
    let alice = server.client("alice", &[Role::Creator], None).await;
    let found = who(&alice).await.unwrap();
    assert_eq!(found.principal, "user:alice");
    assert_eq!(
        found.roles,
        [pb::Role::Member as i32, pb::Role::Creator as i32]
    );
    assert!(found.expire_time.is_some());
    // Health is open to all callers, everything else only to authenticated ones.
    let nobody = server.connect(Credentials::default()).await.unwrap();
    assert!(nobody.serves().await.unwrap());
    let e = who(&nobody).await.unwrap_err();
    assert_eq!(
        refusal(&e),
        (Code::Unauthenticated, "CREDENTIALS_REQUIRED".into())
    );
    // Without TLS there is no answer at all.
    if let Ok(plain) = Client::connect(&server.address.to_string()).await {
        assert!(plain.serves().await.is_err());
    }
    // A client that trusts other roots does not talk to this server.
    let stranger = Credentials {
        ca: Some(Authority::new("other").pem().into_bytes()),
        ..Default::default()
    };
    let address = server.address.to_string();
    assert!(Client::connect_with(&address, &stranger).await.is_err());
}

#[tokio::test(flavor = "multi_thread")]
async fn tokens_that_prove_nothing_are_refused() {
    let server = Guarded::start(&[]).await;
    let key = EncodingKey::from_secret(&server.secret);
    let signed = |claims: Value| encode(&Header::new(Algorithm::HS256), &claims, &key).unwrap();
    let good = json!({ "sub": "a", "aud": "sinew", "exp": now() + 60 });
    let with = |name: &str, value: Value| {
        let mut claims = good.clone();
        claims[name] = value;
        signed(claims)
    };
    assert!(
        who(&server.bearing(signed(good.clone())).await)
            .await
            .is_ok()
    );
    // A token whose expiry lies at the end of time stays valid.
    for end in [1u64 << 40, i64::MAX as u64, u64::MAX - 1, u64::MAX] {
        let client = server.bearing(with("exp", json!(end))).await;
        assert!(who(&client).await.is_ok(), "{end}");
    }
    for (token, reason) in [
        (with("exp", json!(now() - 3600)), "TOKEN_EXPIRED"),
        (with("nbf", json!(now() + 3600)), "TOKEN_NOT_YET_VALID"),
        (with("aud", json!("other")), "TOKEN_AUDIENCE"),
        (with("aud", Value::Null), "TOKEN_MALFORMED"),
        (with("exp", Value::Null), "TOKEN_MALFORMED"),
        (with("sub", json!("")), "SUBJECT_NOT_ALLOWED"),
        (with("sub", json!("a\nb")), "SUBJECT_NOT_ALLOWED"),
        (with("sub", json!("a b")), "SUBJECT_NOT_ALLOWED"),
        (with("sub", json!(7)), "TOKEN_MALFORMED"),
        (with("worlds", json!("studio")), "TOKEN_MALFORMED"),
        (with("roles", json!(vec!["x"; 65])), "TOKEN_MALFORMED"),
        (with("roles", json!(["x".repeat(5000)])), "TOKEN_TOO_LARGE"),
        (
            token(&[7; 32], "a", &[Role::Owner], None),
            "TOKEN_SIGNATURE",
        ),
        ("nonsense".into(), "TOKEN_MALFORMED"),
        ("a.b.c".into(), "TOKEN_MALFORMED"),
        (String::new(), "TOKEN_MALFORMED"),
    ] {
        assert_eq!(refused(&server, token.clone()).await, reason, "{token:.60}");
    }
    // A token must not choose the algorithm.
    let part = |v: Value| base64url(v.to_string().as_bytes());
    let none = format!(
        "{}.{}.",
        part(json!({ "alg": "none", "typ": "JWT" })),
        part(good.clone())
    );
    assert_eq!(refused(&server, none).await, "TOKEN_MALFORMED");
    for alg in [Algorithm::HS384, Algorithm::HS512] {
        let other = encode(&Header::new(alg), &good, &key).unwrap();
        assert_eq!(refused(&server, other).await, "TOKEN_ALGORITHM");
    }
    let issuer = Issuer::new("k");
    assert_eq!(
        refused(&server, issuer.sign(&good)).await,
        "TOKEN_ALGORITHM",
        "no public keys here"
    );
    // A refusal reveals nothing of the token.
    let secret = with("aud", json!("other"));
    let e = who(&server.bearing(secret.clone()).await)
        .await
        .unwrap_err();
    assert!(!format!("{e:?}").contains(&secret[..40]), "{e:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_public_key_is_no_secret() {
    let files = Files::new();
    let issuer = Issuer::new("k1");
    let set = json!({ "keys": [issuer.jwk()] }).to_string();
    let keys = files.write("keys.json", &set);
    let server = Guarded::start(&[("jwt_keys", &keys), ("jwt_secret_file", "")]).await;
    let claims = json!({ "sub": "a", "aud": "sinew", "exp": now() + 60, "roles": ["owner"] });
    let found = who(&server.bearing(issuer.sign(&claims)).await)
        .await
        .unwrap();
    assert_eq!(found.principal, "user:a");
    // Signed with the public key as the secret, in each of its forms.
    let point = issuer.key.der_bytes().to_vec();
    let forms = [
        point,
        issuer.key.public_key_pem().into_bytes(),
        set.into_bytes(),
    ];
    for public in forms {
        let mut header = Header::new(Algorithm::HS256);
        header.kid = Some("k1".into());
        let forged = encode(&header, &claims, &EncodingKey::from_secret(&public)).unwrap();
        assert_eq!(refused(&server, forged).await, "TOKEN_ALGORITHM");
    }
    let other = Issuer::new("k1");
    assert_eq!(
        refused(&server, other.sign(&claims)).await,
        "TOKEN_SIGNATURE"
    );
    let unknown = Issuer::new("k2");
    assert_eq!(
        refused(&server, unknown.sign(&claims)).await,
        "TOKEN_KEY_UNKNOWN"
    );
}

/// A server of a set of keys that counts how often it is asked.
async fn key_server(set: Arc<std::sync::Mutex<String>>) -> (String, Arc<AtomicUsize>) {
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let url = format!("http://{}/keys", listener.local_addr().unwrap());
    let asked = Arc::new(AtomicUsize::new(0));
    let count = asked.clone();
    tokio::spawn(async move {
        loop {
            let (mut stream, _) = listener.accept().await.unwrap();
            let mut request = [0; 4096];
            let _ = stream.read(&mut request).await;
            count.fetch_add(1, Ordering::SeqCst);
            let body = set.lock().unwrap().clone();
            let head = format!(
                "HTTP/1.1 200 OK\r\ncontent-length: {}\r\nconnection: close\r\n\r\n",
                body.len()
            );
            let _ = stream.write_all((head + &body).as_bytes()).await;
        }
    });
    (url, asked)
}

#[tokio::test(flavor = "multi_thread")]
async fn keys_of_a_url_are_fetched_at_the_start_and_not_for_every_unknown_key() {
    let first = Issuer::new("k1");
    let set = Arc::new(std::sync::Mutex::new(
        json!({ "keys": [first.jwk()] }).to_string(),
    ));
    let (url, asked) = key_server(set.clone()).await;
    let more = [
        ("jwt_keys", url.as_str()),
        ("jwt_issuer", "https://id.example"),
    ];
    let server = Guarded::start(&more).await;
    let mut claims =
        json!({ "sub": "a", "aud": "sinew", "exp": now() + 60, "iss": "https://id.example" });
    assert!(
        who(&server.bearing(first.sign(&claims)).await)
            .await
            .is_ok()
    );
    assert_eq!(asked.load(Ordering::SeqCst), 1);
    // A rush of unknown keys does not become a rush on the issuer.
    let unknown = Issuer::new("k2");
    for _ in 0..20 {
        assert_eq!(
            refused(&server, unknown.sign(&claims)).await,
            "TOKEN_KEY_UNKNOWN"
        );
    }
    assert_eq!(
        asked.load(Ordering::SeqCst),
        1,
        "at most once in ten seconds"
    );
    claims["iss"] = json!("https://evil.example");
    assert_eq!(refused(&server, first.sign(&claims)).await, "TOKEN_ISSUER");
    // The secret counts beside the keys, for tokens of that issuer.
    let foreign = token(&server.secret, "b", &[], None);
    assert_eq!(
        refused(&server, foreign).await,
        "TOKEN_MALFORMED",
        "no issuer"
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn a_set_of_keys_without_end_is_given_up() {
    let padding = " ".repeat(300 * 1024);
    let first = Issuer::new("k1");
    let huge = json!({ "keys": [first.jwk()] }).to_string() + &padding;
    let (url, asked) = key_server(Arc::new(std::sync::Mutex::new(huge))).await;
    let server = Guarded::start(&[("jwt_keys", url.as_str())]).await;
    let claims = json!({ "sub": "a", "aud": "sinew", "exp": now() + 60 });
    assert_eq!(
        refused(&server, first.sign(&claims)).await,
        "TOKEN_KEY_UNKNOWN"
    );
    assert_eq!(asked.load(Ordering::SeqCst), 1);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_certificate_says_who_a_client_is() {
    let uri = "spiffe://studio-a/lead";
    let principal = format!("cert:{uri}");
    let server = Guarded::start(&[("cert_owners", principal.as_str())]).await;
    let lead = SanType::URI(uri.try_into().unwrap());
    let dns = SanType::DnsName("rig-7.studio-a.example".try_into().unwrap());
    let with = |(certificate, key): (String, String)| {
        let certificate = Some((certificate.into_bytes(), key.into_bytes()));
        Credentials {
            certificate,
            ..Default::default()
        }
    };
    for (names, common, expected) in [
        (vec![dns.clone(), lead.clone()], "x", principal.as_str()),
        (vec![dns], "x", "cert:rig-7.studio-a.example"),
        (vec![], "camera-3", "cert:camera-3"),
    ] {
        let client = server
            .connect(with(server.root.issue(common, names)))
            .await
            .unwrap();
        let found = who(&client).await.unwrap();
        assert_eq!(found.principal, expected);
        let creates = client
            .worlds()
            .create_world(pb::CreateWorldRequest::default())
            .await;
        assert_eq!(
            creates.is_ok(),
            expected == principal,
            "{expected}: {creates:?}"
        );
    }
    // A certificate from other roots is ignored.
    let other = Authority::new("other").issue("camera-3", vec![]);
    if let Ok(client) = server.connect(with(other)).await {
        assert!(who(&client).await.is_err());
    }
    // A token of the same name is another principal.
    let token = server.client(uri, &[], None).await;
    assert_eq!(who(&token).await.unwrap().principal, format!("user:{uri}"));
    let denied = token
        .worlds()
        .create_world(pb::CreateWorldRequest::default())
        .await;
    assert_eq!(refusal(&denied.unwrap_err()).1, "ROLE_REQUIRED");
}

#[tokio::test(flavor = "multi_thread")]
async fn another_root_of_clients_needs_no_restart() {
    let server = Guarded::start(&[("tls_require_client_cert", "true")]).await;
    let next = Authority::new("next root");
    let of = |root: &Authority| {
        let (certificate, key) = root.issue("alice", Vec::new());
        Credentials {
            certificate: Some((certificate.into_bytes(), key.into_bytes())),
            ..Default::default()
        }
    };
    let (old, new) = (of(&server.root), of(&next));
    let served = async |credentials: &Credentials| match server.connect(credentials.clone()).await {
        Ok(client) => who(&client).await.is_ok(),
        Err(_) => false,
    };
    let alice = server.connect(old.clone()).await.unwrap();
    assert_eq!(who(&alice).await.unwrap().principal, "cert:alice");
    assert!(!served(&new).await);
    let tls = server.app.access.tls.clone().unwrap();
    let touched = |text: &str| {
        let file = std::fs::File::options()
            .append(true)
            .open(server.files.write("root.pem", text));
        // Within the resolution of the file system's clock.
        let later =
            std::time::SystemTime::now() + std::time::Duration::from_secs(text.len() as u64);
        file.unwrap().set_modified(later).unwrap();
        tls.read_again();
    };
    // Files that cannot be read change nothing.
    touched("no certificate");
    assert!(served(&old).await && !served(&new).await);
    touched(&[server.root.pem(), next.pem()].concat());
    assert!(served(&old).await && served(&new).await);
    touched(&next.pem());
    assert!(!served(&old).await && served(&new).await);
    // Existing connections stay.
    assert_eq!(who(&alice).await.unwrap().principal, "cert:alice");
}

#[tokio::test(flavor = "multi_thread")]
async fn who_never_agrees_on_tls_keeps_nobody_waiting() {
    let server = Guarded::start(&[("first_request_s", "0.3")]).await;
    let mut silent = Vec::new();
    for _ in 0..50 {
        silent.push(
            tokio::net::TcpStream::connect(server.address)
                .await
                .unwrap(),
        );
    }
    let client = server.client("a", &[], None).await;
    assert!(who(&client).await.is_ok());
    // They are closed when their time for a first request is over.
    let mut buffer = [0; 16];
    for mut stream in silent {
        assert!(matches!(stream.read(&mut buffer).await, Ok(0) | Err(_)));
    }
    // A client that speaks another protocol is disconnected, and does not hang.
    let mut plain = tokio::net::TcpStream::connect(server.address)
        .await
        .unwrap();
    plain
        .write_all(b"GET / HTTP/1.1\r\nhost: localhost\r\n\r\n")
        .await
        .unwrap();
    let mut answer = Vec::new();
    let _ = plain.read_to_end(&mut answer).await;
    assert!(!answer.starts_with(b"HTTP"));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stream_ends_when_its_token_does() {
    let server = Guarded::start(&[("jwt_leeway_s", "0")]).await;
    let owner = server.client("owner", &[Role::Creator], None).await;
    let world = world(&owner, "w", false).await;
    let key = EncodingKey::from_secret(&server.secret);
    let claims = json!({ "sub": "v", "aud": "sinew", "exp": now() + 2, "roles": ["viewer"] });
    let short = encode(&Header::new(Algorithm::HS256), &claims, &key).unwrap();
    let viewer = server.bearing(short).await;
    let mut frames = viewer
        .watch(&world, pb::View::default(), None)
        .await
        .unwrap();
    let e = loop {
        match frames.message().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    };
    assert_eq!(refusal(&e), (Code::Unauthenticated, "TOKEN_EXPIRED".into()));
}

#[test]
fn an_address_that_others_reach_needs_authentication_and_tls() {
    let load = |flags: &[(&str, &str)]| {
        let flags = flags
            .iter()
            .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()));
        Config::load(None, std::iter::empty(), &flags.collect::<Vec<_>>())
    };
    let open = ("listen", "0.0.0.0:1");
    let tls = [("tls_cert", "c.pem"), ("tls_key", "k.pem")];
    let secret = ("jwt_secret_file", "s");
    assert!(matches!(load(&[open]), Err(ConfigError::NotLoopback(_))));
    assert!(
        matches!(
            load(&[open, tls[0], tls[1]]),
            Err(ConfigError::NotLoopback(_))
        ),
        "TLS is no identity"
    );
    assert!(matches!(
        load(&[open, secret]),
        Err(ConfigError::NotEncrypted(_))
    ));
    assert!(load(&[open, tls[0], tls[1], secret]).is_ok());
    assert!(load(&[open, tls[0], tls[1], ("tls_client_ca", "r.pem")]).is_ok());
    assert!(load(&[open, secret, ("insecure_bind_any", "true")]).is_ok());
    assert!(matches!(
        load(&[tls[0]]),
        Err(ConfigError::Incomplete("tls_cert", "tls_key"))
    ));
    assert!(matches!(
        load(&[("tls_client_ca", "r.pem")]),
        Err(ConfigError::Incomplete(..))
    ));
    // The message states the remedy.
    let message = load(&[open]).unwrap_err().to_string();
    assert!(
        message.contains("tls_cert") && message.contains("--insecure-bind-any"),
        "{message}"
    );
}
