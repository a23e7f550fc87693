//! Planted feet that do not slide, and swinging feet that clear the floor.
//!
//! Each stance gets one anchor (place and heading); the whole pose of the foot follows from the anchor and the pitch: flat, rolled up
//! about the heel edge, or heel up about the toe joint with flat toes. Between stances the foot follows the recording plus an offset
//! that fades from the one lock and grows into the next with continuous velocity and acceleration, raised where it would scrape.

use super::contacts::runs;
use super::filter::low_pass;
use crate::sim::body::Body;
use crate::sim::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::sim::math::{Quat, Vec3};

/// Pose of one foot: ankle position, `world_from_foot`, toe extension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootPose {
    /// Ankle, m.
    pub ankle: Vec3,
    /// `world_from_foot`.
    pub rotation: Quat,
    /// Toe extension, rad.
    pub toe: f64,
}

/// The sole of one foot of a body.
#[derive(Clone, Debug)]
pub struct Sole {
    foot: Vec<Vec3>,
    toes: Vec<Vec3>,
    toe_joint: Vec3,
    heel: Vec3,
    /// Height of the ankle over the floor when the foot is flat, m.
    pub ankle_height: f64,
    toe_range: (f64, f64),
}

/// One stance of one foot: its place and its heading stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// First sample.
    pub start: usize,
    /// One past the last sample.
    pub end: usize,
}

/// Where a planted foot stands in one sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Anchor {
    /// Point of the floor under the flat ankle, m (z = 0).
    pub place: Vec3,
    /// Heading of the foot, rad.
    pub yaw: f64,
    /// Pitch, rad, toe-up positive.
    pub pitch: f64,
}

impl Anchor {
    /// Direction in which the foot points, x and y.
    pub(super) fn ahead(&self) -> [f64; 2] {
        let x = Quat::exp(Vec3::Z * self.yaw).rotate(Vec3::X);
        [x.x, x.y]
    }
}

/// A foot that stands as the body's sole allows, and how much was changed for that.
#[derive(Clone, Debug)]
pub struct LockedFoot {
    /// Pose per sample.
    pub poses: Vec<FootPose>,
    /// True where the foot is locked to the floor.
    pub planted: Vec<bool>,
    /// Where it stands, per sample; zero elsewhere.
    pub anchors: Vec<Anchor>,
    /// How far the recorded foot point strayed in stance, m: largest distance between any sample and the anchor.
    pub slide_before: f64,
}

/// Pitch below which a walking foot counts as flat, rad (4°).
const DEAD_BAND: f64 = 0.07;
/// The same for a foot that stands for long, rad (9°): a standing person's soles are flat unless clearly raised.
const DEAD_BAND_LONG: f64 = 0.16;
/// A foot pitched by less than this is flat at that moment, rad.
const FLAT: f64 = 0.12;
/// Stances longer than this are standing, not walking, s.
const LONG_STANCE: f64 = 1.5;
/// A recorded foot that strays further than this from its anchor has stepped or pivoted, m and rad.
const STRAY: (f64, f64) = (0.06, 0.40);
/// Half of the time that a shuffle is given, s: the first of these that fits.
const HALF_SHUFFLE: [f64; 3] = [0.14, 0.11, 0.08];
/// Least way of a shuffle, in units of [`STRAY`].
const SHUFFLES: f64 = 0.25;
/// A foot that drags on after the other one has landed stands for so long beside it, s: nobody changes feet in no time.
const DRAGS: f64 = 0.04;
/// In so much of a stance at each end, one part in so many and at most so long, s, a foot may be astray without having stepped or pivoted; where
/// it is then, it is further from its anchor than the first, in units of [`STRAY`], and everywhere else nearer than the second.
const EDGE: (usize, f64) = (8, 0.15);
const ASTRAY: f64 = 0.4;
const STEADY: f64 = 0.6;
/// Shortest stance that is made by taking samples from another, s.
const SHORTEST_STANCE: f64 = 0.15;
/// A swing takes at least √(way over this), m/s², where the way counts a turn by a radian as the second, m. That is what recorded steps of people
/// take, with few exceptions, whether they walk, dance or shuffle; a leg is on time with it, and would be late and short by a third at twice as much.
const HASTE: f64 = 8.0;
const TURN_ARM: f64 = 0.25;
/// A foot steeper or more rolled than this does not stand on its sole, rad.
const STEEPEST: (f64, f64, f64) = (-1.05, 0.6, 0.6);
/// A swinging sole passes at least this high, m, for a step of normal length.
const CLEARANCE: f64 = 0.045;
/// How fast a sole rises after lift-off and sinks before touch-down at least, m/s.
const RISE: (f64, f64) = (0.45, 0.4);
/// Longest time over which a swing departs from a lock, s.
const FADE: f64 = 0.3;
/// Largest toe extension of a swinging foot, rad.
const SWING_TOE: f64 = 0.6;

