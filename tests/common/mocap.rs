//! The recordings that `tests/recordings` reads: in the folders that `SINEW_MOCAP_DIR` lists, separated as in `PATH`.

use std::path::PathBuf;

/// All recordings of the data set.
pub const CLIPS: [&str; 18] = [
    "carry",
    "dance",
    "fall-rise",
    "get-up",
    "hit",
    "idle",
    "jump",
    "lift",
    "punch",
    "quick-stop",
    "run",
    "salsa-a",
    "salsa-b",
    "sit-stand",
    "turn",
    "walk",
    "walk-around",
    "wave",
];

/// The recordings in which people stay on their feet: all except those with lying and sitting.
pub fn on_feet() -> impl Iterator<Item = &'static str> {
    let others = ["fall-rise", "get-up", "sit-stand"];
    CLIPS.into_iter().filter(move |name| !others.contains(name))
}

/// Bytes of a file of the data set. Panics with instructions if the file is missing.
pub fn read(file: &str) -> Vec<u8> {
    let folders = std::env::var_os("SINEW_MOCAP_DIR").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&folders).collect();
    folders
        .iter()
        .find_map(|folder| std::fs::read(folder.join(file)).ok())
        .unwrap_or_else(|| {
            panic!(
                "{file} is in none of the folders of SINEW_MOCAP_DIR ({folders:?}): this test needs recordings that \
                 are not part of the repository; docs/corpus.md says which and where they come from"
            )
        })
}
