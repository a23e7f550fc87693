//! From a recorded motion in body scale to a reference that a body can follow: feet locked, legs reaching, balance kept.

mod pelvis;
mod relief;

use super::balance::{
    Carrier, Elsewhere, LIGHT, MassTrack, mass_track, pelvis_shift, pelvis_shift_in_run,
};
use super::contacts::runs;
use super::envelope::smoothest_below;
use super::filter::{low_pass, low_pass_points, low_pass_rotations, percentile};
use super::foot_lock::{LockedFoot, Sole, lock_foot, stances};
use super::leg_ik::{forward, knee_axis, solve_leg_in_plane};
use super::one_foot::{OneFoot, Over};
use super::polygon::{hull, margin};
use super::running::{Flights, roll_off};
use crate::sim::body::angles::clamp_to_limits;
use crate::sim::body::topology::{
    BALL_COUNT, DOF_COUNT, DOF_START, HINGE_COUNT, JOINT, Joint, L_FOOT, L_SHANK, L_THIGH, L_TOES,
    R_FOOT, R_SHANK, R_THIGH, R_TOES, SegmentId,
};
use crate::sim::body::{Body, Posture};
use crate::sim::math::ease::smoothstep;
use crate::sim::math::{Quat, Vec3};
use relief::Relief;

/// A planted leg reaches at most this fraction of its length: a straight knee makes inverse kinematics jump.
const REACH: f64 = 0.98;
/// For a swinging leg the pelvis is lowered by no more than this, m.
const SWING_DROP: f64 = 0.04;
/// The pelvis is lowered over about this time, s.
pub(super) const DROP_TIME: f64 = 0.15;
/// Rounds of shifting the trunk and solving the legs again.
const ROUNDS: usize = 8;
/// The zero-moment point is kept this far inside the support polygon, m.
pub(super) const INSET: f64 = 0.04;
/// The same for runners, whose ankles limit it anyway.
const RUN_INSET: f64 = 0.02;
/// A zero-moment point outside by more than this for long means that something other than the feet carries the body, m.
pub(super) const CARRIED: f64 = 0.15;
/// The trunk is never moved further than this for balance, m.
const MOST_SHIFT: f64 = 0.2;
/// A pelvis below the first share of its standing height may sit, one above the second does not.
const SITS: (f64, f64) = (0.65, 0.8);
/// Feet that stay for so long before and after a moment do not step, s.
const STAYS: f64 = 0.5;
/// Time over which the speed is taken with which a body passes over its foot, s.
const PASSING: f64 = 0.2;
/// Cut-off of the lean of a body over its foot, Hz.
const LEAN_CUTOFF: f64 = 4.0;
/// Angles are kept this far from their limits, rad.
const LIMIT_MARGIN: f64 = 0.01;
/// Cut-off of the joints of swinging legs, Hz, and the time over which it comes in and goes out, s.
const SWING_CUTOFF: f64 = 8.0;
const SWING_EDGE: f64 = 0.08;
/// After take-off feet come to follow the pelvis over this time, and before landing they cease to, s.
const FLIGHT_EDGE: f64 = 0.1;
/// Below this fraction of standing height the pelvis lies or sits on the floor: feet are not what stands.
const LYING: f64 = 0.22;
/// An ankle may be lower than it should by this much, m. Least height that bending the knee gives, m/rad; most that it is bent by at a time, rad, and how
/// often.
const KNEE_SLACK: f64 = 1e-3;
const LEAST_RISE: f64 = 0.05;
const KNEE_STEP: f64 = 0.3;
const KNEE_STEPS: usize = 8;
/// Accuracy to which the feet of a recording hold their places, m.
pub(super) const HELD: f64 = 5e-4;
/// A planted foot that is farther off its place than this, m, does not carry while the other one does; that is looked at so many rounds before the last.
const NEAR: f64 = 0.01;
const RELIEVED: usize = 5;

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
    /// A planted foot that its leg cannot hold to this accuracy is declared free, m.
    pub held: f64,
}

/// How far the zero-moment point is outside the support polygon of planted feet, over the samples that feet carry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ZmpOutside {
    /// Fraction of the samples outside.
    pub fraction: f64,
    /// Mean excess over all samples (0 inside), m.
    pub mean: f64,
    /// 95th percentile of the excess, m.
    pub p95: f64,
    /// Largest excess, m.
    pub max: f64,
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
    /// Fraction of the samples in which something other than the feet carries the body.
    pub carried: f64,
    /// Fraction of foot samples that were declared free because the leg's limits do not let it hold the foot in place.
    pub freed: f64,
}

