//! The whole state of a world as a value: written between two ticks, and read into a new world that continues bit for
//! bit.
//!
//! [`World::capture`] runs on the thread of the world: it writes the state that passes from tick to tick, and notes the
//! bodies and clips that figures share. [`Capture::checkpoint`] writes each of those once, on any thread with time for
//! it, and adds the fields that are checked first when the value is read: format, numerics, length, checksum.
//!
//! ```text
//!   magic 8 │ format u16 │ kind u16 │ numerics u64 │ tick u64 │ length u64 │ checksum u64 │ content
//!   content: definitions (kind, hash, bytes), state, the caller's data beside it; by `postcard`, little-endian
//! ```
//!
//! The state refers to definitions by their place in the list, which has a hash of the content of each. A store
//! therefore keeps each definition once ([`Checkpoint::without_definitions`]), for all checkpoints of all worlds.

use super::collisions::{CollisionReport, Neighbourhood};
use super::{World, WorldError, WorldParams, validate};
use crate::body::Body;
use crate::collide::{MAX_OBSTACLES, Obstacle, ObstacleKey};
use crate::figure::{Figure, FigureKey, RehearsedMotion, SavedFigure};
use crate::motion::Clip;
use crate::plan::motion_transition::TransitionClip;
use crate::saved::{self, Definition};
use crate::tick_context::Planning;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;
use xxhash_rust::xxh3::{xxh3_64, xxh3_128};

/// Version of the format. No other version is read: a checkpoint lives only as long as the program that wrote it, but
/// the log of inputs beside it lives longer (`docs/checkpoints.md`).
pub const FORMAT: u16 = 10;
/// First bytes of a checkpoint.
const MAGIC: [u8; 8] = *b"SINEWCKP";
/// Bytes before the content.
const HEADER: usize = 44;
/// Largest checkpoint that is read, bytes; 1,000 figures with half an hour of clips take about half of it.
pub const MAX_BYTES: usize = 1 << 30;
/// Largest number of figures in a world that is read.
const MAX_FIGURES: usize = 100_000;
/// Latest tick: up to here time is exact, and a world at 1000 Hz needs 285,000 years to reach it.
const MAX_TICK: u64 = 1 << 53;

/// The hashes of the golden scenes identify the arithmetic of this program.
static GOLDEN: &[u8] = include_bytes!("../../../tests/golden/hashes.txt");

/// Identifies the arithmetic of this program: two programs with the same numerics continue from a checkpoint with the
/// same bits.
pub fn numerics() -> u64 {
    xxh3_64(GOLDEN)
}

/// Hash of the content of a definition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct DefinitionHash(pub [u8; 16]);

/// Reason why bytes are not a checkpoint, or not one that can be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CheckpointError {
    /// It does not begin like a checkpoint.
    #[error("these bytes are not a checkpoint")]
    NotACheckpoint,
    /// It is larger than the limit.
    #[error("a checkpoint of {0} bytes, at most {MAX_BYTES} are read")]
    TooLarge(usize),
    /// It was written by another version of the program.
    #[error("a checkpoint of format {found}, this program reads format {FORMAT}")]
    Format {
        /// Its format.
        found: u16,
    },
    /// It is too short or too long.
    #[error("a checkpoint of {expected} bytes has {found}")]
    Length {
        /// Length stated in its header.
        expected: u64,
        /// Actual length.
        found: u64,
    },
    /// Bits of it have changed since it was written.
    #[error("a damaged checkpoint: its checksum does not fit")]
    Checksum,
    /// A body or clip that it refers to is not there.
    #[error("definition {0:02x?} of the checkpoint is missing")]
    Missing(DefinitionHash),
    /// Its content cannot have been written.
    #[error("a checkpoint that cannot be: {0}")]
    Content(String),
    /// It has numbers that no world takes.
    #[error("a checkpoint that cannot be: {0}")]
    World(#[from] WorldError),
}

fn content(what: impl std::fmt::Display) -> CheckpointError {
    CheckpointError::Content(what.to_string())
}

