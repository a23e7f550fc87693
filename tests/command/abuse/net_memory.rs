//! Requests that are small for their sender and large for the server.

use crate::abuse::harness::{attack_time, survives};
use crate::abuse::net_http2::{DATA, call, frame, open};
use crate::raw::Raw;
use sinew_client::Client;
use sinew_wire::frame::FIELD_NAMES;
use sinew_wire::pb;
use std::net::SocketAddr;
use std::time::{Duration, Instant};
use tokio::io::AsyncWriteExt as _;
use tonic::codegen::http::uri::PathAndQuery;
use tonic::transport::Endpoint;

const PUSH: &str = "/sinew.v1.MotionService/PushMotion";
const CLIP: &str = "/sinew.v1.MotionService/CreateClip";

/// A field of length-delimited bytes.
fn field(number: u8, inner: &[u8]) -> Vec<u8> {
    let mut out = vec![number << 3 | 2];
    prost::encoding::encode_varint(inner.len() as u64, &mut out);
    out.extend_from_slice(inner);
    out
}

/// Calls repeatedly with these bytes, over four connections and as fast as the server accepts them.
async fn four(address: SocketAddr, path: &'static str, bytes: Vec<u8>) {
    let begun = Instant::now();
    let send = async || {
        let endpoint = Endpoint::from_shared(format!("http://{address}")).unwrap();
        let mut refused = 0;
        while begun.elapsed() < attack_time() {
            let mut grpc = tonic::client::Grpc::new(endpoint.connect().await.unwrap());
            grpc.ready().await.unwrap();
            let request = tonic::Request::new(bytes.clone());
            let answer = grpc.unary(request, PathAndQuery::from_static(path), Raw);
            let answer = answer.await.map(|_| ());
            assert!(answer.is_err(), "the server takes it");
            refused += 1;
        }
        refused
    };
    let refused = tokio::join!(send(), send(), send(), send());
    eprintln!("refused: {refused:?}");
}

/// Sixteen megabytes of empty figures, four times at once: 3.3 GB decoded.
#[test]
fn empty_elements_take_no_memory() {
    let figures = [3 << 3 | 2, 0].repeat(8_000_000);
    let batch = field(2, &field(1, &figures));
    survives(
        &[],
        |address| async move { four(address, PUSH, batch).await },
    );
}

/// The same for a call that accepts large messages.
#[test]
fn empty_frames_of_a_clip_take_no_memory() {
    let frames = field(5, &[2 << 3 | 2, 0].repeat(8_000_000));
    survives(
        &[],
        |address| async move { four(address, CLIP, frames).await },
    );
}

/// Messages of five bytes that announce sixteen megabytes.
#[test]
fn announced_messages_take_no_memory() {
    survives(&[], |address| async move {
        let announced = [&[0][..], &16_000_000_u32.to_be_bytes()].concat();
        let mut held = Vec::new();
        for _ in 0..16 {
            let mut stream = open(address).await.unwrap();
            for i in (1..400).step_by(2) {
                let bytes = [call(i, CLIP), frame(DATA, 0, i, &announced)].concat();
                if stream.write_all(&bytes).await.is_err() {
                    break;
                }
            }
            held.push(stream);
        }
        tokio::time::sleep(attack_time()).await;
    });
}

async fn world(client: &Client, figures: usize, paused: bool) -> String {
    let request = pb::CreateWorldRequest {
        world_id: "w".into(),
        world: None,
        paused,
        ..Default::default()
    };
    let created = client.worlds().create_world(request).await.unwrap();
    let world = created.into_inner().world.unwrap().name;
    for i in 0..figures {
        let figure = pb::CreateFigureRequest {
            parent: world.clone(),
            figure_id: format!("f{i}"),
            figure: Some(pb::Figure {
                placement: Some(pb::Placement {
                    x_m: 3.0 * i as f64,
                    ..Default::default()
                }),
                ..Default::default()
            }),
            ..Default::default()
        };
        client.figures().create_figure(figure).await.unwrap();
    }
    world
}

/// A world is stepped as fast as possible, and nothing reads the metrics.
#[test]
fn stepping_leaves_nothing_behind() {
    let (used, after) = std::sync::mpsc::sync_channel(1);
    // The permitted memory of these ticks is small compared with the data that they would leave.
    let settings = [("max_world_memory_bytes", "4194304")];
    let server = survives(&settings, |address| async move {
        let client = Client::connect(&address.to_string()).await.unwrap();
        let name = world(&client, 0, true).await;
        let begun = Instant::now();
        let mut ticks = 0;
        while begun.elapsed() < 2 * attack_time() {
            let request = pb::StepWorldRequest {
                name: name.clone(),
                tick_count: 10_000,
                ..Default::default()
            };
            client.worlds().step_world(request).await.unwrap();
            ticks += 10_000;
        }
        used.send(ticks).unwrap();
    });
    let ticks = after.recv().unwrap();
    let added = server.added_kib();
    eprintln!("{ticks} ticks added {} MB", added / 1024);
    assert!(added < 24 * 1024, "{added} KiB after {ticks} ticks");
}

/// Viewers that resume with the largest view and never read; one that reads gets its frames.
#[test]
fn viewers_that_never_read_take_no_memory_and_no_frames_of_others() {
    let settings = [
        ("max_unread_bytes", "16777216"),
        ("max_connections_per_address", "1000"),
    ];
    survives(&settings, |address| async move {
        let client = Client::connect(&address.to_string()).await.unwrap();
        let name = world(&client, 24, false).await;
        tokio::time::sleep(Duration::from_secs(1)).await; // a history to resume from
        let largest = pb::View {
            fields: Some(prost_types::FieldMask {
                paths: FIELD_NAMES.map(str::to_owned).to_vec(),
            }),
            encoding: pb::Encoding::Double.into(),
            ..Default::default()
        };
        let tick = client
            .watch(&name, pb::View::default(), None)
            .await
            .unwrap();
        drop(tick);
        let mut stalled = Vec::new();
        let begun = Instant::now();
        let reading = async {
            let mut frames = client
                .watch(&name, pb::View::default(), None)
                .await
                .unwrap();
            let (mut first, mut last, mut count) = (None, 0, 0);
            while begun.elapsed() < attack_time() + Duration::from_secs(1) {
                let next = frames.message().await.unwrap().unwrap();
                if let sinew_wire::watched::WatchWorldResponse::Frame(f) = next {
                    first.get_or_insert(f.tick);
                    last = f.tick;
                    count += 1;
                }
            }
            (last - first.unwrap() + 1, count)
        };
        let stalling = async {
            while begun.elapsed() < attack_time() {
                let Ok(other) = Client::connect(&address.to_string()).await else {
                    continue;
                };
                let mut states = client.states();
                let now = states.get_world_frame(pb::GetWorldFrameRequest {
                    world: name.clone(),
                    ..Default::default()
                });
                let now = now.await.unwrap().into_inner().frame.unwrap().tick;
                let resumed = other
                    .watch(&name, largest.clone(), Some((now - 50).max(0)))
                    .await;
                if let Ok(frames) = resumed {
                    stalled.push((other, frames));
                }
            }
            stalled.len()
        };
        let ((ticks, frames), viewers) = tokio::join!(reading, stalling);
        eprintln!(
            "{viewers} viewers that never read; one that reads got {frames} of {ticks} frames"
        );
        assert!(viewers > 20, "{viewers}");
        assert!(frames * 10 >= ticks * 8, "{frames} of {ticks} frames");
    });
}
