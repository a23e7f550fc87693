//! Step plans: when and where the feet of a clip or of a stream stand, in order, including across the seam of a loop.

use super::params::step_plan::{
    FALLING_LOAD, LOAD_SAMPLES, NEAR_FLOOR, PAUSE_AFTER, PAUSE_BEFORE, STREAM_REST_AFTER,
    STREAM_REST_BEFORE,
};
use crate::body::{Body, Posture};
use crate::math::Vec3;
use crate::math::runs::{remove_short, stretches};
use crate::motion::Clip;
use crate::motion::clip::{MAX_SAMPLES, PlanarTransform};
use crate::motion::leg_ik::forward;
use crate::plan::foot_lock::{AnklePose, Sole};
use crate::plan::motion_transition::TransitionClip;
use crate::plan::params::contact::SHORTEST_TOLD;
use crate::plan::pelvis_shift::mass_track;
use crate::plan::stream;
use crate::plan::stream::StreamPlan;
use serde::{Deserialize, Serialize};

/// A stance of one foot as the clip has it. Times in clip seconds, place and heading in clip coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Footfall {
    /// Touch-down, s.
    pub on: f64,
    /// Lift-off, s.
    pub off: f64,
    /// Point of the floor under the flat ankle, m.
    pub place: Vec3,
    /// Heading of the foot, rad.
    pub yaw: f64,
}

impl Footfall {
    /// This stance, `seconds` later.
    fn later(self, seconds: f64) -> Self {
        Self {
            on: self.on + seconds,
            off: self.off + seconds,
            ..self
        }
    }
}

/// The stances of a clip. Made when a clip begins to play; queries allocate nothing.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StepPlan {
    /// Of the left and the right foot.
    stances: [Vec<Footfall>; 2],
    /// Time at which the motion begins, s: 0, or earlier if it has a lead-in.
    begin: f64,
    /// Time at which it ends, including its lead-out, s.
    duration: f64,
    /// Time up to which touch-downs are known, s; for a stream, the end of the frames received.
    seen: f64,
    /// Displacement of one round, if the clip repeats.
    round: Option<PlanarTransform>,
    /// A plan that holds instead before some time: the transition into a repeating clip with its first round, or the
    /// transition out of another motion.
    #[serde(with = "crate::saved::nested")]
    lead: Option<Box<Lead>>,
}

/// A plan that holds before another one.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Lead {
    plan: StepPlan,
    /// End of the time in which it holds, s.
    until: f64,
    /// Time up to which it knows touch-downs, s.
    knows: f64,
}

/// For each sample, whether no foot is planted and the body falls.
fn falling(body: &Body, samples: &[(&Posture, [bool; 2])], rate_hz: f64) -> Vec<bool> {
    let mut falls = vec![false; samples.len()];
    let off: Vec<bool> = samples.iter().map(|s| s.1 == [false; 2]).collect();
    for (i, j) in stretches(&off) {
        let from = i.saturating_sub(LOAD_SAMPLES);
        let near = &samples[from..(j + LOAD_SAMPLES).min(samples.len())];
        let postures: Vec<Posture> = near.iter().map(|s| *s.0).collect();
        let track = mass_track(body, &postures, rate_hz);
        for k in i..j {
            falls[k] = track.load[k - from] < FALLING_LOAD;
        }
    }
    falls
}

/// The feet that carry the body in each sample: the planted ones or, if there are none and the body does not fall, the
/// lower one near the floor. The preparation labels a foot as free if its leg cannot hold it exactly in place, but that
/// is not a flight.
fn supporting_feet(body: &Body, samples: &[(&Posture, [bool; 2])], rate_hz: f64) -> Vec<[bool; 2]> {
    let falls = falling(body, samples, rate_hz);
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let supporting = |(&(posture, planted), falls): (&(&Posture, [bool; 2]), bool)| {
        if planted != [false; 2] || falls {
            return planted;
        }
        let poses = forward(body, posture);
        let [left, right] = soles.each_ref().map(|sole| sole.lowest_at(&poses));
        [
            left < NEAR_FLOOR && left <= right,
            right < NEAR_FLOOR && right < left,
        ]
    };
    samples.iter().zip(falls).map(supporting).collect()
}

