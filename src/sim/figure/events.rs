//! Events of a figure in a tick.

use crate::body::SegmentId;
use crate::body::topology::{DOF_COUNT, SEGMENT_COUNT};
use crate::collide::Other;
use crate::report::{Flags, TickReport};
use crate::support::Support;
use serde::{Deserialize, Serialize};

/// An event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum FigureEvent {
    /// A segment began to carry.
    SupportGained {
        /// The segment.
        segment: SegmentId,
    },
    /// A segment no longer carries.
    SupportLost {
        /// The segment.
        segment: SegmentId,
    },
    /// A DOF has been at its strength limit for [`SATURATION_TICKS`] ticks.
    Saturated {
        /// DOF index.
        dof: usize,
    },
    /// A DOF has been off its limit for the same number of ticks.
    Relieved {
        /// DOF index.
        dof: usize,
    },
    /// Balance is lost: the controller handed over to motors alone.
    BalanceLost,
    /// Balance is regained.
    Recovered,
    /// The figure has fallen.
    Fell,
    /// The figure stands again.
    GotUp,
    /// A load was taken up.
    LoadTaken {
        /// Carrying segment.
        segment: SegmentId,
        /// kg.
        mass: f64,
    },
    /// A load was let go.
    LoadDropped {
        /// Carrying segment.
        segment: SegmentId,
        /// kg.
        mass: f64,
    },
    /// The other hand took hold of a load too: one arm is too weak for it, or the caller asked for both.
    LoadShared {
        /// Carrying segment.
        segment: SegmentId,
        /// kg.
        mass: f64,
        /// The other hand.
        hand: SegmentId,
        /// Share of its strength that the hardest-working joint needs to hold the load still in the desired motion:
        /// with one arm alone, and with the other's help.
        need: [f64; 2],
    },
    /// The other hand let go of a load: one arm is enough, or the other hand is needed elsewhere.
    LoadUnshared {
        /// Carrying segment.
        segment: SegmentId,
        /// kg.
        mass: f64,
        /// The other hand.
        hand: SegmentId,
        /// As in [`Self::LoadShared`], at the time when it let go.
        need: [f64; 2],
    },
    /// A load slipped from a hand: it exceeded the grip.
    LoadSlipped {
        /// Carrying segment.
        segment: SegmentId,
        /// kg.
        mass: f64,
    },
    /// A segment began to touch another figure or an obstacle.
    Touched {
        /// Own segment.
        segment: SegmentId,
        /// The body that it touches.
        other: Other,
    },
    /// A segment stopped touching another figure or an obstacle.
    Parted {
        /// Own segment.
        segment: SegmentId,
        /// The body that it touched.
        other: Other,
    },
    /// A figure or an obstacle is in the way of its steps: it broke off its motion and comes to a stand.
    WayBarred,
    /// A step had to catch it: it left its clip for a stand, from which it begins the clip again.
    ClipRestarts,
    /// The same again: it stays where it stands.
    ClipGivenUp,
    /// The state became non-finite or ran away; the figure is frozen at its last good state.
    Quarantined,
}

/// Ticks for which a DOF must stay at (or off) its limit before this is reported: flicker is not news.
pub const SATURATION_TICKS: u16 = 6;
/// Most events of one tick.
const MAX_EVENTS: usize = 128;

/// Turns reports into events; remembers the last tick.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Watcher {
    events: Vec<FigureEvent>,
    supports: [bool; SEGMENT_COUNT],
    #[serde(with = "crate::saved::array")]
    saturated: [bool; DOF_COUNT],
    #[serde(with = "crate::saved::array")]
    streak: [u16; DOF_COUNT],
    balanced: bool,
    fallen: bool,
}

impl Default for Watcher {
    fn default() -> Self {
        Self {
            events: Vec::with_capacity(MAX_EVENTS),
            supports: [false; SEGMENT_COUNT],
            saturated: [false; DOF_COUNT],
            streak: [0; DOF_COUNT],
            balanced: true,
            fallen: false,
        }
    }
}

impl Watcher {
    /// Starts a tick.
    pub fn begin(&mut self) {
        self.events.clear();
    }

    /// Adds an event. Events beyond the bound, which no tick reaches, are dropped silently.
    pub fn push(&mut self, event: FigureEvent) {
        if self.events.len() < MAX_EVENTS {
            self.events.push(event);
        }
    }

    /// Events of the tick.
    pub fn events(&self) -> &[FigureEvent] {
        &self.events
    }

    /// Compares a finished tick with the last one.
    pub fn observe(&mut self, report: &TickReport, support: &Support, fallen: bool) {
        let mut now = [false; SEGMENT_COUNT];
        for p in support.points() {
            now[p.support.index()] = true;
        }
        for s in 0..SEGMENT_COUNT {
            let segment = SegmentId::new(s).expect("s < SEGMENT_COUNT");
            match (self.supports[s], now[s]) {
                (false, true) => self.push(FigureEvent::SupportGained { segment }),
                (true, false) => self.push(FigureEvent::SupportLost { segment }),
                _ => {}
            }
        }
        self.supports = now;
        for dof in 0..DOF_COUNT {
            let at_limit = report.joints.saturated & (1 << dof) != 0;
            if at_limit == self.saturated[dof] {
                self.streak[dof] = 0;
                continue;
            }
            self.streak[dof] += 1;
            if self.streak[dof] >= SATURATION_TICKS {
                self.saturated[dof] = at_limit;
                self.streak[dof] = 0;
                self.push(if at_limit {
                    FigureEvent::Saturated { dof }
                } else {
                    FigureEvent::Relieved { dof }
                });
            }
        }
        let balanced = !report.flags.has(Flags::BALANCE_LOST);
        // A figure that lies no longer counts as having lost its balance, but it has not regained it either:
        // `Recovered` waits until the figure stands.
        if balanced != self.balanced && !(balanced && fallen) {
            self.balanced = balanced;
            self.push(if balanced {
                FigureEvent::Recovered
            } else {
                FigureEvent::BalanceLost
            });
        }
        if fallen != self.fallen {
            self.fallen = fallen;
            self.push(if fallen {
                FigureEvent::Fell
            } else {
                FigureEvent::GotUp
            });
        }
    }
}
