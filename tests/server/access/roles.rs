//! Calls allowed for each role.

use crate::access::support::{Guarded, figure, grant, refusal, role, world};
use prost_reflect::{DescriptorPool, DynamicMessage, MethodDescriptor, ReflectMessage as _, Value};
use sinew_client::Client;
use sinew_server::access::roles::{Role, Roles, Rule, rule, table};
use sinew_wire::{DESCRIPTOR_SET, pb};
use std::collections::BTreeMap;
use tonic::codec::{Codec, DecodeBuf, Decoder, EncodeBuf, Encoder};
use tonic::transport::{Certificate, ClientTlsConfig, Endpoint};
use tonic::{Code, Request, Status};

/// Messages as bytes.
#[derive(Default)]
struct Raw;

impl Codec for Raw {
    type Encode = Vec<u8>;
    type Decode = Vec<u8>;
    type Encoder = Self;
    type Decoder = Self;
    fn encoder(&mut self) -> Self {
        Self
    }
    fn decoder(&mut self) -> Self {
        Self
    }
}

impl Encoder for Raw {
    type Item = Vec<u8>;
    type Error = Status;
    fn encode(&mut self, item: Vec<u8>, out: &mut EncodeBuf<'_>) -> Result<(), Status> {
        bytes::BufMut::put_slice(out, &item);
        Ok(())
    }
}

impl Decoder for Raw {
    type Item = Vec<u8>;
    type Error = Status;
    fn decode(&mut self, from: &mut DecodeBuf<'_>) -> Result<Option<Vec<u8>>, Status> {
        let mut item = vec![0; bytes::Buf::remaining(from)];
        bytes::Buf::copy_to_slice(from, &mut item);
        Ok(Some(item))
    }
}

/// Fills the names of a request so that they exist in this world.
fn name_things(message: &mut DynamicMessage, method: &str, world: &str) {
    let kind = [
        "Figure",
        "Obstacle",
        "Grant",
        "Clip",
        "Body",
        "GetCheckpoint",
        "DeleteCheckpoint",
        "StopRecording",
        "GetRecording",
        "DeleteRecording",
        "ExportRecording",
    ];
    let kind = kind
        .into_iter()
        .find(|k| method.contains(k))
        .unwrap_or("World");
    let name = match kind {
        "Figure" => format!("{world}/figures/a"),
        "Obstacle" => format!("{world}/obstacles/o"),
        "Grant" => format!("{world}/grants/creator"),
        "GetCheckpoint" | "DeleteCheckpoint" => format!("{world}/checkpoints/c"),
        k if k.ends_with("Recording") => format!("{world}/recordings/r"),
        "Clip" => "clips/wave".to_owned(),
        "Body" => "bodies/adult-man".to_owned(),
        _ => world.to_owned(),
    };
    let fields: Vec<_> = message.descriptor().fields().collect();
    for field in fields {
        let text = |s: &str| Value::String(s.to_owned());
        let value = match field.name() {
            // Without a world, each caller sees the permitted part of all worlds.
            "world" if method == "GetServerStats" => continue,
            // Forking needs its own role, tested below.
            "world" if method == "ForkWorld" => continue,
            "world" | "parent" if field.kind().as_message().is_none() => text(world),
            "name" => text(&name),
            "figure" if field.kind().as_message().is_none() => text(&format!("{world}/figures/a")),
            "clip" if method == "PlayClip" => text("clips/wave"),
            "figure_ids" if method.contains("Motion") => Value::List(vec![text("a")]),
            "update_mask" => {
                let path = if kind == "Grant" {
                    "max_priority"
                } else {
                    "display_name"
                };
                let mut mask = DynamicMessage::new(field.kind().as_message().unwrap().clone());
                mask.set_field_by_name("paths", Value::List(vec![text(path)]));
                Value::Message(mask)
            }
            "world" | "figure" | "obstacle" | "grant" | "header" => {
                let mut inner = DynamicMessage::new(field.kind().as_message().unwrap().clone());
                let method = if field.name() == "header" {
                    "PushMotion"
                } else {
                    method
                };
                name_things(&mut inner, method, world);
                Value::Message(inner)
            }
            _ => continue,
        };
        message.set_field(&field, value);
    }
}

