//! Tunable numbers of tracking, in groups.

use crate::params::Param;

/// Numbers that all of tracking shares.
pub mod common {
    crate::params::params! {
        /// A capture point nearer to its planned place than this is settled.
        SETTLED_OFFSET: f64 = 0.03, "m", 0.01..=0.1, "docs/locomotion.md#stops";
        /// Least speed of a plan, clip seconds per second.
        LEAST_SPEED: f64 = 1e-9, "1", 1e-12..=1e-3, "numerical";
        /// A foot that finds no floor goes down at this speed.
        LOWERING_SPEED: f64 = 0.5, "m/s", 0.1..=2.0, "docs/locomotion.md#contact";
        /// A foothold does not change within this time before touch-down, because its foot may land from then on;
        /// earlier touches are scuffs.
        FREEZE_TIME: f64 = 0.06, "s", 0.0..=0.2, "docs/locomotion.md#capture-point";
        /// Time in which a clip that ended in motion turns into standing at ease.
        STOP_TIME: f64 = 0.6, "s", 0.2..=2.0, "docs/locomotion.md#stops";
    }
}

/// The map from the plan to the world.
pub mod world_map {
    crate::params::params! {
        /// Time constant with which the plan moves to a new anchor.
        SETTLING_TIME: f64 = 0.04, "s", 0.01..=0.3, "docs/locomotion.md#contact";
        /// Share of the heading error of a landed foot that the plan takes over.
        HEADING_GAIN: f64 = 0.3, "1", 0.0..=1.0, "docs/locomotion.md#contact";
        /// Share of the plan's turn that is given back in each step.
        HEADING_RETURN: f64 = 0.2, "1", 0.0..=1.0, "docs/locomotion.md#contact";
    }
}

/// Contact by events.
pub mod contact {
    crate::params::params! {
        /// A sole lower than this touches the floor.
        TOUCH_HEIGHT: f64 = 0.004, "m", 0.001..=0.02, "docs/locomotion.md#contact";
        /// A foot that comes down from a flight may land this long before its time; earlier touches are scuffs.
        EARLIEST_AFTER_FLIGHT: f64 = 0.2, "s", 0.0..=0.4, "docs/locomotion.md#runs";
        /// A foot that finds no floor counts as planted after this time.
        LATEST: f64 = 0.15, "s", 0.05..=0.5, "docs/locomotion.md#contact";
        /// Highest rate at which a plan is followed: after an early landing, in the air, and for an early step.
        FASTEST_RATE: f64 = 2.0, "1", 1.2..=3.0, "docs/locomotion.md#step-timing";
        /// A plan is not accelerated after an early landing if its own landing comes within this time.
        IMMINENT: f64 = 0.03, "s", 0.0..=0.1, "docs/locomotion.md#contact";
        /// Rate at which a figure that is behind its stream makes up for it.
        STREAM_RATE: f64 = 1.05, "1", 1.0..=1.5, "docs/locomotion.md#streams";
        /// A recovery step holds the plan until it is this far behind its schedule.
        LONGEST_LAG: f64 = 0.5, "s", 0.0..=2.0, "docs/locomotion.md#recovery";
    }
}

/// Flight phases.
pub mod flight {
    crate::params::params! {
        /// A flight is announced to the controller this long before it begins.
        ANNOUNCED: f64 = 0.2, "s", 0.1..=0.5, "docs/locomotion.md#runs";
        /// A body that is to jump from a stand leans for so long before take-off.
        LEANING_TIME: f64 = 0.6, "s", 0.2..=1.0, "docs/locomotion.md#runs";
        /// Least rate of a plan in the air.
        SLOWEST_RATE: f64 = 0.5, "1", 0.2..=1.0, "docs/locomotion.md#runs";
        /// Feet that leave the floor within this time of each other jump.
        JUMP_INTERVAL: f64 = 0.1, "s", 0.0..=0.3, "docs/locomotion.md#runs";
        /// Longest flight.
        LONGEST: f64 = 1.0, "s", 0.5..=2.0, "docs/locomotion.md#runs";
        /// Least gravity with which a time of fall is predicted.
        LEAST_GRAVITY: f64 = 1.0, "m/s²", 0.1..=5.0, "numerical";
        /// Shortest time of fall that is divided by.
        LEAST_FALL_TIME: f64 = 1e-3, "s", 1e-6..=1e-2, "numerical";
    }
}

