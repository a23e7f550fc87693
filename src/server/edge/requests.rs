//! Sizes of requests, checked by the five bytes before each message, before memory is reserved for it.

use super::refusal::unknown_method;
use super::state::Edge;
use super::uploads::{Limit, Upload};
use crate::calls;
use crate::telemetry::count_refusal;
use axum::body::{Body, Bytes};
use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::Response;
use http_body::{Body as HttpBody, Frame, SizeHint};
use sinew_wire::status::Fault;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;
use tokio::sync::Semaphore;
use tokio::time::Sleep;
use tonic::Status;

/// Bytes in front of each message: a flag for compression and the length.
const PREFIX: usize = 5;

/// The gRPC code of an unknown method.
const UNIMPLEMENTED: &str = "12";
/// No memory is reserved for messages up to this size: `max_requests` bounds them, and large messages that arrive
/// slowly do not keep them out.
const UNCOUNTED: usize = 32 * 1024;
/// Time allowed for the arrival of a larger message: this, plus its size divided by [`SLOWEST`].
const MESSAGE_TIME: Duration = Duration::from_secs(5);
/// Least rate at which a larger message must arrive, bytes per second.
const SLOWEST: f64 = 262_144.0;

/// Bounds the sizes of a call's messages.
pub(crate) async fn sizes(State(edge): State<Arc<Edge>>, request: Request, next: Next) -> Response {
    let path = request.uri().path();
    let uploads = &edge.uploads;
    let limit = if calls::is_upload(path) {
        uploads.large
    } else {
        uploads.small
    };
    let called = path.to_owned();
    let held = Upload::default();
    let streams = !calls::takes_one_message(path);
    let mut request = request.map(|body| {
        Body::new(Sized {
            body,
            limit,
            free: uploads.free.clone(),
            most: uploads.most,
            held: held.clone(),
            streams,
            begun: false,
            prefix: [0; PREFIX],
            read: 0,
            left: 0,
            deadline: None,
            ended: false,
        })
    });
    // At least until the call is answered.
    request.extensions_mut().insert(held.clone());
    let response = next.run(request).await;
    drop(held);
    let header = |name: &str| response.headers().get(name);
    if header("grpc-status").is_some_and(|s| s == UNIMPLEMENTED) && header("grpc-message").is_none()
    {
        return unknown_method(&called); // a service would only report that it has no such method
    }
    response
}

/// A request whose messages are counted as they come.
struct Sized {
    body: Body,
    limit: Limit,
    free: Arc<Semaphore>,
    most: u64,
    /// Of the latest message.
    held: Upload,
    streams: bool,
    begun: bool,
    prefix: [u8; PREFIX],
    /// Bytes of the prefix that have arrived.
    read: usize,
    /// Bytes of the message still to come.
    left: usize,
    /// Deadline of a large message.
    deadline: Option<Pin<Box<Sleep>>>,
    ended: bool,
}

fn malformed(problem: &'static str) -> Fault {
    Fault::Malformed {
        field: String::new(),
        problem,
    }
}

impl Sized {
    fn count(&mut self, mut bytes: &[u8]) -> Result<(), Fault> {
        while !bytes.is_empty() {
            let payload = self.left.min(bytes.len());
            self.left -= payload;
            bytes = &bytes[payload..];
            if self.left > 0 {
                return Ok(());
            }
            self.deadline = None;
            if self.streams && payload > 0 {
                self.release(); // decoded and queued at once
            }
            let header = (PREFIX - self.read).min(bytes.len());
            self.prefix[self.read..self.read + header].copy_from_slice(&bytes[..header]);
            self.read += header;
            bytes = &bytes[header..];
            if self.read == PREFIX {
                self.read = 0;
                self.message()?;
            }
        }
        Ok(())
    }

    /// Handles the complete prefix of a message.
    fn message(&mut self) -> Result<(), Fault> {
        let [compressed, length @ ..] = self.prefix;
        let length = u32::from_be_bytes(length) as usize;
        if compressed != 0 {
            return Err(malformed(
                "the message is compressed, which this server does not take",
            ));
        }
        if std::mem::replace(&mut self.begun, true) && !self.streams {
            return Err(malformed("the call takes one message, more came"));
        }
        if length > self.limit.bytes {
            return Err(Fault::TooLarge {
                field: String::new(),
                limit: self.limit.name,
                value: self.limit.bytes as u64,
                message: format!("a message of {length} bytes"),
            });
        }
        self.left = length;
        if length <= UNCOUNTED {
            return Ok(());
        }
        let taken = self.free.clone().try_acquire_many_owned(length as u32);
        let taken = taken.map_err(|_| {
            self.exhausted(format!(
                "{length} bytes more of requests that are read or worked on"
            ))
        })?;
        self.held.set(Some(taken));
        let time = MESSAGE_TIME + Duration::from_secs_f64(length as f64 / SLOWEST);
        self.deadline = Some(Box::pin(tokio::time::sleep(time)));
        Ok(())
    }

    fn release(&self) {
        self.held.set(None);
    }

