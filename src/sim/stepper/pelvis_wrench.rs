//! Non-physical help: a bounded wrench on the pelvis towards its desired pose, off by default and always reported.
//!
//! It is an implicit spring on the velocity of the pelvis, solved together with motors, joint limits and contacts. Its
//! impulse over a substep is `κ (v* − v⁺)`, where v* brings the pelvis back to the desired pose, and its norm is
//! limited. Force and moment, and their bounds, grow with the figure's `assist` (0…1); at 1 they hold the pelvis on its
//! path within millimetres, whatever the legs do.
//!
//! A rehearsed motion ([`crate::figure::motion::rehearsed`]) is helped in another way but reported alike: by the
//! impulses that its rehearsal found, if it found any, and by a weak spring towards the path of the pelvis in the
//! rehearsal.

use crate::body::{Body, State};
use crate::math::{Quat, Vec3};
use crate::motion::PlanarTransform;
use crate::motion::{GRAVITY, TargetPair};
use crate::stepper::params::assist::{
    INERTIA, LARGEST_FORCE, LARGEST_MOMENT, PLANNED_COST, RETURN, RETURN_RATE, RETURN_SPEED,
    STIFFNESS,
};
use crate::stepper::params::pull::{FREQUENCY, LEVER};
use serde::{Deserialize, Serialize};

/// The help of an assisted figure in one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assist {
    /// Share, 0…1.
    pub share: f64,
    /// Largest force, N.
    pub most_force: f64,
    /// Largest moment about the pelvis origin, N·m.
    pub most_moment: f64,
    stiffness: [f64; 2],
}

/// The spring of one substep. Index 0: moment and angular velocity, index 1: force and velocity of the pelvis origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// κ, N·m·s and kg.
    pub gain: [f64; 2],
    /// v*, rad/s and m/s.
    pub rest: [Vec3; 2],
    /// Largest impulse, N·m·s and N·s.
    pub most: [f64; 2],
    /// Impulse that acts in addition to the spring, N·m·s and N·s.
    pub given: Option<[Vec3; 2]>,
}

