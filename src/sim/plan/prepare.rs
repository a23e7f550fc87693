//! From a recorded motion in body scale to a reference that a body can follow: feet locked, legs reaching, balance
//! kept.

mod ankle_unloading;
mod compared;
mod deep_flexion;
mod joint_limits;
mod pelvis_yaw;
mod support_phases;
mod whole_body;

use super::ankle_torque_limit::AnkleTorqueLimit;
use super::flight_phases::{FlightPhases, roll_off};
use super::foot_lock::{LockedFoot, RecordedFoot, Sole, Stance, lock_foot, stances};
use super::pelvis_shift::{
    MassTrack, OtherSupport, ShiftProblem, SupportPhase, mass_track, pelvis_shift,
    pelvis_shift_in_run,
};
use crate::body::topology::DOF_COUNT;
use crate::body::{Body, Posture};
use crate::math::polygon::margin;
use crate::math::{Quat, Vec3};
use crate::plan::params::{balance, leg, pelvis};
use ankle_unloading::AnkleUnloading;
pub use compared::{Compared, Excess};
use deep_flexion::{DeepFlexion, unfold};
use joint_limits::{clamp_upper, into_limits};
pub use support_phases::ZmpOutside;
pub(super) use support_phases::{
    StandingFeet, limit_ankle_torques, other_support, planted_of, support_phases,
};
use support_phases::{within_reach, zmp_outside};
use whole_body::assemble;

/// A recorded motion in body scale, floor at z = 0: the input of the preparation.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Samples per second.
    pub rate_hz: f64,
    /// Pelvis pose, spine, neck and arms; the legs of these postures are not read.
    pub postures: Vec<Posture>,
    /// Left and right: knee axis (world, towards the figure's left) per sample.
    pub knee_axis: [Vec<Vec3>; 2],
    /// Left and right: ankle position per sample, m.
    pub ankle: [Vec<Vec3>; 2],
    /// Left and right: `world_from_foot` per sample.
    pub foot: [Vec<Quat>; 2],
    /// Left and right foot on the floor, per sample.
    pub label: Vec<[bool; 2]>,
}

/// Parts of the preparation to apply to the draft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrepareOptions {
    /// Lock planted feet to the floor.
    pub lock_feet: bool,
    /// Shift the trunk so that the zero-moment point stays in the support polygon.
    pub balance: bool,
    /// Prepare fast stretches with flights as a run.
    pub runs: bool,
    /// A planted foot that its leg cannot hold to this accuracy, m, is declared free.
    pub held: f64,
}

impl PrepareOptions {
    /// The complete preparation.
    pub(super) const FULL: Self = Self {
        lock_feet: true,
        balance: true,
        runs: true,
        held: leg::HELD,
    };
}

/// A motion that a body can follow.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Postures, one per sample.
    pub postures: Vec<Posture>,
    /// Feet locked to the floor: left, right.
    pub planted: Vec<[bool; 2]>,
    /// How far each DOF was outside the body's limits, rad, and in which fraction of the samples.
    pub clamped: [Excess; DOF_COUNT],
    /// Largest distance of a planted foot from its place, m: as recorded, and prepared.
    pub slide: Compared<f64>,
    /// Largest depth of a sole below the floor while the foot is on it, m: as recorded, and prepared.
    pub penetration: Compared<f64>,
    /// Zero-moment point before and after balancing.
    pub zmp: Compared<ZmpOutside>,
    /// Largest horizontal shift of the pelvis for balance, m.
    pub shift_max: f64,
    /// Largest lowering of the pelvis so that planted legs reach, m.
    pub drop_max: f64,
    /// Largest angle by which the pelvis is tilted back so that hips stay within their limits, rad.
    pub tilt_max: f64,
    /// Largest raise of the pelvis so that folded legs stay within their limits, m.
    pub raise_max: f64,
    /// Fraction of the samples in which something other than the feet carries the body.
    pub carried: f64,
    /// Fraction of foot samples that were declared free because the leg's limits do not let it hold the foot in place.
    pub freed: f64,
}

