//! Bodies and clips that the server holds, each prepared once and shared.

use super::config::Config;
use super::engine::{self, BUILTIN_NAMES, Clip};
use super::rehearsals::{Rehearsed, Score};
use super::shares::check_part;
use super::workers::Turn;
use sinew_physics::body::{Body, Posture};
use sinew_physics::forecast::forecast_plain;
use sinew_physics::plan::cycle;
use sinew_physics::reference::{SAMPLE_BYTES, TEMPI};
use sinew_wire::convert::body::{NAMED, by_id};
use sinew_wire::pb;
use sinew_wire::status::Fault;
use sinew_wire::types::{BodyRef, ClipInfo, FollowSettings, MotionSource};
use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Entries are inserted whole, so a panic elsewhere leaves a usable map.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Bodies by the last parts of their names.
#[derive(Debug)]
pub struct Bodies {
    most: usize,
    held: Mutex<BTreeMap<String, Arc<Body>>>,
}

impl Bodies {
    /// No bodies yet.
    pub fn new(config: &Config) -> Self {
        Self {
            most: config.max_bodies as usize,
            held: Mutex::default(),
        }
    }

    /// The body of a reference, built if necessary; `field` is the place of the profile in the request.
    ///
    /// # Errors
    /// The tables do not cover the profile.
    pub fn get(&self, field: &str, body: &BodyRef) -> Result<Arc<Body>, Fault> {
        if let Some(held) = locked(&self.held).get(&body.id) {
            return Ok(held.clone());
        }
        let built = Arc::new(engine::build_body(body.profile).map_err(|f| f.within(field))?);
        let mut held = locked(&self.held);
        if held.len() >= self.most {
            // Figures keep theirs; an unused body is built again on request.
            held.retain(|id, b| Arc::strong_count(b) > 1 || NAMED.iter().any(|n| n.0 == id));
        }
        if held.len() < self.most {
            held.insert(body.id.clone(), built.clone());
        }
        Ok(built)
    }

    /// Named bodies and those in use, by name.
    pub fn list(&self) -> Vec<BodyRef> {
        let mut out: BTreeMap<String, BodyRef> = NAMED
            .iter()
            .filter_map(|n| by_id(n.0))
            .map(|b| (b.id.clone(), b))
            .collect();
        for (id, body) in locked(&self.held).iter() {
            out.insert(
                id.clone(),
                BodyRef {
                    id: id.clone(),
                    profile: body.profile,
                },
            );
        }
        out.into_values().collect()
    }
}

/// The conditions that a clip is prepared for, besides its body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Manner {
    repeats: bool,
    /// How many times as fast as recorded, in steps of 1/[`TEMPO_STEPS`]: the remaining change of speed is too small to
    /// affect balance.
    tempo: u32,
}

/// Tempi between one and twice as fast.
const TEMPO_STEPS: f64 = 50.0;

impl Manner {
    /// At its own pace, and for repetition if it `repeats`.
    pub fn recorded(repeats: bool) -> Self {
        Self::paced(repeats, 1.0)
    }

    /// The tempo nearest to `speed` for which a recording is prepared.
    fn paced(repeats: bool, speed: f64) -> Self {
        let tempo = (speed.clamp(TEMPI.0, TEMPI.1) * TEMPO_STEPS).round() as u32;
        Self { repeats, tempo }
    }

    fn tempo(self) -> f64 {
        f64::from(self.tempo) / TEMPO_STEPS
    }
}

/// A stored motion.
struct StoredClip {
    /// Tells it from all others that have had its name.
    number: u64,
    info: ClipInfo,
    source: Option<MotionSource>,
    bytes: u64,
    /// Prepared for bodies by the last parts of their names.
    prepared: Mutex<HashMap<(String, Manner), Arc<Clip>>>,
    /// Rehearsed for figures, in order of age, the latest last.
    rehearsed: Mutex<Vec<Arc<Rehearsed>>>,
}

/// A clip that is to be stored.
#[derive(Clone, Debug)]
pub struct NewClip {
    /// Last part of its name; `None`: the server chooses.
    pub id: Option<String>,
    /// Name for people.
    pub display_name: String,
    /// Its owner; `None`: it belongs to all callers.
    pub owner: Option<Arc<str>>,
    /// How far the motion may be changed so that a figure can follow it.
    pub follow: FollowSettings,
}

