//! Traces as a collector receives them. Method: a collector and the real server, both in this process.

use opentelemetry_proto::tonic::collector::trace::v1::trace_service_server::{
    TraceService, TraceServiceServer,
};
use opentelemetry_proto::tonic::collector::trace::v1::{
    ExportTraceServiceRequest, ExportTraceServiceResponse,
};
use opentelemetry_proto::tonic::common::v1::any_value::Value;
use opentelemetry_proto::tonic::trace::v1::Span;
use sinew_client::Client;
use sinew_server::config::Config;
use sinew_wire::pb;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio_stream::wrappers::TcpListenerStream;
use tonic::{Code, Request, Response, Status};

/// Stores the requests that it receives.
#[derive(Clone, Default)]
struct Collector(Arc<Mutex<Vec<ExportTraceServiceRequest>>>);

#[tonic::async_trait]
impl TraceService for Collector {
    async fn export(
        &self,
        request: Request<ExportTraceServiceRequest>,
    ) -> Result<Response<ExportTraceServiceResponse>, Status> {
        self.0.lock().unwrap().push(request.into_inner());
        Ok(Response::new(ExportTraceServiceResponse::default()))
    }
}

impl Collector {
    async fn start() -> (Self, String) {
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = format!("http://{}", listener.local_addr().unwrap());
        let collector = Self::default();
        let service = TraceServiceServer::new(collector.clone());
        let serving = tonic::transport::Server::builder()
            .add_service(service)
            .serve_with_incoming(TcpListenerStream::new(listener));
        tokio::spawn(serving);
        (collector, address)
    }

    fn spans(&self) -> Vec<Span> {
        let all = self.0.lock().unwrap();
        let resources = all.iter().flat_map(|r| &r.resource_spans);
        let scopes = resources.flat_map(|r| &r.scope_spans);
        scopes.flat_map(|s| s.spans.clone()).collect()
    }

    fn service_names(&self) -> Vec<Option<Value>> {
        let all = self.0.lock().unwrap();
        let resources = all.iter().flat_map(|r| &r.resource_spans);
        resources
            .map(|r| {
                let resource = r.resource.as_ref().unwrap();
                let name = resource.attributes.iter().find(|a| a.key == "service.name");
                name.and_then(|a| a.value.clone()?.value)
            })
            .collect()
    }
}

fn attribute(span: &Span, key: &str) -> Option<Value> {
    let found = span.attributes.iter().find(|a| a.key == key)?;
    found.value.clone()?.value
}

fn text(value: &str) -> Option<Value> {
    Some(Value::StringValue(value.into()))
}

/// Calls with and without a token, good and bad, within a trace of the client; a world that ticks; then the server
/// ends, which sends the remaining spans.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "a process has one collector, which would see the other tests of this one: `make rust` runs it alone"]
async fn a_collector_receives_calls_and_a_few_ticks() {
    let (collector, endpoint) = Collector::start().await;
    let flags = [
        ("otlp_endpoint", endpoint.as_str()),
        ("otlp_tick_share", "0.1"),
        ("lame_duck_s", "0"),
        ("max_tick_budget", "1000"),
    ];
    let flags: Vec<_> = flags.map(|(a, b)| (a.to_owned(), b.to_owned())).into();
    let config = Config::load(None, std::iter::empty(), &flags).unwrap();
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
    let server = tokio::spawn(sinew_server::run(config, listener, async {
        let _ = stopped.await;
    }));
    let client = Client::connect(&address).await.unwrap();

    let trace = "0af7651916cd43dd8448eb211c80319c";
    let mut request = Request::new(pb::CreateWorldRequest {
        world_id: "w".into(),
        ..Default::default()
    });
    let parent = format!("00-{trace}-b7ad6b7169203331-01");
    request
        .metadata_mut()
        .insert("traceparent", parent.parse().unwrap());
    client.worlds().create_world(request).await.unwrap();
    let missing = pb::GetWorldRequest {
        name: "worlds/secret-name".into(),
    };
    let refused = client.worlds().get_world(missing).await.unwrap_err();
    assert_eq!(refused.code(), Code::NotFound);
    assert!(client.serves().await.unwrap()); // health has no span
    tokio::time::sleep(Duration::from_secs(2)).await; // 120 ticks
    drop(client);
    drop(stop);
    server.await.unwrap().unwrap();

    let spans = collector.spans();
    let named = |name: &str| spans.iter().filter(|s| s.name == name).collect::<Vec<_>>();
    let [created] = named("sinew.v1.WorldService/CreateWorld")[..] else {
        panic!("{spans:?}")
    };
    assert_eq!(attribute(created, "rpc.system"), text("grpc"));
    assert_eq!(
        attribute(created, "rpc.service"),
        text("sinew.v1.WorldService")
    );
    assert_eq!(attribute(created, "rpc.method"), text("CreateWorld"));
    assert_eq!(
        attribute(created, "rpc.grpc.status_code"),
        Some(Value::IntValue(0))
    );
    assert_eq!(
        attribute(created, "sinew.principal.kind"),
        text("anonymous")
    );
    assert!(created.end_time_unix_nano > created.start_time_unix_nano);
    assert_eq!(
        hex::encode(&created.trace_id),
        trace,
        "it is part of its caller's trace"
    );
    assert_eq!(hex::encode(&created.parent_span_id), "b7ad6b7169203331");

    let [missing] = named("sinew.v1.WorldService/GetWorld")[..] else {
        panic!("{spans:?}")
    };
    assert_eq!(
        attribute(missing, "rpc.response.status_code"),
        text("NOT_FOUND")
    );
    assert_eq!(
        missing.status.as_ref().map_or(0, |s| s.code),
        0,
        "the client's fault"
    );
    assert!(!format!("{spans:?}").contains("secret-name"), "no names");
    assert!(spans.iter().all(|s| !s.name.contains("Health")));

    // One tick in ten, with its stages one after the other within it.
    let ticks = named("tick");
    assert!((5..=20).contains(&ticks.len()), "{} ticks", ticks.len());
    for tick in &ticks {
        let mut stages: Vec<_> = spans
            .iter()
            .filter(|s| s.parent_span_id == tick.span_id)
            .collect();
        stages.sort_by_key(|s| s.start_time_unix_nano);
        let names: Vec<_> = stages.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["commands", "motion", "step", "publish"]);
        assert_eq!(stages[0].start_time_unix_nano, tick.start_time_unix_nano);
        assert_eq!(stages[3].end_time_unix_nano, tick.end_time_unix_nano);
        for pair in stages.windows(2) {
            assert_eq!(pair[0].end_time_unix_nano, pair[1].start_time_unix_nano);
        }
    }
    assert!(!collector.service_names().is_empty());
    assert!(
        collector
            .service_names()
            .iter()
            .all(|n| *n == text("sinew"))
    );
}