/// The state of a world.
#[derive(Serialize, Deserialize)]
struct SavedWorld<'a> {
    params: WorldParams,
    tick: u64,
    figures: Vec<(FigureKey, SavedFigure<'a>)>,
    next_key: u64,
    obstacles: Cow<'a, [(ObstacleKey, Obstacle)]>,
    next_obstacle: u64,
    through: Cow<'a, [(FigureKey, FigureKey)]>,
    report: CollisionReport,
}

/// A body or a clip in a checkpoint.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct SavedDefinition {
    kind: Kind,
    hash: DefinitionHash,
    /// `None` if it is kept elsewhere.
    bytes: Option<Bytes>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Kind {
    Body,
    Clip,
    Way,
    Rehearsed,
}

#[derive(Serialize, Deserialize)]
struct Content {
    definitions: Vec<SavedDefinition>,
    state: Bytes,
    beside: Bytes,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Bytes(#[serde(with = "crate::saved::bytes")] Vec<u8>);

/// The state of a world at one tick, not yet an independent value, because it still shares the bodies and clips.
pub struct Capture {
    tick: u64,
    hash: u64,
    state: Vec<u8>,
    beside: Vec<u8>,
    definitions: Vec<Definition>,
}

impl std::fmt::Debug for Capture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Capture")
            .field("tick", &self.tick)
            .field("bytes", &self.state.len())
            .finish_non_exhaustive()
    }
}

/// Definitions that were written or read before, so that each is written and hashed only once. Unused ones are
/// forgotten ([`Self::prune`]).
#[derive(Default)]
pub struct Definitions {
    /// By address. The definition is kept alive, so that its address is not reused.
    written: BTreeMap<usize, (Definition, SavedDefinition)>,
}

impl std::fmt::Debug for Definitions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Definitions")
            .field("count", &self.written.len())
            .finish()
    }
}

fn address(definition: &Definition) -> usize {
    Arc::as_ptr(definition).cast::<()>() as usize
}

impl Definitions {
    fn write(&mut self, definition: &Definition) -> Result<&SavedDefinition, CheckpointError> {
        use std::collections::btree_map::Entry;
        match self.written.entry(address(definition)) {
            Entry::Occupied(known) => Ok(&known.into_mut().1),
            Entry::Vacant(new) => {
                let saved = SavedDefinition::of(definition)?;
                Ok(&new.insert((Arc::clone(definition), saved)).1)
            }
        }
    }

    /// Forgets definitions that have no other holder.
    pub fn prune(&mut self) {
        self.written.retain(|_, (d, _)| Arc::strong_count(d) > 1);
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let sizes = self.written.values().map(|(_, s)| s.bytes.as_ref());
        sizes.map(|b| b.map_or(0, |b| b.0.len())).sum()
    }
}

impl SavedDefinition {
    fn of(definition: &Definition) -> Result<Self, CheckpointError> {
        let any = &**definition;
        let (kind, bytes) = if let Some(body) = any.downcast_ref::<Body>() {
            (Kind::Body, postcard::to_stdvec(body))
        } else if let Some(clip) = any.downcast_ref::<Clip>() {
            (Kind::Clip, postcard::to_stdvec(clip))
        } else if let Some(way) = any.downcast_ref::<TransitionClip>() {
            (Kind::Way, postcard::to_stdvec(way))
        } else if let Some(motion) = any.downcast_ref::<RehearsedMotion>() {
            (Kind::Rehearsed, postcard::to_stdvec(motion))
        } else {
            return Err(content("a definition of an unknown kind"));
        };
        let bytes = bytes.map_err(content)?;
        Ok(Self {
            kind,
            hash: hash(kind, &bytes),
            bytes: Some(Bytes(bytes)),
        })
    }

    fn read(&self, bytes: &[u8]) -> Result<Definition, CheckpointError> {
        if hash(self.kind, bytes) != self.hash {
            return Err(content("a definition that is not what its hash says"));
        }
        Ok(match self.kind {
            Kind::Body => Arc::new(body(bytes)?),
            Kind::Clip => Arc::new(exactly::<Clip>(bytes)?),
            Kind::Way => Arc::new(exactly::<TransitionClip>(bytes)?),
            Kind::Rehearsed => {
                let motion: RehearsedMotion = exactly(bytes)?;
                if !motion.is_valid() {
                    return Err(content("a rehearsed motion that cannot be"));
                }
                Arc::new(motion)
            }
        })
    }
}