/// The capture point and the displacement of planned footholds.
pub mod capture {
    crate::params::params! {
        /// Gain `k` of the zero-moment point `p = p_ref + (1 + k) e`.
        GAIN: f64 = 1.0, "1", 0.0..=3.0, "docs/locomotion.md#capture-point";
        /// Largest displacement of a foothold along its heading.
        REACH_ALONG: f64 = 0.30, "m", 0.1..=0.6, "docs/locomotion.md#capture-point";
        /// Largest displacement of a foothold across its heading, and of one that lands early against its stride.
        REACH_ACROSS: f64 = 0.60, "m", 0.1..=0.8, "docs/locomotion.md#capture-point";
        /// Least distance to the side from the stance foot, unless the plan comes closer or crosses, or the foothold is
        /// displaced to the side by more than this.
        SEPARATION: f64 = 0.03, "m", 0.0..=0.1, "docs/locomotion.md#capture-point";
        /// How much closer it may then come, for each metre beyond that.
        CROSSING_GAIN: f64 = 4.0, "1", 0.0..=10.0, "docs/locomotion.md#capture-point";
        /// How far across at most: most pushes to the side cannot be caught otherwise.
        CROSSING_MOST: f64 = 0.5, "m", 0.0..=0.6, "docs/locomotion.md#capture-point";
        /// Time constant with which a foothold follows the capture point.
        SMOOTHING_TIME: f64 = 0.015, "s", 0.0..=0.1, "docs/locomotion.md#capture-point";
        /// Angular momentum beyond the motion's with which a standing body moves with a push as a stepping one does;
        /// with a fifth of it, it does not yet.
        YIELDED: f64 = 5.0, "N·m·s", 1.0..=20.0, "docs/locomotion.md#capture-point";
        /// Largest displacement of the zero-moment point by planned angular momentum.
        MOMENT_OFFSET: f64 = 0.05, "m", 0.0..=0.1, "docs/locomotion.md#balance";
        /// Least acceleration of the floor's force that the pendulum is computed with.
        LEAST_LOAD: f64 = 3.0, "m/s²", 1.0..=6.0, "numerical";
        /// Least height of the pendulum.
        LEAST_HEIGHT: f64 = 0.1, "m", 0.05..=0.3, "numerical";
        /// The pendulum predicts no further ahead than this.
        LONGEST_FORECAST: f64 = 1.0, "s", 0.5..=2.0, "numerical";
    }
}

/// Swinging feet.
pub mod swing {
    crate::params::params! {
        /// Time over which a lifting foot gives up its offset from the plan.
        RELEASE_TIME: f64 = 0.25, "s", 0.1..=0.5, "docs/locomotion.md#contact";
        /// Share of a swing in which the foot is led to its displaced foothold.
        SHIFT_SHARE: f64 = 0.9, "1", 0.5..=1.0, "docs/locomotion.md#contact";
        /// Shortest swing that the displacement is spread over.
        SHORTEST: f64 = 0.1, "s", 0.05..=0.2, "numerical";
        /// Least height of a swinging sole.
        CLEARANCE: f64 = 0.03, "m", 0.0..=0.06, "docs/locomotion.md#contact";
        /// Speed at which that height is reached and given up.
        CLEARANCE_SPEED: f64 = 0.35, "m/s", 0.1..=1.0, "docs/locomotion.md#contact";
        /// Share of its distance from the place without anchor by which a foothold is pulled back to that.
        RETURN_SHARE: f64 = 0.3, "1", 0.0..=1.0, "docs/locomotion.md#contact";
        /// Longest such pull. The foothold is off the capture point by as much, which one foot must hold against to its
        /// side; with 0.04 m a body that was pushed drifts on.
        RETURN_MOST: f64 = 0.015, "m", 0.0..=0.04, "docs/locomotion.md#contact";
    }
}

