//! Runs of equal values in a sequence of samples.

/// Runs of equal value as half-open index ranges: `(start, end, value)`.
pub fn runs<T: PartialEq + Copy>(flags: &[T]) -> Vec<(usize, usize, T)> {
    let mut out = Vec::new();
    let mut start = 0;
    for i in 1..=flags.len() {
        if i == flags.len() || flags[i] != flags[start] {
            out.push((start, i, flags[start]));
            start = i;
        }
    }
    out
}

/// The [`runs`] of true values: `(start, end)`.
pub fn stretches(on: &[bool]) -> impl Iterator<Item = (usize, usize)> + use<> {
    let all = runs(on).into_iter().filter(|run| run.2);
    all.map(|(start, end, _)| (start, end))
}

/// Removes runs of fewer than `shortest` samples between others: first gaps, then the short touches that are left.
pub fn remove_short(on: &mut [bool], shortest: f64) {
    for value in [false, true] {
        for (i, j, v) in runs(on) {
            if v == value && i > 0 && j < on.len() && ((j - i) as f64) < shortest {
                on[i..j].fill(!value);
            }
        }
    }
}
