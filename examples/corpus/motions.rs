//! The motions of the corpus.

use crate::actor::{Actor, pelvis_turn, sign};
use crate::gait::{Manner, ORDINARY, Step, Title, Walk, at_ease, deg, stepping};
use crate::plan::{GRAVITY, Height, Script, Style, Touch, Via, flat, standing_feet};
use crate::tracks::{DEG, Key, Track, bump, mix, ramp, rest, v3};

/// Height of the hips in quiet standing, share of the leg.
const STAND: f64 = 0.992;

fn hips(actor: &Actor, share: f64) -> f64 {
    actor.ankle + actor.leg() * share
}

/// Height of the centre of mass in quiet standing.
fn standing_centre(actor: &Actor) -> f64 {
    let feet = standing_feet(1.0, 0.095, 0.1);
    let upper = at_ease();
    let pose = actor.pose(
        v3(0.0, 0.0, hips(actor, STAND)),
        pelvis_turn(0.0, &upper),
        &upper,
        [feet[0].at(actor, 0.0), feet[1].at(actor, 0.0)],
    );
    actor.centre(&pose).z
}

fn in_place(
    name: &str,
    about: &'static str,
    length: f64,
    half: f64,
    height: Track,
    style: Style,
) -> Script {
    Script {
        name: name.to_owned(),
        kind: "stand",
        about,
        actor: Actor::medium(),
        length,
        window: (0.0, length),
        feet: standing_feet(length, half, 8.0 * DEG),
        style,
        heading: Track::default(),
        height: Height::Pelvis(height),
        elsewhere: None,
        seat: None,
        sway: Default::default(),
        touches: Vec::new(),
    }
}

fn stand() -> Script {
    let a = Actor::medium();
    let head = Track::through(&[
        (0.0, 0.0),
        (1.0, 6.0),
        (2.2, 18.0),
        (3.2, 12.0),
        (4.4, -10.0),
        (5.2, -4.0),
        (6.0, 0.0),
    ]);
    let sway = Track::through(&[
        (0.3, 0.0),
        (1.4, 0.012),
        (2.6, -0.006),
        (3.7, 0.009),
        (4.9, -0.008),
        (5.7, 0.0),
    ]);
    let side = Track::still(&[
        (0.4, 0.0),
        (2.0, 0.045),
        (3.2, 0.040),
        (5.0, -0.02),
        (5.8, 0.0),
    ]);
    let lean = side.clone();
    Script {
        sway: [sway, side],
        ..in_place(
            "stand",
            "Quiet standing: weight shifts, sway, looking around, breathing.",
            6.0,
            0.11,
            Track::still(&[(0.0, hips(&a, STAND)), (6.0, hips(&a, STAND))]),
            Box::new(move |t| {
                let mut u = at_ease();
                let breath = breathing(t);
                let shift = lean.at(t) / 0.045;
                u.thorax[0] -= 1.2 * DEG * breath;
                u.neck[2] = head.at(t) * DEG;
                u.neck[0] += 0.8 * DEG * breath;
                u.pelvis[1] = 2.2 * DEG * shift;
                u.waist[1] = -2.0 * DEG * shift;
                u.thorax[1] = -0.8 * DEG * shift;
                for side in 0..2 {
                    u.shoulder[side][1] += 0.9 * DEG * breath;
                    u.shoulder[side][0] += sign(side) * 1.5 * DEG * shift;
                }
                u
            }),
        )
    }
}

/// −1…1, one breath in 3 s.
fn breathing(t: f64) -> f64 {
    sinew::sim::math::trig::sin_cos(t * 2.0 * std::f64::consts::PI / 3.0).0
}

