//! Every tunable number of the plans, grouped by subject.
//!
//! Names that begin with `STREAM_` belong to the preparation of streams where it differs from that of clips.

use crate::params::Param;

/// Contacts of the feet with the floor, and whether a body is on its feet at all.
pub mod contact {
    crate::params::params! {
        /// A point of a foot comes to the floor below this speed.
        SPEED_ON: f64 = 0.45, "m/s", 0.1..=1.0, "docs/locomotion.md#contact";
        /// A point that is on the floor leaves it above this speed.
        SPEED_OFF: f64 = 0.55, "m/s", 0.1..=1.5, "docs/locomotion.md#contact";
        /// A point comes to the floor below this height over its own lowest level.
        HEIGHT_ON: f64 = 0.06, "m", 0.01..=0.1, "docs/locomotion.md#contact";
        /// `HEIGHT_ON` of a stream, whose lowest level is known less well.
        STREAM_HEIGHT_ON: f64 = 0.05, "m", 0.01..=0.1, "docs/locomotion.md#streams";
        /// A point that is on the floor leaves it above this height over its own lowest level.
        HEIGHT_OFF: f64 = 0.07, "m", 0.01..=0.15, "docs/locomotion.md#contact";
        /// Cut-off before speeds are formed: it takes out marker noise and leaves touch-down sharp.
        CUTOFF: f64 = 15.0, "Hz", 6.0..=30.0, "docs/locomotion.md#contact";
        /// Share of the samples that lie below the lowest level of a point.
        LEVEL_SHARE: f64 = 0.005, "1", 0..=0.05, "docs/locomotion.md#contact";
        /// Gaps and touches that are shorter are noise, and so is a flight in which a motion ends.
        SHORTEST: f64 = 0.08, "s", 0.02..=0.2, "docs/locomotion.md#contact";
        /// Both feet off the floor for less than this is no flight.
        SHORTEST_FLIGHT: f64 = 0.06, "s", 0.02..=0.15, "docs/locomotion.md#contact";
        /// Both feet off the floor for no more than this is no flight in a stream.
        STREAM_SHORTEST_FLIGHT: i64 = 5, "samples", 1..=10, "docs/locomotion.md#streams";
        /// A foot of a stream changes its label once it has been on the floor, or off it, for so long.
        STREAM_STEADY: i64 = 3, "samples", 1..=10, "docs/locomotion.md#streams";
        /// Speed with which the lowest level of a point in a stream rises when nothing touches it.
        LEVEL_RISE: f64 = 0.01, "m/s", 0..=0.1, "docs/locomotion.md#streams";
        /// Largest distance of that level from where the sole of the body has it.
        LEVEL_OFFSET: f64 = 0.06, "m", 0..=0.2, "docs/locomotion.md#streams";
        /// A sole of a prepared motion that is lower than this, and slow, is on the floor.
        PREPARED_HEIGHT: f64 = 0.015, "m", 0..=0.05, "docs/locomotion.md#transitions";
        /// A sole of a prepared motion that is slower than this, and low, is on the floor.
        PREPARED_SPEED: f64 = 0.3, "m/s", 0.05..=0.6, "docs/locomotion.md#transitions";
        /// Pitch of a foot that stands on its toes, at most; toe-up is positive.
        LEAST_PITCH: f64 = -1.05, "rad", -1.4..=-0.5, "docs/locomotion.md#foot-lock";
        /// Pitch of a foot on its heel, and roll, beyond which it does not stand on its sole.
        MOST_TILT: f64 = 0.6, "rad", 0.3..=1.0, "docs/locomotion.md#foot-lock";
        /// A foot of a stream lands only below this share of the steepest pitch and roll.
        LANDING_STEEPNESS: f64 = 0.8, "1", 0.5..=1.0, "docs/locomotion.md#streams";
        /// A foot of a stream that leaves the floor may be too steep for so long.
        LEAVING_TIME: i64 = 12, "samples", 1..=30, "docs/locomotion.md#streams";
        /// Shortest stance and shortest flight where the load on the floor or a preparation tells them: both are
        /// steadier than labels by speed.
        SHORTEST_TOLD: f64 = 0.05, "s", 0.02..=0.1, "docs/locomotion.md#contact";
    }
}

/// Conclusions from the height of the pelvis, as a share of its height in a stand.
pub mod pelvis {
    crate::params::params! {
        /// Below it a body sits or lies on the floor: no foot is locked.
        LYING: f64 = 0.22, "1", 0.1..=0.4, "docs/locomotion.md#contact";
        /// Below it a body is not carried by its feet.
        SEATED: f64 = 0.45, "1", 0.3..=0.6, "docs/locomotion.md#contact";
        /// Below it a body may be on a seat.
        SEAT: f64 = 0.65, "1", 0.4..=0.8, "docs/locomotion.md#balance";
        /// Below it a body does not walk.
        UPRIGHT: f64 = 0.75, "1", 0.5..=0.95, "docs/locomotion.md#stops";
        /// Above it a body is not on a seat.
        NO_SEAT: f64 = 0.8, "1", 0.6..=1.0, "docs/locomotion.md#balance";
    }
}

/// Numbers that plans and tracking share.
pub mod common {
    crate::params::params! {
        /// A body that is slower over the floor is at rest.
        REST_SPEED: f64 = 0.1, "m/s", 0.02..=0.3, "docs/locomotion.md#stops";
        /// A foot farther than this from where it belongs is misplaced.
        MISPLACED_BY: f64 = 0.04, "m", 0.02..=0.1, "docs/locomotion.md#recovery";
        /// The same of its heading.
        MISPLACED_TURN: f64 = 0.2, "rad", 0.05..=0.5, "docs/locomotion.md#recovery";
        /// Distance of the middle of the sole before the ankle.
        SOLE_MIDDLE: f64 = 0.05, "m", 0.02..=0.1, "docs/locomotion.md#recovery";
        /// The zero-moment point of a body that corrects an error stays this far inside the support.
        ZMP_INSET: f64 = 0.01, "m", 0..=0.03, "docs/locomotion.md#balance";
    }
}