const FOOT: [SegmentId; 2] = [L_FOOT, R_FOOT];
const TOES: [SegmentId; 2] = [L_TOES, R_TOES];

/// Hip joint of each side in the pelvis frame, m, and length of the leg from hip to ankle, m.
pub(super) fn leg_geometry(body: &Body) -> [(Vec3, f64); 2] {
    [L_THIGH, R_THIGH].map(|thigh| {
        let t = thigh.index();
        (
            body.joint_offset[t],
            body.joint_offset[t + 1].norm() + body.joint_offset[t + 2].norm(),
        )
    })
}

/// Turns a draft into a motion that the body can follow.
///
/// Memory and time are linear in the number of samples (times a handful of balancing rounds).
pub fn prepare(body: &Body, draft: &Draft, options: PrepareOptions) -> Prepared {
    prepare_in(body, draft, options, ROUNDS)
}

/// The same with another number of rounds in which ankles are relieved and the trunk is shifted.
pub fn prepare_in(body: &Body, draft: &Draft, options: PrepareOptions, rounds: usize) -> Prepared {
    let n = draft.postures.len();
    let rate = draft.rate_hz;
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let one_foot = OneFoot::new(body);
    let standing = body.standing_root_height();
    let mut upper = draft.postures.clone();
    let mut clamped = [(0.0f64, 0.0f64); DOF_COUNT];
    clamp_upper(body, &mut upper, rate, &mut clamped);

    let upright = |i: usize| options.lock_feet && upper[i].root_position.z > LYING * standing;
    let label: [Vec<bool>; 2] =
        std::array::from_fn(|s| (0..n).map(|i| draft.label[i][s] && upright(i)).collect());
    let stands = stances(
        &soles,
        [&draft.ankle[0], &draft.ankle[1]],
        [&draft.foot[0], &draft.foot[1]],
        [&label[0], &label[1]],
        rate,
    );
    let lock = |relief: &Relief| -> [LockedFoot; 2] {
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
    let mut relief = Relief::new(n);
    let mut locked = lock(&relief);
    let fits = options.lock_feet && options.balance;
    let mut flights = fits
        .then(|| Flights::of(&upper, &draft.label, rate))
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
                    let reach = (INSET, CARRIED);
                    pelvis_shift(&track, &shift, &held, &elsewhere, reach, rate)
                }
                Some(f) => pelvis_shift_in_run(
                    &track,
                    &shift,
                    (&held, &elsewhere),
                    (RUN_INSET, CARRIED),
                    f.air(),
                    rate,
                ),
            };
            for s in &mut shift {
                let far = s[0].hypot(s[1]);
                if far > MOST_SHIFT {
                    *s = s.map(|x| x * MOST_SHIFT / far);
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
        if round + RELIEVED == rounds {
            let left = within_reach(body, &postures, &planted, (&soles, &locked));
            carries.copy_from_slice(&left);
            carriers = carriers_of(body, &soles, &upper, (&locked, &carries), &draft.label);
        }
    }

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
            Carrier::Feet(p) => margin(p, track.zmp[*i]) < -CARRIED,
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
        carried: far as f64 / n.max(1) as f64,
        freed: held.freed as f64 / (2 * n).max(1) as f64,
    }
}

/// What is left of a lock when the legs are within their limits.
#[derive(Default)]
struct Held {
    /// Furthest that a planted foot is from its place, m.
    slide: f64,
    /// Deepest that one is in the floor, m.
    penetration: f64,
    /// Foot samples that were declared free.
    freed: usize,
}