fn hash(kind: Kind, bytes: &[u8]) -> DefinitionHash {
    DefinitionHash((xxh3_128(bytes) ^ kind as u128).to_le_bytes())
}

/// A value that takes all bytes.
fn exactly<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, CheckpointError> {
    let (out, rest) = postcard::take_from_bytes(bytes).map_err(content)?;
    if rest.is_empty() {
        Ok(out)
    } else {
        Err(content("bytes are left over"))
    }
}

/// A body that the physics can use: it is valid, and has the contact points that the physics expects.
fn body(bytes: &[u8]) -> Result<Body, CheckpointError> {
    let body: Body = exactly(bytes)?;
    body.validate().map_err(content)?;
    let known = Body::adult_man();
    let points =
        |b: &Body| -> Vec<usize> { b.segments.iter().map(|s| s.contact_points.len()).collect() };
    let finite = body.segments.iter().all(|s| {
        let all = s.contact_points.iter().chain(&s.mesh.vertices);
        all.chain([&s.tip]).all(|p| p.norm().is_finite())
            && s.mesh
                .triangles
                .iter()
                .flatten()
                .all(|i| (*i as usize) < s.mesh.vertices.len())
    });
    if points(&body) == points(&known) && finite {
        Ok(body)
    } else {
        Err(content("a body of another shape"))
    }
}

impl World {
    /// The state between two ticks, for [`Capture::checkpoint`]. Fast: some microseconds per figure, more for one with
    /// a live window.
    pub fn capture(&self) -> Capture {
        self.capture_with(&())
    }

    /// Also captures `beside`, the caller's data about the world; both share bodies and clips.
    pub fn capture_with(&self, beside: &impl Serialize) -> Capture {
        // Name every field, so that a new one cannot be forgotten.
        let Self {
            params,
            tick,
            figures,
            next_key,
            obstacles,
            next_obstacle,
            planning: _, // set by the caller that steps the world
            neighbourhood,
        } = self;
        let (through, report) = neighbourhood.saved();
        let ((state, beside), definitions) = saved::collecting(|| {
            let world = SavedWorld {
                params: *params,
                tick: *tick,
                figures: figures.iter().map(|(k, f)| (*k, f.saved())).collect(),
                next_key: *next_key,
                obstacles: Cow::Borrowed(obstacles),
                next_obstacle: *next_obstacle,
                through: Cow::Borrowed(through),
                report: *report,
            };
            let write = "what a world consists of can be written";
            let state = postcard::to_stdvec(&world).expect(write);
            (state, postcard::to_stdvec(beside).expect(write))
        });
        Capture {
            tick: *tick,
            hash: self.state_hash(),
            state,
            beside,
            definitions,
        }
    }

    fn restored(saved: SavedWorld<'_>) -> Result<Self, CheckpointError> {
        let SavedWorld {
            params,
            tick,
            figures,
            next_key,
            obstacles,
            next_obstacle,
            through,
            report,
        } = saved;
        validate::params(&params)?;
        if tick > MAX_TICK {
            return Err(content("a tick that no world comes to"));
        }
        let ascending = |keys: &[u64], next: u64| {
            keys.windows(2).all(|w| w[0] < w[1]) && keys.last().is_none_or(|k| *k < next)
        };
        let figure_keys: Vec<u64> = figures.iter().map(|(k, _)| k.0).collect();
        let obstacle_keys: Vec<u64> = obstacles.iter().map(|(k, _)| k.0).collect();
        if !ascending(&figure_keys, next_key) || !ascending(&obstacle_keys, next_obstacle) {
            return Err(content("figures or obstacles out of order"));
        }
        if figures.len() > MAX_FIGURES || obstacles.len() > MAX_OBSTACLES {
            return Err(content("more figures or obstacles than a world can have"));
        }
        if through.len() > figures.len() * figures.len() / 2 {
            return Err(content("more pairs of figures than there are"));
        }
        for (_, o) in obstacles.iter() {
            validate::obstacle(o.setup())?;
        }
        let figures = figures
            .into_iter()
            .map(|(key, saved)| {
                validate::setup(&saved.setup)?;
                let figure = Figure::restored(saved, params.gravity);
                let figure = figure.map_err(content)?;
                for p in figure.perturbations() {
                    validate::acting(p)?;
                }
                Ok((key, Box::new(figure)))
            })
            .collect::<Result<_, CheckpointError>>()?;
        Ok(Self {
            params,
            tick,
            figures,
            next_key,
            obstacles: obstacles.into_owned(),
            next_obstacle,
            planning: Planning::default(),
            neighbourhood: Neighbourhood::restored(through.into_owned(), report),
        })
    }
}

