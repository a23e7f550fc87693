//! The recordings that tests read: in the folder `SINEW_MOCAP_DIR`, or beside the repository.

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

/// Bytes of a file of the data set; panics if it is missing.
pub fn read(file: &str) -> Vec<u8> {
    let folder = std::env::var_os("SINEW_MOCAP_DIR").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/mocap"),
        PathBuf::from,
    );
    let path = folder.join(file);
    std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}
