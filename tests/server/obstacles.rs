//! Obstacles over the wire: added, changed, listed, removed; seen in frames and events, and felt.

use crate::support::{TestServer, refusal, view};
use sinew_wire::frame::values;
use sinew_wire::pb;
use tonic::Code;

fn place(x: f64, y: f64, z: f64) -> Option<pb::Pose> {
    Some(pb::Pose {
        position_m: Some(pb::Vector3 { x, y, z }),
        rotation: None,
    })
}

/// A ball of 5 kg at the height of the chest that flies at the figure at the origin.
fn thrown() -> pb::Obstacle {
    pb::Obstacle {
        shape: Some(pb::obstacle::Shape::Sphere(pb::SphereShape {
            radius_m: 0.12,
        })),
        mobility: pb::ObstacleMobility::Free.into(),
        mass_kg: 5.0,
        pose: place(0.9, 0.0, 1.35),
        velocity_mps: Some(pb::Vector3 {
            x: -5.0,
            y: 0.0,
            z: 0.6,
        }),
        ..Default::default()
    }
}

/// A box that stands on the ground out of the way.
fn crate_at(x: f64) -> pb::Obstacle {
    let half = pb::Vector3 {
        x: 0.2,
        y: 0.3,
        z: 0.25,
    };
    pb::Obstacle {
        shape: Some(pb::obstacle::Shape::Box(pb::BoxShape {
            half_m: Some(half),
        })),
        pose: place(x, 0.0, 0.25),
        ..Default::default()
    }
}

impl TestServer {
    /// Adds an obstacle; the server chooses its name if `id` is empty.
    pub async fn add_obstacle(
        &self,
        world: &str,
        id: &str,
        obstacle: pb::Obstacle,
    ) -> Result<pb::Obstacle, tonic::Status> {
        let request = pb::CreateObstacleRequest {
            parent: world.into(),
            obstacle_id: id.into(),
            obstacle: Some(obstacle),
            ..Default::default()
        };
        let answer = self.client.obstacles().create_obstacle(request).await?;
        Ok(answer.into_inner().obstacle.unwrap())
    }

    async fn obstacles(&self, world: &str) -> Vec<pb::Obstacle> {
        let request = pb::ListObstaclesRequest {
            parent: world.into(),
            page_size: 1000,
            ..Default::default()
        };
        let answer = self
            .client
            .obstacles()
            .list_obstacles(request)
            .await
            .unwrap();
        answer.into_inner().obstacles
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn obstacles_are_added_changed_listed_and_removed() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let seat = server
        .add_obstacle(&world, "seat", crate_at(2.0))
        .await
        .unwrap();
    assert_eq!(seat.name, "worlds/w/obstacles/seat");
    assert_eq!(seat.mobility(), pb::ObstacleMobility::Fixed);
    assert_eq!(seat.friction, Some(0.6), "defaults are filled in");
    let chosen = server.add_obstacle(&world, "", thrown()).await.unwrap();
    assert_eq!(chosen.name, "worlds/w/obstacles/obstacle-2");
    let taken = server.add_obstacle(&world, "seat", crate_at(1.0)).await;
    let (code, reason, _) = refusal(&taken.unwrap_err());
    assert_eq!(
        (code, reason.as_str()),
        (Code::AlreadyExists, "ALREADY_EXISTS")
    );

    let moved = pb::Obstacle {
        name: seat.name.clone(),
        mobility: pb::ObstacleMobility::Led.into(),
        velocity_mps: Some(pb::Vector3 {
            x: 0.6,
            y: 0.0,
            z: 0.0,
        }),
        ..crate_at(3.0)
    };
    let update = |obstacle: pb::Obstacle| pb::UpdateObstacleRequest {
        obstacle: Some(obstacle),
        ..Default::default()
    };
    let mut obstacles = server.client.obstacles();
    let now = obstacles
        .update_obstacle(update(moved.clone()))
        .await
        .unwrap()
        .into_inner()
        .obstacle
        .unwrap();
    assert_eq!(now.mobility(), pb::ObstacleMobility::Led);
    server.step(&world, 30).await;
    let all = server.obstacles(&world).await;
    let names: Vec<&str> = all.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, [seat.name.as_str(), chosen.name.as_str()]);
    let x = all[0].pose.unwrap().position_m.unwrap().x;
    assert!((x - 3.3).abs() < 1e-9, "it was led for half a second: {x}");

