//! The point at which a segment carries a load: the palm of a hand, or the centre of mass of any other segment.

use super::model::{Body, Mesh};
use super::topology::{L_HAND, R_HAND, SegmentId};
use crate::math::Vec3;

/// Point (segment frame, m) at which a segment carries a load for which no point is given.
///
/// * Hands: the middle of the palm. It lies on the palmar surface (left hand: facing −y, right hand: facing +y), at the
///   level of the hand's centre of mass, which is between the wrist and the base of the fingers.
/// * Other segments, and hands without a surface there: the centre of mass.
///
/// Allocates nothing. Call it when a load is given, not in every tick.
pub fn load_point(body: &Body, segment: SegmentId) -> Vec3 {
    let s = body.segment(segment);
    let side = match segment {
        L_HAND => -1.0,
        R_HAND => 1.0,
        _ => return s.com,
    };
    outermost(&s.mesh, s.com, side).map_or(s.com, |y| Vec3 { y, ..s.com })
}

/// The y of the surface farthest out in direction `side` (±1) on the line through `at` along y; `None` if the line
/// misses it.
fn outermost(mesh: &Mesh, at: Vec3, side: f64) -> Option<f64> {
    let hit = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize] - at);
        // Twice the signed areas of the triangles that the line makes with each edge, seen along y.
        let cross = |p: Vec3, q: Vec3| p.z * q.x - p.x * q.z;
        let (u, v, w) = (cross(b, c), cross(c, a), cross(a, b));
        let whole = u + v + w;
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        (inside && whole != 0.0).then(|| at.y + (u * a.y + v * b.y + w * c.y) / whole)
    };
    let hits = mesh.triangles.iter().filter_map(hit);
    hits.reduce(|far, y| if side * y > side * far { y } else { far })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::{CHEST, L_FOOT};
    use crate::body::{Profile, Sex};

    /// From the wrist to the knuckle of the middle finger over wrist to finger tip: 86.2 / 187.9 mm (de Leva 1996,
    /// men).
    const KNUCKLES: f64 = 0.459;

    fn bodies() -> Vec<Body> {
        let child = Profile {
            sex: Sex::Female,
            age: 8.0,
            height: 1.28,
            mass: 26.0,
        };
        vec![
            Body::adult_man(),
            Body::adult_woman(),
            Body::humanoid(child).expect("a body"),
        ]
    }

    #[test]
    fn a_hand_carries_in_the_middle_of_its_palm() {
        for body in bodies() {
            for (hand, side) in [(L_HAND, -1.0), (R_HAND, 1.0)] {
                let (s, at) = (body.segment(hand), load_point(&body, hand));
                // Along the hand: clear of the wrist and of the base of the fingers.
                let along = at.z / s.tip.z;
                assert!((0.2..KNUCKLES).contains(&along), "{along}");
                // Across it: on the palmar face, on the surface of the palm and not beyond it.
                let out = side * at.y;
                let most = s.mesh.vertices.iter().map(|v| side * v.y);
                let most = most.fold(0.0f64, f64::max);
                assert!(
                    (0.6 * most..=most + 1e-12).contains(&out),
                    "{out} of {most}"
                );
                assert!(at.x.abs() < 0.012, "{}", at.x);
            }
        }
    }

    #[test]
    fn hands_are_mirror_images_and_other_segments_carry_at_their_centre_of_mass() {
        for body in bodies() {
            let (l, r) = (load_point(&body, L_HAND), load_point(&body, R_HAND));
            assert!((l.x - r.x).abs() + (l.y + r.y).abs() + (l.z - r.z).abs() < 1e-12);
            for s in [CHEST, L_FOOT] {
                assert_eq!(load_point(&body, s), body.segment(s).com);
            }
        }
        let mut bare = Body::adult_man();
        bare.segments[R_HAND.index()].mesh = Mesh::default();
        assert_eq!(load_point(&bare, R_HAND), bare.segment(R_HAND).com);
    }
}