fn wave() -> Script {
    let a = Actor::medium();
    let up = Track::still(&[(0.6, 0.0), (1.4, 1.0), (4.2, 1.0), (5.1, 0.0)]);
    let side = Track::through(&[
        (1.3, 0.0),
        (1.65, 1.0),
        (2.05, -1.0),
        (2.45, 1.0),
        (2.85, -1.0),
        (3.25, 1.0),
        (3.65, -1.0),
        (4.1, 0.0),
    ]);
    in_place(
        "wave",
        "Raises the right arm and waves.",
        5.6,
        0.10,
        Track::still(&[(0.0, hips(&a, STAND)), (1.0, hips(&a, STAND))]),
        Box::new(move |t| {
            let mut u = at_ease();
            let (w, s) = (up.at(t), side.at(t));
            let goal = deg([38.0, 78.0 + 3.0 * s, -58.0 - 12.0 * s]);
            for k in 0..3 {
                u.shoulder[1][k] = mix(u.shoulder[1][k], goal[k], w);
            }
            u.elbow[1][0] = mix(u.elbow[1][0], (88.0 - 22.0 * s) * DEG, w);
            u.elbow[1][1] = mix(u.elbow[1][1], 40.0 * DEG, w);
            u.wrist[1] = deg([mix(4.0, 0.0, w), mix(-2.0, -6.0 * s, w)]);
            u.thorax[1] = -4.0 * DEG * w;
            u.waist[1] = -2.0 * DEG * w;
            u.neck[1] = 3.0 * DEG * w;
            u.neck[2] = -8.0 * DEG * w;
            u.thorax[0] -= 0.8 * DEG * breathing(t);
            u
        }),
    )
}

fn squat() -> Script {
    let a = Actor::medium();
    let down = Track::still(&[(0.5, 0.0), (2.1, 1.0), (2.6, 1.0), (4.2, 0.0)]);
    let high = hips(&a, STAND);
    let low = a.ankle + 0.40 * a.leg();
    let height = Track::still(&[(0.5, high), (2.1, low), (2.6, low), (4.2, high)]);
    in_place(
        "squat",
        "A deep squat with the arms forward.",
        4.8,
        0.145,
        height,
        Box::new(move |t| {
            let mut u = at_ease();
            let w = down.at(t);
            u.pelvis[0] += 24.0 * DEG * w;
            u.waist[0] += 22.0 * DEG * w;
            u.thorax[0] += 12.0 * DEG * w;
            u.neck[0] -= 34.0 * DEG * w;
            for side in 0..2 {
                u.shoulder[side][0] = mix(u.shoulder[side][0], 96.0 * DEG, w);
                u.shoulder[side][1] = mix(u.shoulder[side][1], 8.0 * DEG, w);
                u.elbow[side][0] = mix(u.elbow[side][0], 18.0 * DEG, w);
            }
            u
        }),
    )
}

fn lift() -> Script {
    let a = Actor::medium();
    let down = Track::still(&[(0.5, 0.0), (2.0, 1.0), (2.5, 1.0), (4.1, 0.0)]);
    let hold = Track::still(&[(2.4, 0.0), (4.2, 1.0)]);
    let (high, low) = (hips(&a, STAND), a.ankle + 0.50 * a.leg());
    let height = Track::still(&[(0.5, high), (2.0, low), (2.5, low), (4.1, hips(&a, 0.990))]);
    in_place(
        "lift",
        "Bends hips and knees, takes a box from the floor and stands with it before the chest; no load in the file.",
        5.4,
        0.15,
        height,
        Box::new(move |t| {
            let mut u = at_ease();
            let (w, h) = (down.at(t), hold.at(t));
            u.pelvis[0] += 34.0 * DEG * w - 2.0 * DEG * h;
            u.waist[0] += 30.0 * DEG * w - 3.0 * DEG * h;
            u.thorax[0] += 20.0 * DEG * w;
            u.neck[0] -= 30.0 * DEG * w - 6.0 * DEG * h;
            for side in 0..2 {
                let ease = at_ease();
                // Straight arms at the floor, then the box before the belly.
                let reach = [62.0, 4.0, 20.0, 16.0, 10.0];
                let carry = [24.0, 6.0, 25.0, 78.0, 5.0];
                let lifted: Vec<f64> = (0..5).map(|k| mix(reach[k], carry[k], h) * DEG).collect();
                let on = w.max(h).max(ramp(t, 2.0, 2.1));
                for k in 0..3 {
                    u.shoulder[side][k] = mix(ease.shoulder[side][k], lifted[k], on);
                }
                for k in 0..2 {
                    u.elbow[side][k] = mix(ease.elbow[side][k], lifted[3 + k], on);
                }
            }
            u
        }),
    )
}

/// Length and time factors of an actor against the adult one: a pendulum of its leg.
fn scales(actor: &Actor) -> (f64, f64) {
    let k = actor.leg() / Actor::medium().leg();
    (k, k.sqrt())
}

fn walk(
    name: &str,
    about: &'static str,
    actor: Actor,
    mut walk: Walk,
    manner: Manner,
    first: usize,
) -> Script {
    let (length, time) = scales(&actor);
    walk.length *= length;
    walk.half *= length;
    walk.time *= time;
    let half = walk.half.max(0.07 * length);
    let steps = walk.steps(first);
    let title = Title {
        name,
        kind: "walk",
        about,
    };
    stepping(title, actor, half, steps, manner, 1.3)
}

