//! Help while a motion is being lost: bounded, always reported, and gone once the figure keeps its motion again.
//!
//! A forecast extrapolates how far the pelvis will be from its desired pose. While that distance counts as kept, the
//! figure relies on its own strength. Beyond it the figure is *carried*: its motion is followed where it lies in the
//! world, without steps of its own, and the controller plans with a wrench on the pelvis, bounded and with a price that
//! falls as the forecast gets worse ([`HelpTerms`]). Strength, soles and friction do what they can, and the wrench does
//! the rest. Once the forecast has been good for a while, the steps take charge again, and the wrench fades.
//!
//! A figure that lies on the floor, as its motion does, is carried by stiff motors and a pull on the pelvis instead,
//! since the controller does not know which parts of a body on the floor will bear weight.
//!
//! Nothing here looks ahead in the motion, so streams are helped by the same rule as clips.

use crate::body::{Body, State};
use crate::figure::params::help::{
    AGAIN_AFTER, ARM, BEGIN, BEGIN_AFTER, CHEAP_FROM, COST, DEAR_UNTIL, END, END_AFTER, FADE_TIME,
    FORECAST_TIME, GROWTH_TIME, MOMENT_SHARE, OUT_OF_REACH, OUT_OF_REACH_AFTER, PRICE_RANGE,
    PRICED, SMOOTHING_TIME,
};
use crate::math::Vec3;
use crate::math::curve::fall;
use crate::math::exp::exp;
use crate::motion::{GRAVITY, TargetPair};
use crate::stepper::params::pull::LEVER;
use crate::stepper::pelvis_wrench::Missing;
use serde::{Deserialize, Serialize};

/// Distance of a pelvis from its desired pose, forecast and present, m. A turn counts as the distance that a part of
/// the body at [`ARM`] moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossForecast {
    /// After [`FORECAST_TIME`], if both move on as they do now.
    pub ahead: f64,
    /// Now, without turns.
    pub now: f64,
}

impl LossForecast {
    /// At the start of a tick of `dt` s.
    pub fn of(target: &TargetPair, state: &State, dt: f64) -> Self {
        let Missing { off, rate } = Missing::of(target, state, 0.0, dt);
        let v = &state.velocity;
        let ahead = |k: usize| {
            let own = Vec3::from_array([v[3 * k], v[3 * k + 1], v[3 * k + 2]]);
            (off[k] + (rate[k] - own) * FORECAST_TIME).norm()
        };
        Self {
            ahead: ahead(1) + ARM * ahead(0),
            now: off[1].norm(),
        }
    }
}

/// The facts about a figure that decide whether it is helped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Situation {
    /// The forecast for its motion.
    pub forecast: LossForecast,
    /// Whether both the figure and its motion are up and on their feet, so that the figure can continue by itself.
    pub on_feet: bool,
    /// Whether more of it than the feet touches, while its motion is low.
    pub on_floor: bool,
    /// Whether its motion has just begun, perhaps in another state than that of the figure.
    pub begins: bool,
    /// Whether it has lost its balance, or lies.
    pub falls: bool,
}

/// Price and bound of the wrench that a plan may use in one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelpTerms {
    /// Compliance: [N²·m², N²] of moment and force per unit of cost.
    pub compliance: [f64; 2],
    /// Largest moment, N·m, and force, N.
    pub most: [f64; 2],
    /// Share of the last tick's wrench that costs nothing, 0…1.
    pub kept: f64,
}

impl HelpTerms {
    /// The terms for a body whose help may be `most` times its weight, at a forecast of `ahead` m, in a tick of `dt` s.
    pub fn new(body: &Body, most: f64, ahead: f64, dt: f64) -> Self {
        let p = body.profile;
        let force = p.mass * GRAVITY;
        let lever = LEVER * p.height;
        let cheapness = exp(-PRICE_RANGE * fall(ahead, (DEAR_UNTIL, CHEAP_FROM)));
        let unit = PRICED * force;
        let compliance = |f: f64| 0.5 * f * f * cheapness / COST;
        Self {
            compliance: [compliance(MOMENT_SHARE * lever * unit), compliance(unit)],
            most: [lever * most * force, most * force],
            kept: SMOOTHING_TIME / (SMOOTHING_TIME + dt),
        }
    }
}

/// Whether a figure is helped, and how much. Nothing allocates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LiveHelp {
    /// Share of the allowed help that may act, 0…1.
    share: f64,
    /// How long the forecast has called for a change, s.
    since: f64,
    carries: bool,
    /// Whether the figure is carried on the floor.
    on_floor: bool,
    /// The last forecast, m.
    ahead: f64,
    /// How long the motion has been out of reach, s.
    out_of_reach: f64,
    /// Time until the figure can be helped again after it was left to fall, s.
    pause: f64,
}