/// Clips by the last parts of their names.
pub struct Clips {
    most: u64,
    most_bytes: u64,
    share: f64,
    held: Mutex<BTreeMap<String, Arc<StoredClip>>>,
    next: AtomicU64,
    /// Clips created until now.
    count: AtomicU64,
}

/// Bytes of a prepared frame: posture, velocity and acceleration.
const FRAME_BYTES: u64 = (size_of::<Posture>() + 2 * 45 * 8 + 8) as u64;
/// Most figures for which rehearsals of one clip are kept.
const MAX_REHEARSED: usize = 16;
/// Most combinations of body and manner for which one clip is kept prepared.
const MAX_PREPARED: usize = 16;

impl Clips {
    /// The built-in clips.
    ///
    /// # Errors
    /// A built-in clip cannot be made for the adult man: a bug in the program.
    pub fn new(config: &Config, bodies: &Bodies) -> Result<Self, Fault> {
        let reference = by_id("adult-man").ok_or_else(|| Fault::not_found("body", "adult-man"))?;
        let body = bodies.get("body", &reference)?;
        let mut held = BTreeMap::new();
        for name in BUILTIN_NAMES {
            let clip = engine::builtin(&body, name)
                .ok_or_else(|| Fault::not_found("clip", format!("clips/{name}")))?;
            let info = ClipInfo {
                id: name.to_owned(),
                display_name: name.to_owned(),
                builtin: true,
                owner: None,
                body: reference.id.clone(),
                rate_hz: clip.rate_hz(),
                frames: clip.len(),
                duration: clip.duration(),
                report: None,
                created: None,
                forecast: None,
                follow: FollowSettings::default(),
            };
            let key = (reference.id.clone(), Manner::recorded(false));
            let prepared = HashMap::from([(key, Arc::new(clip))]);
            held.insert(
                name.to_owned(),
                Arc::new(StoredClip {
                    number: 0,
                    info,
                    source: None,
                    bytes: 0,
                    prepared: Mutex::new(prepared),
                    rehearsed: Mutex::default(),
                }),
            );
        }
        Ok(Self {
            most: config.max_clips,
            most_bytes: config.max_clip_total_bytes,
            share: config.max_client_share,
            held: Mutex::new(held),
            next: AtomicU64::new(1),
            count: AtomicU64::new(0),
        })
    }

    fn room(
        &self,
        held: &BTreeMap<String, Arc<StoredClip>>,
        new: &NewClip,
        bytes: u64,
    ) -> Result<(), Fault> {
        if let Some(id) = &new.id
            && held.contains_key(id)
        {
            return Err(Fault::Exists {
                kind: "clip",
                name: format!("clips/{id}"),
            });
        }
        let own = held.values().filter(|s| !s.info.builtin);
        if own.count() as u64 >= self.most {
            return Err(Fault::Exhausted {
                limit: "max_clips",
                value: self.most,
                message: "one more clip".into(),
                retry: None,
            });
        }
        if new.owner.is_some() {
            // One owner among many leaves room for the others, in number and in bytes.
            let own = held.values().filter(|s| s.info.owner == new.owner);
            let (count, used) = own.fold((0, bytes), |(n, b), s| (n + 1, b + s.used()));
            check_part("max_clips", count, self.most, self.share)?;
            check_part("max_clip_total_bytes", used, self.most_bytes, self.share)?;
        }
        self.space(held, bytes)
    }

    /// Makes room for these bytes, if necessary by forgetting preparations that no figure plays.
    fn space(&self, held: &BTreeMap<String, Arc<StoredClip>>, bytes: u64) -> Result<(), Fault> {
        let fits = || held.values().map(|s| s.used()).sum::<u64>() + bytes <= self.most_bytes;
        if !fits() {
            for stored in held.values() {
                locked(&stored.prepared).retain(|_, clip| Arc::strong_count(clip) > 1);
            }
        }
        if fits() {
            return Ok(());
        }
        Err(Fault::Exhausted {
            limit: "max_clip_total_bytes",
            value: self.most_bytes,
            message: format!("a clip of {bytes} bytes"),
            retry: None,
        })
    }

    /// Refuses early a clip that would be refused in the end, before any work is done.
    ///
    /// # Errors
    /// The name is taken or there is no room.
    pub fn check_room(&self, new: &NewClip, source: &MotionSource) -> Result<(), Fault> {
        self.room(&locked(&self.held), new, source_bytes(source))
    }

