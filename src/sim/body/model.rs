//! The immutable description of one body: person, segments, joint offsets and limits. Validated on construction.

use super::topology::{DOF_COUNT, DOF_NAMES, JOINT_NAMES, SEGMENT_COUNT, SEGMENT_NAMES, SegmentId};
use crate::math::{Sym3, Vec3};
use serde::{Deserialize, Serialize};

/// Biological sex, as the body and strength tables are split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Sex {
    Male,
    Female,
}

/// The person represented by a body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Profile {
    /// Which tables are used.
    pub sex: Sex,
    /// Age, years.
    pub age: f64,
    /// Stature, m.
    pub height: f64,
    /// Body mass, kg.
    pub mass: f64,
}

/// A closed triangulated surface, outward facing (counter-clockwise seen from outside), segment frame, m.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Vertex positions.
    pub vertices: Vec<Vec3>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// One rigid segment. The segment frame sits at the proximal joint; in the zero pose it is parallel to the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, segment frame, m.
    pub com: Vec3,
    /// Rotational inertia about the centre of mass, segment axes, kg·m².
    pub inertia: Sym3,
    /// Shape (mass properties, display, collision).
    pub mesh: Mesh,
    /// Points that can touch the ground, segment frame, m. For feet: the corners of the sole.
    pub contact_points: Vec<Vec3>,
    /// Distal end (next joint, finger tip, toe tip, vertex of the head), segment frame, m.
    pub tip: Vec3,
}

/// An immutable body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// The person represented by this body.
    pub profile: Profile,
    /// Segments in topology order.
    pub segments: Vec<Segment>,
    /// Joint position in the parent's frame, m; entry 0 unused.
    pub joint_offset: [Vec3; SEGMENT_COUNT],
    /// Least anatomical angle of each DOF, rad.
    #[serde(with = "crate::saved::array")]
    pub lower: [f64; DOF_COUNT],
    /// Largest anatomical angle of each DOF, rad.
    #[serde(with = "crate::saved::array")]
    pub upper: [f64; DOF_COUNT],
    /// Reflected inertia added to the diagonal of the inertia matrix, kg·m² (safeguard, `docs/model.md`; 0 = paper).
    #[serde(with = "crate::saved::array")]
    pub armature: [f64; DOF_COUNT],
}

