//! Recordings as files: the recorded part is simulated again, tick by tick, and written at the same time.

use super::recordings::Recorded;
use super::tick::replay::{Replay, ReplayError};
use super::tick::scene::Scene;
use mcap::write::NoSeek;
use prost::Message;
use sinew_physics::body::{Body, Posture};
use sinew_physics::motion::bvh_write::write_bvh;
use sinew_physics::motion::table::{Torques, header, row};
use sinew_wire::DESCRIPTOR_SET;
use sinew_wire::frame::world_frame;
use sinew_wire::status::Fault;
use sinew_wire::types::{FieldSet, NumberFormat, RosterEntry, ViewSpec};
use std::collections::BTreeMap;
use std::io::Write;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Kind of file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Format {
    /// All frames.
    Mcap,
    /// Postures of one figure; `None`: the first.
    Bvh(Option<String>),
    /// The same as a table, with torques.
    Csv(Option<String>),
}

/// Most frames of a BVH file: it is written at its end.
const MAX_BVH_FRAMES: usize = 1_000_000;

/// Takes pieces of the file with the number of ticks done; returns whether more is wanted.
pub type Give<'a> = dyn FnMut(Vec<u8>, u64) -> bool + 'a;

/// Writes a recording of the world `world`. It is given up once `stop` or `give` asks for that.
///
/// # Errors
/// A state differs from the recorded one; there is no such figure; or it was given up.
pub fn export(
    world: &str,
    recorded: &Recorded,
    format: Format,
    stop: &dyn Fn() -> bool,
    give: &mut Give<'_>,
) -> Result<(), Fault> {
    let (from, until) = recorded.ticks;
    if recorded.segments.is_empty() {
        return Err(Fault::DataLoss {
            reason: "RECORDING_LOST",
            message: format!("ticks {from} to {until} of world {world:?} are not on disk any more"),
        });
    }
    let mut writer: Box<dyn FileWriter> = match format {
        Format::Mcap => Box::new(Mcap::new(world)?),
        Format::Bvh(figure) => Box::new(BvhFileWriter::of(figure)),
        Format::Csv(figure) => Box::new(CsvFileWriter::of(figure)),
    };
    let mut replay = Replay::of(&recorded.segments)?;
    let mut failed = None;
    let mut each = |scene: &Scene| {
        let tick = scene.world().tick();
        if stop() {
            return false;
        }
        if tick < from {
            return true;
        }
        let done = writer.tick(scene).map(|()| writer.take());
        match done {
            Ok(piece) if piece.is_empty() => true,
            Ok(piece) => give(piece, tick + 1 - from),
            Err(fault) => {
                failed = Some(fault);
                false
            }
        }
    };
    if replay.scene.world().tick() == from && !each(&replay.scene) {
        return Err(failed.unwrap_or_else(super::workers::Turn::gone));
    }
    let done = replay.through_past(&recorded.segments, until, &mut each);
    match (done, failed) {
        (_, Some(fault)) => return Err(fault),
        (Ok(()), None) => {}
        (Err(ReplayError::Stopped), None) => return Err(super::workers::Turn::gone()),
        (Err(why), None) => {
            return Err(Fault::DataLoss {
                reason: "REPLAY_DIFFERS",
                message: why.to_string(),
            });
        }
    }
    let rest = writer.finish()?;
    if give(rest, until + 1 - from) {
        Ok(())
    } else {
        Err(super::workers::Turn::gone())
    }
}

/// A kind of file.
trait FileWriter {
    /// Takes the state after a tick.
    fn tick(&mut self, scene: &Scene) -> Result<(), Fault>;
    /// The bytes that can be handed out now.
    fn take(&mut self) -> Vec<u8>;
    /// The rest at the end.
    fn finish(self: Box<Self>) -> Result<Vec<u8>, Fault>;
}

/// Bytes that are handed out in the order in which they were written.
#[derive(Clone, Default)]
struct SharedBytes(Arc<Mutex<Vec<u8>>>);

impl SharedBytes {
    fn inside(&self) -> MutexGuard<'_, Vec<u8>> {
        // Bytes are appended whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self) -> Vec<u8> {
        std::mem::take(&mut self.inside())
    }
}