/// Places and durations of stances.
pub mod stance {
    crate::params::params! {
        /// A recorded foot that strays further from its place has stepped.
        STRAY_DISTANCE: f64 = 0.06, "m", 0.02..=0.15, "docs/locomotion.md#foot-lock";
        /// A recorded foot that turns further from its heading has pivoted.
        STRAY_ANGLE: f64 = 0.40, "rad", 0.1..=0.8, "docs/locomotion.md#foot-lock";
        /// Part of a stance at either end that does not decide on its place.
        PLACE_MARGIN: usize = 15, "%", 0..=40, "docs/locomotion.md#foot-lock";
        /// Inverse of the share of a stance, at either end, that may stray without splitting it.
        SPLIT_MARGIN: usize = 12, "1", 4..=50, "docs/locomotion.md#foot-lock";
        /// Half of the time that a shuffle is given; the first of three that fits.
        HALF_SHUFFLE: f64 = 0.14, "s", 0.08..=0.3, "docs/locomotion.md#foot-lock";
        /// The second of these three.
        HALF_QUICK_SHUFFLE: f64 = 0.11, "s", 0.06..=0.2, "docs/locomotion.md#foot-lock";
        /// The third of these three.
        HALF_QUICKEST_SHUFFLE: f64 = 0.08, "s", 0.05..=0.15, "docs/locomotion.md#foot-lock";
        /// Least way of a shuffle, in units of the stray distance and angle.
        LEAST_SHUFFLE: f64 = 0.25, "1", 0.05..=1.0, "docs/locomotion.md#foot-lock";
        /// A foot stands at least so long beside one that has just landed; one that has just left has not left.
        OVERLAP: f64 = 0.04, "s", 0..=0.15, "docs/locomotion.md#foot-lock";
        /// `OVERLAP` of a stream.
        STREAM_OVERLAP: i64 = 4, "samples", 0..=9, "docs/locomotion.md#streams";
        /// Inverse of the share of a stance that may be trimmed at either end.
        TRIM_SHARE: usize = 8, "1", 4..=50, "docs/locomotion.md#foot-lock";
        /// Longest time that is trimmed from an end of a stance.
        TRIM_TIME: f64 = 0.15, "s", 0..=0.4, "docs/locomotion.md#foot-lock";
        /// Samples are trimmed if they stray further than this, in units of the stray distance and angle.
        TRIM_STRAY: f64 = 0.4, "1", 0.1..=1.0, "docs/locomotion.md#foot-lock";
        /// Largest stray of the samples left after trimming, in the same units.
        STEADY_STRAY: f64 = 0.6, "1", 0.1..=1.0, "docs/locomotion.md#foot-lock";
        /// Shortest stance that a split or a longer swing leaves.
        SHORTEST: f64 = 0.15, "s", 0.05..=0.3, "docs/locomotion.md#foot-lock";
        /// A swing takes at least √(way / this): what recorded steps take, with few exceptions.
        SWING_ACCELERATION: f64 = 8.0, "m/s²", 4.0..=16.0, "docs/locomotion.md#foot-lock";
        /// Way that a turn by a radian counts as.
        TURN_ARM: f64 = 0.25, "m", 0.1..=0.5, "docs/locomotion.md#foot-lock";
        /// Time that a shuffle is given in a stream.
        STREAM_SHUFFLE: i64 = 12, "samples", 4..=30, "docs/locomotion.md#streams";
        /// A foot of a stream is lifted no sooner than this: the body has to come over the other one.
        STREAM_NOTICE: i64 = 18, "samples", 0..=30, "docs/locomotion.md#streams";
        /// Speed of a foot that counts half in the place of a stance.
        QUIET_SPEED: f64 = 0.1, "m/s", 0.02..=0.5, "docs/locomotion.md#streams";
        /// Samples of a stream over which a place is averaged at most.
        STREAM_AVERAGED: i64 = 30, "samples", 5..=90, "docs/locomotion.md#streams";
    }
}

/// How a planted foot is pitched.
pub mod pitch {
    crate::params::params! {
        /// A foot that is pitched by less, and toes that are turned up by less, lie flat.
        FLAT: f64 = 0.02, "rad", 0.005..=0.05, "numerical";
        /// Length of the tip of the toes, which carries when they are turned up.
        TIP_LENGTH: f64 = 0.02, "m", 0.005..=0.04, "docs/locomotion.md#runs";
        /// A foot in a stride that is pitched by less is made flat.
        DEAD_BAND: f64 = 0.07, "rad", 0..=0.2, "docs/locomotion.md#foot-lock";
        /// A foot that stands for long and is pitched by less is made flat.
        LONG_DEAD_BAND: f64 = 0.16, "rad", 0..=0.3, "docs/locomotion.md#foot-lock";
        /// A recorded foot that is pitched by less is in the flat middle of its stance.
        MIDSTANCE: f64 = 0.12, "rad", 0.05..=0.3, "docs/locomotion.md#foot-lock";
        /// A stance that is longer is standing, not walking.
        LONG_STANCE: f64 = 1.5, "s", 0.8..=3.0, "docs/locomotion.md#foot-lock";
        /// Time from which on the dead band of a stream widens, up to `LONG_STANCE`.
        STREAM_LONG_STANCE: f64 = 0.7, "s", 0.3..=1.5, "docs/locomotion.md#streams";
        /// Time after which a heel of a stream begins to come down to its sole.
        HEEL_BEGINS: f64 = 0.1, "s", 0..=0.5, "docs/locomotion.md#streams";
        /// Time after which it has.
        HEEL_ENDS: f64 = 0.2, "s", 0..=0.8, "docs/locomotion.md#streams";
        /// Most by which a standing foot rises on its toes so that its leg reaches.
        MOST_RISE: f64 = 0.7, "rad", 0.2..=1.05, "docs/locomotion.md#streams";
        /// Bisections of that rise.
        RISE_HALVINGS: usize = 12, "rounds", 6..=40, "numerical";
    }
}

/// How a foot gets from one place to the next.
pub mod swing {
    crate::params::params! {
        /// A swinging sole passes at least this high.
        CLEARANCE: f64 = 0.045, "m", 0.01..=0.1, "docs/locomotion.md#foot-lock";
        /// The same as a share of the step: a shuffle of centimetres need not rise like a stride.
        CLEARANCE_SHARE: f64 = 0.12, "1", 0.05..=0.3, "docs/locomotion.md#foot-lock";
        /// Least clearance.
        LEAST_CLEARANCE: f64 = 0.015, "m", 0.005..=0.03, "docs/locomotion.md#foot-lock";
        /// Least speed with which a sole rises after lift-off.
        RISE_SPEED: f64 = 0.45, "m/s", 0.1..=1.0, "docs/locomotion.md#foot-lock";
        /// Least speed with which a sole sinks before touch-down.
        SINK_SPEED: f64 = 0.4, "m/s", 0.1..=1.0, "docs/locomotion.md#foot-lock";
        /// Time after lift-off and before touch-down over which clearance comes in: a jump of it jerks the leg.
        LIFT_TIME: f64 = 0.06, "s", 0.02..=0.15, "docs/locomotion.md#foot-lock";
        /// Cut-off of corrections of height, of feet and of the pelvis.
        HEIGHT_CUTOFF: f64 = 10.0, "Hz", 4.0..=20.0, "docs/locomotion.md#foot-lock";
        /// Largest toe extension.
        MOST_TOE: f64 = 0.6, "rad", 0.2..=1.0, "docs/locomotion.md#foot-lock";
        /// Longest time over which a swing departs from the place it leaves.
        DEPARTURE: f64 = 0.3, "s", 0.1..=0.6, "docs/locomotion.md#foot-lock";
        /// Time over which a swing of a stream departs while its next place is not known.
        STREAM_DEPARTURE: f64 = 0.4, "s", 0.1..=0.6, "docs/locomotion.md#streams";
        /// Most by which the offset grows before or after a flight: a leg that trails its foot by more stretches.
        MOST_GROWTH: f64 = 0.015, "m", 0.005..=0.05, "docs/locomotion.md#runs";
        /// Shortest time over which it fades then.
        LEAST_DEPARTURE: f64 = 0.05, "s", 0.02..=0.2, "docs/locomotion.md#runs";
        /// Cut-off of joints that were clamped, of swinging legs, and of the pitch of standing feet.
        JOINT_CUTOFF: f64 = 8.0, "Hz", 4.0..=15.0, "docs/locomotion.md#foot-lock";
        /// Time over which the smoothing of a swinging leg comes in and goes out.
        JOINT_EDGE: f64 = 0.08, "s", 0.02..=0.2, "docs/locomotion.md#foot-lock";
        /// Time after take-off in which feet come to follow the pelvis, and before landing in which they cease to.
        FLIGHT_EDGE: f64 = 0.1, "s", 0.02..=0.2, "docs/locomotion.md#runs";
    }
}

