//! The viewer over HTTP: content codings, tags and caching.

use crate::support::TestServer;
use flate2::read::GzDecoder;
use std::io::Read as _;
use std::net::SocketAddr;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};

/// The built files, as the repository has them.
const FILES: [(&str, &[u8]); 3] = [
    ("/", include_bytes!("../../clients/web/dist/index.html")),
    (
        "/viewer.js",
        include_bytes!("../../clients/web/dist/viewer.js"),
    ),
    (
        "/viewer.css",
        include_bytes!("../../clients/web/dist/viewer.css"),
    ),
];

struct Answer {
    status: u16,
    head: String,
    body: Vec<u8>,
}

impl Answer {
    fn header(&self, name: &str) -> Option<&str> {
        let lines = self.head.lines().filter_map(|l| l.split_once(": "));
        let mut values = lines.filter(|(n, _)| n.eq_ignore_ascii_case(name));
        values.next().map(|(_, value)| value)
    }

    fn unpacked(&self) -> Vec<u8> {
        let mut out = Vec::new();
        GzDecoder::new(&self.body[..])
            .read_to_end(&mut out)
            .unwrap();
        out
    }
}

/// One request over HTTP/1.1, byte by byte as a browser sends it.
async fn send(address: SocketAddr, request: &str) -> Answer {
    let mut stream = tokio::net::TcpStream::connect(address).await.unwrap();
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut out = Vec::new();
    stream.read_to_end(&mut out).await.unwrap();
    let end = out.windows(4).position(|w| w == b"\r\n\r\n").unwrap();
    let head = String::from_utf8(out[..end].to_vec()).unwrap();
    Answer {
        status: head[9..12].parse().unwrap(),
        head,
        body: out[end + 4..].to_vec(),
    }
}

async fn get(address: SocketAddr, path: &str, headers: &str) -> Answer {
    let request =
        format!("GET {path} HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n{headers}\r\n");
    send(address, &request).await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_viewer_is_compressed_for_clients_that_accept_it() {
    let server = TestServer::start().await;
    for (path, built) in FILES {
        let plain = get(server.address, path, "").await;
        assert_eq!(plain.status, 200);
        assert_eq!(plain.header("content-encoding"), None, "{path}");
        assert_eq!(plain.header("vary"), Some("accept-encoding"), "{path}");
        assert!(plain.body == built, "{path}: not the built file");

        let accepted = "accept-encoding: gzip, deflate, br\r\n";
        let packed = get(server.address, path, accepted).await;
        assert_eq!(packed.status, 200);
        assert_eq!(packed.header("content-encoding"), Some("gzip"), "{path}");
        assert_eq!(packed.header("vary"), Some("accept-encoding"), "{path}");
        assert_eq!(packed.header("content-type"), plain.header("content-type"));
        let length = packed.body.len();
        assert_eq!(
            packed.header("content-length"),
            Some(&*length.to_string()),
            "{path}"
        );
        assert!(
            2 * length < built.len(),
            "{path}: {length} of {} bytes",
            built.len()
        );
        assert!(packed.unpacked() == built, "{path}: unpacks to other bytes");
        assert!(
            packed.header("content-security-policy").is_some(),
            "{path}: no policy"
        );

        let refused = get(
            server.address,
            path,
            "accept-encoding: gzip;q=0, identity\r\n",
        )
        .await;
        assert_eq!(refused.header("content-encoding"), None, "{path}");
        assert!(refused.body == built);
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn each_coding_of_a_page_has_a_tag_of_its_own() {
    let server = TestServer::start().await;
    let gzip = "accept-encoding: gzip\r\n";
    let plain_tag = get(server.address, "/viewer.js", "").await;
    let plain_tag = plain_tag.header("etag").unwrap();
    let gzip_tag = get(server.address, "/viewer.js", gzip).await;
    let gzip_tag = gzip_tag.header("etag").unwrap();
    assert_ne!(plain_tag, gzip_tag);
    for (coding, tag, status) in [
        ("", plain_tag, 304),
        (gzip, gzip_tag, 304),
        ("", gzip_tag, 200),
        (gzip, plain_tag, 200),
    ] {
        let headers = format!("{coding}if-none-match: {tag}\r\n");
        let answer = get(server.address, "/viewer.js", &headers).await;
        assert_eq!(answer.status, status, "{headers}");
        assert_eq!(answer.header("vary"), Some("accept-encoding"));
        assert_eq!(answer.body.is_empty(), status == 304, "{headers}");
        assert!(status != 304 || answer.header("etag") == Some(tag));
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn calls_are_not_compressed() {
    let server = TestServer::start().await;
    let request = "POST /sinew.v1.ServerService/GetServerInfo HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\
        accept-encoding: gzip, br\r\ncontent-type: application/grpc-web+proto\r\nx-grpc-web: 1\r\n\
        content-length: 5\r\n\r\n\0\0\0\0\0";
    let answer = send(server.address, request).await;
    assert_eq!(answer.header("content-encoding"), None);
    assert!(
        String::from_utf8_lossy(&answer.body).contains("grpc-status:0"),
        "{}",
        answer.head
    );
    server.stop().await;
}
