//! Clips and live desired motion.

use super::super::pb;
use super::super::posture::{segment_of_bone, set_joint_rotation};
use super::super::status::Fault;
use super::super::types::{
    BvhReading, ClipBeginning, ClipInfo, ClipStart, Delay, DriveOpen, DriveSettings, Feedback,
    FigureSample, FollowSettings, FollowUpdate, MAX_DRIVEN_FIGURES, MotionSample, MotionSource,
    Playback, RehearsalInfo, Supply,
};
use super::names::{BODY, CLIP};
use super::{
    WORLD_EXTENT, client_id, or_default, place, rotation, shortened, timestamp, vector, within,
};
use sinew_physics::body::angles::set_anatomical_angles;
use sinew_physics::body::topology::{BONE_NAMES, PARENT, SEGMENT_NAMES};
use sinew_physics::body::{DOF_COUNT, NV, Posture, SEGMENT_COUNT};
use sinew_physics::figure::FollowMode;
use sinew_physics::forecast::{Forecast, ForecastVerdict};
use sinew_physics::math::Quat;
use sinew_physics::motion::UpAxis;
use sinew_physics::plan::ReadingReport;
use sinew_physics::plan::contact_labels::ContactPhase;
use sinew_physics::rehearsal::follow::{Follow, FollowWay};
use std::fmt::Display;
use std::sync::Arc;
use std::time::Duration;

/// Most frames in one batch.
pub const MAX_BATCH_FRAMES: usize = 64;
/// Most frames of a clip given as frames.
pub const MAX_CLIP_FRAMES: usize = sinew_physics::motion::clip::MAX_SAMPLES;

fn optional(field: &str, value: Option<f64>, least: f64, most: f64) -> Result<Option<f64>, Fault> {
    value.map(|v| within(field, v, least, most)).transpose()
}

/// The reading options of a BVH file.
pub fn bvh_reading(field: &str, o: Option<&pb::BvhOptions>) -> Result<BvhReading, Fault> {
    let Some(o) = o else {
        return Ok(BvhReading::default());
    };
    let at = |part: &str| format!("{field}.{part}");
    Ok(BvhReading {
        unit_m: optional(&at("unit_m"), o.unit_m, 1e-6, 100.0)?,
        z_up: match o.up_axis.as_str() {
            "" => None,
            "y" | "Y" | "+y" => Some(false),
            "z" | "Z" | "+z" => Some(true),
            other => {
                return Err(Fault::invalid(
                    at("up_axis"),
                    format!("must be y or z, got {:?}", shortened(other)),
                ));
            }
        },
        rate_hz: optional(&at("rate_hz"), o.rate_hz, 1.0, 1000.0)?,
        floor: o.fit_floor,
        lock_feet: o.lock_feet,
        cutoff_hz: optional(&at("cutoff_hz"), o.cutoff_hz, 0.5, 60.0)?,
        walk_runs: o.walk_runs,
    })
}

/// A BVH file with its options, to be followed by these means. The file itself is parsed elsewhere.
pub fn bvh(
    source: pb::BvhSource,
    max_bytes: u64,
    follow: FollowSettings,
) -> Result<MotionSource, Fault> {
    let field = "bvh";
    if source.data.is_empty() {
        return Err(Fault::invalid(format!("{field}.data"), "must not be empty"));
    }
    if source.data.len() as u64 > max_bytes {
        return Err(Fault::Exhausted {
            limit: "max_clip_bytes",
            value: max_bytes,
            message: format!("the file has {} bytes", source.data.len()),
            retry: None,
        });
    }
    let mut reading = bvh_reading(&format!("{field}.options"), source.options.as_ref())?;
    // Help does what the strength of a runner lacks.
    (reading.walk_runs).get_or_insert(!follow.follow.takes_help());
    Ok(MotionSource::Bvh(source.data, reading))
}

