//! Bodies of men, women and children from stature, mass, sex and age.
//!
//! Lengths and mass fractions are those of de Leva 1996 (adjusted Zatsiorsky–Seluyanov means), scaled by stature and
//! changed with age as [`super::age`] says; centre of mass and inertia come from the surface of each segment (paper
//! §3.1, [`super::geometry`]), drawn in [`super::shape`]. The right side is the mirror image of the left to the last
//! bit.

mod parts;
mod tables;

use super::age::{MassFractions, height_range, male_share, mass_range, mix};
use super::model::{Body, BodyError, Profile, Segment, Sex};
use super::topology::{self as t, DOF_COUNT, SEGMENT_COUNT};
use crate::math::Vec3;
use crate::math::curve::rise;
use parts::{Dimensions, mirror, mirror_point};
use tables::{Table, joint_limits};

pub(super) use tables::limit_changes;

/// Reflected inertia on every joint DOF, kg·m²: keeps toes and wrists at their torque limit from accelerating at 10⁴
/// rad/s² (`docs/model.md`).
pub const ARMATURE: f64 = 0.02;

pub use super::age::AGE_RANGE;

fn within(field: &'static str, value: f64, range: [f64; 2]) -> Result<(), BodyError> {
    // Written so that NaN fails.
    if value >= range[0] && value <= range[1] {
        Ok(())
    } else {
        Err(BodyError::Profile {
            field,
            value,
            lower: range[0],
            upper: range[1],
        })
    }
}

impl Body {
    /// The body of a person of the given sex, age, stature and mass.
    ///
    /// Proportions of de Leva 1996 for the sex; children have shorter limbs, a larger head and Jensen's mass fractions,
    /// older people those of Pavol 2002, and ranges of motion follow age ([`super::age`]). Segment masses add to
    /// `profile.mass`; the top of the head is at `profile.height` over the soles in the zero pose. Builds surfaces:
    /// about a millisecond, allocates.
    ///
    /// # Errors
    /// [`BodyError::Profile`] naming `age_years` (6…90), `height_m` (adults 1.4…2.1) or `mass_kg` (adults 35…180;
    /// children by age); NaN counts as outside.
    pub fn humanoid(profile: Profile) -> Result<Self, BodyError> {
        Self::build(profile, None)
    }

    /// [`Self::humanoid`] with custom mass fractions, for example measured ones.
    ///
    /// # Errors
    /// As [`Self::humanoid`], and [`BodyError::Fractions`] naming a row whose shares are not positive or do not add to
    /// 100 ± 1 %.
    pub fn with_mass_fractions(
        profile: Profile,
        fractions: &MassFractions,
    ) -> Result<Self, BodyError> {
        Self::build(profile, Some(fractions))
    }

    fn build(profile: Profile, fractions: Option<&MassFractions>) -> Result<Self, BodyError> {
        within("age_years", profile.age, AGE_RANGE)?;
        within("height_m", profile.height, height_range(profile.age))?;
        within("mass_kg", profile.mass, mass_range(profile.age))?;
        let male = male_share(profile.sex, profile.age);
        let mut table = Table::adult(male);
        table.mass = match fractions {
            Some(own) => *own,
            None => MassFractions::of(profile.sex, profile.age, &table.mass),
        };
        table.mass.check()?;
        let body = assemble(profile, male, &table);
        body.validate()?;
        Ok(body)
    }

    /// A boy of eight: 1.28 m, 26 kg. Up to ten years boys and girls are alike here.
    pub fn child() -> Self {
        Self::humanoid(Profile::ordinary(Sex::Male, 8.0)).expect("a child lies within the tables")
    }

    /// The average man: 30 years, 1.75 m, 75 kg.
    pub fn adult_man() -> Self {
        let profile = Profile {
            sex: Sex::Male,
            age: 30.0,
            height: 1.75,
            mass: 75.0,
        };
        Self::humanoid(profile).expect("the average man lies within the tables")
    }

    /// The average woman: 30 years, 1.63 m, 62 kg.
    pub fn adult_woman() -> Self {
        let profile = Profile {
            sex: Sex::Female,
            age: 30.0,
            height: 1.63,
            mass: 62.0,
        };
        Self::humanoid(profile).expect("the average woman lies within the tables")
    }
}

fn assemble(profile: Profile, male: f64, adult: &Table) -> Body {
    let size = Dimensions::new(&profile, male, adult);
    let (trunk, arm, leg) = (size.trunk_and_head(), size.arm(), size.leg());

    let mut joint_offset = [Vec3::zero(); SEGMENT_COUNT];
    for (id, below) in [t::ABDOMEN, t::CHEST, t::HEAD].into_iter().zip(&trunk) {
        joint_offset[id.index()] = below.tip;
    }
    let mut on_both_sides = |first: t::SegmentId, root: Vec3, limb: &[Segment]| {
        let tips = limb[..limb.len() - 1].iter().map(|s| s.tip);
        for (k, offset) in std::iter::once(root).chain(tips).enumerate() {
            joint_offset[first.index() + k] = offset;
            joint_offset[first.index() + limb.len() + k] = mirror_point(offset);
        }
    };
    on_both_sides(t::L_UPPER_ARM, size.shoulder, &arm);
    on_both_sides(t::L_THIGH, size.hip, &leg);

    let mut segments = Vec::from(trunk);
    for limb in [&arm[..], &leg[..]] {
        segments.extend_from_slice(limb);
        segments.extend(limb.iter().map(mirror));
    }
    let [lower, upper] = joint_limits(profile.age);
    Body {
        profile,
        segments,
        joint_offset,
        lower,
        upper,
        armature: [armature(&profile); DOF_COUNT],
    }
}

/// Reflected inertia scales with a growing body, as strength does.
fn armature(profile: &Profile) -> f64 {
    let size = profile.mass * profile.height * profile.height / REFERENCE_SIZE;
    let grown = rise(profile.age, (AGE_RANGE[0], super::age::GROWN));
    ARMATURE * mix(grown, 1.0, size.min(1.0))
}

/// Mass times stature squared of the reference man, kg·m².
const REFERENCE_SIZE: f64 = 75.0 * 1.75 * 1.75;

#[cfg(test)]
mod tests;