/// The support that one foot can give alone: the zero-moment points for which its ankle is strong enough.
pub mod ankle {
    crate::params::params! {
        /// Share of its strength that an ankle gives at the edge of the support.
        STRENGTH_SHARE: f64 = 0.87, "1", 0.5..=1.0, "docs/locomotion.md#one-foot";
        /// Below this speed a body stays over the foot until an error has grown.
        SLOW: f64 = 0.8, "m/s", 0.3..=1.2, "docs/locomotion.md#one-foot";
        /// Above this speed a body is past the foot before an error has grown.
        FAST: f64 = 1.2, "m/s", 0.8..=2.0, "docs/locomotion.md#one-foot";
        /// The support is longer by this share above `FAST`.
        FAST_EXTENSION: f64 = 0.4, "1", 0..=1.0, "docs/locomotion.md#one-foot";
        /// Least share of the sole before the ankle that is used: a weaker calf goes with weaker knees and hips.
        LEAST_SOLE: f64 = 0.61, "1", 0.3..=0.9, "docs/locomotion.md#one-foot";
        /// Support before the toe joint of a foot whose heel is up, whatever the ankle holds.
        BALL: f64 = 0.015, "m", 0..=0.04, "docs/locomotion.md#one-foot";
        /// A foot of a run that carries a smaller share of the weight is as strong as one that carries this.
        LEAST_LOAD: f64 = 0.5, "1", 0.1..=1.0, "docs/locomotion.md#runs";
        /// Most by which the support is moved against the lean of the body.
        MOST_MOVED: f64 = 0.03, "m", 0..=0.06, "docs/locomotion.md#one-foot";
        /// Time over which the speed of the body over its foot is taken.
        SPEED_TIME: f64 = 0.2, "s", 0.05..=0.5, "docs/locomotion.md#one-foot";
        /// Cut-off of the lean of a body over its foot.
        LEAN_CUTOFF: f64 = 4.0, "Hz", 1.0..=10.0, "docs/locomotion.md#one-foot";
    }
}

/// Limits for the zero-moment point, and how the pelvis moves to keep them.
pub mod balance {
    crate::params::params! {
        /// Ground force over weight below which the zero-moment point says nothing.
        LEAST_LOAD: f64 = 0.25, "1", 0.05..=0.5, "docs/locomotion.md#balance";
        /// Least height of the centre of mass that a pendulum is formed with.
        LEAST_HEIGHT: f64 = 0.2, "m", 0.05..=0.4, "numerical";
        /// Least square of the pendulum frequency.
        LEAST_OMEGA2: f64 = 3.0, "1/s²", 0.5..=8.0, "numerical";
        /// Largest square of the pendulum frequency.
        MOST_OMEGA2: f64 = 40.0, "1/s²", 15.0..=100.0, "numerical";
        /// The pelvis moves by this factor further than the centre of mass, because the feet stay.
        PELVIS_LEAD: f64 = 1.15, "1", 1.0..=1.4, "docs/locomotion.md#balance";
        /// A zero-moment point this far outside costs as much as a shift of one metre.
        OUTSIDE_COST: f64 = 0.1, "m", 0.02..=0.5, "docs/locomotion.md#balance";
        /// Time below which a shift does not change.
        BEND_TIME: f64 = 0.08, "s", 0.02..=0.3, "docs/locomotion.md#balance";
        /// Price of bending the path of a body in flight, against that of a zero-moment point outside.
        FLIGHT_PRICE: f64 = 1.0, "s⁴", 0.01..=100, "docs/locomotion.md#runs";
        /// Distance inside the support polygon at which the zero-moment point is kept.
        INSET: f64 = 0.04, "m", 0..=0.06, "docs/locomotion.md#balance";
        /// The same of runs, whose ankles limit it anyway.
        RUN_INSET: f64 = 0.02, "m", 0..=0.06, "docs/locomotion.md#runs";
        /// Outside by more than this for long, something other than the feet carries the body.
        OTHER_SUPPORT: f64 = 0.15, "m", 0.05..=0.4, "docs/locomotion.md#balance";
        /// The correction of what is outside for long begins to go at this share of `OTHER_SUPPORT`.
        OTHER_SUPPORT_BEGINS: f64 = 0.7, "1", 0.3..=1.0, "docs/locomotion.md#balance";
        /// It is gone after this share more.
        OTHER_SUPPORT_RANGE: f64 = 0.6, "1", 0.1..=1.0, "docs/locomotion.md#balance";
        /// Cut-off of how far it is outside for long.
        LASTING_CUTOFF: f64 = 0.5, "Hz", 0.1..=2.0, "docs/locomotion.md#balance";
        /// Largest distance outside that is corrected.
        MOST_OUTSIDE: f64 = 0.4, "m", 0.1..=1.0, "docs/locomotion.md#balance";
        /// `MOST_OUTSIDE` of a stream.
        STREAM_MOST_OUTSIDE: f64 = 0.3, "m", 0.1..=1.0, "docs/locomotion.md#streams";
        /// Largest shift of the pelvis.
        MOST_SHIFT: f64 = 0.2, "m", 0.05..=0.4, "docs/locomotion.md#balance";
        /// Largest shift of the centre of mass in a stream.
        STREAM_MOST_SHIFT: f64 = 0.12, "m", 0.05..=0.4, "docs/locomotion.md#streams";
        /// Rounds of shifting the pelvis and solving the legs.
        ROUNDS: usize = 8, "rounds", 1..=20, "docs/locomotion.md#balance";
        /// The same of what joins two motions, which are prepared already.
        SEAM_ROUNDS: usize = 4, "rounds", 1..=20, "docs/locomotion.md#transitions";
        /// Rounds before the last from which on feet that their legs do not reach no longer carry.
        REACH_ROUND: usize = 5, "rounds", 1..=8, "docs/locomotion.md#balance";
        /// Most alternations between the trajectory and the polygons.
        ALTERNATIONS: usize = 150, "rounds", 20..=1000, "numerical";
        /// Change between two alternations that ends them.
        SETTLED: f64 = 1e-6, "m", 1e-9..=1e-3, "numerical";
        /// Alternations per sample of a stream, which go on from those of the sample before.
        STREAM_ALTERNATIONS: usize = 8, "rounds", 1..=50, "docs/locomotion.md#streams";
        /// Alternations of the first sample of a stream.
        STREAM_FIRST_ALTERNATIONS: usize = 200, "rounds", 20..=1000, "numerical";
        /// Price of leaving a shift that is put out already.
        STREAM_FIXED_PRICE: f64 = 1e15, "1", 1e9..=1e18, "numerical";
        /// Time over which the usual distance outside is averaged.
        STREAM_USUAL_TIME: f64 = 1.0, "s", 0.3..=3.0, "docs/locomotion.md#streams";
        /// Time over which the present distance outside is averaged.
        STREAM_NOW_TIME: f64 = 0.05, "s", 0.02..=0.3, "docs/locomotion.md#streams";
        /// Share of the present in what is expected beyond the window; the rest is as usual.
        STREAM_NOW_SHARE: f64 = 0.3, "1", 0..=1.0, "docs/locomotion.md#streams";
        /// Feet that stay for so long before and after a moment do not step: hands may carry.
        STAYS: f64 = 0.5, "s", 0.2..=2.0, "docs/locomotion.md#balance";
        /// Cut-off of how much seat and hands may carry.
        OTHER_CUTOFF: f64 = 2.0, "Hz", 0.5..=6.0, "docs/locomotion.md#balance";
    }
}

