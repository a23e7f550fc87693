//! Goal: recordings with known truth are read, retargeted, labelled, prepared and followed correctly. Method: the
//! synthesised corpus of this folder (README.md), written by `tools/corpus`. The program's modules are compiled into
//! this test, so that every frame of every file can be compared with its original pose; contacts, footholds, flights,
//! centre of mass and joint angles come from the truth files.
//!
//! * `files`: the folder equals the output of the program, and the motions are physical.
//! * `faults`: faults of a file are left out, solved again or reported.
//! * `reading`: joint positions, unit, axes, rate, held poses.
//! * `angles`: joint angles and centre of mass of the fitted motion.
//! * `labels`: stance of the feet: touch-downs, lift-offs, contact time.
//! * `preparation`: feet that stand still where they should, zero-moment point.
//! * `symmetry`: mirrored and turned files and motions give mirrored and turned plans.
//! * `boundaries`: where starts, stops, loops and transitions begin and end.
//! * `tracking`: motions that the default figure follows.

#[path = "../../../tools/corpus/actor.rs"]
mod actor;
#[allow(clippy::module_inception, reason = "named as in the program")]
#[path = "../../../tools/corpus/corpus.rs"]
mod corpus;
#[path = "../../../tools/corpus/dialect.rs"]
mod dialect;
#[path = "../../../tools/corpus/gait.rs"]
mod gait;
#[path = "../../../tools/corpus/motions/mod.rs"]
mod motions;
#[path = "../../../tools/corpus/plan.rs"]
mod plan;
#[path = "../../../tools/corpus/tracks.rs"]
mod tracks;
#[path = "../../../tools/corpus/truth.rs"]
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
