//! Answers of calls that have one message: complete before the first byte is sent, so that the bytes waiting for a slow
//! reader are known and bounded. Answers that come encoded are sent from bytes that all their readers share.

use super::connections::Open;
use super::replies::WholeAnswer;
use super::state::Edge;
use crate::calls::answers_one_message;
use crate::encoded::Encoded;
use crate::telemetry::count_refusal;
use axum::body::{Body, Bytes};
use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue};
use axum::middleware::Next;
use axum::response::Response;
use http_body::{Body as HttpBody, Frame};
use std::collections::VecDeque;
use std::future::poll_fn;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use tonic::Status;

/// Answers up to this size are not counted: with `max_requests` they are bounded.
const UNCOUNTED: usize = 32 * 1024;
/// Bytes that are sent at a time.
const PIECE: usize = 64 * 1024;

/// Marks a response whose bytes are counted already.
#[derive(Clone, Copy)]
pub(super) struct Counted;

/// Completes answers, and refuses those for which there is no room.
pub(crate) async fn answers(
    State(edge): State<Arc<Edge>>,
    request: Request,
    next: Next,
) -> Response {
    let unary = answers_one_message(request.uri().path());
    let open = request.extensions().get::<Arc<Open>>().cloned();
    let response = next.run(request).await;
    match open {
        Some(open) if unary => whole(response, &edge, &open).await,
        _ => response,
    }
}

async fn whole(mut response: Response, edge: &Edge, open: &Arc<Open>) -> Response {
    let encoded = response.extensions_mut().remove::<Encoded>();
    let (mut parts, mut body) = response.into_parts();
    let mut answer = AnswerBody::default();
    match encoded {
        Some(encoded) => {
            let mut prefix = vec![0]; // not compressed
            prefix.extend((encoded.len() as u32).to_be_bytes());
            answer.pieces.push_back(prefix.into());
            answer.pieces.extend(encoded.into_pieces());
            let mut trailers = HeaderMap::new();
            trailers.insert("grpc-status", HeaderValue::from_static("0"));
            answer.last = Last::Trailers(trailers);
        }
        None if body.is_end_stream() => return Response::from_parts(parts, body),
        None => {
            // Encode it now; until then, the message with all its content would wait.
            match poll_fn(|cx| Poll::Ready(Pin::new(&mut body).poll_frame(cx))).await {
                Poll::Ready(Some(Ok(frame))) => match frame.into_data() {
                    Ok(data) => answer.pieces.push_back(data),
                    Err(other) => answer.first = Some(other),
                },
                Poll::Ready(Some(Err(error))) => {
                    return refused(Status::from_error(error.into_inner()));
                }
                Poll::Ready(None) | Poll::Pending => {}
            }
            answer.last = Last::Body(body);
        }
    }
    let bytes = answer.pieces.iter().map(Bytes::len).sum::<usize>();
    if bytes > UNCOUNTED {
        match edge.unread.add_whole(bytes as u64, open) {
            Ok(counted) => answer.counted = Some(counted),
            Err(fault) => {
                count_refusal(&fault);
                return refused(fault.into());
            }
        }
        parts.extensions.insert(Counted);
    }
    Response::from_parts(parts, Body::new(answer))
}

fn refused(status: Status) -> Response {
    status.into_http::<Body>()
}

/// The end of the response after the message.
#[derive(Default)]
enum Last {
    #[default]
    Nothing,
    Body(Body),
    Trailers(HeaderMap),
}

/// An answer on its way.
#[derive(Default)]
struct AnswerBody {
    first: Option<Frame<Bytes>>,
    pieces: VecDeque<Bytes>,
    last: Last,
    counted: Option<WholeAnswer>,
    /// Bytes of the piece that was sent last: it is on its way once the next one is asked for.
    sending: usize,
}

