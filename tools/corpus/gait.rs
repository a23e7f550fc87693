//! Motions made of steps: walks, turns on the spot, side and back steps, jogging.

use super::actor::{Actor, Upper, sign};
use super::plan::{FootPlan, Height, MID_FOOT, Script, Stance, Style};
use super::tracks::{DEG, Key, Track, bump, mix, rest};
use sinew_physics::math::trig;

/// One step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// 0 left, 1 right.
    pub side: usize,
    pub x: f64,
    pub y: f64,
    pub yaw: f64,
    /// Lift-off and touch-down, s.
    pub off: f64,
    pub on: f64,
    /// Stride at touch-down: +1 a full step ahead of the other foot, −1 behind, 0 beside.
    pub stride: f64,
}

/// Style of the steps.
#[derive(Clone, Copy, Debug)]
pub struct Manner {
    /// Pitch at touch-down and at lift-off of a full step, degrees.
    pub strike: f64,
    pub push: f64,
    /// Extra height of the ankle in mid-swing, m.
    pub lift: f64,
    /// Height of the hips while standing and in mid-swing, shares of the leg.
    pub stand: f64,
    pub tall: f64,
    /// Lowering of the hips in double support, m.
    pub drop: f64,
    /// Trunk bent forward, degrees.
    pub lean: f64,
    /// Arm swing from the middle, degrees; mean flexion; abduction.
    pub swing: f64,
    pub arm: f64,
    pub abduction: f64,
    /// Elbow flexion: mean and change with the swing, degrees.
    pub elbow: f64,
    pub elbow_swing: f64,
    /// Turn of the pelvis and counter-rotation of the chest, degrees.
    pub twist: f64,
    /// Drop of the pelvis on the swing side, degrees.
    pub list: f64,
}

/// An ordinary walk.
pub const ORDINARY: Manner = Manner {
    strike: 18.0,
    push: -52.0,
    lift: 0.022,
    stand: 0.992,
    tall: 0.984,
    drop: 0.036,
    lean: 2.0,
    swing: 17.0,
    arm: 3.0,
    abduction: 7.0,
    elbow: 18.0,
    elbow_swing: 9.0,
    twist: 4.5,
    list: 3.0,
};

/// Rad from degrees, three at a time.
pub fn deg<const N: usize>(a: [f64; N]) -> [f64; N] {
    a.map(|x| x * DEG)
}

/// Arms hanging at ease, trunk upright.
pub fn at_ease() -> Upper {
    Upper {
        pelvis: deg([4.0, 0.0, 0.0]),
        waist: deg([-1.0, 0.0, 0.0]),
        thorax: deg([2.0, 0.0, 0.0]),
        neck: deg([-4.0, 0.0, 0.0]),
        shoulder: [deg([2.0, 7.0, 8.0]); 2],
        elbow: [deg([13.0, 15.0]); 2],
        wrist: [deg([4.0, -2.0]); 2],
    }
}

/// Foot plans from the initial stance and the steps.
pub fn plans(
    actor: &Actor,
    start: [[f64; 3]; 2],
    steps: &[Step],
    manner: &Manner,
    length: f64,
) -> [FootPlan; 2] {
    let scale = actor.ball / 0.132;
    [0, 1].map(|side| {
        let mut stances = vec![Stance {
            from: -1.0,
            until: length + 1.0,
            x: start[side][0],
            y: start[side][1],
            yaw: start[side][2],
            strike: (0.0, 0.0),
            off: (0.0, 0.0),
            roll: (MID_FOOT, MID_FOOT),
        }];
        for (k, s) in steps.iter().enumerate().filter(|(_, s)| s.side == side) {
            let last = stances.last_mut().expect("starts standing");
            last.until = s.off;
            // The push-off of the rear leg depends on the following stride.
            let behind = steps[..k]
                .iter()
                .rev()
                .find(|o| o.side != side)
                .map_or(0.0, |o| o.stride);
            let ahead = behind.max(0.35 * s.stride.max(0.0)).max(0.0);
            let back = (-s.stride).max(0.0);
            let period = (s.on - s.off).max(0.2);
            last.off = if back > 0.0 {
                (10.0 * DEG * back, 0.6 * period)
            } else {
                (manner.push * DEG * ahead, 1.05 * period)
            };
            last.roll.1 = mix(MID_FOOT, 0.118, ahead);
            let strike = if back > 0.0 {
                -22.0 * back
            } else {
                manner.strike * s.stride.clamp(0.0, 1.0)
            };
            let heel = s.stride.clamp(0.0, 1.0);
            stances.push(Stance {
                from: s.on,
                until: length + 1.0,
                x: s.x,
                y: s.y,
                yaw: s.yaw,
                strike: (
                    strike * DEG,
                    if strike == 0.0 { 0.0 } else { 0.30 * period },
                ),
                off: (0.0, 0.0),
                roll: (
                    if back > 0.0 {
                        mix(MID_FOOT, 0.1, back)
                    } else {
                        mix(MID_FOOT, -0.012, heel)
                    },
                    MID_FOOT,
                ),
            });
        }
        FootPlan {
            stances,
            lift: manner.lift * scale,
            via: Vec::new(),
        }
    })
}

