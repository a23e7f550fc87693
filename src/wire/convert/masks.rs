//! Update masks (AIP-134, AIP-161).

use super::super::status::Fault;
use super::shortened;
use prost_types::FieldMask;

/// The fields of a resource that can change.
#[derive(Clone, Copy, Debug)]
pub struct MaskFields<'a> {
    /// Fields that may change, each with whether the request gives it a value.
    pub settable: &'a [(&'static str, bool)],
    /// Fields that are set at creation.
    pub fixed: &'a [&'static str],
    /// Fields that only the server sets, and the name. A mask may name them without effect.
    pub output: &'a [&'static str],
}

impl MaskFields<'_> {
    /// The fields that a mask takes from the request: those that it names; without a mask, those with a value; all for
    /// `*`.
    ///
    /// # Errors
    /// A path names no field, one that is fixed at creation, or a part of a field; or `*` is not alone.
    pub fn taken(&self, mask: Option<&FieldMask>) -> Result<Vec<&'static str>, Fault> {
        let paths = mask.map(|m| m.paths.as_slice()).unwrap_or_default();
        let settable = || self.settable.iter().map(|(name, _)| *name);
        match paths {
            [] => {
                let given = self.settable.iter().filter(|(_, given)| *given);
                return Ok(given.map(|(name, _)| *name).collect());
            }
            [all] if all == "*" => return Ok(settable().collect()),
            _ => {}
        }
        let mut taken = Vec::with_capacity(self.settable.len());
        for (i, path) in paths.iter().enumerate() {
            let refused = |problem| Err(Fault::invalid(format!("update_mask.paths[{i}]"), problem));
            // A part of a field is treated like the field.
            let (whole, part) = match path.split_once('.') {
                Some((whole, part)) => (whole, Some(part)),
                None => (path.as_str(), None),
            };
            if let Some(name) = settable().find(|n| *n == whole) {
                if part.is_some() {
                    return refused(format!(
                        "a mask names whole fields: {name} changes as a whole, got {:?}",
                        shortened(path)
                    ));
                }
                if !taken.contains(&name) {
                    taken.push(name);
                }
            } else if self.fixed.contains(&whole) {
                return refused(format!("{path} is set at creation and does not change"));
            } else if path == "*" {
                return refused("* must be the only path".to_owned());
            } else if !self.output.contains(&whole) {
                return refused(format!(
                    "must be * or one of {}, got {:?}",
                    settable().collect::<Vec<_>>().join(", "),
                    shortened(path)
                ));
            }
        }
        Ok(taken)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(paths: Option<&[&str]>) -> Result<Vec<&'static str>, Fault> {
        let mask = paths.map(|p| FieldMask {
            paths: p.iter().map(|p| (*p).to_owned()).collect(),
        });
        let fields = MaskFields {
            settable: &[("speed", true), ("display_name", false)],
            fixed: &["rate_hz"],
            output: &["name", "tick"],
        };
        fields.taken(mask.as_ref())
    }

    #[test]
    fn a_mask_takes_what_it_names_or_what_is_given_or_all() {
        assert_eq!(taken(None).unwrap(), ["speed"]);
        assert_eq!(taken(Some(&[])).unwrap(), ["speed"]);
        assert_eq!(taken(Some(&["*"])).unwrap(), ["speed", "display_name"]);
        assert_eq!(
            taken(Some(&["display_name", "tick", "display_name"])).unwrap(),
            ["display_name"]
        );
        assert_eq!(taken(Some(&["name", "tick.count"])).unwrap(), [""; 0]);
    }

    #[test]
    fn what_cannot_change_is_named() {
        for (paths, at, word) in [
            (&["speed", "rate_hz"][..], 1, "creation"),
            (&["speed", "*"], 1, "only"),
            (&["colour"], 0, "speed, display_name"),
            (&[""], 0, "speed, display_name"),
            (&["speed", "speed.x"], 1, "whole"),
            (&["display_name.a.b"], 0, "whole"),
            (&["rate_hz.x"], 0, "creation"),
            (&["colour.red"], 0, "speed, display_name"),
            (&["*.x"], 0, "speed, display_name"),
        ] {
            let Err(Fault::Invalid { field, problem }) = taken(Some(paths)) else {
                panic!("{paths:?} was taken");
            };
            assert_eq!(field, format!("update_mask.paths[{at}]"));
            assert!(problem.contains(word), "{problem}");
        }
    }
}