/// The leg that stands as an obstacle to the one that swings.
pub mod leg_collision {
    crate::params::params! {
        /// Least distance of two ankles side by side in a swing.
        SWING_DISTANCE: f64 = 0.09, "m", 0.05..=0.15, "docs/locomotion.md#recovery";
        /// The same of a foothold. Feet that stand may be nearer to each other than legs that move.
        FOOTHOLD_DISTANCE: f64 = 0.08, "m", 0.05..=0.15, "docs/locomotion.md#recovery";
        /// A foothold across lies this far before or behind the other ankle.
        CROSSED_LENGTH: f64 = 0.16, "m", 0.1..=0.25, "docs/locomotion.md#recovery";
        /// And by this more for each metre that it is across.
        CROSSED_SLANT: f64 = 0.4, "1", 0.0..=1.0, "docs/locomotion.md#recovery";
        /// Rear end of the strip in which a swinging ankle does not cross: a raised knee makes room behind it.
        STRIP_REAR: f64 = -0.6, "m", -1.0..=0.0, "docs/locomotion.md#recovery";
        /// Front end of that strip: a knee that swings forward is far before its ankle.
        STRIP_FRONT: f64 = -0.02, "m", -0.2..=0.2, "docs/locomotion.md#recovery";
        /// Length that a foot which crosses behind needs for each metre across.
        SLANT_REAR: f64 = 0.7, "1", 0.1..=2.0, "docs/locomotion.md#recovery";
        /// Length that a foot which crosses before needs for each metre across.
        SLANT_FRONT: f64 = 0.15, "1", 0.05..=2.0, "docs/locomotion.md#recovery";
        /// Radius with which the corners of the strip are rounded.
        ROUNDING: f64 = 0.01, "m", 0.0..=0.05, "numerical";
        /// A foot lags behind its target by this time.
        FOOT_LAG: f64 = 0.03, "s", 0.0..=0.1, "docs/locomotion.md#recovery";
        /// A foot displaced across by this much begins to be led around the stance leg.
        AVOIDED_FROM: f64 = 0.06, "m", 0.0..=0.2, "docs/locomotion.md#recovery";
        /// One displaced by this much is led around it wholly.
        AVOIDED_FULLY: f64 = 0.12, "m", 0.0..=0.3, "docs/locomotion.md#recovery";
        /// A foot that is displaced little may come closer to the stance leg than the clip has it by this much.
        SPARE: f64 = 0.03, "m", 0.0..=0.1, "docs/locomotion.md#recovery";
        /// Time in which a foot that lifts off too near to the stance leg gets out of its way.
        CLEARING_TIME: f64 = 0.2, "s", 0.05..=0.5, "docs/locomotion.md#recovery";
    }
}

/// Time and place of the next step, chosen together.
pub mod step_timing {
    crate::params::params! {
        /// A capture point nearer to the plan's than this leaves the time of the step as it is: undisturbed clips are.
        ERROR: f64 = 0.2, "m", 0.05..=0.3, "docs/locomotion.md#step-timing";
        /// Number of intervals between the planned rate and the fastest one.
        RATES: u32 = 8, "1", 2..=32, "docs/locomotion.md#step-timing";
        /// Nothing is changed any more in less than this before a landing.
        LATEST_DECISION: f64 = 0.08, "s", 0.0..=0.2, "docs/locomotion.md#step-timing";
        /// Nothing is decided about a landing further ahead: the pendulum does not predict it.
        EARLIEST_DECISION: f64 = 0.7, "s", 0.3..=1.0, "docs/locomotion.md#step-timing";
        /// Mean speed at which a foot gets to a new foothold.
        FOOT_SPEED: f64 = 5.0, "m/s", 2.0..=8.0, "docs/locomotion.md#step-timing";
        /// Cost of a doubled rate, in metres of error that is left. Small: to land late lets the error grow.
        HURRY: f64 = 0.01, "m", 0.0..=0.3, "docs/locomotion.md#step-timing";
        /// Cost of each metre of displacement, in metres of error that is left.
        EFFORT: f64 = 0.1, "1", 0.0..=1.0, "docs/locomotion.md#step-timing";
    }
}

