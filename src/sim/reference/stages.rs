//! Stages of fitting, from a recording to paths and joints in the size of the body.

use super::error::RetargetError;
use super::feet::{Ground, fit_floor};
use super::joints::Joints;
use super::options::RetargetOptions;
use super::report::{PlaceReport, RecordingOrigin, SizeReport};
use super::root::{RootEvidence, RootFollowing};
use super::run_to_walk::RunToWalk;
use super::scene::{RecordedPaths, RecordedScene};
use super::segments::{Calibration, PelvisPath};
use super::size::{FileUnit, guess_up, measure, unit};
use super::take::Take;
use crate::body::Body;
use crate::math::{Quat, Vec3};
use crate::motion::recording::{Recording, UpAxis};
use crate::motion::skeleton_map::SkeletonMap;

/// Size of the recorded person.
pub(super) struct Size {
    /// Length of a leg, m.
    pub leg: f64,
    pub stature: f64,
    /// Metres per unit of the file.
    pub unit_m: f64,
    /// Whether the caller or the file states the unit.
    pub unit_given: bool,
    pub up: UpAxis,
}

/// A recording with the size of its person and its paths in the world.
pub(super) struct MeasuredRecording {
    pub size: Size,
    pub paths: RecordedPaths,
}

/// Size and paths of a recording; a root whose place the file does not state follows the feet. Uses up the frames of
/// `take`.
pub(super) fn measured(
    recording: &Recording,
    take: &mut Take<'_>,
    options: &RetargetOptions,
    source_rate: f64,
    warnings: &mut Vec<String>,
) -> Result<MeasuredRecording, RetargetError> {
    let map = &recording.map;
    let mut world = take.forward();
    let given = options.file.up.or(recording.facts.up);
    let up = given.unwrap_or_else(|| guess_up(&world.places, take, map));
    let measured = measure(&world.places, take, map)?;
    let given = options.file.unit_m.or(recording.facts.unit_m);
    let FileUnit { unit_m, stature } = unit(given, measured.stature)?;
    let path = RootEvidence::of(take, map, up, measured.leg);
    if let Some(warning) = path.warning() {
        let root = RootFollowing {
            take,
            map,
            path,
            up,
            leg: measured.leg,
            rate_hz: source_rate,
        };
        if root.follow_feet(&mut world.places) || !recording.has_positions() {
            warnings.push(warning.into());
        }
    }
    let rest = take.rest();
    take.forget_frames();
    let size = Size {
        leg: measured.leg * unit_m,
        stature,
        unit_m,
        unit_given: given.is_some(),
        up,
    };
    let paths = RecordedPaths {
        world,
        rest,
        up,
        unit_m,
        source_rate,
    };
    Ok(MeasuredRecording { size, paths })
}

impl Size {
    /// * `scale`: body size over recorded size.
    pub(super) fn report(&self, scale: f64) -> SizeReport {
        SizeReport {
            unit_m: self.unit_m,
            unit_given: self.unit_given,
            up: self.up,
            stature: self.stature,
            scale,
        }
    }
}

/// One turn, shift and scale for everything, from the recorded room to the body: level, heading and place of the first
/// sample, size.
struct Placing {
    turn: Quat,
    shift: Vec3,
    scale: f64,
}

impl Placing {
    /// Based on the recorded pelvis. With `keep_origin`, heading and place stay those of the room.
    fn new(
        ground: &Ground,
        scale: f64,
        pelvis: &PelvisPath,
        keep_origin: bool,
    ) -> (Self, RecordingOrigin) {
        let first = ground.level * pelvis.rotations[0];
        let forward = first.rotate(Vec3::X);
        let yaw = forward.y.atan2(forward.x);
        let start = ground.level.rotate(pelvis.places[0]);
        let origin = RecordingOrigin {
            x: start.x,
            y: start.y,
            yaw,
        };
        let (turn, shift) = if keep_origin {
            // Place is kept in metres of the room; the path around it is in body size.
            let share = 1.0 / scale - 1.0;
            (ground.level, start * share)
        } else {
            let turn = Quat::exp(Vec3::Z * -yaw);
            (turn * ground.level, -turn.rotate(start))
        };
        let shift = shift.horizontal();
        (Self { turn, shift, scale }, origin)
    }

    /// A recorded point in body size, over a floor at `height` in the recording.
    fn point(&self, v: Vec3, height: f64) -> Vec3 {
        let p = self.turn.rotate(v) + self.shift;
        Vec3 {
            x: p.x * self.scale,
            y: p.y * self.scale,
            z: (p.z - height) * self.scale,
        }
    }

    fn turned(&self, q: Vec<Quat>) -> Vec<Quat> {
        q.into_iter().map(|q| self.turn * q).collect()
    }

    fn directed(&self, v: Vec<Vec3>) -> Vec<Vec3> {
        v.into_iter().map(|v| self.turn.rotate(v)).collect()
    }
}

