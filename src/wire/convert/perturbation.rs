//! Loads, pushes and forces.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::{Disturbance, FigureDisturbance, SecondSegment};
use super::{or_default, shortened, vector, within};
use sinew_physics::body::SegmentId;
use sinew_physics::body::topology::SEGMENT_NAMES;
use sinew_physics::figure::SecondHand;

/// Most disturbances in one request.
pub const MAX_BATCH: usize = 64;
/// Longest duration, s.
const DAY: f64 = 86_400.0;

pub(super) fn segment(field: &str, name: &str) -> Result<SegmentId, Fault> {
    SegmentId::from_name(name).ok_or_else(|| {
        Fault::invalid(
            field,
            format!(
                "must be one of {}, got {:?}",
                SEGMENT_NAMES.join(", "),
                shortened(name)
            ),
        )
    })
}

pub(super) fn lasting(field: &str, value: f64) -> Result<f64, Fault> {
    or_default(field, value, f64::INFINITY, 0.0, DAY)
}

/// The second holder of a load.
fn second_segment(at: &dyn Fn(&str) -> String, l: &pb::Load) -> Result<SecondSegment, Fault> {
    use pb::TwoHands;
    let two_hands = TwoHands::try_from(l.two_hands).map_err(|_| {
        let problem = format!("{} is not a value of TwoHands", l.two_hands);
        Fault::invalid(at("two_hands"), problem)
    })?;
    let when = match two_hands {
        TwoHands::Unspecified => return held_second(at, l),
        TwoHands::Never => None,
        TwoHands::Auto => Some(SecondHand::Auto),
        TwoHands::Always => Some(SecondHand::Always),
    };
    if !l.second_segment.is_empty() {
        return Err(Fault::invalid(
            at("second_segment"),
            "must be empty where two_hands is given",
        ));
    }
    if when.is_some() && !["l_hand", "r_hand"].contains(&l.segment.as_str()) {
        return Err(Fault::invalid(
            at("two_hands"),
            "needs segment to be l_hand or r_hand",
        ));
    }
    held_second(at, l)?; // nor is a point allowed
    Ok(when.map_or(SecondSegment::Never, SecondSegment::Helps))
}

/// The second segment of a load, by name.
fn held_second(at: &dyn Fn(&str) -> String, l: &pb::Load) -> Result<SecondSegment, Fault> {
    let point = l
        .second_point_m
        .map(|p| vector(at("second_point_m"), p, 2.0))
        .transpose()?;
    if l.second_segment.is_empty() {
        return match point {
            None => Ok(SecondSegment::Never),
            Some(_) => Err(Fault::invalid(
                at("second_point_m"),
                "must be absent without second_segment",
            )),
        };
    }
    if l.second_segment == l.segment {
        return Err(Fault::invalid(
            at("second_segment"),
            "must differ from segment",
        ));
    }
    Ok(SecondSegment::Holds(
        segment(&at("second_segment"), &l.second_segment)?,
        point,
    ))
}

/// A disturbance; `field` is the place of the message in the request.
pub fn disturbance(field: &str, p: &pb::Perturbation) -> Result<Disturbance, Fault> {
    use pb::perturbation::Kind;
    let point = |at: &str, p: Option<pb::Vector3>| p.map(|p| vector(at, p, 2.0)).transpose();
    match &p.kind {
        None => Err(Fault::invalid(
            format!("{field}.kind"),
            "must be load, impulse or force",
        )),
        Some(Kind::Load(l)) => {
            let at = |part: &str| format!("{field}.load.{part}");
            Ok(Disturbance::Load {
                segment: segment(&at("segment"), &l.segment)?,
                point: point(&at("point_m"), l.point_m)?,
                mass: within(at("mass_kg"), l.mass_kg, 0.0, 500.0)?,
                velocity: l
                    .velocity_mps
                    .map(|v| vector(at("velocity_mps"), v, 100.0))
                    .transpose()?
                    .unwrap_or_default(),
                second: second_segment(&at, l)?,
                grip: or_default(&at("grip_newtons"), l.grip_newtons, f64::INFINITY, 0.0, 1e6)?,
                duration: lasting(&at("duration_s"), l.duration_s)?,
            })
        }
        Some(Kind::Impulse(i)) => {
            let at = |part: &str| format!("{field}.impulse.{part}");
            let duration = or_default(&at("duration_s"), i.duration_s, 0.1, 1e-3, 10.0)?;
            let impulse = i
                .impulse_newton_seconds
                .ok_or_else(|| Fault::invalid(at("impulse_newton_seconds"), "must be given"))?;
            Ok(Disturbance::Force {
                segment: segment(&at("segment"), &i.segment)?,
                point: point(&at("point_m"), i.point_m)?,
                force: vector(at("impulse_newton_seconds"), impulse, 1000.0)? * (1.0 / duration),
                duration,
            })
        }
        Some(Kind::Force(f)) => {
            let at = |part: &str| format!("{field}.force.{part}");
            let force = f
                .force_newtons
                .ok_or_else(|| Fault::invalid(at("force_newtons"), "must be given"))?;
            Ok(Disturbance::Force {
                segment: segment(&at("segment"), &f.segment)?,
                point: point(&at("point_m"), f.point_m)?,
                force: vector(at("force_newtons"), force, 1e5)?,
                duration: lasting(&at("duration_s"), f.duration_s)?,
            })
        }
    }
}

