//! Recorded skeletons of any shape onto the body, by geometry.
//!
//! World positions and rotations of the file are smoothed, brought to metres with z up, levelled and scaled by leg length. Each
//! segment's frame comes from its end points and the plane of its hinge; near a straight limb, from the bone's own rotation with the
//! hinge axis that the bent frames of the clip show in it. Trunk, head, hands and feet follow their bones relative to a calibration
//! pose: the file's rest pose if it looks like a standing person, else the most upright frame; so the zero pose of the file means
//! nothing by itself. Relative rotations are split into the joints' own degrees of freedom. Feet and balance: [`super::prepare`].

use super::bvh::Bvh;
use super::clip::{Clip, ClipError};
use super::contacts::{ContactPhase, label_feet, phases};
use super::filter::{
    align_signs, low_pass, low_pass_points, low_pass_rotations, percentile, renormalised,
    resample_points, resample_rotations, speeds,
};
use super::foot_lock::{Sole, turn};
use super::prepare::{Draft, PrepareOptions, Prepared, ZmpOutside, prepare};
use super::skeleton_map::{MapError, SideMap, SkeletonMap, map_skeleton};
use crate::sim::body::topology::{
    BALL_COUNT, DOF_COUNT, DOF_NAMES, HINGE_COUNT, JOINT, Joint, L_FOOT, L_FOREARM, L_HAND,
    L_SHANK, L_UPPER_ARM, R_FOREARM, R_HAND, R_UPPER_ARM, SEGMENT_COUNT, SEGMENT_NAMES, SegmentId,
};
use crate::sim::body::{Body, Posture};
use crate::sim::math::{Mat3, Quat, Vec3};

/// Most frames of a clip: bounds time and memory (8 min at 120 Hz).
pub const MAX_FRAMES: usize = 60_000;
/// Rates that are believed, Hz.
const RATES: (f64, f64) = (10.0, 1000.0);
/// Statures that a unit may lead to when it is guessed, m.
const LIKELY_STATURE: (f64, f64) = (1.3, 2.0);
/// Statures that are accepted with a unit given by the caller, m.
const POSSIBLE_STATURE: (f64, f64) = (0.7, 2.6);
/// Units that files use, m: metre, decimetre, centimetre, millimetre, inch, CMU (inch / 0.45), foot.
const UNITS: [f64; 7] = [1.0, 0.1, 0.01, 0.001, 0.0254, 0.0254 / 0.45, 0.3048];
/// Leg (hip to ankle) over stature, both sexes; about 0.495 for men and 0.465 for women after de Leva 1996.
const LEG_OF_STATURE: f64 = 0.485;
/// Bend below which the plane of a limb is noise, and from which it is trusted, rad.
const PLANE_TRUST: (f64, f64) = (0.26, 0.70);
/// Bend from which a frame tells something about the hinge axis, rad.
const PLANE_LEAST: f64 = 0.30;
/// A bone that turns further than this in one frame and back within [`GLITCH_FRAMES`] is bridged, rad.
const GLITCH_STEP: f64 = 0.45;
/// The same as a speed, rad/s: at low frame rates honest motion turns far in one frame.
const GLITCH_RATE: f64 = 45.0;
/// Longest glitch that is bridged, frames.
const GLITCH_FRAMES: usize = 4;
/// A first frame from which bones jump further than this is a pose, not motion, rad.
const POSE_JUMP: f64 = 0.6;

/// Which axis of the file points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum UpAxis {
    Y,
    Z,
}

/// What the caller knows better than the file, and what to do with the motion. `Default` guesses everything and prepares fully.
#[derive(Clone, Debug, PartialEq)]
pub struct RetargetOptions {
    /// Name of the clip.
    pub name: String,
    /// Metres per unit of the file; guessed from stature if absent.
    pub unit_m: Option<f64>,
    /// Up axis; guessed from where the head is if absent.
    pub up: Option<UpAxis>,
    /// True frame rate of the file, Hz, where its frame time is wrong.
    pub rate_hz: Option<f64>,
    /// Rate of the clip, Hz; absent: the file's own rate if that is 60…240, else 120.
    pub output_rate_hz: Option<f64>,
    /// Body size over recorded size, for paths and heights; absent: ratio of leg lengths. Two people of one recording need one value.
    pub scale: Option<f64>,
    /// Bring the recorded floor to z = 0 (level and height). Otherwise z = 0 of the file is the floor.
    pub floor: bool,
    /// Lock planted feet.
    pub lock_feet: bool,
    /// Shift the trunk so that the zero-moment point stays over the planted feet.
    pub balance: bool,
    /// Cut-off of the zero-phase low-pass, Hz.
    pub cutoff_hz: f64,
    /// Let the motion begin and end standing, with steps before its first and after its last frame where it takes them.
    pub ends: bool,
    /// Keep the file's place and heading (x forward = the file's z where y is up). Otherwise the clip starts at the origin facing +x.
    pub keep_origin: bool,
}

impl Default for RetargetOptions {
    fn default() -> Self {
        Self {
            name: "clip".into(),
            unit_m: None,
            up: None,
            rate_hz: None,
            output_rate_hz: None,
            scale: None,
            floor: true,
            lock_feet: true,
            balance: true,
            ends: true,
            cutoff_hz: 6.0,
            keep_origin: false,
        }
    }
}

/// A retargeted clip with its report.
#[derive(Clone, Debug)]
pub struct Retargeted {
    /// The motion.
    pub clip: Clip,
    /// What was found and done.
    pub report: RetargetReport,
}

/// A segment and the bones of the file that it was read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MappedBone {
    /// Segment name.
    pub segment: &'static str,
    /// Bone names, parent first.
    pub bones: Vec<String>,
}

/// How much of one DOF was outside the body's limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClampedDof {
    /// DOF name.
    pub dof: &'static str,
    /// Largest excess, rad.
    pub max: f64,
    /// Fraction of the samples that were clamped.
    pub fraction: f64,
}

/// A stretch of frames that was replaced by interpolation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bridged {
    /// Bone name.
    pub bone: String,
    /// First replaced frame of the file (0-based).
    pub first: usize,
    /// How many.
    pub count: usize,
}

/// Largest median wrist deviation and flexion that are believed, rad: hand markers are few, so a hand's rest pose is often off.
const WRIST_BIAS: (f64, f64) = (0.15, 0.6);

/// Where the recorded floor and heading went: maps clip to file (metres, z up).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Origin {
    /// Pelvis at the first frame, m, along the file's forward and left axes.
    pub x: f64,
    /// See `x`.
    pub y: f64,
    /// Heading at the first frame, rad.
    pub yaw: f64,
}

/// What retargeting found, guessed and changed.
#[derive(Clone, Debug, PartialEq)]
pub struct RetargetReport {
    /// Segments and their bones.
    pub mapped: Vec<MappedBone>,
    /// Segments without a bone; they keep their neutral angle.
    pub missing: Vec<&'static str>,
    /// True if names failed and the structure of the skeleton decided.
    pub by_structure: bool,
    /// True if the file's left and right were exchanged, told by position.
    pub sides_swapped: bool,
    /// Metres per unit of the file.
    pub unit_m: f64,
    /// True if the caller gave the unit.
    pub unit_given: bool,
    /// Up axis.
    pub up: UpAxis,
    /// Recorded person's stature, m, from leg and trunk length.
    pub stature: f64,
    /// Body size over recorded size.
    pub scale: f64,
    /// Frame rate of the file as used, Hz.
    pub source_rate_hz: f64,
    /// Rate of the clip, Hz.
    pub rate_hz: f64,
    /// Frames left out at the start (T-pose).
    pub skipped_frames: usize,
    /// Height of the recorded floor over z = 0 of the file, m, before scaling.
    pub floor_offset: f64,
    /// Slope of the recorded floor that was levelled.
    pub floor_slope: f64,
    /// Place and heading of the first frame.
    pub origin: Origin,
    /// Angles that had to be clamped.
    pub clamped: Vec<ClampedDof>,
    /// 95th percentile of the angle by which the left and right shank leave the plane of the knee hinge, rad.
    pub knee_off_axis: [f64; 2],
    /// The same for forearm and elbow, rad.
    pub elbow_off_axis: [f64; 2],
    /// Constant angle taken out of the left and right wrist, rad: the recording's hands do not continue its forearms.
    pub wrist_bias: [f64; 2],
    /// Fraction of foot samples in stance that were declared free because the leg's limits do not let it hold the foot in place.
    pub freed: f64,
    /// Largest distance of a planted foot from its place, m: as recorded, and prepared.
    pub foot_slide: (f64, f64),
    /// Largest depth of a sole under the floor in stance, m: as recorded, and prepared.
    pub penetration: (f64, f64),
    /// Which feet the recording has on the floor, without gaps.
    pub phases: Vec<ContactPhase>,
    /// Glitches.
    pub bridged: Vec<Bridged>,
    /// Root mean square distance that smoothing moved the joints, m.
    pub smoothing_rms: f64,
    /// Zero-moment point outside the support polygon before and after balancing.
    pub zmp_outside: (ZmpOutside, ZmpOutside),
    /// Largest shift of the pelvis for balance, m.
    pub shift_max: f64,
    /// Largest lowering of the pelvis so that planted legs reach, m.
    pub pelvis_drop_max: f64,
    /// Fraction of the clip in which something other than the feet carries the body (chair, hands, back).
    pub carried: f64,
    /// What a user should know.
    pub warnings: Vec<String>,
}