const WALK: Walk = Walk {
    steps: 8,
    length: 0.62,
    time: 0.56,
    double: 0.24,
    half: 0.062,
    curve: 0.0,
    before: 0.9,
    pause: None,
};

fn walks() -> Vec<Script> {
    let normal = |name: &str, about, actor| walk(name, about, actor, Walk { ..WALK }, ORDINARY, 1);
    let slow = Manner {
        strike: 13.0,
        push: -42.0,
        drop: 0.026,
        swing: 11.0,
        elbow_swing: 5.0,
        twist: 3.0,
        tall: 0.987,
        ..ORDINARY
    };
    let fast = Manner {
        strike: 22.0,
        push: -58.0,
        drop: 0.058,
        tall: 0.978,
        lean: 4.0,
        swing: 25.0,
        arm: 5.0,
        elbow: 32.0,
        elbow_swing: 18.0,
        twist: 6.5,
        list: 3.5,
        ..ORDINARY
    };
    let crouched = Manner {
        strike: 8.0,
        push: -36.0,
        lift: 0.05,
        tall: 0.915,
        stand: 0.93,
        drop: 0.01,
        lean: 22.0,
        swing: 9.0,
        arm: 14.0,
        abduction: 14.0,
        elbow: 50.0,
        elbow_swing: 8.0,
        list: 1.5,
        ..ORDINARY
    };
    let broad = Manner {
        lift: 0.03,
        swing: 14.0,
        abduction: 26.0,
        elbow: 34.0,
        elbow_swing: 6.0,
        twist: 7.0,
        list: 2.0,
        lean: -1.0,
        push: -42.0,
        ..ORDINARY
    };
    vec![
        normal(
            "walk-normal",
            "Walks eight steps at 1.1 m/s, standing to standing.",
            Actor::medium(),
        ),
        normal(
            "walk-normal-tall",
            "The ordinary walk of a tall actor.",
            Actor::tall(),
        ),
        normal(
            "walk-normal-short",
            "The ordinary walk of a short actor.",
            Actor::short(),
        ),
        normal(
            "walk-normal-child",
            "The ordinary walk of a child.",
            Actor::child(),
        ),
        walk(
            "walk-slow",
            "Walks seven slow steps at 0.65 m/s.",
            Actor::medium(),
            Walk {
                steps: 7,
                length: 0.48,
                time: 0.74,
                double: 0.30,
                ..WALK
            },
            slow,
            0,
        ),
        walk(
            "walk-fast",
            "Walks eleven brisk steps at 1.5 m/s.",
            Actor::medium(),
            Walk {
                steps: 11,
                length: 0.71,
                time: 0.48,
                double: 0.18,
                half: 0.052,
                ..WALK
            },
            fast,
            1,
        ),
        walk(
            "walk-crouched",
            "Sneaks with bent knees and the trunk leant forward.",
            Actor::medium(),
            Walk {
                length: 0.50,
                time: 0.66,
                half: 0.085,
                ..WALK
            },
            crouched,
            0,
        ),
        walk(
            "walk-broad",
            "Struts with arms held off the body and feet apart.",
            Actor::medium(),
            Walk {
                length: 0.58,
                time: 0.60,
                half: 0.115,
                ..WALK
            },
            broad,
            1,
        ),
        walk(
            "walk-arc",
            "Walks an arc of 1.5 m radius to the left.",
            Actor::medium(),
            Walk {
                steps: 9,
                length: 0.52,
                time: 0.58,
                curve: 1.0 / 1.5,
                half: 0.07,
                ..WALK
            },
            Manner {
                swing: 14.0,
                push: -44.0,
                strike: 15.0,
                drop: 0.028,
                ..ORDINARY
            },
            0,
        ),
        walk(
            "walk-stop-start",
            "Walks five steps, stands for a second, walks on.",
            Actor::medium(),
            Walk {
                steps: 10,
                pause: Some((5, 1.0)),
                length: 0.58,
                ..WALK
            },
            ORDINARY,
            1,
        ),
    ]
}

/// Small steps on the spot or aside.
const STEPPING: Manner = Manner {
    strike: 0.0,
    push: -20.0,
    lift: 0.06,
    stand: STAND,
    tall: 0.982,
    drop: 0.006,
    lean: 1.0,
    swing: 4.0,
    arm: 4.0,
    abduction: 9.0,
    elbow: 20.0,
    elbow_swing: 2.0,
    twist: 1.0,
    list: 1.5,
};

