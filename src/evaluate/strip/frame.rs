//! The content of one panel, and the options of a strip.

use super::things::Thing;
use crate::metrics::Tick;
use sinew_physics::body::{DOF_COUNT, Posture, SEGMENT_COUNT};
use sinew_physics::figure::Flags;
use sinew_physics::math::Vec3;

/// The viewing direction, relative to the figure's heading in the first frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// From its right side: it faces right.
    Side,
    /// From the front.
    Front,
    /// From the front and right, from a little above.
    #[default]
    ThreeQuarter,
}

/// One panel: a figure at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct StripFrame {
    /// Time, s.
    pub time_s: f64,
    /// The actual posture.
    pub posture: Posture,
    /// The desired posture.
    pub desired: Posture,
    /// Its surroundings.
    pub things: Vec<Thing>,
    /// Sum of contact forces (N) on each segment, of the ground and of everything else, and the point at which it acts
    /// (world, m); zero force without contact.
    pub contact: [(Vec3, Vec3); SEGMENT_COUNT],
    /// Force of the help on the pelvis, world, N; zero without help.
    pub help: Vec3,
    /// Centre of mass, world, m.
    pub com: Vec3,
    /// Zero-moment point, world, m.
    pub zmp: Option<Vec3>,
    /// Support polygon on the ground, world x, y, m.
    pub polygon: Vec<[f64; 2]>,
    /// Used share of the available torque of each DOF.
    pub utilisation: [f64; DOF_COUNT],
    /// Loads on segments: segment, point in the segment frame (m), mass (kg).
    pub loads: Vec<(usize, Vec3, f64)>,
    /// The figure has fallen.
    pub fallen: bool,
    /// Whether the figure is frozen at its last good state: forces and utilisation do not belong to this instant.
    pub frozen: bool,
}

impl StripFrame {
    /// The instant at the end of `tick`; `loads` as in [`StripFrame::loads`].
    pub fn of(tick: &Tick<'_>, time_s: f64, loads: Vec<(usize, Vec3, f64)>) -> Self {
        let report = tick.report;
        let mut contact = [(Vec3::zero(), Vec3::zero()); SEGMENT_COUNT];
        let mut weight = [0.0; SEGMENT_COUNT];
        let frozen = report.flags.has(Flags::QUARANTINED);
        for c in report.contacts.iter().filter(|_| !frozen) {
            let s = c.segment.index();
            let n = c.force.norm();
            contact[s].0 += c.position * n;
            contact[s].1 += c.force;
            weight[s] += n;
        }
        for t in report.touches.iter().filter(|_| !frozen) {
            let (s, n) = (t.segment.index(), t.force.norm());
            contact[s].0 += t.position * n;
            contact[s].1 += t.force;
            weight[s] += n;
        }
        for s in 0..SEGMENT_COUNT {
            if weight[s] > 0.0 {
                contact[s].0 = contact[s].0 * (1.0 / weight[s]);
            }
        }
        Self {
            time_s,
            posture: tick.state.posture,
            desired: tick.target.next.posture,
            things: Vec::new(),
            contact,
            help: if frozen {
                Vec3::zero()
            } else {
                let [_, _, _, x, y, z] = report.assist;
                Vec3 { x, y, z }
            },
            com: report.balance.com,
            zmp: report.balance.zmp,
            polygon: report.balance.support_polygon.clone(),
            utilisation: if frozen {
                [0.0; DOF_COUNT]
            } else {
                tick.utilisation()
            },
            loads,
            fallen: report.flags.has(Flags::FALLEN),
            frozen,
        }
    }
}

impl StripFrame {
    /// The same with `things` around the figure.
    #[must_use]
    pub fn among(mut self, things: impl IntoIterator<Item = Thing>) -> Self {
        self.things.extend(things);
        self
    }
}

/// The options of a strip.
#[derive(Clone, Debug, PartialEq)]
pub struct StripOptions {
    /// The viewing direction.
    pub view: View,
    /// Pixels per metre.
    pub scale: f64,
    /// Heading over the panels.
    pub title: String,
}

impl Default for StripOptions {
    fn default() -> Self {
        Self {
            view: View::default(),
            scale: 200.0,
            title: String::new(),
        }
    }
}
