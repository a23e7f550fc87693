//! Maps the bones of a recorded skeleton to the segments of the body.
//!
//! Names come first: every common dialect (CMU, LAFAN, Mixamo, VRM and Unity, Daz and Poser, 3ds Max Biped,
//! MotionBuilder, generic `upper_arm.L` and `left_hip`) writes a side and a part, with differing separators, case and
//! prefixes. Only limbs and head are read from names; pelvis and chest follow from the tree (where the legs meet, where
//! the arms meet), so spine names never matter. When names fail, the shape of the tree decides: two legs, and a trunk
//! that splits into two arms and a head.

use super::skeleton::{MAX_JOINTS, RecordedJoint};
use crate::math::Vec3;

/// The bones of one arm and one leg; indices into the file's joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SideMap {
    /// Joint at the shoulder.
    pub upper_arm: usize,
    /// Joint at the elbow.
    pub forearm: usize,
    /// Joint at the wrist.
    pub hand: Option<usize>,
    /// Joint at the hip.
    pub thigh: usize,
    /// Joint at the knee.
    pub shank: usize,
    /// Joint at the ankle.
    pub foot: usize,
    /// Joint at the ball of the foot.
    pub toes: Option<usize>,
}

/// The joints from which each segment is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkeletonMap {
    /// Joint that carries both legs and the trunk.
    pub pelvis: usize,
    /// Joints from above the pelvis to the one that carries both arms, in order; empty if the trunk is rigid.
    pub trunk: Vec<usize>,
    /// Index into `trunk` of the joint that moves the abdomen; the last entry moves the chest.
    pub abdomen: usize,
    /// Joint that moves the head.
    pub head: Option<usize>,
    /// Left and right limbs.
    pub sides: [SideMap; 2],
    /// Whether the tree decided because names were of no use.
    pub by_structure: bool,
}

/// Why a skeleton cannot be mapped.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MapError {
    /// More joints than any human skeleton has.
    #[error("{0} joints; at most {MAX_JOINTS} are read")]
    TooManyJoints(usize),
    /// Several joints have the name from which a segment is read.
    #[error(
        "the bone of {segment} is ambiguous: {} joints are named {name:?}, below {}; rename all but one",
        parents.len(),
        parents.join(", ")
    )]
    Ambiguous {
        /// Segment name.
        segment: &'static str,
        /// Name that the joints share.
        name: String,
        /// Quoted names of the joints above them, in file order; `nothing` above a root.
        parents: Vec<String>,
    },
    /// A bone without which no posture can be formed.
    #[error(
        "no bone found for {segments:?} among {bones} joints, neither by name nor by structure"
    )]
    Missing {
        /// Segments for which no bone was found.
        segments: Vec<&'static str>,
        /// Joints in the file.
        bones: usize,
    },
}

/// A body part as its name tells it, still ambiguous where dialects disagree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NamedPart {
    Head,
    Shoulder, // clavicle or upper arm, depending on the other joints
    UpperArm,
    Forearm,
    Hand,
    Palm, // CMU finger base: its joint is the wrist; the joint called hand only twists the forearm
    Thigh,
    Leg, // shank, unless another bone is the shank
    Shank,
    Foot,
    Toes,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// Lower-case words of a name: split at separators, at digits and where lower case meets upper case.
fn words(name: &str) -> Vec<String> {
    let tail = name.rsplit([':', '|', '/']).next().unwrap_or(name);
    let mut out: Vec<String> = Vec::new();
    let mut word = String::new();
    let chars: Vec<char> = tail.chars().take(256).collect();
    for (i, &c) in chars.iter().enumerate() {
        if !c.is_alphabetic() {
            if !word.is_empty() {
                out.push(std::mem::take(&mut word));
            }
            continue;
        }
        let prev = i.checked_sub(1).map(|k| chars[k]);
        let next = chars.get(i + 1);
        let starts = c.is_uppercase()
            && (prev.is_some_and(char::is_lowercase)
                || (prev.is_some_and(char::is_uppercase)
                    && next.is_some_and(|n| n.is_lowercase())));
        if starts && !word.is_empty() {
            out.push(std::mem::take(&mut word));
        }
        word.extend(c.to_lowercase());
    }
    if !word.is_empty() {
        out.push(word);
    }
    out
}

