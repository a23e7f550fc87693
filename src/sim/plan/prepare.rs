//! From a recorded motion in body scale to a reference that a body can follow: feet locked, legs reaching, balance
//! kept.

mod ankle_unloading;
mod deep_flexion;
mod joint_limits;
mod pelvis_yaw;
mod support_phases;
mod whole_body;

use super::ankle_torque_limit::AnkleTorqueLimit;
use super::flight_phases::{FlightPhases, roll_off};
use super::foot_lock::{LockedFoot, Sole, lock_foot, stances};
use super::pelvis_shift::{Carrier, mass_track, pelvis_shift, pelvis_shift_in_run};
use crate::sim::body::topology::{DOF_COUNT, L_FOOT, R_FOOT, SegmentId};
use crate::sim::body::{Body, Posture};
use crate::sim::math::polygon::margin;
use crate::sim::math::{Quat, Vec3};
use crate::sim::plan::params::{balance, contact};
use ankle_unloading::AnkleUnloading;
use deep_flexion::{DeepFlexion, unfold};
use joint_limits::{clamp_upper, into_limits};
pub use support_phases::ZmpOutside;
pub(super) use support_phases::{carriers_of, held_by, may_rest, planted_of};
use support_phases::{held_in_gait, within_reach, zmp_outside};
use whole_body::assemble;
pub(super) use whole_body::leg_geometry;

/// A recorded motion in body scale, floor at z = 0: what the preparation starts from.
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

/// What to do with the draft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrepareOptions {
    /// Lock planted feet to the floor.
    pub lock_feet: bool,
    /// Shift the trunk so that the zero-moment point stays in the support polygon.
    pub balance: bool,
    /// Prepare what flies fast as a run: a row of flights.
    pub runs: bool,
    /// A planted foot that its leg cannot hold to this accuracy is declared free, m.
    pub held: f64,
}

/// A motion that a body can follow.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Postures, one per sample.
    pub postures: Vec<Posture>,
    /// Feet locked to the floor: left, right.
    pub planted: Vec<[bool; 2]>,
    /// By how much each DOF was outside the body's limits, rad, and in which fraction of the samples.
    pub clamped: [(f64, f64); DOF_COUNT],
    /// Largest distance of a planted foot from its place, m: as recorded, and prepared.
    pub slide: (f64, f64),
    /// Largest depth of a sole below the floor while the foot is on it, m: as recorded, and prepared.
    pub penetration: (f64, f64),
    /// Zero-moment point before and after balancing.
    pub zmp: (ZmpOutside, ZmpOutside),
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

const FOOT: [SegmentId; 2] = [L_FOOT, R_FOOT];

/// Turns a draft into a motion that the body can follow.
///
/// Memory and time are linear in the number of samples (times a handful of balancing rounds).
pub fn prepare(body: &Body, draft: &Draft, options: PrepareOptions) -> Prepared {
    prepare_in(body, draft, options, balance::ROUNDS)
}

