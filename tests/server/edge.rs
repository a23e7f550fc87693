//! Input from strangers: bytes that are not a message, messages that are too large, calls meant for another host.

use crate::raw::Raw;
use crate::support::{TestServer, refusal, view};
use sinew_wire::pb;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tonic::codegen::http::uri::PathAndQuery;
use tonic::{Code, Request, Status};
use tonic_types::StatusExt as _;

async fn grpc(server: &TestServer) -> tonic::client::Grpc<tonic::transport::Channel> {
    let endpoint = tonic::transport::Endpoint::from_shared(format!("http://{}", server.address));
    let mut grpc = tonic::client::Grpc::new(endpoint.unwrap().connect().await.unwrap());
    grpc.ready().await.unwrap();
    grpc
}

/// The refusal of these bytes as a request.
async fn unary(server: &TestServer, path: &'static str, bytes: Vec<u8>) -> Status {
    let mut grpc = grpc(server).await;
    let path = PathAndQuery::from_static(path);
    grpc.unary(Request::new(bytes), path, Raw)
        .await
        .unwrap_err()
}

/// The first refusal of these bytes as messages of a stream.
async fn streamed(server: &TestServer, path: &'static str, messages: Vec<Vec<u8>>) -> Status {
    let mut grpc = grpc(server).await;
    let path = PathAndQuery::from_static(path);
    let request = Request::new(tokio_stream::iter(messages));
    let mut answers = match grpc.streaming(request, path, Raw).await {
        Ok(response) => response.into_inner(),
        Err(status) => return status,
    };
    loop {
        match answers.message().await {
            Ok(Some(())) => {}
            Ok(None) => panic!("ended without a refusal"),
            Err(status) => return status,
        }
    }
}

const PUSH: &str = "/sinew.v1.MotionService/PushMotion";
const CLIP: &str = "/sinew.v1.MotionService/CreateClip";
const DRIVE: &str = "/sinew.v1.MotionService/DriveFigures";

/// A field of length-delimited bytes.
fn field(number: u8, inner: &[u8]) -> Vec<u8> {
    let mut out = vec![number << 3 | 2];
    prost::encoding::encode_varint(inner.len() as u64, &mut out);
    out.extend_from_slice(inner);
    out
}

/// A batch with `count` empty figures in its only frame.
fn empty_figures(count: usize) -> Vec<u8> {
    field(2, &field(1, &[3 << 3 | 2, 0].repeat(count)))
}

