//! Stops, transitions and loops of corpus motions, as a figure requests them.

use crate::common::corpus::piece;
use crate::corpus::recorded::{RetargetOptions, man, motion, motions};
use sinew_physics::body::Body;
use sinew_physics::motion::target::Target;
use sinew_physics::motion::{Clip, read};
use sinew_physics::plan::cycle;
use sinew_physics::plan::motion_transition::{
    LeavingSamples, NextClip, TransitionCandidates, TransitionClip,
};
use sinew_physics::plan::prepare_recording;
use sinew_physics::plan::splice::{self, Sample, StandGoal};
use sinew_physics::plan::stream;
use std::sync::Arc;

/// Known time of its motion before and after the moment at which a figure is told to stop, s.
const STOP_KNOWN: [f64; 2] = [1.4, 0.8];
/// The same for a transition, s, and its samples per second.
const TRANSITION_KNOWN: [f64; 2] = [0.5, 1.55];
const TRANSITION_RATE: f64 = 120.0;
/// Time in which a plan is computed, in ticks of 1/60 s, s; until then the motion continues unchanged.
const LEAD: f64 = 4.0 / 60.0;

/// A plan that continues a motion from some moment.
pub struct Continued {
    /// The motion that it continues, in the time of the plan, s.
    pub before: Box<dyn Fn(f64) -> Target>,
    /// Time of the plan at which it may begin to differ, s.
    pub leaves: f64,
    /// The plan. Time 0 is its first sample.
    pub clip: Clip,
}

/// Samples of a motion, as plans take them.
fn known(of: &impl Fn(f64) -> Target, rate: f64, [before, after]: [f64; 2]) -> Vec<Sample> {
    let count = ((before + after) * rate).round() as usize;
    let at = |i: usize| of(i as f64 / rate - before);
    let samples = (0..=count).map(at);
    samples.map(|t| (t.posture, t.planted)).collect()
}

/// The stop of `clip` at time `at`, s; `None` if it already stands there.
pub fn stop(body: &Arc<Body>, clip: &Arc<Clip>, at: f64) -> Option<Continued> {
    let clip = Arc::clone(clip);
    let of = move |t: f64| clip.sample(at + t);
    let samples = known(&of, stream::RATE, STOP_KNOWN);
    let leaves = STOP_KNOWN[0] + LEAD;
    let now = (leaves * stream::RATE).round() as usize;
    Some(Continued {
        clip: splice::stop(body, samples, now, StandGoal::default())?,
        before: Box::new(move |t| of(t - STOP_KNOWN[0])),
        leaves,
    })
}

/// A transition from one clip into another, with the first motion moved to the place of the second.
pub struct WayOver {
    pub left: Continued,
    pub way: TransitionClip,
}

/// The first possible transition from `clip` at time `at`, s, into `next`; `None` if there is none.
pub fn way_over(body: &Arc<Body>, clip: &Arc<Clip>, at: f64, next: &Arc<Clip>) -> Option<WayOver> {
    let clip = Arc::clone(clip);
    let of = move |t: f64| clip.sample(at + t);
    let samples = known(&of, TRANSITION_RATE, TRANSITION_KNOWN);
    let leaves = TRANSITION_KNOWN[0] + LEAD;
    let now = (leaves * TRANSITION_RATE).round() as usize;
    let next = NextClip {
        clip: Arc::clone(next),
        speed: 1.0,
        looped: false,
    };
    let ways =
        TransitionCandidates::new(body, samples, LeavingSamples { now, earliest: now }, next);
    let (way, place) = (0..ways.moments().len()).find_map(|k| ways.way(k))?;
    let mut clip = way.clip.clone();
    let (postures, planted) = clip
        .samples()
        .map(|(p, planted)| {
            let mut p = *p;
            place.apply_posture(&mut p);
            (p, planted)
        })
        .unzip();
    clip = Clip::from_postures(clip.name(), clip.rate_hz(), postures, planted).unwrap();
    Some(WayOver {
        left: Continued {
            before: Box::new(move |t| of(t - TRANSITION_KNOWN[0])),
            leaves,
            clip,
        },
        way,
    })
}

/// Names of the motions that walk.
pub fn walks() -> Vec<&'static str> {
    let all = motions().iter().filter(|m| m.script.kind == "walk");
    all.map(|m| m.script.name.as_str()).collect()
}

/// The middle of a recorded walk: it begins and ends in full stride, and so has a lead-in and a lead-out.
pub fn strides(name: &str) -> Arc<Clip> {
    let long = motion(name).duration();
    let part = piece(&format!("{name}.vrm"), 0.3 * long, 0.7 * long);
    let fitted = prepare_recording(&read(&part).unwrap(), &man(), &RetargetOptions::default());
    Arc::new(fitted.unwrap().clip)
}

/// Moments spread over a clip, s.
pub fn moments(clip: &Clip, count: u32) -> impl Iterator<Item = f64> + use<> {
    let long = clip.duration();
    (0..count).map(move |k| long * (f64::from(k) + 0.5) / f64::from(count))
}

/// The clip made to repeat; unchanged if it already does.
pub fn repeated(clip: &Arc<Clip>) -> Arc<Clip> {
    cycle(&man(), clip).map_or_else(|| Arc::clone(clip), Arc::new)
}
