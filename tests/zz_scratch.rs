#![allow(clippy::unwrap_used)]
mod common;
use common::*;
use sinew::sim::figure::ControllerKind;
use sinew::sim::body::topology::*;
#[test]
fn wave() {
    let body = man();
    let clip = recorded(&body, "wave");
    println!("duration {} rate {}", clip.duration(), clip.rate_hz());
    let mut s = Scene::playing(&body, ControllerKind::Modern, &clip);
    let mut n = 0;
    s.run(clip.duration(), |s| {
        n += 1;
        let r = s.figure().report().unwrap();
        if n % 12 == 0 || (n>480 && n % 4 ==0 && n < 600) {
            let mut worst: Vec<(f64, &str)> = r.joint_error.iter().zip(DOF_NAMES).map(|(e, n)| (e.to_degrees(), n)).collect();
            worst.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
            let d = r.com_desired - r.com;
            let sat: Vec<&str> = (0..39).filter(|d| r.saturated >> d & 1 == 1).map(|d| DOF_NAMES[d]).collect();
            println!("{:.2} margin {:?} comerr {:.3} {:.3} {:.3} planted {:?} support {:?} flags {:?} it {} {} worst {:.1} {} {:.1} {} sat {:?} pen {:.4} fell {}", n as f64/60.0, r.margin.map(|m| (m*1e3).round()), d.x, d.y, d.z, s.figure().target().now.planted, r.main_support.map(|s| s.index()), r.flags, r.control_iterations, r.step_iterations, worst[0].0, worst[0].1, worst[1].0, worst[1].1, sat, r.penetration, s.figure().is_fallen());
        }
    });
}
