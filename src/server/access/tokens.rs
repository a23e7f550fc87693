//! Bearer tokens: the principal of a token, checked against keys that the operator gave.
//!
//! Algorithms with a shared secret are accepted only for the secret of the operator's own file, and those with a pair
//! of keys only for the keys of a JWKS, so a public key is never mistaken for a secret.

use super::caller::{Caller, Claims, Identity};
use super::keys::{KeySource, VerificationKey};
use super::roles::{Role, Roles};
use crate::config::Config;
use jsonwebtoken::errors::ErrorKind;
use jsonwebtoken::{
    Algorithm, DecodingKey, EncodingKey, Header, Validation, decode, decode_header,
};
use serde::{Deserialize, Serialize};
use sinew_wire::status::Fault;
use std::collections::HashMap;
use std::fs::OpenOptions;
use std::io::{self, Write as _};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

/// Algorithms accepted for keys of a JWKS.
const ASYMMETRIC: [Algorithm; 9] = [
    Algorithm::RS256,
    Algorithm::RS384,
    Algorithm::RS512,
    Algorithm::PS256,
    Algorithm::PS384,
    Algorithm::PS512,
    Algorithm::ES256,
    Algorithm::ES384,
    Algorithm::EdDSA,
];
/// The algorithm of the shared secret.
const SHARED: Algorithm = Algorithm::HS256;
/// Bytes of a shared secret: as many as the hash has.
const SECRET_BYTES: usize = 32;
/// Bytes of a token.
const MOST_TOKEN: usize = 4096;
/// Bytes of a principal's name.
const MOST_SUBJECT: usize = 200;
/// Entries of a list of claims.
const MOST_CLAIMS: usize = 64;
/// Tokens whose signature was checked before and that are remembered: 4 MiB at most.
const REMEMBERED: usize = 1024;

/// Claims of a token.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TokenClaims {
    /// Its principal.
    pub sub: String,
    /// Expiry, s since 1970.
    pub exp: u64,
    /// Roles by name; unknown ones are meant for other servers.
    #[serde(default)]
    pub roles: Vec<String>,
    /// Worlds and clips to which the roles apply; absent: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worlds: Option<Vec<String>>,
}

/// Checks tokens.
pub struct Tokens {
    keys: Option<Arc<KeySource>>,
    secret: Option<DecodingKey>,
    issuer: String,
    audience: String,
    leeway: Duration,
    checked: Mutex<Checked>,
}

#[derive(Default)]
struct Checked {
    /// Version of the keys with which they were checked.
    keys: u64,
    by_token: HashMap<String, Identity>,
}

impl std::fmt::Debug for Tokens {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Tokens") // keys stay out of messages
    }
}

fn refused(reason: &'static str, message: impl Into<String>) -> Fault {
    Fault::Unauthenticated {
        reason,
        message: message.into(),
    }
}

impl Tokens {
    /// Tokens as configured; `None` without keys.
    ///
    /// # Errors
    /// A file cannot be read or holds no keys.
    pub fn new(config: &Config) -> Result<Option<Self>, String> {
        if config.jwt_keys.is_empty() && config.jwt_secret_file.is_empty() {
            return Ok(None);
        }
        let keys = if config.jwt_keys.is_empty() {
            None
        } else {
            Some(KeySource::new(config)?)
        };
        let secret = if config.jwt_secret_file.is_empty() {
            None
        } else {
            let secret = read_secret(Path::new(&config.jwt_secret_file))?;
            Some(DecodingKey::from_secret(&secret))
        };
        Ok(Some(Self {
            keys,
            secret,
            issuer: config.jwt_issuer.clone(),
            audience: config.jwt_audience.clone(),
            leeway: Duration::from_secs_f64(config.jwt_leeway_s),
            checked: Mutex::default(),
        }))
    }

    /// Keeps the keys fresh for as long as it is polled.
    pub async fn refresh(&self) {
        match &self.keys {
            Some(keys) => keys.refresh_forever().await,
            None => std::future::pending().await,
        }
    }

    fn keys_version(&self) -> u64 {
        self.keys.as_ref().map_or(0, |k| k.version())
    }

