//! Every tunable number of a figure and its steppers.

use crate::params::Param;

/// Supports, reactions, and other bodies.
pub mod support {
    crate::params::params! {
        /// A part rests on something that carries this share of the weight.
        REST_SHARE: f64 = 0.02, "1", 0.005..=0.1, "docs/tick.md";
        /// Part of a reaction that a controller takes in per tick: a blow is over before it is known, a seat is
        /// known after some ticks.
        REACTION_GAIN: f64 = 0.15, "1", 0.05..=1.0, "docs/adr/0009-collisions.md";
        /// Largest reaction that a controller counts on.
        LARGEST_REACTION: f64 = 2000.0, "N", 500..=5000, "docs/adr/0009-collisions.md";
        /// Contacts closer than this are one place.
        SPOT_SIZE: f64 = 0.05, "m", 0.01..=0.2, "docs/adr/0009-collisions.md";
        /// A place that is not pressed any more is forgotten below this.
        SPOT_FORGOTTEN: f64 = 1.0, "N", 0.1..=10, "numerical";
    }
}

/// Collisions in stages, as in §3 of the paper.
pub mod staged {
    crate::params::params! {
        /// Overlap that is left: parts that touch go on touching.
        OVERLAP: f64 = 1e-3, "m", 1e-4..=5e-3, "docs/equations.md";
        /// Largest correction of one overlap in a round.
        CORRECTION: f64 = 0.02, "m", 5e-3..=0.1, "numerical";
        /// Rounds of correction in a tick.
        CORRECTIONS: usize = 2, "rounds", 1..=5, "numerical";
    }
}

/// Whether balance is lost for good.
pub mod balance {
    crate::params::params! {
        /// Largest distance outside the support from which arms and trunk bring the capture point back.
        BODY_REACH: f64 = 0.04, "m", 0..=0.1, "docs/locomotion.md#recovery";
        /// The same for a figure that does not step: it keeps trying on an edge of the feet. Lost balance becomes a
        /// fall once the centre of mass is farther than this from its place in the motion.
        PAPER_REACH: f64 = 0.15, "m", 0.04..=0.3, "docs/tick.md";
        /// Largest distance outside the support from which steps bring the capture point back.
        STEP_REACH: f64 = 0.6, "m", 0.2..=1.0, "docs/locomotion.md#recovery";
        /// A body with its centre of mass below this share of its standing height does not step any more.
        LOWEST_STEP: f64 = 0.7, "1", 0.5..=0.9, "docs/locomotion.md#recovery";
        /// Balance is found again once the capture point has been inside for so long.
        RECOVERY_TIME: f64 = 0.3, "s", 0.1..=1.0, "docs/locomotion.md#recovery";
        /// Least height of the centre of mass that the capture point is computed with.
        LEAST_HEIGHT: f64 = 0.05, "m", 0.01..=0.2, "numerical";
    }
}

/// Falling, lying, and standing again.
pub mod fall {
    crate::params::params! {
        /// A figure has fallen, and a motion lies, when the centre of mass is below this share of its standing
        /// height.
        FALLEN_HEIGHT: f64 = 0.45, "1", 0.3..=0.6, "docs/tick.md";
        /// A fallen figure stands again when its centre of mass is above this share of the standing height.
        RISEN_HEIGHT: f64 = 0.6, "1", 0.45..=0.8, "docs/tick.md";
        /// Share of its strength that a fallen figure uses: it relaxes.
        STRENGTH: f64 = 0.3, "1", 0.1..=1.0, "docs/tick.md";
        /// Time constant of what a fallen figure demands of its joints.
        HORIZON: f64 = 0.3, "s", 0.1..=1.0, "docs/tick.md";
        /// Rate error at which a motor of a fallen figure gives all it has: soft, and easy on the solver while
        /// many parts touch.
        SATURATION_SPEED: f64 = 0.5, "rad/s", 0.1..=3.0, "numerical";
    }
}

/// How a figure braces itself while it falls.
pub mod bracing {
    crate::params::params! {
        /// Share of their flexion by which knees bend, and hips in a fall backward.
        BEND: f64 = 0.5, "1", 0..=1.0, "docs/tick.md#falling";
        /// Time constant of what it demands of its joints: about as fast as muscles can.
        HORIZON: f64 = 0.02, "s", 0.01..=0.1, "docs/tick.md#falling";
    }
}

