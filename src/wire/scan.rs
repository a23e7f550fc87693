//! Checks the bytes of a request before they are decoded.
//!
//! A message may take far more memory than bytes: an empty element of a repeated field is two bytes on the wire and two
//! hundred in memory. [`scan`] walks the bytes by the types of the descriptor set, without allocating for their
//! content. It adds up the size of the decoded message, and refuses one that grows out of proportion. It also finds
//! everything that makes bytes malformed, so that the error names the field as in the protos.

use super::DESCRIPTOR_SET;
use super::status::Fault;
use prost_types::field_descriptor_proto::{Label, Type as Scalar};
use prost_types::{DescriptorProto, FileDescriptorSet};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Decoded bytes that any request may take. A batch of 64 perturbations takes 20 kB.
pub const DECODED_BYTES: usize = 256 * 1024;
/// Decoded bytes per byte on the wire that a request may take beyond [`DECODED_BYTES`]. A frame of 39 joint angles
/// takes 1.7, one of bone rotations up to 2.8.
pub const DECODED_PER_BYTE: usize = 4;
/// Largest depth of nested messages; the deepest of the protos has seven.
pub const DEPTH: usize = 16;

/// Bytes of a `String`, `Vec` or `Bytes`, without its content.
const HANDLE: usize = 32;
/// Bytes of a number, a flag or a discriminant with its padding.
const WORD: usize = 8;

/// Form of a field on the wire.
#[derive(Clone, Copy, Debug, PartialEq)]
enum FieldKind {
    /// A number of variable length, with its decoded bytes.
    Varint(usize),
    /// A number of four or eight bytes.
    Fixed(usize),
    Text,
    Bytes,
    Message(usize),
}

#[derive(Debug)]
struct Field {
    number: u32,
    name: String,
    kind: FieldKind,
    repeated: bool,
}

/// A message type.
#[derive(Debug, Default)]
struct MessageShape {
    /// By number.
    fields: Vec<Field>,
    /// Bytes of the decoded message, without the content behind its pointers. At least as many as the Rust type has.
    bytes: usize,
}

/// The message types of the protos.
#[derive(Debug)]
struct Shapes {
    all: Vec<MessageShape>,
    /// Request types of methods, by full name.
    requests: BTreeMap<String, usize>,
}

static SHAPES: LazyLock<Shapes> = LazyLock::new(|| {
    let set: FileDescriptorSet =
        prost::Message::decode(DESCRIPTOR_SET).expect("the descriptor set is part of the build");
    Shapes::new(&set)
});

impl Shapes {
    fn new(set: &FileDescriptorSet) -> Self {
        let mut messages = BTreeMap::new();
        for file in &set.file {
            for message in &file.message_type {
                collect(&format!(".{}", file.package()), message, &mut messages);
            }
        }
        let index: BTreeMap<&str, usize> = (messages.keys().map(String::as_str)).zip(0..).collect();
        let mut all: Vec<MessageShape> = messages.values().map(|m| shape(m, &index)).collect();
        for (i, message) in messages.values().enumerate() {
            all[i].bytes = struct_bytes(message, &messages);
        }
        let methods = set
            .file
            .iter()
            .flat_map(|f| &f.service)
            .flat_map(|s| &s.method);
        let requests = methods
            .map(|m| {
                let name = m.input_type();
                (name.trim_start_matches('.').to_owned(), index[name])
            })
            .collect();
        Self { all, requests }
    }
}

/// All message types inside and including this one, by full name with a leading dot.
fn collect<'a>(
    scope: &str,
    m: &'a DescriptorProto,
    out: &mut BTreeMap<String, &'a DescriptorProto>,
) {
    let name = format!("{scope}.{}", m.name());
    for nested in &m.nested_type {
        collect(&name, nested, out);
    }
    out.insert(name, m);
}

