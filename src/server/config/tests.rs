//! Settings from all sources, and the pages that list them.

use super::*;

fn pair(a: &str, b: &str) -> (String, String) {
    (a.to_owned(), b.to_owned())
}

#[test]
fn later_sources_win() {
    let dir = std::env::temp_dir().join(format!("sinew-config-{}", std::process::id()));
    std::fs::write(&dir, "max_worlds = 3\nmax_clips = 7\nkeepalive_s = 5").unwrap();
    let config = Config::load(
        Some(&dir),
        [
            pair("SINEW_MAX_WORLDS", "4"),
            pair("SINEW_LOG", "debug"),
            pair("SINEW_MOCAP_DIR", "x"),
        ]
        .into_iter(),
        &[pair("max_worlds", "5")],
    )
    .unwrap();
    std::fs::remove_file(&dir).unwrap();
    assert_eq!((config.max_worlds, config.max_clips), (5, 7));
    assert_eq!((config.keepalive_s, config.log.as_str()), (5.0, "debug"));
}

#[test]
fn the_example_files_are_true() {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../deploy/config");
    let load = |name: &str| Config::load(Some(&dir.join(name)), std::iter::empty(), &[]);
    assert_eq!(load("sinew.toml").unwrap(), Config::default());
    let text = std::fs::read_to_string(dir.join("sinew.toml")).unwrap();
    for name in NAMES {
        assert!(
            text.contains(&format!("\n{name} = ")),
            "{name} is missing from the example"
        );
    }
    assert!(load("container.toml").unwrap().insecure_bind_any);
}

#[test]
fn the_manual_lists_every_setting_with_its_words() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/operations.md");
    let page = std::fs::read_to_string(page).unwrap();
    for (name, words, _) in Config::default().table() {
        let row = page
            .lines()
            .find(|l| l.starts_with(&format!("| `{name}` |")));
        let row = row.unwrap_or_else(|| panic!("{name} is missing from the manual"));
        assert!(row.contains(words.trim()), "{name}: {row}");
    }
}

#[test]
fn mistakes_are_named() {
    let load = |flags: &[(String, String)]| Config::load(None, std::iter::empty(), flags);
    assert!(
        load(&[pair("max_world", "5")])
            .unwrap_err()
            .to_string()
            .contains("max_worlds")
    );
    assert!(
        load(&[pair("max_worlds", "0")])
            .unwrap_err()
            .to_string()
            .contains("1…100000")
    );
    assert!(load(&[pair("max_worlds", "many")]).is_err());
    let environment = |name: &str| Config::load(None, [pair(name, "5")].into_iter(), &[]);
    let fault = environment("SINEW_MAX_WORLD").unwrap_err().to_string();
    assert!(fault.contains("SINEW_MAX_WORLD") && fault.contains("SINEW_MAX_WORLDS"));
    let traced = load(&[pair("otlp_endpoint", "http://127.0.0.1:4317")]);
    assert_eq!(traced.is_ok(), cfg!(feature = "otlp"));
    // The suggestion is written in the form of the place where the mistake is; there is no wild guess.
    for (wrong, meant) in [
        ("SINEW_MAX_WORDLS", "SINEW_MAX_WORLDS"),
        ("SINEW_CONFG", "SINEW_CONFIG"),
        ("SINEW_TICK_WORKER", "SINEW_TICK_WORKERS"),
        ("SINEW_DATADIR", "SINEW_DATA_DIR"),
    ] {
        let fault = environment(wrong).unwrap_err().to_string();
        assert!(fault.contains(&format!("did you mean {meant}?")), "{fault}");
    }
    let fault = environment("SINEW_FROBNICATE").unwrap_err().to_string();
    assert!(!fault.contains("did you mean"), "{fault}");
    for other in [
        "SINEW_CONFIG",
        "SINEW_MOCAP_DIR",
        "SINEW_SERVICE_HOST",
        "SINEW_PORT",
        "SINEW_PORT_7463_TCP",
        "HOME",
    ] {
        assert_eq!(environment(other).unwrap(), Config::default(), "{other}");
    }
    assert!(matches!(
        load(&[pair("listen", "0.0.0.0:1")]),
        Err(ConfigError::NotLoopback(_))
    ));
    assert!(
        load(&[
            pair("listen", "0.0.0.0:1"),
            pair("insecure-bind-any", "true")
        ])
        .is_ok()
    );
}

#[test]
fn each_setting_knows_where_it_comes_from() {
    let (config, sources) = Config::load_with_sources(
        None,
        [pair("SINEW_MAX_WORLDS", "4"), pair("SINEW_MAX_CLIPS", "9")].into_iter(),
        &[pair("max-clips", "5")],
    )
    .unwrap();
    assert_eq!((config.max_worlds, config.max_clips), (4, 5));
    assert_eq!(sources["max_worlds"], "SINEW_MAX_WORLDS");
    assert_eq!(sources["max_clips"], "flag");
    assert_eq!(sources.len(), 2);
}

#[test]
fn what_an_address_holds_besides_its_place_is_not_shown() {
    let config = Config {
        jwt_keys: "https://user:secret@issuer.example/keys?token=secret#secret".into(),
        ..Config::default()
    };
    let shown = config.shown();
    let keys = shown.iter().find(|(name, ..)| *name == "jwt_keys").unwrap();
    assert_eq!(keys.2, "https://…@issuer.example/keys?…");
    assert!(shown.iter().all(|(.., value)| !value.contains("secret")));
}