/// The same with another number of rounds in which ankles are relieved and the trunk is shifted.
pub fn prepare_in(body: &Body, draft: &Draft, options: PrepareOptions, rounds: usize) -> Prepared {
    let n = draft.postures.len();
    let rate = draft.rate_hz;
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let one_foot = AnkleTorqueLimit::new(body);
    let standing = body.standing_root_height();
    let mut upper = draft.postures.clone();
    let mut clamped = [(0.0f64, 0.0f64); DOF_COUNT];
    clamp_upper(body, &mut upper, rate, &mut clamped);

    let upright =
        |i: usize| options.lock_feet && upper[i].root_position.z > contact::LYING * standing;
    let label: [Vec<bool>; 2] =
        std::array::from_fn(|s| (0..n).map(|i| draft.label[i][s] && upright(i)).collect());
    let stands = stances(
        &soles,
        [&draft.ankle[0], &draft.ankle[1]],
        [&draft.foot[0], &draft.foot[1]],
        [&label[0], &label[1]],
        rate,
    );
    let lock = |relief: &AnkleUnloading| -> [LockedFoot; 2] {
        std::array::from_fn(|s| {
            lock_foot(
                &soles[s],
                &draft.ankle[s],
                &draft.foot[s],
                (&stands[s], &stands[1 - s]),
                (&relief.heel_up[s], &relief.toe_out[s], &relief.tip[s]),
                s,
                rate,
            )
        })
    };
    let mut relief = AnkleUnloading::new(n);
    let mut locked = lock(&relief);
    let fits = options.lock_feet && options.balance;
    let mut flights = (fits && options.runs)
        .then(|| FlightPhases::of(&upper, &draft.label, rate))
        .flatten();
    if flights.is_some() {
        for s in 0..2 {
            let roll = (&mut relief.heel_up[s], &mut relief.tip[s]);
            let roll = (roll.0.as_mut_slice(), roll.1.as_mut_slice());
            roll_off(
                &soles[s],
                &draft.ankle[s],
                &locked[s],
                &stands[s],
                roll,
                rate,
            );
        }
        locked = lock(&relief);
    }
    let mut planted = planted_of(&locked);
    let mut penetration_before: f64 = 0.0;
    for s in 0..2 {
        for i in (0..n).filter(|i| draft.label[*i][s]) {
            let low =
                draft.ankle[s][i].z + soles[s].lowest(draft.foot[s][i], locked[s].poses[i].toe);
            penetration_before = penetration_before.max(-low);
        }
    }

    // Legs as recorded first; then rounds in which ankles are relieved and the trunk is shifted over the feet.
    let mut shift = vec![[0.0f64; 2]; n];
    let (mut postures, mut drop) = assemble(body, &upper, &locked, draft, &relief, &shift, None);
    let mut carries = planted.clone();
    let mut carriers = carriers_of(body, &soles, &upper, (&locked, &carries), &draft.label);
    let mut track = mass_track(body, &postures, rate);
    let before = zmp_outside(&track, &carriers);
    let elsewhere = may_rest(body, &upper, &planted, rate);
    let rounds = if options.lock_feet && n >= 8 {
        rounds
    } else {
        0
    };
    for round in 0..rounds {
        if round + 2 < rounds {
            relief.add(
                body,
                &postures,
                &planted,
                [&stands[0], &stands[1]],
                flights.is_some(),
                rate,
            );
            locked = lock(&relief);
            carriers = carriers_of(body, &soles, &upper, (&locked, &carries), &draft.label);
        }
        if options.balance && round > 0 {
            let held = held_in_gait(
                &carriers,
                &soles,
                (&locked, &carries),
                (&one_foot, &track),
                flights.is_some(),
                rate,
            );
            shift = match &flights {
                None => {
                    let reach = (balance::INSET, balance::OTHER_SUPPORT);
                    pelvis_shift(&track, &shift, &held, &elsewhere, reach, rate)
                }
                Some(f) => pelvis_shift_in_run(
                    &track,
                    &shift,
                    (&held, &elsewhere),
                    (balance::RUN_INSET, balance::OTHER_SUPPORT),
                    f.air(),
                    rate,
                ),
            };
            for s in &mut shift {
                let far = s[0].hypot(s[1]);
                if far > balance::MOST_SHIFT {
                    *s = s.map(|x| x * balance::MOST_SHIFT / far);
                }
            }
        }
        if let Some(f) = &mut flights {
            f.observe(&track, &drop);
        }
        (postures, drop) = assemble(
            body,
            &upper,
            &locked,
            draft,
            &relief,
            &shift,
            flights.as_ref(),
        );
        track = mass_track(body, &postures, rate);
        if round + balance::REACH_ROUND == rounds {
            let left = within_reach(body, &postures, &planted, (&soles, &locked));
            carries.copy_from_slice(&left);
            carriers = carriers_of(body, &soles, &upper, (&locked, &carries), &draft.label);
        }
    }

    let folded = if options.lock_feet {
        unfold(body, &mut postures, &planted, (&soles, &locked), rate)
    } else {
        DeepFlexion::default()
    };
    let held = into_limits(
        body,
        &mut postures,
        &mut planted,
        (&soles, &locked, options.held),
        &mut clamped,
    );
    track = mass_track(body, &postures, rate);
    let after = zmp_outside(&track, &carriers);
    let far = (0..n)
        .filter(|i| match &carriers[*i] {
            Carrier::Feet(p) => margin(p, track.zmp[*i]) < -balance::OTHER_SUPPORT,
            Carrier::Other => true,
            Carrier::Air => false,
        })
        .count();
    Prepared {
        postures,
        planted,
        clamped,
        slide: (
            locked[0].slide_before.max(locked[1].slide_before),
            held.slide,
        ),
        penetration: (penetration_before, held.penetration),
        zmp: (before, after),
        shift_max: shift.iter().map(|s| s[0].hypot(s[1])).fold(0.0, f64::max),
        drop_max: -drop.iter().copied().fold(0.0, f64::min),
        tilt_max: folded.tilt_max,
        raise_max: folded.raise_max,
        carried: far as f64 / n.max(1) as f64,
        freed: held.freed as f64 / (2 * n).max(1) as f64,
    }
}