/// Steps that no plan has.
pub mod recovery {
    crate::params::params! {
        /// A capture point this far outside the support asks for a step: arms and trunk bring back what is less.
        LOST_MARGIN: f64 = 0.02, "m", 0.0..=0.1, "docs/locomotion.md#recovery";
        /// Beyond this distance no step helps.
        HOPELESS_MARGIN: f64 = 0.6, "m", 0.3..=1.0, "docs/locomotion.md#recovery";
        /// A capture point this far from where the clip has it is not meant to be there; with less, misplaced feet can
        /// be brought back.
        ASTRAY: f64 = 0.06, "m", 0.02..=0.15, "docs/locomotion.md#recovery";
        /// Length of a recovery step. People take 0.15–0.3 s after a push; with 0.35 s a push to the side is lost
        /// before the foot lands.
        STEP_TIME: f64 = 0.25, "s", 0.15..=0.5, "docs/locomotion.md#recovery";
        /// Length of a step with a raised foot, whose way to the floor is longer.
        RAISED_STEP_TIME: f64 = 0.35, "s", 0.15..=0.6, "docs/locomotion.md#one-foot";
        /// Length of a step that brings a foot back to its place; nothing hurries it.
        RETURN_STEP_TIME: f64 = 0.5, "s", 0.2..=1.0, "docs/locomotion.md#recovery";
        /// Share of the time and of the way of a swing before which a touch is not a landing: toes still roll off.
        LANDS_AFTER: f64 = 0.5, "1", 0.2..=0.9, "docs/locomotion.md#recovery";
        /// A raised foot whose ankle is this much higher than on the floor has not landed if its toes touch.
        HANGING_HEIGHT: f64 = 0.04, "m", 0.01..=0.1, "docs/locomotion.md#one-foot";
        /// Height of the ankle's arc.
        ARC_HEIGHT: f64 = 0.07, "m", 0.03..=0.15, "docs/locomotion.md#recovery";
        /// Longest step forward, in leg lengths.
        FARTHEST_FORWARD: f64 = 0.75, "1", 0.4..=1.0, "docs/locomotion.md#recovery";
        /// Longest step backward, in leg lengths.
        FARTHEST_BACKWARD: f64 = 0.65, "1", 0.4..=1.0, "docs/locomotion.md#recovery";
        /// Longest step to the foot's own side, in leg lengths.
        FARTHEST_ASIDE: f64 = 0.6, "1", 0.3..=1.0, "docs/locomotion.md#recovery";
        /// Longest step across the stance foot, in leg lengths.
        FARTHEST_ACROSS: f64 = 0.35, "1", 0.2..=0.6, "docs/locomotion.md#recovery";
        /// Touch-downs with which a motion starts. While it does, a step that catches the body may replace a planned
        /// one.
        STARTING_STEPS: u32 = 5, "steps", 0..=8, "docs/locomotion.md#recovery";
        /// A foot that crosses lands this far before or behind the other. More than a planned foothold across needs,
        /// because a recovery step lands less precisely.
        CROSSED_LENGTH: f64 = 0.18, "m", 0.1..=0.3, "docs/locomotion.md#recovery";
        /// Closer to the stance foot than this counts as crossing. More than planned footholds keep, because a recovery
        /// step lands less precisely.
        FOOTHOLD_DISTANCE: f64 = 0.1, "m", 0.05..=0.2, "docs/locomotion.md#recovery";
        /// A capture point this far on the other side of the stance foot is beyond its sole.
        SOLE_HALF_WIDTH: f64 = 0.03, "m", 0.01..=0.06, "docs/locomotion.md#one-foot";
        /// A raised foot that crosses lands this much beyond the capture point.
        BEYOND: f64 = 0.12, "m", 0.0..=0.2, "docs/locomotion.md#one-foot";
        /// Width of a stance on both feet, in leg lengths.
        STANCE_WIDTH: f64 = 0.18, "1", 0.1..=0.3, "docs/locomotion.md#one-foot";
        /// Speed at which the body is moved over one foot.
        SHIFT_SPEED: f64 = 0.25, "m/s", 0.05..=0.5, "docs/locomotion.md#recovery";
        /// A shift of the body shorter than this is over.
        SHIFT_DONE: f64 = 1e-3, "m", 1e-6..=1e-2, "numerical";
    }
}

