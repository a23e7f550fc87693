//! What comes after a motion that ends in mid-stride: its last step is finished, and it turns into standing at ease.

use super::foot_places::{level, middle};
use super::planned_to_world::Anchor;
use super::{FOOT, Purpose, RecoveryStep, StepTracker, recovery_step};
use crate::sim::body::Posture;
use crate::sim::body::topology::NV;
use crate::sim::dynamics::Terms;
use crate::sim::math::curve::smoothstep;
use crate::sim::motion::{Target, TargetPair};

/// Time in which a motion that ended turns into standing, s.
const EASE: f64 = 0.6;

/// From posture `a` to posture `b`. `u` beyond 0…1 is clamped.
fn eased(a: &Posture, b: &Posture, u: f64) -> Posture {
    let s = smoothstep(u);
    let spin = (b.root_rotation * a.root_rotation.conjugate()).log() * s;
    let mut rates = [0.0; NV];
    rates[..3].copy_from_slice(&spin.to_array());
    for (r, w) in rates[6..].iter_mut().zip(a.joint_difference(b)) {
        *r = s * w;
    }
    let mut out = *a;
    out.integrate(&rates, 1.0);
    out.root_position = a.root_position + (b.root_position - a.root_position) * s;
    out
}

impl StepTracker {
    /// How it stands at ease.
    pub fn ease(&self) -> &Posture {
        &self.ease
    }

    /// The posture in which it comes to a stand after a clip that ended in motion.
    pub fn comes_to(&self) -> Option<&Posture> {
        self.ended.is_some().then_some(&self.ease)
    }

    /// True while it does so.
    pub fn eases(&self, terms: &Terms) -> bool {
        self.ended.is_some() && !self.is_settled(terms)
    }

    /// The clip is over while its figure may still walk: it turns into standing. The last step is finished, and more
    /// are made if it takes them.
    pub(super) fn end(&mut self, terms: &Terms, last: &Posture) {
        let now = self.places(terms);
        let poses = self.capture.feet(&self.ease);
        let home: recovery_step::Places = std::array::from_fn(|k| self.place_of(k, poses[k]));
        // It stands where the foot is that the body moves over, and looks where the feet look.
        let xi = self.capture.point();
        let far = |k: usize| level([now[k].0.x - xi[0], now[k].0.y - xi[1]]).norm();
        let side = match [self.feet[0].down, self.feet[1].down] {
            [true, false] => 0,
            [false, true] => 1,
            _ => usize::from(far(1) < far(0)),
        };
        let (heading, planned) = (middle(&now).1, middle(&home).1);
        let lay = self.anchor.transform();
        self.anchor = Anchor::between((home[side].0, planned), (now[side].0, heading));
        // The same posture in the same place, as the new anchor maps it there.
        let mut from = *last;
        let lies = self.anchor.transform().power(-1.0).after(lay);
        lies.apply_posture(&mut from);
        self.ended = Some((from, 0.0));
        for side in 0..2 {
            if !self.feet[side].down {
                let pose = terms.segment_position(FOOT[side].index());
                self.step = Some(RecoveryStep::new(
                    side,
                    Purpose::CatchBeside,
                    pose,
                    now[side].1,
                ));
            }
        }
    }

    /// The next tick of `dt` seconds of a motion that has ended; `None` before.
    pub(super) fn ease_on(&mut self, dt: f64) -> Option<TargetPair> {
        let (from, since) = self.ended.as_mut()?;
        *since += dt;
        let still = |t: f64| Target::still(eased(from, &self.ease, t / EASE));
        Some(TargetPair {
            now: still(*since - dt),
            next: still(*since),
        })
    }
}
