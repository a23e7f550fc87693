//! Jumps, a jog and a kick.

use super::super::actor::{Actor, sign};
use super::super::gait::{Manner, Step, Title, at_ease, stepping};
use super::super::plan::{GRAVITY, Height, Script, Via, flat, standing_feet};
use super::super::tracks::{DEG, Key, Track, bump, mix, rest, v3};
use super::{STAND, hips, in_place, standing_centre};

fn ballistic(t: f64, value: f64, rate: f64) -> Key {
    Key {
        t,
        value,
        rate,
        acceleration: -GRAVITY,
    }
}

/// Jumps with both feet: for each the take-off time, the flight time, how far forward, and how deep the body sinks
/// before it.
pub(super) fn jumping(
    name: &str,
    kind: &'static str,
    about: &'static str,
    jumps: &[(f64, f64, f64, f64)],
    tail: f64,
) -> Script {
    let a = Actor::medium();
    let z0 = standing_centre(&a);
    let (off, down) = (z0 + 0.045, z0 - 0.005);
    let mut keys = vec![rest(jumps[0].0 - 0.95, z0)];
    let mut feet = standing_feet(0.0, 0.10, 7.0 * DEG);
    let mut x = 0.0;
    let mut landed = 0.0;
    let mut sink = Vec::new();
    for (k, &(take_off, flight, ahead, depth)) in jumps.iter().enumerate() {
        // Take-off and landing heights differ, so the speeds do too.
        let v = (down - off + 0.5 * GRAVITY * flight * flight) / flight;
        if k == 0 {
            keys.push(rest(take_off - 0.34, z0 - depth));
            sink.push((take_off - 0.95, 0.0));
            sink.push((take_off - 0.34, depth));
        } else {
            let middle = mix(landed, take_off, 0.47);
            keys.push(Key {
                acceleration: 12.0,
                ..rest(middle, z0 - depth)
            });
            sink.push((middle, depth));
        }
        sink.push((take_off - 0.03, 0.0));
        keys.push(ballistic(take_off, off, v));
        landed = take_off + flight;
        keys.push(ballistic(landed, down, v - GRAVITY * flight));
        sink.push((landed, 0.015));
        for side in 0..2 {
            let plan = &mut feet[side];
            let last = plan.stances.last_mut().expect("stands");
            last.until = take_off;
            last.off = (-58.0 * DEG, 0.20);
            last.roll.1 = 0.09;
            for u in [0.2, 0.4, 0.6, 0.8] {
                let s = u * flight;
                let rise = v * s - 0.5 * GRAVITY * s * s;
                // The ankle keeps its distance to the body, a little less in the middle.
                let with_body = mix(0.105, 0.055, u) + rise + 0.07 * bump(u, -0.2, 1.2);
                plan.via.push(Via {
                    t: take_off + s,
                    at: v3(
                        mix(x + 0.05, x + ahead - 0.01, u),
                        sign(side) * 0.10,
                        with_body,
                    ),
                    pitch: mix(-62.0, -26.0, u) * DEG,
                });
            }
            x += if side == 1 { ahead } else { 0.0 };
            let at = if side == 1 { x } else { x + ahead };
            let mut next = flat(landed, 0.0, at, sign(side) * 0.10, sign(side) * 7.0 * DEG);
            next.strike = (-24.0 * DEG, 0.13);
            next.roll.0 = 0.085;
            plan.stances.push(next);
        }
    }
    let deep = 0.6 * jumps[jumps.len() - 1].3 + 0.06;
    keys.push(Key {
        acceleration: 4.0,
        ..rest(landed + 0.26, z0 - deep)
    });
    sink.push((landed + 0.26, deep));
    keys.push(rest(landed + 0.95, z0));
    sink.push((landed + 0.95, 0.0));
    let length = landed + tail;
    for plan in &mut feet {
        plan.stances.last_mut().expect("lands").until = length + 1.0;
    }
    let sink = Track::still(&sink);
    // Arms go back with the crouch, swing up at take-off and come down after landing.
    let mut swing = vec![(jumps[0].0 - 0.95, 2.0), (jumps[0].0 - 0.36, -42.0)];
    for (k, j) in jumps.iter().enumerate() {
        let high = if k == 0 && jumps.len() == 1 {
            120.0
        } else {
            55.0
        };
        swing.push((j.0 + 0.05, high));
        if let Some(next) = jumps.get(k + 1) {
            swing.push((mix(j.0 + j.1, next.0, 0.4), -12.0));
        }
    }
    swing.push((landed + 0.35, 25.0));
    swing.push((landed + 1.0, 2.0));
    let swing = Track::still(&swing);
    Script {
        name: name.to_owned(),
        kind,
        about,
        actor: a,
        length,
        window: (0.0, length),
        feet,
        style: Box::new(move |t| {
            let mut u = at_ease();
            let w = sink.at(t) / 0.3;
            u.pelvis[0] += 20.0 * DEG * w;
            u.waist[0] += 16.0 * DEG * w;
            u.thorax[0] += 8.0 * DEG * w;
            u.neck[0] -= 22.0 * DEG * w;
            let s = swing.at(t);
            for side in 0..2 {
                u.shoulder[side][0] = s * DEG;
                u.elbow[side][0] += (0.16 * (s - 2.0) + 22.0 * w) * DEG;
                u.shoulder[side][1] += 0.0012 * s * s * DEG;
            }
            u
        }),
        heading: Track::default(),
        height: Height::Centre(Track::new(keys)),
        elsewhere: None,
        seat: None,
        sway: Default::default(),
        touches: Vec::new(),
    }
}

