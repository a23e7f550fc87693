//! Requests as they are scanned and decoded, by the descriptor set.

use crate::fuzz::edit::{Edit, damaged, edits};
use crate::fuzz::runner;
use proptest::prelude::*;
use prost::Message as _;
use prost_reflect::{
    DescriptorPool, DynamicMessage, FieldDescriptor, Kind, MapKey, MessageDescriptor,
    MethodDescriptor, Value,
};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sinew_wire::scan::scan;
use std::cell::Cell;

/// All calls of the protos.
pub fn methods() -> Vec<MethodDescriptor> {
    let pool = DescriptorPool::decode(sinew_wire::DESCRIPTOR_SET).unwrap();
    let services: Vec<_> = pool.services().collect();
    services
        .iter()
        .flat_map(|s| s.methods().collect::<Vec<_>>())
        .collect()
}

/// Texts that have a meaning in some field, and texts without meaning.
const TEXTS: &[&str] = &[
    "",
    "w",
    "a",
    "b",
    "worlds/w",
    "worlds/w/figures/a",
    "worlds/w/figures/b",
    "worlds/w/obstacles/o",
    "worlds/w/checkpoints/k",
    "worlds/w/grants/g",
    "worlds/none",
    "worlds/",
    "clips/walk",
    "clips/wave",
    "clips/idle",
    "clips/c",
    "bodies/adult_man",
    "bodies/adult_woman",
    "adult_man",
    "chest",
    "pelvis",
    "r_hand",
    "l_foot",
    "*",
    "root_pose",
    "torque",
    "user:ann",
    "anonymous",
    "me",
    "obstacles/0",
    "operations/1",
    "../../etc",
    "é",
    "\u{0}",
    "worlds/w/figures/a/b",
    "figures/a",
    "speed",
    "paused",
    "name",
    "strength",
    "controller",
];

/// Numbers of the same two kinds.
const NUMBERS: &[f64] = &[
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    0.1,
    2.0,
    60.0,
    1e-9,
    1e3,
    1e6,
    1e9,
    1e18,
    1e300,
    -1e300,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN_POSITIVE,
    5e-324,
    0.3,
    9.81,
    100.0,
];
const WHOLE: &[i64] = &[
    0,
    1,
    -1,
    2,
    3,
    7,
    16,
    39,
    45,
    60,
    64,
    100,
    1000,
    65_536,
    i32::MAX as i64,
    i32::MIN as i64,
    i64::MAX,
    i64::MIN,
];

/// Sources of values for messages.
#[derive(Clone, Default)]
pub struct Pool {
    /// Values from outside the descriptor: files.
    pub bytes: Vec<Vec<u8>>,
    /// Few fields, with mostly valid values, so that requests are carried out.
    pub mild: bool,
}

/// A message with some of its fields, often with meaningful values.
pub fn message(
    kind: &MessageDescriptor,
    rng: &mut Pcg64Mcg,
    pool: &Pool,
    depth: u32,
) -> DynamicMessage {
    let mut out = DynamicMessage::new(kind.clone());
    for field in kind.fields() {
        let there = match (depth, pool.mild) {
            (6.., _) => 0.05,
            (0, true) => 0.7,
            (_, true) => 0.12,
            (_, false) => 0.7,
        };
        if !rng.random_bool(there) {
            continue;
        }
        let value = if field.is_list() {
            let most = [0, 1, 2, 3, 18, 39, 45, 64, 300][rng.random_range(0..9)];
            let most = if matches!(field.kind(), Kind::Message(_)) {
                most.min(4)
            } else {
                most
            };
            Value::List((0..most).map(|_| one(&field, rng, pool, depth)).collect())
        } else if field.is_map() {
            Value::Map([(MapKey::String("k".into()), Value::String("v".into()))].into())
        } else {
            one(&field, rng, pool, depth)
        };
        let _ = out.try_set_field(&field, value); // maps of other types are left out
    }
    out
}

