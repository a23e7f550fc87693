use crate::common::*;
use crate::fall::*;
use crate::*;
use sinew::sim::figure::*;
#[test]
fn dbg() {
    let body = man();
    let posture = authored(&body, "idle").posture(0).to_owned();
    let d = std::env::var("DIR").unwrap_or("x".into());
    let dir = match d.as_str() {
        "x" => vec3(1., 0., 0.),
        "-x" => vec3(-1., 0., 0.),
        "y" => vec3(0., 1., 0.),
        _ => vec3(0., -1., 0.),
    };
    let (pivot, direction) = edge_towards(&body, &posture, dir);
    let state = leaning(&body, &posture, pivot, direction);
    let mut setup = figure(&body, ControllerKind::Paper, state);
    setup.stepper = StepperKind::Kinematic;
    setup.strength.all = 20.0;
    let mut scene = Scene::of(setup);
    let start = integrals(scene.figure().links(), &state);
    println!("pivot {pivot:?} {direction:?}");
    scene.run(1.3, |s| {
        let r = s.figure().report().unwrap();
        let now = integrals(s.figure().links(), s.figure().state());
        let worst = (0..39).max_by(|a,b| r.joint_error[*a].abs().total_cmp(&r.joint_error[*b].abs())).unwrap();
        let pts: Vec<String> = r.contacts.iter().map(|c| format!("{}{}:{:.0}", c.segment.name(), c.vertex, c.force.z)).collect();
        println!("{:.3} e{:+.4} main {:?} poly {} zmp {:?} sat {:x} {:x} flags {:x} worst {} {:.2} it {} {} com {:.3} {:.3} | {}", s.world.time(), (now.energy-start.energy)/start.energy, r.main_support.map(|m| m.name()), r.support_polygon.len(), r.zmp.map(|z| (z.x*1e3) as i64), r.saturated, r.saturated_secondary, r.flags.0, sinew::sim::body::topology::DOF_NAMES[worst], r.joint_error[worst].to_degrees(), r.control_iterations, r.step_iterations, r.com.x, r.com.z, pts.join(" "));
    });
}