/// When a fallen figure gets up, and how fast.
pub mod get_up {
    crate::params::params! {
        /// The figure has got up once its centre of mass is above this share of its standing height.
        UP_HEIGHT: f64 = 0.75, "1", 0.6..=0.95, "docs/locomotion.md#getting-up";
        /// A trunk lies whose axis rises by less than this, as a sine.
        LEVEL: f64 = 0.7, "1", 0.3..=0.9, "docs/locomotion.md#getting-up";
        /// A body lies still below this speed of its centre of mass.
        STILL_SPEED: f64 = 0.3, "m/s", 0.05..=1.0, "docs/locomotion.md#getting-up";
        /// Getting up keeps its full pace below this error: root mean square of the joints.
        FULL_PACE_JOINTS: f64 = 0.08, "rad", 0.01..=1.0, "docs/locomotion.md#getting-up";
        /// It waits above this error: root mean square of the joints.
        NO_PACE_JOINTS: f64 = 0.2, "rad", 0.02..=2.0, "docs/locomotion.md#getting-up";
        /// Getting up keeps its full pace below this error: turn of the pelvis.
        FULL_PACE_TURN: f64 = 0.15, "rad", 0.01..=1.0, "docs/locomotion.md#getting-up";
        /// It waits above this error: turn of the pelvis.
        NO_PACE_TURN: f64 = 0.4, "rad", 0.02..=2.0, "docs/locomotion.md#getting-up";
        /// Getting up keeps its full pace below this error: distance of the centre of mass over the floor.
        FULL_PACE_COM: f64 = 0.03, "m", 0.01..=1.0, "docs/locomotion.md#getting-up";
        /// It waits above this error: distance of the centre of mass over the floor.
        NO_PACE_COM: f64 = 0.08, "m", 0.02..=2.0, "docs/locomotion.md#getting-up";
        /// `FULL_PACE_TURN` of a body that lies: it has nothing to lose.
        FULL_PACE_LYING_TURN: f64 = 0.25, "rad", 0.05..=1.0, "docs/locomotion.md#getting-up";
        /// `NO_PACE_TURN` of a body that lies.
        NO_PACE_LYING_TURN: f64 = 0.6, "rad", 0.1..=2.0, "docs/locomotion.md#getting-up";
        /// Least pace of a body that lies, so that it does not wait for ever.
        LEAST_PACE: f64 = 0.25, "1", 0.05..=1.0, "docs/locomotion.md#getting-up";
        /// Getting up stalls below this pace.
        STALLED_PACE: f64 = 0.05, "1", 0..=0.5, "docs/locomotion.md#getting-up";
        /// An attempt that has stalled, or waited, for so long is given up.
        STALLED_TIME: f64 = 1.0, "s", 0.3..=10, "docs/locomotion.md#getting-up";
        /// Attempts for one motion that gets up.
        ATTEMPTS: u32 = 9, "rounds", 1..=20, "docs/locomotion.md#getting-up";
    }
}