impl Sole {
    /// Sole of the left (`side` 0) or right (1) foot.
    pub fn new(body: &Body, side: usize) -> Self {
        let (f, t) = [(L_FOOT, L_TOES), (R_FOOT, R_TOES)][side];
        let foot = body.segment(f).contact_points.clone();
        let toes = body.segment(t).contact_points.clone();
        let toe_joint = body.joint_offset[t.index()];
        let low = foot.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        let toe_low = toes
            .iter()
            .map(|p| p.z + toe_joint.z)
            .fold(f64::INFINITY, f64::min);
        let height = -low.min(toe_low);
        let ankle_height = if height.is_finite() { height } else { 0.0 };
        let back = foot.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
        let heel = Vec3 {
            x: if back.is_finite() { back } else { 0.0 },
            y: 0.0,
            z: -ankle_height,
        };
        let dof = crate::sim::body::topology::DOF_START[t.index()];
        Self {
            foot,
            toes,
            toe_joint,
            heel,
            ankle_height,
            toe_range: (body.lower[dof], body.upper[dof]),
        }
    }

    /// Contact points of the foot, foot frame, m.
    pub fn foot_points(&self) -> &[Vec3] {
        &self.foot
    }

    /// Contact points of the toes, toe frame, m.
    pub fn toe_points(&self) -> &[Vec3] {
        &self.toes
    }

    /// Contact points of the foot and of the toes in the foot frame, toes extended by `toe` rad.
    pub fn points(&self, toe: f64) -> impl Iterator<Item = Vec3> + '_ {
        let foot_from_toes = Quat::exp(Vec3::Y * -toe);
        self.foot.iter().copied().chain(
            self.toes
                .iter()
                .map(move |p| self.toe_joint + foot_from_toes.rotate(*p)),
        )
    }

    /// Height of the lowest point of the sole relative to the ankle, m.
    pub fn lowest(&self, rotation: Quat, toe: f64) -> f64 {
        self.points(toe)
            .map(|p| rotation.rotate(p).z)
            .fold(0.0, f64::min)
    }

    /// Toe angle that keeps the toes flat on the floor with the foot pitched by `pitch` rad (toe-up positive).
    fn flat_toe(&self, pitch: f64) -> f64 {
        (-pitch).clamp(self.toe_range.0.max(0.0), self.toe_range.1.max(0.0))
    }

    /// Largest distance between where a foot is and where it should be, over ankle, heel edge and toe joint, m.
    pub fn stray(&self, is: (Vec3, Quat), should: &FootPose) -> f64 {
        [Vec3::zero(), self.heel, self.toe_joint]
            .into_iter()
            .map(|p| (is.0 + is.1.rotate(p) - should.ankle - should.rotation.rotate(p)).norm())
            .fold(0.0, f64::max)
    }

    /// Pose of a foot that stands at `anchor` with heading `yaw`, pitched about heel edge (toe-up) or toe joint (heel-up).
    pub fn stand(&self, anchor: Vec3, yaw: f64, pitch: f64) -> FootPose {
        let pitched = Quat::exp(Vec3::Y * -pitch);
        let toe = self.flat_toe(pitch);
        let pivot = if pitch >= 0.0 {
            self.heel
        } else {
            self.toe_joint
        };
        let mut ankle = pivot - pitched.rotate(pivot);
        ankle.z = -self.lowest(pitched, toe);
        let heading = Quat::exp(Vec3::Z * yaw);
        FootPose {
            ankle: anchor + heading.rotate(ankle),
            rotation: (heading * pitched).normalized(),
            toe,
        }
    }

    /// Middle of the front edge of the toes, toe frame, m.
    pub fn toe_tip(&self) -> Vec3 {
        let front = self.toes.iter().map(|p| p.x).fold(0.0, f64::max);
        let low = self.toes.iter().map(|p| p.z).fold(0.0, f64::min);
        Vec3 {
            x: front,
            y: 0.0,
            z: low,
        }
    }

    /// Heights of ankle, toe joint and toe tip of a foot that stands flat, m.
    pub fn standing_heights(&self) -> [f64; 3] {
        let joint = self.ankle_height + self.toe_joint.z;
        [self.ankle_height, joint, joint + self.toe_tip().z]
    }

    /// Visits the floor polygon corners (x, y) that carry a foot standing at `at`: heel while not heel-up, toes while not toe-up.
    pub fn each_corner(&self, at: &Anchor, mut visit: impl FnMut([f64; 2])) {
        let Anchor {
            place: anchor,
            yaw,
            pitch,
        } = *at;
        let heading = Quat::exp(Vec3::Z * yaw);
        let ball = self.toe_joint.x;
        let mut push = |p: Vec3| {
            let w = anchor + heading.rotate(p);
            visit([w.x, w.y]);
        };
        for p in &self.foot {
            let front = p.x > 0.5 * ball;
            if (pitch > -0.02 || front) && (pitch < 0.02 || !front) {
                push(*p);
            }
        }
        if pitch < 0.02 {
            for p in &self.toes {
                push(self.toe_joint + *p);
            }
        }
    }

    /// Adds the corners of [`Self::each_corner`].
    pub fn footprint(&self, at: &Anchor, out: &mut Vec<[f64; 2]>) {
        self.each_corner(at, |p| out.push(p));
    }
}

/// Heading and pitch of a foot, rad: `world_from_foot` without roll.
pub fn yaw_pitch(rotation: Quat) -> (f64, f64) {
    let x = rotation.rotate(Vec3::X);
    (x.y.atan2(x.x), x.z.clamp(-1.0, 1.0).asin())
}