/// The limit that a refusal names.
fn limit(status: &Status) -> String {
    let details = status.get_error_details();
    let info = details.error_info().unwrap().clone();
    info.metadata.get("limit").cloned().unwrap_or_default()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_message_with_too_many_elements_is_refused_before_it_is_decoded() {
    let server = TestServer::start().await;
    let refused = unary(&server, PUSH, empty_figures(200_000)).await;
    let (code, reason, path) = refusal(&refused);
    assert_eq!(
        (code, reason.as_str()),
        (Code::ResourceExhausted, "MESSAGE_TOO_LARGE")
    );
    assert!(path.starts_with("batch.frames[0].figures["), "{path}");
    assert_eq!(limit(&refused), "decoded_bytes");
    // A message of a stream likewise; the header and a good batch before it were taken.
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let header = field(1, &[field_text(1, &world), field_text(2, "a")].concat());
    let refused = streamed(&server, DRIVE, vec![header, empty_figures(200_000)]).await;
    assert_eq!(refusal(&refused).1, "MESSAGE_TOO_LARGE", "{refused:?}");
    server.stop().await;
}

fn field_text(number: u8, text: &str) -> Vec<u8> {
    field(number, text.as_bytes())
}

fn refused_field(status: &Status) -> (Code, String) {
    (status.code(), refusal(status).1)
}

#[tokio::test(flavor = "multi_thread")]
async fn only_calls_with_a_clip_take_large_messages() {
    let server = TestServer::start().await;
    let two_megabytes = field(15, &vec![0; 2_000_000]);
    let refused = unary(&server, PUSH, two_megabytes.clone()).await;
    assert_eq!(
        refused_field(&refused),
        (Code::ResourceExhausted, "MESSAGE_TOO_LARGE".into())
    );
    assert_eq!(limit(&refused), "max_request_bytes");
    let refused = streamed(&server, DRIVE, vec![two_megabytes.clone()]).await;
    assert_eq!(limit(&refused), "max_request_bytes", "{refused:?}");
    let refused = unary(&server, CLIP, two_megabytes).await;
    assert_eq!(refusal(&refused).2, "source", "it was read: {refused:?}");
    let refused = unary(&server, CLIP, field(15, &vec![0; 17_000_000])).await;
    assert_eq!(limit(&refused), "max_clip_bytes", "{refused:?}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bytes_that_are_no_message_are_refused_in_the_words_of_the_protos() {
    let server = TestServer::start().await;
    for (bytes, field) in [
        (vec![0xff], ""),
        (
            field(2, &field(1, &field(1, b"x"))),
            "batch.frames[0].sequence",
        ),
        (field(1, &field(1, &[0xff, 0xfe])), "header.world"),
    ] {
        let refused = unary(&server, PUSH, bytes).await;
        let expected = (
            Code::InvalidArgument,
            "MALFORMED_MESSAGE".to_owned(),
            field.to_owned(),
        );
        assert_eq!(refusal(&refused), expected, "{refused:?}");
        for word in ["prost", "Request", "::", "decode"] {
            assert!(!refused.message().contains(word), "{refused:?}");
        }
    }
    // No message, or two.
    for messages in [vec![], vec![vec![], vec![]]] {
        let refused = streamed(&server, PUSH, messages).await;
        assert_eq!(refusal(&refused).1, "MALFORMED_MESSAGE", "{refused:?}");
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_unknown_method_is_named() {
    let server = TestServer::start().await;
    for path in ["/sinew.v1.MotionService/Dance", "/some.Service/Method"] {
        let refused = unary(&server, path, vec![]).await;
        assert_eq!(refused.code(), Code::Unimplemented);
        assert!(refused.message().contains(path), "{refused:?}");
        assert_eq!(refusal(&refused).1, "NOT_AVAILABLE");
    }
    server.stop().await;
}

/// Status and text of an answer over HTTP/1.1.
async fn http1(server: &TestServer, request: &str) -> (u16, String) {
    let mut stream = tokio::net::TcpStream::connect(server.address)
        .await
        .unwrap();
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut out = Vec::new();
    stream.read_to_end(&mut out).await.unwrap();
    let text = String::from_utf8_lossy(&out).into_owned();
    (text[9..12].parse().unwrap(), text)
}

#[tokio::test(flavor = "multi_thread")]
async fn pages_under_foreign_names_reach_nothing() {
    let server = TestServer::with(&[
        ("allowed_hosts", "sinew.example"),
        ("allowed_origins", "https://app.example"),
    ])
    .await;
    let get = |path: &str, host: &str| {
        format!("GET {path} HTTP/1.1\r\nhost: {host}\r\nconnection: close\r\n\r\n")
    };
    for path in ["/", "/status", "/metrics"] {
        for good in ["localhost:1", "127.0.0.1", "sinew.example:80"] {
            assert_eq!(
                http1(&server, &get(path, good)).await.0,
                200,
                "{path} {good}"
            );
        }
        let (status, text) = http1(&server, &get(path, "evil.example")).await;
        assert_eq!(status, 403, "{path}");
        assert!(
            text.contains("evil.example") && text.contains("allowed_hosts"),
            "{text}"
        );
    }
    // gRPC-Web, as a page calls it.
    let web = |host: &str, origin: &str| {
        format!(
            "POST /sinew.v1.WorldService/ListWorlds HTTP/1.1\r\nhost: {host}\r\norigin: {origin}\r\nconnection: \
             close\r\ncontent-type: application/grpc-web+proto\r\ncontent-length: 5\r\n\r\n\0\0\0\0\0"
        )
    };
    for (host, origin, good) in [
        ("localhost:7463", "http://localhost:3000", true),
        ("localhost:7463", "https://app.example", true),
        ("sinew.example", "http://sinew.example", true),
        ("localhost:7463", "http://evil.example", false),
        ("evil.example", "http://evil.example", false),
        ("localhost:7463", "null", false),
    ] {
        let (_, text) = http1(&server, &web(host, origin)).await;
        let refused = text.contains("grpc-status: 7\r\n");
        let answered = text.contains("grpc-status:0");
        assert_eq!(
            (answered, refused),
            (good, !good),
            "{host} {origin}: {text}"
        );
    }
    // gRPC over HTTP/2, where the name is the authority.
    let endpoint =
        tonic::transport::Endpoint::from_shared(format!("http://{}", server.address)).unwrap();
    for (origin, expected) in [
        ("http://evil.example", Some("HOST_NOT_ALLOWED")),
        ("http://sinew.example", None),
    ] {
        let channel = endpoint
            .clone()
            .origin(origin.parse().unwrap())
            .connect()
            .await
            .unwrap();
        let mut worlds = pb::world_service_client::WorldServiceClient::new(channel);
        let answer = worlds.list_worlds(pb::ListWorldsRequest::default()).await;
        let reason = answer.err().map(|status| {
            assert_eq!(status.code(), Code::PermissionDenied);
            refusal(&status).1
        });
        assert_eq!(reason.as_deref(), expected, "{origin}");
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_silent_connection_is_closed_and_one_with_a_request_is_kept() {
    let server = TestServer::with(&[("first_request_s", "0.3")]).await;
    let mut silent = tokio::net::TcpStream::connect(server.address)
        .await
        .unwrap();
    let mut half = tokio::net::TcpStream::connect(server.address)
        .await
        .unwrap();
    half.write_all(b"PRI * HTTP/2.0\r\n").await.unwrap();
    // Handshakes without a request: the preface and empty settings.
    let mut idle = tokio::net::TcpStream::connect(server.address)
        .await
        .unwrap();
    idle.write_all(b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n\0\0\0\x04\0\0\0\0\0")
        .await
        .unwrap();
    let world = server.paused_world("w").await;
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    for stream in [&mut silent, &mut half, &mut idle] {
        let mut rest = Vec::new();
        let closed = stream.read_to_end(&mut rest);
        let closed = tokio::time::timeout(std::time::Duration::from_secs(20), closed).await;
        assert!(closed.is_ok(), "the server closes it");
    }
    // The client's connection is older than all of them.
    server.step(&world, 1).await;
    assert!(frames.message().await.unwrap().is_some());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn health_is_answered_when_all_connections_are_at_work() {
    let server = TestServer::with(&[
        ("max_connections", "1"),
        ("max_connections_per_address", "1"),
    ])
    .await;
    let world = server.paused_world("w").await;
    // The only place is in use as long as this watch continues.
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    let endpoint =
        tonic::transport::Endpoint::from_shared(format!("http://{}", server.address)).unwrap();
    let channel = endpoint.connect().await.unwrap();
    let mut health = tonic_health::pb::health_client::HealthClient::new(channel.clone());
    let request = tonic_health::pb::HealthCheckRequest::default();
    health.check(request).await.unwrap();
    let mut worlds = pb::world_service_client::WorldServiceClient::new(channel);
    let refused = worlds
        .list_worlds(pb::ListWorldsRequest::default())
        .await
        .unwrap_err();
    assert_eq!(limit(&refused), "max_connections", "{refused:?}");
    let page = "GET /metrics HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n";
    assert_eq!(http1(&server, page).await.0, 200);
    assert!(
        frames.message().await.unwrap().is_some(),
        "the watch goes on"
    );
    server.stop().await;
}
