//! Sources of motion: a BVH file or one of the built-in motions.

use super::exit::UsageError;
use anyhow::{Context, Result, bail};
use sinew_physics::body::Body;
use sinew_physics::motion::builtin::{BUILTIN_NAMES, builtin};
use sinew_physics::motion::{Clip, Recording, RecordingError, read};
use sinew_physics::plan::{ReadingReport, prepare_recording};
use sinew_physics::reference::RetargetOptions;
use std::path::Path;

/// A motion fitted to a body.
pub struct LoadedClip {
    /// File stem or built-in name.
    pub name: String,
    /// The argument as given.
    pub spec: String,
    /// The motion.
    pub clip: Clip,
    /// How the recording was fitted; `None` for built-in motions, which are made for the body.
    pub retarget: Option<ReadingReport>,
}

/// Writes the warnings of the retargeting to standard error.
pub fn warn(source: &LoadedClip) {
    for warning in source.retarget.iter().flat_map(|r| &r.warnings) {
        super::terminal::note(&format!("warning: {}: {warning}", source.name));
    }
}

/// Prefix of built-in motions.
pub const BUILTIN: &str = "builtin:";

/// The error for an unknown built-in motion.
pub fn no_builtin(name: &str) -> UsageError {
    UsageError(format!(
        "there is no built-in motion {name:?}; the built-in motions are {}",
        BUILTIN_NAMES.join(", ")
    ))
}

/// Name of the clip that `spec` stands for: file stem or built-in name.
pub fn name(spec: &str) -> String {
    match spec.strip_prefix(BUILTIN) {
        Some(name) => name.to_owned(),
        None => Path::new(spec)
            .file_stem()
            .map_or_else(|| spec.to_owned(), |s| s.to_string_lossy().into_owned()),
    }
}

/// The recording in the file `name`.
///
/// # Errors
/// The bytes are of no known format, or hold no human figure; names the file and the place in it.
pub fn recording(name: &str, bytes: &[u8]) -> Result<Recording> {
    read(bytes).map_err(|e| {
        let trouble = match &e {
            RecordingError::Unreadable { format, .. } => format!("{name} is not a {format} file"),
            _ => format!("{name} does not fit the body"),
        };
        anyhow::Error::new(e).context(trouble)
    })
}

/// Loads `spec`, `builtin:NAME` or the path of a BVH file, and fits it to `body`.
///
/// # Errors
/// Unknown name, a folder, unreadable or malformed file, or a skeleton that cannot be mapped; names the file and the
/// place in it.
pub fn load(spec: &str, body: &Body, options: &RetargetOptions) -> Result<LoadedClip> {
    if let Some(name) = spec.strip_prefix(BUILTIN) {
        let Some(clip) = builtin(body, name) else {
            bail!(no_builtin(name));
        };
        return Ok(LoadedClip {
            name: name.to_owned(),
            spec: spec.to_owned(),
            clip,
            retarget: None,
        });
    }
    if Path::new(spec).is_dir() {
        let folder = spec.trim_end_matches('/');
        bail!(UsageError(format!(
            "{spec} is a folder; name its files ({folder}/*.bvh) or use `sinew survey`"
        )));
    }
    let bytes = match std::fs::read(spec) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound && BUILTIN_NAMES.contains(&spec) => {
            return Err(e).context(format!("cannot read {spec}; did you mean {BUILTIN}{spec}?"));
        }
        other => other.with_context(|| format!("cannot read {spec}"))?,
    };
    let recording = recording(spec, &bytes)?;
    let fitted = prepare_recording(&recording, body, options)
        .with_context(|| format!("{spec} does not fit the body"))?;
    Ok(LoadedClip {
        name: name(spec),
        spec: spec.to_owned(),
        clip: fitted.clip,
        retarget: Some(fitted.report),
    })
}