/// Why a file cannot be retargeted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RetargetError {
    /// The skeleton has no human shape or names.
    #[error(transparent)]
    Map(#[from] MapError),
    /// Nothing to retarget.
    #[error("{0} frames; a motion needs at least 2")]
    TooShort(usize),
    /// Too much to retarget at once.
    #[error("{frames} frames; at most {MAX_FRAMES} are read: cut the clip")]
    TooLong {
        /// Frames in the file.
        frames: usize,
    },
    /// The rate is no capture rate.
    #[error(
        "rate {rate_hz} Hz is outside {lower}…{upper} Hz; give rate_hz if the file's frame time is wrong"
    )]
    Rate {
        /// Offending value.
        rate_hz: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
    /// No usual unit gives a human stature.
    #[error(
        "the figure measures {measured:.4} file units from sole to crown, which no usual unit makes 1.3 to 2.0 m; give unit_m"
    )]
    Unit {
        /// Stature in file units.
        measured: f64,
    },
    /// The given unit gives no human stature.
    #[error(
        "with unit_m = {unit_m} the figure measures {stature:.3} m ({measured:.4} file units); people measure 0.7 to 2.6 m"
    )]
    Stature {
        /// Unit as given.
        unit_m: f64,
        /// Stature that follows, m.
        stature: f64,
        /// Stature in file units.
        measured: f64,
    },
    /// A bone has no length.
    #[error("bone {bone} has no length")]
    Degenerate {
        /// Name of the upper bone.
        bone: String,
    },
    /// A number is NaN, infinite or absurd.
    #[error("frame {frame}: bone {bone} is not at a finite place")]
    NotFinite {
        /// 0-based.
        frame: usize,
        /// Bone name.
        bone: String,
    },
    /// An option is out of range.
    #[error("{field} {value} is outside {lower}…{upper}")]
    Option {
        /// Option name.
        field: &'static str,
        /// Offending value.
        value: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
    /// The postures do not make a clip.
    #[error(transparent)]
    Clip(#[from] ClipError),
}

/// Retargets a recording onto `body`.
///
/// Offline: time and memory are linear in frames × joints, about 0.2 s for 10 s at 120 Hz.
///
/// # Errors
/// [`RetargetError`] names what is missing: the bone, the unit with the measured figure, the frame.
pub fn retarget(
    bvh: &Bvh,
    body: &Body,
    options: &RetargetOptions,
) -> Result<Retargeted, RetargetError> {
    check_options(options)?;
    let frames = bvh.frame_count;
    if frames < 2 {
        return Err(RetargetError::TooShort(frames));
    }
    if frames > MAX_FRAMES {
        return Err(RetargetError::TooLong { frames });
    }
    let source_rate = options.rate_hz.unwrap_or(1.0 / bvh.frame_time);
    if !(source_rate >= RATES.0 && source_rate <= RATES.1) {
        return Err(RetargetError::Rate {
            rate_hz: source_rate,
            lower: RATES.0,
            upper: RATES.1,
        });
    }
    let mut map = map_skeleton(&bvh.joints)?;
    let mut warnings: Vec<String> = bvh.warnings.clone();
    let mut take = Recording::read(bvh, &map)?;

    // Frames that are no motion, then glitches.
    let skipped_frames = take.skip_pose(source_rate, &mut warnings);
    if take.len() < 2 {
        return Err(RetargetError::TooShort(take.len()));
    }
    let bridged = take.bridge(bvh, source_rate, skipped_frames);
    let (mut places, mut turns) = take.forward();
    let rest = take.rest(bvh);

    // Metres, z up.
    let up = options.up.unwrap_or_else(|| guess_up(&places, &take, &map));
    let measured = measure(bvh, &places, &take, &map)?;
    let (unit_m, stature) = unit(options.unit_m, measured.stature)?;
    for p in &mut places {
        for v in p.iter_mut() {
            *v = z_up(up, *v * unit_m);
        }
    }
    let basis = Quat::from_mat3(&Mat3 {
        x: z_up(up, Vec3::X),
        y: z_up(up, Vec3::Y),
        z: z_up(up, Vec3::Z),
    });
    for t in &mut turns {
        for q in t.iter_mut() {
            *q = basis * *q;
        }
    }
    let rest: Vec<Vec3> = rest.into_iter().map(|v| z_up(up, v * unit_m)).collect();

    // Even samples, smooth.
    let rate = options
        .output_rate_hz
        .unwrap_or(if (59.0..=240.5).contains(&source_rate) {
            source_rate
        } else {
            120.0
        });
    let count = ((((take.len() - 1) as f64) * rate / source_rate + 1e-6).floor() as usize + 1)
        .min(MAX_FRAMES * 4);
    let mut smoothing = (0.0, 0usize);
    let same = (rate - source_rate).abs() < 1e-9;
    let mut feet: [Vec<Vec<Vec3>>; 2] = Default::default();
    for (k, path) in places.iter_mut().enumerate() {
        if !same {
            *path = resample_points(path, source_rate, rate, count);
        }
        for (points, side) in feet.iter_mut().zip(&map.sides) {
            let tip = take.tip(side.toes.unwrap_or(side.foot));
            if [Some(side.foot), side.toes, tip].contains(&Some(take.joints[k])) {
                points.push(path.clone());
            }
        }
        let before = path.clone();
        low_pass_points(path, options.cutoff_hz, rate);
        for (a, b) in before.iter().zip(path.iter()) {
            smoothing.0 += (*a - *b).dot(*a - *b);
            smoothing.1 += 1;
        }
    }
    for path in &mut turns {
        if !same {
            *path = resample_rotations(path, source_rate, rate, count);
        }
        low_pass_rotations(path, options.cutoff_hz, rate);
    }
    let smoothing_rms = (smoothing.0 / smoothing.1.max(1) as f64).sqrt();
    let mut scene = Scene {
        take: &take,
        places,
        turns,
        rest,
        basis,
        count,
        rate,
    };
    let sides_swapped = scene.settle_sides(&mut map);
    if sides_swapped {
        feet.swap(0, 1);
        warnings.push("left and right were exchanged: the file names them the other way round than its feet and knees point".into());
    }

    // Scale, floor, heading.
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let leg = body.joint_offset[L_SHANK.index()].norm() + body.joint_offset[L_FOOT.index()].norm();
    let scale = options.scale.unwrap_or(leg / (measured.leg * unit_m));
    let calibration = scene.calibrate(&map);
    let mut ankle = [0, 1].map(|s| scene.place(map.sides[s].foot).to_vec());
    let feet_flat = [0, 1].map(|s| scene.flat_samples(&map, s, measured.leg * unit_m));
    let mut foot = [0, 1].map(|s| scene.foot_frames(&map, s, &feet_flat[s], &calibration));
    let ground = if options.floor {
        fit_floor(&ankle, &feet_flat)
    } else {
        Ground {
            level: Quat::identity(),
            height: [soles[0].ankle_height / scale; 2],
            slope: 0.0,
        }
    };
    // One turn for everything: level, then heading and place of the first frame.
    let pelvis_raw = scene.pelvis(&map, &calibration);
    let first = ground.level * pelvis_raw.1[0];
    let forward = first.rotate(Vec3::X);
    let yaw = forward.y.atan2(forward.x);
    let start = ground.level.rotate(pelvis_raw.0[0]);
    let origin = Origin {
        x: start.x,
        y: start.y,
        yaw,
    };
    let (turn_to, move_to) = if options.keep_origin {
        // Place is kept in metres of the room; the path about it is in body size.
        (
            ground.level,
            Vec3 {
                x: start.x * (1.0 / scale - 1.0),
                y: start.y * (1.0 / scale - 1.0),
                z: 0.0,
            },
        )
    } else {
        (Quat::exp(Vec3::Z * -yaw) * ground.level, {
            let s = Quat::exp(Vec3::Z * -yaw).rotate(start);
            Vec3 {
                x: -s.x,
                y: -s.y,
                z: 0.0,
            }
        })
    };
    let floor_height = 0.5 * (ground.height[0] + ground.height[1]);
    let move_point = |v: Vec3, height: f64| {
        let p = turn_to.rotate(v) + move_to;
        Vec3 {
            x: p.x * scale,
            y: p.y * scale,
            z: (p.z - height) * scale,
        }
    };
    let ankle_height = soles[0].ankle_height;
    for v in feet.iter_mut().flatten().flatten() {
        *v = turn_to.rotate(*v);
    }
    let label = label_feet([&feet[0], &feet[1]], rate);
    for s in 0..2 {
        for v in &mut ankle[s] {
            *v = move_point(*v, ground.height[s]);
            v.z += ankle_height;
        }
        for q in &mut foot[s] {
            *q = turn_to * *q;
        }
    }
    let pelvis: Vec<Vec3> = pelvis_raw
        .0
        .iter()
        .map(|v| {
            let mut p = move_point(*v, floor_height);
            p.z += ankle_height;
            p
        })
        .collect();

    let turned = |q: Vec<Quat>| -> Vec<Quat> { q.into_iter().map(|q| turn_to * q).collect() };
    let frames = scene.frames(&map, &calibration);
    let chest = turned(frames.chest);
    let draft = Draft {
        rate_hz: rate,
        postures: Vec::new(),
        knee_axis: frames
            .knee_axis
            .map(|axis| axis.into_iter().map(|v| turn_to.rotate(v)).collect()),
        ankle,
        foot,
        label,
    };
    let joints = Joints {
        pelvis: turned(pelvis_raw.1),
        abdomen: turned(frames.abdomen),
        chest,
        head: frames.head.map(turned),
        upper_arm: frames.upper_arm.map(turned),
        forearm_axis: frames
            .forearm
            .map(|axis| axis.into_iter().map(|v| turn_to.rotate(v)).collect()),
        hand: frames.hand.map(turned),
        has_hand: [0, 1].map(|s| map.sides[s].hand.is_some()),
    };
    let (postures, elbow_off_axis, wrist_bias) = joints.postures(&pelvis);
    let mut draft = Draft { postures, ..draft };
    for p in &mut draft.postures {
        p.root_rotation = renormalised(p.root_rotation);
    }
    let phases = phases(&draft.label, rate);
    let how = PrepareOptions {
        lock_feet: options.lock_feet && options.floor,
        balance: options.balance,
    };
    let prepared = prepare(body, &draft, how);
    let (postures, planted, lead_in, lead_out) = if options.ends && how.lock_feet {
        with_ends(body, &draft, &prepared, how)
    } else {
        (prepared.postures, prepared.planted, 0, 0)
    };

    let mut report = RetargetReport {
        mapped: mapped_bones(bvh, &map),
        missing: missing_segments(&map),
        by_structure: map.by_structure,
        sides_swapped,
        unit_m,
        unit_given: options.unit_m.is_some(),
        up,
        stature,
        scale,
        source_rate_hz: source_rate,
        rate_hz: rate,
        skipped_frames,
        floor_offset: floor_height - ankle_height / scale,
        floor_slope: ground.slope,
        origin,
        clamped: (0..DOF_COUNT)
            .filter(|d| prepared.clamped[*d].0 > 0.0)
            .map(|d| ClampedDof {
                dof: DOF_NAMES[d],
                max: prepared.clamped[d].0,
                fraction: prepared.clamped[d].1,
            })
            .collect(),
        knee_off_axis: frames.knee_off_axis,
        elbow_off_axis,
        wrist_bias,
        freed: prepared.freed,
        foot_slide: prepared.slide,
        penetration: prepared.penetration,
        phases,
        bridged,
        smoothing_rms,
        zmp_outside: prepared.zmp,
        shift_max: prepared.shift_max,
        pelvis_drop_max: prepared.drop_max,
        carried: prepared.carried,
        warnings,
    };
    report.note_warnings(calibration.from_rest);
    let clip =
        Clip::from_postures(&options.name, rate, postures, planted)?.with_ends(lead_in, lead_out);
    Ok(Retargeted { clip, report })
}

/// Postures and planted feet with the way into the motion and out of it, and the lengths of both in samples.
fn with_ends(
    body: &Body,
    draft: &Draft,
    prepared: &Prepared,
    how: PrepareOptions,
) -> (Vec<Posture>, Vec<[bool; 2]>, usize, usize) {
    let mut whole = Draft::of_postures(
        body,
        draft.rate_hz,
        prepared.postures.clone(),
        draft.label.clone(),
    );
    let (before, after) = whole.add_ends(body);
    if (before, after) == (0, 0) {
        return (
            prepared.postures.clone(),
            prepared.planted.clone(),
            before,
            after,
        );
    }
    let whole = prepare(body, &whole, how);
    (whole.postures, whole.planted, before, after)
}

impl RetargetReport {
    fn note_warnings(&mut self, from_rest: bool) {
        let w = &mut self.warnings;
        if self.by_structure {
            w.push(
                "bone names told nothing: the shape of the skeleton decided which bone is which"
                    .into(),
            );
        }
        if !self.missing.is_empty() {
            w.push(format!(
                "no bone for {}: held at the neutral angle",
                self.missing.join(", ")
            ));
        }
        if !from_rest {
            w.push("the file's zero pose is no standing person: the most upright frame was taken for calibration".into());
        }
        if !self.bridged.is_empty() {
            let frames: usize = self.bridged.iter().map(|b| b.count).sum();
            w.push(format!("{frames} frames with jumps were bridged"));
        }
        for c in self
            .clamped
            .iter()
            .filter(|c| c.max > 0.17 && c.fraction > 0.02)
        {
            w.push(format!(
                "{} was up to {:.0}° outside the body's limits in {:.0} % of the clip",
                c.dof,
                c.max.to_degrees(),
                100.0 * c.fraction
            ));
        }
        if self.freed > 0.01 {
            w.push(format!(
                "planted feet were let go in {:.0} % of the samples: the legs' limits do not let them stand as recorded",
                100.0 * self.freed
            ));
        }
        if self.carried > 0.02 {
            w.push(format!(
                "in {:.0} % of the clip something other than the feet carries the body (chair, hands, back)",
                100.0 * self.carried
            ));
        }
        let off = self
            .knee_off_axis
            .iter()
            .chain(&self.elbow_off_axis)
            .copied()
            .fold(0.0, f64::max);
        if off > 0.17 {
            w.push(format!(
                "knees or elbows leave their hinge plane by {:.0}° (95th percentile)",
                off.to_degrees()
            ));
        }
    }
}

fn check_options(o: &RetargetOptions) -> Result<(), RetargetError> {
    let check = |field, value: Option<f64>, lower: f64, upper: f64| match value {
        Some(value) if !(value >= lower && value <= upper) => Err(RetargetError::Option {
            field,
            value,
            lower,
            upper,
        }),
        _ => Ok(()),
    };
    check("unit_m", o.unit_m, 1e-6, 1e6)?;
    check("rate_hz", o.rate_hz, RATES.0, RATES.1)?;
    check("output_rate_hz", o.output_rate_hz, 30.0, 240.0)?;
    check("scale", o.scale, 0.05, 20.0)?;
    check("cutoff_hz", Some(o.cutoff_hz), 0.5, 60.0)
}

fn z_up(up: UpAxis, v: Vec3) -> Vec3 {
    match up {
        UpAxis::Y => Vec3 {
            x: v.z,
            y: v.x,
            z: v.y,
        },
        UpAxis::Z => v,
    }
}

fn angle_of(q: Quat) -> f64 {
    q.log().norm()
}

/// The bones that matter, with every ancestor, as local motions.
///
/// A bone's end without a joint of its own (finger tip, toe tip, an ankle's end site) is kept as a *tip*: point number
/// `joint count + joint`, which turns with its joint.
struct Recording {
    /// Point of each kept bone or tip, parents first.
    joints: Vec<usize>,
    /// Index into `joints`, by point.
    index: Vec<Option<usize>>,
    /// Joints in the file.
    joint_count: usize,
    parent: Vec<Option<usize>>,
    /// `[bone][frame]`: rotation and translation relative to the parent bone.
    turn: Vec<Vec<Quat>>,
    step: Vec<Vec<Vec3>>,
}

impl Recording {
    fn read(bvh: &Bvh, map: &SkeletonMap) -> Result<Self, RetargetError> {
        let n = bvh.joints.len();
        let mut keep = vec![false; n];
        let ends = |s: &SideMap| [Some(s.foot), s.toes, s.hand, Some(s.forearm), Some(s.shank)];
        let wanted = map
            .sides
            .iter()
            .flat_map(ends)
            .flatten()
            .chain(map.head)
            .chain(map.trunk.iter().copied());
        for j in wanted {
            let mut at = Some(j);
            while let Some(i) = at {
                if std::mem::replace(&mut keep[i], true) {
                    break;
                }
                at = bvh.joints[i].parent;
            }
        }
        let mut joints: Vec<usize> = (0..n).filter(|i| keep[*i]).collect();
        let mut index = vec![None; 2 * n];
        for (k, j) in joints.iter().enumerate() {
            index[*j] = Some(k);
        }
        let mut parent: Vec<Option<usize>> = joints
            .iter()
            .map(|j| bvh.joints[*j].parent.and_then(|p| index[p]))
            .collect();
        let bones = joints.len();
        // Tips: where a bone ends that has no mapped joint below it.
        let mut tips: Vec<Vec3> = Vec::new();
        for s in &map.sides {
            let tip_of = [
                s.toes.or(Some(s.foot)),
                if s.hand.is_none() {
                    Some(s.forearm)
                } else {
                    None
                },
            ];
            for j in tip_of.into_iter().flatten() {
                let child = (j + 1..n)
                    .find(|c| bvh.joints[*c].parent == Some(j))
                    .map(|c| bvh.joints[c].offset);
                let Some(end) = bvh.joints[j].end_site.or(child).map(Vec3::from_array) else {
                    continue;
                };
                if end.is_finite() && end.norm() > 1e-9 {
                    index[n + j] = Some(joints.len());
                    parent.push(index[j]);
                    joints.push(n + j);
                    tips.push(end);
                }
            }
        }
        let mut turn = vec![Vec::with_capacity(bvh.frame_count); joints.len()];
        let mut step = vec![Vec::with_capacity(bvh.frame_count); joints.len()];
        let mut world = Vec::new();
        for frame in 0..bvh.frame_count {
            bvh.world_into(frame, &mut world);
            for (k, &j) in joints[..bones].iter().enumerate() {
                let (p, q) = (world[j].position, world[j].rotation);
                if !(p.is_finite() && q.is_finite() && p.norm() < 1e9) {
                    return Err(RetargetError::NotFinite {
                        frame,
                        bone: bvh.joints[j].name.clone(),
                    });
                }
                let (local, offset) = match parent[k] {
                    None => (q, p),
                    Some(up) => {
                        let w = &world[joints[up]];
                        let back = w.rotation.conjugate();
                        (back * q, back.rotate(p - w.position))
                    }
                };
                turn[k].push(renormalised(local));
                step[k].push(offset);
            }
            for (k, tip) in tips.iter().enumerate() {
                turn[bones + k].push(Quat::identity());
                step[bones + k].push(*tip);
            }
        }
        for t in &mut turn {
            align_signs(t);
        }
        Ok(Self {
            joints,
            index,
            joint_count: n,
            parent,
            turn,
            step,
        })
    }

    /// Point of the end of `joint`, if it is kept as a tip.
    fn tip(&self, joint: usize) -> Option<usize> {
        let point = self.joint_count + joint;
        self.index[point].map(|_| point)
    }

    /// Point at the wrist of a side, if the file has one.
    fn wrist(&self, side: &SideMap) -> Option<usize> {
        side.hand.or_else(|| self.tip(side.forearm))
    }

    /// Point at the ball or the tip of a foot, if the file has one.
    fn toe(&self, side: &SideMap) -> Option<usize> {
        side.toes.or_else(|| self.tip(side.foot))
    }

    fn len(&self) -> usize {
        self.turn.first().map_or(0, Vec::len)
    }

    fn at(&self, joint: usize) -> usize {
        self.index[joint].expect("every mapped bone is kept")
    }

    /// Largest turns of a single bone from one frame to the next: (second largest angle, rad; root distance).
    fn jump(&self, frame: usize) -> f64 {
        let mut angles: Vec<f64> = self
            .turn
            .iter()
            .map(|t| angle_of(t[frame].conjugate() * t[frame + 1]))
            .collect();
        angles.sort_by(f64::total_cmp);
        // Several bones must jump at once; one alone is a glitch.
        angles.iter().rev().nth(3).copied().unwrap_or(0.0)
    }

    /// Drops a pose (usually a T) held before the motion starts. Returns the number of frames dropped.
    fn skip_pose(&mut self, rate_hz: f64, warnings: &mut Vec<String>) -> usize {
        let n = self.len();
        // The pose may be held for a while; it is over at the first jump, if nothing moved before.
        let mut held = 0;
        let mut cut = 0;
        while held + 1 < n && held < (30.0 * rate_hz) as usize {
            let j = self.jump(held);
            if j > POSE_JUMP.max(12.0 / rate_hz) {
                cut = held + 1;
                break;
            }
            if j > 0.02 {
                break;
            }
            held += 1;
        }
        if cut > 0 && n - cut >= 2 {
            for t in &mut self.turn {
                t.drain(..cut);
            }
            for s in &mut self.step {
                s.drain(..cut);
            }
            warnings.push(format!(
                "the first {cut} frame(s) hold a pose and jump into the motion: left out"
            ));
            return cut;
        }
        0
    }

    /// Replaces short excursions of single bones by interpolation.
    fn bridge(&mut self, bvh: &Bvh, rate_hz: f64, skipped: usize) -> Vec<Bridged> {
        let limit = GLITCH_STEP.max(GLITCH_RATE / rate_hz);
        let n = self.len();
        let mut out = Vec::new();
        for k in 0..self.joints.len() {
            let turn = &mut self.turn[k];
            let mut i = 1;
            while i + 1 < n {
                let step = angle_of(turn[i - 1].conjugate() * turn[i]);
                if step > limit {
                    // The bone must come back: after the glitch it is about where it was before.
                    let back = (i + 1..(i + 1 + GLITCH_FRAMES).min(n))
                        .find(|j| angle_of(turn[i - 1].conjugate() * turn[*j]) < 0.4 * step);
                    if let Some(j) = back {
                        let (a, b) = (turn[i - 1], turn[j]);
                        for m in i..j {
                            turn[m] = a.slerp(b, (m + 1 - i) as f64 / (j + 1 - i) as f64);
                        }
                        out.push(Bridged {
                            bone: bvh.joints[self.joints[k]].name.clone(),
                            first: i + skipped,
                            count: j - i,
                        });
                        i = j;
                    }
                }
                i += 1;
            }
            align_signs(turn);
        }
        out
    }

    /// World positions and rotations, `[bone][frame]`, file units and axes.
    fn forward(&self) -> (Vec<Vec<Vec3>>, Vec<Vec<Quat>>) {
        let (mut places, mut turns) = (self.step.clone(), self.turn.clone());
        for k in 0..self.joints.len() {
            if let Some(p) = self.parent[k] {
                for i in 0..self.len() {
                    let (at, q) = (places[p][i], turns[p][i]);
                    places[k][i] = at + q.rotate(places[k][i]);
                    turns[k][i] = (q * turns[k][i]).normalized();
                }
            }
        }
        (places, turns)
    }

    /// Positions of the kept bones in the file's zero pose.
    fn rest(&self, bvh: &Bvh) -> Vec<Vec3> {
        let mut out: Vec<Vec3> = Vec::with_capacity(self.joints.len());
        for (k, j) in self.joints.iter().enumerate() {
            // A tip's step is the same in every frame.
            let offset = bvh
                .joints
                .get(*j)
                .map_or(self.step[k][0], |b| Vec3::from_array(b.offset));
            out.push(self.parent[k].map_or(Vec3::zero(), |p| out[p]) + offset);
        }
        out
    }
}

/// Lengths of the figure in file units.
struct Measure {
    leg: f64,
    stature: f64,
}

fn measure(
    bvh: &Bvh,
    places: &[Vec<Vec3>],
    take: &Recording,
    map: &SkeletonMap,
) -> Result<Measure, RetargetError> {
    let n = take.len();
    let median_length = |a: usize, b: usize| {
        let v: Vec<f64> = (0..n)
            .step_by((n / 500).max(1))
            .map(|i| (places[take.at(a)][i] - places[take.at(b)][i]).norm())
            .collect();
        percentile(&v, 0.5)
    };
    let mut leg = 0.0;
    for s in &map.sides {
        for (a, b) in [
            (s.thigh, s.shank),
            (s.shank, s.foot),
            (s.upper_arm, s.forearm),
        ] {
            let l = median_length(a, b);
            if !(l > 0.0 && l.is_finite()) {
                return Err(RetargetError::Degenerate {
                    bone: bvh.joints[a].name.clone(),
                });
            }
            if a != s.upper_arm {
                leg += 0.5 * l;
            }
        }
        if !take
            .wrist(s)
            .is_some_and(|w| median_length(s.forearm, w) > 0.0)
        {
            return Err(RetargetError::Degenerate {
                bone: bvh.joints[s.forearm].name.clone(),
            });
        }
    }
    // Hip to shoulder height is about 0.29 of stature; many rigs have odd heads, so head tops are not asked.
    let trunk: Vec<f64> = (0..n)
        .step_by((n / 500).max(1))
        .map(|i| {
            let mid = |a: usize, b: usize| (places[take.at(a)][i] + places[take.at(b)][i]) * 0.5;
            (mid(map.sides[0].upper_arm, map.sides[1].upper_arm)
                - mid(map.sides[0].thigh, map.sides[1].thigh))
            .norm()
        })
        .collect();
    let trunk = percentile(&trunk, 0.8);
    Ok(Measure {
        leg,
        stature: 0.7 * leg / LEG_OF_STATURE + 0.3 * trunk / 0.29,
    })
}

fn unit(given: Option<f64>, measured: f64) -> Result<(f64, f64), RetargetError> {
    match given {
        Some(unit_m) => {
            let stature = measured * unit_m;
            if !(stature >= POSSIBLE_STATURE.0 && stature <= POSSIBLE_STATURE.1) {
                return Err(RetargetError::Stature {
                    unit_m,
                    stature,
                    measured,
                });
            }
            Ok((unit_m, stature))
        }
        None => UNITS
            .into_iter()
            .find(|u| (LIKELY_STATURE.0..=LIKELY_STATURE.1).contains(&(measured * u)))
            .map(|u| (u, measured * u))
            .ok_or(RetargetError::Unit { measured }),
    }
}

/// The axis along which shoulders are over ankles most of the time.
fn guess_up(places: &[Vec<Vec3>], take: &Recording, map: &SkeletonMap) -> UpAxis {
    let mut sum = Vec3::zero();
    for i in 0..take.len() {
        let p = |j: usize| places[take.at(j)][i];
        let top = p(map.sides[0].upper_arm) + p(map.sides[1].upper_arm);
        let low = p(map.sides[0].foot) + p(map.sides[1].foot);
        sum += (top - low).normalized_or(Vec3::zero());
    }
    if sum.z > sum.y { UpAxis::Z } else { UpAxis::Y }
}

/// Per sample: smoothed world positions and rotations, metres, z up.
struct Scene<'a> {
    take: &'a Recording,
    places: Vec<Vec<Vec3>>,
    turns: Vec<Vec<Quat>>,
    rest: Vec<Vec3>,
    basis: Quat,
    count: usize,
    rate: f64,
}

