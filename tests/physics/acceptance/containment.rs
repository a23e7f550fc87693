//! Goal: a world checks its input, and names the fault when it refuses; a runaway figure is frozen and harms no other.
//! Method: one bad number at a time; the hash of the neighbours.

use crate::acceptance::vec3;
use crate::common::{Scene, authored, bent, figure, man, play, still};
use sinew_physics::body::State;
use sinew_physics::body::topology::{CHEST, R_HAND};
use sinew_physics::figure::{ControlParams, ControllerKind, Flags, Perturbation, StrengthScale};
use sinew_physics::math::Vec3;
use sinew_physics::world::{FigureKey, FigureSetup, World, WorldError, WorldParams};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn refused(what: Result<impl Sized, WorldError>, field: &str) {
    match what {
        Err(WorldError::Range { field: f, .. } | WorldError::Interval { field: f, .. }) => {
            assert_eq!(f, field)
        }
        Err(e) => panic!("{field}: {e}"),
        Ok(_) => panic!("{field} was taken"),
    }
}

#[test]
fn worlds_refuse_parameters_out_of_range() {
    let of = |edit: fn(&mut WorldParams, f64), x: f64| {
        let mut p = WorldParams::default();
        edit(&mut p, x);
        World::new(p)
    };
    for x in BAD {
        refused(of(|p, x| p.rate_hz = x, x), "rate_hz");
        refused(of(|p, x| p.gravity = x, x), "gravity_mps2");
        refused(of(|p, x| p.friction = x, x), "friction");
    }
    refused(of(|p, x| p.rate_hz = x, 9.0), "rate_hz");
    refused(of(|p, x| p.substeps = x as u32, 0.0), "substeps");
    refused(of(|p, x| p.substeps = x as u32, 17.0), "substeps");
    refused(of(|p, x| p.threads = x as usize, 0.0), "threads");
    refused(of(|p, x| p.gravity = x, -9.81), "gravity_mps2");
}

#[test]
fn worlds_refuse_bad_figures_and_do_not_change() {
    let body = man();
    let good = || figure(&body, ControllerKind::Modern, still(bent(&body, 0.3)));
    let mut world = World::new(WorldParams::default()).unwrap();
    world.add_figure(good()).unwrap();
    let before = world.state_hash();
    let edits: [(&str, fn(&mut FigureSetup, f64)); 9] = [
        ("strength.all", |s, x| s.strength.all = x),
        ("strength.dof", |s, x| s.strength.dof[38] = x),
        ("control.alpha", |s, x| s.params.alpha = x),
        ("control.horizon_s", |s, x| s.params.horizon = Some(x)),
        ("state.root_position_m", |s, x| {
            s.state.posture.root_position.y = x
        }),
        ("state.rotation", |s, x| s.state.posture.root_rotation.w = x),
        ("state.rotation", |s, x| s.state.posture.ball[8].x = x),
        ("state.joint_angle_rad", |s, x| {
            s.state.posture.hinge[11] = x
        }),
        ("state.velocity", |s, x| s.state.velocity[44] = x),
    ];
    for (field, edit) in edits {
        for x in BAD.into_iter().chain([1e7, -1e7]) {
            let mut setup = good();
            edit(&mut setup, x);
            refused(world.add_figure(setup), field);
        }
    }
    assert_eq!((world.state_hash(), world.figures().count()), (before, 1));
}