/// The motion of a new clip, to be followed by these means.
pub fn clip_source(
    source: Option<pb::create_clip_request::Source>,
    max_bytes: u64,
    follow: FollowSettings,
) -> Result<MotionSource, Fault> {
    use pb::create_clip_request::Source;
    match source {
        None => Err(Fault::invalid("source", "must be bvh or frames")),
        Some(Source::Bvh(b)) => bvh(b, max_bytes, follow),
        Some(Source::Frames(f)) => {
            let rate_hz = within("frames.rate_hz", f.rate_hz, 1.0, 1000.0)?;
            if !(2..=MAX_CLIP_FRAMES).contains(&f.frames.len()) {
                return Err(Fault::invalid(
                    "frames.frames",
                    format!("must be 2…{MAX_CLIP_FRAMES} frames, got {}", f.frames.len()),
                ));
            }
            let mut postures = Vec::with_capacity(f.frames.len());
            let mut planted = Vec::new();
            for (i, frame) in f.frames.iter().enumerate() {
                let at = format!("frames.frames[{i}]");
                let s = figure_sample(&at, 0, frame)?;
                if !s.has_root {
                    return Err(Fault::invalid(format!("{at}.root"), "must be given"));
                }
                postures.push(s.posture);
                match s.planted {
                    Some(p) if planted.len() == i => planted.push(p),
                    None if planted.is_empty() => {}
                    _ => {
                        return Err(Fault::invalid(
                            format!("{at}.planted"),
                            "must be given in every frame or in none",
                        ));
                    }
                }
            }
            Ok(MotionSource::Postures {
                rate_hz,
                postures,
                planted,
            })
        }
    }
}

/// The manner of playing a clip that is followed by the means `follow`, unless the request says otherwise.
pub fn playback(r: &pb::PlayClipRequest, follow: FollowSettings) -> Result<Playback, Fault> {
    let follow = follow.changed(follow_update("", r.follow, r.max_help_weights)?);
    Ok(Playback {
        max_help: follow.most_help(),
        speed: or_default("speed", r.speed, 1.0, 0.1, 4.0)?,
        looped: r.r#loop,
        start: optional("start_time_s", r.start_time_s, 0.0, 1e9)?,
        reset: r.reset,
        place: r.placement.map(|p| place("placement", p)).transpose()?,
    })
}

/// Header of a drive; `field` is its place in the request.
pub fn drive_open(
    field: &str,
    h: &pb::DriveHeader,
    principal: &Arc<str>,
) -> Result<DriveOpen, Fault> {
    let at = |part: &str| format!("{field}.{part}");
    let world = super::world_name(&at("world"), &h.world)?.to_owned();
    if h.figure_ids.is_empty() || h.figure_ids.len() > MAX_DRIVEN_FIGURES {
        return Err(Fault::invalid(
            at("figure_ids"),
            format!(
                "must name 1…{MAX_DRIVEN_FIGURES} figures, got {}",
                h.figure_ids.len()
            ),
        ));
    }
    for (i, name) in h.figure_ids.iter().enumerate() {
        if h.figure_ids[..i].contains(name) {
            return Err(Fault::invalid(
                at(&format!("figure_ids[{i}]")),
                format!("{:?} is named twice", shortened(name)),
            ));
        }
    }
    let ms = |part: &str, value: Option<f64>, default: f64, most: f64| {
        within(at(part), value.unwrap_or(default), 0.0, most).map(|v| v / 1e3)
    };
    let extrapolation = ms(
        "extrapolation_limit_ms",
        h.extrapolation_limit_ms,
        100.0,
        1000.0,
    )?;
    let extrapolation = match pb::Underrun::try_from(h.underrun) {
        Ok(pb::Underrun::Unspecified | pb::Underrun::Extrapolate) => extrapolation,
        Ok(pb::Underrun::Hold) => 0.0,
        Err(_) => {
            return Err(Fault::invalid(
                at("underrun"),
                format!("{} is not a choice", h.underrun),
            ));
        }
    };
    let most = or_default(
        &at("max_playout_delay_ms"),
        h.max_playout_delay_ms,
        100.0,
        1.0,
        2000.0,
    )? / 1e3;
    Ok(DriveOpen {
        who: super::control::key(principal, &at("control_tokens"), &h.control_tokens)?,
        world,
        figures: h.figure_ids.clone(),
        driver: client_id(&at("driver_id"), &h.driver_id)?,
        settings: DriveSettings {
            rate_hz: or_default(&at("nominal_rate_hz"), h.nominal_rate_hz, 60.0, 1.0, 1000.0)?,
            delay: match h.playout_delay_ms {
                Some(d) => Delay::Fixed(within(at("playout_delay_ms"), d, 0.0, 2000.0)? / 1e3),
                None => Delay::Adaptive { most },
            },
            extrapolation,
            hold: ms("hold_limit_ms", h.hold_limit_ms, 5000.0, 600_000.0)?,
            grace: ms("grace_ms", h.grace_ms, 5000.0, 60_000.0)?,
            reset: h.reset,
            window: h
                .preparation_window_ms
                .map(|w| window(&at("preparation_window_ms"), w))
                .transpose()?,
        },
    })
}

