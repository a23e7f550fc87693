//! Walks, turns and steps.

use super::super::actor::{Actor, sign};
use super::super::gait::{Manner, ORDINARY, Step, Title, Walk, stepping};
use super::super::plan::Script;
use super::super::tracks::DEG;
use super::{STAND, scales};

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

pub(super) fn walks() -> Vec<Script> {
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

pub(super) fn turn() -> Script {
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
        let (sin, cos) = sinew_physics::math::trig::sin_cos(face);
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

pub(super) fn side_steps() -> Script {
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

pub(super) fn back_steps() -> Script {
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
