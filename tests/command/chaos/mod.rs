//! Goal: confirmed requests survive `kill -9`, and worlds return in their former state, except for the last group of
//! inputs. Method: the real server with a data directory. A client creates and deletes worlds, figures and clips as
//! fast as it is answered, and records the answers; another one drives two figures at 60 Hz and notes the hash of each
//! frame that it sees. Every few seconds the server is killed, restarted, and compared with both: it replays its log,
//! and reports the resulting tick and hash.
#![cfg(unix)]

use sinew_client::Client;
use sinew_wire::pb;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use tonic::Code;

/// Worlds at a time.
const WORLDS: usize = 16;
/// Largest time by which a world goes back, s: a group of 10 ms and a commit, on a shared disk.
const GROUP_S: f64 = 1.0;
/// Marker in the page before the table.
const BEGIN: &str = "<!-- kill9: begin -->";
const END: &str = "<!-- kill9: end -->";
/// The world whose figures are driven.
const DRIVEN: &str = "driven";

struct Server {
    child: Child,
    address: String,
    log: Arc<Mutex<Vec<String>>>,
}

/// A recovered world: tick, hash, number of replayed ticks.
type Back = (i64, i64, u64);

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
            .args(["--log", "info", "--set", "log_json=true"])
            .args(["--set", "max_client_share=1", "--data-dir"])
            .arg(dir)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let log = Arc::new(Mutex::new(Vec::new()));
        let (kept, said) = (log.clone(), child.stderr.take().unwrap());
        std::thread::spawn(move || {
            for line in BufReader::new(said).lines().map_while(Result::ok) {
                if line.contains("\"WARN\"") || line.contains("\"ERROR\"") {
                    eprintln!("{line}");
                }
                kept.lock().unwrap().push(line);
            }
        });
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
            log,
        }
    }

    /// Recovered worlds, and losses.
    fn back(&self) -> (BTreeMap<String, Back>, Vec<String>) {
        let (mut worlds, mut lost) = (BTreeMap::new(), Vec::new());
        for line in self.log.lock().unwrap().iter() {
            let said: serde_json::Value = serde_json::from_str(line).unwrap();
            let fields = &said["fields"];
            match fields["message"].as_str().unwrap_or_default() {
                "world is as it was" => {
                    let hash = u64::from_str_radix(fields["hash"].as_str().unwrap(), 16).unwrap();
                    let numbers = (fields["tick"].as_i64(), fields["compared"].as_u64());
                    let back = (numbers.0.unwrap(), hash as i64, numbers.1.unwrap());
                    worlds.insert(fields["world"].as_str().unwrap().to_owned(), back);
                }
                m if m.contains("lost") || m.contains("anew") => lost.push(line.clone()),
                _ => {}
            }
        }
        (worlds, lost)
    }

    /// Kills it without notice.
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

/// The server's answers. A request without an answer may have been carried out or not.
#[derive(Default)]
struct Book {
    /// Worlds with their figures and their grants.
    worlds: BTreeMap<String, BTreeSet<String>>,
    clips: BTreeSet<String>,
    /// Worlds being created or deleted when the server was killed.
    doubtful: BTreeSet<String>,
    next: u64,
}