/// Difference of two headings in −π…π, rad.
pub fn turn(from: f64, to: f64) -> f64 {
    (to - from).sin().atan2((to - from).cos())
}

fn median(mut v: Vec<f64>) -> f64 {
    v.sort_by(f64::total_cmp);
    v.get(v.len() / 2).copied().unwrap_or(0.0)
}

/// Foot point and heading per sample: where the flat ankle would stand on the floor.
struct Track {
    point: Vec<Vec3>,
    yaw: Vec<f64>,
    pitch: Vec<f64>,
    roll: Vec<f64>,
}

impl Track {
    fn new(sole: &Sole, ankles: &[Vec3], rotations: &[Quat]) -> Self {
        let n = ankles.len();
        let mut t = Self {
            point: Vec::with_capacity(n),
            yaw: Vec::with_capacity(n),
            pitch: Vec::with_capacity(n),
            roll: Vec::with_capacity(n),
        };
        for (a, q) in ankles.iter().zip(rotations) {
            let (yaw, pitch) = yaw_pitch(*q);
            let before = t.yaw.last().copied().unwrap_or(yaw);
            t.yaw.push(before + turn(before, yaw));
            t.pitch.push(pitch);
            t.roll.push(q.rotate(Vec3::Y).z.clamp(-1.0, 1.0).asin());
            let lift = sole.stand(Vec3::zero(), yaw, pitch).ankle;
            t.point.push(Vec3 {
                x: a.x - lift.x,
                y: a.y - lift.y,
                z: 0.0,
            });
        }
        t
    }

    /// Median place and heading over the middle 70 % of a stance.
    fn anchor(&self, start: usize, end: usize) -> (Vec3, f64) {
        let margin = (end - start) * 15 / 100;
        let mid = start + margin..(end - margin).max(start + margin + 1);
        let of = |f: &dyn Fn(usize) -> f64| median(mid.clone().map(f).collect());
        (
            Vec3 {
                x: of(&|i| self.point[i].x),
                y: of(&|i| self.point[i].y),
                z: 0.0,
            },
            of(&|i| self.yaw[i]),
        )
    }

    /// Distance of a sample from an anchor in units of [`STRAY`].
    fn stray(&self, i: usize, anchor: Vec3, yaw: f64) -> f64 {
        ((self.point[i] - anchor).norm() / STRAY.0).max((self.yaw[i] - yaw).abs() / STRAY.1)
    }

    /// Splits a stance in which the foot visibly shuffles or pivots into stances joined by short steps, or begins it after, or ends it before it
    /// does, while the `other` foot is on the floor: a foot that shuffles alone stays.
    fn split(&self, (start, end): (usize, usize), other: &[bool], rate_hz: f64, out: &mut Pieces) {
        let shortest = (SHORTEST_STANCE * rate_hz) as usize;
        let (anchor, yaw) = self.anchor(start, end);
        let inner = start + (end - start) / 12..end - (end - start) / 12;
        let worst = inner
            .clone()
            .map(|i| self.stray(i, anchor, yaw))
            .fold(0.0, f64::max);
        if worst <= 1.0 {
            out.push((start, end));
            return;
        }
        let moved = |a: usize, b: usize| {
            ((self.point[b] - self.point[a]).norm() / STRAY.0)
                .max((self.yaw[b] - self.yaw[a]).abs() / STRAY.1)
        };
        // Where the foot moves fastest over one shuffle's time.
        for half in HALF_SHUFFLE {
            let half = (half * rate_hz) as usize;
            let at = (start + shortest + half..end.saturating_sub(half + shortest))
                .filter(|i| other[i - half..=i + half].iter().all(|o| *o))
                .map(|i| (i, moved(i - half, i + half)))
                .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
            if let Some((i, _)) = at.filter(|(_, far)| *far > SHUFFLES) {
                self.split((start, i - half), other, rate_hz, out);
                self.split((i + half, end), other, rate_hz, out);
                return;
            }
        }
        // A foot that drags on after the other has landed is lifted there; one that slides on while the other still stands comes down later.
        let alone_until = (start..end)
            .rev()
            .find(|i| !other[*i])
            .map_or(start, |i| i + 1);
        let alone_from = (start..end).find(|i| !other[*i]).unwrap_or(end);
        let least = shortest.max((end - start) / 3).max(1);
        let drags = (DRAGS * rate_hz) as usize;
        let tail = (alone_until + drags).max(start + least);
        let head = alone_from.min(end.saturating_sub(least));
        if tail < end && moved(tail, end - 1) > SHUFFLES {
            self.split((start, tail), other, rate_hz, out);
        } else if head > start && moved(start, head) > SHUFFLES {
            self.split((head, end), other, rate_hz, out);
        } else {
            out.push((start, end));
        }
    }
}

