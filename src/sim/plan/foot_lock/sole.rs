//! The sole of a foot: its points, its poses flat or rolled about heel edge or toe joint, and the distance of a foot
//! from such a pose.

use crate::body::Body;
use crate::body::topology::{DOF_START, FEET, SEGMENT_COUNT, SegmentId, TOES};
use crate::math::{Quat, Vec3, trig};
use crate::plan::params::pitch;
use serde::{Deserialize, Serialize};

/// Pose of one foot: ankle position, `world_from_foot`, toe extension.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FootPose {
    /// Ankle, m.
    pub ankle: Vec3,
    /// `world_from_foot`.
    pub rotation: Quat,
    /// Toe extension, rad.
    pub toe: f64,
}

/// Pose of a foot without its toes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnklePose {
    /// Ankle, m.
    pub at: Vec3,
    /// `world_from_foot`.
    pub rotation: Quat,
}

impl AnklePose {
    /// That of the left (`side` 0) or right (1) foot where segments have these poses (place, m, and rotation).
    pub fn of(poses: &[(Vec3, Quat); SEGMENT_COUNT], side: usize) -> Self {
        let (at, rotation) = poses[FEET[side].index()];
        Self { at, rotation }
    }
}

/// Difference of two poses of a foot: translation (m), rotation vector (rad), toe extension (rad).
pub(in crate::plan) type FootOffset = [f64; 7];

impl FootPose {
    /// The pose without the toes.
    pub(in crate::plan) fn without_toes(&self) -> AnklePose {
        AnklePose {
            at: self.ankle,
            rotation: self.rotation,
        }
    }

    /// The offset that takes `other` to this pose.
    pub(in crate::plan) fn offset_from(&self, other: &Self) -> FootOffset {
        let p = self.ankle - other.ankle;
        let r = (self.rotation * other.rotation.conjugate()).log();
        [p.x, p.y, p.z, r.x, r.y, r.z, self.toe - other.toe]
    }

    /// This pose moved by an offset.
    pub(in crate::plan) fn moved(&self, by: &FootOffset) -> Self {
        let turn = Quat::exp(Vec3::from_array([by[3], by[4], by[5]]));
        Self {
            ankle: self.ankle + Vec3::from_array([by[0], by[1], by[2]]),
            rotation: (turn * self.rotation).normalized(),
            toe: self.toe + by[6],
        }
    }
}

/// The sole of one foot of a body.
#[derive(Clone, Debug, Default)]
pub struct Sole {
    /// Left (0) or right (1).
    pub(super) side: usize,
    pub(super) foot: Vec<Vec3>,
    pub(super) toes: Vec<Vec3>,
    pub(in crate::plan) toe_joint: Vec3,
    pub(super) heel: Vec3,
    /// Height of the ankle over the floor when the foot is flat, m.
    pub ankle_height: f64,
    pub(super) toe_range: (f64, f64),
}

/// Placement of a planted foot in one sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FootPlacement {
    /// Point of the floor under the flat ankle, m (z = 0).
    pub place: Vec3,
    /// Heading of the foot, rad.
    pub yaw: f64,
    /// Pitch, rad, toe-up positive.
    pub pitch: f64,
    /// By how much the toes are turned up about their tip, and the foot with them, as at the end of a runner's stance,
    /// rad.
    pub tip: f64,
}

impl FootPlacement {
    /// Whether the heel is raised, so that nothing behind the ball of the foot carries.
    pub(in crate::plan) fn is_on_ball(&self) -> bool {
        self.pitch <= -pitch::FLAT
    }

    /// Direction in which the foot points, x and y.
    pub(in crate::plan) fn ahead(&self) -> [f64; 2] {
        Quat::exp(Vec3::Z * self.yaw).rotate(Vec3::X).xy()
    }
}

impl Sole {
    /// Sole of the left (`side` 0) or right (1) foot.
    pub fn new(body: &Body, side: usize) -> Self {
        let (f, t) = (FEET[side], TOES[side]);
        let foot = body.segment(f).contact_points.clone();
        let toes = body.segment(t).contact_points.clone();
        let toe_joint = body.joint_offset[t.index()];
        let ankle_height = body.ankle_height(side);
        let back = foot.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
        let heel = Vec3 {
            x: if back.is_finite() { back } else { 0.0 },
            y: 0.0,
            z: -ankle_height,
        };
        let dof = DOF_START[t.index()];
        Self {
            side,
            foot,
            toes,
            toe_joint,
            heel,
            ankle_height,
            toe_range: (body.lower[dof], body.upper[dof]),
        }
    }

