//! Each of eight figures in lock-step has the bits that it would have alone: every kernel, a different body and state
//! per lane, through the plain generic code and through the run-time dispatch to the machine's widest instructions.

use super::GRAVITY;
use super::bodies::{
    components, generator, loaded, random_body, random_loads, random_state, vector,
};
use sinew_physics::body::topology::{BALL_COUNT, HINGE_COUNT};
use sinew_physics::body::{Links, NV, Posture, SEGMENT_COUNT, State};
use sinew_physics::dynamics::jacobian::{bias_accelerations, for_each_column};
use sinew_physics::dynamics::{
    AbaWorkspace, CompositeInertia, External, ExternalForces, Kinematics, MassMatrix,
    RneaWorkspace, aba, center_of_mass, crba, factor, kinetic_energy, lanes, momentum, rnea, solve,
};
use sinew_physics::math::{F64x8, Lane, Mat3, Sym3, Vec3};

/// Every number that the kernels produce from one input, in a fixed order.
#[derive(Default)]
struct Out<L>(Vec<L>);

impl<L: Lane> Out<L> {
    fn vec(&mut self, v: Vec3<L>) {
        self.0.extend([v.x, v.y, v.z]);
    }
    fn mat(&mut self, m: Mat3<L>) {
        self.vec(m.x);
        self.vec(m.y);
        self.vec(m.z);
    }
    fn sym(&mut self, s: Sym3<L>) {
        self.0.extend([s.xx, s.yy, s.zz, s.xy, s.xz, s.yz]);
    }
    fn posture(&mut self, p: &Posture<L>) {
        self.vec(p.root_position);
        for q in [p.root_rotation].iter().chain(&p.ball) {
            self.0.extend([q.x, q.y, q.z, q.w]);
        }
        self.0.extend(p.hinge);
    }
}

/// Inputs of one figure, or of eight.
struct Input<L> {
    links: Links<L>,
    state: State<L>,
    vdot: [L; NV],
    external: Vec<External<L>>,
}

fn kernels<L: Lane>(input: &Input<L>) -> Out<L> {
    let Input {
        links,
        state,
        vdot,
        external,
    } = input;
    let g = L::splat(GRAVITY);
    let mut out = Out(Vec::new());
    let mut kin = Kinematics::default();
    kin.set_state(links, state);
    for s in 0..SEGMENT_COUNT {
        out.mat(kin.rotation[s]);
        out.vec(kin.position[s]);
        out.vec(kin.moment[s]);
        out.sym(kin.inertia[s]);
        out.vec(kin.omega[s]);
        out.vec(kin.velocity[s]);
        out.vec(kin.omega_between[s]);
        out.vec(kin.joint_bias(s, &state.velocity));
    }
    for a in kin.axis {
        out.vec(a);
    }
    let mut tau = [L::zero(); NV];
    let mut ws = RneaWorkspace::default();
    rnea(
        links,
        &kin,
        &state.velocity,
        vdot,
        ExternalForces {
            gravity: g,
            on_segments: external,
        },
        &mut ws,
        &mut tau,
    );
    out.0.extend(tau);
    let (mut ci, mut m) = (CompositeInertia::default(), MassMatrix::default());
    crba(links, &kin, &mut ci, &mut m);
    for s in 0..SEGMENT_COUNT {
        out.0.push(ci.mass[s]);
        out.vec(ci.moment[s]);
        out.sym(ci.inertia[s]);
    }
    out.0.extend(m.rows.iter().flatten().copied());
    let mut product = [L::zero(); NV];
    m.mul(vdot, &mut product);
    out.0.extend(product);
    factor(&mut m);
    out.0.extend(m.rows.iter().flatten().copied());
    let mut x = tau;
    solve(&m, &mut x);
    out.0.extend(x);
    let mut acc = [L::zero(); NV];
    aba(
        links,
        &kin,
        &state.velocity,
        &tau,
        ExternalForces {
            gravity: g,
            on_segments: external,
        },
        &mut AbaWorkspace::default(),
        &mut acc,
    );
    out.0.extend(acc);
    let (com, mass) = center_of_mass(links, &kin);
    out.vec(com);
    out.0.push(mass);
    let p = momentum(links, &kin);
    out.vec(p.linear);
    out.vec(p.angular);
    out.0.push(kinetic_energy(links, &kin));
    for s in 0..SEGMENT_COUNT {
        for_each_column(&kin, s, kin.position[s], |_, a, v| {
            out.vec(a);
            out.vec(v);
        });
    }
    bias_accelerations(&kin, &state.velocity, &mut ws);
    for s in 0..SEGMENT_COUNT {
        out.vec(ws.alpha[s]);
        out.vec(ws.acceleration[s]);
    }
    let mut later = state.posture;
    later.integrate(&state.velocity, L::splat(1.0 / 120.0));
    out.posture(&later);
    out.0.extend(state.posture.difference(&later));
    out
}

