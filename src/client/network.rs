//! A simulated network, to try out the effect of delays and losses on live motion.

/// A network that delays and drops frames, the same way for the same seed.
#[derive(Clone, Debug)]
pub struct Network {
    state: u64,
    jitter: f64,
    loss: f64,
    last: f64,
}

impl Network {
    /// Delays frames by up to `jitter` seconds and drops the fraction `loss` of them.
    pub fn new(jitter: f64, loss: f64, seed: u64) -> Self {
        Self {
            state: seed,
            jitter,
            loss,
            last: f64::NEG_INFINITY,
        }
    }

    /// Uniform in 0…1 (splitmix64).
    fn random(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Arrival time of a frame sent at `t` (s), not before that of earlier frames; `None` if it is lost.
    pub fn arrival(&mut self, t: f64) -> Option<f64> {
        let (late, lost) = (self.random(), self.random());
        if lost < self.loss {
            return None;
        }
        self.last = self.last.max(t + self.jitter * late);
        Some(self.last)
    }
}