/// Brings the legs into their limits, last, and declares feet free that they cannot hold in place then.
fn into_limits(
    body: &Body,
    postures: &mut [Posture],
    planted: &mut [[bool; 2]],
    (soles, locked, accuracy): (&[Sole; 2], &[LockedFoot; 2], f64),
    clamped: &mut [(f64, f64); DOF_COUNT],
) -> Held {
    let n = postures.len();
    let mut held = Held::default();
    for (i, (posture, planted)) in postures.iter_mut().zip(planted).enumerate() {
        let wanted = forward(body, posture);
        let off = clamp_to_limits(body, posture, LIMIT_MARGIN * 0.5);
        note_clamped(clamped, &off, n);
        let behind = |s: usize| off[DOF_START[[L_THIGH, R_THIGH][s].index()]] < 0.0;
        for s in (0..2).filter(|s| !planted[*s] && behind(*s)) {
            lift_by_knee(body, posture, s, wanted[FOOT[s].index()]);
        }
        let poses = forward(body, posture);
        for s in 0..2 {
            if !planted[s] {
                continue;
            }
            let (at, q) = poses[FOOT[s].index()];
            let low = at.z + soles[s].lowest(q, posture.hinge[toe_hinge(s)]);
            let stray = soles[s].stray((at, q), &locked[s].poses[i]);
            if stray > accuracy || low < -accuracy {
                planted[s] = false;
                held.freed += 1;
                continue;
            }
            held.slide = held.slide.max(stray);
            held.penetration = held.penetration.max(-low);
        }
    }
    held
}

/// A swinging leg whose hip does not reach as far back as it should is bent at the knee until its ankle is as high as `wanted`: its foot would
/// be in the floor.
fn lift_by_knee(body: &Body, posture: &mut Posture, side: usize, wanted: (Vec3, Quat)) {
    let shank = [L_SHANK, R_SHANK][side].index();
    let foot = FOOT[side].index();
    let (Joint::Hinge1(k), Joint::Ball(f)) = (JOINT[shank], JOINT[foot]) else {
        unreachable!("the tree has hinge knees and ball ankles")
    };
    let most = body.upper[DOF_START[shank]] - LIMIT_MARGIN;
    for _ in 0..KNEE_STEPS {
        let poses = forward(body, posture);
        let low = wanted.0.z - poses[foot].0.z;
        let axis = knee_axis(posture, side == 0);
        let rises = axis.cross(poses[foot].0 - poses[shank].0).z;
        if low < KNEE_SLACK || rises < LEAST_RISE || posture.hinge[k] >= most {
            break;
        }
        posture.hinge[k] = (posture.hinge[k] + (low / rises).min(KNEE_STEP)).min(most);
        let shank = forward(body, posture)[shank].1;
        posture.ball[f] = (shank.conjugate() * wanted.1).normalized();
    }
    clamp_to_limits(body, posture, LIMIT_MARGIN * 0.5);
}

fn toe_hinge(side: usize) -> usize {
    match JOINT[TOES[side].index()] {
        Joint::Hinge1(h) => h,
        _ => unreachable!("the toes are on a hinge"),
    }
}

/// Which feet are planted, per sample.
pub(super) fn planted_of(locked: &[LockedFoot; 2]) -> Vec<[bool; 2]> {
    let [left, right] = locked;
    let both = left.planted.iter().zip(&right.planted);
    both.map(|(l, r)| [*l, *r]).collect()
}

/// Which planted feet carry the body: not those that their legs, within their limits, hold far from their places while the other one stands. Declared free in the
/// end they would leave a body alone on one foot that is balanced on two.
fn within_reach(
    body: &Body,
    postures: &[Posture],
    planted: &[[bool; 2]],
    (soles, locked): (&[Sole; 2], &[LockedFoot; 2]),
) -> Vec<[bool; 2]> {
    let carries = |(i, planted): (usize, &[bool; 2])| {
        let mut posture = postures[i];
        clamp_to_limits(body, &mut posture, LIMIT_MARGIN * 0.5);
        let poses = forward(body, &posture);
        let near = |s: usize| soles[s].stray(poses[FOOT[s].index()], &locked[s].poses[i]) <= NEAR;
        match *planted {
            [true, true] if near(0) != near(1) => [near(0), near(1)],
            as_locked => as_locked,
        }
    };
    planted.iter().enumerate().map(carries).collect()
}

/// What carries the body in each sample.
pub(super) fn carriers_of(
    body: &Body,
    soles: &[Sole; 2],
    upper: &[Posture],
    (locked, carries): (&[LockedFoot; 2], &[[bool; 2]]),
    label: &[[bool; 2]],
) -> Vec<Carrier> {
    let standing = body.standing_root_height();
    let mut corners = Vec::new();
    (0..upper.len())
        .map(|i| {
            corners.clear();
            let feet = soles.iter().zip(locked).zip(carries[i]);
            for ((sole, foot), _) in feet.filter(|(_, carries)| *carries) {
                sole.footprint(&foot.anchors[i], &mut corners);
            }
            if upper[i].root_position.z < 0.45 * standing {
                Carrier::Other
            } else if corners.len() >= 3 {
                Carrier::Feet(hull(&corners))
            } else if label[i] == [false, false] {
                Carrier::Air
            } else {
                Carrier::Other
            }
        })
        .collect()
}