impl StepPlan {
    /// The plan of `clip` on `body`; `looped` if it repeats.
    pub fn new(body: &Body, clip: &Clip, looped: bool) -> Self {
        let rate = clip.rate_hz();
        // A round of a loop has neither a lead-in nor a lead-out.
        let (skipped, begin, duration) = if looped {
            let lead_in = (clip.lead_in() * rate).round() as usize;
            (lead_in, 0.0, clip.duration())
        } else {
            (0, -clip.lead_in(), clip.duration() + clip.lead_out())
        };
        let n = ((duration - begin) * rate).round() as usize + 1;
        let samples: Vec<_> = clip.samples().skip(skipped).take(n).collect();
        let planted = supporting_feet(body, &samples, rate);
        let stances = [0, 1].map(|side| {
            let sole = Sole::new(body, side);
            let stance = |(start, end): (usize, usize)| {
                // The middle of a stance is its flattest part.
                let poses = forward(body, samples[(start + end - 1) / 2].0);
                let at = sole.footing(AnklePose::of(&poses, side));
                // A sample represents the half-interval on either side of it.
                let time = |sample: usize| begin + (sample as f64 - 0.5) / rate;
                Footfall {
                    on: if start == 0 { begin } else { time(start) },
                    off: if end == n { duration } else { time(end) },
                    place: at.place,
                    yaw: at.yaw,
                }
            };
            let mut label: Vec<bool> = planted.iter().map(|p| p[side]).collect();
            remove_short(&mut label, (SHORTEST_TOLD * rate).floor());
            stretches(&label).map(stance).collect()
        });
        Self {
            stances,
            begin,
            duration,
            seen: f64::INFINITY,
            round: looped.then(|| clip.advance()),
            lead: (looped && clip.lead_in() > 0.0).then(|| {
                Box::new(Lead {
                    plan: Self::new(body, clip, false),
                    until: 0.0,
                    knows: duration,
                })
            }),
        }
    }

    /// This plan for a figure that enters the clip by the transition `way`. A transition into the lead-in is followed
    /// by the rest of the lead-in.
    pub fn entered_by(mut self, body: &Body, way: &TransitionClip) -> Self {
        if let Some(mut lead) = self.lead.take_if(|l| way.until.0 < l.until) {
            lead.plan = lead.plan.entered_by(body, way);
            self.lead = Some(lead);
            return self;
        }
        let mut plan = Self::new(body, &way.clip, false);
        plan.begin += way.begin.0;
        plan.duration += way.begin.0;
        for f in plan.stances.iter_mut().flatten() {
            *f = f.later(way.begin.0);
        }
        self.lead = Some(Box::new(Lead {
            plan,
            until: way.until.0,
            knows: f64::INFINITY,
        }));
        self
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let times = [self.begin, self.duration, self.seen];
        self.stances.iter().all(|s| s.len() <= MAX_SAMPLES)
            && times.iter().all(|t| !t.is_nan())
            && (self.round).is_none_or(|r| r.is_finite() && self.duration.is_finite())
            && (self.lead.as_ref()).is_none_or(|l| !l.until.is_nan() && l.plan.is_valid())
    }

    /// The plan of a stream: nothing is known yet.
    pub fn live() -> Self {
        Self {
            stances: std::array::from_fn(|_| Vec::with_capacity(stream::MOST_STANCES)),
            begin: 0.0,
            duration: f64::INFINITY,
            seen: 0.0,
            round: None,
            lead: None,
        }
    }

    /// Ends it at once: none of its later steps is made.
    pub(super) fn break_off(&mut self) {
        (self.duration, self.round, self.lead) = (f64::NEG_INFINITY, None, None);
        self.stances.iter_mut().for_each(Vec::clear);
    }

    /// Whether this is the plan of a stream.
    pub fn is_live(&self) -> bool {
        self.duration == f64::INFINITY
    }

    /// Updates the plan with the present knowledge of a stream. No allocation.
    pub fn refresh(&mut self, motion: &StreamPlan) {
        self.seen = motion.seen().0;
        for (side, known) in self.stances.iter_mut().enumerate() {
            known.clear();
            let seconds = |sample: i64| (sample as f64 - 0.5) / stream::RATE;
            known.extend(motion.stances(side).map(|s| Footfall {
                on: seconds(s.start),
                off: if s.end == i64::MAX {
                    f64::INFINITY
                } else {
                    seconds(s.end)
                },
                place: s.place,
                yaw: s.yaw,
            }));
        }
    }

    /// Whether it is the plan of a stream that stands on both feet at time `t` (s), has done so for a while, and will
    /// continue to as far as is known.
    pub fn rests(&self, t: f64) -> bool {
        let stands = |f: Footfall| f.on < t - STREAM_REST_BEFORE && f.off > t + STREAM_REST_AFTER;
        self.is_live() && (0..2).all(|side| self.current(side, t).is_some_and(stands))
    }

    /// Whether both feet have stood at time `t` (s) for longer than in any stride, and will stand for another moment,
    /// or for good.
    pub fn pauses(&self, t: f64) -> bool {
        let stays = |f: &Footfall| f.off > t + PAUSE_AFTER || self.is_over(f.off);
        let stands = |f: Footfall| f.on < t - PAUSE_BEFORE && stays(&f);
        (0..2).all(|side| self.current(side, t).is_some_and(stands))
    }

