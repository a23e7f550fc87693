//! The supports of a figure: touching points, support ratios (2), main support, support polygon, zero-moment point (3),
//! tipping.

pub mod contact_set;
pub mod ratio;
pub mod rest;
pub mod sharing;
pub mod tipping;
pub mod zmp;

#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;

pub use crate::math::polygon::{Closest, Feature, Polygon};
pub use contact_set::{ContactSet, SupportPoint};
pub use rest::{NO_VERTEX, Rest};
pub use sharing::Sharing;
pub use tipping::{Pivot, is_stopped, pivot, tipping_acceleration, unblocked_pivot};
pub use zmp::{zmp, zmp_above};

use crate::body::topology::PELVIS;
use crate::body::{Body, SEGMENT_COUNT, SegmentId};
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::report::MAX_CONTACTS;
use crate::touch::MAX_TOUCHES;
use serde::{Deserialize, Serialize};

/// Supports of one figure, computed once per tick and shared by controllers and steppers. Keeps the memory that
/// hysteresis needs.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Support {
    contacts: ContactSet,
    ratio: [f64; SEGMENT_COUNT],
    load: [f64; SEGMENT_COUNT],
    #[serde(skip)]
    sharing: Sharing,
    main: Option<SegmentId>,
    polygon: Polygon,
    rests: Vec<Rest>,
    /// Points on the floor, then those of the rests, at most [`MAX_CONTACTS`].
    #[serde(skip)]
    carriers: Vec<SupportPoint>,
}

impl Default for Support {
    fn default() -> Self {
        Self {
            contacts: ContactSet::default(),
            ratio: [0.0; SEGMENT_COUNT],
            load: [0.0; SEGMENT_COUNT],
            sharing: Sharing::default(),
            main: None,
            polygon: Polygon::with_capacity(MAX_CONTACTS + MAX_TOUCHES),
            rests: Vec::with_capacity(MAX_TOUCHES),
            carriers: Vec::with_capacity(MAX_CONTACTS),
        }
    }
}

impl Support {
    /// Finds contacts, ratios, main support and ground polygon of the state in `terms`.
    ///
    /// * `com_acceleration`: c̈ over the last tick, world, m/s² (zero at the start).
    /// * `gravity`: magnitude, m/s².
    ///
    /// Supports other than the floor count only after [`Self::rest_on`].
    ///
    /// No allocation for bodies with at most [`MAX_CONTACTS`] contact points.
    pub fn update(&mut self, terms: &Terms, body: &Body, com_acceleration: Vec3, gravity: f64) {
        self.contacts.update(terms, body);
        let points = self.contacts.points();
        let pull = com_acceleration + Vec3::Z * gravity;
        self.ratio = ratio::support_ratios(points.iter().map(Into::into), terms.com, pull);
        // Ratios (2) hardly distinguish a foot that carries everything from one that carries nothing, so S follows
        // statics instead.
        self.load = [0.0; SEGMENT_COUNT];
        let force = pull * terms.mass;
        if self
            .sharing
            .set_balanced(points, &self.ratio, &[false; MAX_CONTACTS])
        {
            let n = (terms.com - self.sharing.reference).cross(force);
            let w = [n.x, n.y, n.z, force.x, force.y, force.z];
            let y = self.sharing.multiplier(&w);
            for (i, p) in points.iter().enumerate() {
                if points[..i].iter().all(|q| q.segment != p.segment) {
                    let f = self.sharing.segment_wrench(p.segment.index(), &y)[5];
                    self.load[p.support.index()] += f / force.z.abs().max(terms.mass);
                }
            }
        }
        self.main = ratio::main_support(points, &self.load, self.main);
        self.rests.clear();
        self.carriers.clear();
        self.carriers.extend_from_slice(points);
        self.polygon
            .set_hull(points.iter().map(|p| [p.position.x, p.position.y]));
        self.polygon.reduce_thin();
    }

