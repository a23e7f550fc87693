//! One solve of an island of free bodies with a growing number of contacts: `bodies/contacts`. Time must grow with the
//! smaller of the two.
#![allow(missing_docs)] // criterion's macro writes undocumented functions

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use sinew_physics::collide::island::{Articulated, ArticulatedParts, ContactLaw, Island};
use sinew_physics::collide::narrow::Near;
use sinew_physics::math::Vec3;

/// No figure: the island consists of free bodies alone.
enum Nobody {}

impl Articulated for Nobody {
    fn parts(&mut self) -> ArticulatedParts<'_> {
        match *self {}
    }
}

/// Numbers that look random.
fn noise(i: usize) -> f64 {
    let x = (i as f64 * 12.9898).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

fn vector(i: usize) -> Vec3 {
    Vec3 {
        x: noise(3 * i),
        y: noise(3 * i + 1),
        z: noise(3 * i + 2),
    }
}

/// `bodies` in a ring that run into each other at `contacts` points.
fn fill(island: &mut Island, bodies: usize, contacts: usize) {
    island.clear();
    let inertia = [Vec3::X * 0.4, Vec3::Y * 0.3, Vec3::Z * 0.5];
    for i in 0..bodies {
        let (v, w) = (vector(7 * i), vector(7 * i + 3));
        let spin = Vec3 {
            x: 0.4 * w.x,
            y: 0.3 * w.y,
            z: 0.5 * w.z,
        };
        island.add_free(i, 5.0, inertia, [spin, v * 5.0], [w, v]);
    }
    for n in 0..contacts {
        let (a, b) = (n % bodies, (n + 1) % bodies);
        let r = vector(1000 + n) * 0.3;
        let normal = vector(2000 + n).normalized_or(Vec3::Z);
        island.add_contact(
            [Some(a), Some(b)],
            [(a, 0), (b, 0)],
            Near {
                position: r,
                normal,
                gap: 0.0,
            },
            ContactLaw {
                approach: -0.2,
                firm: Vec3::zero(),
                mu: 0.5,
                inverse_r: 1e4,
            },
            |_, visit| {
                for (k, e) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
                    visit(k, e.cross(r));
                    visit(3 + k, e);
                }
            },
        );
    }
}

fn solve(c: &mut Criterion) {
    let mut group = c.benchmark_group("island_solve");
    let mut island = Island::default();
    for (bodies, contacts) in [(4, 4), (4, 16), (4, 64), (10, 40), (10, 160)] {
        let id = BenchmarkId::new(bodies.to_string(), contacts);
        group.bench_function(id, |b| {
            b.iter(|| {
                fill(&mut island, bodies, contacts);
                island.solve::<Nobody>(&mut []).iterations
            });
        });
    }
    group.finish();
}

criterion_group!(benches, solve);
criterion_main!(benches);