/// Makes a call in its streaming form, which fits every call, and returns how it begins.
async fn call(
    server: &Guarded,
    method: &MethodDescriptor,
    token: &str,
    world: &str,
) -> Result<(), Status> {
    let mut message = DynamicMessage::new(method.input());
    name_things(&mut message, method.name(), world);
    let tls = ClientTlsConfig::new().ca_certificate(Certificate::from_pem(server.root.pem()));
    let endpoint = Endpoint::from_shared(format!("https://{}", server.address)).unwrap();
    let channel = endpoint.tls_config(tls).unwrap().connect().await.unwrap();
    let mut grpc = tonic::client::Grpc::new(channel);
    grpc.ready().await.unwrap();
    let path = format!("/{}/{}", method.parent_service().full_name(), method.name());
    let bytes = prost::Message::encode_to_vec(&message);
    let mut request = Request::new(tokio_stream::once(bytes));
    let bearer = format!("Bearer {token}").parse().unwrap();
    request.metadata_mut().insert("authorization", bearer);
    let mut answer = grpc
        .streaming(request, path.parse().unwrap(), Raw)
        .await?
        .into_inner();
    answer.message().await.map(|_| ())
}

#[tokio::test(flavor = "multi_thread")]
async fn each_role_may_make_the_calls_that_it_is_for_and_no_others() {
    let more = [
        ("max_worlds", "64"),
        ("max_client_share", "1"),
        ("max_client_calls_per_s", "0"),
    ];
    let server = Guarded::start(&more).await;
    let admin = server
        .client("admin", &[Role::Owner, Role::Creator], None)
        .await;
    let pool = DescriptorPool::decode(DESCRIPTOR_SET).unwrap();
    let services: Vec<_> = pool.services().collect();
    let mut methods: Vec<MethodDescriptor> = services.iter().flat_map(|s| s.methods()).collect();
    // Calls that delete come last, and the world itself at the very end.
    methods.sort_by_key(|m| match m.name() {
        "DeleteWorld" => 2,
        n if n.starts_with("Delete") || n.starts_with("Remove") => 1,
        _ => 0,
    });
    assert_eq!(methods.len(), table().len());
    let mut allowed: BTreeMap<&str, usize> = BTreeMap::new();
    for held in [None].into_iter().chain(Role::ALL.map(Some)) {
        let label = held.map_or("stranger", Role::name);
        let world = world(&admin, &format!("w-{label}"), true).await;
        figure(&admin, &world, "a").await;
        let roles: Roles = held.into_iter().chain([Role::Member]).collect();
        let given: Vec<Role> = held.into_iter().collect();
        let token = crate::access::support::token(&server.secret, label, &given, None);
        for method in &methods {
            let path = format!("/{}/{}", method.parent_service().full_name(), method.name());
            let Rule::Needs(needed) = rule(&path) else {
                panic!("{path} does not say what it needs");
            };
            // A caller whose token owns worlds creates those named in it.
            let may =
                roles.contain(needed) || (needed == Role::Creator && roles.contain(Role::Owner));
            let result = call(&server, method, &token, &world).await;
            let denied = match &result {
                Err(e) if e.code() == Code::PermissionDenied => {
                    assert_eq!(refusal(e).1, "ROLE_REQUIRED", "{label} {path}: {e:?}");
                    true
                }
                Err(e) if e.code() == Code::Unauthenticated => panic!("{label} {path}: {e:?}"),
                _ => false,
            };
            assert_eq!(denied, !may, "{label} {path}: {result:?}");
            *allowed.entry(label).or_default() += usize::from(may);
        }
    }
    // Higher roles may do more: the table differs between roles.
    assert!(allowed["stranger"] < allowed["viewer"] && allowed["viewer"] < allowed["driver"]);
    assert!(allowed["driver"] < allowed["director"] && allowed["director"] < allowed["owner"]);
}