/// A window in ms as seconds: none, or one long enough to be useful.
fn window(field: &str, ms: f64) -> Result<f64, Fault> {
    let (least, most) = sinew_physics::plan::stream::WINDOW;
    if ms == 0.0 {
        return Ok(0.0);
    }
    let (least, most) = (least * 1e3, most * 1e3);
    // Written so that NaN fails.
    if ms >= least && ms <= most {
        Ok(ms / 1e3)
    } else {
        Err(Fault::invalid(
            field,
            format!("must be 0 or {least}…{most}, got {ms}"),
        ))
    }
}

/// Desired motion of one figure.
pub fn figure_sample(
    field: impl Display + Copy,
    slot: usize,
    m: &pb::FigureMotion,
) -> Result<FigureSample, Fault> {
    let at = |part: &str| format!("{field}.{part}");
    let mut posture = Posture::default();
    if let Some(root) = &m.root {
        if let Some(p) = root.position_m {
            posture.root_position =
                vector(format_args!("{field}.root.position_m"), p, WORLD_EXTENT)?;
        }
        if let Some(q) = root.rotation {
            posture.root_rotation = rotation(format_args!("{field}.root.rotation"), q)?;
        }
    }
    match (m.joint_angles_rad.is_empty(), m.bone_rotations.is_empty()) {
        (false, false) => {
            return Err(Fault::invalid(
                at("bone_rotations"),
                "must be empty when joint angles are given",
            ));
        }
        (true, true) => {
            return Err(Fault::invalid(
                at("joint_angles_rad"),
                "joint angles or bone rotations must be given",
            ));
        }
        (false, true) => {
            let angles: &[f64; DOF_COUNT] =
                m.joint_angles_rad.as_slice().try_into().map_err(|_| {
                    Fault::invalid(
                        at("joint_angles_rad"),
                        format!(
                            "must hold {DOF_COUNT} angles, got {}",
                            m.joint_angles_rad.len()
                        ),
                    )
                })?;
            const TURN: f64 = 2.0 * std::f64::consts::PI;
            for (d, a) in angles.iter().enumerate() {
                within(
                    format_args!("{field}.joint_angles_rad[{d}]"),
                    *a,
                    -TURN,
                    TURN,
                )?;
            }
            set_anatomical_angles(&mut posture, angles);
        }
        (true, false) => bone_rotations(field, m, &mut posture)?,
    }
    let velocity = match m.velocity.len() {
        0 => None,
        NV => {
            let mut v = Box::new([0.0; NV]);
            for (i, x) in m.velocity.iter().enumerate() {
                v[i] = within(format_args!("{field}.velocity[{i}]"), *x, -1000.0, 1000.0)?;
            }
            Some(v)
        }
        n => {
            return Err(Fault::invalid(
                at("velocity"),
                format!("must hold {NV} numbers or none, got {n}"),
            ));
        }
    };
    let planted = match m.planted[..] {
        [] => None,
        [left, right] => Some([left, right]),
        _ => {
            return Err(Fault::invalid(
                at("planted"),
                format!("must hold 2 values or none, got {}", m.planted.len()),
            ));
        }
    };
    Ok(FigureSample {
        slot,
        posture,
        has_root: m.root.is_some(),
        velocity,
        planted,
    })
}