/// Frames of the segments in the axes of the clip.
pub(super) struct Limbs {
    /// Joints of the upper body.
    pub joints: Joints,
    /// Axes of the left and the right knee.
    pub knee_axis: [Vec<Vec3>; 2],
    /// Angle by which the shanks leave the planes of the knees, rad.
    pub knee_off_axis: [f64; 2],
}

/// Paths in the size and place of the body, over a level floor at z = 0.
pub(super) struct FittedPaths {
    pub calibration: Calibration,
    /// Body size over recorded size.
    pub scale: f64,
    ground: Ground,
    placing: Placing,
    origin: RecordingOrigin,
    ankle_height: f64,
    /// Left and right: ankle, m, and `world_from_foot`.
    pub ankle: [Vec<Vec3>; 2],
    pub foot: [Vec<Quat>; 2],
    /// Origin of the pelvis, m.
    pub pelvis: Vec<Vec3>,
    /// Rotation of the pelvis as recorded, until it has passed to the joints.
    pelvis_turn: Vec<Quat>,
}

impl FittedPaths {
    pub(super) fn new(
        scene: &RecordedScene<'_>,
        map: &SkeletonMap,
        size: &Size,
        body: &Body,
        options: &RetargetOptions,
    ) -> Self {
        let ankle_height = body.ankle_height(0);
        let scale = options.scale.unwrap_or(body.leg_length(0) / size.leg);
        let calibration = scene.calibrate(map);
        let mut ankle = [0, 1].map(|s| scene.place(map.sides[s].foot).to_vec());
        let flat = [0, 1].map(|s| scene.flat_samples(map, s, size.leg));
        let mut foot = [0, 1].map(|s| scene.foot_frames(map, s, &flat[s], &calibration, size.leg));
        let ground = if options.floor {
            fit_floor(&ankle, &flat)
        } else {
            Ground {
                level: Quat::identity(),
                height: [ankle_height / scale; 2],
                slope: 0.0,
            }
        };
        let recorded = scene.pelvis(map, &calibration);
        let (placing, origin) = Placing::new(&ground, scale, &recorded, options.keep_origin);
        let placed = |v: Vec3, height: f64| {
            let mut p = placing.point(v, height);
            p.z += ankle_height;
            p
        };
        for s in 0..2 {
            for v in &mut ankle[s] {
                *v = placed(*v, ground.height[s]);
            }
            for q in &mut foot[s] {
                *q = placing.turn * *q;
            }
        }
        let height = ground.middle();
        Self {
            pelvis: recorded.places.iter().map(|v| placed(*v, height)).collect(),
            pelvis_turn: recorded.rotations,
            calibration,
            scale,
            ground,
            placing,
            origin,
            ankle_height,
            ankle,
            foot,
        }
    }

    /// Brings the recorded points of the feet into the axes of the clip; the path of a run that is to be walked is
    /// shortened with them. `rate`: samples per second.
    pub(super) fn place_feet(
        &mut self,
        feet: &mut [Vec<Vec<Vec3>>; 2],
        slowed: Option<&RunToWalk>,
        rate: f64,
    ) {
        for v in feet.iter_mut().flatten().flatten() {
            *v = self.placing.turn.rotate(*v);
        }
        if let Some(slowed) = slowed {
            for v in feet.iter_mut().flatten().flatten() {
                *v = (*v + self.placing.shift) * self.scale;
            }
            let others = self.ankle.iter_mut().chain(feet.iter_mut().flatten());
            slowed.shorten_path(&mut self.pelvis, others);
            slowed.damp_bounces(&mut self.pelvis, rate);
            for v in feet.iter_mut().flatten().flatten() {
                *v = *v * (1.0 / self.scale);
            }
        }
    }

    /// Frames of the upper body and axes of the knees. Takes the rotations of the pelvis, so it may be called only
    /// once.
    pub(super) fn limbs(&mut self, scene: &RecordedScene<'_>, map: &SkeletonMap) -> Limbs {
        let frames = scene.frames(map, &self.calibration);
        let place = &self.placing;
        let joints = Joints {
            pelvis: place.turned(std::mem::take(&mut self.pelvis_turn)),
            abdomen: place.turned(frames.abdomen),
            chest: place.turned(frames.chest),
            head: frames.head.map(|q| place.turned(q)),
            upper_arm: frames.upper_arm.map(|q| place.turned(q)),
            forearm_axis: frames.forearm.map(|v| place.directed(v)),
            hand: frames.hand.map(|q| place.turned(q)),
            has_hand: [0, 1].map(|s| map.sides[s].hand.is_some()),
        };
        Limbs {
            knee_axis: frames.knee_axis.map(|v| place.directed(v)),
            knee_off_axis: frames.knee_off_axis,
            joints,
        }
    }

    pub(super) fn place_report(&self) -> PlaceReport {
        PlaceReport {
            floor_offset: self.ground.middle() - self.ankle_height / self.scale,
            floor_slope: self.ground.slope,
            origin: self.origin,
        }
    }
}

impl Ground {
    /// Height of the ankles over it, in the middle between both feet.
    fn middle(&self) -> f64 {
        0.5 * (self.height[0] + self.height[1])
    }
}