/// How bones carry segments.
struct Calibration {
    /// True if the file's zero pose served, false if a frame of the motion did.
    from_rest: bool,
    /// Figure frame (x forward, y left, z up) of the calibration pose.
    figure: Quat,
    /// Sample of the calibration pose; unused with `from_rest`.
    sample: usize,
}

/// Segment frames per sample.
struct Frames {
    abdomen: Vec<Quat>,
    chest: Vec<Quat>,
    head: Option<Vec<Quat>>,
    upper_arm: [Vec<Quat>; 2],
    forearm: [Vec<Vec3>; 2],
    hand: [Vec<Quat>; 2],
    knee_axis: [Vec<Vec3>; 2],
    knee_off_axis: [f64; 2],
}

/// Rotation whose columns are x = y × z, y (towards `left`, made normal to `up`), z = `up`.
fn frame_of(up: Vec3, left: Vec3) -> Quat {
    let z = up.normalized_or(Vec3::Z);
    let y = (left - z * left.dot(z)).normalized_or(if z.y.abs() < 0.9 { Vec3::Y } else { Vec3::X });
    let y = (y - z * y.dot(z)).normalized_or(Vec3::X);
    Quat::from_mat3(&Mat3 {
        x: y.cross(z),
        y,
        z,
    })
}