async fn names(client: &Client) -> Vec<String> {
    let listed = client
        .worlds()
        .list_worlds(pb::ListWorldsRequest::default())
        .await;
    listed
        .unwrap()
        .into_inner()
        .worlds
        .into_iter()
        .map(|w| w.name)
        .collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn lists_show_what_one_may_see_and_a_name_is_no_more_than_a_guess() {
    let server = Guarded::start(&[]).await;
    let a = server
        .client("a", &[Role::Owner], Some(&["studio-a-*"]))
        .await;
    let b = server
        .client("b", &[Role::Owner], Some(&["studio-b-*"]))
        .await;
    let stage = world(&a, "studio-a-stage", true).await;
    let other = world(&b, "studio-b-stage", true).await;
    assert_eq!(names(&a).await, [&*stage]);
    assert_eq!(names(&b).await, [&*other]);
    // A name outside the token, a name that the server would choose, and a name of the other studio.
    for id in ["studio-b-mine", "", "lobby"] {
        let request = pb::CreateWorldRequest {
            world_id: id.into(),
            ..Default::default()
        };
        let e = a.worlds().create_world(request).await.unwrap_err();
        assert_eq!(
            refusal(&e),
            (Code::PermissionDenied, "NAME_NOT_GRANTED".into()),
            "{id}"
        );
    }
    let get = |client: &Client, name: &str| {
        let (mut worlds, name) = (client.worlds(), name.to_owned());
        async move { worlds.get_world(pb::GetWorldRequest { name }).await }
    };
    // The existence of such a world is not revealed.
    let there = get(&a, &other).await.unwrap_err();
    let not = get(&a, "worlds/studio-b-none").await.unwrap_err();
    assert_eq!(refusal(&there), refusal(&not));
    assert_eq!(refusal(&there).0, Code::PermissionDenied);
    assert_eq!(
        get(&a, "worlds/studio-a-none").await.unwrap_err().code(),
        Code::NotFound
    );
    let stats = |client: &Client| {
        let mut server = client.server();
        async move {
            let stats = server
                .get_server_stats(pb::GetServerStatsRequest::default())
                .await;
            let worlds = stats.unwrap().into_inner().worlds;
            worlds.into_iter().map(|w| w.world).collect::<Vec<_>>()
        }
    };
    assert_eq!(stats(&a).await, [&*stage]);
    // A guest sees a granted figure, as long as the grant lasts.
    let guest = server.client("guest", &[], None).await;
    assert_eq!(names(&guest).await, Vec::<String>::new());
    let name = grant(&a, &stage, role("user:guest", pb::Role::Viewer)).await;
    assert_eq!(names(&guest).await, [&*stage]);
    let mut frames = guest
        .watch(&stage, pb::View::default(), None)
        .await
        .unwrap();
    frames.message().await.unwrap();
    a.access()
        .delete_grant(pb::DeleteGrantRequest {
            name,
            ..Default::default()
        })
        .await
        .unwrap();
    let e = loop {
        match frames.message().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    };
    assert_eq!(
        refusal(&e),
        (Code::PermissionDenied, "ROLE_REQUIRED".into())
    );
    assert_eq!(names(&guest).await, Vec::<String>::new());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_perturber_pushes_as_hard_and_as_often_as_its_grant_says() {
    let server = Guarded::start(&[]).await;
    let owner = server.client("owner", &[Role::Creator], None).await;
    let stage = world(&owner, "w", true).await;
    figure(&owner, &stage, "a").await;
    let bounds = pb::PerturbationBounds {
        max_force_newtons: Some(100.0),
        max_rate_hz: Some(0.2),
        ..Default::default()
    };
    let pusher = pb::Grant {
        bounds: Some(bounds),
        ..role("user:p", pb::Role::Perturber)
    };
    grant(&owner, &stage, pusher).await;
    let p = server.client("p", &[], None).await;
    let x = |x| Some(pb::Vector3 { x, y: 0.0, z: 0.0 });
    let force = |newtons: f64| {
        pb::perturbation::Kind::Force(pb::Force {
            segment: "chest".into(),
            force_newtons: x(newtons),
            duration_s: 0.1,
            ..Default::default()
        })
    };
    let all = |client: &Client, kinds: Vec<pb::perturbation::Kind>| {
        let mut service = client.perturbations();
        let perturbation = |kind| pb::Perturbation {
            figure_id: "a".into(),
            kind: Some(kind),
            ..Default::default()
        };
        let request = pb::ApplyPerturbationsRequest {
            world: stage.clone(),
            perturbations: kinds.into_iter().map(perturbation).collect(),
            ..Default::default()
        };
        async move { service.apply_perturbations(request).await }
    };
    let push = |client: &Client, newtons: f64| all(client, vec![force(newtons)]);
    let bound = (Code::PermissionDenied, "PERTURBATION_BOUND".to_owned());
    let e = push(&p, 101.0).await.unwrap_err();
    assert_eq!(refusal(&e), bound);
    // Ten seconds' worth are two.
    let e = all(&p, vec![force(1.0); 3]).await.unwrap_err();
    assert_eq!(refusal(&e), bound);
    let thrown = pb::perturbation::Kind::Load(pb::Load {
        segment: "chest".into(),
        mass_kg: 1.0,
        velocity_mps: x(11.0),
        ..Default::default()
    });
    let e = all(&p, vec![thrown]).await.unwrap_err();
    assert_eq!(refusal(&e), bound);
    push(&p, 99.0).await.unwrap();
    let e = push(&p, 2.0).await.unwrap_err();
    assert_eq!(
        refusal(&e),
        bound,
        "the world stands: they would act together"
    );
    let e = push(&p, 1.0).await.unwrap_err();
    assert_eq!(
        refusal(&e),
        (Code::ResourceExhausted, "LIMIT_REACHED".into())
    );
    use tonic_types::StatusExt as _;
    let retry = e
        .get_error_details()
        .retry_info()
        .unwrap()
        .retry_delay
        .unwrap();
    assert!(
        retry.as_secs_f64() > 3.0 && retry.as_secs_f64() <= 5.0,
        "{retry:?}"
    );
    // The owner has no bound.
    push(&owner, 5000.0).await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn who_may_watch_no_longer_reads_no_more_of_the_past() {
    let server = Guarded::start(&[]).await;
    let owner = server.client("owner", &[Role::Creator], None).await;
    let stage = world(&owner, "w", true).await;
    figure(&owner, &stage, "a").await;
    let step = pb::StepWorldRequest {
        name: stage.clone(),
        tick_count: 900,
        ..Default::default()
    };
    owner.worlds().step_world(step).await.unwrap();
    let name = grant(&owner, &stage, role("user:guest", pb::Role::Viewer)).await;
    let guest = server.client("guest", &[], None).await;
    // More frames than the queue to an idle reader can hold.
    let request = pb::ReadHistoryRequest {
        name: stage.clone(),
        view: Some(pb::View {
            fields: Some(prost_types::FieldMask {
                paths: vec!["*".into()],
            }),
            encoding: pb::Encoding::Double.into(),
            ..Default::default()
        }),
        ..Default::default()
    };
    let mut past = guest
        .history()
        .read_history(request)
        .await
        .unwrap()
        .into_inner();
    past.message().await.unwrap();
    let delete = pb::DeleteGrantRequest {
        name,
        ..Default::default()
    };
    owner.access().delete_grant(delete).await.unwrap();
    let e = loop {
        match past.message().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("read to the end"),
            Err(e) => break e,
        }
    };
    assert_eq!(
        refusal(&e),
        (Code::PermissionDenied, "ROLE_REQUIRED".into())
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn only_directors_of_a_world_read_and_fork_its_state() {
    let server = Guarded::start(&[]).await;
    let admin = server
        .client("admin", &[Role::Owner, Role::Creator], None)
        .await;
    let world = world(&admin, "w", true).await;
    let keep = |client: &Client| {
        let mut checkpoints = client.checkpoints();
        let name = world.clone();
        async move {
            let request = pb::CheckpointWorldRequest {
                name,
                ..Default::default()
            };
            checkpoints.checkpoint_world(request).await
        }
    };
    let kept = keep(&admin).await.unwrap().into_inner().checkpoint.unwrap();
    let maker = server.client("maker", &[Role::Creator], None).await;
    let viewer = [Role::Viewer, Role::Creator];
    let viewer = server.client("viewer", &viewer, None).await;
    use pb::fork_world_request::Source;
    let sources = [
        Source::World(world.clone()),
        Source::Checkpoint(kept.name.clone()),
    ];
    for (client, may) in [(&maker, false), (&viewer, false), (&admin, true)] {
        for source in sources.clone() {
            let request = pb::ForkWorldRequest {
                source: Some(source),
                paused: true,
                ..Default::default()
            };
            let forked = client.checkpoints().fork_world(request).await;
            match forked {
                Ok(_) => assert!(may),
                Err(e) => assert!(!may && e.code() == Code::PermissionDenied, "{e:?}"),
            }
        }
        let request = pb::GetCheckpointRequest {
            name: kept.name.clone(),
            return_data: true,
        };
        let read = client.checkpoints().get_checkpoint(request).await;
        assert_eq!(read.is_ok(), may, "{read:?}");
        assert_eq!(keep(client).await.is_ok(), may);
    }
}
