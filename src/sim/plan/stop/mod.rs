//! From a stand into a motion and back to a stand: the samples before the first and after the last recorded one.
//!
//! A recording that ends in full stride has no last posture that a body could hold. This module adds the steps that
//! bring it to a stand. They are planned on a pendulum that starts where the recording stops (`footsteps`) and walked
//! by feet that roll and swing (`foot_curves`), while trunk and arms come to ease. The beginning is the same thing
//! backwards. The result is a draft like any other; [`super::prepare`] locks its feet and makes the whole body keep its
//! balance.

mod foot_curves;
mod footsteps;
mod initial_state;

use super::foot_lock::Sole;
use super::prepare::Draft;
use crate::body::topology::{FEET, NV};
use crate::body::{Body, Posture};
use crate::math::curve::{min_jerk, smootherstep};
use crate::math::exp::exp;
use crate::math::{Quat, Vec3};
use crate::motion::builtin::at_ease;
use crate::motion::filter::low_pass_points;
use crate::motion::leg_ik::{forward, knee_axis};
use crate::plan::params::{pelvis, stance, stop};
use footsteps::{Footsteps, StandingPose, StepFeet, StepSearch, footsteps, frequency};
use initial_state::InitialState;

fn turned(yaw: f64, v: Vec3) -> Vec3 {
    Quat::exp(Vec3::Z * yaw).rotate(v)
}