/// Shortest rotation that takes unit vector `a` to unit vector `b`.
fn shortest(a: Vec3, b: Vec3) -> Quat {
    let c = a.cross(b);
    let s = c.norm();
    if s < 1e-9 {
        if a.dot(b) > 0.0 {
            return Quat::identity();
        }
        let side = if a.x.abs() < 0.9 { Vec3::X } else { Vec3::Y };
        return Quat::exp(a.cross(side).normalized_or(Vec3::Y) * std::f64::consts::PI);
    }
    Quat::exp(c * (s.atan2(a.dot(b)) / s))
}

fn smoothstep(x: f64, from: f64, to: f64) -> f64 {
    let u = ((x - from) / (to - from)).clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

impl Scene<'_> {
    fn place(&self, joint: usize) -> &[Vec3] {
        &self.places[self.take.at(joint)]
    }
    fn turn(&self, joint: usize) -> &[Quat] {
        &self.turns[self.take.at(joint)]
    }

    /// Direction in which the feet of a sample point, made level in the figure; zero if the file has no toes.
    fn toe_direction(&self, map: &SkeletonMap, s: usize, i: usize) -> Vec3 {
        let side = &map.sides[s];
        self.take.toe(side).map_or(Vec3::zero(), |t| {
            self.place(t)[i] - self.place(side.foot)[i]
        })
    }

    /// Exchanges sides that the file names the wrong way round, told by where feet point and knees bend.
    fn settle_sides(&mut self, map: &mut SkeletonMap) -> bool {
        let mut vote = 0.0;
        let mut arms = 0.0;
        for i in 0..self.count {
            let p = |j: usize| self.place(j)[i];
            let [l, r] = map.sides;
            let hips = (p(l.thigh) + p(r.thigh)) * 0.5;
            let up = ((p(l.upper_arm) + p(r.upper_arm)) * 0.5 - hips).normalized_or(Vec3::Z);
            let left = (p(l.thigh) - p(r.thigh)).normalized_or(Vec3::Y);
            let forward = left.cross(up);
            arms += (p(l.upper_arm) - p(r.upper_arm)).dot(left).signum();
            for (s, side) in map.sides.iter().enumerate() {
                let thigh = (p(side.shank) - p(side.thigh)).normalized_or(Vec3::zero());
                let shank = (p(side.foot) - p(side.shank)).normalized_or(Vec3::zero());
                // A bent knee turns about an axis towards the left.
                vote += thigh.cross(shank).dot(left);
                vote += self
                    .toe_direction(map, s, i)
                    .normalized_or(Vec3::zero())
                    .dot(forward);
            }
        }
        if arms < 0.0 {
            let [l, r] = map.sides;
            for (s, other) in [(0, r), (1, l)] {
                map.sides[s].upper_arm = other.upper_arm;
                map.sides[s].forearm = other.forearm;
                map.sides[s].hand = other.hand;
            }
        }
        if vote < 0.0 {
            map.sides.swap(0, 1);
            return !map.by_structure;
        }
        arms < 0.0 && !map.by_structure
    }

    /// Chooses the calibration pose.
    fn calibrate(&self, map: &SkeletonMap) -> Calibration {
        let rest = |j: usize| self.rest[self.take.at(j)];
        let [l, r] = map.sides;
        let mid = |a: Vec3, b: Vec3| (a + b) * 0.5;
        let pose = |at: &dyn Fn(usize) -> Vec3| {
            let trunk = mid(at(l.upper_arm), at(r.upper_arm)) - mid(at(l.thigh), at(r.thigh));
            let up = trunk.normalized_or(Vec3::Z);
            let across = at(l.thigh) - at(r.thigh);
            let left = across.normalized_or(Vec3::Y);
            let down = |a: usize, b: usize| (at(b) - at(a)).normalized_or(Vec3::zero()).dot(-up);
            let legs = [
                (l.thigh, l.shank),
                (l.shank, l.foot),
                (r.thigh, r.shank),
                (r.shank, r.foot),
            ]
            .into_iter()
            .map(|(a, b)| down(a, b))
            .fold(f64::INFINITY, f64::min);
            (trunk, up, left, across, legs)
        };
        let (trunk, up, left, across, legs) = pose(&rest);
        let standing = trunk.norm() > 1e-9
            && across.norm() > 1e-9
            && legs > 0.75
            && left.dot(up).abs() < 0.3
            && (rest(l.upper_arm) - rest(r.upper_arm)).dot(left) > 0.0;
        if standing {
            // A trunk that leans a little about a file axis was drawn along that axis.
            let axis = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z]
                .into_iter()
                .find(|a| a.dot(up) > 0.95);
            return Calibration {
                from_rest: true,
                figure: frame_of(axis.unwrap_or(up), left),
                sample: 0,
            };
        }
        let upright = |i: usize| {
            let at = |j: usize| self.place(j)[i];
            let (_, up, _, _, legs) = pose(&at);
            up.z + 0.5 * legs
        };
        let sample = (0..self.count)
            .max_by(|a, b| upright(*a).total_cmp(&upright(*b)).then(b.cmp(a)))
            .unwrap_or(0);
        let at = |j: usize| self.place(j)[sample];
        let (_, up, left, _, _) = pose(&at);
        Calibration {
            from_rest: false,
            figure: frame_of(if up.z > 0.85 { Vec3::Z } else { up }, left),
            sample,
        }
    }

    /// Segment frame per sample from a bone's rotation and the segment's frame in the calibration pose (`figure · relative`).
    fn follow(&self, joint: usize, calibration: &Calibration, relative: Quat) -> Vec<Quat> {
        let turns = self.turn(joint);
        let at_calibration = if calibration.from_rest {
            self.basis
        } else {
            turns[calibration.sample]
        };
        let bone_from_segment = at_calibration.conjugate() * calibration.figure * relative;
        turns
            .iter()
            .map(|q| (*q * bone_from_segment).normalized())
            .collect()
    }

    /// Direction of a bone in the calibration pose, figure axes.
    fn calibrated_direction(&self, from: usize, to: usize, calibration: &Calibration) -> Vec3 {
        let d = if calibration.from_rest {
            self.rest[self.take.at(to)] - self.rest[self.take.at(from)]
        } else {
            self.place(to)[calibration.sample] - self.place(from)[calibration.sample]
        };
        calibration
            .figure
            .conjugate()
            .rotate(d)
            .normalized_or(-Vec3::Z)
    }

    fn pelvis(&self, map: &SkeletonMap, calibration: &Calibration) -> (Vec<Vec3>, Vec<Quat>) {
        let [l, r] = map.sides;
        let centre = (0..self.count)
            .map(|i| (self.place(l.thigh)[i] + self.place(r.thigh)[i]) * 0.5)
            .collect();
        let mut turn = self.follow(map.pelvis, calibration, Quat::identity());
        // The line of the hips is better known than the bone's calibration: take the mean difference out.
        let mut sum = Vec3::zero();
        for i in 0..self.count {
            sum += turn[i]
                .conjugate()
                .rotate(self.place(l.thigh)[i] - self.place(r.thigh)[i]);
        }
        let correct = shortest(Vec3::Y, sum.normalized_or(Vec3::Y));
        for q in &mut turn {
            *q = *q * correct;
        }
        (centre, turn)
    }

    /// Hinge axis (towards the left, before any twist) of a two-bone limb per sample, and the off-axis angle of the lower bone.
    ///
    /// `sense` is +1 for a knee (flexion about +y) and −1 for an elbow (about −y).
    fn hinge_axis(
        &self,
        (upper, middle, lower): (usize, usize, usize),
        sense: f64,
        calibration: &Calibration,
    ) -> (Vec<Vec3>, Vec<f64>) {
        let (a, b, c) = (self.place(upper), self.place(middle), self.place(lower));
        let turn = self.turn(upper);
        let normal = |i: usize| {
            let u = (b[i] - a[i]).normalized_or(-Vec3::Z);
            let v = (c[i] - b[i]).normalized_or(u);
            let n = u.cross(v) * sense;
            (u, n, n.norm().atan2(u.dot(v)))
        };
        let mut mean = Vec3::zero();
        let mut weight = 0.0;
        for (i, q) in turn.iter().enumerate() {
            let (_, n, bend) = normal(i);
            if bend > PLANE_LEAST && bend < 2.8 {
                let w = n.norm();
                mean += q.conjugate().rotate(n);
                weight += w;
            }
        }
        // The axis as the bent samples show it, if they are enough and agree; else that of the calibration pose.
        let seen = weight > 0.3 * 0.1 * self.rate && mean.norm() > 0.8 * weight;
        let local = if seen {
            mean.normalized_or(Vec3::Y)
        } else {
            let direction = self.calibrated_direction(upper, middle, calibration);
            let axis = calibration
                .figure
                .rotate(shortest(-Vec3::Z, direction).rotate(Vec3::Y));
            let q = if calibration.from_rest {
                self.basis
            } else {
                turn[calibration.sample]
            };
            q.conjugate().rotate(axis)
        };
        let mut axis = Vec::with_capacity(self.count);
        let mut off = Vec::new();
        for (i, q) in turn.iter().enumerate() {
            let (u, n, bend) = normal(i);
            let own = q.rotate(local);
            let own = (own - u * own.dot(u)).normalized_or(Vec3::Y);
            let plane = n.normalized_or(own);
            let agree = plane.dot(own);
            if bend > PLANE_LEAST {
                let v = (c[i] - b[i]).normalized_or(u);
                off.push(v.dot(own).abs().clamp(0.0, 1.0).asin());
            }
            let w = smoothstep(bend, PLANE_TRUST.0, PLANE_TRUST.1)
                * (1.0 - smoothstep(bend, 2.6, 2.9))
                * smoothstep(agree, 0.3, 0.7);
            axis.push((own * (1.0 - w) + plane * w).normalized_or(own));
        }
        (axis, off)
    }

    fn frames(&self, map: &SkeletonMap, calibration: &Calibration) -> Frames {
        let chest_bone = map.trunk.last().copied().unwrap_or(map.pelvis);
        let chest = self.follow(chest_bone, calibration, Quat::identity());
        let pelvis = self.pelvis(map, calibration).1;
        let abdomen = if map.trunk.len() >= 2 {
            self.follow(map.trunk[map.abdomen], calibration, Quat::identity())
        } else {
            // One bone bends the trunk: both of our joints share it.
            pelvis
                .iter()
                .zip(&chest)
                .map(|(p, c)| p.slerp(*c, 0.5))
                .collect()
        };
        let head = map
            .head
            .map(|h| self.follow(h, calibration, Quat::identity()));
        let mut knee_off_axis = [0.0; 2];
        let knee_axis = [0, 1].map(|s| {
            let m = &map.sides[s];
            let (axis, off) = self.hinge_axis((m.thigh, m.shank, m.foot), 1.0, calibration);
            knee_off_axis[s] = percentile(&off, 0.95);
            axis
        });
        let mut upper_arm: [Vec<Quat>; 2] = Default::default();
        let mut forearm: [Vec<Vec3>; 2] = Default::default();
        let mut hand: [Vec<Quat>; 2] = Default::default();
        for s in 0..2 {
            let m = &map.sides[s];
            let wrist = self
                .take
                .wrist(m)
                .expect("measured before: every forearm has an end");
            let (shoulder, elbow) = (self.place(m.upper_arm), self.place(m.forearm));
            let hand_place = self.place(wrist);
            forearm[s] = (0..self.count)
                .map(|i| (hand_place[i] - elbow[i]).normalized_or(-Vec3::Z))
                .collect();
            let axis = self
                .hinge_axis((m.upper_arm, m.forearm, wrist), -1.0, calibration)
                .0;
            upper_arm[s] = (0..self.count)
                .map(|i| frame_of(shoulder[i] - elbow[i], axis[i]))
                .collect();
            let bone = m.hand.unwrap_or(m.forearm);
            let direction = self.calibrated_direction(m.forearm, wrist, calibration);
            hand[s] = self.follow(bone, calibration, shortest(-Vec3::Z, direction));
        }
        Frames {
            abdomen,
            chest,
            head,
            upper_arm,
            forearm,
            hand,
            knee_axis,
            knee_off_axis,
        }
    }
}