fn bone_rotations(
    field: impl Display,
    m: &pb::FigureMotion,
    posture: &mut Posture,
) -> Result<(), Fault> {
    let mut given: [Option<Quat>; SEGMENT_COUNT] = [None; SEGMENT_COUNT];
    for (i, b) in m.bone_rotations.iter().enumerate() {
        let at = |part: &str| format!("{field}.bone_rotations[{i}].{part}");
        let s = segment_of_bone(&b.bone).ok_or_else(|| {
            Fault::invalid(
                at("bone"),
                format!(
                    "must be one of {}, got {:?}",
                    BONE_NAMES.join(", "),
                    shortened(&b.bone)
                ),
            )
        })?;
        if given[s].is_some() {
            return Err(Fault::invalid(
                at("bone"),
                format!("{} is given twice", b.bone),
            ));
        }
        let q = b
            .rotation
            .ok_or_else(|| Fault::invalid(at("rotation"), "must be given"))?;
        given[s] = Some(rotation(
            format_args!("{field}.bone_rotations[{i}].rotation"),
            q,
        )?);
    }
    let world = match pb::RotationSpace::try_from(m.rotation_space) {
        Ok(pb::RotationSpace::Unspecified | pb::RotationSpace::Parent) => false,
        Ok(pb::RotationSpace::World) => true,
        Err(_) => {
            return Err(Fault::invalid(
                format!("{field}.rotation_space"),
                format!("{} is not a choice", m.rotation_space),
            ));
        }
    };
    // World rotations computed from the joints, so that rotation dropped by a hinge does not turn the segments beyond
    // it.
    let mut world_from = [Quat::identity(); SEGMENT_COUNT];
    if let Some(q) = given[0] {
        posture.root_rotation = q;
    }
    world_from[0] = posture.root_rotation;
    for s in 1..SEGMENT_COUNT {
        let parent = world_from[PARENT[s]];
        let local = match given[s] {
            None => Quat::identity(),
            Some(q) if world => (parent.conjugate() * q).normalized(),
            Some(q) => q,
        };
        set_joint_rotation(posture, s, local);
        world_from[s] = (parent * super::super::posture::joint_rotation(posture, s)).normalized();
    }
    Ok(())
}

/// Number of desired postures in a batch: they determine the cost of its conversion and use.
pub fn postures(batch: &pb::MotionBatch) -> usize {
    batch.frames.iter().map(|f| f.figures.len()).sum()
}