/// Legs that reach their feet within the limits of their joints, and how the pelvis moves for that.
pub mod leg {
    crate::params::params! {
        /// A planted leg reaches at most this share of its length: a straight knee makes inverse kinematics jump.
        REACH: f64 = 0.98, "1", 0.9..=0.999, "docs/locomotion.md#foot-lock";
        /// The same where two motions are joined, of which each is within `REACH`.
        SEAM_REACH: f64 = 0.99, "1", 0.9..=0.999, "docs/locomotion.md#transitions";
        /// A swinging leg reaches at most this share of its length.
        SWING_REACH: f64 = 0.995, "1", 0.9..=0.999, "docs/locomotion.md#foot-lock";
        /// Most by which the pelvis is lowered for a swinging leg.
        SWING_DROP: f64 = 0.04, "m", 0..=0.1, "docs/locomotion.md#foot-lock";
        /// Least square of the height of a hip over its ankle, over the square of the reach.
        LEAST_HEIGHT2: f64 = 0.04, "1", 0.01..=0.2, "numerical";
        /// The pelvis is not lowered for a swinging leg whose foot is this share of the reach away along the floor.
        SWING_FAR: f64 = 0.6, "1", 0.3..=0.9, "docs/locomotion.md#foot-lock";
        /// Share of the reach before that over which the lowering goes.
        SWING_FAR_RANGE: f64 = 0.15, "1", 0.05..=0.5, "docs/locomotion.md#foot-lock";
        /// Time over which the height of the pelvis changes.
        DROP_TIME: f64 = 0.15, "s", 0.05..=0.4, "docs/locomotion.md#foot-lock";
        /// Weight of a sample above the ceiling of a curve against one of the curve itself.
        CEILING_STIFFNESS: f64 = 1e4, "1", 1e2..=1e7, "numerical";
        /// Most rounds of finding the samples that the ceiling holds down; 5 to 20 are typical.
        CEILING_ROUNDS: usize = 60, "rounds", 20..=500, "numerical";
        /// Angles are kept this far from the limits of the joints; half of it after the last change.
        LIMIT_MARGIN: f64 = 0.01, "rad", 0..=0.05, "docs/locomotion.md#foot-lock";
        /// Ankles and hips of planted feet are brought this far inside their limits.
        PLANTED_MARGIN: f64 = 0.03, "rad", 0..=0.1, "docs/locomotion.md#foot-lock";
        /// An excess over a limit that is smaller is the margin, not the motion.
        NOTED_EXCESS: f64 = 0.002, "rad", 0..=0.01, "numerical";
        /// A planted foot that its leg cannot hold to this accuracy is declared free.
        HELD: f64 = 5e-4, "m", 1e-5..=0.01, "docs/locomotion.md#foot-lock";
        /// The same where a motion is stopped or begun, and of a foot that ceases to carry while the other one does.
        SEAM_HELD: f64 = 0.01, "m", 1e-4..=0.03, "docs/locomotion.md#stops";
        /// A free foot may be this deep in the floor.
        DEEP: f64 = 0.01, "m", 0..=0.03, "docs/locomotion.md#foot-lock";
        /// A leg is solved again for its height at most so often.
        SOLVES: usize = 8, "rounds", 2..=20, "numerical";
        /// An ankle may be lower than it should by this much before its knee is bent.
        KNEE_SLACK: f64 = 1e-3, "m", 0..=0.01, "numerical";
        /// Least height that bending the knee gives.
        KNEE_RISE: f64 = 0.05, "m/rad", 0.01..=0.2, "numerical";
        /// Most that the knee is bent by at a time.
        KNEE_STEP: f64 = 0.3, "rad", 0.05..=0.6, "numerical";
        /// Most by which the pelvis is tilted back for hips that do not flex as far as recorded.
        MOST_TILT: f64 = 0.8, "rad", 0.2..=1.2, "docs/locomotion.md#foot-lock";
        /// Rounds of asking for the tilt that hips still lack.
        TILT_ROUNDS: usize = 3, "rounds", 1..=10, "numerical";
        /// Most by which the pelvis is raised for legs that do not fold as far as recorded.
        MOST_RAISE: f64 = 0.2, "m", 0.05..=0.4, "docs/locomotion.md#foot-lock";
        /// Bisections of that raise.
        RAISE_HALVINGS: usize = 7, "rounds", 4..=30, "numerical";
        /// Time before and after for which the unloading of an ankle is held.
        UNLOAD_TIME: f64 = 0.1, "s", 0.02..=0.3, "docs/locomotion.md#foot-lock";
        /// The same in a run, whose whole stance takes 0.2 s.
        RUN_UNLOAD_TIME: f64 = 0.025, "s", 0.01..=0.1, "docs/locomotion.md#runs";
        /// Most by which a leg, or a foot, is turned to unload an ankle or a hip.
        MOST_TURN: f64 = 0.6, "rad", 0.2..=1.0, "docs/locomotion.md#foot-lock";
        /// The heading of a foot takes this factor of the rotation that its hip lacks.
        HEADING_GAIN: f64 = 1.3, "1", 1.0..=2.0, "docs/locomotion.md#foot-lock";
        /// Cut-off of the turn of a leg.
        TURN_CUTOFF: f64 = 3.0, "Hz", 1.0..=10.0, "docs/locomotion.md#foot-lock";
        /// The turn of the pelvis is held for so long before and after: the foot that lands needs it as well.
        YAW_TIME: f64 = 0.15, "s", 0.05..=0.5, "docs/locomotion.md#foot-lock";
        /// Most by which the pelvis is turned.
        MOST_YAW: f64 = 0.35, "rad", 0.1..=0.8, "docs/locomotion.md#foot-lock";
        /// A hip this far ahead of its foot lets the foot of a stream rise on its toes; one that is not ahead does not.
        STREAM_TRAILING: f64 = 0.15, "m", 0.05..=0.4, "docs/locomotion.md#streams";
        /// Most that the pelvis gives of the reach that a leg lacks then.
        STREAM_SPARED: f64 = 0.1, "m", 0..=0.2, "docs/locomotion.md#streams";
        /// The pelvis of a stream comes down so long before it has to.
        STREAM_AHEAD: i64 = 20, "samples", 0..=50, "docs/locomotion.md#streams";
        /// Speed with which a lowered pelvis of a stream comes up again.
        STREAM_RISE_SPEED: f64 = 0.01, "m/s", 0..=0.1, "docs/locomotion.md#streams";
        /// Rate with which the pelvis of a stream goes to its height.
        STREAM_DROP_RATE: f64 = 8.0, "1/s", 2.0..=20.0, "docs/locomotion.md#streams";
    }
}

