//! The other hand helps with a load for which one arm is too weak.
//!
//! The desired motion has a load in one hand. Statics give the torques that the joints of that arm need to hold it
//! still, now and in the coming part of the motion. If the joints do not have that much, and the other hand is free and
//! can get there, the desired motion of the other arm is changed: inverse kinematics of its seven joints alone lead its
//! palm to the load. Trunk, feet and the carrying hand keep their desired motion. Once the palm is there, both hands
//! hold the load, each with a share of its mass, chosen for the least effort of the two arms. The helping hand lets go
//! when one arm is clearly enough.

mod effort;
mod sight;

use crate::body::angles::anatomical_angles;
use crate::body::palm::load_point;
use crate::body::topology::{
    ABDOMEN, CHEST, DOF_LEN, DOF_START, HEAD, L_HAND, L_THIGH, PELVIS, R_HAND, R_THIGH,
};
use crate::body::{Body, Posture, SegmentId};
use crate::collide::narrow::capsules;
use crate::collide::shape::Capsule;
use crate::figure::loads::disturbances::LoadShare;
use crate::figure::loads::disturbances::{Disturbances, Helpable};
use crate::figure::params::load::RATE_SPAN;
use crate::figure::params::second_hand::{
    AHEAD, APART, CALM, ENOUGH, FOLLOW_TIME, LIMIT_SLACK, LOOK_AGAIN, NEAR, PATIENCE, PAUSE,
    REACH_TIME, SAME_SHARE, SHARE_TIME, STRETCH, TOUCH_SLACK, WEAK, WORTH,
};
use crate::math::curve::smootherstep;
use crate::math::vec3::vec3;
use crate::math::{Quat, Vec3};
use crate::motion::arm_ik::{ARMS, Arm, reach};
use crate::motion::leg_ik::forward;
use crate::motion::{Target, TargetPair};
use crate::setup::SecondHand as When;
use effort::{Efforts, Grasp};
use serde::{Deserialize, Serialize};
pub(in crate::figure) use sight::Sight;

/// Angles by which the elbow may point outwards, rad from down and a little back: the first that the joints allow is
/// taken.
const SPREADS: [f64; 4] = [0.35, 0.7, 1.05, 0.0];
/// Moments at which the coming motion is examined.
const LOOKS: usize = 4;
/// Points along the way at which the arm is kept out of the body.
const WAYPOINTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum HandPhase {
    /// The hand follows the motion.
    Away,
    /// It moves to the load.
    Reach,
    /// It holds the load.
    Hold,
    /// It returns to the motion.
    Back,
}

/// The state of the other hand.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct HelpingHand {
    phase: HandPhase,
    /// Whether it is the right hand.
    right: bool,
    /// Point of the carrying hand that holds the load, segment frame, m.
    load: Vec3,
    /// Progress on its way, 0…1.
    way: f64,
    /// Angle by which the elbow points outwards, rad.
    spread: f64,
    /// Distance of the load from its place in the motion, chest frame, m.
    off: Vec3,
    /// From the load to the palm, chest frame, m.
    apart: Vec3,
    /// How long one arm has been enough, or the hand has been late, s.
    since: f64,
    /// Time until it checks again, s.
    pause: f64,
}

impl Default for HelpingHand {
    fn default() -> Self {
        Self {
            phase: HandPhase::Away,
            right: false,
            load: Vec3::zero(),
            way: 0.0,
            spread: 0.0,
            off: Vec3::zero(),
            apart: Vec3::zero(),
            since: 0.0,
            pause: 0.0,
        }
    }
}

/// Pose of the chest.
fn chest(poses: &[(Vec3, Quat)]) -> (Vec3, Quat) {
    poses[CHEST.index()]
}

/// A point of a segment as the chest sees it, m.
fn from_chest(poses: &[(Vec3, Quat)], segment: SegmentId, point: Vec3) -> Vec3 {
    let (at, turned) = poses[segment.index()];
    let (origin, rotation) = chest(poses);
    rotation
        .conjugate()
        .rotate(at + turned.rotate(point) - origin)
}

