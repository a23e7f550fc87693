//! The commands of `docs/sharing.md`, run exactly as printed.

use crate::operations::support::Temporary;
use std::path::Path;
use std::process::Command;

/// Everything between the fences of shell code.
fn commands(page: &str) -> String {
    let mut out = String::new();
    let mut inside = false;
    for line in page.lines() {
        match line {
            "```sh" => inside = true,
            "```" => inside = false,
            _ if inside => {
                out += line;
                out.push('\n');
            }
            _ => {}
        }
    }
    out
}

#[test]
fn the_page_on_sharing_leads_to_a_shared_server() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let page = std::fs::read_to_string(root.join("docs/sharing.md")).unwrap();
    // A port of the system's choice; it is free again now.
    let port = std::net::TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port();
    let script = format!(
        "set -euo pipefail\ntrap 'kill $(jobs -p) || true' EXIT\n{}",
        commands(&page).replace("7463", &port.to_string())
    );
    let files = Temporary::new("sharing");
    std::fs::create_dir_all(files.path()).unwrap();
    let bin = Path::new(env!("CARGO_BIN_EXE_sinew")).parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let run = Command::new("bash")
        .args(["-c", &script])
        .current_dir(files.path())
        .env("PATH", path)
        .env_remove("SINEW_TOKEN")
        .output()
        .unwrap();
    let out = String::from_utf8_lossy(&run.stdout);
    let err = String::from_utf8_lossy(&run.stderr);
    let log =
        std::fs::read_to_string(Path::new(files.path()).join("server.log")).unwrap_or_default();
    assert!(run.status.success(), "{out}\n{err}\n{log}");
    for expected in [
        "serving",
        "worlds/studio-a-stage/grants/grant-1: user:cleo is driver of anna",
        "worlds/studio-a-stage/grants/grant-2: user:dan is perturber, forces up to 200 N, perturbations up to 2 per s",
        "worlds/studio-a-stage/grants/creator: user:ada is owner",
        "worlds/studio-a-stage/grants/grant-2 is gone",
        "refused",
    ] {
        assert!(
            out.lines().any(|l| l == expected),
            "{expected:?} is missing:\n{out}\n{err}"
        );
    }
    assert!(err.contains("PermissionDenied"), "{err}");
    // The secrets are their owner's, and neither the log nor the settings in it show one.
    #[cfg(unix)]
    for name in ["tokens.key", "ada.token"] {
        use std::os::unix::fs::PermissionsExt as _;
        let mode = std::fs::metadata(Path::new(files.path()).join(name))
            .unwrap()
            .permissions()
            .mode();
        assert_eq!(mode & 0o077, 0, "{name}");
    }
    assert!(
        log.contains("setting jwt_secret_file = tokens.key"),
        "{log}"
    );
    for name in [
        "tokens.key",
        "ada.token",
        "ben.token",
        "cleo.token",
        "dan.token",
        "server.key",
    ] {
        let secret = std::fs::read_to_string(Path::new(files.path()).join(name)).unwrap();
        let longest = secret.lines().max_by_key(|l| l.len()).unwrap();
        for (whose, text) in [("log", log.as_str()), ("output", &out), ("errors", &err)] {
            assert!(!text.contains(longest), "the {whose} shows {name}");
        }
    }
}