/// The intended end of a motion.
#[derive(Clone, Copy)]
enum StopGoal<'a> {
    /// Standing; at ease if it does not stand already.
    Stand,
    /// The same for a reversed motion, which in the world will come from there.
    Origin,
    /// At rest: unchanged if it is, else standing at ease.
    AtRest,
    /// Standing in this posture, if it does not stand like that already.
    Like(&'a Posture),
    /// At rest in this posture, however near to it and slow it is.
    Rest(&'a Posture),
}

/// Samples after the last one of `draft`, from its motion to its goal. `None` if it is there already, if it does not
/// walk, or if no steps are found that stop it.
fn steps_to_stand(body: &Body, draft: &Draft, goal: StopGoal<'_>, spare: f64) -> Option<Draft> {
    if draft.postures.len() < 3 {
        return None;
    }
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let from = InitialState::of(body, draft, &soles);
    let mut stand = match goal {
        StopGoal::Stand | StopGoal::Origin | StopGoal::AtRest => {
            StandingPose::of(body, &at_ease(body))
        }
        StopGoal::Like(posture) | StopGoal::Rest(posture) => StandingPose::of(body, posture),
    };
    // A body that sits or lies is not led to a stand; one that squats is on its feet.
    let stands = StepFeet::of(&from, &soles).stop_here(&from, frequency(&from, &stand));
    if !stands && from.posture.root_position.z < pelvis::UPRIGHT * body.standing_root_height() {
        return None;
    }
    if stands && matches!(goal, StopGoal::AtRest) {
        // The body needs no step, only time.
        stand = StandingPose::of(body, &from.posture);
    }
    let is_there = match goal {
        StopGoal::Stand | StopGoal::Origin => true,
        StopGoal::AtRest => !from.moves(),
        StopGoal::Like(posture) => alike(&from.posture, posture),
        StopGoal::Rest(_) => false,
    };
    if is_there && stands {
        return None;
    }
    let search = StepSearch {
        leg: body.leg_length(0),
        rate_hz: draft.rate_hz,
        spare,
    };
    let found = footsteps(&from, &stand, &soles, search)?;
    let path = PathOptions {
        knee_axis: [0, 1].map(|s: usize| draft.knee_axis[s].last().copied().unwrap_or(Vec3::Y)),
        rate_hz: draft.rate_hz,
        lands: !matches!(goal, StopGoal::Origin),
    };
    Some(along_footsteps(&from, &stand, &soles, &found, path))
}

/// How the motion along footsteps begins and is sampled.
struct PathOptions {
    /// Knee axes at the start.
    knee_axis: [Vec3; 2],
    /// Samples per second.
    rate_hz: f64,
    /// Whether a foot that comes down here also does so in the world, where time may run the other way.
    lands: bool,
}

/// The motion along footsteps: the pelvis moves with the pendulum's mass, the feet from foothold to foothold, and
/// everything else comes to ease.
fn along_footsteps(
    from: &InitialState,
    stand: &StandingPose,
    soles: &[Sole; 2],
    found: &Footsteps,
    options: PathOptions,
) -> Draft {
    let (axis, rate) = (options.knee_axis, options.rate_hz);
    let upright =
        Quat::exp(Vec3::Z * (found.heading - stand.heading)) * stand.posture.root_rotation;
    // The pendulum's zero-moment point jumps from foot to foot; a body's does not.
    let mut path = found.path.clone();
    low_pass_points(&mut path, stop::PATH_CUTOFF, rate);
    let offset = (from.posture.root_position - from.com).horizontal();
    let end_offset = turned(found.heading, (stand.pelvis - stand.mass).horizontal());
    let mut out = Draft::empty(rate);
    for i in 1..path.len() {
        let t = i as f64 / rate;
        let s = smootherstep(t / stop::EASE_TIME);
        let mut p = from.posture;
        // Rates die away while the joints come to ease.
        let mut rates = from.rates;
        rates[3..6].fill(0.0);
        p.integrate(
            &rates,
            stop::RATE_DECAY * (1.0 - exp(-t / stop::RATE_DECAY)),
        );
        let mut way = [0.0; NV];
        let spin = (upright * p.root_rotation.conjugate()).log() * s;
        way[..3].copy_from_slice(&spin.to_array());
        for (w, d) in way[6..].iter_mut().zip(p.joint_difference(&stand.posture)) {
            *w = s * d;
        }
        p.integrate(&way, 1.0);
        let at = path[i] + offset * (1.0 - s) + end_offset * s;
        p.root_position = Vec3 {
            z: min_jerk(
                from.posture.root_position.z,
                from.velocity.z,
                stand.pelvis.z,
                stop::EASE_TIME,
                t,
            ),
            ..at
        };
        let mut label = [true; 2];
        for side in 0..2 {
            let foot = foot_curves::EndingFoot {
                side,
                yaw: found.heading + stand.yaw[side],
                lands: options.lands,
            };
            let foot = foot_curves::pose(from, &found.steps, &soles[side], foot, t);
            out.ankle[side].push(foot.ankle);
            out.foot[side].push(foot.rotation);
            label[side] = foot.down;
            let axis = axis[side] * (1.0 - s) + p.root_rotation.rotate(Vec3::Y) * s;
            out.knee_axis[side].push(axis.normalized_or(Vec3::Y));
        }
        out.label.push(label);
        out.postures.push(p);
    }
    out
}

/// Whether two postures differ by no movement worth making.
fn alike(a: &Posture, b: &Posture) -> bool {
    a.joint_difference(b)
        .iter()
        .all(|e| e.abs() < stop::SAME_JOINT)
}

impl Draft {
    fn empty(rate_hz: f64) -> Self {
        Self {
            rate_hz,
            postures: Vec::new(),
            knee_axis: Default::default(),
            ankle: Default::default(),
            foot: Default::default(),
            label: Vec::new(),
        }
    }

    /// Whole postures, legs included, with each foot labelled as on the floor or not.
    pub fn of_postures(
        body: &Body,
        rate_hz: f64,
        postures: Vec<Posture>,
        label: Vec<[bool; 2]>,
    ) -> Self {
        let mut out = Self::empty(rate_hz);
        for p in &postures {
            let poses = forward(body, p);
            for s in 0..2 {
                let (ankle, foot) = poses[FEET[s].index()];
                out.ankle[s].push(ankle);
                out.foot[s].push(foot);
                out.knee_axis[s].push(knee_axis(p, s == 0));
            }
        }
        out.postures = postures;
        out.label = label;
        out
    }

    /// The same motion backwards.
    fn reverse(&mut self) {
        self.postures.reverse();
        self.label.reverse();
        for s in 0..2 {
            self.knee_axis[s].reverse();
            self.ankle[s].reverse();
            self.foot[s].reverse();
        }
    }

    /// Leaves those feet on the floor that lift at the very end: a body that is about to stop need not lift them.
    fn put_down(&mut self) {
        let most = (stance::OVERLAP * self.rate_hz) as usize;
        for s in 0..2 {
            let on = |l: &[bool; 2]| l[s];
            if let Some(last) = self.label.iter().rposition(on) {
                let lifted = &mut self.label[last + 1..];
                if lifted.len() <= most {
                    lifted.iter_mut().for_each(|l| l[s] = true);
                }
            }
        }
    }

    /// Appends an end, if there is one. Returns its number of samples.
    fn go_on(&mut self, end: Option<Self>) -> usize {
        let Some(end) = end else {
            return 0;
        };
        let count = end.postures.len();
        self.postures.extend(end.postures);
        self.label.extend(end.label);
        let parts = end.knee_axis.into_iter().zip(end.ankle).zip(end.foot);
        for (s, ((axis, ankle), foot)) in parts.enumerate() {
            self.knee_axis[s].extend(axis);
            self.ankle[s].extend(ankle);
            self.foot[s].extend(foot);
        }
        count
    }

    fn end(&mut self, body: &Body, goal: StopGoal<'_>, spare: f64) -> usize {
        self.put_down();
        let after = steps_to_stand(body, self, goal, spare);
        self.go_on(after)
    }

    /// Continues a draft of whole postures so that it ends standing like `goal`, wherever that is. Returns the number
    /// of samples added.
    pub fn end_like(&mut self, body: &Body, goal: &Posture) -> usize {
        self.end(body, StopGoal::Like(goal), 0.0)
    }

    /// The same, but coming to rest in exactly that posture, however little that takes.
    pub fn end_at_rest(&mut self, body: &Body, goal: &Posture) -> usize {
        self.end(body, StopGoal::Rest(goal), 0.0)
    }

    /// Continues a draft of whole postures to a stand, wherever that is. Returns the number of samples added; none if
    /// it stands, sits or lies already.
    ///
    /// * `given`: the moment is given, or the motion poorly known: a larger margin is kept than for a moment that was
    ///   chosen for being easy.
    pub fn end_standing(&mut self, body: &Body, given: bool) -> usize {
        let spare = if given { stop::SPARE_TIME } else { 0.0 };
        self.end(body, StopGoal::Stand, spare)
    }

    /// Continues a draft of whole postures to a stand and makes it begin in one, unless it stands, sits or lies there
    /// already. Returns how many samples were added before and after.
    pub fn add_ends(&mut self, body: &Body) -> (usize, usize) {
        self.put_down();
        let after = steps_to_stand(body, self, StopGoal::AtRest, stop::SPARE_TIME);
        self.reverse();
        let before = self.end(body, StopGoal::Origin, stop::SPARE_TIME);
        self.reverse();
        (before, self.go_on(after))
    }
}
