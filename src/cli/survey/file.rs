//! The file of a survey.

use super::identity;
use crate::exit::UsageError;
use crate::output::write;
use anyhow::{Context, Result, bail, ensure};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use sinew_evaluate::survey::SurveyRow;
use sinew_evaluate::survey::tables::{self, SurveyTable};
use std::path::Path;

/// Incremented when rows change their meaning.
const FORMAT: u32 = 1;
/// Settings in which two surveys may differ without an explicit option: differences that a comparison should show.
const FREE: [&str; 1] = ["gravity_mps2"];

/// A survey as read.
#[derive(Debug, Deserialize)]
pub(super) struct Survey {
    format: u32,
    /// See [`super::settings`].
    pub settings: Map<String, Value>,
    /// The clips.
    pub rows: Vec<SurveyRow>,
}

/// Reads a survey.
///
/// # Errors
/// A file that cannot be read or is not a survey of this format.
pub(super) fn read(path: &Path) -> Result<Survey> {
    let text =
        std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    let at = || format!("{} is not a survey", path.display());
    let value: Value = serde_json::from_str(&text).with_context(at)?;
    let format = value.get("format").and_then(Value::as_u64);
    ensure!(
        format == Some(u64::from(FORMAT)),
        "{} has format {}, this program reads {FORMAT}",
        path.display(),
        format.map_or("none".to_owned(), |f| f.to_string())
    );
    let survey: Survey = serde_json::from_value(value).with_context(at)?;
    debug_assert_eq!(survey.format, FORMAT);
    Ok(survey)
}

/// Writes a survey: settings, build, rows (a clip a line), tables.
///
/// # Errors
/// A file that cannot be written.
pub(super) fn write_survey(
    path: &Path,
    settings: &Map<String, Value>,
    rows: &[SurveyRow],
) -> Result<()> {
    let line = |v: Value| serde_json::to_string(&v);
    let mut clips = Vec::new();
    for row in rows {
        clips.push(serde_json::to_string(row).context("a row cannot be written as JSON")?);
    }
    let text = format!(
        "{{\n\"format\": {FORMAT},\n\"build\": {},\n\"settings\": {},\n\"by_kind\": {},\n\
         \"forecasts\": {},\n\"rows\": [\n{}\n]\n}}\n",
        line(identity::build()?.into())?,
        line(Value::Object(settings.clone()))?,
        line(objects(&tables::by_kind(rows)))?,
        line(objects(&tables::confusion(rows)))?,
        clips.join(",\n")
    );
    write(path, text)
}

/// A table as objects with the column heads as names.
fn objects(table: &SurveyTable) -> Value {
    let object = |row: &Vec<String>| -> Value {
        let cells = table.head.iter().zip(row);
        Value::Object(cells.map(|(h, c)| ((*h).to_owned(), json!(c))).collect())
    };
    table.rows.iter().map(object).collect()
}

/// Refuses to compare surveys made under different conditions.
///
/// # Errors
/// Names the settings that differ, with both values, and those of `across` that do not exist.
pub(super) fn check_settings(
    old: &Map<String, Value>,
    new: &Map<String, Value>,
    across: &[String],
) -> Result<()> {
    if let Some(unknown) = across.iter().find(|a| !new.contains_key(*a)) {
        let names: Vec<&str> = new.keys().map(String::as_str).collect();
        bail!(UsageError(format!(
            "--across {unknown}: no such setting; there are {}",
            names.join(", ")
        )));
    }
    let mut names: Vec<&String> = old.keys().chain(new.keys()).collect();
    names.sort();
    names.dedup();
    let show = |v: Option<&Value>| v.map_or("nothing".to_owned(), Value::to_string);
    let differ: Vec<String> = names
        .into_iter()
        .filter(|n| !FREE.contains(&n.as_str()) && !across.contains(n))
        .filter(|n| old.get(*n) != new.get(*n))
        .map(|n| format!("{n} was {}, is {}", show(old.get(n)), show(new.get(n))))
        .collect();
    ensure!(
        differ.is_empty(),
        "the surveys were made under different settings: {} (--across NAME allows a setting to differ)",
        differ.join("; ")
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(v: Value) -> Map<String, Value> {
        match v {
            Value::Object(m) => m,
            other => panic!("{other}"),
        }
    }

    #[test]
    fn settings_that_differ_are_named_unless_allowed() {
        let old = map(json!({ "strength": 1.0, "gravity_mps2": 9.81, "copies": 0 }));
        let new = map(json!({ "strength": 1.5, "gravity_mps2": 10.3, "copies": 0 }));
        let error = check_settings(&old, &new, &[]).unwrap_err().to_string();
        assert!(
            error.contains("strength was 1.0, is 1.5") && !error.contains("gravity"),
            "{error}"
        );
        check_settings(&old, &new, &["strength".into()]).unwrap();
        let error = check_settings(&old, &new, &["stength".into()]).unwrap_err();
        assert!(error.is::<UsageError>());
        let error = error.to_string();
        assert!(error.contains("stength: no such setting"), "{error}");
    }
}
