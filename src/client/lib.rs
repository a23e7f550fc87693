//! A thin client: one connection, the generated clients over it, and the few steps that every user of a stream needs.

mod network;
mod simulation;

pub use network::Network;
pub use simulation::Simulation;
pub use sinew_wire::frame::values;

use http_body_util::{BodyExt as _, Limited};
use sinew_wire::convert::world_name;
use sinew_wire::pb;
use sinew_wire::watched::WatchWorldResponse;
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::codegen::Service as _;
use tonic::metadata::{Ascii, MetadataValue};
use tonic::service::Interceptor;
use tonic::service::interceptor::InterceptedService;
use tonic::transport::{Certificate, Channel, ClientTlsConfig, Endpoint, Identity};
use tonic::{Code, Request, Status, Streaming};

/// Largest message that is accepted: an offline simulation with frames.
const MAX_MESSAGE: usize = 64 * 1024 * 1024;
/// Window of one stream: a few frames, so that the frames read are never old.
const STREAM_WINDOW: u32 = 64 * 1024;
/// Batches on their way to the server.
const DRIVE_QUEUE: usize = 8;

/// How a client identifies itself, and how it verifies the server.
#[derive(Clone, Default)]
pub struct Credentials {
    /// Bearer token.
    pub token: Option<String>,
    /// Root certificates with which the server's certificate is checked, PEM; `None`: those of the system.
    pub ca: Option<Vec<u8>>,
    /// Certificate and private key of the client, PEM.
    pub certificate: Option<(Vec<u8>, Vec<u8>)>,
}

impl std::fmt::Debug for Credentials {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Credentials") // secrets stay out of messages
    }
}

/// Puts the token into every request.
#[derive(Clone)]
pub struct WithToken(Option<MetadataValue<Ascii>>);

impl std::fmt::Debug for WithToken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("WithToken")
    }
}

impl Interceptor for WithToken {
    fn call(&mut self, mut request: Request<()>) -> Result<Request<()>, Status> {
        if let Some(value) = &self.0 {
            request
                .metadata_mut()
                .insert("authorization", value.clone());
        }
        Ok(request)
    }
}

/// The channel through which the generated clients call.
pub type Service = InterceptedService<Channel, WithToken>;

/// Why a connection cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ConnectError {
    /// Not an address.
    #[error("{0:?} is not an address: give host:port, for example 127.0.0.1:7463")]
    Address(String),
    /// The credentials cannot be used.
    #[error("the credentials cannot be used: {0}")]
    Credentials(String),
    /// There is no answer.
    #[error("no server answers at {address}: {}", why(error))]
    Refused {
        /// The address.
        address: String,
        /// Why.
        error: tonic::transport::Error,
    },
}

/// A connection to a server. Cheap to clone.
#[derive(Clone, Debug)]
pub struct Client {
    channel: Channel,
    token: WithToken,
}

