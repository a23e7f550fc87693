//! A recording with a little noise: tests whether an outcome depends on luck.

use sinew_physics::motion::Bvh;
use sinew_physics::motion::bvh::BvhChannel;

/// `bytes`, a BVH file that parses as `bvh`, with every number of its motion changed by up to `distance` (file units)
/// or `angle` (degrees). The changes are evenly distributed if the numbers from `random`, −1 to 1, are. `None` if the
/// file has no line that begins its motion.
pub fn noisy(
    bytes: &[u8],
    bvh: &Bvh,
    distance: f64,
    angle: f64,
    mut random: impl FnMut() -> f64,
) -> Option<String> {
    let text = String::from_utf8_lossy(bytes);
    let head = text.to_ascii_lowercase().find("frame time")?;
    let start = head + text[head..].find('\n')? + 1;
    let kinds: Vec<f64> = bvh
        .joints
        .iter()
        .flat_map(|j| &j.channels)
        .map(|c| match c {
            BvhChannel::Xposition | BvhChannel::Yposition | BvhChannel::Zposition => distance,
            BvhChannel::Xrotation | BvhChannel::Yrotation | BvhChannel::Zrotation => angle,
        })
        .collect();
    if kinds.is_empty() {
        return None;
    }
    let mut out = text[..start].to_owned();
    let numbers = text[start..].split_ascii_whitespace();
    for (i, word) in numbers.enumerate() {
        let kind = kinds[i % kinds.len()];
        let value: f64 = word.parse().ok()?;
        out.push_str(&format!("{:.6}", value + kind * random()));
        let ends = (i + 1) % kinds.len() == 0;
        out.push(if ends { '\n' } else { ' ' });
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    const FILE: &[u8] =
        b"HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation \
        Xrotation Yrotation\n\
        End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n1 2 3 40 50 60\n\
        1 2 3 41 51 61\n";

    #[test]
    fn noise_is_small_repeatable_and_keeps_the_form() {
        let bvh = Bvh::parse(FILE).unwrap();
        let copy = |seed| {
            let mut rng = Pcg64Mcg::seed_from_u64(seed);
            noisy(FILE, &bvh, 0.1, 1.0, || rng.random_range(-1.0..=1.0)).unwrap()
        };
        let a = copy(7);
        assert_eq!(a, copy(7));
        assert_ne!(a, copy(8));
        let lines: Vec<&str> = a.lines().rev().take(2).collect();
        for (line, want) in lines
            .iter()
            .zip([[1., 2., 3., 41., 51., 61.], [1., 2., 3., 40., 50., 60.]])
        {
            let got: Vec<f64> = line.split(' ').map(|w| w.parse().unwrap()).collect();
            for (k, (g, w)) in got.iter().zip(want).enumerate() {
                let most = if k < 3 { 0.1 } else { 1.0 };
                assert!((g - w).abs() <= most && g != &w, "{line}");
            }
        }
        assert_eq!(Bvh::parse(a.as_bytes()).unwrap().frame_count, 2);
    }
}
