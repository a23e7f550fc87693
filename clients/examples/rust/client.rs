//! A small client: a man lifts 6 kg, and we see what that asks of his shoulder. `cargo run --example client [ADDRESS]`, with a server running.
use sinew::{client::Client, wire::frame::values, wire::pb};

#[tokio::main]
async fn main() -> Result<(), Box<dyn std::error::Error>> {
    let address = std::env::args().nth(1);
    let client = Client::connect(address.as_deref().unwrap_or("127.0.0.1:7463")).await?;
    let name = "bodies/adult-man".to_owned();
    let request = pb::GetBodyRequest {
        name,
        ..Default::default()
    };
    let body = client
        .bodies()
        .get_body(request)
        .await?
        .into_inner()
        .body
        .unwrap_or_default();
    let shoulder = body
        .dofs
        .iter()
        .position(|d| d.name == "r_shoulder_flexion")
        .ok_or("no shoulder")?;
    let load = pb::Load {
        segment: "r_hand".into(),
        mass_kg: 6.0,
        ..Default::default()
    };
    let kind = Some(pb::perturbation::Kind::Load(load));
    let perturbation = Some(pb::Perturbation {
        kind,
        ..Default::default()
    });
    let paths = vec!["torque".into(), "torque_limits".into()];
    let view = pb::View {
        fields: Some(prost_types::FieldMask { paths }),
        encoding: 2,
        rate_divisor: 30,
        ..Default::default()
    };
    let request = pb::SimulateClipRequest {
        source: Some(pb::simulate_clip_request::Source::Clip("clips/lift".into())),
        perturbations: vec![pb::TimedPerturbation {
            start_s: 1.7,
            perturbation,
        }],
        view: Some(view),
        ..Default::default()
    };
    let done = client
        .simulations()
        .simulate_clip(request)
        .await?
        .into_inner();
    for frame in done.frames {
        let figure = &frame.figures[0];
        let torque = values(figure.torque.as_ref().ok_or("no torque")?)[shoulder];
        let most = values(figure.torque_limits.as_ref().ok_or("no limits")?)[39 + shoulder];
        println!(
            "{:.2} s  right shoulder {torque:.1} of {most:.1} N·m",
            frame.time_s
        );
    }
    println!("state {:016x}", done.summary.unwrap_or_default().state_hash);
    Ok(())
}
