//! The kind of motion of a clip, by measurement of the fitted recording; never by its name.

use sinew_physics::body::topology::{L_FOOT, R_FOOT};
use sinew_physics::body::{Body, Posture};
use sinew_physics::math::Vec3;
use sinew_physics::math::runs::runs;
use sinew_physics::motion::leg_ik::forward;

/// Upright part of the pelvis's vertical axis below which the body is upside down (107° from upright).
const INVERTED: f64 = -0.3;
/// A pelvis below this share of its standing height is on the floor.
const FLOOR: f64 = 0.45;
/// A posture lasts at least this long to count, s.
const LASTS: f64 = 0.2;
/// Both feet are off the floor for at least this long in a flight, s.
const FLIGHT: f64 = 0.1;
/// Speed over the floor in flights from which flights are a run, m/s.
const RUN_SPEED: f64 = 1.2;
/// Places of one foot that are farther apart than this are two footholds, m.
const STEP: f64 = 0.12;
/// Mean speed over the floor from which steps are a walk, m/s, and the number of steps that it takes.
const WALK: (f64, usize) = (0.35, 3);
/// Change of heading from which a motion turns, rad (90°).
const TURN: f64 = std::f64::consts::FRAC_PI_2;

/// Kinds of motion, from the quietest on.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum MotionKind {
    /// Both feet stay where they are.
    Stand,
    /// A foot is put somewhere else.
    Step,
    /// The heading changes by 90° or more, without a walk.
    Turn,
    /// Three steps or more, at 0.35 m/s or more on the average.
    Walk,
    /// Two flights or more, at 1.2 m/s or more in them.
    Run,
    /// Flights.
    Jump,
    /// The pelvis is on the floor for 0.2 s or more.
    Floor,
    /// The pelvis is upside down, and not on the floor, for 0.1 s or more.
    Acrobatic,
}

impl MotionKind {
    /// All, from the quietest on.
    pub const ALL: [Self; 8] = [
        Self::Stand,
        Self::Step,
        Self::Turn,
        Self::Walk,
        Self::Run,
        Self::Jump,
        Self::Floor,
        Self::Acrobatic,
    ];

    /// Its name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stand => "stand",
            Self::Step => "step",
            Self::Turn => "turn",
            Self::Walk => "walk",
            Self::Run => "run",
            Self::Jump => "jump",
            Self::Floor => "floor",
            Self::Acrobatic => "acrobatic",
        }
    }
}

/// The kind of a motion; of several that hold, the last one of [`MotionKind::ALL`].
///
/// * `postures`: the fitted recording, `rate_hz` samples per second, not empty; `label`: feet (left, right) that it
///   has on the floor.
pub fn kind(body: &Body, postures: &[Posture], label: &[[bool; 2]], rate_hz: f64) -> MotionKind {
    let n = postures.len().min(label.len());
    let longest = |on: &dyn Fn(usize) -> bool| {
        let flags: Vec<bool> = (0..n).map(on).collect();
        let all = runs(&flags).into_iter().filter(|r| r.2);
        all.map(|(i, j, _)| j - i).max().unwrap_or(0) as f64 / rate_hz
    };
    let low = FLOOR * body.standing_root_height();
    let inverted = |i: usize| {
        let p = &postures[i];
        p.root_rotation.rotate(Vec3::Z).z < INVERTED && p.root_position.z > low
    };
    if longest(&inverted) >= 0.5 * LASTS {
        return MotionKind::Acrobatic;
    }
    if longest(&|i| postures[i].root_position.z < low) >= LASTS {
        return MotionKind::Floor;
    }
    let air: Vec<bool> = label[..n].iter().map(|l| *l == [false; 2]).collect();
    let flights: Vec<(usize, usize)> = runs(&air)
        .into_iter()
        .filter(|(i, j, air)| *air && (j - i) as f64 >= FLIGHT * rate_hz)
        .map(|(i, j, _)| (i, j))
        .collect();
    let level = |a: &Posture, b: &Posture| {
        let d = b.root_position - a.root_position;
        d.x.hypot(d.y)
    };
    if !flights.is_empty() {
        let way: f64 = (flights.iter())
            .map(|(i, j)| level(&postures[*i], &postures[j - 1]))
            .sum();
        let time: f64 = flights
            .iter()
            .map(|(i, j)| (j - i - 1).max(1) as f64)
            .sum::<f64>()
            / rate_hz;
        return if flights.len() >= 2 && way / time > RUN_SPEED {
            MotionKind::Run
        } else {
            MotionKind::Jump
        };
    }
    let steps = steps(body, &postures[..n], label);
    let way: f64 = (postures[..n].windows(2))
        .map(|w| level(&w[0], &w[1]))
        .sum();
    let speed = way * rate_hz / n.max(1) as f64;
    if steps >= WALK.1 && speed > WALK.0 {
        return MotionKind::Walk;
    }
    if turned(&postures[..n]) >= TURN {
        return MotionKind::Turn;
    }
    if steps > 0 {
        MotionKind::Step
    } else {
        MotionKind::Stand
    }
}

