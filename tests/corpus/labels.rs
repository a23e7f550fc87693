//! When feet stand: the labels of the retargeter against the truth.

use crate::recorded::{Fit, Truth, fits};
use sinew::sim::plan::contact_labels::ContactPhase;

/// How well labels agree with the truth.
pub struct Agreement {
    pub precision: f64,
    pub recall: f64,
    /// Error of each touch-down, s: label minus truth.
    pub touch_downs: Vec<f64>,
    /// Touch-downs of the truth without a label nearby.
    pub missed: usize,
}

/// A label this far from a touch-down belongs to another one, s.
const NEAR: f64 = 0.15;

fn planted(phases: &[ContactPhase], t: f64) -> [bool; 2] {
    let phase = phases.iter().find(|p| t >= p.start && t < p.end);
    phase.map_or([false; 2], |p| p.planted)
}

fn agreement(truth: &Truth, phases: &[ContactPhase]) -> Agreement {
    let (mut both, mut labelled, mut true_ones) = (0.0, 0.0, 0.0);
    let end = phases.last().map_or(0.0, |p| p.end);
    let mut t = 0.0;
    while t < end {
        let (a, b) = (planted(phases, t), truth.planted(t));
        for side in 0..2 {
            both += f64::from(a[side] && b[side]);
            labelled += f64::from(a[side]);
            true_ones += f64::from(b[side]);
        }
        t += 1.0 / 240.0;
    }
    let mut onsets: [Vec<f64>; 2] = Default::default();
    for pair in phases.windows(2) {
        for side in 0..2 {
            if !pair[0].planted[side] && pair[1].planted[side] {
                onsets[side].push(pair[1].start);
            }
        }
    }
    let mut touch_downs = Vec::new();
    let mut missed = 0;
    for h in truth.footholds().iter().filter(|h| h.from > 0.05) {
        let nearest = onsets[h.side]
            .iter()
            .map(|t| t - h.from)
            .min_by(|a, b| a.abs().total_cmp(&b.abs()));
        match nearest.filter(|e| e.abs() < NEAR) {
            Some(e) => touch_downs.push(e),
            None => missed += 1,
        }
    }
    Agreement {
        precision: both / labelled,
        recall: both / true_ones,
        touch_downs,
        missed,
    }
}

pub fn labelled(f: &Fit) -> Agreement {
    agreement(&f.truth(), &f.fitted.report.feet.phases)
}

#[test]
fn standing_feet_are_labelled_as_planted() {
    for f in fits() {
        let a = labelled(f);
        let (what, kind) = (f.what(), f.motion.script.kind);
        // Feet of the jog are fast until the sole is flat.
        let least = match (kind, f.noisy()) {
            ("run", _) => 0.90,
            (_, true) => 0.95,
            _ => 0.985,
        };
        assert!(a.recall > least, "{what}: recall {}", a.recall);
    }
}

#[test]
fn feet_in_the_air_are_not_labelled_as_planted() {
    for f in fits() {
        let a = labelled(f);
        // A label begins up to a tenth of a second before the touch-down, where the foot is low and slow, and ends
        // after the lift-off. The feet that turn on the spot and that are put down slowly after the kick are labelled
        // in the air too.
        let least = match (f.motion.script.name.as_str(), f.motion.script.kind) {
            ("turn", _) => 0.75,
            (_, "stand" | "floor") => 0.997,
            (_, "jump") => 0.98,
            _ => 0.90,
        };
        assert!(
            a.precision > least,
            "{}: precision {}",
            f.what(),
            a.precision
        );
    }
}

#[test]
fn touch_downs_are_labelled_when_they_are() {
    let mut count = 0;
    for f in fits().filter(|f| !["turn", "kick"].contains(&f.motion.script.name.as_str())) {
        let a = labelled(f);
        let what = f.what();
        assert_eq!(a.missed, 0, "{what}: touch-downs without a label");
        let worst = a.touch_downs.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        let mean = a.touch_downs.iter().sum::<f64>() / a.touch_downs.len().max(1) as f64;
        // Slow feet are labelled before they touch.
        let (most, early) = match f.motion.script.name.as_str() {
            "walk-slow" | "walk-crouched" => (0.12, 0.07),
            _ => (0.09, 0.06),
        };
        assert!(worst < most, "{what}: a touch-down is {worst} s off");
        assert!(
            mean > -early && mean < 0.03,
            "{what}: touch-downs are {mean} s late on average"
        );
        count += a.touch_downs.len();
    }
    assert!(count > 240, "{count} touch-downs");
}

#[test]
fn flights_are_labelled_and_only_flights() {
    for f in fits() {
        let phases = &f.fitted.report.feet.phases;
        let flights = f.truth().flights();
        // A noisy file may lose its feet for some frames where one foot takes over from the other.
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
