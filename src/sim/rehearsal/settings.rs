//! All numbers of a rehearsal, with units and reasons. One set for all clips.

use crate::body::topology::{ABDOMEN, CHEST, DOF_COUNT, DOF_SEGMENT, HEAD, L_THIGH};
use crate::motion::target::RestTimes;
use crate::stepper::motor_law::MotorLaw;

/// Joint DOFs that a sample offsets: waist, thorax, shoulders without rotation, hips, knees, ankles without rotation.
/// The others are too light, or too far out, to change how the body moves.
pub const SAMPLED: [usize; 21] = [
    0, 1, 2, 3, 4, 9, 10, 16, 17, 23, 24, 25, 26, 27, 28, 31, 32, 33, 34, 35, 36,
];

/// Numbers of a rehearsal.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Stiff motors: the body moves as its strength allows, without delay, so that a sample has the effect it
    /// describes. The horizon is about two ticks of a sixtieth of a second; softer motors lag behind the feet, and
    /// stiffer ones chatter.
    pub motors: MotorLaw,
    /// Length of a window, s: about the time that a body needs to change its momentum.
    pub window: f64,
    /// Share of a window in which its offsets are reached. Motors that act over a whole window act half a window late,
    /// which costs motions that need all their strength; a jump shows as a twitch.
    pub ramp: f64,
    /// How a motion begins from a stand and comes to one.
    pub rest: Rest,
    /// Standard deviation of offsets in the first round, rad.
    pub spread: Spread,
    /// Errors that cost 1.
    pub sizes: Sizes,
    /// Cost of an offset of one standard deviation of one DOF: separates samples that would cost the same.
    pub effort: f64,
    /// Weight of the cost at the end of a window against its mean within: the next window begins at the end.
    pub end: f64,
    /// Largest mean distance of the segments from the recording, m, at which a sample may survive, and at which help is
    /// removed from a motion: short of the half metre that counts as lost.
    pub kept: f64,
    /// The draw of a sample.
    pub draw: Draw,
    /// The number of trials.
    pub trials: Trials,
    /// The spring that leads back to the path during playback.
    pub hold: HoldShare,
    /// Help.
    pub help: HelpPrice,
}

/// Standing before and after a recording that begins or ends at rest: a second of it shows whether a body comes to a
/// stand or only falls past it, and gives a standing figure a place to begin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// Speed of the centre of mass below which a recording counts as standing, m/s: a body then stops within a hand's
    /// breadth.
    pub speed: f64,
    /// Before the first frame and after the last, moving parts come to rest, and the body to a balanced stand on the
    /// feet as they are.
    pub times: RestTimes,
    /// After that it does not count as standing if its extrapolated centre of mass, relative to the feet, is farther
    /// than this from that of the stand, m: half a foot's length.
    pub steady: f64,
    /// Total time of standing after the last frame, s.
    pub after: f64,
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
        SAMPLED.map(|d| match DOF_SEGMENT[d] {
            s if s == ABDOMEN.index() => self.waist,
            s if s == CHEST.index() => self.thorax,
            s if s < L_THIGH.index() => self.shoulders,
            _ => self.legs,
        })
    }
}

/// Sizes of errors that cost 1: about half of the error that can still be corrected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// Joints, root mean square, rad.
    pub joints: f64,
    /// Weight of a joint of an arm or the neck against one of the trunk or legs: arms keep the balance.
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
    /// Place of the feet under the centre of mass, m: it decides the balance.
    pub feet: f64,
    /// Place of the extrapolated centre of mass relative to the feet, m: a third of a foot's length.
    pub balance: f64,
}

impl Sizes {
    /// Weight of each joint DOF.
    pub fn joint_weights(&self) -> [f64; DOF_COUNT] {
        let arms_and_neck = HEAD.index()..L_THIGH.index();
        std::array::from_fn(|d| match arms_and_neck.contains(&DOF_SEGMENT[d]) {
            true => self.arms,
            false => 1.0,
        })
    }
}

/// The draw of a sample: most stay near the known path, some go far, and each changes a part of the joints, since
/// changing all at once is seldom better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// Number of survivors, the best first, from which the mean is tried as it is.
    pub from: usize,
    /// Share of the joints that a sample changes.
    pub part: f64,
    /// Share of the samples that go far.
    pub far_share: f64,
    /// Their spread, in standard deviations.
    pub far: f64,
    /// Spread of the others.
    pub near: f64,
    /// Least spread of a window over that of the first round, so that there is always something new to try.
    pub least_spread: f64,
}

