//! The stages of getting up, and the goals of each, from the present place of the body.
//!
//! From the belly: arms out, toes tucked, hands beside the ribs, hips up and back over the knees, up on hands and
//! knees, one hand after the other to the knees, knees off the floor, one hand after the other to the feet, heels down,
//! up. A body that lies on its back or on a side first rolls over: it sets up one foot and pushes with it, and brings
//! leg and arm across. Everything is written for rolling over the right side; the other side is the mirror image.

use super::goals::{GoalAim, Goals, swapped};
use super::reference_pose::ReferencePoses;
use crate::body::topology::{DOF_COUNT, outward};
use crate::get_up::params::layout::{ARMS_APART, HAND_STEP_HEIGHT, SHANK, WRIST_HEIGHT};
use crate::get_up::params::weights::{COM, FIRM, HAND, POSE};
use crate::math::Vec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;

/// Present places of the parts of the body.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Layout {
    /// Length of the body relative to the reference body.
    pub scale: f64,
    /// Real position of the pelvis, and its turn about the vertical, rad.
    pub pelvis: Vec3,
    pub yaw: f64,
    /// Angle from lying on its belly at the start of the motion, rad.
    pub roll: f64,
    /// Present or last places of knees, balls of the feet and wrists on the floor.
    pub knees: [Vec3; 2],
    pub balls: [Vec3; 2],
    pub hands: [Vec3; 2],
}

/// A stage of getting up.
#[derive(Clone, Copy, Debug)]
pub struct GetUpStage {
    pub name: &'static str,
    /// Duration, s.
    pub seconds: f64,
    /// Its goals.
    pub goals: fn(&Layout, &ReferencePoses) -> Goals,
    /// Parts on the floor.
    pub down: FloorContacts,
    /// A hand that steps, and how high, m.
    pub step: Option<(usize, f64)>,
}

/// Parts on the floor in a stage.
#[derive(Clone, Copy, Debug, Default)]
pub struct FloorContacts {
    /// Every part that touches.
    pub whole: bool,
    /// Whether parts that touch may slide.
    pub slides: bool,
    pub knees: bool,
    pub balls: bool,
    pub hands: [bool; 2],
}

const STANDS: FloorContacts = FloorContacts {
    whole: false,
    slides: false,
    knees: false,
    balls: true,
    hands: [false; 2],
};
const KNEELS: FloorContacts = FloorContacts {
    knees: true,
    hands: [true; 2],
    ..STANDS
};
const SLIDES: FloorContacts = FloorContacts {
    slides: true,
    ..KNEELS
};
const LIES: FloorContacts = FloorContacts {
    balls: false,
    hands: [false; 2],
    ..SLIDES
};
const ROLLS: FloorContacts = FloorContacts {
    whole: true,
    ..LIES
};
const PUSHES: FloorContacts = FloorContacts {
    balls: true,
    ..ROLLS
};
/// Leaning on the balls of the feet and these hands.
const fn leans(hands: [bool; 2]) -> FloorContacts {
    FloorContacts { hands, ..STANDS }
}

fn pose_aims(angles: &[f64; DOF_COUNT], weight: f64) -> [GoalAim; DOF_COUNT] {
    angles.map(|a| GoalAim::new(a, weight))
}

fn middle(p: [Vec3; 2]) -> Vec3 {
    (p[0] + p[1]) * 0.5
}

/// Goal to stay on the floor at this place.
fn stay(p: Vec3, weight: f64) -> [GoalAim; 3] {
    [
        GoalAim::new(p.x, weight),
        GoalAim::new(p.y, weight),
        GoalAim::new(0.0, weight),
    ]
}

/// The tips of the toes, tucked under.
fn tucked(p: Vec3) -> [GoalAim; 3] {
    let [x, y, z] = stay(p, FIRM);
    [x, y, GoalAim { weight: 0.1, ..z }]
}

impl Layout {
    /// The mirror image.
    pub fn mirrored(&self) -> Self {
        let place = |p: Vec3| Vec3 { y: -p.y, ..p };
        Self {
            scale: self.scale,
            pelvis: place(self.pelvis),
            roll: -self.roll,
            yaw: -self.yaw,
            knees: swapped(self.knees).map(place),
            balls: swapped(self.balls).map(place),
            hands: swapped(self.hands).map(place),
        }
    }

