//! Files that commands write: formats by extension, names for several clips, errors that name the file.

use super::exit::UsageError;
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// Lower-case extension of `path`.
///
/// # Errors
/// When there is none of `accepted`; names them.
pub fn extension(flag: &str, path: &Path, accepted: &[&'static str]) -> Result<&'static str> {
    let got = path
        .extension()
        .map(|e| e.to_string_lossy().to_lowercase())
        .unwrap_or_default();
    match accepted.iter().find(|a| **a == got) {
        Some(found) => Ok(found),
        None => {
            let list = accepted
                .iter()
                .map(|a| format!(".{a}"))
                .collect::<Vec<_>>()
                .join(", ");
            let text = format!(
                "{flag} {}: the name must end in one of {list}",
                path.display()
            );
            Err(UsageError(text).into())
        }
    }
}

/// Checks that the folder of an output file exists, before work whose result would be lost.
///
/// # Errors
/// It does not exist; names the flag and the folder.
pub fn check_folder(flag: &str, path: Option<&Path>) -> Result<()> {
    let Some(path) = path else { return Ok(()) };
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            let text = format!(
                "{flag} {}: there is no folder {}; make it first",
                path.display(),
                folder.display()
            );
            Err(UsageError(text).into())
        }
        _ => Ok(()),
    }
}

/// Checks that the files of several clips get different names ([`for_clip`]).
///
/// # Errors
/// Two of these clips have the same name.
pub fn check_names(mut clips: Vec<String>) -> Result<()> {
    clips.sort_unstable();
    match clips.windows(2).find(|two| two[0] == two[1]) {
        Some(two) => {
            let text = format!(
                "two clips are called {}: their files would have one name; rename one, or run them one by one",
                two[0]
            );
            Err(UsageError(text).into())
        }
        None => Ok(()),
    }
}

/// `path` itself for one clip; with the clip's name before the extension (`out-walk.csv`) for several.
pub fn for_clip(path: &Path, clip: &str, several: bool) -> PathBuf {
    if !several {
        return path.to_owned();
    }
    let stem = path
        .file_stem()
        .map(|s| s.to_string_lossy().into_owned())
        .unwrap_or_default();
    let mut name = format!("{stem}-{clip}");
    if let Some(e) = path.extension() {
        name = format!("{name}.{}", e.to_string_lossy());
    }
    path.with_file_name(name)
}

/// Writes a whole file.
///
/// # Errors
/// When the file cannot be written; names it.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<()> {
    std::fs::write(path, content).with_context(|| format!("cannot write {}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_clips_get_names_of_their_own() {
        assert_eq!(
            for_clip(Path::new("a/out.csv"), "walk", true),
            Path::new("a/out-walk.csv")
        );
        assert_eq!(
            for_clip(Path::new("a/out.csv"), "walk", false),
            Path::new("a/out.csv")
        );
    }

    #[test]
    fn files_that_would_replace_each_other_are_refused() {
        let names = |all: &[&str]| check_names(all.iter().map(ToString::to_string).collect());
        names(&["walk", "idle"]).expect("two names");
        let error = names(&["walk", "idle", "walk"]).expect_err("one name");
        assert!(error.is::<UsageError>());
        assert!(
            error.to_string().contains("two clips are called walk"),
            "{error}"
        );
    }

    #[test]
    fn a_folder_that_is_not_there_is_named() {
        let check = |path: &str| check_folder("--out", Some(Path::new(path)));
        check("out.csv").expect("this folder");
        check_folder("--out", None).expect("no file");
        let error = check("no/such/out.csv").expect_err("no folder");
        assert!(error.is::<UsageError>());
        assert_eq!(
            error.to_string(),
            "--out no/such/out.csv: there is no folder no/such; make it first"
        );
    }

    #[test]
    fn wrong_extension_lists_the_right_ones() {
        let error = extension("--out", Path::new("a.txt"), &["bvh", "csv"])
            .expect_err("txt")
            .to_string();
        assert_eq!(error, "--out a.txt: the name must end in one of .bvh, .csv");
        assert_eq!(
            extension("--out", Path::new("a.CSV"), &["bvh", "csv"]).expect("csv"),
            "csv"
        );
    }
}
