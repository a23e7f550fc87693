//! All numbers of a rehearsal, with units and why. One set for all clips.

use crate::sim::body::topology::DOF_COUNT;
use crate::sim::figure::rehearsed::MotorLaw;

/// Joint DOFs that a sample offsets: waist, thorax, shoulders without rotation, hips, knees, ankles without rotation.
/// What the others do is too light, or too far out, to change how the body moves.
pub const SAMPLED: [usize; 21] = [
    0, 1, 2, 3, 4, 9, 10, 16, 17, 23, 24, 25, 26, 27, 28, 31, 32, 33, 34, 35, 36,
];

/// Numbers of a rehearsal.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Stiff motors: the body does what its strength can, at once, so a sample is what it says. The horizon is about
    /// two ticks of a sixtieth of a second; softer motors lag behind the feet, stiffer ones chatter.
    pub motors: MotorLaw,
    /// Length of a window, s: about what a body takes to change its momentum.
    pub window: f64,
    /// Standard deviation of offsets in the first round, rad.
    pub spread: Spread,
    /// Errors that cost 1.
    pub sizes: Sizes,
    /// Cost of an offset of one standard deviation of one DOF: keeps apart what costs the same.
    pub effort: f64,
    /// Weight of the cost at the end of a window against its mean within: what comes next begins at the end.
    pub end: f64,
    /// Largest mean distance of the segments from the recording, m, of a sample that may live on, and of a motion from
    /// which help is taken away: short of the half metre that counts as lost.
    pub kept: f64,
    /// What a sample draws.
    pub draw: Draw,
    /// How much is tried.
    pub trials: Trials,
    /// The spring that leads back to the path in play.
    pub hold: HoldShare,
    /// Help.
    pub help: HelpPrice,
}

/// Standard deviations by part of the body, rad. A tenth of a radian of the trunk moves the centre of mass by some
/// centimetres, and the zero-moment point by a foot's length within a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Waist.
    pub waist: f64,
    /// Thorax.
    pub thorax: f64,
    /// Shoulders.
    pub shoulders: f64,
    /// Hips, knees and ankles.
    pub legs: f64,
}

impl Spread {
    /// One for each of [`SAMPLED`].
    pub fn each(&self) -> [f64; SAMPLED.len()] {
        SAMPLED.map(|d| match d {
            0..=2 => self.waist,
            3..=5 => self.thorax,
            6..=22 => self.shoulders,
            _ => self.legs,
        })
    }
}

/// Sizes of errors that cost 1: about half of what can still be mended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// Joints, root mean square, rad.
    pub joints: f64,
    /// Weight of an arm's joint against one of the trunk or legs: arms keep the balance.
    pub arms: f64,
    /// Turn of the pelvis, rad.
    pub turn: f64,
    /// Lowest points of hands and feet, m.
    pub ends: f64,
    /// Height of the centre of mass, m.
    pub height: f64,
    /// Place of the centre of mass on the floor, m.
    pub place: f64,
    /// Velocity of the centre of mass, m/s.
    pub velocity: f64,
    /// Angular momentum, kg·m²/s.
    pub spin: f64,
    /// Place of the feet under the centre of mass, m: what decides the balance.
    pub feet: f64,
}

impl Sizes {
    /// Weight of each joint DOF.
    pub fn joint_weights(&self) -> [f64; DOF_COUNT] {
        std::array::from_fn(|d| match d {
            6..=22 => self.arms,
            _ => 1.0,
        })
    }
}

/// What a sample draws: most stay near what is known, some go far, and each changes a part of the joints, since what
/// changes all at once is seldom better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// Share of the joints that a sample changes.
    pub part: f64,
    /// Share of the samples that go far.
    pub far_share: f64,
    /// How far they go, in standard deviations.
    pub far: f64,
    /// How far the others go.
    pub near: f64,
    /// Least spread of a window over that of the first round: there is always something new to try.
    pub least_spread: f64,
}

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trials {
    /// Samples of a window that is hard.
    pub samples: usize,
    /// Samples that are always taken; more only while the best costs more than `easy`.
    pub batch: usize,
    /// Window cost below which no more samples are taken.
    pub easy: f64,
    /// Samples that live on.
    pub survivors: usize,
    /// Window cost from which a window counts as lost: every error about three times the size that costs 1.
    pub lost: f64,
    /// A sample is dropped at three times the cost of the worst that it came from, plus `lost`.
    pub drop: f64,
    /// Windows that a new round goes back from where the last one was lost: half a second, what a step takes.
    pub back: usize,
    /// Part of the score of its past that a sample is chosen by.
    pub past: f64,
    /// Rounds over the whole clip once its end is reached.
    pub polish: usize,
    /// Rounds without getting farther after which the search gives up, or begins to help.
    pub patience: usize,
    /// Most ticks for each tick of the clip.
    pub budget: u64,
}

/// The hold, for a body of any size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoldShare {
    /// Angular frequency, rad/s: above √(g/l) ≈ 3.3 of a body that falls over, below what muscles do.
    pub frequency: f64,
    /// Largest force over the weight.
    pub force: f64,
    /// Largest moment over weight times stature.
    pub moment: f64,
    /// Moment of inertia about the pelvis over mass times stature squared.
    pub inertia: f64,
    /// Farthest from the path, m: PHC's rule calls half a metre lost.
    pub reach: f64,
}

/// What help costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelpPrice {
    /// Cost of a window with all the help that is allowed.
    pub full: f64,
    /// Cost of a window with any: help in few windows rather than a little in all.
    pub any: f64,
    /// Least help, as a force over the weight: less is none.
    pub least: f64,
    /// Passes that take help away, window by window, as long as the motion is kept.
    pub passes: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            motors: MotorLaw {
                horizon: 0.03,
                saturation_speed: 0.1,
            },
            window: 0.1,
            spread: Spread {
                waist: 0.12,
                thorax: 0.06,
                shoulders: 0.10,
                legs: 0.15,
            },
            sizes: Sizes {
                joints: 0.12,
                arms: 0.3,
                turn: 0.2,
                ends: 0.08,
                height: 0.05,
                place: 0.085,
                velocity: 0.35,
                spin: 6.0,
                feet: 0.12,
            },
            effort: 0.02,
            end: 0.6,
            kept: 0.4,
            draw: Draw {
                part: 0.6,
                far_share: 0.25,
                far: 1.6,
                near: 0.8,
                least_spread: 0.2,
            },
            trials: Trials {
                samples: 256,
                batch: 64,
                easy: 3.0,
                survivors: 32,
                lost: 60.0,
                drop: 3.0,
                back: 5,
                past: 0.4,
                polish: 3,
                patience: 4,
                budget: 400,
            },
            hold: HoldShare {
                frequency: 8.0,
                force: 0.08,
                moment: 0.02,
                inertia: 0.05,
                reach: 0.5,
            },
            help: HelpPrice {
                full: 6.0,
                any: 0.5,
                least: 0.004,
                passes: 3,
            },
        }
    }
}
