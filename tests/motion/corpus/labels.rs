//! Stance of the feet: the labels of a recording, and the planted feet of the motion made from it, against the truth.

use crate::corpus::recorded::{Fit, fits};
use sinew_physics::plan::contact_labels::ContactPhase;
use std::collections::BTreeMap;

/// Samples per second at which contact is compared.
const RATE: f64 = 240.0;
/// A touch-down or lift-off with a larger error belongs to another phase of the gait, s: double support takes 0.1 to
/// 0.2 s.
const ON_TIME: f64 = 0.1;
/// Speeds this near to the ends of a cut recording are not those of its motion, s.
const END: f64 = 0.05;

fn planted(phases: &[ContactPhase], t: f64) -> [bool; 2] {
    let phase = phases.iter().find(|p| t >= p.start && t < p.end);
    phase.map_or([false; 2], |p| p.planted)
}

/// The labels of a recording at a time.
pub fn labelled(f: &Fit, t: f64) -> [bool; 2] {
    planted(&f.fitted.report.feet.phases, t)
}

/// The planted feet of the prepared motion at a time.
fn prepared(f: &Fit, t: f64) -> [bool; 2] {
    f.fitted.clip.sample(t).planted
}

/// Contact time of feet, s: in both, as found, and in the truth.
#[derive(Clone, Copy, Default)]
pub struct Overlap {
    both: f64,
    found: f64,
    truth: f64,
}

impl Overlap {
    fn add(&mut self, other: Self) {
        self.both += other.both;
        self.found += other.found;
        self.truth += other.truth;
    }
    pub fn precision(&self) -> f64 {
        self.both / self.found
    }
    pub fn recall(&self) -> f64 {
        self.both / self.truth
    }
}

/// Agreement of the contacts of a recording with the truth.
pub struct Agreement {
    pub overlap: Overlap,
    /// Touch-downs and lift-offs of the truth: found minus truth, s; `None` if no contact overlaps with the true one.
    pub events: [Vec<Option<f64>>; 2],
    /// Contacts that overlap with no true contact.
    invented: usize,
}

/// Intervals in which `on` holds, s.
fn contacts(on: impl Fn(f64) -> bool, end: f64) -> Vec<(f64, f64)> {
    let count = (end * RATE) as usize;
    let (mut out, mut from) = (Vec::new(), None);
    for i in 0..=count {
        let t = i as f64 / RATE;
        match (i < count && on(t), from) {
            (true, None) => from = Some(t),
            (false, Some(start)) => {
                out.push((start, t));
                from = None;
            }
            _ => {}
        }
    }
    out
}

pub fn agreement(f: &Fit, found: impl Fn(&Fit, f64) -> [bool; 2]) -> Agreement {
    let truth = f.truth();
    let end = f.fitted.report.feet.phases.last().map_or(0.0, |p| p.end);
    let mut out = Agreement {
        overlap: Overlap::default(),
        events: Default::default(),
        invented: 0,
    };
    for side in 0..2 {
        let ours = contacts(|t| found(f, t)[side], end);
        let theirs: Vec<(f64, f64)> = (truth.footholds().iter())
            .filter(|h| h.side == side)
            .map(|h| (h.from, h.until.min(end)))
            .collect();
        let shared = |a: &(f64, f64), b: &(f64, f64)| (a.1.min(b.1) - a.0.max(b.0)).max(0.0);
        let long = |all: &[(f64, f64)]| all.iter().map(|(a, b)| b - a).sum::<f64>();
        let both = ours
            .iter()
            .flat_map(|a| theirs.iter().map(move |b| shared(a, b)));
        out.overlap.add(Overlap {
            both: both.sum(),
            found: long(&ours),
            truth: long(&theirs),
        });
        for t in &theirs {
            let best = ours
                .iter()
                .max_by(|a, b| shared(a, t).total_cmp(&shared(b, t)));
            let best = best.filter(|o| shared(o, t) > 0.0);
            if t.0 > END {
                out.events[0].push(best.map(|o| o.0 - t.0));
            }
            if t.1 < end - END {
                out.events[1].push(best.map(|o| o.1 - t.1));
            }
        }
        let unknown = |o: &&(f64, f64)| theirs.iter().all(|t| shared(o, t) == 0.0);
        out.invented += ours.iter().filter(unknown).count();
    }
    out
}

