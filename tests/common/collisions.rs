//! Scenes with obstacles: an obstacle at rest, and the balances of momentum, work and overlap of a world in which
//! bodies collide.

use sinew_evaluate::audit;
use sinew_physics::collide::{Mobility, ObstacleSetup, Other, Shape};
use sinew_physics::figure::{FigureEvent, Flags};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::world::World;

/// An obstacle at rest.
pub fn obstacle(shape: Shape, mobility: Mobility, position: Vec3) -> ObstacleSetup {
    ObstacleSetup {
        name: "obstacle".to_owned(),
        shape,
        mobility,
        friction: 0.6,
        position,
        rotation: Quat::identity(),
        velocity: Vec3::zero(),
        angular_velocity: Vec3::zero(),
    }
}

/// Measurements of a run of a world with collisions.
#[derive(Debug, Default)]
pub struct Meter {
    ticks: u64,
    touched: u64,
    switches: u64,
    /// Largest sum of all forces between bodies over the largest of them.
    unbalanced: f64,
    /// Largest overlap, and the largest later than 0.2 s after the first touch, m.
    depth: f64,
    late_depth: f64,
    /// Work of contacts, J, and the largest work in one tick by which they drove a motion instead of stopping it.
    work: f64,
    gain: f64,
    unfinished: u64,
    islands: u64,
    iterations: u64,
    residual: f64,
    speed: f64,
    first: Option<u64>,
}

/// Largest work that the correction of overlaps of a fraction of a millimetre may add in a tick, J.
const RETURN_WORK: f64 = 0.02;

impl Meter {
    /// Checks the bounds of every scene, and prints the measurements on one line.
    pub fn judge(&self, what: &str, rate: f64) {
        let text = format!(
            "{what}: touched {} ticks, {:.1} switches/s, unbalanced {:.1e}, equations {:.1e}, overlap {:.2} mm, after \
             0.2 s {:.2} mm, work of contacts {:.1} J, driven at most {:.4} J, {} of {} islands cut short, {:.1} \
             iterations each, top joint speed {:.0} rad/s",
            self.touched,
            self.switches as f64 * rate / self.ticks as f64,
            self.unbalanced,
            self.residual,
            1e3 * self.depth,
            1e3 * self.late_depth,
            self.work,
            self.gain,
            self.unfinished,
            self.islands,
            self.iterations as f64 / self.islands.max(1) as f64,
            self.speed
        );
        println!("{text}");
        assert!(self.touched > 0, "{text}");
        assert!(self.unbalanced < 1e-9 && self.residual < 1e-9, "{text}");
        assert!(self.late_depth < 0.01, "{text}");
        assert!(self.gain < RETURN_WORK && self.work <= 0.0, "{text}");
    }

    pub fn observe(&mut self, world: &World) {
        self.ticks += 1;
        let c = world.collisions();
        let (mut sum, mut most, mut touching) = (Vec3::zero(), 0.0f64, false);
        for (_, f) in world.figures() {
            let r = f.report().unwrap();
            assert!(r.joints.over_limit <= 1e-9, "torques stay within strength");
            assert!(!r.flags.has(Flags::QUARANTINED));
            for t in &r.touches {
                touching = true;
                most = most.max(t.force.norm());
                let free = match t.other {
                    Other::Figure(..) => true,
                    Other::Obstacle(k) => world.obstacle(k).unwrap().mass().is_some(),
                };
                if free {
                    sum += t.force;
                }
            }
            for e in f.events() {
                let switch = matches!(e, FigureEvent::Touched { .. } | FigureEvent::Parted { .. });
                self.switches += u64::from(switch);
            }
            self.speed = f.state().velocity[6..]
                .iter()
                .fold(self.speed, |m, v| m.max(v.abs()));
            let a = audit::audit(f.links(), &r.audit, world.params().gravity);
            self.residual = self.residual.max(a.relative);
        }
        // The floor's push is among the forces of a ball that lies on it, and cannot be told from the others.
        let mut on_floor = false;
        for (_, o) in world.obstacles() {
            if o.mass().is_some() {
                sum += o.force();
                let s = o.setup();
                on_floor |=
                    matches!(s.shape, Shape::Sphere { radius } if s.position.z < radius + 1e-3);
            }
        }
        if most > 0.0 && !on_floor {
            self.unbalanced = self.unbalanced.max(sum.norm() / most);
        }
        if touching {
            self.touched += 1;
            self.first.get_or_insert(self.ticks);
        }
        self.depth = self.depth.max(c.depth);
        if self.first.is_some_and(|f| self.ticks > f + 12) {
            self.late_depth = self.late_depth.max(c.depth);
        }
        self.work += c.work;
        self.gain = self.gain.max(c.driven);
        self.unfinished += c.unfinished;
        self.islands += c.islands;
        self.iterations += c.iterations;
    }
}