pub(super) fn jog() -> Script {
    let a = Actor::medium();
    let z0 = standing_centre(&a);
    let base = z0 - 0.060;
    let half = 0.045;
    let count = 14;
    let mut steps: Vec<Step> = Vec::new();
    let mut x = 0.0;
    let mut on = 1.25;
    let mut keys = vec![rest(0.5, z0)];
    // Touch-down of step k; the other foot leaves the floor one flight before it.
    let mut flights = Vec::new();
    let mut lengths = Vec::new();
    for k in 0..count {
        let ease = (f64::from(k as u32 + 1) / 4.0)
            .min(f64::from((count - k) as u32) / 4.0)
            .min(1.0);
        let last = k + 1 == count;
        flights.push(if last { 0.0 } else { 0.05 + 0.065 * ease });
        lengths.push(if last { 0.0 } else { 0.25 + 0.58 * ease });
    }
    let contact = 0.235;
    for k in 0..count {
        let side = (k + 1) % 2;
        x += lengths[k];
        if k > 0 {
            on += contact + flights[k];
        }
        steps.push(Step {
            side,
            x,
            y: sign(side) * half,
            yaw: sign(side) * 5.0 * DEG,
            off: 0.0,
            on,
            stride: (lengths[k] / 0.83).min(1.0),
        });
    }
    // Lift-off of each step's foot: contact after its touch-down before.
    for k in 0..count {
        let other = if k == 0 {
            0.85
        } else if k == 1 {
            steps[0].on - flights[0]
        } else {
            steps[k - 2].on + contact
        };
        steps[k].off = other;
    }
    for k in 0..count {
        let v = 0.5 * GRAVITY * flights[k];
        let (leave, land) = (steps[k].on - flights[k], steps[k].on);
        if flights[k] > 0.0 {
            keys.push(ballistic(leave, base, v));
            keys.push(ballistic(land, base, -v));
        }
    }
    let end = steps[count - 1].on;
    keys.push(rest(end + 0.9, z0));
    let manner = Manner {
        strike: 8.0,
        push: -52.0,
        lift: 0.10,
        stand: STAND,
        tall: 0.95,
        drop: 0.0,
        lean: 9.0,
        swing: 30.0,
        arm: 2.0,
        abduction: 12.0,
        elbow: 82.0,
        elbow_swing: 14.0,
        twist: 8.0,
        list: 2.5,
    };
    let times: Vec<Step> = steps.clone();
    let mut script = stepping(
        Title {
            name: "jog",
            kind: "run",
            about: "Jogs at 2.4 m/s with flights of 0.11 s; the recording begins and ends in motion.",
        },
        a,
        half,
        steps,
        manner,
        1.4,
    );
    for (side, plan) in script.feet.iter_mut().enumerate() {
        for s in &mut plan.stances {
            if s.until < script.length {
                s.off.1 = s.off.1.min(0.16);
            }
            s.strike.1 = s.strike.1.min(0.07);
        }
        for (k, s) in times.iter().enumerate().filter(|(_, s)| s.side == side) {
            let from = if k < 2 { 0.0 } else { times[k - 2].x };
            let h = s.on - s.off;
            let big = s.stride;
            if big < 0.2 {
                continue;
            }
            // Heel up behind, knee through, foot reaching down.
            for (u, ahead, high, pitch) in [(0.36, 0.34, 0.27, -78.0), (0.70, 0.80, 0.17, -12.0)] {
                plan.via.push(Via {
                    t: s.off + u * h,
                    at: v3(
                        mix(from, s.x, ahead),
                        sign(side) * half,
                        high * mix(0.45, 1.0, big),
                    ),
                    pitch: pitch * mix(0.6, 1.0, big) * DEG,
                });
            }
        }
    }
    script.height = Height::Centre(Track::new(keys));
    script.window = (times[3].on - 0.1, times[11].on + 0.1);
    script
}

