//! Recorded motion on two feet: tracked, pushed, by other people, with loads, on other floors, from noisy recordings.

use super::{carried, push_at_chest};
use crate::metrics::{Metrics, Tick};
use crate::report::RunReport;
use sinew_physics::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::body::{Body, SegmentId};
use sinew_physics::figure::{ContactPoint, ControllerKind, Perturbation, StrengthScale};
use sinew_physics::math::Vec3;
use sinew_physics::motion::Clip;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureSetup, MotionSource, World, WorldParams};
use std::sync::Arc;

/// A push lasts this long, s.
const LASTS: f64 = 0.1;
/// A foot stands while the floor pushes it with more than this, N.
const STANDS: f64 = 20.0;

/// The person who walks, and the conditions.
#[derive(Clone, Debug)]
pub struct Walker {
    /// The body.
    pub body: Arc<Body>,
    /// Factor on its strength.
    pub strength: f64,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Friction coefficient of the floor.
    pub friction: f64,
    /// Speed at which the clip is played.
    pub speed: f64,
    /// A load in one hand or in both, kg.
    pub load: Option<(f64, Hands)>,
}

/// The hands that hold a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hands {
    /// The right one.
    Right,
    /// One load in each hand, half of the mass each.
    Both,
}

impl Walker {
    /// `body` at its own strength, at 60 ticks per second on a floor of friction 0.9, with nothing in its hands.
    pub fn new(body: &Arc<Body>) -> Self {
        Self {
            body: Arc::clone(body),
            strength: 1.0,
            rate_hz: 60.0,
            friction: WorldParams::default().friction,
            speed: 1.0,
            load: None,
        }
    }
}

/// A walk.
#[derive(Clone, Debug)]
pub struct WalkTrial {
    /// The motion.
    pub clip: Arc<Clip>,
    /// Whether it starts over at its end.
    pub looped: bool,
    /// Length, s of the world; it begins with the way from standing into the clip.
    pub seconds: f64,
    /// A push at the chest of 0.1 s: time from the beginning, s, and impulse, N·s.
    pub push: Option<(f64, Vec3)>,
}

impl WalkTrial {
    /// Once, from standing to standing, with a second to stand afterwards.
    pub fn once(clip: &Arc<Clip>) -> Self {
        Self {
            clip: Arc::clone(clip),
            looped: false,
            seconds: clip.lead_in() + clip.duration() + clip.lead_out() + 1.0,
            push: None,
        }
    }

    /// Over and over for `seconds`.
    pub fn over_and_over(clip: &Arc<Clip>, seconds: f64) -> Self {
        Self {
            clip: Arc::clone(clip),
            looped: true,
            seconds,
            push: None,
        }
    }
}

/// The result.
#[derive(Clone, Debug)]
pub struct Walked {
    /// Tracking, strength, torques.
    pub report: RunReport,
    /// Time at which it fell, s.
    pub fell_s: Option<f64>,
    /// Distance of the capture point from the motion's, rms and largest, m; until a fall.
    pub capture: [f64; 2],
    /// Largest distance that a foot slid in one stance, m: of its contact points, weighted by their share of the load.
    pub slip: f64,
    /// Largest push of the floor in a tick, in units of the weight: in total, and on one foot, which is the value that
    /// force plates under walking people measure (1.1 to 1.3).
    pub peak: [f64; 2],
    /// Steps, and the largest deviation of a touch-down from its plan, s.
    pub steps: usize,
    /// See `steps`.
    pub late: f64,
}

impl Walked {
    /// Whether it did not fall.
    pub fn stood(&self) -> bool {
        self.fell_s.is_none()
    }
}

/// Sliding of one foot.
#[derive(Clone, Debug, Default)]
pub struct FootSliding {
    before: Vec<ContactPoint>,
    way: f64,
    /// Load on the foot, N.
    load: f64,
}

impl FootSliding {
    /// Load on the foot in the last tick, N.
    pub fn load(&self) -> f64 {
        self.load
    }