/// Where the recorded floor is: rotation that levels it, ankle height over it for each foot (after levelling), slope.
struct Ground {
    level: Quat,
    height: [f64; 2],
    slope: f64,
}

impl Scene<'_> {
    /// Samples in which a foot stands flat: slow, ankle low among the slow ones.
    fn flat_samples(&self, map: &SkeletonMap, s: usize, leg: f64) -> Vec<usize> {
        let ankle = self.place(map.sides[s].foot);
        let hip = self.place(map.sides[s].thigh);
        let speed = speeds(ankle, self.rate);
        // Under a standing or squatting body only: feet of someone who lies are slow and low, and not flat.
        let slow: Vec<usize> = (0..self.count)
            .filter(|i| speed[*i] < 0.25 && hip[*i].z - ankle[*i].z > 0.4 * leg)
            .collect();
        let heights: Vec<f64> = slow.iter().map(|i| ankle[*i].z).collect();
        let low = percentile(&heights, 0.15);
        slow.into_iter()
            .filter(|i| (ankle[*i].z - low).abs() < 0.012)
            .collect()
    }

    /// `world_from_foot` per sample: x from ankle to toes made level while the foot stands flat, z up then.
    fn foot_frames(
        &self,
        map: &SkeletonMap,
        s: usize,
        flat: &[usize],
        calibration: &Calibration,
    ) -> Vec<Quat> {
        let side = &map.sides[s];
        let turns = self.turn(side.foot);
        let toe = self.take.toe(side);
        let from_rest = || {
            let ahead = toe.map_or(Vec3::X, |t| {
                self.calibrated_direction(side.foot, t, calibration)
            });
            let yaw = if ahead.x.hypot(ahead.y) > 0.2 {
                ahead.y.atan2(ahead.x)
            } else {
                0.0
            };
            self.follow(side.foot, calibration, Quat::exp(Vec3::Z * yaw))
        };
        let Some(toe) = toe.filter(|_| flat.len() >= 5) else {
            return from_rest();
        };
        let toe = self.place(toe);
        let ankle = self.place(side.foot);
        let mut sum = [0.0; 4];
        let mut first: Option<Quat> = None;
        for &i in flat {
            let d = toe[i] - ankle[i];
            // Standing means the sole is down; a foot that lies on its side or hangs tells nothing.
            if d.x.hypot(d.y) < 0.5 * d.norm() {
                continue;
            }
            let q = turns[i].conjugate() * Quat::exp(Vec3::Z * d.y.atan2(d.x));
            let like = *first.get_or_insert(q);
            let sign = if like
                .to_xyzw()
                .iter()
                .zip(q.to_xyzw())
                .map(|(a, b)| a * b)
                .sum::<f64>()
                < 0.0
            {
                -1.0
            } else {
                1.0
            };
            for (s, c) in sum.iter_mut().zip(q.to_xyzw()) {
                *s += sign * c;
            }
        }
        let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
        // Scattered answers (norm well below the count) are no calibration.
        if length < 0.9 * flat.len() as f64 {
            return from_rest();
        }
        let bone_from_foot = renormalised(Quat::from_xyzw(sum.map(|c| c / length)));
        turns
            .iter()
            .map(|q| (*q * bone_from_foot).normalized())
            .collect()
    }
}

