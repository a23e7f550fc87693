//! Samples in which nothing carries the body, so that its mass accelerates with gravity alone.

/// Whether a sample is one of free fall: sample `i` and both of its neighbours are in the air.
///
/// * `air`: whether no foot is on the floor, per sample.
pub(super) fn in_free_fall(air: &[bool], i: usize) -> bool {
    air[i - 1] && air[i] && air[i + 1]
}