impl HttpBody for AnswerBody {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let sent = std::mem::take(&mut self.sending) as u64;
        if let Some(counted) = &mut self.counted {
            counted.sent(sent);
        }
        if let Some(first) = self.first.take() {
            return Poll::Ready(Some(Ok(first)));
        }
        while let Some(mut piece) = self.pieces.pop_front() {
            if piece.is_empty() {
                continue;
            }
            let rest = piece.split_off(piece.len().min(PIECE));
            if !rest.is_empty() {
                self.pieces.push_front(rest);
            }
            self.sending = piece.len();
            return Poll::Ready(Some(Ok(Frame::data(piece))));
        }
        self.counted = None;
        match &mut self.last {
            Last::Nothing => Poll::Ready(None),
            Last::Body(body) => Pin::new(body).poll_frame(cx),
            Last::Trailers(trailers) => {
                let trailers = std::mem::take(trailers);
                self.last = Last::Nothing;
                Poll::Ready(Some(Ok(Frame::trailers(trailers))))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::connections::Peer;
    use super::*;
    use crate::config::Config;
    use sinew_wire::pb;

    fn edge() -> Arc<Edge> {
        Edge::new(&Config {
            max_unread_bytes: 1_048_576,
            ..Config::default()
        })
    }

    async fn next(response: &mut Response) -> Option<Frame<Bytes>> {
        let frame = poll_fn(|cx| Pin::new(response.body_mut()).poll_frame(cx)).await;
        frame.map(Result::unwrap)
    }

    fn is_refused(response: &Response) -> bool {
        let status = Status::from_header_map(response.headers());
        status.is_some_and(|s| s.code() == tonic::Code::ResourceExhausted)
    }

    #[tokio::test]
    async fn answers_that_are_not_read_are_counted_and_share_their_bytes() {
        let (edge, open) = (edge(), Arc::new(Peer::alone().open()));
        let message = Encoded::of(&pb::GetServerInfoRequest::default()).then(Encoded::of(
            &pb::WatchWorldRequest {
                world: "x".repeat(600_000),
                ..Default::default()
            },
        ));
        let answer = async || {
            let mut response = Response::new(Body::empty());
            response.extensions_mut().insert(message.clone());
            whole(response, &edge, &open).await
        };
        let mut first = answer().await;
        assert!(first.extensions().get::<Counted>().is_some());
        // It is not read: a second one would wait beside it.
        assert!(is_refused(&answer().await));
        let (mut bytes, mut status) = (Vec::new(), None);
        while let Some(frame) = next(&mut first).await {
            match frame.into_data() {
                Ok(data) => {
                    assert!(data.len() <= PIECE);
                    bytes.extend_from_slice(&data);
                }
                Err(last) => status = last.into_trailers().ok(),
            }
        }
        assert_eq!(bytes[1..5], (message.len() as u32).to_be_bytes());
        assert_eq!(bytes[5..], message.clone().into_pieces().concat());
        assert_eq!(status.unwrap()["grpc-status"], "0");
        // It was read: there is room again, also when another one is given up half way.
        let mut second = answer().await;
        next(&mut second).await;
        drop(second);
        assert!(!is_refused(&answer().await));
    }

    #[tokio::test]
    async fn other_answers_are_counted_once_they_are_encoded() {
        let (edge, open) = (edge(), Arc::new(Peer::alone().open()));
        let answer = async |len: usize| {
            let response = Response::new(Body::from(vec![7; len]));
            whole(response, &edge, &open).await
        };
        let first = answer(600_000).await;
        assert!(is_refused(&answer(600_000).await));
        let mut small = answer(UNCOUNTED).await;
        assert!(!is_refused(&small));
        let data = next(&mut small).await.unwrap().into_data().unwrap();
        assert_eq!(data.len(), UNCOUNTED);
        drop(first);
        assert!(!is_refused(&answer(600_000).await));
    }

    #[test]
    fn calls_that_answer_with_a_stream_are_left_alone() {
        assert!(answers_one_message(
            "/sinew.v1.OperationService/GetOperation"
        ));
        assert!(answers_one_message(
            "/sinew.v1.CheckpointService/GetCheckpoint"
        ));
        assert!(!answers_one_message("/sinew.v1.StateService/WatchWorld"));
        assert!(!answers_one_message(
            "/sinew.v1.SimulationService/StreamSimulateClip"
        ));
    }
}
