//! Strength files: `sinew.v1.StrengthScale` as JSON, so that the same text can be used in a request.

use crate::exit::UsageError;
use anyhow::{Context, Result};
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES};
use sinew_physics::figure::StrengthScale;
use std::path::Path;

/// Largest strength file that is read, bytes.
const LARGEST: u64 = 1 << 20;

/// The strength of a person.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StrengthFile {
    all: f64,
    dofs: Vec<DofFactor>,
    percentile: f64,
    effort: f64,
}

/// The factor on one DOF.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct DofFactor {
    dof: String,
    factor: f64,
}

impl Default for StrengthFile {
    fn default() -> Self {
        Self::from(&StrengthScale::default())
    }
}

impl From<&StrengthScale> for StrengthFile {
    fn from(scale: &StrengthScale) -> Self {
        let dofs = (0..DOF_COUNT).filter(|d| scale.dof[*d] != 1.0);
        Self {
            all: scale.all,
            dofs: dofs
                .map(|d| DofFactor {
                    dof: DOF_NAMES[d].to_owned(),
                    factor: (scale.dof[d] * 1e4).ceil() / 1e4,
                })
                .collect(),
            percentile: scale.percentile,
            effort: scale.effort,
        }
    }
}

impl StrengthFile {
    /// Factor on a DOF.
    pub fn factor(&self, dof: &str) -> f64 {
        let found = self.dofs.iter().find(|f| f.dof == dof);
        found.map_or(1.0, |f| f.factor)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, or a number outside its range; names it.
    pub fn read(path: &Path) -> Result<StrengthScale> {
        let size = std::fs::metadata(path)
            .with_context(|| format!("cannot read {}", path.display()))?
            .len();
        if size > LARGEST {
            return Err(
                UsageError(format!("{}: more than {LARGEST} bytes", path.display())).into(),
            );
        }
        let text = std::fs::read_to_string(path)
            .with_context(|| format!("cannot read {}", path.display()))?;
        Self::parse(&text).map_err(|e| UsageError(format!("{}: {e:#}", path.display())).into())
    }

    /// Parses the text of a strength file.
    fn parse(text: &str) -> Result<StrengthScale> {
        // Fields are accepted only by name: a list would be read as the fields in their order.
        let value: serde_json::Value = serde_json::from_str(text).context("not JSON")?;
        anyhow::ensure!(value.is_object(), "not a strength file");
        let file: Self = serde_json::from_value(value).context("not a strength file")?;
        let mut out = StrengthScale {
            all: within("all", file.all, 0.01, 100.0)?,
            percentile: within("percentile", file.percentile, 5.0, 95.0)?,
            effort: within("effort", file.effort, 0.0, 1.0)?,
            ..StrengthScale::default()
        };
        for f in &file.dofs {
            let d = DOF_NAMES.iter().position(|n| *n == f.dof);
            let d = d.with_context(|| format!("dofs: there is no {:?}", f.dof))?;
            out.dof[d] = within(&f.dof, f.factor, 0.01, 100.0)?;
        }
        Ok(out)
    }
}

fn within(field: &str, value: f64, low: f64, high: f64) -> Result<f64> {
    anyhow::ensure!(
        (low..=high).contains(&value),
        "{field} {value}: outside {low}…{high}"
    );
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_nonsense_is_refused() {
        let mut scale = StrengthScale {
            percentile: 25.0,
            ..StrengthScale::default()
        };
        scale.dof[7] = 1.25;
        let text = serde_json::to_string(&StrengthFile::from(&scale)).expect("plain data");
        assert_eq!(StrengthFile::parse(&text).expect("its own text"), scale);
        assert_eq!(
            StrengthFile::parse("{}").expect("defaults"),
            StrengthScale::default()
        );
        for bad in [
            "{\"all\": 0}",
            "{\"percentile\": 99}",
            "{\"dofs\": [{\"dof\": \"tail\", \"factor\": 1}]}",
            "{\"dofs\": [{\"dof\": \"neck_flexion\", \"factor\": 1e9}]}",
            "{\"weakness\": 1}",
            "[]",
        ] {
            assert!(StrengthFile::parse(bad).is_err(), "{bad}");
        }
    }
}