    /// The name of a new clip, or a free one if none is given.
    fn free_id(&self, held: &BTreeMap<String, Arc<StoredClip>>, new: &NewClip) -> String {
        new.id.clone().unwrap_or_else(|| {
            loop {
                let n = self.next.fetch_add(1, Ordering::Relaxed);
                let id = format!("clip-{n}");
                if !held.contains_key(&id) {
                    return id;
                }
            }
        })
    }

    /// A motion as it would be stored, prepared for one body.
    fn converted(
        &self,
        new: &NewClip,
        reference: &BodyRef,
        body: &Body,
        source: &MotionSource,
        stop: &dyn Fn() -> bool,
    ) -> Result<(ClipInfo, Clip), Fault> {
        let title = new.id.as_deref().unwrap_or("clip");
        let field = source_field(source);
        let (clip, report) = engine::prepare(field, title, source, body, 1.0, stop)?;
        if stop() {
            return Err(Turn::gone());
        }
        let forecast = forecast_plain(body, &clip);
        let info = ClipInfo {
            id: title.to_owned(),
            display_name: new.display_name.clone(),
            builtin: false,
            owner: new.owner.clone(),
            body: reference.id.clone(),
            rate_hz: clip.rate_hz(),
            frames: clip.len(),
            duration: clip.duration(),
            report: report.map(Arc::new),
            created: Some(SystemTime::now()),
            forecast: Some(Arc::new(forecast)),
            follow: new.follow,
        };
        Ok((info, clip))
    }

    /// The clip that [`Self::create`] would store. Equally slow.
    ///
    /// # Errors
    /// Same as [`Self::create`].
    pub fn would_create(
        &self,
        new: &NewClip,
        reference: &BodyRef,
        body: &Body,
        source: &MotionSource,
        stop: &dyn Fn() -> bool,
    ) -> Result<ClipInfo, Fault> {
        let (info, clip) = self.converted(new, reference, body, source, stop)?;
        let bytes = source_bytes(source) + clip_bytes(&clip);
        self.room(&locked(&self.held), new, bytes)?;
        Ok(info)
    }

    /// Stores a motion, prepared for one body. Slow: not on an async thread. It is given up once `stop` says so.
    /// `stored` learns of it before any caller can see it.
    ///
    /// # Errors
    /// The file is bad, the name is taken, there is no room, or it was given up; those of `stored`. Nothing is stored
    /// then.
    pub fn create(
        &self,
        new: NewClip,
        reference: &BodyRef,
        body: &Body,
        source: MotionSource,
        stop: &dyn Fn() -> bool,
        stored: &mut dyn FnMut(&ClipInfo) -> Result<(), Fault>,
    ) -> Result<ClipInfo, Fault> {
        let (info, clip) = self.converted(&new, reference, body, &source, stop)?;
        let bytes = source_bytes(&source);
        let mut held = locked(&self.held);
        // A name that was free when the work began may be taken by now.
        let id = self.free_id(&held, &new);
        let new = NewClip {
            id: Some(id.clone()),
            ..new
        };
        self.room(&held, &new, bytes + clip_bytes(&clip))?;
        let info = ClipInfo {
            id: id.clone(),
            ..info
        };
        stored(&info)?;
        let stored = StoredClip {
            number: self.number(),
            info: info.clone(),
            source: Some(source),
            bytes,
            prepared: Mutex::new(HashMap::from([(
                (reference.id.clone(), Manner::recorded(false)),
                Arc::new(clip),
            )])),
            rehearsed: Mutex::default(),
        };
        held.insert(id, Arc::new(stored));
        metrics::gauge!("sinew_clips").set(held.len() as f64);
        Ok(info)
    }

