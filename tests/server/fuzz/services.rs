//! Complete requests: scanned, decoded, converted and carried out by the services, in this process and without a
//! network.

use crate::fuzz::edit::edits;
use crate::fuzz::messages::{Pool, bytes_of, methods, request};
use crate::fuzz::runner;
use axum::body::Body;
use http::Request;
use http_body_util::BodyExt as _;
use proptest::prelude::*;
use prost_reflect::MethodDescriptor;
use sinew_server::access::caller::{Caller, Identity};
use sinew_server::access::roles;
use sinew_server::api;
use sinew_server::app::App;
use sinew_server::config::Config;
use sinew_wire::pb;
use sinew_wire::types::WorldCondition;
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;
use tonic::Code;
use tonic::codegen::Service as _;

/// Number of cases after which the worlds are made again.
const ANEW: u64 = 500;
/// Longest time for an answer, s; a stream is left after its first message, or after a while.
const PATIENCE: Duration = Duration::from_secs(30);
const STREAM: Duration = Duration::from_millis(20);

struct Services {
    runtime: tokio::runtime::Runtime,
    router: axum::Router,
    app: Arc<App>,
    _stop: tokio::sync::watch::Sender<bool>,
}

/// Result of a call: its code, and whether an error gave a reason.
type Outcome = Option<(Code, bool)>;

impl Services {
    fn new() -> Self {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .enable_all()
            .build()
            .unwrap();
        let settings = [
            ("max_worlds", "4"),
            ("max_clips", "8"),
            ("max_figures_per_world", "4"),
            ("max_checkpoints", "8"),
            ("max_simulation_s", "1"),
            ("max_tick_budget", "1000"),
            ("max_client_share", "1"),
            ("max_client_calls_per_s", "0"),
        ];
        let flags: Vec<_> = settings.map(|(a, b)| (a.to_owned(), b.to_owned())).into();
        let config = Config::load(None, std::iter::empty(), &flags).unwrap();
        let (stop, stopping) = tokio::sync::watch::channel(false);
        let guard = runtime.enter();
        let app = Arc::new(App::new(Arc::new(config), stopping).unwrap());
        let mut routes = tonic::service::Routes::builder();
        api::add_services(&mut routes, &app);
        let router = routes.routes().into_axum_router();
        drop(guard);
        Self {
            runtime,
            router,
            app,
            _stop: stop,
        }
    }

    /// Sends bytes as the message of a call.
    fn call(&self, (path, streams): (&str, bool), message: &[u8]) -> Outcome {
        let mut framed = vec![0];
        framed.extend((message.len() as u32).to_be_bytes());
        framed.extend(message);
        let caller = Caller {
            identity: Identity::anonymous(),
            client: "fuzz".into(),
            order: "fuzz".into(),
            rule: roles::rule(path),
            call: path.into(),
        };
        let request = Request::post(path)
            .header("content-type", "application/grpc")
            .header("te", "trailers")
            .extension(caller)
            .body(Body::from(framed))
            .unwrap();
        let mut router = self.router.clone();
        let answered = async {
            let response = router.call(request).await.unwrap();
            let (head, mut body) = response.into_parts();
            let mut trailers = head.headers;
            while !trailers.contains_key("grpc-status") {
                // Unary answers end at once; streams of the world continue, so they are left.
                let patience = if streams { STREAM } else { PATIENCE };
                match tokio::time::timeout(patience, body.frame()).await {
                    Ok(Some(frame)) => match frame.unwrap().into_trailers() {
                        Ok(t) => trailers.extend(t),
                        Err(_) if streams => return None,
                        Err(_) => {}
                    },
                    Ok(None) => break,
                    Err(_) if streams => return None,
                    Err(_) => panic!("{path}: no end of the answer"),
                }
            }
            let code = trailers.get("grpc-status")?.to_str().unwrap();
            let told = trailers.contains_key("grpc-status-details-bin");
            if code == "13" {
                eprintln!("{path}: {:?}", trailers.get("grpc-message"));
            }
            Some((Code::from(code.parse::<i32>().unwrap()), told))
        };
        self.runtime.block_on(async {
            let answered = tokio::time::timeout(PATIENCE, answered).await;
            answered.unwrap_or_else(|_| panic!("{path}: no answer within {PATIENCE:?}"))
        })
    }

    fn ask<M: prost::Message>(&self, path: &str, message: &M) {
        let outcome = self.call((path, false), &message.encode_to_vec());
        assert!(
            matches!(outcome, Some((Code::Ok, _))),
            "{path}: {outcome:?}"
        );
    }

    /// A world with figures, and nothing else.
    fn anew(&self) {
        for world in self.app.worlds.list() {
            let name = format!("worlds/{}", world.id);
            let request = pb::DeleteWorldRequest {
                name,
                ..Default::default()
            };
            self.ask("/sinew.v1.WorldService/DeleteWorld", &request);
        }
        let world = pb::CreateWorldRequest {
            world_id: "w".into(),
            paused: true,
            ..Default::default()
        };
        self.ask("/sinew.v1.WorldService/CreateWorld", &world);
        for id in ["a", "b"] {
            let figure = pb::CreateFigureRequest {
                parent: "worlds/w".into(),
                figure_id: id.into(),
                ..Default::default()
            };
            self.ask("/sinew.v1.FigureService/CreateFigure", &figure);
        }
        let checkpoint = pb::CheckpointWorldRequest {
            name: "worlds/w".into(),
            checkpoint_id: "k".into(),
            ..Default::default()
        };
        self.ask("/sinew.v1.CheckpointService/CheckpointWorld", &checkpoint);
    }