    /// A hand that lies flat at `x`, `y`.
    fn flat(&self, x: f64, y: f64) -> ([GoalAim; 3], GoalAim) {
        let wrist = [
            GoalAim::new(x, HAND),
            GoalAim::new(y, HAND),
            GoalAim::new(WRIST_HEIGHT * self.scale, HAND),
        ];
        (wrist, GoalAim::new(0.0, HAND))
    }

    /// Goals for the hands to stay in place.
    fn hands(&self) -> ([[GoalAim; 3]; 2], [GoalAim; 2]) {
        let [l, r] = self.hands.map(|p| self.flat(p.x, p.y));
        ([l.0, r.0], [l.1, r.1])
    }

    /// `goals` with the hand of one side placed at `x` ahead of the feet.
    fn step(&self, mut goals: Goals, side: usize, x: f64) -> Goals {
        let feet = middle(self.balls);
        let y = outward(side) * ARMS_APART;
        let to = self.flat(feet.x + x * self.scale, feet.y + y * self.scale);
        (goals.hands[side], goals.palms[side]) = to;
        goals
    }

    /// Centre of mass over the mean of the places, by their shares.
    fn over(&self, shares: &[(Vec3, f64)], weight: f64) -> [GoalAim; 2] {
        let (mut sum, mut whole) = (Vec3::zero(), 0.0);
        for (p, share) in shares {
            sum += *p * *share;
            whole += share;
        }
        let at = sum * (1.0 / whole);
        [GoalAim::new(at.x, weight), GoalAim::new(at.y, weight)]
    }

    /// The pelvis bent forward by `pitch`, level and straight otherwise.
    fn level(&self, pitch: f64, weight: f64) -> [GoalAim; 3] {
        [
            GoalAim::new(pitch, weight),
            GoalAim::new(0.0, 1.0),
            GoalAim::new(self.yaw, 0.3),
        ]
    }

    /// Goal for a place above the floor, `x` ahead of `from`, reference body, m.
    fn place(&self, from: Vec3, x: f64, z: f64, weight: f64) -> [GoalAim; 3] {
        [
            GoalAim::new(from.x + x * self.scale, weight),
            GoalAim::NONE,
            GoalAim::new(z * self.scale, weight),
        ]
    }
}

const fn stage(
    name: &'static str,
    seconds: f64,
    goals: fn(&Layout, &ReferencePoses) -> Goals,
    down: FloorContacts,
) -> GetUpStage {
    GetUpStage {
        name,
        seconds,
        goals,
        down,
        step: None,
    }
}

const fn stepping(
    name: &'static str,
    goals: fn(&Layout, &ReferencePoses) -> Goals,
    side: usize,
) -> GetUpStage {
    let mut hands = [true; 2];
    hands[side] = false;
    GetUpStage {
        name,
        seconds: 0.35,
        goals,
        down: leans(hands),
        step: Some((side, HAND_STEP_HEIGHT)),
    }
}

const fn crawling(
    name: &'static str,
    goals: fn(&Layout, &ReferencePoses) -> Goals,
    side: usize,
) -> GetUpStage {
    let mut out = stepping(name, goals, side);
    out.down.knees = true;
    out
}

/// Stages of rolling over the right side onto the belly, from the back and from the side.
pub const OVER: &[GetUpStage] = &[
    stage("gather", 1.1, gather, ROLLS),
    stage("push", 0.35, push, PUSHES),
    stage("over", 0.4, |h, l| roll(h, &l.rolled, 0.0), ROLLS),
    stage("tip", 0.35, |h, l| roll(h, &l.tipped, 0.0), ROLLS),
    stage("flat", 0.4, |h, l| roll(h, &l.sprawled, 0.0), ROLLS),
];

/// Stages of getting up from the belly.
pub const UP: &[GetUpStage] = &[
    stage("sprawl", 0.8, sprawl, LIES),
    stage("plant", 0.95, plant, LIES),
    stage("draw", 0.55, draw, SLIDES),
    stage("sink back", 0.45, sink_back, KNEELS),
    stage("all fours", 0.45, on_all_fours, KNEELS),
    stage("back", 0.25, |h, l| crawl(h, l, 0), KNEELS),
    crawling("left hand", |h, l| crawl_hand(h, l, 0), 0),
    stage("over", 0.2, |h, l| crawl(h, l, 1), KNEELS),
    crawling("right hand", |h, l| crawl_hand(h, l, 1), 1),
    stage("bear", 0.6, bear, leans([true; 2])),
    stage(
        "lean right",
        0.2,
        |h, l| lean(h, l, 0, (0.0, 0.7)),
        leans([true; 2]),
    ),
    stepping("left hand", |h, l| reach(h, l, 0, (-0.06, 0.71), 0.3), 0),
    stage(
        "lean left",
        0.2,
        |h, l| lean(h, l, 1, (-0.12, 0.72)),
        leans([true; 2]),
    ),
    stepping("right hand", |h, l| reach(h, l, 1, (-0.18, 0.72), 0.3), 1),
    stage("fold", 0.45, fold, leans([true; 2])),
    stage("rise", 1.0, rise, STANDS),
    stage("stand", 0.5, rise, STANDS),
];

