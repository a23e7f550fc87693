//! Keeps the demanded acceleration of the centre of mass within the range that the support polygon allows
//! (`docs/equations.md#repairs`, safeguard).

use crate::math::Vec3;
use crate::support::Polygon;

/// Distance inside the polygon at which the demanded zero-moment point is kept, m.
pub const INSET: f64 = 0.02;
/// Smallest height that is assumed for the centre of mass, m (a lying figure).
const LEAST_HEIGHT: f64 = 0.1;

/// Horizontal acceleration of the centre of mass closest to `demand` whose cart-table zero-moment point lies in
/// `inset`.
///
/// p = c_xy − (c_z/g) c̈;  c̈ = (g/c_z)(c_xy − p), with p replaced by its closest point of the polygon.
///
/// * `com`: world, m. `demand`: m/s². `inset`: the polygon, already inset. `gravity`: magnitude, m/s².
/// * Without polygon or gravity the demand is returned as it is.
pub fn feasible(com: Vec3, demand: [f64; 2], inset: &Polygon, gravity: f64) -> [f64; 2] {
    if gravity <= 0.0 {
        return demand;
    }
    let lever = com.z.max(LEAST_HEIGHT) / gravity;
    let p = [com.x - lever * demand[0], com.y - lever * demand[1]];
    match inset.closest(p) {
        Some(c) if c.point != p => [(com.x - c.point[0]) / lever, (com.y - c.point[1]) / lever],
        _ => demand,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::vec3;

    #[test]
    fn demand_is_kept_inside_and_cut_at_the_inset_edge() {
        let mut feet = Polygon::default();
        feet.set_hull([[-0.1, -0.15], [0.15, -0.15], [0.15, 0.15], [-0.1, 0.15]].into_iter());
        let mut inset = Polygon::default();
        inset.set_inset(&feet, INSET);
        let com = vec3(0.03, 0.0, 0.981);
        assert_eq!(feasible(com, [0.2, -0.3], &inset, 9.81), [0.2, -0.3]);
        // A strong push back asks for a zero-moment point in front of the toes: it is limited to 2 cm short of them.
        let a = feasible(com, [-5.0, 0.0], &inset, 9.81);
        assert!((a[0] - (0.03 - 0.13) / 0.1).abs() < 1e-12 && a[1].abs() < 1e-12);
        assert_eq!(
            feasible(com, [9.0, 9.0], &Polygon::default(), 9.81),
            [9.0, 9.0]
        );
        assert_eq!(feasible(com, [9.0, 9.0], &inset, 0.0), [9.0, 9.0]);
    }
}
