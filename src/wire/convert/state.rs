//! Views and events.

use super::super::frame::FIELD_NAMES;
use super::super::pb;
use super::super::status::Fault;
use super::super::types::{EventFilter, EventKind, FieldSet, NumberFormat, ViewSpec, WorldEvent};
use super::names::CLIP;
use super::{count, shortened};
use sinew_physics::body::topology::DOF_NAMES;

/// Most figures a view or filter can name.
pub const MAX_NAMED_FIGURES: usize = 256;

fn figures(field: &str, names: &[String]) -> Result<Vec<String>, Fault> {
    if names.len() > MAX_NAMED_FIGURES {
        return Err(Fault::invalid(
            field,
            format!(
                "must be at most {MAX_NAMED_FIGURES} figures, got {}",
                names.len()
            ),
        ));
    }
    let mut out = names.to_vec();
    out.sort();
    out.dedup();
    Ok(out)
}

/// The selection of a viewer.
pub fn view(v: Option<&pb::View>) -> Result<ViewSpec, Fault> {
    let none = pb::View::default();
    let v = v.unwrap_or(&none);
    let paths = v
        .fields
        .as_ref()
        .map(|m| m.paths.as_slice())
        .unwrap_or_default();
    let mut fields = FieldSet(0);
    for (i, path) in paths.iter().enumerate() {
        fields.0 |= if path == "*" {
            FieldSet::ALL.0
        } else {
            FieldSet::named(path)
                .ok_or_else(|| {
                    Fault::invalid(
                        format!("view.fields.paths[{i}]"),
                        format!(
                            "must be * or one of {}, got {:?}",
                            FIELD_NAMES.join(", "),
                            shortened(path)
                        ),
                    )
                })?
                .0
        };
    }
    if paths.is_empty() {
        fields = FieldSet::DEFAULT;
    }
    Ok(ViewSpec {
        figures: figures("view.figure_ids", &v.figure_ids)?,
        fields,
        format: match pb::Encoding::try_from(v.encoding) {
            Ok(pb::Encoding::Unspecified | pb::Encoding::Float) => NumberFormat::Float,
            Ok(pb::Encoding::Double) => NumberFormat::Double,
            Ok(pb::Encoding::Fixed16) => NumberFormat::Fixed16,
            Err(_) => {
                return Err(Fault::invalid(
                    "view.encoding",
                    format!("{} is not an encoding", v.encoding),
                ));
            }
        },
        divisor: count("view.rate_divisor", v.rate_divisor, 1, 1, 1000)?,
    })
}

/// The events that a viewer wants.
pub fn event_filter(r: &pb::WatchEventsRequest) -> Result<EventFilter, Fault> {
    if r.types.len() > 64 {
        return Err(Fault::invalid("types", "must be at most 64"));
    }
    for (i, t) in r.types.iter().enumerate() {
        if !matches!(pb::EventType::try_from(*t), Ok(t) if t != pb::EventType::Unspecified) {
            return Err(Fault::invalid(
                format!("types[{i}]"),
                format!("{t} is not an event type"),
            ));
        }
    }
    Ok(EventFilter {
        figures: figures("figure_ids", &r.figure_ids)?,
        types: r.types.clone(),
    })
}

fn event_type(kind: &EventKind) -> pb::EventType {
    match kind {
        EventKind::SupportGained(_) => pb::EventType::SupportGained,
        EventKind::SupportLost(_) => pb::EventType::SupportLost,
        EventKind::Saturated(_) => pb::EventType::Saturated,
        EventKind::Relieved(_) => pb::EventType::Relieved,
        EventKind::BalanceLost => pb::EventType::BalanceLost,
        EventKind::Recovered => pb::EventType::Recovered,
        EventKind::Fell => pb::EventType::Fell,
        EventKind::GotUp => pb::EventType::GotUp,
        EventKind::LoadTaken(..) => pb::EventType::LoadTaken,
        EventKind::LoadDropped(..) => pb::EventType::LoadDropped,
        EventKind::LoadSlipped(..) => pb::EventType::LoadSlipped,
        EventKind::LoadShared(..) => pb::EventType::LoadShared,
        EventKind::LoadUnshared(..) => pb::EventType::LoadUnshared,
        EventKind::Pushed(..) => pb::EventType::Pushed,
        EventKind::Touched(..) => pb::EventType::Touched,
        EventKind::Parted(..) => pb::EventType::Parted,
        EventKind::ObstacleAdded(_) => pb::EventType::ObstacleAdded,
        EventKind::ObstacleRemoved(_) => pb::EventType::ObstacleRemoved,
        EventKind::WayBarred => pb::EventType::WayBarred,
        EventKind::ClipRestarts => pb::EventType::ClipRestarts,
        EventKind::ClipGivenUp => pb::EventType::ClipGivenUp,
        EventKind::Quarantined => pb::EventType::Quarantined,
        EventKind::FigureAdded => pb::EventType::FigureAdded,
        EventKind::FigureRemoved => pb::EventType::FigureRemoved,
        EventKind::DriveBegan(_) => pb::EventType::DriveBegan,
        EventKind::DriveEnded(_) => pb::EventType::DriveEnded,
        EventKind::DriveResynced(_) => pb::EventType::DriveResynced,
        EventKind::ControlAcquired(_) => pb::EventType::ControlAcquired,
        EventKind::ControlReleased(_) => pb::EventType::ControlReleased,
        EventKind::ControlPreempted(_) => pb::EventType::ControlPreempted,
        EventKind::ControlOffered(_) => pb::EventType::ControlOffered,
        EventKind::AccessRefused(_) => pb::EventType::AccessRefused,
        EventKind::Restored(_) => pb::EventType::WorldRestored,
        EventKind::Paused => pb::EventType::WorldPaused,
        EventKind::Resumed => pb::EventType::WorldResumed,
        EventKind::Failed(_) => pb::EventType::WorldFailed,
        EventKind::Deleted(_) => pb::EventType::WorldDeleted,
        EventKind::ClipBegan(_) => pb::EventType::ClipBegan,
        EventKind::ClipEnded(_) => pb::EventType::ClipEnded,
    }
}

