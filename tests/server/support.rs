//! The server in this process, with requests that many tests make.

use sinew_client::Client;
use sinew_server::app::App;
use sinew_server::config::Config;
use sinew_wire::pb;
use std::net::SocketAddr;
use std::sync::Arc;
use tonic::{Code, Status};
use tonic_types::StatusExt;

/// Bits of `status.flags`.
pub const FALLEN: i32 = 1 << 6;
pub const FROZEN: i32 = 1 << 7;

/// A server that ends when it is dropped.
pub struct TestServer {
    pub address: SocketAddr,
    pub client: Client,
    pub app: Arc<App>,
    stop: Option<tokio::sync::oneshot::Sender<()>>,
    ended: Option<tokio::task::JoinHandle<()>>,
}

impl TestServer {
    pub async fn start() -> Self {
        Self::with(&[]).await
    }

    /// Starts it with settings other than the defaults.
    pub async fn with(settings: &[(&str, &str)]) -> Self {
        // The speed of this build on this machine must affect only the tests that are about it.
        let flags: Vec<_> = [("max_tick_budget", "1000"), ("lame_duck_s", "0")]
            .iter()
            // Parallel tests must not wait for each other's ticks either.
            .chain(&[("tick_priority", "plain")])
            .chain(settings)
            .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()))
            .collect();
        let config = Config::load(None, std::iter::empty(), &flags).unwrap();
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
        let (signal, stopping) = tokio::sync::watch::channel(false);
        let app = Arc::new(App::new(Arc::new(config), stopping).unwrap());
        let served = app.clone();
        let ended = tokio::spawn(async move {
            let shutdown = async move {
                let _ = stopped.await;
            };
            sinew_server::serve(served, listener, shutdown, signal)
                .await
                .unwrap();
        });
        let client = Client::connect(&address.to_string()).await.unwrap();
        Self {
            address,
            client,
            app,
            stop: Some(stop),
            ended: Some(ended),
        }
    }

    /// Begins to shut down.
    pub fn begin_stop(&mut self) {
        drop(self.stop.take());
    }

    /// Shuts down and waits for the end.
    pub async fn stop(mut self) {
        drop(self.stop.take());
        self.ended.take().unwrap().await.unwrap();
    }

    /// A paused world, so that tests decide when it moves.
    pub async fn paused_world(&self, id: &str) -> String {
        self.world(id, true, pb::World::default()).await
    }

    pub async fn world(&self, id: &str, paused: bool, world: pb::World) -> String {
        self.client
            .worlds()
            .create_world(pb::CreateWorldRequest {
                world_id: id.into(),
                world: Some(world),
                paused,
                ..Default::default()
            })
            .await
            .unwrap()
            .into_inner()
            .world
            .unwrap()
            .name
    }

    pub async fn figure(&self, world: &str, id: &str) -> pb::Figure {
        self.client
            .figures()
            .create_figure(pb::CreateFigureRequest {
                parent: world.into(),
                figure_id: id.into(),
                figure: None,
                ..Default::default()
            })
            .await
            .unwrap()
            .into_inner()
            .figure
            .unwrap()
    }

    pub async fn step(&self, world: &str, tick_count: i32) -> pb::StepWorldResponse {
        self.client
            .worlds()
            .step_world(pb::StepWorldRequest {
                name: world.into(),
                tick_count,
                ..Default::default()
            })
            .await
            .unwrap()
            .into_inner()
    }

    /// A figure as it is now.
    pub async fn look(&self, name: &str) -> pb::Figure {
        let name = name.into();
        let request = pb::GetFigureRequest { name };
        let got = self.client.figures().get_figure(request).await;
        got.unwrap().into_inner().figure.unwrap()
    }

    /// Plays a clip; the world time of its first frame, s.
    pub async fn play(&self, figure: &str, clip: &str, reset: bool) -> f64 {
        let request = pb::PlayClipRequest {
            figure: figure.into(),
            clip: clip.into(),
            reset,
            ..Default::default()
        };
        let played = self.client.motions().play_clip(request).await;
        played.unwrap().into_inner().start_time_s
    }

    /// The latest frame in double precision.
    pub async fn frame(&self, world: &str, fields: &[&str]) -> pb::WorldFrame {
        self.client
            .states()
            .get_world_frame(pb::GetWorldFrameRequest {
                world: world.into(),
                tick: None,
                view: Some(view(fields)),
            })
            .await
            .unwrap()
            .into_inner()
            .frame
            .unwrap()
    }
}

/// A view of these fields in double precision.
pub fn view(fields: &[&str]) -> pb::View {
    pb::View {
        fields: Some(prost_types::FieldMask {
            paths: fields.iter().map(|f| (*f).to_owned()).collect(),
        }),
        encoding: pb::Encoding::Double.into(),
        ..Default::default()
    }
}

/// The reason and the field of a refusal.
pub fn refusal(status: &Status) -> (Code, String, String) {
    let details = status.get_error_details();
    let reason = details
        .error_info()
        .map(|i| i.reason.clone())
        .expect("every refusal has an ErrorInfo");
    let field = details
        .bad_request()
        .and_then(|b| b.field_violations.first())
        .map(|v| v.field.clone())
        .unwrap_or_default();
    (status.code(), reason, field)
}

/// Desired motion of a lifted right arm, one frame per 1/60 s.
pub fn arm_frame(figure: &str, i: i64) -> pb::MotionFrame {
    let t = i as f64 / 60.0;
    let mut angles = vec![0.0; 39];
    angles[19] = 0.6 - 0.6 * (1.5 * t).cos(); // right elbow
    let mut velocity = vec![0.0; 45];
    velocity[6 + 19] = 0.9 * (1.5 * t).sin();
    pb::MotionFrame {
        sequence: i,
        source_time_ns: (t * 1e9) as i64,
        figures: vec![pb::FigureMotion {
            figure_id: figure.into(),
            joint_angles_rad: angles,
            velocity,
            planted: vec![true, true],
            ..Default::default()
        }],
    }
}

/// A drive whose motion is used a fixed time after its arrival, so that the result depends on ticks alone.
pub fn header(world: &str, figure: &str, driver: &str) -> pb::DriveHeader {
    pb::DriveHeader {
        world: world.into(),
        figure_ids: vec![figure.into()],
        driver_id: driver.into(),
        playout_delay_ms: Some(0.0),
        ..Default::default()
    }
}