    /// Brings back a clip that was stored before. It is prepared when it is played.
    ///
    /// # Errors
    /// The name is taken or there is no room.
    pub fn restore(
        &self,
        new: NewClip,
        shown: &pb::Clip,
        reference: &BodyRef,
        source: MotionSource,
    ) -> Result<(), Fault> {
        let bytes = source_bytes(&source);
        let created = shown.create_time.and_then(|t| t.try_into().ok());
        let id = (new.id.clone())
            .ok_or_else(|| Fault::Internal("a stored clip without a name".into()))?;
        let info = ClipInfo {
            id: id.clone(),
            display_name: new.display_name.clone(),
            owner: new.owner.clone(),
            builtin: false,
            body: reference.id.clone(),
            rate_hz: shown.rate_hz,
            frames: usize::try_from(shown.frame_count).unwrap_or(0),
            duration: shown.duration_s,
            report: None,
            created,
            forecast: None,
            follow: new.follow,
        };
        let mut held = locked(&self.held);
        self.room(&held, &new, bytes)?;
        let stored = StoredClip {
            number: self.number(),
            info,
            source: Some(source),
            bytes,
            prepared: Mutex::default(),
            rehearsed: Mutex::default(),
        };
        held.insert(id, Arc::new(stored));
        metrics::gauge!("sinew_clips").set(held.len() as f64);
        Ok(())
    }

    /// Computes the report and the forecast of a clip that was brought back. Slow: not on an async thread.
    ///
    /// # Errors
    /// There is none of that name, it can no longer be prepared, or it was given up.
    pub fn complete(&self, id: &str, body: &Body, stop: &dyn Fn() -> bool) -> Result<(), Fault> {
        let stored = self.stored(id)?;
        let Some(source) = stored.source.clone() else {
            return Ok(());
        };
        let field = source_field(&source);
        let (clip, report) = engine::prepare(field, id, &source, body, 1.0, stop)?;
        let info = ClipInfo {
            report: report.map(Arc::new),
            forecast: Some(Arc::new(forecast_plain(body, &clip))),
            ..stored.info.clone()
        };
        let mut held = locked(&self.held);
        // It may have been deleted, and another clip of its name created.
        if held.get(id).is_some_and(|now| Arc::ptr_eq(now, &stored)) {
            let key = (info.body.clone(), Manner::recorded(false));
            let mut prepared = locked(&stored.prepared).clone();
            prepared.insert(key, Arc::new(clip));
            let stored = StoredClip {
                number: stored.number,
                info,
                source: Some(source),
                bytes: stored.bytes,
                prepared: Mutex::new(prepared),
                rehearsed: Mutex::new(locked(&stored.rehearsed).clone()),
            };
            held.insert(id.to_owned(), Arc::new(stored));
        }
        Ok(())
    }

    fn stored(&self, id: &str) -> Result<Arc<StoredClip>, Fault> {
        locked(&self.held)
            .get(id)
            .cloned()
            .ok_or_else(|| Fault::not_found("clip", format!("clips/{id}")))
    }