/// Fits the floor to ankles of flat feet: height, and slope where the feet visit enough ground to tell.
fn fit_floor(ankle: &[Vec<Vec3>; 2], flat: &[Vec<usize>; 2]) -> Ground {
    let mut points = Vec::new();
    for s in 0..2 {
        let own = flat[s].iter().map(|i| ankle[s][*i]);
        // The feet may be at different heights over their joints: compare slopes, not levels.
        let mean = percentile(&own.clone().map(|p| p.z).collect::<Vec<_>>(), 0.5);
        points.extend(own.map(|p| Vec3 { z: p.z - mean, ..p }));
    }
    let n = points.len().max(1) as f64;
    let centre = points.iter().fold(Vec3::zero(), |s, p| s + *p) * (1.0 / n);
    // Regularised least squares: a spread of 0.2 m halves what the data says, so a spot of floor is taken as level.
    let (mut xx, mut xy, mut yy, mut xz, mut yz) = (0.05 * n, 0.0, 0.05 * n, 0.0, 0.0);
    for p in &points {
        let d = *p - centre;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        xz += d.x * d.z;
        yz += d.y * d.z;
    }
    let det = xx * yy - xy * xy;
    let (sx, sy) = if det > 1e-9 {
        ((xz * yy - yz * xy) / det, (yz * xx - xz * xy) / det)
    } else {
        (0.0, 0.0)
    };
    // Steeper than 5 % is no floor but a motion that the fit misread.
    let slope = sx.hypot(sy);
    let (sx, sy) = if slope < 0.05 { (sx, sy) } else { (0.0, 0.0) };
    let normal = Vec3 {
        x: -sx,
        y: -sy,
        z: 1.0,
    }
    .normalized_or(Vec3::Z);
    let level = shortest(normal, Vec3::Z);
    let heights = [0, 1].map(|s| {
        let of_flat: Vec<f64> = flat[s]
            .iter()
            .map(|i| level.rotate(ankle[s][*i]).z)
            .collect();
        if of_flat.len() >= 5 {
            Some(percentile(&of_flat, 0.5))
        } else {
            None
        }
    });
    let lowest = || {
        let all: Vec<f64> = ankle.iter().flatten().map(|p| level.rotate(*p).z).collect();
        percentile(&all, 0.02)
    };
    let height = match heights {
        // Both feet stand on one floor: more than 4 cm apart, the lower one is right.
        [Some(a), Some(b)] if (a - b).abs() < 0.04 => [a, b],
        [Some(a), Some(b)] => [a.min(b); 2],
        [Some(a), None] | [None, Some(a)] => [a; 2],
        [None, None] => [lowest(); 2],
    };
    Ground {
        level,
        height,
        slope: sx.hypot(sy),
    }
}

