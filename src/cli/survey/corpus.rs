//! The clips of a survey.

use crate::exit::UsageError;
use crate::source::{BUILTIN, no_builtin};
use anyhow::{Context, Result, ensure};
use sinew_physics::motion::builtin::BUILTIN_NAMES;
use std::path::{Path, PathBuf};

/// Largest number of clips of a survey.
const MAX_CLIPS: usize = 10_000;

/// One clip.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CorpusClip {
    /// Folder and file name, or `builtin:NAME`: the same wherever the corpus is stored.
    pub name: String,
    /// Source of its bytes.
    pub source: ClipSource,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum ClipSource {
    /// A file.
    File(PathBuf),
    /// A motion that comes with the program.
    Builtin(String),
}

/// The clips of files, folders and `builtin:NAME`, in the given order; those of a folder by name.
///
/// # Errors
/// A path or a built-in motion that does not exist, a folder that cannot be listed or holds no clips, two clips of the
/// same name, too many clips.
pub(super) fn gather(corpus: &[String]) -> Result<Vec<CorpusClip>> {
    let mut out: Vec<CorpusClip> = Vec::new();
    for spec in corpus {
        if let Some(name) = spec.strip_prefix(BUILTIN) {
            ensure!(BUILTIN_NAMES.contains(&name), no_builtin(name));
            out.push(CorpusClip {
                name: spec.clone(),
                source: ClipSource::Builtin(name.to_owned()),
            });
            continue;
        }
        let path = Path::new(spec);
        if path.is_dir() {
            let found = folder(path)?;
            ensure!(
                !found.is_empty(),
                UsageError(format!("{spec} holds no .bvh file"))
            );
            out.extend(found.iter().map(|p| CorpusClip::file(p)));
        } else {
            ensure!(
                path.exists(),
                UsageError(format!("{spec}: there is no such file or folder"))
            );
            out.push(CorpusClip::file(path));
        }
    }
    ensure!(
        out.len() <= MAX_CLIPS,
        UsageError(format!("{} clips: at most {MAX_CLIPS}", out.len()))
    );
    let mut names: Vec<&str> = out.iter().map(|e| e.name.as_str()).collect();
    names.sort_unstable();
    if let Some(twice) = names.windows(2).find(|w| w[0] == w[1]) {
        let text = format!("two clips of the corpus are called {}", twice[0]);
        return Err(UsageError(text).into());
    }
    Ok(out)
}

impl CorpusClip {
    fn file(path: &Path) -> Self {
        let last = |p: &Path| p.file_name().map(|n| n.to_string_lossy().into_owned());
        let whole = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let folder = whole.parent().and_then(last);
        let file = last(path).unwrap_or_else(|| path.display().to_string());
        Self {
            name: folder.map_or(file.clone(), |f| format!("{f}/{file}")),
            source: ClipSource::File(path.to_owned()),
        }
    }
}

fn folder(path: &Path) -> Result<Vec<PathBuf>> {
    let at = || format!("cannot list {}", path.display());
    let mut out = Vec::new();
    for entry in std::fs::read_dir(path).with_context(at)? {
        let file = entry.with_context(at)?.path();
        let is_bvh = file
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("bvh"));
        if is_bvh && file.is_file() {
            out.push(file);
        }
    }
    out.sort();
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_its_files_by_name() {
        let folder = std::env::temp_dir().join(format!("sinew-corpus-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for name in ["b.bvh", "a.BVH", "c.txt"] {
            std::fs::write(folder.join(name), "").unwrap();
        }
        let dir = folder.file_name().unwrap().to_string_lossy().into_owned();
        let given = [folder.display().to_string(), "builtin:idle".to_owned()];
        let names: Vec<String> = gather(&given)
            .unwrap()
            .into_iter()
            .map(|e| e.name)
            .collect();
        assert_eq!(
            names,
            [
                format!("{dir}/a.BVH"),
                format!("{dir}/b.bvh"),
                "builtin:idle".into()
            ]
        );
        let twice = [given[0].clone(), folder.join("b.bvh").display().to_string()];
        let error = gather(&twice).unwrap_err().to_string();
        assert!(
            error.contains("two clips") && error.contains("b.bvh"),
            "{error}"
        );
        let missing = folder.join("d.bvh").display().to_string();
        for (wrong, says) in [
            (missing.as_str(), "d.bvh: there is no such file or folder"),
            ("builtin:fly", "there is no built-in motion \"fly\""),
        ] {
            let error = gather(&[wrong.to_owned()]).unwrap_err();
            assert!(error.is::<UsageError>(), "{wrong}");
            assert!(error.to_string().contains(says), "{error}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
