//! Pushes while a figure starts, walks or stands: after how many of a fixed set of cells, moments times directions, it
//! is still up.

use super::stats::median;
use crate::pose::segment_poses;
use sinew_physics::body::Body;
use sinew_physics::body::topology::CHEST;
use sinew_physics::figure::{ControllerKind, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::math::rounding::short;
use sinew_physics::motion::Clip;
use sinew_physics::plan::cycle::cycle;
use sinew_physics::rehearsal::trial::Conditions;
use sinew_physics::time::WorldTime;
use sinew_physics::track::StepPlan;
use sinew_physics::world::{ClipPlayback, FigureSetup, MotionSource, World, WorldError};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Moments of a clip at which pushes begin.
const MOMENTS: usize = 8;
/// Time for which a figure is watched after a push begins, s: it may stop, and begin its clip again.
const WATCHED: f64 = 6.0;
/// A start is pushed from this time before its first foot lifts off on, s.
const BEFORE_START: f64 = 0.4;
/// First push on a figure that stands, and time between two, s.
const STANDS: [f64; 2] = [0.5, 0.25];

/// The phase of a motion in which a figure is pushed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PushedWhile {
    /// From a little before it leaves its stand to the third touch-down: four directions, 0.2 s.
    Start,
    /// The third round of its walking cycle: eight directions, 0.1 s.
    Walk,
    /// Standing in its first posture: eight directions, 0.1 s.
    Stand,
}

/// The pushes on one clip.
#[derive(Clone, Debug)]
pub struct PushBench {
    conditions: Conditions,
    /// The motion that is played.
    clip: Arc<Clip>,
    phase: PushedWhile,
    /// World times at which pushes begin, s.
    moments: Vec<f64>,
    /// World direction of a push from behind, rad.
    heading: f64,
}

/// The result of one push.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pushed {
    fell: bool,
    /// Whether the clip still waits for the figure at the end.
    waits: bool,
    /// Largest tilt of the chest after the push, until a fall, degrees.
    tilt: f64,
}

/// The results of all pushes of one strength.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct PushRow {
    /// Name of the clip.
    pub clip: String,
    /// Phase.
    pub phase: PushedWhile,
    /// Impulse, N·s.
    pub impulse_ns: f64,
    /// Pushes.
    pub cells: usize,
    /// Pushes after which it did not fall.
    pub stood: usize,
    /// Of these, pushes after which its clip still waits for it.
    pub waiting: usize,
    /// Median of the largest tilt of the chest, degrees.
    pub tilt_deg: f64,
    /// By moment, separated by spaces, and direction: `.` stood, `w` waits, `x` fell.
    pub map: String,
}

impl PushedWhile {
    fn directions(self) -> usize {
        match self {
            Self::Start => 4,
            Self::Walk | Self::Stand => 8,
        }
    }

    /// How long a push lasts, s.
    fn duration(self) -> f64 {
        match self {
            Self::Start => 0.2,
            Self::Walk | Self::Stand => 0.1,
        }
    }
}

impl PushBench {
    /// The pushes on a prepared clip. `None` if it has no such phase: it does not step, or has no cycle.
    pub fn new(conditions: &Conditions, clip: &Arc<Clip>, phase: PushedWhile) -> Option<Self> {
        let body = &conditions.body;
        let heading = |clip: &Clip, t: f64| clip.sample(t).posture.root_rotation.heading();
        let last = (MOMENTS - 1) as f64;
        let (clip, from, span, heading) = match phase {
            PushedWhile::Stand => {
                let [from, between] = STANDS;
                (Arc::clone(clip), from, last * between, heading(clip, 0.0))
            }
            PushedWhile::Walk => {
                let cycle = cycle(body, clip)?;
                let from = cycle.lead_in() + 2.0 * cycle.duration();
                let span = cycle.duration() * last / MOMENTS as f64;
                let round = cycle.advance();
                let along = round.y.atan2(round.x) + 2.0 * round.yaw;
                (Arc::new(cycle), from, span, along)
            }
            PushedWhile::Start => {
                let lead = clip.lead_in();
                let [first, third] = start(body, clip)?;
                let from = (first + lead - BEFORE_START).max(0.05);
                let span = (third + lead - from).max(0.5);
                (Arc::clone(clip), from, span, heading(clip, -lead))
            }
        };
        let moments = (0..MOMENTS).map(|k| from + span * k as f64 / last);
        Some(Self {
            conditions: conditions.clone(),
            clip,
            phase,
            moments: moments.collect(),
            heading,
        })
    }

