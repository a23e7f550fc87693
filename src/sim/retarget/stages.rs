//! Stages of retargeting, from the file to paths and joints in the size of the body.

use super::feet::{Ground, fit_floor};
use super::joints::Joints;
use super::recording::Recording;
use super::report::{Bridged, Origin, PlaceReport, RetargetError, SizeReport};
use super::root::{RootPath, follow_feet};
use super::run_to_walk::RunToWalk;
use super::scene::{RecordedPaths, Scene};
use super::segments::Calibration;
use super::size::{guess_up, measure, unit};
use super::{RetargetOptions, UpAxis};
use crate::body::Body;
use crate::math::{Quat, Vec3};
use crate::motion::bvh::Bvh;
use crate::motion::skeleton_map::{SkeletonMap, map_skeleton};
use crate::plan::contact_labels::label_feet;
use crate::plan::foot_lock::Sole;

/// A file without the frames that are no motion, and without glitches.
pub(super) struct Footage {
    pub map: SkeletonMap,
    pub take: Recording,
    /// Frames per second.
    pub source_rate: f64,
    /// Frames that were left out at the start.
    pub skipped_frames: usize,
    pub bridged: Vec<Bridged>,
}

/// How large the recorded person is.
pub(super) struct Size {
    /// Length of a leg, m.
    pub leg: f64,
    pub stature: f64,
    /// Metres per unit of the file.
    pub unit_m: f64,
    pub up: UpAxis,
}

impl Footage {
    pub(super) fn read(
        bvh: &Bvh,
        source_rate: f64,
        warnings: &mut Vec<String>,
    ) -> Result<Self, RetargetError> {
        let map = map_skeleton(&bvh.joints)?;
        let mut take = Recording::read(bvh, &map)?;
        let skipped_frames = take.skip_pose(source_rate, warnings);
        if take.len() < 2 {
            return Err(RetargetError::TooShort(take.len()));
        }
        Ok(Self {
            bridged: take.bridge(bvh, source_rate, skipped_frames),
            map,
            take,
            source_rate,
            skipped_frames,
        })
    }

    /// Its size and its paths; a root whose place the file does not tell follows the feet.
    pub(super) fn measured(
        &mut self,
        bvh: &Bvh,
        options: &RetargetOptions,
        warnings: &mut Vec<String>,
    ) -> Result<(Size, RecordedPaths), RetargetError> {
        let (take, map) = (&mut self.take, &self.map);
        let (mut places, turns) = take.forward();
        let guessed = || guess_up(&places, take, map);
        let up = options.file.up.unwrap_or_else(guessed);
        let measured = measure(bvh, &places, take, map)?;
        let (unit_m, stature) = unit(options.file.unit_m, measured.stature)?;
        let root = RootPath::of(take, map, up, measured.leg);
        if let Some(warning) = root.warning() {
            let how = (root, up, measured.leg);
            if follow_feet(&mut places, (&*take, map), how, self.source_rate)
                || !Recording::has_positions(bvh, map)
            {
                warnings.push(warning.into());
            }
        }
        let rest = take.rest(bvh);
        take.forget_frames();
        let size = Size {
            leg: measured.leg * unit_m,
            stature,
            unit_m,
            up,
        };
        let recorded = RecordedPaths {
            places,
            turns,
            rest,
            up,
            unit_m,
            source_rate: self.source_rate,
        };
        Ok((size, recorded))
    }
}

impl Size {
    /// * `scale`: body size over recorded size.
    pub(super) fn report(&self, options: &RetargetOptions, scale: f64) -> SizeReport {
        SizeReport {
            unit_m: self.unit_m,
            unit_given: options.file.unit_m.is_some(),
            up: self.up,
            stature: self.stature,
            scale,
        }
    }
}

/// One turn and shift for everything, from the recorded room to the body: level, heading and place of the first sample,
/// size.
struct Placing {
    turn: Quat,
    shift: Vec3,
    scale: f64,
}

impl Placing {
    /// With the recorded pelvis, places and rotations. With `keep_origin` heading and place stay those of the room.
    fn new(
        ground: &Ground,
        scale: f64,
        pelvis: &(Vec<Vec3>, Vec<Quat>),
        keep_origin: bool,
    ) -> (Self, Origin) {
        let first = ground.level * pelvis.1[0];
        let forward = first.rotate(Vec3::X);
        let yaw = forward.y.atan2(forward.x);
        let start = ground.level.rotate(pelvis.0[0]);
        let origin = Origin {
            x: start.x,
            y: start.y,
            yaw,
        };
        let (turn, shift) = if keep_origin {
            // Place is kept in metres of the room; the path about it is in body size.
            let share = 1.0 / scale - 1.0;
            (ground.level, start * share)
        } else {
            let turn = Quat::exp(Vec3::Z * -yaw);
            (turn * ground.level, -turn.rotate(start))
        };
        let shift = shift.horizontal();
        (Self { turn, shift, scale }, origin)
    }

    /// A recorded point, in body size over a floor that lies at `height` in the recording.
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

/// Paths in the size and place of the body, over a level floor at z = 0.
pub(super) struct Fitted {
    pub calibration: Calibration,
    /// Body size over recorded size.
    pub scale: f64,
    ground: Ground,
    placing: Placing,
    origin: Origin,
    ankle_height: f64,
    /// Left and right: ankle, m, and `world_from_foot`.
    pub ankle: [Vec<Vec3>; 2],
    pub foot: [Vec<Quat>; 2],
    /// Origin of the pelvis, m.
    pub pelvis: Vec<Vec3>,
    /// Rotation of the pelvis as recorded, until the joints have it.
    pelvis_turn: Vec<Quat>,
}

impl Fitted {
    pub(super) fn new(
        scene: &Scene<'_>,
        map: &SkeletonMap,
        size: &Size,
        body: &Body,
        options: &RetargetOptions,
    ) -> Self {
        let ankle_height = Sole::new(body, 0).ankle_height;
        let scale = options.scale.unwrap_or(body.leg_length(0) / size.leg);
        let calibration = scene.calibrate(map);
        let mut ankle = [0, 1].map(|s| scene.place(map.sides[s].foot).to_vec());
        let flat = [0, 1].map(|s| scene.flat_samples(map, s, size.leg));
        let mut foot =
            [0, 1].map(|s| scene.foot_frames(map, s, &flat[s], (&calibration, size.leg)));
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
            pelvis: recorded.0.iter().map(|v| placed(*v, height)).collect(),
            pelvis_turn: recorded.1,
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

    /// Which feet are on the floor by their recorded points `feet`; a run that is to be walked is `slowed`, and its
    /// steps are taken so. `rate`: samples per second.
    pub(super) fn steps(
        &mut self,
        feet: &mut [Vec<Vec<Vec3>>; 2],
        slowed: Option<&RunToWalk>,
        rate: f64,
    ) -> Vec<[bool; 2]> {
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
        let mut label = label_feet([&feet[0], &feet[1]], rate);
        if let Some(slowed) = slowed {
            slowed.replace_flights(&mut self.ankle, &mut self.foot, &mut label, rate);
        }
        label
    }

    /// Frames of the upper body, the axes of the knees, and by how much shanks leave the planes of these, rad. Once: it
    /// takes the rotations of the pelvis.
    pub(super) fn joints(
        &mut self,
        scene: &Scene<'_>,
        map: &SkeletonMap,
    ) -> (Joints, [Vec<Vec3>; 2], [f64; 2]) {
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
        let knee_axis = frames.knee_axis.map(|v| place.directed(v));
        (joints, knee_axis, frames.knee_off_axis)
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
