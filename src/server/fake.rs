//! Temporary stand-in for parts of `sim` that are being written; deleted when they land.
#![allow(missing_docs)]
use crate::sim::body::*;
use crate::sim::figure::*;
use crate::sim::math::*;
use crate::sim::motion::*;
use std::sync::Arc;

pub struct WorldParams {
    pub rate_hz: f64,
    pub substeps: u32,
    pub gravity: f64,
    pub friction: f64,
    pub threads: usize,
}
pub struct FigureSetup {
    pub body: Arc<Body>,
    pub strength: StrengthScale,
    pub controller: ControllerKind,
    pub stepper: StepperKind,
    pub params: ControlParams,
    pub state: State,
    pub name: String,
}
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FigureKey(pub u64);
pub struct PlanarTransform {
    pub x: f64,
    pub y: f64,
    pub yaw: f64,
}
pub struct ClipPlayback {
    pub clip: Arc<Clip>,
    pub start: f64,
    pub speed: f64,
    pub looped: bool,
    pub origin: PlanarTransform,
}
pub enum Drive {
    Hold(Posture),
    Clip(ClipPlayback),
    External(Box<TargetPair>),
}
#[derive(Debug, thiserror::Error)]
#[error("fake")]
pub struct WorldError;
#[derive(Clone, Copy, Debug)]
pub enum FigureEvent {
    SupportGained { segment: SegmentId },
    SupportLost { segment: SegmentId },
    Saturated { dof: usize },
    Relieved { dof: usize },
    BalanceLost,
    Recovered,
    Fell,
    LoadTaken { segment: SegmentId, mass: f64 },
    LoadDropped { segment: SegmentId, mass: f64 },
    Quarantined,
}
pub struct Figure {
    setup: FigureSetup,
    state: State,
    target: TargetPair,
    drive: Drive,
    report: Option<TickReport>,
    events: Vec<FigureEvent>,
    perturbations: Vec<Perturbation>,
}
impl Figure {
    pub fn body(&self) -> &Arc<Body> {
        &self.setup.body
    }
    pub fn state(&self) -> &State {
        &self.state
    }
    pub fn report(&self) -> Option<&TickReport> {
        self.report.as_ref()
    }
    pub fn target(&self) -> &TargetPair {
        &self.target
    }
    pub fn set_drive(&mut self, d: Drive) {
        self.drive = d;
    }
    pub fn add_perturbation(&mut self, p: Perturbation) -> Result<(), WorldError> {
        self.perturbations.push(p);
        Ok(())
    }
    pub fn clear_perturbations(&mut self) {
        self.perturbations.clear();
    }
    pub fn reset(&mut self, s: State) {
        self.state = s;
    }
    pub fn set_strength(&mut self, s: StrengthScale) {
        self.setup.strength = s;
    }
    pub fn set_controller(&mut self, c: ControllerKind) {
        self.setup.controller = c;
    }
    pub fn events(&self) -> &[FigureEvent] {
        &self.events
    }
}
pub struct World {
    params: WorldParams,
    tick: u64,
    figures: Vec<(FigureKey, Figure)>,
    next: u64,
}
impl World {
    pub fn new(params: WorldParams) -> Result<World, WorldError> {
        Ok(World {
            params,
            tick: 0,
            figures: vec![],
            next: 0,
        })
    }
    pub fn tick(&self) -> u64 {
        self.tick
    }
    pub fn time(&self) -> f64 {
        self.tick as f64 / self.params.rate_hz
    }
    pub fn dt(&self) -> f64 {
        1.0 / self.params.rate_hz
    }
    pub fn add_figure(&mut self, setup: FigureSetup) -> Result<FigureKey, WorldError> {
        let key = FigureKey(self.next);
        self.next += 1;
        let t = Target::still(setup.state.posture);
        self.figures.push((
            key,
            Figure {
                state: setup.state,
                target: TargetPair {
                    now: t.clone(),
                    next: t,
                },
                drive: Drive::Hold(setup.state.posture),
                report: None,
                events: vec![],
                perturbations: vec![],
                setup,
            },
        ));
        Ok(key)
    }
    pub fn remove_figure(&mut self, k: FigureKey) -> bool {
        let n = self.figures.len();
        self.figures.retain(|f| f.0 != k);
        n != self.figures.len()
    }
    pub fn figure(&self, k: FigureKey) -> Option<&Figure> {
        self.figures.iter().find(|f| f.0 == k).map(|f| &f.1)
    }
    pub fn figure_mut(&mut self, k: FigureKey) -> Option<&mut Figure> {
        self.figures.iter_mut().find(|f| f.0 == k).map(|f| &mut f.1)
    }
    pub fn step(&mut self) {
        let t = (self.tick + 1) as f64 / self.params.rate_hz;
        for (_, f) in &mut self.figures {
            let next = match &f.drive {
                Drive::Hold(p) => Target::still(*p),
                Drive::Clip(c) => c.clip.sample((t - c.start) * c.speed),
                Drive::External(p) => p.next.clone(),
            };
            f.target = TargetPair {
                now: f.target.next.clone(),
                next,
            };
            f.state.posture = f.target.next.posture;
            f.state.velocity = f.target.next.velocity;
            f.events.clear();
            if self.tick == 0 {
                f.events.push(FigureEvent::SupportGained {
                    segment: topology::L_FOOT,
                });
            }
            let audit = Audit {
                state: f.state,
                acceleration: [0.0; NV],
                torque: [0.0; DOF_COUNT],
                ligament_torque: [0.0; DOF_COUNT],
                contacts: vec![],
                applied: vec![],
            };
            f.report = Some(TickReport {
                torque: [1.0; DOF_COUNT],
                ligament_torque: [0.0; DOF_COUNT],
                torque_lower: [-100.0; DOF_COUNT],
                torque_upper: [100.0; DOF_COUNT],
                over_limit: 0.0,
                acceleration: [0.0; NV],
                saturated: 0,
                saturated_secondary: 0,
                contacts: vec![ContactPoint {
                    segment: topology::L_FOOT,
                    vertex: 0,
                    position: Vec3::zero(),
                    force: crate::sim::math::vec3::vec3(0.0, 0.0, 700.0),
                }],
                main_support: None,
                support_ratio: [0.0; SEGMENT_COUNT],
                support_polygon: vec![],
                zmp: None,
                margin: None,
                com: Vec3::zero(),
                com_velocity: Vec3::zero(),
                com_desired: Vec3::zero(),
                joint_error: [0.0; DOF_COUNT],
                penetration: 0.0,
                control_iterations: 1,
                step_iterations: 1,
                flags: Flags::default(),
                audit,
            });
        }
        self.tick += 1;
    }
    pub fn state_hash(&self) -> u64 {
        let mut h = 0xcbf29ce484222325u64 ^ self.tick;
        for (_, f) in &self.figures {
            for v in f
                .state
                .velocity
                .iter()
                .chain(f.state.posture.hinge.iter())
                .chain(f.state.posture.root_position.to_array().iter())
            {
                h = (h ^ v.to_bits()).wrapping_mul(0x100000001b3);
            }
        }
        h
    }
}

