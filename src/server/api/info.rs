//! `ServerService`.

use super::{Api, answer, caller};
use crate::access::roles::Role;
use crate::engine::{BUILTIN_NAMES, CAPABILITIES};
use crate::tick::scheduler::WorkerPriority;
use sinew_physics::figure::Flags;
use sinew_wire::convert::{server, timestamp};
use sinew_wire::frame::FIELD_NAMES;
use sinew_wire::pb::{self, server_service_server::ServerService};
use tonic::{Request, Response, Status};

#[tonic::async_trait]
impl ServerService for Api {
    async fn get_server_info(
        &self,
        _: Request<pb::GetServerInfoRequest>,
    ) -> Result<Response<pb::GetServerInfoResponse>, Status> {
        let names = |list: &[&str]| list.iter().map(|n| (*n).to_owned()).collect();
        answer(Ok(pb::GetServerInfoResponse {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            start_time: Some(timestamp(self.started)),
            flag_names: names(&Flags::NAMES),
            view_fields: names(&FIELD_NAMES),
            builtin_clips: BUILTIN_NAMES.iter().map(|n| format!("clips/{n}")).collect(),
            capabilities: names(&CAPABILITIES),
            limits: server::limits(&self.config.limits()),
            tick_worker_count: self.worlds.workers().0 as i32,
            tick_priority: match self.worlds.workers().1 {
                WorkerPriority::Fifo => pb::TickPriority::Fifo,
                WorkerPriority::Nice => pb::TickPriority::Nice,
                WorkerPriority::Plain => pb::TickPriority::Plain,
            }
            .into(),
        }))
    }

    async fn get_server_stats(
        &self,
        request: Request<pb::GetServerStatsRequest>,
    ) -> Result<Response<pb::GetServerStatsResponse>, Status> {
        let stats = || {
            let name = &request.get_ref().world;
            let caller = caller(&request)?;
            let worlds = if name.is_empty() {
                let mut worlds = self.worlds.list();
                worlds.retain(|w| self.sees(caller, w));
                worlds
            } else {
                let handle = self.world(&request, "world", name)?;
                if !self.sees(caller, &handle) {
                    return Err(caller.denied(Role::Viewer, name));
                }
                vec![handle]
            };
            Ok(pb::GetServerStatsResponse {
                worlds: worlds
                    .iter()
                    .map(|w| {
                        let s = w.stats();
                        server::stats(&server::Stats {
                            world: &s.id,
                            ticks: s.ticks,
                            refused: s.refused,
                            dropped: s.dropped,
                            viewers: s.viewers,
                            budget_used: s.budget_used,
                            stages: s.stages.map(|(n, p)| (n, [p.p50, p.p99, p.max])).to_vec(),
                        })
                    })
                    .collect(),
                watch_stream_count: self.viewers.taken() as i32,
                drive_stream_count: self.drivers.taken() as i32,
                simulation_count: self.simulations.running() as i32,
                budget_used: self.worlds.budget.used(),
                budget_limit: self.worlds.budget.limit(),
            })
        };
        answer(stats())
    }
}
