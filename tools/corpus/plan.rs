//! Turns footholds, a pelvis height and the angles of trunk and arms into a whole motion.
//!
//! The centre of mass follows the cart-table equation of the linear inverted pendulum with the height of the motion: `λ
//! (c − p) − z c̈ = L̇`, with `λ = g + z̈`, the planned zero-moment point `p` and the rate of the angular momentum `L`
//! about the centre of mass. In flight λ is 0 and the path is ballistic by itself. `L̇` comes from the previous pass; a
//! few passes suffice. The pelvis is then placed such that the mass table gives this centre of mass, with both feet on
//! their footholds.

use super::actor::{Actor, FootPose, MASS_SHARE, Pose, Upper, pelvis_turn, sign};
use super::tracks::{Key, Sampled, Track, bump, ease, mix, ramp, rest, v3};
use sinew_physics::math::{Vec3, trig};

/// Gravity, m/s².
pub const GRAVITY: f64 = 9.81;
/// Grid on which the centre of mass is solved, s.
const STEP: f64 = 1.0 / 120.0;
/// Height over the floor that a foot in the air keeps in the middle of its swing, m.
const CLEARANCE: f64 = 0.015;
/// Longest distance of hip and ankle, share of the leg: knees are not stretched further.
const LONGEST: f64 = 0.995;
/// Passes over the whole motion.
const PASSES: usize = 9;

/// A foot on the floor from touch-down to lift-off.
#[derive(Clone, Debug)]
pub struct Stance {
    pub from: f64,
    pub until: f64,
    /// Point of the floor under the ankle while the foot is flat, and its direction.
    pub x: f64,
    pub y: f64,
    pub yaw: f64,
    /// Pitch at touch-down (toes up positive: heel first) and time until the sole is flat, s after touch-down.
    pub strike: (f64, f64),
    /// Pitch at lift-off (negative: over the toes) and the time before lift-off over which it grows, s.
    pub off: (f64, f64),
    /// Zero-moment point at touch-down and at lift-off, ahead of the ankle; in long stances it rests in between.
    pub roll: (f64, f64),
}

/// Resting zero-moment point under a standing foot, ahead of the ankle, for the adult actor.
pub const MID_FOOT: f64 = 0.042;

/// A way point of a foot in the air.
#[derive(Clone, Copy, Debug)]
pub struct Via {
    pub t: f64,
    /// Ankle over the floor point (x, y) and its height over the height when flat.
    pub at: Vec3,
    pub pitch: f64,
}

/// Motion of one foot.
#[derive(Clone, Debug, Default)]
pub struct FootPlan {
    pub stances: Vec<Stance>,
    /// Least extra height of the ankle in the middle of each swing.
    pub lift: f64,
    /// Way points inside swings, in order of time.
    pub via: Vec<Via>,
}

/// The least of three heights, rounded off within 2 cm where two are nearly equal (so that speeds stay continuous).
fn smoothly_lowest(heights: [f64; 3]) -> f64 {
    const ROUND: f64 = 0.02;
    heights
        .into_iter()
        .reduce(|a, b| {
            let h = (ROUND - (a - b).abs()).max(0.0) / ROUND;
            a.min(b) - 0.25 * ROUND * h * h
        })
        .unwrap_or(0.0)
}

impl FootPlan {
    fn in_stance(&self, actor: &Actor, s: &Stance, t: f64) -> FootPose {
        let mut pitch = 0.0;
        if s.strike.1 > 0.0 {
            pitch += s.strike.0 * (1.0 - ramp(t, s.from - 0.35 * s.strike.1, s.from + s.strike.1))
                / (1.0 - ramp(s.from, s.from - 0.35 * s.strike.1, s.from + s.strike.1));
        }
        if s.off.1 > 0.0 {
            let u = ((t - (s.until - s.off.1)) / s.off.1).clamp(0.0, 1.0);
            pitch += s.off.0 * u * u * u * (2.0 - u);
        }
        let toe = (-pitch).max(0.0);
        let forward = v3(trig::sin_cos(s.yaw).1, trig::sin_cos(s.yaw).0, 0.0);
        let turned = super::actor::foot_turn(s.yaw, pitch);
        let floor = v3(s.x, s.y, 0.0);
        // Pivot: back of the heel with toes up, the toe joint with the heel up.
        let (on_floor, in_foot) = if pitch >= 0.0 {
            (
                floor - forward * actor.heel,
                v3(-actor.heel, 0.0, -actor.ankle),
            )
        } else {
            (
                floor + forward * actor.ball + v3(0.0, 0.0, actor.ball_height),
                v3(actor.ball, 0.0, actor.ball_height - actor.ankle),
            )
        };
        FootPose {
            ankle: on_floor - turned.rotate(in_foot),
            yaw: s.yaw,
            pitch,
            toe,
        }
    }