/// Turns a draft into a motion that the body can follow.
///
/// Memory and time are linear in the number of samples (times a handful of balancing rounds).
pub fn prepare(body: &Body, draft: &Draft, options: PrepareOptions) -> Prepared {
    prepare_in(body, draft, options, balance::ROUNDS)
}

/// The same with another number of rounds in which ankles are unloaded and the pelvis is shifted. With fewer than
/// [`balance::REACH_ROUND`], as for a seam between two motions, feet that their legs do not reach continue to carry:
/// taken off the floor they would step in place, and there is no time for that.
pub fn prepare_in(body: &Body, draft: &Draft, options: PrepareOptions, rounds: usize) -> Prepared {
    let mut work = PreparationWork::new(body, draft, options);
    let zmp_before = zmp_outside(&work.motion.track, &work.feet.support);
    let depth_before = work.recorded_depth();
    let short = draft.postures.len() < 8;
    let rounds = if options.lock_feet && !short {
        rounds
    } else {
        0
    };
    for round in 0..rounds {
        if round + 2 < rounds {
            work.unload_ankles();
        }
        if options.balance && round > 0 {
            work.shift_pelvis();
        }
        work.pose_legs();
        if round + balance::REACH_ROUND == rounds {
            work.release_unreached_feet();
        }
    }
    let folded = work.unfold_legs();
    work.report(folded, zmp_before, depth_before)
}

/// The state of the feet.
struct PreparedFeet {
    stances: [Vec<Stance>; 2],
    locked: [LockedFoot; 2],
    /// Whether each foot is locked to the floor, per sample.
    planted: Vec<[bool; 2]>,
    /// Whether each planted foot carries the body.
    carries: Vec<[bool; 2]>,
    support: Vec<SupportPhase>,
}

/// The changes made to the body.
struct PreparedMotion {
    postures: Vec<Posture>,
    track: MassTrack,
    /// Shift of the pelvis for balance, m.
    shift: Vec<[f64; 2]>,
    /// Lowering of the pelvis so that legs reach, m.
    drop: Vec<f64>,
}

/// A preparation under way; its methods are its stages.
struct PreparationWork<'a> {
    body: &'a Body,
    draft: &'a Draft,
    options: PrepareOptions,
    soles: [Sole; 2],
    ankle_limit: AnkleTorqueLimit,
    /// Postures of the draft with spine, neck and arms within their limits.
    upper: Vec<Posture>,
    clamped: [Excess; DOF_COUNT],
    flights: Option<FlightPhases>,
    unloading: AnkleUnloading,
    other_support: Vec<OtherSupport>,
    feet: PreparedFeet,
    motion: PreparedMotion,
}