/// World frames of the upper body per sample, ready to be split into joints.
struct Joints {
    pelvis: Vec<Quat>,
    abdomen: Vec<Quat>,
    chest: Vec<Quat>,
    head: Option<Vec<Quat>>,
    upper_arm: [Vec<Quat>; 2],
    /// Direction from elbow to wrist.
    forearm_axis: [Vec<Vec3>; 2],
    hand: [Vec<Quat>; 2],
    has_hand: [bool; 2],
}

const UPPER_ARM: [SegmentId; 2] = [L_UPPER_ARM, R_UPPER_ARM];
const FOREARM: [SegmentId; 2] = [L_FOREARM, R_FOREARM];
const HAND: [SegmentId; 2] = [L_HAND, R_HAND];

fn ball(s: SegmentId) -> usize {
    match JOINT[s.index()] {
        Joint::Ball(b) => b,
        _ => unreachable!("{} is a ball joint", SEGMENT_NAMES[s.index()]),
    }
}

fn hinge(s: SegmentId) -> usize {
    match JOINT[s.index()] {
        Joint::Hinge1(h) | Joint::Hinge2(h) => h,
        _ => unreachable!("{} is a hinge", SEGMENT_NAMES[s.index()]),
    }
}

impl Joints {
    /// Joint positions; legs are left at zero. Also, per side, the 95th percentile of the angle between forearm and elbow plane and
    /// the bias that was taken out of the wrist.
    fn postures(&self, pelvis_path: &[Vec3]) -> (Vec<Posture>, [f64; 2], [f64; 2]) {
        use crate::sim::body::topology::{ABDOMEN, CHEST, HEAD};
        let n = pelvis_path.len();
        let mut out = vec![Posture::default(); n];
        let mut off_axis: [Vec<f64>; 2] = Default::default();
        let mut wrist_bias = [0.0f64; 2];
        for (i, p) in out.iter_mut().enumerate() {
            p.root_position = pelvis_path[i];
            p.root_rotation = self.pelvis[i];
            p.ball[ball(ABDOMEN)] = self.pelvis[i].conjugate() * self.abdomen[i];
            p.ball[ball(CHEST)] = self.abdomen[i].conjugate() * self.chest[i];
            if let Some(head) = &self.head {
                p.ball[ball(HEAD)] = self.chest[i].conjugate() * head[i];
            }
        }
        for s in 0..2 {
            // Sign of the axes about z (pronation) and x (wrist flexion): left −, right +.
            let m = if s == 0 { -1.0 } else { 1.0 };
            let (elbow, wrist) = (hinge(FOREARM[s]), hinge(HAND[s]));
            let mut before = 0.0f64;
            for (i, p) in out.iter_mut().enumerate() {
                let upper = self.upper_arm[s][i];
                p.ball[ball(UPPER_ARM[s])] = self.chest[i].conjugate() * upper;
                let d = upper.conjugate().rotate(self.forearm_axis[s][i]);
                let flexion = d.x.atan2(-d.z);
                off_axis[s].push(d.y.abs().clamp(0.0, 1.0).asin());
                p.hinge[elbow] = flexion;
                // Forearm twist, then wrist: M = Rz(α) Rx(β) Ry(γ).
                let bent = upper * Quat::exp(Vec3::Y * -flexion);
                let w = (bent.conjugate() * self.hand[s][i]).to_mat3();
                let (sin_b, level) = (w.y.z, w.y.x.hypot(w.y.y));
                let beta = sin_b.atan2(level);
                // A hand bent by 90° leaves the twist undefined: hold it.
                let twist = if level > 0.2 {
                    (-w.y.x).atan2(w.y.y)
                } else {
                    before
                };
                let twist = before + turn(before, twist);
                before = twist;
                p.hinge[elbow + 1] = m * twist;
                if self.has_hand[s] {
                    p.hinge[wrist] = m * beta;
                    p.hinge[wrist + 1] = -(-w.x.z).atan2(w.z.z);
                }
            }
            for (h, most) in [(wrist, WRIST_BIAS.1), (wrist + 1, WRIST_BIAS.0)] {
                let angles: Vec<f64> = out.iter().map(|p| p.hinge[h]).collect();
                let median = percentile(&angles, 0.5);
                let bias = median - median.clamp(-most, most);
                out.iter_mut().for_each(|p| p.hinge[h] -= bias);
                wrist_bias[s] = wrist_bias[s].max(bias.abs());
            }
        }
        (
            out,
            [
                percentile(&off_axis[0], 0.95),
                percentile(&off_axis[1], 0.95),
            ],
            wrist_bias,
        )
    }
}

