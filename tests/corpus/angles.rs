//! Joint angles and centre of mass of fitted motions against the truth.

use crate::recorded::{Truth, bare, fitted, readable};
use sinew::sim::body::Body;
use sinew::sim::body::angles::anatomical_angles;
use sinew::sim::body::topology::{DOF_COUNT, DOF_NAMES};

#[test]
fn knees() {
    let body = Body::adult_man();
    for options in [bare(), crate::recorded::RetargetOptions::default()] {
        let r = fitted("stand", "vrm", &body, &options);
        for i in [0, 100, 300] {
            let a = anatomical_angles(r.clip.posture(i));
            println!("knee {:.2} hip {:.2} ankle {:.2} root {:?}", a[26].to_degrees(), a[23].to_degrees(), a[27].to_degrees(), r.clip.posture(i).root_position);
        }
        println!("{:?}", r.report);
    }
}

#[test]
fn measure() {
    let body = Body::adult_man();
    for (name, d) in readable() {
        let truth = Truth::of(name);
        let r = fitted(name, d.name, &body, &bare());
        let mut worst = [0.0f64; DOF_COUNT];
        let mut sum = [0.0f64; DOF_COUNT];
        for i in 0..r.clip.len() {
            let t = i as f64 / r.clip.rate_hz();
            let want = truth.row("angles_deg", t);
            let got = anatomical_angles(r.clip.posture(i));
            for k in 0..DOF_COUNT {
                let e = (got[k].to_degrees() - want[k]).abs();
                worst[k] = worst[k].max(e);
                sum[k] += e * e / r.clip.len() as f64;
            }
        }
        println!("== {name}.{} unit {} up {:?} rate {} skipped {} len {} of {}", d.name, r.report.unit_m, r.report.up, r.report.source_rate_hz, r.report.skipped_frames, r.clip.duration(), truth.number("duration_s"));
        let mut line = String::new();
        for k in 0..DOF_COUNT {
            if sum[k].sqrt() > 1.0 || worst[k] > 4.0 {
                line += &format!("{} {:.1}/{:.1}; ", DOF_NAMES[k], sum[k].sqrt(), worst[k]);
            }
        }
        println!("   {line}");
        println!("   {:?}", r.report.warnings);
    }
}