    /// Whether a foot leaves the floor anywhere.
    pub fn steps(&self) -> bool {
        self.is_live()
            || self.lead.as_ref().is_some_and(|l| l.plan.steps())
            || self
                .stances
                .iter()
                .any(|s| s.len() != 1 || s[0].on > self.begin || s[0].off < self.duration)
    }

    /// Whether a clip that does not repeat has played to its end.
    pub fn is_over(&self, t: f64) -> bool {
        self.round.is_none() && t >= self.duration
    }

    /// The plan that holds during the transition in.
    fn lead_at(&self, t: f64) -> Option<&Lead> {
        self.lead.as_deref().filter(|l| t < l.until)
    }

    /// Round of a loop that contains time `t`, and the time within it.
    fn round_of(&self, t: f64) -> (f64, f64) {
        if self.round.is_none() || self.duration <= 0.0 {
            return (0.0, t);
        }
        let round = (t / self.duration).floor();
        (round, t - round * self.duration)
    }

    /// Duration of `count` rounds of a loop, s; 0 for a motion that does not repeat, because a stream has no end.
    fn rounds(&self, count: f64) -> f64 {
        self.round.map_or(0.0, |_| count * self.duration)
    }

    fn unrolled(&self, f: Footfall, round: f64) -> Footfall {
        let Some(advance) = self.round else { return f };
        let moved = advance.power(round);
        Footfall {
            place: moved.point(f.place),
            yaw: f.yaw + moved.yaw,
            ..f.later(round * self.duration)
        }
    }

    /// Whether the stance at the seam continues in the next round.
    fn wraps(&self, side: usize) -> bool {
        let s = &self.stances[side];
        self.round.is_some()
            && s.first().is_some_and(|f| f.on <= 0.0)
            && s.last().is_some_and(|f| f.off >= self.duration)
    }

    /// Next touch-down of a foot (0 left, 1 right) after time `t` (s); `None` if it never lands again.
    pub fn next(&self, side: usize, t: f64) -> Option<Footfall> {
        if let Some(lead) = self.lead_at(t) {
            let known = |f: &Footfall| f.on < lead.knows;
            return (lead.plan.next(side, t).filter(known)).or_else(|| self.next(side, lead.until));
        }
        let (round, local) = self.round_of(t);
        let rounds = if self.round.is_some() { 2 } else { 1 };
        for k in 0..rounds {
            let first = usize::from(k > 0 && self.wraps(side));
            let shift = self.rounds(f64::from(k));
            for f in self.stances[side].iter().skip(first) {
                if f.on + shift > local {
                    return Some(self.unrolled(*f, round + f64::from(k)));
                }
            }
        }
        None
    }

    /// Earliest time at which a foot may touch down after time `t`, as far as is known, s; infinity if it never does.
    pub fn earliest(&self, side: usize, t: f64) -> f64 {
        self.next(side, t).map_or(self.seen, |f| f.on)
    }

    /// The stance that holds at time `t` (s).
    pub fn current(&self, side: usize, t: f64) -> Option<Footfall> {
        if let Some(lead) = self.lead_at(t) {
            return lead.plan.current(side, t);
        }
        let (round, local) = self.round_of(t);
        let end = self.duration;
        let f = self.stances[side].iter().find(|f| {
            (f.on <= local || f.on <= self.begin)
                && (local < f.off || (f.off >= end && self.round.is_none()))
        })?;
        Some(self.unrolled(*f, round))
    }

    /// The next interval without a standing foot after time `t`, at which one stands: start and end, s; for a stream,
    /// within the frames received. `None` if a foot lands before the other has left.
    pub fn next_flight(&self, t: f64) -> Option<(f64, f64)> {
        let stands_until = |side: usize| {
            let now = self.current(side, t)?;
            let (round, _) = self.round_of(t);
            let goes_on = self.wraps(side) && now.off >= (round + 1.0) * self.duration;
            // A foot that stands only during the transition in has no stance in the rounds.
            Some(match self.stances[side].first() {
                Some(first) if goes_on => self.unrolled(*first, round + 1.0).off,
                _ => now.off,
            })
        };
        let off = (0..2).filter_map(stands_until).reduce(f64::max)?;
        let on = f64::min(self.earliest(0, t), self.earliest(1, t));
        (on > off + SHORTEST_TOLD && on < f64::INFINITY).then_some((off, on))
    }

