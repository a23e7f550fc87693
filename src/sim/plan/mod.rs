//! Plans: contacts, footholds, balance and whole-body postures of a motion that a body can follow.

pub mod ankle_torque_limit;
pub mod contact_labels;
pub mod cycle;
pub mod envelope;
pub mod feasibility;
pub(crate) mod flight_phases;
pub mod foot_lock;
mod free_fall;
mod leg_reach;
pub mod likeness;
pub mod motion_transition;
pub mod params;
pub mod pelvis_shift;
pub mod prepare;
pub mod reading_report;
pub mod recording;
pub mod splice;
pub mod stop;
pub mod stream;

pub use cycle::cycle;
pub use reading_report::ReadingReport;
pub use recording::{PreparedRecording, prepare_recording, prepare_recording_unless};
pub use stream::StreamPlan;

use crate::body::SegmentId;
use crate::body::topology::{JOINT, Joint, TOES};
use crate::math::trig;

/// Index of the ball joint of a segment in a posture.
fn ball_joint(segment: SegmentId) -> usize {
    match JOINT[segment.index()] {
        Joint::Ball(b) => b,
        _ => unreachable!("hips and spine are ball joints"),
    }
}

/// Index of the hinge of the toes of a side in a posture.
pub(crate) fn toe_hinge(side: usize) -> usize {
    match JOINT[TOES[side].index()] {
        Joint::Hinge1(h) => h,
        _ => unreachable!("the toes are on a hinge"),
    }
}

/// The smallest number from 0 to `most` for which nothing is lacking, approached from above in `halvings` bisections.
fn least_without(most: f64, halvings: usize, lacks: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, most);
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        if lacks(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// A vector on the floor turned by an angle, rad. The same bits on every machine.
fn turned_on_floor([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = trig::sin_cos(angle);
    [c * x - s * y, s * x + c * y]
}
