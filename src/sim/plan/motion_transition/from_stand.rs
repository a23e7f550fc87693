//! From a stand into a clip that does not begin like it: with other feet planted, in another posture, or in motion.
//!
//! The path is a stop planned for the reversed beginning of the clip ([`crate::plan::stop`]): the steps that would
//! bring the reversed motion to that very stand, prepared together with the part of the clip that follows them. If the
//! clip began at once instead, it would throw arms and trunk about, drag feet that stand elsewhere, and ask for a
//! velocity that a standing body does not have.

use super::candidates::{Features, far};
use super::{NextClip, TransitionClip, samples_in};
use crate::body::{Body, Posture};
use crate::math::{Vec3, trig};
use crate::motion::GRAVITY;
use crate::motion::clip::Clip;
use crate::plan::cycle::relabel_prepared;
use crate::plan::foot_lock::FootPlacement;
use crate::plan::params::{balance, common, stop, transition};
use crate::plan::prepare::{Draft, prepare_in};
use crate::plan::splice::{SEAM_OPTIONS, blend_from_played};
use crate::plan::turned_on_floor;
use crate::time::MotionTime;

impl NextClip {
    /// Whether a body that stands like `stand` can let the clip begin at its time `first` without any preparation. No
    /// platform-dependent rounding, since the tick asks for it.
    pub fn begins_as(&self, body: &Body, first: MotionTime, stand: &Posture) -> bool {
        let sample = |t: MotionTime| (self.sample(t).posture, [true; 2]);
        let later = self.speed / stop::RATE;
        let samples = [(*stand, [true; 2]), sample(first), sample(first + later)];
        let features = Features::new(body, &samples);
        let omega = (GRAVITY / features.com[0].z.max(balance::LEAST_HEIGHT)).sqrt();
        let is = seen(&features.feet[0], features.com[0]);
        let moves = (features.com[2] - features.com[1]) * (stop::RATE / omega);
        let begins = seen(&features.feet[1], features.com[1] + moves);
        let joints = stand.joint_difference(&samples[1].0);
        let rates = samples[1].0.joint_difference(&samples[2].0);
        far(is.left, begins.left) < common::MISPLACED_BY
            && trig::wrapped(begins.turn - is.turn).abs() < common::MISPLACED_TURN
            && far(is.point, begins.point) < transition::BEGIN_CAPTURE
            && joints.iter().all(|e| e.abs() < transition::BEGIN_JOINT)
            && rates
                .iter()
                .all(|e| e.abs() * stop::RATE < transition::BEGIN_RATE)
    }

    /// The path from standing like `stand` into the clip, which begins at its time `first`. `None` if there is none.
    pub fn from_stand(
        &self,
        body: &Body,
        first: MotionTime,
        stand: &Posture,
    ) -> Option<TransitionClip> {
        let held = samples_in(stop::BLEND_TIME);
        let seen = samples_in(stop::BLEND_TIME + stop::PREPARED_TIME);
        let mut known = self.samples(first, seen + 1);
        let (mut postures, planted): (Vec<_>, Vec<_>) = known.iter().copied().unzip();
        let mut label = relabel_prepared(body, stop::RATE, &postures, &planted);
        known.reverse();
        postures.reverse();
        label.reverse();
        let mut draft = Draft::of_postures(body, stop::RATE, postures, label);
        let added = draft.end_at_rest(body, stand);
        if added == 0 {
            return None;
        }
        let mut whole = prepare_in(body, &draft, SEAM_OPTIONS, balance::SEAM_ROUNDS);
        blend_from_played(&mut whole.postures, &known, seen - held);
        whole.postures.reverse();
        whole.planted.reverse();
        let rate = stop::RATE / self.speed;
        let clip =
            Clip::from_postures(self.clip.name(), rate, whole.postures, whole.planted).ok()?;
        let begin = first - added as f64 / rate;
        Some(TransitionClip {
            clip,
            begin,
            enters: begin,
            until: first + held as f64 / rate,
        })
    }
}

/// Quantities seen from the middle between two feet.
struct AboutFeet {
    /// Place of the left foot, m.
    left: [f64; 2],
    /// Heading of the left foot, rad.
    turn: f64,
    /// A point over the floor, m.
    point: [f64; 2],
}

fn seen(feet: &[FootPlacement; 2], point: Vec3) -> AboutFeet {
    let half = 0.5 * trig::wrapped(feet[1].yaw - feet[0].yaw);
    let heading = feet[0].yaw + half;
    let middle = (feet[0].place + feet[1].place) * 0.5;
    let from = |p: Vec3| turned_on_floor([p.x - middle.x, p.y - middle.y], -heading);
    AboutFeet {
        left: from(feet[0].place),
        turn: -half,
        point: from(point),
    }
}