    /// One clip.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn info(&self, id: &str) -> Result<ClipInfo, Fault> {
        Ok(self.stored(id)?.info.clone())
    }

    /// All clips, by name.
    pub fn list(&self) -> Vec<ClipInfo> {
        locked(&self.held)
            .values()
            .map(|s| s.info.clone())
            .collect()
    }

    /// Forgets a clip. `gone` learns of it before its name is free.
    ///
    /// # Errors
    /// There is none of that name, or it is built in; or `gone` fails, and then the clip stays.
    pub fn delete(
        &self,
        id: &str,
        gone: impl FnOnce(&ClipInfo) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let mut held = locked(&self.held);
        match held.get(id) {
            None => Err(Fault::not_found("clip", format!("clips/{id}"))),
            Some(s) if s.info.builtin => Err(Fault::Precondition {
                reason: "CLIP_BUILTIN",
                message: format!("clip {id:?} comes with the server"),
                facts: vec![],
            }),
            Some(s) => {
                gone(&s.info)?;
                held.remove(id);
                metrics::gauge!("sinew_clips").set(held.len() as f64);
                Ok(())
            }
        }
    }

    /// The manner in which a clip to be played at `speed` is prepared, and the speed at which it is then played. A
    /// recording is prepared for its actual pace, because a motion that balances at one pace falls at another. A clip
    /// made of postures, or a built-in one, is played faster or slower as it is.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn manner(&self, id: &str, repeats: bool, speed: f64) -> Result<(Manner, f64), Fault> {
        let manner = match self.stored(id)?.source {
            Some(MotionSource::Bvh(..)) => Manner::paced(repeats, speed),
            Some(MotionSource::Postures { .. }) | None => Manner::recorded(repeats),
        };
        Ok((manner, speed / manner.tempo()))
    }

    /// A clip prepared for a body and the manner of playing it. Slow the first time: not on an async thread. It is
    /// given up once `stop` says so.
    ///
    /// # Errors
    /// There is none of that name, it cannot be prepared for this body, or it was given up.
    pub fn prepared(
        &self,
        id: &str,
        body_id: &str,
        body: &Body,
        manner: Manner,
        stop: &dyn Fn() -> bool,
    ) -> Result<Arc<Clip>, Fault> {
        let stored = self.stored(id)?;
        let key = (body_id.to_owned(), manner);
        if let Some(clip) = locked(&stored.prepared).get(&key) {
            return Ok(clip.clone());
        }
        if manner.repeats {
            let once = Manner {
                repeats: false,
                ..manner
            };
            let once = self.prepared(id, body_id, body, once, stop)?;
            let clip = cycle(body, &once).map_or(once, Arc::new);
            return self.keep(&stored, key, clip);
        }
        let clip = match &stored.source {
            None => engine::builtin(body, id)
                .ok_or_else(|| Fault::not_found("clip", format!("clips/{id}")))?,
            Some(source) => {
                let tempo = manner.tempo();
                engine::prepare(source_field(source), id, source, body, tempo, stop)?.0
            }
        };
        self.keep(&stored, key, Arc::new(clip))
    }

    /// Keeps a prepared clip. All held bytes count, including those that only a figure still plays.
    fn keep(
        &self,
        stored: &StoredClip,
        key: (String, Manner),
        clip: Arc<Clip>,
    ) -> Result<Arc<Clip>, Fault> {
        let held = locked(&self.held);
        self.space(&held, clip_bytes(&clip))?;
        let mut prepared = locked(&stored.prepared);
        if prepared.len() >= MAX_PREPARED {
            // Figures keep theirs; a clip that no figure plays is prepared again on request.
            prepared.retain(|_, c| Arc::strong_count(c) > 1);
        }
        Ok(prepared.entry(key).or_insert(clip).clone())
    }

    /// Memory for preparing a clip, bytes, approximately.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn memory(&self, id: &str) -> Result<u64, Fault> {
        let stored = self.stored(id)?;
        let file = stored.source.as_ref().map_or(0, source_bytes);
        // A number takes at least two bytes in a file, and eight once it is read.
        Ok(4 * file + SAMPLE_BYTES * stored.info.frames as u64)
    }

    /// The source from which a clip is rehearsed.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn score(&self, id: &str) -> Result<Score, Fault> {
        let stored = self.stored(id)?;
        Ok(Score {
            id: id.to_owned(),
            source: stored.source.clone(),
            number: stored.number,
        })
    }

    /// Whether the clip of which this was the score still exists.
    pub fn holds(&self, score: &Score) -> bool {
        let stored = self.stored(&score.id);
        stored.is_ok_and(|s| s.number == score.number)
    }

    fn number(&self) -> u64 {
        1 + self.count.fetch_add(1, Ordering::Relaxed)
    }

    /// Keeps a rehearsal of a clip. It replaces one for the same figure, or else the oldest if there are too many.
    /// Returns the replaced ones.
    ///
    /// # Errors
    /// The clip no longer exists, or there is no room.
    pub fn keep_rehearsed(
        &self,
        score: &Score,
        rehearsed: &Arc<Rehearsed>,
    ) -> Result<Vec<Arc<Rehearsed>>, Fault> {
        let stored = self.stored(&score.id)?;
        if stored.number != score.number {
            let name = format!("clips/{}", score.id);
            return Err(Fault::not_found("clip", name));
        }
        let held = locked(&self.held);
        self.space(&held, rehearsed.bytes())?;
        let mut all = locked(&stored.rehearsed);
        let like = |r: &mut Arc<Rehearsed>| r.performer.is_like(&rehearsed.performer);
        let mut gone: Vec<_> = all.extract_if(.., like).collect();
        if all.len() >= MAX_REHEARSED {
            gone.push(all.remove(0));
        }
        all.push(Arc::clone(rehearsed));
        Ok(gone)
    }

    /// Forgets a rehearsal.
    pub fn forget_rehearsed(&self, id: &str, rehearsed: &Arc<Rehearsed>) {
        if let Ok(stored) = self.stored(id) {
            locked(&stored.rehearsed).retain(|r| !Arc::ptr_eq(r, rehearsed));
        }
    }

    /// The rehearsals of a clip.
    pub fn rehearsed(&self, id: &str) -> Vec<Arc<Rehearsed>> {
        let stored = self.stored(id);
        stored.map_or_else(|_| Vec::new(), |s| locked(&s.rehearsed).clone())
    }

    /// A clip that is already prepared for a body and the manner of playing it.
    pub fn ready(&self, id: &str, body_id: &str, manner: Manner) -> Option<Arc<Clip>> {
        let stored = self.stored(id).ok()?;
        locked(&stored.prepared)
            .get(&(body_id.to_owned(), manner))
            .cloned()
    }
}