/// When the samples of a window are enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enough {
    /// The best one costs less than this.
    pub easy: f64,
    /// The best one costs less than this, and the last batch has improved its score by less than the share `gain`.
    pub calm: f64,
    /// See `calm`.
    pub gain: f64,
}

/// Rounds over a whole clip that is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polish {
    /// Rounds.
    pub rounds: usize,
    /// Most samples of a window in those rounds: the path is known, and its surroundings are narrow.
    pub samples: usize,
}

/// The effort spent on a window, and the cost at which it is abandoned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tries {
    /// Samples of a window that is hard.
    pub samples: usize,
    /// Window cost from which a window counts as lost.
    pub lost: f64,
}

/// The number of trials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trials {
    /// A window is lost when every error is about three times the size that costs 1: a sample that is so bad seldom
    /// comes back, and the effort is better spent on the windows before it.
    pub near: Tries,
    /// For motions that are not found in this way: a window is lost only if no sample keeps the motion, and there are
    /// more samples.
    pub far: Tries,
    /// Number of samples that are always taken, and of each further batch until they are enough.
    pub batch: usize,
    /// When no more samples are taken.
    pub enough: Enough,
    /// Number of survivors.
    pub survivors: usize,
    /// A sample is dropped at three times the cost of the worst sample from which it came, plus that of a lost window.
    pub drop: f64,
    /// Windows by which a new round goes back from where the last one was lost: half a second, the time of a step.
    pub back: usize,
    /// Share of the score of its past by which a sample is chosen.
    pub past: f64,
    /// The work after the end is reached.
    pub polish: Polish,
    /// Rounds without getting farther, or without a path that is cheaper by `gain`, after which the search gives up or
    /// enters its next stage.
    pub patience: usize,
    /// See `patience`; a share.
    pub gain: f64,
    /// Most ticks of a stage for each tick of the clip.
    pub budget: u64,
    /// Least budget for the whole clip: short clips are whole efforts, and cost only seconds.
    pub least_budget: u64,
}

/// The hold, for a body of any size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoldShare {
    /// Angular frequency, rad/s: above √(g/l) ≈ 3.3 of a body that falls over, below that of muscles.
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

/// The cost of help.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelpPrice {
    /// Cost of a window with all the allowed help.
    pub full: f64,
    /// Cost of a window with any help: favours help in few windows over a little in all.
    pub any: f64,
    /// Least help, as a force over the weight; anything less counts as none.
    pub least: f64,
    /// Passes that remove help, window by window, as long as the motion is kept.
    pub passes: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            motors: MotorLaw::STIFF,
            window: 0.1,
            ramp: 0.5,
            rest: Rest {
                speed: 0.3,
                times: RestTimes {
                    stopping: 0.3,
                    settling: 0.5,
                },
                steady: 0.12,
                after: 1.0,
            },
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
                balance: 0.08,
            },
            effort: 0.02,
            end: 0.6,
            kept: 0.4,
            draw: Draw {
                from: 12,
                part: 0.6,
                far_share: 0.25,
                far: 1.6,
                near: 0.8,
                least_spread: 0.2,
            },
            trials: Trials {
                near: Tries {
                    samples: 192,
                    lost: 60.0,
                },
                far: Tries {
                    samples: 384,
                    lost: 200.0,
                },
                batch: 48,
                enough: Enough {
                    easy: 3.0,
                    calm: 15.0,
                    gain: 0.1,
                },
                survivors: 32,
                drop: 3.0,
                back: 5,
                past: 0.4,
                polish: Polish {
                    rounds: 3,
                    samples: 96,
                },
                patience: 4,
                gain: 0.03,
                budget: 800,
                least_budget: 120_000,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::DOF_NAMES;

    #[test]
    fn samples_offset_the_joints_that_are_named() {
        let side = |s: &str, joints: &[&str]| -> Vec<String> {
            joints.iter().map(|j| format!("{s}_{j}")).collect()
        };
        let trunk = [
            "waist_flexion",
            "waist_lateral",
            "waist_rotation",
            "thorax_flexion",
            "thorax_lateral",
        ];
        let arm = ["shoulder_flexion", "shoulder_abduction"];
        let leg = [
            "hip_flexion",
            "hip_abduction",
            "hip_rotation",
            "knee_flexion",
            "ankle_flexion",
            "ankle_inversion",
        ];
        let mut named: Vec<String> = trunk.map(str::to_owned).to_vec();
        for joints in [&arm[..], &leg] {
            named.extend(["l", "r"].iter().flat_map(|s| side(s, joints)));
        }
        assert_eq!(SAMPLED.map(|d| DOF_NAMES[d]).to_vec(), named);
    }
}