/// Switching from one motion to another.
pub mod switch {
    crate::params::params! {
        /// Samples of 1/60 s that still play before a motion is left: the time that there is to plan how.
        LEAD: usize = 4, "samples", 2..=12, "docs/locomotion.md#stops";
        /// The same after plans that came late: twice as many each time, up to this.
        MOST_LEAD: usize = 24, "samples", 4..=40, "docs/locomotion.md#stops";
        /// How far ahead a clip is looked at for a place to stop.
        STOP_AHEAD: f64 = 0.8, "s", 0.4..=2.0, "docs/locomotion.md#stops";
        /// A body slower than this is led into the posture in which the next clip begins; a faster one stands at
        /// ease first.
        SLOW: f64 = 0.2, "m/s", 0.05..=0.5, "docs/locomotion.md#stops";
        /// Time that the steps to a stand take, as is expected before they are planned.
        STOP_TIME: f64 = 2.2, "s", 1..=4, "docs/locomotion.md#stops";
        /// Time that the way from a stand into a clip takes, as is expected before it is planned.
        ENTRY_TIME: f64 = 2.7, "s", 1..=5, "docs/locomotion.md#stops";
        /// A clip that waits begins at most so long before the motion that leads to it is over, if the figure has
        /// settled.
        EARLIEST_BEGIN: f64 = 0.4, "s", 0..=1, "docs/locomotion.md#stops";
        /// The joints have come to where a motion leads them when they are closer than this.
        STILL: f64 = 0.05, "rad", 0.01..=0.2, "docs/locomotion.md#stops";
        /// A clip that waits begins at the latest so long after the motion that leads to it is over; one that begins
        /// again, while feet are brought back, after four times that.
        PATIENCE: f64 = 2.0, "s", 0.5..=5, "docs/locomotion.md#stops";
        /// A posture stands upright with the pelvis above this share of its standing height.
        UPRIGHT: f64 = 0.9, "1", 0.8..=1.0, "docs/locomotion.md#stops";
    }
}

/// The effect of a load on a motion with steps.
pub mod load {
    crate::params::params! {
        /// Lean of the trunk per shift of the centre of mass: it does about half, and the pelvis the rest.
        LEAN: f64 = 1.8, "rad/m", 0..=3, "docs/locomotion.md#loads";
        /// Largest lean of the trunk.
        LARGEST_LEAN: f64 = 0.25, "rad", 0..=0.5, "docs/locomotion.md#loads";
        /// Largest shift of the pelvis.
        LARGEST_SHIFT: f64 = 0.12, "m", 0..=0.2, "docs/locomotion.md#loads";
        /// Time constant, twice, with which a load that was taken up or let go has its effect.
        ONSET_TIME: f64 = 0.2, "s", 0.05..=1, "docs/locomotion.md#loads";
        /// A load that differs by less than this, in kg and kg·m, from its effect has all of it.
        SAME_LOAD: f64 = 1e-6, "kg", 0..=1e-3, "numerical";
        /// Rounds in which the shift of the pelvis is found: each leaves a tenth of the error.
        SHIFT_ROUNDS: usize = 3, "rounds", 1..=6, "numerical";
        /// Rates of a changed motion are differences over so long before and after a moment: short enough to be
        /// those of the moment, long enough for what mirrored bodies round differently to stay below 1e-9 in their
        /// torques.
        RATE_SPAN: f64 = 5e-4, "s", 1e-5..=5e-3, "numerical";
        /// Load with which an arm swings half as far: about the mass of an arm.
        HALF_SWING: f64 = 4.0, "kg", 1..=10, "docs/locomotion.md#loads";
        /// A movement of an arm that takes less time than this counts as quick.
        QUICK: f64 = 0.7, "s", 0.2..=2, "docs/locomotion.md#loads";
        /// An arm hangs whose hand is less than this before or behind its shoulder.
        HANGS_SWING: f64 = 0.7, "rad", 0.3..=1.2, "docs/locomotion.md#loads";
        /// It no longer hangs beyond this angle. Between the two angles the swing that the load took away returns.
        RAISED_SWING: f64 = 1.6, "rad", 1.0..=2.5, "docs/locomotion.md#loads";
        /// An arm hangs whose elbow is bent by less than this.
        HANGS_ELBOW: f64 = 0.9, "rad", 0.3..=1.2, "docs/locomotion.md#loads";
        /// It does not hang from this angle on: a forearm that is held level carries something in front of the
        /// body.
        BENT_ELBOW: f64 = 1.5, "rad", 1.0..=2.5, "docs/locomotion.md#loads";
        /// Time constant with which an arm gets used to hanging, so that an arm that only comes down between two
        /// movements follows the motion.
        HABIT_TIME: f64 = 0.7, "s", 0.2..=2, "docs/locomotion.md#loads";
    }
}