pub struct Clip {
    name: String,
    rate: f64,
    postures: Vec<Posture>,
}
#[derive(Debug, thiserror::Error)]
#[error("fake")]
pub struct ClipError;
impl Clip {
    pub fn from_postures(
        name: &str,
        rate_hz: f64,
        postures: Vec<Posture>,
        _planted: Vec<[bool; 2]>,
    ) -> Result<Clip, ClipError> {
        Ok(Clip {
            name: name.into(),
            rate: rate_hz,
            postures,
        })
    }
    pub fn name(&self) -> &str {
        &self.name
    }
    pub fn rate_hz(&self) -> f64 {
        self.rate
    }
    pub fn len(&self) -> usize {
        self.postures.len()
    }
    pub fn duration(&self) -> f64 {
        (self.len() - 1) as f64 / self.rate
    }
    pub fn posture(&self, i: usize) -> &Posture {
        &self.postures[i]
    }
    pub fn planted(&self, _i: usize) -> [bool; 2] {
        [true; 2]
    }
    pub fn sample_looped(&self, t: f64) -> Target {
        self.sample(t % self.duration())
    }
    pub fn sample(&self, t: f64) -> Target {
        let i = (t.max(0.0) * self.rate).min((self.len() - 1) as f64) as usize;
        Target::still(self.postures[i])
    }
}
pub const BUILTIN_NAMES: [&str; 6] = ["idle", "lift", "squat", "wave", "step", "walk"];
pub fn builtin(body: &Body, name: &str) -> Option<Clip> {
    if !BUILTIN_NAMES.contains(&name) {
        return None;
    }
    let postures = (0..121)
        .map(|i| {
            let mut p = Posture::default();
            p.root_position.z = body.standing_root_height();
            p.hinge[4] = (i as f64 / 60.0).sin();
            p
        })
        .collect();
    Clip::from_postures(name, 60.0, postures, vec![]).ok()
}
pub struct RetargetReport;
#[derive(Default)]
pub struct RetargetOptions {
    pub unit_m: Option<f64>,
    pub rate_hz: Option<f64>,
    pub floor: bool,
    pub lock_feet: bool,
    pub cutoff_hz: f64,
}
pub struct Retargeted {
    pub clip: Clip,
    pub report: RetargetReport,
}
pub fn retarget(bvh: &Bvh, body: &Body, _o: &RetargetOptions) -> Result<Retargeted, ClipError> {
    let postures = (0..bvh.frame_count)
        .map(|i| {
            let mut p = Posture::default();
            p.root_position.z = body.standing_root_height();
            p.hinge[4] = (i as f64 / 60.0).sin();
            p
        })
        .collect();
    Ok(Retargeted {
        clip: Clip::from_postures("bvh", 120.0, postures, vec![])?,
        report: RetargetReport,
    })
}
pub fn mjcf(_b: &Body) -> String {
    "<mujoco/>".into()
}
pub fn urdf(_b: &Body) -> String {
    "<robot/>".into()
}
