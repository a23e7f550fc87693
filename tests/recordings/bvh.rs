//! Goal: the BVH reader places every joint of all 18 real clips where an independent reader places it. Method:
//! `expected.json` beside the clips holds joint positions of four frames each, rounded to five decimals.

use crate::common::mocap::read;
use sinew_physics::motion::bvh::Bvh;

/// Half a unit of the fifth decimal, with room for the rounding of both readers.
const ROUNDING: f64 = 5.0e-6 + 1e-9;

#[test]
fn every_clip_agrees_with_the_independent_reader() {
    let expected: serde_json::Value = serde_json::from_slice(&read("expected.json")).unwrap();
    let clips = expected.as_object().unwrap();
    assert_eq!(clips.len(), 18);
    let mut compared = 0;
    for (clip, want) in clips {
        let bvh =
            Bvh::parse(&read(&format!("{clip}.bvh"))).unwrap_or_else(|e| panic!("{clip}: {e}"));
        assert_eq!(
            bvh.frame_count as u64,
            want["frames"].as_u64().unwrap(),
            "{clip}"
        );
        assert_eq!(
            bvh.channel_count() as u64,
            want["channels"].as_u64().unwrap(),
            "{clip}"
        );
        assert_eq!(
            bvh.frame_time,
            want["frame_time"].as_f64().unwrap(),
            "{clip}"
        );
        for (frame, joints) in want["positions"].as_object().unwrap() {
            let world = bvh.world(frame.parse().unwrap());
            let joints = joints.as_object().unwrap();
            assert_eq!(joints.len(), bvh.joints.len(), "{clip}: joints");
            for (j, joint) in bvh.joints.iter().enumerate() {
                let p = &joints[&joint.name];
                let at = world[j].position.to_array();
                for k in 0..3 {
                    let off = (at[k] - p[k].as_f64().unwrap()).abs();
                    assert!(
                        off <= ROUNDING,
                        "{clip} frame {frame} {}: off by {off:e}",
                        joint.name
                    );
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 2000, "{compared} joints compared");
}

#[test]
fn damaged_clips_never_panic() {
    // One small clip, cut and overwritten at many places by a fixed generator.
    let original = read("get-up.bvh");
    let mut seed = 7u64;
    let mut random = |n: usize| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % n
    };
    let mut refused = 0;
    for round in 0..300 {
        let mut bytes = original.clone();
        match round % 3 {
            0 => bytes.truncate(random(original.len())),
            1 => (0..4).for_each(|_| {
                let at = random(original.len());
                bytes[at] = random(256) as u8;
            }),
            _ => {
                let (a, b) = (random(original.len()), random(original.len()));
                bytes.drain(a.min(b)..a.max(b));
            }
        }
        match Bvh::parse(&bytes) {
            Ok(bvh) => assert_eq!(bvh.world(bvh.frame_count - 1).len(), bvh.joints.len()),
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 100, "{refused} of 300 refused");
}
