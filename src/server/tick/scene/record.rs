//! The changes of a world in one round of its clock, as bytes and back.
//!
//! ```text
//!   record: seq u64 │ fresh u8 │ items
//!   item:   1 length input (postcard)
//!           2 player sequence source_ns arrival flags [planted] posture [velocity]     a frame of live motion
//!           3 lost                                                                      a tick samples live motion
//!           4 figure late                                                               plans that were late in it
//! ```
//!
//! Integers are of variable length. Numbers of a frame are written as differences from an extrapolation of the two
//! frames before, without their zero bytes; not a bit is lost. A `fresh` record forgets everything before it. The first
//! one after each checkpoint is fresh, so that reading can begin there.

use super::input::{PlayerKey, SceneInput};
use crate::engine::FigureKey;
use crate::ingest::jitter_buffer::BufferedFrame;
use crate::ingest::time::{ScheduledTime, SourceTime};
use bytes::Bytes;
use sinew_physics::body::topology::{BALL_COUNT, HINGE_COUNT};
use sinew_physics::body::{NV, Posture};
use sinew_physics::figure::LatePlans;
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::saved::{self, Definition};
use std::cell::Cell;
use std::time::Instant;

/// Numbers of a posture.
const POSTURE: usize = 7 + 4 * BALL_COUNT + HINGE_COUNT;
/// Numbers of a frame with its velocity.
const NUMBERS: usize = POSTURE + NV;
/// Players whose past is remembered; the frames of others are written in full.
const MAX_PASTS: usize = 1024;

const INPUT: u8 = 1;
const FRAME: u8 = 2;
const TICK: u8 = 3;
const LATE: u8 = 4;

/// The changes of a world in one round.
#[derive(Clone)]
pub struct RoundRecord {
    /// Its number; numbers grow by one.
    pub seq: u64,
    /// The tick before which it was made.
    pub tick: u64,
    /// The encoded record.
    pub bytes: Bytes,
    /// Clips to which it refers.
    pub definitions: Vec<Definition>,
}

impl std::fmt::Debug for RoundRecord {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "record {} of {} bytes", self.seq, self.bytes.len())
    }
}

/// An item of a record.
#[derive(Debug)]
pub enum RecordItem {
    /// A change.
    Input(Box<SceneInput>),
    /// A frame of live motion, and when it arrived.
    Frame(PlayerKey, Box<BufferedFrame>, ScheduledTime),
    /// A tick samples live motion, with the world time that the clock has skipped, s.
    Tick(f64),
    /// Plans of a figure that were late in it.
    Late(FigureKey, LatePlans),
}