fn part_of(stem: &str) -> Option<NamedPart> {
    Some(match stem {
        "head" | "face" | "skull" => NamedPart::Head,
        "shoulder" | "clavicle" | "clav" | "collar" | "collarbone" => NamedPart::Shoulder,
        "arm" | "upperarm" | "uparm" | "armupper" | "shldr" | "humerus" | "bicep" | "shldrbend" => {
            NamedPart::UpperArm
        }
        "forearm" | "lowerarm" | "lowarm" | "armlower" | "elbow" | "radius" | "forearmbend" => {
            NamedPart::Forearm
        }
        "hand" | "wrist" => NamedPart::Hand,
        "fingerbase" => NamedPart::Palm,
        "thigh" | "upleg" | "upperleg" | "legupper" | "hip" | "femur" | "thighbend" => {
            NamedPart::Thigh
        }
        "leg" => NamedPart::Leg,
        "shin" | "lowerleg" | "lowleg" | "leglower" | "calf" | "knee" | "tibia" | "shank" => {
            NamedPart::Shank
        }
        "foot" | "ankle" => NamedPart::Foot,
        "toe" | "toes" | "toebase" | "ball" | "football" | "toesbase" => NamedPart::Toes,
        _ => return None,
    })
}

/// Words that name the rig rather than a bone.
const RIG_WORDS: [&str; 16] = [
    "mixamorig",
    "bip",
    "biped",
    "valvebiped",
    "j",
    "character",
    "def",
    "org",
    "ctrl",
    "jnt",
    "joint",
    "bone",
    "cc",
    "base",
    "rig",
    "skeleton",
];

/// Sided bones that look like a part but move nothing: CMU's joint between pelvis and hip.
const DECOYS: [&str; 1] = ["hipjoint"];

/// Side and part that a bone name indicates.
fn read_name(name: &str) -> Option<(Option<Side>, NamedPart)> {
    let words = words(name);
    let mut side = None;
    let mut stem = String::new();
    for w in &words {
        match w.as_str() {
            "l" | "left" | "lft" => side = Some(Side::Left),
            "r" | "right" | "rt" | "rgt" => side = Some(Side::Right),
            _ => stem.push_str(w),
        }
    }
    if DECOYS.contains(&stem.as_str()) {
        return None;
    }
    let bare: String = words
        .iter()
        .filter(|w| {
            !RIG_WORDS.contains(&w.as_str())
                && !matches!(
                    w.as_str(),
                    "l" | "left" | "lft" | "r" | "right" | "rt" | "rgt"
                )
        })
        .map(String::as_str)
        .collect();
    for stem in [stem.as_str(), bare.as_str()] {
        if let Some(p) = part_of(stem) {
            return Some((side, p));
        }
        // Names in one case ("leftupperarm", "lshldr") hide the side in the stem.
        for (prefix, s) in [
            ("left", Side::Left),
            ("right", Side::Right),
            ("l", Side::Left),
            ("r", Side::Right),
        ] {
            if let Some(p) = stem.strip_prefix(prefix).and_then(part_of) {
                return Some((side.or(Some(s)), p));
            }
        }
        for (suffix, s) in [("left", Side::Left), ("right", Side::Right)] {
            if let Some(p) = stem.strip_suffix(suffix).and_then(part_of) {
                return Some((side.or(Some(s)), p));
            }
        }
    }
    None
}

/// The tree of a file, with the properties needed by the mapping.
struct Tree<'a> {
    joints: &'a [RecordedJoint],
    children: Vec<Vec<usize>>,
    /// Length of the longest path to a leaf below each joint, file units.
    reach: Vec<f64>,
}

fn length(v: Vec3) -> f64 {
    v.norm()
}

impl<'a> Tree<'a> {
    fn new(joints: &'a [RecordedJoint]) -> Self {
        let mut children = vec![Vec::new(); joints.len()];
        let mut reach: Vec<f64> = joints
            .iter()
            .map(|j| j.end_site.map_or(0.0, length))
            .collect();
        for i in (0..joints.len()).rev() {
            if let Some(p) = joints[i].parent {
                children[p].push(i);
                reach[p] = reach[p].max(reach[i] + length(joints[i].offset));
            }
        }
        for c in &mut children {
            c.sort_unstable();
        }
        Self {
            joints,
            children,
            reach,
        }
    }
    fn is_below(&self, joint: usize, ancestor: usize) -> bool {
        let mut at = self.joints[joint].parent;
        while let Some(p) = at {
            if p == ancestor {
                return true;
            }
            at = self.joints[p].parent;
        }
        false
    }
    /// Joints from `top` (excluded) down to `bottom` (included).
    fn path(&self, top: usize, bottom: usize) -> Vec<usize> {
        let mut out = vec![];
        let mut at = Some(bottom);
        while let Some(i) = at {
            if i == top {
                break;
            }
            out.push(i);
            at = self.joints[i].parent;
        }
        out.reverse();
        out
    }
    fn common_ancestor(&self, a: usize, b: usize) -> Option<usize> {
        let mut at = self.joints[a].parent;
        while let Some(p) = at {
            if self.is_below(b, p) {
                return Some(p);
            }
            at = self.joints[p].parent;
        }
        None
    }
}