/// Number of times that a foot is put down farther than [`STEP`] from its last place.
fn steps(body: &Body, postures: &[Posture], label: &[[bool; 2]]) -> usize {
    let mut count = 0;
    for (side, foot) in [L_FOOT, R_FOOT].into_iter().enumerate() {
        let on: Vec<bool> = label.iter().map(|l| l[side]).collect();
        let mut before: Option<Vec3> = None;
        for (i, j, _) in runs(&on[..postures.len()]).into_iter().filter(|r| r.2) {
            let at = forward(body, &postures[(i + j) / 2])[foot.index()].0;
            if let Some(b) = before
                && (at.x - b.x).hypot(at.y - b.y) > STEP
            {
                count += 1;
            }
            before = Some(at);
        }
    }
    count
}

/// Largest difference between two headings of the motion, turns counted, rad.
fn turned(postures: &[Posture]) -> f64 {
    let (mut yaw, mut low, mut high) = (0.0f64, 0.0f64, 0.0f64);
    let heading = |p: &Posture| {
        let ahead = p.root_rotation.rotate(Vec3::X);
        ahead.y.atan2(ahead.x)
    };
    for w in postures.windows(2) {
        let step = heading(&w[1]) - heading(&w[0]);
        let turns = (step / std::f64::consts::TAU).round();
        yaw += step - turns * std::f64::consts::TAU;
        (low, high) = (low.min(yaw), high.max(yaw));
    }
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_physics::math::Quat;
    use sinew_physics::motion::builtin::{at_ease, builtin};

    const RATE: f64 = 60.0;

    fn of(place: impl Fn(f64, &mut Posture), label: impl Fn(f64) -> [bool; 2]) -> MotionKind {
        let body = Body::adult_man();
        let times: Vec<f64> = (0..120).map(|i| f64::from(i) / RATE).collect();
        let postures: Vec<Posture> = times
            .iter()
            .map(|t| {
                let mut p = at_ease(&body);
                place(*t, &mut p);
                p
            })
            .collect();
        let label: Vec<_> = times.iter().map(|t| label(*t)).collect();
        kind(&body, &postures, &label, RATE)
    }

    const DOWN: fn(f64) -> [bool; 2] = |_| [true; 2];

    #[test]
    fn built_in_motions_are_what_they_are_called() {
        let body = Body::adult_man();
        for (name, want) in [
            ("idle", MotionKind::Stand),
            ("wave", MotionKind::Stand),
            ("squat", MotionKind::Stand),
            ("walk", MotionKind::Walk),
        ] {
            let clip = builtin(&body, name).expect("built in");
            let postures: Vec<_> = clip.samples().map(|s| *s.0).collect();
            let label: Vec<_> = clip.samples().map(|s| s.1).collect();
            assert_eq!(
                kind(&body, &postures, &label, clip.rate_hz()),
                want,
                "{name}"
            );
        }
    }

    #[test]
    fn postures_and_flights_decide() {
        let still = |_: f64, _: &mut Posture| {};
        assert_eq!(of(still, DOWN), MotionKind::Stand);
        let lies = |_: f64, p: &mut Posture| p.root_position.z = 0.2;
        assert_eq!(of(lies, DOWN), MotionKind::Floor);
        let flips = |t: f64, p: &mut Posture| p.root_rotation = Quat::exp(Vec3::Y * (3.1 * t));
        assert_eq!(of(flips, DOWN), MotionKind::Acrobatic);
        let turns = |t: f64, p: &mut Posture| p.root_rotation = Quat::exp(Vec3::Z * t);
        assert_eq!(of(turns, DOWN), MotionKind::Turn);
        let hop = |t: f64| [!(0.8..1.1).contains(&t); 2];
        assert_eq!(of(still, hop), MotionKind::Jump);
        let hops = |t: f64| [((t * 4.0) as usize).is_multiple_of(2), false];
        let fast = |t: f64, p: &mut Posture| p.root_position.x = 2.5 * t;
        assert_eq!(of(fast, hops), MotionKind::Run);
    }
}