/// Why a record cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a record that cannot be: {0}")]
pub struct Unreadable(pub &'static str);

/// The last frames of one player, from which the next is guessed.
#[derive(Clone, Debug)]
struct FramePast {
    player: PlayerKey,
    times: [i64; 2],
    sequence: i64,
    last: Box<[f64; NUMBERS]>,
    slope: Box<[f64; NUMBERS]>,
}

impl FramePast {
    fn new(player: PlayerKey) -> Self {
        Self {
            player,
            times: [0; 2],
            sequence: 0,
            last: Box::new([0.0; NUMBERS]),
            slope: Box::new([0.0; NUMBERS]),
        }
    }

    fn guess(&self, i: usize) -> u64 {
        // As a difference, a negative zero would not stay one.
        let next = if self.slope[i] == 0.0 {
            self.last[i]
        } else {
            self.last[i] + self.slope[i]
        };
        next.to_bits()
    }

    fn take(&mut self, i: usize, x: f64) {
        let slope = x - self.last[i];
        self.slope[i] = if slope.is_finite() { slope } else { 0.0 };
        self.last[i] = if x.is_finite() { x } else { 0.0 };
    }

    fn time(&self) -> i64 {
        self.times[1].wrapping_add(self.times[1].wrapping_sub(self.times[0]))
    }

    fn take_time(&mut self, sequence: i64, source_ns: i64) {
        self.times = [self.times[1], source_ns];
        self.sequence = sequence;
    }
}

/// The state of writing or reading: earlier definitions and frames.
#[derive(Clone, Debug, Default)]
struct Pasts(Vec<FramePast>);

impl Pasts {
    fn of(&mut self, player: PlayerKey) -> &mut FramePast {
        let i = match self.0.iter().position(|p| p.player == player) {
            Some(i) => i,
            None => {
                if self.0.len() == MAX_PASTS {
                    self.0.remove(0);
                }
                self.0.push(FramePast::new(player));
                self.0.len() - 1
            }
        };
        &mut self.0[i]
    }
}

fn numbers(p: &Posture, out: &mut [f64; NUMBERS]) {
    out[..3].copy_from_slice(&p.root_position.to_array());
    out[3..7].copy_from_slice(&p.root_rotation.to_xyzw());
    for (b, q) in p.ball.iter().enumerate() {
        out[7 + 4 * b..11 + 4 * b].copy_from_slice(&q.to_xyzw());
    }
    out[POSTURE - HINGE_COUNT..POSTURE].copy_from_slice(&p.hinge);
}

fn posture(x: &[f64]) -> Posture {
    let quat = |at: usize| Quat::from_xyzw([x[at], x[at + 1], x[at + 2], x[at + 3]]);
    Posture {
        root_position: Vec3 {
            x: x[0],
            y: x[1],
            z: x[2],
        },
        root_rotation: quat(3),
        ball: std::array::from_fn(|b| quat(7 + 4 * b)),
        hinge: std::array::from_fn(|h| x[POSTURE - HINGE_COUNT + h]),
    }
}

fn put(out: &mut Vec<u8>, mut x: u64) {
    while x >= 0x80 {
        out.push(x as u8 | 0x80);
        x >>= 7;
    }
    out.push(x as u8);
}

fn put_signed(out: &mut Vec<u8>, x: i64) {
    put(out, ((x << 1) ^ (x >> 63)) as u64);
}

/// Words without their leading zero bytes; the counts for two words stand before them.
fn put_words(out: &mut Vec<u8>, words: &[u64]) {
    for pair in words.chunks(2) {
        let length = |w: u64| 8 - w.leading_zeros() as usize / 8;
        let lengths = [length(pair[0]), pair.get(1).map_or(0, |w| length(*w))];
        out.push((lengths[0] | lengths[1] << 4) as u8);
        for (word, length) in pair.iter().zip(lengths) {
            out.extend_from_slice(&word.to_le_bytes()[..length]);
        }
    }
}

/// Writes records. Its buffers are reused.
#[derive(Debug, Default)]
pub struct RecordWriter {
    on: bool,
    bytes: Vec<u8>,
    definitions: Vec<SharedDefinition>,
    tick: u64,
    /// Number of records until now.
    seq: u64,
    fresh: bool,
    pasts: Pasts,
    /// The value written last.
    lost: Option<u64>,
}

/// How far a record had been written.
#[derive(Clone, Copy, Debug)]
pub struct RecordMark {
    bytes: usize,
    definitions: usize,
    fresh: bool,
}

/// A definition, wrapped so that it can be shown.
struct SharedDefinition(Definition);

impl std::fmt::Debug for SharedDefinition {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("definition")
    }
}

impl RecordWriter {
    /// A writer after `seq` records that writes nothing until it is turned on.
    pub fn after(seq: u64) -> Self {
        Self {
            seq,
            ..Self::default()
        }
    }

    /// Turns writing on.
    pub fn turn_on(&mut self) {
        self.on = true;
        self.forget();
    }

    /// Number of records until now.
    pub fn seq(&self) -> u64 {
        self.seq
    }

    /// Notes that a record was read and applied.
    pub fn passed(&mut self, seq: u64) {
        self.seq = seq;
    }

    /// Makes the next record readable without those before.
    pub fn forget(&mut self) {
        self.fresh = true;
        self.pasts.0.clear();
        self.lost = None;
    }

    fn begin(&mut self, tick: u64) -> bool {
        if self.on && self.bytes.is_empty() {
            self.tick = tick;
            put(&mut self.bytes, self.seq + 1);
            self.bytes.push(u8::from(std::mem::take(&mut self.fresh)));
        }
        self.on
    }

    /// The present position.
    pub fn mark(&self) -> RecordMark {
        RecordMark {
            bytes: self.bytes.len(),
            definitions: self.definitions.len(),
            fresh: self.fresh,
        }
    }

    /// Takes back the changes written since the mark, because they did not take place.
    pub fn retract(&mut self, mark: RecordMark) {
        self.bytes.truncate(mark.bytes);
        self.definitions.truncate(mark.definitions);
        self.fresh = mark.fresh;
    }

