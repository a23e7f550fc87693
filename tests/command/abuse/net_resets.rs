//! Streams that are reset as soon as they are opened, by the client or, when tricked, by the server.

use crate::abuse::harness::{attack_time, survives};
use crate::abuse::net_http2::{GOAWAY, RST_STREAM, WINDOW_UPDATE, call, frame, kinds, open};
use std::net::SocketAddr;
use std::time::Instant;
use tokio::io::AsyncWriteExt as _;

const METHOD: &str = "/sinew.v1.WorldService/ListWorlds";

/// Opens streams on one connection after the other, each followed by `after`, until the server closes it.
async fn flood(address: SocketAddr, after: impl Fn(u32) -> Vec<u8>) {
    let begun = Instant::now();
    while begun.elapsed() < attack_time() {
        let Ok(mut stream) = open(address).await else {
            continue;
        };
        for i in (1..).step_by(2) {
            let bytes = [call(i, METHOD), after(i)].concat();
            if stream.write_all(&bytes).await.is_err() || begun.elapsed() > attack_time() {
                break;
            }
        }
    }
}

fn quiet(log: &str) {
    let lines = log.lines().count();
    assert!(lines <= 10, "{lines} lines: {}", &log[..log.len().min(500)]);
}

#[test]
fn rapid_resets_end_the_connection_and_fill_no_log() {
    let cancelled = |i| frame(RST_STREAM, 0, i, &8_u32.to_be_bytes());
    quiet(
        &survives(
            &[],
            |address| async move { flood(address, cancelled).await },
        )
        .end(),
    );
}

/// Two window updates that overflow: the server must reset the stream.
fn overflow(i: u32) -> Vec<u8> {
    frame(WINDOW_UPDATE, 0, i, &0x7fff_ffff_u32.to_be_bytes())
}

#[test]
fn resets_that_the_server_is_tricked_into_end_the_connection_and_fill_no_log() {
    quiet(&survives(&[], |address| async move { flood(address, overflow).await }).end());
}

#[test]
fn a_connection_is_closed_after_some_resets_by_the_server() {
    survives(&[], |address| async move {
        let mut stream = open(address).await.unwrap();
        // Fewer than the limit of open streams, so that none is refused for that reason.
        for i in (1..400).step_by(2) {
            let bytes = [call(i, METHOD), overflow(i)].concat();
            if stream.write_all(&bytes).await.is_err() {
                break;
            }
        }
        let came = kinds(&mut stream).await;
        let resets = came.iter().filter(|k| **k == RST_STREAM).count();
        assert!(resets <= 100, "{resets} resets");
        assert!(came.contains(&GOAWAY), "{came:?}");
    });
}
