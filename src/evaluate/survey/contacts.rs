//! Foot contacts of a figure against the labels of the recording.

use super::outcome::TouchDowns;
use super::stats::median;
use sinew_physics::math::rounding::short;
use sinew_physics::math::runs::runs;

/// A touch-down and its counterpart are at most this far apart, s: a third of a walking step.
pub const MATCH_S: f64 = 0.3;
/// Contacts and gaps shorter than this are chatter, s: the same value as for the labels.
pub const CHATTER_S: f64 = 0.08;

/// Contact of one foot, tick by tick, without gaps and touches shorter than [`CHATTER_S`].
pub fn settled(down: &[bool], dt: f64) -> Vec<bool> {
    let mut out = down.to_vec();
    let short = |i: usize, j: usize| ((j - i) as f64) * dt < CHATTER_S - 1e-9;
    for value in [false, true] {
        for (i, j, v) in runs(&out.clone()) {
            // A contact or gap that begins before the first tick or ends after the last may be longer than it looks.
            if v == value && i > 0 && j < out.len() && short(i, j) {
                out[i..j].fill(!value);
            }
        }
    }
    out
}

/// Ticks at which a foot comes down, not counting the first tick.
fn touch_downs(down: &[bool]) -> Vec<usize> {
    (1..down.len())
        .filter(|i| down[*i] && !down[*i - 1])
        .collect()
}

/// Touch-downs of both feet against the labels.
///
/// * `down`, `label`: left and right, tick by tick, [`settled`]; `dt`: length of a tick, s.
///
/// The nearest pairs of one foot are matched, each touch-down once.
pub fn match_touch_downs(down: &[Vec<bool>; 2], label: &[Vec<bool>; 2], dt: f64) -> TouchDowns {
    let mut out = TouchDowns::default();
    let mut off = Vec::new();
    for (down, label) in down.iter().zip(label) {
        let (came, wanted) = (touch_downs(down), touch_downs(label));
        let late = |w: usize, c: usize| (c as f64 - w as f64) * dt;
        let mut pairs: Vec<(usize, usize)> = (0..wanted.len())
            .flat_map(|w| (0..came.len()).map(move |c| (w, c)))
            .filter(|(w, c)| late(wanted[*w], came[*c]).abs() <= MATCH_S)
            .collect();
        pairs.sort_by_key(|(w, c)| (wanted[*w].abs_diff(came[*c]), *w, *c));
        let (mut met, mut used) = (vec![false; wanted.len()], vec![false; came.len()]);
        for (w, c) in pairs {
            if !met[w] && !used[c] {
                (met[w], used[c]) = (true, true);
                off.push(1e3 * late(wanted[w], came[c]).abs());
            }
        }
        out.recorded += wanted.len();
        out.missed += met.iter().filter(|m| !**m).count();
        out.added += used.iter().filter(|u| !**u).count();
    }
    out.median_ms = median(&off).map(short);
    out.worst_ms = off.iter().copied().reduce(f64::max).map(short);
    out
}

/// Share of the figure's foot-ticks on the floor that the recording has there too (precision), and share of the
/// recording's that the figure has too (recall). `None` where there are none.
pub fn precision_recall(
    down: &[Vec<bool>; 2],
    label: &[Vec<bool>; 2],
) -> (Option<f64>, Option<f64>) {
    let (mut both, mut came, mut wanted) = (0usize, 0usize, 0usize);
    for (down, label) in down.iter().zip(label) {
        for (d, l) in down.iter().zip(label) {
            both += usize::from(*d && *l);
            came += usize::from(*d);
            wanted += usize::from(*l);
        }
    }
    let share = |n: usize| (n > 0).then(|| short(both as f64 / n as f64));
    (share(came), share(wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 0.01;

    /// Down in these half-open intervals of a second, 100 ticks.
    fn on(intervals: &[(usize, usize)]) -> Vec<bool> {
        (0..100)
            .map(|i| intervals.iter().any(|(a, b)| (*a..*b).contains(&i)))
            .collect()
    }

    #[test]
    fn precision_and_recall_are_shares_of_time() {
        let label = [on(&[(0, 50)]), on(&[(50, 100)])];
        let down = [on(&[(0, 40)]), on(&[(40, 100)])];
        // 40 + 50 of 100 foot-ticks agree; the figure has 40 + 60 on the floor, the recording 50 + 50.
        assert_eq!(precision_recall(&down, &label), (Some(0.9), Some(0.9)));
        let air = [on(&[]), on(&[])];
        assert_eq!(precision_recall(&air, &label), (None, Some(0.0)));
    }

    #[test]
    fn touch_downs_are_matched_missed_and_added() {
        let label = [on(&[(0, 10), (30, 60), (80, 100)]), on(&[(0, 100)])];
        // 3 ticks late, one that is not in the recording, and the last one is missing.
        let down = [on(&[(0, 10), (33, 60)]), on(&[(0, 40), (55, 100)])];
        let t = match_touch_downs(&down, &label, DT);
        assert_eq!((t.recorded, t.missed, t.added), (2, 1, 1));
        assert_eq!((t.median_ms, t.worst_ms), (Some(30.0), Some(30.0)));
        let same = match_touch_downs(&label, &label, DT);
        assert_eq!((same.missed, same.added, same.worst_ms), (0, 0, Some(0.0)));
    }

    #[test]
    fn far_touch_downs_are_not_the_same_one() {
        let (a, b) = ([on(&[(10, 100)]), on(&[])], [on(&[(45, 100)]), on(&[])]);
        let t = match_touch_downs(&a, &b, DT);
        assert_eq!((t.missed, t.added, t.median_ms), (1, 1, None));
    }

    #[test]
    fn chatter_is_no_contact() {
        let down = settled(&on(&[(10, 40), (44, 60), (75, 78)]), DT);
        assert_eq!(down, on(&[(10, 60)]));
    }
}