#[test]
fn worlds_refuse_bad_changes_of_figures() {
    let body = man();
    let mut scene = Scene::of(figure(
        &body,
        ControllerKind::Modern,
        still(bent(&body, 0.3)),
    ));
    let key = scene.key;
    let before = scene.world.state_hash();
    let force = |force: Vec3, point: Vec3, from: f64, to: f64| Perturbation::Force {
        segment: CHEST,
        point,
        force,
        from,
        to,
    };
    let load = |mass: f64, point: Vec3| Perturbation::Load {
        segment: R_HAND,
        point,
        mass,
        from: 0.0,
        to: 1.0,
    };
    let o = Vec3::zero();
    for x in BAD {
        refused(
            scene
                .world
                .perturb(key, force(vec3(0.0, x, 0.0), o, 0.0, 1.0)),
            "force.force_newtons",
        );
        refused(
            scene
                .world
                .perturb(key, force(o, vec3(x, 0.0, 0.0), 0.0, 1.0)),
            "force.point_m",
        );
        refused(scene.world.perturb(key, load(x, o)), "load.mass_kg");
        refused(
            scene.world.perturb(key, load(1.0, vec3(0.0, 0.0, x))),
            "load.point_m",
        );
    }
    refused(
        scene.world.perturb(key, force(Vec3::X * 1e9, o, 0.0, 1.0)),
        "force.force_newtons",
    );
    refused(scene.world.perturb(key, load(-1.0, o)), "load.mass_kg");
    refused(scene.world.perturb(key, load(501.0, o)), "load.mass_kg");
    refused(
        scene.world.perturb(key, force(o, o, f64::NAN, 1.0)),
        "perturbation.from_s",
    );
    refused(
        scene.world.perturb(key, force(o, o, 0.0, f64::NAN)),
        "perturbation",
    );
    refused(
        scene.world.perturb(key, force(o, o, 1.0, 0.5)),
        "perturbation",
    );

    let mut state = State::default();
    state.velocity[3] = f64::NAN;
    refused(scene.world.reset_figure(key, state), "state.velocity");
    let strength = StrengthScale {
        all: 0.0,
        ..StrengthScale::default()
    };
    let kind = ControllerKind::Paper;
    refused(
        scene
            .world
            .retune_figure(key, strength, kind, ControlParams::default()),
        "strength.all",
    );
    assert_eq!(
        scene.figure().setup().controller,
        ControllerKind::Modern,
        "nothing changed"
    );

    let nobody = FigureKey(99);
    assert_eq!(
        scene.world.perturb(nobody, load(1.0, o)),
        Err(WorldError::UnknownFigure(nobody))
    );
    assert_eq!(
        scene.world.reset_figure(nobody, State::default()),
        Err(WorldError::UnknownFigure(nobody))
    );
    assert!(!scene.world.remove_figure(nobody));
    for _ in 0..64 {
        scene.world.perturb(key, load(0.01, o)).unwrap();
    }
    assert_eq!(
        scene.world.perturb(key, load(0.01, o)),
        Err(WorldError::TooManyPerturbations)
    );
    assert_eq!(scene.world.state_hash(), before);
}

#[test]
fn a_figure_that_is_torn_apart_is_braked_and_harms_nobody() {
    let body = man();
    let clip = authored(&body, "lift");
    // The neighbour's hashes, with and without a figure torn apart beside it.
    let run = |torn: bool| {
        let mut world = World::new(WorldParams::default()).unwrap();
        let state = still(clip.posture(0).to_owned());
        let key = world
            .add_figure(figure(&body, ControllerKind::Modern, state))
            .unwrap();
        world.figure_mut(key).unwrap().set_drive(play(&clip));
        let mut victim = None;
        if torn {
            let v = world
                .add_figure(figure(&body, ControllerKind::Modern, state))
                .unwrap();
            let what = Perturbation::Force {
                segment: R_HAND,
                point: Vec3::X * 10.0,
                force: Vec3::Y * 1e6,
                from: 0.5,
                to: 1.0,
            };
            world.perturb(v, what).unwrap();
            victim = Some(v);
        }
        let mut braked = 0;
        let hashes: Vec<u64> = (0..180)
            .map(|_| {
                world.step();
                if let Some(f) = victim.and_then(|v| world.figure(v)) {
                    let flags = f.report().unwrap().flags;
                    assert!(!flags.has(Flags::QUARANTINED));
                    braked += u64::from(flags.has(Flags::SPEED_BOUND));
                    assert!(f.state().is_finite());
                    assert!(
                        f.state()
                            .velocity
                            .iter()
                            .all(|v| v.abs() <= 200.0 * (1.0 + 1e-12))
                    );
                }
                world.figure(key).unwrap().state_hash()
            })
            .collect();
        (hashes, braked, world, victim)
    };
    let (alone, ..) = run(false);
    let (beside, braked, mut world, victim) = run(true);
    assert_eq!(alone, beside);
    assert!(braked > 10, "{braked} ticks");
    let victim = victim.unwrap();
    // A reset brings it back from the place to which it was thrown.
    world
        .reset_figure(victim, still(clip.posture(0).to_owned()))
        .unwrap();
    for _ in 0..60 {
        world.step();
    }
    let f = world.figure(victim).unwrap();
    assert!(!f.report().unwrap().flags.has(Flags::SPEED_BOUND) && !f.is_fallen());
}