/// A batch of desired motion for the figures of a drive.
pub fn batch(
    field: &str,
    batch: &pb::MotionBatch,
    figures: &[String],
) -> Result<Vec<MotionSample>, Fault> {
    if batch.frames.len() > MAX_BATCH_FRAMES {
        return Err(Fault::invalid(
            format!("{field}.frames"),
            format!(
                "must be at most {MAX_BATCH_FRAMES} frames, got {}",
                batch.frames.len()
            ),
        ));
    }
    let mut out = Vec::with_capacity(batch.frames.len());
    for (i, frame) in batch.frames.iter().enumerate() {
        let at = format!("{field}.frames[{i}]");
        if frame.sequence < 0 {
            return Err(Fault::invalid(
                format!("{at}.sequence"),
                format!("must not be negative, got {}", frame.sequence),
            ));
        }
        if frame.figures.is_empty() || frame.figures.len() > figures.len() {
            return Err(Fault::invalid(
                format!("{at}.figures"),
                format!(
                    "must hold 1…{} figures, got {}",
                    figures.len(),
                    frame.figures.len()
                ),
            ));
        }
        let mut samples: Vec<FigureSample> = Vec::with_capacity(frame.figures.len());
        for (j, m) in frame.figures.iter().enumerate() {
            let slot = if m.figure_id.is_empty() && figures.len() == 1 {
                0
            } else {
                figures
                    .iter()
                    .position(|f| *f == m.figure_id)
                    .ok_or_else(|| {
                        Fault::invalid(
                            format!("{at}.figures[{j}].figure_id"),
                            format!(
                                "must be a figure of the header, got {:?}",
                                shortened(&m.figure_id)
                            ),
                        )
                    })?
            };
            if samples.iter().any(|s| s.slot == slot) {
                return Err(Fault::invalid(
                    format!("{at}.figures[{j}].figure_id"),
                    format!("{:?} is given twice", shortened(&m.figure_id)),
                ));
            }
            samples.push(figure_sample(format_args!("{at}.figures[{j}]"), slot, m)?);
        }
        out.push(MotionSample {
            sequence: frame.sequence,
            source_ns: frame.source_time_ns,
            figures: samples,
        });
    }
    Ok(out)
}

/// State of a drive for a response.
pub fn feedback_out(f: &Feedback) -> pb::DriveFeedback {
    pb::DriveFeedback {
        driver_id: f.driver.clone(),
        tick: f.tick as i64,
        received_sequence: f.received_sequence,
        refused_batch_count: f.refused as i64,
        figures: f
            .figures
            .iter()
            .map(|g| pb::FigureFeedback {
                figure_id: g.figure.clone(),
                applied_sequence: g.applied_sequence,
                applied_source_time_ns: g.applied_source_ns,
                buffered_ms: g.buffered * 1e3,
                playout_delay_ms: g.delay * 1e3,
                jitter_ms: g.jitter * 1e3,
                supply: match g.supply {
                    Supply::None => pb::Supply::Unspecified,
                    Supply::Present => pb::Supply::Present,
                    Supply::Interpolated => pb::Supply::Interpolated,
                    Supply::Extrapolated => pb::Supply::Extrapolated,
                    Supply::Held => pb::Supply::Held,
                    Supply::Relaxed => pb::Supply::Relaxed,
                    Supply::Waiting => pb::Supply::Waiting,
                }
                .into(),
                present_count: g.ticks[0] as i64,
                interpolated_count: g.ticks[1] as i64,
                extrapolated_count: g.ticks[2] as i64,
                held_count: g.ticks[3] as i64,
                relaxed_count: g.ticks[4] as i64,
                late_count: g.late as i64,
                stale_count: g.stale as i64,
                overflow_count: g.overflow as i64,
                preparation_window_ms: g.window * 1e3,
                resync_count: g.resyncs as i64,
                behind_ms: g.behind * 1e3,
            })
            .collect(),
    }
}

/// The reading report of a file, for a response.
pub fn report_out(r: &ReadingReport) -> pb::RetargetReport {
    pb::RetargetReport {
        mapped: { r.skeleton.mapped.iter() }
            .map(|m| pb::BoneMapping {
                bone: bone_of(m.segment),
                joints: m.bones.clone(),
            })
            .collect(),
        missing_bones: r.skeleton.missing.iter().map(|s| bone_of(s)).collect(),
        by_structure: r.skeleton.by_structure,
        sides_swapped: r.skeleton.sides_swapped,
        scale: r.size.scale,
        source_rate_hz: r.frames.source_rate_hz,
        run_speed_mps: r.runs.speed,
        runs_walked: r.runs.walked,
        unit_m: r.size.unit_m,
        up_axis: match r.size.up {
            UpAxis::Y => "y",
            UpAxis::Z => "z",
        }
        .into(),
        stature_m: r.size.stature,
        floor_offset_m: r.place.floor_offset,
        clamped: { r.clamped.iter() }
            .map(|c| pb::ClampedAngle {
                dof: c.dof.into(),
                fraction: c.fraction,
                max_excess_rad: c.max,
            })
            .collect(),
        foot_slide_before_m: r.feet.slide.recorded,
        foot_slide_after_m: r.feet.slide.prepared,
        bridged_frame_count: { r.frames.bridged.iter() }.map(|b| b.count as i32).sum(),
        contact_phases: r.feet.phases.iter().flat_map(stances_of).collect(),
        warnings: r.warnings.clone(),
        dropped_frame_count: r.frames.skipped_frames as i32,
    }
}

