//! Goals for a posture while getting up: weighted numbers that can be interpolated.

use crate::body::topology::{DOF_COUNT, DOF_START, L_THIGH, L_UPPER_ARM, R_THIGH, R_UPPER_ARM};
use serde::{Deserialize, Serialize};

/// A goal for a number to be `at` a value, with a weight; weight 0 is no goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GoalAim {
    pub at: f64,
    pub weight: f64,
}

impl GoalAim {
    pub const NONE: Self = Self {
        at: 0.0,
        weight: 0.0,
    };

    pub fn new(at: f64, weight: f64) -> Self {
        Self { at, weight }
    }

    /// Interpolates between two goals. If only one of them has weight, its value is kept.
    fn mix(self, to: Self, u: f64) -> Self {
        let m = |a: f64, b: f64| a + u * (b - a);
        let at = match (self.weight > 0.0, to.weight > 0.0) {
            (true, false) => self.at,
            (false, true) => to.at,
            _ => m(self.at, to.at),
        };
        Self {
            at,
            weight: m(self.weight, to.weight),
        }
    }
}

/// Goals of an instant: places along x (ahead), y (to the left) and z in the motion's coordinates, m; angles, rad.
/// Pairs are left and right.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Goals {
    pub pelvis: [GoalAim; 3],
    /// Forward bend of the pelvis from upright, its preceding turn about its own long axis, and the heading applied
    /// after that.
    pub turn: [GoalAim; 3],
    /// Centre of mass, x and y.
    pub com: [GoalAim; 2],
    /// Knee caps, balls of the feet, tips of the toes and heels (height only), wrists, palms (height of flat hands).
    pub knees: [[GoalAim; 3]; 2],
    pub balls: [[GoalAim; 3]; 2],
    pub tips: [GoalAim; 2],
    pub heels: [GoalAim; 2],
    pub hands: [[GoalAim; 3]; 2],
    pub palms: [GoalAim; 2],
    /// Height of the front of the chest.
    pub chest: GoalAim,
    /// Anatomical angles.
    #[serde(with = "crate::saved::array")]
    pub pose: [GoalAim; DOF_COUNT],
}

impl Default for Goals {
    fn default() -> Self {
        Self {
            pelvis: [GoalAim::NONE; 3],
            turn: [GoalAim::NONE; 3],
            com: [GoalAim::NONE; 2],
            knees: [[GoalAim::NONE; 3]; 2],
            balls: [[GoalAim::NONE; 3]; 2],
            tips: [GoalAim::NONE; 2],
            heels: [GoalAim::NONE; 2],
            hands: [[GoalAim::NONE; 3]; 2],
            palms: [GoalAim::NONE; 2],
            chest: GoalAim::NONE,
            pose: [GoalAim::NONE; DOF_COUNT],
        }
    }
}

fn all<const N: usize>(a: &[GoalAim; N], b: &[GoalAim; N], u: f64) -> [GoalAim; N] {
    std::array::from_fn(|k| a[k].mix(b[k], u))
}

/// The pair with its sides swapped.
pub fn swapped<T: Copy>(pair: [T; 2]) -> [T; 2] {
    [pair[1], pair[0]]
}

/// The joint goals of the mirror image: the trunk bends and turns in the opposite direction.
fn mirrored(joints: &[GoalAim; DOF_COUNT]) -> [GoalAim; DOF_COUNT] {
    const TRUNK: usize = DOF_START[L_UPPER_ARM.index()];
    const ARM: usize = DOF_START[R_UPPER_ARM.index()];
    const LEG: usize = DOF_START[L_THIGH.index()];
    const OTHER: usize = DOF_START[R_THIGH.index()];
    std::array::from_fn(|d| match d {
        0..TRUNK if d % 3 == 0 => joints[d],
        0..TRUNK => joints[d].turned(),
        TRUNK..ARM => joints[d + ARM - TRUNK],
        ARM..LEG => joints[d + TRUNK - ARM],
        LEG..OTHER => joints[d + OTHER - LEG],
        _ => joints[d + LEG - OTHER],
    })
}

impl GoalAim {
    fn turned(self) -> Self {
        Self {
            at: -self.at,
            ..self
        }
    }
}

impl Goals {
    /// The goals of the mirror image.
    pub fn mirrored(&self) -> Self {
        let place = |[x, y, z]: [GoalAim; 3]| [x, y.turned(), z];
        let [pitch, roll, yaw] = self.turn;
        Self {
            pelvis: place(self.pelvis),
            turn: [pitch, roll.turned(), yaw.turned()],
            com: [self.com[0], self.com[1].turned()],
            knees: swapped(self.knees).map(place),
            balls: swapped(self.balls).map(place),
            tips: swapped(self.tips),
            heels: swapped(self.heels),
            hands: swapped(self.hands).map(place),
            palms: swapped(self.palms),
            chest: self.chest,
            pose: mirrored(&self.pose),
        }
    }

    /// Sets the values of `turn` and `pose` to those of the body, from which the motion starts; their weights stay.
    pub fn begin(&mut self, turn: [f64; 3], angles: &[f64; DOF_COUNT]) {
        for (aim, at) in self.turn.iter_mut().zip(turn) {
            aim.at = at;
        }
        for (aim, at) in self.pose.iter_mut().zip(angles) {
            aim.at = *at;
        }
    }

    /// Interpolates a fraction `u` of the way to other goals.
    pub fn mix(&self, to: &Self, u: f64) -> Self {
        let pair = |a: &[[GoalAim; 3]; 2], b: &[[GoalAim; 3]; 2]| {
            [all(&a[0], &b[0], u), all(&a[1], &b[1], u)]
        };
        Self {
            pelvis: all(&self.pelvis, &to.pelvis, u),
            turn: all(&self.turn, &to.turn, u),
            com: all(&self.com, &to.com, u),
            knees: pair(&self.knees, &to.knees),
            balls: pair(&self.balls, &to.balls),
            tips: all(&self.tips, &to.tips, u),
            heels: all(&self.heels, &to.heels, u),
            hands: pair(&self.hands, &to.hands),
            palms: all(&self.palms, &to.palms, u),
            chest: self.chest.mix(to.chest, u),
            pose: all(&self.pose, &to.pose, u),
        }
    }
}
