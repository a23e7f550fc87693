//! The vectors of `tests/conformance` against the server in this process. The same files are read in Python and
//! TypeScript.

use crate::support::TestServer;
use prost::Message;
use prost_reflect::{DescriptorPool, DynamicMessage, MessageDescriptor, MethodDescriptor};
use prost_reflect::{DeserializeOptions, SerializeOptions};
use serde_json::{Map, Value};
use tonic::codec::{Codec, DecodeBuf, Decoder, EncodeBuf, Encoder};
use tonic::transport::{Channel, Endpoint};
use tonic::{Code, Request, Status};
use tonic_types::StatusExt;

/// Messages as bytes, so that exactly the bytes of the vector are sent.
#[derive(Default)]
struct Raw;

impl Codec for Raw {
    type Encode = Vec<u8>;
    type Decode = Vec<u8>;
    type Encoder = Self;
    type Decoder = Self;
    fn encoder(&mut self) -> Self {
        Self
    }
    fn decoder(&mut self) -> Self {
        Self
    }
}

impl Encoder for Raw {
    type Item = Vec<u8>;
    type Error = Status;
    fn encode(&mut self, item: Vec<u8>, out: &mut EncodeBuf<'_>) -> Result<(), Status> {
        bytes::BufMut::put_slice(out, &item);
        Ok(())
    }
}

impl Decoder for Raw {
    type Item = Vec<u8>;
    type Error = Status;
    fn decode(&mut self, from: &mut DecodeBuf<'_>) -> Result<Option<Vec<u8>>, Status> {
        let mut item = vec![0; bytes::Buf::remaining(from)];
        bytes::Buf::copy_to_slice(from, &mut item);
        Ok(Some(item))
    }
}

fn from_json(kind: MessageDescriptor, json: &Value) -> DynamicMessage {
    let options = DeserializeOptions::new();
    DynamicMessage::deserialize_with_options(kind, json, &options).unwrap()
}

fn to_json(message: &DynamicMessage) -> Value {
    let options = SerializeOptions::new();
    message
        .serialize_with_options(serde_json::value::Serializer, &options)
        .unwrap()
}

/// The request as the vector writes it; fails unless its binary form is the vector's, both ways.
fn request(method: &MethodDescriptor, vector: &Value) -> Vec<u8> {
    let wire = hex::decode(vector["wire"].as_str().unwrap()).unwrap();
    let written = from_json(method.input(), &vector["request"]).encode_to_vec();
    assert_eq!(hex::encode(&written), hex::encode(&wire), "written");
    let read = DynamicMessage::decode(method.input(), wire.as_slice()).unwrap();
    assert_eq!(read.encode_to_vec(), wire, "read and written again");
    wire
}

async fn send(
    channel: &Channel,
    method: &MethodDescriptor,
    wire: Vec<u8>,
) -> Result<Vec<u8>, Status> {
    let mut grpc = tonic::client::Grpc::new(channel.clone());
    grpc.ready().await.unwrap();
    let path = format!("/{}/{}", method.parent_service().full_name(), method.name());
    let path = path.parse().unwrap();
    if method.is_server_streaming() {
        let stream = grpc.server_streaming(Request::new(wire), path, Raw).await?;
        let first = stream.into_inner().message().await?;
        Ok(first.expect("a stream that is not refused has a first message"))
    } else {
        let response = grpc.unary(Request::new(wire), path, Raw).await?;
        Ok(response.into_inner())
    }
}

/// Whether a value stands for an absent member.
fn is_default(v: &Value) -> bool {
    match v {
        Value::Null => true,
        Value::Bool(b) => !b,
        Value::Number(n) => n.as_f64() == Some(0.0),
        Value::String(s) => s.is_empty() || s == "0",
        Value::Array(a) => a.is_empty(),
        Value::Object(_) => false,
    }
}