/// Name of the bone of a segment.
fn bone_of(segment: &str) -> String {
    let i = SEGMENT_NAMES.iter().position(|s| *s == segment);
    i.map_or(segment, |i| BONE_NAMES[i]).to_owned()
}

/// The phase as one stance for each foot on the floor.
fn stances_of(p: &ContactPhase) -> impl Iterator<Item = pb::ContactPhase> + use<> {
    let (start_s, end_s) = (p.start, p.end);
    let sides = [(true, p.planted[0]), (false, p.planted[1])].into_iter();
    sides
        .filter(|(_, down)| *down)
        .map(move |(left, _)| pb::ContactPhase {
            left,
            start_s,
            end_s,
        })
}

/// A clip for a response.
pub fn clip_out(c: &ClipInfo, with_report: bool) -> pb::Clip {
    pb::Clip {
        name: CLIP.name([&c.id]),
        display_name: c.display_name.clone(),
        builtin: c.builtin,
        body: BODY.name([&c.body]),
        rate_hz: c.rate_hz,
        frame_count: c.frames as i32,
        duration_s: c.duration,
        report: c
            .report
            .as_ref()
            .filter(|_| with_report)
            .map(|r| report_out(r)),
        create_time: c.created.map(timestamp),
        forecast: c
            .forecast
            .as_ref()
            .filter(|_| with_report)
            .map(|f| forecast_out(f)),
        follow: follow_out(c.follow.follow).into(),
        max_help_weights: c.follow.most_help(),
    }
}

/// The means of following a motion, for a response.
pub fn follow_out(follow: Follow) -> pb::Follow {
    match follow {
        Follow::Strict => pb::Follow::Strict,
        Follow::Rehearsed => pb::Follow::Rehearsed,
        Follow::Assisted => pb::Follow::Assisted,
        Follow::Always => pb::Follow::Always,
    }
}

/// How far the motion of a clip may be changed so that a figure can follow it; `None` if not given.
pub fn follow(field: &str, value: i32) -> Result<Option<Follow>, Fault> {
    match pb::Follow::try_from(value) {
        Ok(pb::Follow::Unspecified) => Ok(None),
        Ok(pb::Follow::Strict) => Ok(Some(Follow::Strict)),
        Ok(pb::Follow::Rehearsed) => Ok(Some(Follow::Rehearsed)),
        Ok(pb::Follow::Assisted) => Ok(Some(Follow::Assisted)),
        Ok(pb::Follow::Always) => Ok(Some(Follow::Always)),
        Err(_) => Err(Fault::invalid(field, format!("{value} is not a choice"))),
    }
}

/// Shortest, longest and default search of a rehearsal.
const BUDGET: [Duration; 3] = [
    Duration::from_secs(1),
    Duration::from_secs(3600),
    Duration::from_secs(600),
];

/// The time for which a rehearsal may search.
pub fn budget(field: &str, given: Option<prost_types::Duration>) -> Result<Duration, Fault> {
    let [least, most, unless] = BUDGET;
    let Some(given) = given else {
        return Ok(unless);
    };
    let given = super::duration(&given).filter(|t| (least..=most).contains(t));
    given.ok_or_else(|| Fault::invalid(field, "must be 1 s…1 h"))
}

