//! Writing postures as BVH: the body's own 18 segments, in the axes most tools expect.
//!
//! y up, z forward, x left; centimetres and degrees; joints named like VRM bones. The root has position and rotation
//! channels, every other joint three rotations, in the order Z, X, Y.

use crate::body::topology::{BONE_NAMES, PARENT, SEGMENT_COUNT};
use crate::body::{Body, Posture};
use crate::math::{Quat, Vec3};
use std::fmt::Write;

use super::leg_ik::forward;

/// Centimetres per metre.
const CM: f64 = 100.0;

/// World axes (x forward, y left, z up) to file axes (x left, y up, z forward): a cyclic exchange.
fn to_file(v: Vec3) -> Vec3 {
    Vec3 {
        x: v.y,
        y: v.z,
        z: v.x,
    }
}

/// Angles (a, b, c) with `q = Rz(a) Rx(b) Ry(c)`, rad; at the poles, where only a ± c is given, c is 0.
fn zxy_angles(q: Quat) -> [f64; 3] {
    let m = q.to_mat3(); // columns
    let across = m.x.z.hypot(m.z.z);
    let b = m.y.z.atan2(across);
    if across < 1e-9 {
        [m.x.y.atan2(m.x.x), b, 0.0]
    } else {
        [(-m.y.x).atan2(m.y.y), b, (-m.x.z).atan2(m.z.z)]
    }
}

/// Text of a BVH file that shows `postures` of `body`, `1/rate_hz` seconds apart.
///
/// Positions carry six decimals of a centimetre and angles seven of a degree, so every joint is read back to well below
/// a micrometre. Angles continue beyond ±180° from frame to frame. O(postures); the postures must be finite.
pub fn write_bvh(body: &Body, postures: &[Posture], rate_hz: f64) -> String {
    let mut out = String::with_capacity(4096 + postures.len() * 57 * 12);
    write_all(&mut out, body, postures, rate_hz).expect("a String takes any text");
    out
}

