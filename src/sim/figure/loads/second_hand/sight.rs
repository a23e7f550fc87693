//! The view that the other hand has of its figure.

use crate::body::{Body, Links, Posture, State};
use crate::collide::shape::BodyShape;
use crate::strength::{MuscleScale, Strength};

/// The facts known about the figure and its motion.
pub(in crate::figure) struct Sight<'a> {
    pub body: &'a Body,
    pub shape: &'a BodyShape,
    pub strength: &'a Strength,
    pub muscles: &'a MuscleScale,
    pub links: &'a Links,
    /// State of the body.
    pub state: &'a State,
    /// Desired posture the given number of seconds from now.
    pub ahead: &'a dyn Fn(f64) -> Posture,
    /// Whether each hand (left, right) is free.
    pub free: [bool; 2],
    /// Beginning and length of the tick, s.
    pub time: f64,
    pub dt: f64,
    /// m/s².
    pub gravity: f64,
}