/// The same where no foot is asked to hold alone what its ankle cannot.
pub(super) fn held_by(
    carriers: &[Carrier],
    soles: &[Sole; 2],
    locked: &[LockedFoot; 2],
    (one_foot, track): (&OneFoot, &MassTrack),
    rate_hz: f64,
) -> Vec<Carrier> {
    let carries = planted_of(locked);
    let feet = (locked, carries.as_slice());
    held_in_gait(carriers, soles, feet, (one_foot, track), false, rate_hz)
}

/// The same, of who `runs` or walks.
fn held_in_gait(
    carriers: &[Carrier],
    soles: &[Sole; 2],
    (locked, carries): (&[LockedFoot; 2], &[[bool; 2]]),
    (one_foot, track): (&OneFoot, &MassTrack),
    runs: bool,
    rate_hz: f64,
) -> Vec<Carrier> {
    let half = (0.5 * PASSING * rate_hz) as usize;
    // Without the jumps of touch-downs, from which the rounds would not settle.
    let lean: [Vec<f64>; 2] = std::array::from_fn(|k| {
        let both = track.com.iter().zip(&track.zmp);
        let mut lean: Vec<f64> = both.map(|(c, z)| c.to_array()[k] - z[k]).collect();
        low_pass(&mut lean, LEAN_CUTOFF, rate_hz);
        lean
    });
    let mut corners = Vec::new();
    let held = |(i, carrier): (usize, &Carrier)| {
        let side = match carries[i] {
            [true, false] => 0,
            [false, true] => 1,
            _ => return carrier.clone(),
        };
        if !matches!(carrier, Carrier::Feet(_)) {
            return carrier.clone();
        }
        corners.clear();
        let (before, after) = (i.saturating_sub(half), (i + half).min(carriers.len() - 1));
        let way = track.com[after] - track.com[before];
        let over = Over {
            height: track.com[i].z,
            speed: way.x.hypot(way.y) * rate_hz / (after - before).max(1) as f64,
            lean: [lean[0][i], lean[1][i]],
            load: runs.then(|| track.load[i]),
        };
        let at = &locked[side].anchors[i];
        one_foot.each_corner(&soles[side], at, &over, |p| corners.push(p));
        Carrier::Feet(hull(&corners))
    };
    carriers.iter().enumerate().map(held).collect()
}

/// What else than the feet may carry the body: a seat where the pelvis is low, hands where both feet stay for a while. Who steps walks on his feet.
pub(super) fn may_rest(
    body: &Body,
    upper: &[Posture],
    planted: &[[bool; 2]],
    rate_hz: f64,
) -> Vec<Elsewhere> {
    let standing = body.standing_root_height();
    let n = upper.len();
    let half = (STAYS * rate_hz) as usize;
    let smooth = |mut x: Vec<f64>| {
        low_pass(&mut x, 2.0, rate_hz);
        x
    };
    let seat = upper
        .iter()
        .map(|p| ((SITS.1 - p.root_position.z / standing) / (SITS.1 - SITS.0)).clamp(0.0, 1.0));
    let stays = |i: usize| {
        let around = i.saturating_sub(half)..(i + half).min(n);
        planted[around].iter().all(|p| *p == [true; 2])
    };
    let hands = (0..n).map(|i| f64::from(stays(i)));
    let (seat, hands) = (smooth(seat.collect()), smooth(hands.collect()));
    let both = seat.into_iter().zip(hands);
    both.map(|(seat, hands)| Elsewhere {
        seat: seat.clamp(0.0, 1.0),
        hands: hands.clamp(0.0, 1.0),
    })
    .collect()
}

fn note_clamped(clamped: &mut [(f64, f64); DOF_COUNT], off: &[f64; DOF_COUNT], n: usize) {
    for (c, o) in clamped.iter_mut().zip(off) {
        // Below a tenth of a degree it is the margin, not the motion.
        if o.abs() > 0.002 {
            c.0 = c.0.max(o.abs());
            c.1 += 1.0 / n as f64;
        }
    }
}

