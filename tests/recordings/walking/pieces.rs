//! Goal: what a recording happens to be cut to, or played as, is walked too.
//! Method: recordings backwards, and pieces that break off while they turn.

use super::walk;
use crate::common::{man, mocap};
use sinew::sim::motion::Bvh;
use sinew::sim::retarget::retarget;
use sinew::sim::retarget::{Preparation, RetargetOptions};
use std::sync::Arc;

/// The frames of a recording from `from` on for `seconds`, as a file of its own.
fn piece(name: &str, from: f64, seconds: f64) -> Bvh {
    with_frames(name, |frames, frame| {
        let [from, count] = [from, seconds].map(|t| (t / frame) as usize);
        frames.into_iter().skip(from).take(count).collect()
    })
}

/// A recording with other frames in place of its own, of which each takes so many seconds.
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

/// Played backwards, a recording is a motion of its own: toes land first, heels leave last, and whoever stopped sets
/// off.
#[test]
fn recordings_are_followed_backwards_too() {
    let body = man();
    let options = RetargetOptions {
        preparation: Preparation::walking(true),
        ..RetargetOptions::default()
    };
    for (name, bounds) in [
        ("walk", (1.5, 0.06)),
        ("turn", (1.3, 0.08)),
        ("walk-around", (1.3, 0.1)),
        ("salsa-a", (0.6, 0.05)),
        ("salsa-b", (1.2, 0.12)),
        ("carry", (1.2, 0.08)),
        ("hit", (1.6, 0.12)),
        ("wave", (0.6, 0.05)),
        ("jump", (2.5, 0.2)),
        ("quick-stop", (2.2, 0.18)),
    ] {
        let bvh = with_frames(name, |frames, _| frames.into_iter().rev().collect());
        let clip = Arc::new(retarget(&bvh, &body, &options).unwrap().clip);
        let seconds = clip.lead_in() + clip.duration() + clip.lead_out() + 1.0;
        let what = format!("{name}, backwards");
        let (rms, capture) = walk(&body, &what, &clip, false, seconds);
        assert!(
            rms < bounds.0 && capture < bounds.1,
            "{what}: {rms} deg, {capture} m"
        );
    }
}

#[test]
fn who_breaks_off_while_turning_turns_on_to_a_stand() {
    let body = man();
    for from in [1.14, 2.28] {
        // On the left foot, falling to its outer side: straight on the right one does not get there.
        let bvh = piece("walk-around", from, 2.0);
        let clip = Arc::new(
            retarget(&bvh, &body, &RetargetOptions::default())
                .unwrap()
                .clip,
        );
        assert!(clip.lead_out() > 1.0, "no steps from {from} s");
        let seconds = clip.lead_in() + clip.duration() + clip.lead_out() + 1.0;
        let what = format!("walk-around from {from} s");
        let (rms, capture) = walk(&body, &what, &clip, false, seconds);
        assert!(rms < 4.0 && capture < 0.3, "{what}: {rms} deg, {capture} m");
    }
}
