//! Bodies: names that state their profile, and descriptions.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::BodyRef;
use super::names::BODY;
use super::{shortened, vector_out};
use sinew_physics::body::names::DEFAULT_BODY;
use sinew_physics::body::provenance::Provenance;
use sinew_physics::body::topology::{
    BONE_NAMES, DOF_AXIS, DOF_LEN, DOF_NAMES, DOF_SEGMENT, DOF_START, JOINT, JOINT_NAMES, Joint,
    PARENT, SEGMENT_NAMES,
};
use sinew_physics::body::{Body, DOF_COUNT, Profile, SEGMENT_COUNT, Sex};
use sinew_physics::math::Vec3;

pub use sinew_physics::body::names::NAMED_BODIES as NAMED;

/// The body with this last part of a name.
pub fn by_id(id: &str) -> Option<BodyRef> {
    Some(BodyRef {
        id: id.to_owned(),
        profile: Profile::from_name(id)?,
    })
}

/// The body of a resource name.
pub fn by_name(field: &str, name: &str) -> Result<BodyRef, Fault> {
    let [id] = BODY.ids(field, name)?;
    by_id(id).ok_or_else(|| Fault::not_found("body", shortened(name)))
}

/// Body of a request: by name, by profile, or the adult man. Whether the tables cover the profile only shows when it is
/// built.
pub fn reference(
    field: &str,
    name: &str,
    profile_field: &str,
    profile: Option<&pb::BodyProfile>,
) -> Result<BodyRef, Fault> {
    match (name.is_empty(), profile) {
        (false, Some(_)) => Err(Fault::invalid(
            profile_field,
            "must be absent when the body is given by name",
        )),
        (false, None) => by_name(field, name),
        (true, None) => by_name(field, &BODY.name([DEFAULT_BODY])),
        (true, Some(p)) => {
            let sex = match pb::Sex::try_from(p.sex) {
                Ok(pb::Sex::Male) => Sex::Male,
                Ok(pb::Sex::Female) => Sex::Female,
                _ => {
                    return Err(Fault::invalid(
                        format!("{profile_field}.sex"),
                        "must be SEX_MALE or SEX_FEMALE",
                    ));
                }
            };
            let at = |part: &str| format!("{profile_field}.{part}");
            let age =
                (super::within(at("age_years"), p.age_years, 0.0, 150.0)? * 10.0).round() / 10.0;
            let ordinary = Profile::ordinary(sex, age);
            let size = |part: &str, value, usual, least, most| {
                super::or_default(&at(part), value, usual, least, most)
            };
            let height = size("height_m", p.height_m, ordinary.height, 0.3, 3.0)?;
            let mass = size("mass_kg", p.mass_kg, ordinary.mass, 1.0, 500.0)?;
            let profile = Profile {
                sex,
                age,
                height,
                mass,
            }
            .rounded();
            Ok(BodyRef {
                id: profile.value_name(),
                profile,
            })
        }
    }
}

/// A profile for a response.
pub fn profile_out(p: &Profile) -> pb::BodyProfile {
    pb::BodyProfile {
        sex: match p.sex {
            Sex::Male => pb::Sex::Male,
            Sex::Female => pb::Sex::Female,
        }
        .into(),
        age_years: p.age,
        height_m: p.height,
        mass_kg: p.mass,
    }
}

/// Name and profile only.
pub fn brief(body: &BodyRef) -> pb::Body {
    pb::Body {
        name: BODY.name([&body.id]),
        profile: Some(profile_out(&body.profile)),
        ..Default::default()
    }
}