/// The help for the pelvis in a tick.
#[derive(Clone, Copy, Debug)]
pub enum PelvisHelp<'a> {
    /// A spring towards its desired pose.
    Desired(Assist, &'a TargetPair),
    /// A pull towards its desired pose, computed from its pose at the start of a substep.
    Pull(PelvisHold, &'a TargetPair),
    /// The moment, N·m, and the force, N, that the controller planned, constant over the tick.
    Planned([Vec3; 2]),
    /// The help of a rehearsal, and a spring towards the path of the pelvis in that rehearsal.
    Rehearsed(PelvisHold, PelvisPath<'a>),
}

impl PelvisHelp<'_> {
    /// The spring of substep `i` of the `substeps` of a tick of `dt` s.
    pub fn spring(&self, state: &State, i: u32, substeps: u32, dt: f64) -> Spring {
        let h = dt / f64::from(substeps);
        match self {
            Self::Desired(assist, target) => {
                let s = f64::from(i) / f64::from(substeps);
                assist.spring(target, state, s, dt, h)
            }
            Self::Pull(pull, target) => {
                let s = f64::from(i) / f64::from(substeps);
                pull.impulse(target, s, dt, state, h)
            }
            Self::Planned(wrench) => Spring::given(wrench.map(|w| w * h)),
            Self::Rehearsed(hold, path) => hold.spring(path, i as usize, state, h),
        }
    }
}

impl Assist {
    /// The help that a body gets at `share`; `None` at 0.
    pub fn new(body: &Body, share: f64) -> Option<Self> {
        let p = body.profile;
        let weight = p.mass * GRAVITY;
        (share > 0.0).then_some(Self {
            share,
            most_force: share * LARGEST_FORCE * weight,
            most_moment: share * LARGEST_MOMENT * weight * p.height,
            stiffness: [
                share * STIFFNESS * INERTIA * p.mass * p.height * p.height,
                share * STIFFNESS * p.mass,
            ],
        })
    }

    /// As stiff as at share 1, with at most this force over the weight.
    pub fn bounded(body: &Body, most: f64) -> Self {
        let p = body.profile;
        let most_force = most * p.mass * GRAVITY;
        Self {
            share: 1.0,
            most_force,
            most_moment: LEVER * most_force * p.height,
            stiffness: [
                STIFFNESS * INERTIA * p.mass * p.height * p.height,
                STIFFNESS * p.mass,
            ],
        }
    }

    /// Compliance that a plan may assume: moment and force that [`PLANNED_COST`] buys, `½ f²/κ`.
    pub fn planned(&self) -> [f64; 2] {
        let per_cost = 0.125 / PLANNED_COST;
        [self.most_moment, self.most_force].map(|most| per_cost * most * most)
    }

    /// The spring of a substep of `h` s that begins at share `s` of the tick of `dt` s.
    pub fn spring(&self, target: &TargetPair, state: &State, s: f64, dt: f64, h: f64) -> Spring {
        let Missing { off, rate } = Missing::of(target, state, s, dt);
        Spring {
            gain: self.stiffness,
            rest: [
                rate[0] + (off[0] * (RETURN / h)).capped(RETURN_RATE),
                rate[1] + (off[1] * (RETURN / h)).capped(RETURN_SPEED),
            ],
            most: [self.most_moment * h, self.most_force * h],
            given: None,
        }
    }
}

/// Error of the pelvis against its desired motion: turn, rad, and displacement, m; and the desired rates, rad/s and
/// m/s.
pub(crate) struct Missing {
    pub off: [Vec3; 2],
    pub rate: [Vec3; 2],
}

impl Missing {
    /// At share `s` of the tick of `dt` s.
    pub fn of(target: &TargetPair, state: &State, s: f64, dt: f64) -> Self {
        let (from, to) = (&target.now.posture, &target.next.posture);
        let path = to.root_position - from.root_position;
        let turn = (to.root_rotation * from.root_rotation.conjugate()).log();
        let wanted = from.root_position + path * s;
        let wanted_rotation = crate::math::Quat::exp(turn * s) * from.root_rotation;
        Self {
            off: [
                (wanted_rotation * state.posture.root_rotation.conjugate()).log(),
                wanted - state.posture.root_position,
            ],
            rate: [turn * (1.0 / dt), path * (1.0 / dt)],
        }
    }
}

impl Spring {
    /// An impulse that does not depend on the end of the substep, N·m·s and N·s.
    fn given(impulse: [Vec3; 2]) -> Self {
        Self {
            gain: [0.0; 2],
            rest: [Vec3::zero(); 2],
            most: [0.0; 2],
            given: Some(impulse),
        }
    }

    /// Impulse of part `k` at the velocity `v` of the pelvis, without the limit.
    pub fn impulse(&self, k: usize, v: &[f64; 6]) -> Vec3 {
        let now = Vec3 {
            x: v[3 * k],
            y: v[3 * k + 1],
            z: v[3 * k + 2],
        };
        (self.rest[k] - now) * self.gain[k]
    }

    /// The same, cut to the bound, and whether it was cut.
    pub fn cut(&self, k: usize, v: &[f64; 6]) -> (Vec3, bool) {
        let p = self.impulse(k, v);
        let bounded = p.capped(self.most[k]);
        (bounded, bounded != p)
    }
}

/// The spring that leads the pelvis back to the path of the rehearsal: `k x + c ẋ`, critically damped, with limited
/// norm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PelvisHold {
    /// Angular frequency of the body on the spring, rad/s.
    pub frequency: f64,
    /// Mass, kg, and moment of inertia about the pelvis, kg·m², that it assumes.
    pub inertia: [f64; 2],
    /// Largest force, N, and moment, N·m.
    pub most: [f64; 2],
    /// Distance from the path beyond which the motion is over, m.
    pub reach: f64,
}

/// The pelvis in one substep of the rehearsal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RootStep {
    /// Position at the start.
    pub position: Vec3,
    /// World from pelvis, at the start.
    pub rotation: Quat,
    /// Angular and linear velocity at the end, world axes, rad/s and m/s.
    pub velocity: [Vec3; 2],
    /// Impulse of the help, N·m·s and N·s.
    pub help: [Vec3; 2],
}