    /// Stance that holds at `t`, if any.
    pub fn stance(&self, t: f64) -> Option<&Stance> {
        self.stances.iter().find(|s| t >= s.from && t <= s.until)
    }

    /// Pose of the foot at `t`.
    pub fn at(&self, actor: &Actor, t: f64) -> FootPose {
        if let Some(s) = self.stance(t) {
            return self.in_stance(actor, s, t);
        }
        let i = self.stances.partition_point(|s| s.until < t);
        if i == 0 {
            return self.in_stance(actor, &self.stances[0], self.stances[0].from);
        }
        if i == self.stances.len() {
            let last = &self.stances[i - 1];
            return self.in_stance(actor, last, last.until);
        }
        let (a, b) = (&self.stances[i - 1], &self.stances[i]);
        let e = 1e-4;
        let (p0, p1) = (
            self.in_stance(actor, a, a.until - e),
            self.in_stance(actor, a, a.until),
        );
        let (q0, q1) = (
            self.in_stance(actor, b, b.from),
            self.in_stance(actor, b, b.from + e),
        );
        let rate = |x: f64, y: f64| (y - x) / e;
        let via: Vec<&Via> = self
            .via
            .iter()
            .filter(|v| v.t > a.until && v.t < b.from)
            .collect();
        let curve = |first: (f64, f64), last: (f64, f64), middle: &dyn Fn(&Via) -> f64| {
            let mut times = vec![a.until];
            let mut values = vec![first.1];
            for v in &via {
                times.push(v.t);
                values.push(middle(v));
            }
            times.push(b.from);
            values.push(last.0);
            let n = times.len();
            let keys = (0..n)
                .map(|k| Key {
                    rate: if k == 0 {
                        rate(first.0, first.1)
                    } else if k + 1 == n {
                        rate(last.0, last.1)
                    } else {
                        (values[k + 1] - values[k - 1]) / (times[k + 1] - times[k - 1])
                    },
                    ..rest(times[k], values[k])
                })
                .collect();
            Track::new(keys).at(t)
        };
        let lift = if via.is_empty() {
            self.lift * bump(t, a.until, b.from)
        } else {
            0.0
        };
        let x = curve((p0.ankle.x, p1.ankle.x), (q0.ankle.x, q1.ankle.x), &|v| {
            v.at.x
        });
        let y = curve((p0.ankle.y, p1.ankle.y), (q0.ankle.y, q1.ankle.y), &|v| {
            v.at.y
        });
        let z = curve((p0.ankle.z, p1.ankle.z), (q0.ankle.z, q1.ankle.z), &|v| {
            v.at.z + actor.ankle
        });
        let pitch = curve((p0.pitch, p1.pitch), (q0.pitch, q1.pitch), &|v| v.pitch);
        let u = (t - a.until) / (b.from - a.until);
        let mut foot = FootPose {
            ankle: v3(x, y, z + lift),
            yaw: mix(a.yaw, b.yaw, ease(u)),
            pitch,
            toe: mix(p1.toe, q0.toe, ease(1.4 * u)),
        };
        // Clear of the floor: raised smoothly where heel or toes would come lower than a small margin.
        let below = CLEARANCE * bump(u, 0.0, 1.0) - smoothly_lowest(actor.points_of(&foot));
        let raise = 0.5 * (below + (below * below + 0.010 * 0.010).sqrt());
        foot.ankle.z += raise * ease((t - a.until) / 0.065) * ease((b.from - t) / 0.065);
        foot
    }