fn turn() -> Script {
    // Quarter by quarter to the left: the left foot opens, the right one follows.
    let half = 0.095;
    let mut steps = Vec::new();
    let mut t = 0.8;
    let mut yaw = [8.0 * DEG, -8.0 * DEG];
    for k in 0..6 {
        let side = k % 2;
        let goal = if k == 5 {
            150.0
        } else {
            30.0 + 50.0 * f64::from(k as u32 / 2) + if side == 0 { 25.0 } else { 20.0 }
        };
        yaw[side] = goal * DEG + sign(side) * 8.0 * DEG;
        // The foot stands beside the axis of the body, at right angles to the mean heading.
        let face = if k == 5 {
            150.0 * DEG
        } else {
            0.5 * (yaw[0] + yaw[1])
        };
        let (sin, cos) = sinew::sim::math::trig::sin_cos(face);
        steps.push(Step {
            side,
            x: -sin * sign(side) * half,
            y: cos * sign(side) * half,
            yaw: yaw[side],
            off: t,
            on: t + 0.42,
            stride: 0.0,
        });
        t += 0.72;
    }
    stepping(
        Title {
            name: "turn",
            kind: "turn",
            about: "Turns on the spot by 150° to the left in six steps.",
        },
        Actor::medium(),
        half,
        steps,
        STEPPING,
        1.0,
    )
}

fn side_steps() -> Script {
    let half = 0.09;
    let mut steps = Vec::new();
    let mut y = 0.0;
    let mut t = 0.8;
    for k in 0..6 {
        let side = k % 2;
        if side == 0 {
            y += 0.30;
        }
        steps.push(Step {
            side,
            x: 0.0,
            y: y + sign(side) * half,
            yaw: sign(side) * 6.0 * DEG,
            off: t,
            on: t + 0.40,
            stride: 0.0,
        });
        t += 0.66;
    }
    let manner = Manner {
        lift: 0.07,
        list: 2.0,
        tall: 0.965,
        abduction: 14.0,
        ..STEPPING
    };
    stepping(
        Title {
            name: "side-steps",
            kind: "step",
            about: "Three side steps to the left.",
        },
        Actor::medium(),
        half,
        steps,
        manner,
        1.0,
    )
}

fn back_steps() -> Script {
    let half = 0.085;
    let mut steps = Vec::new();
    let mut x = 0.0;
    let mut t = 0.8;
    for k in 0..6 {
        let side = (k + 1) % 2;
        let last = k == 5;
        x -= if last {
            0.0
        } else if k == 0 {
            0.2
        } else {
            0.32
        };
        steps.push(Step {
            side,
            x,
            y: sign(side) * half,
            yaw: sign(side) * 6.0 * DEG,
            off: t,
            on: t + 0.42,
            stride: if last {
                0.0
            } else if k == 0 {
                -0.4
            } else {
                -0.6
            },
        });
        t += 0.64;
    }
    let manner = Manner {
        lift: 0.045,
        tall: 0.972,
        drop: 0.02,
        lean: 4.0,
        swing: 9.0,
        twist: 3.0,
        ..STEPPING
    };
    stepping(
        Title {
            name: "back-steps",
            kind: "step",
            about: "Six steps backward.",
        },
        Actor::medium(),
        half,
        steps,
        manner,
        1.1,
    )
}

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
fn jumping(
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

fn jog() -> Script {
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

fn kick() -> Script {
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

/// Deep squat, sits down behind the heels, lies back with the knees up, sits up and stands.
fn lie_down() -> Script {
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

/// All motions, in order of their names' first use.
pub fn all() -> Vec<Script> {
    let mut out = vec![stand(), wave(), squat(), lift()];
    out.extend(walks());
    out.extend([turn(), side_steps(), back_steps(), jog()]);
    out.push(jumping(
        "jump",
        "jump",
        "Jumps up from both feet with a swing of the arms.",
        &[(1.75, 0.46, 0.0, 0.28)],
        1.5,
    ));
    out.push(jumping(
        "hops",
        "jump",
        "Three hops forward on both feet.",
        &[
            (1.6, 0.26, 0.30, 0.17),
            (2.24, 0.26, 0.30, 0.13),
            (2.88, 0.26, 0.30, 0.13),
        ],
        1.5,
    ));
    out.push(kick());
    out.push(lie_down());
    out
}