/// The whole description.
pub fn describe(id: &str, body: &Body, geometry: bool) -> pb::Body {
    let flat = |points: &[Vec3]| points.iter().flat_map(|p| p.to_array()).collect();
    let segment = |i: usize| {
        let s = &body.segments[i];
        let j = s.inertia;
        let mut out = pb::Segment {
            name: SEGMENT_NAMES[i].into(),
            bone: BONE_NAMES[i].into(),
            parent: if i == 0 { -1 } else { PARENT[i] as i32 },
            mass_kg: s.mass,
            com_m: Some(vector_out(s.com)),
            inertia_kgm2: vec![j.xx, j.yy, j.zz, j.xy, j.xz, j.yz],
            tip_m: Some(vector_out(s.tip)),
            contact_points_m: flat(&s.contact_points),
            ..Default::default()
        };
        if geometry {
            out.mesh_vertices_m = flat(&s.mesh.vertices);
            out.mesh_triangles = s
                .mesh
                .triangles
                .iter()
                .flatten()
                .map(|v| *v as i32)
                .collect();
        }
        out
    };
    let joint = |i: usize| pb::Joint {
        name: JOINT_NAMES[i].into(),
        r#type: match JOINT[i] {
            Joint::Free => pb::JointType::Free,
            Joint::Ball(_) => pb::JointType::Ball,
            Joint::Hinge1(_) | Joint::Hinge2(_) => pb::JointType::Hinge,
        }
        .into(),
        offset_m: Some(vector_out(if i == 0 {
            Vec3::zero()
        } else {
            body.joint_offset[i]
        })),
        dof_start: DOF_START[i] as i32,
        dof_count: DOF_LEN[i] as i32,
    };
    let dof = |d: usize| pb::Dof {
        name: DOF_NAMES[d].into(),
        joint: DOF_SEGMENT[d] as i32,
        axis: Some(vector_out(Vec3::from_array(DOF_AXIS[d].vector()))),
        lower_rad: body.lower[d],
        upper_rad: body.upper[d],
        armature_kgm2: body.armature[d],
    };
    pb::Body {
        name: BODY.name([id]),
        profile: Some(profile_out(&body.profile)),
        segments: (0..SEGMENT_COUNT).map(segment).collect(),
        joints: (0..SEGMENT_COUNT).map(joint).collect(),
        dofs: (0..DOF_COUNT).map(dof).collect(),
        standing_root_height_m: body.standing_root_height(),
        provenance: Vec::new(),
    }
}

/// Numbers with their origin, each with the name of its segment or DOF.
pub fn provenance_out(list: Vec<(&'static str, Provenance)>) -> Vec<pb::Provenance> {
    list.into_iter()
        .map(|(part, p)| pb::Provenance {
            part: part.into(),
            action: p.action.into(),
            quantity: p.quantity.into(),
            value: p.value,
            unit: p.unit.into(),
            source: p.source.into(),
            tag: p.tag.into(),
            note: p.note.into(),
        })
        .collect()
}

/// The requested text form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextForm {
    /// MuJoCo XML.
    Mjcf,
    /// URDF.
    Urdf,
}

/// The format of an export.
pub fn text_form(value: i32) -> Result<TextForm, Fault> {
    match pb::ExportFormat::try_from(value) {
        Ok(pb::ExportFormat::Mjcf) => Ok(TextForm::Mjcf),
        Ok(pb::ExportFormat::Urdf) => Ok(TextForm::Urdf),
        _ => Err(Fault::invalid(
            "format",
            "must be EXPORT_FORMAT_MJCF or EXPORT_FORMAT_URDF",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_the_profile() {
        let body = by_id("female-25y-1680mm-61500g").unwrap();
        assert_eq!(
            body.profile,
            Profile {
                sex: Sex::Female,
                age: 25.0,
                height: 1.68,
                mass: 61.5
            }
        );
        assert_eq!(body.profile.value_name(), body.id);
        for bad in [
            "male",
            "male-30y",
            "male-30y-1750mm-75000g-x",
            "male-030y-1750mm-75000g",
            "male-1e1y-1750mm-75000g",
            "male--1y-1750mm-75000g",
        ] {
            assert!(by_id(bad).is_none(), "{bad}");
        }
    }
}
