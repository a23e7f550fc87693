//! Sources of motion: a BVH file or one of the built-in motions.

use super::exit::Usage;
use anyhow::{Context, Result, bail};
use sinew_physics::body::Body;
use sinew_physics::motion::builtin::{BUILTIN_NAMES, builtin};
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::retarget::{RetargetOptions, RetargetReport, retarget};
use std::path::Path;

/// A motion fitted to a body.
pub struct Source {
    /// File stem or built-in name.
    pub name: String,
    /// As it was given.
    pub spec: String,
    /// The motion.
    pub clip: Clip,
    /// How the recording was fitted; `None` for built-in motions, which are made for the body.
    pub retarget: Option<RetargetReport>,
}

/// Writes the warnings of the retargeting to standard error.
pub fn warn(source: &Source) {
    for warning in source.retarget.iter().flat_map(|r| &r.warnings) {
        super::terminal::note(&format!("warning: {}: {warning}", source.name));
    }
}

/// Prefix of built-in motions.
pub const BUILTIN: &str = "builtin:";

/// There is no built-in motion of this name.
pub fn no_builtin(name: &str) -> Usage {
    Usage(format!(
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

/// Loads `spec`, `builtin:NAME` or the path of a BVH file, and fits it to `body`.
///
/// # Errors
/// Unknown name, a folder, unreadable or malformed file, or a skeleton that cannot be mapped; names the file and the
/// place in it.
pub fn load(spec: &str, body: &Body, options: &RetargetOptions) -> Result<Source> {
    if let Some(name) = spec.strip_prefix(BUILTIN) {
        let Some(clip) = builtin(body, name) else {
            bail!(no_builtin(name));
        };
        return Ok(Source {
            name: name.to_owned(),
            spec: spec.to_owned(),
            clip,
            retarget: None,
        });
    }
    if Path::new(spec).is_dir() {
        let folder = spec.trim_end_matches('/');
        bail!(Usage(format!(
            "{spec} is a folder; name its files ({folder}/*.bvh) or use `sinew survey`"
        )));
    }
    let bytes = match std::fs::read(spec) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound && BUILTIN_NAMES.contains(&spec) => {
            return Err(e).context(format!("cannot read {spec}; did you mean {BUILTIN}{spec}?"));
        }
        other => other.with_context(|| format!("cannot read {spec}"))?,
    };
    let bvh = Bvh::parse(&bytes).with_context(|| format!("{spec} is not a BVH file"))?;
    let fitted =
        retarget(&bvh, body, options).with_context(|| format!("{spec} does not fit the body"))?;
    Ok(Source {
        name: name(spec),
        spec: spec.to_owned(),
        clip: fitted.clip,
        retarget: Some(fitted.report),
    })
}