    let frame = server.frame(&world, &["root_pose"]).await;
    let seen: Vec<&str> = frame
        .obstacles
        .iter()
        .map(|o| o.obstacle_id.as_str())
        .collect();
    assert_eq!(seen, ["seat", "obstacle-2"]);
    let pose = values(frame.obstacles[0].pose.as_ref().unwrap());
    assert!((pose[0] - 3.3).abs() < 1e-9 && pose.len() == 7);
    assert_eq!(
        values(frame.obstacles[1].velocity.as_ref().unwrap()).len(),
        6
    );

    let remove = || pb::DeleteObstacleRequest {
        name: seat.name.clone(),
        ..Default::default()
    };
    obstacles.delete_obstacle(remove()).await.unwrap();
    let again = obstacles.delete_obstacle(remove()).await;
    assert_eq!(again.unwrap_err().code(), Code::NotFound);
    let gone = obstacles.update_obstacle(update(moved)).await;
    assert_eq!(gone.unwrap_err().code(), Code::NotFound);
    assert_eq!(server.obstacles(&world).await.len(), 1);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_ball_is_felt_seen_and_told_of() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let mut states = server.client.states();
    let request = pb::WatchEventsRequest {
        world: world.clone(),
        figure_ids: vec![],
        types: vec![],
    };
    let mut events = states.watch_events(request).await.unwrap().into_inner();
    assert!(events.message().await.unwrap().unwrap().events.is_empty());
    server.add_obstacle(&world, "ball", thrown()).await.unwrap();

