//! `RecordingService`.

use super::history::journal;
use super::permit::Permit;
use super::{Api, answer, caller, client, long, refusal};
use crate::export::{Format, export};
use crate::recordings::{KeptRecording, NewRecording, end_name};
use sinew_wire::convert::names::RECORDING;
use sinew_wire::convert::{new_id, not_negative, page, timestamp};
use sinew_wire::pb;
use sinew_wire::pb::recording_service_server::RecordingService;
use sinew_wire::status::Fault;
use std::sync::Arc;
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Request, Response, Status};

/// Bytes of one piece of a file, at most.
const PIECE: usize = 1 << 20;
/// Pieces that wait for a client that does not read.
const PIECES: usize = 2;

fn out(recording: &KeptRecording) -> pb::Recording {
    let now = recording.now();
    let end = match now.end {
        None => "",
        Some(end) => end_name(end),
    };
    let state = match now.end {
        None => pb::RecordingState::Running,
        Some(_) => pb::RecordingState::Ended,
    };
    pb::Recording {
        name: RECORDING.name([&recording.world, &recording.id]),
        state: state.into(),
        first_tick: now.ticks.0 as i64,
        last_tick: now.ticks.1 as i64,
        size_bytes: now.bytes as i64,
        create_time: Some(timestamp(recording.created)),
        end_reason: end.to_owned(),
    }
}

impl Api {
    /// A recording, for callers that may make this call in its world.
    fn recording<T>(&self, request: &Request<T>, name: &str) -> Result<Arc<KeptRecording>, Fault> {
        let [world, id] = RECORDING.ids("name", name)?;
        let handle = self.world(request, "name", &format!("worlds/{world}"))?;
        self.recordings.get(&handle.id, id)
    }
}

#[tonic::async_trait]
impl RecordingService for Api {
    type ExportRecordingStream = ReceiverStream<Result<pb::ExportRecordingResponse, Status>>;

    async fn start_recording(
        &self,
        request: Request<pb::StartRecordingRequest>,
    ) -> Result<Response<pb::StartRecordingResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let handle = api.world(&request, "parent", &r.parent)?;
            let first = r.first_tick.map(|t| not_negative("first_tick", t));
            let new = NewRecording {
                world: handle.id.to_string(),
                id: new_id("recording_id", &r.recording_id)?,
                first: first.transpose()?,
                owner: client(&request),
            };
            let recording =
                (api.recordings).start(journal(&handle)?, new, || api.still_there(&handle))?;
            api.stored(&handle).await?;
            Ok(pb::StartRecordingResponse {
                recording: Some(out(&recording)),
            })
        })
        .await
    }

    async fn stop_recording(
        &self,
        request: Request<pb::StopRecordingRequest>,
    ) -> Result<Response<pb::StopRecordingResponse>, Status> {
        self.once(request, |api, request| async move {
            let recording = api.recording(&request, &request.get_ref().name)?;
            recording.stop();
            let handle = api.worlds.get(&recording.world)?;
            api.stored(&handle).await?;
            Ok(pb::StopRecordingResponse {
                recording: Some(out(&recording)),
            })
        })
        .await
    }

    async fn get_recording(
        &self,
        request: Request<pb::GetRecordingRequest>,
    ) -> Result<Response<pb::GetRecordingResponse>, Status> {
        let get = || {
            let recording = self.recording(&request, &request.get_ref().name)?;
            Ok(pb::GetRecordingResponse {
                recording: Some(out(&recording)),
            })
        };
        answer(get())
    }

    async fn list_recordings(
        &self,
        request: Request<pb::ListRecordingsRequest>,
    ) -> Result<Response<pb::ListRecordingsResponse>, Status> {
        let list = || {
            let r = request.get_ref();
            let handle = self.world(&request, "parent", &r.parent)?;
            let all = self.recordings.of_world(&handle.id);
            let items = all.into_iter().map(|k| (k.id.clone(), k));
            let list = format!("{}/recordings", r.parent);
            let (kept, next_page_token) = page(&list, items, r.page_size, &r.page_token)?;
            Ok(pb::ListRecordingsResponse {
                recordings: kept.iter().map(|k| out(k)).collect(),
                next_page_token,
            })
        };
        answer(list())
    }

    async fn delete_recording(
        &self,
        request: Request<pb::DeleteRecordingRequest>,
    ) -> Result<Response<pb::DeleteRecordingResponse>, Status> {
        self.once(request, |api, request| async move {
            let recording = api.recording(&request, &request.get_ref().name)?;
            api.recordings.remove(&recording.world, &recording.id)?;
            let handle = api.worlds.get(&recording.world)?;
            api.stored(&handle).await?;
            Ok(pb::DeleteRecordingResponse {})
        })
        .await
    }

    async fn export_recording(
        &self,
        request: Request<pb::ExportRecordingRequest>,
    ) -> Result<Response<Self::ExportRecordingStream>, Status> {
        let start = || {
            let r = request.get_ref();
            let recording = self.recording(&request, &r.name)?;
            let figure = Some(r.figure_id.clone()).filter(|f| !f.is_empty());
            let format = match pb::RecordingFormat::try_from(r.format) {
                Ok(pb::RecordingFormat::Unspecified | pb::RecordingFormat::Mcap) => Format::Mcap,
                Ok(pb::RecordingFormat::Bvh) => Format::Bvh(figure),
                Ok(pb::RecordingFormat::Csv) => Format::Csv(figure),
                Err(_) => return Err(Fault::invalid("format", "is none that is known")),
            };
            let handle = self.worlds.get(&recording.world)?;
            let permit = Permit::new(self, &handle, caller(&request)?, &[]);
            Ok((recording, format, permit))
        };
        let (recording, format, mut permit) = start().map_err(refusal)?;
        let client = client(&request);
        let (send, receive) = mpsc::channel(PIECES);
        let pool = self.simulations.clone();
        tokio::spawn(async move {
            let to = send.clone();
            let done = pool.run(&client, move |turn| {
                let recorded = recording.now();
                let (mut waiting, mut refused) = (Vec::new(), None);
                let mut give = |piece: Vec<u8>, ticks: u64| {
                    // Small pieces are joined; a client that is gone takes none.
                    waiting.extend(piece);
                    let whole = ticks > recorded.ticks.1 - recorded.ticks.0;
                    let mut taken = !to.is_closed();
                    while taken && (waiting.len() >= PIECE || whole && !waiting.is_empty()) {
                        let rest = waiting.split_off(waiting.len().min(PIECE));
                        let data = std::mem::replace(&mut waiting, rest);
                        let message = pb::ExportRecordingResponse {
                            data,
                            done_tick_count: ticks as i64,
                        };
                        // A client that does not read must not hold the worker for ever.
                        refused = long::hand_over(&to, message, turn).err();
                        taken = refused.is_none();
                    }
                    taken
                };
                let done = export(
                    &recording.world,
                    &recorded,
                    format,
                    &|| turn.stop(),
                    &mut give,
                );
                refused.map_or(done, Err)
            });
            let done = tokio::select! {
                done = done => done,
                fault = permit.ended() => Err(fault),
            };
            if let Err(fault) = done {
                // The client may be gone, or may not read.
                let _ = send
                    .send_timeout(Err(refusal(fault)), long::LAST_WORD)
                    .await;
            }
        });
        Ok(Response::new(ReceiverStream::new(receive)))
    }
}
