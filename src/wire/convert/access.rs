//! Grants of roles.

use super::super::pb;
use super::super::status::Fault;
use super::masks::MaskFields;
pub use super::names::grant_name;
use super::{shortened, within};
use std::time::SystemTime;

/// Most entries of the list of roles, more than there are roles.
pub const MOST_ROLES: usize = 8;
/// Most figures that a grant names.
const MOST_FIGURES: usize = 64;
/// Most bytes of a principal.
const MOST_PRINCIPAL: usize = 256;

/// The principal that gets a grant.
pub fn principal<'a>(field: &str, name: &'a str) -> Result<&'a str, Fault> {
    let known = ["user:", "cert:"]
        .iter()
        .any(|kind| name.strip_prefix(kind).is_some_and(|rest| !rest.is_empty()));
    let odd = |c: char| c.is_control() || c.is_whitespace();
    if (known || name == "*") && name.len() <= MOST_PRINCIPAL && !name.contains(odd) {
        return Ok(name);
    }
    Err(Fault::invalid(
        field,
        format!(
            "must be user:{{sub}}, cert:{{name}} or *, at most {MOST_PRINCIPAL} bytes without spaces, got {:?}",
            shortened(name)
        ),
    ))
}

/// Figures for the role of a driver. They need not exist yet.
pub fn figures(field: &str, names: &[String]) -> Result<Vec<String>, Fault> {
    if names.len() > MOST_FIGURES {
        return Err(Fault::invalid(
            field,
            format!(
                "must be at most {MOST_FIGURES} figures, got {}",
                names.len()
            ),
        ));
    }
    let names = names.iter().enumerate().map(|(i, name)| {
        let field = format!("{field}[{i}]");
        super::new_id(&field, name)?.ok_or_else(|| Fault::invalid(field, "must not be empty"))
    });
    names.collect()
}

/// Bounds of a perturber: force (N), mass (kg), rate (1/s).
pub fn bounds(
    field: &str,
    b: Option<&pb::PerturbationBounds>,
) -> Result<Option<[Option<f64>; 3]>, Fault> {
    let Some(b) = b else { return Ok(None) };
    let checked = |part: &str, value: Option<f64>, least: f64, most: f64| {
        let at = format!("{field}.{part}");
        value.map(|v| within(&at, v, least, most)).transpose()
    };
    Ok(Some([
        checked("max_force_newtons", b.max_force_newtons, 0.0, 1e6)?,
        checked("max_mass_kg", b.max_mass_kg, 0.0, 500.0)?,
        checked("max_rate_hz", b.max_rate_hz, 0.01, 1000.0)?,
    ]))
}

/// Bounds for a response.
pub fn bounds_out(
    [max_force_newtons, max_mass_kg, max_rate_hz]: [Option<f64>; 3],
) -> pb::PerturbationBounds {
    pb::PerturbationBounds {
        max_force_newtons,
        max_mass_kg,
        max_rate_hz,
    }
}

/// Highest priority of the leases of a driver.
pub fn max_priority(field: &str, value: i32) -> Result<i32, Fault> {
    within(field, f64::from(value), 0.0, 99.0).map(|_| value)
}

/// The end of a grant, which must be in the future.
pub fn expiry(
    field: &str,
    at: Option<prost_types::Timestamp>,
) -> Result<Option<SystemTime>, Fault> {
    let time = time(field, at)?;
    if time.is_some_and(|t| t <= SystemTime::now()) {
        return Err(Fault::invalid(
            field,
            "must be a time that is still to come",
        ));
    }
    Ok(time)
}

/// A time, if there is one.
///
/// # Errors
/// The time does not exist.
pub fn time(field: &str, at: Option<prost_types::Timestamp>) -> Result<Option<SystemTime>, Fault> {
    let time = at.map(SystemTime::try_from).transpose();
    time.map_err(|_| Fault::invalid(field, "must be a time"))
}

/// The fields that an update takes.
///
/// # Errors
/// The mask names another field.
pub fn taken(
    g: &pb::Grant,
    mask: Option<&prost_types::FieldMask>,
) -> Result<Vec<&'static str>, Fault> {
    MaskFields {
        settable: &[
            ("roles", !g.roles.is_empty()),
            ("figure_ids", !g.figure_ids.is_empty()),
            ("bounds", g.bounds.is_some()),
            ("max_priority", g.max_priority != 0),
            ("expire_time", g.expire_time.is_some()),
        ],
        fixed: &["principal"],
        output: &["name", "create_time", "etag"],
    }
    .taken(mask)
}
