//! Is balance lost for good? Then the controller, which would bend ankles and knees to keep soles flat that cannot stay flat, hands over to
//! motors alone (ALGORITHM §14.3): the figure falls as the body it is.

use super::report::MAX_CONTACTS;
use crate::sim::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::sim::body::{Body, SegmentId};
use crate::sim::dynamics::Terms;
use crate::sim::support::{Polygon, Support};

/// A body this low (share of its standing height) does not step any more.
const LOW: f64 = 0.7;
/// Balance is found again once the capture point has been inside for this long, s.
const FOUND_TIME: f64 = 0.3;

/// What brings the capture point back from where, m.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Arms and trunk; a controller that does all it can.
    Body,
    /// The paper's controller, which keeps trying on an edge of its feet.
    Paper,
    /// Steps.
    Step,
}

impl Reach {
    fn length(self, height: f64) -> f64 {
        match self {
            Self::Body => 0.04,
            Self::Step if height > LOW => 0.6,
            Self::Paper | Self::Step => 0.15,
        }
    }
}

/// Watches the capture point.
#[derive(Clone, Debug)]
pub struct BalanceWatch {
    polygon: Polygon,
    lost: bool,
    inside: f64,
}

impl Default for BalanceWatch {
    fn default() -> Self {
        Self {
            polygon: Polygon::with_capacity(MAX_CONTACTS),
            lost: false,
            inside: 0.0,
        }
    }
}

impl BalanceWatch {
    /// True while balance is lost.
    pub fn lost(&self) -> bool {
        self.lost
    }

    /// Forgets the past.
    pub fn reset(&mut self) {
        (self.lost, self.inside) = (false, 0.0);
    }

    /// Looks at the state in `terms`, at the start of a tick of `dt` seconds. Allocates nothing.
    ///
    /// * `reach`: what may bring it back.
    /// * `height`: of the centre of mass, as a share of the standing one.
    pub fn observe(
        &mut self,
        body: &Body,
        terms: &Terms,
        support: &Support,
        (gravity, dt): (f64, f64),
        (reach, height): (Reach, f64),
    ) {
        if support.points().is_empty() || gravity <= 0.0 {
            return; // Flight: nothing to lose balance over.
        }
        let (c, v) = (terms.com, terms.com_velocity);
        let time = (c.z.max(0.05) / gravity).sqrt();
        let capture = [c.x + v.x * time, c.y + v.y * time];
        self.cover(body, terms, support);
        let outside = self.polygon.closest(capture).map_or(0.0, |c| -c.margin);
        if outside > reach.length(height) {
            (self.lost, self.inside) = (true, 0.0);
        } else if self.lost {
            self.inside = if outside > 0.0 { 0.0 } else { self.inside + dt };
            self.lost = self.inside < FOUND_TIME;
        }
    }

    /// What the supports can cover: all of a foot of which a part touches, since it can be put down again; of other segments what touches.
    fn cover(&mut self, body: &Body, terms: &Terms, support: &Support) {
        let points = support.points();
        let touches = |s: SegmentId| points.iter().any(|p| p.segment == s);
        let feet = [[L_FOOT, L_TOES], [R_FOOT, R_TOES]];
        let down = feet.map(|f| f.into_iter().any(touches));
        let soles = feet
            .iter()
            .zip(down)
            .filter(|(_, down)| *down)
            .flat_map(|(foot, _)| foot)
            .flat_map(|s| {
                let points = &body.segment(*s).contact_points;
                points.iter().map(|p| terms.point_world(s.index(), *p))
            });
        let others = points
            .iter()
            .filter(|p| !feet.iter().flatten().any(|s| *s == p.segment))
            .map(|p| p.position);
        self.polygon
            .set_hull(soles.chain(others).map(|p| [p.x, p.y]));
    }
}