/// When the other hand helps with a load, and how.
pub mod second_hand {
    crate::params::params! {
        /// An arm is too weak that needs more than this share of its strength to hold its load still.
        WEAK: f64 = 1.0, "1", 0.7..=1.5, "docs/tick.md#the-second-hand";
        /// One arm is enough again below this share.
        ENOUGH: f64 = 0.8, "1", 0.5..=1.0, "docs/tick.md#the-second-hand";
        /// It has to be enough for so long before the other hand lets go.
        CALM: f64 = 0.5, "s", 0.1..=3.0, "docs/tick.md#the-second-hand";
        /// The other hand helps only if what is needed falls by at least this share of the strength.
        WORTH: f64 = 0.05, "1", 0..=0.3, "docs/tick.md#the-second-hand";
        /// How far ahead the motion is looked at.
        AHEAD: f64 = 0.6, "s", 0.0..=2.0, "docs/tick.md#the-second-hand";
        /// Time in which the hand goes to the load, and back.
        REACH_TIME: f64 = 0.5, "s", 0.2..=1.5, "docs/tick.md#the-second-hand";
        /// Time in which the whole load would go from one hand to the other.
        SHARE_TIME: f64 = 0.5, "s", 0.1..=2.0, "docs/tick.md#the-second-hand";
        /// A share that is off by less than this stays.
        SAME_SHARE: f64 = 0.02, "1", 0.001..=0.1, "numerical";
        /// Most of the load that the other hand takes.
        LARGEST_SHARE: f64 = 0.9, "1", 0.5..=1.0, "docs/tick.md#the-second-hand";
        /// Distance between the palms: a load has no size.
        APART: f64 = 0.14, "m", 0.05..=0.3, "docs/tick.md#the-second-hand";
        /// The hand takes hold when its palm is as near as this to its place.
        NEAR: f64 = 0.06, "m", 0.01..=0.1, "docs/tick.md#the-second-hand";
        /// It gives up if it is not there so long after it should be.
        PATIENCE: f64 = 0.7, "s", 0.2..=3.0, "docs/tick.md#the-second-hand";
        /// Pause after that, and after it had to let go.
        PAUSE: f64 = 1.0, "s", 0.2..=5.0, "docs/tick.md#the-second-hand";
        /// A place that it cannot reach is looked at again after this time.
        LOOK_AGAIN: f64 = 0.1, "s", 0.02..=0.5, "numerical";
        /// Time constant with which the hand follows a load that is not where the motion has it.
        FOLLOW_TIME: f64 = 0.04, "s", 0.0..=0.5, "docs/tick.md#the-second-hand";
        /// Share of the arm's length that the place must be within.
        STRETCH: f64 = 0.97, "1", 0.8..=1.0, "docs/tick.md#the-second-hand";
        /// How far a shoulder may be led beyond its limits.
        LIMIT_SLACK: f64 = 0.03, "rad", 0..=0.2, "docs/tick.md#the-second-hand";
        /// How much deeper than in the motion the arm may be in the body's capsules.
        TOUCH_SLACK: f64 = 0.01, "m", 0..=0.05, "docs/tick.md#the-second-hand";
    }
}

/// Constraints that clients set.
pub mod constraints {
    crate::params::params! {
        /// How far inside of what carries it the wanted centre of mass is kept. Feet count from the heel to the
        /// ball: toes cannot carry a body for long.
        COM_INSET: f64 = 0.03, "m", 0..=0.1, "docs/tick.md";
        /// How far from where the motion has it a point of trunk, head or legs is led: beyond, whole-body motion
        /// cannot keep balance.
        TRUNK_REACH: f64 = 0.15, "m", 0.05..=0.4, "docs/tick.md";
        /// How far ahead of the present place the centre of mass is asked for: 2.5 m/s² and 0.25 m/s with the
        /// controllers' law.
        COM_LEASH: f64 = 0.1, "m", 0.02..=0.3, "docs/tick.md";
        /// Places given one after the other within this time are one place that moves.
        STREAM_INTERVAL: f64 = 0.1, "s", 0.02..=0.5, "docs/tick.md";
        /// A place that moves faster than this has jumped.
        STREAM_SPEED: f64 = 5.0, "m/s", 1..=10, "docs/tick.md";
        /// Time constant with which the velocity of such a place is taken from its differences.
        STREAM_SMOOTHING: f64 = 0.015, "s", 0..=0.1, "docs/tick.md";
    }
}

