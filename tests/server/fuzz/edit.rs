//! Edits that damage bytes.

use proptest::prelude::*;

/// One change. Places are taken modulo the length.
#[derive(Clone, Debug)]
pub enum Edit {
    Flip(usize, u8),
    Set(usize, u8),
    Cut(usize),
    Remove(usize, usize),
    Insert(usize, Vec<u8>),
    Repeat(usize, usize, usize),
    /// A number of variable length in place of a byte.
    Number(usize, u64),
}

impl Edit {
    pub fn apply(&self, bytes: &mut Vec<u8>) {
        let len = bytes.len().max(1);
        match self {
            Self::Flip(at, bit) if !bytes.is_empty() => bytes[at % len] ^= 1 << (bit % 8),
            Self::Set(at, to) if !bytes.is_empty() => bytes[at % len] = *to,
            Self::Cut(at) => bytes.truncate(at % len),
            Self::Remove(at, n) if !bytes.is_empty() => {
                let at = at % len;
                bytes.drain(at..(at + n).min(len));
            }
            Self::Insert(at, what) => {
                let at = at % (bytes.len() + 1);
                bytes.splice(at..at, what.iter().copied());
            }
            Self::Repeat(at, n, times) if !bytes.is_empty() => {
                let at = at % len;
                let part = bytes[at..(at + n).min(len)].repeat(*times);
                bytes.splice(at..at, part);
            }
            Self::Number(at, n) if !bytes.is_empty() => {
                let mut number = Vec::new();
                prost::encoding::encode_varint(*n, &mut number);
                let at = at % len;
                bytes.splice(at..=at, number);
            }
            _ => {}
        }
    }
}

/// Numbers at which readers go wrong.
pub fn odd_number() -> impl Strategy<Value = u64> {
    prop_oneof![
        0u64..8,
        (0u32..64).prop_map(|b| 1 << b),
        (0u32..64).prop_map(|b| (1 << b) - 1),
        Just(u64::MAX),
        any::<u64>(),
    ]
}

/// Up to `most` changes.
pub fn edits(most: usize) -> impl Strategy<Value = Vec<Edit>> {
    let at = any::<usize>;
    let edit = prop_oneof![
        (at(), any::<u8>()).prop_map(|(a, b)| Edit::Flip(a, b)),
        (at(), any::<u8>()).prop_map(|(a, b)| Edit::Set(a, b)),
        at().prop_map(Edit::Cut),
        (at(), 1usize..40).prop_map(|(a, n)| Edit::Remove(a, n)),
        (at(), prop::collection::vec(any::<u8>(), 1..12)).prop_map(|(a, w)| Edit::Insert(a, w)),
        (at(), 1usize..40, 1usize..200).prop_map(|(a, n, t)| Edit::Repeat(a, n, t)),
        (at(), odd_number()).prop_map(|(a, n)| Edit::Number(a, n)),
    ];
    prop::collection::vec(edit, 0..=most)
}

pub fn damaged(mut bytes: Vec<u8>, edits: &[Edit]) -> Vec<u8> {
    edits.iter().for_each(|e| e.apply(&mut bytes));
    bytes
}
