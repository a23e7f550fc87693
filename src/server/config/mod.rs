//! Settings of the server: defaults, then a TOML file, then environment variables, then flags. Checked as a whole
//! before a port is bound, and printed.

pub mod check;

use super::durable::store::Durability;
use super::tick::scheduler::WorkerPriority;
use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::path::Path;

/// Reason why the settings are not usable.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("{path}: {error}")]
    File {
        /// Its path.
        path: String,
        /// Why.
        error: std::io::Error,
    },
    /// The file is not TOML.
    #[error("{path}: {error}")]
    Toml {
        /// Its path.
        path: String,
        /// Place and problem.
        error: toml::de::Error,
    },
    /// There is no such setting.
    #[error("{source_name}: there is no setting {name:?}{hint}; `sinew config show` lists all")]
    Unknown {
        /// File, environment or flag.
        source_name: String,
        /// The given text.
        name: String,
        /// The setting that may have been meant.
        hint: String,
    },
    /// A value does not have the form that the setting needs.
    #[error("{source_name}: {name} must be {expected}, got {value}")]
    Value {
        /// File, environment or flag.
        source_name: String,
        /// Setting.
        name: &'static str,
        /// The expected form.
        expected: String,
        /// The given text.
        value: String,
    },
    /// The address is not loopback and that was not allowed.
    #[error(
        "listen is {0}, which other machines can reach, and there is no authentication: set tls_cert, tls_key and \
         jwt_secret_file, jwt_keys or tls_client_ca (docs/sharing.md), use a loopback address, or give \
         --insecure-bind-any"
    )]
    NotLoopback(SocketAddr),
    /// The address is not loopback and tokens could be read on their way.
    #[error(
        "listen is {0}, which other machines can reach, and without TLS tokens could be read on their way: set \
         tls_cert and tls_key, or, behind a proxy that does TLS, give --insecure-bind-any"
    )]
    NotEncrypted(SocketAddr),
    /// Some of the settings that belong together are missing.
    #[error("{0} needs {1}")]
    Incomplete(&'static str, &'static str),
}

