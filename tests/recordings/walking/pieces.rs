//! Goal: recordings are walked in whatever way they are played. Method: recordings played backwards. Pieces that break
//! off are in `tests/corpus`.

use crate::common::{man, mocap};
use sinew_evaluate::experiments::walk::{self as experiments, WalkTrial, Walker};
use sinew_physics::motion::Bvh;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::{Preparation, RetargetOptions};
use std::sync::Arc;

/// A recording with its frames replaced; `of` receives the frames and the duration of each, s.
fn with_frames(name: &str, of: impl Fn(Vec<&str>, f64) -> Vec<&str>) -> Bvh {
    let text = String::from_utf8(mocap::read(&format!("{name}.bvh"))).unwrap();
    let head = text.find("Frames:").unwrap();
    let (head, motion) = text.split_at(head);
    let mut lines = motion.lines().skip(1);
    let time = lines.next().unwrap();
    let frame: f64 = time.split(':').nth(1).unwrap().trim().parse().unwrap();
    let frames = of(lines.filter(|l| !l.trim().is_empty()).collect(), frame);
    let count = frames.len();
    let file = format!("{head}Frames: {count}\n{time}\n{}\n", frames.join("\n"));
    Bvh::parse(file.as_bytes()).unwrap()
}

/// Played backwards, a recording is a different motion: toes land first, heels leave last, and a stop becomes a start.
#[test]
fn recordings_are_followed_backwards_too() {
    let body = man();
    let options = RetargetOptions {
        preparation: Preparation::walking(true),
        ..RetargetOptions::default()
    };
    let (mut all, mut followed) = (0, 0);
    for name in mocap::on_feet() {
        let bvh = with_frames(name, |frames, _| frames.into_iter().rev().collect());
        let clip = Arc::new(
            prepare_recording(&bvh.recording().unwrap(), &body, &options)
                .unwrap()
                .clip,
        );
        let w = experiments::walk(&Walker::new(&body), &WalkTrial::once(&clip));
        let rms = w.report.tracking_joint_rms_deg;
        let text = format!(
            "{name}, backwards: {rms:.2} deg, capture point {:.0} mm, fell {:?}",
            1e3 * w.capture[1],
            w.fell_s
        );
        println!("{text}");
        all += 1;
        followed += usize::from(w.stood() && rms < 2.5 && w.capture[1] < 0.2);
    }
    // No person has danced or run like that.
    assert!(10 * followed > 8 * all, "{followed} of {all}");
}