fn shape(message: &DescriptorProto, index: &BTreeMap<&str, usize>) -> MessageShape {
    let mut fields: Vec<Field> = message
        .field
        .iter()
        .map(|f| Field {
            number: f.number() as u32,
            name: f.name().to_owned(),
            kind: match f.r#type() {
                Scalar::Double | Scalar::Fixed64 | Scalar::Sfixed64 => FieldKind::Fixed(8),
                Scalar::Float | Scalar::Fixed32 | Scalar::Sfixed32 => FieldKind::Fixed(4),
                Scalar::Int64 | Scalar::Uint64 | Scalar::Sint64 => FieldKind::Varint(8),
                Scalar::Int32 | Scalar::Uint32 | Scalar::Sint32 | Scalar::Enum => {
                    FieldKind::Varint(4)
                }
                Scalar::Bool => FieldKind::Varint(1),
                Scalar::String => FieldKind::Text,
                Scalar::Bytes => FieldKind::Bytes,
                Scalar::Message | Scalar::Group => FieldKind::Message(index[f.type_name()]),
            },
            repeated: f.label() == Label::Repeated,
        })
        .collect();
    fields.sort_by_key(|f| f.number);
    MessageShape { fields, bytes: 0 }
}

/// Bytes of the Rust struct of a message. No message of the protos contains itself, so this ends.
fn struct_bytes(message: &DescriptorProto, all: &BTreeMap<String, &DescriptorProto>) -> usize {
    let field = |f: &prost_types::FieldDescriptorProto| match f.r#type() {
        _ if f.label() == Label::Repeated => HANDLE,
        Scalar::String | Scalar::Bytes => HANDLE,
        Scalar::Message | Scalar::Group => WORD + struct_bytes(all[f.type_name()], all),
        _ if f.proto3_optional() => 2 * WORD,
        _ => WORD,
    };
    let alone =
        |f: &&prost_types::FieldDescriptorProto| f.oneof_index.is_none() || f.proto3_optional();
    let plain: usize = message.field.iter().filter(alone).map(field).sum();
    // Of a oneof only the largest variant counts; `field` has room for its discriminant.
    let choices: usize = (0..message.oneof_decl.len() as i32)
        .map(|i| {
            let of_it = message
                .field
                .iter()
                .filter(|f| !alone(f) && f.oneof_index == Some(i));
            of_it.map(|f| WORD + field(f)).max().unwrap_or(0)
        })
        .sum();
    plain + choices
}

/// Checks the bytes of a request of the type `name` (`sinew.v1.PushMotionRequest`). A type that no method takes, a
/// response for example, is not checked.
///
/// # Errors
/// Malformed bytes, or a message that would take too much memory decoded, with the path of the field.
pub fn scan(name: &str, bytes: &[u8]) -> Result<(), Fault> {
    let Some(&root) = SHAPES.requests.get(name) else {
        return Ok(());
    };
    let mut walk = ScanWalk {
        shapes: &SHAPES.all,
        left: DECODED_BYTES + DECODED_PER_BYTE * bytes.len(),
        path: Vec::with_capacity(DEPTH),
        counts: Vec::with_capacity(64),
    };
    walk.message(root, bytes).map_err(|problem| {
        let field = walk.field();
        match problem {
            ScanProblem::Malformed(what) => Fault::Malformed {
                field,
                problem: what,
            },
            ScanProblem::TooLarge => Fault::TooLarge {
                field,
                limit: "decoded_bytes",
                value: (DECODED_BYTES + DECODED_PER_BYTE * bytes.len()) as u64,
                message: "the message has too many elements for its size".into(),
            },
        }
    })
}

enum ScanProblem {
    Malformed(&'static str),
    TooLarge,
}

const ENDS_EARLY: ScanProblem = ScanProblem::Malformed("ends in the middle of a value");
const WRONG_TYPE: ScanProblem = ScanProblem::Malformed("has another type on the wire");

struct ScanWalk<'a> {
    shapes: &'a [MessageShape],
    /// Decoded bytes that remain.
    left: usize,
    /// The open messages: type, position of the field in it, element of the field.
    path: Vec<(usize, usize, usize)>,
    /// Number of elements of each field of each open message.
    counts: Vec<usize>,
}

impl<'a> ScanWalk<'a> {
    fn message(&mut self, shape: usize, mut bytes: &'a [u8]) -> Result<(), ScanProblem> {
        let of = &self.shapes[shape];
        let base = self.counts.len();
        self.counts.resize(base + of.fields.len(), 0);
        while !bytes.is_empty() {
            let key = varint(&mut bytes)?;
            let number = u32::try_from(key >> 3)
                .ok()
                .filter(|n| (1..1 << 29).contains(n));
            let number = number.ok_or(ScanProblem::Malformed("has a field number out of range"))?;
            let value = WireValue::take(key & 7, &mut bytes)?;
            // A field of a newer version is skipped, here and by the decoder.
            if let Ok(i) = of.fields.binary_search_by_key(&number, |f| f.number) {
                self.path.push((shape, i, self.counts[base + i]));
                self.counts[base + i] += 1;
                self.value(&of.fields[i], value)?;
                self.path.pop();
            }
        }
        self.counts.truncate(base);
        Ok(())
    }

