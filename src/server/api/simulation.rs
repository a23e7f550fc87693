//! `SimulationService`.

use super::{Api, caller, client, encoded, long, memory, refusal, upload};
use crate::access::caller::Caller;
use crate::edge::Upload;
use crate::encoded::Encoded;
use crate::engine::{self, Clip};
use crate::library::Manner;
use crate::progress::WorkProgress;
use crate::shares::ClientKey;
use crate::simulate::{self, SimulationLimits, Sink};
use crate::workers::Turn;
use sinew_physics::body::Body;
use sinew_physics::plan::ReadingReport;
use sinew_physics::plan::cycle;
use sinew_wire::convert::simulation::{self, SimulationSource};
use sinew_wire::pb::{self, simulation_service_server::SimulationService};
use sinew_wire::status::Fault;
use sinew_wire::types::{MotionSource, SimulationSettings};
use std::sync::Arc;
use std::time::Instant;
use tonic::{Request, Response, Status};

type SimulationSender = long::MessageSender<pb::StreamSimulateClipResponse>;

/// The result of a simulation.
pub(super) struct SimulationResult {
    /// Without frames.
    answer: pb::SimulateClipResponse,
    /// The field of the answer that holds them.
    frames: Encoded,
}

impl SimulationResult {
    /// The whole answer.
    pub(super) fn whole(self) -> Encoded {
        Encoded::of(&self.answer).then(self.frames)
    }
}

/// The motion of a simulation, prepared by the workers that convert files.
async fn motion(
    api: &Api,
    client: &ClientKey,
    (source, upload): (SimulationSource, Upload),
    settings: &SimulationSettings,
    body: &Arc<Body>,
    progress: WorkProgress,
) -> Result<(Arc<Clip>, Option<ReadingReport>), Fault> {
    let (app, body, looped) = (api.0.clone(), body.clone(), settings.looped);
    match source {
        SimulationSource::Clip(id) => {
            let (body_id, manner) = (settings.figure.body.id.clone(), Manner::recorded(looped));
            if let Some(clip) = api.clips.ready(&id, &body_id, manner) {
                return Ok((clip, None));
            }
            let bytes = api.clips.memory(&id)?;
            let work = move |turn: &Turn| {
                let stop = || turn.stop();
                app.clips.prepared(&id, &body_id, &body, manner, &stop)
            };
            let clip = api.conversions.run_large(client, bytes, work).await?;
            Ok((clip, None))
        }
        SimulationSource::File(file) => {
            let bytes = match &file {
                MotionSource::Bvh(data, how) => memory(data.clone(), how.rate_hz).await,
                MotionSource::Postures { .. } => 0, // none is uploaded to be simulated
            };
            let work = move |turn: &Turn| {
                let _upload = upload;
                progress.tell(0.0, 1.0);
                let stop = || turn.stop();
                let (clip, report) = engine::prepare("bvh", "upload", &file, &body, 1.0, &stop)?;
                let clip = Arc::new(clip);
                let repeats = looped.then(|| cycle(&body, &clip)).flatten();
                Ok((repeats.map_or(clip, Arc::new), report))
            };
            api.conversions.run_large(client, bytes, work).await
        }
    }
}

/// Simulates a clip. Frames go into the response, or to `out`.
pub(super) async fn simulate(
    api: &Api,
    (caller, client): (&Caller, ClientKey),
    (r, upload): (pb::SimulateClipRequest, Upload),
    progress: WorkProgress,
    out: Option<SimulationSender>,
) -> Result<SimulationResult, Fault> {
    let limits = SimulationLimits {
        seconds: api.config.max_simulation_s,
        bytes: api.config.max_response_bytes,
    };
    let max_bytes = api.config.max_clip_bytes;
    let (source, settings) = simulation::settings(r, max_bytes, limits.seconds)?;
    if let SimulationSource::Clip(id) = &source {
        super::clips::seen(api, caller, id)?; // an unknown name does not wait for its turn
    }
    let body = api.body("figure.profile", &settings.figure.body).await?;
    let (source, told) = ((source, upload), progress.clone());
    let (clip, report) = motion(api, &client, source, &settings, &body, told).await?;
    let work = move |turn: &Turn| {
        progress.tell(0.0, 1.0);
        let mut parts = out.map(|out| FramePartStream::new(out, turn));
        let sink = Sink {
            progress: &progress,
            parts: parts.as_mut().map(|p| p as &mut dyn simulate::FrameSink),
        };
        let outcome = simulate::run(&settings, &body, clip, limits, (turn, sink))?;
        Ok(SimulationResult {
            answer: simulation::response(&outcome.summary, &outcome.events, report.as_ref()),
            frames: outcome.frames,
        })
    };
    api.simulations.run(&client, work).await
}

