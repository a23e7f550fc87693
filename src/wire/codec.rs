//! How messages are read from and written to the wire. Generated code uses this codec in place of tonic's.
//!
//! Requests are scanned before they are decoded ([`super::scan`]), in unary calls and in each message of a stream
//! alike, so that nothing large is allocated for a message that will be refused.

use super::scan::scan;
use super::status::Fault;
use prost::bytes::Buf as _;
use prost::{Message, Name};
use std::marker::PhantomData;
use tonic::Status;
use tonic::codec::{DecodeBuf, Decoder};
use tonic_prost::ProstEncoder;

/// Writes `T` and reads `U`.
#[derive(Debug)]
pub struct Codec<T, U>(PhantomData<(T, U)>);

impl<T, U> Default for Codec<T, U> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<T, U> tonic::codec::Codec for Codec<T, U>
where
    T: Message + Send + 'static,
    U: Message + Name + Default + Send + 'static,
{
    type Encode = T;
    type Decode = U;
    type Encoder = ProstEncoder<T>;
    type Decoder = MessageReader<U>;

    fn encoder(&mut self) -> Self::Encoder {
        ProstEncoder::default()
    }

    fn decoder(&mut self) -> Self::Decoder {
        MessageReader {
            name: U::full_name(),
            message: PhantomData,
        }
    }
}

/// Reads messages of one type.
#[derive(Debug)]
pub struct MessageReader<U> {
    name: String,
    message: PhantomData<U>,
}

impl<U: Message + Default> Decoder for MessageReader<U> {
    type Item = U;
    type Error = Status;

    fn decode(&mut self, buffer: &mut DecodeBuf<'_>) -> Result<Option<U>, Status> {
        // The whole message is there, in one piece.
        let decoded = scan(&self.name, buffer.chunk()).and_then(|()| {
            U::decode(buffer).map_err(|_| Fault::Malformed {
                field: String::new(),
                problem: "is not a message of its type",
            })
        });
        match decoded {
            Ok(message) => Ok(Some(message)),
            Err(fault) => Err(fault.into()),
        }
    }
}