    /// Takes in the contact points of a tick, of which those on `segments` belong to the foot; returns the distance
    /// slid in the present stance, m.
    pub fn observe(&mut self, now: &[ContactPoint], segments: [SegmentId; 2]) -> f64 {
        let mine = |c: &&ContactPoint| segments.contains(&c.segment);
        let load: f64 = now.iter().filter(mine).map(|c| c.force.z).sum();
        self.load = load;
        if load < STANDS {
            self.way = 0.0;
            self.before.clear();
            return 0.0;
        }
        for c in now.iter().filter(mine) {
            let same = |o: &&ContactPoint| (o.segment, o.vertex) == (c.segment, c.vertex);
            if let Some(o) = self.before.iter().find(same) {
                let slid = c.position - o.position;
                self.way += slid.x.hypot(slid.y) * c.force.z / load;
            }
        }
        self.before.clear();
        self.before.extend(now.iter().filter(mine).copied());
        self.way
    }
}

/// Walks until the end or a fall.
pub fn walk(walker: &Walker, walk: &WalkTrial) -> Walked {
    let clip = &walk.clip;
    let lead = clip.lead_in();
    let start = clip.sample(-lead);
    let mut world = World::new(WorldParams {
        rate_hz: walker.rate_hz,
        friction: walker.friction,
        ..WorldParams::default()
    })
    .expect("experiments have valid worlds");
    let key = world
        .add_figure(FigureSetup {
            name: clip.name().to_owned(),
            strength: StrengthScale {
                all: walker.strength,
                ..StrengthScale::default()
            },
            ..FigureSetup::new(
                Arc::clone(&walker.body),
                ControllerKind::Modern,
                start.state(),
            )
        })
        .expect("experiments have valid figures");
    let figure = world.figure_mut(key).expect("it was just added");
    figure.set_drive(MotionSource::Clip(ClipPlayback {
        speed: walker.speed,
        looped: walk.looped,
        ..ClipPlayback::new(Arc::clone(clip), WorldTime(lead / walker.speed))
    }));
    for what in perturbations(walker, walk) {
        world
            .perturb(key, what)
            .expect("loads and pushes are valid");
    }
    let mut metrics = Metrics::new(walker.rate_hz, &start.posture);
    let (mut square, mut largest, mut peak) = (0.0, 0.0f64, [0.0f64; 2]);
    let (mut slip, mut steps, mut late) = (0.0f64, 0, 0.0f64);
    let mut stances = [FootSliding::default(), FootSliding::default()];
    let ticks = (walk.seconds * walker.rate_hz).round() as u64;
    let (mut seen, mut fell_s) = (0u32, None);
    for _ in 0..ticks {
        world.step();
        let figure = world.figure(key).expect("nobody removes the figure");
        let r = figure.report().expect("a stepped figure has a report");
        metrics.observe(Tick::of(figure, world.params().gravity), 0.0);
        if figure.is_fallen() {
            fell_s = Some(world.time().0);
            break;
        }
        seen += 1;
        let off = figure.tracker().capture().error;
        let off = off[0].hypot(off[1]);
        square += off * off;
        largest = largest.max(off);
        let floor: f64 = r.contacts.iter().map(|c| c.force.z).sum();
        let weight = figure.links().total_mass() * world.params().gravity;
        peak[0] = peak[0].max(floor / weight);
        let feet = [[L_FOOT, L_TOES], [R_FOOT, R_TOES]];
        for (stance, segments) in stances.iter_mut().zip(feet) {
            slip = slip.max(stance.observe(&r.contacts, segments));
            peak[1] = peak[1].max(stance.load / weight);
        }
        if let Some(landing) = figure.tracker().landing() {
            steps += 1;
            late = late.max(landing.late.abs());
        }
    }
    Walked {
        report: metrics.finish(world.state_hash()),
        fell_s,
        capture: [(square / f64::from(seen.max(1))).sqrt(), largest],
        slip,
        peak,
        steps,
        late,
    }
}

fn perturbations(walker: &Walker, walk: &WalkTrial) -> Vec<Perturbation> {
    let mut out = match walker.load {
        None => Vec::new(),
        Some((mass, hands)) => carried(&walker.body, mass, hands == Hands::Both),
    };
    if let Some((time, impulse)) = walk.push {
        out.push(push_at_chest(impulse * (1.0 / LASTS), time, LASTS));
    }
    out
}
