//! Physics and control: pure, synchronous, without I/O, clock or logging.
//!
//! `world` ─► `rehearsal` ─► `figure` ─► `track` ─► `control` ─► `collide` ─► `contact` ─► `retarget` ─► `plan` ─►
//! `motion`, `support` ─► `setup` ─► `strength` ─► `dynamics` ─► `report` ─► `touch` ─► `body` ─► `math` ─► `saved`.

pub mod body;
pub mod collide;
pub mod contact;
pub mod control;
pub mod dynamics;
pub mod figure;
pub mod get_up;
pub mod math;
pub mod motion;
pub mod params;
pub mod plan;
pub mod rehearsal;
pub mod report;
pub mod retarget;
pub mod saved;
pub mod setup;
pub mod strength;
pub mod support;
pub mod touch;
pub mod track;
pub mod world;
