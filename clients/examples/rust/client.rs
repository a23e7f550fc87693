//! A small client: a man lifts 6 kg, and we see what that asks of his shoulder. `cargo run -p sinew-client --example
//! client [ADDRESS]`, with a server running.
use sinew_client::{Client, Simulation, values};

#[tokio::main]
async fn main() -> Result<(), Box<dyn std::error::Error>> {
    let address = std::env::args().nth(1);
    let client = Client::connect(address.as_deref().unwrap_or("127.0.0.1:7463")).await?;
    let dofs = client.body("bodies/adult-man").await?.dofs;
    let mut names = dofs.iter().map(|d| d.name.as_str());
    let shoulder = names.position(|n| n == "r_shoulder_flexion");
    let shoulder = shoulder.ok_or("this body has no shoulder")?;

    let simulation = Simulation::of_clip("clips/lift")
        .load("r_hand", 6.0, 1.7)
        .frames(30, &["torque", "torque_limits"]);
    let done = client.simulate(simulation).await?;
    for frame in done.frames {
        let [figure] = &frame.figures[..] else {
            return Err("one figure was asked for".into());
        };
        let torque = values(figure.torque.as_ref().ok_or("no torque")?)[shoulder];
        let limits = values(figure.torque_limits.as_ref().ok_or("no limits")?);
        let most = limits[dofs.len() + shoulder];
        let time = frame.time_s;
        println!("{time:.2} s  right shoulder {torque:.1} of {most:.1} N·m");
    }
    println!("state {:016x}", done.summary.unwrap_or_default().state_hash);
    Ok(())
}
