//! A run or a prepared motion as a table: comma-separated values, one row per tick.

use crate::body::angles::anatomical_angles;
use crate::body::topology::DOF_NAMES;
use crate::body::{DOF_COUNT, Posture};
use std::fmt::Write;

/// Torques of one row, N·m: muscle torque, least and largest available.
#[derive(Clone, Copy, Debug)]
pub struct Torques<'a> {
    /// Muscle torque.
    pub torque: &'a [f64; DOF_COUNT],
    /// Least available.
    pub lower: &'a [f64; DOF_COUNT],
    /// Largest available.
    pub upper: &'a [f64; DOF_COUNT],
}

/// The heading: time, pelvis position and quaternion (x, y, z, w), 39 anatomical angles, and with `torques` the 39
/// torques and their limits.
pub fn header(torques: bool) -> String {
    let mut out = String::from("time_s,root_x_m,root_y_m,root_z_m,root_qx,root_qy,root_qz,root_qw");
    let mut add = |suffix: &str| {
        for name in DOF_NAMES {
            // Writing to a string cannot fail.
            let _ = write!(out, ",{name}_{suffix}");
        }
    };
    add("rad");
    if torques {
        add("torque_nm");
        add("torque_min_nm");
        add("torque_max_nm");
    }
    out.push('\n');
    out
}

/// Appends one row. Numbers are written so that they read back to the same bits.
pub fn row(out: &mut String, time_s: f64, posture: &Posture, torques: Option<Torques<'_>>) {
    let _ = write!(out, "{time_s}");
    let mut add = |values: &[f64]| {
        for v in values {
            let _ = write!(out, ",{v}");
        }
    };
    add(&posture.root_position.to_array());
    add(&posture.root_rotation.to_xyzw());
    add(&anatomical_angles(posture));
    if let Some(t) = torques {
        add(t.torque);
        add(t.lower);
        add(t.upper);
    }
    out.push('\n');
}
