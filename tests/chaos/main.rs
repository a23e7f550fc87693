//! Goal: what a client was told to be done outlives `kill -9`. Method: the real server with a data directory; a client
//! creates and deletes worlds, figures and clips as fast as it is answered, and keeps a book of the answers; every few
//! seconds the server is killed, started again, and held against the book.
#![cfg(all(feature = "net", unix))]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use sinew::client::Client;
use sinew::wire::pb;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tonic::Code;

/// Worlds at a time.
const WORLDS: usize = 16;
/// Most time that a world goes back: states are written every 5 s, one second after they are due.
const STATE_S: f64 = 6.5;
struct Server {
    child: Child,
    address: String,
}

impl Server {
    fn start(dir: &Path) -> Self {
        let binary = std::env::var("SINEW_BIN").unwrap_or(env!("CARGO_BIN_EXE_sinew").to_owned());
        let mut child = Command::new(binary)
            .args([
                "serve",
                "--no-demo",
                "--no-viewer",
                "--listen",
                "127.0.0.1:0",
            ])
            .args(["--log", "warn", "--set", "max_client_share=1", "--data-dir"])
            .arg(dir)
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
        let address = address.unwrap_or_else(|| panic!("the server did not start: {first:?}"));
        Self {
            address: address.to_owned(),
            child,
        }
    }

