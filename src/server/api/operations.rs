//! `OperationService`.

use super::{Api, answer, caller, client, clips, encoded, refusal, simulation, stopped, upload};
use crate::encoded::Encoded;
use crate::operations::{Operation, OperationState};
use sinew_wire::convert::names::OPERATION;
use sinew_wire::convert::{duration, operation_name, page, timestamp};
use sinew_wire::pb::operation::Result as Done;
use sinew_wire::pb::operation_service_server::OperationService;
use sinew_wire::pb::{self, start_operation_request::Work};
use sinew_wire::status::{Fault, rpc_status};
use std::time::Duration;
use tonic::{Request, Response, Status};

/// Longest wait of one call, and the wait of a call that names none.
const LONGEST_WAIT: Duration = Duration::from_secs(60);

/// The field `operation` of every answer that has one.
const OPERATION_FIELD: u32 = 1;
/// The field `simulate_clip` of an operation.
const SIMULATE_CLIP: u32 = 9;

/// Bytes of a result.
fn size(result: &Encoded) -> u64 {
    result.len() as u64
}

/// The field of an operation that holds its result.
fn result(done: Done) -> Encoded {
    Encoded::of(&pb::Operation {
        result: Some(done),
        ..Default::default()
    })
}

impl Api {
    /// An operation on the wire, and apart from it the field of its result.
    fn operation_out(&self, o: &Operation<Encoded>) -> (pb::Operation, Encoded) {
        use pb::OperationState as S;
        let told = *o.progress.watch().borrow();
        let mut out = pb::Operation {
            name: OPERATION.name([&o.id]),
            progress: told.unwrap_or(0.0),
            create_time: Some(timestamp(o.created)),
            ..Default::default()
        };
        let mut found = Encoded::default();
        let state = match o.state() {
            OperationState::Going if told.is_none() => S::Queued,
            OperationState::Going => S::Running,
            OperationState::Ended { at, outcome, .. } => {
                out.end_time = Some(timestamp(at));
                let ttl = Duration::from_secs_f64(self.config.operation_ttl_s);
                out.expire_time = Some(timestamp(at + ttl));
                match outcome {
                    None => S::Cancelled,
                    Some(Ok(done)) => {
                        out.progress = 1.0;
                        found = (*done).clone();
                        S::Succeeded
                    }
                    Some(Err(fault)) => {
                        found = result(Done::Error(rpc_status(fault)));
                        S::Failed
                    }
                }
            }
        };
        out.state = state.into();
        (out, found)
    }

    /// An answer with an operation and its result, whose bytes all callers share.
    fn operation_answer<T: Default>(&self, o: &Operation<Encoded>) -> Response<T> {
        let (operation, result) = self.operation_out(o);
        encoded(Encoded::of(&operation).then(result).field(OPERATION_FIELD))
    }

    fn operation<T>(
        &self,
        request: &Request<T>,
        name: &str,
    ) -> Result<std::sync::Arc<Operation<Encoded>>, Fault> {
        let id = operation_name("name", name)?;
        self.operations.get(caller(request)?.principal(), id)
    }
}