    /// Fails if a world has failed. The count of failed worlds in the metrics is that of the whole process, in which
    /// other tests fail worlds on purpose.
    fn check(&self) {
        for world in self.app.worlds.list() {
            let failure = world.described().world.condition.clone();
            assert!(!matches!(failure, WorldCondition::Failed(_)), "{failure:?}");
        }
    }
}

fn path(method: &MethodDescriptor) -> String {
    format!("/{}/{}", method.parent_service().full_name(), method.name())
}

/// Any call with any bytes is answered, with a reason where it is refused, and harms no world.
#[test]
fn calls_are_carried_out_or_refused_with_a_reason() {
    let services = Services::new();
    let methods = methods();
    let pool = Pool {
        bytes: vec![
            b"HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n}\nMOTION\n".to_vec(),
            include_bytes!("../../corpus/wave.vrm.bvh")[..4000].to_vec(),
        ],
        mild: false,
    };
    let (cases, seen) = (Cell::new(0u64), std::cell::RefCell::new(BTreeMap::new()));
    let carried_out = std::cell::RefCell::new(BTreeSet::new());
    let arbitrary = prop::collection::vec(any::<u8>(), 0..200);
    let strategy = (0..methods.len(), request(), arbitrary);
    let done = runner(3000).run(&strategy, |(method, case, arbitrary)| {
        services.check();
        if cases.get() % ANEW == 0 {
            services.anew();
        }
        cases.set(cases.get() + 1);
        let method = &methods[method];
        let bytes = bytes_of(&method.input(), &pool, &case, arbitrary);
        let outcome = services.call((&path(method), method.is_server_streaming()), &bytes);
        let mut seen = seen.borrow_mut();
        match outcome {
            None => *seen.entry("streams".to_owned()).or_insert(0u64) += 1,
            Some((code, told)) => {
                *seen.entry(format!("{code:?}")).or_default() += 1;
                if code == Code::Ok {
                    carried_out.borrow_mut().insert(method.name().to_owned());
                }
                let fault = matches!(code, Code::Internal | Code::Unknown | Code::DataLoss);
                prop_assert!(!fault, "{}: {:?}", method.full_name(), code);
                prop_assert!(
                    told || code == Code::Ok,
                    "{}: {code:?} without a reason",
                    method.full_name()
                );
            }
        }
        Ok(())
    });
    if let Err(e) = done {
        panic!("{e}");
    }
    services.check();
    println!("{} cases: {:?}", cases.get(), seen.borrow());
    let (all, done) = (methods.len(), carried_out.borrow().len());
    println!("{done} of {all} calls were carried out at least once: {carried_out:?}");
    assert!(seen.borrow().contains_key("Ok") && seen.borrow().contains_key("InvalidArgument"));
}

/// The server's part of a checkpoint, with a correct checksum, as a stranger may send it. The part of the physics has
/// its own test (`tests/checkpoints.rs`).
#[test]
fn forged_checkpoints_of_worlds_are_refused_or_make_one() {
    use xxhash_rust::xxh3::xxh3_64;
    let services = Services::new();
    services.anew();
    let kept = services.app.checkpoints.get("w", "k").unwrap();
    let good = kept.bytes.clone();
    // Magic and format of the server, then those of the physics with numerics, tick, length and checksum. The server's
    // part lies at the end.
    const HEADER: usize = 10 + 44;
    let part = good.len() - 512.min(good.len() - HEADER);
    let (made, refused) = (Cell::new(0u64), Cell::new(0u64));
    let done = runner(500).run(&(edits(3), any::<bool>()), |(edits, whole)| {
        let mut bytes = good.clone();
        if whole {
            bytes = crate::fuzz::edit::damaged(bytes, &edits);
        } else {
            let edited = crate::fuzz::edit::damaged(good[part..].to_vec(), &edits);
            bytes.truncate(part);
            bytes.extend(edited);
            let body = (bytes.len() - HEADER) as u64;
            bytes[38..46].copy_from_slice(&body.to_le_bytes());
            let mut sealed = bytes[22..38].to_vec();
            sealed.extend(xxh3_64(&bytes[HEADER..]).to_le_bytes());
            bytes[46..54].copy_from_slice(&xxh3_64(&sealed).to_le_bytes());
        }
        match sinew_server::checkpoints::decode("data", &bytes) {
            Ok(mut scene) => {
                made.set(made.get() + 1);
                // A tick takes longer than reading a checkpoint; `tests/checkpoints.rs` tests the ticks of forged
                // worlds.
                if made.get() % 50 != 1 {
                    return Ok(());
                }
                // As the server does: a panic fails the world.
                let step = std::panic::AssertUnwindSafe(|| {
                    scene.sample(0.0);
                    scene.step(sinew_server::engine::Planning::InTick);
                });
                drop(std::panic::catch_unwind(step));
            }
            Err(_) => refused.set(refused.get() + 1),
        }
        Ok(())
    });
    if let Err(e) = done {
        panic!("{e}");
    }
    println!("{} made a world, {} refused", made.get(), refused.get());
    assert!(made.get() > 0 && refused.get() > 0);
}
