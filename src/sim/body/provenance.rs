//! Origins of the numbers of a body.

use super::age::{self, GROWN, Origin};
use super::model::Body;
use super::topology::{DOF_NAMES, SEGMENT_NAMES};

/// One number with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// The subject of the number: an action such as `knee extension`, a segment, or a DOF.
    pub action: &'static str,
    /// The quantity, for example a length.
    pub quantity: &'static str,
    /// Value as used for this body.
    pub value: f64,
    /// Unit of the value.
    pub unit: &'static str,
    /// Publication or reason.
    pub source: &'static str,
    /// S1 read in data citing the publication; S2 read in the publication; S3 cross-check; D derived; R estimate.
    pub tag: &'static str,
    /// How the value was processed.
    pub note: &'static str,
}

impl Provenance {
    /// A number with its origin.
    pub fn new(
        action: &'static str,
        quantity: &'static str,
        value: f64,
        unit: &'static str,
        origin: Origin,
    ) -> Self {
        Self {
            action,
            quantity,
            value,
            unit,
            source: origin.source,
            tag: origin.tag,
            note: origin.note,
        }
    }
}

const LENGTH_ORIGIN: Origin = Origin {
    source: "de Leva 1996",
    tag: "S1",
    note: "scaled by stature; widths of shoulders and hips are ours (R)",
};
const SHAPE_ORIGIN: Origin = Origin {
    source: "volume integral of the segment's surface",
    tag: "D",
    note: "surface drawn to come near the radii of gyration of de Leva 1996",
};
const ARMATURE_ORIGIN: Origin = Origin {
    source: "safeguard of the simulation",
    tag: "D",
    note: "smaller for a growing body, with mass times stature squared",
};

impl Body {
    /// Mass, length and inertia of segment `s` (0…17), each with its origin.
    pub fn segment_provenance(&self, s: usize) -> Vec<Provenance> {
        let (segment, name, age) = (&self.segments[s], SEGMENT_NAMES[s], self.profile.age);
        let length = if age < GROWN {
            age::GROWTH_ORIGIN
        } else {
            LENGTH_ORIGIN
        };
        let gyration = |moment: f64| (moment / segment.mass).sqrt();
        let mut out = vec![
            Provenance::new(name, "mass", segment.mass, "kg", age::mass_origin(age)),
            Provenance::new(name, "length", segment.tip.norm(), "m", length),
            Provenance::new(
                name,
                "distance of the centre of mass from the joint",
                segment.com.norm(),
                "m",
                SHAPE_ORIGIN,
            ),
        ];
        for (what, moment) in [
            ("radius of gyration about x", segment.inertia.xx),
            ("radius of gyration about y", segment.inertia.yy),
            ("radius of gyration about z", segment.inertia.zz),
        ] {
            out.push(Provenance::new(
                name,
                what,
                gyration(moment),
                "m",
                SHAPE_ORIGIN,
            ));
        }
        out
    }

    /// Limits and armature of DOF `d` (0…38), each with its origin.
    pub fn limit_provenance(&self, d: usize) -> Vec<Provenance> {
        let name = DOF_NAMES[d];
        let origin = |upper: bool| {
            let changed = super::humanoid::limit_changes(d)
                .any(|c| c.upper == upper && c.at(self.profile.age) != 0.0);
            age::limit_origin(changed)
        };
        vec![
            Provenance::new(
                name,
                "least angle",
                self.lower[d].to_degrees(),
                "deg",
                origin(false),
            ),
            Provenance::new(
                name,
                "largest angle",
                self.upper[d].to_degrees(),
                "deg",
                origin(true),
            ),
            Provenance::new(name, "armature", self.armature[d], "kg·m²", ARMATURE_ORIGIN),
        ]
    }
}