    /// Foot and toes, each with its contact points, segment frame, m.
    pub fn parts(&self) -> [(SegmentId, &[Vec3]); 2] {
        [(FEET[self.side], &self.foot), (TOES[self.side], &self.toes)]
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

    /// Contact points of foot and toes where segments have these poses (place, m, and rotation), world, m.
    pub fn points_at<'a>(
        &'a self,
        poses: &'a [(Vec3, Quat); SEGMENT_COUNT],
    ) -> impl Iterator<Item = Vec3> + 'a {
        self.parts().into_iter().flat_map(|(segment, points)| {
            let (at, q) = poses[segment.index()];
            points.iter().map(move |p| at + q.rotate(*p))
        })
    }

    /// Height of the lowest of [`Self::points_at`], m.
    pub fn lowest_at(&self, poses: &[(Vec3, Quat); SEGMENT_COUNT]) -> f64 {
        let heights = self.points_at(poses).map(|p| p.z);
        heights.fold(f64::INFINITY, f64::min)
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

    /// Largest distance between a foot's actual and its intended pose, over ankle, heel edge and toe joint, m.
    pub fn stray(&self, is: AnklePose, should: &FootPose) -> f64 {
        [Vec3::zero(), self.heel, self.toe_joint]
            .into_iter()
            .map(|p| {
                let off = is.at + is.rotation.rotate(p) - should.ankle - should.rotation.rotate(p);
                off.norm()
            })
            .fold(0.0, f64::max)
    }

    /// Pose of a foot planted at `anchor` with heading `yaw`, pitched about heel edge (toe-up) or toe joint (heel-up).
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

    /// The same with the toes, and the foot with them, turned up about their tip by `tip` rad.
    pub fn stand_on_tip(&self, at: &FootPlacement) -> FootPose {
        let mut pose = self.stand(at.place, at.yaw, at.pitch);
        if at.tip > 0.0 {
            let toes = pose.rotation * Quat::exp(Vec3::Y * -pose.toe);
            let tip =
                pose.ankle + pose.rotation.rotate(self.toe_joint) + toes.rotate(self.toe_tip());
            let turn = Quat::exp(pose.rotation.rotate(Vec3::Y) * at.tip);
            pose.ankle = tip + turn.rotate(pose.ankle - tip);
            pose.rotation = (turn * pose.rotation).normalized();
        }
        pose
    }

    /// Actual or nearest placement of a foot with this pose: rolled about its heel edge or its toe joint, according to
    /// its pitch. The same bits on every machine, since ticks use it.
    pub fn footing(&self, pose: AnklePose) -> FootPlacement {
        let x = pose.rotation.rotate(Vec3::X);
        let (yaw, pitch) = (trig::atan2(x.y, x.x), trig::atan2(x.z, x.level()));
        let place = pose.at - self.stand(Vec3::zero(), yaw, pitch).ankle;
        FootPlacement {
            place: place.horizontal(),
            yaw,
            pitch,
            tip: 0.0,
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

    /// Heights of ankle, toe joint and toe tip of a flat planted foot, m.
    pub fn standing_heights(&self) -> [f64; 3] {
        let joint = self.ankle_height + self.toe_joint.z;
        [self.ankle_height, joint, joint + self.toe_tip().z]
    }

    /// Visits the floor polygon corners (x, y) that carry a foot placed at `at`: the heel unless heel-up, the toes
    /// unless toe-up.
    pub fn each_corner(&self, at: &FootPlacement, mut visit: impl FnMut([f64; 2])) {
        let FootPlacement {
            place: anchor,
            yaw,
            pitch,
            tip,
        } = *at;
        let heading = Quat::exp(Vec3::Z * yaw);
        let ball = self.toe_joint.x;
        let mut push = |p: Vec3| visit((anchor + heading.rotate(p)).xy());
        for p in &self.foot {
            let front = p.x > 0.5 * ball;
            if (!at.is_on_ball() || front) && (pitch < pitch::FLAT || !front) {
                push(*p);
            }
        }
        if pitch < pitch::FLAT {
            // On their tip the toes still carry with a narrow strip.
            let front = self.toe_tip().x;
            let back = if tip < pitch::FLAT {
                f64::NEG_INFINITY
            } else {
                front - pitch::TIP_LENGTH
            };
            for p in &self.toes {
                push(
                    self.toe_joint
                        + Vec3 {
                            x: p.x.max(back),
                            ..*p
                        },
                );
            }
        }
    }

    /// Adds the corners of [`Self::each_corner`].
    pub fn footprint(&self, at: &FootPlacement, out: &mut Vec<[f64; 2]>) {
        self.each_corner(at, |p| out.push(p));
    }
}

/// Heading and pitch (toe-up positive) of a foot of a recording, rad: `world_from_foot` without roll.
pub fn yaw_pitch(rotation: Quat) -> (f64, f64) {
    let x = rotation.rotate(Vec3::X);
    (trig::atan2(x.y, x.x), trig::asin(x.z))
}

/// Difference of two headings of a recording in −π…π, rad.
pub fn turn(from: f64, to: f64) -> f64 {
    trig::wrapped(to - from)
}