fn write_all(
    out: &mut String,
    body: &Body,
    postures: &[Posture],
    rate_hz: f64,
) -> std::fmt::Result {
    writeln!(out, "HIERARCHY")?;
    // Segments are in depth-first order: a joint closes when it is not the parent of the next one.
    let mut open: Vec<usize> = Vec::new();
    for s in 0..SEGMENT_COUNT {
        while open.last().is_some_and(|top| s > 0 && *top != PARENT[s]) {
            close(out, body, &mut open, s)?;
        }
        let tab = "\t".repeat(open.len());
        let (kind, offset) = if s == 0 {
            ("ROOT", Vec3::zero())
        } else {
            ("JOINT", body.joint_offset[s])
        };
        let offset = triple(offset);
        writeln!(
            out,
            "{tab}{kind} {}\n{tab}{{\n{tab}\tOFFSET {offset}",
            BONE_NAMES[s]
        )?;
        let channels = if s == 0 {
            "6 Xposition Yposition Zposition"
        } else {
            "3"
        };
        writeln!(
            out,
            "{tab}\tCHANNELS {channels} Zrotation Xrotation Yrotation"
        )?;
        open.push(s);
    }
    while !open.is_empty() {
        close(out, body, &mut open, SEGMENT_COUNT)?;
    }

    writeln!(out, "MOTION\nFrames: {}", postures.len())?;
    writeln!(out, "Frame Time: {:.10}", 1.0 / rate_hz)?;
    let mut last = [[0.0f64; 3]; SEGMENT_COUNT];
    for posture in postures {
        let poses = forward(body, posture);
        write!(out, "{}", triple(posture.root_position))?;
        for s in 0..SEGMENT_COUNT {
            let local = if s == 0 {
                poses[0].1
            } else {
                poses[PARENT[s]].1.conjugate() * poses[s].1
            };
            let axis = to_file(Vec3 {
                x: local.x,
                y: local.y,
                z: local.z,
            });
            let angles = zxy_angles(Quat {
                x: axis.x,
                y: axis.y,
                z: axis.z,
                w: local.w,
            });
            for k in 0..3 {
                let degrees = angles[k].to_degrees();
                let turns = ((last[s][k] - degrees) / 360.0).round();
                last[s][k] = degrees + 360.0 * turns;
                write!(out, " {:.7}", last[s][k])?;
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

fn triple(v: Vec3) -> String {
    let v = to_file(v) * CM;
    format!("{:.6} {:.6} {:.6}", v.x, v.y, v.z)
}

/// Closes the innermost joint; one without children (the joint before `next`) first gets its End Site.
fn close(out: &mut String, body: &Body, open: &mut Vec<usize>, next: usize) -> std::fmt::Result {
    let s = open.pop().expect("called with an open joint");
    let tab = "\t".repeat(open.len());
    if s + 1 == next {
        let tip = triple(body.segments[s].tip);
        writeln!(
            out,
            "{tab}\tEnd Site\n{tab}\t{{\n{tab}\t\tOFFSET {tip}\n{tab}\t}}"
        )?;
    }
    writeln!(out, "{tab}}}")
}

#[cfg(test)]
mod tests {
    use super::super::bvh::Bvh;
    use super::*;
    use crate::body::angles::set_anatomical_angles;
    use crate::body::topology::DOF_COUNT;
    use rand::{Rng, SeedableRng};

    #[test]
    fn what_is_written_reads_back_to_a_micrometre() {
        let body = Body::adult_woman();
        let mut random = rand_pcg::Pcg64::seed_from_u64(9);
        let mut posture = Posture::default();
        let mut postures = vec![posture];
        for i in 0..50 {
            let a: [f64; DOF_COUNT] =
                std::array::from_fn(|d| random.random_range(body.lower[d]..body.upper[d]));
            set_anatomical_angles(&mut posture, &a);
            let mut vector =
                |m: f64| Vec3::from_array([0.0; 3].map(|_: f64| random.random_range(-m..m)));
            posture.root_position = vector(5.0);
            posture.root_rotation = Quat::exp(vector(1.8));
            if i == 0 {
                // At a pole of the angles: file x by a quarter turn.
                posture.root_rotation = Quat::exp(Vec3::Y * std::f64::consts::FRAC_PI_2);
            }
            postures.push(posture);
        }
        let text = write_bvh(&body, &postures, 60.0);
        let bvh = Bvh::parse(text.as_bytes()).unwrap();
        assert!(bvh.warnings.is_empty());
        assert_eq!(bvh.frame_count, postures.len());
        assert!((bvh.frame_time - 1.0 / 60.0).abs() < 1e-9);
        assert_eq!(bvh.joints.len(), SEGMENT_COUNT);
        for (f, posture) in postures.iter().enumerate() {
            let read = bvh.world(f);
            let poses = forward(&body, posture);
            for s in 0..SEGMENT_COUNT {
                assert_eq!(bvh.joints[s].name, BONE_NAMES[s]);
                assert_eq!(bvh.joints[s].parent, (s > 0).then_some(PARENT[s]));
                let off = read[s].position * (1.0 / CM) - to_file(poses[s].0);
                assert!(
                    off.norm() < 1e-6,
                    "frame {f}, {}: {:e}",
                    BONE_NAMES[s],
                    off.norm()
                );
                if let Some(end) = bvh.end_site_world(s, &read) {
                    let tip = poses[s].0 + poses[s].1.rotate(body.segments[s].tip);
                    assert!((end * (1.0 / CM) - to_file(tip)).norm() < 1e-6);
                }
            }
        }
        let ends = bvh.joints.iter().filter(|j| j.end_site.is_some()).count();
        assert_eq!(ends, 5, "head, hands and toes end in the open");
    }

    #[test]
    fn angles_run_on_over_half_a_turn() {
        let body = Body::adult_man();
        let turning: Vec<Posture> = (0..100)
            .map(|i| Posture {
                root_rotation: Quat::exp(Vec3::Z * (0.1 * f64::from(i))),
                ..Posture::default()
            })
            .collect();
        let bvh = Bvh::parse(write_bvh(&body, &turning, 30.0).as_bytes()).unwrap();
        for f in 0..100 {
            let heading = bvh.frame(f)[5];
            assert!((heading - (0.1 * f as f64).to_degrees()).abs() < 1e-6);
        }
    }
}
