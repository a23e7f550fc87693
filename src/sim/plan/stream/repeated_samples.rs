//! A stream whose newest samples repeat one: its driver has stopped moving and continues to send.

use super::{RATE, is_sample};
use crate::body::Posture;
use crate::plan::params::{common, stream};
use serde::{Deserialize, Serialize};

/// Whether nothing moved between two postures.
pub fn is_same(a: &Posture, b: &Posture) -> bool {
    a.difference(b).iter().all(|d| d.abs() < stream::SAME)
}

/// The newest sample, the movement that led to it, and how often it has been repeated.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct RepeatedSamples {
    posture: Option<Posture>,
    /// Number of samples that have repeated it.
    repeated: i64,
    /// Velocity of the pelvis over the floor before that, m/s.
    velocity: [f64; 2],
}

impl RepeatedSamples {
    /// Whether this value is one that a checkpoint could hold.
    pub(super) fn is_valid(&self) -> bool {
        self.repeated >= 0 && is_sample(self.repeated)
    }

    pub(super) fn take(&mut self, posture: &Posture) {
        let Some(last) = self.posture.replace(*posture) else {
            return;
        };
        if is_same(&last, posture) {
            self.repeated += 1;
            return;
        }
        // A stream that moves again after a silence counts as starting from rest.
        if self.breaks_off() {
            self.velocity = [0.0; 2];
        }
        self.repeated = 0;
        let (a, b) = (last.root_position, posture.root_position);
        let way = [b.x - a.x, b.y - a.y];
        for (v, way) in self.velocity.iter_mut().zip(way) {
            *v += (way * RATE - *v) / stream::SPEED_AVERAGED;
        }
    }

    /// The newest sample.
    pub(super) fn posture(&self) -> Option<Posture> {
        self.posture
    }

    /// Samples at the end that repeat the one before them.
    pub(super) fn repeated(&self) -> i64 {
        self.repeated
    }

    pub(super) fn breaks_off(&self) -> bool {
        let [x, y] = self.velocity;
        self.repeated >= (stream::REPEATED_TIME * RATE) as i64
            && x * x + y * y > common::REST_SPEED * common::REST_SPEED
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moves ahead at a speed, m/s, for half a second, then repeats the same sample `repeats` times.
    fn stream(speed: f64, repeats: usize) -> RepeatedSamples {
        let at = |i: usize| {
            let mut p = Posture::default();
            p.root_position.x = speed * i.min(30) as f64 / RATE;
            p
        };
        let mut newest = RepeatedSamples::default();
        (0..=30 + repeats).for_each(|i| newest.take(&at(i)));
        newest
    }

    #[test]
    fn a_stream_breaks_off_where_it_repeats_a_sample_in_motion() {
        assert!(stream(1.0, 6).breaks_off());
        assert_eq!(stream(1.0, 6).repeated(), 6);
        assert!(!stream(1.0, 0).breaks_off(), "it moves");
        assert!(!stream(1.0, 4).breaks_off(), "a hiccup");
        assert!(!stream(0.05, 60).breaks_off(), "it stood");
        let mut again = stream(1.0, 6);
        again.take(&Posture::default());
        assert!(!again.breaks_off(), "it goes on");
    }
}
