//! Files of motion.

use crate::fuzz::edit::{damaged, edits};
use crate::fuzz::runner;
use proptest::prelude::*;
use sinew_physics::motion::bvh::Bvh;
use std::cell::Cell;

/// Recordings of the corpus in several dialects, cut to a few frames.
fn seeds() -> Vec<Vec<u8>> {
    let files = [
        "wave.vrm.bvh",
        "wave.mixamo.bvh",
        "turn.mixamo.bvh",
        "kick.cmu.bvh",
        "jog.cgspeed.bvh",
        "walk-slow.six.bvh",
        "squat.lafan.bvh",
        "lift.biped.bvh",
        "lift.rot-only.bvh",
        "jump.generic-zup.bvh",
        "side-steps.threejs.bvh",
    ];
    files
        .map(|name| {
            let text = crate::corpus::read(name.trim_end_matches(".bvh"));
            let text = String::from_utf8(text).expect("the corpus is text");
            let (head, motion) = text.split_once("Frame Time:").unwrap();
            let (joints, _) = head.rsplit_once("Frames:").unwrap();
            let lines: Vec<&str> = motion.lines().take(4).collect();
            format!("{joints}Frames: 3\nFrame Time:{}\n", lines.join("\n")).into_bytes()
        })
        .into()
}

/// Content of a motion file other than numbers.
fn piece() -> impl Strategy<Value = Vec<u8>> {
    let words = [
        "HIERARCHY\n",
        "ROOT a\n",
        "JOINT b\n",
        "{\n",
        "}\n",
        "End Site\n",
        "OFFSET 0 0 0\n",
        "OFFSET nan 1e999 -\n",
        "CHANNELS 3 Zrotation Xrotation Yrotation\n",
        "CHANNELS 6 Xposition Yposition Zposition Zrotation\n",
        "CHANNELS 4294967295\n",
        "CHANNELS -1\n",
        "MOTION\n",
        "Frames: 18446744073709551615\n",
        "Frames: 2\n",
        "Frame Time: 0\n",
        "Frame Time: 0.0083\n",
        "0 0 0\n",
        "1e400 nan inf\n",
        "\r\n",
        "\u{feff}",
        "\0",
    ];
    prop::sample::select(words.map(|w| w.as_bytes().to_vec()).to_vec())
}

#[test]
fn motion_is_refused_or_read_whole() {
    let mut seeds = seeds();
    seeds.retain(|seed| Bvh::parse(seed).is_ok()); // some dialects do not have a line for a frame
    let valid = seeds.len();
    assert!(valid >= 8, "{valid}");
    let content = prop_oneof![
        6 => (0..valid, edits(4)).prop_map(move |(i, edits)| damaged(seeds[i].clone(), &edits)),
        2 => prop::collection::vec(piece(), 0..30).prop_map(|p| p.concat()),
        1 => prop::collection::vec(any::<u8>(), 0..300),
    ];
    let (cases, read) = (Cell::new(0u64), Cell::new(0u64));
    let done = runner(1000).run(&content, |bytes| {
        cases.set(cases.get() + 1);
        if let Ok(bvh) = Bvh::parse(&bytes) {
            read.set(read.get() + 1);
            for i in 0..bvh.frame_count {
                let frame = bvh.frame(i);
                prop_assert_eq!(frame.len(), bvh.channel_count());
                prop_assert!(frame.iter().all(|v| v.is_finite()));
                prop_assert_eq!(bvh.world(i).len(), bvh.joints.len());
            }
            bvh.mirrored();
        }
        Ok(())
    });
    if let Err(e) = done {
        panic!("{e}");
    }
    println!("{} cases, {} read", cases.get(), read.get());
    assert!(read.get() > 0);
}
