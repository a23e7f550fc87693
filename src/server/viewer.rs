//! The viewer: the files of `clients/web/dist`, which are built and committed there and load nothing from elsewhere.

use axum::Router;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use bytes::Bytes;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write as _;
use std::sync::OnceLock;

/// The page may run its own script and style, show its own pictures and talk to this server, and nothing else.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; \
    connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A file of the page.
struct File {
    path: &'static str,
    kind: &'static str,
    bytes: &'static [u8],
    plain: OnceLock<Representation>,
    gzip: OnceLock<Representation>,
}

/// The bytes of a file in one content coding, and the tag that names them.
struct Representation {
    bytes: Bytes,
    tag: HeaderValue,
}

macro_rules! files {
    ($($path:literal $file:literal $kind:literal;)*) => {
        [$(File {
            path: $path,
            kind: $kind,
            bytes: include_bytes!(concat!("../../clients/web/dist/", $file)),
            plain: OnceLock::new(),
            gzip: OnceLock::new(),
        }),*]
    };
}

static FILES: [File; 4] = files! {
    "/" "index.html" "text/html; charset=utf-8";
    "/viewer.js" "viewer.js" "text/javascript; charset=utf-8";
    "/viewer.css" "viewer.css" "text/css; charset=utf-8";
    "/icon.svg" "icon.svg" "image/svg+xml";
};

