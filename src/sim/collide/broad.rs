//! Finds the bodies that may meet: sweep and prune along x, in a fixed order.

use crate::math::Vec3;

/// A box along the world's axes that holds a body for a whole tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least corner, m.
    pub low: Vec3,
    /// Largest corner, m.
    pub high: Vec3,
    /// Index of the body.
    pub body: usize,
    /// Whether anything can move the body; two immovable bodies never meet.
    pub moves: bool,
}

impl Bounds {
    fn meets(&self, o: &Self) -> bool {
        self.low.x <= o.high.x
            && o.low.x <= self.high.x
            && self.low.y <= o.high.y
            && o.low.y <= self.high.y
            && self.low.z <= o.high.z
            && o.low.z <= self.high.z
    }
}

/// Finds all pairs of boxes that overlap, as (smaller, larger) body index in ascending order. `boxes` is reordered.
///
/// O(n log n) plus the number of pairs that overlap along x. Allocates only while `pairs` grows.
pub fn pairs(boxes: &mut [Bounds], pairs: &mut Vec<(usize, usize)>) {
    pairs.clear();
    boxes.sort_unstable_by(|a, b| a.low.x.total_cmp(&b.low.x).then(a.body.cmp(&b.body)));
    for (i, a) in boxes.iter().enumerate() {
        for b in &boxes[i + 1..] {
            if b.low.x > a.high.x {
                break;
            }
            if (a.moves || b.moves) && a.meets(b) {
                pairs.push((a.body.min(b.body), a.body.max(b.body)));
            }
        }
    }
    pairs.sort_unstable();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::vec3;
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    #[test]
    fn sweep_finds_what_trying_all_pairs_finds() {
        let mut rng = Pcg64Mcg::seed_from_u64(5);
        for _ in 0..50 {
            let boxes: Vec<Bounds> = (0..40)
                .map(|body| {
                    let mut r = || rng.random_range(-3.0..3.0);
                    let low = vec3(r(), r(), r());
                    let size = vec3(1.0, 1.5, 1.2);
                    Bounds {
                        low,
                        high: low + size,
                        body,
                        moves: body % 3 != 0,
                    }
                })
                .collect();
            let mut expected = Vec::new();
            for i in 0..40 {
                for j in i + 1..40 {
                    if (boxes[i].moves || boxes[j].moves) && boxes[i].meets(&boxes[j]) {
                        expected.push((i, j));
                    }
                }
            }
            let (mut shuffled, mut found) = (boxes.clone(), Vec::new());
            shuffled.reverse();
            pairs(&mut shuffled, &mut found);
            assert_eq!(found, expected);
        }
    }
}
