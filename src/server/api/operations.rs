//! `OperationService`.

use super::{Api, answer, caller, client, clips, simulation, stopped};
use crate::server::operations::{Operation, State};
use crate::wire::convert::names::OPERATION;
use crate::wire::convert::{duration, operation_name, page, timestamp};
use crate::wire::pb::operation::Result as Done;
use crate::wire::pb::operation_service_server::OperationService;
use crate::wire::pb::{self, start_operation_request::Work};
use crate::wire::status::{Fault, rpc_status};
use std::time::Duration;
use tonic::{Request, Response, Status};

/// Longest wait of one call, and the wait of one that does not say.
const LONGEST_WAIT: Duration = Duration::from_secs(60);

/// Bytes of a result in memory, near enough.
fn size(done: &Done) -> u64 {
    match done {
        Done::Error(status) => prost::Message::encoded_len(status) as u64,
        Done::CreateClip(made) => prost::Message::encoded_len(made) as u64,
        Done::SimulateClip(done) => prost::Message::encoded_len(done) as u64,
        Done::RehearseClip(done) => prost::Message::encoded_len(done) as u64,
    }
}

impl Api {
    /// An operation on the wire.
    fn operation_out(&self, o: &Operation<Done>, with_result: bool) -> pb::Operation {
        use pb::OperationState as S;
        let told = *o.progress.watch().borrow();
        let mut out = pb::Operation {
            name: OPERATION.name([&o.id]),
            progress: told.unwrap_or(0.0),
            create_time: Some(timestamp(o.created)),
            ..Default::default()
        };
        let state = match o.state() {
            State::Going if told.is_none() => S::Queued,
            State::Going => S::Running,
            State::Ended { at, outcome, .. } => {
                out.end_time = Some(timestamp(at));
                let ttl = Duration::from_secs_f64(self.config.operation_ttl_s);
                out.expire_time = Some(timestamp(at + ttl));
                match outcome {
                    None => S::Cancelled,
                    Some(Ok(done)) => {
                        out.progress = 1.0;
                        out.result = with_result.then(|| (*done).clone());
                        S::Succeeded
                    }
                    Some(Err(fault)) => {
                        out.result = with_result.then(|| Done::Error(rpc_status(fault)));
                        S::Failed
                    }
                }
            }
        };
        out.state = state.into();
        out
    }

    fn operation<T>(
        &self,
        request: &Request<T>,
        name: &str,
    ) -> Result<std::sync::Arc<Operation<Done>>, Fault> {
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
                        Work::CreateClip(r) => clips::create(&doer, who, r, progress)
                            .await
                            .map(Done::CreateClip)
                            .map_err(|fault| fault.within("create_clip")),
                        Work::SimulateClip(r) => {
                            simulation::simulate(&doer, who, r, progress, None)
                                .await
                                .map(Done::SimulateClip)
                                .map_err(|fault| fault.within("simulate_clip"))
                        }
                        Work::RehearseClip(r) => clips::rehearse(&doer, who, r, progress)
                            .await
                            .map(Done::RehearseClip)
                            .map_err(|fault| fault.within("rehearse_clip")),
                    }
                },
                size,
            )?;
            Ok(pb::StartOperationResponse {
                operation: Some(api.operation_out(&started, true)),
            })
        })
        .await
    }

    async fn get_operation(
        &self,
        request: Request<pb::GetOperationRequest>,
    ) -> Result<Response<pb::GetOperationResponse>, Status> {
        let operation = self.operation(&request, &request.get_ref().name);
        answer(operation.map(|o| pb::GetOperationResponse {
            operation: Some(self.operation_out(&o, true)),
        }))
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
                operations: operations
                    .iter()
                    .map(|o| self.operation_out(o, false))
                    .collect(),
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
            Ok(pb::WaitOperationResponse {
                operation: Some(self.operation_out(&operation, true)),
            })
        };
        answer(result.await)
    }

    async fn cancel_operation(
        &self,
        request: Request<pb::CancelOperationRequest>,
    ) -> Result<Response<pb::CancelOperationResponse>, Status> {
        let operation = self.operation(&request, &request.get_ref().name);
        answer(operation.map(|o| {
            o.cancel();
            pb::CancelOperationResponse {
                operation: Some(self.operation_out(&o, true)),
            }
        }))
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
