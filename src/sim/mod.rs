//! Physics and control: pure, synchronous, without I/O, clock or logging.
//!
//! `world` ─► `figure` ─► `gait` ─► `control` ─► `collide` ─► `contact` ─► `support`, `strength`, `motion` ─► `dynamics` ─► `body` ─► `math`.

pub mod body;
pub mod collide;
pub mod contact;
pub mod control;
pub mod dynamics;
pub mod figure;
pub mod gait;
pub mod math;
pub mod motion;
pub mod strength;
pub mod support;
pub mod world;