    /// Point of the zero-moment point under this foot.
    fn roll_point(&self, actor: &Actor, t: f64) -> Vec3 {
        // The present stance, or else the one nearest in time.
        let s = self.stance(t).unwrap_or_else(|| {
            self.stances
                .iter()
                .min_by(|a, b| {
                    let far = |s: &Stance| (s.from - t).max(t - s.until);
                    far(a).total_cmp(&far(b))
                })
                .expect("a foot has stances")
        });
        let k = actor.ball / 0.132;
        let mid = MID_FOOT * k;
        let third = (0.45 * (s.until - s.from)).min(0.35);
        let ahead = if s.until - s.from < 0.9 {
            mix(
                s.roll.0 * k,
                s.roll.1 * k,
                ((t - s.from) / (s.until - s.from)).clamp(0.0, 1.0),
            )
        } else {
            mid + (s.roll.0 * k - mid) * (1.0 - ramp(t, s.from, s.from + third))
                + (s.roll.1 * k - mid) * ramp(t, s.until - third, s.until)
        };
        let (sin, cos) = trig::sin_cos(s.yaw);
        v3(s.x + cos * ahead, s.y + sin * ahead, 0.0)
    }
}

/// The prescribed height.
pub enum Height {
    /// Height of the middle of the hips, m.
    Pelvis(Track),
    /// Height of the centre of mass, m.
    Centre(Track),
}

/// A body part other than the feet on the floor.
#[derive(Clone, Debug)]
pub struct Touch {
    pub part: &'static str,
    pub from: f64,
    pub until: f64,
}

/// Angles of trunk, head and arms at a time.
pub type Style = Box<dyn Fn(f64) -> Upper + Send + Sync>;

/// A motion as authored.
pub struct Script {
    pub name: String,
    /// stand, step, walk, turn, run, jump, floor.
    pub kind: &'static str,
    pub about: &'static str,
    pub actor: Actor,
    /// Length of the whole motion, standing to standing.
    pub length: f64,
    /// The part of it that is recorded.
    pub window: (f64, f64),
    pub feet: [FootPlan; 2],
    pub style: Style,
    pub heading: Track,
    pub height: Height,
    /// Zero-moment point along the forward axis of the world instead of under the feet, with a weight 0…1 over time.
    pub elsewhere: Option<(Track, Track)>,
    /// Pelvis place (x, y) instead of the one that the centre of mass requires, with a weight 0…1 over time.
    pub seat: Option<(Track, Track)>,
    /// Sway of the zero-moment point (x, y), m.
    pub sway: [Track; 2],
    pub touches: Vec<Touch>,
}

/// A solved motion.
pub struct Motion {
    pub script: Script,
    centre: [Sampled; 3],
    lower: Sampled,
}

/// Share of the weight that the left foot is planned to carry, per grid time.
fn left_share(feet: &[FootPlan; 2], count: usize) -> Vec<f64> {
    let down = |t: f64| [feet[0].stance(t).is_some(), feet[1].stance(t).is_some()];
    let at = |i: usize| down(i as f64 * STEP);
    let mut runs: Vec<([bool; 2], usize, usize)> = Vec::new();
    for i in 0..count {
        match runs.last_mut() {
            Some((d, _, end)) if *d == at(i) => *end = i + 1,
            _ => runs.push((at(i), i, i + 1)),
        }
    }
    // Shares before and after each double support, when one foot stands alone.
    let single = |d: [bool; 2]| match d {
        [true, false] => Some(1.0),
        [false, true] => Some(0.0),
        _ => None,
    };
    let mut out = vec![0.5; count];
    for (k, &(d, start, end)) in runs.iter().enumerate() {
        if let Some(w) = single(d) {
            out[start..end].fill(w);
            continue;
        }
        if d == [false, false] {
            let before = (0..k)
                .rev()
                .find_map(|j| single(runs[j].0).or((runs[j].0 == [true, true]).then_some(0.5)));
            out[start..end].fill(before.unwrap_or(0.5));
            continue;
        }
        let before = k
            .checked_sub(1)
            .and_then(|j| single(runs[j].0))
            .unwrap_or(0.5);
        let after = runs.get(k + 1).and_then(|r| single(r.0)).unwrap_or(0.5);
        let (first, last) = (
            k == 0 || runs[k - 1].0 == [false; 2],
            k + 1 == runs.len() || runs[k + 1].0 == [false; 2],
        );
        let (t0, t1) = (start as f64 * STEP, end as f64 * STEP);
        for i in start..end {
            let t = i as f64 * STEP;
            let long = t1 - t0 > 0.9 || first || last;
            out[i] = if long {
                let shift = (0.5 * (t1 - t0)).min(0.5);
                let leave = if first { 1.0 } else { ramp(t, t0, t0 + shift) };
                let come = if last { 0.0 } else { ramp(t, t1 - shift, t1) };
                mix(mix(before, 0.5, leave), after, come)
            } else {
                mix(before, after, ramp(t, t0, t1))
            };
        }
    }
    out
}

