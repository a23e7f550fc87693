//! `SimulationService`.

use super::{Api, answer, caller, client, long, refusal};
use crate::server::access::caller::Caller;
use crate::server::engine;
use crate::server::library::Manner;
use crate::server::progress::Progress;
use crate::server::shares::Client;
use crate::server::simulate::{self, Limits, Sink};
use crate::server::workers::Turn;
use crate::sim::plan::cycle;
use crate::wire::convert::simulation::{self, Source};
use crate::wire::pb::{self, simulation_service_server::SimulationService};
use crate::wire::status::Fault;
use prost::Message as _;
use std::sync::Arc;
use std::time::Instant;
use tonic::{Request, Response, Status};

type Out = long::Out<pb::StreamSimulateClipResponse>;

/// Simulates a clip. Frames go into the response, or to `out`.
pub(super) async fn simulate(
    api: &Api,
    (caller, client): (&Caller, Client),
    r: pb::SimulateClipRequest,
    progress: Progress,
    out: Option<Out>,
) -> Result<pb::SimulateClipResponse, Fault> {
    let limits = Limits {
        seconds: api.config.max_simulation_s,
        bytes: api.config.max_response_bytes,
    };
    let max_bytes = api.config.max_clip_bytes;
    let (source, settings) = simulation::settings(r, max_bytes, limits.seconds)?;
    if let Source::Clip(id) = &source {
        super::clips::seen(api, caller, id)?; // an unknown name does not wait for its turn
    }
    let app = api.0.clone();
    let work = move |turn: &Turn| {
        progress.tell(0.0, 1.0);
        let stop = || turn.stop();
        let body_id = settings.figure.body.id.clone();
        let body = app.bodies.get("figure.profile", &settings.figure.body)?;
        let (clip, report) = match source {
            Source::Clip(id) => {
                let manner = Manner::recorded(settings.looped);
                let clip = app.clips.prepared(&id, &body_id, &body, manner, &stop)?;
                (clip, None)
            }
            Source::File(file) => {
                let (clip, report) = engine::prepare("bvh", "upload", &file, &body, 1.0, &stop)?;
                let clip = Arc::new(clip);
                let repeats = settings.looped.then(|| cycle(&body, &clip)).flatten();
                (repeats.map_or(clip, Arc::new), report)
            }
        };
        let mut parts = out.map(|out| Parts::new(out, turn));
        let sink = Sink {
            progress: &progress,
            parts: parts.as_mut().map(|p| p as &mut dyn simulate::Parts),
        };
        let outcome = simulate::run(&settings, &body, clip, limits, (turn, sink))?;
        Ok(simulation::response(
            &outcome.summary,
            outcome.frames,
            &outcome.events,
            report.as_ref(),
        ))
    };
    api.simulations.run(&client, work).await
}

/// Frames on their way to a client, a few at a time.
struct Parts<'a> {
    out: Out,
    turn: &'a Turn,
    frames: Vec<pb::WorldFrame>,
    bytes: usize,
    since: Instant,
}

impl<'a> Parts<'a> {
    fn new(out: Out, turn: &'a Turn) -> Self {
        Self {
            out,
            turn,
            frames: Vec::new(),
            bytes: 0,
            since: Instant::now(),
        }
    }

    /// Sends what there is, when the client has room for it.
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

impl simulate::Parts for Parts<'_> {
    fn take(&mut self, frame: Option<pb::WorldFrame>, share: f64) -> Result<(), Fault> {
        if let Some(frame) = frame {
            self.bytes += frame.encoded_len();
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
            let (r, progress) = (request.into_inner(), Progress::default());
            simulate(self, (&caller, client), r, progress, None).await
        };
        answer(result.await)
    }

    type StreamSimulateClipStream = long::Messages<pb::StreamSimulateClipResponse>;

    async fn stream_simulate_clip(
        &self,
        request: Request<pb::StreamSimulateClipRequest>,
    ) -> Result<Response<Self::StreamSimulateClipStream>, Status> {
        use pb::stream_simulate_clip_response::Message;
        let start = || {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let r = request.into_inner().simulate_clip;
            let r = r.ok_or_else(|| Fault::invalid("simulate_clip", "must be given"))?;
            let (api, progress) = (self.clone(), Progress::default());
            let (told, who) = (progress.watch(), caller.clone());
            let work = |out| async move {
                let done = simulate(&api, (&who, client), r, progress, Some(out)).await;
                done.map_err(|fault| fault.within("simulate_clip"))
            };
            let last = |done| pb::StreamSimulateClipResponse {
                message: Some(Message::SimulateClip(done)),
            };
            Ok(long::Stream {
                caller,
                told,
                progress: None::<fn(f64) -> pb::StreamSimulateClipResponse>,
                last,
            }
            .run_with(work, self.stopping.clone()))
        };
        start().map(Response::new).map_err(refusal)
    }
}