    /// The end without notice.
    fn kill(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

struct Temporary(PathBuf);

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// What the server has answered. A request without an answer may have been carried out or not.
#[derive(Default)]
struct Book {
    /// Worlds with their figures and their grants.
    worlds: BTreeMap<String, BTreeSet<String>>,
    clips: BTreeSet<String>,
    /// Being created or deleted when the server was killed.
    doubtful: BTreeSet<String>,
    next: u64,
}

impl Book {
    /// Asks for things until the server is gone. Returns the number of answers.
    async fn write(&mut self, client: &Client) -> u64 {
        let mut answers = 0;
        loop {
            self.next += 1;
            let n = self.next;
            let step = match n % 4 {
                0 => self.clip(client, n).await,
                1 if self.worlds.len() >= WORLDS => self.delete(client).await,
                1 => self.world(client, n).await,
                _ => self.figure(client, n).await,
            };
            match step {
                Ok(()) => answers += 1,
                Err(status)
                    if matches!(
                        status.code(),
                        Code::Unavailable | Code::Unknown | Code::Cancelled
                    ) =>
                {
                    return answers;
                }
                Err(status) => panic!("{status:?}"),
            }
        }
    }

    async fn world(&mut self, client: &Client, n: u64) -> Result<(), tonic::Status> {
        let world_id = format!("w{n}");
        self.doubtful.insert(world_id.clone());
        let request = pb::CreateWorldRequest {
            world_id: world_id.clone(),
            ..Default::default()
        };
        client.worlds().create_world(request).await?;
        self.doubtful.remove(&world_id);
        self.worlds.insert(world_id, BTreeSet::new());
        Ok(())
    }

    async fn delete(&mut self, client: &Client) -> Result<(), tonic::Status> {
        let world = self.worlds.keys().next().unwrap().clone();
        self.worlds.remove(&world);
        self.doubtful.insert(world.clone());
        let request = pb::DeleteWorldRequest {
            name: format!("worlds/{world}"),
            ..Default::default()
        };
        client.worlds().delete_world(request).await?;
        self.doubtful.remove(&world);
        Ok(())
    }

    async fn figure(&mut self, client: &Client, n: u64) -> Result<(), tonic::Status> {
        // Few: what is tested is the disk, not the physics.
        let Some((world, figures)) = self.worlds.iter_mut().find(|(_, f)| f.is_empty()) else {
            tokio::time::sleep(Duration::from_millis(5)).await;
            return Ok(());
        };
        let figure_id = format!("f{n}");
        let request = pb::CreateFigureRequest {
            parent: format!("worlds/{world}"),
            figure_id: figure_id.clone(),
            ..Default::default()
        };
        client.figures().create_figure(request).await?;
        figures.insert(figure_id.clone());
        let request = pb::CreateGrantRequest {
            parent: format!("worlds/{world}"),
            grant_id: figure_id.clone(),
            grant: Some(pb::Grant {
                principal: "user:somebody".into(),
                roles: vec![pb::Role::Driver.into()],
                figure_ids: vec![figure_id.clone()],
                ..Default::default()
            }),
            ..Default::default()
        };
        client.access().create_grant(request).await?;
        figures.insert(format!("grant {figure_id}"));
        Ok(())
    }

    async fn clip(&mut self, client: &Client, n: u64) -> Result<(), tonic::Status> {
        let clip_id = format!("c{n}");
        if self.clips.len() >= WORLDS {
            let oldest = self.clips.pop_first().unwrap();
            self.doubtful.insert(oldest.clone());
            let request = pb::DeleteClipRequest {
                name: format!("clips/{oldest}"),
                ..Default::default()
            };
            client.motions().delete_clip(request).await?;
            self.doubtful.remove(&oldest);
        }
        self.doubtful.insert(clip_id.clone());
        let request = pb::CreateClipRequest {
            clip_id: clip_id.clone(),
            source: Some(clip_source()),
            ..Default::default()
        };
        client.motions().create_clip(request).await?;
        self.doubtful.remove(&clip_id);
        self.clips.insert(clip_id);
        Ok(())
    }
}

/// A few postures at rest.
fn clip_source() -> pb::create_clip_request::Source {
    let frame = |k: usize| {
        let mut angles = vec![0.0; 39];
        angles[19] = 0.01 * k as f64; // right elbow
        pb::FigureMotion {
            root: Some(pb::Pose {
                position_m: Some(pb::Vector3 {
                    z: 0.93,
                    ..Default::default()
                }),
                rotation: None,
            }),
            joint_angles_rad: angles,
            ..Default::default()
        }
    };
    pb::create_clip_request::Source::Frames(pb::FrameSource {
        rate_hz: 60.0,
        frames: (0..60).map(frame).collect(),
    })
}

/// Ticks of all worlds.
async fn ticks(client: &Client) -> BTreeMap<String, i64> {
    let request = pb::ListWorldsRequest::default();
    let worlds = client.worlds().list_worlds(request).await.unwrap();
    let worlds = worlds.into_inner().worlds;
    worlds.into_iter().map(|w| (w.name, w.tick)).collect()
}

/// What the server has, as the book has it.
async fn found(client: &Client) -> Book {
    let mut book = Book::default();
    let worlds = client
        .worlds()
        .list_worlds(pb::ListWorldsRequest::default())
        .await
        .unwrap();
    for world in worlds.into_inner().worlds {
        let request = pb::ListFiguresRequest {
            parent: world.name.clone(),
            ..Default::default()
        };
        let figures = client
            .figures()
            .list_figures(request)
            .await
            .unwrap()
            .into_inner()
            .figures;
        let last = |name: &str| name.rsplit('/').next().unwrap().to_owned();
        let request = pb::ListGrantsRequest {
            parent: world.name.clone(),
            ..Default::default()
        };
        let grants = client.access().list_grants(request).await.unwrap();
        let grants = grants.into_inner().grants;
        // A grant comes back with its principal, roles and figures.
        let whole = |g: &&pb::Grant| {
            g.principal == "user:somebody"
                && g.roles == [i32::from(pb::Role::Driver)]
                && g.figure_ids == [last(&g.name)]
        };
        let grants = grants.iter().filter(whole);
        let figures = figures.iter().map(|f| last(&f.name));
        let figures = figures.chain(grants.map(|g| format!("grant {}", last(&g.name))));
        let figures = figures.collect();
        book.worlds.insert(last(&world.name), figures);
    }
    let request = pb::ListClipsRequest {
        page_size: 1000,
        ..Default::default()
    };
    let clips = client
        .motions()
        .list_clips(request)
        .await
        .unwrap()
        .into_inner()
        .clips;
    let own = clips.iter().filter(|c| !c.builtin);
    book.clips = own.map(|c| c.name["clips/".len()..].to_owned()).collect();
    book
}

#[tokio::test(flavor = "multi_thread")]
async fn what_was_answered_outlives_kill_9() {
    let seconds = std::env::var("SINEW_CHAOS_SECONDS").ok();
    let seconds = Duration::from_secs(seconds.map_or(10, |s| s.parse().unwrap()));
    let name = format!("sinew-chaos-{}", std::process::id());
    let dir = Temporary(std::env::temp_dir().join(name));
    let mut book = Book::default();
    let begun = Instant::now();
    println!(
        "| kill | answers | worlds | clips | lost worlds | lost figures | lost clips | back after ms | behind s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut server = Server::start(&dir.0);
    let (mut lost, mut kills, mut went_on) = (0, 0, 0);
    while begun.elapsed() < seconds || kills < 2 {
        kills += 1;
        let client = Client::connect(&server.address).await.unwrap();
        // Longer than the time between two states, and than that in which a second crash puts a world into quarantine.
        let life = Duration::from_millis(6500 + 700 * (kills % 3));
        let second = Client::connect(&server.address).await.unwrap();
        let killed = async {
            tokio::time::sleep(life).await;
            let before = ticks(&second).await;
            server.kill();
            before
        };
        let (answers, before) = tokio::join!(book.write(&client), killed);

        let start = Instant::now();
        server = Server::start(&dir.0);
        let client = Client::connect(&server.address).await.unwrap();
        let there = found(&client).await;
        let back = start.elapsed();
        // How far worlds have gone back, s; a world that was created just before has no state yet.
        let mut behind = 0.0_f64;
        let mut restored = 0;
        for (name, after) in ticks(&client).await {
            let before = before.get(&name).copied().unwrap_or(0);
            restored += usize::from(after > 90);
            behind = behind.max((before - after) as f64 / 60.0);
        }
        let missing = |ours: &BTreeSet<String>, theirs: &BTreeSet<String>| {
            ours.difference(theirs)
                .filter(|n| !book.doubtful.contains(*n))
                .count()
        };
        let names = |b: &Book| b.worlds.keys().cloned().collect::<BTreeSet<_>>();
        let worlds = missing(&names(&book), &names(&there));
        let clips = missing(&book.clips, &there.clips);
        let mut figures = 0;
        for (world, ours) in &book.worlds {
            figures += there
                .worlds
                .get(world)
                .map_or(0, |theirs| missing(ours, theirs));
        }
        println!(
            "| {kills} | {answers} | {} | {} | {worlds} | {figures} | {clips} | {} | {behind:.1} |",
            there.worlds.len(),
            there.clips.len(),
            back.as_millis()
        );
        lost += worlds + clips + figures;
        // Nothing is there that was not asked for, and what was deleted stays so.
        let known = |n: &String| book.doubtful.contains(n);
        assert!(
            there
                .worlds
                .keys()
                .all(|w| book.worlds.contains_key(w) || known(w))
        );
        assert!(
            there
                .clips
                .iter()
                .all(|c| book.clips.contains(c) || known(c))
        );
        assert!(answers > 0);
        assert!(behind <= STATE_S, "{behind} s");
        went_on += restored;
        book.worlds = there.worlds;
        book.clips = there.clips;
        book.doubtful.clear();
    }
    assert_eq!(lost, 0, "lost");
    assert!(went_on > 0, "no world went on where it was");
}