fn one(field: &FieldDescriptor, rng: &mut Pcg64Mcg, pool: &Pool, depth: u32) -> Value {
    let number = |rng: &mut Pcg64Mcg| match rng.random_range(0..3) {
        _ if pool.mild => rng.random_range(0.0..1.0),
        0 => NUMBERS[rng.random_range(0..NUMBERS.len())],
        1 => rng.random_range(-1.5..1.5),
        _ => rng.random_range(0.0..120.0),
    };
    let whole = |rng: &mut Pcg64Mcg| match rng.random_range(0..2) {
        _ if pool.mild => rng.random_range(0..3),
        0 => WHOLE[rng.random_range(0..WHOLE.len())],
        _ => rng.random_range(0..200),
    };
    match field.kind() {
        Kind::Double => Value::F64(number(rng)),
        Kind::Float => Value::F32(number(rng) as f32),
        Kind::Int32 | Kind::Sint32 | Kind::Sfixed32 => Value::I32(whole(rng) as i32),
        Kind::Int64 | Kind::Sint64 | Kind::Sfixed64 => Value::I64(whole(rng)),
        Kind::Uint32 | Kind::Fixed32 => Value::U32(whole(rng) as u32),
        Kind::Uint64 | Kind::Fixed64 => Value::U64(whole(rng) as u64),
        Kind::Bool => Value::Bool(rng.random()),
        Kind::String => {
            // Usually a value that the comments of the protos name for a field of this name.
            let text = match (field.name(), rng.random_range(0..10)) {
                ("world" | "parent", 0..7) => "worlds/w",
                ("figure", 0..4) => "worlds/w/figures/a",
                ("figure", 4..8) | ("figures" | "figure_ids" | "figure_id", 0..7) => "a",
                ("name", 0..3) => "worlds/w/figures/a",
                ("name", 3..5) => "worlds/w",
                ("name", 5..7) => "worlds/w/checkpoints/k",
                ("clip", 0..7) => "clips/wave",
                ("checkpoint", 0..7) => "worlds/w/checkpoints/k",
                ("segment", 0..7) => "chest",
                ("page_token" | "control_token" | "offer_token" | "etag" | "request_id", 0..7) => {
                    ""
                }
                _ => TEXTS[rng.random_range(0..TEXTS.len())],
            };
            Value::String(text.to_owned())
        }
        Kind::Bytes => {
            let known = (!pool.bytes.is_empty()).then(|| rng.random_range(0..pool.bytes.len()));
            let bytes = known.map_or_else(
                || vec![7; rng.random_range(0..40)],
                |i| pool.bytes[i].clone(),
            );
            Value::Bytes(bytes.into())
        }
        Kind::Enum(e) => {
            let values: Vec<i32> = e.values().map(|v| v.number()).collect();
            let known = pool.mild || rng.random_bool(0.9);
            Value::EnumNumber(if known {
                values[rng.random_range(0..values.len())]
            } else {
                77
            })
        }
        Kind::Message(m) => Value::Message(message(&m, rng, pool, depth + 1)),
    }
}

/// A request of a call: damaged, or arbitrary bytes.
pub fn request() -> impl Strategy<Value = Option<(u64, Vec<Edit>)>> {
    prop_oneof![
        4 => (any::<u64>(), edits(3)).prop_map(Some),
        1 => Just(None),
    ]
}

pub fn bytes_of(
    kind: &MessageDescriptor,
    pool: &Pool,
    case: &Option<(u64, Vec<Edit>)>,
    arbitrary: Vec<u8>,
) -> Vec<u8> {
    match case {
        Some((seed, edits)) => {
            let mut rng = Pcg64Mcg::seed_from_u64(*seed);
            let mild = seed % 2 == 0;
            let pool = Pool {
                mild,
                ..pool.clone()
            };
            let bytes = message(kind, &mut rng, &pool, 0).encode_to_vec();
            // Mild requests are usually left undamaged.
            if mild && seed % 8 != 0 {
                bytes
            } else {
                damaged(bytes, edits)
            }
        }
        None => arbitrary,
    }
}

/// Requests that pass the scan can be decoded.
#[test]
fn requests_are_refused_or_can_be_decoded() {
    let pool = Pool::default();
    for method in methods() {
        let kind = method.input();
        let name = kind.full_name().to_owned();
        let (cases, passed) = (Cell::new(0u64), Cell::new(0u64));
        let arbitrary = prop::collection::vec(any::<u8>(), 0..200);
        let done = runner(200).run(&(request(), arbitrary), |(case, arbitrary)| {
            let bytes = bytes_of(&kind, &pool, &case, arbitrary);
            cases.set(cases.get() + 1);
            if scan(&name, &bytes).is_ok() {
                passed.set(passed.get() + 1);
                let read = DynamicMessage::decode(kind.clone(), bytes.as_slice());
                prop_assert!(read.is_ok(), "{:?}", read);
            }
            Ok(())
        });
        if let Err(e) = done {
            panic!("{name}: {e}");
        }
        println!("{name}: {} cases, {} decoded", cases.get(), passed.get());
        assert!(passed.get() > 0, "{name}: nothing passed");
    }
}