    /// The identity of a token.
    ///
    /// # Errors
    /// The token does not prove it, or no longer does.
    pub async fn identify(&self, token: &str) -> Result<Identity, Fault> {
        if token.len() > MOST_TOKEN {
            return Err(refused(
                "TOKEN_TOO_LARGE",
                format!("a token may have {MOST_TOKEN} bytes"),
            ));
        }
        if let Some(known) = self.known(token) {
            return Ok(known);
        }
        let header = decode_header(token)
            .map_err(|_| refused("TOKEN_MALFORMED", "the bearer token is no JSON web token"))?;
        let version = self.keys_version();
        let claims = match (header.alg, &self.secret, &self.keys) {
            (SHARED, Some(secret), _) => self.check(token, secret, SHARED)?,
            (alg, _, Some(keys)) if ASYMMETRIC.contains(&alg) => {
                let key: VerificationKey = keys.find(header.kid.as_deref(), alg).await?;
                self.check(token, &key.key, alg)?
            }
            _ => {
                return Err(refused(
                    "TOKEN_ALGORITHM",
                    "the token is signed with an algorithm that this server has no keys for",
                ));
            }
        };
        let identity = identity(claims, self.leeway)?;
        let mut checked = self.checked.lock().unwrap_or_else(PoisonError::into_inner);
        if checked.keys != version || checked.by_token.len() >= REMEMBERED {
            checked.by_token.clear();
            checked.keys = version;
        }
        checked.by_token.insert(token.to_owned(), identity.clone());
        Ok(identity)
    }

    /// A token that was checked before and has not expired.
    fn known(&self, token: &str) -> Option<Identity> {
        let checked = self.checked.lock().unwrap_or_else(PoisonError::into_inner);
        let known = checked.by_token.get(token)?;
        let valid = known.expires.is_none_or(|at| at > SystemTime::now());
        (valid && checked.keys == self.keys_version()).then(|| known.clone())
    }

    fn check(&self, token: &str, key: &DecodingKey, alg: Algorithm) -> Result<TokenClaims, Fault> {
        let mut rules = Validation::new(alg);
        rules.leeway = self.leeway.as_secs();
        rules.validate_nbf = true;
        rules.set_required_spec_claims(&["exp", "sub", "aud"]);
        rules.set_audience(&[&self.audience]);
        if !self.issuer.is_empty() {
            rules.set_required_spec_claims(&["exp", "sub", "aud", "iss"]);
            rules.set_issuer(&[&self.issuer]);
        }
        decode::<TokenClaims>(token, key, &rules)
            .map(|data| data.claims)
            .map_err(|e| match e.kind() {
                ErrorKind::ExpiredSignature => Caller::expired(),
                ErrorKind::ImmatureSignature => {
                    refused("TOKEN_NOT_YET_VALID", "the token is not valid yet")
                }
                ErrorKind::InvalidAudience => refused(
                    "TOKEN_AUDIENCE",
                    format!("the token is not for the audience {:?}", self.audience),
                ),
                ErrorKind::InvalidIssuer => refused(
                    "TOKEN_ISSUER",
                    format!("the token is not issued by {:?}", self.issuer),
                ),
                ErrorKind::InvalidSignature => refused(
                    "TOKEN_SIGNATURE",
                    "the token is not signed with a key of this server",
                ),
                ErrorKind::InvalidAlgorithm | ErrorKind::InvalidAlgorithmName => refused(
                    "TOKEN_ALGORITHM",
                    "the token is signed with another algorithm than its key is for",
                ),
                ErrorKind::MissingRequiredClaim(name) => {
                    refused("TOKEN_MALFORMED", format!("the token has no claim {name:?}"))
                }
                _ => refused(
                    "TOKEN_MALFORMED",
                    "the bearer token is no JSON web token with `sub`, `exp`, and lists of `roles` and `worlds`",
                ),
            })
    }
}

