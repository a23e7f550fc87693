//! Every error gives a reason, whichever layer makes it: all calls with broken bytes, and failures before a call is
//! dispatched.

use crate::raw::Raw;
use crate::support::{TestServer, refusal};
use hyper_util::client::legacy::Client;
use hyper_util::client::legacy::connect::HttpConnector;
use hyper_util::rt::TokioExecutor;
use prost_reflect::{DescriptorPool, MethodDescriptor};
use sinew_wire::{DESCRIPTOR_SET, pb};
use std::time::{Duration, Instant};
use tonic::codegen::http::Uri;
use tonic::metadata::{MetadataMap, MetadataValue};
use tonic::{Code, Request, Status};

/// A connection without its own deadlines: tonic's channel ends calls by `grpc-timeout` like the server does.
#[derive(Clone)]
struct Connection {
    http: Client<HttpConnector, tonic::body::Body>,
    origin: Uri,
}

fn connection(server: &TestServer) -> Connection {
    let mut http = Client::builder(TokioExecutor::new());
    Connection {
        http: http.http2_only(true).build_http(),
        origin: format!("http://{}", server.address).parse().unwrap(),
    }
}

/// Result of a call that sends these messages.
async fn ends(
    connection: &Connection,
    path: &str,
    messages: Vec<Vec<u8>>,
    headers: &[(&'static str, &'static str)],
) -> Result<(), Status> {
    let Connection { http, origin } = connection.clone();
    let mut grpc = tonic::client::Grpc::with_origin(http, origin);
    grpc.ready().await.unwrap();
    let mut request = Request::new(tokio_stream::iter(messages));
    let metadata: &mut MetadataMap = request.metadata_mut();
    for (name, value) in headers {
        metadata.insert(*name, MetadataValue::from_static(value));
    }
    let answer = grpc.streaming(request, path.parse().unwrap(), Raw).await?;
    let mut answer = answer.into_inner();
    while answer.message().await?.is_some() {}
    Ok(())
}

fn methods() -> Vec<MethodDescriptor> {
    let pool = DescriptorPool::decode(DESCRIPTOR_SET).unwrap();
    let services: Vec<_> = pool.services().collect();
    services.iter().flat_map(|s| s.methods()).collect()
}

fn path(method: &MethodDescriptor) -> String {
    format!("/{}/{}", method.parent_service().full_name(), method.name())
}

#[tokio::test(flavor = "multi_thread")]
async fn broken_requests_of_every_call_are_told_why() {
    let small = [("max_request_bytes", "65536"), ("max_clip_bytes", "65536")];
    let server = TestServer::with(&small).await;
    let connection = connection(&server);
    let gzip = [("grpc-encoding", "gzip")];
    let all = methods();
    assert!(all.len() > 60);
    for method in &all {
        let path = path(method);
        // Bytes that are not a message, the beginning of a message, and a message above the limit.
        for (bytes, code, reason) in [
            (vec![0xff; 32], Code::InvalidArgument, "MALFORMED_MESSAGE"),
            (
                vec![0x0a, 0x7f, 0x61],
                Code::InvalidArgument,
                "MALFORMED_MESSAGE",
            ),
            (
                vec![0; 200_000],
                Code::ResourceExhausted,
                "MESSAGE_TOO_LARGE",
            ),
        ] {
            let e = ends(&connection, &path, vec![bytes], &[])
                .await
                .unwrap_err();
            let (got, why, _) = refusal(&e);
            assert_eq!((got, why.as_str()), (code, reason), "{path}: {e:?}");
        }
        // No message at all, and an unsupported encoding.
        let e = ends(&connection, &path, vec![], &[]).await.unwrap_err();
        assert_eq!(refusal(&e).0, Code::InvalidArgument, "{path}: {e:?}");
        let e = ends(&connection, &path, vec![vec![]], &gzip)
            .await
            .unwrap_err();
        assert_eq!(refusal(&e).1, "NOT_AVAILABLE", "{path}: {e:?}");
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn errors_of_libraries_have_a_reason_too() {
    let server = TestServer::start().await;
    let connection = connection(&server);
    for unknown in [
        "/sinew.v1.WorldService/Nothing",
        "/sinew.v1.NothingService/GetWorld",
        "/sinew.v2.WorldService/GetWorld",
    ] {
        let e = ends(&connection, unknown, vec![vec![]], &[])
            .await
            .unwrap_err();
        let (code, reason, _) = refusal(&e);
        assert_eq!(
            (code, reason.as_str()),
            (Code::Unimplemented, "NOT_AVAILABLE")
        );
    }
    // Health of a service that does not exist; field 1 is the name of the service.
    let service = vec![0x0a, 1, b'x'];
    let e = ends(
        &connection,
        "/grpc.health.v1.Health/Check",
        vec![service],
        &[],
    )
    .await;
    assert_eq!(refusal(&e.unwrap_err()).1, "RESOURCE_NOT_FOUND");
    // A deadline that the client gave: a wait of a minute for work that does not end.
    let work = pb::start_operation_request::Work::SimulateClip(pb::SimulateClipRequest {
        source: Some(pb::simulate_clip_request::Source::Clip("clips/walk".into())),
        duration_s: 100.0,
        rate_hz: 1000.0,
        r#loop: true,
        ..Default::default()
    });
    let request = pb::StartOperationRequest {
        work: Some(work),
        ..Default::default()
    };
    let started = server.client.operations().start_operation(request).await;
    let name = started.unwrap().into_inner().operation.unwrap().name;
    let wait = prost::Message::encode_to_vec(&pb::WaitOperationRequest {
        name,
        timeout: None,
    });
    let begun = Instant::now();
    let e = ends(
        &connection,
        "/sinew.v1.OperationService/WaitOperation",
        vec![wait],
        &[("grpc-timeout", "200m")],
    )
    .await
    .unwrap_err();
    let (code, reason, _) = refusal(&e);
    assert_eq!(
        (code, reason.as_str()),
        (Code::DeadlineExceeded, "DEADLINE_EXCEEDED")
    );
    assert!(begun.elapsed() < Duration::from_secs(20));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn one_connection_has_so_many_requests_at_a_time_and_learns_of_it() {
    let server = TestServer::with(&[("max_requests_per_connection", "2")]).await;
    let world = server.paused_world("w").await;
    let watch = || pb::WatchEventsRequest {
        world: world.clone(),
        ..Default::default()
    };
    let mut states = server.client.states();
    let one = states.watch_events(watch()).await.unwrap();
    let two = states.watch_events(watch()).await.unwrap();
    let e = states.watch_events(watch()).await.unwrap_err();
    let (code, reason, _) = refusal(&e);
    assert_eq!(
        (code, reason.as_str()),
        (Code::ResourceExhausted, "LIMIT_REACHED")
    );
    let other = sinew_client::Client::connect(&server.address.to_string())
        .await
        .unwrap();
    let get = pb::GetWorldRequest {
        name: world.clone(),
    };
    other.worlds().get_world(get).await.unwrap();
    drop((one, two));
    server.stop().await;
}