/// +1 while the left leg is ahead by a full step, −1 the right; smooth.
fn stride_track(steps: &[Step]) -> Track {
    let mut keys = vec![];
    if let Some(first) = steps.first() {
        keys.push((first.off - 0.12, 0.0));
    }
    for s in steps {
        keys.push((s.on, sign(s.side) * s.stride));
    }
    if let Some(last) = steps.last()
        && last.stride != 0.0
    {
        keys.push((last.on + 0.6, 0.0));
    }
    Track::still(&keys)
}

/// Pelvis height: standing, lower with every step.
fn pelvis_height(actor: &Actor, steps: &[Step], manner: &Manner) -> Track {
    let leg = actor.leg();
    let at = |share: f64| actor.ankle + leg * share;
    let scale = leg / 0.859;
    let (first, last) = (steps[0], steps[steps.len() - 1]);
    let mut keys = vec![(first.off - 0.35, at(manner.stand))];
    for (k, s) in steps.iter().enumerate() {
        let wide = s.stride.abs().max(if k == 0 {
            0.0
        } else {
            0.3 * steps[k - 1].stride.abs()
        });
        keys.push((0.5 * (s.off + s.on), at(manner.tall)));
        let next = steps.get(k + 1).map_or(s.on + 0.1, |n| n.off);
        keys.push((
            0.5 * (s.on + next).min(s.on + 0.2 + s.on),
            at(manner.tall) - manner.drop * scale * wide * wide,
        ));
    }
    keys.push((last.on + 0.7, at(manner.stand)));
    Track::still(&keys)
}

/// Angles of trunk and arms that accompany the steps.
fn swinging(steps: Vec<Step>, manner: Manner, length: f64) -> Style {
    let stride = stride_track(&steps);
    let begin = steps[0].off - 0.3;
    let end = steps[steps.len() - 1].on;
    let active = Track::still(&[
        (begin, 0.0),
        (begin + 0.6, 1.0),
        (end, 1.0),
        ((end + 0.8).min(length), 0.0),
    ]);
    Box::new(move |t| {
        let mut u = at_ease();
        let (s, on) = (stride.at(t), active.at(t));
        // Arms lag the legs a little.
        let arms = stride.at(t - 0.06);
        let list: f64 = steps
            .iter()
            .map(|k| -sign(k.side) * bump(t, k.off - 0.05, k.on + 0.05) * k.stride.abs().max(0.5))
            .sum::<f64>()
            * manner.list
            * DEG;
        let turn = -manner.twist * DEG * s;
        u.pelvis[1] = list;
        u.pelvis[2] = turn;
        u.pelvis[0] += 0.4 * manner.lean * DEG * on;
        u.waist = [
            u.waist[0] + 0.4 * manner.lean * DEG * on,
            -0.7 * list,
            -0.9 * turn,
        ];
        u.thorax = [
            u.thorax[0] + 0.4 * manner.lean * DEG * on,
            -0.2 * list,
            -0.9 * turn,
        ];
        u.neck = [
            u.neck[0] - 0.9 * manner.lean * DEG * on,
            -0.1 * list,
            0.8 * turn,
        ];
        for side in 0..2 {
            let a = -sign(side) * arms;
            let ease = at_ease();
            let goal = deg([manner.arm + manner.swing * a, manner.abduction, 8.0]);
            for k in 0..3 {
                u.shoulder[side][k] = mix(ease.shoulder[side][k], goal[k], on);
            }
            let bend = manner.elbow + manner.elbow_swing * a;
            u.elbow[side][0] = mix(ease.elbow[side][0], bend * DEG, on);
            u.elbow[side][1] = mix(ease.elbow[side][1], 25.0 * DEG, on);
        }
        u
    })
}

/// Name, kind and description of a motion.
pub struct Title<'a> {
    pub name: &'a str,
    pub kind: &'static str,
    pub about: &'static str,
}