impl<'a> PreparationWork<'a> {
    /// Locks the feet and solves the legs for the pelvis as recorded.
    fn new(body: &'a Body, draft: &'a Draft, options: PrepareOptions) -> Self {
        let n = draft.postures.len();
        let rate = draft.rate_hz;
        let soles = [Sole::new(body, 0), Sole::new(body, 1)];
        let mut upper = draft.postures.clone();
        let mut clamped = [Excess::default(); DOF_COUNT];
        clamp_upper(body, &mut upper, rate, &mut clamped);
        let low = pelvis::LYING * body.standing_root_height();
        let upright = |i: usize| options.lock_feet && upper[i].root_position.z > low;
        let label: [Vec<bool>; 2] =
            std::array::from_fn(|s| (0..n).map(|i| draft.label[i][s] && upright(i)).collect());
        let recorded = [0, 1].map(|s| draft.recorded_foot(s));
        let stances = stances(&soles, recorded, [&label[0], &label[1]], rate);
        let mut unloading = AnkleUnloading::new(n);
        let mut locked = lock(draft, &soles, &stances, &unloading);
        let runs = options.lock_feet && options.balance && options.runs;
        let flights = runs
            .then(|| FlightPhases::of(&upper, &draft.label, rate))
            .flatten();
        if flights.is_some() {
            for s in 0..2 {
                let turns = &mut unloading.feet[s];
                let (ankle, foot) = (&draft.ankle[s], &locked[s]);
                roll_off(&soles[s], ankle, foot, &stances[s], turns, rate);
            }
            locked = lock(draft, &soles, &stances, &unloading);
        }
        let planted = planted_of(&locked);
        let shift = vec![[0.0f64; 2]; n];
        let (postures, drop) = assemble(body, &upper, &locked, draft, &unloading, &shift, None);
        let standing = StandingFeet {
            soles: &soles,
            locked: &locked,
            carries: &planted,
        };
        let support = support_phases(body, standing, &upper, &draft.label);
        Self {
            other_support: other_support(body, &upper, &planted, rate),
            ankle_limit: AnkleTorqueLimit::new(body),
            motion: PreparedMotion {
                track: mass_track(body, &postures, rate),
                postures,
                shift,
                drop,
            },
            feet: PreparedFeet {
                stances,
                locked,
                carries: planted.clone(),
                planted,
                support,
            },
            body,
            draft,
            options,
            soles,
            upper,
            clamped,
            flights,
            unloading,
        }
    }