/// Loss of balance in a long stance on one foot.
pub mod support_recovery {
    crate::params::params! {
        /// The capture point is off its planned place by more than this. It grows threefold while a foot comes down.
        ERROR: f64 = 0.045, "m", 0.02..=0.1, "docs/locomotion.md#one-foot";
        /// And outside the sole by more than this.
        OUTSIDE: f64 = 0.005, "m", 0.0..=0.03, "docs/locomotion.md#one-foot";
        /// A disturbance that passes within this time is a jolt: a heel that comes down, a leg that is braked.
        PASSING_TIME: f64 = 0.09, "s", 0.0..=0.3, "docs/locomotion.md#one-foot";
        /// A planned step that is nearer than this is made instead.
        PLANNED_STEP_TIME: f64 = 0.6, "s", 0.3..=1.0, "docs/locomotion.md#one-foot";
        /// A planned step that would leave more than this of the error does not catch the body. A recovery step by the
        /// foot that carries everything counts as worse by as much.
        PLANNED_STEP_ERROR: f64 = 0.1, "m", 0.03..=0.3, "docs/locomotion.md#one-foot";
        /// Time in which a plan that is held stops, and in which it starts again.
        SLOWING_TIME: f64 = 0.2, "s", 0.05..=0.5, "docs/locomotion.md#one-foot";
        /// Least pace at which the plan's velocity at full pace is computed from its present one.
        OBSERVED_PACE: f64 = 0.1, "1", 0.01..=0.5, "numerical";
        /// The foot is lifted again after this time, whether the body is back or not.
        LONGEST: f64 = 3.0, "s", 1.0..=10.0, "docs/locomotion.md#one-foot";
        /// A stream, which does not wait, lifts it this long before it lands.
        STREAM_LIFTS: f64 = 0.4, "s", 0.2..=1.0, "docs/locomotion.md#streams";
    }
}

/// Stances of a clip or a stream.
pub mod step_plan {
    crate::params::params! {
        /// A foot this close to the floor carries the body if no other does.
        NEAR_FLOOR: f64 = 0.03, "m", 0.01..=0.1, "docs/locomotion.md#contact";
        /// A body falls while the floor would give less than this share of its weight.
        FALLING_LOAD: f64 = 0.5, "1", 0.1..=0.9, "docs/locomotion.md#runs";
        /// Samples on either side that the load of one is computed from: second differences over five samples.
        LOAD_SAMPLES: usize = 3, "samples", 2..=5, "derivation";
        /// Feet pause that have stood together for so long, longer than in any stride.
        PAUSE_BEFORE: f64 = 0.2, "s", 0.1..=0.5, "docs/locomotion.md#recovery";
        /// And will stand for so long: that leaves time for a step that no plan has.
        PAUSE_AFTER: f64 = 0.1, "s", 0.05..=0.5, "docs/locomotion.md#recovery";
        /// A stream rests that has stood on both feet for so long. Longer than of a clip: its steps are known late.
        STREAM_REST_BEFORE: f64 = 0.5, "s", 0.1..=1.0, "docs/locomotion.md#streams";
        /// And will stand for so long.
        STREAM_REST_AFTER: f64 = 0.25, "s", 0.05..=0.5, "docs/locomotion.md#streams";
    }
}

/// All groups with their names.
pub fn groups() -> [(&'static str, &'static [Param]); 11] {
    [
        ("common", common::ALL),
        ("world_map", world_map::ALL),
        ("contact", contact::ALL),
        ("flight", flight::ALL),
        ("capture", capture::ALL),
        ("swing", swing::ALL),
        ("leg_collision", leg_collision::ALL),
        ("step_timing", step_timing::ALL),
        ("recovery", recovery::ALL),
        ("support_recovery", support_recovery::ALL),
        ("step_plan", step_plan::ALL),
    ]
}