    /// Runs all pushes with this impulse, N·s.
    ///
    /// # Errors
    /// Conditions that no world or figure accepts.
    pub fn run(&self, name: &str, impulse: f64) -> Result<PushRow, WorldError> {
        let (mut map, mut tilts) = (String::new(), Vec::new());
        let (mut stood, mut waiting) = (0, 0);
        let directions = self.phase.directions();
        for at in &self.moments {
            if !map.is_empty() {
                map.push(' ');
            }
            for k in 0..directions {
                let angle = self.heading + TAU * k as f64 / directions as f64;
                let (y, x) = angle.sin_cos();
                let pushed = self.push(*at, Vec3 { x, y, z: 0.0 } * impulse)?;
                stood += usize::from(!pushed.fell);
                waiting += usize::from(!pushed.fell && pushed.waits);
                tilts.push(pushed.tilt);
                map.push(match (pushed.fell, pushed.waits) {
                    (true, _) => 'x',
                    (false, true) => 'w',
                    (false, false) => '.',
                });
            }
        }
        Ok(PushRow {
            clip: name.to_owned(),
            phase: self.phase,
            impulse_ns: impulse,
            cells: tilts.len(),
            stood,
            waiting,
            tilt_deg: short(median(&tilts).unwrap_or_default()),
            map,
        })
    }

    /// One push on the chest.
    fn push(&self, at: f64, impulse: Vec3) -> Result<Pushed, WorldError> {
        let (body, conditions) = (&self.conditions.body, &self.conditions);
        let lead = match self.phase {
            PushedWhile::Stand => 0.0,
            _ => self.clip.lead_in(),
        };
        let mut world = World::new(conditions.world)?;
        let state = self.clip.sample(-lead).state();
        let key = world.add_figure(FigureSetup {
            strength: conditions.strength.clone(),
            options: conditions.options,
            ..FigureSetup::new(Arc::clone(body), ControllerKind::Modern, state)
        })?;
        let source = match self.phase {
            PushedWhile::Stand => MotionSource::Hold(state.posture),
            phase => MotionSource::Clip(ClipPlayback {
                looped: phase == PushedWhile::Walk,
                ..ClipPlayback::new(Arc::clone(&self.clip), WorldTime(lead))
            }),
        };
        let figure = world.figure_mut(key).expect("it was just added");
        figure.set_drive(source);
        let duration = self.phase.duration();
        let force = Perturbation::Force {
            segment: CHEST,
            point: body.segment(CHEST).com,
            force: impulse * (1.0 / duration),
            from: at,
            to: at + duration,
        };
        world.perturb(key, force)?;
        let mut out = Pushed {
            fell: false,
            waits: false,
            tilt: 0.0,
        };
        while world.time().0 < at + WATCHED && !out.fell {
            world.step();
            let figure = world.figure(key).expect("it is never removed");
            if world.time().0 > at {
                let poses = segment_poses(&body.joint_offset, &figure.state().posture);
                let up = poses[CHEST.index()].rotation.rotate(Vec3::Z).z;
                out.tilt = out.tilt.max(up.clamp(-1.0, 1.0).acos().to_degrees());
            }
            out.fell = figure.is_fallen();
            out.waits = figure.next_clip().is_some();
        }
        Ok(out)
    }
}

/// Times of a clip at which its first foot lifts off, and at which the third touch-down is over, s.
fn start(body: &Body, clip: &Clip) -> Option<[f64; 2]> {
    let plan = StepPlan::new(body, clip, false);
    let begin = -clip.lead_in();
    let leaves = (0..2).filter_map(|side| plan.current(side, begin).map(|f| f.off));
    let first = leaves.fold(f64::INFINITY, f64::min);
    let mut lands = Vec::new();
    for side in 0..2 {
        let mut t = begin;
        while let Some(f) = plan.next(side, t) {
            lands.push(f.on);
            t = f.on;
        }
    }
    lands.sort_by(f64::total_cmp);
    let third = lands.get(2).or(lands.last())?;
    first.is_finite().then_some([first, *third])
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_physics::figure::{FigureOptions, StrengthScale};
    use sinew_physics::motion::builtin::builtin;
    use sinew_physics::world::WorldParams;

    fn man() -> Conditions {
        Conditions {
            body: Arc::new(Body::adult_man()),
            world: WorldParams::default(),
            strength: StrengthScale::default(),
            options: FigureOptions::default(),
            perturbations: Vec::new(),
            live_window: None,
            rehearsed: None,
        }
    }

    #[test]
    fn a_stand_survives_small_pushes_and_no_large_ones() {
        let conditions = man();
        let idle = Arc::new(builtin(&conditions.body, "idle").unwrap());
        let mut bench = PushBench::new(&conditions, &idle, PushedWhile::Stand).unwrap();
        assert_eq!((bench.moments[0], bench.moments.len()), (0.5, MOMENTS));
        bench.moments.truncate(1);
        for (impulse, stood) in [(2.0, 8), (200.0, 0)] {
            let row = bench.run("idle", impulse).unwrap();
            assert_eq!((row.stood, row.cells), (stood, 8), "{row:?}");
            assert_eq!(row.map.matches('x').count(), 8 - stood);
        }
    }

    #[test]
    fn a_motion_without_steps_neither_starts_nor_walks() {
        let conditions = man();
        let of = |name: &str| Arc::new(builtin(&conditions.body, name).unwrap());
        for phase in [PushedWhile::Start, PushedWhile::Walk] {
            assert!(PushBench::new(&conditions, &of("idle"), phase).is_none());
        }
        assert!(PushBench::new(&conditions, &of("walk"), PushedWhile::Start).is_some());
    }
}