/// Spine, neck and arms into their limits, then smooth again where clamping left a corner.
fn clamp_upper(
    body: &Body,
    postures: &mut [Posture],
    rate_hz: f64,
    clamped: &mut [(f64, f64); DOF_COUNT],
) {
    let n = postures.len();
    let mut any = false;
    for p in postures.iter_mut() {
        let mut q = *p;
        // Legs of a draft mean nothing yet: keep them out of the count.
        for s in [L_THIGH, R_THIGH, L_FOOT, R_FOOT] {
            if let Joint::Ball(b) = JOINT[s.index()] {
                q.ball[b] = Quat::identity();
            }
        }
        for s in [L_SHANK, R_SHANK, L_TOES, R_TOES] {
            if let Joint::Hinge1(h) = JOINT[s.index()] {
                let d = DOF_START[s.index()];
                q.hinge[h] = 0.5 * (body.lower[d] + body.upper[d]);
            }
        }
        let off = clamp_to_limits(body, &mut q, LIMIT_MARGIN);
        let mut upper = off;
        upper[DOF_START[L_THIGH.index()]..].fill(0.0);
        any |= upper.iter().any(|o| o.abs() > 0.002);
        note_clamped(clamped, &upper, n);
        *p = q;
    }
    if any {
        smooth_joints(postures, 8.0, rate_hz);
    }
}

/// Postures from upper body, feet and trunk shift: pelvis lowered until planted legs reach, legs solved.
fn assemble(
    body: &Body,
    upper: &[Posture],
    locked: &[LockedFoot; 2],
    draft: &Draft,
    relief: &Relief,
    shift: &[[f64; 2]],
    flights: Option<&Flights>,
) -> (Vec<Posture>, Vec<f64>) {
    let n = upper.len();
    let legs = leg_geometry(body);
    let mut out = upper.to_vec();
    let mut drop = vec![f64::INFINITY; n];
    for i in 0..n {
        pelvis::turn(body, &mut out[i], relief.yaw[i]);
        out[i].root_position.x += shift[i][0];
        out[i].root_position.y += shift[i][1];
        for ((hip, length), foot) in legs.iter().zip(locked) {
            let d = out[i].root_position + out[i].root_rotation.rotate(*hip) - foot.poses[i].ankle;
            let most = REACH * length;
            let level = d.x.hypot(d.y);
            let height = (most * most - level * level).max(0.04 * most * most).sqrt();
            let need = height - d.z;
            // A swinging leg must not be straight when it lands either; one that kicks or lies is its own affair.
            let weight = if foot.planted[i] {
                1.0
            } else {
                ((0.6 - level / most) / 0.15).clamp(0.0, 1.0)
            };
            let need = if foot.planted[i] || need > 0.0 {
                need
            } else {
                need.max(-SWING_DROP) * weight
            };
            drop[i] = drop[i].min(need);
        }
    }
    let drop = match flights {
        None => smoothest_below(&drop, DROP_TIME, draft.rate_hz),
        Some(f) => f.heights(&drop),
    };
    let mut path: Vec<Vec3> = (0..n)
        .map(|i| {
            let mut p = out[i].root_position;
            p.z += drop[i];
            p
        })
        .collect();
    if flights.is_none() {
        low_pass_points(&mut path, 10.0, draft.rate_hz);
    }
    let flies = if flights.is_some() {
        vec![0.0; n]
    } else {
        in_flight(locked, draft.rate_hz)
    };
    for i in 0..n {
        // In the air the feet go where the pelvis goes; a runner's swing on.
        let moved = (path[i] - upper[i].root_position) * flies[i];
        out[i].root_position = path[i];
        for (s, (hip, length)) in legs.iter().enumerate() {
            let mut foot = locked[s].poses[i];
            foot.ankle += moved;
            let hip = path[i] + out[i].root_rotation.rotate(*hip);
            let line = foot.ankle - hip;
            let far = line.norm();
            let most = 0.995 * length;
            if !locked[s].planted[i] && far > most {
                foot.ankle = hip + line * (most / far);
            }
            // Inwards is clockwise seen from above for the left leg: about the line pointing down, positive.
            let inward = if s == 0 {
                relief.turn_in[s][i]
            } else {
                -relief.turn_in[s][i]
            };
            let axis =
                Quat::exp(line.normalized_or(-Vec3::Z) * inward).rotate(draft.knee_axis[s][i]);
            solve_leg_in_plane(
                body,
                &mut out[i],
                s == 0,
                (foot.ankle, foot.rotation),
                foot.toe,
                axis,
            );
        }
    }
    for (s, foot) in locked.iter().enumerate() {
        smooth_swings(&mut out, s, &foot.planted, draft.rate_hz);
    }
    (out, drop)
}

