//! To the floor.

use super::super::actor::Actor;
use super::super::gait::at_ease;
use super::super::plan::{Script, Touch, standing_feet};
use super::super::tracks::{DEG, Track, mix};
use super::{STAND, hips, in_place};

/// Deep squat, sits down behind the heels, lies back with the knees up, sits up and stands.
pub(super) fn lie_down() -> Script {
    let a = Actor::medium();
    let length = 10.0;
    let high = hips(&a, STAND);
    let floor = 0.105;
    let crouch = a.ankle + 0.34 * a.leg();
    let height = Track::through(&[
        (0.5, high),
        (2.0, crouch),
        (2.9, floor),
        (7.0, floor),
        (7.9, crouch),
        (9.4, high),
    ]);
    let squat = Track::still(&[
        (0.5, 0.0),
        (2.0, 1.0),
        (2.9, 1.0),
        (4.0, 0.0),
        (5.6, 0.0),
        (6.9, 1.0),
        (7.9, 1.0),
        (9.4, 0.0),
    ]);
    let lie = Track::still(&[(2.9, 0.0), (4.3, 1.0), (5.3, 1.0), (6.8, 0.0)]);
    let behind = -0.56;
    let seated = Track::still(&[(2.0, 0.0), (2.9, 1.0), (7.0, 1.0), (7.9, 0.0)]);
    let sit = seated.clone();
    let place = Track::still(&[(0.0, behind), (1.0, behind)]);
    let hands = Track::still(&[(1.5, 0.0), (2.4, 1.0), (2.9, 1.0), (3.9, 0.0)]);
    Script {
        kind: "floor",
        feet: standing_feet(length, 0.13, 10.0 * DEG),
        elsewhere: Some((place.clone(), seated.clone())),
        seat: Some((place, seated)),
        touches: vec![
            Touch {
                part: "pelvis",
                from: 2.9,
                until: 7.0,
            },
            Touch {
                part: "back",
                from: 4.2,
                until: 5.4,
            },
        ],
        ..in_place(
            "lie-down",
            "Squats, sits down behind the heels, lies on the back with the knees up, sits up and stands.",
            length,
            0.13,
            height,
            Box::new(move |t| {
                let mut u = at_ease();
                let (w, l, h) = (squat.at(t), lie.at(t), hands.at(t));
                // From leaning forward over flat on the back.
                let slumped = mix(4.0 + 8.0 * w, -22.0, sit.at(t));
                u.pelvis[0] = mix(slumped, -84.0, l) * DEG;
                u.waist[0] = mix(-1.0 + 34.0 * w, -2.0 + 30.0 * l * (1.0 - l) * 4.0, l) * DEG;
                u.thorax[0] = mix(2.0 + 22.0 * w, -2.0 + 22.0 * l * (1.0 - l) * 4.0, l) * DEG;
                u.neck[0] = mix(-4.0 - 22.0 * w, 2.0 + 26.0 * l * (1.0 - l) * 4.0, l) * DEG;
                for side in 0..2 {
                    let front = 88.0 * w * (1.0 - 0.5 * h);
                    u.shoulder[side][0] =
                        mix(2.0 + front, 2.0 + 60.0 * l * (1.0 - l) * 4.0, l) * DEG;
                    u.shoulder[side][1] = mix(7.0, 16.0, l) * DEG;
                    u.elbow[side][0] = mix(13.0 + 8.0 * w, 10.0, l) * DEG;
                }
                u
            }),
        )
    }
}
