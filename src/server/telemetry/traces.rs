//! Traces for an OpenTelemetry collector: a span of each call, and of a few ticks.
//!
//! Spans go through a bounded queue to their own thread, which drops those that it cannot send, so a slow or absent
//! collector holds nothing up. A client may name its trace; the settings decide whether it is sampled.

use crate::config::Config;
use axum::http::HeaderMap;
use opentelemetry::propagation::{Extractor, TextMapPropagator};
use opentelemetry::trace::{
    Link, Span as _, SpanKind, Status, TraceContextExt as _, TraceId, Tracer as _,
    TracerProvider as _,
};
use opentelemetry::{Context, KeyValue};
use opentelemetry_otlp::{ExporterBuildError, SpanExporter, WithExportConfig as _};
use opentelemetry_sdk::Resource;
use opentelemetry_sdk::propagation::TraceContextPropagator;
use opentelemetry_sdk::trace::{
    Sampler, SamplingResult, SdkTracer, SdkTracerProvider, ShouldSample, Span,
};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime};

/// Codes that are the server's fault, as the conventions for spans of servers have it.
const FAULTS: [&str; 6] = [
    "UNKNOWN",
    "DEADLINE_EXCEEDED",
    "UNIMPLEMENTED",
    "INTERNAL",
    "UNAVAILABLE",
    "DATA_LOSS",
];

/// Destination of spans.
struct Traces {
    tracer: SdkTracer,
    /// One tick out of this many has a span; 0: none.
    ticks: u64,
    tick: AtomicU64,
}

static TRACES: OnceLock<Traces> = OnceLock::new();

/// Samples calls by their trace, so that all parts of one trace are treated alike. All other spans are kept, because
/// the code that makes them has already chosen.
#[derive(Clone, Debug)]
struct Sampling(Sampler);

impl ShouldSample for Sampling {
    fn should_sample(
        &self,
        parent: Option<&Context>,
        trace: TraceId,
        name: &str,
        kind: &SpanKind,
        attributes: &[KeyValue],
        links: &[Link],
    ) -> SamplingResult {
        let sampler = match kind {
            SpanKind::Server => &self.0,
            _ => &Sampler::AlwaysOn,
        };
        sampler.should_sample(parent, trace, name, kind, attributes, links)
    }
}

/// Sends the last spans when the server ends.
#[derive(Debug)]
pub struct Sender(SdkTracerProvider);

impl Sender {
    /// Sends the remaining spans.
    pub async fn close(self) {
        let closed = tokio::task::spawn_blocking(move || self.0.shutdown()).await;
        if let Ok(Err(e)) = closed {
            tracing::warn!("the last spans were not sent: {e}");
        }
    }
}

/// Begins to send spans, if the settings name a collector. Only the first server of a process does. Called within a
/// runtime, which carries the connection.
///
/// # Errors
/// The address is not valid.
pub fn start(config: &Config) -> Result<Option<Sender>, ExporterBuildError> {
    if config.otlp_endpoint.is_empty() {
        return Ok(None);
    }
    let exporter = SpanExporter::builder()
        .with_tonic()
        .with_endpoint(config.otlp_endpoint.clone())
        .build()?;
    let resource = Resource::builder()
        .with_service_name("sinew")
        .with_attribute(KeyValue::new("service.version", env!("CARGO_PKG_VERSION")))
        .build();
    let provider = SdkTracerProvider::builder()
        .with_batch_exporter(exporter)
        .with_sampler(Sampling(Sampler::TraceIdRatioBased(config.otlp_call_share)))
        .with_resource(resource)
        .build();
    let traces = Traces {
        tracer: provider.tracer("sinew"),
        ticks: if config.otlp_tick_share > 0.0 {
            (1.0 / config.otlp_tick_share).round() as u64
        } else {
            0
        },
        tick: AtomicU64::new(0),
    };
    Ok(TRACES.set(traces).is_ok().then_some(Sender(provider)))
}

struct Headers<'a>(&'a HeaderMap);

impl Extractor for Headers<'_> {
    fn get(&self, key: &str) -> Option<&str> {
        self.0.get(key)?.to_str().ok()
    }
    fn keys(&self) -> Vec<&str> {
        self.0.keys().map(http::HeaderName::as_str).collect()
    }
}

/// The span of a call.
pub(super) struct CallSpan(Span);

/// Begins the span of a call of one of the protos; health and reflection have none.
pub(super) fn begin(method: Option<&'static str>, headers: &HeaderMap) -> Option<CallSpan> {
    let (traces, path) = (TRACES.get()?, method?.trim_start_matches('/'));
    let (service, name) = path.split_once('/')?;
    let parent =
        TraceContextPropagator::new().extract_with_context(&Context::new(), &Headers(headers));
    let span = traces
        .tracer
        .span_builder(path)
        .with_kind(SpanKind::Server)
        .with_attributes([
            KeyValue::new("rpc.system", "grpc"),
            KeyValue::new("rpc.service", service),
            KeyValue::new("rpc.method", name),
        ])
        .start_with_context(&traces.tracer, &parent);
    Some(CallSpan(span))
}

impl CallSpan {
    /// Ends it with its code, and the kind of the calling principal.
    pub(super) fn end(mut self, name: &'static str, code: usize, principal: Option<&'static str>) {
        let span = &mut self.0;
        span.set_attribute(KeyValue::new("rpc.grpc.status_code", code as i64));
        span.set_attribute(KeyValue::new("rpc.response.status_code", name));
        if let Some(kind) = principal {
            span.set_attribute(KeyValue::new("sinew.principal.kind", kind));
        }
        if FAULTS.contains(&name) {
            span.set_status(Status::error(name));
        }
        span.end();
    }
}

/// Makes the spans of a tick that ends now, for a few ticks only. Those of its stages, with `names` and `times`, follow
/// one another.
pub(crate) fn tick(names: &[&'static str], times: &[Duration]) {
    let Some(traces) = TRACES.get().filter(|t| t.ticks > 0) else {
        return;
    };
    if traces.tick.fetch_add(1, Ordering::Relaxed) % traces.ticks != 0 {
        return;
    }
    let mut at = SystemTime::now() - times.iter().sum::<Duration>();
    let begin = |name: &'static str, at, parent: &Context| {
        traces
            .tracer
            .span_builder(name)
            .with_start_time(at)
            .start_with_context(&traces.tracer, parent)
    };
    let tick = Context::new().with_span(begin("tick", at, &Context::new()));
    for (name, time) in names.iter().zip(times) {
        let mut stage = begin(name, at, &tick);
        at += *time;
        stage.end_with_timestamp(at);
    }
    tick.span().end_with_timestamp(at);
}