/// From 0 where a foot is planted to 1 inside a flight, per sample.
fn in_flight(locked: &[LockedFoot; 2], rate_hz: f64) -> Vec<f64> {
    let planted = locked[0].planted.iter().zip(&locked[1].planted);
    let grounded: Vec<bool> = planted.map(|(l, r)| *l || *r).collect();
    let n = grounded.len();
    let mut share = vec![0.0; n];
    for (i, j, on) in runs(&grounded) {
        if on || i == 0 || j == n {
            continue;
        }
        for (k, s) in share.iter_mut().enumerate().take(j).skip(i) {
            let u = ((k + 1 - i).min(j - k) as f64 / (FLIGHT_EDGE * rate_hz)).min(1.0);
            *s = smoothstep(u);
        }
    }
    share
}

/// Low-pass of the joints of a leg while it swings: a knee that comes near to straight makes inverse kinematics jump. Planted legs stay.
fn smooth_swings(postures: &mut [Posture], side: usize, planted: &[bool], rate_hz: f64) {
    let leg = [
        [L_THIGH, L_SHANK, L_FOOT, L_TOES],
        [R_THIGH, R_SHANK, R_FOOT, R_TOES],
    ][side];
    // From 0 where the foot is planted to 1 inside a swing.
    let mut share = vec![0.0; postures.len()];
    for (i, j, on) in runs(planted) {
        for (k, s) in share.iter_mut().enumerate().take(j).skip(i) {
            let since = if i > 0 { k + 1 - i } else { usize::MAX };
            let until = if j < planted.len() { j - k } else { usize::MAX };
            let u = (since.min(until) as f64 / (SWING_EDGE * rate_hz)).min(1.0);
            *s = if on { 0.0 } else { smoothstep(u) };
        }
    }
    for segment in leg {
        match JOINT[segment.index()] {
            Joint::Ball(b) => {
                let mut q: Vec<Quat> = postures.iter().map(|p| p.ball[b]).collect();
                low_pass_rotations(&mut q, SWING_CUTOFF, rate_hz);
                for ((p, q), s) in postures.iter_mut().zip(q).zip(&share) {
                    let to = (q * p.ball[b].conjugate()).log() * *s;
                    p.ball[b] = (Quat::exp(to) * p.ball[b]).normalized();
                }
            }
            Joint::Hinge1(h) => {
                let mut a: Vec<f64> = postures.iter().map(|p| p.hinge[h]).collect();
                low_pass(&mut a, SWING_CUTOFF, rate_hz);
                for ((p, a), s) in postures.iter_mut().zip(a).zip(&share) {
                    p.hinge[h] += s * (a - p.hinge[h]);
                }
            }
            _ => unreachable!("legs have ball joints and hinges of one axis"),
        }
    }
}

fn zmp_outside(track: &MassTrack, carriers: &[Carrier]) -> ZmpOutside {
    let outside: Vec<f64> = track
        .zmp
        .iter()
        .zip(carriers)
        .zip(&track.load)
        .filter_map(|((z, c), load)| match c {
            Carrier::Feet(p) if *load > LIGHT => Some((-margin(p, *z)).max(0.0)),
            _ => None,
        })
        .collect();
    let n = outside.len().max(1) as f64;
    ZmpOutside {
        fraction: outside.iter().filter(|x| **x > 0.0).count() as f64 / n,
        mean: outside.iter().sum::<f64>() / n,
        p95: percentile(&outside, 0.95),
        max: outside.iter().copied().fold(0.0, f64::max),
    }
}

/// Low-pass of all joint positions of a motion, in place; the pelvis is left alone.
fn smooth_joints(postures: &mut [Posture], cutoff_hz: f64, rate_hz: f64) {
    for b in 0..BALL_COUNT {
        let mut q: Vec<Quat> = postures.iter().map(|p| p.ball[b]).collect();
        low_pass_rotations(&mut q, cutoff_hz, rate_hz);
        for (p, q) in postures.iter_mut().zip(q) {
            p.ball[b] = q;
        }
    }
    for h in 0..HINGE_COUNT {
        let mut a: Vec<f64> = postures.iter().map(|p| p.hinge[h]).collect();
        low_pass(&mut a, cutoff_hz, rate_hz);
        for (p, a) in postures.iter_mut().zip(a) {
            p.hinge[h] = a;
        }
    }
}