/// Runs as they were recorded: flights, pushes and feet that roll off.
pub mod run {
    crate::params::params! {
        /// A motion with flights that is faster than this is a run.
        SPEED: f64 = 2.0, "m/s", 1.5..=3.0, "docs/locomotion.md#runs";
        /// Least ground force over weight of a stance.
        STANCE_LOAD: f64 = 0.45, "1", 0.1..=0.9, "docs/locomotion.md#runs";
        /// A foot that comes down faster does not stand yet.
        ARRIVAL_SPEED: f64 = 1.6, "m/s", 0.5..=3.0, "docs/locomotion.md#runs";
        /// Speed that counts as much as a metre of height in which foot stands.
        HEIGHT_SPEED: f64 = 20.0, "1/s", 5.0..=50.0, "docs/locomotion.md#runs";
        /// Share of a stance in which a leg takes up its load.
        LOADING_SHARE: f64 = 0.15, "1", 0.05..=0.4, "docs/locomotion.md#runs";
        /// Share of a stance after which it gives it up.
        UNLOADING_SHARE: f64 = 0.5, "1", 0.3..=0.9, "docs/locomotion.md#runs";
        /// Share of the load that is left at take-off: an ankle that turns fast has no strength for more.
        LAST_LOAD: f64 = 0.15, "1", 0..=0.5, "docs/locomotion.md#runs";
        /// A longer stance is none of a run.
        LONGEST_STANCE: f64 = 0.4, "s", 0.2..=0.8, "docs/locomotion.md#runs";
        /// Price of an acceleration in flight that is not that of gravity, against another one's.
        FLIGHT_PRICE: f64 = 1e3, "1", 1.0..=1e6, "docs/locomotion.md#runs";
        /// A foot rolls off where its heel is raised further than this.
        ROLL_FROM: f64 = 0.35, "rad", 0.1..=0.8, "docs/locomotion.md#runs";
        /// Least raise of the heel that is tried.
        LEAST_RAISE: f64 = 0.2, "rad", 0..=0.5, "docs/locomotion.md#runs";
        /// Step in which the heel is raised or lowered.
        HEEL_STEP: f64 = 0.04, "rad", 0.01..=0.1, "numerical";
        /// Steps that are tried either way.
        HEEL_STEPS: i32 = 10, "rounds", 2..=50, "numerical";
        /// Step in which the toes are turned up about their tip.
        TIP_STEP: f64 = 0.05, "rad", 0.01..=0.1, "numerical";
        /// Steps that are tried.
        TIP_STEPS: i32 = 12, "rounds", 2..=50, "numerical";
        /// Price of turning the foot as a whole, against the distance of its ankle.
        TURN_PRICE: f64 = 0.03, "m/rad", 0..=0.2, "docs/locomotion.md#runs";
        /// Price of turning heel or toes.
        BEND_PRICE: f64 = 0.01, "m/rad", 0..=0.2, "docs/locomotion.md#runs";
        /// Cut-off of the roll.
        ROLL_CUTOFF: f64 = 12.0, "Hz", 6.0..=20.0, "docs/locomotion.md#runs";
    }
}

/// Whether the ground can give the forces that a motion asks for.
pub mod feasibility {
    crate::params::params! {
        /// Friction that the ground is believed to have.
        FRICTION: f64 = 0.8, "1", 0.3..=1.2, "docs/locomotion.md#balance";
        /// Edges of the pyramid that stands for a friction cone.
        CONE_EDGES: usize = 8, "1", 4..=32, "numerical";
        /// Regularisation, with forces in weights.
        RIDGE: f64 = 1e-10, "1", 1e-14..=1e-6, "numerical";
    }
}

/// When two moments of motions are alike: for cycles, motions that break off in mid-step, and transitions.
pub mod likeness {
    crate::params::params! {
        /// Rates count this much against angles.
        RATE_SHARE: f64 = 0.05, "s", 0.01..=0.2, "docs/locomotion.md#transitions";
        /// Weight of the tilt of the pelvis against a joint.
        TILT_WEIGHT: f64 = 4.0, "1", 0.5..=20, "docs/locomotion.md#transitions";
        /// Weight of the height of the pelvis against a joint.
        HEIGHT_WEIGHT: f64 = 25.0, "1/m²", 1..=100, "docs/locomotion.md#transitions";
        /// Weight of arms, which weigh little and have time, against legs.
        ARM_WEIGHT: f64 = 0.05, "1", 0..=1.0, "docs/locomotion.md#transitions";
        /// Unlikeness up to which a motion repeats as a whole.
        WHOLE_CYCLE: f64 = 0.06, "rad", 0.01..=0.2, "docs/locomotion.md#transitions";
        /// Unlikeness up to which a stretch of a motion is closed to a cycle.
        CLOSED_CYCLE: f64 = 0.12, "rad", 0.02..=0.4, "docs/locomotion.md#transitions";
        /// Unlikeness up to which a step that breaks off is continued like an earlier one.
        SAME_STEP: f64 = 0.3, "rad", 0.05..=0.6, "docs/locomotion.md#stops";
        /// Unlikeness of trunk and legs up to which a motion passes into another one.
        TRANSITION: f64 = 0.35, "rad", 0.05..=0.6, "docs/locomotion.md#transitions";
        /// Samples per second at which the ends of a cycle are compared.
        CYCLE_RATE: f64 = 30.0, "Hz", 10..=120, "docs/locomotion.md#transitions";
        /// Shortest cycle.
        SHORTEST_CYCLE: f64 = 0.6, "s", 0.3..=2.0, "docs/locomotion.md#transitions";
        /// Shortest cycle as a share of the motion: less would no longer be the motion that was asked for.
        SHORTEST_CYCLE_SHARE: f64 = 0.45, "1", 0.1..=1.0, "docs/locomotion.md#transitions";
        /// Worth of a longer cycle, per share of the motion.
        LENGTH_WORTH: f64 = 0.25, "rad", 0..=1.0, "docs/locomotion.md#transitions";
        /// How far balance looks ahead and back in a cycle.
        CYCLE_AHEAD: f64 = 1.0, "s", 0.5..=3.0, "docs/locomotion.md#transitions";
    }
}