    /// Adds the rests, on which the figure leans besides the floor, each with its ratio (2). Seats and tables widen the
    /// polygon, because they carry whatever is above them. Call after [`Self::update`]. Allocates nothing for up to
    /// [`MAX_TOUCHES`] of them.
    ///
    /// * `com`: world, m. `pull`: a_m = c̈ − g, world axes, m/s².
    pub fn rest_on(&mut self, rests: impl Iterator<Item = Rest>, com: Vec3, pull: Vec3) {
        self.rests.extend(rests.take(MAX_TOUCHES));
        if !self.rests.is_empty() {
            let room = MAX_CONTACTS - self.carriers.len().min(MAX_CONTACTS);
            let more = self.rests.iter().map(Rest::as_point).take(room);
            self.carriers.extend(more);
            let all = self.carriers.iter().map(Into::into);
            self.ratio = ratio::support_ratios(all, com, pull);
        }
        if self.rests.iter().any(Rest::is_level) {
            let level = self.rests.iter().filter(|r| r.is_level());
            let floor = self.contacts.points().iter().map(|p| p.position);
            let all = floor.chain(level.map(|r| r.position));
            self.polygon.set_hull(all.map(|p| [p.x, p.y]));
            self.polygon.reduce_thin();
        }
    }

    /// Whether one of the rests keeps the body from falling this `way` (horizontal).
    pub fn holds(&self, way: Vec3) -> bool {
        self.rests().iter().any(|rest| rest.holds(way))
    }

    /// The supports other than the floor.
    pub fn rests(&self) -> &[Rest] {
        &self.rests
    }

    /// All points that can carry: those on the floor, as in [`Self::points`], then those at which parts rest on other
    /// things.
    pub fn carriers(&self) -> &[SupportPoint] {
        &self.carriers
    }

    /// Determines which resting parts the motion is about to lift off.
    ///
    /// * `desired`: where the motion has a point of a segment (segment frame, m), world, m.
    pub fn plan_rests(&mut self, terms: &Terms, desired: impl Fn(SegmentId, Vec3) -> Vec3) {
        let (pelvis, origin) = (terms.state.posture.root_position, Vec3::zero());
        let shift = pelvis - desired(PELVIS, origin);
        for rest in &mut self.rests {
            let s = rest.segment.index();
            let local =
                terms.kin.rotation[s].transpose_mul(rest.position - terms.segment_position(s));
            let planned = desired(rest.segment, local) + shift;
            rest.lift = rest.normal.dot(planned - rest.position);
        }
    }

    /// Forgets the past (after a reset of the figure).
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Touching points, by segment, then by vertex.
    pub fn points(&self) -> &[SupportPoint] {
        self.contacts.points()
    }

    /// Support ratio (2) per segment, on the floor and on the rests; 0 for a segment that does not support.
    pub fn ratio(&self) -> &[f64; SEGMENT_COUNT] {
        &self.ratio
    }

    /// Share of the normal force per support, from balanced sharing for the last tick's motion of the centre of mass.
    /// It is 0 where nothing touches, and slightly negative for a foot that would have to pull.
    pub fn load(&self) -> &[f64; SEGMENT_COUNT] {
        &self.load
    }

    /// Main supporting segment S, the one with the largest load (with hysteresis); `None` in flight.
    pub fn main(&self) -> Option<SegmentId> {
        self.main
    }

    /// Ground polygon: hull of all supports, with those off the ground projected from above. Thin sets become edges and
    /// vertices.
    pub fn polygon(&self) -> &Polygon {
        &self.polygon
    }

    /// Hull of one support, into `out`.
    pub fn support_polygon(&self, support: SegmentId, out: &mut Polygon) {
        out.set_hull(
            self.points()
                .iter()
                .filter(|p| p.support == support)
                .map(|p| [p.position.x, p.position.y]),
        );
    }

    /// Signed distance of a zero-moment point inside the ground polygon, m.
    pub fn margin(&self, zmp: Vec3) -> Option<f64> {
        Some(self.polygon.closest([zmp.x, zmp.y])?.margin)
    }
}