/// Lying in its present place: the left foot set up, the right arm out of the way, the left one across.
fn gather(h: &Layout, l: &ReferencePoses) -> Goals {
    set_up(h, l, h.roll, 1.0)
}

/// Turned by `turn` from lying on the belly, the left foot set up behind.
fn set_up(h: &Layout, l: &ReferencePoses, turn: f64, weight: f64) -> Goals {
    let mut out = roll(h, &l.gathered, turn);
    out.balls[0][2] = GoalAim::new(0.0, weight);
    out.tips[0] = GoalAim::new(0.0, weight);
    out.heels[0] = GoalAim::new(0.0, weight);
    out
}

/// Pushed over by the left foot, which stays where it is.
fn push(h: &Layout, l: &ReferencePoses) -> Goals {
    let mut out = set_up(h, l, 0.0, FIRM);
    out.balls[0] = stay(h.balls[0], FIRM);
    out
}

/// Turned by `turn` from lying on the belly.
fn roll(h: &Layout, pose: &[f64; DOF_COUNT], turn: f64) -> Goals {
    Goals {
        pelvis: h.pelvis.to_array().map(|x| GoalAim::new(x, FIRM)),
        turn: [
            GoalAim::new(FRAC_PI_2, 0.3),
            GoalAim::new(turn, 2.0),
            GoalAim::new(h.yaw, 0.3),
        ],
        pose: pose_aims(pose, 0.03),
        ..Goals::default()
    }
}

/// Still lying in place: arms out to the sides, feet off the floor so that the toes can be tucked.
fn sprawl(h: &Layout, l: &ReferencePoses) -> Goals {
    let knees = h.knees.map(|p| stay(p, 1.0));
    Goals {
        pelvis: h.pelvis.to_array().map(|x| GoalAim::new(x, 1.0)),
        turn: h.level(FRAC_PI_2, 0.3),
        knees,
        chest: GoalAim::new(0.0, 1.0),
        pose: pose_aims(&l.sprawled, 0.1),
        ..Goals::default()
    }
}

/// Hands flat beside the ribs, toes tucked.
fn plant(h: &Layout, l: &ReferencePoses) -> Goals {
    let k = middle(h.knees);
    let y = ARMS_APART * h.scale;
    let [left, right] = [y, -y].map(|y| h.flat(k.x + 0.6 * h.scale, k.y + y));
    Goals {
        pelvis: h.pelvis.to_array().map(|x| GoalAim::new(x, 1.0)),
        turn: h.level(FRAC_PI_2, 0.1),
        knees: h.knees.map(|p| stay(p, FIRM)),
        balls: h.knees.map(|p| {
            tucked(Vec3 {
                x: p.x - SHANK * h.scale,
                ..p
            })
        }),
        tips: [GoalAim::new(0.0, FIRM); 2],
        hands: [left.0, right.0],
        palms: [left.1, right.1],
        chest: GoalAim::new(0.0, FIRM),
        pose: pose_aims(&l.planted, POSE),
        ..Goals::default()
    }
}

/// The hips up, the chest still on the floor.
fn draw(h: &Layout, l: &ReferencePoses) -> Goals {
    Goals {
        pelvis: h.place(middle(h.knees), 0.25, 0.34, 1.0),
        turn: h.level(1.85, 0.3),
        chest: GoalAim::new(0.01, FIRM),
        pose: pose_aims(&l.drawn, POSE),
        ..kneeling(h)
    }
}

fn kneeling(h: &Layout) -> Goals {
    let (hands, palms) = h.hands();
    Goals {
        turn: h.level(1.35, 1.0),
        knees: h.knees.map(|p| stay(p, FIRM)),
        balls: h.balls.map(tucked),
        tips: [GoalAim::new(0.0, FIRM); 2],
        hands,
        palms,
        ..Goals::default()
    }
}