impl RootStep {
    pub(crate) fn is_helped(&self) -> bool {
        self.help.iter().any(|p| *p != Vec3::zero())
    }
}

/// The substeps of a tick, and the place of the path in the world.
#[derive(Clone, Copy, Debug)]
pub struct PelvisPath<'a> {
    /// One for each substep.
    pub steps: &'a [RootStep],
    /// Place of the motion.
    pub origin: PlanarTransform,
}

impl PelvisPath<'_> {
    /// Substep `i` in the world.
    pub(crate) fn step(&self, i: usize) -> RootStep {
        let step = self.steps[i];
        if self.origin == PlanarTransform::default() {
            return step;
        }
        let turn = self.origin.rotation();
        RootStep {
            position: self.origin.point(step.position),
            rotation: turn * step.rotation,
            velocity: step.velocity.map(|v| turn.rotate(v)),
            help: step.help.map(|p| turn.rotate(p)),
        }
    }
}

impl PelvisHold {
    pub(crate) fn is_valid(&self) -> bool {
        let positive = [self.frequency, self.reach, self.inertia[0], self.inertia[1]];
        positive.iter().all(|x| (1e-3..=1e3).contains(x))
            && self.most.iter().all(|x| (0.0..=1e5).contains(x))
    }

    /// Its explicit impulse towards a desired pose in a substep of `h` s that begins at share `s` of the tick of `dt`
    /// s. It does not depend on the end of the substep, so that nothing has to be solved with it.
    pub(crate) fn impulse(
        &self,
        target: &TargetPair,
        s: f64,
        dt: f64,
        state: &State,
        h: f64,
    ) -> Spring {
        let Missing { off, rate } = Missing::of(target, state, s, dt);
        let v = &state.velocity;
        let now = [
            Vec3::from_array([v[0], v[1], v[2]]),
            Vec3::from_array([v[3], v[4], v[5]]),
        ];
        let ([mass, inertia], w) = (self.inertia, self.frequency);
        let pull = |k: usize, inertia: f64, most: f64| {
            let pull = (off[k] * (w * w) + (rate[k] - now[k]) * (2.0 * w)) * inertia;
            pull.capped(most) * h
        };
        Spring::given([pull(0, inertia, self.most[1]), pull(1, mass, self.most[0])])
    }

    /// The spring of substep `i`, of `h` s. Implicit: its force is that at the end of the substep.
    pub(crate) fn spring(&self, path: &PelvisPath<'_>, i: usize, state: &State, h: f64) -> Spring {
        let step = path.step(i);
        let off = [
            (step.rotation * state.posture.root_rotation.conjugate()).log(),
            step.position - state.posture.root_position,
        ];
        // The impulse h [k (off + h (v* − v)) + c (v* − v)] is κ (v* + off k h / κ − v).
        let [mass, inertia] = self.inertia;
        let w = self.frequency;
        let part = |k: usize, inertia: f64| {
            let gain = inertia * h * (2.0 * w + h * w * w);
            (
                gain,
                step.velocity[k] + off[k] * (inertia * w * w * h / gain),
            )
        };
        let (turning, moving) = (part(0, inertia), part(1, mass));
        Spring {
            gain: [turning.0, moving.0],
            rest: [turning.1, moving.1],
            most: [self.most[1] * h, self.most[0] * h],
            given: step.is_helped().then_some(step.help),
        }
    }
}

/// A pull on the pelvis of `body` towards a desired pose: a critically damped spring with the given largest force over
/// the weight.
pub fn pull(body: &Body, most: f64) -> PelvisHold {
    let p = body.profile;
    let force = most * p.mass * GRAVITY;
    PelvisHold {
        frequency: FREQUENCY,
        inertia: [p.mass, INERTIA * p.mass * p.height * p.height],
        most: [force, LEVER * force * p.height],
        reach: f64::INFINITY,
    }
}
