//! Tests that need real motion capture, which is not part of the repository. `make recordings` runs them;
//! docs/corpus.md lists the files and their sources. Without the files they fail, and the message names the variable
//! and the page. They claim properties of all recordings; single clips are guarded by `make survey`, which compares
//! every measure of every clip with the stored values (docs/testing.md).
//!
//! * `bvh`: the reader against joint positions from an independent reader.
//! * `retarget`: recordings become motions that a body can follow, in whatever dialect they are written.
//! * `tracking`: figures stay within their strength, and no unexplained force acts.
//! * `walking`, `running`, `variations`: recordings from standing to standing, repeated, pushed, loaded, mirrored,
//!   faster and slower.
//! * `transitions`: from one clip to another.
//! * `live`: recordings as a stream, through a preparation window.
//! * `rising`: getting up from the floor.
//! * `contacts`: a dancing couple, a seat.
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

mod bvh;
mod contacts;
mod live;
mod retarget;
mod rising;
mod running;
mod tracking;
mod transitions;
mod variations;
mod walking;

use sinew_physics::math::Vec3;

/// A vector.
fn vec3(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3 { x, y, z }
}
