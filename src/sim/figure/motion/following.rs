//! The way in which a figure follows its motion, and the help that it took: reported in its status and its frames.

use serde::{Deserialize, Serialize};

/// The way in which a figure follows its motion in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FollowMode {
    /// There is no motion to follow: the figure holds a posture by itself, lies, or gets up.
    #[default]
    Nothing,
    /// By its own strength, with balance and steps.
    Tracked,
    /// As rehearsed, by strength alone. The hold that leads back to the path of the rehearsal may act.
    Rehearsed,
    /// With help: help acts in this tick, or is part of the rehearsal.
    Helped,
}

/// How a figure follows its motion. Sums run from the beginning of the motion, and stay until the next one begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Following {
    /// The mode of the last tick.
    pub mode: FollowMode,
    /// Impulse of the help, N·s: the norm of its force, integrated over time.
    pub impulse: f64,
    /// The same of its moment about the pelvis, N·m·s.
    pub turning_impulse: f64,
    /// Weight of the body, integrated over the time in which there was a motion to follow, N·s.
    pub weight_time: f64,
}

impl Following {
    /// Help as a share of weight × time; 0 before the first tick.
    pub fn help_share(&self) -> f64 {
        if self.weight_time > 0.0 {
            self.impulse / self.weight_time
        } else {
            0.0
        }
    }

    /// Time for which a body of this weight, N, has followed its motion, s.
    pub fn time(&self, weight: f64) -> f64 {
        self.weight_time / weight
    }

    /// Adds a tick of `dt` s in which a moment (N·m) and a force (N) of these norms helped a body of this weight (N).
    pub fn add(&mut self, mode: FollowMode, help: [f64; 2], weight: f64, dt: f64) {
        self.mode = mode;
        if mode != FollowMode::Nothing {
            let [moment, force] = help;
            self.impulse += force * dt;
            self.turning_impulse += moment * dt;
            self.weight_time += weight * dt;
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let sums = [self.impulse, self.turning_impulse, self.weight_time];
        sums.iter().all(|x| x.is_finite() && *x >= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_counts_over_the_time_in_which_there_is_something_to_follow() {
        let mut f = Following::default();
        f.add(FollowMode::Nothing, [0.0; 2], 700.0, 1.0);
        assert_eq!((f, f.help_share()), (Following::default(), 0.0));
        f.add(FollowMode::Tracked, [0.0; 2], 700.0, 0.5);
        f.add(FollowMode::Helped, [30.0, 140.0], 700.0, 0.5);
        assert_eq!((f.mode, f.impulse), (FollowMode::Helped, 70.0));
        assert_eq!(f.turning_impulse, 15.0);
        assert!((f.help_share() - 0.1).abs() < 1e-15);
        f.add(FollowMode::Nothing, [0.0; 2], 700.0, 9.0);
        assert_eq!((f.mode, f.impulse), (FollowMode::Nothing, 70.0));
        assert!(f.is_valid());
        let broken = Following {
            impulse: f64::NAN,
            ..f
        };
        assert!(!broken.is_valid());
    }
}
