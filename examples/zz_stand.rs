use sinew::sim::body::*;
use sinew::sim::figure::*;
use sinew::sim::math::*;
use sinew::sim::motion::leg_ik;
use sinew::sim::world::*;
use std::sync::Arc;
fn main() {
    let kind = match std::env::args().nth(1).as_deref() {
        Some("paper") => ControllerKind::Paper,
        Some("motors") => ControllerKind::Motors,
        _ => ControllerKind::Modern,
    };
    let push: f64 = std::env::args().nth(2).map_or(0., |s| s.parse().unwrap());
    let body = Arc::new(Body::adult_man());
    let mut p = Posture::default();
    p.root_position.z = body.standing_root_height() - 0.01;
    p.root_position.x = 0.02;
    // feet flat
    let f = leg_ik::forward(
        &body,
        &Posture {
            root_position: Vec3 {
                x: 0.,
                y: 0.,
                z: body.standing_root_height(),
            },
            ..Posture::default()
        },
    );
    for left in [true, false] {
        let s = if left {
            topology::L_FOOT
        } else {
            topology::R_FOOT
        };
        let (mut pos, _) = f[s.index()];
        pos.y *= 1.2;
        leg_ik::solve_leg(&body, &mut p, left, (pos, Quat::identity()), 0.0);
    }
    let mut w = World::new(WorldParams::default()).unwrap();
    let k = w
        .add_figure(FigureSetup {
            name: "a".into(),
            body,
            strength: StrengthScale::default(),
            controller: kind,
            stepper: StepperKind::Torque,
            params: ControlParams::default(),
            state: State {
                posture: p,
                velocity: [0.; 45],
            },
        })
        .unwrap();
    if push > 0. {
        w.perturb(
            k,
            Perturbation::Force {
                segment: topology::CHEST,
                point: Vec3 {
                    x: 0.,
                    y: 0.,
                    z: 0.1,
                },
                force: Vec3 {
                    x: push / 0.1,
                    y: 0.,
                    z: 0.,
                },
                from: 0.5,
                to: 0.6,
            },
        )
        .unwrap();
    }
    let t0 = std::time::Instant::now();
    for i in 0..300 {
        w.step();
        let f = w.figure(k).unwrap();
        let r = f.report().unwrap();
        if i % 20 == 0 || i < 3 || !f.events().is_empty() {
            let fz: f64 = r.contacts.iter().map(|c| c.force.z).sum();
            let e = r
                .joint_error
                .iter()
                .fold(0f64, |m, e| m.max(e.abs()))
                .to_degrees();
            let mut idx: Vec<usize> = (0..39).collect();
            idx.sort_by(|a, b| r.joint_error[*b].abs().total_cmp(&r.joint_error[*a].abs()));
            println!(
                "{:?}",
                idx[..4]
                    .iter()
                    .map(|i| (topology::DOF_NAMES[*i], r.joint_error[*i].to_degrees()))
                    .collect::<Vec<_>>()
            );
            for c in &r.contacts {
                if i == 280 {
                    println!(
                        "  {} {} {:.4?} {:.1?}",
                        c.segment.name(),
                        c.vertex,
                        c.position.to_array(),
                        c.force.to_array()
                    );
                }
            }
            println!(
                "{i} com {:.3} {:.3} {:.3} fz {fz:.1} err {e:.3} zmp {:?} margin {:?} it {} {} sat {:x} flags {:x} pen {:.2e} over {:.1e} ev {:?}",
                r.com.x,
                r.com.y,
                r.com.z,
                r.zmp.map(|z| (z.x * 1e3).round()),
                r.margin.map(|m| (m * 1e3).round()),
                r.control_iterations,
                r.step_iterations,
                r.saturated,
                r.flags.0,
                r.penetration,
                r.over_limit,
                f.events()
            );
        }
    }
    println!("{:.1} us/tick", t0.elapsed().as_secs_f64() * 1e6 / 300.);
}