    /// A change before a tick.
    pub fn input(&mut self, tick: u64, input: &SceneInput) {
        if !self.begin(tick) {
            return;
        }
        let known = self.definitions.len();
        let (written, definitions) = saved::collecting(|| postcard::to_stdvec(input));
        let written = written.expect("what an input consists of can be written");
        self.bytes.push(INPUT);
        // Numbers of definitions begin at 0 in each input; here they are made those of the record.
        put(&mut self.bytes, known as u64);
        put(&mut self.bytes, definitions.len() as u64);
        put(&mut self.bytes, written.len() as u64);
        self.bytes.extend_from_slice(&written);
        self.definitions
            .extend(definitions.into_iter().map(SharedDefinition));
    }

    /// A frame that arrived at scheduled time `at`.
    pub fn frame(
        &mut self,
        tick: u64,
        player: PlayerKey,
        frame: &BufferedFrame,
        at: ScheduledTime,
    ) {
        if !self.begin(tick) {
            return;
        }
        let past = self.pasts.of(player);
        let out = &mut self.bytes;
        out.push(FRAME);
        put(out, player);
        put_signed(out, frame.sequence.wrapping_sub(past.sequence));
        put_signed(out, frame.source.0.wrapping_sub(past.time()));
        out.extend_from_slice(&at.0.to_le_bytes());
        let planted = frame
            .planted
            .map_or(0, |[l, r]| 4 | u8::from(l) | u8::from(r) << 1);
        out.push(planted | u8::from(frame.velocity.is_some()) << 3);
        let mut x = [0.0; NUMBERS];
        numbers(&frame.posture, &mut x);
        let count = match &frame.velocity {
            Some(v) => {
                x[POSTURE..].copy_from_slice(&**v);
                NUMBERS
            }
            None => POSTURE,
        };
        let mut words = [0; NUMBERS];
        for (i, word) in words[..count].iter_mut().enumerate() {
            *word = x[i].to_bits() ^ past.guess(i);
            past.take(i, x[i]);
        }
        put_words(out, &words[..count]);
        past.take_time(frame.sequence, frame.source.0);
    }

    /// A tick samples live motion.
    pub fn sampled(&mut self, tick: u64, lost: f64) {
        if self.lost != Some(lost.to_bits()) && self.begin(tick) {
            self.lost = Some(lost.to_bits());
            self.bytes.push(TICK);
            self.bytes.extend_from_slice(&lost.to_le_bytes());
        }
    }

    /// Plans that were late in a tick.
    pub fn late(&mut self, tick: u64, figure: FigureKey, late: LatePlans) {
        if self.begin(tick) {
            self.bytes.push(LATE);
            put(&mut self.bytes, figure.0);
            self.bytes
                .push(u8::from(late.exit) | u8::from(late.entry) << 1);
        }
    }

    /// The bytes since the last call, if there are any.
    pub fn take(&mut self) -> Option<RoundRecord> {
        if self.bytes.is_empty() {
            return None;
        }
        self.seq += 1;
        let bytes = Bytes::copy_from_slice(&self.bytes);
        self.bytes.clear();
        Some(RoundRecord {
            seq: self.seq,
            tick: self.tick,
            bytes,
            definitions: self.definitions.drain(..).map(|d| d.0).collect(),
        })
    }

    /// Forgets what was written since the last call of [`Self::take`].
    pub fn discard(&mut self) {
        if !self.bytes.is_empty() {
            self.bytes.clear();
            self.definitions.clear();
            // The discarded bytes lack the frame from which this one was guessed.
            self.forget();
        }
    }
}

/// Reads records one after the other.
#[derive(Debug, Default)]
pub struct RecordReader {
    pasts: Pasts,
}

/// Bytes that are being read.
struct RemainingBytes<'a>(&'a [u8]);