/// Whether the filter lets the event pass.
pub fn wanted(filter: &EventFilter, e: &WorldEvent) -> bool {
    (filter.figures.is_empty() || filter.figures.binary_search(&e.figure).is_ok())
        && (filter.types.is_empty() || filter.types.contains(&event_type(&e.kind).into()))
}

/// An event for a response.
pub fn event_out(e: &WorldEvent) -> pb::Event {
    let mut out = pb::Event {
        r#type: event_type(&e.kind).into(),
        tick: e.tick as i64,
        time_s: e.time,
        figure_id: e.figure.clone(),
        ..Default::default()
    };
    match &e.kind {
        EventKind::SupportGained(s) | EventKind::SupportLost(s) => out.segment = s.name().into(),
        EventKind::Saturated(d) | EventKind::Relieved(d) => {
            out.dof = DOF_NAMES.get(*d).copied().unwrap_or_default().into();
        }
        EventKind::LoadTaken(s, m)
        | EventKind::LoadDropped(s, m)
        | EventKind::LoadSlipped(s, m) => {
            out.segment = s.name().into();
            out.mass_kg = *m;
        }
        EventKind::LoadShared(s, m, hand, need) | EventKind::LoadUnshared(s, m, hand, need) => {
            out.segment = s.name().into();
            out.mass_kg = *m;
            out.other_segment = hand.name().into();
            [out.need_alone, out.need_shared] = *need;
        }
        EventKind::Pushed(s, impulse) => {
            out.segment = s.name().into();
            out.impulse_newton_seconds = *impulse;
        }
        EventKind::Touched(s, other, part) | EventKind::Parted(s, other, part) => {
            out.segment = s.name().into();
            out.other = other.clone();
            out.other_segment = part.map_or_else(String::new, |p| p.name().into());
        }
        EventKind::ObstacleAdded(other) | EventKind::ObstacleRemoved(other) => {
            out.other = other.clone();
        }
        EventKind::ClipBegan(clip) | EventKind::ClipEnded(clip) => {
            out.detail = CLIP.name([clip]);
        }
        EventKind::Restored(tick) => out.detail = tick.to_string(),
        EventKind::DriveBegan(t)
        | EventKind::DriveEnded(t)
        | EventKind::DriveResynced(t)
        | EventKind::ControlAcquired(t)
        | EventKind::ControlReleased(t)
        | EventKind::ControlPreempted(t)
        | EventKind::ControlOffered(t)
        | EventKind::AccessRefused(t)
        | EventKind::Deleted(t)
        | EventKind::Failed(t) => {
            out.detail = t.clone();
        }
        _ => {}
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_are_checked_and_made_canonical() {
        let mask = |paths: &[&str]| {
            Some(prost_types::FieldMask {
                paths: paths.iter().map(|p| (*p).to_owned()).collect(),
            })
        };
        let v = view(Some(&pb::View {
            figure_ids: vec!["b".into(), "a".into(), "b".into()],
            fields: mask(&["torque", "root_pose"]),
            ..Default::default()
        }))
        .unwrap();
        assert_eq!(v.figures, ["a", "b"]);
        assert_eq!(v.fields, FieldSet(1 | 1 << 6));
        assert_eq!(view(None).unwrap().fields, FieldSet::DEFAULT);
        let Err(Fault::Invalid { field, .. }) = view(Some(&pb::View {
            fields: mask(&["torque", "colour"]),
            ..Default::default()
        })) else {
            panic!("accepted")
        };
        assert_eq!(field, "view.fields.paths[1]");
    }
}