/// Low-pass of all joint positions of a motion, in place; the pelvis is left alone.
pub(super) fn smooth_joints(postures: &mut [Posture], cutoff_hz: f64, rate_hz: f64) {
    for b in 0..BALL_COUNT {
        let mut q: Vec<Quat> = postures.iter().map(|p| p.ball[b]).collect();
        low_pass_rotations(&mut q, cutoff_hz, rate_hz);
        for (p, q) in postures.iter_mut().zip(q) {
            p.ball[b] = q;
        }
    }
    for h in 0..HINGE_COUNT {
        let mut a: Vec<f64> = postures.iter().map(|p| p.hinge[h]).collect();
        low_pass(&mut a, cutoff_hz, rate_hz);
        for (p, a) in postures.iter_mut().zip(a) {
            p.hinge[h] = a;
        }
    }
}

fn mapped_bones(bvh: &Bvh, map: &SkeletonMap) -> Vec<MappedBone> {
    let names = |bones: &[usize]| {
        bones
            .iter()
            .map(|b| bvh.joints[*b].name.clone())
            .collect::<Vec<_>>()
    };
    let split = (map.abdomen + 1).min(map.trunk.len());
    // A single bone bends both joints of our trunk.
    let (waist, thorax) = if map.trunk.len() == 1 {
        (&map.trunk[..], &map.trunk[..])
    } else {
        map.trunk.split_at(split)
    };
    let mut out = Vec::new();
    let mut add = |s: usize, bones: Vec<String>| {
        if !bones.is_empty() {
            out.push(MappedBone {
                segment: SEGMENT_NAMES[s],
                bones,
            });
        }
    };
    add(0, names(&[map.pelvis]));
    add(1, names(waist));
    add(2, names(thorax));
    add(3, names(map.head.as_slice()));
    for (s, side) in map.sides.iter().enumerate() {
        let (arm, leg) = ([4, 7][s], [10, 14][s]);
        add(arm, names(&[side.upper_arm]));
        add(arm + 1, names(&[side.forearm]));
        add(arm + 2, names(side.hand.as_slice()));
        add(leg, names(&[side.thigh]));
        add(leg + 1, names(&[side.shank]));
        add(leg + 2, names(&[side.foot]));
        add(leg + 3, names(side.toes.as_slice()));
    }
    out.sort_by_key(|m| {
        SEGMENT_NAMES
            .iter()
            .position(|n| *n == m.segment)
            .unwrap_or(SEGMENT_COUNT)
    });
    out
}

fn missing_segments(map: &SkeletonMap) -> Vec<&'static str> {
    let mut out = Vec::new();
    if map.trunk.is_empty() {
        out.extend([SEGMENT_NAMES[1], SEGMENT_NAMES[2]]);
    }
    if map.head.is_none() {
        out.push(SEGMENT_NAMES[3]);
    }
    for (s, side) in map.sides.iter().enumerate() {
        if side.hand.is_none() {
            out.push(SEGMENT_NAMES[[6, 9][s]]);
        }
        if side.toes.is_none() {
            out.push(SEGMENT_NAMES[[13, 17][s]]);
        }
    }
    out
}
