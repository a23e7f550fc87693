//! Files that commands write: formats by extension, names for several clips, errors that name the file.

use super::exit::Usage;
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
            Err(Usage(text).into())
        }
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
