//! Goal: a message that passes the scan is decoded, and takes no more memory than was counted. Method: messages built
//! by hand, mutations of good ones, and the sizes of the generated types.

use super::*;
use crate::pb;
use proptest::prelude::*;
use prost::{Message, Name};

fn check<M: Message + Name>(bytes: &[u8]) -> Result<(), Fault> {
    scan(&M::full_name(), bytes)
}

/// A field of length-delimited bytes.
fn field(number: u8, inner: &[u8]) -> Vec<u8> {
    let mut out = vec![number << 3 | 2];
    prost::encoding::encode_varint(inner.len() as u64, &mut out);
    out.extend_from_slice(inner);
    out
}

fn push() -> pb::PushMotionRequest {
    let figure = pb::FigureMotion {
        figure_id: "anna".into(),
        root: Some(pb::Pose {
            position_m: Some(pb::Vector3 {
                x: 1.0,
                y: 2.0,
                z: 3.0,
            }),
            rotation: Some(pb::Quaternion {
                x: 0.0,
                y: 0.0,
                z: 0.0,
                w: 1.0,
            }),
        }),
        joint_angles_rad: vec![0.1; 39],
        bone_rotations: vec![pb::BoneRotation::default(); 2],
        planted: vec![true, false],
        ..Default::default()
    };
    let frame = pb::MotionFrame {
        sequence: 7,
        source_time_ns: 11,
        figures: vec![figure; 16],
    };
    pb::PushMotionRequest {
        header: Some(pb::DriveHeader {
            world: "worlds/w".into(),
            figure_ids: vec!["anna".into()],
            playout_delay_ms: Some(0.0),
            ..Default::default()
        }),
        batch: Some(pb::MotionBatch {
            frames: vec![frame; 64],
        }),
    }
}

#[test]
fn the_largest_batch_passes() {
    check::<pb::PushMotionRequest>(&push().encode_to_vec()).unwrap();
}

#[test]
fn empty_elements_are_refused_where_they_become_too_many() {
    // frames[1].figures: a megabyte of empty messages.
    let figures: Vec<u8> = [3 << 3 | 2, 0].repeat(500_000);
    let batch = [field(1, &[]), field(1, &figures)].concat();
    let refused = check::<pb::PushMotionRequest>(&field(2, &batch)).unwrap_err();
    let Fault::TooLarge {
        field: path,
        limit,
        value,
        ..
    } = refused
    else {
        panic!("{refused:?}")
    };
    let element: usize = path
        .strip_prefix("batch.frames[1].figures[")
        .and_then(|p| p.strip_suffix(']'))
        .unwrap_or_else(|| panic!("{path}"))
        .parse()
        .unwrap();
    assert_eq!(limit, "decoded_bytes");
    // The bytes counted until then are within the limit, and at least those really taken.
    let taken = element * size_of::<pb::FigureMotion>();
    assert!(taken <= value as usize, "{element} elements take {taken}");
    // Empty strings are counted, too.
    let names = field(3, &[1 << 3 | 2, 0].repeat(500_000));
    let refused = check::<pb::GetWorldFrameRequest>(&names).unwrap_err();
    assert!(
        refused.to_string().starts_with("view.figure_ids["),
        "{refused}"
    );
}

#[test]
fn no_type_takes_more_than_is_counted_for_it() {
    fn at_least<M: Message + Name>() {
        let set: FileDescriptorSet = Message::decode(DESCRIPTOR_SET).unwrap();
        let mut messages = BTreeMap::new();
        for file in &set.file {
            for m in &file.message_type {
                collect(&format!(".{}", file.package()), m, &mut messages);
            }
        }
        let counted = struct_bytes(messages[&format!(".{}", M::full_name())], &messages);
        assert!(
            counted >= size_of::<M>(),
            "{}: {counted} < {}",
            M::NAME,
            size_of::<M>()
        );
    }
    at_least::<pb::FigureMotion>();
    at_least::<pb::BoneRotation>();
    at_least::<pb::MotionFrame>();
    at_least::<pb::Perturbation>();
    at_least::<pb::TimedPerturbation>();
    at_least::<pb::Figure>();
    at_least::<pb::Constraint>();
    at_least::<pb::DofStrength>();
    at_least::<pb::Obstacle>();
    at_least::<pb::CreateClipRequest>();
    at_least::<pb::SimulateClipRequest>();
    at_least::<pb::World>();
}

#[test]
fn malformed_bytes_are_named_by_the_fields_of_the_protos() {
    let named = |bytes: &[u8]| match check::<pb::PushMotionRequest>(bytes) {
        Err(Fault::Malformed { field, problem }) => (field, problem),
        other => panic!("{other:?}"),
    };
    // batch.frames[0].sequence as text
    let (path, problem) = named(&field(2, &field(1, &field(1, b"x"))));
    assert_eq!(
        (path.as_str(), problem),
        ("batch.frames[0].sequence", "has another type on the wire")
    );
    // header.world that is not UTF-8
    let (path, problem) = named(&field(1, &field(1, &[0xff])));
    assert_eq!((path.as_str(), problem), ("header.world", "is not UTF-8"));
    for (bytes, problem) in [
        (&[0x12, 5, 0][..], "ends in the middle of a value"),
        (&[0x80], "ends in the middle of a value"),
        (&[0x0b], "has an unknown type on the wire"), // a group
        (&[0x00, 0], "has a field number out of range"),
        (&[0xff; 11], "has a number of more than 64 bits"),
    ] {
        assert_eq!(named(bytes), (String::new(), problem), "{bytes:?}");
    }
}

#[test]
fn nesting_ends_where_the_protos_end() {
    let depth = |i: usize| -> usize {
        fn of(shapes: &[MessageShape], i: usize) -> usize {
            let inner = shapes[i].fields.iter().filter_map(|f| match f.kind {
                FieldKind::Message(m) => Some(1 + of(shapes, m)),
                _ => None,
            });
            inner.max().unwrap_or(0)
        }
        of(&SHAPES.all, i)
    };
    let deepest = SHAPES.requests.values().map(|&i| depth(i)).max().unwrap();
    assert!((4..DEPTH).contains(&deepest), "{deepest}");
}

#[test]
fn what_is_not_asked_of_the_server_is_not_looked_at() {
    check::<pb::WatchEventsResponse>(&[0xff]).unwrap();
}

proptest! {
    /// Damaged or invented bytes never panic; bytes that pass are decoded.
    #[test]
    fn what_passes_is_decoded(
        at in 0usize..400, byte in any::<u8>(), cut in 0usize..400, made_up in prop::collection::vec(any::<u8>(), 0..64)
    ) {
        let mut request = push();
        request.batch.as_mut().unwrap().frames.truncate(1);
        request.batch.as_mut().unwrap().frames[0].figures.truncate(1);
        let mut bytes = request.encode_to_vec();
        let at = at % bytes.len();
        bytes[at] = byte;
        bytes.truncate(bytes.len() - cut % 3);
        for bytes in [bytes, made_up] {
            if check::<pb::PushMotionRequest>(&bytes).is_ok() {
                prop_assert!(pb::PushMotionRequest::decode(&bytes[..]).is_ok());
            }
        }
    }
}
