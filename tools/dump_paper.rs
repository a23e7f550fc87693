//! Writes the data that `tests/oracle/test_paper.py` checks: support ratios (2) on planes of any slope, and impacts of
//! §3 of the paper: `cargo run -p tools --bin dump_paper -- FILE.json [CASES]`.

#[allow(dead_code)] // loads are for the other example
#[path = "../tests/physics/oracle/bodies.rs"]
mod bodies;

use bodies::{generator, random_body, random_state, vector};
use serde_json::{Value, json};
use sinew_physics::body::topology::{CHEST, L_FOOT, NV, R_FOOT, R_HAND};
use sinew_physics::body::{DOF_COUNT, Links, SegmentId};
use sinew_physics::dynamics::Terms;
use sinew_physics::dynamics::jacobian::for_each_column;
use sinew_physics::math::Vec3;
use sinew_physics::paper::impact::{Impact, ImpactRow};
use sinew_physics::support::ratio::{Touching, support_ratios};
use std::error::Error;

/// Supports on planes of any slope, each with some contacts.
fn supports(case: usize) -> Value {
    let mut rng = generator(4_000 + case as u64);
    let com = vector(&mut rng, 1.0);
    let pull = vector(&mut rng, 6.0) + Vec3::Z * 9.81;
    let mut contacts = Vec::new();
    for support in [L_FOOT, R_FOOT, R_HAND].into_iter().take(1 + case % 3) {
        let normal = vector(&mut rng, 1.0).normalized_or(Vec3::Z);
        let centre = vector(&mut rng, 1.0);
        for _ in 0..=case % 4 {
            let off = vector(&mut rng, 0.1);
            contacts.push(Touching {
                support,
                position: centre + (off - normal * normal.dot(off)),
                normal,
            });
        }
    }
    let ratio = support_ratios(contacts.iter().copied(), com, pull);
    json!({
        "com": com.to_array(),
        "pull": pull.to_array(),
        "contacts": contacts.iter().map(|c| json!({
            "support": c.support.index(),
            "position": c.position.to_array(),
            "normal": c.normal.to_array(),
        })).collect::<Vec<_>>(),
        "ratio": ratio.to_vec(),
    })
}

/// Rows of a point of a segment along `n`.
fn along(t: &Terms, s: SegmentId, at: Vec3, n: Vec3) -> [f64; NV] {
    let mut row = [0.0; NV];
    let r = at - t.state.posture.root_position;
    for_each_column(&t.kin, s.index(), r, |k, _, v| row[k] = n.dot(v));
    row
}

/// Two bodies that meet at some points; in every other case one of them stands on a foot.
fn impact(case: usize) -> Value {
    let mut rng = generator(5_000 + case as u64);
    let mut system = Impact::default();
    let mut terms = Vec::new();
    for _ in 0..2 {
        let mut body = random_body(&mut rng, 0.0);
        body.armature = [0.0; DOF_COUNT];
        let state = random_state(&mut rng, 1.0);
        let mut t = Terms::default();
        t.compute(&Links::new(&body), &state, &[], 9.81);
        system.add_body(&t.mass_matrix, &state.velocity);
        terms.push(t);
    }
    let mut rows = Vec::new();
    if case.is_multiple_of(2) {
        let t = &terms[0];
        let at = t.segment_position(L_FOOT.index());
        for n in [Vec3::X, Vec3::Y, Vec3::Z] {
            let mut row = ImpactRow::new([Some(0), None], 0);
            row.jacobian[0] = along(t, L_FOOT, at, n);
            rows.push((row, [at, n]));
        }
    }
    for k in 0..1 + case % 4 {
        let n = vector(&mut rng, 1.0).normalized_or(Vec3::X);
        let at = vector(&mut rng, 0.5);
        let mut row = ImpactRow::new([Some(0), Some(1)], 1 + k);
        row.jacobian = [
            along(&terms[0], CHEST, at, n),
            along(&terms[1], R_HAND, at, n * -1.0),
        ];
        (row.least, row.one_sided) = (0.0, true);
        rows.push((row, [at, n]));
    }
    for (row, _) in &rows {
        system.add_row(row.clone());
    }
    system.solve();
    json!({
        "bodies": terms.iter().enumerate().map(|(b, t)| json!({
            "mass_matrix": t.m.iter().map(|r| r[..NV].to_vec()).collect::<Vec<_>>(),
            "root": t.state.posture.root_position.to_array(),
            "before": t.state.velocity.to_vec(),
            "after": system.velocity(b).to_vec(),
        })).collect::<Vec<_>>(),
        "rows": rows.iter().enumerate().map(|(k, (row, [at, n]))| json!({
            "bodies": row.bodies,
            "jacobian": row.jacobian.iter().map(|j| j.to_vec()).collect::<Vec<_>>(),
            "one_sided": row.one_sided,
            "position": at.to_array(),
            "normal": n.to_array(),
            "impulse": system.impulse(k),
        })).collect::<Vec<_>>(),
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments
        .next()
        .ok_or("usage: dump_paper FILE.json [CASES]")?;
    let count: usize = arguments.next().map_or(Ok(40), |n| n.parse())?;
    let all = json!({
        "supports": (0..5 * count).map(supports).collect::<Vec<_>>(),
        "impacts": (0..count).map(impact).collect::<Vec<_>>(),
    });
    std::fs::write(file, all.to_string())?;
    Ok(())
}