/// Hips back over the knees, which takes the weight off the bent arms.
fn sink_back(h: &Layout, l: &ReferencePoses) -> Goals {
    Goals {
        pelvis: h.place(middle(h.knees), -0.12, 0.38, 1.0),
        turn: h.level(1.75, 0.3),
        pose: pose_aims(&l.sunk, POSE),
        ..kneeling(h)
    }
}

fn on_all_fours(h: &Layout, l: &ReferencePoses) -> Goals {
    Goals {
        pelvis: h.place(middle(h.knees), 0.02, 0.46, 1.0),
        pose: pose_aims(&l.on_all_fours, POSE),
        ..kneeling(h)
    }
}

/// On knees and feet, and on the hand opposite to `side`.
fn crawl(h: &Layout, l: &ReferencePoses, side: usize) -> Goals {
    let shares = [
        (middle(h.knees), 0.6),
        (middle(h.balls), if side == 0 { 0.2 } else { 0.12 }),
        (h.hands[1 - side], if side == 0 { 0.2 } else { 0.28 }),
    ];
    Goals {
        pelvis: h.place(middle(h.knees), -0.15, 0.43, 0.3),
        com: h.over(&shares, COM),
        pose: pose_aims(&l.on_all_fours, POSE),
        ..kneeling(h)
    }
}

fn crawl_hand(h: &Layout, l: &ReferencePoses, side: usize) -> Goals {
    h.step(crawl(h, l, side), side, 0.62)
}

/// On hands and the balls of the feet.
fn leaning(h: &Layout, shares: &[(Vec3, f64)]) -> Goals {
    let (hands, palms) = h.hands();
    Goals {
        com: h.over(shares, COM),
        turn: h.level(1.4, 0.3),
        balls: h.balls.map(|p| stay(p, FIRM)),
        tips: [GoalAim::new(0.0, FIRM); 2],
        hands,
        palms,
        ..Goals::default()
    }
}

fn bear(h: &Layout, l: &ReferencePoses) -> Goals {
    let shares = [(middle(h.balls), 0.6), (middle(h.hands), 0.4)];
    Goals {
        pelvis: h.place(middle(h.balls), 0.1, 0.66, 5.0),
        com: h.over(&shares, 3.0),
        pose: pose_aims(&l.bear, POSE),
        ..leaning(h, &shares)
    }
}

/// Leaning away from the hand of one side.
fn lean(h: &Layout, l: &ReferencePoses, side: usize, at: (f64, f64)) -> Goals {
    let other = 1 - side;
    let shares = [
        (h.balls[side], 0.42),
        (h.balls[other], 0.34),
        (h.hands[other], 0.24),
    ];
    Goals {
        pelvis: h.place(middle(h.balls), at.0, at.1, 2.0),
        pose: pose_aims(&l.bear, POSE),
        ..leaning(h, &shares)
    }
}

/// The hand of one side steps to `x` ahead of the feet.
fn reach(h: &Layout, l: &ReferencePoses, side: usize, at: (f64, f64), x: f64) -> Goals {
    h.step(lean(h, l, side, at), side, x)
}

/// The middle of the feet, ahead of the heels.
fn soles(h: &Layout) -> [(Vec3, f64); 1] {
    let mut p = middle(h.balls);
    p.x -= 0.06 * h.scale;
    [(p, 1.0)]
}

/// Heels down and all the weight on the feet, the hands still on the floor.
fn fold(h: &Layout, l: &ReferencePoses) -> Goals {
    let mut out = Goals {
        pelvis: h.place(middle(h.balls), -0.27, 0.72, 0.5),
        heels: [GoalAim::new(0.0, FIRM); 2],
        pose: pose_aims(&l.folded, POSE),
        ..leaning(h, &soles(h))
    };
    for (hand, palm) in out.hands.iter_mut().zip(&mut out.palms) {
        *hand = hand.map(|a| GoalAim::new(a.at, 1.0));
        palm.weight = 0.5;
    }
    out
}

fn rise(h: &Layout, l: &ReferencePoses) -> Goals {
    Goals {
        hands: [[GoalAim::NONE; 3]; 2],
        palms: [GoalAim::NONE; 2],
        heels: [GoalAim::new(0.0, FIRM); 2],
        turn: h.level(0.0, 0.3),
        pose: pose_aims(&l.at_ease, 0.05),
        ..leaning(h, &soles(h))
    }
}
