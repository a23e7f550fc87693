//! A request accepts a strength file of `sinew strength` as JSON, with the same effect to the last bit.

use crate::support::TestServer;
use prost::Message;
use prost_reflect::{DescriptorPool, DynamicMessage};
use sinew_wire::{DESCRIPTOR_SET, pb};
use std::path::Path;
use std::process::Command;

const PERSON: [&str; 2] = ["--body", "older-woman"];
const LOAD: [&str; 2] = ["--load", "5@r_hand"];

/// Runs the command; panics if it fails.
fn sinew(args: &[&str]) {
    let out = Command::new(env!("CARGO_BIN_EXE_sinew"))
        .args(args)
        .args(PERSON)
        .args(LOAD)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{args:?}: {said}");
}

fn json(path: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The message that a client makes from proto3 JSON.
fn strength(file: &serde_json::Value) -> pb::StrengthScale {
    let pool = DescriptorPool::decode(DESCRIPTOR_SET).unwrap();
    let kind = pool.get_message_by_name("sinew.v1.StrengthScale").unwrap();
    let read = DynamicMessage::deserialize(kind, file).unwrap();
    pb::StrengthScale::decode(read.encode_to_vec().as_slice()).unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_strength_file_is_taken_by_requests_and_does_what_the_command_does() {
    let folder = std::env::temp_dir().join(format!("sinew-strength-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let place = |name: &str| folder.join(name);
    let (file, report) = (place("person.json"), place("report.json"));
    let path = |p: &Path| p.to_str().unwrap().to_owned();
    sinew(&[
        "strength",
        "builtin:lift",
        "--percentile",
        "5",
        "--out",
        &path(&file),
    ]);
    sinew(&[
        "run",
        "builtin:lift",
        "--strength-file",
        &path(&file),
        "--report",
        &path(&report),
    ]);
    let strength = strength(&json(&file));
    assert!(strength.dofs.iter().any(|d| d.factor > 1.2), "{strength:?}");

    let server = TestServer::start().await;
    let figure = pb::Figure {
        body: "bodies/older-woman".into(),
        strength: Some(strength.clone()),
        ..Default::default()
    };
    // A figure in a world has this strength.
    let world = server.paused_world("w").await;
    let made = server
        .client
        .figures()
        .create_figure(pb::CreateFigureRequest {
            parent: world,
            figure_id: "a".into(),
            figure: Some(figure.clone()),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner();
    let has = made.figure.unwrap().strength.unwrap();
    assert_eq!((has.percentile, &has.dofs), (5.0, &strength.dofs));
    // It also moves as in the command, to the last bit; with the strength of the tables it does not.
    let report = json(&report);
    let simulate = |figure: pb::Figure| pb::SimulateClipRequest {
        source: Some(pb::simulate_clip_request::Source::Clip("clips/lift".into())),
        figure: Some(figure),
        duration_s: report["duration_s"].as_f64().unwrap(),
        perturbations: vec![pb::TimedPerturbation {
            start_s: 0.0,
            perturbation: Some(pb::Perturbation {
                kind: Some(pb::perturbation::Kind::Load(pb::Load {
                    segment: "r_hand".into(),
                    mass_kg: 5.0,
                    ..Default::default()
                })),
                ..Default::default()
            }),
        }],
        ..Default::default()
    };
    let mut simulations = server.client.simulations();
    let mut hash = async |figure: pb::Figure| {
        let answer = simulations.simulate_clip(simulate(figure)).await.unwrap();
        let summary = answer.into_inner().summary.unwrap();
        format!("{:016x}", summary.state_hash)
    };
    let said = report["state_hash"].as_str().unwrap().to_owned();
    assert_eq!(hash(figure.clone()).await, said);
    let tables = pb::Figure {
        strength: Some(pb::StrengthScale {
            percentile: 5.0,
            ..Default::default()
        }),
        ..figure
    };
    assert_ne!(hash(tables).await, said);
    server.stop().await;
    std::fs::remove_dir_all(&folder).unwrap();
}