/// FNV-1a, only to name the version of a file.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, b| {
        (hash ^ u64::from(*b)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

fn quoted(tag: &str) -> HeaderValue {
    HeaderValue::from_str(&format!("\"{tag}\"")).expect("letters and digits are a header value")
}

impl File {
    /// The file as it was built.
    fn plain(&self) -> &Representation {
        self.plain.get_or_init(|| Representation {
            bytes: Bytes::from_static(self.bytes),
            tag: quoted(&format!("{:016x}", hash(self.bytes))),
        })
    }

    /// The file in gzip, compressed at the first request for it and kept.
    fn gzip(&self) -> &Representation {
        self.gzip.get_or_init(|| {
            let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
            let bytes = encoder
                .write_all(self.bytes)
                .and_then(|()| encoder.finish())
                .expect("a vector takes everything that is written");
            Representation {
                bytes: bytes.into(),
                tag: quoted(&format!("{:016x}-gzip", hash(self.bytes))),
            }
        })
    }
}

/// The quality that `Accept-Encoding` gives to a coding, by name or by `*`; `None` if it names neither. A quality that
/// cannot be read counts as 0.
fn quality(asked: &HeaderMap, coding: &str) -> Option<f64> {
    let mut any = None;
    let values = asked.get_all(header::ACCEPT_ENCODING).into_iter();
    for entry in values
        .filter_map(|v| v.to_str().ok())
        .flat_map(|v| v.split(','))
    {
        let (name, parameters) = entry.split_once(';').unwrap_or((entry, ""));
        let name = name.trim();
        let weight = match parameters.trim().split_once('=') {
            Some((q, value)) if q.trim().eq_ignore_ascii_case("q") => {
                value.trim().parse().unwrap_or(0.0)
            }
            Some(_) => 0.0,
            None => 1.0,
        };
        if name.eq_ignore_ascii_case(coding) {
            return Some(weight);
        }
        if name == "*" {
            any = Some(weight);
        }
    }
    any
}

/// Whether the client takes gzip and does not prefer the plain bytes.
fn wants_gzip(asked: &HeaderMap) -> bool {
    let gzip = quality(asked, "gzip").unwrap_or(0.0);
    gzip > 0.0 && gzip >= quality(asked, "identity").unwrap_or(0.0)
}

/// Whether the client already has the representation with this tag.
fn has(asked: &HeaderMap, tag: &HeaderValue) -> bool {
    let values = asked.get_all(header::IF_NONE_MATCH).into_iter();
    values
        .filter_map(|v| v.to_str().ok())
        .flat_map(|v| v.split(','))
        .map(str::trim)
        .any(|t| t == "*" || t.trim_start_matches("W/").as_bytes() == tag.as_bytes())
}

fn answer(file: &File, asked: &HeaderMap) -> Response {
    let gzip = wants_gzip(asked);
    let chosen = if gzip { file.gzip() } else { file.plain() };
    let headers: [(HeaderName, HeaderValue); 7] = [
        (header::CONTENT_TYPE, HeaderValue::from_static(file.kind)),
        // Clients keep it, but ask again each time, so that a new server never meets an old page.
        (header::CACHE_CONTROL, HeaderValue::from_static("no-cache")),
        (header::VARY, HeaderValue::from_static("accept-encoding")),
        (header::ETAG, chosen.tag.clone()),
        (
            header::CONTENT_SECURITY_POLICY,
            HeaderValue::from_static(POLICY),
        ),
        (
            header::X_CONTENT_TYPE_OPTIONS,
            HeaderValue::from_static("nosniff"),
        ),
        (
            header::REFERRER_POLICY,
            HeaderValue::from_static("no-referrer"),
        ),
    ];
    if has(asked, &chosen.tag) {
        return (StatusCode::NOT_MODIFIED, headers).into_response();
    }
    let mut response = (headers, chosen.bytes.clone()).into_response();
    if gzip {
        let coding = HeaderValue::from_static("gzip");
        response
            .headers_mut()
            .insert(header::CONTENT_ENCODING, coding);
    }
    response
}

/// `/` and the files that it loads.
pub(super) fn router<S: Clone + Send + Sync + 'static>() -> Router<S> {
    FILES.iter().fold(Router::new(), |router, file| {
        router.route(
            file.path,
            get(move |asked: HeaderMap| async move { answer(file, &asked) }),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(headers: &[(HeaderName, &'static str)]) -> HeaderMap {
        let pairs = headers.iter();
        pairs
            .map(|(name, value)| (name.clone(), HeaderValue::from_static(value)))
            .collect()
    }

    #[test]
    fn a_page_that_was_kept_is_not_sent_again() {
        let first = answer(&FILES[0], &HeaderMap::new());
        assert_eq!(first.status(), StatusCode::OK);
        assert!(
            first.headers()[header::CONTENT_SECURITY_POLICY]
                .to_str()
                .unwrap()
                .starts_with("default-src 'none'")
        );
        let tag = first.headers()[header::ETAG].to_str().unwrap().to_owned();
        for list in [tag.clone(), format!("\"x\", W/{tag}"), "*".to_owned()] {
            let value = HeaderValue::from_str(&list).unwrap();
            let kept = HeaderMap::from_iter([(header::IF_NONE_MATCH, value)]);
            let status = answer(&FILES[0], &kept).status();
            assert_eq!(status, StatusCode::NOT_MODIFIED, "{list}");
        }
    }

    #[test]
    fn gzip_is_sent_only_where_it_is_accepted_and_not_worse_than_plain() {
        for (accepted, expected) in [
            ("gzip", true),
            ("br, GZIP;q=0.5", true),
            ("*", true),
            ("identity;q=0.5, gzip;q=0.8", true),
            ("gzip;q=0", false),
            ("*;q=0", false),
            ("*, gzip;q=0", false),
            ("gzip;q=none", false),
            ("gzip;q=0.3, identity", false),
            ("identity", false),
            ("br", false),
            ("", false),
        ] {
            let headers = asked(&[(header::ACCEPT_ENCODING, accepted)]);
            assert_eq!(wants_gzip(&headers), expected, "{accepted:?}");
        }
        let split = asked(&[
            (header::ACCEPT_ENCODING, "br"),
            (header::ACCEPT_ENCODING, "gzip"),
        ]);
        assert!(wants_gzip(&split));
        assert!(!wants_gzip(&HeaderMap::new()));
    }

    #[test]
    fn the_bundle_names_no_other_host_to_load_from_and_is_small() {
        let total: usize = FILES.iter().map(|f| f.bytes.len()).sum();
        assert!(total <= 1_500_000, "{total} bytes");
        let page = std::str::from_utf8(FILES[0].bytes).unwrap();
        assert!(!page.contains("http:") && !page.contains("https:"));
    }
}