impl Write for SharedBytes {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.inside().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

struct Mcap {
    world: Arc<str>,
    view: ViewSpec,
    pieces: SharedBytes,
    writer: mcap::Writer<NoSeek<SharedBytes>>,
    channel: u16,
    roster: Arc<[RosterEntry]>,
    /// Of the roster.
    version: i32,
}

fn broken(e: &mcap::McapError) -> Fault {
    Fault::Internal(format!("writing MCAP: {e}"))
}

impl Mcap {
    fn new(world: &str) -> Result<Self, Fault> {
        let pieces = SharedBytes::default();
        let mut writer = mcap::WriteOptions::new()
            .compression(None)
            .disable_seeking(true)
            .profile("")
            .library(concat!("sinew ", env!("CARGO_PKG_VERSION")))
            .create(NoSeek::new(pieces.clone()))
            .map_err(|e| broken(&e))?;
        let schema = writer
            .add_schema("sinew.v1.WorldFrame", "protobuf", DESCRIPTOR_SET)
            .map_err(|e| broken(&e))?;
        let topic = format!("/worlds/{world}");
        let channel = writer
            .add_channel(schema, &topic, "protobuf", &BTreeMap::new())
            .map_err(|e| broken(&e))?;
        Ok(Self {
            world: world.into(),
            view: ViewSpec {
                figures: Vec::new(),
                fields: FieldSet::ALL,
                format: NumberFormat::Double,
                divisor: 1,
            },
            pieces,
            writer,
            channel,
            roster: Arc::new([]),
            version: 0,
        })
    }
}

impl FileWriter for Mcap {
    fn tick(&mut self, scene: &Scene) -> Result<(), Fault> {
        let roster = scene.roster();
        let names = |all: &[RosterEntry]| -> Vec<(i32, String)> {
            all.iter().map(|e| (e.index, e.figure.clone())).collect()
        };
        let anew = self.version == 0 || names(&roster) != names(&self.roster);
        if anew {
            self.version += 1;
            self.roster = roster;
        }
        let snapshot = scene.snapshot(&self.world, (Arc::clone(&self.roster), self.version));
        if anew {
            let figures = snapshot.roster.iter();
            let figures =
                figures.map(|e| (e.index.to_string(), format!("{} {}", e.figure, e.body)));
            let metadata = mcap::records::Metadata {
                name: format!("roster from tick {}: index, figure, body", snapshot.tick),
                metadata: figures.collect(),
            };
            self.writer
                .write_metadata(&metadata)
                .map_err(|e| broken(&e))?;
        }
        let time_ns = (snapshot.time * 1e9).round() as u64;
        let header = mcap::records::MessageHeader {
            channel_id: self.channel,
            sequence: snapshot.tick as u32,
            log_time: time_ns,
            publish_time: time_ns,
        };
        let frame = world_frame(&snapshot, &self.view).encode_to_vec();
        self.writer
            .write_to_known_channel(&header, &frame)
            .map_err(|e| broken(&e))
    }

    fn take(&mut self) -> Vec<u8> {
        self.pieces.take()
    }

    fn finish(mut self: Box<Self>) -> Result<Vec<u8>, Fault> {
        self.writer.finish().map_err(|e| broken(&e))?;
        Ok(self.pieces.take())
    }
}

/// The figure that a file is about: by its name, or else the first one.
fn chosen<'a>(
    wanted: &mut Option<String>,
    scene: &'a Scene,
) -> Option<&'a sinew_physics::world::Figure> {
    let mut members = scene.members().iter();
    let member = match wanted {
        Some(id) => members.find(|m| m.id == *id),
        None => members.next(),
    }?;
    wanted.get_or_insert_with(|| member.id.clone());
    Some(scene.figure(member.key))
}

fn nobody(wanted: Option<&String>) -> Fault {
    let name = wanted.map_or("figures", String::as_str);
    Fault::not_found("figure", name.to_owned())
}

struct BvhFileWriter {
    figure: Option<String>,
    body: Option<Arc<Body>>,
    rate_hz: f64,
    postures: Vec<Posture>,
}

impl BvhFileWriter {
    fn of(figure: Option<String>) -> Self {
        Self {
            figure,
            body: None,
            rate_hz: 60.0,
            postures: Vec::new(),
        }
    }
}

impl FileWriter for BvhFileWriter {
    fn tick(&mut self, scene: &Scene) -> Result<(), Fault> {
        let Some(f) = chosen(&mut self.figure, scene) else {
            return Ok(());
        };
        if self.postures.len() >= MAX_BVH_FRAMES {
            return Err(Fault::Exhausted {
                limit: "max_bvh_frames",
                value: MAX_BVH_FRAMES as u64,
                message: "one more frame".into(),
                retry: None,
            });
        }
        self.rate_hz = scene.settings().rate_hz;
        self.body.get_or_insert_with(|| Arc::clone(f.body()));
        self.postures.push(f.state().posture);
        Ok(())
    }

    fn take(&mut self) -> Vec<u8> {
        Vec::new()
    }

    fn finish(self: Box<Self>) -> Result<Vec<u8>, Fault> {
        let body = self.body.ok_or_else(|| nobody(self.figure.as_ref()))?;
        Ok(write_bvh(&body, &self.postures, self.rate_hz).into_bytes())
    }
}

struct CsvFileWriter {
    figure: Option<String>,
    any: bool,
    lines: String,
}

impl CsvFileWriter {
    fn of(figure: Option<String>) -> Self {
        Self {
            figure,
            any: false,
            lines: header(true),
        }
    }
}

impl FileWriter for CsvFileWriter {
    fn tick(&mut self, scene: &Scene) -> Result<(), Fault> {
        // A figure that was not stepped has no torques yet.
        let Some(f) = chosen(&mut self.figure, scene) else {
            return Ok(());
        };
        let Some(report) = f.report() else {
            return Ok(());
        };
        self.any = true;
        let torques = Torques {
            torque: &report.joints.torque,
            lower: &report.joints.torque_lower,
            upper: &report.joints.torque_upper,
        };
        let time = scene.world().time();
        row(&mut self.lines, time.0, &f.state().posture, Some(torques));
        Ok(())
    }

    fn take(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.lines).into_bytes()
    }

    fn finish(self: Box<Self>) -> Result<Vec<u8>, Fault> {
        if self.any {
            Ok(self.lines.into_bytes())
        } else {
            Err(nobody(self.figure.as_ref()))
        }
    }
}