/// Steps out of a motion to a stand, and into one.
pub mod stop {
    crate::params::params! {
        /// Slower than this, with the capture point inside the soles, it stands.
        STANDING_SPEED: f64 = 0.35, "m/s", 0.1..=0.8, "docs/locomotion.md#stops";
        /// Distance inside the soles of the capture point of a body that stands.
        STANDING_MARGIN: f64 = 0.02, "m", 0..=0.05, "docs/locomotion.md#stops";
        /// A pelvis that is faster over the floor has to be stopped; balance control stops slower ones.
        MOVING_SPEED: f64 = 0.08, "m/s", 0.02..=0.3, "docs/locomotion.md#stops";
        /// Time over which the velocity at the end is measured.
        MEASURED_TIME: f64 = 0.08, "s", 0.03..=0.2, "docs/locomotion.md#stops";
        /// Least mean height of the centre of mass that a pendulum is formed with.
        LEAST_HEIGHT: f64 = 0.3, "m", 0.05..=0.5, "numerical";
        /// Longest flight.
        LONGEST_FLIGHT: f64 = 0.5, "s", 0.2..=1.0, "docs/locomotion.md#stops";
        /// The centre of mass lands this much lower than it stands.
        LANDING_DROP: f64 = 0.03, "m", 0..=0.1, "docs/locomotion.md#stops";
        /// Fastest rate of a joint that continues to move.
        MOST_RATE: f64 = 4.0, "rad/s", 1.0..=15, "docs/locomotion.md#stops";
        /// Time constant with which the rates of the joints die away.
        RATE_DECAY: f64 = 0.2, "s", 0.05..=0.6, "docs/locomotion.md#stops";
        /// Time in which trunk and arms come to ease.
        EASE_TIME: f64 = 1.0, "s", 0.3..=2.0, "docs/locomotion.md#stops";
        /// Joints this close to where they shall be are there.
        SAME_JOINT: f64 = 0.03, "rad", 0.005..=0.1, "docs/locomotion.md#stops";
        /// Cut-off of the path of the mass: the zero-moment point of a pendulum jumps, that of a body does not.
        PATH_CUTOFF: f64 = 4.0, "Hz", 1.0..=10, "docs/locomotion.md#stops";
        /// Shortest swing of a step that catches the body.
        SHORTEST_SWING: f64 = 0.26, "s", 0.15..=0.4, "docs/locomotion.md#stops";
        /// Longest such swing.
        LONGEST_SWING: f64 = 0.46, "s", 0.3..=0.8, "docs/locomotion.md#stops";
        /// Step in which the time of a swing is searched.
        SWING_STEP: f64 = 0.02, "s", 0.005..=0.05, "numerical";
        /// Least rest of a swing that is under way.
        SWING_REST: f64 = 0.12, "s", 0.05..=0.3, "docs/locomotion.md#stops";
        /// The second that is tried.
        LONG_SWING_REST: f64 = 0.24, "s", 0.1..=0.4, "docs/locomotion.md#stops";
        /// The third that is tried.
        LONGEST_SWING_REST: f64 = 0.4, "s", 0.2..=0.6, "docs/locomotion.md#stops";
        /// Largest mean speed of a swinging foot.
        FOOT_SPEED: f64 = 2.2, "m/s", 1.0..=4.0, "docs/locomotion.md#stops";
        /// The second that is tried, with the shortest rest.
        FAST_FOOT_SPEED: f64 = 3.2, "m/s", 1.5..=5.0, "docs/locomotion.md#stops";
        /// Length of a step that only closes the feet.
        CLOSING_TIME: f64 = 0.5, "s", 0.3..=0.8, "docs/locomotion.md#stops";
        /// Double support after a step and before the first one.
        DOUBLE_SUPPORT: f64 = 0.1, "s", 0.03..=0.3, "docs/locomotion.md#stops";
        /// Longest step forward, in leg lengths.
        STEP_LENGTH: f64 = 0.8, "1", 0.4..=1.1, "docs/locomotion.md#stops";
        /// Widest step to the side, in leg lengths.
        STEP_WIDTH: f64 = 0.65, "1", 0.3..=0.9, "docs/locomotion.md#stops";
        /// A foot that lands closer than this to level with the other one lands level with it.
        STEP_LEVEL: f64 = 0.02, "m", 0..=0.05, "docs/locomotion.md#stops";
        /// Least distance of the feet to the side, as a share of that at ease.
        LEAST_WIDTH: f64 = 0.8, "1", 0.3..=1.0, "docs/locomotion.md#stops";
        /// From this distance before or behind the other foot on a step may come nearer to its line.
        CROSS_BEGINS: f64 = 0.2, "m", 0.1..=0.5, "docs/locomotion.md#stops";
        /// From this distance on it may cross it.
        CROSS_ENDS: f64 = 0.35, "m", 0.2..=0.7, "docs/locomotion.md#stops";
        /// Most by which it crosses the line.
        MOST_CROSS: f64 = 0.12, "m", 0..=0.3, "docs/locomotion.md#stops";
        /// The zero-moment point keeps the capture point this far inside the soles where it can.
        CAPTURE_INSET: f64 = 0.035, "m", 0..=0.06, "docs/locomotion.md#stops";
        /// The capture point counts as caught this far inside the soles.
        CAUGHT_INSET: f64 = 0.015, "m", 0..=0.06, "docs/locomotion.md#stops";
        /// A foot that catches a body of 1 m/s lands this far beyond the capture point.
        BEYOND_CAPTURE: f64 = 0.1, "m", 0..=0.3, "docs/locomotion.md#stops";
        /// Time that a body of 1 m/s should have in hand where the moment is given and not chosen.
        SPARE_TIME: f64 = 0.03, "s", 0..=0.1, "docs/locomotion.md#stops";
        /// Gain of the zero-moment point on the way to a place.
        LEAN_GAIN: f64 = 2.0, "1", 1.1..=5.0, "docs/locomotion.md#stops";
        /// The capture point this close to a place is there.
        LEAN_SETTLED: f64 = 0.015, "m", 0.002..=0.05, "docs/locomotion.md#stops";
        /// Longest time of a lean.
        LEAN_TIME: f64 = 0.9, "s", 0.3..=2.0, "docs/locomotion.md#stops";
        /// A foot this far from under the mass, in leg lengths, is about to be out of reach: hips extend no further.
        STRETCHED: f64 = 0.5, "1", 0.3..=0.8, "docs/locomotion.md#stops";
        /// A foot that belongs farther from the other one is put there with the mass on its way.
        STRIDE_BEGINS: f64 = 0.35, "m", 0.1..=0.6, "docs/locomotion.md#stops";
        /// From this distance on the capture point is half-way when it lands.
        STRIDE_ENDS: f64 = 0.6, "m", 0.3..=1.0, "docs/locomotion.md#stops";
        /// A foot turned by less from where it belongs stays.
        HOME_ANGLE: f64 = 0.15, "rad", 0.05..=0.4, "docs/locomotion.md#stops";
        /// Step in which turns to where the body moves are tried, as a share of the whole turn.
        TURN_STEP: f64 = 0.5, "1", 0.1..=1.0, "docs/locomotion.md#stops";
        /// Turns that are tried, the first without any.
        TURNS: usize = 4, "rounds", 1..=10, "docs/locomotion.md#stops";
        /// A body that moves further aside does not turn.
        MOST_ASIDE: f64 = 1.2, "rad", 0.3..=1.6, "docs/locomotion.md#stops";
        /// Most steps of a stop.
        MOST_STEPS: usize = 8, "1", 2..=20, "docs/locomotion.md#stops";
        /// Time for which the motion continues after the feet have come to rest.
        REST_TIME: f64 = 0.8, "s", 0.2..=2.0, "docs/locomotion.md#stops";
        /// A foot that is faster costs the square of what it is faster by.
        UNHURRIED_SPEED: f64 = 1.5, "m/s", 0.5..=3.0, "docs/locomotion.md#stops";
        /// Way that a turn by a radian counts as in that speed.
        TURN_ARM: f64 = 0.3, "m", 0.1..=0.5, "docs/locomotion.md#stops";
        /// Price of a hurried foot, against the fall of the mass beside the zero-moment point.
        HURRY_PRICE: f64 = 1e-3, "m² s³", 0..=0.1, "docs/locomotion.md#stops";
        /// Price of a foot that steps twice.
        HOP_PRICE: f64 = 1e-3, "m⁴ s", 0..=0.1, "docs/locomotion.md#stops";
        /// Worth of having something in hand.
        SPARE_WORTH: f64 = 0.1, "m⁴", 0..=1.0, "docs/locomotion.md#stops";
        /// Height of the ankle's arc.
        ARC_HEIGHT: f64 = 0.05, "m", 0.01..=0.15, "docs/locomotion.md#stops";
        /// A foot is over its place so long before it comes down on it: one that is late would slide there.
        OVER_TIME: f64 = 0.03, "s", 0..=0.1, "docs/locomotion.md#stops";
        /// The heel of a foot that is left behind by more than this rises.
        ROLL_FROM: f64 = 0.15, "m", 0..=0.4, "docs/locomotion.md#stops";
        /// It rises by so much per distance.
        ROLL_GAIN: f64 = 1.0, "rad/m", 0.2..=3.0, "docs/locomotion.md#stops";
        /// Most by which it rises.
        MOST_ROLL: f64 = 0.5, "rad", 0.1..=1.0, "docs/locomotion.md#stops";
        /// Time in which it rises.
        ROLL_TIME: f64 = 0.2, "s", 0.05..=0.4, "docs/locomotion.md#stops";
        /// Moments at which a motion can be stopped are looked for this far ahead.
        SEARCH_TIME: f64 = 0.55, "s", 0.2..=1.5, "docs/locomotion.md#stops";
        /// Samples between the moments that are tried.
        SEARCH_STRIDE: usize = 14, "samples", 4..=60, "docs/locomotion.md#stops";
        /// A stop that asks for less force and moment from nothing, in weights, is not worth bettering.
        EASY: f64 = 0.03, "1", 0..=0.2, "docs/locomotion.md#stops";
        /// Length of the past motion with which a stop is planned.
        RUN_UP: f64 = 1.4, "s", 0.5..=3.0, "docs/locomotion.md#stops";
        /// Length of the past motion that is prepared together with a stop or a begin.
        PREPARED_TIME: f64 = 0.4, "s", 0.1..=1.0, "docs/locomotion.md#stops";
        /// Time over which a prepared motion replaces the one that is played.
        BLEND_TIME: f64 = 0.3, "s", 0.1..=1.0, "docs/locomotion.md#stops";
        /// Least number of samples since the beginning of a step that is taken again.
        LEAST_STEP: usize = 48, "samples", 10..=120, "docs/locomotion.md#stops";
        /// Samples per second of what is prepared for stops, begins and transitions.
        RATE: f64 = 120.0, "Hz", 60..=240, "docs/locomotion.md#stops";
    }
}

