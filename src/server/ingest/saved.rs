//! Serde helpers for live motion that is written into a checkpoint.

/// An array that may be missing, in a box: `#[serde(with = "crate::ingest::saved::optional_array")]`.
pub mod optional_array {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use sinew_physics::body::NV;

    #[derive(Serialize, Deserialize)]
    pub(super) struct Array(#[serde(with = "sinew_physics::saved::array")] pub(super) [f64; NV]);

    /// Writes it.
    ///
    /// # Errors
    /// Same as those of the serializer.
    pub fn serialize<S: Serializer>(
        array: &Option<Box<[f64; NV]>>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        array.as_ref().map(|a| Array(**a)).serialize(to)
    }

    /// Reads it.
    ///
    /// # Errors
    /// Same as those of the deserializer.
    pub fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<Box<[f64; NV]>>, D::Error> {
        Ok(Option::<Array>::deserialize(from)?.map(|a| Box::new(a.0)))
    }
}

/// The same with a time beside it.
pub mod timed_array {
    use super::optional_array::Array;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use sinew_physics::body::NV;
    use sinew_physics::time::WorldTime;

    /// Writes it.
    ///
    /// # Errors
    /// Same as those of the serializer.
    pub fn serialize<S: Serializer>(
        array: &Option<(Box<[f64; NV]>, WorldTime)>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let written = array.as_ref().map(|(a, t)| (Array(**a), *t));
        written.serialize(to)
    }

    /// Reads it.
    ///
    /// # Errors
    /// Same as those of the deserializer.
    pub fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<(Box<[f64; NV]>, WorldTime)>, D::Error> {
        let read = Option::<(Array, WorldTime)>::deserialize(from)?;
        Ok(read.map(|(a, t)| (Box::new(a.0), t)))
    }
}