impl LiveHelp {
    /// Whether help keeps the figure with its motion, in place of steps.
    pub fn carries(&self) -> bool {
        self.carries
    }

    /// Whether stiff motors and a pull do that, in place of the controller.
    pub fn is_stiff(&self) -> bool {
        self.on_floor
    }

    /// Whether any help may act.
    pub fn acts(&self) -> bool {
        self.share > 0.0
    }

    /// The wrench that the controller may plan in a tick of `dt` s, for a body whose help may be `most` times its
    /// weight.
    pub fn terms(&self, body: &Body, most: f64, dt: f64) -> Option<HelpTerms> {
        let plans = self.acts() && !self.on_floor && most > 0.0;
        plans.then(|| HelpTerms::new(body, most * self.share, self.ahead, dt))
    }

    /// Whether a figure that loses its motion is helped rather than left to fall.
    pub fn is_ready(&self) -> bool {
        self.pause == 0.0
    }

    /// Share of the allowed help that may act, 0…1.
    pub fn share(&self) -> f64 {
        self.share
    }

    /// Ends all help at once.
    pub fn stop(&mut self) {
        *self = Self::default();
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let times = [self.since, self.out_of_reach, self.pause];
        (0.0..=1.0).contains(&self.share)
            && (!self.carries || self.acts())
            && (!self.on_floor || self.carries)
            && self.ahead >= 0.0
            && times.iter().all(|t| (0.0..=1e3).contains(t))
    }

