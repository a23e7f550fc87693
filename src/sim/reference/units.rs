//! Units that people read in the serialised form of a report.

use serde::{Serialize, Serializer};

/// A length in m as mm.
pub(crate) fn millimetres<S: Serializer>(metres: &f64, s: S) -> Result<S::Ok, S::Error> {
    s.serialize_f64(1e3 * metres)
}

/// An angle in rad as degrees.
pub(crate) fn degrees<S: Serializer>(angle: &f64, s: S) -> Result<S::Ok, S::Error> {
    s.serialize_f64(angle.to_degrees())
}

/// Angles of the left and the right side in rad as degrees.
pub(crate) fn each_in_degrees<S: Serializer>(angles: &[f64; 2], s: S) -> Result<S::Ok, S::Error> {
    angles.map(f64::to_degrees).serialize(s)
}