/// The means of following a motion and the bound of the help, as far as they are given; `field` is the place of the
/// message in the request, empty for the request itself.
///
/// # Errors
/// Values out of range, or a bound above 0 for means that take no help.
pub fn follow_update(
    field: &str,
    value: i32,
    most_help: Option<f64>,
) -> Result<FollowUpdate, Fault> {
    let at = |part: &str| match field {
        "" => part.to_owned(),
        _ => format!("{field}.{part}"),
    };
    let most_help = optional(&at("max_help_weights"), most_help, 0.0, 2.0)?;
    let follow = follow(&at("follow"), value)?;
    if most_help.is_some_and(|m| m > 0.0) && follow.is_some_and(|f| !f.takes_help()) {
        return Err(Fault::invalid(
            at("max_help_weights"),
            "must be 0 or absent, unless `follow` is FOLLOW_ASSISTED or FOLLOW_ALWAYS",
        ));
    }
    Ok(FollowUpdate {
        follow,
        most_help: most_help.map(Some),
    })
}

/// The way in which a figure follows its motion, for its status.
pub fn follow_mode_out(mode: FollowMode) -> pb::FollowWay {
    match mode {
        FollowMode::Nothing => pb::FollowWay::Unspecified,
        FollowMode::Tracked => pb::FollowWay::Tracked,
        FollowMode::Rehearsed => pb::FollowWay::Rehearsed,
        FollowMode::Helped => pb::FollowWay::Helped,
    }
}

/// The result of a rehearsal, for a response.
pub fn rehearsal_out(r: &RehearsalInfo) -> pb::Rehearsal {
    let way = match r.way {
        FollowWay::Tracked => pb::FollowWay::Tracked,
        FollowWay::Rehearsed => pb::FollowWay::Rehearsed,
        FollowWay::Helped => pb::FollowWay::Helped,
        FollowWay::Lost => pb::FollowWay::Lost,
    };
    let [error_m, root_relative_error_m] = r.error;
    pb::Rehearsal {
        way: way.into(),
        reason: r.reason.clone(),
        lost_at_s: r.lost_at,
        error_m,
        root_relative_error_m,
        help_newton_seconds: r.help.impulse,
        help_ratio: r.help.share,
        help_peak_newtons: r.help.most_force,
        help_peak_newton_metres: r.help.most_moment,
        helped_ratio: r.help.acts,
        hardest_dof: r.hardest.0.clone(),
        hardest_ratio: r.hardest.1,
        stopped: r.stopped,
        begins_in_motion: r.begins_in_motion,
    }
}

/// How a clip begins, for a response.
pub fn clip_beginning_out(b: &ClipBeginning) -> pb::PlayClipResponse {
    let start = match b.start {
        ClipStart::Reset => pb::ClipStart::Reset,
        ClipStart::AtOnce => pb::ClipStart::AtOnce,
        ClipStart::Switch => pb::ClipStart::Switch,
        ClipStart::Led => pb::ClipStart::Led,
    };
    pb::PlayClipResponse {
        start_time_s: b.time.0,
        start: start.into(),
        rehearsed: b.rehearsed,
    }
}

/// A forecast for a response.
pub fn forecast_out(f: &Forecast) -> pb::Forecast {
    use pb::ForecastVerdict as V;
    let verdict = match f.verdict {
        ForecastVerdict::Follows => V::Follows,
        ForecastVerdict::NeedsHelp => V::NeedsHelp,
        ForecastVerdict::Cannot => V::Cannot,
    };
    let d = &f.difficulty;
    pb::Forecast {
        verdict: verdict.into(),
        reason: f.reason.clone(),
        demand: f.demand,
        lacking_force_rms_weights: d.lacking_force_rms,
        lacking_force_peak_weights: d.lacking_force_peak,
        lacking_force_peak_time_s: d.lacking_force_at_s,
        lacking_moment_peak_weight_m: d.lacking_moment_peak,
        capture_point_drift_m: d.drift_m,
        strength_peak_ratio: d.support_peak,
        strength_peak_time_s: d.support_peak_at_s,
        strength_dof: d.support_p95_dof.clone(),
        strength_p95_ratio: d.support_p95,
        flight_s: d.flight_s,
        longest_flight_s: d.longest_flight_s,
        floor_contact_s: d.floor_s,
        inverted_s: d.inverted_s,
    }
}