impl Book {
    /// Makes requests until the server is gone. Returns the number of answers.
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
        let world = self.worlds.keys().find(|w| *w != DRIVEN).unwrap().clone();
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
        // Only a few, because this tests the disk, not the physics.
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

/// A world with a figure that is driven and one that plays a clip.
async fn begin_driven(client: &Client) {
    let request = pb::CreateWorldRequest {
        world_id: DRIVEN.into(),
        ..Default::default()
    };
    client.worlds().create_world(request).await.unwrap();
    for (id, y_m) in [("a", 0.0), ("b", 1.5)] {
        let request = pb::CreateFigureRequest {
            parent: format!("worlds/{DRIVEN}"),
            figure_id: id.into(),
            figure: Some(pb::Figure {
                placement: Some(pb::Placement {
                    y_m,
                    ..Default::default()
                }),
                ..Default::default()
            }),
            ..Default::default()
        };
        client.figures().create_figure(request).await.unwrap();
    }
}

/// Drives both figures until the server is gone.
async fn drive(client: &Client, mut n: i64) -> i64 {
    let header = pb::DriveHeader {
        world: format!("worlds/{DRIVEN}"),
        figure_ids: vec!["a".into(), "b".into()],
        ..Default::default()
    };
    let Ok(driver) = client.drive(header).await else {
        return n;
    };
    loop {
        n += 1;
        let t = n as f64 / 60.0;
        let motion = |figure: &str, y_m: f64| {
            let mut angles = vec![0.0; 39];
            angles[19] = 0.6 + 0.4 * (3.0 * t).sin(); // right elbow
            pb::FigureMotion {
                figure_id: figure.to_owned(),
                root: Some(pb::Pose {
                    position_m: Some(pb::Vector3 {
                        y: y_m,
                        z: 0.93,
                        ..Default::default()
                    }),
                    rotation: None,
                }),
                joint_angles_rad: angles,
                ..Default::default()
            }
        };
        let frame = pb::MotionFrame {
            sequence: n,
            source_time_ns: (t * 1e9) as i64,
            figures: vec![motion("a", 0.0), motion("b", 1.5)],
        };
        if !driver.send(vec![frame]).await {
            return n;
        }
        tokio::time::sleep(Duration::from_micros(16_667)).await;
    }
}

/// Hashes of the frames of the driven world, until the server is gone.
async fn watch(client: &Client, from: Option<i64>) -> BTreeMap<i64, i64> {
    use sinew_wire::watched::WatchWorldResponse;
    let mut seen = BTreeMap::new();
    let view = pb::View::default();
    let world = format!("worlds/{DRIVEN}");
    let Ok(mut frames) = client.watch(&world, view, from).await else {
        return seen;
    };
    while let Ok(Some(message)) = frames.message().await {
        if let WatchWorldResponse::Frame(f) = message {
            seen.insert(f.tick, f.state_hash);
        }
    }
    seen
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

/// The server's content, in the form of the book.
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
    let columns = [
        "kill",
        "answers",
        "worlds",
        "clips",
        "lost worlds",
        "lost figures",
        "lost clips",
        "back after ms",
        "ticks done again",
        "loss ms",
    ];
    let mut table = format!(
        "| {} |\n|{}\n",
        columns.join(" | "),
        "---|".repeat(columns.len())
    );
    print!("{table}");
    let mut server = Server::start(&dir.0);
    let (mut lost, mut kills, mut went_on, mut sent) = (0, 0, 0, 0);
    begin_driven(&Client::connect(&server.address).await.unwrap()).await;
    book.worlds
        .insert(DRIVEN.into(), ["a".into(), "b".into()].into());
    while begun.elapsed() < seconds || kills < 2 {
        kills += 1;
        let client = Client::connect(&server.address).await.unwrap();
        // Longer than the time between two states, and than the time in which a second crash puts a world into
        // quarantine.
        let life = Duration::from_millis(6500 + 700 * (kills % 3));
        let second = Client::connect(&server.address).await.unwrap();
        let third = Client::connect(&server.address).await.unwrap();
        let killed = async {
            tokio::time::sleep(life).await;
            let before = ticks(&second).await;
            server.kill();
            before
        };
        let (answers, before, n, seen) = tokio::join!(
            book.write(&client),
            killed,
            drive(&second, sent),
            watch(&third, None)
        );
        sent = n;

        let start = Instant::now();
        server = Server::start(&dir.0);
        let client = Client::connect(&server.address).await.unwrap();
        let there = found(&client).await;
        let back = start.elapsed();
        // Time by which worlds have gone back, s; all of them were recorded from their creation.
        let (worlds_back, losses) = server.back();
        assert!(losses.is_empty(), "{losses:?}");
        let mut behind = 0.0_f64;
        let mut again = 0;
        for (name, (tick, hash, compared)) in &worlds_back {
            let before = before.get(&format!("worlds/{name}")).copied().unwrap_or(0);
            let last = if name == DRIVEN {
                let same = seen.get(tick).is_none_or(|seen| seen == hash);
                assert!(same, "tick {tick} came back as another one");
                went_on += usize::from(seen.contains_key(tick));
                seen.keys().next_back().copied().unwrap_or(before)
            } else {
                before
            };
            again += compared;
            behind = behind.max((last - tick) as f64 / 60.0);
        }
        assert!(worlds_back.contains_key(DRIVEN));
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
        let row = format!(
            "| {kills} | {answers} | {} | {} | {worlds} | {figures} | {clips} | {} | {again} | {:.0} |\n",
            there.worlds.len(),
            there.clips.len(),
            back.as_millis(),
            1e3 * behind.max(0.0)
        );
        print!("{row}");
        table += &row;
        lost += worlds + clips + figures;
        // Nothing exists that was not requested, and deleted worlds stay deleted.
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
        assert!(behind <= GROUP_S, "{behind} s");
        book.worlds = there.worlds;
        book.clips = there.clips;
        book.doubtful.clear();
    }
    assert_eq!(lost, 0, "lost");
    assert!(went_on > 0, "no world went on where it was seen");
    if let Some(page) = std::env::var_os("SINEW_CHAOS_PAGE") {
        let text = std::fs::read_to_string(&page).unwrap();
        let (head, rest) = text.split_once(BEGIN).unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        std::fs::write(&page, format!("{head}{BEGIN}\n\n{table}\n{END}{tail}")).unwrap();
    }
}