#[tonic::async_trait]
impl OperationService for Api {
    async fn start_operation(
        &self,
        request: Request<pb::StartOperationRequest>,
    ) -> Result<Response<pb::StartOperationResponse>, Status> {
        self.once(request, |api, request| async move {
            let (client, caller) = (client(&request), caller(&request)?.clone());
            let upload = upload(&request);
            let work = request.into_inner().work;
            let work = work.ok_or_else(|| {
                Fault::invalid(
                    "work",
                    "must be create_clip, simulate_clip or rehearse_clip",
                )
            })?;
            if matches!(&work, Work::CreateClip(r) if r.validate_only) {
                return Err(Fault::invalid(
                    "create_clip.validate_only",
                    "must be false: CreateClip itself does that",
                ));
            }
            let principal = caller.principal().clone();
            let doer = api.clone();
            let started = api.operations.start(
                principal,
                |progress| async move {
                    let who = (&caller, client);
                    match work {
                        Work::CreateClip(r) => clips::create(&doer, who, (r, upload), progress)
                            .await
                            .map(|made| result(Done::CreateClip(made)))
                            .map_err(|fault| fault.within("create_clip")),
                        Work::SimulateClip(r) => {
                            simulation::simulate(&doer, who, (r, upload), progress, None)
                                .await
                                .map(|done| done.whole().field(SIMULATE_CLIP))
                                .map_err(|fault| fault.within("simulate_clip"))
                        }
                        Work::RehearseClip(r) => clips::rehearse(&doer, who, r, progress)
                            .await
                            .map(|done| result(Done::RehearseClip(done)))
                            .map_err(|fault| fault.within("rehearse_clip")),
                    }
                },
                size,
            )?;
            // An operation that has ended reports that on the next look.
            let operation = pb::Operation {
                state: pb::OperationState::Queued.into(),
                name: OPERATION.name([&started.id]),
                create_time: Some(timestamp(started.created)),
                ..Default::default()
            };
            Ok(pb::StartOperationResponse {
                operation: Some(operation),
            })
        })
        .await
    }

    async fn get_operation(
        &self,
        request: Request<pb::GetOperationRequest>,
    ) -> Result<Response<pb::GetOperationResponse>, Status> {
        let operation = self.operation(&request, &request.get_ref().name);
        let operation = operation.map_err(refusal)?;
        Ok(self.operation_answer(&operation))
    }

    async fn list_operations(
        &self,
        request: Request<pb::ListOperationsRequest>,
    ) -> Result<Response<pb::ListOperationsResponse>, Status> {
        let result = || {
            let r = request.get_ref();
            let principal = caller(&request)?.principal();
            let items = self.operations.list(principal).into_iter();
            // Numbers grow; padded they sort as text.
            let items = items.map(|o| (format!("{:020}", o.number), o));
            let list = format!("operations of {principal}");
            let (operations, next_page_token) = page(&list, items, r.page_size, &r.page_token)?;
            Ok(pb::ListOperationsResponse {
                operations: operations.iter().map(|o| self.operation_out(o).0).collect(),
                next_page_token,
            })
        };
        answer(result())
    }

    async fn wait_operation(
        &self,
        request: Request<pb::WaitOperationRequest>,
    ) -> Result<Response<pb::WaitOperationResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let operation = self.operation(&request, &r.name)?;
            let longest = match r.timeout.as_ref().map(duration) {
                None => LONGEST_WAIT,
                Some(Some(timeout)) => timeout.min(LONGEST_WAIT),
                Some(None) => return Err(Fault::invalid("timeout", "must not be negative")),
            };
            let mut stopping = self.stopping.clone();
            tokio::select! {
                () = operation.ended() => {}
                () = tokio::time::sleep(longest) => {}
                () = stopped(&mut stopping) => return Err(Fault::Draining),
            }
            Ok(self.operation_answer(&operation))
        };
        result.await.map_err(refusal)
    }

    async fn cancel_operation(
        &self,
        request: Request<pb::CancelOperationRequest>,
    ) -> Result<Response<pb::CancelOperationResponse>, Status> {
        let operation = self.operation(&request, &request.get_ref().name);
        let operation = operation.map_err(refusal)?;
        operation.cancel();
        Ok(self.operation_answer(&operation))
    }

    async fn delete_operation(
        &self,
        request: Request<pb::DeleteOperationRequest>,
    ) -> Result<Response<pb::DeleteOperationResponse>, Status> {
        let result = || {
            let id = operation_name("name", &request.get_ref().name)?;
            self.operations.delete(caller(&request)?.principal(), id)?;
            Ok(pb::DeleteOperationResponse {})
        };
        answer(result())
    }
}