/// Finds the bones of the 18 segments.
///
/// * `joints`: in file order, parents before children.
///
/// O(joints · depth) time. A map is returned only if every limb chain runs downwards in the tree.
///
/// # Errors
/// [`MapError::Missing`] names the segments without a bone, [`MapError::Ambiguous`] a name that several joints share
/// where names decide.
pub fn map_skeleton(joints: &[RecordedJoint]) -> Result<SkeletonMap, MapError> {
    if joints.len() > MAX_JOINTS {
        return Err(MapError::TooManyJoints(joints.len()));
    }
    let tree = Tree::new(joints);
    match by_names(&tree) {
        Ok(map) => match ambiguous(joints, &map) {
            Some(error) => Err(error),
            None => Ok(map),
        },
        Err(missing) => by_structure(&tree).ok_or(MapError::Missing {
            segments: missing,
            bones: joints.len(),
        }),
    }
}

/// The first segment whose name several joints share. Bones that the tree decides may be called anything.
fn ambiguous(joints: &[RecordedJoint], map: &SkeletonMap) -> Option<MapError> {
    let [l, r] = &map.sides;
    let limb = |s: &SideMap, names: [&'static str; 7]| {
        let bones = [
            Some(s.upper_arm),
            Some(s.forearm),
            s.hand,
            Some(s.thigh),
            Some(s.shank),
            Some(s.foot),
            s.toes,
        ];
        names.into_iter().zip(bones)
    };
    let left = [
        "l_upper_arm",
        "l_forearm",
        "l_hand",
        "l_thigh",
        "l_shank",
        "l_foot",
        "l_toes",
    ];
    let right = [
        "r_upper_arm",
        "r_forearm",
        "r_hand",
        "r_thigh",
        "r_shank",
        "r_foot",
        "r_toes",
    ];
    let mut bones = limb(l, left).chain(limb(r, right));
    bones.find_map(|(segment, bone)| {
        let name = &joints[bone?].name;
        let same: Vec<&RecordedJoint> = joints.iter().filter(|j| j.name == *name).collect();
        (same.len() > 1).then(|| MapError::Ambiguous {
            segment,
            name: name.clone(),
            parents: same
                .iter()
                .take(4)
                .map(|j| {
                    j.parent
                        .map_or("nothing".into(), |p| format!("{:?}", joints[p].name))
                })
                .collect(),
        })
    })
}