/// From a motion, or a stand, into a clip.
pub mod transition {
    crate::params::params! {
        /// Length of the past motion that is taken along: the part prepared with the seam, and some more. The pelvis
        /// may be shifted this long before the event that needs it.
        RUN_UP: f64 = 0.5, "s", 0.2..=2.0, "docs/locomotion.md#transitions";
        /// A place to leave a motion is looked for this far ahead: more than a stride.
        AHEAD: f64 = 1.5, "s", 0.5..=3.0, "docs/locomotion.md#transitions";
        /// Length of the motion that is needed beyond the last such place.
        BEYOND: f64 = 0.05, "s", 0.02..=0.3, "docs/locomotion.md#transitions";
        /// Most of a clip that is skipped.
        MOST_SKIPPED: f64 = 0.4, "s", 0..=1.0, "docs/locomotion.md#transitions";
        /// The same as a share of its length.
        MOST_SKIPPED_SHARE: f64 = 0.15, "1", 0..=0.5, "docs/locomotion.md#transitions";
        /// Most that is skipped of a clip that repeats: a stride.
        MOST_SKIPPED_OF_CYCLE: f64 = 1.2, "s", 0..=2.0, "docs/locomotion.md#transitions";
        /// Samples between those that are compared.
        STRIDE: usize = 2, "samples", 1..=10, "docs/locomotion.md#transitions";
        /// Largest distance of the capture points; a push that moves it as far is mostly caught.
        MOST_CAPTURE: f64 = 0.13, "m", 0.03..=0.3, "docs/locomotion.md#transitions";
        /// Largest distance of the feet that do not carry.
        MOST_STEP: f64 = 0.35, "m", 0.1..=0.7, "docs/locomotion.md#transitions";
        /// Largest turn of the foot that carries: hips turn by 0.7.
        MOST_TURN: f64 = 0.7, "rad", 0.2..=1.0, "docs/locomotion.md#transitions";
        /// Weight of the heading of the pelvis in the turn that puts one motion on the other.
        PELVIS_HEADING: f64 = 0.15, "m", 0..=0.5, "docs/locomotion.md#transitions";
        /// Weight of the heading of the foot.
        FOOT_HEADING: f64 = 0.1, "m", 0..=0.5, "docs/locomotion.md#transitions";
        /// Cost of waiting for a better moment.
        WAITING_COST: f64 = 0.5, "1/s", 0..=3.0, "docs/locomotion.md#transitions";
        /// Moments that are tried.
        CANDIDATES: usize = 4, "1", 1..=20, "docs/locomotion.md#transitions";
        /// Samples between two moments that are tried.
        CANDIDATE_STRIDE: usize = 18, "samples", 1..=60, "docs/locomotion.md#transitions";
        /// Force and moment that a transition may ask for from nothing, in weights.
        MOST_INFEASIBLE: f64 = 0.05, "1", 0..=0.3, "docs/locomotion.md#transitions";
        /// Time over which trunk and legs pass from one motion to another; the jump of a stream is spread over it too.
        BLEND_TIME: f64 = 0.4, "s", 0.1..=1.0, "docs/locomotion.md#transitions";
        /// Time in which arms do.
        ARM_BLEND_TIME: f64 = 0.6, "s", 0.1..=1.5, "docs/locomotion.md#transitions";
        /// Shortest time for a swinging foot that lands soon.
        LEAST_BLEND_TIME: f64 = 0.1, "s", 0.03..=0.3, "docs/locomotion.md#transitions";
        /// Time in which a shift of the pelvis comes in, and goes out.
        SHIFT_EDGE: f64 = 0.25, "s", 0.05..=0.6, "docs/locomotion.md#transitions";
        /// Length of the known motion before and after that, for accelerations and filters.
        MARGIN: f64 = 0.3, "s", 0.1..=1.0, "docs/locomotion.md#transitions";
        /// Feet have stood, or swung, for so long when the clip takes over, and go on.
        STEADY: usize = 6, "samples", 1..=30, "docs/locomotion.md#transitions";
        /// Longest time after the seam until it does.
        LONGEST: f64 = 3.0, "s", 1.0..=6.0, "docs/locomotion.md#transitions";
        /// Distance from where the clip has it of a foot that stays where it is.
        SAME_PLACE: f64 = 0.002, "m", 0..=0.01, "docs/locomotion.md#transitions";
        /// Turn of such a foot.
        SAME_HEADING: f64 = 0.02, "rad", 0..=0.1, "docs/locomotion.md#transitions";
        /// A foot that its leg cannot hold to this accuracy makes a transition useless.
        MOST_STRAY: f64 = 0.003, "m", 5e-4..=0.02, "docs/locomotion.md#transitions";
        /// A clip begins as a figure stands only if the capture point is no farther away than this.
        BEGIN_CAPTURE: f64 = 0.05, "m", 0.01..=0.15, "docs/locomotion.md#transitions";
        /// A clip begins as a figure stands only if no joint differs by more than this.
        BEGIN_JOINT: f64 = 0.25, "rad", 0.05..=0.6, "docs/locomotion.md#transitions";
        /// A clip begins as a figure stands only if no joint of the clip is faster than this.
        BEGIN_RATE: f64 = 1.0, "rad/s", 0.2..=3.0, "docs/locomotion.md#transitions";
    }
}

