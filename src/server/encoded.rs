//! Messages kept in their encoded form. Once decoded, a message made of many small ones takes many times as much
//! memory, and every reader would need its own copy.

use bytes::{Bytes, BytesMut};
use prost::Message;
use prost::encoding::{WireType, encode_key, encode_varint, message};

/// Bytes of a piece of a list.
const PIECE: usize = 64 * 1024;

/// An encoded message, or a part of one. A copy shares the bytes.
#[derive(Clone, Debug, Default)]
pub struct Encoded {
    pieces: Vec<Bytes>,
    len: usize,
}

impl Encoded {
    /// A message.
    pub fn of(message: &impl Message) -> Self {
        Self::piece(message.encode_to_vec().into())
    }

    fn piece(bytes: Bytes) -> Self {
        Self {
            len: bytes.len(),
            pieces: vec![bytes],
        }
    }

    /// Number of bytes.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// With more fields of the same message appended.
    #[must_use]
    pub fn then(mut self, more: Self) -> Self {
        self.len += more.len;
        self.pieces.extend(more.pieces);
        self
    }

    /// As the field of this number in another message.
    #[must_use]
    pub fn field(self, tag: u32) -> Self {
        let mut head = Vec::new();
        encode_key(tag, WireType::LengthDelimited, &mut head);
        encode_varint(self.len as u64, &mut head);
        Self::piece(head.into()).then(self)
    }

    /// The bytes, in order.
    pub fn into_pieces(self) -> Vec<Bytes> {
        self.pieces
    }
}

/// A repeated field that grows.
#[derive(Debug)]
pub struct List {
    tag: u32,
    full: Vec<Bytes>,
    last: BytesMut,
    len: usize,
}

impl List {
    /// An empty one: the field of this number.
    pub fn new(tag: u32) -> Self {
        Self {
            tag,
            full: Vec::new(),
            last: BytesMut::new(),
            len: 0,
        }
    }

    /// Adds a message.
    pub fn push(&mut self, one: &impl Message) {
        let len = message::encoded_len(self.tag, one);
        if self.last.len() + len > self.last.capacity() {
            let next = BytesMut::with_capacity(len.max(PIECE));
            let full = std::mem::replace(&mut self.last, next);
            self.full.push(full.freeze());
        }
        message::encode(self.tag, one, &mut self.last);
        self.len += len;
    }

    /// Number of bytes until now.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The list as it was built.
    pub fn into_encoded(mut self) -> Encoded {
        // The last piece is rarely full.
        self.full.push(Bytes::copy_from_slice(&self.last));
        Encoded {
            pieces: self.full,
            len: self.len,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_wire::pb;

    #[test]
    fn pieces_decode_to_the_message_they_are_of() {
        let frame = |tick| pb::WorldFrame {
            tick,
            obstacles: vec![pb::ObstacleFrame {
                obstacle_id: "x".repeat(1000),
                ..Default::default()
            }],
            ..Default::default()
        };
        let mut frames = List::new(2);
        (0..200).for_each(|tick| frames.push(&frame(tick)));
        let rest = pb::SimulateClipResponse {
            summary: Some(pb::SimulationSummary::default()),
            ..Default::default()
        };
        let whole = Encoded::of(&rest).then(frames.into_encoded());
        let answer = Encoded::of(&pb::Operation {
            name: "operations/a".into(),
            ..Default::default()
        });
        let answer = answer.then(whole.field(9)).field(1);
        let pieces = answer.clone().into_pieces();
        assert!(pieces.iter().all(|p| p.len() <= PIECE));
        let bytes = pieces.concat();
        assert_eq!(bytes.len(), answer.len());
        let operation = pb::GetOperationResponse::decode(&*bytes).unwrap().operation;
        let operation = operation.unwrap();
        assert_eq!(operation.name, "operations/a");
        let Some(pb::operation::Result::SimulateClip(done)) = operation.result else {
            panic!("{:?}", operation.result);
        };
        assert!(done.summary.is_some());
        assert_eq!(done.frames, (0..200).map(frame).collect::<Vec<_>>());
    }
}
