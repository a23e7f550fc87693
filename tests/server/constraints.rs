//! Constraints over the wire: a client holds a hand, sees the error, replaces and removes constraints; bad input
//! changes nothing.

use crate::support::{TestServer, refusal};
use sinew_wire::pb;
use sinew_wire::pb::constraint::On;
use tonic::{Code, Status};

const PART: &str = "constraint_error";

fn values(n: &pb::Numbers) -> Vec<f64> {
    n.f64.clone()
}

fn at(x: f64, y: f64, z: f64) -> Option<pb::Vector3> {
    Some(pb::Vector3 { x, y, z })
}

fn hand(z: f64) -> pb::Constraint {
    pb::Constraint {
        on: Some(On::Segment("r_hand".into())),
        position_m: at(0.35, -0.25, z),
        ..Default::default()
    }
}

async fn update(
    server: &TestServer,
    paths: &[&str],
    figure: pb::Figure,
) -> Result<pb::Figure, Status> {
    let request = pb::UpdateFigureRequest {
        control_token: String::new(),
        figure: Some(figure),
        update_mask: Some(prost_types::FieldMask {
            paths: paths.iter().map(|p| (*p).to_owned()).collect(),
        }),
        ..Default::default()
    };
    let answer = server.client.figures().update_figure(request).await?;
    Ok(answer.into_inner().figure.unwrap())
}

async fn constrain(
    server: &TestServer,
    name: &str,
    constraints: Vec<pb::Constraint>,
) -> Result<pb::Figure, Status> {
    let figure = pb::Figure {
        name: name.to_owned(),
        constraints,
        ..Default::default()
    };
    update(server, &["constraints"], figure).await
}

async fn missing(server: &TestServer, world: &str) -> Vec<f64> {
    let frame = server.frame(world, &[PART]).await;
    frame.figures[0]
        .constraint_error
        .as_ref()
        .map(values)
        .unwrap_or_default()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_client_holds_a_hand_moves_it_and_lets_it_go() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let name = format!("{world}/figures/a");
    let com = pb::Constraint {
        on: Some(On::CenterOfMass(true)),
        position_m: at(0.0, 0.03, 0.0),
        position_axes: at(0.0, 1.0, 0.0),
        duration_s: 2.0,
        ..Default::default()
    };
    let f = constrain(&server, &name, vec![hand(1.1), com])
        .await
        .unwrap();
    assert_eq!(f.constraints.len(), 2);
    assert!(
        f.constraints[0].point_m.is_some(),
        "the point that was chosen"
    );
    assert_eq!(f.constraints[0].weight, Some(1.0));
    assert_eq!(f.constraints[1].duration_s, 2.0);
    server.step(&world, 1).await;
    let first = missing(&server, &world).await;
    assert!(first.len() == 4 && first[0] > 0.2, "{first:?}");
    server.step(&world, 100).await;
    let then = missing(&server, &world).await;
    assert!(then[0] < 0.01 && then[2] < 0.01, "{then:?}");
    // The one on the centre of mass ends by itself.
    server.step(&world, 30).await;
    assert_eq!(missing(&server, &world).await.len(), 2);
    assert_eq!(server.look(&name).await.constraints.len(), 1);

    constrain(&server, &name, vec![hand(1.2)]).await.unwrap();
    server.step(&world, 90).await;
    assert!(missing(&server, &world).await[0] < 0.01);
    let f = constrain(&server, &name, vec![]).await.unwrap();
    assert!(f.constraints.is_empty());
    server.step(&world, 1).await;
    assert!(missing(&server, &world).await.is_empty());

    constrain(&server, &name, vec![hand(1.2)]).await.unwrap();
    let request = pb::ResetFigureRequest {
        control_token: String::new(),
        name: name.clone(),
        placement: None,
        ..Default::default()
    };
    let f = server.client.figures().reset_figure(request).await.unwrap();
    assert!(f.into_inner().figure.unwrap().constraints.is_empty());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn constraints_of_a_new_figure_and_of_a_simulation_count() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let figure = pb::Figure {
        constraints: vec![hand(1.1)],
        protective_steps: Some(false),
        ..Default::default()
    };
    let request = pb::CreateFigureRequest {
        parent: world.clone(),
        figure_id: "a".into(),
        figure: Some(figure.clone()),
        ..Default::default()
    };
    let made = server.client.figures().create_figure(request).await;
    let made = made.unwrap().into_inner().figure.unwrap();
    assert_eq!(
        (made.constraints.len(), made.protective_steps),
        (1, Some(false))
    );
    // Choices of the paper's controller do not change whether it steps.
    let paper = pb::Figure {
        name: made.name.clone(),
        paper: Some(pb::PaperOptions::default()),
        ..Default::default()
    };
    let f = update(&server, &["paper"], paper).await.unwrap();
    assert_eq!(f.protective_steps, Some(false));
    let on = pb::Figure {
        name: made.name.clone(),
        ..Default::default()
    };
    let f = update(&server, &["protective_steps"], on).await.unwrap();
    assert_eq!(f.protective_steps, Some(true));

    let run = pb::SimulateClipRequest {
        source: Some(pb::simulate_clip_request::Source::Clip("clips/idle".into())),
        figure: Some(figure),
        duration_s: 2.0,
        view: Some(crate::support::view(&[PART])),
        ..Default::default()
    };
    let out = server
        .client
        .simulations()
        .simulate_clip(run)
        .await
        .unwrap();
    let frames = out.into_inner().frames;
    let last = &frames.last().unwrap().figures[0];
    assert!(values(last.constraint_error.as_ref().unwrap())[0] < 0.01);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_wrong_names_its_field_and_changes_nothing() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let name = format!("{world}/figures/a");
    constrain(&server, &name, vec![hand(1.1)]).await.unwrap();
    let nan = pb::Constraint {
        position_m: at(f64::NAN, 0.0, 1.0),
        ..hand(1.0)
    };
    let middle = pb::Constraint {
        point_m: constrain(&server, &name, vec![hand(1.1)])
            .await
            .unwrap()
            .constraints[0]
            .point_m,
        ..hand(1.0)
    };
    for (constraints, field) in [
        (vec![hand(1.0), nan], "figure.constraints[1].position_m.x"),
        (vec![hand(1.0); 2], "figure.constraints[1]"),
        (vec![hand(1.0); 9], "figure.constraints"),
        // The same point, once by name and once by default.
        (vec![hand(1.0), middle], "figure.constraints"),
    ] {
        let e = constrain(&server, &name, constraints).await.unwrap_err();
        let (code, _, at) = refusal(&e);
        assert_eq!((code, at.as_str()), (Code::InvalidArgument, field));
    }
    let kept = server.look(&name).await.constraints;
    assert_eq!(kept[0].position_m, at(0.35, -0.25, 1.1));
    server.stop().await;
}