impl Track {
    /// Takes from the ends of a stance what only there is astray, while the other foot stands too: a foot that begins to turn away, or that is
    /// still coming, does not stand, and what stands does not pivot because of it.
    fn trim(&self, (start, end): (usize, usize), other: &[bool], rate_hz: f64) -> (usize, usize) {
        let (anchor, yaw) = self.anchor(start, end);
        let edge = ((end - start) / EDGE.0).min((EDGE.1 * rate_hz) as usize);
        let astray = |i: usize| self.stray(i, anchor, yaw);
        let leaves = |i: &usize| other[*i] && astray(*i) > ASTRAY;
        let cut = |outermost: usize, n: usize| if astray(outermost) > 1.0 { n } else { 0 };
        // Where the recording begins or ends there is no swing that it would belong to.
        let clip = |at: usize, n: usize| if at == 0 || at == other.len() { 0 } else { n };
        let head = (start..start + edge).take_while(leaves).count();
        let tail = (end - edge..end).rev().take_while(leaves).count();
        let (head, tail) = (clip(start, head), clip(end, tail));
        let (from, to) = (start + cut(start, head), end - cut(end - 1, tail));
        if (from..to).any(|i| astray(i) > STEADY) {
            return (start, end);
        }
        (from, to)
    }
}

impl Track {
    /// Gives swings that are shorter than their way takes what they lack, of the time in which both feet are on the floor: from the stance
    /// before and from the one after, wherever the recorded foot is further from its anchor, and no more than half of what there is, since the
    /// other foot may need some as well. Labels see the fastest part of a low step only.
    fn unhurry(&self, pieces: &mut [(usize, usize)], other: &[bool], rate_hz: f64) {
        let shortest = (SHORTEST_STANCE * rate_hz) as usize;
        let anchors: Vec<_> = pieces.iter().map(|&(i, j)| self.anchor(i, j)).collect();
        for w in 1..pieces.len() {
            let ((from, yaw_from), (to, yaw_to)) = (anchors[w - 1], anchors[w]);
            let way = (to - from).norm() + TURN_ARM * (yaw_to - yaw_from).abs();
            let needed = ((way / HASTE).sqrt() * rate_hz).ceil() as usize;
            let ((start, mut end), (mut begin, finish)) = (pieces[w - 1], pieces[w]);
            let both = |k: &usize| other[*k];
            let (first, last) = ((start + shortest).min(end), finish.saturating_sub(shortest));
            let mut before = (first..end).rev().take_while(both).count() / 2;
            let mut after = (begin..last.max(begin)).take_while(both).count() / 2;
            while begin - end < needed && before + after > 0 {
                let left = self.stray(end - 1, from, yaw_from);
                let right = self.stray(begin, to, yaw_to);
                if after == 0 || (before > 0 && left >= right) {
                    (end, before) = (end - 1, before - 1);
                } else {
                    (begin, after) = (begin + 1, after - 1);
                }
            }
            (pieces[w - 1].1, pieces[w].0) = (end, begin);
        }
    }
}

impl Track {
    /// When the foot stands where its `label` says that it is on the floor, with the `other` foot's.
    fn pieces(&self, label: &[bool], other: &[bool], rate_hz: f64) -> Pieces {
        let mut pieces = Vec::new();
        for (i, j, on) in runs(label) {
            let of = |v: &[f64]| median(v[i..j].to_vec());
            let (pitch, roll) = (of(&self.pitch), of(&self.roll));
            if on && pitch > STEEPEST.0 && pitch < STEEPEST.1 && roll.abs() < STEEPEST.2 {
                self.split((i, j), other, rate_hz, &mut pieces);
            }
        }
        pieces
    }

    /// How far the recorded foot is from where it would stand, squared and summed over its stances, in units of [`STRAY`].
    fn strays(&self, pieces: &[(usize, usize)]) -> f64 {
        let of = |&(i, j): &(usize, usize)| {
            let (anchor, yaw) = self.anchor(i, j);
            (i..j)
                .map(|k| self.stray(k, anchor, yaw).powi(2))
                .sum::<f64>()
        };
        pieces.iter().map(of).sum()
    }
}

/// A quintic that takes value, slope and curvature to zero over unit time, at `u` in 0…1.
pub(super) fn fade(value: f64, slope: f64, curvature: f64, u: f64) -> f64 {
    let v = 1.0 - u;
    let v3 = v * v * v;
    v3 * (value * (1.0 + 3.0 * u + 6.0 * u * u)
        + slope * u * (1.0 + 3.0 * u)
        + 0.5 * curvature * u * u)
}

type Channels = [f64; 7];

fn offset(locked: &FootPose, ankle: Vec3, rotation: Quat, toe: f64) -> Channels {
    let p = locked.ankle - ankle;
    let r = (locked.rotation * rotation.conjugate()).log();
    [p.x, p.y, p.z, r.x, r.y, r.z, locked.toe - toe]
}

/// When both feet stand: where their labels say so and they neither shuffle nor turn away. Which one gives way to the other first is decided by how far
/// they stand from where the recording has them.
///
/// * `ankles`, `rotations`: recorded ankle (m) and `world_from_foot` per sample, floor at z = 0, body scale.
/// * `labels`: where the feet are on the floor (from [`super::contacts`]).
/// * `rate_hz`: samples per second.
pub fn stances(
    soles: &[Sole; 2],
    ankles: [&[Vec3]; 2],
    rotations: [&[Quat]; 2],
    labels: [&[bool]; 2],
    rate_hz: f64,
) -> [Vec<Stance>; 2] {
    let tracks: [Track; 2] =
        std::array::from_fn(|s| Track::new(&soles[s], ankles[s], rotations[s]));
    let first = |first: usize| sequence(&tracks, labels, [first, 1 - first], rate_hz);
    let (left, right) = (first(0), first(1));
    let strays = |pieces: &[Pieces; 2]| tracks[0].strays(&pieces[0]) + tracks[1].strays(&pieces[1]);
    let best = if strays(&left) <= strays(&right) {
        left
    } else {
        right
    };
    best.map(|pieces| {
        let stance = |(start, end)| Stance { start, end };
        pieces.into_iter().map(stance).collect()
    })
}

