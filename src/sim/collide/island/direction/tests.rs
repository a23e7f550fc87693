//! Goal: the direction does not depend on the space in which the coupling is solved. Method: random figures and free
//! bodies with random contacts between them and with fixed objects are solved in both spaces, and the equation itself
//! is checked.

use super::*;
use crate::collide::island::ContactLaw;
use crate::collide::narrow::Near;
use crate::contact::{ContactRows, Interior, LimitRows, Motors, NewtonWorkspace};
use crate::dynamics::Terms;
use crate::dynamics::mass_matrix::MassMatrix;
use crate::dynamics::terms::WIDTH;
use crate::math::Vec3;
use crate::math::vec3::vec3;
use crate::support::testing::{Rng, mannequin, random_state, terms};

pub(in super::super) struct Puppet {
    pub(in super::super) terms: Terms,
    hessian: MassMatrix<f64>,
    pub(in super::super) b: [f64; NV],
    pub(in super::super) motors: Motors,
    pub(in super::super) limits: LimitRows,
    pub(in super::super) contacts: ContactRows,
    newton: NewtonWorkspace,
    interior: Interior,
    pub(in super::super) x: [f64; NV],
}

impl Articulated for Puppet {
    fn parts(&mut self) -> ArticulatedParts<'_> {
        ArticulatedParts {
            m: &self.terms.mass_matrix,
            hessian: &mut self.hessian,
            b: &self.b,
            motors: &self.motors,
            limits: &self.limits,
            contacts: &self.contacts,
            newton: &mut self.newton,
            interior: &mut self.interior,
            x: &mut self.x,
        }
    }
}

fn vector(rng: &mut Rng) -> Vec3 {
    vec3(rng.unit(), rng.unit(), rng.unit())
}

pub(in super::super) fn numbers(rng: &mut Rng) -> [f64; NV] {
    std::array::from_fn(|_| rng.unit())
}

/// Two figures and two free bodies with `count` contacts.
pub(in super::super) fn scene(rng: &mut Rng, count: usize) -> (Island, Vec<Puppet>) {
    let body = mannequin();
    let mut figures: Vec<Puppet> = (0..2)
        .map(|_| Puppet {
            terms: terms(&body, &random_state(&body, rng, 0.8, 1.0)),
            hessian: MassMatrix::default(),
            b: numbers(rng),
            motors: Motors::default(),
            limits: LimitRows::default(),
            contacts: ContactRows::new(0.9),
            newton: NewtonWorkspace::default(),
            interior: Interior::default(),
            x: numbers(rng),
        })
        .collect();
    let mut island = Island::default();
    for i in 0..2 {
        island.add_figure(i);
        let inertia = [Vec3::X * 0.3, Vec3::Y * 0.2, Vec3::Z * 0.4];
        let (p, v) = ([vector(rng), vector(rng)], [vector(rng), vector(rng)]);
        island.add_free(i, 3.0, inertia, p, v);
    }
    for n in 0..count {
        let (a, b) = [(0, 2), (0, 1), (3, 2), (1, 3), (0, 4), (4, 1)][n % 6];
        let block = [(a < 4).then_some(a), (b < 4).then_some(b)];
        let normal = vector(rng).normalized_or(Vec3::Z);
        // Use real chains: the columns of one segment.
        let parts = [rng.unit(), rng.unit()].map(|u| (9.0 + 8.9 * u) as usize);
        let r = vector(rng);
        island.add_contact(
            block,
            [(a, 0), (b, 0)],
            Near {
                position: r,
                normal,
                gap: 0.0,
            },
            ContactLaw {
                approach: -0.5 * rng.unit().abs() - 0.5,
                firm: Vec3::zero(),
                mu: 0.6,
                inverse_r: 1e4,
            },
            |side, visit| {
                let k = if side == 0 { a } else { b };
                if k % 2 == 0 {
                    let kin = &figures[k / 2].terms.kin;
                    crate::dynamics::jacobian::for_each_column(kin, parts[side], r, |i, _, v| {
                        visit(i, v)
                    });
                } else {
                    for (i, e) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
                        visit(i, e.cross(r));
                        visit(3 + i, e);
                    }
                }
            },
        );
    }
    island.start(&mut figures);
    island.gradients(&mut figures);
    (island, figures)
}

/// Largest difference of `H d` from minus the gradient, relative to its largest entry.
fn residual(island: &Island, figures: &[Puppet]) -> f64 {
    let (mut worst, mut scale) = (0.0f64, 0.0f64);
    let mut out: Vec<[f64; NV]> = Vec::new();
    for b in &island.blocks {
        let mut y = [0.0; NV];
        match b.kind {
            BlockKind::Figure(i) => {
                let mut dense = [[0.0; WIDTH]; NV];
                figures[i].terms.mass_matrix.to_dense(&mut dense);
                for (y, row) in y.iter_mut().zip(&dense) {
                    *y = row.iter().zip(&b.d).map(|(m, d)| m * d).sum();
                }
            }
            BlockKind::Free(_) => {
                for (y, row) in y.iter_mut().zip(&b.a) {
                    *y = row.iter().zip(&b.d).map(|(m, d)| m * d).sum();
                }
            }
        }
        out.push(y);
    }
    for c in &island.contacts {
        let u = super::super::relative(c, |b| &island.blocks[b].d).to_array();
        let f = stiffness(c).map(|row| row.iter().zip(&u).map(|(k, u)| k * u).sum::<f64>());
        for side in 0..2 {
            if let Some(b) = c.block[side] {
                for (row, f) in c.rows[side].iter().zip(f) {
                    for (y, r) in out[b].iter_mut().zip(row) {
                        *y += f * r;
                    }
                }
            }
        }
    }
    for (b, y) in island.blocks.iter().zip(&out) {
        for (g, y) in b.grad[..b.len()].iter().zip(y) {
            worst = worst.max((y + g).abs());
            scale = scale.max(g.abs());
        }
    }
    worst / scale
}

#[test]
fn both_spaces_give_the_direction_that_solves_newtons_equation() {
    let mut rng = Rng::new(5);
    for count in [0, 1, 5, 20, 60, 150] {
        let (mut island, mut figures) = scene(&mut rng, count);
        let touching = |c: &&Contact| c.region != Region::Open;
        let touching = island.contacts.iter().filter(touching).count();
        assert!(touching * 3 >= count, "{touching} of {count} touch");
        island.block_matrices(&mut figures, false);
        assert!(island.by_contacts(&mut figures));
        let r = residual(&island, &figures);
        assert!(r < 1e-9, "{count}: by contacts {r:e}");
        let first: Vec<[f64; NV]> = island.blocks.iter().map(|b| b.d).collect();
        let n = island.blocks.iter().map(Block::len).sum();
        island.block_matrices(&mut figures, false);
        assert!(island.by_velocities(&mut figures, n));
        let r = residual(&island, &figures);
        assert!(r < 1e-9, "{count}: by velocities {r:e}");
        for (a, b) in first.iter().zip(&island.blocks) {
            let scale = a.iter().fold(1e-3f64, |m, x| m.max(x.abs()));
            for (x, y) in a.iter().zip(&b.d) {
                assert!((x - y).abs() < 1e-7 * scale, "{count}: {x} {y}");
            }
        }
    }
}