/// Whether `wanted` is part of `got`; the path of the first difference otherwise.
fn part_of(wanted: &Value, got: &Value, at: &str) -> Result<(), String> {
    let differs = || Err(format!("{at}: {got} instead of {wanted}"));
    match (wanted, got) {
        (Value::Object(w), Value::Object(g)) => {
            for (name, value) in w {
                let at = format!("{at}.{name}");
                match g.get(name) {
                    Some(found) => part_of(value, found, &at)?,
                    None if is_default(value) => {}
                    None => return Err(format!("{at}: absent instead of {value}")),
                }
            }
            Ok(())
        }
        (Value::Array(w), Value::Array(g)) if w.len() == g.len() => {
            for (i, (w, g)) in w.iter().zip(g).enumerate() {
                part_of(w, g, &format!("{at}[{i}]"))?;
            }
            Ok(())
        }
        (Value::Number(w), Value::Number(g)) => {
            let (w, g) = (w.as_f64().unwrap(), g.as_f64().unwrap());
            if (w - g).abs() <= 1e-9 * w.abs().max(g.abs()) {
                Ok(())
            } else {
                differs()
            }
        }
        _ if wanted == got => Ok(()),
        _ => differs(),
    }
}

/// Name of a code as vectors write it.
fn code_name(code: Code) -> String {
    let mut out = String::new();
    for c in format!("{code:?}").chars() {
        if c.is_ascii_uppercase() && !out.is_empty() && code != Code::Ok {
            out.push('_');
        }
        out.push(c.to_ascii_uppercase());
    }
    out
}

/// Result of a request, in the form of `outcome`.
fn outcome(answer: &Result<Vec<u8>, Status>) -> Map<String, Value> {
    let mut out = Map::new();
    let mut set = |name: &str, value: String| {
        if !value.is_empty() {
            out.insert(name.into(), value.into());
        }
    };
    match answer {
        Ok(_) => set("code", "OK".into()),
        Err(status) => {
            set("code", code_name(status.code()));
            let details = status.get_error_details();
            let info = details
                .error_info()
                .expect("every refusal has an ErrorInfo");
            assert_eq!(info.domain, "sinew");
            set("reason", info.reason.clone());
            if let Some(bad) = details.bad_request() {
                set("field", bad.field_violations[0].field.clone());
            }
            if let Some(resource) = details.resource_info() {
                set("resource", resource.resource_name.clone());
            }
        }
    }
    out
}

#[tokio::test(flavor = "multi_thread")]
async fn every_vector_has_the_outcome_it_names() {
    let pool = DescriptorPool::decode(sinew_wire::DESCRIPTOR_SET).unwrap();
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("tests/conformance");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    let server = TestServer::start().await;
    let channel = Endpoint::from_shared(format!("http://{}", server.address))
        .unwrap()
        .connect()
        .await
        .unwrap();
    let mut failures = Vec::new();
    for file in files {
        let scenario: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
        for vector in scenario["vectors"].as_array().unwrap() {
            let (service, name) = vector["method"].as_str().unwrap().split_once('/').unwrap();
            let service = pool.get_service_by_name(service).unwrap();
            let method = service.methods().find(|m| m.name() == name).unwrap();
            let answer = send(&channel, &method, request(&method, vector)).await;
            let mut wanted = vector["outcome"].as_object().unwrap().clone();
            let response = wanted.remove("response");
            let mut got = outcome(&answer);
            if !wanted.contains_key("resource") {
                got.remove("resource");
            }
            let mut problem = (wanted != got).then(|| format!("{got:?} instead of {wanted:?}"));
            if let (Some(response), Ok(bytes)) = (response, &answer) {
                let message = DynamicMessage::decode(method.output(), bytes.as_slice()).unwrap();
                problem = problem.or(part_of(&response, &to_json(&message), "response").err());
            }
            if let Some(problem) = problem {
                let file = file.file_name().unwrap().to_string_lossy().into_owned();
                failures.push(format!("{file} {}: {problem}", vector["name"]));
            }
        }
    }
    server.stop().await;
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