/// Help while a motion is being lost.
pub mod help {
    crate::params::params! {
        /// How far the forecast looks ahead: by what a fall that begins needs to become one (1/ω of a standing body).
        FORECAST_TIME: f64 = 0.3, "s", 0.1..=0.6, "docs/rehearsal.md#live-help";
        /// Distance from the pelvis at which its turns are measured as displacements.
        ARM: f64 = 0.5, "m", 0.2..=1.0, "docs/rehearsal.md#live-help";
        /// A motion is being lost from this forecast on: a quarter of what counts as lost. Later, more is needed.
        BEGIN: f64 = 0.12, "m", 0.1..=0.5, "docs/rehearsal.md#live-help";
        /// For so long: a foot that strikes is not a loss.
        BEGIN_AFTER: f64 = 0.05, "s", 0..=0.2, "docs/rehearsal.md#live-help";
        /// It is kept again below this forecast.
        END: f64 = 0.06, "m", 0.05..=0.2, "docs/rehearsal.md#live-help";
        /// For so long.
        END_AFTER: f64 = 0.3, "s", 0.1..=1.0, "docs/rehearsal.md#live-help";
        /// Time constant with which the plan of a figure that is carried returns to its own place and time.
        HOME_TIME: f64 = 0.5, "s", 0.1..=5.0, "docs/rehearsal.md#live-help";
        /// Time in which help grows to what is allowed.
        GROWTH_TIME: f64 = 0.1, "s", 0.02..=0.5, "docs/rehearsal.md#live-help";
        /// Time in which it fades.
        FADE_TIME: f64 = 0.5, "s", 0.1..=0.5, "docs/rehearsal.md#live-help";
        /// Farther off a motion cannot be caught again.
        OUT_OF_REACH: f64 = 1.0, "m", 0.5..=2.0, "docs/rehearsal.md#live-help";
        /// For so long: then the figure is let fall.
        OUT_OF_REACH_AFTER: f64 = 0.5, "s", 0.1..=2.0, "docs/rehearsal.md#live-help";
        /// Time until a figure that was let fall can be helped again.
        AGAIN_AFTER: f64 = 2.0, "s", 0.5..=10.0, "docs/rehearsal.md#live-help";
        /// Force over the weight, and moment over half the weight times stature, that costs a plan `COST`, whatever is
        /// allowed: what is cheap must not depend on what is allowed.
        PRICED: f64 = 0.3, "1", 0.05..=1.0, "docs/rehearsal.md#live-help";
        /// Cost to a plan of such a force while the motion is being lost. The tasks that it competes with cost up to
        /// some hundreds.
        COST: f64 = 10.0, "1", 1..=100, "docs/rehearsal.md#live-help";
        /// Factor on what a moment may be at the same cost: turns are needed most, and a moment carries nothing.
        MOMENT_SHARE: f64 = 2.0, "1", 0.5..=4.0, "docs/rehearsal.md#live-help";
        /// Up to this forecast help has its highest price.
        DEAR_UNTIL: f64 = 0.05, "m", 0..=0.2, "docs/rehearsal.md#live-help";
        /// From this forecast on it has its lowest.
        CHEAP_FROM: f64 = 0.2, "m", 0.1..=0.5, "docs/rehearsal.md#live-help";
        /// Logarithm of the highest price over the lowest: a factor of 300.
        PRICE_RANGE: f64 = 5.7, "1", 0..=10.0, "docs/rehearsal.md#live-help";
        /// Time over which a wrench changes without cost: the price on its change. It shakes the figure without it.
        SMOOTHING_TIME: f64 = 0.13, "s", 0..=0.3, "docs/rehearsal.md#live-help";
    }
}

/// All groups with their names.
pub fn groups() -> [(&'static str, &'static [Param]); 11] {
    [
        ("support", support::ALL),
        ("staged", staged::ALL),
        ("balance", balance::ALL),
        ("fall", fall::ALL),
        ("bracing", bracing::ALL),
        ("get_up", get_up::ALL),
        ("switch", switch::ALL),
        ("load", load::ALL),
        ("second_hand", second_hand::ALL),
        ("constraints", constraints::ALL),
        ("help", help::ALL),
    ]
}
