//! Conversion of requests to domain types and of domain types to responses. Everything is checked here, once: finite,
//! in range, counted, named.

pub mod access;
pub mod body;
pub mod checkpoint;
pub mod constraint;
pub mod control;
pub mod etags;
pub mod figure;
pub mod masks;
pub mod motion;
pub mod names;
pub mod obstacle;
mod pages;
pub mod perturbation;
pub mod server;
pub mod simulation;
pub mod state;
pub mod world;

pub use names::{clip_name, figure_name, obstacle_name, operation_name, world_name};
pub use pages::page;

use super::pb;
use super::status::Fault;
use super::types::Place;
use sinew_physics::math::{Quat, Vec3};
use std::fmt::Display;

/// Farthest place from the origin, m.
pub const WORLD_EXTENT: f64 = 10_000.0;

/// A finite number within bounds.
///
/// The field is only formatted for an error, because streams have hundreds of numbers in each tick.
pub(crate) fn within(field: impl Display, value: f64, least: f64, most: f64) -> Result<f64, Fault> {
    // Written so that NaN fails.
    if value >= least && value <= most {
        Ok(value)
    } else {
        Err(Fault::invalid(
            field.to_string(),
            format!("must be a finite number in {least}…{most}, got {value}"),
        ))
    }
}

/// A number within bounds where 0 stands for `default`.
pub(crate) fn or_default(
    field: &str,
    value: f64,
    default: f64,
    least: f64,
    most: f64,
) -> Result<f64, Fault> {
    if value == 0.0 {
        Ok(default)
    } else {
        within(field, value, least, most)
    }
}

/// An integer within bounds where 0 stands for `default`.
pub fn count(field: &str, value: i32, default: u32, least: u32, most: u32) -> Result<u32, Fault> {
    match u32::try_from(value) {
        Ok(0) => Ok(default),
        Ok(n) if (least..=most).contains(&n) => Ok(n),
        _ => Err(Fault::invalid(
            field,
            format!("must be {least}…{most}, got {value}"),
        )),
    }
}

/// A vector with every component within ± `most`.
pub(crate) fn vector(field: impl Display, v: pb::Vector3, most: f64) -> Result<Vec3, Fault> {
    Ok(Vec3 {
        x: within(format_args!("{field}.x"), v.x, -most, most)?,
        y: within(format_args!("{field}.y"), v.y, -most, most)?,
        z: within(format_args!("{field}.z"), v.z, -most, most)?,
    })
}

/// A vector for a response.
pub fn vector_out(v: Vec3) -> pb::Vector3 {
    pb::Vector3 {
        x: v.x,
        y: v.y,
        z: v.z,
    }
}

/// A rotation; its length must be 1 within 0.001.
pub(crate) fn rotation(field: impl Display, q: pb::Quaternion) -> Result<Quat, Fault> {
    let n = (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w).sqrt();
    // Written so that NaN fails.
    if (n - 1.0).abs() <= 1e-3 {
        Ok(Quat {
            x: q.x,
            y: q.y,
            z: q.z,
            w: q.w,
        }
        .normalized())
    } else {
        Err(Fault::invalid(
            field.to_string(),
            format!("must be a quaternion of length 1 within 0.001, its length is {n}"),
        ))
    }
}

/// A place on the ground.
pub fn place(field: &str, p: pb::Placement) -> Result<Place, Fault> {
    Ok(Place {
        x: within(format!("{field}.x_m"), p.x_m, -WORLD_EXTENT, WORLD_EXTENT)?,
        y: within(format!("{field}.y_m"), p.y_m, -WORLD_EXTENT, WORLD_EXTENT)?,
        yaw: within(format!("{field}.yaw_rad"), p.yaw_rad, -100.0, 100.0)?,
    })
}

/// A place for a response.
pub fn place_out(p: Place) -> pb::Placement {
    pb::Placement {
        x_m: p.x,
        y_m: p.y,
        yaw_rad: p.yaw,
    }
}

/// A name for people.
pub fn display_name(field: &str, name: &str) -> Result<String, Fault> {
    if name.len() > 128 {
        return Err(Fault::invalid(
            field,
            format!("must be at most 128 bytes, has {}", name.len()),
        ));
    }
    if name.chars().any(char::is_control) {
        return Err(Fault::invalid(field, "must not hold control characters"));
    }
    Ok(name.to_owned())
}

/// Most bytes of the last part of a name.
pub const MAX_ID: usize = 63;

/// The last part of a new name; `None` if the server has to choose.
pub fn new_id(field: &str, id: &str) -> Result<Option<String>, Fault> {
    if id.is_empty() {
        return Ok(None);
    }
    let good = id.len() <= MAX_ID
        && id.starts_with(|c: char| c.is_ascii_lowercase())
        && id
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
    if good {
        Ok(Some(id.to_owned()))
    } else {
        Err(Fault::invalid(
            field,
            format!(
                "must be 1 to 63 of a-z, 0-9 and -, beginning with a letter, got {:?}",
                shortened(id)
            ),
        ))
    }
}

/// The name that a client gives itself, at most 64 printable ASCII characters.
pub fn client_id(field: &str, id: &str) -> Result<String, Fault> {
    if id.len() > 64 || !id.bytes().all(|b| b.is_ascii_graphic() || b == b' ') {
        return Err(Fault::invalid(
            field,
            "must be at most 64 bytes of printable ASCII",
        ));
    }
    Ok(id.to_owned())
}

/// The start of a text from outside, short enough for a message.
pub(crate) fn shortened(text: &str) -> &str {
    match text.char_indices().nth(80) {
        Some((end, _)) => &text[..end],
        None => text,
    }
}

/// A count from a signed field.
///
/// # Errors
/// It is negative.
pub fn not_negative(field: &str, value: i64) -> Result<u64, Fault> {
    u64::try_from(value)
        .map_err(|_| Fault::invalid(field, format!("must not be negative, got {value}")))
}

/// A duration; `None` if it is negative. The conversion of `prost_types` negates a negative one, which overflows at the
/// end of its range.
pub fn duration(given: &prost_types::Duration) -> Option<std::time::Duration> {
    let given = Some(*given).filter(|d| d.seconds >= 0)?;
    std::time::Duration::try_from(given).ok()
}

/// A point in time for a response.
pub fn timestamp(t: std::time::SystemTime) -> prost_types::Timestamp {
    t.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn new_names_are_short_and_plain() {
        for bad in ["Ä", "-a", "1a", "a/b", &"a".repeat(64)] {
            assert!(new_id("world_id", bad).is_err(), "{bad}");
        }
        assert_eq!(new_id("world_id", "a-1").unwrap().as_deref(), Some("a-1"));
        assert_eq!(new_id("world_id", "").unwrap(), None);
    }

    #[test]
    fn numbers_must_be_finite_and_in_range() {
        assert!(within("x", f64::NAN, -1.0, 1.0).is_err());
        assert!(within("x", f64::INFINITY, -1.0, f64::MAX).is_err());
        assert!(
            rotation(
                "q",
                pb::Quaternion {
                    x: 0.0,
                    y: 0.0,
                    z: f64::NAN,
                    w: 1.0
                }
            )
            .is_err()
        );
    }
}