fn by_names(tree: &Tree<'_>) -> Result<SkeletonMap, Vec<&'static str>> {
    let read: Vec<_> = tree.joints.iter().map(|j| read_name(&j.name)).collect();
    let find =
        |side: Side, part: NamedPart| read.iter().position(|r| *r == Some((Some(side), part)));
    let last =
        |side: Side, part: NamedPart| read.iter().rposition(|r| *r == Some((Some(side), part)));
    let mut missing = Vec::new();
    let mut sides = Vec::new();
    for side in [Side::Left, Side::Right] {
        let mut need = |bone: Option<usize>, names: [&'static str; 2]| {
            bone.unwrap_or_else(|| {
                missing.push(names[usize::from(side == Side::Right)]);
                usize::MAX
            })
        };
        // A clavicle and an upper arm may both be called shoulder-something: then the lower one moves the arm.
        let upper_arm = find(side, NamedPart::UpperArm).or_else(|| last(side, NamedPart::Shoulder));
        let shank = find(side, NamedPart::Shank);
        let (thigh, shank) = match (
            find(side, NamedPart::Thigh),
            shank,
            find(side, NamedPart::Leg),
        ) {
            (t, Some(s), leg) => (t.or(leg), Some(s)),
            (t, None, leg) => (t, leg),
        };
        let upper_arm = need(upper_arm, ["l_upper_arm", "r_upper_arm"]);
        let forearm = need(find(side, NamedPart::Forearm), ["l_forearm", "r_forearm"]);
        let thigh = need(thigh, ["l_thigh", "r_thigh"]);
        let shank = need(shank, ["l_shank", "r_shank"]);
        let foot = need(find(side, NamedPart::Foot), ["l_foot", "r_foot"]);
        sides.push(SideMap {
            upper_arm,
            forearm,
            hand: find(side, NamedPart::Palm).or_else(|| find(side, NamedPart::Hand)),
            thigh,
            shank,
            foot,
            toes: find(side, NamedPart::Toes),
        });
    }
    if !missing.is_empty() {
        return Err(missing);
    }
    for (s, names) in sides.iter_mut().zip([
        ["l_forearm", "l_shank", "l_foot"],
        ["r_forearm", "r_shank", "r_foot"],
    ]) {
        for (lower, upper, name) in [
            (s.forearm, s.upper_arm, names[0]),
            (s.shank, s.thigh, names[1]),
            (s.foot, s.shank, names[2]),
        ] {
            if !tree.is_below(lower, upper) {
                missing.push(name);
            }
        }
        s.hand = s.hand.filter(|h| tree.is_below(*h, s.forearm));
        s.toes = s.toes.filter(|t| tree.is_below(*t, s.foot));
    }
    if !missing.is_empty() {
        return Err(missing);
    }
    let head = read
        .iter()
        .position(|r| matches!(r, Some((None, NamedPart::Head))));
    finish(tree, [sides[0], sides[1]], head, false).ok_or_else(|| vec!["pelvis"])
}

/// Finds pelvis, trunk and head, given the limbs.
fn finish(
    tree: &Tree<'_>,
    sides: [SideMap; 2],
    head: Option<usize>,
    by_structure: bool,
) -> Option<SkeletonMap> {
    let pelvis = tree.common_ancestor(sides[0].thigh, sides[1].thigh)?;
    let chest = tree.common_ancestor(sides[0].upper_arm, sides[1].upper_arm)?;
    if chest != pelvis && !tree.is_below(chest, pelvis) {
        return None;
    }
    let trunk = tree.path(pelvis, chest);
    let head = head.filter(|h| tree.is_below(*h, chest)).or_else(|| {
        // No head by name: take the branch of the chest that carries no arm, up to its last joint before fingers or
        // eyes fan out.
        let branch = tree.children[chest]
            .iter()
            .copied()
            .filter(|c| {
                sides
                    .iter()
                    .all(|s| *c != s.upper_arm && !tree.is_below(s.upper_arm, *c))
            })
            .max_by(|a, b| tree.reach[*a].total_cmp(&tree.reach[*b]))?;
        let mut at = branch;
        while let [only] = tree.children[at][..] {
            at = only;
        }
        Some(at)
    });
    // Two of the body's joints bend the trunk. The abdomen follows the first bone; where that has no length (CMU's
    // lower back), the next.
    let lengthless = |i: usize| length(tree.joints[trunk[i]].offset) < 1e-6;
    let abdomen = if trunk.len() >= 3
        && trunk
            .get(1)
            .is_some_and(|t| length(tree.joints[*t].offset) > 0.0)
        && lengthless(0)
    {
        1
    } else if trunk.len() >= 5 {
        trunk.len() / 2 - 1
    } else {
        0
    };
    Some(SkeletonMap {
        pelvis,
        trunk,
        abdomen,
        head,
        sides,
        by_structure,
    })
}

/// The limb below `start`: its two longest consecutive bones (upper and lower), then the next joint and the one after
/// it.
fn limb(tree: &Tree<'_>, start: usize) -> Option<(usize, usize, Option<usize>, Option<usize>)> {
    let mut chain = vec![start];
    let mut at = start;
    while let Some(next) = tree.children[at].iter().copied().max_by(|a, b| {
        let far = |c: usize| tree.reach[c] + length(tree.joints[c].offset);
        far(*a).total_cmp(&far(*b)).then(b.cmp(a))
    }) {
        chain.push(next);
        at = next;
    }
    let bone = |k: usize| {
        chain.get(k + 1).map_or_else(
            || tree.joints[chain[k]].end_site.map_or(0.0, length),
            |c| length(tree.joints[*c].offset),
        )
    };
    let best = (0..chain.len().checked_sub(1)?).max_by(|a, b| {
        let sum = |k: usize| bone(k).min(bone(k + 1));
        sum(*a).total_cmp(&sum(*b)).then(b.cmp(a))
    })?;
    if bone(best).min(bone(best + 1)) <= 0.0 {
        return None;
    }
    Some((
        chain[best],
        chain[best + 1],
        chain.get(best + 2).copied(),
        chain.get(best + 3).copied(),
    ))
}

fn by_structure(tree: &Tree<'_>) -> Option<SkeletonMap> {
    let far = |c: usize| tree.reach[c] + length(tree.joints[c].offset);
    let total = (0..tree.joints.len())
        .filter(|i| tree.joints[*i].parent.is_none())
        .map(|i| tree.reach[i])
        .fold(0.0, f64::max);
    // Branches long enough to be a limb or a trunk, not a finger, an eye or a helper.
    let branches = |i: usize| -> Vec<usize> {
        tree.children[i]
            .iter()
            .copied()
            .filter(|c| far(*c) > 0.15 * total)
            .collect()
    };
    let pelvis = (0..tree.joints.len()).find(|i| branches(*i).len() >= 3)?;
    let splits = |c: usize| {
        (c..tree.joints.len())
            .find(|i| (*i == c || tree.is_below(*i, c)) && branches(*i).len() >= 2)
    };
    let of_pelvis = branches(pelvis);
    // The trunk is the branch that fans out into arms; among several the one that reaches farthest.
    let trunk = of_pelvis
        .iter()
        .copied()
        .filter(|c| splits(*c).is_some())
        .max_by(|a, b| far(*a).total_cmp(&far(*b)))?;
    let mut legs: Vec<usize> = of_pelvis.into_iter().filter(|c| *c != trunk).collect();
    legs.sort_by(|a, b| far(*b).total_cmp(&far(*a)));
    legs.truncate(2);
    let chest = splits(trunk)?;
    let mut arms = branches(chest);
    arms.sort_by(|a, b| far(*b).total_cmp(&far(*a)));
    arms.truncate(2);
    if legs.len() < 2 || arms.len() < 2 {
        return None;
    }
    // Positions decide later which side is left (the caller swaps); here +x of the file's rest pose counts as left, the
    // usual case.
    let x = |start: usize| {
        let mut at = start;
        let mut sum = 0.0;
        loop {
            sum += tree.joints[at].offset.x;
            match tree.children[at]
                .iter()
                .copied()
                .max_by(|a, b| far(*a).total_cmp(&far(*b)))
            {
                Some(c) => at = c,
                None => return sum,
            }
        }
    };
    for pair in [&mut legs, &mut arms] {
        if x(pair[0]) < x(pair[1]) {
            pair.swap(0, 1);
        }
    }
    let mut sides = Vec::new();
    for k in 0..2 {
        let (thigh, shank, foot, toes) = limb(tree, legs[k])?;
        let (upper_arm, forearm, hand, _) = limb(tree, arms[k])?;
        sides.push(SideMap {
            upper_arm,
            forearm,
            hand,
            thigh,
            shank,
            foot: foot?,
            toes,
        });
    }
    finish(tree, [sides[0], sides[1]], None, true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_every_dialect_are_read() {
        use NamedPart::*;
        let cases: &[(&str, Option<Side>, NamedPart)] = &[
            ("LeftUpLeg", Some(Side::Left), Thigh),
            ("mixamorig:RightForeArm", Some(Side::Right), Forearm),
            ("mixamorig9:LeftToeBase", Some(Side::Left), Toes),
            ("leftUpperArm", Some(Side::Left), UpperArm),
            ("lShldr", Some(Side::Left), UpperArm),
            ("rShin", Some(Side::Right), Shank),
            ("Bip01 L Calf", Some(Side::Left), Shank),
            ("Bip001 R UpperArm", Some(Side::Right), UpperArm),
            ("Bip01 L Toe0", Some(Side::Left), Toes),
            ("upper_arm.L", Some(Side::Left), UpperArm),
            ("thigh.R", Some(Side::Right), Thigh),
            ("right_hip", Some(Side::Right), Thigh),
            ("left_ankle", Some(Side::Left), Foot),
            ("LeftCollar", Some(Side::Left), Shoulder),
            ("LeftFingerBase", Some(Side::Left), Palm),
            ("Character1_LeftFoot", Some(Side::Left), Foot),
            ("J_Bip_R_LowerLeg", Some(Side::Right), Shank),
            ("UpperLeg_L", Some(Side::Left), Thigh),
            ("LEFT_KNEE", Some(Side::Left), Shank),
            ("leftlowerleg", Some(Side::Left), Shank),
            ("lfoot", Some(Side::Left), Foot),
            ("Head", None, Head),
            ("Armature|face", None, Head),
        ];
        for (name, side, part) in cases {
            assert_eq!(read_name(name), Some((*side, *part)), "{name}");
        }
        for name in [
            "LThumb",
            "LHipJoint",
            "leftEye",
            "Spine1",
            "lButtock",
            "LeftHandIndex1",
            "HeadTop_End",
            "",
            "…",
        ] {
            assert_eq!(read_name(name), None, "{name} is no segment");
        }
    }
}