impl Capture {
    /// Ticks done.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// [`World::state_hash`] at that tick.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    /// Bytes of the state, without bodies and clips.
    pub fn size(&self) -> usize {
        self.state.len() + self.beside.len()
    }

    /// A world in this state that shares its bodies and clips, and the data captured beside it.
    ///
    /// # Errors
    /// The data captured beside it are of another type.
    pub fn restore_with<T: DeserializeOwned>(&self) -> Result<(World, T), CheckpointError> {
        restored(self.definitions.clone(), &self.state, &self.beside)
    }

    /// Makes a value of it. Definitions in `known` are not written again, and new ones are added to it.
    ///
    /// # Errors
    /// None for a world of this program.
    pub fn checkpoint(&self, known: &mut Definitions) -> Result<Checkpoint, CheckpointError> {
        let definitions = self.definitions.iter().map(|d| known.write(d).cloned());
        let content = Content {
            definitions: definitions.collect::<Result<_, _>>()?,
            state: Bytes(self.state.clone()),
            beside: Bytes(self.beside.clone()),
        };
        Ok(Checkpoint {
            numerics: numerics(),
            tick: self.tick,
            content,
        })
    }
}

/// The whole state of a world at one tick.
pub struct Checkpoint {
    numerics: u64,
    tick: u64,
    content: Content,
}

impl std::fmt::Debug for Checkpoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Checkpoint")
            .field("tick", &self.tick)
            .finish_non_exhaustive()
    }
}

impl Checkpoint {
    /// Ticks done.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// Whether this program continues from it with the same bits as the one that wrote it.
    pub fn is_of_this_numerics(&self) -> bool {
        self.numerics == numerics()
    }

    /// Splits off the bodies and clips, which are returned beside the checkpoint.
    pub fn without_definitions(mut self) -> (Self, Vec<(DefinitionHash, Vec<u8>)>) {
        let taken = self.content.definitions.iter_mut();
        let taken = taken
            .filter_map(|d| Some((d.hash, d.bytes.take()?.0)))
            .collect();
        (self, taken)
    }