/// Stances of one foot as half-open ranges of samples, in order.
type Pieces = Vec<(usize, usize)>;

/// The stances of both feet if foot `order[0]` gives way first: the other one relies on where that one really stands, not on where it is on the
/// floor. Feet that both turn on the floor would each leave the body to the other one.
fn sequence(
    tracks: &[Track; 2],
    labels: [&[bool]; 2],
    order: [usize; 2],
    rate_hz: f64,
) -> [Pieces; 2] {
    let held = |pieces: &Pieces| {
        let mut held = vec![false; labels[0].len()];
        pieces.iter().for_each(|&(i, j)| held[i..j].fill(true));
        held
    };
    let [first, second] = order;
    let mut out: [Pieces; 2] = Default::default();
    out[first] = tracks[first].pieces(labels[first], labels[second], rate_hz);
    out[second] = tracks[second].pieces(labels[second], &held(&out[first]), rate_hz);
    for s in order {
        let other = held(&out[1 - s]);
        for piece in &mut out[s] {
            *piece = tracks[s].trim(*piece, &other, rate_hz);
        }
    }
    for s in order {
        let other = held(&out[1 - s]);
        tracks[s].unhurry(&mut out[s], &other, rate_hz);
    }
    out
}

/// Locks one foot.
///
/// * `ankles`, `rotations`: recorded ankle (m) and `world_from_foot` per sample, floor at z = 0, body scale.
/// * `stances`: when it stands (from [`stances`]).
/// * `heel_up`, `toe_out`: by how much more the heel is raised and the foot turned outwards in stance than recorded, rad per sample.
/// * `side`: 0 left, 1 right.
/// * `rate_hz`: samples per second.
///
/// The result is continuous in position, velocity and acceleration up to the recording's own smoothness; a planted foot's pivot
/// (heel edge or toe joint) does not move, and no point of the sole is below the floor in stance. O(n log n) per stance.
pub fn lock_foot(
    sole: &Sole,
    ankles: &[Vec3],
    rotations: &[Quat],
    stances: &[Stance],
    (heel_up, toe_out): (&[f64], &[f64]),
    side: usize,
    rate_hz: f64,
) -> LockedFoot {
    let n = ankles.len();
    let track = Track::new(sole, ankles, rotations);
    let toes: Vec<f64> = track
        .pitch
        .iter()
        .map(|p| (-p).clamp(0.0, SWING_TOE))
        .collect();
    let mut out = LockedFoot {
        poses: (0..n)
            .map(|i| FootPose {
                ankle: ankles[i],
                rotation: rotations[i],
                toe: toes[i],
            })
            .collect(),
        planted: vec![false; n],
        anchors: vec![Anchor::default(); n],
        slide_before: 0.0,
    };
    for &Stance { start: i, end: j } in stances {
        let (place, yaw) = track.anchor(i, j);
        let pitch = stance_pitch(&track.pitch[i..j], rate_hz);
        let ball = Vec3 {
            z: 0.0,
            ..sole.toe_joint
        };
        let arm = |yaw: f64| Quat::exp(Vec3::Z * yaw).rotate(ball);
        // A foot that is turned outwards is so about its ball.
        let stays = place + arm(yaw);
        for k in i..j {
            let yaw = yaw + if side == 0 { toe_out[k] } else { -toe_out[k] };
            let at = Anchor {
                place: stays - arm(yaw),
                yaw,
                pitch: (pitch[k - i] - heel_up[k]).max(STEEPEST.0),
            };
            out.slide_before = out.slide_before.max((track.point[k] - at.place).norm());
            out.planted[k] = true;
            out.anchors[k] = at;
            out.poses[k] = sole.stand(at.place, at.yaw, at.pitch);
        }
    }
    for (i, j, on) in runs(&out.planted.clone()) {
        if !on {
            swing(sole, &mut out, ankles, rotations, &toes, (i, j), rate_hz);
        }
    }
    out
}