    fn value(&mut self, field: &Field, value: WireValue<'a>) -> Result<(), ScanProblem> {
        match (field.kind, value) {
            (FieldKind::Varint(size), WireValue::Varint) => self.take(size),
            (FieldKind::Fixed(size), WireValue::Fixed(given)) if size == given => self.take(size),
            (FieldKind::Varint(size), WireValue::Bytes(packed)) if field.repeated => {
                let ends = packed.iter().filter(|b| **b < 0x80).count();
                self.take(size * ends)?;
                let mut rest = packed;
                while !rest.is_empty() {
                    varint(&mut rest)?;
                }
                Ok(())
            }
            (FieldKind::Fixed(size), WireValue::Bytes(packed)) if field.repeated => {
                if packed.len() % size != 0 {
                    return Err(ENDS_EARLY);
                }
                self.take(packed.len())
            }
            (FieldKind::Text, WireValue::Bytes(text)) => {
                self.take(text.len() + if field.repeated { HANDLE } else { 0 })?;
                let valid = std::str::from_utf8(text).is_ok();
                valid
                    .then_some(())
                    .ok_or(ScanProblem::Malformed("is not UTF-8"))
            }
            // Singular bytes share the buffer of the request.
            (FieldKind::Bytes, WireValue::Bytes(_)) => {
                self.take(if field.repeated { HANDLE } else { 0 })
            }
            (FieldKind::Message(shape), WireValue::Bytes(inner)) => {
                if self.path.len() > DEPTH {
                    return Err(ScanProblem::Malformed("is nested too deeply"));
                }
                // A singular message lies inside the one that contains it.
                self.take(if field.repeated {
                    self.shapes[shape].bytes
                } else {
                    0
                })?;
                self.message(shape, inner)
            }
            _ => Err(WRONG_TYPE),
        }
    }

    fn take(&mut self, bytes: usize) -> Result<(), ScanProblem> {
        self.left = self.left.checked_sub(bytes).ok_or(ScanProblem::TooLarge)?;
        Ok(())
    }

    /// The field at which the walk is, for example `batch.frames[3].figures[0].figure`.
    fn field(&self) -> String {
        let parts = self.path.iter().map(|&(shape, i, element)| {
            let field = &self.shapes[shape].fields[i];
            if field.repeated {
                format!("{}[{element}]", field.name)
            } else {
                field.name.clone()
            }
        });
        parts.collect::<Vec<_>>().join(".")
    }
}

/// A value on the wire.
enum WireValue<'a> {
    Varint,
    Fixed(usize),
    Bytes(&'a [u8]),
}

impl<'a> WireValue<'a> {
    fn take(wire_type: u64, bytes: &mut &'a [u8]) -> Result<Self, ScanProblem> {
        let split = |bytes: &mut &'a [u8], n: usize| {
            let (value, rest) = bytes.split_at_checked(n).ok_or(ENDS_EARLY)?;
            *bytes = rest;
            Ok(value)
        };
        match wire_type {
            0 => varint(bytes).map(|_| Self::Varint),
            1 => split(bytes, 8).map(|_| Self::Fixed(8)),
            5 => split(bytes, 4).map(|_| Self::Fixed(4)),
            2 => {
                let length = usize::try_from(varint(bytes)?).map_err(|_| ENDS_EARLY)?;
                split(bytes, length).map(Self::Bytes)
            }
            _ => Err(ScanProblem::Malformed("has an unknown type on the wire")),
        }
    }
}

fn varint(bytes: &mut &[u8]) -> Result<u64, ScanProblem> {
    let mut value = 0;
    for (i, byte) in bytes.iter().take(10).enumerate() {
        // The tenth byte holds one bit.
        if i == 9 && *byte > 1 {
            break;
        }
        value |= u64::from(byte & 0x7f) << (7 * i);
        if *byte < 0x80 {
            *bytes = &bytes[i + 1..];
            return Ok(value);
        }
    }
    Err(if bytes.len() < 10 {
        ENDS_EARLY
    } else {
        ScanProblem::Malformed("has a number of more than 64 bits")
    })
}

#[cfg(test)]
mod tests;