/// A motion of steps: from a stance with the ankles `half` m off the middle line, and `tail` s long after the last
/// touch-down.
pub fn stepping(
    title: Title<'_>,
    actor: Actor,
    half: f64,
    steps: Vec<Step>,
    manner: Manner,
    tail: f64,
) -> Script {
    let out = 6.0 * DEG;
    let start = [0, 1].map(|s| [0.0, sign(s) * half, sign(s) * out]);
    let length = steps[steps.len() - 1].on + tail;
    let feet = plans(&actor, start, &steps, &manner, length);
    // The pelvis faces half-way between the feet.
    let mut yaw = [start[0][2], start[1][2]];
    let mut keys = vec![rest(0.0, 0.0)];
    for s in &steps {
        let before = 0.5 * (yaw[0] + yaw[1]);
        yaw[s.side] = s.yaw;
        let after = 0.5 * (yaw[0] + yaw[1]);
        if (after - before).abs() > 1e-9 {
            let from = s.off.max(keys[keys.len() - 1].t + 1e-6);
            keys.push(rest(from, before));
            keys.push(rest(s.on + 0.12, after));
        }
    }
    // Equal turns step after step give a steady rate instead of stops.
    let heading = steady(keys);
    Script {
        name: title.name.to_owned(),
        kind: title.kind,
        about: title.about,
        height: Height::Pelvis(pelvis_height(&actor, &steps, &manner)),
        style: swinging(steps, manner, length),
        actor,
        length,
        window: (0.0, length),
        feet,
        heading,
        elsewhere: None,
        seat: None,
        sway: Default::default(),
        touches: Vec::new(),
    }
}

/// A heading through the ends of turns, without stops between turns of one direction.
fn steady(keys: Vec<Key>) -> Track {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for pair in keys.chunks(2) {
        for k in pair {
            if let Some(last) = points.last()
                && k.t <= last.0 + 1e-3
            {
                continue;
            }
            points.push((k.t, k.value));
        }
    }
    // Drop the inner way points of equal value that lie close together: they would stop the turn.
    let mut thin: Vec<(f64, f64)> = Vec::new();
    for (i, p) in points.iter().enumerate() {
        let close = thin
            .last()
            .is_some_and(|q: &(f64, f64)| p.0 - q.0 < 0.3 && (p.1 - q.1).abs() < 1e-9);
        if close && i + 1 < points.len() && i > 1 {
            continue;
        }
        thin.push(*p);
    }
    Track::through(&thin)
}

/// Places and times of the footfalls of a walk.
pub struct Walk {
    pub steps: usize,
    /// Length of a full step, m, and time from touch-down to touch-down, s.
    pub length: f64,
    pub time: f64,
    /// Share of the step time in double support.
    pub double: f64,
    /// Half the width between the ankles, m.
    pub half: f64,
    /// Turn per m of way, rad.
    pub curve: f64,
    /// Quiet standing before the first step, s.
    pub before: f64,
    /// Pause after this many steps with feet beside each other, and its length, s.
    pub pause: Option<(usize, f64)>,
}

impl Walk {
    /// The steps: shorter ones first and last, a last one that closes.
    pub fn steps(&self, first: usize) -> Vec<Step> {
        let mut out = Vec::new();
        let mut way = 0.0;
        let swing = self.time * (1.0 - self.double);
        let mut on = self.before + swing;
        for k in 0..self.steps {
            let side = (first + k) % 2;
            let last = k + 1 == self.steps;
            let halts = last || self.pause.is_some_and(|(n, _)| k + 1 == n);
            if k > 0 {
                on += self.time;
                if let Some((n, pause)) = self.pause
                    && k == n
                {
                    on += pause;
                }
            }
            // Into the walk and out of it by shorter steps.
            let to_halt = self
                .pause
                .filter(|(n, _)| k < *n)
                .map_or(self.steps, |(n, _)| n)
                - 1
                - k;
            let from_start = self
                .pause
                .filter(|(n, _)| k >= *n)
                .map_or(k, |(n, _)| k - n);
            let ahead = if halts {
                0.0
            } else {
                [0.62f64, 0.94, 1.0][from_start.min(2)].min([0.0, 0.60, 0.86, 1.0][to_halt.min(3)])
            };
            let stride = ahead;
            way += ahead * self.length;
            // On an arc of constant curvature the way is the length of the middle line.
            let angle = self.curve * way;
            let (sin, cos) = trig::sin_cos(angle);
            let (cx, cy) = if self.curve.abs() < 1e-9 {
                (way, 0.0)
            } else {
                (sin / self.curve, (1.0 - cos) / self.curve)
            };
            let w = sign(side) * self.half;
            out.push(Step {
                side,
                x: cx - sin * w,
                y: cy + cos * w,
                yaw: angle + sign(side) * 6.0 * DEG,
                off: on - swing,
                on,
                stride,
            });
        }
        out
    }
}