    /// Last lift-off of a foot at or before time `t`, s; the beginning of the clip if there was none.
    pub fn last_off(&self, side: usize, t: f64) -> f64 {
        if let Some(lead) = self.lead_at(t) {
            return lead.plan.last_off(side, t);
        }
        let (round, local) = self.round_of(t);
        let s = &self.stances[side];
        if let Some(f) = s.iter().rev().find(|f| f.off <= local) {
            return f.off + self.rounds(round);
        }
        match s.last() {
            Some(f) if self.round.is_some() && !self.wraps(side) => {
                f.off + self.rounds(round - 1.0)
            }
            _ => self.begin + self.rounds(round),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::builtin::builtin;
    use crate::time::StreamTime;
    use std::sync::Arc;

    fn stances(times: &[(f64, f64)]) -> Vec<Footfall> {
        let stance = |&(on, off): &(f64, f64)| Footfall {
            on,
            off,
            place: Vec3::zero(),
            yaw: 0.0,
        };
        times.iter().map(stance).collect()
    }

    fn plan(left: &[(f64, f64)], right: &[(f64, f64)], round: bool) -> StepPlan {
        StepPlan {
            stances: [stances(left), stances(right)],
            begin: 0.0,
            duration: 1.0,
            seen: f64::INFINITY,
            round: round.then(PlanarTransform::default),
            lead: None,
        }
    }

    #[test]
    fn a_stream_flies_before_its_landing_has_come() {
        let stream = |left: &[(f64, f64)], seen: f64| StepPlan {
            duration: f64::INFINITY,
            seen,
            ..plan(left, &[(0.0, 0.35)], false)
        };
        let stands = stream(&[(0.0, f64::INFINITY)], 0.5);
        assert_eq!(stands.next_flight(0.2), None, "one foot stays");
        assert_eq!(stands.earliest(1, 0.4), 0.5, "it may land as soon as that");
        let left = &[(0.0, 0.3)];
        assert_eq!(stream(left, 0.38).next_flight(0.2), None, "too short");
        assert_eq!(stream(left, 0.5).next_flight(0.2), Some((0.35, 0.5)));
        let landing = &[(0.0, 0.3), (0.6, f64::INFINITY)];
        assert_eq!(stream(landing, 0.7).next_flight(0.2), Some((0.35, 0.6)));
    }

    #[test]
    fn a_flight_is_the_time_after_the_last_foot_left_and_before_the_first_lands() {
        let jump = plan(
            &[(0.0, 0.3), (0.7, 1.0)],
            &[(0.0, 0.35), (0.65, 1.0)],
            false,
        );
        assert_eq!(jump.next_flight(0.1), Some((0.35, 0.65)));
        assert_eq!(jump.next_flight(0.32), Some((0.35, 0.65)));
        assert_eq!(jump.next_flight(0.5), None, "it flies already");
        assert_eq!(jump.next_flight(0.8), None, "it stays down");
        assert_eq!(jump.earliest(0, 0.8), f64::INFINITY, "it never lands again");
        let run = plan(&[(0.0, 0.3)], &[(0.5, 0.8)], true);
        assert_eq!(run.next_flight(0.1), Some((0.3, 0.5)));
        let next = run.next_flight(0.6).unwrap();
        assert!((next.0 - 0.8).abs() < 1e-12 && (next.1 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_walk_has_no_flight_not_even_over_the_seam() {
        // The left stance continues across the seam.
        let walk = plan(&[(0.0, 0.4), (0.8, 1.0)], &[(0.3, 0.9)], true);
        for i in 0..300 {
            let t = f64::from(i) * 0.01;
            assert_eq!(walk.next_flight(t), None, "{t}");
        }
    }

    #[test]
    fn the_plan_of_a_stream_knows_the_next_foothold_and_the_last_lift_off() {
        let body = Arc::new(Body::adult_man());
        let walk = builtin(&body, "walk").unwrap();
        let clip = StepPlan::new(&body, &walk, false);
        let mut live = StreamPlan::new(Arc::clone(&body), 1.0);
        let mut plan = StepPlan::live();
        let (mut known, mut unknown) = (0, 0);
        for i in 0..(walk.duration() * stream::RATE) as usize {
            live.push(&walk.sample(i as f64 / stream::RATE).posture, None);
            let t = i as f64 / stream::RATE - live.window();
            live.advance(StreamTime(t));
            plan.refresh(&live);
            for side in (0..2).filter(|s| t > 0.0 && plan.current(*s, t).is_none()) {
                // It has left the floor, and will have landed half a second later.
                let off = plan.last_off(side, t);
                assert!(off <= t && off > t - 1.0, "{t}: {off}");
                match plan.next(side, t) {
                    Some(f) => {
                        known += 1;
                        let meant = clip.next(side, off).unwrap();
                        assert!(f.on > t && (f.on - meant.on).abs() < 0.1, "{t}: {f:?}");
                    }
                    None => unknown += 1,
                }
            }
        }
        assert!(known > 60 && unknown < 5, "{known} known, {unknown} not");
    }
}