/// Pitch profile of a stance: a dead band makes the foot flat; a walking foot rolls one way only before its flat middle and one way only
/// after it: toe-up first and heel-up then, unless it comes down on its toes or leaves from its heel.
fn stance_pitch(raw: &[f64], rate_hz: f64) -> Vec<f64> {
    let n = raw.len();
    let long = n as f64 > LONG_STANCE * rate_hz;
    let band = if long { DEAD_BAND_LONG } else { DEAD_BAND };
    let mut p: Vec<f64> = raw
        .iter()
        .map(|x| (x - x.clamp(-band, band)).clamp(STEEPEST.0, STEEPEST.1))
        .collect();
    if !long {
        let flat: Vec<usize> = (0..n).filter(|k| raw[*k].abs() < FLAT).collect();
        if let Some(&mid) = flat.get(flat.len() / 2) {
            // Who walks backwards, or dances, comes down on the toes and may leave from the heel.
            let toes_first = raw[0] < -FLAT;
            let heel_last = raw[n - 1] > FLAT;
            for (k, p) in p.iter_mut().enumerate() {
                let toe_up = if k < mid { !toes_first } else { heel_last };
                *p = if toe_up { p.max(0.0) } else { p.min(0.0) };
            }
        } else if median(raw.to_vec()) < 0.0 {
            p.iter_mut().for_each(|p| *p = p.min(0.0));
        } else {
            p.iter_mut().for_each(|p| *p = p.max(0.0));
        }
    } else {
        p.iter_mut().for_each(|p| *p = p.min(0.0));
    }
    low_pass(&mut p, 8.0, rate_hz);
    p
}