    fn standing_feet(&self) -> StandingFeet<'_> {
        StandingFeet {
            soles: &self.soles,
            locked: &self.feet.locked,
            carries: &self.feet.carries,
        }
    }

    fn update_support(&mut self) {
        let label = &self.draft.label;
        self.feet.support = support_phases(self.body, self.standing_feet(), &self.upper, label);
    }

    /// Bends heels, toes, legs and the pelvis where ankles and hips of planted feet lack range, and locks the feet
    /// again.
    fn unload_ankles(&mut self) {
        let stances = &self.feet.stances;
        self.unloading.add(
            self.body,
            &self.motion.postures,
            &self.feet.planted,
            [&stances[0], &stances[1]],
            self.flights.is_some(),
            self.draft.rate_hz,
        );
        self.feet.locked = lock(self.draft, &self.soles, stances, &self.unloading);
        self.update_support();
    }

    /// Shifts the pelvis so that the zero-moment point stays within the support of the feet.
    fn shift_pelvis(&mut self) {
        let rate_hz = self.draft.rate_hz;
        let runs = self.flights.is_some();
        let (feet, track) = (self.standing_feet(), &self.motion.track);
        let (limit, phases) = (&self.ankle_limit, &self.feet.support);
        let support = limit_ankle_torques(phases, feet, limit, track, runs, rate_hz);
        let problem = ShiftProblem {
            track,
            so_far: &self.motion.shift,
            support: &support,
            other_support: &self.other_support,
            inset: if runs {
                balance::RUN_INSET
            } else {
                balance::INSET
            },
            rate_hz,
        };
        let mut shift = match &self.flights {
            None => pelvis_shift(&problem),
            Some(f) => pelvis_shift_in_run(&problem, f.air()),
        };
        for s in &mut shift {
            let far = Vec3::on_floor(*s).level();
            if far > balance::MOST_SHIFT {
                *s = s.map(|x| x * balance::MOST_SHIFT / far);
            }
        }
        self.motion.shift = shift;
    }

    /// Lowers the pelvis until the legs reach and solves them.
    fn pose_legs(&mut self) {
        if let Some(f) = &mut self.flights {
            f.observe(&self.motion.track, &self.motion.drop);
        }
        (self.motion.postures, self.motion.drop) = assemble(
            self.body,
            &self.upper,
            &self.feet.locked,
            self.draft,
            &self.unloading,
            &self.motion.shift,
            self.flights.as_ref(),
        );
        self.motion.track = mass_track(self.body, &self.motion.postures, self.draft.rate_hz);
    }

    /// Excludes from the support the planted feet that their legs hold far from their places.
    fn release_unreached_feet(&mut self) {
        let (feet, postures) = (&self.feet, &self.motion.postures);
        let locked = (&self.soles, &feet.locked);
        self.feet.carries = within_reach(self.body, postures, &feet.planted, locked.0, locked.1);
        self.update_support();
    }

    /// Tilts and raises the pelvis for legs that fold further than the body's can.
    fn unfold_legs(&mut self) -> DeepFlexion {
        if !self.options.lock_feet {
            return DeepFlexion::default();
        }
        let (postures, feet) = (&mut self.motion.postures, &self.feet);
        unfold(
            self.body,
            postures,
            &feet.planted,
            &self.soles,
            &feet.locked,
            self.draft.rate_hz,
        )
    }

    /// Deepest penetration of the floor by the sole of a planted foot, as recorded, m.
    fn recorded_depth(&self) -> f64 {
        let draft = self.draft;
        let mut depth: f64 = 0.0;
        for s in 0..2 {
            for i in (0..draft.postures.len()).filter(|i| draft.label[*i][s]) {
                let toe = self.feet.locked[s].poses[i].toe;
                let low = draft.ankle[s][i].z + self.soles[s].lowest(draft.foot[s][i], toe);
                depth = depth.max(-low);
            }
        }
        depth
    }

    /// Brings the legs within their limits, which may free feet, and reports the result.
    fn report(
        mut self,
        folded: DeepFlexion,
        zmp_before: ZmpOutside,
        depth_before: f64,
    ) -> Prepared {
        let (feet, motion) = (&mut self.feet, &mut self.motion);
        let held = into_limits(
            self.body,
            &mut motion.postures,
            &mut feet.planted,
            &self.soles,
            &feet.locked,
            self.options.held,
            &mut self.clamped,
        );
        let n = motion.postures.len();
        let track = mass_track(self.body, &motion.postures, self.draft.rate_hz);
        let far = |i: &usize| match &feet.support[*i] {
            SupportPhase::Feet(p) => margin(p, track.zmp[*i]) < -balance::OTHER_SUPPORT,
            SupportPhase::Other => true,
            SupportPhase::Air => false,
        };
        let carried = (0..n).filter(far).count();
        let [left, right] = &feet.locked;
        let shifts = motion.shift.iter().map(|s| Vec3::on_floor(*s).level());
        Prepared {
            clamped: self.clamped,
            slide: Compared {
                recorded: left.slide_before.max(right.slide_before),
                prepared: held.slide,
            },
            penetration: Compared {
                recorded: depth_before,
                prepared: held.penetration,
            },
            zmp: Compared {
                recorded: zmp_before,
                prepared: zmp_outside(&track, &feet.support),
            },
            shift_max: shifts.fold(0.0, f64::max),
            drop_max: -motion.drop.iter().copied().fold(0.0, f64::min),
            tilt_max: folded.tilt_max,
            raise_max: folded.raise_max,
            carried: carried as f64 / n.max(1) as f64,
            freed: held.freed as f64 / (2 * n).max(1) as f64,
            postures: self.motion.postures,
            planted: self.feet.planted,
        }
    }
}

/// Locks the feet of a draft to the floor in their stances.
fn lock(
    draft: &Draft,
    soles: &[Sole; 2],
    stances: &[Vec<Stance>; 2],
    unloading: &AnkleUnloading,
) -> [LockedFoot; 2] {
    std::array::from_fn(|s| {
        lock_foot(
            &soles[s],
            draft.recorded_foot(s),
            &stances[s],
            &stances[1 - s],
            &unloading.feet[s],
            s,
            draft.rate_hz,
        )
    })
}

impl Draft {
    fn recorded_foot(&self, side: usize) -> RecordedFoot<'_> {
        RecordedFoot {
            ankles: &self.ankle[side],
            rotations: &self.foot[side],
        }
    }
}