/// The identity in the claims.
fn identity(claims: TokenClaims, leeway: Duration) -> Result<Identity, Fault> {
    let lists = [Some(&claims.roles), claims.worlds.as_ref()];
    let too_long =
        |l: &Vec<String>| l.len() > MOST_CLAIMS || l.iter().any(|c| c.len() > MOST_CLAIMS);
    if lists.into_iter().flatten().any(too_long) {
        return Err(refused(
            "TOKEN_MALFORMED",
            format!("`roles` and `worlds` may have {MOST_CLAIMS} entries of {MOST_CLAIMS} bytes"),
        ));
    }
    let roles = claims.roles.iter().filter_map(|r| Role::named(r));
    Ok(Identity {
        principal: format!("user:{}", subject(&claims.sub)?).into(),
        claims: Arc::new(Claims {
            roles: roles.chain([Role::Member]).collect::<Roles>(),
            names: claims.worlds,
        }),
        // An expiry beyond the end of time counts as none.
        expires: Duration::from_secs(claims.exp)
            .checked_add(leeway)
            .and_then(|after| SystemTime::UNIX_EPOCH.checked_add(after)),
    })
}

/// A name that can stand in messages, logs and grants.
pub(super) fn subject(name: &str) -> Result<&str, Fault> {
    let odd = |c: char| c.is_control() || c.is_whitespace();
    if name.is_empty() || name.len() > MOST_SUBJECT || name.contains(odd) {
        return Err(refused(
            "SUBJECT_NOT_ALLOWED",
            format!("a name of a principal has 1 to {MOST_SUBJECT} bytes without spaces"),
        ));
    }
    Ok(name)
}

/// The shared secret of a file: 64 hexadecimal digits.
///
/// # Errors
/// It cannot be read, or is something else.
pub fn read_secret(path: &Path) -> Result<Vec<u8>, String> {
    let shown = path.display();
    let text = std::fs::read_to_string(path).map_err(|e| format!("{shown}: {e}"))?;
    match hex::decode(text.trim()) {
        Ok(secret) if secret.len() >= SECRET_BYTES => Ok(secret),
        // The text itself stays out of the message.
        _ => Err(format!(
            "{shown}: a secret is at least {} hexadecimal digits, as `sinew token --new-key` writes it",
            2 * SECRET_BYTES
        )),
    }
}

/// Writes a new secret to a new file, readable only by its owner.
///
/// # Errors
/// There is one already, or it cannot be written.
pub fn create_secret(path: &Path) -> io::Result<()> {
    let mut secret = [0u8; SECRET_BYTES];
    fill_random(&mut secret)?;
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        options.mode(0o600);
    }
    let mut file = options.open(path)?;
    writeln!(file, "{}", hex::encode(secret))
}

/// Unguessable bytes.
///
/// # Errors
/// The system has none.
pub fn fill_random(bytes: &mut [u8]) -> io::Result<()> {
    let provider = rustls::crypto::aws_lc_rs::default_provider();
    let filled = provider.secure_random.fill(bytes);
    filled.map_err(|_| io::Error::other("the system has no random numbers"))
}

/// Content of a new token, without its signature.
#[derive(Clone, Debug)]
pub struct NewToken {
    /// Its principal.
    pub subject: String,
    /// Its roles.
    pub roles: Vec<Role>,
    /// Worlds and clips to which they apply; `None`: all.
    pub worlds: Option<Vec<String>>,
    /// Its lifetime.
    pub lifetime: Duration,
    /// The server for which it is meant.
    pub audience: String,
    /// Its issuer; empty: not stated.
    pub issuer: String,
}

#[derive(Serialize)]
struct Signed<'a> {
    #[serde(flatten)]
    claims: &'a TokenClaims,
    aud: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    iss: &'a str,
    iat: u64,
}

/// Signs a token with a shared secret.
///
/// # Errors
/// A name that is not allowed.
pub fn sign(secret: &[u8], token: &NewToken) -> Result<String, String> {
    let now = SystemTime::now()
        .duration_since(SystemTime::UNIX_EPOCH)
        .map_err(|_| "the clock is before 1970".to_owned())?;
    let claims = TokenClaims {
        sub: subject(&token.subject)
            .map_err(|e| e.to_string())?
            .to_owned(),
        exp: now.saturating_add(token.lifetime).as_secs(),
        roles: token.roles.iter().map(|r| r.name().to_owned()).collect(),
        worlds: token.worlds.clone(),
    };
    let signed = Signed {
        claims: &claims,
        aud: &token.audience,
        iss: &token.issuer,
        iat: now.as_secs(),
    };
    jsonwebtoken::encode(
        &Header::new(SHARED),
        &signed,
        &EncodingKey::from_secret(secret),
    )
    .map_err(|e| e.to_string())
}
