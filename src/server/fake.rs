//! Temporary stand-in for parts of `sim` that are being written; deleted when they land.
#![allow(missing_docs)]
use crate::sim::body::*;
use crate::sim::motion::*;

pub const BUILTIN_NAMES: [&str; 6] = ["idle", "lift", "squat", "wave", "step", "walk"];
pub fn builtin(body: &Body, name: &str) -> Option<Clip> {
    if !BUILTIN_NAMES.contains(&name) {
        return None;
    }
    let postures: Vec<_> = (0..121)
        .map(|i| {
            let mut p = Posture::default();
            p.root_position.z = body.standing_root_height();
            p.hinge[4] = 0.5 - 0.5 * (i as f64 / 120.0 * std::f64::consts::TAU).cos();
            p
        })
        .collect();
    let n = postures.len();
    Clip::from_postures(name, 60.0, postures, vec![[true; 2]; n]).ok()
}
pub fn mjcf(_b: &Body) -> String {
    "<mujoco/>".into()
}
pub fn urdf(_b: &Body) -> String {
    "<robot/>".into()
}
