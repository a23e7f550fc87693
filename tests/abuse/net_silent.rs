//! Connections that say nothing, or little.

use crate::harness::{attack_time, survives};
use std::net::SocketAddr;
use std::time::{Duration, Instant};
use tokio::net::TcpStream;

/// Opens up to `count` connections; what is refused or not answered within half a second is left out.
#[allow(dead_code)]
async fn connect(address: SocketAddr, count: usize) -> Vec<TcpStream> {
    let mut held = Vec::new();
    for _ in 0..count {
        let opened = tokio::time::timeout(Duration::from_millis(500), TcpStream::connect(address));
        if let Ok(Ok(stream)) = opened.await {
            held.push(stream);
        }
    }
    held
}

/// Connections that are opened and closed at once.
#[test]
fn connections_that_come_and_go_disturb_nobody() {
    survives(&[], |address| async move {
        let begun = Instant::now();
        while begun.elapsed() < attack_time() {
            let stream = TcpStream::connect(address).await.unwrap();
            stream.set_zero_linger().unwrap(); // closes with a reset
        }
    });
}