#[test]
fn standing_feet_are_labelled_as_planted() {
    for f in fits() {
        let recall = agreement(f, labelled).overlap.recall();
        // Feet of the jog are fast until the sole is flat.
        let least = match (f.motion.script.kind, f.noisy()) {
            ("run", _) => 0.90,
            (_, true) => 0.95,
            _ => 0.985,
        };
        assert!(recall > least, "{}: recall {recall}", f.what());
    }
}

#[test]
fn feet_in_the_air_are_not_labelled_as_planted() {
    for f in fits() {
        let precision = agreement(f, labelled).overlap.precision();
        // A foot is low and slow for up to a tenth of a second before its touch-down and after its lift-off. Feet that
        // turn on the spot always are.
        let least = match f.motion.script.kind {
            "turn" => 0.75,
            "stand" | "floor" => 0.997,
            "jump" => 0.98,
            _ => 0.90,
        };
        assert!(precision > least, "{}: precision {precision}", f.what());
    }
}

/// Contact time of each kind of prepared motion: nine tenths of it are true, and nine tenths of the truth are found.
#[test]
fn prepared_feet_stand_when_they_stood() {
    let mut kinds: BTreeMap<&str, Overlap> = BTreeMap::new();
    // The feet of a body that lies down carry nothing, and the prepared motion labels them so.
    for f in fits().filter(|f| f.motion.script.kind != "floor") {
        let kind = kinds.entry(f.motion.script.kind).or_default();
        kind.add(agreement(f, prepared).overlap);
    }
    assert!(kinds.len() >= 6, "{:?}", kinds.keys());
    for (kind, o) in kinds {
        let (precision, recall) = (o.precision(), o.recall());
        assert!(
            precision > 0.9 && recall > 0.9,
            "{kind}: precision {precision}, recall {recall}"
        );
    }
}

/// Touch-downs and lift-offs are on time: of the labels nine of ten, and of the prepared motion, whose feet take the
/// steps that labels have missed, nineteen of twenty. No contact is invented there.
#[test]
fn feet_touch_down_and_lift_off_when_they_did() {
    type Contact = fn(&Fit, f64) -> [bool; 2];
    let sources: [(&str, Contact, f64); 2] = [
        ("labels", labelled, 0.9),
        ("prepared motion", prepared, 0.95),
    ];
    for (what, found, least) in sources {
        let mut all: [Vec<Option<f64>>; 2] = Default::default();
        let mut invented = 0;
        for f in fits() {
            let a = agreement(f, found);
            for (all, events) in all.iter_mut().zip(a.events) {
                all.extend(events);
            }
            invented += a.invented;
        }
        for (event, errors) in ["touch-downs", "lift-offs"].into_iter().zip(&all) {
            let on_time = |e: &&Option<f64>| e.is_some_and(|e| e.abs() < ON_TIME);
            let share = errors.iter().filter(on_time).count() as f64 / errors.len() as f64;
            assert!(errors.len() > 240, "{} {event}", errors.len());
            assert!(share > least, "{what}: {share} of the {event} are on time");
            assert!(errors.iter().all(Option::is_some), "{what}: {event} missed");
        }
        assert!(invented <= all[0].len() / 50, "{what}: {invented} invented");
    }
}

#[test]
fn flights_are_labelled_and_only_flights() {
    for f in fits() {
        let phases = &f.fitted.report.feet.phases;
        let flights = f.truth().flights();
        // A noisy file may lose both feet for some frames where one foot takes over from the other.
        let shortest = if f.noisy() { 0.10 } else { 0.04 };
        for p in phases
            .iter()
            .filter(|p| p.planted == [false; 2] && p.end - p.start > shortest)
        {
            let flies = flights
                .iter()
                .any(|(from, until)| p.start < until + 0.06 && p.end > from - 0.06);
            assert!(flies, "{}: labelled as a flight: {p:?}", f.what());
        }
        // Speeds of the first and last tenths of a second are those of a cut recording.
        let end = f.motion.duration() - 0.15;
        for (from, until) in flights.iter().filter(|(a, b)| *a > 0.05 && *b < end) {
            let middle = 0.5 * (from + until);
            assert_eq!(
                planted(phases, middle),
                [false; 2],
                "{} at {middle} s",
                f.what()
            );
        }
    }
}