fn inputs(seed: u64) -> (Input<F64x8>, Vec<Input<f64>>) {
    let mut rng = generator(seed);
    let one: Vec<Input<f64>> = (0..8)
        .map(|k| {
            let body = random_body(&mut rng, 0.05);
            let loads = random_loads(&mut rng);
            let mut state = random_state(&mut rng, 2.5);
            if k == 3 {
                // A lane at rest in the zero pose takes the branches for small angles; the others do not.
                state = State::default();
            }
            Input {
                links: loaded(&body, &loads),
                state,
                vdot: components(&mut rng, 50.0),
                external: (0..SEGMENT_COUNT)
                    .map(|_| External {
                        moment: vector(&mut rng, 20.0),
                        force: vector(&mut rng, 200.0),
                    })
                    .collect(),
            }
        })
        .collect();
    let zero = External {
        moment: Vec3::zero(),
        force: Vec3::zero(),
    };
    let mut all = Input {
        links: Links::splat(&one[0].links),
        state: State::default(),
        vdot: [F64x8::zero(); NV],
        external: vec![zero; SEGMENT_COUNT],
    };
    for (k, i) in one.iter().enumerate() {
        all.links.set_lane(k, &i.links);
        all.state.set_lane(k, &i.state);
        for n in 0..NV {
            all.vdot[n].set_lane(k, i.vdot[n]);
        }
        for (e, f) in all.external.iter_mut().zip(&i.external) {
            e.moment.set_lane(k, f.moment);
            e.force.set_lane(k, f.force);
        }
    }
    (all, one)
}

#[test]
fn every_kernel_gives_each_lane_the_bits_of_one_figure() {
    for seed in 0..8 {
        let (all, one) = inputs(500 + seed);
        let batch = kernels(&all);
        for (k, input) in one.iter().enumerate() {
            let alone = kernels(input);
            assert_eq!(alone.0.len(), batch.0.len());
            for (n, (x, y)) in alone.0.iter().zip(&batch.0).enumerate() {
                assert!(x.is_finite());
                assert_eq!(
                    x.to_bits(),
                    y.lane(k).to_bits(),
                    "number {n} of lane {k}: {x} alone, {} in the batch",
                    y.lane(k)
                );
            }
            // The inputs are unchanged.
            assert_eq!(all.state.lane(k), input.state);
        }
        const { assert!(BALL_COUNT * 3 + HINGE_COUNT == 39) };
    }
}

#[test]
fn dispatch_to_wide_instructions_gives_the_same_bits() {
    for seed in 0..8 {
        let (all, _) = inputs(600 + seed);
        let g = F64x8::splat(GRAVITY);
        let zero = [F64x8::zero(); NV];

        let (mut kin, mut ws, mut tau) = (Kinematics::default(), RneaWorkspace::default(), zero);
        lanes::rnea_x8(
            &all.links,
            &all.state,
            &all.vdot,
            ExternalForces {
                gravity: g,
                on_segments: &all.external,
            },
            &mut kin,
            &mut ws,
            &mut tau,
        );
        let (mut ci, mut m) = (CompositeInertia::default(), MassMatrix::default());
        lanes::crba_x8(&all.links, &kin, &mut ci, &mut m);
        let inertia = m.clone();
        let mut x = tau;
        lanes::factor_solve_x8(&mut m, &mut x);
        let mut acc = zero;
        lanes::aba_x8(
            &all.links,
            &kin,
            &all.state.velocity,
            &tau,
            ExternalForces {
                gravity: g,
                on_segments: &all.external,
            },
            &mut AbaWorkspace::default(),
            &mut acc,
        );

        let (mut kin1, mut tau1) = (Kinematics::default(), zero);
        kin1.set_state(&all.links, &all.state);
        rnea(
            &all.links,
            &kin1,
            &all.state.velocity,
            &all.vdot,
            ExternalForces {
                gravity: g,
                on_segments: &all.external,
            },
            &mut ws,
            &mut tau1,
        );
        let mut m1 = MassMatrix::default();
        crba(&all.links, &kin1, &mut ci, &mut m1);
        assert_eq!(inertia, m1);
        factor(&mut m1);
        assert_eq!(m, m1);
        let mut x1 = tau1;
        solve(&m1, &mut x1);
        let mut acc1 = zero;
        aba(
            &all.links,
            &kin1,
            &all.state.velocity,
            &tau1,
            ExternalForces {
                gravity: g,
                on_segments: &all.external,
            },
            &mut AbaWorkspace::default(),
            &mut acc1,
        );
        assert_eq!((tau, x, acc), (tau1, x1, acc1));
    }
}