    let mut felt = None;
    for _ in 0..30 {
        server.step(&world, 1).await;
        let frame = server.frame(&world, &["touches"]).await;
        let touches = frame.figures[0].touches.clone().unwrap();
        if let Some(other) = touches.other.first() {
            assert_eq!(
                (other.as_str(), touches.other_segment[0]),
                ("obstacles/ball", -1)
            );
            let on_figure = values(touches.force.as_ref().unwrap());
            let on_ball = values(frame.obstacles[0].force.as_ref().unwrap());
            // Sum over all parts that it touches.
            for axis in 0..3 {
                let sum: f64 = on_figure.iter().skip(axis).step_by(3).sum();
                assert!((sum + on_ball[axis]).abs() <= 1e-9 * on_ball[0].abs());
            }
            assert!(on_figure[0] < -100.0, "it comes from the front");
            assert_eq!(
                values(touches.position.as_ref().unwrap()).len(),
                on_figure.len()
            );
            felt = Some(frame.tick);
            break;
        }
    }
    let felt = felt.expect("it arrives within half a second");
    server.step(&world, 60).await;
    let (mut touched, mut parted) = (None, false);
    while !parted {
        for e in events.message().await.unwrap().unwrap().events {
            match e.r#type() {
                pb::EventType::ObstacleAdded => assert_eq!(e.other, "obstacles/ball"),
                pb::EventType::Touched => {
                    assert_eq!(e.other, "obstacles/ball");
                    assert!(!e.segment.is_empty() && e.other_segment.is_empty());
                    touched.get_or_insert(e.tick);
                }
                pb::EventType::Parted => parted = true,
                _ => {}
            }
        }
    }
    assert_eq!(touched, Some(felt));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn two_figures_touch_by_name_unless_collisions_are_off() {
    let server = TestServer::start().await;
    for on in [true, false] {
        let settings = pb::World {
            collisions: Some(on),
            ..Default::default()
        };
        let id = if on { "on" } else { "off" };
        let world = server.world(id, true, settings).await;
        for (name, x) in [("a", 0.0), ("b", 0.6)] {
            server
                .client
                .figures()
                .create_figure(pb::CreateFigureRequest {
                    parent: world.clone(),
                    figure_id: name.into(),
                    figure: Some(pb::Figure {
                        placement: Some(pb::Placement {
                            x_m: x,
                            ..Default::default()
                        }),
                        ..Default::default()
                    }),
                    ..Default::default()
                })
                .await
                .unwrap();
        }
        let push = pb::Impulse {
            segment: "chest".into(),
            impulse_newton_seconds: Some(pb::Vector3 {
                x: 60.0,
                y: 0.0,
                z: 0.0,
            }),
            ..Default::default()
        };
        server
            .client
            .perturbations()
            .apply_perturbations(pb::ApplyPerturbationsRequest {
                world: world.clone(),
                perturbations: vec![pb::Perturbation {
                    figure_id: "a".into(),
                    tick: None,
                    kind: Some(pb::perturbation::Kind::Impulse(push)),
                }],
                ..Default::default()
            })
            .await
            .unwrap();
        let mut met = Vec::new();
        for _ in 0..60 {
            server.step(&world, 1).await;
            let frame = server.frame(&world, &["touches"]).await;
            for f in &frame.figures {
                let t = f.touches.clone().unwrap();
                assert!(t.other_segment.iter().all(|s| (0..18).contains(s)));
                met.extend(t.other.into_iter().map(|o| (f.figure_index, o)));
            }
        }
        assert_eq!(met.iter().any(|(i, o)| *i == 0 && o == "figures/b"), on);
        assert_eq!(met.iter().any(|(i, o)| *i == 1 && o == "figures/a"), on);
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_obstacles_change_nothing_and_are_named() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let edits: [(&str, fn(&mut pb::Obstacle)); 9] = [
        ("obstacle.shape", |o| o.shape = None),
        ("obstacle.sphere.radius_m", |o| {
            o.shape = Some(pb::obstacle::Shape::Sphere(pb::SphereShape {
                radius_m: f64::NAN,
            }));
        }),
        ("obstacle.capsule.half_length_m", |o| {
            o.shape = Some(pb::obstacle::Shape::Capsule(pb::CapsuleShape {
                radius_m: 0.1,
                half_length_m: -1.0,
            }));
        }),
        ("obstacle.box.half_m.x", |o| {
            o.shape = Some(pb::obstacle::Shape::Box(pb::BoxShape { half_m: None }));
        }),
        ("obstacle.mobility", |o| {
            o.shape = Some(pb::obstacle::Shape::Plane(pb::PlaneShape {}));
        }),
        ("obstacle.mass_kg", |o| o.mass_kg = 0.0),
        ("obstacle.friction", |o| o.friction = Some(9.0)),
        ("obstacle.pose.position_m.z", |o| {
            o.pose = place(0.0, 0.0, f64::INFINITY);
        }),
        ("obstacle.velocity_mps.x", |o| {
            o.velocity_mps = Some(pb::Vector3 {
                x: 1e6,
                y: 0.0,
                z: 0.0,
            });
        }),
    ];
    for (field, edit) in edits {
        let mut o = thrown();
        edit(&mut o);
        let refused = server.add_obstacle(&world, "", o).await.unwrap_err();
        let (code, reason, named) = refusal(&refused);
        assert_eq!(
            (code, reason.as_str()),
            (Code::InvalidArgument, "INVALID_FIELD")
        );
        assert_eq!(named, field);
    }
    let mut obstacles = server.client.obstacles();
    for (parent, code, field) in [
        ("w", Code::InvalidArgument, "parent"),
        ("worlds/none", Code::NotFound, ""),
    ] {
        let request = pb::ListObstaclesRequest {
            parent: parent.into(),
            ..Default::default()
        };
        let (got, _, named) = refusal(&obstacles.list_obstacles(request).await.unwrap_err());
        assert_eq!((got, named.as_str()), (code, field));
    }
    let request = pb::DeleteObstacleRequest {
        name: "worlds/w/figures/a".into(),
        ..Default::default()
    };
    let refused = obstacles.delete_obstacle(request).await.unwrap_err();
    assert_eq!(refusal(&refused).2, "name");
    assert!(server.obstacles(&world).await.is_empty());
    // A world holds a limited number, and the refusal names the limit.
    for _ in 0..256 {
        server
            .add_obstacle(&world, "", crate_at(3.0))
            .await
            .unwrap();
    }
    let full = server.add_obstacle(&world, "", crate_at(3.0)).await;
    let full = full.unwrap_err();
    assert_eq!(full.code(), Code::ResourceExhausted);
    assert!(full.message().contains("256"), "{}", full.message());
    // Frames of a full world arrive.
    let frame = server.client.watch(&world, view(&["touches"]), None).await;
    assert!(frame.unwrap().message().await.unwrap().is_some());
    server.stop().await;
}
