//! The hand-over between prescribed accelerations and torques.
//!
//! Prescribed accelerations on a tilting support create energy once joints saturate, and they do not account for parts
//! other than feet. In these cases torques take over, until the figure has stood calmly for a while. The state is the
//! same for both.

use crate::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES, SEGMENT_COUNT};
use crate::body::{Body, SegmentId, State};
use crate::dynamics::Terms;
use crate::paper::params::prescribed_step::{ARRIVAL_TICKS, CALM_TIME, IMPACT_HEIGHT, SPEED_CAP};
use crate::report::{Flags, POINTS_PER_SEGMENT, TickReport};
use crate::support::Support;
use serde::{Deserialize, Serialize};

/// Parts that a figure stands on.
const FEET: [SegmentId; 4] = [L_FOOT, L_TOES, R_FOOT, R_TOES];

/// The stepper of a figure whose accelerations can be prescribed.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct HandOver {
    /// Torques move the figure although accelerations should: time that it has been calm since, s.
    handed_over: Option<f64>,
    /// Accelerations move it in this tick.
    prescribed: bool,
    /// The controller's decision tips over an edge or a vertex of the support.
    tips: bool,
}

/// The part of a figure's state that decides on the hand-over.
#[derive(Clone, Copy, Debug)]
pub struct HandOverView<'a> {
    /// Torques may take over.
    pub allowed: bool,
    /// The body.
    pub body: &'a Body,
    /// Dynamics at the start of the tick.
    pub terms: &'a Terms,
    /// State at that time.
    pub state: &'a State,
    /// Supports.
    pub support: &'a Support,
    /// Report with the saturated joints and flags of the tick's decision.
    pub report: &'a TickReport,
    /// The figure has neither fallen nor lost its balance.
    pub upright: bool,
    /// It touches nothing but the ground.
    pub alone: bool,
}

impl HandOver {
    /// Whether accelerations move the figure in this tick.
    pub fn is_prescribed(&self) -> bool {
        self.prescribed
    }

    /// Whether torques have taken over.
    pub fn is_handed_over(&self) -> bool {
        self.handed_over.is_some()
    }

    /// Begins a tick, moved by accelerations or by torques.
    pub fn prescribe(&mut self, prescribed: bool) {
        self.prescribed = prescribed;
    }

    /// Notes whether the controller's decision tips over an edge or a vertex of the support.
    pub fn note_tipping(&mut self, tips: bool) {
        self.tips = tips;
    }

    /// Torques take over now.
    pub fn take_over(&mut self) {
        self.prescribed = false;
        self.handed_over = Some(0.0);
    }

    /// Forgets that torques have taken over.
    pub fn forget(&mut self) {
        self.handed_over = None;
    }

    /// Decides after the controller, in a tick of `dt` s.
    pub fn update(&mut self, seen: &HandOverView<'_>, dt: f64) {
        let joints = &seen.report.joints;
        if self.prescribed && seen.allowed {
            let saturated = (joints.saturated | joints.saturated_secondary) != 0;
            let arrives = other_part_arrives(seen.body, seen.terms, dt);
            let fast = seen.state.velocity[6..].iter().any(|v| v.abs() > SPEED_CAP);
            let overloaded = seen.report.flags.has(Flags::OVERLOAD);
            if arrives || fast || (self.tips && saturated) || overloaded {
                self.take_over();
            }
        } else if let Some(calm) = self.handed_over {
            let points = seen.support.points();
            let flat = points.len() >= 3 && points.iter().all(|p| FEET.contains(&p.segment));
            let calms = flat && seen.upright && seen.alone && !self.tips && joints.saturated == 0;
            self.handed_over = match calm + dt {
                t if !calms && t > 0.0 => Some(0.0),
                t if t > CALM_TIME => None,
                t => Some(t),
            };
        }
    }
}

/// Whether a part other than a foot touches the floor or reaches it within the tick at its present velocity.
fn other_part_arrives(body: &Body, terms: &Terms, dt: f64) -> bool {
    let feet = FEET.map(SegmentId::index);
    (0..SEGMENT_COUNT).filter(|s| !feet.contains(s)).any(|s| {
        let points = &body.segments[s].contact_points;
        points.iter().take(POINTS_PER_SEGMENT).any(|p| {
            let z = terms.point_world(s, *p).z;
            z + ARRIVAL_TICKS * dt * terms.point_velocity(s, *p).z.min(0.0) < IMPACT_HEIGHT
        })
    })
}