/// Solves `λ (c − p) − z c̈ = m` with c = p at both ends (tridiagonal, without pivoting: λ, z ≥ 0 make it diagonally
/// dominant).
fn cart_table(lambda: &[f64], z: &[f64], p: &[f64], moment: &[f64]) -> Vec<f64> {
    let n = p.len();
    let (mut c, mut d) = (vec![0.0; n], vec![0.0; n]);
    d[0] = p[0];
    for i in 1..n {
        let (sub, diag, sup, right) = if i + 1 == n {
            (0.0, 1.0, 0.0, p[i])
        } else {
            let k = z[i] / (STEP * STEP);
            (-k, lambda[i] + 2.0 * k, -k, lambda[i] * p[i] + moment[i])
        };
        let m = diag - sub * c[i - 1];
        c[i] = sup / m;
        d[i] = (right - sub * d[i - 1]) / m;
    }
    for i in (0..n - 1).rev() {
        d[i] -= c[i] * d[i + 1];
    }
    d
}

/// Second differences, zero at the ends.
fn second(v: &[f64]) -> Vec<f64> {
    let n = v.len();
    (0..n)
        .map(|i| {
            if i == 0 || i + 1 == n {
                0.0
            } else {
                (v[i + 1] - 2.0 * v[i] + v[i - 1]) / (STEP * STEP)
            }
        })
        .collect()
}

/// Moving average with a triangular window of `half` samples to each side, twice.
fn smooth(v: &[f64], half: isize) -> Vec<f64> {
    let n = v.len() as isize;
    let mut out = v.to_vec();
    for _ in 0..2 {
        let from = out.clone();
        for i in 0..n {
            let (mut sum, mut weight) = (0.0, 0.0);
            for k in -half..=half {
                let w = (half + 1 - k.abs()) as f64;
                sum += w * from[(i + k).clamp(0, n - 1) as usize];
                weight += w;
            }
            out[i as usize] = sum / weight;
        }
    }
    out
}

impl Script {
    /// Both feet at `t`.
    pub fn feet_at(&self, t: f64) -> [FootPose; 2] {
        [
            self.feet[0].at(&self.actor, t),
            self.feet[1].at(&self.actor, t),
        ]
    }

    /// How much lower than planned the pelvis must be for the leg on the floor (or in the air) to reach its foot, per
    /// grid time; smooth.
    fn lowered(&self, poses: &[Pose]) -> Vec<f64> {
        let longest = LONGEST * self.actor.leg();
        let need: Vec<f64> = poses
            .iter()
            .enumerate()
            .map(|(i, q)| {
                let feet = self.feet_at(i as f64 * STEP);
                let mut most = 0.0f64;
                for side in 0..2 {
                    let hip = q.place[super::actor::LEG[side]];
                    let d = feet[side].ankle - hip;
                    let across = d.x * d.x + d.y * d.y;
                    let high = (longest * longest - across).max(0.0).sqrt();
                    most = most.max(-d.z - high);
                }
                most
            })
            .collect();
        // The largest need within a twelfth of a second, then smooth: never less than needed.
        let n = need.len();
        let wide: Vec<f64> = (0..n)
            .map(|i| {
                need[i.saturating_sub(11)..(i + 12).min(n)]
                    .iter()
                    .copied()
                    .fold(0.0, f64::max)
            })
            .collect();
        smooth(&wide, 5)
    }