/// A batch of disturbances.
pub fn batch(list: &[pb::Perturbation]) -> Result<Vec<FigureDisturbance>, Fault> {
    if !(1..=MAX_BATCH).contains(&list.len()) {
        return Err(Fault::invalid(
            "perturbations",
            format!("must be 1…{MAX_BATCH}, got {}", list.len()),
        ));
    }
    list.iter()
        .enumerate()
        .map(|(i, p)| {
            Ok(FigureDisturbance {
                figure: p.figure_id.clone(),
                tick: p.tick,
                what: disturbance(&format!("perturbations[{i}]"), p)?,
            })
        })
        .collect()
}

/// Disturbances in time of a clip: time (s) and disturbance.
pub fn timed(list: &[pb::TimedPerturbation]) -> Result<Vec<(f64, Disturbance)>, Fault> {
    if list.len() > MAX_BATCH {
        return Err(Fault::invalid(
            "perturbations",
            format!("must be at most {MAX_BATCH}, got {}", list.len()),
        ));
    }
    list.iter()
        .enumerate()
        .map(|(i, t)| {
            let at = format!("perturbations[{i}]");
            let start = within(format!("{at}.start_s"), t.start_s, 0.0, DAY)?;
            let p = t
                .perturbation
                .as_ref()
                .ok_or_else(|| Fault::invalid(format!("{at}.perturbation"), "must be given"))?;
            Ok((start, disturbance(&format!("{at}.perturbation"), p)?))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_impulse_is_the_force_that_gives_it() {
        let p = pb::Perturbation {
            kind: Some(pb::perturbation::Kind::Impulse(pb::Impulse {
                segment: "chest".into(),
                impulse_newton_seconds: Some(pb::Vector3 {
                    x: 20.0,
                    y: 0.0,
                    z: 0.0,
                }),
                duration_s: 0.2,
                ..Default::default()
            })),
            ..Default::default()
        };
        let Disturbance::Force {
            force, duration, ..
        } = disturbance("p", &p).unwrap()
        else {
            panic!("not a force");
        };
        assert_eq!((force.x * duration, duration), (20.0, 0.2));
    }

    #[test]
    fn the_other_hand_is_asked_for_without_a_second_segment() {
        let load = |segment: &str, second: &str, two_hands: i32| {
            let kind = pb::perturbation::Kind::Load(pb::Load {
                segment: segment.into(),
                second_segment: second.into(),
                two_hands,
                ..Default::default()
            });
            let p = pb::Perturbation {
                kind: Some(kind),
                ..Default::default()
            };
            disturbance("p", &p)
        };
        for (two_hands, meant) in [
            (1, SecondSegment::Never),
            (2, SecondSegment::Helps(SecondHand::Auto)),
            (3, SecondSegment::Helps(SecondHand::Always)),
        ] {
            let Ok(Disturbance::Load { second, .. }) = load("l_hand", "", two_hands) else {
                panic!("refused");
            };
            assert_eq!(second, meant);
        }
        for (segment, second, two_hands, path) in [
            ("r_hand", "l_hand", 2, "p.load.second_segment"),
            ("chest", "", 2, "p.load.two_hands"),
            ("r_hand", "", 9, "p.load.two_hands"),
        ] {
            let Err(Fault::Invalid { field, .. }) = load(segment, second, two_hands) else {
                panic!("accepted");
            };
            assert_eq!(field, path);
        }
    }

    #[test]
    fn bad_disturbances_name_the_field() {
        let load = |mass_kg, segment: &str| pb::Perturbation {
            kind: Some(pb::perturbation::Kind::Load(pb::Load {
                segment: segment.into(),
                mass_kg,
                ..Default::default()
            })),
            ..Default::default()
        };
        for (p, path) in [
            (load(f64::NAN, "r_hand"), "perturbations[1].load.mass_kg"),
            (load(-1.0, "r_hand"), "perturbations[1].load.mass_kg"),
            (load(1.0, "tail"), "perturbations[1].load.segment"),
            (pb::Perturbation::default(), "perturbations[1].kind"),
        ] {
            let Err(Fault::Invalid { field, problem }) = batch(&[load(1.0, "r_hand"), p]) else {
                panic!("accepted");
            };
            assert_eq!(field, path);
            // The error for an unknown segment lists all segments.
            let listed = SEGMENT_NAMES.iter().all(|n| problem.contains(n));
            assert_eq!(listed, path.ends_with("segment"), "{problem}");
        }
    }
}