impl StoredClip {
    /// Bytes of the file and of everything prepared from it. Clips that were prepared twice by coincidence, or that
    /// repeat the same frames, are counted each time.
    fn used(&self) -> u64 {
        let prepared = locked(&self.prepared);
        let rehearsed = locked(&self.rehearsed);
        self.bytes
            + prepared.values().map(|c| clip_bytes(c)).sum::<u64>()
            + rehearsed.iter().map(|r| r.bytes()).sum::<u64>()
    }
}

fn clip_bytes(clip: &Clip) -> u64 {
    clip.len() as u64 * FRAME_BYTES
}

fn source_field(source: &MotionSource) -> &'static str {
    match source {
        MotionSource::Bvh(..) => "bvh",
        MotionSource::Postures { .. } => "frames",
    }
}

fn source_bytes(source: &MotionSource) -> u64 {
    match source {
        MotionSource::Bvh(bytes, _) => bytes.len() as u64,
        MotionSource::Postures { postures, .. } => (postures.len() * size_of::<Posture>()) as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_physics::motion::write_bvh;
    use sinew_wire::types::BvhReading;

    #[test]
    fn a_recording_is_prepared_for_its_pace_and_nothing_else_is() {
        let config = Config::default();
        let bodies = Bodies::new(&config);
        let clips = Clips::new(&config, &bodies).unwrap();
        let man = by_id("adult-man").unwrap();
        let body = bodies.get("body", &man).unwrap();
        let wave = engine::builtin(&body, "wave").unwrap();
        let postures: Vec<_> = (0..wave.len()).map(|i| *wave.posture(i)).collect();
        let file = write_bvh(&body, &postures, wave.rate_hz()).into_bytes();
        let source = MotionSource::Bvh(file.into(), BvhReading::default());
        let made = clips
            .create(
                NewClip {
                    id: Some("w".into()),
                    display_name: String::new(),
                    owner: None,
                    follow: FollowSettings::default(),
                },
                &man,
                &body,
                source,
                &|| false,
                &mut |_| Ok(()),
            )
            .unwrap();

        for (speed, tempo, rest) in [
            (1.0, 1.0, 1.0),
            (1.2, 1.2, 1.0),
            (3.0, 2.0, 1.5),
            (0.1, 0.5, 0.2),
            (1.013, 1.02, 1.013 / 1.02),
        ] {
            let (manner, left) = clips.manner("w", false, speed).unwrap();
            assert!((left - rest).abs() < 1e-12, "{speed}: {left}");
            assert!(clips.ready("w", &man.id, manner).is_some() == (tempo == 1.0));
            let clip = clips
                .prepared("w", &man.id, &body, manner, &|| false)
                .unwrap();
            assert!((clip.rate_hz() / (made.rate_hz * tempo) - 1.0).abs() < 1e-12);
            assert!(clips.ready("w", &man.id, manner).is_some());

            let (manner, left) = clips.manner("walk", true, speed).unwrap();
            assert_eq!(manner, Manner::recorded(true));
            assert_eq!(left, speed);
        }
        // However many paces are requested, the memory is bounded, and a clip that a figure plays stays.
        let (played, _) = clips.manner("w", false, 1.2).unwrap();
        let held = clips
            .prepared("w", &man.id, &body, played, &|| false)
            .unwrap();
        for k in 0..2 * MAX_PREPARED {
            let (manner, _) = clips.manner("w", false, 0.6 + 0.02 * k as f64).unwrap();
            clips
                .prepared("w", &man.id, &body, manner, &|| false)
                .unwrap();
            let stored = clips.stored("w").unwrap();
            assert!(locked(&stored.prepared).len() <= MAX_PREPARED);
        }
        let again = clips.ready("w", &man.id, played).unwrap();
        assert!(Arc::ptr_eq(&held, &again));
        assert!(clips.manner("none", false, 1.0).is_err());
    }
}