    /// The pose whose centre of mass lies over `aim` (x, y) and, where the height is that of the centre of mass, at
    /// its height.
    fn pose_over(&self, t: f64, aim: Vec3, guess: Vec3, lower: f64) -> Pose {
        let actor = &self.actor;
        let upper = (self.style)(t);
        let pelvis = pelvis_turn(self.heading.at(t), &upper);
        let feet = self.feet_at(t);
        let mut middle = guess;
        let by_centre = matches!(self.height, Height::Centre(_));
        if let Height::Pelvis(track) = &self.height {
            middle.z = track.at(t) - lower;
        }
        let mut pose = actor.pose(middle, pelvis, &upper, feet);
        for _ in 0..40 {
            let off = aim - actor.centre(&pose);
            if off.x.abs() < 1e-9 && off.y.abs() < 1e-9 && (!by_centre || off.z.abs() < 1e-9) {
                break;
            }
            middle.x += off.x;
            middle.y += off.y;
            if by_centre {
                middle.z += off.z;
            }
            pose = actor.pose(middle, pelvis, &upper, feet);
        }
        if let Some((place, weight)) = &self.seat {
            let w = weight.at(t);
            if w > 0.0 {
                middle.x = mix(middle.x, place.at(t), w);
                pose = actor.pose(middle, pelvis, &upper, feet);
            }
        }
        pose
    }

    /// The planned zero-moment point on the grid.
    fn planned(&self, count: usize) -> Vec<Vec3> {
        let share = left_share(&self.feet, count);
        (0..count)
            .map(|i| {
                let t = i as f64 * STEP;
                let [l, r] = [0, 1].map(|s| self.feet[s].roll_point(&self.actor, t));
                let mut p = r + (l - r) * share[i];
                p.x += self.sway[0].at(t);
                p.y += self.sway[1].at(t);
                if let Some((place, weight)) = &self.elsewhere {
                    p.x = mix(p.x, place.at(t), weight.at(t));
                }
                p
            })
            .collect()
    }

    /// Solves the motion.
    pub fn solve(self) -> Motion {
        let count = (self.length / STEP).round() as usize + 1;
        let plan = self.planned(count);
        let column = |k: usize| -> Vec<f64> { plan.iter().map(|p| p.to_array()[k]).collect() };
        let p = [column(0), column(1)];
        let mut c: [Vec<f64>; 3] = [p[0].clone(), p[1].clone(), vec![0.0; count]];
        let mut moment = [vec![0.0; count], vec![0.0; count]];
        let standing = self.actor.ankle + self.actor.leg();
        let mut z: Vec<f64> = vec![1.1 * standing; count];
        if let Height::Centre(track) = &self.height {
            z = (0..count).map(|i| track.at(i as f64 * STEP)).collect();
        }
        let mut lower = vec![0.0; count];
        for pass in 0..PASSES {
            let rise = second(&z);
            let lambda: Vec<f64> = rise
                .iter()
                .map(|a| {
                    let l = GRAVITY + a;
                    if l < 0.02 * GRAVITY { 0.0 } else { l }
                })
                .collect();
            if pass > 0 {
                for k in 0..2 {
                    c[k] = cart_table(&lambda, &z, &p[k], &moment[k]);
                }
            }
            let mut guess = v3(p[0][0], p[1][0], 0.9 * standing);
            let mut poses: Vec<Pose> = Vec::with_capacity(count);
            for i in 0..count {
                let pose =
                    self.pose_over(i as f64 * STEP, v3(c[0][i], c[1][i], z[i]), guess, lower[i]);
                guess = pose.place[0];
                poses.push(pose);
            }
            if let Height::Pelvis(_) = self.height {
                if pass > 0 && pass + 1 < PASSES {
                    for (low, more) in lower.iter_mut().zip(self.lowered(&poses)) {
                        *low += more;
                    }
                }
                z = poses.iter().map(|q| self.actor.centre(q).z).collect();
            }
            let l = self.momentum(&poses);
            for i in 0..count {
                let load = (lambda[i] / (0.5 * GRAVITY)).min(1.0);
                let rate = |k: usize| {
                    if i == 0 || i + 1 == count {
                        0.0
                    } else {
                        (l[i + 1].to_array()[k] - l[i - 1].to_array()[k]) / (2.0 * STEP)
                    }
                };
                moment[0][i] = rate(1) * load;
                moment[1][i] = -rate(0) * load;
            }
            for m in &mut moment {
                *m = smooth(m, 2);
            }
        }
        c[2] = z;
        let centre = c.map(|values| Sampled { step: STEP, values });
        Motion {
            script: self,
            centre,
            lower: Sampled {
                step: STEP,
                values: lower,
            },
        }
    }