/// Frames on their way to a client, a few at a time.
struct FramePartStream<'a> {
    out: SimulationSender,
    turn: &'a Turn,
    frames: Vec<pb::WorldFrame>,
    bytes: usize,
    since: Instant,
}

impl<'a> FramePartStream<'a> {
    fn new(out: SimulationSender, turn: &'a Turn) -> Self {
        Self {
            out,
            turn,
            frames: Vec::new(),
            bytes: 0,
            since: Instant::now(),
        }
    }

    /// Sends the collected frames when the client has room for them.
    fn send(&mut self, share: f64) -> Result<(), Fault> {
        use pb::stream_simulate_clip_response::Message;
        let message = pb::StreamSimulateClipResponse {
            message: Some(Message::Progress(pb::SimulationProgress {
                progress: share,
                frames: std::mem::take(&mut self.frames),
            })),
        };
        self.bytes = 0;
        long::hand_over(&self.out, message, self.turn)?;
        self.since = Instant::now();
        Ok(())
    }
}

impl simulate::FrameSink for FramePartStream<'_> {
    fn take(&mut self, frame: Option<pb::WorldFrame>, share: f64) -> Result<(), Fault> {
        if let Some(frame) = frame {
            self.bytes += long::memory(&frame);
            self.frames.push(frame);
        }
        if self.bytes >= long::PART.0 || self.since.elapsed() >= long::PART.1 {
            self.send(share)?;
        }
        Ok(())
    }

    fn end(&mut self) -> Result<(), Fault> {
        self.send(1.0)
    }
}

#[tonic::async_trait]
impl SimulationService for Api {
    async fn simulate_clip(
        &self,
        request: Request<pb::SimulateClipRequest>,
    ) -> Result<Response<pb::SimulateClipResponse>, Status> {
        let result = async {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let (upload, progress) = (upload(&request), WorkProgress::default());
            let r = (request.into_inner(), upload);
            simulate(self, (&caller, client), r, progress, None).await
        };
        let done = result.await.map_err(refusal)?;
        Ok(encoded(done.whole()))
    }

    type StreamSimulateClipStream = long::Messages<pb::StreamSimulateClipResponse>;

    async fn stream_simulate_clip(
        &self,
        request: Request<pb::StreamSimulateClipRequest>,
    ) -> Result<Response<Self::StreamSimulateClipStream>, Status> {
        use pb::stream_simulate_clip_response::Message;
        let start = || {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let upload = upload(&request);
            let r = request.into_inner().simulate_clip;
            let r = r.ok_or_else(|| Fault::invalid("simulate_clip", "must be given"))?;
            let (api, progress) = (self.clone(), WorkProgress::default());
            let (told, who) = (progress.watch(), caller.clone());
            let work = |out| async move {
                let r = (r, upload);
                let done = simulate(&api, (&who, client), r, progress, Some(out)).await;
                done.map(|done| done.answer)
                    .map_err(|fault| fault.within("simulate_clip"))
            };
            let last = |done| pb::StreamSimulateClipResponse {
                message: Some(Message::SimulateClip(done)),
            };
            Ok(long::LongStream {
                caller,
                permit: None,
                told,
                progress: None::<fn(f64) -> pb::StreamSimulateClipResponse>,
                last,
            }
            .run_with(work, self.stopping.clone()))
        };
        start().map(Response::new).map_err(refusal)
    }
}