impl<'a> RemainingBytes<'a> {
    fn take(&mut self, n: usize) -> Result<&'a [u8], Unreadable> {
        let (head, rest) = self.0.split_at_checked(n).ok_or(Unreadable("it ends"))?;
        self.0 = rest;
        Ok(head)
    }

    fn byte(&mut self) -> Result<u8, Unreadable> {
        Ok(self.take(1)?[0])
    }

    fn number(&mut self) -> Result<u64, Unreadable> {
        let mut x = 0;
        for shift in (0..64).step_by(7) {
            let b = self.byte()?;
            x |= u64::from(b & 0x7f) << shift;
            if b < 0x80 {
                return Ok(x);
            }
        }
        Err(Unreadable("a number that is too long"))
    }

    fn signed(&mut self) -> Result<i64, Unreadable> {
        let x = self.number()?;
        Ok((x >> 1) as i64 ^ -((x & 1) as i64))
    }

    fn float(&mut self) -> Result<f64, Unreadable> {
        let bytes = self.take(8)?.try_into().expect("eight bytes");
        let x = f64::from_le_bytes(bytes);
        if x.is_finite() {
            Ok(x)
        } else {
            Err(Unreadable("a number that is not finite"))
        }
    }

    fn words(&mut self, words: &mut [u64]) -> Result<(), Unreadable> {
        for pair in words.chunks_mut(2) {
            let lengths = self.byte()?;
            let lengths = [usize::from(lengths & 15), usize::from(lengths >> 4)];
            for (word, length) in pair.iter_mut().zip(lengths) {
                let mut bytes = [0; 8];
                bytes
                    .get_mut(..length)
                    .ok_or(Unreadable("a word of more than eight bytes"))?
                    .copy_from_slice(self.take(length)?);
                *word = u64::from_le_bytes(bytes);
            }
        }
        Ok(())
    }
}

impl RecordReader {
    /// Number of a record.
    ///
    /// # Errors
    /// It is no record.
    pub fn seq(bytes: &[u8]) -> Result<u64, Unreadable> {
        RemainingBytes(bytes).number()
    }

    /// Hands the items of a record, in order, to `each`, until it returns an error.
    ///
    /// # Errors
    /// Bytes that cannot have been written, or the error that `each` returns.
    pub fn read<E: From<Unreadable>>(
        &mut self,
        record: &[u8],
        definitions: &[Definition],
        mut each: impl FnMut(RecordItem) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut rest = RemainingBytes(record);
        rest.number()?;
        if rest.byte()? != 0 {
            self.pasts.0.clear();
        }
        while !rest.0.is_empty() {
            let item = match rest.byte()? {
                INPUT => Self::input(&mut rest, definitions)?,
                FRAME => self.frame(&mut rest)?,
                TICK => RecordItem::Tick(rest.float()?),
                LATE => {
                    let figure = FigureKey(rest.number()?);
                    let late = rest.byte()?;
                    let late = LatePlans {
                        exit: late & 1 != 0,
                        entry: late & 2 != 0,
                    };
                    RecordItem::Late(figure, late)
                }
                _ => return Err(Unreadable("an item of an unknown kind").into()),
            };
            each(item)?;
        }
        Ok(())
    }

    fn input(
        rest: &mut RemainingBytes<'_>,
        definitions: &[Definition],
    ) -> Result<RecordItem, Unreadable> {
        let (first, count) = (rest.number()?, rest.number()?);
        let length = usize::try_from(rest.number()?).unwrap_or(usize::MAX);
        let bytes = rest.take(length)?;
        let range = usize::try_from(first)
            .ok()
            .zip(usize::try_from(first.saturating_add(count)).ok())
            .map(|(from, to)| from..to);
        let own = range
            .and_then(|r| definitions.get(r))
            .ok_or(Unreadable("a clip is missing"))?;
        let read = saved::with_definitions(own.to_vec(), || postcard::take_from_bytes(bytes));
        match read {
            Ok((input, [])) => Ok(RecordItem::Input(Box::new(input))),
            _ => Err(Unreadable("a change of an unknown kind")),
        }
    }