    /// Angular momentum about the centre of mass per unit of body mass, m²/s: segments as points with rod-like inertia.
    fn momentum(&self, poses: &[Pose]) -> Vec<Vec3> {
        let n = poses.len();
        let centres: Vec<[Vec3; 18]> = poses.iter().map(|q| self.actor.centres(q)).collect();
        let whole: Vec<Vec3> = poses.iter().map(|q| self.actor.centre(q)).collect();
        (0..n)
            .map(|i| {
                let (a, b) = (i.saturating_sub(1), (i + 1).min(n - 1));
                let dt = (b - a) as f64 * STEP;
                let mut sum = Vec3::zero();
                for s in 0..18 {
                    let v = ((centres[b][s] - whole[b]) - (centres[a][s] - whole[a])) * (1.0 / dt);
                    sum += (centres[i][s] - whole[i]).cross(v) * MASS_SHARE[s];
                    // Spin: about transverse axes with a radius of gyration of 0.3 segment lengths.
                    let w = (poses[b].turn[s] * poses[a].turn[s].conjugate()).log() * (1.0 / dt);
                    let radius = 0.3 * self.segment_length(s);
                    sum += w * (MASS_SHARE[s] * radius * radius);
                }
                sum
            })
            .collect()
    }

    fn segment_length(&self, s: usize) -> f64 {
        let a = &self.actor;
        match s {
            0 => 0.25,
            1 => a.thorax.norm() + 0.05,
            2 => a.neck.norm() + 0.05,
            3 => 0.26,
            4 | 7 => a.upper_arm,
            5 | 8 => a.forearm,
            6 | 9 => a.hand,
            10 | 14 => a.thigh,
            11 | 15 => a.shank,
            _ => 0.2,
        }
    }
}

impl Motion {
    /// Pose at `t` s of the script.
    pub fn pose(&self, t: f64) -> Pose {
        let aim = v3(
            self.centre[0].at(t),
            self.centre[1].at(t),
            self.centre[2].at(t),
        );
        let guess = v3(aim.x, aim.y, 0.9 * aim.z);
        self.script.pose_over(t, aim, guess, self.lower.at(t))
    }

    /// Length of the recorded part, s.
    pub fn duration(&self) -> f64 {
        self.script.window.1 - self.script.window.0
    }

    /// Pose at `t` s of the recording.
    pub fn recorded(&self, t: f64) -> Pose {
        self.pose(self.script.window.0 + t)
    }
}

/// A stance on a flat foot without heel strike or push-off.
pub fn flat(from: f64, until: f64, x: f64, y: f64, yaw: f64) -> Stance {
    Stance {
        from,
        until,
        x,
        y,
        yaw,
        strike: (0.0, 0.0),
        off: (0.0, 0.0),
        roll: (MID_FOOT, MID_FOOT),
    }
}

/// Both feet standing for the whole time, `half` m from the middle line, toes turned out by `out` rad.
pub fn standing_feet(length: f64, half: f64, out: f64) -> [FootPlan; 2] {
    [0, 1].map(|side| FootPlan {
        stances: vec![flat(
            -1.0,
            length + 1.0,
            0.0,
            sign(side) * half,
            sign(side) * out,
        )],
        lift: 0.0,
        via: Vec::new(),
    })
}