/// The window of a stream, and streams that jump or break off.
pub mod stream {
    crate::params::params! {
        /// Samples per second of the grid that a stream is prepared on, and that a motion is handed over with.
        RATE: f64 = 60.0, "Hz", 30..=120, "docs/locomotion.md#streams";
        /// Shortest window.
        SHORTEST_WINDOW: f64 = 0.3, "s", 0.2..=1.0, "docs/locomotion.md#streams";
        /// Longest window.
        LONGEST_WINDOW: f64 = 1.0, "s", 0.3..=3.0, "docs/locomotion.md#streams";
        /// Half width of the smoothing.
        SMOOTH: i64 = 3, "samples", 1..=9, "docs/locomotion.md#streams";
        /// Standard deviation of the smoothing: the amplitude is half at 7 Hz.
        SIGMA: f64 = 1.6, "samples", 0.5..=4.0, "docs/locomotion.md#streams";
        /// Samples between the one whose feet are posed and the one that is put together.
        POSED: i64 = 2, "samples", 2..=6, "docs/locomotion.md#streams";
        /// Most samples before the output at which the posture is put together, if the window is long.
        FORESEEN: i64 = 16, "samples", 0..=40, "docs/locomotion.md#streams";
        /// Samples behind the output that are kept: balance looks back on them, and a late figure asks for them.
        PAST: i64 = 90, "samples", 30..=240, "docs/locomotion.md#streams";
        /// A stream that is this far, in a joint or in tilt, from where it was leading has jumped.
        JUMP_ANGLE: f64 = 0.25, "rad", 0.1..=0.6, "docs/locomotion.md#streams";
        /// A pelvis that is this far from where it was leading has jumped.
        JUMP_DISTANCE: f64 = 0.06, "m", 0.02..=0.2, "docs/locomotion.md#streams";
        /// Least number of coordinates of the joints that jump together; one alone is a glitch.
        JUMP_JOINTS: usize = 4, "1", 2..=20, "docs/locomotion.md#streams";
        /// A coordinate that changes by less from sample to sample does not change, in radians or metres.
        SAME: f64 = 1e-6, "rad", 1e-9..=1e-4, "docs/locomotion.md#streams";
        /// Samples that repeat one for so long break a stream off: as long as a velocity is continued in a silence.
        REPEATED_TIME: f64 = 0.1, "s", 0.05..=0.5, "docs/locomotion.md#streams";
        /// Samples over which the speed of the pelvis is averaged, about.
        SPEED_AVERAGED: f64 = 4.0, "samples", 1..=20, "docs/locomotion.md#streams";
        /// Cost of a second of delay where a stream is taken up: it matters where all moments are alike.
        DELAY_COST: f64 = 0.3, "1/s²", 0..=3.0, "docs/locomotion.md#streams";
    }
}

/// All parameters of the plans by group.
pub fn groups() -> [(&'static str, &'static [Param]); 15] {
    [
        ("contact", contact::ALL),
        ("pelvis", pelvis::ALL),
        ("common", common::ALL),
        ("stance", stance::ALL),
        ("pitch", pitch::ALL),
        ("swing", swing::ALL),
        ("ankle", ankle::ALL),
        ("balance", balance::ALL),
        ("leg", leg::ALL),
        ("run", run::ALL),
        ("feasibility", feasibility::ALL),
        ("likeness", likeness::ALL),
        ("stop", stop::ALL),
        ("transition", transition::ALL),
        ("stream", stream::ALL),
    ]
}
