//! A server under attack: starts the binary with bounded memory, checks its health continuously, and judges the result.

use crate::abuse::witness;
use std::future::Future;
use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::oneshot;
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;

/// Address space of the server, KiB, as in `deploy/compose.yaml`.
const ADDRESS_SPACE_KIB: u64 = 1024 * 1024;
/// Most memory that the server may ever have touched, KiB.
const RESIDENT_KIB: u64 = 300 * 1024;
/// Longest time that a health check may take, its connection included.
const HEALTH_TIME: Duration = Duration::from_secs(1);
/// Time between health checks.
const HEALTH_EVERY: Duration = Duration::from_millis(100);

/// One attack at a time: each is judged by memory and time, which others would distort.
static ALONE: Mutex<()> = Mutex::new(());

/// Duration of a repeating attack: 3 s, or `SINEW_ABUSE_SECONDS`.
pub fn attack_time() -> Duration {
    let seconds = std::env::var("SINEW_ABUSE_SECONDS").ok();
    Duration::from_secs_f64(seconds.map_or(3.0, |s| s.parse().unwrap()))
}

/// The binary, serving without a demo world on a port of the system's choice.
pub struct Server {
    child: Child,
    /// Its address.
    pub address: SocketAddr,
    /// Memory in use before the attack, KiB.
    calm_kib: u64,
}

impl Server {
    /// Starts it with settings other than the defaults; returns when it reports that it is serving.
    pub fn start(settings: &[(&str, &str)]) -> Self {
        let binary = std::env::var("SINEW_BIN").unwrap_or(env!("CARGO_BIN_EXE_sinew").to_owned());
        let mut command = Command::new("sh");
        command
            .arg("-c")
            .arg(format!("ulimit -v {ADDRESS_SPACE_KIB}; exec \"$0\" \"$@\""))
            .arg(binary)
            .args(["serve", "--no-demo", "--listen", "127.0.0.1:0"])
            .args(["--log", "warn"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        for (name, value) in settings {
            command.args(["--set", &format!("{name}={value}")]);
        }
        let mut child = command.spawn().unwrap();
        let mut first = String::new();
        let mut lines = BufReader::new(child.stdout.take().unwrap());
        lines.read_line(&mut first).unwrap();
        let address = first
            .split("http://")
            .nth(1)
            .and_then(|rest| rest.split_whitespace().next())
            .unwrap_or_else(|| panic!("the server did not start: {first:?}"))
            .parse()
            .unwrap();
        Self {
            child,
            address,
            calm_kib: 0,
        }
    }

    /// A line of `/proc/PID/status`, KiB.
    fn memory_kib(&self, line: &str) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let value = status.lines().find_map(|l| l.strip_prefix(line)).unwrap();
        value
            .trim_matches([':', '\t', ' ', 'k', 'B'])
            .parse()
            .unwrap()
    }

    /// Memory in use now, KiB.
    pub fn resident_kib(&self) -> u64 {
        self.memory_kib("VmRSS")
    }

    /// Peak memory use, KiB.
    pub fn peak_kib(&self) -> u64 {
        self.memory_kib("VmHWM")
    }

    /// Memory that the attack added at its peak, KiB.
    pub fn added_kib(&self) -> u64 {
        self.peak_kib().saturating_sub(self.calm_kib)
    }

    /// Whether the process still runs.
    pub fn lives(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// Ends it and returns its log.
    pub fn end(mut self) -> String {
        use std::io::Read as _;
        self.child.kill().unwrap();
        let mut log = String::new();
        let stderr = self.child.stderr.take().unwrap();
        BufReader::new(stderr).read_to_string(&mut log).unwrap();
        log
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// One health check over its own connection; returns its duration.
///
/// # Errors
/// It was refused or took longer than [`HEALTH_TIME`].
pub async fn healthy(address: SocketAddr) -> Result<Duration, String> {
    let begun = Instant::now();
    let check = async {
        let endpoint = tonic::transport::Endpoint::from_shared(format!("http://{address}"));
        let channel = endpoint
            .unwrap()
            .connect()
            .await
            .map_err(|e| format!("{e:?}"))?;
        let request = HealthCheckRequest {
            service: String::new(),
        };
        let answer = HealthClient::new(channel).check(request).await;
        match answer.map(|a| a.into_inner().status()) {
            Ok(ServingStatus::Serving) => Ok(begun.elapsed()),
            other => Err(format!("{other:?}")),
        }
    };
    tokio::time::timeout(HEALTH_TIME, check)
        .await
        .unwrap_or_else(|_| Err(format!("no answer within {HEALTH_TIME:?}")))
}

/// Checks health until told to stop; returns the number of checks, the slowest of them, and the refusals.
async fn watch(
    address: SocketAddr,
    mut stop: oneshot::Receiver<()>,
) -> (usize, Duration, Vec<String>) {
    let (mut count, mut slowest, mut refused) = (0, Duration::ZERO, Vec::new());
    loop {
        match healthy(address).await {
            Ok(took) => slowest = slowest.max(took),
            Err(why) => refused.push(why),
        }
        count += 1;
        if tokio::time::timeout(HEALTH_EVERY, &mut stop).await.is_ok() {
            return (count, slowest, refused);
        }
    }
}

/// Attacks a server with these settings. During and after the attack it must be alive, small and healthy, and a world
/// beside the attack must not be disturbed. Returns the server for further checks.
pub fn survives<F>(settings: &[(&str, &str)], attack: impl FnOnce(SocketAddr) -> F) -> Server
where
    F: Future<Output = ()>,
{
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut server = Server::start(settings);
    let address = server.address;
    // Check health on a separate thread, so that the attack's own computation does not delay it.
    let (stop, stopped) = oneshot::channel();
    let watching = std::thread::spawn(move || {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build();
        runtime.unwrap().block_on(watch(address, stopped))
    });
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build();
    let runtime = runtime.unwrap();
    let quiet_us = runtime.block_on(witness::begin(address));
    server.calm_kib = server.resident_kib();
    runtime.block_on(attack(address));
    let _ = stop.send(());
    let (checks, slowest, refused) = watching.join().unwrap();
    assert!(server.lives(), "the server died: {}", server.end());
    let peak_kib = server.peak_kib();
    eprintln!(
        "memory {} MB at rest, {} MB at most; {checks} health checks, slowest {:.0} ms",
        server.calm_kib / 1024,
        peak_kib / 1024,
        slowest.as_secs_f64() * 1e3,
    );
    assert!(
        refused.is_empty(),
        "{} of {checks} health checks failed: {refused:?}",
        refused.len()
    );
    assert!(
        peak_kib <= RESIDENT_KIB,
        "the server took {} MB",
        peak_kib / 1024
    );
    runtime.block_on(witness::judge(address, quiet_us));
    server
}