/// Why a body is not physical.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BodyError {
    /// Wrong number of segments.
    #[error("a body has {SEGMENT_COUNT} segments, got {0}")]
    SegmentCount(usize),
    /// A number is NaN or infinite.
    #[error("segment {segment}: {what} is not finite")]
    NotFinite {
        /// Segment name.
        segment: &'static str,
        /// Which quantity.
        what: &'static str,
    },
    /// Mass must be positive.
    #[error("segment {segment}: mass {mass} kg is not positive")]
    Mass {
        /// Segment name.
        segment: &'static str,
        /// Offending value.
        mass: f64,
    },
    /// Principal moments must be positive and satisfy the triangle inequality.
    #[error(
        "segment {segment}: inertia has principal moments {moments:?} kg·m², which no rigid body has"
    )]
    Inertia {
        /// Segment name.
        segment: &'static str,
        /// Principal moments, ascending.
        moments: [f64; 3],
    },
    /// Segment masses must add up to the body mass.
    #[error("segment masses add to {sum} kg, body mass is {mass} kg")]
    MassSum {
        /// Sum of segment masses.
        sum: f64,
        /// Declared body mass.
        mass: f64,
    },
    /// Mass fractions must be positive and add to 100 %.
    #[error(
        "mass fractions of {row:?} add to {sum:.2} %, expected 100 ± 1 with every one positive"
    )]
    Fractions {
        /// Name of the row.
        row: &'static str,
        /// Their sum, limbs counted twice.
        sum: f64,
    },
    /// Limits must be finite and ordered.
    #[error("{dof}: limits {lower}…{upper} rad are not an interval")]
    Limits {
        /// DOF name.
        dof: &'static str,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// Armature must be finite and not negative.
    #[error("{dof}: armature {value} kg·m² is negative or not finite")]
    Armature {
        /// DOF name.
        dof: &'static str,
        /// Offending value.
        value: f64,
    },
    /// A profile value is outside the range the tables cover.
    #[error("{field} {value} is outside {lower}…{upper}")]
    Profile {
        /// Field name with unit, as on the wire.
        field: &'static str,
        /// Offending value.
        value: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
}

impl Body {
    /// Checks every invariant the kernels rely on; call after building or editing a body.
    ///
    /// # Errors
    /// The first violated invariant, naming segment or DOF.
    pub fn validate(&self) -> Result<(), BodyError> {
        if self.segments.len() != SEGMENT_COUNT {
            return Err(BodyError::SegmentCount(self.segments.len()));
        }
        for (i, s) in self.segments.iter().enumerate() {
            let segment = SEGMENT_NAMES[i];
            let finite = |ok: bool, what: &'static str| {
                if ok {
                    Ok(())
                } else {
                    Err(BodyError::NotFinite { segment, what })
                }
            };
            finite(s.mass.is_finite(), "mass")?;
            finite(
                s.com.is_finite() && s.tip.is_finite(),
                "centre of mass or tip",
            )?;
            finite(self.joint_offset[i].is_finite(), JOINT_NAMES[i])?;
            finite(
                s.contact_points.iter().all(|p| p.is_finite()),
                "contact point",
            )?;
            finite(s.mesh.vertices.iter().all(|p| p.is_finite()), "mesh vertex")?;
            if s.mass <= 0.0 {
                return Err(BodyError::Mass {
                    segment,
                    mass: s.mass,
                });
            }
            let m = nalgebra::Matrix3::from(s.inertia);
            finite(m.iter().all(|x| x.is_finite()), "inertia")?;
            let e = m.symmetric_eigenvalues();
            let mut moments = [e[0], e[1], e[2]];
            moments.sort_by(f64::total_cmp);
            // A planar body reaches equality, so allow for the rounding of a rotated tensor.
            if moments[0] <= 0.0 || moments[0] + moments[1] < moments[2] * (1.0 - 1e-9) {
                return Err(BodyError::Inertia { segment, moments });
            }
        }
        let sum: f64 = self.segments.iter().map(|s| s.mass).sum();
        if (sum - self.profile.mass).abs() > 1e-6 * self.profile.mass {
            return Err(BodyError::MassSum {
                sum,
                mass: self.profile.mass,
            });
        }
        for d in 0..DOF_COUNT {
            let (lower, upper) = (self.lower[d], self.upper[d]);
            if !(lower.is_finite() && upper.is_finite() && lower < upper) {
                return Err(BodyError::Limits {
                    dof: DOF_NAMES[d],
                    lower,
                    upper,
                });
            }
            if !(self.armature[d].is_finite() && self.armature[d] >= 0.0) {
                return Err(BodyError::Armature {
                    dof: DOF_NAMES[d],
                    value: self.armature[d],
                });
            }
        }
        Ok(())
    }

    /// The segment `id`.
    pub fn segment(&self, id: SegmentId) -> &Segment {
        &self.segments[id.index()]
    }

    /// Length of the leg of a side (0 left, 1 right) from hip to ankle, m.
    pub fn leg_length(&self, side: usize) -> f64 {
        use super::topology::{L_FOOT, L_SHANK, R_FOOT, R_SHANK};
        let [shank, foot] = [[L_SHANK, L_FOOT], [R_SHANK, R_FOOT]][side];
        self.joint_offset[shank.index()].norm() + self.joint_offset[foot.index()].norm()
    }

    /// Height of the left (0) or right (1) ankle over the floor while its foot stands flat, m.
    pub fn ankle_height(&self, side: usize) -> f64 {
        use super::topology as t;
        let (foot, toes) = (t::FEET[side], t::TOES[side]);
        let toe_joint = self.joint_offset[toes.index()];
        let foot_points = self.segment(foot).contact_points.iter();
        let low = foot_points.map(|p| p.z).fold(f64::INFINITY, f64::min);
        let toe_points = self.segment(toes).contact_points.iter();
        let toe_low = toe_points
            .map(|p| p.z + toe_joint.z)
            .fold(f64::INFINITY, f64::min);
        let height = -low.min(toe_low);
        if height.is_finite() { height } else { 0.0 }
    }

    /// Height of the pelvis origin over the soles in the zero pose, m.
    pub fn standing_root_height(&self) -> f64 {
        use super::topology as t;
        let mut z = 0.0;
        for s in [t::L_THIGH, t::L_SHANK, t::L_FOOT] {
            z += self.joint_offset[s.index()].z;
        }
        let sole = self
            .segment(t::L_FOOT)
            .contact_points
            .iter()
            .map(|p| p.z)
            .fold(0.0, f64::min);
        -(z + sole)
    }
}
