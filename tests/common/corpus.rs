//! The synthesised recordings of `tests/corpus`.

use std::path::Path;

/// Bytes of a file of the corpus, `walk-normal.vrm` for example; panics if there is no such file.
pub fn read(name: &str) -> Vec<u8> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("tests/corpus");
    let path = folder.join(format!("{name}.bvh"));
    std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// [`read`], cut to the frames between two times, s. Such a recording begins and ends in motion.
pub fn piece(name: &str, from: f64, until: f64) -> Vec<u8> {
    let text = String::from_utf8(read(name)).expect("the corpus is text");
    let (hierarchy, motion) = text.split_once("MOTION").expect("a BVH file has motion");
    let mut lines = motion.lines().filter(|l| !l.trim().is_empty());
    let _declared = lines.next();
    let step = lines.next().expect("a line with the frame time");
    let seconds: f64 = step
        .rsplit(char::is_whitespace)
        .next()
        .and_then(|s| s.parse().ok())
        .expect("a frame time");
    let first = (from / seconds).round() as usize;
    let last = (until / seconds).round() as usize;
    let rows: Vec<&str> = lines.skip(first).take(last - first).collect();
    let count = rows.len();
    format!(
        "{hierarchy}MOTION\nFrames: {count}\n{step}\n{}\n",
        rows.join("\n")
    )
    .into_bytes()
}