/// Fills the samples `i..j` of a swing between the locks on either side.
fn swing(
    sole: &Sole,
    out: &mut LockedFoot,
    ankles: &[Vec3],
    rotations: &[Quat],
    toes: &[f64],
    (i, j): (usize, usize),
    rate_hz: f64,
) {
    let n = ankles.len();
    let at = |k: usize, out: &LockedFoot| offset(&out.poses[k], ankles[k], rotations[k], toes[k]);
    // Between two locks each offset is gone where the other begins; a swing that the recording breaks off has no other.
    let fade_time = ((FADE * rate_hz) as usize).max(1);
    let span = if i > 0 && j < n {
        fade_time.min(j - i + 1)
    } else {
        fade_time
    } as f64;
    // Value, slope and curvature of the offset at each end, per fade time; one-sided differences inside the stance.
    let ends: Vec<(usize, [Channels; 3])> = [(i > 0, i.wrapping_sub(1), -1isize), (j < n, j, 1)]
        .into_iter()
        .filter(|e| e.0)
        .map(|(_, k, inward)| {
            let step = |m: isize| (k as isize + inward * m).clamp(0, n as isize - 1) as usize;
            let inside = |m: isize| {
                out.planted[step(m)] && (0..n as isize).contains(&(k as isize + inward * m))
            };
            let x0 = at(k, out);
            let (mut v, mut a) = ([0.0; 7], [0.0; 7]);
            if inside(1) && inside(2) {
                let (x1, x2) = (at(step(1), out), at(step(2), out));
                for c in 0..7 {
                    // Outward slope: minus the inward difference.
                    v[c] = -(-1.5 * x0[c] + 2.0 * x1[c] - 0.5 * x2[c]) * span;
                    a[c] = (x0[c] - 2.0 * x1[c] + x2[c]) * span * span;
                }
            }
            (k, [x0, v, a])
        })
        .collect();
    for k in i..j {
        let mut o = [0.0; 7];
        for (end, [x, v, a]) in &ends {
            let u = k.abs_diff(*end) as f64 / span;
            if u < 1.0 {
                for c in 0..7 {
                    o[c] += fade(x[c], v[c], a[c], u);
                }
            }
        }
        out.poses[k] = FootPose {
            ankle: ankles[k] + Vec3::from_array([o[0], o[1], o[2]]),
            rotation: (Quat::exp(Vec3::from_array([o[3], o[4], o[5]])) * rotations[k]).normalized(),
            toe: (toes[k] + o[6]).clamp(sole.toe_range.0, sole.toe_range.1),
        };
    }
    // Clearance, in proportion to the step: a shuffle of some centimetres need not rise like a stride.
    let (a, b) = (i.saturating_sub(1), j.min(n - 1));
    let reach = (out.poses[b].ankle - out.poses[a].ankle).norm();
    let most = (0.12 * reach).clamp(0.015, CLEARANCE);
    let mut lift: Vec<f64> = (i..j)
        .map(|k| {
            let since = if i > 0 {
                (k + 1 - i) as f64 / rate_hz
            } else {
                1.0
            };
            let until = if j < n { (j - k) as f64 / rate_hz } else { 1.0 };
            let need = most.min(RISE.0 * since).min(RISE.1 * until);
            let p = &out.poses[k];
            (need - (p.ankle.z + sole.lowest(p.rotation, p.toe))).max(0.0)
        })
        .collect();
    low_pass(&mut lift, 10.0, rate_hz);
    for (k, l) in (i..j).zip(lift) {
        let since = if i > 0 {
            (k + 1 - i) as f64 / rate_hz
        } else {
            1.0
        };
        let until = if j < n { (j - k) as f64 / rate_hz } else { 1.0 };
        let w = (since.min(until) / 0.06).min(1.0);
        out.poses[k].ankle.z += l.max(0.0) * w * w * (3.0 - 2.0 * w);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sole() -> Sole {
        Sole {
            foot: vec![
                Vec3::from_array([-0.05, 0.04, -0.08]),
                Vec3::from_array([-0.05, -0.04, -0.08]),
                Vec3::from_array([0.13, 0.04, -0.08]),
                Vec3::from_array([0.13, -0.04, -0.08]),
            ],
            toes: vec![
                Vec3::from_array([0.0, 0.04, -0.02]),
                Vec3::from_array([0.07, -0.04, -0.02]),
            ],
            toe_joint: Vec3::from_array([0.13, 0.0, -0.06]),
            heel: Vec3::from_array([-0.05, 0.0, -0.08]),
            ankle_height: 0.08,
            toe_range: (-0.5, 1.0),
        }
    }

    #[test]
    fn standing_turns_about_heel_or_toe_joint_and_is_continuous() {
        let s = sole();
        let anchor = Vec3::from_array([0.3, -0.2, 0.0]);
        let place = |pitch: f64, p: Vec3| {
            let f = s.stand(anchor, 0.4, pitch);
            f.ankle + f.rotation.rotate(p)
        };
        for pitch in [0.05, 0.2, 0.4] {
            assert!((place(pitch, s.heel) - place(0.0, s.heel)).norm() < 1e-12);
        }
        for pitch in [-0.05, -0.3, -0.7] {
            let d = place(pitch, s.toe_joint) - place(0.0, s.toe_joint);
            assert!(d.norm() < 1e-12, "{pitch}: {d:?}");
        }
        for pitch in [-0.8f64, -0.3, 0.0, 0.3] {
            let f = s.stand(anchor, 0.4, pitch);
            assert!((f.ankle.z + s.lowest(f.rotation, f.toe)).abs() < 1e-12);
        }
        let gap = s.stand(anchor, 0.4, 1e-9).ankle - s.stand(anchor, 0.4, -1e-9).ankle;
        assert!(gap.norm() < 1e-8);
    }

    #[test]
    fn fade_meets_value_slope_and_curvature_and_ends_at_rest() {
        let f = |u: f64| fade(0.3, -0.7, 1.1, u);
        let h = 1e-4;
        assert!((f(0.0) - 0.3).abs() < 1e-12);
        assert!(((f(h) - f(0.0)) / h + 0.7).abs() < 1e-3);
        assert!(((f(2.0 * h) - 2.0 * f(h) + f(0.0)) / (h * h) - 1.1).abs() < 1e-2);
        assert!(f(1.0).abs() < 1e-15 && (f(1.0 - h) / h).abs() < 1e-6);
    }

    #[test]
    fn a_shuffled_step_is_locked_without_sliding_or_scraping() {
        let s = sole();
        let n = 360;
        let ankles: Vec<Vec3> = (0..n)
            .map(|i| {
                let t = f64::from(i) / 120.0;
                let u = ((t - 1.0) / 0.5).clamp(0.0, 1.0);
                let b = u * u * (3.0 - 2.0 * u);
                Vec3::from_array([
                    0.5 * b + 0.01 * (3.0 * t).sin(),
                    0.1,
                    0.075 + 0.1 * b * (1.0 - b),
                ])
            })
            .collect();
        let rotations = vec![Quat::identity(); n as usize];
        let label: Vec<bool> = (0..n).map(|i| !(122..178).contains(&i)).collect();
        let (stances, f) = locked(&ankles, &rotations, &label, &vec![true; n as usize]);
        assert_eq!(stances.len(), 2);
        for k in 1..n as usize {
            let step = (f.poses[k].ankle - f.poses[k - 1].ankle).norm();
            if f.planted[k] && f.planted[k - 1] {
                assert!(step < 1e-12);
            }
            assert!(step < 0.03, "no jump at {k}: {step}");
            let low = f.poses[k].ankle.z + s.lowest(f.poses[k].rotation, f.poses[k].toe);
            assert!(low > -1e-3, "{low} at {k}");
        }
    }

    /// A foot that stays where it is, to the right of one that walks along x.
    fn beside(n: usize) -> (Vec<Vec3>, Vec<Quat>) {
        let place = Vec3::from_array([0.0, -0.1, 0.08]);
        (vec![place; n], vec![Quat::identity(); n])
    }

    /// Locks a left foot at 120 samples a second; the right one stays where it is and is on the floor where `other` says.
    fn locked(
        place: &[Vec3],
        turned: &[Quat],
        label: &[bool],
        other: &[bool],
    ) -> (Vec<Stance>, LockedFoot) {
        let still = vec![0.0; place.len()];
        let (right, ahead) = beside(place.len());
        let [stands, _] = stances(
            &[sole(), sole()],
            [place, &right],
            [turned, &ahead],
            [label, other],
            120.0,
        );
        let f = lock_foot(&sole(), place, turned, &stands, (&still, &still), 0, 120.0);
        (stands, f)
    }

    /// Both feet turn on the floor about the point between them, by `angle` rad from sample 120 on, in 96 samples.
    fn spun(angle: f64, n: usize) -> [(Vec<Vec3>, Vec<Quat>); 2] {
        [0.1, -0.1].map(|y| {
            let turn = |i: usize| {
                let u = ((i as f64 - 120.0) / 96.0).clamp(0.0, 1.0);
                Quat::exp(Vec3::Z * (angle * u * u * (3.0 - 2.0 * u)))
            };
            let at = |i| turn(i).rotate(Vec3::from_array([0.0, y, 0.08]));
            ((0..n).map(at).collect(), (0..n).map(turn).collect())
        })
    }

    #[test]
    fn feet_that_turn_together_step_in_turn_and_one_of_them_always_stands() {
        let (n, soles, label) = (340, [sole(), sole()], vec![true; 340]);
        for angle in [1.5, -2.5, 4.0] {
            let [l, r] = spun(angle, n);
            let steps = stances(&soles, [&l.0, &r.0], [&l.1, &r.1], [&label, &label], 120.0);
            let stands = |steps: &[Pieces; 2], k: usize| {
                steps.iter().flatten().any(|&(i, j)| (i..j).contains(&k))
            };
            let tracks: [Track; 2] = [
                Track::new(&soles[0], &l.0, &l.1),
                Track::new(&soles[1], &r.0, &r.1),
            ];
            // Each relying on the other's label they leave the body alone.
            let alone: [Pieces; 2] =
                std::array::from_fn(|s| tracks[s].pieces(&label, &label, 120.0));
            assert!((0..n).any(|k| !stands(&alone, k)), "{angle}: {alone:?}");
            let pieces: [Pieces; 2] = steps.map(|s| s.iter().map(|s| (s.start, s.end)).collect());
            assert!((0..n).all(|k| stands(&pieces, k)), "{angle}: {pieces:?}");
            // A foot that stands does not turn.
            for (s, (place, turned)) in [l, r].into_iter().enumerate() {
                assert!(pieces[s].len() > 1);
                let of: Vec<Stance> = pieces[s]
                    .iter()
                    .map(|&(start, end)| Stance { start, end })
                    .collect();
                let still = vec![0.0; n];
                let f = lock_foot(&soles[s], &place, &turned, &of, (&still, &still), s, 120.0);
                for p in &of {
                    let yaw = |k: usize| f.anchors[k].yaw;
                    assert!((p.start..p.end).all(|k| yaw(k) == yaw(p.start)));
                }
            }
        }
    }

    #[test]
    fn a_step_of_which_the_label_saw_only_the_middle_takes_the_time_that_it_needs() {
        let (n, first, last) = (360, 172, 188);
        // A quarter of a metre in 0.36 s, close to the floor; the label has 0.13 s of it.
        let place: Vec<Vec3> = (0..n)
            .map(|i| {
                let u = ((f64::from(i) - 158.4) / 43.2).clamp(0.0, 1.0);
                let s = u * u * (3.0 - 2.0 * u);
                Vec3::from_array([0.25 * s, 0.1, 0.08])
            })
            .collect();
        let n = n as usize;
        let label: Vec<bool> = (0..n).map(|i| !(first..last).contains(&i)).collect();
        let swing = |other: &[bool]| {
            let (stances, _) = locked(&place, &vec![Quat::identity(); n], &label, other);
            assert_eq!(stances.len(), 2);
            (stances[0].end, stances[1].start)
        };
        let needed = ((0.25f64 / HASTE).sqrt() * 120.0).ceil() as usize;
        assert!(needed > last - first);
        let (end, start) = swing(&vec![true; n]);
        assert!(end < first && start > last && start - end == needed);
        // The other foot does not stand before: all comes from after, half of what there is at most.
        let after: Vec<bool> = (0..n).map(|i| i >= last).collect();
        assert_eq!(swing(&after), (first, first + needed));
        let little: Vec<bool> = (0..n).map(|i| (last..last + 4).contains(&i)).collect();
        assert_eq!(swing(&little), (first, last + 2));
        // Nobody else stands: it stays as it is.
        assert_eq!(swing(&vec![false; n]), (first, last));
    }

    #[test]
    fn a_foot_that_begins_to_turn_away_no_longer_stands() {
        let n = 240;
        let turned: Vec<Quat> = (0..n)
            .map(|i| Quat::exp(Vec3::Z * (0.05 * (f64::from(i) - 150.0).max(0.0))))
            .collect();
        let n = n as usize;
        let place = vec![Vec3::from_array([0.0, 0.1, 0.08]); n];
        let label: Vec<bool> = (0..n).map(|i| i < 160).collect();
        let end = |other: bool| {
            let (stances, _) = locked(&place, &turned, &label, &vec![other; n]);
            assert_eq!(stances.len(), 1);
            stances[0].end
        };
        // 0.05 rad a sample: astray from the fourth on, if the other foot holds the body.
        assert_eq!(end(true), 154);
        assert_eq!(end(false), 160);
    }

    #[test]
    fn stances_too_short_to_split_that_slide_are_kept_or_cut_but_never_lost() {
        for (end, held) in [(3, 0), (5, 2), (12, 6), (30, 10), (60, 40)] {
            let n = end + 20;
            // A metre per second from the first sample on; the other foot is down at first, or at last.
            let ankles: Vec<Vec3> = (0..n)
                .map(|i| Vec3::from_array([0.1 * i as f64, 0.1, 0.08]))
                .collect();
            let label: Vec<bool> = (0..n).map(|i| i < end).collect();
            for early in [false, true] {
                let other: Vec<bool> = (0..n).map(|i| (i < held) == early).collect();
                let (stances, f) = locked(&ankles, &vec![Quat::identity(); n], &label, &other);
                assert!(!stances.is_empty());
                assert!(stances.iter().all(|s| s.start < s.end && s.end <= end));
                assert!(f.planted.iter().zip(&label).all(|(p, l)| *l || !*p));
            }
        }
    }
}
