//! Goal: recordings whose truth is known are read, retargeted, labelled, prepared and followed as they should be.
//! Method: the synthesised corpus of this folder (README.md), written by `examples/corpus`. The program's modules are
//! compiled into this test, so that every frame of every file can be compared with the pose it came from; contacts,
//! footholds, flights, centre of mass and joint angles come from the truth files.
//!
//! * `files`: the folder is what the program writes, and the motions are physical.
//! * `faults`: what is wrong with a file is left out, solved again or said.
//! * `reading`: joint positions, unit, axes, rate, held poses.
//! * `angles`: joint angles and centre of mass of the fitted motion.
//! * `labels`: when feet stand: touch-downs, lift-offs, contact time.
//! * `preparation`: feet that stand still where they should, zero-moment point.
//! * `symmetry`: mirrored and turned files and motions give mirrored and turned plans.
//! * `boundaries`: where starts, stops, loops and transitions begin and end.
//! * `tracking`: motions that the default figure follows.

#![allow(clippy::unwrap_used)]
#![allow(dead_code)] // the program's modules, of which a part is used here

#[path = "../../examples/corpus/actor.rs"]
mod actor;
#[path = "../common/mod.rs"]
mod common;
#[path = "../../examples/corpus/corpus.rs"]
mod corpus;
#[path = "../../examples/corpus/dialect.rs"]
mod dialect;
#[path = "../../examples/corpus/gait.rs"]
mod gait;
#[path = "../../examples/corpus/motions/mod.rs"]
mod motions;
#[path = "../../examples/corpus/plan.rs"]
mod plan;
#[path = "../../examples/corpus/tracks.rs"]
mod tracks;
#[path = "../../examples/corpus/truth.rs"]
mod truth;

mod angles;
mod boundaries;
mod faults;
mod files;
mod labels;
mod plans;
mod preparation;
mod reading;
mod recorded;
mod symmetry;
mod tracking;