pub(super) fn kick() -> Script {
    let a = Actor::medium();
    let high = hips(&a, STAND);
    let mut feet = standing_feet(5.0, 0.095, 8.0 * DEG);
    let (off, on) = (1.5, 3.4);
    let y = -0.095;
    let right = &mut feet[1];
    right.stances[0].until = off;
    right.stances[0].off = (-30.0 * DEG, 0.25);
    right.stances.push(flat(on, 7.0, 0.0, y, -8.0 * DEG));
    right.via = vec![
        Via {
            t: 1.85,
            at: v3(-0.24, y, 0.17),
            pitch: -62.0 * DEG,
        },
        Via {
            t: 2.08,
            at: v3(0.06, y + 0.02, 0.19),
            pitch: -32.0 * DEG,
        },
        Via {
            t: 2.28,
            at: v3(0.72, y + 0.05, 0.36),
            pitch: 4.0 * DEG,
        },
        Via {
            t: 2.60,
            at: v3(0.34, y + 0.03, 0.26),
            pitch: 0.0,
        },
    ];
    let arms = Track::through(&[
        (1.2, 0.0),
        (1.85, -1.0),
        (2.28, 1.0),
        (2.9, 0.3),
        (3.6, 0.0),
    ]);
    let on_one = Track::still(&[(0.9, 0.0), (1.5, 1.0), (3.2, 1.0), (3.9, 0.0)]);
    Script {
        feet,
        kind: "step",
        ..in_place(
            "kick",
            "Shifts to the left foot, swings the right leg back and kicks a ball.",
            5.0,
            0.095,
            Track::still(&[
                (0.8, high),
                (1.5, hips(&a, 0.978)),
                (3.3, hips(&a, 0.978)),
                (4.0, high),
            ]),
            Box::new(move |t| {
                let mut u = at_ease();
                let (s, w) = (arms.at(t), on_one.at(t));
                u.pelvis[0] -= 8.5 * DEG * s;
                u.pelvis[2] = 9.0 * DEG * s;
                u.waist[2] = -9.0 * DEG * s;
                u.thorax[2] = -8.0 * DEG * s;
                u.neck[2] = 7.0 * DEG * s;
                u.neck[0] += 14.0 * DEG * w;
                u.thorax[0] += 5.0 * DEG * (s + w);
                for side in 0..2 {
                    // The arms swing against the leg.
                    u.shoulder[side][0] += sign(side) * 36.0 * DEG * s;
                    u.shoulder[side][1] += 22.0 * DEG * w;
                    u.elbow[side][0] += 18.0 * DEG * w;
                }
                u
            }),
        )
    }
}