    fn frame(&mut self, rest: &mut RemainingBytes<'_>) -> Result<RecordItem, Unreadable> {
        let player = rest.number()?;
        let past = self.pasts.of(player);
        let sequence = past.sequence.wrapping_add(rest.signed()?);
        let source_ns = past.time().wrapping_add(rest.signed()?);
        let at = ScheduledTime(rest.float()?);
        let flags = rest.byte()?;
        let has_velocity = flags & 8 != 0;
        let count = if has_velocity { NUMBERS } else { POSTURE };
        let mut words = [0; NUMBERS];
        rest.words(&mut words[..count])?;
        let mut x = [0.0; NUMBERS];
        for i in 0..count {
            x[i] = f64::from_bits(words[i] ^ past.guess(i));
            past.take(i, x[i]);
        }
        past.take_time(sequence, source_ns);
        if !x.iter().all(|x| x.is_finite()) {
            return Err(Unreadable("a posture that is not finite"));
        }
        let velocity = has_velocity.then(|| {
            let mut v = Box::new([0.0; NV]);
            v.copy_from_slice(&x[POSTURE..]);
            v
        });
        let frame = BufferedFrame {
            sequence,
            source: SourceTime(source_ns),
            posture: posture(&x),
            velocity,
            planted: (flags & 4 != 0).then_some([flags & 1 != 0, flags & 2 != 0]),
            guess: Cell::default(),
            arrival: Instant::now(),
        };
        Ok(RecordItem::Frame(player, Box::new(frame), at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(i: i64) -> BufferedFrame {
        let t = i as f64 / 60.0;
        let mut posture = Posture::default();
        posture.root_position.z = 0.93 + 0.01 * (6.0 * t).sin();
        posture.root_position.x = 1.1 * t;
        for (k, b) in posture.ball.iter_mut().enumerate() {
            let turn = Vec3::X * (0.5 * (4.0 * t + k as f64).sin());
            *b = Quat::exp(turn);
        }
        for (k, h) in posture.hinge.iter_mut().enumerate() {
            *h = 0.3 + 0.2 * (5.0 * t + k as f64).cos();
        }
        let velocity =
            (i % 3 == 0).then(|| Box::new(std::array::from_fn(|k| (k as f64 * t).sin())));
        BufferedFrame {
            sequence: 7 + i,
            source: SourceTime(16_666_667 * i - i % 2),
            posture,
            velocity,
            planted: [None, Some([true, false])][(i % 2) as usize],
            guess: Cell::default(),
            arrival: Instant::now(),
        }
    }

    fn items(reader: &mut RecordReader, record: &RoundRecord) -> Vec<RecordItem> {
        let mut out = Vec::new();
        reader
            .read::<Unreadable>(&record.bytes, &record.definitions, |item| {
                out.push(item);
                Ok(())
            })
            .unwrap();
        out
    }

    #[test]
    fn what_is_read_is_what_was_written_bit_for_bit() {
        let mut writer = RecordWriter::after(4);
        writer.turn_on();
        let mut reader = RecordReader::default();
        for i in 0..40 {
            for player in [3, 9] {
                let at = ScheduledTime(0.1 * i as f64);
                writer.frame(i as u64, player, &frame(i + player as i64), at);
            }
            writer.sampled(i as u64, 0.5);
            if i == 20 {
                writer.late(
                    20,
                    FigureKey(300),
                    LatePlans {
                        exit: true,
                        entry: false,
                    },
                );
                writer.forget(); // a checkpoint; the record before it is still guessed
            }
            let record = writer.take().unwrap();
            assert_eq!((record.tick, record.seq), (i as u64, 5 + i as u64));
            assert_eq!(RecordReader::seq(&record.bytes), Ok(record.seq));
            if i == 21 {
                reader = RecordReader::default();
            }
            let items = items(&mut reader, &record);
            for (player, item) in [3, 9].iter().zip(&items) {
                let RecordItem::Frame(key, read, at) = item else {
                    panic!("{item:?}")
                };
                assert_eq!((key, at.0), (player, 0.1 * i as f64));
                let wrote = BufferedFrame {
                    arrival: read.arrival,
                    ..frame(i + *player as i64)
                };
                assert_eq!(format!("{read:?}"), format!("{wrote:?}"));
            }
            let late = items
                .iter()
                .filter(|i| matches!(i, RecordItem::Late(FigureKey(300), l) if l.exit));
            assert_eq!(late.count(), usize::from(i == 20));
            let ticks = items.iter().filter(|i| matches!(i, RecordItem::Tick(0.5)));
            assert_eq!(ticks.count(), usize::from(i == 0 || i == 21));
        }
        assert!(writer.take().is_none());
    }

    #[test]
    fn frames_are_small() {
        let mut writer = RecordWriter::after(0);
        writer.turn_on();
        let (mut moving, mut still) = (0, 0);
        for i in 0..60 {
            let plain = |i| BufferedFrame {
                velocity: None,
                ..frame(i)
            };
            writer.frame(0, 1, &plain(i), ScheduledTime(0.0));
            moving = writer.take().unwrap().bytes.len();
            writer.frame(
                0,
                2,
                &BufferedFrame {
                    sequence: i,
                    source: SourceTime(i),
                    ..plain(0)
                },
                ScheduledTime(0.0),
            );
            still = writer.take().unwrap().bytes.len();
        }
        assert!(moving < 360 && still < 50, "{moving} and {still} bytes");
    }

    #[test]
    fn any_bytes_are_read_or_refused() {
        use proptest::prelude::*;
        proptest!(|(bytes in proptest::collection::vec(any::<u8>(), 0..600))| {
            let _ = RecordReader::default().read::<Unreadable>(&bytes, &[], |_| Ok(()));
        });
    }
}
