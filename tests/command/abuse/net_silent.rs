//! Connections that send little or nothing, and hold their places.

use crate::abuse::harness::{attack_time, survives};
use crate::abuse::net_http2::{call, open};
use std::net::SocketAddr;
use std::time::{Duration, Instant};
use tokio::io::AsyncWriteExt as _;
use tokio::net::TcpStream;

/// More connections than the server allows.
const MANY: usize = 1200;

/// Opens many connections and holds them; each starts by sending these bytes.
async fn hold(address: SocketAddr, begin: &[u8]) {
    let mut held = Vec::new();
    for _ in 0..MANY {
        // One that is not accepted in time is part of the attack, too.
        let opened = tokio::time::timeout(Duration::from_millis(500), TcpStream::connect(address));
        if let Ok(Ok(mut stream)) = opened.await {
            let _ = stream.write_all(begin).await;
            held.push(stream);
        }
    }
    tokio::time::sleep(attack_time()).await;
}

#[test]
fn connections_that_come_and_go_disturb_nobody() {
    let server = survives(&[], |address| async move {
        let begun = Instant::now();
        while begun.elapsed() < attack_time() {
            let stream = TcpStream::connect(address).await.unwrap();
            stream.set_zero_linger().unwrap(); // closes with a reset
        }
    });
    let log = server.end();
    assert!(
        log.lines().count() <= 10,
        "{} lines: {}",
        log.lines().count(),
        &log[..log.len().min(500)]
    );
}

#[test]
fn silent_connections_lock_nobody_out() {
    survives(&[], |address| async move { hold(address, b"").await });
}

#[test]
fn half_a_handshake_locks_nobody_out() {
    survives(&[], |address| async move {
        hold(address, b"PRI * HTTP/2.0\r\n").await
    });
}

#[test]
fn half_a_page_request_locks_nobody_out() {
    survives(&[], |address| async move {
        hold(address, b"GET / HTTP/1.1\r\nhost: loc").await
    });
}

/// Every connection has a request that never ends, so that none of them is idle.
#[test]
fn requests_that_never_end_lock_nobody_out_of_health() {
    survives(&[], |address| async move {
        let mut held = Vec::new();
        for _ in 0..MANY {
            let opened = tokio::time::timeout(Duration::from_millis(500), open(address)).await;
            if let Ok(Ok(mut stream)) = opened {
                let _ = stream
                    .write_all(&call(1, "/sinew.v1.MotionService/PushMotion"))
                    .await;
                held.push(stream);
            }
        }
        tokio::time::sleep(attack_time()).await;
    });
}