/// A posture in the form in which clients send it; for our own client.
pub fn figure_motion(
    figure: &str,
    posture: &Posture,
    velocity: &[f64],
    planted: Option<[bool; 2]>,
) -> pb::FigureMotion {
    let (p, q) = (posture.root_position, posture.root_rotation);
    pb::FigureMotion {
        figure_id: figure.to_owned(),
        root: Some(pb::Pose {
            position_m: Some(super::vector_out(p)),
            rotation: Some(pb::Quaternion {
                x: q.x,
                y: q.y,
                z: q.z,
                w: q.w,
            }),
        }),
        joint_angles_rad: sinew_physics::body::angles::anatomical_angles(posture).to_vec(),
        velocity: velocity.to_vec(),
        planted: planted.map(|p| p.to_vec()).unwrap_or_default(),
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field_of(r: Result<FigureSample, Fault>) -> String {
        match r {
            Err(Fault::Invalid { field, .. }) => field,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn angles_and_bone_rotations_say_the_same() {
        let mut angles = vec![0.0; DOF_COUNT];
        for (i, a) in angles.iter_mut().enumerate() {
            *a = 0.01 * (i as f64) - 0.2;
        }
        let by_angle = figure_sample(
            "f",
            0,
            &pb::FigureMotion {
                joint_angles_rad: angles,
                ..Default::default()
            },
        )
        .unwrap();
        for space in [pb::RotationSpace::Parent, pb::RotationSpace::World] {
            let mut m = pb::FigureMotion {
                rotation_space: space.into(),
                ..Default::default()
            };
            let mut world = [Quat::identity(); SEGMENT_COUNT];
            for s in 0..SEGMENT_COUNT {
                let local = super::super::super::posture::joint_rotation(&by_angle.posture, s);
                world[s] = if s == 0 {
                    local
                } else {
                    world[PARENT[s]] * local
                };
                let q = if space == pb::RotationSpace::World {
                    world[s]
                } else {
                    local
                };
                m.bone_rotations.push(pb::BoneRotation {
                    bone: sinew_physics::body::topology::BONE_NAMES[s].into(),
                    rotation: Some(pb::Quaternion {
                        x: q.x,
                        y: q.y,
                        z: q.z,
                        w: q.w,
                    }),
                });
            }
            let by_bone = figure_sample("f", 0, &m).unwrap();
            let e = by_angle.posture.difference(&by_bone.posture);
            assert!(e.iter().all(|e| e.abs() < 1e-12), "{e:?}");
        }
    }

    #[test]
    fn bad_samples_name_the_field() {
        let mut m = pb::FigureMotion {
            joint_angles_rad: vec![0.0; DOF_COUNT],
            ..Default::default()
        };
        m.joint_angles_rad[5] = f64::NAN;
        assert_eq!(field_of(figure_sample("f", 0, &m)), "f.joint_angles_rad[5]");
        m.joint_angles_rad = vec![0.0; 38];
        assert_eq!(field_of(figure_sample("f", 0, &m)), "f.joint_angles_rad");
        m.joint_angles_rad = vec![0.0; 39];
        m.velocity = vec![f64::INFINITY; NV];
        assert_eq!(field_of(figure_sample("f", 0, &m)), "f.velocity[0]");
        m.velocity.clear();
        m.planted = vec![true];
        assert_eq!(field_of(figure_sample("f", 0, &m)), "f.planted");
        m.planted.clear();
        m.root = Some(pb::Pose {
            position_m: None,
            rotation: Some(pb::Quaternion::default()),
        });
        assert_eq!(field_of(figure_sample("f", 0, &m)), "f.root.rotation");
    }
}
