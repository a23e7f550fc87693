//! The viewer: the files of `clients/web/dist`, which is built and committed there and needs nothing from elsewhere.

use super::api::App;
use axum::Router;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use std::sync::Arc;

/// The page may run its own script and style, draw its own pictures and talk to this server; nothing else.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

struct File {
    path: &'static str,
    kind: &'static str,
    bytes: &'static [u8],
}

macro_rules! files {
    ($($path:literal $file:literal $kind:literal;)*) => {
        [$(File { path: $path, kind: $kind, bytes: include_bytes!(concat!("../../clients/web/dist/", $file)) }),*]
    };
}

static FILES: [File; 4] = files! {
    "/" "index.html" "text/html; charset=utf-8";
    "/viewer.js" "viewer.js" "text/javascript; charset=utf-8";
    "/viewer.css" "viewer.css" "text/css; charset=utf-8";
    "/icon.svg" "icon.svg" "image/svg+xml";
};

/// FNV-1a: names the version of a file, nothing more.
fn tag(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, b| {
        (hash ^ u64::from(*b)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

fn answer(file: &File, tag: &HeaderValue, asked: &HeaderMap) -> Response {
    let headers: [(HeaderName, HeaderValue); 6] = [
        (header::CONTENT_TYPE, HeaderValue::from_static(file.kind)),
        // Kept, and asked for again each time: a new server never meets an old page.
        (header::CACHE_CONTROL, HeaderValue::from_static("no-cache")),
        (header::ETAG, tag.clone()),
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
    if asked.get(header::IF_NONE_MATCH) == Some(tag) {
        (StatusCode::NOT_MODIFIED, headers).into_response()
    } else {
        (headers, file.bytes).into_response()
    }
}

/// `/` and what it loads.
pub(super) fn router() -> Router<Arc<App>> {
    FILES.iter().fold(Router::new(), |router, file| {
        let tag = HeaderValue::from_str(&format!("\"{:016x}\"", tag(file.bytes)))
            .expect("hexadecimal digits in quotes are a header value");
        router.route(
            file.path,
            get(move |asked: HeaderMap| async move { answer(file, &tag, &asked) }),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_that_was_kept_is_not_sent_again() {
        let tag = HeaderValue::from_static("\"1\"");
        let first = answer(&FILES[0], &tag, &HeaderMap::new());
        assert_eq!(first.status(), StatusCode::OK);
        assert!(
            first.headers()[header::CONTENT_SECURITY_POLICY]
                .to_str()
                .unwrap()
                .starts_with("default-src 'none'")
        );
        let asked = HeaderMap::from_iter([(header::IF_NONE_MATCH, tag.clone())]);
        assert_eq!(
            answer(&FILES[0], &tag, &asked).status(),
            StatusCode::NOT_MODIFIED
        );
    }

    #[test]
    fn the_bundle_names_no_other_host_to_load_from_and_is_small() {
        let total: usize = FILES.iter().map(|f| f.bytes.len()).sum();
        assert!(total <= 1_500_000, "{total} bytes");
        let page = std::str::from_utf8(FILES[0].bytes).unwrap();
        assert!(!page.contains("http:") && !page.contains("https:"));
    }
}
