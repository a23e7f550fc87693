//! Regenerates the protobuf code and the descriptor set under `src/wire/gen` and fails if they differ from the
//! checked-in files.
//!
//! Building needs no protobuf compiler because the generated files are part of the source. After a change of `proto/`:
//! `SINEW_REWRITE=1 cargo test --test source proto_bootstrap`.

use std::path::Path;

#[test]
fn generated_code_matches_the_protos() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let mut files: Vec<String> = std::fs::read_dir(root.join("proto/sinew/v1"))
        .expect("protos are there")
        .map(|e| {
            format!(
                "sinew/v1/{}",
                e.expect("readable entry").file_name().to_string_lossy()
            )
        })
        .filter(|n| n.ends_with(".proto"))
        .collect();
    files.sort();
    // The parts of errors, for clients that learn of messages by reflection.
    files.push("google/rpc/error_details.proto".to_owned());
    let mut compiler = protox::Compiler::new([root.join("proto")]).expect("include path");
    compiler
        .include_imports(true)
        .include_source_info(true)
        .open_files(&files)
        .expect("protos compile");
    let with_comments = compiler.file_descriptor_set();
    // Our own options, the roles of calls, are only in the encoded set. Reflection clients do not need the comments,
    // which are nine tenths of the bytes.
    let mut lean = protox::Compiler::new([root.join("proto")]).expect("include path");
    lean.include_imports(true)
        .include_source_info(false)
        .open_files(&files)
        .expect("protos compile");
    let lean = lean.encode_file_descriptor_set();

    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wire_gen");
    std::fs::create_dir_all(&out).expect("scratch directory");
    let mut with_names = prost_build::Config::new();
    with_names.enable_type_names();
    tonic_prost_build::configure()
        .out_dir(&out)
        .bytes(".sinew.v1.Numbers.i16")
        .bytes(".sinew.v1.BvhSource.data")
        .bytes(".sinew.v1.RestoreWorldRequest.data")
        .bytes(".sinew.v1.ForkWorldRequest.data")
        // Encoded once and shared by all viewers: wire::watched implements this message by hand.
        .extern_path(
            ".sinew.v1.WatchWorldResponse",
            "crate::watched::WatchWorldResponse",
        )
        // Of googleapis the code only uses the errors of operations; annotations are read from descriptors.
        .extern_path(".google.rpc", "tonic_types::pb")
        // Requests are scanned before they are decoded, by the names of their types.
        .codec_path("crate::codec::Codec")
        .emit_rerun_if_changed(false)
        .compile_fds_with_config(with_comments, with_names)
        .expect("code is generated");

    let fresh = [
        (
            "sinew.v1.rs",
            std::fs::read(out.join("sinew.v1.rs")).expect("generated"),
        ),
        ("descriptor.bin", lean),
    ];
    let dir = root.join("src/wire/gen");
    if std::env::var_os("SINEW_REWRITE").is_some() {
        for (name, bytes) in &fresh {
            std::fs::write(dir.join(name), bytes).expect("source is writable");
        }
    }
    for (name, bytes) in &fresh {
        let checked_in = std::fs::read(dir.join(name)).unwrap_or_default();
        assert!(
            checked_in == *bytes,
            "src/wire/gen/{name} is out of date: run `SINEW_REWRITE=1 cargo test --test source \
             proto_bootstrap`"
        );
    }
}