macro_rules! settings {
    ($($(#[doc = $doc:literal])+ $name:ident: $kind:tt = $default:expr, $least:expr, $most:expr;)*) => {
        /// The settings. Every one can be given in a TOML file and by the flag `--set name=value` under its name, and
        /// in the environment in upper case with the prefix `SINEW_`.
        #[derive(Clone, Debug, PartialEq)]
        pub struct Config {
            $($(#[doc = $doc])+ pub $name: settings!(@type $kind),)*
        }

        impl Default for Config {
            fn default() -> Self {
                Self { $($name: settings!(@default $kind, $default),)* }
            }
        }

        impl Config {
            /// Names, explanations and values, in order.
            pub fn table(&self) -> Vec<(&'static str, &'static str, String)> {
                vec![$((stringify!($name), concat!($($doc),+), self.$name.to_string()),)*]
            }

            /// Integer settings, for `GetServerInfo`.
            pub fn limits(&self) -> Vec<(&'static str, i64)> {
                [$(settings!(@limit $kind, stringify!($name), self.$name)),*].into_iter().flatten().collect()
            }

            /// Returns the name of the setting.
            fn set(
                &mut self,
                source_name: &str,
                name: &str,
                value: &toml::Value,
            ) -> Result<&'static str, ConfigError> {
                match name {
                    $(stringify!($name) => {
                        self.$name = settings!(@parse $kind, value, $least, $most).ok_or_else(|| ConfigError::Value {
                            source_name: source_name.to_owned(),
                            name: stringify!($name),
                            expected: settings!(@expected $kind, $least, $most),
                            value: value.to_string(),
                        })?;
                        Ok(stringify!($name))
                    })*
                    _ => Err(ConfigError::Unknown {
                        source_name: source_name.to_owned(),
                        name: name.to_owned(),
                        hint: hint(source_name, name),
                    }),
                }
            }

            fn set_text(
                &mut self,
                source_name: &str,
                name: &str,
                text: &str,
            ) -> Result<&'static str, ConfigError> {
                let value = match name {
                    $(stringify!($name) => settings!(@text $kind, text),)*
                    _ => toml::Value::String(text.to_owned()),
                };
                self.set(source_name, name, &value)
            }
        }

        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
    (@type int) => { u64 };
    (@type float) => { f64 };
    (@type flag) => { bool };
    (@type addr) => { SocketAddr };
    (@type text) => { String };
    (@default addr, $d:expr) => { $d.parse().expect("the default is an address") };
    (@default text, $d:expr) => { $d.to_owned() };
    (@default $kind:tt, $d:expr) => { $d };
    (@limit int, $name:expr, $value:expr) => { Some(($name, $value as i64)) };
    (@limit $kind:tt, $name:expr, $value:expr) => { None };
    (@parse int, $v:ident, $least:expr, $most:expr) => {
        $v.as_integer().and_then(|n| u64::try_from(n).ok()).filter(|n| ($least..=$most).contains(n))
    };
    (@parse float, $v:ident, $least:expr, $most:expr) => {
        $v.as_float().or_else(|| $v.as_integer().map(|n| n as f64)).filter(|n| ($least..=$most).contains(n))
    };
    (@parse flag, $v:ident, $least:expr, $most:expr) => { $v.as_bool() };
    (@parse addr, $v:ident, $least:expr, $most:expr) => { $v.as_str().and_then(|s| s.parse().ok()) };
    (@parse text, $v:ident, $least:expr, $most:expr) => { $v.as_str().map(str::to_owned) };
    (@text addr, $t:ident) => { toml::Value::String($t.to_owned()) };
    (@text text, $t:ident) => { toml::Value::String($t.to_owned()) };
    (@text $kind:tt, $t:ident) => { typed($t) };
    (@expected int, $least:expr, $most:expr) => {{
        let (least, most): (u64, u64) = ($least, $most);
        format!("a whole number in {least}…{most}")
    }};
    (@expected float, $least:expr, $most:expr) => { format!("a number in {}…{}", $least, $most) };
    (@expected flag, $least:expr, $most:expr) => { "true or false".to_owned() };
    (@expected addr, $least:expr, $most:expr) => { "an address and port, for example 127.0.0.1:7463".to_owned() };
    (@expected text, $least:expr, $most:expr) => { "a text".to_owned() };
}

/// Least similarity of a name to an existing one that it may have meant, 0…1.
const ALIKE: f64 = 0.7;

/// The setting that a misspelt name may have meant, as its source writes it.
fn hint(source_name: &str, name: &str) -> String {
    let environment = source_name.strip_prefix(PREFIX).is_some();
    let others = OTHER_VARIABLES.iter().filter(|_| environment);
    let known = NAMES.iter().chain(others);
    let alike = known.map(|k| (strsim::normalized_damerau_levenshtein(k, name), *k));
    let nearest = alike.max_by(|a, b| a.0.total_cmp(&b.0));
    match nearest.filter(|(alike, _)| *alike >= ALIKE) {
        Some((_, nearest)) if environment => {
            format!("; did you mean {PREFIX}{}?", nearest.to_uppercase())
        }
        Some((_, nearest)) => format!("; did you mean {nearest}?"),
        None => String::new(),
    }
}

/// A text as TOML would read it; other text stays text.
fn typed(text: &str) -> toml::Value {
    text.parse::<i64>()
        .map(toml::Value::Integer)
        .or_else(|_| text.parse::<f64>().map(toml::Value::Float))
        .or_else(|_| text.parse::<bool>().map(toml::Value::Boolean))
        .unwrap_or_else(|_| toml::Value::String(text.to_owned()))
}

settings! {
    /// Address and port of gRPC, gRPC-Web, the status page and the metrics.
    listen: addr = "127.0.0.1:7463", (), ();
    /// Allows an address that other machines can reach without authentication, where any client may do everything, or
    /// without TLS, behind a proxy that does it.
    insecure_bind_any: flag = false, (), ();
    /// PEM file with the certificate of the server and those between it and a root; read again when it changes. Turns
    /// TLS on.
    tls_cert: text = "", (), ();
    /// PEM file with its private key.
    tls_key: text = "", (), ();
    /// PEM file with the roots that issue certificates of clients; such a certificate names the client.
    tls_client_ca: text = "", (), ();
    /// Refuses connections without a client certificate, also those for health.
    tls_require_client_cert: flag = false, (), ();
    /// Principals of client certificates that own every world, as `cert:{name}`; separated by commas.
    cert_owners: text = "", (), ();
    /// Principals of client certificates that may create worlds and clips, likewise.
    cert_creators: text = "", (), ();
    /// Public keys (JWKS) that bearer tokens are checked with: a file, or an address with https or http.
    jwt_keys: text = "", (), ();
    /// PEM file with the roots that the address of the keys is checked with, in place of those of the system.
    jwt_keys_ca: text = "", (), ();
    /// How often the keys are fetched again, s.
    jwt_refresh_s: float = 300.0, 10.0, 86_400.0;
    /// File with the secret of tokens that `sinew token` makes.
    jwt_secret_file: text = "", (), ();
    /// Required issuer of a token (`iss`); empty: anyone with the key.
    jwt_issuer: text = "", (), ();
    /// For whom a token must be (`aud`).
    jwt_audience: text = "sinew", (), ();
    /// How far clocks of issuers may be off, s.
    jwt_leeway_s: float = 30.0, 0.0, 600.0;
    /// Calls per second of one principal, or of one address without authentication; as many may come at once. 0: any
    /// number. Programs on this machine without authentication are not counted.
    max_client_calls_per_s: float = 1000.0, 0.0, 1_000_000.0;
    /// Names by which clients may address the server, other than `localhost` and plain addresses; separated by commas.
    allowed_hosts: text = "", (), ();
    /// Origins of browser pages that may call the server, other than those of `localhost` and its own (for example
    /// `https://app.example`); separated by commas.
    allowed_origins: text = "", (), ();
    /// Serves the viewer at `/`; without it the status page is there.
    viewer: flag = true, (), ();
    /// Directory in which worlds and clips outlive the server; empty: they end with it.
    data_dir: text = "", (), ();
    /// How states of worlds go to disk: `none` (only at orderly ends), `group` (what comes within 10 ms together) or
    /// `each` (at once).
    durability: text = "group", (), ();
    /// Worlds that are let out of quarantine at this start; separated by commas.
    release_worlds: text = "", (), ();
    /// Seconds of each world's history kept in memory for rewinding, forking and replay. 0 disables it.
    memory_s: float = 60.0, 0.0, 86_400.0;
    /// Bytes of the past of one world in memory; 0: none.
    max_world_memory_bytes: int = 33_554_432, 0, 1_099_511_627_776;
    /// Bytes of the past of all worlds in memory, but for the last checkpoint of each and what followed.
    max_memory_bytes: int = 134_217_728, 0, 1_099_511_627_776;
    /// Recordings of all worlds at a time.
    max_recordings: int = 64, 1, 100_000;
    /// Bytes of one recording in memory; one that has more is ended.
    max_recording_bytes: int = 134_217_728, 1_048_576, 1_099_511_627_776;
    /// History of worlds that is kept on disk, s.
    history_s: float = 60.0, 5.0, 86_400.0;
    /// Bytes of history of one world.
    max_world_history_bytes: int = 268_435_456, 1_048_576, 1_099_511_627_776;
    /// Bytes of history of all worlds.
    max_history_bytes: int = 2_147_483_648, 1_048_576, 1_099_511_627_776;
    /// Bytes that wait for the disk; what comes on top is not written, and counted.
    max_store_queue_bytes: int = 67_108_864, 1_048_576, 4_294_967_296;
    /// Which messages are logged, as `level` or `target=level` lists.
    log: text = "info", (), ();
    /// Logs as JSON lines.
    log_json: flag = false, (), ();
    /// Address of an OpenTelemetry collector that takes traces by gRPC (for example `http://127.0.0.1:4317`); empty:
    /// none. Needs a server that is built with the feature `otlp`.
    otlp_endpoint: text = "", (), ();
    /// Share of calls that are traced.
    otlp_call_share: float = 1.0, 0.0, 1.0;
    /// Share of ticks that are traced.
    otlp_tick_share: float = 0.001, 0.0, 1.0;
    /// Worlds at a time.
    max_worlds: int = 1024, 1, 100_000;
    /// Workers that run short ticks, and again as many for long ones; 0: one less than there are processors, and at
    /// least one.
    tick_workers: int = 0, 0, 1024;
    /// As urgent as the system shall take these threads to be, if it allows: `fifo` (real time, for short ticks),
    /// `nice` or `plain`.
    tick_priority: text = "fifo", (), ();
    /// A tick that takes longer is reported, s.
    slow_tick_s: float = 0.5, 0.001, 3600.0;
    /// A tick that takes longer is given up, s: its world has failed, and another thread runs the others.
    stuck_tick_s: float = 10.0, 0.01, 86_400.0;
    /// Figures in one world; 60 of them fill one core at 60 Hz.
    max_figures_per_world: int = 64, 1, 1000;
    /// Streams of frames and events at a time.
    max_viewers: int = 512, 1, 100_000;
    /// Different views (figures, fields, encoding) of one world at a time; each is encoded once per tick.
    max_views_per_world: int = 32, 1, 1000;
    /// Streams of desired motion at a time.
    max_drivers: int = 64, 1, 10_000;
    /// Window in which live motion is prepared for drivers that do not say, ms: 0 (off) or 300 to 1000. It makes
    /// streams that walk possible, and all streams later by as much.
    live_window_ms: float = 0.0, 0.0, 1000.0;
    /// Stored clips.
    max_clips: int = 256, 1, 100_000;
    /// Bytes of one uploaded file.
    max_clip_bytes: int = 16_777_216, 1024, 1_073_741_824;
    /// Bytes of all stored files and their frames. Frames that figures play, or have played within `memory_s`, stay.
    max_clip_total_bytes: int = 536_870_912, 1024, 1_099_511_627_776;
    /// Checkpoints that are kept in memory, of all worlds.
    max_checkpoints: int = 1024, 1, 1_000_000;
    /// Bytes of all of them.
    max_checkpoint_bytes: int = 536_870_912, 65_536, 1_099_511_627_776;
    /// Bodies that are kept ready.
    max_bodies: int = 128, 2, 10_000;
    /// Share of `max_viewers`, `max_drivers`, `max_worlds`, `max_views_per_world` and `command_queue` that one client
    /// may have: a principal; without authentication a connection from this machine, an address elsewhere. Principals
    /// have no more of `max_clips` and `max_clip_total_bytes`, either. Behind a proxy without authentication, 1.
    max_client_share: float = 0.5, 0.001, 1.0;
    /// Share of the processors that the ticks of running worlds may need, and of its period that one world may. What
    /// would need more is refused: figures, worlds, faster clocks.
    max_tick_budget: float = 0.7, 0.01, 1000.0;
    /// Requests that wait for the next tick of one world.
    command_queue: int = 1024, 16, 1_000_000;
    /// Requests that are remembered by their `request_id`, with their answers; one principal has `max_client_share` of
    /// them.
    max_request_ids: int = 16_384, 16, 1_000_000;
    /// Operations that are held, those that are done included.
    max_operations: int = 256, 2, 100_000;
    /// Bytes of the results of operations.
    max_operation_bytes: int = 134_217_728, 1_048_576, 68_719_476_736;
    /// How long an operation that is done is kept, s.
    operation_ttl_s: float = 600.0, 1.0, 86_400.0;
    /// Ticks of one world that are held for late readers.
    history_ticks: int = 64, 1, 100_000;
    /// Event messages that are held for slow viewers.
    event_queue: int = 1024, 16, 1_000_000;
    /// Conversions of files to clips that run at a time; clients take turns.
    max_conversions: int = 2, 1, 256;
    /// Conversions of files to clips that wait for their turn; one client has at most half of them.
    max_waiting_conversions: int = 64, 0, 100_000;
    /// Offline simulations that run at a time; clients take turns.
    max_simulations: int = 2, 1, 256;
    /// Offline simulations that wait for their turn; one client has at most half of them.
    max_waiting_simulations: int = 64, 0, 100_000;
    /// Longest offline simulation, s of its own time.
    max_simulation_s: float = 120.0, 1.0, 86_400.0;
    /// Bytes of the frames of one offline simulation.
    max_response_bytes: int = 33_554_432, 65_536, 1_073_741_824;
    /// Bytes of one request other than `CreateClip` and `SimulateClip`, which take `max_clip_bytes`.
    max_request_bytes: int = 1_048_576, 65_536, 67_108_864;
    /// HTTP/2 streams of one connection; browsers and load tools open up to a hundred.
    max_streams_per_connection: int = 256, 1, 100_000;
    /// Requests of one connection that are worked on at a time.
    max_requests_per_connection: int = 256, 1, 100_000;
    /// Connections at a time; one more takes the place of the one that has been without a request the longest.
    max_connections: int = 1024, 1, 1_000_000;
    /// Connections of one address at a time, likewise; behind a proxy all clients have one address.
    max_connections_per_address: int = 768, 1, 1_000_000;
    /// Requests of all connections that are worked on at a time, streams included.
    max_requests: int = 4096, 16, 1_000_000;
    /// Bytes of all requests that are read or worked on.
    max_pending_bytes: int = 50_331_648, 1_048_576, 2_147_483_648;
    /// Bytes that wait for clients to read them; beyond that, connections that read nothing are closed, and large
    /// answers refused.
    max_unread_bytes: int = 67_108_864, 1_048_576, 68_719_476_736;
    /// How long a new connection may take to bring its first request, s.
    first_request_s: float = 10.0, 0.1, 3600.0;
    /// How long a request may take before its response begins, s.
    request_timeout_s: float = 300.0, 1.0, 86_400.0;
    /// Interval of HTTP/2 pings on quiet connections, s.
    keepalive_s: float = 20.0, 1.0, 3600.0;
    /// How long a ping may go unanswered, s.
    keepalive_timeout_s: float = 10.0, 1.0, 3600.0;
    /// Age at which a connection is asked to close, give or take a tenth, s; 0: never. Behind a load balancer, so that
    /// clients spread over servers.
    max_connection_age_s: float = 0.0, 0.0, 604_800.0;
    /// How long the streams of such a connection may go on before it is closed, s.
    connection_age_grace_s: float = 30.0, 0.0, 86_400.0;
    /// Time for which the server keeps serving after it is told to shut down, s: health and `/readyz` say that it ends,
    /// so that load balancers send no more clients, and no new world is created.
    lame_duck_s: float = 1.0, 0.0, 600.0;
    /// How long calls that are worked on get to end when the server shuts down, and then connections to close, s.
    shutdown_grace_s: float = 5.0, 0.0, 600.0;
}

/// An address without user and parameters; any other text as it is.
fn without_secrets(value: &str) -> String {
    let Some((scheme, rest)) = value.split_once("://") else {
        return value.to_owned();
    };
    let end = rest.find(['/', '?', '#']).unwrap_or(rest.len());
    let (authority, path) = rest.split_at(end);
    let host = match authority.rsplit_once('@') {
        Some((_, host)) => format!("…@{host}"),
        None => authority.to_owned(),
    };
    let path = match path.find(['?', '#']) {
        Some(at) => format!("{}?…", &path[..at]),
        None => path.to_owned(),
    };
    format!("{scheme}://{host}{path}")
}

/// The settings that are not the defaults, and the sources of their values.
pub type Sources = BTreeMap<&'static str, String>;

impl Config {
    /// Settings from all sources. `flags` are pairs of name and value, as `--set` gives them.
    ///
    /// # Errors
    /// The problem, and where the value was given.
    pub fn load(
        file: Option<&Path>,
        environment: impl Iterator<Item = (String, String)>,
        flags: &[(String, String)],
    ) -> Result<Self, ConfigError> {
        Self::load_with_sources(file, environment, flags).map(|(config, _)| config)
    }

    /// As [`Config::load`], with where each setting comes from.
    ///
    /// # Errors
    /// The problem, and where the value was given.
    pub fn load_with_sources(
        file: Option<&Path>,
        environment: impl Iterator<Item = (String, String)>,
        flags: &[(String, String)],
    ) -> Result<(Self, Sources), ConfigError> {
        let mut config = Self::default();
        let mut sources = Sources::new();
        if let Some(path) = file {
            let name = path.display().to_string();
            let text = std::fs::read_to_string(path).map_err(|error| ConfigError::File {
                path: name.clone(),
                error,
            })?;
            let table: toml::Table = text.parse().map_err(|error| ConfigError::Toml {
                path: name.clone(),
                error,
            })?;
            for (key, value) in &table {
                sources.insert(config.set(&name, key, value)?, name.clone());
            }
        }
        for (key, value) in environment {
            let Some(name) = key.strip_prefix(PREFIX).map(str::to_lowercase) else {
                continue;
            };
            if !is_no_setting(&name) {
                sources.insert(config.set_text(&key, &name, &value)?, key);
            }
        }
        for (name, value) in flags {
            let flag = format!("--set {name}");
            let name = config.set_text(&flag, &name.replace('-', "_"), value)?;
            sources.insert(name, "flag".to_owned());
        }
        if Durability::by_name(&config.durability).is_none() {
            return Err(ConfigError::Value {
                source_name: "settings".to_owned(),
                name: "durability",
                expected: "none, group or each".to_owned(),
                value: config.durability,
            });
        }
        if WorkerPriority::by_name(&config.tick_priority).is_none() {
            return Err(ConfigError::Value {
                source_name: "settings".to_owned(),
                name: "tick_priority",
                expected: "fifo, nice or plain".to_owned(),
                value: config.tick_priority,
            });
        }
        let no_traces = cfg!(not(feature = "otlp")) && !config.otlp_endpoint.is_empty();
        if no_traces {
            let needs = "a server that is built with the feature otlp";
            return Err(ConfigError::Incomplete("otlp_endpoint", needs));
        }
        config.check_access()?;
        Ok((config, sources))
    }

    /// As [`Config::table`], without possible secrets: addresses with names, passwords or parameters in them.
    pub fn shown(&self) -> Vec<(&'static str, &'static str, String)> {
        let mut table = self.table();
        for (_, _, value) in &mut table {
            *value = without_secrets(value);
        }
        table
    }

    /// Checks that everything within reach of strangers is protected.
    fn check_access(&self) -> Result<(), ConfigError> {
        let needs = |given: &'static str, other: &'static str, missing: bool| {
            if missing {
                Err(ConfigError::Incomplete(given, other))
            } else {
                Ok(())
            }
        };
        let set = |text: &String| !text.is_empty();
        needs(
            "tls_cert",
            "tls_key",
            set(&self.tls_cert) && !set(&self.tls_key),
        )?;
        needs(
            "tls_key",
            "tls_cert",
            set(&self.tls_key) && !set(&self.tls_cert),
        )?;
        needs(
            "tls_client_ca",
            "tls_cert",
            set(&self.tls_client_ca) && !set(&self.tls_cert),
        )?;
        let required = self.tls_require_client_cert && !set(&self.tls_client_ca);
        needs("tls_require_client_cert", "tls_client_ca", required)?;
        let tokens = set(&self.jwt_keys) || set(&self.jwt_secret_file);
        needs(
            "a token",
            "jwt_audience",
            tokens && !set(&self.jwt_audience),
        )?;
        if self.listen.ip().is_loopback() || self.insecure_bind_any {
            return Ok(());
        }
        if !tokens && !set(&self.tls_client_ca) {
            return Err(ConfigError::NotLoopback(self.listen));
        }
        if !set(&self.tls_cert) {
            return Err(ConfigError::NotEncrypted(self.listen));
        }
        Ok(())
    }
}

/// Prefix of the names of settings in the environment.
const PREFIX: &str = "SINEW_";

/// Variables `SINEW_…` that are not settings: the name of the file, and the variables of tests, examples and tools of
/// this project.
const OTHER_VARIABLES: [&str; 25] = [
    "config",
    "token",
    "bin",
    "bvh",
    "chromium",
    "core",
    "example_directions",
    "example_s",
    "live_seconds",
    "live_window",
    "mint_golden",
    "mocap_dir",
    "page",
    "peers_dir",
    "rewrite",
    "server",
    "soak_seed",
    "soak_ticks",
    "abuse_seconds",
    "chaos_page",
    "chaos_seconds",
    "forged",
    "fuzz_cases",
    "replays",
    "soak_seconds",
];

/// Whether a variable is not a setting. Kubernetes sets `SINEW_SERVICE_…` and `SINEW_PORT…` in every container next to
/// a service of the name `sinew`.
fn is_no_setting(name: &str) -> bool {
    OTHER_VARIABLES.contains(&name)
        || name == "port"
        || name.starts_with("port_")
        || name.starts_with("service_")
}

#[cfg(test)]
mod tests;