    /// Hashes of the bodies and clips that [`Self::restore`] needs and that it does not contain.
    pub fn needs(&self) -> impl Iterator<Item = DefinitionHash> + '_ {
        let all = self.content.definitions.iter();
        all.filter(|d| d.bytes.is_none()).map(|d| d.hash)
    }

    /// The value as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = vec![0; HEADER];
        out = postcard::to_extend(&self.content, out)
            .expect("what was read or written can be written");
        let length = (out.len() - HEADER) as u64;
        let sum = checksum(self.numerics, self.tick, &out[HEADER..]);
        let header = &mut out[..HEADER];
        header[..8].copy_from_slice(&MAGIC);
        header[8..10].copy_from_slice(&FORMAT.to_le_bytes());
        // Two bytes are reserved, and zero.
        header[12..20].copy_from_slice(&self.numerics.to_le_bytes());
        header[20..28].copy_from_slice(&self.tick.to_le_bytes());
        header[28..36].copy_from_slice(&length.to_le_bytes());
        header[36..44].copy_from_slice(&sum.to_le_bytes());
        out
    }

    /// Reads the value from bytes. Only [`Self::restore`] shows whether a world can be made from it.
    ///
    /// # Errors
    /// The bytes are not a checkpoint, of another format, damaged, or cannot have been written.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CheckpointError> {
        if bytes.len() > MAX_BYTES {
            return Err(CheckpointError::TooLarge(bytes.len()));
        }
        let header = bytes.get(..HEADER).ok_or(CheckpointError::NotACheckpoint)?;
        if header[..8] != MAGIC {
            return Err(CheckpointError::NotACheckpoint);
        }
        let found = u16::from_le_bytes([header[8], header[9]]);
        if found != FORMAT || header[10..12] != [0; 2] {
            return Err(CheckpointError::Format { found });
        }
        let word = |at: usize| u64::from_le_bytes(std::array::from_fn(|i| header[at + i]));
        let (numerics, tick, expected) = (word(12), word(20), word(28));
        let body = &bytes[HEADER..];
        let found = body.len() as u64;
        if expected != found {
            return Err(CheckpointError::Length { expected, found });
        }
        if word(36) != checksum(numerics, tick, body) {
            return Err(CheckpointError::Checksum);
        }
        Ok(Self {
            numerics,
            tick,
            content: exactly(body)?,
        })
    }

    /// A world in this state. `find` gives the bodies and clips that are kept elsewhere.
    ///
    /// # Errors
    /// A definition is missing or of the wrong content; the state cannot have been written.
    pub fn restore(
        &self,
        find: impl Fn(&DefinitionHash) -> Option<Vec<u8>>,
    ) -> Result<World, CheckpointError> {
        self.restore_with::<()>(find).map(|(world, ())| world)
    }

    /// [`Self::restore`], together with the data captured beside it.
    ///
    /// # Errors
    /// Those of [`Self::restore`]; the data captured beside it are of another type.
    pub fn restore_with<T: DeserializeOwned>(
        &self,
        find: impl Fn(&DefinitionHash) -> Option<Vec<u8>>,
    ) -> Result<(World, T), CheckpointError> {
        let mut all = Vec::new();
        for d in &self.content.definitions {
            let found = match &d.bytes {
                Some(bytes) => d.read(&bytes.0)?,
                None => d.read(&find(&d.hash).ok_or(CheckpointError::Missing(d.hash))?)?,
            };
            all.push(found);
        }
        let (world, beside) = restored(all, &self.content.state.0, &self.content.beside.0)?;
        if world.tick != self.tick {
            return Err(content("a state of another tick"));
        }
        Ok((world, beside))
    }
}

fn restored<T: DeserializeOwned>(
    all: Vec<Definition>,
    state: &[u8],
    beside: &[u8],
) -> Result<(World, T), CheckpointError> {
    let (world, beside) = saved::with_definitions(all, || {
        Ok::<_, CheckpointError>((exactly::<SavedWorld<'static>>(state)?, exactly(beside)?))
    })?;
    Ok((World::restored(world)?, beside))
}

/// Bodies and clips as bytes, each with its kind and hash.
///
/// # Errors
/// One is of a kind that is not written.
pub fn write_definitions(all: &[Definition]) -> Result<Vec<u8>, CheckpointError> {
    let all = all.iter().map(SavedDefinition::of);
    postcard::to_stdvec(&all.collect::<Result<Vec<_>, _>>()?).map_err(content)
}

/// Reads the output of [`write_definitions`].
///
/// # Errors
/// It cannot have been written.
pub fn read_definitions(bytes: &[u8]) -> Result<Vec<Definition>, CheckpointError> {
    let all: Vec<SavedDefinition> = exactly(bytes)?;
    let missing = |d: &SavedDefinition| CheckpointError::Missing(d.hash);
    let read = |d: &SavedDefinition| d.read(&d.bytes.as_ref().ok_or_else(|| missing(d))?.0);
    all.iter().map(read).collect()
}

/// Checksum of the whole content of a checkpoint.
fn checksum(numerics: u64, tick: u64, body: &[u8]) -> u64 {
    let mut all = [0; 24];
    all[..8].copy_from_slice(&numerics.to_le_bytes());
    all[8..16].copy_from_slice(&tick.to_le_bytes());
    all[16..].copy_from_slice(&xxh3_64(body).to_le_bytes());
    xxh3_64(&all)
}