impl HelpingHand {
    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let times = [self.since, self.pause];
        let vectors = [self.load, self.off, self.apart];
        (0.0..=1.0).contains(&self.way)
            && self.spread.abs() <= 4.0
            && times.iter().all(|t| (0.0..=1e6).contains(t))
            && vectors.iter().all(|v| v.norm() <= 100.0)
    }

    /// The hand that departs from the motion: 0 left, 1 right.
    pub fn led(&self) -> Option<usize> {
        (self.phase != HandPhase::Away).then_some(self.index())
    }

    fn index(&self) -> usize {
        usize::from(self.right)
    }

    fn arm(&self) -> [SegmentId; 3] {
        ARMS[self.index()]
    }

    /// The hand that carries.
    fn carrying(&self) -> SegmentId {
        ARMS[1 - self.index()][2]
    }

    /// Decides what the hand does in this tick, and changes the desired motion of its arm. No allocation; does nothing
    /// unless there is, now or soon, a load that it may help with.
    pub fn update(&mut self, see: &Sight<'_>, loads: &mut Disturbances, target: &mut TargetPair) {
        let found = loads.helpable(see.time).and_then(|found| {
            let right = match found.load.segment {
                L_HAND => true,
                R_HAND => false,
                _ => return None,
            };
            Some((found, right))
        });
        self.pause = (self.pause - see.dt).max(0.0);
        match found {
            None if self.phase == HandPhase::Away => return,
            None => self.phase = HandPhase::Back,
            Some((_, right)) if self.phase != HandPhase::Away && right != self.right => {
                loads.stop_help();
                self.phase = HandPhase::Back;
            }
            Some((found, right)) => {
                (self.right, self.load) = (right, found.load.point);
                self.decide(see, loads, &target.now.posture, &found);
            }
        }
        let step = see.dt / REACH_TIME;
        match self.phase {
            HandPhase::Away | HandPhase::Hold => {}
            HandPhase::Reach => self.way = (self.way + step).min(1.0),
            HandPhase::Back => {
                self.way -= step;
                if self.way <= 0.0 {
                    self.way = 0.0;
                    self.phase = HandPhase::Away;
                }
            }
        }
        if self.phase != HandPhase::Away {
            let share = see.dt / (see.dt + FOLLOW_TIME);
            self.off += (self.missing(see, &target.now.posture) - self.off) * share;
            self.lead(see, &mut target.now);
            self.lead(see, &mut target.next);
        }
    }

    /// Distance of the load from its place in the motion, both seen from the chest, m.
    fn missing(&self, see: &Sight<'_>, desired: &Posture) -> Vec3 {
        let at = |p: &Posture| from_chest(&forward(see.body, p), self.carrying(), self.load);
        at(&see.state.posture) - at(desired)
    }

    /// Moves from one stage to the next.
    fn decide(
        &mut self,
        see: &Sight<'_>,
        loads: &mut Disturbances,
        now: &Posture,
        found: &Helpable,
    ) {
        let free = see.free[self.index()];
        if self.phase == HandPhase::Away && (!free || self.pause > 0.0) {
            return;
        }
        // The hardest moment of the coming motion with the load.
        let (mut worst, mut alone) = (*now, 0.0);
        for k in 0..LOOKS {
            let seconds = AHEAD * k as f64 / (LOOKS - 1) as f64;
            if see.time + seconds < found.load.from && k + 1 < LOOKS {
                continue;
            }
            let posture = if k == 0 { *now } else { (see.ahead)(seconds) };
            let need = self.need(see, &posture, found).alone();
            if need > alone {
                (alone, worst) = (need, posture);
            }
        }
        let (weak, enough) = match found.when {
            When::Always => (true, false),
            When::Auto => (alone > WEAK, alone < ENOUGH),
        };
        match self.phase {
            HandPhase::Away | HandPhase::Back => {
                if free && self.pause == 0.0 && weak {
                    self.set_out(see, now, &worst, found);
                }
            }
            HandPhase::Reach => {
                if !free || enough {
                    self.phase = HandPhase::Back;
                } else if self.way >= 1.0 && found.carried {
                    self.take(see, loads, now, &worst, found);
                }
            }
            HandPhase::Hold => {
                let still = free && found.help.is_some();
                if !still || self.is_beyond_reach(see, now) {
                    loads.stop_help();
                    (self.phase, self.pause) = (HandPhase::Back, PAUSE);
                    return;
                }
                self.since = if enough { self.since + see.dt } else { 0.0 };
                self.share(see, loads, &worst, found);
            }
        }
    }

    /// The needs of both arms in a posture, with the hand of the other arm at the load.
    fn need(&self, see: &Sight<'_>, posture: &Posture, found: &Helpable) -> Efforts {
        let (load, help) = (&found.load, found.help);
        let mut held = *posture;
        self.reach_in(see.body, posture)
            .0
            .hold(&mut held, self.arm());
        let other = help.map_or_else(|| self.palm(see.body), |h| h.point);
        let own = help.map_or(0.0, |h| h.share) * load.mass;
        let rest = if found.carried { load.mass - own } else { 0.0 };
        let hold = Grasp {
            load,
            point: other,
            masses: [rest, own],
        };
        Efforts::new(see, &held, self.index(), &hold)
    }

    fn palm(&self, body: &Body) -> Vec3 {
        load_point(body, self.arm()[2])
    }

    /// Direction in which the elbow points, chest frame.
    fn pole(&self) -> Vec3 {
        let side = if self.right { -1.0 } else { 1.0 };
        let (sine, cosine) = crate::math::trig::sin_cos(self.spread);
        vec3(-0.3, side * sine, -cosine)
    }

    /// Place where the palm should be in a posture, chest frame, m.
    fn place(&self, body: &Body, posture: &Posture) -> Vec3 {
        let load = from_chest(&forward(body, posture), self.carrying(), self.load);
        load + self.off + self.apart
    }

    /// The arm in a posture with the palm at its place, and the distance that remains, m.
    fn reach_in(&self, body: &Body, posture: &Posture) -> (Arm, f64) {
        let place = self.place(body, posture);
        reach(body, self.arm(), self.palm(body), place, self.pole())
    }

    /// Whether the place is farther away than the length of the arm.
    fn is_beyond_reach(&self, see: &Sight<'_>, posture: &Posture) -> bool {
        self.reach_in(see.body, posture).1 > NEAR
    }

    /// Begins to reach if the joints of the arm allow it on arrival and at the hardest moment, if nothing of the body
    /// is in the way, and if it helps.
    fn set_out(&mut self, see: &Sight<'_>, now: &Posture, worst: &Posture, found: &Helpable) {
        let before = self.clone();
        let arrival = (see.ahead)(REACH_TIME);
        if self.phase == HandPhase::Away {
            self.off = self.missing(see, now);
        }
        self.apart = self.beside(see.body, &arrival);
        let on_its_way = self.phase == HandPhase::Back;
        let spreads = if on_its_way {
            [self.spread; SPREADS.len()]
        } else {
            SPREADS
        };
        let allowed = spreads.into_iter().any(|spread| {
            self.spread = spread;
            self.allows(see, &arrival) && self.allows(see, worst) && self.is_clear(see)
        });
        let efforts = self.need(see, worst, found);
        let helps = found.when == When::Always
            || efforts.together(efforts.best_share()) < efforts.alone() - WORTH;
        if allowed && helps {
            self.phase = HandPhase::Reach;
            self.since = 0.0;
        } else {
            *self = before;
            self.pause = LOOK_AGAIN;
        }
    }

    /// From the load to where the palm should be: on its own side and a little towards its shoulder, chest frame, m.
    fn beside(&self, body: &Body, posture: &Posture) -> Vec3 {
        let side = if self.right { -1.0 } else { 1.0 };
        let load = from_chest(&forward(body, posture), self.carrying(), self.load);
        let back = body.joint_offset[self.arm()[0].index()] - load;
        let back = Vec3 { z: 0.0, ..back }.normalized_or(Vec3::zero());
        (Vec3::Y * side + back).normalized_or(Vec3::Y * side) * APART
    }

    /// Whether the joints of the arm allow its palm to be at its place in a posture.
    fn allows(&self, see: &Sight<'_>, posture: &Posture) -> bool {
        let (body, arm) = (see.body, self.arm());
        let shoulder = body.joint_offset[arm[0].index()];
        let place = self.place(body, posture);
        let farther = shoulder + (place - shoulder) * (1.0 / STRETCH);
        let (_, missing) = reach(body, arm, self.palm(body), farther, self.pole());
        if missing > 1e-6 {
            return false;
        }
        let mut held = *posture;
        self.reach_in(body, posture).0.hold(&mut held, arm);
        let angles = anatomical_angles(&held);
        let first = DOF_START[arm[0].index()];
        let all = first..first + arm.iter().map(|s| DOF_LEN[s.index()]).sum::<usize>();
        all.into_iter().all(|d| {
            (body.lower[d] - LIMIT_SLACK..=body.upper[d] + LIMIT_SLACK).contains(&angles[d])
        })
    }

    /// Whether forearm and hand stay as clear of trunk, head and thighs on the way as they do in the motion.
    fn is_clear(&self, see: &Sight<'_>) -> bool {
        WAYPOINTS.into_iter().all(|way| {
            let posture = (see.ahead)(way * REACH_TIME);
            let least = self.clearance(see, &posture).min(0.0) - TOUCH_SLACK;
            let led = self.led_posture(see.body, &posture, way);
            self.clearance(see, &led) >= least
        })
    }

    /// Distance of forearm and hand from trunk, head and thighs, m; negative if they overlap.
    fn clearance(&self, see: &Sight<'_>, posture: &Posture) -> f64 {
        let poses = forward(see.body, posture);
        let placed = |s: SegmentId| {
            let (at, turned) = poses[s.index()];
            let all = see.shape.capsules[s.index()].iter();
            all.map(move |c| Capsule {
                a: at + turned.rotate(c.a),
                b: at + turned.rotate(c.b),
                ..*c
            })
        };
        let mut least = f64::INFINITY;
        for limb in self.arm().into_iter().skip(1).flat_map(placed) {
            let parts = [PELVIS, ABDOMEN, CHEST, HEAD, L_THIGH, R_THIGH];
            for part in parts.into_iter().flat_map(placed) {
                least = least.min(capsules(&limb, &part).gap);
            }
        }
        least
    }

    /// Takes hold of the load if the palm is near its place.
    fn take(
        &mut self,
        see: &Sight<'_>,
        loads: &mut Disturbances,
        now: &Posture,
        worst: &Posture,
        found: &Helpable,
    ) {
        let poses = forward(see.body, &see.state.posture);
        let palm = self.palm(see.body);
        let hand = self.arm()[2];
        let apart = from_chest(&poses, hand, palm) - from_chest(&poses, self.carrying(), self.load);
        if (apart - self.apart).norm() < NEAR {
            let efforts = self.need(see, worst, found);
            let share = see.dt / SHARE_TIME;
            let help = LoadShare {
                hand,
                point: palm,
                share,
                need: [efforts.alone(), efforts.together(efforts.best_share())],
            };
            loads.help(see.time, Some(help));
            // The offset of the load stays as it is; the hand holds it where it is.
            self.apart = apart;
            (self.phase, self.since) = (HandPhase::Hold, 0.0);
            return;
        }
        self.since += see.dt;
        if self.since > PATIENCE || self.is_beyond_reach(see, now) {
            (self.phase, self.pause) = (HandPhase::Back, PAUSE);
        }
    }

    /// Moves its share of the load towards the one with the least effort, or towards none, and then lets go.
    fn share(
        &mut self,
        see: &Sight<'_>,
        loads: &mut Disturbances,
        worst: &Posture,
        found: &Helpable,
    ) {
        let Some(help) = found.help else { return };
        let leaves = self.since > CALM;
        let efforts = self.need(see, worst, found);
        let best = efforts.best_share();
        let wanted = if leaves { 0.0 } else { best };
        let change = wanted - help.share;
        if leaves && help.share == 0.0 {
            loads.stop_help();
            self.phase = HandPhase::Back;
        } else if leaves || change.abs() > SAME_SHARE {
            let most = see.dt / SHARE_TIME;
            let help = LoadShare {
                share: (help.share + change.clamp(-most, most)).clamp(0.0, 1.0),
                need: [efforts.alone(), efforts.together(best)],
                ..help
            };
            loads.help(see.time, Some(help));
        }
    }

    /// Changes the desired motion of its arm at one moment, with its rates.
    fn lead(&self, see: &Sight<'_>, target: &mut Target) {
        let arm = self.arm();
        let rate = match self.phase {
            HandPhase::Reach if self.way < 1.0 => 1.0 / REACH_TIME,
            HandPhase::Back => -1.0 / REACH_TIME,
            _ => 0.0,
        };
        let moved = |seconds: f64| {
            let mut p = target.posture;
            p.integrate(&target.velocity, seconds);
            self.led_posture(see.body, &p, self.way + rate * seconds)
        };
        let way = moved(-RATE_SPAN).joint_difference(&moved(RATE_SPAN));
        target.posture = moved(0.0);
        for d in arm
            .into_iter()
            .flat_map(|s| DOF_START[s.index()]..DOF_START[s.index()] + DOF_LEN[s.index()])
        {
            target.velocity[6 + d] = way[d] * (0.5 / RATE_SPAN);
        }
    }

    /// A posture of the desired motion with the arm at progress `way`.
    fn led_posture(&self, body: &Body, posture: &Posture, way: f64) -> Posture {
        let arm = self.arm();
        let mut out = *posture;
        let held = self.reach_in(body, posture).0;
        let share = smootherstep(way.clamp(0.0, 1.0));
        Arm::of(posture, arm)
            .toward(&held, share)
            .hold(&mut out, arm);
        out
    }
}
