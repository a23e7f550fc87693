//! Joint angles of the stages' reference poses.

use crate::body::topology::{DOF_COUNT, DOF_NAMES};

/// Joint angles of the stages.
#[derive(Clone, Debug)]
pub struct ReferencePoses {
    pub sprawled: [f64; DOF_COUNT],
    pub drawn: [f64; DOF_COUNT],
    pub gathered: [f64; DOF_COUNT],
    pub rolled: [f64; DOF_COUNT],
    pub tipped: [f64; DOF_COUNT],
    pub planted: [f64; DOF_COUNT],
    pub sunk: [f64; DOF_COUNT],
    pub on_all_fours: [f64; DOF_COUNT],
    pub bear: [f64; DOF_COUNT],
    pub folded: [f64; DOF_COUNT],
    pub at_ease: [f64; DOF_COUNT],
}

/// Joint angles in degrees by name; a name without side means both.
fn pose(list: &[(&str, f64)]) -> [f64; DOF_COUNT] {
    const ARMS: [(&str, f64); 3] = [
        ("shoulder_abduction", 12.0),
        ("elbow_pronation", 75.0),
        ("wrist_flexion", -70.0),
    ];
    let mut out = [0.0; DOF_COUNT];
    for (name, degrees) in ARMS.iter().chain(list) {
        for (angle, dof) in out.iter_mut().zip(DOF_NAMES) {
            let both = dof.strip_prefix("l_").or(dof.strip_prefix("r_"));
            if dof == *name || both == Some(*name) {
                *angle = degrees.to_radians();
            }
        }
    }
    out
}

impl ReferencePoses {
    pub fn new(at_ease: [f64; DOF_COUNT]) -> Self {
        Self {
            sprawled: pose(&[
                ("shoulder_flexion", -10.0),
                ("shoulder_abduction", 70.0),
                ("shoulder_rotation", -75.0),
                ("elbow_flexion", 90.0),
                ("elbow_pronation", 0.0),
                ("wrist_flexion", 0.0),
                ("neck_flexion", -30.0),
                ("knee_flexion", 50.0),
                ("ankle_flexion", 25.0),
                ("toe_extension", 50.0),
            ]),
            gathered: pose(&[
                ("elbow_pronation", 0.0),
                ("wrist_flexion", 0.0),
                ("r_shoulder_flexion", 165.0),
                ("l_shoulder_flexion", 75.0),
                ("l_shoulder_abduction", -20.0),
                ("elbow_flexion", 20.0),
                ("l_hip_flexion", 55.0),
                ("l_knee_flexion", 100.0),
                ("neck_rotation", -40.0),
                ("neck_flexion", 10.0),
            ]),
            rolled: pose(&[
                ("elbow_pronation", 0.0),
                ("wrist_flexion", 0.0),
                ("r_shoulder_flexion", 165.0),
                ("l_shoulder_flexion", 80.0),
                ("l_shoulder_abduction", -25.0),
                ("elbow_flexion", 20.0),
                ("l_hip_flexion", 80.0),
                ("l_hip_abduction", -30.0),
                ("l_knee_flexion", 50.0),
                ("neck_rotation", -30.0),
                ("thorax_rotation", -15.0),
                ("waist_rotation", -15.0),
            ]),
            tipped: pose(&[
                ("elbow_pronation", 0.0),
                ("wrist_flexion", 0.0),
                ("r_shoulder_flexion", 165.0),
                ("l_shoulder_flexion", 60.0),
                ("l_shoulder_abduction", 10.0),
                ("elbow_flexion", 30.0),
                ("l_hip_flexion", 40.0),
                ("l_knee_flexion", 40.0),
                ("neck_rotation", -20.0),
            ]),
            planted: pose(&[
                ("shoulder_flexion", -35.0),
                ("elbow_flexion", 100.0),
                ("toe_extension", 50.0),
                ("ankle_flexion", 15.0),
                ("neck_flexion", -30.0),
            ]),
            drawn: pose(&[
                ("shoulder_flexion", -10.0),
                ("elbow_flexion", 110.0),
                ("toe_extension", 50.0),
                ("ankle_flexion", 15.0),
                ("neck_flexion", -40.0),
                ("hip_flexion", 60.0),
                ("knee_flexion", 60.0),
            ]),
            sunk: pose(&[
                ("shoulder_flexion", 130.0),
                ("elbow_flexion", 30.0),
                ("toe_extension", 50.0),
                ("ankle_flexion", 15.0),
                ("neck_flexion", -40.0),
                ("hip_flexion", 110.0),
                ("knee_flexion", 110.0),
            ]),
            on_all_fours: pose(&[
                ("shoulder_flexion", 100.0),
                ("elbow_flexion", 20.0),
                ("toe_extension", 50.0),
                ("ankle_flexion", 20.0),
                ("neck_flexion", -30.0),
                ("hip_flexion", 90.0),
                ("knee_flexion", 90.0),
            ]),
            bear: pose(&[
                ("shoulder_flexion", 110.0),
                ("elbow_flexion", 10.0),
                ("toe_extension", 40.0),
                ("ankle_flexion", 20.0),
                ("hip_flexion", 100.0),
                ("knee_flexion", 75.0),
                ("waist_flexion", 20.0),
                ("thorax_flexion", 10.0),
                ("neck_flexion", -20.0),
            ]),
            folded: pose(&[
                ("shoulder_flexion", 85.0),
                ("elbow_flexion", 10.0),
                ("ankle_flexion", 25.0),
                ("hip_flexion", 112.0),
                ("knee_flexion", 85.0),
                ("waist_flexion", 45.0),
                ("thorax_flexion", 25.0),
                ("neck_flexion", -20.0),
            ]),
            at_ease,
        }
    }
}
