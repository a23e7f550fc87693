//! The real server as a process, and its metrics.

use sinew_wire::pb;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use tokio::io::{AsyncReadExt, AsyncWriteExt};

/// A file of the repository.
pub fn text(path: &str) -> String {
    std::fs::read_to_string(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join(path))
        .unwrap()
}

/// A server that is killed when it is dropped.
pub struct Server {
    child: Child,
    pub address: String,
}

impl Server {
    pub fn start(arguments: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_sinew"))
            .args([
                "serve",
                "--no-demo",
                "--listen",
                "127.0.0.1:0",
                "--log",
                "warn",
            ])
            .args(arguments)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = String::new();
        let mut lines = BufReader::new(child.stdout.take().unwrap());
        lines.read_line(&mut first).unwrap();
        let address = first
            .split("http://")
            .nth(1)
            .and_then(|rest| rest.split_whitespace().next());
        Self {
            address: address
                .unwrap_or_else(|| panic!("no server: {first:?}"))
                .to_owned(),
            child,
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A directory that is removed when dropped.
pub struct Temporary(PathBuf);

impl Temporary {
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("sinew-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        Self(path)
    }

    pub fn path(&self) -> &str {
        self.0.to_str().unwrap()
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The answer to a GET.
pub async fn http(address: String, path: String) -> String {
    let mut stream = tokio::net::TcpStream::connect(&address).await.unwrap();
    let request = format!("GET {path} HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n");
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut out = String::new();
    stream.read_to_string(&mut out).await.unwrap();
    out
}

/// A page of metrics.
pub struct Page {
    /// Kinds by name.
    pub kinds: BTreeMap<String, String>,
    /// Values by name and labels.
    pub samples: BTreeMap<String, f64>,
}

impl Page {
    pub async fn of(server: &Server) -> Self {
        let page = http(server.address.clone(), "/metrics".into()).await;
        assert!(page.starts_with("HTTP/1.1 200"), "{page}");
        let kinds = page.lines().filter_map(|l| {
            let (name, kind) = l.strip_prefix("# TYPE ")?.split_once(' ')?;
            Some((name.to_owned(), kind.to_owned()))
        });
        let samples = page
            .lines()
            .filter(|l| !l.starts_with('#'))
            .filter_map(|l| {
                let (name, value) = l.rsplit_once(' ')?;
                Some((name.to_owned(), value.parse().ok()?))
            });
        Self {
            kinds: kinds.collect(),
            samples: samples.collect(),
        }
    }

    pub fn get(&self, sample: &str) -> f64 {
        let value = self.samples.get(sample);
        *value.unwrap_or_else(|| panic!("{sample} is not there"))
    }
}

/// Desired motion of a lifted right arm, one frame per 1/60 s.
pub fn arm_frame(figure: &str, i: i64) -> pb::MotionFrame {
    let t = i as f64 / 60.0;
    let mut angles = vec![0.0; 39];
    angles[19] = 0.6 - 0.6 * (1.5 * t).cos(); // right elbow
    pb::MotionFrame {
        sequence: i,
        source_time_ns: (t * 1e9) as i64,
        figures: vec![pb::FigureMotion {
            figure_id: figure.into(),
            joint_angles_rad: angles,
            planted: vec![true, true],
            ..Default::default()
        }],
    }
}