    fn exhausted(&self, message: String) -> Fault {
        Fault::Exhausted {
            limit: "max_pending_bytes",
            value: self.most,
            message,
            retry: Some(Duration::from_secs(1)),
        }
    }

    /// Whether a large message has missed its deadline.
    fn is_late(&mut self, cx: &mut Context<'_>) -> bool {
        self.deadline
            .as_mut()
            .is_some_and(|d| d.as_mut().poll(cx).is_ready())
    }

    /// The end of the request.
    fn end(&self) -> Result<(), Fault> {
        if self.left > 0 || self.read > 0 {
            Err(malformed("the request ends in the middle of a message"))
        } else if !self.begun && !self.streams {
            Err(malformed("the request has no message"))
        } else {
            Ok(())
        }
    }
}

impl HttpBody for Sized {
    type Data = Bytes;
    type Error = Status;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Status>>> {
        if self.ended {
            return Poll::Ready(None);
        }
        let frame = match Pin::new(&mut self.body).poll_frame(cx) {
            Poll::Ready(frame) => Some(frame),
            Poll::Pending if self.is_late(cx) => None,
            Poll::Pending => return Poll::Pending,
        };
        let checked = match &frame {
            None => Err(self.exhausted("the message comes too slowly to wait for it".to_owned())),
            // A broken connection is not a fault of the message.
            Some(Some(Err(_))) => Ok(()),
            Some(Some(Ok(frame))) => frame.data_ref().map_or(Ok(()), |data| self.count(data)),
            Some(None) => self.end(),
        };
        if let Err(fault) = checked {
            self.ended = true;
            count_refusal(&fault);
            return Poll::Ready(Some(Err(fault.into())));
        }
        Poll::Ready(
            frame
                .flatten()
                .map(|f| f.map_err(|e| Status::from_error(e.into_inner()))),
        )
    }

    fn is_end_stream(&self) -> bool {
        self.ended || (self.begun && self.left == 0 && self.read == 0 && self.body.is_end_stream())
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sized(limit: usize, most: usize, streams: bool) -> Sized {
        Sized {
            body: Body::empty(),
            limit: Limit {
                name: "max_request_bytes",
                bytes: limit,
            },
            free: Arc::new(Semaphore::new(most)),
            most: most as u64,
            held: Upload::default(),
            streams,
            begun: false,
            prefix: [0; PREFIX],
            read: 0,
            left: 0,
            deadline: None,
            ended: false,
        }
    }

    fn message(length: u32) -> Vec<u8> {
        let mut out = vec![0];
        out.extend(length.to_be_bytes());
        out.extend(vec![7; length as usize]);
        out
    }

    #[test]
    fn messages_are_counted_however_they_are_cut() {
        let stream = [message(3), message(0), message(10)].concat();
        for cut in 1..stream.len() {
            let mut s = sized(10, 10, true);
            for part in stream.chunks(cut) {
                s.count(part).unwrap();
            }
            s.end().unwrap();
            // A message of 11 bytes is refused by its prefix, wherever that is cut.
            let mut s = sized(10, 10, true);
            let long = [message(3), message(11)[..PREFIX].to_vec()].concat();
            let refused = long.chunks(cut).try_for_each(|part| s.count(part));
            assert!(
                matches!(refused, Err(Fault::TooLarge { value: 10, .. })),
                "{refused:?}"
            );
        }
    }

    #[tokio::test]
    async fn what_is_announced_is_set_aside_until_it_was_taken() {
        const LARGE: u32 = 100_000;
        let announced = &message(LARGE)[..PREFIX];
        for streams in [true, false] {
            let mut s = sized(LARGE as usize, 150_000, streams);
            let free = s.free.clone();
            s.count(announced).unwrap();
            assert_eq!(free.available_permits(), 50_000);
            let mut other = sized(LARGE as usize, 150_000, streams);
            other.free = free.clone();
            let refused = other.count(announced);
            assert!(
                matches!(
                    refused,
                    Err(Fault::Exhausted {
                        limit: "max_pending_bytes",
                        ..
                    })
                ),
                "{refused:?}"
            );
            // A small one still passes.
            let mut small = sized(LARGE as usize, 150_000, streams);
            small.free = free.clone();
            small.count(&message(1000)).unwrap();
            s.count(&vec![7; LARGE as usize]).unwrap();
            // A message of a stream is taken at once, that of a call with its answer.
            let kept = if streams { 0 } else { 100_000 };
            assert_eq!(free.available_permits(), 150_000 - kept);
            drop(s);
            assert_eq!(free.available_permits(), 150_000);
        }
    }

    #[test]
    fn a_unary_call_has_one_whole_message() {
        assert!(sized(10, 10, false).end().is_err(), "none");
        assert!(
            sized(10, 10, false)
                .count(&[message(1), message(1)].concat())
                .is_err(),
            "two"
        );
        let mut half = sized(10, 10, false);
        half.count(&message(9)[..8]).unwrap();
        assert!(half.end().is_err(), "half of one");
        assert!(
            sized(10, 10, false).count(&[1, 0, 0, 0, 0]).is_err(),
            "compressed"
        );
    }
}