    /// Decides whether to help in the tick of `dt` s that begins.
    pub fn observe(&mut self, seen: &Situation, dt: f64) {
        self.pause = (self.pause - dt).max(0.0);
        let changes = if self.carries {
            seen.forecast.ahead < END && seen.on_feet
        } else {
            seen.forecast.ahead > BEGIN && self.is_ready()
        };
        self.since = if changes { self.since + dt } else { 0.0 };
        let after = match (self.carries, seen.begins) {
            (true, _) => END_AFTER,
            (false, true) => 0.0,
            (false, false) => BEGIN_AFTER,
        };
        if self.since > after || (seen.falls && !self.carries && self.is_ready()) {
            (self.carries, self.since) = (!self.carries, 0.0);
        }
        self.out_of_reach = if self.carries && seen.forecast.now > OUT_OF_REACH {
            self.out_of_reach + dt
        } else {
            0.0
        };
        if self.out_of_reach > OUT_OF_REACH_AFTER {
            // The allowed help is not enough: the figure falls as it would have without it.
            *self = Self {
                share: self.share,
                pause: AGAIN_AFTER,
                ..Self::default()
            };
        }
        self.share = if self.carries {
            let growth = if seen.begins { 1.0 } else { dt / GROWTH_TIME };
            (self.share + growth).min(1.0)
        } else {
            (self.share - dt / FADE_TIME).max(0.0)
        };
        self.on_floor = self.carries && seen.on_floor;
        self.ahead = if self.acts() {
            seen.forecast.ahead
        } else {
            0.0
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1.0 / 60.0;

    fn seen(ahead: f64, now: f64) -> Situation {
        Situation {
            forecast: LossForecast { ahead, now },
            on_feet: true,
            on_floor: false,
            begins: false,
            falls: false,
        }
    }

    fn run(help: &mut LiveHelp, seen: Situation, seconds: f64) {
        for _ in 0..(seconds / DT).round() as usize {
            help.observe(&seen, DT);
            assert!(help.is_valid());
        }
    }

    #[test]
    fn it_grows_when_the_motion_is_being_lost_and_fades_within_half_a_second() {
        let mut help = LiveHelp::default();
        run(&mut help, seen(0.9 * BEGIN, 0.1), 5.0);
        assert!(!help.acts() && !help.carries());
        // A spike does not count as a loss.
        run(&mut help, seen(4.0 * BEGIN, 0.1), 0.5 * BEGIN_AFTER);
        run(&mut help, seen(0.5 * BEGIN, 0.1), DT);
        assert!(!help.acts());
        run(
            &mut help,
            seen(1.1 * BEGIN, 0.1),
            BEGIN_AFTER + GROWTH_TIME + 2.0 * DT,
        );
        assert!(help.carries() && help.share() == 1.0);
        // Between the two limits nothing changes.
        run(&mut help, seen(0.5 * (BEGIN + END), 0.1), 2.0);
        assert!(help.carries());
        run(&mut help, seen(0.5 * END, 0.01), END_AFTER + 2.0 * DT);
        assert!(!help.carries() && help.share() < 1.0);
        run(&mut help, seen(0.5 * END, 0.01), FADE_TIME);
        assert_eq!(help, LiveHelp::default());
    }

    #[test]
    fn it_acts_at_once_where_a_motion_begins_badly() {
        let mut help = LiveHelp::default();
        let begins = Situation {
            begins: true,
            ..seen(1.1 * BEGIN, 0.1)
        };
        run(&mut help, begins, DT);
        assert!(help.carries() && help.share() == 1.0);
        // But not where it begins well.
        let mut help = LiveHelp::default();
        let well = Situation {
            forecast: seen(0.9 * BEGIN, 0.1).forecast,
            ..begins
        };
        run(&mut help, well, 1.0);
        assert!(!help.acts());
    }

    #[test]
    fn who_lies_is_not_let_go_and_who_cannot_be_held_falls() {
        let mut help = LiveHelp::default();
        let lies = Situation {
            on_feet: false,
            on_floor: true,
            falls: true,
            ..seen(0.0, 0.0)
        };
        run(&mut help, lies, 3.0);
        assert!(help.carries() && help.is_stiff());
        let body = crate::support::testing::mannequin();
        assert_eq!(help.terms(&body, 0.3, DT), None);
        run(
            &mut help,
            seen(9.0, 1.5 * OUT_OF_REACH),
            OUT_OF_REACH_AFTER + 2.0 * DT,
        );
        assert!(!help.carries() && !help.is_ready());
        run(
            &mut help,
            Situation {
                falls: true,
                ..seen(9.0, 9.0)
            },
            FADE_TIME,
        );
        assert!(!help.acts());
        run(&mut help, seen(0.0, 0.0), AGAIN_AFTER);
        assert!(help.is_ready());
    }

    #[test]
    fn help_gets_cheaper_as_the_motion_is_being_lost_whatever_is_allowed() {
        let body = crate::support::testing::mannequin();
        let at = |most: f64, ahead: f64| HelpTerms::new(&body, most, ahead, DT);
        let weight = body.profile.mass * GRAVITY;
        let force = |most: f64, ahead: f64| at(most, ahead).compliance[1].sqrt();
        assert_eq!(force(0.3, 0.15), force(2.0, 0.15));
        assert_eq!(force(0.3, 0.0), force(0.3, DEAR_UNTIL));
        assert_eq!(force(0.3, CHEAP_FROM), force(0.3, 9.0));
        let steps: Vec<f64> = (0..20).map(|i| force(0.3, 0.01 * f64::from(i))).collect();
        assert!(steps.windows(2).all(|w| w[0] <= w[1]));
        // At its lowest price what is priced costs that much.
        let cost = (PRICED * weight).powi(2) / (2.0 * at(0.3, 9.0).compliance[1]);
        assert!((cost - COST).abs() < 1e-9 * COST);
        let most = at(0.3, 0.1).most;
        assert_eq!(
            most,
            [0.5 * body.profile.height * 0.3 * weight, 0.3 * weight]
        );
        // No help, no terms; while help fades, its bound does.
        let mut help = LiveHelp::default();
        assert_eq!(help.terms(&body, 0.3, DT), None);
        run(&mut help, seen(2.0 * BEGIN, 0.1), 1.0);
        assert_eq!(help.terms(&body, 0.3, DT).unwrap().most, most);
        run(&mut help, seen(0.0, 0.0), END_AFTER + 0.5 * FADE_TIME);
        let left = help.terms(&body, 0.3, DT).unwrap().most[1] / most[1];
        assert!((0.3..0.7).contains(&left), "{left}");
    }

    #[test]
    fn the_forecast_is_the_distance_after_a_while() {
        use crate::motion::Target;
        use crate::support::testing::{mannequin, standing};
        let body = mannequin();
        let mut state = standing(&body);
        let still = Target::still(state.posture);
        let target = TargetPair {
            now: still.clone(),
            next: still,
        };
        let zero = LossForecast::of(&target, &state, DT);
        assert_eq!(
            zero,
            LossForecast {
                ahead: 0.0,
                now: 0.0
            }
        );
        state.posture.root_position.x += 0.03;
        state.posture.root_position.y -= 0.04;
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        let off = LossForecast::of(&target, &state, DT);
        assert!(near(off.ahead, 0.05) && near(off.now, 0.05));
        // The pelvis comes back by itself, and turns.
        state.velocity[3] = -0.03 / FORECAST_TIME;
        state.velocity[4] = 0.04 / FORECAST_TIME;
        state.velocity[2] = 0.5;
        let back = LossForecast::of(&target, &state, DT);
        assert!(near(back.ahead, ARM * 0.5 * FORECAST_TIME) && near(back.now, 0.05));
    }
}