macro_rules! services {
    ($($(#[doc = $doc:literal])+ $name:ident: $module:ident :: $client:ident;)*) => {
        $($(#[doc = $doc])+
        pub fn $name(&self) -> pb::$module::$client<Service> {
            pb::$module::$client::with_interceptor(self.channel.clone(), self.token.clone())
                .max_decoding_message_size(MAX_MESSAGE)
        })*
    };
}

impl Client {
    /// Connects to `host:port`, `http://host:port` or `https://host:port`.
    ///
    /// # Errors
    /// The address is not valid, or there is no answer.
    pub async fn connect(address: &str) -> Result<Self, ConnectError> {
        Self::connect_with(address, &Credentials::default()).await
    }

    /// As [`Client::connect`], with credentials. Roots or a certificate turn TLS on.
    ///
    /// # Errors
    /// The address is not valid, the credentials cannot be used, or there is no answer.
    pub async fn connect_with(
        address: &str,
        credentials: &Credentials,
    ) -> Result<Self, ConnectError> {
        let encrypted = credentials.ca.is_some() || credentials.certificate.is_some();
        let url = if address.contains("://") {
            address.to_owned()
        } else {
            let scheme = if encrypted { "https" } else { "http" };
            format!("{scheme}://{address}")
        };
        let token = credentials.token.as_ref().map(|token| {
            let mut value = MetadataValue::try_from(format!("Bearer {}", token.trim()))
                .map_err(|_| ConnectError::Credentials("the token has odd characters".into()))?;
            value.set_sensitive(true); // it stays out of logs
            Ok(value)
        });
        let token = WithToken(token.transpose()?);
        let secure = url.starts_with("https://");
        let endpoint = Endpoint::from_shared(url)
            .map_err(|_| ConnectError::Address(address.to_owned()))?
            .connect_timeout(std::time::Duration::from_secs(5))
            .initial_stream_window_size(STREAM_WINDOW)
            .tcp_nodelay(true);
        let endpoint = if secure {
            endpoint
                .tls_config(tls(credentials))
                .map_err(|e| ConnectError::Credentials(why(&e)))?
        } else {
            endpoint
        };
        let channel = endpoint
            .connect()
            .await
            .map_err(|error| ConnectError::Refused {
                address: address.to_owned(),
                error,
            })?;
        Ok(Self { channel, token })
    }

    /// Whether the server as a whole serves.
    ///
    /// # Errors
    /// The server does not answer.
    pub async fn serves(&self) -> Result<bool, Status> {
        self.is_healthy("").await
    }

    /// Whether a service serves, by its full name; `liveness` and `readiness` are others.
    ///
    /// # Errors
    /// The server does not answer, or knows no such service.
    pub async fn is_healthy(&self, service: &str) -> Result<bool, Status> {
        use tonic_health::pb::health_check_response::ServingStatus;
        let mut health = tonic_health::pb::health_client::HealthClient::new(self.channel.clone());
        let service = service.to_owned();
        let request = tonic_health::pb::HealthCheckRequest { service };
        let answer = health.check(request).await?.into_inner();
        Ok(answer.status() == ServingStatus::Serving)
    }

    /// A page of the server, as text, for example `/metrics`. At most 16 MiB of it are read.
    ///
    /// # Errors
    /// There is no such page, or the server does not answer.
    pub async fn page(&self, path: &str) -> Result<String, Status> {
        const MOST: usize = 16 * 1024 * 1024;
        let failed = |e: &dyn std::error::Error| Status::unavailable(format!("{path}: {}", why(e)));
        let mut channel = self.channel.clone();
        let request = http::Request::get(path).body(tonic::body::Body::empty());
        let request = request.map_err(|e| Status::invalid_argument(e.to_string()))?;
        std::future::poll_fn(|cx| channel.poll_ready(cx))
            .await
            .map_err(|e| failed(&e))?;
        let response = channel.call(request).await.map_err(|e| failed(&e))?;
        if !response.status().is_success() {
            return Err(Status::not_found(format!("{path}: {}", response.status())));
        }
        let body = Limited::new(response.into_body(), MOST).collect().await;
        let body = body.map_err(|e| failed(&*e))?.to_bytes();
        Ok(String::from_utf8_lossy(&body).into_owned())
    }

    services! {
        /// `WorldService`.
        worlds: world_service_client::WorldServiceClient;
        /// `FigureService`.
        figures: figure_service_client::FigureServiceClient;
        /// `BodyService`.
        bodies: body_service_client::BodyServiceClient;
        /// `MotionService`.
        motions: motion_service_client::MotionServiceClient;
        /// `PerturbationService`.
        perturbations: perturbation_service_client::PerturbationServiceClient;
        /// `StateService`.
        states: state_service_client::StateServiceClient;
        /// `SimulationService`.
        simulations: simulation_service_client::SimulationServiceClient;
        /// `CheckpointService`.
        checkpoints: checkpoint_service_client::CheckpointServiceClient;
        /// `HistoryService`.
        history: history_service_client::HistoryServiceClient;
        /// `RecordingService`.
        recordings: recording_service_client::RecordingServiceClient;
        /// `ObstacleService`.
        obstacles: obstacle_service_client::ObstacleServiceClient;
        /// `OperationService`.
        operations: operation_service_client::OperationServiceClient;
        /// `ServerService`.
        server: server_service_client::ServerServiceClient;
        /// `AccessService`.
        access: access_service_client::AccessServiceClient;
        /// `ControlService`.
        control: control_service_client::ControlServiceClient;
    }

    /// The world of this name, created with default settings if there is none.
    ///
    /// # Errors
    /// Those of the server.
    pub async fn world(&self, name: &str) -> Result<pb::World, Status> {
        let id = world_name("world", name)?;
        let found = self
            .worlds()
            .get_world(pb::GetWorldRequest { name: name.into() })
            .await;
        match found {
            Err(e) if e.code() == Code::NotFound => Ok(self
                .worlds()
                .create_world(pb::CreateWorldRequest {
                    world_id: id.to_owned(),
                    ..Default::default()
                })
                .await?
                .into_inner()
                .world
                .unwrap_or_default()),
            other => Ok(other?.into_inner().world.unwrap_or_default()),
        }
    }

    /// Frames of a world as they arrive.
    ///
    /// # Errors
    /// Those of the server.
    pub async fn watch(
        &self,
        world: &str,
        view: pb::View,
        resume_tick: Option<i64>,
    ) -> Result<Streaming<WatchWorldResponse>, Status> {
        let request = pb::WatchWorldRequest {
            world: world.into(),
            view: Some(view),
            resume_tick,
        };
        Ok(self.states().watch_world(request).await?.into_inner())
    }

    /// Begins to drive figures live.
    ///
    /// # Errors
    /// Those of the server, for example when another driver already has one of the figures.
    pub async fn drive(&self, header: pb::DriveHeader) -> Result<LiveDriver, Status> {
        use pb::drive_figures_request::Message;
        let (send, receive) = mpsc::channel(DRIVE_QUEUE);
        let first = pb::DriveFiguresRequest {
            message: Some(Message::Header(header)),
        };
        // The queue is empty, so there is room.
        let _ = send.try_send(first);
        let feedback = self
            .motions()
            .drive_figures(ReceiverStream::new(receive))
            .await?
            .into_inner();
        Ok(LiveDriver { send, feedback })
    }
}

fn tls(credentials: &Credentials) -> ClientTlsConfig {
    let tls = ClientTlsConfig::new();
    let tls = match &credentials.ca {
        Some(ca) => tls.ca_certificate(Certificate::from_pem(ca)),
        None => tls.with_native_roots(),
    };
    match &credentials.certificate {
        Some((certificate, key)) => tls.identity(Identity::from_pem(certificate, key)),
        None => tls,
    }
}

/// An error with its causes.
fn why(error: &dyn std::error::Error) -> String {
    let mut out = error.to_string();
    let mut source = error.source();
    while let Some(e) = source {
        out += &format!(": {e}");
        source = e.source();
    }
    out
}

/// A live drive. Dropping it releases the figures.
#[derive(Debug)]
pub struct LiveDriver {
    send: mpsc::Sender<pb::DriveFiguresRequest>,
    feedback: Streaming<pb::DriveFiguresResponse>,
}

impl LiveDriver {
    /// Sends a batch; false if the server has ended the stream (its reason comes from [`Self::feedback`]).
    pub async fn send(&self, frames: Vec<pb::MotionFrame>) -> bool {
        let message = pb::drive_figures_request::Message::Batch(pb::MotionBatch { frames });
        self.send
            .send(pb::DriveFiguresRequest {
                message: Some(message),
            })
            .await
            .is_ok()
    }

    /// The next feedback; `None` at the end of the stream.
    ///
    /// # Errors
    /// Why the server ended the stream.
    pub async fn feedback(&mut self) -> Result<Option<pb::DriveFeedback>, Status> {
        Ok(self.feedback.message().await?.and_then(|m| m.feedback))
    }

    /// Ends the drive and returns the last feedback.
    ///
    /// # Errors
    /// Why the server ended the stream before.
    pub async fn finish(self) -> Result<Option<pb::DriveFeedback>, Status> {
        let Self { send, mut feedback } = self;
        drop(send);
        let mut last = None;
        while let Some(m) = feedback.message().await? {
            last = m.feedback;
        }
        Ok(last)
    }
}
