//! The message of a watch, which the server encodes once for all viewers.
//!
//! Generated code would encode it again for each viewer. This type can hold the bytes of an encoded message instead:
//! sending it to one more viewer then copies bytes and does nothing else.

use super::pb::{Roster, WorldFrame};
use prost::bytes::{Buf, BufMut, Bytes};
use prost::encoding::{DecodeContext, WireType, message, skip_field};
use prost::{DecodeError, Message};

/// `sinew.v1.WatchWorldResponse`.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum WatchWorldResponse {
    /// Neither roster nor frame: a message from a newer server.
    #[default]
    Unknown,
    /// The figures by index from now on.
    Roster(Box<Roster>),
    /// A frame.
    Frame(Box<WorldFrame>),
    /// Either of these, already encoded as this message. Only sent, never received.
    Encoded(Bytes),
}

const ROSTER: u32 = 1;
const FRAME: u32 = 2;

impl WatchWorldResponse {
    /// The same message as bytes that can be shared.
    pub fn share(&self) -> Bytes {
        match self {
            Self::Encoded(bytes) => bytes.clone(),
            other => other.encode_to_vec().into(),
        }
    }
}

impl Message for WatchWorldResponse {
    fn encode_raw(&self, buf: &mut impl BufMut) {
        match self {
            Self::Unknown => {}
            Self::Roster(m) => message::encode(ROSTER, m.as_ref(), buf),
            Self::Frame(m) => message::encode(FRAME, m.as_ref(), buf),
            Self::Encoded(bytes) => buf.put_slice(bytes),
        }
    }

    fn merge_field(
        &mut self,
        tag: u32,
        wire_type: WireType,
        buf: &mut impl Buf,
        ctx: DecodeContext,
    ) -> Result<(), DecodeError> {
        match tag {
            ROSTER => {
                let mut m = match std::mem::take(self) {
                    Self::Roster(m) => m,
                    _ => Box::default(),
                };
                message::merge(wire_type, m.as_mut(), buf, ctx)?;
                *self = Self::Roster(m);
                Ok(())
            }
            FRAME => {
                let mut m = match std::mem::take(self) {
                    Self::Frame(m) => m,
                    _ => Box::default(),
                };
                message::merge(wire_type, m.as_mut(), buf, ctx)?;
                *self = Self::Frame(m);
                Ok(())
            }
            _ => skip_field(wire_type, tag, buf, ctx),
        }
    }

    fn encoded_len(&self) -> usize {
        match self {
            Self::Unknown => 0,
            Self::Roster(m) => message::encoded_len(ROSTER, m.as_ref()),
            Self::Frame(m) => message::encoded_len(FRAME, m.as_ref()),
            Self::Encoded(bytes) => bytes.len(),
        }
    }

    fn clear(&mut self) {
        *self = Self::Unknown;
    }
}

impl prost::Name for WatchWorldResponse {
    const NAME: &'static str = "WatchWorldResponse";
    const PACKAGE: &'static str = "sinew.v1";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_bytes_decode_to_the_message_they_came_from() {
        let frame = WatchWorldResponse::Frame(Box::new(WorldFrame {
            tick: 7,
            time_s: 0.5,
            ..Default::default()
        }));
        let shared = WatchWorldResponse::Encoded(frame.share());
        assert_eq!(shared.encoded_len(), frame.encoded_len());
        let back = WatchWorldResponse::decode(shared.encode_to_vec().as_slice()).unwrap();
        assert_eq!(back, frame);
        let roster = WatchWorldResponse::Roster(Box::new(Roster {
            world: "worlds/a".into(),
            ..Default::default()
        }));
        assert_eq!(WatchWorldResponse::decode(roster.share()).unwrap(), roster);
        // A field of a newer version is skipped.
        assert_eq!(
            WatchWorldResponse::decode(&[0x2a, 1, 0][..]).unwrap(),
            WatchWorldResponse::Unknown
        );
    }
}
